/* alive.h - signs of life. Every process of a job touches a file of its own in the job's folder now
 * and then, from a thread of its own, so that a program that computes for an hour shows them, too,
 * and one that is stopped (SIGSTOP, a host that hangs) does not. Whoever waits looks at the files
 * of all others; times are the watcher's own. Where the disk is not shared, files of other hosts
 * are never seen, and their processes are not judged. Part of libcpl.a: depends on MPI alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

/* Sets the time, s, without a sign of life after which a process counts as hung; before
 * alive_begin. */
void alive_patience(double s);
/* Adds a process of this job, on any host, to those that are watched. */
void alive_add(const char *program, int rank);
/* From here on this process shows signs of life in `dir' (copied) and alive_silent judges the
 * others. */
void alive_begin(const char *dir, const char *program, int rank);
/* Shows a sign at once, e.g. when the folder was not there at the first. */
void alive_sign(void);
/* Stops showing signs and watching; removes the file. */
void alive_end(void);
/* Whether a watched process has been silent for too long; then text[size] names it. Looks at the
 * disk only sixteen times in the patience; a pause of this process itself (suspended with the whole
 * job) restarts the clock. */
bool alive_silent(char *text, int size);

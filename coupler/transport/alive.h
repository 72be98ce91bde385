/* alive.h - signs of life: every process of a job touches a file of its own in the job's folder now
 * and then, from a thread of its own, so that a program that computes for an hour shows them, too,
 * and one that is stopped (SIGSTOP, a host that hangs) does not. Whoever waits looks at the files
 * of all others; times are the watcher's own. Where a disk is
 * not shared, files of other hosts are never seen, and their processes not judged. Part of
 * libcpl.a: depends on MPI alone. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_ALIVE_H
#define COUPLER_ALIVE_H

#include <stdbool.h>

/* s without a sign of life after which a process counts as hung; before alive_begin. */
void alive_patience(double s);
/* A process of this job, on any host. */
void alive_add(const char *program, int rank);
/* From here on this process shows signs of life in `dir', and looks for those of the others. */
void alive_begin(const char *dir, const char *program, int rank);
/* A sign at once: the folder may not have been there at the first. */
void alive_sign(void);
void alive_end(void);
/* Whether a process has been silent for too long; then `text' names it. Looks at the disk a few
 * times in the patience only; a pause of this process itself (suspended with the whole job) starts
 * the clock anew. */
bool alive_silent(char *text, int size);

#endif

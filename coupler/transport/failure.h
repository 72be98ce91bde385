/* failure.h - how a job ends when one of its programs fails: an error report on disk, which
 * everybody prints. Open MPI 4.1 reports no error for a dead peer; whoever waits therefore looks
 * whether the processes of its own host still live. Part of libcpl.a: depends on MPI alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_FAILURE_H
#define COUPLER_FAILURE_H

#include <mpi.h>
#include <stdbool.h>

/* Who this process is; from here on an exit or MPI_Finalize before failure_closed is a failure. */
void failure_open(MPI_Comm world, const char *program, int rank);
void failure_closed(void);
/* A rank of a program on this host, to be looked after. */
void failure_watch(const char *program, int rank, long pid);
/* A program with ranks on another host, whose death nobody here can see. */
void failure_elsewhere(const char *program, const char *host);
/* What to say of them when nobody here knows why the job ends; "" if there are none. */
const char *failure_hint(void);
/* Where the note goes; before, there is none. */
void failure_path(const char *path);
/* What is going on, for the last words: "in coupling step 12, waiting for velocity of sph". Copied.
 */
void failure_doing(const char *text);

/* True if a watched process is gone; the note then says so. Safe in signal handlers. */
bool failure_witness(void);
/* The same, or a process of any host that shows no sign of life any more (alive.h). Not for signal
 * handlers. */
bool failure_seen(void);
/* Leaves a note; false if there is one already. Safe in signal handlers. */
bool failure_note(const char *text);
/* Writes the note, or what is known instead, to a file descriptor. Safe in signal handlers. */
void failure_obituary(int fd);
/* The note's text; false if there is none. */
bool failure_read(char *text, int size);
/* Note, a line on stderr, a moment for the logs of others, MPI_Abort with this code. */
_Noreturn void failure_die(int code, const char *reason);

#endif

/* failure.h - how a job ends when one of its programs fails: a failure report on disk, the "note",
 * which every process prints. The first one to know writes it, so that the cause wins over its
 * consequences. Open MPI 4.1 reports no error for a dead peer; whoever waits therefore checks
 * whether the processes of its own host still live. State is static, one per process, since signal
 * handlers have no argument. Part of libcpl.a: depends on MPI alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>

/* Sets who this process is. From here on an exit or MPI_Finalize before failure_closed is a
 * failure. */
void failure_open(MPI_Comm world, const char *program, int rank);
/* This process has left the job in order. */
void failure_closed(void);
/* Adds a rank of a program on this host to those whose death failure_witness notices. */
void failure_watch(const char *program, int rank, long pid);
/* Adds a program with ranks on another host, whose death cannot be noticed here. */
void failure_elsewhere(const char *program, const char *host);
/* What to say of those programs when nobody here knows why the job ends; "" if there are none.
 * Static. */
const char *failure_hint(void);
/* Sets the file of the note (copied); before, none is written. */
void failure_path(const char *path);
/* Sets what is going on, for the report: "in coupling step 12, waiting for velocity of sph".
 * Copied. */
void failure_doing(const char *text);

/* Whether a watched process is gone; then a note says so. Safe in signal handlers. */
bool failure_witness(void);
/* The same, or a process of any host that shows no sign of life any more (alive.h). Not for signal
 * handlers. */
bool failure_seen(void);
/* Writes a note; false if there is one already. Safe in signal handlers. */
bool failure_note(const char *text);
/* Writes the note, or what is known instead, to a file descriptor. Safe in signal handlers. */
void failure_obituary(int fd);
/* Copies the note's text to text[size]; false if there is none. */
bool failure_read(char *text, int size);
/* Writes a note, prints reason and note on stderr, leaves the others a moment for their logs and
 * ends the job with MPI_Abort and this exit code. */
_Noreturn void failure_die(int code, const char *reason);

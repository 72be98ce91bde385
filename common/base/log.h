/* log.h - what a program says: to the terminal and to its log file, whole lines only.
 * Rank 0 of the program speaks; fail() and log_here() speak from any rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_LOG_H
#define COMMON_LOG_H

#include <mpi.h>
#include <stdbool.h>

/* From here on rank 0 of comm speaks, as `program' ("sph"). Before: world rank 0. */
void log_open(MPI_Comm comm, const char *program);
/* Also to this file, line-buffered, appended to; rank 0 opens it. NULL closes. */
void log_file(const char *path);
/* One or more whole lines; a newline is added if there is none. Quiet: the file only. */
void log_say(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
void log_quiet(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
/* What a run uses and leaves out, a line: "on: A, B; off: C"; left_out NULL: the same words. */
struct log_use {
    bool on;
    const char *used, *left_out;
};
void log_uses(const struct log_use *uses, int n);
/* "warning: ..." */
void log_warn(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
/* From any rank, with "program rank N: " before it (terminal, and the file on rank 0). */
void log_here(const char *fmt, ...) __attribute__((format(printf, 1, 2)));

/* A fault of ours or of a library: program, rank, file and line, then MPI_Abort(world, 1). */
#define fail(...) fail_at(__FILE__, __LINE__, __VA_ARGS__)
#define require(cond) ((cond) ? (void)0 : fail("required: %s", #cond))
_Noreturn void fail_at(const char *file, int line, const char *fmt, ...)
    __attribute__((format(printf, 3, 4)));
/* The run cannot go on for a reason that lies outside of it (disk, memory): one sentence, exit
 * code. */
_Noreturn void fail_with(int code, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* Called by fail_at and fail_with before the abort (the death note of a coupled job); NULL:
 * nothing. */
extern void (*fail_hook)(const char *reason);

#endif

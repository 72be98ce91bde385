/* log.h - what a program prints: to the terminal and to its log file, always in whole lines. Rank 0
 * of the program prints; the calls are legal on all ranks and silent on the others. abort_run()
 * and fail_with() print from any rank. None of the calls communicates.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>

/* From now on rank 0 of comm prints, under the name `program' ("sph", copied). Before this call
 * rank 0 of MPI_COMM_WORLD does, or the process itself if MPI is not up. */
void log_open(MPI_Comm comm, const char *program);
/* Appends all later lines to the file `path' as well, line by line; only rank 0 opens it. The file
 * of an earlier call is closed; NULL only closes. A file that cannot be opened is left out with a
 * warning. */
void log_file(const char *path);
/* One or more whole lines of at most 8190 bytes, the rest is cut; a newline is added if there is
 * none. log_quiet writes to the file only. */
void log_say(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
/* Before log_open, of the command line: from rank 0 of the world, and from each rank of the
 * programs of an MPMD job behind the first one, whose command lines are their own. */
void log_early(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
void log_quiet(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
/* An ingredient of a run for the line "on: A, B; off: C", which says what the case uses and leaves
 * out: `used' if on, else left_out (NULL: `used' as well). Texts are borrowed during the call. */
struct log_use {
    bool on;                     /* whether the case uses it */
    const char *used, *left_out; /* what is printed behind "on:" and behind "off:" */
};
/* Prints that line for uses[n], one ingredient after the other in their order. */
void log_uses(const struct log_use *uses, int n);
/* From true to false what log_say and log_warn say goes to the file only: another program of the
 * job says the same. */
void log_told_elsewhere(bool is);
/* As log_say, with "warning: " before the text. */
void log_warn(const char *fmt, ...) __attribute__((format(printf, 1, 2)));

/* An error of the code or of a library, not of the user: prints program, rank, reason (at most 2047
 * bytes), file and line, calls fail_hook and ends all programs of the world with exit code 1 by
 * MPI_Abort (a lone process simply exits). Does not return. */
#define abort_run(...) fail_at(__FILE__, __LINE__, __VA_ARGS__)
/* Ends the run through abort_run() if cond does not hold; stands in release builds, too. */
#define require(cond) ((cond) ? (void)0 : abort_run("required: %s", #cond))
_Noreturn void fail_at(const char *file, int line, const char *fmt, ...)
    __attribute__((format(printf, 3, 4)));
/* As abort_run(), with the caller's exit code (exit.h) and without file and line: for reasons that
 * lie outside of the code, such as a full disk. The reason is one sentence. */
_Noreturn void fail_with(int code, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* Called with the reason before the run is aborted: it writes the failure report of a coupled job
 * and must not fail itself. NULL: nothing is called. */
extern void (*fail_hook)(const char *reason);

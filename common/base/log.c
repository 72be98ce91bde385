/* log.c - see log.h. Who prints is decided here alone: rank_now() once log_open has said which
 * communicator the program runs on. The terminal is shared by all ranks of all programs, so each
 * text is put together in one buffer and handed over in a single flushed call; lines of several
 * ranks then do not mix. Everything that ends a run from within goes through leave().
 * SPDX-License-Identifier: BSD-3-Clause */
#include "log.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "key_text.h"

static struct {
    int rank; /* of the program; -1 before log_open */
    char program[64];
    FILE *file;
    bool told_elsewhere;
} state = {.rank = -1};

void (*fail_hook)(const char *reason) = NULL;

/* The rank that decides about printing. Before log_open it is asked of MPI each time, since MPI may
 * come up in between. */
static int rank_now(void)
{
    int rank = state.rank, up = 0;
    if (rank < 0) {
        MPI_Initialized(&up);
        rank = 0;
        if (up)
            MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    }
    return rank;
}

void log_open(MPI_Comm comm, const char *program)
{
    MPI_Comm_rank(comm, &state.rank);
    snprintf(state.program, sizeof state.program, "%s", program);
}

/* Line by line (_IOLBF): a run that is killed leaves all lines that it has said. */
void log_file(const char *path)
{
    if (state.file)
        fclose(state.file);
    state.file = path && rank_now() == 0 ? fopen(path, "a") : NULL;
    if (state.file)
        setvbuf(state.file, NULL, _IOLBF, 0);
    else if (path && rank_now() == 0)
        log_warn("%s: cannot be written (%s): this run keeps no log", path, strerror(errno));
}

/* One write of prefix and text, ended by a newline. Cut to 8190 bytes. */
static void say(bool terminal, bool file, const char *prefix, const char *fmt, va_list args)
{
    char line[8192];
    int n = snprintf(line, sizeof line, "%s", prefix);
    const int m = vsnprintf(line + n, sizeof line - (size_t)n - 1, fmt, args);
    n += m < (int)sizeof line - n - 1 ? m : (int)sizeof line - n - 2;
    if (n == 0 || line[n - 1] != '\n')
        line[n++] = '\n';
    line[n] = '\0';
    if (terminal) {
        fputs(line, stdout);
        fflush(stdout);
    }
    if (file && state.file)
        fputs(line, state.file);
}

#define SAY(terminal, file, prefix)                                                                \
    do {                                                                                           \
        va_list args;                                                                              \
        va_start(args, fmt);                                                                       \
        say(terminal, file, prefix, fmt, args);                                                    \
        va_end(args);                                                                              \
    } while (0)

void log_told_elsewhere(bool is) { state.told_elsewhere = is; }

void log_say(const char *fmt, ...)
{
    if (rank_now() == 0)
        SAY(!state.told_elsewhere, true, "");
}

/* Whether this is a process of a later program of an MPMD job (MPI_APPNUM counts them from 0). */
static bool is_of_later_program(void)
{
    int up = 0, known = 0, *number = NULL;
    MPI_Initialized(&up);
    if (up)
        MPI_Comm_get_attr(MPI_COMM_WORLD, MPI_APPNUM, &number, &known);
    return known && *number > 0;
}

void log_early(const char *fmt, ...)
{
    if (rank_now() == 0 || is_of_later_program())
        SAY(true, true, "");
}

/* Two rounds over the list, first what is on, then what is off, into one line; the parts' first
 * words are told apart by whether anything stands there. */
void log_uses(const struct log_use *uses, int n)
{
    char line[1024] = "";
    for (int on = 1; on >= 0; on--) {
        const char *between = on ? "on: " : *line ? "; off: " : "off: ";
        for (int k = 0; k < n; k++) {
            if (uses[k].on != (on == 1))
                continue;
            text_add(line, sizeof line, "%s%s", between,
                     on || !uses[k].left_out ? uses[k].used : uses[k].left_out);
            between = ", ";
        }
    }
    log_say("%s", line);
}

void log_quiet(const char *fmt, ...)
{
    if (rank_now() == 0)
        SAY(false, true, "");
}

void log_warn(const char *fmt, ...)
{
    if (rank_now() == 0)
        SAY(!state.told_elsewhere, true, "warning: ");
}

/* From any rank, with "program rank N: " before the text: to the terminal, on rank 0 to the file
 * too. */
static void __attribute__((format(printf, 1, 2))) say_here(const char *fmt, ...)
{
    char prefix[96];
    snprintf(prefix, sizeof prefix, "%s rank %d: ", state.program, rank_now());
    SAY(true, true, prefix);
}

/* The last thing of a failing process. MPI_Abort ends all programs of a job, which share the world;
 * alone, _Exit leaves without the exit handlers, which could wait for other ranks. */
static _Noreturn void leave(int code, const char *reason)
{
    int up = 0, size = 1;
    if (fail_hook)
        fail_hook(reason);
    MPI_Initialized(&up);
    if (up)
        MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (size > 1)
        MPI_Abort(MPI_COMM_WORLD, code);
    _Exit(code);
}

void fail_at(const char *file, int line, const char *fmt, ...)
{
    char reason[2048];
    va_list args;
    va_start(args, fmt);
    vsnprintf(reason, sizeof reason, fmt, args);
    va_end(args);
    say_here("%s (%s:%d)", reason, file, line);
    leave(1, reason);
}

void fail_with(int code, const char *fmt, ...)
{
    char reason[2048];
    va_list args;
    va_start(args, fmt);
    vsnprintf(reason, sizeof reason, fmt, args);
    va_end(args);
    say_here("%s", reason);
    leave(code, reason);
}

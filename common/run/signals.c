/* signals.c - a request to stop is a flag; a fault leaves a note for the other programs of the job.
 * Open MPI 4.1 reports no error for a dead peer: survivors get SIGTERM about 1 s after it and
 * SIGKILL 1 s later. So SIGTERM with a note on disk means that a partner failed; without one, an
 * orderly stop is tried, and if that hangs for 0.8 s, for lack of the partner, the reason is
 * printed and the process leaves. A SIGTERM from anyone else has no such haste: the stop takes
 * as long as the partners need. Handlers use only functions that are safe in them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "program.h"

enum { START = 120 }; /* s */

static struct {
    char who[96];       /* "sph rank 0" */
    char note[1100];    /* path of the death note */
    char hint[300];     /* where to look when a launcher ends the job and nobody here knows why */
    char heard[2][256]; /* the text in use and the one being written */
    bool launched;      /* by mpirun, which kills soon after its SIGTERM */
    pid_t launcher;     /* that process, 0: not known */
    volatile sig_atomic_t heard_now, stop, handled, started;
} state;

/* A line in one piece: other ranks may say theirs at the same time. */
static void put_parts(int fd, const char *const *part)
{
    char line[1600];
    size_t n = 0;
    for (; *part; part++) {
        const size_t more = strlen(*part), room = sizeof line - n;
        memcpy(line + n, *part, more < room ? more : room);
        n += more < room ? more : room;
    }
    const ssize_t written = write(fd, line, n);
    (void)written;
}
#define PUT(fd, ...) put_parts(fd, (const char *const[]){__VA_ARGS__, NULL})

/* Prints the note of whoever failed first; false if there is none. */
static bool print_note(void)
{
    char text[512];
    const int fd = *state.note ? open(state.note, O_RDONLY) : -1;
    ssize_t n = fd >= 0 ? read(fd, text, sizeof text - 1) : 0;
    if (fd < 0)
        return false;
    close(fd);
    if (n <= 0) {
        static const char empty[] = "a rank that could not write its error report: a full disk?";
        n = (ssize_t)sizeof empty - 1;
        memcpy(text, empty, sizeof empty);
    }
    text[n] = '\0';
    PUT(STDOUT_FILENO, state.who, ": ends because of ", text, text[n - 1] != '\n' ? "\n" : "");
    return true;
}

static void print_hint(void)
{
    PUT(STDOUT_FILENO, state.who, ": the launcher ends the job; if nobody has stopped it, ",
        state.hint, "\n");
    *state.hint = '\0'; /* once */
}

/* The first to fail creates the file, all others find it there (O_EXCL) and leave it as it is: one
 * cause, not its consequences. Uses only what is safe in a handler, as on_fault needs. */
static void leave_note(const char *what)
{
    const int fd = *state.note ? open(state.note, O_WRONLY | O_CREAT | O_EXCL, 0644) : -1;
    if (fd < 0)
        return;
    PUT(fd, state.who, ": ", what, "\n");
    close(fd);
}

/* The launcher kills all others within milliseconds of the first that leaves: they need time for
 * their last words. */
static void leave(void)
{
    const struct timespec pause = {.tv_nsec = 300000000};
    nanosleep(&pause, NULL);
    _exit(RUN_PARTNER);
}

/* There is no state yet that could be saved. */
static void stopped_early(int signal)
{
    (void)signal;
    PUT(STDOUT_FILENO, state.who,
        state.launched
            ? ": the launcher ends the job before it began: a program of it was stopped or killed\n"
            : ": stopped by a signal before the first step\n");
    _exit(RUN_STOPPED);
}

/* SIGINT, SIGTERM and SIGUSR1 ask for an orderly end: the flag is read once a step (signals_stop).
 * After SIGTERM the note of a partner that failed is printed, if there is one, and the process
 * leaves. Without one the alarm is set for the case that the others do not answer, but only if the
 * launcher sent the signal, which kills next. */
static void on_stop(int signal, siginfo_t *info, void *context)
{
    (void)context;
    const int error = errno;
    const bool hurry = state.launched && (!state.launcher || info->si_pid == state.launcher);
    if (!state.started && !state.launched)
        stopped_early(signal);
    state.stop = 1;
    if (signal == SIGTERM && !state.handled) {
        if (print_note())
            leave();
        if (*state.hint && hurry)
            print_hint();
        const struct itimerval soon = {.it_value = {.tv_usec = 800000}};
        if (hurry)
            setitimer(ITIMER_REAL, &soon, NULL);
    }
    errno = error;
}

/* 0.8 s after the launcher's SIGTERM without the orderly end having begun (signals_handled): a
 * collective call waits for a rank that is gone, and no step will end. */
static void on_alarm(int signal)
{
    (void)signal;
    if (state.handled)
        return;
    if (!print_note()) {
        const char *const heard = state.heard[state.heard_now];
        PUT(STDOUT_FILENO, state.who,
            ": the launcher ends the job and no program left a reason (killed, or out of memory?)",
            *heard ? "; last heard: " : "", heard, "\n");
    }
    leave();
}

static void not_started(int signal)
{
    (void)signal;
    PUT(STDOUT_FILENO, state.who,
        ": MPI has not started within 120 s: is every program of this job an MPI program?\n");
    _exit(RUN_INPUT);
}

/* Open MPI makes each process that it starts, often a script, the leader of a group: the launcher
 * is the parent of the leader of this process's group. */
static pid_t find_launcher(void)
{
    char path[64], text[256];
    snprintf(path, sizeof path, "/proc/%d/stat", (int)getpgrp());
    FILE *f = fopen(path, "r");
    const char *name_end = f && fgets(text, sizeof text, f) ? strrchr(text, ')') : NULL;
    int parent = 0;
    if (name_end && sscanf(name_end + 1, " %*c %d", &parent) != 1)
        parent = 0;
    if (f)
        fclose(f);
    return parent;
}

/* MPI_Init with a limit of START seconds, since it waits for ever where a program of the job is no
 * MPI program, and with handlers that say what a stop in that time means. */
void signals_start_mpi(int *argc, char ***argv, const char *program)
{
    snprintf(state.who, sizeof state.who, "%s", program);
    state.launched =
        getenv("OMPI_COMM_WORLD_RANK") != NULL; /* MPI_Init may set it for a lone process */
    state.launcher = state.launched ? find_launcher() : 0;
    signal(SIGTERM, stopped_early);
    signal(SIGINT, stopped_early);
    signal(SIGALRM, not_started);
    if (state.launched) /* alone, nobody can be late */
        alarm(START);
    MPI_Init(argc, argv);
    alarm(0);
    signal(SIGALRM, SIG_DFL);
    if (state.launched) { /* programs that meet have handlers of their own (coupler: failure.c) */
        signal(SIGTERM, SIG_DFL);
        signal(SIGINT, SIG_DFL);
    }
}

static const char *fault_name(int signal)
{
    return signal == SIGSEGV  ? "segmentation fault"
           : signal == SIGFPE ? "arithmetic fault"
           : signal == SIGBUS ? "bus fault"
                              : "abort";
}

/* Says which fault it was and in which calls, and ends as it would have ended. */
static void on_fault(int signal)
{
    void *calls[32];
    leave_note(fault_name(signal));
    PUT(STDOUT_FILENO, state.who, ": ", fault_name(signal), "\n");
    backtrace_symbols_fd(calls, backtrace(calls, 32), STDOUT_FILENO);
    raise(signal); /* SA_RESETHAND: the default action now */
}

static void install(int signal, void (*handler)(int), int flags)
{
    struct sigaction a = {.sa_handler = handler, .sa_flags = flags};
    sigemptyset(&a.sa_mask);
    sigaction(signal, &a, NULL);
}

static void install_stop(int signal)
{
    struct sigaction a = {.sa_sigaction = on_stop, .sa_flags = SA_RESTART | SA_SIGINFO};
    sigemptyset(&a.sa_mask);
    sigaction(signal, &a, NULL);
}

/* For the time of the run; abort_run() leaves a note as well. Handlers of faults are taken back at
 * their first call (SA_RESETHAND), so that raise() then ends the process as the fault would have,
 * with its core file. SA_RESTART: writes that a signal interrupts go on. */
void signals_install(const char *program, int rank)
{
    void *call;
    snprintf(state.who, sizeof state.who, "%s rank %d", program, rank);
    backtrace(&call, 1); /* the first one loads what it needs, which a handler must not */
    install_stop(SIGINT);
    install_stop(SIGTERM);
    install_stop(SIGUSR1);
    install(SIGALRM, on_alarm, SA_RESTART);
    static const int faults[] = {SIGSEGV, SIGFPE, SIGBUS, SIGABRT};
    for (size_t k = 0; k < sizeof faults / sizeof faults[0]; k++)
        install(faults[k], on_fault, (int)SA_RESETHAND | SA_NODEFER);
    fail_hook = leave_note;
}

bool signals_stop(void) { return state.stop; }
void signals_handled(void) { state.handled = 1; }
void signals_started(void) { state.started = 1; }

void signals_note_path(const char *path) { snprintf(state.note, sizeof state.note, "%s", path); }

void signals_hint(const char *text) { snprintf(state.hint, sizeof state.hint, "%s", text); }

/* Written next to the text in use, then switched over in one assignment: a handler may come in
 * between at any time. */
void signals_heard(const char *text)
{
    const int next = 1 - state.heard_now;
    snprintf(state.heard[next], sizeof state.heard[next], "%s", text);
    state.heard_now = next;
}

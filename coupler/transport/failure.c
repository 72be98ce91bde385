/* failure.c - death notes. The first to know writes the file (O_EXCL), so that the cause wins over
 * its consequences. SPDX-License-Identifier: BSD-3-Clause */
#include "failure.h"

#include "alive.h"
#include "wire.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { WHO = 128, TEXT = 512, EXIT_PARTNER = 4 };
/* ms that a process stays after its last words: the first exit after a failure makes Open MPI 4.1
 * kill all others within some ms, and it drops output that it has not read by then. */
enum { LAST_WORDS = 300 };

/* Signal handlers and exit hooks have no argument: the one place of the library with static state.
 */
static struct {
    MPI_Comm world;
    bool open, dying;
    int nwatched, room;
    struct watched {
        long pid;
        char who[WHO]; /* "sph rank 0 (process 4711)" */
    } * watched;
    char who[80], path[1040], doing[TEXT],
        seen[TEXT];       /* seen: whose death, if no note can be left */
    char absent[WHO];     /* whose process was not there when it was to be watched */
    char elsewhere[TEXT]; /* programs on other hosts: "fv on node7, walls on node8" */
} self;

/* strlen and memcpy are safe in handlers, printf is not. */
static void append(char *text, const char *more)
{
    const size_t n = strlen(text), m = strlen(more), room = TEXT - 1 - n;
    memcpy(text + n, more, m < room ? m : room);
    text[n + (m < room ? m : room)] = '\0';
}

/* write() alone is safe in handlers. */
static void put(int fd, const char *text)
{
    const char *at = text;
    for (size_t left = strlen(text); left > 0;) {
        const ssize_t n = write(fd, at, left);
        if (n <= 0)
            return;
        at += n;
        left -= (size_t)n;
    }
}

static void sleep_ms(long ms)
{
    struct timespec t = {.tv_nsec = 1000000 * ms};
    while (nanosleep(&t, &t) != 0 && errno == EINTR)
        continue;
}

/* true: this process was the first, or there is no place for notes. */
bool failure_note(const char *text)
{
    if (!self.path[0])
        return true;
    const int fd = open(self.path, O_WRONLY | O_CREAT | O_EXCL, 0644);
    if (fd < 0)
        return errno != EEXIST;
    char line[TEXT] = "";
    append(line, text);
    append(line, "\n");
    put(fd, line);
    close(fd);
    return true;
}

bool failure_read(char *text, int size)
{
    const int fd = self.path[0] ? open(self.path, O_RDONLY) : -1;
    if (fd < 0)
        return false;
    ssize_t n = 0;
    for (int tries = 0; n <= 0 && tries < 20; tries++) { /* its author may be about to write */
        n = read(fd, text, (size_t)size - 1);
        if (n <= 0)
            sleep_ms(1);
    }
    close(fd);
    text[n > 0 ? n : 0] = '\0';
    char *end = strchr(text, '\n');
    if (end)
        *end = '\0';
    return n > 0;
}

/* Not for signal handlers: looks at files. */
static bool silent(char *text)
{
    char who[200];
    if (!self.open || self.dying || !alive_silent(who, sizeof who))
        return false;
    snprintf(text, TEXT, "%.199s; seen by %s %.150s", who, self.who, self.doing);
    return true;
}

/* The one call for who waits: processes of this host first, which costs no file. */
bool failure_seen(void)
{
    char text[TEXT];
    if (failure_witness())
        return true;
    if (!silent(text))
        return false;
    (void)failure_note(text);
    memcpy(self.seen, text, sizeof self.seen);
    return true;
}

/* A signal of number 0 asks whether a process of this host is there. Safe in handlers. */
bool failure_witness(void)
{
    for (int i = 0; i < self.nwatched && self.open && !self.dying; i++) {
        if (kill((pid_t)self.watched[i].pid, 0) == 0 || errno != ESRCH)
            continue;
        char text[TEXT] = "";
        append(text, self.watched[i].who);
        append(text, " is gone: killed, out of memory, or it left without a message; seen by ");
        append(text, self.who);
        append(text, " ");
        append(text, self.doing);
        (void)failure_note(text);
        memcpy(self.seen, text, sizeof self.seen);
        return true;
    }
    return false;
}

/* Last words of a process that the launcher ends: the cause, as the note has it, or what is known.
 * Called from signal handlers. */
void failure_obituary(int fd)
{
    char note[TEXT], text[TEXT] = "";
    if (!self.open)
        return; /* has no part in the job (any more) */
    if (self.dying) {
        sleep_ms(LAST_WORDS); /* has said it */
        return;
    }
    bool noted = failure_read(note, sizeof note);
    for (int tries = 0; !noted && !failure_witness() && tries < 20; tries++)
        sleep_ms(10); /* who has just ended may still be in the table of processes */
    noted = noted || failure_read(note, sizeof note);
    append(text, self.who);
    append(text, ": the job ends: ");
    if (noted) {
        append(text, note);
    } else if (self.seen[0]) {
        append(text, self.seen);
    } else {
        append(text, self.absent);
        append(text, self.absent[0]      ? " was gone at the handshake: killed, or out of memory"
                     : self.elsewhere[0] ? self.elsewhere
                                         : "no reason was left");
        append(text, "; this rank was ");
        append(text, self.doing);
    }
    append(text, "\n");
    put(fd, text);
    sleep_ms(LAST_WORDS);
}

void failure_path(const char *path) { snprintf(self.path, sizeof self.path, "%s", path); }

void failure_doing(const char *text) { snprintf(self.doing, sizeof self.doing, "%s", text); }

void failure_watch(const char *program, int rank, long pid)
{
    if (pid == (long)getpid())
        return;
    if (self.nwatched == self.room) { /* the old list stays: a signal handler may be at it */
        struct watched *more = wire_alloc((size_t)(2 * self.room + 64) * sizeof *more);
        if (self.nwatched > 0)
            memcpy(more, self.watched, (size_t)self.nwatched * sizeof *more);
        self.watched = more;
        self.room = 2 * self.room + 64;
    }
    struct watched *w = &self.watched[self.nwatched];
    w->pid = pid;
    snprintf(w->who, sizeof w->who, "%.63s rank %d (process %ld)", program, rank, pid);
    /* A process of another container may share our host name but not our process numbers; or it
     * ended right after its first word. */
    if (kill((pid_t)pid, 0) == 0)
        self.nwatched++;
    else
        memcpy(self.absent, w->who, sizeof self.absent);
}

const char *failure_hint(void) { return self.elsewhere; }

void failure_elsewhere(const char *program, const char *host)
{
    char more[2 * WHO];
    snprintf(more, sizeof more, "%s%.63s on %.80s",
             self.elsewhere[0]
                 ? ", "
                 : "no process of this host is known to have died: killed or lost on another host, "
                   "or the link to it: ",
             program, host);
    if (strlen(self.elsewhere) + strlen(more) < TEXT / 2)
        append(self.elsewhere, more);
    else if (!strstr(self.elsewhere, " ..."))
        append(self.elsewhere, " ...");
}

/* Only the author of the note, if it is about itself, aborts. All others wait for the launcher's
 * SIGTERM: it comes 1 s after a death and at once after an abort, and a second abort, like the exit
 * of anybody, makes Open MPI 4.1 kill the rest before they can say why. */
_Noreturn void failure_die(int code, const char *reason)
{
    char text[TEXT], note[TEXT];
    self.dying = true;
    alive_end();
    snprintf(text, sizeof text, "%s: %s", self.who, reason);
    const bool first = failure_note(text), noted = failure_read(note, sizeof note);
    if (!noted || strcmp(note, reason) != 0)
        fprintf(stderr, "%s\n", text);
    if (noted && strcmp(note, text) != 0)
        fprintf(stderr, "%s: the job ends: %s\n", self.who, note);
    fflush(NULL);
    if (!first) {
        const struct timespec launcher = {.tv_sec = 2};
        if (nanosleep(&launcher, NULL) != 0) {
            sleep_ms(LAST_WORDS);
            _exit(code);
        }
    }
    sleep_ms(LAST_WORDS / 3);
    MPI_Abort(self.world, code);
    abort();
}

/* exit() without cpl_close. */
static void at_exit(void)
{
    int ready = 0, over = 0;
    MPI_Initialized(&ready);
    MPI_Finalized(&over);
    if (self.open && !self.dying && ready && !over) {
        char text[TEXT] = "left without cpl_close ";
        append(text, self.doing);
        failure_die(EXIT_PARTNER, text);
    }
}

/* MPI_Finalize without cpl_close would wait for the others for ever: the deletion of an attribute
 * of MPI_COMM_SELF is its first act. */
static int at_finalize(MPI_Comm comm, int key, void *value, void *extra)
{
    (void)comm, (void)key, (void)value, (void)extra;
    at_exit();
    return MPI_SUCCESS;
}

/* The launcher's SIGTERM while programs meet, when they have no handlers of their own yet. */
static void on_term(int signal_number)
{
    const bool open = self.open;
    failure_obituary(STDERR_FILENO);
    if (open)
        _exit(EXIT_PARTNER);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

/* Handlers of the program stay. */
static void guard(void)
{
    struct sigaction now;
    if (sigaction(SIGTERM, NULL, &now) == 0 && now.sa_handler == SIG_DFL)
        signal(SIGTERM, on_term);
}

/* Twice in a handshake: by the world's rank first, then by that in the program. */
void failure_open(MPI_Comm world, const char *program, int rank)
{
    static bool hooked;
    self.world = world;
    self.open = true;
    snprintf(self.who, sizeof self.who, "%.63s rank %d", program, rank);
    failure_doing("before the first coupling step");
    if (!hooked) {
        int key;
        hooked = true;
        guard();
        atexit(at_exit);
        MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, at_finalize, &key, NULL);
        MPI_Comm_set_attr(MPI_COMM_SELF, key, NULL);
    }
}

void failure_closed(void)
{
    self.open = false;
    alive_end();
}

/* alive.c - signs of life on disk: each process sets the time of a file of its own, from a thread,
 * so that also one that computes for long is seen to live; who waits looks at the others' files. It
 * finds what failure.c cannot: processes on other hosts, and such as are stopped but not dead. Only
 * changes of the file's time count, judged by this process's own clock, so that clocks of hosts
 * need not agree.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "alive.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "wire.h"

enum { NAME = 64, PATH = 1200, LOOKS = 16, TOUCHES = 8 };

/* Like the death notes of failure.c, of the process: a thread has no other way to it. */
static struct {
    double patience; /* s */
    double looked;   /* s: wire_time of the last look */
    int n;
    struct person {
        char program[NAME];
        int rank;
        struct timespec seen; /* time of its file */
        double at;            /* wire_time at which that was new */
    } * of;
    char dir[PATH - NAME - 32], own[PATH];
    volatile bool open;
    bool threaded;
} self = {.patience = 120.0};

void alive_patience(double s) { self.patience = s; }

/* Before alive_begin, by the handshake. */
void alive_add(const char *program, int rank)
{
    self.of = wire_grow(self.of, (size_t)(self.n + 1) * sizeof *self.of);
    struct person *p = &self.of[self.n++];
    *p = (struct person){.rank = rank};
    snprintf(p->program, sizeof p->program, "%s", program);
}

static void path_of(const char *program, int rank, char *path)
{
    snprintf(path, PATH, "%s/.alive-%.63s-%d", self.dir, program, rank);
}

/* Where the folder is not there yet, no sign is left: the thread tries again. */
void alive_sign(void)
{
    const int fd = open(self.own, O_WRONLY | O_CREAT, 0644);
    if (fd >= 0) {
        futimens(fd, NULL);
        close(fd);
    }
}

/* TOUCHES times within the patience, and every 5 s at the latest. */
static void *touch(void *unused)
{
    (void)unused;
    while (self.open) {
        alive_sign();
        const double s = self.patience / TOUCHES < 5.0 ? self.patience / TOUCHES : 5.0;
        const struct timespec pause = {.tv_sec = (time_t)s,
                                       .tv_nsec = (long)(1e9 * (s - (double)(time_t)s))};
        nanosleep(&pause, NULL);
    }
    return NULL;
}

/* The thread calls neither MPI nor anything of this program, and takes none of its signals. Signals
 * stay blocked in the thread, so that handlers run in the main one. */
void alive_begin(const char *dir, const char *program, int rank)
{
    pthread_t thread;
    sigset_t all, before;
    snprintf(self.dir, sizeof self.dir, "%s", dir);
    path_of(program, rank, self.own);
    self.open = true;
    self.looked = wire_time();
    for (int k = 0; k < self.n; k++)
        self.of[k].at = self.looked;
    if (self.threaded)
        return;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    self.threaded = pthread_create(&thread, NULL, touch, NULL) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (self.threaded)
        pthread_detach(thread);
}

/* The thread ends by itself after its pause. */
void alive_end(void)
{
    if (self.open)
        unlink(self.own);
    self.open = false;
    self.n = 0;
    free(self.of);
    self.of = NULL;
}

/* Any change of the file's time is a sign, whatever that host's clock says. */
static void look(struct person *p, double now)
{
    char path[PATH];
    struct stat s;
    path_of(p->program, p->rank, path);
    if (stat(path, &s) == 0 &&
        (s.st_mtim.tv_sec != p->seen.tv_sec || s.st_mtim.tv_nsec != p->seen.tv_nsec)) {
        p->seen = s.st_mtim;
        p->at = now;
    }
}

/* A look at most LOOKS times within the patience. After a pause of its own this process judges
 * nobody: the others' signs may be older than its last look only because it did not look. */
bool alive_silent(char *text, int size)
{
    const double now = wire_time(), since = now - self.looked;
    if (!self.open || since < self.patience / LOOKS)
        return false;
    const bool paused = since > 0.5 * self.patience; /* no look in between: busy, or suspended */
    self.looked = now;
    for (int k = 0; k < self.n; k++) {
        struct person *p = &self.of[k];
        look(p, now);
        /* a file that never was there lies on another disk: its process cannot be judged */
        if (paused || (p->seen.tv_sec == 0 && p->seen.tv_nsec == 0))
            p->at = now;
        if (now - p->at <= self.patience)
            continue;
        snprintf(text, (size_t)size,
                 "%s rank %d has shown no sign of life for %.0f s (stopped, or its host hangs)",
                 p->program, p->rank, now - p->at);
        return true;
    }
    return false;
}

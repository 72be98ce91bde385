/* timer.h - named timers of a program. They may nest, and then the outer one counts the time of the
 * inner one, too. Local to the rank; the table over ranks is written by run.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>

/* More names than this end the run through abort_run(). */
enum { TIMER_MAX = 48 };
/* All timers of a program; zeroed memory is a valid start. */
struct timers {
    int n; /* timers in use */
    struct timer {
        const char *name; /* borrowed: a literal */
        double wall;      /* s, summed */
        double start;     /* s, wall_time() of the last start */
    } of[TIMER_MAX];
};

/* Starts the timer of this name, making it at the first call. A timer must not be started twice
 * without a stop: the first interval would be lost. */
void timer_start(struct timers *t, const char *name);
/* Adds the time since timer_start to the timer. */
void timer_stop(struct timers *t, const char *name);
double timer_wall(const struct timers *t, const char *name); /* s; 0 if there is none */
double wall_time(void);                                      /* s, monotonic */
double cpu_time(void); /* s of processor time of this process, all its threads */

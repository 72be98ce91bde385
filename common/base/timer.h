/* timer.h - named timers of a program, nested by hand, and their table over the ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_TIMER_H
#define COMMON_TIMER_H

#include <mpi.h>

enum { TIMER_MAX = 48 };
struct timers {
    int n;
    struct timer {
        const char *name; /* borrowed: a literal */
        double wall;      /* s, summed */
        double start;
        long calls;
    } of[TIMER_MAX];
};

/* The timer of this name is made at the first start. */
void timer_start(struct timers *t, const char *name);
void timer_stop(struct timers *t, const char *name);
double timer_wall(const struct timers *t, const char *name); /* s; 0 if there is none */
double wall_time(void);                                      /* s, monotonic */
double cpu_time(void); /* s of processor time of this process, all its threads */

#endif

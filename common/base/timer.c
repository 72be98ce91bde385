/* timer.c - see timer.h. Names are looked up by text, in the order in which they were first
 * started: there are at most TIMER_MAX and they bracket whole parts of a step, so that the search
 * costs nothing against what it measures.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "timer.h"

#include <string.h>
#include <time.h>

#include "log.h"

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double wall_time(void) { return seconds(CLOCK_MONOTONIC); }
double cpu_time(void) { return seconds(CLOCK_PROCESS_CPUTIME_ID); }

static int find(const struct timers *t, const char *name)
{
    int i = 0;
    while (i < t->n && strcmp(t->of[i].name, name) != 0)
        i++;
    return i;
}

static struct timer *timer_of(struct timers *t, const char *name)
{
    const int i = find(t, name);
    if (i == t->n) {
        require(t->n < TIMER_MAX);
        t->of[t->n++] = (struct timer){.name = name};
    }
    return t->of + i;
}

void timer_start(struct timers *t, const char *name) { timer_of(t, name)->start = wall_time(); }

void timer_stop(struct timers *t, const char *name)
{
    struct timer *of = timer_of(t, name);
    of->wall += wall_time() - of->start;
}

double timer_wall(const struct timers *t, const char *name)
{
    const int i = find(t, name);
    return i < t->n ? t->of[i].wall : 0.0;
}

/* watch.h - a figure that stays small in a sound run: a warning above one level, the end of the run
 * above another. Its worst value stands in summary.json. Judged on values that are the same on all
 * ranks. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WATCH_H
#define COMMON_WATCH_H

#include <stdbool.h>
#include <stdint.h>

struct diagnosis;
struct summary;

struct watch {
    const char *key;    /* in summary.json, in group watch: "energy_gain" */
    const char *what;   /* in a sentence: "energy gained over 100 steps, over the kinetic energy" */
    const char *likely; /* cause and remedy */
    double warn, stop;  /* levels; stop INFINITY: warns only */
    double unsound;     /* a run that ends above it is not accepted; 0: warn */
    double now, worst;
    bool warned;
};

/* Takes the value of this moment; warns once above w->warn; above w->stop, or where the value is
 * not finite, fills d (unless it is bad already) and returns true. */
bool watch_judge(struct watch *w, double value, double t, int64_t step, struct diagnosis *d);
/* watch.KEY = the worst value so far. A value that lies above the level of a sound run now, at the
 * end, makes the run one that is not accepted. */
void watch_summary(const struct watch *w, struct summary *s);

/* What an energy has gained over its budget in the last `WATCH_STEPS' steps: energy less the work
 * done on the flow from outside, which only dissipation may change, so that it never rises. */
enum { WATCH_STEPS = 100, WATCH_SLOTS = 32 };
struct watch_budget {
    double least[WATCH_SLOTS]; /* least value in each slot of the last steps */
    int64_t slot[WATCH_SLOTS]; /* which slot it is: step * WATCH_SLOTS / WATCH_STEPS */
    int n;                     /* slots in use */
};

/* Adds energy - work (J) at this step, in rising order of steps, any number of times; returns the
 * gain over the least of the last WATCH_STEPS steps, J, at least 0. */
double watch_budget_gain(struct watch_budget *b, int64_t step, double energy_less_work);

#endif

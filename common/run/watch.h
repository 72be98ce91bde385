/* watch.h - a watch: a figure that stays small in a sound run. Above one level it warns, above
 * another it ends the run; its worst value stands in summary.json. It is judged on values that are
 * equal on all ranks, so that all take the same branch.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stdint.h>

struct diagnosis;
struct summary;

/* One figure with its levels and its history. Texts are borrowed literals. */
struct watch {
    const char *key;    /* in summary.json, in group watch: "energy_gain" */
    const char *what;   /* in a sentence: "energy gained over 100 steps, over the kinetic energy" */
    const char *likely; /* likely cause and remedy, for the message */
    double warn, stop;  /* levels; stop INFINITY: the watch only warns */
    double unsound;     /* a run that ends above it is not accepted; 0: the level warn */
    double now, worst;  /* the last value and the largest so far */
    bool warned;
};

/* Takes the value at time t, s, of this step; warns once above w->warn. Above w->stop, or where the
 * value is NaN, fills d (unless it is bad already) and returns true. */
bool watch_judge(struct watch *w, double value, double t, int64_t step, struct diagnosis *d);
/* Writes watch.KEY, the worst value so far. If the last value lies above w->unsound it also sets
 * the text "not_accepted", unless that is set already. */
void watch_summary(const struct watch *w, struct summary *s);

/* What an energy gained over its budget in the last WATCH_STEPS steps. The budget is the energy
 * minus the work done on the flow from outside; only dissipation may change it, so that it never
 * rises. */
enum { WATCH_STEPS = 100, WATCH_SLOTS = 32 };
/* The minimum of the budget over the last steps, kept per slot of WATCH_STEPS/WATCH_SLOTS steps.
 * Zeroed memory is a valid start. */
struct watch_budget {
    double least[WATCH_SLOTS]; /* J, minimum in each slot */
    int64_t slot[WATCH_SLOTS]; /* which slot it is: step * WATCH_SLOTS / WATCH_STEPS */
    int n;                     /* slots in use */
};

/* Adds energy - work, J, at this step; steps must not decrease, one may come more than once.
 * Returns the rise over the minimum of the last WATCH_STEPS steps, J, at least 0. */
double watch_budget_gain(struct watch_budget *b, int64_t step, double energy_less_work);
/* The same of a rise that has lasted: over that minimum of the least of the last `steps' steps, J,
 * after watch_budget_gain of the last of them. */
double watch_budget_lasting(const struct watch_budget *b, int steps);

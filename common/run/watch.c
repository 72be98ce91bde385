/* watch.c - figures that stay small in a sound run: see watch.h. Called by the programs at the end
 * of a step with a figure that is the same on all ranks. All comparisons are written as !(value <=
 * level), which is true for NaN as well: a figure that is no number is never taken for a small one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "watch.h"

#include "../files/files.h"
#include "program.h"

/* Comparisons are such that a NaN is beyond all bounds. Warned of once. */
bool watch_judge(struct watch *w, double value, double t, int64_t step, struct diagnosis *d)
{
    w->now = value;
    if (!(value <= w->worst))
        w->worst = value;
    const bool stop = !(value <= w->stop);
    if (stop && !d->bad) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason, "%s: %.3g, limit %.3g", w->what, value, w->stop);
        snprintf(d->where, sizeof d->where, "the whole flow, t = %.4g s, step %lld", t,
                 (long long)step);
        snprintf(d->likely, sizeof d->likely, "%s", w->likely);
    } else if (!(value <= w->warn) && !w->warned) {
        char end[48] = "";
        if (isfinite(w->stop))
            snprintf(end, sizeof end, " (the run ends at %.3g)", w->stop);
        log_warn("t = %.4g s, step %lld: %s: %.3g, sound below %.3g%s; %s", t, (long long)step,
                 w->what, value, w->warn, end, w->likely);
        w->warned = true;
    }
    return stop;
}

/* The last value decides about the run, the worst one is only reported: a passing peak, say of an
 * impact, does not spoil a run. */
void watch_summary(const struct watch *w, struct summary *s)
{
    const double sound = w->unsound > 0.0 ? w->unsound : w->warn;
    char text[512];
    snprintf(text, sizeof text, "watch.%s", w->key);
    summary_real(s, text, w->worst);
    if (w->now <= sound || summary_find_text(s, "not_accepted"))
        return;
    snprintf(text, sizeof text, "not sound at the end: %s: %.3g, sound below %.3g; %s", w->what,
             w->now, sound, w->likely ? w->likely : "see the log");
    summary_text(s, "not_accepted", text);
}

/* Instead of the last WATCH_STEPS values it keeps the minimum of each of WATCH_SLOTS slots of them,
 * so that the window's length is right to one slot, about 3 steps. As steps do not decrease, the
 * slots in use are in order and the newest is the last. */
double watch_budget_gain(struct watch_budget *b, int64_t step, double energy_less_work)
{
    const int64_t slot = step * WATCH_SLOTS / WATCH_STEPS;
    int kept = 0;
    for (int k = 0; k < b->n; k++) /* what is older than the window is forgotten */
        if (b->slot[k] > slot - WATCH_SLOTS) {
            b->slot[kept] = b->slot[k];
            b->least[kept++] = b->least[k];
        }
    b->n = kept;
    if (b->n > 0 && b->slot[b->n - 1] == slot) {
        b->least[b->n - 1] = fmin(b->least[b->n - 1], energy_less_work);
    } else {
        b->slot[b->n] = slot;
        b->least[b->n++] = energy_less_work;
    }
    double least = energy_less_work;
    for (int k = 0; k < b->n; k++)
        least = fmin(least, b->least[k]);
    return energy_less_work - least;
}

/* What has been gained for `steps' steps at least: the least of the late slots over the least of
 * all. */
double watch_budget_lasting(const struct watch_budget *b, int steps)
{
    double least = INFINITY, late = INFINITY;
    for (int k = 0; k < b->n; k++) {
        least = fmin(least, b->least[k]);
        if (b->slot[k] > b->slot[b->n - 1] - (steps * WATCH_SLOTS + WATCH_STEPS - 1) / WATCH_STEPS)
            late = fmin(late, b->least[k]);
    }
    return b->n > 0 ? late - least : 0.0;
}

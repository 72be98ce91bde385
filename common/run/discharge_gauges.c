/* discharge_gauges.c - see discharge_gauges.h. A gauge's column is the volume per time through it,
 * m^dim/s, positive along its normal. Called by run.c on rank 0 at the end of a run, after the last
 * row of series.csv is written.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "discharge_gauges.h"

/* Volume of both signs between two rows, linear between them. Of a change of sign between rates a
 * and b after the share a/(a - b) of the interval, each side of it is a triangle. volume[0] is what
 * went forward, volume[1] what came back, both positive. */
static void add_interval(double dt, double a, double b, double volume[2])
{
    if (a * b >= 0.0) {
        volume[a + b < 0.0] += 0.5 * dt * fabs(a + b);
        return;
    }
    const double share = a / (a - b);
    volume[a < 0.0] += 0.5 * dt * share * fabs(a);
    volume[b < 0.0] += 0.5 * dt * (1.0 - share) * fabs(b);
}

/* Sums one gauge over all rows and reports it; v[-ncolumns] is the row before. */
static void judge_one(const struct scene *s, const struct scene_probe *g, bool means,
                      const struct table *t, struct summary *summary)
{
    const int column = table_column(t, g->name);
    static const char *const what[] = {"volume", "forward", "back", "largest"};
    double volume[2] = {0.0, 0.0}, largest = 0.0;
    for (int row = 0; row < t->nrows && column >= 0; row++) {
        const double *v = t->v + (size_t)row * t->ncolumns;
        largest = fmax(largest, fabs(v[column]));
        if (row > 0 && isfinite(v[column] + v[column - t->ncolumns])) /* nan: before a restart */
            add_interval(v[0] - v[-t->ncolumns], v[means ? column : column - t->ncolumns],
                         v[column], volume);
    }
    const double all[] = {volume[0] - volume[1], volume[0], volume[1], largest};
    for (int k = 0; k < 4 && column >= 0; k++)
        summary_real(summary, key_text("discharge.%s.%s", g->name, what[k]), all[k]);

    if (column >= 0)
        log_say("discharge  %s: %.4g m^%d in all, %.4g onward and %.4g back, at most %.3g m^%d/s",
                g->name, all[0], s->domain.dim, all[1], all[2], largest, s->domain.dim);
}

void discharge_gauges_judge(const struct scene *s, bool means, const char *path,
                            struct summary *summary)
{
    struct table *t = probe_any(s, PROBE_DISCHARGE) ? table_read(path) : NULL;
    for (int k = 0; t && k < s->nprobes; k++)
        if (s->probes[k].kind == PROBE_DISCHARGE)
            judge_one(s, s->probes + k, means, t, summary);
    FREE(t);
}

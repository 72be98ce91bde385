/* sums.c - sums over the whole flow at the end of every coupling step, each program adding its own
 * part: series.csv of the job, and what an oscillation with an exact solution shows at the end.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

#include "../../common/scene/scene.h"

enum { KINETIC, POTENTIAL, ENSTROPHY, SIGNAL, WATER, SUMS }; /* WATER: where both have a surface */

struct server_sums {
    struct series *file;
    struct fit fit;
    double now[SUMS];
};

static const char *const keys[SUMS] = {"sum.kinetic", "sum.potential", "sum.enstrophy",
                                       "sum.signal", "sum.water"};
static const char *const columns[] = {
    "t [s]",      "kinetic energy [J]", "potential energy [J]", "enstrophy [m^dim/s^2]",
    "signal [-]", "water [m^dim]"};

/* False if no program told this. */
static bool add_up(const struct coupler *c, const char *key, double *sum)
{
    bool any = false;
    *sum = 0.0;
    for (int i = 0; i < c->nsolvers; i++)
        for (int k = 0; k < c->solver[i].told.n; k++)
            if (strcmp(c->solver[i].told.of[k].key, key) == 0) {
                *sum += c->solver[i].told.of[k].value;
                any = true;
            }
    return any;
}

/* A key counts only if all keys before it were told; the file begins with the first coupling step
 * at whose end the energies and the signal are there. */
void sums_window(struct coupler *c)
{
    const double t = window_start(c, c->window);
    struct server_sums *s = c->sums;
    double row[1 + SUMS] = {t};
    int n = 0;
    while (n < SUMS && add_up(c, keys[n], row + 1 + n))
        n++;
    if (n < WATER)
        return;
    if (!s) {
        char path[1100];
        snprintf(path, sizeof path, "%s/series.csv", c->dir);
        s = c->sums = NEW(struct server_sums, 1);
        s->file = mem_own(s, series_create(path, c->scene.domain.dim, 1 + n, columns,
                                           c->command->restart, window_start(c, c->window - 1)));
    }
    memcpy(s->now, row + 1, sizeof s->now);
    series_row(s->file, row);
    if (c->scene.initial.field == FIELD_STANDING_WAVE) /* its history is for a fit at the end */
        fit_add(s, &s->fit, t, s->now[SIGNAL]);
}

/* For a standing wave over both programs: period and damping from the signal's history, enstrophy
 * at the end, each against the exact solution. */
void sums_summarise(const struct coupler *c, struct summary *to)
{
    const struct exact e = exact_create(&c->scene);
    const struct scene_domain *d = &c->scene.domain;
    double period, rate;
    if (!c->sums || c->scene.nbodies > 0 || e.field != FIELD_STANDING_WAVE ||
        !exact_oscillation(&e, &period, &rate))
        return;
    exact_summarise_oscillation(&c->sums->fit, period, rate, to);
    const double enstrophy = c->sums->now[ENSTROPHY];
    summary_real(to, "enstrophy", enstrophy);
    summary_real(
        to, "error.enstrophy",
        fabs(enstrophy / exact_enstrophy(&e, d->min, d->max, window_start(c, c->window)) - 1.0));
}

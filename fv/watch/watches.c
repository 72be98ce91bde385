/* watches.c - levels of the watches of fv, and how their figures are made; README.md has what they
 * were measured against. A watch (common/run/watch.h) has a figure, a level of warning, one that
 * ends the run and one above which it is not accepted at its end. fv_watches.c measures, this file
 * scales and judges; no reductions here.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "watches.h"

#include "../../common/files/files.h"
#include "limits.h"

enum { WATCHES = 5 };

/* Warning level of odd-even waves with a surface, whose jets and films are thinner than cells. */
#define SPRAY 0.10
/* With a surface: an impact whose jets are thinner than cells rises to 0.1 and falls back within
 * some steps; in a run that blows up, and in water at rest that grows, most of the energy comes
 * from nowhere. */
#define MOST_OF_IT 0.7
/* Of the volume: from here on the run is not accepted. */
#define RETURNED_MOST 0.05

static const struct watch kinds[WATCHES] = {
    {.key = "energy_gain",
     .what = "kinetic energy gained beyond what came in, over 100 steps",
     .warn = 0.01,
     .stop = 0.10},
    {.key = "odd_even_velocity",
     .what = "odd-even (two-cell) waves of velocity, over the velocity",
     .warn = 0.04,
     .stop = INFINITY},
    {.key = "odd_even_pressure",
     .what = "odd-even (two-cell) waves of pressure, over the pressure (at least rho u^2/20)",
     .likely = "the flow is finer than the cells: more cells; pressures near there are not to be "
               "trusted",
     .warn = 0.20,
     .stop = INFINITY,
     .unsound = 0.40}, /* at the warning it is a place or two that the cells are too wide for */
    {.key = "growth",
     .what = "largest velocity over that of the step before",
     .likely = "what drives the flow begins suddenly, or it is unstable: fv.cfl at half its value "
               "tells which",
     .warn = 1.25,
     .stop = INFINITY,
     .unsound = INFINITY}, /* of one step: that it was the last one says nothing */
    {.key = "volume_returned",
     .what = "volume that the level set lost and that was restored elsewhere",
     .likely = "water thinner than a cell: more cells",
     .warn = 0.01,
     .stop = INFINITY,
     .unsound = RETURNED_MOST}};

static const char *const names[WATCHES] = {"energy gain [-]", "odd-even velocity [-]",
                                           "odd-even pressure [-]", "growth [-]",
                                           "volume put back [-]"};

/* The k-th watch; NULL: this scene has it not. The order is that of kinds and names. */
static const struct watch *watch_of(const struct watches *w, int k)
{
    const struct watch *const all[WATCHES] = {&w->energy, &w->velocity, &w->pressure, &w->growth,
                                              &w->returned};
    const bool has[WATCHES] = {w->has_energy, true, true, w->has_growth, w->has_surface};
    return has[k] ? all[k] : NULL;
}

/* A bias is no advice where there is one already; newton has another than the others. */
static void advise(struct watches *w, const struct fv_params *p)
{
#define FINER "the flow is finer than the cells: more cells or viscosity"
#define EITHER                                                                                     \
    "fv.cfl at half its value tells whether the step or the cells are too large for this flow; "   \
    "more cells or viscosity"
    static const char *const finer[] = {FINER, FINER ", or fv.upwind = 1",
                                        FINER ", or fv.flux = \"upwind\""};
    static const char *const either[] = {EITHER, EITHER ", or fv.upwind = 1",
                                         EITHER ", or fv.flux = \"upwind\""};
    int k = p->upwind > 0.0 ? 0 : 1;
    if (p->integrator == INTEGRATOR_NEWTON)
        k = p->flux == FLUX_UPWIND ? 0 : 2;
    w->energy.likely = either[k];
    w->velocity.likely = finer[k];
}

/* Where a flow starts against openings the pressure is singular in corners, and its work there is
 * known to some tenths of the kinetic energy only: a warning at ten times the level, no end. */
void watches_open(struct watches *w)
{
    w->energy.warn = 0.1;
    w->energy.stop = INFINITY;
}

/* Levels that depend on the scene: surface, openings, walls. speed and damping are the scales of
 * scale_of. */
struct watches *watches_create(const struct run *r, const struct fv_params *p, bool periodic,
                               bool surface)
{
    struct watches *w = NEW(struct watches, 1);
    struct watch *const all[WATCHES] = {&w->energy, &w->velocity, &w->pressure, &w->growth,
                                        &w->returned};
    for (int k = 0; k < WATCHES; k++)
        *all[k] = kinds[k];
    advise(w, p);
    if (surface) {
        w->velocity.warn = SPRAY;
        w->energy.stop = MOST_OF_IT;
    }
    for (int k = 0; k < r->scene.nwalls; k++)
        if (r->scene.walls[k].kind >= WALL_INFLOW)
            watches_open(w);
    double L = INFINITY;
    for (int a = 0; a < r->scene.domain.dim; a++)
        L = fmin(L, r->scene.domain.max[a] - r->scene.domain.min[a]);
    w->speed = limits_reference(r);
    w->damping = 10.0 * r->scene.fluid.nu / (L * L);
    w->periodic = periodic;
    w->has_surface = surface;
    w->least = 1e-9;
    w->least_square = 1e-4;
    w->sound = r->coupled ? 0.1 * w->speed : 0.0;
    w->energy_every = 10;
    w->waves_every = 50;
    return w;
}

bool watches_want_energy(const struct watches *w, int64_t step)
{
    return w->has_energy && step % w->energy_every == 0;
}

bool watches_want_waves(const struct watches *w, int64_t step)
{
    return step % w->waves_every == 0;
}

/* What a gain is measured by: the energy there is. A flow that oscillates between kinetic energy
 * and that of height has the largest that it had of either. One between walls or openings has at
 * least what its scene's velocity makes, for a sudden start, whose layers are thinner than a cell,
 * has no budget to the percent of the little energy of its first steps; and what viscosity turns
 * over in those steps, whose pressure is not known to the percent of that either. */
static double scale_of(const struct watches *w, const struct flow_energy *e, double energy,
                       double time)
{
    const double whole = 0.5 * e->volume * w->speed * w->speed;
    if (w->periodic)
        return fmax(energy, 1e-6 * whole);
    if (w->has_surface)
        return fmax(fmax(w->kinetic_most, w->work_most - w->work_least), w->least * whole);
    return fmax(energy, whole) * (1.0 + w->damping * time);
}

/* Steps for which a gain with a surface must last to count. Cells whose centre is dry have a share
 * of the water, and their velocity is extrapolated: in jets and films that is a tenth of the
 * energy, which comes and goes within some steps (7 % of the energy where waves break over a dyke).
 */
#define LASTING 25

/* In a periodic domain the energy about the mean flow, which no force even in space changes; else
 * all of it less the work of sides and gravity, by the trapezoidal rule between looks. With a
 * surface no more than what the kinetic energy has risen to beyond its largest before: gravity's
 * work on waves of a few cells oscillates by half of their energy, grow or not. The first 100 steps
 * of a run or of a restart with a surface have no scale yet and are not judged, nor is what the
 * kinetic energy rises by within them: all of a wave that starts from rest. */
void watches_energy(struct watches *w, const struct flow_energy *e, double t, int64_t step,
                    struct diagnosis *d)
{
    double energy = e->kinetic;
    for (int a = 0; w->periodic && a < 3; a++)
        energy -= 0.5 * e->momentum[a] * e->momentum[a] / e->volume;
    const double since = w->looks++ > 0 ? t - w->t : 0.0;
    if (!w->periodic)
        w->work += 0.5 * since * (w->power + e->power);
    w->power = e->power;
    w->t = t;
    w->work_least = fmin(w->work_least, w->work);
    w->work_most = fmax(w->work_most, w->work);
    w->kinetic_most = fmax(w->kinetic_most, e->kinetic);
    w->balance = energy - w->work;
    double gain = watch_budget_gain(&w->budget, step, w->balance);
    const double scale = scale_of(w, e, energy, since * WATCH_STEPS / w->energy_every);
    if (w->has_surface && w->looks < WATCH_STEPS)
        return;
    if (w->has_surface)
        gain = fmin(gain, watch_budget_gain(&w->peaks, step, w->kinetic_most));
    if (w->has_surface && gain <= w->energy.stop * scale) /* what is not most of it may be a jet */
        gain = fmin(gain, watch_budget_lasting(&w->budget, LASTING));
    watch_judge(&w->energy, scale > 0.0 ? gain / scale : gain, t, step, d);
}

/* Over the flow's root mean square; of pressure over its own about the mean, or a twentieth of the
 * mean of u^2 where pressure hardly varies. A flow that oscillates is at rest now and then, and has
 * no pressure when it is fastest, and looks may meet it there several times: of both squares nine
 * tenths of what counted at the look before count still. */
void watches_waves(struct watches *w, const struct flow_waves *v, double volume, double t,
                   int64_t step, struct diagnosis *d)
{
    if (t > w->waves_t) /* not where the end looks once more */
        w->waves_before = w->waves;
    w->waves.velocity_all = fmax(v->velocity_all, 0.9 * w->waves_before.velocity_all);
    w->waves.pressure_all = fmax(v->pressure_all, 0.9 * w->waves_before.pressure_all);
    w->waves_t = t;
    const double all = fmax(w->waves.velocity_all, w->least_square * volume * w->speed * w->speed),
                 mean = sqrt(all / fmax(volume, 1e-300)),
                 least = fmax(0.05 * mean, w->sound) * mean * sqrt(volume);
    watch_judge(&w->velocity, sqrt(v->velocity / fmax(all, 1e-300)), t, step, d);
    watch_judge(&w->pressure,
                sqrt(v->pressure / fmax(fmax(w->waves.pressure_all, least * least), 1e-300)), t,
                step, d);
}

/* From the seventh step on: a start from rest grows. */
void watches_growth(struct watches *w, double sum, double t, int64_t step, struct diagnosis *d)
{
    const double before = fmax(w->sum_before, 0.1 * w->speed);
    if (w->has_growth && step > 6)
        watch_judge(&w->growth, sum / before, t, step, d);
    w->sum_before = sum;
}

void watches_row(const struct watches *w, struct figures *to)
{
    for (int k = 0; k < WATCHES; k++)
        if (watch_of(w, k))
            FIGURE(to, watch_of(w, k)->now, "%s", names[k]);
}

/* The volume restored is a condition of acceptance with a text of its own. */
void watches_summarise(const struct watches *w, struct summary *to)
{
    for (int k = 0; k < WATCHES; k++)
        if (watch_of(w, k))
            watch_summary(watch_of(w, k), to);
    if (w->has_surface && !(w->returned.worst < RETURNED_MOST))
        summary_text(to, "not_accepted",
                     "5 % of the volume or more was lost by the level set and restored elsewhere: "
                     "more cells");
}

/* With the last looks, which stand in the series until the next ones. */
void watches_restart(struct watches *w, struct h5 *f)
{
    struct watch *const all[WATCHES] = {&w->energy, &w->velocity, &w->pressure, &w->growth,
                                        &w->returned};
    for (int k = 0; k < WATCHES; k++)
        if (watch_of(w, k)) {
            (void)h5_keep(f, all[k]->key, &all[k]->worst);
            (void)h5_keep(f, key_text("%s_now", all[k]->key), &all[k]->now);
        }
    (void)h5_keep(f, "odd_even_velocity_all", &w->waves.velocity_all);
    (void)h5_keep(f, "odd_even_pressure_all", &w->waves.pressure_all);
    (void)h5_keep(f, "odd_even_t", &w->waves_t);
}

/* sph_errors.c - sums, errors against the exact solution, drifts: rows of the series and the
 * summary. Norms are weighted with the particles' volumes and taken over the free zone. Every
 * function that sums is collective.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "../bodies/sph_bodies.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../sph.h"
#include "../time/sph_time.h"
#include "../walls/sph_walls.h"
#include "opening_columns.h"
#include "probes.h"
#include "sph_output.h"

/* The last: of the velocity, over the particles whose support a wall cuts; not over programs. */
enum { NORM_VELOCITY, NORM_PRESSURE, NORM_VORTICITY, NORM_WALL, NORMS };

static const char *const norm_names[NORM_WALL] = {"velocity", "pressure", "vorticity"};

/* In 2D whether a wall lies within R of x. */
static bool cut_by_wall(const struct sph *s, const double *x)
{
    return s->dim == 2 && s->walls && walls_distance(s->walls, x, s->R) < s->R;
}

/* Adds one particle to the norms of velocity, pressure, vorticity (in 3D its z component).
 * Pressures are compared as they are, without removing their mean; the summary does so. */
static void add_errors(const struct sph *s, const struct exact *e, int i, struct norm *n)
{
    const int dim = s->dim;
    const double *q = prim_line(&s->p, i), w = q[at_volume(dim)];
    const double x[3] = {q[0], q[1], dim == 3 ? q[2] : 0.0};
    double u[3], p, vort, omega[3];
    exact_point(e, x, s->t, u, &p, &vort);
    sph_vorticity(s, i, omega);
    for (int a = 0; a < dim; a++)
        norm_add(n, w, q[dim + a] - u[a], u[a]);
    for (int a = 0; a < dim && cut_by_wall(s, x); a++)
        norm_add(n + NORM_WALL, w, q[dim + a] - u[a], u[a]);
    norm_add(n + 1, w, eos_p(q[at_rho(dim)], s->rho0, s->c0, s->gamma) - p, p);
    norm_add(n + 2, w, omega[2] - vort, vort);
}

/* Norms over the flowing particles of the free zone of all levels and ranks, at s->t. Needs prim
 * and slope of the present state. Collective. */
static void errors(const struct sph *s, struct norm n[NORMS])
{
    const struct exact e = exact_create(&s->run->scene);
    for (int k = 0; k < NORMS; k++)
        n[k] = (struct norm){0};
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i) && (!s->zones || q->p.zone[i] == ZONE_FREE))
                add_errors(q, &e, i, n);
    norm_reduce(n, NORMS, s->run->comm);
}

/* Kinetic energy that the particles would have with the exact velocities. The reference of
 * drift.energy, so that the error of positions does not count. */
static double exact_kinetic(const struct sph *s)
{
    const struct exact e = exact_create(&s->run->scene);
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i);
            const double x[3] = {y[0], y[1], s->dim == 3 ? y[2] : 0.0};
            const double share = particles_share(q, y);
            double u[3];
            exact_point(&e, x, s->t, u, NULL, NULL);
            for (int a = 0; a < s->dim; a++)
                sum += 0.5 * share * y[at_mass(s->dim)] * u[a] * u[a];
        }
    return ranks_sum(s->run->comm, sum);
}

/* What particle i counts where levels meet; own: times the share that no partner counts. */
static double share_of(const struct sph *s, int i, bool own)
{
    return particles_share(s, state_row(&s->p, s->p.y, i)) * (own ? zones_share(s, i) : 1.0);
}

/* sum of w |curl u|^2/2, m^dim/s^2. Needs the gradients of the present state. Collective. */
static double enstrophy(const struct sph *s, bool own)
{
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double share = share_of(q, i, own);
            double w[3];
            sph_vorticity(q, i, w);
            sum += 0.5 * share * prim_line(&q->p, i)[at_volume(s->dim)] *
                   (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        }
    return ranks_sum(s->run->comm, sum);
}

/* Smallest distance where ghosts of walls or the lattice behind open sides must not count. As
 * neighbours_least, one pair at a time. */
static double least_among_particles(const struct sph *s)
{
    const struct neighbours *l = s->list;
    const int real = s->p.n + s->p.nhalo;
    double least = s->R * s->R;
    for (int i = 0; i < s->p.n; i++) {
        const double *x = prim_line(&s->p, i);
        const int *j = l->j + l->start[i];
        for (int k = l->tail[i]; k < l->count[i]; k++) {
            const double r2 = vec_distance2(s->dim, x, prim_line(&s->p, j[k]));
            least = j[k] < real && r2 < least ? r2 : least;
        }
    }
    return sqrt(least);
}

/* Smallest distance of two particles of a level over its dx; needs the list of the present places.
 */
static double least_spacing(const struct sph *s)
{
    double least = INFINITY;
    for (const struct sph *q = s; q; q = q->finer) {
        const bool all = q->p.nghost == q->p.nhalo;
        least = fmin(least, (all ? neighbours_least(q) : least_among_particles(q)) / q->dx);
    }
    return ranks_min(s->run->comm, least);
}

/* Sum over all ranks. Collective. */
static double total(const struct sph *s, double v) { return ranks_sum(s->run->comm, v); }

/* What flows, of all levels and ranks. Collective. */
static double particles(const struct sph *s)
{
    double n = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            n += !particles_is_guard(&q->p, i);
    return total(s, n);
}

/* Particles returned from behind walls so far, of all levels and ranks. Collective. */
static double returned(const struct sph *s)
{
    double n = 0.0;
    for (const struct sph *q = s; q && q->walls; q = q->finer)
        n += (double)q->walls->returned;
    return total(s, n);
}

/* Particles created at openings so far, all ranks. */
static double births(const struct sph *s) { return total(s, (double)s->zones->openings->born); }
/* Particles removed at openings so far, all ranks. */
static double removals(const struct sph *s) { return total(s, (double)s->zones->openings->gone); }

/* The modal amplitude that the oscillation of the exact field shows in the momenta: sum of m
 * exact_signal(x, u). Collective. */
static double signal_now(const struct sph *s, const struct exact *e, bool own)
{
    const int dim = s->dim;
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i), m = y[at_mass(dim)];
            const double u[3] = {y[dim] / m, y[dim + 1] / m, dim == 3 ? y[dim + 2] / m : 0.0};
            sum += share_of(q, i, own) * m * exact_signal(e, y, u);
        }
    return total(s, sum);
}

/* Sums of the part that is sph's own, for the coupler's totals over all programs. A force along a
 * period has no potential. */
void sph_tell(void *state, struct summary *report)
{
    struct sph *s = state;
    const struct exact e = exact_create(&s->run->scene);
    const int dim = s->dim;
    double kinetic = 0.0, potential = 0.0, water = 0.0, g[3];
    (void)scene_still_gravity(&s->run->scene, g);
    integrate_gradients(s);
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            const double *y = state_row(&q->p, q->p.y, i), m = y[at_mass(dim)];
            const double part = share_of(q, i, true);
            water += part * m / s->rho0;
            for (int a = 0; a < dim; a++) {
                kinetic += part * 0.5 * y[dim + a] * y[dim + a] / m;
                potential -= part * m * g[a] * y[a];
            }
        }
    summary_real(report, "sum.kinetic", total(s, kinetic));
    summary_real(report, "sum.potential", total(s, potential));
    summary_real(report, "sum.enstrophy", enstrophy(s, true));
    summary_real(report, "sum.signal", signal_now(s, &e, true));
    if (s->run->crossed)
        summary_real(report, "sum.water", total(s, water));
}

/* Whether the exact field oscillates, so that period and damping can be fitted. */
static bool has_signal(const struct run *r)
{
    return r->scene.initial.field == FIELD_STANDING_WAVE || r->scene.initial.field == FIELD_DROP;
}

/* Adds the present amplitude to the samples; once per row. */
static void sample_signal(struct sph *s)
{
    const struct exact e = exact_create(&s->run->scene);
    if (has_signal(s->run))
        fit_add(s, &s->total.signal_fit, s->t, signal_now(s, &e, false));
}

/* Period, damping and enstrophy against the exact ones; of a coupled job by the coupler. */
static void summarise_oscillation(struct sph *s)
{
    const struct exact e = exact_create(&s->run->scene);
    double period, rate;
    if (s->run->coupled || s->run->scene.nbodies > 0 || !has_signal(s->run) ||
        !exact_oscillation(&e, &period, &rate))
        return;
    sample_signal(s);
    struct summary *to = s->run->summary;
    exact_summarise_oscillation(&s->total.signal_fit, period, rate, to);
    if (e.field == FIELD_STANDING_WAVE && s->nu > 0.0)
        summary_real(to, "error.enstrophy",
                     fabs(enstrophy(s, false) / exact_enstrophy(&e, s->lo, s->hi, s->t) - 1.0));
}

/* Of each level what flows and its guards; what the change of levels has made or lost of mass.
 * Methods with particles of mixed sizes have no levels. Two reductions for each level. */
static void levels_row(const struct sph *s, struct figures *to)
{
    for (const struct sph *q = s; q; q = q->finer) {
        int guards = 0;
        for (int i = 0; i < q->p.n; i++)
            guards += particles_is_guard(&q->p, i);
        FIGURE(to, total(s, q->p.n - guards), "particles level %d [-]", q->level);
        FIGURE(to, total(s, guards), "guards level %d [-]", q->level);
    }
    FIGURE(to, total(s, s->refinement->added), "mass of level changes [kg]");
}

static double velocity_error(const struct sph *s)
{
    struct norm n[NORMS];
    errors(s, n);
    return norm_relative_l2(n);
}

/* What is measured from row to row. */
static void sample(struct sph *s)
{
    sample_signal(s);
    probes_sample(s);
}

/* Slopes are made first (integrate_gradients), by all ranks. In this order: sums over the fluid,
 * extremes, watches, the error, levels, zones, openings, gauges and bodies. */
void sph_row(void *state, struct figures *to)
{
    struct sph *s = state;
    double sums[SUM_COUNT] = {0.0};
    if (to->measures) {
        integrate_gradients(s);
        timer_start(&s->run->timers, "output");
        sph_sums(s, sums);
    }
    FIGURE(to, sums[SUM_KINETIC], "kinetic energy [J]");
    FIGURE(to, enstrophy(s, false), "enstrophy [m^dim/s^2]");
    FIGURE(to, sums[SUM_MASS], "mass [kg]");
    for (int a = 0; a < s->dim; a++)
        FIGURE(to, sums[SUM_MOMENTUM + a], "momentum %c [kg m/s]", "xyz"[a]);
    FIGURE(to, s->step.max_speed / s->c0, "max Mach [-]");
    FIGURE(to, s->step.rho_min, "min density [kg/m^3]");
    FIGURE(to, s->step.rho_max, "max density [kg/m^3]");
    FIGURE(to, particles(s), "particles [-]");
    FIGURE(to, least_spacing(s), "min spacing [dx]");
    sph_watch_row(s, to);
    if (exact_until_end(&s->run->scene))
        FIGURE(to, velocity_error(s), "error velocity l2 [-]");
    if (s->finer)
        levels_row(s, to);
    if (s->zones) {
        FIGURE(to, births(s), "born [-]");
        FIGURE(to, removals(s), "gone [-]");
    }
    opening_row(s, to);
    probes_row(s, to);
    if (to->measures) {
        sample(s);
        timer_stop(&s->run->timers, "output");
    }
}

/* error.*_l2 are relative to the exact field's norm, *_rms to the case's U or rho U^2; pressures
 * without their mean, which is reported apart as the offset. */
static void summarise_errors(const struct sph *s)
{
    struct summary *to = s->run->summary;
    struct norm n[NORMS];
    const double U = s->run->scene.initial.U, scale = s->rho0 * U * U;
    errors(s, n);
    summary_real(to, "error.velocity_l2", norm_relative_l2(n));
    summary_real(to, "error.velocity_linf", n[0].emax / U);
    summary_real(to, "error.velocity_rms", sqrt(s->dim) * norm_rms(n) / U);
    if (n[NORM_WALL].vol > 0.0)
        summary_real(to, "error.velocity_wall", sqrt(s->dim) * norm_rms(n + NORM_WALL) / U);
    if (n[1].r2 > 0.0)
        summary_real(to, "error.pressure_l2", norm_rms_mean_free(n + 1) / sqrt(n[1].r2 / n[1].vol));
    summary_real(to, "error.pressure_rms", norm_rms_mean_free(n + 1) / scale);
    summary_real(to, "error.pressure_offset", norm_mean(n + 1) / scale);
    if (n[2].r2 > 0.0)
        summary_real(to, "error.vorticity_l2", norm_relative_l2(n + 2));
    const double units[] = {U, scale};
    for (int k = 0; s->run->coupled && k < NORM_WALL; k++)
        norm_tell(to, norm_names[k], n + k, k < 2 ? units[k] : 0.0);
}

/* m^2/s^2: of a fluid at the lowest point of the domain, so that energies do not depend on where
 * the origin is. */
static double lowest_potential(const struct sph *s)
{
    double least = 0.0;
    for (int a = 0; a < s->dim; a++)
        if (!s->periodic[a])
            least -= fmax(s->gravity[a] * s->lo[a], s->gravity[a] * s->hi[a]);
    return least;
}

/* Energy: kinetic against the exact one where that is known, else all kinds against the start,
 * measured from the lowest point. */
static void summarise_drifts(const struct sph *s)
{
    struct summary *to = s->run->summary;
    double sums[SUM_COUNT], region = 1.0, p2 = 0.0, energy;
    const bool given = !s->run->params || params_given(s->run->params, "initial.U");
    const double U = given ? s->run->scene.initial.U : s->watch.reference;
    sph_sums(s, sums);
    for (int a = 0; a < s->dim; a++) {
        region *= s->hi[a] - s->lo[a];
        p2 += pow(sums[SUM_MOMENTUM + a] - s->start.momentum[a], 2.0);
    }
    if (exact_until_end(&s->run->scene)) {
        const double expected = exact_kinetic(s);
        energy = (sums[SUM_KINETIC] - expected) / expected;
    } else {
        const double least = lowest_potential(s), start = s->start.energy - s->start.mass * least;
        const double now = sums[SUM_ENERGY] - sums[SUM_MASS] * least;
        energy = (now - start) / fmax(fabs(start), 0.5 * s->start.mass * U * U);
    }
    summary_real(to, "drift.mass", sums[SUM_MASS] / s->start.mass - 1.0);
    summary_real(to, "drift.energy", energy);
    summary_real(to, "drift.momentum", sqrt(p2) / (s->start.mass * U));
    if (s->start.volume > 0.0 || !(s->surface || (s->walls && s->walls->nsegments > 0)))
        summary_real(to, "drift.volume", /* of what the fluid fills */
                     sums[SUM_VOLUME] / (s->start.volume > 0.0 ? s->start.volume : region) - 1.0);
}

/* Pairs over the processor time of the stages: a loaded machine counts for nothing. Timers count
 * wall time; cpu/wall over all steps turns it into processor time. */
static double pair_rate(const struct sph *s)
{
    static const char *const stage[] = {"list",  "gradients", "rates",   "halo",   "update",
                                        "zones", "walls",     "surface", "levels", "guards"};
    double time = 0.0;
    for (size_t k = 0; k < sizeof stage / sizeof stage[0]; k++)
        time += timer_wall(&s->run->timers, stage[k]);
    time = total(s, time);
    time *= total(s, s->total.cpu_s) / fmax(total(s, s->total.wall_s), 1e-300);
    return time > 0.0 ? total(s, (double)s->total.pairs) / time : 0.0;
}

/* Names of the parts that this run was made of, in the order in which they act on a pair. */
static void summarise_modules(const struct sph *s)
{
    static const char *const limiters[] = {"koren", "minmod", "none"};
    static const char *const transports[] = {"tvs", "tvo", "none", "eulerian", "xsph"};
    const bool riemann = sph_params_is_riemann(s->prm.scheme);
    const char *names[16];
    int n = 0;
    names[n++] = s->scheme->name;
    if (riemann)
        names[n++] = limiters[s->prm.limiter];
    names[n++] = transports[s->prm.transport];
    if (s->nu > 0.0)
        names[n++] = s->prm.viscosity == VISCOSITY_MORRIS ? "morris" : "monaghan";
    if (riemann && s->prm.low_dissipation)
        names[n++] = "low_dissipation";
    if (riemann && s->prm.damper > 0.0)
        names[n++] = "damper";
    if (s->walls)
        names[n++] = s->walls->model->name;
    if (s->surface)
        names[n++] = "free_surface";
    if (s->prm.background)
        names[n++] = "background";
    if (s->zones)
        names[n++] = "zones";
    if (s->finer)
        names[n++] = "refinement";
    summary_texts(s->run->summary, "modules", n, names);
}

/* The summary's order is that of this function. Collective. */
void sph_finish(void *state)
{
    struct sph *s = state;
    struct summary *to = s->run->summary;
    const double rate = pair_rate(s); /* before the passes below */
    integrate_gradients(s);
    summarise_modules(s);
    scene_meshes_summary(&s->run->scene, to);
    summary_int(to, "particles", llround(particles(s)));
    if (s->walls)
        summary_int(to, "particles_returned", llround(returned(s)));
    summary_int(to, "particles_lost", llround(total(s, s->total.lost)));
    if (exact_until_end(&s->run->scene))
        summarise_errors(s);
    summarise_oscillation(s);
    if (s->walls)
        forces_summarise(s);
    bodies_summarise(s);
    if (s->dim == 2 && s->prm.extrema[0] != 0.0)
        sph_summarise_extrema(s);
    summarise_drifts(s);
    if (s->finer)
        summary_real(to, "levels.mass", total(s, s->refinement->added) / s->start.mass);
    if (s->run->size > 1)
        summary_real(to, "balance.tau", domain_tau(s->domain));
    summary_real(to, "max_mach", s->total.max_mach);
    summary_real(to, "max_mach_late", s->total.mach_late);
    summary_real(to, "spacing.min", least_spacing(s));
    summary_real(to, "pairs_per_s", rate);
    sph_watch_summarise(s);
    if (s->zones) {
        summary_real(to, "mass_fluctuation", s->total.fluctuation);
        summary_real(to, "mass_fluctuation_particles", s->total.fluctuation_particles);
        summary_int(to, "born", llround(births(s)));
        summary_int(to, "gone", llround(removals(s)));
        if (s->zones->update)
            sides_summarise(s);
    }
    opening_summary(s, to);
}

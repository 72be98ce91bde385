/* fv_report.c - rows of the series (fv_row) and the summary (fv_finish), both collective; what
 * outputs keep from row to row. SPDX-License-Identifier: BSD-3-Clause */
#include "output.h"

#include "../../common/scene/scene.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"
#include "../time/fv_time.h"
#include "../watch/fv_watch.h"
#include "mesh_output.h"

/* The search of blocks for gauges is made once; blocks that move are searched in their own frame
 * (overset_search.c). */
struct fv_output *output_create(const struct fv *s)
{
    struct fv_output *o = NEW(struct fv_output, 1);
    o->begun = s->run->step;
    if (s->m && s->run->scene.nprobes > 0) {
        o->search = mem_own(o, overset_search(s->run, s->m));
        o->samples = NEW_IN(o, struct block_samples, s->run->scene.nprobes);
        o->faces = NEW_IN(o, struct face_weights, s->run->scene.nprobes);
    }
    return o;
}

/* For the description of the run. */
const char *report_method(const struct fv_params *prm)
{
    static const char *const integrators[] = {"rk3, three projections a step",
                                              "bdf2, one projection a step", "newton, all at once"};
    return prm->steady ? "newton, to a steady state" : integrators[prm->integrator];
}

static const char *const norm_names[NORMS] = {"velocity", "pressure", "vorticity"};

static double relative(const struct norm *n) { return n->r2 > 0.0 ? norm_relative_l2(n) : NAN; }

/* Relative to the exact norm, or to the case's U where that vanishes. */
static double velocity_error(struct fv *s)
{
    const double U = s->run->scene.initial.U;
    struct norm n[NORMS];
    fv_errors(s, n);
    return n->r2 > 0.0 || U <= 0.0 ? norm_relative_l2(n) : norm_rms(n) / U;
}

/* Relative to what does not vanish; else absent. */
static void summarise_norms(const struct run *r, const struct norm n[3])
{
    const double U = r->scene.initial.U;
    if (n[0].r2 > 0.0)
        summary_real(r->summary, "error.velocity_l2", relative(n));
    if (n[1].r2 > 0.0)
        summary_real(r->summary, "error.pressure_l2",
                     norm_rms_mean_free(n + 1) / sqrt(n[1].r2 / n[1].vol));
    if (n[2].r2 > 0.0)
        summary_real(r->summary, "error.vorticity_l2", relative(n + 2));
    if (U > 0.0) {
        summary_real(r->summary, "error.velocity_linf", n[0].emax / U);
        summary_real(r->summary, "error.pressure_rms",
                     norm_rms_mean_free(n + 1) / (r->scene.fluid.rho * U * U));
    }
}

/* Absolute ones over U, for pressures with and without their mean. */
static void summarise_errors(struct fv *s)
{
    const struct run *r = s->run;
    const double U = r->scene.initial.U;
    struct norm n[NORMS];
    fv_errors(s, n);
    summarise_norms(r, n);
    if (U > 0.0)
        summary_real(r->summary, "error.pressure_offset",
                     norm_mean(n + 1) / (r->scene.fluid.rho * U * U));
    const double units[] = {U, r->scene.fluid.rho * U * U};
    for (int k = 0; r->coupled && k < NORMS; k++)
        norm_tell(r->summary, norm_names[k], n + k, k < 2 ? units[k] : 0.0);
}

/* Counts are since the start. */
static void newton_row(const struct newton *w, struct figures *to)
{
    FIGURE(to, w->norm, "residual [-]");
    FIGURE(to, w->dtau, "pseudo step [s]");
    FIGURE(to, (double)w->newtons, "newton iterations [-]");
    FIGURE(to, (double)w->krylovs, "krylov vectors [-]");
}

/* Kinetic energy, largest speed, divergence, the error if there is an exact field, forces on walls;
 * what newton and a free surface add; gauges, watches. */
void fv_row(void *state, struct figures *to)
{
    struct fv *s = state;
    double sum[3] = {0.0, 0.0, 0.0};
    if (to->measures) {
        fv_energies(s, sum);
        s->totals.fastest = fmax(s->totals.fastest, fv_fastest(s));
    }
    FIGURE(to, s->run->scene.fluid.rho * (sum[0] + sum[2]), "kinetic energy [J]");
    FIGURE(to, fv_fastest(s), "largest velocity [m/s]");
    FIGURE(to, flow_largest_divergence(s), "divergence [1/s]");
    if (s->prm.errors)
        FIGURE(to, velocity_error(s), "error velocity l2 [-]");
    fv_forces_row(s, to);
    if (s->m)
        mesh_places_row(s, to);
    if (s->newton)
        newton_row(s->newton, to);
    if (s->surface) {
        FIGURE(to, surface_volume(s), "volume [m^dim]");
        for (int a = 0; a < s->dim; a++)
            FIGURE(to, surface_reach(s, a), "water up to %c [m]", "xyz"[a]);
    }
    fv_probes_row(s, to);
    watches_row(s->watches, to);
}

/* Iterations and halvings, a step: of this process, of the run where `all' is; V-cycles of this
 * process alone. */
static void newton_summarise(const struct newton *w, double steps, double all, struct summary *to)
{
    const double newtons = w->newtons > 0 ? (double)w->newtons : 1.0;
    summary_real(to, "newton_iterations", (double)w->newtons / all);
    summary_real(to, "krylov_per_newton", (double)w->krylovs / newtons);
    summary_real(to, "v_cycles", (double)w->cycles / steps);
    summary_int(to, "halved_steps", w->halvings);
    summary_real(to, "newton_residual", w->norm);
}

/* Rates per cell and step over the timers of the steps, in all and outside of the pressure solver,
 * and iterations per step: of this process, which timed and counted none before a restart. */
static void summarise_cost(const struct fv *s, double cells)
{
    static const char *const parts[] = {"operators", "convection", "viscous",
                                        "pressure",  "newton",     "surface"};
    struct run *r = s->run;
    double loop = 0.0;
    for (int k = 0; k < 6; k++)
        loop += timer_wall(&r->timers, parts[k]);
    const double steps = fmax(1.0, (double)(r->step - s->output->begun));
    summary_real(r->summary, "cell_steps_per_s", loop > 0.0 ? cells * steps / loop : 0.0);
    summary_real(r->summary, "us_per_cell_step_outside_hypre",
                 1e6 * (loop - timer_wall(&r->timers, "pressure")) / (cells * steps));
    if (s->newton)
        newton_summarise(s->newton, steps, fmax(1.0, (double)r->step), r->summary);
    summary_real(r->summary, "poisson_iterations", (double)s->totals.iterations / steps);
    summary_real(r->summary, "viscous_iterations", (double)s->totals.viscous_iterations / steps);
}

/* The last row has been written; the state is that at time.end. */
void fv_finish(void *state)
{
    struct fv *s = state;
    struct run *r = s->run;
    const double cells = grid_computed(&s->grid);
    double sum[3];
    summary_int(r->summary, "cells", llround(cells));
    if (r->scene.initial.U > 0.0)
        summary_real(r->summary, "max_speed_over_U", s->totals.fastest / r->scene.initial.U);
    if (s->prm.errors)
        summarise_errors(s);
    fv_energies(s, sum);
    summary_real(r->summary, "drift.energy",
                 s->prm.errors && sum[1] > 0.0 ? sum[0] / sum[1] - 1.0 : NAN);
    summary_real(r->summary, "divergence", flow_largest_divergence(s));
    fv_summarise_forces(s);
    if (s->surface)
        surface_summarise(s);
    if (s->m)
        mesh_summarise(s);
    else if (s->surface)
        steady_summarise(s);
    if (s->prm.extrema[0] != 0.0)
        fv_summarise_extrema(s);
    summary_real(r->summary, "max_cfl", s->totals.max_cfl);
    fv_watches_end(s);
    summarise_cost(s, cells);
}

/* fv_report.c - rows of the series and the summary. fv_columns and fv_row list the same columns in
 * the same order; fv_finish writes the summary. All but fv_columns are collective.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "report.h"

#include "../../common/scene/scene.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"
#include "../time/fv_time.h"
#include "../watch/fv_watch.h"
#include "mesh_output.h"
#include "output.h"

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
static double velocity_error(const struct run *r, const struct norm *n)
{
    const double U = r->scene.initial.U;
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

/* Kinetic energy, largest speed, divergence, the error if there is an exact field, forces on walls;
 * what newton and a free surface add; gauges. */
int fv_columns(const struct run *r, const struct fv_params *prm, const char **columns)
{
    static const char *const reaches[] = {"water up to x [m]", "water up to y [m]",
                                          "water up to z [m]"};
    int n = 0;
    columns[n++] = "kinetic energy [J]";
    columns[n++] = "largest velocity [m/s]";
    columns[n++] = "divergence [1/s]";
    if (prm->errors)
        columns[n++] = "error velocity l2 [-]";
    n += fv_force_columns(r, prm, columns + n);
    n += mesh_place_columns(r, prm, columns + n);
    n += newton_columns(prm, columns + n);
    if (prm->water) {
        columns[n++] = "volume [m^dim]";
        for (int a = 0; a < r->scene.domain.dim; a++)
            columns[n++] = reaches[a];
    }
    return n + fv_probe_columns(r, columns + n);
}

/* In the order of fv_columns; values of gauges lie before those of the watches. */
void fv_row(void *state, double *values)
{
    struct fv *s = state;
    double sum[3];
    int n = 3;
    fv_energies(s, sum);
    values[0] = s->run->scene.fluid.rho * (sum[0] + sum[2]);
    values[1] = fv_fastest(s);
    s->totals.fastest = fmax(s->totals.fastest, values[1]);
    values[2] = flow_largest_divergence(s);
    if (s->prm.errors) {
        struct norm norms[NORMS];
        fv_errors(s, norms);
        values[n++] = velocity_error(s->run, norms);
    }
    n += fv_forces(s, values + n);
    n += mesh_places(s, values + n);
    n += newton_values(s->newton, values + n);
    if (s->surface) {
        values[n++] = surface_volume(s);
        for (int a = 0; a < s->dim; a++)
            values[n++] = surface_reach(s, a);
    }
    fv_probe(s, values + n);
    for (int k = 0; k < s->run->scene.nprobes; k++)
        n += !s->run->gauge_elsewhere[k] ? probe_columns(s->run->scene.probes + k, s->dim) : 0;
    watches_values(s->watches, values + n);
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

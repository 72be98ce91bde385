/* fv_errors.c - errors against exact cell averages, over the free cells; rows of the series;
 * summary. SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>

#include "../common/mem.h"
#include "bc.h"
#include "forcing.h"
#include "levelset.h"
#include "newton.h"
#include "watches.h"

enum { NORMS = 3 };

void fv_vorticity(const struct fv *s, double *w)
{
    const struct block *b = &s->b;
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            w[i] =
                block_derivative(b, s->u[1] + i, 0, j_) - block_derivative(b, s->u[0] + i, 1, j_);
}

static void add_cell(const struct fv *s, int64_t c, const double *x, const double *h,
                     const double *vorticity, struct norm *n)
{
    const double volume = h[0] * h[1] * h[2];
    double u[3], p, w;
    exact_average(&s->exact, x, h, s->t, u, &p, &w);
    for (int a = 0; a < s->b.dim; a++)
        norm_add(n, volume, s->u[a][c] - u[a], u[a]);
    norm_add(n + 1, volume, fv_pressure(s, c) + fv_still_in_exact(s, x) - p, p);
    norm_add(n + 2, volume, vorticity[c] - w, w);
}

static void errors(const struct fv *s, struct norm n[NORMS])
{
    const struct block *b = &s->b;
    double *vorticity = block_field(b), x[3], h[3];
    fv_vorticity(s, vorticity);
    for (int k = 0; k < NORMS; k++)
        n[k] = (struct norm){0};
    BLOCK_CELLS (b, i, j, k, c) {
        if (s->forcing && s->forcing->forced[c])
            continue;
        block_cell(b, i, j, k, x, h);
        add_cell(s, c, x, h, vorticity, n);
    }
    mem_free(vorticity);
    norm_reduce(n, NORMS, b->cart);
}

/* Kinetic energy and the exact field's, J/kg m^dim, over the free cells. */
static void energies(const struct fv *s, double sum[2])
{
    const struct block *b = &s->b;
    if (s->surface) {
        sum[0] = surface_energy(s);
        sum[1] = 0.0;
        return;
    }
    double x[3], h[3], u[3];
    sum[0] = sum[1] = 0.0;
    BLOCK_CELLS (b, i, j, k, c) {
        if (s->forcing && s->forcing->forced[c])
            continue;
        block_cell(b, i, j, k, x, h);
        const double volume = h[0] * h[1] * h[2];
        exact_average(&s->exact, x, h, s->t, u, NULL, NULL);
        for (int a = 0; a < b->dim; a++) {
            sum[0] += 0.5 * volume * s->u[a][c] * s->u[a][c];
            sum[1] += 0.5 * volume * u[a] * u[a];
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, b->cart);
}

/* Part of a cell outside the box that a partner counts. */
static double share(const struct fv *s, const double *x, const double *h)
{
    double in = 1.0;
    for (int a = 0; a < s->b.dim; a++) {
        const double lo = fmax(x[a] - 0.5 * h[a], s->partner[0][a]);
        in *= fmax(fmin(x[a] + 0.5 * h[a], s->partner[1][a]) - lo, 0.0) / h[a];
    }
    return 1.0 - in;
}

double fv_curl_squared(const struct fv *s, int64_t c, int j)
{
    const struct block *b = &s->b;
    double sum = 0.0;
    for (int a = b->dim == 3 ? 0 : 2; a < 3; a++) { /* d_p u_q - d_q u_p */
        double w = 0.0;
        for (int k = 0; k < 2; k++) {
            const int along = (a + 1 + k) % 3, of = (a + 2 - k) % 3;
            w += (k ? -1.0 : 1.0) * block_derivative(b, s->u[of] + c, along, j);
        }
        sum += w * w;
    }
    return sum;
}

void fv_tell(void *state, struct summary *report)
{
    const struct fv *s = state;
    const struct block *b = &s->b;
    const double rho = s->run->scene.fluid.rho;
    const double *g = s->run->scene.fluid.gravity;
    double x[3], h[3], sum[4] = {0.0, 0.0, 0.0, 0.0};
    BLOCK_CELLS (b, i, j, k, c) {
        block_cell(b, i, j, k, x, h);
        if (s->forcing && s->forcing->forced[c])
            continue;
        const double u[3] = {s->u[0][c], s->u[1][c], b->dim == 3 ? s->u[2][c] : 0.0};
        const double part = h[0] * h[1] * h[2] * share(s, x, h);
        sum[0] += 0.5 * rho * part * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        sum[1] += 0.5 * part * fv_curl_squared(s, c, j);
        sum[2] += rho * part * exact_signal(&s->exact, x, u);
        sum[3] -= rho * part * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPI_DOUBLE, MPI_SUM, b->cart);
    summary_real(report, "sum.potential", sum[3]);
    summary_real(report, "sum.kinetic", sum[0]);
    summary_real(report, "sum.enstrophy", sum[1]);
    summary_real(report, "sum.signal", sum[2]);
}

/* Largest divergence of the fluxes, times h: what the projection left. */
static double largest_divergence(const struct fv *s)
{
    const struct block *b = &s->b;
    double most = 0.0;
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double div = 0.0;
            if ((s->forcing && s->forcing->forced[i]) || (s->surface && s->surface->layer[i]))
                continue;
            for (int a = 0; a < b->dim; a++)
                div += (s->U[a][i + b->stride[a]] - s->U[a][i]) / block_size(b, a, j_);
            most = fmax(most, fabs(div) * b->h[0]);
        }
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, b->cart);
    return most;
}

/* Columns: kinetic energy, largest speed, divergence, the error if there is an exact field, the
 * force on all walls if there are walls or openings; of newton the residual, the pseudo step and
 * the iterations so far; volume and reach of the water. */
void fv_row(void *state, double *values)
{
    struct fv *s = state;
    double sum[2];
    energies(s, sum);
    values[0] = s->run->scene.fluid.rho * sum[0];
    values[1] = fmax(s->umax[0], fmax(s->umax[1], s->umax[2]));
    s->fastest = fmax(s->fastest, values[1]);
    values[2] = largest_divergence(s);
    int n = 3;
    if (s->has_exact) {
        struct norm norms[NORMS];
        errors(s, norms);
        values[n++] = fv_velocity_error(s->run, norms);
    }
    if (s->bc) {
        double force[3];
        bc_force(s, force);
        for (int a = 0; a < s->b.dim; a++)
            values[n++] = force[a];
    }
    if (s->newton) {
        values[n++] = s->newton->norm;
        values[n++] = s->newton->dtau;
        values[n++] = (double)s->newton->newtons;
        values[n++] = (double)s->newton->krylovs;
    }
    if (s->surface) {
        values[n++] = surface_volume(s, NULL);
        for (int a = 0; a < s->b.dim; a++)
            values[n++] = surface_reach(s, a);
    }
    fv_probe(s, values + n);
    watches_values(s->watches, values + n + s->run->scene.nprobes);
}

static const char *const norm_names[NORMS] = {"velocity", "pressure", "vorticity"};

double fv_relative(const struct norm *n) { return n->r2 > 0.0 ? norm_relative_l2(n) : NAN; }

double fv_velocity_error(const struct run *r, const struct norm *n)
{
    const double U = r->scene.initial.U;
    return n->r2 > 0.0 || U <= 0.0 ? norm_relative_l2(n) : norm_rms(n) / U;
}

/* Relative to what does not vanish; else absent. */
void fv_summarise_norms(const struct run *r, const struct norm n[3])
{
    const double U = r->scene.initial.U;
    if (n[0].r2 > 0.0)
        summary_real(r->summary, "error.velocity_l2", fv_relative(n));
    if (n[1].r2 > 0.0)
        summary_real(r->summary, "error.pressure_l2",
                     norm_rms_mean_free(n + 1) / sqrt(n[1].r2 / n[1].vol));
    if (n[2].r2 > 0.0)
        summary_real(r->summary, "error.vorticity_l2", fv_relative(n + 2));
    if (U > 0.0) {
        summary_real(r->summary, "error.velocity_linf", n[0].emax / U);
        summary_real(r->summary, "error.pressure_rms",
                     norm_rms_mean_free(n + 1) / (r->scene.fluid.rho * U * U));
    }
}

static void summarise_errors(const struct fv *s)
{
    const struct run *r = s->run;
    const double U = r->scene.initial.U;
    struct norm n[NORMS];
    errors(s, n);
    fv_summarise_norms(r, n);
    if (U > 0.0)
        summary_real(r->summary, "error.pressure_offset",
                     norm_mean(n + 1) / (r->scene.fluid.rho * U * U));
    for (int k = 0; r->coupled && k < NORMS; k++)
        norm_tell(r->summary, norm_names[k], n + k);
}

static void summarise_newton(const struct newton *w, double steps, struct summary *to)
{
    const double newtons = w->newtons > 0 ? (double)w->newtons : 1.0;
    summary_real(to, "newton_iterations", (double)w->newtons / steps);
    summary_real(to, "krylov_per_newton", (double)w->krylovs / newtons);
    summary_real(to, "v_cycles", (double)w->cycles / steps);
    summary_int(to, "halved_steps", w->halvings);
    summary_real(to, "newton_residual", w->norm);
}

void fv_finish(void *state)
{
    struct fv *s = state;
    struct run *r = s->run;
    double sum[2], cells = 1.0, loop = 0.0;
    static const char *const parts[] = {"operators", "convection", "viscous",
                                        "pressure",  "newton",     "surface"};
    for (int a = 0; a < s->b.dim; a++)
        cells *= s->b.cells[a];
    for (int k = 0; k < 6; k++)
        loop += timer_wall(&r->timers, parts[k]);
    summary_int(r->summary, "cells", llround(cells));
    if (r->scene.initial.U > 0.0)
        summary_real(r->summary, "max_speed_over_U", s->fastest / r->scene.initial.U);
    if (s->has_exact)
        summarise_errors(s);
    energies(s, sum);
    summary_real(r->summary, "drift.energy",
                 s->has_exact && sum[1] > 0.0 ? sum[0] / sum[1] - 1.0 : NAN);
    summary_real(r->summary, "divergence", largest_divergence(s));
    if (s->surface)
        surface_summarise(s);
    if (s->prm.extrema[0] != 0.0)
        fv_summarise_extrema(s);
    summary_real(r->summary, "max_cfl", s->max_cfl);
    fv_watches_end(s);
    const double steps = r->step > 0 ? (double)r->step : 1.0;
    summary_real(r->summary, "cell_steps_per_s", loop > 0.0 ? cells * steps / loop : 0.0);
    summary_real(r->summary, "us_per_cell_step_outside_hypre",
                 1e6 * (loop - timer_wall(&r->timers, "pressure")) / (cells * steps));
    if (s->newton)
        summarise_newton(s->newton, steps, r->summary);
    summary_real(r->summary, "poisson_iterations", (double)s->iterations / steps);
    summary_real(r->summary, "viscous_iterations", (double)s->viscous_iterations / steps);
}

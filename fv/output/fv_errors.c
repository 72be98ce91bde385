/* fv_errors.c - what the series and the summary hold on even cells: errors against exact cell
 * averages, energies, over the free cells. SPDX-License-Identifier: BSD-3-Clause */
#include "report.h"

#include <math.h>

#include "../../common/mem.h"
#include "../boundary/bc.h"
#include "../boundary/blocked.h"
#include "../boundary/forcing.h"
#include "../coupling/water_budget.h"
#include "../surface/levelset.h"
#include "../boundary/still.h"
#include "mesh_output.h"
#include "output.h"

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

static void errors(struct fv *s, struct norm n[NORMS])
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
static void energies(struct fv *s, double sum[2])
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

/* Sums over the cells outside of the partner's part: kinetic energy, enstrophy, signal, potential
 * energy, volume. */
static void sum_even(const struct fv *s, double sum[5])
{
    const struct block *b = &s->b;
    const double rho = s->run->scene.fluid.rho;
    const double *g = s->run->scene.fluid.gravity;
    double x[3], h[3];
    BLOCK_CELLS (b, i, j, k, c) {
        block_cell(b, i, j, k, x, h);
        if (s->forcing && s->forcing->forced[c])
            continue;
        const double u[3] = {s->u[0][c], s->u[1][c], b->dim == 3 ? s->u[2][c] : 0.0};
        const double wet = s->surface ? surface_share(s, c) : 1.0;
        const double part = h[0] * h[1] * h[2] * wet * water_budget_share(s, x, h);
        sum[0] += 0.5 * rho * part * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        sum[1] += 0.5 * part * fv_curl_squared(s, c, j);
        sum[2] += rho * part * exact_signal(&s->exact, x, u);
        sum[3] -= rho * part * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
        sum[4] += part;
    }
}

void fv_tell(void *state, struct summary *report)
{
    struct fv *s = state;
    double sum[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (s->m)
        mesh_sums(s, sum);
    else
        sum_even(s, sum);
    MPI_Allreduce(MPI_IN_PLACE, sum, 5, MPI_DOUBLE, MPI_SUM, s->comm);
    summary_real(report, "sum.potential", sum[3]);
    summary_real(report, "sum.kinetic", sum[0]);
    summary_real(report, "sum.enstrophy", sum[1]);
    summary_real(report, "sum.signal", sum[2]);
    if (s->surface)
        summary_real(report, "sum.water", sum[4]);
}

/* Largest divergence of the fluxes, times h: what the projection left. */
static double largest_divergence(struct fv *s)
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

static double cells_of(const struct fv *s)
{
    double cells = 1.0;
    for (int a = 0; a < s->b.dim; a++)
        cells *= s->b.cells[a];
    return cells;
}

static int force_columns(const struct run *r, const char **columns)
{
    static const char *const names[] = {"force x [N]", "force y [N]", "force z [N]"};
    int n = 0;
    for (int a = 0; r->scene.nwalls > 0 && a < r->scene.domain.dim; a++)
        columns[n++] = names[a];
    return n + fv_blocked_columns(r, columns + n);
}

static int forces(struct fv *s, double *values)
{
    double force[3];
    int n = 0;
    if (s->bc)
        fv_wall_force(s, force);
    for (int a = 0; s->bc && a < s->dim; a++)
        values[n++] = force[a];
    fv_blocked_forces(s, values + n);
    return n + (s->blocked ? blocked_count() * s->dim : 0);
}

static void summarise(struct fv *s)
{
    if (s->surface) {
        surface_summarise(s);
        steady_summarise(s);
    }
    fv_summarise_blocked(s);
}

const struct report even_report = {.divergence = "divergence [m/s]",
                                   .energies = energies,
                                   .errors = errors,
                                   .largest_divergence = largest_divergence,
                                   .cells = cells_of,
                                   .force_columns = force_columns,
                                   .forces = forces,
                                   .probes = fv_probe,
                                   .summarise = summarise,
                                   .extrema = fv_summarise_extrema};

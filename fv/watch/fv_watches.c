/* fv_watches.c - looks at the flow on any grid; the sums behind that on even cells and rows.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "watches.h"

#include <math.h>

#include "../boundary/bc.h"
#include "../boundary/forcing.h"
#include "../surface/levelset.h"
#include "../boundary/still.h"

static bool all_periodic(const struct fv *s)
{
    for (int a = 0; a < s->b.dim; a++)
        if (!s->b.periodic[a])
            return false;
    return true;
}

/* Cells that a partner or the exact solution fills do work that no budget knows; nor is there one
 * in pseudo-time or with sound. */
struct watches *fv_watches_create(const struct fv *s)
{
    const bool filled = s->run->coupled || s->prm.hole[1][0] > s->prm.hole[0][0];
    struct watches *w = watches_create(
        s->run, &s->prm, all_periodic(s) && !s->surface && !s->blocked, s->surface != NULL);
    const bool moved = s->surface && s->bc && s->bc->speed > 0.0; /* friction at a moving wall */
    bool open = false; /* water and its energy come and go */
    for (int k = 0; s->surface && s->bc && k < 6; k++)
        open = open || s->bc->kind[k] == MESH_INFLOW || s->bc->kind[k] == MESH_OUTFLOW ||
               s->bc->kind[k] == MESH_CARRIED;
    w->has_energy = !filled && !moved && !open && !s->prm.steady && s->prm.c0 == 0.0;
    if (s->surface) /* whose steps are long beside the swing of short waves' work, and dear */
        w->energy_every = 1;
    w->has_growth = !s->surface && !s->newton;
    return w;
}

/* --- energy --- */

/* Power that comes in through a side, of the fluxes of energy, of pressure and of friction on its
 * faces: values there by the scheme's own interpolation into the ghosts, pressure by the cubic. */
static double side_power(const struct fv *s, int k)
{
    const struct block *b = &s->b;
    const int a = k / 2, t0 = a == 0 ? 1 : 0, t1 = a == 2 ? 1 : 2;
    const double out = k % 2 ? 1.0 : -1.0, rho = s->run->scene.fluid.rho;
    const int64_t in = k % 2 ? -b->stride[a] : b->stride[a], up = k % 2 ? b->stride[a] : 0;
    double sum = 0.0;
    int at[3];
    at[a] = k % 2 ? b->n[a] - 1 : 0;
    for (at[t1] = 0; at[t1] < b->n[t1]; at[t1]++)
        for (at[t0] = 0; at[t0] < b->n[t0]; at[t0]++) {
            const int64_t c = block_at(b, at[0], at[1], at[2]);
            const double area = block_size(b, t0, at[t0]) * block_size(b, t1, at[t1]);
            double p[4], square = 0.0, friction = 0.0;
            for (int n = 0; n < 4; n++)
                p[n] = fv_pressure(s, c + n * in) / rho;
            for (int q = 0; q < b->dim; q++) {
                const double *u = s->u[q] + c;
                const double w = (7.0 * (u[0] + u[-in]) - (u[in] + u[-2 * in])) / 12.0;
                const double slope = (15.0 * (u[0] - u[-in]) - (u[in] - u[-2 * in])) /
                                     (12.0 * block_size(b, a, at[a]));
                square += w * w;
                friction -= s->nu * w * slope;
            }
            const double pf = (25.0 * p[0] - 23.0 * p[1] + 13.0 * p[2] - 3.0 * p[3]) / 12.0;
            sum += area * (friction - out * s->U[a][c + up] * (0.5 * square + pf));
        }
    return sum;
}

static bool closed_here(const struct block *b, int k)
{
    const int a = k / 2;
    return !b->periodic[a] && (k % 2 ? b->hi[a] == b->cells[a] : b->lo[a] == 0);
}

/* Sums of a row of cells: velocity and its square, times the weights (NULL: 1). */
static void add_row(const struct fv *s, int64_t c, int64_t n, const double *weight, double *sums)
{
    for (int a = 0; a < s->b.dim; a++) {
        const double *restrict u = s->u[a] + c;
        double first = 0.0, second = 0.0;
        for (int64_t i = 0; i < n; i++) {
            const double w = weight ? weight[i] : 1.0;
            first += w * u[i];
            second += w * u[i] * u[i];
        }
        sums[a] += first;
        sums[3] += 0.5 * second;
    }
    for (int64_t i = 0; i < n; i++)
        sums[4] += weight ? weight[i] : 1.0;
}

/* Share of water in a row of cells, as if the surface were parallel to one of their faces. */
static void share_row(const struct fv *s, int64_t c, int64_t n, double *restrict wet)
{
    const struct block *b = &s->b;
    const double *restrict phi = s->surface->phi + c;
    const int64_t dy = b->stride[1], dz = b->dim == 3 ? b->stride[2] : 0;
    for (int64_t i = 0; i < n; i++) {
        const double across = fabs(phi[i + 1] - phi[i - 1]) + fabs(phi[i + dy] - phi[i - dy]) +
                              fabs(phi[i + dz] - phi[i - dz]) + 1e-300;
        const double share = 0.5 - 2.0 * phi[i] / across;
        wet[i] = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
    }
}

static void sum_energy(const struct fv *s, double sums[6])
{
    const struct block *b = &s->b;
    BLOCK_ROWS (b, 0, c, n) {
        double row[5] = {0.0}, *wet = NULL;
        if (s->surface) {
            wet = s->surface->rate + c; /* scratch */
            share_row(s, c, n, wet);
        }
        add_row(s, c, n, wet, row);
        for (int m = 0; m < 5; m++)
            sums[m] += block_volume(b, j_) * row[m];
    }
    for (int k = 0; k < 2 * b->dim; k++)
        if (closed_here(b, k) && !s->surface)
            sums[5] += side_power(s, k);
}

static struct flow_energy energy_of(struct fv *s)
{
    double sums[6] = {0.0};
    if (s->m)
        mesh_watches_energy(s, sums);
    else
        sum_energy(s, sums);
    for (int a = 0; a < s->dim; a++)
        sums[5] += (s->drive[a] + (s->surface ? s->still[a] : 0.0)) * sums[a];
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    return (struct flow_energy){.kinetic = sums[3],
                                .momentum = {sums[0], sums[1], sums[2]},
                                .volume = sums[4],
                                .power = sums[5]};
}

/* --- waves of two cells: fourth differences over 16, 1 on them, 5e-4 on waves of eight --- */

static double square_row(const double *restrict q, int64_t d, int64_t n, const unsigned char *idle)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n; i++) {
        const double v = (q[i - 2 * d] + q[i + 2 * d]) - 4.0 * (q[i - d] + q[i + d]) + 6.0 * q[i];
        const bool out =
            idle && (idle[i - 2 * d] || idle[i - d] || idle[i] || idle[i + d] || idle[i + 2 * d]);
        sum += out ? 0.0 : v * v;
    }
    return sum / 256.0;
}

/* Along axis a, away from closed sides, whose ghosts are no flow. */
static double squares(const struct fv *s, const double *q, int a, const unsigned char *idle)
{
    const struct block *b = &s->b;
    int lo[3] = {0, 0, 0}, hi[3] = {b->n[0], b->n[1], b->n[2]};
    lo[a] = closed_here(b, 2 * a) ? 2 : 0;
    hi[a] -= closed_here(b, 2 * a + 1) ? 2 : 0;
    double sum = 0.0;
    for (int k = lo[2]; k < hi[2]; k++)
        for (int j = lo[1]; j < hi[1]; j++) {
            const int64_t c = block_at(b, lo[0], j, k);
            sum += block_volume(b, j) *
                   square_row(q + c, b->stride[a], hi[0] - lo[0], idle ? idle + c : NULL);
        }
    return sum;
}

/* Sum of squares, and the sum, of what is not idle. */
static void moments(const struct fv *s, const double *q, const unsigned char *idle, double sums[3])
{
    const struct block *b = &s->b;
    sums[0] = sums[1] = sums[2] = 0.0;
    BLOCK_ROWS (b, 0, c, n) {
        double row[3] = {0.0};
        for (int64_t i = c; i < c + n; i++) {
            const double w = idle && idle[i] ? 0.0 : 1.0;
            row[0] += w;
            row[1] += w * q[i];
            row[2] += w * q[i] * q[i];
        }
        for (int m = 0; m < 3; m++)
            sums[m] += block_volume(b, j_) * row[m];
    }
}

static void sum_waves(struct fv *s, double sums[6])
{
    const struct block *b = &s->b;
    const unsigned char *idle = s->surface   ? s->surface->layer
                                : s->forcing ? s->forcing->forced
                                             : NULL;
    double of[3];
    double *const fields[1] = {s->p};
    block_halo(b, 1, fields);
    for (int q = 0; q < b->dim; q++) {
        for (int a = 0; a < b->dim; a++)
            sums[0] += squares(s, s->u[q], a, idle);
        moments(s, s->u[q], idle, of);
        sums[1] += of[2];
    }
    for (int a = 0; a < b->dim; a++)
        sums[2] += squares(s, s->p, a, idle);
    moments(s, s->p, idle, sums + 3);
}

static void look_at_waves(struct fv *s, int64_t step, struct diagnosis *d)
{
    double sums[6] = {0.0};
    if (s->m)
        mesh_watches_waves(s, sums);
    else
        sum_waves(s, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    const struct flow_waves v = {sums[0], sums[1], sums[2],
                                 sums[5] - sums[4] * sums[4] / fmax(sums[3], 1e-300)};
    watches_waves(s->watches, &v, sums[3], s->t, step, d);
}

void fv_watches_end(struct fv *s)
{
    struct diagnosis d = {0};
    look_at_waves(s, s->run->step, &d);
    watches_summarise(s->watches, s->run->summary);
}

void fv_watches_look(struct fv *s, struct diagnosis *d)
{
    struct watches *w = s->watches;
    const int64_t step = s->run->step + 1;
    timer_start(&s->run->timers, "watches");
    watches_growth(w, s->umax[0] + s->umax[1] + s->umax[2], s->t, step, d);
    if (watches_want_energy(w, step)) {
        const struct flow_energy e = energy_of(s);
        watches_energy(w, &e, s->t, step, d);
    }
    if (watches_want_waves(w, step))
        look_at_waves(s, step, d);
    if (s->surface && s->surface->volume0 > 0.0)
        watch_judge(&w->returned,
                    fabs(s->surface->returned) / (s->surface->volume0 + s->surface->passed), s->t,
                    step, d);
    timer_stop(&s->run->timers, "watches");
}

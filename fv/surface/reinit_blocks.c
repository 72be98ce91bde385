/* reinit_blocks.c - reinitialisation on blocks (reinit_band.h): phi_tau = sign(phi) (1 - |grad
 * phi|) with Godunov's Hamiltonian in the indices of the cells, |grad phi|^2 = sum K_ab phi_a
 * phi_b, K the metric of the indices; slopes by WENO5 (weno.h), beside the surface by differences
 * that end on it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "reinit_band.h"

#include "levelset.h"
#include "mesh_view.h"
#include "weno.h"

static double height(const struct fv *s, const struct part *p, int64_t c, int a, int j)
{
    const struct surface_mesh *w = s->surface->mesh;
    (void)j;
    return w->size[p - s->grid.part][a] / sqrt(w->K[a][a][c]);
}

/* Slopes are those of the indices. */
static double step(const struct fv *s, int a, int j, double height_, double *length)
{
    (void)s;
    (void)a;
    (void)j;
    *length = height_;
    return 1.0;
}

static double strip_step(const struct fv *s, int j)
{
    (void)s;
    (void)j;
    return 0.0;
}

/* |grad phi| in a cell from slopes on either side of it along the indices, K their metric: along
 * each index the one that distance comes in by, Godunov's choice; where it leaves both ways the one
 * at which it stands still. */
static double size_in_indices(int dim, double K[3][3], const double below[3], const double above[3],
                              double sign)
{
    double slope[3], sum = 0.0;
    for (int a = 0; a < dim; a++) {
        double others = 0.0;
        for (int b = 0; b < dim; b++)
            others += b == a ? 0.0 : 0.5 * K[a][b] * (below[b] + above[b]);
        const double in = fmax(0.0, sign * (K[a][a] * below[a] + others)),
                     out = fmax(0.0, -sign * (K[a][a] * above[a] + others));
        slope[a] = in == 0.0 && out == 0.0 ? -others / K[a][a] : in >= out ? below[a] : above[a];
    }
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++)
            sum += K[a][b] * slope[a] * slope[b];
    return sqrt(fmax(0.0, sum));
}

/* The same beside the surface, where slopes end on it. */
static double size_beside(const struct fv *s, const double *phi, const struct spot *x)
{
    const double *size = s->surface->mesh->size[x->part - s->grid.part];
    double K[3][3], d[2][3];
    surface_mesh_metric(s, x->cell, K);
    for (int a = 0; a < s->dim; a++)
        for (int up = 0; up < 2; up++) {
            const int64_t step = up ? x->part->stride[a] : -x->part->stride[a];
            const double *q = phi + x->cell, reach = x->reach[a][up] > 0.0 ? x->reach[a][up] : 1.0;
            const double c = minmod(bend(q, step), bend(q + step, step)),
                         far = x->reach[a][up] > 0.0 ? 0.0 : q[step];
            d[up][a] = (up ? 1.0 : -1.0) * ((far - q[0]) / reach - 0.5 * reach * c) / size[a];
        }
    return size_in_indices(s->dim, K, d[0], d[1], x->sign);
}

static void rates_of_strip(const struct fv *s, const double *phi, const double *old,
                           const struct strip *x, double *rate)
{
    const struct surface_mesh *w = s->surface->mesh;
    const double *size = w->size[x->part - s->grid.part];
    for (int a = 0; a < s->dim; a++)
        weno_slopes(phi + x->cell, x->part->stride[a], 1.0 / size[a], x->n, w->slopes[a][0],
                    w->slopes[a][1]);
    for (int64_t i = 0; i < x->n; i++) {
        double K[3][3], d[2][3], least = INFINITY;
        surface_mesh_metric(s, x->cell + i, K);
        for (int a = 0; a < s->dim; a++) {
            d[0][a] = w->slopes[a][0][i];
            d[1][a] = w->slopes[a][1][i];
            least = fmin(least, size[a] / sqrt(K[a][a]));
        }
        const double sign = old[x->cell + i] < 0.0 ? -1.0 : 1.0;
        rate[x->cell + i] =
            reinit_cfl(s) * least * sign * (1.0 - size_in_indices(s->dim, K, d[0], d[1], sign));
    }
}

static void rates(const struct fv *s, const double *phi, const double *old, const struct band *w,
                  double *rate)
{
    for (int64_t k = 0; k < w->nstrips; k++)
        rates_of_strip(s, phi, old, w->strips + k, rate);
}

const struct reinit_ops block_reinit = {.height = height,
                                        .step = step,
                                        .strip_step = strip_step,
                                        .rates = rates,
                                        .size_beside = size_beside};

const struct reinit_ops box_reinit = {.height = height,
                                      .step = step,
                                      .strip_step = strip_step,
                                      .is_known = reinit_is_known,
                                      .rates = rates,
                                      .size_beside = size_beside};

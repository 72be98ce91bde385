/* viscous_single.c - see viscous_single.h. Conjugate gradients are bound by memory on large grids:
 * here fields are in single precision, and products are made anew row by row where they are needed
 * rather than stored. An iteration moves 36 bytes a cell and component, with stored products in
 * double precision it would be 120. What single precision cannot resolve is left to another round
 * from the residual in double precision (iterative refinement: Higham, Accuracy and Stability of
 * Numerical Algorithms, 2002, ch. 12). SPDX-License-Identifier: BSD-3-Clause */
#include "viscous_single.h"

#include <float.h>

#include "../grid/fv_grid.h"
#include "helmholtz.h"
#include "operators.h"
#include "viscous_solver.h"

enum { MOST = 200 }; /* iterations */

/* The fields of an iteration: direction, residual, increment; scaled so that the first residual is
 * of size 1 on average, for squares of floats underflow below 1e-38. */
struct cg {
    struct fv *s;
    float *const *p, *const *r, *const *x;
    float w[3]; /* c nu/(12 h^2) along each axis */
};

static struct cg begin(const struct helmholtz *h)
{
    struct fv *s = h->s;
    float *(*field)[3] = s->viscous->single;
    struct cg g = {.s = s, .p = field[0], .r = field[1], .x = field[2]};
    for (int a = 0; a < s->dim; a++)
        g.w[a] = (float)(h->c * s->nu / (12.0 * s->b.h[a] * s->b.h[a]));
    return g;
}

/* w times the fourth-order second difference along one axis, 12 h^2 of it. */
INLINE float second(const float *p, int64_t d, float w)
{
    return w * (16.0F * ((p[-d] - *p) + (p[d] - *p)) - ((p[-2 * d] - *p) + (p[2 * d] - *p)));
}

/* out = A p for a row of n cells. By differences to the cell's own value: a sum of weights would
 * round to other than 1, alike in all cells, which the longest waves would feel. */
INLINE void product(const float *restrict p, const struct cg *g, const int dim, int64_t n,
                    float *restrict out)
{
    const int64_t y = g->s->b.stride[1], z = dim == 3 ? g->s->b.stride[2] : 0;
    const float wx = g->w[0], wy = g->w[1], wz = g->w[2];
    for (int64_t i = 0; i < n; i++) {
        float v = second(p + i, 1, wx) + second(p + i, y, wy);
        if (dim == 3)
            v += second(p + i, z, wz);
        out[i] = p[i] - v;
    }
}

/* The same in scratch that stays in the cache. */
static float *product_row(const struct cg *g, const float *p, int64_t n)
{
    float *const line = (float *)g->s->faces[0];
    if (g->s->dim == 2)
        product(p, g, 2, n, line);
    else
        product(p, g, 3, n, line);
    return line;
}

/* p.A p of all ranks, after the ghosts of p. */
static double curvature(const struct cg *g)
{
    double sum = 0.0;
    block_halo_single(&g->s->b, g->s->dim, g->p);
    for (int a = 0; a < g->s->dim; a++)
        BLOCK_ROWS (&g->s->b, 0, at, n)
            sum += lanes_dot_single(g->p[a] + at, product_row(g, g->p[a] + at, n), n);
    return ranks_sum(g->s->comm, sum);
}

/* x += alpha p, r -= alpha A p of a row; r.r then. */
static double descend_row(const float *restrict p, const float *restrict Ap, float alpha, int64_t n,
                          float *restrict x, float *restrict r)
{
    for (int64_t i = 0; i < n; i++) {
        x[i] += alpha * p[i];
        r[i] -= alpha * Ap[i];
    }
    return lanes_dot_single(r, r, n);
}

/* Imposed cells keep their values: no residual. Returns its squares there. */
static double zero_imposed(const struct fv *s, float *r)
{
    double sum = 0.0;
    for (int64_t k = 0; s->forcing && k < s->forcing->nlocal; k++) {
        float *const at = r + s->forcing->local[k];
        sum += (double)(*at * *at);
        *at = 0.0F;
    }
    return sum;
}

/* The same of all rows; r.r of all ranks. */
static double descend(const struct cg *g, float alpha)
{
    double sum = 0.0;
    for (int a = 0; a < g->s->dim; a++) {
        BLOCK_ROWS (&g->s->b, 0, at, n)
            sum += descend_row(g->p[a] + at, product_row(g, g->p[a] + at, n), alpha, n,
                               g->x[a] + at, g->r[a] + at);
        sum -= zero_imposed(g->s, g->r[a]);
    }
    return ranks_sum(g->s->comm, sum);
}

/* p = r + beta p */
static void turn(const struct cg *g, float beta)
{
    for (int a = 0; a < g->s->dim; a++) {
        float *restrict p = g->p[a];
        const float *restrict r = g->r[a];
        BLOCK_ROWS (&g->s->b, 0, at, n)
            for (int64_t i = at; i < at + n; i++)
                p[i] = r[i] + beta * p[i];
    }
}

/* p = r = scale times the residual, x = 0 */
static void start(const struct cg *g, double scale, double *const residual[3])
{
    for (int a = 0; a < g->s->dim; a++) {
        float *restrict p = g->p[a], *restrict r = g->r[a], *restrict x = g->x[a];
        const double *restrict from = residual[a];
        BLOCK_ROWS (&g->s->b, 0, at, n)
            for (int64_t i = at; i < at + n; i++) {
                p[i] = r[i] = (float)(scale * from[i]);
                x[i] = 0.0F;
            }
    }
}

/* From r.r = rr to goal, both scaled; false: not reached. */
static bool iterate(const struct cg *g, double rr, double goal)
{
    for (int it = 0; it < MOST && rr > goal; it++) {
        const double left = descend(g, (float)(rr / curvature(g)));
        if (left > goal)
            turn(g, (float)(left / rr));
        rr = left;
        g->s->totals.viscous_iterations++;
    }
    return rr <= goal;
}

/* delta += x / scale */
static void add(const struct cg *g, double scale, double *const delta[3])
{
    for (int a = 0; a < g->s->dim; a++) {
        double *restrict d = delta[a];
        const float *restrict x = g->x[a];
        BLOCK_ROWS (&g->s->b, 0, at, n)
            for (int64_t i = at; i < at + n; i++)
                d[i] += (double)x[i] / scale;
    }
}

/* r -= A x / scale in double precision; r.r of all ranks. */
static double renew(const struct cg *g, double c, double scale, double *const residual[3])
{
    struct fv *s = g->s;
    double sum = 0.0, *const x = s->flux, *const L = s->faces[0];
    for (int a = 0; a < s->dim; a++) {
        double *const r = residual[a];
        BLOCK_ROWS (&s->b, 0, at, n)
            for (int64_t i = at; i < at + n; i++)
                x[i] = (double)g->x[a][i] / scale;
        block_halo(&s->b, 1, &x);
        viscous_apply(s, x, L);
        helmholtz_add(s, -1.0, x, r);
        helmholtz_add(s, c, L, r);
        if (s->forcing)
            forcing_zero(s->forcing, r);
        sum += helmholtz_dot(s, r, r);
    }
    return ranks_sum(s->comm, sum);
}

/* Rounding of x, each cell its own, leaves a residual of about half the largest eigenvalue times
 * that of a float: down to there the iteration's own residual is the true one. */
bool viscous_single_cg(const struct helmholtz *h, double *const delta[3], double *const r[3],
                       double rr, double goal)
{
    const struct block *b = &h->s->b;
    const struct cg g = begin(h);
    const double cells = (double)b->cells[0] * b->cells[1] * b->cells[2],
                 resolved =
                     fmin(pow(0.5 * (double)FLT_EPSILON * (1.0 + h->c * h->largest), 2.0), 1e-4);
    for (int round = 0; round < MOST && rr > goal; round++) {
        const double scale = sqrt(cells / rr), aim = fmax(goal / rr, resolved);
        start(&g, scale, r);
        if (!iterate(&g, cells, aim * cells))
            return false;
        add(&g, scale, delta);
        rr = aim * rr > goal ? renew(&g, h->c, scale, r) : goal;
    }
    return rr <= goal;
}

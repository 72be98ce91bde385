/* reinit_even.c - reinitialisation on uniform cells and on layers of unequal height
 * (reinit_band.h): Godunov's Hamiltonian along the axes, distances that closest.c knows.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "reinit_band.h"

#include "../boundary/fv_boundary.h"
#include "levelset.h"
#include "weno.h"

static double height(const struct fv *s, const struct part *p, int64_t c, int a, int j)
{
    (void)p;
    (void)c;
    return block_size(&s->b, a, j);
}

static double step(const struct fv *s, int a, int j, double height_, double *length)
{
    (void)height_;
    return *length = block_step(&s->b, a, j);
}

static double least_size(const struct block *b, int j)
{
    double least = INFINITY;
    for (int a = 0; a < b->dim; a++)
        least = fmin(least, block_size(b, a, j));
    return least;
}

static double strip_step(const struct fv *s, int j) { return reinit_cfl(s) * least_size(&s->b, j); }

/* Whether differences around c end at a closed side or a box. */
static bool near_side(const struct fv *s, const struct part *p, int64_t c)
{
    for (int a = 0; a < s->dim; a++)
        for (int m = 1; m <= GHOSTS; m++)
            if (surface_holds_none(s, c + m * p->stride[a]) ||
                surface_holds_none(s, c - m * p->stride[a]))
                return true;
    return false;
}

/* Distances that are held: those of closest.c, and in the narrow band of half steps cells beside
 * sides, which are left as advection has them. */
bool reinit_is_known(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                     bool narrow, double *exact)
{
    return surface_closest(s, p, phi, c, exact) || (narrow && near_side(s, p, c));
}

/* Second derivative along axis a at a cell in row j, whose neighbours stand d away in q, 1/m. */
static double bend_at(const struct block *b, const double *q, int64_t d, int a, int j)
{
    if (a != 1 || !b->rows)
        return bend(q, d) / (b->h[a] * b->h[a]);
    const double low = b->rows->step[j], up = b->rows->step[j + 1];
    return 2.0 * ((q[d] - q[0]) / up - (q[0] - q[-d]) / low) / (up + low);
}

/* One-sided derivatives beside the surface: second-order ENO, or to the surface itself. */
static void slopes_beside(const struct fv *s, const double *phi, const struct spot *x, int a,
                          double d[2])
{
    const struct block *b = &s->b;
    const int j = block_row(b, x->cell);
    double v[5], *const q = v + 2;
    blocked_even_line(s, phi, x->cell, b->stride[a], q);
    for (int up = 0; up < 2; up++) {
        const int step = up ? 1 : -1;
        const double c = minmod(bend_at(b, q, 1, a, j), bend_at(b, q + step, 1, a, j + step));
        const double reach = x->reach[a][up] > 0.0 ? x->reach[a][up] : block_step(b, a, j + up);
        const double far = x->reach[a][up] > 0.0 ? 0.0 : q[step];
        d[up] = (up ? 1.0 : -1.0) * ((far - q[0]) / reach - 0.5 * reach * c);
    }
}

static double size_beside(const struct fv *s, const double *phi, const struct spot *x)
{
    double sum = 0.0, d[2];
    for (int a = 0; a < s->b.dim; a++) {
        slopes_beside(s, phi, x, a, d);
        const double in = fmax(0.0, x->sign * d[0]), out = fmin(0.0, x->sign * d[1]);
        sum += fmax(in * in, out * out);
    }
    return sqrt(sum);
}

/* In place of the squares of slopes whose stencils end at a box: phi is even there. */
static void squares_beside_boxes(const struct fv *s, const double *phi, const double *old,
                                 double *sum)
{
    static const enum blocked_ghost even[2] = {GHOST_EVEN, GHOST_EVEN};
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t k = 0; k < s->blocked->nnear[a]; k++) {
            const struct near_box *x = s->blocked->near[a] + k;
            const int64_t c = x->cell, d = s->b.stride[a];
            double v[7], was = 0.0, is = 0.0;
            if (!x->own)
                continue;
            blocked_line(x, phi, d, 3, even, v + 3);
            weno_add_square(phi + c, old + c, d, 1.0 / s->b.h[a], 1, &was);
            weno_add_square(v + 3, old + c, 1, 1.0 / s->b.h[a], 1, &is);
            sum[c] = fmax(0.0, sum[c] + is - was);
        }
}

static void rates(const struct fv *s, const double *phi, const double *old, const struct band *w,
                  double *rate)
{
    const struct block *b = &s->b;
    for (int64_t k = 0; k < w->nstrips; k++) {
        const int64_t c = w->strips[k].cell, n = w->strips[k].n;
        memset(rate + c, 0, (size_t)n * sizeof(double));
        for (int a = 0; a < b->dim; a++)
            weno_add_square(phi + c, old + c, b->stride[a],
                            1.0 / block_scale(b, a, w->strips[k].row), n, rate + c);
    }
    if (s->blocked)
        squares_beside_boxes(s, phi, old, rate);
    for (int64_t k = 0; k < w->nstrips; k++) {
        const int64_t c = w->strips[k].cell, n = w->strips[k].n;
        const double dtau = w->strips[k].dtau;
        for (int64_t i = c; i < c + n; i++)
            rate[i] = (old[i] < 0.0 ? -dtau : dtau) * (1.0 - sqrt(rate[i]));
    }
}

const struct reinit_ops even_reinit = {.height = height,
                                       .step = step,
                                       .strip_step = strip_step,
                                       .is_known = reinit_is_known,
                                       .rates = rates,
                                       .size_beside = size_beside};

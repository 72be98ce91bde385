/* reinit.c - phi_tau + S(phi_0)(|grad phi| - 1) = 0 to the steady state in a band (Godunov's
 * Hamiltonian, RK2). Beside the surface, differences towards it end at its place on the axis, by
 * the quadratic through phi_0, which pins it (Russo & Smereka, J. Comput. Phys. 163, 2000; Min &
 * Gibou, J. Comput. Phys. 225, 2007); where the slope there is good already, phi is left alone,
 * which pins it better still. WENO5 elsewhere. SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"

enum { WIDTH = 8 };             /* cells on either side of the surface that are worked on */
static const double good = 0.1; /* | |grad phi| - 1 | of cells beside the surface that stay as is */

/* A cell of the band. */
struct spot {
    int64_t cell;
    double sign, dtau;  /* -, m */
    bool beside;        /* the surface passes between it and a neighbour */
    double reach[3][2]; /* m: way to the surface along each axis, down and up; 0: none */
};

static double minmod(double a, double b) { return a * b <= 0.0 ? 0.0 : fabs(a) < fabs(b) ? a : b; }

/* Second difference of q at the cell (not divided). */
static double bend(const double *q, int64_t d) { return q[d] - 2.0 * q[0] + q[-d]; }

/* Share of the step d after which the quadratic through q is 0; q[0] and q[d] differ in sign. */
static double crossing(const double *q, int64_t d)
{
    const double c = minmod(bend(q, d), bend(q + d, d)), fall = q[0] - q[d];
    if (fabs(c) < 1e-12 * fabs(fall))
        return q[0] / fall;
    const double e = 0.5 * c - q[0] - q[d], root = sqrt(fmax(0.0, e * e - 4.0 * q[0] * q[d]));
    const double t = 0.5 + (fall - copysign(root, fall)) / c;
    return t > 0.0 && t < 1.0 ? t : q[0] / fall;
}

static double slope_of(const struct block *b, const double *q)
{
    double sum = 0.0;
    for (int a = 0; a < b->dim; a++) {
        const double d = (q[b->stride[a]] - q[-b->stride[a]]) / (2.0 * b->h[a]);
        sum += d * d;
    }
    return sqrt(sum);
}

static struct spot look(const struct fv *s, const double *phi, int64_t c)
{
    const struct block *b = &s->b;
    struct spot x = {.cell = c, .sign = phi[c] < 0.0 ? -1.0 : 1.0, .dtau = INFINITY};
    for (int a = 0; a < b->dim; a++) {
        x.dtau = fmin(x.dtau, b->h[a]);
        for (int up = 0; up < 2; up++) {
            const int64_t d = up ? b->stride[a] : -b->stride[a];
            if ((phi[c] < 0.0) == (phi[c + d] < 0.0))
                continue;
            x.beside = true;
            x.reach[a][up] = fmax(1e-6, crossing(phi + c, d)) * b->h[a];
            x.dtau = fmin(x.dtau, x.reach[a][up]);
        }
    }
    x.dtau *= b->dim == 3 ? 0.3 : 0.45;
    if (x.beside && fabs(slope_of(b, phi + c) - 1.0) < good)
        x.dtau = 0.0;
    return x;
}

/* One-sided derivatives beside the surface: second-order ENO, or to the surface itself. */
static void slopes_beside(const struct fv *s, const double *phi, const struct spot *x, int a,
                          double d[2])
{
    const double h = s->b.h[a], *q = phi + x->cell;
    for (int up = 0; up < 2; up++) {
        const int64_t step = up ? s->b.stride[a] : -s->b.stride[a];
        const double c = minmod(bend(q, step), bend(q + step, step)) / (h * h);
        const double reach = x->reach[a][up] > 0.0 ? x->reach[a][up] : h;
        const double far = x->reach[a][up] > 0.0 ? 0.0 : q[step];
        d[up] = (up ? 1.0 : -1.0) * ((far - q[0]) / reach - 0.5 * reach * c);
    }
}

static double size_of_gradient(const struct fv *s, const double *phi, const struct spot *x)
{
    double sum = 0.0, d[2];
    for (int a = 0; a < s->b.dim; a++) {
        if (x->beside)
            slopes_beside(s, phi, x, a, d);
        else
            surface_slopes(s, phi, x->cell, a, d);
        const double in = fmax(0.0, x->sign * d[0]), out = fmin(0.0, x->sign * d[1]);
        sum += fmax(in * in, out * out);
    }
    return sqrt(sum);
}

static void rates(const struct fv *s, const double *phi, const struct spot *spots, int64_t n,
                  double *rate)
{
    for (int64_t i = 0; i < n; i++)
        rate[spots[i].cell] =
            spots[i].dtau * spots[i].sign * (1.0 - size_of_gradient(s, phi, spots + i));
}

static bool beside_surface(const struct block *b, const double *phi, int64_t c)
{
    for (int a = 0; a < b->dim; a++)
        if ((phi[c] < 0.0) != (phi[c + b->stride[a]] < 0.0) ||
            (phi[c] < 0.0) != (phi[c - b->stride[a]] < 0.0))
            return true;
    return false;
}

/* mark = 1 within WIDTH cells of the surface, whatever phi says there: it may be old. */
static void mark_band(const struct fv *s, double *mark)
{
    const struct block *b = &s->b;
    memset(mark, 0, (size_t)b->size * sizeof(double));
    BLOCK_ROWS (b, 0, c, len)
        for (int64_t i = c; i < c + len; i++)
            mark[i] = beside_surface(b, s->surface->phi, i);
    for (int k = 1; k < WIDTH; k++)
        for (int a = 0; a < b->dim; a++) {
            const int64_t d = b->stride[a];
            double *const next = s->surface->kept;
            block_halo(b, 1, &mark);
            BLOCK_ROWS (b, 0, c, len)
                for (int64_t i = c; i < c + len; i++)
                    next[i] = fmax(mark[i], fmax(mark[i - d], mark[i + d]));
            BLOCK_ROWS (b, 0, c, len)
                memcpy(mark + c, next + c, (size_t)len * sizeof(double));
        }
}

/* The band's cells; all others are at least as far off as it is wide. */
static int64_t list_band(struct fv *s, struct spot *spots)
{
    const struct block *b = &s->b;
    double *phi = s->surface->phi, *mark = s->surface->phi_new, far = INFINITY;
    int64_t n = 0;
    for (int a = 0; a < b->dim; a++)
        far = fmin(far, (WIDTH - 1) * b->h[a]);
    mark_band(s, mark);
    BLOCK_ROWS (b, 0, c, len)
        for (int64_t i = c; i < c + len; i++)
            if (mark[i] == 0.0)
                phi[i] = copysign(fmax(far, fabs(phi[i])), phi[i]);
    surface_ghosts(s, phi);
    BLOCK_ROWS (b, 0, c, len)
        for (int64_t i = c; i < c + len; i++)
            if (mark[i] > 0.0)
                spots[n++] = look(s, phi, i);
    return n;
}

void surface_reinit(struct fv *s, int steps)
{
    struct surface *f = s->surface;
    const struct block *b = &s->b;
    struct spot *spots = NEW(struct spot, (int64_t)b->n[0] * b->n[1] * b->n[2]);
    const int64_t n = list_band(s, spots);
    for (int k = 0; k < steps; k++) {
        rates(s, f->phi, spots, n, f->rate);
        for (int64_t i = 0; i < n; i++) {
            const int64_t c = spots[i].cell;
            f->kept[c] = f->phi[c];
            f->phi[c] += f->rate[c];
        }
        surface_ghosts(s, f->phi);
        rates(s, f->phi, spots, n, f->rate);
        for (int64_t i = 0; i < n; i++) {
            const int64_t c = spots[i].cell;
            const double q = 0.5 * (f->kept[c] + f->phi[c] + f->rate[c]);
            f->phi[c] = q * spots[i].sign > 0.0 ? q : f->kept[c]; /* the surface stays */
        }
        surface_ghosts(s, f->phi);
    }
    mem_free(spots);
    f->travelled = 0.0;
    f->reinits++;
}

double surface_distortion(const struct fv *s)
{
    const struct block *b = &s->b;
    const double *phi = s->surface->phi;
    double most = 0.0, h = 0.0;
    for (int a = 0; a < b->dim; a++)
        h = fmax(h, b->h[a]);
    BLOCK_ROWS (b, 0, c, len)
        for (int64_t i = c; i < c + len; i++) {
            if (fabs(phi[i]) < 2.0 * h)
                most = fmax(most, fabs(slope_of(b, phi + i) - 1.0));
        }
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, b->cart);
    return most;
}

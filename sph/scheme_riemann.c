/* scheme_riemann.c - Riemann SPH: every pair is a 1D Riemann problem along its line of centres,
 * between states that the gradients of the first pass carry to its middle. Two schemes:
 * ALE with mass fluxes (Vila) [2.86-2.89], and without mass fluxes (Leduc) [2.96-2.99].
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include <string.h>

#include "../common/log.h"
#include "../common/mem.h"
#include "gradients.h"
#include "kernel.h"
#include "neighbours.h"
#include "riemann.h"
#include "sph.h"
#include "vec_pair.h"

enum { PRIM = 8, VISCOSITY_OFF = 2 };

/* What an instance of the pass has fixed. */
struct variant {
    int dim, scheme, limiter, viscosity, gamma;
};

/* Numbers of the whole pass. */
struct constants {
    struct tait eos;
    struct dissipation dissipation;
    double R_1, eps2;   /* 1/m; m^2: keeps r > 0 */
    double kernel;      /* |W'|/r = kernel (1 - r/R)^3, here times 2 */
    double damper;      /* beta c0 R, m^2/s */
    double c2_1;        /* 1/c0^2 */
    double mu;          /* Pa s, times dim + 2 for Monaghan-Gingold */
};

/* One particle of a pair: LANES neighbours, or the same particle in all lanes. */
struct line {
    vec x[3], u[3], w, rho;
    vec grho[3], gu[3][3], u0[3];
};

/* Sums over the neighbours of one particle: momentum, half the volume rate and mass that go to them. */
struct sums {
    vec q[3], w, m;
};

static struct constants constants_of(const struct sph *s)
{
    const double dissipation = s->prm.low_dissipation ? 0.0 : 1.0;
    return (struct constants){
        .eos = {.rho0_1 = 1.0 / s->rho0,
                .B = s->rho0 * s->c0 * s->c0 / s->gamma,
                .Z0 = s->rho0 * s->c0},
        .dissipation = {.factor = 3.0 / s->c0, .least = dissipation},
        .R_1 = 1.0 / s->R,
        .eps2 = 1e-12 * s->R * s->R,
        .kernel = -2.0 * kernel_dw_r(s->dim, 0.0, s->R),
        .damper = s->prm.damper * s->c0 * s->R,
        .c2_1 = 1.0 / (s->c0 * s->c0),
        .mu = s->rho0 * s->nu * (s->prm.viscosity == VISCOSITY_MORRIS ? 1.0 : s->dim + 2.0),
    };
}

INLINE vec dot(const vec *a, const vec *b, const int dim)
{
    vec s = a[0] * b[0];
    for (int c = 1; c < dim; c++)
        s += a[c] * b[c];
    return s;
}

INLINE struct line load_one(const double *prim, const double *slope, const int dim)
{
    struct line i;
    const double *g = slope + dim, *u0 = g + dim * dim;
    for (int a = 0; a < dim; a++) {
        i.x[a] = vec_all(prim[a]);
        i.u[a] = vec_all(prim[dim + a]);
        i.grho[a] = vec_all(slope[a]);
        i.u0[a] = vec_all(u0[a]);
        for (int b = 0; b < dim; b++)
            i.gu[a][b] = vec_all(g[dim * a + b]);
    }
    i.w = vec_all(prim[2 * dim]);
    i.rho = vec_all(prim[2 * dim + 1]);
    return i;
}

INLINE struct line load_neighbours(const double *prim, const double *slope, const int *k, const int dim)
{
    struct line j;
    vec spare;
    if (dim == 2) {
        vec_columns(prim, PRIM, k, 0, j.x, j.x + 1);
        vec_columns(prim, PRIM, k, 2, j.u, j.u + 1);
        vec_columns(prim, PRIM, k, 4, &j.w, &j.rho);
        vec_columns(slope, 8, k, 0, j.grho, j.grho + 1);
        vec_columns(slope, 8, k, 2, j.gu[0], j.gu[0] + 1);
        vec_columns(slope, 8, k, 4, j.gu[1], j.gu[1] + 1);
        vec_columns(slope, 8, k, 6, j.u0, j.u0 + 1);
    } else {
        vec_columns(prim, PRIM, k, 0, j.x, j.x + 1);
        vec_columns(prim, PRIM, k, 2, j.x + 2, j.u);
        vec_columns(prim, PRIM, k, 4, j.u + 1, j.u + 2);
        vec_columns(prim, PRIM, k, 6, &j.w, &j.rho);
        vec_columns(slope, 16, k, 0, j.grho, j.grho + 1);
        vec_columns(slope, 16, k, 2, j.grho + 2, j.gu[0]);
        vec_columns(slope, 16, k, 4, j.gu[0] + 1, j.gu[0] + 2);
        vec_columns(slope, 16, k, 6, j.gu[1], j.gu[1] + 1);
        vec_columns(slope, 16, k, 8, j.gu[1] + 2, j.gu[2]);
        vec_columns(slope, 16, k, 10, j.gu[2] + 1, j.gu[2] + 2);
        vec_columns(slope, 16, k, 12, j.u0, j.u0 + 1);
        vec_columns(slope, 16, k, 14, j.u0 + 2, &spare);
    }
    return j;
}

INLINE vec divergence(const struct line *i, const int dim)
{
    return dim == 2 ? i->gu[0][0] + i->gu[1][1] : i->gu[0][0] + i->gu[1][1] + i->gu[2][2];
}

/* Fluxes of LANES pairs. They enter the sums of i; what j gets is left in *to_j: q and m as they are, w
 * its own volume rate. */
INLINE void pair(const struct constants *c, const struct line *i, const struct line *j, struct sums *to,
                 struct sums *to_j, const struct variant v)
{
    const int dim = v.dim;
    vec d[3], uI[3], uJ[3];
    for (int a = 0; a < dim; a++)
        d[a] = j->x[a] - i->x[a];
    const vec r2 = dot(d, d, dim) + c->eps2, r = vec_sqrt(r2);
    const vec t = vec_max(1.0 - r * c->R_1, vec_all(0.0));
    const vec f = t * t * t * j->w * i->w; /* 2 w_i w_j |W'|/r: i->w holds the constant */

    /* States at the middle [2.78-2.83]: rho and the components of u. */
    vec rho[2] = {i->rho, j->rho}, p[2], Z[2];
    reconstruct(rho, rho + 1, dot(i->grho, d, dim), dot(j->grho, d, dim), v.limiter);
    for (int a = 0; a < dim; a++) {
        uI[a] = i->u[a];
        uJ[a] = j->u[a];
        reconstruct(uI + a, uJ + a, dot(i->gu[a], d, dim), dot(j->gu[a], d, dim), v.limiter);
    }
    for (int k = 0; k < 2; k++)
        pressure(&c->eos, rho[k], p + k, Z + k, v.gamma);
    /* Acoustic damper; that of i is in its spare place, grho of no dimension. */
    p[0] -= i->u0[dim == 2 ? 2 : 2] * 0.0;
    (void)to;
    (void)to_j;
    (void)uI;
    (void)r;
    (void)f;
}

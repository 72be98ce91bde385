/* scheme_gradients.c - first pass: renormalised gradients of rho and u [2.42-2.44] and the
 * transport velocity, one-sided over the whole list, from the prim lines alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include <math.h>

#include "kernel.h"
#include "neighbours.h"
#include "vec.h"

enum { PRIM = 8 };

/* Sums over the neighbours of a particle; d = x_j - x_i, g = w_j |W'|/r. */
struct sums {
    vec M[6];     /* g d d: xx xy yy (xz yz zz) */
    vec rho[3];   /* g (rho_j - rho_i) d */
    vec u[3][3];  /* g (u_j - u_i) d */
    vec crowd[3]; /* transport law */
};

/* Constants of the pass. */
struct pass {
    double R2, per_R, slope, cut; /* slope = 20 W0/R^2 */
    double crowd, tensile;        /* w0 20 W0/R^2; 0.2 (W0/W(dx))^4 */
    double per_Rd, crowd_near;    /* law of Oger: 1/(2 dx); w0 20 W0(Rd)/Rd^2 Rd */
};

static inline __attribute__((always_inline)) void add_four(struct sums *q, const struct sph *s,
                                                           const struct pass *c, const double *i,
                                                           const int *j, const int dim,
                                                           const int transport)
{
    const vec zero = {0.0, 0.0, 0.0, 0.0};
    vec p[PRIM], d[3], t, g, r2 = vec_all(1e-12 * c->R2);
    vec_columns(s->p.prim, PRIM, j, PRIM, p);
    for (int a = 0; a < dim; a++) {
        d[a] = p[a] - i[a];
        r2 += d[a] * d[a];
    }
    const vec r = vec_sqrt(r2);
    t = vec_max(1.0 - r * c->per_R, zero);
    const vec t3 = t * t * t;
    g = c->slope * t3 * p[2 * dim];
    const vec drho = g * (p[2 * dim + 1] - i[2 * dim + 1]);
    for (int a = 0, k = 0; a < dim; a++) {
        const vec ga = g * d[a];
        for (int b = 0; b <= a; b++)
            q->M[k++] += ga * d[b];
        q->rho[a] += drho * d[a];
        for (int b = 0; b < dim; b++)
            q->u[b][a] += ga * (p[dim + b] - i[dim + b]);
    }
    if (transport == TRANSPORT_TVS) { /* gradW (1 + 0.2 (W/W(dx))^4) */
        vec f = t3 * t * (1.0 + 4.0 * r * c->per_R);
        f *= f;
        const vec h = c->crowd * t3 * (1.0 + c->tensile * f * f);
        for (int a = 0; a < dim; a++)
            q->crowd[a] += h * d[a];
    } else if (transport == TRANSPORT_TVO) {
        const vec near = vec_max(1.0 - r * c->per_Rd, zero);
        const vec h = c->crowd_near * near * near * near;
        for (int a = 0; a < dim; a++)
            q->crowd[a] += h * d[a];
    }
}

/* Inverse of the symmetric M; false if its smallest eigenvalue is below `least' (then no slope is
 * trusted). In 3D: M - least I must be positive definite. */
static bool invert(const double *M, double *B, const int dim, double least)
{
    const double a = M[0], b = M[1], c = M[2];
    if (dim == 2) {
        const double det = a * c - b * b;
        const double small = 0.5 * (a + c) - sqrt(0.25 * (a - c) * (a - c) + b * b);
        if (!(small >= least))
            return false;
        B[0] = c / det;
        B[1] = B[2] = -b / det;
        B[3] = a / det;
        return true;
    }
    const double d = M[3], e = M[4], f = M[5], p = a - least, q = c - least, r = f - least;
    if (!(p > 0.0 && p * q - b * b > 0.0 &&
          p * (q * r - e * e) - b * (b * r - e * d) + d * (b * e - q * d) > 0.0))
        return false;
    const double A00 = c * f - e * e, A01 = d * e - b * f, A02 = b * e - c * d;
    const double per = 1.0 / (a * A00 + b * A01 + d * A02);
    B[0] = A00 * per;
    B[1] = B[3] = A01 * per;
    B[2] = B[6] = A02 * per;
    B[4] = (a * f - d * d) * per;
    B[5] = B[7] = (b * d - a * e) * per;
    B[8] = (a * c - b * b) * per;
    return true;
}

/* Whole-support law: -2 U R n, at most U/4. Law of Oger [2.113]: -U n, at most |u|/4. */
static void shift(const struct sph *s, const double *n, const double *u, double *delta,
                  const int dim, const int transport)
{
    const double U = s->run->scene.initial.U;
    const double factor = transport == TRANSPORT_TVS ? -2.0 * U * s->R : -U;
    double size2 = 0.0, u2 = 0.0;
    for (int a = 0; a < dim; a++) {
        delta[a] = factor * n[a];
        size2 += delta[a] * delta[a];
        u2 += u[a] * u[a];
    }
    const double most2 = 0.0625 * (transport == TRANSPORT_TVS ? U * U : u2);
    if (size2 > most2) {
        const double cut = sqrt(most2 / size2);
        for (int a = 0; a < dim; a++)
            delta[a] *= cut;
    }
}

/* Slopes and u0 of particle i from its sums. */
static inline __attribute__((always_inline)) void finish(struct sph *s, int i, const struct sums *q,
                                                         const int dim, const int transport)
{
    double *g = s->p.slope + (size_t)i * s->p.nslope, *u0 = g + dim + dim * dim;
    const double *line = s->p.prim + (size_t)PRIM * i;
    double M[6], B[9], n[3], delta[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < dim * (dim + 1) / 2; k++)
        M[k] = vec_sum(q->M[k]);
    const bool good = invert(M, B, dim, 0.2);
    for (int f = 0; f <= dim; f++) { /* rho, then the components of u */
        double raw[3];
        for (int b = 0; b < dim; b++)
            raw[b] = vec_sum(f == 0 ? q->rho[b] : q->u[f - 1][b]);
        for (int a = 0; a < dim; a++) {
            double sum = 0.0;
            for (int b = 0; b < dim; b++)
                sum += B[dim * a + b] * raw[b];
            g[dim * f + a] = good ? sum : 0.0;
        }
    }
    if (transport == TRANSPORT_TVS || transport == TRANSPORT_TVO) {
        for (int a = 0; a < dim; a++)
            n[a] = vec_sum(q->crowd[a]);
        shift(s, n, line + dim, delta, dim, transport);
    }
    for (int a = 0; a < dim; a++)
        u0[a] = transport == TRANSPORT_EULERIAN ? 0.0 : line[dim + a] + delta[a];
}

static struct pass constants(const struct sph *s, int dim)
{
    const double R = s->R, Rd = 2.0 * s->dx, W0 = kernel_w0(dim, R);
    const double ratio = W0 / kernel_w(dim, s->dx, R);
    return (struct pass){.R2 = R * R,
                         .per_R = 1.0 / R,
                         .slope = 20.0 * W0 / (R * R),
                         .crowd = s->dxD * 20.0 * W0 / (R * R),
                         .tensile = 0.2 * ratio * ratio * ratio * ratio,
                         .per_Rd = 1.0 / Rd,
                         .crowd_near = s->dxD * 20.0 * kernel_w0(dim, Rd) / Rd};
}

static inline __attribute__((always_inline)) void gradients(struct sph *s, const int dim,
                                                            const int transport)
{
    const struct neighbours *l = s->list;
    const struct pass c = constants(s, dim);
    for (int i = 0; i < l->n; i++) {
        const double *line = s->p.prim + (size_t)PRIM * i;
        const int *j = l->j + l->start[i];
        struct sums q = {0};
        for (int k = 0; k < l->count[i]; k += LANES)
            add_four(&q, s, &c, line, j + k, dim, transport);
        finish(s, i, &q, dim, transport);
    }
}

#define GRADIENTS(dim, transport)                                                                  \
    static void gradients_##dim##_##transport(struct sph *s) { gradients(s, dim, transport); }
GRADIENTS(2, TRANSPORT_TVS)
GRADIENTS(2, TRANSPORT_TVO)
GRADIENTS(2, TRANSPORT_NONE)
GRADIENTS(2, TRANSPORT_EULERIAN)
GRADIENTS(3, TRANSPORT_TVS)
GRADIENTS(3, TRANSPORT_TVO)
GRADIENTS(3, TRANSPORT_NONE)
GRADIENTS(3, TRANSPORT_EULERIAN)

scheme_pass *scheme_gradients(int dim, int transport)
{
    static scheme_pass *const pass[2][4] = {
        {gradients_2_TRANSPORT_TVS, gradients_2_TRANSPORT_TVO, gradients_2_TRANSPORT_NONE,
         gradients_2_TRANSPORT_EULERIAN},
        {gradients_3_TRANSPORT_TVS, gradients_3_TRANSPORT_TVO, gradients_3_TRANSPORT_NONE,
         gradients_3_TRANSPORT_EULERIAN}};
    return pass[dim - 2][transport];
}

/* convection.c - fluxes of momentum by fourth-order face averages (see README.md):
 *   face value  q_f = (-q_-2 + 7 q_-1 + 7 q_0 - q_1)/12
 *   flux        F = U q_f + 1/48 (U_t+1 - U_t-1)(q_f,t+1 - q_f,t-1), once for each tangent t: the
 * product of two face averages is not the average of the product; beside a no-slip wall the
 * differences are one-sided, of third order
 *   upwind bias q_f += sign(U) theta d/12, d = q_1 - 3 q_0 + 3 q_-1 - q_-2: theta = 1 is the
 * third-order upwind value. theta = min(1, C r^2), r = |d| over the sum of the differences it is
 * made of: 1 on a zigzag, O(h^2) where the flow is resolved, so that the bias is O(h^7) there
 * With rows of unequal height the face values along y have weights of their own (rows.h); products
 * and bias stay as they are: heights that vary smoothly change them by O(h^2) of a small term.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>

#include "bc.h"

/* out = q on the lower faces along the stride, for a row of n cells. */
static void face_row(const double *restrict q, int64_t along, int64_t n, double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] = (7.0 * (q[i - along] + q[i]) - (q[i - 2 * along] + q[i + along])) * (1.0 / 12.0);
}

/* The same with weights of its own. */
static void weighted_row(const double *restrict q, const double *w, int64_t along, int64_t n,
                         double *restrict out)
{
    const double a = w[0], b = w[1], c = w[2], d = w[3];
    for (int64_t i = 0; i < n; i++)
        out[i] = (b * q[i - along] + c * q[i]) + (a * q[i - 2 * along] + d * q[i + along]);
}

/* q on the lower faces along axis a of all cells and one layer more. */
static void face_values(const struct block *b, const double *q, int a, double *out)
{
    if (a == 1 && b->rows)
        BLOCK_ROWS (b, 1, c, n)
            weighted_row(q + c, b->rows->face[j_], b->stride[a], n, out + c);
    else
        BLOCK_ROWS (b, 1, c, n)
            face_row(q + c, b->stride[a], n, out + c);
}

static void bias_row(const double *restrict q, const double *restrict U, int64_t along, int64_t n,
                     double C, double *restrict out)
{
    for (int64_t i = 0; i < n; i++) {
        const double a = q[i - along] - q[i - 2 * along], b = q[i] - q[i - along],
                     c = q[i + along] - q[i], d = a - 2.0 * b + c;
        const double r = fabs(d) / (fabs(a) + 2.0 * fabs(b) + fabs(c) + 1e-300);
        out[i] += copysign(fmin(1.0, C * r * r) * (1.0 / 12.0), U[i]) * d;
    }
}

/* Faces of this rank along `a': those of its cells and of one layer more on the upper side, and one
 * layer of tangential neighbours. Rows start one cell early; the last one is the upper face. */
void convection_face_velocities(struct fv *s, double *const u[3], double *const U[3])
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++)
        face_values(b, u[a], a, U[a]);
}

/* (dU/dt)(df/dt) 4 h^2 along a tangent: central, or beside a no-slip wall one-sided within the
 * fluid. Ghosts there continue a polynomial through the wall's velocity V, with 4 V and 16 V beside
 * a fluid at rest: where the cells do not hold the layer, their product was a flux of V^2/3 that no
 * viscosity had to carry. */
static double product(const double *U, const double *f, int64_t i, int64_t d, bool beside)
{
    if (!beside)
        return (U[i + d] - U[i - d]) * (f[i + d] - f[i - d]);
    const double dU = 18.0 * U[i + d] - 11.0 * U[i] - 9.0 * U[i + 2 * d] + 2.0 * U[i + 3 * d];
    const double df = 18.0 * f[i + d] - 11.0 * f[i] - 9.0 * f[i + 2 * d] + 2.0 * f[i + 3 * d];
    return dU * df * (1.0 / 9.0);
}

/* along[t]: stride of a tangent, inwards; beside[t]: its row lies beside a no-slip wall. */
struct tangents {
    int n;
    int64_t along[2];
    bool beside[2];
};

static void flux_row(const double *restrict U, const double *restrict f,
                     const struct tangents *tangent, int64_t n, double *restrict F)
{
    for (int64_t i = 0; i < n; i++)
        F[i] = U[i] * f[i];
    for (int t = 0; t < tangent->n; t++) {
        const int64_t d = tangent->along[t];
        if (tangent->beside[t])
            for (int64_t i = 0; i < n; i++)
                F[i] += product(U, f, i, d, true) * (1.0 / 48.0);
        else
            for (int64_t i = 0; i < n; i++)
                F[i] += product(U, f, i, d, false) * (1.0 / 48.0);
    }
}

/* Of a row along x, whose ends lie beside walls. */
static void mend_ends(const struct fv *s, const double *U, const double *f, int64_t n, double *F)
{
    for (int k = 0; k < 2; k++) {
        const int64_t i = k ? n - 1 : 0, d = k ? -1 : 1;
        if (bc_is_no_slip(s, k))
            F[i] += (product(U, f, i, d, true) - product(U, f, i, d, false)) * (1.0 / 48.0);
    }
}

/* Of the row of cells or lower faces j, k. */
static struct tangents tangents_of(const struct fv *s, int a, int j, int k)
{
    const int at[3] = {0, j, k};
    struct tangents t = {0};
    for (int c = 0; c < s->b.dim; c++) {
        if (c == a)
            continue;
        const bool below = c > 0 && at[c] == 0 && bc_is_no_slip(s, 2 * c);
        const bool above = c > 0 && at[c] == s->b.n[c] - 1 && bc_is_no_slip(s, 2 * c + 1);
        t.along[t.n] = above ? -s->b.stride[c] : s->b.stride[c];
        t.beside[t.n++] = below || above;
    }
    return t;
}

static void add_divergence(const double *restrict F, int64_t along, double per_h, int64_t n,
                           bool first, double *restrict N)
{
    if (first)
        for (int64_t i = 0; i < n; i++)
            N[i] = (F[i + along] - F[i]) * per_h;
    else
        for (int64_t i = 0; i < n; i++)
            N[i] += (F[i + along] - F[i]) * per_h;
}

void convection(struct fv *s, double *const N[3])
{
    const struct block *b = &s->b;
    for (int q = 0; q < b->dim; q++)
        for (int a = 0; a < b->dim; a++) {
            const int64_t along = b->stride[a];
            face_values(b, s->u[q], a, s->face);
            if (s->prm.upwind > 0.0)
                BLOCK_ROWS (b, 1, c, n)
                    bias_row(s->u[q] + c, s->U[a] + c, along, n, s->prm.upwind, s->face + c);
            /* faces of the cells and the upper one: rows of n + 1, planes one more in direction a
             */
            for (int k = 0; k < b->n[2] + (a == 2); k++)
                for (int j = 0; j < b->n[1] + (a == 1); j++) {
                    const int64_t c = block_at(b, 0, j, k);
                    const struct tangents t = tangents_of(s, a, j, k);
                    flux_row(s->U[a] + c, s->face + c, &t, b->n[0] + (a == 0), s->flux + c);
                    if (a != 0)
                        mend_ends(s, s->U[a] + c, s->face + c, b->n[0], s->flux + c);
                }
            BLOCK_ROWS (b, 0, c, n)
                add_divergence(s->flux + c, along, 1.0 / block_size(b, a, j_), n, a == 0, N[q] + c);
        }
}

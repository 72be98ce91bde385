/* viscous.c - nu Lap q of cell averages, fourth order: differences of the face gradient
 * (15 (q_0 - q_-1) - (q_1 - q_-2))/12 h; implicit part by conjugate gradients over all components
 * at once; walls and rows of unequal height make it unsymmetric: BiCGStab (van der Vorst 1992)
 * there. SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>
#include <string.h>

#include "bc.h"
#include "forcing.h"
#include "levelset.h"

static void row(const double *restrict q, const int64_t *stride, const double *c, int dim,
                int64_t n, double *restrict out)
{
    const int64_t sy = stride[1];
    if (dim == 2) {
        const double cx = c[0], cy = c[1];
        for (int64_t i = 0; i < n; i++)
            out[i] = cx * (16.0 * (q[i - 1] + q[i + 1]) - (q[i - 2] + q[i + 2]) - 30.0 * q[i]) +
                     cy * (16.0 * (q[i - sy] + q[i + sy]) - (q[i - 2 * sy] + q[i + 2 * sy]) -
                           30.0 * q[i]);
        return;
    }
    const int64_t sz = stride[2];
    const double cx = c[0], cy = c[1], cz = c[2];
    for (int64_t i = 0; i < n; i++)
        out[i] =
            cx * (16.0 * (q[i - 1] + q[i + 1]) - (q[i - 2] + q[i + 2]) - 30.0 * q[i]) +
            cy * (16.0 * (q[i - sy] + q[i + sy]) - (q[i - 2 * sy] + q[i + 2 * sy]) - 30.0 * q[i]) +
            cz * (16.0 * (q[i - sz] + q[i + sz]) - (q[i - 2 * sz] + q[i + 2 * sz]) - 30.0 * q[i]);
}

/* Adds nu d2q/dy2 with the weights of a row. */
static void add_weighted(const double *restrict q, const double *w, double nu, int64_t d, int64_t n,
                         double *restrict out)
{
    const double a = nu * w[0], b = nu * w[1], c = nu * w[2], e = nu * w[3], f = nu * w[4];
    for (int64_t i = 0; i < n; i++)
        out[i] += (b * q[i - d] + e * q[i + d]) + (a * q[i - 2 * d] + f * q[i + 2 * d]) + c * q[i];
}

void viscous_apply(const struct fv *s, const double *q, double *out)
{
    const struct block *b = &s->b;
    double c[3];
    for (int a = 0; a < b->dim; a++)
        c[a] = a == 1 && b->rows ? 0.0 : s->nu / (12.0 * b->h[a] * b->h[a]);
    BLOCK_ROWS (b, 0, at, n) {
        row(q + at, b->stride, c, b->dim, n, out + at);
        if (b->rows)
            add_weighted(q + at, b->rows->laplace[j_], s->nu, b->stride[1], n, out + at);
    }
}

static double dot_row(const double *restrict a, const double *restrict b, int64_t n)
{
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    int64_t i = 0;
    for (; i + 4 <= n; i += 4) {
        s0 += a[i] * b[i];
        s1 += a[i + 1] * b[i + 1];
        s2 += a[i + 2] * b[i + 2];
        s3 += a[i + 3] * b[i + 3];
    }
    for (; i < n; i++)
        s0 += a[i] * b[i];
    return (s0 + s1) + (s2 + s3);
}

/* Sum over this rank's cells; forced cells hold zeros there. */
static double dot(const struct block *b, const double *x, const double *y)
{
    double sum = 0.0;
    BLOCK_ROWS (b, 0, c, n)
        sum += dot_row(x + c, y + c, n);
    return sum;
}

static void axpy(const struct block *b, double a, const double *restrict x, double *restrict y)
{
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            y[i] += a * x[i];
}

static void xpby(const struct block *b, const double *restrict x, double beta, double *restrict y)
{
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            y[i] = x[i] + beta * y[i];
}

/* out = x - c L x, zero in forced cells. */
static void helmholtz(const struct fv *s, double c, const double *x, double *out)
{
    viscous_apply(s, x, out);
    BLOCK_ROWS (&s->b, 0, at, n)
        for (int64_t i = at; i < at + n; i++)
            out[i] = x[i] - c * out[i];
    if (s->forcing)
        forcing_zero(s->forcing, out);
    if (s->surface)
        surface_zero(s, out);
}

/* out = A x of all components, x homogeneous on the sides; sums of out.y and out.out over all
 * ranks. */
static void apply_all(const struct fv *s, double c, double *const x[3], double *const out[3],
                      double *const y[3], double sums[2])
{
    const struct block *b = &s->b;
    if (s->surface)
        extension_apply(s, x, EXTEND_CHANGE, 2);
    bc_ghosts(s, BC_ZERO, x);
    block_halo(b, b->dim, x);
    sums[0] = sums[1] = 0.0;
    for (int a = 0; a < b->dim; a++) {
        helmholtz(s, c, x[a], out[a]);
        sums[0] += dot(b, out[a], y[a]);
        sums[1] += dot(b, out[a], out[a]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, b->cart);
}

/* sums: r.r and r.r0 over all ranks. */
static void residuals(const struct fv *s, double *const r[3], double *const r0[3], double sums[2])
{
    sums[0] = sums[1] = 0.0;
    for (int a = 0; a < s->b.dim; a++) {
        sums[0] += dot(&s->b, r[a], r[a]);
        sums[1] += dot(&s->b, r[a], r0[a]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->b.cart);
}

/* From the residual r, whose square sum is rr: r0, p = work and v, t of the paper. */
static bool bicgstab(struct fv *s, double c, double *const delta[3], double *const r[3], double rr,
                     double goal)
{
    const struct block *b = &s->b;
    double *const *p = s->work, *const *r0 = s->krylov[0], *const *v = s->krylov[1];
    double *const t[3] = {s->face, s->flux, s->step_work}, sums[2], rho = rr;
    for (int a = 0; a < b->dim; a++)
        memcpy(r0[a], r[a], (size_t)b->size * sizeof(double));
    for (int it = 0; it < 200; it++) {
        if (!(rr > goal) || rr == 0.0)
            return rr == rr;
        apply_all(s, c, p, v, r0, sums);
        const double alpha = rho / sums[0];
        for (int a = 0; a < b->dim; a++)
            axpy(b, -alpha, v[a], r[a]);
        apply_all(s, c, r, t, r, sums);
        const double omega = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
        for (int a = 0; a < b->dim; a++) {
            axpy(b, alpha, p[a], delta[a]);
            axpy(b, omega, r[a], delta[a]);
            axpy(b, -omega, t[a], r[a]);
            if (s->surface)
                surface_zero(s, r[a]);
        }
        residuals(s, r, r0, sums);
        const double beta = sums[1] / rho * alpha / omega;
        for (int a = 0; a < b->dim; a++) {
            axpy(b, -omega, v[a], p[a]);
            xpby(b, r[a], beta, p[a]);
        }
        rr = sums[0];
        rho = sums[1];
        s->viscous_iterations++;
    }
    return false;
}

/* rhs becomes the residual, work the search direction, u_old's place is not touched; face is
 * scratch. */
bool viscous_solve(struct fv *s, double c, double *const delta[3], double *const rhs[3], double tol)
{
    const struct block *b = &s->b;
    const int dim = b->dim;
    double sums[2] = {0.0, 0.0}, *const Ap[3] = {s->face, s->flux, s->step_work};
    block_halo(b, dim, delta);
    for (int a = 0; a < dim; a++) {
        helmholtz(s, c, delta[a], Ap[a]);
        if (s->forcing)
            forcing_zero(s->forcing, rhs[a]);
        if (s->surface)
            surface_zero(s, rhs[a]);
        axpy(b, -1.0, Ap[a], rhs[a]);
        memcpy(s->work[a], rhs[a], (size_t)b->size * sizeof(double));
        sums[0] += dot(b, rhs[a], rhs[a]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 1, MPI_DOUBLE, MPI_SUM, b->cart);
    double rr = sums[0];
    const double goal = rr * tol * tol;
    if (s->bc || s->surface || b->rows)
        return bicgstab(s, c, delta, rhs, rr, goal);
    for (int it = 0; it < 200; it++) {
        if (!(rr > goal) || rr == 0.0)
            return rr == rr;
        block_halo(b, dim, s->work);
        sums[0] = 0.0;
        for (int a = 0; a < dim; a++) {
            helmholtz(s, c, s->work[a], Ap[a]);
            sums[0] += dot(b, s->work[a], Ap[a]);
        }
        MPI_Allreduce(MPI_IN_PLACE, sums, 1, MPI_DOUBLE, MPI_SUM, b->cart);
        const double alpha = rr / sums[0];
        sums[0] = 0.0;
        for (int a = 0; a < dim; a++) {
            axpy(b, alpha, s->work[a], delta[a]);
            axpy(b, -alpha, Ap[a], rhs[a]);
            sums[0] += dot(b, rhs[a], rhs[a]);
        }
        MPI_Allreduce(MPI_IN_PLACE, sums, 1, MPI_DOUBLE, MPI_SUM, b->cart);
        for (int a = 0; a < dim; a++)
            xpby(b, rhs[a], sums[0] / rr, s->work[a]);
        rr = sums[0];
        s->viscous_iterations++;
    }
    return false;
}

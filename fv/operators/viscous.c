/* viscous.c - nu Lap q of cell averages, fourth order: differences of the face gradient
 * (15 (q_0 - q_-1) - (q_1 - q_-2))/12 h; implicit part by conjugate gradients over all components
 * at once; walls and rows of unequal height make it unsymmetric: Chebyshev's iteration there, and
 * with a surface BiCGStab (van der Vorst 1992). SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include <math.h>
#include <string.h>

#include "../boundary/bc.h"
#include "../boundary/forcing.h"
#include "../surface/levelset.h"
#include "blocked_cells.h"
#include "operators.h"

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

static void swap_fields(double *a[3], double *b[3])
{
    for (int k = 0; k < 3; k++) {
        double *const t = a[k];
        a[k] = b[k];
        b[k] = t;
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

/* out = x - c L x of component q, zero in forced cells. */
static void helmholtz(const struct fv *s, int q, double c, const double *x, double *out)
{
    viscous_apply(s, x, out);
    if (s->blocked)
        blocked_viscous(s, q, x, out);
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
        helmholtz(s, a, c, x[a], out[a]);
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

enum { AT_ONCE = 24 }; /* steps, whose slabs a cache can hold */

/* --- Chebyshev's iteration (Saad, Iterative Methods for Sparse Linear Systems, 2003, alg. 12.1):
 * no sums, and one pass over the fields a step --- */

/* Largest eigenvalue of -h^2 d2/dx2: 16/3 of the periodic differences; that of a mode at a no-slip
 * wall, whose cell has -76/12 on the diagonal, is 7.43 (4 cells: 7.75). */
static double largest_eigenvalue(const struct fv *s)
{
    const struct block *b = &s->b;
    const double one = s->bc || s->blocked ? 7.8 : 16.0 / 3.0;
    double most = 0.0;
    for (int a = 0; a < b->dim; a++)
        most += a == 1 && b->rows ? 0.0 : one / (b->h[a] * b->h[a]);
    if (b->rows) { /* Gershgorin's bound of the rows, and the wall's as above */
        double sum, bound = 0.0;
        for (int j = 0; j < b->n[1]; j++) {
            sum = 0.0;
            for (int m = 0; m < 5; m++)
                sum += fabs(b->rows->laplace[j][m]);
            bound = fmax(bound, sum * one * 3.0 / 16.0);
        }
        MPI_Allreduce(MPI_IN_PLACE, &bound, 1, MPI_DOUBLE, MPI_MAX, b->cart);
        most += bound;
    }
    return s->nu * most;
}

/* y = x + beta (x - y) + alpha (r - x + c L x) for a row, with L x in its place; sum of the squares
 * of what alpha has. */
static double step_row(const double *restrict x, const double *restrict Lx,
                       const double *restrict r, double c, double alpha, double beta, int64_t n,
                       double *restrict y)
{
    double part[4] = {0.0, 0.0, 0.0, 0.0};
    int64_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (int m = 0; m < 4; m++) {
            const double left = r[i + m] - x[i + m] + c * Lx[i + m];
            y[i + m] = x[i + m] + beta * (x[i + m] - y[i + m]) + alpha * left;
            part[m] += left * left;
        }
    for (; i < n; i++) {
        const double left = r[i] - x[i] + c * Lx[i];
        y[i] = x[i] + beta * (x[i] - y[i]) + alpha * left;
        part[0] += left * left;
    }
    return (part[0] + part[1]) + (part[2] + part[3]);
}

/* One step of component q; boxes make their own of some cells, so that all of L x is there first.
 */
static double step(const struct fv *s, int q, double c, double alpha, double beta, const double *x,
                   const double *r, double *y)
{
    const struct block *b = &s->b;
    double w[3], sum = 0.0;
    for (int a = 0; a < b->dim; a++)
        w[a] = a == 1 && b->rows ? 0.0 : s->nu / (12.0 * b->h[a] * b->h[a]);
    if (s->blocked) {
        viscous_apply(s, x, s->flux);
        blocked_viscous(s, q, x, s->flux);
    }
    BLOCK_ROWS (b, 0, at, n) {
        double *const line = s->blocked ? s->flux + at : s->face;
        if (!s->blocked)
            row(x + at, b->stride, w, b->dim, n, line);
        if (b->rows)
            add_weighted(x + at, b->rows->laplace[j_], s->nu, b->stride[1], n, line);
        sum += step_row(x + at, line, r + at, c, alpha, beta, n, y + at);
    }
    if (!s->forcing)
        return sum;
    for (int64_t i = 0; i < s->forcing->nlocal; i++) { /* they stay 0; y is alpha c L x there */
        double *const out = y + s->forcing->local[i];
        sum -= *out / alpha * (*out / alpha);
        *out = 0.0;
    }
    return sum;
}

/* The same without the sum, L x included: w has c nu/12 h^2 along each axis. */
static inline __attribute__((always_inline)) void
whole_row(const double *restrict x, const double *restrict r, const int64_t *stride,
          const double *w, double alpha, double beta, const int dim, int64_t n, double *restrict y)
{
    const int64_t sy = stride[1], sz = dim == 3 ? stride[2] : 0;
    const double ax = alpha * w[0], ay = alpha * w[1], az = dim == 3 ? alpha * w[2] : 0.0,
                 own = 1.0 + beta - alpha - 30.0 * (ax + ay + az), bx = 16.0 * ax, by = 16.0 * ay,
                 bz = 16.0 * az;
    for (int64_t i = 0; i < n; i++) {
        double v = own * x[i] - beta * y[i] + alpha * r[i];
        v += bx * (x[i - 1] + x[i + 1]) - ax * (x[i - 2] + x[i + 2]);
        v += by * (x[i - sy] + x[i + sy]) - ay * (x[i - 2 * sy] + x[i + 2 * sy]);
        if (dim == 3)
            v += bz * (x[i - sz] + x[i + sz]) - az * (x[i - 2 * sz] + x[i + 2 * sz]);
        y[i] = v;
    }
}

/* One step of slab j across the last axis, as in step(). */
static void step_slab(const struct fv *s, int j, double c, double alpha, double beta,
                      const double *x, const double *r, double *y)
{
    const struct block *b = &s->b;
    const int rows = b->dim == 3 ? b->n[1] : 1;
    double w[3];
    for (int a = 0; a < b->dim; a++)
        w[a] = c * s->nu / (12.0 * b->h[a] * b->h[a]);
    for (int i = 0; i < rows; i++) {
        const int64_t at = b->dim == 3 ? block_at(b, 0, i, j) : block_at(b, 0, j, 0);
        if (b->dim == 3)
            whole_row(x + at, r + at, b->stride, w, alpha, beta, 3, b->n[0], y + at);
        else
            whole_row(x + at, r + at, b->stride, w, alpha, beta, 2, b->n[0], y + at);
    }
}

/* Whether all steps can go through the fields at once: the last axis is this rank's alone and
 * closed, rows are even, no cell is imposed. */
static bool goes_at_once(const struct fv *s)
{
    const struct block *b = &s->b;
    const int last = b->dim - 1;
    bool whole = s->bc && !s->blocked && !b->rows && !b->periodic[last];
    for (int a = 0; a < b->dim; a++)
        whole = whole && b->n[a] == b->cells[a];
    return whole && !(s->forcing && s->forcing->nlocal > 0) && b->n[last] > 4;
}

/* Steps of component q, each three slabs behind the one before it, so that what all of them need is
 * in the cache: x has their result if they are even in number, else y. */
static void steps_at_once(const struct fv *s, int q, double c, int n, const double *alpha,
                          const double *beta, double *x, const double *r, double *y)
{
    const int slabs = s->b.n[s->b.dim - 1];
    for (int t = 0; t < slabs + 3 * (n - 1); t++)
        for (int k = 0; k < n; k++) {
            const int j = t - 3 * k;
            double *const from = k % 2 ? y : x, *const to = k % 2 ? x : y;
            if (j < 0 || j >= slabs)
                continue;
            step_slab(s, j, c, alpha[k], beta[k], from, r, to);
            bc_slab_ghosts(s, q, j, to);
            if (j == 2)
                bc_end_ghosts(s, q, false, to);
            if (j == slabs - 1)
                bc_end_ghosts(s, q, true, to);
        }
}

/* delta += A^-1 r, whose square sum is rr; r stays. false: it does not converge as the bounds of
 * the spectrum say. */
static bool chebyshev(struct fv *s, double c, double *const delta[3], double *const r[3], double rr,
                      double goal)
{
    const struct block *b = &s->b;
    const double most = 1.0 + c * largest_eigenvalue(s), theta = 0.5 * (most + 1.0),
                 sigma = (most + 1.0) / (most - 1.0);
    const int wanted = (int)ceil(acosh(sqrt(rr / goal)) / acosh(sigma));
    double *x[3] = {s->work[0], s->work[1], s->work[2]},
           *y[3] = {s->krylov[0][0], s->krylov[0][1], s->krylov[0][2]};
    double rho = 1.0 / sigma, left = rr;
    int done = 0;
    if (!(rr > 0.0))
        return rr == 0.0;
    for (int a = 0; a < b->dim; a++) {
        memset(x[a], 0, (size_t)b->size * sizeof(double));
        memset(y[a], 0, (size_t)b->size * sizeof(double));
        BLOCK_ROWS (b, 0, at, n)
            for (int64_t i = at; i < at + n; i++)
                x[a][i] = r[a][i] / theta;
    }
    if (goes_at_once(s) && wanted > 3) {
        double alpha[AT_ONCE], beta[AT_ONCE];
        done = wanted - 2 < AT_ONCE ? wanted - 2 : AT_ONCE; /* from there on the plain ones look */
        done -= done % 2;
        for (int k = 0; k < done; k++) {
            const double next = 1.0 / (2.0 * sigma - rho);
            alpha[k] = 4.0 * next / (most - 1.0);
            beta[k] = next * rho;
            rho = next;
        }
        bc_ghosts(s, BC_ZERO, x);
        block_halo(b, b->dim, x);
        for (int a = 0; a < b->dim; a++)
            steps_at_once(s, a, c, done, alpha, beta, x[a], r[a], y[a]);
        s->viscous_iterations += done;
    }
    for (int it = done + 1; it <= 2 * wanted + 4 && left > goal; it++) {
        const double next = 1.0 / (2.0 * sigma - rho);
        double sum = 0.0;
        bc_ghosts(s, BC_ZERO, x);
        block_halo(b, b->dim, x);
        for (int a = 0; a < b->dim; a++)
            sum += step(s, a, c, 4.0 * next / (most - 1.0), next * rho, x[a], r[a], y[a]);
        rho = next;
        swap_fields(x, y);
        s->viscous_iterations++;
        if (it < wanted - 1)
            continue;
        MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, b->cart);
        left = sum; /* of the x before this step */
    }
    for (int a = 0; a < b->dim && left <= goal; a++)
        axpy(b, 1.0, x[a], delta[a]);
    return left <= goal;
}

/* Increments of one stage resemble those of the next: a start that is the better the shorter the
 * steps are. Where imposed velocities change they do not; without walls one iteration is enough. */
bool viscous_keeps_increment(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    return s->nu > 0.0 && !s->surface && s->prm.integrator == INTEGRATOR_RK3 &&
           (s->bc || s->blocked || s->b.rows || s->stiffest > 0.0) &&
           !(f && (f->imposed || f->from_partner));
}

/* rhs becomes the residual, work the search direction, u_old's place is not touched; face is
 * scratch. */
bool viscous_solve(struct fv *s, double c, double *const delta[3], double *const rhs[3], double tol)
{
    const struct block *b = &s->b;
    const int dim = b->dim;
    double sums[2] = {0.0, 0.0}, *const Ap[3] = {s->face, s->flux, s->step_work};
    const bool guessed =
        viscous_keeps_increment(s); /* the tolerance is relative to no start at all */
    block_halo(b, dim, delta);
    for (int a = 0; a < dim; a++) {
        helmholtz(s, a, c, delta[a], Ap[a]);
        if (s->blocked) { /* Ap = delta - c L delta */
            memset(s->work[a], 0, (size_t)b->size * sizeof(double));
            blocked_add_slip(s, a, s->work[a]);
            axpy(b, -c, s->work[a], Ap[a]);
        }
        if (s->forcing)
            forcing_zero(s->forcing, rhs[a]);
        if (s->surface)
            surface_zero(s, rhs[a]);
        sums[1] += guessed ? dot(b, rhs[a], rhs[a]) : 0.0;
        axpy(b, -1.0, Ap[a], rhs[a]);
        sums[0] += dot(b, rhs[a], rhs[a]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, b->cart);
    double rr = sums[0];
    const double goal = (guessed ? sums[1] : rr) * tol * tol;
    if (rr <= goal)
        return true;
    if ((s->bc || s->blocked || b->rows) && !s->surface && rr < 1e300 &&
        chebyshev(s, c, delta, rhs, rr, 0.1 * goal))
        return true;
    for (int a = 0; a < dim; a++)
        memcpy(s->work[a], rhs[a], (size_t)b->size * sizeof(double));
    if (s->bc || s->surface || s->blocked || b->rows)
        return bicgstab(s, c, delta, rhs, rr, goal);
    for (int it = 0; it < 200; it++) {
        if (!(rr > goal) || rr == 0.0)
            return rr == rr;
        block_halo(b, dim, s->work);
        sums[0] = 0.0;
        for (int a = 0; a < dim; a++) {
            helmholtz(s, a, c, s->work[a], Ap[a]);
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

/* viscous.c - nu Lap q of cell averages, fourth order: differences of the face gradient
 * (15 (q_0 - q_-1) - (q_1 - q_-2))/12 h; implicit part (helmholtz.h) by conjugate gradients
 * (viscous_single.h); walls and layers of unequal height make it unsymmetric: Chebyshev's iteration
 * there, and with a surface BiCGStab. SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "blocked_cells.h"
#include "helmholtz.h"
#include "operators.h"
#include "viscous_single.h"
#include "viscous_solver.h"

/* The weights (-1, 16, -30, 16, -1)/12 are the difference of the two face gradients. */
void viscous_row(const double *restrict q, const int64_t *stride, const double *c, int dim,
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

/* Adds nu d2q/dy2 with the weights of a row. w[0 .. 4] belong to q_-2 .. q_2. */
static void add_weighted(const double *restrict q, const double *w, double nu, int64_t d, int64_t n,
                         double *restrict out)
{
    const double a = nu * w[0], b = nu * w[1], c = nu * w[2], e = nu * w[3], f = nu * w[4];
    for (int64_t i = 0; i < n; i++)
        out[i] += (b * q[i - d] + e * q[i + d]) + (a * q[i - 2 * d] + f * q[i + 2 * d]) + c * q[i];
}

/* The same of local row j, n cells at q. Along y layers of unequal height have weights of their
 * own. */
static void laplace_row(const struct fv *s, int j, const double *q, int64_t n, double *out)
{
    const struct block *b = &s->b;
    double c[3] = {0.0};
    for (int a = 0; a < b->dim; a++)
        c[a] = a == 1 && b->rows ? 0.0 : s->nu / (12.0 * b->h[a] * b->h[a]);
    viscous_row(q, b->stride, c, b->dim, n, out);
    if (b->rows)
        add_weighted(q, b->rows->laplace[j], s->nu, b->stride[1], n, out);
}

void viscous_apply(const struct fv *s, const double *q, double *out)
{
    BLOCK_WET_AT (s, 0, j, at, n)
        laplace_row(s, j, q + at, n, out + at);
}

/* out = x - c L x of component q, zero in forced cells. */
static void helmholtz(const struct fv *s, int q, double c, const double *x, double *out)
{
    viscous_apply(s, x, out);
    if (s->blocked)
        blocked_viscous(s, q, x, out);
    BLOCK_WET (s, 0, at, n)
        for (int64_t i = at; i < at + n; i++)
            out[i] = x[i] - c * out[i];
    if (s->forcing)
        forcing_zero(s->forcing, out);
    if (s->surface)
        surface_zero(s, out);
}

/* As struct helmholtz wants it: extension into air, ghosts of a difference, halo. Collective. */
static void apply(struct fv *s, double c, double *const x[3], double *const out[3])
{
    if (s->surface)
        extension_apply(s, x, EXTEND_CHANGE, 2);
    bc_ghosts(s, BC_ZERO, x);
    block_halo(&s->b, s->b.dim, x);
    for (int a = 0; a < s->b.dim; a++)
        helmholtz(s, a, c, x[a], out[a]);
}

/* --- steps of Chebyshev's iteration --- */

/* Largest eigenvalue of -h^2 d2/dx2: 16/3 of the periodic differences; that of a mode at a no-slip
 * wall, whose cell has -76/12 on the diagonal, is 7.43 (4 cells: 7.75). It must not be too small:
 * Chebyshev's iteration would diverge. */
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
        most += ranks_max(b->cart, bound);
    }
    return s->nu * most;
}

/* y = x + beta (x - y) + alpha (r - x + c L x) for a row, with L x in its place; sum of the squares
 * of what alpha has. Four partial sums, so that the compiler can vectorise. */
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

/* One step of slab j across the last axis, with its sum. A slab is a row in 2D, a plane in 3D. */
static double step_slab_summed(const struct fv *s, int j, double c, double alpha, double beta,
                               const double *x, const double *r, double *y)
{
    const struct block *b = &s->b;
    double sum = 0.0;
    for (int i = 0; i < (b->dim == 3 ? b->n[1] : 1); i++) {
        const int64_t at = b->dim == 3 ? block_at(b, 0, i, j) : block_at(b, 0, j, 0);
        laplace_row(s, b->dim == 3 ? i : j, x + at, b->n[0], s->faces[0]);
        sum += step_row(x + at, s->faces[0], r + at, c, alpha, beta, b->n[0], y + at);
    }
    return sum;
}

/* One step of component q; boxes make their own of some cells, so that all of L x is there first.
 */
static double step_of(const struct fv *s, int q, const struct helmholtz_course *k, const double *x,
                      const double *r, double *y)
{
    const struct block *b = &s->b;
    double sum = 0.0;
    if (s->blocked) {
        viscous_apply(s, x, s->flux);
        blocked_viscous(s, q, x, s->flux);
    }
    BLOCK_ROWS_AT (b, 0, j, at, n) {
        double *const line = s->blocked ? s->flux + at : s->faces[0];
        if (!s->blocked)
            laplace_row(s, j, x + at, n, line);
        sum += step_row(x + at, line, r + at, k->c, k->alpha, k->beta, n, y + at);
    }
    if (!s->forcing)
        return sum;
    for (int64_t i = 0; i < s->forcing->nlocal; i++) { /* they stay 0; y is alpha c L x there */
        double *const out = y + s->forcing->local[i];
        sum -= *out / k->alpha * (*out / k->alpha);
        *out = 0.0;
    }
    return sum;
}

/* The same without the sum, L x included: w has c nu/12 h^2 along each axis. own, bx, ax: all
 * constants of a step are folded into the stencil's weights, one pass over memory. */
INLINE void whole_row(const double *restrict x, const double *restrict r, const int64_t *stride,
                      const double *w, double alpha, double beta, const int dim, int64_t n,
                      double *restrict y)
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
 * closed, rows are even, no cell is imposed. Then ghosts need neither other ranks nor the other
 * end. */
static bool goes_at_once(const struct fv *s)
{
    const struct block *b = &s->b;
    const int last = b->dim - 1;
    bool whole = s->bc && !s->blocked && !b->rows && !b->periodic[last];
    for (int a = 0; a < b->dim; a++)
        whole = whole && b->n[a] == b->cells[a];
    return whole && !(s->forcing && s->forcing->nlocal > 0) && b->n[last] > 4;
}

/* x = r f, y = 0 in slab j. f = 1/theta = 2/(most + 1). */
static void start_slab(const struct fv *s, int j, double f, const double *restrict r,
                       double *restrict x, double *restrict y)
{
    const struct block *b = &s->b;
    for (int i = 0; i < (b->dim == 3 ? b->n[1] : 1); i++) {
        const int64_t at = b->dim == 3 ? block_at(b, 0, i, j) : block_at(b, 0, j, 0);
        for (int64_t m = at; m < at + b->n[0]; m++) {
            x[m] = r[m] * f;
            y[m] = 0.0;
        }
    }
}

/* The start r/theta and n steps of component q, each three slabs behind the one before it, so that
 * what all of them need is in the cache: x has their result if they are even in number, else y. The
 * sum of the last one. x and y take turns as source and target. Step k of slab j reads step k - 1
 * of slabs j - 2 .. j + 2, hence three slabs behind, ghosts included. */
static double steps_at_once(const struct fv *s, int q, const struct helmholtz_course *step, int n,
                            double *x, const double *r, double *y)
{
    const int slabs = s->b.n[s->b.dim - 1];
    double sum = 0.0;
    for (int t = 0; t < slabs + 3 * n; t++)
        for (int k = 0; k <= n; k++) {
            const int j = t - 3 * k;
            double *const from = k % 2 ? x : y, *const to = k % 2 ? y : x;
            const struct helmholtz_course *e = step + k;
            if (j < 0 || j >= slabs)
                continue;
            if (k == 0)
                start_slab(s, j, 2.0 / (e->most + 1.0), r, x, y);
            else if (k < n)
                step_slab(s, j, e->c, e->alpha, e->beta, from, r, to);
            else
                sum += step_slab_summed(s, j, e->c, e->alpha, e->beta, from, r, to);
            if (k == n)
                continue;
            bc_slab_ghosts(s, q, j, to);
            if (j == 2)
                bc_end_ghosts(s, q, false, to);
            if (j == slabs - 1)
                bc_end_ghosts(s, q, true, to);
        }
    return sum;
}

/* The coefficients of all steps are made first; k is left as after the last one. */
static double all_at_once(struct fv *s, struct helmholtz_course *k, int n, double *x[3],
                          double *const r[3], double *y[3])
{
    struct helmholtz_course step[AT_ONCE + 1];
    double sum = 0.0;
    step[0] = *k;
    for (int i = 1; i <= n; i++) {
        helmholtz_next(k);
        step[i] = *k;
    }
    for (int a = 0; a < s->b.dim; a++)
        sum += steps_at_once(s, a, step, n, x[a], r[a], y[a]);
    return sum;
}

/* One step for all components after ghosts and halo; sum over this rank. */
static double step(struct fv *s, const struct helmholtz_course *k, double *const x[3],
                   double *const r[3], double *const y[3])
{
    double sum = 0.0;
    bc_ghosts(s, BC_ZERO, x);
    block_halo(&s->b, s->b.dim, x);
    for (int a = 0; a < s->b.dim; a++)
        sum += step_of(s, a, k, x[a], r[a], y[a]);
    return sum;
}

/* Increments of one stage resemble those of the next: a start that is the better the shorter the
 * steps are. Where imposed velocities change they do not; without walls one iteration is enough. */
bool viscous_keeps_increment(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    return s->nu > 0.0 && !s->surface && s->prm.integrator == INTEGRATOR_RK3 &&
           (s->bc || s->blocked || s->b.rows || viscous_stiffest(s) > 0.0) &&
           !(f && (f->imposed || f->from_partner));
}

/* r -= d - c L d for a row, with L d in its place; adds the squares of what is there then and was
 * before. */
static void residual_row(const double *restrict d, const double *restrict L, double c, int64_t n,
                         double *restrict r, double sums[2])
{
    double part[2][4] = {{0.0}};
    int64_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (int m = 0; m < 4; m++) {
            const double before = r[i + m], left = before - d[i + m] + c * L[i + m];
            r[i + m] = left;
            part[0][m] += left * left;
            part[1][m] += before * before;
        }
    for (; i < n; i++) {
        const double before = r[i], left = before - d[i] + c * L[i];
        r[i] = left;
        part[0][0] += left * left;
        part[1][0] += before * before;
    }
    for (int k = 0; k < 2; k++)
        sums[k] += (part[k][0] + part[k][1]) + (part[k][2] + part[k][3]);
}

/* Whether delta starts at 0, ghosts included: no cell is imposed, no side makes a change of its
 * own, and no increment was kept. Then rhs is the residual. */
static bool starts_at_zero(const struct fv *s)
{
    const struct forcing *f = s->forcing;
    bool zero =
        !(f && (f->imposed || f->from_partner)) && !s->blocked && !viscous_keeps_increment(s);
    for (int k = 0; s->bc && k < 6; k++)
        zero = zero && (!s->bc->wall[k] || s->bc->kind[k] == MESH_SLIP);
    return zero;
}

/* rhs of component q becomes what the start leaves of it; zero in forced cells. sums[0]: squares of
 * the residual, sums[1]: of rhs as it came. */
static void start_residual(const struct fv *s, int q, double c, const double *start, double *rhs,
                           double sums[2])
{
    if (s->forcing)
        forcing_zero(s->forcing, rhs);
    if (s->surface)
        surface_zero(s, rhs);
    if (starts_at_zero(s)) {
        sums[0] = sums[1] += helmholtz_dot(s, rhs, rhs);
        return;
    }
    if (s->blocked || s->surface || (s->forcing && s->forcing->nlocal > 0)) {
        helmholtz(s, q, c, start, s->faces[0]);
        if (s->blocked) { /* start - c L start */
            memset(s->viscous->work[0][q], 0, (size_t)s->b.size * sizeof(double));
            blocked_add_slip(s, q, s->viscous->work[0][q]);
            helmholtz_add(s, -c, s->viscous->work[0][q], s->faces[0]);
            if (s->surface) /* faces in air are no part of the system */
                surface_zero(s, s->faces[0]);
        }
        sums[1] += helmholtz_dot(s, rhs, rhs);
        helmholtz_add(s, -1.0, s->faces[0], rhs);
        sums[0] += helmholtz_dot(s, rhs, rhs);
        return;
    }
    BLOCK_WET_AT (s, 0, j, at, n) {
        laplace_row(s, j, start + at, n, s->faces[0]);
        residual_row(start + at, s->faces[0], c, n, rhs + at, sums);
    }
}

/* Friction so weak that one term or two of Neumann's series are the increment needs no residual of
 * that start. */
static bool solve_weak(const struct helmholtz *h, double tol, double *const delta[3],
                       double *const rhs[3])
{
    struct fv *s = h->s;
    if (!s->surface || !starts_at_zero(s) || !helmholtz_is_weak(h, tol))
        return false;
    for (int a = 0; a < s->dim; a++)
        surface_zero(s, rhs[a]);
    if (helmholtz_is_nothing(h, greater(tol, helmholtz_plain_tolerance(s))))
        for (int a = 0; a < s->dim; a++)
            helmholtz_add(s, 1.0, rhs[a], delta[a]);
    else
        helmholtz_once(h, delta, rhs);
    return true;
}

/* rhs becomes the residual. Chebyshev's goal is a tenth (a third of the residual's norm), since its
 * last sum comes one step late; should it fail, BiCGStab goes on from the same start. */
bool viscous_solve(struct fv *s, double c, double *const delta[3], double *const rhs[3], double tol)
{
    const struct block *b = &s->b;
    const bool walls = s->bc || s->blocked || b->rows;
    double sums[2] = {0.0, 0.0}, *(*work)[3] = s->viscous->work;
    const struct helmholtz h = {.s = s,
                                .c = c,
                                .largest = largest_eigenvalue(s),
                                .apply = apply,
                                .zero = s->surface ? surface_zero : NULL,
                                .step = step,
                                .work = {work[0], work[1], work[2], work[3]}};
    if (solve_weak(&h, tol, delta, rhs))
        return true;
    if (!starts_at_zero(s))
        block_halo(b, b->dim, delta);
    for (int a = 0; a < b->dim; a++)
        start_residual(s, a, c, delta[a], rhs[a], sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, b->cart);
    const double rr = sums[0], goal = tol * tol * (viscous_keeps_increment(s) ? sums[1] : rr);
    if (rr <= goal) /* the tolerance is relative to no start at all */
        return true;
    if (!(goal > 0.0) && rr == rr) { /* a flow that is steady to the last digit */
        for (int k = 0; k < s->dim; k++)
            memset(delta[k], 0, (size_t)s->size * sizeof(double));
        return true;
    }
    if (s->surface && helmholtz_is_weak(&h, tol)) {
        helmholtz_once(&h, delta, rhs);
        return rr == rr;
    }
    if (!walls && !s->surface)
        return viscous_single_cg(&h, delta, rhs, rr, goal);
    return (walls && !s->surface && rr < 1e300 &&
            helmholtz_chebyshev(&h, delta, rhs, rr, 0.1 * goal,
                                goes_at_once(s) ? all_at_once : NULL)) ||
           helmholtz_bicgstab(&h, delta, rhs, rr, goal);
}

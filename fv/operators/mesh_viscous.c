/* mesh_viscous.c - implicit viscosity on blocks, all components at once, with the fringe
 * interpolated within the operator: Chebyshev's iteration as in viscous.c (a pass over the fields a
 * step and no sums), where the cells' own rates say that it takes few steps; else, and should the
 * bounds fail, BiCGSTAB (van der Vorst 1992) scaled by the diagonal, which cells of very different
 * size want. SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/mesh_bc.h"
#include "mesh_ops.h"
#include "../fv.h"
#include "../grid/mesh.h"
#include "../surface/levelset.h"
#include "operators.h"

#include <math.h>
#include <string.h>

enum { FEW = 24 }; /* steps of Chebyshev's iteration: beyond, BiCGSTAB finds the few stiff cells */

static const int none[3] = {0, 0, 0};

/* y = y f + g x over the local cells. */
static void combine(const struct mesh *m, double *restrict y, double f, double g,
                    const double *restrict x)
{
    for (int q = 0; q < m->nparts; q++)
        PART_ROWS (m->part + q, none, none, c, n)
            for (int64_t i = c; i < c + n; i++)
                y[i] = f * y[i] + g * x[i];
}

/* Eight sums side by side, or each addition waits for the one before. */
static double dot_row(const double *restrict a, const double *restrict b, int64_t n)
{
    double part[8] = {0.0};
    int64_t i = 0;
    for (; i + 8 <= n; i += 8)
        for (int k = 0; k < 8; k++)
            part[k] += a[i + k] * b[i + k];
    for (; i < n; i++)
        part[0] += a[i] * b[i];
    return ((part[0] + part[1]) + (part[2] + part[3])) +
           ((part[4] + part[5]) + (part[6] + part[7]));
}

static void dots(const struct mesh *m, int n, double *const (*pair)[2], double *sums)
{
    for (int k = 0; k < n; k++) {
        sums[k] = 0.0;
        const double *restrict a = pair[k][0], *restrict b = pair[k][1];
        for (int q = 0; q < m->nparts; q++)
            PART_ROWS (m->part + q, none, none, c, len)
                sums[k] += dot_row(a + c, b + c, len);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, n, MPI_DOUBLE, MPI_SUM, m->comm);
}

static double dot(const struct mesh *m, int dim, double *const x[3], double *const y[3])
{
    double sums[3], sum = 0.0;
    double *pair[3][2];
    for (int a = 0; a < dim; a++) {
        pair[a][0] = x[a];
        pair[a][1] = y[a];
    }
    dots(m, dim, (double *const(*)[2])pair, sums);
    for (int a = 0; a < dim; a++)
        sum += sums[a];
    return sum;
}

/* out = (1 - c L) x over the diagonal, in computed cells; x's ghosts and fringe are set. */
static void apply(struct fv *s, double c, double *const x[3], double *const out[3])
{
    if (s->surface)
        extension_apply(s, x, EXTEND_CHANGE, STENCILS);
    mesh_fill(s->m, s->m->dim, x);
    mesh_bc_velocity(s, BC_ZERO, x);
    for (int a = 0; a < s->m->dim; a++) {
        mesh_viscous(s, x[a], out[a]);
        for (int q = 0; q < s->m->nparts; q++)
            PART_ROWS (s->m->part + q, none, none, at, n)
                for (int64_t i = at; i < at + n; i++)
                    out[a][i] = s->free[i] * (x[a][i] - c * out[a][i]) / (1.0 + c * s->scale[i]);
    }
}

/* delta += A^-1 rhs until the square of the residual, scaled, is `share' of the first. */
static bool bicgstab(struct fv *s, double c, double share)
{
    const struct mesh *m = s->m;
    const int dim = m->dim;
    double *const *x = s->delta, *const *r = s->rhs, *const *r0 = s->krylov[0],
                  *const *p = s->krylov[1], *const *v = s->krylov[2], *const *t = s->krylov[3];
    double rho = 1.0, alpha = 1.0, omega = 1.0, first;
    for (int a = 0; a < dim; a++) {
        for (int q = 0; q < m->nparts; q++)
            PART_ROWS (m->part + q, none, none, at, n)
                for (int64_t i = at; i < at + n; i++) {
                    r[a][i] *= s->free[i] / (1.0 + c * s->scale[i]);
                    r0[a][i] = r[a][i];
                    p[a][i] = v[a][i] = 0.0;
                }
    }
    first = dot(m, dim, r, r);
    if (!(first > 0.0))
        return first == 0.0;
    for (int it = 0; it < 200; it++) {
        const double rho_next = dot(m, dim, r0, r), beta = rho_next / rho * alpha / omega;
        rho = rho_next;
        for (int a = 0; a < dim; a++) {
            combine(m, p[a], beta, -beta * omega, v[a]);
            combine(m, p[a], 1.0, 1.0, r[a]);
        }
        apply(s, c, p, v);
        alpha = rho / dot(m, dim, r0, v);
        for (int a = 0; a < dim; a++) {
            combine(m, r[a], 1.0, -alpha, v[a]);
            combine(m, x[a], 1.0, alpha, p[a]);
        }
        s->viscous_iterations++;
        if (dot(m, dim, r, r) <= share * first)
            return true;
        apply(s, c, r, t);
        for (int a = 0; a < dim && s->surface; a++)
            surface_zero(s, r[a]);
        const double tt = dot(m, dim, t, t);
        omega = tt > 0.0 ? dot(m, dim, t, r) / tt : 0.0;
        for (int a = 0; a < dim; a++) {
            combine(m, x[a], 1.0, omega, r[a]);
            combine(m, r[a], 1.0, -omega, t[a]);
        }
        if (dot(m, dim, r, r) <= share * first)
            return true;
        if (!(omega != 0.0))
            return false;
    }
    return false;
}

static double square(const struct mesh *m, double *const x[3]) { return dot(m, m->dim, x, x); }

/* 1/s: largest eigenvalue of -L, by cells: that of differences along one axis is 16/3, at a no-slip
 * side 7.8 (viscous.c), in units of nu G/V. */
double mesh_viscous_largest(const struct fv *s)
{
    const struct mesh *m = s->m;
    double most = 0.0;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_CELLS (p, i, c) {
            double sum = 0.0;
            for (int a = 0; a < m->dim && (s->free[c] > 0.0 || m->moves); a++) {
                const int64_t d = p->stride[a];
                const bool side =
                    m->moves ? m->open[a][c] == 0.0 || m->open[a][c + d] == 0.0
                             : m->status[c - d] == CELL_HOLE || m->status[c + d] == CELL_HOLE;
                for (int b = 0; b < m->dim; b++)
                    sum += (side ? 7.8 : 16.0 / 3.0) * 0.5 *
                           (fabs(m->G[a][b][c]) + fabs(m->G[a][b][c + d]));
            }
            most = fmax(most, sum / m->V[c]);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, m->comm);
    return s->nu * most;
}

static double step_row(const double *restrict x, const double *restrict L, const double *restrict r,
                       const double *restrict is_free, double c, double alpha, double beta,
                       int64_t n, double *restrict y)
{
    double part[8] = {0.0};
    int64_t i = 0;
    for (; i + 8 <= n; i += 8)
        for (int k = 0; k < 8; k++) {
            const double left = is_free[i + k] * (r[i + k] - x[i + k] + c * L[i + k]);
            y[i + k] = x[i + k] + beta * (x[i + k] - y[i + k]) + alpha * left;
            part[k] += left * left;
        }
    for (; i < n; i++) {
        const double left = is_free[i] * (r[i] - x[i] + c * L[i]);
        y[i] = x[i] + beta * (x[i] - y[i]) + alpha * left;
        part[0] += left * left;
    }
    return ((part[0] + part[1]) + (part[2] + part[3])) +
           ((part[4] + part[5]) + (part[6] + part[7]));
}

/* y = x + beta (x - y) + alpha (r - x + c L x); the sum of the squares of what alpha has, of this
 * rank. */
static double step(struct fv *s, double c, double alpha, double beta, double *const x[3],
                   double *const r[3], double *const y[3])
{
    double sum = 0.0;
    mesh_fill(s->m, s->dim, x);
    mesh_bc_velocity(s, BC_ZERO, x);
    for (int a = 0; a < s->dim; a++) {
        const double *restrict from = x[a], *restrict b = r[a], *restrict L = s->krylov[1][0];
        double *restrict to = y[a];
        mesh_viscous(s, x[a], s->krylov[1][0]);
        FLOW_ROWS(s, at, n)
        sum += step_row(from + at, L + at, b + at, s->free + at, c, alpha, beta, n, to + at);
    }
    return sum;
}

static void swap(double *a[3], double *b[3])
{
    for (int k = 0; k < 3; k++) {
        double *const t = a[k];
        a[k] = b[k];
        b[k] = t;
    }
}

/* delta += A^-1 r; r stays. false: it takes too many steps, or more than the bounds say. */
static bool chebyshev(struct fv *s, double c, double rr, double goal)
{
    const double most = 1.0 + c * s->stiffest, theta = 0.5 * (most + 1.0),
                 sigma = (most + 1.0) / (most - 1.0);
    const int wanted = (int)ceil(acosh(sqrt(rr / goal)) / acosh(sigma));
    double *const *r = s->rhs, *x[3], *y[3], rho = 1.0 / sigma, left = rr;
    if (wanted > FEW)
        return false;
    for (int a = 0; a < s->dim; a++) {
        x[a] = s->krylov[2][a];
        y[a] = s->krylov[3][a];
        memset(y[a], 0, (size_t)s->size * sizeof(double));
        FLOW_ROWS(s, at, n)
        for (int64_t i = at; i < at + n; i++)
            x[a][i] = r[a][i] / theta;
    }
    for (int it = 1; it <= 2 * wanted + 4 && left > goal; it++) {
        const double next = 1.0 / (2.0 * sigma - rho);
        double sum = step(s, c, 4.0 * next / (most - 1.0), next * rho, x, r, y);
        rho = next;
        swap(x, y);
        s->viscous_iterations++;
        if (it < wanted - 1)
            continue;
        MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->comm);
        left = sum * next * next; /* of the x before this step, and what a step takes off it */
    }
    for (int a = 0; a < s->dim && left <= goal; a++)
        combine(s->m, s->delta[a], 1.0, 1.0, x[a]);
    return left <= goal;
}

bool mesh_viscous_solve(struct fv *s, double c, double tol)
{
    const struct mesh *m = s->m;
    double *restrict L = s->krylov[1][0];
    for (int a = 0; a < s->dim; a++)
        FLOW_ROWS(s, at, n)
    for (int64_t i = at; i < at + n; i++)
        s->rhs[a][i] *= s->free[i];
    const double whole = square(m, s->rhs);
    mesh_fill(s->m, s->dim, s->delta);
    for (int a = 0; a < s->dim && s->change[0]; a++)
        for (int64_t i = 0; i < s->size; i++)
            s->delta[a][i] += s->change[a][i];
    mesh_bc_velocity(s, BC_CHANGE, s->delta);
    for (int a = 0; a < s->dim; a++) {
        const double *restrict d = s->delta[a];
        double *restrict r = s->rhs[a];
        mesh_viscous(s, s->delta[a], L);
        FLOW_ROWS(s, at, n)
        for (int64_t i = at; i < at + n; i++)
            r[i] += s->free[i] * (c * L[i] - d[i]);
    }
    const double rr = square(m, s->rhs), goal = tol * tol * fmax(rr, whole);
    if (rr <= goal)
        return true;
    return (s->stiffest > 0.0 && !s->surface && rr < 1e300 && chebyshev(s, c, rr, goal)) ||
           bicgstab(s, c, goal / rr);
}

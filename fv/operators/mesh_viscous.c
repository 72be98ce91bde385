/* mesh_viscous.c - implicit viscosity on blocks: BiCGSTAB (van der Vorst 1992) over all components
 * at once, with the fringe interpolated within the operator. SPDX-License-Identifier: BSD-3-Clause
 */
#include "../boundary/mesh_bc.h"
#include "mesh_ops.h"
#include "../fv.h"
#include "../grid/mesh.h"
#include "../surface/levelset.h"

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

static void dots(const struct mesh *m, int n, double *const (*pair)[2], double *sums)
{
    for (int k = 0; k < n; k++) {
        sums[k] = 0.0;
        const double *restrict a = pair[k][0], *restrict b = pair[k][1];
        for (int q = 0; q < m->nparts; q++)
            PART_ROWS (m->part + q, none, none, c, len)
                for (int64_t i = c; i < c + len; i++)
                    sums[k] += a[i] * b[i];
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

/* (1 - c L) delta = rhs from delta = 0, all components together. */
bool mesh_viscous_solve(struct fv *s, double c, double tol)
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
                    x[a][i] = p[a][i] = v[a][i] = 0.0;
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
        if (dot(m, dim, r, r) <= tol * tol * first)
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
        if (dot(m, dim, r, r) <= tol * tol * first)
            return true;
        if (!(omega != 0.0))
            return false;
    }
    return false;
}

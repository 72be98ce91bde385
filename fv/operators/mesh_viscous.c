/* mesh_viscous.c - implicit viscosity on blocks (helmholtz.h), with the fringe interpolated within
 * the operator: Chebyshev's iteration where there are walls and the cells' own rates say that it
 * takes few steps; else, and should the bounds fail, BiCGStab scaled by the diagonal, which cells
 * of very different size want; between joins of like cells conjugate gradients.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"
#include "helmholtz.h"
#include "mesh_ops.h"
#include "viscous_solver.h"

/* out = (1 - c L) x over the diagonal, in computed cells; x's ghosts and fringe are set. Scaling by
 * the diagonal makes cells of very different size alike for BiCGStab. */
static void apply(struct fv *s, double c, double *const x[3], double *const out[3])
{
    const double *scale = s->viscous->scale;
    if (s->surface)
        extension_apply(s, x, EXTEND_CHANGE, STENCILS);
    mesh_fill(s->m, s->m->dim, x);
    mesh_bc_velocity(s, BC_ZERO, x);
    for (int a = 0; a < s->m->dim; a++) {
        mesh_viscous(s, x[a], out[a]);
        for (int q = 0; q < s->m->nparts; q++)
            PART_ROWS (s->m->part + q, no_layers, no_layers, at, n)
                for (int64_t i = at; i < at + n; i++)
                    out[a][i] = s->free[i] * (x[a][i] - c * out[a][i]) / (1.0 + c * scale[i]);
    }
}

/* Non-uniform cells, fringe and no-slip ghosts make it unsymmetric. */
bool mesh_viscous_symmetric(const struct fv *s)
{
    bool plain = !s->m->uneven && !s->m->has_fringe && !s->m->moves;
    for (int q = 0; q < s->grid.nparts; q++)
        plain = plain && s->grid.part[q].kind == PART_EVEN;
    for (int k = 0; k < s->m->nblocks; k++)
        for (int q = 0; q < 2 * s->m->dim; q++)
            plain = plain && (s->m->block[k].side[q] == MESH_JOINED ||
                              s->m->block[k].side[q] == MESH_PERIODIC);
    return ranks_all(s->comm, plain);
}

/* 1/s: largest eigenvalue of -L, by cells: that of differences along one axis is 16/3, at a no-slip
 * side 7.8 (viscous.c), in units of nu G/V. Blocks that move may uncover any cell, so all of theirs
 * count. Collective. */
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
    return s->nu * ranks_max(m->comm, most);
}

/* left = free (r - x + c L x); y = x + beta (x - y) + alpha left. Returns the sum of left^2, in
 * SUM_LANES partial sums. */
static double step_row(const double *restrict x, const double *restrict L, const double *restrict r,
                       const double *restrict is_free, double c, double alpha, double beta,
                       int64_t n, double *restrict y)
{
    double part[SUM_LANES] = {0.0};
    int64_t i = 0;
    for (; i + SUM_LANES <= n; i += SUM_LANES)
        for (int k = 0; k < SUM_LANES; k++) {
            const double left = is_free[i + k] * (r[i + k] - x[i + k] + c * L[i + k]);
            y[i + k] = x[i + k] + beta * (x[i + k] - y[i + k]) + alpha * left;
            part[k] += left * left;
        }
    for (; i < n; i++) {
        const double left = is_free[i] * (r[i] - x[i] + c * L[i]);
        y[i] = x[i] + beta * (x[i] - y[i]) + alpha * left;
        part[0] += left * left;
    }
    return lanes_sum(part);
}

/* One step of Chebyshev's iteration for all components; sum over this rank. */
static double step(struct fv *s, const struct helmholtz_course *k, double *const x[3],
                   double *const r[3], double *const y[3])
{
    double sum = 0.0, *L = s->viscous->work[2][0];
    mesh_fill(s->m, s->dim, x);
    mesh_bc_velocity(s, BC_ZERO, x);
    for (int a = 0; a < s->dim; a++) {
        mesh_viscous(s, x[a], L);
        FLOW_ROWS (s, at, n)
            sum += step_row(x[a] + at, L + at, r[a] + at, s->free + at, k->c, k->alpha, k->beta, n,
                            y[a] + at);
    }
    return sum;
}

/* 0 in cells that are not computed, and in air. */
static void zero(const struct fv *s, double *x)
{
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++)
            x[i] *= s->free[i];
    if (s->surface)
        surface_zero(s, x);
}

/* x.x over all components and ranks. */
static double square(const struct fv *s, double *const x[3])
{
    double sum = 0.0;
    for (int a = 0; a < s->dim; a++)
        sum += helmholtz_dot(s, x[a], x[a]);
    return ranks_sum(s->comm, sum);
}

/* rhs -= (1 - c L) delta, where delta has what the sides change from the old velocity to the new
 * one, and on moving blocks the fringe's jump. */
static void start_residual(struct fv *s, double c)
{
    double *restrict L = s->viscous->work[2][0];
    mesh_fill(s->m, s->dim, s->delta);
    for (int a = 0; a < s->dim && s->fringe.delta[0]; a++)
        for (int64_t i = 0; i < s->size; i++)
            s->delta[a][i] += s->fringe.delta[a][i];
    mesh_bc_velocity(s, BC_CHANGE, s->delta);
    for (int a = 0; a < s->dim; a++) {
        const double *restrict d = s->delta[a];
        double *restrict r = s->rhs[a];
        mesh_viscous(s, s->delta[a], L);
        FLOW_ROWS (s, at, n)
            for (int64_t i = at; i < at + n; i++)
                r[i] += s->free[i] * (c * L[i] - d[i]);
    }
}

enum { FEW = 24 }; /* steps of Chebyshev's iteration: beyond, BiCGStab finds the few stiff cells */

/* tol is relative to rhs as it comes. Order of choice: nothing to do; one term of Neumann's series
 * (surface, short steps); Chebyshev (walls, at most FEW steps); CG or BiCGStab. */
bool mesh_viscous_solve(struct fv *s, double c, double tol)
{
    const struct viscous_solver *v = s->viscous;
    const struct helmholtz h = {.s = s,
                                .c = c,
                                .largest = v->stiffest,
                                .apply = apply,
                                .zero = s->m->has_fringe || s->surface ? zero : NULL,
                                .step = step,
                                .work = {v->work[0], v->work[1], v->work[2], v->work[3]}};
    for (int a = 0; a < s->dim; a++)
        zero(s, s->rhs[a]);
    const double whole = square(s, s->rhs);
    start_residual(s, c);
    const double rr = square(s, s->rhs), share = tol * tol * fmax(1.0, whole / rr);
    if (!(rr > 0.0) || share >= 1.0)
        return rr == rr;
    if (v->stiffest > 0.0 && s->surface && helmholtz_is_weak(&h, sqrt(share))) {
        helmholtz_once(&h, s->delta, s->rhs);
        return true;
    }
    if (v->stiffest > 0.0 && !s->surface && rr < 1e300 &&
        helmholtz_steps(&h, rr, share * rr) <= FEW &&
        helmholtz_chebyshev(&h, s->delta, s->rhs, rr, share * rr, NULL))
        return true;
    for (int a = 0; a < s->dim; a++)
        FLOW_ROWS (s, at, n)
            for (int64_t i = at; i < at + n; i++)
                s->rhs[a][i] /= 1.0 + c * v->scale[i];
    const double scaled = square(s, s->rhs);
    return (v->symmetric && !s->surface ? helmholtz_cg : helmholtz_bicgstab)(
        &h, s->delta, s->rhs, scaled, share * scaled);
}

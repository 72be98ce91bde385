/* mesh_step.c - rk3 on a mesh of blocks: as projection.c has it, a projection each stage, viscosity
 * implicit by BiCGSTAB with the fringe interpolated within the operator.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_flow.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../common/mem.h"
#include "limits.h"
#include "rk3.h"
#include "watches.h"

static const int none[3] = {0, 0, 0};

static void start(struct mesh_flow *s, const char *timer)
{
    timer_start(&s->run->timers, timer_index(&s->run->timers, timer));
}
static void stop(struct mesh_flow *s, const char *timer)
{
    timer_stop(&s->run->timers, timer_index(&s->run->timers, timer));
}

static void fill_velocity(struct mesh_flow *s, enum mesh_value what, double *const u[3])
{
    mesh_fill(s->m, s->m->dim, u);
    mesh_bc_velocity(s, what, u);
}

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
static void apply(struct mesh_flow *s, double c, double *const x[3], double *const out[3])
{
    fill_velocity(s, MESH_ZERO, x);
    for (int a = 0; a < s->m->dim; a++) {
        mesh_viscous(s, x[a], out[a]);
        for (int q = 0; q < s->m->nparts; q++)
            PART_ROWS (s->m->part + q, none, none, at, n)
                for (int64_t i = at; i < at + n; i++)
                    out[a][i] = s->free[i] * (x[a][i] - c * out[a][i]) / (1.0 + c * s->scale[i]);
    }
}

/* (1 - c L) delta = rhs from delta = 0, all components together. */
static bool solve_viscous(struct mesh_flow *s, double c, double tol)
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

/* rhs = dt [(alpha+beta)(L u - Gc p + g) - gamma N - zeta N_old], averages over indices. */
static void stage_rhs(struct mesh_flow *s, double dt, double ab, double gamma, double zeta)
{
    const struct mesh *m = s->m;
    for (int a = 0; a < m->dim; a++) {
        if (s->nu > 0.0)
            mesh_viscous(s, s->u[a], s->rhs[a]);
        else
            memset(s->rhs[a], 0, (size_t)m->size_local * sizeof(double));
        double *restrict r = s->rhs[a];
        for (int q = 0; q < m->nparts; q++)
            PART_ROWS (m->part + q, none, none, c, n)
                for (int64_t i = c; i < c + n; i++)
                    r[i] = dt * s->free[i] *
                           (ab * (r[i] - s->step_p[a][i] + s->drive[a]) - gamma * s->N[a][i] -
                            zeta * s->N_old[a][i]);
    }
    if (!s->uneven)
        return;
    mesh_fill(s->m, m->dim, s->rhs);
    for (int a = 0; a < m->dim; a++) {
        mesh_bc_even(s, false, s->rhs[a]);
        mesh_to_index(s, s->rhs[a], s->flux);
    }
}

static bool add_increment(struct mesh_flow *s, double c)
{
    bool good = true;
    for (int a = 0; a < s->m->dim && s->nu > 0.0; a++)
        memset(s->delta[a], 0, (size_t)s->m->size_local * sizeof(double));
    if (s->nu > 0.0) /* what the sides do from one time to the next */
        mesh_bc_velocity(s, MESH_CHANGE, s->delta);
    for (int a = 0; a < s->m->dim && s->nu > 0.0; a++) {
        mesh_viscous(s, s->delta[a], s->krylov[0][0]);
        combine(s->m, s->rhs[a], 1.0, c, s->krylov[0][0]);
    }
    const double tol = s->prm.tol_viscous > 0.0 ? s->prm.tol_viscous : 1e-4;
    if (s->nu > 0.0)
        good = solve_viscous(s, c, tol);
    for (int a = 0; a < s->m->dim; a++)
        combine(s->m, s->u[a], 1.0, 1.0, s->nu > 0.0 ? s->delta[a] : s->rhs[a]);
    return good;
}

void mesh_project(struct mesh_flow *s, int stage, double tau, double tol)
{
    double *psi = s->psi[stage];
    const struct mesh *m = s->m;
    start(s, "operators");
    fill_velocity(s, MESH_AHEAD, s->u);
    mesh_face_velocities(s, s->u, s->U);
    mesh_bc_fluxes(s, s->U);
    mesh_divergence(s, s->U, s->flux);
    stop(s, "operators");
    start(s, "pressure");
    s->failed = !mesh_pressure_solve(s, tau, s->flux, tol, s->start[stage], psi) || s->failed;
    stop(s, "pressure");
    start(s, "operators");
    mesh_halo(s->m, 1, &psi);
    mesh_bc_even(s, true, psi);
    mesh_subtract_psi(s, tau, psi, s->U);
    mesh_gradient(s, psi, s->grad);
    for (int a = 0; a < m->dim; a++)
        combine(m, s->u[a], 1.0, -tau, s->grad[a]);
    fill_velocity(s, MESH_GIVEN, s->u);
    stop(s, "operators");
}

static void swap(double *a[3], double *b[3])
{
    for (int k = 0; k < 3; k++) {
        double *t = a[k];
        a[k] = b[k];
        b[k] = t;
    }
}

static void pressure_gradient(struct mesh_flow *s)
{
    mesh_fill(s->m, 1, &s->p);
    if (s->prm.upwind > 0.0 || s->m->has_fringe) {
        mesh_smooth_pressure(s);
        mesh_fill(s->m, 1, &s->p);
    }
    mesh_bc_pressure(s, s->p);
    mesh_gradient(s, s->p, s->step_p);
}

/* The residual says little about waves as long as the grid, which make forces: a smaller one is
 * wanted than where a cycle of PFMG takes all waves alike. */
static bool step_rk3(struct mesh_flow *s, double dt)
{
    const double last = 0.1 * s->prm.tol_pressure, first = fmin(10.0 * last, 0.1), t = s->t;
    bool good = true;
    start(s, "operators");
    pressure_gradient(s);
    stop(s, "operators");
    for (int k = 0; k < 3; k++) {
        const double ab = rk3_alpha[k] + rk3_beta[k];
        start(s, "convection");
        swap(s->N, s->N_old);
        mesh_convection(s, s->N);
        stop(s, "convection");
        start(s, "viscous");
        mesh_bc_time(s, t + rk3_at[k] * dt);
        mesh_bc_set_slip(s, ab * dt, s->psi[k]);
        stage_rhs(s, dt, ab, rk3_gamma[k], rk3_zeta[k]);
        good = add_increment(s, rk3_beta[k] * dt) && good;
        stop(s, "viscous");
        mesh_project(s, k, ab * dt, k == 2 ? last : first);
    }
    memcpy(s->p_before, s->p, (size_t)s->m->size_local * sizeof(double));
    combine(s->m, s->p, 1.0, 1.0, s->psi[2]);
    return good;
}

/* Largest sum over the indices of the rates of crossing cells, 1/s, and largest speed; what forces
 * add to the rate in a second. */
void mesh_measure(struct mesh_flow *s)
{
    const struct mesh *m = s->m;
    double most[3] = {0.0, 0.0, 0.0}, speed = 0.0, poison = 0.0;
    for (int q = 0; q < m->nparts; q++) {
        const struct mesh_part *p = m->part + q;
        PART_ROWS (p, none, none, c, n)
            for (int64_t i = c; i < c + n; i++) {
                double u2 = 0.0, rate = 0.0, rise = 0.0;
                if (s->free[i] == 0.0)
                    continue;
                for (int a = 0; a < m->dim; a++) {
                    double F = 0.0, G = 0.0;
                    for (int k = 0; k < m->dim; k++) {
                        const double S = 0.5 * (m->S[a][k][i] + m->S[a][k][i + p->stride[a]]);
                        F += s->u[k][i] * S;
                        G += s->drive[k] * S;
                    }
                    rate += fabs(F);
                    rise += fabs(G);
                    u2 += s->u[a][i] * s->u[a][i];
                    poison += 0.0 * s->u[a][i];
                }
                most[0] = fmax(most[0], rate / m->V[i]);
                most[1] = fmax(most[1], u2);
                most[2] = fmax(most[2], rise / m->V[i]);
            }
    }
    most[1] = poison == 0.0 ? sqrt(most[1]) : INFINITY;
    most[0] = fmax(most[0], mesh_bc_rate(s, &speed));
    MPI_Allreduce(MPI_IN_PLACE, most, 3, MPI_DOUBLE, MPI_MAX, m->comm);
    s->rate = most[0];
    s->umax = most[1];
    s->rise = most[2];
}

static void describe_worst(const struct mesh_flow *s, double before, struct diagnosis *d)
{
    const struct mesh *m = s->m;
    double worst = -1.0;
    for (int q = 0; q < m->nparts; q++) {
        const struct mesh_part *p = m->part + q;
        const struct mesh_block *b = m->block + p->block;
        int i[3];
        PART_CELLS (p, i, c)
            for (int a = 0; a < m->dim; a++) {
                const double v = isfinite(s->u[a][c]) ? fabs(s->u[a][c]) : 1e300;
                const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
                const double *x = b->centre[mesh_cell(b, at)];
                if (s->free[c] == 0.0 || v <= worst || v <= s->u_limit)
                    continue;
                worst = v;
                d->bad = true;
                snprintf(d->reason, sizeof d->reason,
                         "velocity of cell (%d, %d, %d) of block \"%s\" is %g m/s, limit %g m/s",
                         at[0], at[1], at[2], b->prm->name, v < 1e300 ? v : NAN, s->u_limit);
                snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, step of %g s, limited by %s",
                         x[0], x[1], x[2], s->dt, limit_name(s->limit));
                limits_explain(&s->prm, s->limit, before, s->rate * s->dt, false, d->likely,
                               sizeof d->likely);
            }
    }
}

double mesh_integrate(struct mesh_flow *s, double t_stop, struct diagnosis *d)
{
    const double left = t_stop - s->t, most = limits_time(s->prm.cfl, s->rate, s->rise);
    const double n = fmax(ceil(left / most - 1e-9), 1.0), dt = left / n, before = s->rate * dt;
    s->limit = dt < 0.5 * most            ? LIMIT_OUTPUT
               : s->rise * most > s->rate ? LIMIT_FORCES
                                          : LIMIT_FLOW;
    s->failed = false;
    s->defect_now = 0.0;
    const bool good = step_rk3(s, dt);
    s->t = n <= 1.0 ? t_stop : s->t + dt;
    s->dt_old = s->dt;
    s->dt = dt;
    mesh_measure(s);
    s->max_cfl = fmax(s->max_cfl, s->rate * dt);
    s->defect = fmax(s->defect, s->defect_now);
    if (!(s->umax <= s->u_limit))
        describe_worst(s, before, d);
    else if (!good || s->failed) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason,
                 good ? "the pressure solver did not converge, nor did the safer one"
                      : "the viscous solver did not converge in 200 iterations");
        snprintf(d->where, sizeof d->where, "step of %g s", dt);
        snprintf(d->likely, sizeof d->likely,
                 good
                     ? "cells that are too flat or fold: look at the grid; or raise fv.tol_pressure"
                     : "a smaller fv.cfl, or a larger fv.tol_viscous (1e-4)");
    }
    s->u_limit = limits_follow(&s->reference, s->umax);
    if (!run_diagnose(d, s->m->comm))
        mesh_watches_look(s, d);
    return dt;
}

double mesh_pressure_at(const struct mesh_flow *s, int64_t c)
{
    const double on = s->dt > 0.0 ? 1.0 / 6.0 : 0.0;
    return s->run->scene.fluid.rho * (s->p[c] + on * (s->p[c] - s->p_before[c]));
}

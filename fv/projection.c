/* projection.c - time steps with a projection each stage; formulas and measurements in README.md.
 * rk3: three stages of low-storage Runge-Kutta (Spalart, Moser & Rogers 1991), convection explicit,
 * viscosity implicit, the gradient of the step's first pressure in all stages; its pressure stands
 * at t - dt/6. bdf2: two-step backward differences with extrapolated convection, for slow flows.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "bc.h"
#include "forcing.h"
#include "levelset.h"
#include "limits.h"
#include "outflow.h"
#include "pressure.h"
#include "rk3.h"

static void start(struct fv *s, const char *timer)
{
    timer_start(&s->run->timers, timer_index(&s->run->timers, timer));
}
static void stop(struct fv *s, const char *timer)
{
    timer_stop(&s->run->timers, timer_index(&s->run->timers, timer));
}

static void divide_row(const double *restrict U, int64_t d, double w, bool first, int64_t n,
                       double *restrict div)
{
    for (int64_t i = 0; i < n; i++)
        div[i] = (first ? 0.0 : div[i]) + w * (U[i + d] - U[i]);
}

/* div = D U over the local cells, divided by tau. */
static void divergence(struct fv *s, double tau, double *restrict div)
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++) {
        const int64_t d = b->stride[a];
        const double *restrict U = s->U[a];
        BLOCK_ROWS (b, 0, c, n)
            divide_row(U + c, d, 1.0 / (block_size(b, a, j_) * tau), a == 0, n, div + c);
    }
}

static void subtract_row(double *restrict U, const double *restrict psi, int64_t d, double w,
                         const double *restrict open, int64_t n)
{
    if (open)
        for (int64_t i = 0; i < n; i++)
            U[i] -= w * open[i] * (psi[i] - psi[i - d]);
    else
        for (int64_t i = 0; i < n; i++)
            U[i] -= w * (psi[i] - psi[i - d]);
}

/* Of a surface: fluxes that cross it, velocity and pressure beyond, its stress. */
static void end_surface_stage(struct fv *s, double tau, double *psi)
{
    surface_fluxes(s, tau, psi);
    extension_apply(s, s->u, EXTEND_SHEAR, LAYERS);
    surface_set_pressure(s);
    extension_scalar(s, psi);
}

/* Makes u and U solenoidal: D U = 0 to the solver's tolerance, u by the fourth-order gradient. */
static void project(struct fv *s, double t, double tau, double *psi, double tol, int most)
{
    const struct block *b = &s->b;
    start(s, "operators");
    double *const *open = s->surface ? s->surface->open : s->forcing ? s->forcing->open : NULL;
    if (s->forcing)
        forcing_velocity(s, t, s->u);
    if (s->surface)
        extension_apply(s, s->u, EXTEND_FREE, LAYERS);
    bc_ghosts(s, BC_AHEAD, s->u);
    block_halo(b, b->dim, s->u);
    convection_face_velocities(s, s->u, s->U);
    if (s->forcing)
        forcing_fluxes(s, t, s->U);
    bc_fluxes(s, BC_GIVEN, s->U);
    divergence(s, tau, s->rhs[0]);
    if (s->surface)
        surface_add_pressure(s, s->rhs[0]);
    stop(s, "operators");
    start(s, "pressure");
    s->iterations += pressure_solve(s, psi, s->rhs[0], tol, most);
    stop(s, "pressure");
    start(s, "operators");
    for (int a = 0; a < b->dim; a++) {
        gradient(s, psi, a, CONTINUE_EVEN, s->rhs[0]);
        if (s->surface)
            surface_gradient(s, a, psi, s->rhs[0]);
        BLOCK_ROWS (b, 1, c, n)
            subtract_row(s->U[a] + c, psi + c, b->stride[a], tau / block_step(b, a, j_),
                         open ? open[a] + c : NULL, n);
        double *restrict u = s->u[a];
        const double *restrict g = s->rhs[0];
        if (s->forcing)
            forcing_zero(s->forcing, s->rhs[0]);
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                u[i] -= tau * g[i];
    }
    if (s->surface)
        end_surface_stage(s, tau, psi);
    bc_ghosts(s, BC_GIVEN, s->u);
    block_halo(b, b->dim, s->u);
    if (s->surface) {
        surface_dry_fluxes(s);
        bc_fluxes(s, BC_GIVEN, s->U);
    }
    stop(s, "operators");
}

/* The increment that forced cells make from one time to another, the start of all others. */
static void start_increment(struct fv *s, double t)
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++)
        memset(s->delta[a], 0, (size_t)b->size * sizeof(double));
    if (!s->forcing)
        return;
    forcing_velocity(s, t, s->delta);
    bc_ghosts(s, BC_CHANGE, s->delta);
    const struct forcing *f = s->forcing;
    for (int a = 0; a < b->dim; a++) {
        for (int64_t i = 0; i < f->nset; i++)
            s->delta[a][f->set[i]] -= s->u[a][f->set[i]];
        for (int64_t i = 0; i < f->npartner; i++)
            s->delta[a][f->partner[i]] -= s->u[a][f->partner[i]];
    }
}

static double viscous_tolerance(const struct fv *s)
{
    return s->prm.tol_viscous > 0.0 ? s->prm.tol_viscous : s->forcing ? 1e-5 : 1e-3;
}

/* u += delta with (1 - c L) delta = rhs; without viscosity delta = rhs. */
static bool add_increment(struct fv *s, double c, double t)
{
    const struct block *b = &s->b;
    bool good = true;
    if (s->nu > 0.0) {
        start_increment(s, t);
        good = viscous_solve(s, c, s->delta, s->rhs, viscous_tolerance(s));
    }
    for (int a = 0; a < b->dim; a++) {
        double *restrict u = s->u[a];
        const double *restrict d = s->nu > 0.0 ? s->delta[a] : s->rhs[a];
        BLOCK_ROWS (b, 0, at, n)
            for (int64_t i = at; i < at + n; i++)
                u[i] += d[i];
    }
    return good;
}

static void swap(double *a[3], double *b[3])
{
    for (int k = 0; k < 3; k++) {
        double *t = a[k];
        a[k] = b[k];
        b[k] = t;
    }
}

/* rhs = dt [(alpha+beta)(L u - Gc p) - gamma N - zeta N_old] */
static void stage_rhs(struct fv *s, double dt, double ab, double gamma, double zeta)
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++) {
        double *restrict r = s->rhs[a];
        const double *restrict g = s->step_p[a], *restrict N = s->N[a], *restrict M = s->N_old[a];
        const double drive = s->drive[a];
        if (s->nu > 0.0)
            viscous_apply(s, s->u[a], r);
        else
            memset(r, 0, (size_t)b->size * sizeof(double));
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                r[i] = dt * (ab * (r[i] - g[i] + drive) - gamma * N[i] - zeta * M[i]);
    }
}

static void pressure_gradient(struct fv *s)
{
    if (s->surface)
        return; /* each projection makes the whole pressure */
    double *const fields[1] = {s->p};
    block_halo(&s->b, 1, fields);
    if (s->bc) {
        bc_smooth(s, s->p, s->face, s->flux);
        block_halo(&s->b, 1, fields);
    }
    for (int a = 0; a < s->b.dim; a++)
        gradient(s, s->p, a, CONTINUE_CUBIC, s->step_p[a]);
}

static void add_pressure(struct fv *s, const double *restrict psi)
{
    memcpy(s->p_before, s->p, (size_t)s->b.size * sizeof(double));
    double *restrict p = s->p;
    const double keep = s->surface ? 0.0 : 1.0;
    BLOCK_ROWS (&s->b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            p[i] = keep * p[i] + psi[i];
}

static bool step_rk3(struct fv *s, double dt)
{
    /* one cycle mostly; but a fixed number of them diverges around a hole on some grids (50 and 54
     * cells) */
    const bool fresh = s->surface && !(s->dt > 0.0); /* no pressure to start from */
    /* with a surface of the pressure's change in a step, whose errors make or damp waves */
    const double last = fresh ? 1e-8 : (s->surface ? 0.01 : 1.0) * s->prm.tol_pressure;
    const double first = fresh ? last : fmin(10.0 * last, 0.1), t = s->t;
    bool good = true;
    start(s, "operators");
    pressure_gradient(s);
    outflow_begin(s);
    stop(s, "operators");
    for (int k = 0; k < 3; k++) {
        const double t_stage = t + rk3_at[k] * dt, ab = rk3_alpha[k] + rk3_beta[k];
        start(s, "convection");
        swap(s->N, s->N_old);
        convection(s, s->N);
        stop(s, "convection");
        start(s, "viscous");
        bc_set_slip(s, ab * dt, s->psi[k]);
        stage_rhs(s, dt, ab, rk3_gamma[k], rk3_zeta[k]);
        outflow_set(s, rk3_at[k] * dt);
        good = add_increment(s, rk3_beta[k] * dt, t_stage) && good;
        stop(s, "viscous");
        project(s, t_stage, ab * dt, s->psi[k], k == 2 ? last : first, 50);
    }
    add_pressure(s, s->psi[2]);
    return good;
}

/* Variable step: c0 = (1+2r)/(1+r), c1 = -(1+r), c2 = r^2/(1+r), r = dt/dt_old; the first step has
 * none before. */
static bool step_bdf2(struct fv *s, double dt)
{
    const struct block *b = &s->b;
    const bool first = !(s->dt > 0.0);
    const double r = first ? 0.0 : dt / s->dt;
    const double c0 = first ? 1.0 : (1.0 + 2.0 * r) / (1.0 + r),
                 c2 = first ? 0.0 : r * r / (1.0 + r);
    const double tau = dt / c0;
    start(s, "operators");
    pressure_gradient(s);
    outflow_begin(s);
    stop(s, "operators");
    start(s, "convection");
    swap(s->N, s->N_old);
    convection(s, s->N);
    stop(s, "convection");
    start(s, "viscous");
    bc_set_slip(s, tau, s->psi[0]);
    /* increment from u^n: (1 - tau L) d = tau [L u - (1+r) N + r N_old - Gc p] + (c2/c0)(u^n -
     * u^n-1) */
    stage_rhs(s, tau, 1.0, 1.0 + r, -r);
    for (int a = 0; a < b->dim; a++) {
        double *restrict rhs = s->rhs[a], *restrict old = s->u_old[a];
        const double *restrict u = s->u[a];
        for (int64_t i = 0; i < b->size; i++) {
            rhs[i] += c2 / c0 * (u[i] - old[i]);
            old[i] = u[i];
        }
    }
    outflow_set(s, dt);
    const bool good = add_increment(s, tau, s->t + dt);
    stop(s, "viscous");
    project(s, s->t + dt, tau, s->psi[0], s->prm.tol_pressure, 50);
    add_pressure(s, s->psi[0]);
    return good;
}

/* Integrators by the parameter's index; each advances u, U, p by dt. */
struct integrator {
    const char *name;
    bool (*step)(struct fv *s, double dt);
};
static const struct integrator integrators[] = {{"rk3", step_rk3},
                                                {"bdf2", step_bdf2}}; /* and newton */

bool projection_step(struct fv *s, double dt) { return integrators[s->prm.integrator].step(s, dt); }

/* Pressure that belongs to the velocities of the start: short steps from the same state, until
 * their increments have made it. */
void pressure_start(struct fv *s)
{
    if (s->newton) /* which has no use for the pressure before */
        return;
    const size_t bytes = (size_t)s->b.size * sizeof(double);
    const double dt = 1e-3 * fmin(limits_of(s).dt, s->run->scene.time.end);
    double *keep[2][3];
    for (int a = 0; a < s->b.dim; a++) {
        keep[0][a] = block_field(&s->b);
        keep[1][a] = block_field(&s->b);
        memcpy(keep[0][a], s->u[a], bytes);
        memcpy(keep[1][a], s->U[a], bytes);
    }
    for (int k = 0; k < 8; k++) {
        projection_step(s, dt);
        for (int a = 0; a < s->b.dim; a++) {
            memcpy(s->u[a], keep[0][a], bytes);
            memcpy(s->U[a], keep[1][a], bytes);
        }
    }
    outflow_start(s);
    for (int a = 0; a < 3; a++) {
        if (s->psi[a])
            memset(s->psi[a], 0, bytes);
        if (a < s->b.dim) {
            mem_free(keep[0][a]);
            mem_free(keep[1][a]);
        }
    }
    memcpy(s->p_before, s->p, bytes);
    s->iterations = s->viscous_iterations = 0;
}

double fv_still_pressure(const struct fv *s, const double *x)
{
    return still_pressure(&s->run->scene, s->still, s->level, x);
}

void fv_add_still_pressure(const struct fv *s, double *p)
{
    const struct block *b = &s->b;
    double x[3];
    BLOCK_CELLS (b, i, j, k, c) {
        block_centre(b, i, j, k, x);
        p[c] += fv_still_pressure(s, x);
    }
}

double fv_still_in_exact(const struct fv *s, const double *x)
{
    return scene_has_wave(&s->run->scene) ? fv_still_pressure(s, x) : 0.0;
}

/* rk3's pressure belongs to t - dt/6: carried on along the last step's change. */
double fv_pressure(const struct fv *s, int64_t c)
{
    const double on = s->prm.integrator == INTEGRATOR_RK3 && s->dt > 0.0 ? 1.0 / 6.0 : 0.0;
    return s->run->scene.fluid.rho * (s->p[c] + on * (s->p[c] - s->p_before[c]));
}

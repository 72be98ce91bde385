/* projection.c - time steps with a projection each stage; formulas in METHODS.md.
 * rk3: three stages of low-storage Runge-Kutta (Spalart, Moser & Rogers 1991), convection explicit,
 * viscosity implicit, the gradient of the step's first pressure in all stages; its pressure stands
 * at t - dt/6. bdf2: two-step backward differences with extrapolated convection, for slow flows.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "moving.h"
#include "rk3.h"
#include "stages.h"
#include "steps.h"

static void start(struct fv *s, const char *timer) { timer_start(&s->run->timers, timer); }
static void stop(struct fv *s, const char *timer) { timer_stop(&s->run->timers, timer); }

/* Of a surface: fluxes that cross it, velocity and pressure beyond, its stress. After the last
 * stage phi is advected. */
static void end_surface_stage(struct fv *s, double tau, double *psi, bool last)
{
    surface_fluxes(s, tau, psi);
    extension_apply(s, s->u, EXTEND_SHEAR, last ? LAYERS : STENCILS);
    surface_set_pressure(s);
    extension_scalar(s, psi);
}

/* Order matters: fluxes of the predicted velocity, psi, fluxes and cells corrected, what lies
 * beyond the surface carried on, sides last, for they read the cells beside them. */
void projection(struct fv *s, double t, int stage, double tau, double tol)
{
    double *psi = s->stages.psi[stage];
    const bool last = stage == 2 || s->prm.integrator == INTEGRATOR_BDF2;
    start(s, "operators");
    stage_predict_fluxes(s, t);
    stop(s, "operators");
    start(s, "pressure");
    s->step.failed = !stage_solve_pressure(s, stage, tau, tol) || s->step.failed;
    stop(s, "pressure");
    start(s, "operators");
    s->ops->correct_fluxes(s, tau, psi);
    for (int a = 0; a < s->dim; a++) {
        double *restrict u = s->u[a];
        const double *restrict g = s->rhs[a];
        FLOW_WET (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                u[i] -= tau * g[i];
    }
    if (s->surface)
        end_surface_stage(s, tau, psi, last);
    sides_velocity(s, BC_GIVEN, s->u);
    if (s->surface)
        s->ops->dry_fluxes(s, !last);
    stop(s, "operators");
}

/* u += delta with (1 - c L) delta = rhs; without viscosity delta = rhs. */
static bool add_increment(struct fv *s, double c, double t, double scale)
{
    const bool viscous = s->nu > 0.0, good = !viscous || stage_solve_viscous(s, c, t, scale);
    for (int a = 0; a < s->dim; a++) {
        double *restrict u = s->u[a];
        const double *restrict d = viscous ? s->delta[a] : s->rhs[a];
        if (s->surface && !viscous) /* as viscous_solve: convection of air is anything */
            surface_zero(s, s->rhs[a]);
        FLOW_WET (s, at, n)
            for (int64_t i = at; i < at + n; i++)
                u[i] += d[i];
    }
    return good;
}

/* Which arrays the components are, not what is in them. */
static void swap(double *a[3], double *b[3])
{
    for (int k = 0; k < 3; k++) {
        double *t = a[k];
        a[k] = b[k];
        b[k] = t;
    }
}

/* rhs = dt [(alpha+beta)(L u - Gc p + g) - gamma N - zeta N_old] */
static void stage_rhs(struct fv *s, double dt, double ab, double gamma, double zeta)
{
    for (int a = 0; a < s->dim; a++) {
        double *restrict r = s->rhs[a];
        const double *restrict g = s->stages.step_p[a], *restrict N = s->stages.N[a],
                               *restrict M = s->stages.N_old[a];
        const double drive = s->gravity.periodic[a];
        if (s->nu > 0.0)
            s->ops->viscous(s, a, r);
        else
            grid_clear_near(&s->grid, r);
        FLOW_WET (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                r[i] = dt * (ab * (r[i] - g[i] + drive) - gamma * N[i] - zeta * M[i]);
    }
    if (s->ops->to_index)
        s->ops->to_index(s);
}

/* What stages share: the gradient of the pressure before, openings as they flow now. */
static void begin_step(struct fv *s)
{
    start(s, "operators");
    if (!s->surface) { /* there each projection makes the whole pressure */
        memcpy(s->p_before, s->p, (size_t)s->size * sizeof(double));
        stage_pressure_gradient(s);
    }
    outflow_begin(s);
    levels_begin(s, s->step.dt_now);
    stop(s, "operators");
}

static void step_convection(struct fv *s)
{
    start(s, "convection");
    swap(s->stages.N, s->stages.N_old);
    stage_convection(s, s->stages.N);
    stop(s, "convection");
}

/* The pressure plus psi; with a surface psi is all of it. */
static void add_pressure(struct fv *s, const double *restrict psi)
{
    if (s->surface)
        grid_copy_near(&s->grid, s->p, s->p_before);
    double *restrict p = s->p;
    const double keep = s->surface ? 0.0 : 1.0;
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            p[i] = keep * p[i] + psi[i];
}

/* With a surface: the mean over the stages, which belongs to the middle of the step, as the surface
 * does in all of them: its force is the momentum that the step's projections give. The last one
 * alone balances walls' accelerations of t - dt/6, but has the depth of t - dt/2. */
static void add_mean_pressure(struct fv *s)
{
    add_pressure(s, s->stages.psi[2]);
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            s->p[i] = 0.0;
            for (int k = 0; k < 3; k++)
                s->p[i] += (rk3_alpha[k] + rk3_beta[k]) * s->stages.psi[k][i];
        }
}

/* Of the last projection of a step. With a surface that of the pressure's change in a step, whose
 * errors make or damp waves; the first one has no pressure to start from. Edges of boxes make most
 * of the divergence in each step, in a few cells: below a hundredth of that long waves of psi would
 * add up in p, to 14 % of what drives a stream past a box, at the same number of cycles. */
static double last_tolerance(const struct fv *s)
{
    if (s->surface)
        return s->step.dt > 0.0 ? 0.01 * s->prm.tol_pressure : 1e-8;
    return s->blocked ? 0.01 * s->prm.tol_pressure : s->prm.tol_pressure;
}

/* In a step of less than half the length of that before, psi becomes what it was before that stage,
 * with a surface, and the smaller part of its change the shorter the step is. G does not see waves
 * near the odd-even one, so their D I(u) stays, and psi has 1/tau of it: at most twice as much now.
 * The last step, of a fiftieth, of a stream past a post (outputs each 3.3845 s, the end at 6.769 s)
 * had five times the force. What else errs in a divergence, as the solver does, grows likewise. */
static void bound_short(const struct fv *s, double dt, double *psi, const double *before)
{
    const double r = dt / s->step.dt, share = 4.0 * r * r;
    for (int64_t i = 0; i < s->size; i++) {
        const double base = s->surface ? before[i] : 0.0;
        psi[i] = base + share * (psi[i] - base);
    }
}

/* The stage's projection of length tau in a step of dt. */
static void project_stage(struct fv *s, double dt, double t, int stage, double tau, double tol)
{
    const bool is_short = dt < 0.5 * s->step.dt;
    double *before = is_short ? NEW(double, s->size) : NULL;
    if (is_short)
        memcpy(before, s->stages.psi[stage], (size_t)s->size * sizeof(double));
    projection(s, t, stage, tau, tol);
    if (is_short)
        bound_short(s, dt, s->stages.psi[stage], before);
    FREE(before);
}

static bool step_rk3(struct fv *s, double dt)
{
    /* one cycle mostly; but a fixed number of them diverges around a hole on some grids (50 and 54
     * cells) */
    const bool fresh = s->surface && !(s->step.dt > 0.0);
    const double last = last_tolerance(s);
    const double first = fresh ? last : fmin(10.0 * last, 0.1), t = s->t;
    bool good = true;
    double before = (rk3_alpha[2] + rk3_beta[2]) * s->step.dt; /* the last stage's part of a step */
    begin_step(s);
    for (int k = 0; k < 3; k++) {
        const double t_stage = t + rk3_at[k] * dt, ab = rk3_alpha[k] + rk3_beta[k];
        step_convection(s);
        start(s, "viscous");
        stage_set_slip(s, ab * dt, s->stages.psi[k]);
        stage_rhs(s, dt, ab, rk3_gamma[k], rk3_zeta[k]);
        stage_set_sides(s, t_stage, rk3_at[k] * dt);
        good = add_increment(s, rk3_beta[k] * dt, t_stage, before > 0.0 ? ab * dt / before : 0.0) &&
               good;
        before = ab * dt;
        stop(s, "viscous");
        s->stages.implicit = k == 2 && !s->surface ? rk3_beta[k] * dt * s->nu : 0.0;
        project_stage(s, dt, t_stage, k, ab * dt, k == 2 ? last : first);
    }
    s->stages.implicit = 0.0;
    if (s->surface)
        add_mean_pressure(s);
    else
        add_pressure(s, s->stages.psi[2]);
    return good;
}

/* rhs += (c2/c0) (u^n - u^n-1), whose place u^n takes. */
static void add_history(struct fv *s, double weight)
{
    for (int a = 0; a < s->dim; a++) {
        double *restrict rhs = s->rhs[a], *restrict old = s->stages.u_old[a];
        const double *restrict u = s->u[a];
        for (int64_t i = 0; i < s->size; i++) {
            rhs[i] += weight * (u[i] - old[i]);
            old[i] = u[i];
        }
    }
}

/* Variable step: c0 = (1+2r)/(1+r), c1 = -(1+r), c2 = r^2/(1+r), r = dt/dt_old; the first step has
 * none before. */
static bool step_bdf2(struct fv *s, double dt)
{
    const bool first = !(s->step.dt > 0.0);
    const double r = first ? 0.0 : dt / s->step.dt;
    const double c0 = first ? 1.0 : (1.0 + 2.0 * r) / (1.0 + r),
                 c2 = first ? 0.0 : r * r / (1.0 + r);
    const double tau = dt / c0;
    begin_step(s);
    /* fringes interpolate from air, too, where it would be that of two steps before */
    for (int a = 0; s->surface && grid_overlaps(&s->grid) && a < s->dim; a++)
        memset(s->stages.N_old[a], 0, (size_t)s->size * sizeof(double));
    step_convection(s);
    for (int a = 0; s->surface && a < s->dim; a++)
        extension_scalar(s, s->stages.N[a]); /* for cells that the next step finds wet */
    start(s, "viscous");
    stage_set_slip(s, tau, s->stages.psi[0]);
    /* increment from u^n: (1 - tau L) d = tau [L u - (1+r) N + r N_old - Gc p] + (c2/c0)(u^n -
     * u^n-1) */
    stage_rhs(s, tau, 1.0, 1.0 + r, -r);
    add_history(s, c2 / c0);
    stage_set_sides(s, s->t + dt, dt);
    const bool good = add_increment(s, tau, s->t + dt, 0.0);
    stop(s, "viscous");
    s->stages.implicit = s->surface ? 0.0 : tau * s->nu;
    project_stage(s, dt, s->t + dt, 0, tau, last_tolerance(s));
    s->stages.implicit = 0.0;
    add_pressure(s, s->stages.psi[0]);
    return good;
}

/* By the parameter's index; newton, the third, has newton_try. */
static bool (*const integrators[])(struct fv *s, double dt) = {step_rk3, step_bdf2};

/* What boxes stir of odd-even waves is 1/dt in p (see bound_short). Under a surface: in a stream
 * over a sill 0.02 of the pressure at CFL 1.1, 0.2 at 0.1, 0.6 at 0.03; where steps, not a single
 * one, are below a quarter it is taken off; in longer ones that would take 2 % off the force on a
 * sill four cells high. Without a surface p is kept from step to step, 0.15 of it at CFL 1.1, 0.5,
 * 0.8: as much is taken off in a time as in the largest steps, so that what a steady flow has of it
 * does not hang on the step. Not on blocks or without boxes: smooth flows between walls, 16 cells a
 * wave, have 1.5 times the error of velocity at CFL 0.1 then, and half that of pressure. */
static void smooth_small(struct fv *s, double dt)
{
    const double cfl = s->max.rate * fmax(dt, s->step.dt),
                 share = s->surface ? 1.0 - 4.0 * cfl : fmin(1.0, SMOOTHED * (1.1 / cfl - 1.0));
    if (s->blocked && share > 0.0)
        smooth_odd_even(s, share, s->p, s->faces[0]);
}

bool projection_step(struct fv *s, double dt)
{
    s->step.dt_now = dt;
    const bool good = integrators[s->prm.integrator](s, dt);
    smooth_small(s, dt);
    if (s->moving)
        moving_end(s);
    return good;
}

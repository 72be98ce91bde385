/* fv_step.c - size of a step, what it may not do, and the surface around it. integrate() is the
 * program's step: the size from limits.c, cut so that an output, the end of a coupling step or of a
 * motion is met; the step itself (projection.c, or newton.c) between the two halves of the
 * surface's (surface_steps.c); the zones of waves; then the diagnosis, on all ranks. pressure_start
 * finds the pressure that belongs to the start.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "stages.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"
#include "../watch/fv_watch.h"
#include "moving.h"
#include "newton.h"
#include "relax.h"
#include "steps.h"
#include "surface_steps.h"

/* The velocity of an impact is not known before it: a step that turns out too long is taken back
 * and done again in half the time. */
static bool step_with_surface(struct fv *s, double *dt, struct diagnosis *d)
{
    const double most = 1.5 * fmax(s->prm.cfl, 0.1);
    const struct flow_maxima before = s->max;
    bool good;
    surface_keep_state(s);
    for (int tries = 0;; tries++) {
        timer_start(&s->run->timers, "surface");
        surface_first_half(s, *dt);
        timer_stop(&s->run->timers, "surface");
        good = s->newton ? newton_try(s, *dt) : projection_step(s, *dt);
        if (good && s->newton)
            surface_extend(s, LAYERS);
        measure(s);
        if (good && (s->max.rate * *dt <= most || tries == 8))
            return true;
        if (tries == 8) {
            if (s->newton)
                newton_describe(s, "8 halvings of the step", d);
            return s->newton;
        }
        surface_back(s);
        s->max = before;
        *dt *= 0.5;
    }
}

void cell_place(const struct fv *s, int64_t c, char *text, size_t size, double x[3])
{
    int at[3];
    const struct part *p = grid_part(&s->grid, c, at);
    snprintf(text, size, "cell (%d, %d, %d)", p->lo[0] + at[0], p->lo[1] + at[1], p->lo[2] + at[2]);
    if (grid_name(&s->grid, p->block))
        text_add(text, size, " of block \"%s\"", grid_name(&s->grid, p->block));
    grid_centre(&s->grid, p, at, x);
}

/* Fills d with the fastest cell, if this rank has it. */
static void find_worst(const struct fv *s, double before, struct diagnosis *d)
{
    double worst = s->speed.limit, x[3];
    int64_t at = -1;
    char place[PARAM_TEXT_SIZE + 64];
    for (int a = 0; a < s->dim; a++)
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double v = isfinite(s->u[a][i]) ? fabs(s->u[a][i]) : 1e300;
                if (v <= worst || (s->free && s->free[i] == 0.0))
                    continue;
                worst = v;
                at = i;
            }
    if (at < 0)
        return;
    d->bad = true;
    cell_place(s, at, place, sizeof place, x);
    snprintf(d->reason, sizeof d->reason, "velocity of %s is %g m/s, limit %g m/s", place,
             worst < 1e300 ? worst : NAN, s->speed.limit);
    snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, step of %g s, limited by %s", x[0], x[1],
             x[2], s->step.dt, limit_name(s->step.limit));
    limits_explain(&s->prm, s->step.limit, before, s->max.rate * s->step.dt, s->surface != NULL,
                   d->likely, sizeof d->likely);
}

/* In the order of causes: the first trouble that is found explains those that would follow. */
static void diagnose(const struct fv *s, double dt, double before, bool good, struct diagnosis *d)
{
    const double most = fv_fastest(s);
    if (!isfinite(most) || !(most <= s->speed.limit)) {
        find_worst(s, before, d);
    } else if (*grid_trouble(&s->grid)) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason, "%s", grid_trouble(&s->grid));
        snprintf(d->where, sizeof d->where, "step of %g s", dt);
        snprintf(d->likely, sizeof d->likely,
                 "a smaller motion, a background that reaches further or is as fine as the block "
                 "there, or cells of the block that go 8 or more layers beyond its walls");
    } else if (!good) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason,
                 "the viscous solver did not converge in 200 iterations");
        snprintf(d->where, sizeof d->where, "step of %g s, viscosity %g m^2/s", dt, s->nu);
        snprintf(d->likely, sizeof d->likely,
                 "a smaller step: fv.cfl below %g, or a larger fv.tol_viscous", s->prm.cfl);
    } else if (s->step.failed) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason,
                 "the pressure solver did not converge, nor did the safer one");
        snprintf(d->where, sizeof d->where, "step of %g s", dt);
        snprintf(d->likely, sizeof d->likely,
                 "cells that are too flat or fold: look at the grid; or raise fv.tol_pressure");
    } else if (s->surface && surface_trouble(s)) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason, "%s", surface_trouble(s));
        snprintf(d->where, sizeof d->where, "all cells, after a step of %g s", dt);
        snprintf(d->likely, sizeof d->likely,
                 s->surface->wet > 0 ? "no side is an \"outflow\""
                                     : "it has all left, or is finer than the cells");
    }
}

/* A step that makes a pressure; what newton leaves where it does not converge is none. Without
 * sound: in so short a step it would not get through a cell. */
static void find_pressure(struct fv *s, double dt)
{
    const double c0 = s->prm.c0;
    if (!s->newton) {
        projection_step(s, dt);
        return;
    }
    s->prm.c0 = 0.0;
    if (!newton_try(s, dt))
        memcpy(s->p, s->p_before, (size_t)s->size * sizeof(double));
    s->prm.c0 = c0;
}

/* Pressure that belongs to the velocities of the start: short steps from the same state, until
 * their increments have made it. An inflow or a discharge that starts at once pushes the whole
 * flow, the harder the shorter these steps are: there the first step finds the pressure, whatever
 * its level. */
void pressure_start(struct fv *s)
{
    /* newton has no use for the pressure before, but the first output has */
    if ((s->newton && !s->surface) || sides_give_inflow(s) || outflow_pushes(s))
        return;
    const size_t bytes = (size_t)s->size * sizeof(double);
    const double dt = 1e-3 * fmin(limits_of(s).dt, s->run->scene.time.end);
    double *keep[2][3];
    for (int a = 0; a < s->dim; a++) {
        keep[0][a] = NEW(double, s->size);
        keep[1][a] = NEW(double, s->size);
        memcpy(keep[0][a], s->u[a], bytes);
        memcpy(keep[1][a], s->U[a], bytes);
    }
    memcpy(s->p_before, s->p, bytes);
    for (int k = 0; k < (s->newton ? 1 : 8); k++) {
        find_pressure(s, dt);
        for (int a = 0; a < s->dim; a++) {
            memcpy(s->u[a], keep[0][a], bytes);
            memcpy(s->U[a], keep[1][a], bytes);
        }
    }
    outflow_start(s);
    for (int a = 0; a < 3; a++) {
        if (s->stages.psi[a])
            memset(s->stages.psi[a], 0, bytes);
        if (a < s->dim)
            FREE(keep[0][a], keep[1][a]);
    }
    memcpy(s->p_before, s->p, bytes);
    s->totals.iterations = s->totals.viscous_iterations = 0;
}

/* Whether shapes give the water velocities, with which no pressure is known. */
static bool shapes_move(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nshapes; k++)
        any = any || vec3_dot(c->shapes[k].velocity, c->shapes[k].velocity) > 0.0;
    return any;
}

/* Fields that flow bring their pressure. Walls that move give velocities later. */
void pressure_meet_surface(struct fv *s)
{
    if (!s->surface || s->moving || (fv_fastest(s) > 0.0 && !shapes_move(&s->run->scene)))
        return;
    levels_keep(s);
    pressure_start(s);
    levels_back(s);
}

/* Cells of water would lose or gain what the divergence says. In so short a time gravity does
 * nothing. What a field's averages lack is no push. What comes next is a first step: the velocity
 * of the step before says nothing about accelerations. */
void push_start(struct fv *s)
{
    const size_t bytes = (size_t)s->size * sizeof(double);
    if (!s->surface || !(flow_largest_divergence(s) > 0.05 * s->max.rate))
        return;
    const double tau = 1e-6 * fmin(limits_of(s).dt, s->run->scene.time.end);
    s->step.dt = 0.0;
    projection(s, s->t, 0, tau, 1e-3 * fmin(1.0, s->prm.tol_pressure));
    surface_extend(s, LAYERS);
    memset(s->stages.psi[0], 0, bytes);
    if (s->stages.start[0])
        memset(s->stages.start[0], 0, bytes);
    measure(s);
    s->speed.reference = fmax(s->speed.reference, fv_fastest(s));
    s->speed.limit = 10.0 * s->speed.reference;
}

/* Steps to the end of a window, of which sph makes some tens. */
#define MOST_OF_A_WINDOW 1e5

/* Whether steps have shrunk so far that the window would never end. */
static bool crawls(const struct fv *s, double n, const struct step_limit *most, struct diagnosis *d)
{
    if (!s->run->coupled || n < MOST_OF_A_WINDOW)
        return false;
    d->bad = true;
    snprintf(d->reason, sizeof d->reason,
             "the step has shrunk to %.3g s, %.3g of them to a coupling step", most->dt, n);
    snprintf(d->where, sizeof d->where, "limited by %s; largest velocity %.3g m/s",
             limit_name(most->by), fv_fastest(s));
    snprintf(d->likely, sizeof d->likely,
             "velocities given on sides or by the partner that the flow does not have");
    return true;
}

/* Steps up to t_stop, or up to the next event of a motion, are of one size: the last is no short
 * remnant, which would cost as much as any other. */
double integrate(struct fv *s, double t_stop, struct diagnosis *d)
{
    if (s->surface && s->moving && moving_turns(s))
        push_start(s);
    const struct step_limit most = limits_of(s);
    /* no step passes over the start or the end of a motion */
    const double to = fmin(t_stop, limits_next_motion(s)), left = to - s->t, before = s->max.rate;
    const double n = fmax(ceil(left / most.dt - 1e-9), 1.0);
    if (crawls(s, n, &most, d))
        return 0.0;
    double dt = left / n;
    bool good = true;
    s->step.failed = false;
    s->step.defect = 0.0;
    s->step.limit = dt < 0.5 * most.dt ? LIMIT_OUTPUT : most.by;
    if (s->prm.steady)
        dt = newton_pseudo_step(s, fmin(most.dt, s->run->scene.time.end), t_stop, d);
    else if (s->surface)
        good = step_with_surface(s, &dt, d);
    else if (s->newton)
        newton_step(s, &dt, d);
    else
        good = projection_step(s, dt);
    s->t = dt == left ? to : s->t + dt;
    s->step.dt_old = s->step.dt;
    s->step.dt = dt;
    measure(s);
    if (s->surface) {
        timer_start(&s->run->timers, "surface");
        surface_second_half(s, dt);
        timer_stop(&s->run->timers, "surface");
    }
    if (relax_zones(s, dt)) {
        fraction_forget_flows(s);
        measure(s); /* as a restart does */
    }
    diagnose(s, dt, before * dt, good, d);
    const bool failed = run_diagnose(d, s->comm);
    if (s->step.predicts)
        return dt;
    s->totals.max_cfl =
        fmax(s->totals.max_cfl, s->max.rate * (s->prm.steady ? s->newton->dtau : dt));
    s->speed.limit = limits_follow(&s->speed.reference, fv_fastest(s));
    s->totals.defect = fmax(s->totals.defect, s->step.defect);
    if (!failed)
        fv_watches_look(s, d);
    return dt;
}

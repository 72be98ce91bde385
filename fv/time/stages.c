/* stages.c - see stages.h: what the operators of the cells (s->ops) make, and what stands around
 * them: openings, a partner's cells, moving blocks, the surface, boxes. In the order of a stage:
 * convection, sides at the stage's time, viscous solve, fluxes between cells, pressure.
 * projection.c puts them together.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "stages.h"

#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"
#include "../watch/fv_watch.h"
#include "moving.h"

void stage_fields_create(struct fv *s)
{
    struct stage_fields *f = &s->stages;
    const bool rk3 = s->prm.integrator == INTEGRATOR_RK3;
    for (int a = 0; a < s->dim; a++) {
        f->N[a] = NEW_IN(s, double, s->size);
        f->N_old[a] = NEW_IN(s, double, s->size);
        f->step_p[a] = NEW_IN(s, double, s->size);
        f->u_old[a] = rk3 ? NULL : NEW_IN(s, double, s->size);
    }
    for (int k = 0; k < 3; k++) {
        f->psi[k] = s->m || k == 0 || rk3 ? NEW_IN(s, double, s->size) : NULL;
        f->start[k] = s->m ? NEW_IN(s, double, s->size) : NULL;
    }
}

void stage_pressure_gradient(struct fv *s)
{
    grid_fill(&s->grid, 1, &s->p);
    if (s->ops->smooth_pressure(s))
        grid_fill(&s->grid, 1, &s->p);
    if (s->moving)
        moving_begin(s);
    s->ops->pressure_gradient(s, s->p, s->stages.step_p);
    if (s->moving)
        moving_gradient(s);
}

void stage_set_slip(struct fv *s, double tau, const double *psi)
{
    if (s->moving)
        moving_turn_pressure(s, tau);
    s->ops->set_slip(s, tau, psi);
}

/* Cells that a partner's box has left have no convection of the step before. */
static void begin_born(struct fv *s, double *const N[3])
{
    for (int64_t c = 0; c < s->size; c++)
        for (int a = 0; a < s->dim && s->partners.born[c]; a++)
            s->stages.N_old[a][c] = N[a][c];
}

void stage_convection(struct fv *s, double *const N[3])
{
    s->ops->convection(s, N);
    sides_brake(s, N);
    if (s->partners.born && s->t == s->partners.born_at)
        begin_born(s, N);
    if (s->moving)
        moving_convection(s, N);
}

void stage_set_sides(struct fv *s, double t, double dt)
{
    if (s->moving)
        moving_stage(s, t);
    sides_time(s, t);
    outflow_set(s, dt);
    levels_set(s, t);
}

bool stage_solve_viscous(struct fv *s, double c, double t, double scale)
{
    if (s->moving)
        moving_change(s);
    return s->ops->solve_viscous(s, c, t, scale);
}

void stage_predict_fluxes(struct fv *s, double t)
{
    if (s->forcing)
        forcing_velocity(s, t, s->u);
    if (s->surface)
        extension_apply(s, s->u, EXTEND_FREE, STENCILS);
    for (int a = 0; s->blocked && a < s->dim; a++)
        blocked_zero(s, s->u[a]);
    if (s->moving) {
        moving_fill(s, s->u);
        mesh_bc_velocity(s, BC_AHEAD, s->u);
    } else {
        sides_velocity(s, BC_AHEAD, s->u);
    }
    s->ops->face_velocities(s, s->u, s->U);
    sides_fluxes(s, BC_GIVEN, s->U);
    if (s->forcing)
        forcing_fluxes(s, t, s->U);
}

/* Friction acts on u* = u + tau grad psi where it is implicit, so the pressure of the projected
 * flow is p + psi - c Lap psi, c = s->stages.implicit (Brown, Cortez & Minion, J. Comput. Phys.
 * 168, 2001); Lap psi is the divergence of u* over tau. p + psi alone leaves c grad Lap psi in a
 * flow that is steady, where psi gives back what smooth_pressure takes. */
static void subtract_friction(struct fv *s, double tau, const double *div)
{
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++)
            if (forcing_is_free(s, i))
                s->p[i] -= s->stages.implicit * (s->m ? div[i] / (tau * s->m->V[i]) : div[i]);
}

bool stage_solve_pressure(struct fv *s, int stage, double tau, double tol)
{
    levels_fluxes(s, tau);
    double *div = s->ops->divergence(s, tau);
    if (s->stages.implicit > 0.0)
        subtract_friction(s, tau, div);
    return poisson_solve(s, tau, div, tol, s->stages.start[stage], s->stages.psi[stage]);
}

/* m/s^2: of differences of pressure between sides. */
static double push_of(const struct fv *s)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double L = INFINITY;
    for (int a = 0; a < s->dim; a++)
        L = fmin(L, d->max[a] - d->min[a]);
    return limits_pressure_difference(&s->run->scene) / L;
}

void measure(struct fv *s) { s->ops->measure(s, push_of(s), s->moving ? moving_rate(s) : 0.0); }

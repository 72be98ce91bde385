/* fv_step.c - size of a step, what it may not do, and the surface around it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bc.h"
#include "levelset.h"
#include "newton.h"

/* Largest |u_a| over all ranks; a value that is not finite makes it so. */
void measure(struct fv *s)
{
    const struct block *b = &s->b;
    double most[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < b->dim; a++) {
        double m = 0.0, sum = 0.0;
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double v = fabs(s->u[a][i]);
                m = v > m ? v : m;
                sum += 0.0 * s->u[a][i];
            }
        most[a] = sum == 0.0 ? m : INFINITY;
    }
    MPI_Allreduce(MPI_IN_PLACE, most, 3, MPI_DOUBLE, MPI_MAX, b->cart);
    memcpy(s->umax, most, sizeof most);
}

static void describe_worst(const struct fv *s, struct diagnosis *d)
{
    const struct block *b = &s->b;
    int at[3] = {0, 0, 0};
    double worst = -1.0, x[3];
    BLOCK_CELLS (b, i, j, k, c)
        for (int a = 0; a < b->dim; a++) {
            const double v = fabs(s->u[a][c]);
            if (!(v <= worst) || !isfinite(v)) {
                worst = isfinite(v) ? v : 1e300;
                at[0] = i;
                at[1] = j;
                at[2] = k;
            }
        }
    if (worst < s->u_limit) /* another rank has it */
        return;
    d->bad = true;
    block_centre(b, at[0], at[1], at[2], x);
    snprintf(d->reason, sizeof d->reason, "velocity of cell (%d, %d, %d) is %g m/s, limit %g m/s",
             at[0] + b->lo[0], at[1] + b->lo[1], at[2] + b->lo[2], worst < 1e300 ? worst : NAN,
             s->u_limit);
    snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, CFL of the step %.3g", x[0], x[1], x[2],
             s->max_cfl);
    snprintf(
        d->likely, sizeof d->likely,
        "the flow is finer than the cells (no dissipation is added), or fv.cfl = %g is too large",
        s->prm.cfl);
}

double fv_speed(const struct fv *s, int a)
{
    const bool driven = s->drive[a] != 0.0 || (s->bc && s->bc->driven);
    return fmax(fmax(s->umax[a], s->bc ? s->bc->speed_along[a] : 0.0),
                driven ? s->run->scene.initial.U : 0.0);
}

double fv_largest_step(const struct fv *s)
{
    double rate = 1e-300;
    for (int a = 0; a < s->b.dim; a++) {
        const double flow = fv_speed(s, a) / s->b.h[a];
        rate = fmax(rate, flow);
        if (s->surface) { /* waves of two cells; what falls freely, at the end of the step */
            const double fall = s->surface->g / s->b.h[a];
            rate = fmax(rate, fmax(2.0 * sqrt(fall), 0.5 * flow + sqrt(0.25 * flow * flow + fall)));
        }
    }
    return s->prm.cfl / rate;
}

static double cfl_of(const struct fv *s, double dt)
{
    double cfl = 0.0;
    for (int a = 0; a < s->b.dim; a++)
        cfl = fmax(cfl, s->umax[a] * dt / s->b.h[a]);
    return cfl;
}

/* The velocity of an impact is not known before it: a step that turns out too long is taken back
 * and done again in half the time. */
static bool step_with_surface(struct fv *s, double *dt)
{
    const double most = 1.5 * fmax(s->prm.cfl, 0.1);
    double before[3];
    bool good;
    memcpy(before, s->umax, sizeof before);
    surface_keep_state(s);
    for (int tries = 0;; tries++) {
        timer_start(&s->run->timers, timer_index(&s->run->timers, "surface"));
        surface_first_half(s, *dt);
        timer_stop(&s->run->timers, timer_index(&s->run->timers, "surface"));
        good = projection_step(s, *dt);
        measure(s);
        if ((good && cfl_of(s, *dt) <= most) || tries == 8)
            return good;
        surface_back(s);
        memcpy(s->umax, before, sizeof before);
        *dt *= 0.5;
    }
}

static void diagnose(const struct fv *s, double dt, bool good, struct diagnosis *d)
{
    const double most = fmax(s->umax[0], fmax(s->umax[1], s->umax[2]));
    if (!isfinite(most) || !(most <= s->u_limit)) {
        describe_worst(s, d);
    } else if (!good) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason,
                 "the viscous solver did not converge in 200 iterations");
        snprintf(d->where, sizeof d->where, "step of %g s, nu dt/h^2 = %g", dt,
                 s->nu * dt / (s->b.h[0] * s->b.h[0]));
        snprintf(d->likely, sizeof d->likely, "raise fv.tol_viscous or lower fv.cfl");
    } else if (s->surface && surface_trouble(s)) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason, "%s", surface_trouble(s));
        snprintf(d->where, sizeof d->where, "all cells, after a step of %g s", dt);
        snprintf(d->likely, sizeof d->likely, "it has all left, or is finer than the cells");
    }
}

double integrate(struct fv *s, double t_stop, struct diagnosis *d)
{
    const double left = t_stop - s->t, dt_most = fv_largest_step(s);
    const double n = fmax(ceil(left / dt_most - 1e-9), 1.0);
    double dt = left / n;
    bool good = true;
    if (s->prm.steady)
        dt = newton_pseudo_step(s, dt_most, t_stop, d);
    else if (s->newton)
        newton_step(s, &dt, d);
    else
        good = s->surface ? step_with_surface(s, &dt) : projection_step(s, dt);
    s->t = dt == left ? t_stop : s->t + dt;
    s->dt_old = s->dt;
    s->dt = dt;
    measure(s);
    if (s->surface) {
        timer_start(&s->run->timers, timer_index(&s->run->timers, "surface"));
        surface_second_half(s, dt);
        timer_stop(&s->run->timers, timer_index(&s->run->timers, "surface"));
    }
    s->max_cfl = fmax(s->max_cfl, cfl_of(s, s->prm.steady ? s->newton->dtau : dt));
    diagnose(s, dt, good, d);
    run_diagnose(d, s->b.cart);
    return dt;
}

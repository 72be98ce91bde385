/* fv_step.c - size of a step, what it may not do, and the surface around it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bc.h"
#include "levelset.h"
#include "limits.h"
#include "newton.h"
#include "watches.h"

/* Largest |u_a| and sum of |u_a| w_a of a row of cells (in 2D the third is one of the others). A
 * value that is not finite makes the sum infinite. */
static void measure_row(const double *restrict u, const double *restrict v,
                        const double *restrict w, const double *weight, int64_t n, double *most)
{
    double x = 0.0, y = 0.0, z = 0.0, all = 0.0;
    int64_t bad = 0;
    for (int64_t i = 0; i < n; i++) {
        const double a = fabs(u[i]), b = fabs(v[i]), c = fabs(w[i]);
        const double sum = a * weight[0] + b * weight[1] + c * weight[2];
        x = a > x ? a : x;
        y = b > y ? b : y;
        z = c > z ? c : z;
        all = sum > all ? sum : all;
        bad |= sum < 1e300 ? 0 : 1;
    }
    most[0] = fmax(most[0], x);
    most[1] = fmax(most[1], y);
    most[2] = fmax(most[2], z);
    most[3] = bad ? INFINITY : fmax(most[3], all);
}

/* Largest |u_a| and sum of |u_a|/h_a over all ranks; a value that is not finite makes it so. */
void measure(struct fv *s)
{
    const struct block *b = &s->b;
    double most[4] = {0.0, 0.0, 0.0, 0.0};
    BLOCK_ROWS (b, 0, c, n) {
        const double weight[3] = {1.0 / b->h[0], 1.0 / block_size(b, 1, j_),
                                  b->dim == 3 ? 1.0 / b->h[2] : 0.0};
        measure_row(s->u[0] + c, s->u[1] + c, s->u[b->dim == 3 ? 2 : 1] + c, weight, n, most);
    }
    for (int a = 0; a < 3 && !(most[3] < INFINITY); a++)
        most[a] = INFINITY;
    MPI_Allreduce(MPI_IN_PLACE, most, 4, MPI_DOUBLE, MPI_MAX, b->cart);
    for (int a = 0; a < 3; a++)
        s->umax[a] = a < b->dim ? most[a] : 0.0;
    s->rate = most[3];
}

static void describe_worst(const struct fv *s, double before, struct diagnosis *d)
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
    snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, step of %g s, limited by %s", x[0], x[1],
             x[2], s->dt, limit_name(s->limit));
    limits_explain(&s->prm, s->limit, before, s->rate * s->dt, s->surface != NULL, d->likely,
                   sizeof d->likely);
}

double fv_speed(const struct fv *s, int a)
{
    const bool driven = s->drive[a] != 0.0 || (s->bc && s->bc->driven);
    return fmax(fmax(s->umax[a], s->bc ? s->bc->speed_along[a] : 0.0),
                driven ? s->scene_speed : 0.0);
}

/* The velocity of an impact is not known before it: a step that turns out too long is taken back
 * and done again in half the time. */
static bool step_with_surface(struct fv *s, double *dt)
{
    const double most = 1.5 * fmax(s->prm.cfl, 0.1), rate = s->rate;
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
        if ((good && s->rate * *dt <= most) || tries == 8)
            return good;
        surface_back(s);
        memcpy(s->umax, before, sizeof before);
        s->rate = rate;
        *dt *= 0.5;
    }
}

static void diagnose(const struct fv *s, double dt, double before, bool good, struct diagnosis *d)
{
    const double most = fmax(s->umax[0], fmax(s->umax[1], s->umax[2]));
    if (!isfinite(most) || !(most <= s->u_limit)) {
        describe_worst(s, before, d);
    } else if (!good) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason,
                 "the viscous solver did not converge in 200 iterations");
        snprintf(d->where, sizeof d->where, "step of %g s, nu dt/h^2 = %g", dt,
                 s->nu * dt / (s->b.h[0] * s->b.h[0]));
        snprintf(d->likely, sizeof d->likely,
                 "a smaller step: fv.cfl below %g, or fv.tol_viscous = 1e-2", s->prm.cfl);
    } else if (s->surface && surface_trouble(s)) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason, "%s", surface_trouble(s));
        snprintf(d->where, sizeof d->where, "all cells, after a step of %g s", dt);
        snprintf(d->likely, sizeof d->likely, "it has all left, or is finer than the cells");
    }
}

double integrate(struct fv *s, double t_stop, struct diagnosis *d)
{
    const struct step_limit most = limits_of(s);
    const double left = t_stop - s->t, before = s->rate;
    const double n = fmax(ceil(left / most.dt - 1e-9), 1.0);
    double dt = left / n;
    bool good = true;
    s->limit = dt < 0.5 * most.dt ? LIMIT_OUTPUT : most.by;
    if (s->prm.steady)
        dt = newton_pseudo_step(s, fmin(most.dt, s->run->scene.time.end), t_stop, d);
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
    s->max_cfl = fmax(s->max_cfl, s->rate * (s->prm.steady ? s->newton->dtau : dt));
    diagnose(s, dt, before * dt, good, d);
    s->u_limit = limits_follow(&s->reference, fmax(s->umax[0], fmax(s->umax[1], s->umax[2])));
    if (!run_diagnose(d, s->b.cart) && !s->predicts)
        fv_watches_look(s, d);
    return dt;
}

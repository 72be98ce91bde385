/* extremes.c - largest speeds, sound speeds, shifts and extreme densities of a step. Each rank
 * collects a record of EXTREMES maxima per level: velocities of displacement in the last stage
 * (extremes_of_lines, from prim and slope), speeds and densities at the end of the step
 * (extremes_of_state, from y). One MPI_MAX over all levels then gives s->step, on which the next
 * step's size, the skin of the lists, the scale of shifting and the watches depend.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "extremes.h"

#include "../particles/sph_particles.h"

/* A NaN never replaces anything: faults are found by sph_fault_of instead. */
void extremes_raise(double *most, double v) { *most = v > *most ? v : *most; }

/* The drift that relative speeds refer to is that of the step before: it is only known after the
 * reduction. Guards leave after u0 and the stray velocity have been counted. */
void extremes_of_lines(struct sph *s, double *most)
{
    timer_start(&s->run->timers, "update");
    const int dim = s->dim;
    double shift = 0.0, stray = 0.0, relative = 0.0; /* squared */
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i);
        const double *u0 = slope_line(&s->p, i) + dim + dim * dim;
        const double c = eos_c(q[at_rho(dim)], s->rho0, s->c0, s->gamma);
        double shift2 = 0.0, stray2 = 0.0, relative2 = 0.0;
        for (int a = 0; a < dim; a++) {
            shift2 += (q[dim + a] - u0[a]) * (q[dim + a] - u0[a]);
            stray2 += (u0[a] - s->step.drift[a]) * (u0[a] - s->step.drift[a]);
            relative2 += (q[dim + a] - s->step.drift[a]) * (q[dim + a] - s->step.drift[a]);
            extremes_raise(most + MOST_U0 + a, u0[a]);
            extremes_raise(most + LEAST_U0 + a, -u0[a]);
        }
        extremes_raise(&stray, stray2);
        if (particles_is_guard(&s->p, i))
            continue;
        extremes_raise(most + MOST_C, c);
        extremes_raise(&shift, shift2);
        extremes_raise(most + MOST_SIGNAL, c + sqrt(shift2));
        extremes_raise(&relative, relative2);
    }
    extremes_raise(most + MOST_SHIFT, sqrt(shift));
    extremes_raise(most + MOST_STRAY, sqrt(stray));
    extremes_raise(most + MOST_RELATIVE, sqrt(relative));
    timer_stop(&s->run->timers, "update");
}

void extremes_of_state(struct sph *s, double *most)
{
    timer_start(&s->run->timers, "update");
    for (int i = 0; i < s->p.n; i++) {
        double speed, rho;
        extremes_raise(most + MOST_FAULT,
                       sph_fault_of(s, state_row(&s->p, s->p.y, i), &speed, &rho));
        extremes_raise(most + MOST_SPEED, speed);
        extremes_raise(most + MOST_RHO, rho);
        extremes_raise(most + LEAST_RHO, -rho);
    }
    timer_stop(&s->run->timers, "update");
}

void extremes_clear(double most[LEVELS][EXTREMES])
{
    for (int l = 0; l < LEVELS; l++)
        for (int k = 0; k < EXTREMES; k++)
            most[l][k] = -1e300;
}

/* Takes over the extremes of the whole flow, most[], into s->step; the signal is this level's own.
 * The drift is the middle of the range of u0 along each axis, so that |u0 - drift| bounds half of
 * any relative velocity. */
static void learn(struct sph *s, const double *most, double signal)
{
    s->step.signal = signal;
    s->step.max_c = most[MOST_C];
    s->step.max_shift = most[MOST_SHIFT];
    s->step.stray = most[MOST_STRAY];
    for (int a = 0; a < s->dim; a++)
        s->step.drift[a] = 0.5 * (most[MOST_U0 + a] - most[LEAST_U0 + a]);
    const bool empty = most[MOST_RHO] < 0.0; /* water may yet come in by an open side */
    s->step.max_speed = fmax(most[MOST_SPEED], 0.0);
    s->step.rho_max = empty ? s->rho0 : most[MOST_RHO];
    s->step.rho_min = empty ? s->rho0 : -most[LEAST_RHO];
    /* 0.1 c0 is the speed that a sound speed is chosen for; transport_finish bounds what comes of
     * it at walls. */
    const double speed = s->walls ? fmax(s->step.max_speed, s->nu / s->R) : most[MOST_RELATIVE];
    const bool bounded = s->walls && sph_params_is_riemann(s->prm.scheme);
    s->step.shift_speed =
        bounded ? 0.1 * s->c0
                : fmin(fmax(s->step.shift_speed, speed), (s->walls ? 0.1 : 0.2) * s->c0);
    s->total.max_mach = fmax(s->total.max_mach, s->step.max_speed / s->c0);
    if (s->t >= 0.5 * s->run->scene.time.end)
        s->total.mach_late = fmax(s->total.mach_late, s->step.max_speed / s->c0);
}

/* How much the drift carries all water alike, 0 to 1 (struct sph_step), after learn: from 0 where
 * what is relative to it reaches half of it to 1 where that is a quarter. Where anything rests it
 * reaches the whole. Not with open sides, where what differs little from the stream may be the flow
 * that is asked for. */
static double carried(const struct sph *s)
{
    const double drift = vec3_length(s->step.drift);
    return drift > 0.0 && !s->zones ? fmax(0.0, fmin(2.0 - 4.0 * s->step.stray / drift, 1.0)) : 0.0;
}

/* Records of all levels stand side by side, so that it is one reduction whatever the number of
 * levels. */
void extremes_reduce(struct sph *s, double most[LEVELS][EXTREMES])
{
    double signal[LEVELS];
    int n = 0;
    for (const struct sph *q = s; q; q = q->finer)
        n++;
    MPI_Allreduce(MPI_IN_PLACE, most, n * EXTREMES, MPI_DOUBLE, MPI_MAX, s->run->comm);
    for (int m = 0; m < n; m++) {
        signal[m] = most[m][MOST_SIGNAL];
        for (int k = 0; k < EXTREMES; k++)
            extremes_raise(most[0] + k, most[m][k]);
    }
    for (struct sph *q = s; q; q = q->finer) {
        learn(q, most[0], signal[q->level]);
        q->step.carried = carried(s);
    }
}

void extremes_reduce_level(struct sph *s, double *most)
{
    MPI_Allreduce(MPI_IN_PLACE, most, EXTREMES, MPI_DOUBLE, MPI_MAX, s->run->comm);
    s->step.signal = most[MOST_SIGNAL];
    s->step.stray = most[MOST_STRAY];
}

/* runge_kutta.h - explicit Runge-Kutta schemes of low storage: each stage starts from the state
 * before the step and the rates of the stage before it,
 *   y_0 = y
 *   y_k+1 = y + ahead_k dt f(y_k)
 *   y' = y + dt sum_k weight_k f(y_k)
 * What goes with the fluid in time (forces, work, bodies) reads the same coefficients.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_RUNGE_KUTTA_H
#define SPH_RUNGE_KUTTA_H

/* Most stages of a scheme. */
enum { STAGES_MOST = 4 };

/* The coefficients of one scheme; constant tables. */
struct rk_stages {
    const char *name;           /* "rk4", "j3" */
    int n;                      /* stages */
    double at[STAGES_MOST];     /* dt: time of stage k after that of the step's start */
    double ahead[STAGES_MOST];  /* dt: from the start to stage k + 1; of the last stage nothing */
    double weight[STAGES_MOST]; /* of the rates of stage k in the step; their sum is 1 */
    double real_axis;           /* stable for dt lambda down to minus that */
};

/* The scheme that a run uses. integrator: enum sph_integrator but AUTO; scheme: enum sph_scheme.
 * Static memory. */
const struct rk_stages *stages_of(int integrator, int scheme);

#endif

/* newton_case.h - what the tests of newton on all grids ask of it.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../../fv/time/newton.h"

/* By how much M (v + w) differs from M v + M w, over the largest of it: GMRES believes in residuals
 * that are not there if the preconditioner is not linear. v, w: random, on this rank. */
static inline double newton_precond_bends(struct fv *s)
{
    struct newton *w = s->newton;
    N_Vector v[3] = {N_VClone(w->q), N_VClone(w->q), N_VClone(w->q)};
    newton_set_step(s, 0.05, 0.0);
    newton_precond_setup(w->q, w->uscale, w->q, w->fscale, s);
    for (int m = 0; m < 2; m++)
        for (int64_t i = 0; i < (s->dim + 1) * w->cells; i++)
            N_VGetArrayPointer(v[m])[i] = (double)rand() / RAND_MAX - 0.5;
    N_VLinearSum(1.0, v[0], 1.0, v[1], v[2]);
    for (int m = 0; m < 3; m++)
        newton_precond_solve(w->q, w->uscale, w->q, w->fscale, v[m], s);
    N_VLinearSum(1.0, v[0], 1.0, v[1], v[0]);
    N_VLinearSum(1.0, v[2], -1.0, v[0], v[0]);
    const double error = N_VMaxNorm(v[0]) / N_VMaxNorm(v[2]);
    for (int m = 0; m < 3; m++)
        N_VDestroy(v[m]);
    return error;
}

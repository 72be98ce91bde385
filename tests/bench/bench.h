/* bench.h - the two limits that kernels are held to: of arithmetic and of memory.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>

#include "../../common/base/timer.h"
#include "../../fv/fv.h"

/* GFLOP/s of fused multiply-adds in registers and the innermost cache. */
static inline double bench_peak(void)
{
    double a[64], best = INFINITY, sum = 0.0;
    const long n = 2000000;
    for (int k = 0; k < 64; k++)
        a[k] = k;
    for (int repeat = 0; repeat < 4; repeat++) {
        const double t = cpu_time();
        for (long i = 0; i < n; i++)
            for (int k = 0; k < 64; k++)
                a[k] = a[k] * 0.999999 + 1e-6;
        best = fmin(best, cpu_time() - t);
    }
    for (int k = 0; k < 64; k++)
        sum += a[k];
    return sum > 0.0 ? 1e-9 * (double)n * 64 * 2 / best : 0.0;
}

/* Doubles a second, 1e9, of x = y + a z over fields of the solver's size (rhs, N and N_old are
 * overwritten). */
static inline double bench_triad(struct fv *s)
{
    double best = INFINITY;
    for (int repeat = 0; repeat < 8; repeat++) {
        double *restrict x = s->rhs[0], *restrict y = s->stages.N[0],
                         *restrict z = s->stages.N_old[0];
        const double t = cpu_time();
        for (int n = 0; n < 10; n++)
            for (int64_t i = 0; i < s->size; i++)
                x[i] = y[i] + 1e-3 * n * z[i];
        best = fmin(best, cpu_time() - t);
    }
    return 1e-9 * 30.0 * (double)s->size / best;
}

/* weno.c - see weno.h. Bodies are written without branches, for vector registers. A derivative
 * needs the five one-sided differences around a cell, D[0 .. 4] from the left or D[5 .. 1] from the
 * right; weno5 weights the three parabolas through them by their smoothness.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "weno.h"

#include "../../common/base/base.h"

INLINE double square(double x) { return x * x; }

/* Jiang & Peng, eqs. 2.6-2.12: v1 .. v5 are one-sided differences from far upwind on. The weights
 * a_k/(S_k + e)^2 are multiplied by all the (S_k + e)^2, which leaves one division. */
INLINE double weno5(double v1, double v2, double v3, double v4, double v5)
{
    const double S1 =
        13.0 / 12.0 * square(v1 - 2.0 * v2 + v3) + 0.25 * square(v1 - 4.0 * v2 + 3.0 * v3);
    const double S2 = 13.0 / 12.0 * square(v2 - 2.0 * v3 + v4) + 0.25 * square(v2 - v4);
    const double S3 =
        13.0 / 12.0 * square(v3 - 2.0 * v4 + v5) + 0.25 * square(3.0 * v3 - 4.0 * v4 + v5);
    const double e1 = square(S1 + 1e-6), e2 = square(S2 + 1e-6), e3 = square(S3 + 1e-6);
    const double a1 = 0.1 * e2 * e3, a2 = 0.6 * e1 * e3, a3 = 0.3 * e1 * e2;
    return (a1 * (2.0 * v1 - 7.0 * v2 + 11.0 * v3) + a2 * (5.0 * v3 - v2 + 2.0 * v4) +
            a3 * (2.0 * v3 + 5.0 * v4 - v5)) /
           (6.0 * (a1 + a2 + a3));
}

/* Differences around a cell: D[k] = (q_k-2 - q_k-3)/h; from the left 0 .. 4, from the right 5 .. 1.
 */
INLINE void differences(const double *q, int64_t d, double per_h, double D[6])
{
    for (int k = 0; k < 6; k++)
        D[k] = per_h * (q[(k - 2) * d] - q[(k - 3) * d]);
}

void weno_advect(const double *restrict q, const double *restrict u, int64_t d, double per_h,
                 int64_t n, double *restrict rate)
{
    for (int64_t i = 0; i < n; i++) {
        double D[6];
        differences(q + i, d, per_h, D);
        const int left = u[i] >= 0.0;
        rate[i] -= u[i] * weno5(left ? D[0] : D[5], left ? D[1] : D[4], left ? D[2] : D[3],
                                left ? D[3] : D[2], left ? D[4] : D[1]);
    }
}

void weno_add_square(const double *restrict q, const double *restrict sign, int64_t d, double per_h,
                     int64_t n, double *restrict sum)
{
    for (int64_t i = 0; i < n; i++) {
        double D[6];
        differences(q + i, d, per_h, D);
        const double s = sign[i] < 0.0 ? -1.0 : 1.0;
        const double left = s * weno5(D[0], D[1], D[2], D[3], D[4]),
                     right = s * weno5(D[5], D[4], D[3], D[2], D[1]);
        const double in = left > 0.0 ? left * left : 0.0, out = right < 0.0 ? right * right : 0.0;
        sum[i] += in > out ? in : out;
    }
}

void weno_slopes(const double *restrict q, int64_t d, double per_h, int64_t n,
                 double *restrict below, double *restrict above)
{
    for (int64_t i = 0; i < n; i++) {
        double D[6];
        differences(q + i, d, per_h, D);
        below[i] = weno5(D[0], D[1], D[2], D[3], D[4]);
        above[i] = weno5(D[5], D[4], D[3], D[2], D[1]);
    }
}

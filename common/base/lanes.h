/* lanes.h - sums and bounds over lists: partial results side by side, for vector registers (strict
 * order of summation would forbid them).
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdint.h>

/* Partial sums that run side by side: 8 doubles fill the vector registers of AVX-512, or two of
 * AVX2. Results depend on this number in their last bits, so it is the same on all machines. */
enum { SUM_LANES = 8 };

/* fmin and fmax are calls, for the sake of what is no number. */
static inline double lesser(double a, double b) { return a < b ? a : b; }
static inline double greater(double a, double b) { return a > b ? a : b; }

/* The sum of the partial sums, in pairs, so that the order of summation is fixed. */
static inline double lanes_sum(const double p[SUM_LANES])
{
    return ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
}

/* The dot product of a[n] and b[n]; n must be a multiple of SUM_LANES. */
static inline double lanes_dot(const double *restrict a, const double *restrict b, int n)
{
    double part[SUM_LANES] = {0.0};
    for (int k = 0; k < n; k += SUM_LANES)
        for (int m = 0; m < SUM_LANES; m++)
            part[m] += a[k + m] * b[k + m];
    return lanes_sum(part);
}

/* The dot product of a[n] and b[n] for any n; n = 0 gives 0. */
static inline double lanes_dot_any(const double *restrict a, const double *restrict b, int64_t n)
{
    double part[SUM_LANES] = {0.0};
    int64_t i = 0;
    for (; i + SUM_LANES <= n; i += SUM_LANES)
        for (int m = 0; m < SUM_LANES; m++)
            part[m] += a[i + m] * b[i + m];
    for (; i < n; i++)
        part[0] += a[i] * b[i];
    return lanes_sum(part);
}

/* The same of floats, of which twice as many fill a register. */
static inline double lanes_dot_single(const float *restrict a, const float *restrict b, int64_t n)
{
    float part[2 * SUM_LANES] = {0.0F};
    double sum = 0.0;
    int64_t i = 0;
    for (; i + 2 * SUM_LANES <= n; i += 2 * SUM_LANES)
        for (int m = 0; m < 2 * SUM_LANES; m++)
            part[m] += a[i + m] * b[i + m];
    for (; i < n; i++)
        part[0] += a[i] * b[i];
    for (int m = 0; m < 2 * SUM_LANES; m++)
        sum += (double)part[m];
    return sum;
}

/* The sum of a[n] for any n; n = 0 gives 0. */
static inline double lanes_total(const double *restrict a, int64_t n)
{
    double part[SUM_LANES] = {0.0};
    int64_t i = 0;
    for (; i + SUM_LANES <= n; i += SUM_LANES)
        for (int m = 0; m < SUM_LANES; m++)
            part[m] += a[i + m];
    for (; i < n; i++)
        part[0] += a[i];
    return lanes_sum(part);
}

/* Sets *low and *high to the smallest and the largest of a[n]; n must be a multiple of SUM_LANES
 * and > 0. Elements that are NaN are passed over, but for those among the first SUM_LANES. */
static inline void lanes_bounds(const double *restrict a, int n, double *low, double *high)
{
    double l[SUM_LANES], h[SUM_LANES];
    for (int m = 0; m < SUM_LANES; m++)
        l[m] = h[m] = a[m];
    for (int k = SUM_LANES; k < n; k += SUM_LANES)
        for (int m = 0; m < SUM_LANES; m++) {
            l[m] = a[k + m] < l[m] ? a[k + m] : l[m];
            h[m] = a[k + m] > h[m] ? a[k + m] : h[m];
        }
    *low = l[0];
    *high = h[0];
    for (int m = 1; m < SUM_LANES; m++) {
        *low = l[m] < *low ? l[m] : *low;
        *high = h[m] > *high ? h[m] : *high;
    }
}

/* reflection.c - see reflection.h. Pure functions on samples that the caller has read; used by
 * common/run/wave_gauges.c at the end of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "reflection.h"

#include <complex.h>
#include <lapacke.h>
#include <math.h>

enum { TERMS = 5 };

/* Normal equations of five unknowns: mean, cosine and sine of omega and 2 omega. The second
 * harmonic is fitted along because steep waves have one, and a record that is no whole number of
 * periods would else lay part of it upon the first. */
double complex reflection_amplitude(int n, const double *t, const double *v, double omega)
{
    double A[TERMS * TERMS] = {0.0}, b[TERMS] = {0.0};
    lapack_int pivots[TERMS];
    for (int i = 0; i < n; i++) {
        const double before = i > 0 ? t[i] - t[i - 1] : 0.0,
                     after = i + 1 < n ? t[i + 1] - t[i] : 0.0, weight = 0.5 * (before + after),
                     a = omega * t[i];
        const double row[TERMS] = {1.0, cos(a), -sin(a), cos(2.0 * a), -sin(2.0 * a)};
        for (int j = 0; j < TERMS; j++) {
            b[j] += weight * row[j] * v[i];
            for (int k = 0; k < TERMS; k++)
                A[j * TERMS + k] += weight * row[j] * row[k];
        }
    }
    if (LAPACKE_dgesv(LAPACK_ROW_MAJOR, TERMS, 1, A, TERMS, pivots, b, 1) != 0)
        return NAN;
    return b[1] + I * b[2];
}

/* Minimises sum_g |A_g - a e^(-ikx_g) - b e^(ikx_g)|^2; with S = sum e^(2ikx_g) its 2 x 2 normal
 * equations have the determinant n^2 - |S|^2. */
struct reflection reflection_separate(int n, const double *x, const double complex *A, double k)
{
    double complex S = 0.0, minus = 0.0, plus = 0.0;
    for (int g = 0; g < n; g++) {
        S += cexp(2.0 * I * (k * x[g]));
        plus += A[g] * cexp(I * (k * x[g]));
        minus += A[g] * cexp(-I * (k * x[g]));
    }
    const double det = (double)n * n - creal(S * conj(S));
    struct reflection r = {.condition = det / ((double)n * n)};
    r.onward = (n * plus - S * minus) / det;
    r.back = (n * minus - conj(S) * plus) / det;
    for (int g = 0; g < n; g++)
        r.rest = fmax(
            r.rest, cabs(A[g] - r.onward * cexp(-I * (k * x[g])) - r.back * cexp(I * (k * x[g]))));
    return r;
}

/* Sum of the squares of what a and b leave at the gauges. */
static double left(int n, const double *x, const double complex *A, double k)
{
    const struct reflection r = reflection_separate(n, x, A, k);
    double sum = 0.0;
    for (int g = 0; g < n; g++) {
        const double complex d =
            A[g] - r.onward * cexp(-I * (k * x[g])) - r.back * cexp(I * (k * x[g]));
        sum += creal(d * conj(d));
    }
    return sum;
}

/* By golden section: sixty steps shrink the interval to its rounding, and no derivative is
 * needed. */
double reflection_fit_number(int n, const double *x, const double complex *A, double k,
                             double share)
{
    const double golden = 0.5 * (sqrt(5.0) - 1.0);
    double lo = k * (1.0 - share), hi = k * (1.0 + share);
    for (int it = 0; it < 60; it++) {
        const double a = hi - golden * (hi - lo), b = lo + golden * (hi - lo);
        if (left(n, x, A, a) < left(n, x, A, b))
            hi = b;
        else
            lo = a;
    }
    return 0.5 * (lo + hi);
}

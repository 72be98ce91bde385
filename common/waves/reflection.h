/* reflection.h - waves that run both ways past level gauges, told apart.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_REFLECTION_H
#define COMMON_REFLECTION_H

#include <complex.h>

/* A of mean + Re A e^(iwt) + Re B e^(2iwt), least squares over the n samples v at the times t
 * (rising, not evenly), each weighted by the time that it stands for. */
double complex reflection_amplitude(int n, const double *t, const double *v, double omega);

struct reflection {
    double complex onward, back; /* of a e^(i(wt - kx)) + b e^(i(wt + kx)) */
    double condition;            /* 1 - |S|^2/N^2, 0: gauges half a length apart tell nothing */
    double rest;                 /* largest |difference| that a, b leave at a gauge */
};
/* From amplitudes A at n >= 2 places x (m), least squares (two: Goda & Suzuki 1976; three: Mansard
 * & Funke 1980); k in 1/m. */
struct reflection reflection_separate(int n, const double *x, const double complex *A, double k);
/* The k within `share' of the given one that leaves least; of four gauges or more. */
double reflection_fit_number(int n, const double *x, const double complex *A, double k,
                             double share);

#endif

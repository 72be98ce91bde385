/* reflection.h - separates waves that run both ways past level gauges.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_REFLECTION_H
#define COMMON_REFLECTION_H

/* The complex amplitude A of mean + Re A e^(iwt) + Re B e^(2iwt), w = omega in rad/s, fitted by
 * least squares to the n samples v at the times t, s (rising, not necessarily equidistant), each
 * weighted by the time that it stands for. NAN if the samples do not determine it. */
double _Complex reflection_amplitude(int n, const double *t, const double *v, double omega);

/* The result of a separation. */
struct reflection {
    /* Amplitudes a, b of a e^(i(wt - kx)) + b e^(i(wt + kx)). */
    double _Complex onward, back;
    double condition; /* 1 - |S|^2/N^2 of the normal equations; 0: gauges half a length apart do not
                         separate */
    double rest;      /* largest |misfit| that a and b leave at a gauge */
};
/* From the amplitudes A at n >= 2 positions x, m, by least squares (two: Goda & Suzuki 1976; three:
 * Mansard & Funke 1980); wave number k in 1/m. */
struct reflection reflection_separate(int n, const double *x, const double _Complex *A, double k);
/* The wave number within a fraction `share' of k that leaves the smallest misfit; with four gauges
 * or more. */
double reflection_fit_number(int n, const double *x, const double _Complex *A, double k,
                             double share);

#endif

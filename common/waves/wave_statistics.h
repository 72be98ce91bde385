/* wave_statistics.h - heights and spectrum of a level over time, from the samples of a gauge.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_STATISTICS_H
#define COMMON_WAVE_STATISTICS_H

/* Statistics of the waves between upward crossings of the mean level; all 0 but `spectral' without
 * waves. */
struct wave_heights {
    int n;                             /* number of waves */
    double mean, significant, largest; /* m: of all, of the highest third, of the highest */
    double period;                     /* s: mean */
    double spectral;                   /* m: four times the standard deviation */
};
/* From n samples v, m, at the times t, s, rising. */
struct wave_heights wave_heights_of(int n, const double *t, const double *v);

/* Samples of a segment of the spectrum, and frequencies that follow from them. */
enum { SPECTRUM_SEGMENT = 256, SPECTRUM_BINS = SPECTRUM_SEGMENT / 2 };
/* Spectral density S (m^2/Hz) at f (Hz), SPECTRUM_BINS each from the lowest frequency on, by
 * Welch's method: Hann's window, segments that overlap by half; about `segments' of them. */
void wave_spectrum(int n, const double *t, const double *v, int segments, double *f, double *S);

#endif

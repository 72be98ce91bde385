/* wave_statistics.h - heights and spectrum of a level over time.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_STATISTICS_H
#define COMMON_WAVE_STATISTICS_H

struct wave_heights {
    int n;                             /* waves: from one crossing of the mean upward to the next */
    double mean, significant, largest; /* m: of all, of the highest third, of the highest */
    double period;                     /* s: mean */
    double spectral;                   /* m: four times the standard deviation */
};
/* Of n samples v at the times t (rising). */
struct wave_heights wave_heights_of(int n, const double *t, const double *v);

enum { SPECTRUM_SEGMENT = 256, SPECTRUM_BINS = SPECTRUM_SEGMENT / 2 };
/* Spectral density S (m^2/Hz) at f (Hz), SPECTRUM_BINS each from the lowest frequency on, by
 * Welch's method: Hann's window, segments that overlap by half; about `segments' of them. */
void wave_spectrum(int n, const double *t, const double *v, int segments, double *f, double *S);

#endif

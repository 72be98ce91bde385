/* wave_statistics.c - see wave_statistics.h. Zero up-crossings of the mean divide the record into
 * waves; a wave's height is its crest less its trough. The spectrum is summed directly,
 * SPECTRUM_SEGMENT^2/2 terms for each segment, at the end of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_statistics.h"

#include <complex.h>

#include "../base/base.h"

/* Trapezoidal, for steps may differ. */
static double mean_of(int n, const double *t, const double *v)
{
    double sum = 0.0;
    for (int i = 1; i < n; i++)
        sum += 0.5 * (v[i] + v[i - 1]) * (t[i] - t[i - 1]);
    return n > 1 && t[n - 1] > t[0] ? sum / (t[n - 1] - t[0]) : 0.0;
}

static double deviation_of(int n, const double *t, const double *v, double mean)
{
    double sum = 0.0;
    for (int i = 1; i < n; i++) {
        const double a = v[i - 1] - mean, b = v[i] - mean;
        sum += (a * a + a * b + b * b) / 3.0 * (t[i] - t[i - 1]); /* linear between samples */
    }
    return n > 1 && t[n - 1] > t[0] ? sqrt(sum / (t[n - 1] - t[0])) : 0.0;
}

static int falling(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* Crossings are found linear between samples. What lies before the first and behind the last one is
 * no whole wave. */
struct wave_heights wave_heights_of(int n, const double *t, const double *v)
{
    const double mean = mean_of(n, t, v);
    double *height = NEW(double, n > 0 ? n : 1), hi = -INFINITY, lo = INFINITY, first = 0.0,
           last = 0.0;
    int crossings = 0;
    struct wave_heights h = {.spectral = 4.0 * deviation_of(n, t, v, mean)};
    for (int i = 1; i < n; i++) {
        if (v[i - 1] < mean && v[i] >= mean) {
            last = t[i - 1] + (t[i] - t[i - 1]) * (mean - v[i - 1]) / (v[i] - v[i - 1]);
            if (crossings++ > 0)
                height[h.n++] = hi - lo;
            else
                first = last;
            hi = -INFINITY;
            lo = INFINITY;
        }
        hi = fmax(hi, v[i]);
        lo = fmin(lo, v[i]);
    }
    qsort(height, (size_t)h.n, sizeof *height, falling);
    const int third = (h.n + 2) / 3;
    for (int i = 0; i < h.n; i++) {
        h.mean += height[i] / h.n;
        h.significant += i < third ? height[i] / third : 0.0;
    }
    h.largest = h.n > 0 ? height[0] : 0.0;
    h.period = h.n > 0 ? (last - first) / h.n : 0.0;
    mem_free(height);
    return h;
}

/* Linear between samples; *at: where the last one was found. */
static double value_at(int n, const double *t, const double *v, double time, int *at)
{
    while (*at < n - 2 && t[*at + 1] < time)
        (*at)++;
    const double dt = t[*at + 1] - t[*at], w = dt > 0.0 ? (time - t[*at]) / dt : 0.0;
    return (1.0 - w) * v[*at] + w * v[*at + 1];
}

/* Segments of 2 all/(segments + 1) seconds, half a length apart, each sampled anew at
 * SPECTRUM_SEGMENT equal steps. One-sided: the densities of +f and -f are added, but for the last
 * bin, which stands for both. Divided by the sum of the window's squares, so that the integral of S
 * is the variance. */
void wave_spectrum(int n, const double *t, const double *v, int segments, double *f, double *S)
{
    const double mean = mean_of(n, t, v), all = n > 1 ? t[n - 1] - t[0] : 1.0,
                 length = 2.0 * all / (segments + 1), dt = length / SPECTRUM_SEGMENT;
    double y[SPECTRUM_SEGMENT], squares = 0.0;
    for (int j = 0; j < SPECTRUM_BINS; j++) {
        f[j] = (j + 1) / length;
        S[j] = 0.0;
    }
    int at = 0;
    for (int s = 0; s < segments && n > 1; s++) {
        const double from = t[0] + 0.5 * s * length;
        int here = at;
        squares = 0.0;
        for (int i = 0; i < SPECTRUM_SEGMENT; i++) {
            const double hann = 0.5 - 0.5 * cos(2.0 * M_PI * i / SPECTRUM_SEGMENT);
            y[i] = hann * (value_at(n, t, v, from + i * dt, &here) - mean);
            squares += hann * hann;
            at = i == SPECTRUM_SEGMENT / 2 ? here : at;
        }
        for (int j = 0; j < SPECTRUM_BINS; j++) {
            double complex sum = 0.0;
            for (int i = 0; i < SPECTRUM_SEGMENT; i++)
                sum += y[i] * cexp(-2.0 * M_PI * I *
                                   ((double)((j + 1) * i % SPECTRUM_SEGMENT) / SPECTRUM_SEGMENT));
            S[j] += (j + 1 < SPECTRUM_BINS ? 2.0 : 1.0) * creal(sum * conj(sum)) * dt / squares /
                    segments;
        }
    }
}

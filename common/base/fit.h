/* fit.h - period and damping of a decaying oscillation from its samples, and exponential smoothing
 * of a signal. The zero crossings give the period, the extremes between them the damping rate.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/* The samples collected so far. Start from zeroed memory; the arrays belong to the owner that
 * fit_add is called with. */
struct fit {
    int n; /* samples held */
    /* [n] times in s, strictly increasing, and values in any unit; owned */
    double *t, *v; /* s, any unit: samples, times rising */
};

/* Appends a sample at time t, s. A time that is not later than the last one is ignored: an output
 * repeats the last row of a series. */
void fit_add(void *owner, struct fit *f, double t, double v);
/* Period in s: twice the mean distance of consecutive zeros of v, each from the inverse cubic
 * through the four samples around it (linear where that leaves the interval). NAN with fewer than
 * three zeros. */
double fit_period(const struct fit *f);
/* Growth rate sigma in 1/s of |extreme| ~ exp(sigma t), negative for a decay: least squares over
 * the logarithms of the extremes between consecutive zeros, each the vertex of the parabola through
 * three samples. NAN with fewer than three extremes. */
double fit_rate(const struct fit *f);

/* Brown's double exponential smoothing with alpha = 2/(memory + 1), memory counted in samples.
 * Takes the value v, seen h s after the last one, into *level (unit of v) and *rate (per s).
 * Straight lines are followed exactly and without lag; an alternation from sample to sample comes
 * out (alpha/(2 - alpha)) (2 - alpha/(2 - alpha)) times as large.
 *
 * scatter NULL: that is all. Otherwise *scatter (unit of v, 0 at first) holds the mean deviation
 * from the forecast, and a deviation of more than twice that counts as twice, so that one spike
 * makes no trend (after Gelper, Fried & Croux, J. Forecasting 29, 2010). *scatter then grows by the
 * tenth root of the excess ratio, so that a true change is followed after some values. */
void fit_smooth(double v, double h, double memory, double *level, double *rate, double *scatter);

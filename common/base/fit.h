/* fit.h - period and damping of a decaying oscillation from its samples: zeros give the period, the
 * extremes between them the damping. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_FIT_H
#define COMMON_FIT_H

struct fit {
    int n, capacity;
    double *t, *v; /* s, any unit: samples, times rising */
};

void fit_add(struct fit *f, double t, double v);
void fit_free(struct fit *f);
/* Mean distance of zeros (by cubics through four samples) times two; NAN with fewer than three. */
double fit_period(const struct fit *f);
/* sigma of |extreme| ~ exp(sigma t), least squares over the extremes between zeros (parabolas
 * through three samples); < 0 decays; NAN with fewer than three. */
double fit_rate(const struct fit *f);

/* Brown's double exponential smoothing, alpha = 2/(memory + 1): takes the value v seen h s after
 * the last one into a level and its rate. Exact for straight lines, without lag; an alternation
 * comes out (alpha/(2 - alpha)) (2 - alpha/(2 - alpha)) times as large. Without scatter
 * (NULL) that is all; else what lies off the foreseen by more than twice its mean (*scatter, of v's
 * unit, 0 at first) counts as twice, so that one spike is no trend (after Gelper, Fried, Croux, J.
 * Forecasting 29, 2010); *scatter then grows by the tenth root of how much more it was, so that a
 * true change is believed after some values. */
void fit_smooth(double v, double h, double memory, double *level, double *rate, double *scatter);

#endif

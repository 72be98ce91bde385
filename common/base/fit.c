/* fit.c - see fit.h. Samples are only collected while a run goes on (fit_add, once a row of the
 * series); everything is worked out from the whole list at the end, in time linear in its length.
 * Zeros and extremes are found between samples, to higher order than their distance: rows are far
 * apart for the period of an oscillation.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fit.h"

#include <math.h>

#include "mem.h"

void fit_add(void *owner, struct fit *f, double t, double v)
{
    if (f->n > 0 && t <= f->t[f->n - 1])
        return; /* the same time twice: the last row before an output */
    ROOM_IN(owner, f->t, f->n + 1);
    ROOM_IN(owner, f->v, f->n + 1);
    f->t[f->n] = t;
    f->v[f->n++] = v;
}

/* The t at which v is zero between samples k and k+1, by inverse interpolation: t as a polynomial
 * in v through the up to four samples k-1 .. k+2, at v = 0,
 *   t = sum_i t_i prod_{j != i} v_j / (v_j - v_i).
 * It is no function where v is not monotonic over the four samples (an extreme next to the zero),
 * and two equal values divide by zero: outside [t_k, t_{k+1}], or NaN, the straight line between
 * the two stands in. */
static double zero_after(const struct fit *f, int k)
{
    const int lo = k > 0 ? k - 1 : 0, hi = k + 2 < f->n ? k + 2 : f->n - 1;
    double t = 0.0;
    for (int i = lo; i <= hi; i++) {
        double w = 1.0;
        for (int j = lo; j <= hi; j++)
            if (j != i)
                w *= f->v[j] / (f->v[j] - f->v[i]);
        t += w * f->t[i];
    }
    const double linear = f->t[k] - f->v[k] * (f->t[k + 1] - f->t[k]) / (f->v[k + 1] - f->v[k]);
    return t >= f->t[k] && t <= f->t[k + 1] ? t : linear;
}

/* Whether v changes sign between samples k and k+1; a zero counts to the one before. */
static int crosses(const struct fit *f, int k)
{
    return (f->v[k] > 0.0) != (f->v[k + 1] > 0.0) && f->v[k] != 0.0;
}

/* With z zeros, z - 1 half periods lie between the first and the last: their mean needs these two
 * alone, so errors of the zeros between drop out. */
double fit_period(const struct fit *f)
{
    double first = 0.0, last = 0.0;
    int zeros = 0;
    for (int k = 0; k + 1 < f->n; k++)
        if (crosses(f, k)) {
            last = zero_after(f, k);
            first = zeros++ ? first : last;
        }
    return zeros >= 3 ? 2.0 * (last - first) / (zeros - 1) : NAN;
}

/* Extreme of the parabola through samples k-1, k, k+1. Newton's divided differences with sample k
 * as origin: v = v_k + c1 h + c2 h^2, vertex at h = -c1 / (2 c2). The samples need not be equally
 * far apart. */
static void extreme(const struct fit *f, int k, double *t, double *v)
{
    const double a = f->t[k - 1] - f->t[k], b = f->t[k + 1] - f->t[k];
    const double da = f->v[k - 1] - f->v[k], db = f->v[k + 1] - f->v[k];
    const double c2 = (da / a - db / b) / (a - b), c1 = da / a - c2 * a;
    const double h = c2 != 0.0 ? -0.5 * c1 / c2 : 0.0;
    *t = f->t[k] + h;
    *v = f->v[k] + h * (c1 + h * c2);
}

/* One pass: `best' is the largest |v| since the last zero, its logarithm enters the sums of the
 * straight line's least squares when the next zero closes the half period. What lies before the
 * first and behind the last zero is no whole half period and does not count. */
double fit_rate(const struct fit *f)
{
    double n = 0.0, st = 0.0, sl = 0.0, stt = 0.0, stl = 0.0;
    int best = -1, zeros = 0;
    for (int k = 1; k + 1 < f->n; k++) {
        if (zeros > 0 && (best < 0 || fabs(f->v[k]) > fabs(f->v[best])))
            best = k;
        if (!crosses(f, k))
            continue;
        if (zeros++ > 0 && best > 0) {
            double t, v;
            extreme(f, best, &t, &v);
            const double l = log(fabs(v));
            n += 1.0;
            st += t;
            sl += l;
            stt += t * t;
            stl += t * l;
        }
        best = -1;
    }
    return n >= 3.0 ? (n * stl - st * sl) / (n * stt - st * st) : NAN;
}

/* What of the news counts, see fit_smooth. `scatter' follows |news| with weight 0.1, that is over
 * about ten samples; the first deviation sets it. */
static double believed(double news, double *scatter)
{
    const double most = *scatter > 0.0 ? 2.0 * *scatter : INFINITY;
    if (fabs(news) > most) {
        *scatter *= pow(fabs(news) / *scatter, 0.1);
        return copysign(most, news);
    }
    *scatter += (*scatter > 0.0 ? 0.1 : 1.0) * (fabs(news) - *scatter);
    return news;
}

/* Brown's smoothing in its form with a correction of the forecast: with the deviation e = v -
 * (level + h rate),
 *   level <- level + h rate + alpha (2 - alpha) e,   rate <- rate + alpha^2 e / h,
 * which is the double smoothing 2 S' - S'' without its two memories. */
void fit_smooth(double v, double h, double memory, double *level, double *rate, double *scatter)
{
    const double alpha = 2.0 / (memory + 1.0), foreseen = *level + h * *rate;
    const double news = scatter ? believed(v - foreseen, scatter) : v - foreseen;
    *level = foreseen + alpha * (2.0 - alpha) * news;
    *rate += alpha * alpha / h * news;
}

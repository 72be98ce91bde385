/* sea_gains.c - see sea_gains.h. zone_response solves a linear problem of some thousand unknowns;
 * GAINS frequencies and COSINES directions of them are enough, for the gain changes slowly with
 * both.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sea_gains.h"

#include <complex.h>

#include "../base/base.h"
#include "zone_gain.h"

enum { GAINS = 16, COSINES = 5 };

/* What a zone does to waves of one frequency. Where it damps them by e^-7 on their way the water at
 * its inner edge moves as the target does, whatever the side does, and both factors are 1 (to 0.3
 * %; of waves of 0.3 to 4 depths, of angles up to 78 degrees): there they need not be found, and
 * that of waves to the side cannot be, being the ratio of two amplitudes below the grid's error.
 * The amplitude falls by half of the rate, whose mean over the zone is a third of that at the side.
 */
static struct zone_response response_of(const struct wave_spec *of, double omega, double k,
                                        double cosine)
{
    const double along = waves_group_velocity(k, of->g, of->depth) * cosine;
    if (of->rate * of->zone > 7.0 * 6.0 * along)
        return (struct zone_response){1.0, 1.0, 0.0};
    return zone_response(omega, k, cosine, of->g, of->depth, of->zone, of->rate);
}

double complex sea_gain_open(const struct wave_spec *of, double k, double complex gain)
{
    const double kh = fmin(k * of->depth, 300.0), s = sinh(kh),
                 p = 4.0 * s * s / (kh * (sinh(2.0 * kh) + 2.0 * kh));
    return of->open ? p + (1.0 - p) * gain : gain;
}

/* Waves that run inwards through the side are made there, others must pass. */
double complex sea_gain(const struct wave_spec *of, double omega, double k, double cosine)
{
    if (!(of->zone > 0.0))
        return 1.0;
    const struct zone_response is = response_of(of, omega, k, fabs(cosine));
    return sea_gain_open(of, k, cosine > 0.0 ? is.make : is.pass);
}

/* Gains of some frequencies and directions; of a long-crested sea the direction is one. */
struct sea_gains {
    double low, gap;
    int n; /* cosines of directions, from 0.2 to 1; long-crested: 1, that of the sea */
    double complex of[COSINES][GAINS][2]; /* to the side, from it */
};

static double cosine_of(const struct sea_gains *is, int i) { return 0.2 + 0.8 * i / (is->n - 1); }

/* Directions from cosine 0.2 to 1: waves more aslant than that hardly feel the side. `make' belongs
 * to waves that run away from it, `pass' to those that run to it (index 0), as the sign of cosine
 * tells later. */
struct sea_gains *sea_gains_create(const struct wave_spec *of, double low, double high)
{
    struct sea_gains *is = NEW(struct sea_gains, 1);
    is->low = low;
    is->gap = (high - low) / (GAINS - 1);
    is->n = of->spread > 0.0 ? COSINES : 1;
    for (int c = 0; c < is->n; c++)
        for (int i = 0; i < GAINS; i++) {
            const double omega = is->low + i * is->gap, k = waves_number(omega, of->g, of->depth),
                         cosine = is->n > 1 ? cosine_of(is, c) : fabs(of->normal[0]);
            const struct zone_response at = response_of(of, omega, k, cosine);
            is->of[c][i][0] = at.pass;
            is->of[c][i][1] = at.make;
        }
    return is;
}

/* Linear between frequencies and between cosines; below the least nothing is to be made up for. */
double complex sea_gains_at(const struct sea_gains *is, double omega, double cosine)
{
    const double at = (omega - is->low) / is->gap;
    const int i = (int)fmin(fmax(floor(at), 0.0), GAINS - 2), way = cosine > 0.0;
    double complex sum = 0.0;
    if (is->n == 1)
        return is->of[0][i][way] + (at - i) * (is->of[0][i + 1][way] - is->of[0][i][way]);
    const double turn = (fabs(cosine) - 0.2) / 0.8 * (is->n - 1);
    const int c = (int)fmin(fmax(floor(turn), 0.0), is->n - 2);
    if (turn < 0.0)
        return 1.0;
    for (int k = 0; k < 2; k++) {
        const double complex *q = &is->of[c + k][i][way];
        sum += (k ? turn - c : 1.0 - turn + c) * (q[0] + (at - i) * (q[2] - q[0]));
    }
    return sum;
}

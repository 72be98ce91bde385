/* colour.c - see colour.h. With W the kernel of support R, F(s) is its share in the half space
 * below a plane at the distance s under the point: the kernel integrated over planes, summed up
 * from the lowest. Made once at the start (colour_profile); each look-up is a bisection in the
 * table.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "colour.h"

#include <math.h>

static const double reach = 0.7; /* of R: beyond it the share says on which side, not how far */

/* Wendland C2 of support 1. */
static double kernel(int dim, double r)
{
    const double c = dim == 2 ? 7.0 / M_PI : 21.0 / (2.0 * M_PI), a = 1.0 - r;
    return r < 1.0 ? c * a * a * a * a * (1.0 + 4.0 * r) : 0.0;
}

/* Its integral over the plane (in 2D the line) that passes at z. Midpoint rule in PARTS rings (dim
 * 3) or pairs of points (dim 2). */
static double layer(int dim, double z)
{
    enum { PARTS = 200 };
    const double most = sqrt(fmax(0.0, 1.0 - z * z)), h = most / PARTS;
    double sum = 0.0;
    for (int k = 0; k < PARTS; k++) {
        const double t = (k + 0.5) * h;
        sum += h * kernel(dim, sqrt(z * z + t * t)) * (dim == 2 ? 2.0 : 2.0 * M_PI * t);
    }
    return sum;
}

/* table[k] belongs to the height s = R (2 k/COLOUR_PARTS - 1): 1 deep under the surface, 0 above
 * it. Divided by its own sum, so that the kernel's factor and the rule's error drop out. */
void colour_profile(int dim, double *table)
{
    const double h = 2.0 / COLOUR_PARTS;
    double before = 0.0;
    table[0] = 0.0;
    for (int k = 1; k <= COLOUR_PARTS; k++) {
        const double now = layer(dim, -1.0 + k * h);
        table[k] = table[k - 1] + 0.5 * h * (before + now);
        before = now;
    }
    for (int k = 0; k <= COLOUR_PARTS; k++)
        table[k] = 1.0 - table[k] / table[COLOUR_PARTS];
    table[COLOUR_PARTS] = 0.0;
}

/* The table falls throughout, so its inverse is found between two entries, linear between them.
 * Where it is flat, at its ends, the middle is as good as any place. */
double colour_height(const double *table, double R, double share)
{
    int low = 0, high = COLOUR_PARTS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(table[middle] > share ? &low : &high) = middle;
    }
    const double fall = table[low] - table[high];
    const double part = fall > 0.0 ? (table[low] - share) / fall : 0.5;
    const double s = R * (2.0 * (low + part) / COLOUR_PARTS - 1.0);
    return fmax(-reach * R, fmin(reach * R, s));
}

double colour_reach(double R) { return reach * R; }

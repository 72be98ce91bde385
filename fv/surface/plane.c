/* plane.c - see plane.h. Closed forms of Scardovelli & Zaleski (J. Comput. Phys. 164, 2000),
 * written as means along the smallest component, so that nothing is divided by what may be 0; only
 * the two cubic pieces of the inverse in 3D are iterated. SPDX-License-Identifier: BSD-3-Clause */
#include "plane.h"

#include "../../common/base/base.h"

/* Sorts the sizes of the components, smallest first, and divides them by their sum, which it
 * returns; the missing ones are 0. */
static double sorted(int dim, const double *n, double m[3])
{
    double sum = 0.0;
    m[0] = m[1] = m[2] = 0.0;
    for (int a = 0; a < dim; a++) {
        double x = fabs(n[a]);
        sum += x;
        for (int k = 2; k >= 0; k--)
            if (x > m[k]) {
                const double t = m[k];
                m[k] = x;
                x = t;
            }
    }
    for (int k = 0; k < 3 && sum > 0.0; k++)
        m[k] /= sum;
    return sum;
}

/* Area of the unit square where y y' + z z' < t, y <= z the components, 0 <= t. */
static double area(double y, double z, double t)
{
    if (t < y)
        return 0.5 * t * (t / y) / z;
    if (t < z)
        return (t - 0.5 * y) / z;
    const double rest = y + z - t;
    return rest > 0.0 ? 1.0 - 0.5 * rest * (rest / y) / z : 1.0;
}

/* Mean of the square between two places. */
static double mean_square(double p, double q) { return (p * p + p * q + q * q) / 3.0; }

/* Share of the unit cube where m.x < t, components sorted and of sum 1, 0 <= t <= 1/2: the mean of
 * the area over the places t - m[0] to t. */
static double share_sorted(const double m[3], double t)
{
    const double x = m[0], y = m[1], z = m[2], low = t - x;
    if (t <= 0.0)
        return 0.0;
    if (x == 0.0)
        return area(y, z, t);
    if (low < 0.0) /* t < x <= y */
        return t / x * (t * (t / y) / z) / 6.0;
    if (t <= y)
        return 0.5 * mean_square(low, t) / y / z;
    /* shares of the places below y, beyond z, and between: they sum to 1 whatever is rounded */
    const double beyond = t > z ? lesser(1.0, (t - z) / x) : 0.0;
    const double below = low < y ? lesser(1.0 - beyond, (y - low) / x) : 0.0;
    const double from = greater(low, y), to = lesser(t, z);
    double sum = (1.0 - beyond - below) * (0.5 * (from + to) - 0.5 * y) / z;
    if (below > 0.0)
        sum += below * 0.5 * mean_square(low, y) / y / z;
    if (beyond > 0.0)
        sum += beyond * (1.0 - 0.5 * mean_square(y, y + z - t) / y / z);
    return sum;
}

double plane_share(int dim, const double *n, double alpha)
{
    double m[3], sum = 0.0;
    for (int a = 0; a < dim; a++)
        sum += fabs(n[a]);
    if (2.0 * fabs(alpha) >= sum) /* most cells: nothing is sorted for them */
        return alpha > 0.0 || (alpha == 0.0 && sum == 0.0) ? 1.0 : 0.0;
    sorted(dim, n, m);
    const double t = 0.5 - fabs(alpha) / sum, share = share_sorted(m, t);
    return alpha > 0.0 ? 1.0 - share : share;
}

#define ROUNDING 4e-16 /* of a share */

/* t within [lo, hi] that has the share: Newton's iteration, by halves where it leaves the bracket.
 */
static double iterate(const double m[3], double share, double lo, double hi)
{
    double t = 0.5 * (lo + hi);
    for (int it = 0; it < 60; it++) {
        const double off = share_sorted(m, t) - share;
        if (fabs(off) <= ROUNDING)
            return t;
        const double low = t - m[0];
        const double slope =
            (area(m[1], m[2], t) - (low > 0.0 ? area(m[1], m[2], low) : 0.0)) / m[0];
        if (off > 0.0)
            hi = t;
        else
            lo = t;
        double next = slope > 0.0 ? t - off / slope : lo;
        if (!(next > lo && next < hi))
            next = 0.5 * (lo + hi);
        if (fabs(next - t) <= 1e-16)
            return next;
        t = next;
    }
    return t;
}

/* The inverse of share_sorted, share <= 1/2. */
static double place_sorted(const double m[3], double share)
{
    const double x = m[0], y = m[1], z = m[2];
    const double first = y > 0.0 ? x * (x / y) / z / 6.0 : 0.0; /* share at t = x */
    if (x > 0.0 && share < first)
        return cbrt(6.0 * x * y * z * share);
    /* t^2 - x t + x^2/3 = 2 y z share */
    if (y > 0.0 && share < share_sorted(m, y)) /* at most 1/2, for y <= 1/2 */
        return 0.5 * x + sqrt(greater(0.0, 2.0 * y * z * share - x * x / 12.0));
    if (x == 0.0)
        return z * share + 0.5 * y;
    const double last = lesser(x + y, z);
    if (share < share_sorted(m, last))
        return iterate(m, share, y, last);
    return x + y <= z ? z * share + 0.5 * (x + y) : iterate(m, share, last, 0.5);
}

/* The inverse of plane_share; by symmetry a share above a half is the rest's with the sign turned.
 */
double plane_alpha(int dim, const double *n, double share)
{
    double m[3];
    const double sum = sorted(dim, n, m);
    if (share <= 0.0 || share >= 1.0)
        return share <= 0.0 ? -0.5 * sum : 0.5 * sum;
    if (share <= 0.5)
        return -sum * (0.5 - place_sorted(m, share));
    return sum * (0.5 - place_sorted(m, 1.0 - share));
}

/* The slab is a box that is (hi - lo) as thick along a: the plane in its coordinates has n_a scaled
 * and alpha shifted. */
double plane_slab(int dim, const double *n, double alpha, int a, double lo, double hi)
{
    double m[3];
    for (int k = 0; k < dim; k++)
        m[k] = k == a ? n[k] * (hi - lo) : n[k];
    return (hi - lo) * plane_share(dim, m, alpha - n[a] * 0.5 * (lo + hi));
}

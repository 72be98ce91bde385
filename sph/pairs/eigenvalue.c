/* eigenvalue.c - the smallest eigenvalue of a symmetric matrix of 2 or 3 rows, in closed form. In
 * 2D half the trace less the root of the discriminant. In 3D, with q = tr M/3 and p^2 = tr (M - q
 * I)^2/6, the eigenvalues of (M - q I)/p are 2 cos(phi + 2 pi k/3), phi = arccos(det((M - q
 * I)/p)/2)/3 in [0, pi/3]; k = 1 gives the smallest. Called for particles near the surface or with
 * thin support, by the first pass (scheme_gradients.c) and by surface detection.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "eigenvalue.h"

#include <math.h>

/* Only the symmetric part of M counts: off-diagonal entries are averaged. */
double eigenvalue_smallest(const double *M, int dim)
{
    if (dim == 2) {
        const double mean = 0.5 * (M[0] + M[3]), half = 0.5 * (M[0] - M[3]);
        const double off = 0.5 * (M[1] + M[2]);
        return mean - sqrt(half * half + off * off);
    }
    /* Trigonometric form for symmetric matrices of three rows. */
    const double a = M[0], b = M[4], c = M[8];
    const double d = 0.5 * (M[1] + M[3]), e = 0.5 * (M[5] + M[7]), f = 0.5 * (M[2] + M[6]);
    const double q = (a + b + c) / 3.0, off = d * d + e * e + f * f;
    const double p2 = ((a - q) * (a - q) + (b - q) * (b - q) + (c - q) * (c - q) + 2.0 * off) / 6.0;
    /* M is a multiple of the unit matrix, up to rounding of entries of order 1: no direction to
     * look for */
    if (p2 <= 1e-28)
        return q;
    const double p = sqrt(p2), A = (a - q) / p, B = (b - q) / p, C = (c - q) / p;
    const double D = d / p, E = e / p, F = f / p;
    const double det = A * (B * C - E * E) - D * (D * C - E * F) + F * (D * E - B * F);
    /* rounding may carry the determinant beyond the range of the arccosine */
    const double half = 0.5 * det < -1.0 ? -1.0 : 0.5 * det > 1.0 ? 1.0 : 0.5 * det;
    const double phi = acos(half) / 3.0;
    return q + 2.0 * p * cos(phi + 2.0 * M_PI / 3.0);
}

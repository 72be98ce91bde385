/* face_share.h - the wet part of a face that a free surface crosses.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FACE_SHARE_H
#define FV_FACE_SHARE_H

#include "../fv.h"
#include "../surface/fv_surface.h"

/* Whether the cell c beside a face holds no water. */
static inline bool face_is_dry(const struct fv *s, int64_t c)
{
    return s->surface && s->surface->layer[c] != 0;
}

/* Whether what walls take of the flow is a pressure that is mirrored there, as psi is, which is all
 * of it with a surface; else p is extrapolated. */
static inline bool face_mirrors_pressure(const struct fv *s) { return s->surface && !s->newton; }

/* Share of a face across axis a where phi < 0, straight between its ends: phi is `middle' in its
 * centre and changes by slope[t] over the face along t. xi: middle of that share, edge: where it
 * ends, both in [0, 1] of the face's cell and left alone along a. Exact along the tangent that
 * phi changes most along, at Gauss points of the other. */
static inline double face_wet_share(int dim, int a, double middle, const double slope[3],
                                    double xi[3], double edge[3])
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    const int n = dim == 3 ? 2 : 1, one = a == 0, other = a == 2 ? 1 : 2;
    const bool turned = n == 2 && fabs(slope[other]) > fabs(slope[one]);
    const int along[2] = {turned ? other : one, turned ? one : other};
    double share = 0.0, at[2] = {0.0, 0.0}, end = 0.0;
    for (int k = 0; k < n; k++) {
        const double across = n == 2 ? gauss[k] : 0.5, first = slope[along[0]];
        const double q = middle + (n == 2 ? (across - 0.5) * slope[along[1]] : 0.0);
        const double half = 0.5 * fabs(first);
        const double own = q <= -half ? 1.0 : q >= half ? 0.0 : 0.5 - q / (2.0 * half);
        share += own / n;
        at[0] += own / n * (first > 0.0 ? 0.5 * own : 1.0 - 0.5 * own);
        at[1] += own / n * across;
        end += own / n * (first > 0.0 ? own : 1.0 - own);
    }
    for (int t = 0; t < n && share > 0.0; t++)
        edge[along[t]] = xi[along[t]] = at[t] / share;
    if (share > 0.0)
        edge[along[0]] = end / share;
    return share;
}

#endif

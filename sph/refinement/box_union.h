/* box_union.h - signed distance to the edge of a union of axis-parallel boxes, exact on both sides.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BOX_UNION_H
#define SPH_BOX_UNION_H

/* An axis-parallel box. */
struct box {
    double lo[3], hi[3]; /* m; infinite where it has no face */
};

/* A union of boxes with its complement cut into boxes: inside, the distance to the edge is that to
 * the complement, which is a union of boxes, too. */
struct box_union {
    int dim, n, nrest;
    double near;           /* m: gaps as narrow as this are closed */
    struct box *of, *rest; /* the boxes; what they leave of space, cut into boxes */
};

/* Of n boxes, which are copied; coordinates closer than `near', m, become one. The boxes, u.of,
 * belong to `owner', and the rest of space to them. */
struct box_union box_union_create(void *owner, int dim, int n, const struct box *box, double near);
/* Signed distance of x to the edge, m, positive inside; -INFINITY: there is no box, INFINITY: they
 * cover all. */
double box_union_distance(const struct box_union *u, const double *x);

#endif

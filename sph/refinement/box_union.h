/* box_union.h - signed distance to the edge of a union of axis-parallel boxes, exact on both sides.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BOX_UNION_H
#define SPH_BOX_UNION_H

struct box {
    double lo[3], hi[3]; /* m; infinite where it has no face */
};

/* Inside, the distance to the edge is that to what the boxes leave, which is a union of boxes, too.
 */
struct box_union {
    int dim, n, nrest;
    double near;           /* m: gaps as narrow as this are none */
    struct box *of, *rest; /* the boxes; what they leave of space, cut into boxes */
};

/* box is copied. Coordinates closer than `near' (m) are one. */
struct box_union box_union_create(int dim, int n, const struct box *box, double near);
void box_union_free(struct box_union *u);
/* m, positive inside; -INFINITY: no box at all, INFINITY: they leave nothing. */
double box_union_distance(const struct box_union *u, const double *x);

#endif

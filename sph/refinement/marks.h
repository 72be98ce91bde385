/* marks.h - a region made of cells of a uniform grid: marks, dilation, signed distance to the edge
 * of what is marked. All ranks hold all cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_MARKS_H
#define SPH_MARKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MARKS_DEEP = 5 };

/* The grid and its marks. Cell (i, j, k) has the number i + n[0] (j + n[1] k). Beyond a closed end
 * of the grid the marks continue as they are at it, beyond an open one there are none. Arrays are
 * owned. */
struct marks {
    int dim, n[3];
    bool periodic[3], open[6]; /* sides 2a: low, 2a + 1: high */
    double lo[3], h[3];        /* m: lower corner, widths */
    unsigned char *mark;       /* [cells] 0 or 1 */
    /* [cells] 1 .. MARKS_DEEP: distance in cells to one without mark, the last: or more; -1: beside
     * a marked one; -2: not beside one. */
    signed char *depth;
    bool any; /* some cell is marked */
};

/* Sets *c to a grid over lo .. hi, m, of cells at least `width', m, wide, without marks; false:
 * there would be more than `most' of them. The marks belong to `owner'. */
bool marks_create(void *owner, struct marks *c, int dim, const double lo[3], const double hi[3],
                  const bool periodic[3], const bool open[6], double width, double most);
size_t marks_count(const struct marks *c);
/* Number of the cell that holds x, clamped into the grid. */
size_t marks_find(const struct marks *c, const double *x);
/* Extends the marks in bits[cells] by so many cells in all directions, diagonals included. */
void marks_dilate(const struct marks *c, unsigned char *bits, int by);
/* Adds marks to the cells of c that overlap a marked one of `fine', and to `by' cells around. */
void marks_cover(struct marks *c, const struct marks *fine, int by);
/* Computes depth and any after the marks have changed. */
void marks_measure(struct marks *c);
/* Signed distance of x to the edge, m, positive in marked cells: exact where it is less than two
 * cells inside or one outside; further away a value between that and the distance. */
double marks_distance(const struct marks *c, const double *x);

#endif

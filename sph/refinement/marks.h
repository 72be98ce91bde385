/* marks.h - a region made of cells of a grid over the region of the particles: marks, cells around
 * them, signed distance to the edge of what is marked. All ranks hold all cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_MARKS_H
#define SPH_MARKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MARKS_DEEP = 5 };

/* Cell (i, j, k) has the number i + n[0] (j + n[1] k). Beyond a closed end of the grid the marks go
 * on as they are at it, beyond an open one there are none. */
struct marks {
    int dim, n[3];
    bool periodic[3], open[6]; /* sides 2a: low, 2a + 1: high */
    double lo[3], h[3];        /* m: lower corner, widths */
    unsigned char *mark;       /* [cells] 0 or 1 */
    signed char *depth;        /* [cells] 1 .. MARKS_DEEP: so many cells from one without mark, the
                                  last: or more; -1: beside one with, -2: not beside */
    bool any;                  /* some cell is marked */
};

/* Cells at least `width' wide; false: there would be more than `most' of them. */
bool marks_create(struct marks *c, int dim, const double lo[3], const double hi[3],
                  const bool periodic[3], const bool open[6], double width, double most);
void marks_free(struct marks *c);
size_t marks_count(const struct marks *c);
size_t marks_find(const struct marks *c, const double *x); /* x clamped into the grid */
/* Marks in `bits' [cells] grow by so many cells in all directions, diagonals too. */
void marks_dilate(const struct marks *c, unsigned char *bits, int by);
/* Marks those cells of c that meet a marked one of `fine', and `by' around. Adds to the marks. */
void marks_cover(struct marks *c, const struct marks *fine, int by);
/* After the marks have changed. */
void marks_measure(struct marks *c);
/* m, positive in marked cells: the distance to the edge where that is less than two cells, else no
 * more than it and no less than two; outside, with the other sign, the same with one cell. */
double marks_distance(const struct marks *c, const double *x);

#endif

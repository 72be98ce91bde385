/* extension_window.h - the cells around a dry one from which its velocity comes, and how each kind
 * of cells finds them. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_EXTENSION_WINDOW_H
#define FV_EXTENSION_WINDOW_H

#include "../../common/base/base.h"
#include "../fv.h"
#include "patterns.h"

enum { STENCIL = 128 /* 125 cells and what fills up the last lanes */ };

/* A dry cell under work: frame e[0] = normal, e[1], e[2] tangents; origin: foot point. */
struct place {
    const struct part *part;
    double e[3][3];
    double depth;            /* m: of the cell over the surface */
    int n, step[STENCIL];    /* known cells around; the last one again fills up the lanes */
    int known;               /* of them not again */
    int room;                /* how many the window could hold */
    int shift[3];            /* cells: of the window's middle from this one */
    int upright;             /* the axis, on blocks the index, that gravity is most along */
    bool mixed;              /* some of the known are other blocks' */
    double r[3][STENCIL];    /* their places in the frame, in units of h */
    double self[3], spacing; /* the cell's own; mean h (m), no axis before another */
};

struct window_ops {
    /* m: edge of a cube of the cell's volume. */
    double (*size)(const struct fv *s, int64_t c);
    /* Known cells of a window of window_reach cells on either side of its middle, moved one cell
     * into the water; p has its frame. */
    void (*look_around)(const struct fv *s, int64_t c, int layer, struct place *p);
    /* Whether weights beyond the first layer depend on patterns alone; NULL: they do not. */
    bool (*has_patterns)(const struct fv *s);
    /* The key of a cell's window but for its order, with the known cells and the room of it in p,
     * whose normal is there; and that window as look_around has it, but along the axes and about
     * the cell. */
    struct pattern_key (*pattern)(const struct fv *s, int64_t c, int layer, struct place *p);
    void (*look_along_axes)(const struct fv *s, int64_t c, int layer, const signed char *shift,
                            struct place *p);
    /* Ahead of all; NULL: nothing is to be done. */
    void (*begin)(struct fv *s);
    /* Whether a cell of this layer gets its velocity here; NULL: all do. */
    bool (*is_wanted)(const struct fv *s, int64_t c, int layer);
    /* The same, with what stands around it known; NULL: all do. */
    bool (*is_own)(const struct fv *s, int64_t c, const struct place *p);
};

extern const struct window_ops even_window, block_window;

/* Cells on either side of the middle of a cell's window. Layers further out carry phi where it is
 * made a distance again: nearer cells do for them, but where blocks overlap, whose donors they are,
 * and where the surface goes several cells a step. */
static inline int window_reach(const struct fv *s, int layer)
{
    const bool donors = grid_overlaps(&s->grid), far = s->prm.integrator != INTEGRATOR_RK3;
    return layer <= 2 || donors || far ? 2 : 1;
}

/* The last known cell again until the lanes are full. */
static inline void window_fill_lanes(struct place *p, int n)
{
    p->known = n;
    for (; n % SUM_LANES; n++) {
        p->step[n] = p->step[p->known - 1];
        for (int a = 0; a < 3; a++)
            p->r[a][n] = p->r[a][p->known - 1];
    }
    p->n = n;
    p->self[0] = p->depth / p->spacing;
    p->self[1] = p->self[2] = 0.0;
}

#endif

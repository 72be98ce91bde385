/* grid.h - the cells of a run, whatever their kind: what stands above this folder asks here for
 * their places, sizes and neighbours, and need not tell uniform cells, layers and blocks apart.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_GRID_H
#define FV_GRID_H

#include "block.h"
#include "mesh.h"

/* Views of one of the two, borrowed: a part is one of nparts, a place c one of a field's. */
struct grid {
    int dim, nparts;
    const struct part *part;
    struct block *even; /* uniform cells, or layers of unequal height; NULL: blocks */
    struct mesh *mesh;  /* blocks; NULL: even cells */
};

/* grid.c: places of cell `at' of a part. */
/* The one that stands for the cell: its centre, on blocks its centroid, behind their sides the
 * middle of its map. */
void grid_centre(const struct grid *g, const struct part *p, const int *at, double x[3]);
/* The same of the cell at place c. */
void grid_place(const struct grid *g, int64_t c, double x[3]);
/* At xi (0 to 1 along each index) within it. */
void grid_point(const struct grid *g, const struct part *p, const int *at, const double *xi,
                double x[3]);
/* Mean over its volume. */
void grid_mean_place(const struct grid *g, const struct part *p, const int *at, double x[3]);
/* m: its lengths along the indices. */
void grid_lengths(const struct grid *g, const struct part *p, const int *at, double length[3]);
/* m: sides of the box that stands for it: its own, on blocks those of a cube of its volume. */
void grid_box(const struct grid *g, const struct part *p, const int *at, double h[3]);
/* Number of the cell at place c in the whole grid, or among the cells of all blocks. */
int64_t grid_number(const struct grid *g, int64_t c);

/* The grids that make it up: one, or the blocks. Cells of one, its name in messages (NULL: there is
 * one only), place of its vertex i. */
int grid_blocks(const struct grid *g);
const int *grid_cells(const struct grid *g, int k);
const char *grid_name(const struct grid *g, int k);
void grid_vertex(const struct grid *g, int k, const int *i, double x[3]);
/* Cells of all ranks that are computed. */
double grid_computed(const struct grid *g);
/* Along axes on which ghosts are those of the other end; blocks join instead. */
const bool *grid_periodic(const struct grid *g);
/* The most cells along an index, of a part or of the whole. */
int grid_longest(const struct grid *g);
/* Why cells that move have no donors; "": they have. */
const char *grid_trouble(const struct grid *g);

/* s: the longest step from time t that motions bear, and the next time at which one starts or ends;
 * INFINITY: none moves. */
double grid_motion_step(const struct grid *g, double t);
double grid_motion_event(const struct grid *g, double t);

/* m^(dim-1): size of the lower face of place c along a; its vector along the axes. */
double grid_face_area(const struct grid *g, int64_t c, int a);
void grid_face_vector(const struct grid *g, int64_t c, int a, double S[3]);

/* Ghosts of nf fields from the cells that they stand for; grid_fill: the fringe of overlaps, too.
 */
void grid_halo(const struct grid *g, int nf, double *const *f);
void grid_fill(const struct grid *g, int nf, double *const *f);

/* The part that has place c, ghosts too, and the cell there (at: or NULL). */
static inline const struct part *grid_part(const struct grid *g, int64_t c, int *at)
{
    const struct part *p = g->part;
    while (c >= p->base + p->size)
        p++;
    if (at)
        part_index(p, c, at);
    return p;
}
/* m^dim: volume of the cell at place c. */
static inline double grid_volume(const struct grid *g, int64_t c)
{
    return g->mesh ? g->mesh->V[c]
                   : block_volume(g->even, g->even->rows ? block_row(g->even, c) : 0);
}
/* Whether the cell at place c lies wholly in a box of imposed cells, so deep that it is none. */
bool grid_is_given(const struct grid *g, int64_t c);
/* m: its height over its lower face along a. */
static inline double grid_height(const struct grid *g, int64_t c, int a)
{
    if (g->mesh)
        return g->mesh->V[c] / g->mesh->S[a][a][c];
    return block_size(g->even, a, a == 1 && g->even->rows ? block_row(g->even, c) : 0);
}
/* m^(dim-1), -: what makes a flow in m^dim/s of U of the lower face along a: even cells hold
 * velocities. */
static inline double grid_flow_area(const struct grid *g, int64_t c, int a)
{
    return g->mesh ? 1.0 : grid_face_area(g, c, a);
}
/* Whether blocks overlap; whether some move. */
static inline bool grid_overlaps(const struct grid *g) { return g->mesh && g->mesh->has_fringe; }
static inline bool grid_moves(const struct grid *g) { return g->mesh && g->mesh->moves; }
/* Whether all are. */
static inline bool grid_all_computed(const struct grid *g)
{
    return !g->mesh || !(g->mesh->has_fringe || g->mesh->has_given);
}
/* Whether the cell at place c is one that is computed, as far as the grid knows. */
static inline bool grid_is_computed(const struct grid *g, int64_t c)
{
    return !g->mesh || g->mesh->status[c] == CELL_COMPUTED;
}

#endif

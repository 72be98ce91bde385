/* grid.h - the cells of a run, whatever their kind: what stands above this folder asks here for
 * their positions, sizes and neighbours, and need not tell uniform cells, layers and blocks apart.
 * A "place" c is the index of a cell in a field, ghosts included.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "block.h"
#include "mesh.h"

/* A view of the block or the mesh of a run, which is borrowed. */
struct grid {
    int dim, nparts;
    const struct part *part; /* [nparts], those of this rank */
    struct block *even;      /* uniform cells, or layers of unequal height; NULL: blocks */
    struct mesh *mesh;       /* blocks; NULL: even cells */
};

/* grid.c: position of cell `at' of a part, m: its centre, on blocks its centroid, behind their
 * sides the centre of its map. */
void grid_centre(const struct grid *g, const struct part *p, const int *at, double x[3]);
/* The same of the cell at place c. */
void grid_place(const struct grid *g, int64_t c, double x[3]);
/* The point at xi (0 to 1 along each index) within a cell. */
void grid_point(const struct grid *g, const struct part *p, const int *at, const double *xi,
                double x[3]);
/* Mean of x over the cell's volume. */
void grid_mean_place(const struct grid *g, const struct part *p, const int *at, double x[3]);
/* The cell's lengths along the indices, m. */
void grid_lengths(const struct grid *g, const struct part *p, const int *at, double length[3]);
/* Edges of a box that stands for the cell, m: its own, on blocks those of a cube of its volume. */
void grid_box(const struct grid *g, const struct part *p, const int *at, double h[3]);
/* Number of the cell at place c in the whole grid, or among the cells of all blocks. */
int64_t grid_number(const struct grid *g, int64_t c);

/* Number of index spaces: one, or the blocks. */
int grid_blocks(const struct grid *g);
/* Cells [3] of the k-th of them; borrowed from the grid. */
const int *grid_cells(const struct grid *g, int k);
/* Its name in messages, borrowed; NULL: there is one only. */
const char *grid_name(const struct grid *g, int k);
/* Position of its vertex of indices i[3], m. */
void grid_vertex(const struct grid *g, int k, const int *i, double x[3]);
/* Number of cells of all ranks that are computed. */
double grid_computed(const struct grid *g);
/* Along which axes ghosts are copies of the other end; blocks join instead. */
const bool *grid_periodic(const struct grid *g);
/* Largest number of cells along an index, of a part or of the whole. */
int grid_longest(const struct grid *g);
/* Why cells that move have no donors; "": all have. */
const char *grid_trouble(const struct grid *g);

/* The longest step from time t that motions allow, s; INFINITY: none moves. */
double grid_motion_step(const struct grid *g, double t);
/* The next time after t at which a motion starts or ends, s; INFINITY: there is none. */
double grid_motion_event(const struct grid *g, double t);

/* Area of the lower face along a of the cell at place c, m^(dim-1). */
double grid_face_area(const struct grid *g, int64_t c, int a);
/* Its area vector, which points along the index, m^(dim-1). */
void grid_face_vector(const struct grid *g, int64_t c, int a, double S[3]);

/* Fills the ghosts of nf fields from the cells that they are copies of. Collective. */
void grid_halo(const struct grid *g, int nf, double *const *f);
/* The same and the fringe of overlaps. Collective. */
void grid_fill(const struct grid *g, int nf, double *const *f);
/* Copies the cells near water of one field to another, and the ghosts beside them: all of the
 * fields where all cells are near. */
void grid_copy_near(const struct grid *g, const double *from, double *to);
/* Clears the same of a field. */
void grid_clear_near(const struct grid *g, double *q);

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
/* Whether the cell at place c lies so deep in a box of imposed cells that it holds no values. */
bool grid_is_given(const struct grid *g, int64_t c);
/* Height of the cell over its lower face along a, m. */
static inline double grid_height(const struct grid *g, int64_t c, int a)
{
    if (g->mesh)
        return g->mesh->V[c] / grid_face_area(g, c, a);
    return block_size(g->even, a, a == 1 && g->even->rows ? block_row(g->even, c) : 0);
}
/* Factor that makes a flow in m^dim/s of U of the lower face along a: U of uniform cells is a
 * velocity, of blocks the flow itself. */
static inline double grid_flow_area(const struct grid *g, int64_t c, int a)
{
    return g->mesh ? 1.0 : grid_face_area(g, c, a);
}
/* Whether blocks overlap. */
static inline bool grid_overlaps(const struct grid *g) { return g->mesh && g->mesh->has_fringe; }
/* Whether some blocks move. */
static inline bool grid_moves(const struct grid *g) { return g->mesh && g->mesh->moves; }
/* Whether all cells are computed, as far as the grid knows: no overlap and no imposed cells. */
static inline bool grid_all_computed(const struct grid *g)
{
    return !g->mesh || !(g->mesh->has_fringe || g->mesh->has_given);
}
/* Whether the cell at place c is one that is computed, as far as the grid knows. */
static inline bool grid_is_computed(const struct grid *g, int64_t c)
{
    return !g->mesh || g->mesh->status[c] == CELL_COMPUTED;
}

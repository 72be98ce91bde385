/* grid.c - positions, sizes and faces of cells whatever their kind. Each function asks g->even
 * (uniform cells, layers) or g->mesh (blocks) and nothing else; what stands above need not. Local
 * unless it fills ghosts.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "grid.h"

#include "mesh_motion.h"

/* Indices in the whole block. */
static void cell_of(const struct part *p, const int *at, int cell[3])
{
    for (int a = 0; a < 3; a++)
        cell[a] = p->lo[a] + at[a];
}

/* Behind a block's sides the map continues, and its middle is taken. */
void grid_centre(const struct grid *g, const struct part *p, const int *at, double x[3])
{
    int cell[3];
    if (g->even) {
        block_centre(g->even, at[0], at[1], at[2], x);
        return;
    }
    const struct mesh_block *b = g->mesh->block + p->block;
    cell_of(p, at, cell);
    for (int a = 0; a < g->dim; a++)
        if (cell[a] < 0 || cell[a] >= b->n[a]) {
            const double middle[3] = {0.5, 0.5, 0.5};
            double dx[3][3];
            mesh_map_point(b, g->dim, cell, middle, x, dx);
            return;
        }
    memcpy(x, b->centre[mesh_cell(b, cell)], 3 * sizeof *x);
}

void grid_place(const struct grid *g, int64_t c, double x[3])
{
    int at[3];
    const struct part *p = grid_part(g, c, at);
    grid_centre(g, p, at, x);
}

/* xi: 0 to 1 across the cell. */
void grid_point(const struct grid *g, const struct part *p, const int *at, const double *xi,
                double x[3])
{
    double h[3], dx[3][3];
    int cell[3];
    if (g->mesh) {
        cell_of(p, at, cell);
        mesh_map_point(g->mesh->block + p->block, g->dim, cell, xi, x, dx);
        return;
    }
    block_cell(g->even, at[0], at[1], at[2], x, h);
    for (int a = 0; a < g->dim; a++)
        x[a] += (xi[a] - 0.5) * h[a];
}

/* Two Gauss points an index, weighted by the determinant: fourth order in the cell's size. */
void grid_mean_place(const struct grid *g, const struct part *p, const int *at, double x[3])
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    double whole = 0.0;
    int cell[3];
    if (g->even) {
        block_centre(g->even, at[0], at[1], at[2], x);
        return;
    }
    cell_of(p, at, cell);
    x[0] = x[1] = x[2] = 0.0;
    for (int n = 0; n < 1 << g->dim; n++) {
        const double xi[3] = {gauss[n & 1], gauss[n >> 1 & 1], gauss[n >> 2]};
        double y[3], dx[3][3];
        mesh_map_point(g->mesh->block + p->block, g->dim, cell, xi, y, dx);
        const double V = mesh_determinant(dx);
        whole += V;
        for (int c = 0; c < 3; c++)
            x[c] += V * y[c];
    }
    for (int c = 0; c < 3; c++)
        x[c] /= whole;
}

/* Lengths of the mapping's slopes in the middle of the cell. */
void grid_lengths(const struct grid *g, const struct part *p, const int *at, double length[3])
{
    double x[3], dx[3][3];
    int cell[3];
    if (g->even) {
        block_cell(g->even, at[0], at[1], at[2], x, length);
        return;
    }
    cell_of(p, at, cell);
    mesh_map_point(g->mesh->block + p->block, g->dim, cell, (double[3]){0.5, 0.5, 0.5}, x, dx);
    for (int a = 0; a < g->dim; a++)
        length[a] = vec3_length(dx[a]);
}

/* Of blocks a cube of the cell's volume. */
void grid_box(const struct grid *g, const struct part *p, const int *at, double h[3])
{
    double x[3];
    if (g->even) {
        block_cell(g->even, at[0], at[1], at[2], x, h);
        return;
    }
    h[0] = h[1] = h[2] = pow(g->mesh->V[part_at(p, at[0], at[1], at[2])], 1.0 / g->dim);
}

/* x fastest, block after block; the same on any number of ranks. */
int64_t grid_number(const struct grid *g, int64_t c)
{
    int at[3], cell[3];
    const struct part *p = grid_part(g, c, at);
    const int *n = grid_cells(g, p->block);
    int64_t first = 0;
    for (int k = 0; k < p->block; k++) {
        const int *m = grid_cells(g, k);
        first += (int64_t)m[0] * m[1] * m[2];
    }
    cell_of(p, at, cell);
    return first + cell[0] + (int64_t)n[0] * (cell[1] + (int64_t)n[1] * cell[2]);
}

/* A hole of a block that boxes of imposed cells hold. */
bool grid_is_given(const struct grid *g, int64_t c)
{
    int at[3], cell[3];
    if (!g->mesh || g->mesh->status[c] != CELL_HOLE)
        return false;
    const struct part *p = grid_part(g, c, at);
    cell_of(p, at, cell);
    const struct mesh_block *b = g->mesh->block + p->block;
    return mesh_given_holds(g->mesh, b, mesh_cell(b, cell));
}

int grid_blocks(const struct grid *g) { return g->mesh ? g->mesh->nblocks : 1; }

const int *grid_cells(const struct grid *g, int k)
{
    return g->mesh ? g->mesh->block[k].n : g->even->cells;
}

const char *grid_name(const struct grid *g, int k)
{
    return g->mesh ? g->mesh->block[k].prm->name : NULL;
}

void grid_vertex(const struct grid *g, int k, const int *i, double x[3])
{
    if (g->mesh) {
        const struct mesh_block *b = g->mesh->block + k;
        memcpy(x, b->x[mesh_vertex(b, i[0], i[1], i[2])], 3 * sizeof *x);
        return;
    }
    const struct block *b = g->even;
    for (int a = 0; a < 3; a++)
        x[a] = a == 1 && b->rows ? b->rows->edge[i[1]] : b->origin[a] + i[a] * b->h[a];
}

double grid_computed(const struct grid *g)
{
    double cells = 1.0;
    for (int a = 0; g->even && a < g->dim; a++)
        cells *= g->even->cells[a];
    return g->mesh ? (double)g->mesh->computed : cells;
}

const bool *grid_periodic(const struct grid *g)
{
    static const bool never[3] = {false, false, false};
    return g->even ? g->even->periodic : never;
}

/* On a uniform grid of all ranks together. */
int grid_longest(const struct grid *g)
{
    int most = 0;
    for (int a = 0; a < g->dim; a++) {
        for (int q = 0; q < g->nparts; q++)
            most = g->part[q].n[a] > most ? g->part[q].n[a] : most;
        most = g->even && g->even->cells[a] > most ? g->even->cells[a] : most;
    }
    return most;
}

const char *grid_trouble(const struct grid *g) { return g->mesh ? g->mesh->trouble : ""; }

/* The motion whose key block k has; NULL: none, or it moves with another block. */
static const struct mesh_motion *motion_of(const struct mesh_block *b, int k)
{
    return b[k].motion && b[k].motion->block == k ? b[k].motion : NULL;
}

/* The least over all motions; blocks that are joined share one. */
double grid_motion_step(const struct grid *g, double t)
{
    double step = INFINITY;
    for (int k = 0; g->mesh && k < g->mesh->nblocks; k++)
        if (motion_of(g->mesh->block, k))
            step = fmin(step, body_drive_step(&g->mesh->block[k].motion->drive, t));
    return step;
}

/* The next time at which some motion begins, ends or turns; INFINITY: none. */
double grid_motion_event(const struct grid *g, double t)
{
    double next = INFINITY;
    for (int k = 0; g->mesh && k < g->mesh->nblocks; k++)
        if (motion_of(g->mesh->block, k))
            next = fmin(next, body_drive_event(&g->mesh->block[k].motion->drive, t));
    return next;
}

/* |S|; of uniform cells volume over height. */
double grid_face_area(const struct grid *g, int64_t c, int a)
{
    int at[3];
    if (!g->even)
        return sqrt(mesh_area2(g->mesh, a, c));
    block_place(g->even, c, at);
    return block_volume(g->even, at[1]) / block_size(g->even, a, at[1]);
}

void grid_face_vector(const struct grid *g, int64_t c, int a, double S[3])
{
    S[0] = S[1] = S[2] = 0.0;
    if (g->even)
        S[a] = grid_face_area(g, c, a);
    for (int k = 0; g->mesh && k < g->dim; k++)
        S[k] = g->mesh->S[a][k][c];
}

void grid_halo(const struct grid *g, int nf, double *const *f)
{
    if (g->mesh)
        mesh_halo(g->mesh, nf, f);
    else
        block_halo(g->even, nf, f);
}

void grid_fill(const struct grid *g, int nf, double *const *f)
{
    if (g->mesh)
        mesh_fill(g->mesh, nf, f);
    else
        block_halo(g->even, nf, f);
}

/* to = from, or 0 if from is NULL, in the cells near water of a line and the ghosts beside them. */
static void set_line(const struct part *p, int j, int k, const double *from, double *to)
{
    const int all[2] = {0, p->n[0]};
    int ends[2];
    part_with_ghosts(p, p->near ? p->near[part_row(p, j, k)] : all, ends);
    const int64_t c = part_at(p, ends[0], j, k);
    const size_t bytes = (size_t)(ends[1] - ends[0]) * sizeof(double);
    if (from)
        memcpy(to + c, from + c, bytes);
    else
        memset(to + c, 0, bytes);
}

void grid_copy_near(const struct grid *g, const double *from, double *to)
{
    for (const struct part *p = g->part; p < g->part + g->nparts; p++)
        for (int k = -p->g[2]; k < p->n[2] + p->g[2]; k++)
            for (int j = -p->g[1]; j < p->n[1] + p->g[1]; j++)
                set_line(p, j, k, from, to);
}

void grid_clear_near(const struct grid *g, double *q) { grid_copy_near(g, NULL, q); }

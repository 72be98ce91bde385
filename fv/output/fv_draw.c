/* fv_draw.c - cells in the picture of the scene: the hole, where rows begin to grow, the sides of
 * blocks by what they are. SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../../common/run/run.h"
#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "output.h"

/* Sides where blocks meet are drawn as cells. */
static enum picture_kind kind_of(enum mesh_side side)
{
    if (side_is_wall(side))
        return side == MESH_WALL ? PICTURE_NO_SLIP : PICTURE_SLIP;
    if (side_is_end(side))
        return PICTURE_OPENING;
    return side == MESH_PERIODIC ? PICTURE_PERIODIC : PICTURE_CELLS;
}

/* The vertices of one side, in 3D those of the first layer along j. */
static void draw_side(const struct mesh_block *b, int up, int side, struct picture *p)
{
    const int along = side / 2 == 0 ? up : 0, n = b->n[along] + 1;
    double(*line)[2] = mem_new((size_t)n, sizeof *line);
    int at[3] = {0, 0, 0};
    at[side / 2] = side % 2 ? b->n[side / 2] : 0;
    for (int k = 0; k < n; k++) {
        at[along] = k;
        const double *x = b->x[mesh_vertex(b, at[0], at[1], at[2])];
        line[k][0] = x[0];
        line[k][1] = x[up];
    }
    picture_line(p, kind_of(b->side[side]), n, (const double(*)[2])line, false, false, false);
    mem_free(line);
}

/* The outline of cells lo to hi of a block as a polygon, vertex by vertex; a ring is once around
 * outside, and back inside. */
static void tell_around(const struct mesh_block *b, int up, const int lo[2], const int hi[2],
                        struct picture *p)
{
    const int first[4][2] = {{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}};
    const int way[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}},
              size[2] = {hi[0] - lo[0], hi[1] - lo[1]};
    double(*line)[2] = mem_new((size_t)(2 * (size[0] + size[1])), sizeof *line);
    int n = 0;
    for (int k = 0; k < 4; k++)
        for (int m = 0; m < size[k % 2]; m++) {
            int at[3] = {first[k][0] + m * way[k][0], 0, 0};
            at[up] = first[k][1] + m * way[k][1];
            const double *x = b->x[mesh_vertex(b, at[0], at[1], at[2])];
            line[n][0] = x[0];
            line[n++][1] = x[up];
        }
    picture_cells(p, n, (const double(*)[2])line);
    mem_free(line);
}

/* Polygons of the cells that are no holes: the whole block, or the runs of its rows of cells. */
static void tell_cells(const struct mesh_block *b, int up, struct picture *p)
{
    const int64_t cells = mesh_count(b),
                  row = mesh_cell(b, up == 1 ? (const int[]){0, 1, 0} : (const int[]){0, 0, 1});
    bool whole = true;
    for (int64_t c = 0; c < cells && whole; c++)
        whole = b->status[c] != CELL_HOLE;
    if (whole) {
        tell_around(b, up, (const int[]){0, 0}, (const int[]){b->n[0], b->n[up]}, p);
        return;
    }
    for (int j = 0; j < b->n[up]; j++)
        for (int from = 0, to; from < b->n[0]; from = to + 1) {
            const unsigned char *status = b->status + j * row;
            for (to = from; to < b->n[0] && status[to] != CELL_HOLE;)
                to++;
            if (to > from)
                tell_around(b, up, (const int[]){from, j}, (const int[]){to, j + 1}, p);
        }
}

/* Rank 0 makes the mesh for itself alone. */
static void draw_blocks(const struct run *r, const struct fv_params *prm, struct picture *p)
{
    struct run alone = *r; /* rank 0 draws */
    struct faults f = {0};
    alone.comm = MPI_COMM_SELF;
    alone.rank = 0;
    alone.size = 1;
    struct mesh *m = mesh_create(&alone, &prm->blocks, fv_hole(prm) != NULL, fv_hole(prm), &f);
    for (int k = 0; m && k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        const int up = m->dim == 3 ? 2 : 1;
        tell_cells(b, up, p);
        for (int side = 0; side < 2 * m->dim; side++)
            if (side / 2 == 0 || side / 2 == up)
                draw_side(b, up, side, p);
        picture_text(p, b->x[mesh_vertex(b, 0, 0, 0)], b->prm->name);
    }
    FREE(m);
}

/* Boxes of the particles of a coupled job. Rank 0 asks alone. */
static void draw_particles(const struct run *r, struct picture *p)
{
    struct run alone = *r;
    char names[PARAM_PROGRAMS_MAX][64];
    const int n = r->coupled ? params_programs(r->params, "sph", names) : 0;
    alone.comm = MPI_COMM_SELF;
    for (int k = 0; k < n; k++) {
        double box[2][3];
        if (!crossing_box(&alone, names[k], box))
            continue;
        for (int a = 0; a < r->scene.domain.dim; a++)
            if (!(box[1][a] > box[0][a])) {
                box[0][a] = r->scene.domain.min[a];
                box[1][a] = r->scene.domain.max[a];
            }
        picture_box(p, PICTURE_ZONE, box[0], box[1], n > 1 ? names[k] : "particles");
    }
}

/* A box that is cut out of the cells. */
static void draw_blocked(const struct blocked_params *b, int up, struct picture *p)
{
    const double line[4][2] = {{b->min[0], b->min[up]},
                               {b->max[0], b->min[up]},
                               {b->max[0], b->max[up]},
                               {b->min[0], b->max[up]}};
    picture_line(p, b->kind == WALL_SLIP ? PICTURE_SLIP : PICTURE_NO_SLIP, 4, line, true, true,
                 false);
    picture_text(p, b->min, b->name);
}

/* Called by --check --picture on rank 0. */
void fv_draw(const struct run *r, const struct fv_params *prm, struct picture *p)
{
    const struct scene_domain *d = &r->scene.domain;
    draw_particles(r, p);
    if (fv_hole(prm))
        picture_box(p, PICTURE_CELLS, prm->hole[0], prm->hole[1], "fv.hole");
    if (prm->blocks.n > 0) {
        draw_blocks(r, prm, p);
        return;
    }
    for (int k = 0; k < prm->nboxes; k++)
        draw_blocked(prm->boxes + k, d->dim - 1, p);
    if (prm->graded[1] > 0.0 && d->dim == 2) {
        const double y = prm->graded[0], line[2][2] = {{d->min[0], y}, {d->max[0], y}};
        picture_line(p, PICTURE_CELLS, 2, line, false, false, false);
        picture_text(p, (const double[]){d->min[0], y, 0.0}, "equal layers above");
    }
}

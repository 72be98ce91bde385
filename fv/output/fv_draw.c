/* fv_draw.c - cells in the picture of the scene: the hole, where rows begin to grow, the sides of
 * blocks by what they are. SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../../common/base/mem.h"
#include "../../common/scene/picture.h"
#include "../boundary/blocked.h"
#include "../grid/mesh.h"
#include "output.h"

static enum picture_kind kind_of(enum mesh_side side)
{
    switch (side) {
    case MESH_WALL:
        return PICTURE_NO_SLIP;
    case MESH_SLIP:
        return PICTURE_SLIP;
    case MESH_PERIODIC:
        return PICTURE_PERIODIC;
    case MESH_INFLOW:
    case MESH_OUTFLOW:
    case MESH_EXACT:
    case MESH_CARRIED:
        return PICTURE_OPENING;
    default:
        return PICTURE_CELLS;
    }
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
        for (int side = 0; side < 2 * m->dim; side++)
            if (side / 2 == 0 || side / 2 == up)
                draw_side(b, up, side, p);
        picture_text(p, b->x[mesh_vertex(b, 0, 0, 0)], b->prm->name);
    }
    mesh_free(&m);
}

void fv_draw(const struct run *r, const struct fv_params *prm, struct picture *p)
{
    const struct scene_domain *d = &r->scene.domain;
    if (fv_hole(prm))
        picture_box(p, PICTURE_CELLS, prm->hole[0], prm->hole[1], "fv.hole");
    if (prm->blocks.n > 0) {
        draw_blocks(r, prm, p);
        return;
    }
    for (int k = 0; k < prm->nboxes; k++) {
        const struct blocked_params *box = prm->boxes + k;
        picture_box(p, box->kind == WALL_SLIP ? PICTURE_SLIP : PICTURE_NO_SLIP, box->min, box->max,
                    box->name);
    }
    if (prm->graded[1] > 0.0 && d->dim == 2) {
        const double y = prm->graded[0], line[2][2] = {{d->min[0], y}, {d->max[0], y}};
        picture_line(p, PICTURE_CELLS, 2, line, false, false, false);
        picture_text(p, (const double[]){d->min[0], y, 0.0}, "equal layers above");
    }
}

/* fv_sides.c - physical sides, whatever the cells. Each function asks s->sides (blocks) or s->bc
 * (uniform cells) and nothing else.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fv_sides.h"

#include "blocked.h"
#include "carried.h"
#include "mesh_bc.h"

/* Of all blocks, on all ranks alike. */
unsigned sides_kinds(const struct fv *s)
{
    unsigned kinds = 0;
    for (int k = 0; k < grid_blocks(&s->grid); k++)
        for (int side = 0; side < 2 * s->dim; side++)
            kinds |= 1u << (s->sides ? s->m->block[k].side[side] : bc_kind(s, side));
    return kinds;
}

/* Some side through which the flow may come or go. */
bool sides_open(const struct fv *s)
{
    const unsigned kinds = sides_kinds(s);
    bool any = false;
    for (int k = 0; k <= MESH_LAST; k++)
        any = any || (kinds >> k & 1u && side_is_opening(k));
    return any;
}

bool sides_give_inflow(const struct fv *s)
{
    return sides_kinds(s) & 1u << MESH_INFLOW || (s->outflows && s->outflows->steady);
}

bool sides_give_pressure(const struct fv *s)
{
    return s->sides ? mesh_bc_pressure_given(s) : s->bc && s->bc->pressure_given;
}

/* Some wall that moves along itself. */
bool sides_slide(const struct fv *s)
{
    bool any = s->sides && mesh_bc_slides(s);
    for (int k = 0; s->bc && k < 6; k++)
        any = any || s->bc->slides[k];
    return any;
}

/* On blocks the other way round: ghosts at sides need the fringe and the halo first. */
void sides_velocity(const struct fv *s, enum bc_value what, double *const u[3])
{
    if (!s->sides) /* ghosts of corners go on to other ranks */
        bc_ghosts(s, what, u);
    grid_fill(&s->grid, s->dim, u);
    if (s->sides)
        mesh_bc_velocity(s, what, u);
}

void sides_fluxes(const struct fv *s, enum bc_value what, double *const U[3])
{
    if (s->sides)
        mesh_bc_fluxes(s, U);
    else
        bc_fluxes(s, what, U);
}

void sides_time(struct fv *s, double t)
{
    if (s->sides)
        mesh_bc_time(s, t);
}

void sides_visit(const struct fv *s, void (*visit)(const struct side_face *f, void *with),
                 void *with)
{
    if (s->sides)
        mesh_bc_visit(s, visit, with);
    else
        bc_visit(s, visit, with);
}

/* A face is visited from its free cell, by the rank that has it. */
void sides_visit_boxes(const struct fv *s, void (*visit)(const struct side_face *f, void *with),
                       void *with)
{
    const struct blocked *w = s->blocked;
    struct side_face f = {.part = &s->whole, .once = 1.0};
    for (f.a = 0; f.a < s->dim; f.a++)
        for (int64_t k = 0; k < w->nnear[f.a]; k++)
            for (int up = 0; up < 2; up++) {
                const struct near_box *x = w->near[f.a] + k;
                if (!x->own || x->free[up] > 0)
                    continue;
                f.kind = s->prm.boxes[x->box[up]].kind == WALL_SLIP ? MESH_SLIP : MESH_WALL;
                f.body = 1 + x->box[up];
                f.side = 2 * f.a + up;
                f.cell = x->cell;
                f.in = (up ? -1 : 1) * s->b.stride[f.a];
                f.face = up ? f.cell + s->b.stride[f.a] : f.cell;
                f.flow_area = grid_flow_area(&s->grid, f.face, f.a);
                visit(&f, with);
            }
}

/* What add_passing needs. */
struct passing {
    const struct fv *s;
    double (*share)(const struct fv *s, int64_t c, int64_t in);
    double *sums;
};

/* Openings only; in > 0 comes in. */
static void add_passing(const struct side_face *f, void *with)
{
    const struct passing *p = with;
    if (!side_is_opening(f->kind))
        return;
    const double in = (f->side % 2 ? -1.0 : 1.0) * f->flow_area * p->s->U[f->a][f->face] *
                      p->share(p->s, f->cell, f->in);
    p->sums[0] += in;
    p->sums[1] += fabs(in);
}

void sides_passing(const struct fv *s, double (*share)(const struct fv *s, int64_t c, int64_t in),
                   double sums[2])
{
    sides_visit(s, add_passing, &(struct passing){s, share, sums});
}

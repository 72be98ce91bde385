/* fv_sides.c - see fv_sides.h. SPDX-License-Identifier: BSD-3-Clause */
#include "fv_sides.h"

#include <math.h>

#include "mesh_bc.h"

/* Of side k of uniform cells. */
static enum mesh_side kind_of(const struct fv *s, int k)
{
    const enum mesh_side kind = s->bc ? s->bc->kind[k] : MESH_NONE;
    if (kind != MESH_NONE)
        return kind;
    return s->b.periodic[k / 2] ? MESH_PERIODIC : MESH_EXACT;
}

unsigned sides_kinds(const struct fv *s)
{
    unsigned kinds = 0;
    for (int k = 0; k < grid_blocks(&s->grid); k++)
        for (int side = 0; side < 2 * s->dim; side++)
            kinds |= 1u << (s->sides ? s->m->block[k].side[side] : kind_of(s, side));
    return kinds;
}

bool sides_give_pressure(const struct fv *s)
{
    return s->sides ? mesh_bc_pressure_given(s) : s->bc && s->bc->pressure_given;
}

bool sides_slide(const struct fv *s)
{
    bool any = s->sides && mesh_bc_slides(s);
    for (int k = 0; s->bc && k < 6; k++)
        any = any || s->bc->slides[k];
    return any;
}

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

struct passing {
    const struct fv *s;
    double (*share)(const struct fv *s, int64_t c);
    double *sums;
};

static void add_passing(const struct side_face *f, void *with)
{
    const struct passing *p = with;
    if (f->kind != MESH_INFLOW && f->kind != MESH_OUTFLOW && f->kind != MESH_CARRIED)
        return;
    const double in = (f->side % 2 ? -1.0 : 1.0) * f->flow_area * p->s->U[f->a][f->face] *
                      p->share(p->s, f->cell);
    p->sums[0] += in;
    p->sums[1] += fabs(in);
}

void sides_passing(const struct fv *s, double (*share)(const struct fv *s, int64_t c),
                   double sums[2])
{
    sides_visit(s, add_passing, &(struct passing){s, share, sums});
}

double sides_power(struct fv *s) { return s->sides ? mesh_bc_power(s) : bc_power(s); }

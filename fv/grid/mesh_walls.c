/* mesh_walls.c - walls and openings of the scene on the sides of blocks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "../../common/body_math.h"
#include "mesh.h"
#include "mesh_motion.h"

/* Whether all vertices of a block's side lie on a side of the domain. */
static bool lies_on(const struct scene_domain *d, const struct mesh_block *b, int dim, int side,
                    int of_domain)
{
    const int a = side / 2, axis = of_domain / 2;
    const double plane = of_domain % 2 ? d->max[axis] : d->min[axis];
    const double eps = 1e-9 * (d->max[axis] - d->min[axis]);
    int lo[3] = {0, 0, 0}, hi[3] = {b->n[0], b->n[1], dim == 3 ? b->n[2] : 0};
    lo[a] = hi[a] = side % 2 ? b->n[a] : 0;
    for (int k = lo[2]; k <= hi[2]; k++)
        for (int j = lo[1]; j <= hi[1]; j++)
            for (int i = lo[0]; i <= hi[0]; i++)
                if (fabs(b->x[mesh_vertex(b, i, j, k)][axis] - plane) > eps)
                    return false;
    return true;
}

void mesh_take_walls(const struct run *r, struct mesh *m)
{
    const struct scene *s = &r->scene;
    for (int k = 0; k < m->nblocks; k++)
        for (int side = 0; side < 2 * m->dim; side++)
            for (int w = 0; w < s->nwalls; w++) {
                struct mesh_block *b = m->block + k;
                const int of_domain = s->walls[w].side - SIDE_X_MIN;
                if (s->walls[w].side == SIDE_NONE || b->side[side] != MESH_OVERLAP ||
                    of_domain / 2 >= m->dim || !lies_on(&s->domain, b, m->dim, side, of_domain))
                    continue;
                b->wall[side] = s->walls + w;
                b->side[side] = side_of_wall(s->walls + w);
            }
}

/* 4 x (1 - x) along the tangents of the domain's side, as scene_wall.profile has it. */
static double profile_at(const struct scene_domain *d, const struct scene_wall *w, const double *x)
{
    double f = 1.0;
    for (int a = 0; w->profile && a < d->dim; a++) {
        const double y = (x[a] - d->min[a]) / (d->max[a] - d->min[a]);
        f *= a == (w->side - SIDE_X_MIN) / 2 || d->periodic[a] ? 1.0 : 4.0 * y * (1.0 - y);
    }
    return f;
}

/* Of blocks whose list says what their sides are. */
static void own_velocity(const struct run *r, const struct mesh_block *block, int side,
                         const double *x, double *w)
{
    const struct mesh_block_params *b = block->prm;
    const enum mesh_side kind = block->side[side];
    const double spin = kind == MESH_WALL && side < 2 ? b->spin[side] : 0.0;
    const bool given = b->velocity[0] != 0.0 || b->velocity[1] != 0.0 || b->velocity[2] != 0.0;
    const bool moves = kind == MESH_INFLOW || b->lid == 0 || b->lid == side + 1;
    const double *velocity =
        kind == MESH_INFLOW && !given ? r->scene.initial.velocity : b->velocity;
    for (int c = 0; c < 3; c++)
        w[c] = moves ? velocity[c] : 0.0;
    w[0] -= spin * (x[1] - b->centre[1]);
    w[1] += spin * (x[0] - b->centre[0]);
}

void mesh_side_velocity(const struct run *r, const struct mesh_block *b, int side, const double *x,
                        double *w)
{
    if (b->motion) { /* its own turns with the block */
        double made[3], rigid[3];
        mesh_motion_made(b, x, made);
        own_velocity(r, b, side, made, w);
        turn3(b->motion->now.Q, w, w);
        mesh_motion_velocity(b, x, rigid);
        vec3_add(w, 1.0, rigid);
        return;
    }
    if (!b->wall[side]) {
        own_velocity(r, b, side, x, w);
        return;
    }
    for (int c = 0; c < 3; c++)
        w[c] = b->wall[side]->velocity[c] * profile_at(&r->scene.domain, b->wall[side], x);
}

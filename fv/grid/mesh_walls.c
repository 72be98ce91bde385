/* mesh_walls.c - walls and openings of the scene on the sides of blocks.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../../common/geometry/geometry.h"
#include "mesh.h"
#include "mesh_motion.h"

/* Box around the vertices of a block's side. Real vertices only. */
static void bounds_of_side(const struct mesh_block *b, int dim, int side, double bounds[2][3])
{
    const int a = side / 2;
    int lo[3] = {0, 0, 0}, hi[3] = {b->n[0], b->n[1], dim == 3 ? b->n[2] : 0};
    lo[a] = hi[a] = side % 2 ? b->n[a] : 0;
    for (int c = 0; c < 3; c++) {
        bounds[0][c] = INFINITY;
        bounds[1][c] = -INFINITY;
    }
    for (int k = lo[2]; k <= hi[2]; k++)
        for (int j = lo[1]; j <= hi[1]; j++)
            for (int i = lo[0]; i <= hi[0]; i++)
                for (int c = 0; c < dim; c++) {
                    const double x = b->x[mesh_vertex(b, i, j, k)][c];
                    bounds[0][c] = fmin(bounds[0][c], x);
                    bounds[1][c] = fmax(bounds[1][c], x);
                }
}

/* Whether all vertices of a block's side lie on a side of the domain. To 1e-9 of the domain's
 * length. */
static bool lies_on(const struct scene_domain *d, const double bounds[2][3], int of_domain)
{
    const int axis = of_domain / 2;
    const double plane = of_domain % 2 ? d->max[axis] : d->min[axis];
    const double eps = 1e-9 * (d->max[axis] - d->min[axis]);
    return fabs(bounds[0][axis] - plane) <= eps && fabs(bounds[1][axis] - plane) <= eps;
}

/* Makes one box of two that touch or overlap along a side of the domain, by more than a corner.
 * Returns whether it has changed anything. */
static bool unite(const struct scene_domain *d, int normal, double p[2][3], double q[2][3])
{
    int touch = 0;
    bool same = true;
    for (int a = 0; a < d->dim; a++) {
        const double eps = 1e-9 * (d->max[a] - d->min[a]);
        const double common = fmin(p[1][a], q[1][a]) - fmax(p[0][a], q[0][a]);
        if (a != normal && common < -eps)
            return false;
        touch += a != normal && common <= eps;
        same = same && p[0][a] == q[0][a] && p[1][a] == q[1][a];
    }
    if (touch > 1 || same)
        return false;
    for (int a = 0; a < d->dim; a++) {
        p[0][a] = q[0][a] = fmin(p[0][a], q[0][a]);
        p[1][a] = q[1][a] = fmax(p[1][a], q[1][a]);
    }
    return true;
}

/* Until nothing changes: three blocks in a row have one opening. */
static void unite_openings(const struct scene_domain *d, struct mesh *m)
{
    const int n = 6 * m->nblocks;
    bool more = true;
    while (more) {
        more = false;
        for (int p = 0; p < n; p++)
            for (int q = 0; q < p; q++) {
                struct mesh_block *b = m->block + p / 6, *c = m->block + q / 6;
                if (b->wall[p % 6] && b->wall[p % 6] == c->wall[q % 6])
                    more |= unite(d, (b->wall[p % 6]->side - SIDE_X_MIN) / 2, b->opening[p % 6],
                                  c->opening[q % 6]);
            }
    }
}

/* A side takes the domain's wall if it has no kind of its own (MESH_OVERLAP is what is left) and
 * all its vertices lie there. on: 6 where it lies on none. */
void mesh_take_walls(const struct run *r, struct mesh *m)
{
    const struct scene *s = &r->scene;
    for (int k = 0; k < m->nblocks; k++)
        for (int side = 0; side < 2 * m->dim; side++) {
            struct mesh_block *b = m->block + k;
            bounds_of_side(b, m->dim, side, b->opening[side]);
            b->on[side] = 2 * m->dim;
            while (--b->on[side] >= 0 &&
                   !lies_on(&s->domain, (const double(*)[3])b->opening[side], b->on[side]))
                ;
            b->on[side] = b->on[side] < 0 ? 6 : b->on[side];
            for (int w = 0; w < s->nwalls; w++) {
                const int of_domain = s->walls[w].side - SIDE_X_MIN;
                if (s->walls[w].side == SIDE_NONE || b->side[side] != MESH_OVERLAP ||
                    of_domain != b->on[side])
                    continue;
                b->wall[side] = s->walls + w;
                b->side[side] = side_of_wall(s->walls + w);
            }
        }
    unite_openings(&s->domain, m);
}

/* 4 x (1 - x) along the tangents of the opening, as scene_wall.profile has it: a pipe that takes a
 * part of the domain's side has its own parabola. Periodic axes have none. */
static double profile_at(const struct scene_domain *d, const struct mesh_block *b, int side,
                         const double *x)
{
    const struct scene_wall *w = b->wall[side];
    double f = 1.0;
    for (int a = 0; w->profile && a < d->dim; a++) {
        const double *low = b->opening[side][0], *high = b->opening[side][1];
        const double y = (x[a] - low[a]) / (high[a] - low[a]);
        f *= a == (w->side - SIDE_X_MIN) / 2 || d->periodic[a] ? 1.0 : 4.0 * y * (1.0 - y);
    }
    return f;
}

/* Velocity at x of a wall or inflow that the block's own keys give: sliding walls (all, or the one
 * of `lid'), spinning ones, inflows (the initial velocity if none is given). */
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

/* Own values of blocks that move turn with them, and the rigid motion is added. */
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
        w[c] = b->wall[side]->velocity[c] * profile_at(&r->scene.domain, b, side, x);
}

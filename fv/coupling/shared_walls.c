/* shared_walls.c - see shared_walls.h. SPDX-License-Identifier: BSD-3-Clause */
#include "shared_walls.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../grid/block_walls.h"
#include "../grid/overset.h"

#define APART 0.5 /* of half a face's length: how far one wall may lie from the other */

static bool is_in(int dim, int n, const double (*box)[2][3], const double *x)
{
    for (int q = 0; q < n; q++) {
        bool inside = true;
        for (int a = 0; a < dim; a++)
            inside = inside && x[a] >= box[q][0][a] && x[a] <= box[q][1][a];
        if (inside)
            return true;
    }
    return false;
}

/* m: from x to the line from a to b. */
static double to_line(const double *a, const double *b, const double *x)
{
    const double e[2] = {b[0] - a[0], b[1] - a[1]}, L2 = e[0] * e[0] + e[1] * e[1];
    const double t =
        L2 > 0.0 ? fmax(0.0, fmin(1.0, ((x[0] - a[0]) * e[0] + (x[1] - a[1]) * e[1]) / L2)) : 0.0;
    return hypot(a[0] + t * e[0] - x[0], a[1] + t * e[1] - x[1]);
}

static double to_lines(const struct scene *c, const double *x)
{
    double least = INFINITY;
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *w = c->walls + k;
        for (int i = 0; i + !w->closed < w->points.n; i++)
            least = fmin(least, to_line(w->points.x[i], w->points.x[(i + 1) % w->points.n], x));
    }
    return least;
}

/* Whether a block computes the flow at x. */
static bool is_fluid(const struct mesh *m, const struct overset *o, const double *x)
{
    for (int k = 0; k < m->nblocks; k++) {
        int cell[3];
        double xi[3];
        if (overset_locate(m, o, k, x, cell, xi) &&
            m->block[k].status[mesh_cell(m->block + k, cell)] == CELL_COMPUTED)
            return true;
    }
    return false;
}

/* A point of the scene's lines that lies in FV's flow and on no side; false: none. */
static bool line_astray(const struct fv *s, const struct overset *o, const struct block_walls *w,
                        int n, const double (*given)[2][3], int *wall, double at[3])
{
    const struct scene *c = &s->run->scene;
    const double h = sqrt(s->m->V[part_at(s->part, 0, 0, 0)]);
    for (*wall = 0; *wall < c->nwalls; ++*wall) {
        const struct scene_wall *l = c->walls + *wall;
        for (int i = 0; i + !l->closed < l->points.n; i++) {
            const double *a = l->points.x[i], *b = l->points.x[(i + 1) % l->points.n];
            const int m = (int)ceil(2.0 * hypot(b[0] - a[0], b[1] - a[1]) / h) + 1;
            for (int k = 0; k <= m; k++) {
                struct nearest_wall near;
                for (int t = 0; t < 2; t++)
                    at[t] = a[t] + k * (b[t] - a[t]) / m;
                if (is_in(2, n, given, at) || !is_fluid(s->m, o, at))
                    continue;
                if (!block_walls_nearest(w, at, &near) || fabs(near.height) > APART * near.radius)
                    return true;
            }
        }
    }
    return false;
}

/* m: from x to the nearest side of the domain with a wall, or that is open to the air. */
static double to_sides(const struct scene *c, const double *x)
{
    double least = INFINITY;
    for (int a = 0; a < c->domain.dim; a++)
        if (!c->domain.periodic[a])
            least = fmin(least, fmin(fabs(x[a] - c->domain.min[a]), fabs(x[a] - c->domain.max[a])));
    return least;
}

/* A face of a side within what a partner computes, beside cells of the flow, that is neither a line
 * nor on the domain's sides; false: none. */
static bool side_astray(const struct fv *s, int n, const double (*box)[2][3], int *block,
                        double at[3])
{
    const struct scene *c = &s->run->scene;
    const struct mesh *m = s->m;
    for (*block = 0; *block < m->nblocks; ++*block) {
        const struct mesh_block *b = m->block + *block;
        for (int k = 0; k < 4; k++) {
            const int a = k / 2, t = 1 - a;
            if (b->side[k] == MESH_OVERLAP || b->side[k] == MESH_JOINED ||
                b->side[k] == MESH_PERIODIC)
                continue;
            for (int i = 0; i < b->n[t]; i++) {
                int cell[3] = {0, 0, 0}, v[3] = {0, 0, 0};
                cell[a] = k % 2 ? b->n[a] - 1 : 0;
                v[a] = k % 2 ? b->n[a] : 0;
                cell[t] = v[t] = i;
                const double *x0 = b->x[mesh_vertex(b, v[0], v[1], 0)];
                v[t]++;
                const double *x1 = b->x[mesh_vertex(b, v[0], v[1], 0)];
                const double far = 0.5 * APART * hypot(x1[0] - x0[0], x1[1] - x0[1]);
                for (int e = 0; e < 2; e++)
                    at[e] = 0.5 * (x0[e] + x1[e]);
                if (b->status[mesh_cell(b, cell)] != CELL_HOLE && is_in(2, n, box, at) &&
                    to_sides(c, at) > far && to_lines(c, at) > far)
                    return true;
            }
        }
    }
    return false;
}

bool shared_walls_agree(const struct fv *s, int n, const double (*given)[2][3],
                        const double (*box)[2][3], char *why, size_t size)
{
    double at[3] = {0.0, 0.0, 0.0};
    int k;
    if (s->dim == 3 || s->nparts == 0)
        return true;
    struct block_walls *walls = block_walls_create(s->m);
    struct overset *o = s->m->search ? s->m->search : overset_search(s->run, s->m);
    const bool line = line_astray(s, o, walls, n, given, &k, at);
    if (line)
        snprintf(why, size,
                 "walls.[%d].points: at (%g, %g) m it lies in cells of fv's blocks and is no side "
                 "of theirs: fv would let the flow through; make a side of a block follow it, or "
                 "enlarge sph.box",
                 k, at[0], at[1]);
    const bool side = !line && s->run->scene.nbodies == 0 && side_astray(s, n, box, &k, at);
    if (side)
        snprintf(why, size,
                 "blocks.[%d]: at (%g, %g) m its side is a wall, within sph.box, and sph has none "
                 "there: draw it in walls, as points",
                 k, at[0], at[1]);
    block_walls_free(&walls);
    if (o != s->m->search)
        overset_free(&o);
    return !line && !side;
}

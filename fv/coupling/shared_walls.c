/* shared_walls.c - whether lines of the scene and sides of blocks are the same walls, in 2D. Both
 * ways: positions along each line, half a cell apart, that lie in FV's flow must be near a side of
 * a block; faces of sides within what a partner computes must be near a line or a side of the
 * domain. Near: half of half a face's length. Once, at the start.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "shared_walls.h"

#include "../../common/scene/scene.h"
#include "../grid/fv_grid.h"

#define APART 0.5 /* of half a face's length: how far one wall may lie from the other */

/* Whether x lies in one of n boxes. */
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

/* Distance to the nearest line, m. */
static double to_lines(const struct scene *c, const double *x)
{
    double least = INFINITY;
    for (int k = 0; k < c->nwalls; k++) {
        const struct line l = line_of(&c->walls[k].points, c->walls[k].closed);
        least = fmin(least, line_distance(&l, x));
    }
    return least;
}

/* A point of the scene's lines that lies in FV's flow and on no side; false: none. *wall, at: which
 * line, and where. */
static bool line_astray(const struct fv *s, const struct overset *o, const struct block_walls *w,
                        int n, const double (*given)[2][3], int *wall, double at[3])
{
    const struct scene *c = &s->run->scene;
    const double h = sqrt(s->m->block[0].volume[0]);
    for (*wall = 0; *wall < c->nwalls; ++*wall) {
        const struct scene_wall *l = c->walls + *wall;
        for (int i = 0; i + !l->closed < l->points.n; i++) {
            const double *a = l->points.x[i], *b = l->points.x[(i + 1) % l->points.n];
            const int m = (int)ceil(2.0 * hypot(b[0] - a[0], b[1] - a[1]) / h) + 1;
            for (int k = 0; k <= m; k++) {
                struct nearest_wall near;
                int block, cell[3];
                for (int t = 0; t < 2; t++)
                    at[t] = a[t] + k * (b[t] - a[t]) / m;
                if (is_in(2, n, given, at) || !overset_computed(s->m, o, -1, at, &block, cell))
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
static bool side_astray(const struct fv *s, const struct block_walls *w, int n,
                        const double (*box)[2][3], struct wall_face *f)
{
    const struct scene *c = &s->run->scene;
    for (int64_t i = 0; block_walls_face(w, i, f); i++) {
        const struct mesh_block *b = s->m->block + f->block;
        const double far = APART * f->radius;
        if (b->status[mesh_cell(b, f->cell)] != CELL_HOLE && is_in(2, n, box, f->x) &&
            to_sides(c, f->x) > far && to_lines(c, f->x) > far)
            return true;
    }
    return false;
}

/* Meshes of 3D are not compared. */
bool shared_walls_agree(const struct fv *s, int n, const double (*given)[2][3],
                        const double (*box)[2][3], char *why, size_t size)
{
    double at[3] = {0.0, 0.0, 0.0};
    struct wall_face face;
    int k;
    if (s->dim == 3)
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
    const bool side = !line && s->run->scene.nbodies == 0 && side_astray(s, walls, n, box, &face);
    if (side)
        snprintf(why, size,
                 "blocks.[%d]: at (%g, %g) m its side is a wall, within sph.box, and sph has none "
                 "there: draw it in walls, as points",
                 face.block, face.x[0], face.x[1]);
    FREE(walls);
    if (o != s->m->search)
        FREE(o);
    return !line && !side;
}

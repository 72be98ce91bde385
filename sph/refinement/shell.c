/* shell.c - distance from the surface of a body or wall, by a search tree over triangles. A mesh of
 * the scene is searched as it is; lines of 2D are made into a strip of triangles, so that one
 * search serves 2D and 3D. The surface stays in the frame of the start and positions are brought
 * into it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "shell.h"

#include <math.h>
#include <string.h>

#include "../../common/base/base.h"
#include "../../common/geometry/geometry.h"

/* Two triangles for each segment of the line, from z = -half to half. With half = 2 reach nothing
 * within reach of z = 0 is nearest to a rim. */
static void strip(struct trimesh *m, const struct param_points *p, bool closed, double half)
{
    const int n = p->n, segments = closed ? n : n - 1;
    m->nvertices = 2 * n;
    m->ntriangles = 2 * segments;
    m->x = mem_new((size_t)m->nvertices, sizeof *m->x);
    m->vertex = mem_new((size_t)m->ntriangles, sizeof *m->vertex);
    for (int k = 0; k < 2 * n; k++) {
        memcpy(m->x[k], p->x[k % n], sizeof p->x[0]);
        m->x[k][2] = k < n ? -half : half;
    }
    for (int k = 0; k < segments; k++) {
        const int next = (k + 1) % n;
        const int two[2][3] = {{k, next, n + next}, {k, n + next, n + k}};
        memcpy(m->vertex + (ptrdiff_t)2 * k, two, sizeof two);
    }
    trimesh_connect(m);
}

/* A scene's mesh and its tree are borrowed, a strip is owned. */
struct shell shell_create(const struct scene *s, enum mesh_owner owner, int index, double reach)
{
    const bool body = owner == MESH_OF_BODY;
    const struct scene_mesh *file = scene_mesh_of(s, owner, index);
    struct shell to = {.dim = s->domain.dim};
    if (file) {
        to.tree = file->tree;
        memcpy(to.lo, file->lo, sizeof to.lo);
        memcpy(to.hi, file->hi, sizeof to.hi);
    } else {
        to.mesh = NEW(struct trimesh, 1);
        strip(to.mesh, body ? &s->bodies[index].points : &s->walls[index].points,
              body || s->walls[index].closed, 2.0 * reach);
        to.tree = tree_create(to.mesh);
        trimesh_bounds(to.mesh, to.lo, to.hi);
    }
    if (body)
        memcpy(to.centre, s->bodies[index].centre, sizeof to.centre);
    shell_move(&to, NULL);
    return to;
}

void shell_free(struct shell *s)
{
    if (s->mesh) {
        tree_free(&s->tree);
        trimesh_free(s->mesh);
        mem_free(s->mesh);
    }
    *s = (struct shell){0};
}

/* Sets displacement and rotation; NULL: as at the start. */
void shell_move(struct shell *s, const struct body_motion *now)
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            s->Q[a][b] = now ? now->Q[a][b] : a == b;
    for (int a = 0; a < 3; a++)
        s->x[a] = now ? now->x[a] : 0.0;
}

/* The box around the surface spares the search for whatever is farther than `reach'. */
double shell_distance(const struct shell *s, const double *x, double reach)
{
    double arm[3] = {0.0, 0.0, 0.0}, own[3], out = 0.0;
    for (int a = 0; a < s->dim; a++)
        arm[a] = x[a] - s->centre[a] - s->x[a];
    turn_back3((double(*)[3])s->Q, arm, own);
    for (int a = 0; a < s->dim; a++) {
        own[a] += s->centre[a];
        const double d = fmax(fmax(s->lo[a] - own[a], own[a] - s->hi[a]), 0.0);
        out += d * d;
    }
    if (out >= reach * reach)
        return sqrt(out);
    const double d = fabs(tree_nearest(s->tree, own, reach).distance);
    return d < reach ? d : reach;
}

/* wall_thin3.c - walls thinner than the support, in 3D: pairs that look through one are cut, a
 * particle feels the triangles alone that it sees, and where what it sees ends at a rim, the plane
 * through it and the rim closes its sums: the rest of the kernel lies in the wall's shadow. gamma
 * = 1 + the sum over what is seen is exact so (f (y - x) has no flux through the shadow's sides).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_list.h"

#include <math.h>
#include <string.h>

#include "../../common/base/mem.h"
#include "../../common/base/vec3.h"

bool wall_list3_any_thin(const struct walls *w)
{
    bool any = false;
    for (int k = 0; k < w->nmeshes; k++)
        any = any || w->meshes[k].thin;
    return any;
}

/* --- pairs --- */

/* Whether the segment a -> b meets a triangle (Moeller & Trumbore, J. Graphics Tools 2, 1997). */
static bool meets(const struct facet *f, const double *a, const double *b)
{
    double e[2][3], d[3], h[3], s[3], q[3];
    vec3_from(f->v[0], f->v[1], e[0]);
    vec3_from(f->v[0], f->v[2], e[1]);
    vec3_from(a, b, d);
    vec3_from(f->v[0], a, s);
    vec3_cross(d, e[1], h);
    vec3_cross(s, e[0], q);
    const double det = vec3_dot(e[0], h);
    if (det == 0.0)
        return false;
    const double u = vec3_dot(s, h) / det, v = vec3_dot(d, q) / det, t = vec3_dot(e[1], q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= 1.0;
}

/* The same answer for i, j and j, i, on every rank: the first of the two by place comes first. */
static bool is_first(const double *x, const double *y)
{
    for (int a = 0; a < 3; a++)
        if (x[a] != y[a])
            return x[a] < y[a];
    return true;
}

static bool sees(const struct sph *s, const struct wall_list *l, int k, const double *xj)
{
    const double *xi = prim_line(&s->p, l->who[k]);
    const double *const end[2] = {is_first(xi, xj) ? xi : xj, is_first(xi, xj) ? xj : xi};
    for (int j = l->first[k]; j < l->first[k + 1]; j++) {
        const struct wall_touch *t = l->touch + j;
        double own[2][3];
        if (!s->walls->meshes[t->of].thin)
            continue;
        for (int e = 0; e < 2; e++)
            wall_list3_to_own(s, t, end[e], own[e]);
        if (meets(wall_list3_facet(l, t), own[0], own[1]))
            return false;
    }
    return true;
}

static bool has_thin(const struct sph *s, const struct wall_list *l, int k)
{
    bool any = false;
    for (int j = l->first[k]; j < l->first[k + 1]; j++)
        any = any || s->walls->meshes[l->touch[j].of].thin;
    return any;
}

void wall_list3_cut(const struct sph *s, struct wall_list *l)
{
    if (!wall_list3_any_thin(s->walls))
        return;
    for (int k = 0; k < l->n; k++)
        if (has_thin(s, l, k))
            wall_list_cut_row(s, l, k, sees);
    if (l->n > l->rims_capacity) {
        GROW(l->rim, l->rims_capacity, l->n + l->n / 2);
        GROW(l->seen_from, l->rims_capacity, l->n + l->n / 2);
        l->rims_capacity = l->n + l->n / 2;
    }
    for (int k = 0; k < l->n; k++)
        memcpy(l->seen_from[k], prim_line(&s->p, l->who[k]), sizeof *l->seen_from);
    l->listed_at = s->t;
}

/* --- what is seen --- */

/* Triangles of a solid that turn their back, and those behind others, count for nothing; a sheet
 * has two faces. */
static void shade(const struct sph *s, const double *x, struct wall_touch *t)
{
    const struct wall_mesh *m = s->walls->meshes + t->of;
    double own[3], to[3], where;
    if (t->height < 0.0 && !m->mesh.closed) {
        t->height = -t->height;
        t->is.gamma = -t->is.gamma;
        for (int a = 0; a < 3; a++)
            t->n[a] = -t->n[a];
    }
    bool hidden = t->height <= 0.0;
    if (!hidden && t->is.W > 0.0) {
        for (int a = 0; a < 3; a++)
            to[a] = x[a] + t->is.e[a];
        wall_list3_to_own(s, t, x, own);
        wall_list3_to_own(s, t, to, to);
        hidden = tree_crosses(m->tree, own, to, &where) && where < 1.0 - 1e-6;
    }
    if (hidden)
        t->is = (struct wall_integrals){0};
}

/* What the plane through x and an edge has of the kernel beyond the edge, as a vector along its
 * normal, towards the triangle that is seen. */
static void add_edge(const struct facet *f, int edge, const double *x, double R, double *sum)
{
    double to[3], N[3], out[3];
    const double W = facet_rim(f, edge, x, R);
    vec3_from(x, f->v[edge], to);
    vec3_cross(to, f->t[edge], N);
    vec3_from(x, f->centre, out);
    const double size = vec3_unit(N);
    for (int a = 0; a < 3 && size > 0.0; a++)
        sum[a] += vec3_dot(N, out) > 0.0 ? W * N[a] : -W * N[a];
}

static void add_rims(const struct sph *s, const struct wall_list *l, const double *x,
                     const struct wall_touch *t, double *rim)
{
    const struct wall_mesh *m = s->walls->meshes + t->of;
    const struct facet *f = wall_list3_facet(l, t);
    const int triangle = wall_list3_triangle(l, t);
    double own[3], sum[3] = {0.0, 0.0, 0.0}, world[3], y[3];
    wall_list3_to_own(s, t, x, own);
    vec3_from(own, f->v[0], y);
    const bool front = vec3_dot(f->n, y) > 0.0;
    for (int e = 0; e < 3; e++) {
        const int other = m->mesh.neighbour[triangle][e];
        double n[3];
        if (other >= 0) {
            vec3_from(own, m->mesh.x[m->mesh.vertex[other][0]], y);
            trimesh_normal(&m->mesh, other, n);
        }
        if (other < 0 || (vec3_dot(n, y) > 0.0) != front)
            add_edge(f, e, own, s->R, sum);
    }
    wall_mesh_turn_to_world(m, sum, world);
    for (int a = 0; a < 3; a++)
        rim[a] += world[a];
}

void wall_list3_shade(const struct sph *s, struct wall_list *l)
{
    if (!wall_list3_any_thin(s->walls))
        return;
    for (int k = 0; k < l->n; k++) {
        const double *x = prim_line(&s->p, l->who[k]);
        memset(l->rim[k], 0, sizeof *l->rim);
        for (int j = l->first[k]; j < l->first[k + 1]; j++)
            if (s->walls->meshes[l->touch[j].of].thin) {
                shade(s, x, l->touch + j);
                if (l->touch[j].is.W > 0.0)
                    add_rims(s, l, x, l->touch + j, l->rim[k]);
            }
    }
}

/* --- particles that have crossed --- */

bool wall_list3_crossed(const struct sph *s, const struct wall_list *l, int k, struct wall_foot *f)
{
    const double *x = state_row(&s->p, s->p.y, l->who[k]);
    for (int mesh = 0; mesh < s->walls->nmeshes && l->rim; mesh++) {
        const struct wall_mesh *m = s->walls->meshes + mesh;
        double from[3], own[2][3], way[3], at[3], where;
        if (!m->thin)
            continue;
        wall_mesh_velocity(s->walls, m, x, f->u, NULL);
        for (int a = 0; a < 3; a++)
            from[a] = l->seen_from[k][a] + f->u[a] * (s->t - l->listed_at);
        wall_mesh_to_own(m, from, own[0]);
        wall_mesh_to_own(m, x, own[1]);
        if (!tree_crosses(m->tree, own[0], own[1], &where))
            continue;
        vec3_from(own[0], own[1], way);
        for (int a = 0; a < 3; a++)
            at[a] = own[0][a] + where * way[a];
        const struct tree_foot t = tree_nearest(m->tree, at, s->R);
        const double sign = vec3_dot(way, t.n) > 0.0 ? 1.0 : -1.0;
        wall_mesh_to_world(m, at, f->x);
        wall_mesh_turn_to_world(m, t.n, f->n);
        for (int a = 0; a < 3; a++)
            f->n[a] *= sign;
        f->body = m->body;
        return true;
    }
    return false;
}

/* wall_thin3.c - walls thinner than the support, in 3D: pairs that look through one are cut, a
 * particle interacts with the triangles alone that it sees, and where what it sees ends at an edge,
 * the plane through it and the edge closes its sums: the rest of the kernel lies in the wall's
 * shadow. gamma = 1 + the sum over what is seen is exact so (f (y - x) has no flux through the
 * shadow's sides). SPDX-License-Identifier: BSD-3-Clause */
#include "wall_list.h"

#include "wall_shadow.h"

/* --- pairs --- */

/* Whether the segment a -> b meets a triangle (Moeller & Trumbore, J. Graphics Tools 2, 1997). Few
 * do, so what lies on one side of its plane by more than rounding is not asked. */
static bool meets(const struct facet *f, const double *a, const double *b)
{
    double e[2][3], d[3], h[3], s[3], q[3], to_b[3];
    vec3_from(f->v[0], a, s);
    vec3_from(f->v[0], b, to_b);
    const double over[2] = {vec3_dot(f->n, s), vec3_dot(f->n, to_b)}, least = 1e-6 * f->longest;
    if ((over[0] > least && over[1] > least) || (over[0] < -least && over[1] < -least))
        return false;
    vec3_from(f->v[0], f->v[1], e[0]);
    vec3_from(f->v[0], f->v[2], e[1]);
    vec3_from(a, b, d);
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
    double own[2][3];
    int in = -1; /* the mesh in whose frame the ends are */
    for (int j = l->first[k]; j < l->first[k + 1]; j++) {
        const struct wall_touch *t = l->touch + j;
        if (!s->walls->meshes[t->of].thin)
            continue;
        for (int e = 0; e < 2 && t->of != in; e++)
            wall_list3_to_own(s, t, end[e], own[e]);
        in = t->of;
        if (meets(wall_list3_facet(l, t), own[0], own[1]))
            return false;
    }
    return true;
}

/* Whether the particle has a thin mesh within reach: all else needs no shading. */
static bool has_thin(const struct sph *s, const struct wall_list *l, int k)
{
    bool any = false;
    for (int j = l->first[k]; j < l->first[k + 1]; j++)
        any = any || s->walls->meshes[l->touch[j].of].thin;
    return any;
}

void wall_list3_cut(const struct sph *s, struct wall_list *l)
{
    if (!walls_any_thin(s->walls))
        return;
    for (int k = 0; k < l->n; k++)
        if (has_thin(s, l, k))
            wall_list_cut_row(s, l, k, sees);
    ROOM_IN(l->owner, l->rim, l->n);
    ROOM_IN(l->owner, l->seen_from, l->n);
    for (int k = 0; k < l->n; k++)
        memcpy(l->seen_from[k], prim_line(&s->p, l->who[k]), sizeof *l->seen_from);
    l->listed_at = s->t;
}

/* --- what is seen --- */

/* A piece of wall that hides others. */
struct thin_piece {
    struct shadow_caster is;
    int touch; /* from the particle's first */
    bool thin;
    int alike;    /* this and those after it in its plane; 0: not the first of them */
    double share; /* -: of it, what nothing hides */
};

/* Corners of a touch's triangle, as the particle at x sees it. */
static void corners_of(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                       const double *x, double (*v)[3])
{
    const struct facet *f = wall_list3_facet(l, t);
    for (int k = 0; k < 3; k++) {
        wall_mesh_to_world(s->walls->meshes + t->of, f->v[k], v[k]);
        vec3_from(x, v[k], v[k]);
    }
}

static bool is_thin(const struct sph *s, const struct wall_touch *t)
{
    return s->walls->meshes[t->of].thin;
}

/* Triangles of a thin solid that turn their back count for nothing; a sheet has two faces. */
static void turn_face(const struct sph *s, struct wall_touch *t)
{
    if (t->height < 0.0 && !s->walls->meshes[t->of].mesh.closed) {
        t->height = -t->height;
        t->is.gamma = -t->is.gamma;
        for (int a = 0; a < 3; a++)
            t->n[a] = -t->n[a];
    }
    if (t->height <= 0.0)
        t->is = (struct wall_integrals){0};
}

/* Counts the pieces in a row that lie in one plane, whose shadows begin behind it. */
static void join_alike(struct thin_piece *piece, int pieces)
{
    struct thin_piece *first = piece;
    for (struct thin_piece *c = piece; c < piece + pieces; c++) {
        if (!shadow_alike(&first->is, &c->is))
            first = c;
        c->alike = 0;
        first->alike++;
    }
}

/* The pieces within the support that show the particle their face. */
static int gather(const struct sph *s, struct wall_list *l, int k)
{
    const double *x = prim_line(&s->p, l->who[k]);
    struct wall_touch *t = l->touch + l->first[k];
    const int n = l->first[k + 1] - l->first[k];
    int pieces = 0;
    ROOM_IN(l->owner, l->piece, n);
    for (int j = 0; j < n; j++, t++) {
        double v[3][3];
        const bool thin = is_thin(s, t);
        if (thin)
            turn_face(s, t);
        if (!(t->is.W > 0.0) || !(t->height > 0.0))
            continue;
        corners_of(s, l, t, x, v);
        if (shadow_caster_of(v, &l->piece[pieces].is)) {
            l->piece[pieces].touch = j;
            l->piece[pieces].thin = thin;
            l->piece[pieces++].share = 1.0;
        } else if (thin) {
            t->is = (struct wall_integrals){0};
        }
    }
    join_alike(l->piece, pieces);
    return pieces;
}

/* Adds to *sum what the pieces, thin ones alone or all, hide of the polygon y[n] of touch j. */
static void add_hidden(const struct sph *s, const struct wall_list *l, int pieces, bool thin_alone,
                       int j, int n, double (*y)[3], struct wall_integrals *sum)
{
    for (const struct thin_piece *c = l->piece; c < l->piece + pieces; c++) {
        struct wall_integrals is = {0};
        if (c->alike > 1 && shadow_is_before(&c->is, n, y, s->R)) {
            c += c->alike - 1;
            continue;
        }
        if (c->touch == j || (thin_alone && !c->thin) || c->share == 0.0)
            continue;
        shadow_add(&c->is, n, y, s->R, &is);
        sum->gamma += c->share * is.gamma;
        sum->W += c->share * is.W;
        vec3_add(sum->e, c->share, is.e);
    }
}

/* Of thin pieces, what other thin ones do not hide: so much of a shadow is not theirs already. What
 * stands behind a solid shades nothing before it. */
static void find_shares(const struct sph *s, struct wall_list *l, int k, int pieces)
{
    const struct wall_touch *t = l->touch + l->first[k];
    for (struct thin_piece *c = l->piece; c < l->piece + pieces; c++) {
        struct wall_integrals sum = {0};
        if (!c->thin)
            continue;
        const double before = c->share;
        add_hidden(s, l, pieces, true, c->touch, 3, c->is.v, &sum);
        l->shown[c - l->piece] = fmax(0.0, before - sum.W / t[c->touch].is.W);
    }
    for (int m = 0; m < pieces; m++)
        if (l->piece[m].thin)
            l->piece[m].share = l->shown[m] > 1e-9 ? l->shown[m] : 0.0;
}

/* Takes from a touch what is hidden of it. */
static void take_hidden(const struct sph *s, const struct wall_list *l, int k, int pieces, int j)
{
    struct wall_touch *t = l->touch + l->first[k] + j;
    struct wall_integrals sum = {0};
    double v[3][3];
    corners_of(s, l, t, prim_line(&s->p, l->who[k]), v);
    add_hidden(s, l, pieces, !is_thin(s, t), j, 3, v, &sum);
    if (sum.W == 0.0)
        return;
    const double W = t->is.W - sum.W, turned = t->is.gamma * sum.gamma < 0.0 ? -1.0 : 1.0;
    t->is.gamma -= turned * sum.gamma;
    for (int a = 0; a < 3; a++)
        t->is.e[a] = (t->is.W * t->is.e[a] - sum.e[a]) / W;
    t->is.W = W;
    if (!(W * s->R > 1e-9)) {
        t->is = (struct wall_integrals){0};
        t->foot = false;
    }
}

/* What the plane through x and an edge has of the kernel beyond the edge and sees, as a vector
 * along its normal, towards the triangle that is seen. */
static void add_edge(const struct sph *s, const struct wall_list *l, int pieces,
                     const struct thin_piece *c, double W, int edge, double *sum)
{
    const double *a = c->is.v[edge], *b = c->is.v[(edge + 1) % 3], *o = c->is.v[(edge + 2) % 3];
    struct wall_integrals hidden = {0};
    double N[3], y[4][3];
    vec3_cross(a, b, N);
    const double size = vec3_unit(N);
    if (!(size > 0.0) || W == 0.0)
        return;
    shadow_beyond(a, b, s->R, y);
    add_hidden(s, l, pieces, false, c->touch, 4, y, &hidden);
    W = fmax(0.0, W - hidden.W);
    vec3_add(sum, vec3_dot(N, o) > 0.0 ? W : -W, N);
}

/* Edges without a neighbour are rims; so are those whose neighbour shows its other face: seen from
 * x the sheet ends there. */
static void add_rims(const struct sph *s, const struct wall_list *l, int k, int pieces,
                     const struct thin_piece *c, double *rim)
{
    const struct wall_touch *t = l->touch + l->first[k] + c->touch;
    const struct wall_mesh *m = s->walls->meshes + t->of;
    const struct facet *f = wall_list3_facet(l, t);
    const int triangle = wall_list3_triangle(l, t);
    double own[3], y[3];
    wall_list3_to_own(s, t, prim_line(&s->p, l->who[k]), own);
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
            add_edge(s, l, pieces, c, facet_rim(f, e, own, s->R), e, rim);
    }
}

/* In this order: shares of thin pieces need all pieces, rims need the shares, and what is taken
 * from touches last still has the weights that both were measured by. */
static void shade(const struct sph *s, struct wall_list *l, int k)
{
    const int n = l->first[k + 1] - l->first[k], pieces = gather(s, l, k);
    ROOM_IN(l->owner, l->shown, n);
    find_shares(s, l, k, pieces);
    for (const struct thin_piece *c = l->piece; c < l->piece + pieces; c++)
        if (c->thin && c->share > 0.0)
            add_rims(s, l, k, pieces, c, l->rim[k]);
    for (int j = 0; j < n; j++)
        if (l->touch[l->first[k] + j].is.W > 0.0)
            take_hidden(s, l, k, pieces, j);
}

void wall_list3_shade(const struct sph *s, struct wall_list *l)
{
    if (!walls_any_thin(s->walls))
        return;
    for (int k = 0; k < l->n; k++) {
        memset(l->rim[k], 0, sizeof *l->rim);
        if (has_thin(s, l, k))
            shade(s, l, k);
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

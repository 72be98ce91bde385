/* wall_list3.c - particles near walls of triangles: cells of particles ask the tree of each mesh in
 * its own frame, once a step; see wall_list.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_list.h"

#include "wall_share.h"

/* What is known of a mesh: frames of the triangles that some particle has seen. */
struct wall_frames {
    int n;
    struct facet *facet;
    int *triangle;  /* [n] which it is */
    double *behind; /* [n] -: the kernel's part behind its owner's faces, around its middle; -1: not
                       asked for yet */
    int *slot;      /* [ntriangles] place in facet; -1: not seen yet */
};

static void create_frames(const struct sph *s, struct wall_list *l)
{
    const struct walls *w = s->walls;
    l->of3 = NEW_IN(l->owner, struct wall_frames, w->nmeshes);
    for (int k = 0; k < w->nmeshes; k++) {
        const struct wall_mesh *m = w->meshes + k;
        struct wall_frames *f = l->of3 + k;
        f->slot = NEW_IN(l->of3, int, m->mesh.ntriangles);
        memset(f->slot, -1, (size_t)m->mesh.ntriangles * sizeof *f->slot);
    }
}

const struct facet *wall_list3_facet(const struct wall_list *l, const struct wall_touch *t)
{
    return l->of3[t->of].facet + t->piece;
}

int wall_list3_triangle(const struct wall_list *l, const struct wall_touch *t)
{
    return l->of3[t->of].triangle[t->piece];
}

void wall_list3_to_own(const struct sph *s, const struct wall_touch *t, const double *x,
                       double *own)
{
    wall_mesh_to_own(s->walls->meshes + t->of, x, own);
}

static int frame_of(struct wall_frames *f, const struct wall_mesh *m, int triangle)
{
    if (f->slot[triangle] >= 0)
        return f->slot[triangle];
    ROOM_IN(f->slot, f->facet, f->n + 1);
    ROOM_IN(f->slot, f->triangle, f->n + 1);
    ROOM_IN(f->slot, f->behind, f->n + 1);
    const int *v = m->mesh.vertex[triangle];
    f->triangle[f->n] = triangle;
    f->behind[f->n] = -1.0;
    f->facet[f->n] = facet_of(m->mesh.x[v[0]], m->mesh.x[v[1]], m->mesh.x[v[2]]);
    return f->slot[triangle] = f->n++;
}

/* Particles one after another that fit a box of the reach: as a rule those of a cell. */
struct group {
    int begin, end;
    double lo[3], hi[3];
};

static struct group next_group(const struct sph *s, int begin, double edge)
{
    struct group g = {.begin = begin, .end = begin};
    for (; g.end < s->p.n; g.end++) {
        const double *x = prim_line(&s->p, g.end);
        double lo[3], hi[3];
        for (int a = 0; a < 3; a++) {
            lo[a] = g.end == begin ? x[a] : fmin(g.lo[a], x[a]);
            hi[a] = g.end == begin ? x[a] : fmax(g.hi[a], x[a]);
            if (hi[a] - lo[a] > edge)
                return g;
        }
        memcpy(g.lo, lo, sizeof lo);
        memcpy(g.hi, hi, sizeof hi);
    }
    return g;
}

/* Adds the triangles of a mesh near the group's box; returns their number. */
static int ask_tree(const struct sph *s, struct wall_list *l, const struct group *g, int mesh,
                    double reach, int n)
{
    const struct wall_mesh *m = s->walls->meshes + mesh;
    double middle[3], own[3], lo[3], hi[3];
    for (int a = 0; a < 3; a++)
        middle[a] = 0.5 * (g->lo[a] + g->hi[a]);
    wall_mesh_to_own(m, middle, own);
    for (int a = 0; a < 3; a++) {
        double half = reach;
        for (int b = 0; b < 3; b++)
            half += 0.5 * fabs(m->Q[b][a]) * (g->hi[b] - g->lo[b]);
        lo[a] = own[a] - half;
        hi[a] = own[a] + half;
    }
    int found = tree_box(m->tree, lo, hi, l->found_capacity, l->found);
    if (found > l->found_capacity) {
        GROW_IN(l->owner, l->found, l->found_capacity, 2 * found);
        l->found_capacity = 2 * found;
        found = tree_box(m->tree, lo, hi, l->found_capacity, l->found);
    }
    ROOM_IN(l->owner, l->near, n + found);
    for (int k = 0; k < found; k++)
        l->near[n++] = (struct wall_near){mesh, frame_of(l->of3 + mesh, m, l->found[k])};
    return n;
}

static int find_near(const struct sph *s, struct wall_list *l, const struct group *g, double reach)
{
    int n = 0;
    for (int mesh = 0; mesh < s->walls->nmeshes; mesh++)
        n = ask_tree(s, l, g, mesh, reach, n);
    return n;
}

static bool is_near(const struct facet *f, const double *x, double reach)
{
    double height = 0.0, away2 = 0.0, foot[3];
    const double most = reach + f->radius;
    for (int a = 0; a < 3; a++) {
        height += f->n[a] * (f->centre[a] - x[a]);
        away2 += (f->centre[a] - x[a]) * (f->centre[a] - x[a]);
    }
    return fabs(height) < reach && away2 < most * most && facet_nearest(f, x, foot) < reach;
}

/* Touches of one particle among what is near its group; returns their number with those before. */
static int touch(const struct sph *s, struct wall_list *l, int i, int nnear, double reach,
                 int touches)
{
    double own[3] = {0.0, 0.0, 0.0};
    wall_list_room(l, touches + nnear);
    for (int k = 0; k < nnear; k++) {
        const struct wall_near *q = l->near + k;
        const struct wall_mesh *m = s->walls->meshes + q->mesh;
        if (k == 0 || q->mesh != q[-1].mesh)
            wall_mesh_to_own(m, prim_line(&s->p, i), own);
        if (is_near(l->of3[q->mesh].facet + q->facet, own, reach))
            l->touch[touches++] = (struct wall_touch){
                .piece = q->facet,
                .of = q->mesh,
                .on = -1,
                .plane = m->plane ? m->plane[l->of3[q->mesh].triangle[q->facet]] : -1,
                .body = m->body,
                .friction = m->friction,
                .no_slip = m->no_slip};
    }
    return touches;
}

void wall_list3_build(const struct sph *s, struct wall_list *l)
{
    const double reach = s->R + s->lists.skin + s->walls->speed * s->step.dt_most;
    int touches = 0;
    if (!l->of3)
        create_frames(s, l);
    l->n = 0;
    wall_list_room(l, 0);
    for (struct group g = {0}; g.begin < s->p.n; g.begin = g.end) {
        g = next_group(s, g.begin, s->R + s->lists.skin);
        const int nnear = find_near(s, l, &g, reach);
        for (int i = g.begin; i < g.end && nnear > 0; i++) {
            const int before = touches;
            touches = touch(s, l, i, nnear, reach, touches);
            if (touches == before)
                continue;
            wall_list_room(l, touches);
            l->who[l->n] = i;
            l->first[l->n++] = before;
        }
    }
    l->first[l->n] = touches;
    wall_list3_cut(s, l);
}

/* The quadratures that the thesis compares, in place of the closed form; gamma stays. The clipped
 * one has SQUARES along each side of what the support has of a plane. */
static void by_quadrature(const struct sph *s, struct wall_list *l)
{
    enum { SQUARES = 6 };
    for (int k = 0; k < l->n; k++)
        for (int j = l->first[k]; j < l->first[k + 1]; j++) {
            struct wall_touch *t = l->touch + j;
            double own[3];
            wall_list3_to_own(s, t, prim_line(&s->p, l->who[k]), own);
            if (s->prm.wall_integrals == INTEGRALS_CLIPPED)
                facet_clip(wall_list3_facet(l, t), own, s->R, SQUARES, &t->is);
            else
                facet_centroid(wall_list3_facet(l, t), own, s->R, &t->is);
        }
}

/* Integrals from the mesh's frame into the world's. */
static void finish(const struct wall_mesh *m, const struct facet *f, double R, struct wall_touch *t)
{
    double e[3];
    wall_mesh_turn_to_world(m, f->n, t->n);
    if (!(t->is.W * R > 1e-13)) /* of the last digits, at the rim of the support */
        t->is.W = 0.0;
    for (int a = 0; a < 3; a++)
        e[a] = t->is.W > 0.0 ? t->is.e[a] / t->is.W : 0.0;
    wall_mesh_turn_to_world(m, e, t->is.e);
}

void wall_list3_measure(const struct sph *s, struct wall_list *l)
{
    struct facet_batch batch; /* 20 KB: not cleared */
    batch.n = 0;
    double own[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < l->n; k++)
        for (int j = l->first[k]; j < l->first[k + 1]; j++) {
            struct wall_touch *t = l->touch + j;
            const struct wall_mesh *m = s->walls->meshes + t->of;
            if (j == l->first[k] || t->of != t[-1].of)
                wall_mesh_to_own(m, prim_line(&s->p, l->who[k]), own);
            t->is = (struct wall_integrals){0};
            const struct facet_place at =
                facet_ask(&batch, wall_list3_facet(l, t), own, s->R, &t->is);
            t->height = at.height;
            t->distance = at.distance;
            t->foot = at.foot;
        }
    facet_finish(&batch);
    if (s->prm.wall_integrals != INTEGRALS_CLOSED)
        by_quadrature(s, l);
    for (struct wall_touch *t = l->touch; t < l->touch + l->first[l->n]; t++)
        finish(s->walls->meshes + t->of, wall_list3_facet(l, t), s->R, t);
    wall_list3_shade(s, l);
}

double wall_list3_weight(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                         const double *x, double R)
{
    struct facet_batch batch; /* 20 KB: not cleared */
    batch.n = 0;
    struct wall_integrals sum = {0};
    double own[3];
    wall_mesh_to_own(s->walls->meshes + t->of, x, own);
    facet_ask(&batch, wall_list3_facet(l, t), own, R, &sum);
    facet_finish(&batch);
    return sum.W;
}

bool wall_list3_reaches(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                        const double *x)
{
    double own[3], on[3];
    wall_mesh_to_own(s->walls->meshes + t->of, x, own);
    return facet_nearest(wall_list3_facet(l, t), own, on) < s->R;
}

/* Whether the points of a face are all in a triangle that is small against the support, as on what
 * is curved and finely cut: not joined with others of its plane, and nothing lies on anything
 * there. */
static bool is_small(const struct sph *s, const struct wall_list *l, int k, int face)
{
    const struct wall_touch *t = l->touch + face;
    bool alone = wall_list3_facet(l, t)->longest < 0.5 * s->R;
    for (int j = l->first[k]; j < l->first[k + 1] && alone; j++) {
        const struct wall_touch *o = l->touch + j;
        alone = o->on < 0 && !(o->joined && o->of == t->of && o->plane == t->plane);
    }
    return alone;
}

/* What the face's owner has behind it, of the triangle's middle, which stays the same: asked for at
 * each point it is that of a hundred triangles, a dozen times a particle and stage. */
static double share_behind(const struct sph *s, struct wall_list *l, const struct wall_touch *t)
{
    const struct facet *f = wall_list3_facet(l, t);
    double *behind = l->of3[t->of].behind + t->piece, x[3];
    if (*behind < 0.0) {
        for (int a = 0; a < 3; a++)
            x[a] = f->centre[a] - 1e-4 * s->R * f->n[a];
        *behind = wall_share_in_frame(s, t->of, x);
    }
    return *behind;
}

void wall_list3_shares(const struct sph *s, struct wall_list *l, int k, int face, const double *x)
{
    struct facet_batch batch; /* 20 KB: not cleared */
    batch.n = 0;
    double own[3] = {0.0, 0.0, 0.0};
    const int first = l->first[k], n = l->first[k + 1] - first, body = l->touch[face].body;
    const bool small = is_small(s, l, k, face);
    for (int j = 0; j < n; j++) {
        const struct wall_touch *t = l->touch + first + j;
        l->asked[j] = (struct wall_integrals){0};
        if (j == 0 || t->of != t[-1].of)
            wall_mesh_to_own(s->walls->meshes + t->of, x, own);
        if (small && t->body == body)
            continue;
        facet_ask(&batch, wall_list3_facet(l, t), own, s->R, l->asked + j);
    }
    facet_finish(&batch);
    for (int j = 0; j < n; j++)
        l->share[j] = l->asked[j].gamma;
    if (small)
        l->share[face - first] = -share_behind(s, l, l->touch + face);
}

double wall_list3_nearest(const struct sph *s, const struct wall_list *l,
                          const struct wall_touch *t, const double *x, double *foot)
{
    const struct wall_mesh *m = s->walls->meshes + t->of;
    double own[3], on[3];
    wall_mesh_to_own(m, x, own);
    const double d = facet_nearest(wall_list3_facet(l, t), own, on);
    wall_mesh_to_world(m, on, foot);
    return d;
}

/* Those that were far from all walls at the last stage are not behind one now. */
int wall_list3_behind(const struct sph *s, const struct wall_list *l, int *who)
{
    int n = 0;
    for (int k = 0; k < l->n; k++) {
        double least = INFINITY;
        int mesh;
        for (int j = l->first[k]; j < l->first[k + 1]; j++)
            least = fmin(least, l->touch[j].distance);
        if (least > 0.5 * s->dx)
            continue;
        const struct tree_foot f =
            wall_meshes_nearest(s->walls, state_row(&s->p, s->p.y, l->who[k]), s->R, &mesh);
        if (mesh >= 0 && !s->walls->meshes[mesh].thin && f.distance < 0.0 && !f.rim)
            who[n++] = l->who[k];
    }
    return n;
}

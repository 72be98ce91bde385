/* wall_mesh.c - walls of triangles: where their meshes come from and where they are now; see
 * walls.h. SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include "../../common/files/files.h"
#include "../../common/scene/scene.h"
#include "../particles/sph_particles.h"
#include "wall_cover3.h"

void wall_mesh_turn_to_own(const struct wall_mesh *m, const double *v, double *own)
{
    for (int a = 0; a < 3; a++)
        own[a] = m->Q[0][a] * v[0] + m->Q[1][a] * v[1] + m->Q[2][a] * v[2];
}

void wall_mesh_turn_to_world(const struct wall_mesh *m, const double *own, double *v)
{
    for (int a = 0; a < 3; a++)
        v[a] = vec3_dot(m->Q[a], own);
}

void wall_mesh_to_own(const struct wall_mesh *m, const double *x, double *own)
{
    double d[3];
    vec3_from(m->X, x, d);
    wall_mesh_turn_to_own(m, d, own);
}

void wall_mesh_to_world(const struct wall_mesh *m, const double *own, double *x)
{
    double d[3];
    wall_mesh_turn_to_world(m, own, d);
    for (int a = 0; a < 3; a++)
        x[a] = m->X[a] + d[a];
}

/* Velocity of rigid motion, u + omega x d; its time derivative has the angular acceleration and the
 * centripetal part omega x (omega x d). */
void wall_mesh_velocity(const struct walls *w, const struct wall_mesh *m, const double *x,
                        double *u, double *du)
{
    memcpy(u, m->u, sizeof m->u);
    if (du)
        memset(du, 0, 3 * sizeof *du);
    if (m->body < 0)
        return;
    const struct body *b = w->bodies + m->body;
    const struct body_motion *now = &b->now;
    double d[3], v[3], turned[3], inward[3];
    for (int a = 0; a < 3; a++)
        d[a] = x[a] - m->shift[a] - b->centre[a] - now->x[a];
    vec3_cross(now->omega, d, v);
    vec3_cross(now->domega, d, turned);
    vec3_cross(now->omega, v, inward);
    for (int a = 0; a < 3; a++) {
        u[a] = now->u[a] + v[a];
        if (du)
            du[a] = now->du[a] + turned[a] + inward[a];
    }
}

/* X is the image of the mesh's own origin: x = centre + motion + Q (own - centre) + shift. */
void wall_meshes_move(struct walls *w)
{
    for (int k = 0; k < w->nmeshes; k++) {
        struct wall_mesh *m = w->meshes + k;
        double turned[3];
        if (m->body < 0)
            continue;
        const struct body *b = w->bodies + m->body;
        memcpy(m->Q, b->now.Q, sizeof m->Q);
        wall_mesh_turn_to_world(m, b->centre, turned);
        for (int a = 0; a < 3; a++)
            m->X[a] = b->centre[a] + b->now.x[a] + m->shift[a] - turned[a];
    }
}

/* Whether foot f is a better answer than the best so far. */
static bool is_nearer(const struct tree_foot *f, const struct tree_foot *best)
{
    const double r = fabs(f->distance), least = fabs(best->distance);
    if (best->triangle < 0 || r < least * (1.0 - 1e-12))
        return true;
    return r <= least * (1.0 + 1e-12) && best->rim && !f->rim;
}

bool walls_any_thin(const struct walls *w)
{
    bool any = false;
    for (int k = 0; k < w->nmeshes; k++)
        any = any || w->meshes[k].thin;
    return any;
}

struct tree_foot wall_mesh_nearest(const struct wall_mesh *m, const double *own, double reach)
{
    const struct tree_foot f = tree_nearest(m->tree, own, reach);
    return m->thin && !m->mesh.closed ? tree_foot_of_sheet(f) : f;
}

struct tree_foot wall_meshes_nearest(const struct walls *w, const double *x, double reach,
                                     int *mesh)
{
    struct tree_foot best = {.distance = INFINITY, .triangle = -1};
    *mesh = -1;
    for (int k = 0; k < w->nmeshes; k++) {
        const struct wall_mesh *m = w->meshes + k;
        double own[3], foot[3], n[3];
        wall_mesh_to_own(m, x, own);
        struct tree_foot f =
            wall_mesh_nearest(m, own, fmin(reach, fabs(best.distance) * (1.0 + 1e-12)));
        if (f.triangle < 0 || !is_nearer(&f, &best))
            continue;
        wall_mesh_to_world(m, f.foot, foot);
        wall_mesh_turn_to_world(m, f.n, n);
        memcpy(f.foot, foot, sizeof foot);
        memcpy(f.n, n, sizeof n);
        best = f;
        *mesh = k;
    }
    return best;
}

/* --- meshes across periods --- */

/* Keeps what lies between lo and hi, m, of a mesh, and makes a tree of its own of it. */
static void clip(struct wall_mesh *m, const double *lo, const double *hi)
{
    struct trimesh cut = trimesh_within(&m->mesh, lo, hi);
    if (!m->lent)
        trimesh_free(&m->mesh);
    m->mesh = cut;
    m->lent = false;
}

/* Copies of the triangles within 2.5 R of a periodic side go on beyond the other one, and join
 * those that end there. A mesh that spans the period keeps what lies within it. */
static void repeat(const struct sph *s, struct wall_mesh *m, int axis)
{
    const double reach = 2.5 * s->R, L = s->hi[axis] - s->lo[axis], near = 1e-6 * L;
    double lo[3], hi[3], from[3] = {-INFINITY, -INFINITY, -INFINITY},
                         to[3] = {INFINITY, INFINITY, INFINITY};
    trimesh_bounds(&m->mesh, lo, hi);
    if (lo[axis] > s->lo[axis] + reach && hi[axis] < s->hi[axis] - reach)
        return;
    from[axis] = s->lo[axis];
    to[axis] = s->hi[axis];
    if (hi[axis] - lo[axis] > L + near)
        clip(m, from, to);
    const int n = m->mesh.ntriangles;
    struct trimesh copy = trimesh_copy(&m->mesh), all = trimesh_copy(&m->mesh);
    for (int way = -1; way <= 1; way += 2) {
        copy.ntriangles = 0;
        for (int t = 0; t < n; t++) {
            double least = INFINITY, most = -INFINITY;
            for (int k = 0; k < 3; k++) {
                least = fmin(least, m->mesh.x[m->mesh.vertex[t][k]][axis]);
                most = fmax(most, m->mesh.x[m->mesh.vertex[t][k]][axis]);
            }
            if (way > 0 ? least < s->lo[axis] + reach : most > s->hi[axis] - reach)
                memcpy(copy.vertex[copy.ntriangles++], m->mesh.vertex[t], sizeof *copy.vertex);
        }
        for (int v = 0; v < copy.nvertices; v++)
            copy.x[v][axis] = m->mesh.x[v][axis] + way * L;
        trimesh_append(&all, &copy);
    }
    trimesh_free(&copy);
    trimesh_weld(&all, near);
    trimesh_trim(&all);
    trimesh_connect(&all);
    if (!m->lent)
        trimesh_free(&m->mesh);
    m->mesh = all;
    m->lent = false; /* a tree of its own is made of it */
}

/* Frees what the scene has not lent. */
static void free_own(struct wall_mesh *m)
{
    if (m->lent)
        return;
    DROP(m->tree);
    trimesh_free(&m->mesh);
}

/* --- sides of the domain --- */

/* A side is 2 axis + (1 if it is the upper one). A region that ends before it has no wall there. */
static bool is_wall_side(const struct sph *s, int side)
{
    return scene_side_is_wall(&s->run->scene, SIDE_X_MIN + side) &&
           sph_params_reaches(&s->run->scene.domain, &s->prm, side);
}

/* Meshes at rest that cover parts of sides, with their images across periods. */
struct wall_covers {
    int n;
    struct wall_mesh of[WALLS_MAX];
    const struct tree *tree[WALLS_MAX];
};

/* What moves covers nothing for good, and thin meshes have fluid on both sides. */
static void find_covers(const struct sph *s, struct wall_covers *to)
{
    const struct scene *c = &s->run->scene;
    for (int k = 0; c->meshes && k < c->meshes->n; k++) {
        const struct scene_mesh *is = c->meshes->of + k;
        struct wall_mesh *m = to->of + to->n;
        if (is->owner != MESH_OF_WALL || c->walls[is->index].thin)
            continue;
        *m = (struct wall_mesh){.mesh = is->mesh, .tree = is->tree, .lent = true};
        for (int a = 0; a < 3; a++)
            if (s->periodic[a])
                repeat(s, m, a);
        m->tree = m->lent ? m->tree : tree_create(&m->mesh);
        to->tree[to->n++] = m->tree;
    }
}

/* The rectangle of a side, normal out, to the corners where walls meet, else 2.5 R beyond; but for
 * what meshes at rest cover. */
static struct trimesh triangles_of(const struct sph *s, int side, const struct wall_covers *by)
{
    struct cover_side is = {.axis = side / 2, .high = side % 2};
    for (int a = 0; a < 3; a++) {
        is.lo[a] = s->lo[a] - (is_wall_side(s, 2 * a) ? 0.0 : 2.5 * s->R);
        is.hi[a] = s->hi[a] + (is_wall_side(s, 2 * a + 1) ? 0.0 : 2.5 * s->R);
    }
    is.at = is.high ? s->hi[is.axis] : s->lo[is.axis];
    return wall_cover_side(&is, by->n, by->tree, s->dx);
}

/* At rest, in the frame of the world. The array may move: no pointer into it outlives this call. */
static struct wall_mesh *add_mesh(struct walls *w)
{
    GROW_IN(w, w->meshes, w->nmeshes, w->nmeshes + 1);
    struct wall_mesh *m = w->meshes + w->nmeshes++;
    *m = (struct wall_mesh){.body = -1};
    for (int a = 0; a < 3; a++)
        m->Q[a][a] = 1.0;
    return m;
}

/* Sides alike share a mesh, so that the edges where they meet are no rims. */
static void add_sides(struct sph *s, struct walls *w)
{
    bool done[6] = {false};
    struct wall_covers by = {.n = 0};
    find_covers(s, &by);
    for (int side = 0; side < 6; side++) {
        if (done[side] || !is_wall_side(s, side))
            continue;
        const struct scene_wall *is =
            scene_wall_of(&s->run->scene, (enum scene_side)(SIDE_X_MIN + side));
        struct wall_mesh *m = add_mesh(w);
        m->no_slip = is->kind == WALL_NO_SLIP;
        m->friction = is->friction;
        memcpy(m->u, is->velocity, sizeof m->u);
        for (int other = side; other < 6; other++) {
            const struct scene_wall *q =
                scene_wall_of(&s->run->scene, (enum scene_side)(SIDE_X_MIN + other));
            if (done[other] || !is_wall_side(s, other) || q->kind != is->kind ||
                q->friction != is->friction ||
                memcmp(q->velocity, is->velocity, sizeof q->velocity))
                continue;
            struct trimesh more = triangles_of(s, other, &by);
            trimesh_append(&m->mesh, &more);
            trimesh_free(&more);
            done[other] = true;
        }
        trimesh_weld(&m->mesh, 1e-9 * s->R);
        trimesh_connect(&m->mesh);
    }
    for (int k = 0; k < by.n; k++)
        free_own(by.of + k);
}

/* A side is one plane, however it is cut. */
static int *planes_of_sides(const struct trimesh *m)
{
    int *plane = NEW(int, m->ntriangles);
    for (int t = 0; t < m->ntriangles; t++) {
        double n[3];
        trimesh_normal(m, t, n);
        for (int a = 0; a < 3; a++)
            plane[t] = fabs(n[a]) > 0.5 ? 2 * a + (n[a] > 0.0) : plane[t];
    }
    return plane;
}

/* Whether a triangle lies within `near' of an end of the box, or beyond it. */
static bool is_beyond(const struct trimesh *m, int triangle, const double *lo, const double *hi,
                      double near)
{
    for (int a = 0; a < 3; a++) {
        double least = INFINITY, most = -INFINITY;
        for (int k = 0; k < 3; k++) {
            least = fmin(least, m->x[m->vertex[triangle][k]][a]);
            most = fmax(most, m->x[m->vertex[triangle][k]][a]);
        }
        if (least < lo[a] - near || most > hi[a] + near || most < lo[a] + near ||
            least > hi[a] - near)
            return true;
    }
    return false;
}

/* A mesh at rest ends where a side of the domain is a wall: what it has beyond, or back to back
 * with the side, acts on none. */
static void end_at_sides(const struct sph *s, struct wall_mesh *m)
{
    const double near = 0.1 * s->dx, nearest = 1e-6 * s->dx;
    double lo[3], hi[3];
    bool beyond = false;
    for (int a = 0; a < 3; a++) {
        lo[a] = is_wall_side(s, 2 * a) ? s->lo[a] + nearest : -INFINITY;
        hi[a] = is_wall_side(s, 2 * a + 1) ? s->hi[a] - nearest : INFINITY;
    }
    for (int t = 0; t < m->mesh.ntriangles && !beyond; t++)
        beyond = is_beyond(&m->mesh, t, lo, hi, near);
    if (!beyond)
        return;
    clip(m, lo, hi);
}

/* Meshes of files, which the scene keeps. */
static void add_lent(struct sph *s, struct walls *w)
{
    const struct scene *c = &s->run->scene;
    for (int k = 0; c->meshes && k < c->meshes->n; k++) {
        const struct scene_mesh *is = c->meshes->of + k;
        if (is->owner == MESH_OF_SHAPE)
            continue;
        struct wall_mesh *m = add_mesh(w);
        const bool body = is->owner == MESH_OF_BODY;
        m->mesh = is->mesh;
        m->tree = is->tree;
        m->lent = true;
        m->of = is;
        m->body = body ? is->index : -1;
        m->no_slip = (body ? c->bodies[is->index].kind : c->walls[is->index].kind) == WALL_NO_SLIP;
        m->thin = scene_mesh_thin(c, is);
        m->friction = body ? 0.0 : c->walls[is->index].friction;
        if (!body)
            memcpy(m->u, c->walls[is->index].velocity, sizeof m->u);
        for (int a = 0; a < 3 && !body; a++)
            if (s->periodic[a])
                repeat(s, m, a);
        if (!body && !m->thin)
            end_at_sides(s, m);
    }
}

/* Bodies stand beyond a periodic side, too, where particles on the other side may meet them; near
 * the edge of two periods images have images. */
static void add_images(const struct sph *s, struct walls *w)
{
    for (int a = 0; a < 3; a++) {
        const int n = w->nmeshes;
        for (int k = 0; k < n && s->periodic[a]; k++)
            for (int way = -1; way <= 1; way += 2) {
                const struct wall_mesh *m = w->meshes + k;
                if (m->body < 0 ||
                    !walls_want_image(s, w->bodies[m->body].moves, m->of->lo[a] + m->shift[a],
                                      m->of->hi[a] + m->shift[a], a, way))
                    continue;
                struct wall_mesh copy = *m;
                copy.image = true;
                copy.shift[a] = way * (s->hi[a] - s->lo[a]);
                *add_mesh(w) = copy;
            }
    }
}

void wall_meshes_create(struct sph *s, struct walls *w)
{
    if (s->dim < 3 || s->prm.walls != WALLS_NFM)
        return;
    add_sides(s, w);
    add_lent(s, w);
    add_images(s, w);
    for (int k = 0; k < w->nmeshes; k++) { /* trees point at their meshes: the list has its place */
        struct wall_mesh *m = w->meshes + k;
        if (!m->lent)
            m->tree = tree_create(&m->mesh);
        if (!m->thin)
            m->plane = m->of ? trimesh_planes(&m->mesh) : planes_of_sides(&m->mesh);
    }
}

void wall_meshes_free(struct walls *w)
{
    for (int k = 0; k < w->nmeshes; k++) {
        mem_free(w->meshes[k].plane);
        free_own(w->meshes + k);
    }
}

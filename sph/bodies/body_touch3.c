/* body_touch3.c - vertices of one surface of triangles against another: flat faces meet at the
 * vertices of one of them. Not seen: two edges that cross. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/geometry/geometry.h"
#include "body_touch.h"

/* By the sphere around the centre that holds the body. */
static bool is_near(const struct walls *w, int body, const double *x, double more)
{
    const struct body *b = w->bodies + body;
    double d[3];
    for (int a = 0; a < 3; a++)
        d[a] = x[a] - body_centre(b, a);
    return vec3_length(d) < b->reach + more;
}

/* Distance of x from a mesh within 4 gaps, with the normal out of it; INFINITY: it has none. */
static double nearest(const struct wall_mesh *m, const double *x, double gap, double *out)
{
    double own[3], foot[3];
    wall_mesh_to_own(m, x, own);
    const struct tree_foot f = wall_mesh_nearest(m, own, 4.0 * gap);
    if (f.triangle < 0 || f.rim)
        return INFINITY;
    wall_mesh_to_world(m, f.foot, foot);
    wall_mesh_turn_to_world(m, f.n, out); /* into what is touched */
    for (int a = 0; a < 3; a++)
        out[a] = fabs(f.distance) > 1e-9 * gap ? (x[a] - foot[a]) / f.distance : -out[a];
    return f.distance;
}

/* The same of vertex k of a mesh, x in the world. */
static double nearest_of_vertex(const struct wall_mesh *of, int k, const struct wall_mesh *m,
                                const double *x, double gap, double *out)
{
    const double d = nearest(m, x, gap, out);
    double way[3], y[3], beside[3];
    if (!(fabs(d) < TOUCH_FLUSH * gap))
        return d;
    const struct tree_foot own = tree_nearest(of->tree, of->mesh.x[k], gap);
    if (own.rim)
        return d;
    wall_mesh_turn_to_world(of, own.n, way);
    for (int a = 0; a < 3; a++) {
        way[a] *= TOUCH_FLUSH * gap;
        y[a] = x[a] + way[a];
    }
    const double e = nearest(m, y, gap, beside);
    return touch_settle(d, way, e, beside, out);
}

double touch_distance3(const struct walls *w, int body, const double *x, double reach,
                       double out[3])
{
    double least = INFINITY;
    for (int j = 0; j < w->nmeshes; j++) {
        const struct wall_mesh *m = w->meshes + j;
        double own[3], n[3];
        if (m->body != body)
            continue;
        wall_mesh_to_own(m, x, own);
        const struct tree_foot f = wall_mesh_nearest(m, own, reach);
        if (f.triangle < 0 || f.rim || !(f.distance < least))
            continue;
        least = f.distance;
        wall_mesh_turn_to_world(m, f.n, n); /* into what is there */
        for (int a = 0; a < 3; a++)
            out[a] = -n[a];
    }
    return least;
}

/* Whether the surface turns by more than 30 degrees at a vertex: its normal is the mean of those of
 * its triangles. */
static bool is_sharp(const struct wall_mesh *of, int k)
{
    const double cosine = 0.966;
    double n[3];
    const struct tree_foot f = tree_nearest(of->tree, of->mesh.x[k], 1.0);
    return f.triangle >= 0 && trimesh_normal(&of->mesh, f.triangle, n) > 0.0 &&
           vec3_dot(f.n, n) < cosine;
}

/* Vertices are tested in the world, for the two meshes have frames of their own. */
static void find_vertices(const struct walls *w, struct pair *p, double gap, bool mine)
{
    const int of = mine ? p->a : p->b, against = mine ? p->b : p->a;
    for (int i = 0; i < w->nmeshes; i++) {
        const struct wall_mesh *m = w->meshes + i;
        for (int k = 0; m->body == of && !m->image && k < m->mesh.nvertices; k++) {
            double x[3], y[3]; /* beside a and b */
            wall_mesh_to_world(m, m->mesh.x[k], x);
            vec3_add(x, mine ? 0.0 : 1.0, p->shift);
            pair_beside(p, x, y, 3);
            if (!is_near(w, p->a, x, gap) || (p->b >= 0 && !is_near(w, p->b, y, gap)))
                continue;
            for (int j = 0; j < w->nmeshes; j++) {
                struct touch t = {.mine = mine, .of = w->nmeshes * i + j, .corner = k};
                if (w->meshes[j].body != against || w->meshes[j].image)
                    continue;
                t.depth = gap - nearest_of_vertex(m, k, w->meshes + j, mine ? y : x, gap, t.out);
                if (!(t.depth > 0.0) || pair_is_held(w, p, x, gap))
                    continue;
                memcpy(t.x, x, sizeof t.x);
                t.sharp = is_sharp(m, k);
                pair_add(w, p, &t);
            }
        }
    }
}

/* Whether anything of b comes within the sphere around a. */
static bool any_near(const struct walls *w, const struct pair *p, double gap)
{
    const struct body *a = w->bodies + p->a;
    bool any = false;
    for (int j = 0; j < w->nmeshes && !any; j++) {
        const struct wall_mesh *m = w->meshes + j;
        const double centre[3] = {body_centre(a, 0), body_centre(a, 1), body_centre(a, 2)};
        double own[3], beside[3];
        if (m->body != p->b || m->image)
            continue;
        pair_beside(p, centre, beside, 3);
        wall_mesh_to_own(m, beside, own);
        any = tree_nearest(m->tree, own, a->reach + gap).triangle >= 0;
    }
    return any;
}

void pair_find3(const struct walls *w, struct pair *p, double gap)
{
    if (!any_near(w, p, gap))
        return;
    find_vertices(w, p, gap, true);
    find_vertices(w, p, gap, false);
}

/* rims.c - see rims.h. SPDX-License-Identifier: BSD-3-Clause */
#include "rims.h"

#include "../../common/scene/scene.h"
#include "../walls/sph_walls.h"
#include "rooms.h"

/* m: x lies inside the domain, off its sides. */
static bool is_inside(const struct sph *s, const double *x, double off)
{
    const struct scene_domain *d = &s->run->scene.domain;
    for (int a = 0; a < 3; a++)
        if (x[a] < d->min[a] + off || x[a] > d->max[a] - off)
            return false;
    return true;
}

/* An edge that lies on another mesh is closed by it. */
static bool is_on_other(const struct sph *s, int mesh, const double *x)
{
    for (int k = 0; k < s->walls->nmeshes; k++) {
        double own[3];
        wall_mesh_to_own(s->walls->meshes + k, x, own);
        if (k != mesh && tree_nearest(s->walls->meshes[k].tree, own, 0.1 * s->dx).triangle >= 0)
            return true;
    }
    return false;
}

/* Whether a first particle within 1.25 dx of x sees y. */
static bool is_wet(const struct sph *s, const struct lattice *l, const double *x, const double *y)
{
    int at[3];
    for (int a = 0; a < 3; a++)
        at[a] = (int)floor((x[a] - l->origin[a]) / l->dx);
    for (int k = 0; k < 27; k++) {
        const int ic[3] = {at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1};
        double c[3], way[3];
        if (ic[0] < 0 || ic[1] < 0 || ic[2] < 0 || ic[0] >= l->n[0] || ic[1] >= l->n[1] ||
            ic[2] >= l->n[2] || !lattice_has(l, lattice_cell(l, ic)))
            continue;
        lattice_centre(l, ic, 3, c);
        vec3_from(x, c, way);
        if (vec3_length(way) < 1.25 * s->dx && !rooms_crossed(s, c, y))
            return true;
    }
    return false;
}

/* Whether beyond the point x of an edge, that way, the mesh leaves a gap of dx that is wet, or that
 * water before the edge falls into. */
static bool is_open_at(const struct sph *s, const struct lattice *l, int mesh, const double *x,
                       const double *out)
{
    const bool falls = vec3_dot(out, s->gravity) > 0.0;
    double from[3], beyond[3];
    for (int a = 0; a < 3; a++) {
        from[a] = x[a] + 0.01 * s->dx * out[a];
        beyond[a] = x[a] + s->dx * out[a];
    }
    return is_inside(s, x, 0.5 * s->dx) && is_inside(s, beyond, 0.0) && !is_on_other(s, mesh, x) &&
           !rooms_crossed(s, from, beyond) && rooms_distance(s, beyond, s->dx) > 0.5 * s->dx &&
           (is_wet(s, l, beyond, beyond) || (falls && is_wet(s, l, x, beyond)));
}

/* The edge from corner e of a triangle on: its first point that is open, at. */
static bool find_open(const struct sph *s, const struct lattice *l, int mesh, int t, int e,
                      double *at)
{
    const struct wall_mesh *m = s->walls->meshes + mesh;
    const int *v = m->mesh.vertex[t];
    double a[3], b[3], along[3], n[3], own[3], out[3];
    wall_mesh_to_world(m, m->mesh.x[v[e]], a);
    wall_mesh_to_world(m, m->mesh.x[v[(e + 1) % 3]], b);
    trimesh_normal(&m->mesh, t, own);
    wall_mesh_turn_to_world(m, own, n);
    vec3_from(a, b, along);
    const double length = vec3_unit(along);
    const int points = 1 + (int)(length / s->dx);
    vec3_cross(along, n, out);
    for (int k = 0; k < points; k++) {
        for (int c = 0; c < 3; c++)
            at[c] = a[c] + (k + 0.5) / points * length * along[c];
        if (is_open_at(s, l, mesh, at, out))
            return true;
    }
    return false;
}

/* Meshes of bodies and those that are closed or thin have no edge that matters. */
void rims_check(const struct sph *s, const struct lattice *l)
{
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        for (int t = 0; m->of && !m->thin && !m->mesh.closed && t < m->mesh.ntriangles; t++)
            for (int e = 0; e < 3; e++) {
                double x[3];
                if (m->mesh.neighbour[t][e] < 0 && find_open(s, l, k, t, e, x))
                    fail_with(RUN_INPUT,
                              "mesh %s ends in the water at (%g, %g, %g) m, with an opening of "
                              "more than sph.dx beyond: what comes round its edge finds no wall on "
                              "the back. Give it thin = true, close it, or extend it to a side or "
                              "beyond the domain",
                              m->of->name, x[0], x[1], x[2]);
            }
    }
}

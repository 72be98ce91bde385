/* scene_mesh_read.c - meshes of a scene from their files: placed, mended, turned to the side of the
 * fluid. Rank 0 reads and mends, all ranks get the result. SPDX-License-Identifier: BSD-3-Clause */
#include <ctype.h>

#include "../geometry/geometry.h"
#include "exact.h"
#include "scene_cut.h"
#include "scene_fluid.h"
#include "scene_forms.h"
#include "scene_mesh.h"

struct reading {
    struct scene *s;
    const char *case_dir;
    const struct params *p;
    MPI_Comm comm;
    struct faults *f;
    int rank;
};

/* Name of the file without folder and ending, or of the body; with a number if it is taken. */
static void set_name(const struct scene *s, struct scene_mesh *m, const struct scene_surface *is)
{
    const char *slash = strrchr(is->mesh, '/'), *from = slash ? slash + 1 : is->mesh;
    if (m->owner == MESH_OF_BODY)
        from = s->bodies[m->index].name;
    int n = 0, same = 0;
    for (; from[n] && from[n] != '.' && n < 48; n++)
        m->name[n] = isalnum((unsigned char)from[n]) ? from[n] : '_';
    for (int k = 0; k < s->meshes->n; k++)
        same += strncmp(s->meshes->of[k].name, m->name, (size_t)n) == 0;
    if (same > 0)
        snprintf(m->name + n, sizeof m->name - (size_t)n, "_%d", same + 1);
}

/* Rodrigues' formula: v turned about the axis r by |r| degrees. */
static void rotate(const double *r, double *v)
{
    const double degrees = vec3_length(r), angle = degrees * M_PI / 180.0;
    double axis[3] = {r[0], r[1], r[2]}, across[3], sum[3];
    if (vec3_unit(axis) == 0.0)
        return;
    vec3_cross(axis, v, across);
    const double along = vec3_dot(axis, v) * (1.0 - cos(angle));
    for (int a = 0; a < 3; a++)
        sum[a] = v[a] * cos(angle) + across[a] * sin(angle) + axis[a] * along;
    memcpy(v, sum, sizeof sum);
}

/* m: of its bounding box, the measure of its size. */
static double diagonal(const struct trimesh *m)
{
    double lo[3], hi[3], d[3];
    trimesh_bounds(m, lo, hi);
    vec3_from(lo, hi, d);
    return vec3_length(d);
}

/* Whether the file's numbers still tell its vertices apart. */
static bool is_near_origin(const struct trimesh *m, double *far)
{
    double lo[3], hi[3];
    trimesh_bounds(m, lo, hi);
    *far = 0.0;
    for (int a = 0; a < 3; a++)
        *far = fmax(*far, fmax(fabs(lo[a]), fabs(hi[a])));
    return *far <= 1e4 * diagonal(m);
}

/* The triangles as the file or the form has them; false: why. */
static bool take(const struct reading *r, const struct scene_mesh *m,
                 const struct scene_surface *is, struct trimesh *t, char *why, size_t size)
{
    if (!*is->mesh) {
        *t = scene_form_mesh(r->s->bodies + m->index, r->s->facet);
        return true;
    }
    return trimesh_read(case_path(r->case_dir, is->mesh), t, why, size);
}

/* On rank 0: from the file or the form to a connected mesh in its place; false: why. */
static bool prepare(const struct reading *r, const struct scene_surface *is, struct scene_mesh *m,
                    char *why, size_t size)
{
    struct trimesh *t = &m->mesh;
    double far;
    if (!take(r, m, is, t, why, size))
        return false;
    if (*is->mesh && !is_near_origin(t, &far)) {
        snprintf(why, size,
                 "its coordinates reach %g and it is %g across: files of triangles keep 7 digits, "
                 "too few for that. Shift it to the origin before it is exported, and back by "
                 "translate",
                 far, diagonal(t));
        return false;
    }
    for (int v = 0; v < t->nvertices; v++) {
        for (int a = 0; a < 3; a++)
            t->x[v][a] *= is->scale;
        rotate(is->rotate, t->x[v]);
        for (int a = 0; a < 3; a++)
            t->x[v][a] += is->translate[a];
    }
    const double size_of = diagonal(t);
    m->welded = trimesh_weld(t, is->weld > 0.0 ? is->weld : 1e-6 * size_of);
    m->flat = trimesh_drop_flat(t, 1e-9 * size_of);
    if (t->ntriangles == 0) {
        snprintf(why, size, "all its triangles are flat%s",
                 is->weld > 0.0 ? " once vertices closer than weld are one: lower it" : "");
        return false;
    }
    trimesh_trim(t);
    trimesh_connect(t);
    m->reversed = trimesh_orient(t);
    if (m->owner == MESH_OF_BODY)
        r->s->bodies[m->index].cut = scene_cut_mesh(r->s, r->s->bodies + m->index, t);
    return true;
}

/* A triangle with an open edge, for the message. */
static int first_rim(const struct trimesh *m)
{
    int t = 0;
    while (t < m->ntriangles - 1 && m->neighbour[t][0] >= 0 && m->neighbour[t][1] >= 0 &&
           m->neighbour[t][2] >= 0)
        t++;
    return t;
}

/* What a surface must be for its owner; false after a fault. */
static bool is_sound(const struct reading *r, const struct scene_mesh *m, const char *file)
{
    const struct trimesh *t = &m->mesh;
    const int at = first_rim(t);
    double x[3];
    trimesh_middle(t, at, x);
    if (t->clashes > 0)
        params_fault(r->p, r->f, m->key,
                     "%s: a surface with one side only (Moebius): its normals cannot all point to "
                     "one. Make two surfaces of it",
                     file);
    else if (!t->closed && m->owner != MESH_OF_WALL)
        params_fault(r->p, r->f, m->key,
                     "%s: a %s must be closed, and %d edges have one triangle only, the first of "
                     "part %d at triangle %d, (%g, %g, %g) m. Close its holes; cracks close by a "
                     "larger weld",
                     file, m->owner == MESH_OF_BODY ? "body" : "shape", t->rims + t->junctions,
                     t->part[at] + 1, at + 1, x[0], x[1], x[2]);
    else
        return true;
    return false;
}

/* --- which side --- */

/* Share of the fluid of the shapes that a closed surface holds; none: nan. */
static double share_inside(const struct scene *s, const struct scene_mesh *m)
{
    enum { N = 24 };
    const struct exact e = exact_create(s);
    int wet = 0, in = 0;
    for (int k = 0; k < N * N * N; k++) {
        const int i[3] = {k % N, k / N % N, k / N / N};
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = s->domain.min[a] + (i[a] + 0.5) / N * (s->domain.max[a] - s->domain.min[a]);
        if (!scene_is_fluid(s, &e, x, NULL))
            continue;
        wet++;
        in += scene_mesh_holds(m, x);
    }
    return (double)in / wet;
}

/* Other walls or open sides bound the fluid outside of a closed surface. */
static bool is_bounded(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nwalls; k++)
        any = any || s->walls[k].side != SIDE_NONE;
    for (int a = 0; a < 3; a++)
        any = any || s->domain.periodic[a];
    return any;
}

/* A tank holds its fluid, an obstacle has it around. Where the shapes have fluid on either side it
 * is an obstacle in a basin, or a tank whose shapes go on beyond it. */
static int side_of_closed(const struct scene *s, const struct scene_mesh *m)
{
    const double in = share_inside(s, m);
    return in < 0.02 || (in <= 0.98 && is_bounded(s)) ? FLUID_OUTSIDE : FLUID_INSIDE;
}

/* A body is a tank as in the plane (scene_lines.h). */
static int side_of_body(struct scene *s, const struct scene_mesh *m)
{
    bool *tank = &s->bodies[m->index].tank;
    *tank = s->nwalls == 0 && s->nshapes > 0 && share_inside(s, m) == 1.0;
    return *tank ? FLUID_INSIDE : FLUID_OUTSIDE;
}

/* Parts of the area with fluid close by before the normals' tails and before their heads. */
static void wet_sides(const struct scene *s, const struct scene_mesh *m, double share[2])
{
    const struct exact e = exact_create(s);
    const struct trimesh *t = &m->mesh;
    const int stride = 1 + t->ntriangles / 4000;
    const double off = 1e-4 * diagonal(t);
    share[0] = share[1] = 0.0;
    for (int i = 0; i < t->ntriangles; i += stride)
        for (int head = 0; head < 2; head++) {
            double x[3], n[3];
            const double area = trimesh_normal(t, i, n);
            bool in = true;
            trimesh_middle(t, i, x);
            for (int a = 0; a < 3; a++) {
                x[a] += head ? off * n[a] : -off * n[a];
                in = in && x[a] > s->domain.min[a] && x[a] < s->domain.max[a];
            }
            share[head] += in && scene_is_fluid(s, &e, x, NULL) ? area : 0.0;
        }
}

/* The side that an open surface of this volume and planeness has its fluid on. */
static int side_of_open(double volume, double plane)
{
    return plane > 0.5 ? FLUID_SHEET : volume > 0.0 ? FLUID_INSIDE : FLUID_OUTSIDE;
}

/* Whether the normals of an open surface, which should point out of the fluid, point into it. Where
 * the shapes have fluid on one side only, that says it; else the side that the case names; else
 * gravity: fluid stands on a sheet, in what is open above, around what is open below. */
static bool is_turned(const struct reading *r, const struct scene_mesh *m)
{
    const int wanted = r->s->walls[m->index].fluid_side;
    double share[2], volume, n[3], g[3];
    const double plane = trimesh_openness(&m->mesh, &volume, n);
    wet_sides(r->s, m, share);
    if (share[0] < 0.5 * share[1] || share[1] < 0.5 * share[0])
        return share[0] < share[1];
    if (wanted == FLUID_SHEET)
        return false;
    if (wanted != FLUID_AUTO && plane <= 0.5)
        return wanted != side_of_open(volume, plane);
    const double size = scene_still_gravity(r->s, g);
    return vec3_dot(n, g) < -0.05 * size;
}

/* The normals of an open surface are those of the file, flipped or turned. */
static void orient_open(const struct reading *r, struct scene_mesh *m)
{
    const struct scene_wall *w = r->s->walls + m->index;
    double volume, n[3];
    if (w->flip)
        trimesh_turn(&m->mesh, -1);
    m->turned = !params_given(r->p, key_text("walls.[%d].flip", m->index)) && is_turned(r, m);
    if (m->turned)
        trimesh_turn(&m->mesh, -1);
    const double plane = trimesh_openness(&m->mesh, &volume, n);
    m->fluid_side = w->fluid_side != FLUID_AUTO ? w->fluid_side : side_of_open(volume, plane);
}

/* Which side the fluid is on is asked of a tree whose normals point out of the mesh's inside; only
 * then are they turned away from the fluid. */
static void orient(const struct reading *r, struct scene_mesh *m)
{
    if (m->mesh.closed)
        m->parts = trimesh_orient_closed(&m->mesh, 1);
    if (!m->mesh.closed) {
        orient_open(r, m);
    } else if (m->owner == MESH_OF_SHAPE) {
        m->fluid_side = FLUID_INSIDE;
    } else {
        const int wanted = m->owner == MESH_OF_WALL ? r->s->walls[m->index].fluid_side : FLUID_AUTO;
        m->fluid_side = FLUID_INSIDE;
        m->tree = tree_create(&m->mesh);
        m->fluid_side = m->owner == MESH_OF_BODY ? side_of_body(r->s, m)
                        : wanted == FLUID_INSIDE || wanted == FLUID_OUTSIDE
                            ? wanted
                            : side_of_closed(r->s, m);
        DROP(m->tree);
    }
    if (m->mesh.closed && m->fluid_side == FLUID_OUTSIDE)
        trimesh_orient_closed(&m->mesh, -1);
    m->tree = tree_create(&m->mesh);
}

/* A wall at rest that moves along itself: across it would pump. */
static void check_pumping(const struct reading *r, const struct scene_mesh *m)
{
    const struct scene_wall *w = r->s->walls + m->index;
    const double size = vec3_length(w->velocity);
    double most = 0.0;
    for (int t = 0; t < m->mesh.ntriangles && size > 0.0; t++) {
        double n[3];
        trimesh_normal(&m->mesh, t, n);
        most = fmax(most, fabs(vec3_dot(w->velocity, n)));
    }
    if (most > 1e-6 * size)
        params_fault(r->p, r->f, key_text("walls.[%d].velocity", m->index),
                     "%g m/s across the wall, which stays where it is: it would pump fluid "
                     "through. Give the part along it; what moves is a body",
                     most);
}

/* --- all --- */

static void measure(const struct reading *r, struct scene_mesh *m)
{
    trimesh_bounds(&m->mesh, m->lo, m->hi);
    m->sizes = trimesh_sizes(&m->mesh);
    m->area = trimesh_area(&m->mesh);
    m->volume = m->mesh.closed ? fabs(trimesh_solid(&m->mesh, -1).volume) : 0.0;
    m->hash = trimesh_hash(&m->mesh);
    m->crossings = trimesh_crossings(&m->mesh, m->tree, &m->mesh, r->comm, &m->crossing);
}

static void check_domain(const struct reading *r, const struct scene_mesh *m, const char *file)
{
    const struct scene_domain *d = &r->s->domain;
    for (int a = 0; a < 3; a++)
        if (!d->periodic[a] && (m->hi[a] < d->min[a] || m->lo[a] > d->max[a])) {
            params_fault(r->p, r->f, m->key,
                         "%s lies outside the domain: %c from %g to %g m, domain %g to %g m. Is it "
                         "in mm (scale = 0.001), or to be shifted (translate)?",
                         file, "xyz"[a], m -> lo[a], m -> hi[a], d -> min[a], d -> max[a]);
            return;
        }
}

/* Rank 0 prepares; all ranks get the mesh, and judge it alike, so that faults are the same
 * everywhere. */
static void read_one(const struct reading *r, enum mesh_owner owner, int k,
                     const struct scene_surface *is)
{
    struct scene_mesh *m = r->s->meshes->of + r->s->meshes->n;
    const char *source = scene_mesh_source(r->s, owner, k);
    char why[640] = "";
    *m = (struct scene_mesh){.owner = owner, .index = k};
    scene_mesh_key(r->s, owner, k, m->key);
    int good = r->rank > 0 || prepare(r, is, m, why, sizeof why);
    MPI_Bcast(&good, 1, MPI_INT, 0, r->comm);
    MPI_Bcast(why, sizeof why, MPI_CHAR, 0, r->comm);
    if (!good) {
        params_fault(r->p, r->f, m->key, "%s: %s", source, why);
        trimesh_free(&m->mesh);
        return;
    }
    const bool body = owner == MESH_OF_BODY;
    int counts[4] = {m->welded, m->flat, m->reversed, body && r->s->bodies[k].cut};
    MPI_Bcast(counts, 4, MPI_INT, 0, r->comm);
    m->welded = counts[0];
    m->flat = counts[1];
    m->reversed = counts[2];
    if (body)
        r->s->bodies[k].cut = counts[3];
    trimesh_broadcast(&m->mesh, r->comm);
    set_name(r->s, m, is);
    if (!is_sound(r, m, source)) {
        trimesh_free(&m->mesh);
        return;
    }
    trimesh_bounds(&m->mesh, m->lo, m->hi);
    orient(r, m);
    measure(r, m);
    r->s->meshes->n++;
    if (body)
        r->s->bodies[k].mesh = m;
    check_domain(r, m, source);
    if (owner == MESH_OF_WALL)
        check_pumping(r, m);
}

void scene_meshes_read(struct scene *s, const char *case_dir, const struct params *p, MPI_Comm comm,
                       struct faults *f)
{
    struct reading r = {s, case_dir, p, comm, f, 0};
    MPI_Comm_rank(comm, &r.rank);
    if (!scene_has_meshes(s))
        return;
    s->meshes = NEW(struct scene_meshes, 1);
    for (enum mesh_owner owner = MESH_OF_SHAPE; owner <= MESH_OF_WALL;
         owner++) /* walls look at shapes */
        for (int k = 0; k < scene_mesh_owners(s, owner); k++)
            if (scene_has_triangles(s, owner, k))
                read_one(&r, owner, k, scene_surface_of(s, owner, k));
}

/* wall_files.c - meshes and outlines of walls and bodies for ParaView. NAME_walls.h5 holds the
 * triangles of all meshes and the vertices of those at rest, written with the first snapshot;
 * vertices of bodies go into every snapshot. NAME_walls.xdmf joins them. Mirror images at plane
 * sides are not shown. Restart files get the hash of each mesh, so that a run is not continued with
 * another shape.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_files.h"

#include "../../common/files/files.h"
#include "../../common/scene/scene.h"
#include "../walls/sph_walls.h"

enum { SURFACES = WALLS_MAX + BODIES_MAX };

/* Whether it is a mesh of the scene itself. */
static bool is_shown(const struct wall_mesh *m) { return m->of && !m->image; }

/* Vertices where the mesh is now; rank 0 writes them all. */
static void write_vertices(const struct sph *s, struct h5 *f, const struct wall_mesh *m)
{
    const int n = s->run->rank == 0 ? m->mesh.nvertices : 0;
    double *x = NEW(double, 3 * (size_t)n);
    for (int v = 0; v < n; v++)
        wall_mesh_to_world(m, m->mesh.x[v], x + 3 * (size_t)v);
    h5_write_real(f, key_text("vertices_%s", m->of->name), "m", n, 3, x, true);
    mem_free(x);
}

/* Three vertex numbers each; rank 0 writes them all. */
static void write_triangles(const struct sph *s, struct h5 *f, const struct wall_mesh *m)
{
    const int64_t n = s->run->rank == 0 ? 3 * (int64_t)m->mesh.ntriangles : 0;
    int64_t *v = NEW(int64_t, n);
    for (int64_t k = 0; k < n; k++)
        v[k] = m->mesh.vertex[k / 3][k % 3];
    h5_write_int(f, key_text("triangles_%s", m->of->name), n, v);
    mem_free(v);
}

/* Creates NAME_walls.h5. Collective. */
static void write_meshes(const struct sph *s)
{
    struct h5 *f = h5_create(s->run->comm, key_text("%s/%s_walls.h5", s->run->dir, s->run->name));
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        if (!is_shown(m))
            continue;
        write_triangles(s, f, m);
        if (m->body < 0)
            write_vertices(s, f, m);
    }
    h5_close(&f);
}

/* The XDMF file, made with the first time; a continued run goes on with it if anything moves. */
static struct xdmf *view_of(const struct sph *s, bool moving)
{
    struct walls *w = s->walls;
    if (!w->view)
        w->view = mem_own(w, xdmf_create(key_text("%s/%s_walls.xdmf", s->run->dir, s->run->name),
                                         s->run->restart && moving, s->t));
    return w->view;
}

/* Adds a time to the XDMF file: each mesh with its triangles from NAME_walls.h5 and its vertices
 * from there or from the snapshot `file'. */
static void show(const struct sph *s, struct xdmf *view, const char *file)
{
    char own[80];
    struct xdmf_surface of[SURFACES];
    int n = 0;
    snprintf(own, sizeof own, "%.60s_walls.h5", s->run->name);
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        if (!is_shown(m))
            continue;
        struct xdmf_surface *to = of + n++;
        snprintf(to->vertices, sizeof to->vertices, "vertices_%s", m->of->name);
        snprintf(to->triangles, sizeof to->triangles, "triangles_%s", m->of->name);
        to->name = m->of->name;
        to->vertices_file = m->body < 0 ? own : file;
        to->triangles_file = own;
        to->nvertices = m->mesh.nvertices;
        to->ntriangles = m->mesh.ntriangles;
    }
    xdmf_surfaces(view, s->t, n, of);
}

/* In 2D writes the corners of bodies where they are now into the snapshot, and adds a time to the
 * XDMF file; rank 0 has the data, x is NULL on the others. */
static void show_outlines(struct sph *s, struct h5 *f, const struct xdmf *x, const char *file)
{
    struct walls *w = s->walls;
    const char *names[BODIES_MAX];
    int n[BODIES_MAX];
    for (int k = 0; k < w->nbodies; k++) {
        const struct param_points *p = &w->bodies[k].is->points;
        double at[PARAM_POINTS_MAX][2];
        names[k] = w->bodies[k].is->name;
        n[k] = p->n;
        for (int i = 0; i < p->n; i++)
            body_corner(w->bodies + k, i, at[i]);
        h5_write_real(f, key_text("outline_%d", k + 1), "m", s->run->rank == 0 ? p->n : 0, 2,
                      &at[0][0], true);
    }
    if (x)
        xdmf_outlines(view_of(s, true), s->t, file, w->nbodies, names, n);
}

/* Nothing is written where no mesh is shown, or none moves after the first time. A continued run
 * appends to the XDMF file. */
void wall_files_snapshot(struct sph *s, struct h5 *f, const struct xdmf *x, const char *file)
{
    struct walls *w = s->walls;
    bool any = false, moving = false;
    const bool first = w && !w->shown;
    if (w && s->dim == 2 && w->nbodies > 0)
        show_outlines(s, f, x, file);
    for (int k = 0; w && k < w->nmeshes; k++) {
        any = any || is_shown(w->meshes + k);
        moving = moving || (is_shown(w->meshes + k) && w->meshes[k].body >= 0);
    }
    if (!any || (!first && !moving))
        return;
    if (first)
        write_meshes(s);
    w->shown = true;
    for (int k = 0; k < w->nmeshes; k++) {
        if (is_shown(w->meshes + k) && w->meshes[k].body >= 0)
            write_vertices(s, f, w->meshes + k);
    }
    if (x)
        show(s, view_of(s, moving), file);
}

/* Name of the attribute with a mesh's hash. */
static const char *hash_name(const struct wall_mesh *m) { return key_text("mesh_%s", m->of->name); }

void wall_files_save(const struct sph *s, struct h5 *f)
{
    for (int k = 0; s->walls && k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        if (is_shown(m))
            h5_attribute_int(f, hash_name(m), (int64_t)m->of->hash);
    }
}

/* A file that has no hash of this mesh does not fit either. */
bool wall_files_fit(const struct sph *s, struct h5 *f)
{
    for (int k = 0; s->walls && k < s->walls->nmeshes; k++) {
        const struct wall_mesh *m = s->walls->meshes + k;
        int64_t then;
        if (!is_shown(m) ||
            (h5_read_attribute_int(f, hash_name(m), &then) && then == (int64_t)m->of->hash))
            continue;
        log_say("the restart file is of another mesh %s: its file, or scale, rotate, translate or "
                "weld have changed; start anew, or bring the old ones back",
                m->of->name);
        return false;
    }
    return true;
}

/* scene_mesh.c - which walls, bodies and shapes have a mesh, and what is said of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scene_mesh.h"

#include "../files/files.h"
#include "exact.h"
#include "scene_fluid.h"
#include "scene_forms.h"

/* --- who has which --- */

const struct scene_surface *scene_surface_of(const struct scene *s, enum mesh_owner owner, int k)
{
    return owner == MESH_OF_WALL   ? &s->walls[k].surface
           : owner == MESH_OF_BODY ? &s->bodies[k].surface
                                   : &s->shapes[k].surface;
}

int scene_mesh_owners(const struct scene *s, enum mesh_owner owner)
{
    return owner == MESH_OF_WALL ? s->nwalls : owner == MESH_OF_BODY ? s->nbodies : s->nshapes;
}

static enum body_form form_of(const struct scene *s, enum mesh_owner owner, int k)
{
    return owner == MESH_OF_BODY && s->domain.dim == 3 ? scene_form_of(s->bodies + k) : FORM_NONE;
}

void scene_mesh_key(const struct scene *s, enum mesh_owner owner, int k, char key[64])
{
    static const char *const lists[] = {"shapes", "bodies", "walls"};
    static const char *const forms[] = {"mesh", "box", "radius", "radius", "points"};
    snprintf(key, 64, "%s.[%d].%s", lists[owner], k, forms[form_of(s, owner, k)]);
}

/* From a file, or of one of the forms that bodies have in 3D. */
bool scene_has_triangles(const struct scene *s, enum mesh_owner owner, int k)
{
    return *scene_surface_of(s, owner, k)->mesh || form_of(s, owner, k) != FORM_NONE;
}

const char *scene_mesh_source(const struct scene *s, enum mesh_owner owner, int k)
{
    return form_of(s, owner, k) == FORM_NONE ? scene_surface_of(s, owner, k)->mesh
                                             : s->bodies[k].name;
}

bool scene_mesh_thin(const struct scene *s, const struct scene_mesh *m)
{
    return m->index >= 0 && (m->owner == MESH_OF_WALL   ? s->walls[m->index].thin
                             : m->owner == MESH_OF_BODY ? s->bodies[m->index].thin
                                                        : false);
}

bool scene_has_meshes(const struct scene *s)
{
    bool any = false;
    for (enum mesh_owner owner = MESH_OF_SHAPE; owner <= MESH_OF_WALL; owner++)
        for (int k = 0; k < scene_mesh_owners(s, owner); k++)
            any = any || scene_has_triangles(s, owner, k);
    return any;
}

void scene_meshes_refuse(const struct scene *s, enum mesh_owner owner, const struct params *p,
                         const char *why, struct faults *f)
{
    for (int k = 0; k < scene_mesh_owners(s, owner); k++) {
        char key[64];
        scene_mesh_key(s, owner, k, key);
        if (scene_has_triangles(s, owner, k))
            params_fault(p, f, key, "%s", why);
    }
}

const struct scene_mesh *scene_mesh_of(const struct scene *s, enum mesh_owner owner, int index)
{
    for (int k = 0; s->meshes && k < s->meshes->n; k++)
        if (s->meshes->of[k].owner == owner && s->meshes->of[k].index == index)
            return s->meshes->of + k;
    return NULL;
}

const struct trimesh *scene_body_mesh(const struct scene *s, int k)
{
    const struct scene_mesh *m = scene_mesh_of(s, MESH_OF_BODY, k);
    return m ? &m->mesh : NULL;
}

bool scene_mesh_holds(const struct scene_mesh *m, const double *x)
{
    if (m->mesh.closed) /* outside of its box nothing need be looked for */
        for (int a = 0; a < 3; a++)
            if (x[a] < m->lo[a] || x[a] > m->hi[a])
                return m->fluid_side == FLUID_OUTSIDE;
    return tree_nearest(m->tree, x, INFINITY).distance > 0.0;
}

void scene_meshes_free(struct scene *s)
{
    for (int k = 0; s->meshes && k < s->meshes->n; k++) {
        DROP(s->meshes->of[k].tree);
        trimesh_free(&s->meshes->of[k].mesh);
    }
    mem_free(s->meshes);
    s->meshes = NULL;
}

/* Beyond the rim of an open mesh its nearest normal says nothing: there the winding number does,
 * unless that takes too long. */
static bool is_before(const struct scene_mesh *m, const double *x)
{
    enum { FEW = 20000 };
    const double least = m->fluid_side == FLUID_INSIDE    ? 0.5
                         : m->fluid_side == FLUID_OUTSIDE ? -0.5
                                                          : 0.0;
    const struct tree_foot f = tree_nearest(m->tree, x, INFINITY);
    if (!f.rim)
        return f.distance > 0.0;
    return m->mesh.ntriangles <= FEW && trimesh_winding(&m->mesh, x) > least;
}

/* Thin open walls bound nothing and are left out; a closed obstacle is solid whatever the shapes
 * say. */
enum scene_matter scene_matter(const struct scene *s, const struct exact *e, const double *x)
{
    bool wet = scene_is_fluid(s, e, x, NULL);
    for (int k = 0; s->meshes && k < s->meshes->n; k++) {
        const struct scene_mesh *m = s->meshes->of + k;
        const bool closed = m->mesh.closed;
        if (m->index < 0 || m->owner == MESH_OF_SHAPE ||
            (!closed && m->owner == MESH_OF_WALL && s->walls[m->index].thin))
            continue;
        if (closed && m->fluid_side == FLUID_OUTSIDE && !scene_mesh_holds(m, x))
            return MATTER_SOLID;
        wet = wet && (closed ? scene_mesh_holds(m, x) : is_before(m, x));
    }
    return wet ? MATTER_FLUID : MATTER_NONE;
}

/* --- what is said --- */

static void say_one(const struct scene_mesh *m)
{
    static const char *const sides[] = {"", "inside", "outside",
                                        "on the side that its normals point away from"};
    const struct trimesh *t = &m->mesh;
    char parts[32] = "";
    if (t->nparts > 1)
        snprintf(parts, sizeof parts, " in %d parts", t->nparts);
    log_say("mesh %s: %d triangles%s, %s, %s%.4g %s, fluid %s", m->name, t->ntriangles, parts,
            t->closed ? "closed" : "open", t->closed ? "volume " : "area ",
            t->closed ? m->volume : m->area, t->closed ? "m^3" : "m^2", sides[m->fluid_side]);
    if (m->flat + m->reversed > 0)
        log_say("mesh %s: %d flat triangle(s) taken out, %d turned to the sense of their "
                "neighbours",
                m->name, m->flat, m->reversed);
    if (m->parts > 0)
        log_say("mesh %s: %d of its %d part(s) inside out in the file: turned", m->name, m->parts,
                t->nparts);
    if (m->turned)
        log_say("mesh %s: its normals pointed into the fluid: reversed (walls.flip overrides)",
                m->name);
}

static void warn_one(const struct scene_mesh *m)
{
    const struct trimesh *t = &m->mesh;
    double x[3];
    if (m->crossings > 0) {
        trimesh_middle(t, m->crossing, x);
        log_warn("mesh %s: %d triangles pierce others, the first at (%g, %g, %g) m: walls there "
                 "count twice. Unite its solids before export",
                 m->name, m->crossings, x[0], x[1], x[2]);
    }
    if (t->junctions > 0)
        log_warn("mesh %s: %d edges belong to three triangles or more: sheets inside of it, or "
                 "solids that touch. Unite them before export",
                 m->name, t->junctions);
}

void scene_meshes_say(const struct scene *s)
{
    for (int k = 0; s->meshes && k < s->meshes->n; k++) {
        say_one(s->meshes->of + k);
        warn_one(s->meshes->of + k);
    }
}

void scene_meshes_summary(const struct scene *s, struct summary *to)
{
    for (int k = 0; s->meshes && k < s->meshes->n; k++) {
        const struct scene_mesh *m = s->meshes->of + k;
        const struct {
            const char *name;
            double value;
        } all[] = {{"triangles", m->mesh.ntriangles},
                   {"vertices", m->mesh.nvertices},
                   {"parts", m->mesh.nparts},
                   {"closed", m->mesh.closed},
                   {"rims", m->mesh.rims},
                   {"junctions", m->mesh.junctions},
                   {"welded", m->welded},
                   {"flat", m->flat},
                   {"reversed", m->reversed},
                   {"crossings", m->crossings},
                   {"area", m->area},
                   {"volume", m->volume},
                   {"edge_least", m->sizes.least},
                   {"edge_mean", m->sizes.mean},
                   {"edge_most", m->sizes.most},
                   {"sagitta", m->sizes.sagitta}};
        for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
            summary_real(to, key_text("mesh.%s.%s", m->name, all[i].name), all[i].value);
    }
}

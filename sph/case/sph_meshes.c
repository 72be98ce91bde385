/* sph_meshes.c - surfaces of triangles as particles of this spacing meet them: too small, too fine,
 * too coarse, thinner than the particles' reach, gauges behind them; see sph_sense.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "sph_sense.h"

enum { RAYS = 20000 }; /* about so many triangles of a mesh are looked at */

/* The words by which a case names it. */
static const char *file_of(const struct scene *c, const struct scene_mesh *m)
{
    return scene_mesh_source(c, m->owner, m->index);
}

static void check_size(const struct run *r, const struct scene_mesh *m, double dx, struct faults *f)
{
    double size = 0.0;
    for (int a = 0; a < 3; a++)
        size = fmax(size, m->hi[a] - m->lo[a]);
    if (size < dx)
        params_fault(r->params, f, m->key,
                     "%s is %.3g m in size, less than sph.dx = %g m: no particle sees it. Is its "
                     "scale right? Else take sph.dx = %.2g or less",
                     file_of(&r->scene, m), size, dx, 0.25 * size);
}

/* --- thickness and gaps --- */

/* Whether there is fluid at x at the start. */
static bool is_wet(const struct scene *c, const struct exact *e, const double *x)
{
    for (int a = 0; a < 3; a++)
        if (x[a] <= c->domain.min[a] || x[a] >= c->domain.max[a])
            return false;
    return scene_is_fluid(c, e, x, NULL);
}

/* What a ray from the middle of a triangle along its normal (way 1: through the solid, -1: through
 * the fluid) meets within reach: a face, of this mesh or another, that looks the other way. */
struct facing {
    bool any;
    const struct scene_mesh *met;
    double width, from[3], to[3], n[3];
};

static struct facing look_across(const struct scene_meshes *all, const struct scene_mesh *m, int t,
                                 int way, double reach)
{
    struct facing f = {.any = false};
    const struct scene_mesh *met = NULL;
    const double off = 1e-6 * reach;
    double end[3], other[3], least = INFINITY;
    trimesh_middle(&m->mesh, t, f.from);
    trimesh_normal(&m->mesh, t, f.n);
    for (int a = 0; a < 3; a++) {
        f.from[a] += way * off * f.n[a];
        end[a] = f.from[a] + way * reach * f.n[a];
    }
    for (int k = 0; k < all->n; k++) {
        double at;
        if (all->of[k].owner == MESH_OF_SHAPE || !tree_crosses(all->of[k].tree, f.from, end, &at) ||
            at >= least)
            continue;
        least = at;
        met = all->of + k;
    }
    if (!met)
        return f;
    for (int a = 0; a < 3; a++)
        f.to[a] = f.from[a] + least * (end[a] - f.from[a]);
    const struct tree_foot hit = tree_nearest(met->tree, f.to, off);
    if (hit.triangle < 0)
        return f;
    trimesh_normal(&met->mesh, hit.triangle, other);
    f.any = vec3_dot(other, f.n) < -0.5;
    f.width = least * reach + off;
    f.met = met;
    return f;
}

/* A solid thinner than `reach' with fluid on either side. (An open surface has its fluid on one; a
 * sheet in the midst of the water is found by filling.) */
static bool is_seen_through(const struct scene *c, const struct exact *e,
                            const struct scene_mesh *m, int t, double reach, struct facing *f)
{
    const double off = 1e-3 * reach;
    double x[3], y[3];
    *f = look_across(c->meshes, m, t, 1, reach);
    for (int a = 0; a < 3 && f->any; a++) {
        x[a] = f->from[a] - off * f->n[a];
        y[a] = f->to[a] + off * f->n[a];
    }
    return f->any && is_wet(c, e, x) && is_wet(c, e, y);
}

/* What else may be the cause, and its remedy. */
static const char *other_cause(const struct scene_mesh *m)
{
    return m->crossings > 0 ? "; its triangles pierce each other, as where solids overlap: unite "
                              "them before export"
           : m->mesh.nparts > 1 ? "; if it is the shell of a hollow that stays dry, leave out its "
                                  "inner surface"
           : !m->mesh.closed    ? "; if one side is dry, say so by the shapes"
                                : "";
}

/* The kernel is as good as nothing beyond 0.7 R. */
static void check_thin(const struct run *r, const struct scene_mesh *m,
                       const struct sph_params *used, struct faults *f)
{
    const struct exact e = exact_create(&r->scene);
    const double reach = 0.7 * used->R_dx * used->dx;
    const int stride = 1 + m->mesh.ntriangles / RAYS;
    for (int t = 0; t < m->mesh.ntriangles && !scene_mesh_thin(&r->scene, m); t += stride) {
        struct facing is;
        if (!is_seen_through(&r->scene, &e, m, t, reach, &is))
            continue;
        params_fault(
            r->params, f, m->key,
            "%s is %.3g m thick at triangle %d, (%g, %g, %g) m, with fluid on either "
            "side: particles see each other through less than 0.7 sph.R_dx sph.dx = %.3g "
            "m. Take sph.dx = %.2g or less, or make it thicker, or, of a sheet, give it thin "
            "= true (with it forces on a closed body err near its edges)%s",
            file_of(&r->scene, m), is.width, t + 1, is.from[0], is.from[1], is.from[2], reach,
            digits_below(used->dx * is.width / reach, 2), other_cause(m));
        return;
    }
}

/* --- gauges --- */

/* How far behind a surface a gauge still counts as on it. Of a body: what rounding makes, of the
 * file's numbers (7 digits) and of its place. */
static double behind_and_on(const struct scene_mesh *m, double dx)
{
    double lo[3], hi[3], far = 0.0;
    if (m->owner != MESH_OF_BODY)
        return dx;
    trimesh_bounds(&m->mesh, lo, hi);
    for (int a = 0; a < 3; a++)
        far = fmax(far, fmax(fabs(lo[a]), fabs(hi[a])));
    return 1e-6 * fmax(far, dx);
}

/* Of closed surfaces, which say what is behind them. */
static void check_probes(const struct run *r, const struct scene_mesh *m, double dx,
                         struct faults *f)
{
    const struct scene *c = &r->scene;
    for (int k = 0; k < c->nprobes && m->mesh.closed; k++) {
        const struct scene_probe *g = c->probes + k;
        if (!probe_is_point(g) || scene_mesh_holds(m, g->at) ||
            fabs(tree_nearest(m->tree, g->at, INFINITY).distance) <= behind_and_on(m, dx))
            continue;
        params_fault(r->params, f, key_text("probes.[%d].at", k),
                     "%s is behind the surface %s: put it before it", g->name, file_of(c, m));
    }
}

/* --- all --- */

/* Shapes may be thin: they are no walls. */
void sph_meshes_check(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    for (int k = 0; c->meshes && k < c->meshes->n; k++) {
        const struct scene_mesh *m = c->meshes->of + k;
        check_size(r, m, used->dx, f);
        if (m->owner == MESH_OF_SHAPE || f->n > 0)
            continue;
        check_thin(r, m, used, f);
        check_probes(r, m, used->dx, f);
    }
}

/* Gaps that no particle enters: the share of the triangles that face another across less than dx.
 */
static void warn_gaps(const struct run *r, const struct scene_mesh *m, double dx)
{
    const struct exact e = exact_create(&r->scene);
    const int stride = 1 + m->mesh.ntriangles / RAYS;
    struct facing first = {.any = false};
    int n = 0;
    for (int t = 0; t < m->mesh.ntriangles; t += stride) {
        const struct facing is = look_across(r->scene.meshes, m, t, -1, 2.0 * dx);
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = 0.5 * (is.from[a] + is.to[a]);
        if (!is.any || is.width < 1e-3 * dx || !is_wet(&r->scene, &e, x))
            continue;
        first = n++ == 0 ? is : first;
    }
    if (n > 0)
        log_warn("mesh %s: %d of the triangles looked at face others across less than 2 dx = %.3g "
                 "m of fluid, the first %.3g m apart at (%g, %g, %g) m: one layer of particles or "
                 "none, a flow there is noise. Take sph.dx = %.2g or less, or close the gap",
                 m->name, n, 2.0 * dx, first.width, first.from[0], first.from[1], first.from[2],
                 0.25 * first.width);
}

/* Whether the middle of a passage sees water and a dry place one width away, at the start. */
static bool leads_out(const struct run *r, const struct facing *is)
{
    const struct exact e = exact_create(&r->scene);
    const struct scene_domain *d = &r->scene.domain;
    const struct scene_meshes *all = r->scene.meshes;
    bool wet = false, dry = false;
    for (int k = 0; k < 27 && !(wet && dry); k++) {
        const double way[3] = {k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
        double x[3], y[3];
        bool seen = k != 13;
        for (int a = 0; a < 3; a++) {
            x[a] = 0.5 * (is->from[a] + is->to[a]);
            y[a] = x[a] + way[a] * is->width;
            seen = seen && y[a] > d->min[a] && y[a] < d->max[a];
        }
        for (int m = 0; m < all->n && seen; m++)
            seen = all->of[m].owner == MESH_OF_SHAPE || !tree_crosses(all->of[m].tree, x, y, NULL);
        const bool fluid = seen && is_wet(&r->scene, &e, y);
        wet = wet || fluid;
        dry = dry || (seen && !fluid);
    }
    return wet && dry;
}

/* Of one mesh to others: the narrowest passage, if it is narrower than `least'. */
static void find_passage(const struct run *r, const struct scene_mesh *m, double dx,
                         struct facing *least)
{
    const int stride = 1 + m->mesh.ntriangles / RAYS;
    const struct scene_domain *d = &r->scene.domain;
    for (int t = 0; t < m->mesh.ntriangles && m->owner != MESH_OF_SHAPE; t += stride) {
        const struct facing is = look_across(r->scene.meshes, m, t, -1, SPH_PASSAGE * dx);
        bool counts = is.any && is.met != m && is.width > dx && is.width < least->width;
        for (int a = 0; a < 3; a++) {
            const double x = 0.5 * (is.from[a] + is.to[a]);
            counts = counts && x > d->min[a] && x < d->max[a];
        }
        if (counts && leads_out(r, &is))
            *least = is;
    }
}

/* The same in the plane: sph.c. */
static void warn_passage(const struct run *r, double dx)
{
    struct facing least = {.width = INFINITY};
    for (int k = 0; k < r->scene.meshes->n; k++)
        find_passage(r, r->scene.meshes->of + k, dx, &least);
    if (!least.any)
        return;
    sph_passage_warn(key_text("mesh %s is %.3g m apart from another at (%g, %g, %g) m",
                              least.met->name, least.width, least.from[0], least.from[1],
                              least.from[2]),
                     least.width, dx);
}

/* Surfaces that pierce each other. */
static void warn_pairs(const struct run *r)
{
    const struct scene_meshes *all = r->scene.meshes;
    for (int k = 0; k < all->n; k++)
        for (int q = 0; q < k; q++) {
            const struct scene_mesh *a = all->of + k, *b = all->of + q;
            int first;
            double x[3];
            if (a->owner == MESH_OF_SHAPE || b->owner == MESH_OF_SHAPE)
                continue;
            const int n = trimesh_crossings(&a->mesh, b->tree, &b->mesh, r->comm, &first);
            if (n == 0)
                continue;
            trimesh_middle(&a->mesh, first, x);
            log_warn("meshes %s and %s pierce each other at (%g, %g, %g) m (%d triangles): what "
                     "they share counts twice for particles near by. Unite them before export",
                     a->name, b->name, x[0], x[1], x[2], n);
        }
}

void sph_meshes_warn(const struct run *r, const struct sph_params *used)
{
    const struct scene *c = &r->scene;
    const double dx = used->dx;
    for (int k = 0; c->meshes && k < c->meshes->n; k++) {
        const struct scene_mesh *m = c->meshes->of + k;
        const bool file =
            *scene_surface_of(c, m->owner, m->index)->mesh; /* else facets follow dx */
        if (m->owner == MESH_OF_SHAPE)
            continue;
        if (file && m->sizes.mean < 0.3 * dx)
            log_warn("mesh %s: edges of %.3g m on average, finer than the particles (sph.dx = %g "
                     "m): it costs time and adds nothing. Coarsen it to about %.2g m",
                     m->name, m->sizes.mean, dx, dx);
        if (file && m->sizes.sagitta > 0.1 * dx)
            log_warn("mesh %s: its facets leave a smooth surface by up to %.2g m = %.2g dx; if it "
                     "stands for one, refine it",
                     m->name, m->sizes.sagitta, m->sizes.sagitta / dx);
        if (scene_surface_of(c, m->owner, m->index)->weld > 0.01 * dx)
            log_warn("mesh %s: weld = %g m is more than sph.dx/100: it may close what is open",
                     m->name, scene_surface_of(c, m->owner, m->index)->weld);
        if (m->owner == MESH_OF_BODY && m->mesh.closed && scene_mesh_thin(c, m))
            log_warn(
                "mesh %s is closed and has thin = true: beside its edges the force on it errs, "
                "by a third and more, and under water the run may end. Leave thin out, with "
                "0.7 sph.R_dx sph.dx = %.2g m below its thickness",
                m->name, 0.7 * used->R_dx * dx);
        warn_gaps(r, m, dx);
    }
    if (c->meshes)
        warn_pairs(r);
    if (c->meshes && used->speed.moves)
        warn_passage(r, dx);
}

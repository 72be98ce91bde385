/* coupling_solids.c - where bodies and walls may lie in a coupled job. FV knows neither bodies nor
 * polylines nor meshes, unless its blocks have them (solids_elsewhere): what lies where it computes
 * would be missing there. Checked at the start along the prescribed motion through the whole run;
 * --check does it, too.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "coupling_solids.h"

#include "../../common/run/run.h"
#include "../../common/scene/scene.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../particles/sph_particles.h"
#include "../rigid/sph_rigid.h"
#include "sph_link.h"

/* Two cells from each open side: fv's stencils reach that deep into the box. */
void coupling_hidden(const struct run *r, const struct sph_params *prm, double box[2][3])
{
    bool open[6];
    double from;
    zones_given_box(r, prm, box[0], box[1]);
    sph_params_open(r, prm, open);
    for (int a = 0; a < r->scene.domain.dim; a++) {
        const double h = zones_cell(r, a, &from);
        box[0][a] += open[2 * a] ? 2.0 * h : 0.0;
        box[1][a] -= open[2 * a + 1] ? 2.0 * h : 0.0;
    }
}

/* Whether a point lies beyond a side of the box by which the partner's flow comes. way: how far the
 * box has moved, m. */
static bool is_beyond(int dim, double box[2][3], const bool *open, const double *way,
                      const double *x)
{
    bool out = false;
    for (int a = 0; a < dim; a++)
        out = out || (open[2 * a] && x[a] < box[0][a] + way[a]) ||
              (open[2 * a + 1] && x[a] > box[1][a] + way[a]);
    return out;
}

/* First time at which a corner of a driven body leaves the box by an open side, INFINITY: never; a
 * free one is watched as it goes. 500 times in the run are looked at, with all corners or
 * vertices. */
static double leaves(const struct run *r, const struct sph_params *prm, int k, double box[2][3],
                     const bool *open)
{
    enum { TIMES = 500 };
    const struct scene *c = &r->scene;
    const int dim = c->domain.dim;
    struct body b;
    double when = INFINITY;
    body_create(&b, c->bodies + k, scene_body_mesh(c, k), dim, r->motions);
    const int corners = body_corners(&b);
    for (int t = 0; t <= (b.free || !b.moves ? 0 : TIMES) && when == INFINITY; t++) {
        const double now = c->time.end * t / TIMES;
        double way[3], at[3] = {0.0, 0.0, 0.0};
        body_move(&b, now);
        (void)box_motion_foretold(r, prm, now, way);
        for (int i = 0; i < corners && when == INFINITY; i++) {
            body_corner(&b, i, at);
            if (is_beyond(dim, box, open, way, at))
                when = now;
        }
    }
    body_destroy(&b);
    return when;
}

/* A fault for each body that leaves what sph gives. */
void coupling_check_bodies(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    double given[2][3];
    bool open[6];
    zones_given_box(r, prm, given[0], given[1]);
    sph_params_open(r, prm, open);
    for (int k = 0; k < r->scene.nbodies; k++) {
        const double when =
            solids_elsewhere(r, MESH_OF_BODY, k) ? INFINITY : leaves(r, prm, k, given, open);
        if (when < INFINITY)
            params_fault(r->params, f, key_text("bodies.[%d]", k),
                         "body `%s' is outside of %s m at t = %.4g s: fv, which has no bodies, "
                         "takes that from sph alone; enlarge sph.box, or lower coupling.overlap, "
                         "time.end or the body's path",
                         r->scene.bodies[k].name, zones_extent(r->scene.domain.dim, given), when);
    }
}

/* Whether a point of a wall lies inside the domain where FV computes the flow. The walls are at
 * rest, and so is the box. */
static bool is_partners(const struct scene_domain *d, double box[2][3], const bool *open,
                        const double *x)
{
    static const double rest[3] = {0.0, 0.0, 0.0};
    bool inside = true;
    for (int a = 0; a < d->dim; a++)
        inside = inside && x[a] > d->min[a] && x[a] < d->max[a];
    return inside && is_beyond(d->dim, box, open, rest, x);
}

/* A line that leaves where SPH gives the flow, inside the domain: the place where it does. Points
 * `step' apart along each segment. */
static bool line_leaves(const struct run *r, const struct scene_wall *w, double box[2][3],
                        const bool *open, double step, double *at)
{
    for (int i = 0; i + !w->closed < w->points.n; i++) {
        const double *a = w->points.x[i], *b = w->points.x[(i + 1) % w->points.n];
        const int n = (int)ceil(hypot(b[0] - a[0], b[1] - a[1]) / step) + 1;
        for (int k = 0; k <= n; k++) {
            for (int c = 0; c < 2; c++)
                at[c] = a[c] + k * (b[c] - a[c]) / n;
            if (is_partners(&r->scene.domain, box, open, at))
                return true;
        }
    }
    return false;
}

/* The same of a surface of triangles, each looked at in points no farther than `step' apart. */
static bool mesh_leaves(const struct run *r, const struct trimesh *m, double box[2][3],
                        const bool *open, double step, double *at)
{
    for (int t = 0; t < m->ntriangles; t++) {
        const double *v[3];
        double longest = 0.0;
        for (int k = 0; k < 3; k++)
            v[k] = m->x[m->vertex[t][k]];
        for (int k = 0; k < 3; k++)
            longest = fmax(longest, vec3_distance(v[k], v[(k + 1) % 3]));
        const int n = (int)ceil(longest / step) + 1;
        for (int i = 0; i <= n; i++)
            for (int j = 0; i + j <= n; j++) {
                for (int c = 0; c < 3; c++)
                    at[c] = v[0][c] + (i * (v[1][c] - v[0][c]) + j * (v[2][c] - v[0][c])) / n;
                if (is_partners(&r->scene.domain, box, open, at))
                    return true;
            }
    }
    return false;
}

/* Lines are not looked at where fv has blocks, which does so itself. */
void coupling_check_walls(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    double box[2][3], at[3] = {0.0, 0.0, 0.0};
    bool open[6];
    coupling_hidden(r, prm, box);
    sph_params_open(r, prm, open);
    for (int k = 0; k < r->scene.nwalls; k++) {
        const struct scene_wall *line = r->scene.walls + k;
        const struct scene_mesh *mesh = scene_mesh_of(&r->scene, MESH_OF_WALL, k);
        if (solids_elsewhere(r, MESH_OF_WALL, k))
            continue;
        if ((line->points.n > 1 && !params_has_group(r->params, "blocks") && /* fv looks at them */
             line_leaves(r, line, box, open, 0.5 * prm->dx, at)) ||
            (mesh && mesh_leaves(r, &mesh->mesh, box, open, 0.5 * prm->dx, at)))
            params_fault(r->params, f, key_text("walls.[%d].%s", k, mesh ? "mesh" : "points"),
                         "at (%g, %g, %g) m it is outside of %s m: fv, which has no walls but the "
                         "domain's sides, takes only what lies deeper from sph; enlarge sph.box, "
                         "lower coupling.overlap, or refine fv.cells",
                         at[0], at[1], at[2], zones_extent(r->scene.domain.dim, box));
    }
}

/* Coming within two cells of the open sides is allowed, but fv's mapping then mixes particles from
 * both sides of the body. */
void coupling_warn(const struct run *r, const struct sph_params *prm)
{
    double near[2][3];
    bool open[6];
    coupling_hidden(r, prm, near);
    sph_params_open(r, prm, open);
    for (int k = 0; k < r->scene.nbodies; k++)
        if (!solids_elsewhere(r, MESH_OF_BODY, k) && leaves(r, prm, k, near, open) < INFINITY)
            log_warn(
                "body `%s' comes within two cells of fv of what fv takes from sph: it mixes the "
                "particles on all its sides there; enlarge sph.box, or refine fv.cells",
                r->scene.bodies[k].name);
}

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

/* First time at which a corner of a body leaves the box by an open side, INFINITY: never; a free
 * one, and any that a box may leave whose way nobody knows, is watched as it goes. Times all over
 * the run are looked at, with all corners or vertices. */
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
    const int times = !b.free && (b.moves || box_motion_wanted(prm)) ? TIMES : 0;
    for (int t = 0; t <= times && when == INFINITY; t++) {
        const double now = body_drive_instant(t, TIMES, c->time.end);
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

/* What sph gives at a time: the box has moved by way, m. */
struct given_flow {
    const struct scene_domain *domain;
    double (*box)[3], way[3];
    const bool *open;
};

/* Whether a point of a wall, which is at rest, lies where FV computes the flow: inside the domain,
 * or of what is drawn in another period anywhere but in the box. */
static bool is_partners(const struct given_flow *g, const double *x)
{
    const struct scene_domain *d = g->domain;
    bool inside = true;
    for (int a = 0; a < d->dim; a++)
        inside = inside && (d->periodic[a] || (x[a] > d->min[a] && x[a] < d->max[a]));
    return inside && is_beyond(d->dim, g->box, g->open, g->way, x);
}

/* A line that leaves where SPH gives the flow, inside the domain: the place where it does. Points
 * `step' apart along each segment. */
static bool line_leaves(const struct given_flow *g, const struct scene_wall *w, double step,
                        double *at)
{
    for (int i = 0; i + !w->closed < w->points.n; i++) {
        const double *a = w->points.x[i], *b = w->points.x[(i + 1) % w->points.n];
        const int n = (int)ceil(hypot(b[0] - a[0], b[1] - a[1]) / step) + 1;
        for (int k = 0; k <= n; k++) {
            for (int c = 0; c < 2; c++)
                at[c] = a[c] + k * (b[c] - a[c]) / n;
            if (is_partners(g, at))
                return true;
        }
    }
    return false;
}

/* The same of a surface of triangles, each looked at in points no farther than `step' apart. */
static bool mesh_leaves(const struct given_flow *g, const struct trimesh *m, double step,
                        double *at)
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
                if (is_partners(g, at))
                    return true;
            }
    }
    return false;
}

/* Whether wall k leaves what sph gives, and where. Lines are not looked at where fv has blocks,
 * which does so itself. */
static bool wall_leaves(const struct run *r, const struct sph_params *prm,
                        const struct given_flow *g, int k, double *at)
{
    const struct scene_wall *line = r->scene.walls + k;
    const struct scene_mesh *mesh = scene_mesh_of(&r->scene, MESH_OF_WALL, k);
    return (line->points.n > 1 && !params_has_group(r->params, "blocks") &&
            line_leaves(g, line, 0.5 * prm->dx, at)) ||
           (mesh && mesh_leaves(g, &mesh->mesh, 0.5 * prm->dx, at));
}

/* A box that moves leaves every wall; where nobody knows how far, it is taken to be gone. */
void coupling_check_walls(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    const int times = box_motion_wanted(prm) ? 100 : 0;
    double box[2][3], at[3] = {0.0, 0.0, 0.0};
    bool open[6];
    coupling_hidden(r, prm, box);
    sph_params_open(r, prm, open);
    for (int k = 0; k < r->scene.nwalls; k++) {
        const int before = f->n, dim = r->scene.domain.dim;
        const bool mesh = scene_mesh_of(&r->scene, MESH_OF_WALL, k) != NULL;
        if ((!mesh && r->scene.walls[k].points.n < 2) || solids_elsewhere(r, MESH_OF_WALL, k))
            continue;
        for (int i = 0; i <= times && f->n == before; i++) {
            struct given_flow g = {.domain = &r->scene.domain, .box = box, .open = open};
            const double t = body_drive_instant(i, times, r->scene.time.end);
            const bool known = box_motion_foretold(r, prm, t, g.way) || i == 0;
            for (int a = 0; a < dim && !known; a++)
                g.way[a] = box_motion_along(r, prm, a) ? INFINITY : 0.0;
            if (wall_leaves(r, prm, &g, k, at))
                params_fault(
                    r->params, f, key_text("walls.[%d].%s", k, mesh ? "mesh" : "points"),
                    "at (%g, %g, %g) m it is outside of %s m%s: fv, which has no walls but the "
                    "domain's sides, takes only what lies deeper from sph; enlarge sph.box, lower "
                    "coupling.overlap, or refine fv.cells%s",
                    at[0], at[1], at[2], zones_extent(dim, box),
                    i > 0 ? ", once the box has moved" : "",
                    i > 0 ? key_text("; or leave %s out", box_motion_key(prm)) : "");
        }
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

/* regions_check.c - whether the group apr makes sense, before anything is created. In order: levels
 * and criteria, then keys and extents of each region, from the parameters alone; then, if these
 * have no fault, nesting, motion and open sides from the regions themselves, which are created for
 * that and moved through the run's time. Each fault names the key of the region and a value that
 * would do.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "regions_check.h"

#include "../../common/scene/scene.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../rigid/sph_rigid.h"
#include "criteria.h"
#include "regions.h"
#include "regions_parts.h"

/* What a check of region k needs. */
struct check {
    const struct run *r;
    const struct sph_params *used;
    const struct apr_params *prm;
    struct faults *f;
    const struct apr_region *is;
    int k, dim;
};

static const char *key_of(const struct check *c, const char *name)
{
    return key_text("apr.regions.[%d].%s", c->k, name);
}

static double R_of(const struct check *c, int level)
{
    return ldexp(c->used->R_dx * c->used->dx, -level);
}

/* --- size and place --- */

/* Bounds of a box or sphere at the start. */
static void bounds(const struct apr_region *is, double lo[3], double hi[3])
{
    for (int a = 0; a < 3; a++) {
        const bool box = is->shape == REGION_BOX;
        lo[a] = box ? is->min[a] : is->centre[a] - is->radius;
        hi[a] = box ? is->max[a] : is->centre[a] + is->radius;
    }
}

/* Along axis a the region must meet that of the particles and be wide enough: guards fill R of the
 * coarser level at each edge that is no wall, and two coarser spacings must be left between. */
static void check_extent(const struct check *c, int a, double lo, double hi)
{
    const struct scene_domain *d = &c->r->scene.domain;
    const double near = 1e-6 * c->used->dx, R = R_of(c, c->is->level - 1);
    const double *from = c->used->box[0], *to = c->used->box[1];
    if (hi <= from[a] + near || lo >= to[a] - near) {
        params_fault(c->r->params, c->f, key_of(c, c->is->shape == REGION_BOX ? "min" : "centre"),
                     "the region, %c from %g to %g m, lies outside of that of the particles, %g "
                     "to %g m",
                     "xyz"[a], lo, hi, from[a], to[a]);
        return;
    }
    const int faces = d->periodic[a] && hi - lo >= d->max[a] - d->min[a] - near
                          ? 0
                          : (lo > from[a] + near) + (hi < to[a] - near);
    const double length = fmin(hi, to[a]) - fmax(lo, from[a]);
    const double least = faces * (R + 2.0 * ldexp(c->used->dx, 1 - c->is->level));
    if (length < least * (1.0 - 1e-9))
        params_fault(c->r->params, c->f, key_of(c, c->is->shape == REGION_BOX ? "max" : "radius"),
                     "%c from %g to %g m: guards R = %.4g m deep of level %d at %d edge%s leave "
                     "nothing to refine; at least %.4g m are needed, or a smaller level",
                     "xyz"[a], lo, hi, R, c -> is -> level, faces, faces > 1 ? "s" : "",
                     digits_above(least, 4));
}

/* Size, then extent along each axis. */
static void check_box_and_ball(const struct check *c)
{
    double lo[3], hi[3];
    if (c->is->shape == REGION_SPHERE && c->is->radius <= 0.0) {
        params_fault(c->r->params, c->f, key_of(c, "radius"), "region %d: a sphere needs a radius",
                     c->k + 1);
        return;
    }
    bounds(c->is, lo, hi);
    for (int a = 0; a < c->dim; a++)
        if (hi[a] <= lo[a]) {
            params_fault(c->r->params, c->f, key_of(c, "max"),
                         "%g m is not larger than min, %g m, along %c", hi[a], lo[a], "xyz"[a]);
            return;
        }
    for (int a = 0; a < c->dim; a++)
        check_extent(c, a, lo[a], hi[a]);
}

/* Shape body or wall: the name or number, and an offset that leaves room for more than guards. */
static void check_shell(const struct check *c)
{
    const struct scene *s = &c->r->scene;
    const double least = R_of(c, c->is->level - 1) + 2.0 * ldexp(c->used->dx, 1 - c->is->level);
    if (c->is->shape == REGION_BODY && region_body(s, c->is->body) == BODIES_MAX)
        params_fault(c->r->params, c->f, key_of(c, "body"),
                     "no body has the name `%s'; group bodies names them", c->is->body);
    if (c->is->shape == REGION_WALL && (c->is->wall < 1 || c->is->wall > s->nwalls))
        params_fault(c->r->params, c->f, key_of(c, "wall"), "%d: there are walls 1 to %d",
                     c->is->wall, s->nwalls);
    else if (c->is->shape == REGION_WALL && s->walls[c->is->wall - 1].side != SIDE_NONE)
        params_fault(c->r->params, c->f, key_of(c, "wall"),
                     "wall %d is a side of the domain: give a box that ends on it", c->is->wall);
    if (c->is->offset < least * (1.0 - 1e-9))
        params_fault(c->r->params, c->f, key_of(c, "offset"),
                     "%g m: guards R = %.4g m deep at the edge of level %d leave nothing to "
                     "refine; at least %.4g m are needed",
                     c->is->offset, least - 2.0 * ldexp(c->used->dx, 1 - c->is->level),
                     c->is->level, digits_above(least, 4));
}

/* --- levels --- */

/* Levels up to apr.levels, and at least one region or criterion that reaches it. */
static void check_levels(const struct run *r, const struct apr_params *prm, struct faults *f)
{
    int most = 0;
    for (int k = 0; k < prm->regions.n + prm->criteria.n; k++) {
        const int c = k - prm->regions.n;
        const int level = c < 0 ? prm->regions.of[k].level : prm->criteria.of[c].level;
        most = level > most ? level : most;
        if (level > prm->levels)
            params_fault(
                r->params, f,
                key_text("apr.%s.[%d].level", c < 0 ? "regions" : "criteria", c < 0 ? k : c),
                "%d is above apr.levels = %d", level, prm->levels);
    }
    if (most < prm->levels)
        params_fault(r->params, f, "apr.levels",
                     "%d, but no region and no criterion asks for more than %d", prm->levels, most);
}

/* Whether it has a motion of its own. */
static bool motion_is_told(const struct apr_region *is)
{
    bool any = is->motion.n > 0;
    for (int a = 0; a < 3; a++)
        any = any || is->velocity[a] != 0.0;
    return any;
}

static bool moves(const struct apr_region *is) { return motion_is_told(is) || *is->follow; }

/* Whether two regions stay where they are relative to each other; -1 for both sets are shells,
 * which move with their body or wall. */
static bool same_motion(const struct regions *g, int a, int b)
{
    if (g->set_of[a] >= 0 || g->set_of[b] >= 0)
        return g->set_of[a] == g->set_of[b];
    const struct apr_region *x = g->prm->regions.of + a, *y = g->prm->regions.of + b;
    return x->shape == y->shape && x->wall == y->wall && strcmp(x->body, y->body) == 0;
}

/* Whether x lies in a box or sphere. */
static bool holds(const struct apr_region *is, const double *x, int dim)
{
    bool in = true;
    double r2 = 0.0;
    for (int a = 0; a < dim; a++) {
        in = in && x[a] >= is->min[a] && x[a] <= is->max[a];
        r2 += (x[a] - is->centre[a]) * (x[a] - is->centre[a]);
    }
    return is->shape == REGION_BOX ? in : r2 <= is->radius * is->radius;
}

/* Whether the case itself has a region of the level below around region k's centre that moves
 * alike: then none is made automatically. */
bool regions_outer_given(const struct regions *g, int k)
{
    const struct apr_regions *all = &g->prm->regions;
    double lo[3], hi[3], x[3];
    bounds(all->of + k, lo, hi);
    for (int a = 0; a < 3; a++)
        x[a] = 0.5 * (lo[a] + hi[a]);
    for (int j = 0; j < all->n; j++)
        if (all->of[j].level == all->of[k].level - 1 && same_motion(g, j, k) &&
            (all->of[k].shape >= REGION_BODY || holds(all->of + j, x, g->dim)))
            return true;
    return false;
}

/* Least distance of what a region covers within the domain from the edge of the level below. */
struct least {
    double d, at[3];
};

/* Points outside the domain hold nobody. */
static void try_point(const struct regions *g, int level, const double *x, struct least *best)
{
    for (int a = 0; a < g->dim; a++)
        if (!g->periodic[a] && (x[a] < g->domain.lo[a] || x[a] > g->domain.hi[a]))
            return;
    const double d = regions_fixed_distance(g, level, x);
    if (d < best->d) {
        best->d = d;
        memcpy(best->at, x, sizeof best->at);
    }
}

/* By samples on its surface: a grid on each face of a box; on a sphere the same grid drawn to it. /
 * Faces of a box are cut at the domain's ends, since an edge beyond a wall does not count. */
static struct least least_depth(const struct regions *g, const struct apr_region *is)
{
    enum { SAMPLES = 32 };
    struct least best = {.d = INFINITY};
    double lo[3], hi[3];
    bounds(is, lo, hi);
    for (int side = 0; side < 2 * g->dim; side++)
        for (int i = 0; i <= SAMPLES; i++)
            for (int j = 0; j <= (g->dim == 3 ? SAMPLES : 0); j++) {
                const int at[2] = {i, j};
                double x[3] = {0.0, 0.0, 0.0}, length = 0.0;
                for (int a = 0, b = 0; a < g->dim; a++) {
                    const double w = a == side / 2 ? side % 2 : (double)at[b++] / SAMPLES;
                    const double from =
                        is->shape == REGION_BOX ? fmax(lo[a], g->domain.lo[a]) : lo[a];
                    const double to =
                        is->shape == REGION_BOX ? fmin(hi[a], g->domain.hi[a]) : hi[a];
                    x[a] = from + w * (to - from);
                    length += pow(x[a] - is->centre[a], 2.0);
                }
                for (int a = 0; a < g->dim && is->shape == REGION_SPHERE; a++)
                    x[a] = is->centre[a] + is->radius * (x[a] - is->centre[a]) / sqrt(length);
                try_point(g, is->level - 1, x, &best);
            }
    return best;
}

/* At least 1.5 R of the level outside of both must lie between the edges, where the case gives
 * both. */
static void check_nesting(const struct check *c, const struct regions *g)
{
    const int outer = c->is->level - 1;
    const double least = 1.5 * R_of(c, outer - 1);
    if (outer < 1 || g->alone[c->k])
        return;
    if (c->is->shape >= REGION_BODY) {
        for (int j = 0; j < g->prm->regions.n; j++) {
            const struct apr_region *is = g->prm->regions.of + j;
            if (is->level == outer && same_motion(g, j, c->k) &&
                is->offset < (c->is->offset + least) * (1.0 - 1e-9))
                params_fault(c->r->params, c->f, key_of(c, "offset"),
                             "level %d reaches to %g m, that of level %d around it to %g m: make "
                             "that %.4g m, or leave it out, then one is made",
                             c->is->level, c->is->offset, outer, is->offset, c->is->offset + least);
        }
        return;
    }
    const struct least l = least_depth(g, c->is);
    if (l.d < least * (1.0 - 1e-6))
        params_fault(
            c->r->params, c->f, key_of(c, c->is->shape == REGION_BOX ? "min" : "radius"),
            "level %d comes to %.4g m from the edge of level %d at (%g, %g, %g)%s: at least "
            "R of level %d and half of it, %.4g m, must lie between; make the region of "
            "level %d larger, or leave it out, then one is made",
            c->is->level, l.d, outer, l.at[0], l.at[1], l.at[2], l.d < 0.0 ? ", outside of it" : "",
            outer - 1, least, outer);
}

/* --- open sides --- */

/* Zones and R at an open side, and for each outer level what is made around finer ones. */
double regions_allowed(const struct regions *g, int level, int side)
{
    const int a = side / 2, sign = side % 2 ? -1 : 1;
    double depth = g->zones + g->R;
    if (!g->open[side])
        return side % 2 ? INFINITY : -INFINITY;
    for (int n = 1; n < level; n++)
        depth += g->level[n].cells ? (ceil(g->prm->margin) + 1.0) * g->level[n].cells->h[a]
                                   : regions_margin(g, n);
    return (side % 2 ? g->domain.hi[a] : g->domain.lo[a]) + sign * depth;
}

/* Samples the plane at the allowed depth and four positions between it and the side. */
bool regions_meet_zones(const struct regions *g, int side, double x[3])
{
    enum { SAMPLES = 64 };
    const int axis = side / 2, u = (axis + 1) % g->dim, v = (axis + 2) % g->dim;
    if (!g->open[side])
        return false;
    x[0] = x[1] = x[2] = 0.0;
    x[axis] = regions_allowed(g, 1, side);
    const double end = side % 2 ? g->domain.hi[axis] : g->domain.lo[axis];
    for (int i = 0; i < SAMPLES; i++)
        for (int j = 0; j < (g->dim == 3 ? SAMPLES : 1); j++) {
            x[u] = g->domain.lo[u] + (i + 0.5) / SAMPLES * (g->domain.hi[u] - g->domain.lo[u]);
            if (g->dim == 3)
                x[v] = g->domain.lo[v] + (j + 0.5) / SAMPLES * (g->domain.hi[v] - g->domain.lo[v]);
            double d = regions_fixed_distance(g, 1, x);
            double beyond[3] = {x[0], x[1], x[2]};
            for (int k = 0; k < 4; k++) { /* a region may lie between the place and the side */
                beyond[axis] += 0.25 * (end - x[axis]);
                d = fmax(d, regions_fixed_distance(g, 1, beyond));
            }
            if (d > 1e-6 * g->R)
                return true;
        }
    return false;
}

/* Places of the bodies at t; false: one is free. Bodies with a prescribed motion go where they will
 * be; free ones stay at their start. */
static bool set_bodies(const struct run *r, struct regions *g, double t)
{
    bool told = true;
    for (int k = 0; k < r->scene.nbodies; k++) {
        struct body b;
        double x[3] = {0.0, 0.0, 0.0};
        told = told && !r->scene.bodies[k].free;
        if (r->scene.bodies[k].free)
            continue;
        body_create(&b, r->scene.bodies + k, NULL, g->dim, r->motions);
        body_move(&b, t);
        body_place(&b, b.centre, x);
        struct body_motion now = b.now;
        for (int a = 0; a < g->dim; a++)
            now.x[a] = x[a] - b.centre[a];
        regions_set_body(g, k, &now);
        body_destroy(&b);
    }
    return told;
}

/* Regions and the box as they are at t. */
static void stand_at(const struct run *r, const struct sph_params *used, struct regions *g,
                     double t)
{
    double way[3];
    set_bodies(r, g, t);
    box_motion_foretold(r, used, t, way);
    regions_set_box(g, way);
    regions_move(g, t);
}

/* A region that comes into the zones at an open side, anywhere along it, as far as its way and that
 * of the box are known beforehand. Without motion, or where it is not known beforehand, the start
 * alone is looked at; otherwise 32 times in 2D and 4 in 3D, where distances to meshes cost more. */
static void check_open_sides(const struct run *r, const struct sph_params *used, struct regions *g,
                             struct faults *f)
{
    double way[3], x[3];
    bool moves = g->goes;
    for (int n = 0; n < g->nsets; n++)
        moves = moves || g->sets[n].speed > 0.0 || g->sets[n].body >= 0;
    for (int n = 0; n < g->nshells; n++)
        moves = moves || g->body_of[n] >= 0;
    const bool told = set_bodies(r, g, 0.0) && box_motion_foretold(r, used, 0.0, way);
    const int times = !moves || !told ? 0 : g->dim == 3 ? 4 : 32;
    const int before = f->n;
    for (int k = 0; k <= times && f->n == before; k++) {
        const double t = body_drive_instant(k, times, r->scene.time.end);
        if (k > 0)
            stand_at(r, used, g, t);
        for (int side = 0; side < 2 * g->dim; side++) {
            if (!regions_meet_zones(g, side, x))
                continue;
            const double end = side % 2 ? g->domain.hi[side / 2] : g->domain.lo[side / 2];
            params_fault(
                r->params, f, "apr.regions",
                "level 1 reaches into the open side %s at (%g, %g, %g) m, t = %.4g s: regions and "
                "what is made around them must stay %.4g m away, transition, buffer and R; make "
                "them smaller, or the region of the particles larger%s",
                scene_side_names[side], x[0], x[1], x[2], t, fabs(end - x[side / 2]),
                g->goes ? "; follow = \"sph.box\" moves them with the box" : "");
        }
    }
}

/* --- motion --- */

/* Returns false if it has added faults. */
static bool check_motion_keys(const struct check *c)
{
    const int before = c->f->n;
    struct body_drive drive;
    body_drive_terms(&drive, &c->is->motion, c->dim, c->r->motions);
    for (int m = 0; m < drive.nterms; m++) {
        const struct scene_motion *t = c->is->motion.of + m;
        char text[1400];
        if (body_term_fault(&drive, m, c->r->motions, text, sizeof text))
            params_fault(c->r->params, c->f, key_of(c, "motion"), "term %d: %s", m + 1, text);
        else if (t->kind != MOTION_FILE && t->axis >= AXIS_RX)
            params_fault(c->r->params, c->f, key_of(c, "motion"),
                         "term %d: a region does not turn: axis x, y or z", m + 1);
    }
    scene_check_motion(&c->is->motion, "apr.regions", c->k, c->r->params, c->f);
    if (region_axes(c->is->along, c->dim) < 0)
        params_fault(c->r->params, c->f, key_of(c, "along"),
                     "`%s' is not a list of axes: expected %s", c->is->along,
                     c->dim == 2 ? "x, y or x y" : "some of x y z");
    if (*c->is->follow && motion_is_told(c->is))
        params_fault(
            c->r->params, c->f, key_of(c, "follow"),
            "a region that follows something has no motion of its own: remove velocity and motion");
    const bool with_box = strcmp(c->is->follow, "sph.box") == 0;
    if (with_box && !box_motion_wanted(c->used))
        params_fault(c->r->params, c->f, key_of(c, "follow"),
                     "the box rests: leave it out, or give sph.box_velocity or sph.box_follows");
    if (*c->is->follow && strcmp(c->is->follow, "peak") != 0 && !with_box &&
        region_body(&c->r->scene, c->is->follow) == BODIES_MAX)
        params_fault(c->r->params, c->f, key_of(c, "follow"),
                     "no body has the name `%s'; follow = \"peak\" is the largest pressure, "
                     "\"sph.box\" the box that moves",
                     c->is->follow);
    return c->f->n == before;
}

/* Too fast for its particles, or gone before the run is over. Half a spacing of its finest level is
 * the farthest a region may move in a step; 64 times in the run are looked at for its place. */
static void check_motion(const struct check *c, const struct regions *g)
{
    const struct region_set *s = g->set_of[c->k] < 0 ? NULL : g->sets + g->set_of[c->k];
    const char *key = key_of(c, c->is->motion.n > 0 ? "motion" : "velocity");
    if (!s || s->speed <= 0.0)
        return;
    struct sph_params fine = *c->used;
    fine.dx = ldexp(fine.dx, -c->prm->levels);
    const double dt = sph_params_dt(&fine, c->r->scene.fluid.nu, fine.c0, NULL);
    const double most = 0.5 * ldexp(c->used->dx, -s->finest);
    if (s->speed * dt > most) {
        params_fault(c->r->params, c->f, key,
                     "%.4g m/s: the region moves %.3g dx of level %d in a step of %.3g s, at most "
                     "0.5 are allowed; %.4g m/s are, or a larger sph.c0",
                     s->speed, s->speed * dt / (2.0 * most), s->finest, dt, most / dt);
        return;
    }
    double lo[3], hi[3], d[BODY_AXES], dd[BODY_AXES], ddd[BODY_AXES];
    bounds(c->is, lo, hi);
    for (int k = 0; k <= 64; k++) {
        const double t = body_drive_instant(k, 64, c->r->scene.time.end);
        double way[3];
        if (!box_motion_foretold(c->r, c->used, t, way))
            return;
        body_drive_at(&s->drive, t, d, dd, ddd);
        for (int a = 0; a < c->dim; a++)
            if (!s->box && !g->periodic[a] &&
                (hi[a] + d[a] <= g->domain.lo[a] + way[a] ||
                 lo[a] + d[a] >= g->domain.hi[a] + way[a])) {
                params_fault(c->r->params, c->f, key,
                             "the region has left that of the particles along %c at t = %.4g s, "
                             "before time.end = %g s",
                             "xyz"[a], t, c -> r -> scene.time.end);
                return;
            }
    }
}

/* --- criteria --- */

/* Each kind reads one of the bounds `above' and `distance', and the number of cells must be one
 * that a rank can hold (CELLS_MOST of criteria.c). */
static void check_criteria(const struct run *r, const struct sph_params *used,
                           const struct apr_params *prm, struct faults *f)
{
    for (int k = 0; k < prm->criteria.n; k++) {
        const struct apr_criterion *is = prm->criteria.of + k;
        const bool surface = is->kind == CRITERION_SURFACE;
        if (!surface && is->above <= 0.0)
            params_fault(r->params, f, key_text("apr.criteria.[%d].above", k),
                         "criterion %d needs `above', a bound > 0", k + 1);
        const char *key = key_text("apr.criteria.[%d].kind", k);
        if (surface && used->surface != SURFACE_YES)
            params_fault(r->params, f, key, "the scene has no free surface");
        if (is->kind == CRITERION_JUMP && !sph_params_is_riemann(used->scheme))
            params_fault(r->params, f, key, "only the Riemann schemes reconstruct pressures");
    }
    double cells = 1.0;
    for (int a = 0; a < r->scene.domain.dim && prm->criteria.n > 0; a++)
        cells *= ceil((used->box[1][a] - used->box[0][a]) /
                      ldexp(used->R_dx * used->dx, 1 - prm->levels));
    if (cells > 3.3e7)
        params_fault(
            r->params, f, "apr.criteria",
            "%.2g cells of R = %.3g m in the domain are too many for criteria: fewer levels", cells,
            ldexp(used->R_dx * used->dx, 1 - prm->levels));
}

/* n: particles that are there without criteria; the budget must leave them something. */
void regions_check_budget(const struct run *r, double n, struct faults *f)
{
    const struct apr_params *prm = apr_params_of(r);
    const double least = n / CRITERIA_SHARE;
    if (prm && prm->criteria.n > 0 && prm->particles > 0.0 && prm->particles <= least)
        params_fault(r->params, f, "apr.particles",
                     "level 0 and the regions of the case hold about %.0f particles already, so "
                     "criteria could refine nothing within %.0f: give well above %.0f",
                     n, prm->particles, least);
}

/* --- all --- */

/* Nesting and motion need the regions and are checked later. */
static void check_region(struct check *c)
{
    if (c->is->shape < REGION_BODY)
        check_box_and_ball(c);
    else
        check_shell(c);
    if (moves(c->is))
        check_motion_keys(c);
}

/* Each region by itself, then all together, which wants sound ones. */
void regions_check(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct apr_params *prm = apr_params_of(r);
    const int before = f->n;
    if (!prm) {
        if (params_has_group(r->params, "apr") && !params_given(r->params, "apr.regions"))
            params_fault(r->params, f, "apr",
                         "neither regions nor criteria: nothing would be refined; leave the group "
                         "out, or give one of them (regions = () for a run without)");
        return;
    }
    struct check c = {.r = r, .used = used, .prm = prm, .f = f, .dim = r->scene.domain.dim};
    check_levels(r, prm, f);
    check_criteria(r, used, prm, f);
    for (c.k = 0; c.k < prm->regions.n; c.k++) {
        c.is = prm->regions.of + c.k;
        if (c.is->level <= prm->levels)
            check_region(&c);
    }
    if (f->n > before)
        return;
    struct regions *g = regions_create(r, used);
    for (c.k = 0; c.k < prm->regions.n; c.k++) {
        c.is = prm->regions.of + c.k;
        check_nesting(&c, g);
        check_motion(&c, g);
    }
    check_open_sides(r, used, g, f);
    DROP(g);
}

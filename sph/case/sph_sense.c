/* sph_sense.c - see sph_sense.h: open sides, boxes, gauges and gravity that contradict each other.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_sense.h"

#include "../bodies/sph_bodies.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "first_lattice.h"

static bool is_pressure(const struct scene_wall *w)
{
    return w && (w->kind == WALL_OUTFLOW || w->kind == WALL_ABSORBING);
}

/* Something that a stream along it must pass by: friction or the drag of a body. */
static bool something_holds(const struct scene *c)
{
    bool any = scene_has_lines(c);
    for (int k = 0; k < c->nwalls; k++)
        any = any || (c->walls[k].kind == WALL_NO_SLIP && c->fluid.nu > 0.0);
    return any;
}

/* An outlet has one pressure; a column along it has not. */
static void check_outlet(const struct run *r, int side, struct faults *f)
{
    const struct scene *c = &r->scene;
    const struct scene_wall *w = scene_wall_of(c, SIDE_X_MIN + side);
    double still[3], rise = 0.0;
    if (!is_pressure(w))
        return;
    scene_still_gravity(c, still);
    for (int a = 0; a < c->domain.dim; a++)
        if (a != side / 2)
            rise += c->fluid.rho * fabs(still[a]) * (c->domain.max[a] - c->domain.min[a]);
    if (rise > 0.0)
        params_fault(r->params, f, key_text("walls.[%d].pressure", (int)(w - c->walls)),
                     "one pressure all over this side, where gravity requires %g Pa more at its "
                     "bottom than at its top: leave fluid.gravity out, which without a free "
                     "surface only adds the weight of the column to the pressure",
                     rise);
}

/* A fall of pressure and weight between two open ends that nothing resists. */
static void check_ends(const struct run *r, int a, struct faults *f)
{
    const struct scene *c = &r->scene;
    const struct scene_wall *low = scene_wall_of(c, SIDE_X_MIN + 2 * a);
    const struct scene_wall *high = scene_wall_of(c, SIDE_X_MIN + 2 * a + 1);
    const double weight =
        c->fluid.rho * c->fluid.gravity[a] * (c->domain.max[a] - c->domain.min[a]);
    if (weight == 0.0 || !is_pressure(low) || !is_pressure(high) || something_holds(c))
        return;
    if (fabs(high->pressure - low->pressure - weight) > 0.01 * fabs(weight))
        params_fault(r->params, f, "fluid.gravity",
                     "drives the fluid through the open ends %s and %s for ever, nothing holds it: "
                     "let their pressures differ by %g Pa, or make one of them an inflow",
                     scene_side_names[2 * a], scene_side_names[2 * a + 1], weight);
}

/* Under a free surface the water outside stands at a level, against gravity along one axis. */
static void check_level(const struct run *r, int k, struct faults *f)
{
    const struct scene_wall *w = r->scene.walls + k;
    const int up = scene_still_axis(&r->scene);
    double still[3];
    const double g = scene_still_gravity(&r->scene, still);
    const char *key = key_text("walls.[%d].kind", k);
    const char *instead = w->kind == WALL_INFLOW
                              ? "; a jet is a shape of water with a velocity"
                              : ". Water leaves by a side that the case does not name";
    if (up < 0)
        params_fault(r->params, f, key,
                     "inlets and outlets under a free surface need gravity along one axis; "
                     "shapes mean a free surface: leave them out where the fluid fills the "
                     "domain%s",
                     instead);
    else if ((w->side - SIDE_X_MIN) / 2 == up)
        params_fault(
            r->params, f, key,
            "gravity crosses this side: under a free surface inlets and outlets are upright, "
            "on the sides whose water has a level%s",
            instead);
    else if (fabs(still[up]) < (1.0 - 1e-9) * g)
        params_fault(r->params, f, key,
                     "the water of a tank that leans has no level beside an opening; gravity gives "
                     "the slope of a channel where no closed side stands at its other end");
    else if (w->kind == WALL_ABSORBING)
        params_fault(
            r->params, f, key,
            "absorbing is for sound in full channels: under a free surface give an outflow "
            "a level, which lets waves of the water out");
}

/* Whether the line from p to q has a part that lies in a side of a 3D domain, further than `near'
 * from the side's own edges. */
static bool runs_within(const struct scene_domain *d, int side, const double *p, const double *q,
                        double near)
{
    double from = 0.0, to = 1.0;
    for (int t = 0; t < 3; t++) {
        const double lo = d->min[t] + near - p[t], hi = d->max[t] - near - p[t];
        const double way = q[t] - p[t];
        if (t == side / 2)
            continue;
        if (way == 0.0 && (lo > 0.0 || hi < 0.0))
            return false;
        if (way != 0.0) {
            from = fmax(from, fmin(lo / way, hi / way));
            to = fmin(to, fmax(lo / way, hi / way));
        }
    }
    return from < to;
}

/* The same of a triangle of a mesh, cut a hair within the side, where meshes that end on it do. */
static bool crosses_side(const struct scene_domain *d, int side, const struct trimesh *m, int k,
                         double near)
{
    const int a = side / 2;
    const double hair = 1e-6 * near;
    double cut[2][3];
    return trimesh_cut(m, k, a, side % 2 ? d->max[a] - hair : d->min[a] + hair, cut) &&
           runs_within(d, side, cut[0], cut[1], near);
}

/* In 3D a parabola spans the whole side, which is no profile of an opening that meshes cut out. */
static void check_profile(const struct run *r, const struct sph_params *used, int wall,
                          struct faults *f)
{
    const struct scene *c = &r->scene;
    const struct scene_wall *w = c->walls + wall;
    if (w->kind != WALL_INFLOW || w->profile != PROFILE_PARABOLIC || !c->meshes)
        return;
    for (int k = 0; k < c->meshes->n; k++) {
        const struct scene_mesh *m = c->meshes->of + k;
        for (int t = 0; m->owner != MESH_OF_SHAPE && t < m->mesh.ntriangles; t++) {
            if (!crosses_side(&c->domain, w->side - SIDE_X_MIN, &m->mesh, t, 0.5 * used->dx))
                continue;
            params_fault(r->params, f, key_text("walls.[%d].profile", wall),
                         "parabolic in 3D spans the whole side, through which mesh %s cuts: take "
                         "the uniform profile, with the mean velocity",
                         m->name);
            return;
        }
    }
}

/* What faces hold, and the lattice that stands for the flow behind them, is seen through a mesh
 * that is thin: the half of a duct behind a splitter that went through the opening lost its
 * particles, and the run ended after 0.5 s. */
static void check_sheets(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    double lo[3], hi[3];
    if (used->outer == OUTER_NONE || c->domain.dim < 3 || !c->meshes)
        return;
    zones_free_box(r, used, lo, hi);
    for (int k = 0; k < c->meshes->n; k++) {
        const struct scene_mesh *m = c->meshes->of + k;
        const bool thin = m->owner == MESH_OF_WALL && scene_mesh_thin(c, m);
        bool out = false, within = true;
        for (int a = 0; a < 3; a++) {
            out = out || (lo[a] > used->box[0][a] && m->lo[a] < lo[a]) ||
                  (hi[a] < used->box[1][a] && m->hi[a] > hi[a]);
            within = within && m->lo[a] < used->box[1][a] && m->hi[a] > used->box[0][a];
        }
        if (thin && out && within)
            params_fault(r->params, f, key_text("walls.[%d].thin", m->index),
                         "%s reaches into the zone of an open side, which does not know of thin "
                         "meshes: let it end within (%g, %g, %g) to (%g, %g, %g) m, or make it a "
                         "solid of 0.7 sph.R_dx sph.dx = %.2g m",
                         m->name, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2],
                         0.7 * used->R_dx * used->dx);
    }
}

/* Under a surface levels are given, in full channels pressures. */
static void check_openings(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    const bool surface = used->surface == SURFACE_YES;
    for (int k = 0; k < c->nwalls; k++)
        if (surface && scene_wall_opens(c->walls + k))
            check_level(r, k, f);
    for (int k = 0; k < c->nwalls && c->domain.dim == 3 && !surface; k++)
        check_profile(r, used, k, f);
    for (int side = 0; side < 2 * c->domain.dim && !surface; side++)
        check_outlet(r, side, f);
    for (int a = 0; a < c->domain.dim && !surface; a++)
        check_ends(r, a, f);
}

/* A closed line whose fluid is around it. */
static bool is_island(const struct scene_wall *w)
{
    const struct line l = line_of(&w->points, true);
    return w->side == SIDE_NONE && w->closed && line_area(&l) < 0.0;
}

/* Walls that may hold the fluid in the domain: all lines but islands, meshes that have it inside.
 */
static bool has_tank(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_mesh *m = scene_mesh_of(c, MESH_OF_WALL, k);
        const bool holds = m ? m->fluid_side == FLUID_INSIDE : !is_island(c->walls + k);
        any = any || (c->walls[k].side == SIDE_NONE && holds);
    }
    return any;
}

/* Whether the shapes let water go on through a closed line: the middle of a face, a little inside.
 */
static bool has_water_inside(const struct scene *c, const struct scene_wall *w)
{
    const struct exact e = exact_create(c);
    const struct line l = line_of(&w->points, true);
    bool any = false;
    for (int i = 0; i < line_segments(&l); i++) {
        const double *a = l.x[i], *b = l.x[(i + 1) % l.n], off = 1e-3;
        const double x[3] = {0.5 * (a[0] + b[0]) + off * (b[1] - a[1]),
                             0.5 * (a[1] + b[1]) - off * (b[0] - a[0]), 0.0};
        any = any || scene_is_fluid(c, &e, x, NULL);
    }
    return any;
}

/* Water inside and around a closed line that runs clockwise, and nothing else that holds it: meant
 * is a tank, but nothing in the scene says so. */
static void check_islands(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    bool held = has_tank(c) || used->outer == OUTER_EXACT || used->outer == OUTER_PARTNER;
    for (int side = 0; side < 2 * c->domain.dim; side++)
        held = held || c->domain.periodic[side / 2] || scene_wall_of(c, SIDE_X_MIN + side);
    for (int k = 0; k < c->nwalls && !held; k++)
        if (is_island(c->walls + k) && has_water_inside(c, c->walls + k)) {
            params_fault(r->params, f, key_text("walls.[%d].points", k),
                         "clockwise, so its fluid is outside, where no wall and no period holds "
                         "it: the corners of a tank run counter-clockwise");
        }
}

/* Whether a tank that is a closed line reaches beyond a side of the plane domain, with fluid there:
 * at some place of the side well inside it, off all lines by dx; x: the first. */
static bool cuts_tank(const struct scene *c, int side, double dx, double x[3])
{
    const struct exact e = exact_create(c);
    const int a = side / 2, b = 1 - a;
    const double from = c->domain.min[b], to = c->domain.max[b];
    const int n = (int)fmin(1e5, ceil((to - from) / dx));
    for (int i = 0; i < n; i++) {
        bool inside = false, near = false;
        x[a] = side % 2 ? c->domain.max[a] : c->domain.min[a];
        x[b] = from + (i + 0.5) / n * (to - from);
        x[2] = 0.0;
        for (int k = 0; k < c->nwalls; k++) {
            const struct line l = line_of(&c->walls[k].points, c->walls[k].closed);
            near = near || (l.n > 1 && line_distance(&l, x) < dx);
            inside = inside || (c->walls[k].closed && line_area(&l) > 0.0 && line_inside(&l, x));
        }
        if (inside && !near && scene_is_room(c, x) && scene_is_fluid(c, &e, x, NULL))
            return true;
    }
    return false;
}

/* The same of a tank of open lines and other sides: fluid fills what does not lie behind them. */
static bool cuts_channel(const struct scene *c, const struct sph_params *used, int side,
                         double x[3])
{
    enum { PLACES = 64 };
    const int a = side / 2, b = 1 - a;
    const double *lo = c->domain.min, *hi = c->domain.max;
    for (int k = 0; k < c->nwalls; k++)
        if (c->walls[k].closed)
            return false;
    double wet[PLACES][2];
    int n = 0;
    for (int i = 0; i < PLACES; i++) {
        double least = INFINITY;
        x[a] = side % 2 ? hi[a] - 0.5 * used->dx : lo[a] + 0.5 * used->dx;
        x[b] = lo[b] + (i + 0.5) / PLACES * (hi[b] - lo[b]);
        x[2] = 0.0;
        for (int k = 0; k < c->nwalls; k++) {
            const struct line l = line_of(&c->walls[k].points, false);
            least = l.n > 1 ? fmin(least, line_distance(&l, x)) : least;
        }
        if (least > 1.5 * used->dx && scene_is_room(c, x))
            memcpy(wet[n++], x, sizeof wet[0]);
    }
    const int open = n > 0 ? body_backs_first_open(c, used, n, (const double(*)[2])wet) : 0;
    if (open == n)
        return false;
    memcpy(x, wet[open], sizeof wet[0]);
    x[a] = side % 2 ? hi[a] : lo[a];
    return true;
}

/* Fluid that fills the domain up to a side where nothing is. */
static void check_bare(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    const bool tank = has_tank(c), plane = c->domain.dim == 2;
    double x[3];
    if (used->outer == OUTER_EXACT || used->outer == OUTER_PARTNER)
        return;
    for (int side = 0; side < 2 * c->domain.dim; side++) {
        if (c->domain.periodic[side / 2] || scene_wall_of(c, SIDE_X_MIN + side))
            continue;
        if (!tank && used->surface != SURFACE_YES)
            params_fault(r->params, f, "domain",
                         "the fluid fills it up to its side %s, which is open: give this side a "
                         "wall, an outflow or a period; or say by shapes where the fluid ends",
                         scene_side_names[side]);
        else if (tank && plane && c->nshapes == 0 && cuts_tank(c, side, used->dx, x))
            params_fault(r->params, f, "domain",
                         "its side %s, which is open, cuts the tank at (%g, %g), where fluid is: "
                         "make the domain larger than the tank, or give this side a wall, an "
                         "outflow or a period",
                         scene_side_names[side], x[0], x[1]);
        else if (tank && plane && used->surface != SURFACE_YES && c->nshapes == 0 &&
                 sph_params_reaches(&c->domain, used, side) && cuts_channel(c, used, side, x))
            params_fault(r->params, f, "domain",
                         "its side %s, which is open, has fluid at (%g, %g), which lies behind no "
                         "line: give this side a wall, an outflow or a period; or reverse a line "
                         "that has the fluid on its right; or say by shapes where the fluid ends",
                         scene_side_names[side], x[0], x[1]);
    }
}

/* Gravity along a period that meets no resistance. */
static void check_falls(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    for (int a = 0; a < c->domain.dim; a++)
        if (c->domain.periodic[a] && c->fluid.gravity[a] != 0.0 && used->surface != SURFACE_YES &&
            !something_holds(c))
            params_fault(r->params, f, "fluid.gravity",
                         "%g m/s^2 along the periodic %c: the fluid would fall for ever, nothing "
                         "holds it (a no-slip wall with fluid.nu, a body)",
                         c->fluid.gravity[a], "xyz"[a]);
}

/* --- the box --- */

/* A surface crosses the sides of a box where a partner or a wave has one outside; else the box
 * holds all of it. */
static void check_box(const struct run *r, const struct sph_params *given,
                      const struct sph_params *used, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const bool by_free = given->free[0][0] != given->free[1][0];
    const char *key = by_free ? "sph.free" : "sph.box";
    double still[3];
    const double g = scene_still_gravity(&r->scene, still);
    for (int a = 0; a < d->dim; a++) {
        const bool low = sph_params_reaches(d, used, 2 * a);
        const bool high = sph_params_reaches(d, used, 2 * a + 1);
        const double *free = given->free[0], *end = given->free[1];
        if (by_free && !d->periodic[a] &&
            (free[a] < d->min[a] - 1e-6 * used->dx || end[a] > d->max[a] + 1e-6 * used->dx))
            params_fault(r->params, f, key,
                         "%c from %g to %g m is not inside the domain, %g to %g m", "xyz"[a],
                         free[a], end[a], d -> min[a], d -> max[a]);
        if (used->surface != SURFACE_YES || (low && high))
            continue;
        if (r->crossed)
            continue; /* the partner has a surface, too */
        if (wave_outside_wanted(r, used) && fabs(still[a]) < 0.5 * g)
            continue; /* so has the wave */
        if (g > 0.0 && fabs(still[a]) < 0.5 * g)
            params_fault(r->params, f, key,
                         "ends at %c = %g m under a free surface, which it would have to cross "
                         "upright: let it span the whole of %c",
                         "xyz"[a], low ? used->box[1][a] : used->box[0][a], "xyz"[a]);
        else if (g > 0.0 && !(still[a] < 0.0 ? high : low))
            params_fault(r->params, f, key,
                         "must hold the free surface: let it reach the side %s of the domain",
                         scene_side_names[2 * a + (still[a] < 0.0)]);
    }
}

/* A flow outside that the field does not know at all times. */
static void check_outer(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    double g = 0.0;
    for (int a = 0; a < 3; a++)
        g += fabs(c->fluid.gravity[a]);
    const bool rest = c->initial.field == FIELD_REST && g == 0.0;
    if (used->outer == OUTER_EXACT && sph_params_zones(r, used) && !rest && !exact_at_all_times(c))
        params_fault(r->params, f, "sph.outer",
                     "no exact solution is known around the particles at all times: initial.field "
                     "has none in this scene. Leave the box out, or couple with fv");
    const double k = 2.0 * M_PI / scene_wave_length(c);
    const double lost = 1.0 - exp(-2.0 * c->fluid.nu * k * k * c->time.end);
    if (wave_outside_wanted(r, used) && lost > 0.01)
        params_fault(r->params, f, "fluid.nu",
                     "the wave around the particles knows no friction, which takes %.2g of its "
                     "height within the run: leave it out, or couple with fv",
                     lost);
}

/* --- the rest --- */

/* A gauge that moves along is fixed to one of these. */
static bool moves_by_name(const struct scene *c, const char *name)
{
    bool any = false;
    for (int k = 0; k < c->nbodies; k++)
        any = any || (strcmp(c->bodies[k].name, name) == 0 && scene_body_moves(c->bodies + k));
    return any;
}

/* Columns of levels go along the axis with most of gravity; beaches are read over y. */
static void check_gauges(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    double g[3];
    (void)scene_still_gravity(c, g);
    for (int k = 0; k < c->nprobes; k++) {
        if (c->probes[k].body[0] && !moves_by_name(c, c->probes[k].body))
            params_fault(r->params, f, key_text("probes.[%d].body", k), "%s: no body `%s' moves",
                         c->probes[k].name, c->probes[k].body);
        const char *key = key_text("probes.[%d].kind", k);
        const int kind = c->probes[k].kind;
        if ((kind == PROBE_LEVEL || kind == PROBE_SHORE) && used->surface != SURFACE_YES)
            params_fault(r->params, f, key, PROBE_NO_SURFACE, c->probes[k].name);
        else if (kind == PROBE_SHORE && (g[0] != 0.0 || !(g[1] < 0.0)))
            params_fault(r->params, f, key, "%s: a shore is read where gravity points along -y",
                         c->probes[k].name);
    }
}

/* Whether x is more than dx behind the lines, and which open one is nearest. */
static bool is_behind(const struct scene *c, const double *x, double dx, int *nearest)
{
    double least = INFINITY;
    for (int m = 0; m < c->nwalls; m++) {
        const struct line l = line_of(&c->walls[m].points, false);
        const double far = l.n > 1 && !c->walls[m].closed ? line_distance(&l, x) : INFINITY;
        if (far < least)
            *nearest = m;
        least = fmin(least, far);
    }
    return least > dx && isfinite(least) && scene_is_behind_lines(c, x);
}

/* Gauges behind walls, where no fluid ever is; those on a wall may lie a little behind. */
static void check_hidden(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    for (int k = 0; k < c->nprobes; k++) {
        const double *at = c->probes[k].at;
        int behind = -1;
        if (!probe_is_point(c->probes + k))
            continue;
        if (c->domain.dim == 2 && !is_behind(c, at, used->dx, &behind))
            behind = -1;
        for (int m = 0; m < c->nwalls; m++) {
            const struct line l = line_of(&c->walls[m].points, true);
            if (c->walls[m].closed && line_inside(&l, at) != (line_area(&l) > 0.0) &&
                line_distance(&l, at) > used->dx)
                behind = m;
        }
        if (behind >= 0)
            params_fault(r->params, f, key_text("probes.[%d].at", k),
                         "%s is behind wall %d: put it before it", c->probes[k].name, behind + 1);
    }
}

/* As fill.c lays the lattice. */
static void check_grains(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    double lo[3], hi[3], first[3], h[3] = {used->dx, used->dx, used->dx};
    bool periodic[3];
    int n[3] = {1, 1, 1};
    sph_params_region(&c->domain, used, lo, hi, periodic);
    for (int a = 0; a < c->domain.dim; a++) {
        const double cells = (hi[a] - lo[a]) / used->dx;
        if (!(cells < 1e9))
            return; /* a fault of its own */
        n[a] = (int)first_lattice_cells(lo[a], hi[a], used->dx);
        first[a] = first_lattice_begin(c, a, lo[a], hi[a], used->dx) + 0.5 * used->dx;
    }
    scene_check_grains(c, r->params, first, h, n, "place of a particle", f);
}

void sph_passage_warn(const char *where, double width, double dx)
{
    const double n = width / dx;
    log_warn(
        "%s, %.2g particles across: of a flow through there some %.0f %% are missing; sph.dx = "
        "%.2g m has ten particles there, and 10 %%",
        where, n, fmin(90.0, 1000.0 / (n * n)), digits_below(width / SPH_PASSAGE, 2));
}

void sph_sense_check(const struct run *r, const struct sph_params *given,
                     const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    if (c->initial.U <= 0.0)
        params_fault(r->params, f, "initial.U",
                     "0 m/s: shifting, packing and drifts are measured in it, give the largest "
                     "speed that is expected");
    if (given->extrema[0] == 0.0 && (given->extrema[1] != 0.0 || given->extrema[2] != 0.0))
        params_fault(r->params, f, "sph.extrema", "the first is 0: give all three");
    check_box(r, given, used, f);
    check_hidden(r, used, f);
    check_gauges(r, used, f);
    if (c->has_fv)
        return; /* the flow around is the partner's */
    check_openings(r, used, f);
    check_sheets(r, used, f);
    const int before = f->n;
    check_islands(r, used, f);
    if (f->n == before)
        check_bare(r, used, f);
    check_falls(r, used, f);
    check_grains(r, used, f);
    check_outer(r, used, f);
}

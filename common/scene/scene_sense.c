/* scene_sense.c - what is wrong with a scene whose keys are each in order: surfaces that its
 * dimensions do not have, lines that are none, walls that pump, water outside the domain.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "scene_check.h"
#include "scene_fluid.h"
#include "scene_geometry.h"
#include "scene_probe.h"
#include "scene_speed.h"

/* Triangles bound a fluid of three dimensions, outlines one of two. */
static void check_surface(const struct scene *s, const struct params *p, struct faults *f,
                          const char *group, int k, const struct scene_surface *is)
{
    if (*is->mesh && s->domain.dim == 2)
        params_fault(p, f, key_text("%s.[%d].mesh", group, k),
                     "a surface of triangles bounds a fluid of 3 dimensions: in the "
                     "plane give points");
    if (*is->outline && s->domain.dim == 3)
        params_fault(p, f, key_text("%s.[%d].outline", group, k),
                     "an outline bounds a fluid of 2 dimensions: in space give a mesh");
    if (s->domain.dim == 2 && (is->rotate[0] != 0.0 || is->rotate[1] != 0.0))
        params_fault(p, f, key_text("%s.[%d].rotate", group, k),
                     "out of the plane in a case of 2 dimensions: it turns about z, as in (0, 0, "
                     "30)");
}

static void check_surfaces(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nwalls; k++)
        check_surface(s, p, f, "walls", k, &s->walls[k].surface);
    for (int k = 0; k < s->nbodies; k++)
        check_surface(s, p, f, "bodies", k, &s->bodies[k].surface);
    for (int k = 0; k < s->nshapes; k++)
        check_surface(s, p, f, "shapes", k, &s->shapes[k].surface);
}

void scene_check_motion(const struct scene_motions *all, const char *list, int k,
                        const struct params *p, struct faults *f)
{
    for (int i = 0; i < all->n; i++) {
        const char *key = key_text("%s.[%d].motion.[%d].kind", list, k, i);
        if (all->of[i].kind == MOTION_WAVES)
            params_fault(p, f, key, "only the motion of a body makes waves");
        if (all->of[i].kind >= MOTION_PARTNER)
            params_fault(p, f, key, "a partner moves bodies alone: give another kind of motion");
    }
}

/* --- lines --- */

static void check_line(const struct params *p, struct faults *f, const char *group, int k,
                       const struct param_points *points, bool closed)
{
    static const char *const what[] = {
        "", "the same point twice in a row: leave one out",
        "encloses no area: its points lie on one straight line",
        "runs back over itself: a wall needs a thickness",
        "crosses or touches itself: order the points along the outline, or make two lines of it"};
    struct line l = line_of(points, closed);
    double at[2];
    if (l.n < (closed ? 3 : 2))
        return; /* said elsewhere */
    line_trim(&l);
    const enum line_fault is = line_check(&l, at);
    if (is)
        params_fault(p, f, key_text("%s.[%d].points", group, k), "at (%g, %g) m: %s", at[0], at[1],
                     what[is]);
}

static void check_lines(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].side == SIDE_NONE)
            check_line(p, f, "walls", k, &s->walls[k].points, s->walls[k].closed);
    for (int k = 0; k < s->nbodies; k++) {
        check_line(p, f, "bodies", k, &s->bodies[k].points, true);
        check_line(p, f, "bodies", k, &s->bodies[k].section, true);
    }
    for (int k = 0; k < s->nshapes; k++)
        if (s->shapes[k].form == SHAPE_POLYGON)
            check_line(p, f, "shapes", k, &s->shapes[k].points, true);
}

/* --- walls --- */

/* Velocity of a wall across itself; n: unit normal of a side. */
static void check_pumping(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_wall *w = s->walls + k;
    const double *u = w->velocity, size = vec3_length(u);
    double across = 0.0;
    if (w->side != SIDE_NONE)
        across = fabs(u[(w->side - SIDE_X_MIN) / 2]);
    const struct line l = line_of(&w->points, w->closed);
    for (int i = 0; w->side == SIDE_NONE && i < line_segments(&l); i++) {
        const double *a = l.x[i], *b = l.x[(i + 1) % l.n];
        const double d[2] = {b[0] - a[0], b[1] - a[1]};
        across = fmax(across, fabs(u[0] * d[1] - u[1] * d[0]) / hypot(d[0], d[1]));
    }
    if (across > 1e-6 * size)
        params_fault(
            p, f, key_text("walls.[%d].velocity", k),
            "%g m/s across the wall, which stays where it is: it would pump fluid through. "
            "Give the part along it; what moves is a body, what lets in is an inflow",
            across);
}

/* Of an inflow that nothing is given of, or the wrong way; of a pressure its row tells. Sides of
 * blocks may take the initial velocity instead. */
static void check_inflow(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_wall *w = s->walls + k;
    if (w->kind != WALL_INFLOW || w->side == SIDE_NONE || w->has_level || w->has_discharge ||
        params_given(p, "blocks") || (w->pressure != 0.0 && vec3_length(w->velocity) == 0.0))
        return;
    const int a = (w->side - SIDE_X_MIN) / 2;
    const double in = (w->side - SIDE_X_MIN) % 2 ? -w->velocity[a] : w->velocity[a];
    if (in == 0.0 || (in < 0.0 && !s->has_fv)) /* fv takes out what is given, without a surface */
        params_fault(p, f, key_text("walls.[%d].velocity", k),
                     "an inflow of %g m/s along %c lets nothing in: give it a velocity into the "
                     "domain%s",
                     w->velocity[a], "xyz"[a],
                     scene_has_surface(s) ? ", a discharge or a level" : "");
}

static void check_openings(const struct scene *s, const struct params *p, struct faults *f)
{
    int in = -1;
    bool out = scene_has_surface(s); /* under one the level rises */
    for (int side = SIDE_X_MIN; side < SIDE_X_MIN + 2 * s->domain.dim; side++) {
        const struct scene_wall *w = scene_wall_of(s, (enum scene_side)side);
        if (w && w->kind == WALL_INFLOW)
            in = (int)(w - s->walls);
        /* what a side without a wall is, only the solver knows */
        out = out || (w ? w->kind > WALL_INFLOW : !s->domain.periodic[(side - SIDE_X_MIN) / 2]);
    }
    if (in >= 0 && !out)
        params_fault(p, f, key_text("walls.[%d].kind", in),
                     "inflow into a closed box: give another side the kind outflow or absorbing");
}

static void check_walls(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind == WALL_NO_SLIP)
            check_pumping(s, p, f, k);
    for (int k = 0; k < s->nwalls; k++)
        check_inflow(s, p, f, k);
    check_openings(s, p, f);
}

/* --- water --- */

static void check_shape(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    static const char axes[] = "xyz";
    const struct scene_shape *h = s->shapes + k;
    const struct scene_domain *d = &s->domain;
    double lo[3], hi[3], low, high, still[3];
    const double g = scene_still_gravity(s, still);
    const char *key = key_text("shapes.[%d]", k);
    if (h->hole && k == 0)
        params_fault(p, f, key,
                     "a hole takes fluid out of the shapes before it, and there is none");
    scene_heights(s, &low, &high);
    if (h->form == SHAPE_BELOW && (h->level <= low || h->level > high + 1e-9 * (high - low)))
        params_fault(p, f, key, "level %g m is not in the domain, whose heights are %g to %g m%s",
                     h->level, low, high,
                     h->level > high ? ": raise domain.max, or lower the level" : "");
    scene_shape_extent(h, lo, hi);
    for (int a = 0; a < d->dim; a++) {
        const double size = 1e-6 * (d->max[a] - d->min[a]);
        const int up = still[a] <= -0.7 * g ? 1 : still[a] >= 0.7 * g ? -1 : 0;
        const double top = up > 0 ? hi[a] : lo[a], roof = up > 0 ? d->max[a] : d->min[a];
        if (hi[a] <= d->min[a] || lo[a] >= d->max[a])
            params_fault(p, f, key,
                         "lies outside the domain: %c from %g to %g m, domain %g to %g m", axes[a],
                         lo[a], hi[a], d->min[a], d->max[a]);
        else if (!h->hole && g > 0.0 && isfinite(top) && up * (top - roof) > size)
            params_fault(p, f, key,
                         "its water stands above the domain: %c up to %g m, domain to %g m: move "
                         "domain.%s, or end the shape there",
                         axes[a], top, roof, up > 0 ? "max" : "min");
    }
}

/* Whether some shape is what shape k is, moved by `way' along axis a. */
static bool has_image(const struct scene *s, int k, int a, double way)
{
    double lo[3], hi[3], other_lo[3], other_hi[3];
    bool any = false;
    scene_shape_extent(s->shapes + k, lo, hi);
    for (int l = 0; l < s->nshapes; l++) {
        scene_shape_extent(s->shapes + l, other_lo, other_hi);
        bool same =
            s->shapes[l].form == s->shapes[k].form && s->shapes[l].hole == s->shapes[k].hole;
        for (int b = 0; b < s->domain.dim; b++) {
            const double off = b == a ? way : 0.0, near = 1e-4 * fabs(way);
            same = same && fabs(other_lo[b] - lo[b] - off) < near &&
                   fabs(other_hi[b] - hi[b] - off) < near;
        }
        any = any || same;
    }
    return any;
}

/* Shapes have no images: what of one lies beyond a period is cut off, unless it is drawn a second
 * time. One as long as the period has all of it. */
static void check_shape_periods(const struct scene *s, int k)
{
    const struct scene_domain *d = &s->domain;
    double lo[3], hi[3];
    scene_shape_extent(s->shapes + k, lo, hi);
    for (int a = 0; a < d->dim; a++) {
        const double L = d->max[a] - d->min[a], low = d->min[a] - lo[a], high = hi[a] - d->max[a];
        const double most = fmax(low, high), way = low > high ? L : -L;
        if (d->periodic[a] && most > 1e-3 * L && hi[a] - lo[a] < (1.0 - 1e-6) * L &&
            !has_image(s, k, a, way))
            log_warn("shape %d reaches %g m beyond the periodic side %s and is cut off there: draw "
                     "it a second time, %g m along %c from it",
                     k + 1, most, scene_side_names[2 * a + (low <= high)], way, "xyz"[a]);
    }
}

/* Whether anything can ever set the fluid in motion. */
static bool is_driven(const struct scene *s)
{
    bool any = s->fluid.central != 0.0 || s->initial.field != FIELD_REST || scene_shapes_flow(s);
    for (int k = 0; k < s->nbodies; k++)
        any = any || scene_body_moves(s->bodies + k);
    for (int a = 0; a < 3; a++)
        any = any || s->fluid.gravity[a] != 0.0;
    for (int k = 0; k < s->nwalls; k++)
        for (int a = 0; a < 3; a++)
            any = any || s->walls[k].velocity[a] != 0.0 || s->walls[k].kind >= WALL_INFLOW;
    return any;
}

static void check_water(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nshapes; k++) {
        check_shape(s, p, f, k);
        check_shape_periods(s, k);
    }
    if (s->nshapes > 0 && !is_driven(s))
        params_fault(p, f, "fluid.gravity",
                     "a free surface, and nothing that moves the fluid: give gravity, "
                     "fluid.central, or a shape its velocity");
    for (int a = 0; a < s->domain.dim; a++)
        if (s->fluid.central > 0.0 && s->domain.periodic[a])
            params_fault(p, f, "fluid.central",
                         "its force -W^2 x jumps at a periodic side: take domain.periodic away");
}

/* --- gauges --- */

/* That the domain has the section, and a period no more than once. */
static void check_section(const struct scene *s, const struct params *p, int k, struct faults *f)
{
    const struct scene_probe *g = s->probes + k;
    const struct scene_domain *d = &s->domain;
    for (int a = 0; a < d->dim; a++) {
        const double lo = fmin(g->at[a], g->to[a]), hi = fmax(g->at[a], g->to[a]);
        const double near = 1e-6 * (d->max[a] - d->min[a]);
        const bool is_outside = hi < d->min[a] - near || lo > d->max[a] + near;
        const bool is_longer = d->periodic[a] && (lo < d->min[a] - near || hi > d->max[a] + near);
        if (is_outside || is_longer)
            params_fault(p, f, key_text("probes.[%d].at", k),
                         "%s: its section, %c from %g to %g m, %s, %g to %g m", g->name, "xyz"[a],
                         lo, hi,
                         is_outside ? "lies outside the domain" : "reaches beyond the period",
                         d->min[a], d->max[a]);
    }
}

/* A discharge goes through a line, in 3D through a rectangle across an axis. */
static void check_discharge(const struct scene *s, const struct params *p, int k, struct faults *f)
{
    const struct scene_probe *g = s->probes + k;
    int same = 0;
    for (int a = 0; a < s->domain.dim; a++)
        same += g->at[a] == g->to[a];
    const char *key = key_text("probes.[%d].to", k);
    if (g->kind != PROBE_DISCHARGE)
        return;
    if (!params_given(p, key))
        params_fault(p, f, key, "%s: must be given: the other end of its section", g->name);
    else if (s->domain.dim == 2 ? same == 2 : same != 1)
        params_fault(p, f, key, "%s: %s", g->name,
                     s->domain.dim == 2
                         ? "the line has no length"
                         : "a rectangle across an axis has one coordinate in common");
    else
        check_section(s, p, k, f);
}

static void check_probes(const struct scene *s, const struct params *p, struct faults *f)
{
    const struct scene_domain *d = &s->domain;
    for (int k = 0; k < s->nprobes; k++) {
        const struct scene_probe *g = s->probes + k;
        const int axes = g->kind == PROBE_DISCHARGE ? 0 : probe_is_point(g) ? d->dim : d->dim - 1;
        check_discharge(s, p, k, f);
        const char *key = key_text("probes.[%d].at", k);
        for (int a = 0; a < axes; a++)
            if (g->at[a] < d->min[a] - 1e-6 * (d->max[a] - d->min[a]) ||
                g->at[a] > d->max[a] + 1e-6 * (d->max[a] - d->min[a])) {
                params_fault(p, f, key, "%s: %c = %g m is outside the domain, %g to %g m", g->name,
                             "xyz"[a], g -> at[a], d -> min[a], d -> max[a]);
                break;
            }
        if (g->kind == PROBE_SHORE && (!s->has_sph || d->dim == 3))
            params_fault(p, f, key, "%s: a shore is read by sph alone, in 2D", g->name);
        for (int b = 0; b < s->nbodies && probe_is_point(g); b++) {
            const struct line l = line_of(&s->bodies[b].points, true);
            const bool tank = s->bodies[b].tank;
            if (l.n > 2 && line_inside(&l, g->at) != tank &&
                line_distance(&l, g->at) > 1e-6 * line_size(&l))
                params_fault(p, f, key, "%s is %s body %s: put it on its surface", g->name,
                             tank ? "outside the tank that is" : "inside", s->bodies[b].name);
        }
        if (strcmp(g->name, "t") == 0 || strcmp(g->name, "dt") == 0)
            params_fault(p, f, key_text("probes.[%d].name", k),
                         "%s: series.csv has a column of this name already: give the "
                         "gauge another",
                         g->name);
        for (int m = 0; m < k; m++)
            if (strcmp(g->name, s->probes[m].name) == 0)
                params_fault(p, f, key_text("probes.[%d].name", k),
                             "%s is the name of gauge %d already: give this one another", g->name,
                             m + 1);
    }
}

/* Columns, restart files and lines find a body by its name. */
static void check_names(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nbodies; k++)
        for (int i = 0; i < k; i++)
            if (strcmp(s->bodies[i].name, s->bodies[k].name) == 0) {
                params_fault(p, f, key_text("bodies.[%d].name", k),
                             "bodies %d and %d are both called `%s': give each a name", i + 1,
                             k + 1, s->bodies[k].name);
                break;
            }
}

/* Water on earth in other units than SI: 981 cm/s^2, 9810 mm/s^2, 1 mm^2/s. */
static void warn_units(const struct scene *s)
{
    const double *v = s->fluid.gravity, g = vec3_length(v);
    const double nu = s->fluid.nu;
    if (fabs(g / 981.0 - 1.0) < 0.01 || fabs(g / 9810.0 - 1.0) < 0.01)
        log_warn("fluid.gravity: %g m/s^2 looks like %s/s^2: all is SI, 9.81 on earth", g,
                 g < 2000.0 ? "cm" : "mm");
    if (fabs(g / 9.81 - 1.0) < 0.01 && fabs(s->fluid.rho / 1000.0 - 1.0) < 0.05 && nu > 0.5 &&
        nu < 2.0)
        log_warn("fluid.nu: %g m^2/s looks like mm^2/s: all is SI, water has 1e-6", nu);
}

/* Whether the water stands below one level that all outflows have, too: given, or as it stands in
 * them. */
static bool is_level(const struct scene *s)
{
    const struct scene_shape *h = s->shapes;
    bool same = s->nshapes == 1 && h->form == SHAPE_BELOW && !h->hole && !s->has_waves &&
                s->initial.field == FIELD_REST && vec3_length(h->velocity) == 0.0;
    for (int k = 0; k < s->nwalls && same; k++) {
        const struct scene_wall *w = s->walls + k;
        if (w->kind == WALL_OUTFLOW)
            same = !w->has_discharge && !w->levels &&
                   (!w->has_level || fabs(w->level - h->level) < 1e-9 * fabs(h->level));
    }
    return same;
}

/* Openings of which none gives a flow, beside fluid that rests: they are at one pressure, or under
 * a surface at one level, and the run shows nothing. Bodies and blocks may move: they are not
 * asked. */
static void warn_rest(const struct scene *s, const struct params *p)
{
    const bool surface = scene_has_surface(s);
    int outflows = 0;
    for (int k = 0; k < s->nwalls; k++) {
        if (s->walls[k].kind == WALL_INFLOW)
            return;
        outflows += s->walls[k].kind == WALL_OUTFLOW && s->walls[k].side != SIDE_NONE;
    }
    if (outflows > 1 && (surface ? is_level(s) : !scene_speed_of(s, 0.0, 0.0).moves) &&
        s->nbodies == 0 && !params_has_group(p, "blocks") && !params_has_group(p, "coupling") &&
        vec3_length(s->initial.velocity) == 0.0)
        log_warn("walls: nothing moves: all %d openings are outflows at one %s: give one of them "
                 "another, or a %s at an inflow",
                 outflows, surface ? "level" : "pressure", surface ? "discharge" : "velocity");
}

void scene_check_sense(const struct scene *s, const struct params *p, struct faults *f)
{
    const int before = f->n;
    check_surfaces(s, p, f);
    check_lines(s, p, f);
    if (f->n > before)
        return; /* what follows needs sound lines */
    check_walls(s, p, f);
    check_water(s, p, f);
    check_probes(s, p, f);
    check_names(s, p, f);
    if (f->n == before) {
        warn_units(s);
        warn_rest(s, p);
    }
}

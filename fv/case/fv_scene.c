/* fv_scene.c - what contradicts itself in a scene on a grid of cells: refused with the reason
 * before anything runs. Blocks: mesh_scene.c. SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "fv_case.h"

static const char axes[] = "xyz";

static const struct scene_wall *wall_on(const struct scene *s, int a, int up)
{
    return scene_wall_of(s, (enum scene_side)(SIDE_X_MIN + 2 * a + up));
}

void fv_scene_complete(struct run *r)
{
    struct scene *s = &r->scene;
    double g[3];
    if (!surface_wanted(r))
        return;
    (void)scene_still_gravity(s, g);
    openings_resolve(s);
    for (int a = 0; a < s->domain.dim && mesh_given_count == 0; a++) {
        const int up = g[a] < 0.0;
        if (g[a] != 0.0 && !wall_on(s, a, up) && s->nwalls < WALLS_MAX)
            s->walls[s->nwalls++] = (struct scene_wall){.side = SIDE_X_MIN + 2 * a + up,
                                                        .kind = WALL_SLIP,
                                                        .level = LEVEL_TOP,
                                                        .assumed = true};
    }
}

void fv_scene_describe(const struct run *r)
{
    for (int k = 0; k < r->scene.nwalls; k++)
        if (r->scene.walls[k].assumed)
            log_say("%s, which has no wall, is closed by one that slips, above the air",
                    scene_side_names[r->scene.walls[k].side - SIDE_X_MIN]);
}

/* Of the k-th wall. */
static void wall_fault(const struct run *r, struct faults *f, int k, const char *what)
{
    params_fault(r->params, f, key_text("walls.[%d]", k), "wall %d: %s", k + 1, what);
}

/* --- walls and openings --- */

void fv_wall_check(const struct run *r, struct faults *f, int k)
{
    const struct scene_wall *w = r->scene.walls + k;
    const struct fv_params *prm = fv_params_of(r);
    if (w->kind == WALL_ABSORBING)
        wall_fault(r, f, k, "\"absorbing\" is not for this solver");
    if (w->zone != ZONE_NONE && prm->integrator == INTEGRATOR_NEWTON)
        wall_fault(r, f, k, "newton has no beaches and makes no waves: rk3 or bdf2 do");
    if (w->carried && (w->kind != WALL_OUTFLOW || prm->steady))
        wall_fault(r, f, k, "carried (convective outflow) is for an outflow of a run in time");
}

/* Of one wall alone, whatever the others are. */
static void check_wall(const struct run *r, struct faults *f, int k)
{
    const struct scene_wall *w = r->scene.walls + k;
    if (w->side == SIDE_NONE && !(r->coupled && r->scene.has_sph)) /* there it is the partner's */
        wall_fault(r, f, k, "a polyline is not for this solver");
    fv_wall_check(r, f, k);
    if (w->kind == WALL_NO_SLIP && !(r->scene.fluid.nu > 0.0))
        wall_fault(r, f, k,
                   "without viscosity (fluid.nu) a wall exerts no friction: kind = \"slip\", or a "
                   "viscosity");
    if (w->side == SIDE_NONE)
        return;
    const int a = (w->side - SIDE_X_MIN) / 2;
    const double *v = w->velocity;
    char text[160];
    if ((w->kind == WALL_NO_SLIP || w->kind == WALL_SLIP) && v[a] != 0.0) {
        snprintf(text, sizeof text,
                 "it moves along itself alone: a velocity along %c would pump fluid through it; an "
                 "opening is an \"inflow\"",
                 axes[a]);
        wall_fault(r, f, k, text);
    }
    if (w->kind == WALL_INFLOW && surface_wanted(r) &&
        v[a] * ((w->side - SIDE_X_MIN) % 2 ? 1 : -1) > 0.0 && !w->has_level && !w->has_discharge)
        wall_fault(r, f, k,
                   "its velocity points out of the domain: with a free surface that is kind = "
                   "\"outflow\" with a discharge");
}

/* Outwards through a side whose velocity is given, m^dim/s; of the exact field at the start over 32
 * faces each way. *size: the sum of its sizes is added. */
static double side_flux(const struct run *r, const struct exact *e, int a, int up, double *size)
{
    const struct scene_domain *d = &r->scene.domain;
    const struct scene_wall *w = wall_on(&r->scene, a, up);
    double h[3], x[3], u[3], sum = 0.0, area = 1.0;
    int n[3] = {1, 1, 1};
    for (int t = 0; t < 3; t++) {
        const double L = t < d->dim ? d->max[t] - d->min[t] : 1.0;
        n[t] = t < d->dim && t != a ? 32 : 1;
        h[t] = t < d->dim ? L / n[t] : 0.0;
        if (t != a)
            area *= L;
    }
    for (int t = 0; w && w->kind == WALL_INFLOW && w->profile == PROFILE_PARABOLIC && t < d->dim;
         t++)
        area *= t == a || d->periodic[t] ? 1.0 : 2.0 / 3.0;
    if (w) {
        sum = w->kind == WALL_INFLOW ? area * w->velocity[a] : 0.0;
        *size += fabs(sum);
        return (up ? 1.0 : -1.0) * sum;
    }
    area /= n[0] * n[1] * n[2];
    for (int i = 0; i < n[0] * n[1] * n[2]; i++) {
        const int m[3] = {i % n[0], i / n[0] % n[1], i / (n[0] * n[1])};
        for (int t = 0; t < 3; t++)
            x[t] = t == a ? (up ? d->max[t] : d->min[t]) : d->min[t] + (m[t] + 0.5) * h[t];
        exact_face(e, x, h, a, 0.0, u);
        sum += area * u[a];
        *size += area * (fabs(u[0]) + fabs(u[1]) + fabs(u[2]));
    }
    return (up ? 1.0 : -1.0) * sum;
}

void fv_fault_sucks(const struct run *r, struct faults *f, const char *group, double net)
{
    params_fault(
        r->params, f, group,
        "the velocities of the inflows point out of the domain: %g m^%d/s more would leave "
        "through them than come in, and the fluid come in through the outflow; turn their "
        "signs, or make the side where it comes in the \"inflow\" and the other one the "
        "\"outflow\"",
        net, r->scene.domain.dim);
}

/* What flows in must be able to flow out. */
static void check_balance(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    const struct exact e = exact_create(s);
    double net = 0.0, all = 0.0;
    bool in = false, given = true, exact = false;
    for (int k = 0; k < s->nwalls; k++)
        in = in || s->walls[k].kind == WALL_INFLOW;
    for (int a = 0; a < s->domain.dim; a++)
        for (int up = 0; up < 2 && !s->domain.periodic[a]; up++) {
            const struct scene_wall *w = wall_on(s, a, up);
            given = given && !(w && w->kind == WALL_OUTFLOW);
            exact = exact || !w;
            net += side_flux(r, &e, a, up, &all);
        }
    if (surface_wanted(r)) /* a tank fills, or empties */
        return;
    if (!given && in && !exact && !r->coupled && net > 1e-6 * all)
        fv_fault_sucks(r, f, "walls", net);
    if (!given || fabs(net) <= 1e-6 * all)
        return;
    if (r->coupled && (exact || !in)) /* the partner's part may have the rest */
        return;
    if (in && !exact)
        params_fault(
            r->params, f, "walls",
            "an inflow without an outflow: %g m^%d/s more flow in than out, and no side is "
            "an \"outflow\"",
            -net, s->domain.dim);
    else
        params_fault(r->params, f, "walls",
                     "sides without a wall have the velocity of initial.field: %g m^%d/s more flow "
                     "%s than the others let pass; give an \"outflow\"",
                     fabs(net), s->domain.dim, net < 0.0 ? "in" : "out");
}

void fv_fault_falls(const struct run *r, struct faults *f)
{
    params_fault(
        r->params, f, "fluid.gravity",
        "two outflows at different heights: the flow would fall from one to the other, and "
        "this solver balances gravity across sides by the pressure; make that direction "
        "periodic, or give one of them as an \"inflow\"");
}

/* Water that flows out at two heights falls; here gravity across sides is left to the pressure, and
 * the pressure of an outflow counts from that. */
static void check_falling(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    double g[3], least = INFINITY, most = -INFINITY, size = 0.0;
    (void)scene_still_gravity(s, g);
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        if (w->kind != WALL_OUTFLOW || w->carried || w->side == SIDE_NONE)
            continue;
        const int side = w->side - SIDE_X_MIN;
        double height = 0.0;
        for (int a = 0; a < s->domain.dim; a++) {
            const double lo = s->domain.min[a], hi = s->domain.max[a];
            const double x = a != side / 2 ? 0.5 * (lo + hi) : side % 2 ? hi : lo;
            height -= g[a] * x;
            size += fabs(g[a]) * (hi - lo);
        }
        least = fmin(least, height);
        most = fmax(most, height);
    }
    if (most - least > 1e-9 * size)
        fv_fault_falls(r, f);
}

/* --- free surface --- */

/* Water up to the highest side has no surface. */
static void check_shape(const struct run *r, struct faults *f, int k)
{
    const struct scene_shape *h = r->scene.shapes + k;
    double bottom, top;
    scene_heights(&r->scene, &bottom, &top);
    if (h->form == SHAPE_BELOW && h->level >= top)
        params_fault(r->params, f, key_text("shapes.[%d]", k),
                     "shape %d: its level, %g m, is the domain's top: leave the shape out, or "
                     "raise domain.max",
                     k + 1, h->level);
}

const char *surface_newton_lacks(bool falls)
{
    return falls ? "nothing stands there at the start, so that water would fall out, which newton "
                   "cannot do: rk3 and bdf2 can"
                 : "newton has one level outside, that of the highest water (initial.level), and "
                   "less stands here: rk3 and bdf2 take that";
}

/* Water stands at rest in an opening but for what flows through it: its pressure is that of the
 * level. */
static void check_water_opening(const struct run *r, struct faults *f, int k)
{
    const struct scene_wall *w = r->scene.walls + k;
    if (w->side == SIDE_NONE || (w->kind != WALL_INFLOW && w->kind != WALL_OUTFLOW))
        return;
    double still[3];
    (void)scene_still_gravity(&r->scene, still);
    if (w->kind == WALL_OUTFLOW && still[(w->side - SIDE_X_MIN) / 2] != 0.0)
        wall_fault(r, f, k,
                   "water would fall out of it: with a free surface an outflow stands "
                   "upright, or across a channel with an opening at its other end, too, along "
                   "which gravity leans by less than 45 degrees; a side that is open to the air "
                   "above it needs no wall");
    if (w->pressure != 0.0)
        wall_fault(
            r, f, k,
            "with a free surface the pressure of an outflow is that of the level (initial.level)");
    if (fv_params_of(r)->integrator == INTEGRATOR_NEWTON && (w->falls || w->lower))
        wall_fault(r, f, k, surface_newton_lacks(w->falls));
}

/* Between columns of flat cells a sloping surface jumps by as many rows as the cells are long, and
 * the band around it no longer knows its distance. A tilted basin: energy of its oscillation right
 * to 0.3 % at 100, off by 2 % at 200, by 4 % at 1000, said by nothing. */
#define ASPECT_MOST 200.0

static void check_aspect(const struct run *r, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    double least = INFINITY, most = 0.0;
    for (int a = 0; a < d->dim; a++) {
        const double h = (d->max[a] - d->min[a]) / fv_params_of(r)->cells[a];
        least = fmin(least, h);
        most = fmax(most, h);
    }
    if (most > ASPECT_MOST * least)
        params_fault(r->params, f, "fv.cells",
                     "cells %.4g times as long as high: with a free surface at most %g; more cells "
                     "along the one side, or fewer along the other",
                     most / least, ASPECT_MOST);
}

/* The exact velocity is that of a flow without a surface. */
static void check_block_sides(const struct run *r, struct faults *f)
{
    for (int k = 0; k < mesh_given_count; k++)
        if (mesh_block_has(mesh_given + k, MESH_EXACT))
            mesh_fault(r, f, mesh_given + k, "name",
                       "with a free surface its sides are walls, openings, joined, periodic or "
                       "overlap: no field is known beside it");
}

/* Centres of even cells. */
static void check_grains(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    const struct fv_params *prm = fv_params_of(r);
    double first[3], h[3];
    int n[3] = {1, 1, 1};
    if (mesh_given_count > 0 || prm->graded[1] > 0.0)
        return;
    for (int a = 0; a < s->domain.dim; a++) {
        n[a] = prm->cells[a];
        h[a] = (s->domain.max[a] - s->domain.min[a]) / n[a];
        first[a] = s->domain.min[a] + 0.5 * h[a];
    }
    scene_check_grains(s, r->params, first, h, n, "centre of a cell", f);
}

/* Where the water meets a shore is sph's to say, on a shore of its own. */
static void check_shores(const struct run *r, struct faults *f)
{
    for (int k = 0; k < r->scene.nprobes; k++) {
        if (r->scene.probes[k].kind == PROBE_SHORE && r->crossed && !r->gauge_elsewhere[k])
            params_fault(r->params, f, key_text("probes.[%d].at", k),
                         "probe \"%s\": (%g, %g) m lies in fv's part, and only sph reads a shore; "
                         "put it into sph.box",
                         r->scene.probes[k].name, r->scene.probes[k].at[0],
                         r->scene.probes[k].at[1]);
    }
}

/* Without a surface fluid fills the domain, whatever the level. */
static void warn_of_level(const struct scene *s)
{
    double low, high;
    scene_heights(s, &low, &high);
    if (s->initial.level > low && s->initial.level < high)
        log_warn(
            "initial.level: %g m lies in the domain, but there is no free surface: fluid fills "
            "it up to %g m, and pressures above the level are negative; for water up to a "
            "level give shapes = ( { form = \"below\"; level = %g; } )",
            s->initial.level, high, s->initial.level);
}

/* On cells and on blocks. What is looked at after gravity needs it. */
void surface_check(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    const double *g = s->fluid.gravity;
    const struct fv_params *prm = fv_params_of(r);
    if (!surface_wanted(r)) {
        if (r->crossed)
            params_fault(r->params, f, "fv.surface",
                         "sph.box ends in the water at an upright side: both programs have the "
                         "surface; leave it on auto, or let the box span the domain");
        if (!r->coupled && scene_has_wave(s))
            params_fault(r->params, f, "initial.field", "a wave needs a free surface: fv.surface");
        if (!r->coupled)
            warn_of_level(s);
        return;
    }
    if (r->coupled && !r->crossed)
        params_fault(r->params, f, "fv.surface",
                     "a coupled run leaves the surface to sph, unless sph.box ends in the water "
                     "at an upright side");
    if (s->nshapes == 0 && !scene_has_wave(s))
        params_fault(r->params, f, "fv.surface",
                     "where is the water? shapes say it, or a wave (initial.field)");
    if (mesh_given_count == 0)
        check_aspect(r, f);
    if (prm->steady)
        params_fault(r->params, f, "fv.steady",
                     "a free surface moves in time: let it come to rest in a run in time");
    for (int k = 0; k < s->nwalls; k++)
        check_water_opening(r, f, k);
    if (mesh_given_count > 0)
        check_block_sides(r, f);
    check_shores(r, f);
    if (prm->hole[1][0] > prm->hole[0][0])
        params_fault(r->params, f, "fv.hole", "not with a free surface");
    for (int a = 0; a < s->domain.dim; a++)
        for (int up = 0; up < 2 && !s->domain.periodic[a] && mesh_given_count == 0; up++)
            if (!wall_on(s, a, up))
                params_fault(r->params, f, "walls",
                             "with a free surface each side that is not periodic is a wall or an "
                             "opening (but the one above, which is closed if none is given): "
                             "%c_%s is neither",
                             axes[a], up ? "max" : "min");
    bool heavy = false;
    for (int a = 0; a < s->domain.dim; a++)
        heavy = heavy || g[a] != 0.0;
    if (!heavy) {
        params_fault(r->params, f, "fluid.gravity",
                     "a free surface needs gravity: nothing else holds the water together");
        return;
    }
    for (int k = 0; k < s->nshapes; k++)
        check_shape(r, f, k);
    check_grains(r, f);
    surface_check_hanging(r, f);
}

/* --- fields that are exact at all times --- */

/* Of a stream across closed sides nothing is left after the first projection. */
static void check_stream(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    if (surface_wanted(r) || r->coupled || mesh_given_count > 0)
        return;
    for (int a = 0; a < s->domain.dim; a++) {
        const struct scene_wall *low = wall_on(s, a, 0), *high = wall_on(s, a, 1);
        if (low && high && low->kind <= WALL_NO_SLIP && high->kind <= WALL_NO_SLIP &&
            s->initial.velocity[a] != 0.0)
            params_fault(r->params, f, "initial.velocity",
                         "uniform: along %c both sides are walls, which stop it at once: give an "
                         "\"inflow\" and an \"outflow\", or make that direction periodic",
                         axes[a]);
    }
}

/* What the exact profile takes for granted: walls, period, drive. */
static void check_channel(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    const bool forced = s->initial.field == FIELD_POISEUILLE;
    const char *name = forced ? "poiseuille" : "couette";
    const double *g = s->fluid.gravity;
    if (!(s->fluid.nu > 0.0))
        params_fault(r->params, f, "fluid.nu", "%s: a viscous flow", name);
    if (forced == (g[0] == 0.0))
        params_fault(r->params, f, "fluid.gravity",
                     forced ? "poiseuille is driven by gravity along x"
                            : "couette is driven by the wall y_max, not by gravity along x");
    if (!s->domain.periodic[0] || s->domain.periodic[1])
        params_fault(r->params, f, "domain.periodic",
                     "%s: a channel along x, periodic there and closed along y", name);
    for (int up = 0; up < 2 && !s->domain.periodic[1]; up++) {
        const struct scene_wall *w = wall_on(s, 1, up);
        const double v = !forced && up ? s->initial.U : 0.0;
        if (!w || w->kind != WALL_NO_SLIP || w->velocity[0] != v || w->velocity[2] != 0.0)
            params_fault(r->params, f, "initial.field",
                         "%s: y_%s must be a \"no_slip\" wall with the velocity (%g, 0)", name,
                         up ? "max" : "min", v);
    }
}

/* k a of the steepest standing wave, whose height is 0.218 of its length (Penney & Price, Phil.
 * Trans. R. Soc. A 244, 1952). */
#define STANDING_MOST 0.68

/* A crest under the lid, a level within the domain, and walls where the exact field has none
 * across. */
static void check_wave(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    const struct scene_domain *d = &s->domain;
    const double L[3] = {s->initial.L, 0.0, s->initial.L_z};
    const bool standing = s->initial.field == FIELD_STANDING_WAVE;
    const struct exact e =
        s->initial.level < d->max[1] && s->initial.level > d->min[1] && s->initial.amplitude != 0.0
            ? exact_create(s)
            : (struct exact){0};
    double crest =
        e.height > 0.0 && standing ? s->initial.level + fabs(s->initial.amplitude) : -INFINITY;
    if (s->initial.amplitude == 0.0)
        params_fault(r->params, f, "initial.amplitude", "a wave needs an amplitude");
    const double steep =
        fabs(s->initial.amplitude) * hypot(2.0 * M_PI / L[0], L[2] > 0.0 ? 2.0 * M_PI / L[2] : 0.0);
    if (standing && steep > STANDING_MOST)
        params_fault(
            r->params, f, "initial.amplitude",
            "%g m: k a = %.3g, and no standing wave is steeper than %g: less amplitude, or "
            "a longer wave",
            s->initial.amplitude, steep, STANDING_MOST);
    if (!(s->initial.level > d->min[1] && s->initial.level < d->max[1]))
        params_fault(r->params, f, "initial.level",
                     "a wave needs its level at rest, between %g and %g m", d->min[1], d->max[1]);
    if (e.steady.c > 0.0)
        crest = s->initial.level + e.steady.crest;
    for (int k = 0; k < 100 && e.height > 0.0 && s->initial.field == FIELD_STOKES; k++)
        crest = fmax(crest, exact_surface(&e, 0.01 * k * s->initial.L));
    if (crest > d->max[1])
        params_fault(r->params, f, "domain.max", "the crest of the wave, %g m, lies above it",
                     crest);
    if (!standing && s->initial.field != FIELD_SOLITARY && !d->periodic[0])
        params_fault(r->params, f, "domain.periodic", "a train of waves that travels along x");
    for (int a = 0; a < d->dim && standing; a += 2) {
        const double half = L[a] > 0.0 ? (d->max[a] - d->min[a]) / (0.5 * L[a]) : 0.0,
                     from = L[a] > 0.0 ? d->min[a] / (0.5 * L[a]) : 0.0,
                     n = d->periodic[a] ? 0.5 * half : half;
        if (fabs(n - round(n)) > 1e-6 || (!d->periodic[a] && fabs(from - round(from)) > 1e-6))
            params_fault(
                r->params, f, a == 0 ? "initial.L" : "initial.L_z",
                "%g m: the walls along %c must stand at crests or troughs, at multiples of "
                "%g m, a periodic side whole lengths apart",
                L[a], axes[a], 0.5 * L[a]);
    }
}

static void check_field(const struct run *r, struct faults *f)
{
    const struct scene_initial *s = &r->scene.initial;
    switch (s->field) {
    case FIELD_POISEUILLE:
    case FIELD_COUETTE:
        check_channel(r, f);
        break;
    case FIELD_UNIFORM:
        check_stream(r, f);
        break;
    case FIELD_STANDING_WAVE:
    case FIELD_STOKES:
    case FIELD_REGULAR:
    case FIELD_SOLITARY:
        check_wave(r, f);
        break;
    case FIELD_PATCH:
    case FIELD_DROP:
        if (!r->coupled)
            params_fault(r->params, f, "initial.field",
                         "%s: it has a free surface without gravity, which is for sph",
                         s->field == FIELD_PATCH ? "patch" : "drop");
        break;
    default:
        break;
    }
}

/* --- gauges --- */

/* Gauges of what the program does not compute; that they stand in the domain scene_sense.c sees. */
static void check_probe(const struct run *r, struct faults *f, int k)
{
    const struct scene_probe *p = r->scene.probes + k;
    const double(*hole)[3] = fv_params_of(r)->hole;
    bool in_hole = p->kind != PROBE_DISCHARGE;
    for (int a = 0; a < r->scene.domain.dim; a++)
        in_hole = in_hole && p->at[a] > hole[0][a] && p->at[a] < hole[1][a];
    if (in_hole)
        params_fault(r->params, f, key_text("probes.[%d].at", k),
                     "probe \"%s\" lies in fv.hole, where nothing is computed", p->name);
}

static bool levels_are_read(const struct run *r)
{
    return surface_wanted(r) || (r->coupled && scene_has_surface(&r->scene));
}

void probes_check_surface(const struct run *r, struct faults *f)
{
    for (int k = 0; k < r->scene.nprobes; k++)
        if (r->scene.probes[k].kind == PROBE_LEVEL && !levels_are_read(r))
            params_fault(r->params, f, key_text("probes.[%d].kind", k), PROBE_NO_SURFACE,
                         r->scene.probes[k].name);
}

/* In the order of causes. */
void fv_scene_check(const struct run *r, struct faults *f)
{
    const int before = f->n;
    for (int k = 0; k < r->scene.nwalls; k++)
        check_wall(r, f, k);
    check_field(r, f);
    if (f->n == before) { /* what follows wants a sound field and sound walls */
        check_balance(r, f);
        check_falling(r, f);
    }
    surface_check(r, f);
    probes_check_surface(r, f);
    for (int k = 0; k < r->scene.nprobes; k++)
        check_probe(r, f, k);
}

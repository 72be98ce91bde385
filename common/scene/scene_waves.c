/* scene_waves.c - see scene_waves.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_waves.h"

#include "scene_currents.h"
#include "scene_fluid.h"
#include "scene_mesh.h"
#include "wave_maker.h"

/* Degrees about the vertical into the domain through the first side that makes waves; without one
 * along the first horizontal axis, as a paddle that is given no other has it. */
static double inward(const struct scene *s)
{
    const int up = scene_still_axis(s), first = up == 0 ? 1 : 0;
    for (int k = 0; k < s->nwalls; k++) {
        bool low;
        const int axis = scene_zone_axis(s->walls + k, &low);
        if (s->walls[k].zone == ZONE_WAVE && axis == first)
            return low ? 0.0 : 180.0;
        if (s->walls[k].zone == ZONE_WAVE && axis != up)
            return low ? 90.0 : -90.0;
    }
    return 0.0;
}

/* Kinds wave and beach become slip walls with a zone: from here on nobody else knows them. */
void scene_waves_mark(struct scene *s)
{
    for (int k = 0; k < s->nwalls; k++) {
        struct scene_wall *w = s->walls + k;
        w->zone = w->kind == WALL_WAVE                                               ? ZONE_WAVE
                  : w->kind == WALL_BEACH || w->beach > 0.0 || w->beach_period > 0.0 ? ZONE_BEACH
                                                                                     : ZONE_NONE;
        w->kind = w->kind >= WALL_WAVE ? WALL_SLIP : w->kind;
    }
    if (s->waves.direction >= WAVES_INWARD)
        s->waves.direction = inward(s);
}

bool scene_makes_waves(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nwalls; k++)
        any = any || s->walls[k].zone == ZONE_WAVE;
    return any;
}

/* m, against gravity: of the highest shape; NAN: no shape tells. */
double scene_waves_level(const struct scene *s)
{
    const int up = scene_still_axis(s);
    double level = NAN;
    for (int k = 0; k < s->nshapes && up >= 0; k++) {
        const struct scene_shape *is = s->shapes + k;
        const double top = s->fluid.gravity[up] < 0.0 ? is->box[1][up] : -is->box[0][up];
        if (!is->hole && is->form == SHAPE_BELOW)
            level = fmax(level, is->level);
        else if (!is->hole && is->form == SHAPE_BOX)
            level = fmax(level, top);
    }
    return scene_has_wave(s) && s->initial.level < LEVEL_TOP ? s->initial.level : level;
}

double scene_waves_depth(const struct scene *s)
{
    const int up = scene_still_axis(s);
    if (s->waves.depth > 0.0 || up < 0)
        return s->waves.depth > 0.0 ? s->waves.depth : NAN;
    return scene_waves_level(s) -
           (s->fluid.gravity[up] < 0.0 ? s->domain.min[up] : -s->domain.max[up]);
}

void scene_waves_direction(const struct scene *s, double *d, double *across)
{
    const int up = scene_still_axis(s), first = up == 0 ? 1 : 0, second = 3 - up - first;
    const double angle = s->waves.direction * M_PI / 180.0;
    const bool space = up >= 0 && s->domain.dim == 3;
    d[0] = d[1] = d[2] = 0.0;
    d[first] = cos(angle);
    if (space)
        d[second] = sin(angle);
    if (!across)
        return;
    across[0] = across[1] = across[2] = 0.0;
    if (space) {
        across[first] = -sin(angle);
        across[second] = cos(angle);
    }
}

int scene_zone_axis(const struct scene_wall *w, bool *low)
{
    *low = (w->side - SIDE_X_MIN) % 2 == 0;
    return (w->side - SIDE_X_MIN) / 2;
}

/* Returns the axis across the side; -1: it has no zone. */
int scene_zone_box(const struct scene *s, const struct scene_wall *w, double lo[3], double hi[3])
{
    bool low;
    const int axis = scene_zone_axis(w, &low);
    if (w->zone == ZONE_NONE)
        return -1;
    for (int a = 0; a < 3; a++) {
        lo[a] = s->domain.min[a];
        hi[a] = s->domain.max[a];
    }
    if (low)
        hi[axis] = lo[axis] + w->beach;
    else
        lo[axis] = hi[axis] - w->beach;
    return axis;
}

/* Widens `ends' to where the box reaches along d, m. */
static void reach_along(int dim, const double *d, const double *lo, const double *hi,
                        double ends[2])
{
    double from = 0.0, to = 0.0;
    for (int a = 0; a < dim; a++) {
        from += fmin(lo[a] * d[a], hi[a] * d[a]);
        to += fmax(lo[a] * d[a], hi[a] * d[a]);
    }
    ends[0] = fmin(ends[0], from);
    ends[1] = fmax(ends[1], to);
}

void scene_waves_window(const struct scene *s, const struct scene_wall *only, double window[2][2])
{
    double d[2][3], lo[3], hi[3];
    scene_waves_direction(s, d[0], d[1]);
    const bool any = scene_makes_waves(s);
    for (int k = 0; k < 2; k++) {
        window[k][0] = any ? INFINITY : 0.0;
        window[k][1] = any ? -INFINITY : 0.0;
    }
    for (int k = 0; k < s->nwalls; k++) {
        if (s->walls[k].zone != ZONE_WAVE || (only && only != s->walls + k))
            continue;
        scene_zone_box(s, s->walls + k, lo, hi);
        for (int i = 0; i < 2; i++)
            reach_along(s->domain.dim, d[i], lo, hi, window[i]);
    }
}

/* s: so that a run which goes on to a somewhat later end sees the same sea. */
static double repeat_of(const struct scene *s, double period)
{
    double repeat = 25.0 * period;
    while (repeat < s->time.end + 10.0 * period)
        repeat *= 2.0;
    return repeat;
}

/* The second order is for what zones make: a paddle makes the linear waves. */
struct wave_spec scene_waves_spec(const struct scene *s)
{
    const struct scene_waves *w = &s->waves;
    struct wave_spec of = {.kind = w->kind,
                           .height = w->height,
                           .length = w->length,
                           .period = w->period,
                           .depth = scene_waves_depth(s),
                           .g = vec3_length(s->fluid.gravity),
                           .rho = s->fluid.rho,
                           .at = {w->at[0], w->at[1]},
                           .start = w->start,
                           .current = w->current,
                           .closed = w->closed,
                           .peak = w->peak,
                           .seed = w->seed,
                           .spread = w->spread,
                           .order = 1};
    if (w->kind != WAVE_REGULAR && scene_makes_waves(s)) {
        of.evolve = w->evolve;
        of.order = w->evolve != EVOLVE_NO || w->spread > 0.0 ? 1 : w->order;
    }
    snprintf(of.file, sizeof of.file, "%s", w->path);
    of.repeat = w->repeat > 0.0 ? w->repeat : repeat_of(s, waves_period(&of));
    scene_waves_window(s, NULL, of.window);
    return of;
}

/* m: of zones whose length is not given. */
static double zone_length(const struct scene *s, const struct waves *w)
{
    const bool deep = 2.0 * M_PI * w->of.depth / w->length > 2.0;
    if (s->waves.zone > 0.0)
        return s->waves.zone;
    return (w->of.kind != WAVE_REGULAR || deep ? 1.5 : 1.0) * w->length;
}

/* Lengths and periods of zones that follow from the waves, and waves.made. */
static void resolve(struct scene *s, const struct waves *made)
{
    for (int k = 0; k < s->nwalls; k++) {
        struct scene_wall *w = s->walls + k;
        if (w->zone == ZONE_NONE)
            continue;
        w->beach = w->beach > 0.0 ? w->beach : zone_length(s, made);
        w->beach_period = w->beach_period > 0.0 ? w->beach_period : made->period;
    }
    s->waves.made =
        (struct waves_made){made->crest, made->speed, made->length, made->period, made->of.height};
}

/* --- faults --- */

static void check_zone(const struct scene *s, const struct params *p, int k, struct faults *f)
{
    const struct scene_wall *w = s->walls + k;
    bool low;
    const int axis = scene_zone_axis(w, &low);
    const char *key = key_text("walls.[%d].beach", k);
    if (!params_given(p, key))
        key = key_text("walls.[%d].kind", k);
    if (w->side == SIDE_NONE)
        params_fault(p, f, key, "a zone stands before a side of the domain, not along points");
    else if (w->zone == ZONE_WAVE && !s->has_waves)
        params_fault(p, f, key,
                     "what waves? give the group waves: { height = ...; length = ...; }, or "
                     "period");
    else if (w->zone == ZONE_BEACH && !s->has_waves &&
             (!(w->beach > 0.0) || !(w->beach_period > 0.0)))
        params_fault(p, f, key,
                     "a beach needs its length and the period of the waves that it is to absorb: "
                     "give beach (m) and beach_period (s)");
    else if (axis == scene_still_axis(s))
        params_fault(p, f, key, "a zone is before an upright side, not below or above the water");
    else if (!scene_has_surface(s))
        params_fault(p, f, key,
                     "no water has a free surface: there are no waves; give the water by "
                     "shapes, as { form = \"below\"; level = ...; }");
    else if (w->beach >= s->domain.max[axis] - s->domain.min[axis])
        params_fault(p, f, key, "%g m: the domain is %g m long there", w->beach,
                     s->domain.max[axis] - s->domain.min[axis]);
}

/* m: depth down to the floor of the domain if a wall closes it, else without end. */
static double deepest(const struct scene *s, int up)
{
    const bool down = s->fluid.gravity[up] < 0.0;
    const double floor = down ? s->domain.min[up] : -s->domain.max[up];
    const bool closed = scene_wall_of(s, SIDE_X_MIN + 2 * up + (down ? 0 : 1)) != NULL;
    return closed ? scene_waves_level(s) - floor : INFINITY;
}

/* Gravity along an axis, water over a floor, a way to run: what a wave is made of. */
static bool check_water(const struct scene *s, const struct params *p, struct faults *f)
{
    const double g = vec3_length(s->fluid.gravity);
    const int up = scene_still_axis(s);
    if (up < 0 || fabs(s->fluid.gravity[up]) < (1.0 - 1e-9) * g)
        params_fault(p, f, "fluid.gravity",
                     "waves are made under gravity along an axis, as (0, -9.81)");
    else if (!(scene_waves_depth(s) > 0.0))
        params_fault(p, f, "waves.depth",
                     "no shape (a box, or below a level) tells how deep the water is: give it, m");
    else if (s->waves.depth > (1.0 + 1e-6) * deepest(s, up))
        params_fault(p, f, "waves.depth",
                     "%g m: the water is %g m deep down to the floor of the domain: leave it out, "
                     "or give what stands where the waves are made",
                     s->waves.depth, deepest(s, up));
    else if (s->domain.dim == 2 && fabs(sin(s->waves.direction * M_PI / 180.0)) > 1e-6)
        params_fault(p, f, "waves.direction",
                     "%g degrees: in 2D waves run along the horizontal axis: 0, or 180 against it",
                     s->waves.direction);
    else
        return true;
    return false;
}

/* Whether some paddle has the water before it along the waves; *last: one that has not, or -1. */
static bool some_paddle_makes(const struct scene *s, int *last)
{
    bool any = false;
    *last = -1;
    for (int k = 0; k < s->nbodies; k++)
        for (int i = 0; i < s->bodies[k].motion.n; i++) {
            const struct scene_motion *m = s->bodies[k].motion.of + i;
            struct wave_paddle p;
            if (m->kind != MOTION_WAVES)
                continue;
            wave_paddle_of(s, s->bodies + k, m, &p);
            any = any || p.side > 0.0;
            *last = p.side < 0.0 ? k : *last;
        }
    return any;
}

/* Waves that all sides of kind wave, and all paddles, let out: nothing of them would be in the
 * tank. */
static void check_ways(const struct scene *s, const struct params *p, struct faults *f)
{
    double d[3];
    const struct scene_wall *last = NULL;
    int paddle;
    scene_waves_direction(s, d, NULL);
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        bool low;
        const int axis = w->zone == ZONE_WAVE ? scene_zone_axis(w, &low) : 0;
        if (w->zone == ZONE_WAVE && (low ? d[axis] : -d[axis]) > 1e-6)
            return;
        last = w->zone == ZONE_WAVE ? w : last;
    }
    if (some_paddle_makes(s, &paddle))
        return;
    const char *const out = paddle >= 0 ? s->bodies[paddle].name
                            : last      ? scene_side_names[last->side - SIDE_X_MIN]
                                        : NULL;
    if (out)
        params_fault(
            p, f, "waves.direction",
            "%g degrees: the waves run out through %s, or along it, and none come in: turn "
            "them, or give what they come from, a side or a paddle, the kind wave",
            s->waves.direction, out);
}

/* Along a periodic axis the waves must meet themselves: a whole number of them, of length L/d. Only
 * a regular wave has one length; of others the target jumps where the period closes. */
static void check_period(const struct scene *s, const struct params *p, const struct waves *made,
                         struct faults *f)
{
    double d[3];
    scene_waves_direction(s, d, NULL);
    for (int a = 0; a < s->domain.dim; a++) {
        const double wide = s->domain.max[a] - s->domain.min[a],
                     n = fabs(d[a]) * wide / made->length;
        if (!s->domain.periodic[a] || a == scene_still_axis(s))
            continue;
        if (made->of.kind == WAVE_REGULAR && fabs(n - round(n)) > 0.01)
            params_fault(p, f, "domain.max",
                         "the period of %g m along %c holds %.3g waves of that direction, and must "
                         "hold a whole number: %.6g m, or another waves.direction",
                         wide, "xyz"[a], n, fmax(1.0, round(n)) * made -> length / fabs(d[a]));
        else if (made->of.kind != WAVE_REGULAR && (fabs(d[a]) > 0.02 || made->of.spread > 0.0))
            log_warn("waves: those that run along %c do not fit its period of %g m, and jump where "
                     "it closes: sides with zones instead",
                     "xyz"[a], wide);
    }
}

/* Closed sides beside the zones against which the waves run, as they do against a plane of
 * symmetry: right, and seldom wanted. */
static void warn_of_sides(const struct scene *s)
{
    double d[3];
    bool made[3] = {false}, low;
    scene_waves_direction(s, d, NULL);
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].zone == ZONE_WAVE)
            made[scene_zone_axis(s->walls + k, &low)] = true;
    for (int a = 0; a < 3; a++) {
        const enum scene_side side = SIDE_X_MIN + 2 * a + (d[a] > 0.0);
        const struct scene_wall *w = scene_wall_of(s, side);
        if (!made[a] && fabs(d[a]) > 0.02 && w && w->zone == ZONE_NONE && w->kind < WALL_INFLOW)
            log_warn("waves: they run against %s, which throws them back: kind = \"beach\" there, "
                     "and \"wave\" on the side that they come from",
                     scene_side_names[side - SIDE_X_MIN]);
    }
}

/* A side above the water that crests would strike: all of a regular wave's do, some of a sea's. */
static void check_crests(const struct scene *s, const struct params *p, const struct waves *made,
                         struct faults *f)
{
    const int up = scene_still_axis(s);
    const double sign = s->fluid.gravity[up] < 0.0 ? 1.0 : -1.0,
                 end = sign > 0.0 ? s->domain.max[up] : s->domain.min[up],
                 crest = sign * (scene_waves_level(s) + made->crest);
    const char *const key = sign > 0.0 ? "domain.max" : "domain.min";
    if (!(sign * crest > sign * end))
        return;
    if (made->of.kind == WAVE_REGULAR)
        params_fault(p, f, key, "%g m: crests reach %.4g m: more room above the water", end, crest);
    else
        log_warn("%s: %g m: crests reach some %.4g m: more room above the water", key, end, crest);
}

/* Zones that the waves give a length. */
static void check_room(const struct scene *s, const struct params *p, const struct waves *made,
                       struct faults *f)
{
    double left[3];
    for (int a = 0; a < 3; a++)
        left[a] = s->domain.max[a] - s->domain.min[a];
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        bool low;
        if (w->zone != ZONE_NONE)
            left[scene_zone_axis(w, &low)] -= w->beach > 0.0 ? w->beach : zone_length(s, made);
    }
    for (int a = 0; a < s->domain.dim; a++)
        if (!(left[a] > 0.0))
            params_fault(p, f, "domain.max",
                         "along %c the zones before the sides leave no room between them: of these "
                         "waves (%.4g m long) each takes %.4g m",
                         "xyz"[a], made -> length, zone_length(s, made));
        else if (left[a] < made->length && left[a] < s->domain.max[a] - s->domain.min[a])
            log_warn("along %c the zones leave %.3g m between them, less than a wave length",
                     "xyz"[a], left[a]);
}

void scene_waves_check(struct scene *s, const struct params *p, struct faults *f)
{
    const int before = f->n;
    char text[256];
    const char *key;
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].zone != ZONE_NONE)
            check_zone(s, p, k, f);
    wave_makers_check(s, p, f);
    scene_currents_check(s, p, f);
    if (!s->has_waves || f->n > before)
        return;
    if (!scene_makes_waves(s) && !scene_has_wave_maker(s)) {
        params_fault(
            p, f, "waves",
            "nobody makes them: give a side of the domain kind = \"wave\", or a body a motion of "
            "kind = \"waves\"");
        return;
    }
    if (!check_water(s, p, f))
        return;
    const struct wave_spec of = scene_waves_spec(s);
    if (waves_refuse(&of, &key, text, sizeof text)) {
        params_fault(p, f, key, "%s", text);
        return;
    }
    struct waves *made = waves_create(&of);
    check_room(s, p, made, f);
    check_crests(s, p, made, f);
    check_ways(s, p, f);
    if (scene_makes_waves(s)) {
        check_period(s, p, made, f);
        warn_of_sides(s);
    }
    resolve(s, made);
    FREE(made);
}

/* --- what stands in zones --- */

/* Whether the box lo[3], hi[3] reaches into the zone's length. What lies on its side does not. */
static bool reaches(const struct scene *s, const struct scene_wall *w, const double *lo,
                    const double *hi)
{
    double from[3], to[3];
    const int axis = scene_zone_box(s, w, from, to);
    const double small = 1e-6 * w->beach;
    return axis >= 0 && hi[axis] > from[axis] + small && lo[axis] < to[axis] - small;
}

/* A hundredth of the depth over the floor is the floor. */
static bool is_wet(const struct scene *s, const double *lo, const double *hi)
{
    const double level = scene_waves_level(s), depth = scene_waves_depth(s),
                 a = scene_height(s, lo), b = scene_height(s, hi);
    return fmin(a, b) < level && fmax(a, b) > level - 0.99 * depth;
}

bool scene_waves_stands(const struct scene *s, const char *what, const double lo[3],
                        const double hi[3])
{
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        if (!reaches(s, w, lo, hi) || !is_wet(s, lo, hi))
            continue;
        log_warn("%s stands in the zone of %.4g m before %s, whose waves are those over a flat "
                 "floor: %s",
                 what, w->beach, scene_side_names[w->side - SIDE_X_MIN],
                 w->zone == ZONE_WAVE ? "the tank gets others" : "more of them come back");
        return true;
    }
    return false;
}

/* The same of a line's segments or corners. */
static void look_along(const struct scene *s, const char *what, const struct param_points *p)
{
    bool told = false;
    for (int i = 0; i + 1 < p->n && !told; i++) {
        double lo[3] = {0.0}, hi[3] = {0.0};
        for (int a = 0; a < 2; a++) {
            lo[a] = fmin(p->x[i][a], p->x[i + 1][a]);
            hi[a] = fmax(p->x[i][a], p->x[i + 1][a]);
        }
        told = scene_waves_stands(s, what, lo, hi);
    }
}

/* Bodies and walls at the start. */
static void warn_of_solids(const struct scene *s)
{
    char what[PARAM_TEXT_SIZE + 16];
    for (int k = 0; k < s->nbodies; k++) {
        const struct scene_mesh *mesh = scene_mesh_of(s, MESH_OF_BODY, k);
        snprintf(what, sizeof what, "body %s", s->bodies[k].name);
        if (mesh)
            scene_waves_stands(s, what, mesh->lo, mesh->hi);
        else
            look_along(s, what, &s->bodies[k].points);
    }
    for (int k = 0; k < s->nwalls; k++) {
        snprintf(what, sizeof what, "walls.[%d]", k);
        look_along(s, what, &s->walls[k].points);
    }
}

/* --- the log --- */

/* waves.at of a group is a place and a time, not a point. */
static void describe_focus(const struct scene *s, const struct waves *w)
{
    const double grown = s->waves.start * w->period, at = w->of.at[0];
    double d[3], ends[2] = {INFINITY, -INFINITY};
    scene_waves_direction(s, d, NULL);
    reach_along(s->domain.dim, d, s->domain.min, s->domain.max, ends);
    log_say("its focus: %g m along its direction, t = %g s", w->of.at[0], w->of.at[1]);
    if (w->of.at[1] < grown || w->of.at[1] > s->time.end)
        log_warn("waves.at: the focus, t = %g s, is not within the run, from t = %.3g s, when the "
                 "waves are fully grown, to %g s: give at = (place in m, time in s)",
                 w->of.at[1], grown, s->time.end);
    if (at < ends[0] || at > ends[1])
        log_warn("waves.at: the focus, %g m along waves.direction, is not in the domain, which "
                 "reaches from %g to %g m there",
                 at, ends[0], ends[1]);
}

static void say_field(const struct waves *w)
{
    const struct evolution *e = w->field->of;
    char wide[48] = "", how[48] = "the layer under the surface";
    if (e->grid->n[1] > 1)
        snprintf(wide, sizeof wide, " x %.4g m", e->grid->length[1]);
    if (e->hos)
        snprintf(how, sizeof how, "%d orders in steepness", e->of.order);
    if (w->of.kind == WAVE_FILE) {
        const struct swd_header is = swd_header_of(w->field->file);
        log_say("%s: %d modes over a periodic line of %.4g m, %d times %.3g s apart; velocities by "
                "the layer under the surface",
                w->of.file, is.n, e->grid->length[0], is.nsteps, is.dt);
        return;
    }
    log_say("they evolve nonlinearly over a periodic %s of %.4g m%s, %d x %d points, by %s",
            e->grid->n[1] > 1 ? "plane" : "line", e->grid->length[0], wide, e->grid->n[0],
            e->grid->n[1], how);
}

static void describe_made(const struct scene *s, const struct waves *w)
{
    static const char *const names[] = {"regular waves", "a sea", "a focused group",
                                        "waves of a file"};
    const double kh = 2.0 * M_PI * w->of.depth / w->length;
    log_say("%s: height %g m, %s%.4g m long, period %.4g s, celerity %.4g m/s over %.4g m (kh "
            "%.3g), %.0f %% of the highest; crest %.3g m, trough %.3g m, water up to %.3g m/s",
            names[w->of.kind], w->of.height,
            w->of.kind == WAVE_REGULAR ? ""
            : w->of.kind == WAVE_FILE  ? "in the mean "
                                       : "the peak's ",
            w->length, w->period, w->celerity, w->of.depth, kh, 100.0 * w->of.height / w->limit,
            w->crest, w->trough, w->speed);
    if (w->of.kind == WAVE_REGULAR)
        return;
    if (w->of.kind == WAVE_FOCUSED)
        describe_focus(s, w);
    log_say("%d linear components, lengths %.3g to %.3g m", w->ncomponents, w->shortest,
            w->longest);
    if (w->of.spread > 0.0)
        log_say(
            "directions about the mean as cos^%g(b/2): within %.0f degrees on both sides in the "
            "mean",
            2.0 * w->of.spread, 180.0 / M_PI * sqrt(2.0 / (w->of.spread + 1.0)));
    if (w->field)
        say_field(w);
    if (w->second)
        log_say("second order: pairs of %d frequencies", second_order_frequencies(w->second));
    if (scene_makes_waves(s))
        log_say("a zone's waves take %.1g s a period to compute on each rank", sea_seconds(w));
}

/* 1/s: of the zone on still water that a current makes of it. */
static double still_rate(const struct scene *s, double rate)
{
    const struct wave_spec of = scene_waves_spec(s);
    return scene_currents_rate(&of, rate);
}

void scene_waves_describe(const struct scene *s)
{
    const double g = vec3_length(s->fluid.gravity), h = scene_waves_depth(s);
    if (s->has_waves) {
        const struct wave_spec of = scene_waves_spec(s);
        struct waves *made = waves_create(&of);
        describe_made(s, made);
        scene_currents_describe(s, made);
        FREE(made);
        wave_makers_describe(s);
    }
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        if (w->zone == ZONE_NONE)
            continue;
        const char *side = scene_side_names[w->side - SIDE_X_MIN],
                   *what = w->zone == ZONE_WAVE ? "wave zone" : "beach";
        if (!(h > 0.0)) {
            log_say("%s: %s over %g m, for waves of %g s", side, what, w->beach, w->beach_period);
            continue;
        }
        const double number = waves_number_on(2.0 * M_PI / w->beach_period, s->waves.current, g, h),
                     length = 2.0 * M_PI / number, rate = 4.0 * M_PI / w->beach_period,
                     R = zone_response(waves_frequency(number, g, h), number, 1.0, g, h, w->beach,
                                       s->has_waves ? still_rate(s, rate) : rate)
                             .reflected;
        log_say("%s: %s over %.4g m, %.2g lengths of waves of %.4g s (%.3g m): %.2g %% of their "
                "height comes back",
                side, what, w->beach, w->beach / length, w->beach_period, length, 100.0 * R);
        if (w->beach < 0.8 * length)
            log_warn("%s: a zone shorter than a wave length reflects; give %s = %.3g, or %.2g for "
                     "a sea",
                     side, w->zone == ZONE_WAVE ? "waves.zone" : "beach", length, 1.5 * length);
    }
    warn_of_solids(s);
}

void scene_waves_resolution(const struct scene *s, const char *points, const double *h,
                            const double *least)
{
    const int up = scene_still_axis(s);
    if (!s->has_waves || up < 0)
        return;
    const double length = s->waves.made.length, height = s->waves.made.height;
    double d[3], along = INFINITY;
    scene_waves_direction(s, d, NULL);
    for (int a = 0; a < s->domain.dim; a++)
        if (a != up)
            along = fmin(along, length / fmax(fabs(d[a]), 1e-3) / h[a]);
    log_say("waves have %.3g %s a length, %.2g a height", along, points, height / h[up]);
    if (along < least[0] || height / h[up] < least[1])
        log_warn("waves: %.3g %s a length, %.2g a height: below %g and %g over a tenth of the "
                 "height is lost on the way of some lengths",
                 along, points, height / h[up], least[0], least[1]);
}

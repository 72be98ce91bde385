/* scene_openings.c - see scene_openings.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_openings.h"

#include "scene_fluid.h"
#include "scene_speed.h"

enum { COLUMNS = 2, TEXT = 160 };

void wall_histories_read(struct scene *s, struct motion_files *files)
{
    for (int k = 0; k < s->nwalls; k++) {
        struct scene_wall *w = s->walls + k;
        if (files && *w->level_file)
            w->levels = motion_files_read(files, w->level_file, COLUMNS);
        if (files && *w->discharge_file)
            w->discharges = motion_files_read(files, w->discharge_file, COLUMNS);
        w->has_level = w->level < LEVEL_TOP || *w->level_file;
        w->has_discharge = w->discharge != 0.0 || *w->discharge_file;
    }
}

enum { PLACES = 256, HALVINGS = 24, ROWS = 64 }; /* along the height and across a side */

/* Height of the highest place of fluid on the vertical through x, whose height is changed, of n
 * places, - infinity: none; exact to 1e-9 of the line where there is air above it. */
static double top_along(const struct scene *s, const struct exact *e, int up, double *x)
{
    const double lo = s->domain.min[up], length = s->domain.max[up] - lo;
    const bool down = s->fluid.gravity[up] > 0.0; /* gravity along the axis */
    double wet = -1.0;
    for (int k = 0; k < PLACES; k++) {
        const double part = (k + 0.5) / PLACES;
        x[up] = lo + length * (down ? 1.0 - part : part);
        wet = scene_is_fluid(s, e, x, NULL) ? part : wet;
    }
    if (wet < 0.0)
        return -INFINITY;
    double dry = wet + 1.0 / PLACES;
    for (int k = 0; k < HALVINGS; k++) {
        const double part = 0.5 * (wet + dry);
        x[up] = lo + length * (down ? 1.0 - part : part);
        *(scene_is_fluid(s, e, x, NULL) ? &wet : &dry) = part;
    }
    x[up] = lo + length * (down ? 1.0 - wet : wet);
    return scene_height(s, x);
}

double openings_top_over(const struct scene *s, const struct exact *e, const double x[3])
{
    double at[3] = {x[0], x[1], x[2]};
    return top_along(s, e, scene_still_axis(s), at);
}

bool openings_have_outside(const struct scene *s)
{
    return scene_still_axis(s) >= 0 && !scene_has_wave(s);
}

/* What left was held by a mean velocity of two transits, which are many times longer near critical
 * flow. Behind a gate, 0.12 m^2/s out to 0.06 m, critical depth 0.114 m, the tail water stood 0.14
 * m high for ten seconds and longer. Whole where the discharge at the given depth would have Froude
 * number 1.25 and more. */
double openings_fall(double g, double raised, double given, double inside, double u)
{
    const double q = fmax(0.0, u * inside), critical = g > 0.0 ? cbrt(q * q / g) : 0.0;
    const double Fr = given > 0.0 ? pow(critical / given, 1.5) : critical > 0.0 ? INFINITY : 0.0;
    const double share = fmax(0.0, fmin(4.0 * (Fr - 1.0), 1.0));
    return share * fmax(0.0, raised - fmin(critical, inside));
}

bool openings_are_lower(const struct scene *s, double top)
{
    double low, high;
    if (s->initial.level < LEVEL_TOP)
        return false;
    scene_heights(s, &low, &high);
    return top < fmin(scene_water_top(s), high) - 1e-6 * (high - low);
}

/* Rows of places along an upright side, just inside it: along the height `up', in 3D side by side.
 */
static int rows_of(const struct scene *s) { return s->domain.dim == 3 ? ROWS : 1; }

static void go_to_row(const struct scene *s, int side, int up, int row, double *x)
{
    const struct scene_domain *d = &s->domain;
    const int a = side / 2, across = 3 - a - up;
    x[a] = side % 2 ? d->max[a] - 1e-3 * (d->max[a] - d->min[a])
                    : d->min[a] + 1e-3 * (d->max[a] - d->min[a]);
    if (d->dim == 3)
        x[across] = d->min[across] + (row + 0.5) / ROWS * (d->max[across] - d->min[across]);
}

/* As top_along, of all rows of a side. */
static double top_at(const struct scene *s, const struct exact *e, int side, int up)
{
    double top = -INFINITY, x[3] = {0.0, 0.0, 0.0};
    for (int row = 0; row < rows_of(s); row++) {
        go_to_row(s, side, up, row, x);
        top = fmax(top, top_along(s, e, up, x));
    }
    return top;
}

/* Of the water at a side, m^(dim-1). */
static double wet_area(const struct scene *s, const struct exact *e, int side, int up)
{
    const struct scene_domain *d = &s->domain;
    const int across = 3 - side / 2 - up;
    double x[3] = {0.0, 0.0, 0.0}, wet = 0.0;
    for (int row = 0; row < rows_of(s); row++) {
        go_to_row(s, side, up, row, x);
        for (int i = 0; i < PLACES; i++) {
            x[up] = d->min[up] + (i + 0.5) / PLACES * (d->max[up] - d->min[up]);
            wet += scene_is_fluid(s, e, x, NULL);
        }
    }
    return wet / PLACES / rows_of(s) * (d->max[up] - d->min[up]) *
           (d->dim == 3 ? d->max[across] - d->min[across] : 1.0);
}

/* An opening with a level of its own stands across a horizontal axis. */
static bool is_upright(const struct scene *s, const struct scene_wall *w, int up)
{
    const int axis = (w->side - SIDE_X_MIN) / 2;
    return up >= 0 && w->side != SIDE_NONE && axis != up && axis < s->domain.dim &&
           !s->domain.periodic[axis];
}

/* For outflows of which the case says nothing: the water at the side as the shapes have it is what
 * stands outside; without any it falls. */
void openings_resolve(struct scene *s)
{
    const struct exact e = exact_create(s);
    const int up = scene_still_axis(s);
    for (int k = 0; k < s->nwalls; k++) {
        struct scene_wall *w = s->walls + k;
        w->stands = NAN;
        if (!openings_have_outside(s) || w->kind != WALL_OUTFLOW || !is_upright(s, w, up) ||
            w->has_level || w->has_discharge || w->carried)
            continue;
        const double top = top_at(s, &e, w->side - SIDE_X_MIN, up);
        w->falls = !isfinite(top);
        w->stands = w->falls ? NAN : top;
        w->lower = !w->falls && openings_are_lower(s, top);
    }
}

/* Linear between rows, held before the first and after the last. */
static double value_at(const struct motion_file *m, double t)
{
    const double *last = m->rows + COLUMNS * (m->n - 1);
    if (!(t > m->rows[0]))
        return m->rows[1];
    if (t >= last[0])
        return last[1];
    const double *a = m->rows + COLUMNS * lookup_row(m->rows, COLUMNS, m->n - 1, t);
    const double *b = a + COLUMNS;
    return a[1] + (t - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

double wall_level(const struct scene_wall *w, double t)
{
    return w->levels && w->levels->n > 0 ? value_at(w->levels, t) : w->level;
}

/* Lines between rows: the steepest span begins or ends at a row. */
double wall_level_change(const struct scene_wall *w, double span)
{
    double most = 0.0;
    for (int k = 0; w->levels && k < w->levels->n; k++) {
        const double t = w->levels->rows[COLUMNS * k], now = w->levels->rows[COLUMNS * k + 1];
        most = fmax(most, fmax(fabs(value_at(w->levels, t + span) - now),
                               fabs(now - value_at(w->levels, t - span))));
    }
    return most;
}

/* m/s: by central differences over span, s on both sides; it fades where these differ by more than
 * a third of surge, m: at a step of the file or a turn the mean is the rate of neither. */
double wall_level_rise(const struct scene_wall *w, double span, double surge, double t)
{
    const double now = wall_level(w, t), before = now - wall_level(w, t - span),
                 after = wall_level(w, t + span) - now;
    const double bend = surge > 0.0 ? fabs(after - before) / surge : 0.0;
    return fmax(0.0, fmin(1.0, 2.0 - 3.0 * bend)) * (before + after) / (2.0 * span);
}

double wall_discharge(const struct scene_wall *w, double t)
{
    return w->discharges && w->discharges->n > 0 ? value_at(w->discharges, t) : w->discharge;
}

static void range_of(const struct motion_file *m, double range[2])
{
    range[0] = range[1] = m->rows[1];
    for (int k = 1; k < m->n; k++) {
        range[0] = fmin(range[0], m->rows[COLUMNS * k + 1]);
        range[1] = fmax(range[1], m->rows[COLUMNS * k + 1]);
    }
}

/* m/s: of the largest discharge over the water that its side has at the start. */
double openings_discharge_speed(const struct scene *s)
{
    const int up = scene_still_axis(s);
    double speed = 0.0;
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        double range[2] = {0.0, fabs(w->discharge)};
        if (!w->has_discharge || w->kind < WALL_INFLOW || !is_upright(s, w, up))
            continue;
        if (w->discharges && w->discharges->n > 0)
            range_of(w->discharges, range);
        const struct exact e = exact_create(s);
        const double area = wet_area(s, &e, w->side - SIDE_X_MIN, up);
        speed = area > 0.0 ? fmax(speed, range[1] / area) : speed;
    }
    return speed;
}

static void check_file(const struct params *p, struct faults *f, int k, const char *name,
                       const char *file, const struct motion_file *m, bool also_constant)
{
    double range[2];
    if (!m)
        return;
    const char *key = key_text("walls.[%d].%s_file", k, name);
    if (m->n <= 0) {
        char text[1400];
        motion_file_fault(m, key_text("a time and a %s", name), text, sizeof text);
        params_fault(p, f, key, "%s", text);
    } else if (also_constant)
        params_fault(p, f, key, "%s and a constant %s: give one of the two", file, name);
    if (m->n <= 0 || *name == 'l')
        return;
    range_of(m, range);
    if (range[0] < 0.0)
        params_fault(p, f, key,
                     "%s: a discharge of %g: it is positive, in through an inflow and out through "
                     "an outflow",
                     file, range[0]);
}

/* Water stands no higher than the domain; below the bed it falls out of an outflow, but nothing
 * comes in. */
static void check_level(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_wall *w = s->walls + k;
    double low, high, range[2] = {w->level, w->level};
    if (!w->has_level || w->kind < WALL_INFLOW || scene_still_axis(s) < 0 ||
        (w->levels && w->levels->n <= 0))
        return;
    if (w->levels)
        range_of(w->levels, range);
    const char *key = key_text("walls.[%d].level%s", k, w->levels ? "_file" : "");
    scene_heights(s, &low, &high);
    if (range[1] > high + 1e-9 * (high - low))
        params_fault(p, f, key,
                     "%g m is above the domain, whose heights are %g to %g m: raise domain.%s, or "
                     "lower the level",
                     range[1], low, high,
                     s->fluid.gravity[scene_still_axis(s)] > 0.0 ? "min" : "max");
    if (w->kind == WALL_INFLOW && range[0] <= low)
        params_fault(p, f, key,
                     "%g m is no higher than the domain's bottom, %g m: nothing flows in; a higher "
                     "level, or kind = \"outflow\"",
                     range[0], low);
}

void wall_histories_check(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        check_file(p, f, k, "level", w->level_file, w->levels, w->level < LEVEL_TOP);
        check_file(p, f, k, "discharge", w->discharge_file, w->discharges, w->discharge != 0.0);
        check_level(s, p, f, k);
    }
}

static const char *text_of(const struct motion_file *m, const char *file, double constant,
                           const char *unit, char *text)
{
    double range[2];
    if (!m || m->n <= 0) {
        snprintf(text, TEXT, "%g %s", constant, unit);
        return text;
    }
    range_of(m, range);
    snprintf(text, TEXT, "%g to %g %s by %.80s", range[0], range[1], unit, file);
    return text;
}

static const char *level_text(const struct scene_wall *w, char *text)
{
    return text_of(w->levels, w->level_file, w->level, "m high", text);
}

static const char *discharge_text(const struct scene_wall *w, int dim, char *text)
{
    return text_of(w->discharges, w->discharge_file, w->discharge, dim == 2 ? "m^2/s" : "m^3/s",
                   text);
}

void openings_describe_outside(const char *side, double stands, bool falls)
{
    if (falls)
        log_say("%s: nothing stands there at the start: water that comes falls out", side);
    else if (isfinite(stands))
        log_say("%s: water %g m high outside, as inside at the start, waves leave; the velocity "
                "is that inside",
                side, stands);
    else
        log_say("%s: water outside as high as at the start, waves leave; the velocity is that "
                "inside",
                side);
}

/* Rows that end within the run: what holds on is the last of them. */
static void warn_of_ends(const struct motion_file *m, const char *file, double end)
{
    const double *last = m && m->n > 0 ? m->rows + COLUMNS * (m->n - 1) : NULL;
    if (last && (m->rows[0] > 0.0 || last[0] < end * (1.0 - 1e-9)))
        log_warn("%s has t = %g to %g s, the run goes from 0 to %g s: before its first row and "
                 "after its last, %g, their values hold",
                 file, m->rows[0], last[0], end, last[1]);
}

/* What lets waves out at either end, c (u - U) with U the mean over T = 2 L/c, takes a steady
 * difference g dz of levels for a wave: L du/dt = g dz - 2 c (u - U), (u - U)' = du/dt - (u - U)/T,
 * tends to a fifth, L du/dt = g dz/5. Out of water at rest nothing runs faster than sqrt(2 g dz):
 * u = sqrt(2 g dz) tanh(t/t_0), t_0 = 5 L sqrt(2/(g dz)). */
static void warn_of_slow_start(const struct scene *s)
{
    double still[3];
    const bool moves = scene_shapes_flow(s) ||
                       (s->initial.field != FIELD_REST && vec3_length(s->initial.velocity) > 0.0);
    for (int a = 0; a < s->domain.dim && !moves; a++) {
        const struct scene_wall *w[2] = {scene_wall_of(s, SIDE_X_MIN + 2 * a),
                                         scene_wall_of(s, SIDE_X_MAX + 2 * a)};
        if (!w[0] || !w[1] || !w[0]->has_level || !w[1]->has_level)
            continue;
        const double z[2] = {wall_level(w[0], 0.0), wall_level(w[1], 0.0)},
                     L = s->domain.max[a] - s->domain.min[a],
                     bed = scene_is_driven_along(s, a) ? s->fluid.gravity[a] * L : 0.0,
                     push = fabs(scene_still_gravity(s, still) * (z[0] - z[1]) + bed),
                     t0 = 5.0 * L * sqrt(2.0 / push);
        if (push > 0.0 && s->time.end < 2.0 * t0)
            log_warn("walls: between the levels of %c_min and %c_max, %g and %g m, water at rest "
                     "gains %.2g m/s in a second, a fifth of what they drive it by, for what lets "
                     "waves out takes the rest; from tank to tank it reaches three quarters of "
                     "%.3g m/s in %.3g s; start it with its velocity (initial.field = "
                     "\"uniform\")",
                     "xyz"[a], "xyz"[a], z[0], z[1], 0.2 * push / L, sqrt(2.0 * push), t0);
    }
}

void openings_describe(const struct scene *s)
{
    char text[TEXT];
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        const bool in = w->kind == WALL_INFLOW;
        const char *side = w->side == SIDE_NONE ? "" : scene_side_names[w->side - SIDE_X_MIN];
        if (w->kind < WALL_INFLOW)
            continue;
        warn_of_ends(w->levels, w->level_file, s->time.end);
        warn_of_ends(w->discharges, w->discharge_file, s->time.end);
        if (w->has_discharge)
            log_say("%s: %s %s, uniform over the water, whose level is that inside", side,
                    discharge_text(w, s->domain.dim, text), in ? "in" : "out");
        else if (w->has_level)
            log_say("%s: water %s %s, waves leave; the velocity is that inside", side,
                    level_text(w, text), in ? "in the inlet" : "outside");
        else if (w->carried)
            log_say("%s: a channel without end in the state of the start, waves leave", side);
        else if (in)
            log_say("%s: velocity given, the level is that inside", side);
        else
            openings_describe_outside(side, w->stands, w->falls);
    }
    warn_of_slow_start(s);
}

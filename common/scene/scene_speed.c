/* scene_speed.c - the largest velocity that a scene lets expect; see scene_speed.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scene_speed.h"

#include "exact.h"
#include "scene_fluid.h"
#include "scene_geometry.h"
#include "scene_mesh.h"
#include "scene_openings.h"
#include "scene_reference.h"

static double extent(const struct scene *s, int a) { return s->domain.max[a] - s->domain.min[a]; }

/* Amplitude of the field, without what carries it. */
static double field_speed(const struct scene *s)
{
    const struct scene_initial *f = &s->initial;
    double period, rate;
    switch (f->field) {
    case FIELD_TAYLOR_GREEN:
    case FIELD_TWO_MODES:
    case FIELD_COUETTE:
    case FIELD_PATCH:
        return f->U;
    case FIELD_DROP:
        return fmax(f->U, s->fluid.central * f->L);
    case FIELD_BELTRAMI:
        return sqrt(6.0) * f->U; /* where all sines and cosines are sqrt(1/2) */
    case FIELD_REGULAR:
    case FIELD_SOLITARY: {
        const struct exact e = exact_create(s);
        double u[2];
        steady_point(&e.steady, e.steady.x, e.steady.crest, 0.0, u, NULL);
        return u[0];
    }
    case FIELD_STANDING_WAVE:
    case FIELD_STOKES: {
        const struct exact e = exact_create(s);
        if (f->field == FIELD_STOKES) /* a breaking crest overtakes the wave */
            return e.stokes.omega / e.stokes.k;
        return exact_oscillation(&e, &period, &rate) ? 2.0 * M_PI / period * fabs(f->amplitude)
                                                     : 0.0;
    }
    default:
        return 0.0;
    }
}

/* What carries the field. */
static double carrying_speed(const struct scene *s)
{
    const struct scene_initial *f = &s->initial;
    const bool carried = f->field == FIELD_UNIFORM || f->field == FIELD_TAYLOR_GREEN ||
                         f->field == FIELD_TWO_MODES || f->field == FIELD_BELTRAMI;
    return carried ? vec3_length(f->velocity) : 0.0;
}

/* The field, what carries it and what shapes add to it. */
static double first_speed(const struct scene *s)
{
    double more = 0.0;
    for (int k = 0; k < s->nshapes; k++)
        more = fmax(more, s->shapes[k].hole ? 0.0 : vec3_length(s->shapes[k].velocity));
    return field_speed(s) + carrying_speed(s) + more;
}

/* Area (in 2D length) of a side of the domain. */
static double area(const struct scene *s, int side)
{
    double A = 1.0;
    for (int a = 0; a < s->domain.dim; a++)
        A *= a == (side - SIDE_X_MIN) / 2 ? 1.0 : extent(s, a);
    return A;
}

/* Mean of an inflow's velocity over its largest one, -: of parabolas between closed sides, along
 * each of two in 3D. */
static double mean_share(const struct scene *s, const struct scene_wall *w)
{
    double share = 1.0;
    for (int a = 0; a < s->domain.dim && w->profile == PROFILE_PARABOLIC; a++)
        share *= a == (w->side - SIDE_X_MIN) / 2 || s->domain.periodic[a] ? 1.0 : 2.0 / 3.0;
    return share;
}

/* What comes in leaves by the outlets, in the parabola that it has or one whose largest velocity is
 * 3/2 of the mean. */
static double inflow_speed(const struct scene *s)
{
    double speed = 0.0, rate = 0.0, out = 0.0; /* rate: with the largest velocity, m^dim/s */
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        const double u = vec3_length(w->velocity);
        if (w->kind == WALL_INFLOW) {
            speed = fmax(speed, u);
            rate += area(s, w->side) * u * (w->profile == PROFILE_PARABOLIC ? 1.0 : 1.5);
        } else if (w->kind > WALL_INFLOW) {
            out += area(s, w->side);
        }
    }
    return out > 0.0 ? fmax(speed, rate / out) : speed;
}

/* Of walls that move along themselves. */
static double wall_speed(const struct scene *s)
{
    double speed = 0.0;
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind < WALL_INFLOW)
            speed = fmax(speed, vec3_length(s->walls[k].velocity));
    return speed;
}

/* What it turns about; that of a free body of given density follows from its outline, and the
 * middle is near enough. */
static void body_centre(const struct scene_body *b, double centre[3])
{
    double lo[3], hi[3];
    memcpy(centre, b->centre, sizeof b->centre);
    if (!b->free || b->mass > 0.0)
        return;
    scene_body_box(b, lo, hi);
    for (int a = 0; a < 3; a++)
        centre[a] = 0.5 * (lo[a] + hi[a]);
}

/* Of all bodies, or of those alone whose velocity is given. */
static double body_speed(const struct scene *s, bool free)
{
    double speed = 0.0;
    for (int k = 0; k < s->nbodies; k++) {
        const struct scene_body *b = s->bodies + k;
        const struct scene_mesh *mesh = b->mesh;
        double reach = 0.0, centre[3];
        if (b->free && !free)
            continue;
        body_centre(b, centre);
        for (int i = 0; i < b->points.n; i++)
            reach =
                fmax(reach, hypot(b->points.x[i][0] - centre[0], b->points.x[i][1] - centre[1]));
        for (int i = 0; mesh && i < 8; i++) {
            const double d[3] = {(i & 1 ? mesh->hi : mesh->lo)[0] - centre[0],
                                 (i & 2 ? mesh->hi : mesh->lo)[1] - centre[1],
                                 (i & 4 ? mesh->hi : mesh->lo)[2] - centre[2]};
            reach = fmax(reach, vec3_length(d));
        }
        speed = fmax(speed, vec3_length(b->velocity) + vec3_length(b->spin) * reach);
    }
    return speed;
}

/* Gravity along the axes where it drives nothing, unless it is in the reference of the pressure. */
static double weight(const struct scene *s, double g[3])
{
    const struct scene_reference of = scene_reference(s);
    (void)scene_still_gravity(s, g);
    for (int a = 0; a < 3; a++)
        g[a] = of.slope[a] == 0.0 ? g[a] : 0.0;
    return vec3_length(g);
}

/* Range of heights against gravity of a box cut to the domain; axes without extent go through. */
static void heights(const struct scene *s, const double *g, const double *lo, const double *hi,
                    double range[2])
{
    const double size = vec3_length(g);
    range[0] = range[1] = 0.0;
    for (int a = 0; a < s->domain.dim; a++) {
        const bool whole = !(hi[a] > lo[a]);
        const double l = whole ? s->domain.min[a] : fmax(lo[a], s->domain.min[a]);
        const double h = whole ? s->domain.max[a] : fmin(hi[a], s->domain.max[a]);
        range[0] += fmin(-g[a] * l, -g[a] * h) / size;
        range[1] += fmax(-g[a] * l, -g[a] * h) / size;
    }
}

/* m: height of its highest place within the domain. */
static double shape_top(const struct scene *s, const double *g, const struct scene_shape *h)
{
    double lo[3] = {0.0}, hi[3] = {0.0}, range[2];
    if (h->form == SHAPE_BELOW)
        return h->level;
    const struct scene_mesh *mesh = scene_mesh_of(s, MESH_OF_SHAPE, (int)(h - s->shapes));
    scene_shape_extent(h, lo, hi);
    if (mesh) {
        memcpy(lo, mesh->lo, sizeof lo);
        memcpy(hi, mesh->hi, sizeof hi);
    }
    heights(s, g, lo, hi, range);
    return range[1];
}

/* -INFINITY: no water, or no weight. */
double scene_water_top(const struct scene *s)
{
    double g[3], top = -INFINITY;
    const bool heavy = weight(s, g) > 0.0;
    for (int k = 0; k < s->nshapes && heavy; k++)
        top = fmax(top, s->shapes[k].hole ? -INFINITY : shape_top(s, g, s->shapes + k));
    return top;
}

/* Box around a tank; around the ball that holds it if it moves, for it may turn. */
static void tank_box(const struct scene_body *b, double lo[3], double hi[3])
{
    double across = 0.0;
    scene_body_box(b, lo, hi);
    for (int a = 0; a < 3; a++)
        across += (hi[a] - lo[a]) * (hi[a] - lo[a]);
    for (int a = 0; a < 3 && scene_body_moves(b); a++) {
        const double middle = 0.5 * (lo[a] + hi[a]);
        lo[a] = middle - 0.5 * sqrt(across);
        hi[a] = middle + 0.5 * sqrt(across);
    }
}

/* Box around the tank or the meshes that hold the fluid, where no side of the domain does, or
 * around the line that does; else no extent. */
static void room_of(const struct scene *s, double lo[3], double hi[3])
{
    bool sides = !s->meshes, any = false;
    if (s->domain.dim == 2)
        scene_basin(s, lo, hi);
    for (int k = 0; k < s->nwalls; k++)
        sides = sides || s->walls[k].side != SIDE_NONE;
    for (int k = 0; !sides && k < s->meshes->n; k++) {
        const struct scene_mesh *m = s->meshes->of + k;
        if (m->owner != MESH_OF_WALL || m->fluid_side != FLUID_INSIDE)
            continue;
        for (int a = 0; a < 3; a++) {
            lo[a] = any ? fmin(lo[a], m->lo[a]) : m->lo[a];
            hi[a] = any ? fmax(hi[a], m->hi[a]) : m->hi[a];
        }
        any = true;
    }
    for (int k = 0; k < s->nbodies; k++)
        if (s->bodies[k].tank)
            tank_box(s->bodies + k, lo, hi);
}

/* Height by which a channel's bed falls where leaning gravity gives its slope. */
static double drop_of(const struct scene *s, double weight)
{
    double drop = 0.0;
    for (int a = 0; a < s->domain.dim; a++)
        if (scene_is_driven_along(s, a) && !s->domain.periodic[a])
            drop += fabs(s->fluid.gravity[a]) * extent(s, a) / weight;
    return drop;
}

/* Depth of the water and the height that it can fall. */
static void find_fall(const struct scene *s, double *depth, double *fall)
{
    double g[3], range[2], lo[3] = {0.0}, hi[3] = {0.0};
    bool still = true;
    *depth = *fall = 0.0;
    if (weight(s, g) == 0.0)
        return;
    room_of(s, lo, hi);
    heights(s, g, lo, hi, range);
    if (scene_has_wave(s)) {
        const double level = s->initial.level < LEVEL_TOP ? s->initial.level : range[1];
        *depth = fmin(level + fabs(s->initial.amplitude), range[1]) - range[0];
        *fall = 2.0 * fabs(s->initial.amplitude);
        return;
    }
    *depth = range[1] - range[0];
    for (int k = 0; k < s->nshapes; k++)
        still = still && scene_is_level(s, s->shapes + k);
    if (s->nshapes > 0)
        *depth = fmax(fmin(scene_water_top(s), range[1]) - range[0], 0.0);
    for (int k = 0; k < s->nwalls; k++) /* it can run out, but by a side that waves keep full */
        still = still && (s->walls[k].kind < WALL_OUTFLOW || s->walls[k].zone != ZONE_NONE);
    if (scene_has_surface(s) || !still)
        *fall = (still && s->nshapes > 0 ? 0.0 : *depth) + drop_of(s, weight(s, g));
    if (s->has_waves && still) { /* crests and troughs of a standing wave, before a wall */
        *depth += 2.0 * s->waves.made.crest;
        *fall = 4.0 * s->waves.made.crest;
    }
}

/* What an acceleration makes of fluid at rest within the run, at most the steady flow that friction
 * on walls allows: a h^2/(8 nu) between two planes h apart, a h^2/(2 nu) over one. */
static double driven(const struct scene *s, double a)
{
    double h = INFINITY, gap = INFINITY;
    for (int b = 0; b < s->domain.dim; b++) {
        const struct scene_wall *lo = scene_wall_of(s, SIDE_X_MIN + 2 * b);
        const struct scene_wall *hi = scene_wall_of(s, SIDE_X_MIN + 2 * b + 1);
        h = s->domain.periodic[b] ? h : fmin(h, extent(s, b));
        if (lo && hi && lo->kind == WALL_NO_SLIP && hi->kind == WALL_NO_SLIP)
            gap = fmin(gap, extent(s, b));
    }
    double steady = INFINITY;
    if (s->fluid.nu > 0.0 && gap < INFINITY)
        steady = a * gap * gap / (8.0 * s->fluid.nu);
    else if (s->fluid.nu > 0.0 && scene_has_no_slip(s) && h < INFINITY)
        steady = a * h * h / (2.0 * s->fluid.nu);
    return fmin(a * s->time.end, steady);
}

/* Size of the body force along periodic axes. */
static double driving_force(const struct scene *s)
{
    double a2 = 0.0;
    for (int a = 0; a < s->domain.dim; a++)
        a2 += s->domain.periodic[a] ? pow(s->fluid.gravity[a], 2.0) : 0.0;
    return sqrt(a2);
}

/* Body force along periodic axes, where nothing holds against it. */
static double driven_speed(const struct scene *s)
{
    const double a = driving_force(s);
    return a > 0.0 ? driven(s, a) : 0.0;
}

/* Largest pressure of the outlets over the reference, and what their difference accelerates. What
 * rounding leaves of pressures that balance the weight is none. */
static double outlet_speed(const struct scene *s, double *pressure)
{
    const struct scene_reference of = scene_reference(s);
    double lo = INFINITY, hi = -INFINITY, length = 0.0, largest = 0.0;
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind >= WALL_OUTFLOW) {
            const double p = scene_reference_left(s, &of, s->walls + k) / s->fluid.rho;
            lo = fmin(lo, p);
            hi = fmax(hi, p);
            largest = fmax(largest, fabs(s->walls[k].pressure) / s->fluid.rho);
        }
    for (int a = 0; a < s->domain.dim; a++)
        length = fmax(length, extent(s, a));
    const double rounding = 1e-12 * (vec3_length(s->fluid.gravity) * length + largest);
    *pressure = fmax(fabs(lo), fabs(hi));
    if (!(hi >= lo && *pressure > rounding))
        *pressure = 0.0;
    if (!(hi - lo > rounding))
        return 0.0;
    return fmin(sqrt(2.0 * (hi - lo)), driven(s, (hi - lo) / length));
}

/* --- slow viscous flow --- */

/* Shortest length over which the velocity varies: between walls or openings, across a body, of a
 * field that repeats itself (1/k); INFINITY: none. */
static double shortest(const struct scene *s)
{
    const struct scene_initial *f = &s->initial;
    const bool waves =
        f->field == FIELD_TAYLOR_GREEN || f->field == FIELD_TWO_MODES || f->field == FIELD_BELTRAMI;
    double least = waves ? f->L / (2.0 * M_PI) : INFINITY;
    for (int a = 0; a < s->domain.dim; a++)
        least = fmin(least, s->domain.periodic[a] ? INFINITY : extent(s, a));
    for (int k = 0; k < s->nbodies; k++) {
        double lo[3], hi[3];
        scene_body_box(s->bodies + k, lo, hi);
        for (int a = 0; a < 2; a++)
            least = hi[a] > lo[a] ? fmin(least, hi[a] - lo[a]) : least;
    }
    for (int k = 0; s->meshes && k < s->meshes->n; k++) {
        const struct scene_mesh *m = s->meshes->of + k;
        for (int a = 0; a < 3 && m->owner != MESH_OF_SHAPE; a++)
            least = m->mesh.closed ? fmin(least, m->hi[a] - m->lo[a]) : least;
    }
    return least;
}

/* Whether the velocity jumps along a no-slip wall: a lid that meets another wall, a stream or a
 * uniform inflow that meets one at once, a body that starts. */
static bool has_jumps(const struct scene *s)
{
    const bool stream = s->initial.field == FIELD_UNIFORM && vec3_length(s->initial.velocity) > 0.0;
    bool jumps = stream && scene_has_no_slip(s);
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        for (int a = 0; a < s->domain.dim; a++)
            jumps = jumps ||
                    (w->kind == WALL_NO_SLIP && w->velocity[a] != 0.0 && !s->domain.periodic[a]);
        jumps = jumps ||
                (w->kind == WALL_INFLOW && w->profile != PROFILE_PARABOLIC && scene_has_no_slip(s));
    }
    for (int k = 0; k < s->nbodies; k++) {
        const struct scene_body *b = s->bodies + k;
        jumps = jumps ||
                (b->kind == WALL_NO_SLIP &&
                 (vec3_length(b->velocity) > 0.0 || vec3_length(b->spin) > 0.0 || b->motion.n > 0));
    }
    return jumps;
}

/* Sum of 12/h^2 over the axes that no-slip sides h apart bound, 3/h^2 with one of them: the
 * friction nu U of it holds back a stream along axis a between planes; of a square duct it is 5/6
 * (White 1991, 3-3). */
static double narrowness(const struct scene *s, int a)
{
    double sum = 0.0;
    for (int b = 0; b < s->domain.dim; b++) {
        const double h = extent(s, b);
        int n = 0;
        for (int end = 0; end < 2 && b != a; end++) {
            const struct scene_wall *w = scene_wall_of(s, SIDE_X_MIN + 2 * b + end);
            n += w && w->kind == WALL_NO_SLIP;
        }
        sum += (n == 2 ? 12.0 : n == 1 ? 3.0 : 0.0) / (h * h);
    }
    return sum;
}

/* What pushes an inflow through a channel as long as the domain. */
static double channel_pressure(const struct scene *s)
{
    double most = 0.0;
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        if (w->kind != WALL_INFLOW)
            continue;
        const int a = (w->side - SIDE_X_MIN) / 2;
        const double mean = fabs(w->velocity[a]) * mean_share(s, w);
        most = fmax(most, s->fluid.nu * mean * extent(s, a) * narrowness(s, a));
    }
    return most;
}

/* Pressures of slow flow (Morris, Fox & Zhu 1997): nu U/L, F L where something stands in the way of
 * a body force, and the friction along a channel. Where the velocity jumps nu U/r, r the distance
 * (Taylor 1962), to whatever the run resolves. */
static double viscous_pressure(const struct scene *s, double U, double spacing)
{
    const double L = shortest(s);
    if (!(s->fluid.nu > 0.0 && L < INFINITY))
        return 0.0;
    const double least = spacing > 0.0 && has_jumps(s) ? fmin(L, spacing) : L;
    const double held = scene_has_lines(s) ? driving_force(s) * L : 0.0;
    return fmax(fmax(s->fluid.nu * U / least, held), channel_pressure(s));
}

/* The largest counts, with the words for where it comes from. */
static void take(struct scene_speed *v, double speed, const char *from)
{
    if (!(speed > v->speed))
        return;
    v->speed = speed;
    v->from = from;
}

/* A scene in which nothing moves needs a scale all the same: what its static pressure would make of
 * a jet; without any, the domain crossed once in the run. */
static void take_still(const struct scene *s, struct scene_speed *v)
{
    double length = 0.0;
    v->moves = v->speed > 0.0;
    if (v->moves)
        return;
    for (int a = 0; a < s->domain.dim; a++)
        length = fmax(length, extent(s, a));
    take(v, sqrt(v->pressure), "the static pressure: nothing moves");
    take(v, v->speed > 0.0 ? 0.0 : length / s->time.end,
         "the domain's length over time.end: nothing moves");
}

/* See struct scene_speed. Across an absorbing side sound leaves. */
static double sound_across(const struct scene *s, double depth)
{
    double lo[3], hi[3], across = 0.0;
    bool tank = false;
    for (int k = 0; k < s->nbodies; k++)
        tank = tank || s->bodies[k].tank;
    if (scene_has_surface(s) && (depth > 0.0 || !tank))
        return 2.0 * depth;
    memcpy(lo, s->domain.min, sizeof lo);
    memcpy(hi, s->domain.max, sizeof hi);
    room_of(s, lo, hi);
    for (int a = 0; a < s->domain.dim; a++)
        across = fmax(across, (s->domain.periodic[a] ? 0.5 : 1.0) * (hi[a] - lo[a]));
    for (int k = 0; k < s->nwalls; k++)
        across = s->walls[k].kind == WALL_ABSORBING ? 0.0 : across;
    return across;
}

/* See struct scene_speed. */
static double stream_speed(const struct scene *s)
{
    double pressure;
    double speed = carrying_speed(s);
    speed = fmax(speed, fmax(inflow_speed(s), openings_discharge_speed(s)));
    speed = fmax(speed, fmax(wall_speed(s), body_speed(s, false)));
    return fmax(speed, fmax(driven_speed(s), outlet_speed(s, &pressure)));
}

struct scene_speed scene_speed_of(const struct scene *s, double file, double spacing)
{
    struct scene_speed v = {.from = "", .stream = stream_speed(s)};
    double depth, fall, g[3], central = 0.0, pressure;
    const double first = first_speed(s), size = weight(s, g);
    find_fall(s, &depth, &fall);
    for (int a = 0; a < s->domain.dim && s->nshapes > 0;
         a++) /* falls to the origin from a corner */
        central += pow(fmax(fabs(s->domain.min[a]), fabs(s->domain.max[a])), 2.0);
    take(&v, first, "the flow at the start");
    take(&v, inflow_speed(s), "the inflow");
    take(&v, openings_discharge_speed(s), "the discharge over the water at its side");
    take(&v, wall_speed(s), "the moving walls");
    take(&v, fmax(body_speed(s, true), file), "the moving bodies");
    take(&v, s->waves.made.speed, "the waves");
    take(&v, driven_speed(s), "the body force along periodic axes");
    take(&v, outlet_speed(s, &pressure), "the pressures of the outlets");
    take(&v, s->fluid.central * sqrt(central), "the central force");
    v.pressure = fmax(size * depth, pressure);
    v.across = sound_across(s, depth);
    v.viscous = viscous_pressure(s, v.speed, spacing); /* a fall makes no more than its weight */
    if (fall > 0.0)
        take(&v, sqrt(2.0 * size * fall + v.speed * v.speed), "the fall of the water");
    take_still(s, &v);
    return v;
}

/* body_pace.c - how fast and how quickly bodies will move: the scale of sound speeds.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "body_pace.h"

#include "../../common/scene/scene.h"
#include "bodies.h"

/* Fall through the air above the water, and what weight and buoyancy make of a body in it. */
static double fall_of(const struct scene *c, const struct body *b)
{
    double still[3], low, high;
    const double g = scene_still_gravity(c, still);
    if (!b->free || g == 0.0)
        return 0.0;
    scene_heights(c, &low, &high);
    const double base = fmax(scene_height(c, b->centre) - b->reach - low, 0.0);
    double air = c->nshapes > 0 ? base : 0.0; /* above the highest water below a level */
    for (int k = 0; k < c->nshapes; k++)
        if (scene_is_level(c, c->shapes + k))
            air = fmin(
                air,
                fmax(scene_height(c, b->centre) - b->reach - scene_level(c, c->shapes + k), 0.0));
    const double size = b->dim == 2 ? b->free->mass / (c->fluid.rho * b->reach)
                                    : b->free->mass / (c->fluid.rho * b->reach * b->reach);
    const double in_water = fmin(fmax(2.0 * b->reach, size), fmax(base, 2.0 * b->reach));
    return sqrt(2.0 * g * (air + 0.5 * in_water));
}

/* What loads and springs make of a body at rest. */
struct forced {
    /* m/s, m/s^2 of its farthest point; 1/s: at which it swings on its springs, as if all of them
     * were along one line */
    double speed, acceleration, rate;
};

/* A spring of stiffness k, N/m, that yields to a mass M, kg, stretched by e, m, and started at v,
 * m/s. About a hinge: N m, kg m^2 and angles, arm the distance that one of 1 moves by, m; else 1.
 */
static void add_spring(struct forced *f, double k, double M, double e, double v, double arm)
{
    if (!(k > 0.0 && M < INFINITY))
        return;
    const double omega = sqrt(k / M), speed = fabs(e) * omega;
    f->speed += speed * arm;
    f->acceleration += (speed + fabs(v)) * omega * arm;
    if (speed + fabs(v) > 0.0)
        f->rate = hypot(f->rate, omega / (2.0 * M_PI));
}

/* A steady force F, N, that accelerates by a, m/s^2, for a time, s, until the drag on an area of
 * the body's size, m^2, bears it. */
static void add_load(struct forced *f, double F, double a, double time, double rho, double area)
{
    f->speed += fmin(a * time, sqrt(2.0 * F / (rho * area)));
    f->acceleration += a;
}

/* Water of the body's own volume goes along. Under weight springs have no rate: those that moor a
 * float are stiff, and what rules is its slow swing on the water. */
static struct forced forced_by(const struct scene *c, const struct body *b)
{
    struct forced f = {0.0, 0.0, 0.0};
    double still[3];
    const struct body_free *is = b->free;
    if (!is)
        return f;
    const double wet = 1.0 + c->fluid.rho * b->volume / is->mass, rho = c->fluid.rho;
    const double area = b->dim == 2 ? 2.0 * b->reach : 4.0 * b->reach * b->reach;
    const double time = fmax(c->time.end - b->is->release, 0.0), start = vec3_length(b->now.u);
    const double load = vec3_length(b->is->load), torque = vec3_length(b->is->torque);
    const double J = is->rotation == TURNS_AXIS ? is->J : is->mass * b->reach * b->reach;
    for (int i = 0; i < b->is->lines.n; i++) {
        const struct scene_line *l = b->is->lines.of + i;
        double way[3];
        const double M = wet * body_line_mass(c, b, l, way), length = vec3_length(way),
                     slack = l->length >= 0.0 ? l->length : length;
        add_spring(&f, l->stiffness, M, l->pull_only ? fmax(length - slack, 0.0) : length - slack,
                   start, 1.0);
    }
    if (b->is->hinge.n > 0)
        add_spring(&f, b->is->hinge.of[0].stiffness, wet * J, b->is->hinge.of[0].at_rest,
                   vec3_length(b->now.omega), b->reach);
    if (load > 0.0)
        add_load(&f, load, load / (wet * is->mass), time, rho, area);
    if (torque > 0.0)
        add_load(&f, torque / b->reach, torque * b->reach / (wet * J), time, rho, area);
    if (scene_still_gravity(c, still) > 0.0)
        f.rate = 0.0;
    return f;
}

/* Whether the water that gives way to a body stays between the sides across axis a: not where it
 * may rise over the body. */
static bool is_shut(const struct scene *c, int a)
{
    double still[3];
    const bool free =
        scene_has_surface(c) && (scene_still_gravity(c, still) == 0.0 || still[a] != 0.0);
    return !free && (c->domain.periodic[a] || (scene_side_is_wall(c, SIDE_X_MIN + 2 * a) &&
                                               scene_side_is_wall(c, SIDE_X_MAX + 2 * a)));
}

/* Speed, m/s, of the water that runs past a body told to move along axis a with u: through what the
 * sides leave of the section, S - B, it is u B/(S - B). 0 where it is a piston, before which no gap
 * of a spacing is open. */
static double passing_speed(const struct scene *c, const struct scene_body *b, int axis, double u,
                            double spacing)
{
    double lo[3], hi[3], section = 1.0, body = 1.0;
    bool open = false;
    scene_body_box(b, lo, hi);
    for (int a = 0; a < c->domain.dim && u > 0.0; a++) {
        const double L = c->domain.max[a] - c->domain.min[a];
        const double width = fmin(hi[a], c->domain.max[a]) - fmax(lo[a], c->domain.min[a]);
        if (a == axis)
            continue;
        if (!is_shut(c, a) || !(width > 0.0))
            return 0.0;
        open = open || L - width > 0.9 * spacing;
        section *= L;
        body *= width;
    }
    return open ? u * body / (section - body) : 0.0;
}

/* Of prescribed motion: of the body, or of the water that it drives past itself. */
static double told_speed(const struct scene *c, const struct body *b, double spacing)
{
    const struct body_speeds told = body_drive_speeds(&b->drive, b->reach, c->time.end);
    double most = told.any;
    for (int a = 0; a < c->domain.dim && spacing > 0.0 && !b->is->tank; a++)
        most = fmax(most, passing_speed(c, b->is, a, told.along[a], spacing));
    return most;
}

/* Of prescribed motion, or the start of a free body, whichever is faster, with what springs and
 * loads add; a fall is independent of it, so squares add. */
static double speed_of(const struct scene *c, const struct body *b, const struct forced *f,
                       double spacing)
{
    const double told = told_speed(c, b, spacing);
    const double start =
        b->free ? vec3_length(b->now.u) + b->reach * vec3_length(b->now.omega) : 0.0;
    return hypot(fmax(told, start) + f->speed, fall_of(c, b));
}

double body_speed_of(const struct scene *c, const struct body *b)
{
    const struct forced f = forced_by(c, b);
    return speed_of(c, b, &f, 0.0);
}

struct body_pace bodies_pace(const struct scene *c, struct motion_files *files, double spacing)
{
    struct body_pace most = {0.0, 0.0, 0.0};
    for (int k = 0; k < c->nbodies; k++) {
        struct body b;
        if (!scene_body_moves(c->bodies + k))
            continue;
        body_create(&b, c->bodies + k, scene_body_mesh(c, k), c->domain.dim, files);
        const struct forced f = forced_by(c, &b);
        const double length = (b.is->tank ? 2.0 : 1.0) * b.reach;
        most.speed = fmax(most.speed, speed_of(c, &b, &f, spacing));
        most.pressure = fmax(
            most.pressure, length * (f.acceleration + body_drive_acceleration(&b.drive, b.reach)));
        most.rate = fmax(most.rate, fmax(f.rate, body_drive_rate(&b.drive)));
        body_destroy(&b);
    }
    return most;
}

/* Velocity and acceleration of the centre at t; before the start those of the fluid. */
static void course_at(const struct body_drive *v, const double U[3], double t, double u[3],
                      double a[3])
{
    struct body_motion m = {.u = {U[0], U[1], U[2]}};
    if (t >= 0.0)
        body_drive_motion(v, t, &m);
    memcpy(u, m.u, sizeof m.u);
    memcpy(a, m.du, sizeof m.du);
}

/* At t, by the motion just before and just after. What it changes by between is no jump, so two
 * intervals of which the second is ten times the first tell them apart. */
static struct body_jolt jolt_at(const struct body *b, const double U[3], double t, double end)
{
    double u[4][3], a[4][3], change[2][2];
    const double apart[4] = {-1e-5, -1e-6, 1e-6, 1e-5};
    for (int k = 0; k < 4; k++)
        course_at(&b->drive, U, t + apart[k] * end, u[k], a[k]);
    for (int k = 0; k < 2; k++) {
        vec3_from(u[k], u[3 - k], u[k]);
        vec3_from(a[k], a[3 - k], a[k]);
        change[k][0] = vec3_length(u[k]);
        change[k][1] = vec3_length(a[k]);
    }
    const bool jumps = change[1][0] > 0.5 * change[0][0] || change[1][1] > 0.5 * change[0][1];
    return (struct body_jolt){jumps ? b->is->name : NULL, t,
                              change[1][0] > 0.5 * change[0][0] ? change[1][0] : 0.0,
                              change[1][1] > 0.5 * change[0][1] ? change[1][1] : 0.0};
}

struct body_jolt bodies_jolt(const struct scene *c, struct motion_files *files, const double U[3],
                             double until)
{
    struct body_jolt first = {.name = NULL};
    for (int k = 0; k < c->nbodies && !first.name; k++) {
        struct body b;
        if (!scene_body_moves(c->bodies + k) || c->bodies[k].free)
            continue;
        body_create(&b, c->bodies + k, scene_body_mesh(c, k), c->domain.dim, files);
        for (double t = 0.0; t <= until && !first.name; t = body_drive_event(&b.drive, t))
            first = jolt_at(&b, U, t, c->time.end);
        body_destroy(&b);
    }
    return first;
}

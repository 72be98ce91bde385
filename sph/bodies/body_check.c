/* body_check.c - see body_check.h. SPDX-License-Identifier: BSD-3-Clause */
#include "body_check.h"

#include "../../common/scene/scene.h"
#include "../particles/sph_particles.h"
#include "bodies.h"
#include "body_pace.h"

/* --- motion --- */

/* Between two rows of a motion file: displacement and, at the farthest point, the way of rotation,
 * m. Columns: t, then 2 places and an angle, or 3 and 3. */
static double distance(const double *a, const double *b, int columns, double reach)
{
    const int dim = columns == 4 ? 2 : 3;
    double way = 0.0, turn = 0.0;
    for (int c = 1; c < columns; c++)
        *(c <= dim ? &way : &turn) += (b[c] - a[c]) * (b[c] - a[c]);
    return sqrt(way) + reach * sqrt(turn);
}

/* A step between two rows that is over at once, and nothing of the kind before and after. */
static bool jumps(const struct body_term *t, int columns, int i, double reach, double dx)
{
    double v[3] = {0.0, 0.0, 0.0}, h[3] = {0.0, 0.0, 0.0};
    for (int e = -1; e <= 1; e++)
        if (i + e >= 1 && i + e < t->n) {
            const double *b = t->rows + (ptrdiff_t)columns * (i + e), *a = b - columns;
            h[1 + e] = b[0] - a[0];
            v[1 + e] = distance(a, b, columns, reach) / h[1 + e];
        }
    return v[1] * h[1] > dx && v[1] > 10.0 * fmax(v[0], v[2]) && h[1] < 0.2 * fmax(h[0], h[2]);
}

static void check_rows(const struct run *r, const struct sph_params *used, const char *key,
                       const struct body *b, const struct body_term *t, struct faults *f)
{
    const int columns = b->drive.columns;
    const double end = r->scene.time.end, *rows = t->rows,
                 *last = rows + (ptrdiff_t)columns * (t->n - 1);
    for (int i = 0; i < columns * t->n; i++)
        if (!isfinite(rows[i])) {
            params_fault(r->params, f, key, "row %d of the file is not a number", i / columns + 1);
            return;
        }
    if (rows[0] > 0.0 || last[0] < end * (1.0 - 1e-9))
        params_fault(r->params, f, key,
                     "the file has t = %g to %g s, the run goes from 0 to %g s: the body would %s",
                     rows[0], last[0], end,
                     rows[0] > 0.0 ? "start with a jerk" : "stop with a jerk");
    for (int i = 1; i < t->n; i++) {
        const double *p = rows + (ptrdiff_t)columns * (i - 1), *q = p + columns;
        const double way = distance(p, q, columns, b->reach), speed = way / (q[0] - p[0]);
        if (p[0] >= end)
            return;
        if (speed > 0.1 * used->c0 * (1.0 + 1e-6) && params_given(r->params, "sph.c0")) {
            params_fault(r->params, f, key,
                         "jumps at t = %g s, row %d: %g m/s, above a tenth of the speed of sound, "
                         "%g m/s: rows between, or a higher sph.c0",
                         p[0], i + 1, speed, 0.1 * used->c0);
            return;
        }
        if (jumps(t, columns, i, b->reach, used->dx)) {
            params_fault(r->params, f, key,
                         "jumps at t = %g s, row %d: %g m in %g s, more than ten times as fast as "
                         "before and after: rows between are missing",
                         p[0], i + 1, way, q[0] - p[0]);
            return;
        }
    }
}

/* Faults of reading first: rows of a file that could not be read do not exist. */
static void check_file(const struct run *r, const struct sph_params *used, const char *key,
                       const struct body *b, const struct body_term *t, struct faults *f)
{
    char text[1400];
    if (body_term_fault(&b->drive, (int)(t - b->drive.term), r->motions, text, sizeof text))
        params_fault(r->params, f, key, "body %s: %s", b->is->name, text);
    else
        check_rows(r, used, key, b, t, f);
}

/* Whether forces move this degree. */
static bool is_open(const struct scene_body *b, int dim, int axis)
{
    const int locked = scene_body_locked(b->lock, dim);
    return b->free && (b->hinge.n > 0 || locked < 0 || !(locked >> axis & 1));
}

/* Whether it has a constant velocity or spin. */
static bool drives(const struct body *b)
{
    bool any = false;
    for (int a = 0; a < BODY_AXES; a++)
        any = any || b->drive.constant[a] != 0.0;
    return any;
}

static void check_term(const struct run *r, const struct sph_params *used, int k, int i,
                       const struct body *b, struct faults *f)
{
    static const char *const names[BODY_AXES] = {"x", "y", "z", "rx", "ry", "rz"};
    const struct body_term *t = b->drive.term + i;
    const struct scene_motion *m = t->is;
    const int dim = b->dim, axis = m->axis;
    const char *key = key_text("bodies.[%d].motion.[%d]", k, i);
    if (m->kind >= MOTION_PARTNER) {
        if (m->kind == MOTION_BENDING && (dim == 3 || b->drive.nterms > 1 || drives(b)))
            params_fault(r->params, f, key,
                         "a partner that bends a body moves all of its outline, in 2D: give no "
                         "other motion, velocity or spin; in 3D kind partner moves it whole");
        if (b->is->free)
            params_fault(r->params, f, key,
                         "a partner moves all of a body, forces move this one: leave out free and "
                         "mass, or the partner");
        if (used->walls != WALLS_NFM)
            params_fault(r->params, f, key,
                         "these walls (sph.walls) report no forces, which a partner needs: take "
                         "normal flux walls (nfm)");
        return;
    }
    if (!params_given(r->params, key) && m->kind == MOTION_FILE)
        key = key_text("bodies.[%d].motion", k);
    if (m->kind == MOTION_FILE) {
        check_file(r, used, key, b, t, f);
        for (int a = 0; a < BODY_AXES && t->n > 0; a++)
            for (int row = 0; row < t->n && (dim == 3 || a < 2 || a == AXIS_RZ); row++) {
                const int column = dim == 2 && a == AXIS_RZ ? 3 : a + 1;
                if (is_open(b->is, dim, a) &&
                    t->rows[(ptrdiff_t)b->drive.columns * row + column] != 0.0) {
                    params_fault(r->params, f, key,
                                 "the file moves %s, which forces move, too: add it to lock, or "
                                 "give zeros there",
                                 names[a]);
                    break;
                }
            }
        return;
    }
    char text[1400];
    if (body_term_fault(&b->drive, i, r->motions, text, sizeof text))
        params_fault(r->params, f, key, "%s", text);
    else if (is_open(b->is, dim, axis))
        params_fault(r->params, f, key, "forces move %s, too: add it to lock, or leave this out",
                     names[axis]);
}

/* --- free bodies --- */

static void check_degrees(const struct run *r, int k, int dim, struct faults *f)
{
    const struct scene_body *b = r->scene.bodies + k;
    const int locked = scene_body_locked(b->lock, dim);
    const int turns = (locked >> AXIS_RX & 1) + (locked >> AXIS_RY & 1) + (locked >> AXIS_RZ & 1);
    if (locked < 0) {
        params_fault(r->params, f, key_text("bodies.[%d].lock", k),
                     "expected words of %s, as in \"x %s\"", dim == 2 ? "x y rz" : "x y z rx ry rz",
                     dim == 2 ? "rz" : "rx ry");
        return;
    }
    if (dim == 3 && turns == 1)
        params_fault(
            r->params, f, key_text("bodies.[%d].lock", k),
            "one rotation alone cannot be locked: lock two (the body turns about the third "
            "axis), all three or none");
    for (int a = 0; a < 3 && dim == 3 && turns == 2; a++)
        if (b->spin[a] != 0.0 && locked >> (AXIS_RX + a) & 1)
            params_fault(r->params, f, key_text("bodies.[%d].spin", k),
                         "about a locked axis beside a free one: only three locked rotations can "
                         "be driven");
    for (int i = 0; i < b->motion.n && dim == 3 && turns == 2; i++)
        if (b->motion.of[i].kind != MOTION_FILE && b->motion.of[i].axis >= AXIS_RX)
            params_fault(r->params, f, key_text("bodies.[%d].motion", k),
                         "about a locked axis beside a free one: only three locked rotations can "
                         "be driven");
    if (locked == (dim == 2 ? 1 << AXIS_X | 1 << AXIS_Y | 1 << AXIS_RZ : (1 << BODY_AXES) - 1))
        params_fault(r->params, f, key_text("bodies.[%d].lock", k),
                     "all degrees are locked: leave out free and mass, it moves as prescribed");
    if (b->slider.n > 0 && locked & (1 << AXIS_X | 1 << AXIS_Y | 1 << AXIS_Z))
        params_fault(r->params, f, key_text("bodies.[%d].slider", k),
                     "a slider leaves one direction: remove x, y, z from lock");
    if (b->slider.n > 0 && b->hinge.n > 0)
        params_fault(r->params, f, key_text("bodies.[%d].slider", k),
                     "a hinge or a slider, not both");
    if (b->slider.n > 0 &&
        (vec3_length(b->slider.of[0].axis) == 0.0 || (dim == 2 && b->slider.of[0].axis[2] != 0.0)))
        params_fault(r->params, f, key_text("bodies.[%d].slider.axis", k),
                     "expected a direction of the case's %d dimensions", dim);
    if (b->hinge.n > 0 && dim == 3 && vec3_length(b->hinge.of[0].axis) == 0.0)
        params_fault(r->params, f, key_text("bodies.[%d].hinge.axis", k),
                     "expected a direction other than 0");
    if (b->hinge.n > 0 && b->motion.n > 0)
        params_fault(r->params, f, key_text("bodies.[%d].motion", k),
                     "a hinge holds the body: it has no prescribed motion");
}

/* Twice the distance of the corner farthest from the middle, m. */
static double size_of(const struct body *b) { return 2.0 * vec3_length(b->half); }

/* How far x lies outside of the box round the body, m. */
static double outside(const struct body *b, const double *x)
{
    double far2 = 0.0;
    for (int a = 0; a < b->dim; a++)
        far2 += pow(fmax(fabs(x[a] - b->middle[a]) - b->half[a], 0.0), 2.0);
    return sqrt(far2);
}

/* A centre that was forgotten, or is in other units than the corners; moments that masses within
 * the corners cannot have, or that would need all of them in the middle. */
static void check_mass(const struct run *r, int k, const struct body *b, const struct body_mass *m,
                       struct faults *f)
{
    const char *key = key_text("bodies.[%d].centre", k);
    const bool given = params_given(r->params, key);
    const double *c = m->centre, off = outside(b, c), size = size_of(b);
    const double polar = b->dim == 2
                             ? m->inertia[2][2]
                             : 0.5 * (m->inertia[0][0] + m->inertia[1][1] + m->inertia[2][2]);
    const double gyration = sqrt(polar / m->mass);
    if (off > (given ? size : 0.0))
        params_fault(r->params, f, key_text("bodies.[%d].%s", k, given ? "centre" : "mass"),
                     "its mass centre%s, (%g, %g, %g) m, lies %.3g m outside of the body, which is "
                     "%.3g m across: with mass goes centre",
                     given ? "" : " is not given and", c[0], c[1], c[2], off, size);
    else if (!b->is->tank && (gyration < 0.02 * b->reach || gyration > 10.0 * b->reach))
        params_fault(r->params, f, key_text("bodies.[%d].inertia", k),
                     "mass and inertia make a radius of gyration of %.3g m, and the corners are up "
                     "to %.3g m from the centre: inertia is in kg m^2%s, about the centre",
                     gyration, b->reach, b->dim == 2 ? " per metre" : "");
}

/* Largest stiffness and damping that a step of dt follows: sqrt(k/M) dt <= 0.2, beyond which the
 * stages of a step feed an oscillation by more than 1e-4 a period; d dt/M <= 1. */
static void check_spring(const struct run *r, const char *key, double M, double dt, double k,
                         double d, const char *unit, struct faults *f)
{
    const double most = 0.04 * M / (dt * dt);
    if (k > most)
        params_fault(r->params, f, key,
                     "stiffness %g is too large for steps of %.3g s: at most %.3g %s", k, dt,
                     0.99 * most, unit);
    if (d > M / dt)
        params_fault(r->params, f, key,
                     "damping %g is too large for steps of %.3g s: at most %.3g %s s", d, dt,
                     0.99 * M / dt, unit);
}

static void check_line(const struct run *r, int k, int i, const struct body *b, double dt,
                       struct faults *f)
{
    const struct scene_line *l = b->is->lines.of + i;
    const int other = body_line_other(&r->scene, l);
    double way[3];
    const double M = body_line_mass(&r->scene, b, l, way);
    const char *key = key_text("bodies.[%d].lines.[%d]", k, i);
    if (b->dim == 2 && (l->from[2] != 0.0 || l->to[2] != 0.0))
        params_fault(r->params, f, key, "z component in a case of 2 dimensions");
    if (*l->body && (other < 0 || other == k))
        params_fault(r->params, f, key, "body `%s' is %s", l->body,
                     other < 0 ? "none of this case" : "this one: a line goes to another");
    if (l->stiffness <= 0.0 && l->damping <= 0.0)
        params_fault(r->params, f, key, "without stiffness and damping it does nothing");
    if (!*l->body && outside(b, l->from) > 0.0 && outside(b, l->to) == 0.0)
        params_fault(r->params, f, key,
                     "goes from a place outside of the body to one in it: `from' is the point of "
                     "the body, `to' the anchor");
    if (vec3_length(way) <= 0.0) {
        params_fault(r->params, f, key, "from and to are one place: it has no direction");
        return;
    }
    check_spring(r, key, isfinite(M) ? M : b->free->mass, dt, l->stiffness, l->damping, "N/m", f);
}

/* A body must not come through what its contact leaves before a wall. */
static void check_gap(const struct run *r, const struct sph_params *used, int k,
                      const struct body *b, double dt, struct faults *f)
{
    const double v = body_speed_of(&r->scene, b), depth = body_contact_depth(v, dt);
    if (depth > b->contact.gap * used->dx)
        params_fault(r->params, f, key_text("bodies.[%d].contact", k),
                     "contact.gap of %g sph.dx is %.3g m, and a body that falls at %.3g m/s goes "
                     "%.3g m deep into contact in steps of %.3g s: at least %.2f, or a lower "
                     "sph.cfl",
                     b->contact.gap, b->contact.gap * used->dx, v, depth, dt,
                     ceil(100.0 * depth / used->dx) / 100.0);
}

static void check_free(const struct run *r, const struct sph_params *used, int k,
                       const struct body *b, struct faults *f)
{
    const struct scene_body *is = b->is;
    struct body_mass m;
    char why[256];
    double dt = sph_params_dt(used, r->scene.fluid.nu, used->c0, NULL);
    if (used->walls != WALLS_NFM)
        params_fault(r->params, f, key_text("bodies.[%d].free", k),
                     "only normal flux walls (sph.walls = \"nfm\") give forces that move a body");
    if (!body_mass_of(is, b->mesh, b->dim, &m, why, sizeof why)) {
        params_fault(r->params, f,
                     key_text("bodies.[%d].%s", k, is->density > 0.0 ? "density" : "mass"), "%s",
                     why);
        return;
    }
    if (b->dim == 2 && (is->load[2] != 0.0 || is->torque[0] != 0.0 || is->torque[1] != 0.0))
        params_fault(r->params, f,
                     key_text("bodies.[%d].%s", k, is->load[2] != 0.0 ? "load" : "torque"),
                     "out of the plane in a case of 2 dimensions");
    const int before = f->n;
    if (is->mass > 0.0)
        check_mass(r, k, b, &m, f);
    check_degrees(r, k, b->dim, f);
    if (f->n > before)
        return;
    check_gap(r, used, k, b, dt, f);
    for (int i = 0; i < is->lines.n; i++)
        check_line(r, k, i, b, dt, f);
    if (is->hinge.n > 0)
        check_spring(r, key_text("bodies.[%d].hinge", k), b->free->J, dt, is->hinge.of[0].stiffness,
                     is->hinge.of[0].damping, "N m", f);
}

void body_check(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    const int dim = c->domain.dim;
    for (int k = 0; k < c->nbodies; k++) {
        struct body b;
        body_create(&b, c->bodies + k, scene_body_mesh(c, k), dim, r->motions);
        if (dim == 2 && (c->bodies[k].spin[0] != 0.0 || c->bodies[k].spin[1] != 0.0))
            params_fault(r->params, f, key_text("bodies.[%d].spin", k),
                         "in 2 dimensions a number, about z");
        for (int i = 0; i < b.drive.nterms; i++)
            check_term(r, used, k, i, &b, f);
        if (c->bodies[k].free)
            check_free(r, used, k, &b, f);
        body_destroy(&b);
    }
}

/* --- what a case says --- */

static void tell_times(const struct run *r, int k, const struct body *b)
{
    const double end = r->scene.time.end;
    if (b->is->free && b->is->release >= end)
        log_warn("bodies.[%d].release: %g s is not before the end of the run, %g s: the body stays "
                 "where it is",
                 k, b->is->release, end);
    for (int i = 0; i < b->drive.nterms; i++) {
        const struct scene_motion *m = b->drive.term[i].is;
        if (m->kind == MOTION_POLYNOMIAL && m->from >= end)
            log_warn("bodies.[%d].motion.[%d].from: %g s is not before the end of the run, %g s: "
                     "this motion never begins",
                     k, i, m->from, end);
    }
}

/* A load of a hundred weights is one in other units, or of a whole structure on a slice of it. */
static void tell_load(const struct run *r, int k, const struct body *b)
{
    const struct scene_fluid *fluid = &r->scene.fluid;
    const double weight =
        b->free ? vec3_length(fluid->gravity) * (b->free->mass + fluid->rho * b->volume) : 0.0;
    const double load = vec3_length(b->is->load), torque = vec3_length(b->is->torque) / b->reach;
    const double much = weight > 0.0 ? fmax(load, torque) / weight : 0.0;
    if (much > 100.0)
        log_warn("bodies.[%d].%s: %.3g times what the weight of the body and of as much water "
                 "would make: c0, and so the steps, follow the speed that it reaches%s",
                 k, load >= torque ? "load" : "torque", much,
                 b->dim == 2 ? "; in 2D it is per metre of width" : "");
}

double bodies_describe(const struct run *r, const struct sph_params *used, double dt)
{
    const struct scene *c = &r->scene;
    double least = INFINITY;
    for (int k = 0; k < c->nbodies; k++) {
        struct body b;
        struct body_motion m;
        body_create(&b, c->bodies + k, scene_body_mesh(c, k), c->domain.dim, r->motions);
        body_drive_motion(&b.drive, 0.0, &m);
        if (b.drive.nterms > 0 && vec3_length(m.x) + b.reach * vec3_length(m.r) > 0.01 * used->dx)
            log_say("body %d (%s): its motion begins (%g, %g, %g) m and %g rad from the place that "
                    "the case gives it",
                    k + 1, b.is->name, m.x[0], m.x[1], m.x[2], vec3_length(m.r));
        tell_times(r, k, &b);
        tell_load(r, k, &b);
        const double step =
            b.free ? 2.0 / impedance_stopping_rate(&b, c->fluid.rho * used->c0,
                                                   c->fluid.rho * c->fluid.nu, used->dx)
                   : INFINITY;
        if (step < 0.1 * dt)
            log_warn("bodies.[%d]: of %.3g kg over %.3g m^%d it asks for steps of %.2g s, %.2g "
                     "times as many as the fluid: water has 1000 kg/m^3",
                     k, b.free->mass, b.volume, b.dim, step, dt / step);
        least = fmin(least, step);
        body_destroy(&b);
    }
    return least;
}

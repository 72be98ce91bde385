/* body_free.c - a rigid body under forces. With mass m, momentum P, angular momentum L about the
 * centre, quaternion q and the inertia I in the body's axes,
 *   dx/dt = P/m,   dP/dt = F,   dL/dt = T,   omega = Q I^-1 Q^T L,   dq/dt = (0, omega) q/2.
 * L is kept in the axes of space, where a body without torque keeps it to the last digit. Hinges,
 * sliders and locked degrees of freedom are reduced equations, so that nothing drifts from them.
 * The angular acceleration of a body that rotates freely in 3D is Q I^-1 Q^T (T - omega x L).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/geometry/geometry.h"
#include "../../common/scene/scene.h"
#include "body.h"

/* --- the start --- */

static void invert(double A[3][3], double to[3][3])
{
    double c[3][3];
    const double det = vec3_cofactors(A, c);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            to[a][b] = c[b][a] / det;
}

/* e.I e about the centre, e a unit vector. */
static double inertia_about(const struct body_free *f, const double *e)
{
    double v[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < 3; a++)
        vec3_add(v, e[a], f->inertia[a]);
    return vec3_dot(e, v);
}

static void unit(const double *from, double *to)
{
    const double size = vec3_length(from);
    for (int a = 0; a < 3; a++)
        to[a] = from[a] / size;
}

/* About a hinge the state is the angle and L along the axis, with J by Steiner's theorem; the
 * centre follows. */
static void set_hinge(struct body *b, const struct scene_hinge *h)
{
    static const double z[3] = {0.0, 0.0, 1.0};
    struct body_free *f = b->free;
    double across[3];
    f->hinged = true;
    f->rotation = TURNS_AXIS;
    unit(b->dim == 2 ? z : h->axis, f->axis);
    memcpy(f->hinge, h->at, sizeof f->hinge);
    vec3_from(h->at, b->centre, f->arm);
    vec3_cross(f->axis, f->arm, across);
    f->J = inertia_about(f, f->axis) + f->mass * vec3_dot(across, across);
}

/* What the locked rotations leave: all, one axis, or none. */
static void set_rotation(struct body *b)
{
    struct body_free *f = b->free;
    int open = -1, count = 0;
    for (int a = b->dim == 2 ? 2 : 0; a < 3; a++)
        if (!(f->locked >> (AXIS_RX + a) & 1)) {
            open = a;
            count++;
        }
    f->rotation = count == 0 ? TURNS_NOT : count == 1 ? TURNS_AXIS : TURNS_FREE;
    if (count == 1) {
        f->axis[open] = 1.0;
        f->J = inertia_about(f, f->axis);
    }
}

/* From the velocity and the rotation at the start, as far as constraints allow them. */
static void set_momenta(struct body *b)
{
    struct body_free *f = b->free;
    const double *u = b->is->velocity, *spin = b->is->spin;
    double *P = f->y + BODY_P, *L = f->y + BODY_L;
    if (f->hinged) {
        vec3_add(L, f->J * vec3_dot(f->axis, spin), f->axis);
        return;
    }
    vec3_add(P, f->mass, u);
    if (f->slides) {
        const double along = vec3_dot(P, f->slide);
        memset(P, 0, 3 * sizeof *P);
        vec3_add(P, along, f->slide);
    }
    if (f->rotation == TURNS_AXIS)
        vec3_add(L, f->J * vec3_dot(f->axis, spin), f->axis);
    else if (f->rotation == TURNS_FREE)
        turn3(f->inertia, spin, L);
}

/* mass and inertia about the centre at the start. q = (1, 0, 0, 0): not rotated. */
static void create_free(struct body *b, const struct body_mass *m)
{
    struct body_free *f = b->free = NEW(struct body_free, 1);
    f->mass = m->mass;
    memcpy(f->inertia, m->inertia, sizeof f->inertia);
    invert(f->inertia, f->inverse);
    f->locked = scene_body_locked(b->is->lock, b->dim);
    f->held = b->is->release > 0.0;
    if (b->is->hinge.n > 0)
        set_hinge(b, b->is->hinge.of);
    else
        set_rotation(b);
    if (b->is->slider.n > 0) {
        f->slides = true;
        unit(b->is->slider.of[0].axis, f->slide);
    }
    f->y[BODY_Q] = 1.0;
    memcpy(f->y + BODY_X, b->centre, sizeof b->centre);
    set_momenta(b);
}

/* Of the box round its surface. */
static void set_middle(struct body *b)
{
    double lo[3], hi[3];
    if (b->mesh)
        trimesh_bounds(b->mesh, lo, hi);
    else
        scene_body_box(b->is, lo, hi);
    for (int a = 0; a < 3; a++) {
        b->middle[a] = 0.5 * (lo[a] + hi[a]);
        b->half[a] = 0.5 * (hi[a] - lo[a]);
    }
}

/* The centre of a free body is that of its mass, of a driven one what the case says. reach is the
 * radius of a sphere around all of its points. */
void body_create(struct body *b, const struct scene_body *is, const struct trimesh *mesh, int dim,
                 struct motion_files *files)
{
    struct body_mass m;
    char why[256];
    *b = (struct body){.is = is, .mesh = mesh, .dim = dim, .moves = scene_body_moves(is)};
    memcpy(b->centre, is->centre, sizeof b->centre);
    set_middle(b);
    body_drive_create(&b->drive, is, dim, files);
    b->contact = scene_contact_of(is);
    b->volume = body_volume_of(is, mesh);
    if (is->free && body_mass_of(is, mesh, dim, &m, why, sizeof why)) {
        memcpy(b->centre, m.centre, sizeof b->centre);
        create_free(b, &m);
    }
    for (int k = 0; k < is->points.n; k++)
        b->reach = fmax(
            b->reach, hypot(is->points.x[k][0] - b->centre[0], is->points.x[k][1] - b->centre[1]));
    for (int k = 0; mesh && k < mesh->nvertices; k++) {
        double d[3] = {-b->centre[0], -b->centre[1], -b->centre[2]};
        vec3_add(d, 1.0, mesh->x[k]);
        b->reach = fmax(b->reach, vec3_length(d));
    }
    if (scene_body_bends(is))
        b->bend = body_bend_create(is);
    body_move(b, 0.0);
}

void body_destroy(struct body *b)
{
    mem_free(b->free);
    DROP(b->bend);
}

/* --- where it is --- */

static bool is_locked(const struct body_free *f, int axis) { return f->locked >> axis & 1; }

/* Q I^-1 Q^T v. */
static void over_inertia(const struct body_free *f, const struct body_motion *m, const double *v,
                         double *out)
{
    double in_body[3];
    turn_back3((double(*)[3])m->Q, v, in_body);
    turn3((double(*)[3])f->inverse, in_body, in_body);
    turn3((double(*)[3])m->Q, in_body, out);
}

/* Rotation, rotation vector and omega from the state; while held omega is 0, though the momentum of
 * the start is kept for the release. */
static void move_rotation(const struct body_free *f, struct body_motion *m)
{
    const double *y = f->y, *L = y + BODY_L;
    if (f->rotation == TURNS_NOT)
        return; /* as told */
    if (f->rotation == TURNS_AXIS) {
        const double rate = f->held ? 0.0 : vec3_dot(L, f->axis) / f->J;
        for (int a = 0; a < 3; a++) {
            m->r[a] = y[BODY_ANGLE] * f->axis[a];
            m->omega[a] = rate * f->axis[a];
        }
        rotation_of_vector(m->r, m->Q);
        return;
    }
    rotation_of_quaternion(y + BODY_Q, m->Q);
    vector_of_quaternion(y + BODY_Q, m->r);
    over_inertia(f, m, L, m->omega);
    for (int a = 0; a < 3 && f->held; a++)
        m->omega[a] = 0.0;
}

/* On a hinge the centre is carried round by the arm; else locked axes keep what the drive says. */
static void move_centre(const struct body *b, struct body_motion *m)
{
    const struct body_free *f = b->free;
    const double *y = f->y;
    if (f->hinged) {
        double arm[3];
        turn3(m->Q, f->arm, arm);
        for (int a = 0; a < 3; a++)
            m->x[a] = f->hinge[a] + arm[a] - b->centre[a];
        vec3_cross(m->omega, arm, m->u);
        return;
    }
    for (int a = 0; a < b->dim; a++)
        if (f->slides || !is_locked(f, AXIS_X + a)) {
            m->x[a] = y[BODY_X + a] - b->centre[a];
            m->u[a] = f->held ? 0.0 : y[BODY_P + a] / f->mass;
        }
}

/* Of a rotation about all axes, from omega as it is now. */
static void accelerate_turn(const struct body_free *f, struct body_motion *m)
{
    double gyro[3], torque[3];
    vec3_cross(m->omega, f->y + BODY_L, gyro);
    for (int a = 0; a < 3; a++)
        torque[a] = f->held ? 0.0 : f->rate[BODY_L + a] - gyro[a];
    over_inertia(f, m, torque, m->domega);
}

/* Accelerations, of the last stage: averaged forces carry pressures with them. On a hinge a =
 * domega x arm + omega x u. A locked axis keeps the acceleration of its drive. */
static void accelerate(const struct body *b, struct body_motion *m)
{
    const struct body_free *f = b->free;
    for (int a = 0; a < 3; a++) {
        if (f->slides || !is_locked(f, AXIS_X + a))
            m->du[a] = f->rate[BODY_P + a] / f->mass;
        if (f->rotation == TURNS_AXIS)
            m->domega[a] = f->rate[BODY_L + a] / f->J;
    }
    if (f->rotation == TURNS_FREE)
        accelerate_turn(f, m);
    if (f->hinged) {
        double arm[3], inward[3];
        turn3((double(*)[3])m->Q, f->arm, arm);
        vec3_cross(m->domega, arm, m->du);
        vec3_cross(m->omega, m->u, inward);
        vec3_add(m->du, 1.0, inward);
    }
}

void body_hold(struct body *b, double t) { b->free->held = t < b->is->release * (1.0 - 1e-12); }

/* The drive first, for locked degrees keep what it says; rotation before the centre, which a
 * hinge's arm carries round; accelerations last, they need both. */
void body_move(struct body *b, double t)
{
    struct body_motion *m = &b->now;
    body_drive_motion(&b->drive, t, m);
    if (b->free) {
        const struct body_free *f = b->free;
        move_rotation(f, m);
        move_centre(b, m);
        accelerate(b, m);
    }
    m->angle = m->r[2];
    m->spin = m->omega[2];
    m->dspin = m->domega[2];
    if (b->bend)
        body_bend_move(b, t);
}

/* x = centre + motion + Q (from - centre); in 2D the third component is left as it is. */
void body_place(const struct body *b, const double *from, double *to)
{
    double d[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < b->dim; a++)
        d[a] = from[a] - b->centre[a];
    turn3((double(*)[3])b->now.Q, d, d);
    for (int a = 0; a < b->dim; a++)
        to[a] = b->centre[a] + b->now.x[a] + d[a];
}

int body_corners(const struct body *b) { return b->mesh ? b->mesh->nvertices : b->is->points.n; }

void body_corner(const struct body *b, int i, double *to)
{
    if (b->bend)
        memcpy(to, b->bend->x[i], sizeof b->bend->x[i]);
    else
        body_place(b, b->mesh ? b->mesh->x[i] : b->is->points.x[i], to);
}

/* Of a body that bends that of the point of its outline next to the place. */
void body_velocity(const struct body *b, const double *at, double *u)
{
    if (b->bend) {
        const struct line l = {b->bend->n, (const double(*)[2])b->bend->x, true};
        const struct line_foot foot = line_foot(&l, at);
        body_bend_velocity(b->bend, foot.segment, foot.part, u, NULL);
        return;
    }
    double d[3] = {0.0, 0.0, 0.0}, v[3];
    for (int a = 0; a < b->dim; a++)
        d[a] = at[a] - b->centre[a] - b->now.x[a];
    vec3_cross(b->now.omega, d, v);
    for (int a = 0; a < b->dim; a++)
        u[a] = b->now.u[a] + v[a];
}

/* A bound: translation and rotation of the farthest point may add. */
double body_speed(const struct body *b)
{
    double most = vec3_length(b->now.u) + b->reach * vec3_length(b->now.omega);
    for (int i = 0; b->bend && i < b->bend->n; i++)
        most = fmax(most, hypot(b->bend->u[i][0], b->bend->u[i][1]));
    return most;
}

/* --- rates --- */

/* Moment about the hinge's axis of a force at the centre and a moment. */
static double about_hinge(const struct body *b, const double *F, const double *T)
{
    double arm[3], M[3];
    turn3((double(*)[3])b->now.Q, b->free->arm, arm);
    vec3_cross(arm, F, M);
    return vec3_dot(b->free->axis, M) + vec3_dot(b->free->axis, T);
}

/* What of a force (at the centre) and a moment moves the body: change of P and L. What constraints
 * take up is left out; a locked axis takes no share. */
static void moving_part(const struct body *b, const double *F, const double *T, double *P,
                        double *L)
{
    const struct body_free *f = b->free;
    memset(P, 0, 3 * sizeof *P);
    memset(L, 0, 3 * sizeof *L);
    if (f->hinged) {
        vec3_add(L, about_hinge(b, F, T), f->axis);
        return;
    }
    if (f->slides)
        vec3_add(P, vec3_dot(F, f->slide), f->slide);
    else
        for (int a = 0; a < b->dim; a++)
            P[a] = is_locked(f, AXIS_X + a) ? 0.0 : F[a];
    if (f->rotation == TURNS_AXIS)
        vec3_add(L, vec3_dot(T, f->axis), f->axis);
    else if (f->rotation == TURNS_FREE)
        memcpy(L, T, 3 * sizeof *L);
}

/* While held nothing changes. */
void body_rates(struct body *b, const double F[3], const double T[3])
{
    struct body_free *f = b->free;
    const struct body_motion *m = &b->now;
    double *rate = f->rate, *dq = rate + BODY_Q;
    memset(rate, 0, sizeof f->rate);
    if (f->held)
        return;
    moving_part(b, F, T, rate + BODY_P, rate + BODY_L);
    for (int a = 0; a < b->dim && !f->hinged; a++)
        rate[BODY_X + a] = f->y[BODY_P + a] / f->mass;
    if (f->rotation == TURNS_AXIS)
        rate[BODY_ANGLE] = vec3_dot(m->omega, f->axis);
    if (f->rotation != TURNS_FREE)
        return;
    const double *q = f->y + BODY_Q;
    vec3_cross(m->omega, q + 1, dq + 1); /* q' = (0, omega) q/2 */
    dq[0] = -0.5 * vec3_dot(m->omega, q + 1);
    for (int a = 0; a < 3; a++)
        dq[1 + a] = 0.5 * (dq[1 + a] + q[0] * m->omega[a]);
}

void body_hit(struct body *b, const double impulse[3], const double moment[3])
{
    double P[3], L[3];
    if (!b->free || b->free->held)
        return;
    moving_part(b, impulse, moment, P, L);
    vec3_add(b->free->y + BODY_P, 1.0, P);
    vec3_add(b->free->y + BODY_L, 1.0, L);
}

/* Runge-Kutta stages leave the unit sphere by the step's truncation error; Q would then scale. */
void body_finish(struct body *b)
{
    double *q = b->free->y + BODY_Q;
    const double size = sqrt(q[0] * q[0] + vec3_dot(q + 1, q + 1));
    for (int k = 0; k < 4; k++)
        q[k] /= size;
}

double body_energy(const struct body *b, const double g[3], double *kinetic)
{
    const struct body_free *f = b->free;
    double in_body[3], L[3];
    turn_back3((double(*)[3])b->now.Q, b->now.omega, in_body);
    turn3((double(*)[3])f->inertia, in_body, L);
    *kinetic = 0.5 * f->mass * vec3_dot(b->now.u, b->now.u) + 0.5 * vec3_dot(L, in_body);
    return *kinetic - f->mass * vec3_dot(g, b->now.x);
}

/* 1/m_eff = n.P/m + w.I^-1 w, where P and w are what n at r changes: constraints count as infinite
 * mass. */
double body_effective_mass(const struct body *b, const double *r, const double *n)
{
    struct body_free *f = b->free;
    double T[3], P[3], L[3], w[3];
    if (!f)
        return INFINITY;
    vec3_cross(r, n, T);
    moving_part(b, n, T, P, L);
    double yields = vec3_dot(P, n) / f->mass;
    if (f->rotation == TURNS_AXIS) {
        yields += vec3_dot(L, L) / f->J;
    } else if (f->rotation == TURNS_FREE) {
        turn_back3((double(*)[3])b->now.Q, T, w);
        turn3(f->inverse, w, L);
        yields += vec3_dot(w, L);
    }
    return yields > 0.0 ? 1.0 / yields : INFINITY;
}

/* body_lines.c - springs, dampers and mooring lines between a body and a fixed point or another
 * body, and the spring and damper of a hinge. A line of length l pulls its ends together with
 *   F = stiffness (l - l_0) + damping dl/dt,
 * which a rope (pull_only) does only while l > l_0, and never pushes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bodies.h"

int body_line_other(const struct scene *c, const struct scene_line *l)
{
    for (int k = 0; k < c->nbodies && *l->body; k++)
        if (strcmp(c->bodies[k].name, l->body) == 0)
            return k;
    return -1;
}

/* 1/kg: how much the body yields to the unit force e at a point of it at the start, m. */
static double yield_of(const struct body *b, const double *at, const double *e)
{
    double arm[3];
    vec3_from(b->centre, at, arm);
    return 1.0 / body_effective_mass(b, arm, e);
}

double body_line_mass(const struct scene *c, const struct body *b, const struct scene_line *l,
                      double way[3])
{
    const int k = body_line_other(c, l);
    double e[3];
    vec3_from(l->from, l->to, way);
    memcpy(e, way, sizeof e);
    vec3_unit(e);
    double yields = yield_of(b, l->from, e);
    if (k >= 0) { /* its mass asks for no file of motion */
        struct body other;
        body_create(&other, c->bodies + k, scene_body_mesh(c, k), c->domain.dim, NULL);
        yields += yield_of(&other, l->to, e);
        body_destroy(&other);
    }
    return 1.0 / yields;
}

/* Ends of a line now and how fast they move. */
static void ends_of(const struct body *b, const struct body *other, const struct scene_line *l,
                    double x[2][3], double u[2][3])
{
    memset(x, 0, 6 * sizeof(double));
    memset(u, 0, 6 * sizeof(double));
    body_place(b, l->from, x[0]);
    body_velocity(b, x[0], u[0]);
    if (other) {
        body_place(other, l->to, x[1]);
        body_velocity(other, x[1], u[1]);
    } else {
        memcpy(x[1], l->to, sizeof x[1]);
    }
}

/* Moments are about where the centre is now. */
void body_load(const struct body *b, const double *at, const double *F, double factor,
               double load[6])
{
    double arm[3] = {0.0, 0.0, 0.0}, T[3];
    for (int a = 0; a < b->dim; a++)
        arm[a] = at[a] - b->centre[a] - b->now.x[a];
    vec3_cross(arm, F, T);
    vec3_add(load, factor, F);
    vec3_add(load + 3, factor, T);
}

/* Pull along the line, > 0 where it draws its ends together. */
static double tension(const struct scene_line *l, double slack, double length, double rate)
{
    const double force = l->stiffness * (length - slack) + l->damping * rate;
    if (!l->pull_only)
        return force;
    return length > slack ? fmax(0.0, force) : 0.0;
}

/* A length below 0 is one that the case does not give: the line is without force as it starts. */
void body_lines_slack(struct body *b)
{
    for (int k = 0; k < b->is->lines.n; k++) {
        const struct scene_line *l = b->is->lines.of + k;
        const double d[3] = {l->to[0] - l->from[0], l->to[1] - l->from[1], l->to[2] - l->from[2]};
        b->free->slack[k] = l->length >= 0.0 ? l->length : vec3_length(d);
    }
}

/* The other end's body gets the opposite pull, free or not: loads of driven bodies are read by
 * nobody. */
void body_lines_add(const struct scene *c, struct body *bodies, int k, double (*loads)[6])
{
    struct body *b = bodies + k;
    for (int i = 0; i < b->is->lines.n; i++) {
        const struct scene_line *l = b->is->lines.of + i;
        const int other = body_line_other(c, l);
        double x[2][3], u[2][3], e[3], rate = 0.0;
        ends_of(b, other < 0 ? NULL : bodies + other, l, x, u);
        vec3_from(x[0], x[1], e);
        const double length = vec3_length(e);
        for (int a = 0; a < 3; a++) {
            e[a] = length > 0.0 ? e[a] / length : 0.0;
            rate += e[a] * (u[1][a] - u[0][a]);
        }
        b->free->tension[i] = tension(l, b->free->slack[i], length, rate);
        body_load(b, x[0], e, b->free->tension[i], loads[k]);
        if (other >= 0)
            body_load(bodies + other, x[1], e, -b->free->tension[i], loads[other]);
    }
    if (b->free->hinged) {
        const struct scene_hinge *h = b->is->hinge.of;
        const double *axis = b->free->axis, angle = b->free->y[BODY_ANGLE];
        vec3_add(loads[k] + 3,
                 -h->stiffness * (angle - h->at_rest) - h->damping * vec3_dot(b->now.omega, axis),
                 axis);
    }
}

/* J, per metre in 2D: a line between two bodies counts with the one that has it. */
double body_lines_energy(const struct scene *c, const struct body *bodies, int k)
{
    const struct body *b = bodies + k;
    double sum = 0.0;
    for (int i = 0; i < b->is->lines.n; i++) {
        const struct scene_line *l = b->is->lines.of + i;
        const int other = body_line_other(c, l);
        double x[2][3], u[2][3], d[3];
        ends_of(b, other < 0 ? NULL : bodies + other, l, x, u);
        vec3_from(x[0], x[1], d);
        const double more = vec3_length(d) - b->free->slack[i];
        sum += l->pull_only && more < 0.0 ? 0.0 : 0.5 * l->stiffness * more * more;
    }
    if (b->free->hinged) {
        const struct scene_hinge *h = b->is->hinge.of;
        const double angle = b->free->y[BODY_ANGLE] - h->at_rest;
        sum += 0.5 * h->stiffness * angle * angle;
    }
    return sum;
}

/* bed_friction.c - quadratic bed friction of slip walls (walls.friction), whatever the cells: the
 * stress rho c_f |u_t| u_t on the cells beside them, u_t the part of their mean velocity along the
 * wall. It stands in the momentum equation beside convection, explicit; what it would take within a
 * step is at most half of the velocity, so that no step is too long for it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fv_sides.h"

static const double largest = 0.5; /* share of a cell's velocity that a step takes */

static bool has_friction(const struct fv *s)
{
    bool any = false;
    for (int w = 0; w < s->run->scene.nwalls; w++)
        any = any || s->run->scene.walls[w].friction > 0.0;
    for (int k = 0; k < s->prm.blocks.n; k++)
        any = any || s->prm.blocks.of[k].friction > 0.0;
    return any;
}

/* Along the wall in the cell beside the face, m/s. Returns c_f times its size. */
static double velocity_along(const struct fv *s, const struct side_face *f, double *u)
{
    double S[3];
    grid_face_vector(&s->grid, f->face, f->a, S);
    for (int q = 0; q < 3; q++)
        u[q] = q < s->dim ? s->u[q][f->cell] : 0.0;
    vec3_add(u, -vec3_dot(u, S) / vec3_dot(S, S), S);
    return f->friction * sqrt(vec3_dot(u, u));
}

static bool is_rough(const struct side_face *f)
{
    return f->kind == MESH_SLIP && f->friction > 0.0;
}

/* What brake needs. */
struct brake {
    const struct fv *s;
    double *const *N;
};

static void brake(const struct side_face *f, void *with)
{
    const struct brake *x = with;
    double u[3];
    if (!is_rough(f))
        return;
    const double rate = velocity_along(x->s, f, u) * grid_face_area(&x->s->grid, f->face, f->a) /
                        grid_volume(&x->s->grid, f->cell);
    for (int q = 0; q < x->s->dim; q++)
        x->N[q][f->cell] += fmin(rate, largest / x->s->step.dt_now) * u[q];
}

void sides_brake(const struct fv *s, double *const N[3])
{
    if (has_friction(s))
        sides_visit(s, brake, &(struct brake){s, N});
}

void side_friction_force(const struct fv *s, const struct side_face *f, double share, double sum[4])
{
    double u[3];
    if (!is_rough(f))
        return;
    const double per_speed = share * s->run->scene.fluid.rho * velocity_along(s, f, u) *
                             grid_face_area(&s->grid, f->face, f->a);
    for (int q = 0; q < s->dim; q++)
        sum[q] += per_speed * u[q];
}

/* wall_friction.c - see wall_friction.h. The viscous term over a support that a wall cuts is that
 * of the pairs and
 *   2 int W n.grad u dS,   grad u half way between the particle and the piece,
 * exactly for quadratic fields. Before a plane that is 2 W (u_w - u)/h, h the height over it. The
 * heights over the planes of a wall that bends away fall to 0, and grow where it bends in, but the
 * velocity changes with the distance d: along n by n.e (u_w - u)/d, e the direction of the nearest
 * point, u_w the velocity there. With c = n.e a share c^2 of the change is taken so and the rest by
 * h, as all is in right corners. Stokes flow beside a cylinder, R = a, first layer: Lap u is 1.05
 * times what the pressure's sum takes for its gradient, by h alone 0.18.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_friction.h"

#include "../pairs/sph_pairs.h"
#include "forces.h"

/* Morris's term is exact for linear profiles if the weight of a wall is what pairs lack of
 * sum w F d, F = -W'/r. Its integral W is that of a continuum: on rows of a lattice the sum
 * is 1.03, 0.97, 0.81 and 0 times it in layers 1 to 4, and what is left works on the first
 * derivative, so that the velocity of Poiseuille flow erred at order one. So the weight is the
 * pairs' own sum. */
static void add_pairs(const struct sph *s, int who, double *pairs)
{
    const int dim = s->dim, *j = s->list->j + s->list->start[who];
    const double *x = prim_line(&s->p, who);
    for (int b = 0; b < s->list->count[who]; b++) {
        const double *y = prim_line(&s->p, j[b]);
        double d[3], r2 = 0.0;
        for (int a = 0; a < dim; a++) {
            d[a] = x[a] - y[a];
            r2 += d[a] * d[a];
        }
        const double F = -y[at_volume(dim)] * kernel_dw_r(dim, sqrt(r2), s->R);
        for (int a = 0; a < dim; a++)
            pairs[a] += F * d[a];
    }
}

/* Least height that counts, m: of rows, half a spacing, but where a step bears more, less. Round
 * bodies hold their first row 0.3 to 0.4 dx off, where half a spacing is a slip of 0.15 dx. */
static double least_height(const struct sph *s, double W, double gamma)
{
    static const double most = 1.2; /* over a step, of the 2.5 that three stages bear */
    const double bearable = 2.0 * s->nu * s->dt * W / (most * gamma);
    return fmax(0.2 * s->dx, fmin(bearable, 0.5 * s->dx));
}

void wall_friction_begin(const struct sph *s, const struct wall_list *l, int k, double gamma,
                         struct wall_friction *f)
{
    const struct wall_touch *const first = l->touch + l->first[k];
    const struct wall_touch *const end = l->touch + l->first[k + 1];
    double W = 0.0;
    *f = (struct wall_friction){.owner = OWNER_NONE};
    for (const struct wall_touch *t = first; t < end; t++)
        W += t->no_slip ? t->is.W : 0.0;
    f->least = least_height(s, W, gamma);
    if (W == 0.0 || s->prm.viscosity == VISCOSITY_MONAGHAN)
        return;
    for (const struct wall_touch *t = first; t < end; t++)
        for (int a = 0; a < s->dim; a++)
            f->walls[a] += t->is.W * t->n[a];
    add_pairs(s, l->who[k], f->pairs);
}

/* Of a piece: its share of the pairs' sum, by its part of the walls' along its normal. */
static double weight(const struct wall_touch *t, const struct wall_friction *f, int dim)
{
    double pairs = 0.0, walls = 0.0;
    for (int a = 0; a < dim; a++) {
        pairs += f->pairs[a] * t->n[a];
        walls += f->walls[a] * t->n[a];
    }
    return walls > 0.5 * t->is.W ? t->is.W * fmax(0.0, fmin(pairs / walls, 2.0)) : t->is.W;
}

/* Direction from the particle to the nearest point of the piece: along its normal from a foot, else
 * aside to where its centre of weight is. */
static void point_at(const struct wall_touch *t, int dim, double *toward)
{
    const double aside2 = t->distance * t->distance - t->height * t->height;
    double e[3], e2 = 0.0;
    for (int a = 0; a < dim; a++)
        toward[a] = t->n[a];
    if (t->foot || !(aside2 > 0.0))
        return;
    for (int a = 0; a < dim; a++) {
        e[a] = t->is.e[a] - t->height * t->n[a];
        e2 += e[a] * e[a];
    }
    for (int a = 0; a < dim && e2 > 0.0; a++)
        toward[a] = (t->height * t->n[a] + sqrt(aside2 / e2) * e[a]) / t->distance;
}

/* The nearest no-slip piece of the owner of t, and its velocity where it is nearest to x, the
 * particle's place. */
static void find_nearest(const struct sph *s, const struct wall_list *l, int k,
                         const struct wall_touch *t, struct wall_friction *f)
{
    const double *x = prim_line(&s->p, l->who[k]);
    const struct wall_touch *nearest = t;
    double foot[3];
    for (const struct wall_touch *q = l->touch + l->first[k]; q < l->touch + l->first[k + 1]; q++)
        if (q->body == t->body && q->no_slip && q->on < 0 && q->is.W > 0.0 &&
            q->distance < nearest->distance)
            nearest = q;
    f->owner = t->body;
    f->apart = nearest->distance;
    point_at(nearest, s->dim, f->toward);
    for (int a = 0; a < s->dim; a++)
        foot[a] = x[a] + f->apart * f->toward[a];
    wall_list_velocity(s, nearest, foot, f->velocity);
}

/* Of the change of velocity along n, by the nearest piece: cos^2 of the angle between n and the
 * direction of that, 0 before a piece that faces another way or is its solid's far side. */
static double share_of_nearest(const struct wall_touch *t, const struct wall_friction *f, int dim)
{
    double c = 0.0, ahead = 0.0;
    for (int a = 0; a < dim; a++) {
        c += t->n[a] * f->toward[a];
        ahead += t->is.e[a] * f->toward[a];
    }
    return c > 0.0 && (t->height > 0.0 || ahead > 0.0) ? fmin(c * c, 1.0) : 0.0;
}

/* By heights over the piece, which are those of slip beyond corners and of Monaghan's term: its
 * pairs feel strain alone, so fluid that turns with a wall must meet none there, and it moves
 * against the wall's motion as continued to its place. Half a spacing at least, and not from a face
 * seen at grazing angle. With distances its velocities are farther off, for beside walls it has a
 * fifth too much friction as it is. */
static void strain(const struct sph *s, const struct wall_touch *t, const double *x, double rate,
                   double *q)
{
    const double *u = x + s->dim;
    double uw[3];
    wall_list_velocity(s, t, x, uw);
    for (int a = 0; a < s->dim && (t->foot || t->height > 0.25 * s->dx); a++)
        q[a] = -rate / fmax(t->height, 0.5 * s->dx) * (u[a] - uw[a]);
}

/* The rest of the change along n, as in a corner, is by the height over the piece, but not from one
 * seen at grazing angle. Pairs of Morris's are the Laplacian of the velocity, with that of the wall
 * where the wall is. */
void wall_friction_of(const struct sph *s, const struct wall_list *l, int k,
                      const struct wall_touch *t, const double *uw, double mu,
                      struct wall_friction *f, double *q)
{
    const double *x = prim_line(&s->p, l->who[k]), *u = x + s->dim;
    const double rate = 2.0 * mu * weight(t, f, s->dim);
    const bool seen = t->foot || t->height > 0.25 * s->dx, turns = t->on < 0;
    if (s->prm.viscosity == VISCOSITY_MONAGHAN) {
        strain(s, t, x, rate, q);
        return;
    }
    if (turns && t->body != f->owner)
        find_nearest(s, l, k, t, f);
    const double share = turns ? share_of_nearest(t, f, s->dim) : 0.0;
    const double near = share / fmax(f->apart, f->least);
    const double own = seen ? (1.0 - share) / fmax(t->height, f->least) : 0.0;
    for (int a = 0; a < s->dim; a++)
        q[a] = -rate * (own * (u[a] - uw[a]) + near * (u[a] - f->velocity[a]));
}

/* Morris's pairs push aside of the line of centres; of the moment that a pair so makes, half
 * belongs to either. Couette flow between cylinders, the inner one of 6 and 10 dx, right to 1 %:
 * torque +6 and +3 % off at the particles' places, -4 and -3 % at the wall, +1.0 and +0.3 %
 * between. */
void wall_friction_couple(const struct sph *s, const struct wall_list *l, int k,
                          const struct wall_touch *t, const double *q, double w)
{
    const double *x = prim_line(&s->p, l->who[k]);
    double between[3] = {0.0}, force[3] = {0.0}, back[3] = {0.0};
    if (t->body < 0 || s->prm.viscosity == VISCOSITY_MONAGHAN)
        return;
    for (int a = 0; a < s->dim; a++) {
        between[a] = x[a] + 0.5 * t->is.e[a];
        force[a] = -w * q[a];
        back[a] = w * q[a];
    }
    forces_add(s, t->body, between, force);
    forces_add(s, t->body, x, back);
}

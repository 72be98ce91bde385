/* wall_air.h - what normal flux walls do where air comes to them: drops and films of one particle
 * fall freely until they land and hang from no roof, and thicker water parts from roofs and convex
 * edges where these meet a free surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_AIR_H
#define SPH_WALL_AIR_H

#include "../sph.h"
#include "wall_list.h"

/* Whether there are too few neighbours for gradients: none are made then. */
static inline bool wall_air_around(const struct sph *s, const double *slope, const int dim)
{
    bool none = s->surface != NULL;
    for (int a = 0; a < dim + dim * dim && none; a++)
        none = slope[a] == 0.0;
    return none;
}

/* |sum W n| of the touches of particle k, and *all, the sum of W, m^(1-dim). */
static inline double wall_air_along(const struct wall_list *l, int k, double *all)
{
    double along[3] = {0.0, 0.0, 0.0};
    *all = 0.0;
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        *all += wall_touch_counts(t);
        vec3_add(along, t->is.W, t->n);
    }
    return vec3_length(along);
}

/* 1 before walls of one side and in right corners of two or three, 0 in a gap: there a layer one
 * particle thick has no air beside it. */
static inline double wall_air_open(double along, double all)
{
    return all > 0.0 ? fmin(1.0, fmax(0.0, 2.5 * along / all - 0.4)) : 1.0;
}

/* In 3D, Shepard factor of a particle with hardly a neighbour. Its pressure, which nothing beside
 * holds, swings against the walls by c |sum W n|/gamma over a step: 1.2 beside one wall, 1.6 where
 * it is pressed into the corner of a floor and a face, which three stages do not bear when its
 * density errs by percents and c with it. There more of it counts as fluid. A pile of five
 * particles that stood aslant in a dam break, a ball over the floor and a loose block ended the run
 * so; with at most 1.5 the last two still did. In the plane no run did, and a jet into a corner is
 * stopped later by it (Mach 0.306 for 0.295). */
static inline double wall_air_gamma(const struct sph *s, double along, double c, double gamma)
{
    const double most = 1.2;
    return fmax(gamma, c * s->dt * along / most);
}

/* Of the weight of a piece, what stops a layer one particle thick, or less, before it. The kernel
 * would stop it from R on, and it hung there, 2.3 dx over a floor, by the pressure of its own
 * volume; so it falls freely down to dx, and from dx/2 on, where a row rests, the wall is whole.
 * The end is smooth: one at dx/2 alone throws a drop up again. */
static inline double wall_air_share(const struct sph *s, const struct wall_touch *t, double open)
{
    const double q = fmax(0.0, fmin(2.0 * t->height / s->dx - 1.0, 1.0));
    return 1.0 - open * q * q * (3.0 - 2.0 * q);
}

/* 0 to 1: how much of what is between a particle and a wall of normal n is air, where it comes to
 * the wall at the speed u: none where a row rests, dx/2 before it, all from 0.8 dx on. By the part
 * along n of `empty', the vector towards where particles are missing, over R/(4 dx) of the weight
 * of a plane dx/2 away: 0.11, 0.27 and 0.41 at 0.6, 0.8 and 1 dx (R/dx 4; 2.5 to 6 within 0.05).
 * Water that comes to a wall was compressed from R on, as if the room before it were fluid: it
 * stopped half a spacing before its place, gauges had 1.2 to 1.6 times the momentum of water that
 * falls on a floor, and what then fell into the void lay there without order, so that the floor had
 * 5 to 9 % too much pressure for seconds. Below sqrt(g dx) it is as ever, for what only swings to
 * and fro there would be stretched more than compressed: a box afloat tilted by 10 % more. So is
 * what parts from a wall: else the impulse at the foot of a wall in a dam break was off by 57
 * instead of 28 %, and with the wave left out, too, runs ended. Water of negative pressure p is
 * compressed as ever: what comes and parts again was stretched by each turn, to -200 kPa where a
 * fast film filled a corner, and nine of ten drops on a slab between two sides ended in it. */
static inline double wall_air_gap(const struct sph *s, const double *empty, const double *n,
                                  double u, double p, int dim)
{
    double along = 0.0;
    for (int a = 0; a < dim; a++)
        along += empty[a] * n[a];
    const double q = fmin(1.0, fmax(0.0, 5.0 * along - 0.5));
    const double g_dx = vec3_length(s->gravity) * s->dx, u2 = fmax(u * u, 1e-300);
    return q * q * (3.0 - 2.0 * q) * fmin(1.0, fmax(0.0, u2 / fmax(g_dx, 1e-300) - 1.0)) *
           fmin(1.0, fmax(0.0, 1.0 + p / (s->rho0 * u2)));
}

/* How much the walls that particle k touches stand back from each other, as at a convex edge, where
 * air comes to all of them: 0 to 1. From their middle the pieces lie outwards, and their normals
 * differ by more than those of round bodies do: Var n = Var e/a^2, 1 up to radii a of 3 dx and 0
 * from 4.2 dx on. */
static inline double wall_air_edge(const struct sph *s, const struct wall_list *l, int k,
                                   const int dim)
{
    double all = 0.0, apart = 0.0, back = 0.0, e[3] = {0.0}, n[3] = {0.0};
    if (l->first[k + 1] - l->first[k] < 2) /* as beside most walls */
        return 0.0;
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        const double W = wall_touch_counts(t);
        all += W;
        for (int a = 0; a < dim; a++) {
            e[a] += W * t->is.e[a];
            n[a] += W * t->n[a];
            apart += W * t->is.e[a] * t->is.e[a];
            back -= W * t->is.e[a] * t->n[a];
        }
    }
    if (!(all > 0.0))
        return 0.0;
    double turn = all;
    for (int a = 0; a < dim; a++) {
        apart -= e[a] * e[a] / all;
        turn -= n[a] * n[a] / all;
        back += e[a] * n[a] / all;
    }
    const double dx2 = s->dx * s->dx, bends = 18.0 * dx2 * turn - apart;
    const double share = fmin(1.0, fmax(0.0, bends / (fmax(apart, 0.0) + 1e-9 * dx2 * all)));
    return share * fmin(1.0, fmax(0.0, 10.0 * back / (all * s->dx)));
}

/* 0 to 1 from the height 0 to dx/4 on: a row runs at dx/2. */
static inline double wall_air_over(const struct sph *s, double height)
{
    const double q = fmin(1.0, fmax(0.0, 4.0 * height / s->dx));
    return q * q * (3.0 - 2.0 * q);
}

/* On the piece or its rim: a foot on the diagonal of two triangles is on neither by the last digit.
 */
static inline bool wall_air_before(const struct sph *s, const struct wall_touch *t)
{
    return t->foot || t->distance < fabs(t->height) + 1e-6 * s->dx;
}

/* 0 to 1: how much what moves at u - uw flies past edges, faster than a fall of four rows: water
 * that sways round a box, which surrounds them, would be pumped by them. By its pressure instead
 * the particles beside a corner switched from step to step. */
static inline double wall_air_flies(const struct sph *s, const double *u, const double *uw, int dim)
{
    double square = 0.0;
    for (int a = 0; a < dim; a++)
        square += (u[a] - uw[a]) * (u[a] - uw[a]);
    const double fall = 8.0 * vec3_length(s->gravity) * s->dx;
    return square > fall ? fmin(1.0, square / fmax(fall, 1e-300) - 1.0) : 0.0;
}

/* 0 to 1: how much particle k is beyond the end of the piece of touch t, where air comes to it: the
 * foot of the particle on its plane lies off the piece and in front of all others that weigh as
 * much. Behind one of them it would come to a wall that bends towards it. Both faces of a narrow
 * slot are so, which wall_air_edge does not see: a film lost 7 % of its momentum over one of 2 dx,
 * drawn down by the near face and stopped by the far one, now 0.06. So is the face of a step down
 * of less than a spacing, over which water from five rows on knows of no surface: it was held back
 * there by rho c u, 10 % of the momentum of eight rows. Where walls turn by more than 60 degrees,
 * whole from 75 on: a wedge of 120 that enters water has both its faces at the tip. */
static inline double wall_air_beyond(const struct sph *s, const struct wall_list *l, int k,
                                     const struct wall_touch *t, const int dim)
{
    double beyond = 1.0, most = 0.0;
    if (wall_air_before(s, t) || !(t->is.W > 0.0))
        return 0.0;
    for (const struct wall_touch *o = l->touch + l->first[k]; o < l->touch + l->first[k + 1]; o++) {
        double cosine = 0.0;
        for (int a = 0; a < dim; a++)
            cosine += o->n[a] * t->n[a];
        if (!(o->is.W > 0.0) || o == t || (!wall_air_before(s, o) && cosine >= 0.9))
            continue;
        const double weighs = fmin(1.0, 10.0 * o->is.W / t->is.W);
        beyond *= 1.0 - weighs * (1.0 - wall_air_over(s, o->height - cosine * t->height));
        most = fmax(most, weighs * fmin(1.0, fmax(0.0, 2.0 - 4.0 * cosine)));
    }
    return most * beyond;
}

/* 0 to 1: how much of a particle that comes to the piece of touch t with u - uw, or leaves it, goes
 * past it: beside a convex edge of this share where it is dx/4 over what the edge has on its other
 * side, and beyond the end of a piece, as over a slot both sides of which are in its support,
 * unless it comes to the others, or leaves them, as well. Both alike, else water that sways round
 * an edge is pumped: what came was stopped no more, what left was. */
static inline double wall_air_past(const struct sph *s, const struct wall_list *l, int k,
                                   const struct wall_touch *t, const double *u, const double *uw,
                                   double edge, double beyond, const int dim)
{
    double all = 0.0, over = 0.0, here = 0.0, there = 0.0;
    if (!(edge > 0.0) && !(beyond > 0.0)) /* as of most particles */
        return 0.0;
    for (const struct wall_touch *o = l->touch + l->first[k]; o < l->touch + l->first[k + 1]; o++) {
        double cosine = 0.0, comes = 0.0;
        for (int a = 0; a < dim; a++) {
            cosine += o->n[a] * t->n[a];
            comes += (u[a] - uw[a]) * o->n[a];
        }
        const double turned = wall_touch_counts(o) * (1.0 - cosine);
        all += turned;
        over += turned * o->height;
        there += turned * comes;
    }
    for (int a = 0; a < dim; a++)
        here += (u[a] - uw[a]) * t->n[a];
    if (!(all > 0.0) || here == 0.0)
        return 0.0;
    const double past = fmax(edge * wall_air_over(s, over / all), beyond);
    return past * fmin(1.0, fmax(0.0, 1.0 - there / (all * here)));
}

/* |u - uw|^2 along a wall of normal n, m^2/s^2. */
static inline double wall_air_square(const double *u, const double *uw, const double *n, int dim)
{
    double square = 0.0, across = 0.0;
    for (int a = 0; a < dim; a++) {
        square += (u[a] - uw[a]) * (u[a] - uw[a]);
        across += (u[a] - uw[a]) * n[a];
    }
    return fmax(square - across * across, 0.0);
}

/* Whether a film runs along a wall so fast that its weight is nothing to it: rho u^2/2 above
 * WEIGHTS layers of particles. What hangs or drips is slower; a jet of one particle that no wall
 * held would leave a plate that follows it, and be hit again with rho c u. */
static inline bool wall_air_runs_along(const struct sph *s, double square)
{
    enum { WEIGHTS = 500 };
    return square >= 2.0 * WEIGHTS * vec3_length(s->gravity) * s->dx;
}

/* 0 to 1: how much of a pressure p, Pa, is tension beyond the weight of a row and the noise of
 * what runs along. */
static inline double wall_air_parted(const struct sph *s, double p, double square)
{
    const double noise = 0.002 * square, weight = vec3_length(s->gravity) * s->dx;
    if (!(p < 0.0) || !(fmax(weight, noise) > 0.0))
        return 0.0;
    const double q = fmin(-p / (s->rho0 * fmax(weight, noise)), 1.0);
    return q * q * (3.0 - 2.0 * q);
}

/* Of P, the pressure of a particle near a free surface and of the wall beside it together, Pa, what
 * is left under a roof, of normal n out of the fluid, and at an edge (its share: wall_air_edge),
 * where it is tension: all of noise, none beyond the weight of a row, for air comes between. The
 * jet under a gate as thick as its opening filled the room below the gate (eight rows: 0.84 of the
 * opening deep behind it, 0.67 so), and a block of water hung until the air had come in; what
 * splashes over a box drew it up with a third of the drag, slots ran full, and a jet along a plate
 * went round the plate's end, which it drew with a sixth of its own force. Where neither weight nor
 * an edge draws it away water stays at its wall: sound after an impact would push more than it
 * pulls (impulse at the foot of a wall in a dam break off by 63 instead of 41 %); so does a film
 * that runs along fast, but at edges. */
static inline double wall_air_tension(const struct sph *s, const double *n, double P, double edge,
                                      double square, int dim)
{
    const double tension = 2.0 * s->background - P, gravity = vec3_length(s->gravity);
    double away = edge, along = 0.0;
    for (int a = 0; a < dim; a++)
        along += s->gravity[a] * n[a];
    if (along < 0.0 && !wall_air_runs_along(s, square))
        away = fmax(away, fmin(-2.0 * along / gravity, 1.0));
    if (!(tension > 0.0) || !(away > 0.0))
        return P;
    return P + away * tension * wall_air_parted(s, -0.5 * tension, square);
}

#endif

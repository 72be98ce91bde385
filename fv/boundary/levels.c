/* levels.c - openings of given pressure under a free surface. On the face of an opening, less the
 * pressure of water at rest,
 *   p/rho = g (L - L_0) + c (u - U) - min(u_f, 0)^2/2 (+ min(u, 0)^2/2 at inlets),
 * L the level outside, L_0 that of the run, c the speed of long waves, u the mean velocity outwards
 * of the opening's water, U its mean over the last TRANSITS transits, u_f that of the face:
 *   dU/dt = (u - U)/T + du_b/dt,   u_b = -(basin/opening) dL/dt,
 * u_b the velocity that a tide in L fills a basin with. Without it U is T du/dt behind, and the
 * basin swings by 2 (w L_x/c)^2 of the tide too far.
 * levels_set makes p before a stage, levels_fluxes applies it to U, so that the solve has psi = 0
 * on the face, and levels_ghosts or levels_gradient to psi's gradients.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levels.h"

#include "../../common/scene/scene.h"
#include "carried.h"
#include "still.h"

/* Transits of a wave through the domain over which U is averaged. */
#define TRANSITS 2.0

/* Visits the openings of this kind: o. */
#define LEVELS(s, o)                                                                               \
    for (struct outflow *o = (s)->levels ? (s)->levels->of : NULL;                                 \
         o && o < (s)->levels->of + (s)->levels->n; o++)

void levels_create(struct fv *s)
{
    if (s->prm.integrator != INTEGRATOR_NEWTON)
        s->levels = NEW_IN(s, struct levels, 1);
}

bool levels_set_any(const struct fv *s) { return s->levels && s->levels->p; }

/* m/s^2: gravity across closed sides. */
static double weight(const struct fv *s) { return vec3_length(s->gravity.hydrostatic); }

/* m/s: velocity outwards through a face, by its projected flux. */
static double velocity_out(const struct fv *s, const struct outflow *o, int64_t i)
{
    const double U = s->U[o->a][o->cell[i] + o->face];
    return (o->in < 0 ? U : -U) / (s->m ? carried_area(o, i) : 1.0);
}

/* m^2/s^2: p/rho on a face of water at rest under s->gravity.level. */
static double at_rest(const struct fv *s, const struct outflow *o, int64_t i)
{
    double x[3];
    grid_place(&s->grid, o->cell[i], x);
    for (int q = 0; q < s->dim; q++)
        x[q] += 0.5 * o->h[i] * o->S[q][i] / carried_area(o, i);
    return fv_still_pressure(s, x) / s->run->scene.fluid.rho;
}

/* Of the water in each opening the mean velocity outwards, m/s, by the projected fluxes, weighted
 * with the wet area, and its height, m, as of a depth that is the same across it. Collective. */
static void mean_velocities(struct fv *s)
{
    struct levels *l = s->levels;
    const double g = weight(s);
    double sums[3][LEVEL_GROUPS] = {{0.0}};
    LEVELS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            if (o->own[i] && o->share[i] > 0.0) {
                sums[0][o->side] += o->wet[i] * carried_area(o, i) * velocity_out(s, o, i);
                sums[1][o->side] += o->wet[i] * carried_area(o, i);
                sums[2][o->side] += o->wet[i] * carried_area(o, i) * at_rest(s, o, i);
            }
    MPI_Allreduce(MPI_IN_PLACE, sums, 3 * LEVEL_GROUPS, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < LEVEL_GROUPS; k++) {
        const double area = fmax(sums[1][k], 1e-300);
        l->mean[k] = sums[0][k] / area;
        l->middle[k] = g > 0.0 ? s->gravity.level - sums[2][k] / (area * g) : 0.0;
    }
}

/* m: what the level outside falls short of where water falls to it. */
static double fall_of(const struct fv *s, int k)
{
    const struct levels *l = s->levels;
    const double g = weight(s), c = l->waves[k];
    if (!(g > 0.0 && c > 0.0))
        return 0.0;
    const double inside = c * c / g, given = l->level[k] - (l->middle[k] - 0.5 * inside);
    return openings_fall(g, given + c / g * (l->mean[k] - l->past[k]), given, inside, l->mean[k]);
}

/* Levels outside at time t, where they are given. */
static void set_given(struct fv *s, double t)
{
    for (int k = 0; k < s->run->scene.nwalls; k++) {
        const struct scene_wall *w = s->run->scene.walls + k;
        if (w->side != SIDE_NONE && w->has_level)
            s->levels->level[w->side - SIDE_X_MIN] = wall_level(w, t);
    }
}

/* Outside the outflows that blocks give themselves. */
static void start_own(const struct fv *s)
{
    struct levels *l = s->levels;
    struct mesh_outside of[MESH_OUTSIDES];
    if (!s->m)
        return;
    mesh_outside_find(s->run, s->m, of);
    for (int k = 0; k < LEVEL_GROUPS; k++) {
        l->falls[k] = l->falls[k] || of[k].falls;
        if (of[k].lower)
            l->level[k] = of[k].stands;
    }
}

/* What the files of levels say of a transit, by the depth of their first level over the bottom. */
static void start_tide(const struct fv *s, const struct scene_wall *w, int k)
{
    struct levels *l = s->levels;
    const struct scene_domain *d = &s->run->scene.domain;
    double low, high;
    scene_heights(&s->run->scene, &low, &high);
    const double depth = wall_level(w, -INFINITY) - low;
    if (!w->levels || !(depth > 0.0))
        return;
    l->tide[k] = 0.5 * (d->max[k / 2] - d->min[k / 2]) / sqrt(weight(s) * depth);
    l->surge[k] = wall_level_change(w, l->tide[k]);
}

/* In the order in which later ones overrule: the run's level, walls of the scene, blocks' own
 * outflows, given levels. */
void levels_start(struct fv *s)
{
    struct levels *l = s->levels;
    if (!l || !s->surface)
        return;
    if (!l->p)
        l->p = NEW_IN(l, double, s->size);
    for (int k = 0; k < LEVEL_GROUPS; k++)
        l->level[k] = s->gravity.level;
    for (int k = 0; k < s->run->scene.nwalls; k++) {
        const struct scene_wall *w = s->run->scene.walls + k;
        const int side = w->side - SIDE_X_MIN;
        if (w->side == SIDE_NONE)
            continue;
        l->inlet[side] = w->has_level && w->kind == WALL_INFLOW;
        l->falls[side] = w->falls;
        start_tide(s, w, side);
        if (w->lower)
            l->level[side] = w->stands;
    }
    start_own(s);
    set_given(s, s->t);
    mean_velocities(s);
    for (int k = 0; k < LEVEL_GROUPS; k++)
        l->past[k] = l->mean[k];
}

/* s: of a wave on its way through the domain and back. Against the flow c - |u|, with it c + |u|:
 * together L (1/(c - |u|) + 1/(c + |u|))/2 = L/(c (1 - Fr^2)) a transit; Fr at most 0.9. */
static double memory_of(const struct fv *s, int k)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double c = s->levels->waves[k],
                 Fr = fmin(fabs(s->levels->mean[k]) / fmax(c, 1e-300), 0.9);
    return k < 6 && c > 0.0 ? TRANSITS * (d->max[k / 2] - d->min[k / 2]) / (c * (1.0 - Fr * Fr))
                            : 0.0;
}

/* m/s: u_b at time t. */
static double basin_velocity(const struct fv *s, int k, double t)
{
    const struct levels *l = s->levels;
    const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + k);
    return -l->basin[k] * wall_level_rise(w, l->tide[k], l->surge[k], t);
}

/* U relaxes towards u within T; without waves it is u. */
void levels_begin(struct fv *s, double dt)
{
    struct levels *l = s->levels;
    if (!levels_set_any(s))
        return;
    mean_velocities(s);
    for (int k = 0; k < LEVEL_GROUPS; k++) {
        const double T = memory_of(s, k);
        l->past[k] += (l->mean[k] - l->past[k]) * (T > 0.0 ? -expm1(-dt / T) : 1.0);
        if (l->tide[k] > 0.0 && T > 0.0)
            l->past[k] += basin_velocity(s, k, s->t + dt) - basin_velocity(s, k, s->t);
    }
}

void levels_keep(struct fv *s)
{
    if (s->levels)
        memcpy(s->levels->kept, s->levels->past, sizeof s->levels->kept);
}

void levels_back(struct fv *s)
{
    if (s->levels)
        memcpy(s->levels->past, s->levels->kept, sizeof s->levels->past);
}

/* m^2/s^2: what the weight of half a cell makes. */
static double half_cell(const struct fv *s, int64_t c)
{
    int at[3];
    double h[3], sum = 0.0;
    const struct part *p = grid_part(&s->grid, c, at);
    grid_box(&s->grid, p, at, h);
    for (int a = 0; a < s->dim; a++)
        sum += 0.5 * fabs(s->gravity.hydrostatic[a]) * h[a];
    return sum;
}

/* m^2/s^2: p/rho on a face, less that of water at rest. Only water that comes in loses its dynamic
 * pressure. */
static double set_on(const struct fv *s, const struct outflow *o, int64_t i)
{
    const struct levels *l = s->levels;
    const int k = o->side;
    const double g = weight(s);
    const double u = fmin(velocity_out(s, o, i), 0.0), all = fmin(l->mean[k], 0.0);
    if (l->falls[k])
        return -at_rest(s, o, i) - 0.5 * u * u;
    return g * (l->level[k] - l->fall[k] - s->gravity.level) +
           l->waves[k] * (l->mean[k] - l->past[k]) - 0.5 * u * u +
           (l->inlet[k] ? 0.5 * all * all : 0.0);
}

/* Above the level outside there is air: an outflow has no tension there, beyond what the surface
 * makes within half a cell; without it a level below the bed drew water out at 13 m/s. */
static double pressure_on(const struct fv *s, const struct outflow *o, int64_t i)
{
    const double p = set_on(s, o, i);
    return s->levels->falls[o->side] ? p : fmax(p, -at_rest(s, o, i) - half_cell(s, o->cell[i]));
}

/* Flux outwards by a unit of psi on a face over that in the cell: half a cell away. m on blocks
 * (G), 1/m on uniform cells. */
static double conductance(const struct fv *s, const struct outflow *o, int64_t i)
{
    return 2.0 * (s->m ? s->m->G[o->a][o->a][o->cell[i] + o->face] : 1.0 / o->h[i]);
}

/* Given levels first, then the means that follow the flow, then pressures, which are made of both.
 */
void levels_set(struct fv *s, double t)
{
    if (!levels_set_any(s))
        return;
    set_given(s, t);
    mean_velocities(s);
    for (int k = 0; k < LEVEL_GROUPS; k++)
        s->levels->fall[k] = fall_of(s, k);
    LEVELS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            s->levels->p[o->cell[i] - o->in] = pressure_on(s, o, i);
}

/* Faces without water are left alone. */
void levels_fluxes(struct fv *s, double tau)
{
    if (!levels_set_any(s))
        return;
    LEVELS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            if (o->share[i] > 0.0)
                s->U[o->a][o->cell[i] + o->face] -= (o->in < 0 ? 1.0 : -1.0) * tau *
                                                    conductance(s, o, i) *
                                                    s->levels->p[o->cell[i] - o->in];
}

/* Ghosts at an outflow are antisymmetric about 0 on the face; about p they are 2 p more. */
void levels_ghosts(const struct fv *s, double *psi)
{
    if (!levels_set_any(s))
        return;
    LEVELS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            for (int m = 1; m <= MESH_GHOSTS; m++)
                psi[o->cell[i] - m * o->in] += 2.0 * s->levels->p[o->cell[i] - o->in];
}

/* What 2 p in the first two ghosts adds to (8 (q_1 - q_-1) - (q_2 - q_-2))/12 h: 14/12 in the first
 * cell, 2/12 in the second. */
void levels_gradient(const struct fv *s, int a, double *out)
{
    if (!levels_set_any(s))
        return;
    LEVELS (s, o)
        for (int64_t i = 0; i < o->n && o->a == a; i++) {
            const double p = s->levels->p[o->cell[i] - o->in], way = o->in < 0 ? 1.0 : -1.0;
            if (!o->own[i])
                continue;
            out[o->cell[i]] += way * 14.0 / 12.0 * p / o->h[i];
            out[o->cell[i] + o->in] -= way * 2.0 / 12.0 * p / o->h[i];
        }
}

/* Over half a cell, for the pressure is on the face. */
void levels_face_gradient(const struct fv *s, int a, double *out)
{
    if (!levels_set_any(s))
        return;
    LEVELS (s, o)
        for (int64_t i = 0; i < o->n && o->a == a; i++)
            if (o->share[i] > 0.0)
                out[o->cell[i] + o->face] +=
                    (o->in < 0 ? 2.0 : -2.0) * s->levels->p[o->cell[i] - o->in] / o->h[i];
}

/* params_derived.c - what follows from the parameters alone, before there is a state. The region of
 * the particles within the domain (sph.box or all of it), which of its sides are open, whether
 * there are walls, and the bounds of the time step. Used by the checks of a case, by --check and
 * when the state is created, so that all three give the same answers.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "params_derived.h"

/* Whether the region reaches a side of the domain (2a low, 2a+1 high), to 1e-6 dx; a periodic
 * direction is reached only if the region spans all of it. */
bool sph_params_reaches(const struct scene_domain *d, const struct sph_params *prm, int side)
{
    const int a = side / 2;
    const double near = 1e-6 * prm->dx;
    if (d->periodic[a]) /* both or none */
        return prm->box[1][a] - prm->box[0][a] >= d->max[a] - d->min[a] - near;
    return side % 2 ? prm->box[1][a] >= d->max[a] - near : prm->box[0][a] <= d->min[a] + near;
}

/* Walls that the particles can meet: polylines, bodies, sides of the domain that the region
 * reaches. A side that only borders the region far away is no wall of it. */
bool sph_params_walls(const struct scene *c, const struct sph_params *prm)
{
    bool any = c->nbodies > 0;
    for (int k = 0; k < c->nwalls; k++) {
        const int side = c->walls[k].side;
        any =
            any || (sph_params_is_wall(c->walls + k) &&
                    (side == SIDE_NONE || sph_params_reaches(&c->domain, prm, side - SIDE_X_MIN)));
    }
    return any;
}

/* Corners of the region and its periodic directions; the third dimension of 2D is [0, 0]. A box
 * that spans less than a period is not periodic. */
void sph_params_region(const struct scene_domain *d, const struct sph_params *prm, double lo[3],
                       double hi[3], bool periodic[3])
{
    const double near = 1e-6 * prm->dx;
    for (int a = 0; a < 3; a++) {
        lo[a] = a < d->dim ? prm->box[0][a] : 0.0;
        hi[a] = a < d->dim ? prm->box[1][a] : 0.0;
        periodic[a] = a < d->dim && d->periodic[a] && hi[a] - lo[a] >= d->max[a] - d->min[a] - near;
    }
}

/* dt = min(cfl R/signal, cfl_viscous R^2/nu), s, with `signal' the largest c + |u - u0|, m/s.
 * `limited_by' may be NULL. */
double sph_params_dt(const struct sph_params *prm, double nu, double signal,
                     const char **limited_by)
{
    const double R = prm->R_dx * prm->dx;
    const double sound = prm->cfl * R / signal;
    const double viscous = nu > 0.0 ? prm->cfl_viscous * R * R / nu : INFINITY;
    if (limited_by)
        *limited_by = sound <= viscous ? "sound" : "viscosity";
    return fmin(sound, viscous);
}

/* Among given sides, those alone with a condition of their own are open; around a box all are but
 * those on the domain's own sides, where a partner ends too: walls, or the air above a surface. */
void sph_params_open(const struct run *r, const struct sph_params *prm, bool open[6])
{
    const struct scene_domain *d = &r->scene.domain;
    double lo[3], hi[3];
    bool periodic[3];
    sph_params_region(d, prm, lo, hi, periodic);
    for (int side = 0; side < 6; side++) {
        const bool reaches = side / 2 < d->dim && sph_params_reaches(d, prm, side);
        const struct scene_wall *w = reaches ? scene_wall_of(&r->scene, SIDE_X_MIN + side) : NULL;
        open[side] = side / 2 < d->dim && !periodic[side / 2] && prm->outer != OUTER_NONE;
        if (prm->outer == OUTER_SIDES)
            open[side] = open[side] && w && scene_wall_opens(w);
        else if (reaches)
            open[side] = open[side] && (!w || scene_wall_opens(w)) && prm->outer == OUTER_EXACT &&
                         prm->surface != SURFACE_YES;
    }
}

bool sph_params_zones(const struct run *r, const struct sph_params *prm)
{
    bool open[6], any = false;
    sph_params_open(r, prm, open);
    for (int side = 0; side < 6; side++)
        any = any || open[side];
    return any;
}

/* The acoustic damper lengthens the spectrum of the Riemann schemes on the real axis, with the
 * dissipation of velocity in full as (4.7 + 8.5 damper) c/R: what is left of the steps of 0.2. */
double sph_params_damped_share(const struct sph_params *prm)
{
    return sph_params_is_riemann(prm->scheme) ? fmin(1.0, 6.4 / (4.7 + 8.5 * prm->damper)) : 1.0;
}

/* Measured on Taylor-Green flow, tanks at rest and dam breaks, R/dx 4 in 2D and 2.5 in 3D: the
 * Riemann schemes gain energy from 0.7 and 0.6 on, the central ones with RK4 from 1.2, with j3 they
 * run to 0.75 and more. Plane waves on a lattice, all dissipation: j3 0.57 in 2D, 0.52 in 3D, RK4
 * 0.53, 0.43; where nothing damps waves j3 runs to 0.55. */
double sph_params_cfl_bound(const struct sph_params *prm, int dim)
{
    const bool rk4 = prm->integrator == INTEGRATOR_RK4;
    if (!sph_params_is_riemann(prm->scheme))
        return rk4 ? 1.2 : 0.75;
    return sph_params_damped_share(prm) * (dim == 3 ? 0.55 : rk4 ? 0.65 : 0.6);
}

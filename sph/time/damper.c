/* damper.c - the acoustic damper takes beta rho0 c0 R div u from the pressure of pairs. div u is
 * the trace of renormalised gradients, and these err: beside walls, where a support sees one side
 * only, and wherever the flow bends within a support. Times c0 the error is a pressure: before a
 * square of four particles in a stream of U it was 5 rho U^2/2 with c0 = 67 U, and 1.2 with 10 U.
 * What div u really is, the density says, which changes by the fluxes of the pairs themselves:
 * div u = (dw/dt)/w - (dm/dt)/m. So each particle has a slow mean e of what its trace exceeds this
 * by, the false divergence, and the damper acts on what is left:
 *   de/dt = (f (trace - div u) - e)/T,   damper on trace - e.
 * Sound, faster than T, is damped as before; slow flow by what its density says, which in steady
 * flow is next to nothing. T is the time in which the fluid passes a quarter of R, for then it is
 * beside another part of the wall, but at least 2.5 R/c0: below, the damper follows the density
 * with a delay. f, from 0 to 1, is how much the water streams (scheme_streams): nearly at rest the
 * trace stays whole, for what it sees there are currents that shifts feed, and it holds them down
 * (late in a 3D tank of 10 rows 0.6e-3 c0, else 1.2e-3).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "damper.h"

#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"
#include "../surface/sph_surface.h"

static bool has_damper(const struct sph *s)
{
    return s->prm.damper > 0.0 && sph_params_is_riemann(s->prm.scheme);
}

void damper_correct(struct sph *s)
{
    if (!has_damper(s))
        return;
    for (int i = 0; s->dim == 3 && i < s->p.n; i++)
        slope_line(&s->p, i)[SLOPE_FALSE] = s->p.false_divergence[i];
    if (s->surface)
        surface_calm(s);
}

/* Whether the rates of a particle are those of its pairs and walls, and its gradients whole. */
static bool can_learn(const struct sph *s, int i)
{
    return s->p.zone[i] == ZONE_FREE && !particles_is_guard(&s->p, i) && !surface_reaches(s, i);
}

void damper_learn(struct sph *s, double dt)
{
    const int dim = s->dim;
    if (!has_damper(s) || s->mixed) /* mixed sets have a damper of their own: mixed_pairs.c */
        return;
    const double M = s->step.stray / s->c0, f = scheme_streams(s);
    const double share = fmin(dt * s->c0 / s->R / fmax(0.25 / fmax(M, 1e-300), 2.5), 1.0);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i), *rate = state_row(&s->p, s->p.rate, i);
        const double *gu = slope_line(&s->p, i) + dim;
        double *e = s->p.false_divergence + i, trace = 0.0;
        if (!can_learn(s, i)) {
            *e = 0.0;
            continue;
        }
        for (int a = 0; a < dim; a++)
            trace += gu[(dim + 1) * a];
        const double is =
            rate[at_volume(dim)] / y[at_volume(dim)] - rate[at_mass(dim)] / y[at_mass(dim)];
        *e += share * (f * (trace - is) - *e);
    }
}

/* mixed_weights.c - Barcarolo's method (thesis, Ecole Centrale de Nantes 2013; Chiron 2017, 5.2.3):
 * a particle that enters the region of the next level gets 2^D children around it and stays; in a
 * buffer R wide inside the edge its weight falls from 1 to 0 and that of the children rises, so
 * that both generations together count once. Those of weight 0 feel the others and move with the
 * flow. Sums over the fluid take the generation that weighs more.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mixed.h"

#include "refinement.h"

static const double hysteresis = 0.5; /* coarser dx */

/* Level of a particle by its R. */
static int level_of(const struct sph *s, int i) { return (int)lround(log2(s->R / *mixed_R(s, i))); }

/* Distance of particle i from the edge of a level's region, m, positive inside. */
static double distance(const struct sph *s, int level, int i)
{
    return regions_distance(s->refinement->regions, level, state_row(&s->p, s->p.y, i));
}

/* Weight of a level's particles at the distance d from the edge of its region. 0 at the edge, 1
 * from R of the coarser level on; `level' itself gets it, the coarser one the rest. */
static double ramp(const struct sph *s, int level, double d)
{
    return fmax(0.0, fmin(d / ldexp(s->R, 1 - level), 1.0));
}

/* Four children at +-1/4 of the spacing, with half of its R; the parent stays. */
static void give_birth(struct sph *s, int i, int level)
{
    const double quarter = 0.25 * ldexp(s->dx, -level), R = 0.5 * *mixed_R(s, i);
    for (int k = 0; k < 4; k++) {
        const double d[2] = {k & 1 ? quarter : -quarter, k & 2 ? quarter : -quarter};
        mixed_bear(s, i, d, R);
    }
    s->p.role[i] |= ROLE_PARENT;
}

/* Sets the weight chi = ramp at its own region's edge times what the next finer level leaves.
 * Particles that count for less than half are left out of sums over the fluid, as guards are. */
static void weigh(struct sph *s, int i, int level, double own, double next)
{
    const bool has_finer = level < regions_levels(s->refinement->regions);
    const double chi = (level > 0 ? ramp(s, level, own) : 1.0) *
                       (has_finer ? 1.0 - ramp(s, level + 1, next) : 1.0);
    *mixed_weight(s, i) = chi;
    if (chi < 0.5)
        s->p.role[i] |= ROLE_GUARD;
    else
        s->p.role[i] &= (unsigned short)~ROLE_GUARD;
}

/* Children come behind the others and are looked at in turn. A level's particles are removed when
 * they are one coarser spacing outside of their region; parents forget their children half a
 * spacing outside, so that one that comes back has new ones. */
void mixed_weights(struct sph *s)
{
    const int levels = regions_levels(s->refinement->regions);
    s->p.nghost = 0;
    for (int i = 0; i < s->p.n;) {
        const int level = level_of(s, i);
        const double dx = ldexp(s->dx, -level), own = level > 0 ? distance(s, level, i) : INFINITY;
        const double next = level < levels ? distance(s, level + 1, i) : -INFINITY;
        if (own < -2.0 * hysteresis * dx) {
            particles_copy(&s->p, i, --s->p.n);
            continue;
        }
        if (next >= 0.0 && !(s->p.role[i] & ROLE_PARENT))
            give_birth(s, i, level);
        else if (next < -hysteresis * dx)
            s->p.role[i] &= (unsigned short)~ROLE_PARENT;
        weigh(s, i++, level, own, next);
    }
}

/* sound.c - sound that runs to and fro between an inflow of given velocity, which lets it out
 * within some transits (sides.c), and an outflow of given pressure, which returns all of it.
 * Through every section of a duct goes the same volume, so the mean velocity of the fluid is
 * constant whatever its eddies do; what it swings by is sound, a quarter of a wave, with pressures
 * of pi/2 rho c times that at the inflow.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_watch.h"

#include "../particles/sph_particles.h"
#include "../sph.h"

static const double loud = 0.5; /* of rho U^2 */

/* Between a given velocity and a given pressure sound has four lengths for a period, an open organ
 * pipe's. */
void sph_sound_create(struct sph *s)
{
    const struct scene *c = &s->run->scene;
    bool given = false, absorbs = false, moves = false;
    double length = 0.0;
    for (int k = 0; k < c->nwalls; k++) {
        given = given || c->walls[k].kind == WALL_INFLOW;
        absorbs = absorbs || c->walls[k].kind == WALL_ABSORBING;
    }
    for (int k = 0; k < c->nbodies; k++)
        moves = moves || scene_body_moves(c->bodies + k);
    for (int a = 0; a < s->dim; a++)
        length = fmax(length, c->domain.max[a] - c->domain.min[a]);
    s->watch.sound = (struct sph_sound){.on = s->prm.outer == OUTER_SIDES && !s->surface && given &&
                                              !absorbs && !moves,
                                        .period = 4.0 * length / s->c0,
                                        .from = s->t};
}

static double swing(const struct sph_sound *w)
{
    double most = 0.0;
    for (int a = 0; a < 3; a++)
        most = fmax(most, 0.5 * (w->most[a] - w->least[a]));
    return most;
}

/* Over each period the range of the mean velocity. */
void sph_sound_judge(struct sph *s)
{
    struct sph_sound *w = &s->watch.sound;
    double sums[SUM_COUNT];
    sph_sums(s, sums);
    if (s->t >= w->from + w->period) {
        w->swing = swing(w);
        w->from = s->t;
        w->n = 0;
    }
    for (int a = 0; a < 3; a++) {
        const double u = sums[SUM_MOMENTUM + a] / sums[SUM_MASS];
        w->least[a] = w->n > 0 ? fmin(w->least[a], u) : u;
        w->most[a] = w->n > 0 ? fmax(w->most[a], u) : u;
    }
    w->n++;
}

/* Pressures by the head's rule. Loud is measured against the flow's own, viscous ones among
 * them. */
void sph_sound_summarise(const struct sph *s)
{
    const struct sph_sound *w = &s->watch.sound;
    const double U = s->step.max_speed, u = w->swing > 0.0 ? w->swing : swing(w);
    const double p = 0.5 * M_PI * s->rho0 * s->c0 * u, scale = s->rho0 * U * U;
    summary_real(s->run->summary, "sound", p);
    if (p > loud * fmax(scale, s->rho0 * s->prm.speed.viscous))
        log_warn("at the end sound still runs to and fro between inflow and outflow: the mean "
                 "velocity swings by +-%.2g m/s in %.3g s, and pressures by +-%.3g Pa (rho U^2 is "
                 "%.3g Pa). Read means over whole such periods, or let it fade; an outflow of kind "
                 "= \"absorbing\" lets it out",
                 u, w->period, p, scale);
}

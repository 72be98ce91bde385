/* volume.c - the volume of a fluid that fills a closed room. Volumes follow div u0 of each
 * particle, which conserves kernel sums, not the volume of all: as the packing settles the sum
 * changes by parts in a thousand, and with it the level of pressure by c0^2 times that (a full tank
 * of 20 dx: -24 % of rho g H/2 in 0.5 s). Here it is known, and every step brings the sum back to
 * it: all densities change by one factor, which makes no force.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "volume.h"

#include "../../common/scene/scene.h"
#include "../sph.h"

/* Whether the room is closed: no opening, and neither a free surface nor, where shapes fill it, air
 * beside the first water. Walls slide along themselves and bodies are rigid, so that they leave its
 * volume as it is. */
static bool is_closed(const struct sph *s)
{
    const bool full = !s->surface && !scene_has_surface(&s->run->scene);
    return (full || s->start.shut) && !s->zones;
}

void volume_remember(struct sph *s, double volume)
{
    s->start.volume = is_closed(s) ? volume : 0.0;
}

/* Volume of the particles that flow, guards left out, of all levels and ranks, m^dim.
 * Collective. */
static double sum_volumes(const struct sph *s)
{
    const int at = at_volume(s->dim), row = s->p.nstate;
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            sum += particles_is_guard(&q->p, i) ? 0.0 : q->p.y[(size_t)row * i + at];
    return ranks_sum(s->run->comm, sum);
}

/* The factor is the same everywhere: densities change by it, pressures by c0^2 rho (1 - factor) to
 * first order, whose gradient is that of the density, i.e. nearly none. No mass or momentum
 * changes. */
void volume_keep(struct sph *s)
{
    const int at = at_volume(s->dim), row = s->p.nstate;
    if (s->start.volume == 0.0)
        return;
    const double factor = s->start.volume / sum_volumes(s);
    for (; s; s = s->finer)
        for (int i = 0; i < s->p.n; i++)
            s->p.y[(size_t)row * i + at] *= factor;
}

/* Called where something changes the room itself; `by' is this rank's share, m^dim. */
void volume_change(struct sph *s, double by)
{
    if (s->start.volume == 0.0)
        return;
    s->start.volume += ranks_sum(s->run->comm, by);
}

void volume_renew(struct sph *s)
{
    if (s->start.volume != 0.0)
        s->start.volume = sum_volumes(s);
}

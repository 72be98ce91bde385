/* zone_volumes.c - see zone_volumes.h. A particle that enters has the volume dx^D wherever its
 * neighbours stand, and keeps it within R of the side, though strain and shift change the packing
 * there. Volumes that do not fit their packing press where p does not: sum w grad W is not 0. They
 * were carried into the free zone and made its error four times that of particles alone (vortices
 * of Re 200 carried by (0.6, 0.25) U: sum w W scattered by 0.9 % and the velocity erred by 0.0018
 * U; with this by 0.1 % and 0.0005 U). A support from the side births and removals are not seen any
 * longer, and volumes go to what makes sum w W that of a lattice beside the same walls; the mass
 * follows. Not under a free surface, where it is water that users count (breaking wave: 0.15 % of
 * it instead of 4e-6) and little is gained (standing wave: 0.0092 instead of 0.0101, its damping
 * 0.023 instead of 0.032, its enstrophy 0.075 instead of 0.066 off).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "zone_volumes.h"

#include "../pairs/sph_pairs.h"
#include "../walls/sph_walls.h"
#include "zones.h"

static const double memory = 4.0;     /* R/c0: short against the way through the zones */
static const double most = 0.1;       /* deviations beyond it are no packing's */
static const double least_room = 0.4; /* of the support: in narrower places sums say nothing */

/* Volumes go towards kernel sums as they were on the lattice, within `memory' times the time that
 * sound takes through a support; only where whole supports are in the zone. */
void zone_volumes_step(struct sph *s, double dt)
{
    const struct zones *z = s->zones;
    if (s->surface || s->prm.transport == TRANSPORT_NONE) /* streamlines alone make no packing */
        return;
    const double theta = fmin(1.0, dt * s->c0 / (memory * s->R)), lattice = kernel_lattice_sum(s),
                 rim = z->buffer + z->transition;
    double *room = walls_rooms(s);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        const double d = zones_depth(s, prim_line(&s->p, i));
        if (d < s->R || d > rim || room[i] < least_room)
            continue;
        const double more = kernel_sum(s, i) / (room[i] * lattice) - 1.0;
        const double factor = fabs(more) < most ? 1.0 - theta * more : 1.0;
        for (int k = s->dim; k < s->p.nstate; k++) /* momentum, volume, mass */
            y[k] *= factor;
    }
    mem_free(room);
}

/* relax.c - see relax.h. Called at the end of a step, at the new time: u <- u + change towards the
 * waves' velocity, at the rate of the zone there, and the same for the velocity of the step before
 * that bdf2 keeps, so that its difference in time does not see the zone. Cells deep in the air are
 * left out.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "relax.h"

#include <math.h>

#include "../../common/scene/scene.h"
#include "../surface/fv_surface.h"
#include "stages.h"

bool relax_zones(struct fv *s, double dt)
{
    if (!s->wave_zones)
        return false;
    wave_zones_at(s->wave_zones, s->t);
    FLOW_NEAR (s, at, n)
        for (int64_t i = at; i < at + n; i++) {
            double x[3], u_w[3];
            if (s->surface && s->surface->layer[i] == DEEP)
                continue;
            grid_place(&s->grid, i, x);
            const double rate = wave_zones_rate(s->wave_zones, x, u_w);
            if (rate == 0.0)
                continue;
            const double gone = 1.0 - exp(-rate * dt);
            for (int a = 0; a < s->dim; a++) {
                const double change = gone * (u_w[a] - s->u[a][i]);
                s->u[a][i] += change;
                if (s->stages.u_old[a])
                    s->stages.u_old[a][i] += change;
            }
        }
    sides_velocity(s, BC_GIVEN, s->u);
    return true;
}

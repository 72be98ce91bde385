/* relax.c - see relax.h. Called at the end of a step, at the new time: u <- u + change towards the
 * waves' velocity, at the rate of the zone there, and the same for the velocity of the step before
 * that bdf2 keeps, so that its difference in time does not see the zone. Cells deep in the air are
 * left out.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "relax.h"

#include "../../common/scene/scene.h"
#include "../surface/fv_surface.h"
#include "../watch/fv_watch.h"
#include "stages.h"

/* Brings the velocity of cell i nearer to its zone's over dt, s; what that does, m^2/s^3. */
static double relax_cell(struct fv *s, int64_t i, double dt)
{
    double x[3], u_w[3], power = 0.0;
    grid_place(&s->grid, i, x);
    const double rate = wave_zones_rate(s->wave_zones, x, u_w);
    if (rate == 0.0)
        return 0.0;
    const double gone = 1.0 - exp(-rate * dt);
    for (int a = 0; a < s->dim; a++) {
        const double change = gone * (u_w[a] - s->u[a][i]);
        s->u[a][i] += change;
        if (s->stages.u_old[a])
            s->stages.u_old[a][i] += change;
        power += rate * (u_w[a] - s->u[a][i]) * s->u[a][i];
    }
    return power;
}

bool relax_zones(struct fv *s, double dt)
{
    struct watches *w = s->watches;
    if (!s->wave_zones)
        return false;
    if (s->surface && !w->zone_power && wave_zones_drive(s->wave_zones))
        w->zone_power = NEW_IN(w, double, s->size);
    timer_start(&s->run->timers, "waves");
    wave_zones_at(s->wave_zones, s->t);
    FLOW_NEAR (s, at, n)
        for (int64_t i = at; i < at + n; i++) {
            const bool deep = s->surface && s->surface->layer[i] == DEEP;
            const double power = deep ? 0.0 : relax_cell(s, i, dt);
            if (w->zone_power)
                w->zone_power[i] = power;
        }
    sides_velocity(s, BC_GIVEN, s->u);
    timer_stop(&s->run->timers, "waves");
    return true;
}

/* zone_pull.c - see zone_pull.h. The force on a particle is -m rate (u - u_w), with u_w the
 * velocity of the wave that the zone lets through and `rate', 1/s, growing towards the side. Both
 * are looked up once a step, in its first stage, for the middle of the step, which is of second
 * order; to look in every stage took three to four times as long, of a tank that is 38 % zones 4.5
 * % of the run. SPDX-License-Identifier: BSD-3-Clause */
#include "zone_pull.h"

#include "../../common/scene/scene.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"

/* Where a particle is half a step later, as far as its velocity tells. */
static void look_up(struct sph *s, double *pull)
{
    const int dim = s->dim;
    wave_zones_at(s->wave_zones, s->t + 0.5 * s->dt);
    for (int i = 0; i < s->p.n; i++, pull += PULL) {
        const double *q = prim_line(&s->p, i);
        double at[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < dim; a++)
            at[a] = q[a] + 0.5 * s->dt * q[dim + a];
        pull[0] = wave_zones_rate(s->wave_zones, at, pull + 1);
    }
}

/* Walls at rest get what the zones take, and zones that make waves do work. Before open sides on a
 * current the flow that brings the level back goes through the zone, too: held back there it would
 * take no effect. */
void zone_pull_add(struct sph *s)
{
    const int dim = s->dim;
    const bool through = s->zones && s->zones->gap && s->zones->gap->kept;
    double *pull = particles_pull(&s->p);
    double power = 0.0, force[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0};
    timer_start(&s->run->timers, "waves");
    if (!s->lists.pulled)
        look_up(s, pull);
    s->lists.pulled = true;
    for (int i = 0; i < s->p.n; i++, pull += PULL) {
        if (pull[0] == 0.0)
            continue;
        const double *q = prim_line(&s->p, i), m = state_row(&s->p, s->p.y, i)[at_mass(dim)],
                     at[3] = {q[0], q[1], dim > 2 ? q[2] : 0.0};
        double *momentum = state_row(&s->p, s->p.rate, i) + dim,
               u_w[3] = {pull[1], pull[2], pull[3]}, taken[3] = {0.0, 0.0, 0.0}, turned[3];
        if (through)
            zones_add_outflow(s->zones, at, u_w);
        for (int a = 0; a < dim; a++) {
            taken[a] = m * pull[0] * (q[dim + a] - u_w[a]);
            momentum[a] -= taken[a];
        }
        if (particles_is_guard(&s->p, i))
            continue;
        vec3_cross(at, taken, turned);
        for (int a = 0; a < 3; a++) {
            force[a] += taken[a];
            moment[a] += turned[a];
            power -= a < dim ? taken[a] * q[dim + a] : 0.0;
        }
    }
    if (s->walls)
        forces_add_at_rest(s, force, moment);
    timer_stop(&s->run->timers, "waves");
    if (wave_zones_drive(s->wave_zones))
        s->watch.wall_power += power;
}

/* still.c - gravity and the pressure of water at rest, which the equations leave out. Equations
 * solve for the rest: fv_pressure returns it, fv_still_pressure adds rho g.(x - level) where a full
 * pressure is wanted (outputs, forces, gauges).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "still.h"

#include "../../common/scene/scene.h"

/* level: the case's, or without one the height of the highest point of the domain, against
 * gravity. */
struct gravity still_split(const struct scene *scene)
{
    struct gravity split = {.upright = still_upright(scene)};
    const double g = scene_still_gravity(scene, split.hydrostatic);
    double top = 0.0;
    for (int a = 0; a < scene->domain.dim; a++) {
        const double across = split.hydrostatic[a];
        split.periodic[a] = scene->fluid.gravity[a] - across;
        top -= across * (across > 0.0 ? scene->domain.min[a] : scene->domain.max[a]);
    }
    if (scene->initial.level < LEVEL_TOP)
        split.level = scene->initial.level;
    else if (g > 0.0)
        split.level = top / g;
    return split;
}

int still_upright(const struct scene *scene)
{
    const int up = scene_still_axis(scene);
    return up < 0 ? scene->domain.dim - 1 : up;
}

/* 1e-3 of |g| across is a lean; rounding is not. */
bool still_is_inclined(const double still[3])
{
    const double g = vec3_length(still);
    bool inclined = false;
    for (int a = 0; a < 3; a++)
        inclined = inclined || (fabs(still[a]) > 1e-3 * g && fabs(still[a]) < (1.0 - 1e-6) * g);
    return inclined;
}

/* nu/(h sqrt(g h)), 0 without viscosity. */
double still_creep(const double still[3], double nu, double h)
{
    const double fall = h * sqrt(h * vec3_length(still));
    return nu > 0.0 ? nu / fall : 0.0;
}

/* rho (|g| level + g.x); the level is a height against gravity. */
double fv_still_pressure(const struct fv *s, const double *x)
{
    const double *still = s->gravity.hydrostatic;
    double g = 0.0, sum = 0.0;
    for (int a = 0; a < s->dim; a++) {
        g += still[a] * still[a];
        sum += still[a] * x[a];
    }
    return s->run->scene.fluid.rho * (sqrt(g) * s->gravity.level + sum);
}

double fv_still_in_exact(const struct fv *s, const double *x)
{
    return scene_has_wave(&s->run->scene) ? fv_still_pressure(s, x) : 0.0;
}

/* rk3's pressure belongs to t - dt/6, with a surface to the middle of the step: carried on along
 * the last step's change, if the cell had a pressure then. In the first step of a coupled job the
 * partner's water begins to move, which no pressure of the start knows. Without the hydrostatic
 * part. */
double fv_pressure(const struct fv *s, int64_t c)
{
    double on = s->prm.integrator == INTEGRATOR_RK3 && s->step.dt > 0.0 ? 1.0 / 6.0 : 0.0;
    if (s->surface && on > 0.0) {
        const bool begins = s->run->coupled && !(s->step.dt_old > 0.0);
        on = begins || s->p_before[c] == 0.0 ? 0.0 : 0.5;
    }
    return s->run->scene.fluid.rho * (s->p[c] + on * (s->p[c] - s->p_before[c]));
}

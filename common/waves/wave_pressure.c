/* wave_pressure.c - see wave_pressure.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_pressure.h"

#include "../base/base.h"

/* The same columns as the velocities have. now = NAN: the next waves_at fills it. */
void waves_need_pressure(struct waves *w)
{
    if (w->of.kind == WAVE_REGULAR)
        return;
    require(w->table.flat && w->table.parts == 2);
    const struct wave_table *of = &w->table;
    w->rise = wave_table_create(w, of->n, of->rows, of->gap, of->reach, of->slope != NULL);
    w->rise.flat = true;
    w->rise.first = of->first;
    w->rise.first_row = of->first_row;
    w->rise.decay = of->decay;
    w->now = NAN;
}

/* Derivatives of wave_table_cubic's weights along s. */
static void cubic_slopes(double s, double weight[4])
{
    weight[0] = -(3.0 * s * s - 6.0 * s + 2.0) / 6.0;
    weight[1] = (3.0 * s * s - 4.0 * s - 1.0) / 2.0;
    weight[2] = -(3.0 * s * s - 2.0 * s - 2.0) / 2.0;
    weight[3] = (3.0 * s * s - 1.0) / 6.0;
}

/* u[node][2]: from dw/dt in the second place its integral from each node up, in the first. Nodes
 * are equidistant in s, z = -reach s^2, and the integrand over s is f = 2 reach s dw/dt: cubics
 * through four of its values. The lowest node has the value that goes on downwards as `decay' has
 * it. */
static void integrate_column(const struct wave_table *t, double *u)
{
    enum { LAST = WAVE_NODES - 1 };
    const double ds = 1.0 / LAST;
    double f[WAVE_NODES];
    for (int j = 0; j <= LAST; j++)
        f[j] = 2.0 * t->reach * j * ds * u[2 * j + 1];
    u[2 * LAST] = t->decay > 0.0 ? -u[2 * LAST + 1] / t->decay : 0.0;
    for (int j = LAST - 1; j >= 0; j--) {
        const double part = j == 0 ? 9.0 * f[0] + 19.0 * f[1] - 5.0 * f[2] + f[3]
                            : j == LAST - 1
                                ? 9.0 * f[LAST] + 19.0 * f[j] - 5.0 * f[j - 1] + f[j - 2]
                                : 13.0 * (f[j] + f[j + 1]) - f[j - 1] - f[j + 2];
        u[2 * j] = u[2 * j + 2] - part * ds / 24.0;
    }
}

/* Above the still level the integral goes on with dw/dt at that level. */
void wave_pressure_frame(struct waves *w, double share)
{
    struct wave_table *t = &w->rise;
    double weight[WAVE_FRAMES], by_slot[WAVE_FRAMES] = {0.0};
    if (t->n == 0)
        return;
    cubic_slopes(share, weight);
    const long first = (long)floor(w->now / w->dt) - 1;
    for (int k = 0; k < WAVE_FRAMES; k++)
        for (int slot = 0; slot < WAVE_FRAMES; slot++)
            if (w->frame[slot] == first + k)
                by_slot[slot] = weight[k] / w->dt;
    wave_table_blend(t, WAVE_FRAMES, w->frames, by_slot);
    memcpy(t->eta, w->table.eta, (size_t)t->n * sizeof *t->eta);
    for (int i = 0; i < t->n; i++) {
        double *u = t->u + (size_t)i * WAVE_NODES * 2;
        if (t->slope)
            t->slope[2 * i] = -u[1];
        integrate_column(t, u);
    }
}

/* Bernoulli's equation between z and the surface: of regular waves in their own frame, of sums with
 * the integral of dw/dt. */
double waves_pressure(const struct waves *w, double x, double y, double z, const double u[3])
{
    const double eta = waves_eta(w, x, y), hydrostatic = w->of.g * (eta - z);
    double top[3], here[3], there[3];
    waves_velocity(w, x, y, eta, top);
    const double kinetic = 0.5 * (vec3_dot(top, top) - vec3_dot(u, u));
    if (w->of.kind == WAVE_REGULAR)
        return hydrostatic + kinetic - w->celerity * (top[0] - u[0]);
    wave_table_velocity(&w->rise, x, y, z, here);
    wave_table_velocity(&w->rise, x, y, eta, there);
    return hydrostatic + kinetic + w->grown * (here[0] - there[0]);
}

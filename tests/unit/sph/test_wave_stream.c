/* test_wave_stream.c - the waves on a current that sph has behind its open sides, regular ones, a
 * sea and a group, obey the equations of motion, have no pressure on their surface and the mean
 * flow that was asked for, under gravity along any axis; behind a beach is the mean flow.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/open_boundaries/wave_stream.h"
#include "sph_case.h"

static const double g = 9.81, depth = 0.16, length = 1.0, current = -0.2;

/* Waves along the other axis than `up', gravity down it (sign 1) or up it, a beach at the end. */
static struct sph *start(struct sph_case *c, int kind, int up, double sign)
{
    const int along = 1 - up;
    sph_case_set(c, 2, 50);
    struct scene *e = &c->run.scene;
    e->fluid.nu = 0.0;
    e->fluid.rho = 1000.0;
    e->fluid.gravity[up] = -sign * g;
    e->initial.field = FIELD_UNIFORM;
    e->initial.velocity[along] = current;
    e->initial.level = LEVEL_TOP;
    e->domain.periodic[0] = e->domain.periodic[1] = false;
    e->domain.max[along] = 1.0;
    e->domain.min[up] = sign > 0.0 ? 0.0 : -0.24;
    e->domain.max[up] = sign > 0.0 ? 0.24 : 0.0;
    e->nshapes = 1;
    e->shapes[0].form = SHAPE_BELOW;
    e->shapes[0].level = depth;
    e->has_waves = true;
    e->waves.kind = kind;
    e->waves.order = 2;
    e->waves.peak = 3.3;
    e->waves.at[0] = 0.2;
    e->waves.at[1] = 3.3;
    e->waves.height = kind == WAVE_REGULAR ? 0.03 : 0.01;
    e->waves.length = length;
    e->waves.current = current;
    e->waves.closed = true;
    e->nwalls = 2;
    for (int k = 0; k < 2; k++) {
        e->walls[k] = (struct scene_wall){.side = SIDE_X_MIN + 2 * along + k,
                                          .kind = k == 0 ? WALL_OUTFLOW : WALL_INFLOW,
                                          .zone = k == 0 ? ZONE_WAVE : ZONE_BEACH,
                                          .beach = 0.3,
                                          .beach_period = 1.115};
    }
    c->prm.dx = 0.02;
    c->prm.surface = SURFACE_YES;
    c->prm.outer = OUTER_SIDES;
    c->prm.scheme = SCHEME_RIEMANN_ALE;
    c->prm.c0 = 14.0;
    return sph_case_start(c, NULL);
}

/* At `along' and the height z over the still level. */
static void place(int up, double sign, double along, double z, double *x)
{
    x[2] = 0.0;
    x[1 - up] = along;
    x[up] = sign * (depth + z);
}

static void look(const struct sph *s, double t, const double *x, double *u, double *p)
{
    s->zones->eval(s->zones->ctx, t, 1, x, u, p, NULL, NULL);
}

/* du/dt + u.grad u + grad p/rho = gravity, div u = 0, to the accuracy of the wave's table: of sums
 * 2 % of the acceleration g k a of the highest waves, for their third order is not there and cubics
 * through eight columns a length of their shortest component err by 1 % of it (sea_frames.c). */
static void check_motion(const struct sph *s, const double *x, double t)
{
    const struct wave_spec of = scene_waves_spec(&s->run->scene);
    const double dt = 1e-3, k = 2.0 * M_PI / length,
                 most = of.kind == WAVE_REGULAR ? 1e-4 * g : 0.02 * g * k * waves_amplitude(&of);
    double u[2], p, before[2], after[2], gu[6], gp[3];
    s->zones->eval(s->zones->ctx, t, 1, x, u, &p, gu, gp);
    look(s, t - dt, x, before, &p);
    look(s, t + dt, x, after, &p);
    for (int a = 0; a < 2; a++) {
        const double rate =
            0.5 * (after[a] - before[a]) / dt + u[0] * gu[3 * a] + u[1] * gu[3 * a + 1];
        assert_true(fabs(rate + gp[a] / s->rho0 - s->gravity[a]) < most);
    }
    assert_true(fabs(gu[0] + gu[4]) < 5e-3);
}

static void waves_obey_the_equations(int kind, int up, double sign)
{
    struct sph_case c;
    struct sph *s = start(&c, kind, up, sign);
    const double t = 3.3;
    double x[3], u[2], p, phi, g3[3];
    for (int k = 0; k < 4; k++) {
        const double at = 0.03 + 0.1 * k;
        for (int j = 1; j < 5; j++) {
            place(up, sign, at, -0.03 * j, x);
            check_motion(s, x, t);
        }
        place(up, sign, at, 0.0, x);
        s->zones->surface(s->zones->ctx, t, 1, x, &phi, g3);
        for (int a = 0; a < 2; a++) /* to the surface: it is its tangent over x */
            x[a] -= a == up ? phi / g3[up] : 0.0;
        look(s, t, x, u, &p);
        assert_true(fabs(p) < 1e-6 * s->rho0 * g * depth);
        assert_true(g3[up] * sign > 0.9);
    }
    place(up, sign, 0.98, -0.05, x); /* the beach's side */
    look(s, t, x, u, &p);
    assert_close(u[1 - up], current, 1e-9);
    assert_close(p, s->rho0 * g * 0.05, 1e-9);
    s->zones->surface(s->zones->ctx, t, 1, x, &phi, g3);
    assert_close(phi, -0.05, 1e-9);
    DROP(c.s);
}

TEST(under_any_gravity)
{
    waves_obey_the_equations(WAVE_REGULAR, 1, 1.0);
    waves_obey_the_equations(WAVE_REGULAR, 1, -1.0);
    waves_obey_the_equations(WAVE_REGULAR, 0, 1.0);
    waves_obey_the_equations(WAVE_REGULAR, 0, -1.0);
    waves_obey_the_equations(WAVE_SEA, 1, 1.0);
    waves_obey_the_equations(WAVE_FOCUSED, 0, -1.0);
}

/* Volume through a vertical over a period, by Simpson's rule over heights and a mean over times. */
TEST(the_mean_discharge_is_the_current_s)
{
    enum { TIMES = 40, PARTS = 32 };
    struct sph_case c;
    struct sph *s = start(&c, WAVE_REGULAR, 1, 1.0);
    const double T = 1.1149;
    double sum = 0.0, x[3], u[2], p, phi, g3[3];
    for (int k = 0; k < TIMES; k++) {
        const double t = 3.0 + k * T / TIMES;
        place(1, 1.0, 0.05, 0.0, x);
        s->zones->surface(s->zones->ctx, t, 1, x, &phi, g3);
        const double eta = -phi / g3[1], dz = (depth + eta) / PARTS;
        for (int j = 0; j <= PARTS; j++) {
            place(1, 1.0, 0.05, j * dz - depth, x);
            look(s, t, x, u, &p);
            sum += u[0] * (j == 0 || j == PARTS ? 1.0 : j % 2 ? 4.0 : 2.0) * dz / 3.0 / TIMES;
        }
    }
    assert_close(sum, current * depth, 2e-3);
    DROP(c.s);
}

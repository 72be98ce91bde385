/* test_surface_shift.c - shifting that fades towards a free surface [5.14-5.16].
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/kernel.h"
#include "../../../sph/surface/surface.h"
#include "sph_case.h"

TEST(the_law_is_the_printed_one)
{
    assert_close(surface_beta(-0.2), 1.0, 1e-15);
    assert_close(surface_beta(0.1), 1.0, 1e-15);
    assert_close(surface_beta(0.3), 0.0625, 1e-15); /* half way, to the fourth */
    assert_close(surface_beta(0.5), 0.0, 1e-15);
    assert_close(surface_beta(0.8), 0.0, 1e-15);
}

/* A column that collapses in a corner, without weight from the test on. */
static struct sph *collapse(struct sph_case *c)
{
    sph_case_column(c, 32);
    c->prm.surface_shift = SURFACE_SHIFT_BETA;
    struct sph *s = sph_case_start(c, NULL);
    assert_true(sph_case_run(c, 60, 10.0));
    integrate_gradients(s);
    s->gravity[1] = 0.0;
    return s;
}

/* Sum of w W and the distance of the nearest particle on the surface, over all particles. */
static double shepard(const struct sph *s, int i, double *nearest)
{
    const double *x = prim_line(&s->p, i);
    double sum = 0.0;
    *nearest = INFINITY;
    for (int j = 0; j < s->p.n; j++) {
        const double *y = prim_line(&s->p, j), r = hypot(x[0] - y[0], x[1] - y[1]);
        sum += y[at_volume(2)] * kernel_w(2, r, s->R);
        if (s->surface->is[j] == SURFACE_ON && r < *nearest)
            *nearest = r;
    }
    return sum;
}

/* Shifts of a fifth of u, across it, which no bound cuts, go through the law: those on the surface
 * stay, those beyond 2 dx of it keep all of theirs, and between beta of their own sums is left. */
TEST(shifts_fade_with_the_support)
{
    struct sph_case c;
    struct sph *s = collapse(&c);
    int on = 0, part = 0, inner = 0;
    for (int i = 0; i < s->p.n; i++) {
        const double *u = prim_line(&s->p, i) + 2;
        double *u0 = slope_line(&s->p, i) + 6;
        u0[0] = u[0] - 0.2 * u[1];
        u0[1] = u[1] + 0.2 * u[0];
    }
    transport_finish(s);
    for (int i = 0; i < s->p.n; i++) {
        const double *x = prim_line(&s->p, i), *u = x + 2, *u0 = slope_line(&s->p, i) + 6;
        double nearest;
        const double v = 1.0 - shepard(s, i, &nearest), size = hypot(u[0], u[1]);
        const bool is_on = s->surface->is[i] == SURFACE_ON;
        if (x[0] < s->R || x[1] < s->R || fabs(nearest - 2.0 * s->dx) < 1e-9)
            continue; /* walls take part */
        const double left = is_on ? 0.0 : nearest < 2.0 * s->dx ? surface_beta(v) : 1.0;
        assert_close(u0[0] - u[0], -0.2 * left * u[1], 1e-9 * size);
        assert_close(u0[1] - u[1], 0.2 * left * u[0], 1e-9 * size);
        on += is_on;
        part += left > 0.0 && left < 1.0;
        inner += left == 1.0;
    }
    print_message("%d on the surface, %d near it, %d inside\n", on, part, inner);
    assert_true(on > 5 && part > 5 && inner > 5);
    DROP(c.s);
}

/* Sums over all particles of w g.u0 less that of u, signs turned: what shifts lift, and of the
 * shifts that lift alone. */
static double lifted(const struct sph *s, double *up)
{
    double sum = 0.0;
    *up = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i), *u0 = slope_line(&s->p, i) + 6;
        const double power = q[at_volume(2)] * s->gravity[1] * (q[3] - u0[1]);
        sum += power;
        *up += fmax(power, 0.0);
    }
    return sum;
}

/* Of a heap so low that each particle sees a wall or the surface none can give back what the others
 * take: no shift lifts the whole then. Where some are inside they do, as far as they can. */
TEST(shifts_do_no_work_against_gravity_in_thin_water)
{
    static const int rows[2] = {7, 24};
    for (int k = 0; k < 2; k++) {
        struct sph_case c;
        double up;
        sph_case_column(&c, rows[k]);
        struct sph *s = sph_case_start(&c, NULL);
        assert_true(sph_case_run(&c, 60, 10.0));
        integrate_gradients(s);
        for (int i = 0; i < s->p.n; i++) {
            const double *u = prim_line(&s->p, i) + 2;
            double *u0 = slope_line(&s->p, i) + 6;
            u0[0] = u[0];
            u0[1] = u[1] + (i % 3 ? 0.2 : -0.1) * hypot(u[0], u[1]);
        }
        assert_true(lifted(s, &up) > 0.3 * up);
        transport_finish(s);
        assert_true(fabs(lifted(s, &up)) < 1e-9 * up && up > 0.0);
        DROP(c.s);
    }
}

/* Mean height, m, of ten rows over a floor, with a period, after some time: at rest in the mean of
 * a stream of speed U. */
static double height_in_stream(double U)
{
    struct sph_case c;
    struct scene *e = sph_case_column(&c, 20);
    double sum = 0.0;
    e->domain.periodic[0] = true;
    e->nwalls = 1;
    e->walls[0].side = SIDE_Y_MIN;
    e->shapes[0].box[1][0] = 1.0;
    e->initial.field = FIELD_UNIFORM;
    e->initial.velocity[0] = U;
    struct sph *s = sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, SANITIZED ? 30 : 500, 10.0));
    for (int i = 0; i < s->p.n; i++)
        sum += state_row(&s->p, s->p.y, i)[1] / s->p.n;
    DROP(c.s);
    return sum;
}

/* Water that a stream carries is water at rest from another point of view: it is to be shifted as
 * little, and not to sink by more. */
TEST(a_level_stream_is_shifted_as_water_at_rest)
{
    const double rest = height_in_stream(0.0), carried = height_in_stream(0.5);
    print_message("mean height %.6f m at rest, %.6f m in a stream\n", rest, carried);
    assert_true(fabs(carried - rest) < 0.001 * 0.05);
}

/* Mean of p over the weight of the water above, both Pa, of the particles in the lower left corner
 * of a tank whose water is 0.5 m deep. */
static double weighed(const struct sph *s)
{
    double p = 0.0, weight = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i);
        if (q[0] > 0.2 || q[1] > 0.2)
            continue;
        p += eos_p(q[at_rho(2)], s->rho0, s->c0, s->gamma);
        weight += s->rho0 * (0.5 - q[1]);
    }
    return p / weight;
}

/* Volumes of ALE that are too large for their room, as those of water that a falling level left
 * behind: pairs press by w, so an eighth of the pressure is missing while they stay. */
TEST(volumes_of_ale_follow_their_room)
{
    struct sph_case c;
    sph_case_column(&c, 20);
    c.run.scene.nwalls = 4;
    c.run.scene.shapes[0].box[1][0] = 1.0;
    c.prm.scheme = SCHEME_RIEMANN_ALE;
    struct sph *s = sph_case_start(&c, NULL);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        for (int a = 2; a < s->p.nstate && y[0] < 0.2 && y[1] < 0.2; a++)
            y[a] *= 1.15; /* momentum, volume, mass */
    }
    s->lists.ready = false;
    assert_true(sph_case_run(&c, SANITIZED ? 20 : 400, 100.0));
    print_message("t = %.2f s, p %.3f of the weight\n", s->t, weighed(s));
    if (!SANITIZED)
        assert_close(weighed(s), 1.0, 0.05);
    DROP(c.s);
}

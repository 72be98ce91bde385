/* test_wave_absorber.c - a paddle that absorbs returns nothing of the waves that it is made for,
 * whatever the depth and whether it is a piston or a flap; at other frequencies less than one that
 * stands; steered step by step it goes where the theory has it. At the far end of a tank, where the
 * waves run towards it, it is the mirror image of that.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <complex.h>

#include "../../../common/scene/wave_absorber.h"
#include "../../../common/waves/imposed_waves.h"

/* Water h deep, waves so flat that linear theory is theirs; hinge: m over the floor, a piston < 0;
 * far: at the end of the water to which the waves run. */
static struct wave_absorber *absorber_at(bool far, double h, double period, double hinge,
                                         double distance)
{
    struct scene *s = NEW(struct scene, 1);
    struct scene_body *b = s->bodies;
    struct scene_motion *m = b->motion.of;
    s->domain.dim = 2;
    s->domain.min[0] = -1.0;
    s->domain.max[0] = 11.0;
    s->domain.max[1] = 2.0 * h;
    s->fluid.rho = 1000.0;
    s->fluid.gravity[1] = -9.81;
    s->nshapes = 1;
    s->shapes[0].form = SHAPE_BOX;
    s->shapes[0].box[1][0] = 10.0;
    s->shapes[0].box[1][1] = h;
    s->has_waves = true;
    s->waves.height = 1e-4 * h;
    s->waves.period = period;
    s->nbodies = 1;
    b->points.n = 4;
    for (int i = 0; i < 4; i++) {
        b->points.x[i][0] = far ? (i < 2 ? 10.0 : 10.2) : (i < 2 ? -0.2 : 0.0);
        b->points.x[i][1] = i == 1 || i == 2 ? 1.5 * h : fmax(hinge, 0.0);
    }
    b->centre[1] = fmax(hinge, 0.0);
    b->motion.n = 1;
    m->kind = MOTION_WAVES;
    m->axis = hinge < 0.0 ? AXIS_X : AXIS_RZ;
    m->absorb = true;
    struct wave_absorber *a = wave_absorber_create(s, b, m, distance);
    mem_free(s);
    return a;
}

static struct wave_absorber *absorber(double h, double period, double hinge, double distance)
{
    return absorber_at(false, h, period, hinge, distance);
}

TEST(nothing_of_its_own_waves_comes_back)
{
    for (int flap = 0; flap < 2; flap++)
        for (double period = 0.8; period < 4.0; period *= 1.5) {
            struct wave_absorber *a = absorber(0.5, period, flap ? 0.1 : -1.0, 0.03);
            assert_close(1.0 + wave_absorber_returns(a, a->omega), 1.0, 1e-5);
            assert_true(wave_absorber_returns(a, 0.7 * a->omega) < 0.25);
            assert_true(wave_absorber_returns(a, 1.4 * a->omega) < 0.25);
            FREE(a);
        }
}

/* A displacement along the waves is one away from the water there. */
TEST(at_the_far_end_all_is_mirrored)
{
    for (int flap = 0; flap < 2; flap++) {
        struct wave_absorber *a = absorber_at(false, 0.5, 1.5, flap ? 0.1 : -1.0, 0.03),
                             *b = absorber_at(true, 0.5, 1.5, flap ? 0.1 : -1.0, 0.03);
        assert_close(a->at[0], 0.03, 1e-12);
        assert_close(b->at[0], 10.0 - 0.03, 1e-12);
        assert_close(b->gain, -a->gain, 1e-12);
        assert_close(b->beside, -a->beside, 1e-12);
        assert_close(b->lag, a->lag, 1e-12);
        assert_close(1.0 + wave_absorber_returns(b, 0.7 * b->omega),
                     1.0 + wave_absorber_returns(a, 0.7 * a->omega), 1e-12);
        FREE(a, b);
    }
}

/* In long waves the water goes with the wall: no mode stands beside it, and the amplitude over the
 * displacement is k h, by volume (Galvin 1964). */
TEST(a_slow_piston_has_no_modes_beside_it)
{
    struct wave_absorber *slow = absorber(0.5, 30.0, -1.0, 0.0),
                         *fast = absorber(0.5, 1.0, -1.0, 0.0);
    assert_true(fabs(slow->beside) < 1e-2 * slow->made);
    assert_close(slow->made, slow->k * 0.5, 1e-2);
    assert_true(fast->beside > 0.2 && fast->beside < 1.0);
    FREE(slow, fast);
}

/* Steps of the equations of the header under a level e^(i(wt + kx)) that comes in: with what runs
 * off and stands beside it, X goes to i/c times that, so that all is taken up. */
TEST(steps_go_where_the_theory_has_it)
{
    struct wave_absorber *a = absorber(0.5, 1.5, -1.0, 0.04);
    const double dt = 1.5 / 4000.0, w = a->omega;
    const double complex in = cexp(I * a->k * a->distance), wanted = I / a->made;
    double x = 0.0, v = 0.0, mean = 0.0;
    double complex sum = 0.0;
    const int n = 4000 * 60, last = 4000 * 4;
    for (int i = 0; i < n; i++) {
        const double t = i * dt;
        /* the level of the steady state: what comes in, runs off (nothing) and stands beside */
        const double over = creal((in + a->beside * wanted) * cexp(I * w * t)), e = over - mean;
        mean += dt * a->mean_rate * e;
        const double acceleration = (-a->gain * e - v - a->rate * x) / a->lag - a->rate * v;
        x += dt * (v + 0.5 * dt * acceleration);
        v += dt * acceleration;
        sum += i >= n - last ? 2.0 / last * x * cexp(-I * w * t) : 0.0;
    }
    assert_close(creal(sum) + 10.0, creal(wanted) + 10.0, 2e-3);
    assert_close(cimag(sum), cimag(wanted), 1e-2);
    FREE(a);
}

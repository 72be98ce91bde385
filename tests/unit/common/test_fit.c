/* test_fit.c - period and damping of known oscillations. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/base/fit.h"

TEST(decaying_sine)
{
    struct fit f = {0};
    for (int k = 0; k < 2000; k++) {
        const double t = 0.013 * k + 0.002 * sin(k); /* steps that vary */
        fit_add(NULL, &f, t, 3.0 * exp(-0.07 * t) * sin(1.3 * t + 0.4));
    }
    assert_close(fit_period(&f), 2.0 * M_PI / 1.3, 1e-6);
    assert_close(fit_rate(&f), -0.07, 1e-5);
    FREE(f.t, f.v);
}

TEST(too_short)
{
    struct fit f = {0};
    assert_true(isnan(fit_period(&f)) && isnan(fit_rate(&f)));
    for (int k = 0; k < 10; k++)
        fit_add(NULL, &f, k, 1.0 + k);
    fit_add(NULL, &f, 9.0, 7.0); /* not later: left out */
    assert_int_equal(f.n, 10);
    assert_true(isnan(fit_period(&f)) && isnan(fit_rate(&f)));
    FREE(f.t, f.v);
}

/* A straight line stays one; what alternates about it shrinks as the formula says. */
TEST(smoothing_has_no_lag)
{
    const double alpha = 0.4, part = alpha / (2.0 - alpha), left = part * (2.0 - part);
    double level = 2.0, rate = 3.0, scatter = 0.0;
    for (int k = 1; k <= 50; k++)
        fit_smooth(2.0 + 3.0 * 0.1 * k, 0.1, 4.0, &level, &rate, &scatter);
    assert_close(level, 17.0, 1e-12);
    assert_close(rate, 3.0, 1e-12);
    for (int k = 51; k <= 250; k++)
        fit_smooth(2.0 + 3.0 * 0.1 * k + (k % 2 ? -1.0 : 1.0), 0.1, 4.0, &level, &rate, &scatter);
    assert_close(level, 77.0 + left, 1e-9);
}

/* One spike of a hundred times the scatter moves the level by what two scatters would; a step of
 * that size is followed within 40 values. */
TEST(a_spike_is_no_trend)
{
    double level = 0.0, rate = 0.0, scatter = 0.0;
    for (int k = 0; k < 200; k++)
        fit_smooth(k % 2 ? 1.0 : -1.0, 0.1, 4.0, &level, &rate, &scatter);
    const double calm = scatter, foreseen = level + 0.1 * rate;
    assert_true(calm > 1.0 && calm < 2.0);
    fit_smooth(100.0, 0.1, 4.0, &level, &rate, &scatter);
    assert_close(level - foreseen, 0.4 * 1.6 * 2.0 * calm, 1e-12);
    for (int k = 0; k < 40; k++)
        fit_smooth(100.0, 0.1, 4.0, &level, &rate, &scatter);
    assert_close(level, 100.0, 1.0);
}

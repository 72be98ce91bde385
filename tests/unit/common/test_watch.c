/* test_watch.c - a rising energy is seen within its window, a falling one never; levels warn and
 * stop. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/run/program.h"
#include "../../../common/run/watch.h"

TEST(a_falling_energy_gains_nothing)
{
    struct watch_budget b = {.n = 0};
    for (int step = 0; step < 1000; step++)
        assert_close(watch_budget_gain(&b, step, 2.0 - 1e-3 * step), 0.0, 0.0);
}

TEST(a_gain_is_that_of_the_last_hundred_steps)
{
    struct watch_budget b = {.n = 0};
    double gain = 0.0;
    for (int step = 0; step <= 1000; step++)
        gain = watch_budget_gain(&b, step, 1e-3 * step);
    assert_true(gain <= 0.1001 && gain >= 0.0959); /* 100 steps, to a slot of 3 or 4 */
    for (int step = 1001; step <= 1102; step++)
        gain = watch_budget_gain(&b, step, 1.0);
    assert_close(gain, 0.0, 0.0);
}

/* A jet that comes and goes within 20 steps is no gain that lasts; one that stays is. */
TEST(a_gain_counts_once_it_has_lasted)
{
    struct watch_budget b = {.n = 0};
    for (int step = 0; step < 200; step++) {
        watch_budget_gain(&b, step, step >= 100 && step < 120 ? 1.0 : 0.0);
        assert_close(watch_budget_lasting(&b, 25), 0.0, 0.0);
    }
    double lasting = 0.0;
    for (int step = 200; step < 230; step++) {
        watch_budget_gain(&b, step, 1.0);
        lasting = watch_budget_lasting(&b, 25);
        assert_true(step < 220 ? lasting == 0.0 : step < 229 || lasting == 1.0); /* to a slot */
    }
}

TEST(every_tenth_step_is_enough)
{
    struct watch_budget b = {.n = 0};
    double gain = 0.0;
    for (int step = 0; step <= 1000; step += 10)
        gain = watch_budget_gain(&b, step, 1e-3 * step);
    assert_true(gain <= 0.1001 && gain >= 0.0899);
}

TEST(a_level_warns_and_another_stops)
{
    struct diagnosis d = {.bad = false};
    struct watch w = {.key = "x", .what = "x", .likely = "-", .warn = 0.01, .stop = 0.1};
    assert_false(watch_judge(&w, 0.001, 0.0, 0, &d));
    assert_false(w.warned);
    assert_false(watch_judge(&w, 0.05, 0.0, 1, &d));
    assert_true(w.warned && !d.bad);
    assert_false(watch_judge(&w, 0.02, 0.0, 2, &d));
    assert_close(w.worst, 0.05, 0.0);
    assert_true(watch_judge(&w, NAN, 0.0, 3, &d));
    assert_true(d.bad);
}

/* What was too large for a while is a warning; what still is at the end is no sound run. */
TEST(a_run_that_ends_beyond_the_warning_is_not_sound)
{
    const double last[] = {0.001, 0.02, NAN};
    for (int k = 0; k < 3; k++)
        for (int q = 0; q < 2; q++) {
            struct diagnosis d = {.bad = false};
            struct watch w = {.key = "x", .what = "x", .likely = "-", .warn = 0.01, .stop = 0.1};
            struct summary *s = summary_create();
            w.unsound = q ? 0.03 : 0.0;
            watch_judge(&w, 0.05, 0.0, 0, &d);
            watch_judge(&w, last[k], 0.0, 1, &d);
            watch_summary(&w, s);
            assert_int_equal(summary_find_text(s, "not_accepted") != NULL,
                             !(last[k] <= (q ? 0.03 : 0.01)));
            FREE(s);
        }
}

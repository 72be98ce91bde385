/* test_coupling_steps.c - outputs never change the number of coupling steps by more than there are
 * outputs, whatever their times. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/run/coupling_steps.h"

static void check(double span, double since, double every, double dt)
{
    const int64_t n = coupling_steps_number(span, since, every, dt);
    const double alone = ceil(span / dt * (1.0 - 1e-9)), outputs = ceil((span + since) / every);
    int64_t found = 0;
    assert_true(n >= (int64_t)alone && (double)n <= alone + outputs);
    assert_true(span / (double)n <= dt * (1.0 + 1e-9));
    for (int64_t k = 1; k <= n; k++)
        found += coupling_steps_output(n, k, span, since, every);
    /* each output has a step of its own, but one beside the end, which is an output anyway */
    assert_true((double)found <= outputs && (double)found >= outputs - 1.0);
    assert_true(coupling_steps_output(n, n, span, since, every));
    assert_true(coupling_steps_off(n, span, since, every) <= 0.5 * span / (double)n * (1.0 + 1e-9));
}

TEST(outputs_add_no_more_steps_than_they_are)
{
    static const double every[] = {0.0333333, 0.0317, 0.0333334, 0.05, 0.049, 0.0999, 0.01, 0.0071};
    for (size_t k = 0; k < sizeof every / sizeof every[0]; k++)
        for (int q = 1; q <= 200; q++)
            check(0.1, 0.0, every[k], 0.0007 * q);
    check(1000.0, 0.0, 0.0333333, 0.03);
}

TEST(outputs_come_at_their_times_where_steps_allow_it)
{
    assert_int_equal(coupling_steps_number(0.1, 0.0, 0.05, 0.03), 4);
    assert_int_equal(coupling_steps_number(0.1, 0.0, 0.0333333, 0.03), 6);
    assert_int_equal(coupling_steps_number(0.24, 0.0, 0.12, 0.025), 10);
    assert_int_equal(coupling_steps_number(1.0, 0.0, 0.4, 0.3), 5); /* 0.4, 0.8 and 1 */
    assert_int_equal(coupling_steps_number(1.0, 0.0, 0.0, 0.3), 4);
    assert_int_equal(coupling_steps_number(1.0, 0.0, 2.0, 0.3), 4);
    assert_true(coupling_steps_off(5, 1.0, 0.0, 0.4) == 0.0);
    assert_true(coupling_steps_output(5, 2, 1.0, 0.0, 0.4) &&
                coupling_steps_output(5, 4, 1.0, 0.0, 0.4));
    assert_false(coupling_steps_output(5, 1, 1.0, 0.0, 0.4) ||
                 coupling_steps_output(5, 3, 1.0, 0.0, 0.4));
    assert_int_equal(coupling_steps_number(1.0, 0.0, 0.0, 1e-17), 0); /* too many to count */
}

/* What a restart leaves to do begins between two outputs: they come at their own times, not at
 * those counted from the restart. */
TEST(what_is_left_keeps_the_times_of_outputs)
{
    for (int q = 1; q <= 200; q++) /* an output at 0.03, then every 0.05 */
        check(0.1, 0.02, 0.05, 0.0007 * q);
    const int64_t n = coupling_steps_number(0.7, 0.1, 0.4, 0.15); /* ends 0.3 and 0.7 after it */
    assert_int_equal(n, 7);
    for (int64_t k = 1; k <= n; k++)
        assert_true(coupling_steps_output(n, k, 0.7, 0.1, 0.4) == (k == 3 || k == 7));
    assert_true(coupling_steps_off(n, 0.7, 0.1, 0.4) == 0.0);
}

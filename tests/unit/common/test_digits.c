/* test_digits.c - a limit as a message prints it holds: rounded to few digits it lies on the side
 * of the number where it does, and within one unit of the last digit.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/base/digits.h"

/* As messages do. */
static double printed(double x, int digits)
{
    char text[32];
    snprintf(text, sizeof text, "%.*g", digits, x);
    return atof(text);
}

TEST(printed_limits_hold)
{
    for (int k = 1; k < 4000; k++) {
        const double x = 1e-3 * pow(1.0137, k % 1000) / (1.0 + k / 1000);
        for (int digits = 2; digits < 5; digits++) {
            const double below = printed(digits_below(x, digits), digits),
                         above = printed(digits_above(x, digits), digits),
                         unit = pow(10.0, 1.0 - digits) * x;
            assert_true(below <= x * (1.0 + 1e-11) && below >= x - 1.001 * unit);
            assert_true(above >= x * (1.0 - 1e-11) && above <= x + 1.001 * unit);
        }
    }
}

TEST(short_numbers_stay)
{
    const double shorts[] = {0.29, 0.07, 1.0, 120.0, 0.0011, 9.9e5};
    for (int k = 0; k < 6; k++) {
        assert_close(printed(digits_below(shorts[k], 2), 2), shorts[k], 1e-14);
        assert_close(printed(digits_above(shorts[k], 2), 2), shorts[k], 1e-14);
    }
}

/* test.h - cmocka and a comparison of doubles (cmocka 1.1.5 compares only as float). Tests run
 * under MPI; an assertion must compare values that are the same on all ranks, else the others wait
 * for ever. SPDX-License-Identifier: BSD-3-Clause */
#ifndef TESTS_TEST_H
#define TESTS_TEST_H

#include <math.h>
#include <mpi.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Under the sanitizers, ten times slower, a test takes the same code through fewer scenes, steps or
 * cells, and leaves to the plain run what holds after the whole of them alone. */
#ifdef __SANITIZE_ADDRESS__
enum { SANITIZED = 1 };
#else
enum { SANITIZED = 0 };
#endif

/* Whether there is but one rank: what ranks do not change need not be tried on each number of them.
 */
static inline bool is_alone(void)
{
    int size;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size == 1;
}

/* main of a unit: runs a list of cmocka_unit_test(..), the second under MPI. A unit that has more
 * to do before or after its tests writes its own. */
#define TESTS(...)                                                                                 \
    int main(void)                                                                                 \
    {                                                                                              \
        const struct CMUnitTest tests[] = {__VA_ARGS__};                                           \
        return cmocka_run_group_tests(tests, NULL, NULL);                                          \
    }
#define TESTS_WITH_MPI(...)                                                                        \
    int main(int argc, char **argv)                                                                \
    {                                                                                              \
        const struct CMUnitTest tests[] = {__VA_ARGS__};                                           \
        MPI_Init(&argc, &argv);                                                                    \
        const int failed = cmocka_run_group_tests(tests, NULL, NULL);                              \
        MPI_Finalize();                                                                            \
        return failed;                                                                             \
    }

/* |a - b| <= tolerance, absolute; NaN fails. */
#define assert_close(a, b, tolerance)                                                              \
    do {                                                                                           \
        const double a_ = (a), b_ = (b), e_ = (tolerance);                                         \
        if (!(fabs(a_ - b_) <= e_))                                                                \
            fail_msg("%s = %.17g, wanted %s = %.17g within %g", #a, a_, #b, b_, e_);               \
    } while (0)

#endif

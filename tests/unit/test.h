/* test.h - cmocka and a comparison of doubles (cmocka 1.1.5 compares only as float). Tests run
 * under MPI; an assertion must compare values that are the same on all ranks, else the others wait
 * for ever. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

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

#include "../../common/base/mem.h"
#include "../../common/files/series.h"

/* VALUES_OF(fv_row, s, to): the values of the columns that it adds to a row of the series. */
#define VALUES_OF(add, s, to)                                                                      \
    do {                                                                                           \
        struct figures *figures_ = NEW(struct figures, 1);                                         \
        figures_->measures = true;                                                                 \
        add(s, figures_);                                                                          \
        memcpy(to, figures_->value, (size_t)figures_->n * sizeof(double));                         \
        FREE(figures_);                                                                            \
    } while (0)

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

/* Units share one program, which runs the tests of one of them, in the order of the source; main
 * stands in unit.c. UNIT, the name of the file, comes from the Makefile. */
struct unit_test {
    const char *unit, *name;
    CMUnitTestFunction run;
    void (*begin)(void); /* NULL: none */
    int line;
    bool alone; /* it does more on one rank than on several */
    struct unit_test *next;
};
void unit_enlist(struct unit_test *t); /* borrowed for good */

#define UNIT_JOINED(a, b) a##b
#define UNIT_JOIN(a, b) UNIT_JOINED(a, b)
#define UNIT_QUOTED(a) #a
#define UNIT_QUOTE(a) UNIT_QUOTED(a)

/* What a unit does before its first test, under MPI; one that has nothing to do has no such
 * function. */
#define unit_begin UNIT_JOIN(begin_, UNIT)
void unit_begin(void) __attribute__((weak));

/* A test of a unit, which enlists itself: TEST(what_holds) { .. }. They run under MPI. TEST_ALONE
 * is one that asks is_alone and does more on one rank: where the sanitizers and several ranks see
 * all tests, these alone run plainly on one rank. */
#define TEST(name) ENLIST(name, false)
#define TEST_ALONE(name) ENLIST(name, true)
#define ENLIST(name, alone)                                                                        \
    static void name(void **state);                                                                \
    __attribute__((constructor)) static void enlist_##name(void)                                   \
    {                                                                                              \
        static struct unit_test t = {UNIT_QUOTE(UNIT), #name, name, NULL, __LINE__, alone, NULL};  \
        t.begin = unit_begin;                                                                      \
        unit_enlist(&t);                                                                           \
    }                                                                                              \
    static void name(__attribute__((unused)) void **state)

/* The path of a file for the tests of this unit, its last word `name`: the same on all ranks,
 * removed at the end. Of use within unit_begin and later; one file a unit. */
const char *unit_file(const char *name);

/* A number between the two, the next of one sequence for all of a unit. */
static inline double random_in(double lo, double hi) { return lo + (hi - lo) * rand() / RAND_MAX; }

/* Largest difference of n numbers over max(1, |a|), on all ranks; infinite if one is NaN. */
static inline double most_apart(int n, const double *a, const double *b)
{
    double most = 0.0;
    for (int k = 0; k < n; k++) {
        const double e = fabs(a[k] - b[k]) / fmax(1.0, fabs(a[k]));
        most = isnan(e) ? INFINITY : fmax(most, e);
    }
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return most;
}

/* |a - b| <= tolerance, absolute; NaN fails. */
#define assert_close(a, b, tolerance)                                                              \
    do {                                                                                           \
        const double a_ = (a), b_ = (b), e_ = (tolerance);                                         \
        if (!(fabs(a_ - b_) <= e_))                                                                \
            fail_msg("%s = %.17g, wanted %s = %.17g within %g", #a, a_, #b, b_, e_);               \
    } while (0)

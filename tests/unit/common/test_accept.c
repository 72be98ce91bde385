/* test_accept.c - series beside reference data: measures of known curves, files with units,
 * comments and gaps. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <unistd.h>

#include "../../../common/run/accept.h"

enum { N = 201 };

/* v = a sin(pi (t - shift)) on [0, 2] */
static struct accept_series wave(double *room, double a, double shift)
{
    for (int k = 0; k < N; k++) {
        room[k] = 2.0 * k / (N - 1);
        room[N + k] = a * sin(M_PI * (room[k] - shift));
    }
    return (struct accept_series){N, room, room + N};
}

TEST(a_series_equals_itself)
{
    double room[2 * N];
    const struct accept_series s = wave(room, 1.0, 0.0);
    for (int m = ACCEPT_RMS; m <= ACCEPT_ARRIVAL; m++)
        assert_close(accept_distance(m, s, s, 0.0, 0.9), 0.0, 1e-15);
}

TEST(a_higher_series_is_off_by_its_factor)
{
    double one[2 * N], other[2 * N];
    const struct accept_series ref = wave(one, 1.0, 0.0), run = wave(other, 1.2, 0.0);
    assert_close(accept_distance(ACCEPT_PEAK, run, ref, 0.0, 1.0), 0.2, 1e-12);
    assert_close(accept_distance(ACCEPT_IMPULSE, run, ref, 0.0, 1.0), 0.2, 1e-12);
    /* rms of 0.2 sin over one period, over the range 2 */
    assert_close(accept_distance(ACCEPT_RMS, run, ref, 0.0, 2.0), 0.2 / sqrt(2.0) / 2.0, 1e-3);
}

TEST(a_late_series_arrives_late)
{
    double one[2 * N], other[2 * N];
    const struct accept_series ref = wave(one, 1.0, 0.0), run = wave(other, 1.0, 0.1);
    /* half the peak at t = 1/6, or 0.1 later; to a row of 0.01 */
    assert_close(accept_distance(ACCEPT_ARRIVAL, run, ref, 0.0, 1.0), 0.6, 0.07);
}

TEST(what_cannot_be_compared_is_no_number)
{
    double one[2 * N], nothing[2 * N];
    const struct accept_series ref = wave(nothing, 0.0, 0.0), run = wave(one, 1.0, 0.0);
    for (int m = ACCEPT_RMS; m <= ACCEPT_ARRIVAL; m++) {
        assert_true(isnan(accept_distance(m, run, ref, 5.0, 6.0)));
        if (m != ACCEPT_ARRIVAL)
            assert_true(isnan(accept_distance(m, run, ref, 0.0, 2.0)));
    }
}

TEST(a_table_has_names_without_units)
{
    char path[] = "/tmp/estran-table-XXXXXX";
    const int fd = mkstemp(path);
    FILE *f = fdopen(fd, "w");
    fputs("# comment, with a comma\nt [s], p of A [Pa],gap\n0, 1.5,2\n\n1,2.5e3,\n2,x,4\n", f);
    fclose(f);
    struct table *t = table_read(path);
    assert_non_null(t);
    assert_int_equal(t->nrows, 3);
    assert_int_equal(t->ncolumns, 3);
    assert_int_equal(table_column(t, "p of A"), 1);
    assert_int_equal(table_column(t, "p"), -1);
    assert_close(t->v[3 + 1], 2500.0, 0.0);
    assert_true(isnan(t->v[3 + 2]) && isnan(t->v[6 + 1]));
    FREE(t);
    unlink(path);
    assert_null(table_read(path));
}

/* A line of 5000 numbers is one row. */
TEST(a_row_may_be_long)
{
    enum { COLUMNS = 5000 };
    char path[] = "/tmp/estran-table-XXXXXX";
    const int fd = mkstemp(path);
    FILE *f = fdopen(fd, "w");
    for (int k = 0; k < COLUMNS; k++)
        fprintf(f, "c%d%c", k, k < COLUMNS - 1 ? ',' : '\n');
    for (int k = 0; k < COLUMNS; k++)
        fprintf(f, "%d.5%c", k, k < COLUMNS - 1 ? ',' : '\n');
    fclose(f);
    struct table *t = table_read(path);
    assert_non_null(t);
    assert_int_equal(t->nrows, 1);
    assert_int_equal(t->ncolumns, COLUMNS);
    assert_close(t->v[COLUMNS - 1], COLUMNS - 0.5, 0.0);
    FREE(t);
    unlink(path);
}

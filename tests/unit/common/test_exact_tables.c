/* test_exact_tables.c - Taylor-Green against tables made by other means (tests/data), the scales of
 * the fields, and norms. ranks: 1 2 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/scene/exact.h"

static struct exact taylor_green(double Re)
{
    const struct scene s = {.fluid = {.rho = 1.0, .nu = 1.0 / Re},
                            .domain = {.dim = 2},
                            .initial = {.field = FIELD_TAYLOR_GREEN, .U = 1.0, .L = 1.0}};
    return exact_create(&s);
}

/* Next row of numbers of a table; false at its end. */
static bool row(FILE *f, int n, double *v)
{
    char line[512];
    while (fgets(line, sizeof line, f)) {
        char *c = line;
        int k = 0;
        for (; k < n; k++) {
            char *end;
            v[k] = strtod(c, &end);
            if (end == c)
                break;
            c = end + (*end == ',');
        }
        if (k == n)
            return true;
    }
    return false;
}

/* Tests run in the root of the tree. The tables hold nine digits. */
static FILE *table(const char *path)
{
    FILE *f = fopen(path, "r");
    if (!f)
        fail_msg("no table %s: run the tests in the root of the tree", path);
    return f;
}

TEST(decay_is_that_of_the_table)
{
    static const double Re[] = {100, 200, 1000};
    const double x[3] = {0.25, 0.0, 0.0}, corner[3] = {0.0, 0.0, 0.0}, top[3] = {0.25, 0.25, 0.0};
    double v[7], u[3], u0[3], p, p0, w, w0;
    int n = 0;
    FILE *f = table("tests/data/decay.csv");
    for (; row(f, 7, v); n++)
        for (int k = 0; k < 3; k++) {
            const struct exact e = taylor_green(Re[k]);
            exact_point(&e, x, v[0], u, NULL, NULL);
            exact_point(&e, x, 0.0, u0, NULL, NULL);
            exact_point(&e, corner, v[0], NULL, &p, NULL);
            exact_point(&e, corner, 0.0, NULL, &p0, NULL);
            exact_point(&e, top, v[0], NULL, NULL, &w);
            exact_point(&e, top, 0.0, NULL, NULL, &w0);
            assert_close(u0[0], 1.0, 1e-14);
            assert_close(p0, 0.5, 1e-14);
            assert_close(w0, 4.0 * M_PI, 1e-13);
            assert_close(u[0] / u0[0], v[1 + 2 * k], 1e-8);
            assert_close(w / w0, v[1 + 2 * k], 1e-8);
            assert_close(p / p0, v[2 + 2 * k], 1e-8);
        }
    fclose(f);
    assert_true(n > 10);
}

TEST(profiles_are_those_of_the_table)
{
    const struct exact e = taylor_green(200);
    double v[5], u[3], p, w;
    int n = 0;
    FILE *f = table("tests/data/profiles_Re200_t4.csv");
    for (; row(f, 5, v); n++) {
        const double s = v[0];
        exact_point(&e, (double[]){0.5, s, 0}, 4.0, u, NULL, NULL);
        assert_close(u[0], v[1], 1e-8);
        exact_point(&e, (double[]){s, 0.5, 0}, 4.0, u, &p, NULL);
        assert_close(u[1], v[2], 1e-8);
        assert_close(p, v[3], 1e-8);
        exact_point(&e, (double[]){s, 0.25, 0}, 4.0, NULL, NULL, &w);
        assert_close(w, v[4], 1e-8);
    }
    fclose(f);
    assert_int_equal(n, 101);
}

/* The largest speed of two_modes, less what carries it, is U, about. */
TEST(fields_keep_their_scale_and_are_carried)
{
    struct scene s = {
        .fluid = {.rho = 1.0},
        .domain = {.dim = 2},
        .initial = {.field = FIELD_TWO_MODES, .U = 2.0, .L = 0.5, .velocity = {0.3, 0.2, 0.0}}};
    const struct exact e = exact_create(&s);
    double u[3], moved[3], most = 0.0;
    for (int i = 0; i < 64 * 64; i++) {
        const double x[3] = {i % 64 / 128.0, (double)(i / 64) / 128.0, 0.0};
        const double y[3] = {x[0] + 0.3 * 7.0, x[1] + 0.2 * 7.0, 0.0};
        exact_point(&e, x, 0.0, u, NULL, NULL);
        exact_point(&e, y, 7.0, moved, NULL, NULL);
        assert_close(u[0], moved[0], 1e-12); /* inviscid: moved, not changed */
        assert_close(u[1], moved[1], 1e-12);
        most = fmax(most, hypot(u[0] - 0.3, u[1] - 0.2));
    }
    assert_true(most > 0.95 * 2.0 && most < 1.1 * 2.0);
    s.initial.field = FIELD_REST; /* rest is at rest, whatever the velocity says */
    const struct exact rest = exact_create(&s);
    exact_point(&rest, (double[]){0.1, 0.2, 0}, 1.0, u, NULL, NULL);
    assert_true(u[0] == 0.0 && u[1] == 0.0 && u[2] == 0.0);
}

/* Errors 1 .. 8 of weights 2, the reference 4 everywhere, shared out on the ranks. */
TEST(norms_are_those_of_all_ranks)
{
    struct norm n[2] = {0};
    int rank, size;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    for (int k = 1; k <= 8; k++)
        if (k % size == rank)
            norm_add(n, 2.0, k % 2 ? k : -k, 4.0);
    norm_reduce(n, 2, MPI_COMM_WORLD);
    assert_close(norm_relative_l2(n), sqrt(204.0 / 128.0), 1e-14); /* 1 + 4 + .. + 64 = 204 */
    assert_close(norm_rms(n), sqrt(204.0 / 8.0), 1e-14);
    assert_close(norm_mean(n), -0.5, 1e-14);
    assert_close(norm_rms_mean_free(n), sqrt(204.0 / 8.0 - 0.25), 1e-14);
    assert_close(n->emax, 8.0, 0.0);
    assert_close(norm_rms(n + 1) + norm_mean(n + 1) + norm_relative_l2(n + 1), 0.0, 0.0);
}

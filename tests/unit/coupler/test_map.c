/* test_map.c - sums on particles: what they keep, what they do not depend on; and the region around
 * the targets that sources are asked for. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../coupler/mapping/map.h"
#include "../../../coupler/transport/region.h"

enum { TARGETS = 200 };

/* A disturbed lattice of n points a side over the unit box, `order': 0 as it grows, 1 backwards,
 * else shuffled. */
static struct map_cloud lattice(int dim, int n, double disturb, int ncomp, int order)
{
    const long size = dim == 2 ? n * n : (long)n * n * n;
    struct map_cloud c = {.n = size,
                          .x = NEW(double, size *dim),
                          .gid = NEW(int64_t, size),
                          .volume = NEW(double, size),
                          .v = NEW(double, size *ncomp)};
    long *at = NEW(long, size);
    for (long i = 0; i < size; i++)
        at[i] = order == 1 ? size - 1 - i : i;
    srand(7);
    for (long i = size - 1; i > 0 && order > 1; i--) {
        const long j = (long)(random_in(0.0, 1.0) * (double)i), swap = at[i];
        at[i] = at[j];
        at[j] = swap;
    }
    srand(3);
    for (long i = 0; i < size; i++) {
        const long k = at[i];
        const long place[3] = {i % n, i / n % n, i / n / n};
        c.gid[k] = 10 * i + 5;
        c.volume[k] = pow(1.0 / n, dim) * (1.0 + 0.2 * random_in(0.0, 1.0));
        for (int a = 0; a < dim; a++)
            c.x[k * dim + a] = ((double)place[a] + 0.5 + disturb * (random_in(0.0, 1.0) - 0.5)) / n;
    }
    mem_free(at);
    return c;
}

static void set_values(struct map_cloud *c, int dim, double (*f)(const double *))
{
    for (long i = 0; i < c->n; i++) {
        double x[3] = {0};
        memcpy(x, c->x + i * dim, (size_t)dim * sizeof *x);
        c->v[i] = f(x);
    }
}

static void targets(int dim, double lo, double hi, double *x)
{
    srand(11);
    for (int i = 0; i < TARGETS * dim; i++)
        x[i] = lo + (hi - lo) * random_in(0.0, 1.0);
}

static double one(const double *x) { return x[0] * 0.0 + 3.7; }
static double linear(const double *x) { return 1.0 + 2.0 * x[0] - 0.5 * x[1] + 0.3 * x[2]; }
static double bent(const double *x) { return sin(3.0 * x[0]) * cos(2.0 * x[1]) + x[2]; }

static double worst(map_points *map, int dim, int n, double disturb, double R,
                    double (*f)(const double *), double lo, double hi)
{
    double x[3 * TARGETS], v[TARGETS], e = 0.0;
    unsigned char mask[TARGETS];
    struct map_cloud c = lattice(dim, n, disturb, 1, 0);
    set_values(&c, dim, f);
    targets(dim, lo, hi, x);
    map(dim, R, 1, &c, TARGETS, x, v, mask);
    for (int i = 0; i < TARGETS; i++) {
        double y[3] = {0};
        memcpy(y, x + i * dim, (size_t)dim * sizeof *y);
        assert_int_equal(mask[i], 1);
        e = fmax(e, fabs(v[i] - f(y)));
    }
    map_cloud_free(&c);
    return e;
}

TEST(shepard_keeps_constants_also_at_edges)
{
    assert_true(worst(map_shepard, 2, 20, 0.5, 0.15, one, 0.0, 1.0) < 1e-13);
    assert_true(worst(map_shepard, 3, 10, 0.5, 0.25, one, 0.0, 1.0) < 1e-13);
}

TEST(mls_keeps_linear_functions)
{
    assert_true(worst(map_mls, 2, 20, 0.5, 0.2, linear, 0.02, 0.98) < 1e-12);
    assert_true(worst(map_mls, 3, 10, 0.5, 0.35, linear, 0.05, 0.95) < 1e-12);
    assert_true(worst(map_shepard, 2, 20, 0.5, 0.2, linear, 0.02, 0.98) > 1e-3);
}

/* With R a fixed number of spacings: Shepard first order on disordered points, MLS second. */
TEST(orders_are_one_and_two)
{
    double s[2], m[2];
    for (int k = 0; k < 2; k++) {
        const int n = 20 << (2 * k);
        s[k] = worst(map_shepard, 2, n, 0.6, 4.0 / n, bent, 0.2, 0.8);
        m[k] = worst(map_mls, 2, n, 0.6, 4.0 / n, bent, 0.2, 0.8);
    }
    assert_true(log2(s[0] / s[1]) / 2.0 > 0.8);
    assert_true(log2(m[0] / m[1]) / 2.0 > 1.7);
}

TEST(kernel_integrates_to_one_and_has_its_moments)
{
    for (int dim = 2; dim <= 3; dim++) {
        const double R = 0.8, dr = R / 4000;
        double sum = 0.0, second = 0.0;
        for (double r = 0.5 * dr; r < R; r += dr) {
            const double shell = dim == 2 ? 2.0 * M_PI * r : 4.0 * M_PI * r * r;
            sum += map_kernel(dim, r / R, R) * shell * dr;
            second += map_kernel(dim, r / R, R) * shell * dr * r * r / dim;
        }
        assert_true(fabs(sum - 1.0) < 1e-5);
        assert_true(fabs(second / (R * R) - (dim == 2 ? 5.0 / 72.0 : 1.0 / 15.0)) < 1e-5);
        /* the rule of map.h: the kernel's second moment is that of a cell's mean */
        const double h = R / (dim == 2 ? 1.0954 : 1.1180);
        assert_true(fabs(second / (h * h / 12.0) - 1.0) < 1e-3);
    }
}

/* Fine particles, one coarse cell: with the radius of the moment rule the sum is the cell's mean,
 * not the value at its centre. */
TEST(moment_rule_gives_cell_averages)
{
    const double h = 0.2, a = 3.0, b = 2.0, x[2] = {0.45, 0.55};
    struct map_cloud c = lattice(2, 160, 0.0, 1, 0);
    double v;
    unsigned char mask;
    set_values(&c, 2, bent);
    for (long i = 0; i < c.n; i++)
        c.volume[i] = 1.0;
    map_shepard(2, 1.0954 * h, 1, &c, 1, x, &v, &mask);
    const double centre = sin(a * x[0]) * cos(b * x[1]);
    const double mean =
        centre * sin(0.5 * a * h) / (0.5 * a * h) * sin(0.5 * b * h) / (0.5 * b * h);
    assert_true(fabs(v - mean) < 0.02 * fabs(mean - centre));
    map_cloud_free(&c);
}

TEST(order_of_sources_leaves_no_trace)
{
    map_points *const maps[] = {map_shepard, map_mls};
    for (int dim = 2; dim <= 3; dim++)
        for (int k = 0; k < 2; k++) {
            double x[3 * TARGETS], v[3][TARGETS];
            unsigned char mask[TARGETS];
            targets(dim, -0.1, 1.1, x);
            for (int order = 0; order < 3; order++) {
                struct map_cloud c = lattice(dim, dim == 2 ? 20 : 9, 0.5, 1, order);
                set_values(&c, dim, bent);
                maps[k](dim, 0.25, 1, &c, TARGETS, x, v[order], mask);
                map_cloud_free(&c);
            }
            assert_memory_equal(v[0], v[1], sizeof v[0]);
            assert_memory_equal(v[0], v[2], sizeof v[0]);
            /* nor does the number of targets mapped at once */
            struct map_cloud c = lattice(dim, dim == 2 ? 20 : 9, 0.5, 1, 2);
            set_values(&c, dim, bent);
            maps[k](dim, 0.25, 1, &c, 7, x + 50 * dim, v[1], mask);
            assert_memory_equal(v[0] + 50, v[1], 7 * sizeof v[0][0]);
            map_cloud_free(&c);
        }
}

TEST(empty_places_are_masked)
{
    struct map_cloud c = lattice(2, 10, 0.0, 1, 0), none = {0};
    const double x[4] = {0.5, 0.5, 3.0, 3.0};
    double v[2];
    unsigned char mask[2];
    set_values(&c, 2, one);
    map_mls(2, 0.3, 1, &c, 2, x, v, mask);
    assert_int_equal(mask[0], 1);
    assert_int_equal(mask[1], 0);
    assert_true(v[1] == 0.0);
    map_shepard(2, 0.3, 1, &none, 2, x, v, mask);
    assert_int_equal(mask[0], 0);
    map_cloud_free(&c);
    map_cloud_free(&none);
}

/* Points on a line leave MLS without a second direction: Shepard answers. */
TEST(mls_falls_back_where_points_lie_on_a_line)
{
    struct map_cloud c = lattice(2, 20, 0.0, 1, 0);
    for (long i = 0; i < c.n; i++)
        c.x[2 * i + 1] = 0.5;
    set_values(&c, 2, one);
    const double x[2] = {0.5, 0.52};
    double v;
    unsigned char mask;
    map_mls(2, 0.2, 1, &c, 1, x, &v, &mask);
    assert_int_equal(mask, 1);
    assert_true(fabs(v - 3.7) < 1e-12);
    map_cloud_free(&c);
}

TEST(regions_hold_what_is_within_reach)
{
    const double period[3] = {1.0, 0.0, 0.0}, R = 0.07;
    double t[3 * TARGETS], image[27][3];
    for (int dim = 2; dim <= 3; dim++) {
        targets(dim, 0.0, 0.3, t);
        struct region r = region_around(dim, R, period, TARGETS, t, 0);
        struct region wide = region_around(dim, R, period, TARGETS, t, 1);
        assert_true(region_holds(&wide, &r));
        assert_false(region_holds(&r, &wide));
        for (int m = 0; m < 5000; m++) {
            double x[3] = {0};
            bool near = false;
            for (int a = 0; a < dim; a++)
                x[a] = 1.2 * random_in(0.0, 1.0) - 0.1;
            for (int i = 0; i < TARGETS && !near; i++)
                for (int s = -1; s <= 1; s++) {
                    double r2 = 0.0;
                    for (int a = 0; a < dim; a++)
                        r2 += pow(x[a] + (a == 0 ? s : 0) - t[i * dim + a], 2);
                    near = near || r2 < R * R;
                }
            const int n = region_images(&r, x, image);
            assert_true(n > 0 || !near);
            assert_true((n > 0) == (region_images(&r, x, NULL) > 0));
        }
        region_free(&r);
        region_free(&wide);
    }
}

TEST(cells_of_a_box_have_their_margin)
{
    const double origin[3] = {1.0, 0.0, 0.0}, h[3] = {0.1, 0.1, 1.0};
    const double lo[3] = {1.25, 0.05, 0.0}, hi[3] = {1.31, 0.95, 0.0}, none[3] = {1.0, 0.0, 0.0};
    const int cells[3] = {10, 10, 1}, closed[3] = {0}, open[3] = {1, 1, 0};
    int first[3], last[3];
    region_cells(2, origin, h, cells, closed, lo, hi, first, last);
    assert_int_equal(first[0], 0);
    assert_int_equal(last[0], 7);
    assert_int_equal(first[1], 0);
    assert_int_equal(last[1], 10);
    region_cells(2, origin, h, cells, open, lo, hi, first, last);
    assert_int_equal(first[0], -1);
    assert_int_equal(first[1], -3);
    assert_int_equal(last[1], 13);
    region_cells(2, origin, h, cells, open, lo, none, first, last);
    assert_int_equal(first[0], last[0]);
    /* without end: all there is, once round where it is periodic */
    const double from[3] = {-INFINITY, -1e300, 0.0}, to[3] = {INFINITY, 1e300, 0.0};
    region_cells(2, origin, h, cells, closed, from, to, first, last);
    assert_int_equal(first[0], 0);
    assert_int_equal(last[1], 10);
    region_cells(2, origin, h, cells, open, from, to, first, last);
    assert_int_equal(last[0] - first[0], 10 + 2 * 3 + 1);
}

TEST(nearest_takes_the_nearest_and_of_equals_the_lowest_id)
{
    double x[3 * TARGETS], v[TARGETS];
    unsigned char mask[TARGETS];
    for (int dim = 2; dim <= 3; dim++) {
        struct map_cloud c = lattice(dim, 9, 0.5, 1, 2);
        set_values(&c, dim, bent);
        targets(dim, -0.1, 1.1, x);
        map_nearest(dim, 0.3, 1, &c, TARGETS, x, v, mask);
        for (int i = 0; i < TARGETS; i++) {
            double least = INFINITY, value = 0.0;
            for (long j = 0; j < c.n; j++) {
                double r2 = 0.0;
                for (int d = 0; d < dim; d++)
                    r2 += pow(c.x[j * dim + d] - x[i * dim + d], 2);
                value = r2 < least ? c.v[j] : value;
                least = fmin(r2, least);
            }
            assert_int_equal(mask[i], least < 0.09);
            assert_true(v[i] == (least < 0.09 ? value : 0.0));
        }
        map_cloud_free(&c);
    }
    struct map_cloud two = lattice(2, 2, 0.0, 1, 0);
    const double middle[2] = {0.5, 0.5};
    for (long i = 0; i < two.n; i++)
        two.v[i] = (double)two.gid[i];
    map_nearest(2, 2.0, 1, &two, 1, middle, v, mask);
    assert_true(v[0] == 5.0);
    map_cloud_free(&two);
}

/* sum_i g_i (D s)_i = sum_j s_j (C g)_j: dealing out is the transpose of gathering. */
TEST(dealing_is_the_transpose_of_a_consistent_mapping)
{
    map_points *const gather[] = {map_shepard, map_mls, map_nearest};
    const enum map_dealing deal[] = {MAP_DEAL_SHEPARD, MAP_DEAL_MLS, MAP_DEAL_NEAREST};
    const double open[3] = {0.0, 0.0, 0.0};
    for (int dim = 2; dim <= 3; dim++)
        for (int k = 0; k < 3; k++) {
            double x[3 * TARGETS], back[TARGETS], dealt[1000], left = 0.0, right = 0.0;
            unsigned char mask[TARGETS];
            struct map_cloud t = lattice(dim, dim == 2 ? 20 : 9, 0.5, 1, 0), s = {.n = TARGETS};
            set_values(&t, dim, bent);
            targets(dim, 0.0, 1.0, x);
            s.x = NEW(double, TARGETS *dim);
            s.gid = NEW(int64_t, TARGETS);
            s.volume = NEW(double, TARGETS);
            s.v = NEW(double, TARGETS);
            memcpy(s.x, x, (size_t)(TARGETS * dim) * sizeof *x);
            for (int j = 0; j < TARGETS; j++) {
                s.gid[j] = j;
                s.volume[j] = 1.0;
                s.v[j] = cos(3.0 * j);
            }
            assert_true(t.n <= 1000);
            map_deal(deal[k], dim, 0.3, 1, open, &t, &s, 0, t.n, dealt);
            double total = 0.0, given = 0.0;
            for (long i = 0; i < t.n; i++) {
                left += t.v[i] * dealt[i];
                total += dealt[i];
            }
            gather[k](dim, 0.3, 1, &t, TARGETS, x, back, mask);
            for (int j = 0; j < TARGETS; j++) {
                assert_int_equal(mask[j], 1);
                right += cos(3.0 * j) * back[j];
                given += cos(3.0 * j);
            }
            assert_close(left, right, 1e-11);
            assert_close(total, given, 1e-12);
            map_cloud_free(&t);
            map_cloud_free(&s);
        }
}

/* The share of a part of the targets is the same, bit by bit, as in the whole; nothing is lost by
 * sources far from all targets, nor over a periodic side. */
TEST(dealing_loses_nothing_and_knows_no_ranks)
{
    const double period[3] = {1.0, 0.0, 0.0};
    for (int k = 0; k < 3; k++) {
        double whole[100], part[100], sum = 0.0, wanted = 0.0;
        struct map_cloud t = lattice(2, 10, 0.3, 1, 0), s = lattice(2, 25, 0.9, 1, 0);
        set_values(&s, 2, bent);
        for (long i = 0; i < s.n; i++) {
            s.x[2 * i + 1] *= 4.0; /* most of them beyond the targets */
            wanted += s.v[i];
        }
        map_deal((enum map_dealing)k, 2, 0.15, 1, period, &t, &s, 0, t.n, whole);
        for (long i = 0; i < t.n; i++)
            sum += whole[i];
        assert_close(sum, wanted, 1e-11);
        map_deal((enum map_dealing)k, 2, 0.15, 1, period, &t, &s, 33, 71, part);
        assert_memory_equal(part, whole + 33, 38 * sizeof *part);
        /* one source at the right side: half of it goes to the left one */
        struct map_cloud one = {.n = 1};
        one.x = NEW(double, 2), one.gid = NEW(int64_t, 1);
        one.volume = NEW(double, 1), one.v = NEW(double, 1);
        one.x[0] = 1.0, one.x[1] = 0.55, one.v[0] = 1.0;
        map_cloud_free(&t);
        t = lattice(2, 10, 0.0, 1, 0);
        for (long i = 0; i < t.n; i++)
            t.volume[i] = 0.01;
        map_deal((enum map_dealing)k, 2, 0.15, 1, period, &t, &one, 0, t.n, whole);
        double west = 0.0;
        for (long i = 0; i < t.n; i++)
            west += t.x[2 * i] < 0.5 ? whole[i] : 0.0;
        assert_close(west, k == 2 ? rint(west) : 0.5, 1e-12);
        map_cloud_free(&one);
        map_cloud_free(&t);
        map_cloud_free(&s);
    }
}

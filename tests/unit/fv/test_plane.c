/* test_plane.c - the water below a plane in a cell. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/surface/plane.h"

/* Components of very different size, some 0. */
static void random_normal(int dim, double *n)
{
    double sum = 0.0;
    while (sum == 0.0)
        for (int a = 0; a < dim; a++) {
            const int kind = rand() % 6;
            const double size = kind == 0   ? 0.0
                                : kind == 1 ? pow(10.0, -20.0 * random_in(0.0, 1.0))
                                            : 1.0;
            n[a] = 4.0 * (random_in(0.0, 1.0) - 0.5) * size;
            sum += fabs(n[a]);
        }
}

static double size_of(int dim, const double *n)
{
    double sum = 0.0;
    for (int a = 0; a < dim; a++)
        sum += fabs(n[a]);
    return sum;
}

/* The share of alpha's plane is the one asked for. */
TEST(inverse_of_share)
{
    srand(1);
    for (int k = 0; k < 200000; k++) {
        const int dim = 1 + k % 3;
        double n[3];
        random_normal(dim, n);
        const double share = k % 7 ? random_in(0.0, 1.0) : pow(10.0, -15.0 * random_in(0.0, 1.0));
        const double alpha = plane_alpha(dim, n, share);
        assert_close(plane_share(dim, n, alpha), share, 1e-12);
        assert_close(plane_share(dim, n, -alpha), 1.0 - share, 1e-12);
        assert_true(fabs(alpha) <= 0.5 * size_of(dim, n) * (1.0 + 1e-15));
    }
}

/* Slabs add up to the cell, whatever they are. */
TEST(slabs_add_up)
{
    srand(2);
    for (int k = 0; k < 100000; k++) {
        const int dim = 1 + k % 3, a = rand() % dim;
        double n[3];
        random_normal(dim, n);
        const double alpha = (random_in(0.0, 1.0) - 0.5) * size_of(dim, n),
                     cut = random_in(0.0, 1.0) - 0.5;
        assert_close(plane_slab(dim, n, alpha, a, -0.5, cut) +
                         plane_slab(dim, n, alpha, a, cut, 0.5),
                     plane_share(dim, n, alpha), 1e-12);
    }
}

/* Share of the cell by 2^20 points of a regular grid, turned so that no plane is along it. */
TEST(counted_points)
{
    static const double planes[][4] = {{1.0, 0.0, 0.0, 0.2},    {0.3, -1.0, 0.0, 0.1},
                                       {0.5, 0.5, 0.5, -0.3},   {0.01, 0.4, -1.0, 0.0},
                                       {0.1, 0.2, 0.9, 0.33},   {-0.3, 0.34, 0.36, -0.05},
                                       {1e-4, -0.5, 0.5, 0.01}, {0.45, 0.2, 0.35, -0.22}};
    const int m = 100;
    for (size_t q = 0; q < sizeof planes / sizeof planes[0]; q++) {
        const double *n = planes[q];
        int in = 0;
        for (int k = 0; k < m * m * m; k++) {
            const double x = (k % m + 0.5) / m - 0.5, y = (k / m % m + 0.5) / m - 0.5,
                         z = (k / m / m + 0.5) / m - 0.5;
            in += n[0] * x + n[1] * y + n[2] * z < n[3];
        }
        assert_close(plane_share(3, n, n[3]), in / (double)(m * m * m), 6e-3);
    }
}

/* Half of a cell is below any plane through its centre; a corner is a simplex. */
TEST(known_shares)
{
    srand(3);
    for (int k = 0; k < 1000; k++) {
        double n[3];
        random_normal(3, n);
        assert_close(plane_share(3, n, 0.0), 0.5, 1e-14);
        assert_close(plane_alpha(3, n, 0.5), 0.0, 1e-14);
    }
    const double n[3] = {1.0, 1.0, 1.0};
    assert_close(plane_share(3, n, -1.0), 0.125 / 6.0, 1e-14);
    assert_close(plane_share(2, n, -0.5), 0.125, 1e-14);
    assert_true(plane_share(3, n, -1.5) == 0.0 && plane_share(3, n, 1.5) == 1.0);
}

/* test_cells.c - volumes and centroids of general cells against closed forms.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../coupler/cpl.h"

/* x -> A x + b: volumes by the determinant, centroids by the map itself. */
static void affine(const double *x, int n, double *y)
{
    static const double A[3][3] = {{1.5, 0.4, -0.2}, {0.1, 0.8, 0.3}, {-0.3, 0.2, 2.0}};
    for (int i = 0; i < n; i++)
        for (int d = 0; d < 3; d++)
            y[3 * i + d] =
                100.0 + A[d][0] * x[3 * i] + A[d][1] * x[3 * i + 1] + A[d][2] * x[3 * i + 2];
}
static const double determinant =
    1.5 * (0.8 * 2.0 - 0.3 * 0.2) - 0.4 * (0.1 * 2.0 + 0.3 * 0.3) - 0.2 * (0.1 * 0.2 + 0.8 * 0.3);

TEST(polyhedra_have_their_volumes)
{
    static const struct {
        int n;
        double x[24], centroid[3], volume;
    } of[] = {
        {4, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.25, 0.25, 0.25}, 1.0 / 6.0},
        {5, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1}, {0.5, 0.5, 0.25}, 1.0 / 3.0},
        {6, {0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1, 1, 0, 1}, {1 / 3.0, 1 / 3.0, 0.5}, 0.5},
        {8,
         {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1},
         {0.5, 0.5, 0.5},
         1.0},
    };
    for (int k = 0; k < 4; k++) {
        double centroid[3], volume, y[24], wanted[3];
        cpl_cell(3, of[k].n, of[k].x, centroid, &volume);
        assert_close(volume, of[k].volume, 1e-15);
        for (int d = 0; d < 3; d++)
            assert_close(centroid[d], of[k].centroid[d], 1e-15);
        affine(of[k].x, of[k].n, y);
        affine(of[k].centroid, 1, wanted);
        cpl_cell(3, of[k].n, y, centroid, &volume);
        assert_close(volume, of[k].volume * determinant, 1e-12);
        for (int d = 0; d < 3; d++)
            assert_close(centroid[d], wanted[d], 1e-12);
    }
}

TEST(polygons_have_theirs)
{
    double x[300], centroid[3], volume;
    for (int i = 0; i < 100; i++) { /* an L, its sides cut, turned round */
        static const double l[7][2] = {{0, 0}, {0, 2}, {1, 2}, {1, 1}, {3, 1}, {3, 0}, {0, 0}};
        const int side = i * 6 / 100;
        const double s = (i * 6 % 100) / 100.0;
        for (int d = 0; d < 2; d++)
            x[3 * i + d] = l[side][d] + s * (l[side + 1][d] - l[side][d]);
        x[3 * i + 2] = 0.0;
    }
    const int corners[6] = {0, 17, 34, 50, 67, 84};
    for (int k = 0; k < 6; k++) { /* the samples stand beside the corners: put them there */
        static const double l[6][2] = {{0, 0}, {0, 2}, {1, 2}, {1, 1}, {3, 1}, {3, 0}};
        x[3 * corners[k]] = l[k][0];
        x[3 * corners[k] + 1] = l[k][1];
    }
    cpl_cell(2, 100, x, centroid, &volume);
    assert_close(volume, 4.0, 1e-12);
    assert_close(centroid[0], (1.0 * 0.5 + 3.0 * 1.5) / 4.0, 1e-12);
    assert_close(centroid[1], (1.0 * 1.5 + 3.0 * 0.5) / 4.0, 1e-12);
}

/* Two hexahedra with a bent face in common: together what the surface around both holds. */
TEST(cells_that_share_a_bent_face_add_up)
{
    srand(5);
    for (int k = 0; k < 100; k++) {
        double a[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
        double b[24] = {1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 0, 1, 2, 0, 1, 2, 1, 1, 1, 1, 1};
        const int right[4] = {1, 2, 6, 5}, left[4] = {0, 3, 7, 4};
        double centroid[3], va, vb;
        for (int i = 0; i < 4; i++) { /* along x alone: the outer sides stay flat */
            const double x = 1.0 + 0.6 * (random_in(0.0, 1.0) - 0.5);
            a[3 * right[i]] = b[3 * left[i]] = x;
        }
        cpl_cell(3, 8, a, centroid, &va);
        cpl_cell(3, 8, b, centroid, &vb);
        assert_close(va + vb, 2.0, 1e-14);
    }
}

TEST(what_is_no_cell_has_no_volume)
{
    const double x[24] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
    double centroid[3], volume;
    const int n[] = {0, 2, 4, 7, 9};
    for (int k = 0; k < 5; k++) {
        cpl_cell(3, n[k], x, centroid, &volume);
        assert_true(volume == 0.0);
        cpl_cell(2, n[k] < 4 ? n[k] : 4, x, centroid, &volume);
        assert_true(volume == 0.0);
    }
}

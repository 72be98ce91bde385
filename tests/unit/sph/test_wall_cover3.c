/* test_wall_cover3.c - the floor under slopes and columns is left out, slopes end at the sides.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/walls/wall_cover3.h"

static const struct cover_side floor_side = {
    .axis = 2, .high = false, .at = 0.0, .lo = {0, 0, 0}, .hi = {2, 1, 1}};

/* A plane from z = 0 at x = foot upwards, over `from' < y < `to', normal out of the fluid above. */
static struct trimesh slope(double foot, double rise, double from, double to, double below)
{
    struct trimesh m = {.nvertices = 4, .ntriangles = 2};
    m.x = mem_new(4, sizeof *m.x);
    m.vertex = mem_new(2, sizeof *m.vertex);
    for (int k = 0; k < 4; k++) {
        m.x[k][0] = k == 1 || k == 2 ? 2.2 : foot - below;
        m.x[k][1] = k > 1 ? to : from;
        m.x[k][2] = (m.x[k][0] - foot) * rise;
    }
    memcpy(m.vertex[0], (const int[]){0, 2, 1}, sizeof *m.vertex);
    memcpy(m.vertex[1], (const int[]){0, 3, 2}, sizeof *m.vertex);
    trimesh_connect(&m);
    return m;
}

/* Area of the floor that is left; it looks down. */
static double floor_left(struct trimesh *m, double size, int *triangles)
{
    struct tree *t = tree_create(m);
    struct trimesh left = wall_cover_side(&floor_side, 1, (const struct tree *const[]){t}, size);
    for (int k = 0; k < left.ntriangles; k++) {
        double n[3];
        assert_true(trimesh_normal(&left, k, n) > 0.0);
        assert_close(n[2], -1.0, 1e-12);
    }
    const double area = trimesh_area(&left);
    if (triangles)
        *triangles = left.ntriangles;
    FREE(t);
    trimesh_free(&left);
    return area;
}

TEST(slopes_hide_the_floor)
{
    for (int k = 0; k < 20; k++) {
        const double foot = random_in(0.2, 1.8), more = k % 2 ? 0.3 : 0.0; /* beyond the sides */
        struct trimesh m = slope(foot, random_in(0.1, 2.0), -more, 1.0 + more, more);
        int triangles;
        assert_close(floor_left(&m, 0.05, &triangles), foot, 1e-9);
        assert_true(triangles < 2000);
        trimesh_free(&m);
    }
}

/* Through the floor, or on it with the faces back to back; its outline is no line of the cut. */
TEST(columns_hide_the_floor)
{
    for (int k = 0; k < 10; k++) {
        const double lo[3] = {random_in(0.1, 0.9), random_in(0.1, 0.4), k % 2 ? 0.0 : -0.2};
        const double hi[3] = {random_in(1.1, 1.9), random_in(0.6, 0.9), 0.5};
        struct trimesh m = trimesh_box(lo, hi, 1);
        trimesh_turn(&m, -1); /* the fluid is outside */
        trimesh_connect(&m);
        const double area = (hi[0] - lo[0]) * (hi[1] - lo[1]);
        assert_close(floor_left(&m, 0.01, NULL), 2.0 - area, 2e-4);
        trimesh_free(&m);
    }
}

TEST(what_hides_nothing_cuts_nothing)
{
    int triangles;
    for (int k = 0; k < 10; k++) {
        const double middle[3] = {random_in(0.5, 1.5), 0.5, random_in(0.31, 0.6)};
        struct trimesh m = trimesh_sphere(middle, 0.3, 2);
        trimesh_turn(&m, -1);
        trimesh_connect(&m);
        assert_close(floor_left(&m, 0.02, &triangles), 2.0, 1e-12);
        assert_int_equal(triangles, 2);
        trimesh_free(&m);
    }
}

TEST(slopes_end_at_the_sides)
{
    for (int k = 0; k < 20; k++) {
        const double foot = random_in(0.2, 1.8), rise = random_in(0.1, 2.0);
        struct trimesh m = slope(foot, rise, -0.3, 1.4, 0.5);
        struct trimesh cut = trimesh_within(&m, floor_side.lo, (const double[]){2, 1, INFINITY});
        assert_close(trimesh_area(&cut), (2.0 - foot) * hypot(1.0, rise), 1e-9);
        trimesh_free(&cut);
        trimesh_free(&m);
    }
}

/* test_trimesh_end.c - solids that end on a plane: what is left on either side of it makes up the
 * whole, is closed, and holds the points that the whole held.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/geometry/geometry.h"

/* Turned about an axis that is none of the frame's. */
static void turn(struct trimesh *m)
{
    double axis[3] = {0.3, -0.5, 0.8};
    vec3_unit(axis);
    for (int v = 0; v < m->nvertices; v++) {
        double across[3], *x = m->x[v];
        const double along = vec3_dot(axis, x) * (1.0 - cos(0.7));
        vec3_cross(axis, x, across);
        for (int a = 0; a < 3; a++)
            x[a] = x[a] * cos(0.7) + across[a] * sin(0.7) + along * axis[a];
    }
}

/* A block with rooms inside: a section has holes. */
static struct trimesh block_with_rooms(int rooms)
{
    struct trimesh m = trimesh_box((const double[]){-1, -1, -1}, (const double[]){1, 1, 1}, 3);
    for (int k = 0; k < rooms; k++) {
        const double y = -0.8 + 1.7 * k / rooms;
        struct trimesh room = trimesh_box((const double[]){-0.9, y, -0.7},
                                          (const double[]){0.9, y + 1.2 / rooms, 0.8}, 2);
        trimesh_append(&m, &room);
        trimesh_free(&room);
    }
    trimesh_connect(&m);
    trimesh_orient_closed(&m, 1);
    return m;
}

static struct trimesh solid(int which)
{
    static const double comb[][2] = {{-1, -1},    {1, -1},    {1, 1},      {0.6, 1},  {0.6, -0.5},
                                     {0.2, -0.5}, {0.2, 0.9}, {-0.3, 0.9}, {-0.3, 0}, {-1, 0}};
    return which == 0
               ? trimesh_box((const double[]){-1, -0.7, -1}, (const double[]){1, 0.8, 0.9}, 4)
           : which == 1 ? trimesh_sphere((const double[]){0, 0.1, 0}, 1.0, 3)
           : which == 2 ? trimesh_prism(10, comb, -0.8, 0.9)
                        : block_with_rooms(which - 2);
}

static void cut_one(int which, bool turned, int axis, double at)
{
    struct trimesh all = solid(which), half[2];
    if (turned)
        turn(&all);
    double volume = 0.0;
    for (int high = 0; high < 2; high++) {
        struct trimesh *m = half + high;
        *m = trimesh_copy(&all);
        assert_true(trimesh_end(m, axis, at, high, 1e-6));
        assert_true(m->closed);
        assert_int_equal(m->rims + m->clashes, 0);
        double lo[3], hi[3];
        trimesh_bounds(m, lo, hi);
        assert_true((high ? hi[axis] : lo[axis]) == at);
        volume += trimesh_solid(m, -1).volume;
        for (int k = 0; k < 60; k++) {
            double x[3] = {1.3 * sin(5.0 + 11.0 * k), 1.3 * sin(2.0 + 7.0 * k), 1.3 * sin(3.0 * k)};
            if ((x[axis] < at) == high && fabs(x[axis] - at) > 1e-3)
                assert_close(trimesh_winding(m, x), trimesh_winding(&all, x), 1e-6);
            else if (fabs(x[axis] - at) > 1e-3)
                assert_close(trimesh_winding(m, x), 0.0, 1e-6);
        }
    }
    assert_close(volume, trimesh_solid(&all, -1).volume, 1e-9);
    for (int high = 0; high < 2; high++)
        trimesh_free(half + high);
    trimesh_free(&all);
}

TEST(both_sides_of_a_plane_make_up_the_whole)
{
    for (int which = 0; which < 6; which++)
        for (int axis = 0; axis < 3; axis++)
            for (int k = 0; k < 4; k++) {
                cut_one(which, false, axis, -0.61 + 0.37 * k);
                cut_one(which, true, axis, -0.61 + 0.37 * k);
            }
}

/* Planes through rows of vertices, whose faces lie in it. */
TEST(planes_through_faces_and_vertices)
{
    cut_one(0, false, 0, 0.0);
    cut_one(1, false, 2, 0.0);
    cut_one(2, false, 1, -0.5);
    cut_one(2, false, 1, 0.0);
    cut_one(3, false, 0, 0.9);
    cut_one(3, false, 2, -0.7);
}

/* A face that a file's digits leave before or behind the plane is put on it; one that is all beyond
 * stays. */
TEST(what_misses_the_plane_by_digits_is_put_on_it)
{
    struct trimesh m = trimesh_box((const double[]){0, 0, -1e-8}, (const double[]){1, 1, 1}, 2);
    assert_false(trimesh_end(&m, 2, 0.0, false, 1e-6));
    double lo[3], hi[3];
    trimesh_bounds(&m, lo, hi);
    assert_true(lo[2] == 0.0 && m.closed);
    assert_false(trimesh_end(&m, 2, 2.0, false, 1e-6));
    assert_close(trimesh_solid(&m, -1).volume, 1.0, 1e-12);
    trimesh_free(&m);
}

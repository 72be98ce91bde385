/* test_shape_velocity.c - what a shape in motion gives a cell at the start is its share of the
 * cell. ranks: 1. SPDX-License-Identifier: BSD-3-Clause */
#include "../../../fv/case/fv_case.h"
#include "../test.h"

/* A band and a disc, in cells that their edges cut anywhere; the second way is the overlap of
 * intervals, and the disc's area. */
TEST(a_cell_has_the_share_of_its_shape)
{
    struct run r = {.coupled = true};
    struct fv s = {.run = &r, .dim = 2};
    const double edges[3] = {0.1, 0.1, 1.0};
    struct scene_shape *shape = r.scene.shapes;
    r.scene.domain.dim = 2;
    r.scene.nshapes = 1;
    shape[0] = (struct scene_shape){
        .form = SHAPE_BOX, .velocity = {1.0, -2.0}, .box = {{-1.0, 0.137}, {1.0, 0.362}}};
    for (int j = 0; j < 6; j++) {
        const double x[3] = {0.05, 0.1 * j + 0.05, 0.0};
        const double share = fmax(0.0, fmin(0.362, x[1] + 0.05) - fmax(0.137, x[1] - 0.05)) / 0.1;
        double u[3] = {0.5, 0.0, 0.0};
        fv_shape_velocity(&s, x, edges, u);
        assert_close(u[0], 0.5 + share, 1.0 / 64);
        assert_close(u[1], -2.0 * share, 2.0 / 64);
    }
    shape[0] = (struct scene_shape){
        .form = SHAPE_DISC, .velocity = {1.0}, .centre = {0.03, 0.02}, .radius = 0.23};
    double sum = 0.0;
    for (int k = 0; k < 64; k++) {
        const double x[3] = {0.1 * (k % 8) - 0.35, 0.1 * (k / 8) - 0.35, 0.0};
        double u[3] = {0.0};
        fv_shape_velocity(&s, x, edges, u);
        sum += u[0] * 0.01;
    }
    assert_close(sum, M_PI * 0.23 * 0.23,
                 0.005 * sum); /* slivers between the points are not seen */
}

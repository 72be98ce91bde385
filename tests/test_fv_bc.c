/* test_fv_bc.c - walls and openings: a vortex between no-slip walls against finer grids,
 * Taylor-Green between slip walls, channels, flow through, forces, ranks, restart. ranks: 1 2 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include "fv_bc_case.h"

static void no_slip_walls_keep_the_order(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double cfl = k ? 1.0 : 0.5;
        double d[3][3];
        struct box_flow f[4];
        for (int m = 0; m < 4; m++)
            box_run(f + m, 16 << m, cfl, 0.25);
        for (int m = 0; m < 3; m++)
            box_difference(f + m, f + m + 1, d[m]);
        for (int m = 0; m < 2; m++)
            print_message("cfl %g, %d: u %.3g order %.2f max %.3g order %.2f p %.3g order %.2f\n",
                          cfl, 16 << m, d[m][0], log2(d[m][0] / d[m + 1][0]), d[m][1],
                          log2(d[m][1] / d[m + 1][1]), d[m][2], log2(d[m][2] / d[m + 1][2]));
        for (int m = 0; m < 4; m++)
            box_free(f + m);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_slip_walls_keep_the_order)};
    MPI_Init(&argc, &argv);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    MPI_Finalize();
    return failed;
}

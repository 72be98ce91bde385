/* test_sph_ranks.c - the number of ranks changes nothing but rounding.
 * ranks: 1 2 4. SPDX-License-Identifier: BSD-3-Clause */
#include "test.h"

#include "sph_case.h"

static double *run_on(MPI_Comm comm, int dim, int cells, int steps, int n)
{
    struct sph_case c;
    sph_case_set(&c, dim, cells);
    c.run.comm = comm;
    MPI_Comm_rank(comm, &c.run.rank);
    MPI_Comm_size(comm, &c.run.size);
    c.prm.noise = 0.1;
    sph_case_start(&c, NULL);
    sph_case_run(&c, steps, 100.0);
    double *y = sph_case_gather(c.s, n);
    sph_free(&c.s);
    return y;
}

static void agree(int dim, int cells, int steps)
{
    const int n = dim == 2 ? cells * cells : cells * cells * cells, row = 2 * dim + 2;
    double *alone = run_on(MPI_COMM_SELF, dim, cells, steps, n);
    double *shared = run_on(MPI_COMM_WORLD, dim, cells, steps, n);
    double most = 0.0;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < row; k++) {
            double e = fabs(alone[i * row + k] - shared[i * row + k]);
            if (k < dim) /* on either side of the seam */
                e = fmin(e, fabs(e - 1.0));
            most = fmax(most, k < dim ? e * cells : e / alone[i * row + row - 1]);
        }
    assert_true(max_anywhere(most) < 1e-9);
    mem_free(alone);
    mem_free(shared);
}

static void ranks_agree_in_2d(void **state)
{
    (void)state;
    agree(2, 30, 8);
}

static void ranks_agree_in_3d(void **state)
{
    (void)state;
    agree(3, 12, 4);
}

/* Births are numbered by face, so sums over all particles must agree; order of births may not
 * matter. */
static void zone_sums(MPI_Comm comm, double *sums)
{
    struct sph_case c;
    sph_case_set(&c, 2, 40);
    c.run.comm = comm;
    MPI_Comm_rank(comm, &c.run.rank);
    MPI_Comm_size(comm, &c.run.size);
    c.run.scene.domain.periodic[0] = c.run.scene.domain.periodic[1] = false;
    c.run.scene.domain.min[0] = c.run.scene.domain.min[1] = 0.1;
    c.run.scene.domain.max[0] = c.run.scene.domain.max[1] = 0.9;
    c.prm.outer = OUTER_EXACT;
    sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, 40, 100.0));
    sph_sums(c.s, sums);
    sph_free(&c.s);
}

static void ranks_agree_with_open_sides(void **state)
{
    (void)state;
    double alone[SUM_COUNT], shared[SUM_COUNT];
    zone_sums(MPI_COMM_SELF, alone);
    zone_sums(MPI_COMM_WORLD, shared);
    for (int k = 0; k < SUM_COUNT; k++)
        assert_true(fabs(alone[k] - shared[k]) < 1e-8);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ranks_agree_in_2d),
                                       cmocka_unit_test(ranks_agree_in_3d),
                                       cmocka_unit_test(ranks_agree_with_open_sides)};
    MPI_Init(&argc, &argv);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    MPI_Finalize();
    return failed;
}

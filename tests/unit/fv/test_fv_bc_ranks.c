/* test_fv_bc_ranks.c - walls and openings: the number of ranks changes nothing but rounding, a
 * restart nothing at all. ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_bc_case.h"
#include "fv_restart.h"

enum { CAVITY, DUCT, CARRIED, CAVITY_3D, GRADED, GRADED_3D, FLOWS };

static struct fv *start(struct fv_case *c, MPI_Comm comm, int flow, struct h5 *f)
{
    const bool solid = flow == CAVITY_3D || flow == GRADED_3D,
               duct = flow == DUCT || flow == CARRIED;
    fv_case_set(c, comm,
                (const char *const[]){CLOSED, "initial.field=\"rest\"", "fluid.nu=0.01",
                                      solid ? "domain.dim=3" : "domain.dim=2",
                                      solid ? "fv.cells=(16,12,16)" : "fv.cells=(24,26)",
                                      flow == GRADED      ? "fv.graded=(0.6,14)"
                                      : flow == GRADED_3D ? "fv.graded=(0.8,4)"
                                                          : "fv.graded=(0,0)",
                                      NULL});
    c->run.scene.domain.periodic[2] = false;
    wall_add(c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    wall_add(c, SIDE_Y_MAX, WALL_NO_SLIP, duct ? 0.0 : 1.0);
    wall_add(c, SIDE_X_MIN, duct ? WALL_INFLOW : WALL_NO_SLIP, duct ? 1.0 : 0.0);
    wall_add(c, SIDE_X_MAX, duct ? WALL_OUTFLOW : WALL_NO_SLIP, 0.0)->carried = flow == CARRIED;
    if (solid) {
        wall_add(c, SIDE_Z_MIN, WALL_SLIP, 0.0);
        wall_add(c, SIDE_Z_MAX, WALL_NO_SLIP, 0.0);
    }
    return fv_case_start(c, f);
}

/* Largest speed, energy, forces, a weighted sum. */
static void sums_on(MPI_Comm comm, int flow, double sums[FV_CASE_ROW])
{
    struct fv_case c;
    double row[FV_CASE_ROW] = {0.0};
    struct fv *s = start(&c, comm, flow, NULL);
    const bool good = fv_case_run(&c, 8, 100.0);
    VALUES_OF(fv_row, s, row);
    for (int k = 0; k < FV_CASE_ROW; k++)
        sums[k] = good ? row[k] : NAN;
    sums[2] = good ? fv_case_weighted(s) : NAN;
    fv_free(&c.s);
}

TEST(ranks_agree)
{
    for (int flow = 0; flow < FLOWS; flow++) {
        double alone[FV_CASE_ROW], shared[FV_CASE_ROW];
        sums_on(MPI_COMM_SELF, flow, alone);
        sums_on(MPI_COMM_WORLD, flow, shared);
        const double most = most_apart(FV_CASE_ROW, alone, shared);
        print_message("flow %d: %.3g\n", flow, most);
        assert_close(most, 0.0, 1e-9);
    }
}

TEST(restart_is_exact)
{
    for (int flow = 0; flow < FLOWS; flow++)
        assert_int_equal(fv_case_restart(start, flow, 3), 0);
}

/* test_newton_ranks.c - implicit steps: the number of ranks changes nothing but rounding, a restart
 * nothing at all. ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/time/newton.h"
#include "fv_bc_case.h"
#include "fv_restart.h"

#define NEWTON "fv.integrator=\"newton\"", "fv.tol_newton=1e-10"
#define MODES NEWTON, "initial.field=\"two_modes\"", "initial.velocity=(0.5,0.25)", "fv.cfl=4"

enum { WAVES, HOLE, SOLID, CAVITY, STEADY, FLOWS };

static struct fv *start(struct fv_case *c, MPI_Comm comm, int flow, struct h5 *f)
{
    static const char *const overrides[FLOWS][10] = {
        {MODES, "fv.c0=20", "fv.cells=(16,12)", NULL},
        {MODES, "fv.cells=(16,16)", "fv.hole=((0.3125,0.3125),(0.6875,0.6875))", NULL},
        {NEWTON, "domain.dim=3", "fv.cells=(8,12,8)", "fv.cfl=4", "fv.flux=\"upwind\"", NULL},
        {NEWTON, CLOSED, "initial.field=\"rest\"", "fv.cells=(16,14)", "fv.cfl=4", NULL},
        {NEWTON, CLOSED, "initial.field=\"rest\"", "fv.cells=(16,14)", "fv.steady=true", NULL}};
    fv_case_set(c, comm, overrides[flow]);
    for (int k = SIDE_X_MIN; k <= SIDE_Y_MAX && flow >= CAVITY; k++)
        wall_add(c, (enum scene_side)k, WALL_NO_SLIP, k == SIDE_Y_MAX ? 1.0 : 0.0);
    return fv_case_start(c, f);
}

/* Energy, largest speed and a weighted sum after a few steps. */
static void sums_on(MPI_Comm comm, int flow, double sums[3])
{
    struct fv_case c;
    double row[16] = {0.0};
    struct fv *s = start(&c, comm, flow, NULL);
    const bool good = fv_case_run(&c, 2, 100.0);
    VALUES_OF(fv_row, s, row);
    assert_true(s->newton->krylovs < 300 && s->newton->halvings == 0);
    sums[0] = good ? row[0] : NAN;
    sums[1] = row[1];
    sums[2] = fv_case_weighted(s);
    fv_free(&c.s);
}

/* Sweeps end at a rank's cells, so the iterations differ; what they converge to does not. A march
 * does not converge in each step. */
TEST(ranks_agree)
{
    for (int flow = 0; flow < STEADY; flow++) {
        double alone[3], shared[3];
        sums_on(MPI_COMM_SELF, flow, alone);
        sums_on(MPI_COMM_WORLD, flow, shared);
        const double most = most_apart(3, alone, shared);
        print_message("flow %d: %.3g\n", flow, most);
        assert_close(most, 0.0, 1e-7);
    }
}

TEST(restart_is_exact)
{
    for (int flow = 0; flow < FLOWS; flow++)
        assert_int_equal(fv_case_restart(start, flow, 2), 0);
}

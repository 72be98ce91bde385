/* test_surface_implicit_ranks.c - a free surface with bdf2 and newton: the number of ranks changes
 * nothing but rounding, a restart nothing at all. ranks: 1 2. SPDX-License-Identifier: BSD-3-Clause
 */
#include "../test.h"

#include "fv_restart.h"
#include "surface_case.h"

enum { FLOWS = 4 };

static struct fv *flow_start(struct fv_case *c, MPI_Comm comm, int flow)
{
    const struct scene_shape column = {.form = SHAPE_BOX, .box = {{0, 0, 0}, {0.43, 0.61, 0.57}}};
    const char *const by = integrators[flow % 2];
    if (flow < 2)
        return start(c, comm,
                     (const char *const[]){WAVE, "fv.cells=(24,20)", "fluid.nu=2e-3", by,
                                           "fv.tol_pressure=1e-6", NULL},
                     NULL, WALL_NO_SLIP);
    return start(c, comm,
                 (const char *const[]){SURFACE, "fluid.gravity=(0,-9.81)", "fv.cells=(26,24)", by,
                                       "fv.tol_pressure=1e-9", "fv.tol_viscous=1e-9",
                                       "fv.tol_newton=1e-9", NULL},
                 &column, WALL_NO_SLIP);
}

static void sums_on(MPI_Comm comm, int flow, double sums[4])
{
    struct fv_case c;
    struct fv *s = flow_start(&c, comm, flow);
    const bool good = fv_case_run(&c, 6, 100.0);
    sums[0] = good ? surface_energy(s) : NAN;
    sums[1] = surface_reach(s, 0);
    sums[2] = surface_reach(s, 1);
    sums[3] = s->max.u[0];
    fv_free(&c.s);
}

TEST(ranks_agree)
{
    for (int flow = 0; flow < FLOWS; flow++) {
        double alone[4], shared[4], most = 0.0;
        sums_on(MPI_COMM_SELF, flow, alone);
        sums_on(MPI_COMM_WORLD, flow, shared);
        for (int k = 0; k < 4; k++)
            most = fmax(most, fabs(alone[k] - shared[k]) / fmax(1e-3, fabs(alone[k])));
        MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        print_message("flow %d: %.3g\n", flow, most);
        assert_close(most, 0.0, 1e-6);
    }
}

static struct fv *start_again(struct fv_case *c, MPI_Comm comm, int flow, struct h5 *f)
{
    struct fv *s = flow_start(c, comm, flow);
    if (f) {
        assert_true(fv_restore(s, f));
        measure(s);
    }
    return s;
}

TEST(restart_is_exact)
{
    for (int flow = 0; flow < FLOWS; flow++)
        assert_int_equal(fv_case_restart(start_again, flow, 4), 0);
}

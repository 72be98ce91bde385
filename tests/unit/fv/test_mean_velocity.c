/* test_mean_velocity.c - momentum of a periodic flow round what a partner gives: what the computed
 * cells have too much goes, whichever cells are imposed. ranks: 1 2 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/coupling/mean_velocity.h"
#include "fv_bc_case.h"

static const double across[2][3] = {{0.25, -1.0, -1.0}, {0.75, 2.0, 2.0}};
static const double inside[2][3] = {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}};

/* Adds 0.01 m/s along each axis to the computed cells at time t, and 1 m/s to imposed ones, which
 * must not count; left: what 60 coupling steps leave of the 0.01 m/s along each axis. */
static void relax(const char *const *overrides, const double (*box)[3], double t, double left[3])
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD, overrides);
    struct fv *s = fv_case_start(&c, NULL);
    DROP(s->forcing);
    s->forcing = mem_own(s, forcing_create(s, 1, (const double(*)[2][3])box, true));
    assert_true(mean_velocity_is_known(s));
    s->t = t;
    double *before[3];
    for (int a = 0; a < s->dim; a++) {
        before[a] = NEW(double, s->size);
        memcpy(before[a], s->u[a], (size_t)s->size * sizeof(double));
        for (int64_t i = 0; i < s->size; i++)
            s->u[a][i] += s->forcing->forced[i] ? 1.0 : 0.01;
    }
    for (int k = 0; k < 60; k++)
        mean_velocity_relax(s);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int a = 0; a < s->dim; a++) {
        FLOW_ROWS (s, at, n)
            for (int64_t i = at; i < at + n; i++) {
                const double more = s->u[a][i] - before[a][i];
                if (s->forcing->forced[i])
                    assert_float_equal(more, 1.0, 1e-15);
                low[a] = s->forcing->forced[i] ? low[a] : fmin(low[a], more);
                high[a] = s->forcing->forced[i] ? high[a] : fmax(high[a], more);
            }
        mem_free(before[a]);
    }
    MPI_Allreduce(MPI_IN_PLACE, low, 3, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, high, 3, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    for (int a = 0; a < s->dim; a++) {
        assert_float_equal(low[a], high[a], 1e-14); /* the same in all of them */
        left[a] = low[a];
    }
    fv_free(&c.s);
}

TEST(what_is_too_much_goes)
{
    double left[3];
    relax((const char *const[]){"fv.cells=(16,24)", "initial.velocity=(0.3,-2)", NULL}, inside, 0.0,
          left);
    assert_true(fabs(left[0]) < 1e-6 && fabs(left[1]) < 1e-6);
    relax((const char *const[]){"domain.dim=3", "initial.field=\"beltrami\"", "fv.cells=(12,12,16)",
                                NULL},
          inside, 0.0, left);
    assert_true(fabs(left[0]) < 1e-6 && fabs(left[1]) < 1e-6 && fabs(left[2]) < 1e-6);
}

/* Across an axis along which each plane of cells holds imposed ones nothing is known. */
TEST(and_stays_where_no_plane_tells)
{
    double left[3];
    relax((const char *const[]){"fv.cells=(16,16)", NULL}, across, 0.0, left);
    assert_true(fabs(left[0]) < 1e-6);
    assert_float_equal(left[1], 0.01, 1e-15);
}

/* A body force drives the mean: 0.01 m/s are missing of what 0.1 m/s^2 give in 0.2 s. */
TEST(a_body_force_drives_it)
{
    double left[3];
    relax((const char *const[]){"fv.cells=(16,16)", "fluid.gravity=(0.1,0)", NULL}, inside, 0.2,
          left);
    assert_float_equal(left[0], 0.02, 1e-6);
    assert_float_equal(left[1], 0.0, 1e-6);
}

TEST(walls_take_momentum)
{
    struct fv_case c;
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){CLOSED, "initial.field=\"rest\"", "fv.cells=(16,16)", NULL});
    wall_add(&c, SIDE_Y_MIN, WALL_NO_SLIP, 0.0);
    assert_false(mean_velocity_is_known(fv_case_start(&c, NULL)));
    fv_free(&c.s);
}

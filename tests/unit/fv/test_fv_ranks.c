/* test_fv_ranks.c - the number of ranks changes nothing but rounding, that of a restart, too; on
 * the same ranks it changes nothing at all. ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_restart.h"

#define TWO_MODES "initial.field=\"two_modes\"", "initial.velocity=(0.5,0.25)"
#define HOLE "fv.hole=((0.3125,0.3125),(0.6875,0.6875))"

enum { SUMS = 4 }; /* energy, largest speed, error, weighted sum of the fields */

static void take_sums(struct fv *s, bool good, double *sums)
{
    double row[FV_CASE_ROW];
    VALUES_OF(fv_row, s, row);
    sums[0] = good ? row[0] : NAN;
    sums[1] = row[1];
    sums[2] = row[3];
    sums[3] = fv_case_weighted(s);
}

static void sums_on(MPI_Comm comm, const char *const *overrides, double *sums)
{
    struct fv_case c;
    fv_case_set(&c, comm, overrides);
    fv_case_start(&c, NULL);
    take_sums(c.s, fv_case_run(&c, 6, 100.0), sums);
    fv_free(&c.s);
}

static void assert_same_sums(const double *a, const double *b)
{
    assert_close(most_apart(SUMS, a, b), 0.0, 1e-9);
}

static void agree(const char *const *overrides)
{
    double alone[SUMS], shared[SUMS];
    sums_on(MPI_COMM_SELF, overrides, alone);
    sums_on(MPI_COMM_WORLD, overrides, shared);
    assert_same_sums(alone, shared);
}

TEST(ranks_agree_in_2d)
{
    agree((const char *const[]){TWO_MODES, NULL});
    agree((const char *const[]){TWO_MODES, "fv.integrator=\"bdf2\"", "fv.cfl=0.5", NULL});
}

TEST(ranks_agree_with_a_hole) { agree((const char *const[]){TWO_MODES, HOLE, NULL}); }

TEST(ranks_agree_with_closed_sides)
{
    agree((const char *const[]){TWO_MODES, "domain.periodic=(false,false)", NULL});
    agree((const char *const[]){TWO_MODES, "domain.periodic=(false,true)", HOLE, NULL});
}

TEST(ranks_agree_in_3d)
{
    agree((const char *const[]){TWO_MODES, "domain.dim=3", "fv.cells=(16,16,12)", NULL});
    agree((const char *const[]){TWO_MODES, "domain.dim=3", "fv.cells=(16,16,12)",
                                "fv.hole=((0.25,0.25,0.25),(0.75,0.75,0.75))", NULL});
}

/* Path of the file of all ranks. */
static void restart_path(char *path, int size)
{
    fv_case_path(".h5", path, (size_t)size);
    MPI_Bcast(path, size, MPI_CHAR, 0, MPI_COMM_WORLD);
}

/* Among them grids that coarsen to odd numbers of cells. */
static struct fv *start_flow(struct fv_case *c, MPI_Comm comm, int flow, struct h5 *f)
{
    static const char *const of[][6] = {{TWO_MODES, HOLE, "fv.cells=(32,32)"},
                                        {TWO_MODES, HOLE, "fv.cells=(26,32)"},
                                        {TWO_MODES, HOLE, "fv.cells=(20,28)"},
                                        {TWO_MODES, "domain.dim=3", "fv.cells=(16,16,16)"},
                                        {TWO_MODES, "domain.dim=3", "fv.cells=(16,16,12)"},
                                        {TWO_MODES, "domain.dim=3", "fv.cells=(14,12,16)"},
                                        {TWO_MODES, "fv.integrator=\"bdf2\"", "fv.cfl=0.5"}};
    fv_case_set(c, comm, of[flow]);
    return fv_case_start(c, f);
}

TEST(restart_is_exact)
{
    for (int flow = 0; flow < 7; flow++)
        assert_int_equal(fv_case_restart(start_flow, flow, 3), 0);
}

/* 3 steps on these ranks and a restart file, then 3 more: their sums. */
static void write_on(MPI_Comm comm, const char *const *overrides, const char *path, double *sums)
{
    struct fv_case c;
    fv_case_set(&c, comm, overrides);
    fv_case_start(&c, NULL);
    bool good = fv_case_run(&c, 3, 100.0);
    struct h5 *f = h5_create_restart(comm, path);
    h5_attribute_real(f, "t", c.run.t);
    fv_checkpoint(c.s, f);
    h5_close(&f);
    good = fv_case_run(&c, 3, 100.0) && good;
    take_sums(c.s, good, sums);
    fv_free(&c.s);
}

static void go_on_on(MPI_Comm comm, const char *const *overrides, const char *path, double *sums)
{
    struct fv_case c;
    fv_case_set(&c, comm, overrides);
    struct h5 *f = h5_open(comm, path);
    assert_non_null(f);
    assert_true(h5_read_attribute_real(f, "t", &c.run.t));
    c.run.step = 3;
    assert_non_null(fv_case_start(&c, f));
    h5_close(&f);
    take_sums(c.s, fv_case_run(&c, 3, 100.0), sums);
    fv_free(&c.s);
}

/* Written by all, read by one, and the other way. */
static void goes_on_on_others(const char *const *overrides)
{
    enum { SIZE = 1024 };
    char path[SIZE];
    int rank;
    double straight[SUMS], restarted[SUMS];
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    restart_path(path, SIZE);
    write_on(MPI_COMM_WORLD, overrides, path, straight);
    go_on_on(MPI_COMM_SELF, overrides, path, restarted);
    assert_same_sums(straight, restarted);
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank == 0)
        write_on(MPI_COMM_SELF, overrides, path, straight);
    MPI_Bcast(straight, SUMS, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    go_on_on(MPI_COMM_WORLD, overrides, path, restarted);
    assert_same_sums(straight, restarted);
    MPI_Barrier(MPI_COMM_WORLD);
    remove(path);
}

TEST(other_ranks_go_on)
{
    goes_on_on_others((const char *const[]){TWO_MODES, HOLE, NULL});
    goes_on_on_others((const char *const[]){TWO_MODES, "domain.periodic=(false,true)", NULL});
    goes_on_on_others(
        (const char *const[]){TWO_MODES, "fv.integrator=\"bdf2\"", "fv.cfl=0.5", NULL});
    goes_on_on_others(
        (const char *const[]){TWO_MODES, "domain.dim=3", "fv.cells=(16,16,12)", NULL});
}

/* A file of another grid says which one. */
TEST(another_grid_is_refused)
{
    enum { SIZE = 1024 };
    char path[SIZE];
    double sums[SUMS];
    struct fv_case c;
    restart_path(path, SIZE);
    write_on(MPI_COMM_WORLD, (const char *const[]){TWO_MODES, NULL}, path, sums);
    fv_case_set(&c, MPI_COMM_SELF, (const char *const[]){TWO_MODES, "fv.cells=(36,32)", NULL});
    struct h5 *f = h5_open(MPI_COMM_SELF, path);
    assert_null(fv_case_start(&c, f));
    h5_close(&f);
    MPI_Barrier(MPI_COMM_WORLD);
    remove(path);
}

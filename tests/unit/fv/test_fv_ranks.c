/* test_fv_ranks.c - the number of ranks changes nothing but rounding, that of a restart, too; on
 * the same ranks it changes nothing at all. ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "fv_case.h"

#define TWO_MODES "initial.field=\"two_modes\"", "initial.velocity=(0.5,0.25)"
#define HOLE "fv.hole=((0.3125,0.3125),(0.6875,0.6875))"

enum { SUMS = 5 }; /* energy, largest speed, error, sums of u and of x-weighted u */

static void take_sums(struct fv *s, bool good, double *sums)
{
    double row[FV_CASE_ROW], x[3];
    fv_row(s, row);
    sums[0] = good ? row[0] : NAN;
    sums[1] = row[1];
    sums[2] = row[3];
    sums[3] = sums[4] = 0.0;
    BLOCK_CELLS (&s->b, i, j, k, at) {
        block_centre(&s->b, i, j, k, x);
        sums[3] += s->u[0][at];
        sums[4] += sin(7.0 * x[0] + 5.0 * x[1] + 3.0 * x[2]) * s->u[0][at] + x[0] * s->u[1][at];
    }
    MPI_Allreduce(MPI_IN_PLACE, sums + 3, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
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

static void goes_on_bit_for_bit(const char *const *overrides)
{
    enum { SIZE = 1024 };
    struct fv_case one, two;
    char path[SIZE];
    int64_t differ = 0;
    restart_path(path, SIZE);
    fv_case_set(&one, MPI_COMM_WORLD, overrides);
    fv_case_start(&one, NULL);
    assert_true(fv_case_run(&one, 3, 100.0));
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    fv_checkpoint(one.s, f);
    h5_close(&f);
    fv_case_set(&two, MPI_COMM_WORLD, overrides);
    two.run.t = one.run.t;
    two.run.step = one.run.step;
    f = h5_open(MPI_COMM_WORLD, path);
    assert_non_null(f);
    assert_non_null(fv_case_start(&two, f));
    h5_close(&f);
    assert_true(fv_case_run(&one, 3, 100.0) && fv_case_run(&two, 3, 100.0));
    for (int a = 0; a < one.s->b.dim; a++)
        BLOCK_ROWS (&one.s->b, 0, at, n)
            for (int64_t i = at; i < at + n; i++) {
                differ += one.s->u[a][i] != two.s->u[a][i] || one.s->U[a][i] != two.s->U[a][i];
                differ += fv_pressure(one.s, i) != fv_pressure(two.s, i);
            }
    assert_int_equal(ranks_count(MPI_COMM_WORLD, differ), 0);
    assert_true(one.s->t == two.s->t);
    fv_free(&one.s);
    fv_free(&two.s);
    MPI_Barrier(MPI_COMM_WORLD);
    remove(path);
}

/* Among them grids that coarsen to odd numbers of cells. */
TEST(restart_is_exact)
{
    static const char *const flat[] = {"fv.cells=(32,32)", "fv.cells=(26,32)", "fv.cells=(20,28)"};
    static const char *const solid[] = {"fv.cells=(16,16,16)", "fv.cells=(16,16,12)",
                                        "fv.cells=(14,12,16)"};
    for (int k = 0; k < 3; k++) {
        goes_on_bit_for_bit((const char *const[]){TWO_MODES, HOLE, flat[k], NULL});
        goes_on_bit_for_bit((const char *const[]){TWO_MODES, "domain.dim=3", solid[k], NULL});
    }
    goes_on_bit_for_bit(
        (const char *const[]){TWO_MODES, "fv.integrator=\"bdf2\"", "fv.cfl=0.5", NULL});
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

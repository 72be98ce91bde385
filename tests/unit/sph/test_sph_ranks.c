/* test_sph_ranks.c - the number of ranks changes nothing but rounding, that of a restart, too.
 * ranks: 1 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <unistd.h>

#include "../../../sph/open_boundaries/openings.h"
#include "../../../sph/open_boundaries/zones.h"
#include "../../../sph/output/sph_output.h"
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
    DROP(c.s);
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
    FREE(alone, shared);
}

TEST(ranks_agree_in_2d) { agree(2, 30, 8); }

TEST(ranks_agree_in_3d) { agree(3, 12, 4); }

static void set_open(struct sph_case *c, MPI_Comm comm)
{
    sph_case_set(c, 2, 40);
    c->run.comm = comm;
    MPI_Comm_rank(comm, &c->run.rank);
    MPI_Comm_size(comm, &c->run.size);
    c->run.scene.domain.periodic[0] = c->run.scene.domain.periodic[1] = false;
    c->run.scene.domain.min[0] = c->run.scene.domain.min[1] = 0.1;
    c->run.scene.domain.max[0] = c->run.scene.domain.max[1] = 0.9;
    c->prm.outer = OUTER_EXACT;
}

/* Births are numbered by face, so sums over all particles must agree; order of births may not
 * matter. */
static void zone_sums(MPI_Comm comm, double *sums)
{
    struct sph_case c;
    set_open(&c, comm);
    sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, SANITIZED ? 10 : 40, 100.0));
    sph_sums(c.s, sums);
    DROP(c.s);
}

TEST(ranks_agree_with_open_sides)
{
    double alone[SUM_COUNT], shared[SUM_COUNT];
    zone_sums(MPI_COMM_SELF, alone);
    zone_sums(MPI_COMM_WORLD, shared);
    for (int k = 0; k < SUM_COUNT; k++)
        assert_true(fabs(alone[k] - shared[k]) < 1e-8);
}

/* What a restart must keep over all ranks: sums of the flow, of the faces, of the counts. */
enum { KEPT = SUM_COUNT + 5 };

static void take_sums(struct sph_case *c, double *sums)
{
    const struct openings *o = c->s->zones ? c->s->zones->openings : NULL;
    double counts[4] = {c->s->total.lost, o ? (double)o->born : 0.0, o ? (double)o->gone : 0.0};
    for (int side = 0; o && side < 6; side++)
        counts[3] += o->through[side];
    sph_sums(c->s, sums);
    MPI_Allreduce(MPI_IN_PLACE, counts, 4, MPI_DOUBLE, MPI_SUM, c->run.comm);
    memcpy(sums + SUM_COUNT, counts, sizeof counts);
    sums[KEPT - 1] = o ? openings_held(c->s) : 0.0;
}

static void set(struct sph_case *c, MPI_Comm comm, int dim)
{
    if (dim == 0) {
        set_open(c, comm);
        return;
    }
    sph_case_set(c, dim, dim == 2 ? 30 : 12);
    c->run.comm = comm;
    MPI_Comm_rank(comm, &c->run.rank);
    MPI_Comm_size(comm, &c->run.size);
    c->prm.noise = 0.1;
}

/* Steps on these ranks and a restart file, then as many: their sums. */
static void write_on(MPI_Comm comm, int dim, int steps, const char *path, double *sums)
{
    struct sph_case c;
    set(&c, comm, dim);
    sph_case_start(&c, NULL);
    assert_true(sph_case_run(&c, steps, 100.0));
    c.s->total.lost = c.run.rank + 1.0; /* as if some had been */
    struct h5 *f = h5_create_restart(comm, path);
    h5_attribute_real(f, "t", c.run.t);
    sph_checkpoint(c.s, f);
    h5_close(&f);
    assert_true(sph_case_run(&c, steps, 100.0));
    take_sums(&c, sums);
    DROP(c.s);
}

static void go_on_on(MPI_Comm comm, int dim, int steps, const char *path, double *sums)
{
    struct sph_case c;
    set(&c, comm, dim);
    struct h5 *f = h5_open(comm, path);
    assert_non_null(f);
    assert_true(h5_read_attribute_real(f, "t", &c.run.t));
    c.run.step = steps;
    assert_non_null(sph_case_start(&c, f));
    h5_close(&f);
    assert_true(sph_case_run(&c, steps, 100.0));
    take_sums(&c, sums);
    DROP(c.s);
}

static void goes_on_on_others(int dim, int steps)
{
    char path[1024];
    int rank;
    double straight[KEPT], restarted[KEPT];
    const char *dir = getenv("TEST_SCRATCH");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    snprintf(path, sizeof path, "%s/sph_ranks_%d.h5", dir ? dir : P_tmpdir, (int)getpid());
    MPI_Bcast(path, sizeof path, MPI_CHAR, 0, MPI_COMM_WORLD);
    write_on(MPI_COMM_WORLD, dim, steps, path, straight);
    go_on_on(MPI_COMM_SELF, dim, steps, path, restarted);
    assert_true(most_apart(KEPT, straight, restarted) < 1e-9);
    if (is_alone()) {
        remove(path);
        return;
    }
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank == 0)
        write_on(MPI_COMM_SELF, dim, steps, path, straight);
    MPI_Bcast(straight, KEPT, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    go_on_on(MPI_COMM_WORLD, dim, steps, path, restarted);
    assert_true(most_apart(KEPT, straight, restarted) < 1e-9);
    MPI_Barrier(MPI_COMM_WORLD);
    remove(path);
}

/* Written by all, read by one, and the other way. */
TEST(other_ranks_go_on)
{
    if (SANITIZED) /* one rank: restart_is_exact of the walls runs the same lines */
        skip();
    goes_on_on_others(2, 8);
    goes_on_on_others(3, 3);
}

TEST(other_ranks_go_on_with_open_sides) { goes_on_on_others(0, SANITIZED ? 4 : 20); }

/* sph_restart.h - runs that go on from their own restart files beside runs in one piece.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "sph_case.h"

#include "../../../sph/output/sph_output.h"

/* Writes a restart file, ends the run and makes it again from that file. Collective. */
static inline void sph_case_restart(struct sph_case *c)
{
    char path[512];
    const char *dir = getenv("TEST_SCRATCH");
    snprintf(path, sizeof path, "%s/sph_case_restart.h5", dir ? dir : "/tmp");
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    sph_checkpoint(c->s, f);
    h5_close(&f);
    DROP(c->s);
    f = h5_open(MPI_COMM_WORLD, path);
    assert_non_null(f);
    sph_case_start(c, f);
    h5_close(&f);
    assert_non_null(c->s);
}

/* Ends the run; the state of its locals, [*n], owned by the caller (mem_free). */
static inline double *sph_case_end_state(struct sph_case *c, int *n)
{
    *n = c->s->p.n * c->s->p.nstate;
    double *y = NEW(double, *n);
    memcpy(y, c->s->p.y, (size_t)*n * sizeof(double));
    DROP(c->s);
    return y;
}

/* A started run of 12 steps, in one piece or with a restart in the middle; ends it as above. */
static inline double *sph_case_twelve(struct sph_case *c, bool restart, int *n)
{
    assert_true(sph_case_run(c, 6, 100.0));
    if (restart)
        sph_case_restart(c);
    assert_true(sph_case_run(c, 6, 100.0));
    return sph_case_end_state(c, n);
}

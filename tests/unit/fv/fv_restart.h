/* fv_restart.h - a run that goes on from its restart file beside the run that wrote it.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "fv_case.h"

#include "../../../fv/surface/levelset.h"
#include "../../../fv/time/newton.h"

/* Starts the flow of this number, from a restart file if f is not NULL. */
typedef struct fv *(*fv_case_starter)(struct fv_case *c, MPI_Comm comm, int flow, struct h5 *f);

/* Values of the two states that are not the same, on all ranks. */
static inline int64_t fv_case_differences(const struct fv *one, const struct fv *two)
{
    int64_t differ = one->t != two->t;
    differ += one->newton && one->newton->dtau != two->newton->dtau;
    FLOW_ROWS (one, at, n)
        for (int64_t i = at; i < at + n; i++) {
            for (int a = 0; a < one->dim; a++)
                differ += one->u[a][i] != two->u[a][i] || one->U[a][i] != two->U[a][i];
            differ += one->p[i] != two->p[i];
            differ += one->surface && one->surface->phi[i] != two->surface->phi[i];
        }
    return ranks_count(MPI_COMM_WORLD, differ);
}

/* A flow of so many steps, its restart file, and as many more steps of both: values that differ;
 * -1: a run stopped. Collective. */
static inline int64_t fv_case_restart(fv_case_starter start, int flow, int steps)
{
    enum { SIZE = 1024 };
    struct fv_case one, two;
    char path[SIZE];
    fv_case_path(".h5", path, SIZE);
    MPI_Bcast(path, SIZE, MPI_CHAR, 0, MPI_COMM_WORLD);
    start(&one, MPI_COMM_WORLD, flow, NULL);
    bool good = fv_case_run(&one, steps, 100.0);
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    fv_checkpoint(one.s, f);
    h5_close(&f);
    f = h5_open(MPI_COMM_WORLD, path);
    start(&two, MPI_COMM_WORLD, flow, f);
    h5_close(&f);
    two.s->t = one.s->t; /* which the program takes from the file */
    good = fv_case_run(&one, steps, 100.0) && good;
    good = fv_case_run(&two, steps, 100.0) && good;
    const int64_t differ = good ? fv_case_differences(one.s, two.s) : -1;
    fv_free(&one.s);
    fv_free(&two.s);
    MPI_Barrier(MPI_COMM_WORLD);
    remove(path);
    return differ;
}

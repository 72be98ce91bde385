/* ranks.h - one number of each rank to one number of all. Every call is collective over comm and
 * returns the same on all of its ranks, in the unit of what it was given.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>
#include <stdint.h>

/* The sum over the ranks. Its last bits depend on how many ranks there are. */
static inline double ranks_sum(MPI_Comm comm, double v)
{
    MPI_Allreduce(MPI_IN_PLACE, &v, 1, MPI_DOUBLE, MPI_SUM, comm);
    return v;
}

/* The largest of the ranks' numbers; what a NaN among them gives is left open by MPI. */
static inline double ranks_max(MPI_Comm comm, double v)
{
    MPI_Allreduce(MPI_IN_PLACE, &v, 1, MPI_DOUBLE, MPI_MAX, comm);
    return v;
}

/* The smallest of them, likewise. */
static inline double ranks_min(MPI_Comm comm, double v)
{
    MPI_Allreduce(MPI_IN_PLACE, &v, 1, MPI_DOUBLE, MPI_MIN, comm);
    return v;
}

/* The sum of counts, exact. */
static inline int64_t ranks_count(MPI_Comm comm, int64_t n)
{
    MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT64_T, MPI_SUM, comm);
    return n;
}

/* Whether it holds on at least one rank. */
static inline bool ranks_any(MPI_Comm comm, bool holds)
{
    MPI_Allreduce(MPI_IN_PLACE, &holds, 1, MPI_C_BOOL, MPI_LOR, comm);
    return holds;
}

/* Whether it holds on every rank. */
static inline bool ranks_all(MPI_Comm comm, bool holds)
{
    MPI_Allreduce(MPI_IN_PLACE, &holds, 1, MPI_C_BOOL, MPI_LAND, comm);
    return holds;
}

/* Whether some rank has it; then all get the `bytes' at `what' of the lowest that has. */
static inline bool ranks_first(MPI_Comm comm, bool has, void *what, int bytes)
{
    int first, size;
    MPI_Comm_rank(comm, &first);
    MPI_Comm_size(comm, &size);
    first = has ? first : size;
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm);
    if (first < size)
        MPI_Bcast(what, bytes, MPI_BYTE, first, comm);
    return first < size;
}

/* The largest of the ranks' numbers; all get the `bytes' at `what' of the lowest rank with it. */
static inline double ranks_most(MPI_Comm comm, double v, void *what, int bytes)
{
    const double most = ranks_max(comm, v);
    (void)ranks_first(comm, v == most, what, bytes);
    return most;
}

/* lattice.c - see lattice.h. SPDX-License-Identifier: BSD-3-Clause */
#include "lattice.h"

int64_t lattice_cells(const struct lattice *l) { return (int64_t)l->n[0] * l->n[1] * l->n[2]; }

void lattice_indices(const struct lattice *l, int64_t cell, int *ic)
{
    ic[0] = (int)(cell % l->n[0]);
    ic[1] = (int)(cell / l->n[0] % l->n[1]);
    ic[2] = (int)(cell / l->n[0] / l->n[1]);
}

int64_t lattice_cell(const struct lattice *l, const int *ic)
{
    return ic[0] + l->n[0] * (ic[1] + l->n[1] * (int64_t)ic[2]);
}

void lattice_centre(const struct lattice *l, const int *ic, int dim, double *x)
{
    for (int a = 0; a < 3; a++)
        x[a] = a < dim ? l->origin[a] + (ic[a] + 0.5) * l->dx : 0.0;
}

void lattice_place(const struct lattice *l, int64_t cell, int dim, double *x)
{
    int ic[3];
    lattice_indices(l, cell, ic);
    lattice_centre(l, ic, dim, x);
}

int64_t lattice_find(const struct lattice *l, int dim, const double *x)
{
    int ic[3] = {0, 0, 0};
    for (int a = 0; a < dim; a++) {
        const double at = floor((x[a] - l->origin[a]) / l->dx);
        if (!(at >= 0.0 && at < l->n[a]))
            return -1;
        ic[a] = (int)at;
    }
    return lattice_cell(l, ic);
}

bool lattice_next(const struct lattice *l, const int *ic, int axis, const bool *periodic, int *jc)
{
    memcpy(jc, ic, 3 * sizeof *jc);
    if (++jc[axis] < l->n[axis])
        return true;
    jc[axis] = 0;
    return periodic[axis] && l->n[axis] > 1;
}

/* In pieces, since MPI counts in int. */
void lattice_share(const struct lattice *l, unsigned char *bits, MPI_Comm comm)
{
    const int64_t bytes = lattice_cells(l) / 8 + 1, chunk = (int64_t)1 << 30;
    for (int64_t at = 0; at < bytes; at += chunk)
        MPI_Allreduce(MPI_IN_PLACE, bits + at, (int)(bytes - at < chunk ? bytes - at : chunk),
                      MPI_UNSIGNED_CHAR, MPI_BOR, comm);
}

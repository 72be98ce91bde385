/* lattice.h - the cells of the first particles: which are filled, and between which neighbours a
 * wall stands.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../sph.h"

/* Cells of edge dx; cell (i, j, k) has the number i + n[0] (j + n[1] k). Bit arrays are owned and
 * hold the cells of all ranks on every rank. */
struct lattice {
    int n[3];
    double origin[3], dx; /* m: lower corner of the first cell */
    unsigned char *bits;  /* of all ranks: one a cell */
    /* One a cell: a mesh parts it from the next along the axis; NULL: none. */
    unsigned char *cut[3];
};

/* Number of cells; indices of a cell, and the number of a cell with given indices. */
int64_t lattice_cells(const struct lattice *l);
void lattice_indices(const struct lattice *l, int64_t cell, int *ic);
int64_t lattice_cell(const struct lattice *l, const int *ic);
/* Centre, m, of cell ic, which may lie beside the lattice; lattice_place: of a cell by its
 * number. */
void lattice_centre(const struct lattice *l, const int *ic, int dim, double *x);
void lattice_place(const struct lattice *l, int64_t cell, int dim, double *x);
/* Number of the cell that holds x; -1: there is none. */
int64_t lattice_find(const struct lattice *l, int dim, const double *x);
/* Indices jc of the cell next to ic along an axis, wrapped where it is periodic; false: the lattice
 * ends here. */
bool lattice_next(const struct lattice *l, const int *ic, int axis, const bool *periodic, int *jc);
/* Combines the bits of all ranks (or). Collective over comm. */
void lattice_share(const struct lattice *l, unsigned char *bits, MPI_Comm comm);

static inline bool lattice_bit(const unsigned char *bits, int64_t cell)
{
    return bits[cell >> 3] >> (cell & 7) & 1;
}
static inline void lattice_set(unsigned char *bits, int64_t cell)
{
    bits[cell >> 3] |= (unsigned char)(1 << (cell & 7));
}
static inline void lattice_clear(unsigned char *bits, int64_t cell)
{
    bits[cell >> 3] &= (unsigned char)~(1 << (cell & 7));
}
static inline bool lattice_has(const struct lattice *l, int64_t cell)
{
    return lattice_bit(l->bits, cell);
}
/* Whether a mesh parts a cell from the next one along an axis. */
static inline bool lattice_is_cut(const struct lattice *l, int64_t cell, int axis)
{
    return l->cut[axis] && lattice_bit(l->cut[axis], cell);
}

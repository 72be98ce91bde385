/* basins.h - which waters of the first lattice belong together, and the level that each of its
 * columns stands under. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BASINS_H
#define SPH_BASINS_H

#include "sph.h"

/* Cells of side dx, filled or not; cell (i, j, k) has the number i + n[0] (j + n[1] k). */
struct lattice {
    int n[3];
    double origin[3], dx; /* m: lower corner of the first cell */
    unsigned char *bits;  /* of all ranks: one a cell */
};

int64_t lattice_cells(const struct lattice *l);
void lattice_place(const struct lattice *l, int64_t cell, int dim, double *x);
static inline bool lattice_has(const struct lattice *l, int64_t cell)
{
    return l->bits[cell >> 3] >> (cell & 7) & 1;
}

struct basins;
/* Of the filled cells; the same on all ranks. l is borrowed. Needs s->walls. */
struct basins *basins_create(const struct sph *s, const struct lattice *l);
void basins_free(struct basins **b);
/* Takes from the lattice the pockets that walls cut off, too small to flow. */
void basins_clear(const struct basins *b, struct lattice *l);
int basins_pockets(const struct basins *b, int64_t *cells, double *where); /* one place, m */
/* Height against gravity where p = 0 for the water of this cell, m; NAN: it falls freely. */
double basins_level(const struct basins *b, int64_t cell);

#endif

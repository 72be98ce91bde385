/* neighbours.h - cells of edge >= R + skin, particles sorted by cell rows, list of pairs.
 * The list of i holds all j /= i (locals and ghosts) within R + skin, ascending in j, so that the
 * part with j > i is its tail. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_NEIGHBOURS_H
#define SPH_NEIGHBOURS_H

#include "sph.h"

struct neighbours {
    int n;            /* rows: locals */
    int64_t capacity; /* of j */
    int64_t
        *start; /* [n+1] first of row i in j; rows are padded to a multiple of the vector width */
    int *count; /* [n] entries of row i without padding */
    int *tail;  /* [n] first entry of row i with j > i */
    int *j;     /* padded with the dummy row (s->p.capacity) */
    int rows_capacity;
    double *sums; /* rates of locals, ghosts and dummy while the symmetric pass runs */
    int64_t sums_capacity;
    void *scratch; /* cells and orders, owned */
};

struct neighbours *neighbours_create(void);
void neighbours_free(struct neighbours **l);
/* Sorts the locals by cell (stable), state, id and zone; before the halo is made. */
void neighbours_sort(struct sph *s);
/* Builds the list from prim positions of locals and ghosts with radius R + s->skin. */
void neighbours_build(struct sph *s);
/* Ordered pairs within R now; for the throughput figures. */
int64_t neighbours_pairs(const struct sph *s);

#endif

/* neighbours.h - cells of edge R + skin, particles sorted by cell rows, list of pairs.
 * The list of i holds all j /= i (locals and ghosts) within R + skin: locals ascending, then
 * ghosts, so that the part with j > i is its tail. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_NEIGHBOURS_H
#define SPH_NEIGHBOURS_H

#include "sph.h"

struct grid; /* cells of the locals at hand */

struct neighbours {
    int n;            /* rows: locals */
    int64_t capacity; /* of j */
    int64_t *start;   /* [n+1] first of row i in j */
    int *count; /* [n] entries of row i; behind them as many dummy rows (s->p.capacity) as a vector
                   that begins at any entry can reach */
    int *tail;  /* [n] first entry of row i with j > i */
    int *j;
    int *order;     /* [n] rows, those first whose lists hold locals only; on one rank, where ghosts
                       are at hand at once, as they are stored */
    int ninner;     /* how many come first; 0 on one rank */
    int begin, end; /* places in order that a pass treats: neighbours_rows */
    int rows_capacity;
    struct grid *grid;
    double *sums; /* what a symmetric pass has for each line */
    size_t sums_capacity;
};

struct neighbours *neighbours_create(void);
void neighbours_free(struct neighbours **l);
/* Sorts the locals by cell (stable), state, id and zone; before the halo is made. */
void neighbours_sort(struct sph *s);
/* Builds the list from prim positions of locals and ghosts with radius R + s->skin. */
void neighbours_build(struct sph *s);
/* Which rows the next passes treat: all (after neighbours_build), or inner ones while ghosts are
 * under way, then the outer ones. */
enum rows { ROWS_ALL, ROWS_INNER, ROWS_OUTER };
void neighbours_rows(struct neighbours *l, enum rows which);
/* [capacity + 1][width]: sums of a symmetric pass, one row for each line; zeros before the first
 * row. Borrowed until the next pass. */
double *neighbours_sums(struct sph *s, int width);
/* Ordered pairs within R now; for the throughput figures. */
int64_t neighbours_pairs(const struct sph *s);

#endif

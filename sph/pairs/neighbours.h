/* neighbours.h - cells of edge R + skin, particles sorted by cell rows, list of pairs.
 * The list of i holds all j /= i (locals and ghosts) that come within R in the step: locals
 * ascending, then ghosts, so that the part with j > i is its tail.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_NEIGHBOURS_H
#define SPH_NEIGHBOURS_H

#include "../sph.h"

struct list_grid; /* cells of the locals at hand */

struct neighbours {
    int n;            /* rows: locals */
    int64_t capacity; /* of j */
    int64_t *start;   /* [n+1] first of row i in j */
    int *count; /* [n] entries of row i; behind them as many dummy rows (s->p.capacity) as a vector
                   that begins at any entry can reach */
    int *tail;  /* [n] first entry of row i with j > i */
    int *j;
    unsigned char *whole; /* [n] so many neighbours that nothing of the support can be missing */
    int *order; /* [n] rows, those first whose lists hold locals only, those last that are deep
                   (ROLE_DEEP); NULL: as they are stored, on one rank, where ghosts are at hand at
                   once, and without deep ones */
    int order_capacity;
    int ninner;   /* how many come first; 0 on one rank */
    int nshallow; /* rows but for the deep ones */
    int treated;  /* rows that passes go through: all until slopes are known, then shallow ones */
    double touching; /* m: pairs that may come this near in the step are close; 0: none */
    int *taken; /* [n] entries of the lists from which guards take their fields; NULL: no levels */
    int taken_capacity;
    int nclose, close_capacity;
    int (*close)[2];  /* pairs i < j that may collide in the step; collisions.h */
    int begin, end;   /* places in order that a pass treats: neighbours_rows */
    bool first, last; /* part of the pass: sums begin with zeros; they are whole after it */
    int rows_capacity;
    struct list_grid *grid;
};

struct neighbours *neighbours_create(void);
void neighbours_free(struct neighbours **l);
/* Sorts the locals by cell (stable), state, id and zone; before the halo is made. */
void neighbours_sort(struct sph *s);
/* Builds the list from prim of locals and ghosts: pairs within R and what they can move towards
 * each other in a step of dt_most, at most s->lists.skin. */
void neighbours_build(struct sph *s);
/* Which rows the next passes treat: all (after neighbours_build), or inner ones while ghosts are
 * under way, then the outer ones. */
static inline int neighbours_row(const struct neighbours *l, int k)
{
    return l->order ? l->order[k] : k;
}
enum rows { ROWS_ALL, ROWS_INNER, ROWS_OUTER };
void neighbours_rows(struct neighbours *l, enum rows which);
/* [capacity + 1][width]: sums of a symmetric pass, one row for each line, width nstate at most;
 * zeros before the first row. They lie where s->p.rate will be written. */
double *neighbours_sums(struct sph *s, int width);
/* Gathers the locals and ghosts without any of the bits `without' of enum sph_role (ROLE_GUARD:
 * those that flow) within reach of the box from lo to hi, for neighbours_pick; ghost_role: bits of
 * the ghosts. After neighbours_build. */
void neighbours_gather(const struct sph *s, const double *lo, const double *hi, double reach,
                       const unsigned short *ghost_role, int without);
/* Numbers of those gathered last within reach of x; found is grown (its room: *capacity, at least
 * LANES more than there are), n are there already; returns their new number. */
int neighbours_pick(const struct sph *s, const double *x, double reach, int n, int **found,
                    int *capacity);
/* Least distance of a listed pair, R at most; of this rank. */
double neighbours_least(const struct sph *s);
/* Ordered pairs within R now; for the throughput figures. */
int64_t neighbours_pairs(const struct sph *s);

#endif

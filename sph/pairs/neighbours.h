/* neighbours.h - cell grid, particles sorted by cell, and the list of pairs. The list of particle
 * i, its row, holds all j /= i (locals and ghosts) that can come within R in the step: locals in
 * ascending order, then ghosts, so that the part with j > i is its tail. It is made once a step and
 * serves all its stages. (neighbours_spare alone breaks the order, in rows of idle guards.)
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_NEIGHBOURS_H
#define SPH_NEIGHBOURS_H

#include "../sph.h"

struct list_grid; /* cells of the locals at hand */

/* The list. Rows are padded with the dummy record (s->p.capacity) to a multiple of the vector
 * width. */
struct neighbours {
    int n;            /* rows: locals */
    int64_t capacity; /* of j */
    int64_t *start;   /* [n+1] first of row i in j */
    /* [n] entries of row i; as many dummies follow as a vector that begins at any entry can
     * reach. */
    int *count;
    int *tail; /* [n] first entry of row i with j > i */
    /* [n] end of the entries of row i that matter to somebody's rates; `count' until
     * neighbours_spare */
    int *busy;
    bool spared; /* neighbours_spare has been called */
    int *j;
    unsigned char *whole; /* [n] so many neighbours that nothing of the support can be missing */
    bool *beside;         /* [n] normal flux walls may cut the support; false until these say so */
    /* [n] rows in the order in which passes treat them: those whose lists hold locals only, the
     * others, the deep ones (ROLE_DEEP). NULL: as they are stored; so it is on one rank, where
     * ghosts need no wait, without deep rows. */
    int *order;
    int ninner;   /* rows that need no ghosts and come first in order; 0 on one rank */
    int nshallow; /* rows but for the deep ones */
    int treated;  /* rows that passes go through: all until slopes are known, then without the deep
                     ones */
    double touching; /* m: pairs that may come this near in the step are put into close; 0: none */
    int *taken; /* [n] entries of the lists from which guards take their fields; NULL: no levels */
    int nclose;
    int (*close)[2];  /* pairs i < j that may collide in the step; collisions.h */
    int begin, end;   /* range of order that a pass treats, set by neighbours_rows */
    bool first, last; /* part of the pass: sums begin with zeros; they are whole after it */
    struct list_grid *grid;
};

/* An empty list, owned by the caller. */
struct neighbours *neighbours_create(void);
/* Sorts the locals by cell (stable): state, id, zone, role and size. To be called before ghosts are
 * made. */
void neighbours_sort(struct sph *s);
/* Builds the list from prim of locals and ghosts: pairs within R + s->lists.skin. The skin covers
 * the distance by which two particles can approach each other in the step. */
void neighbours_build(struct sph *s);
/* The k-th row in the order of treatment. */
static inline int neighbours_row(const struct neighbours *l, int k)
{
    return l->order ? l->order[k] : k;
}
/* Leaves out of the passes for rates the pairs of those whose rates nobody reads, idle[n], with
 * each other and with ghosts: they go behind the others of their rows. Until the next
 * neighbours_build. */
void neighbours_spare(struct sph *s, const bool *idle);
/* Which rows the next passes treat: all (as after neighbours_build), or the inner ones while ghosts
 * are under way and then the others. */
enum rows { ROWS_ALL, ROWS_INNER, ROWS_OUTER };
void neighbours_rows(struct neighbours *l, enum rows which);
/* Zeroed sums of a symmetric pass, [capacity + 1][width], one record for each particle and ghost,
 * width at most nstate. They lie where s->p.rate will be written. */
double *neighbours_sums(struct sph *s, int width);
/* Gathers the locals and ghosts within `reach', m, of the box from lo to hi that have none of the
 * bits `without' of enum sph_role (ROLE_GUARD: those that flow), for neighbours_pick;
 * ghost_role[nhalo]: bits of the ghosts. After neighbours_build. */
void neighbours_gather(const struct sph *s, const double *lo, const double *hi, double reach,
                       const unsigned short *ghost_role, int without);
/* Appends to *found those gathered last within `reach' of x. n are there already; *found is given
 * room, of `owner', for LANES more than the new number, which is returned. */
int neighbours_pick(const struct sph *s, const double *x, double reach, int n, int **found,
                    void *owner);
/* Room for n rows. */
void neighbours_room(struct neighbours *l, int n);
/* Smallest distance of a listed pair, m, at most R; of this rank. */
double neighbours_least(const struct sph *s);
/* Number of ordered pairs within R now, for the throughput figures; of this rank. */
int64_t neighbours_pairs(const struct sph *s);

#endif

/* pfmg.h - one cycle of hypre's PFMG over boxes of cells that lie in one index space: 5 points (3D:
 * 7) on all levels. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PFMG_H
#define FV_PFMG_H

#include <mpi.h>
#include <stdbool.h>

struct pfmg_grid {
    MPI_Comm comm;
    int dim;
    int cells[3];     /* of all boxes along each axis */
    bool periodic[3]; /* over these cells */
    double h[3];      /* m: mean spacings */
    bool uneven;      /* spacings vary */
    int nboxes;       /* of this rank */
    int (*lo)[3];     /* first cells; borrowed until pfmg_create returns, as hi */
    int (*hi)[3];     /* last cells, hypre's way: inside */
};

struct pfmg *pfmg_create(const struct pfmg_grid *g);
void pfmg_free(struct pfmg **p);
/* Rows of each box, x fastest: diagonal, then the lower and the upper neighbour along each axis. */
void pfmg_set_matrix(struct pfmg *p, double *const *rows);
/* Right side and result of the cycle in a box: r, x are fields over the indices outer[0] to
 * outer[1], both inside. */
void pfmg_put(struct pfmg *p, int box, int outer[2][3], double *r);
void pfmg_get(struct pfmg *p, int box, int outer[2][3], double *x);
/* The result of one cycle from zero: a linear map of the right side. */
void pfmg_cycle(struct pfmg *p);

#endif

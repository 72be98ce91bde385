/* pfmg.h - one cycle of hypre's multigrid PFMG over boxes of cells in one index space: 5-point
 * stencils (3D: 7) on all levels.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>

/* The boxes of this rank in the index space. */
struct pfmg_grid {
    MPI_Comm comm;
    int dim;
    int cells[3];     /* of all boxes along each axis */
    bool periodic[3]; /* over these cells */
    double h[3];      /* m: mean spacings */
    bool uneven;      /* spacings vary */
    int nboxes;       /* of this rank */
    int (*lo)[3];     /* [nboxes] first cells; borrowed until pfmg_create returns, as hi */
    int (*hi)[3];     /* [nboxes] last cells, included, as hypre wants it */
};

/* Owned by the caller (FREE). Collective over g->comm, as all here. */
struct pfmg *pfmg_create(const struct pfmg_grid *g);
/* Sets the matrix: rows[box] has for each cell, x fastest, the diagonal, then the lower and the
 * upper neighbour along each axis. */
void pfmg_set_matrix(struct pfmg *p, double *const *rows);
/* Copies the right-hand side of a box in, and the result out: r and x are fields over the indices
 * outer[0] to outer[1], both included. */
void pfmg_put(struct pfmg *p, int box, int outer[2][3], double *r);
void pfmg_get(struct pfmg *p, int box, int outer[2][3], double *x);
/* Computes one cycle from a zero start: a linear map of the right-hand side. */
void pfmg_cycle(struct pfmg *p);

/* mesh_output.h - places and values on blocks.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_OUTPUT_H
#define FV_MESH_OUTPUT_H

#include "../fv.h"
#include "../grid/fv_grid.h"

/* mesh_errors.c: this rank's share of the value at a place, of the finest block there; q NULL:
 * pressure. width 2: linear, 4: cubic from averages, 0: that where it can, else linear. */
double mesh_value_at(const struct fv *s, const struct overset *o, const double *x, int width,
                     const double *q);
/* The same of the distance to the surface, linear in what it is more than the height. */
double mesh_phi_at(const struct fv *s, const struct overset *o, const double *x);

/* mesh_errors.c */
void mesh_describe(const struct run *r, const struct fv_params *prm);
/* Places of blocks that move, x y [z] of the centre, the angle or the rotation vector: number of
 * columns and their (static) names; values, as many. */
int mesh_place_columns(const struct run *r, const struct fv_params *prm, const char **columns);
int mesh_places(const struct fv *s, double *values);
/* What the summary has of blocks alone. */
void mesh_summarise(struct fv *s);
/* Whether a later block computes the place of a cell of `block', too. */
bool mesh_counts_twice(const struct fv *s, const struct overset *o, int block, const double *x);

#endif

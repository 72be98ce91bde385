/* mesh_output.h - errors, forces and gauges on blocks.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_MESH_OUTPUT_H
#define FV_MESH_OUTPUT_H

#include "../fv.h"
#include "../grid/mesh.h"

/* mesh_errors.c: this rank's share of the value at a place, of the finest block there; q NULL:
 * pressure. width 2: linear, 4: cubic from averages, 0: that where it can, else linear. */
double mesh_value_at(const struct fv *s, const struct overset *o, const double *x, int width,
                     const double *q);
/* fv_lines.c: extrema on the centre lines of the domain into the summary. */
void mesh_summarise_extrema(const struct fv *s);

/* mesh_errors.c */
void mesh_describe(const struct run *r);
/* Sums over this rank's cells outside of the partner's part, see fv_tell; where
 * blocks overlap those of the latest one count. */
void mesh_sums(struct fv *s, double sum[5]);

#endif

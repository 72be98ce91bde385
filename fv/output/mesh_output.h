/* mesh_output.h - what outputs have of blocks beyond those of uniform cells: values at points,
 * positions of blocks that move, the mesh in words and in the summary.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../fv.h"
#include "../grid/fv_grid.h"

/* block_samples.c: this rank's share of the value at a place, of the finest block there; q NULL:
 * pressure. width 2: linear, 4: cubic from averages, 0: that where it can, else linear. */
double mesh_value_at(const struct fv *s, const struct overset *o, const double *x, int width,
                     const double *q);
/* The same of the distance to the surface, linear in what it is more than the height. */
double mesh_phi_at(const struct fv *s, const struct overset *o, const double *x);
/* Cells of this rank and their weights in the values at many places, linear under a surface: of
 * place k from first[k] to first[k + 1]. */
struct block_samples {
    int n, *first;
    int64_t *cell;
    double *weight;
};
/* Those of gauge number so and so at x[n], kept for the next time if mesh_stays. */
const struct block_samples *block_samples_of(struct fv *s, int gauge, int n, double (*x)[3]);
/* This rank's share of a field at place k; and of the distance to the surface there, at x. */
double block_sample(const struct fv *s, const struct block_samples *of, int k, const double *q);
double block_sample_phi(const struct fv *s, const struct block_samples *of, int k, const double *x);
/* Whether what FV computes stays where it is. */
bool mesh_stays(const struct fv *s);

/* block_flow.c: what crosses the section of a discharge gauge, by faces of this rank's cells. */
struct face_weight {
    int64_t cell;
    double weight[3][2]; /* -: of its lower and upper face along each index */
};
struct face_weights {
    bool is_made;
    int n;
    struct face_weight *of;
};
/* Sum of the volumes that cross faces, flow (of lower faces along each index), as far as the
 * section of gauge number so and so parts them: this rank's share. For blocks that stay where they
 * are and do not overlap. */
double block_flow(const struct fv *s, int gauge, const struct scene_probe *g,
                  double *const flow[3]);

/* mesh_errors.c: lines of --check and the banner about the blocks: cells, ranks, overlaps. Makes
 * the mesh and leaves it for the run (mesh_leave). */
void mesh_describe(const struct run *r, const struct fv_params *prm);
/* Adds columns of the series with the positions of blocks that move, x y [z] of the centre, m, the
 * angle or the rotation vector, rad. */
void mesh_places_row(const struct fv *s, struct figures *to);
/* Adds to the summary what it has of blocks alone: cells and net flux of overlaps, iterations of
 * the start, solves that were repeated. Collective. */
void mesh_summarise(struct fv *s);

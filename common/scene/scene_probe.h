/* scene_probe.h - what gauges read, and the line or the rectangle of one that reads a discharge.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_PROBE_H
#define COMMON_SCENE_PROBE_H

#include "scene.h"

/* Pressure or velocity: at one point. */
bool probe_is_point(const struct scene_probe *g);
/* Columns of series.csv; the heading of one of them. */
int probe_columns(const struct scene_probe *g, int dim);
void probe_heading(const struct scene_probe *g, int dim, int column, char *text, size_t size);

/* 2D: the line from at to `to', across it to its right-hand side; 3D: the rectangle between these
 * corners, across it along the axis. */
struct probe_section {
    double across[3], along[2][3]; /* unit vectors */
    double length[2];              /* m: along these */
    int n;                         /* of extents: dim - 1 */
};
struct probe_section probe_section_of(const struct scene_probe *g, int dim);

#endif

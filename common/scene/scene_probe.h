/* scene_probe.h - what gauges measure: their columns, and the section of one that measures a
 * discharge.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

/* What both programs of a coupled job say of a gauge of a level, %s its name: the same words are
 * printed once. */
#define PROBE_NO_SURFACE "%s: there is no free surface"

/* Whether a gauge measures at one point: pressure or velocity. */
bool probe_is_point(const struct scene_probe *g);
/* Whether the scene has a gauge of this kind (enum probe_kind). */
bool probe_any(const struct scene *s, int kind);
/* Number of columns of series.csv that a gauge has; adds them, "NAME [Pa]", with their values v. */
int probe_columns(const struct scene_probe *g, int dim);
struct figures;
void probe_row(const struct scene_probe *g, int dim, const double *v, struct figures *to);

/* The section of a discharge: in 2D the line from `at' to `to', counted positive towards its
 * right-hand side; in 3D the rectangle with these corners, normal to an axis and counted positive
 * along it. */
struct probe_section {
    double across[3], along[2][3]; /* unit vectors */
    double length[2];              /* m: along these */
    int n;                         /* of extents: dim - 1 */
};
struct probe_section probe_section_of(const struct scene_probe *g, int dim);

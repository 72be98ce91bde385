/* wave_table.h - the velocities of a wave at one time, tabulated over columns along its direction
 * and nodes between a depth and its surface, so that sampling costs the same whatever made them.
 * Cubic in x and in sigma = (z - eta)/(eta + reach); nodes of a flat table end at the still level
 * and close up towards it (sigma = -s^2, cubic in s). Heights z from the still level.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_TABLE_H
#define COMMON_WAVE_TABLE_H

#include <stdbool.h>

enum { WAVE_NODES = 36 };

struct wave_table {
    int n;             /* columns */
    bool periodic;     /* n columns are one length */
    bool flat;         /* nodes end at the still level */
    double first, gap; /* m: x of the first column, distance of two */
    double reach;      /* m: depth of the lowest node; the water's depth, or less in deep water */
    double decay;      /* 1/m: below it velocities die away as exp(decay (z + reach)); 0: no more */
    double *eta;       /* m, [n] */
    double *u;         /* m/s, [n][WAVE_NODES][2]: along the direction and up, surface first */
    /* 1/s, [n][2], flat: d/dz at the still level, by which velocities go on up to the surface;
     * NULL: there they are as at that level. */
    double *slope;
};

/* n >= 4 columns; all values 0; slope: with one. */
struct wave_table wave_table_create(int n, double first, double gap, double reach, bool slope);
void wave_table_free(struct wave_table *t);
/* z of a node of a column, m; needs its eta. */
double wave_table_height(const struct wave_table *t, int column, int node);
/* to = sum weight[k] of[k] of tables of the same shape. */
void wave_table_blend(struct wave_table *to, int n, const struct wave_table *of,
                      const double *weight);
/* m at x; columns that are not periodic go on as at their ends. */
double wave_table_eta(const struct wave_table *t, double x);
/* u (m/s, along and up) at (x, z); above the highest node as on it. */
void wave_table_velocity(const struct wave_table *t, double x, double z, double u[2]);

#endif

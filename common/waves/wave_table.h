/* wave_table.h - the velocities of waves at one time, tabulated over columns along their direction
 * (for short-crested waves over rows of columns across it) and over nodes between a depth and the
 * surface, so that sampling costs the same whatever made them. Cubic in x and in sigma = (z -
 * eta)/(eta + reach). The nodes of a flat table end at the still level and are denser near it
 * (sigma = -s^2, cubic in s). Heights z count from the still level.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_TABLE_H
#define COMMON_WAVE_TABLE_H

#include <stdbool.h>

enum { WAVE_NODES = 36, WAVE_UPPER = 18 }; /* nodes of a column; of a layered one above the level */

/* The table; eta, u and slope are owned. */
struct wave_table {
    int n, rows;       /* columns of a row; 1: all rows are the same */
    int parts;         /* of a velocity: along, up; of several rows: and across */
    bool periodic;     /* n columns are one length */
    bool flat;         /* nodes end at the still level */
    double still;      /* m: depth of that level of a layered table, < reach; 0: not layered */
    double first, gap; /* m: x of the first column, distance of two, as of rows */
    double first_row;  /* m: y of the first row */
    double reach;      /* m: depth of the lowest node; the water's depth, or less in deep water */
    double decay;      /* 1/m: below it velocities die away as exp(decay (z + reach)); 0: no more */
    double *eta;       /* m, [rows][n] */
    double *u;         /* m/s, [rows][n][WAVE_NODES][parts], surface first */
    /* 1/s, [n][2], flat, one row: d/dz at the still level, by which velocities go on up to the
     * surface; NULL: there they are as at that level. */
    double *slope;
};

/* A table's velocities above and below one place: a table of one column that points into itself, so
 * it is not to be copied. */
struct wave_column {
    struct wave_table is; /* its shape; eta is not used */
    double eta;           /* m */
    double u[WAVE_NODES * 3], slope[2];
};

/* Weights of four equidistant values for the position s = 0 .. 1 between the second and the
 * third. */
void wave_table_cubic(double s, double weight[4]);
/* n >= 4 columns, one row or rows >= 4, all values 0; slope: with the array slope. The
 * arrays belong to the block `owner', which may be NULL. */
struct wave_table wave_table_create(void *owner, int n, int rows, double gap, double reach,
                                    bool slope);
/* Height z of a node of a column, m; uses the column's eta. */
double wave_table_height(const struct wave_table *t, int column, int node);
/* to = sum weight[k] of[k] of tables of the same shape. */
void wave_table_blend(struct wave_table *to, int n, const struct wave_table *of,
                      const double *weight);
/* Level at (x, y), along and across, m. A table that is not periodic continues with its end
 * columns. */
double wave_table_eta(const struct wave_table *t, double x, double y);
/* u (m/s: along, up, across) at (x, y), z, m; above the highest node as on it, but for `slope'. */
void wave_table_velocity(const struct wave_table *t, double x, double y, double z, double u[3]);
/* The same for many heights at one place: the columns about it are blended once. To rounding as
 * wave_table_velocity. */
void wave_table_column(const struct wave_table *t, double x, double y, struct wave_column *to);
void wave_column_velocity(const struct wave_column *c, double z, double u[3]);

#endif

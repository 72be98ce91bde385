/* table.h - reads columns of a CSV file: lines of comments begin with #, the first other line holds
 * the names ("t [s]": the name ends before the unit), each further line a row of numbers. Local to
 * a rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

/* What table_read found: a name for each column and the numbers row by row. */
struct table {
    int nrows, ncolumns;
    char **name; /* [ncolumns], without units */
    double *v;   /* [nrows][ncolumns]; NaN where a field is no number */
};

/* Reads the file. Rows shorter than the header are filled with NaN, longer ones are cut. NULL if
 * the file cannot be read or has no row of numbers. Owned by the caller, freed by FREE. */
struct table *table_read(const char *path);
/* Index of the column of this name (without unit); -1 if there is none. */
int table_column(const struct table *t, const char *name);

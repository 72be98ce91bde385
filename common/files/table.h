/* table.h - columns of a CSV file: lines of comments begin with #, one line of names ("t [s]": the
 * name ends before the unit), rows of numbers. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_TABLE_H
#define COMMON_TABLE_H

#include <stdbool.h>

struct table {
    int nrows, ncolumns;
    char **name; /* [ncolumns], without units */
    double *v;   /* [nrows][ncolumns]; NaN where a field is no number */
};

/* NULL if the file cannot be read or has no row; owned by the caller. */
struct table *table_read(const char *path);
void table_free(struct table **t);
/* -1 if there is none of this name. */
int table_column(const struct table *t, const char *name);

#endif

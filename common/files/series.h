/* series.h - series.csv, one row a step or every n steps, and summary.json, the figures at the end
 * of a run. Rank 0 writes; on the other ranks a series is made with path NULL and its calls do
 * nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

/* A row as a program makes it, column after column: the titles once, before the first row, then the
 * values of each row. Made by NEW, freed by FREE. */
struct figures {
    bool measures; /* false: titles alone are asked for, and nothing is measured */
    int n;         /* of columns so far; 0 begins anew */
    double *value;
    const char **title;
};
/* FIGURE(row, value, "NAME [UNIT]", ...) adds a column of this title, as of printf; the expression
 * of its value is evaluated only where values are asked for. */
#define FIGURE(row, v, ...) figures_add(row, (row)->measures ? (v) : 0.0, __VA_ARGS__)
void figures_add(struct figures *r, double v, const char *title, ...)
    __attribute__((format(printf, 3, 4)));

/* an open series.csv: made by series_create; FREE closes it */
struct series;
/* Opens the file and writes its header from columns[ncolumns], "t [s]", "dt [s]", ...; units of
 * what is of the whole flow, [J], [kg], [kg m/s], [m^dim], [m^dim/s^2], become those of a flow in
 * the plane, per metre of depth, or in space: dim, 2 or 3. Two of the same name end the run through
 * abort_run(). keep: append to an existing file, without its rows later than t_restart, s, and
 * without a last row that is cut short; where its columns are others, rows keep what they have by
 * the names of these, nan in new ones, and where one is no more the whole file stays as
 * PATH.before-T. path NULL: nothing is written. A file that cannot be written ends the run
 * (disk_failed). */
struct series *series_create(const char *path, int dim, int ncolumns, const char *const *columns,
                             bool keep, double t_restart);
/* Writes a row with 12 digits, flushed at once; after a restart not one that is there already. */
void series_row(struct series *s, const double *values);

/* The summary in memory: an ordered list of keys with values. Keys with dots become nested objects,
 * "error.velocity_l2"; the order of insertion is kept. Keys and texts are copied. */
struct summary;
struct summary *summary_create(void);
/* Each sets the value of a key, replacing an earlier one in its place. Non-finite numbers become
 * null. */
void summary_real(struct summary *s, const char *key, double v);
/* For lid-driven cavities: found and known hold the smallest u, the largest and the smallest v on
 * the centre lines, m/s; writes them and their largest relative deviation as error.extrema. */
void summary_extrema(struct summary *s, const double found[3], const double known[3]);
void summary_int(struct summary *s, const char *key, long long v);
void summary_bool(struct summary *s, const char *key, bool v);
void summary_text(struct summary *s, const char *key, const char *v);
void summary_texts(struct summary *s, const char *key, int n, const char *const *v);
/* The number of this key; false if there is none, *v is untouched. */
bool summary_find(const struct summary *s, const char *key, double *v);
/* The text, truth value or list of this key as JSON has it (texts in quotes); NULL if there is
 * none. Borrowed until the key is set again. */
const char *summary_find_text(const struct summary *s, const char *key);
/* Calls f for every number in the order of insertion. */
void summary_each(const struct summary *s, void (*f)(void *ctx, const char *key, double v),
                  void *ctx);
/* Writes the file by rename; failure ends the run (disk_failed). */
void summary_write(const struct summary *s, const char *path);

/* series.h - series.csv, one row a step or every n, and summary.json, the end of the run.
 * Rank 0 writes; on the other ranks the calls do nothing. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SERIES_H
#define COMMON_SERIES_H

#include <stdbool.h>

struct series;
/* columns "t [s]", "dt [s]", ... borrowed literals. keep: append to an existing file whose rows
 * after t_restart are dropped. path NULL: writes nothing (other ranks). */
struct series *series_create(const char *path, int ncolumns, const char *const *columns, bool keep,
                             double t_restart);
void series_row(struct series *s, const double *values);
void series_free(struct series **s);

/* Keys with dots become nested objects: "error.velocity_l2". The order of insertion is kept. */
struct summary;
struct summary *summary_create(void);
void summary_free(struct summary **s);
void summary_real(struct summary *s, const char *key, double v); /* non-finite: null */
/* Least u, largest and least v on a cavity's centre lines, and their largest relative deviation
 * from the known ones. */
void summary_extrema(struct summary *s, const double found[3], const double known[3]);
void summary_int(struct summary *s, const char *key, long long v);
void summary_bool(struct summary *s, const char *key, bool v);
void summary_text(struct summary *s, const char *key, const char *v);
void summary_texts(struct summary *s, const char *key, int n, const char *const *v);
/* false if there is no such number. */
bool summary_find(const struct summary *s, const char *key, double *v);
/* NULL if there is no such text; as JSON has it, in quotes. Borrowed. */
const char *summary_find_text(const struct summary *s, const char *key);
/* Calls f for every number in the order of insertion. */
void summary_each(const struct summary *s, void (*f)(void *ctx, const char *key, double v),
                  void *ctx);
/* Writes by rename. */
void summary_write(const struct summary *s, const char *path);

#endif

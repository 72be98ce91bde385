/* accept.h - a case's own criteria: numbers of summary.json, and series beside reference data.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_ACCEPT_H
#define COMMON_ACCEPT_H

#include <stdbool.h>

#include "../params/params.h"
#include "../scene/scene.h"

struct summary;

/* How far a series lies from its reference between two times, as a fraction. */
struct accept_series {
    int n;
    const double *t, *v; /* [n], t rising */
};
/* rms: of the difference at the reference's times, over the range of the reference; peak: of the
 * largest values; impulse: of the integrals; arrival: of the times at which half of the reference's
 * peak is first passed. NaN if they share no time, or the reference is 0 throughout. */
double accept_distance(int measure, struct accept_series run, struct accept_series reference,
                       double from, double to);
/* References that cannot be read or lack their columns, faults with file and line. */
void accept_check(const struct scene *s, const char *case_dir, const struct params *p,
                  struct faults *f);
/* Criteria whose series is none of these n columns ("H1 [m]") of the run: faults with the nearest
 * name. For a program alone, before its first step; of a job nobody has all columns. */
void accept_check_columns(const struct scene *s, const struct params *p, int n,
                          const char *const *columns, struct faults *f);
/* Prints a line for each criterion and puts what was compared into the summary; false: not all are
 * met, or one is not to be found. Series are read from the run's folder (of all programs of a job).
 * Rank 0 of a program. */
bool accept_judge(const struct scene *s, const char *case_dir, const char *dir,
                  struct summary *summary);

#endif

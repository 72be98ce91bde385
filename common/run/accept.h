/* accept.h - a case's own criteria (group accept): numbers of summary.json against bounds, and
 * columns of series.csv against reference data.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../params/params.h"
#include "../scene/scene.h"

struct summary;

/* A series of n samples; arrays borrowed. */
struct accept_series {
    int n;
    const double *t, *v; /* [n], t rising */
};
/* How far a series lies from its reference between the times from and to, s, as a fraction. measure
 * is an enum accept_measure: rms of the difference at the reference's times, over the range of the
 * reference; peak: of the largest values; impulse: of the integrals; arrival: of the times at which
 * half of the reference's peak is first passed. NaN if they share no time, or the reference is 0
 * throughout. */
double accept_distance(int measure, struct accept_series run, struct accept_series reference,
                       double from, double to);
/* Adds a fault with file and line for each reference that cannot be read, whose first column is not
 * t or that lacks its column, and for keys that go with a reference where none is given. Call on
 * all ranks alike; each reads the files. */
void accept_check(const struct scene *s, const char *case_dir, const struct params *p,
                  struct faults *f);
/* Adds a fault, with the nearest known name, for each criterion whose series is none of the n
 * columns ("H1 [m]") of the run. For a program that runs alone, before its first step; in a coupled
 * job no single program knows all columns. */
void accept_check_columns(const struct scene *s, const struct params *p, int n,
                          const char *const *columns, struct faults *f);
/* Prints a line for each criterion and adds what was compared to the summary. false: a criterion is
 * not met, or what it names cannot be found. Series are read from the run's folder dir, in a
 * coupled job those of all programs. Called on rank 0, of a program alone or of the coupler, after
 * the last rows are written. */
bool accept_judge(const struct scene *s, const char *case_dir, const char *dir,
                  struct summary *summary);

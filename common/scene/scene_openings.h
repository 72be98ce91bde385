/* scene_openings.h - inlets and outlets under a free surface: what each does, and levels and
 * discharges that change over time (a tide, a hydrograph), from files beside the case: rows of a
 * time in s, which rises, and a value. Between the rows it is linear, before the first and after
 * the last constant.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_OPENINGS_H
#define COMMON_SCENE_OPENINGS_H

#include "exact.h"
#include "motion_files.h"
#include "scene.h"

/* Reads the files of all walls, once a start; they belong to `files'. Notes which openings have a
 * level and which a discharge. */
void wall_histories_read(struct scene *s, struct motion_files *files);
/* Faults of the files: no such file, rows that are none, values out of range. */
void wall_histories_check(const struct scene *s, const struct params *p, struct faults *f);
/* m, against gravity: of the water in an opening whose level is given (has_level) at time t. */
double wall_level(const struct scene_wall *w, double t);
/* m^dim/s: through an opening whose discharge is given (has_discharge) at time t, >= 0. */
double wall_discharge(const struct scene_wall *w, double t);
/* Finds what stands at the start in outflows under a free surface that are given no level: see
 * scene_wall. */
void openings_resolve(struct scene *s);
/* m, against gravity: of the highest water at the start on the vertical through x, - infinity:
 * none; and whether it is lower than the highest of all, by a millionth of the domain's height,
 * where the case does not say one level for all (initial.level). */
double openings_top_over(const struct scene *s, const struct exact *e, const double x[3]);
bool openings_are_lower(const struct scene *s, double top);
/* Whether what stands in an outflow at the start stands outside, too: gravity has an axis, and no
 * exact wave passes. */
bool openings_have_outside(const struct scene *s);
/* Says in the log what is outside an outflow that is given nothing; stands: NAN: not known. */
void openings_describe_outside(const char *side, double stands, bool falls);
/* Says in the log what each inlet and outlet under a free surface does. */
void openings_describe(const struct scene *s);

#endif

/* scene_openings.h - inlets and outlets under a free surface: what each does, and levels and
 * discharges that change over time (a tide, a hydrograph) by files beside the case. A file has rows
 * of a time, s, which rises, and a value: linear between the rows, constant before the first and
 * after the last.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "exact.h"
#include "motion_files.h"
#include "scene_groups.h"

/* Sets has_level and has_discharge of each wall and reads the files of all, which `files' owns;
 * NULL: they stay unread. */
void wall_histories_read(struct scene *s, struct motion_files *files);
/* Adds a fault for each file that does not exist, holds faulty rows or values out of range, or
 * stands beside a constant value. */
void wall_histories_check(const struct scene *s, const struct params *p, struct faults *f);
/* Level of the water in an opening with has_level at time t, s; m against gravity. */
double wall_level(const struct scene_wall *w, double t);
/* m: by how much it changes at most within span, s; 0 without a file. */
double wall_level_change(const struct scene_wall *w, double span);
/* m/s: how fast it rises at t, in the mean over `span' s before and after it, so that it has no
 * steps where the file's lines meet. surge: that change in `span', m; nothing foresees a surge:
 * where the rise changes by two thirds of it the result is 0. */
double wall_level_rise(const struct scene_wall *w, double span, double surge, double t);
/* m: by how much the level outside an opening, which leaving waves raised from `given' to `raised',
 * m over the bed, is less where water falls from a depth inside to it at the mean velocity u, m/s:
 * critical flow at most then, or that of a torrent, for no wave comes back; g, m/s^2. */
double openings_fall(double g, double raised, double given, double inside, double u);
/* Discharge through an opening with has_discharge at time t, s; m^dim/s, >= 0. */
double wall_discharge(const struct scene_wall *w, double t);
/* Finds what stands at the start in outflows under a free surface that are given nothing: stands,
 * falls and lower of struct scene_wall. */
void openings_resolve(struct scene *s);
/* Height of the highest water at the start on the vertical through x, m against gravity; -INFINITY:
 * there is none. Gravity must have an axis. */
double openings_top_over(const struct scene *s, const struct exact *e, const double x[3]);
/* Whether such a height lies below the highest water of all, by more than a millionth of the
 * domain's height. Never where the case gives one level for all (initial.level). */
bool openings_are_lower(const struct scene *s, double top);
/* Whether the water that stands in an outflow at the start is taken to stand outside, too: gravity
 * has an axis, and no exact wave passes. */
bool openings_have_outside(const struct scene *s);
/* Largest velocity, m/s, with which given discharges pass sides through the water that stands there
 * at the start; 0: none is given, or no water stands there. */
double openings_discharge_speed(const struct scene *s);
/* Logs what is outside an outflow that is given nothing; stands NAN: not known. */
void openings_describe_outside(const char *side, double stands, bool falls);
/* Logs what each inlet and outlet under a free surface does. */
void openings_describe(const struct scene *s);

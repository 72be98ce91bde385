/* scene_geometry.h - polylines of a scene in the plane: sense, crossings, gaps, what lies inside.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_GEOMETRY_H
#define COMMON_SCENE_GEOMETRY_H

#include <stdbool.h>

#include "../params/params.h"

/* A polyline as the functions below take it; x is borrowed. */
struct line {
    int n;
    const double (*x)[2];
    bool closed; /* the last point is joined with the first */
};

struct line line_of(const struct param_points *p, bool closed);
int line_segments(const struct line *l);
/* Area inside a closed line, m^2: positive if it runs counter-clockwise. */
double line_area(const struct line *l);
/* Area > 0 inside a closed line, its centre, and its polar second moment about that, m^2, m, m^4.
 */
void line_moments(const struct line *l, double *area, double centre[2], double *polar);
double line_length(const struct line *l);
/* Largest extent, m. */
double line_size(const struct line *l);
/* A line whose last point is its first is closed: drops that point. */
void line_trim(struct line *l);
bool line_inside(const struct line *l, const double *x); /* of a closed one, whatever its sense */
/* Distance of x to the line, m. */
double line_distance(const struct line *l, const double *x);
/* What is wrong with a line by itself; *at: the place. */
enum line_fault { LINE_SOUND, LINE_REPEATED, LINE_FLAT, LINE_FOLDED, LINE_CROSSED };
enum line_fault line_check(const struct line *l, double at[2]);
/* Least distance of two lines, m; 0 where they meet. */
double line_gap(const struct line *a, const struct line *b, double at[2]);
/* Whether a pierces b: touching is not piercing. */
bool line_pierces(const struct line *a, const struct line *b, double at[2]);
/* Whether the insides of two closed lines have any area in common. */
bool line_overlaps(const struct line *a, const struct line *b, double at[2]);
/* Turns the sense of the points. */
void points_reverse(struct param_points *p);

#endif

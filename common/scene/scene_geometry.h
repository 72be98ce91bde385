/* scene_geometry.h - polylines in the plane: area, sense, crossings, gaps, what lies inside. Tests
 * are relative to the size of the lines, so that they hold for millimetres and kilometres alike.
 * Local to a rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

#include "../params/params.h"

/* A polyline as the functions below take it: n corners, m; x is borrowed. */
struct line {
    int n;
    const double (*x)[2];
    bool closed; /* the last point is joined with the first */
};

/* The line of points of a case, which must outlive it. */
struct line line_of(const struct param_points *p, bool closed);
/* n if closed, else n - 1. */
int line_segments(const struct line *l);
/* Area inside a closed line, m^2: positive if it runs counter-clockwise, so that inside is on its
 * left. */
double line_area(const struct line *l);
/* Area > 0 inside a closed line, its centroid and its polar second moment about that; m^2, m,
 * m^4. */
void line_moments(const struct line *l, double *area, double centre[2], double *polar);
/* Sum of the segments' lengths, m. */
double line_length(const struct line *l);
/* Larger side of the bounding box, m. */
double line_size(const struct line *l);
/* If the last point repeats the first, drops it and marks the line as closed. */
void line_trim(struct line *l);
/* Whether x lies inside a closed line, whatever its sense. */
bool line_inside(const struct line *l, const double *x);
/* Distance of x to the line itself, m. */
double line_distance(const struct line *l, const double *x);
/* The point of a line that is nearest to another: m. Where two segments that meet are equally near,
 * `aside' is that of the one from whose straight line the other point is farther. */
struct line_foot {
    double x[2], distance;
    int segment; /* on which it is, and which part of the way along it, 0 to 1 */
    double part;
    double aside; /* distance from the straight line of the segment, > 0 on its left */
    int past;     /* -1, 1: the other point is beyond the first, the last end of an open line */
};
struct line_foot line_foot(const struct line *l, const double *x);
/* What is wrong with a line by itself: points that coincide, no area, a fold back onto itself, a
 * crossing. line_check returns the first fault and sets at to its location, m. */
enum line_fault { LINE_SOUND, LINE_REPEATED, LINE_FLAT, LINE_FOLDED, LINE_CROSSED };
enum line_fault line_check(const struct line *l, double at[2]);
/* Smallest distance of two lines, m, and one of its ends; 0 where they cross. */
double line_gap(const struct line *a, const struct line *b, double at[2]);
/* Whether a crosses b, and where; touching is not crossing. */
bool line_pierces(const struct line *a, const struct line *b, double at[2]);
/* Whether the insides of two closed lines have any area in common; at: a point of it. */
bool line_overlaps(const struct line *a, const struct line *b, double at[2]);
/* Reverses the order of the points. */
void points_reverse(struct param_points *p);

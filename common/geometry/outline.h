/* outline.h - reads the corners of a polyline in the plane from a file: CSV rows x, y (a first line
 * of names and lines that begin with # are passed over), or the first path, polygon or polyline of
 * an SVG drawing; "drawing.svg#id" is the one of this id. Curves are divided into chords. Of a
 * drawing the lower left corner of the page is the origin, y points up, lengths are in its own
 * units.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* The polyline as read. */
struct outline {
    int n;          /* corners */
    double (*x)[2]; /* [n]; owned */
    bool closed;    /* the last corner is joined with the first, which does not come twice */
};

/* Reads at most `most' corners into *is: chords of curves as short as that allows, and corners that
 * lie on the straight line between their neighbours are left out; with `whole' none is. is->x is
 * owned by the caller (mem_free). false: text[size] says what is wrong with the file. Local to a
 * rank. */
bool outline_read(const char *file, int most, bool whole, struct outline *is, char *text,
                  size_t size);

/* Box around n points of the plane, m: sets the two of lo and hi; lo > hi: there are none. */
void outline_bounds(int n, const double (*x)[2], double *lo, double *hi);

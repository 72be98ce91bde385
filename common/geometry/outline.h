/* outline.h - corners of a line in the plane from a file: CSV rows x, y (a line of names first and
 * lines that begin with # are passed over), or the first path, polygon or polyline of an SVG
 * drawing, "drawing.svg#id" that of this id. Curves are divided into chords. Of a drawing the
 * lower left corner of the page is the origin, y points up, lengths are in its own units.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_OUTLINE_H
#define COMMON_OUTLINE_H

#include <stdbool.h>
#include <stddef.h>

struct outline {
    int n;
    double (*x)[2]; /* [n]; owned */
    bool closed;    /* the last corner is joined with the first, which does not come twice */
};

/* At most `most' corners: chords of curves as long as that allows, corners that lie on a line with
 * their neighbours left out. false: why in text. x is to be freed by the caller (mem_free). */
bool outline_read(const char *file, int most, struct outline *is, char *text, size_t size);

#endif

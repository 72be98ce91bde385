/* picture.h - the scene of a case as an SVG file (--check=picture): what the programs have
 * understood, to be looked at before a run: walls with normals into the fluid, water, bodies,
 * probes, zones. A 3D scene is projected along y. Rank 0 only; a file that cannot be written ends
 * the run.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

#include "../params/params.h"
#include "scene_groups.h"

/* an open picture: made by picture_create, written and freed by picture_close */
struct picture;

/* How a line or an area is drawn; each kind that is used stands in the legend. */
enum picture_kind {
    PICTURE_WATER,
    PICTURE_HOLE,
    PICTURE_WAVES,
    PICTURE_SLIP,
    PICTURE_NO_SLIP,
    PICTURE_OPENING,
    PICTURE_PERIODIC,
    PICTURE_BODY,
    PICTURE_PROBE,
    PICTURE_ZONE,
    PICTURE_CELLS,
    PICTURE_REGION,
    PICTURE_KINDS
};

/* Opens the file `path' and draws the groups that all programs read. s is borrowed until
 * picture_close. */
struct picture *picture_create(const char *path, const struct scene *s);
/* Draws the outline of the box lo .. hi, m; label may be NULL. */
void picture_box(struct picture *p, enum picture_kind kind, const double lo[3], const double hi[3],
                 const char *label);
/* Draws the polyline x[n][2], m, in the plane of the picture; the last point is joined with the
 * first if closed. fill: the area inside, too; normals: short ticks to the left of the line, where
 * the fluid is. */
void picture_line(struct picture *p, enum picture_kind kind, int n, const double (*x)[2],
                  bool closed, bool fill, bool normals);
/* Adds the outline x[n][2], m, of cells of the program. Once there is one, water is drawn only
 * within the outlines so given. */
void picture_cells(struct picture *p, int n, const double (*x)[2]);
/* Writes a text, which is copied, at a point, m. */
void picture_text(struct picture *p, const double at[3], const char *text);
/* Writes the legend, closes the file and sets *p to NULL. */
void picture_close(struct picture **p);

/* picture.h - the scene of a case as an SVG file (--check=picture): what the programs have
 * understood, to be looked at before a run: walls with normals into the fluid, water, bodies,
 * probes, zones. Of a 3D scene the projection along y. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_PICTURE_H
#define COMMON_PICTURE_H

#include <stdbool.h>

#include "../params/params.h"
#include "scene.h"

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

/* Starts path (rank 0 of a program only) with the groups that all programs read. */
struct picture *picture_create(const char *path, const struct scene *s);
/* A box lo, hi in m, an outline; label may be NULL. */
void picture_box(struct picture *p, enum picture_kind kind, const double lo[3], const double hi[3],
                 const char *label);
/* n points x[][2] of the plane, joined with the first if closed; fill: the area within; normals:
 * short ticks to the left, where the fluid is. */
void picture_line(struct picture *p, enum picture_kind kind, int n, const double (*x)[2],
                  bool closed, bool fill, bool normals);
/* Cells of the program lie within this outline, and the others that are told: there is no water but
 * in them. */
void picture_cells(struct picture *p, int n, const double (*x)[2]);
void picture_text(struct picture *p, const double at[3], const char *text);
/* Writes the legend and closes; sets *p to NULL. */
void picture_close(struct picture **p);

#endif

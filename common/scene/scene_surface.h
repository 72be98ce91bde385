/* scene_surface.h - the keys by which walls, bodies and shapes take their surface from a file,
 * triangles in 3D, an outline in the plane, and put it, or their points, in its place.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../params/params.h"

/* The values of these keys. Files stand beside the case; scale, rotation and shift are applied in
 * this order, about the origin. */
struct scene_surface {
    char mesh[PARAM_TEXT_SIZE];            /* file beside the case; "": none */
    char outline[PARAM_TEXT_SIZE];         /* the same in the plane: scene_outlines.h */
    double scale, rotate[3], translate[3]; /* -, degrees times axis, m: in this order, about 0 */
    double weld;                           /* m; 0: 1e-6 of the diagonal */
};

/* SURFACE_ROWS(T, MESH, OUTLINE, PLACED): the rows for a parameter table whose struct T has a
 * member `surface'; MESH, OUTLINE: when these two keys are used, USED(..), PLACED: when scale,
 * rotate and translate are. */
#define SURFACE_ROW(T, m, is, unit_, dflt_, min_, max_, ...)                                       \
    {                                                                                              \
        .key = #m, .type = is, .offset = offsetof(T, surface.m), .unit = unit_, .dflt = dflt_,     \
        .min = min_, .max = max_, .help = __VA_ARGS__                                              \
    }
#define SURFACE_ROWS(T, MESH, OUTLINE, PLACED)                                                     \
    SURFACE_ROW(T, mesh, PARAM_TEXT, "-", "", 0, 0,                                                \
                "file beside the case with its triangles: STL, OBJ or PLY; sph in 3D", MESH),      \
        SURFACE_ROW(T, outline, PARAM_TEXT, "-", "", 0, 0,                                         \
                    "in 2D: file beside the case with its points: CSV (x, y) or an SVG drawing, "  \
                    "\"hull.svg#path1\" its path of that id; the page's lower left corner is the " \
                    "origin, lengths are its own units times scale",                               \
                    OUTLINE),                                                                      \
        SURFACE_ROW(T, scale, PARAM_REAL, "-", "1.0", 1e-9, 1e9,                                   \
                    "factor on the coordinates: 0.001 for a file in mm", PLACED),                  \
        SURFACE_ROW(T, rotate, PARAM_REALS, "degrees", "(0.0, 0.0, 0.0)", -3600, 3600,             \
                    "then its rotation about the origin, axis times angle: (0, 0, 90) turns x "    \
                    "to y",                                                                        \
                    PLACED, .numbers = 3),                                                         \
        SURFACE_ROW(T, translate, PARAM_REALS, "m", "(0.0, 0.0, 0.0)", -1e9, 1e9,                  \
                    "then its shift", PLACED),                                                     \
        SURFACE_ROW(T, weld, PARAM_REAL, "m", "0.0", 0, 1e6,                                       \
                    "vertices of the mesh closer than this are one; 0: 1e-6 of its diagonal",      \
                    USED(WITH(mesh, "no mesh is given")))

/* scene_forms.h - bodies of simple form, without a file: boxes, discs, and in 3D spheres, cylinders
 * and prisms. Area or volume are those of the form within 1e-3, not of a polygon inscribed
 * in it, and the extent along the axes is exact.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "scene_groups.h"

enum body_form { FORM_NONE, FORM_BOX, FORM_ROUND, FORM_CYLINDER, FORM_PRISM };

/* Which form the keys box, radius and length of the body give. */
enum body_form scene_form_of(const struct scene_body *b);
/* Sorts the corners of boxes of shapes and bodies. In 2D: makes the forms of all bodies their
 * points, placed by rotate and translate. In 3D: keeps the points of prisms as their section.
 * Faults go to f. Call on all ranks alike, before scene_check. */
void scene_forms_make(struct scene *s, const struct params *p, struct faults *f);
/* In 2D, after scene_orient: discs that are whole have edges of `edge', m, where theirs are
 * shorter. */
void scene_forms_fit(struct scene *s, double edge);
/* In 3D: the triangles of a body of simple form, normals out, connected, not yet placed; the
 * caller owns them. Round ones have edges of about `facet', m, where that is not 0. */
struct trimesh scene_form_mesh(const struct scene_body *b, double facet);

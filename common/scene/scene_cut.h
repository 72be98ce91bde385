/* scene_cut.h - what is drawn beyond walls and the domain: bodies that stand in a bed or in a
 * closed side, as a pile or half a disc, and beds that are longer than a period.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../geometry/geometry.h"
#include "scene_groups.h"

/* In 2D: leaves out what a body that never moves has beyond closed sides of the domain and behind
 * open lines, a pile in the sea bed, and sets its `cut'; it then ends on them. Lines have the fluid
 * on their left. A body that moves, is all beyond, or crosses a wall more than twice (legs of a
 * table) stays as it is, for the checks of the program to refuse. */
void scene_cut_at_walls(const struct scene *s, struct scene_body *b);
/* In 3D the same with a body's connected mesh m and the closed sides, on which vertices of it are
 * put that miss them by no more than a file's seven digits. Whether something was left out. */
bool scene_cut_mesh(const struct scene *s, const struct scene_body *b, struct trimesh *m);
/* In 2D: an open line that spans a period, as a bed does, keeps what lies within it, for its images
 * go on there. One that comes back through a periodic side stays as it is. */
void scene_cut_at_periods(const struct scene *s, struct scene_wall *w);

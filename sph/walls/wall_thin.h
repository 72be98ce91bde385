/* wall_thin.h - finds in the case, in 2D, walls and bodies so thin that particles would interact
 * through them, and gaps that hold no particle.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_THIN_H
#define SPH_WALL_THIN_H

#include "../../common/scene/scene.h"

/* Where a wall is too thin or a gap too narrow. */
struct wall_thin {
    double at[2], width; /* m */
    char what[160];      /* "faces of wall 2", "wall 2 and body 1 (hull)" */
};

/* Sets *t to solid thinner than `least', m, between two faces that are wet on both sides; sharp
 * corners do not count. false: there is none. */
bool wall_thin_solid(const struct scene *c, double least, struct wall_thin *t);
/* The same for fluid narrower than `least' between faces along 4 `least' and more; faces that touch
 * do not count. */
bool wall_thin_gap(const struct scene *c, double least, struct wall_thin *t);
/* The narrowest passage between two walls or bodies, one of which is no side of the domain, if it
 * is narrower than `least' along a sixth of that. Free bodies are left out. */
bool wall_thin_passage(const struct scene *c, double least, struct wall_thin *t);

#endif

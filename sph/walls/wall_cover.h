/* wall_cover.h - finds pieces of walls at rest in the plane that lie behind other walls, such as
 * the floor under a beach that was drawn into a tank, or what a line has beyond the tank. No fluid
 * gets there, but fluid before the other wall would interact with them through it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_COVER_H
#define SPH_WALL_COVER_H

#include <stdbool.h>

/* What is left of walls, in their order. */
struct wall_parts {
    bool cut; /* false: all of them are left, and there is no list */
    int n;
    struct wall_part {
        int wall;
        double from, to; /* m from its first end */
    } * part;
};

/* n walls between two ends each, m, with the fluid on the left of the way from the first to the
 * second; the domain from lo to hi, whose open sides close rooms; ends nearer than `near', m, count
 * as joined. `part' of the result is owned by the caller (mem_free). */
struct wall_parts wall_cover(int n, const double (*ends)[2][2], const double *lo, const double *hi,
                             double near);
/* Of npoints x, all inside the domain, the first that does not lie in a room in which a wall shows
 * its back, in what is solid there; npoints: all do. The rest as above. */
int wall_cover_first_open(int n, const double (*ends)[2][2], const double *lo, const double *hi,
                          double near, int npoints, const double (*x)[2]);

#endif

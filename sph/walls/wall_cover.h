/* wall_cover.h - pieces of walls at rest in the plane that lie behind other walls: the floor under
 * a beach that was drawn into a tank, what a line has beyond the tank. No fluid gets there, but
 * what is before the other wall would feel them through it. SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef SPH_WALL_COVER_H
#define SPH_WALL_COVER_H

#include <stdbool.h>

/* What is left of walls, in their order; `part' is the caller's, freed by mem_free. */
struct wall_parts {
    bool cut; /* false: all of them are left, and there is no list */
    int n;
    struct wall_part {
        int wall;
        double from, to; /* m from its first end */
    } * part;
};

/* n walls between two ends each, m, with the fluid on the left of the way from the first to the
 * second; the domain from lo to hi, whose open sides close rooms; what is nearer than `near', m,
 * meets. */
struct wall_parts wall_cover(int n, const double (*ends)[2][2], const double *lo, const double *hi,
                             double near);

#endif

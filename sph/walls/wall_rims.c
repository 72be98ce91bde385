/* wall_rims.c - see wall_rims.h. Beside a rim the particle's own pressure acts with what its sum
 * over the neighbours that it sees really lacks, so that a uniform pressure pushes nobody.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wall_rims.h"

#include "../pairs/sph_pairs.h"

static const double least = 1e-3, whole = 0.1; /* -: R times the integral, from which it counts */

/* Farther than R from a free surface; where the surface has not looked yet, nobody is. */
static bool is_inside(const struct sph *s, int i)
{
    const unsigned char *near = s->walls->near_surface;
    return !s->surface || (near && !near[i]);
}

/* The shadow of a rim cuts a support with straight lines of sight, and neighbours are seen or not:
 * their sum misses the integral over what is seen by up to 15 %, and jumps when one comes into
 * sight. With the integral a uniform pressure pushes water along the rim: under a skirt in water at
 * rest |u| was 1e-2 c0, and particles went through it. Near a free surface the sum lacks more than
 * the shadow, and the integral stays. */
const double *wall_rims_close(const struct sph *s, const struct wall_list *l, int k, double to[3])
{
    const int i = l->who[k], *j = s->list->j + s->list->start[i];
    const double *x = prim_line(&s->p, i), *rim = l->rim[k];
    if (s->dim == 2)
        return rim;
    const double share = fmin(vec3_length(rim) * s->R / whole, 1.0);
    if (share * whole < least || !is_inside(s, i))
        return rim;
    for (int a = 0; a < 3; a++)
        to[a] = (1.0 - share) * rim[a];
    for (int b = 0; b < s->list->count[i]; b++) {
        const double *y = prim_line(&s->p, j[b]);
        double d[3];
        vec3_from(y, x, d);
        vec3_add(to, -share * y[at_volume(3)] * kernel_dw_r(3, vec3_length(d), s->R), d);
    }
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++)
        vec3_add(to, -share * t->is.W, t->n);
    return to;
}

/* ball.c - the nearest point of the part of a sphere within a box is the foot of the radius or lies
 * where a face cuts the sphere, which is a sphere of one dimension less: the same again there.
 * Needed where walls cut a spherical region: beyond a wall there is no edge, so the nearest point
 * of the whole sphere may not count. At most 19 sections are tried in 3D, 5 in 2D; called for every
 * particle near such a region.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "ball.h"

#include "../../common/base/base.h"
#include "box_union.h"

/* Whether x lies in the room, faces included. */
static bool holds(const struct box *room, int dim, const double *x)
{
    bool in = true;
    for (int a = 0; a < dim; a++)
        in = in && x[a] >= room->lo[a] && x[a] <= room->hi[a];
    return in;
}

/* Distance of two points, m. */
static double distance(int dim, const double *a, const double *b)
{
    return sqrt(vec_distance2(dim, a, b));
}

/* A sphere in the axes that are not fixed; of the others foot has the coordinates already. */
struct section {
    const struct box *room;
    const double *centre, *x;
    int dim;
    bool fixed[3];
    double foot[3];
};

/* Feet on it, nearest and, of the two points that are a sphere of one dimension, the farther one. /
 * The foot is the point of the sphere along x - centre, in the free axes. At the centre itself any
 * direction will do, and the first free axis is taken. INFINITY if no foot lies in the room. */
static double nearest_foot(struct section *s, double radius, int nfree)
{
    double along[3] = {0.0, 0.0, 0.0}, length = 0.0, best = INFINITY;
    for (int a = 0; a < s->dim; a++) {
        along[a] = s->fixed[a] ? 0.0 : s->x[a] - s->centre[a];
        length += along[a] * along[a];
    }
    length = sqrt(length);
    for (int a = 0; a < s->dim && length == 0.0; a++)
        if (!s->fixed[a])
            along[a] = length = 1.0;
    for (int side = 0; side < (nfree == 1 ? 2 : 1); side++) {
        for (int a = 0; a < s->dim; a++)
            if (!s->fixed[a])
                s->foot[a] = s->centre[a] + (side ? -radius : radius) * along[a] / length;
        if (holds(s->room, s->dim, s->foot))
            best = fmin(best, distance(s->dim, s->x, s->foot));
    }
    return best;
}

/* Least distance of x to the sphere of squared radius r2 within room; axes before `next' were tried
 * before. A face at `at' along axis a leaves a sphere of squared radius r2 - (at - centre_a)^2, of
 * one axis less; axes are fixed in ascending order only, so that each section is tried once. */
static double section_distance(struct section *s, double r2, int nfree, int next)
{
    double best = nearest_foot(s, sqrt(r2), nfree);
    for (int a = next; a < s->dim && nfree > 1; a++)
        for (int side = 0; side < 2; side++) {
            const double at = side ? s->room->hi[a] : s->room->lo[a];
            const double rest = r2 - (at - s->centre[a]) * (at - s->centre[a]);
            struct section cut = *s;
            if (!(rest >= 0.0))
                continue;
            cut.fixed[a] = true;
            cut.foot[a] = at;
            best = fmin(best, section_distance(&cut, rest, nfree - 1, a + 1));
        }
    return best;
}

/* Outside of the ball the plain distance is right, since x and the ball's nearest part are on one
 * side of the walls. */
double ball_distance(const struct ball *b, int dim, const struct box *room, const double *x)
{
    const double d = b->radius - distance(dim, x, b->centre);
    if (d <= 0.0)
        return d;
    bool cut = false;
    for (int a = 0; a < dim; a++)
        cut =
            cut || b->centre[a] - b->radius < room->lo[a] || b->centre[a] + b->radius > room->hi[a];
    if (!cut)
        return d;
    struct section s = {.room = room, .centre = b->centre, .x = x, .dim = dim};
    return section_distance(&s, b->radius * b->radius, dim, 0);
}

/* body_water.c - see body_water.h. The level is that of the start: a level found from the water
 * around the body feeds back on itself through the partner's phi and falls.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "body_water.h"

#include "../open_boundaries/sph_open_boundaries.h"
#include "../parallel/domain.h"
#include "../walls/sph_walls.h"

static void add(struct body_water *b, const double *x, int64_t id)
{
    ROOM_IN(b, b->x, 3 * (b->n + 1));
    ROOM_IN(b, b->id, b->n + 1);
    memcpy(b->x + 3 * b->n, x, 3 * sizeof *x);
    b->id[b->n++] = id;
}

/* Whether x, m, is in water that is at rest under gravity at the start. */
static bool is_below_level(const struct sph *s, const double *x)
{
    const struct scene *scene = &s->run->scene;
    for (int k = 0; k < scene->nshapes; k++)
        if (scene_is_level(scene, scene->shapes + k) && scene_in_shape(scene, scene->shapes + k, x))
            return true;
    return false;
}

/* Whether bodies or this rank's part of the region, lo to hi, m, are not where they were when
 * points were found last. The start's b->searched is no region: its part is empty. */
static bool has_moved(const struct sph *s, struct body_water *b, const double *lo, const double *hi)
{
    double now[3][3];
    memcpy(now[0], s->lo, sizeof now[0]);
    memcpy(now[1], lo, sizeof now[1]);
    memcpy(now[2], hi, sizeof now[2]);
    bool moved = memcmp(now, b->searched, sizeof now) != 0;
    for (int k = 0; k < s->walls->nbodies; k++)
        moved |= s->walls->bodies[k].moves;
    memcpy(b->searched, now, sizeof now);
    return moved;
}

void body_water_find(const struct sph *s, struct body_water *b)
{
    const struct zones *z = s->zones;
    int first[3] = {0, 0, 0}, end[3] = {1, 1, 1}, all[3] = {1, 1, 1}, i[3];
    double lo[3], hi[3], x[3] = {0.0, 0.0, 0.0};
    domain_bounds(s->domain, lo, hi);
    if (!has_moved(s, b, lo, hi))
        return;
    for (int a = 0; a < s->dim; a++) {
        all[a] = (int)ceil((s->hi[a] - s->lo[a]) / s->dx - 0.5);
        first[a] = (int)ceil((fmax(lo[a], s->lo[a]) - s->lo[a]) / s->dx - 0.5);
        end[a] = (int)ceil((fmin(hi[a], s->hi[a]) - s->lo[a]) / s->dx - 0.5);
    }
    b->n = 0;
    for (i[2] = first[2]; i[2] < end[2]; i[2]++)
        for (i[1] = first[1]; i[1] < end[1]; i[1]++)
            for (i[0] = first[0]; i[0] < end[0]; i[0]++) {
                for (int a = 0; a < s->dim; a++)
                    x[a] = s->lo[a] + (i[a] + 0.5) * s->dx;
                if (zones_depth(s, x) < z->buffer || !is_below_level(s, x))
                    continue;
                if (walls_in_body(s, x))
                    add(b, x, -1 - (i[0] + all[0] * (i[1] + (int64_t)all[1] * i[2])));
            }
}

/* cover.c - whether regions still hold the bodies that they held at the start: where a body has
 * left one, particles of the level below meet it, and its force is theirs.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "refinement.h"

#include <math.h>
#include <string.h>

#include "../../common/base/log.h"
#include "../../common/base/mem.h"
#include "../walls/walls.h"

enum { LOOK_EVERY = 20, VERTICES = 500 };

/* Points of a body's surface that lie where a level flows; the one that lies least far from there.
 */
struct held {
    int points;
    double best, at[3];
};

static struct held count(const struct sph *s, const struct body *b, int level)
{
    const double R = ldexp(s->R, 1 - level);
    const int n = b->mesh ? b->mesh->nvertices : b->is->points.n, stride = 1 + n / VERTICES;
    struct held to = {.best = -INFINITY};
    for (int i = 0; i < n; i += stride) {
        double x[3] = {0.0, 0.0, 0.0};
        body_place(b, b->mesh ? b->mesh->x[i] : b->is->points.x[i], x);
        const double d = regions_distance(s->refinement->regions, level, x);
        to.points += d >= R;
        if (d < R && d > to.best) {
            to.best = d;
            memcpy(to.at, x, sizeof to.at);
        }
    }
    return to;
}

static void say_left(const struct sph *s, const struct body *b, int level, const struct held *now)
{
    log_warn("t = %g s: body %s has left the region of level %d at (%g, %g, %g) m; there the "
             "spacing is dx = %.3g m, and its force is as accurate as that: let the region move "
             "with it (apr.regions: follow = \"%s\", or shape = \"body\"), or make it larger",
             s->t, b->is->name, level, now->at[0], now->at[1], now->at[2], ldexp(s->dx, 1 - level),
             b->is->name);
}

/* Reported once for each body and level. */
void refinement_watch_bodies(struct sph *s)
{
    struct refinement *r = s->refinement;
    const bool first = !r->held;
    if (!s->walls || s->walls->nbodies == 0 || (!first && s->run->step % LOOK_EVERY > 0))
        return;
    if (first)
        r->held = mem_new(BODIES_MAX, sizeof *r->held);
    for (int k = 0; k < s->walls->nbodies; k++)
        for (int n = 1; n <= regions_levels(r->regions) && s->walls->bodies[k].moves; n++) {
            int *before = &r->held[k][n];
            if (!first && *before == 0)
                continue;
            const struct held now = count(s, s->walls->bodies + k, n);
            if (first) {
                *before = now.points;
            } else if (now.points < *before) {
                say_left(s, s->walls->bodies + k, n, &now);
                *before = 0;
            }
        }
}

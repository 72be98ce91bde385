/* cover.c - whether edges of regions cut bodies, and whether regions still hold the bodies that
 * they held at the start: where a body has left one, particles of the level below meet it, and its
 * force is theirs. SPDX-License-Identifier: BSD-3-Clause */
#include "refinement.h"

#include "../walls/sph_walls.h"

enum { LOOK_EVERY = 20, VERTICES = 500, PARTS = 8 }; /* of a side of a polygon */

/* Points of a body's surface, those that lie where a level flows, and of the others the one least
 * far from there. */
struct held {
    int all, points;
    double best, at[3];
};

/* Point i of a body's surface in space: a vertex of its mesh, or one of PARTS on each side. */
static void point_of(const struct body *b, int i, double *x)
{
    double at[3] = {0.0, 0.0, 0.0};
    if (b->mesh) {
        body_place(b, b->mesh->x[i], x);
        return;
    }
    const int n = b->is->points.n, from = i / PARTS, to = (from + 1) % n;
    const double part = (double)(i % PARTS) / PARTS;
    for (int a = 0; a < 2; a++)
        at[a] = (1.0 - part) * b->is->points.x[from][a] + part * b->is->points.x[to][a];
    body_place(b, at, x);
}

/* How much of a body's surface lies where `level' flows, i.e. at least R of the coarser level
 * inside the region, by at most VERTICES samples; of those that do not, `best' and `at' give the
 * one nearest to it. */
static struct held count(const struct sph *s, const struct body *b, int level)
{
    const double R = ldexp(s->R, 1 - level);
    const int n = b->mesh ? b->mesh->nvertices : PARTS * b->is->points.n, stride = 1 + n / VERTICES;
    struct held to = {.best = -INFINITY};
    for (int i = 0; i < n; i += stride) {
        double x[3] = {0.0, 0.0, 0.0};
        point_of(b, i, x);
        const double d = regions_distance(s->refinement->regions, level, x);
        to.all++;
        to.points += d >= R;
        if (d < R && d > to.best) {
            to.best = d;
            memcpy(to.at, x, sizeof to.at);
        }
    }
    return to;
}

/* Warned of once a level and body. */
static void say_left(const struct sph *s, const struct body *b, int level, const struct held *now)
{
    log_warn("t = %g s: body %s has left the region of level %d at (%g, %g, %g) m; there the "
             "spacing is dx = %.3g m, and its force is as accurate as that: let the region move "
             "with it (apr.regions: follow = \"%s\", or shape = \"body\"), or make it larger",
             s->t, b->is->name, level, now->at[0], now->at[1], now->at[2], ldexp(s->dx, 1 - level),
             b->is->name);
}

/* At the start: an edge that cuts a body leaves its force to two levels. */
static void say_cut(const struct sph *s, const struct body *b, int level, const struct held *is)
{
    const double R = ldexp(s->R, 1 - level);
    log_warn("the edge of level %d cuts body %s at (%g, %g, %g) m: pressures there are right, but "
             "each level pushes with its own particles, and the force may be off by a tenth of "
             "the pressure times its area (force.average is better); let the region reach R = "
             "%.3g m beyond the body, or end before it",
             level, b->is->name, is->at[0], is->at[1], is->at[2], R);
}

/* Reported once for each body and level. The first call sees which regions hold a body whole; one
 * that an edge cuts is told so then, and not that it has left what moves along with it. Later
 * calls, every LOOK_EVERY steps, compare moving bodies with that. Every rank has all bodies and
 * regions, so nothing is exchanged. */
void refinement_watch_bodies(struct sph *s)
{
    struct refinement *r = s->refinement;
    const bool first = !r->held;
    if (!s->walls || s->walls->nbodies == 0 || (!first && s->run->step % LOOK_EVERY > 0))
        return;
    if (first)
        r->held = mem_new_in(r, BODIES_MAX, sizeof *r->held);
    for (int k = 0; k < s->walls->nbodies; k++)
        for (int n = 1; n <= regions_levels(r->regions); n++) {
            int *before = &r->held[k][n];
            if (!first && (*before == 0 || !s->walls->bodies[k].moves))
                continue;
            const struct held now = count(s, s->walls->bodies + k, n);
            if (first) {
                *before = now.points == now.all ? now.points : 0;
                if (now.points > 0 && now.points < now.all)
                    say_cut(s, s->walls->bodies + k, n, &now);
            } else if (now.points < *before) {
                say_left(s, s->walls->bodies + k, n, &now);
                *before = 0;
            }
        }
}

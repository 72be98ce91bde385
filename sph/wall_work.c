/* wall_work.c - the work that moving walls do on the fluid: the momentum that they give to each
 * particle, as the rates before and after their part show it, times their velocity there.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_watch.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "sph.h"
#include "walls.h"

bool sph_watch_moves(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nbodies; k++) {
        const struct scene_body *b = c->bodies + k;
        any = any || b->velocity[0] != 0.0 || b->velocity[1] != 0.0 || b->spin != 0.0 || *b->motion;
    }
    for (int k = 0; k < c->nwalls; k++)
        for (int a = 0; a < 3; a++)
            any = any || c->walls[k].velocity[a] != 0.0;
    return any;
}

void sph_watch_before_walls(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    w->wall_power = 0.0;
    if (!w->budget_closed || !s->walls || !sph_watch_moves(&s->run->scene))
        return;
    mem_free(w->rate);
    w->rate = NEW(double, (size_t)s->p.n * s->dim);
    for (int i = 0; i < s->p.n; i++)
        memcpy(w->rate + (size_t)i * s->dim, s->p.rate + (size_t)i * s->p.nstate + s->dim,
               (size_t)s->dim * sizeof(double));
}

/* Smallest box around body k. */
static void box_of(const struct walls *w, const struct body *b, double lo[2], double hi[2])
{
    lo[0] = lo[1] = INFINITY;
    hi[0] = hi[1] = -INFINITY;
    for (int k = b->first; k < b->first + b->n; k++)
        for (int a = 0; a < 2; a++) {
            lo[a] = fmin(lo[a], w->segments[k].a[a]);
            hi[a] = fmax(hi[a], w->segments[k].a[a]);
        }
}

/* Whether a wall without body that moves along itself is within R of x. */
static bool slides(const struct sph *s, const struct segment *g, const double *x)
{
    const double d[2] = {x[0] - g->a[0], x[1] - g->a[1]};
    const double along = d[0] * g->t[0] + d[1] * g->t[1];
    return g->body < 0 && (g->u[0] != 0.0 || g->u[1] != 0.0) && along > 0.0 && along < g->length &&
           fabs(d[0] * g->n[0] + d[1] * g->n[1]) < s->R;
}

/* What walls in motion do to a particle at x with the force f: a body's as if x were on it, which
 * for normal forces is the same. */
static double power_at(const struct sph *s, double (*boxes)[2][2], const double *x, const double *f)
{
    const struct walls *w = s->walls;
    for (int k = 0; k < w->nbodies; k++) {
        const struct body *b = w->bodies + k;
        const struct body_motion *m = &b->now;
        const double d[2] = {x[0] - b->is->centre[0] - m->x[0], x[1] - b->is->centre[1] - m->x[1]};
        bool near = true;
        for (int a = 0; a < 2; a++)
            near = near && x[a] > boxes[k][0][a] - s->R && x[a] < boxes[k][1][a] + s->R;
        if (near)
            return f[0] * (m->u[0] - m->spin * d[1]) + f[1] * (m->u[1] + m->spin * d[0]);
    }
    for (int k = 0; k < w->nsegments; k++)
        if (slides(s, w->segments + k, x))
            return f[0] * w->segments[k].u[0] + f[1] * w->segments[k].u[1];
    return 0.0;
}

/* Walls with momentum to give are of 2 dimensions. */
void sph_watch_after_walls(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    double boxes[BODIES_MAX][2][2];
    if (!w->rate)
        return;
    for (int k = 0; k < s->walls->nbodies; k++)
        box_of(s->walls, s->walls->bodies + k, boxes[k][0], boxes[k][1]);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        const double *rate = s->p.rate + (size_t)i * s->p.nstate + 2;
        const double f[2] = {rate[0] - w->rate[2 * i], rate[1] - w->rate[2 * i + 1]};
        if (f[0] != 0.0 || f[1] != 0.0)
            w->wall_power += power_at(s, boxes, y, f);
    }
    mem_free(w->rate);
    w->rate = NULL;
}

/* wall_work.c - the work that moving walls do on the fluid: bodies by the forces that the fluid
 * loses to them, walls that slide by the momentum that they give to each particle, as the rates
 * before and after their part show it, times their velocity there.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_watch.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "sph.h"
#include "walls.h"

static bool any_slides(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nwalls; k++)
        for (int a = 0; a < 3; a++)
            any = any || c->walls[k].velocity[a] != 0.0;
    return any;
}

bool sph_watch_moves(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nbodies; k++) {
        const struct scene_body *b = c->bodies + k;
        any = any || b->velocity[0] != 0.0 || b->velocity[1] != 0.0 || b->spin != 0.0 || *b->motion;
    }
    return any || any_slides(c);
}

void sph_watch_before_walls(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    w->wall_power = 0.0;
    if (!w->budget_closed || !s->walls || !any_slides(&s->run->scene))
        return;
    mem_free(w->rate);
    w->rate = NEW(double, (size_t)s->p.n * s->dim);
    for (int i = 0; i < s->p.n; i++)
        memcpy(w->rate + (size_t)i * s->dim, s->p.rate + (size_t)i * s->p.nstate + s->dim,
               (size_t)s->dim * sizeof(double));
}

/* Whether a wall without body that moves along itself is within R of x. */
static bool slides(const struct sph *s, const struct segment *g, const double *x)
{
    const double d[2] = {x[0] - g->a[0], x[1] - g->a[1]};
    const double along = d[0] * g->t[0] + d[1] * g->t[1];
    return g->body < 0 && (g->u[0] != 0.0 || g->u[1] != 0.0) && along > 0.0 && along < g->length &&
           fabs(d[0] * g->n[0] + d[1] * g->n[1]) < s->R;
}

/* What walls that slide do to a particle at x with the force f. */
static double power_at(const struct sph *s, const double *x, const double *f)
{
    const struct walls *w = s->walls;
    for (int k = 0; k < w->nsegments; k++)
        if (slides(s, w->segments + k, x))
            return f[0] * w->segments[k].u[0] + f[1] * w->segments[k].u[1];
    return 0.0;
}

/* Bodies: the force that the fluid really loses to them, see forces.h. */
static double power_of_bodies(const struct walls *w)
{
    double sum = 0.0;
    for (int k = 0; k < w->nbodies; k++) {
        const struct body_motion *m = &w->bodies[k].now;
        const double *f = w->forces.stage[k];
        sum -= f[0] * m->u[0] + f[1] * m->u[1] + f[2] * m->spin;
    }
    return sum;
}

/* Walls with momentum to give are of 2 dimensions. */
void sph_watch_after_walls(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    if (w->budget_closed && s->walls)
        w->wall_power += power_of_bodies(s->walls);
    if (!w->rate)
        return;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        const double *rate = s->p.rate + (size_t)i * s->p.nstate + 2;
        const double f[2] = {rate[0] - w->rate[2 * i], rate[1] - w->rate[2 * i + 1]};
        if (f[0] != 0.0 || f[1] != 0.0)
            w->wall_power += power_at(s, y, f);
    }
    mem_free(w->rate);
    w->rate = NULL;
}

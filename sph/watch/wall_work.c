/* wall_work.c - the work that moving walls do on the fluid: bodies by the forces that the fluid
 * loses to them, walls that slide by the momentum that they give to each particle, as the rates
 * before and after their part show it, times their velocity there.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_watch.h"

#include "../sph.h"
#include "../walls/sph_walls.h"

/* Walls that move along themselves work by friction. */
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
    for (int k = 0; k < c->nbodies; k++)
        any = any || scene_body_moves(c->bodies + k);
    return any || any_slides(c);
}

/* Keeps the momentum rates as the pairs left them, [n][dim], if some wall slides. */
void sph_watch_before_walls(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    if (!w->budget_closed || !s->walls || !any_slides(&s->run->scene))
        return;
    mem_free(w->rate);
    w->rate = NEW_IN(s, double, (size_t)s->p.n * s->dim);
    for (int i = 0; i < s->p.n; i++)
        memcpy(w->rate + (size_t)i * s->dim, state_row(&s->p, s->p.rate, i) + s->dim,
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

/* The same of a mesh. */
static bool mesh_slides(const struct sph *s, const struct wall_mesh *m, const double *x)
{
    double own[3];
    if (m->body >= 0 || (m->u[0] == 0.0 && m->u[1] == 0.0 && m->u[2] == 0.0))
        return false;
    wall_mesh_to_own(m, x, own);
    return tree_nearest(m->tree, own, s->R).triangle >= 0;
}

/* Power, W, of the force f on a particle at x if a sliding wall exerts it: f.u of the first segment
 * or mesh within R that slides. */
static double power_at(const struct sph *s, const double *x, const double *f)
{
    const struct walls *w = s->walls;
    for (int k = 0; k < w->nsegments; k++)
        if (slides(s, w->segments + k, x))
            return f[0] * w->segments[k].u[0] + f[1] * w->segments[k].u[1];
    for (int k = 0; k < w->nmeshes; k++) {
        const double *u = w->meshes[k].u;
        if (mesh_slides(s, w->meshes + k, x))
            return f[0] * u[0] + f[1] * u[1] + f[2] * u[2];
    }
    return 0.0;
}

/* Bodies: the force that the fluid really loses to them, see forces.h. Force and moment of this
 * stage are on the body, so that the fluid gets the opposite work. */
static double power_of_bodies(const struct walls *w)
{
    double sum = 0.0;
    for (int k = 0; k < w->nbodies; k++) {
        const struct body_motion *m = &w->bodies[k].now;
        const struct force *f = w->forces.stage + k;
        if (w->bodies[k].bend) {
            sum -= body_bend_power(w->bodies[k].bend);
            continue;
        }
        for (int a = 0; a < 3; a++)
            sum -= f->F[a] * m->u[a] + f->M[a] * m->omega[a];
    }
    return sum;
}

/* The walls' part of the rates is the difference to what was kept. */
void sph_watch_after_walls(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    if (w->budget_closed && s->walls)
        w->wall_power += power_of_bodies(s->walls);
    if (!w->rate)
        return;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        const double *rate = state_row(&s->p, s->p.rate, i) + s->dim;
        double f[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < s->dim; a++)
            f[a] = rate[a] - w->rate[(size_t)i * s->dim + a];
        if (f[0] != 0.0 || f[1] != 0.0 || f[2] != 0.0)
            w->wall_power += power_at(s, y, f);
    }
    mem_free(w->rate);
    w->rate = NULL;
}

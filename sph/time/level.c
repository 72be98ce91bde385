/* level.c - what a stage of a Runge-Kutta step does on one level, and what its end removes. Order
 * of a stage: level_begin_rates (walls move, zones impose, records are packed), then level_rates:
 * first pass over pairs, surface detection, wall terms of the slopes, bounds of the shift, second
 * pass, walls' part of the rates, volume feedback, body forces. level_update advances y = [x, m u,
 * w, m] by these rates. integrate.c calls it for all levels at once, local_steps.c for each level
 * at times of its own.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "level.h"

#include "../../common/scene/scene.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../surface/sph_surface.h"
#include "../walls/sph_walls.h"
#include "damper.h"
#include "runge_kutta.h"
#include "zone_pull.h"

static void start(struct sph *s, const char *timer) { timer_start(&s->run->timers, timer); }

static void stop(struct sph *s, const char *timer) { timer_stop(&s->run->timers, timer); }

/* Once a step, or whenever something moved, added or removed particles. The order matters:
 * migration before the sort, the sort before ghosts, ghosts of other ranks and images first, then
 * those of openings, then those of walls (nhalo counts the first ones alone), and the list of pairs
 * when all are there. Surface and slopes belonged to the old list. */
void level_prepare(struct sph *s)
{
    start(s, "list");
    if (s->zones)
        zones_mark(s);
    domain_migrate(s);
    if (s->mixed)
        mixed_sort(s);
    else
        neighbours_sort(s);
    particles_lines(s);
    domain_ghosts(s);
    if (s->mixed)
        mixed_images(s);
    if (s->zones)
        outer_lattice_ghosts(s);
    if (s->walls) {
        walls_move(s, s->t);
        if (s->walls->model->ghosts)
            s->walls->model->ghosts(s);
    }
    if (s->mixed)
        mixed_list(s);
    else
        neighbours_build(s);
    stop(s, "list");
    if (s->walls && s->walls->model->list) {
        start(s, "walls");
        s->walls->model->list(s);
        stop(s, "walls");
    }
    if (s->surface) {
        surface_room(s->surface, s->p.n, s->dim);
        s->surface->known = false;
        volume_feedback_prepare(s);
    }
    s->lists.sloped = false;
    s->lists.moment = 0.0;
    memset(s->lists.moments, 0, sizeof s->lists.moments);
    s->lists.ready = true;
}

typedef void wall_hook(struct sph *s);

/* Calls a hook of the wall model, timed as walls; none if the model has no such hook. */
static void at_walls(struct sph *s, wall_hook *hook)
{
    if (!hook)
        return;
    start(s, "walls");
    hook(s);
    stop(s, "walls");
}

/* A pass over the pairs: rows without ghosts while these are under way, then, when walls have seen
 * to theirs, the others. `slopes': the halo carries slopes instead of packed records. `hook' fills
 * what walls' ghosts have, which may depend on the halo. On one rank there are no inner rows and
 * all are treated at the end. */
static void pass(struct sph *s, void (*rows)(struct sph *s), const char *timer, bool slopes,
                 wall_hook *hook)
{
    struct neighbours *l = s->list;
    start(s, "halo");
    domain_halo_start(s, slopes);
    stop(s, "halo");
    if (l->ninner > 0) {
        start(s, timer);
        neighbours_rows(l, ROWS_INNER);
        rows(s);
        stop(s, timer);
    }
    start(s, "halo");
    domain_halo_finish(s, slopes);
    stop(s, "halo");
    at_walls(s, hook);
    start(s, timer);
    neighbours_rows(l, ROWS_OUTER);
    rows(s);
    neighbours_rows(l, ROWS_ALL);
    stop(s, timer);
}

/* What follows the first pass: the surface is detected once for each list; walls add their terms to
 * the slopes; then shifts are bounded and the divergence that the acoustic damper sees is
 * corrected. Collective where there is a surface. */
static void finish_slopes(struct sph *s)
{
    const bool shifts = s->prm.transport == TRANSPORT_TVS || s->prm.transport == TRANSPORT_TVO;
    if (s->surface && !s->surface->known) {
        start(s, "surface");
        surface_detect(s);
        volume_feedback_find(s);
        stop(s, "surface");
    }
    if (s->walls)
        at_walls(s, s->walls->model->slopes);
    if (s->walls || s->surface)
        transport_finish(s);
    if (s->walls && shifts)
        at_walls(s, s->walls->model->bound_shifts);
    damper_correct(s);
}

/* Adds the body force of the acceleration -W^2 x about the origin, of rotating patches. */
static void add_central(struct sph *s)
{
    const double W2 = s->central * s->central;
    const int dim = s->dim;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        double *rate = state_row(&s->p, s->p.rate, i) + dim;
        for (int a = 0; a < dim; a++)
            rate[a] -= y[at_mass(dim)] * W2 * y[a];
    }
}

/* What follows the slopes of one level: of its deep guards these stay for the step. From now on
 * passes of this step leave deep rows out: nobody needs their rates. */
static void slopes_done(struct sph *s)
{
    finish_slopes(s);
    if (s->guards)
        guards_hold_edge(s);
    if (s->guards && !s->list->spared)
        guards_spare(s);
    s->list->treated = s->list->nshallow;
}

/* All rows at once and without overlap of the halo: it is done once an output, not in every stage.
 * The timer tells whether the next stage profits from it. */
void level_gradients(struct sph *s, bool shared)
{
    start(s, shared ? "gradients" : "output");
    domain_halo_start(s, false);
    domain_halo_finish(s, false);
    if (s->walls && s->walls->model->lines)
        s->walls->model->lines(s);
    (s->mixed ? mixed_gradients : scheme_gradients(s->dim, s->prm.transport))(s);
    stop(s, shared ? "gradients" : "output");
    slopes_done(s);
    if (shared)
        kernel_moment_learn(s);
    else /* made of what is imposed later, or over fewer pairs */
        memset(s->lists.moments, 0, sizeof s->lists.moments);
    s->lists.sloped = shared;
}

/* Needs the list of the present step. With slopes at hand the records are those of y already. */
void level_begin_rates(struct sph *s)
{
    if (s->walls)
        walls_move(s, s->t);
    if (s->zones) {
        start(s, "zones");
        zones_stage(s);
        stop(s, "zones");
    }
    start(s, "update");
    if (!s->lists.sloped)
        particles_lines(s);
    s->background = scheme_background(s);
    stop(s, "update");
}

/* Slopes of ghosts are exchanged with the second pass if the scheme reads them; schemes that need
 * neither pass first exchange the records then. If only the first pass exchanged records, the
 * second one needs no halo. */
void level_rates(struct sph *s)
{
    const struct wall_model *w = s->walls ? s->walls->model : NULL;
    s->watch.wall_power = 0.0;
    if (s->scheme->gradients && !s->lists.sloped) {
        pass(s, s->scheme->gradients, "gradients", false, w ? w->lines : NULL);
        slopes_done(s);
        kernel_moment_learn(s);
    }
    if (s->zones) {
        start(s, "zones");
        zones_slopes(s);
        stop(s, "zones");
    }
    s->lists.sloped = false;
    if (s->scheme->slopes || !s->scheme->gradients) {
        pass(s, s->scheme->rates, "rates", s->scheme->slopes, w ? w->ghost_slopes : NULL);
    } else {
        start(s, "rates");
        s->scheme->rates(s);
        stop(s, "rates");
    }
    if (w) {
        sph_watch_before_walls(s);
        at_walls(s, w->rates);
        sph_watch_after_walls(s);
    }
    if (s->surface)
        volume_feedback_add(s);
    if (s->central > 0.0)
        add_central(s);
    if (s->wave_zones)
        zone_pull_add(s);
    if (s->guards)
        guards_rates(s);
}

/* y = y0 + a rate, over all records as one array. */
static void advance(struct sph *s, double a)
{
    const size_t n = (size_t)s->p.n * s->p.nstate;
    double *restrict y = s->p.y;
    const double *restrict y0 = s->p.y0, *restrict rate = s->p.rate;
    for (size_t i = 0; i < n; i++)
        y[i] = y0[i] + a * rate[i];
}

/* sum = b rate at the first stage, sum += b rate at the others. */
static void add_rates(struct sph *s, double b, bool first)
{
    const size_t n = (size_t)s->p.n * s->p.nstate;
    double *restrict sum = particles_sum(&s->p);
    const double *restrict rate = s->p.rate;
    for (size_t i = 0; i < n; i++)
        sum[i] = (first ? 0.0 : sum[i]) + b * rate[i];
}

/* Schemes whose weights are all on the last stage (j3) need no sum, which saves its memory and a
 * pass; RK4 does. */
void level_update(struct sph *s, int k, double dt)
{
    const struct rk_stages *c = s->stages;
    const bool summed = c->weight[0] != 0.0, last = k == c->n - 1;
    start(s, "update");
    if (last)
        damper_learn(s, dt);
    if (summed)
        add_rates(s, c->weight[k], k == 0);
    if (!last) {
        advance(s, c->ahead[k] * dt);
    } else if (!summed) {
        advance(s, c->weight[k] * dt);
    } else {
        const size_t n = (size_t)s->p.n * s->p.nstate;
        for (size_t i = 0; i < n; i++)
            s->p.y[i] = s->p.y0[i] + dt * s->p.sum[i];
    }
    stop(s, "update");
}

/* Whether a particle has gone out where water is to fall. Its mass counts for that side, or for the
 * one without a wall that it has gone over, unless it is a guard. */
static bool has_fallen(struct sph *s, int i)
{
    const double *y = state_row(&s->p, s->p.y, i);
    int over = -1;
    bool falls = false;
    for (int side = 0; side < 2 * s->dim && !falls; side++) {
        const int a = side / 2;
        if (s->periodic[a] || !(side % 2 ? y[a] > s->hi[a] : y[a] < s->lo[a]))
            continue; /* across a period it is not out, it is only not yet brought back */
        const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + side);
        falls = w && w->kind == WALL_FALLS;
        over = falls || !w ? side : over;
    }
    if (over >= 0 && !particles_is_guard(&s->p, i))
        s->total.fallen[over] += y[at_mass(s->dim)];
    return falls;
}

/* Removes particles beyond a side where nothing holds them; the number of those that were to stay.
 * Keeps the order of the others. NaN compares false and stays, for the watch to find. */
static int remove_lost(struct sph *s)
{
    const int before = s->p.n;
    int n = 0, lost = 0;
    for (int i = 0; i < before; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        bool inside = true;
        for (int a = 0; a < s->dim; a++)
            inside = inside && (s->periodic[a] || !(y[a] < s->lo[a] || y[a] > s->hi[a]));
        if (inside) {
            particles_copy(&s->p, n++, i);
            continue;
        }
        sph_watch_removed(s, i);
        if (has_fallen(s, i))
            continue;
        if (!s->total.lost_any)
            memcpy(s->total.lost_at, y, (size_t)s->dim * sizeof *y);
        s->total.lost_any = true;
        lost++;
    }
    s->p.n = n;
    return lost;
}

/* Particles that walls have let through are put back; removed are those too far behind. From the
 * highest index down, so that the last particle, which takes the place of one that is removed, has
 * been treated by then. */
static int remove_behind(struct sph *s)
{
    int gone = 0;
    if (!s->walls)
        return 0;
    at_walls(s, walls_put_back_inside);
    if (!s->walls->model->behind)
        return 0;
    start(s, "walls");
    int *who = NEW(int, s->p.n);
    for (int k = s->walls->model->behind(s, who) - 1; k >= 0; k--)
        if (!walls_put_back(s, who[k])) {
            sph_watch_removed(s, who[k]);
            particles_copy(&s->p, who[k], --s->p.n);
            gone++;
        }
    mem_free(who);
    stop(s, "walls");
    return gone;
}

int level_clean(struct sph *s) { return remove_behind(s) + remove_lost(s); }

/* 2.2 dt stray is the skin that a step of dt asks for: twice the largest velocity relative to the
 * drift, and a tenth more. */
double level_dt(const struct sph *s, const char **by)
{
    double dt = INFINITY;
    struct sph_params prm = s->prm;
    if (s->mixed) /* the smallest R asks for it */
        prm.dx = mixed_least(s) / prm.R_dx;
    *by = "speed";
    if (s->step.signal > 0.0)
        dt = sph_params_dt(&prm, s->nu, s->step.signal, by);
    if (2.2 * dt * s->step.stray > s->lists.skin_most) {
        dt = s->lists.skin_most / (2.2 * s->step.stray);
        *by = "speed";
    }
    return dt;
}

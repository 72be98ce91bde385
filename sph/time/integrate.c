/* integrate.c - time step size [2.102-2.104], stages of a Runge-Kutta scheme, and the watch over
 * what comes out of it. The list of pairs and the ghosts are made once a step; the skin covers the
 * way that particles go within it. SPDX-License-Identifier: BSD-3-Clause */
#include "../sph.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../common/log.h"
#include "../../common/mem.h"
#include "../parallel/domain.h"
#include "../particles/eos.h"
#include "../bodies/bodies.h"
#include "../walls/forces.h"
#include "../pairs/collisions.h"
#include "../pairs/neighbours.h"
#include "../refinement/apr_params.h"
#include "../refinement/guards.h"
#include "../refinement/refinement.h"
#include "../open_boundaries/openings.h"
#include "../pairs/scheme.h"
#include "../sph_params.h"
#include "../surface/surface.h"
#include "runge_kutta.h"
#include "../walls/walls.h"
#include "../open_boundaries/zones.h"

enum { BALANCE_EVERY = 50, COUNT_EVERY = 20, LEVELS = APR_LEVELS_MAX + 1 };

/* Largest values over particles, then over ranks by one reduction. Minima are kept negated. */
enum {
    MOST_SIGNAL, /* c + |u - u0| */
    MOST_C,
    MOST_SHIFT,    /* |u - u0| */
    MOST_STRAY,    /* |u0 - drift| */
    MOST_RELATIVE, /* |u - drift| */
    MOST_U0,       /* [3] */
    LEAST_U0 = MOST_U0 + 3,
    MOST_SPEED = LEAST_U0 + 3,
    MOST_RHO,
    LEAST_RHO,
    MOST_FAULT, /* above 1: the state cannot be trusted */
    MOST_LOST,
    EXTREMES
};

static void raise(double *most, double v) { *most = v > *most ? v : *most; }

static void start(struct sph *s, const char *timer) { timer_start(&s->run->timers, timer); }

static void stop(struct sph *s, const char *timer) { timer_stop(&s->run->timers, timer); }

/* One level. */
static void prepare(struct sph *s)
{
    start(s, "list");
    if (s->zones)
        zones_mark(s);
    domain_migrate(s);
    neighbours_sort(s);
    particles_lines(s);
    domain_ghosts(s);
    if (s->zones)
        openings_ghosts(s);
    if (s->walls) {
        walls_move(s, s->t);
        if (s->walls->model->ghosts)
            s->walls->model->ghosts(s);
    }
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
    }
    s->sloped = false;
    s->ready = true;
}

void integrate_prepare(struct sph *s)
{
    bool ready = true;
    for (const struct sph *q = s; q; q = q->finer)
        ready = ready && q->ready;
    if (s->finer && !ready)
        guards_come_back(s);
    for (struct sph *q = s; q && !ready; q = q->finer)
        prepare(q);
    if (s->finer && !ready) {
        start(s, "levels");
        guards_list(s);
        stop(s, "levels");
    }
}

typedef void wall_hook(struct sph *s);

static void at_walls(struct sph *s, wall_hook *hook)
{
    if (!hook)
        return;
    start(s, "walls");
    hook(s);
    stop(s, "walls");
}

/* A pass over the pairs: rows without ghosts while these are under way, then, when walls have seen
 * to theirs, the others. */
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

/* What follows the first pass and its halo. */
static void finish_slopes(struct sph *s)
{
    if (s->surface && !s->surface->known) {
        start(s, "surface");
        surface_detect(s);
        stop(s, "surface");
    }
    if (s->walls)
        at_walls(s, s->walls->model->slopes);
    if (s->walls || s->surface)
        transport_finish(s);
    if (s->surface && s->prm.damper > 0.0 && s->prm.scheme <= SCHEME_RIEMANN)
        surface_calm(s);
}

/* The acceleration -W^2 x. */
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

/* What follows the slopes of one level: of its deep guards these stay for the step. */
static void slopes_done(struct sph *s)
{
    finish_slopes(s);
    if (s->guards)
        guards_hold_edge(s);
    s->list->treated = s->list->nshallow;
}

/* All slopes, whatever the scheme needs; they serve the next step's first stage as well, where that
 * does the same and imposes nothing before. */
static void level_gradients(struct sph *s, bool shared)
{
    start(s, shared ? "gradients" : "output");
    domain_halo_start(s, false);
    domain_halo_finish(s, false);
    if (s->walls && s->walls->model->lines)
        s->walls->model->lines(s);
    scheme_gradients(s->dim, s->prm.transport)(s);
    stop(s, shared ? "gradients" : "output");
    slopes_done(s);
    s->sloped = shared;
}

void integrate_gradients(struct sph *s)
{
    const bool shared =
        !s->zones && s->scheme->gradients == scheme_gradients(s->dim, s->prm.transport);
    integrate_prepare(s);
    if (s->sloped)
        return;
    for (struct sph *q = s; q; q = q->finer)
        particles_lines(q);
    if (s->finer) {
        guards_update(s);
        guards_remember(s);
    }
    for (struct sph *q = s; q; q = q->finer)
        level_gradients(q, shared);
}

/* Walls, what is imposed, lines. */
static void begin_rates(struct sph *s)
{
    if (s->walls)
        walls_move(s, s->t);
    if (s->zones) {
        start(s, "zones");
        zones_stage(s);
        stop(s, "zones");
    }
    start(s, "update");
    if (!s->sloped)
        particles_lines(s);
    s->background = scheme_background(s);
    stop(s, "update");
}

/* Both passes and the walls, of one level. */
static void level_rates(struct sph *s)
{
    const struct wall_model *w = s->walls ? s->walls->model : NULL;
    if (s->scheme->gradients && !s->sloped) {
        pass(s, s->scheme->gradients, "gradients", false, w ? w->lines : NULL);
        slopes_done(s);
    }
    if (s->zones) {
        start(s, "zones");
        zones_slopes(s);
        stop(s, "zones");
    }
    s->sloped = false;
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
    if (s->central > 0.0)
        add_central(s);
    if (s->guards)
        guards_rates(s);
}

void integrate_rates(struct sph *s)
{
    const bool sloped = s->sloped;
    for (struct sph *q = s; q; q = q->finer)
        begin_rates(q);
    if (s->finer && !sloped)
        guards_update(s);
    if (s->finer)
        guards_forget(s);
    for (struct sph *q = s; q; q = q->finer)
        level_rates(q);
    if (s->finer) {
        start(s, "update");
        refinement_keep_mass(s);
        stop(s, "update");
    }
    for (struct sph *q = s->finer; q && s->walls; q = q->finer)
        forces_join_stage(s->walls, q->walls);
}

/* Velocities of displacement, from prim and slope: what the next step and its skin depend on. The
 * step is not bound by guards, which are moved alone. */
static void measure_level(const struct sph *s, double *most)
{
    const int dim = s->dim;
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i);
        const double *u0 = slope_line(&s->p, i) + dim + dim * dim;
        const double c = eos_c(q[at_rho(dim)], s->rho0, s->c0, s->gamma);
        double shift2 = 0.0, stray2 = 0.0, relative2 = 0.0;
        for (int a = 0; a < dim; a++) {
            shift2 += (q[dim + a] - u0[a]) * (q[dim + a] - u0[a]);
            stray2 += (u0[a] - s->drift[a]) * (u0[a] - s->drift[a]);
            relative2 += (q[dim + a] - s->drift[a]) * (q[dim + a] - s->drift[a]);
            raise(most + MOST_U0 + a, u0[a]);
            raise(most + LEAST_U0 + a, -u0[a]);
        }
        raise(most + MOST_STRAY, stray2);
        if (particles_is_guard(&s->p, i))
            continue;
        raise(most + MOST_C, c);
        raise(most + MOST_SHIFT, shift2);
        raise(most + MOST_SIGNAL, c + sqrt(shift2));
        raise(most + MOST_RELATIVE, relative2);
    }
    for (int k = 0; k < 3; k++) {
        static const int squared[3] = {MOST_SHIFT, MOST_STRAY, MOST_RELATIVE};
        most[squared[k]] = most[squared[k]] > 0.0 ? sqrt(most[squared[k]]) : 0.0;
    }
}

static void measure_lines(struct sph *s, double most[][EXTREMES])
{
    start(s, "update");
    for (const struct sph *q = s; q; q = q->finer)
        measure_level(q, most[q->level]);
    stop(s, "update");
}

static void measure_state(struct sph *s, double most[][EXTREMES])
{
    start(s, "update");
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            double speed, rho, *to = most[q->level];
            raise(to + MOST_FAULT, sph_fault_of(q, state_row(&q->p, q->p.y, i), &speed, &rho));
            raise(to + MOST_SPEED, speed);
            raise(to + MOST_RHO, rho);
            raise(to + LEAST_RHO, -rho);
        }
    stop(s, "update");
}

static void clear(double most[][EXTREMES])
{
    for (int l = 0; l < LEVELS; l++)
        for (int k = 0; k < EXTREMES; k++)
            most[l][k] = -1e300;
}

/* What a level knows of the whole flow; its signal is its own. */
static void learn(struct sph *s, const double *most, double signal)
{
    s->signal = signal;
    s->max_c = most[MOST_C];
    s->max_shift = most[MOST_SHIFT];
    s->stray = most[MOST_STRAY];
    for (int a = 0; a < s->dim; a++)
        s->drift[a] = 0.5 * (most[MOST_U0 + a] - most[LEAST_U0 + a]);
    s->max_speed = most[MOST_SPEED];
    s->rho_max = most[MOST_RHO];
    s->rho_min = -most[LEAST_RHO];
    /* 0.1 c0 is the speed that a sound speed is chosen for; transport_finish bounds what comes of
     * it at walls. */
    const double speed = s->walls ? fmax(s->max_speed, s->nu / s->R) : most[MOST_RELATIVE];
    const bool bounded = s->walls && s->prm.scheme <= SCHEME_RIEMANN;
    s->shift_speed =
        bounded ? 0.1 * s->c0 : fmin(fmax(s->shift_speed, speed), (s->walls ? 0.1 : 0.2) * s->c0);
    s->max_mach = fmax(s->max_mach, s->max_speed / s->c0);
    if (s->t >= 0.5 * s->run->scene.time.end)
        s->mach_late = fmax(s->mach_late, s->max_speed / s->c0);
}

/* most[0] gets the values over all levels and ranks. */
static void reduce(struct sph *s, double most[][EXTREMES])
{
    double signal[LEVELS];
    int n = 0;
    for (const struct sph *q = s; q; q = q->finer)
        n++;
    MPI_Allreduce(MPI_IN_PLACE, most, n * EXTREMES, MPI_DOUBLE, MPI_MAX, s->run->comm);
    for (int m = 0; m < n; m++) {
        signal[m] = most[m][MOST_SIGNAL];
        for (int k = 0; k < EXTREMES; k++)
            raise(most[0] + k, most[m][k]);
    }
    for (struct sph *q = s; q; q = q->finer)
        learn(q, most[0], signal[q->level]);
}

/* Largest step of the flow, all levels: one where nothing flows asks for none. */
static void plan_dt(struct sph *s)
{
    const double bodies = bodies_dt(s);
    s->dt_most = INFINITY;
    for (const struct sph *q = s; q; q = q->finer) {
        const char *by;
        const double dt =
            q->signal > 0.0 ? sph_params_dt(&q->prm, q->nu, q->signal, &by) : INFINITY;
        if (dt < s->dt_most) {
            s->dt_most = dt;
            s->limited_by = by;
        }
        if (2.2 * s->dt_most * q->stray > q->skin_most) {
            s->dt_most = q->skin_most / (2.2 * q->stray);
            s->limited_by = "speed";
        }
    }
    if (s->dt_most > bodies) {
        s->dt_most = bodies;
        s->limited_by = "body";
    }
    if (s->refinement && s->dt_most > regions_dt(s->refinement->regions)) {
        s->dt_most = regions_dt(s->refinement->regions);
        s->limited_by = "region";
    }
}

/* Two particles part by at most twice the stray velocity times dt; a tenth more, for it may grow.
 * Beyond the widest skin pairs would come together unseen: no step is longer than that. */
static void plan_next(struct sph *s)
{
    plan_dt(s);
    for (struct sph *q = s; q; q = q->finer) {
        q->dt_most = s->dt_most;
        if (q->walls)
            walls_expect_speed(q->walls);
        q->skin = fmax(2.2 * q->dt_most * q->stray, 0.01 * q->R);
        q->ready = false;
    }
}

void integrate_start(struct sph *s)
{
    for (struct sph *q = s; q; q = q->finer) {
        q->skin = 0.05 * q->R;
        q->ready = false;
    }
    if (s->zones && s->zones->update) /* what stands at open sides, for the first gradients */
        s->zones->update(s);
    for (int pass = 0; pass < 3; pass++) { /* the second knows the drift, the third the shift */
        double most[LEVELS][EXTREMES];
        for (struct sph *q = s; q && pass == 1; q = q->finer)
            q->shift_speed = 0.0; /* of the drift alone */
        integrate_gradients(s);
        clear(most);
        measure_lines(s, most);
        measure_state(s, most);
        reduce(s, most);
    }
    plan_next(s);
}

/* Steps of equal length to t_stop; the last lands on it. */
static double choose_dt(const struct sph *s, double t_stop, bool *last)
{
    const double left = t_stop - s->t, n = ceil(left / s->dt_most - 1e-9);
    *last = n <= 1.0;
    return *last ? left : left / n;
}

/* y = y0 + a rate. */
static void advance(struct sph *s, double a)
{
    const size_t n = (size_t)s->p.n * s->p.nstate;
    double *restrict y = s->p.y;
    const double *restrict y0 = s->p.y0, *restrict rate = s->p.rate;
    for (size_t i = 0; i < n; i++)
        y[i] = y0[i] + a * rate[i];
}

/* sum (+)= b rate; sum is there if a stage before the last counts. */
static void add_rates(struct sph *s, double b, bool first)
{
    const size_t n = (size_t)s->p.n * s->p.nstate;
    double *restrict sum = particles_sum(&s->p);
    const double *restrict rate = s->p.rate;
    for (size_t i = 0; i < n; i++)
        sum[i] = (first ? 0.0 : sum[i]) + b * rate[i];
}

static void update(struct sph *s, int k, double dt)
{
    const struct stages *c = s->stages;
    const bool summed = c->weight[0] != 0.0, last = k == c->n - 1;
    start(s, "update");
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

static void set_time(struct sph *s, double t)
{
    for (; s; s = s->finer)
        s->t = t;
}

/* The stages from s->t to t_end; most gets what the last one shows of velocities. */
static void take_stages(struct sph *s, double dt, double t_end, double most[][EXTREMES])
{
    const struct stages *c = s->stages;
    const double t = s->t;
    start(s, "update");
    for (struct sph *q = s; q; q = q->finer)
        memcpy(q->p.y0, q->p.y, (size_t)q->p.n * q->p.nstate * sizeof(double));
    stop(s, "update");
    bodies_begin(s);
    for (int k = 0; k < c->n; k++) {
        const double part = c->weight[k] * dt;
        set_time(s, c->at[k] == 1.0 ? t_end : t + c->at[k] * dt);
        integrate_rates(s);
        if (s->walls)
            forces_stage(s, part);
        bodies_stage(s, part);
        sph_watch_stage(s, k == 0, part);
        if (k == c->n - 1)
            measure_lines(s, most);
        for (struct sph *q = s; q; q = q->finer)
            update(q, k, dt);
        bodies_advance(s, c->ahead[k] * dt, part, k == c->n - 1);
    }
    set_time(s, t_end);
    for (struct sph *q = s; q; q = q->finer) {
        collisions_apply(q);
        if (q->walls) /* what follows meets them where the step ends */
            walls_move(q, t_end);
    }
}

/* Particles beyond a side where nothing holds them; returns their number. */
static int remove_lost(struct sph *s)
{
    const int before = s->p.n;
    int n = 0;
    for (int i = 0; i < before; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        bool inside = true;
        for (int a = 0; a < s->dim; a++)
            inside = inside && (s->periodic[a] || !(y[a] < s->lo[a] || y[a] > s->hi[a]));
        if (inside)
            particles_copy(&s->p, n++, i);
        else
            sph_watch_removed(s, i);
    }
    s->p.n = n;
    return before - n;
}

/* Particles that walls have let through are put back; removed are those too far behind. Returns
 * their number. */
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

/* What follows the stages: imposed values, births and removals. */
static void finish_step(struct sph *s, double dt, double *most, struct diagnosis *d)
{
    if (s->zones) {
        start(s, "zones");
        zones_stage(s); /* buffer particles end the step with what is imposed, volumes too */
        zones_blend(s);
        zones_openings(s, dt);
        stop(s, "zones");
    }
    if (s->finer) {
        refinement_look(s);
        start(s, "update");
        for (struct sph *q = s; q; q = q->finer) /* guards that wake now are as the others are */
            particles_lines(q);
        stop(s, "update");
        guards_update(s); /* its lists know nothing of removals */
    }
    int lost = 0;
    for (struct sph *q = s; q; q = q->finer)
        lost += remove_behind(q) + remove_lost(q);
    s->lost += lost;
    raise(most + MOST_LOST, lost);
    for (struct sph *q = s->finer; q && s->walls; q = q->finer)
        forces_join_step(s->walls, q->walls);
    if (s->walls)
        forces_step(s, dt);
    bodies_finish(s, d);
    volume_keep(s);
    if (s->finer) {
        refinement_adapt(s);
        start(s, "levels");
        refinement_repay(s);
        volume_renew(s);
        stop(s, "levels");
    }
}

/* The first time, and whenever the number has grown tenfold. */
static void report_lost(struct sph *s, double lost)
{
    double sum = s->lost;
    if (lost <= 0.0)
        return;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    if (sum < 10.0 * s->lost_said)
        return;
    s->lost_said = sum;
    log_warn("t = %g s: %.0f particle(s) left the region at an open side since the start", s->t,
             sum);
}

/* Mass of the region: particles, and what the faces hold of particles that are partly in. */
static void track_mass(struct sph *s)
{
    const double m = zones_mass(s);
    raise(&s->fluctuation_particles, fabs(m / s->mass0 - 1.0));
    raise(&s->fluctuation, fabs((m + openings_held(s)) / s->mass0 - 1.0));
}

static void judge(struct sph *s, double fault, struct diagnosis *d)
{
    const double nominal = sph_params_dt(&s->prm, s->nu, s->c0, NULL);
    if (fault > 1.0)
        sph_fault_diagnose(s, d);
    else if (!(s->dt_most >= 1e-6 * nominal)) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason,
                 "the time step fell to %g s, a millionth of R/c0 is the limit", s->dt_most);
        snprintf(d->where, sizeof d->where, "c + |u - u0| reaches %g m/s", s->signal);
        snprintf(d->likely, sizeof d->likely,
                 "the state has broken down before: look at the last snapshots");
    }
    if (!d->bad)
        sph_watch_judge(s, d);
    else if (s->run->summary)
        sph_watch_summarise(s);
    s->broken = d->bad;
}

static void count_pairs(struct sph *s)
{
    if (s->pairs_now == 0 || s->run->step % COUNT_EVERY == 0) {
        s->pairs_now = 0;
        for (const struct sph *q = s; q; q = q->finer)
            s->pairs_now += neighbours_pairs(q);
    }
    s->pairs += s->stages->n * s->pairs_now;
}

double integrate_step(struct sph *s, double t_stop, struct diagnosis *d)
{
    bool last;
    double most[LEVELS][EXTREMES];
    const double wall = wall_time(), cpu = cpu_time();
    /* A coupled run cuts anew between windows only: within one, a rank holds the patch of its part.
     */
    if (!s->run->coupled && s->run->step % BALANCE_EVERY == 0) {
        integrate_prepare(s); /* the list tells what a particle costs */
        domain_balance(s, 0.03);
    }
    sph_watch_begin(s);
    s->dt = choose_dt(s, t_stop, &last);
    const double t_end = last ? t_stop : s->t + s->dt;
    integrate_prepare(s);
    count_pairs(s);
    clear(most);
    take_stages(s, s->dt, t_end, most);
    finish_step(s, s->dt, most[0], d);
    measure_state(s, most);
    reduce(s, most);
    plan_next(s);
    report_lost(s, most[0][MOST_LOST]);
    if (s->zones)
        track_mass(s);
    judge(s, most[0][MOST_FAULT], d);
    s->wall_s += wall_time() - wall;
    s->cpu_s += cpu_time() - cpu;
    return s->dt;
}

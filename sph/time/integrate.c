/* integrate.c - time step size [2.102-2.104] (Chiron 2017), stages of a Runge-Kutta scheme, and the
 * watch over what comes out of it. dt is the least of cfl R/max(c + |u - u0|), cfl_viscous R^2/nu,
 * the bodies' and the regions' bounds, and what the widest skin allows. The list of pairs and the
 * ghosts are made once a step; the skin covers the distance that particles go within it. Order of
 * the file: what a stage needs, planning of the next step, stages, end of a step, watch.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "integrate.h"

#include "../bodies/sph_bodies.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../sph.h"
#include "../walls/sph_walls.h"
#include "extremes.h"
#include "level.h"
#include "local_steps.h"
#include "runge_kutta.h"

enum { BALANCE_EVERY = 50, COUNT_EVERY = 20 };

static void start(struct sph *s, const char *timer) { timer_start(&s->run->timers, timer); }

static void stop(struct sph *s, const char *timer) { timer_stop(&s->run->timers, timer); }

/* All levels are prepared together, since guards list particles of two levels. After it lists,
 * ghosts, lists of walls and of guards belong to the positions of y. */
void integrate_prepare(struct sph *s)
{
    bool ready = true;
    for (const struct sph *q = s; q; q = q->finer)
        ready = ready && q->lists.ready;
    if (s->finer && !ready)
        guards_come_back(s);
    for (struct sph *q = s; q && !ready; q = q->finer)
        level_prepare(q);
    if (s->finer && !ready) {
        start(s, "levels");
        guards_list(s);
        counts_mark(s);
        stop(s, "levels");
    }
}

/* If the case has neither zones nor other slopes than the scheme's, the next step's first stage
 * takes the result as it is; otherwise it is thrown away. */
void integrate_gradients(struct sph *s)
{
    const bool shared =
        !s->zones && s->scheme->gradients == scheme_gradients(s->dim, s->prm.transport);
    integrate_prepare(s);
    if (s->lists.sloped)
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

/* One stage of all levels at the same time s->t. Guards get their fields between the packing of
 * records and the first pass, which reads them. */
void integrate_rates(struct sph *s)
{
    const bool sloped = s->lists.sloped;
    for (struct sph *q = s; q; q = q->finer)
        level_begin_rates(q);
    if (s->finer && !sloped) {
        guards_come_back(s); /* slopes made for an output stay out */
        guards_update(s);
    }
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

/* Largest step of the flow, all levels: one where nothing flows asks for none. Also records what
 * bounds it, for the series and for messages. */
static void plan_dt(struct sph *s)
{
    const double bodies = bodies_dt(s);
    s->step.dt_most = INFINITY;
    for (const struct sph *q = s; q; q = q->finer) {
        const char *by;
        const double dt = level_dt(q, &by);
        if (dt < s->step.dt_most) {
            s->step.dt_most = dt;
            s->step.limited_by = by;
            s->step.limited_level = q->level;
        }
    }
    if (s->step.dt_most > bodies) {
        s->step.dt_most = bodies;
        s->step.limited_by = "body";
    }
    if (s->refinement && s->step.dt_most > regions_dt(s->refinement->regions)) {
        s->step.dt_most = regions_dt(s->refinement->regions);
        s->step.limited_by = "region";
    }
}

/* Two particles part by at most twice the stray velocity times dt; a tenth more, for it may grow.
 * Beyond the widest skin pairs would come together unseen: no step is longer than that. The least
 * skin, 0.01 R, keeps lists alive for fluid at rest. */
static void plan_next(struct sph *s)
{
    if (s->refinement && s->local_steps) {
        local_steps_plan(s);
        return;
    }
    plan_dt(s);
    for (struct sph *q = s; q; q = q->finer) {
        q->step.dt_most = s->step.dt_most;
        if (q->walls)
            walls_expect_speed(q);
        q->lists.skin =
            fmax(2.2 * q->step.dt_most * q->step.stray, 0.01 * (q->mixed ? mixed_least(q) : q->R));
        q->lists.ready = false;
    }
}

/* The drift, the shift and the stray velocity depend on each other, hence three passes over the
 * first state; nothing is moved. */
void integrate_start(struct sph *s)
{
    for (struct sph *q = s; q; q = q->finer) {
        q->lists.skin = 0.05 * (q->mixed ? mixed_least(q) : q->R);
        q->lists.ready = false;
    }
    if (s->zones && s->zones->update) /* what stands at open sides, for the first gradients */
        s->zones->update(s);
    for (int pass = 0; pass < 3; pass++) { /* the second knows the drift, the third the shift */
        double most[LEVELS][EXTREMES];
        for (struct sph *q = s; q && pass == 1; q = q->finer)
            q->step.shift_speed = 0.0; /* of the drift alone */
        integrate_gradients(s);
        extremes_clear(most);
        for (struct sph *q = s; q; q = q->finer) {
            extremes_of_lines(q, most[q->level]);
            extremes_of_state(q, most[q->level]);
        }
        extremes_reduce(s, most);
    }
    plan_next(s);
}

/* Steps of equal length up to t_stop, none longer than dt_most; the last one lands on t_stop
 * exactly. 1e-9 of a step too much is no reason for one more. */
static double choose_dt(const struct sph *s, double t_stop, bool *last)
{
    const double left = t_stop - s->t, n = ceil(left / s->step.dt_most - 1e-9);
    *last = n <= 1.0;
    return *last ? left : left / n;
}

static void set_time(struct sph *s, double t)
{
    for (; s; s = s->finer)
        s->t = t;
}

/* The stages from s->t to t_end; most gets what the last one shows of velocities. dt = t_end - s->t
 * but for rounding. After each stage's rates, and before y changes: paddles read the level, forces
 * and work are summed with the stage's weight, bodies move as far as the particles do. */
static void take_stages(struct sph *s, double dt, double t_end, double most[LEVELS][EXTREMES])
{
    const struct rk_stages *c = s->stages;
    const double t = s->t;
    start(s, "update");
    for (struct sph *q = s; q; q = q->finer) {
        q->lists.pulled = false;
        q->dt = dt; /* walls of every level bound their waves, and what comes near them, by it */
        memcpy(q->p.y0, q->p.y, (size_t)q->p.n * q->p.nstate * sizeof(double));
    }
    stop(s, "update");
    bodies_begin(s);
    for (int k = 0; k < c->n; k++) {
        const double part = c->weight[k] * dt;
        set_time(s, c->at[k] == 1.0 ? t_end : t + c->at[k] * dt);
        integrate_rates(s);
        if (k == 0)
            paddles_steer(s, dt);
        body_seals_add(s);
        if (s->walls)
            forces_stage(s, part);
        bodies_stage(s, part);
        sph_watch_stage(s, k == 0, part);
        for (struct sph *q = s; q && k == c->n - 1; q = q->finer)
            extremes_of_lines(q, most[q->level]);
        for (struct sph *q = s; q; q = q->finer)
            level_update(q, k, dt);
        bodies_advance(s, c->ahead[k] * dt, part, k == c->n - 1);
    }
    set_time(s, t_end);
    for (struct sph *q = s; q; q = q->finer) {
        collisions_apply(q);
        if (q->walls) /* what follows meets them where the step ends */
            walls_move(q, t_end);
    }
}

/* What regions follow, and guards with the state at the end of the step: slopes, marks of the
 * surface and lists of guards know nothing of births and removals. With local steps guards have
 * been updated already. */
static void look_at_levels(struct sph *s)
{
    if (s->refinement)
        refinement_look(s);
    if (!s->finer)
        return;
    start(s, "update");
    for (struct sph *q = s; q; q = q->finer) /* guards that wake now are as the others are */
        particles_lines(q);
    stop(s, "update");
    if (!s->local_steps)
        guards_wake(s);
}

/* What follows the stages: imposed values, births and removals; lost: this rank had lost so many
 * before the step. Order: imposed values; what regions and guards follow; openings, which add and
 * remove particles; what has left; sums of forces; bodies; the volume of a closed room; at last
 * creations and removals by levels, which use the slopes of the last stage and make the lists
 * stale. */
static void finish_step(struct sph *s, double dt, double lost, double *most, struct diagnosis *d)
{
    if (s->zones) {
        start(s, "zones");
        zones_stage(s); /* buffer particles end the step with what is imposed, volumes too */
        zones_blend(s);
        zone_volumes_step(s, dt);
        box_motion_step(s, dt, d);
        stop(s, "zones");
    }
    look_at_levels(s);
    if (s->zones) {
        start(s, "zones");
        zones_openings(s, dt);
        stop(s, "zones");
    }
    for (struct sph *q = s; q; q = q->finer)
        s->total.lost += level_clean(q);
    extremes_raise(most + MOST_LOST, s->total.lost - lost);
    for (struct sph *q = s->finer; q && s->walls; q = q->finer)
        forces_join_step(s->walls, q->walls);
    if (s->walls)
        forces_step(s, dt);
    bodies_finish(s, d);
    volume_keep(s);
    shut_waters_keep(s);
    if (s->finer) {
        refinement_adapt(s);
        start(s, "levels");
        refinement_restore_momentum(s);
        refinement_restore_mass(s);
        volume_renew(s);
        stop(s, "levels");
    }
    if (s->mixed) {
        mixed_adapt(s);
        volume_renew(s);
    }
}

/* Of all ranks: particles that were removed behind walls, and where one of the first was.
 * Collective. */
static int64_t gone_behind(const struct sph *s, double at[3])
{
    int64_t n = 0;
    bool any = false;
    memset(at, 0, 3 * sizeof *at);
    for (const struct sph *q = s; q; q = q->finer)
        if (q->walls && q->walls->gone > 0) {
            n += q->walls->gone;
            memcpy(at, q->walls->gone_at, 3 * sizeof *at);
            any = true;
        }
    (void)ranks_first(s->run->comm, any, at, 3 * sizeof *at);
    return ranks_count(s->run->comm, n);
}

/* Through which side a particle at x has left, and whether that is a wall. If it has crossed
 * several, the last axis counts. A name, and `wall' set; "a side" where it is beyond none. */
static const char *side_left(const struct sph *s, const double *x, bool *wall)
{
    int side = -1;
    for (int a = 0; a < s->dim; a++)
        side = s->periodic[a] ? side : x[a] < s->lo[a] ? 2 * a : x[a] > s->hi[a] ? 2 * a + 1 : side;
    const struct scene_wall *is =
        side >= 0 ? scene_wall_of(&s->run->scene, SIDE_X_MIN + side) : NULL;
    *wall = is && !s->open[side] && (is->kind == WALL_SLIP || is->kind == WALL_NO_SLIP);
    return side >= 0 ? scene_side_names[side] : "a side";
}

/* Warns that `n' particles have left the region, with the place of the first one that a rank knows.
 * Collective. */
static void say_left(const struct sph *s, double n)
{
    double at[3] = {0.0, 0.0, 0.0};
    bool any = false, wall;
    for (const struct sph *q = s; q; q = q->finer)
        if (q->total.lost_any && !any) {
            memcpy(at, q->total.lost_at, sizeof at);
            any = true;
        }
    (void)ranks_first(s->run->comm, any, at, sizeof at);
    const char *side = side_left(s, at, &wall);
    log_warn("t = %g s: %.0f particle(s) left the region since the start, the first across %s at "
             "(%g, %g, %g) m%s",
             s->t, n, side, at[0], at[1], at[2], wall ? ", which is a wall: refine sph.dx" : "");
}

/* The first time, whenever the number has grown tenfold, and when nothing is left. `lost': of this
 * step, the maximum over ranks, so that all of them go in or none. */
static void report_lost(struct sph *s, double lost)
{
    double sums[2] = {s->total.lost, 0.0};
    if (lost <= 0.0)
        return;
    for (const struct sph *q = s; q; q = q->finer)
        sums[1] += q->p.n;
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double sum = sums[0];
    if (sums[1] == 0.0)
        log_warn("t = %g s: all particles have left the region: the run goes on without fluid",
                 s->t);
    if (sum < 10.0 * s->total.lost_said)
        return;
    s->total.lost_said = sum;
    double at[3];
    const int64_t behind = gone_behind(s, at);
    if (behind > 0)
        log_warn("t = %g s: %.0f particle(s) left the region since the start, %.0f of them behind "
                 "walls, the first at (%g, %g, %g) m, and are out of the run: %s",
                 s->t, sum, (double)behind, at[0], at[1], at[2],
                 s->dim == 2 ? "a line has no wall on its back; where water may come round it draw "
                               "both of its faces"
                             : "where water may come round an open mesh give it both faces, or "
                               "thin = true");
    else
        say_left(s, sum);
}

/* Mass of the region: particles, and what the faces hold of particles that are partly in. */
static void track_mass(struct sph *s)
{
    const double m = zones_mass(s);
    extremes_raise(&s->total.fluctuation_particles, fabs(m / s->start.mass - 1.0));
    extremes_raise(&s->total.fluctuation, fabs((m + openings_held(s)) / s->start.mass - 1.0));
}

/* The state is bad if a particle is beyond its limits or if the step has collapsed; else the
 * watches have their say. broken keeps anything from being made of such a state later.
 * Collective. */
static void judge(struct sph *s, double fault, struct diagnosis *d)
{
    const double nominal = sph_params_dt(&s->prm, s->nu, s->c0, NULL);
    const struct sph *level = s;
    while (level->finer && level->level < s->step.limited_level)
        level = level->finer;
    if (fault > 1.0)
        sph_fault_diagnose(s, d);
    else if (!(s->step.dt_most >= 1e-6 * nominal)) {
        d->bad = true;
        snprintf(d->reason, sizeof d->reason,
                 "the time step fell to %g s, a millionth of R/c0 is the limit", s->step.dt_most);
        snprintf(d->where, sizeof d->where, "c + |u - u0| reaches %g m/s%s", level->step.signal,
                 sph_level_name(level));
        snprintf(d->likely, sizeof d->likely,
                 "the state has broken down before: look at the last snapshots");
    }
    if (!d->bad)
        sph_watch_judge(s, d);
    else if (s->run->summary)
        sph_watch_summarise(s);
    s->lists.broken = d->bad;
}

/* Counts pairs every 20 steps and takes that number for the others: it is for figures of throughput
 * only. */
static void count_pairs(struct sph *s)
{
    if (s->total.pairs_now == 0 || s->run->step % COUNT_EVERY == 0) {
        s->total.pairs_now = 0;
        for (const struct sph *q = s; q; q = q->finer)
            s->total.pairs_now += neighbours_pairs(q);
    }
    s->total.pairs += s->stages->n * s->total.pairs_now;
}

/* The partition is balanced before the step's lists are made and uses the work that the last list
 * shows; cutting clears `ready', so integrate_prepare then migrates the particles. Everything after
 * finish_step speaks of the state at t_end. */
double integrate_step(struct sph *s, double t_stop, struct diagnosis *d)
{
    bool last;
    double most[LEVELS][EXTREMES];
    const double wall = wall_time(), cpu = cpu_time(), lost = s->total.lost;
    /* A coupled run cuts anew between windows only: within one, a rank holds the patch of its part.
     */
    if (!(s->run->coupled && s->run->scene.has_fv) && s->run->step % BALANCE_EVERY == 0) {
        integrate_prepare(s); /* the list tells what a particle costs */
        domain_balance(s, 0.03);
    }
    sph_watch_begin(s);
    s->dt = choose_dt(s, t_stop, &last);
    const double t_end = last ? t_stop : s->t + s->dt;
    integrate_prepare(s);
    extremes_clear(most);
    if (s->refinement && s->local_steps) {
        local_steps_take(s, t_end, most);
    } else {
        count_pairs(s);
        take_stages(s, s->dt, t_end, most);
    }
    finish_step(s, s->dt, lost, most[0], d);
    for (struct sph *q = s; q; q = q->finer)
        extremes_of_state(q, most[q->level]);
    extremes_reduce(s, most);
    plan_next(s);
    report_lost(s, most[0][MOST_LOST]);
    if (s->zones)
        track_mass(s);
    judge(s, most[0][MOST_FAULT], d);
    s->total.wall_s += wall_time() - wall;
    s->total.cpu_s += cpu_time() - cpu;
    return s->dt;
}

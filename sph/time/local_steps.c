/* local_steps.c - see local_steps.h. The recursion over levels is that of Berger & Oliger (J.
 * Comput. Phys. 53, 1984) with particles for cells. A step of the coarsest level is a tree of
 * calls: take() advances a level by one step, then take_finer() fills that time with steps of the
 * next level, each by take(). A finer level so always moves between two states of the coarser one
 * that are known, y0 and y; show_coarser interpolates them linearly. Levels meet at the ends of
 * these steps, when lists and guards are made anew.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "local_steps.h"

#include "../bodies/sph_bodies.h"
#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../walls/sph_walls.h"
#include "level.h"
#include "runge_kutta.h"

enum { COUNT_EVERY = 20 };

/* What signals have grown by since the steps of the coarser levels were chosen does not bind those
 * of the finer ones up to this share: else it would be three instead of two. */
static const double slack = 1.05;

/* What the levels share during a step of the coarsest one. */
struct common {
    struct sph *coarsest;
    double (*most)[EXTREMES];
    double gained; /* kg: mass of what flows, by fluxes from guards; this rank */
    bool broken;
};

/* Largest step of a level now. A region that moves is looked at whenever the level outside of it
 * has made a step. A level of guards alone has no signal of its own: they go with what flows in
 * the next finer one, whose sound would bind them to twice its step. */
static double bound_of(const struct sph *s, const struct sph *coarsest, const char **by)
{
    const double regions = regions_dt_outside(coarsest->refinement->regions, s->level);
    double dt = level_dt(s, by);
    if (s->step.signal <= 0.0 && s->finer)
        dt = fmin(dt, 2.0 * bound_of(s->finer, coarsest, by));
    if (dt <= regions)
        return dt;
    *by = "region";
    return regions;
}

/* For steps of at most dt: two particles part by at most twice the stray velocity times that. */
static void expect_step(struct sph *s, double dt)
{
    s->step.dt_most = dt;
    if (s->walls)
        walls_expect_speed(s);
    s->lists.skin = fmin(fmax(2.2 * dt * s->step.stray, 0.01 * s->R), s->lists.skin_most);
    s->lists.ready = false;
}

/* dt of the coarsest is the least over levels of the level's own bound times the number of its
 * steps within a coarsest one, rounded to whole ratios. */
void local_steps_plan(struct sph *s)
{
    double most = INFINITY, coarser = INFINITY, steps = 1.0;
    for (struct sph *q = s; q; q = q->finer) {
        const char *by;
        const double dt = bound_of(q, s, &by), next = fmin(dt, coarser);
        if (isfinite(coarser))
            steps *= fmax(1.0, round(coarser / next));
        coarser = next;
        if (steps * dt < most) {
            most = steps * dt;
            s->step.limited_by = by;
            s->step.limited_level = q->level;
        }
    }
    for (struct sph *q = s; q; q = q->finer) {
        const char *by;
        expect_step(q, fmin(most, slack * bound_of(q, s, &by)));
    }
}

/* The coarser level's lines between both ends of its step, at the time of s. It overwrites the
 * records of the coarser level: its own next stage packs them anew. */
static void show_coarser(struct sph *s)
{
    struct sph *c = s->coarser;
    timer_start(&s->run->timers, "update");
    particles_lines_between(c, 1.0 - (c->t - s->t) / c->dt);
    timer_stop(&s->run->timers, "update");
    guards_share(c, false);
}

/* Lists, and fields of all guards, of a level and all finer ones, which stand at the same time.
 * expect_step widens the skins for the steps to come, and lists of all finer levels are made anew,
 * for they read each other's particles. */
static void meet(struct sph *s, const struct common *all, double dt)
{
    const char *by;
    if (s->coarser ? s->lists.ready
                   : s->lists.sloped) /* that has been done with a coarser one, or for output */
        return;
    if (s->coarser) {
        for (struct sph *q = s; q; q = q->finer) {
            expect_step(q, fmin(dt, slack * bound_of(q, all->coarsest, &by)));
            level_prepare(q);
        }
        show_coarser(s);
        timer_start(&s->run->timers, "levels");
        guards_list(s);
        counts_mark(s);
        timer_stop(&s->run->timers, "levels");
    } else {
        for (struct sph *q = s; q; q = q->finer)
            level_begin_rates(q);
        guards_come_back(s);
    }
    guards_update(s);
}

/* As in integrate.c, summed over the steps of all levels. */
static void count_pairs(struct sph *s, struct sph *coarsest)
{
    if (s->total.pairs_now == 0 || s->run->step % COUNT_EVERY == 0)
        s->total.pairs_now = neighbours_pairs(s);
    coarsest->total.pairs += s->stages->n * s->total.pairs_now;
}

/* Mass, kg, that flowing particles of this level have gained since y0, by fluxes from guards; this
 * rank. Guards give nothing back, so the excess is spread over the flow at the end. */
static double gain(const struct sph *s)
{
    const int at = at_mass(s->dim), row = s->p.nstate;
    double sum = 0.0;
    for (int i = 0; i < s->p.n; i++)
        if (!particles_is_guard(&s->p, i))
            sum += s->p.y[(size_t)row * i + at] - s->p.y0[(size_t)row * i + at];
    return sum;
}

/* One level from s->t to t_end, all stages; guards at its edge follow the coarser level between
 * them. Deep guards keep the fields they got when levels met. */
static void take_stages(struct sph *s, double t_end, struct common *all)
{
    const struct rk_stages *c = s->stages;
    const double t = s->t, dt = t_end - t;
    s->dt = dt;
    s->lists.pulled = false;
    memcpy(s->p.y0, s->p.y, (size_t)s->p.n * s->p.nstate * sizeof(double));
    for (int k = 0; k < c->n; k++) {
        s->t = c->at[k] == 1.0 ? t_end : t + c->at[k] * dt;
        if (k > 0) {
            level_begin_rates(s);
            if (s->coarser) {
                show_coarser(s);
                guards_update_edge(s);
            }
        }
        level_rates(s);
        if (!s->coarser)
            body_seals_add(s);
        if (s->walls)
            forces_stage(s, c->weight[k] * dt);
        if (!s->coarser)
            sph_watch_stage(s, k == 0, c->weight[k] * dt);
        if (k == c->n - 1)
            extremes_of_lines(s, all->most[s->level]);
        level_update(s, k, dt);
    }
    s->t = t_end;
    collisions_apply(s);
    if (s->walls)
        walls_move(s, t_end);
    /* before creations and removals, which would be counted as gains */
    all->gained += gain(s);
}

/* What the level shows at the end of its step; it may have to take shorter ones. A collective
 * reduction, so that all ranks choose the same number of steps for it afterwards, and stop together
 * when the state has broken down. */
static void look_at(struct sph *s, struct common *all)
{
    double now[EXTREMES];
    extremes_of_state(s, all->most[s->level]);
    memcpy(now, all->most[s->level], sizeof now);
    extremes_reduce_level(s, now);
    all->broken = all->broken || now[MOST_FAULT] > 1.0;
}

static void take(struct sph *s, double t_end, struct common *all);

/* The steps of the next level within the last one of s: as many as its bound asks for now, each
 * decided anew, so that a level that speeds up gets shorter ones. */
static void take_finer(struct sph *s, struct common *all)
{
    struct sph *q = s->finer;
    guards_share(s, true); /* those of the last stage serve for all of the step */
    while (q->t < s->t && !all->broken) {
        const char *by;
        const double left = s->t - q->t;
        const double n = ceil(left / (slack * bound_of(q, all->coarsest, &by)));
        take(q, n > 1.0 ? q->t + left / n : s->t, all);
    }
}

/* Advances a level to t_end and all finer ones, which stand at the same time, with it; then removes
 * and adapts particles of the level, unless it is the coarsest, which integrate.c does. */
static void take(struct sph *s, double t_end, struct common *all)
{
    meet(s, all, t_end - s->t);
    count_pairs(s, all->coarsest);
    take_stages(s, t_end, all);
    look_at(s, all);
    if (s->finer)
        take_finer(s, all);
    if (!s->coarser || all->broken)
        return;
    all->coarsest->total.lost += level_clean(s);
    if (s->finer)
        refinement_adapt_finer(all->coarsest, s);
    s->lists.ready = false;
}

void local_steps_take(struct sph *s, double t_end, double most[LEVELS][EXTREMES])
{
    struct common all = {.coarsest = s, .most = most};
    s->refinement->grown = 0.0;
    take(s, t_end, &all);
    guards_forget(s);
    for (struct sph *q = s; q; q = q->finer)
        q->t = t_end; /* a level that has broken down may not have come so far */
    refinement_spread_mass(s, all.gained);
    volume_change(s, s->refinement->grown);
}

/* sph_watch.c - energy against its budget, speeds, returned, paired and overlapping particles.
 *
 * Energy: kinetic, elastic and potential (gravity across bounded axes, central force). Outside work
 * is that of a body force along periodic axes, g.sum(m u), and of moving walls: of bodies the force
 * that the fluid loses to them, of walls that slide the momentum that they give to each particle,
 * times their velocity there, by the weights of the stages. What is left over may only fall. A gain
 * is measured by the kinetic energy and a twentieth of what the scene lets expect, M (U^2 +
 * p/rho)/20: a tank at rest has its hydrostatic scale, so that noise of 1e-3 sqrt(g H) is no alarm
 * and a flow of sqrt(g H)/30 that nothing drives is. A flow that creeps has the elastic energy of
 * its pressures, M p^2/(rho c0)^2, beside. The work of moving walls is known to some percent only,
 * for the division by gamma is theirs, too: five times its size is added to the scale, and the
 * warning comes at 3 % instead of 1 %. The energy that particles took out of the domain is added
 * once: they leave neighbours without a jet to lean on, which gain some thousandths of it.
 *
 * Particles behind walls: where water splashes impacts press some through, and they come back to a
 * jet that is none the worse; a fluid that fills its room has no reason to.
 *
 * Not judged: openings and partners, which carry energy in and out, and moving walls made of
 * ghosts, whose forces are not told from those of particles.
 *
 * A sample is taken in the first stage of every tenth step (of the state at its start) and judged
 * when the step is complete, by one reduction over all ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_watch.h"

#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../sph.h"
#include "../walls/sph_walls.h"

/* Of g dx: rows at the surface and at walls find their places within some hundredths of dx, up as
 * well as down. Of water a row deep that is a tenth of all the energy it has. */
#define SETTLES 0.3

enum { HISTORY = WATCH_STEPS / SPH_WATCH_EVERY };
/* What is summed over particles and ranks. */
enum { ENERGY, KINETIC, POWER, WALL_WORK, REMOVED, PUT_BACK, PAIRED, CROWDED, COUNTED };

static const double near_pair = 0.1; /* dx: closer than that two particles are one */

/* Whether some particle has both a side that slides and the opposite one within R: what either
 * gives it is one sum then, and the work of the moving one cannot be told. */
static bool is_slit(const struct scene *c, const struct sph_params *prm)
{
    bool any = false;
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *w = c->walls + k;
        const int a = (w->side - SIDE_X_MIN) / 2;
        const double *u = w->velocity;
        if (w->side != SIDE_NONE && (u[0] != 0.0 || u[1] != 0.0 || u[2] != 0.0))
            any = any || c->domain.max[a] - c->domain.min[a] < 2.0 * prm->R_dx * prm->dx;
    }
    return any;
}

/* Whether all work that is done on the flow can be told. Guards of refined levels take part in that
 * of walls that move. */
static bool is_closed(const struct run *r, const struct sph_params *prm)
{
    const bool known = prm->walls == WALLS_NFM && !apr_params_of(r);
    return !(r->coupled && r->scene.has_fv) && prm->outer == OUTER_NONE &&
           (!sph_watch_moves(&r->scene) || known) && !is_slit(&r->scene, prm);
}

/* The advice where particles form pairs, by what the case uses already. */
static const char *clump_remedy(const struct sph_params *prm)
{
    if (prm->transport != TRANSPORT_TVS)
        return "particles clump: set sph.transport = \"tvs\"";
    if (!sph_params_is_riemann(prm->scheme))
        return "particles clump: take a Riemann scheme";
    return "particles clump, as in sheets of few particles: refine sph.dx";
}

/* Levels of warning and stopping: a Mach number of 0.3 compresses by about 5 %, of 1 the equation
 * of state means nothing any more; energy is watched over 100 steps. */
void sph_watch_create(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    const struct scene_speed v = s->prm.speed;
    double still[3];
    w->reference = v.speed;
    w->rest = v.pressure / (s->c0 * s->c0);
    w->friction = v.viscous / (s->c0 * s->c0);
    w->settles = s->surface ? SETTLES * scene_still_gravity(&s->run->scene, still) * s->dx : 0.0;
    w->budget_closed = is_closed(s->run, &s->prm);
    snprintf(w->remedy[REMEDY_C0], sizeof w->remedy[REMEDY_C0],
             "sph.c0 = %.4g m/s is too low for this flow: raise it to ten times the largest speed",
             s->c0);
    snprintf(w->remedy[REMEDY_DX], sizeof w->remedy[REMEDY_DX],
             "refine sph.dx = %.4g m, lower sph.cfl = %.3g, or raise sph.c0 = %.4g m/s", s->dx,
             s->prm.cfl, s->c0);
    snprintf(w->remedy[REMEDY_WALLS], sizeof w->remedy[REMEDY_WALLS],
             "particles pass the walls and are returned: refine sph.dx = %.4g m, or try another "
             "sph.walls",
             s->dx);
    snprintf(w->remedy[REMEDY_SCHEME], sizeof w->remedy[REMEDY_SCHEME],
             "this scheme damps too little: take a Riemann scheme, or refine sph.dx = %.4g m",
             s->dx);
    w->of[SPH_WATCH_MACH] = (struct watch){.key = "mach",
                                           .what = "largest |u| over the speed of sound",
                                           .likely = w->remedy[REMEDY_C0],
                                           .warn = 0.3,
                                           .stop = 1.0};
    w->of[SPH_WATCH_ENERGY] = (struct watch){
        .key = "energy_gain",
        .what = "energy that the flow gained beyond the work done on it in 100 steps, over its "
                "kinetic energy and 5 % of that of the reference speed",
        .likely = w->remedy[REMEDY_DX],
        .warn = sph_watch_moves(&s->run->scene) ? 0.03 : 0.01,
        .stop = 0.1};
    w->of[SPH_WATCH_PAIRED] = (struct watch){.key = "paired",
                                             .what = "share of particles within 0.1 dx of another",
                                             .likely = clump_remedy(&s->prm),
                                             .warn = 0.4,
                                             .stop = 0.9};
    w->of[SPH_WATCH_PUT_BACK] =
        (struct watch){.key = "put_back",
                       .what = "share of particles returned from behind walls in 100 steps",
                       .likely = w->remedy[REMEDY_WALLS],
                       .warn = s->surface ? 0.5 : 0.1,
                       .stop = s->surface ? 5.0 : 1.0};
    w->of[SPH_WATCH_CROWDED] =
        (struct watch){.key = "crowded",
                       .what = "share of particles that overlap others of their level",
                       .likely = w->crowd_place,
                       .warn = 0.1,
                       .stop = INFINITY};
    w->of[SPH_WATCH_FORCES] = (struct watch){
        .key = "rest_forces",
        .what = "difference of the force on a body in water at rest from the average "
                "of the pressure on it, over pressure times area",
        .likely = w->still_place,
        .warn = 0.05,
        .stop = INFINITY,
        .unsound = INFINITY};
    sph_sound_create(s);
}

/* Nothing is computed in steps that take no sample. */
void sph_watch_begin(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    w->due = s->run->step % SPH_WATCH_EVERY == 0;
}

/* Locals closer than near_pair to another particle; needs the list and lines of this place. Ghosts
 * of walls and openings do not count, those of other ranks and images do. */
static double paired_of_level(const struct sph *s)
{
    const struct neighbours *l = s->list;
    const int real = s->p.n + s->p.nhalo;
    const double near2 = near_pair * near_pair * s->dx * s->dx;
    int n = 0;
    for (int i = 0; i < s->p.n; i++) {
        const double *x = prim_line(&s->p, i);
        const int *j = l->j + l->start[i];
        bool paired = false;
        for (int k = 0; k < l->count[i]; k++) {
            const double r2 = vec_distance2(s->dim, x, prim_line(&s->p, j[k]));
            paired = paired || (r2 < near2 && j[k] < real);
        }
        n += paired;
    }
    return n;
}

/* Sum over the levels, this rank. */
static double count_paired(const struct sph *s)
{
    double n = 0.0;
    for (; s; s = s->finer)
        n += paired_of_level(s);
    return n;
}

/* Adds energy, kinetic energy and the power of the body force along periodic axes of one level. */
static void add_energy(const struct sph *s, double *sums)
{
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        double kinetic;
        if (particles_is_guard(&s->p, i))
            continue;
        sums[ENERGY] += sph_energy(s, y, &kinetic);
        sums[KINETIC] += kinetic;
        for (int a = 0; a < s->dim; a++)
            sums[POWER] += s->periodic[a] ? s->gravity[a] * y[s->dim + a] : 0.0;
    }
}

/* Fills w->sums on this rank. Every 50 steps pairs are counted too, which costs a loop over the
 * list, and with levels overlaps. */
static void sample(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    double *sums = w->sums;
    memset(sums, 0, sizeof w->sums);
    sums[WALL_WORK] = w->wall_work;
    w->wall_work = 0.0;
    for (const struct sph *q = s; q && w->budget_closed; q = q->finer)
        add_energy(q, sums);
    sums[REMOVED] = w->removed;
    w->removed = 0.0;
    sums[PUT_BACK] = 0.0;
    for (const struct sph *q = s; q && q->walls; q = q->finer)
        sums[PUT_BACK] += (double)q->walls->returned;
    if (s->run->step % SPH_WATCH_PAIRS != 0)
        return;
    sums[PAIRED] = count_paired(s);
    if (!s->finer)
        return;
    w->crowd = sph_watch_crowd(s);
    sums[CROWDED] = w->crowd.crowded;
    sums[COUNTED] = w->crowd.counted;
}

/* At the first stage of a step all values are those of one time. */
void sph_watch_stage(struct sph *s, bool first, double weight)
{
    if (first && s->watch.due) {
        struct timers *timers = &s->run->timers;
        timer_start(timers, "watch");
        sample(s);
        timer_stop(timers, "watch");
    }
    s->watch.wall_work += weight * s->watch.wall_power;
}

/* With levels the coarsest one has the account. */
void sph_watch_removed(struct sph *s, int i)
{
    double kinetic;
    const double e = sph_energy(s, state_row(&s->p, s->p.y, i), &kinetic);
    refinement_removed(s, i);
    if (particles_is_guard(&s->p, i))
        return;
    while (s->coarser)
        s = s->coarser;
    s->watch.removed += isfinite(e) ? e : 0.0;
}

/* What is measured beside the gain tells where it comes from. */
static const char *energy_remedy(const struct sph *s)
{
    const struct sph_watch *w = &s->watch;
    if (w->of[SPH_WATCH_PUT_BACK].now > 0.01)
        return w->remedy[REMEDY_WALLS];
    if (w->of[SPH_WATCH_MACH].now > 0.3)
        return w->remedy[REMEDY_C0];
    return w->remedy[sph_params_is_riemann(s->prm.scheme) ? REMEDY_DX : REMEDY_SCHEME];
}

/* The work between two samples is the trapezoidal rule over the power of body forces, plus what
 * moving walls did, less what removed particles took along. */
static void judge_energy(struct sph *s, double t, const double *sums, struct diagnosis *d)
{
    struct sph_watch *w = &s->watch;
    const int64_t step = s->run->step;
    w->work += 0.5 * (t - w->power_t) * (w->power + sums[POWER]) + sums[WALL_WORK] - sums[REMOVED];
    w->power = sums[POWER];
    w->power_t = t;
    const double gain = watch_budget_gain(&w->budget, step, sums[ENERGY] - w->work);
    const double U2 = w->reference * w->reference + w->rest * s->c0 * s->c0;
    double scale =
        sums[KINETIC] + s->start.mass * (0.05 * U2 + pow(w->friction * s->c0, 2.0) + w->settles);
    w->passed[step / SPH_WATCH_EVERY % HISTORY] = fabs(sums[WALL_WORK]) + 0.2 * fabs(sums[REMOVED]);
    for (int k = 0; k < HISTORY; k++)
        scale += 5.0 * w->passed[k];
    w->of[SPH_WATCH_ENERGY].likely = energy_remedy(s);
    watch_judge(w->of + SPH_WATCH_ENERGY, scale > 0.0 ? gain / scale : 0.0, t, step, d);
}

/* The same on all ranks and throughout the run, since columns and reductions depend on it. */
static bool is_judged(const struct sph *s, int kind)
{
    return kind == SPH_WATCH_ENERGY     ? s->watch.budget_closed
           : kind == SPH_WATCH_PUT_BACK ? s->walls != NULL
           : kind == SPH_WATCH_CROWDED  ? s->finer != NULL
           : kind == SPH_WATCH_FORCES   ? sph_watch_has_forces(s->run, &s->prm)
                                        : true;
}

/* Reduces the sums of the sample, which belong to the state at the start of this step, and judges
 * each watch that is due. put_back and passed are rings over the last WATCH_STEPS steps.
 * Collective. */
static void judge_sample(struct sph *s, double t, struct diagnosis *d)
{
    struct sph_watch *w = &s->watch;
    const int64_t step = s->run->step, sample = step / SPH_WATCH_EVERY;
    double sums[SPH_WATCH_SUMS + 1];
    memcpy(sums, w->sums, sizeof w->sums);
    sums[SPH_WATCH_SUMS] = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        sums[SPH_WATCH_SUMS] += q->p.n;
    MPI_Allreduce(MPI_IN_PLACE, sums, SPH_WATCH_SUMS + 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double all = fmax(sums[SPH_WATCH_SUMS], 1.0);
    if (s->walls) {
        double *before = w->put_back + sample % HISTORY;
        watch_judge(w->of + SPH_WATCH_PUT_BACK, (sums[PUT_BACK] - *before) / all, t, step, d);
        *before = sums[PUT_BACK];
    }
    if (w->budget_closed)
        judge_energy(s, t, sums, d);
    if (step % SPH_WATCH_FORCES_EVERY == 0 && is_judged(s, SPH_WATCH_FORCES))
        sph_watch_rest_forces(s, t, d);
    if (w->sound.on)
        sph_sound_judge(s);
    if (step % SPH_WATCH_PAIRS != 0)
        return;
    watch_judge(w->of + SPH_WATCH_PAIRED, sums[PAIRED] / all, t, step, d);
    struct watch *crowded = w->of + SPH_WATCH_CROWDED;
    const double share = sums[CROWDED] / fmax(sums[COUNTED], 1.0);
    if (s->finer && share > crowded->warn && !crowded->warned)
        sph_watch_say_crowd(s, w->crowd_place, sizeof w->crowd_place);
    if (s->finer)
        watch_judge(crowded, share, t, step, d);
}

void sph_watch_judge(struct sph *s, struct diagnosis *d)
{
    struct sph_watch *w = &s->watch;
    const double t = s->t - s->dt; /* of the sample */
    watch_judge(w->of + SPH_WATCH_MACH, s->step.max_speed / s->c0, s->t, s->run->step, d);
    if (w->due && !d->bad)
        judge_sample(s, t, d);
    w->due = false;
    if (d->bad)
        sph_fault_place(s, d);
    if (d->bad && s->run->summary)
        sph_watch_summarise(s);
}

/* Mach number and least spacing have columns of their own. */
void sph_watch_row(const struct sph *s, struct figures *to)
{
    static const char *const titles[SPH_WATCHES] = {[SPH_WATCH_ENERGY] = "energy gain [-]",
                                                    [SPH_WATCH_PAIRED] = "paired [-]",
                                                    [SPH_WATCH_PUT_BACK] = "put back [-]"};
    for (int k = 0; k < SPH_WATCHES; k++)
        if (titles[k] && is_judged(s, k))
            FIGURE(to, s->watch.of[k].now, "%s", titles[k]);
}

/* Only what this run judges at all. */
void sph_watch_summarise(const struct sph *s)
{
    for (int k = 0; k < SPH_WATCHES; k++)
        if (is_judged(s, k))
            watch_summary(s->watch.of + k, s->run->summary);
    if (s->watch.sound.on)
        sph_sound_summarise(s);
}

/* What a restart needs to judge as if nothing had been; the same on all ranks but for energy
 * removed and walls' work. */
enum { KEPT = 5 + 3 * SPH_WATCHES + 2 * HISTORY + 1 + 2 * WATCH_SLOTS + 6 * BODIES_MAX + 9 };

/* x to, or from, the next place of v. */
static double keep(double **v, double x, bool load)
{
    double *at = (*v)++;
    if (!load)
        *at = x;
    return *at;
}

/* One list for both directions: what is saved is what is loaded, in one order. KEPT must match its
 * length. */
static void flatten(struct sph_watch *w, double *v, bool load)
{
    w->work = keep(&v, w->work, load);
    w->power = keep(&v, w->power, load);
    w->power_t = keep(&v, w->power_t, load);
    w->removed = keep(&v, w->removed, load);
    w->wall_work = keep(&v, w->wall_work, load);
    for (int k = 0; k < SPH_WATCHES; k++) {
        w->of[k].now = keep(&v, w->of[k].now, load);
        w->of[k].worst = keep(&v, w->of[k].worst, load);
        w->of[k].warned = keep(&v, w->of[k].warned, load) != 0.0;
    }
    for (int k = 0; k < HISTORY; k++)
        w->put_back[k] = keep(&v, w->put_back[k], load);
    for (int k = 0; k < HISTORY; k++)
        w->passed[k] = keep(&v, w->passed[k], load);
    w->budget.n = (int)keep(&v, w->budget.n, load);
    for (int k = 0; k < WATCH_SLOTS; k++) {
        w->budget.least[k] = keep(&v, w->budget.least[k], load);
        w->budget.slot[k] = (int64_t)keep(&v, (double)w->budget.slot[k], load);
    }
    for (int k = 0; k < BODIES_MAX; k++) {
        struct rest_forces *r = w->still + k;
        r->n = (int)keep(&v, r->n, load);
        for (int a = 0; a < 3; a++)
            r->off[a] = keep(&v, r->off[a], load);
        r->pushed = keep(&v, r->pushed, load);
        r->pressure = keep(&v, r->pressure, load);
    }
    w->sound.from = keep(&v, w->sound.from, load);
    w->sound.swing = keep(&v, w->sound.swing, load);
    w->sound.n = (int)keep(&v, w->sound.n, load);
    for (int a = 0; a < 3; a++) {
        w->sound.least[a] = keep(&v, w->sound.least[a], load);
        w->sound.most[a] = keep(&v, w->sound.most[a], load);
    }
}

void sph_watch_save(const struct sph *s, struct h5 *f)
{
    struct sph_watch w = s->watch;
    double v[KEPT];
    flatten(&w, v, false);
    h5_write_real(f, "watch", "-", KEPT, 1, v, false);
}

/* Sums of this rank come back as its own parts, also on another number of ranks (h5_read_parts);
 * what is common comes from v. */
bool sph_watch_load(struct sph *s, struct h5 *f)
{
    double v[KEPT], parts[KEPT];
    if (!h5_read_same(f, "watch", KEPT, v) || !h5_read_parts(f, "watch", KEPT, parts))
        return false;
    flatten(&s->watch, parts, true);
    const double removed = s->watch.removed, wall_work = s->watch.wall_work;
    flatten(&s->watch, v, true);
    s->watch.removed = removed;
    s->watch.wall_work = wall_work;
    return true;
}

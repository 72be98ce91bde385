/* sph_watch.c - see sph_watch.h. SPDX-License-Identifier: BSD-3-Clause
 *
 * Energy: kinetic, elastic and potential (gravity across bounded axes, central force). Outside work
 * is that of a body force along periodic axes, g.sum(m u), and of moving walls: the momentum that
 * they give to each particle times their velocity there, by the weights of the stages. What is left
 * over may only fall. A gain is measured by the kinetic energy and a twentieth of what the scene
 * lets expect, M (U^2 + p/rho)/20: a tank at rest has its hydrostatic scale, so that noise of 1e-3
 * sqrt(g H) is no alarm and a flow of sqrt(g H)/30 that nothing drives is. The work of moving walls
 * is known to some percent only, for the division by gamma is theirs, too: five times its size is
 * added to the scale, and the warning comes at 3 % instead of 1 %.
 *
 * Not judged: openings and partners, which carry energy in and out, and moving walls made of
 * ghosts, whose forces are not told from those of particles. */
#include "sph_watch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../common/h5.h"
#include "../common/log.h"
#include "../common/mem.h"
#include "neighbours.h"
#include "openings.h"
#include "sph.h"
#include "sph_params.h"
#include "walls.h"
#include "zones.h"

enum { PRIM = 8, HISTORY = WATCH_STEPS / SPH_WATCH_EVERY };
/* What is summed over particles and ranks. */
enum { ENERGY, KINETIC, POWER, WALL_WORK, REMOVED, PUT_BACK, PAIRED };

static const double near_pair = 0.1; /* dx: closer than that two particles are one */

static bool moves(const struct scene *c)
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

/* Whether all work that is done on the flow can be told. */
static bool is_closed(const struct run *r, const struct sph_params *prm)
{
    return !r->coupled && prm->outer == OUTER_NONE &&
           (!moves(&r->scene) || prm->walls == WALLS_NFM);
}

void sph_watch_create(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    const struct scene_speed v = sph_params_speed(s->run);
    w->reference = v.speed;
    w->rest = v.pressure / (s->c0 * s->c0);
    w->budget_closed = is_closed(s->run, &s->prm);
    snprintf(w->remedy[0], sizeof w->remedy[0],
             "sph.c0 = %.4g m/s is too low for this flow: raise it to ten times the largest speed",
             s->c0);
    snprintf(w->remedy[1], sizeof w->remedy[1],
             "refine sph.dx = %.4g m, lower sph.cfl = %.3g, or raise sph.c0 = %.4g m/s", s->dx,
             s->prm.cfl, s->c0);
    w->of[SPH_WATCH_MACH] = (struct watch){.key = "mach",
                                           .what = "largest |u| over the speed of sound",
                                           .likely = w->remedy[0],
                                           .warn = 0.3,
                                           .stop = 1.0};
    w->of[SPH_WATCH_ENERGY] =
        (struct watch){.key = "energy_gain",
                       .what = "energy that the flow gained from nowhere in 100 steps, over its "
                               "kinetic energy and 5 % of that of the reference speed",
                       .likely = w->remedy[1],
                       .warn = moves(&s->run->scene) ? 0.03 : 0.01,
                       .stop = 0.1};
    w->of[SPH_WATCH_PAIRED] = (struct watch){.key = "paired",
                                             .what = "share of particles within 0.1 dx of another",
                                             .likely = "particles clump: set sph.transport = "
                                                       "\"tvs\", or take a Riemann scheme",
                                             .warn = 0.4,
                                             .stop = 0.9};
    w->of[SPH_WATCH_PUT_BACK] =
        (struct watch){.key = "put_back",
                       .what = "share of particles put back from behind walls in 100 steps",
                       .likely = "the walls do not hold: refine sph.dx, or try another sph.walls",
                       .warn = 0.5,
                       .stop = 5.0};
}

void sph_watch_free(struct sph *s) { mem_free(s->watch.rate); }

void sph_watch_begin(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    w->due = s->run->step % SPH_WATCH_EVERY == 0;
}

void sph_watch_before_walls(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    w->wall_power = 0.0;
    if (!w->budget_closed || !s->walls || !moves(&s->run->scene))
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

/* Elastic energy per mass: integral of p/rho^2 from rho0, with r = rho/rho0. */
static double elastic(const struct sph *s, double r)
{
    const double c2 = s->c0 * s->c0, r2 = r * r;
    if (s->gamma == 1.0)
        return c2 * (log(r) + 1.0 / r - 1.0);
    return c2 / 7.0 * ((r2 * r2 * r2 - 1.0) / 6.0 + 1.0 / r - 1.0);
}

double sph_energy(const struct sph *s, const double *y, double *kinetic)
{
    const int dim = s->dim;
    const double w = y[2 * dim], m = y[2 * dim + 1], W2 = s->central * s->central;
    double potential = 0.0;
    *kinetic = 0.0;
    for (int a = 0; a < dim; a++) {
        *kinetic += 0.5 * y[dim + a] * y[dim + a] / m;
        potential += m * y[a] * (0.5 * W2 * y[a] - (s->periodic[a] ? 0.0 : s->gravity[a]));
    }
    return *kinetic + potential + m * elastic(s, m / w / s->rho0);
}

/* Locals closer than near_pair to another particle; needs the list and lines of this place. */
static double count_paired(const struct sph *s)
{
    const struct neighbours *l = s->list;
    const int real = s->p.n + (s->zones ? s->zones->openings->first_ghost : s->p.nghost);
    const double near2 = near_pair * near_pair * s->dx * s->dx;
    int n = 0;
    for (int i = 0; i < s->p.n; i++) {
        const double *x = s->p.prim + (size_t)PRIM * i;
        const int *j = l->j + l->start[i];
        bool paired = false;
        for (int k = 0; k < l->count[i]; k++) {
            const double *xj = s->p.prim + (size_t)PRIM * j[k];
            double r2 = 0.0;
            for (int a = 0; a < s->dim; a++)
                r2 += (x[a] - xj[a]) * (x[a] - xj[a]);
            paired = paired || (r2 < near2 && j[k] < real);
        }
        n += paired;
    }
    return n;
}

static void sample(struct sph *s)
{
    struct sph_watch *w = &s->watch;
    double *sums = w->sums;
    memset(sums, 0, sizeof w->sums);
    sums[WALL_WORK] = w->wall_work;
    w->wall_work = 0.0;
    for (int i = 0; i < s->p.n && w->budget_closed; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        double kinetic;
        sums[ENERGY] += sph_energy(s, y, &kinetic);
        sums[KINETIC] += kinetic;
        for (int a = 0; a < s->dim; a++)
            sums[POWER] += s->periodic[a] ? s->gravity[a] * y[s->dim + a] : 0.0;
    }
    sums[REMOVED] = w->removed;
    w->removed = 0.0;
    sums[PUT_BACK] = s->walls ? (double)s->walls->returned : 0.0;
    if (s->run->step % SPH_WATCH_PAIRS == 0)
        sums[PAIRED] = count_paired(s);
}

void sph_watch_stage(struct sph *s, bool first, double weight)
{
    if (first && s->watch.due) {
        struct timers *timers = &s->run->timers;
        timer_start(timers, timer_index(timers, "watch"));
        sample(s);
        timer_stop(timers, timer_index(timers, "watch"));
    }
    s->watch.wall_work += weight * s->watch.wall_power;
}

void sph_watch_removed(struct sph *s, int i)
{
    double kinetic;
    const double e = sph_energy(s, s->p.y + (size_t)i * s->p.nstate, &kinetic);
    s->watch.removed += isfinite(e) ? e : 0.0;
}

static void judge_energy(struct sph *s, double t, const double *sums, struct diagnosis *d)
{
    struct sph_watch *w = &s->watch;
    const int64_t step = s->run->step;
    w->work += 0.5 * (t - w->power_t) * (w->power + sums[POWER]) + sums[WALL_WORK] - sums[REMOVED];
    w->power = sums[POWER];
    w->power_t = t;
    const double gain = watch_budget_gain(&w->budget, step, sums[ENERGY] - w->work);
    const double U2 = w->reference * w->reference + w->rest * s->c0 * s->c0;
    double scale = sums[KINETIC] + 0.05 * s->mass0 * U2;
    w->walls[step / SPH_WATCH_EVERY % HISTORY] = fabs(sums[WALL_WORK]);
    for (int k = 0; k < HISTORY; k++)
        scale += 5.0 * w->walls[k];
    watch_judge(w->of + SPH_WATCH_ENERGY, scale > 0.0 ? gain / scale : 0.0, t, step, d);
}

/* Sums of the sample, taken at the start of this step. */
static void judge_sample(struct sph *s, double t, struct diagnosis *d)
{
    struct sph_watch *w = &s->watch;
    const int64_t step = s->run->step, sample = step / SPH_WATCH_EVERY;
    double sums[SPH_WATCH_SUMS + 1];
    memcpy(sums, w->sums, sizeof w->sums);
    sums[SPH_WATCH_SUMS] = s->p.n;
    MPI_Allreduce(MPI_IN_PLACE, sums, SPH_WATCH_SUMS + 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double all = fmax(sums[SPH_WATCH_SUMS], 1.0);
    if (w->budget_closed)
        judge_energy(s, t, sums, d);
    if (s->walls) {
        double *before = w->put_back + sample % HISTORY;
        watch_judge(w->of + SPH_WATCH_PUT_BACK, (sums[PUT_BACK] - *before) / all, t, step, d);
        *before = sums[PUT_BACK];
    }
    if (step % SPH_WATCH_PAIRS == 0)
        watch_judge(w->of + SPH_WATCH_PAIRED, sums[PAIRED] / all, t, step, d);
}

void sph_watch_judge(struct sph *s, struct diagnosis *d)
{
    struct sph_watch *w = &s->watch;
    const double t = s->t - s->dt; /* of the sample */
    watch_judge(w->of + SPH_WATCH_MACH, s->max_speed / s->c0, s->t, s->run->step, d);
    if (w->due && !d->bad)
        judge_sample(s, t, d);
    w->due = false;
    if (d->bad && s->run->summary)
        sph_watch_summarise(s);
}

static bool is_judged(const struct sph *s, int kind)
{
    return kind == SPH_WATCH_ENERGY     ? s->watch.budget_closed
           : kind == SPH_WATCH_PUT_BACK ? s->walls != NULL
                                        : true;
}

/* Mach number and least spacing have columns of their own. */
int sph_watch_columns(const struct run *r, const char **names)
{
    int n = 0;
    if (is_closed(r, sph_params_of(r)))
        names[n++] = "energy gain [-]";
    names[n++] = "paired [-]";
    if (sph_params_walls(r))
        names[n++] = "put back [-]";
    return n;
}

double *sph_watch_row(const struct sph *s, double *values)
{
    static const int kinds[3] = {SPH_WATCH_ENERGY, SPH_WATCH_PAIRED, SPH_WATCH_PUT_BACK};
    for (int k = 0; k < 3; k++)
        if (is_judged(s, kinds[k]))
            *values++ = s->watch.of[kinds[k]].now;
    return values;
}

void sph_watch_summarise(const struct sph *s)
{
    for (int k = 0; k < SPH_WATCHES; k++)
        if (is_judged(s, k))
            watch_summary(s->watch.of + k, s->run->summary);
}

/* What a restart needs to judge as if nothing had been; the same on all ranks but for energy
 * removed and walls' work. */
enum { KEPT = 5 + 3 * SPH_WATCHES + 2 * HISTORY + 1 + 2 * WATCH_SLOTS };

/* x to, or from, the next place of v. */
static double keep(double **v, double x, bool load)
{
    double *at = (*v)++;
    if (!load)
        *at = x;
    return *at;
}

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
        w->walls[k] = keep(&v, w->walls[k], load);
    w->budget.n = (int)keep(&v, w->budget.n, load);
    for (int k = 0; k < WATCH_SLOTS; k++) {
        w->budget.least[k] = keep(&v, w->budget.least[k], load);
        w->budget.slot[k] = (int64_t)keep(&v, (double)w->budget.slot[k], load);
    }
}

void sph_watch_save(const struct sph *s, struct h5 *f)
{
    struct sph_watch w = s->watch;
    double v[KEPT];
    flatten(&w, v, false);
    h5_write_real(f, "watch", "-", KEPT, 1, v, false);
}

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

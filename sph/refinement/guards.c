/* guards.c - see guards.h. A guard at x takes rho and u as the mean over its sources j, of both
 * levels, with the weights w_j W(x - x_j) (Shepard, Chiron 2017 [5.23-5.24]), of f_j extrapolated
 * to x by the trapezoidal rule,
 *   f_j + (grad f_j + grad f).(x - x_j)/2,
 * grad f being the mean of the sources' gradients. With gradients of second order this is of third
 * order on any set. Order in a step: guards_list lists the sources when lists are new, once a step;
 * guards_update sets the fields in every stage, before the first pass; after it guards_hold_edge
 * unshifts those at edges, and guards_rates moves them. Sources are particles that flow, of the two
 * levels that meet at the place.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "guards.h"

#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"
#include "apr_params.h"
#include "refinement.h"

static const double thin = 1e-3;               /* sum of w W: nobody is there */
static const double narrow = 0.8, least = 2.4; /* of R; finer dx: supports of guards */
static const double beyond = 0.5; /* of the range of its sources: how far a guard may leave it */

/* The radius within which guards take from what flows, m; `fine': the finer of their two sources.
 * All of R takes energy out of vortices at each edge, 0.65 R puts some in; near a free surface what
 * levels have at rest (excess) was measured with R. */
static double reach_of(const struct sph *fine)
{
    return fine->surface || fine->guards->mean
               ? fine->R
               : fmin(fine->R, fmax(narrow * fine->R, least * fine->dx));
}

/* Guards that step on their own need rates of their own. */
struct guards *guards_create(const struct run *r)
{
    struct guards *g = NEW(struct guards, 1);
    const struct apr_params *apr = apr_params_of(r);
    g->mean = apr->guards == GUARDS_MEAN;
    g->own_rates = apr->local_steps;
    return g;
}

/* Roles of the ghosts are those that their owners gave, of mirror images those of what they show.
 */
static void share_roles(struct sph *s)
{
    struct guards *g = s->guards;
    double *own = NEW(double, s->p.n), *ghosts = NEW(double, s->p.nghost);
    for (int i = 0; i < s->p.n; i++)
        own[i] = s->p.role[i];
    domain_share(s, own, 1, ghosts);
    ROOM_IN(g, g->ghost, s->p.nghost);
    for (int k = 0; k < s->p.nghost; k++)
        g->ghost[k] = (unsigned short)ghosts[k];
    for (int k = s->p.nhalo; k < s->p.nghost && s->walls; k++) {
        const int from = walls_mirrored(s, s->p.n + k);
        if (from >= 0)
            g->ghost[k] = (unsigned short)guards_role(s, from);
    }
    FREE(own, ghosts);
}

/* Room for n guards; contents are kept. */
static void make_room(struct guards *g, int n)
{
    ROOM_IN(g, g->who, n);
    ROOM_IN(g, g->source, n);
    ROOM_IN(g, g->near, n);
    ROOM_IN(g, g->first, n);
    ROOM_IN(g, g->count, n);
}

/* The order in which guards are listed: 0 outside of where their level flows, 1 within, 2 deep. */
static int kind_of(const struct sph *s, int i)
{
    if (s->p.role[i] & ROLE_DEEP)
        return 2;
    return guards_is_outside(s, i) ? 0 : 1;
}

/* Lists the guards of a level by kind, with their sources. */
static void find(struct sph *s)
{
    struct guards *g = s->guards;
    int n = 0, upto[3];
    for (int i = 0; i < s->p.n; i++)
        n += particles_is_guard(&s->p, i);
    make_room(g, n);
    g->n = 0;
    for (int kind = 0; kind < 3; kind++) {
        for (int i = 0; i < s->p.n; i++)
            if (particles_is_guard(&s->p, i) && kind_of(s, i) == kind)
                g->who[g->n++] = i;
        upto[kind] = g->n;
    }
    g->nfiner = upto[0];
    g->nshallow = upto[1];
    for (int k = 0; k < g->n; k++)
        g->source[k] = (unsigned char)(s->p.role[g->who[k]] >> ROLE_SOURCE & 15);
}

/* How many guards from k on have the same sources and lie together, as those of a cell do; lo, hi:
 * gets their box. A group shares one search; its box is at most R + skin wide. */
static int find_group(const struct sph *s, int k, double *lo, double *hi)
{
    const struct guards *g = s->guards;
    const double widest = s->R + s->lists.skin;
    int n = 0;
    for (; k + n < g->n && g->source[k + n] == g->source[k]; n++) {
        const double *x = prim_line(&s->p, g->who[k + n]);
        double low[3], high[3];
        bool together = true;
        for (int a = 0; a < s->dim; a++) {
            low[a] = n > 0 ? fmin(lo[a], x[a]) : x[a];
            high[a] = n > 0 ? fmax(hi[a], x[a]) : x[a];
            together = together && high[a] - low[a] <= widest;
        }
        if (n > 0 && !together)
            break;
        memcpy(lo, low, sizeof low);
        memcpy(hi, high, sizeof high);
    }
    return n;
}

/* Whether one of the particles j[n] of `from' is near the free surface. */
static bool any_on_surface(const struct sph *from, const int *j, int n)
{
    bool any = false;
    for (int k = 0; k < n && !any; k++)
        any = guards_role(from, j[k]) & ROLE_SURFACE;
    return any;
}

/* Rows of the guards k .. end-1 from one of their sources, each padded; returns the next free place
 * in j. m: 0 for the coarser source, 1 for the finer. */
static int add_rows(struct sph *s, const struct sph *from, int m, int k, int end, double reach,
                    int at)
{
    struct guards *g = s->guards;
    for (; k < end; k++) {
        const double *x = prim_line(&s->p, g->who[k]);
        const int begin = at;
        at = neighbours_pick(from, x, reach, at, &g->j, g);
        g->first[k][m] = begin;
        g->count[k][m] = at - begin;
        g->near[k] = (m > 0 && g->near[k]) ||
                     (from->surface && any_on_surface(from, g->j + begin, at - begin));
        for (int pad = 0; pad < LANES - 1; pad++)
            g->j[at++] = from->p.capacity;
    }
    return at;
}

/* Writes how many sources each guard has, which is work that the partition over ranks should
 * count. */
static void count_taken(struct sph *s)
{
    struct neighbours *l = s->list;
    ROOM_IN(l, l->taken, s->p.n);
    if (s->p.n > 0)
        memset(l->taken, 0, (size_t)s->p.n * sizeof *l->taken);
    for (int k = 0; k < s->guards->n; k++)
        l->taken[s->guards->who[k]] = s->guards->count[k][0] + s->guards->count[k][1];
}

/* Makes both rows of every guard of the level s anew; all[] are the levels by number. Sources with
 * ROLE_GUARD are left out, so a guard never takes from guards. */
static void list_level(struct sph *const *all, struct sph *s)
{
    struct guards *g = s->guards;
    int at = 0;
    find(s);
    for (int k = 0; k < g->n;) {
        const struct sph *fine = all[g->source[k]], *sources[2] = {fine->coarser, fine};
        const double reach = reach_of(fine) + fine->lists.skin;
        double lo[3], hi[3];
        const int end = k + find_group(s, k, lo, hi);
        for (int m = 0; m < 2; m++) {
            neighbours_gather(sources[m], lo, hi, reach, sources[m]->guards->ghost, ROLE_GUARD);
            at = add_rows(s, sources[m], m, k, end, reach, at);
        }
        k = end;
    }
    g->fresh = true;
    g->nprior = 0;
    count_taken(s);
}

/* The levels by their number. */
static void levels_of(struct sph *s, struct sph **all)
{
    for (; s; s = s->finer)
        all[s->level] = s;
}

/* Roles of other ranks first, since givers may be there. */
void guards_list(struct sph *s)
{
    struct sph *all[APR_LEVELS_MAX + 1];
    levels_of(s, all);
    for (struct sph *q = s; q; q = q->finer)
        share_roles(q);
    for (struct sph *q = s; q; q = q->finer)
        list_level(all, q);
}

/* Sums over the sources, weighted with w W without the kernel's constant, which cancels: 1, their
 * places from the guard, values half way towards it by their own slopes, slopes. */
struct guard_sums {
    vec W, r[3], f[4], grad[4][3]; /* rho, u */
};

/* The least and the largest rho and u of the sources, negated where it is the least. */
struct guard_range {
    vec least[4], most[4];
};

/* Takes f in where W > 0: padding has none. */
INLINE void widen(struct guard_range *to, vec W, const vec f[4], const int dim)
{
    const vec out = -1e300 * (1.0 + __builtin_convertvector(W > 0.0, vec));
    for (int c = 0; c <= dim; c++) {
        to->least[c] = vec_max(to->least[c], out - f[c]);
        to->most[c] = vec_max(to->most[c], out + f[c]);
    }
}

/* A record has rho at 5 (2D) or 7, f[0]; u follows in f[1..dim]. Padding has volume 0 and adds
 * nothing. */
INLINE void add_sources(const struct sph *from, const double *x, double R_1, const int *j, int n,
                        struct guard_sums *to, struct guard_range *range, const int dim,
                        const bool slopes)
{
    const double *prim = from->p.prim, *slope = from->p.slope;
    const ptrdiff_t width = dim == 2 ? 8 : 16;
    for (const int *end = j + n; j < end; j += LANES) {
        vec d[3], f[4], g[16], w, r2 = vec_all(0.0);
        vec_columns(prim, PRIM, j, 0, d, d + 1);
        if (dim == 3) {
            vec_columns(prim, PRIM, j, 2, d + 2, f + 1);
            vec_columns(prim, PRIM, j, 4, f + 2, f + 3);
        } else {
            vec_columns(prim, PRIM, j, 2, f + 1, f + 2);
        }
        vec_columns(prim, PRIM, j, at_volume(dim), &w, f);
        for (int k = 0; slopes && k < dim * (dim + 1); k += 2)
            vec_columns(slope, width, j, k, g + k, g + k + 1);
        for (int a = 0; a < dim; a++) {
            d[a] -= x[a];
            r2 += d[a] * d[a];
        }
        const vec t = vec_max(1.0 - vec_sqrt(r2) * R_1, vec_all(0.0)), t2 = t * t;
        const vec W = w * (t2 * t2) * (5.0 - 4.0 * t);
        to->W += W;
        if (range)
            widen(range, W, f, dim);
        for (int a = 0; a < dim; a++)
            to->r[a] += W * d[a];
        for (int c = 0; c <= dim; c++) {
            for (int a = 0; slopes && a < dim; a++) {
                f[c] -= 0.5 * g[dim * c + a] * d[a];
                to->grad[c][a] += W * g[dim * c + a];
            }
            to->f[c] += W * f[c];
        }
    }
}

/* rho and u at the guard: by the trapezoidal rule along the way from each source, of third order on
 * any set where the slopes are of second order, and Shepard's mean [5.24] where these are 0. The
 * mean alone errs by half the kernel's second moment times the field's curvature: Taylor-Green
 * vortices through a box lost 9 % of their energy by that. Returns the sum of the weights. */
INLINE double mean_of(const struct guard_sums *sum, double f[4], const int dim)
{
    const double W = vec_sum(sum->W), W_1 = W > 0.0 ? 1.0 / W : 0.0;
    for (int c = 0; c <= dim; c++) {
        f[c] = vec_sum(sum->f[c]) * W_1;
        for (int a = 0; a < dim; a++)
            f[c] -= 0.5 * vec_sum(sum->r[a]) * W_1 * vec_sum(sum->grad[c][a]) * W_1;
    }
    return W;
}

/* Pressure of water at rest beyond its weight near the surface, where the momentum equation sums
 * over half a support: of P = p/(rho g R), in the same unit, linear between the rows of a tank at
 * rest with R/dx 4 (means of two spacings); none in what does not press. The unit is rho g R of the
 * level. */
static double excess(double P)
{
    static const double of[][2] = {{0.0, 0.0},    {0.24, 0.118},  {0.40, 0.049},
                                   {0.64, 0.018}, {0.87, 0.0025}, {1.1, 0.0}};
    enum { ROWS = sizeof of / sizeof of[0] };
    return lookup_linear(of, ROWS, P);
}

/* The density at which a level with the weight `to' = rho g R has, near the surface at rest, the
 * pressure that one of weight `from' has at rho in the same depth. The fixed point P = head/to +
 * excess(P) is found by iteration, then the density by linearising p about rho. */
static double matched_density(const struct sph *s, double rho, double from, double to)
{
    /* p is at least the linear one: deeper than the table on both levels */
    if (from == to || s->c0 * s->c0 * (rho - s->rho0) > 1.1 * fmax(from, to))
        return rho;
    const double p = eos_p(rho, s->rho0, s->c0, s->gamma), head = p - from * excess(p / from);
    double P = head / to;
    for (int k = 0; k < 8; k++) /* contracts by 0.6 */
        P = head / to + excess(P);
    return rho + (P * to - p) / pow(eos_c(rho, s->rho0, s->c0, s->gamma), 2.0);
}

/* Brings f back to at most `beyond' of the range outside of it. Slopes of a thin jet lead far
 * beyond what flows there, and what flows then follows its guards: a splash that met an edge had
 * guards of three times its speed and -1000 m of head, and ended the run. Half a range leaves
 * linear fields as they are for a guard half a spacing before the first of two rows. */
static void bound(double f[4], const struct guard_range *is, int dim)
{
    for (int c = 0; c <= dim; c++) {
        double low = -is->least[c][0], high = is->most[c][0];
        for (int l = 1; l < LANES; l++) {
            low = fmin(low, -is->least[c][l]);
            high = fmax(high, is->most[c][l]);
        }
        const double room = beyond * (high - low);
        f[c] = fmax(low - room, fmin(f[c], high + room));
    }
}

/* Near a free surface: each level's mean by itself, for what their pressures are at rest differs.
 */
INLINE double take_near(struct sph *s, const struct guard_sums sum[2],
                        const struct guard_range range[2], const struct sph *fine, double f[4],
                        const int dim)
{
    const double *G = s->gravity, g = vec3_length(G);
    double W = 0.0;
    for (int c = 0; c <= dim; c++)
        f[c] = 0.0;
    for (int m = 0; m < 2; m++) {
        double of[4];
        const double part = mean_of(sum + m, of, dim), R = m ? fine->R : 2.0 * fine->R;
        if (part > 0.0)
            bound(of, range + m, dim);
        if (part > 0.0 && g > 0.0)
            of[0] = matched_density(s, of[0], s->rho0 * g * R, s->rho0 * g * s->R);
        for (int c = 0; c <= dim; c++)
            f[c] += part * of[c];
        W += part;
    }
    for (int c = 0; c <= dim; c++)
        f[c] /= W > 0.0 ? W : 1.0;
    return W;
}

/* Away from the surface both levels are one set of sources. */
static void join_sums(struct guard_sums *to, const struct guard_sums *more, int dim)
{
    to->W += more->W;
    for (int a = 0; a < dim; a++)
        to->r[a] += more->r[a];
    for (int c = 0; c <= dim; c++) {
        to->f[c] += more->f[c];
        for (int a = 0; a < dim; a++)
            to->grad[c][a] += more->grad[c][a];
    }
}

/* Sets state and record of guard i from the sums, or leaves it as it is where nobody is there. Mass
 * stays, volume = m/rho. range: of both levels' sources near a free surface, else NULL. */
INLINE void take(struct sph *s, int i, struct guard_sums sum[2], const struct guard_range *range,
                 const struct sph *fine, const int dim)
{
    double *y = state_row(&s->p, s->p.y, i), *q = prim_line(&s->p, i), f[4], W;
    if (range) {
        W = take_near(s, sum, range, fine, f, dim);
    } else {
        join_sums(sum, sum + 1, dim);
        W = mean_of(sum, f, dim);
    }
    if (!(kernel_w0(dim, reach_of(fine)) * W > thin))
        return;
    const double m = y[at_mass(dim)], rho = f[0];
    for (int a = 0; a < dim; a++) {
        q[dim + a] = f[1 + a];
        y[dim + a] = m * q[dim + a];
    }
    y[at_volume(dim)] = q[at_volume(dim)] = m / rho;
    q[at_rho(dim)] = rho;
}

/* The first n guards of level s, or of these what stands where its level is about to flow (waking);
 * dim and slopes are constants in each instance. */
INLINE void update(struct sph *const *all, struct sph *s, int n, bool waking, const int dim,
                   const bool slopes)
{
    const struct guards *g = s->guards;
    for (int k = 0; k < n; k++) {
        if (waking && !(s->places->share(s, prim_line(&s->p, g->who[k])) > 0.0))
            continue;
        const struct sph *fine = all[g->source[k]];
        const double *x = prim_line(&s->p, g->who[k]), R_1 = 1.0 / reach_of(fine);
        const int *j[2] = {g->j + g->first[k][0], g->j + g->first[k][1]}, *count = g->count[k];
        const bool near = slopes && g->near[k];
        struct guard_sums sum[2];
        struct guard_range range[2];
        memset(sum, 0, sizeof sum);
        for (int c = 0; near && c <= dim; c++)
            for (int m = 0; m < 2; m++)
                range[m].least[c] = range[m].most[c] = vec_all(-INFINITY);
        add_sources(fine->coarser, x, R_1, j[0], count[0], sum, near ? range : NULL, dim, slopes);
        add_sources(fine, x, R_1, j[1], count[1], sum + 1, near ? range + 1 : NULL, dim, slopes);
        take(s, g->who[k], sum, near ? range : NULL, fine, dim);
    }
}

/* Updates the first n guards of a level, by slopes or by the mean alone. */
static void give(struct sph *const *all, struct sph *s, int n, bool waking)
{
    if (s->guards->mean)
        (s->dim == 2 ? update(all, s, n, waking, 2, false) : update(all, s, n, waking, 3, false));
    else if (s->dim == 2)
        update(all, s, n, waking, 2, true);
    else
        update(all, s, n, waking, 3, true);
}

/* What deep guards are given in the first stage holds for all of the step, which starts from y0. So
 * y0 must hold it too. */
static void keep_deep(struct sph *s)
{
    const struct guards *g = s->guards;
    const size_t size = (size_t)s->p.nstate * sizeof(double);
    for (int k = g->nshallow; k < g->n; k++)
        memcpy(state_row(&s->p, s->p.y0, g->who[k]), state_row(&s->p, s->p.y, g->who[k]), size);
}

/* Deep guards are updated in the first stage alone (fresh). */
static void update_level(struct sph *const *all, struct sph *s)
{
    struct guards *g = s->guards;
    const int n = g->fresh ? g->n : g->nshallow;
    give(all, s, n, false);
    if (g->fresh)
        keep_deep(s);
    g->fresh = false;
}

/* Values of all levels are taken from particles that this rank sees, others' among them. */
void guards_share(struct sph *s, bool slopes)
{
    timer_start(&s->run->timers, "halo");
    domain_halo_start(s, slopes);
    domain_halo_finish(s, slopes);
    if (s->walls && s->walls->model == &wall_ghost) /* images at plane sides are sources too */
        (slopes ? wall_ghost.ghost_slopes : wall_ghost.lines)(s);
    timer_stop(&s->run->timers, "halo");
}

/* Sends records and slopes of all levels, those of the stage before, since guards are needed for
 * the next ones; all: gets the levels. */
static void share_levels(struct sph *s, struct sph **all)
{
    levels_of(s, all);
    for (; s; s = s->finer) {
        guards_share(s, false);
        guards_share(s, true);
    }
}

/* Sets the guards of all levels, or of these what is about to flow (waking). A partner takes all of
 * the coarsest level at the end of a step, where deep guards have what they were given in its first
 * stage: a vortex that passed a refined box erred by ten times as much in fv. */
static void set_all(struct sph *s, bool waking)
{
    struct sph *all[APR_LEVELS_MAX + 1];
    share_levels(s, all);
    timer_start(&s->run->timers, "guards");
    for (struct sph *q = s; q; q = q->finer)
        if (!waking)
            update_level(all, q);
        else if (q == s && s->prm.outer == OUTER_PARTNER)
            give(all, q, q->guards->n, false);
        else
            give(all, q, q->guards->nshallow, true);
    timer_stop(&s->run->timers, "guards");
}

void guards_update(struct sph *s) { set_all(s, false); }

void guards_wake(struct sph *s) { set_all(s, true); }

/* At a level's own stages: its edge alone, from coarser and finer ones as they are now. */
void guards_update_edge(struct sph *s)
{
    struct sph *all[APR_LEVELS_MAX + 1];
    levels_of(s, all);
    guards_share(s, false);
    guards_share(s, true);
    timer_start(&s->run->timers, "guards");
    give(all, s, s->guards->nfiner, false);
    timer_stop(&s->run->timers, "guards");
}

/* A second output at the same time keeps the first copy. */
void guards_remember(struct sph *s)
{
    for (; s; s = s->finer) {
        const size_t size = (size_t)s->p.n * s->p.nslope;
        if (s->guards->nprior > 0) /* of an output of this place before */
            continue;
        mem_free(s->guards->prior);
        s->guards->prior = NEW_IN(s->guards, double, size);
        s->guards->nprior = s->p.n;
        if (size > 0)
            memcpy(s->guards->prior, s->p.slope, size * sizeof(double));
    }
}

/* Only where the particles are still the same. */
void guards_come_back(struct sph *s)
{
    for (; s; s = s->finer) {
        const size_t size = (size_t)s->guards->nprior * s->p.nslope;
        if (size > 0 && s->guards->nprior == s->p.n)
            memcpy(s->p.slope, s->guards->prior, size * sizeof(double));
        s->guards->nprior = 0;
    }
}

void guards_forget(struct sph *s)
{
    for (; s; s = s->finer)
        s->guards->nprior = 0;
}

/* The edge goes with the fluid, unshifted. */
void guards_hold_edge(struct sph *s)
{
    const struct guards *g = s->guards;
    if (s->prm.transport != TRANSPORT_TVS && s->prm.transport != TRANSPORT_TVO)
        return;
    for (int k = 0; k < g->nshallow; k++) {
        const int i = g->who[k];
        double *u0 = slope_line(&s->p, i) + s->dim + s->dim * s->dim;
        if (s->p.role[i] & ROLE_EDGE)
            memcpy(u0, prim_line(&s->p, i) + s->dim, (size_t)s->dim * sizeof *u0);
    }
}

/* Whether the rates of guard i are its own. */
static bool has_rates(const struct sph *s, int i)
{
    return s->guards->own_rates && !(s->p.role[i] & (ROLE_DEEP | ROLE_EDGE));
}

/* Guards without rates, which push nobody, need no pairs among themselves. */
void guards_spare(struct sph *s)
{
    const struct wall_model *w = s->walls ? s->walls->model : NULL;
    bool *idle = NEW(bool, s->p.n), *pushing = NEW(bool, s->p.n);
    if (w && w->pushing)
        w->pushing(s, pushing);
    for (int i = 0; i < s->p.n; i++)
        idle[i] = particles_is_guard(&s->p, i) && !has_rates(s, i) && !pushing[i];
    neighbours_spare(s, idle);
    FREE(idle, pushing);
}

/* Takes the part of the rates that changes mass out of all of them alike, so that u and rho go on
 * as the rates have it. */
static void keep_mass(const struct sph *s, int i, double *rate)
{
    const double *y = state_row(&s->p, s->p.y, i);
    const double share = rate[at_mass(s->dim)] / y[at_mass(s->dim)];
    for (int k = s->dim; k < s->p.nstate; k++)
        rate[k] -= share * y[k];
}

/* Overwrites the rates of guards: they move at u0 and keep their state, or with own_rates go on by
 * their own. */
void guards_rates(struct sph *s)
{
    const struct guards *g = s->guards;
    const int dim = s->dim;
    for (int k = 0; k < g->n; k++) {
        double *rate = state_row(&s->p, s->p.rate, g->who[k]);
        const double *u0 = slope_line(&s->p, g->who[k]) + dim + dim * dim;
        if (has_rates(s, g->who[k])) {
            keep_mass(s, g->who[k], rate);
            continue;
        }
        memset(rate, 0, (size_t)s->p.nstate * sizeof *rate);
        memcpy(rate, u0, (size_t)dim * sizeof *rate);
    }
}

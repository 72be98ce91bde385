/* guards.c - see guards.h. SPDX-License-Identifier: BSD-3-Clause */
#include "guards.h"

#include <math.h>
#include <string.h>

#include "../../common/mem.h"
#include "../pairs/neighbours.h"
#include "../pairs/vec.h"
#include "../parallel/domain.h"
#include "../particles/eos.h"
#include "../pairs/kernel.h"
#include "apr_params.h"
#include "refinement.h"

static const double thin = 1e-3; /* sum of w W: nobody is there */

struct guards *guards_create(void) { return NEW(struct guards, 1); }

void guards_free(struct guards **g)
{
    if (!*g)
        return;
    mem_free((*g)->who);
    mem_free((*g)->source);
    mem_free((*g)->first);
    mem_free((*g)->count);
    mem_free((*g)->j);
    mem_free((*g)->ghost);
    mem_free((*g)->prior);
    mem_free(*g);
    *g = NULL;
}

/* Roles of the ghosts are those that their owners gave. */
static void share_roles(struct sph *s)
{
    struct guards *g = s->guards;
    double *own = NEW(double, s->p.n), *ghosts = NEW(double, s->p.nghost);
    for (int i = 0; i < s->p.n; i++)
        own[i] = s->p.role[i];
    domain_share(s, own, 1, ghosts);
    if (s->p.nghost > g->ghost_capacity) {
        GROW(g->ghost, g->ghost_capacity, s->p.nghost);
        g->ghost_capacity = s->p.nghost;
    }
    for (int k = 0; k < s->p.nghost; k++)
        g->ghost[k] = (unsigned char)ghosts[k];
    mem_free(own);
    mem_free(ghosts);
}

static void make_room(struct guards *g, int n)
{
    if (n <= g->capacity)
        return;
    const int old = g->capacity, more = n + n / 8 + 64;
    GROW(g->who, old, more);
    GROW(g->source, old, more);
    GROW(g->first, old, more);
    GROW(g->count, old, more);
    g->capacity = more;
}

/* Who they are, those that are not deep first. */
static void find(struct sph *s)
{
    struct guards *g = s->guards;
    int n = 0;
    for (int i = 0; i < s->p.n; i++)
        n += particles_is_guard(&s->p, i);
    make_room(g, n);
    g->n = 0;
    for (int deep = 0; deep < 2; deep++) {
        for (int i = 0; i < s->p.n; i++)
            if (particles_is_guard(&s->p, i) && ((s->p.role[i] & ROLE_DEEP) != 0) == deep)
                g->who[g->n++] = i;
        if (!deep)
            g->nshallow = g->n;
    }
    for (int k = 0; k < g->n; k++)
        g->source[k] = (unsigned char)(s->p.role[g->who[k]] >> ROLE_SOURCE);
}

/* How many guards from k on have the same sources and lie together, as those of a cell do; lo, hi:
 * gets their box. */
static int find_group(const struct sph *s, int k, double *lo, double *hi)
{
    const struct guards *g = s->guards;
    const double widest = s->R + s->skin;
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

/* Rows of the guards k .. end-1 from one of their sources, each padded; returns the next free place
 * in j. */
static int add_rows(struct sph *s, const struct sph *from, int m, int k, int end, double reach,
                    int at)
{
    struct guards *g = s->guards;
    for (; k < end; k++) {
        const double *x = prim_line(&s->p, g->who[k]);
        const int begin = at;
        at = neighbours_pick(from, x, reach, at, &g->j, &g->j_capacity);
        g->first[k][m] = begin;
        g->count[k][m] = at - begin;
        for (int pad = 0; pad < LANES - 1; pad++)
            g->j[at++] = from->p.capacity;
    }
    return at;
}

static void list_level(struct sph *const *all, struct sph *s)
{
    struct guards *g = s->guards;
    int at = 0;
    find(s);
    for (int k = 0; k < g->n;) {
        const struct sph *fine = all[g->source[k]], *sources[2] = {fine->coarser, fine};
        const double reach = fine->R + fine->skin;
        double lo[3], hi[3];
        const int end = k + find_group(s, k, lo, hi);
        for (int m = 0; m < 2; m++) {
            neighbours_gather(sources[m], lo, hi, reach, sources[m]->guards->ghost);
            at = add_rows(s, sources[m], m, k, end, reach, at);
        }
        k = end;
    }
    g->fresh = true;
    g->nprior = 0;
}

/* The levels by their number. */
static void levels_of(struct sph *s, struct sph **all)
{
    for (; s; s = s->finer)
        all[s->level] = s;
}

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
struct sums {
    vec W, r[3], f[4], grad[4][3]; /* rho, u */
};

INLINE void add_sources(const struct sph *from, const double *x, double R_1, const int *j, int n,
                        struct sums *to, const int dim)
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
        for (int k = 0; k < dim * (dim + 1); k += 2)
            vec_columns(slope, width, j, k, g + k, g + k + 1);
        for (int a = 0; a < dim; a++) {
            d[a] -= x[a];
            r2 += d[a] * d[a];
        }
        const vec t = vec_max(1.0 - vec_sqrt(r2) * R_1, vec_all(0.0)), t2 = t * t;
        const vec W = w * (t2 * t2) * (5.0 - 4.0 * t);
        to->W += W;
        for (int a = 0; a < dim; a++)
            to->r[a] += W * d[a];
        for (int c = 0; c <= dim; c++) {
            for (int a = 0; a < dim; a++) {
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
 * vortices through a box lost 9 % of their energy by that. */
INLINE void take(struct sph *s, int i, const struct sums *sum, double W0, const int dim)
{
    const double W = vec_sum(sum->W), W_1 = 1.0 / W;
    double *y = state_row(&s->p, s->p.y, i), *q = prim_line(&s->p, i), f[4];
    if (!(W0 * W > thin))
        return;
    for (int c = 0; c <= dim; c++) {
        f[c] = vec_sum(sum->f[c]) * W_1;
        for (int a = 0; a < dim; a++)
            f[c] -= 0.5 * vec_sum(sum->r[a]) * W_1 * vec_sum(sum->grad[c][a]) * W_1;
    }
    const double m = y[at_mass(dim)], rho = f[0];
    for (int a = 0; a < dim; a++) {
        q[dim + a] = f[1 + a];
        y[dim + a] = m * q[dim + a];
    }
    y[at_volume(dim)] = q[at_volume(dim)] = m / rho;
    q[at_rho(dim)] = rho;
    if (dim == 2) {
        q[6] = eos_p(rho, s->rho0, s->c0, s->gamma);
        q[7] = eos_c(rho, s->rho0, s->c0, s->gamma);
    }
}

INLINE void update(struct sph *const *all, struct sph *s, int n, const int dim)
{
    const struct guards *g = s->guards;
    for (int k = 0; k < n; k++) {
        const struct sph *fine = all[g->source[k]];
        const double *x = prim_line(&s->p, g->who[k]), R_1 = 1.0 / fine->R;
        struct sums sum = {0};
        add_sources(fine->coarser, x, R_1, g->j + g->first[k][0], g->count[k][0], &sum, dim);
        add_sources(fine, x, R_1, g->j + g->first[k][1], g->count[k][1], &sum, dim);
        take(s, g->who[k], &sum, kernel_w0(dim, fine->R), dim);
    }
}

static void update_level(struct sph *const *all, struct sph *s)
{
    struct guards *g = s->guards;
    const int n = g->fresh ? g->n : g->nshallow;
    if (s->dim == 2)
        update(all, s, n, 2);
    else
        update(all, s, n, 3);
    g->fresh = false;
}

void guards_update(struct sph *s)
{
    struct sph *all[APR_LEVELS_MAX + 1];
    levels_of(s, all);
    timer_start(&s->run->timers, "halo");
    for (struct sph *q = s; q; q = q->finer) {
        domain_halo_start(q, false);
        domain_halo_finish(q, false);
        domain_halo_start(q, true); /* of the stage before */
        domain_halo_finish(q, true);
    }
    timer_stop(&s->run->timers, "halo");
    timer_start(&s->run->timers, "guards");
    for (struct sph *q = s; q; q = q->finer)
        update_level(all, q);
    timer_stop(&s->run->timers, "guards");
}

void guards_remember(struct sph *s)
{
    for (; s; s = s->finer) {
        const size_t size = (size_t)s->p.n * s->p.nslope;
        if (s->guards->nprior > 0) /* of an output of this place before */
            continue;
        mem_free(s->guards->prior);
        s->guards->prior = NEW(double, size);
        s->guards->nprior = s->p.n;
        if (size > 0)
            memcpy(s->guards->prior, s->p.slope, size * sizeof(double));
    }
}

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

void guards_rates(struct sph *s)
{
    const struct guards *g = s->guards;
    const int dim = s->dim;
    for (int k = 0; k < g->n; k++) {
        double *rate = state_row(&s->p, s->p.rate, g->who[k]);
        const double *u0 = slope_line(&s->p, g->who[k]) + dim + dim * dim;
        memset(rate, 0, (size_t)s->p.nstate * sizeof *rate);
        memcpy(rate, u0, (size_t)dim * sizeof *rate);
    }
}

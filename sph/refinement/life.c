/* life.c - births, removals and roles of the particles of all levels (Chiron 2017, 5.3); see
 * refinement.h. A particle that enters the region of the next level gives birth to 2^D of half its
 * spacing, of equal mass, at +-1/4 of it, with its fields and their slopes [5.20-5.22]; it stays,
 * and no link is kept. What leaves its region is removed. Roles follow from places alone; births
 * and removals have a hysteresis of half the coarser spacing, so that nobody is born to be removed.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "guards.h"
#include "refinement.h"

#include <math.h>
#include <string.h>

#include "../../common/mem.h"
#include "../walls/walls.h"

static const double hysteresis = 0.5;                   /* coarser dx */
static const double paid_back = 0.01, most_paid = 1e-5; /* a step: of the debt; of the mass */
static const double steepest = 0.05; /* change of rho from mother to child, its share */

/* Distances of the particles of a level to the edges of its own region and of the next finer one;
 * NULL: there is none. Each is asked for once a step. */
struct depths {
    double *own, *next;
};

static double *measure(const struct regions *g, const struct sph *s, int level)
{
    double *d = NEW(double, s->p.n);
    for (int i = 0; i < s->p.n; i++)
        d[i] = regions_distance(g, level, state_row(&s->p, s->p.y, i));
    return d;
}

/* Bits of enum sph_role of particle i but ROLE_MOTHER, with the source. */
static int role_of(const struct regions *g, const struct sph *s, const struct depths *is, int i)
{
    int role = 0, source = s->level;
    if (is->own && is->own[i] < 2.0 * s->R) /* guards of the finer level */
        return ROLE_GUARD | (is->own[i] < s->R ? ROLE_EDGE : 0) | source << ROLE_SOURCE;
    for (int n = s->level + 1; n <= regions_levels(g); n++) {
        const double R = ldexp(s->R, s->level + 1 - n);
        const double d =
            n == s->level + 1 ? is->next[i] : regions_distance(g, n, state_row(&s->p, s->p.y, i));
        if (d < R)
            break;
        source = n;
        role |= ROLE_GUARD;
        if (n == s->level + 1 &&
            d > 3.25 * R) /* slopes of guards reach 2 R deep, with what moves */
            role |= ROLE_DEEP;
    }
    return role | source << ROLE_SOURCE;
}

/* What flows, kg; this rank. */
static double flowing(const struct sph *s)
{
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i))
                sum += state_row(&q->p, q->p.y, i)[at_mass(q->dim)];
    return sum;
}

/* One child of particle i, at its place + d. */
static void bear(const struct sph *s, struct sph *fine, int i, const double *d)
{
    const int dim = s->dim;
    const double *y = state_row(&s->p, s->p.y, i), *grad = slope_line(&s->p, i);
    const double m = y[at_mass(dim)], rho = m / y[at_volume(dim)];
    double more = 0.0, x[3], u[3];
    for (int a = 0; a < dim; a++) {
        more += grad[a] * d[a];
        x[a] = y[a] + d[a];
        u[a] = y[dim + a] / m;
        for (int b = 0; b < dim; b++)
            u[a] += grad[dim + dim * a + b] * d[b];
    }
    const double rho_f = rho + fmax(-steepest * rho, fmin(more, steepest * rho));
    particles_reserve(&fine->p, fine->p.n + 1);
    const int k = particles_add(&fine->p, fine->next_id, ZONE_FREE);
    fine->next_id += s->run->size;
    particles_set(fine, k, x, u, ldexp(m, -dim) / rho_f, rho_f);
    memcpy(slope_line(&fine->p, k), grad, (size_t)s->p.nslope * sizeof *grad);
}

/* Changes the way d from a mother at x, h from a wall, less than the half spacing that she fills,
 * to a child such that both are as far from that wall, each in its own spacings, and so from the
 * next wall in a corner: a layer that packing or the flow has put there becomes two, with nobody
 * behind walls, at any number of levels. A way that meets a wall yet ends halfway before it. */
static void heed_walls(const struct sph *s, const double *x, double h, const double *way, double *d)
{
    const int dim = s->dim;
    double along = 0.0, aside[3];
    for (int a = 0; a < dim; a++)
        along += d[a] * way[a] / h;
    for (int a = 0; a < dim; a++)
        aside[a] = 2.0 * (d[a] - along * way[a] / h);
    const double free = 0.5 * walls_meet(s, x, aside), ahead = along > 0.0 ? 2.0 * h / s->dx : 1.0;
    for (int a = 0; a < dim; a++)
        d[a] = free * aside[a] + ahead * along * way[a] / h;
    const double share = walls_meet(s, x, d);
    for (int a = 0; a < dim && share < 1.0; a++)
        d[a] *= 0.5 * share;
}

static void give_birth(struct sph *s, int i)
{
    const double *x = state_row(&s->p, s->p.y, i);
    double way[3];
    const double reach = 0.5 * s->dx, h = s->walls ? walls_way(s, x, reach, way) : reach;
    for (int k = 0; k < 1 << s->dim; k++) {
        double d[3];
        for (int a = 0; a < 3; a++)
            d[a] = (k >> a & 1 ? 0.25 : -0.25) * s->dx;
        if (h > 0.0 && h < reach)
            heed_walls(s, x, h, way, d);
        bear(s, s->finer, i, d);
    }
    s->p.role[i] |= ROLE_MOTHER;
}

/* Mothers of one level. */
static void enter(struct sph *s, const double *next)
{
    s->finer->p.nghost = 0;
    for (int i = 0; i < s->p.n; i++)
        if (!(s->p.role[i] & ROLE_MOTHER) && next[i] >= 0.0)
            give_birth(s, i);
        else if (next[i] < -hysteresis * s->dx)
            s->p.role[i] &= (unsigned char)~ROLE_MOTHER;
}

static void leave(struct sph *s, struct depths *is)
{
    for (int i = 0; i < s->p.n;)
        if (is->own[i] < -2.0 * hysteresis * s->dx) {
            particles_copy(&s->p, i, --s->p.n);
            is->own[i] = is->own[s->p.n];
            if (is->next)
                is->next[i] = is->next[s->p.n];
        } else {
            i++;
        }
}

static void adapt_level(const struct regions *g, struct sph *s)
{
    struct depths is = {s->coarser ? measure(g, s, s->level) : NULL,
                        s->finer ? measure(g, s, s->level + 1) : NULL};
    if (s->finer)
        enter(s, is.next);
    if (s->coarser)
        leave(s, &is);
    for (int i = 0; i < s->p.n; i++)
        s->p.role[i] = (unsigned char)((s->p.role[i] & ROLE_MOTHER) | role_of(g, s, &is, i));
    s->ready = false;
    mem_free(is.own);
    mem_free(is.next);
}

void refinement_adapt(struct sph *s)
{
    struct refinement *r = s->refinement;
    timer_start(&s->run->timers, "levels");
    const double before = flowing(s);
    regions_move(r->regions, s->t);
    for (struct sph *q = s; q; q = q->finer)
        adapt_level(r->regions, q);
    r->added += flowing(s) - before;
    timer_stop(&s->run->timers, "levels");
}

void refinement_keep_mass(struct sph *s)
{
    double sums[2] = {0.0, 0.0};
    if (s->prm.scheme != SCHEME_RIEMANN_ALE || s->zones)
        return;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i)) {
                sums[0] += state_row(&q->p, q->p.rate, i)[at_mass(q->dim)];
                sums[1] += state_row(&q->p, q->p.y, i)[at_mass(q->dim)];
            }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double share = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    for (struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i))
                state_row(&q->p, q->p.rate, i)[at_mass(q->dim)] -=
                    share * state_row(&q->p, q->p.y, i)[at_mass(q->dim)];
}

void refinement_free(struct sph *s)
{
    if (!s->refinement)
        return;
    regions_free(&s->refinement->regions);
    mem_free(s->refinement);
    s->refinement = NULL;
}

void refinement_repay(struct sph *s)
{
    struct refinement *r = s->refinement;
    double sums[2] = {r->added, flowing(s)};
    if (s->zones)
        return;
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double debt = sums[1] > 0.0 ? (sums[0] - r->repaid) / sums[1] : 0.0;
    const double part = fmax(-most_paid, fmin(paid_back * debt, most_paid));
    if (fabs(debt) < 1e-12)
        return;
    r->repaid += part * sums[1];
    for (struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            for (int k = q->dim; k < q->p.nstate && !particles_is_guard(&q->p, i); k++)
                state_row(&q->p, q->p.y, i)[k] *= 1.0 - part;
}

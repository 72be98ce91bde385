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

static const double hysteresis = 0.5;                   /* coarser dx */
static const double paid_back = 0.01, most_paid = 1e-5; /* a step: of the debt; of the mass */
static const double steepest = 0.05; /* change of rho from mother to child, its share */

struct standing refinement_standing(const struct sph *base, int level, const double *x)
{
    const struct regions *g = base->refinement->regions;
    const int finest = regions_levels(g);
    struct standing is = {0, level};
    if (level > 0) {
        const double R = ldexp(base->R, -level), d = regions_distance(g, level, x);
        if (d < 2.0 * R) { /* guards of the finer level */
            is.role = ROLE_GUARD | (d < R ? ROLE_EDGE : 0);
            return is;
        }
    }
    for (int n = level + 1; n <= finest; n++) {
        const double R = ldexp(base->R, 1 - n), d = regions_distance(g, n, x);
        if (d < R)
            break;
        is.source = n;
        is.role |= ROLE_GUARD;
        if (n == level + 1 && d > 3.25 * R) /* slopes of guards reach 2 R deep, with what moves */
            is.role |= ROLE_DEEP;
    }
    return is;
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

static void give_birth(struct sph *s, int i)
{
    for (int k = 0; k < 1 << s->dim; k++) {
        double d[3];
        for (int a = 0; a < 3; a++)
            d[a] = (k >> a & 1 ? 0.25 : -0.25) * s->dx;
        bear(s, s->finer, i, d);
    }
    s->p.role[i] |= ROLE_MOTHER;
}

/* Mothers of one level. */
static void enter(const struct sph *base, struct sph *s)
{
    const struct regions *g = base->refinement->regions;
    s->finer->p.nghost = 0;
    for (int i = 0; i < s->p.n; i++) {
        const double d = regions_distance(g, s->level + 1, state_row(&s->p, s->p.y, i));
        if (!(s->p.role[i] & ROLE_MOTHER) && d >= 0.0)
            give_birth(s, i);
        else if (d < -hysteresis * s->dx)
            s->p.role[i] &= (unsigned char)~ROLE_MOTHER;
    }
}

static void leave(const struct sph *base, struct sph *s)
{
    const struct regions *g = base->refinement->regions;
    for (int i = 0; i < s->p.n;)
        if (regions_distance(g, s->level, state_row(&s->p, s->p.y, i)) < -2.0 * hysteresis * s->dx)
            particles_copy(&s->p, i, --s->p.n);
        else
            i++;
}

static void judge(const struct sph *base, struct sph *s)
{
    for (int i = 0; i < s->p.n; i++) {
        const struct standing is = refinement_standing(base, s->level, state_row(&s->p, s->p.y, i));
        s->p.role[i] = (unsigned char)((s->p.role[i] & ROLE_MOTHER) | is.role);
    }
}

void refinement_adapt(struct sph *s)
{
    struct refinement *r = s->refinement;
    timer_start(&s->run->timers, "levels");
    const double before = flowing(s);
    regions_move(s->refinement->regions, s->t);
    for (struct sph *q = s; q->finer; q = q->finer)
        enter(s, q);
    for (struct sph *q = s->finer; q; q = q->finer)
        leave(s, q);
    for (struct sph *q = s; q; q = q->finer) {
        judge(s, q);
        q->ready = false;
    }
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

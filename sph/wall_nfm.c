/* wall_nfm.c - normal flux walls in 2D (Chiron 2017, chapter 4): the wall enters every sum of a
 * particle by an integral over the part of it within the support, and the Shepard factor gamma
 * makes up for what is missing. No wall particles; no particle passes. Each segment has one flux,
 * at the centre of its weight. SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "eos.h"
#include "forces.h"
#include "kernel.h"
#include "neighbours.h"
#include "scheme.h"
#include "wall_list.h"
#include "wall_moments.h"

enum { PRIM = 8, SLOPE = 8, STATE = 6, RATIOS = 64 };

static const double least_gamma = 0.2; /* of corners below 72 degrees: 15 ran away with 0.1 */

struct nfm {
    struct wall_list list;
    double crowding[RATIOS + 1]; /* see tabulate */
};

/* int (W + 0.04 W^5/W(dx)^4) over int W of a plane at the distance k/RATIOS R: what the function
 * whose gradient the crowding vector sums [4.89] has more than the kernel. Midpoints. */
static void tabulate(const struct sph *s, double *ratio)
{
    enum { POINTS = 200 };
    const double W0 = kernel_w(2, s->dx / s->R, 1.0);
    for (int k = 0; k < RATIOS; k++) {
        const double d = (double)k / RATIOS, half = sqrt(1.0 - d * d);
        double sum = 0.0, more = 0.0;
        for (int j = 0; j < POINTS; j++) {
            const double y = (j + 0.5) / POINTS * half, W = kernel_w(2, hypot(d, y), 1.0);
            const double q = W / W0;
            sum += W;
            more += 0.04 * W * q * q * q * q;
        }
        ratio[k] = 1.0 + more / sum;
    }
    ratio[RATIOS] = 1.0;
}

static void *nfm_create(struct sph *s)
{
    struct nfm *m = NEW(struct nfm, 1);
    tabulate(s, m->crowding);
    return m;
}

static void nfm_destroy(void *state)
{
    struct nfm *m = state;
    wall_list_free(&m->list);
    mem_free(m);
}

static void list(struct sph *s)
{
    struct nfm *m = s->walls->state;
    wall_list_build(s, &m->list);
}

/* int G ds of one segment, G the function of the crowding vector: by the ratio of a plane as far
 * away as the segment, or for Oger's, whose support is shorter, the kernel of that. */
static double crowding(const struct sph *s, const struct nfm *m, const struct wall_touch *t)
{
    const struct segment *g = s->walls->segments + t->segment;
    if (s->prm.transport == TRANSPORT_TVO) {
        const double R = fmin(2.0 * s->dx, s->R);
        return wall_moments(t->height / R, t->from / R, (t->from + g->length) / R).W / R;
    }
    const double out = fmax(0.0, fmax(t->from, -t->from - g->length));
    const double at = RATIOS * fmin(hypot(t->height, out) / s->R, 1.0);
    const int k = at < RATIOS ? (int)at : RATIOS - 1;
    return t->W * (m->crowding[k] + (at - k) * (m->crowding[k + 1] - m->crowding[k]));
}

/* Adds what the wall does to the crowding vector [4.89]. */
static void add_crowding(const struct sph *s, const struct nfm *m, int k)
{
    const bool oger = s->prm.transport == TRANSPORT_TVO;
    const struct wall_list *l = &m->list;
    const double *u = s->p.prim + (size_t)PRIM * l->who[k] + 2;
    double *u0 = s->p.slope + (size_t)SLOPE * l->who[k] + 6, sum[2] = {0.0, 0.0};
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        if (t->W == 0.0)
            continue;
        const double G = crowding(s, m, t);
        for (int a = 0; a < 2; a++)
            sum[a] += G * s->walls->segments[t->segment].n[a];
    }
    const double R = oger ? fmin(2.0 * s->dx, s->R) : s->R;
    const double factor = (oger ? 1.0 : 2.0) * s->shift_speed * R;
    const double gamma = fmax(l->gamma[k], least_gamma);
    for (int a = 0; a < 2; a++)
        u0[a] = u[a] + (u0[a] - u[a] - factor * sum[a]) / gamma;
}

static void slopes(struct sph *s)
{
    struct nfm *m = s->walls->state;
    const bool shifts = s->prm.transport == TRANSPORT_TVS || s->prm.transport == TRANSPORT_TVO;
    if (!m->list.measured)
        wall_list_measure(s, &m->list);
    m->list.measured = false; /* the next stage has other places */
    for (int k = 0; shifts && k < m->list.n; k++)
        add_crowding(s, m, k);
}

/* A particle as the wall sees it. */
struct seen {
    const double *x, *u, *u0, *grho, *gu;
    double rho, p, c, w, damped;
};

/* What the wall gives to a particle, over its volume. */
struct given {
    double q[2], w, m;
};

/* Pressure on the wall at e from the particle: state carried there and bounded [4.30-4.32], then
 * the wave that runs to the wall [4.14]. Its part `near' alone: what the carried velocity misses of
 * the wall's is an error of the distance squared, and c times that is a drag (C_D 0.49 -> 0.07 of a
 * cylinder of a/dx = 8). */
static double wall_pressure(const struct sph *s, const struct seen *i, const double *e, double near,
                            const double *uw, const double *n)
{
    const double most = 0.1 * i->rho * i->c;
    double rho = i->rho + i->grho[0] * e[0] + i->grho[1] * e[1], un = 0.0;
    rho = fmax(0.99 * i->rho, fmin(rho, 1.01 * i->rho));
    for (int a = 0; a < 2; a++) {
        const double u = i->u[a] + i->gu[2 * a] * e[0] + i->gu[2 * a + 1] * e[1];
        const double q = fmax(-most, fmin(rho * (u - uw[a]), most));
        un += q / rho * n[a];
    }
    return eos_p(rho, s->rho0, s->c0, s->gamma) +
           near * rho * eos_c(rho, s->rho0, s->c0, s->gamma) * un;
}

static bool is_riemann(const struct sph *s) { return s->prm.scheme <= SCHEME_RIEMANN; }

/* Whether the wave to a segment counts in full: of bodies alone it does not. Pairs of delta are too
 * calm without it; over walls at rest it is what holds the layer beside them: an open tank at rest
 * loses its particles through slip walls after 1e4 steps, with a share of 0.2 or 0.4 as well, and
 * the damping of a standing wave over a no-slip bottom errs by 4.6 instead of 0.4 % (H/dx = 25). */
static bool whole_wave(const struct sph *s, const struct segment *g)
{
    return !is_riemann(s) || g->body < 0;
}

/* One segment: pressure, volume, friction, and for ALE what runs with u - u0 [4.26-4.29]. */
static struct given flux(const struct sph *s, const struct wall_touch *t, const struct seen *i)
{
    const struct segment *g = s->walls->segments + t->segment;
    const bool ale = s->prm.scheme == SCHEME_RIEMANN_ALE;
    const double *moved = ale ? i->u0 : i->u, mu = s->rho0 * s->nu;
    const double x[2] = {i->x[0] + t->e[0], i->x[1] + t->e[1]};
    double uw[2], across = 0.0, drift = 0.0;
    walls_velocity(s->walls, g, x, uw, NULL);
    for (int a = 0; a < 2; a++) {
        across += (uw[a] - moved[a]) * g->n[a];
        drift += (i->u[a] - i->u0[a]) * g->n[a];
    }
    const double m = ale ? i->rho * drift : 0.0;
    const double near = whole_wave(s, g) ? 1.0 : t->near;
    const double P = i->p + wall_pressure(s, i, t->e, near, uw, g->n) - 2.0 * i->damped;
    struct given to = {.w = t->W * across, .m = -t->W * m};
    for (int a = 0; a < 2; a++)
        to.q[a] = -t->W * (m * i->u[a] + P * g->n[a]);
    /* not from a face seen at grazing angle */
    const bool foot = t->from <= 0.0 && t->from + g->length >= 0.0;
    if (g->no_slip && mu > 0.0 && (foot || t->height > 0.25 * s->dx))
        for (int a = 0; a < 2; a++)
            to.q[a] -= 2.0 * mu * t->W * (i->u[a] - uw[a]) / fmax(t->height, 0.25 * s->dx);
    return to;
}

static struct seen look(const struct sph *s, int i)
{
    const double *q = s->p.prim + (size_t)PRIM * i, *g = s->p.slope + (size_t)SLOPE * i;
    const double damper = s->prm.damper * s->rho0 * s->c0 * s->R;
    return (struct seen){.x = q,
                         .u = q + 2,
                         .u0 = g + 6,
                         .grho = g,
                         .gu = g + 2,
                         .rho = q[5],
                         .p = eos_p(q[5], s->rho0, s->c0, s->gamma),
                         .c = eos_c(q[5], s->rho0, s->c0, s->gamma),
                         .w = q[4],
                         .damped = is_riemann(s) ? damper * (g[2] + g[5]) : 0.0};
}

static bool takes_along(const struct sph *s)
{
    return !is_riemann(s) &&
           (s->prm.transport == TRANSPORT_TVS || s->prm.transport == TRANSPORT_TVO);
}

/* Sums of pairs and walls over gamma; what a particle so loses more or less than its partners gain
 * goes to the walls: each segment has its own flux, and of the pairs' sum what its part of gamma
 * makes of it. Bodies and fluid so exchange momentum to the last digit. */
static void add_walls(struct sph *s, const struct nfm *m, int k)
{
    const struct wall_list *l = &m->list;
    const int who = l->who[k];
    const struct seen i = look(s, who);
    const double gamma = fmax(l->gamma[k], least_gamma), gamma_1 = 1.0 / gamma;
    double *rate = s->p.rate + (size_t)STATE * who, pairs[2], sum = 0.0, own[STATE] = {0.0};
    const double mass = s->p.y[(size_t)STATE * who + 5];
    if (takes_along(s))
        scheme_take_along(s, who, own);
    for (int j = l->first[k]; j < l->first[k + 1]; j++)
        sum += l->touch[j].gamma;
    for (int a = 0; a < 2; a++) {
        own[2 + a] += mass * s->gravity[a];
        pairs[a] = rate[2 + a] - own[2 + a];
    }
    const double share = fabs(sum) > 1e-9 ? (gamma_1 - 1.0) / sum : 0.0;
    struct given all = {0};
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        if (t->W == 0.0)
            continue;
        const struct given to = flux(s, t, &i);
        double force[2];
        for (int a = 0; a < 2; a++) {
            all.q[a] += to.q[a];
            force[a] = -(i.w * to.q[a] * gamma_1 + share * t->gamma * pairs[a]);
        }
        all.w += to.w;
        all.m += to.m;
        forces_add(s->walls, s->walls->segments[t->segment].body, i.x, force);
    }
    for (int a = 0; a < 2; a++)
        rate[2 + a] = (pairs[a] + i.w * all.q[a]) * gamma_1 + own[2 + a];
    rate[4] = (rate[4] - own[4] + i.w * all.w) * gamma_1 + own[4];
    rate[5] = (rate[5] + i.w * all.m) * gamma_1;
}

static void rates(struct sph *s)
{
    const struct nfm *m = s->walls->state;
    forces_clear(s->walls);
    for (int k = 0; k < m->list.n; k++)
        add_walls(s, m, k);
    if (s->prm.scheme == SCHEME_RIEMANN_ALE && !s->zones)
        walls_keep_mass(s, m->list.n, m->list.who);
}

/* Particles that the surface has not looked at (M = 0: neighbours enough) stay so. */
static void moments(struct sph *s, double *M, double *g)
{
    struct nfm *m = s->walls->state;
    struct wall_list *l = &m->list;
    wall_list_measure(s, l);
    for (int k = 0; k < l->n; k++) {
        const int i = l->who[k];
        const double gamma_1 = 1.0 / fmax(l->gamma[k], least_gamma);
        double *Mi = M + (size_t)4 * i, *gi = g + (size_t)2 * i;
        if (Mi[0] + Mi[3] == 0.0 && s->list->count[i] > 0)
            continue;
        for (int j = l->first[k]; j < l->first[k + 1]; j++) {
            const struct wall_touch *t = l->touch + j;
            const double *n = s->walls->segments[t->segment].n;
            for (int a = 0; a < 2; a++) {
                gi[a] += t->W * n[a];
                for (int b = 0; b < 2; b++)
                    Mi[2 * a + b] += t->W * t->e[a] * n[b];
            }
        }
        for (int a = 0; a < 4; a++)
            Mi[a] *= gamma_1;
        for (int a = 0; a < 2; a++)
            gi[a] *= gamma_1;
    }
}

static void gammas(struct sph *s, double *gamma)
{
    struct nfm *m = s->walls->state;
    wall_list_measure(s, &m->list);
    m->list.measured = false;
    for (int k = 0; k < m->list.n; k++)
        gamma[m->list.who[k]] = m->list.gamma[k];
}

static int behind(const struct sph *s, int *who)
{
    const struct nfm *m = s->walls->state;
    return wall_list_behind(s, &m->list, who);
}

const struct wall_model wall_nfm = {.name = "normal_flux_walls",
                                    .create = nfm_create,
                                    .destroy = nfm_destroy,
                                    .list = list,
                                    .slopes = slopes,
                                    .rates = rates,
                                    .moments = moments,
                                    .gammas = gammas,
                                    .behind = behind};

/* wall_nfm.c - normal flux walls in 2D (Chiron 2017, chapter 4): the wall enters every sum of a
 * particle by an integral over the part of it within the support, and the Shepard factor gamma
 * makes up for what is missing. No wall particles; no particle passes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "eos.h"
#include "kernel.h"
#include "neighbours.h"
#include "shepard2d.h"
#include "wall_points.h"

enum { PRIM = 8, SLOPE = 8, STATE = 6 };

static const double least_gamma = 0.2; /* of corners below 72 degrees: 15 ran away with 0.1 */

/* Particles near walls, and the segments near each. */
struct nfm {
    int n, capacity;
    int *who, *first; /* [n], [n+1] */
    int *segment;     /* [first[n]] */
    int segments_capacity;
    double *gamma; /* [n] of this stage */
};

static void *nfm_create(struct sph *s)
{
    (void)s;
    return NEW(struct nfm, 1);
}

static void nfm_destroy(void *state)
{
    struct nfm *m = state;
    mem_free(m->who);
    mem_free(m->first);
    mem_free(m->segment);
    mem_free(m->gamma);
    mem_free(m);
}

static void room(struct nfm *m, int segments)
{
    if (m->n + 2 > m->capacity) {
        const int more = 2 * m->capacity + 256;
        GROW(m->who, m->capacity, more);
        GROW(m->first, m->capacity, more);
        GROW(m->gamma, m->capacity, more);
        m->capacity = more;
    }
    if (segments > m->segments_capacity) {
        const int more = 2 * segments + 256;
        GROW(m->segment, m->segments_capacity, more);
        m->segments_capacity = more;
    }
}

static bool is_near(const struct segment *g, const double *x, double reach)
{
    const double d[2] = {x[0] - g->a[0], x[1] - g->a[1]};
    const double height = d[0] * g->n[0] + d[1] * g->n[1];
    double out = d[0] * g->t[0] + d[1] * g->t[1];
    out = out < 0.0 ? -out : out > g->length ? out - g->length : 0.0;
    return height * height + out * out < reach * reach;
}

/* Box around all segments, so that most particles need four comparisons. */
static void list(struct sph *s)
{
    const struct walls *w = s->walls;
    struct nfm *m = w->state;
    const double reach = s->R + s->skin + w->speed * s->dt_most;
    int nseg = 0;
    m->n = 0;
    room(m, w->nsegments);
    for (int i = 0; i < s->p.n; i++) {
        const double *x = s->p.prim + (size_t)PRIM * i;
        const int before = nseg;
        room(m, nseg + w->nsegments);
        for (int k = 0; k < w->nsegments; k++)
            if (is_near(w->segments + k, x, reach))
                m->segment[nseg++] = k;
        if (nseg > before) {
            m->who[m->n] = i;
            m->first[m->n++] = before;
        }
    }
    m->first[m->n] = nseg;
}

static double gamma_at(const struct walls *w, const struct nfm *m, int k, const double *x, double R)
{
    double gamma = 1.0;
    for (int j = m->first[k]; j < m->first[k + 1]; j++) {
        const struct segment *g = w->segments + m->segment[j];
        const double a[2] = {(g->a[0] - x[0]) / R, (g->a[1] - x[1]) / R};
        const double along = g->t[0] * a[0] + g->t[1] * a[1];
        gamma += shepard_segment(g->n[0] * a[0] + g->n[1] * a[1], along, along + g->length / R);
    }
    return gamma > 1.0 + 1e-6 ? gamma - 1.0 : gamma; /* behind a wall it counts one more */
}

/* Adds what the wall does to the crowding vector [4.89]: its surface integral of the function whose
 * gradient the pair sum has. */
static void add_crowding(const struct sph *s, const struct walls *w, const struct nfm *m, int k)
{
    const bool oger = s->prm.transport == TRANSPORT_TVO;
    const double R = oger ? fmin(2.0 * s->dx, s->R) : s->R, W0 = kernel_w(2, s->dx, s->R);
    const double *x = s->p.prim + (size_t)PRIM * m->who[k], *u = x + 2;
    double *u0 = s->p.slope + (size_t)SLOPE * m->who[k] + 6, sum[2] = {0.0, 0.0};
    for (int j = m->first[k]; j < m->first[k + 1]; j++) {
        struct wall_point at[WALL_POINTS];
        const struct segment *g = w->segments + m->segment[j];
        const int n = wall_points(g, x, R, at);
        for (int l = 0; l < n; l++) {
            const double q = at[l].W / W0, q2 = q * q;
            const double G = at[l].W * (oger ? 1.0 : 1.0 + 0.04 * q2 * q2);
            sum[0] += at[l].weight * G * g->n[0];
            sum[1] += at[l].weight * G * g->n[1];
        }
    }
    const double factor = (oger ? 1.0 : 2.0) * s->shift_speed * R;
    const double gamma = fmax(m->gamma[k], least_gamma);
    for (int a = 0; a < 2; a++)
        u0[a] = u[a] + (u0[a] - u[a] - factor * sum[a]) / gamma;
}

static void slopes(struct sph *s)
{
    const struct walls *w = s->walls;
    struct nfm *m = w->state;
    const bool shifts = s->prm.transport == TRANSPORT_TVS || s->prm.transport == TRANSPORT_TVO;
    for (int k = 0; k < m->n; k++) {
        m->gamma[k] = gamma_at(w, m, k, s->p.prim + (size_t)PRIM * m->who[k], s->R);
        if (shifts)
            add_crowding(s, w, m, k);
    }
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
 * the wave that runs to the wall [4.14]. */
static double wall_pressure(const struct sph *s, const struct seen *i, const double *e,
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
    return eos_p(rho, s->rho0, s->c0, s->gamma) + rho * eos_c(rho, s->rho0, s->c0, s->gamma) * un;
}

/* One segment: pressure, volume, friction, and for ALE what runs with u - u0 [4.26-4.29]. */
static void add_segment(const struct sph *s, const struct walls *w, const struct segment *g,
                        const struct seen *i, struct given *to)
{
    const bool ale = s->prm.scheme == SCHEME_RIEMANN_ALE;
    const double *moved = ale ? i->u0 : i->u, mu = s->rho0 * s->nu;
    const double d = (g->a[0] - i->x[0]) * g->n[0] + (g->a[1] - i->x[1]) * g->n[1];
    struct wall_point at[WALL_POINTS];
    bool foot;
    const int n = wall_points_foot(g, i->x, s->R, at, &foot);
    const bool rubs = g->no_slip && mu > 0.0 && (foot || d > 0.25 * s->dx);
    const double distance = fmax(d, 0.25 * s->dx);
    for (int l = 0; l < n; l++) {
        const double e[2] = {at[l].x[0] - i->x[0], at[l].x[1] - i->x[1]},
                     W = at[l].W * at[l].weight;
        double uw[2];
        walls_velocity(w, g, at[l].x, uw, NULL);
        const double a =
            ale ? i->rho * ((i->u[0] - i->u0[0]) * g->n[0] + (i->u[1] - i->u0[1]) * g->n[1]) : 0.0;
        const double P = i->p + wall_pressure(s, i, e, uw, g->n) - 2.0 * i->damped;
        for (int b = 0; b < 2; b++) {
            to->q[b] -= W * (a * i->u[b] + P * g->n[b]);
            to->w += W * (uw[b] - moved[b]) * g->n[b];
            if (rubs)
                to->q[b] -= 2.0 * mu * W * (i->u[b] - uw[b]) / distance;
        }
        to->m -= W * a;
    }
}

static struct seen look(const struct sph *s, int i)
{
    const double *q = s->p.prim + (size_t)PRIM * i, *g = s->p.slope + (size_t)SLOPE * i;
    return (struct seen){.x = q,
                         .u = q + 2,
                         .u0 = g + 6,
                         .grho = g,
                         .gu = g + 2,
                         .rho = q[5],
                         .p = eos_p(q[5], s->rho0, s->c0, s->gamma),
                         .c = eos_c(q[5], s->rho0, s->c0, s->gamma),
                         .w = q[4],
                         .damped = s->prm.damper * s->rho0 * s->c0 * s->R * (g[2] + g[5])};
}

double walls_pressure(const struct sph *s, int i, const double *x, const double *uw,
                      const double *n)
{
    const struct seen seen = look(s, i);
    const double e[2] = {x[0] - seen.x[0], x[1] - seen.x[1]};
    return wall_pressure(s, &seen, e, uw, n);
}

static void rates(struct sph *s)
{
    const struct walls *w = s->walls;
    const struct nfm *m = w->state;
    for (int k = 0; k < m->n; k++) {
        const double mass = s->p.y[(size_t)STATE * m->who[k] + 5];
        double *rate = s->p.rate + (size_t)STATE * m->who[k];
        const struct seen i = look(s, m->who[k]);
        struct given to = {0};
        for (int j = m->first[k]; j < m->first[k + 1]; j++)
            add_segment(s, w, w->segments + m->segment[j], &i, &to);
        const double gamma_1 = 1.0 / fmax(m->gamma[k], least_gamma);
        for (int a = 0; a < 2; a++)
            rate[2 + a] = (rate[2 + a] - mass * s->gravity[a] + i.w * to.q[a]) * gamma_1 +
                          mass * s->gravity[a];
        rate[4] = (rate[4] + i.w * to.w) * gamma_1;
        rate[5] = (rate[5] + i.w * to.m) * gamma_1;
    }
    if (s->prm.scheme == SCHEME_RIEMANN_ALE && !s->zones)
        walls_keep_mass(s, m->n, m->who);
}

static void add_wall_moments(const struct sph *s, const struct nfm *m, int k, double *M, double *g)
{
    const struct walls *w = s->walls;
    const double *x = s->p.prim + (size_t)PRIM * m->who[k];
    for (int j = m->first[k]; j < m->first[k + 1]; j++) {
        struct wall_point at[WALL_POINTS];
        const struct segment *is = w->segments + m->segment[j];
        const int n = wall_points(is, x, s->R, at);
        for (int l = 0; l < n; l++) {
            const double W = at[l].W * at[l].weight;
            for (int a = 0; a < 2; a++) {
                g[a] += W * is->n[a];
                for (int b = 0; b < 2; b++)
                    M[2 * a + b] += W * (at[l].x[a] - x[a]) * is->n[b];
            }
        }
    }
}

/* Particles that the surface has not looked at (M = 0: neighbours enough) stay so. */
static void moments(struct sph *s, double *M, double *g)
{
    struct nfm *m = s->walls->state;
    for (int k = 0; k < m->n; k++) {
        const int i = m->who[k];
        double *Mi = M + (size_t)4 * i, *gi = g + (size_t)2 * i;
        if (Mi[0] + Mi[3] == 0.0 && s->list->count[i] > 0)
            continue;
        const double gamma = gamma_at(s->walls, m, k, s->p.prim + (size_t)PRIM * i, s->R);
        add_wall_moments(s, m, k, Mi, gi);
        for (int a = 0; a < 4; a++)
            Mi[a] /= fmax(gamma, least_gamma);
        for (int a = 0; a < 2; a++)
            gi[a] /= fmax(gamma, least_gamma);
    }
}

static void gammas(struct sph *s, double *gamma)
{
    const struct nfm *m = s->walls->state;
    for (int k = 0; k < m->n; k++)
        gamma[m->who[k]] = gamma_at(s->walls, m, k, s->p.prim + (size_t)PRIM * m->who[k], s->R);
}

static int behind(const struct sph *s, int *who)
{
    const struct nfm *m = s->walls->state;
    int n = 0;
    for (int k = 0; k < m->n; k++)
        if (walls_distance(s->walls, s->p.y + (size_t)STATE * m->who[k], s->R) < 0.0)
            who[n++] = m->who[k];
    return n;
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

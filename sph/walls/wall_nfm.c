/* wall_nfm.c - normal flux walls (Chiron 2017, chapter 4): the wall enters every sum of a particle
 * by an integral over the part of it within the support, and the Shepard factor gamma makes up for
 * what is missing. No wall particles; no particle passes. Each piece s of wall, a segment or a
 * triangle, has one flux, at the centre of its weight W_s, the integral of W over it; with its
 * normal n out of the fluid, its velocity u_s and `pairs' for the sums of the second pass,
 *   dq_i/dt = (pairs - w_i sum_s W_s (m_s u_i + (p_i + p_s) n))/gamma_i + m_i g
 *   dw_i/dt = (pairs + w_i sum_s W_s (u_s - u).n)/gamma_i      (u: u0 in ALE, else u)
 *   dm_i/dt = (pairs - w_i sum_s W_s m_s)/gamma_i,   m_s = rho_i (u_i - u0_i).n in ALE, else 0
 * [4.26-4.29] p_s is the pressure of the state carried to the wall [4.30-4.32] plus that of the
 * wave that runs to it, rho c (u - u_s).n [4.14]. No-slip walls add -2 mu W_s (u_i - u_s)/height,
 * the height being at least dx/2. SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"
#include "forces.h"
#include "wall_air.h"
#include "wall_friction.h"
#include "wall_gap.h"
#include "wall_layers.h"
#include "wall_list.h"
#include "wall_rims.h"

enum { RATIOS = 64 };

static const double least_gamma = 0.2; /* of corners below 72 degrees: 15 ran away with 0.1 */

struct nfm {
    struct wall_list list;
    double crowding[RATIOS + 1]; /* wall_layers.h */
    double mu; /* Pa s: that of the pairs whose sum the weight of friction closes, else rho0 nu */
    double streams;     /* 0 to 1: how much water streams, away from a surface */
    double *room;       /* [RATIOS + 1] wall_layers.h; NULL until somebody asks */
    double row;         /* 1/m: int W dS of a plane as far away as a first row, dx/2 */
    double (*empty)[3]; /* [list.n] of this stage, 0 without shift: see wall_air_gap */
    /* With levels [touches of list]: whether its force counts, see judge; of this list. */
    bool judged, *pushes;
    double (*q)[3], (*rub)[3]; /* N/m^dim: fluxes of the touches of the particle at hand; of these
                                  friction, if there is any */
};

static void *nfm_create(struct sph *s)
{
    struct nfm *m = NEW(struct nfm, 1);
    m->list.owner = m;
    wall_layers_tabulate(s, RATIOS, m->crowding);
    m->row = 4.0 * s->dx / s->R * wall_layers_plane(s, 0.5 * s->dx);
    return m;
}

/* Once a step. Which pieces a level pushes depends on places, too, so it is judged anew. */
static void list(struct sph *s)
{
    struct nfm *m = s->walls->state;
    wall_list_build(s, &m->list);
    ROOM_IN(m, m->empty, m->list.n);
    for (int k = 0; k < m->list.n; k++) {
        s->list->beside[m->list.who[k]] = true;
        memset(m->empty[k], 0, sizeof m->empty[k]);
    }
    m->judged = false;
}

/* A place of a wall is pushed by all particles that see it of the level that flows there, guards or
 * not: their kernels make up one. Of what flows alone, of both levels, they do not: coarse
 * particles behind fine ones push as well, 17 % too much with 0.7 R of fine ones. */
static void judge(const struct sph *s, struct nfm *m)
{
    const struct wall_list *l = &m->list;
    ROOM_IN(m, m->pushes, l->first[l->n]);
    for (int k = 0; k < l->n; k++)
        for (int j = l->first[k]; j < l->first[k + 1]; j++) {
            double x[3];
            for (int a = 0; a < s->dim; a++)
                x[a] = prim_line(&s->p, l->who[k])[a] + l->touch[j].is.e[a];
            m->pushes[j] = l->touch[j].is.W > 0.0 && s->places->flows(s, x);
        }
    m->judged = true;
}

static bool pushes(const struct sph *s, const struct nfm *m, const struct wall_touch *t)
{
    return !s->places || m->pushes[t - m->list.touch];
}

/* Of what the touches of particle k take from its gamma, that of those that push. */
static double gamma_of_pushing(const struct sph *s, const struct nfm *m, int k)
{
    const struct wall_list *l = &m->list;
    double sum = 0.0;
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++)
        sum += pushes(s, m, t) ? fabs(t->is.gamma) : 0.0;
    return sum;
}

/* The same over that of all its touches. */
static double share_that_pushes(const struct sph *s, const struct nfm *m, int k)
{
    const struct wall_list *l = &m->list;
    double all = 0.0;
    if (!s->places)
        return 1.0;
    for (int j = l->first[k]; j < l->first[k + 1]; j++)
        all += fabs(l->touch[j].is.gamma);
    return all > 0.0 ? gamma_of_pushing(s, m, k) / all : 0.0;
}

/* Of a table over distances from 0 to R, in units of R. Linear between RATIOS + 1 nodes; beyond R
 * the last value. */
static double ratio_at(const double *table, double distance)
{
    const double at = RATIOS * fmin(distance, 1.0);
    const int k = at < RATIOS ? (int)at : RATIOS - 1;
    return table[k] + (at - k) * (table[k + 1] - table[k]);
}

/* int G dS of one piece, G the function of the crowding vector: by the ratio of a plane as far away
 * as the piece, or for Oger's, whose support is shorter, the kernel of that. */
static double crowding(const struct sph *s, const struct nfm *m, const struct wall_touch *t,
                       const double *x)
{
    if (s->prm.transport == TRANSPORT_TVO)
        return wall_list_weight(s, &m->list, t, x, fmin(2.0 * s->dx, s->R));
    return t->is.W * ratio_at(m->crowding, t->distance / s->R);
}

/* Marks those whose support meets a wall: where no shift may press them against it. */
static void mark_beside_walls(struct sph *s, const struct wall_list *l)
{
    struct walls *w = s->walls;
    ROOM_IN(w, w->beside, s->p.n);
    for (int i = 0; i < s->p.n; i++)
        w->beside[i] = false;
    for (int k = 0; k < l->n; k++)
        w->beside[l->who[k]] = l->gamma[k] < 1.0 - 1e-6; /* not by the last digits */
}

/* Takes from a shift what presses a particle nearer than dx/4 to a wall against it, by its
 * distance. A row on the wall itself is as good a rest for the crowding vector as one dx/2 before
 * it, whole rows fill the half space either way; but there the least shift leads behind the wall.
 * In a pipe of Re 25, 8 dx wide, a quarter of the outlet's particles lay on the wall and came back
 * at each step. */
static void shift_before_walls(const struct sph *s, const struct wall_list *l, int k)
{
    const int dim = s->dim;
    const double near = 0.25 * s->dx, *u = prim_line(&s->p, l->who[k]) + dim;
    double *u0 = slope_line(&s->p, l->who[k]) + dim + dim * dim;
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        double across = 0.0;
        if (!t->foot || t->height >= near || t->height < 0.0)
            continue;
        for (int a = 0; a < dim; a++)
            across += (u0[a] - u[a]) * t->n[a];
        for (int a = 0; a < dim && across > 0.0; a++)
            u0[a] -= (1.0 - t->height / near) * across * t->n[a];
    }
}

/* Adds what the wall does to the crowding vector [4.89]. */
static void add_crowding(const struct sph *s, struct nfm *m, int k)
{
    const bool oger = s->prm.transport == TRANSPORT_TVO;
    const struct wall_list *l = &m->list;
    const int dim = s->dim;
    const double *x = prim_line(&s->p, l->who[k]), *u = x + dim;
    double *u0 = slope_line(&s->p, l->who[k]) + dim + dim * dim, sum[3] = {0.0, 0.0, 0.0};
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        if (t->is.W == 0.0 && !t->joined)
            continue;
        const double G = crowding(s, m, t, x);
        for (int a = 0; a < dim; a++)
            sum[a] += G * t->n[a];
    }
    for (int a = 0; l->rim && a < dim; a++)
        sum[a] += l->rim[k][a];
    const double R = oger ? fmin(2.0 * s->dx, s->R) : s->R;
    const double factor = (oger ? 1.0 : 2.0) * scheme_shift_speed(s, l->who[k]) * R;
    const double gamma = fmax(l->gamma[k], least_gamma);
    for (int a = 0; a < dim; a++) {
        u0[a] = u[a] + (u0[a] - u[a] - factor * sum[a]) / gamma;
        m->empty[k][a] = factor > 0.0 && !oger ? (u0[a] - u[a]) / (factor * m->row) : 0.0;
    }
    if (!s->surface)
        shift_before_walls(s, l, k);
}

/* The last word on shifts where there is a surface: that which keeps gravity workless came later
 * than what add_crowding does without one. */
static void bound_shifts(struct sph *s)
{
    const struct nfm *m = s->walls->state;
    for (int k = 0; s->surface && k < m->list.n; k++)
        shift_before_walls(s, &m->list, k);
}

/* After the first pass: gradients and shifts of the pairs are there, rates are not. */
static void slopes(struct sph *s)
{
    struct nfm *m = s->walls->state;
    const bool shifts = s->prm.transport == TRANSPORT_TVS || s->prm.transport == TRANSPORT_TVO;
    if (!m->list.measured)
        wall_list_measure(s, &m->list);
    m->list.measured = false; /* the next stage has other places */
    if (s->surface)
        mark_beside_walls(s, &m->list);
    for (int k = 0; shifts && k < m->list.n; k++)
        add_crowding(s, m, k);
}

/* A particle as the wall sees it. */
struct seen {
    const double *x, *u, *u0, *grho, *gu;
    double rho, p, c, w, damped, mu, streams;
    bool in_air;         /* a layer one particle thick, or less */
    double open;         /* in air: see wall_air_open */
    bool film;           /* near a free surface */
    double edge;         /* there: see wall_air_edge */
    const double *empty; /* see wall_air_gap */
    struct wall_friction *friction;
};

/* What the wall gives to a particle, over its volume. */
struct given {
    double q[3], w, m;
    double rub[3]; /* of q: friction */
};

/* Pressure on the wall at e from the particle, with the background pressure as pairs have it: a
 * uniform pressure pushes nobody only if walls and pairs have the same. State carried there and
 * bounded [4.30-4.32], then the wave that runs to the wall [4.14]. Its part `near' alone: what the
 * carried velocity misses of the wall's is an error of the distance squared, and c times that is a
 * drag (C_D of a cylinder of a/dx = 8 in full, by min(1, (dx/2)^2/e^2), by the square of that:
 * 0.49, 0.32, 0.20). */
INLINE double wall_pressure(const struct sph *s, const struct seen *i, const double *e, double near,
                            double held, const double *uw, const double *n, const int dim)
{
    const double most = 0.1 * i->rho * i->c;
    double rho = i->rho, un = 0.0;
    for (int a = 0; a < dim; a++)
        rho += i->grho[a] * e[a];
    rho = fmax(0.99 * i->rho, fmin(rho, 1.01 * i->rho));
    for (int a = 0; a < dim; a++) {
        double u = i->u[a];
        for (int b = 0; b < dim; b++)
            u += i->gu[dim * a + b] * e[b];
        const double q = fmax(-most, fmin(rho * (u - uw[a]), most));
        un += q / rho * n[a];
    }
    return eos_p(rho, s->rho0, s->c0, s->gamma) + s->background +
           (un < 0.0 ? held : near) * rho * eos_c(rho, s->rho0, s->c0, s->gamma) * un;
}

static bool is_riemann(const struct sph *s) { return sph_params_is_riemann(s->prm.scheme); }

/* Whether the wave to a piece counts in full: of bodies alone, but tanks, it does not. Beside what
 * is at rest pairs of delta are too calm without it; in full it gave a disc of twelve particles
 * that oscillates 1.34 times its added mass. Over walls at rest it is what holds the layer beside
 * them: an open tank at rest loses its particles through slip walls after 1e4 steps, with a share
 * of 0.2 or 0.4 as well, and the damping of a standing wave over a no-slip bottom errs by 4.6
 * instead of 0.4 % (H/dx = 25). */
static bool whole_wave(const struct sph *s, const struct wall_touch *t)
{
    const struct body *b = t->body < 0 ? NULL : s->walls->bodies + t->body;
    return !b || b->is->tank || (!is_riemann(s) && !b->moves);
}

/* A body that moves takes less than one at rest: its drag falls, and first peaks of impacts, which
 * rise (by 12 %), are its own. Not of films that run along it, near a free surface, and part from
 * it: a jet on a plate clung to its edges and was drawn round them, 15 % of its force were missing,
 * 3 % at a plate at rest. What is slower is no film: it drew a light block down by a spacing.
 *
 * Water that streams through a room that it fills needs no holding at slip walls, and the whole
 * wave is drag there, the faster sound is the more: what goes towards a corner has a velocity
 * across the wall behind it. A channel that narrows to a half, ten particles wide, lost 15 % of the
 * head of its throat with c0 15 times the speed before it and 32 % with 60, so 2 and 8 %. */
static double share_of_wave(const struct sph *s, const struct wall_touch *t, double streams,
                            bool film)
{
    if (whole_wave(s, t))
        return t->no_slip ? 1.0 : 1.0 - streams * (1.0 - t->near);
    return s->walls->bodies[t->body].moves && !film ? t->near * t->near : t->near;
}

/* Of the negative axis of RK3, 2.51, less what pairs take of it. */
static const double most_of_wave = 2.0;

/* Waves to all pieces slow the particle down at the rate c W share / gamma along their normals: 1.0
 * to 1.3 over a step beside single walls and corners. Under a body one particle above the bottom it
 * is 3.7, and the layer turned its velocity round at each step: Mach 0.12 in water at rest. The
 * factor on the waves that keeps it bearable. */
INLINE double wave_factor(const struct sph *s, const struct wall_list *l, int k, double streams,
                          bool film, double c_gamma, const int dim)
{
    double rate[9] = {0.0}, most = 0.0;
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        const double W = wall_touch_counts(t) * share_of_wave(s, t, streams, film);
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++)
                rate[dim * a + b] += W * t->n[a] * t->n[b];
    }
    for (int a = 0; a < dim; a++) { /* the norm that bounds their eigenvalues */
        double row = 0.0;
        for (int b = 0; b < dim; b++)
            row += fabs(rate[dim * a + b]);
        most = fmax(most, row);
    }
    most *= c_gamma * s->dt;
    return most > most_of_wave ? most_of_wave / most : 1.0;
}

/* Quadratic bed friction, tau = rho c_f |u_t| u_t with the velocity along the wall; twice, as the
 * pressure of i and of the wall: half of a flat wall's weight is in the fluid. */
INLINE void add_bed_friction(const struct wall_touch *t, const struct seen *i, const double *uw,
                             double *q, const int dim)
{
    double ut[3], across = 0.0, u2 = 0.0;
    for (int a = 0; a < dim; a++)
        across += (i->u[a] - uw[a]) * t->n[a];
    for (int a = 0; a < dim; a++) {
        ut[a] = i->u[a] - uw[a] - across * t->n[a];
        u2 += ut[a] * ut[a];
    }
    for (int a = 0; a < dim; a++)
        q[a] -= 2.0 * t->is.W * i->rho * t->friction * sqrt(u2) * ut[a];
}

/* A face that lies on another's as the part of that one which it covers: what is not linear in the
 * normal (the wave, tension under roofs, friction) is taken away there, too. Left to its own normal
 * the bottom of a block was a roof to the particles beside the block, and its wave came on top of
 * the floor's: at 2 of the 3.3 that three stages bear they turned round at each step. */
INLINE const struct wall_touch *covering(const struct wall_touch *t, struct wall_touch *part,
                                         const int dim)
{
    *part = *t;
    part->is.W = -t->is.W;
    part->height = -t->height;
    for (int a = 0; a < dim; a++)
        part->n[a] = -t->n[a];
    return part;
}

/* One piece: pressure, volume, friction, and for ALE what runs with u - u0 [4.26-4.29]. */
INLINE struct given flux(const struct sph *s, const struct wall_list *l, int k,
                         const struct wall_touch *t, const struct seen *i, double wave,
                         const int dim)
{
    const bool ale = s->prm.scheme == SCHEME_RIEMANN_ALE;
    const double *moved = ale ? i->u0 : i->u;
    const double W = t->is.W * (i->in_air ? wall_air_share(s, t, i->open) : 1.0);
    double x[3], uw[3], across = 0.0, drift = 0.0;
    for (int a = 0; a < dim; a++)
        x[a] = i->x[a] + t->is.e[a];
    wall_list_velocity(s, t, x, uw);
    for (int a = 0; a < dim; a++) {
        across += (uw[a] - moved[a]) * t->n[a];
        drift += (i->u[a] - i->u0[a]) * t->n[a];
    }
    const double m = ale ? i->rho * drift : 0.0;
    const double square = i->film || i->in_air ? wall_air_square(i->u, uw, t->n, dim) : 0.0;
    const bool film = i->film && wall_air_runs_along(s, square);
    const double near = wave * share_of_wave(s, t, i->streams, false),
                 held = wave * share_of_wave(s, t, i->streams, film);
    const double flies = s->walls->near_surface ? wall_air_flies(s, i->u, uw, dim) : 0.0;
    const double beyond = flies > 0.0 ? flies * wall_air_beyond(s, l, k, t, dim) : 0.0;
    const double edge = fmax(i->edge, beyond);
    const double past = wall_air_past(s, l, k, t, i->u, uw, flies * i->edge, beyond, dim);
    across *= 1.0 - past;
    if (s->surface && !i->in_air && across < 0.0)
        across *= 1.0 - wall_air_gap(s, i->empty, t->n, across, i->p, dim);
    double P =
        i->p +
        wall_pressure(s, i, t->is.e, (1.0 - past) * near, (1.0 - past) * held, uw, t->n, dim) -
        2.0 * i->damped;
    /* What walls do not hold: a drop under a roof falls, air comes between. */
    if (i->in_air && !wall_air_runs_along(s, square)) {
        P = fmax(P, 0.0);
        across = i->p > 0.0 ? across : fmin(across, 0.0);
    } else if (i->film) {
        /* Nor does what parts from an edge follow the wall: stretched by it, the water beside it
         * had -10 kPa for 2 (dam break against a box four particles high). */
        if (edge > 0.0 && across > 0.0)
            across *= 1.0 - edge * wall_air_parted(s, 0.5 * P - s->background, square);
        P = wall_air_tension(s, t->n, P, edge, square, dim);
    }
    struct given to = {.w = W * across, .m = -W * m};
    for (int a = 0; a < dim; a++)
        to.q[a] = -W * (m * i->u[a] + P * t->n[a]);
    if (t->friction > 0.0)
        add_bed_friction(t, i, uw, to.q, dim);
    if (t->no_slip && i->mu > 0.0) {
        wall_friction_of(s, l, k, t, uw, i->mu, i->friction, to.rub);
        for (int a = 0; a < dim; a++)
            to.q[a] += to.rub[a];
    }
    return to;
}

/* The shadow of a thin wall: i's own state on both sides of it. */
INLINE struct given rim_flux(const struct sph *s, const double *rim, const struct seen *i,
                             const int dim)
{
    const bool ale = s->prm.scheme == SCHEME_RIEMANN_ALE;
    double drift = 0.0;
    for (int a = 0; a < dim; a++)
        drift += (i->u[a] - i->u0[a]) * rim[a];
    const double m = ale ? 2.0 * i->rho * drift : 0.0;
    struct given to = {.m = -m};
    for (int a = 0; a < dim; a++)
        to.q[a] = -m * i->u[a] - 2.0 * (i->p - i->damped) * rim[a];
    return to;
}

/* Reads the packed records of the first pass: x, u, w, rho; gradients of rho and u; the transport
 * velocity u0. The damper's pressure is that of the pairs, so that walls and pairs agree. */
INLINE struct seen look(const struct sph *s, int i, const int dim)
{
    const double *q = prim_line(&s->p, i), *g = slope_line(&s->p, i), rho = q[at_rho(dim)];
    const double damper = s->prm.damper * s->rho0 * s->c0 * s->R;
    double divergence = 0.0;
    for (int a = 0; a < dim; a++)
        divergence += g[dim + (dim + 1) * a];
    divergence -= s->p.false_divergence[i];
    return (struct seen){.x = q,
                         .u = q + dim,
                         .u0 = g + dim + dim * dim,
                         .grho = g,
                         .gu = g + dim,
                         .rho = rho,
                         .p = eos_p(rho, s->rho0, s->c0, s->gamma) + s->background,
                         .c = eos_c(rho, s->rho0, s->c0, s->gamma),
                         .w = q[at_volume(dim)],
                         .damped = is_riemann(s) ? damper * divergence : 0.0,
                         .film = s->walls->near_surface && s->walls->near_surface[i],
                         .in_air = wall_air_around(s, g, dim)};
}

/* Whether the shift carries momentum and volume as a term of its own (scheme_take_along): in
 * schemes without ALE fluxes. That term is no sum over the support, so gamma does not divide it. */
static bool takes_along(const struct sph *s)
{
    return !is_riemann(s) &&
           (s->prm.transport == TRANSPORT_TVS || s->prm.transport == TRANSPORT_TVO);
}

/* Fluxes q[dim] of the touches of particle k, from first[k] on; returns their sum with the rims'.
 */
INLINE struct given all_fluxes(const struct sph *s, struct nfm *m, int k, const struct seen *i,
                               const struct given *rim, double wave, const int dim)
{
    const struct wall_list *l = &m->list;
    const int n = l->first[k + 1] - l->first[k];
    struct given all = *rim;
    ROOM_IN(m, m->q, n);
    if (i->mu > 0.0)
        ROOM_IN(m, m->rub, n);
    for (int j = 0; j < n; j++) {
        const struct wall_touch *t = l->touch + l->first[k] + j;
        struct wall_touch part;
        struct given to = {0};
        if (t->is.W > 0.0)
            to = flux(s, l, k, t->on < 0 ? t : covering(t, &part, dim), i, wave, dim);
        for (int a = 0; a < dim; a++) {
            m->q[j][a] = to.q[a];
            all.q[a] += to.q[a];
        }
        if (i->mu > 0.0)
            memcpy(m->rub[j], to.rub, sizeof to.rub);
        all.w += to.w;
        all.m += to.m;
    }
    return all;
}

/* Each owner of touches gets what its pieces have, times `share', from the volume w; the first
 * `first' besides. */
INLINE void credit_own(const struct sph *s, const struct nfm *m, int k, const double *x, double w,
                       const double *first, const int dim)
{
    const struct wall_list *l = &m->list;
    const struct wall_touch *t = l->touch + l->first[k];
    double force[3] = {0.0, 0.0, 0.0}; /* of pieces of one body, which come together */
    int body = t->body;
    for (int a = 0; a < dim; a++)
        force[a] = first[a];
    for (int j = 0; t < l->touch + l->first[k + 1]; j++, t++) {
        if (t->is.W == 0.0 || !pushes(s, m, t))
            continue;
        if (t->body != body) {
            forces_add(s, body, x, force);
            body = t->body;
            force[0] = force[1] = force[2] = 0.0;
        }
        for (int a = 0; a < dim; a++)
            force[a] -= w * m->q[j][a];
        if (t->no_slip && s->nu > 0.0)
            wall_friction_couple(s, l, k, t, m->rub[j], w);
    }
    forces_add(s, body, x, force);
}

/* By what each touch takes from gamma. */
INLINE void share_by_gamma(const struct sph *s, const struct nfm *m, int k, const double *x,
                           const double *rest, const int dim)
{
    const struct wall_list *l = &m->list;
    const struct wall_touch *begin = l->touch + l->first[k], *end = l->touch + l->first[k + 1];
    const double all = gamma_of_pushing(s, m, k);
    double force[3];
    for (const struct wall_touch *t = begin; t < end; t++) {
        if (!pushes(s, m, t))
            continue;
        const double share = all > 0.0 ? fabs(t->is.gamma) / all : t == begin ? 1.0 : 0.0;
        for (int a = 0; a < dim; a++)
            force[a] = share * rest[a];
        if (share > 0.0)
            forces_add(s, t->body, x, force);
    }
}

/* What a particle so loses more or less than its partners gain goes to the walls, so that bodies
 * and fluid exchange momentum to the last digit: each piece has its own flux over gamma, and the
 * owner of all pieces what gamma makes of the pairs' sum. Between faces of several owners each gets
 * its flux whole, gamma's part of all that is left over, and what wall_gap.c says that the faces
 * owe each other; the same between faces of which a finer or coarser level pushes some. */
INLINE void credit(const struct sph *s, struct nfm *m, int k, const struct seen *i,
                   const double *pairs, const struct given *rim, const struct given *all,
                   double gamma_1, const int dim)
{
    struct wall_list *l = &m->list;
    double rest[3], of_rim[3];
    const double counts = share_that_pushes(s, m, k);
    if (!(counts > 0.0))
        return;
    const bool gap = wall_gap_between(l, k), apart = gap || counts < 1.0;
    const double share = apart ? 1.0 : gamma_1;
    for (int a = 0; a < dim; a++) {
        rest[a] = counts * (1.0 - gamma_1) * (pairs[a] + (apart ? i->w * all->q[a] : 0.0));
        of_rim[a] = -counts * i->w * rim->q[a] * share;
    }
    if (apart)
        share_by_gamma(s, m, k, i->x, rest, dim);
    else
        forces_add(s, l->touch[l->first[k]].body, i->x, rest);
    credit_own(s, m, k, i->x, i->w * share, of_rim, dim);
    if (gap && counts > 0.5)
        wall_gap_exchange(s, l, k, (const double(*)[3])m->q, i->w);
}

/* With levels: guards that push a wall need rates of their own, for credit reads them. */
static void pushing(struct sph *s, bool *who)
{
    struct nfm *m = s->walls->state;
    const struct wall_list *l = &m->list;
    if (!m->judged)
        judge(s, m);
    for (int k = 0; k < l->n; k++)
        for (int j = l->first[k]; j < l->first[k + 1]; j++)
            who[l->who[k]] |= m->pushes[j];
}

/* Whether particle k is a guard whose rates are overwritten and that pushes no wall. */
static bool is_idle(const struct sph *s, const struct nfm *m, int k)
{
    return s->guards && !s->local_steps && particles_is_guard(&s->p, m->list.who[k]) &&
           !(share_that_pushes(s, m, k) > 0.0);
}

/* No particle comes nearer to a wall than by a quarter of its distance in a step: where water meets
 * a plate its rows converge on it, and whatever errs in u.n takes them through. Its place alone is
 * held: the fluxes, and so the wall, still have the whole of u.n, which the wall's pressure stops.
 */
static void stop_before_walls(const struct sph *s, const struct wall_list *l, int k, double *move)
{
    const double *x = prim_line(&s->p, l->who[k]);
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        double foot[3], uw[3], over = -0.25 * t->height / s->dt;
        if (!t->foot || t->height >= 0.25 * s->dx || t->height < 0.0)
            continue;
        for (int a = 0; a < s->dim; a++)
            foot[a] = x[a] + t->height * t->n[a];
        wall_list_velocity(s, t, foot, uw);
        for (int a = 0; a < s->dim; a++)
            over += (move[a] - uw[a]) * t->n[a];
        for (int a = 0; a < s->dim && over > 0.0; a++)
            move[a] -= over * t->n[a];
    }
}

/* Sums of pairs and walls over gamma. Returns the mass that this makes, kg/s. */
INLINE double add_walls(struct sph *s, struct nfm *m, int k, const int dim)
{
    const struct wall_list *l = &m->list;
    const int who = l->who[k];
    if (is_idle(s, m, k))
        return 0.0;
    struct seen i = look(s, who, dim);
    struct wall_friction friction;
    i.friction = &friction;
    i.empty = m->empty[k];
    i.mu = m->mu;
    i.streams = i.film ? 0.0 : m->streams;
    i.open = 1.0;
    i.edge = i.film ? wall_air_edge(s, l, k, dim) : 0.0;
    double gamma = fmax(l->gamma[k], least_gamma);
    if (i.in_air) {
        double all;
        const double along = wall_air_along(l, k, &all);
        i.open = wall_air_open(along, all);
        gamma = dim == 3 ? wall_air_gamma(s, along, i.c, gamma) : gamma;
    }
    const double gamma_1 = 1.0 / gamma;
    const double mass = state_row(&s->p, s->p.y, who)[at_mass(dim)];
    double *rate = state_row(&s->p, s->p.rate, who), pairs[3], own[8] = {0.0};
    if (takes_along(s))
        scheme_take_along(s, who, own);
    for (int a = 0; a < dim; a++) {
        own[dim + a] += mass * s->gravity[a];
        pairs[a] = rate[dim + a] - own[dim + a];
    }
    if (s->nu > 0.0)
        wall_friction_begin(s, l, k, gamma, &friction);
    const double wave = wave_factor(s, l, k, i.streams, i.film, i.c * gamma_1, dim);
    double closed[3];
    const struct given rim =
        l->rim ? rim_flux(s, wall_rims_close(s, l, k, closed), &i, dim) : (struct given){0};
    const struct given all = all_fluxes(s, m, k, &i, &rim, wave, dim);
    credit(s, m, k, &i, pairs, &rim, &all, gamma_1, dim);
    for (int a = 0; a < dim; a++)
        rate[dim + a] = (pairs[a] + i.w * all.q[a]) * gamma_1 + own[dim + a];
    const int V = at_volume(dim), M = at_mass(dim);
    const double exchanged = rate[M];
    rate[V] = (rate[V] - own[V] + i.w * all.w) * gamma_1 + own[V];
    rate[M] = (rate[M] + i.w * all.m) * gamma_1;
    stop_before_walls(s, l, k, rate);
    return rate[M] - exchanged;
}

/* Whether each level by itself gives back the mass that walls make. In a closed room all levels do
 * it together. Not beside waves on a current: what keeps their level (level_gap.c) leaves 1.1 % too
 * much water of 13 rows without that loss, 0.4 % with it. The coarsest level has the zones. */
static bool gives_back(const struct sph *s)
{
    const bool levels = s->guards != NULL, ale = s->prm.scheme == SCHEME_RIEMANN_ALE;
    while (s->coarser)
        s = s->coarser;
    if (s->zones)
        return ale && !(s->wave_zones && s->prm.outer == OUTER_SIDES);
    return ale && !levels;
}

/* Mass that walls have made or lost is given back with its momentum, which the walls gave or took
 * with it: what particles so lose is theirs. */
static void give_mass_back(struct sph *s, const struct nfm *m, double made)
{
    const struct wall_list *l = &m->list;
    const double share = walls_keep_mass(s, made, l->n, l->who);
    for (int k = 0; k < l->n; k++) {
        const double *y = state_row(&s->p, s->p.y, l->who[k]);
        double lost[3] = {0.0};
        for (int a = 0; a < s->dim && particles_keeps_mass(&s->p, l->who[k]); a++)
            lost[a] = share * y[s->dim + a];
        share_by_gamma(s, m, k, prim_line(&s->p, l->who[k]), lost, s->dim);
    }
}

/* How much the water of a channel with openings streams under a surface, for what is not near that:
 * 0 while it stands still or runs uniformly, and the bed takes nothing from it. A sill of six
 * spacings (0.5 m/s, 0.5 m deep) held back 20 mm of level with the whole wave and 6 with this. */
static double channel_streams(const struct sph *s)
{
    const double moves = (s->step.stray / s->c0 - 0.001) / 0.002;
    return scene_has_openings(&s->run->scene) ? fmax(0.0, fmin(fmin(moves, 1.0), scheme_kept(s)))
                                              : 0.0;
}

/* Once a stage, after the pairs: rates then hold sums over pairs and gravity. */
static void rates(struct sph *s)
{
    struct nfm *m = s->walls->state;
    forces_clear(s->walls);
    if (s->places && !m->judged)
        judge(s, m);
    m->mu = s->prm.viscosity == VISCOSITY_MORRIS ? kernel_pair_viscosity(s) : s->rho0 * s->nu;
    m->streams = is_riemann(s) ? (s->surface ? channel_streams(s) : scheme_streams(s)) : 0.0;
    double made = 0.0;
    for (int k = 0; k < m->list.n; k++) {
        const double more = s->dim == 2 ? add_walls(s, m, k, 2) : add_walls(s, m, k, 3);
        made += particles_keeps_mass(&s->p, m->list.who[k]) ? more : 0.0;
    }
    if (gives_back(s))
        give_mass_back(s, m, made);
}

static void add_moments(const struct wall_list *l, int k, double *M, double *g, int dim)
{
    const double gamma_1 = 1.0 / fmax(l->gamma[k], least_gamma);
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++)
        for (int a = 0; a < dim; a++) {
            g[a] += t->is.W * t->n[a];
            for (int b = 0; b < dim; b++)
                M[dim * a + b] += t->is.W * t->is.e[a] * t->n[b];
        }
    for (int a = 0; l->rim && a < dim; a++)
        g[a] += l->rim[k][a];
    for (int a = 0; a < dim * dim; a++)
        M[a] *= gamma_1;
    for (int a = 0; a < dim; a++)
        g[a] *= gamma_1;
}

/* Particles that the surface has not looked at (M = 0: neighbours enough) stay so. */
static void moments(struct sph *s, double *M, double *g)
{
    struct nfm *m = s->walls->state;
    struct wall_list *l = &m->list;
    const int dim = s->dim;
    wall_list_measure(s, l);
    for (int k = 0; k < l->n; k++) {
        double *Mi = M + (size_t)dim * dim * l->who[k], trace = 0.0;
        for (int a = 0; a < dim; a++)
            trace += Mi[(dim + 1) * a];
        if (trace != 0.0 || s->list->count[l->who[k]] == 0)
            add_moments(l, k, Mi, g + (size_t)dim * l->who[k], dim);
    }
}

/* Outside of a stage: the next one measures anew. */
static void gammas(struct sph *s, double *gamma)
{
    struct nfm *m = s->walls->state;
    wall_list_measure(s, &m->list);
    m->list.measured = false;
    for (int k = 0; k < m->list.n; k++)
        gamma[m->list.who[k]] = m->list.gamma[k];
}

/* By the ratio of a plane as far away as that of the piece: pieces of one plane, or of one that
 * bends little, share it. */
static void rooms(struct sph *s, double *room)
{
    struct nfm *m = s->walls->state;
    const struct wall_list *l = &m->list;
    if (!m->room) {
        m->room = NEW_IN(m, double, RATIOS + 1);
        wall_layers_rooms(s, RATIOS, m->room);
    }
    for (int k = 0; k < l->n; k++) {
        double *to = room + l->who[k], gamma = 1.0;
        for (int j = l->first[k]; j < l->first[k + 1]; j++) {
            const struct wall_touch *t = l->touch + j;
            *to += t->is.gamma * ratio_at(m->room, fabs(t->height) / s->R);
            gamma += t->is.gamma;
        }
        *to -= gamma > wall_list_behind_from(s) ? 1.0 : 0.0; /* as gamma has it */
    }
}

/* Beside rims and joints the side on which a particle lies now does not tell whether it has come
 * through: the list remembers where it was. */
static void back(struct sph *s)
{
    const struct nfm *m = s->walls->state;
    for (int k = 0; k < m->list.n && (m->list.rim || m->list.joints.n > 0); k++) {
        struct wall_foot f;
        if (wall_list_strayed(s, &m->list, k, &f) || wall_list3_crossed(s, &m->list, k, &f))
            walls_put_before(s, m->list.who[k], &f);
    }
}

static int behind(const struct sph *s, int *who)
{
    const struct nfm *m = s->walls->state;
    return wall_list_behind(s, &m->list, who);
}

const struct wall_model wall_nfm = {.name = "normal_flux_walls",
                                    .create = nfm_create,
                                    .list = list,
                                    .slopes = slopes,
                                    .bound_shifts = bound_shifts,
                                    .rates = rates,
                                    .pushing = pushing,
                                    .moments = moments,
                                    .gammas = gammas,
                                    .rooms = rooms,
                                    .back = back,
                                    .behind = behind};

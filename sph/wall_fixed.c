/* wall_fixed.c - fixed ghosts behind any polyline (Marrone et al., Comput. Methods Appl. Mech. Eng.
 * 200, 2011): layers dx/2, 3dx/2, ... behind the wall on offset curves with mitred joints; each has
 * a mirror image in the fluid where u and p are interpolated (moving least squares, [2.45-2.46]) at
 * every stage. SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "domain.h"
#include "ghost_lines.h"
#include "kernel.h"
#include "shepard2d.h"

enum { PRIM = 8, SLOPE = 8 };

/* A ghost of the wall, as it lies at t = 0. */
struct node {
    double x[2], foot[2]; /* m: itself, nearest point of the wall */
    double w;             /* m^2 */
    double gamma;         /* part of the image's support that lies in the fluid's room */
    int segment;          /* that the foot lies on */
};

struct fixed {
    struct ghost_block ghosts;
    int nnodes;
    struct node *nodes;
    int *node, capacity; /* [ghosts.n] those that this rank sees */
    double *gradient;    /* [ghosts.n][2] grad rho behind the wall */
    int *first, *near;   /* particles around the image of each, of the present step */
    int near_capacity;
    int nclose, close_capacity, *close; /* particles near any wall */
};

/* Where two segments meet: the offset of the joint over the depth of a layer. */
static void mitre(const struct walls *w, const struct segment *g, bool at_end, double *m)
{
    const double *end = at_end ? g->b : g->a;
    for (int k = 0; k < w->nsegments; k++) {
        const struct segment *o = w->segments + k;
        const double *other = at_end ? o->a : o->b;
        if (o == g || hypot(other[0] - end[0], other[1] - end[1]) > 1e-6 * g->length)
            continue;
        const double c = 1.0 + g->n[0] * o->n[0] + g->n[1] * o->n[1];
        for (int a = 0; a < 2; a++)
            m[a] = c > 0.02 ? (g->n[a] + o->n[a]) / c : g->n[a];
        return;
    }
    m[0] = g->n[0];
    m[1] = g->n[1];
}

/* Nodes of one layer behind one segment; those nearer to another wall than their depth are dropped:
 * there the copies of a thin or pointed body overlap. */
static void lay(const struct sph *s, struct fixed *m, const struct segment *g, double depth)
{
    const struct walls *w = s->walls;
    double ma[2], mb[2], A[2], B[2];
    mitre(w, g, false, ma);
    mitre(w, g, true, mb);
    for (int a = 0; a < 2; a++) {
        A[a] = g->a[a] + depth * ma[a];
        B[a] = g->b[a] + depth * mb[a];
    }
    const double length = (B[0] - A[0]) * g->t[0] + (B[1] - A[1]) * g->t[1];
    const int n = (int)lround(length / s->dx);
    for (int k = 0; k < n; k++) {
        const double f = (k + 0.5) / n;
        struct node d = {.w = length / n * s->dx};
        for (int a = 0; a < 2; a++)
            d.x[a] = A[a] + f * (B[a] - A[a]);
        d.segment = walls_nearest(w, d.x, d.foot);
        const double r = hypot(d.x[0] - d.foot[0], d.x[1] - d.foot[1]);
        if (r < 0.9 * depth || r > s->R + s->dx)
            continue;
        GROW(m->nodes, m->nnodes, m->nnodes + 1);
        m->nodes[m->nnodes++] = d;
    }
}

/* A place of the start, moved with the segment's body. */
static void carry(const struct walls *w, int segment, const double *from, double *to)
{
    const struct segment *a = w->start + segment, *b = w->segments + segment;
    const double d[2] = {from[0] - a->a[0], from[1] - a->a[1]};
    const double along = d[0] * a->t[0] + d[1] * a->t[1], out = d[0] * a->n[0] + d[1] * a->n[1];
    for (int k = 0; k < 2; k++)
        to[k] = b->a[k] + along * b->t[k] + out * b->n[k];
}

static void image(const struct walls *w, const struct node *d, double *x)
{
    const double at[2] = {2.0 * d->foot[0] - d->x[0], 2.0 * d->foot[1] - d->x[1]};
    carry(w, d->segment, at, x);
}

static void find_gammas(const struct sph *s, struct fixed *m)
{
    const struct walls *w = s->walls;
    for (int k = 0; k < m->nnodes; k++) {
        double x[2], gamma = 1.0;
        image(w, m->nodes + k, x);
        for (int l = 0; l < w->nsegments; l++) {
            const struct segment *g = w->segments + l;
            const double a[2] = {(g->a[0] - x[0]) / s->R, (g->a[1] - x[1]) / s->R};
            const double along = g->t[0] * a[0] + g->t[1] * a[1];
            gamma +=
                shepard_segment(g->n[0] * a[0] + g->n[1] * a[1], along, along + g->length / s->R);
        }
        m->nodes[k].gamma = fmax(gamma > 1.0 + 1e-9 ? gamma - 1.0 : gamma, 0.05);
    }
}

static void *fixed_create(struct sph *s)
{
    struct fixed *m = NEW(struct fixed, 1);
    for (int k = 0; k < s->walls->nsegments; k++) {
        const struct segment *g = s->walls->segments + k;
        m->ghosts.rubs = m->ghosts.rubs || g->no_slip;
        for (int layer = 0; layer < (int)ceil(s->R / s->dx); layer++)
            lay(s, m, g, (layer + 0.5) * s->dx);
    }
    find_gammas(s, m);
    return m;
}

static void fixed_destroy(void *state)
{
    struct fixed *m = state;
    mem_free(m->ghosts.rub);
    mem_free(m->nodes);
    mem_free(m->node);
    mem_free(m->gradient);
    mem_free(m->first);
    mem_free(m->near);
    mem_free(m->close);
    mem_free(m);
}

/* u, rho and their gradients at x from the particles around: MLS, Shepard where they are few or
 * lie in a line, false where there is none. */
struct sample {
    double rho, u[2], grho[2];
    double filled; /* sum w W */
};

static bool solve(double N[3][3], double Q[3][3], double x[3][3])
{
    const double c00 = N[1][1] * N[2][2] - N[1][2] * N[1][2];
    const double c01 = N[0][2] * N[1][2] - N[0][1] * N[2][2];
    const double c02 = N[0][1] * N[1][2] - N[0][2] * N[1][1];
    const double det = N[0][0] * c00 + N[0][1] * c01 + N[0][2] * c02;
    const double c11 = N[0][0] * N[2][2] - N[0][2] * N[0][2];
    const double c12 = N[0][1] * N[0][2] - N[0][0] * N[1][2];
    const double c22 = N[0][0] * N[1][1] - N[0][1] * N[0][1];
    if (!(det > 1e-5 * N[0][0] * N[0][0] * N[0][0])) /* of lengths over R */
        return false;
    for (int k = 0; k < 3; k++) {
        x[k][0] = (c00 * Q[k][0] + c01 * Q[k][1] + c02 * Q[k][2]) / det;
        x[k][1] = (c01 * Q[k][0] + c11 * Q[k][1] + c12 * Q[k][2]) / det;
        x[k][2] = (c02 * Q[k][0] + c12 * Q[k][1] + c22 * Q[k][2]) / det;
    }
    return true;
}

static bool sample_at(const struct sph *s, const double *x, const int *near, int n,
                      struct sample *to)
{
    double N[3][3] = {{0.0}}, Q[3][3] = {{0.0}}, v[3][3];
    int used = 0;
    for (int k = 0; k < n; k++) {
        const double *q = s->p.prim + (size_t)PRIM * near[k];
        const double p[3] = {1.0, (q[0] - x[0]) / s->R, (q[1] - x[1]) / s->R};
        const double W = q[4] * kernel_w(2, s->R * hypot(p[1], p[2]), s->R);
        const double value[3] = {q[5], q[2], q[3]};
        used += W > 0.0;
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                N[a][b] += W * p[a] * p[b];
                Q[a][b] += W * value[a] * p[b];
            }
    }
    *to = (struct sample){.rho = s->rho0, .filled = N[0][0]};
    if (used == 0)
        return false;
    if (used < 6 || !solve(N, Q, v)) {
        to->rho = Q[0][0] / N[0][0];
        for (int a = 0; a < 2; a++)
            to->u[a] = Q[1 + a][0] / N[0][0];
        return true;
    }
    to->rho = v[0][0];
    for (int a = 0; a < 2; a++) {
        to->u[a] = v[1 + a][0];
        to->grho[a] = v[0][1 + a] / s->R;
    }
    return true;
}

static double reflected(const double *v, const double *n, int a)
{
    return v[a] - 2.0 * (v[0] * n[0] + v[1] * n[1]) * n[a];
}

/* The share of a ghost that has fluid before it: beside a free surface half the support of its
 * image is empty, above it more, and what lies there must not push or pull. */
static double presence(const struct node *d, const struct sample *v)
{
    return fmin(1.0, fmax(0.0, 2.0 * v->filled / d->gamma - 0.5));
}

/* One ghost from the sample at its image: slip form for the pairs [3.2], K as [3.9]. Its velocity
 * has no gradient: with the one of the least squares, reflected, rows along walls were unstable. */
static void set_ghost(struct sph *s, struct fixed *m, int k, const struct node *d,
                      const struct sample *v, bool any)
{
    const struct walls *w = s->walls;
    const struct segment *g = w->segments + d->segment;
    double x[2], foot[2], uw[2], du[2], u[2], n[2];
    carry(w, d->segment, d->x, x);
    carry(w, d->segment, d->foot, foot);
    walls_velocity(w, g, foot, uw, du);
    const double r = hypot(x[0] - foot[0], x[1] - foot[1]);
    double across = 0.0, K = 0.0, *rub = m->ghosts.rub + (size_t)2 * k;
    double *slope = m->gradient + (size_t)2 * k;
    for (int a = 0; a < 2; a++) {
        n[a] = (x[a] - foot[a]) / r;
        across += ((any ? uw[a] - v->u[a] : 0.0)) * n[a];
        K += (s->gravity[a] - du[a]) * n[a];
    }
    for (int a = 0; a < 2; a++) {
        u[a] = any ? v->u[a] + 2.0 * across * n[a] : uw[a];
        rub[a] = any && g->no_slip ? 2.0 * (uw[a] - v->u[a] - across * n[a]) : 0.0;
        slope[a] = any ? reflected(v->grho, n, a) : 0.0;
    }
    const double rho = any ? ghost_density(s, v->rho, K, 2.0 * r) : s->rho0;
    for (int a = 0; a < 2; a++) {
        slope[a] += any ? 2.0 * rho * K / (s->c0 * s->c0) * n[a] : 0.0;
    }
    ghost_set_line(s, s->p.prim + (size_t)PRIM * (s->p.n + m->ghosts.first + k), x, u,
                   d->w * presence(d, v), rho);
}

static void lines(struct sph *s)
{
    struct fixed *m = s->walls->state;
    for (int k = 0; k < m->ghosts.n; k++) {
        const struct node *d = m->nodes + m->node[k];
        double x[2];
        struct sample v;
        image(s->walls, d, x);
        const bool any = sample_at(s, x, m->near + m->first[k], m->first[k + 1] - m->first[k], &v);
        set_ghost(s, m, k, d, &v, any);
    }
}

/* Particles (halo included) that an image can see. */
static void find_close(struct sph *s, struct fixed *m)
{
    const double reach = 2.5 * (s->R + s->skin) + s->dx;
    m->nclose = 0;
    for (int i = 0; i < s->p.n + s->p.nghost; i++) {
        if (fabs(walls_distance(s->walls, s->p.prim + (size_t)PRIM * i, reach)) >= reach)
            continue;
        if (m->nclose == m->close_capacity) {
            const int more = 2 * m->close_capacity + 256;
            GROW(m->close, m->close_capacity, more);
            m->close_capacity = more;
        }
        m->close[m->nclose++] = i;
    }
}

static int list_near(struct sph *s, struct fixed *m, const double *x, int have)
{
    const double reach = s->R + s->skin + s->walls->speed * s->dt_most;
    for (int k = 0; k < m->nclose; k++) {
        const double *q = s->p.prim + (size_t)PRIM * m->close[k];
        const double d[2] = {q[0] - x[0], q[1] - x[1]};
        if (d[0] * d[0] + d[1] * d[1] >= reach * reach)
            continue;
        if (have == m->near_capacity) {
            const int more = 2 * m->near_capacity + 1024;
            GROW(m->near, m->near_capacity, more);
            m->near_capacity = more;
        }
        m->near[have++] = m->close[k];
    }
    return have;
}

static void room(struct fixed *m, int n)
{
    if (n + 1 <= m->capacity)
        return;
    GROW(m->node, m->capacity, n + 1);
    GROW(m->first, m->capacity, n + 1);
    GROW(m->gradient, 2 * m->capacity, 2 * (n + 1));
    m->capacity = n + 1;
}

static void ghosts(struct sph *s)
{
    struct fixed *m = s->walls->state;
    double lo[3], hi[3], x[2];
    const double reach = s->R + s->skin;
    int have = 0;
    m->ghosts.n = 0;
    m->ghosts.first = s->p.nghost;
    domain_bounds(s->domain, lo, hi);
    find_close(s, m);
    if (s->walls->speed > 0.0)
        find_gammas(s, m);
    room(m, m->nnodes);
    for (int k = 0; k < m->nnodes; k++) {
        carry(s->walls, m->nodes[k].segment, m->nodes[k].x, x);
        bool seen = s->p.n > 0;
        for (int a = 0; a < 2 && s->run->size > 1; a++)
            seen = seen && x[a] > lo[a] - 2.0 * reach && x[a] < hi[a] + 2.0 * reach;
        if (!seen)
            continue;
        m->node[m->ghosts.n] = k;
        m->first[m->ghosts.n] = have;
        image(s->walls, m->nodes + k, x);
        have = list_near(s, m, x, have);
        ghost_append(s, &m->ghosts, 1);
    }
    m->first[m->ghosts.n] = have;
    lines(s);
}

static void ghost_slopes(struct sph *s)
{
    const struct fixed *m = s->walls->state;
    for (int k = 0; k < m->ghosts.n; k++) {
        const size_t i = (size_t)(s->p.n + m->ghosts.first + k);
        double *to = s->p.slope + SLOPE * i;
        memset(to, 0, SLOPE * sizeof *to);
        memcpy(to, m->gradient + (size_t)2 * k, 2 * sizeof *to);
        memcpy(to + 6, s->p.prim + PRIM * i + 2, 2 * sizeof *to); /* u0 = u */
    }
}

static void rates(struct sph *s)
{
    const struct fixed *m = s->walls->state;
    ghost_friction(s, &m->ghosts);
    if (s->prm.scheme == SCHEME_RIEMANN_ALE && !s->zones)
        walls_keep_mass(s, 0, NULL);
}

static int behind(const struct sph *s, int *who)
{
    const struct fixed *m = s->walls->state;
    int n = 0;
    for (int k = 0; k < m->nclose; k++)
        if (m->close[k] < s->p.n &&
            walls_distance(s->walls, s->p.y + (size_t)m->close[k] * s->p.nstate, s->R) < 0.0)
            who[n++] = m->close[k];
    return n;
}

const struct wall_model wall_fixed = {.name = "fixed_ghosts",
                                      .create = fixed_create,
                                      .destroy = fixed_destroy,
                                      .ghosts = ghosts,
                                      .lines = lines,
                                      .ghost_slopes = ghost_slopes,
                                      .rates = rates,
                                      .behind = behind};

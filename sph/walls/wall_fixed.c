/* wall_fixed.c - fixed ghosts behind any polyline, for comparison (Marrone et al., Comput. Methods
 * Appl. Mech. Eng. 200, 2011): layers dx/2, 3dx/2, ... behind the wall that move with it; each
 * ghost has a mirror image in the fluid, where u and rho are interpolated at every stage (moving
 * least squares [2.45-2.46]) and from there taken behind the wall [3.1-3.9]. In 2D, on one rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include "../pairs/sph_pairs.h"
#include "fixed_layers.h"
#include "ghost_lines.h"
#include "wall_moments.h"

struct fixed {
    struct ghost_block ghosts;
    struct fixed_layers layers;
    double *room; /* [layers.n] part of the image's support that walls leave to the fluid */
    double (*gradient)[2]; /* [layers.n] kg/m^4: of rho, behind the wall */
    int nclose, *close;    /* lines near any wall, by x */
    int *first, *near;     /* lines around the image of each, of the present step */
};

/* The mirror image of a ghost at its foot, carried along with its segment. */
static void image(const struct walls *w, const struct fixed_node *d, double *x)
{
    const double at[2] = {2.0 * d->foot[0] - d->x[0], 2.0 * d->foot[1] - d->x[1]};
    fixed_carry(w, d->segment, at, x);
}

/* Shepard factors [4.50] at the images. */
static void find_rooms(const struct sph *s, struct fixed *m)
{
    const struct walls *w = s->walls;
    for (int k = 0; k < m->layers.n; k++) {
        double x[2], gamma = 1.0;
        image(w, m->layers.of + k, x);
        for (int l = 0; l < w->nsegments; l++) {
            const struct segment *g = w->segments + l;
            const double a[2] = {(g->a[0] - x[0]) / s->R, (g->a[1] - x[1]) / s->R};
            const double from = g->t[0] * a[0] + g->t[1] * a[1];
            const double height = g->n[0] * a[0] + g->n[1] * a[1];
            gamma += wall_moments(height, from, from + g->length / s->R).gamma;
        }
        m->room[k] = fmax(gamma > 1.0 + 1e-6 ? gamma - 1.0 : gamma, 0.05);
    }
}

/* Layers are laid once, from the walls as they are at t = 0; fixed_carry takes them to where these
 * are. */
static void *fixed_create(struct sph *s)
{
    struct fixed *m = NEW(struct fixed, 1);
    fixed_layers_lay(s, &m->layers);
    mem_own(m, m->layers.of);
    for (int k = 0; k < s->walls->nsegments; k++)
        m->ghosts.has_friction = m->ghosts.has_friction || s->walls->segments[k].no_slip;
    m->room = NEW_IN(m, double, m->layers.n + 1);
    m->first = NEW_IN(m, int, m->layers.n + 1);
    m->gradient = mem_new_in(m, (size_t)m->layers.n + 1, sizeof *m->gradient);
    return m;
}

/* The fluid at an image. */
struct fixed_sample {
    double rho, u[2], grho[2];
    double filled; /* sum w W */
};

/* v = N^-1 Q by row; false: too few places, or nearly in a line. N of lengths over R. */
static bool fixed_solve(double N[3][3], double Q[3][3], double v[3][3])
{
    double c[3][3];
    const double det = vec3_cofactors(N, c);
    if (!(det > 1e-5 * N[0][0] * N[0][0] * N[0][0]))
        return false;
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            v[k][a] = vec3_dot(c[a], Q[k]) / det;
    return true;
}

/* Moving least squares, linear; Shepard's mean where they fail; false: there is nobody. */
static bool sample_at(const struct sph *s, const double *x, const int *near, int n,
                      struct fixed_sample *to)
{
    double N[3][3] = {{0.0}}, Q[3][3] = {{0.0}}, v[3][3];
    int used = 0;
    for (int k = 0; k < n; k++) {
        const double *q = prim_line(&s->p, near[k]);
        const double p[3] = {1.0, (q[0] - x[0]) / s->R, (q[1] - x[1]) / s->R};
        const double r = hypot(p[1], p[2]);
        if (r >= 1.0)
            continue;
        const double W = q[at_volume(2)] * kernel_w(2, s->R * r, s->R);
        const double value[3] = {q[at_rho(2)], q[2], q[3]};
        used++;
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                N[a][b] += W * p[a] * p[b];
                Q[a][b] += W * value[a] * p[b];
            }
    }
    *to = (struct fixed_sample){.rho = s->rho0, .filled = N[0][0]};
    if (!(N[0][0] > 0.0))
        return false;
    const bool linear = used >= 6 && fixed_solve(N, Q, v);
    to->rho = linear ? v[0][0] : Q[0][0] / N[0][0];
    for (int a = 0; a < 2; a++) {
        to->u[a] = linear ? v[1 + a][0] : Q[1 + a][0] / N[0][0];
        to->grho[a] = linear ? v[0][1 + a] / s->R : 0.0;
    }
    return true;
}

/* The share of a ghost that has fluid before it: beside a free surface half the support of its
 * image is empty, above it more, and what lies there must not push or pull. */
static double presence(double room, const struct fixed_sample *v)
{
    return fmin(1.0, fmax(0.0, 2.0 * v->filled / room - 0.5));
}

/* From its image: slip form for the pairs [3.2], no-slip form for friction [3.3-3.4], K of [3.9].
 * Its velocity has no gradient: with the one of the least squares, mirrored, rows along walls are
 * unstable. */
static void set_ghost(struct sph *s, struct fixed *m, int k, const struct fixed_sample *v, bool any)
{
    const struct walls *w = s->walls;
    const struct fixed_node *d = m->layers.of + k;
    const struct segment *g = w->segments + d->segment;
    double x[2], foot[2], uw[2], du[2], u[2], n[2], across = 0.0, steep = 0.0, K = 0.0;
    fixed_carry(w, d->segment, d->x, x);
    fixed_carry(w, d->segment, d->foot, foot);
    walls_velocity(w, g, foot, uw, du);
    const double r = hypot(x[0] - foot[0], x[1] - foot[1]);
    for (int a = 0; a < 2; a++) {
        n[a] = (x[a] - foot[a]) / r;
        across += any ? (uw[a] - v->u[a]) * n[a] : 0.0;
        steep += v->grho[a] * n[a];
        K += (s->gravity[a] - du[a]) * n[a];
    }
    const double rho = any ? ghost_density(s, v->rho, K, 2.0 * r) : s->rho0;
    const bool parted = any && ghost_parted(s, v->rho, K, r, -across);
    for (int a = 0; a < 2; a++) {
        u[a] = any ? v->u[a] + 2.0 * across * n[a] : uw[a];
        m->ghosts.rub[2 * k + a] =
            any && g->no_slip ? 2.0 * (uw[a] - v->u[a] - across * n[a]) : 0.0;
        m->gradient[k][a] =
            any ? v->grho[a] - 2.0 * (steep - rho * K / (s->c0 * s->c0)) * n[a] : 0.0;
    }
    ghost_set_line(s, prim_line(&s->p, s->p.n + m->ghosts.first + k), x, u,
                   parted ? 0.0 : d->w * presence(m->room[k], v), rho);
}

static void lines(struct sph *s)
{
    struct fixed *m = s->walls->state;
    for (int k = 0; k < m->ghosts.n; k++) {
        double x[2];
        struct fixed_sample v;
        image(s->walls, m->layers.of + k, x);
        const bool any = sample_at(s, x, m->near + m->first[k], m->first[k + 1] - m->first[k], &v);
        set_ghost(s, m, k, &v, any);
    }
}

/* Lines (of periods included) that an image may see, images being up to R before the wall. */
static void find_close(struct sph *s, struct fixed *m)
{
    const double reach = 2.5 * (s->R + s->lists.skin) + s->dx;
    m->nclose = 0;
    for (int i = 0; i < s->p.n + s->p.nghost; i++) {
        if (fabs(walls_distance(s->walls, prim_line(&s->p, i), reach)) >= reach)
            continue;
        ROOM_IN(m, m->close, m->nclose + 1);
        m->close[m->nclose++] = i;
    }
}

/* The list serves all stages of a step, so its reach has the skin and the way of bodies. */
static int list_near(struct sph *s, struct fixed *m, const double *x, int have)
{
    const double reach = s->R + s->lists.skin + s->walls->speed * s->step.dt_most;
    for (int k = 0; k < m->nclose; k++) {
        const double *q = prim_line(&s->p, m->close[k]), d[2] = {q[0] - x[0], q[1] - x[1]};
        if (fabs(d[0]) >= reach || d[0] * d[0] + d[1] * d[1] >= reach * reach)
            continue;
        ROOM_IN(m, m->near, have + 1);
        m->near[have++] = m->close[k];
    }
    return have;
}

static void ghosts(struct sph *s)
{
    struct fixed *m = s->walls->state;
    int have = 0;
    m->ghosts.n = 0;
    m->ghosts.first = s->p.nghost;
    find_close(s, m);
    find_rooms(s, m);
    for (int k = 0; k < m->layers.n; k++) {
        double x[2];
        m->first[k] = have;
        image(s->walls, m->layers.of + k, x);
        have = list_near(s, m, x, have);
    }
    m->first[m->layers.n] = have;
    if (m->layers.n > 0)
        ghost_append(s, &m->ghosts, m->layers.n);
    lines(s);
}

static void ghost_slopes(struct sph *s)
{
    const struct fixed *m = s->walls->state;
    for (int k = 0; k < m->ghosts.n; k++) {
        const int i = s->p.n + m->ghosts.first + k;
        double *to = slope_line(&s->p, i);
        memset(to, 0, (size_t)s->p.nslope * sizeof *to);
        memcpy(to, m->gradient[k], sizeof m->gradient[k]);
        memcpy(to + 6, prim_line(&s->p, i) + 2, 2 * sizeof *to); /* u0 = u */
    }
}

static void rates(struct sph *s)
{
    const struct fixed *m = s->walls->state;
    ghost_friction(s, &m->ghosts);
    if (s->prm.scheme == SCHEME_RIEMANN_ALE)
        walls_keep_mass_of_all(s);
}

/* By the state, not by the records, which are those of the last stage. */
static int behind(const struct sph *s, int *who)
{
    const struct fixed *m = s->walls->state;
    int n = 0;
    for (int k = 0; k < m->nclose; k++)
        if (m->close[k] < s->p.n &&
            walls_distance(s->walls, state_row(&s->p, s->p.y, m->close[k]), s->R) < 0.0)
            who[n++] = m->close[k];
    return n;
}

const struct wall_model wall_fixed = {.name = "fixed_ghosts",
                                      .create = fixed_create,
                                      .ghosts = ghosts,
                                      .lines = lines,
                                      .ghost_slopes = ghost_slopes,
                                      .rates = rates,
                                      .behind = behind};

/* wall_ghost.c - mirrored ghosts behind plane sides of the domain, in 2D and 3D [3.1-3.10]: every
 * line within reach of a side, ghosts of other ranks and of sides before included, so that corners
 * fill themselves. Pair fluxes stay antisymmetric: no mass passes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "walls.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "ghost_lines.h"

enum { PRIM = 8 };

struct mirror {
    struct ghost_block ghosts;
    int *source; /* [n] line that is mirrored */
    unsigned char *plane;
    int capacity;
};

static void *mirror_create(struct sph *s)
{
    struct mirror *m = NEW(struct mirror, 1);
    for (int k = 0; k < s->walls->nplanes; k++)
        m->ghosts.rubs = m->ghosts.rubs || s->walls->planes[k].no_slip;
    return m;
}

static void mirror_destroy(void *state)
{
    struct mirror *m = state;
    mem_free(m->ghosts.rub);
    mem_free(m->source);
    mem_free(m->plane);
    mem_free(m);
}

static void add(struct sph *s, struct mirror *m, int source, int plane)
{
    if (m->ghosts.n == m->capacity) {
        const int more = 2 * m->capacity + 256;
        GROW(m->source, m->capacity, more);
        GROW(m->plane, m->capacity, more);
        m->capacity = more;
    }
    m->source[m->ghosts.n] = source;
    m->plane[m->ghosts.n] = (unsigned char)plane;
    ghost_append(s, &m->ghosts, 1);
}

static void lines(struct sph *s)
{
    const struct walls *w = s->walls;
    struct mirror *m = w->state;
    const int dim = s->dim, first = s->p.n + m->ghosts.first;
    for (int k = 0; k < m->ghosts.n; k++) {
        const struct wall_plane *p = w->planes + m->plane[k];
        const double *from = s->p.prim + (size_t)PRIM * m->source[k];
        const double d = 2.0 * p->sign * (p->at - from[p->axis]);
        double x[3], u[3], *rub = m->ghosts.rub + (size_t)dim * k;
        for (int a = 0; a < dim; a++) {
            x[a] = from[a];
            u[a] = from[dim + a];
            rub[a] = p->no_slip && a != p->axis ? 2.0 * (p->u[a] - u[a]) : 0.0;
        }
        x[p->axis] = 2.0 * p->at - x[p->axis];
        u[p->axis] = -u[p->axis];
        const double rho = ghost_density(s, from[2 * dim + 1], p->sign * s->gravity[p->axis], d);
        ghost_set_line(s, s->p.prim + (size_t)PRIM * (first + k), x, u, from[2 * dim], rho);
    }
}

static void ghosts(struct sph *s)
{
    struct mirror *m = s->walls->state;
    const double reach = s->R + s->skin;
    m->ghosts.n = 0;
    m->ghosts.first = s->p.nghost;
    for (int k = 0; k < s->walls->nplanes; k++) {
        const struct wall_plane *p = s->walls->planes + k;
        const int have = s->p.n + s->p.nghost;
        const int before = m->ghosts.n;
        for (int i = 0; i < have; i++) {
            const double d = p->sign * (p->at - s->p.prim[(size_t)PRIM * i + p->axis]);
            if (d >= 0.0 && d < reach)
                add(s, m, i, k);
        }
        if (m->ghosts.n > before) /* the next sides mirror these, too */
            lines(s);
    }
}

/* The mirrored field's gradients, with that of the weight; u0 as u. */
static void ghost_slopes(struct sph *s)
{
    const struct walls *w = s->walls;
    const struct mirror *m = w->state;
    const int dim = s->dim, first = s->p.n + m->ghosts.first, width = s->p.nslope;
    for (int k = 0; k < m->ghosts.n; k++) {
        const struct wall_plane *p = w->planes + m->plane[k];
        double *to = s->p.slope + (size_t)width * (first + k);
        const double K = p->sign * s->gravity[p->axis];
        memcpy(to, s->p.slope + (size_t)width * m->source[k], (size_t)width * sizeof *to);
        to[p->axis] = -to[p->axis];
        if (K != 0.0)
            to[p->axis] += 2.0 * p->sign * K / (s->c0 * s->c0) *
                           s->p.prim[(size_t)PRIM * (first + k) + 2 * dim + 1];
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++)
                if ((a == p->axis) != (b == p->axis))
                    to[dim + dim * a + b] = -to[dim + dim * a + b];
        to[dim + dim * dim + p->axis] = -to[dim + dim * dim + p->axis];
    }
}

static void rates(struct sph *s)
{
    const struct mirror *m = s->walls->state;
    ghost_friction(s, &m->ghosts);
    if (s->prm.scheme == SCHEME_RIEMANN_ALE && !s->zones)
        walls_keep_mass(s, 0, NULL);
}

const struct wall_model wall_ghost = {.name = "mirrored_ghosts",
                                      .create = mirror_create,
                                      .destroy = mirror_destroy,
                                      .ghosts = ghosts,
                                      .lines = lines,
                                      .ghost_slopes = ghost_slopes,
                                      .rates = rates};

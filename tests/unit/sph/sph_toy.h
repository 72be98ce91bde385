/* sph_toy.h - particles without a domain, for tests of the pair passes: a jittered lattice in an
 * open box, smooth fields with noise. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../../sph/pairs/neighbours.h"
#include "../../../sph/pairs/scheme.h"
#include "../../../sph/sph.h"

struct toy {
    struct run run;
    struct sph s;
    uint64_t seed;
};

static inline const double *prim_of(const struct sph *s, int i) { return s->p.prim + PRIM * i; }
static inline double *slope_of(const struct sph *s, int i) { return s->p.slope + s->p.nslope * i; }
static inline const double *rate_of(const struct sph *s, int i)
{
    return s->p.rate + s->p.nstate * i;
}

static inline double dot(const double *a, const double *b, int dim)
{
    return a[0] * b[0] + a[1] * b[1] + (dim == 3 ? a[2] * b[2] : 0.0);
}

/* In [-1, 1). */
static inline double toy_random(struct toy *t)
{
    t->seed = t->seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(t->seed >> 11) * 0x1p-52 - 1.0;
}

/* cells^dim particles in the unit box; the parameters are the defaults and may be changed before
 * toy_prepare. */
static inline void toy_create(struct toy *t, int dim, int cells, double R_dx, double jitter)
{
    memset(t, 0, sizeof *t);
    t->seed = 7;
    struct sph *s = &t->s;
    s->run = &t->run;
    s->prm = (struct sph_params){.R_dx = R_dx, .low_dissipation = true, .damper = 0.2};
    s->dim = dim;
    s->dx = s->prm.dx = 1.0 / cells;
    s->R = R_dx * s->dx;
    s->dxD = pow(s->dx, dim);
    s->rho0 = 1000.0;
    s->nu = 1e-3;
    s->c0 = s->prm.c0 = 10.0;
    s->step.shift_speed = 1.0;
    s->gamma = s->prm.gamma = 7.0;
    s->lists.skin = 0.05 * s->R;
    s->list = neighbours_create();
    particles_create(s->list, &s->p, dim, 0);
    for (int k = 0; k < (dim == 3 ? cells : 1); k++)
        for (int j = 0; j < cells; j++)
            for (int i = 0; i < cells; i++) {
                double x[3] = {(i + 0.5) * s->dx, (j + 0.5) * s->dx, (k + 0.5) * s->dx}, u[3];
                for (int a = 0; a < dim; a++)
                    x[a] += jitter * s->dx * toy_random(t);
                for (int a = 0; a < dim; a++)
                    u[a] = sin(5.0 * x[(a + 1) % dim]) + 0.1 * toy_random(t);
                particles_set(s, particles_add(&s->p, s->p.n, ZONE_FREE), x, u,
                              s->dxD * (1.0 + 0.1 * jitter * toy_random(t)),
                              s->rho0 * (1.0 + 0.005 * cos(4.0 * x[0]) + 0.005 * toy_random(t)));
            }
}

static inline void toy_small(struct toy *t, int dim)
{
    toy_create(t, dim, dim == 2 ? 13 : 6, dim == 2 ? 3.4 : 2.3, 0.25);
}

/* Sorted, lines filled, list built; the passes that the parameters name. */
static inline void toy_prepare(struct toy *t)
{
    neighbours_sort(&t->s);
    particles_lines(&t->s);
    neighbours_build(&t->s);
    t->s.passes = scheme_pick(&t->s);
    t->s.scheme = &t->s.passes;
}

/* Copies the line (and slope) of particle `from' of another toy to ghost `to'. */
static inline void toy_copy_line(struct toy *t, int to, const struct toy *other, int from)
{
    const size_t nslope = (size_t)t->s.p.nslope;
    memcpy(t->s.p.prim + (size_t)8 * to, other->s.p.prim + (size_t)8 * from, 8 * sizeof(double));
    memcpy(t->s.p.slope + nslope * to, other->s.p.slope + nslope * from, nslope * sizeof(double));
}

/* As toy_prepare; particles at x >= cut become ghosts, with the lines of their twins in `all', the
 * same toy as a whole. */
static inline void toy_split(struct toy *t, const struct toy *all, double cut)
{
    struct particles *p = &t->s.p;
    const int before = p->n;
    int n = 0;
    for (int i = 0; i < before; i++)
        if (p->y[(size_t)i * p->nstate] < cut)
            particles_copy(p, n++, i);
    p->n = n;
    neighbours_sort(&t->s);
    particles_lines(&t->s);
    particles_reserve(p, before);
    for (int i = 0; i < all->s.p.n; i++)
        if (all->s.p.y[(size_t)i * p->nstate] >= cut)
            toy_copy_line(t, n + p->nghost++, all, i);
    neighbours_build(&t->s);
    t->s.passes = scheme_pick(&t->s);
    t->s.scheme = &t->s.passes;
}

static inline void toy_free(struct toy *t) { DROP(t->s.list); }

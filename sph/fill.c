/* fill.c - the first particles: a lattice at cell centres, each rank its own part, where the shapes
 * of the case have fluid and no wall is nearer than 0.3 dx; at rest under gravity with its
 * pressure. SPDX-License-Identifier: BSD-3-Clause */
#include "sph.h"

#include <math.h>
#include <string.h>

#include "../common/exact.h"
#include "domain.h"
#include "eos.h"
#include "walls.h"

/* In [-1, 1), a function of the particle alone, so the same on any number of ranks
 * (splitmix64: Steele, Lea & Flood, OOPSLA 2014). */
static double random_of(int64_t id, int axis)
{
    uint64_t z = ((uint64_t)id * 3 + (uint64_t)axis + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return (double)(z >> 11) * 0x1p-52 - 1.0;
}

static bool in_polygon(const struct param_points *p, const double *x)
{
    bool in = false;
    for (int k = 0, l = p->n - 1; k < p->n; l = k++) {
        const double *a = p->x[k], *b = p->x[l];
        if ((a[1] > x[1]) != (b[1] > x[1]) &&
            x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]))
            in = !in;
    }
    return in;
}

/* Height against gravity (m); without gravity y, in 3D z. */
static double height(const struct sph *s, const double *x)
{
    const double *g = s->gravity, size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    if (size == 0.0)
        return x[s->dim - 1];
    return -(g[0] * x[0] + g[1] * x[1] + g[2] * x[2]) / size;
}

static bool in_shape(const struct sph *s, const struct scene_shape *h, const double *x)
{
    bool in = true;
    double r2 = 0.0;
    for (int a = 0; a < s->dim; a++) {
        const bool given =
            a < 2 || h->box[1][a] > h->box[0][a]; /* a plane box in 3D goes through */
        in = in && (!given || (x[a] > h->box[0][a] && x[a] < h->box[1][a]));
        r2 += (x[a] - h->centre[a]) * (x[a] - h->centre[a]);
    }
    switch (h->form) {
    case SHAPE_BOX:
        return in;
    case SHAPE_POLYGON:
        return in_polygon(&h->points, x);
    case SHAPE_DISC:
        return r2 < h->radius * h->radius;
    default:
        return height(s, x) < h->level;
    }
}

/* Without shapes the field knows its own. */
bool fill_is_fluid(const struct sph *s, const struct exact *e, const double *x, double *velocity)
{
    const struct scene *c = &s->run->scene;
    const struct scene_initial *f = &c->initial;
    const double least = s->prm.packing > 0 ? 1e-3 * s->dx : 0.3 * s->dx;
    bool fluid = c->nshapes == 0;
    velocity[0] = velocity[1] = velocity[2] = 0.0;
    if (fluid && scene_has_wave(c))
        fluid = x[1] < exact_surface(e, x[0]);
    if (fluid && f->field == FIELD_PATCH)
        fluid = fmax(fabs(x[0]), fabs(x[1])) < 0.5 * f->L;
    if (fluid && f->field == FIELD_DROP)
        fluid = x[0] * x[0] + x[1] * x[1] < f->L * f->L;
    for (int k = 0; k < c->nshapes; k++)
        if (in_shape(s, c->shapes + k, x)) {
            fluid = !c->shapes[k].hole;
            for (int a = 0; a < 3; a++)
                velocity[a] = c->shapes[k].velocity[a];
        }
    return fluid && (!s->walls || walls_distance(s->walls, x, INFINITY) > least);
}

static void add(struct sph *s, const struct exact *e, int64_t id, const double *centre)
{
    double x[3] = {0.0, 0.0, 0.0}, u[3], p, more[3];
    for (int a = 0; a < s->dim; a++)
        x[a] = centre[a] + (s->prm.noise > 0.0 ? s->prm.noise * s->dx * random_of(id, a) : 0.0);
    if (!fill_is_fluid(s, e, x, more))
        return;
    exact_point(e, x, 0.0, u, &p, NULL);
    for (int a = 0; a < s->dim; a++)
        u[a] += more[a];
    particles_reserve(&s->p, s->p.n + 1);
    const int i = particles_add(&s->p, id, ZONE_FREE);
    particles_set(s, i, x, u, s->dxD, eos_rho(p, s->rho0, s->c0, s->gamma));
}

/* Density of a fluid at rest at depth d: the exact column of the equation of state. */
static double density_at_rest(const struct sph *s, double g, double d)
{
    const double r = g * d / (s->c0 * s->c0);
    if (s->gamma == 1.0)
        return s->rho0 * exp(r);
    return s->rho0 * pow(fmax(1.0 + 6.0 * r, 0.1), 1.0 / 6.0);
}

/* Masses under gravity: p = 0 at the given height, or on top of the fluid. A wave has its own
 * pressure. */
static void weigh(struct sph *s)
{
    const struct scene *c = &s->run->scene;
    const struct scene_initial *f = &c->initial;
    const double *G = s->gravity, g = sqrt(G[0] * G[0] + G[1] * G[1] + G[2] * G[2]);
    double level = -INFINITY;
    if (g == 0.0 || scene_has_wave(c) || f->field == FIELD_POISEUILLE)
        return;
    for (int i = 0; i < s->p.n; i++) {
        double x[3] = {0.0, 0.0, 0.0};
        memcpy(x, s->p.y + (size_t)i * s->p.nstate, (size_t)s->dim * sizeof *x);
        level = fmax(level, height(s, x) + 0.5 * s->dx);
    }
    MPI_Allreduce(MPI_IN_PLACE, &level, 1, MPI_DOUBLE, MPI_MAX, s->run->comm);
    level = f->level < LEVEL_TOP ? f->level : level;
    for (int i = 0; i < s->p.n; i++) {
        double *y = s->p.y + (size_t)i * s->p.nstate, x[3] = {0.0, 0.0, 0.0};
        memcpy(x, y, (size_t)s->dim * sizeof *x);
        const double m = y[2 * s->dim + 1];
        const double more = y[2 * s->dim] * density_at_rest(s, g, level - height(s, x)) / m;
        for (int a = 0; a < s->dim; a++)
            y[s->dim + a] *= more;
        y[2 * s->dim + 1] *= more;
    }
}

void fill_lattice(struct sph *s)
{
    const struct exact e = exact_create(&s->run->scene);
    double lo[3], hi[3];
    int first[3] = {0, 0, 0}, last[3] = {1, 1, 1};
    int64_t cells[3] = {1, 1, 1};
    domain_bounds(s->domain, lo, hi);
    for (int a = 0; a < s->dim; a++) { /* the first cuts lie on lattice faces */
        cells[a] = llround((s->hi[a] - s->lo[a]) / s->dx);
        first[a] = (int)lround((lo[a] - s->lo[a]) / s->dx);
        last[a] = (int)lround((hi[a] - s->lo[a]) / s->dx);
    }
    for (int k = first[2]; k < last[2]; k++)
        for (int j = first[1]; j < last[1]; j++)
            for (int i = first[0]; i < last[0]; i++) {
                const double x[3] = {s->lo[0] + (i + 0.5) * s->dx, s->lo[1] + (j + 0.5) * s->dx,
                                     s->lo[2] + (k + 0.5) * s->dx};
                add(s, &e, i + cells[0] * (j + cells[1] * (int64_t)k), x);
            }
    pack_start(s, s->prm.packing);
    weigh(s);
    const int64_t all = cells[0] * cells[1] * cells[2], ranks = s->run->size;
    s->next_id = (all + ranks - 1) / ranks * ranks + s->run->rank;
}

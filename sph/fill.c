/* fill.c - the first particles: a lattice at cell centres, each rank its own part.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph.h"

#include <math.h>

#include "../common/exact.h"
#include "domain.h"
#include "eos.h"

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

static void add(struct sph *s, const struct exact *e, int64_t id, const double *centre)
{
    double x[3] = {0.0, 0.0, 0.0}, u[3], p;
    for (int a = 0; a < s->dim; a++)
        x[a] = centre[a] + (s->prm.noise > 0.0 ? s->prm.noise * s->dx * random_of(id, a) : 0.0);
    exact_point(e, x, 0.0, u, &p, NULL);
    const int i = particles_add(&s->p, id, ZONE_FREE);
    particles_set(s, i, x, u, s->dxD, eos_rho(p, s->rho0, s->c0, s->gamma));
}

void fill_lattice(struct sph *s)
{
    const struct exact e = exact_create(&s->run->scene);
    double lo[3], hi[3];
    int first[3] = {0, 0, 0}, last[3] = {1, 1, 1};
    int64_t cells[3] = {1, 1, 1}, mine = 1;
    domain_bounds(s->domain, lo, hi);
    for (int a = 0; a < s->dim; a++) { /* the first cuts lie on lattice faces */
        cells[a] = llround((s->hi[a] - s->lo[a]) / s->dx);
        first[a] = (int)lround((lo[a] - s->lo[a]) / s->dx);
        last[a] = (int)lround((hi[a] - s->lo[a]) / s->dx);
        mine *= last[a] - first[a];
    }
    particles_reserve(&s->p, (int)mine);
    for (int k = first[2]; k < last[2]; k++)
        for (int j = first[1]; j < last[1]; j++)
            for (int i = first[0]; i < last[0]; i++) {
                const double x[3] = {s->lo[0] + (i + 0.5) * s->dx, s->lo[1] + (j + 0.5) * s->dx,
                                     s->lo[2] + (k + 0.5) * s->dx};
                add(s, &e, i + cells[0] * (j + cells[1] * (int64_t)k), x);
            }
    const int64_t all = cells[0] * cells[1] * cells[2], ranks = s->run->size;
    s->next_id = (all + ranks - 1) / ranks * ranks + s->run->rank;
}

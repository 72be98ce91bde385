/* surface_mode.c - the amplitude of a standing wave, sampled as the run goes: the momentum of the
 * water in the inviscid mode, sum of u . grad(cosh kz cos ax cos bz) over the water in cells, from
 * which the period and damping are fitted at the end (common/base/fit.h). Air and far cells are
 * left out (layer > 2), cells beside the surface count by their share of water.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "mesh_view.h"

/* cos and sin of k x over the local cells along an axis, x from 0. */
static void waves_along(const struct block *b, int a, double k, double *c, double *v)
{
    double x[3];
    for (int i = 0; i < b->n[a]; i++) {
        block_centre(b, a == 0 ? i : 0, 0, a == 2 ? i : 0, x);
        c[i] = cos(k * x[a]);
        v[i] = sin(k * x[a]);
    }
}

/* Momentum of a row in the inviscid mode, grad of cosh kz cos ax cos bz: q has sinh, cosh of the
 * row's height and cos, sin along z. */
static double row_in_mode(const struct fv *s, int64_t at, const double *c, const double *v,
                          const double q[4])
{
    const double *d = s->exact.along;
    double sum = 0.0;
    for (int i = 0; i < s->b.n[0]; i++, at++) {
        if (s->surface->layer[at] > 2)
            continue;
        double m = q[2] * (s->u[1][at] * q[0] * c[i] - d[0] * s->u[0][at] * q[1] * v[i]);
        if (s->exact.crossed)
            m -= d[1] * s->u[2][at] * q[1] * c[i] * q[3];
        sum += surface_share(s, at) * m;
    }
    return sum;
}

/* The same over blocks, cell by cell. */
static double mode_on_blocks(const struct fv *s)
{
    const struct exact *e = &s->exact;
    double *const *x = s->surface->mesh->x, sum = 0.0;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double kx = e->wave.k * e->along[0],
                         kz = e->crossed ? e->wave.k * e->along[1] : 0.0,
                         y = e->wave.k * (x[1][i] - e->bottom), count = s->surface->mesh->count[i];
            double m = 0.0;
            if (s->surface->layer[i] > 2 || count == 0.0)
                continue;
            m = cos(kz * x[2][i]) * (s->u[1][i] * sinh(y) * cos(kx * x[0][i]) -
                                     e->along[0] * s->u[0][i] * cosh(y) * sin(kx * x[0][i]));
            if (e->crossed)
                m -= e->along[1] * s->u[2][i] * cosh(y) * cos(kx * x[0][i]) * sin(kz * x[2][i]);
            sum += count * surface_share(s, i) * m;
        }
    return sum;
}

static double mode_on_even_cells(const struct fv *s)
{
    const struct block *b = &s->b;
    const struct exact *e = &s->exact;
    double sum = 0.0, x[3];
    double *c = NEW(double, 2 * (b->n[0] + b->n[2])), *v = c + b->n[0], *cz = v + b->n[0],
           *vz = cz + b->n[2];
    waves_along(b, 0, e->wave.k * e->along[0], c, v);
    waves_along(b, 2, e->crossed ? e->wave.k * e->along[1] : 0.0, cz, vz);
    for (int k = 0; k < b->n[2]; k++)
        for (int j = 0; j < b->n[1]; j++) {
            block_centre(b, 0, j, k, x);
            const double z = e->wave.k * (x[1] - e->bottom);
            sum += block_size(b, 1, j) / b->h[1] *
                   row_in_mode(s, block_at(b, 0, j, k), c, v,
                               (const double[]){sinh(z), cosh(z), cz[k], vz[k]});
        }
    mem_free(c);
    return sum;
}

/* Momentum in the inviscid mode of the wave. */
void surface_sample(struct fv *s)
{
    if (s->exact.field != FIELD_STANDING_WAVE)
        return;
    const double sum = s->m ? mode_on_blocks(s) : mode_on_even_cells(s);
    fit_add(s->surface, &s->surface->oscillation, s->t, ranks_sum(s->comm, sum));
}

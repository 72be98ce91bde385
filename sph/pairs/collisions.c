/* collisions.c - see collisions.h. SPDX-License-Identifier: BSD-3-Clause */
#include "collisions.h"

#include <math.h>

#include "neighbours.h"

static const double touching = 0.5, tight = 0.2; /* dx */

double collisions_distance(const struct sph *s)
{
    return s->prm.transport == TRANSPORT_EULERIAN ? 0.0 : touching * s->dx;
}

/* Gives particle i the share of its mass in the pair: momentum p and displacement along e. */
static void push(struct sph *s, int i, const double *e, double momentum, double way)
{
    double *y = state_row(&s->p, s->p.y, i);
    for (int a = 0; a < s->dim; a++) {
        y[s->dim + a] += momentum * e[a];
        y[a] += way * e[a];
    }
}

static double mass_of(const struct sph *s, int i)
{
    const double *q = prim_line(&s->p, i);
    return q[at_rho(s->dim)] * q[at_volume(s->dim)];
}

static void collide(struct sph *s, int i, int j)
{
    const int dim = s->dim;
    const double *a = prim_line(&s->p, i), *b = prim_line(&s->p, j);
    double e[3], r2 = 0.0, nearing = 0.0;
    for (int k = 0; k < dim; k++) {
        e[k] = b[k] - a[k];
        r2 += e[k] * e[k];
        nearing -= (b[dim + k] - a[dim + k]) * e[k];
    }
    const double r = sqrt(r2);
    if (r >= touching * s->dx || r == 0.0)
        return;
    for (int k = 0; k < dim; k++)
        e[k] /= r;
    const double mi = mass_of(s, i), mj = mass_of(s, j), m = mi * mj / (mi + mj);
    const double p = nearing > 0.0 ? 0.5 * m * nearing / r : 0.0;
    const double way = r < tight * s->dx ? 0.1 * (tight * s->dx - r) : 0.0;
    push(s, i, e, -p, -way * m / mi);
    if (j < s->p.n)
        push(s, j, e, p, way * m / mj);
}

void collisions_apply(struct sph *s)
{
    const struct neighbours *l = s->list;
    for (int k = 0; k < l->nclose; k++)
        if (l->close[k][1] < s->p.n + s->p.nhalo)
            collide(s, l->close[k][0], l->close[k][1]);
}

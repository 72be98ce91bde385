/* collisions.c - exchange of momentum between two particles that nearly coincide. Acts once a step,
 * after its stages (time/integrate.c, time/local_steps.c), on the pairs that the list noted as
 * close (neighbours.c: those that may come within dx/2 during the step). With e the unit vector
 * from i to j, U = (u_i - u_j).e > 0 the speed of approach and m = m_i m_j/(m_i + m_j) the reduced
 * mass,
 *   q_i -= m U/2 e,   q_j += m U/2 e       if r < dx/2,
 *   x_i -= 0.1 (dx/5 - r) m/m_i e, x_j likewise with m/m_j, to the other side, if r < dx/5.
 * Both conserve momentum, the second the centre of mass too; m U^2 (1/2)(1 - 1/4) of kinetic energy
 * is lost.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "collisions.h"

#include "neighbours.h"

/* Below `touching' particles collide, below `tight' they are moved apart as well, by a tenth of
 * what is missing in each step. */
static const double touching = 0.5, tight = 0.2; /* dx */

double collisions_distance(const struct sph *s)
{
    return s->prm.transport == TRANSPORT_EULERIAN ? 0.0 : touching * s->dx;
}

/* Changes the momentum of particle i by `momentum' e, kg m/s, and its position by `way' e, m, in
 * the state of the step's end, which the packed records do not see until they are packed again. */
static void push(struct sph *s, int i, const double *e, double momentum, double way)
{
    double *y = state_row(&s->p, s->p.y, i);
    for (int a = 0; a < s->dim; a++) {
        y[s->dim + a] += momentum * e[a];
        y[a] += way * e[a];
    }
}

/* The mass of particle i from its packed record, kg, for ghosts as for locals. */
static double mass_of(const struct sph *s, int i)
{
    const double *q = prim_line(&s->p, i);
    return q[at_rho(s->dim)] * q[at_volume(s->dim)];
}

/* Treats the pair of a local i with j, a local or a ghost. A ghost is left alone: the rank that
 * owns it has the same pair from its side, with the same records, and changes its own half. */
static void collide(struct sph *s, int i, int j)
{
    const int dim = s->dim;
    const double *a = prim_line(&s->p, i), *b = prim_line(&s->p, j);
    double e[3], r2 = 0.0, nearing = 0.0;
    for (int k = 0; k < dim; k++) {
        e[k] = b[k] - a[k];
        r2 += e[k] * e[k];
        /* -(u_j - u_i).(x_j - x_i) = r U, positive when they approach */
        nearing -= (b[dim + k] - a[dim + k]) * e[k];
    }
    const double r = sqrt(r2);
    if (r >= touching * s->dx || r == 0.0)
        return;
    for (int k = 0; k < dim; k++)
        e[k] /= r;
    const double mi = mass_of(s, i), mj = mass_of(s, j), m = mi * mj / (mi + mj);
    /* half of m U, which would stop the approach; an elastic collision would take 2 m U */
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

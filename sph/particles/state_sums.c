/* state_sums.c - conserved sums of the flow and its energies. Energy is kinetic + potential
 * (gravity, and the central force -W^2 x) + elastic, the work m int p/rho^2 d rho that Tait's law
 * stores from rho0 on. Sums run over all levels and ranks; where two levels meet each particle
 * counts by its share, guards too, so that no sum jumps as a row passes from one level to the next.
 * Called for the series, for drifts since the start and for watches.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "state_sums.h"

#include "../sph.h"

/* Elastic energy per mass: integral of p/rho^2 from rho0, with r = rho/rho0. With gamma = 7 it is
 * c0^2/7 ((r^6 - 1)/6 + 1/r - 1), with gamma = 1 c0^2 (ln r + 1/r - 1); both are 0 and flat at r =
 * 1. */
static double elastic(const struct sph *s, double r)
{
    const double c2 = s->c0 * s->c0, r2 = r * r;
    if (s->gamma == 1.0)
        return c2 * (log(r) + 1.0 / r - 1.0);
    return c2 / 7.0 * ((r2 * r2 * r2 - 1.0) / 6.0 + 1.0 / r - 1.0);
}

/* Energy of a state record y, J (per m in 2D). Gravity along a periodic direction drives the flow
 * and has no potential. */
double sph_energy(const struct sph *s, const double *y, double *kinetic)
{
    const int dim = s->dim;
    const double w = y[at_volume(dim)], m = y[at_mass(dim)], W2 = s->central * s->central;
    double potential = 0.0;
    *kinetic = 0.0;
    for (int a = 0; a < dim; a++) {
        *kinetic += 0.5 * y[dim + a] * y[dim + a] / m;
        potential += m * y[a] * (0.5 * W2 * y[a] - (s->periodic[a] ? 0.0 : s->gravity[a]));
    }
    return *kinetic + potential + m * elastic(s, m / w / s->rho0);
}

/* Adds the sums of one level on this rank to sums[]. */
static void add_sums(const struct sph *s, double sums[SUM_COUNT])
{
    const int dim = s->dim;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i), share = particles_share(s, y);
        double kinetic;
        sums[SUM_VOLUME] += particles_is_guard(&s->p, i) ? 0.0 : y[at_volume(dim)];
        if (share == 0.0)
            continue;
        sums[SUM_ENERGY] += share * sph_energy(s, y, &kinetic);
        for (int a = 0; a < dim; a++)
            sums[SUM_MOMENTUM + a] += share * y[dim + a];
        sums[SUM_MASS] += share * y[at_mass(dim)];
        sums[SUM_KINETIC] += share * kinetic;
    }
}

/* Collective. */
void sph_sums(const struct sph *s, double sums[SUM_COUNT])
{
    for (int k = 0; k < SUM_COUNT; k++)
        sums[k] = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        add_sums(q, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, SUM_COUNT, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

/* dv/dx - du/dy; 3D: all components. From the slopes: grad u [a][b] = du_a/dx_b. */
void sph_vorticity(const struct sph *s, int i, double w[3])
{
    const int dim = s->dim;
    const double *g = slope_line(&s->p, i) + dim;
    w[0] = dim == 3 ? g[3 * 2 + 1] - g[3 * 1 + 2] : 0.0;
    w[1] = dim == 3 ? g[3 * 0 + 2] - g[3 * 2 + 0] : 0.0;
    w[2] = g[dim * 1 + 0] - g[dim * 0 + 1];
}

/* ghost_lines.c - see ghost_lines.h. The hydrostatic equation (1/rho) dp/dn = K with Tait's law
 * integrates to
 *   (rho'/rho0)^6 = (rho/rho0)^6 + 6 K d/c0^2   (gamma 7),   rho' = rho exp(K d/c0^2)   (gamma 1).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "ghost_lines.h"

#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"
#include "walls.h"

/* d, m, from the original to its image, along the normal; K, m/s^2, gravity less the wall's
 * acceleration along it. The power is kept from 0: where K d/c0^2 is below -1/6 Tait's law has no
 * density. */
double ghost_density(const struct sph *s, double rho, double K, double d)
{
    const double c2_1 = 1.0 / (s->c0 * s->c0), r = rho / s->rho0;
    if (K == 0.0)
        return rho;
    if (s->gamma == 1.0)
        return rho * exp(K * d * c2_1);
    const double r2 = r * r, sixth = r2 * r2 * r2 + 6.0 * c2_1 * K * d;
    return s->rho0 * pow(sixth > 0.1 ? sixth : 0.1, 1.0 / 6.0);
}

/* An image that pulled no more than it presses still let rows fall with 0.3 to 0.7 g, for it goes
 * up as they go down, which stretches them. */
bool ghost_parted(const struct sph *s, double rho, double K, double d, double u)
{
    const double g = vec3_length(s->gravity);
    if (!s->surface || !(-2.0 * K > g) || u > 0.0)
        return false;
    return eos_p(ghost_density(s, rho, K, d), s->rho0, s->c0, s->gamma) <
           -0.25 * s->rho0 * g * s->dx;
}

void ghost_set_line(const struct sph *s, double *line, const double *x, const double *u, double w,
                    double rho)
{
    const int dim = s->dim;
    for (int a = 0; a < dim; a++) {
        line[a] = x[a];
        line[dim + a] = u[a];
    }
    line[at_volume(dim)] = w;
    line[at_rho(dim)] = rho;
    if (dim == 2)
        line[PRIM_FALSE] = 0.0;
}

/* Ghosts of a model follow each other without a gap behind those of the halo, so a block is its
 * first number and its size. */
int ghost_append(struct sph *s, struct ghost_block *g, int n)
{
    const int first = s->p.n + s->p.nghost;
    if (g->n == 0)
        g->first = s->p.nghost;
    particles_reserve(&s->p, first + n);
    ROOM_IN(s->walls->state, g->rub, (g->n + n) * s->dim);
    s->p.nghost += n;
    g->n += n;
    return first;
}

/* The part of one row; entries of a row ascend, ghosts of walls are near its end. */
static void rub_row(struct sph *s, const struct ghost_block *g, int i, double mu)
{
    const struct neighbours *l = s->list;
    const int dim = s->dim, first = s->p.n + g->first;
    const double *x = prim_line(&s->p, i);
    const double factor = -2.0 * mu * kernel_dw_r(dim, 0.0, s->R) * x[at_volume(dim)];
    const int *j = l->j + l->start[i];
    double *rate = state_row(&s->p, s->p.rate, i) + dim;
    for (int k = l->count[i] - 1; k >= 0 && j[k] >= s->p.n; k--) {
        if (j[k] < first || j[k] >= first + g->n)
            continue;
        const double *xj = prim_line(&s->p, j[k]);
        const double *rub = g->rub + (size_t)dim * (j[k] - first);
        const double r2 = vec_distance2(dim, x, xj);
        const double t = fmax(1.0 - sqrt(r2) / s->R, 0.0),
                     f = factor * xj[at_volume(dim)] * t * t * t;
        for (int a = 0; a < dim; a++)
            rate[a] += f * rub[a];
    }
}

void ghost_friction(struct sph *s, const struct ghost_block *g)
{
    if (!g->has_friction || s->nu == 0.0)
        return;
    const double mu = kernel_pair_viscosity(s);
    for (int i = 0; i < s->p.n; i++)
        rub_row(s, g, i, mu);
}

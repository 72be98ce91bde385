/* transport.c - bounds of the transport velocity where there are walls or a free surface; without
 * them the first pass bounds it itself. Where densities do not know of the shift (all but ALE) it
 * is |u|/4 at most with a surface: a tank at rest sank by a tenth in 4000 steps with U/4. Else, and
 * in ALE, where a tank blew up after 1e4 steps with |u|/4, it is a quarter of U, but of the largest
 * |u| or of what viscosity calms (nu/R) where these are less and there is no surface: with U/4 the
 * crowding left over in corners stirs water at rest for ever, for there u = shift is a steady state
 * (closed tanks: 1.5e-3 c0 -> 1e-4 c0; without mass flux they diverged). Not for delta and
 * standard, which need the shift to keep their order: 4e-4 c0 with U/4, 5e-3 without.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../pairs/sph_pairs.h"
#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"
#include "surface.h"

/* What is left of delta where it fades towards the surface [5.14], for comparison. v of [5.15] is
 * 1/2 on the surface; within 2 dx of it 1 less the Shepard sum, beside walls over the part of the
 * support that is not behind them. */
static void fade(const struct sph *s, int i, double room, double *delta)
{
    const bool on = s->surface->is[i] == SURFACE_ON;
    const double beta = surface_beta(on ? 0.5 : 1.0 - kernel_sum(s, i) / fmax(room, 1e-3));
    for (int a = 0; a < s->dim; a++)
        delta[a] *= beta;
}

/* Takes out the part of delta across the surface: nothing may move it but the flow. delta is 0 on
 * the surface itself, and keeps its tangential part near it. */
static void along_surface(const struct free_surface *f, int i, double *delta, int dim)
{
    const double *N = f->normal + (size_t)dim * i;
    double across = 0.0;
    for (int a = 0; a < dim; a++)
        across += delta[a] * N[a];
    for (int a = 0; a < dim; a++)
        delta[a] = f->is[i] == SURFACE_ON ? 0.0 : delta[a] - across * N[a];
}

double transport_speed2(const struct sph *s, const double *u)
{
    double u2 = 0.0;
    for (int a = 0; a < s->dim; a++) {
        const double v = u[a] - s->step.carried * s->step.drift[a];
        u2 += v * v;
    }
    return u2;
}

/* Speed of a particle that the surface does not see, 0 of others; beside walls of those alone that
 * are nearly at rest, below 1e-3 c0: a small tank with nearly all of them beside walls else loses
 * its pressure faster, 15 instead of 10 % at mid-depth after 2000 steps. */
static double inner_speed(const struct sph *s, int i)
{
    const bool beside = s->walls && s->walls->beside && s->walls->beside[i];
    const double u2 = transport_speed2(s, prim_line(&s->p, i) + s->dim);
    const double share = beside ? fmax(0.0, 1.0 - u2 / pow(0.001 * s->c0, 2.0)) : 1.0;
    return s->surface->is[i] == SURFACE_INNER ? share * sqrt(u2) : 0.0;
}

/* Power of the shift of particle i against gravity, over rho: w g.(u - u0). */
static double lift(const struct sph *s, int i)
{
    const int dim = s->dim;
    const double *q = prim_line(&s->p, i), *u0 = slope_line(&s->p, i) + dim + dim * dim;
    double power = 0.0;
    for (int a = 0; a < dim; a++)
        power += s->gravity[a] * (q[dim + a] - u0[a]);
    return power * q[at_volume(dim)];
}

/* What shifts do against gravity, sums over all ranks of one kind, guards or what flows. */
struct shift_work {
    double up, down; /* of those that lift and of those that sink, over rho, W m^3/kg */
    double inside;   /* of w g^2 |u|: what could give it back */
};

/* Of one particle: its inner speed, m/s, and what its shift lifts, as in shift_work. */
struct shift {
    double speed, power;
};

/* of: [n] of the locals, gets what each has. Collective. */
static void sum_work(const struct sph *s, double g2, struct shift_work work[2], struct shift *of)
{
    memset(work, 0, 2 * sizeof *work);
    for (int i = 0; i < s->p.n; i++) {
        struct shift_work *to = work + particles_is_guard(&s->p, i);
        of[i] = (struct shift){inner_speed(s, i), lift(s, i)};
        to->up += fmax(of[i].power, 0.0);
        to->down += fmin(of[i].power, 0.0);
        to->inside += prim_line(&s->p, i)[at_volume(s->dim)] * g2 * of[i].speed;
    }
    MPI_Allreduce(MPI_IN_PLACE, work, (int)(sizeof *work / sizeof(double)) * (s->guards ? 2 : 1),
                  MPI_DOUBLE, MPI_SUM, s->run->comm);
}

/* Where densities do not know of the shift it lets the level sink, the faster the more moves. What
 * it takes from the potential energy of all is given back by a shift against gravity of those
 * inside, in proportion to their speeds as the shift's own bound is; guards by themselves. It knows
 * nothing of walls, and pressed the first row of a dam break through the floor: those whose support
 * meets a wall take no part unless they are at rest. After u0 -= share |u| g the power is 0.
 * No share moves a particle by more than a quarter of |u|, and in splashes nobody is inside: jets
 * then rose by their shifts (a dam break of 20 rows gained 2.4 % of its energy while its jet
 * climbed the far wall). What is left of a gain is taken off the shifts that lift, in one
 * proportion; what is left of a loss is a loss. Collective. */
static void make_workless(struct sph *s)
{
    const int dim = s->dim;
    const double *g = s->gravity;
    struct shift_work work[2];
    double share[2] = {0.0}, lifts[2], g2 = 0.0;
    for (int a = 0; a < dim; a++)
        g2 += g[a] * g[a];
    if (g2 == 0.0)
        return;
    struct shift *of = NEW(struct shift, s->p.n);
    sum_work(s, g2, work, of);
    for (int k = 0; k < 2; k++) {
        const double power = work[k].up + work[k].down, most = 0.25 * work[k].inside / sqrt(g2);
        const double given = fmax(-most, fmin(power, most));
        if (work[k].inside > 0.0)
            share[k] = given / work[k].inside;
        lifts[k] = power > given && power > 0.0 ? 1.0 - (power - given) / work[k].up : 1.0;
    }
    for (int i = 0; i < s->p.n; i++) {
        const bool guard = particles_is_guard(&s->p, i);
        const double *u = prim_line(&s->p, i) + dim, back = share[guard] * of[i].speed;
        double *u0 = slope_line(&s->p, i) + dim + dim * dim;
        const double factor = of[i].power > 0.0 ? lifts[guard] : 1.0;
        for (int a = 0; a < dim; a++)
            u0[a] = u[a] + factor * (u0[a] - u[a]) + back * g[a];
    }
    mem_free(of);
}

/* Share of the bound |u|/4 that counts with levels. Their numbers agree on average only where one
 * takes over from the other, and what shifts across carries weight that no density knows: the side
 * that gains it pushes back where pressure is high, at the floor, so that water at rest turns about
 * the edge, the faster the more the shift, bounded by |u| alone, lets pass. Largest |u| of 1e5
 * steps of 20 x 10 particles 9e-3 c0; with what is below 9e-4 at the start, as without levels, and
 * 1.1 to 1.6e-3 late; of 40 x 20 6e-4. Not within R of the switch alone: what others shift then
 * crowds there until particles clump and the run ends. The scale is the speed that the scene lets
 * expect, not c0: with a c0 that is large for other reasons the shift would be off everywhere. 1
 * without levels. */
static double share_with_levels(const struct sph *s, double u2)
{
    static const double swift = 0.3; /* of the speed that the scene lets expect */
    return s->coarser || s->finer ? fmin(1.0, u2 / pow(swift * s->prm.expected, 2.0)) : 1.0;
}

/* Acts on u0 of every local particle in each stage after the walls' terms. delta = u0 - u is first
 * made tangential (or faded) near the surface, then cut to a quarter of |u| or U, see the head of
 * this file; at last the work of all shifts is taken out. */
void transport_finish(struct sph *s)
{
    const int dim = s->dim;
    const bool oger = s->prm.transport == TRANSPORT_TVO;
    const bool by_own =
        !s->packing && (oger || (s->surface && s->prm.scheme != SCHEME_RIEMANN_ALE));
    const double now = fmax(s->step.max_speed, s->nu / s->R);
    const bool bounded =
        !s->packing && s->walls && !s->surface && sph_params_is_riemann(s->prm.scheme);
    if (!oger && s->prm.transport != TRANSPORT_TVS)
        return;
    double *room = s->surface && s->surface->fades ? walls_rooms(s) : NULL;
    for (int i = 0; i < s->p.n; i++) {
        const double *u = prim_line(&s->p, i) + dim;
        double *u0 = slope_line(&s->p, i) + dim + dim * dim;
        double delta[3], size2 = 0.0;
        for (int a = 0; a < dim; a++)
            delta[a] = u0[a] - u[a];
        if (room && s->surface->is[i] != SURFACE_INNER)
            fade(s, i, room[i], delta);
        else if (s->surface && s->surface->is[i] != SURFACE_INNER)
            along_surface(s->surface, i, delta, dim);
        for (int a = 0; a < dim; a++)
            size2 += delta[a] * delta[a];
        const double whole = scheme_shift_speed(s, i), U = bounded ? fmin(whole, now) : whole;
        const double u2 = by_own ? transport_speed2(s, u) : U * U, most2 = 0.0625 * u2;
        const double bounded_share = size2 > most2 ? sqrt(most2 / size2) : 1.0;
        const double factor = bounded_share * (by_own ? share_with_levels(s, u2) : 1.0);
        for (int a = 0; a < dim; a++)
            u0[a] = u[a] + factor * delta[a];
    }
    mem_free(room);
    if (s->surface && !s->packing && s->prm.scheme != SCHEME_RIEMANN_ALE)
        make_workless(s);
}

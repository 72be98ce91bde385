/* scheme_rates.c - second pass of Riemann SPH: every pair is a 1D Riemann problem along its line of
 * centres, between states that the gradients of the first pass carry to its middle [2.78-2.83]
 * (Chiron 2017). With the star state u_E, p_E, rho_E of the pair, grad W at x_i of W(x_i - x_j),
 * volume w, mass m = rho w, momentum q = m u, and u0_ij the mean of u0_i and u0_j:
 *
 * ALE with mass fluxes (Vila) [2.86-2.89],
 *   dx_i/dt = u0_i
 *   dw_i/dt = w_i sum_j w_j (u0_j - u0_i).grad W
 *   dm_i/dt = -w_i sum_j w_j 2 rho_E (u_E - u0_ij).grad W
 *   dq_i/dt = m_i g - w_i sum_j w_j 2 (rho_E u_E (u_E - u0_ij).grad W + p_E grad W)
 * and without mass fluxes (Leduc) [2.96-2.99],
 *   dw_i/dt = w_i sum_j w_j 2 (u_E - u_i).grad W,   dm_i/dt = 0
 *   dq_i/dt = m_i g - w_i sum_j w_j 2 p_E grad W.
 * Viscous terms are Morris's [2.31] or Monaghan & Gingold's [2.32]. The linear problem [2.100] with
 * Z = rho c has
 *   u_E = (Z_i u_i + Z_j u_j + p_i - p_j)/(Z_i + Z_j)
 *   p_E = (Z_j p_i + Z_i p_j + b Z_i Z_j (u_i - u_j))/(Z_i + Z_j),
 * velocities along x_j - x_i, b <= 1 a bound of the dissipation (Zhang, Hu & Adams, J. Comput.
 * Phys. 335, 2017).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include "../particles/sph_particles.h"
#include "riemann_rows.h"

enum { EXACT = false };
EACH(DEFINE)

/* The instance of the pass for this dimension, scheme and viscosity. Without viscosity the index is
 * VISCOSITY_OFF, whatever the parameter says. */
scheme_pass *scheme_rates(const struct sph *s)
{
    static scheme_pass *const passes[2][2][3] = {EACH(ENTRY)};
    const int viscosity = s->nu > 0.0 ? s->prm.viscosity : VISCOSITY_OFF;
    if (s->prm.riemann == RIEMANN_EXACT)
        return scheme_exact_rates(s->dim, s->prm.scheme, viscosity);
    return passes[s->dim - 2][s->prm.scheme][viscosity];
}

/* With a background pressure of at least the largest tension no pair has a negative p_i + p_j,
 * hence no tensile instability. Tait's law is monotonic, so the least density gives the least
 * pressure. */
double scheme_background(const struct sph *s)
{
    if (!s->prm.background)
        return 0.0;
    double least = INFINITY;
    for (int i = 0; i < s->p.n; i++)
        least = fmin(least, prim_line(&s->p, i)[at_rho(s->dim)]);
    return fmax(0.0, -eos_p(ranks_min(s->run->comm, least), s->rho0, s->c0, s->gamma));
}

/* Central schemes need the first pass only for what reads its slopes: shifting, walls, surface
 * detection, or the diffusion of density, which is content with grad rho. */
struct scheme scheme_pick(const struct sph *s)
{
    static const char *const names[] = {"riemann_ale", "riemann", "delta", "standard"};
    const int scheme = s->prm.scheme, transport = s->prm.transport;
    const bool riemann = sph_params_is_riemann(scheme);
    const bool diffusion = scheme == SCHEME_DELTA && s->prm.delta > 0.0;
    struct scheme passes = {.name = names[scheme], .slopes = riemann || diffusion};
    if (riemann || transport != TRANSPORT_NONE || s->walls || s->surface)
        passes.gradients = scheme_gradients(s->dim, transport);
    else if (diffusion)
        passes.gradients = scheme_density_gradients(s->dim);
    passes.rates = riemann ? scheme_rates(s) : scheme_delta_rates(s);
    return passes;
}

/* scheme_rates.c - second pass of Riemann SPH: every pair is a 1D Riemann problem along its line of
 * centres, between states that the gradients of the first pass carry to its middle. Two schemes:
 * ALE with mass fluxes (Vila) [2.86-2.89], and without mass fluxes (Leduc) [2.96-2.99].
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scheme.h"

#include <math.h>

#include "../particles/eos.h"
#include "riemann_rows.h"

enum { EXACT = false };
EACH(DEFINE)

scheme_pass *scheme_rates(const struct sph *s)
{
    static scheme_pass *const passes[2][2][3] = {EACH(ENTRY)};
    const int viscosity = s->nu > 0.0 ? s->prm.viscosity : VISCOSITY_OFF;
    if (s->prm.riemann == RIEMANN_EXACT)
        return scheme_exact_rates(s->dim, s->prm.scheme, viscosity);
    return passes[s->dim - 2][s->prm.scheme][viscosity];
}

double scheme_background(const struct sph *s)
{
    if (!s->prm.background)
        return 0.0;
    double least = INFINITY;
    for (int i = 0; i < s->p.n; i++)
        least = fmin(least, prim_line(&s->p, i)[at_rho(s->dim)]);
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, s->run->comm);
    return fmax(0.0, -eos_p(least, s->rho0, s->c0, s->gamma));
}

struct scheme scheme_pick(const struct sph *s)
{
    static const char *const names[] = {"riemann_ale", "riemann", "delta", "standard"};
    const int scheme = s->prm.scheme, transport = s->prm.transport;
    const bool riemann = scheme == SCHEME_RIEMANN_ALE || scheme == SCHEME_RIEMANN;
    const bool diffusion = scheme == SCHEME_DELTA && s->prm.delta > 0.0;
    struct scheme passes = {.name = names[scheme], .slopes = riemann || diffusion};
    if (riemann || transport != TRANSPORT_NONE || s->walls || s->surface)
        passes.gradients = scheme_gradients(s->dim, transport);
    else if (diffusion)
        passes.gradients = scheme_density_gradients(s->dim);
    passes.rates = riemann ? scheme_rates(s) : scheme_delta_rates(s);
    return passes;
}

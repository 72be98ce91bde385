/* standard_check.c - see standard_check.h. Sums over gamma are no longer each other's adjoint
 * [4.20-4.21]: beside walls the pair G+, D- makes or takes energy, and scheme standard has only
 * viscosity to take it. SPDX-License-Identifier: BSD-3-Clause */
#include "standard_check.h"

/* What keeps a scene from being a viscous channel between sides; NULL: it is one. */
static const char *no_channel(const struct scene *c, const struct sph_params *used)
{
    int axis = -1;
    bool has_friction = false;
    if (c->domain.dim != 2)
        return "3D was not measured";
    if (c->nbodies > 0)
        return "bodies have corners";
    if (used->surface == SURFACE_YES)
        return "there is a free surface";
    for (int k = 0; k < c->nwalls; k++) {
        const int of = (c->walls[k].side - SIDE_X_MIN) / 2;
        if (c->walls[k].side == SIDE_NONE || (axis >= 0 && of != axis))
            return "walls meet in corners";
        axis = of;
        has_friction = has_friction || c->walls[k].kind == WALL_NO_SLIP;
    }
    if (!has_friction || !(c->fluid.nu > 0.0))
        return "nothing viscous damps it at the walls";
    return axis >= 0 && c->fluid.gravity[axis] != 0.0 ? "the fluid weighs on its walls" : NULL;
}

void standard_check(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const char *why = no_channel(&r->scene, used);
    if (used->scheme == SCHEME_STANDARD && used->walls == WALLS_NFM && why)
        params_fault(r->params, f, "sph.scheme",
                     "standard has no dissipation of density and diverges at normal flux walls but "
                     "in viscous channels between two sides (here %s): take riemann, riemann_ale "
                     "or delta, or walls of ghosts (sph.walls: ghosts for sides, fixed in 2D)",
                     why);
}

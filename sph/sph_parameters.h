/* sph_parameters.h - what group sph of a case says, as plain data that sph/case writes once at the
 * start. Equations: Chiron 2017, cited as [2.x].
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PARAMETERS_H
#define SPH_PARAMETERS_H

#include <stdbool.h>

#include "../common/scene/scene.h"

/* Riemann-ALE: Vila [2.86-2.89]. Riemann, no mass flux: Leduc [2.96-2.99]. Delta-SPH: Antuono
 * [2.60-2.63]. Standard: [2.47-2.50] with the artificial viscosity [2.58-2.59]. */
enum sph_scheme { SCHEME_RIEMANN_ALE, SCHEME_RIEMANN, SCHEME_DELTA, SCHEME_STANDARD, SCHEME_AUTO };
enum sph_riemann { RIEMANN_LINEAR, RIEMANN_EXACT };
enum sph_limiter { LIMITER_KOREN, LIMITER_MINMOD, LIMITER_NONE };
enum sph_transport {
    TRANSPORT_TVS,
    TRANSPORT_TVO,
    TRANSPORT_NONE,
    TRANSPORT_EULERIAN,
    TRANSPORT_XSPH
};
enum sph_surface_shift { SURFACE_SHIFT_ALONG, SURFACE_SHIFT_BETA };
enum sph_viscosity {
    VISCOSITY_MORRIS,
    VISCOSITY_MONAGHAN,
    VISCOSITY_AUTO
}; /* auto: in cases only */
enum sph_outer { OUTER_NONE, OUTER_EXACT, OUTER_PARTNER, OUTER_SIDES };
enum sph_walls { WALLS_NFM, WALLS_GHOSTS, WALLS_FIXED, WALLS_AUTO };
enum sph_integrals {
    INTEGRALS_CLOSED,
    INTEGRALS_CLIPPED,   /* 3D */
    INTEGRALS_CENTROIDS, /* gamma closed */
    INTEGRALS_NUMERICAL  /* 2D: gamma by points, too */
};
enum sph_births { BIRTHS_FACES, BIRTHS_VERTICES };
enum sph_integrator { INTEGRATOR_RK4, INTEGRATOR_J3, INTEGRATOR_AUTO }; /* time/runge_kutta.h */
enum sph_surface { SURFACE_NO, SURFACE_YES, SURFACE_AUTO };

/* The parameters as the run uses them: sph_params_of resolves "auto" and zeros that stand for
 * defaults. */
struct sph_params {
    double dx;    /* m */
    double R_dx;  /* support radius over dx, - */
    double c0;    /* m/s; 0: ten times the speed that the scene lets expect */
    double gamma; /* Tait's exponent, 7 or 1 */
    int scheme, limiter, transport, viscosity;
    int surface_shift;    /* enum sph_surface_shift: how shifting ends at a free surface */
    int riemann;          /* enum sph_riemann: how the problem of each pair is solved */
    bool low_dissipation; /* bounded Riemann dissipation (Zhang, Hu & Adams 2017) */
    double dissipation;   /* its least fraction of the full Riemann dissipation then */
    double damper;        /* acoustic damper beta, 0: off */
    double alpha, delta;  /* of schemes delta and standard: artificial viscosity and density
                             diffusion [2.58, 2.60, 2.62] */
    bool background;      /* whether a uniform pressure lifts the lowest one to 0 [2.105] */
    int integrator;       /* enum sph_integrator */
    double cfl;           /* CFL_a of [2.102] */
    double cfl_viscous;   /* CFL_v of [2.103] */
    double box[2][3];     /* outer face of the buffer; all 0: the whole domain, no zones */
    /* The free zone, given instead of box; box is then larger by the widths of the zones. */
    double free[2][3];
    double box_velocity[3]; /* m/s */
    char box_follows[128];  /* name of a body, "": none */
    int walls;              /* enum sph_walls */
    int wall_integrals;     /* enum sph_integrals */
    int surface;            /* enum sph_surface: the fluid has a free surface */
    int outer;              /* enum sph_outer: what the zones impose */
    int births;             /* enum sph_births: where particles enter */
    double density_limit;   /* |rho/rho0 - 1| that ends the run; 0: as the flow has it */
    int packing;     /* steps of rearrangement of the first lattice; -1: as the walls need it */
    double noise;    /* random displacement of the first lattice, in dx */
    double expected; /* m/s: speed to expect, a tenth of the default c0; no key */
    struct scene_speed speed; /* what the scene lets expect of its velocities; no key */
    double extrema[3];        /* m/s: known ones on the centre lines, see sph_lines.c; 0: none */
};

#endif

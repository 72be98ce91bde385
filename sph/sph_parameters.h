/* sph_parameters.h - what group sph of a case says, as plain data that sph/case writes once at the
 * start. Equations: Chiron 2017, cited as [2.x].
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_PARAMETERS_H
#define SPH_PARAMETERS_H

#include "../common/scene/scene.h"

/* Riemann-ALE: Vila [2.86-2.89]. Riemann, no mass flux: Leduc [2.96-2.99]. Delta-SPH: Antuono
 * [2.60-2.63]. Standard: [2.47-2.50] with the artificial viscosity [2.58-2.59]. */
enum sph_scheme { SCHEME_RIEMANN_ALE, SCHEME_RIEMANN, SCHEME_DELTA, SCHEME_STANDARD, SCHEME_AUTO };
/* sph.riemann: the problem of each pair is linearised, or solved exactly by Newton's iteration. */
enum sph_riemann { RIEMANN_LINEAR, RIEMANN_EXACT };
/* sph.limiter of the reconstruction between the particles of a pair. */
enum sph_limiter { LIMITER_KOREN, LIMITER_MINMOD, LIMITER_NONE };
/* sph.transport, the velocity u0 that moves particles: u and a shift over the whole support (TVS)
 * or over 2 dx (TVO, Oger), u alone, none (particles at rest), u smoothed over neighbours (XSPH).
 */
enum sph_transport {
    TRANSPORT_TVS,
    TRANSPORT_TVO,
    TRANSPORT_NONE,
    TRANSPORT_EULERIAN,
    TRANSPORT_XSPH
};
/* sph.surface_shift, how shifting ends at a free surface: near it along it alone, or it fades as
 * the support is cut [5.14]. */
enum sph_surface_shift { SURFACE_SHIFT_ALONG, SURFACE_SHIFT_BETA };
/* sph.dissipation_order, of the jump that the least dissipation acts on: between bounded states, or
 * between states of third order. */
enum sph_dissipation_order { DISSIPATION_FIRST, DISSIPATION_THIRD };
/* sph.viscosity, the form of the viscous term; AUTO stands in cases only. */
enum sph_viscosity { VISCOSITY_MORRIS, VISCOSITY_MONAGHAN, VISCOSITY_AUTO };
/* sph.outer, what the zones of open sides impose: nothing, the scene's exact solution, a partner's
 * fields, or what inlets and outlets among the walls say. */
enum sph_outer { OUTER_NONE, OUTER_EXACT, OUTER_PARTNER, OUTER_SIDES };
/* sph.walls, the treatment of walls: normal fluxes, mirrored ghosts, fixed ghosts. */
enum sph_walls { WALLS_NFM, WALLS_GHOSTS, WALLS_FIXED, WALLS_AUTO };
/* sph.wall_integrals, how the integrals of normal flux walls are found. */
enum sph_integrals {
    INTEGRALS_CLOSED,
    INTEGRALS_CLIPPED,   /* 3D */
    INTEGRALS_CENTROIDS, /* gamma closed */
    INTEGRALS_NUMERICAL  /* 2D: gamma by points, too */
};
/* sph.births, where particles enter at open sides: half a spacing inside at the faces of a lattice,
 * or on the side at its vertices (Kassiotis). */
enum sph_births { BIRTHS_FACES, BIRTHS_VERTICES };
/* sph.integrator: a table of time/runge_kutta.h. */
enum sph_integrator { INTEGRATOR_RK4, INTEGRATOR_J3, INTEGRATOR_AUTO };
/* sph.surface: whether a free surface is treated; AUTO where the fluid does not fill the domain. */
enum sph_surface { SURFACE_NO, SURFACE_YES, SURFACE_AUTO };

/* The parameters as the run uses them: sph_params_of resolves "auto" and zeros that stand for
 * defaults. */
struct sph_params {
    double dx;    /* m: spacing at the start, of the coarsest level */
    double R_dx;  /* support radius over dx, - */
    double c0;    /* m/s; 0: ten times the speed that the scene lets expect */
    double gamma; /* Tait's exponent, 7 or 1 */
    int scheme, limiter, transport, viscosity; /* the enums above */
    int surface_shift;     /* enum sph_surface_shift: how shifting ends at a free surface */
    int riemann;           /* enum sph_riemann: how the problem of each pair is solved */
    bool low_dissipation;  /* bounded Riemann dissipation (Zhang, Hu & Adams 2017) */
    double dissipation;    /* its least fraction of the full Riemann dissipation then */
    int dissipation_order; /* enum sph_dissipation_order */
    double damper;         /* acoustic damper beta, 0: off */
    double alpha, delta;   /* of schemes delta and standard: artificial viscosity and density
                              diffusion [2.58, 2.60, 2.62] */
    bool background;       /* whether a uniform pressure lifts the lowest one to 0 [2.105] */
    int integrator;        /* enum sph_integrator */
    double cfl;            /* CFL_a of [2.102] */
    double cfl_viscous;    /* CFL_v of [2.103] */
    double box[2][3];      /* outer face of the buffer; all 0: the whole domain, no zones */
    /* The free zone, given instead of box; box is then larger by the widths of the zones. */
    double free[2][3];
    double box_velocity[3]; /* m/s: of a box that moves */
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

/* evolution.h - waves of a periodic line or plane over time, without friction and not broken
 * (Zakharov 1968): level eta and potential phi_s on it,
 *   eta_t = -grad phi_s.grad eta + (1 + |grad eta|^2) W,
 *   phi_s,t = -g eta - |grad phi_s|^2/2 + (1 + |grad eta|^2) W^2/2,
 * W = phi_z on the surface from layer.h, or of order M in steepness from hos.h. Classical
 * Runge-Kutta steps around the linear part, which is exact mode by mode; modes of more than
 * `highest' are left out, and those near it damped. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_EVOLUTION_H
#define COMMON_EVOLUTION_H

#include <stdbool.h>

#include "hos.h"
#include "layer.h"

enum { EVOLUTION_STAGES = 4 };

/* The physical and numerical parameters of an evolution. */
struct evolution_spec {
    double g, depth; /* m/s^2, m */
    double dt;       /* s */
    double highest;  /* 1/m: number of the shortest modes */
    double height;   /* m: of the layer at rest */
    int nodes;       /* of the layer, along the vertical */
    int order;       /* M of hos.h, 1 to HOS_ORDERS; 0: W by the layer */
};

/* A wave field and its state. Every rank evolves the same field to the same bits. */
struct evolution {
    struct evolution_spec of;
    struct wave_grid *grid;    /* owned */
    struct sigma_layer *layer; /* owned */
    struct hos *hos;           /* owned; NULL: by the layer */
    long step;                 /* steps done */
    bool looked;               /* eta, phi and layer belong to the present state */
    double *state;             /* [cells][2]: modes of eta + i phi_s */
    double *eta, *phi;         /* m, m^2/s, [cells]: fields of the state, set by evolution_look */
    double *linear;            /* 1/m, [cells]: W over phi_s of small waves, mode by mode, as the
                                  discretisation has it */
    double energy;             /* m^3/s^2: mean of (phi_s eta_t + g eta^2)/2, by evolution_step */
    int products; /* applications of the layer's operator since the start, a measure of cost */
    double *work[2], *fields, *rate[EVOLUTION_STAGES], *at[2];
};

/* Makes an evolution at rest; takes over the grid. Owned by the caller. */
struct evolution *evolution_create(const struct evolution_spec *of, struct wave_grid *grid);
/* Sets the state from eta[cells], m, and phi_s[cells], m^2/s, as step 0. */
void evolution_start(struct evolution *e, const double *eta, const double *phi);
/* Sets the state after `step' steps from its modes [cells][2], as `state' has them. */
void evolution_restore(struct evolution *e, long step, const double *modes);
/* Computes eta, phi_s and the layer's potential of the present state, to the same bits however the
 * state was reached. false: the surface cuts the layer's lower end or the solver does not converge:
 * waves break. */
bool evolution_look(struct evolution *e);
/* Advances by one step; false: waves break, and the state is unchanged or of no use. */
bool evolution_step(struct evolution *e);

#endif

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

struct evolution_spec {
    double g, depth; /* m/s^2, m */
    double dt;       /* s */
    double highest;  /* 1/m: number of the shortest modes */
    double height;   /* m: of the layer at rest */
    int nodes;       /* of the layer */
    int order;       /* of hos.h; 0: by the layer */
};

struct evolution {
    struct evolution_spec of;
    struct wave_grid *grid;    /* owned */
    struct sigma_layer *layer; /* owned */
    struct hos *hos;           /* owned; NULL */
    long step;                 /* steps done */
    bool looked;               /* eta, phi and layer are the state's */
    double *state;             /* [cells][2]: modes of eta + i phi_s */
    double *eta, *phi;         /* m, m^2/s, [cells]: of the state, by evolution_look */
    double *linear;            /* 1/m, [cells]: W over phi_s of small waves, as it is found */
    double energy;             /* m^3/s^2: mean of (phi_s eta_t + g eta^2)/2, by evolution_step */
    int products;              /* with the layer's operator, since it was made */
    double *work[2], *fields, *rate[EVOLUTION_STAGES], *at[2];
};

/* The grid becomes its own. */
struct evolution *evolution_create(const struct evolution_spec *of, struct wave_grid *grid);
void evolution_free(struct evolution **e);
/* The state of the fields eta, phi_s [cells], as step 0. */
void evolution_start(struct evolution *e, const double *eta, const double *phi);
/* Takes modes [cells][2] as the state after `step' steps. */
void evolution_restore(struct evolution *e, long step, const double *modes);
/* Finds eta, phi_s and the layer's potential of the state; false: there is none, waves break. Its
 * bits are those of the state alone. */
bool evolution_look(struct evolution *e);
/* One step; false: waves break. */
bool evolution_step(struct evolution *e);

#endif

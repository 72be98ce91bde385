/* fraction.h - share C of each cell that is water, carried by the projection's own fluxes, so that
 * water stays where it is; phi, which is smooth, is corrected to it instead of being shifted as a
 * whole. Calm water, all of whose surface phi resolves, needs no shares: there phi is the better
 * one, and what it loses is little. On even cells, layers of unequal height and joined blocks of
 * upright cells at rest. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FRACTION_H
#define FV_FRACTION_H

#include "../fv.h"

/* A cell of air beside the water, whose potential takes its divergence away: fraction_flow.c. */
struct air_cell {
    int64_t cell, step[3];
    double g[3][2]; /* m^(dim-2): conductance of its lower and upper faces; 0: not free */
    double out;     /* m^dim/s: its divergence */
    double per;     /* 1/m^(dim-2): change of the potential with what is left of it */
};

struct fraction {
    double *C;       /* -: share, with ghosts */
    double *layer;   /* -: of each cell when the projection was made; it made the divergence of
                        those of layer 0 zero */
    double *n[3];    /* -: normals of the planes in mixed cells, see plane.h */
    double *alpha;   /* -: of the planes */
    double *flow[3]; /* m^dim/s: volume through the lower face of each cell */
    double *volume;  /* m^dim: of cells, with ghosts */
    double *flux, *work, *next;
    int64_t nair, air_room, first_air[3];
    struct air_cell *air;  /* those of one colour behind those of the other */
    unsigned char *smooth; /* 1: phi resolves the surface here */
    bool boxes;            /* there are some within this rank's cells */
    double carries;      /* 1: phi follows the shares; 0: the water is calm, and they follow phi */
    double calm;         /* steps since it became calm */
    double first;        /* axis of the next sweep */
    double first_before; /* at the start of a step */
    double moved;        /* m^dim: put into neighbours, as cells were too full or less than empty;
                            this rank's */
    double entered;      /* m^dim: through openings, of the last advance; over all ranks */
    double excess;       /* m^dim: what the projection left, of this advance and rank */
};

/* What keeps a scene from having it, m (blocks) NULL: even cells; least: smallest size of a cell,
 * m; NULL: nothing, cells are upright, at rest and do not overlap. Creeping water cannot: it breaks
 * nothing off, and what the shares make phi rough by grows at steps of its viscosity. Collective.
 */
const char *fraction_obstacle(const struct run *r, const struct mesh *m, double least);
/* Says how the water is kept, and why so. */
void fraction_describe(const struct run *r, const struct fv_params *prm, const struct mesh *m,
                       double least);
/* Whether the case asks for it, and nothing does. Collective. */
bool fraction_wanted(const struct fv *s);
/* Shares of the present phi, which they follow. */
void fraction_start(struct fv *s);
void fraction_free(struct fraction **f);
/* The same anew. */
void fraction_take(const struct fv *s);
/* The layers for which the projection has just been made. */
void fraction_note_layers(const struct fv *s);
/* By dt in n parts of it, with U as it is. Collective. */
void fraction_advance(struct fv *s, double dt, int n);
/* m^dim of water; over all ranks. */
double fraction_volume(const struct fv *s);
/* fraction_flow.c: volumes through faces, of U. */
void fraction_set_flows(struct fv *s);
/* fraction_bounds.c: moves what cells have beyond 1 or below 0 to cells around. Collective. */
void fraction_bound(struct fv *s);
/* fraction_level.c: phi moved towards the planes that have the shares. */
void fraction_correct_level(struct fv *s);
/* Whether phi resolves all of the surface and agrees with the shares. Collective. */
bool fraction_is_calm(const struct fv *s);
/* Normal of the plane in cell c by differences of C, not normalised; false: there is none. */
bool fraction_normal(const struct fv *s, const struct part *p, int64_t c, double *n);
/* Whether a cell holds both water and air. */
static inline bool fraction_is_mixed(double C) { return C > 0.0 && C < 1.0; }

#endif

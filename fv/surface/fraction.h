/* fraction.h - volume of fluid: the share C of each cell that is water is advected by the
 * projection's own fluxes, so that water is conserved; phi, which is smooth, is corrected towards C
 * instead of being shifted as a whole. Calm water, all of whose surface phi resolves, needs no
 * shares: there phi is the better one, and loses little. On uniform cells, layers of unequal
 * height, and joined blocks, whose lines of cells may lean, bend and move: shares and
 * planes are those of a cube in the indices of the cell, volumes are its own.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_FRACTION_H
#define FV_FRACTION_H

#include "../fv.h"
#include "levelset.h"

/* A cell of air beside the water whose divergence is removed by a potential: fraction_flow.c. */
struct air_cell {
    int64_t cell, step[3];
    double share[3][2]; /* -: of its lower and upper faces in its conductance; 0: not free */
    double out;         /* m^2/s: its divergence over its conductance */
};

/* The axis of each block's cells, of uniform ones as block 0, in the sweeps along axis 0, 1, 2. */
struct sweep_axes {
    int axis[3][MESH_BLOCKS_MAX];
    bool known[MESH_BLOCKS_MAX];
};

/* The shares and the planes (plane.h) that reconstruct the interface. Fields have the size of phi
 * and are owned. */
struct fraction {
    double *C; /* -: share, with ghosts */
    /* -: layer (levelset.h) of each cell when the projection was made, which made the divergence of
     * those of layer 0 zero. */
    double *layer;
    double *n[3];    /* -: normals of the planes in mixed cells, out of the water */
    double *alpha;   /* -: of the planes */
    double *flow[3]; /* m^dim/s: volume through the lower face of each cell */
    bool has_flows;  /* for the next advance: U is that of the last one, as around a step's end */
    double *volume;  /* m^dim: of cells, ghosts included */
    /* Blocks, ghosts included: spacing along the indices, m; cosines of the angles between the
     * gradients of two indices, a < b, where some cells lean. NULL: uniform cells or layers; all
     * cosines are 0. */
    double *height[3], *cosine[3][3];
    double *area[3]; /* m^(dim-1): volume over height; NULL: U is a volume already */
    double *flux, *work, *next;
    /* m^dim: water through the lower faces since gauges were read last; NULL without gauges, and on
     * blocks that move, whose gauges read the flow at one time. */
    double *passed[3];
    double passed_time; /* s: since then; -1: shares did not carry all of the water */
    double was_read;    /* 1: gauges have been read, so that the next step counts anew */
    int64_t nair;
    struct air_cell *air;
    unsigned char *smooth; /* 1: phi resolves the surface here */
    bool boxes;            /* boxes are cut out of this rank's cells */
    double carries; /* 1: phi follows the shares; 0: the water is calm, and they follow phi */
    double calm;    /* steps since the water became calm */
    struct sweep_axes axes;
    double first; /* axis of the next sweep */
    /* m^dim: moved to neighbours, as cells were fuller than full or less than empty. */
    double moved;
    double entered; /* m^dim: through openings, of the last advance; over all ranks */
    double excess;  /* m^dim: volume error that the projection left, of this advance and rank */
};

/* Logs how the volume of water is conserved, and why so. */
void fraction_describe(const struct run *r, const struct fv_params *prm, const struct mesh *m,
                       double least);
/* Whether the case asks for shares and nothing keeps it from having them. Collective. */
bool fraction_wanted(const struct fv *s);
/* Allocates s->surface->fraction and sets the shares from the present phi. */
void fraction_start(struct fv *s);
/* Sets the shares from the present phi again. */
void fraction_take(const struct fv *s);
/* Keeps the layers for which the projection has just been made. */
void fraction_note_layers(const struct fv *s);
/* U is no longer that of the last advance: takes has_flows back. */
void fraction_forget_flows(const struct fv *s);
/* A step begins: what crosses faces is counted for gauges, on and on until they are read. Violent
 * water changes from step to step: of every third one a gauge behind a dyke made 15 % less. */
void fraction_count(struct fraction *f, int64_t size);
/* Advects the shares by dt, s, in n parts, with the fluxes U as they are. Collective. */
void fraction_advance(struct fv *s, double dt, int n);
/* Volume of water, m^dim, over all ranks. Collective. */
double fraction_volume(const struct fv *s);
/* fraction_flow.c: sets flow from U, relative to faces that move; for blocks that move before they
 * are put elsewhere, where the divergence of U is not 0. Nothing if it is there. */
void fraction_set_flows(struct fv *s);
/* Water that crosses a plane normal to axis a in the uniform cell c, `at' of the way from its lower
 * to its upper face, per area, m/s, the mean over passed_time > 0; between the faces linear. */
double fraction_passed(const struct fv *s, int64_t c, int a, double at);
/* fraction_bounds.c: moves what cells have beyond 1 or below 0 to cells around; returns how much,
 * m^dim, of this rank. Collective. */
double fraction_bound(struct fv *s);
/* fraction_level.c: corrects phi towards the planes that have the shares. */
void fraction_correct_level(struct fv *s);
/* Whether phi resolves all of the surface and agrees with the shares. Collective. */
bool fraction_is_calm(const struct fv *s);
/* Normal of the plane in cell c of part p by differences of C, not normalised; false: there is
 * none. */
bool fraction_normal(const struct fv *s, const struct part *p, int64_t c, double *n);
/* m: spacing of the cells along index a at place c. */
static inline double fraction_height(const struct fv *s, int64_t c, int a)
{
    const double *height = s->surface->fraction->height[a];
    return height ? height[c] : grid_height(&s->grid, c, a);
}
/* Whether a cell holds both water and air. */
static inline bool fraction_is_mixed(double C) { return C > 0.0 && C < 1.0; }

#endif

/* levelset.h - free surface of one phase: phi < 0 in water, the air is empty and at p = 0. Cells
 * whose centre is wet are computed; dry ones near the surface carry an extrapolated velocity, so
 * that all stencils continue across it. Fields have the size of s->u's, local indices c; the state
 * of the surface is s->surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_LEVELSET_H
#define FV_LEVELSET_H

#include "../../common/base/base.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "patterns.h"

enum {
    LAYERS = 6,       /* of dry cells that carry a velocity, for the advection of phi */
    STENCILS = 2,     /* of them that stencils of wet cells reach */
    DEEP = 99,        /* layer of dry cells further off */
    BAND_WIDTH = 8,   /* cells on either side of the surface that are reinitialised */
    SURFACE_CALM = 20 /* steps until calm water is left to phi, and phi to exact distances */
};

/* A face between a wet and a dry cell, where the surface crosses the line of their centres. */
struct cut {
    int64_t wet, dry, face; /* cells, index in U */
    double theta;           /* -: distance of the surface from the wet centre, in units of step */
    double step, size;      /* m: between the two centres; the wet cell's along the axis */
    double height;          /* m^2/s^2: minus the hydrostatic pressure over rho there */
    double p;               /* m^2/s^2: p/rho on the surface */
    double up;              /* 1 if the dry cell is the upper one, else -1 */
};

/* How a dry cell near the surface gets its value: weights of the cells in its stencil. */
struct carry {
    int64_t cell;
    int first, n;   /* place in the lists below */
    int first_grad; /* layer 1: place of the weights of derivatives along e, dim each */
    double e[3][3]; /* layer 1: normal, out of the water, and tangents */
    bool has_slope; /* layer 1, unless the water is thin */
    double slope;   /* weight of the normal derivative */
    bool slows;     /* layer 2: it may be much slower than its stencil, as films are */
    bool turns;     /* its values turn with the lines of cells */
    bool ahead;     /* fluxes of water read it before a projection */
};

struct fraction;       /* water of each cell, fraction.h; NULL: phi is shifted as a whole */
struct surface_forced; /* phi in a partner's cells; surface_forced.h; NULL: none */
struct surface_mesh;   /* blocks as the surface sees them, mesh_view.h */
struct level_ops;      /* what the cells offer to it, level_ops.h */
struct window_ops;     /* and to the velocity of dry cells, extension_window.h */
struct band;           /* cells that are reinitialised, reinit_band.h */
struct reinit_ops;     /* the same to its reinitialisation, reinit_band.h */

/* The free surface and all that follows from the present phi. Arrays are owned. */
struct surface {
    const struct level_ops *ops;
    const struct reinit_ops *reinit;
    const struct window_ops *window;
    struct fraction *fraction;
    struct surface_forced *forced;
    /* Uniform cells whose values belong to nobody: behind sides, in boxes, deep in a partner's
     * part. */
    bool *closed;
    /* Not 0: cells that hold nothing, i.e. `closed', or on blocks `out' of mesh_view.h;
     * borrowed. */
    const unsigned char *none;
    struct surface_mesh *mesh;    /* NULL: even cells or layers of unequal height */
    double *phi, *phi_new, *rate; /* m, m, m/s */
    double *kept;                 /* scratch of reinit */
    unsigned char *bent;          /* uniform cells: surface_note_bends; NULL: others */
    /* At the start of a step: surface_keep_state. */
    double *before[FV_RESTART_FIELDS], numbers_before[FV_RESTART_NUMBERS];
    int (*near_before)[2]; /* the cells near water that it is of; NULL: all */
    /* Implicit steps: phi at half time, while phi is that at the end of the step. */
    double *half;
    double travelled_before;
    double *stress;       /* 1/s: n.(D n) of dry cells beside the water */
    unsigned char *layer; /* 0: wet; 1 .. LAYERS; DEEP */
    double *open[3];      /* 1: both cells of the face are wet and free */
    int64_t ncut[3];
    struct cut *cut[3];
    /* Uniform cells: wet ones whose gradient of psi along an axis would take dry ones. */
    int64_t nleaving[3];
    int64_t *leaving[3];
    int64_t ncarry[LAYERS + 1];
    struct carry *carry[LAYERS + 1];
    int64_t nstencil, stencil_room, ngrad, grad_room;
    int64_t nkept; /* of the stencils, the first ones: those of patterns, which stay */
    struct patterns patterns;
    int *at; /* offsets from the cell to those of its stencil */
    double *weight, *grad;
    int64_t ndeep, *deep; /* local cells */
    int64_t wet, cuts;    /* over all ranks */
    /* m^dim: volume to be conserved, including what has come in through openings; net volume that
     * the shifts have restored. */
    double volume0, returned;
    double lost, gained;   /* m^dim: parts of returned: restored losses, removed surplus */
    double passed;         /* m^dim: through openings and a partner's interface, in and out */
    double whole;          /* m^dim: water of all programs of a coupled job at the start */
    double entered;        /* m^dim: through openings, in less out */
    double carried_in;     /* m^dim: the same of the first half of a step, by the shares */
    double through[3];     /* m^dim/s: at the start of a step, see flows() */
    double calm;           /* steps: surface_note_calm */
    double travelled;      /* -: cells that it has moved since the last reinitialisation */
    double least, largest; /* m: sizes of cells */
    struct band *band;     /* scratch of reinit.c, owned */
    bool keeps;            /* slopes of phi behind inclined walls stay as they are */
    bool inclined[MESH_BLOCKS_MAX]; /* a part: index lines are neither level nor upright */
    bool any_inclined;              /* those of some block */
    double across;          /* m: least spacing of cells across gravity, of 45 degrees and less */
    double theta_least;     /* -: least distance of the surface from a wet centre, of h */
    double rise;            /* s^2: implicit steps: see surface_pressure.c */
    double g;               /* m/s^2: size of gravity */
    struct fit oscillation; /* of a standing wave: its momentum, sampled (surface_mode.c) */
    int64_t reinits;        /* reinitialisations so far */
    int64_t repeats;        /* steps that were repeated so far */
};

/* The surface of the scene's water at the start; freed by FREE. */
struct surface *levelset_create(const struct fv *s);
/* Ghosts of a level set: halo, and mirrored (zero gradient) beyond closed sides. Collective. */
void surface_ghosts(const struct fv *s, double *phi);
/* The same for shares of water. */
void surface_mirror(const struct fv *s, double *q);
/* Advects phi by dt, s, with u as it is; returns the number of parts that the step was cut into. */
int surface_advance(struct fv *s, double dt);
/* The same for blocks that move, from where they are to their positions at time t. */
int surface_advance_to(struct fv *s, double t, double dt);
/* Shifts phi uniformly to the volume volume0, by a tenth of a cell per iteration at most.
 * Collective. */
void surface_keep_volume(struct fv *s);
/* Counts a volume of water, m^dim, over all ranks, that was put back or, < 0, removed. */
void surface_note_returned(struct fv *s, double volume);
/* Volume of water without a partner's part, m^dim, over all ranks. Collective. */
double surface_volume(const struct fv *s);
/* m^(dim-1): plan area of the surface where it stands at most `within' above or below a level, m.
 * Collective. */
double surface_plan(const struct fv *s, double level, double within);
/* The same below phi = 0; *area: its derivative with respect to a shift of phi, < 0, m^(dim-1). */
double surface_level_volume(const struct fv *s, double *area);
/* The volume by which losses are judged, m^dim: what was there and has come in, at least a
 * hundredth of the domain, so that the first drops in an empty one are no fault. */
double surface_volume_scale(const struct fv *s);
/* Gradient of phi at cell c as differences per cell, m. */
void surface_slopes(const struct fv *s, const struct part *p, int64_t c, double *n);
/* Fraction of cell c below phi = 0, by the plane through its centre. */
double surface_share(const struct fv *s, int64_t c);
/* Fraction of cell c that is water: C of fraction.h if there is one, else by phi. */
double surface_water(const struct fv *s, int64_t c);
/* The same of the lower face of cell c along axis a. */
double surface_face_share(const struct fv *s, int64_t c, int a);

/* Volume of cell c, in local layer j, that counts, m^dim: where blocks overlap every point counts
 * once. */
double surface_cell_volume(const struct fv *s, int64_t c, int j);
/* The part of a share of cell c that counts where blocks share the cell, -. */
double surface_counted(const struct fv *s, int64_t c, double share);
/* A distance, m, larger than any in the domain: phi in boxes that are cut out, which are no
 * water. */
static inline double surface_far(const struct fv *s)
{
    return s->b.length[0] + s->b.length[1] + s->b.length[2];
}

/* shape_distance.c: signed distance of the scene's water at the start, m. */
double surface_distance(const struct fv *s, const double *x);
/* The shape that the water at x belongs to; NULL: none. */
const struct scene_shape *surface_shape(const struct fv *s, const double *x);

/* closest.c: on uniform cells takes note of where phi bends too much for surface_closest, which is
 * to be asked about this phi; phi: with ghosts. Nothing on other cells. */
void surface_note_bends(const struct fv *s, const double *phi);
/* Signed distance of cell c of a part from phi = 0, m; false: the cells around do not
 * resolve the surface, or it is more than two cells away. phi: with ghosts. */
bool surface_closest(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                     double *distance);

/* reinit.c: makes phi a distance again within BAND_WIDTH cells, by so many pseudo-time steps.
 * Collective. */
void surface_reinit(struct fv *s, int steps);
/* The same after a small change: exact beside the surface, one pseudo-time step elsewhere near
 * it. */
void surface_redistance(struct fv *s);
/* Once a step, and at the start, where blocks overlap: counts the steps since phi has been smooth
 * all along the surface. Collective. */
void surface_note_calm(struct fv *s, bool start);

/* extension.c: finds the layers and stencils of the present phi. */
void extension_build(struct fv *s);
/* Whether a cell holds nothing: behind sides, in boxes and holes. */
static inline bool surface_holds_none(const struct fv *s, int64_t c) { return s->surface->none[c]; }
/* How the velocity is extended into dry cells. */
enum extend {
    EXTEND_FREE,  /* goes on as it comes */
    EXTEND_SHEAR, /* no shear stress at the surface; takes note of the normal one */
    EXTEND_CHANGE /* the same for an increment: takes no note */
};
/* Sets u of dry cells in the layers 1 to `layers'. */
void extension_apply(const struct fv *s, double *const u[3], enum extend how, int layers);
/* Extends one field to layers 1 and 2. */
void extension_scalar(const struct fv *s, double *q);
/* The same for the layers further out, within what is around. */
void extension_beyond(const struct fv *s, double *q);

/* surface_smooth.c: removes waves a few cells long from u (with its ghosts) beside the surface,
 * once in a step of dt, s. */
void surface_smooth(struct fv *s, double dt);

/* surface_pressure.c: finds wet cells, cut faces and stencils of the present phi; poisson_rebuild
 * is due afterwards. */
void surface_rebuild(struct fv *s);
/* Sets p/rho on the cut faces, with the viscous stress of the last extension. */
void surface_set_pressure(struct fv *s);
/* Sets q to 0 in dry cells of this rank: next to water, where the solvers read it; of all. */
void surface_zero(const struct fv *s, double *q);
void surface_zero_all(const struct fv *s, double *q);
/* Subtracts from div what the surface's pressure adds to the Laplacian of psi. */
void surface_add_pressure(const struct fv *s, double *div);
/* Corrects U of the cut faces by tau times the slope of psi there, s: length of the stage. */
void surface_fluxes(const struct fv *s, double tau, const double *psi);
/* Sets U of dry faces from u; stencils: of those next to water alone. */
void surface_dry_fluxes(const struct fv *s, bool stencils);
/* Slope of psi on a cut face, along its axis; change: of a variation, which is 0 on the surface. */
double surface_cut_gradient(const struct cut *x, const double *psi, bool change);
/* Gradient of psi along a in cells whose stencil leaves the water: the mean of the faces', except
 * in the last two wet cells of a line (surface_line.c). */
void surface_gradient(const struct fv *s, int a, const double *psi, double *out);
/* The same of a variation, which is 0 on the surface. */
void surface_gradient_change(const struct fv *s, int a, const double *psi, double *out);

/* surface_line.c: recomputes in these two cells the slope of psi along a; uniform cells. */
void surface_line_slopes(const struct fv *s, int a, const double *psi, bool change, double *out);

/* surface_mode.c: takes a sample of the oscillation of a standing wave. */
void surface_sample(struct fv *s);

#endif

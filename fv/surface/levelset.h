/* levelset.h - free surface of one phase: phi < 0 in water, the air is empty and at p = 0. Cells
 * whose centre is wet are computed; dry ones near the surface carry the velocity on, so that all
 * stencils go on across it. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_LEVELSET_H
#define FV_LEVELSET_H

#include "../../common/base/fit.h"
#include "../fv.h"
#include "../grid/mesh.h"

enum {
    LAYERS = 6,    /* of dry cells that carry a velocity, for the advection of phi */
    STENCILS = 2,  /* of them that stencils of wet cells reach */
    DEEP = 99,     /* layer of dry cells further off */
    BAND_WIDTH = 8 /* cells on either side of the surface that are reinitialised */
};

/* A face between a wet and a dry cell. */
struct cut {
    int64_t wet, dry, face; /* cells, index in U */
    double theta;           /* -: distance of the surface from the wet centre, of step */
    double step, size;      /* m: between the two centres; the wet cell's along the axis */
    double height;          /* m^2/s^2: -(pressure at rest)/rho there */
    double p;               /* m^2/s^2: p/rho on the surface */
    double up;              /* 1 if the dry cell is the upper one, else -1 */
};

/* How a dry cell near the surface gets its value: weights of the cells in its stencil. */
struct carry {
    int64_t cell;
    int first, n;   /* place in the lists below */
    int first_grad; /* layer 1: place of the gradient's weights, dim each */
    double n3[3];   /* layer 1: normal, out of the water */
    bool has_slope; /* layer 1, unless the water is thin */
    double slope;   /* weight of the normal derivative */
    bool slows;     /* layer 2: it may be much slower than its stencil, as films are */
};

struct fraction;       /* water of each cell, fraction.h; NULL: phi is shifted as a whole */
struct surface_forced; /* phi in a partner's cells; surface_forced.h; NULL: none */
struct surface_mesh;   /* blocks as the surface sees them, mesh_view.h */
struct level_ops;      /* what the cells offer to it, level_ops.h */
struct window_ops;     /* and to the velocity of dry cells, extension_window.h */
struct reinit_ops;     /* the same to its reinitialisation, reinit_band.h */

struct surface {
    const struct level_ops *ops;
    const struct reinit_ops *reinit;
    const struct window_ops *window;
    struct fraction *fraction;
    struct surface_forced *forced;
    bool *closed; /* even cells whose values are nobody's: behind sides, boxes, deep in a partner's
                     part */
    const unsigned char
        *none; /* not 0: the former, or those of blocks that are out, see mesh_view.h
                */
    struct surface_mesh *mesh;    /* NULL: even cells or layers of unequal height */
    double *phi, *phi_new, *rate; /* m, m, m/s */
    double *kept;                 /* scratch of reinit */
    double *before[26];           /* state at the start of a step, see surface_keep_state */
    double *half; /* implicit steps: phi at half time, while phi stands where the step ends */
    double travelled_before;
    double *stress;       /* 1/s: n.(D n) of dry cells beside the water */
    unsigned char *layer; /* 0: wet; 1 .. LAYERS; DEEP */
    double *open[3];      /* 1: both cells of the face are wet and free */
    int64_t ncut[3], room[3];
    struct cut *cut[3];
    int64_t ncarry[LAYERS + 1], carry_room[LAYERS + 1];
    struct carry *carry[LAYERS + 1];
    int64_t nstencil, stencil_room, ngrad, grad_room;
    int *at; /* step from the cell to those of its stencil */
    double *weight, *grad;
    int64_t ndeep, *deep;     /* local cells */
    int64_t wet, cuts;        /* over all ranks */
    double volume0, returned; /* m^dim: to be kept, with what has come in through openings; restored
                                 by the shifts, all in all */
    double lost, gained;      /* m^dim: of returned: what had been lost, what there was too much */
    double passed;            /* m^dim: through openings and a partner's interface, in and out */
    double entered;           /* m^dim: through openings, in less out */
    double carried_in;        /* m^dim: the same of the first half of a step, by the shares */
    double through[3];        /* m^dim/s: at the start of a step, see flows() */
    double travelled;         /* -: cells since the last reinit */
    double least, largest;    /* m: sizes of cells */
    bool keeps;               /* slopes of phi behind inclined walls stay as they are */
    bool leans[MESH_BLOCKS_MAX]; /* a part: index lines are neither level nor upright */
    bool any_leans;              /* those of some block */
    double across;      /* m: least spacing of cells across gravity, of 45 degrees and less */
    double theta_least; /* -: least distance of the surface from a wet centre, of h */
    double rise;        /* s^2: implicit steps: see surface_pressure.c */
    double g;           /* m/s^2: size of gravity */
    struct fit swing;   /* of a standing wave: its momentum, sampled (surface_mode.c) */
    int64_t setups, reinits, repeats;
};

/* levelset.c */
struct surface *levelset_create(const struct fv *s);
void levelset_free(struct surface **w);
/* Ghosts of a level set: halo, and mirrored beyond closed sides. */
void surface_ghosts(const struct fv *s, double *phi);
/* The same of any field that belongs to cells, mirrored beyond closed sides. */
void surface_mirror(const struct fv *s, double *q);
/* phi by dt with u as it is, in so many parts. */
int surface_advance(struct fv *s, double dt);
/* The same of blocks that move, from where they stand to their places at time t. */
void surface_advance_to(struct fv *s, double t, double dt);
/* Shifts phi uniformly to the volume of the start. */
void surface_keep_volume(struct fv *s);
/* Counts water (m^dim, over all ranks) that was put back, or, < 0, taken away. */
void surface_note_returned(struct fv *s, double volume);
/* m^dim of water, a partner's part apart. Over all ranks. */
double surface_volume(const struct fv *s);
/* The same below phi = 0; *area: its change with phi, < 0. */
double surface_level_volume(const struct fv *s, double *area);
/* m^dim: what lost volumes are judged by: what was there and has come in, at least a hundredth of
 * the domain, so that the first drops in an empty one are no fault. */
double surface_volume_scale(const struct fv *s);
/* Slopes of phi at cell c, m a cell. */
void surface_slopes(const struct fv *s, const struct part *p, int64_t c, double *n);
/* Share of a cell below phi = 0, by the plane through its centre. */
double surface_share(const struct fv *s, int64_t c);
/* Share of a cell that is water: what the fluxes have carried there, or phi's. */
double surface_water(const struct fv *s, int64_t c);
/* The same of the face below cell c along axis a. */
double surface_face_share(const struct fv *s, int64_t c, int a);

/* m^dim: volume of cell c, in local row j, that counts: of places where blocks overlap once. */
double surface_cell_volume(const struct fv *s, int64_t c, int j);
/* -: the part of a share of cell c that counts, where blocks share the cell. */
double surface_counted(const struct fv *s, int64_t c, double share);
/* Further off (m) than any cell can be: phi within boxes that are cut out, which are no water. */
static inline double surface_far(const struct fv *s)
{
    return s->b.length[0] + s->b.length[1] + s->b.length[2];
}

/* shape_distance.c: signed distance (m) of the scene's water at the start. */
double surface_distance(const struct fv *s, const double *x);
/* The shape that the water at x belongs to; NULL: none. */
const struct scene_shape *surface_shape(const struct fv *s, const double *x);

/* closest.c: distance of cell c from phi = 0, with its sign; false: the cells around do not resolve
 * the surface, or it is more than two cells off. phi: with ghosts. */
bool surface_closest(const struct fv *s, const double *phi, int64_t c, double *distance);

/* reinit.c: phi a distance again, by so many pseudo steps. */
void surface_reinit(struct fv *s, int steps);
/* The same after a small change: exact beside the surface, a pseudo step elsewhere near it. */
void surface_redistance(struct fv *s);
/* Largest | |grad phi| - 1 | within two cells of the surface. */
double surface_distortion(const struct fv *s);

/* extension.c: layers and stencils of the present phi; u of dry cells, layers 1 .. n. */
void extension_build(struct fv *s);
/* Whether a cell holds nothing: behind sides, in boxes and holes. */
static inline bool surface_holds_none(const struct fv *s, int64_t c) { return s->surface->none[c]; }
enum extend {
    EXTEND_FREE,  /* goes on as it comes */
    EXTEND_SHEAR, /* no shear stress at the surface; takes note of the normal one */
    EXTEND_CHANGE /* the same for an increment: takes no note */
};
void extension_apply(const struct fv *s, double *const u[3], enum extend how, int layers);
/* The same for one field, layers 1 and 2. */
void extension_scalar(const struct fv *s, double *q);
/* The same for the layers further out, within what is around. */
void extension_beyond(const struct fv *s, double *q);

/* surface_smooth.c: u (with its ghosts) beside the surface without waves of a few cells, once in a
 * step dt. */
void surface_smooth(struct fv *s, double dt);

/* surface_pressure.c */
/* What the surface's rise within an implicit step adds to the distance from a wet centre to its
 * pressure, m; e: from wet to dry, of length 1. */
double surface_rise(const struct fv *s, const double *e);
/* Wet cells, cut faces and stencils of the present phi; poisson_rebuild then. */
void surface_rebuild(struct fv *s);
/* p/rho on the cut faces with the viscous stress of the last extension. */
void surface_set_pressure(struct fv *s);
void surface_zero(const struct fv *s, double *q); /* in dry cells of this rank */
/* div -= what the surface's pressure adds to Lap psi. */
void surface_add_pressure(const struct fv *s, double *div);
/* U of cut faces by the pressure there, of dry faces anew from u. */
void surface_fluxes(const struct fv *s, double tau, const double *psi);
void surface_dry_fluxes(const struct fv *s);
/* Slope of psi on a cut face; change: of a variation, which is 0 on the surface. */
double surface_cut_gradient(const struct cut *x, const double *psi, bool change);
/* Gradient of psi along a in cells whose stencil leaves the water: mean of the faces', but in the
 * last two wet cells of a line. */
void surface_gradient(const struct fv *s, int a, const double *psi, double *out);
/* The same of a variation, which is 0 on the surface. */
void surface_gradient_change(const struct fv *s, int a, const double *psi, double *out);

/* surface_line.c: out of even cells, the slope of psi along a, anew in these two. */
void surface_line_slopes(const struct fv *s, int a, const double *psi, bool change, double *out);

/* surface_steps.c */
/* Velocities, fluxes and cuts of the start. */
void surface_start(struct fv *s);
/* Other cells are imposed than before, when the free ones held `before' m^dim. Collective. */
void surface_outline_moved(struct fv *s, double before);
/* Velocity beyond the surface where it stands now, with ghosts, and the fluxes there. */
void surface_extend(struct fv *s, int layers);
/* Around a step of u: the surface stands at half time in it, so that both swing without loss
 * (leapfrog: phi and u take turns). */
void surface_first_half(struct fv *s, double dt);
void surface_second_half(struct fv *s, double dt);
/* What a step starts from, kept to go back to it. */
void surface_keep_state(struct fv *s);
void surface_back(struct fv *s);
/* Why the run cannot go on; NULL if it can. */
const char *surface_trouble(const struct fv *s);

/* surface_errors.c */
/* Kinetic energy of the water, J/kg m^dim, over all ranks. */
double surface_energy(const struct fv *s);
/* Farthest water along axis a, m, over all ranks. */
double surface_reach(const struct fv *s, int a);
/* Height of the water at x: of that in the column of cells there, on top of the bottom. This
 * rank's part of it. */
double surface_level(const struct fv *s, const double *x);
/* Takes a sample of what swings in a standing wave; period and damping, volume and counts into the
 * summary. */
void surface_sample(struct fv *s);
void surface_summarise(struct fv *s);

#endif

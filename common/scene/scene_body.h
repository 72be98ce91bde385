/* scene_body.h - rigid bodies of a scene: their shape, how they move, what holds them. Plain data
 * of the case; body_drive.h evaluates prescribed motion, sph/rigid moves free bodies. In 2D all
 * forces and masses are per metre of depth.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

#include "../params/params.h"
#include "scene_surface.h"

/* How a term of a motion is given (bodies.motion.kind): rows of a file over time, amplitude, period
 * and phase, coefficients of powers of time, the wave maker's motion for the group waves, or what
 * another program of the job says of the body, or of each point of its outline. */
enum motion_kind {
    MOTION_FILE,
    MOTION_HARMONIC,
    MOTION_POLYNOMIAL,
    MOTION_WAVES,
    MOTION_PARTNER,
    MOTION_BENDING
};
/* Degrees of freedom of a body: along x, y, z, then about them. In 2D x, y and RZ exist alone. */
enum body_axis { AXIS_X, AXIS_Y, AXIS_Z, AXIS_RX, AXIS_RY, AXIS_RZ, BODY_AXES };
/* How the fluid's force on a free body is measured: as the momentum that the particles lose to it,
 * or as the integral of pressure and friction averaged by the kernel at its surface. */
enum force_rule { FORCE_CONSERVING, FORCE_AVERAGE };
/* Most terms of a body's motion, most springs and mooring lines of a body. */
enum { MOTIONS_MAX = 32, LINES_MAX = 8 };

/* One term of a prescribed motion. The terms of a body add up, each along one degree of freedom but
 * for files, which have all. */
struct scene_motion {
    int kind, axis;                    /* enum motion_kind, body_axis */
    char file[PARAM_TEXT_SIZE];        /* rows t, x, y, angle; 3D: t, x, y, z, rx, ry, rz */
    double amplitude;                  /* m or rad */
    double period, phase;              /* s, rad */
    struct param_numbers coefficients; /* m/s^k or rad/s^k: c_0 + c_1 T + ..., T = t - from */
    double from, until;                /* s: of a polynomial */
    double ramp;                       /* s over which the term grows smoothly from nothing */
    bool absorb;                       /* of kind waves: wave_absorber.h */
    bool made; /* its rows were computed by wave_makers_resolve: wave_maker.h */
};

/* The terms of one body: n of them, which add up. */
struct scene_motions {
    int n;
    struct scene_motion of[MOTIONS_MAX];
};

/* A spring, damper or mooring line between the body and an anchor or another body. */
struct scene_line {
    double from[3], to[3];      /* m at the start: on the body; anchor, or on the other body */
    char body[PARAM_TEXT_SIZE]; /* name of the other one; "": none */
    double stiffness, damping;  /* N/m, N s/m (in 2D per metre) */
    double length;              /* m: length without force; < 0: that at the start */
    bool pull_only;             /* a rope: no force when it is shorter than length */
};

/* An axis fixed in space about which the body turns, with an optional spring and damper. */
struct scene_hinge {
    double at[3], axis[3];     /* m; in 2D the axis is z */
    double stiffness, damping; /* N m/rad, N m s/rad (2D: per metre) */
    double at_rest;            /* rad: angle at which the spring is slack */
};

/* The only direction along which the body's centre may move, unit vector. */
struct scene_slider {
    double axis[3]; /* -: of any length but 0 */
};

/* How the body collides with walls and other bodies. */
struct scene_contact {
    double restitution, friction; /* -: normal speed after over before; Coulomb's coefficient */
    double gap;                   /* in units of dx: distance that contact keeps */
};

struct scene_mesh;

/* A body: a closed polyline that runs clockwise, with the fluid on its left; in 3D a closed
 * mesh. */
struct scene_body {
    char name[PARAM_TEXT_SIZE];       /* as columns, gauges and mooring lines call it */
    struct param_points points;       /* 2D: corners, m; 3D: none */
    double box[2][3], radius, length; /* m: a simple form, scene_forms.h */
    struct param_points section;      /* of a prism: what its points were, counter-clockwise */
    struct scene_surface surface;     /* 3D: the file of its mesh and how it is placed */
    const struct scene_mesh *mesh;    /* what its file holds; NULL: points */
    bool thin;                        /* particles on one side have no neighbours on the other */
    int kind;                         /* WALL_SLIP or WALL_NO_SLIP */
    bool tank;                        /* resolved: it is around all water of the start */
    bool turned;                      /* the sense of the points was reversed by scene_orient */
    bool cut;                         /* what is beyond closed sides was left out: scene_cut.h */
    double centre[3];                 /* m: centre of rotation and of moments at t = 0 */
    double velocity[3];               /* m/s: constant, or that of a free body at the start */
    double spin[3];                   /* rad/s: the same of its rotation */
    double force[3];      /* N/m: known mean of the fluid's force, for comparison; 0: not known */
    bool free;            /* moved by forces, but for the degrees of freedom in lock */
    double density, mass; /* kg/m^3; kg (2D: kg/m); 0: not given */
    struct param_numbers inertia; /* kg m^2 about the mass centre: zz in 2D; xx yy zz [xy yz zx] */
    char lock[PARAM_TEXT_SIZE];   /* degrees that forces do not move: "x y rz" */
    double release;               /* s: the body is held until then */
    int force_rule;               /* enum force_rule */
    double load[3], torque[3];    /* N, N m (2D: per metre): constant */
    struct scene_motions motion;  /* prescribed motion, of what forces do not move */
    /* Springs and mooring lines; then at most one hinge, one guide and one rule of contact. */
    struct scene_lines {
        int n;
        struct scene_line of[LINES_MAX];
    } lines;
    struct scene_hinges {
        int n;
        struct scene_hinge of[1];
    } hinge;
    struct scene_sliders {
        int n;
        struct scene_slider of[1];
    } slider;
    struct scene_contacts {
        int n;
        struct scene_contact of[1];
    } contact;
};

/* The rows of an element of the group bodies, which fill a struct scene_body, and their number. */
extern const struct param scene_body_rows[];
extern const int scene_body_nrows;
/* The rows of the list `motion', which fill a struct scene_motions, for groups of their own. */
extern const struct param_list scene_motion_list;

/* The axes about which terms turn, bits 1 << a; those of files are not among them. */
int scene_motions_turn(const struct scene_motions *m);
/* Whether the body ever moves: it is free, or has a velocity or terms of motion. */
bool scene_body_moves(const struct scene_body *b);
/* Box around its surface at the start, m; a body in the plane has 0 along the third axis, one
 * without a surface everywhere. */
void scene_body_box(const struct scene_body *b, double lo[3], double hi[3]);
/* Whether another program of the job moves the body; whether it moves each point of its outline. */
bool scene_body_partnered(const struct scene_body *b);
bool scene_body_bends(const struct scene_body *b);
/* The contact as the case gives it, else with the defaults of the keys. */
struct scene_contact scene_contact_of(const struct scene_body *b);
/* Bits 1 << enum body_axis of the words in lock, separated by blanks or commas; -1: a word is none
 * of them, or not of a case of this dimension. */
int scene_body_locked(const char *lock, int dim);

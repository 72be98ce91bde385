/* scene_body.h - bodies of a scene: outline, how they move, what holds them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_BODY_H
#define COMMON_SCENE_BODY_H

#include <stdbool.h>

#include "../params/params.h"
#include "scene_surface.h"

enum motion_kind { MOTION_FILE, MOTION_HARMONIC, MOTION_POLYNOMIAL, MOTION_WAVES };
enum body_axis { AXIS_X, AXIS_Y, AXIS_Z, AXIS_RX, AXIS_RY, AXIS_RZ, BODY_AXES };
enum force_rule { FORCE_CONSERVING, FORCE_AVERAGE };
enum { MOTIONS_MAX = 32, LINES_MAX = 8, BODY_NEVER = 1000000000 };

/* One term of a prescribed motion; all of a body's add up. */
struct scene_motion {
    int kind, axis;                    /* enum motion_kind, body_axis */
    char file[PARAM_TEXT_SIZE];        /* rows t, x, y, angle; 3D: t, x, y, z, rx, ry, rz */
    double amplitude;                  /* m or rad */
    double period, phase;              /* s, rad */
    struct param_numbers coefficients; /* m/s^k or rad/s^k */
    double from, until;                /* s: of a polynomial */
    double ramp;                       /* s in which the term grows from nothing */
    bool absorb;                       /* of kind waves: wave_absorber.h */
    bool made;                         /* its file by wave_makers_resolve: wave_maker.h */
};

struct scene_motions {
    int n;
    struct scene_motion of[MOTIONS_MAX];
};

/* Spring, damper or mooring line. */
struct scene_line {
    double from[3], to[3];      /* m at the start: on the body; anchor, or on the other body */
    char body[PARAM_TEXT_SIZE]; /* name of the other one; "": none */
    double stiffness, damping;  /* N/m, N s/m (in 2D per metre) */
    double length;              /* m: without force; < 0: that of the start */
    bool pull_only;
};

struct scene_hinge {
    double at[3], axis[3];     /* m; in 2D the axis is z */
    double stiffness, damping; /* N m/rad, N m s/rad (2D: per metre) */
    double at_rest;            /* rad: angle at which the spring is slack */
};

struct scene_slider {
    double axis[3];
};

struct scene_contact {
    double restitution, friction; /* - */
    double gap;                   /* dx: distance that contact holds */
};

/* Closed polylines, clockwise: fluid on their left; in 3D closed meshes. */
struct scene_mesh;
struct scene_body {
    char name[PARAM_TEXT_SIZE];
    struct param_points points;
    struct scene_surface surface;
    const struct scene_mesh *mesh; /* what its file holds; NULL: points */
    bool thin;
    int kind;                     /* WALL_SLIP or WALL_NO_SLIP */
    bool turned;                  /* by scene_orient */
    double centre[3];             /* m: of rotation and of moments, at t = 0 */
    double velocity[3];           /* m/s */
    double spin[3];               /* rad/s */
    double force[3];              /* N/m: known mean of the fluid's force; 0: not known */
    bool free;                    /* moved by forces */
    double density, mass;         /* kg/m^3; kg (2D: kg/m); 0: not given */
    struct param_numbers inertia; /* kg m^2 about the mass centre: zz in 2D; xx yy zz [xy yz zx] */
    char lock[PARAM_TEXT_SIZE];   /* degrees that forces do not move: "x y rz" */
    double release;               /* s: held until then */
    int force_rule;               /* enum force_rule */
    double load[3], torque[3];    /* N, N m (2D: per metre): constant */
    struct scene_motions motion;
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

extern const struct param_list scene_motion_list;
extern const struct param scene_body_rows[];
extern const int scene_body_nrows;
extern const struct param_list scene_motion_list; /* of a struct scene_motions */

/* Whether the body ever moves. */
bool scene_body_moves(const struct scene_body *b);
/* As given, or as the keys' defaults are. */
struct scene_contact scene_contact_of(const struct scene_body *b);
/* Degrees, BIT(AXIS_..), of the words in lock; -1: a word is none. */
int scene_body_locked(const char *lock, int dim);

#endif

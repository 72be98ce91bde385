/* body.h - rigid bodies: where they are, driven as prescribed or moved by forces. In 2D the same in
 * the plane, rotations about z, masses per metre. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_H
#define SPH_BODY_H

#include "../../common/geometry/trimesh.h"
#include "../../common/scene/body_drive.h"
#include "../../common/scene/scene.h"

struct run;
struct paddle; /* of ../bodies/paddles.h */

/* --- body_free.c: motion by forces --- */

/* State of a free body: what a stage integrates. */
enum { BODY_X, BODY_Q = 3, BODY_ANGLE = 7, BODY_P, BODY_L = 11, BODY_STATE = 14 };
enum body_rotation { TURNS_NOT, TURNS_AXIS, TURNS_FREE };

struct body_free {
    double mass;                         /* kg; 2D: kg/m */
    double inertia[3][3], inverse[3][3]; /* kg m^2 about the mass centre at the start */
    int locked;                          /* bits of enum body_axis */
    int rotation;                        /* enum body_rotation */
    double axis[3], J;                   /* TURNS_AXIS: unit axis, inertia about it */
    bool hinged, slides, held;           /* held: before release */
    double hinge[3], arm[3], slide[3];   /* point of the hinge, centre from it at the start */
    double y[BODY_STATE], y0[BODY_STATE], sum[BODY_STATE], rate[BODY_STATE];
    double force[6]; /* N, N m: of the fluid in the last stage, centre */
    double tension[LINES_MAX], slack[LINES_MAX]; /* N, m: of lines; length without force */
    double contact[3];                           /* N: force of contact in the last stage */
    double stiffness, damping;                   /* N/m, N s/m: of contact */
    double lambda;                               /* 1/s: largest rate at which the fluid stops it */
    double impulse[2][3]; /* N s: of the fluid by either rule; of |F| in size */
    double size;          /* N s: int |F| dt */
};

struct body {
    const struct scene_body *is;
    const struct trimesh
        *mesh; /* 3D: its surface as the case places it, normals into it; borrowed */
    int dim;
    double centre[3]; /* m: of rotation and moments at the start */
    double middle[3]; /* m: of the box round it at the start */
    bool moves;       /* ever */
    double reach;     /* m: of the farthest point from it */
    double volume;    /* m^3; 2D: m^2 */
    int first, n;     /* 2D: its segments */
    struct body_drive drive;
    struct scene_contact contact;
    struct body_free *free; /* NULL: driven */
    struct paddle *paddle;  /* NULL: it does not absorb waves */
    struct body_motion now;
};

/* Mass, centre and inertia as the case has them; false: impossible, why says it. mesh: NULL in 2D.
 */
struct body_mass {
    double mass, centre[3], inertia[3][3];
};
bool body_mass_of(const struct scene_body *is, const struct trimesh *mesh, int dim,
                  struct body_mass *m, char *why, size_t size);
/* Of what its surface encloses, m^3; 2D: m^2. */
double body_volume_of(const struct scene_body *is, const struct trimesh *mesh);
/* Drive, and for a free body its state at the start; the files of its motion are read once a start.
 */
void body_create(struct body *b, const struct scene_body *is, const struct trimesh *mesh, int dim,
                 struct motion_files *files);
void body_destroy(struct body *b);
/* From t on it is held, or no longer. */
void body_hold(struct body *b, double t);
/* now, of the state and the time. */
void body_move(struct body *b, double t);
/* Where a point at `from' at the start is now; its velocity (NULL: not wanted). */
void body_place(const struct body *b, const double *from, double *to);
void body_velocity(const struct body *b, const double *at, double *u);
/* Largest of a point of it now, m/s. */
double body_speed(const struct body *b);
/* Rates of the state from force and moment about the centre, weight and all. */
void body_rates(struct body *b, const double F[3], const double T[3]);
/* An impulse at a point. */
void body_hit(struct body *b, const double impulse[3], const double moment[3]);
/* Normalises the quaternion after a step. */
void body_finish(struct body *b);
/* J: kinetic, and of gravity g. */
double body_energy(const struct body *b, const double g[3], double *kinetic);
/* Inertia of a body against a force along n at the arm r from its centre: 1/(n.M^-1 n), kg. */
double body_effective_mass(const struct body *b, const double *r, const double *n);

#endif

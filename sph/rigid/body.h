/* body.h - rigid bodies: where they are, driven as prescribed or moved by forces. In 2D the same in
 * the plane, with rotations about z and masses per metre. Every rank holds all bodies in the same
 * state; all functions are local and give the same on all ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_BODY_H
#define SPH_BODY_H

#include "../../common/geometry/geometry.h"
#include "../../common/scene/scene.h"

struct run;
struct paddle; /* of ../bodies/paddles.h */

/* --- body_free.c: motion by forces --- */

/* The state of a free body, which the stages of a step integrate: position of the centre, m,
 * quaternion, angle, rad (one axis), momentum, N s, angular momentum, N m s. */
enum { BODY_X, BODY_Q = 3, BODY_ANGLE = 7, BODY_P, BODY_L = 11, BODY_STATE = 14 };
/* It does not rotate; about one fixed axis; freely. */
enum body_rotation { TURNS_NOT, TURNS_AXIS, TURNS_FREE };

/* A body that forces move: its inertia, its constraints, its state and the forces of the last
 * stage. */
struct body_free {
    double mass;                         /* kg; 2D: kg/m */
    double inertia[3][3], inverse[3][3]; /* kg m^2 about the mass centre at the start */
    int locked;                          /* bits 1 << enum body_axis of what does not move */
    int rotation;                        /* enum body_rotation */
    double axis[3], J;                   /* TURNS_AXIS: unit axis, inertia about it */
    bool hinged, slides, held;           /* held: before release */
    double hinge[3], arm[3], slide[3];   /* point of the hinge, centre from it at the start */
    /* State in a stage, at the step's start, weighted sum of the rates, rate. */
    double y[BODY_STATE], y0[BODY_STATE], sum[BODY_STATE], rate[BODY_STATE];
    double force[6]; /* N, N m: of the fluid in the last stage, centre */
    double tension[LINES_MAX], slack[LINES_MAX]; /* N, m: of lines; length without force */
    double contact[3];                           /* N: force of contact in the last stage */
    double stiffness, damping;                   /* N/m, N s/m: of contact */
    /* 1/s: largest rate at which the fluid's impedance brakes it; it bounds the step. */
    double lambda;
    double impulse[2][3]; /* N s: of the fluid by either rule; of |F| in size */
    double size;          /* N s: integral of |F| over the run */
};

/* --- body_bend.c: a body in the plane whose outline another program bends --- */

/* What the points of an outline bear, per metre: N in the stage under way and N s in the step, of
 * this level and rank; N s in the coupling step and N of the pressure that the particles leave out,
 * of all ranks. */
enum bend_load { BEND_STAGE, BEND_STEP, BEND_WINDOW, BEND_REFERENCE, BEND_LOADS };

/* Its n points where they are now, and their loads. */
struct body_bend {
    int n;
    double (*x)[2], (*u)[2], (*du)[2]; /* m, m/s, m/s^2 */
    double (*load[BEND_LOADS])[2];
};

/* One body. */
struct body {
    const struct scene_body *is; /* its keys; borrowed */
    /* 3D: its surface as the case places it, normals into it; borrowed. */
    const struct trimesh *mesh;
    int dim;
    double centre[3]; /* m: of rotation and moments at the start */
    double middle[3]; /* m: centre of its bounding box at the start */
    double half[3];   /* m: half of the sides of that box */
    bool moves;       /* whether it ever moves */
    double reach;     /* m: of the farthest point from it */
    double volume;    /* m^3; 2D: m^2 */
    int first, n;     /* 2D: its segments in struct walls */
    struct body_drive drive;
    struct scene_contact contact;
    struct body_free *free;     /* NULL: driven */
    struct paddle *paddle;      /* NULL: it does not absorb waves */
    struct body_course *course; /* that a partner gives; NULL: none moves it */
    struct body_bend *bend;     /* NULL: it is rigid */
    struct body_motion now;     /* its motion at the time of the last body_move */
};

/* Mass, centre, m, and inertia about it as the case has them. body_mass_of returns false if they
 * are impossible, and why[size] says why. mesh: NULL in 2D. */
struct body_mass {
    double mass, centre[3], inertia[3][3]; /* kg, m, kg m^2; in 2D per metre */
};
bool body_mass_of(const struct scene_body *is, const struct trimesh *mesh, int dim,
                  struct body_mass *m, char *why, size_t size);
/* Volume that its surface encloses, m^3; 2D: m^2. */
double body_volume_of(const struct scene_body *is, const struct trimesh *mesh);
/* Sets *b: its drive, and for a free body its state at the start. is, mesh and files are
 * borrowed. */
void body_create(struct body *b, const struct scene_body *is, const struct trimesh *mesh, int dim,
                 struct motion_files *files);
/* Frees what body_create allocated. */
void body_destroy(struct body *b);
/* Sets whether a free body is held at time t, s (key release). */
void body_hold(struct body *b, double t);
/* Sets b->now from the drive or the state at time t, s. */
void body_move(struct body *b, double t);
/* Where the point that is at `from' at the start is now, m. */
void body_place(const struct body *b, const double *from, double *to);
/* Where corner i of its outline, in 3D vertex i of its mesh, is now, m. */
void body_corner(const struct body *b, int i, double *to);
int body_corners(const struct body *b);
/* Velocity of its material point at `at' now, m/s; of one that bends on its outline. */
void body_velocity(const struct body *b, const double *at, double *u);
/* Largest speed of any of its points now, m/s. */
double body_speed(const struct body *b);
/* Sets the rates of a free body's state from the force F, N, and the moment T about the centre, N
 * m, of all that acts on it, weight included. */
void body_rates(struct body *b, const double F[3], const double T[3]);
/* Applies an impulse, N s, and its moment about the centre, N m s, at once. */
void body_hit(struct body *b, const double impulse[3], const double moment[3]);
/* Normalises the quaternion of a free body after a step. */
void body_finish(struct body *b);
/* Kinetic and potential energy of a free body in gravity g, m/s^2; J. *kinetic is the former. */
double body_energy(const struct body *b, const double g[3], double *kinetic);
/* Effective mass of a body against a force along the unit vector n at the arm r, m, from its
 * centre: 1/(n.M^-1 n), kg; INFINITY: it is not free. */
double body_effective_mass(const struct body *b, const double *r, const double *n);

/* At rest, as the case has it, with n points. Owned by the caller. */
struct body_bend *body_bend_create(const struct scene_body *is);
/* Sets its points to time t, s. */
void body_bend_move(struct body *b, double t);
/* Velocity and acceleration (NULL: not wanted), m/s and m/s^2, on the piece from point k to the
 * next, `share' of the way. */
void body_bend_velocity(const struct body_bend *bend, int k, double share, double *u, double *du);
/* Adds the force f[2] at x, m, to a load of the points of the piece that is nearest, so that the
 * sum stays f. */
void body_bend_load(const struct body_bend *bend, const double *x, const double *f,
                    enum bend_load which);
/* Zeroes a load; adds `factor' times a load `of' another bend (or the same) with as many points. */
void body_bend_clear(const struct body_bend *bend, enum bend_load which);
void body_bend_add(const struct body_bend *bend, enum bend_load to, double factor,
                   const struct body_bend *from, enum bend_load of);
/* Power of the loads of the stage, W/m. */
double body_bend_power(const struct body_bend *bend);

#endif

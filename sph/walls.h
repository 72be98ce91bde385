/* walls.h - what bounds the fluid: polylines in the plane, sides of the domain, bodies that move as
 * told; and what a treatment of walls provides. n is the unit normal out of the fluid everywhere;
 * the fluid lies on the left of a segment a -> b. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALLS_H
#define SPH_WALLS_H

#include "sph.h"

struct segment {
    double a[2], b[2]; /* m: ends now */
    double t[2], n[2]; /* unit tangent and normal */
    double length;     /* m */
    double u[2];       /* m/s: of a wall along itself (bodies: walls_velocity) */
    int body;          /* -1: at rest */
    bool no_slip;
};

/* A plane side of the domain, as mirrored ghosts need it. */
struct wall_plane {
    int axis, sign; /* n = sign e_axis */
    double at;      /* m */
    double u[3];    /* m/s along itself */
    bool no_slip;
};

/* Place and velocity of a body, relative to its start. */
struct body_motion {
    double x[2], angle;  /* m, rad: displacement of the centre, rotation */
    double u[2], spin;   /* m/s, rad/s */
    double du[2], dspin; /* m/s^2, rad/s^2 */
};

struct body {
    const struct scene_body *is;
    int first, n; /* its segments */
    int nrows;    /* of the motion file: t, x, y, angle */
    double *rows;
    struct body_motion now;
};

/* One way to make walls felt by particles, picked by name. What it does not need is NULL. */
struct walls;
struct wall_model {
    const char *name;
    void *(*create)(struct sph *s);
    void (*destroy)(void *m);
    void (*ghosts)(struct sph *s); /* once a step, after the halo: adds ghosts */
    void (*list)(struct sph *s);   /* once a step, after the list of pairs */
    void (*lines)(struct sph *s);  /* each stage: lines of the ghosts, before the first pass */
    void (*slopes)(struct sph *s); /* each stage: after the first pass, before its halo */
    void (*ghost_slopes)(struct sph *s); /* after the halo of slopes */
    void (*rates)(struct sph *s);        /* after the second pass */
    /* Adds wall terms to M[n][dim^2] and sum w gradW, g[n][dim], of the locals and divides both by
     * gamma [4.86-4.87]. */
    void (*moments)(struct sph *s, double *M, double *g);
    void (*gammas)(struct sph *s, double *gamma); /* Shepard factors of the locals near walls */
    int (*behind)(const struct sph *s, int *who); /* lists locals that are behind a wall */
};
extern const struct wall_model wall_ghost, wall_nfm;

/* What the fluid gives to each body, and last to the walls at rest; forces.h. */
struct wall_forces {
    double stage[BODIES_MAX + 1][3];   /* N/m, N/m, N: in the stage under way; this rank */
    double step[BODIES_MAX + 1][3];    /* N s/m, N s/m, N s: in the step under way; this rank */
    double now[BODIES_MAX + 1][3];     /* N/m, N/m, N: mean over the last step; all ranks */
    double impulse[BODIES_MAX + 1][3]; /* N s/m, ..: since the start; all ranks */
    bool credited, known;              /* the model tells; a step is over */
};

struct walls {
    int nsegments;
    struct segment *segments, *start; /* now; at t = 0 */
    int nplanes;
    struct wall_plane planes[6];
    int nbodies;
    struct body bodies[BODIES_MAX];
    double t; /* s: of `segments' */
    const struct wall_model *model;
    void *state;  /* of the model */
    double speed; /* m/s: largest of a wall */
    struct wall_forces forces;
    int64_t returned; /* particles found behind walls and put back; this rank */
};

/* NULL: the scene has no walls. Needs s->domain. */
struct walls *walls_create(struct sph *s);
void walls_free(struct walls **w);
/* Segments and bodies at time t. */
void walls_move(struct sph *s, double t);
/* Velocity and acceleration of a segment's material point x, m/s and m/s^2 (du may be NULL). */
void walls_velocity(const struct walls *w, const struct segment *g, const double *x, double *u,
                    double *du);
/* The nearest of the segments that were added, negative behind it; at a corner, of two that are
 * equally near, the one whose plane is farther. */
struct wall_side {
    double distance, least, sure;
};
struct wall_side wall_side_none(double reach);
void wall_side_add(struct wall_side *to, const struct segment *g, const double *x);
/* Distance of x to the nearest wall, negative behind it; at least -reach, at most reach. */
double walls_distance(const struct walls *w, const double *x, double reach);
/* Nearest point of the walls to x; returns its segment. */
int walls_nearest(const struct walls *w, const double *x, double *foot);
/* Puts local particle i, found behind a wall, back to 0.05 dx before it, without the velocity that
 * led there; false if it is farther than dx behind. */
bool walls_put_back(struct sph *s, int i);
/* The same for all locals beyond a side that is a wall. */
void walls_put_back_inside(struct sph *s);
/* ALE near walls: dividing pair fluxes by gamma, or ghosts with the weight of a still column, take
 * from them their antisymmetry. What mass they so make or lose is given back to the particles
 * who[n] (NULL: all) in proportion to theirs. Collective. */
void walls_keep_mass(struct sph *s, int n, const int *who);
/* Motion of a body at time t; place of a point of it, at `from' at t = 0, under b->now. */
struct body_motion walls_motion(const struct body *b, double t);
void walls_place(const struct body *b, const double *from, double *to);
/* Motion file of a body: rows of four numbers, times rising. -1: no such file, 0: bad rows. */
int walls_read_motion(const char *path, double **rows);

#endif

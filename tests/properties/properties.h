/* properties.h - a random scene, how it turns, moves and changes its units, and how it is written.
 * tests/properties/run tries the laws. SPDX-License-Identifier: BSD-3-Clause */
#ifndef TESTS_PROPERTIES_H
#define TESTS_PROPERTIES_H

#include <stdbool.h>
#include <stdio.h>

enum { POINTS = 64, LISTS = 4, BLOCKS = 4, TEXT = 200 };
enum program { SPH, FV, COUPLED };

struct side {         /* of the domain: x_min, x_max, y_min, ... */
    const char *kind; /* NULL: none */
    const char *profile;
    double velocity[3], pressure;
    bool carried;
};

struct outline { /* polyline, body, polygon */
    int n;
    double x[POINTS][3];
};

struct wall { /* a polyline */
    struct outline line;
    bool closed;
    const char *kind;
};

struct body {
    struct outline line; /* or corners of triangles */
    const char *kind;
    double centre[3], velocity[3], spin;
    double turning[3]; /* spin in space */
    bool free;
    double density;
    bool stl, thin; /* its mesh, else obj; its key */
    int ntriangles, triangle[12][3];
};

struct shape {
    const char *form;
    struct outline line; /* corners of a box, of a polygon, centre of a disc */
    double radius, level, velocity[3];
    bool hole;
};

struct region { /* of refinement: a box, with a radius a sphere about lo, with an offset around body
                   0 */
    int level;
    double lo[3], hi[3], radius, offset, velocity[3];
};

struct probe {
    const char *kind;
    double at[3];
};

struct block {
    const char *mapping, *sides[6], *lid;
    int cells[3];
    double lo[3], hi[3], centre[3], focus[3], stretch[3], velocity[3], radius[2], spin[2];
    double angle, shear, wave;
};

struct scene {
    enum program program;
    int dim;
    double end; /* s */
    double lo[3], hi[3];
    bool periodic[3];
    double rho, nu, g[3], central;
    const char *field;
    double U, L, V[3], amplitude, level; /* level < -1e29: not given */
    bool say_U;                          /* or leave the default */
    struct side sides[6];
    int nwalls, nbodies, nshapes, nprobes, nblocks, nregions;
    struct region regions[LISTS];
    const char *criterion; /* of refinement, level 1; NULL: none */
    double bound;          /* of it */
    bool local_steps;
    struct wall walls[LISTS];
    struct body bodies[LISTS];
    struct shape shapes[LISTS];
    struct probe probes[LISTS];
    struct block blocks[BLOCKS];
    double dx, c0; /* m, m/s; c0 0: default */
    bool even;     /* a lattice without noise at the start */
    const char *sph_more, *fv_more;
    double box[2][3]; /* m: SPH's part of a coupled job */
    int cells[3];
    double graded[2], overlap, hole[2][3];
    int steps; /* of a window */
    int ranks; /* of a solver alone */
    /* what the laws need to know */
    const char *family;
    double speed, length; /* scales */
    bool standard;        /* all settings that could make it unstable are the defaults */
    bool closed;          /* nothing flows in or out */
    bool open_above;      /* but what splashes over the sides */
    bool unforced;        /* no work is done on the fluid */
    bool free_of_walls;   /* momentum changes by gravity alone */
    bool still;           /* must stay at rest */
    bool stream;          /* a uniform stream, which stays */
    double error;         /* most that error.velocity_l2 may be; 0: no law */
    bool mirrors, turns, turns_half, cycles, shifts, shifts_by_L, carried;
    double mass; /* kg; for kinetic energies */
};

/* x' = M x + t, M a signed permutation: axis a goes to axis[a], times sign[a]. */
struct motion {
    int axis[3];
    double sign[3], t[3];
};

void scene_move(struct scene *s, const struct motion *m);
void scene_scale(struct scene *s, double length, double speed, double density);
/* Meshes are beside the case, which has a name. */
void scene_write(const struct scene *s, const char *name, FILE *f);
void scene_write_meshes(const struct scene *s, const char *dir, const char *name);
/* Turns an outline round. */
void make_reverse(struct outline *o);

#endif

/* walls.h - what bounds the fluid: polylines in the plane, sides of the domain, bodies that move as
 * told; and what a treatment of walls provides. n is the unit normal out of the fluid everywhere;
 * the fluid lies on the left of a segment a -> b. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALLS_H
#define SPH_WALLS_H

#include "../../common/geometry/tree.h"
#include "../rigid/body.h"
#include "../sph.h"

struct segment {
    double a[2], b[2]; /* m: ends now */
    double t[2], n[2]; /* unit tangent and normal */
    double length;     /* m */
    double u[2];       /* m/s: of a wall along itself (bodies: walls_velocity) */
    int body;          /* -1: at rest */
    bool no_slip;
    double friction; /* -: c_f of quadratic bed friction */
    bool open[2];    /* a, b end where no wall goes on: beyond them nothing is behind it */
    bool beyond;     /* its wall has been prolonged across a periodic side */
    int of;          /* across a period: the segment that it is the image of; -1: it is itself */
    double shift[2]; /* m: from that to the image */
};

/* A plane side of the domain, as mirrored ghosts need it. */
struct wall_plane {
    int axis, sign; /* n = sign e_axis */
    double at;      /* m */
    double u[3];    /* m/s along itself */
    bool no_slip;
};

/* A surface of triangles in 3D: of a file, or sides of the domain that are alike. The mesh lies in
 * a frame of its own, x = X + Q own, so that bodies move without touching it. */
struct wall_mesh {
    struct trimesh mesh; /* normals out of the fluid */
    struct tree *tree;
    int *plane;                  /* [ntriangles] the same of neighbours in one plane; NULL: thin */
    bool lent;                   /* mesh and tree belong to the scene */
    const struct scene_mesh *of; /* of a file; NULL: sides */
    int body;                    /* -1: at rest */
    bool no_slip;
    double friction;      /* -: c_f of quadratic bed friction */
    bool thin;            /* fluid on either side does not see that on the other */
    double u[3];          /* m/s: of a wall along itself (bodies: wall_mesh_velocity) */
    double X[3], Q[3][3]; /* m, -: pose now */
    bool image;           /* of a body across a period, */
    double shift[3];      /* m: that far from it */
};

/* One way to make walls act on particles, picked by name. What it does not need is NULL. */
struct walls;
struct wall_model {
    const char *name;
    void *(*create)(struct sph *s);
    void (*destroy)(void *m);
    void (*ghosts)(struct sph *s); /* once a step, after the halo: adds ghosts */
    void (*list)(struct sph *s);   /* once a step, after the list of pairs */
    void (*lines)(struct sph *s);  /* each stage: lines of the ghosts, before the first pass */
    void (*slopes)(struct sph *s); /* each stage: after the first pass, before its halo */
    void (*bound_shifts)(struct sph *s); /* the same, after transport_finish */
    void (*ghost_slopes)(struct sph *s); /* after the halo of slopes */
    void (*rates)(struct sph *s);        /* after the second pass */
    /* Adds wall terms to M[n][dim^2] and sum w gradW, g[n][dim], of the locals and divides both by
     * gamma [4.86-4.87]. */
    void (*moments)(struct sph *s, double *M, double *g);
    void (*gammas)(struct sph *s, double *gamma); /* Shepard factors of the locals near walls */
    void (*rooms)(struct sph *s, double *room); /* takes from sum w W over that of a lattice, of the
                                                   locals, what walls keep out; after moments */
    void (*back)(struct sph *s); /* puts those back that have gone through thin walls */
    int (*behind)(const struct sph *s, int *who); /* lists locals that are behind a wall */
};
extern const struct wall_model wall_fixed, wall_ghost, wall_nfm;

/* Force and moment, N and N m, or impulses; in 2D of a metre along z, with M[2] alone. */
struct force {
    double F[3], M[3];
};

/* What the fluid gives to each body, and last to the walls at rest; forces.h. */
struct wall_forces {
    struct force stage[BODIES_MAX + 1];   /* in the stage under way; this rank */
    struct force step[BODIES_MAX + 1];    /* impulses in the step under way; this rank */
    struct force now[BODIES_MAX + 1];     /* mean over the last step; all ranks */
    struct force impulse[BODIES_MAX + 1]; /* since the start; all ranks */
    struct force hit[BODIES_MAX + 1];     /* impulses of particles returned in this step */
    struct force reference[BODIES_MAX];   /* N: on each body, of the pressure that particles leave
                                             out; all ranks have it */
    bool credited, known;                 /* the model tells; a step is over */
};

struct walls {
    int nsegments;
    struct segment *segments, *start; /* now; at t = 0; images across periods stand last */
    int nplanes;
    struct wall_plane planes[6];
    int nmeshes; /* 3D */
    struct wall_mesh *meshes;
    int nbodies;
    struct body bodies[BODIES_MAX];
    double middle[BODIES_MAX][3]; /* m: of each body now */
    bool any_free;                /* some body moves by forces */
    bool any_open;                /* 2D: some line ends in the open */
    bool lent;   /* the state of free bodies is that of the coarser level's walls */
    bool placed; /* all have been moved to their places once */
    double t;    /* s: of `segments' */
    const struct wall_model *model;
    void *state;  /* of the model */
    bool *beside; /* [n] supports of the locals that meet a wall; NULL: the model does not tell */
    int beside_capacity;
    double speed;      /* m/s: largest of a body in the next step, a tenth more */
    double dt_contact; /* s: step that contact is made for */
    double approach[BODIES_MAX][BODIES_MAX + 1];  /* m/s: at the first touch of a pair, last: walls
                                                     at rest; 0: apart */
    double start_gap[BODIES_MAX][BODIES_MAX + 1]; /* m: contact of a pair that has not parted since
                                                     the start begins here; INFINITY: it has */
    struct wall_forces forces;
    bool shown;        /* NAME_walls.h5 is written; wall_files.h */
    struct xdmf *view; /* its XDMF file; rank 0 */
    int64_t returned;  /* particles found behind walls and returned; this rank */
    int64_t gone;      /* the same, too far behind or round an open end, and removed */
    double gone_at[3]; /* m: where the first of them was */
};

/* Whether what stands between lo and hi along an axis is to have an image one period further on
 * (way 1) or back (-1): near the other side, or as it moves. */
bool walls_want_image(const struct sph *s, bool moves, double lo, double hi, int axis, int way);

/* NULL: the scene has no walls. Needs s->domain. */
struct walls *walls_create(struct sph *s);
void walls_free(struct walls **w);
/* Segments and bodies at time t. */
void walls_move(struct sph *s, double t);
/* Sets `speed' by what bodies have at s->t, who are moved there; those released are free. */
void walls_expect_speed(struct sph *s);
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
/* A point of a wall, its normal and velocity. */
struct wall_foot {
    double x[3], n[3], u[3]; /* m, -, m/s */
    int body;
};
/* Distance of x to the nearest wall, negative behind it; at least -reach, at most reach; if less,
 * the way to its nearest point. */
double walls_way(const struct sph *s, const double *x, double reach, double *way);
/* Share of the way d from x at which it first meets a wall; 1: it meets none. */
double walls_meet(const struct sph *s, const double *x, const double *d);
/* Puts local particle i back to 0.05 dx before f, without the velocity that led there. */
void walls_put_before(struct sph *s, int i, const struct wall_foot *f);
/* Puts local particle i, found behind a wall, back to 0.05 dx before it, without the velocity that
 * led there; false, and counted, if it is farther than dx behind, or has come round an open end. */
bool walls_put_back(struct sph *s, int i);
/* The same for all locals beyond a side that is a wall. */
void walls_put_back_inside(struct sph *s);
/* What walls leave of the locals' supports: sum w W over that of a lattice, [n], to be freed; 1 for
 * all where the model of walls does not tell. After moments. */
double *walls_rooms(struct sph *s);
/* ALE near walls: dividing pair fluxes by gamma, or ghosts with the weight of a still column, take
 * from them their antisymmetry. What mass they so make or lose is given back to the particles
 * who[n] (NULL: all) in proportion to theirs. Collective. */
void walls_keep_mass(struct sph *s, int n, const int *who);
/* wall_ghost.c: the line that is mirrored to line i, an earlier one; -1: i is no mirror image. */
int walls_mirrored(const struct sph *s, int i);
/* wall_mesh.c: meshes of the scene, and those of sides that are walls. */
void wall_meshes_create(struct sph *s, struct walls *w);
void wall_meshes_free(struct walls *w);
/* Poses of the meshes of bodies as these are now. */
void wall_meshes_move(struct walls *w);
/* A point of the world in the mesh's frame, and back; vectors are turned alone. */
void wall_mesh_to_own(const struct wall_mesh *m, const double *x, double *own);
void wall_mesh_to_world(const struct wall_mesh *m, const double *own, double *x);
void wall_mesh_turn_to_own(const struct wall_mesh *m, const double *v, double *own);
void wall_mesh_turn_to_world(const struct wall_mesh *m, const double *own, double *v);
/* Velocity and acceleration (NULL: not wanted) of its material point x, m/s and m/s^2. */
void wall_mesh_velocity(const struct walls *w, const struct wall_mesh *m, const double *x,
                        double *u, double *du);
/* Nearest point of all meshes to x within reach, in the world's frame; mesh: which, -1: none. Of
 * two equally near the one whose side is known. */
struct tree_foot wall_meshes_nearest(const struct walls *w, const double *x, double reach,
                                     int *mesh);
/* Where the centre of a body is now, m. */
static inline double body_centre(const struct body *b, int axis)
{
    return b->centre[axis] + b->now.x[axis];
}

#endif

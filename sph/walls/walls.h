/* walls.h - what bounds the fluid: polylines in the plane, meshes in 3D, sides of the domain,
 * bodies that are driven or moved by forces; and what a treatment of walls provides. n is the unit
 * normal out of the fluid everywhere; the fluid lies on the left of a segment a -> b. Every rank
 * holds all walls in the same state; lists and forces of a stage are those of a rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALLS_H
#define SPH_WALLS_H

#include "../../common/geometry/geometry.h"
#include "../rigid/sph_rigid.h"
#include "../sph.h"

/* A straight piece of wall in the plane. */
struct segment {
    double a[2], b[2]; /* m: ends now */
    double t[2], n[2]; /* unit tangent and normal */
    double length;     /* m */
    double u[2];       /* m/s: of a wall that slides along itself (bodies: walls_velocity) */
    int body;          /* -1: at rest */
    int point;         /* of a body that bends: the point of its outline at a */
    bool no_slip;      /* else a slip wall */
    double friction;   /* -: c_f of a slip wall's quadratic bed friction */
    bool open[2];      /* a, b: an end where no wall goes on, so that nothing is behind it there */
    bool beyond;       /* its wall has been prolonged across a periodic side */
    int of;            /* across a period: the segment that it is the image of; -1: it is itself */
    double shift[2];   /* m: from that to the image */
};

/* As x sees a segment: how high it lies along its normal, and how far along it its end a lies, m.
 */
static inline void segment_seen(const struct segment *g, const double *x, double *height,
                                double *begin)
{
    const double d[2] = {g->a[0] - x[0], g->a[1] - x[1]};
    *height = g->n[0] * d[0] + g->n[1] * d[1];
    *begin = g->t[0] * d[0] + g->t[1] * d[1];
}

/* A plane side of the domain, as mirrored ghosts need it. */
struct wall_plane {
    int axis, sign; /* n = sign e_axis */
    double at;      /* m */
    double u[3];    /* m/s along itself */
    bool no_slip;
};

/* A surface of triangles in 3D: of a file, or sides of the domain that are of one kind. The mesh
 * lies in a frame of its own, x = X + Q own, so that a body moves without its vertices being
 * touched. */
struct wall_mesh {
    struct trimesh mesh;         /* normals out of the fluid */
    struct tree *tree;           /* over its triangles */
    int *plane;                  /* [ntriangles] the same of neighbours in one plane; NULL: thin */
    bool lent;                   /* mesh and tree belong to the scene */
    const struct scene_mesh *of; /* of a file; NULL: sides */
    int body;                    /* -1: at rest */
    bool no_slip;
    double friction;      /* -: c_f of quadratic bed friction */
    bool thin;            /* fluid on one side does not interact with that on the other */
    double u[3];          /* m/s: of a wall along itself (bodies: wall_mesh_velocity) */
    double X[3], Q[3][3]; /* m, -: pose now */
    bool image;           /* it is the image of a body across a period, */
    double shift[3];      /* m: that far from it */
};

/* One way to make walls act on particles, picked by name. The functions are called at the points of
 * a step that their comments say, in this order; what a model does not need is NULL. */
struct wall_model {
    const char *name;               /* as in the case: "nfm" */
    void *(*create)(struct sph *s); /* the model's state; walls and particles are there */
    void (*ghosts)(struct sph *s);  /* once a step, after the halo: adds ghosts */
    void (*list)(struct sph *s);    /* once a step, after the list of pairs */
    void (*lines)(struct sph *s);   /* each stage: lines of the ghosts, before the first pass */
    void (*slopes)(struct sph *s);  /* each stage: after the first pass, before its halo */
    void (*bound_shifts)(struct sph *s); /* the same, after transport_finish */
    void (*ghost_slopes)(struct sph *s); /* after the halo of slopes */
    void (*rates)(struct sph *s);        /* after the second pass */
    /* With levels, once a list, after slopes: sets who[n] of those whose rates `rates' reads to
     * tell what pushes the walls; NULL: it reads none. */
    void (*pushing)(struct sph *s, bool *who);
    /* Adds wall terms to M[n][dim^2] and sum w gradW, g[n][dim], of the locals and divides both by
     * gamma [4.86-4.87]. */
    void (*moments)(struct sph *s, double *M, double *g);
    void (*gammas)(struct sph *s, double *gamma); /* Shepard factors of the locals near walls */
    void (*rooms)(struct sph *s, double *room); /* takes from sum w W over that of a lattice, of the
                                                   locals, what walls keep out; after moments */
    void (*back)(struct sph *s); /* puts those back that have gone through thin walls */
    int (*behind)(
        const struct sph *s,
        int *who); /* lists locals that are behind a wall into who[n]; returns their number */
};
/* Fixed ghosts (Marrone), mirrored ghosts, normal fluxes (Chiron 2017, chapter 4). */
extern const struct wall_model wall_fixed, wall_ghost, wall_nfm;

/* Force, N, and moment, N m, or impulses of both; in 2D per metre along z, with M[2] alone. */
struct force {
    double F[3], M[3];
};

/* A sharp corner in contact, by pair (second -1: walls at rest), whose it is, of and corner
 * (body_touch.h); the distance at which its contact begins now, and at first, m. */
struct contact_place {
    double id[5], from, first;
};

/* What the fluid exerts on each body, and last on the walls at rest; forces.h. */
struct wall_forces {
    struct force stage[BODIES_MAX + 1];   /* in the stage under way; this rank */
    struct force step[BODIES_MAX + 1];    /* impulses in the step under way; this rank */
    struct force now[BODIES_MAX + 1];     /* mean over the last step; all ranks */
    struct force impulse[BODIES_MAX + 1]; /* since the start; all ranks */
    struct force hit[BODIES_MAX + 1];     /* impulses of particles returned in this step */
    struct force reference[BODIES_MAX];   /* N: on each body, of the pressure that particles leave
                                             out; all ranks have it */
    bool credited, known;                 /* the model reports forces; a step has been completed */
};

struct seal_rest;
struct shut_water;
enum { SHUT_WATERS_MAX = 16 };
struct wall_joints;
/* All walls of a run; made by walls_create. */
struct walls {
    int nsegments;
    struct segment *segments, *start; /* now; at t = 0; images across periods stand last */
    int nplanes;
    struct wall_plane planes[6]; /* sides of the domain, for mirrored ghosts */
    int nmeshes;                 /* 3D */
    struct wall_mesh *meshes;    /* of the scene, then their images across periods */
    int nbodies;
    struct body bodies[BODIES_MAX]; /* those of the scene, in its order */
    double middle[BODIES_MAX][3];   /* m: of each body now */
    bool any_free;                  /* some body moves by forces */
    bool any_open;                  /* 2D: some line ends in the open */
    bool lent;   /* the state of free bodies is that of the coarser level's walls */
    bool placed; /* all have been moved to their places once */
    double t;    /* s: of `segments' */
    const struct wall_model *model; /* borrowed for ever */
    void *state;                    /* of the model */
    /* [n] whether a local's support meets a wall; NULL: the model does not report it. */
    bool *beside;
    /* [n] 0: farther than R from a free surface; borrowed of the present list's surface. NULL: not
     * known. */
    const unsigned char *near_surface;
    double speed;      /* m/s: 1.1 times the largest speed of a body in the next step */
    double dt_contact; /* s: step that the contact force is dimensioned for */
    double approach[BODIES_MAX][BODIES_MAX + 1]; /* m/s: at the first touch of a pair, last: walls
                                                    at rest; 0: apart */
    struct pair_friction {
        double hold[3], more[3], most;      /* N: on the first; what a step adds; Coulomb's bound */
    } friction[BODIES_MAX][BODIES_MAX + 1]; /* of a pair in contact; body_contact.c */
    double start_gap[BODIES_MAX][BODIES_MAX + 1]; /* m: contact of a pair that has not parted since
                                                     the start begins here; INFINITY: it has */
    double start_way[BODIES_MAX]
                    [3]; /* of that with walls at rest the way out of them; 0: several */
    int nplaces;
    struct contact_place *places; /* of corners now in contact; bodies/contact_places.h */
    /* Of two owners, last walls at rest: what their faces owe each other is body_seal.c's, not
     * wall_gap.c's. */
    bool sealed[BODIES_MAX + 1][BODIES_MAX + 1];
    const struct wall_joints *joints; /* of the present list of the model; NULL: it has none */
    bool wedged[BODIES_MAX]; /* whether a body that stays stands too close to another for water */
    struct seal_rest *rest[BODIES_MAX]; /* body_seal.c: where solids are sealed, as last measured */
    int nshut;
    struct shut_water *shut[SHUT_WATERS_MAX]; /* bodies/shut_water.h; owned */
    struct wall_forces forces;
    bool shown;        /* NAME_walls.h5 is written; wall_files.h */
    struct xdmf *view; /* its XDMF file; rank 0 */
    int64_t returned;  /* particles, but guards, found behind walls and returned; this rank */
    int64_t gone;      /* the same, too far behind or round an open end, and removed */
    double gone_at[3]; /* m: where the first of those removed was */
};

/* Whether something between lo and hi along a periodic axis, m, needs an image one period further
 * on (way 1) or back (-1): it is near the other side, or it moves. */
bool walls_want_image(const struct sph *s, bool moves, double lo, double hi, int axis, int way);

/* The walls of level s at s->t; NULL: the scene has none. Needs s->domain. Owned by the caller
 * (FREE). */
struct walls *walls_create(struct sph *s);
/* Moves segments, meshes and bodies to time t, s. */
void walls_move(struct sph *s, double t);
/* Moves bodies to s->t, releases those whose time has come, and sets walls->speed. */
void walls_expect_speed(struct sph *s);
/* Velocity and acceleration of a segment's material point x, m/s and m/s^2 (du may be NULL). */
void walls_velocity(const struct walls *w, const struct segment *g, const double *x, double *u,
                    double *du);
/* The nearest of the segments that were added to it: signed distance to it, m, negative behind it.
 * At a corner, of two that are equally near, it is the one from whose line the point is farther. */
struct wall_side {
    double distance; /* m: signed */
    double least;    /* m: its size */
    double sure;     /* m: distance from the line of that segment */
};
/* No segment yet; distances beyond reach, m, do not count. */
struct wall_side wall_side_none(double reach);
/* Adds one segment for the point x. */
void wall_side_add(struct wall_side *to, const struct segment *g, const double *x);
/* Distance of x to the nearest wall, m, negative behind it, limited to -reach .. reach. */
double walls_distance(const struct walls *w, const double *x, double reach);
/* Sets foot to the nearest point of the walls to x and returns its segment. In 2D. */
int walls_nearest(const struct walls *w, const double *x, double *foot);
/* A point of a wall with its normal and velocity. */
struct wall_foot {
    double x[3], n[3], u[3]; /* m, -, m/s */
    int body;                /* -1: a wall at rest */
};
/* As walls_distance; if the wall is nearer than reach, `way' is the vector from x to its nearest
 * point, m. */
double walls_way(const struct sph *s, const double *x, double reach, double *way);
/* Fraction of the displacement d from x, m, at which it first meets a wall; 1: it meets none. */
double walls_meet(const struct sph *s, const double *x, const double *d);
/* Whether x, m, lies in a body, or an image of one; a tank has its water inside. Walls that a body
 * stands on may be nearer than its own faces, so that walls_distance does not tell. */
bool walls_in_body(const struct sph *s, const double *x);
/* Puts local particle i back to 0.05 dx before f and removes the velocity that led there. */
void walls_put_before(struct sph *s, int i, const struct wall_foot *f);
/* The same for local particle i found behind a wall. false, and counted in `gone', if it is farther
 * than dx behind, or has come round an open end. */
bool walls_put_back(struct sph *s, int i);
/* The same for all locals beyond a side of the region that is a wall. */
void walls_put_back_inside(struct sph *s);
/* What walls leave of the locals' supports: sum w W over that of a lattice, [n], owned by the
 * caller (mem_free); 1 for all where the model does not report it. After moments. */
double *walls_rooms(struct sph *s);
/* Riemann-ALE near walls: dividing pair fluxes by gamma, or ghosts with the weight of a hydrostatic
 * column, destroys their antisymmetry. The mass that is so `made' (kg/s, this rank) is given back
 * to the particles who[n] (NULL: the first n locals) in proportion to their masses, with its
 * momentum; guards and those whose mass is imposed take no part. Returns what share of theirs they
 * give back, 1/s. Collective. */
double walls_keep_mass(struct sph *s, double made, int n, const int *who);
/* The same where nothing but walls exchanges mass with the particles: what they make is the sum of
 * all rates. */
void walls_keep_mass_of_all(struct sph *s);
/* wall_ghost.c: the packed record that was mirrored to make record i, an earlier one; -1: i is no
 * mirror image. */
int walls_mirrored(const struct sph *s, int i);
/* wall_mesh.c: makes the meshes of the scene, and those of sides that are walls. */
void wall_meshes_create(struct sph *s, struct walls *w);
/* Frees them; what the scene has lent stays. */
void wall_meshes_free(struct walls *w);
/* Sets the poses of the meshes of bodies to where these are now. */
void wall_meshes_move(struct walls *w);
/* Transforms a point of the world to the mesh's frame, m. */
void wall_mesh_to_own(const struct wall_mesh *m, const double *x, double *own);
/* Transforms a point of the mesh's frame to the world, m. */
void wall_mesh_to_world(const struct wall_mesh *m, const double *own, double *x);
/* Rotates a vector of the world into the mesh's frame; one of the mesh's frame into the world. */
void wall_mesh_turn_to_own(const struct wall_mesh *m, const double *v, double *own);
void wall_mesh_turn_to_world(const struct wall_mesh *m, const double *own, double *v);
/* Velocity, m/s, and acceleration, m/s^2 (NULL: not wanted), of the mesh's material point x. */
void wall_mesh_velocity(const struct walls *w, const struct wall_mesh *m, const double *x,
                        double *u, double *du);
/* Whether some mesh is thin. */
bool walls_any_thin(const struct walls *w);
/* Nearest point of one mesh to a place in its own frame within reach, m, as tree_nearest has it;
 * open thin ones have fluid on both sides, and the place is before them. */
struct tree_foot wall_mesh_nearest(const struct wall_mesh *m, const double *own, double reach);
/* Nearest point of all meshes to x within reach, m, in the world's frame; *mesh: which one, -1:
 * none. Of two equally near ones it is the one whose side is known. */
struct tree_foot wall_meshes_nearest(const struct walls *w, const double *x, double reach,
                                     int *mesh);
/* Whether body_seal.c knows what the faces of two owners owe each other, on all levels. */
static inline bool walls_sealed(const struct sph *s, int a, int b)
{
    while (s->coarser)
        s = s->coarser;
    return s->walls->sealed[a < 0 ? BODIES_MAX : a][b < 0 ? BODIES_MAX : b];
}
/* dx: faces of two sealed owners closer than this are dry; of a free body, which may be lifted or
 * pressed in by its weight, none are. */
static inline double walls_shut(const struct walls *w, int a, int b)
{
    return (a >= 0 && w->bodies[a].free) || (b >= 0 && w->bodies[b].free) ? -INFINITY : 0.001;
}
/* Coordinate of the centre of a body now, m. */
static inline double body_centre(const struct body *b, int axis)
{
    return b->centre[axis] + b->now.x[axis];
}

#endif

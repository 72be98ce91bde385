/* wall_list.h - particles near walls, the pieces of wall near each (segments in 2D, triangles in
 * 3D), and the integrals of the particle's kernel over each piece. The list is made once a step,
 * its integrals once a stage, for all who ask. Whoever sums over touches need not know what a piece
 * is. Local to the rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_LIST_H
#define SPH_WALL_LIST_H

#include "facet.h"
#include "wall_joint.h"
#include "walls.h"

/* One piece of wall near one particle. */
struct wall_touch {
    struct wall_integrals is; /* W = 0: beyond the support; e divided by W: m, from the particle to
                                 the centre of that weight */
    double n[3];
    double height, distance; /* m: over the plane of the piece, from the piece or those joined */
    double near;             /* -: min(1, (dx/2)^2/e^2) */
    int piece, of;           /* 2D: segment, of which `cut' of the list, -1: all of it; 3D: place in
                                the frames of mesh `of' */
    int plane;               /* pieces of `of' alike in it have one flux; -1: this one alone */
    int body;                /* -1: at rest */
    double friction;         /* -: c_f of quadratic bed friction */
    bool no_slip, foot;      /* foot: that of the particle lies on the piece */
    int on; /* lies on the face of another owner, counted from the particle's first, and is that
               owner's: see own_covered; -1: on none */
    bool joined; /* with an earlier one of its plane, which has its integrals */
};

/* A triangle near some particles, in 3D. */
struct wall_near {
    int mesh, facet;
};

struct thin_piece; /* wall_thin3.c */

/* The list. Zeroed memory with an owner is empty. */
struct wall_list {
    void *owner; /* a block, of all arrays here */
    int n;
    int *who, *first;         /* [n] locals near walls; [n+1] the first touch of each */
    struct wall_touch *touch; /* [first[n]] */
    double *gamma;            /* [n] Shepard factor */
    bool measured;            /* touch and gamma belong to the present positions */
    double (*boxes)[4];       /* 2D: around groups of segments: low x, y, high x, y */
    /* 2D, where walls touch: points that part the fluid, which particles are beside one [n, NULL:
     * there are none], parts of segments that they see, m along these */
    struct wall_joints joints;
    int ncuts;
    bool *parted;
    double (*cut)[2];
    /* 3D: triangles that were seen, by mesh; what a tree found; what is near a group */
    int found_capacity;
    struct wall_frames *of3;
    int *found;
    struct wall_near *near;
    /* Thin walls in 3D, open ends in 2D: what closes the sums at rims, m^-1. 3D: places at the last
     * list and its time */
    double (*rim)[3], (*seen_from)[3], listed_at;
    struct thin_piece *piece; /* of the particle at hand, beside thin walls */
    double *shown;
    double *share; /* see wall_list_shares */
    struct wall_integrals *asked;
};

/* Its weight, m^(1-dim), negative where it lies on the face of another owner: as part of that face
 * it takes away what is covered. */
static inline double wall_touch_counts(const struct wall_touch *t)
{
    return t->on < 0 ? t->is.W : -t->is.W;
}

/* Lists the particles that can come within R of a wall in the step, with the pieces near each. */
void wall_list_build(const struct sph *s, struct wall_list *l);
/* Computes touch and gamma at the present positions of particles and walls, once a stage. */
void wall_list_measure(const struct sph *s, struct wall_list *l);
/* Sums for the Shepard factor above this are of places behind a wall, which have one more: not by
 * the last digits, nor by what points miss of it. */
static inline double wall_list_behind_from(const struct sph *s)
{
    return s->prm.wall_integrals == INTEGRALS_NUMERICAL ? 1.25 : 1.0 + 1e-6;
}
/* Lists locals whose state is behind the nearest wall into who[n]; returns their number. */
int wall_list_behind(const struct sph *s, const struct wall_list *l, int *who);
/* Integral of W over the piece of a touch with another support R, m, for a particle at x;
 * m^(1-dim). */
double wall_list_weight(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                        const double *x, double R);
/* Parts of the Shepard factor at a point x of the face `face' near particle k, one for each of its
 * touches from first[k] on; NULL: no face of another owner, not sealed with it, reaches there. Only
 * their sum counts of the face's own owner. Valid until the next call. */
const double *wall_list_shares(const struct sph *s, struct wall_list *l, int k, int face,
                               const double *x);
/* Points y of the plane's part of a touch within R of x, with their shares of its weight W, which
 * sum to 1; returns how many. In 2D. */
enum { FACE_POINTS = 4 };
int wall_list_points(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                     const double *x, double (*y)[3], double *share);
/* Velocity of the wall's material point x, m/s. */
void wall_list_velocity(const struct sph *s, const struct wall_touch *t, const double *x,
                        double *u);

/* Whether the k-th particle of the list, beside a joint, is now behind the faces of its own fluid;
 * f: where it came through. */
bool wall_list_strayed(const struct sph *s, const struct wall_list *l, int k, struct wall_foot *f);

/* --- of wall_list.c and wall_list3.c --- */

/* Removes from the k-th particle's row of the list of pairs those that `sees' says it does not
 * interact with. */
typedef bool wall_sees(const struct sph *s, const struct wall_list *l, int k, const double *x);
void wall_list_cut_row(const struct sph *s, const struct wall_list *l, int k, wall_sees *sees);

/* Makes room for one particle more with so many touches. */
void wall_list_room(struct wall_list *l, int touches);
void wall_list3_build(const struct sph *s, struct wall_list *l);
void wall_list3_measure(const struct sph *s, struct wall_list *l);
int wall_list3_behind(const struct sph *s, const struct wall_list *l, int *who);
double wall_list3_weight(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                         const double *x, double R);
/* Whether the touch's triangle is nearer than R, m, to x. */
bool wall_list3_reaches(const struct sph *s, const struct wall_list *l, const struct wall_touch *t,
                        const double *x);
void wall_list3_shares(const struct sph *s, struct wall_list *l, int k, int face, const double *x);
double wall_list3_nearest(const struct sph *s, const struct wall_list *l,
                          const struct wall_touch *t, const double *x, double *foot);
/* The triangle of a touch in the frame of its mesh; its number there; a point in that frame. */
const struct facet *wall_list3_facet(const struct wall_list *l, const struct wall_touch *t);
int wall_list3_triangle(const struct wall_list *l, const struct wall_touch *t);
void wall_list3_to_own(const struct sph *s, const struct wall_touch *t, const double *x,
                       double *own);

/* --- wall_thin3.c --- */

/* Removes pairs from the list that would interact through thin walls. */
void wall_list3_cut(const struct sph *s, struct wall_list *l);
/* After the integrals: pieces of thin walls that the particle does not see count for nothing, and
 * the sums are closed at their rims. */
void wall_list3_shade(const struct sph *s, struct wall_list *l);
/* Whether the k-th particle of the list has gone through a thin wall since the list was made; f:
 * where, with the normal away from the side that it came from. */
bool wall_list3_crossed(const struct sph *s, const struct wall_list *l, int k, struct wall_foot *f);

#endif

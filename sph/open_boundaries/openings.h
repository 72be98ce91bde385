/* openings.h - the open sides of a particle region, cut into faces of edge dx. The flow through a
 * face is accumulated as mass. A face whose accumulator holds a whole particle creates it, and a
 * particle that leaves gives its mass to the nearest face (Chiron 2017, eqs. 6.13-6.14), with
 * threshold 1 and creation dx/2 inside, the pair that preserves a lattice. Accumulators are equal
 * on all ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_OPENINGS_H
#define SPH_OPENINGS_H

#include "../sph.h"

/* In particles: what a face that cannot create a particle holds beyond this goes to its neighbours;
 * a deficit beyond this is an air cavity that crossed the open side. */
static const double openings_max_deficit = 1.5;

/* Sign of the inward direction along the side's axis. */
static inline double openings_inward(int side) { return side % 2 ? -1.0 : 1.0; }

/* Where the points that give birth lie between two rows of the lattice, in dx, what mass they then
 * hold, in particles, how deep the new particle stands, in dx, and whether a particle that leaves
 * gives its mass to the points on either side of it. */
struct birth_law {
    double along, threshold, depth; /* dx, particles, dx */
    bool shares;
};

/* The faces of all open sides and their accumulators. All arrays are owned, one entry per face
 * where no other is said. */
struct openings {
    int dim;
    const struct birth_law *law; /* borrowed for ever; "face" below is such a point */
    double dx, lo[3], hi[3];     /* m: spacing of the faces; region of the particles */
    bool open[6], bounded[3];    /* sides that are open; axes that do not repeat */
    int cells[3];                /* faces along each axis */
    /* First face of side 2a (low), 2a+1 (high); first[2 dim] is the number of faces. */
    int first[7];
    double *mass;   /* kg: accumulated, the same on all ranks */
    double *change; /* kg: of this step, this rank, then summed */
    double *flux;   /* kg/s: inward, of the faces this rank owns, 0 elsewhere */
    /* kg, all ranks: deficits of air cavities, to be removed by the zones' `drain'. */
    double deficit;
    double *room; /* -: fraction of each face that is not cut off by walls */
    /* -: fraction of each face that is neither cut off nor above the water outside. */
    double *share;
    double rain[4]; /* kg, kg m/s: drops that left over the water, this rank */
    double films;   /* kg: of that what ran along a wall */
    int64_t drops;
    double *shift; /* m: place of the incoming lattice behind each face */
    int64_t born, gone,
        refused; /* number of particles created, removed, not created for lack of room; this rank */
    double through[6];       /* kg: fluxes of the faces of each side, less drops; this rank */
    int64_t first_id;        /* ids of created particles: first_id + time in ticks * faces + face */
    double tick;             /* s: far below a step */
    int nghost, first_ghost; /* the lattice behind the faces, last among the ghosts */
    double *ghost_x;         /* [nghost][3] at time ghost_t */
    double ghost_t;
};

/* The faces of s->zones; owned by the caller (FREE). */
struct openings *openings_create(struct sph *s);
/* Sets room of the faces for the walls as they are now. */
void openings_find_room(const struct sph *s, struct openings *o);
/* From the accumulators (after a restart, too) computes what is to be drained, and the position of
 * the lattice behind each face. */
void openings_settle(struct sph *s);
int openings_faces(const struct openings *o);
/* Side of a face, with its centre x[3], m; the face of a side at x, clamped. */
int openings_place(const struct openings *o, int face, double *x);
int openings_face_at(const struct openings *o, int side, const double *x);
/* Face of a side at lattice indices `at' (that along the side's axis does not matter); indices of
 * bounded axes are clamped, of periodic ones wrapped. */
int openings_face(const struct openings *o, int side, const int *at);
/* Gives mass m of a particle that leaves at x to the points around it on that side, by distance. */
void openings_share(struct openings *o, int side, const double *x, double m);
/* Of the faces beside face f, around the ends of its side too, the one that holds most (sense 1) or
 * least (-1) after this step's changes, of those wet by more than a quarter; f itself if there is
 * none. */
int openings_beside(const struct openings *o, int f, double sense);
/* Time since the creation of the particle with this id, s, or since the start. */
double openings_age(const struct sph *s, int64_t id);
/* Removes mass, kg, from all faces in equal parts; to be called with the same mass on all ranks. */
void openings_let_out(struct openings *o, double mass);
/* Mass in all accumulators, kg, less the deficits of air cavities that are still to be drained; the
 * same on all ranks. */
double openings_held(const struct sph *s);

#endif

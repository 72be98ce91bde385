/* openings.h - the open sides of a particle region, cut into faces of side dx. The flow through a
 * face is accumulated as mass; a face that holds a whole particle gives birth to it, a particle
 * that leaves gives its mass to the nearest face (Chiron 2017, eqs. 6.13-6.14), with threshold 1
 * and birth dx/2 inside, the pair that keeps a lattice. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_OPENINGS_H
#define SPH_OPENINGS_H

#include "../sph.h"

/* What a face that cannot give birth holds beyond this, in particles, goes to its neighbours; a
 * deficit beyond this is an air cavity that crossed the open side. */
static const double openings_most_debt = 1.5;

static inline double openings_inward(int side) { return side % 2 ? -1.0 : 1.0; }

struct openings {
    int dim;
    double dx, lo[3], hi[3];
    bool open[6], bounded[3]; /* sides that are open; axes that do not repeat */
    int cells[3];             /* faces along each axis */
    int first[7];             /* of side 2a (low), 2a+1 (high); first[2 dim]: number of faces */
    double *mass;             /* kg: accumulated, the same on all ranks */
    double *change;           /* kg: of this step, this rank, then summed */
    double *flux;             /* kg/s of the faces this rank owns, 0 elsewhere: inward */
    double owed;    /* kg, all ranks': deficits of air cavities, to be drained by zones' `drain' */
    double *room;   /* -: of each face that no line of the walls cuts off */
    double *share;  /* -: of each face that the water outside wets; without a surface there, room */
    double rain[4]; /* kg, kg m/s: drops that left over the water, this rank */
    double films;   /* kg: of that what ran along a wall */
    int64_t drops;
    double *shift;                       /* m: place of the incoming lattice behind each face */
    int64_t born, gone, refused;         /* on this rank */
    double born_mass, gone_mass, inflow; /* kg: since the start, this rank */
    double through[6]; /* kg: of particles created less removed at each side, too */
    int64_t first_id;  /* the newborn's: first_id + time of birth in ticks * faces + face */
    double tick;       /* s: far below a step */
    int nghost, first_ghost,
        ghost_capacity; /* the lattice behind the faces, last among the ghosts */
    double *ghost_x;    /* [nghost][3] at time ghost_t */
    double ghost_t;
};

struct openings *openings_create(struct sph *s);
void openings_free(struct openings **o);
/* What walls leave of faces where they stand now. */
void openings_find_room(const struct sph *s, struct openings *o);
/* From the accumulated masses (after a restart, too): what is to be drained, and where the lattice
 * behind each face stands. */
void openings_settle(struct sph *s);
int openings_faces(const struct openings *o);
/* Side, centre x[3] of a face; the one at x on a side, clamped. */
int openings_place(const struct openings *o, int face, double *x);
int openings_face_at(const struct openings *o, int side, const double *x);
/* Face of a side at lattice indices I (that of the side's axis does not matter); indices of bounded
 * axes are clamped, of periodic ones wrapped. */
int openings_face(const struct openings *o, int side, const int *at);
/* Of the faces beside face f, round the ends of its side too, the one that holds most (sense 1) or
 * least (-1) after this step's changes; f itself where walls leave none. */
int openings_beside(const struct openings *o, int f, double sense);
/* s since the birth of the particle with this id, or since the start. */
double openings_age(const struct sph *s, int64_t id);
/* Takes mass (kg) from all faces alike; the same on all ranks. */
void openings_let_out(struct openings *o, double mass);
/* kg: accumulated by all faces, less the deficits of air cavities to be drained; the same on all
 * ranks. */
double openings_held(const struct sph *s);

#endif

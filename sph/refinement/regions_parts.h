/* regions_parts.h - the parts that the files of regions share; private to them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_REGIONS_PARTS_H
#define SPH_REGIONS_PARTS_H

#include "../particles/sph_particles.h"
#include "apr_params.h"
#include "ball.h"
#include "box_union.h"
#include "marks.h"
#include "shell.h"

/* A shell around a body or wall, as thick as this level has it. */
struct layer {
    int shell;
    double width; /* m */
};

/* The region of one level: the union of boxes, balls, layers and marked cells. */
struct level {
    struct box_union boxes;
    int nballs, nlayers;
    struct ball *balls;
    struct layer *layers;
    struct marks *cells; /* what criteria mark; NULL: no criterion asks for this level */
};

/* Regions of the case that move together. */
struct region_set {
    const struct apr_region *is;
    struct scene_body told;   /* the motion as a body would have it */
    struct body_drive drive;  /* of that */
    int body;                 /* that it follows, -1: none */
    bool peak, box, along[3]; /* it follows the peak, sph.box */
    double shift[3];          /* m: now */
    double centre[3];         /* m: of its finest region at the start */
    double speed;             /* m/s: largest of the prescribed motion */
    int finest;               /* level */
};

struct criteria;
/* All regions of the case and the region of each level made from them. */
struct regions {
    const struct run *run;
    const struct apr_params *prm;
    int dim;
    double R, dx, near;  /* m: of level 0; what counts as the same place */
    double zones;        /* m: depth of the zones at open sides */
    struct box domain;   /* region of the particles */
    struct box start[2]; /* both where the case has them */
    bool goes;           /* domain moves with sph.box */
    bool gone;           /* it has moved since the regions were made */
    double way[3];       /* m: from where the case has them */
    double speed;        /* m/s: as fast as they will be */
    struct box room;     /* the same with faces where an edge ends: walls, free ends; infinite */
    bool periodic[3], open[6];
    int nimages; /* of periodic axes, and the shift to each, m */
    double image[27][3];
    int nsets, set_of[REGIONS_MAX]; /* -1: moves with its shell */
    struct region_set sets[REGIONS_MAX];
    int nshells, shell_of[REGIONS_MAX]; /* -1: none */
    struct shell shells[REGIONS_MAX];
    int body_of[REGIONS_MAX]; /* of shells; -1: a wall */
    bool alone[REGIONS_MAX];  /* regions around which the outer one is made automatically */
    struct body_motion bodies[BODIES_MAX];
    double peak[3], peak_pressure; /* m, Pa */
    bool peak_known;
    struct level level[APR_LEVELS_MAX + 1]; /* [1 .. levels] */
    struct criteria *criteria;              /* NULL: none */
};

/* R of a level, m. */
static inline double regions_R(const struct regions *g, int level) { return ldexp(g->R, -level); }
/* Distance from the edge of level n to that of level n + 1 within it, where it is made, m. */
static inline double regions_margin(const struct regions *g, int n)
{
    return g->prm->margin * regions_R(g, n - 1);
}

/* Signed distance of x to the edge of a level's boxes, balls and layers alone, without marked
 * cells, m. */
double regions_fixed_distance(const struct regions *g, int level, const double *x);

/* regions_check.c: whether the case has a region of the level below around region k that moves with
 * it. */
bool regions_outer_given(const struct regions *g, int k);

/* Furthest coordinate, m, that a level may reach towards side 2a (low) or 2a + 1 (high): infinite
 * but at open sides. */
double regions_allowed(const struct regions *g, int level, int side);

/* region_motion.c */
void region_sets_create(struct regions *g);
/* Computes the displacements at time t, s; returns whether any has changed. */
bool region_sets_move(struct regions *g, double t);
/* Index of the body of this name; BODIES_MAX: there is none. */
int region_body(const struct scene *c, const char *name);
/* Bits of the axes named in `along', of all if it is empty; -1: a word is no axis. */
int region_axes(const char *along, int dim);

#endif

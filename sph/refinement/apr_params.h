/* apr_params.h - the parameters of group apr: where particles are refined, and how far. Levels
 * count from 0, the coarsest, each with half the spacing of the one before.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_APR_PARAMS_H
#define SPH_APR_PARAMS_H

#include "../../common/scene/scene.h"

struct run;

/* Forms of a region; BODY and WALL: all within `offset' of the surface of one. */
enum region_shape { REGION_BOX, REGION_SPHERE, REGION_BODY, REGION_WALL };
/* Indicators of the flow, criteria.h: nearness of the surface, size of the curl of u and of the
 * gradient of p, jump of p between neighbours after reconstruction. */
enum criterion_kind { CRITERION_SURFACE, CRITERION_VORTICITY, CRITERION_PRESSURE, CRITERION_JUMP };
/* Guards: the method of refinement.h. The others exist for comparison: mixed.h. */
enum apr_method { APR_GUARDS, APR_WEIGHTS, APR_COALESCENCE, APR_GRADED };
/* Fields of guards: by the slopes of what flows around them, or by Shepard's mean over it. */
enum apr_guards { GUARDS_SLOPES, GUARDS_MEAN };
/* Most regions, criteria and levels above the coarsest; rows of the table. */
enum { REGIONS_MAX = 32, CRITERIA_MAX = 8, APR_LEVELS_MAX = 12, APR_ROWS = 10 };

/* A region of the case in which particles are refined. */
struct apr_region {
    int level;                    /* 0: the finest */
    int shape;                    /* enum region_shape */
    double min[3], max[3];        /* m: of a box */
    double centre[3], radius;     /* m: of a sphere (2D: a disc) */
    char body[PARAM_TEXT_SIZE];   /* name of a body */
    int wall;                     /* number in the list of walls, from 1 */
    double offset;                /* m: how far from the surface of a body or wall */
    double velocity[3];           /* m/s: of the region as a whole */
    struct scene_motions motion;  /* the same over time */
    char follow[PARAM_TEXT_SIZE]; /* name of a body, or "peak" */
    char along[PARAM_TEXT_SIZE];  /* axes of that, as in "x"; "": all */
    double pressure;              /* Pa: pressure from which on a peak is followed */
};

/* A condition on the flow under which particles are refined: criteria.h. */
struct apr_criterion {
    int level;              /* finest that it asks for; 0: the finest of all */
    int kind;               /* enum criterion_kind */
    double above, distance; /* bound of the dimensionless indicator; distance from the surface in R
                               of the coarser level */
};

/* Group apr. */
struct apr_params {
    int method;       /* enum apr_method */
    int guards;       /* enum apr_guards: where their fields come from */
    int levels;       /* halvings of dx; 0: as regions and criteria have it */
    double margin;    /* in R of the coarser level: distance between the edges of regions made
                         automatically */
    int around;       /* cells, R of the coarser level wide, around those that a criterion marks */
    double particles; /* of all levels, never exceeded; 0: no bound */
    bool local_steps; /* each level has a time step of its own */
    bool unshifted_finest; /* shifting moves particles of the coarser levels only */
    struct apr_regions {
        int n;
        struct apr_region of[REGIONS_MAX];
    } regions;
    struct apr_criteria {
        int n;
        struct apr_criterion of[CRITERIA_MAX];
    } criteria;
};

/* The rows of the table, and the struct that they fill. */
extern const struct param apr_rows[APR_ROWS];
extern struct apr_params apr_given; /* the target of the table */

/* The parameters as the run uses them, levels filled in; NULL: nothing is refined. Borrowed until
 * the end of the program. */
const struct apr_params *apr_params_of(const struct run *r);

#endif

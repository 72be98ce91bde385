/* apr_params.h - the parameters of group apr: where particles are refined, and how far.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_APR_PARAMS_H
#define SPH_APR_PARAMS_H

#include "../../common/params.h"

struct run;

enum region_shape { REGION_BOX, REGION_SPHERE };
enum { REGIONS_MAX = 32, APR_LEVELS_MAX = 12, APR_ROWS = 3 };

struct apr_region {
    int level;                /* 0: the finest */
    int shape;                /* enum region_shape */
    double min[3], max[3];    /* m: of a box */
    double centre[3], radius; /* m: of a sphere (2D: a disc) */
};

struct apr_params {
    int levels;    /* halvings of dx; 0: as the regions have it */
    double margin; /* R of the coarser level: between the edges of regions made automatically */
    struct apr_regions {
        int n;
        struct apr_region of[REGIONS_MAX];
    } regions;
};

extern const struct param apr_rows[APR_ROWS];
extern struct apr_params apr_given; /* the target of the table */

/* As the run uses them, levels filled in; NULL: nothing is refined. Borrowed until the end of the
 * program. */
const struct apr_params *apr_params_of(const struct run *r);

#endif

/* apr_params.c - parameter table of group apr. SPDX-License-Identifier: BSD-3-Clause */
#include "apr_params.h"

#include "../../common/run.h"

struct apr_params apr_given;

/* clang-format off */
#define P struct apr_region
static const struct param region_rows[] = {
    PARAM(P, level, "-", "0", 0, APR_LEVELS_MAX, "dx is halved so often in it; 0: apr.levels times"),
    CHOICE(P, shape, "box|sphere", "box", "its form; in 2D a sphere is a disc"),
    PARAM(P, min, "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "lower corner of a box; faces on walls, on ends of the domain or beyond them are no edges"),
    PARAM(P, max, "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "upper corner"),
    PARAM(P, centre, "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "of a sphere"),
    PARAM(P, radius, "m", "0.0", 0, 1e9, "of a sphere"),
};
#undef P
static const struct param_list regions = {
    region_rows, sizeof region_rows / sizeof region_rows[0], sizeof(struct apr_region),
    offsetof(struct apr_regions, of), REGIONS_MAX, NULL};

#define P struct apr_params
const struct param apr_rows[APR_ROWS] = {
    PARAM(P, levels, "-", "0", 0, APR_LEVELS_MAX, "levels of refinement: dx of the finest is sph.dx / 2^levels; 0: the largest level of the regions"),
    PARAM(P, margin, "-", "3.0", 1.5, 100, "a region of level 2 and more has one of each coarser level around it, made where the case gives none: distance of their edges in R of the level outside of the coarser one"),
    LIST(P, regions, &regions, "where particles are refined; regions of one level are united"),
};
#undef P
/* clang-format on */

const struct apr_params *apr_params_of(const struct run *r)
{
    static struct apr_params used;
    if ((r->params && !params_has_group(r->params, "apr")) || apr_given.regions.n == 0)
        return NULL;
    used = apr_given;
    for (int k = 0; k < used.regions.n && apr_given.levels == 0; k++)
        if (used.regions.of[k].level > used.levels)
            used.levels = used.regions.of[k].level;
    if (used.levels == 0)
        used.levels = 1;
    for (int k = 0; k < used.regions.n; k++)
        if (used.regions.of[k].level == 0)
            used.regions.of[k].level = used.levels;
    return &used;
}

/* apr_params.c - parameter table of group apr, and the parameters as a run uses them. Rows fill
 * apr_given; apr_params_of fills in levels that the case leaves out.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "apr_params.h"

#include "../../common/run/run.h"
#include "../sph_facts.h"

struct apr_params apr_given;

/* As many levels as regions and criteria name, one at least. */
static int largest_level(const struct apr_params *p)
{
    int n = 1;
    for (int k = 0; k < p->regions.n; k++)
        n = p->regions.of[k].level > n ? p->regions.of[k].level : n;
    for (int k = 0; k < p->criteria.n; k++)
        n = p->criteria.of[k].level > n ? p->criteria.of[k].level : n;
    return n;
}

/* --- when keys are used: tests of conditions --- */

static bool follows_peak(const void *run, const void *region)
{
    return (void)run, strcmp(((const struct apr_region *)region)->follow, "peak") == 0;
}

/* Whether any region or criterion goes beyond level 1: only then are outer ones made. */
static bool has_outer(const void *run, const void *apr)
{
    const struct apr_params *p = apr;
    return (void)run, p->levels > 1 || (p->levels == 0 && largest_level(p) > 1);
}

/* clang-format off */
#define P struct apr_region
static const struct param region_rows[] = {
    PARAM(P, level,    "-", "0", 0, APR_LEVELS_MAX, "dx is halved so often in it; 0: apr.levels times"),
    CHOICE(P, shape, "box|sphere|body|wall", "box", "its form; in 2D a sphere is a disc; body and wall: all within offset of the surface of one"),
    PARAM(P, min,      "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "lower corner of a box; faces on walls, on ends of the domain or beyond them are no edges",
          USED(ONLY(shape, ONE(REGION_BOX), "only a box has corners"))),
    PARAM(P, max,      "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "upper corner",
          USED(ONLY(shape, ONE(REGION_BOX), "only a box has corners"))),
    PARAM(P, centre,   "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "of a sphere",
          USED(ONLY(shape, ONE(REGION_SPHERE), "only a sphere has a centre"))),
    PARAM(P, radius,   "m", "0.0", 0, 1e9, "of a sphere",
          USED(ONLY(shape, ONE(REGION_SPHERE), "only a sphere has a radius"))),
    PARAM(P, body,     "-", "", 0, 0, "of shape body: the body's name",
          USED(ONLY(shape, ONE(REGION_BODY), "the shape is no body; to move with one: follow"))),
    PARAM(P, wall,     "-", "0", 0, 1000, "of shape wall: number of the wall in the list, from 1; points or a mesh",
          USED(ONLY(shape, ONE(REGION_WALL), "the shape is no wall"))),
    PARAM(P, offset,   "m", "0.0", 0, 1e9, "of shapes body and wall: width of the region in front of the surface",
          USED(ONLY(shape, ONE(REGION_BODY) | ONE(REGION_WALL), "only shapes body and wall have an offset"))),
    PARAM(P, velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "of a box or sphere",
          USED(ONLY(shape, ONE(REGION_BOX) | ONE(REGION_SPHERE), "this shape moves with its body, or not at all"))),
    LIST(P, motion, &scene_motion_list, "prescribed motion of a box or sphere, like that of bodies, without rotations; a plain text: one file",
          USED(ONLY(shape, ONE(REGION_BOX) | ONE(REGION_SPHERE), "this shape moves with its body, or not at all"))),
    PARAM(P, follow,   "-", "", 0, 0, "a box or sphere moves with the body of this name, or with the largest pressure of the flow: \"peak\"; or with a box of particles that moves: \"sph.box\"",
          USED(ONLY(shape, ONE(REGION_BOX) | ONE(REGION_SPHERE), "this shape moves with its body, or not at all"))),
    PARAM(P, along,    "-", "", 0, 0, "axes along which it follows, as in \"x\"; all if none are named",
          USED(WITH(follow, "nothing is followed"))),
    PARAM(P, pressure, "Pa", "0.0", 0, 1e12, "with follow = \"peak\": least pressure of a peak that is followed",
          USED(WHERE(follows_peak, "follow = peak", "no peak is followed"))),
};
#undef P
static const struct param_list regions = {
    region_rows, sizeof region_rows / sizeof region_rows[0], sizeof(struct apr_region),
    offsetof(struct apr_regions, of), REGIONS_MAX, NULL};

#define P struct apr_criterion
static const struct param criterion_rows[] = {
    PARAM(P, level, "-", "0", 0, APR_LEVELS_MAX, "finest level that it asks for; 0: apr.levels"),
    CHOICE(P, kind, "surface|vorticity|pressure|jump", "vorticity", "nearness of the free surface; size of the curl of u times dx/U, U the largest speed so far; size of the gradient of p times dx/(rho max(u^2, g dx)); jump of p between particles after reconstruction, over rho max(u^2, g dx); dx of the coarser level"),
    PARAM(P, above,    "-", "0.0", 0, 1e9, "refined where it is larger than this, released below a third of it",
          USED(ONLY(kind, ~ONE(CRITERION_SURFACE), "this kind has a bound `distance'"))),
    PARAM(P, distance, "-", "0.0", 0, 100, "of kind surface: refined so many R of the coarser level around it",
          USED(ONLY(kind, ONE(CRITERION_SURFACE), "this kind has a bound `above'"))),
};
#undef P
static const struct param_list criteria = {
    criterion_rows, sizeof criterion_rows / sizeof criterion_rows[0], sizeof(struct apr_criterion),
    offsetof(struct apr_criteria, of), CRITERIA_MAX, NULL};

#define P struct apr_params
const struct param apr_rows[APR_ROWS] = {
    CHOICE(P, method, "guards|weights|coalescence|graded", "guards", "method: levels with guard particles between them; the others are for comparison, in 2D on one rank: parents and children together, weighted (Barcarolo); splitting and merging in pairs (Vacondio); spacing that grows by 2.5 % a particle away from a box", .comparison = true),
    CHOICE(P, guards, "slopes|shepard", "slopes", "fields of guards: by the slopes of what flows around them, third order; for comparison by Shepard's mean over it, which damps what turns",
          USED(ONLY(method, ONE(APR_GUARDS), "this method has particles of all sizes in one set")), .comparison = true),
    PARAM(P, levels,    "-", "0", 0, APR_LEVELS_MAX, "levels of refinement: dx of the finest is sph.dx / 2^levels; 0: the largest level of regions and criteria, 1 if none is given"),
    PARAM(P, margin,    "-", "3.0", 1.5, 100, "a region of level 2 and more has one of each coarser level around it, made where the case gives none: distance of their edges, in R of the level outside of both",
          USED(WHERE(has_outer, "a level above 1", "all regions are of level 1")), .comparison = true),
    PARAM(P, around,    "-", "3", 2, 20, "cells, as wide as R of the coarser level, that are refined around those where a criterion asks for it",
          USED(WITH(criteria, "there are no criteria")), .comparison = true),
    PARAM(P, particles, "-", "0.0", 0, 1e12, "most particles of all levels together: criteria refine less rather than exceed it; 0: no bound",
          USED(WITH(criteria, "without criteria nothing adapts to a budget"))),
    PARAM(P, local_steps, "-", "false", 0, 1, "each level steps with a time step of its own: the next finer one halves it, or takes as many steps as it needs",
          USED(ONLY(method, ONE(APR_GUARDS), "this method has particles of all sizes in one set"))),
    PARAM(P, unshifted_finest, "-", "false", 0, 1, "the law of shifting moves particles of coarser levels alone, not those of the finest: to compare",
          USED(ONLY(method, ONE(APR_GUARDS), "this method has particles of all sizes in one set"),
               NEED(SHIFTED, "sph.transport is no law of shifting")), .comparison = true),
    LIST(P, regions, &regions, "where particles are refined; regions of one level are united"),
    LIST(P, criteria, &criteria, "quantities of the flow that ask for refinement"),
};
#undef P
/* clang-format on */

/* Filled in anew at each call, as a test may change the case; NULL: nothing is refined. Level 0 of
 * a region is the finest. */
const struct apr_params *apr_params_of(const struct run *r)
{
    static struct apr_params used;
    if ((r->params && !params_has_group(r->params, "apr")) ||
        (apr_given.regions.n == 0 && apr_given.criteria.n == 0))
        return NULL;
    used = apr_given;
    if (used.levels == 0)
        used.levels = largest_level(&used);
    for (int k = 0; k < used.regions.n; k++)
        if (used.regions.of[k].level == 0)
            used.regions.of[k].level = used.levels;
    for (int k = 0; k < used.criteria.n; k++)
        if (used.criteria.of[k].level == 0)
            used.criteria.of[k].level = used.levels;
    return &used;
}

/* level_ops.h - what the level set needs of the cells that it stands on, in a table for each kind
 * of them: all else of it asks here and knows no grid. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_LEVEL_OPS_H
#define FV_LEVEL_OPS_H

#include "../fv.h"

enum { BAND = 5 }; /* cells on either side of the surface that are advected */

struct cut; /* levelset.h */

/* The table; its functions are collective only where it says so. */
struct level_ops {
    /* What the surface keeps of the cells, phi of the scene's water at the start, with no ghosts
     * yet. Collective. */
    void (*start)(const struct fv *s, struct surface *f);
    /* Ghosts of a level set; of any field that belongs to cells: see levelset.h. */
    void (*ghosts)(const struct fv *s, double *phi);
    void (*mirror)(const struct fv *s, double *q);
    /* Ghosts of phi while it goes on; first: it has those of `ghosts'. */
    void (*stage_ghosts)(const struct fv *s, bool first, double *phi);
    /* rate = -u.grad phi in the band. */
    void (*rate)(const struct fv *s, const double *phi, double *rate);
    /* 1/s: largest sum over the axes of what u crosses of cells, over all ranks. */
    double (*speed)(const struct fv *s);
    /* m: largest spacing of the cells of local row j of a part, of blocks of the whole part. */
    double (*spacing)(const struct fv *s, const struct part *p, int j);
    /* m a cell: see surface_slopes. */
    void (*slopes)(const struct fv *s, const struct part *p, int64_t c, double *n);
    /* g = grad phi at a cell of local row j along the axes of the flow, central. */
    void (*gradient)(const struct fv *s, const struct part *p, int64_t c, int j, const double *phi,
                     double g[3]);
    /* See surface_cell_volume and surface_counted. */
    double (*volume)(const struct fv *s, int64_t c, int j);
    double (*counted)(const struct fv *s, int64_t c, double share);
    /* m: mean spacing of a part's cells along index a. */
    double (*spacing_along)(const struct fv *s, const struct part *p, int a);
    /* Which cells hold nothing, of where boxes, a partner and blocks stand now. Collective. */
    void (*close_cells)(struct fv *s);
    /* The cuts, and what else the layers make of faces. */
    void (*find_faces)(struct fv *s);
    /* U of these faces less tau times the flux of psi. */
    void (*fluxes)(const struct fv *s, double tau, const double *psi);
    /* Of a change of psi over the lower face of a cell along a: its slope, on blocks its flux; of
     * the slope on a cut, in the same unit. */
    double (*face_slope)(const struct fv *s, int a, int64_t face, double change);
    double (*cut_slope)(const struct fv *s, int a, const struct cut *x, double slope);
    /* Adds to the volume of water (m^dim) and its change with phi what cells that are shared have
     * beyond their counts; NULL: there are none. */
    void (*add_shared)(const struct fv *s, double sums[2]);
};

/* Of uniform cells and layers of unequal height; of blocks. */
extern const struct level_ops even_level, block_level;

/* levelset.c: q = w p + (1 - w)(q + dt rate) */
void level_blend(const struct fv *s, double w, const double *p, double dt, const double *rate,
                 double *q);
/* Parts of a step in which phi crosses so many cells. */
int level_parts(double cfl);
/* surface_pressure.c: of even cells. */
void level_find_cuts(struct fv *s);
void level_cut_fluxes(const struct fv *s, double tau, const double *psi);
/* surface_pressure.c: the cut of a face between the cells face - d and face, of which one is wet
 * (here: the latter), with theta where phi is 0 between their centres; the caller sets step and
 * size. */
struct cut level_cut(const struct surface *f, int64_t face, int64_t d, bool here);
/* Appends it to the cuts along a: x, m: where it is; e: unit vector from the wet to the dry cell.
 * theta becomes the distance at which p stands, height that of x. */
void level_add_cut(struct fv *s, int a, struct cut cut, const double *x, const double *e);
/* Adds to sums[0] the water of a cell of this volume, m^dim, below phi = 0, to sums[1] its
 * derivative with respect to a shift of phi, between shifts of e and -e, m. */
void level_add_water(const struct fv *s, const struct part *p, int64_t c, double volume, double e,
                     double sums[2]);

/* The next run of cells in a row, behind the n from *from on, that are less than the band off the
 * surface; false: there is none. */
static inline bool level_next_run(const double *phi, double band, int64_t end, int64_t *from,
                                  int64_t *n)
{
    int64_t i = *from + *n;
    while (i < end && !(fabs(phi[i]) < band))
        i++;
    *from = i;
    while (i < end && fabs(phi[i]) < band)
        i++;
    *n = i - *from;
    return *n > 0;
}

/* vents.c: which faces of boxes let air in, by the flow of the last step. Collective. Then their
 * cuts along axis a. */
void vents_find(struct fv *s);
void vents_add_cuts(struct fv *s, int a);

#endif

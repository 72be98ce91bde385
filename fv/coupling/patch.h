/* patch.h - what a partner is given: the cells of a uniform grid. Of fv.cells those themselves;
 * where the partner may come to unequal layers, the even ones go on below, with averages by cubics;
 * of blocks a box around the partners', whose averages come from the blocks' cells by cubics. Where
 * the finest block there is a plain box, they are its cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_PATCH_H
#define FV_PATCH_H

#include "../fv.h"
#include "../grid/fv_grid.h"

struct patch {
    int dim;
    double origin[3], h[3]; /* m */
    int cells[3];           /* of all ranks */
    bool periodic[3];
    int first; /* local row of fv.cells that is its lowest */
    int below; /* rows of fv.cells below its first */
    struct blend {
        int row;     /* of fv.cells, this rank's: the first of four */
        double w[4]; /* that make a row of the patch */
    } * blend;       /* [of.n[1]]; NULL: rows of fv.cells are its own */
    struct layout_box
        of;    /* what this rank has; its own rows of fv.cells are counted from the grid's */
    int64_t n; /* number of those */
    struct mesh_exchange sample; /* of blocks */
};

/* box (lower, upper corner): where each of n partners may look, NULL: in equal layers alone; inner:
 * within it and away from its interface it does not look, so blocks need not have values there.
 * where: a place (m) that wants a value and finds none; false then. Collective. */
bool patch_create(const struct fv *s, int n, const double (*box)[2][3], const double (*inner)[2][3],
                  struct patch *p, double *where);
/* Of blocks cut anew around boxes that move, which stand there now. */
bool patch_renew(const struct fv *s, int n, const double (*box)[2][3], const double (*inner)[2][3],
                 struct patch *p, double *where);
/* Centre of the local cell with this number. */
void patch_centre(const struct patch *p, int64_t i, double *x);
/* Averages over its cells, x fastest, of a field with ghosts. Collective. */
void patch_look(const struct fv *s, struct patch *p, double *f, double *to);

#endif

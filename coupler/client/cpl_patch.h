/* cpl_patch.h - a piece of a uniform grid with values and time derivatives, evaluated anywhere:
 * linear [6.6], exact on 1, x, y, xy, order 2; cubic, exact on cubics whose cell averages are
 * given, order 4. Equations: Chiron, thesis, Ecole Centrale de Nantes 2017, section 6.3. Part of
 * libcpl.a, no MPI. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "../cpl.h"

/* The cells lo <= i < lo + n of a grid with a polynomial in time per component; zeroed memory is
 * empty. */
struct client_patch {
    int dim, ncomp;
    bool cubic;
    int lo[3], n[3];              /* first cell and number of cells; in 2D n[2] is 1 */
    double origin[3], spacing[3]; /* of the grid, m */
    int period[3];                /* cells; 0: not periodic */
    double t;                     /* s: time of v */
    double *v;                    /* [cell, x fastest][ncomp][CPL_TERMS]: terms in time */
    double *now; /* [cell][ncomp]: values at the time now_at[0], shared by the evaluations of one
                    stage */
    double *now_at;
};

/* Number of cells. */
size_t patch_size(const struct client_patch *p);
/* To be called once, after v was filled. Turns the cell averages in v into values at cell centres
 * if the patch is cubic, and allocates `now'. */
void patch_prepare(struct client_patch *p);
/* v[n ncomp] and grad[n ncomp 3], 1/m (NULL: not wanted), at x[3 n], m, and time t, s. A point
 * outside of the patch gets the value at the patch's nearest point. Local to a rank. */
void patch_eval(const struct client_patch *p, double t, long n, const double *x, double *v,
                double *grad);
/* Frees the arrays and leaves an empty patch. */
void patch_clear(struct client_patch *p);

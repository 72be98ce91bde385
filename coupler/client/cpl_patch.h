/* cpl_patch.h - a piece of a uniform grid with values and time derivatives, evaluated anywhere:
 * linear [6.6], exact on 1, x, y, xy, order 2; cubic, exact on cubics whose cell averages are
 * given, order 4. Equations: Chiron, thesis, Ecole Centrale de Nantes 2017, section 6.3. Part of
 * libcpl.a, no MPI. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_CPL_PATCH_H
#define COUPLER_CPL_PATCH_H

#include <stdbool.h>
#include <stddef.h>

#include "../cpl.h"

struct client_patch {
    int dim, ncomp;
    bool cubic;
    int lo[3], n[3];              /* first cell and number of cells; in 2D n[2] is 1 */
    double origin[3], spacing[3]; /* of the grid, m */
    int period[3];                /* cells; 0: not periodic */
    double t;                     /* s: time of v */
    double *v;                    /* [cell, x fastest][ncomp][CPL_TERMS]: terms in time */
    double *now; /* [cell][ncomp] at the time now_at[0]: evaluations of a stage share it */
    double *now_at;
};

size_t patch_size(const struct client_patch *p); /* cells */
/* Once, after v is filled. Cubic: turns the cell averages in v into values at cell centres. */
void patch_prepare(struct client_patch *p);
/* v[n ncomp], grad[n ncomp 3] (or NULL) at x[3 n] and time t. Outside the patch: as at its nearest
 * place. */
void patch_eval(const struct client_patch *p, double t, long n, const double *x, double *v,
                double *grad);
void patch_clear(struct client_patch *p); /* frees v, leaves an empty patch */

#endif

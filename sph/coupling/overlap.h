/* overlap.h - tells when the two programs of a coupled job no longer describe one flow: their
 * velocities and pressures differ where both are free, or a surface has come where the partner has
 * none. Once a coupling step.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_OVERLAP_H
#define SPH_OVERLAP_H

#include "../../common/run/run.h"
#include "../sph.h"

/* Columns that the differences have in the series. */

/* The differences and the watches that judge them. */
struct overlap {
    struct watch velocity, pressure; /* rms of the differences over the scales below */
    struct watch dry; /* share of the transition's faces above which lies a surface */
    double U, p;      /* m/s, Pa: scales */
    bool fresh;       /* compared since it was judged last */
    double du, dp,
        on; /* m/s, Pa: rms differences; fraction of faces with a surface, of the last comparison */
    double looks;            /* number of comparisons so far */
    double du_mean, dp_mean; /* over some coupling steps: what is judged */
    bool asks;               /* the surface is looked for, once a coupling step */
    double found;            /* particles of this rank on a surface in transition and buffer */
    double where[3];         /* m: one of them */
};

/* The watches of a coupled run with their scales; owned by the caller (FREE). */
struct overlap *overlap_create(struct sph *s);
/* Compares SPH with the partner's patch at s->t. Collective. */
void overlap_look(struct sph *s);
/* Fills d where the run cannot be trusted. */
void overlap_judge(struct sph *s, struct diagnosis *d);
/* Adds the columns of the last comparison. */
void overlap_row(const struct overlap *o, struct figures *to);
/* Adds the worst values to the summary. */
void overlap_summary(const struct overlap *o, struct summary *to);
/* The differences for the progress line of the job, as soon as they are noticeable. */
void overlap_tell(const struct overlap *o, struct summary *to);
/* The worst values and the means in a restart file, written or read; what the file does not have
 * stays as it is. */
void overlap_restart(struct overlap *o, struct h5 *f);

#endif

/* report.h - what the series and the summary hold, on each kind of cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_REPORT_H
#define FV_REPORT_H

#include "../fv.h"

enum { NORMS = 3 }; /* velocity, pressure, vorticity */

struct report {
    /* Forces on all closed sides, then on each body: number of columns and their (static) names;
     * values, as many. */
    int (*force_columns)(const struct run *r, const struct fv_params *prm, const char **columns);
    int (*forces)(struct fv *s, double *values);
    void (*probes)(struct fv *s, double *values);
    void (*summarise)(struct fv *s); /* what this kind alone has */
};
extern const struct report even_report, block_report;

/* fv_errors.c: kinetic energy over the computed cells, and the exact field's, J/kg m^dim. */
void fv_energies(struct fv *s, double sum[2]);
void fv_errors(struct fv *s, struct norm n[NORMS]);
/* How the run steps: "rk3, three projections a step". */
const char *report_method(const struct fv_params *prm);

#endif

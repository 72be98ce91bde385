/* outflow_budget.h - what has passed the openings of given discharge under a free surface, and how
 * much of it is still to come. Without such openings the functions do nothing. Volumes are m^dim,
 * outwards positive. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_OUTFLOW_BUDGET_H
#define FV_OUTFLOW_BUDGET_H

#include "../fv.h"

/* Counts water that went up through the lower faces along axis axis[b] of block b: volume, a
 * field. */
void outflow_count_volumes(struct fv *s, const int *axis, const double *volume);
/* Counts what the projected fluxes carry within dt, s; share: of the cell inside that is
 * water, as of sides_passing. */
void outflow_count_flows(struct fv *s, double dt,
                         double (*share)(const struct fv *s, int64_t c, int64_t in));
/* After a step of dt: what has not passed is still to come. Collective. */
void outflow_settle(struct fv *s, double dt);
/* Sets the discharges to those given at time t, s, and what is still to come of them. */
void outflow_set_discharges(struct fv *s, double t);
/* Before a step that may be taken back; outflow_budget_back does that. */
void outflow_keep_budget(struct fv *s);
void outflow_budget_back(struct fv *s);

#endif

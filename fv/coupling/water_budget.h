/* water_budget.h - the water of both programs where a free surface crosses from one into the other:
 * the partner's where FV's cells are imposed and FV's outside of that. What crosses the interface
 * is the partner's velocity, seen through a mapping, so that the sum drifts; what is missing comes
 * back by a slow flow through the interface. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_WATER_BUDGET_H
#define FV_WATER_BUDGET_H

#include "../../common/run/run.h"
#include "../fv.h"

/* The balance, the same on all ranks. */
struct water_budget {
    int n;                          /* partners */
    double box[PARTNERS_MAX][2][3]; /* m: what lies within is a partner's; imposed cells fill it */
    double partners;                /* m^dim: in there, at the end of the coupling step */
    double drops;         /* m^dim: that left partners over FV's water and fell into it, evenly */
    double start;         /* m^dim: all at the start; NAN: not known yet */
    double missing;       /* m^dim: now */
    double lasting;       /* m^dim/s: part of the flow that a lasting loss has called for */
    struct watch watched; /* of `missing' over all water */
};

/* The balance of n partners before the first coupling step; their boxes are the caller's to set. */
struct water_budget water_budget_create(int n);
/* Part of a cell of centre x and size h outside the box that a partner counts as its own. */
double water_budget_share(const struct fv *s, const double *x, const double *h);
/* Takes what the partners report at the end of a coupling step, m^dim: water[0], their water, and
 * water[1], drops that have left them since the start, which become fv's. */
void water_budget_take(struct fv *s, struct water_budget *w, const double water[2]);
/* At the end of a coupling step of T s: adds up the balance and sets the slow flow through the
 * interface that restores what is missing, s->forcing->inflow, for the next one. The first call
 * sets what there is at the start. Collective. */
void water_budget_close(struct fv *s, struct water_budget *w, double T);
/* Sets d where too large a share of all water is missing. */
void water_budget_judge(const struct fv *s, struct water_budget *w, struct diagnosis *d);
/* The balance in a restart file, written or read; false: the file does not have it. */
bool water_budget_restart(struct water_budget *w, struct h5 *f);

#endif

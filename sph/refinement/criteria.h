/* criteria.h - regions that the flow asks for. Each level has a grid of cells as wide as R of the
 * level below it; particles that flow enter their indicators; cells above a criterion's bound, and
 * some around them, are refined. A cell is released when its indicator has fallen below a third of
 * the bound and 20 R/c have passed since it was above. A budget of particles raises all bounds by
 * one factor.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_CRITERIA_H
#define SPH_CRITERIA_H

#include <stdbool.h>

struct regions;
struct h5;

/* Fraction of the budget that is used: it is kept by forecasts, between two of which particles
 * cross edges. */
#define CRITERIA_SHARE 0.9

/* The indicators of one particle that flows. */
struct flow_sample {
    double volume;      /* m^dim */
    double rho, speed;  /* kg/m^3, m/s: |u| */
    double curl, slope; /* 1/s: |curl u|; Pa/m: |grad p| */
    double jump;        /* Pa: largest jump of p after reconstruction, with its neighbours */
    bool on_surface;
};

/* Whether criteria are to be evaluated at time t, s: every R/(2 c) of the level below the finest
 * that they ask for. Then: criteria_begin, criteria_add for each particle that flows, of all
 * levels, criteria_end. */
bool criteria_due(const struct regions *g, double t);
/* speed: largest of the flow now, m/s; gravity: m/s^2; both scale the bounds. */
void criteria_begin(struct regions *g, double speed, double gravity);
/* Enters the sample of a particle at x. */
void criteria_add(struct regions *g, const double *x, const struct flow_sample *is);
/* Makes the regions anew. c: speed of sound, m/s. Collective. */
void criteria_end(struct regions *g, double t, double c);
/* Whether `jump' is needed, which looks at the slopes of neighbours. */
bool criteria_want_jumps(const struct regions *g);
/* Factor on all bounds that the budget asks for, >= 1; 1 without criteria. */
double criteria_factor(const struct regions *g);
/* Number of particles of all levels that the last evaluation expects. */
double criteria_forecast(const struct regions *g);

/* For regions.c: the criteria of g, NULL if it has none; owned by g. */
struct criteria *criteria_create(struct regions *g);
/* What the next evaluation depends on, in restart files, written or read: the same on all ranks.
 * false: the file has none that fits. Collective. */
bool criteria_restart(struct regions *g, struct h5 *f);

#endif

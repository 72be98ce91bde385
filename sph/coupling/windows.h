/* windows.h - the length of a coupling step, the time between two exchanges with a partner, and how
 * the feedback loop of the two programs behaves with it. From parameters alone: the same after a
 * restart.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WINDOWS_H
#define SPH_WINDOWS_H

#include "../sph.h"

/* The choice and the scales that led to it. */
struct windows {
    double T; /* s: length of a coupling step */
    int steps,
        memory; /* nominal steps in it; coupling steps over which p outside is smoothed, 1: none */
    const char *limit; /* what bounds T, for the log */
    double U, L;       /* m/s, m: scales of the flow */
    double weight;     /* m^2/s^2: g times depth or L under a surface, else 0 */
    double omega;      /* rad/s: of the waves; 0: there are none */
    double decay;      /* 1/s: rate at which viscosity levels the flow; 0: inviscid */
    double T_most;     /* s: largest T that is accurate enough for the flow and the waves */
    /* m: added mass of the partner's region seen from the side, per area and density. */
    double mass;
    double gain; /* of the loop in a coupling step: p = rho mass du/T, then du = p/(rho c0) */
};

/* Chooses T from coupling.steps, or automatically. */
struct windows windows_choose(const struct run *r, const struct sph_params *prm);
/* m: how far from a side of the box, along its axis, water stands up to the roof of fv's part at
 * the start, in the middle of the box across it; INFINITY: in 2D, as far as a closed wall, so that
 * no surface gives the pressure of that part. */
double windows_roofed(const struct run *r, const struct sph_params *prm, int side);
/* Factor by which smoothing over `memory' coupling steps reduces an alternation:
 * common/base/fit.h. */
double windows_smoothed(int memory);
/* Logs the choice in a line, with warnings. */
void windows_describe(const struct run *r, const struct sph_params *prm);
/* Warns where the coupling steps, T s, are shorter than chosen, for another program wished them so,
 * and the loop wants more smoothing then. */
void windows_compare(const struct run *r, const struct sph_params *prm, double T);
/* Adds faults of coupling.steps and coupling.memory. */
void windows_check(const struct run *r, const struct sph_params *prm, struct faults *f);

#endif

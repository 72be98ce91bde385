/* windows.h - length of the coupling steps between two exchanges with a partner, and what the loop
 * of the two makes of them. From parameters alone: the same after a restart.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WINDOWS_H
#define SPH_WINDOWS_H

#include "../sph.h"

struct windows {
    double T; /* s: length of a coupling step */
    int steps,
        memory; /* nominal steps in it; coupling steps over which p outside is smoothed, 1: none */
    const char *limit; /* what sets T */
    double U, L;       /* m/s, m: scales of the flow */
    double weight;     /* m^2/s^2: g times depth or L under a surface, else 0 */
    double omega;      /* 1/s: of the waves; 0: none */
    double T_most;     /* s: T that accuracy allows, by the flow and by the waves */
    double mass;       /* m: added mass of the partner's region at the side, per area and rho */
    double gain;       /* of the loop in a coupling step: p = rho mass du/T, then du = p/(rho c0) */
};

struct windows windows_choose(const struct run *r, const struct sph_params *prm);
/* Share of an alternation that smoothing over m coupling steps leaves, see common/base/fit.h. */
double windows_smoothed(int memory);
/* m/s: the lowest c0 with a gain of at most 1; 0: ten times that of the case is too low. */
double windows_c0(const struct run *r, const struct sph_params *prm);
/* A line for --check and the start; warnings. */
void windows_describe(const struct run *r, const struct sph_params *prm);
/* Faults of coupling.steps, coupling.memory. */
void windows_check(const struct run *r, const struct sph_params *prm, struct faults *f);

#endif

/* eigenvalue.h - the smallest eigenvalue of a particle's moment matrix M [2.42], 1 in a full
 * support and 0 for a lone particle: how much of its support is filled.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_EIGENVALUE_H
#define SPH_EIGENVALUE_H

/* Smallest eigenvalue of the symmetric part of M[dim][dim]. */
double eigenvalue_smallest(const double *M, int dim);

#endif

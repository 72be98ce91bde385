/* eigenvalue.h - how much of its support a particle sees: the smallest eigenvalue of its moments.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_EIGENVALUE_H
#define SPH_EIGENVALUE_H

/* Smallest eigenvalue of the symmetric part of M[dim][dim]. */
double eigenvalue_smallest(const double *M, int dim);

#endif

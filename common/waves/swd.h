/* swd.h - wave fields in files of the open format Spectral Wave Data (version 100), shapes 1 (deep
 * water) and 2 (of one depth): long-crested, periodic, with amplitudes at even times of
 *   eta = sum Re(h_j e^(-i k_j x)), phi = sum Re(c_j e^(-i k_j x)) Z_j(z), k_j = j dk,
 * Z_j = cosh k(z + d)/cosh kd, above z = 0 Taylor's series of the order that the file tells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SWD_H
#define COMMON_SWD_H

#include <stdbool.h>
#include <stddef.h>

struct swd; /* an open file */

struct swd_header {
    int n, nsteps;    /* modes but for j = 0; times */
    int order;        /* of the series; < 0: none, Z as it is */
    double dk, depth; /* 1/m, m; INFINITY: deep */
    double dt;        /* s */
};

/* Opens and checks a file. NULL: it cannot be read; error[size] says why, with the byte at fault.
 * Owned by the caller. Local to a rank. */
struct swd *swd_open(const char *path, char *error, size_t size);
struct swd_header swd_header_of(const struct swd *s);
/* Reads the amplitudes h, m, and c, m^2/s, of one time, [n + 1][2] (real, imaginary). */
void swd_read(struct swd *s, int step, double *h, double *c);
/* Fields eta and phi_s on the surface at `points' equidistant positions over 2 pi/dk, from h and
 * c. */
void swd_fields(const struct swd *s, const double *h, const double *c, int points, double *eta,
                double *phi);

#endif

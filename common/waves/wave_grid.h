/* wave_grid.h - uniform grid of a periodic line (one row of points) or a periodic plane on which
 * wave fields evolve, and its modes e^(i(kx x + ky y)). Fields are z[rows][columns][2][batch] as in
 * fft.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_GRID_H
#define COMMON_WAVE_GRID_H

#include "fft.h"

/* The grid; constant after its creation. */
struct wave_grid {
    int n[2];         /* columns, rows (1: a line) */
    int cells;        /* their product */
    double length[2]; /* m */
    double *k[2];     /* 1/m, [n]: by direction, signed; 0 where n/2 has no derivative */
    double *size;     /* 1/m, [cells]: |k| of each mode */
    int *mirror;      /* [cells]: the mode of -k */
    struct fft *of[2];
};

/* n: numbers of points, values of fft_size, n[1] = 1 for a line; length in m. Owned by the
 * caller. */
struct wave_grid *wave_grid_create(const int n[2], const double length[2]);
/* Transforms fields to modes, divided by the number of cells, and back, in place; work: as large as
 * z. */
void wave_grid_to_modes(const struct wave_grid *g, int batch, double *z, double *work);
void wave_grid_to_fields(const struct wave_grid *g, int batch, double *z, double *work);

#endif

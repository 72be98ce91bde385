/* wave_grid.h - even grid of a periodic line (one row) or a periodic plane on which wave fields
 * evolve, and its modes e^(i(kx x + ky y)). Fields z[rows][columns][2][batch] as in fft.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_GRID_H
#define COMMON_WAVE_GRID_H

#include "fft.h"

struct wave_grid {
    int n[2];         /* columns, rows (1: a line) */
    int cells;        /* their product */
    double length[2]; /* m */
    double *k[2];     /* 1/m, [n]: by direction, signed; 0 where n/2 has no derivative */
    double *size;     /* 1/m, [cells]: |k| of each mode */
    int *mirror;      /* [cells]: the mode of -k */
    struct fft *of[2];
};

/* Numbers of points are fft_size's, or 1 row. */
struct wave_grid *wave_grid_create(const int n[2], const double length[2]);
void wave_grid_free(struct wave_grid **g);
/* Fields to modes, divided by the number of cells, and back; work: as large as z. */
void wave_grid_to_modes(const struct wave_grid *g, int batch, double *z, double *work);
void wave_grid_to_fields(const struct wave_grid *g, int batch, double *z, double *work);

#endif

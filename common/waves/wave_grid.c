/* wave_grid.c - see wave_grid.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_grid.h"

#include "../base/base.h"

/* k has n/2 set to 0, for the first derivative of that mode is no real field; size keeps it, for
 * |k|^2 is. */
struct wave_grid *wave_grid_create(const int n[2], const double length[2])
{
    struct wave_grid *g = NEW(struct wave_grid, 1);
    double *all[2];
    g->cells = n[0] * n[1];
    for (int a = 0; a < 2; a++) {
        g->n[a] = n[a];
        g->length[a] = length[a];
        g->of[a] = mem_own(g, fft_create(n[a]));
        g->k[a] = NEW_IN(g, double, n[a]);
        all[a] = NEW(double, n[a]);
        for (int j = 0; j < n[a]; j++) {
            all[a][j] = n[a] > 1 ? 2.0 * M_PI / length[a] * (2 * j > n[a] ? j - n[a] : j) : 0.0;
            g->k[a][j] = 2 * j == n[a] ? 0.0 : all[a][j];
        }
    }
    g->size = NEW_IN(g, double, g->cells);
    g->mirror = NEW_IN(g, int, g->cells);
    for (int j = 0; j < n[1]; j++)
        for (int i = 0; i < n[0]; i++) {
            g->size[j * n[0] + i] = hypot(all[0][i], all[1][j]);
            g->mirror[j * n[0] + i] = (n[1] - j) % n[1] * n[0] + (n[0] - i) % n[0];
        }
    FREE(all[0], all[1]);
    return g;
}

/* Rows one by one, then all columns at once. */
static void transform(const struct wave_grid *g, int sign, int batch, double *z, double *work)
{
    const size_t row = (size_t)g->n[0] * 2 * (size_t)batch;
    for (int j = 0; j < g->n[1]; j++)
        fft_run(g->of[0], sign, 1, batch, z + row * (size_t)j, work);
    if (g->n[1] > 1)
        fft_run(g->of[1], sign, g->n[0], batch, z, work);
}

void wave_grid_to_modes(const struct wave_grid *g, int batch, double *z, double *work)
{
    const double share = 1.0 / g->cells;
    transform(g, -1, batch, z, work);
    for (size_t i = 0; i < (size_t)g->cells * 2 * (size_t)batch; i++)
        z[i] *= share;
}

void wave_grid_to_fields(const struct wave_grid *g, int batch, double *z, double *work)
{
    transform(g, 1, batch, z, work);
}

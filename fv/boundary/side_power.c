/* side_power.c - what comes in through the sides of uniform cells and layers: energy, work of
 * pressure and of friction. SPDX-License-Identifier: BSD-3-Clause */
#include "bc.h"
#include "still.h"

/* Power that comes in through a side, of the fluxes of energy, of pressure and of friction on its
 * faces: values there by the scheme's own interpolation into the ghosts, pressure by the cubic. */
static double side_power(const struct fv *s, int k)
{
    const struct block *b = &s->b;
    const int a = k / 2, t0 = a == 0 ? 1 : 0, t1 = a == 2 ? 1 : 2;
    const double out = k % 2 ? 1.0 : -1.0, rho = s->run->scene.fluid.rho;
    const int64_t in = k % 2 ? -b->stride[a] : b->stride[a], up = k % 2 ? b->stride[a] : 0;
    double sum = 0.0;
    int at[3];
    at[a] = k % 2 ? b->n[a] - 1 : 0;
    for (at[t1] = 0; at[t1] < b->n[t1]; at[t1]++)
        for (at[t0] = 0; at[t0] < b->n[t0]; at[t0]++) {
            const int64_t c = block_at(b, at[0], at[1], at[2]);
            const double area = block_size(b, t0, at[t0]) * block_size(b, t1, at[t1]);
            double p[4], square = 0.0, friction = 0.0;
            for (int n = 0; n < 4; n++)
                p[n] = fv_pressure(s, c + n * in) / rho;
            for (int q = 0; q < b->dim; q++) {
                const double *u = s->u[q] + c;
                const double w = (7.0 * (u[0] + u[-in]) - (u[in] + u[-2 * in])) / 12.0;
                const double slope = (15.0 * (u[0] - u[-in]) - (u[in] - u[-2 * in])) /
                                     (12.0 * block_size(b, a, at[a]));
                square += w * w;
                friction -= s->nu * w * slope;
            }
            const double pf = (25.0 * p[0] - 23.0 * p[1] + 13.0 * p[2] - 3.0 * p[3]) / 12.0;
            sum += area * (friction - out * s->U[a][c + up] * (0.5 * square + pf));
        }
    return sum;
}

double bc_power(const struct fv *s)
{
    double sum = 0.0;
    for (int k = 0; k < 2 * s->dim; k++) {
        const int a = k / 2;
        if (!s->b.periodic[a] && (k % 2 ? s->b.hi[a] == s->b.cells[a] : s->b.lo[a] == 0))
            sum += side_power(s, k);
    }
    return sum;
}

/* mesh_exact.c - the exact solution in cells, on blocks with a ring among its fields.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "forcing.h"
#include "mesh_bc.h"

/* Couette flow in a ring: u_theta = A r + B/r. A and B from the spins of both walls; p from dp/dr =
 * rho u^2/r, up to a constant. */
static void ring_at(const struct fv *s, const double *x, double *u, double *p, double *w)
{
    const struct mesh_block_params *b = s->m->block[0].prm;
    const double a2 = b->radius[0] * b->radius[0], b2 = b->radius[1] * b->radius[1];
    const double A = (b->spin[1] * b2 - b->spin[0] * a2) / (b2 - a2),
                 B = (b->spin[0] - b->spin[1]) * a2 * b2 / (b2 - a2);
    const double X = x[0] - b->centre[0], Y = x[1] - b->centre[1], r2 = X * X + Y * Y,
                 rate = A + B / r2;
    if (u) {
        u[0] = -rate * Y;
        u[1] = rate * X;
        u[2] = 0.0;
    }
    if (p)
        *p = s->run->scene.fluid.rho * (0.5 * A * A * r2 + A * B * log(r2) - 0.5 * B * B / r2);
    if (w)
        *w = 2.0 * A;
}

/* At a point; the ring's field does not change in time. */
void mesh_exact_at(const struct fv *s, const double *x, double t, double *u, double *p, double *w)
{
    if (s->prm.ring)
        ring_at(s, x, u, p, w);
    else
        exact_point(&s->exact, x, t, u, p, w);
}

/* Averages over the cell's index space (not its volume) by two Gauss points an index. */
static void average(const struct fv *s, const struct part *p, const int *i, double t, double *u,
                    double *pressure, double *w)
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]}, n = 1 << s->m->dim;
    u[0] = u[1] = u[2] = *pressure = *w = 0.0;
    for (int g = 0; g < n; g++) {
        double x[3], dx[3][3], v[3], q, o;
        const double xi[3] = {gauss[g & 1], gauss[g >> 1 & 1], gauss[g >> 2 & 1]};
        mesh_map_point(s->m->block + p->block, s->m->dim, at, xi, x, dx);
        mesh_exact_at(s, x, t, v, &q, &o);
        for (int c = 0; c < 3; c++)
            u[c] += v[c] / n;
        *pressure += q / n;
        *w += o / n;
    }
}

/* The mean that a cell has: on blocks over its indices. */
void cell_exact(const struct fv *s, const struct part *p, const int *at, double t, double *u,
                double *pressure, double *w)
{
    double x[3], h[3], spare[2];
    if (s->m) {
        average(s, p, at, t, u, pressure ? pressure : spare, w ? w : spare + 1);
        return;
    }
    block_cell(&s->b, at[0], at[1], at[2], x, h);
    exact_average(&s->exact, x, h, t, u, pressure, w);
}

void forcing_average(const struct fv *s, int64_t c, double t, double *v, double *pressure)
{
    int at[3];
    const struct part *p = grid_part(&s->grid, c, at);
    cell_exact(s, p, at, t, v, pressure, NULL);
}

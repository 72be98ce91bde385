/* pack.c - rearranges the first particles so that they fill the room between oblique walls evenly
 * (after Colagrossi, Bouscasse, Antuono & Marrone, Comput. Phys. Commun. 183, 2012): steps along
 * the crowding vector with its wall terms, no flow; then volumes such that the kernel sum is one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph.h"

#include <math.h>

#include "../common/mem.h"
#include "kernel.h"
#include "neighbours.h"
#include "surface.h"
#include "walls.h"

enum { PRIM = 8 };

static void move(struct sph *s, double dt)
{
    const int dim = s->dim;
    for (int i = 0; i < s->p.n; i++) {
        const double *u = s->p.prim + (size_t)PRIM * i + dim;
        const double *u0 = s->p.slope + (size_t)s->p.nslope * i + dim + dim * dim;
        for (int a = 0; a < dim; a++)
            s->p.y[(size_t)i * s->p.nstate + a] += dt * (u0[a] - u[a]);
    }
    s->ready = false;
}

static double kernel_sum(const struct sph *s, int i)
{
    const int dim = s->dim, *j = s->list->j + s->list->start[i];
    const double *x = s->p.prim + (size_t)PRIM * i;
    double sum = x[2 * dim] * kernel_w0(dim, s->R);
    for (int k = 0; k < s->list->count[i]; k++) {
        const double *q = s->p.prim + (size_t)PRIM * j[k];
        double r2 = 0.0;
        for (int a = 0; a < dim; a++)
            r2 += (q[a] - x[a]) * (q[a] - x[a]);
        sum += q[2 * dim] * kernel_w(dim, sqrt(r2), s->R);
    }
    return sum;
}

/* Away from a free surface w = dx^D gamma / sum dx^D W; the mass follows. */
static void set_volumes(struct sph *s)
{
    double *gamma = NEW(double, s->p.n);
    for (int i = 0; i < s->p.n; i++)
        gamma[i] = 1.0;
    if (s->walls->model->gammas)
        s->walls->model->gammas(s, gamma);
    for (int i = 0; i < s->p.n; i++)
        gamma[i] /= kernel_sum(s, i);
    for (int i = 0; i < s->p.n; i++) {
        double *y = s->p.y + (size_t)i * s->p.nstate;
        if (s->surface && s->surface->is[i] != SURFACE_INNER)
            continue;
        for (int k = s->dim; k < s->p.nstate; k++) /* momentum, volume, mass */
            y[k] *= gamma[i];
    }
    mem_free(gamma);
}

/* One step moves by 0.1 R^2 times the crowding vector, at most R/80. */
void pack_start(struct sph *s, int steps)
{
    const int transport = s->prm.transport;
    const double U = 0.1 * s->c0, dt = 0.05 * s->R / U; /* whatever U is, it cancels */
    if (steps <= 0 || !s->walls)
        return;
    s->prm.transport = TRANSPORT_TVS;
    s->packing = true;
    s->shift_speed = U;
    s->skin = 0.05 * s->R;
    for (int k = 0; k < steps; k++) {
        integrate_gradients(s);
        move(s, dt);
        if (k == steps / 2 || k == steps - 1)
            fill_clear_seams(s);
    }
    integrate_gradients(s);
    set_volumes(s);
    s->packing = false;
    s->shift_speed = 0.0;
    s->prm.transport = transport;
    s->ready = false;
}

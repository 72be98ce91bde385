/* fv_forces.c - force of the flow on the walls of the domain. SPDX-License-Identifier: BSD-3-Clause
 */
#include <string.h>

#include "../boundary/bc.h"
#include "../boundary/blocked.h"
#include "../boundary/still.h"
#include "../surface/levelset.h"
#include "output.h"

/* Whether the cell holds no water; whether none stands at the wall, beyond the cell's centre. */
static bool is_dry(const struct fv *s, int64_t c)
{
    return s->surface && s->surface->layer[c] != 0;
}
static bool is_dry_wall(const struct fv *s, int64_t c, int64_t in)
{
    return is_dry(s, c) || (s->surface && 3.0 * s->surface->phi[c] > s->surface->phi[c + in]);
}

double fv_wall_pressure(const double p[3], bool slip)
{
    return slip ? (7.0 * p[0] - p[1]) / 6.0 : (11.0 * p[0] - 7.0 * p[1] + 2.0 * p[2]) / 6.0;
}

/* Of one face of side k, beside the cell at c: the fluxes of the momentum equation, so that walls
 * take what the flow loses. A dry wall feels nothing; beside one that is wet the cell's own
 * pressure counts. */
static void add_face(const struct fv *s, int k, const int *at, double area, double *force)
{
    const struct block *b = &s->b;
    const int a = k / 2;
    const int64_t c = block_at(b, at[0], at[1], at[2]), in = k % 2 ? -b->stride[a] : b->stride[a];
    const double out = k % 2 ? 1.0 : -1.0, mu = s->run->scene.fluid.rho * s->nu;
    double p[3], x[3];
    bool deep = true;
    if (is_blocked(s, c) || is_dry_wall(s, c, in))
        return;
    for (int n = 1; n < 4; n++)
        deep = deep && !is_dry(s, c + n * in);
    for (int n = 0; n < 3; n++)
        p[n] = fv_pressure(s, deep ? c + n * in : c);
    block_centre(b, at[0], at[1], at[2], x);
    x[a] += 0.5 * out * block_size(b, a, at[a]);
    force[a] +=
        out * area *
        (fv_wall_pressure(p, s->bc->kind[k] == MESH_SLIP) + fv_still_pressure(s, x) + s->datum);
    for (int q = 0; q < b->dim; q++) {
        const double *u = s->u[q] + c;
        force[q] += area * mu / (12.0 * block_size(b, a, at[a])) *
                    (15.0 * (u[0] - u[-in]) - (u[in] - u[-2 * in]));
    }
}

static void add_side(const struct fv *s, int k, double *force)
{
    const struct block *b = &s->b;
    const int a = k / 2, t0 = a == 0 ? 1 : 0, t1 = a == 2 ? 1 : 2;
    int at[3];
    at[a] = k % 2 ? b->n[a] - 1 : 0;
    for (at[t1] = 0; at[t1] < b->n[t1]; at[t1]++)
        for (at[t0] = 0; at[t0] < b->n[t0]; at[t0]++)
            add_face(s, k, at, block_size(b, t0, at[t0]) * block_size(b, t1, at[t1]), force);
}

void fv_wall_force(const struct fv *s, double force[3])
{
    block_halo(&s->b, 2, (double *const[]){s->p, s->p_before}); /* a rank may have three rows */
    memset(force, 0, 3 * sizeof(double));
    for (int k = 0; s->bc && k < 2 * s->b.dim; k++)
        if (s->bc->n[k] > 0 && (s->bc->kind[k] == MESH_WALL || s->bc->kind[k] == MESH_SLIP))
            add_side(s, k, force);
    MPI_Allreduce(MPI_IN_PLACE, force, 3, MPI_DOUBLE, MPI_SUM, s->b.cart);
}

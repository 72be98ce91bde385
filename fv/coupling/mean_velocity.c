/* mean_velocity.c - see mean_velocity.h. Where all sides are periodic and nothing solid is in the
 * way, momentum is conserved and the mean velocity obeys dU/dt = g. Neither program knows the
 * other's momentum, and what one takes from the other is not what it gives to it: carried at
 * 2 U_0 past a box for a length, Taylor-Green vortices gained 2e-4 U_0 of mean velocity, nine
 * tenths of their whole error, which nothing in such a flow takes back. But through each plane of
 * cells across an axis flows the same volume, that of the mean velocity, as the flow is
 * incompressible. So the planes that hold no imposed cell tell U, and the computed cells gain a
 * part of what is missing. The next projection shares it out around the box.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mean_velocity.h"

#include "../boundary/fv_boundary.h"

/* Of what is missing, a coupling step: errors of the particles' density, by which the flow through
 * the box breathes, average out over some. Between 0.03 and 1 the results differ by a tenth. */
static const double share = 0.2;

/* Nothing in the scene may take momentum from the flow. */
bool mean_velocity_is_known(const struct fv *s)
{
    const struct scene *c = &s->run->scene;
    bool periodic = true;
    for (int a = 0; a < s->dim; a++)
        periodic = periodic && c->domain.periodic[a];
    return periodic && s->grid.even && !s->grid.even->rows && !s->surface && c->nwalls == 0 &&
           c->nbodies == 0 && c->nshapes == 0 && s->prm.nboxes == 0;
}

/* Planes of cells across each axis, of the whole grid, one axis after the other: 1 where none of
 * its cells is imposed. Owned by the caller. Collective. */
static unsigned char *clear_planes(const struct fv *s, const int first[3], int n)
{
    unsigned char *clear = NEW(unsigned char, n);
    memset(clear, 1, (size_t)n);
    FLOW_ROWS (s, at, len)
        for (int64_t c = at; c < at + len; c++) {
            int i[3];
            const struct part *p = grid_part(&s->grid, c, i);
            for (int a = 0; a < s->dim && s->forcing->forced[c]; a++)
                clear[first[a] + p->lo[a] + i[a]] = 0;
        }
    MPI_Allreduce(MPI_IN_PLACE, clear, n, MPI_UNSIGNED_CHAR, MPI_MIN, s->comm);
    return clear;
}

/* m/s: mean of u_a over the clear planes across each axis a; NAN where all hold imposed cells. */
static void mean_through_planes(const struct fv *s, double mean[3])
{
    const int *n = grid_cells(&s->grid, 0), first[3] = {0, n[0], n[0] + n[1]};
    unsigned char *clear = clear_planes(s, first, n[0] + n[1] + n[2]);
    double sum[2][3] = {{0.0}};
    FLOW_ROWS (s, at, len)
        for (int64_t c = at; c < at + len; c++) {
            int i[3];
            const struct part *p = grid_part(&s->grid, c, i);
            for (int a = 0; a < s->dim; a++)
                if (clear[first[a] + p->lo[a] + i[a]]) {
                    sum[0][a] += s->u[a][c];
                    sum[1][a] += 1.0;
                }
        }
    mem_free(clear);
    MPI_Allreduce(MPI_IN_PLACE, sum, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int a = 0; a < 3; a++)
        mean[a] = sum[1][a] > 0.0 ? sum[0][a] / sum[1][a] : NAN;
}

/* Imposed cells have the partner's. */
void mean_velocity_relax(struct fv *s)
{
    double mean[3];
    mean_through_planes(s, mean);
    for (int a = 0; a < s->dim; a++) {
        const double U = s->run->scene.initial.velocity[a] + s->gravity.periodic[a] * s->t,
                     more = isnan(mean[a]) ? 0.0 : share * (U - mean[a]);
        FLOW_ROWS (s, at, len)
            for (int64_t c = at; c < at + len; c++)
                s->u[a][c] += s->forcing->forced[c] ? 0.0 : more;
    }
    grid_fill(&s->grid, s->dim, s->u);
}

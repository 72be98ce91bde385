/* flow_forces.c - forces on walls and bodies, and the work that comes in through sides: sums over
 * their faces, whatever the cells. One loop over faces (sides_visit) calls the kind of cells' own
 * face_force or face_power; bodies are boxes that are cut out or blocks. Called for rows of the
 * series and, for the power, by the watch of the energy.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <assert.h>

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "face_share.h"
#include "flow_measures.h"
#include "flow_ops.h"

static_assert((int)FLOW_BODIES_MAX >= (int)BLOCKED_MAX &&
                  (int)FLOW_BODIES_MAX >= (int)MESH_BLOCKS_MAX,
              "a body is a box or a block");

/* Blocks, of which those without a wall have no force, or boxes. */
int flow_bodies(const struct fv_params *prm)
{
    return prm->blocks.n > 0 ? prm->blocks.n : prm->nboxes;
}

/* Both pressures: fv_pressure extrapolates them in time. */
static void pressure_ghosts(struct fv *s)
{
    double *both[2] = {s->p, s->p_before};
    grid_fill(&s->grid, 2, both); /* a rank may have three rows */
    for (int k = 0; k < 2 && s->sides; k++)
        (face_mirrors_pressure(s) ? mesh_bc_whole_pressure : mesh_bc_pressure)(s, both[k]);
}

struct forces {
    const struct fv *s;
    double sum[1 + FLOW_BODIES_MAX][4]; /* on walls that are no body's; on each body */
};

/* Walls only; sum[0] collects those that are no body's. */
static void add_force(const struct side_face *f, void *with)
{
    struct forces *x = with;
    double force[4] = {0.0};
    if (!side_is_wall(f->kind) || f->once == 0.0)
        return;
    x->s->ops->face_force(x->s, f, force);
    for (int q = 0; q < 4; q++)
        x->sum[f->body][q] += f->once * force[q];
}

/* all is what the bodies and all other walls feel together. One reduction. */
void flow_forces(struct fv *s, double (*body)[4], double all[4])
{
    const int n = flow_bodies(&s->prm);
    struct forces x = {.s = s};
    pressure_ghosts(s);
    if (s->surface && s->m)
        surface_ghosts(s, s->surface->phi);
    sides_visit(s, add_force, &x);
    if (s->blocked)
        sides_visit_boxes(s, add_force, &x);
    MPI_Allreduce(MPI_IN_PLACE, x.sum, 4 * (1 + n), MPI_DOUBLE, MPI_SUM, s->comm);
    if (body)
        memcpy(body, x.sum[1], (size_t)n * sizeof *body);
    memcpy(all, x.sum[0], sizeof x.sum[0]);
    for (int k = 1; k <= n; k++)
        for (int q = 0; q < 4; q++)
            all[q] += x.sum[k][q];
}

struct power {
    const struct fv *s;
    double sum;
};

static void add_power(const struct side_face *f, void *with)
{
    struct power *x = with;
    x->sum += f->once * x->s->ops->face_power(x->s, f);
}

/* This rank's part; the caller sums. */
double flow_power(struct fv *s)
{
    struct power x = {.s = s};
    pressure_ghosts(s);
    sides_visit(s, add_power, &x);
    return x.sum;
}

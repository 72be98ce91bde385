/* mesh_watches.c - the sums behind the watches on blocks. SPDX-License-Identifier: BSD-3-Clause */
#include "watches.h"

#include <math.h>

#include "../boundary/mesh_bc.h"
#include "../fv.h"
#include "../grid/mesh.h"
#include "../surface/levelset.h"
#include "../surface/mesh_view.h"

static const int none[3] = {0, 0, 0};

static bool has_sides(const struct mesh *m)
{
    for (int k = 0; k < m->nblocks; k++)
        for (int q = 0; q < 2 * m->dim; q++)
            if (m->block[k].side[q] >= MESH_WALL)
                return true;
    return false;
}

/* Where blocks overlap a strip of the flow counts twice, and interpolation does work; where
 * a surface crosses cells at a slant, the work of gravity is known to a few per cent: ten times the
 * levels. With a surface the run ends where most of the energy there is has come from nowhere
 * within the last steps: water at rest that grows never gains more than all it has. */
#define MOST_OF_IT 0.7
struct watches *mesh_watches_create(struct fv *s)
{
    struct watches *w =
        watches_create(s->run, &s->prm, !has_sides(s->m) && !s->surface, s->surface != NULL);
    if (s->m->has_fringe || (s->surface && s->surface->mesh->slanting)) {
        w->energy.warn *= 10.0;
        w->energy.stop = s->surface ? MOST_OF_IT : 10.0 * w->energy.stop;
        w->least = 1e-6; /* work of rough velocities that hardly move is not known at all */
    }
    if (s->m->has_fringe && s->surface)
        w->energy.likely = "the step or the cells are too large for this flow (fv.cfl at half its "
                           "value tells which), or a block ends where the surface runs along its "
                           "side: let it end some cells further up or down";
    bool open = false;
    for (int k = 0; k < s->m->nblocks; k++)
        for (int side = 0; side < 2 * s->m->dim; side++)
            open = open || s->m->block[k].side[side] == MESH_INFLOW ||
                   s->m->block[k].side[side] == MESH_OUTFLOW ||
                   s->m->block[k].side[side] == MESH_CARRIED;
    if (open)
        watches_open(w);
    double walls = 0.0; /* friction at a moving one is not known beside a surface */
    mesh_bc_rate(s, &walls);
    MPI_Allreduce(MPI_IN_PLACE, &walls, 1, MPI_DOUBLE, MPI_MAX, s->comm);
    w->has_energy =
        !s->prm.steady && !s->m->moves && !s->forcing && !(s->surface && (walls > 0.0 || open));
    w->has_growth = !s->newton && !s->surface && !s->m->moves; /* as on even cells */
    w->energy_every = s->surface ? 1 : 20;                     /* faces are mapped anew */
    w->speed = fmax(w->speed, s->reference); /* of walls and openings of blocks, too */
    return w;
}

void mesh_watches_energy(struct fv *s, double sums[6])
{
    const struct mesh *m = s->m;
    for (int q = 0; q < m->nparts; q++)
        PART_ROWS (m->part + q, none, none, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double w = s->surface ? surface_cell_volume(s, i, j_) * surface_share(s, i)
                                            : s->free[i] * m->V[i];
                double square = 0.0;
                for (int a = 0; a < m->dim; a++) {
                    sums[a] += w * s->u[a][i];
                    square += s->u[a][i] * s->u[a][i];
                }
                sums[3] += 0.5 * w * square;
                sums[4] += w;
            }
    if (!s->watches->periodic && !s->surface)
        sums[5] = mesh_bc_power(s);
}

/* Fourth differences over 16, of cells whose neighbours are computed on this rank, too. All cells
 * count alike: far ones, much larger, would drown those that matter. */
static double squares(const struct fv *s, const double *q)
{
    const struct mesh *m = s->m;
    double sum = 0.0;
    for (int b = 0; b < m->nparts; b++)
        for (int a = 0; a < m->dim; a++) {
            const int64_t d = m->part[b].stride[a];
            PART_ROWS (m->part + b, none, none, c, n)
                for (int64_t i = c; i < c + n; i++) {
                    const double v =
                        (q[i - 2 * d] + q[i + 2 * d]) - 4.0 * (q[i - d] + q[i + d]) + 6.0 * q[i];
                    const double in = s->free[i - 2 * d] * s->free[i - d] * s->free[i] *
                                      s->free[i + d] * s->free[i + 2 * d];
                    sum += in > 0.0 ? v * v / 256.0 : 0.0;
                }
        }
    return sum;
}

static void add_moments(const struct fv *s, const double *q, double sums[3])
{
    const struct mesh *m = s->m;
    for (int b = 0; b < m->nparts; b++)
        PART_ROWS (m->part + b, none, none, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double w = s->free[i] > 0.0 ? 1.0 : 0.0, v = w > 0.0 ? q[i] : 0.0;
                sums[0] += w;
                sums[1] += w * v;
                sums[2] += w * v * v;
            }
}

void mesh_watches_waves(const struct fv *s, double sums[6])
{
    double of[3] = {0.0};
    for (int a = 0; a < s->dim; a++) {
        sums[0] += squares(s, s->u[a]);
        add_moments(s, s->u[a], of);
    }
    sums[1] = of[2];
    sums[2] = squares(s, s->p);
    add_moments(s, s->p, sums + 3);
}

/* mesh_state.c - the state of a flow on blocks, at t = 0 or from a restart file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"

#include "../coupling/fv_coupling.h"
#include "../time/fv_time.h"
#include "../watch/fv_watch.h"
#include "fv_case.h"

/* Edges of the box around a cell, m. */
static void extent(const struct mesh_block *b, int dim, const int *at, double *h)
{
    for (int a = 0; a < 3; a++) {
        double lo = INFINITY, hi = -INFINITY;
        for (int k = 0; k < 1 << dim; k++) {
            const double *x =
                b->x[mesh_vertex(b, at[0] + (k & 1), at[1] + (k >> 1 & 1), at[2] + (k >> 2))];
            lo = fmin(lo, x[a]);
            hi = fmax(hi, x[a]);
        }
        h[a] = hi - lo;
    }
}

/* Cells of holes may be computed later where blocks or a partner's box move: there they are filled,
 * too. */
static void fill(struct fv *s)
{
    const struct mesh *m = s->m;
    const bool at_rest = s->run->scene.initial.field == FIELD_REST || s->prm.ring;
    const bool shapes_move = scene_shapes_move(&s->run->scene);
    const bool all =
        m->moves || s->partners.moves[0] || s->partners.moves[1] || s->partners.moves[2];
    double least = INFINITY, most = 0.0;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_CELLS (p, i, c) {
            double u[3], h[3], pr;
            if (m->status[c] == CELL_HOLE && !all)
                continue;
            cell_exact(s, p, i, 0.0, u, &pr, NULL);
            if (at_rest)
                memset(u, 0, sizeof u);
            const struct mesh_block *b = m->block + p->block;
            const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
            if (shapes_move) {
                extent(b, m->dim, at, h);
                fv_shape_velocity(s, b->centre[mesh_cell(b, at)], h, u);
            }
            for (int a = 0; a < m->dim; a++)
                s->u[a][c] = u[a];
            pr -= scene_has_wave(&s->run->scene) ? fv_still_pressure(s, b->centre[mesh_cell(b, at)])
                                                 : 0.0;
            s->p[c] = s->p_before[c] = at_rest ? 0.0 : pr / s->run->scene.fluid.rho;
            s->free[c] = m->status[c] == CELL_COMPUTED;
            least = fmin(least, m->V[c]);
            most = fmax(most, m->V[c]);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, m->comm);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, m->comm);
    s->m->uneven = most > (1.0 + 1e-9) * least;
    for (int q = 0; q < m->nparts; q++) { /* no number in a ghost is a NaN or a zero volume */
        const struct part *p = m->part + q;
        for (int64_t c = p->base; c < p->base + p->size; c++)
            if (!(m->V[c] > 0.0))
                m->V[c] = 1.0;
    }
}

void mesh_state_create(struct fv *s)
{
    struct faults faults = {0};
    struct run *r = s->run;
    double box[PARTNERS_MAX][2][3];
    if (r->coupled)
        coupling_boxes(s, box);
    s->m = r->coupled
               ? mesh_take(r, &s->prm.blocks, s->partners.n, (const double(*)[2][3])box, &faults)
               : mesh_take(r, &s->prm.blocks, fv_hole(&s->prm) != NULL, fv_hole(&s->prm), &faults);
    mem_own(s, s->m);
    if (!s->m && r->coupled)
        coupling_refuse(s, faults.text);
    if (!s->m)
        abort_run("the blocks were good when they were checked");
    s->dim = s->m->dim;
    s->comm = s->m->comm;
    s->size = s->m->size_local;
    s->grid = (struct grid){s->dim, s->m->nparts, s->m->part, NULL, s->m};
    s->ops = &block_ops;
    if (s->prm.upwind < 0.0)
        s->prm.upwind = limits_upwind(r, mesh_bc_has_walls(s->m), (double)s->m->cells);
    if (s->prm.integrator == INTEGRATOR_NEWTON) {
        s->prm.upwind = 0.0;
        s->prm.dissipation = newton_dissipation(s);
    }
    fv_make_fields(s);
    fill(s);
    s->viscous = mem_own(s, viscous_solver_create(s));
    mesh_bc_create(s);
    s->moving = mem_own(s, moving_create(s));
    s->surface = mem_own(s, levelset_create(s));
    if (r->coupled)
        fv_coupling_create(s);
    else if (s->m->has_given)
        s->forcing = mem_own(s, forcing_create(s, 0, NULL, false));
    poisson_create(s);
    sides_velocity(s, BC_GIVEN, s->u);
    if (s->outflows) {
        outflow_start(s);
        mesh_bc_velocity(s, BC_GIVEN, s->u);
    }
    if (s->surface)
        surface_start(s);
    measure(s);
    double speed = 0.0;
    mesh_bc_rate(s, &speed);
    s->speed.scene = fmax(ranks_max(s->comm, speed), limits_reference(r));
    s->speed.decay = limits_decay(&s->run->scene);
    for (int k = 0; k < s->m->nblocks && s->moving; k++)
        if (s->m->block[k].motion)
            s->speed.scene = fmax(s->speed.scene, s->m->block[k].motion->speed);
    s->speed.reference = fmax(fv_fastest(s), fmax(s->speed.scene, s->speed.partner));
    s->speed.limit = 10.0 * s->speed.reference;
    if (s->prm.integrator == INTEGRATOR_NEWTON)
        s->newton = mem_own(s, newton_create(s));
    s->watches = mem_own(s, fv_watches_create(s));
}

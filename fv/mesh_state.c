/* mesh_state.c - the state of a flow on blocks, at t = 0 or from a restart file; exact values.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_flow.h"

#include <HYPRE_utilities.h>
#include <math.h>
#include <string.h>

#include "../common/log.h"
#include "../common/mem.h"
#include "limits.h"
#include "overset.h"
#include "watches.h"

/* Couette flow in a ring: u_theta = A r + B/r. */
static void ring_at(const struct mesh_flow *s, const double *x, double *u, double *p, double *w)
{
    const struct mesh_block_params *b = s->m->block[s->ring].prm;
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

void mesh_exact_at(const struct mesh_flow *s, const double *x, double t, double *u, double *p,
                   double *w)
{
    if (s->ring >= 0)
        ring_at(s, x, u, p, w);
    else
        exact_point(&s->exact, x, t, u, p, w);
}

void mesh_exact_average(const struct mesh_flow *s, const struct mesh_part *p, const int *i,
                        double t, double *u, double *pressure, double *w)
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

static void make_fields(struct mesh_flow *s)
{
    const struct mesh *m = s->m;
    double **const one[] = {&s->p, &s->p_before, &s->flux, &s->free, &s->scale};
    for (size_t k = 0; k < sizeof one / sizeof one[0]; k++)
        *one[k] = mesh_field(m);
    for (int a = 0; a < 3; a++) {
        double **const all[] = {
            &s->u[a],         &s->U[a],         &s->N[a],        &s->N_old[a], &s->rhs[a],
            &s->delta[a],     &s->step_p[a],    &s->face[a],     &s->grad[a],  &s->krylov[0][a],
            &s->krylov[1][a], &s->krylov[2][a], &s->krylov[3][a]};
        s->start[a] = mesh_field(m);
        s->psi[a] = mesh_field(m);
        for (size_t k = 0; k < sizeof all / sizeof all[0] && (a < m->dim || k == 0); k++)
            *all[k] = mesh_field(m);
    }
}

static void fill(struct mesh_flow *s)
{
    const struct mesh *m = s->m;
    const bool at_rest = s->run->scene.initial.field == FIELD_REST || s->ring >= 0;
    double least = INFINITY, most = 0.0;
    for (int q = 0; q < m->nparts; q++) {
        const struct mesh_part *p = m->part + q;
        int i[3];
        PART_CELLS (p, i, c) {
            double u[3], pr, w, diagonal = 0.0;
            if (m->status[c] == CELL_HOLE)
                continue;
            mesh_exact_average(s, p, i, 0.0, u, &pr, &w);
            for (int a = 0; a < m->dim; a++) {
                s->u[a][c] = at_rest ? 0.0 : u[a];
                diagonal += m->G[a][a][c] + m->G[a][a][c + p->stride[a]];
            }
            s->p[c] = s->p_before[c] = at_rest ? 0.0 : pr / s->run->scene.fluid.rho;
            s->free[c] = m->status[c] == CELL_COMPUTED;
            s->scale[c] = 1.25 * s->nu * diagonal / m->V[c];
            least = fmin(least, m->V[c]);
            most = fmax(most, m->V[c]);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, m->comm);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, m->comm);
    s->uneven = most > (1.0 + 1e-9) * least;
    for (int q = 0; q < m->nparts; q++) { /* no number in a ghost is a NaN or a zero volume */
        const struct mesh_part *p = m->part + q;
        for (int64_t c = p->base; c < p->base + p->size; c++)
            if (!(m->V[c] > 0.0))
                m->V[c] = 1.0;
    }
}

struct mesh_flow *mesh_flow_create(struct run *r, struct h5 *f)
{
    struct mesh_flow *s = NEW(struct mesh_flow, 1);
    struct faults faults = {0};
    HYPRE_Init();
    s->run = r;
    s->prm = *fv_params_of(r);
    s->prm.cfl = limits_cfl(&s->prm);
    s->nu = r->scene.fluid.nu;
    s->t = r->t;
    s->exact = exact_create(&r->scene);
    s->m = mesh_create(r, &faults);
    if (!s->m)
        fail("the blocks were good when they were checked");
    s->ring = mesh_ring(r) ? 0 : -1;
    s->has_exact = fv_measures_errors(r);
    if (s->prm.upwind < 0.0)
        s->prm.upwind = mesh_bc_has_walls(s->m) ? 1.0 : 0.0;
    still_split(&r->scene, s->drive, s->still, &s->level);
    make_fields(s);
    fill(s);
    mesh_bc_create(s);
    mesh_pressure_create(s);
    if (r->scene.nprobes > 0)
        s->search = overset_search(r, s->m);
    mesh_fill(s->m, s->m->dim, s->u);
    mesh_bc_velocity(s, MESH_GIVEN, s->u);
    mesh_measure(s);
    double speed = 0.0;
    mesh_bc_rate(s, &speed);
    MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, s->m->comm);
    s->reference = fmax(fmax(s->umax, speed), limits_reference(r));
    s->u_limit = 10.0 * s->reference;
    s->watches = mesh_watches_create(s);
    if (f && !mesh_restore(s, f))
        mesh_flow_free(&s);
    else if (f)
        mesh_measure(s);
    else
        mesh_project(s, 2, 1.0, 1e-3 * fmin(1.0, s->prm.tol_pressure));
    if (s) {
        s->start_iterations = s->iterations;
        s->iterations = 0;
        mesh_measure(s);
        s->watches->sum_before = s->umax;
        s->reference = fmax(s->reference, s->umax);
    }
    if (s && !f) {
        memset(s->start[2], 0, (size_t)s->m->size_local * sizeof(double));
        memset(s->psi[2], 0, (size_t)s->m->size_local * sizeof(double));
    }
    return s;
}

void mesh_flow_free(struct mesh_flow **sp)
{
    struct mesh_flow *s = *sp;
    if (!s)
        return;
    mesh_pressure_free(&s->pressure);
    mesh_bc_free(&s->bc);
    watches_free(&s->watches);
    overset_free(&s->search);
    mem_free(s->history);
    double *const one[] = {s->p, s->p_before, s->flux, s->free, s->scale};
    for (size_t k = 0; k < sizeof one / sizeof one[0]; k++)
        mem_free(one[k]);
    for (int a = 0; a < 3; a++) {
        double *const all[] = {s->u[a],   s->U[a],     s->N[a],      s->N_old[a],
                               s->rhs[a], s->delta[a], s->step_p[a], s->start[a],
                               s->psi[a], s->face[a],  s->grad[a]};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            mem_free(all[k]);
        for (int k = 0; k < 4; k++)
            mem_free(s->krylov[k][a]);
    }
    mesh_free(&s->m);
    HYPRE_Finalize();
    mem_free(s);
    *sp = NULL;
}

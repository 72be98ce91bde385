/* fv_state.c - struct fv from the case's parameters, at t = 0 or from a restart file. fv_create:
 * the cells (uniform here, blocks in mesh_state.c), the output, then the restart file's fields or
 * those of the case; the latter are projected where an inflow or boxes that are cut out would push
 * the flow at once, and given the pressures of outlets.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include <HYPRE_utilities.h>

#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../coupling/fv_coupling.h"
#include "../grid/fv_grid.h"
#include "../operators/fv_operators.h"
#include "../output/fv_output.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"
#include "../time/fv_time.h"
#include "../watch/fv_watch.h"
#include "fv_case.h"

/* What is solved for along axis a, and its scratch. */
static void make_vectors(struct fv *s, int a)
{
    double **const all[] = {&s->u[a], &s->U[a], &s->rhs[a]};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        *all[k] = NEW_IN(s, double, s->size);
    if (s->m || s->nu > 0.0)
        s->delta[a] = NEW_IN(s, double, s->size);
    if (s->m || a == 0)
        s->faces[a] = NEW_IN(s, double, s->size);
}

/* The fields that every run has; others belong to who needs them. u[2] of blocks in 2D is read by
 * what works with vectors of three. */
void fv_make_fields(struct fv *s)
{
    s->p = NEW_IN(s, double, s->size);
    s->p_before = NEW_IN(s, double, s->size);
    s->flux = NEW_IN(s, double, s->size);
    for (int a = 0; a < s->dim; a++)
        make_vectors(s, a);
    stage_fields_create(s);
    if (s->m) {
        if (s->dim < 3) /* stays 0 */
            s->u[2] = NEW_IN(s, double, s->size);
        s->free = NEW_IN(s, double, s->size);
    }
}

/* Exact averages, in forced cells and ghosts too; p less what gravity makes at rest. */
static void fill(struct fv *s)
{
    const struct block *b = &s->b;
    double x[3], h[3], u[3], p;
    int i[3];
    PART_ALL (&s->whole, i, c) {
        block_cell(b, i[0], i[1], i[2], x, h);
        exact_average(&s->exact, x, h, 0.0, u, &p, NULL);
        fv_shape_velocity(s, x, h, u);
        for (int a = 0; a < b->dim; a++)
            s->u[a][c] = u[a];
        s->p[c] = s->p_before[c] = (p - fv_still_in_exact(s, x)) / s->exact.rho;
    }
}

/* Fluxes that belong to the velocities of the start; the exact field's own are solenoidal averages.
 */
static void fill_fluxes(struct fv *s)
{
    const struct block *b = &s->b;
    double x[3], h[3], u[3];
    for (int a = 0; a < b->dim; a++)
        for (int k = -(b->g[2] > 0); k < b->n[2] + (b->g[2] > 0); k++)
            for (int j = -1; j < b->n[1] + 1; j++)
                for (int i = -1; i < b->n[0] + 1; i++) {
                    block_cell(b, i, j, k, x, h);
                    x[a] -= 0.5 * h[a];
                    exact_face(&s->exact, x, h, a, 0.0, u);
                    h[a] = 0.0;
                    fv_shape_velocity(s, x, h, u);
                    s->U[a][block_at(b, i, j, k)] = u[a];
                }
}

/* Imposed cells are a partner's, or those of fv.hole. */
static void make_forcing(struct fv *s)
{
    double box[PARTNERS_MAX][2][3];
    if (s->run->coupled) {
        coupling_boxes(s, box);
        fv_coupling_create(s);
    } else
        s->forcing = mem_own(s, forcing_create(s, 1, (const double(*)[2][3]) & s->prm.hole, false));
}

/* Forced cells that never get values must not hold those of the start: the largest velocity sets
 * the time step. */
static void empty_hole(struct fv *s)
{
    const struct forcing *f = s->forcing;
    for (int64_t c = 0; f && c < s->b.size; c++)
        if (f->forced[c] == 1 && !f->layer[c]) {
            s->p[c] = s->p_before[c] = 0.0;
            for (int a = 0; a < s->b.dim; a++)
                s->u[a][c] = s->exact.V[a];
        }
}

/* Nothing flows in boxes, nor through them. */
static void empty_boxes(struct fv *s)
{
    for (int a = 0; s->blocked && a < s->b.dim; a++) {
        blocked_zero(s, s->u[a]);
        blocked_zero(s, s->p);
        blocked_zero(s, s->p_before);
        for (int64_t c = s->b.stride[a]; c < s->b.size; c++)
            if (s->blocked->box[c] || s->blocked->box[c - s->b.stride[a]])
                s->U[a][c] = 0.0;
    }
}

/* Velocities beyond ten times the fastest that is known end the run: they are errors. */
static void set_limit(struct fv *s)
{
    const double most = fv_fastest(s);
    s->speed.scene = limits_reference(s->run);
    s->speed.decay = limits_decay(&s->run->scene);
    s->speed.reference = fmax(most, fmax(s->speed.scene, s->speed.partner));
    s->speed.limit = 10.0 * s->speed.reference;
}

void fv_start(struct fv *s)
{
    outflow_start(s);
    sides_velocity(s, BC_GIVEN, s->u);
    sides_fluxes(s, BC_GIVEN, s->U);
    measure(s);
    set_limit(s);
    if (fv_fastest(s) > 0.0)
        pressure_start(s);
}

/* Pressures at outflows drive a flow from rest as gently as they would later: p of the start is
 * their mean, then what goes with the velocities. */
static void meet_pressures(struct fv *s)
{
    double sum = 0.0, n = 0.0, size = 0.0;
    for (int k = 0; k < 2 * s->dim; k++) {
        const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + k);
        if (!w || side_of_wall(w) != MESH_OUTFLOW)
            continue;
        sum += w->pressure / s->run->scene.fluid.rho;
        size += fabs(w->pressure);
        n += 1.0;
    }
    if (size == 0.0)
        return;
    for (int64_t c = 0; c < s->size; c++)
        s->p[c] = s->p_before[c] = sum / n;
    pressure_start(s);
}

/* Mean over the cell at q of a velocity whose averages over its faces are q[0] and q[d]: of fourth
 * order between two cells that flow, of third beside one that does. */
static double mean_of_faces(const double *q, int64_t d, bool low, bool high)
{
    return low && high ? (13.0 * (q[0] + q[d]) - q[-d] - q[2 * d]) / 24.0
           : high      ? (5.0 * q[0] + 8.0 * q[d] - q[2 * d]) / 12.0
           : low       ? (5.0 * q[d] + 8.0 * q[0] - q[-d]) / 12.0
                       : 0.5 * (q[0] + q[d]);
}

/* Cells as their faces: psi of an inflow that starts at once bends at the inlet's own faces, and
 * its gradient left the cells beside them with 4.9, 6.4, 4.0 of 5 m/s. */
static void meet_faces(struct fv *s)
{
    const struct block *b = &s->b;
    block_halo(b, b->dim, s->U);
    for (int a = 0; a < b->dim; a++)
        BLOCK_CELLS (b, i, j, k, c) {
            const int at[3] = {i, j, k};
            const int64_t d = b->stride[a];
            const bool even = a != 1 || !b->rows;
            const bool low = !block_has_side(b, 2 * a) || at[a] > 0;
            const bool high = !block_has_side(b, 2 * a + 1) || at[a] < b->n[a] - 1;
            if (!is_blocked(s, c))
                s->u[a][c] = mean_of_faces(s->U[a] + c, d, even && low && !is_blocked(s, c - d),
                                           even && high && !is_blocked(s, c + d));
        }
    sides_velocity(s, BC_GIVEN, s->u);
}

/* Blocks: the component across an inlet of the cells that stencils of G reach from it. Their lines
 * may turn and lean, so that the other components are not those of faces. */
static void meet_inlet(const struct side_face *f, void *with)
{
    const struct fv *s = with;
    const int64_t d = f->part->stride[f->a];
    for (int k = 0; k < 3 && f->kind == MESH_INFLOW && s->free[f->cell + k * f->in] > 0.0; k++) {
        const int64_t c = f->cell + k * f->in;
        const bool low = k > 0 || f->side % 2 == 1, high = k > 0 || f->side % 2 == 0;
        double across = mean_of_faces(s->U[f->a] + c, d, low, high), S[3], S2 = 0.0;
        for (int q = 0; q < s->dim; q++) {
            S[q] = mean_of_faces(s->m->S[f->a][q] + c, d, low, high);
            S2 += S[q] * S[q];
            across -= S[q] * s->u[q][c];
        }
        for (int q = 0; q < s->dim; q++)
            s->u[q][c] += across * S[q] / S2;
    }
}

/* Blocks start from fluxes without divergence. So do uniform cells with an inflow that starts at
 * once, or boxes in the flow of the start, which push the whole fluid at once: the first step is
 * made for the speeds of that flow. A partner gives its cells later, and a surface's first stage
 * makes its own. */
void fv_project_start(struct fv *s)
{
    const int stage = s->m ? 2 : 0;
    const bool pushes = (sides_give_inflow(s) || s->blocked) && !s->run->coupled;
    if (s->surface || !(s->m || pushes))
        return;
    projection(s, s->t, stage, 1.0, 1e-3 * fmin(1.0, s->prm.tol_pressure));
    s->totals.start_iterations = s->totals.iterations;
    s->totals.iterations = 0;
    memset(s->stages.psi[stage], 0, (size_t)s->size * sizeof(double));
    if (s->m) {
        memset(s->stages.start[stage], 0, (size_t)s->size * sizeof(double));
        sides_visit(s, meet_inlet, s);
        sides_velocity(s, BC_GIVEN, s->u);
    } else {
        meet_faces(s);
    }
    measure(s);
    if (!s->m)
        set_limit(s);
}

/* Heights were checked: some fit. */
static void make_rows(struct fv *s)
{
    const int n = s->b.cells[1], even = (int)s->prm.graded[1];
    double *h = NEW(double, n);
    if (even > 0) {
        const double above = s->prm.graded[0] - s->b.origin[1];
        require(rows_heights(n, even, above, s->b.length[1], h) > 0.0);
        block_set_rows(&s->b, even, h);
    }
    mem_free(h);
}

/* The uniform grid, or one of graded rows. */
static void create_grid(struct fv *s)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double length[3];
    for (int a = 0; a < 3; a++)
        length[a] = d->max[a] - d->min[a];
    block_create(&s->b, s->run->comm, d->dim, s->prm.cells, d->min, length, d->periodic);
    make_rows(s);
    s->dim = d->dim;
    s->comm = s->b.cart;
    s->size = s->b.size;
    s->whole = block_part(&s->b);
    s->grid = (struct grid){d->dim, 1, &s->whole, &s->b, NULL};
    s->ops = &even_ops;
    s->blocked = mem_own(s, blocked_create(s));
    s->bc = mem_own(s, bc_create(s));
    if (s->prm.upwind < 0.0)
        s->prm.upwind = limits_upwind(s->run, s->bc || s->blocked,
                                      (double)s->b.cells[0] * s->b.cells[1] * s->b.cells[2]);
    s->surface = mem_own(s, levelset_create(s));
    fv_make_fields(s);
    fill(s);
    s->viscous = mem_own(s, viscous_solver_create(s));
    fill_fluxes(s);
    make_forcing(s);
    empty_hole(s);
    empty_boxes(s);
    outflow_start(s);
    sides_velocity(s, BC_GIVEN, s->u);
    sides_fluxes(s, BC_GIVEN, s->U);
    if (s->surface)
        surface_start(s);
    poisson_create(s);
    if (s->prm.integrator == INTEGRATOR_NEWTON)
        s->newton = mem_own(s, newton_create(s));
    measure(s);
    set_limit(s);
    s->watches = mem_own(s, fv_watches_create(s));
}

/* Order matters: cells and fields of the case, then those of the restart file in their place; else
 * the start is made free of divergence, given the pressures of outlets, pushed, and the surface's
 * pressure found, each on what those before have left. */
struct fv *fv_create(struct run *r, struct h5 *f)
{
    struct fv *s = NEW(struct fv, 1);
    const bool blocks = mesh_given_count > 0;
    HYPRE_Init();
    s->run = r;
    s->prm = *fv_params_of(r);
    s->prm.cfl = limits_cfl(&s->prm);
    s->nu = r->scene.fluid.nu;
    s->t = r->t;
    s->exact = exact_create(&r->scene);
    s->wave_zones = mem_own(s, wave_zones_create(&r->scene, false));
    s->gravity = still_split(&r->scene);
    if (blocks)
        mesh_state_create(s);
    else
        create_grid(s);
    s->output = mem_own(s, output_create(s));
    if (f && !fv_restore(s, f)) {
        fv_free(&s);
        return NULL;
    }
    if (!f) {
        fv_project_start(s);
        meet_pressures(s);
    }
    measure(s);
    if (!f) {
        if (s->moving)
            mesh_bc_meet_water(s);
        /* newton's steps in blocks at rest are longer than what such a flow lasts */
        if (!s->run->coupled && (!s->newton || s->moving))
            push_start(s);
        s->totals.start_iterations += s->totals.iterations;
        s->totals.iterations = 0;
        if (!s->run->coupled) /* a partner gives its cells later: coupling_first */
            pressure_meet_surface(s);
    }
    r->mean_discharges = s->surface && s->surface->fraction && s->surface->fraction->passed[0];
    s->watches->sum_before = s->max.u[0] + s->max.u[1] + s->max.u[2];
    if (f)
        s->speed.limit = 10.0 * s->speed.reference;
    else
        s->speed.reference = fmax(s->speed.reference, fv_fastest(s));
    return s;
}

/* The libraries' objects go with their owners, before hypre and the grid's communicator do. */
void fv_free(struct fv **sp)
{
    struct fv *s = *sp;
    if (!s)
        return;
    const bool even = !s->m;
    struct block b = s->b;
    mem_free(s);
    HYPRE_Finalize();
    if (even)
        block_free(&b);
    *sp = NULL;
}

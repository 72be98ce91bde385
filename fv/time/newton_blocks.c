/* newton_blocks.c - the equations of newton.h on blocks: the operators of mesh_ops.h, averages over
 * indices. Where no side gives the pressure, the mean of the divergence is taken out of the
 * continuity: interpolated fluxes do not sum to zero. A free surface stands still within a step, as
 * on even cells (newton_even.c). SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"
#include "newton.h"

/* Flux through a face relative to it. */
static double relative_flux(const struct fv *s, int a, int64_t face)
{
    return s->U[a][face] - (s->moving ? s->m->grid[a][face] : 0.0);
}

/* Rate at which a cell is crossed and diffused through, 1/s. */
static double rate_of(const struct fv *s, int64_t c, const int64_t *stride)
{
    double sum = 0.0;
    for (int a = 0; a < s->dim; a++)
        sum += 0.5 * (fabs(relative_flux(s, a, c)) + fabs(relative_flux(s, a, c + stride[a]))) +
               s->nu * (s->m->G[a][a][c] + s->m->G[a][a][c + stride[a]]);
    return sum / s->m->V[c];
}

/* Rates of the cells, which d = 1/(c0 + rate) of the fluxes is made of, and the scales of KINSOL: p
 * counts as U^2, velocities as U, a continuity residual as that of a velocity over h, one of
 * momentum over the time in which the cell forgets. */
static void set_rates(struct fv *s)
{
    struct newton *w = s->newton;
    struct newton_step *o = &w->of;
    double *u = N_VGetArrayPointer(w->uscale), *f = N_VGetArrayPointer(w->fscale);
    int64_t k = 0;
    o->U = fmax(s->max.u[0], s->speed.scene);
    o->rate = 0.0;
    for (int64_t c = 0; c < s->size; c++)
        w->d[c] = 1.0 / o->c0;
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++, k++) {
            const double rate = s->free[i] > 0.0 ? rate_of(s, i, part->stride) : 0.0;
            const double h = pow(s->m->V[i], 1.0 / s->dim);
            const double scale = s->prm.steady && rate > 0.0 ? 1.0 / rate : 1.0 / (o->c0 + rate);
            o->rate = fmax(o->rate, rate);
            w->d[i] = 1.0 / (o->c0 + rate);
            u[k] = 1.0 / (o->U * o->U);
            f[k] = h / o->U;
            for (int a = 1; a <= s->dim; a++) {
                u[k + a * w->cells] = 1.0 / o->U;
                f[k + a * w->cells] = scale / o->U;
            }
        }
    MPI_Allreduce(MPI_IN_PLACE, &o->rate, 1, MPI_DOUBLE, MPI_MAX, s->comm);
    mesh_fill(s->m, 1, &w->d);
}

/* U += d [avg(G p).S - flux of p] of the faces between cells, the second as the pressure matrix has
 * it. */
static void add_pressure_flux(struct fv *s)
{
    const struct mesh *m = s->m;
    double *const *G = s->newton->G, *const *E = s->rhs, *d = s->newton->d;
    for (int a = 0; a < s->dim; a++)
        memset(E[a], 0, (size_t)s->size * sizeof(double));
    mesh_subtract_psi(s, 1.0, s->p, E);
    for (int a = 0; a < s->dim; a++)
        for (int q = 0; q < s->grid.nparts; q++) {
            const struct part *p = s->grid.part + q;
            const int64_t below = p->stride[a];
            int down[3], up[3];
            for (int k = 0; k < 3; k++)
                down[k] = up[k] = k < s->dim && k != a;
            up[a] = 1;
            const double *open = s->surface ? s->surface->open[a] : m->open[a];
            PART_ROWS (p, down, up, c, n)
                for (int64_t i = c; i < c + n; i++) {
                    double mean = 0.0;
                    if (open[i] != 1.0 || m->status[i] == CELL_HOLE ||
                        m->status[i - below] == CELL_HOLE)
                        continue;
                    for (int k = 0; k < s->dim; k++)
                        mean += 0.5 * (G[k][i] + G[k][i - below]) * m->S[a][k][i];
                    s->U[a][i] += 0.5 * (d[i] + d[i - below]) * (mean + E[a][i]);
                }
        }
}

/* Velocity and pressure beyond the surface, and the pressure on it. */
static void extend_state(struct fv *s)
{
    extension_apply(s, s->u, EXTEND_SHEAR, STENCILS);
    surface_set_pressure(s);
    extension_scalar(s, s->p);
}

/* The gradient that carries on is that of water; the first two layers of air are what averages on
 * faces read. */
static void extend_gradient(struct fv *s)
{
    surface_mesh_psi_gradient(s, 1.0 / s->newton->of.c0, s->p, false, s->newton->G);
    for (int a = 0; a < s->dim; a++)
        extension_scalar(s, s->newton->G[a]);
}

/* Ghosts, gradient of p, fluxes of the state. */
static void complete(struct fv *s)
{
    if (s->surface)
        extend_state(s);
    if (s->forcing) {
        forcing_velocity(s, s->newton->of.t, s->u);
        forcing_extend(s, 1, s->p); /* for slopes along faces */
    }
    sides_velocity(s, BC_GIVEN, s->u);
    mesh_fill(s->m, 1, &s->p);
    s->ops->pressure_gradient(s, s->p, s->newton->G);
    if (s->surface)
        extend_gradient(s);
    mesh_fill(s->m, s->dim, s->newton->G);
    mesh_face_velocities(s, s->u, s->U);
    add_pressure_flux(s);
    if (s->surface)
        surface_mesh_interpolate(s, s->newton->d, s->newton->G);
    mesh_bc_fluxes(s, s->U);
    if (s->forcing)
        forcing_fluxes(s, s->newton->of.t, s->U);
}

/* q -= its mean over the volumes, if no side gives the pressure: what the overlap makes. */
static void remove_mean(struct fv *s, double *q)
{
    double sums[2] = {0.0, 0.0};
    if (mesh_bc_pressure_given(s) || (s->surface && s->surface->cuts > 0))
        return;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double V = s->free[i] > 0.0 ? s->m->V[i] : 0.0;
            sums[0] += V > 0.0 ? V * q[i] : 0.0;
            sums[1] += V;
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            q[i] -= sums[0] / sums[1];
}

/* m^3/s -> 1/s, so that small cells count as large ones in the norm. */
static void per_volume(const struct fv *s, double *q)
{
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            q[i] /= s->m->V[i];
}

/* Leaves the momentum's residual without its derivative in time in s->rhs, along indices, and the
 * divergence in s->faces[0]. */
static void evaluate(struct fv *s)
{
    struct newton *w = s->newton;
    complete(s);
    mesh_convection(s, s->stages.N);
    for (int a = 0; a < s->dim; a++) {
        if (s->nu > 0.0)
            mesh_viscous(s, s->u[a], s->delta[a]);
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                s->rhs[a][i] =
                    s->stages.N[a][i] + w->G[a][i] - s->delta[a][i] - s->gravity.periodic[a];
    }
    s->ops->to_index(s);
    mesh_divergence(s, s->U, s->faces[0]);
    per_volume(s, s->faces[0]);
    remove_mean(s, s->faces[0]);
}

/* First-order upwind, as on even cells; what lies behind closed sides goes into the diagonal, with
 * ghosts that are odd (walls) or even (outflow); given cells do not vary. Cells that are not
 * computed get rows of their own. */
static void fill_rows(struct fv *s)
{
    const struct mesh *m = s->m;
    double *const *A = s->newton->A;
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            A[0][i] = s->newton->of.c0;
            for (int e = 1; e <= 2 * s->dim; e++) {
                const int a = (e - 1) / 2;
                const int64_t d = part->stride[a], face = e % 2 ? i : i + d,
                              to = e % 2 ? i - d : i + d;
                const double U = relative_flux(s, a, face), in = e % 2 ? U : -U;
                const double w = (0.5 * (in + fabs(in)) + 1.2 * s->nu * m->G[a][a][face]) / m->V[i];
                const bool inside = m->status[to] < CELL_HOLE;
                A[e][i] = s->free[i] > 0.0 && inside ? -w : 0.0;
                A[0][i] += inside || m->status[to] == CELL_GIVEN ? w
                           : m->open[a][face] == 1.0             ? 0.0
                                                                 : 2.0 * w;
            }
            A[0][i] = s->free[i] > 0.0 ? A[0][i] : 1.0;
        }
    if (s->prm.c0 > 0.0)
        poisson_shift(s, pow(s->newton->of.c0 / s->prm.c0, 2.0));
}

/* The diagonal of -Lap of the cells, 1/m^2. */
static void laplacian(const struct fv *s, double *out)
{
    const struct mesh *m = s->m;
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            out[i] = 0.0;
            for (int a = 0; a < s->dim; a++)
                out[i] += (m->G[a][a][i] + m->G[a][a][i + part->stride[a]]) / m->V[i];
        }
}

/* Averages of x on the faces; through sides and cells of other treatment nothing passes but what
 * openings let. */
static void subtract_divergence(struct fv *s, double *const x[3], double *div)
{
    const struct mesh *m = s->m;
    const struct newton *w = s->newton;
    FLOW_ROWS_AT (s, part, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double sum = 0.0;
            for (int a = 0; a < s->dim; a++) {
                const int64_t d = part->stride[a];
                for (int k = 0; k < s->dim; k++) {
                    const double *u = x[k] + i;
                    sum += m->S[a][k][i + d] * (u[d] + u[0]) *
                               (m->status[i + d] >= CELL_HOLE && m->open[a][i + d] != 1.0 ? 0.0
                                                                                          : 0.5) -
                           m->S[a][k][i] * (u[0] + u[-d]) *
                               (m->status[i - d] >= CELL_HOLE && m->open[a][i] != 1.0 ? 0.0 : 0.5);
                }
            }
            w->phi[i] = s->free[i] > 0.0 ? sum / m->V[i] : 0.0;
        }
    if (s->prm.c0 > 0.0) /* else the cycle takes it out */
        remove_mean(s, w->phi);
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            div[i] -= w->phi[i];
}

const struct newton_cells newton_blocks = {.set_rates = set_rates,
                                           .evaluate = evaluate,
                                           .fill_rows = fill_rows,
                                           .laplacian = laplacian,
                                           .subtract_divergence = subtract_divergence};

/* even_ops.c - the operators of a stage on uniform cells and on layers. Fills the table flow_ops
 * for them, with imposed cells, boxes that are cut out and a free surface; convection.c, viscous.c
 * and gradient.c have the stencils. psi_ghosts and to_index are NULL: the solver sets the ghosts of
 * psi itself, and averages over volumes are those over indices. Loops go over the cells near water
 * alone (BLOCK_NEAR), most of them over those of water (BLOCK_WET).
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "blocked_cells.h"
#include "flow_ops.h"
#include "helmholtz.h"
#include "operators.h"

/* Only the one-sided differences at sides and boxes excite the odd-even mode. */
static bool smooth_pressure(struct fv *s)
{
    if (!s->bc && !s->blocked)
        return false;
    smooth_odd_even(s, SMOOTHED, s->p, s->faces[0]);
    return true;
}

static void pressure_gradient(struct fv *s, double *p, double *const g[3])
{
    for (int a = 0; a < s->dim; a++)
        gradient(s, p, a, CONTINUE_CUBIC, g[a]);
}

/* What the projection will take off the velocity along walls and boxes. */
static void set_slip(const struct fv *s, double tau, const double *psi)
{
    bc_set_slip(s, tau, psi);
    if (s->blocked)
        blocked_set_slip(s, tau, psi);
}

static void viscous(struct fv *s, int q, double *out)
{
    viscous_apply(s, s->u[q], out);
    if (s->blocked)
        blocked_viscous(s, q, s->u[q], out);
}

/* The increment that forced cells make from one time to another, the start of all others: `scale'
 * times the last stage's. Imposed cells and sides start with the change of their own values. */
static void start_increment(struct fv *s, double t, double scale)
{
    for (int a = 0; a < s->dim; a++) {
        if (scale == 0.0)
            grid_clear_near(&s->grid, s->delta[a]);
        for (int64_t i = 0; i < s->size && scale != 0.0; i++)
            s->delta[a][i] *= scale;
    }
    if (!s->forcing)
        return;
    for (int a = 0; a < s->dim && scale != 0.0; a++)
        forcing_zero(s->forcing, s->delta[a]);
    forcing_velocity(s, t, s->delta);
    bc_ghosts(s, BC_CHANGE, s->delta);
    forcing_subtract(s->forcing, s->u, s->delta);
}

static bool solve_viscous(struct fv *s, double c, double t, double scale)
{
    start_increment(s, t, viscous_keeps_increment(s) ? scale : 0.0);
    return viscous_solve(s, c, s->delta, s->rhs, helmholtz_tolerance(s));
}

static void face_velocities(struct fv *s, double *const u[3], double *const U[3])
{
    convection_face_velocities(s, u, U);
}

/* div (+)= w (U_upper - U_lower) for a row of n cells, w = 1/(h tau). */
static void divide_row(const double *restrict U, int64_t d, double w, bool first, int64_t n,
                       double *restrict div)
{
    for (int64_t i = 0; i < n; i++)
        div[i] = (first ? 0.0 : div[i]) + w * (U[i + d] - U[i]);
}

/* D U over the local cells, divided by tau; with the surface's pressure. In rhs[0], as
 * poisson_solve wants it. */
static double *divergence(struct fv *s, double tau)
{
    const struct block *b = &s->b;
    double *restrict div = s->rhs[0];
    for (int a = 0; a < b->dim; a++) {
        const int64_t d = b->stride[a];
        const double *restrict U = s->U[a];
        BLOCK_WET_AT (s, 0, j, c, n)
            divide_row(U + c, d, 1.0 / (block_size(b, a, j) * tau), a == 0, n, div + c);
    }
    if (s->surface)
        surface_add_pressure(s, div);
    return div;
}

/* U -= w open (psi - psi_lower); open NULL: all faces are open. */
static void subtract_row(double *restrict U, const double *restrict psi, int64_t d, double w,
                         const double *restrict open, int64_t n)
{
    if (open)
        for (int64_t i = 0; i < n; i++)
            U[i] -= w * open[i] * (psi[i] - psi[i - d]);
    else
        for (int64_t i = 0; i < n; i++)
            U[i] -= w * (psi[i] - psi[i - d]);
}

/* U by second-order differences, as the matrix has them; grad psi into rhs by fourth order. Faces
 * of imposed cells are closed (open = 0), the surface's have their own coefficients. */
static void correct_fluxes(struct fv *s, double tau, double *psi)
{
    const struct block *b = &s->b;
    double *const *open = s->surface ? s->surface->open : s->forcing ? s->forcing->open : NULL;
    for (int a = 0; a < b->dim; a++) {
        gradient(s, psi, a, CONTINUE_EVEN, s->rhs[a]);
        if (s->surface) {
            levels_gradient(s, a, s->rhs[a]);
            surface_gradient(s, a, psi, s->rhs[a]);
        }
        if (s->forcing)
            forcing_zero(s->forcing, s->rhs[a]);
        BLOCK_WET_AT (s, 1, j, c, n)
            subtract_row(s->U[a] + c, psi + c, b->stride[a], tau / block_step(b, a, j),
                         open ? open[a] + c : NULL, n);
    }
}

/* Of a change of psi, with nothing imposed. */
static void change_gradient(struct fv *s, double *phi, double *const g[3])
{
    for (int a = 0; a < s->dim; a++) {
        gradient(s, phi, a, CONTINUE_EVEN, g[a]);
        if (s->surface)
            surface_gradient_change(s, a, phi, g[a]);
    }
}

/* U of faces between dry cells from the extended velocity, then sides. */
static void dry_fluxes(struct fv *s, bool stencils)
{
    surface_dry_fluxes(s, stencils);
    if (s->blocked)
        blocked_face_velocities(s, s->u, s->U, true);
    bc_fluxes(s, BC_GIVEN, s->U);
}

/* Largest |u_a| and sum of |u_a| w_a of a row of cells (in 2D the third is one of the others). A
 * value that is not finite makes the sum infinite. */
static void measure_row(const double *restrict u, const double *restrict v,
                        const double *restrict w, const double *weight, int64_t n, double *most)
{
    double x = 0.0, y = 0.0, z = 0.0, all = 0.0;
    int64_t bad = 0;
    for (int64_t i = 0; i < n; i++) {
        const double a = fabs(u[i]), b = fabs(v[i]), c = fabs(w[i]);
        const double sum = a * weight[0] + b * weight[1] + c * weight[2];
        x = a > x ? a : x;
        y = b > y ? b : y;
        z = c > z ? c : z;
        all = sum > all ? sum : all;
        bad |= sum < 1e300 ? 0 : 1;
    }
    most[0] = fmax(most[0], x);
    most[1] = fmax(most[1], y);
    most[2] = fmax(most[2], z);
    most[3] = bad ? INFINITY : fmax(most[3], all);
}

/* weight 1/h along each axis; push and motion are for blocks. Collective. */
static void measure_even(struct fv *s, double push, double motion)
{
    const struct block *b = &s->b;
    double most[4] = {0.0, 0.0, 0.0, 0.0};
    (void)push, (void)motion;
    BLOCK_NEAR_AT (s, 0, j, c, n) {
        const double weight[3] = {1.0 / b->h[0], 1.0 / block_size(b, 1, j),
                                  b->dim == 3 ? 1.0 / b->h[2] : 0.0};
        measure_row(s->u[0] + c, s->u[1] + c, s->u[b->dim == 3 ? 2 : 1] + c, weight, n, most);
    }
    for (int a = 0; a < 3 && !(most[3] < INFINITY); a++)
        most[a] = INFINITY;
    MPI_Allreduce(MPI_IN_PLACE, most, 4, MPI_DOUBLE, MPI_MAX, b->cart);
    for (int a = 0; a < 3; a++)
        s->max.u[a] = a < b->dim ? most[a] : 0.0;
    s->max.rate = most[3];
}

const struct flow_ops even_ops = {.smooth_pressure = smooth_pressure,
                                  .pressure_gradient = pressure_gradient,
                                  .set_slip = set_slip,
                                  .convection = convection,
                                  .viscous = viscous,
                                  .solve_viscous = solve_viscous,
                                  .face_velocities = face_velocities,
                                  .divergence = divergence,
                                  .correct_fluxes = correct_fluxes,
                                  .change_gradient = change_gradient,
                                  .dry_fluxes = dry_fluxes,
                                  .measure = measure_even,
                                  .face_force = even_face_force,
                                  .face_power = even_face_power};

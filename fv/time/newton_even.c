/* newton_even.c - the equations of newton.h on a uniform grid and on graded rows, and their
 * derivative along a variation, written out. A free surface stands still within a step: dry cells
 * are no unknowns, what they carry on and the normal stress belong to the velocity of the end; the
 * derivative is then made of difference quotients. SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"
#include "../watch/fv_watch.h"
#include "newton.h"

/* ---- faces ---------------------------------------------------------------------------------- */

/* Ghosts of a state at time t, or of a variation: the one place that knows what is imposed. */
static void fill_ghosts(struct fv *s, const struct flow *q, bool variation)
{
    double *fields[4] = {q->p, q->u[0], q->u[1], q->u[2]};
    if (s->forcing && variation) {
        for (int a = 0; a < s->b.dim; a++)
            forcing_zero(s->forcing, q->u[a]);
        forcing_zero(s->forcing, q->p);
    } else if (s->forcing)
        forcing_velocity(s, s->newton->of.t, q->u);
    if (s->surface) {
        extension_apply(s, q->u, EXTEND_SHEAR, STENCILS);
        surface_set_pressure(s);
        extension_scalar(s, q->p);
    }
    bc_ghosts(s, variation ? BC_ZERO : BC_GIVEN, q->u);
    block_halo(&s->b, s->b.dim + 1, fields);
}

/* U += d [avg(G) - (p_R - p_L)/h] of a row, where both cells are free. */
static void add_pressure_flux(double *restrict U, const double *restrict p,
                              const double *restrict G, const double *restrict open, int64_t along,
                              double d, double per_h, int64_t n)
{
    for (int64_t i = 0; i < n; i++) {
        const double e = 0.5 * (G[i - along] + G[i]) - (p[i] - p[i - along]) * per_h;
        U[i] += d * (open && open[i] != 1.0 ? 0.0 : e);
    }
}

/* The same where a face is cut: p is that of the surface. */
static void add_cut_flux(struct fv *s, const struct flow *q)
{
    const struct surface *f = s->surface;
    const double d = s->newton->of.d;
    for (int a = 0; a < s->dim; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++) {
            const struct cut *x = f->cut[a] + i;
            q->U[a][x->face] += d * 0.5 * (q->G[a][x->wet] + q->G[a][x->dry]);
        }
    surface_fluxes(s, d, q->p);
}

/* Ghosts, gradient of p, fluxes. */
static void complete(struct fv *s, const struct flow *q, bool variation)
{
    const struct block *b = &s->b;
    fill_ghosts(s, q, variation);
    for (int a = 0; a < b->dim; a++) {
        gradient(s, q->p, a, variation ? CONTINUE_VARIATION : CONTINUE_CUBIC, q->G[a]);
        if (s->surface)
            surface_gradient(s, a, q->p, q->G[a]);
        if (s->forcing)
            forcing_zero(s->forcing, q->G[a]);
        if (s->surface)
            extension_scalar(s, q->G[a]);
    }
    block_halo(b, b->dim, q->G);
    double *const *open = s->surface ? s->surface->open : s->forcing ? s->forcing->open : NULL;
    convection_face_velocities(s, q->u, q->U);
    for (int a = 0; a < b->dim; a++)
        BLOCK_ROWS_AT (b, 1, j, c, n)
            add_pressure_flux(q->U[a] + c, q->p + c, q->G[a] + c, open ? open[a] + c : NULL,
                              b->stride[a], s->newton->of.d, 1.0 / block_step(b, a, j), n);
    if (s->surface)
        add_cut_flux(s, q);
    if (s->forcing && variation)
        forcing_fluxes_variation(s, q->U);
    else if (s->forcing)
        forcing_fluxes(s, s->newton->of.t, q->U);
    bc_fluxes(s, variation ? BC_ZERO : BC_GIVEN, q->U);
    for (int a = 0; a < b->dim; a++)
        convection_beside_walls(s, a, q->U[a]);
}

/* ---- fluxes --------------------------------------------------------------------------------- */

/* h^3 d^3 q on the face between q[-d] and q[0]. */
static inline double third_difference(const double *q, int64_t d)
{
    return (q[d] - q[-2 * d]) - 3.0 * (q[0] - q[-d]);
}

/* Products of face averages along tangents, and the dissipation. least: |U| below it counts as it,
 * smoothly, for Newton needs a derivative. */
static void flux_row(const double *restrict U, const double *restrict f, const double *restrict q,
                     int64_t along, const int64_t *tangent, int nt, double eps, double least,
                     int64_t n, double *restrict F)
{
    for (int64_t i = 0; i < n; i++)
        F[i] = U[i] * f[i] + eps * sqrt(U[i] * U[i] + least) * third_difference(q + i, along);
    for (int t = 0; t < nt; t++) {
        const int64_t d = tangent[t];
        for (int64_t i = 0; i < n; i++)
            F[i] += (U[i + d] - U[i - d]) * (f[i + d] - f[i - d]) * (1.0 / 48.0);
    }
}

/* The same, varied: dU, df, dq. */
static void flux_variation_row(const double *restrict U, const double *restrict f,
                               const double *restrict q, const double *restrict dU,
                               const double *restrict df, const double *restrict dq, int64_t along,
                               const int64_t *tangent, int nt, double eps, double least, int64_t n,
                               double *restrict F)
{
    for (int64_t i = 0; i < n; i++) {
        const double size = sqrt(U[i] * U[i] + least);
        F[i] = U[i] * df[i] + dU[i] * f[i] +
               eps * (size * third_difference(dq + i, along) +
                      U[i] / size * dU[i] * third_difference(q + i, along));
    }
    for (int t = 0; t < nt; t++) {
        const int64_t d = tangent[t];
        for (int64_t i = 0; i < n; i++)
            F[i] += ((U[i + d] - U[i - d]) * (df[i + d] - df[i - d]) +
                     (dU[i + d] - dU[i - d]) * (f[i + d] - f[i - d])) *
                    (1.0 / 48.0);
    }
}

/* F has one face more than out has cells along the row's axis. */
static void add_difference(const double *restrict F, int64_t along, double per_h, int64_t n,
                           double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] += (F[i + along] - F[i]) * per_h;
}

/* Strides of the axes other than a; returns how many. */
static int tangents(const struct block *b, int a, int64_t *t)
{
    int n = 0;
    for (int k = 0; k < b->dim; k++)
        if (k != a)
            t[n++] = b->stride[k];
    return n;
}

/* out += D F of component q along a; v: NULL, or the variation to take it along. */
static void add_convection(struct fv *s, int q, int a, const struct flow *v, double *out)
{
    const struct block *b = &s->b;
    struct newton *w = s->newton;
    const double eps = newton_dissipation(s), least = 1e-2 * w->of.U * w->of.U;
    int64_t tangent[2];
    const int nt = tangents(b, a, tangent);
    const int64_t along = b->stride[a];
    convection_face_values(s, s->u[q], a, w->face);
    if (v)
        convection_face_values(s, v->u[q], a, w->dface);
    convection_beside_walls(s, a, w->face);
    if (v)
        convection_beside_walls(s, a, w->dface);
    for (int k = 0; k < b->n[2] + (a == 2); k++)
        for (int j = 0; j < b->n[1] + (a == 1); j++) {
            const int64_t c = block_at(b, 0, j, k), n = b->n[0] + (a == 0);
            if (v)
                flux_variation_row(s->U[a] + c, w->face + c, s->u[q] + c, v->U[a] + c, w->dface + c,
                                   v->u[q] + c, along, tangent, nt, eps, least, n, s->flux + c);
            else
                flux_row(s->U[a] + c, w->face + c, s->u[q] + c, along, tangent, nt, eps, least, n,
                         s->flux + c);
        }
    BLOCK_ROWS_AT (b, 0, j, c, n)
        add_difference(s->flux + c, along, 1.0 / block_size(b, a, j), n, out + c);
}

/* ---- space ----- -------------------------------------------------------------------------------
 */

/* s->rhs[q] = D F + G p - nu L u; s->faces[0] = D U. v: NULL, or along this variation. */
static void apply_space(struct fv *s, const struct flow *v)
{
    const struct block *b = &s->b;
    for (int q = 0; q < b->dim; q++) {
        const double *restrict G = v ? v->G[q] : s->newton->G[q];
        double *restrict out = s->rhs[q];
        const double drive = v ? 0.0 : s->gravity.periodic[q];
        if (s->nu > 0.0)
            viscous_apply(s, v ? v->u[q] : s->u[q], out);
        else
            memset(out, 0, (size_t)b->size * sizeof(double));
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                out[i] = G[i] - out[i] - drive;
        for (int a = 0; a < b->dim; a++)
            add_convection(s, q, a, v, out);
    }
    memset(s->faces[0], 0, (size_t)b->size * sizeof(double));
    for (int a = 0; a < b->dim; a++)
        BLOCK_ROWS_AT (b, 0, j, c, n)
            add_difference((v ? v->U[a] : s->U[a]) + c, b->stride[a], 1.0 / block_size(b, a, j), n,
                           s->faces[0] + c);
    if (s->forcing) {
        forcing_zero(s->forcing, s->faces[0]);
        for (int q = 0; q < b->dim; q++)
            forcing_zero(s->forcing, s->rhs[q]);
    }
}

/* The residual of space, of the state as it is in the fields of s. */
static void evaluate(struct fv *s)
{
    struct newton *w = s->newton;
    const struct flow state = {s->p,
                               {s->u[0], s->u[1], s->u[2]},
                               {s->U[0], s->U[1], s->U[2]},
                               {w->G[0], w->G[1], w->G[2]}};
    complete(s, &state, false);
    apply_space(s, NULL);
}

/* Wants evaluate of the state before: fluxes and values on faces are those of the state. */
static void evaluate_variation(struct fv *s)
{
    complete(s, &s->newton->v, true);
    apply_space(s, &s->newton->v);
}

/* Of the fastest cells, the same for all: a scaled residual of 1e-6 is a velocity error of 1e-6 U.
 * A flow at rest counts as a hundredth of the scene's speed, which must not be 0. */
static void set_rates(struct fv *s)
{
    struct newton_step *o = &s->newton->of;
    o->U = 1e-2 * s->speed.scene;
    for (int a = 0; a < s->dim; a++)
        o->U = fmax(o->U, fv_speed(s, a));
    o->rate = 0.0;
    for (int a = 0; a < s->dim; a++)
        o->rate += fv_speed(s, a) / s->b.h[a] + 2.0 * s->nu / (s->b.h[a] * s->b.h[a]);
    o->d = 1.0 / (o->c0 + o->rate);
    o->scale = s->prm.steady && o->rate > 0.0 ? 1.0 / o->rate : o->d;
    const double most = fmin(s->b.h[0], s->b.h[1]);
    double *u = N_VGetArrayPointer(s->newton->uscale), *f = N_VGetArrayPointer(s->newton->fscale);
    for (int64_t i = 0; i < (s->dim + 1) * s->newton->cells; i++) {
        u[i] = i < s->newton->cells ? 1.0 / (o->U * o->U) : 1.0 / o->U;
        f[i] = i < s->newton->cells ? most / o->U : o->scale / o->U;
    }
}

/* ---- preconditioner ------------------------------------------------------------------------- */

/* Rows of A from the fluxes of the state, first-order upwind: less of it converges faster where
 * diffusion or time rule, and diverges where they do not. */
static void fill_open_rows(struct fv *s)
{
    const struct block *b = &s->b;
    struct newton *w = s->newton;
    double *restrict diagonal = w->A[0];
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            diagonal[i] = w->of.c0;
    for (int a = 0; a < b->dim; a++) {
        const double *restrict U = s->U[a];
        double *restrict lower = w->A[1 + 2 * a], *restrict upper = w->A[2 + 2 * a];
        const int64_t d = b->stride[a];
        BLOCK_ROWS_AT (b, 0, j, c, n) {
            const double h = block_size(b, a, j), half = 0.5 / h;
            const double low = 1.2 * s->nu / (h * block_step(b, a, j)),
                         up = 1.2 * s->nu / (h * block_step(b, a, j + 1));
            for (int64_t i = c; i < c + n; i++) {
                const double below = U[i], above = U[i + d];
                lower[i] = -half * (below + fabs(below)) - low;
                upper[i] = half * (above - fabs(above)) - up;
                diagonal[i] += half * (fabs(below) + fabs(above)) + low + up;
            }
        }
    }
}

/* What lies behind the fluid: its coupling leaves the rows, for walls and openings into the
 * diagonal, with ghosts that are odd (walls) or even (outflow); forced cells get rows of their own.
 */
static void close_rows(struct fv *s)
{
    const struct block *b = &s->b;
    const struct forcing *f = s->forcing;
    double *const *A = s->newton->A;
    for (int e = 1; f && e <= 2 * b->dim; e++) {
        const int a = (e - 1) / 2;
        const int64_t d = b->stride[a], face = e % 2 ? 0 : d, to = e % 2 ? -d : d;
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double open = f->open[a][i + face];
                if (open == 1.0)
                    continue;
                if (s->bc && f->forced[i + to] == 2)
                    A[0][i] += open > 1.0 ? A[e][i] : -A[e][i];
                A[e][i] = 0.0;
            }
    }
    for (int64_t i = 0; f && i < f->nlocal; i++) {
        A[0][f->local[i]] = 1.0;
        for (int e = 1; e <= 2 * b->dim; e++)
            A[e][f->local[i]] = 0.0;
    }
}

/* The matrix of pressures is shifted by (c0 over the pseudo speed of sound)^2 (newton_residual.c).
 */
static void fill_rows(struct fv *s)
{
    const double a = s->prm.c0 > 0.0 ? 1.0 / (s->prm.c0 * s->prm.c0) : 0.0, c0 = s->newton->of.c0;
    fill_open_rows(s);
    close_rows(s);
    poisson_shift(s, a * c0 * c0);
}

/* The diagonal of -Lap, 1/m^2. */
static void laplacian(const struct fv *s, double *out)
{
    const struct block *b = &s->b;
    BLOCK_ROWS_AT (b, 0, j, c, n) {
        double sum = 0.0;
        for (int a = 0; a < b->dim; a++)
            sum +=
                (1.0 / block_step(b, a, j) + 1.0 / block_step(b, a, j + 1)) / block_size(b, a, j);
        for (int64_t i = c; i < c + n; i++)
            out[i] = sum;
    }
}

/* div -= D I(x) */
static void subtract_divergence(struct fv *s, double *const x[3], double *restrict div)
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++) {
        const int64_t d = b->stride[a];
        const double *restrict u = x[a];
        const double *restrict open = s->forcing ? s->forcing->open[a] : NULL;
        BLOCK_ROWS_AT (b, 0, j, c, n) {
            const double w = 0.5 / block_size(b, a, j);
            for (int64_t i = c; i < c + n; i++) {
                const double below = open ? fmin(open[i], 1.0) : 1.0,
                             above = open ? fmin(open[i + d], 1.0) : 1.0;
                div[i] -= w * (above * (u[i + d] + u[i]) - below * (u[i] + u[i - d]));
            }
        }
    }
}

const struct newton_cells newton_even = {.set_rates = set_rates,
                                         .evaluate = evaluate,
                                         .evaluate_variation = evaluate_variation,
                                         .fill_rows = fill_rows,
                                         .laplacian = laplacian,
                                         .subtract_divergence = subtract_divergence};

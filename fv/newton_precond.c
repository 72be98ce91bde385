/* newton_precond.c - a fixed linear map close to the inverse of the Jacobian
 *   J = [ A  G ; D  C ]:  A ~ c0 + convection + diffusion, 5-point (7-point);
 *   1  A u* = r_u           symmetric Gauss-Seidel sweeps
 *   2  -Lap phi = r_p - D u*  one V-cycle; p' = A phi, for D A^-1 G ~ Lap A^-1
 *                             (Kay, Loghin & Wathen, SIAM J. Sci. Comput. 24, 2002)
 *   3  u' = u* - G phi
 * SPDX-License-Identifier: BSD-3-Clause */
#include "newton.h"

#include <math.h>
#include <string.h>

#include "bc.h"
#include "forcing.h"
#include "pressure.h"

/* Rows of A from the fluxes of the state, first-order upwind: less of it converges faster where
 * diffusion or time rule, and diverges where they do not. */
static void fill_rows(struct fv *s)
{
    const struct block *b = &s->b;
    struct newton *w = s->newton;
    double *restrict diagonal = w->A[0];
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            diagonal[i] = w->of.c0;
    for (int a = 0; a < b->dim; a++) {
        const double *restrict U = s->U[a], half = 0.5 / b->h[a];
        const double nu = 1.2 * s->nu / (b->h[a] * b->h[a]);
        double *restrict lower = w->A[1 + 2 * a], *restrict upper = w->A[2 + 2 * a];
        const int64_t d = b->stride[a];
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double below = U[i], above = U[i + d];
                lower[i] = -half * (below + fabs(below)) - nu;
                upper[i] = half * (above - fabs(above)) - nu;
                diagonal[i] += half * (fabs(below) + fabs(above)) + 2.0 * nu;
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
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            A[0][i] = 1.0 / A[0][i];
}

int newton_precond_setup(N_Vector q, N_Vector uscale, N_Vector f, N_Vector fscale, void *user)
{
    struct fv *s = user;
    const struct newton_step *o = &s->newton->of;
    const double a = s->prm.c0 > 0.0 ? 1.0 / (s->prm.c0 * s->prm.c0) : 0.0;
    (void)q, (void)uscale, (void)f, (void)fscale;
    fill_rows(s);
    close_rows(s);
    pressure_shift(s, a * o->c0 * o->c0);
    return 0;
}

/* One Gauss-Seidel sweep over a row of cells, all components at once, for they wait for the cell
 * before; its term comes last. */
static inline __attribute__((always_inline)) void sweep_row(const struct fv *s, double *const r[3],
                                                            double *const x[3], int64_t c,
                                                            const int dim, const bool down)
{
    double *const *A = s->newton->A;
    const int64_t y = s->b.stride[1], z = s->b.stride[2], back = down ? 1 : -1;
    const double *restrict first = A[down ? 2 : 1], *restrict next = A[down ? 1 : 2];
    for (int64_t l = 0; l < s->b.n[0]; l++) {
        const int64_t i = c + (down ? s->b.n[0] - 1 - l : l);
        for (int a = 0; a < dim; a++) {
            const double *restrict q = x[a];
            double sum = r[a][i] - A[3][i] * q[i - y] - A[4][i] * q[i + y];
            if (dim == 3)
                sum -= A[5][i] * q[i - z] + A[6][i] * q[i + z];
            sum = (sum - next[i] * q[i - back]) - first[i] * q[i + back];
            x[a][i] = sum * A[0][i];
        }
    }
}

static void sweep(const struct fv *s, double *const r[3], double *const x[3], bool down)
{
    const struct block *b = &s->b;
    const int64_t rows = (int64_t)b->n[1] * b->n[2];
    for (int64_t m = 0; m < rows; m++) {
        const int64_t row = down ? rows - 1 - m : m;
        const int64_t c = block_at(b, 0, (int)(row % b->n[1]), (int)(row / b->n[1]));
        if (b->dim == 2 && down)
            sweep_row(s, r, x, c, 2, true);
        else if (b->dim == 2)
            sweep_row(s, r, x, c, 2, false);
        else if (down)
            sweep_row(s, r, x, c, 3, true);
        else
            sweep_row(s, r, x, c, 3, false);
    }
}

/* As many as a quarter of the cells that a step reaches, or that there are. */
static int sweeps(const struct fv *s)
{
    const struct newton_step *o = &s->newton->of;
    int most = 0;
    for (int a = 0; a < s->b.dim; a++)
        most = s->b.cells[a] > most ? s->b.cells[a] : most;
    const int n = (int)fmin(o->rate / o->c0, most) / 4;
    return n < 4 ? 4 : n > 32 ? 32 : n + n % 2;
}

/* x ~ A^-1 r for all components. */
static void smooth(struct fv *s, double *const r[3], double *const x[3])
{
    const struct block *b = &s->b;
    const int n = sweeps(s);
    for (int a = 0; a < b->dim; a++)
        memset(x[a], 0, (size_t)b->size * sizeof(double));
    for (int k = 0; k < n; k++) {
        sweep(s, r, x, k % 2);
        bc_ghosts(s, BC_ZERO, x);
        block_halo(b, b->dim, x);
    }
}

/* out = A_p x of a field with ghosts: A's rows with no flux through closed sides, so that their sum
 * is c0. */
static void apply_to_pressure(const struct fv *s, const double *restrict x, double *restrict out)
{
    const struct block *b = &s->b;
    double *const *A = s->newton->A;
    const double c0 = s->newton->of.c0;
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            out[i] = c0 * x[i];
    for (int e = 1; e <= 2 * b->dim; e++) {
        const int64_t d = (e % 2 ? -1 : 1) * b->stride[(e - 1) / 2];
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                out[i] += A[e][i] * (x[i + d] - x[i]);
    }
}

/* div -= D I(x) */
static void subtract_divergence(struct fv *s, double *const x[3], double *restrict div)
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++) {
        const int64_t d = b->stride[a];
        const double *restrict u = x[a], w = 0.5 / b->h[a];
        const double *restrict open = s->forcing ? s->forcing->open[a] : NULL;
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++) {
                const double below = open ? fmin(open[i], 1.0) : 1.0,
                             above = open ? fmin(open[i + d], 1.0) : 1.0;
                div[i] -= w * (above * (u[i + d] + u[i]) - below * (u[i] + u[i - d]));
            }
    }
}

int newton_precond_solve(N_Vector q, N_Vector uscale, N_Vector f, N_Vector fscale, N_Vector v,
                         void *user)
{
    struct fv *s = user;
    const struct block *b = &s->b;
    struct newton *w = s->newton;
    const int timer = timer_index(&s->run->timers, "pressure");
    (void)q, (void)uscale, (void)f, (void)fscale;
    newton_unpack(s, v, w->div, w->r);
    smooth(s, w->r, w->x);
    subtract_divergence(s, w->x, w->div);
    timer_start(&s->run->timers, timer);
    w->cycles += pressure_cycle(s, w->div, w->phi);
    timer_stop(&s->run->timers, timer);
    block_halo(b, 1, &w->phi);
    apply_to_pressure(s, w->phi, w->div);
    for (int a = 0; a < b->dim; a++) {
        double *restrict x = w->x[a], *restrict g = w->r[a];
        gradient(s, w->phi, a, CONTINUE_EVEN, g);
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                x[i] -= g[i];
        if (s->forcing)
            forcing_zero(s->forcing, x);
    }
    if (s->forcing)
        forcing_zero(s->forcing, w->div);
    newton_pack(s, w->div, w->x, v);
    return 0;
}

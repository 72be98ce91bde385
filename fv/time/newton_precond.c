/* newton_precond.c - a fixed linear map close to the inverse of the Jacobian
 *   J = [ A  G ; D  C ]:  A ~ c0 + convection + diffusion, 5-point (7-point);
 *   1  A u* = r_u           symmetric Gauss-Seidel sweeps
 *   2  -Lap phi = r_p - D u*  one V-cycle; p' = A phi, for D A^-1 G ~ Lap A^-1
 *                             (Kay, Loghin & Wathen, SIAM J. Sci. Comput. 24, 2002)
 *   3  u' = u* - G phi
 * SPDX-License-Identifier: BSD-3-Clause */
#include "newton.h"

#include "../boundary/fv_boundary.h"
#include "../poisson/poisson.h"
#include "../surface/fv_surface.h"

/* Beyond the surface the velocity goes on as it is; dry cells get rows of their own. */
static void close_at_surface(struct fv *s)
{
    const unsigned char *layer = s->surface->layer;
    double *const *A = s->newton->A;
    for (int e = 1; e <= 2 * s->dim; e++)
        FLOW_ROWS_AT (s, part, j, c, n) {
            const int64_t to = (e % 2 ? -1 : 1) * part->stride[(e - 1) / 2];
            for (int64_t i = c; i < c + n; i++) {
                if (!layer[i] && layer[i + to])
                    A[0][i] += A[e][i];
                if (layer[i] || layer[i + to])
                    A[e][i] = 0.0;
                if (layer[i])
                    A[0][i] = 1.0;
            }
        }
}

/* Rows of A for the state of the last residual; A[0] becomes 1/diagonal, the sweeps only multiply.
 */
int newton_precond_setup(N_Vector q, N_Vector uscale, N_Vector f, N_Vector fscale, void *user)
{
    struct fv *s = user;
    double *restrict diagonal = s->newton->A[0];
    (void)q, (void)uscale, (void)f, (void)fscale;
    s->newton->cells_of->fill_rows(s);
    if (s->surface)
        close_at_surface(s);
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            diagonal[i] = 1.0 / diagonal[i];
    return 0;
}

/* One Gauss-Seidel sweep over a row of cells, all components at once, for they wait for the cell
 * before; its term comes last. */
INLINE void sweep_row(const struct fv *s, const struct part *p, double *const r[3],
                      double *const x[3], int64_t c, const int dim, const bool down)
{
    double *const *A = s->newton->A;
    const int64_t y = p->stride[1], z = p->stride[2], back = down ? 1 : -1;
    const double *restrict first = A[down ? 2 : 1], *restrict next = A[down ? 1 : 2];
    for (int64_t l = 0; l < p->n[0]; l++) {
        const int64_t i = c + (down ? p->n[0] - 1 - l : l);
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

/* Forwards and backwards in turns, which makes the map symmetric where A is; the neighbours of
 * other ranks and blocks are those of the sweep before. */
static void sweep_part(const struct fv *s, const struct part *p, double *const r[3],
                       double *const x[3], bool down)
{
    const int64_t rows = (int64_t)p->n[1] * p->n[2];
    for (int64_t m = 0; m < rows; m++) {
        const int64_t row = down ? rows - 1 - m : m;
        const int64_t c = part_at(p, 0, (int)(row % p->n[1]), (int)(row / p->n[1]));
        if (s->dim == 2 && down)
            sweep_row(s, p, r, x, c, 2, true);
        else if (s->dim == 2)
            sweep_row(s, p, r, x, c, 2, false);
        else if (down)
            sweep_row(s, p, r, x, c, 3, true);
        else
            sweep_row(s, p, r, x, c, 3, false);
    }
}

/* As many as a quarter of the cells that a step reaches, or that there are. */
static int sweeps(const struct fv *s)
{
    const struct newton_step *o = &s->newton->of;
    const int most = s->newton->longest;
    const int n = (int)fmin(o->rate / o->c0, most) / 4;
    return n < 4 ? 4 : n > 32 ? 32 : n + n % 2;
}

/* x ~ A^-1 r for all components. */
static void smooth(struct fv *s, double *const r[3], double *const x[3])
{
    const int n = sweeps(s);
    for (int a = 0; a < s->dim; a++)
        memset(x[a], 0, (size_t)s->size * sizeof(double));
    for (int k = 0; k < n; k++) {
        for (int q = 0; q < s->grid.nparts; q++)
            sweep_part(s, s->grid.part + q, r, x, k % 2);
        sides_velocity(s, BC_ZERO, x);
    }
}

/* out = A_p x of a field with ghosts: A's rows with no flux through closed sides, so that their sum
 * is c0. */
static void apply_to_pressure(const struct fv *s, const double *restrict x, double *restrict out)
{
    double *const *A = s->newton->A;
    const double c0 = s->newton->of.c0;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            out[i] = c0 * x[i];
    for (int e = 1; e <= 2 * s->dim; e++)
        FLOW_ROWS_AT (s, part, j, c, n) {
            const int64_t d = (e % 2 ? -1 : 1) * part->stride[(e - 1) / 2];
            for (int64_t i = c; i < c + n; i++)
                out[i] += A[e][i] * (x[i + d] - x[i]);
        }
}

/* v is right side and result. */
int newton_precond_solve(N_Vector q, N_Vector uscale, N_Vector f, N_Vector fscale, N_Vector v,
                         void *user)
{
    struct fv *s = user;
    struct newton *w = s->newton;
    (void)q, (void)uscale, (void)f, (void)fscale;
    newton_unpack(s, v, w->div, w->r);
    smooth(s, w->r, w->x);
    if (s->surface) {
        extension_apply(s, w->x, EXTEND_CHANGE, STENCILS);
        sides_velocity(s, BC_ZERO, w->x);
    }
    w->cells_of->subtract_divergence(s, w->x, w->div);
    timer_start(&s->run->timers, "pressure");
    poisson_cycle(s, w->div, w->phi);
    w->cycles++;
    timer_stop(&s->run->timers, "pressure");
    apply_to_pressure(s, w->phi, w->div);
    s->ops->change_gradient(s, w->phi, w->r);
    for (int a = 0; a < s->dim; a++) {
        double *restrict x = w->x[a], *restrict g = w->r[a];
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                x[i] -= g[i];
        newton_clear(s, x);
    }
    newton_clear(s, w->div);
    newton_pack(s, w->div, w->x, v);
    return 0;
}

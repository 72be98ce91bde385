/* layer.c - see layer.h. layer_shape sets the surface and all coefficients, layer_solve the
 * potential below it, and layer_rise and layer_velocity read that solution. The unknown of the
 * solver is y = P f with P the operator of the flat surface, so one product forms f and its
 * derivatives from y in Fourier space (layer_solver_flat) and then the equations column by column
 * in real space.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "layer.h"

#include "../base/base.h"
#include "layer_solver.h"

/* Down to 1/k, where waves have fallen to a third: below, the surface's shape has hardly any effect
 * and each mode goes on by itself; but 2.5 amplitudes at least, so that troughs stay well above the
 * lower end. */
double layer_height(double k, double amplitude, double depth)
{
    return fmin(depth, fmax(1.0 / k, 2.5 * amplitude));
}

/* x- and y-derivatives and the Laplacian of v[cells]. v is transformed with a zero beside it, the
 * room for the second result. */
static void differentiate(const struct sigma_layer *l, const double *v, double *vx, double *vy,
                          double *lap)
{
    const struct wave_grid *g = l->grid;
    double *z = NEW(double, g->cells * 4), *work = NEW(double, g->cells * 4);
    for (int i = 0; i < g->cells; i++)
        z[4 * i] = v[i];
    for (int i = 0; i < g->cells; i++) /* one batch of two: v_x + i v_y, lap v */
        z[4 * i + 1] = 0.0;
    wave_grid_to_modes(g, 2, z, work);
    for (int i = 0; i < g->cells; i++) {
        double *q = z + 4 * i;
        const double re = q[0], im = q[2], kx = g->k[0][i % g->n[0]], ky = g->k[1][i / g->n[0]],
                     k2 = g->size[i] * g->size[i];
        q[0] = -kx * im - ky * re;
        q[2] = kx * re - ky * im;
        q[1] = -k2 * re;
        q[3] = -k2 * im;
    }
    wave_grid_to_fields(g, 2, z, work);
    for (int i = 0; i < g->cells; i++) {
        vx[i] = z[4 * i];
        vy[i] = z[4 * i + 2];
        lap[i] = z[4 * i + 1];
    }
    FREE(z, work);
}

/* rows is nodes rounded up to a multiple of 4: two real rows are one complex one (layer_solver.c),
 * and columns stay aligned to vectors. */
struct sigma_layer *layer_create(const struct wave_grid *grid, double depth, double a, int nodes)
{
    struct sigma_layer *l = NEW(struct sigma_layer, 1);
    const size_t cells = (size_t)grid->cells;
    *l = (struct sigma_layer){.grid = grid, .nodes = nodes, .rows = (nodes + 3) / 4 * 4, .a = a};
    l->sigma = NEW_IN(l, double, l->rows);
    l->phi = NEW_IN(l, double, cells *(size_t)l->rows);
    l->phi_s = NEW_IN(l, double, cells *(size_t)l->rows);
    double **const of[] = {&l->D, &l->eta_x[0], &l->eta_x[1], &l->eta_xx};
    for (int i = 0; i < 4; i++)
        *of[i] = NEW_IN(l, double, cells);
    for (int b = 0; b < 2; b++)
        l->phi_x[b] = NEW_IN(l, double, cells *(size_t)l->rows);
    l->solver = mem_own(l, layer_solver_create(l, depth));
    return l;
}

void layer_shape(struct sigma_layer *l, const double *eta)
{
    differentiate(l, eta, l->eta_x[0], l->eta_x[1], l->eta_xx);
    for (int i = 0; i < l->grid->cells; i++)
        l->D[i] = eta[i] + l->a;
}

/* What sigma does at fixed places of a column: sigma_x = (1 + sigma) x[0], and so on. */
struct sigma_column {
    double x[2];        /* 1/m: along x and y */
    double one, square; /* 1/m^2: 1/D^2; (D/a)^2 */
};

/* What the operator wants of the shape in one column. */
static struct sigma_column column_at(const struct sigma_layer *l, int i)
{
    const double D = l->D[i];
    struct sigma_column c = {.one = 1.0 / (D * D), .square = D * D / (l->a * l->a)};
    for (int b = 0; b < 2; b++) /* z_x = (1 + sigma) eta_x = -D sigma_x */
        c.x[b] = -l->eta_x[b][i] / D;
    return c;
}

/* lap sigma at a node: -(lap z + 2 grad sigma.grad D)/D. */
static double bend(const struct sigma_layer *l, int i, double s, double sx, double sy)
{
    const double lap = (1.0 + s) * l->eta_xx[i];
    return -(lap + 2.0 * (sx * l->eta_x[0][i] + sy * l->eta_x[1][i])) / l->D[i];
}

/* The equations of a column, from f + i f_y (level) and f_x + i lap f (slopes). r[0] is the
 * condition on the surface, r[1 .. last-1] Laplace's equation, r[last] the lower end. All are
 * scaled by (D/a)^2 or D/a, so that for a flat surface A = P and the preconditioned operator is the
 * identity. */
static void column_product(const struct sigma_layer *l, int i, const double *level,
                           const double *slopes, double *r)
{
    const struct layer_solver *s = l->solver;
    const int rows = l->rows, n = l->nodes, batch = s->batch, last = n - 1;
    const double *f = level, *fy = level + batch, *fx = slopes, *lap = slopes + rows;
    const bool plane = l->grid->n[1] > 1;
    const struct sigma_column c = column_at(l, i);
    double fs[64], fss[64], fxs[64], fys[64] = {0.0};
    layer_solver_multiply(s->D1, n, rows, f, fs);
    layer_solver_multiply(s->D2, n, rows, f, fss);
    layer_solver_multiply(s->D1, n, rows, fx, fxs);
    if (plane)
        layer_solver_multiply(s->D1, n, rows, fy, fys);
    for (int j = 1; j < last; j++) {
        const double at = l->sigma[j], sx = (1.0 + at) * c.x[0], sy = (1.0 + at) * c.x[1];
        r[j] = c.square * (lap[j] + 2.0 * (sx * fxs[j] + sy * fys[j]) +
                           (sx * sx + sy * sy + c.one) * fss[j] + bend(l, i, at, sx, sy) * fs[j]);
    }
    const double D = l->D[i];
    r[0] = f[0];
    r[last] = (fs[last] / D - level[s->at_lower]) * D / l->a;
    for (int j = n; j < rows; j++)
        r[j] = 0.0;
}

/* The flat operator's inverse first, so that what is multiplied is near the identity. */
void layer_product(struct sigma_layer *l, const double *y, double *r)
{
    const size_t rows = (size_t)l->rows;
    layer_solver_flat(l, y);
    for (int i = 0; i < l->grid->cells; i++)
        column_product(l, i, l->solver->level + (size_t)i * 2 * (size_t)l->solver->batch,
                       l->solver->slopes + (size_t)i * 2 * rows, r + (size_t)i * rows);
}

/* Derivatives at constant sigma as the solver has left them; phi_s along sigma by the
 * differentiation matrix. */
static void keep_solution(struct sigma_layer *l)
{
    const size_t rows = (size_t)l->rows;
    layer_solver_flat(l, l->solver->start);
    for (int i = 0; i < l->grid->cells; i++) {
        const double *level = l->solver->level + (size_t)i * 2 * (size_t)l->solver->batch,
                     *slopes = l->solver->slopes + (size_t)i * 2 * rows;
        const size_t at = (size_t)i * rows;
        memcpy(l->phi + at, level, rows * sizeof *level);
        memcpy(l->phi_x[0] + at, slopes, rows * sizeof *level);
        memcpy(l->phi_x[1] + at, level + l->solver->batch, rows * sizeof *level);
        if (l->grid->n[1] == 1)
            memset(l->phi_x[1] + at, 0, rows * sizeof *level);
        layer_solver_multiply(l->solver->D1, l->nodes, l->rows, level, l->phi_s + at);
    }
}

/* b holds phi_s in each column's first row. A cold start is y = b, the
 * solution for a flat surface. */
int layer_solve(struct sigma_layer *l, const double *phi_s, double tolerance, bool warm)
{
    const size_t cells = (size_t)l->grid->cells, rows = (size_t)l->rows;
    double *b = NEW(double, cells *rows);
    for (size_t i = 0; i < cells; i++)
        b[i * rows] = phi_s[i];
    if (!warm)
        memcpy(l->solver->start, b, cells * rows * sizeof *b);
    const int products = layer_solver_gmres(l, b, tolerance, l->solver->start);
    mem_free(b);
    keep_solution(l);
    return products;
}

double layer_rise(const struct sigma_layer *l, int cell)
{
    return l->phi_s[(size_t)cell * (size_t)l->rows] / l->D[cell];
}

/* Between sizes of modes that are kept: linear. */
double layer_flat_rise(const struct sigma_layer *l, double k)
{
    const struct layer_solver *s = l->solver;
    const double at = fmax(k / s->kind, 1.0);
    const int i = (int)fmin(floor(at + 1e-9), s->kinds - 2.0);
    return s->flat[i] + (at - i) * (s->flat[i + 1] - s->flat[i]);
}

/* The chain rule: u = f_x + sigma_x f_s, w = f_s/D, v = f_y + sigma_y f_s. */
void layer_velocity(const struct sigma_layer *l, int cell, double *x, double *up, double *y)
{
    const struct sigma_column c = column_at(l, cell);
    const size_t at = (size_t)cell * (size_t)l->rows;
    for (int j = 0; j < l->nodes; j++) {
        const double s = l->sigma[j], fs = l->phi_s[at + (size_t)j];
        x[j] = l->phi_x[0][at + (size_t)j] + (1.0 + s) * c.x[0] * fs;
        up[j] = fs / l->D[cell];
        if (y)
            y[j] = l->phi_x[1][at + (size_t)j] + (1.0 + s) * c.x[1] * fs;
    }
}

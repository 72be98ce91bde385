/* layer_solver.c - see layer_solver.h. GMRES is preconditioned from the right: its residual is that
 * of the equations. The inverses of the flat operator, one full matrix of nodes^2 for each size of
 * k, are made once; a product costs transforms of a few values for each node, and some nodes^2
 * operations for each column. Every rank solves the same problem, so nothing is communicated.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "layer_solver.h"

#include <lapacke.h>

#include "../base/base.h"
#include "layer.h"

enum { PLANE_KINDS = 2049 };

/* Trefethen's differentiation matrix on cos(pi i/N), for (y - 1)/2. Negative sums on the diagonal
 * make the derivative of a constant exactly zero (Baltensperger & Trummer, SIAM J. Sci. Comput. 24,
 * 2003). D2 = D1 D1. */
static void make_points(int nodes, int rows, double *sigma, double *D1, double *D2)
{
    const int N = nodes - 1;
    for (int i = 0; i < nodes; i++)
        sigma[i] = 0.5 * (cos(M_PI * i / N) - 1.0);
    for (int i = 0; i < nodes; i++) {
        double sum = 0.0;
        for (int j = 0; j < nodes; j++) {
            const double c = (i % N ? 1.0 : 2.0) / (j % N ? 1.0 : 2.0) * ((i + j) % 2 ? -1.0 : 1.0);
            if (i == j)
                continue;
            sum += D1[j * rows + i] = c / (sigma[i] - sigma[j]);
        }
        D1[i * rows + i] = -sum;
    }
    for (int i = 0; i < nodes; i++)
        for (int j = 0; j < nodes; j++)
            for (int k = 0; k < nodes; k++)
                D2[j * rows + i] += D1[k * rows + i] * D1[j * rows + k];
}

/* The flat operator of modes of the size k. Row 0: f = 1 there; row n-1: f_s/a - K f; between:
 * f_ss/a^2 - k^2 f. flat[kind] is W of the mode with f = 1 on the surface, over k tanh kh. */
static void invert(const struct sigma_layer *l, const struct layer_solver *s, double depth,
                   int kind)
{
    const int n = l->nodes, rows = l->rows;
    const double k = kind * s->kind, lower = k * tanh(fmin(k * (depth - l->a), 300.0));
    double *A = NEW(double, n *n), *to = s->inverse + (size_t)kind * (size_t)(rows * rows);
    lapack_int pivots[64];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const bool own = i == j;
            A[i * n + j] = i == 0       ? own
                           : i == n - 1 ? s->D1[j * rows + i] / l->a - own * lower
                                        : s->D2[j * rows + i] / (l->a * l->a) - own * k * k;
        }
    if (LAPACKE_dgetrf(LAPACK_ROW_MAJOR, n, n, A, n, pivots) ||
        LAPACKE_dgetri(LAPACK_ROW_MAJOR, n, A, n, pivots))
        abort_run("the flat operator of a wave field cannot be inverted");
    for (int i = 0; i < n; i++) /* transposed: products run along results */
        for (int j = 0; j < n; j++)
            to[j * rows + i] = A[i * n + j];
    for (int j = 0; j < n && k > 0.0; j++)
        s->flat[kind] += s->D1[j * rows] * A[j * n] / (l->a * k * tanh(fmin(k * depth, 300.0)));
    mem_free(A);
}

/* Over a plane the sizes of k are too many for a matrix each: PLANE_KINDS of them, of which the
 * nearest serves, since a preconditioner need not be exact. */
struct layer_solver *layer_solver_create(const struct sigma_layer *l, double depth)
{
    struct layer_solver *s = NEW(struct layer_solver, 1);
    const size_t cells = (size_t)l->grid->cells, rows = (size_t)l->rows;
    double largest = 0.0;
    require(l->nodes <= 64);
    s->D1 = NEW_IN(s, double, rows *rows);
    s->D2 = NEW_IN(s, double, rows *rows);
    s->lower = NEW_IN(s, double, cells);
    const bool plane = l->grid->n[1] > 1; /* along a line f_y leaves room */
    s->batch = l->rows + plane;
    s->at_lower = plane ? l->rows : s->batch + l->nodes - 1;
    s->packed = NEW_IN(s, double, cells * 2 * (size_t)s->batch);
    s->work = NEW_IN(s, double, cells * 2 * (size_t)s->batch);
    s->slopes = NEW_IN(s, double, cells * 2 * rows);
    s->level = NEW_IN(s, double, cells * 2 * (size_t)s->batch);
    s->start = NEW_IN(s, double, cells *rows);
    for (int i = 0; i <= LAYER_VECTORS; i++)
        s->vectors[i] = NULL;
    make_points(l->nodes, l->rows, l->sigma, s->D1, s->D2);
    for (int m = 0; m < l->grid->cells; m++) {
        const double k = l->grid->size[m];
        s->lower[m] = k * tanh(fmin(k * (depth - l->a), 300.0));
        largest = fmax(largest, k);
    }
    s->kinds = plane ? PLANE_KINDS : l->grid->n[0] / 2 + 1;
    s->kind = largest / (s->kinds - 1);
    s->inverse = NEW_IN(s, double, (size_t)s->kinds *rows *rows);
    s->flat = NEW_IN(s, double, s->kinds);
    for (int kind = 0; kind < s->kinds; kind++)
        invert(l, s, depth, kind);
    return s;
}

/* The modes k and -k of real fields of which rows s and s + rows/2 were transformed as one complex
 * one: re, im [rows] of k. */
static void unpack(const struct sigma_layer *l, int mode, double *re, double *im)
{
    const int half = l->rows / 2;
    const double *z = l->solver->packed + (size_t)mode * (size_t)l->rows,
                 *m = l->solver->packed + (size_t)l->grid->mirror[mode] * (size_t)l->rows;
    for (int i = 0; i < half; i++) {
        re[i] = 0.5 * (z[i] + m[i]);
        im[i] = 0.5 * (z[half + i] - m[half + i]);
        re[half + i] = 0.5 * (z[half + i] + m[half + i]);
        im[half + i] = 0.5 * (m[i] - z[i]);
    }
}

/* Stored transposed, so that the inner loop runs over neighbours. */
void layer_solver_multiply(const double *transposed, int nodes, int rows, const double *x,
                           double *restrict y)
{
    memset(y, 0, (size_t)rows * sizeof *y);
    for (int j = 0; j < nodes; j++)
        for (int i = 0; i < rows; i++)
            y[i] += transposed[j * rows + i] * x[j];
}

/* Writes a mode of f as f_x + i lap f and f + i f_y (+- k: those of -k are the complement). */
static void spread(struct sigma_layer *l, int mode, const double *re, const double *im, double way)
{
    const struct wave_grid *g = l->grid;
    const int rows = l->rows, batch = l->solver->batch, to = way > 0.0 ? mode : g->mirror[mode];
    const double kx = way * g->k[0][mode % g->n[0]], ky = way * g->k[1][mode / g->n[0]],
                 k2 = g->size[mode] * g->size[mode];
    double *slopes = l->solver->slopes + (size_t)to * 2 * (size_t)rows,
           *level = l->solver->level + (size_t)to * 2 * (size_t)batch;
    for (int i = 0; i < rows; i++) {
        const double b = way * im[i];
        slopes[i] = -kx * b + k2 * b;
        slopes[rows + i] = kx * re[i] - k2 * re[i];
        level[i] = re[i] - ky * re[i];
        level[batch + i] = b - ky * b;
    }
    const double K = l->solver->lower[mode];
    if (l->solver->at_lower < batch) {
        level[rows] = K * re[l->nodes - 1];
        level[batch + rows] = K * way * im[l->nodes - 1];
    } else { /* an imaginary part: i K f */
        level[l->nodes - 1] -= K * way * im[l->nodes - 1];
        level[batch + l->nodes - 1] += K * re[l->nodes - 1];
    }
}

/* Each mode with its mirror: rows are multiplied by the inverse of their kind, and the derivatives
 * of f that column_product needs are written, two real fields as one complex one. */
void layer_solver_flat(struct sigma_layer *l, const double *y)
{
    struct layer_solver *s = l->solver;
    const int rows = l->rows;
    double re[64] = {0.0}, im[64] = {0.0}, to_re[64], to_im[64];
    memcpy(s->packed, y, (size_t)l->grid->cells * (size_t)rows * sizeof *y);
    wave_grid_to_modes(l->grid, rows / 2, s->packed, s->work);
    for (int m = 0; m < l->grid->cells; m++) {
        if (l->grid->mirror[m] < m)
            continue;
        const size_t kind = (size_t)(l->grid->size[m] / s->kind + 0.5);
        const double *inverse = s->inverse + kind * (size_t)(rows * rows);
        unpack(l, m, re, im);
        layer_solver_multiply(inverse, l->nodes, rows, re, to_re);
        layer_solver_multiply(inverse, l->nodes, rows, im, to_im);
        spread(l, m, to_re, to_im, 1.0);
        if (l->grid->mirror[m] != m)
            spread(l, m, to_re, to_im, -1.0);
    }
    wave_grid_to_fields(l->grid, rows, s->slopes, s->work);
    wave_grid_to_fields(l->grid, s->batch, s->level, s->work);
}

/* --- GMRES --- */

static double dot(size_t n, const double *x, const double *y)
{
    return lanes_dot_any(x, y, (int64_t)n);
}

static void add(size_t n, double a, const double *restrict x, double *restrict y)
{
    for (size_t i = 0; i < n; i++)
        y[i] += a * x[i];
}

/* Turns column j of the Hessenberg matrix by the rotations so far and one more. Givens' rotation
 * that makes H upper triangular; |g[j + 1]| is then the norm of the residual. */
static void rotate(double H[][LAYER_VECTORS], double turn[][2], double *g, int j)
{
    for (int i = 0; i < j; i++) {
        const double a = H[i][j], b = H[i + 1][j];
        H[i][j] = turn[i][0] * a + turn[i][1] * b;
        H[i + 1][j] = turn[i][0] * b - turn[i][1] * a;
    }
    const double r = hypot(H[j][j], H[j + 1][j]);
    turn[j][0] = r > 0.0 ? H[j][j] / r : 1.0;
    turn[j][1] = r > 0.0 ? H[j + 1][j] / r : 0.0;
    H[j][j] = r;
    g[j + 1] = -turn[j][1] * g[j];
    g[j] *= turn[j][0];
}

/* y += sum of the first m vectors with the coefficients that solve H c = g. */
static void combine(struct layer_solver *s, size_t n, int m, double H[][LAYER_VECTORS],
                    const double *g, double *y)
{
    double c[LAYER_VECTORS];
    for (int i = m - 1; i >= 0; i--) {
        c[i] = g[i];
        for (int j = i + 1; j < m; j++)
            c[i] -= H[i][j] * c[j];
        c[i] /= H[i][i];
    }
    for (int i = 0; i < m; i++)
        add(n, c[i], s->vectors[i], y);
}

static double *vector(struct layer_solver *s, size_t n, int i)
{
    if (!s->vectors[i])
        s->vectors[i] = NEW_IN(s, double, n);
    return s->vectors[i];
}

/* Up to LAYER_VECTORS products; the residual that is left. Gram-Schmidt in its modified form. What
 * begins is the true residual, so that errors of one cycle do not enter the next. */
static double cycle(struct sigma_layer *l, const double *b, double enough, double *y, int *products)
{
    struct layer_solver *s = l->solver;
    const size_t n = (size_t)l->grid->cells * (size_t)l->rows;
    double H[LAYER_VECTORS + 1][LAYER_VECTORS], turn[LAYER_VECTORS][2], g[LAYER_VECTORS + 1];
    double *v = vector(s, n, 0);
    int m = 0;
    layer_product(l, y, v);
    for (size_t i = 0; i < n; i++)
        v[i] = b[i] - v[i];
    g[0] = sqrt(dot(n, v, v));
    ++*products;
    if (!(g[0] > enough))
        return g[0];
    for (size_t i = 0; i < n; i++)
        v[i] /= g[0];
    while (m < LAYER_VECTORS && fabs(g[m]) > enough) {
        double *w = vector(s, n, m + 1);
        layer_product(l, s->vectors[m], w);
        ++*products;
        for (int i = 0; i <= m; i++) {
            H[i][m] = dot(n, w, s->vectors[i]);
            add(n, -H[i][m], s->vectors[i], w);
        }
        const double left = sqrt(dot(n, w, w));
        H[m + 1][m] = left;
        for (size_t i = 0; i < n && left > 0.0; i++)
            w[i] /= left;
        rotate(H, turn, g, m++);
    }
    combine(s, n, m, H, g, y);
    return fabs(g[m]);
}

/* At most LAYER_RESTARTS cycles: waves that need more are about to break, and the caller takes that
 * for the answer. */
int layer_solver_gmres(struct sigma_layer *l, const double *b, double tolerance, double *y)
{
    const size_t n = (size_t)l->grid->cells * (size_t)l->rows;
    const double enough = tolerance * sqrt(dot(n, b, b));
    int products = 0;
    double left = INFINITY;
    for (int k = 0; k < LAYER_RESTARTS && left > enough; k++)
        left = cycle(l, b, enough, y, &products);
    return left <= enough ? products : -1;
}

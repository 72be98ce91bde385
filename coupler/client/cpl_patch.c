/* cpl_patch.c - interpolation on a piece of a uniform grid, see cpl_patch.h: when a patch has come
 * it is made ready (patch_prepare), then evaluated in points at times of the coupling step
 * (patch_eval), first all cells at that time, then a tensor product of one-dimensional weights for
 * each point. The dual cell, whose corners are cell centres, takes the part of the cell in Chiron's
 * equation [6.6]: nothing is averaged to vertices and so nothing is smoothed twice.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cpl_patch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDEST = 4 };

size_t patch_size(const struct client_patch *p)
{
    return (size_t)p->n[0] * (size_t)p->n[1] * (size_t)p->n[2];
}

void patch_clear(struct client_patch *p)
{
    free(p->v);
    free(p->now);
    free(p->now_at);
    *p = (struct client_patch){0};
}

/* u = U - h^2/24 U'' along one line of cells, U averages. Second differences of averages are exact
 * for cubics; the ends take the one-sided form, exact for cubics too. */
static void point_values(double *line, int n, size_t stride, double *old)
{
    if (n < 3)
        return;
    for (int i = 0; i < n; i++)
        old[i] = line[(size_t)i * stride];
    for (int i = 1; i < n - 1; i++)
        line[(size_t)i * stride] -= (old[i - 1] - 2.0 * old[i] + old[i + 1]) / 24.0;
    const double *a = old, *b = old + n - 1;
    const double first =
        n > 3 ? 2.0 * a[0] - 5.0 * a[1] + 4.0 * a[2] - a[3] : a[0] - 2.0 * a[1] + a[2];
    const double last =
        n > 3 ? 2.0 * b[0] - 5.0 * b[-1] + 4.0 * b[-2] - b[-3] : b[0] - 2.0 * b[-1] + b[-2];
    line[0] -= first / 24.0;
    line[(size_t)(n - 1) * stride] -= last / 24.0;
}

/* Along x, then y, then z: the operator 1 - h^2/24 d^2 in each direction, so that averages over
 * cells become values at centres. */
static void make_points(struct client_patch *p)
{
    const size_t width = CPL_TERMS * (size_t)p->ncomp;
    const size_t step[3] = {width, width * (size_t)p->n[0],
                            width * (size_t)p->n[0] * (size_t)p->n[1]};
    int longest = p->n[0] > p->n[1] ? p->n[0] : p->n[1];
    longest = longest > p->n[2] ? longest : p->n[2];
    double *old = malloc((size_t)longest * sizeof *old);
    if (!old)
        abort();
    for (int a = 0; a < p->dim; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3; /* the lines' two other directions */
        for (int j = 0; j < p->n[b]; j++)
            for (int k = 0; k < p->n[c]; k++)
                for (size_t w = 0; w < width; w++)
                    point_values(p->v + (size_t)j * step[b] + (size_t)k * step[c] + w, p->n[a],
                                 step[a], old);
    }
    free(old);
}

/* Once for each patch that has come; now_at NAN: no time yet. */
void patch_prepare(struct client_patch *p)
{
    const size_t n = patch_size(p) * (size_t)p->ncomp;
    if (n == 0)
        return;
    if (p->cubic)
        make_points(p);
    p->now = malloc(n * sizeof *p->now);
    p->now_at = malloc(sizeof *p->now_at);
    if (!p->now || !p->now_at)
        abort();
    p->now_at[0] = NAN;
}

/* All cells at the time t, by Horner: there are fewer of them than of points that look. */
static void move_to(const struct client_patch *p, double t)
{
    const size_t n = patch_size(p) * (size_t)p->ncomp;
    const double tau = t - p->t, *restrict v = p->v;
    double *restrict now = p->now;
    if (p->now_at[0] == t)
        return;
    for (size_t i = 0; i < n; i++, v += CPL_TERMS)
        now[i] = v[0] + tau * (v[1] + tau * (v[2] + tau * v[3]));
    p->now_at[0] = t;
}

/* Nodes of a stencil along one direction: first node, weights and weights of the slope (1/m). */
struct patch_stencil {
    int first, m;
    double w[WIDEST], d[WIDEST];
};

static const struct patch_stencil one_cell = {.m = 1, .w = {1.0}};

/* Cubic Lagrange on nodes -1, 0, 1, 2 at s in their units. */
static inline void cubic_weights(struct patch_stencil *q, double s, double per_m)
{
    const double a = s + 1.0, b = s, c = s - 1.0, e = s - 2.0;
    const double half = 0.5 * per_m, sixth = (1.0 / 6.0) * per_m;
    q->w[0] = -b * c * e * (1.0 / 6.0);
    q->w[1] = a * c * e * 0.5;
    q->w[2] = -a * b * e * 0.5;
    q->w[3] = a * b * c * (1.0 / 6.0);
    q->d[0] = -(c * e + b * e + b * c) * sixth;
    q->d[1] = (c * e + a * e + a * c) * half;
    q->d[2] = -(b * e + a * e + a * b) * half;
    q->d[3] = (b * c + a * c + a * b) * sixth;
}

/* The place in its cell comes from the global index alone, so that all patches of a grid, whatever
 * their first cell, give the same bits. Places outside the patch are held at half a cell beyond its
 * outermost centres. Fewer than four cells: linear, one cell: its value. */
static inline void stencil_at(const struct client_patch *p, int a, double per_m, double x,
                              struct patch_stencil *q)
{
    const int n = p->n[a], lo = p->lo[a];
    /* in cells, 0 at the centre of the grid's first cell; huge and NaN places become places */
    double s = (x - p->origin[a]) * per_m - 0.5;
    s = s > -1e9 ? s : -1e9;
    s = s < 1e9 ? s : 1e9;
    int i = (int)floor(s);
    s -= i;
    i -= lo;
    const int period = p->period[a], twice = 2 * i - n;
    if (period > 0 && (twice >= period || twice < -period)) { /* the image nearest the middle */
        const int turns = (int)floor((i - 0.5 * n) / period + 0.5);
        i -= turns * period;
    }
    if (i < -1 || (i == -1 && s < 0.5)) {
        i = -1;
        s = 0.5;
    }
    if (i >= n || (i == n - 1 && s > 0.5)) {
        i = n - 1;
        s = 0.5;
    }
    if (p->cubic && n >= 4) {
        const int base = i < 1 ? 1 : i > n - 3 ? n - 3 : i;
        q->m = 4;
        q->first = base - 1;
        cubic_weights(q, s + (i - base), per_m);
    } else if (n >= 2) {
        const int base = i < 0 ? 0 : i > n - 2 ? n - 2 : i;
        q->m = 2;
        q->first = base;
        q->w[1] = s + (i - base);
        q->w[0] = 1.0 - q->w[1];
        q->d[1] = per_m;
        q->d[0] = -per_m;
    } else
        *q = one_cell;
}

/* One point: sums along x, then y, then z. ncomp, the stencil's width and grad are constants of the
 * callers, so that the inner loops unroll. */
static inline __attribute__((always_inline)) void eval_point(const struct client_patch *p,
                                                             const struct patch_stencil q[3],
                                                             const int ncomp, const int mx,
                                                             double *v, double *grad)
{
    double sum[4][8] = {{0}}; /* value, d/dx, d/dy, d/dz of at most 8 components */
    const size_t width = (size_t)ncomp;
    for (int k = 0; k < q[2].m; k++)
        for (int j = 0; j < q[1].m; j++) {
            const size_t row =
                ((size_t)(q[2].first + k) * (size_t)p->n[1] + (size_t)(q[1].first + j)) *
                    (size_t)p->n[0] +
                (size_t)q[0].first;
            const double *c = p->now + row * width;
            const double wyz = q[1].w[j] * q[2].w[k];
            const double dy = q[1].d[j] * q[2].w[k], dz = q[1].w[j] * q[2].d[k];
            for (int a = 0; a < ncomp; a++) {
                double f = 0.0, fx = 0.0;
                for (int i = 0; i < mx; i++) {
                    const double u = c[(size_t)i * width + (size_t)a];
                    f += q[0].w[i] * u;
                    fx += q[0].d[i] * u;
                }
                sum[0][a] += wyz * f;
                sum[1][a] += wyz * fx;
                sum[2][a] += dy * f;
                sum[3][a] += dz * f;
            }
        }
    for (int a = 0; a < ncomp; a++) {
        v[a] = sum[0][a];
        if (grad)
            for (int b = 0; b < 3; b++)
                grad[3 * a + b] = sum[1 + b][a];
    }
}

typedef void point_body(const struct client_patch *p, const struct patch_stencil q[3], double *v,
                        double *grad);

#define BODY(ncomp, mx)                                                                            \
    static void point_##ncomp##_##mx(const struct client_patch *p,                                 \
                                     const struct patch_stencil q[3], double *v, double *grad)     \
    {                                                                                              \
        if (grad)                                                                                  \
            eval_point(p, q, ncomp, mx, v, grad);                                                  \
        else                                                                                       \
            eval_point(p, q, ncomp, mx, v, NULL);                                                  \
    }
BODY(1, 2)
BODY(2, 2)
BODY(3, 2)
BODY(4, 2)
BODY(1, 4)
BODY(2, 4)
BODY(3, 4)
BODY(4, 4)

/* Any number of components, any width: one component at a time. */
static void point_any(const struct client_patch *p, const struct patch_stencil q[3], double *v,
                      double *grad)
{
    const size_t width = (size_t)p->ncomp;
    for (int a = 0; a < p->ncomp; a++) {
        double sum[4] = {0};
        for (int k = 0; k < q[2].m; k++)
            for (int j = 0; j < q[1].m; j++)
                for (int i = 0; i < q[0].m; i++) {
                    const size_t cell =
                        ((size_t)(q[2].first + k) * (size_t)p->n[1] + (size_t)(q[1].first + j)) *
                            (size_t)p->n[0] +
                        (size_t)(q[0].first + i);
                    const double u = p->now[cell * width + (size_t)a];
                    sum[0] += q[0].w[i] * q[1].w[j] * q[2].w[k] * u;
                    sum[1] += q[0].d[i] * q[1].w[j] * q[2].w[k] * u;
                    sum[2] += q[0].w[i] * q[1].d[j] * q[2].w[k] * u;
                    sum[3] += q[0].w[i] * q[1].w[j] * q[2].d[k] * u;
                }
        v[a] = sum[0];
        if (grad)
            memcpy(grad + 3 * a, sum + 1, 3 * sizeof *sum);
    }
}

/* Four components are a velocity and a pressure; more are rare. */
static point_body *body_of(int ncomp, int width)
{
    static point_body *const linear[] = {point_1_2, point_2_2, point_3_2, point_4_2};
    static point_body *const cubic[] = {point_1_4, point_2_4, point_3_4, point_4_4};
    if (ncomp < 1 || ncomp > 4 || (width != 2 && width != 4))
        return point_any;
    return width == 2 ? linear[ncomp - 1] : cubic[ncomp - 1];
}

/* Width along x is a constant of the bodies, widths along y and z are those of the stencils. */
void patch_eval(const struct client_patch *p, double t, long n, const double *x, double *v,
                double *grad)
{
    const size_t nc = (size_t)p->ncomp;
    if (n <= 0)
        return;
    if (patch_size(p) == 0) { /* nothing was asked for: zero, not garbage */
        memset(v, 0, (size_t)n * nc * sizeof *v);
        if (grad)
            memset(grad, 0, 3 * (size_t)n * nc * sizeof *grad);
        return;
    }
    move_to(p, t);
    const int mx = p->n[0] < 2 ? 1 : p->cubic && p->n[0] >= 4 ? 4 : 2;
    point_body *const body = body_of(p->ncomp, mx);
    struct patch_stencil q[3] = {one_cell, one_cell, one_cell};
    double per_m[3];
    for (int a = 0; a < p->dim; a++)
        per_m[a] = 1.0 / p->spacing[a];
    for (size_t i = 0; i < (size_t)n; i++) {
        for (int a = 0; a < p->dim; a++)
            stencil_at(p, a, per_m[a], x[3 * i + (size_t)a], q + a);
        body(p, q, v + i * nc, grad ? grad + 3 * i * nc : NULL);
    }
}

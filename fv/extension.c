/* extension.c - velocity of dry cells near the surface, layer by layer, by weighted least squares
 * over the known cells around: quadratic about the foot point in the first layer, whose normal
 * derivative is corrected to no shear stress, t.(G + G^T) n = 0; quadratic in the second, linear
 * further out. Weights depend on phi alone and are made once a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include <math.h>
#include <string.h>

#include "../common/mem.h"
#include "forcing.h"

enum { TERMS = 10, STENCIL = 125, THIN = 9 };

/* Normal equations of a fit over a stencil. */
struct least_squares {
    int m;                    /* terms */
    double A[TERMS][TERMS];   /* then its factor, A = L L^T */
    double b[STENCIL][TERMS]; /* terms at the cells */
    double w[STENCIL];
};

static bool factor(struct least_squares *q)
{
    for (int i = 0; i < q->m; i++) {
        const double whole = q->A[i][i];
        for (int j = 0; j <= i; j++) {
            double sum = q->A[i][j];
            for (int k = 0; k < j; k++)
                sum -= q->A[i][k] * q->A[j][k];
            if (i != j)
                q->A[i][j] = sum / q->A[j][j];
            else if (sum > 1e-6 * whole)
                q->A[i][i] = sqrt(sum);
            else
                return false;
        }
    }
    return true;
}

static bool prepare(struct least_squares *q, int n)
{
    memset(q->A, 0, sizeof q->A);
    for (int p = 0; p < n; p++)
        for (int i = 0; i < q->m; i++)
            for (int j = 0; j <= i; j++)
                q->A[i][j] += q->w[p] * q->b[p][i] * q->b[p][j];
    return n >= q->m && factor(q);
}

/* Weights of the cells in the functional e of the fit. */
static void weights(const struct least_squares *q, int n, const double *e, double *out)
{
    double y[TERMS];
    for (int i = 0; i < q->m; i++) {
        y[i] = e[i];
        for (int k = 0; k < i; k++)
            y[i] -= q->A[i][k] * y[k];
        y[i] /= q->A[i][i];
    }
    for (int i = q->m - 1; i >= 0; i--) {
        for (int k = i + 1; k < q->m; k++)
            y[i] -= q->A[k][i] * y[k];
        y[i] /= q->A[i][i];
    }
    for (int p = 0; p < n; p++) {
        out[p] = 0.0;
        for (int i = 0; i < q->m; i++)
            out[p] += q->b[p][i] * y[i];
        out[p] *= q->w[p];
    }
}

/* 1, then the dim coordinates r (from `skip' on: a normal one left out), then their products. */
static int terms(int dim, int order, bool skip, const double *r, double *b)
{
    int m = 0;
    b[m++] = 1.0;
    for (int a = skip ? 1 : 0; a < dim && order > 0; a++)
        b[m++] = r[a];
    for (int a = 0; a < dim && order > 1; a++)
        for (int c = a; c < dim; c++)
            b[m++] = r[a] * r[c];
    return m;
}

/* A dry cell under work: frame e[0] = normal, e[1], e[2] tangents; origin: foot point. */
struct place {
    double e[3][3];
    double depth;            /* m: of the cell over the surface */
    int n, step[STENCIL];    /* known cells around */
    int room;                /* how many the window could hold */
    double r[STENCIL][3];    /* their places in the frame, in units of h */
    double self[3], spacing; /* the cell's own; h (m) */
};

static void make_frame(const struct fv *s, int64_t c, struct place *p)
{
    const struct block *b = &s->b;
    const double *q = s->surface->phi + c;
    double size = 0.0, n[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < b->dim; a++) {
        n[a] = (q[b->stride[a]] - q[-b->stride[a]]) / (2.0 * b->h[a]);
        size += n[a] * n[a];
    }
    size = sqrt(size);
    if (!(size > 1e-3)) { /* no direction: a ridge of phi */
        n[0] = n[2] = 0.0;
        n[1] = size = 1.0;
    }
    p->depth = fmax(0.0, q[0]) / fmax(size, 0.2);
    memset(p->e, 0, sizeof p->e);
    for (int a = 0; a < 3; a++)
        p->e[0][a] = n[a] / size;
    if (b->dim == 2) {
        p->e[1][0] = -p->e[0][1];
        p->e[1][1] = p->e[0][0];
        return;
    }
    int least = 0;
    for (int a = 1; a < 3; a++)
        least = fabs(p->e[0][a]) < fabs(p->e[0][least]) ? a : least;
    double norm = 0.0;
    for (int a = 0; a < 3; a++) {
        p->e[1][a] = (a == least) - p->e[0][least] * p->e[0][a];
        norm += p->e[1][a] * p->e[1][a];
    }
    for (int a = 0; a < 3; a++)
        p->e[1][a] /= sqrt(norm);
    for (int a = 0; a < 3; a++)
        p->e[2][a] = p->e[0][(a + 1) % 3] * p->e[1][(a + 2) % 3] -
                     p->e[0][(a + 2) % 3] * p->e[1][(a + 1) % 3];
}

static bool forced(const struct fv *s, int64_t c) { return s->forcing && s->forcing->forced[c]; }

/* Known cells of a window of 5 cells a side, moved one cell into the water. */
static void look_around(const struct fv *s, int64_t c, int layer, struct place *p)
{
    const struct block *b = &s->b;
    int shift[3], d[3];
    p->n = p->room = 0;
    for (int a = 0; a < 3; a++)
        shift[a] = a < b->dim ? -(int)lround(p->e[0][a] * 1.2) : 0;
    for (int k = b->dim == 3 ? -2 : 0; k <= (b->dim == 3 ? 2 : 0); k++)
        for (int j = -2; j <= 2; j++)
            for (int i = -2; i <= 2; i++) {
                double x[3] = {0.0, 0.0, 0.0};
                int64_t step = 0;
                d[0] = i + shift[0];
                d[1] = j + shift[1];
                d[2] = k + shift[2];
                for (int a = 0; a < b->dim; a++) {
                    step += d[a] * b->stride[a];
                    x[a] = d[a] * b->h[a] + p->depth * p->e[0][a];
                }
                if (forced(s, c + step))
                    continue;
                p->room++;
                if (s->surface->layer[c + step] >= layer)
                    continue;
                for (int a = 0; a < 3; a++)
                    p->r[p->n][a] =
                        (x[0] * p->e[a][0] + x[1] * p->e[a][1] + x[2] * p->e[a][2]) / p->spacing;
                p->step[p->n++] = (int)step;
            }
    p->self[0] = p->depth / p->spacing;
    p->self[1] = p->self[2] = 0.0;
}

/* The best fit that the cells allow, of at most this order; the order done. */
static int fit(const struct fv *s, const struct place *p, int order, bool skip, const double *from,
               struct least_squares *q)
{
    for (;; order--) {
        for (int k = 0; k < p->n; k++) {
            double r2 = 0.0;
            for (int a = 0; a < s->b.dim; a++)
                r2 += (p->r[k][a] - from[a]) * (p->r[k][a] - from[a]);
            q->m = terms(s->b.dim, order, skip, p->r[k], q->b[k]);
            q->w[k] = 1.0 / ((r2 + 0.25) * (r2 + 0.25));
        }
        if (order == 0 || prepare(q, p->n))
            break;
    }
    if (order == 0)
        prepare(q, p->n);
    return order;
}

/* Room for n more weights (and dim n of a gradient). */
static void make_room(struct surface *f, int64_t n, int64_t ngrad)
{
    if (f->nstencil + n > f->stencil_room) {
        const int64_t more = 2 * f->stencil_room + 4096;
        GROW(f->at, f->nstencil, more);
        GROW(f->weight, f->nstencil, more);
        f->stencil_room = more;
    }
    if (f->ngrad + ngrad > f->grad_room) {
        const int64_t more = 2 * f->grad_room + 8192;
        GROW(f->grad, f->ngrad, more);
        f->grad_room = more;
    }
}

/* Gradient at the foot point by a quadratic without condition, from the frame to the axes. */
static void gradient_weights(const struct fv *s, const struct place *p, double *grad)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    struct least_squares q;
    const int dim = s->b.dim;
    double e[TERMS] = {0.0}, w[3][STENCIL];
    memset(grad, 0, sizeof(double) * (size_t)(dim * p->n));
    if (fit(s, p, 2, false, origin, &q) == 0)
        return;
    for (int r = 0; r < dim; r++) {
        e[1 + r] = 1.0 / p->spacing;
        weights(&q, p->n, e, w[r]);
        e[1 + r] = 0.0;
        for (int a = 0; a < dim; a++)
            for (int k = 0; k < p->n; k++)
                grad[a * p->n + k] += w[r][k] * p->e[r][a];
    }
}

/* A film has no slope worth knowing: a quadratic through it overshoots, each layer of dry cells
 * more than the last, and convection feeds on it. Flat water fills 0.6 of the window, two cells
 * 0.4. */
static bool is_thin(const struct fv *s, const struct place *p)
{
    return p->n < (s->b.dim == 2 ? THIN : 3 * THIN) || 2 * p->n < p->room;
}

static void add_carry(struct fv *s, int64_t c, int layer)
{
    struct surface *f = s->surface;
    const int dim = s->b.dim;
    struct place p = {.spacing = s->b.h[0]};
    struct least_squares q;
    double e[TERMS];
    make_frame(s, c, &p);
    look_around(s, c, layer, &p);
    make_room(f, STENCIL, (int64_t)dim * STENCIL);
    struct carry x = {.cell = c, .first = (int)f->nstencil, .n = p.n, .first_grad = (int)f->ngrad};
    double *w = f->weight + f->nstencil;
    for (int k = 0; k < p.n; k++)
        f->at[f->nstencil + k] = p.step[k];
    const bool thin = is_thin(s, &p);
    const int order = fit(s, &p, thin ? 0 : layer <= 2 ? 2 : 1, layer == 1, p.self, &q);
    terms(dim, order, layer == 1, p.self, e);
    weights(&q, p.n, e, w);
    f->nstencil += p.n;
    memcpy(x.n3, p.e[0], sizeof x.n3);
    if (layer == 1 && !thin) {
        gradient_weights(s, &p, f->grad + f->ngrad);
        f->ngrad += (int64_t)dim * p.n;
        x.slope = p.self[0];
        for (int k = 0; k < p.n; k++)
            x.slope -= w[k] * p.r[k][0];
        x.slope *= p.spacing;
        x.has_slope = true;
    }
    if (f->ncarry[layer] == f->carry_room[layer]) {
        const int64_t more = 2 * f->carry_room[layer] + 256;
        GROW(f->carry[layer], f->ncarry[layer], more);
        f->carry_room[layer] = more;
    }
    f->carry[layer][f->ncarry[layer]++] = x;
}

static bool touches(const struct fv *s, const double *field, int64_t c, double layer)
{
    const struct block *b = &s->b;
    for (int k = -(b->dim == 3); k <= (b->dim == 3); k++)
        for (int j = -1; j <= 1; j++)
            for (int i = -1; i <= 1; i++)
                if (field[c + i + j * b->stride[1] + k * b->stride[2]] == layer)
                    return true;
    return false;
}

/* Layers by spreading over faces and corners from the wet cells; cells behind closed sides and
 * forced ones do not count. */
static void find_layers(struct fv *s)
{
    struct surface *f = s->surface;
    const struct block *b = &s->b;
    double *field = f->rate;
    for (int64_t c = 0; c < b->size; c++)
        field[c] = f->phi[c] < 0.0 && !(s->forcing && s->forcing->forced[c]) ? 0.0 : DEEP;
    for (int l = 1; l <= LAYERS; l++) {
        block_halo(b, 1, &field);
        BLOCK_ROWS (b, 0, at, n)
            for (int64_t c = at; c < at + n; c++)
                if (field[c] == DEEP && !(s->forcing && s->forcing->forced[c]) &&
                    touches(s, field, c, l - 1.0))
                    field[c] = l;
    }
    block_halo(b, 1, &field);
    for (int64_t c = 0; c < b->size; c++)
        f->layer[c] = (unsigned char)field[c];
}

void extension_build(struct fv *s)
{
    struct surface *f = s->surface;
    find_layers(s);
    f->nstencil = f->ngrad = f->ndeep = 0;
    for (int l = 0; l <= LAYERS; l++)
        f->ncarry[l] = 0;
    BLOCK_ROWS (&s->b, 0, at, n)
        for (int64_t c = at; c < at + n; c++) {
            const int l = f->layer[c];
            if (l >= 1 && l <= LAYERS)
                add_carry(s, c, l);
            else if (l == DEEP)
                f->deep[f->ndeep++] = c;
        }
}

/* No more than half as much again beyond what the stencil has, nothing far from the water. */
static double within(const double *u, const int *at, int n, int layer, double v)
{
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < n; k++) {
        low = fmin(low, u[at[k]]);
        high = fmax(high, u[at[k]]);
    }
    const double more = layer <= 2 ? 0.5 * (high - low) : 0.0;
    return n > 0 ? fmax(low - more, fmin(high + more, v)) : 0.0;
}

/* Normal derivatives of the components for a cell of the first layer; n.(D n) to stress. */
static void normal_slopes(const struct fv *s, const struct carry *x, double *const u[3],
                          enum extend how, double *slope)
{
    const struct surface *f = s->surface;
    const int dim = s->b.dim, *at = f->at + x->first;
    double G[3][3], normal = 0.0;
    for (int q = 0; q < dim; q++) {
        slope[q] = 0.0;
        for (int a = 0; a < dim; a++) {
            const double *w = f->grad + x->first_grad + a * x->n;
            G[q][a] = 0.0;
            for (int k = 0; k < x->n; k++)
                G[q][a] += w[k] * u[q][x->cell + at[k]];
            slope[q] += G[q][a] * x->n3[a];
        }
        normal += slope[q] * x->n3[q];
    }
    if (how == EXTEND_FREE)
        return;
    if (how == EXTEND_SHEAR)
        f->stress[x->cell] = normal;
    for (int q = 0; q < dim; q++) { /* G n - P (G + G^T) n = n (n.G n) - P G^T n */
        double other = 0.0;
        for (int a = 0; a < dim; a++)
            other += G[a][q] * x->n3[a];
        slope[q] = 2.0 * normal * x->n3[q] - other;
    }
}

/* No more than a quarter faster than what is around: bounds on components alone let a rough
 * surface overshoot in each layer anew, to three times the water's speed beside a breaking front.
 * A wave's velocity grows by exp(2 pi/n) over a cell, n cells a length: all of 28 and more pass. */
static void slow_down(const struct block *b, const struct carry *x, const int *at,
                      double *const u[3])
{
    double own = 0.0, most = 0.0;
    for (int q = 0; q < b->dim; q++)
        own += u[q][x->cell] * u[q][x->cell];
    for (int k = 0; k < x->n; k++) {
        double square = 0.0;
        for (int q = 0; q < b->dim; q++)
            square += u[q][x->cell + at[k]] * u[q][x->cell + at[k]];
        most = fmax(most, square);
    }
    if (own <= 1.25 * 1.25 * most)
        return;
    for (int q = 0; q < b->dim; q++)
        u[q][x->cell] *= 1.25 * sqrt(most / own);
}

static void carry_velocity(const struct fv *s, const struct carry *x, int layer, enum extend how,
                           double *const u[3])
{
    const struct surface *f = s->surface;
    const int *at = f->at + x->first;
    const double *w = f->weight + x->first;
    const bool clip = how != EXTEND_CHANGE;
    double slope[3] = {0.0, 0.0, 0.0};
    if (x->has_slope)
        normal_slopes(s, x, u, how, slope);
    else if (layer == 1 && how == EXTEND_SHEAR)
        f->stress[x->cell] = 0.0;
    for (int q = 0; q < s->b.dim; q++) {
        double v = x->slope * slope[q];
        for (int k = 0; k < x->n; k++)
            v += w[k] * u[q][x->cell + at[k]];
        u[q][x->cell] = clip ? within(u[q] + x->cell, at, x->n, layer, v) : v;
    }
    if (clip && layer <= 2)
        slow_down(&s->b, x, at, u);
}

void extension_apply(const struct fv *s, double *const u[3], enum extend how, int layers)
{
    const struct surface *f = s->surface;
    const struct block *b = &s->b;
    for (int64_t i = 0; i < f->ndeep; i++)
        for (int q = 0; q < b->dim; q++)
            u[q][f->deep[i]] = 0.0;
    for (int l = 1; l <= layers; l++) {
        block_halo(b, b->dim, u);
        for (int64_t i = 0; i < f->ncarry[l]; i++)
            carry_velocity(s, f->carry[l] + i, l, how, u);
    }
}

void extension_scalar(const struct fv *s, double *q)
{
    const struct surface *f = s->surface;
    for (int l = 1; l <= 2; l++) {
        block_halo(&s->b, 1, &q);
        for (int64_t i = 0; i < f->ncarry[l]; i++) {
            const struct carry *x = f->carry[l] + i;
            const int *at = f->at + x->first;
            double v = 0.0, slope = 0.0;
            for (int k = 0; k < x->n; k++) {
                const double u = q[x->cell + at[k]];
                v += f->weight[x->first + k] * u;
                for (int a = 0; x->has_slope && a < s->b.dim; a++)
                    slope += x->n3[a] * f->grad[x->first_grad + a * x->n + k] * u;
            }
            q[x->cell] = within(q + x->cell, at, x->n, l, v + x->slope * slope);
        }
    }
    block_halo(&s->b, 1, &q);
}

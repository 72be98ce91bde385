/* extension_apply.c - values of dry cells near the surface by the stencils of extension.c, layer by
 * layer. SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "fraction.h"

enum { STENCIL = 128 };

/* What the cells of a stencil hold. */
struct stencil_values {
    double v[3][STENCIL];
};

/* Gathers the components of a stencil's cells, so that what follows runs over arrays. */
static void look(const struct surface *f, const struct carry *x, int dim, double *const *u,
                 struct stencil_values *r)
{
    const int *at = f->at + x->first;
    for (int q = 0; q < dim; q++) {
        const double *from = u[q] + x->cell;
        for (int k = 0; k < x->n; k++)
            r->v[q][k] = from[at[k]];
    }
}

/* Unit vectors across the lower face of cell c along its first index, and along the others. */
static void frame_of(const struct fv *s, int64_t c, double e[3][3])
{
    for (int a = 0; a < s->dim; a++) {
        grid_face_vector(&s->grid, c, a, e[a]);
        for (int b = 0; b < a; b++)
            vec3_add(e[a], -vec3_dot(e[a], e[b]), e[b]);
        vec3_unit(e[a]);
    }
}

/* Velocities of a stencil as if they had turned with the lines of cells on the way to its cell: so
 * does thin water that runs along a wall. */
static void turn_values(const struct fv *s, const struct carry *x, struct stencil_values *r)
{
    double here[3][3] = {{0.0}}, there[3][3] = {{0.0}};
    frame_of(s, x->cell, here);
    for (int k = 0; k < x->n; k++) {
        double u[3] = {0.0, 0.0, 0.0}, v[3] = {0.0, 0.0, 0.0};
        frame_of(s, x->cell + s->surface->at[x->first + k], there);
        for (int q = 0; q < s->dim; q++)
            u[q] = r->v[q][k];
        for (int a = 0; a < s->dim; a++)
            vec3_add(v, vec3_dot(u, there[a]), here[a]);
        for (int q = 0; q < s->dim; q++)
            r->v[q][k] = v[q];
    }
}

enum { SAMPLES = 4 };

/* Of a stencil's n cells one that stands for others: what is within the bounds of a few is within
 * those of all, and mostly it is. */
static int sample(int n, int m) { return m * (n - 1) / (SAMPLES - 1); }

/* How far beyond what the stencil has, whose range it is, a velocity may be. */
static double slack(int layer, double range) { return layer <= 2 ? 0.5 * range : 0.0; }

static bool is_within_some(const double *v, int n, int layer, double value)
{
    double low = v[0], high = v[0];
    for (int m = 1; m < SAMPLES; m++) {
        low = lesser(v[sample(n, m)], low);
        high = greater(v[sample(n, m)], high);
    }
    const double more = slack(layer, high - low);
    return value >= low - more && value <= high + more;
}

/* No more than half as much again beyond what the stencil has, nothing far from the water. A
 * viscous film over a wall (film) is slower in the second layer than all of it, by three times as
 * much where the surface lies just above a wet centre; slower, but not the other way, needs no
 * bound there. */
static double within(const double *v, int n, int layer, bool film, double value)
{
    double low, high;
    if (is_within_some(v, n, layer, value))
        return value;
    lanes_bounds(v, n, &low, &high);
    const double range = high - low, more = slack(layer, range);
    double least = low - more, most = high + more;
    if (film) {
        least = lesser(least, greater(0.0, low - 3.0 * range));
        most = greater(most, lesser(0.0, high + 3.0 * range));
    }
    return greater(least, lesser(most, value));
}

/* The derivative along axis r of a cell's frame of what its stencil holds. */
static double derivative(const struct surface *f, const struct carry *x, int r, const double *v)
{
    return lanes_dot(f->grad + x->first_grad + r * x->n, v, x->n);
}

/* Normal derivatives of the components for a cell of the first layer, G n; n.(D n) to stress.
 * Without shear stress at the surface, where P (G + G^T) n = 0, P = 1 - n n:
 *   G n = n (n.G n) - P G^T n,  G^T n = grad(u.n). */
static void normal_slopes(const struct fv *s, const struct carry *x, const struct stencil_values *r,
                          enum extend how, double *slope)
{
    const struct surface *f = s->surface;
    double along[STENCIL];
    if (how == EXTEND_FREE) {
        for (int q = 0; q < s->dim; q++)
            slope[q] = derivative(f, x, 0, r->v[q]);
        return;
    }
    for (int k = 0; k < x->n; k++)
        along[k] = x->e[0][0] * r->v[0][k];
    for (int q = 1; q < s->dim; q++)
        for (int k = 0; k < x->n; k++)
            along[k] += x->e[0][q] * r->v[q][k];
    const double normal = derivative(f, x, 0, along);
    if (how == EXTEND_SHEAR)
        f->stress[x->cell] = normal;
    for (int q = 0; q < s->dim; q++)
        slope[q] = normal * x->e[0][q];
    for (int t = 1; t < s->dim; t++) {
        const double shear = derivative(f, x, t, along);
        for (int q = 0; q < s->dim; q++)
            slope[q] -= shear * x->e[t][q];
    }
}

/* |u|^2; square_in: of cell k of a stencil. */
static double square_of(int dim, const double *u)
{
    double sum = 0.0;
    for (int q = 0; q < dim; q++)
        sum += u[q] * u[q];
    return sum;
}

static double square_in(int dim, const struct stencil_values *r, int k)
{
    double sum = 0.0;
    for (int q = 0; q < dim; q++)
        sum += r->v[q][k] * r->v[q][k];
    return sum;
}

/* No more than a quarter faster than what is around: bounds on components alone let a rough
 * surface overshoot in each layer anew, to three times the water's speed beside a breaking front.
 * A wave's velocity grows by exp(2 pi/n) over a cell, n cells a length: all of 28 and more pass. */
static void slow_down(int dim, const struct stencil_values *r, int n, double u[3])
{
    const double often = 1.25 * 1.25, own = square_of(dim, u);
    double least, most, square[STENCIL];
    for (int m = 0; m < SAMPLES; m++)
        if (own <= often * square_in(dim, r, sample(n, m)))
            return;
    for (int k = 0; k < n; k++)
        square[k] = r->v[0][k] * r->v[0][k];
    for (int q = 1; q < dim; q++)
        for (int k = 0; k < n; k++)
            square[k] += r->v[q][k] * r->v[q][k];
    lanes_bounds(square, n, &least, &most);
    if (own <= often * most)
        return;
    for (int q = 0; q < dim; q++)
        u[q] *= 1.25 * sqrt(most / own);
}

/* Water that the pressure does not see, drops and films thinner than a cell, has the velocity of
 * what is around: where that is thrown aside by an impact, the drop would be, too, without a force.
 * It becomes no faster than by a fall of one cell, a third of it in each of a step's stages. What
 * the cell had before: u. */
static void keep_drop(const struct fv *s, int64_t c, double *const u[3], double own[3])
{
    const struct surface *f = s->surface;
    double was[3];
    for (int q = 0; q < s->dim; q++)
        was[q] = u[q][c];
    const double before = square_of(s->dim, was), most = before + 2.0 / 3.0 * f->g * f->across,
                 is = square_of(s->dim, own);
    for (int q = 0; q < s->dim && before > 0.0 && is > most; q++)
        own[q] *= sqrt(most / is);
}

/* -: share of a cell from which on its water is a drop. */
static const double DROP = 0.05;

static bool is_drop(const struct surface *f, const struct carry *x)
{
    return !x->has_slope && f->fraction && f->fraction->carries > 0.0 &&
           f->fraction->C[x->cell] > DROP;
}

static void carry_velocity(const struct fv *s, const struct carry *x, int layer, enum extend how,
                           double *const u[3])
{
    const struct surface *f = s->surface;
    const int dim = s->dim;
    const bool clip = how != EXTEND_CHANGE;
    double slope[3] = {0.0, 0.0, 0.0}, own[3] = {0.0, 0.0, 0.0};
    struct stencil_values r;
    look(f, x, dim, u, &r);
    if (x->turns)
        turn_values(s, x, &r);
    if (x->has_slope)
        normal_slopes(s, x, &r, how, slope);
    else if (layer == 1 && how == EXTEND_SHEAR)
        f->stress[x->cell] = 0.0;
    for (int q = 0; q < dim && x->n > 0; q++) {
        own[q] = x->slope * slope[q] + lanes_dot(f->weight + x->first, r.v[q], x->n);
        if (clip)
            own[q] = within(r.v[q], x->n, layer, x->slows, own[q]);
    }
    if (clip && layer <= 2 && x->n > 0)
        slow_down(dim, &r, x->n, own);
    if (clip && is_drop(f, x))
        keep_drop(s, x->cell, u, own);
    for (int q = 0; q < dim; q++)
        u[q][x->cell] = own[q];
}

/* Where blocks overlap, cells that are interpolated near the surface take part in what their donors
 * are made of: twice, and all layers, as donors lie further out. */
void extension_apply(const struct fv *s, double *const u[3], enum extend how, int layers)
{
    const struct surface *f = s->surface;
    const bool overlaps = grid_overlaps(&s->grid);
    const int last = overlaps ? LAYERS : layers;
    for (int64_t i = 0; i < f->ndeep; i++)
        for (int q = 0; q < s->dim; q++)
            u[q][f->deep[i]] = 0.0;
    if (overlaps && how == EXTEND_SHEAR) /* or donors would have what they had in other steps */
        memset(f->stress, 0, (size_t)s->size * sizeof(double));
    for (int pass = 0; pass < (overlaps ? 2 : 1); pass++)
        for (int l = 1; l <= last; l++) {
            grid_fill(&s->grid, s->dim, u);
            for (int64_t i = 0; i < f->ncarry[l]; i++)
                if (how != EXTEND_FREE || last > STENCILS || f->carry[l][i].ahead)
                    carry_velocity(s, f->carry[l] + i, l, how, u);
        }
}

/* The first two layers of a scalar, bounded as velocities are. */
void extension_scalar(const struct fv *s, double *q)
{
    const struct surface *f = s->surface;
    struct stencil_values r;
    for (int l = 1; l <= 2; l++) {
        grid_fill(&s->grid, 1, &q);
        for (int64_t i = 0; i < f->ncarry[l]; i++) {
            const struct carry *x = f->carry[l] + i;
            look(f, x, 1, &q, &r);
            const double slope = x->has_slope ? derivative(f, x, 0, r.v[0]) : 0.0,
                         v = lanes_dot(f->weight + x->first, r.v[0], x->n) + x->slope * slope;
            q[x->cell] = x->n > 0 ? within(r.v[0], x->n, l, false, v) : 0.0;
        }
    }
    grid_fill(&s->grid, 1, &q);
}

void extension_beyond(const struct fv *s, double *q)
{
    const struct surface *f = s->surface;
    struct stencil_values r;
    for (int l = 3; l <= LAYERS; l++) {
        grid_fill(&s->grid, 1, &q);
        for (int64_t i = 0; i < f->ncarry[l]; i++) {
            const struct carry *x = f->carry[l] + i;
            double low = 0.0, high = 0.0;
            look(f, x, 1, &q, &r);
            if (x->n > 0)
                lanes_bounds(r.v[0], x->n, &low, &high);
            const double v = lanes_dot(f->weight + x->first, r.v[0], x->n);
            q[x->cell] = greater(low, lesser(high, v));
        }
    }
    grid_fill(&s->grid, 1, &q);
}

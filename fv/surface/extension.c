/* extension.c - velocity of dry cells near the surface, layer by layer, by weighted least squares
 * over the known cells around: quadratic about the foot point in the first layer, whose normal
 * derivative is corrected to no shear stress, t.(G + G^T) n = 0; quadratic in the second, linear
 * further out. Weights depend on phi alone and are made once a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "../boundary/fv_boundary.h"
#include "extension_window.h"
#include "fraction.h"
#include "level_ops.h"
#include "mesh_view.h"
#include "near_water.h"

enum { TERMS = 10, WEDGE = 12 };

/* Normal equations of a fit over a stencil. */
struct least_squares {
    int m;                    /* terms */
    double A[TERMS][TERMS];   /* then its factor, A = L L^T */
    double b[TERMS][STENCIL]; /* terms at the cells */
    double w[STENCIL];
};

/* Cholesky's; false: the cells do not tell the terms apart. A pivot has lost six digits, or those
 * that have lost two and more have together lost six beyond that: two rows of cells that lean by
 * 0.001 have no second derivative across, which costs six at each of two pivots, and of the third
 * only rounding is left, 1e-4 of it. Or a term is rounding itself at all cells (a tangent, of cells
 * in one line along the normal), which loses none. Their slopes were noise over noise and drove
 * films aside at random. Terms are in sizes of a cell; good fits have pivots of 0.05 and more, ten
 * of them in 3D. */
static bool factor(struct least_squares *q)
{
    const double scale = q->A[0][0];
    double left = 1.0;
    for (int i = 0; i < q->m; i++) {
        const double whole = q->A[i][i];
        for (int j = 0; j <= i; j++) {
            double sum = q->A[i][j];
            for (int k = 0; k < j; k++)
                sum -= q->A[i][k] * q->A[j][k];
            if (i != j) {
                q->A[i][j] = sum / q->A[j][j];
                continue;
            }
            left *= lesser(1.0, 100.0 * sum / whole);
            if (!(whole > 1e-12 * scale && sum > 1e-6 * whole && left > 1e-6))
                return false;
            q->A[i][i] = sqrt(sum);
        }
    }
    return true;
}

/* n is a multiple of SUM_LANES. */
static bool prepare(struct least_squares *q, int n)
{
    double wb[STENCIL];
    for (int i = 0; i < q->m; i++) {
        for (int p = 0; p < n; p++)
            wb[p] = q->w[p] * q->b[i][p];
        for (int j = 0; j <= i; j++)
            q->A[i][j] = lanes_dot(wb, q->b[j], n);
    }
    return n >= q->m && factor(q);
}

/* Weights of the cells in the functional e of the fit. */
static void weights(const struct least_squares *q, int n, const double *e, double *restrict out)
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
    for (int p = 0; p < n; p++)
        out[p] = 0.0;
    for (int i = 0; i < q->m; i++)
        for (int p = 0; p < n; p++)
            out[p] += q->b[i][p] * y[i];
    for (int p = 0; p < n; p++)
        out[p] *= q->w[p];
}

/* 1, then the dim coordinates r (from `skip' on: a normal one left out), then their products, at n
 * places; the number of terms. */
static int terms(int dim, int order, bool skip, const double (*r)[STENCIL], int n,
                 double (*b)[STENCIL])
{
    int m = 0;
    for (int k = 0; k < n; k++)
        b[0][k] = 1.0;
    m++;
    for (int a = skip ? 1 : 0; a < dim && order > 0; a++)
        memcpy(b[m++], r[a], (size_t)n * sizeof(double));
    for (int a = 0; a < dim && order > 1; a++)
        for (int c = a; c < dim; c++, m++)
            for (int k = 0; k < n; k++)
                b[m][k] = r[a][k] * r[c][k];
    return m;
}

/* The same at one place. */
static void terms_at(int dim, int order, bool skip, const double *r, double *e)
{
    double at[3][STENCIL], b[TERMS][STENCIL];
    for (int a = 0; a < 3; a++)
        at[a][0] = r[a];
    const int m = terms(dim, order, skip, (const double(*)[STENCIL])at, 1, b);
    for (int i = 0; i < m; i++)
        e[i] = b[i][0];
}

/* depth is the distance from the surface along the normal, m; a slope below 0.2 counts as that, for
 * phi is no distance there. */
static void find_normal(const struct fv *s, int64_t c, int row, struct place *p)
{
    const double *q = s->surface->phi + c;
    double size = 0.0, n[3] = {0.0, 0.0, 0.0};
    s->surface->ops->gradient(s, p->part, c, row, s->surface->phi, n);
    for (int a = 0; a < s->dim; a++)
        size += n[a] * n[a];
    size = sqrt(size);
    if (!(size > 1e-3)) { /* no direction: a ridge of phi */
        n[0] = n[2] = 0.0;
        n[1] = size = 1.0;
    }
    p->depth = fmax(0.0, q[0]) / fmax(size, 0.2);
    memset(p->e, 0, sizeof p->e);
    for (int a = 0; a < 3; a++)
        p->e[0][a] = n[a] / size;
}

/* The normal and one or two tangents; in 3D the first tangent starts from the axis least along the
 * normal, which is never parallel to it. */
static void make_frame(const struct fv *s, int64_t c, int row, struct place *p)
{
    find_normal(s, c, row, p);
    if (s->dim == 2) {
        p->e[1][0] = -p->e[0][1];
        p->e[1][1] = p->e[0][0];
        return;
    }
    int least = 0;
    for (int a = 1; a < 3; a++)
        least = fabs(p->e[0][a]) < fabs(p->e[0][least]) ? a : least;
    for (int a = 0; a < 3; a++)
        p->e[1][a] = (a == least) - p->e[0][least] * p->e[0][a];
    vec3_unit(p->e[1]);
    vec3_cross(p->e[0], p->e[1], p->e[2]);
}

/* The best fit that the cells allow, of at most this order; the order done. */
static int fit(const struct fv *s, const struct place *p, int order, bool skip, const double *from,
               struct least_squares *q)
{
    for (int k = 0; k < p->n; k++) {
        double r2 = 0.25;
        for (int a = 0; a < s->dim; a++)
            r2 += (p->r[a][k] - from[a]) * (p->r[a][k] - from[a]);
        q->w[k] = 1.0 / (r2 * r2);
    }
    for (int k = p->known; k < p->n; k++)
        q->w[k] = 0.0;
    for (;; order--) {
        q->m = terms(s->dim, order, skip, p->r, p->n, q->b);
        if ((p->known >= q->m && prepare(q, p->n)) || order == 0)
            return order;
    }
}

/* Room for n more weights (and dim n of a gradient). */
static void make_room(struct surface *f, int64_t n, int64_t ngrad)
{
    if (f->nstencil + n > f->stencil_room) {
        const int64_t more = 2 * f->stencil_room + 4096;
        GROW_IN(f, f->at, f->nstencil, more);
        GROW_IN(f, f->weight, f->nstencil, more);
        f->stencil_room = more;
    }
    if (f->ngrad + ngrad > f->grad_room) {
        const int64_t more = 2 * f->grad_room + 8192;
        GROW_IN(f, f->grad, f->ngrad, more);
        f->grad_room = more;
    }
}

/* Gradient at the foot point, along the axes of the frame, by a quadratic without condition. Linear
 * where a quadratic's makes rough water grow: where index lines slant waves of a few cells at rest,
 * where water creeps what viscosity makes at the edge of a column (honey, 20 x 20 cells of 1 mm:
 * 2 m/s in 0.06 s at any step, for 0.04).
 */
static void gradient_weights(const struct fv *s, const struct place *p, double *grad)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    struct least_squares q;
    const int dim = s->dim,
              order = surface_inclined(s, p->part) ||
                              still_creep(s->gravity.hydrostatic, s->nu, p->spacing) > STILL_CREEPS
                          ? 1
                          : 2;
    double e[TERMS] = {0.0};
    memset(grad, 0, sizeof(double) * (size_t)(dim * p->n));
    if (fit(s, p, order, false, origin, &q) == 0)
        return;
    for (int r = 0; r < dim; r++) {
        e[1 + r] = 1.0 / p->spacing;
        weights(&q, p->n, e, grad + r * p->n);
        e[1 + r] = 0.0;
    }
}

/* Where viscosity crosses a cell while a wave does. */
static bool is_slow(const struct fv *s, double h)
{
    return still_creep(s->gravity.hydrostatic, s->nu, h) > 0.1;
}

/* Whether the window, in the cell's own column, ends at a side across gravity or on a box. */
static bool meets_floor(const struct fv *s, const struct place *p, int64_t c)
{
    const unsigned char *none = s->surface->none + c;
    bool meets = false;
    for (int i = -2; i <= 2; i++)
        meets = meets || none[(p->shift[p->upright] + i) * p->part->stride[p->upright]];
    return meets;
}

/* A film has no slope worth knowing: a quadratic through it overshoots, each layer of dry cells
 * more than the last, and convection feeds on it. Flat water fills 0.6 of the window, two cells
 * 0.4. Over a floor, where tongues run, all of the 0.6 is asked for, unless friction gives films
 * their slope; at sides along gravity no more than in the open, for they are planes of symmetry: a
 * half of a column is as the whole one, and a slab between two as one of a period. */
static bool is_thin(const struct fv *s, const struct place *p, int64_t c, int layer)
{
    if (window_reach(s, layer) == 1)
        return 2 * p->known < p->room;
    /* slopes over what two blocks have, each for itself, drive them apart */
    if (p->mixed && surface_any_inclined(s))
        return true;
    /* in the wedge between a slanting wall and the surface a slope from few cells grows */
    if (surface_inclined(s, p->part) && p->known < (s->dim == 2 ? WEDGE : 4 * WEDGE))
        return true;
    if (2 * p->known < p->room)
        return true;
    return 5 * p->known < 3 * p->room && meets_floor(s, p, c) &&
           !is_slow(s, s->surface->window->size(s, c));
}

/* Whether the second layer may be as slow as a film's. Faster water, rough as it is, wants the
 * bound: a column that splashes made pressures odd and even; and on blocks that lean rough water at
 * rest grows faster without. */
static bool may_slow(const struct fv *s, double h)
{
    return is_slow(s, h) && !surface_any_inclined(s);
}

/* Whether fluxes through the faces of water, of stencils along an axis, read cell c of the second
 * layer; on blocks they read across, too. A drop is judged by what it had (keep_drop). */
static bool is_read_ahead(const struct fv *s, int64_t c)
{
    const struct surface *f = s->surface;
    bool any = s->m || (f->fraction && f->fraction->C[c] > 0.0);
    for (int a = 0; a < s->dim && !any; a++) {
        const unsigned char *l = f->layer + c;
        const int64_t d = s->b.stride[a];
        any = l[-2 * d] == 0 || l[-d] == 0 || l[d] == 0 || l[2 * d] == 0;
    }
    return any;
}

/* By layer: extension_apply goes through them in this order. */
static void list_carry(const struct fv *s, int layer, const struct carry *x)
{
    struct surface *f = s->surface;
    ROOM_IN(f, f->carry[layer], f->ncarry[layer] + 1);
    f->carry[layer][f->ncarry[layer]] = *x;
    f->carry[layer][f->ncarry[layer]++].ahead = layer != 2 || is_read_ahead(s, x->cell);
}

/* Whether there is little water in the window, and cells behind a side: on lines of cells that bend
 * it follows them. Drops in flight go straight on. */
static bool is_film_on_wall(const struct fv *s, const struct place *p, int layer)
{
    const int wide = 2 * window_reach(s, layer) + 1;
    return p->part->kind == PART_CURVED && 2 * p->known < p->room &&
           p->room < (s->dim == 3 ? wide * wide * wide : wide * wide);
}

static void add_carry(struct fv *s, const struct part *part, int64_t c, int row, int layer)
{
    struct surface *f = s->surface;
    const int dim = s->dim;
    struct place p; /* not cleared: it is larger than what most cells use of it */
    struct least_squares q;
    double e[TERMS];
    p.part = part;
    p.spacing = f->window->size(s, c);
    p.mixed = false;
    make_frame(s, c, row, &p);
    f->window->look_around(s, c, layer, &p);
    if (f->window->is_own && !f->window->is_own(s, c, &p))
        return;
    make_room(f, STENCIL, (int64_t)dim * STENCIL);
    struct carry x = {.cell = c, .first = (int)f->nstencil, .n = p.n, .first_grad = (int)f->ngrad};
    double *w = f->weight + f->nstencil;
    for (int k = 0; k < p.n; k++)
        f->at[f->nstencil + k] = p.step[k];
    const bool thin = is_thin(s, &p, c, layer);
    const int order = fit(s, &p, thin ? 0 : layer <= 2 ? 2 : 1, layer == 1, p.self, &q);
    terms_at(dim, order, layer == 1, p.self, e);
    weights(&q, p.n, e, w);
    f->nstencil += p.n;
    memcpy(x.e, p.e, sizeof x.e);
    if (layer == 1 && !thin) {
        gradient_weights(s, &p, f->grad + f->ngrad);
        f->ngrad += (int64_t)dim * p.n;
        x.slope = p.self[0];
        for (int k = 0; k < p.n; k++)
            x.slope -= w[k] * p.r[0][k];
        x.slope *= p.spacing;
        x.has_slope = true;
    }
    x.slows = layer == 2 && may_slow(s, p.spacing);
    x.turns = is_film_on_wall(s, &p, layer);
    list_carry(s, layer, &x);
}

/* Weights of a new pattern, by the first cell that has it. In the axes of the grid, without the
 * surface's normal and depth: so the weights serve every cell of the pattern. */
static void learn(struct fv *s, int64_t c, int layer, struct place *p, struct pattern *x)
{
    struct surface *f = s->surface;
    struct least_squares q;
    double e[TERMS];
    p->spacing = f->window->size(s, c);
    f->window->look_along_axes(s, c, layer, x->key.shift, p);
    make_room(f, STENCIL, 0);
    x->first = (int)f->nstencil;
    x->n = p->n;
    for (int k = 0; k < p->n; k++)
        f->at[f->nstencil + k] = p->step[k];
    terms_at(s->dim, fit(s, p, x->key.order, false, p->self, &q), false, p->self, e);
    weights(&q, p->n, e, f->weight + f->nstencil);
    f->nstencil += p->n;
}

/* The same beyond the first layer where patterns decide. */
static void add_alike(struct fv *s, const struct part *part, int64_t c, int row, int layer)
{
    struct surface *f = s->surface;
    struct place p;
    p.part = part;
    p.mixed = false;
    find_normal(s, c, row, &p);
    struct pattern_key key = f->window->pattern(s, c, layer, &p);
    key.order = is_thin(s, &p, c, layer) ? 0 : layer <= 2 ? 2 : 1;
    struct pattern *x = patterns_find(f, &f->patterns, &key);
    if (x->n < 0)
        learn(s, c, layer, &p, x);
    list_carry(s, layer,
               &(struct carry){.cell = c,
                               .first = x->first,
                               .n = x->n,
                               .slows = layer == 2 && may_slow(s, f->window->size(s, c))});
}

/* least = the least of q and its neighbours along the stride, for a row. */
static void least_row(const double *restrict q, int64_t d, int64_t n, double *restrict least)
{
    for (int64_t i = 0; i < n; i++) {
        const double a = q[i - d] < q[i + d] ? q[i - d] : q[i + d];
        least[i] = a < q[i] ? a : q[i];
    }
}

static void next_layer_row(const double *restrict least, const double *restrict wall, double layer,
                           int64_t n, double *restrict field)
{
    for (int64_t i = 0; i < n; i++)
        field[i] = field[i] == DEEP && wall[i] == 0.0 && least[i] == layer - 1.0 ? layer : field[i];
}

/* Spreads layer l - 1 over one part's cells. */
static void next_layer(const struct part *p, double l, const double *wall, double *x, double *xy,
                       double *field)
{
    const bool deep = p->g[2] > 0;
    const int none[3] = {0, 0, 0}, one[3] = {1, 1, deep}, above[3] = {0, 0, deep};
    PART_NEAR (p, one, one, c, n)
        least_row(field + c, 1, n, x + c);
    PART_NEAR (p, above, above, c, n)
        least_row(x + c, p->stride[1], n, xy + c);
    if (deep)
        PART_NEAR (p, none, none, c, n)
            least_row(xy + c, p->stride[2], n, x + c);
    PART_NEAR (p, none, none, c, n)
        next_layer_row((deep ? x : xy) + c, wall + c, l, n, field + c);
}

/* h: what the surface may stand below a wet centre. Rounding along level water that stands at
 * centres would make wet and dry ones in turns. */
#define ON_CENTRE 1e-6

/* Layers by spreading over faces and corners from the wet cells, along one axis after the other;
 * cells behind closed sides and deep in a hole do not count. */
static void find_layers(struct fv *s)
{
    struct surface *f = s->surface;
    double *field = f->rate, *wall = f->kept;
    const double level = ON_CENTRE * f->least;
    for (int64_t c = 0; c < s->size; c++) /* what is not near water, and scratch there */
        field[c] = s->faces[0][c] = s->flux[c] = DEEP;
    for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
        PART_NEAR (p, p->g, p->g, c, n)
            for (int64_t i = c; i < c + n; i++) {
                wall[i] = surface_holds_none(s, i) ? 1.0 : 0.0;
                field[i] = f->phi[i] < level && wall[i] == 0.0 ? 0.0 : DEEP;
            }
    for (int l = 1; l <= LAYERS; l++) {
        grid_halo(&s->grid, 1, &field);
        for (int q = 0; q < s->grid.nparts; q++)
            next_layer(s->grid.part + q, l, wall, s->faces[0], s->flux, field);
    }
    grid_halo(&s->grid, 1, &field);
    for (int64_t c = 0; c < s->size; c++) /* whole: water of another rank comes near in ghosts */
        f->layer[c] = (unsigned char)field[c];
    near_water_find(s);
}

enum { KEPT_MOST = 1 << 20 }; /* weights of patterns that are kept, 8 MB */

/* Patterns of all but the first layer, and their stencils before those of this step alone. */
static void add_patterns(struct fv *s)
{
    struct surface *f = s->surface;
    f->nstencil = f->nkept;
    if (f->nkept > KEPT_MOST) {
        f->nstencil = 0;
        mem_free(f->patterns.of);
        f->patterns = (struct patterns){.n = 0};
    }
    FLOW_NEAR_AT (s, part, j, at, n)
        for (int64_t c = at; c < at + n; c++)
            if (f->layer[c] >= 2 && f->layer[c] <= LAYERS)
                add_alike(s, part, c, j, f->layer[c]);
    f->nkept = f->nstencil;
}

/* Once each time that the surface has moved. Patterns first: their stencils are kept from step to
 * step at the beginning of the lists, those of this step follow. */
void extension_build(struct fv *s)
{
    struct surface *f = s->surface;
    const bool alike = f->window->has_patterns && f->window->has_patterns(s);
    const int last = alike ? 1 : LAYERS;
    find_layers(s);
    if (f->window->begin)
        f->window->begin(s);
    f->nstencil = f->ngrad = f->ndeep = 0;
    for (int l = 0; l <= LAYERS; l++)
        f->ncarry[l] = 0;
    if (alike)
        add_patterns(s);
    FLOW_NEAR_AT (s, part, j, at, n)
        for (int64_t c = at; c < at + n; c++) {
            const int l = f->layer[c];
            if (f->window->is_wanted && !f->window->is_wanted(s, c, l))
                continue;
            if (l >= 1 && l <= last)
                add_carry(s, part, c, j, l);
            else if (l == DEEP)
                f->deep[f->ndeep++] = c;
        }
}

/* closest.c - distance of a cell's centre from the closest point of the surface, where the cells
 * around resolve it: phi is the product of cubics through four centres along each axis, and the
 * point x has phi(x) = 0 and x - centre along grad phi; both in turns (Chopp, SIAM J. Sci. Comput.
 * 23, 2001, eqs. 17-22). As all cells see one interpolant, the surface moves by its error alone, of
 * fourth order; what reinit.c does beside it moves it by h^3 at best.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"
#include "mesh_view.h"

enum {
    REACH = 3,             /* cells around that are read: the ghosts of a rank */
    NODES = 2 * REACH + 1, /* centres along an axis */
    TERMS = 5,             /* of a product: four, five on a centre */
    PASSES = 20
};
/* Second differences of phi (over h) up to which the cubics are trusted: a radius of one
 * cell. The ridge within a film has 2. Tighter bounds leave more to reinit.c, which loses water
 * where its cells lie beside these: 0.25 twice as much in the tongue of a dam break. */
static const double BENT = 1.0;
/* |grad phi|, or 1 over it, at the point. */
static const double STEEP = 2.0;
/* Square of the last pass over h^2, which is an error of the distance, as that is stationary. */
static const double EXACT = 1e-7;

/* What is around a cell. */
struct around {
    const double *phi;         /* at the cell */
    const unsigned char *none; /* the same: nothing is known there */
    const unsigned char *bent; /* the same: surface_note_bends; NULL: not noted */
    int dim;
    int64_t stride[3];
    double x[3][NODES]; /* m: centres along each axis, from the cell's */
    double per[3];      /* 1/m: 1 over their distance where they are even, else 0 */
    int lo[3], hi[3];   /* of the centres before sides and boxes */
    double h;           /* m: the smallest spacing */
};

/* Value and slope along an axis: weights of n centres from `first' on. */
struct cubic {
    int first, n;
    double value[TERMS], slope[TERMS];
};

/* Those of the cubic through four centres, times `share'. */
static void add_cubic(const double *X, double x, double share, double *value, double *slope)
{
    for (int k = 0; k < 4; k++) {
        double v = share, e = 0.0;
        for (int m = 0; m < 4; m++) {
            if (m == k)
                continue;
            const double per = 1.0 / (X[k] - X[m]);
            e = (e * (x - X[m]) + v) * per;
            v *= (x - X[m]) * per;
        }
        value[k] += v;
        slope[k] += e;
    }
}

/* The same of even ones, 1/per apart, at t spacings from the second. */
static void add_even_cubic(double per, double t, double share, double *value, double *slope)
{
    const double a = t + 1.0, b = t, c = t - 1.0, d = t - 2.0, sixth = share / 6.0,
                 half = 0.5 * share;
    value[0] -= sixth * (b * c * d);
    value[1] += half * (a * c * d);
    value[2] -= half * (a * b * d);
    value[3] += sixth * (a * b * c);
    slope[0] -= sixth * per * (c * d + b * (c + d));
    slope[1] += half * per * (c * d + a * (c + d));
    slope[2] -= half * per * (b * d + a * (b + d));
    slope[3] += sixth * per * (b * c + a * (b + c));
}

/* On a centre the mean of the cubics on either side, so that no side comes first. */
static void set_cubic(const struct around *w, int a, double x, struct cubic *q)
{
    const double *X = w->x[a], near = 1e-9 * w->h, per = w->per[a];
    const int last = w->hi[a] - 2;
    int i = w->lo[a] + 1;
    if (per > 0.0) { /* as the loop does, without a jump that cannot be foreseen */
        const int at = (int)ceil((x - near) * per) + REACH - 1, most = i > last ? i : last;
        i = at < i ? i : at > most ? most : at;
    } else
        while (i < last && x > X[i + 1] + near)
            i++;
    const bool on = i < last && x > X[i + 1] - near;
    const double share = on ? 0.5 : 1.0;
    *q = (struct cubic){.first = i - 1, .n = 4 + on};
    for (int k = 0; k <= on; k++)
        if (per > 0.0)
            add_even_cubic(per, (x - X[i + k]) * per, share, q->value + k, q->slope + k);
        else
            add_cubic(X + q->first + k, x, share, q->value + k, q->slope + k);
}

/* Step from the cell to the first centre that all three cubics read. */
static int64_t corner_of(const struct around *w, const struct cubic *q)
{
    int64_t c = 0;
    for (int a = 0; a < w->dim; a++)
        c += (q[a].first - REACH) * w->stride[a];
    return c;
}

/* Sum of the product of weights of n[a] centres along each axis, and its gradient. */
INLINE double product(const struct around *w, const struct cubic q[3], const int n[3], double *g)
{
    const double *corner = w->phi + corner_of(w, q);
    double sum = 0.0, slope[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++) {
            const double *row = corner + j * w->stride[1] + k * w->stride[2];
            double v = 0.0, e = 0.0;
            for (int i = 0; i < n[0]; i++) {
                v += q[0].value[i] * row[i];
                e += q[0].slope[i] * row[i];
            }
            sum += q[1].value[j] * q[2].value[k] * v;
            slope[0] += q[1].value[j] * q[2].value[k] * e;
            slope[1] += q[1].slope[j] * q[2].value[k] * v;
            slope[2] += q[1].value[j] * q[2].slope[k] * v;
        }
    memcpy(g, slope, sizeof slope);
    return sum;
}

/* phi at x, m from the cell, and its gradient; q: the weights that give them. Sets the weights,
 * then sums; the common cases have loops of fixed length for the vector units. */
static double value_at(const struct around *w, const double *x, struct cubic q[3], double *g)
{
    for (int a = 0; a < w->dim; a++)
        set_cubic(w, a, x[a], q + a);
    const bool plain = q[0].n == 4 && q[1].n == 4; /* nearly all: loops of known length */
    if (plain && q[2].n == 1)
        return product(w, q, (const int[]){4, 4, 1}, g);
    if (plain && q[2].n == 4)
        return product(w, q, (const int[]){4, 4, 4}, g);
    return product(w, q, (const int[]){q[0].n, q[1].n, q[2].n}, g);
}

/* The mean of the slopes of the cubics on either side of an even centre. */
static double slope_at_centre(const double *q, int64_t d, double per)
{
    return per / 12.0 * (8.0 * (q[d] - q[-d]) - (q[2 * d] - q[-2 * d]));
}

/* The same at the cell's own centre, where the cubics are phi itself and each slope is a line's. */
static double value_at_centre(const struct around *w, struct cubic q[3], double *g)
{
    for (int a = 0; a < w->dim; a++) {
        if (w->per[a] > 0.0 && w->lo[a] < REACH - 1 && w->hi[a] > REACH + 1) {
            g[a] = slope_at_centre(w->phi, w->stride[a], w->per[a]);
            continue;
        }
        set_cubic(w, a, 0.0, q + a);
        g[a] = 0.0;
        for (int k = 0; k < q[a].n; k++)
            g[a] += q[a].slope[k] * w->phi[(q[a].first + k - REACH) * w->stride[a]];
    }
    return w->phi[0];
}

/* Second derivative along axis a of phi, 1/m, at a centre: c, and its place X. */
static double bend_at(const struct around *w, int a, const double *c, const double *X)
{
    const int64_t d = w->stride[a];
    const double per = w->per[a];
    if (per > 0.0)
        return per * per * (c[d] - 2.0 * c[0] + c[-d]);
    return 2.0 / (X[1] - X[-1]) * ((c[d] - c[0]) / (X[1] - X[0]) - (c[0] - c[-d]) / (X[0] - X[-1]));
}

/* A bit for each axis along which phi bends too much at a cell, and one for cells without phi. */
enum { BLANK = 8 };

static void note_row(const double *restrict q, int64_t d, double per, double h, unsigned char bit,
                     int64_t n, unsigned char *restrict bent)
{
    for (int64_t i = 0; i < n; i++) {
        const double bend = per * per * (q[i + d] - 2.0 * q[i] + q[i - d]);
        bent[i] |= fabs(bend) * h <= BENT ? 0 : bit;
    }
}

void surface_note_bends(const struct fv *s, const double *phi)
{
    struct surface *f = s->surface;
    const struct part *p = &s->whole;
    if (!f->bent)
        return;
    PART_NEAR (p, p->g, p->g, c, n)
        for (int64_t i = c; i < c + n; i++)
            f->bent[i] = f->none[i] ? BLANK : 0;
    for (int a = 0; a < s->dim; a++) {
        int more[3];
        for (int t = 0; t < 3; t++)
            more[t] = p->g[t] - (t == a);
        PART_NEAR (p, more, more, c, n)
            note_row(phi + c, p->stride[a], 1.0 / s->b.h[a], f->least, (unsigned char)(1 << a), n,
                     f->bent + c);
    }
}

/* is_resolved of what was noted. */
static bool is_straight(const struct around *w, const struct cubic q[3])
{
    const unsigned char *corner = w->bent + corner_of(w, q);
    uint32_t bad = 0;
    for (int k = 0; k < q[2].n; k++)
        for (int j = 0; j < q[1].n; j++) {
            const unsigned char *row = corner + j * w->stride[1] + k * w->stride[2];
            const unsigned ends =
                BLANK | (j > 0 && j < q[1].n - 1 ? 2 : 0) | (k > 0 && k < q[2].n - 1 ? 4 : 0);
            if (q[0].n == 4) { /* nearly all: the line at once */
                uint32_t four;
                memcpy(&four, row, sizeof four);
                bad |= four & (ends * UINT32_C(0x01010101) | UINT32_C(0x00010100));
                continue;
            }
            bad |= (row[0] | row[q[0].n - 1]) & ends;
            for (int i = 1; i < q[0].n - 1; i++)
                bad |= row[i] & (ends | 1);
        }
    return bad == 0;
}

/* Whether the centres that the cubics at a point are through are known, and bent little. */
static bool is_resolved(const struct around *w, const struct cubic q[3])
{
    const int64_t corner = corner_of(w, q);
    if (w->bent)
        return is_straight(w, q);
    for (int k = 0; k < q[2].n; k++)
        for (int j = 0; j < q[1].n; j++)
            for (int i = 0; i < q[0].n; i++) {
                const int at[3] = {i, j, k};
                const int64_t at_cell = corner + i + j * w->stride[1] + k * w->stride[2];
                const double *c = w->phi + at_cell;
                if (w->none[at_cell])
                    return false;
                for (int a = 0; a < w->dim; a++)
                    if (at[a] > 0 && at[a] < q[a].n - 1 &&
                        !(fabs(bend_at(w, a, c, w->x[a] + q[a].first + at[a])) * w->h <= BENT))
                        return false;
            }
    return true;
}

/* One pass towards the closest point, the first one from the centre; the square of what it moves x
 * by, m^2; INFINITY: it leads away, more than two cells or behind a side. */
static double move(const struct around *w, struct cubic q[3], double *x, bool first)
{
    double g[3], g2 = 0.0, along = 0.0, moved = 0.0;
    const double p = first ? value_at_centre(w, q, g) : value_at(w, x, q, g);
    for (int a = 0; a < w->dim; a++) {
        g2 += g[a] * g[a];
        along += x[a] * g[a];
    }
    if (!(g2 * STEEP * STEEP > 1.0) || !(g2 < STEEP * STEEP))
        return INFINITY;
    for (int a = 0; a < w->dim; a++) {
        const double d = (along - p) / g2 * g[a] - x[a];
        moved += d * d;
        x[a] += d;
        const double *X = w->x[a], low = X[w->lo[a]], high = X[w->hi[a]];
        if (x[a] < greater(X[1], low - 0.5 * w->h) ||
            x[a] > lesser(X[NODES - 2], high + 0.5 * w->h))
            return INFINITY;
    }
    return moved;
}

/* Cells that follow one along the step d, before a side or a box, at most REACH. */
static int free_along(const unsigned char *none, int64_t d)
{
    int n = 0;
    while (n < REACH && !none[(n + 1) * d])
        n++;
    return n;
}

/* Distances of the centres along axis a from that of cell i of them, m. */
static void set_places(const struct fv *s, const struct part *p, int a, int i, struct around *w)
{
    const double *line = s->m                  ? s->surface->mesh->line[p - s->grid.part][a]
                         : a == 1 && s->b.rows ? s->b.rows->y
                                               : NULL;
    const double h = s->m ? s->surface->mesh->size[p - s->grid.part][a] : s->b.h[a];
    double least = h;
    for (int k = -REACH; k <= REACH; k++)
        w->x[a][k + REACH] = line ? line[i + k] - line[i] : k * h;
    w->per[a] = line ? 0.0 : 1.0 / h;
    if (line)
        least = s->m ? 0.5 * (line[i + 1] - line[i - 1]) : block_size(&s->b, a, i);
    w->h = lesser(w->h, least);
}

/* Nothing behind a side or a box is read: what is mirrored there has a kink, but where the surface
 * meets it upright. */
static bool look_around(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                        struct around *w)
{
    int at[3];
    *w =
        (struct around){.phi = phi + c, .none = s->surface->none + c, .dim = s->dim, .h = INFINITY};
    w->bent = s->surface->bent ? s->surface->bent + c : NULL;
    part_index(p, c, at);
    for (int a = 0; a < s->dim; a++) {
        w->stride[a] = p->stride[a];
        w->lo[a] = REACH - free_along(w->none, -p->stride[a]);
        w->hi[a] = REACH + free_along(w->none, p->stride[a]);
        if (w->hi[a] - w->lo[a] < 3)
            return false;
        set_places(s, p, a, at[a], w);
    }
    return true;
}

/* Whether passes go on where cubics are not through what resolves the surface, or no longer come
 * closer, as between two bends: of points that are found in the end not one in 500 is like that,
 * and the other way round they took a quarter of all passes. */
static bool is_lost(const struct around *w, const struct cubic q[3], double before, double moved)
{
    return moved > before || !is_resolved(w, q);
}

/* false: the cells around do not resolve the surface, and *distance is left as it is. Two passes at
 * least: the first starts from the centre and knows nothing of how phi bends. */
bool surface_closest(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                     double *distance)
{
    struct around w;
    struct cubic q[3] = {{.n = 1}, {.n = 1}, {.n = 1, .value = {1.0}}}; /* beyond dim 1 */
    double x[3] = {0.0, 0.0, 0.0}, moved = INFINITY, square = 0.0;
    if (fabs(phi[c]) > 3.0 * s->surface->largest || !look_around(s, p, phi, c, &w))
        return false;
    const double near = EXACT * w.h * w.h;
    for (int k = 0; k < PASSES && (k < 2 || moved > near); k++) {
        const double before = moved;
        moved = move(&w, q, x, k == 0);
        if (!isfinite(moved) || (k >= 2 && moved > near && is_lost(&w, q, before, moved)))
            return false;
    }
    if (moved > near || !is_resolved(&w, q))
        return false;
    for (int a = 0; a < s->dim; a++)
        square += x[a] * x[a];
    *distance = copysign(sqrt(square), phi[c]);
    return true;
}

/* shape_distance.c - signed distance of the scene's water at the start, < 0 inside: shapes one
 * after the other, unions by the least, holes by the largest.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"

/* Whether a side of the water is, seen from x, a box that is cut out: what lies half a cell beyond
 * it is, and x is in the water's half or in that box. Of rooms behind the box it is none. */
static bool is_wall(const struct fv *s, const double *x, int a, double side, double out)
{
    const struct block *b = &s->b;
    const bool behind = out * (x[a] - side) > 0.0;
    for (int k = 0; s->blocked && k < s->prm.nboxes; k++) {
        int lo[3], hi[3];
        bool in = true;
        blocked_cells(&s->run->scene.domain, &s->prm, k, lo, hi);
        for (int t = 0; t < b->dim; t++) {
            const double y = t == a ? side + 0.5 * out * b->h[a] : x[t];
            const double at = (y - b->origin[t]) / b->h[t], own = (x[t] - b->origin[t]) / b->h[t];
            in = in && at > lo[t] && at < hi[t] && !(behind && (own <= lo[t] || own >= hi[t]));
        }
        if (in)
            return true;
    }
    return false;
}

/* Whether a side of the water is, seen from x, a closed side of a block, which lies across axis a
 * there, with the block on the water's side of it; of rooms behind the wall it is none. At the
 * start: where blocks move to is no matter. */
static bool is_block_wall(const struct fv *s, const struct scene_shape *h, const double *x, int a,
                          double side, double out)
{
    const bool behind = out * (x[a] - side) > 0.0;
    for (int k = 0; s->m && !behind && k < s->m->nblocks; k++)
        for (int q = 0; q < 2 * s->dim; q++) {
            const struct mesh_block *b = s->m->block + k;
            const double *lo = b->opening[q][0], *hi = b->opening[q][1];
            const double eps = 1e-6 * fabs(b->opening[q ^ 1][0][a] - side);
            bool on = side_is_wall(b->side[q]) && fabs(lo[a] - side) < eps &&
                      fabs(hi[a] - side) < eps && out * (b->opening[q ^ 1][0][a] - side) < 0.0;
            for (int t = 0; t < s->dim && on; t++) {
                const bool flat = t == 2 && !(h->box[1][t] > h->box[0][t]);
                const double y = flat ? x[t] : fmax(h->box[0][t], fmin(h->box[1][t], x[t]));
                on = t == a || (y >= lo[t] - eps && y <= hi[t] + eps);
            }
            if (on)
                return true;
        }
    return false;
}

/* Whether a side of the shape's box is, seen from x, a wall for its water: for that within, of a
 * hole for that around it. */
static bool is_closed(const struct fv *s, const struct scene_shape *h, const double *x, int a,
                      int upper)
{
    const double side = h->box[upper][a], out = (upper ? 1.0 : -1.0) * (h->hole ? -1.0 : 1.0);
    double y[3] = {x[0], x[1], x[2]};
    for (int t = 0; h->hole && t < s->dim;
         t++) /* beside a corner the face that ends there counts */
        if (t != a && h->box[1][t] > h->box[0][t])
            y[t] = fmax(h->box[0][t] + 0.5 * s->b.h[t], fmin(h->box[1][t] - 0.5 * s->b.h[t], x[t]));
    return is_wall(s, y, a, side, out) || is_block_wall(s, h, x, a, side, out);
}

/* m: along the side, from x, to where a box that is cut out no longer lies on it, and air does; its
 * edges are faces of cells. INFINITY: not within CELLS of them, or not before the side ends. */
static double to_open(const struct fv *s, const struct scene_shape *h, const double *x, int a,
                      int upper)
{
    enum { CELLS = 12 };
    double least = INFINITY;
    for (int t = 0; t < s->dim && s->blocked; t++)
        for (int way = -1; way <= 1 && t != a; way += 2) {
            double y[3] = {x[0], x[1], x[2]};
            for (int k = 1; k <= CELLS; k++) {
                y[t] = x[t] + way * k * s->b.h[t];
                if (h->box[1][t] > h->box[0][t] && (y[t] < h->box[0][t] || y[t] > h->box[1][t]))
                    break;
                if (!is_closed(s, h, y, a, upper)) {
                    least = fmin(least, (k - 0.5) * s->b.h[t]);
                    break;
                }
            }
        }
    return least;
}

/* Sides of the box that lie on or beyond the domain's, on a wall of a block, or on a box that is
 * cut out, are walls, not surface. What lies beyond such a side of a hole is far from it. */
static double box(const struct fv *s, const struct scene_shape *h, const double *x)
{
    const struct scene_domain *domain = &s->run->scene.domain;
    double out2 = 0.0, in = -INFINITY;
    for (int a = 0; a < s->dim; a++) {
        const double low = domain->min[a], high = domain->max[a];
        const double eps = 1e-6 * (s->m ? 1e-3 * (high - low) : s->b.h[a]);
        if (a == 2 && !(h->box[1][a] > h->box[0][a]))
            continue; /* a plane box in 3D goes through */
        double d = -INFINITY;
        for (int upper = 0; upper < 2; upper++) {
            const double side = h->box[upper][a], beyond = upper ? x[a] - side : side - x[a];
            if (upper ? side >= high - eps : side <= low + eps)
                continue;
            const bool closed = is_closed(s, h, x, a, upper);
            if (closed && h->hole && beyond > 0.0)
                return INFINITY;
            if (!closed || h->hole)
                d = fmax(d, beyond);
            else if (beyond < 0.0) /* the surface begins beside what closes it */
                d = fmax(d, -hypot(beyond, to_open(s, h, x, a, upper)));
        }
        in = fmax(in, d);
        out2 += d > 0.0 ? d * d : 0.0;
    }
    return out2 > 0.0 ? sqrt(out2) : in;
}

/* Whether an edge lies on a side of the domain, or beyond it: that is where water ends at a wall,
 * no surface. */
static bool on_side(const struct fv *s, const double *a, const double *b)
{
    const struct scene_domain *domain = &s->run->scene.domain;
    for (int t = 0; t < 2; t++) {
        const double low = domain->min[t], high = domain->max[t], eps = 1e-9 * (high - low);
        if ((a[t] <= low + eps && b[t] <= low + eps) || (a[t] >= high - eps && b[t] >= high - eps))
            return true;
    }
    return false;
}

/* Whether the point y lies on a straight side q of a block, whose water is where `out' points away
 * from. Of a block in 3D its lowest layer is asked. */
static bool is_on_straight(const struct mesh_block *b, int q, const double *y, const double *out)
{
    const int a = q / 2, n = b->n[1 - a];
    int at[2] = {q % 2 ? b->n[0] : 0, q % 2 ? b->n[1] : 0};
    at[1 - a] = 0;
    const double *p = b->x[mesh_vertex(b, at[0], at[1], 0)];
    at[1 - a] = n;
    const double *r = b->x[mesh_vertex(b, at[0], at[1], 0)];
    const double e[2] = {r[0] - p[0], r[1] - p[1]}, d[2] = {y[0] - p[0], y[1] - p[1]};
    const double ee = e[0] * e[0] + e[1] * e[1], along = (d[0] * e[0] + d[1] * e[1]) / ee;
    if (fabs(d[0] * e[1] - d[1] * e[0]) > 1e-6 * ee || along < -1e-6 || along > 1.0 + 1e-6)
        return false;
    for (at[1 - a] = 0; at[1 - a] <= n; at[1 - a]++) {
        const double *v = b->x[mesh_vertex(b, at[0], at[1], 0)];
        if (fabs((v[0] - p[0]) * e[1] - (v[1] - p[1]) * e[0]) > 1e-6 * ee)
            return false;
    }
    at[a] = q % 2 ? b->n[a] - 1 : 1; /* a line of vertices within */
    at[1 - a] = n / 2;
    const double *in = b->x[mesh_vertex(b, at[0], at[1], 0)];
    return (in[0] - p[0]) * out[0] + (in[1] - p[1]) * out[1] < 0.0;
}

/* Whether the edge of a polygon from a to b is, seen from x, a closed side of a block or the face
 * of a box that is cut out; out: across it, away from the water. */
static bool is_edge_closed(const struct fv *s, const double *a, const double *b, const double *x,
                           const double *out)
{
    const double e[2] = {b[0] - a[0], b[1] - a[1]}, ee = e[0] * e[0] + e[1] * e[1];
    const double m = ((x[0] - a[0]) * e[0] + (x[1] - a[1]) * e[1]) / ee;
    const double w = fmax(0.0, fmin(1.0, m)), y[2] = {a[0] + w * e[0], a[1] + w * e[1]};
    for (int t = 0; t < 2; t++) {
        const double inset = fmin(0.5, 0.5 * s->b.h[1 - t] / sqrt(ee)), z = 1.0 - inset;
        const double v = fmax(inset, fmin(z, m)),
                     at[3] = {t ? a[0] + v * e[0] : x[0], t ? x[1] : a[1] + v * e[1], x[2]};
        if (fabs(e[t]) < 1e-9 * sqrt(ee) && is_wall(s, at, t, a[t], out[t] > 0.0 ? 1.0 : -1.0))
            return true;
    }
    if ((x[0] - a[0]) * out[0] + (x[1] - a[1]) * out[1] > 0.0)
        return false;
    for (int k = 0; s->m && k < s->m->nblocks; k++)
        for (int q = 0; q < 4; q++)
            if (side_is_wall(s->m->block[k].side[q]) && is_on_straight(s->m->block + k, q, y, out))
                return true;
    return false;
}

/* Twice the area within, > 0 if the corners go round to the left. */
static double twice_area(const struct param_points *p)
{
    double sum = 0.0;
    for (int k = 0, l = p->n - 1; k < p->n; l = k++)
        sum += p->x[l][0] * p->x[k][1] - p->x[k][0] * p->x[l][1];
    return sum;
}

/* Whether the edge to corner k is, seen from x, a wall. */
static bool edge_is_wall(const struct fv *s, const struct param_points *p, int k, double turn,
                         const double *x)
{
    const double *a = p->x[(k + p->n - 1) % p->n], *b = p->x[k % p->n];
    const double out[2] = {turn * (b[1] - a[1]), turn * (a[0] - b[0])};
    return on_side(s, a, b) || is_edge_closed(s, a, b, x, out);
}

/* Of edges that end where one on a wall begins, the whole line counts. */
static double polygon(const struct fv *s, const struct scene_shape *h, const double *x)
{
    const struct param_points *p = &h->points;
    const double turn = (twice_area(p) < 0.0) != h->hole ? -1.0 : 1.0;
    double least = INFINITY;
    bool in = false;
    for (int k = 0, l = p->n - 1; k < p->n; l = k++) {
        const double *a = p->x[k], *b = p->x[l];
        const double e[2] = {b[0] - a[0], b[1] - a[1]}, r[2] = {x[0] - a[0], x[1] - a[1]};
        const double ee = e[0] * e[0] + e[1] * e[1];
        double m = ee > 0.0 ? (e[0] * r[0] + e[1] * r[1]) / ee : 0.0;
        if ((a[1] > x[1]) != (b[1] > x[1]) &&
            x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]))
            in = !in;
        if (edge_is_wall(s, p, k, turn, x))
            continue;
        m = m < 0.0 && !edge_is_wall(s, p, k + 1, turn, x) ? 0.0 : m;
        m = m > 1.0 && !edge_is_wall(s, p, l, turn, x) ? 1.0 : m;
        least = fmin(least, hypot(r[0] - m * e[0], r[1] - m * e[1]));
    }
    return in ? -least : least;
}

/* Whether the circle of a disc is a round closed side of a block for its water: for that within, of
 * a hole for that around it. */
static bool is_round_wall(const struct fv *s, const struct scene_shape *h)
{
    for (int k = 0; s->m && s->dim == 2 && k < s->m->nblocks; k++) {
        const struct mesh_block *b = s->m->block + k;
        for (int q = 0; q < 4; q++) {
            bool on = side_is_wall(b->side[q]);
            int at[2];
            for (int l = 0; on && l <= b->n[1 - q / 2]; l++) {
                at[q / 2] = q % 2 ? b->n[q / 2] : 0;
                at[1 - q / 2] = l;
                const double *v = b->x[mesh_vertex(b, at[0], at[1], 0)];
                on = fabs(sqrt(vec_distance2(2, v, h->centre)) - h->radius) < 1e-6 * h->radius;
            }
            at[q / 2] = q % 2 ? b->n[q / 2] - 1 : 1;
            const double *v = b->x[mesh_vertex(b, at[0], at[1], 0)];
            if (on && (vec_distance2(2, v, h->centre) < h->radius * h->radius) != h->hole)
                return true;
        }
    }
    return false;
}

static double disc(const struct fv *s, const struct scene_shape *h, const double *x)
{
    const double d = sqrt(vec_distance2(s->dim, x, h->centre)) - h->radius;
    const bool of_water = (d < 0.0) != h->hole;
    return of_water && is_round_wall(s, h) ? (h->hole ? INFINITY : -INFINITY) : d;
}

/* m: < 0 within the shape; walls that bound it are no surface. */
static double shape(const struct fv *s, const struct scene_shape *h, const double *x)
{
    switch (h->form) {
    case SHAPE_BOX:
        return box(s, h, x);
    case SHAPE_POLYGON:
        return polygon(s, h, x);
    case SHAPE_DISC:
        return disc(s, h, x);
    default:
        return scene_height(&s->run->scene, x) - h->level;
    }
}

/* --- several shapes: where they meet there is no surface --- */

/* Whether water is at x plus a ten millionth of the domain along `way'. */
static bool is_water(const struct fv *s, const double *x, const double *way, double sign)
{
    const struct scene *c = &s->run->scene;
    double y[3] = {x[0], x[1], x[2]};
    bool water = false;
    for (int a = 0; a < s->dim; a++)
        y[a] += sign * 1e-7 * (c->domain.max[a] - c->domain.min[a]) * way[a];
    for (int k = 0; k < c->nshapes; k++)
        if (scene_in_shape(c, c->shapes + k, y))
            water = !c->shapes[k].hole;
    return water;
}

/* Whether the water ends at y, across which `out' goes. */
static bool ends_at(const struct fv *s, const double *y, const double *out)
{
    return is_water(s, y, out, 1.0) != is_water(s, y, out, -1.0);
}

/* Whether the water ends at w, 0 to 1, of the edge from a to b; *least: at most its distance. */
static bool edge_ends(const struct fv *s, const double *a, const double *b, const double *out,
                      double w, const double *x, double *least)
{
    const double y[3] = {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1]), x[2]};
    const bool ends = ends_at(s, y, out);
    if (ends)
        *least = fmin(*least, sqrt(vec_distance2(2, x, y)));
    return ends;
}

/* Distance of x from the nearest place of an edge in the plane where the water ends, m, or `least'
 * if that is nearer; the edge goes from a to b, across `out', x stands at m of its length. */
static double to_edge(const struct fv *s, const double *a, const double *b, const double *out,
                      double m, const double *x, double least)
{
    enum { PARTS = 64, HALVINGS = 24 };
    const double e[2] = {b[0] - a[0], b[1] - a[1]},
                 d[2] = {x[0] - a[0] - m * e[0], x[1] - a[1] - m * e[1]};
    const double across = d[0] * d[0] + d[1] * d[1], along = e[0] * e[0] + e[1] * e[1];
    for (int way = 0; way < 2; way++) {
        double within = m, end = NAN; /* the shape goes on; the water ends */
        for (int k = 0; k <= PARTS && isnan(end); k++) {
            const double w = m + (way - m) * k / PARTS;
            if (across + (w - m) * (w - m) * along >= least * least)
                break;
            *(edge_ends(s, a, b, out, w, x, &least) ? &end : &within) = w;
        }
        for (int k = 0; k < HALVINGS && !isnan(end) && end != m; k++) {
            const double w = 0.5 * (within + end);
            *(edge_ends(s, a, b, out, w, x, &least) ? &end : &within) = w;
        }
    }
    return least;
}

/* The same of the side of a box across axis a; in 3D of the place nearest to x alone. */
static double to_side(const struct fv *s, const struct scene_shape *h, const double *x, int a,
                      int upper, double least)
{
    double y[3] = {x[0], x[1], x[2]}, out[3] = {0.0, 0.0, 0.0};
    const int t = 1 - a;
    for (int k = 0; k < s->dim; k++)
        if (h->box[1][k] > h->box[0][k])
            y[k] = fmax(h->box[0][k] + 1e-9 * (h->box[1][k] - h->box[0][k]),
                        fmin(h->box[1][k] - 1e-9 * (h->box[1][k] - h->box[0][k]), x[k]));
    y[a] = h->box[upper][a];
    out[a] = 1.0;
    if (s->dim == 3)
        return ends_at(s, y, out) ? fmin(least, sqrt(vec_distance2(3, x, y))) : least;
    double from[2], to[2];
    from[a] = to[a] = y[a];
    from[t] = h->box[0][t];
    to[t] = h->box[1][t];
    return to_edge(s, from, to, out, (y[t] - from[t]) / (to[t] - from[t]), x, least);
}

/* Of all sides of a box that are no walls. */
static double to_box(const struct fv *s, const struct scene_shape *h, const double *x, double least)
{
    const struct scene_domain *domain = &s->run->scene.domain;
    for (int a = 0; a < s->dim; a++)
        for (int upper = 0; upper < 2; upper++) {
            const double side = h->box[upper][a];
            const double eps = 1e-9 * (domain->max[a] - domain->min[a]);
            if (h->box[1][a] > h->box[0][a] && side > domain->min[a] + eps &&
                side < domain->max[a] - eps && !is_closed(s, h, x, a, upper))
                least = to_side(s, h, x, a, upper, least);
        }
    return least;
}

/* Of all edges of a polygon that are no walls. */
static double to_polygon(const struct fv *s, const struct scene_shape *h, const double *x,
                         double least)
{
    const struct param_points *p = &h->points;
    const double turn = (twice_area(p) < 0.0) != h->hole ? -1.0 : 1.0;
    for (int k = 0, l = p->n - 1; k < p->n; l = k++) {
        const double *a = p->x[l], *b = p->x[k], e[2] = {b[0] - a[0], b[1] - a[1]};
        const double ee = e[0] * e[0] + e[1] * e[1], out[3] = {e[1] / sqrt(ee), -e[0] / sqrt(ee)};
        const double m = ((x[0] - a[0]) * e[0] + (x[1] - a[1]) * e[1]) / ee;
        if (ee > 0.0 && !edge_is_wall(s, p, k, turn, x))
            least = to_edge(s, a, b, out, fmax(1e-9, fmin(1.0 - 1e-9, m)), x, least);
    }
    return least;
}

/* Of the level of water below it, in the plane; far: half of the length that is looked at, m. */
static double to_level(const struct fv *s, const struct scene_shape *h, const double *x, double far,
                       double least)
{
    const double *g = s->gravity.hydrostatic, size = vec3_length(g);
    const double out[3] = {g[0] / size, g[1] / size, 0.0};
    const double deep = scene_height(&s->run->scene, x) - h->level;
    const double y[2] = {x[0] + deep * out[0], x[1] + deep * out[1]};
    const double from[2] = {y[0] - far * out[1], y[1] + far * out[0]},
                 to[2] = {y[0] + far * out[1], y[1] - far * out[0]};
    return to_edge(s, from, to, out, 0.5, x, least);
}

/* Whether all shapes have straight sides; in 3D they are boxes. */
static bool are_straight(const struct fv *s)
{
    const struct scene *c = &s->run->scene;
    bool straight = true;
    for (int k = 0; k < c->nshapes; k++)
        straight = straight && (c->shapes[k].form == SHAPE_BOX ||
                                (s->dim == 2 && c->shapes[k].form == SHAPE_POLYGON) ||
                                (s->dim == 2 && c->shapes[k].form == SHAPE_BELOW &&
                                 vec3_length(s->gravity.hydrostatic) > 0.0));
    return straight;
}

/* Shapes of straight sides that may meet: d with the distance to where their water ends. */
static double where_shapes_end(const struct fv *s, const double *x, double d, double far)
{
    const struct scene *c = &s->run->scene;
    double least = far;
    const bool wet = d != 0.0 ? d < 0.0 : is_water(s, x, (double[]){1.0, 0.7, 0.3}, 1.0);
    for (int k = 0; k < c->nshapes; k++) {
        const struct scene_shape *h = c->shapes + k;
        least = h->form == SHAPE_BOX       ? to_box(s, h, x, least)
                : h->form == SHAPE_POLYGON ? to_polygon(s, h, x, least)
                                           : to_level(s, h, x, far, least);
    }
    return wet ? -least : least;
}

/* Cut off at the domain's size, for what has no surface at all is infinitely far. */
double surface_distance(const struct fv *s, const double *x)
{
    const struct scene *c = &s->run->scene;
    const struct scene_initial *f = &c->initial;
    double far = 0.0;
    for (int a = 0; a < s->dim; a++)
        far += c->domain.max[a] - c->domain.min[a];
    double d = far;
    if (c->nshapes == 0)
        d = scene_has_wave(c) && f->level < LEVEL_TOP ? x[1] - exact_surface(&s->exact, x[0])
                                                      : -far;
    for (int k = 0; k < c->nshapes; k++) {
        const double e = shape(s, c->shapes + k, x);
        d = c->shapes[k].hole ? fmax(d, -e) : fmin(d, e);
    }
    if (c->nshapes > 1 && are_straight(s))
        d = where_shapes_end(s, x, d, far);
    return fmax(-far, fmin(far, d));
}

const struct scene_shape *surface_shape(const struct fv *s, const double *x)
{
    const struct scene *c = &s->run->scene;
    const struct scene_shape *last = NULL;
    for (int k = 0; k < c->nshapes; k++)
        if (shape(s, c->shapes + k, x) < 0.0)
            last = c->shapes[k].hole ? NULL : c->shapes + k;
    return last;
}

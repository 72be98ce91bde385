/* scene_fluid.c - see scene_fluid.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_fluid.h"

#include "scene_cut.h"
#include "scene_geometry.h"
#include "scene_lines.h"
#include "scene_mesh.h"

/* Whether water comes in or goes out at an end of the axis and no closed side stops it there. */
static bool is_channel(const struct scene *s, int a)
{
    bool opens = false, stops = false;
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        const bool across = w->side != SIDE_NONE && (w->side - SIDE_X_MIN) / 2 == a;
        const bool open = w->kind == WALL_INFLOW || w->kind == WALL_OUTFLOW;
        opens = opens || (across && open);
        stops = stops || (across && !open && w->kind != WALL_FALLS);
    }
    return opens && !stops;
}

bool scene_is_driven_along(const struct scene *s, int a)
{
    bool steeper = false;
    if (s->domain.periodic[a])
        return true;
    for (int b = 0; b < s->domain.dim; b++)
        steeper =
            steeper || (!s->domain.periodic[b] &&
                        fabs(s->fluid.gravity[b]) > fabs(s->fluid.gravity[a]) && !is_channel(s, b));
    return steeper && s->fluid.gravity[a] != 0.0 && is_channel(s, a) && scene_has_surface(s);
}

/* What water at rest has: elsewhere gravity is a body force that drives it. */
double scene_still_gravity(const struct scene *s, double still[3])
{
    double g2 = 0.0;
    for (int a = 0; a < 3; a++) {
        still[a] = a < s->domain.dim && !scene_is_driven_along(s, a) ? s->fluid.gravity[a] : 0.0;
        g2 += still[a] * still[a];
    }
    return sqrt(g2);
}

/* The axis with most of it, of two alike the later one; -1: there is none. */
int scene_still_axis(const struct scene *s)
{
    double g[3];
    int axis = 0;
    if (scene_still_gravity(s, g) == 0.0)
        return -1;
    for (int a = 1; a < s->domain.dim; a++)
        axis = fabs(g[a]) >= fabs(g[axis]) ? a : axis;
    return axis;
}

/* Whether the wall is a line that keeps all water where it is: closed, with the fluid inside, or
 * around all shapes, with two ends that are as high as they are. lo, hi: its bounds, m. */
static bool is_basin(const struct scene *s, const struct scene_wall *w, double lo[3], double hi[3])
{
    const struct line l = line_of(&w->points, w->closed);
    if (w->side != SIDE_NONE || l.n < 3)
        return false;
    outline_bounds(l.n, l.x, lo, hi);
    if (w->closed)
        return line_area(&l) > 0.0;
    const double ends = fmin(scene_height(s, l.x[0]), scene_height(s, l.x[l.n - 1]));
    bool all = s->nshapes > 0;
    for (int k = 0; k < s->nshapes; k++) {
        double from[3], to[3], x[3] = {0.0};
        scene_shape_extent(s->shapes + k, from, to);
        for (int i = 0; i < 4; i++) {
            x[0] = i & 1 ? from[0] : to[0];
            x[1] = i & 2 ? from[1] : to[1];
            const double near = 1e-9 * (hi[0] - lo[0] + hi[1] - lo[1]);
            all = all && scene_height(s, x) <= ends + near && x[0] >= lo[0] - near &&
                  x[0] <= hi[0] + near && x[1] >= lo[1] - near && x[1] <= hi[1] + near;
        }
    }
    return all;
}

void scene_basin(const struct scene *s, double lo[3], double hi[3])
{
    double from[3], to[3];
    int n = 0;
    memcpy(lo, s->domain.min, sizeof s->domain.min);
    memcpy(hi, s->domain.max, sizeof s->domain.max);
    for (int k = 0; k < s->nwalls && s->domain.dim == 2; k++)
        if (is_basin(s, s->walls + k, from, to) && ++n == 1)
            for (int a = 0; a < 2; a++) {
                lo[a] = fmax(s->domain.min[a], from[a]);
                hi[a] = fmin(s->domain.max[a], to[a]);
            }
    for (int a = 0; a < 2 && n > 1; a++) { /* which of them has the water? */
        lo[a] = s->domain.min[a];
        hi[a] = s->domain.max[a];
    }
}

/* The farthest place along the other axis up to which a body that is not free, from `to' on, has an
 * edge on the plane x_a = at. */
static double held_to(const struct scene *s, int a, double at, double to, double near)
{
    double far = to;
    for (int k = 0; k < s->nbodies; k++) {
        const struct param_points *p = &s->bodies[k].points;
        for (int i = 0; i < p->n && !s->bodies[k].free; i++) {
            const double *from = p->x[i], *end = p->x[(i + 1) % p->n];
            if (fabs(from[a] - at) <= near && fabs(end[a] - at) <= near &&
                fmin(from[1 - a], end[1 - a]) <= to + near)
                far = fmax(far, fmax(from[1 - a], end[1 - a]));
        }
    }
    return far;
}

/* The same of the water of another shape on the side `out', 1 or -1, of that plane. */
static double borne_to(const struct scene *s, const struct scene_shape *h, int a, double at,
                       double to, double near)
{
    double far = to;
    const double out = at == h->box[0][a] ? -2.0 * near : 2.0 * near;
    for (const struct scene_shape *q = s->shapes; q < s->shapes + s->nshapes; q++) {
        double x[3] = {0.0};
        x[a] = at + out;
        x[1 - a] = to + 2.0 * near;
        if (q != h && !q->hole && q->form == SHAPE_BOX && scene_in_shape(s, q, x))
            far = fmax(far, q->box[1][1 - a]);
    }
    return far;
}

/* Whether a face of a box, in 2D, on the plane x_a = at ends on bodies and on water all along. */
static bool is_held(const struct scene *s, const struct scene_shape *h, int a, double at)
{
    const double hi = h->box[1][1 - a], near = 1e-6 * (hi - h->box[0][1 - a]);
    double to = h->box[0][1 - a], before = -INFINITY;
    while (to < hi - near && to > before) {
        before = to;
        to = fmax(held_to(s, a, at, to, near), borne_to(s, h, a, at, to, near));
    }
    return to >= hi - near;
}

/* Whether the shape is water at rest: a box must fill the section below its top, from side to side
 * or to bodies that hold it, or to other boxes, which must be at rest, too. */
bool scene_is_level(const struct scene *s, const struct scene_shape *h)
{
    const int up = scene_still_axis(s);
    if (h->hole || h->velocity[0] != 0.0 || h->velocity[1] != 0.0 || h->velocity[2] != 0.0)
        return false;
    if (h->form != SHAPE_BOX || up < 0)
        return h->form == SHAPE_BELOW;
    double g[3], min[3], max[3];
    const double size = scene_still_gravity(s, g);
    bool level = fabs(g[up]) > (1.0 - 1e-9) * size;
    scene_basin(s, min, max);
    for (int a = 0; a < s->domain.dim && level; a++) {
        const double near = 1e-9 * (max[a] - min[a]);
        bool low = h->box[0][a] <= min[a] + near, high = h->box[1][a] >= max[a] - near;
        if (s->domain.dim == 2 && !low)
            low = is_held(s, h, a, h->box[0][a]);
        if (s->domain.dim == 2 && !high)
            high = is_held(s, h, a, h->box[1][a]);
        level = a != up ? low && high : g[up] < 0.0 ? low : high;
    }
    return level;
}

double scene_level(const struct scene *s, const struct scene_shape *h)
{
    const int up = scene_still_axis(s);
    if (h->form == SHAPE_BELOW || up < 0)
        return h->level;
    return s->fluid.gravity[up] < 0.0 ? h->box[1][up] : -h->box[0][up];
}

double scene_height(const struct scene *s, const double *x)
{
    double g[3];
    const double size = scene_still_gravity(s, g);
    if (size == 0.0)
        return x[s->domain.dim - 1];
    return -(g[0] * x[0] + g[1] * x[1] + g[2] * x[2]) / size;
}

void scene_heights(const struct scene *s, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int k = 0; k < 8; k++) {
        double x[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < s->domain.dim; a++)
            x[a] = k >> a & 1 ? s->domain.max[a] : s->domain.min[a];
        *low = fmin(*low, scene_height(s, x)) + 0.0; /* no -0 in messages */
        *high = fmax(*high, scene_height(s, x)) + 0.0;
    }
}

/* y: x, or beyond a periodic side its image in the domain: a box of particles may lie across it. */
static void find_image(const struct scene_domain *d, const double *x, double y[3])
{
    y[0] = y[1] = y[2] = 0.0;
    for (int a = 0; a < d->dim; a++) {
        const bool beyond = x[a] < d->min[a] || x[a] > d->max[a];
        y[a] = beyond ? scene_image_from(d, a, d->min[a], x[a]) : x[a];
    }
}

bool scene_in_shape(const struct scene *s, const struct scene_shape *h, const double *at)
{
    const struct line polygon = line_of(&h->points, true);
    bool in = true;
    double r2 = 0.0, x[3];
    find_image(&s->domain, at, x);
    for (int a = 0; a < s->domain.dim; a++) {
        const bool given =
            a < 2 || h->box[1][a] > h->box[0][a]; /* a plane box in 3D goes through */
        in = in && (!given || (x[a] > h->box[0][a] && x[a] < h->box[1][a]));
        r2 += (x[a] - h->centre[a]) * (x[a] - h->centre[a]);
    }
    switch (h->form) {
    case SHAPE_BOX:
        return in;
    case SHAPE_POLYGON:
        return line_inside(&polygon, x);
    case SHAPE_DISC:
        return r2 < h->radius * h->radius;
    case SHAPE_MESH: {
        const struct scene_mesh *m = scene_mesh_of(s, MESH_OF_SHAPE, (int)(h - s->shapes));
        return m && scene_mesh_holds(m, x);
    }
    default:
        return scene_height(s, x) < h->level;
    }
}

/* The last shape that holds x decides, so that holes and later shapes overrule earlier ones. */
bool scene_is_fluid(const struct scene *s, const struct exact *e, const double *x, double *velocity)
{
    const struct scene_initial *f = &s->initial;
    const struct scene_shape *in = NULL;
    bool fluid = s->nshapes == 0;
    if (fluid && scene_has_wave(s))
        fluid = x[1] < exact_surface(e, x[0]);
    if (fluid && f->field == FIELD_PATCH)
        fluid = fmax(fabs(x[0]), fabs(x[1])) < 0.5 * f->L;
    if (fluid && f->field == FIELD_DROP)
        fluid = x[0] * x[0] + x[1] * x[1] < f->L * f->L;
    for (int k = 0; k < s->nshapes; k++)
        if (scene_in_shape(s, s->shapes + k, x))
            in = s->shapes + k;
    for (int a = 0; velocity && a < 3; a++)
        velocity[a] = in ? in->velocity[a] : 0.0;
    return in ? !in->hole : fluid;
}

bool scene_shapes_move(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nshapes; k++) {
        const double *v = s->shapes[k].velocity;
        any = any || (!s->shapes[k].hole && (v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0));
    }
    return any;
}

void scene_shape_extent(const struct scene_shape *h, double lo[3], double hi[3])
{
    const bool points = h->form == SHAPE_POLYGON && h->points.n > 0;
    for (int a = 0; a < 3; a++) {
        const bool box = h->form == SHAPE_BOX && (a < 2 || h->box[1][2] > h->box[0][2]);
        const bool disc = h->form == SHAPE_DISC;
        lo[a] = box ? h->box[0][a] : disc ? h->centre[a] - h->radius : -INFINITY;
        hi[a] = box ? h->box[1][a] : disc ? h->centre[a] + h->radius : INFINITY;
    }
    if (points)
        outline_bounds(h->points.n, h->points.x, lo, hi);
}

/* Whether shape k holds fluid at one of these places. */
static bool holds_grain(const struct scene *s, const struct exact *e, int k, const double *first,
                        const double *h, const int *n)
{
    double lo[3], hi[3], x[3] = {0.0, 0.0, 0.0};
    int from[3] = {0, 0, 0}, to[3] = {0, 0, 0}, i[3];
    scene_shape_extent(s->shapes + k, lo, hi);
    for (int a = 0; a < s->domain.dim; a++) {
        from[a] = (int)fmin(fmax(0.0, floor((lo[a] - first[a]) / h[a])), n[a]);
        to[a] = (int)fmax(fmin(n[a] - 1.0, ceil((hi[a] - first[a]) / h[a])), -1.0);
    }
    for (i[2] = from[2]; i[2] <= to[2]; i[2]++)
        for (i[1] = from[1]; i[1] <= to[1]; i[1]++)
            for (i[0] = from[0]; i[0] <= to[0]; i[0]++) {
                for (int a = 0; a < s->domain.dim; a++)
                    x[a] = first[a] + i[a] * h[a];
                if (scene_in_shape(s, s->shapes + k, x) && scene_is_fluid(s, e, x, NULL))
                    return true;
            }
    return false;
}

/* A grain is a particle or a cell: whether shapes hold any at this spacing, before all of them are
 * made. */
void scene_check_grains(const struct scene *s, const struct params *p, const double *first,
                        const double *h, const int *n, const char *grain, struct faults *f)
{
    const struct exact e = exact_create(s);
    bool holds[SHAPES_MAX], any = scene_has_wave(s);
    for (int k = 0; k < s->nshapes; k++) {
        holds[k] = s->shapes[k].form == SHAPE_MESH ||
                   (!s->shapes[k].hole && holds_grain(s, &e, k, first, h, n));
        any = any || holds[k];
    }
    if (s->nshapes > 0 && !any) {
        params_fault(p, f, "shapes",
                     "no %s lies in the shapes less their holes, at a spacing of %g m: there is no "
                     "water; a larger shape, a finer spacing, or a smaller hole",
                     grain, h[0]);
        return;
    }
    for (int k = 0; k < s->nshapes; k++)
        if (!holds[k] && !s->shapes[k].hole)
            log_warn("shape %d contains no %s at a spacing of %g m: it has no water", k + 1, grain,
                     h[0]);
}

bool scene_is_room(const struct scene *s, const double *x)
{
    for (int k = 0; k < s->nbodies; k++) {
        const struct line l = line_of(&s->bodies[k].points, true);
        if (l.n > 2 && line_inside(&l, x) != s->bodies[k].tank)
            return false;
    }
    return scene_in_tanks(s, x);
}

/* Whether x lies inside a closed line, or inside one of its images next to it. */
static bool inside_some(const struct scene_domain *d, const struct line *l, const double *x)
{
    bool in = false;
    for (int i = d->periodic[0] ? -1 : 0; i <= (d->periodic[0] ? 1 : 0) && !in; i++)
        for (int j = d->periodic[1] ? -1 : 0; j <= (d->periodic[1] ? 1 : 0) && !in; j++) {
            const double y[2] = {x[0] + i * (d->max[0] - d->min[0]),
                                 x[1] + j * (d->max[1] - d->min[1])};
            in = line_inside(l, y);
        }
    return in;
}

/* A closed line is a tank if it runs counter-clockwise (the fluid on its left), else an island. */
bool scene_in_tanks(const struct scene *s, const double *x)
{
    for (int k = 0; k < s->nwalls; k++) {
        const struct line l = line_of(&s->walls[k].points, true);
        if (s->walls[k].closed && inside_some(&s->domain, &l, x) != (line_area(&l) > 0.0))
            return false;
    }
    return true;
}

static void close_line(struct param_points *p, bool *closed)
{
    struct line l = line_of(p, *closed);
    line_trim(&l);
    p->n = l.n;
    *closed = l.closed;
}

/* Senses first, then cuts: what of a body lies behind a wall is told by the wall's sense. */
void scene_orient(struct scene *s)
{
    for (int k = 0; k < s->nbodies; k++) {
        struct scene_body *b = s->bodies + k;
        bool closed = true;
        close_line(&b->points, &closed);
        const struct line l = line_of(&b->points, true);
        b->turned = l.n > 2 && (line_area(&l) > 0.0) != b->tank;
        if (b->turned)
            points_reverse(&b->points);
    }
    for (int k = 0; k < s->nwalls; k++) {
        struct scene_wall *w = s->walls + k;
        if (w->side != SIDE_NONE || w->points.n < 2)
            continue;
        close_line(&w->points, &w->closed);
        scene_cut_at_periods(s, w);
        w->turned = scene_line_is_reversed(s, k);
        if (w->turned)
            points_reverse(&w->points);
    }
    for (int k = 0; k < s->nbodies; k++)
        scene_cut_at_walls(s, s->bodies + k);
}

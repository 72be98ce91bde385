/* wall_cover3.c - see wall_cover3.h. Rectangles are halved until they are clear of the meshes or
 * small; those that are alike again are put together. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_cover3.h"

enum state { SEEN, HIDDEN, MIXED };

struct cover {
    const struct cover_side *is;
    int nmeshes;
    const struct tree *const *mesh;
    double size; /* m */
    struct trimesh out;
    int vertices, triangles; /* room */
};

/* A rectangle in the two axes along the side. */
struct cover_box {
    double lo[2], hi[2];
};

/* From the two coordinates in the side to space, m; axes run cyclically after the side's. */
static void place(const struct cover *c, double p, double q, double *x)
{
    x[c->is->axis] = c->is->at;
    x[(c->is->axis + 1) % 3] = p;
    x[(c->is->axis + 2) % 3] = q;
}

/* A convex polygon of n corners, or turned. */
static void emit(struct cover *c, int n, const double (*x)[3], bool turned)
{
    struct trimesh *m = &c->out;
    if (m->nvertices + n > c->vertices) {
        GROW(m->x, c->vertices, 2 * c->vertices + 64);
        c->vertices = 2 * c->vertices + 64;
    }
    if (m->ntriangles + n > c->triangles) {
        GROW(m->vertex, c->triangles, 2 * c->triangles + 64);
        c->triangles = 2 * c->triangles + 64;
    }
    for (int k = 2; k < n; k++) {
        int *v = m->vertex[m->ntriangles++];
        v[0] = m->nvertices;
        v[1] = m->nvertices + (turned ? k : k - 1);
        v[2] = m->nvertices + (turned ? k - 1 : k);
    }
    memcpy(m->x + m->nvertices, x, (size_t)n * sizeof *x);
    m->nvertices += n;
}

static void corners(const struct cover *c, const struct cover_box *b, double (*x)[3])
{
    for (int k = 0; k < 4; k++)
        place(c, k == 1 || k == 2 ? b->hi[0] : b->lo[0], k > 1 ? b->hi[1] : b->lo[1], x[k]);
}

/* Of all covering meshes; triangle -1: there are none. */
static struct tree_foot nearest(const struct cover *c, const double *x)
{
    struct tree_foot best = {.distance = INFINITY, .triangle = -1};
    for (int k = 0; k < c->nmeshes; k++) {
        const struct tree_foot f = tree_nearest(c->mesh[k], x, fabs(best.distance));
        if (f.triangle >= 0)
            best = f;
    }
    return best;
}

/* What of a convex polygon has a positive height h (Sutherland & Hodgman, Comm. ACM 17, 1974), in
 * y; returns the number of its corners. */
static int above(int n, const double (*x)[3], const double *h, double (*y)[3])
{
    int corners = 0;
    for (int k = 0; k < n; k++) {
        const int next = (k + 1) % n;
        if (h[k] > 0.0)
            memcpy(y[corners++], x[k], sizeof *y);
        if ((h[k] > 0.0) == (h[next] > 0.0))
            continue;
        for (int a = 0; a < 3; a++)
            y[corners][a] = x[k][a] + h[k] / (h[k] - h[next]) * (x[next][a] - x[k][a]);
        corners++;
    }
    return corners;
}

/* The rectangle is left to the fluid; triangles are turned on low sides so that normals point out.
 */
static enum state whole(struct cover *c, const struct cover_box *b)
{
    double x[4][3];
    corners(c, b, x);
    emit(c, 4, (const double(*)[3])x, !c->is->high);
    return SEEN;
}

/* A small rectangle, as far as it lies before the plane of the mesh. */
static enum state clip(struct cover *c, const struct cover_box *b, const struct tree_foot *f)
{
    double x[4][3], y[8][3], h[4];
    int hidden = 0;
    corners(c, b, x);
    for (int k = 0; k < 4; k++) {
        double d[3];
        vec3_from(x[k], f->foot, d);
        h[k] = vec3_dot(d, f->n); /* > 0: before it */
        hidden += h[k] <= 0.0;
    }
    if (hidden == 4)
        return HIDDEN;
    const int n = above(4, (const double(*)[3])x, h, y);
    emit(c, n, (const double(*)[3])y, !c->is->high);
    return hidden > 0 ? MIXED : SEEN;
}

/* A rim on the side parts it; one elsewhere says nothing of what is before it. */
static bool is_on_side(const struct cover *c, const double *x)
{
    return fabs(x[c->is->axis] - c->is->at) < 0.1 * c->size;
}

static bool is_parallel(const struct cover *c, const struct tree_foot *f)
{
    return fabs(f->n[c->is->axis]) > 1.0 - 1e-6;
}

/* A small rectangle at a mesh; where the mesh lies in the side, of two alike the side is kept, of
 * two back to back none, but for what sticks out at a corner. */
static enum state cut(struct cover *c, const struct cover_box *b, const struct tree_foot *f)
{
    double x[4][3];
    if (!is_parallel(c, f))
        return clip(c, b, f);
    if ((f->n[c->is->axis] > 0.0) == c->is->high)
        return whole(c, b);
    corners(c, b, x);
    for (int k = 0; k < 4; k++) {
        const struct tree_foot g = nearest(c, x[k]);
        if (g.distance > 1e-9 * c->size && !is_parallel(c, &g))
            return clip(c, b, &g);
    }
    return HIDDEN;
}

/* Clear of the meshes: farther than half its diagonal from the nearest triangle. Of two halves that
 * are all seen one rectangle is made again, so that a side that nothing covers costs two triangles.
 */
static enum state cover(struct cover *c, const struct cover_box *b)
{
    const double p = 0.5 * (b->lo[0] + b->hi[0]), q = 0.5 * (b->lo[1] + b->hi[1]);
    const double w[2] = {b->hi[0] - b->lo[0], b->hi[1] - b->lo[1]};
    const int vertices = c->out.nvertices, triangles = c->out.ntriangles;
    enum state first = SEEN, all = SEEN;
    double x[3];
    place(c, p, q, x);
    const struct tree_foot f = nearest(c, x);
    const bool no_side = f.triangle < 0 || (f.rim && !is_on_side(c, f.foot));
    const bool seen = no_side || f.distance > 0.0;
    if (fabs(f.distance) > 0.5 * hypot(w[0], w[1]))
        return seen ? whole(c, b) : HIDDEN;
    if (fmax(w[0], w[1]) <= c->size)
        return no_side ? whole(c, b) : cut(c, b, &f);
    for (int half = 0; half < 2; half++) { /* the longer way is halved */
        struct cover_box part = *b;
        const int a = w[1] > w[0];
        (half ? part.lo : part.hi)[a] = a ? q : p;
        const enum state is = cover(c, &part);
        first = half ? first : is;
        all = is == first ? first : MIXED;
    }
    if (all != SEEN)
        return all;
    c->out.nvertices = vertices;
    c->out.ntriangles = triangles;
    return whole(c, b);
}

struct trimesh wall_cover_side(const struct cover_side *is, int n, const struct tree *const *mesh,
                               double size)
{
    struct cover c = {.is = is, .nmeshes = n, .mesh = mesh, .size = size};
    struct cover_box all;
    for (int a = 0; a < 2; a++) {
        const int axis = (is->axis + 1 + a) % 3;
        all.lo[a] = is->lo[axis];
        all.hi[a] = is->hi[axis];
    }
    cover(&c, &all);
    return c.out;
}

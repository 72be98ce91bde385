/* tree.c - bounding volume tree: halves by the middle of the centres along the longest axis, four
 * triangles a leaf; see tree.h. SPDX-License-Identifier: BSD-3-Clause */
#include "tree.h"

#include "../base/base.h"

enum { LEAF = 4, DEPTH = 96 };

/* Its box, outwards in float, from the tree's origin. The first child of an inner node follows it.
 */
struct node {
    float lo[3], hi[3];
    int n;  /* triangles of a leaf; 0: inner */
    int at; /* first of them in `order'; the second child */
};

struct tree {
    const struct trimesh *m;
    double origin[3];
    int nnodes;
    struct node *nodes;
    int *order;    /* [ntriangles] */
    float (*n)[3]; /* [nvertices] angle-weighted normals */
    bool *rim;     /* [nvertices] */
};

/* --- making --- */

/* Bounds of one triangle, m. */
static void box_of(const struct tree *t, int triangle, double lo[3], double hi[3])
{
    for (int a = 0; a < 3; a++) {
        const int *v = t->m->vertex[triangle];
        const double p = t->m->x[v[0]][a], q = t->m->x[v[1]][a], r = t->m->x[v[2]][a];
        lo[a] = fmin(p, fmin(q, r));
        hi[a] = fmax(p, fmax(q, r));
    }
}

/* Rounded outwards, so that a box in float never leaves out a triangle in double. */
static void set_box(const struct tree *t, struct node *node, int first, int n)
{
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = first; i < first + n; i++) {
        double low[3], high[3];
        box_of(t, t->order[i], low, high);
        for (int a = 0; a < 3; a++) {
            lo[a] = fmin(lo[a], low[a]);
            hi[a] = fmax(hi[a], high[a]);
        }
    }
    for (int a = 0; a < 3; a++) {
        node->lo[a] = nextafterf((float)(lo[a] - t->origin[a]), -INFINITY);
        node->hi[a] = nextafterf((float)(hi[a] - t->origin[a]), INFINITY);
    }
}

/* Puts those `first' of order[n] along the axis before the others (Hoare's selection). Linear in n
 * on average, which is all that halving needs: nothing is sorted. */
static void select_first(int *order, int n, int first, const float (*c)[3], int axis)
{
    int lo = 0, hi = n - 1;
    while (lo < hi) {
        const float pivot = c[order[lo + (hi - lo) / 2]][axis];
        int i = lo, k = hi;
        while (i <= k) {
            while (c[order[i]][axis] < pivot)
                i++;
            while (c[order[k]][axis] > pivot)
                k--;
            if (i <= k) {
                const int o = order[i];
                order[i++] = order[k];
                order[k--] = o;
            }
        }
        if (first <= k)
            hi = k;
        else if (first >= i)
            lo = i;
        else
            return;
    }
}

/* Of the centres, which is what is halved. */
static int longest_axis(const int *order, int n, const float (*c)[3])
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < n; i++)
        for (int a = 0; a < 3; a++) {
            lo[a] = fminf(lo[a], c[order[i]][a]);
            hi[a] = fmaxf(hi[a], c[order[i]][a]);
        }
    int axis = 0;
    for (int a = 1; a < 3; a++)
        axis = hi[a] - lo[a] > hi[axis] - lo[axis] ? a : axis;
    return axis;
}

/* Leaves are full but for the last: the first half is a multiple of LEAF. Depth log2(n/LEAF) + 1,
 * far below DEPTH; O(n log n). Children are written before the second one's place is known, so that
 * a walk meets the first child next to its parent. */
static void build(struct tree *t, int first, int n, const float (*c)[3])
{
    struct node *node = t->nodes + t->nnodes++;
    set_box(t, node, first, n);
    if (n <= LEAF) {
        node->n = n;
        node->at = first;
        return;
    }
    const int half = (n / 2 + LEAF - 1) / LEAF * LEAF;
    select_first(t->order + first, n, half, c, longest_axis(t->order + first, n, c));
    build(t, first, half, c);
    node->at = t->nnodes;
    build(t, first + half, n - half, c);
}

/* Angle-weighted normals of the vertices, and which lie on a rim. */
static void find_normals(struct tree *t)
{
    const struct trimesh *m = t->m;
    double(*sum)[3] = (double(*)[3])mem_new((size_t)m->nvertices, sizeof *sum);
    for (int i = 0; i < m->ntriangles; i++) {
        const int *v = m->vertex[i];
        double n[3];
        trimesh_normal(m, i, n);
        for (int k = 0; k < 3; k++) {
            double d[3], e[3], out[3];
            vec3_from(m->x[v[k]], m->x[v[(k + 1) % 3]], d);
            vec3_from(m->x[v[k]], m->x[v[(k + 2) % 3]], e);
            vec3_cross(d, e, out);
            const double angle = atan2(vec3_length(out), vec3_dot(d, e));
            for (int a = 0; a < 3; a++)
                sum[v[k]][a] += angle * n[a];
            if (m->neighbour[i][k] < 0)
                t->rim[v[k]] = t->rim[v[(k + 1) % 3]] = true;
        }
    }
    for (int v = 0; v < m->nvertices; v++) {
        vec3_unit(sum[v]);
        for (int a = 0; a < 3; a++)
            t->n[v][a] = (float)sum[v][a];
    }
    mem_free(sum);
}

/* Centres in float, from the middle of the mesh, where their digits are. */
struct tree *tree_create(const struct trimesh *m)
{
    struct tree *t = NEW(struct tree, 1);
    const int n = m->ntriangles;
    double lo[3], hi[3];
    t->m = m;
    trimesh_bounds(m, lo, hi);
    for (int a = 0; a < 3; a++)
        t->origin[a] = m->nvertices > 0 ? 0.5 * (lo[a] + hi[a]) : 0.0;
    t->nodes = NEW_IN(t, struct node, 2 * ((n + LEAF - 1) / LEAF));
    t->order = NEW_IN(t, int, n);
    t->n = (float(*)[3])mem_new_in(t, (size_t)m->nvertices, sizeof *t->n);
    t->rim = NEW_IN(t, bool, m->nvertices);
    float(*c)[3] = (float(*)[3])mem_new((size_t)n, sizeof *c);
    for (int i = 0; i < n; i++) {
        double low[3], high[3];
        t->order[i] = i;
        box_of(t, i, low, high);
        for (int a = 0; a < 3; a++)
            c[i][a] = (float)(0.5 * (low[a] + high[a]) - t->origin[a]);
    }
    if (n > 0)
        build(t, 0, n, (const float(*)[3])c);
    mem_free(c);
    find_normals(t);
    return t;
}

/* --- boxes --- */

static int ascending(const void *a, const void *b)
{
    const int p = *(const int *)a, q = *(const int *)b;
    return (p > q) - (p < q);
}

/* Whether the boxes of both meet, touching included. */
static bool triangle_meets(const struct tree *t, int triangle, const double *lo, const double *hi)
{
    double low[3], high[3];
    box_of(t, triangle, low, high);
    for (int a = 0; a < 3; a++)
        if (low[a] > hi[a] || high[a] < lo[a])
            return false;
    return true;
}

static bool node_meets(const struct node *b, const double *lo, const double *hi)
{
    for (int a = 0; a < 3; a++)
        if (b->lo[a] > hi[a] || b->hi[a] < lo[a])
            return false;
    return true;
}

/* Goes down into every box that meets [lo, hi]; sorted, so that the order does not depend on the
 * tree. */
int tree_box(const struct tree *t, const double lo[3], const double hi[3], int most, int *who)
{
    int stack[DEPTH], depth = 0, n = 0;
    double low[3], high[3];
    for (int a = 0; a < 3; a++) {
        low[a] = lo[a] - t->origin[a];
        high[a] = hi[a] - t->origin[a];
    }
    for (int at = t->nnodes > 0 ? 0 : -1; at >= 0; at = depth > 0 ? stack[--depth] : -1) {
        const struct node *b = t->nodes + at;
        if (!node_meets(b, low, high))
            continue;
        for (int i = b->at; i < b->at + b->n; i++)
            if (triangle_meets(t, t->order[i], lo, hi)) {
                if (n < most)
                    who[n] = t->order[i];
                n++;
            }
        if (b->n == 0) {
            stack[depth++] = b->at;
            stack[depth++] = at + 1;
        }
    }
    const int got = n < most ? n : most;
    if (got > 1)
        qsort(who, (size_t)got, sizeof *who, ascending);
    return n;
}

/* --- the nearest point --- */

/* Features of a triangle: its face, the edge k -> k+1, the vertex k. */
enum { FACE = 0, EDGE = 1, VERTEX = 4 };

/* Weights of the vertices below this are nought: the point is on the edge across from them. */
static const double on_edge = 1e-12;

/* Two weights of nought: a vertex; one: the edge across from its vertex. */
static int feature_of(const double w[3])
{
    int zeros = 0, which = 0, kept = 0;
    for (int k = 0; k < 3; k++)
        if (w[k] <= on_edge) {
            zeros++;
            which = k;
        } else {
            kept = k;
        }
    return zeros == 0 ? FACE : zeros == 1 ? EDGE + (which + 1) % 3 : VERTEX + kept;
}

/* Weights of the point of abc nearest to x (Ericson, Real-time collision detection, 2005, 5.1.5). /
 * Regions of the two-dimensional plane abc in turn: the three vertices, the three edges, the
 * face. */
static void weights(const double *a, const double *b, const double *c, const double *x, double w[3])
{
    double ab[3], ac[3], ax[3], bx[3], cx[3];
    vec3_from(a, b, ab);
    vec3_from(a, c, ac);
    vec3_from(a, x, ax);
    vec3_from(b, x, bx);
    vec3_from(c, x, cx);
    const double d1 = vec3_dot(ab, ax), d2 = vec3_dot(ac, ax), d3 = vec3_dot(ab, bx),
                 d4 = vec3_dot(ac, bx), d5 = vec3_dot(ab, cx), d6 = vec3_dot(ac, cx);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    w[0] = w[1] = w[2] = 0.0;
    if (d1 <= 0.0 && d2 <= 0.0) {
        w[0] = 1.0;
    } else if (d3 >= 0.0 && d4 <= d3) {
        w[1] = 1.0;
    } else if (d6 >= 0.0 && d5 <= d6) {
        w[2] = 1.0;
    } else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        w[1] = d1 / (d1 - d3);
        w[0] = 1.0 - w[1];
    } else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        w[2] = d2 / (d2 - d6);
        w[0] = 1.0 - w[2];
    } else if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        w[2] = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        w[1] = 1.0 - w[2];
    } else {
        w[1] = vb / (va + vb + vc);
        w[2] = vc / (va + vb + vc);
        w[0] = 1.0 - w[1] - w[2];
    }
}

struct nearest {
    double d2, foot[3];
    int triangle, feature;
};

/* Of two triangles equally near, on a common edge or vertex, the one of the lower number is taken:
 * the answer does not depend on the order of the walk. */
static void look_at(const struct tree *t, int triangle, const double *x, struct nearest *best)
{
    const int *v = t->m->vertex[triangle];
    const double(*p)[3] = (const double(*)[3])t->m->x;
    double w[3], foot[3], d[3];
    weights(p[v[0]], p[v[1]], p[v[2]], x, w);
    for (int a = 0; a < 3; a++) /* from the first vertex: exact on it */
        foot[a] = p[v[0]][a] + w[1] * (p[v[1]][a] - p[v[0]][a]) + w[2] * (p[v[2]][a] - p[v[0]][a]);
    vec3_from(foot, x, d);
    const double d2 = vec3_dot(d, d);
    if (d2 < best->d2 || (d2 == best->d2 && triangle < best->triangle)) {
        best->d2 = d2;
        best->triangle = triangle;
        best->feature = feature_of(w);
        memcpy(best->foot, foot, sizeof foot);
    }
}

/* Square of the distance from a box, 0 within; m^2. */
static double to_node(const struct node *b, const double *x)
{
    double sum = 0.0;
    for (int a = 0; a < 3; a++) {
        const double d = fmax(fmax(b->lo[a] - x[a], x[a] - b->hi[a]), 0.0);
        sum += d * d;
    }
    return sum;
}

/* Depth first, the nearer child first; a box farther than the best so far is passed over. best->d2
 * begins with the square of the reach. */
static void find_nearest(const struct tree *t, const double *x, struct nearest *best)
{
    int stack[DEPTH], depth = 0;
    double bound[DEPTH], from[3];
    for (int a = 0; a < 3; a++)
        from[a] = x[a] - t->origin[a];
    stack[depth] = 0;
    bound[depth++] = to_node(t->nodes, from);
    while (depth > 0) {
        const int at = stack[--depth];
        const struct node *b = t->nodes + at;
        if (bound[depth] > best->d2)
            continue;
        for (int i = b->at; i < b->at + b->n; i++)
            look_at(t, t->order[i], x, best);
        if (b->n > 0)
            continue;
        const double first = to_node(b + 1, from), second = to_node(t->nodes + b->at, from);
        const bool swap = second < first; /* the nearer one is looked at first */
        stack[depth] = swap ? at + 1 : b->at;
        bound[depth++] = swap ? first : second;
        stack[depth] = swap ? b->at : at + 1;
        bound[depth++] = swap ? second : first;
    }
}

/* Pseudonormal of the nearest feature; returns whether it is on a rim. Of a face its normal; of an
 * edge the sum of both; of a vertex the normals of all its triangles, weighted by their angles
 * there. Only so is the sign right next to sharp edges. */
static bool pseudonormal(const struct tree *t, const struct nearest *best, double n[3])
{
    const struct trimesh *m = t->m;
    const int f = best->feature, i = best->triangle;
    double more[3];
    trimesh_normal(m, i, n);
    if (f >= VERTEX) {
        const int v = m->vertex[i][f - VERTEX];
        const float *w = t->n[v];
        for (int a = 0; a < 3 && w[0] * w[0] + w[1] * w[1] + w[2] * w[2] > 0.0F; a++)
            n[a] = (double)w[a];
        vec3_unit(n);
        return t->rim[v];
    }
    if (f == FACE)
        return false;
    const int q = m->neighbour[i][f - EDGE];
    if (q < 0)
        return true;
    trimesh_normal(m, q, more);
    double sum[3] = {n[0] + more[0], n[1] + more[1], n[2] + more[2]};
    if (vec3_unit(sum) > 1e-9) /* else a sheet folded back on itself */
        memcpy(n, sum, sizeof sum);
    return false;
}

/* The sign is that of the side on which x lies, by the pseudonormal (Baerentzen & Aanaes, IEEE
 * Trans. Vis. Comput. Graph. 11, 2005). */
struct tree_foot tree_nearest(const struct tree *t, const double x[3], double reach)
{
    struct nearest best = {.d2 = reach * reach, .triangle = -1};
    struct tree_foot f = {.distance = INFINITY, .triangle = -1};
    double d[3];
    if (t->nnodes > 0)
        find_nearest(t, x, &best);
    if (best.triangle < 0)
        return f;
    f.triangle = best.triangle;
    memcpy(f.foot, best.foot, sizeof f.foot);
    f.rim = pseudonormal(t, &best, f.n);
    vec3_from(f.foot, x, d);
    f.distance = vec3_dot(d, f.n) > 0.0 ? -sqrt(best.d2) : sqrt(best.d2);
    return f;
}

/* --- segments --- */

/* By slabs, axis after axis, up to the share `until' of the way. */
static bool segment_meets(const struct node *b, const double *from, const double *way, double until)
{
    double enter = 0.0, leave = until;
    for (int a = 0; a < 3; a++) {
        if (way[a] == 0.0) {
            if (from[a] < b->lo[a] || from[a] > b->hi[a])
                return false;
            continue;
        }
        const double p = (b->lo[a] - from[a]) / way[a], q = (b->hi[a] - from[a]) / way[a];
        enter = fmax(enter, fmin(p, q));
        leave = fmin(leave, fmax(p, q));
    }
    return enter <= leave * (1.0 + 1e-12) + 1e-12;
}

/* Share of the way a -> a + way at which it meets a triangle, edges with it; INFINITY: it does not,
 * or lies in its plane. */
static double crossing(const struct trimesh *m, int triangle, const double *a, const double *way)
{
    const double edge = 1e-9;
    double u, w, at;
    if (!trimesh_meet(m, triangle, a, way, 1e-14, &u, &w, &at))
        return INFINITY;
    return u >= -edge && w >= -edge && u + w <= 1.0 + edge && at >= 0.0 && at <= 1.0 ? at
                                                                                     : INFINITY;
}

/* where NULL: any crossing will do, the first that is found ends the walk. */
bool tree_crosses(const struct tree *t, const double a[3], const double b[3], double *where)
{
    int stack[DEPTH], depth = 0;
    double from[3], way[3], least = INFINITY;
    vec3_from(a, b, way);
    for (int k = 0; k < 3; k++)
        from[k] = a[k] - t->origin[k];
    for (int at = t->nnodes > 0 ? 0 : -1; at >= 0; at = depth > 0 ? stack[--depth] : -1) {
        const struct node *box = t->nodes + at;
        if (!segment_meets(box, from, way, fmin(least, 1.0)))
            continue;
        for (int i = box->at; i < box->at + box->n; i++)
            least = fmin(least, crossing(t->m, t->order[i], a, way));
        if (!where && least <= 1.0)
            return true;
        if (box->n == 0) {
            stack[depth++] = box->at;
            stack[depth++] = at + 1;
        }
    }
    if (where && least <= 1.0)
        *where = least;
    return least <= 1.0;
}

/* --- winding --- */

/* By solid angles (van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30, 1983); O(n). */
double trimesh_winding(const struct trimesh *m, const double x[3])
{
    double sum = 0.0;
    for (int t = 0; t < m->ntriangles; t++) {
        double v[3][3], bc[3], r[3];
        for (int k = 0; k < 3; k++) {
            vec3_from(x, m->x[m->vertex[t][k]], v[k]);
            r[k] = vec3_length(v[k]);
        }
        vec3_cross(v[1], v[2], bc);
        sum += atan2(vec3_dot(v[0], bc), r[0] * r[1] * r[2] + vec3_dot(v[0], v[1]) * r[2] +
                                             vec3_dot(v[1], v[2]) * r[0] +
                                             vec3_dot(v[2], v[0]) * r[1]);
    }
    return sum / (2.0 * M_PI);
}

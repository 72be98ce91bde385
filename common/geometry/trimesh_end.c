/* trimesh_end.c - surfaces that end on planes. What is beyond goes, triangles that cross
 * the plane are clipped (Sutherland & Hodgman, Comm. ACM 17, 1974), and the section, loops of edges
 * that then have one triangle each, is filled: a loop that runs round the other way is a hole, and
 * joined to the loop around it by a bridge, so that one polygon is left to be cut into ears
 * (Meisters, Amer. Math. Monthly 82, 1975). SPDX-License-Identifier: BSD-3-Clause */

#include "../base/base.h"
#include "trimesh.h"
#include "trimesh_check.h"

/* The section: the ends of its edges in the two axes along the plane, counter-clockwise round what
 * is solid, and the loops that they make, as vertices of the mesh. */
struct end_section {
    int axis, way; /* the solid that is left lies before the plane, which looks along way * axis */
    struct trimesh *of;
    double (*x)[2]; /* [nvertices of the mesh] m */
    int *next;      /* [nvertices of the mesh] of a loop; -1: not on any */
    int nloops, *length;
    int **loop;   /* [nloops][length] */
    double *area; /* [nloops] m^2: < 0 of holes */
};

/* --- what is before the plane --- */

/* Three vertices of its own: they are welded afterwards. */
static void add_triangle(struct trimesh *to, const double *a, const double *b, const double *c)
{
    const double *corner[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        memcpy(to->x[to->nvertices], corner[k], sizeof *to->x);
        to->vertex[to->ntriangles][k] = to->nvertices++;
    }
    to->ntriangles++;
}

/* Where an edge meets the plane; the same bits from both of its triangles. */
static void meet(const double *a, const double *b, int axis, double at, double *x)
{
    const bool swap = memcmp(a, b, 3 * sizeof *a) > 0;
    const double *p = swap ? b : a, *q = swap ? a : b;
    const double part = (at - p[axis]) / (q[axis] - p[axis]);
    for (int c = 0; c < 3; c++)
        x[c] = p[c] + part * (q[c] - p[c]);
    x[axis] = at;
}

/* Adds to `to' what of a triangle is before the plane; one that lies in it is none. */
static void keep(const double *const v[3], int axis, double at, int way, struct trimesh *to)
{
    double kept[4][3];
    int n = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = v[k], *b = v[(k + 1) % 3];
        const double before = way * (at - a[axis]), next = way * (at - b[axis]);
        if (before >= 0.0)
            memcpy(kept[n++], a, sizeof *kept);
        if (before * next < 0.0)
            meet(a, b, axis, at, kept[n++]);
    }
    bool any = false;
    for (int k = 0; k < n; k++)
        any = any || kept[k][axis] != at;
    for (int k = 2; k < n && any; k++)
        add_triangle(to, kept[0], kept[k - 1], kept[k]);
}

/* Owned by the caller; open where the plane cut it. */
static struct trimesh before_plane(const struct trimesh *m, int axis, double at, int way)
{
    struct trimesh to = {.x = mem_new(6 * (size_t)m->ntriangles, sizeof *to.x),
                         .vertex = mem_new(2 * (size_t)m->ntriangles, sizeof *to.vertex)};
    double lo[3], hi[3];
    for (int t = 0; t < m->ntriangles; t++) {
        const int *v = m->vertex[t];
        keep((const double *const[3]){m->x[v[0]], m->x[v[1]], m->x[v[2]]}, axis, at, way, &to);
    }
    trimesh_bounds(m, lo, hi);
    if (m->nvertices > 0)
        trimesh_weld(&to, 1e-9 * vec3_distance(lo, hi));
    trimesh_drop_flat(&to, 0.0);
    trimesh_trim(&to);
    trimesh_connect(&to);
    return to;
}

/* Sides that are infinite cut nothing. */
struct trimesh trimesh_within(const struct trimesh *m, const double lo[3], const double hi[3])
{
    struct trimesh of = trimesh_copy(m);
    for (int side = 0; side < 6; side++) {
        const int a = side / 2;
        const double at = side % 2 ? hi[a] : lo[a];
        if (isinf(at))
            continue;
        struct trimesh cut = before_plane(&of, a, at, side % 2 ? 1 : -1);
        trimesh_free(&of);
        of = cut;
    }
    return of;
}

/* --- loops --- */

static double turn(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Edges of the section run against those of the triangles beside them. false: two loops meet in a
 * vertex, which one list of successors does not hold. */
static bool find_edges(struct end_section *s)
{
    const struct trimesh *m = s->of;
    const int b = (s->axis + 1) % 3, c = (s->axis + 2) % 3;
    for (int v = 0; v < m->nvertices; v++) {
        s->x[v][0] = m->x[v][s->way > 0 ? b : c];
        s->x[v][1] = m->x[v][s->way > 0 ? c : b];
        s->next[v] = -1;
    }
    for (int at = 0; at < 3 * m->ntriangles; at++) {
        const int tail = m->vertex[at / 3][at % 3], head = m->vertex[at / 3][(at + 1) % 3];
        if (m->neighbour[at / 3][at % 3] >= 0)
            continue;
        if (s->next[head] >= 0)
            return false;
        s->next[head] = tail;
    }
    return true;
}

/* From `first' along its successors, until one that is done. */
static void add_loop(struct end_section *s, int first, bool *done)
{
    int n = 0, *loop = NEW(int, s->of->nvertices);
    double area = 0.0;
    for (int v = first; v >= 0 && !done[v]; v = s->next[v]) {
        done[v] = true;
        loop[n++] = v;
    }
    for (int k = 0; k < n; k++)
        area += 0.5 * turn(s->x[first], s->x[loop[k]], s->x[loop[(k + 1) % n]]);
    GROW(s->loop, s->nloops, s->nloops + 1);
    GROW(s->length, s->nloops, s->nloops + 1);
    GROW(s->area, s->nloops, s->nloops + 1);
    s->loop[s->nloops] = loop;
    s->length[s->nloops] = n;
    s->area[s->nloops++] = area;
}

/* --- ears --- */

/* Whether corner b of what is left of the polygon can be cut off: it is no sliver, and no other
 * corner lies within abc. O(n), so that a polygon costs O(n^3) at worst: they have some hundred
 * corners. */
static bool is_ear(int n, const int *left, const double (*p)[2], int k, double least)
{
    const double *a = p[left[(k + n - 1) % n]], *b = p[left[k]], *c = p[left[(k + 1) % n]];
    if (!(turn(a, b, c) > least))
        return false;
    for (int i = 0; i < n; i++) {
        const double *q = p[left[i]];
        if (q != a && q != b && q != c && turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 &&
            turn(c, a, q) >= 0.0)
            return false;
    }
    return true;
}

/* Where no corner is an ear, by rounding, the last one is cut off all the same: the result always
 * has n - 2 triangles. */
int trimesh_ears(int n, int *left, const double (*p)[2], int (*ear)[3])
{
    double far = 0.0;
    for (int i = 0; i < n; i++)
        far = fmax(far, hypot(p[left[i]][0], p[left[i]][1]));
    for (int rest = n; rest > 2; rest--) {
        int k = 0, *cut = ear[n - rest];
        while (k < rest - 1 && !is_ear(rest, left, p, k, 1e-13 * far * far))
            k++;
        cut[0] = left[(k + rest - 1) % rest];
        cut[1] = left[k];
        cut[2] = left[(k + 1) % rest];
        memmove(left + k, left + k + 1, (size_t)(rest - k - 1) * sizeof *left);
    }
    return n > 2 ? n - 2 : 0;
}

/* --- one polygon of a loop and its holes --- */

/* Whether x lies in the loop: crossings of a ray along the first axis. */
static bool holds(const struct end_section *s, int loop, const double *x)
{
    bool in = false;
    for (int k = 0, n = s->length[loop]; k < n; k++) {
        const double *a = s->x[s->loop[loop][k]], *b = s->x[s->loop[loop][(k + 1) % n]];
        if ((a[1] > x[1]) != (b[1] > x[1]))
            in = in != ((turn(a, b, x) > 0.0) == (b[1] > a[1]));
    }
    return in;
}

/* The smallest loop around a hole; -1: none. */
static int around(const struct end_section *s, int hole)
{
    int best = -1;
    for (int k = 0; k < s->nloops; k++)
        if (s->area[k] > 0.0 && holds(s, k, s->x[s->loop[hole][0]]) &&
            (best < 0 || s->area[k] < s->area[best]))
            best = k;
    return best;
}

/* Whether the way between two vertices crosses an edge of any loop. */
static bool is_barred(const struct end_section *s, int from, int to)
{
    const double *p = s->x[from], *q = s->x[to];
    for (int k = 0; k < s->nloops; k++)
        for (int i = 0; i < s->length[k]; i++) {
            const int u = s->loop[k][i], v = s->loop[k][(i + 1) % s->length[k]];
            if (u == from || u == to || v == from || v == to)
                continue;
            if ((turn(p, q, s->x[u]) > 0.0) != (turn(p, q, s->x[v]) > 0.0) &&
                (turn(s->x[u], s->x[v], p) > 0.0) != (turn(s->x[u], s->x[v], q) > 0.0))
                return true;
        }
    return false;
}

/* Joins a hole to the polygon left[n] by the shortest bridge that nothing bars; returns its new
 * length, n: there is none. */
static int bridge(const struct end_section *s, int n, int *left, int hole)
{
    const int more = s->length[hole], *loop = s->loop[hole];
    int at = -1, from = 0;
    double least = INFINITY;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < more; k++) {
            const double *p = s->x[left[i]], *q = s->x[loop[k]];
            const double d = hypot(q[0] - p[0], q[1] - p[1]);
            if (d >= least || is_barred(s, left[i], loop[k]))
                continue;
            least = d;
            at = i;
            from = k;
        }
    if (at < 0)
        return n;
    memmove(left + at + more + 2, left + at, (size_t)(n - at) * sizeof *left);
    left[at] = left[at + more + 2];
    for (int k = 0; k <= more; k++)
        left[at + 1 + k] = loop[(from + k) % more];
    return n + more + 2;
}

/* Fills a loop but for its holes. */
static void fill(const struct end_section *s, int loop, struct trimesh *cap)
{
    int n = s->length[loop], most = n;
    for (int k = 0; k < s->nloops; k++)
        most += s->length[k] + 2;
    int *left = NEW(int, most);
    memcpy(left, s->loop[loop], (size_t)n * sizeof *left);
    for (int k = 0; k < s->nloops; k++)
        if (s->area[k] < 0.0 && around(s, k) == loop)
            n = bridge(s, n, left, k);
    GROW(cap->vertex, cap->ntriangles, cap->ntriangles + n);
    cap->ntriangles +=
        trimesh_ears(n, left, (const double(*)[2])s->x, cap->vertex + cap->ntriangles);
    mem_free(left);
}

/* Fills the section of m; false: it is none of closed loops. */
static bool close_section(struct trimesh *m, int axis, int way)
{
    struct end_section s = {.axis = axis, .way = way, .of = m};
    struct trimesh cap = {0};
    bool *done = NEW(bool, m->nvertices);
    s.x = mem_new((size_t)m->nvertices, sizeof *s.x);
    s.next = NEW(int, m->nvertices);
    const bool simple = find_edges(&s);
    for (int v = 0; v < m->nvertices && simple; v++)
        if (s.next[v] >= 0 && !done[v])
            add_loop(&s, v, done);
    for (int k = 0; k < s.nloops; k++)
        if (s.area[k] > 0.0)
            fill(&s, k, &cap);
    GROW(m->vertex, m->ntriangles, m->ntriangles + cap.ntriangles);
    memcpy(m->vertex + m->ntriangles, cap.vertex, (size_t)cap.ntriangles * sizeof *m->vertex);
    m->ntriangles += cap.ntriangles;
    for (int k = 0; k < s.nloops; k++)
        mem_free(s.loop[k]);
    FREE(done, s.x, s.next, s.loop, s.length, s.area, cap.vertex);
    trimesh_connect(m);
    return m->closed;
}

/* Vertices within `near' of the plane are put on it first, so that no slivers are cut. m stays as
 * it was where the section cannot be filled. */
bool trimesh_end(struct trimesh *m, int axis, double at, bool high, double near)
{
    const int way = high ? 1 : -1;
    bool beyond = false, before = false;
    for (int v = 0; v < m->nvertices; v++) {
        double *x = m->x[v] + axis;
        *x = fabs(*x - at) <= near ? at : *x;
        beyond = beyond || way * (*x - at) > 0.0;
        before = before || way * (*x - at) < 0.0;
    }
    if (!beyond || !before || !m->closed)
        return false;
    trimesh_orient_closed(m, 1);
    struct trimesh cut = before_plane(m, axis, at, way);
    const bool good = close_section(&cut, axis, way);
    if (good) {
        struct trimesh whole = *m;
        *m = cut;
        cut = whole;
    }
    trimesh_free(&cut);
    return good;
}

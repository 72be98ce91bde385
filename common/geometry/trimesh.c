/* trimesh.c - neighbours, parts and measures of a triangulated surface; see trimesh.h. Everything
 * is O(n) in the number of triangles but for sorting the few sides at a vertex. An edge is known by
 * 3 triangle + side: side k runs from vertex k to vertex k + 1.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "trimesh.h"

#include "../base/base.h"

void trimesh_free(struct trimesh *m)
{
    FREE(m->x, m->vertex, m->neighbour, m->part);
    *m = (struct trimesh){0};
}

/* Owned by the caller; from NULL: zeros. */
static void *copy_of(const void *from, int n, size_t size)
{
    void *to = mem_new((size_t)n, size);
    if (from && n > 0)
        memcpy(to, from, (size_t)n * size);
    return to;
}

/* All arrays are its own. */
struct trimesh trimesh_copy(const struct trimesh *m)
{
    struct trimesh c = *m;
    c.x = copy_of(m->x, m->nvertices, sizeof *m->x);
    c.vertex = copy_of(m->vertex, m->ntriangles, sizeof *m->vertex);
    c.neighbour = copy_of(m->neighbour, m->ntriangles, sizeof *m->neighbour);
    c.part = copy_of(m->part, m->ntriangles, sizeof *m->part);
    return c;
}

/* Neighbours and parts of m are then those of before: trimesh_connect finds them anew. */
void trimesh_append(struct trimesh *m, const struct trimesh *more)
{
    GROW(m->x, m->nvertices, m->nvertices + more->nvertices);
    GROW(m->vertex, m->ntriangles, m->ntriangles + more->ntriangles);
    memcpy(m->x + m->nvertices, more->x, (size_t)more->nvertices * sizeof *m->x);
    for (int t = 0; t < more->ntriangles; t++)
        for (int k = 0; k < 3; k++)
            m->vertex[m->ntriangles + t][k] = m->nvertices + more->vertex[t][k];
    m->nvertices += more->nvertices;
    m->ntriangles += more->ntriangles;
}

/* --- who lies beside whom --- */

/* A side of a triangle, kept with the lesser of its vertices. */
struct edge_side {
    int other; /* the greater vertex */
    int at;    /* 3 triangle + side */
};

static int by_other(const void *a, const void *b)
{
    const struct edge_side *p = a, *q = b;
    return p->other != q->other ? (p->other > q->other) - (p->other < q->other)
                                : (p->at > q->at) - (p->at < q->at);
}

static int tail_of(const struct trimesh *m, int at) { return m->vertex[at / 3][at % 3]; }

static void join(struct trimesh *m, int a, int b)
{
    m->neighbour[a / 3][a % 3] = b / 3;
    m->neighbour[b / 3][b % 3] = a / 3;
}

/* Sides on one edge: two are neighbours; of more each that runs forward gets one that runs
 * back. */
static void join_edge(struct trimesh *m, const struct edge_side *s, int n)
{
    m->rims += n == 1;
    m->junctions += n > 2;
    if (n == 2) {
        join(m, s[0].at, s[1].at);
        m->clashes += tail_of(m, s[0].at) == tail_of(m, s[1].at);
    }
    for (int i = 0; n > 2 && i < n; i++)
        for (int k = i + 1; k < n && m->neighbour[s[i].at / 3][s[i].at % 3] < 0; k++)
            if (tail_of(m, s[i].at) != tail_of(m, s[k].at) &&
                m->neighbour[s[k].at / 3][s[k].at % 3] < 0)
                join(m, s[i].at, s[k].at);
}

/* Sides are sorted into bins by the lesser of their vertices (counting sort), then within each bin
 * by the other one: sides on one edge come to lie together. */
static void find_neighbours(struct trimesh *m)
{
    int *start = NEW(int, m->nvertices + 2);
    struct edge_side *sides = NEW(struct edge_side, 3 * (size_t)m->ntriangles);
    for (int pass = 0; pass < 2; pass++) { /* count, then fill */
        for (int at = 0; at < 3 * m->ntriangles; at++) {
            const int a = tail_of(m, at), b = m->vertex[at / 3][(at + 1) % 3];
            const int least = a < b ? a : b, most = a < b ? b : a;
            if (pass == 0)
                start[least + 2]++;
            else
                sides[start[least + 1]++] = (struct edge_side){most, at};
        }
        for (int v = 0; pass == 0 && v < m->nvertices; v++)
            start[v + 2] += start[v + 1];
    }
    for (int v = 0; v < m->nvertices; v++) {
        const int n = start[v + 1] - start[v];
        struct edge_side *s = sides + start[v];
        if (n > 1)
            qsort(s, (size_t)n, sizeof *s, by_other);
        for (int i = 0, k; i < n; i = k) {
            for (k = i + 1; k < n && s[k].other == s[i].other; k++)
                ;
            join_edge(m, s + i, k - i);
        }
    }
    FREE(start, sides);
}

/* Walks over neighbours from every triangle that has no part yet. */
static void find_parts(struct trimesh *m)
{
    int *stack = NEW(int, m->ntriangles);
    for (int t = 0; t < m->ntriangles; t++)
        m->part[t] = -1;
    m->nparts = 0;
    for (int first = 0; first < m->ntriangles; first++) {
        int n = 0;
        if (m->part[first] >= 0)
            continue;
        m->part[first] = m->nparts;
        stack[n++] = first;
        while (n > 0) {
            const int t = stack[--n];
            for (int k = 0; k < 3; k++) {
                const int q = m->neighbour[t][k];
                if (q >= 0 && m->part[q] < 0) {
                    m->part[q] = m->nparts;
                    stack[n++] = q;
                }
            }
        }
        m->nparts++;
    }
    mem_free(stack);
}

/* closed: each side of each triangle has a neighbour. */
void trimesh_connect(struct trimesh *m)
{
    FREE(m->neighbour, m->part);
    m->neighbour = (int(*)[3])mem_new((size_t)m->ntriangles, sizeof *m->neighbour);
    m->part = NEW(int, m->ntriangles);
    m->rims = m->junctions = m->clashes = 0;
    memset(m->neighbour, 0xff, (size_t)m->ntriangles * sizeof *m->neighbour);
    find_neighbours(m);
    find_parts(m);
    m->closed = m->ntriangles > 0;
    for (int at = 0; at < 3 * m->ntriangles; at++)
        m->closed = m->closed && m->neighbour[at / 3][at % 3] >= 0;
}

/* Swapping vertices 1 and 2 turns the normal; sides 0 and 2 change places with them, side 1
 * stays. */
void trimesh_turn_one(struct trimesh *m, int t)
{
    const int v = m->vertex[t][1], q = m->neighbour[t][0];
    m->vertex[t][1] = m->vertex[t][2];
    m->vertex[t][2] = v;
    m->neighbour[t][0] = m->neighbour[t][2];
    m->neighbour[t][2] = q;
}

void trimesh_turn(struct trimesh *m, int part)
{
    for (int t = 0; t < m->ntriangles; t++)
        if (part < 0 || m->part[t] == part)
            trimesh_turn_one(m, t);
}

/* --- measures --- */

void trimesh_bounds(const struct trimesh *m, double lo[3], double hi[3])
{
    for (int a = 0; a < 3; a++) {
        lo[a] = INFINITY;
        hi[a] = -INFINITY;
        for (int v = 0; v < m->nvertices; v++) {
            lo[a] = fmin(lo[a], m->x[v][a]);
            hi[a] = fmax(hi[a], m->x[v][a]);
        }
    }
}

double trimesh_normal(const struct trimesh *m, int triangle, double n[3])
{
    const int *v = m->vertex[triangle];
    double d[3], e[3];
    vec3_from(m->x[v[0]], m->x[v[1]], d);
    vec3_from(m->x[v[0]], m->x[v[2]], e);
    vec3_cross(d, e, n);
    return 0.5 * vec3_unit(n);
}

void trimesh_middle(const struct trimesh *m, int triangle, double x[3])
{
    const int *v = m->vertex[triangle];
    for (int a = 0; a < 3; a++)
        x[a] = (m->x[v[0]][a] + m->x[v[1]][a] + m->x[v[2]][a]) / 3.0;
}

/* On the plane counts as before it, so that a vertex there gives no third end. */
bool trimesh_cut(const struct trimesh *m, int triangle, int axis, double at, double x[2][3])
{
    int n = 0;
    for (int k = 0; k < 3 && n < 2; k++) {
        const double *a = m->x[m->vertex[triangle][k]], *b = m->x[m->vertex[triangle][(k + 1) % 3]];
        if ((a[axis] > at) == (b[axis] > at))
            continue;
        const double w = (at - a[axis]) / (b[axis] - a[axis]);
        for (int c = 0; c < 3; c++)
            x[n][c] = a[c] + w * (b[c] - a[c]);
        n++;
    }
    return n == 2;
}

double trimesh_area(const struct trimesh *m)
{
    double sum = 0.0, n[3];
    for (int t = 0; t < m->ntriangles; t++)
        sum += trimesh_normal(m, t, n);
    return sum;
}

/* Integrals over the solid of 1, x, x^2 and x y, y z, z x. */
struct moments {
    double one, x[3], xx[3], xy[3];
};

/* Volume integrals as surface integrals by the divergence theorem, in closed form for a triangle
 * (Eberly 2002): f2, f3 and g are his sums over the corners, d twice the area times the normal. */
static void add_triangle(const double *a, const double *b, const double *c, struct moments *o)
{
    double e[3], g[3], d[3], f2[3], f3[3], ga[3], gb[3], gc[3];
    vec3_from(a, b, e);
    vec3_from(a, c, g);
    vec3_cross(e, g, d);
    for (int k = 0; k < 3; k++) {
        const double s = a[k] + b[k] + c[k];
        f2[k] = a[k] * a[k] + a[k] * b[k] + b[k] * b[k] + c[k] * s;
        f3[k] = a[k] * a[k] * a[k] + a[k] * a[k] * b[k] + a[k] * b[k] * b[k] + b[k] * b[k] * b[k] +
                c[k] * f2[k];
        ga[k] = f2[k] + a[k] * (s + a[k]);
        gb[k] = f2[k] + b[k] * (s + b[k]);
        gc[k] = f2[k] + c[k] * (s + c[k]);
    }
    o->one += d[0] * (a[0] + b[0] + c[0]) / 6.0;
    for (int k = 0; k < 3; k++) {
        const int n = (k + 1) % 3;
        o->x[k] += d[k] * f2[k] / 24.0;
        o->xx[k] += d[k] * f3[k] / 60.0;
        o->xy[k] += d[k] * (a[n] * ga[k] + b[n] * gb[k] + c[n] * gc[k]) / 120.0;
    }
}

/* Moments about the middle, then by Steiner's rule about the centre. */
struct trimesh_solid trimesh_solid(const struct trimesh *m, int part)
{
    struct moments o = {0};
    struct trimesh_solid s = {0};
    double lo[3], hi[3];
    trimesh_bounds(m, lo, hi); /* about the middle: little cancels */
    for (int t = 0; t < m->ntriangles; t++) {
        double v[3][3];
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                v[k][a] = m->x[m->vertex[t][k]][a] - 0.5 * (lo[a] + hi[a]);
        if (part < 0 || m->part[t] == part)
            add_triangle(v[0], v[1], v[2], &o);
    }
    s.volume = o.one;
    double c[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < 3; a++) {
        c[a] = o.one != 0.0 ? o.x[a] / o.one : 0.0;
        s.centre[a] = 0.5 * (lo[a] + hi[a]) + c[a];
    }
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, e = (a + 2) % 3;
        s.inertia[a][a] = o.xx[b] + o.xx[e] - o.one * (c[b] * c[b] + c[e] * c[e]);
        s.inertia[a][b] = s.inertia[b][a] = -(o.xy[a] - o.one * c[a] * c[b]);
    }
    return s;
}

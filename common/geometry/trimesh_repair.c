/* trimesh_repair.c - what files of triangles want before they bound a fluid: equal vertices made
 * one, triangles without area taken out, all normals of a part to one side. Called in that order by
 * the scene's reader, with trimesh_connect before the last. Results do not depend on the number of
 * ranks: each does the same.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../base/base.h"
#include "trimesh.h"

/* --- weld --- */

/* Cells twice the tolerance wide, found by a hash of their indices: a vertex within the tolerance
 * of x lies in the cell of x or in one of the seven beside it on the nearer sides. Cells of other
 * indices in the same chain only cost a comparison of distances. */
struct repair_grid {
    const struct trimesh *m;
    double lo[3], cell; /* m */
    uint64_t mask;
    int *head, *next; /* chains of the vertices kept, by the hash of their cell */
};

/* Multipliers of splitmix64. */
static uint64_t hash_of(const struct repair_grid *g, const int64_t *c)
{
    uint64_t h = (uint64_t)c[0] * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ (uint64_t)c[1]) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32) ^ (uint64_t)c[2]) * 0x94d049bb133111ebu;
    return (h ^ (h >> 29)) & g->mask;
}

/* beside: on which side of the cell's middle x lies, -1 or 1. */
static void cell_of(const struct repair_grid *g, const double *x, int64_t *c, int *beside)
{
    for (int a = 0; a < 3; a++) {
        const double at = (x[a] - g->lo[a]) / g->cell;
        c[a] = (int64_t)floor(at);
        beside[a] = at - floor(at) < 0.5 ? -1 : 1;
    }
}

/* Of the vertices kept the first within the tolerance (half a cell) of v, or -1. */
static int find_kept(const struct repair_grid *g, int v)
{
    int64_t c[3];
    int beside[3], found = -1;
    const double tolerance = 0.5 * g->cell;
    cell_of(g, g->m->x[v], c, beside);
    for (int k = 0; k < 8; k++) {
        int64_t q[3];
        for (int a = 0; a < 3; a++)
            q[a] = c[a] + (k >> a & 1 ? beside[a] : 0);
        for (int w = g->head[hash_of(g, q)]; w >= 0; w = g->next[w]) {
            double d[3];
            vec3_from(g->m->x[w], g->m->x[v], d);
            if (vec3_dot(d, d) <= tolerance * tolerance && (found < 0 || w < found))
                found = w;
        }
    }
    return found;
}

/* A tolerance of 0 joins what is equal but for rounding. */
static struct repair_grid grid_create(const struct trimesh *m, double tolerance)
{
    struct repair_grid g = {.m = m, .mask = 1};
    double hi[3], size = 0.0;
    trimesh_bounds(m, g.lo, hi);
    for (int a = 0; a < 3; a++)
        size = fmax(size, hi[a] - g.lo[a]);
    g.cell = 2.0 * fmax(tolerance, 1e-15 * size);
    g.cell = g.cell > 0.0 ? g.cell : 1.0;
    while (g.mask < 2 * (uint64_t)m->nvertices)
        g.mask = 2 * g.mask + 1;
    g.head = NEW(int, g.mask + 1);
    g.next = NEW(int, m->nvertices);
    memset(g.head, 0xff, (g.mask + 1) * sizeof *g.head);
    return g;
}

/* One pass over the vertices, O(n) on average. A vertex is joined to one that is kept, never to one
 * that is joined itself, so that chains of close vertices do not run together into one. */
int trimesh_weld(struct trimesh *m, double tolerance)
{
    if (m->nvertices == 0)
        return 0;
    struct repair_grid g = grid_create(m, tolerance);
    int *to = NEW(int, m->nvertices), kept = 0;
    for (int v = 0; v < m->nvertices; v++) {
        const int w = find_kept(&g, v);
        int64_t c[3];
        int beside[3];
        to[v] = w >= 0 ? w : v;
        if (w >= 0)
            continue;
        cell_of(&g, m->x[v], c, beside);
        const uint64_t h = hash_of(&g, c);
        g.next[v] = g.head[h];
        g.head[h] = v;
    }
    for (int v = 0; v < m->nvertices; v++) /* in place: those kept move down only */
        if (to[v] == v) {
            memmove(m->x[kept], m->x[v], sizeof m->x[v]);
            to[v] = kept++;
        } else {
            to[v] = to[to[v]];
        }
    for (int at = 0; at < 3 * m->ntriangles; at++)
        m->vertex[at / 3][at % 3] = to[m->vertex[at / 3][at % 3]];
    const int gone = m->nvertices - kept;
    m->nvertices = kept;
    FREE(g.head, g.next, to);
    return gone;
}

/* --- triangles without area --- */

/* Height over the longest side, m. */
static double height(const struct trimesh *m, int t)
{
    double n[3], longest = 0.0;
    for (int k = 0; k < 3; k++) {
        double d[3];
        vec3_from(m->x[m->vertex[t][k]], m->x[m->vertex[t][(k + 1) % 3]], d);
        longest = fmax(longest, vec3_length(d));
    }
    return longest > 0.0 ? 2.0 * trimesh_normal(m, t, n) / longest : 0.0;
}

/* Their neighbours stay: after a weld the edges on both sides of a sliver are one. */
int trimesh_drop_flat(struct trimesh *m, double least)
{
    int kept = 0;
    for (int t = 0; t < m->ntriangles; t++) {
        const int *v = m->vertex[t];
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0] && height(m, t) > least)
            memmove(m->vertex[kept++], v, sizeof m->vertex[t]);
    }
    const int gone = m->ntriangles - kept;
    m->ntriangles = kept;
    return gone;
}

/* to[] counts from 1, 0: not used. */
void trimesh_trim(struct trimesh *m)
{
    int *to = NEW(int, m->nvertices), n = 0;
    for (int at = 0; at < 3 * m->ntriangles; at++)
        to[m->vertex[at / 3][at % 3]] = 1;
    for (int v = 0; v < m->nvertices; v++)
        to[v] = to[v] ? ++n : 0;
    double(*x)[3] = (double(*)[3])mem_new((size_t)n, sizeof *x);
    int(*vertex)[3] = (int(*)[3])mem_new((size_t)m->ntriangles, sizeof *vertex);
    for (int v = 0; v < m->nvertices; v++)
        if (to[v])
            memcpy(x[to[v] - 1], m->x[v], sizeof *x);
    for (int at = 0; at < 3 * m->ntriangles; at++)
        vertex[at / 3][at % 3] = to[m->vertex[at / 3][at % 3]] - 1;
    FREE(to, m->x, m->vertex);
    m->x = x;
    m->vertex = vertex;
    m->nvertices = n;
}

/* --- one sense --- */

/* Whether t and its neighbour across side k run along it in one direction, so that their normals
 * look to different sides. */
static bool same_sense(const struct trimesh *m, int t, int k)
{
    const int q = m->neighbour[t][k], a = m->vertex[t][k], b = m->vertex[t][(k + 1) % 3];
    for (int e = 0; e < 3; e++)
        if (m->neighbour[q][e] == t && m->vertex[q][e] == a && m->vertex[q][(e + 1) % 3] == b)
            return true;
    return false;
}

/* Walks over the neighbours of one part from its first triangle; who[]: the part's triangles. Fewer
 * are turned than not. Returns the number turned. Breadth first: who[] is the queue, and in the end
 * the list of the part's triangles. */
static int orient_part(struct trimesh *m, int first, int *who, bool *seen)
{
    int n = 0, count = 0;
    who[n++] = first;
    seen[first] = true;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            const int t = who[i], q = m->neighbour[t][k];
            if (q < 0 || seen[q])
                continue;
            const bool against = same_sense(m, t, k);
            if (against)
                trimesh_turn_one(m, q);
            count += against;
            seen[q] = true;
            who[n++] = q;
        }
    for (int i = 0; 2 * count > n && i < n; i++)
        trimesh_turn_one(m, who[i]);
    return 2 * count > n ? n - count : count;
}

/* The clashes are counted anew afterwards: those that are left cannot be mended by turning. */
int trimesh_orient(struct trimesh *m)
{
    int *who = NEW(int, m->ntriangles), count = 0;
    bool *seen = NEW(bool, m->ntriangles);
    for (int t = 0; t < m->ntriangles; t++)
        if (!seen[t])
            count += orient_part(m, t, who, seen);
    m->clashes = 0;
    for (int t = 0; t < m->ntriangles; t++)
        for (int k = 0; k < 3; k++)
            m->clashes += m->neighbour[t][k] > t && same_sense(m, t, k);
    FREE(who, seen);
    return count;
}

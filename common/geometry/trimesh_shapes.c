/* trimesh_shapes.c - meshes of simple solids, normals out, for bodies of simple form, and for
 * tests, which know their volumes, inertias and distances. Each ends connected (trimesh_connect).
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../base/base.h"
#include "trimesh.h"

/* Empty, with room. */
static void reserve(struct trimesh *m, int vertices, int triangles)
{
    *m = (struct trimesh){0};
    m->x = (double(*)[3])mem_new((size_t)vertices, sizeof *m->x);
    m->vertex = (int(*)[3])mem_new((size_t)triangles, sizeof *m->vertex);
}

static void add(struct trimesh *m, int a, int b, int c)
{
    int *v = m->vertex[m->ntriangles++];
    v[0] = a;
    v[1] = b;
    v[2] = c;
}

/* Vertices of the surface are those of the lattice (n+1)^3 that lie on it, numbered as met. */
static int box_vertex(struct trimesh *m, int *number, int n, const int *i, const double *lo,
                      const double *hi)
{
    int *at = number + i[0] + (n + 1) * (i[1] + (n + 1) * i[2]);
    if (*at == 0) {
        for (int a = 0; a < 3; a++)
            m->x[m->nvertices][a] = i[a] == n ? hi[a] : lo[a] + (hi[a] - lo[a]) * i[a] / n;
        *at = ++m->nvertices;
    }
    return *at - 1;
}

/* n: squares along each edge. */
struct trimesh trimesh_box(const double lo[3], const double hi[3], int n)
{
    struct trimesh m;
    int *number = NEW(int, (size_t)(n + 1) * (n + 1) * (n + 1));
    reserve(&m, 6 * n * n + 2, 12 * n * n);
    for (int axis = 0; axis < 3; axis++)
        for (int high = 0; high < 2; high++)
            for (int k = 0; k < n * n; k++) {
                const int b = (axis + 1) % 3, c = (axis + 2) % 3;
                int corner[4];
                for (int e = 0; e < 4; e++) { /* counter-clockwise round +axis */
                    int i[3];
                    i[axis] = high ? n : 0;
                    i[b] = k % n + (e == 1 || e == 2);
                    i[c] = k / n + (e > 1);
                    corner[e] = box_vertex(&m, number, n, i, lo, hi);
                }
                add(&m, corner[0], corner[high ? 1 : 2], corner[high ? 2 : 1]);
                add(&m, corner[0], corner[high ? 2 : 3], corner[high ? 3 : 2]);
            }
    mem_free(number);
    trimesh_connect(&m);
    return m;
}

/* Splits each triangle in four; the midpoint of an edge is made by the triangle of lower number. */
static struct trimesh refine(const struct trimesh *m)
{
    struct trimesh f;
    reserve(&f, m->nvertices + 3 * m->ntriangles / 2, 4 * m->ntriangles);
    int(*middle)[3] = (int(*)[3])mem_new((size_t)m->ntriangles, sizeof *middle);
    memcpy(f.x, m->x, (size_t)m->nvertices * sizeof *f.x);
    f.nvertices = m->nvertices;
    for (int t = 0; t < m->ntriangles; t++)
        for (int k = 0; k < 3; k++) {
            const int q = m->neighbour[t][k], *v = m->vertex[t];
            int e = 0;
            while (q < t && m->neighbour[q][e] != t)
                e++;
            middle[t][k] = q < t ? middle[q][e] : f.nvertices;
            for (int a = 0; a < 3 && q > t; a++)
                f.x[f.nvertices][a] = 0.5 * (m->x[v[k]][a] + m->x[v[(k + 1) % 3]][a]);
            f.nvertices += q > t;
        }
    for (int t = 0; t < m->ntriangles; t++) {
        const int *v = m->vertex[t], *c = middle[t];
        for (int k = 0; k < 3; k++)
            add(&f, v[k], c[k], c[(k + 2) % 3]);
        add(&f, c[0], c[1], c[2]);
    }
    mem_free(middle);
    trimesh_connect(&f);
    return f;
}

static void to_unit_sphere(struct trimesh *m)
{
    for (int v = 0; v < m->nvertices; v++)
        vec3_unit(m->x[v]);
}

/* The icosahedron, refined. */
struct trimesh trimesh_sphere(const double centre[3], double radius, int level)
{
    static const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const double g = 0.5 * (1.0 + sqrt(5.0));
    struct trimesh m;
    reserve(&m, 12, 20);
    for (int v = 0; v < 12; v++) {
        const int axis = v / 4;
        m.x[v][(axis + 2) % 3] = 0.0;
        m.x[v][axis] = v % 2 ? 1.0 : -1.0;
        m.x[v][(axis + 1) % 3] = v % 4 < 2 ? g : -g;
    }
    m.nvertices = 12;
    for (int t = 0; t < 20; t++)
        add(&m, faces[t][0], faces[t][1], faces[t][2]);
    trimesh_connect(&m);
    to_unit_sphere(&m);
    for (int k = 0; k < level; k++) {
        struct trimesh f = refine(&m);
        trimesh_free(&m);
        m = f;
        to_unit_sphere(&m);
    }
    for (int v = 0; v < m.nvertices; v++)
        for (int a = 0; a < 3; a++)
            m.x[v][a] = centre[a] + radius * m.x[v][a];
    return m;
}

/* Sides first, two triangles each, then both lids, n - 2 triangles each. */
struct trimesh trimesh_prism(int n, const double (*points)[2], double low, double high)
{
    struct trimesh m;
    int *left = NEW(int, n);
    reserve(&m, 2 * n, 4 * n - 4);
    for (int i = 0; i < n; i++) {
        const double bottom[3] = {points[i][0], points[i][1], low};
        memcpy(m.x[i], bottom, sizeof bottom);
        memcpy(m.x[n + i], bottom, sizeof bottom);
        m.x[n + i][2] = high;
        left[i] = i;
        add(&m, i, (i + 1) % n, n + (i + 1) % n);
        add(&m, i, n + (i + 1) % n, n + i);
    }
    m.nvertices = 2 * n;
    int(*ear)[3] = (int(*)[3])mem_new((size_t)n, sizeof *ear);
    const int ears = trimesh_ears(n, left, points, ear);
    for (int k = 0; k < ears; k++) {
        add(&m, ear[k][0], ear[k][2], ear[k][1]);
        add(&m, n + ear[k][0], n + ear[k][1], n + ear[k][2]);
    }
    FREE(left, ear);
    trimesh_connect(&m);
    return m;
}

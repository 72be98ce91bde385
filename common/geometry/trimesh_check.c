/* trimesh_check.c - crossings, sizes, sense and hash of a mesh; see trimesh_check.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "trimesh_check.h"

#include <limits.h>

#include "../base/base.h"

/* --- crossings --- */

/* Whether the segment a -> b goes through the inside of a triangle, touching left out. Moeller &
 * Trumbore's test (1997) with margins `in' on all sides: parts that touch along an edge or face, as
 * walls of a tank do, are no crossing. */
static bool pierces(const struct trimesh *m, int triangle, const double *a, const double *b)
{
    const double in = 1e-7;
    double way[3], u, w, at;
    vec3_from(a, b, way);
    return trimesh_meet(m, triangle, a, way, 1e-9, &u, &w, &at) && u > in && w > in &&
           u + w < 1.0 - in && at > in && at < 1.0 - in;
}

/* An edge of either through the other. */
static bool cross(const struct trimesh *a, int t, const struct trimesh *b, int q)
{
    bool any = false;
    for (int k = 0; k < 3; k++)
        any = any || pierces(b, q, a->x[a->vertex[t][k]], a->x[a->vertex[t][(k + 1) % 3]]) ||
              pierces(a, t, b->x[b->vertex[q][k]], b->x[b->vertex[q][(k + 1) % 3]]);
    return any;
}

/* Neighbours touch without piercing each other. */
static bool share_vertex(const struct trimesh *m, int t, int q)
{
    for (int k = 0; k < 9; k++)
        if (m->vertex[t][k / 3] == m->vertex[q][k % 3])
            return true;
    return false;
}

static void box_of(const struct trimesh *m, int t, double *lo, double *hi)
{
    for (int a = 0; a < 3; a++) {
        const double p = m->x[m->vertex[t][0]][a], q = m->x[m->vertex[t][1]][a],
                     r = m->x[m->vertex[t][2]][a];
        lo[a] = fmin(p, fmin(q, r));
        hi[a] = fmax(p, fmax(q, r));
    }
}

/* Ranks take every size-th triangle, so that a fine region is spread over all of them; of each
 * triangle the tree gives the few that may meet it. */
int trimesh_crossings(const struct trimesh *a, const struct tree *tree, const struct trimesh *b,
                      MPI_Comm comm, int *first)
{
    int rank, size, room = 1024, n = 0, *who = NEW(int, room);
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    *first = INT_MAX;
    for (int t = rank; t < a->ntriangles; t += size) {
        double lo[3], hi[3];
        box_of(a, t, lo, hi);
        int found = tree_box(tree, lo, hi, room, who), any = 0;
        if (found > room) {
            mem_free(who);
            who = NEW(int, 2 * found);
            room = 2 * found;
            found = tree_box(tree, lo, hi, room, who);
        }
        for (int k = 0; k < found && !any; k++)
            any =
                (a != b || (who[k] != t && !share_vertex(a, t, who[k]))) && cross(a, t, b, who[k]);
        n += any;
        *first = any && t < *first ? t : *first;
    }
    mem_free(who);
    MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, first, 1, MPI_INT, MPI_MIN, comm);
    *first = n > 0 ? *first : -1;
    return n;
}

/* --- sizes --- */

/* Each edge once, from the triangle of the lower number. With the height h over it and the angle c
 * between the normals the surface is h c/8 off on a cylinder and h c/3 on a sphere; h c/4 lies
 * between. */
struct trimesh_sizes trimesh_sizes(const struct trimesh *m)
{
    const double smooth = cos(40.0 * M_PI / 180.0);
    struct trimesh_sizes s = {.least = INFINITY};
    for (int t = 0; t < m->ntriangles; t++) {
        double n[3], other[3], height[2];
        const double area = trimesh_normal(m, t, n);
        for (int k = 0; k < 3; k++) {
            const int q = m->neighbour[t][k];
            double d[3];
            vec3_from(m->x[m->vertex[t][k]], m->x[m->vertex[t][(k + 1) % 3]], d);
            const double l = vec3_length(d);
            s.least = fmin(s.least, l);
            s.most = fmax(s.most, l);
            s.mean += l / (3.0 * m->ntriangles);
            if (q < t)
                continue;
            height[0] = 2.0 * area / l;
            height[1] = 2.0 * trimesh_normal(m, q, other) / l;
            const double c = vec3_dot(n, other);
            if (c > smooth && c < 1.0) /* of a cylinder an eighth, of a sphere a third */
                s.sagitta = fmax(s.sagitta, fmin(height[0], height[1]) * acos(c) / 4.0);
        }
    }
    return s;
}

/* --- sense --- */

struct surface_part {
    double lo[3], hi[3], volume;
    int first; /* a triangle of it */
};

/* Bounds, one triangle and signed volume of each part; positive where normals point out of what it
 * encloses. */
static struct surface_part *parts_of(const struct trimesh *m)
{
    struct surface_part *p = NEW(struct surface_part, m->nparts);
    for (int k = 0; k < m->nparts; k++)
        p[k] = (struct surface_part){.lo = {INFINITY, INFINITY, INFINITY},
                                     .hi = {-INFINITY, -INFINITY, -INFINITY},
                                     .first = -1};
    for (int t = 0; t < m->ntriangles; t++) {
        struct surface_part *q = p + m->part[t];
        double lo[3], hi[3];
        box_of(m, t, lo, hi);
        q->first = q->first < 0 ? t : q->first;
        for (int a = 0; a < 3; a++) {
            q->lo[a] = fmin(q->lo[a], lo[a]);
            q->hi[a] = fmax(q->hi[a], hi[a]);
        }
    }
    for (int t = 0; t < m->ntriangles; t++) { /* about a corner of its own: little cancels */
        struct surface_part *q = p + m->part[t];
        double d[3][3], c[3];
        for (int k = 0; k < 3; k++)
            vec3_from(q->lo, m->x[m->vertex[t][k]], d[k]);
        vec3_cross(d[1], d[2], c);
        q->volume += vec3_dot(d[0], c) / 6.0;
    }
    return p;
}

/* Winding number of one part alone. Copies the part's triangles: called for a few pairs of parts at
 * the start. */
static double winding_of(const struct trimesh *m, int part, const double *x)
{
    struct trimesh one = {.x = m->x, .vertex = mem_new((size_t)m->ntriangles, 3 * sizeof(int))};
    for (int t = 0; t < m->ntriangles; t++)
        if (m->part[t] == part) {
            for (int k = 0; k < 3; k++)
                one.vertex[one.ntriangles][k] = m->vertex[t][k];
            one.ntriangles++;
        }
    const double w = trimesh_winding(&one, x);
    mem_free(one.vertex);
    return w;
}

/* The box of a in that of b. */
static bool within(const struct surface_part *a, const struct surface_part *b)
{
    for (int k = 0; k < 3; k++)
        if (a->lo[k] < b->lo[k] || a->hi[k] > b->hi[k])
            return false;
    return true;
}

/* How many other parts a part lies in. */
static int depth_of(const struct trimesh *m, const struct surface_part *parts, int k)
{
    const double *x = m->x[m->vertex[parts[k].first][0]];
    int n = 0;
    for (int q = 0; q < m->nparts; q++)
        n += q != k && within(parts + k, parts + q) && fabs(winding_of(m, q, x)) > 0.5;
    return n;
}

/* A part at an even depth within others bounds a solid from outside, at an odd depth a hole in
 * one. */
int trimesh_orient_closed(struct trimesh *m, int sign)
{
    struct surface_part *parts = parts_of(m);
    bool *turn = NEW(bool, m->nparts);
    int n = 0;
    for (int k = 0; k < m->nparts; k++) {
        const bool in = sign > 0 ? parts[k].volume < 0.0 : parts[k].volume > 0.0;
        turn[k] = in != (depth_of(m, parts, k) % 2 == 1);
        n += turn[k];
    }
    for (int k = 0; k < m->nparts; k++)
        if (turn[k])
            trimesh_turn(m, k);
    FREE(turn, parts);
    return n;
}

/* By the divergence theorem over the surface and the cone that closes it. */
double trimesh_openness(const struct trimesh *m, double *volume, double normal[3])
{
    double middle[3] = {0.0, 0.0, 0.0}, area = 0.0, n[3];
    memset(normal, 0, sizeof n);
    int count = 0;
    for (int at = 0; at < 3 * m->ntriangles; at++)
        if (m->neighbour[at / 3][at % 3] < 0) {
            count++;
            for (int a = 0; a < 3; a++)
                middle[a] += m->x[m->vertex[at / 3][at % 3]][a];
        }
    for (int a = 0; a < 3; a++)
        middle[a] = count > 0 ? middle[a] / count : m->x[0][a];
    *volume = 0.0;
    for (int t = 0; t < m->ntriangles; t++) {
        const double A = trimesh_normal(m, t, n);
        double d[3];
        vec3_from(middle, m->x[m->vertex[t][0]], d);
        *volume += A * vec3_dot(d, n) / 3.0;
        area += A;
        for (int a = 0; a < 3; a++)
            normal[a] += A * n[a];
    }
    for (int a = 0; a < 3 && area > 0.0; a++)
        normal[a] /= area;
    return vec3_length(normal);
}

uint64_t trimesh_hash(const struct trimesh *m)
{
    const struct {
        const void *p;
        size_t size;
    } of[2] = {{m->x, (size_t)m->nvertices * sizeof *m->x},
               {m->vertex, (size_t)m->ntriangles * sizeof *m->vertex}};
    uint64_t h = 0xcbf29ce484222325u;
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < of[k].size; i++)
            h = (h ^ ((const unsigned char *)of[k].p)[i]) * 0x100000001b3u;
    return h;
}

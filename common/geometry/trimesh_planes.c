/* trimesh_planes.c - which triangles of a surface lie in one plane with their neighbours: numbers
 * by the first triangle of each plane, for the walls of SPH (sph/walls/wall_mesh.c). O(n): each
 * triangle is given its plane once, or looked at in vain from each of its three sides.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "trimesh.h"

#include "../base/base.h"

/* Against the first of its plane, so that a fine round surface is none. */
static bool is_level(const struct trimesh *m, int triangle, const double *n)
{
    const double turn = 1e-5; /* what single precision makes of a plane */
    double is[3];
    trimesh_normal(m, triangle, is);
    return vec3_dot(is, n) > 1.0 - 0.5 * turn * turn;
}

/* Gives `number' to all that hang together with `first' in its plane; returns how many. */
static int spread(const struct trimesh *m, int first, int *number, int *waiting)
{
    double n[3];
    int nwaiting = 0, count = 1;
    trimesh_normal(m, first, n);
    number[first] = first;
    waiting[nwaiting++] = first;
    while (nwaiting > 0) {
        const int t = waiting[--nwaiting];
        for (int e = 0; e < 3; e++) {
            const int other = m->neighbour[t][e];
            if (other < 0 || number[other] >= 0 || !is_level(m, other, n))
                continue;
            number[other] = first;
            waiting[nwaiting++] = other;
            count++;
        }
    }
    return count;
}

/* -1: alone in its plane. */
int *trimesh_planes(const struct trimesh *m)
{
    int *number = NEW(int, m->ntriangles), *waiting = NEW(int, m->ntriangles);
    memset(number, -1, (size_t)m->ntriangles * sizeof *number);
    for (int t = 0; t < m->ntriangles; t++)
        if (number[t] < 0 && spread(m, t, number, waiting) == 1)
            number[t] = -2; /* looked at, alone */
    for (int t = 0; t < m->ntriangles; t++)
        number[t] = number[t] < 0 ? -1 : number[t];
    mem_free(waiting);
    return number;
}

/* cells.c - centroid and volume of general cells. Polygons by the shoelace formula; polyhedra as
 * tetrahedra between the mean of the corners and the triangles that join each face's edges with the
 * mean of its corners: two cells cut the face that they share alike, so that volumes add up, flat
 * faces or not. SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

enum { FACES = 6, CORNERS = 4, NO = -1 };

/* Corners of the faces in VTK's order (File formats for VTK, version 4.2), -1: a triangle. */
static const int tetrahedron[FACES][CORNERS] = {{0, 1, 3, NO}, {1, 2, 3, NO}, {2, 0, 3, NO},
                                                {0, 2, 1, NO}, {NO},          {NO}};
static const int pyramid[FACES][CORNERS] = {{0, 3, 2, 1},  {0, 1, 4, NO}, {1, 2, 4, NO},
                                            {2, 3, 4, NO}, {3, 0, 4, NO}, {NO}};
static const int wedge[FACES][CORNERS] = {{0, 1, 2, NO}, {3, 5, 4, NO}, {0, 3, 4, 1},
                                          {1, 4, 5, 2},  {2, 5, 3, 0},  {NO}};
static const int hexahedron[FACES][CORNERS] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                               {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

/* Area and first moment as sums of signed triangles; either sense of the corners is taken. */
static void polygon(int n, const double *x, double centroid[3], double *volume)
{
    double area = 0.0, sum[2] = {0.0, 0.0};
    for (int i = 1; i + 1 < n; i++) { /* triangles from the first corner: no loss far from 0 */
        const double a[2] = {x[3 * i] - x[0], x[3 * i + 1] - x[1]};
        const double b[2] = {x[3 * i + 3] - x[0], x[3 * i + 4] - x[1]};
        const double twice = a[0] * b[1] - a[1] * b[0];
        area += 0.5 * twice;
        for (int d = 0; d < 2; d++)
            sum[d] += 0.5 * twice * (a[d] + b[d]) / 3.0;
    }
    *volume = fabs(area);
    for (int d = 0; d < 2 && area != 0.0; d++)
        centroid[d] = x[d] + sum[d] / area;
}

/* corner NULL: the first n. */
static void mean(int n, const double *x, const int *corner, double out[3])
{
    for (int d = 0; d < 3; d++) {
        out[d] = 0.0;
        for (int i = 0; i < n; i++)
            out[d] += x[3 * (corner ? corner[i] : i) + d] / n;
    }
}

/* The tetrahedron of o and a triangle, added to the volume and its first moment about o. volume is
 * signed, by the sense of the triangle; a wrong sense throughout drops out in the end (fabs). */
static void add_tetrahedron(const double o[3], const double *p, const double *q, const double *r,
                            double *volume, double moment[3])
{
    double a[3], b[3], c[3];
    for (int d = 0; d < 3; d++) {
        a[d] = p[d] - o[d];
        b[d] = q[d] - o[d];
        c[d] = r[d] - o[d];
    }
    const double v = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                      a[2] * (b[0] * c[1] - b[1] * c[0])) /
                     6.0;
    *volume += v;
    for (int d = 0; d < 3; d++)
        moment[d] += 0.25 * v * (a[d] + b[d] + c[d]);
}

/* 4, 5, 6 or 8 corners: tetrahedron, pyramid, wedge, hexahedron. */
static void polyhedron(int n, const double *x, double centroid[3], double *volume)
{
    const int(*const face)[CORNERS] = n == 4   ? tetrahedron
                                      : n == 5 ? pyramid
                                      : n == 6 ? wedge
                                               : hexahedron;
    double o[3], v = 0.0, moment[3] = {0.0, 0.0, 0.0};
    mean(n, x, NULL, o);
    for (int f = 0; f < FACES && face[f][0] != NO; f++) {
        const int m = face[f][3] == NO ? 3 : 4;
        double middle[3];
        mean(m, x, face[f], middle);
        for (int i = 0; i < m; i++)
            add_tetrahedron(o, middle, x + 3 * face[f][i], x + 3 * face[f][(i + 1) % m], &v,
                            moment);
    }
    *volume = fabs(v);
    for (int d = 0; d < 3 && v != 0.0; d++)
        centroid[d] = o[d] + moment[d] / v;
}

void cpl_cell(int dim, int nvertex, const double *x, double centroid[3], double *volume)
{
    memset(centroid, 0, 3 * sizeof *centroid);
    *volume = 0.0;
    if (dim == 2 && nvertex >= 3)
        polygon(nvertex, x, centroid, volume);
    if (dim == 3 && (nvertex == 4 || nvertex == 5 || nvertex == 6 || nvertex == 8))
        polyhedron(nvertex, x, centroid, volume);
}

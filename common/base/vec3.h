/* vec3.h - inline operations on vectors of three components, plain double[3] in any unit. Arguments
 * may not overlap with results unless a comment allows it.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>

/* The scalar product a . b. */
static inline double vec3_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The Euclidean length |a|. */
static inline double vec3_length(const double *a) { return sqrt(vec3_dot(a, a)); }

/* c = a x b; c may be a or b. */
static inline void vec3_cross(const double *a, const double *b, double *c)
{
    const double d[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    for (int k = 0; k < 3; k++)
        c[k] = d[k];
}

/* to += f a; `to' may be a. */
static inline void vec3_add(double *to, double f, const double *a)
{
    for (int k = 0; k < 3; k++)
        to[k] += f * a[k];
}

/* d = b - a, the way from a to b; d may be a or b. */
static inline void vec3_from(const double *a, const double *b, double *d)
{
    for (int k = 0; k < 3; k++)
        d[k] = b[k] - a[k];
}

/* The distance |b - a| between two points. */
static inline double vec3_distance(const double *a, const double *b)
{
    double d[3];
    vec3_from(a, b, d);
    return vec3_length(d);
}

/* The square of the distance between two points of dim coordinates. */
static inline double vec_distance2(int dim, const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < dim; k++)
        sum += (b[k] - a[k]) * (b[k] - a[k]);
    return sum;
}

/* Makes a unit vector of a and returns the length it had; a zero vector stays zero. */
static inline double vec3_unit(double *a)
{
    const double length = vec3_length(a);
    for (int k = 0; k < 3 && length > 0.0; k++)
        a[k] /= length;
    return length;
}

/* c[a]: the cross product of the two rows of A after row a, so that the inverse of A is the
 * transpose of c over the determinant of A, which is returned. */
static inline double vec3_cofactors(double A[3][3], double c[3][3])
{
    for (int a = 0; a < 3; a++)
        vec3_cross(A[(a + 1) % 3], A[(a + 2) % 3], c[a]);
    return vec3_dot(A[0], c[0]);
}

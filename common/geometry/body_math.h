/* body_math.h - rotations of rigid bodies, inline. A matrix Q[3][3] is stored by rows and turns
 * from the body's axes to those of space; quaternions are (w, x, y, z); rotation vectors are axis
 * times angle in rad.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../base/base.h"

/* to = Q v; `to' may be v. */
static inline void turn3(double Q[3][3], const double *v, double *to)
{
    const double w[3] = {vec3_dot(Q[0], v), vec3_dot(Q[1], v), vec3_dot(Q[2], v)};
    for (int k = 0; k < 3; k++)
        to[k] = w[k];
}

/* to = Q^T v, the inverse rotation; `to' may be v. */
static inline void turn_back3(double Q[3][3], const double *v, double *to)
{
    double w[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; k++)
        vec3_add(w, v[k], Q[k]);
    for (int k = 0; k < 3; k++)
        to[k] = w[k];
}

/* Rotation matrix of a quaternion q[4] of any length but 0. */
static inline void rotation_of_quaternion(const double *q, double Q[3][3])
{
    const double n = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double R[3][3] = {{1 - n * (y * y + z * z), n * (x * y - w * z), n * (x * z + w * y)},
                            {n * (x * y + w * z), 1 - n * (x * x + z * z), n * (y * z - w * x)},
                            {n * (x * z - w * y), n * (y * z + w * x), 1 - n * (x * x + y * y)}};
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            Q[a][b] = R[a][b];
}

/* f = sin s/s, g = (1 - cos s)/s^2, h = (s - sin s)/s^3 of an angle s >= 0 in rad, by their series
 * below 0.01, where the quotients would lose digits. */
static inline void rotation_factors(double s, double *f, double *g, double *h)
{
    const double s2 = s * s;
    if (s < 1e-2) {
        *f = 1.0 - s2 / 6.0 * (1.0 - s2 / 20.0);
        *g = 0.5 - s2 / 24.0 * (1.0 - s2 / 30.0);
        *h = 1.0 / 6.0 - s2 / 120.0 * (1.0 - s2 / 42.0);
        return;
    }
    *f = sin(s) / s;
    *g = (1.0 - cos(s)) / s2;
    *h = (s - sin(s)) / (s2 * s);
}

/* Rotation matrix of a rotation vector r (Rodrigues): Q = 1 + f [r]x + g [r]x^2. */
static inline void rotation_of_vector(const double *r, double Q[3][3])
{
    double f, g, h;
    rotation_factors(vec3_length(r), &f, &g, &h);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            Q[a][b] = g * r[a] * r[b] + (a == b ? 1.0 - g * vec3_dot(r, r) : 0.0);
    Q[0][1] -= f * r[2];
    Q[1][0] += f * r[2];
    Q[1][2] -= f * r[0];
    Q[2][1] += f * r[0];
    Q[2][0] -= f * r[1];
    Q[0][2] += f * r[1];
}

/* Rotation vector of a quaternion q[4] of any length but 0; its angle is at most pi. */
static inline void vector_of_quaternion(const double *q, double *r)
{
    const double v = vec3_length(q + 1), w = fabs(q[0]);
    const double f = v > 0.0 ? 2.0 * atan2(v, w) / v : 2.0 / w;
    for (int k = 0; k < 3; k++)
        r[k] = (q[0] < 0.0 ? -f : f) * q[1 + k];
}

/* Angular velocity omega, rad/s, in the axes of space of a rotation vector r, rad, that changes at
 * the rate dr, rad/s: omega = dr + g r x dr + h r x (r x dr). */
static inline void spin_of_vector(const double *r, const double *dr, double *omega)
{
    double f, g, h, a[3], b[3];
    rotation_factors(vec3_length(r), &f, &g, &h);
    vec3_cross(r, dr, a);
    vec3_cross(r, a, b);
    for (int k = 0; k < 3; k++)
        omega[k] = dr[k] + g * a[k] + h * b[k];
}

/* kernel.h - the Wendland C2 kernel over its support radius R [2.7-2.8]; r: distance, m.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_KERNEL_H
#define SPH_KERNEL_H

/* W(0), 1/m^dim: C/theta with C = 7, theta = pi R^2 in 2D, C = 14, theta = 4/3 pi R^3 in 3D. */
static inline double kernel_w0(int dim, double R)
{
    const double pi = 3.14159265358979323846;
    return dim == 2 ? 7.0 / (pi * R * R) : 10.5 / (pi * R * R * R);
}

static inline double kernel_w(int dim, double r, double R)
{
    const double q = r / R, t = q < 1.0 ? 1.0 - q : 0.0;
    return kernel_w0(dim, R) * t * t * t * t * (1.0 + 4.0 * q);
}

/* W'(r)/r <= 0, finite at r = 0; grad_i W(x_i - x_j) is this times x_i - x_j. */
static inline double kernel_dw_r(int dim, double r, double R)
{
    const double q = r / R, t = q < 1.0 ? 1.0 - q : 0.0;
    return -20.0 * kernel_w0(dim, R) * t * t * t / (R * R);
}

#endif

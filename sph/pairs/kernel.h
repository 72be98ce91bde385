/* kernel.h - Wendland's C2 kernel of support radius R [2.7-2.8], q = r/R:
 *   W = W0 (1-q)^4 (1+4q),  W'/r = -20 W0/R^2 (1-q)^3,  W0 = 7/(pi R^2) in 2D, 21/(2 pi R^3) in 3D.
 * W'/r needs no division. SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_KERNEL_H
#define SPH_KERNEL_H

#include <math.h>

/* W(0), 1/m^dim, for the support R, m. */
static inline double kernel_w0(int dim, double R)
{
    return dim == 2 ? 7.0 / (M_PI * R * R) : 21.0 / (2.0 * M_PI * R * R * R);
}

/* W at the distance r, m; 0 from R on. */
static inline double kernel_w(int dim, double r, double R)
{
    const double q = r / R, t = q < 1.0 ? 1.0 - q : 0.0;
    return kernel_w0(dim, R) * t * t * t * t * (1.0 + 4.0 * q);
}

/* W'(r)/r <= 0, 1/m^(dim+2): the gradient of W at x_i is this times (x_i - x_j). */
static inline double kernel_dw_r(int dim, double r, double R)
{
    const double q = r / R, t = q < 1.0 ? 1.0 - q : 0.0;
    return -20.0 * kernel_w0(dim, R) / (R * R) * t * t * t;
}

#endif

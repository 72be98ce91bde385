/* wave.h - viscous standing gravity wave over a no-slip bottom: the exact mode of the linearised
 * Navier-Stokes equations (no air, no surface tension), with s = sigma + i omega,
 *   u = Re[U(y) e^(st)] sin kx, v = Re[V(y) e^(st)] cos kx, eta = Re[E e^(st)] cos kx,
 *   V = A cosh ky + B sinh ky + C e^(my) + D e^(-m(y+H)),  U = -V'/k,  m^2 = k^2 + s/nu,
 *   p = -rho g y + Re[P e^(st)] cos kx,  P = -(rho s/k)(A sinh ky + B cosh ky),
 * from no shear and no normal force at y = 0 and V = V' = 0 at y = -H. The surface is flat at t =
 * 0. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVE_H
#define COMMON_WAVE_H

/* The mode; plain data. */
struct wave {
    double H, k, g, nu, rho; /* m, 1/m, m/s^2, m^2/s, kg/m^3 */
    double _Complex s, m;    /* 1/s, 1/m; nu = 0: m is not used */
    double _Complex c[4];    /* A, B, C, D in m/s */
    double _Complex E;       /* m */
};

/* The wave of depth H, length and amplitude of eta, m; nu may be 0, and then bottom and surface
 * slip. */
struct wave wave_create(double H, double length, double g, double nu, double rho, double amplitude);
/* u, v, p (0 at the still surface) and vorticity dv/dx - du/dy at (x, y), y = 0 at the still
 * surface; pointers may be NULL. */
void wave_point(const struct wave *w, double x, double y, double t, double *u, double *p,
                double *vorticity);
/* Enstrophy of the still layer, half the square of the vorticity, over the area of its bottom;
 * m/s^2. */
double wave_enstrophy(const struct wave *w, double t);

#endif

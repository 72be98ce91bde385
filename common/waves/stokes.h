/* stokes.h - a steep travelling wave of deep water at t = 0: Stokes's profile of third order over
 * the velocities of linear theory (as Iafrati, J. Fluid Mech. 622, 2009, starts breaking waves;
 * Chiron 2017, 6.5.2). With e = k a, theta = k x,
 *   eta = a (cos theta + e/2 cos 2 theta + 3/8 e^2 cos 3 theta),  omega^2 = g k (1 + e^2),
 *   u = a omega exp(ky) cos theta,  v = a omega exp(ky) sin theta,
 * so that v is eta's rate of change for a crest that travels to +x. From about e = 0.35 it breaks.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_STOKES_H
#define COMMON_STOKES_H

/* The wave; plain data, nothing to free. */
struct stokes {
    double k, a, omega;     /* 1/m, m, 1/s */
    double g, rho, highest; /* m/s^2, kg/m^3, m: of the crest */
};

/* The wave of that length and amplitude, m; a crest is at x = 0. */
struct stokes stokes_create(double length, double g, double rho, double amplitude);
/* m over the still level. */
double stokes_eta(const struct stokes *w, double x);
/* u, v (m/s), p (Pa) at (x, y), y = 0 at the still level; above the crest as at its height. p is
 * Bernoulli's for a wave that keeps its form, made 0 on the surface by an error that decays
 * below as exp(k(y - eta)). u, p may be NULL. */
void stokes_point(const struct stokes *w, double x, double y, double *u, double *p);

#endif

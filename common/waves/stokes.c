/* stokes.c - see stokes.h. Only for the state at t = 0. In deep water the potential has no second
 * harmonic, which is why first-order velocities go with a level of third order; the pressure is
 * Bernoulli's in the frame of the wave.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "stokes.h"

#include <math.h>

/* Third order: omega^2 = g k (1 + (k a)^2). */
struct stokes stokes_create(double length, double g, double rho, double amplitude)
{
    struct stokes w = {.k = 2.0 * M_PI / length, .a = amplitude, .g = g, .rho = rho};
    const double e = w.k * amplitude;
    w.omega = sqrt(g * w.k * (1.0 + e * e));
    w.highest = stokes_eta(&w, 0.0);
    return w;
}

double stokes_eta(const struct stokes *w, double x)
{
    const double e = w->k * w->a, theta = w->k * x;
    return w->a * (cos(theta) + 0.5 * e * cos(2.0 * theta) + 0.375 * e * e * cos(3.0 * theta));
}

static void velocity(const struct stokes *w, double x, double y, double *u)
{
    const double speed = w->a * w->omega * exp(w->k * fmin(y, w->highest));
    u[0] = speed * cos(w->k * x);
    u[1] = speed * sin(w->k * x);
}

/* Bernoulli's equation where the wave rests: p/rho + g y + |u|^2/2 - c u is constant. */
static double bernoulli(const struct stokes *w, double x, double y)
{
    double u[2];
    velocity(w, x, y, u);
    return w->rho * (w->omega / w->k * u[0] - 0.5 * (u[0] * u[0] + u[1] * u[1]) - w->g * y);
}

/* What the series leaves on the surface fades with depth, so that p is 0 there. */
void stokes_point(const struct stokes *w, double x, double y, double *u, double *p)
{
    const double eta = stokes_eta(w, x);
    if (u)
        velocity(w, x, y, u);
    if (p && y < eta)
        *p = bernoulli(w, x, y) - bernoulli(w, x, eta) * exp(w->k * (y - eta));
    else if (p)
        *p = 0.0;
}

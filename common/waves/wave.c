/* wave.c - eigenvalue and profiles of a viscous standing wave. See wave.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave.h"

#include <complex.h>
#include <math.h>
#include <stddef.h>

/* The four conditions on (A, B, C, D), rows scaled so that the determinant stays of order one.
 * Rows: no shear stress and no normal stress on the surface, no velocity up and none along at the
 * bottom. The two terms of the thin layers, e^(my) and e^(-m(y + H)), are 1 at the surface and at
 * the bottom, so that neither overflows. */
static void conditions(const struct wave *w, double complex s, double complex a[4][4])
{
    const double k = w->k, ch = cosh(k * w->H), sh = sinh(k * w->H);
    const double complex m = csqrt(k * k + s / w->nu), e = cexp(-m * w->H), n = m * m + k * k;
    const double per_speed = sqrt(k / w->g); /* pivots are the same in all units */
    const double complex gs = w->g / s * per_speed, drag = 2.0 * w->nu * per_speed;
    const double complex row[4][4] = {
        {2.0 * k * k / n, 0.0, 1.0, e},
        {gs, s / k * per_speed + drag * k, gs + drag * m, (gs - drag * m) * e},
        {ch, -sh, e, 1.0},
        {-k * sh / m, k * ch / m, e, -1.0}};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            a[i][j] = row[i][j];
}

/* Gaussian elimination of the first three columns with row pivots; returns the determinant and
 * leaves an upper triangle. */
static double complex eliminate(double complex a[4][4])
{
    double complex det = 1.0;
    for (int j = 0; j < 3; j++) {
        int best = j;
        for (int i = j + 1; i < 4; i++)
            best = cabs(a[i][j]) > cabs(a[best][j]) ? i : best;
        for (int l = 0; l < 4 && best != j; l++) {
            const double complex other = a[j][l];
            a[j][l] = a[best][l];
            a[best][l] = other;
        }
        det *= best != j ? -a[j][j] : a[j][j];
        for (int i = j + 1; i < 4; i++) {
            const double complex f = a[i][j] / a[j][j];
            for (int l = j; l < 4; l++)
                a[i][l] -= f * a[j][l];
        }
    }
    return det * a[3][3];
}

static double complex determinant(const struct wave *w, double complex s)
{
    double complex a[4][4];
    conditions(w, s, a);
    return eliminate(a);
}

/* Newton's method from the inviscid frequency with the damping of the bottom's Stokes layer. The
 * derivative by central differences. */
static double complex solve(const struct wave *w)
{
    const double k = w->k, omega = sqrt(w->g * k * tanh(k * w->H));
    double complex s =
        I * omega - k * sqrt(0.5 * w->nu * omega) / sinh(2.0 * k * w->H) - 2.0 * w->nu * k * k;
    for (int n = 0; n < 60; n++) {
        const double h = 1e-6 * cabs(s);
        const double complex f = determinant(w, s);
        const double complex df = (determinant(w, s + h) - determinant(w, s - h)) / (2.0 * h);
        const double complex ds = f / df;
        s -= ds;
        if (cabs(ds) < 1e-14 * cabs(s))
            break;
    }
    return s;
}

/* The null vector, D = 1, from the three eliminated rows. */
static void null_vector(const struct wave *w, double complex c[4])
{
    double complex a[4][4];
    conditions(w, w->s, a);
    eliminate(a);
    c[3] = 1.0;
    for (int i = 2; i >= 0; i--) {
        double complex sum = 0.0;
        for (int l = i + 1; l < 4; l++)
            sum += a[i][l] * c[l];
        c[i] = -sum / a[i][i];
    }
}

/* Without viscosity as the limit of it: two of four terms, and a rate that is imaginary. */
struct wave wave_create(double H, double length, double g, double nu, double rho, double amplitude)
{
    struct wave w = {.H = H, .k = 2.0 * M_PI / length, .g = g, .nu = nu, .rho = rho};
    const double k = w.k;
    w.E = -I * amplitude; /* eta = amplitude sin(omega t) cos kx without damping */
    if (nu > 0.0) {
        w.s = solve(&w);
        w.m = csqrt(k * k + w.s / nu);
        null_vector(&w, w.c);
    } else {
        w.s = I * sqrt(g * k * tanh(k * H));
        w.c[0] = tanh(k * H);
        w.c[1] = 1.0;
    }
    const double complex eta = (w.c[0] + w.c[2] + (nu > 0.0 ? w.c[3] * cexp(-w.m * H) : 0.0)) / w.s;
    for (int i = 0; i < 4; i++)
        w.c[i] *= w.E / eta;
    return w;
}

void wave_point(const struct wave *w, double x, double y, double t, double *u, double *p,
                double *vorticity)
{
    const double complex A = w->c[0], B = w->c[1], e = cexp(w->s * t);
    /* beyond the mean level and the bottom, where ghosts lie, layers go on for twice their own
     * thickness: thinner ones would grow without bounds */
    const double most = w->nu > 0.0 ? 2.0 / creal(w->m) : 0.0;
    const double complex up = w->nu > 0.0 ? w->c[2] * cexp(w->m * fmin(y, most)) : 0.0;
    const double complex down = w->nu > 0.0 ? w->c[3] * cexp(-w->m * fmax(y + w->H, -most)) : 0.0;
    const double ch = cosh(w->k * y), sh = sinh(w->k * y);
    if (u) {
        u[0] = creal((-(A * sh + B * ch) - w->m / w->k * (up - down)) * e) * sin(w->k * x);
        u[1] = creal((A * ch + B * sh + up + down) * e) * cos(w->k * x);
    }
    if (p)
        *p = -w->rho * w->g * y +
             creal(-(w->rho * w->s / w->k) * (A * sh + B * ch) * e) * cos(w->k * x);
    if (vorticity)
        *vorticity =
            w->nu > 0.0 ? creal(w->s / w->nu / w->k * (up + down) * e) * sin(w->k * x) : 0.0;
}

/* Half of it from the mean of sin^2; Simpson's rule on 4000 intervals resolves the layers. */
double wave_enstrophy(const struct wave *w, double t)
{
    const int n = 4000;
    double sum = 0.0;
    for (int i = 0; i <= n; i++) {
        double vorticity;
        wave_point(w, 0.5 * M_PI / w->k, -w->H * i / n, t, NULL, NULL, &vorticity);
        sum += (i == 0 || i == n ? 1.0 : i % 2 ? 4.0 : 2.0) * vorticity * vorticity;
    }
    return 0.25 * sum * w->H / (3.0 * n);
}

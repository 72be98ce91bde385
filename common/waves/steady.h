/* steady.h - gravity waves of permanent form over a flat bottom without friction, regular or
 * solitary (a regular one so long that its trough is still water). In the wave's frame the water is
 * the image of a strip of height h* under
 *   z(zeta) = zeta + i y0 + i sum Y_j (e^(-ij zeta) - e^(ij zeta - 2j h*))/(1 - e^(-2j h*)),
 * in units of 1/k and sqrt(g/k); Y_j, b and c from Bernoulli's equation (b - 2y)|z'|^2 = c^2 in
 * N + 1 places of the surface and the height, by Newton's method along growing heights. Holds up to
 * 0.9 of the highest wave; c agrees with the stream function method (Rienecker & Fenton, J. Fluid
 * Mech. 104, 1981). SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_STEADY_H
#define COMMON_STEADY_H

#include <stdbool.h>

/* Most modes Y_j of a wave, N above. */
enum { STEADY_MODES = 128 };

/* The solution; plain data, nothing to free. */
struct steady {
    double k, g, rho;       /* 1/m, m/s^2, kg/m^3 */
    double x;               /* m: of the crest at t = 0 */
    double c;               /* m/s: to +x, over water that is still on average below the troughs */
    double frame, b, y0;    /* -: speed in the frame of the wave; Bernoulli's constant; level */
    double strip;           /* -: h* */
    double back;            /* -: speed under the trough of a solitary wave, taken out */
    double crest, trough;   /* m: over the still level */
    double tail;            /* |Y_N/Y_1|: what the series leaves out */
    int modes;              /* N; 0: none was found */
    double A[STEADY_MODES]; /* Y_j/(1 - e^(-2j h*)), j = 1 .. modes */
};

/* Gradients at a point. */
struct steady_slopes {
    double u[2][2]; /* 1/s: of u, of v, each along x, y */
    double p[2];    /* Pa/m */
};

/* Solves for the wave of that depth, length and height from trough to crest, m, whose crest is at
 * x, m, at t = 0. solitary: length is not used, depth is that of the still water. false: there is
 * no such wave, or Newton's method does not find it. */
bool steady_create(struct steady *w, bool solitary, double depth, double length, double height,
                   double x, double g, double rho);
/* Level over the still one at x, t, m. */
double steady_eta(const struct steady *w, double x, double t);
/* u, v (m/s), p (Pa, 0 on the surface) at (x, y), y = 0 at the still level; above the surface as on
 * it. u, p may be NULL. */
void steady_point(const struct steady *w, double x, double y, double t, double *u, double *p);
/* The same, and the gradients of both there unless of is NULL; above the surface those along it. */
void steady_point_slopes(const struct steady *w, double x, double y, double t, double *u, double *p,
                         struct steady_slopes *of);

#endif

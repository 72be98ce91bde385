/* wall_moments.h - integrals of Wendland's C2 kernel over the part of a straight wall within the
 * support, in closed form (Chiron 2017): what the wall takes from the Shepard factor [4.52-4.59],
 * its weight and its centre. One angle and one logarithm, the rest are polynomials. Lengths in
 * units of R.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SPH_WALL_MOMENTS_H
#define SPH_WALL_MOMENTS_H

#include <math.h>

/* The integrals over one wall of the kernel around one particle. */
struct wall_moments {
    double gamma; /* -: 1 + sum of it over the walls is the Shepard factor: 1 inside, 1/2 on a flat
                     wall, angle/(2 pi) in a corner; behind a wall one more */
    double W;     /* 1/R: int W ds; 0: out of reach */
    double along; /* R: int W y ds / W, y counted from the foot of x along the wall */
};

/* The piece from a to b (counted from the foot of the particle) of a line at the distance d > 0:
 * integrals J_k of r^k and Y_k of y^(k-1) along it, with r^2 = d^2 + y^2. */
struct wall_piece {
    double a, b, ra, rb;
    double angle; /* int d/r^2: under which x sees it */
    double J0;    /* int 1/r */
    double J1, J3, J5, Y1, Y3, Y5;
};

static inline struct wall_piece wall_piece(double d, double a, double b)
{
    const double d2 = d * d, a2 = a * a, b2 = b * b, ra2 = d2 + a2, rb2 = d2 + b2;
    const double ra = sqrt(ra2), rb = sqrt(rb2);
    struct wall_piece p = {.a = a, .b = b, .ra = ra, .rb = rb};
    /* asinh(b/d) - asinh(a/d); (r + y)(r - y) = d^2 gives the form that keeps the digits */
    p.J0 = log(a > 0.0   ? (b + rb) / (a + ra)
               : b < 0.0 ? (ra - a) / (rb - b)
                         : (b + rb) * (ra - a) / d2);
    p.angle = atan2(d * (b - a), d2 + a * b);
    p.J1 = (b * rb - a * ra + d2 * p.J0) / 2.0;
    p.J3 = (b * rb * rb2 - a * ra * ra2 + 3.0 * d2 * p.J1) / 4.0;
    p.J5 = (b * rb * rb2 * rb2 - a * ra * ra2 * ra2 + 5.0 * d2 * p.J3) / 6.0;
    p.Y1 = b - a;
    p.Y3 = (b * b2 - a * a2) / 3.0;
    p.Y5 = (b * b2 * b2 - a * a2 * a2) / 5.0;
    return p;
}

/* Integral of W = 7/pi (1 - 10 r^2 + 20 r^3 - 15 r^4 + 4 r^5) along the piece; d2 = d^2. */
static inline double wall_weight(const struct wall_piece *p, double d2)
{
    return 7.0 / M_PI *
           (p->Y1 - 10.0 * (d2 * p->Y1 + p->Y3) + 20.0 * p->J3 -
            15.0 * (d2 * d2 * p->Y1 + 2.0 * d2 * p->Y3 + p->Y5) + 4.0 * p->J5);
}

/* Integral of W s ds from r to 1, whose derivative along y is -W y. */
static inline double wall_ring(double r)
{
    const double r2 = r * r;
    return 7.0 / M_PI *
           (1.0 / 14.0 + r2 * (-0.5 + r2 * (2.5 + r * (-4.0 + r * (2.5 - r * 4.0 / 7.0)))));
}

/* [4.56-4.58]: the polynomial part at y; the exponents of the first bracket are illegible in print
 * and were rebuilt from the integral. */
static inline double wall_shepard(double y, double r, double d)
{
    const double d2 = d * d, y2 = y * y, r2 = r * r;
    const double radial = r * (8.0 * r2 * r2 + (10.0 * d2 + 84.0) * r2 + d2 * (15.0 * d2 + 126.0));
    const double plain = 42.0 * y2 * y2 + (140.0 * d2 + 70.0) * y2 + 210.0 * d2 * (d2 + 1.0) - 42.0;
    return d * y * (radial - plain);
}

/* Of a straight wall whose line is at `distance' from x (> 0 on the fluid's side) and that goes
 * from `from' to `to' along it, counted from the foot of x. All 0 beyond the support. */
static inline struct wall_moments wall_moments(double distance, double from, double to)
{
    const double d = fmax(fabs(distance), 1e-12);
    if (d >= 1.0)
        return (struct wall_moments){0};
    const double half = sqrt(1.0 - d * d), a = fmax(from, -half), b = fmin(to, half);
    if (b <= a)
        return (struct wall_moments){0};
    const struct wall_piece p = wall_piece(d, a, b);
    const double d2 = d * d, W = wall_weight(&p, d2);
    const double gamma = (d * d2 * d2 * (15.0 * d2 + 126.0) * p.J0 - 6.0 * p.angle +
                          wall_shepard(b, p.rb, d) - wall_shepard(a, p.ra, d)) /
                         (12.0 * M_PI);
    if (!(W > 0.0)) /* of the last digits, at the edge of the support */
        return (struct wall_moments){.gamma = distance >= -1e-9 ? gamma : -gamma};
    return (struct wall_moments){.gamma = distance >= -1e-9 ? gamma : -gamma,
                                 .W = W,
                                 .along = (wall_ring(p.ra) - wall_ring(p.rb)) / W};
}

#endif

/* second_order.h - what waves of a sum bind to themselves: of each pair a1, a2 a wave of the sum of
 * their phases and one of the difference, of amplitudes that grow as a1 a2. From the conditions at
 * the still level, phase th1 + s th2 (s = +-1, th = k.x - w t), vectors k1, k2, K = |k1 + s k2|,
 * W = w1 + s w2, T = tanh Kh, first order phi = (g a/w) cosh k(z+h)/cosh kh sin th:
 *   W eta2 - K T phi2 = P = [s g k2^2/w2 + g k1^2/w1 + (k1.k2)(g/w2 + s g/w1)]/2,
 *   g eta2 - W phi2   = R = [w1^2 + w2^2 + s w1 w2 - g^2 (k1.k2)/(w1 w2)]/2
 * (Longuet-Higgins & Stewart, J. Fluid Mech. 12, 1962, in another form). A sum over all ordered
 * pairs, halved. Pairs of many components: by cubic interpolation between some frequencies, so
 * that the cost of a place does not grow with the square of their number.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SECOND_ORDER_H
#define COMMON_SECOND_ORDER_H

#include <stdbool.h>

#include "wave_table.h"

struct wave_component;

/* A bound wave per a1 a2: the level is eta cos; at z = 0 the velocity is u cos along K and w sin
 * upwards; phi = u/K. */
struct bound_wave {
    double eta, u, w;
    double K, W; /* 1/m (|k1 + s k2|), 1/s */
};
/* The bound wave of two components of wave vectors k1, k2, 1/m, and angular frequencies w1, w2,
 * rad/s; s = 1: of the sum, -1: of the difference. Not for a wave and itself with s = -1, which is
 * a mean. */
struct bound_wave bound_wave_of(const double k1[2], const double k2[2], double w1, double w2, int s,
                                double g, double depth);
/* Second harmonic of a wave over the first, k a (3 - t^2)/(4 t^3), t = tanh kh. */
double bound_wave_stokes(double a, double k, double depth);

struct second_order;
/* For n waves along a line (`of' is borrowed). nodes: heights, m, of the WAVE_NODES of a flat
 * table. mean: with the mean level and return current below a wave group, else without. Owned by
 * the caller. */
struct second_order *second_order_create(int n, const struct wave_component *of, double g,
                                         double depth, const double *nodes, bool mean);
/* Adds to the levels eta[n], m, and to the velocities u[n][WAVE_NODES][2] (along, up), m/s, of n
 * columns that stand gap, m, apart from x, m, on, at time t, s. */
void second_order_add(struct second_order *s, double t, double x, double gap, int n, double *eta,
                      double *u);
/* Number of frequencies between which pairs are interpolated; multiplications that one column
 * costs. */
int second_order_frequencies(const struct second_order *s);
double second_order_products(const struct second_order *s);

#endif

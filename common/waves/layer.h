/* layer.h - the velocity potential between the surface of water and a level or the bed, from its
 * values on the surface: Laplace's equation under z = eta + sigma D, -1 <= sigma <= 0, where D is
 * the height of the layer at rest plus eta,
 *   [lap f + 2 grad sigma.grad f_s + (|grad sigma|^2 + 1/D^2) f_ss + lap sigma f_s] (D/a)^2 = 0,
 * f(x, y, sigma) the potential, f = phi_s on the surface, and at the lower end
 *   (f_s/D - K f) D/a = 0, K = k tanh k(h - a) of each mode, over a level bed at depth h.
 * Modes along x and y, Chebyshev's points along sigma; GMRES, preconditioned by the operator of a
 * flat surface over a level bed mode by mode (Engsig-Karup, Bingham & Lindberg, J. Comput. Phys.
 * 228, 2009, with other discretisations). SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_LAYER_H
#define COMMON_LAYER_H

#include <stdbool.h>

#include "wave_grid.h"

/* The layer and its last solution. Fields are [cells][rows]: a column holds `nodes' values, the
 * surface first, then zeros up to `rows'. */
struct sigma_layer {
    const struct wave_grid *grid; /* borrowed */
    int nodes, rows;
    double a;               /* m: height at rest */
    double *sigma;          /* [nodes] from 0 to -1 */
    double *phi, *phi_x[2]; /* m^2/s, m/s: of the last solution, at constant sigma */
    double *phi_s;          /* m^2/s: its derivative along sigma */
    /* Of the shape, [cells]: height, gradient and Laplacian of the surface. */
    double *D, *eta_x[2], *eta_xx;
    struct layer_solver *solver; /* owned */
};

/* Over a level bed at `depth', m: the layer reaches a, m, below the still level, a <= depth, and
 * has `nodes' points along sigma. grid is borrowed. Owned by the caller. */
struct sigma_layer *layer_create(const struct wave_grid *grid, double depth, double a, int nodes);
/* The height at rest, m, that suits waves of wave number k, 1/m, and the amplitude, m, over that
 * depth, m. */
double layer_height(double k, double amplitude, double depth);
/* Sets the surface to eta[cells], m, with all that follows from it; before layer_solve. */
void layer_shape(struct sigma_layer *l, const double *eta);
/* Solves for the potential whose values on the surface are phi_s[cells], m^2/s, until the residual
 * is `tolerance' times their norm. warm: starts from the last solution. Returns the
 * number of products with the operator, -1: it did not converge. */
int layer_solve(struct sigma_layer *l, const double *phi_s, double tolerance, bool warm);
/* Vertical velocity W on the surface at a cell, m/s, of the last solution. */
double layer_rise(const struct sigma_layer *l, int cell);
/* W of small waves of the wave number k over its exact value k tanh kh phi_s: 1 but for the error
 * of few nodes. */
double layer_flat_rise(const struct sigma_layer *l, double k);
/* Velocities along x, upwards and along y at the nodes of a cell, m/s, [nodes] each; y may be
 * NULL. */
void layer_velocity(const struct sigma_layer *l, int cell, double *x, double *up, double *y);

#endif

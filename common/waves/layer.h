/* layer.h - the velocity potential between the surface of water and a level or the bed, from its
 * values on the surface: Laplace's equation under z = eta + sigma D, -1 <= sigma <= 0, where D is
 * the height of the layer at rest plus eta,
 *   [lap f + 2 grad sigma.grad f_s + (|grad sigma|^2 + 1/D^2) f_ss + lap sigma f_s] (D/a)^2 = 0,
 * f(x, y, sigma) the potential, f = phi_s on the surface, and at the lower end either
 *   (f_s/D - K f) D/a = 0, K = k tanh k(h - a) of each mode (over a level bed at depth h), or
 *   (f_s/D + grad h.(f_x + sigma_x f_s)) D/a = 0 (on an uneven bed at depth h(x, y)).
 * Modes along x and y, Chebyshev's points along sigma; GMRES, preconditioned by the operator of a
 * flat surface over a level bed mode by mode (Engsig-Karup, Bingham & Lindberg, J. Comput. Phys.
 * 228, 2009, with other discretisations). SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_LAYER_H
#define COMMON_LAYER_H

#include <stdbool.h>

#include "wave_grid.h"

/* Columns hold nodes values, surface first, then zeros up to `rows'. Fields of [cells][rows]. */
struct sigma_layer {
    const struct wave_grid *grid; /* borrowed */
    int nodes, rows;
    double a;               /* m: height at rest, the largest over an uneven bed */
    double *sigma;          /* [nodes] from 0 to -1 */
    double *phi, *phi_x[2]; /* m^2/s, m/s: of the last solution, at constant sigma */
    double *phi_s;          /* m^2/s: its derivative along sigma */
    /* Of the shape, [cells]: height, gradient and Laplacian of the surface, of the bed's depth. */
    double *D, *eta_x[2], *eta_xx, *h, *h_x[2], *h_xx;
    bool uneven;
    struct layer_solver *solver; /* owned */
};

/* Over water of `depth' m down to `a' m below the still level, a <= depth; nodes along sigma. grid
 * is borrowed. */
struct sigma_layer *layer_create(const struct wave_grid *grid, double depth, double a, int nodes);
/* On a bed h[cells] m below the still level, periodic and smooth; copied. */
struct sigma_layer *layer_create_over(const struct wave_grid *grid, const double *h, int nodes);
void layer_free(struct sigma_layer **l);
/* m: the height at rest that suits waves of the number k and the amplitude over depth. */
double layer_height(double k, double amplitude, double depth);
/* Sets the surface eta[cells], m. */
void layer_shape(struct sigma_layer *l, const double *eta);
/* The potential whose values on the surface are phi_s[cells], m^2/s, until the residual is
 * `tolerance' of them; warm: starts from the last solution. flux[cells]: what the lower end gives
 * instead of 0, m/s; NULL: 0. Products with the operator, -1: it did not converge. */
int layer_solve(struct sigma_layer *l, const double *phi_s, const double *flux, double tolerance,
                bool warm);
/* m/s: w on the surface at a cell. */
double layer_rise(const struct sigma_layer *l, int cell);
/* -: what W of small waves of the number k is over k tanh kh: 1 but for what few nodes leave out.
 */
double layer_flat_rise(const struct sigma_layer *l, double k);
/* Velocities along x, up and along y at the nodes of a cell, [nodes] each; y may be NULL. */
void layer_velocity(const struct sigma_layer *l, int cell, double *x, double *up, double *y);

#endif

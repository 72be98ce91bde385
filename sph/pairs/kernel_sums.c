/* kernel_sums.c - the Shepard sum S_i = sum_j w_j W(x_i - x_j), with the particle itself (j = i). S
 * is 1 in a support that is full, up to the quadrature's error; at a free surface it falls to about
 * 1/2. kernel_lattice_sum is what a cubic lattice of spacing dx has, the value that "full" is
 * compared with.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "kernel_sums.h"

#include "kernel.h"
#include "neighbours.h"

/* The list holds no pair (i, i), so that the sum begins with the particle's own w_i W(0). Listed
 * neighbours beyond R contribute zeros. */
double kernel_sum(const struct sph *s, int i)
{
    const int dim = s->dim, *j = s->list->j + s->list->start[i];
    const double *x = prim_line(&s->p, i);
    double sum = x[at_volume(dim)] * kernel_w0(dim, s->R);
    for (int k = 0; k < s->list->count[i]; k++) {
        const double *q = prim_line(&s->p, j[k]);
        const double r2 = vec_distance2(dim, q, x);
        sum += q[at_volume(dim)] * kernel_w(dim, sqrt(r2), s->R);
    }
    return sum;
}

/* Sum of dx^D W over a lattice about one of its points, or of dx^D x_1^2 (-W'/r). Its points within
 * R lie in [-n, n]^dim; the corners of that cube get 0. */
static double over_lattice(const struct sph *s, bool moment)
{
    const int n = (int)(s->R / s->dx) + 1, deep = s->dim == 3 ? n : 0;
    double sum = 0.0;
    for (int k = -deep; k <= deep; k++)
        for (int j = -n; j <= n; j++)
            for (int i = -n; i <= n; i++) {
                const double x = s->dx * i, r = s->dx * sqrt(i * i + j * j + k * k);
                sum += moment ? -x * x * kernel_dw_r(s->dim, r, s->R) : kernel_w(s->dim, r, s->R);
            }
    return sum * s->dxD;
}

double kernel_lattice_sum(const struct sph *s) { return over_lattice(s, false); }

double kernel_pair_viscosity(const struct sph *s)
{
    return s->nu > 0.0 ? s->rho0 * s->nu / over_lattice(s, true) : 0.0;
}

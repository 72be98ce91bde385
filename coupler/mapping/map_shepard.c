/* map_shepard.c - Shepard and moving least squares sums on particles (Chiron 2017, 6.3), in the
 * order of their global number. SPDX-License-Identifier: BSD-3-Clause */
#include "map.h"

#include <math.h>
#include <stdbool.h>

#include "near.h"

static const double least_weight = 1e-6; /* sum w W below which nothing is there */
static const double worst_condition = 1e6;

/* Wendland's C2 kernel of the support R; q = r/R. */
double map_kernel(int dim, double q, double R)
{
    const double c = dim == 2 ? 7.0 / (M_PI * R * R) : 21.0 / (2.0 * M_PI * R * R * R);
    const double a = 1.0 - q, a2 = a * a;
    return q < 1.0 ? c * a2 * a2 * (1.0 + 4.0 * q) : 0.0;
}

/* a[n][n] -> its inverse (Gauss-Jordan with pivots on the diagonal: a is symmetric positive); the
 * condition number in the 1-norm, INFINITY if singular. */
static double invert(int n, double a[4][4])
{
    double norm = 0.0, inverse = 0.0;
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < n; k++) {
            double column = 0.0;
            for (int i = 0; i < n; i++)
                column += fabs(a[i][k]);
            if (pass == 0)
                norm = fmax(norm, column);
            else
                inverse = fmax(inverse, column);
        }
        for (int k = 0; k < n && pass == 0; k++) {
            const double p = a[k][k];
            if (!(p > 1e-14 * norm))
                return INFINITY;
            a[k][k] = 1.0;
            for (int j = 0; j < n; j++)
                a[k][j] /= p;
            for (int i = 0; i < n; i++) {
                if (i == k)
                    continue;
                const double f = a[i][k];
                a[i][k] = 0.0;
                for (int j = 0; j < n; j++)
                    a[i][j] -= f * a[k][j];
            }
        }
    }
    return norm * inverse;
}

/* First row of the inverse moment matrix sum w W p p^T / sum w W: the value at the target is row .
 * sum w W p f. False where Shepard must do. Scaled by R, so that the moments are of one order and
 * the condition number means the same at any resolution. Its limit worst_condition: targets at the
 * edge of the cloud, whose sources lie all on one side, extrapolate. */
static bool mls_row(int dim, double R, const struct reach *r, const struct map_cloud *c,
                    const double *x, double row[4])
{
    double a[4][4] = {{0}};
    if (r->n < 2 * (dim + 1))
        return false;
    double total = 0.0;
    for (int k = 0; k < r->n; k++) {
        const long j = r->j[k];
        double p[4] = {1.0}, r2 = 0.0;
        for (int d = 0; d < dim; d++) {
            p[d + 1] = (c->x[j * dim + d] - x[d]) / R;
            r2 += p[d + 1] * p[d + 1];
        }
        const double w = c->volume[j] * map_kernel(dim, sqrt(r2), R);
        total += w;
        for (int m = 0; m <= dim; m++)
            for (int n = 0; n <= dim; n++)
                a[m][n] += w * p[m] * p[n];
    }
    for (int m = 0; m <= dim; m++)
        for (int n = 0; n <= dim; n++)
            a[m][n] /= total;
    if (!(invert(dim + 1, a) < worst_condition))
        return false;
    for (int m = 0; m <= dim; m++)
        row[m] = a[0][m];
    return true;
}

/* One target; false: nothing there. mls: v = sum_j w_j W_j (row_0 + row . (x_j - x)/R) f_j / sum w
 * W; Shepard: row = (1, 0, 0, 0). */
static bool map_one(int dim, double R, int ncomp, bool mls, const struct reach *r,
                    const struct map_cloud *c, const double *x, double *v)
{
    double total = 0.0, row[4] = {1.0};
    for (int a = 0; a < ncomp; a++)
        v[a] = 0.0;
    const bool linear = mls && mls_row(dim, R, r, c, x, row);
    for (int k = 0; k < r->n; k++) {
        const long j = r->j[k];
        double r2 = 0.0, slope = 0.0;
        for (int d = 0; d < dim; d++) {
            const double p = (c->x[j * dim + d] - x[d]) / R;
            r2 += p * p;
            slope += row[d + 1] * p;
        }
        const double w = c->volume[j] * map_kernel(dim, sqrt(r2), R);
        total += w;
        const double weight = linear ? w * (row[0] + slope) : w;
        for (int a = 0; a < ncomp; a++)
            v[a] += weight * c->v[j * ncomp + a];
    }
    for (int a = 0; a < ncomp; a++)
        v[a] = total < least_weight ? 0.0 : v[a] / total;
    return !(total < least_weight);
}

/* Of no source the sum is 0, and that is its value. */
static bool sum_one(int dim, double R, int ncomp, const struct reach *r, const struct map_cloud *c,
                    const double *x, double *v)
{
    for (int a = 0; a < ncomp; a++)
        v[a] = 0.0;
    for (int k = 0; k < r->n; k++) {
        const long j = r->j[k];
        double r2 = 0.0;
        for (int d = 0; d < dim; d++)
            r2 += (c->x[j * dim + d] - x[d]) * (c->x[j * dim + d] - x[d]);
        const double w = c->volume[j] * map_kernel(dim, sqrt(r2) / R, R);
        for (int a = 0; a < ncomp; a++)
            v[a] += w * c->v[j * ncomp + a];
    }
    return true;
}

/* The same sums as weights of the sources. Divided by what they really add up to: a transposed
 * mapping keeps sums to rounding, also where the moments of mls_row are badly conditioned. */
bool map_weights(int dim, double R, bool mls, const struct reach *r, const struct map_cloud *c,
                 const double *x, double *w)
{
    double total = 0.0, row[4] = {1.0};
    const bool linear = mls && mls_row(dim, R, r, c, x, row);
    for (int k = 0; k < r->n; k++) {
        const long j = r->j[k];
        double r2 = 0.0, slope = row[0];
        for (int d = 0; d < dim; d++) {
            const double p = (c->x[j * dim + d] - x[d]) / R;
            r2 += p * p;
            slope += row[d + 1] * p;
        }
        w[k] = c->volume[j] * map_kernel(dim, sqrt(r2), R) * (linear ? slope : 1.0);
        total += w[k];
    }
    for (int k = 0; k < r->n; k++)
        w[k] = total > 0.0 ? w[k] / total : 0.0;
    return total > 0.0;
}

static bool shepard_one(int dim, double R, int ncomp, const struct reach *r,
                        const struct map_cloud *c, const double *x, double *v)
{
    return map_one(dim, R, ncomp, false, r, c, x, v);
}

static bool mls_one(int dim, double R, int ncomp, const struct reach *r, const struct map_cloud *c,
                    const double *x, double *v)
{
    return map_one(dim, R, ncomp, true, r, c, x, v);
}

void map_shepard(int dim, double R, int ncomp, struct map_cloud *from, long ntarget,
                 const double *x, double *v, unsigned char *mask)
{
    near_map(shepard_one, dim, R, ncomp, from, ntarget, x, v, mask);
}

void map_mls(int dim, double R, int ncomp, struct map_cloud *from, long ntarget, const double *x,
             double *v, unsigned char *mask)
{
    near_map(mls_one, dim, R, ncomp, from, ntarget, x, v, mask);
}

void map_sum(int dim, double R, int ncomp, struct map_cloud *from, long ntarget, const double *x,
             double *v, unsigned char *mask)
{
    near_map(sum_one, dim, R, ncomp, from, ntarget, x, v, mask);
}

/* newton_vector.c - sums over vectors for GMRES, whose orthogonalisation is most of the work where
 * it takes many vectors: in lanes, for SUNDIALS' own are compiled to add one number after the
 * other, and with one reduction for all products of a vector. SPDX-License-Identifier: BSD-3-Clause
 */
#include "newton.h"

enum { PART = 1024 };

static int64_t part_of(int64_t n, int64_t from) { return n - from < PART ? n - from : PART; }

/* d[k] = x . y[k]; part by part, so that x is read from memory once. */
static int dot_many(int count, N_Vector xv, N_Vector *y, realtype *d)
{
    const double *x = N_VGetArrayPointer(xv);
    const int64_t n = NV_LOCLENGTH_P(xv);
    for (int k = 0; k < count; k++)
        d[k] = 0.0;
    for (int64_t i = 0; i < n; i += PART)
        for (int k = 0; k < count; k++)
            d[k] += lanes_dot_any(x + i, N_VGetArrayPointer(y[k]) + i, part_of(n, i));
    MPI_Allreduce(MPI_IN_PLACE, d, count, MPI_DOUBLE, MPI_SUM, NV_COMM_P(xv));
    return 0;
}

static realtype dot(N_Vector x, N_Vector y)
{
    double d;
    dot_many(1, x, &y, &d);
    return d;
}

static void add_part(double c, const double *restrict x, int64_t n, double *restrict sum)
{
    for (int64_t i = 0; i < n; i++)
        sum[i] += c * x[i];
}

/* z = sum of c[k] x[k]; z may be one of them. */
static int combine(int count, realtype *c, N_Vector *x, N_Vector zv)
{
    double *z = N_VGetArrayPointer(zv), sum[PART];
    const int64_t n = NV_LOCLENGTH_P(zv);
    for (int64_t i = 0; i < n; i += PART) {
        const int64_t m = part_of(n, i);
        for (int64_t l = 0; l < m; l++)
            sum[l] = 0.0;
        for (int k = 0; k < count; k++)
            add_part(c[k], N_VGetArrayPointer(x[k]) + i, m, sum);
        for (int64_t l = 0; l < m; l++)
            z[i + l] = sum[l];
    }
    return 0;
}

void newton_vector_sums(N_Vector q)
{
    q->ops->nvdotprod = dot;
    q->ops->nvdotprodmulti = dot_many;
    q->ops->nvlinearcombination = combine;
}

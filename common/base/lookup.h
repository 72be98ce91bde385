/* lookup.h - the place of a number in a table whose rows ascend; their order.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/* The last of n rows whose first number, rows[stride k], is not above x; 0 if there is none. By
 * bisection. With one row less than the table has, rows k and k + 1 have x between them. */
static inline int lookup_row(const double *rows, int stride, int n, double x)
{
    int low = 0, high = n;
    while (high - low > 1) {
        const int mid = (low + high) / 2;
        *(rows[stride * mid] <= x ? &low : &high) = mid;
    }
    return low;
}

/* Linear between the n >= 2 rows (x, y) of a table; 0 outside of it. */
static inline double lookup_linear(const double (*rows)[2], int n, double x)
{
    if (!(x > rows[0][0] && x < rows[n - 1][0]))
        return 0.0;
    const double(*at)[2] = rows + lookup_row(rows[0], 2, n - 1, x);
    return at[0][1] + (x - at[0][0]) / (at[1][0] - at[0][0]) * (at[1][1] - at[0][1]);
}

/* For qsort of numbers (double), the least first. */
static inline int lookup_ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* fit_file.c - see fit_file.h. SPDX-License-Identifier: BSD-3-Clause */
#include "fit_file.h"

void fit_restart(void *owner, struct fit *samples, struct h5 *f)
{
    int64_t n = samples->n;
    double *rows = h5_writes(f) ? NEW(double, 2 * n) : h5_read_all_real(f, "signal", 2, &n);
    for (int64_t k = 0; rows && k < n; k++)
        if (h5_writes(f)) {
            rows[2 * k] = samples->t[k];
            rows[2 * k + 1] = samples->v[k];
        } else
            fit_add(owner, samples, rows[2 * k], rows[2 * k + 1]);
    if (h5_writes(f) && n > 0)
        (void)h5_keep_rows(f, "signal", "s, -", n, 2, rows);
    mem_free(rows);
}

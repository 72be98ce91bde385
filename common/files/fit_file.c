/* fit_file.c - see fit_file.h. SPDX-License-Identifier: BSD-3-Clause */
#include "fit_file.h"

void fit_save(const struct fit *samples, struct h5 *f, bool first)
{
    if (samples->n == 0)
        return;
    double *rows = NEW(double, 2 * (size_t)samples->n);
    for (int k = 0; k < samples->n; k++) {
        rows[2 * k] = samples->t[k];
        rows[2 * k + 1] = samples->v[k];
    }
    h5_write_real(f, "signal", "s, -", first ? samples->n : 0, 2, rows, false);
    mem_free(rows);
}

void fit_load(void *owner, struct fit *samples, struct h5 *f)
{
    int64_t n;
    double *rows = h5_read_all_real(f, "signal", 2, &n);
    for (int64_t k = 0; rows && k < n; k++)
        fit_add(owner, samples, rows[2 * k], rows[2 * k + 1]);
    mem_free(rows);
}

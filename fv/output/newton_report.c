/* newton_report.c - columns of the series and entries of the summary that Newton's method adds.
 * Counts are since the start, rates in the summary per step; V-cycles of this process alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../time/fv_time.h"
#include "output.h"

int newton_columns(const struct fv_params *prm, const char **columns)
{
    static const char *const names[] = {"residual [-]", "pseudo step [s]", "newton iterations [-]",
                                        "krylov vectors [-]"};
    if (prm->integrator != INTEGRATOR_NEWTON)
        return 0;
    for (int k = 0; k < 4; k++)
        columns[k] = names[k];
    return 4;
}

int newton_values(const struct newton *w, double *values)
{
    if (!w)
        return 0;
    values[0] = w->norm;
    values[1] = w->dtau;
    values[2] = (double)w->newtons;
    values[3] = (double)w->krylovs;
    return 4;
}

void newton_summarise(const struct newton *w, double steps, double all, struct summary *to)
{
    const double newtons = w->newtons > 0 ? (double)w->newtons : 1.0;
    summary_real(to, "newton_iterations", (double)w->newtons / all);
    summary_real(to, "krylov_per_newton", (double)w->krylovs / newtons);
    summary_real(to, "v_cycles", (double)w->cycles / steps);
    summary_int(to, "halved_steps", w->halvings);
    summary_real(to, "newton_residual", w->norm);
}

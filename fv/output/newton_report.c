/* newton_report.c - columns of the series and entries of the summary that Newton's method adds.
 * Counts are since the start, rates in the summary per step; V-cycles of this process alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../time/fv_time.h"
#include "output.h"

void newton_row(const struct newton *w, struct figures *to)
{
    FIGURE(to, w->norm, "residual [-]");
    FIGURE(to, w->dtau, "pseudo step [s]");
    FIGURE(to, (double)w->newtons, "newton iterations [-]");
    FIGURE(to, (double)w->krylovs, "krylov vectors [-]");
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

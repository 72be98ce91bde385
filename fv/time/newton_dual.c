/* newton_dual.c - dual time stepping (Jameson, AIAA 91-1596, 1991; Chiron 2017, 6.1): each implicit
 * step is the steady state, in a pseudo time, of a fluid of artificial compressibility (Chorin,
 * J. Comput. Phys. 2, 1967), whose sound speed is beta:
 *   dp/dtau + beta^2 R_p = 0,   du/dtau + R_u = 0,   R of newton_residual.c.
 * Fluxes hold the pressure's dissipation d = 1/(c0 + what flows and diffuses through a cell a
 * second), so a pseudo step is C d long, C = fv.pseudo_cfl, in each cell its own, and
 * beta^2 = 16/(9 d^2 l), l the diagonal of -Lap there: on square cells sound needs 1.5 d for one.
 * Then the odd-even mode of p decays at 2 l beta^2 d = 3.6/d, about as friction beside walls does
 * at most (3.9/d). Two stages of Runge and Kutta are stable up to 2/(C d), so C is 0.5.
 *
 * A pseudo step is a map of q whose fixed point is the solution. KINSOL repeats it, and combines
 * the last ones by Anderson's acceleration (Walker & Ni, SIAM J. Numer. Anal. 49, 2011); without
 * memory it is the plain scheme. SPDX-License-Identifier: BSD-3-Clause */
#include "newton.h"

#include <kinsol/kinsol.h>

#include "../surface/fv_surface.h"

enum { STAGES = 2 };
#define SLOWNESS (9.0 / 16.0) /* 1/(beta^2 d^2 l) */

/* Pseudo steps in which the lowest residual must fall by a tenth: five such falls are not worth the
 * steps, while Anderson's residual may go up for long on its way. */
static int64_t stall(const struct fv *s) { return 1 + s->prm.pseudo_steps / 5; }

/* next = q after a pseudo step. A q whose residual is small stays: KINSOL ends there. */
static int pseudo_step(N_Vector q, N_Vector next, void *user)
{
    struct fv *s = user;
    struct newton *w = s->newton;
    newton_residual(q, w->residual, s);
    N_VProd(w->residual, w->fscale, next);
    w->norm = isfinite(N_VL1Norm(next)) ? N_VMaxNorm(next) : INFINITY; /* which passes over NaN */
    N_VScale(1.0, q, next);
    if (newton_stalls(w, stall(s)) || !isfinite(w->norm))
        return -1;
    if (w->norm <= s->prm.tol_newton)
        return 0;
    for (int k = 0; k < STAGES; k++) {
        if (k > 0)
            newton_residual(next, w->residual, s);
        N_VProd(w->residual, w->pseudo, w->residual);
        N_VLinearSum(1.0, q, -1.0 / (STAGES - k), w->residual, next);
    }
    return 0;
}

void newton_dual_create(struct fv *s, struct newton *w)
{
    w->pseudo = N_VClone(w->q);
    w->kin = KINCreate(w->ctx);
    if (!w->kin || KINSetMAA(w->kin, s->prm.pseudo_memory) < 0 ||
        KINInit(w->kin, pseudo_step, w->q) < 0 || KINSetUserData(w->kin, s) < 0 ||
        KINSetErrHandlerFn(w->kin, newton_no_message, NULL) < 0 ||
        KINSetNumMaxIters(w->kin, s->prm.pseudo_steps) < 0 || KINSetFuncNormTol(w->kin, 1e-300) < 0)
        abort_run("SUNDIALS cannot be set up");
}

/* The diagonal of -Lap in each cell; the pressure of a surface acts over less than a step. */
static const double *laplacian(const struct fv *s)
{
    double *all = s->newton->div;
    s->newton->cells_of->laplacian(s, all);
    for (int a = 0; s->surface && a < s->dim; a++)
        for (int64_t i = 0; i < s->surface->ncut[a]; i++) {
            const struct cut *x = s->surface->cut[a] + i;
            all[x->wet] += (1.0 / x->theta - 1.0) / (x->step * x->size);
        }
    return all;
}

/* d stands in the scales of the residuals, d/U. A physical compressibility (fv.c0) takes part in
 * the pseudo step implicitly. */
static void set_pseudo_step(const struct fv *s)
{
    const struct newton *w = s->newton;
    const double sound = s->prm.c0 > 0.0 ? 1.0 / (s->prm.c0 * s->prm.c0) : 0.0;
    const double *f = N_VGetArrayPointer(w->fscale) + w->cells, *lap = laplacian(s);
    double *step = N_VGetArrayPointer(w->pseudo);
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++, step++, f++) {
            const double d = w->of.U * *f, tau = s->prm.pseudo_cfl * d;
            step[0] = 1.0 / (SLOWNESS * lap[i] * d * d / tau + sound * w->of.c0);
            for (int a = 1; a <= s->dim; a++)
                step[a * w->cells] = tau;
        }
}

int newton_dual_solve(struct fv *s)
{
    struct newton *w = s->newton;
    set_pseudo_step(s);
    w->best = 0.0;
    w->best_at = w->pseudo_steps = 0;
    const int code = KINSol(w->kin, w->q, KIN_FP, w->uscale, w->fscale);
    if (w->norm <= s->prm.tol_newton)
        return code;
    if (!(w->norm < 10.0 * w->best)) /* grew: the state before is one that can be described */
        N_VScale(1.0, w->q1, w->q);
    return KIN_MAXITER_REACHED;
}

void newton_dual_explain(const struct fv *s, char *text, size_t size)
{
    const struct newton *w = s->newton;
    snprintf(text, size,
             "the last %d pseudo steps came to %.3g at number %d: fv.pseudo_cfl below %g, "
             "fv.pseudo_steps above %d, a shorter step (fv.cfl), or Newton's method, "
             "fv.dual_time = false",
             (int)w->pseudo_steps, w->best, (int)w->best_at, s->prm.pseudo_cfl,
             s->prm.pseudo_steps);
}

/* newton.c - implicit steps by KINSOL: Newton with line search, GMRES with newton_precond.c. A step
 * that does not converge is halved; a steady state is marched to in pseudo-time, one Newton
 * iteration a step, whose size grows as the residual falls (switched evolution relaxation, Mulder &
 * van Leer 1985). SPDX-License-Identifier: BSD-3-Clause */
#include "newton.h"

#include <kinsol/kinsol.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "../boundary/fv_boundary.h"
#include "moving.h"
#include "stages.h"

enum {
    KRYLOV = 200,
    NEWTONS = 12,
    HALVINGS = 6,
    PSEUDO_STEPS = 500,
    PSEUDO_FAILURES = 12,
    STALL = 150 /* pseudo steps without a lower residual */
};

/* SUNDIALS' codes below zero are faults of the call, not of the numerics. */
#define SUN(call)                                                                                  \
    do {                                                                                           \
        const int code_ = (int)(call);                                                             \
        if (code_ < 0)                                                                             \
            abort_run("%s: SUNDIALS code %d", #call, code_);                                       \
    } while (0)

static void start(struct fv *s, const char *timer) { timer_start(&s->run->timers, timer); }
static void stop(struct fv *s, const char *timer) { timer_stop(&s->run->timers, timer); }

void newton_no_message(int code, const char *module, const char *function, char *text, void *user)
{
    (void)code, (void)module, (void)function, (void)text, (void)user;
}

/* Preconditioned from the right, GMRES bounds the true residual, which is what the steps' tolerance
 * is about. */
static void make_kinsol(struct fv *s, struct newton *w)
{
    w->krylov = SUNLinSol_SPGMR(w->q, SUN_PREC_RIGHT, KRYLOV, w->ctx);
    w->kin = KINCreate(w->ctx);
    if (!w->krylov || !w->kin)
        abort_run("SUNDIALS cannot be set up");
    SUN(SUNLinSol_SPGMRSetGSType(w->krylov, SUN_CLASSICAL_GS)); /* repeated where it must be */
    SUN(KINInit(w->kin, newton_residual, w->q));
    SUN(KINSetErrHandlerFn(w->kin, newton_no_message, NULL));
    SUN(KINSetUserData(w->kin, s));
    SUN(KINSetLinearSolver(w->kin, w->krylov, NULL));
    SUN(KINSetPreconditioner(w->kin, newton_precond_setup, newton_precond_solve));
    if (w->cells_of->evaluate_variation && !s->surface)
        SUN(KINSetJacTimesVecFn(w->kin, newton_jacobian_times));
    SUN(KINSetEtaForm(w->kin, s->prm.steady ? KIN_ETACONSTANT : KIN_ETACHOICE1));
    SUN(KINSetEtaConstValue(w->kin, 0.1));
    SUN(KINSetMaxSetupCalls(w->kin, 1));
    SUN(KINSetMaxNewtonStep(w->kin, 1e30)); /* by default a start from rest gets no step beyond 1 */
    SUN(KINSetScaledStepTol(w->kin, 1e-14));
    SUN(KINSetNoMinEps(w->kin, SUNFALSE));
}

/* Residual that leaves an error well below that of the cells. In time 1e-6 a step is, which adds up
 * over the steps; their own errors are (U dt/L)^3, so it falls with that in short steps. A
 * surface's terms are not smooth enough for less. A steady residual in cells' velocities, r, leaves
 * an error of up to r T U/h, T the time in which the flow forgets (50 L/U in a cavity at Re 1000);
 * with h^4 for the cells' error, r ~ h^5. */
static double tolerance(const struct fv *s, double all)
{
    if (s->prm.tol_newton > 0.0)
        return s->prm.tol_newton;
    const double side = pow(all, 1.0 / s->dim), step = s->prm.water ? 1.0 : s->prm.cfl / side;
    return s->prm.steady ? fmax(1e-11, fmin(1e-6, 32.0 * pow(side, -5.0)))
                         : fmax(1e-9, 1e-6 * fmin(1.0, pow(64.0 * step, 3.0)));
}

/* Of all ranks, so that all sweep alike: scratch of a row has that length. */
static int longest_row(const struct fv *s)
{
    int most = grid_longest(&s->grid);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, s->comm);
    return most;
}

static void close_libraries(void *p)
{
    struct newton *w = p;
    N_Vector const vectors[] = {w->q, w->q1, w->q2, w->uscale, w->fscale, w->residual, w->pseudo};
    KINFree(&w->kin);
    if (w->krylov)
        SUNLinSolFree(w->krylov);
    for (size_t k = 0; k < sizeof vectors / sizeof vectors[0]; k++)
        N_VDestroy(vectors[k]); /* NULL is let be */
    SUNContext_Free(&w->ctx);
}

/* Vectors hold cells that are stored without their ghosts, fields all of them: newton_pack and
 * newton_unpack go between the two. */
struct newton *newton_create(struct fv *s)
{
    struct newton *w = NEW(struct newton, 1);
    MPI_Comm comm = s->comm;
    int64_t all;
    w->cells_of = s->m ? &newton_blocks : &newton_even;
    w->longest = longest_row(s);
    w->longest_step = INFINITY;
    for (int q = 0; q < s->grid.nparts; q++)
        w->cells += (int64_t)s->grid.part[q].n[0] * s->grid.part[q].n[1] * s->grid.part[q].n[2];
    MPI_Allreduce(&w->cells, &all, 1, MPI_INT64_T, MPI_SUM, comm);
    s->prm.tol_newton = tolerance(s, (double)all);
    SUN(SUNContext_Create(&comm, &w->ctx));
    mem_at_free(w, close_libraries);
    w->q = N_VNew_Parallel(comm, (s->dim + 1) * w->cells, (s->dim + 1) * all, w->ctx);
    newton_vector_sums(w->q);
    N_Vector *const same[] = {&w->q1, &w->q2, &w->uscale, &w->fscale, &w->residual};
    for (size_t k = 0; k < sizeof same / sizeof same[0]; k++)
        N_VConst(0.0, *same[k] = N_VClone(w->q)); /* 0 times an older level must be 0 */
    double **const plain[] = {&w->v.p, &w->face, &w->dface, &w->phi, &w->div, &w->d};
    for (size_t k = 0; k < sizeof plain / sizeof plain[0]; k++)
        *plain[k] = NEW_IN(w, double, s->size);
    for (int a = 0; a < s->dim; a++) {
        double **const fields[] = {&w->v.u[a], &w->v.U[a], &w->v.G[a],
                                   &w->G[a],   &w->x[a],   &w->r[a]};
        for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++)
            *fields[k] = NEW_IN(w, double, s->size);
    }
    for (int e = 0; e <= 2 * s->dim; e++)
        w->A[e] = NEW_IN(w, double, s->size);
    if (s->prm.dual_time)
        newton_dual_create(s, w);
    else
        make_kinsol(s, w);
    return w;
}

/* Root mean square of the scaled residual. */
static double scaled_norm(const struct newton *w, N_Vector r) { return N_VWrmsNorm(r, w->fscale); }

/* KINSOL counts from each call's beginning. */
static void count(struct newton *w)
{
    long newtons = 0, krylovs = 0;
    KINGetNumNonlinSolvIters(w->kin, &newtons);
    KINGetNumLinIters(w->kin, &krylovs);
    w->newtons += newtons;
    w->krylovs += krylovs;
}

/* State and both levels before as vectors; start of the iteration by extrapolation. */
static void set_levels(struct fv *s, double dt, double dt_old)
{
    struct newton *w = s->newton;
    const double r = dt_old > 0.0 ? dt / dt_old : 0.0;
    N_VLinearSum(1.0 + r, w->q1, -r, w->q2, w->q);
    if (s->forcing) { /* what is imposed is part of the unknown vector, too */
        newton_unpack(s, w->q, s->p, s->u);
        forcing_velocity(s, w->of.t, s->u);
        newton_pack(s, s->p, s->u, w->q);
    }
}

/* KINSOL stops without an error, too, where its steps become nothing: that is converged only where
 * the residual says so, or is what rounding leaves. */
static bool is_small(const struct fv *s)
{
    const struct newton *w = s->newton;
    N_Vector scaled = w->uscale; /* set anew before the next solve */
    N_VProd(w->residual, w->fscale, scaled);
    return N_VMaxNorm(scaled) <= fmax(10.0 * s->prm.tol_newton, 1e-9);
}

/* Solves R(q) = 0; false: not converged, on all ranks alike. */
static bool solve(struct fv *s)
{
    struct newton *w = s->newton;
    int code = 0;
    if (s->prm.dual_time)
        code = newton_dual_solve(s);
    else {
        SUN(KINSetNumMaxIters(w->kin, NEWTONS));
        SUN(KINSetFuncNormTol(w->kin, s->prm.tol_newton));
        code = KINSol(w->kin, w->q, KIN_LINESEARCH, w->uscale, w->fscale);
    }
    count(w);
    newton_residual(w->q, w->residual, s); /* leaves u, p, U and ghosts of this q */
    w->norm = scaled_norm(w, w->residual);
    return code == KIN_SUCCESS || code == KIN_INITIAL_GUESS_OK ||
           (code == KIN_STEP_LT_STPTOL && is_small(s)) || N_VMaxNorm(w->residual) == 0.0;
}

/* Place in the fields of a cell of the packed vectors. */
static int64_t cell_of(const struct fv *s, int64_t k)
{
    FLOW_ROWS (s, c, n) {
        if (k < n)
            return c + k;
        k -= n;
    }
    return 0;
}

/* Fills d on the rank that has the worst equation, so it is collective. */
void newton_describe(struct fv *s, const char *after, struct diagnosis *d)
{
    struct newton *w = s->newton;
    const double *r = N_VGetArrayPointer(w->residual), *f = N_VGetArrayPointer(w->fscale);
    double worst = -1.0;
    int64_t at = 0;
    for (int64_t i = 0; i < (s->dim + 1) * w->cells; i++)
        if (!(fabs(r[i] * f[i]) <= worst)) {
            worst = isfinite(r[i]) ? fabs(r[i] * f[i]) : 1e300;
            at = i;
        }
    if (worst < ranks_max(s->comm, worst)) /* another rank has it */
        return;
    char place[PARAM_TEXT_SIZE + 64];
    double x[3];
    cell_place(s, cell_of(s, at % w->cells), place, sizeof place, x);
    d->bad = true;
    snprintf(d->reason, sizeof d->reason,
             "%s a residual of %.3g (of velocity, relative), wanted %.3g, after %s",
             s->prm.dual_time ? "dual time stepping leaves" : "Newton's method leaves", worst,
             s->prm.tol_newton, after);
    snprintf(d->where, sizeof d->where, "%s of %s at (%g, %g, %g) m",
             at < w->cells ? "continuity" : "momentum", place, x[0], x[1], x[2]);
    if (s->prm.steady)
        snprintf(d->likely, sizeof d->likely,
                 "this flow may have no steady state on these cells: fv.steady = false shows what "
                 "it does in time; more cells, %smore viscosity",
                 s->prm.flux == FLUX_CENTRAL ? "fv.flux = \"upwind\", " : "");
    else if (s->prm.dual_time)
        newton_dual_explain(s, d->likely, sizeof d->likely);
    else
        snprintf(d->likely, sizeof d->likely,
                 "fv.cfl = %g is too large for this flow, or fv.flux = \"central\" finds it "
                 "unresolved",
                 s->prm.cfl);
}

/* A step that is tried again: both levels go back to the fields that they came from. */
static void give_levels(struct fv *s)
{
    struct newton *w = s->newton;
    newton_unpack(s, w->q1, s->p, s->u);
    newton_unpack(s, w->q2, s->p_before, s->stages.u_old);
    moving_back(s);
}

/* Both levels before, from the fields that become those of the next step. */
static void take_levels(struct fv *s)
{
    struct newton *w = s->newton;
    newton_pack(s, s->p, s->u, w->q1);
    newton_pack(s, s->p_before, s->stages.u_old, w->q2);
    memcpy(s->p_before, s->p, (size_t)s->size * sizeof(double));
    for (int a = 0; a < s->dim; a++)
        memcpy(s->stages.u_old[a], s->u[a], (size_t)s->size * sizeof(double));
    outflow_begin(s);
}

/* In this order: sides and blocks where the step ends, the coefficients in time, the start of the
 * iteration, which has what is imposed at that time. */
static bool solve_step(struct fv *s, double dt)
{
    s->newton->of.t = s->t + dt;
    stage_set_sides(s, s->t + dt, dt);
    newton_set_step(s, dt, s->step.dt);
    set_levels(s, dt, s->step.dt);
    return solve(s);
}

/* No halving here: the surface went half a step ahead with this dt, so the caller takes both back.
 */
bool newton_try(struct fv *s, double dt)
{
    start(s, "newton");
    take_levels(s);
    const bool good = solve_step(s, dt);
    s->newton->halvings += !good;
    stop(s, "newton");
    return good;
}

bool newton_step(struct fv *s, double *dt, struct diagnosis *d)
{
    struct newton *w = s->newton;
    start(s, "newton");
    if (s->moving)
        moving_begin_implicit(s, *dt);
    take_levels(s);
    bool good = solve_step(s, *dt);
    for (int k = 0; k < HALVINGS && !good; k++) {
        *dt *= 0.5;
        w->halvings++;
        if (s->moving) {
            give_levels(s);
            moving_begin_implicit(s, *dt);
            take_levels(s);
        }
        good = solve_step(s, *dt);
    }
    stop(s, "newton");
    if (!good)
        newton_describe(s, key_text("%d halvings of the step to %g s", HALVINGS, *dt), d);
    return good;
}

/* One Newton iteration of an Euler step of dtau; false: back at the state it began with. */
static bool try_pseudo_step(struct fv *s)
{
    struct newton *w = s->newton;
    SUN(KINSetNumMaxIters(w->kin, 1));
    SUN(KINSetFuncNormTol(w->kin, 1e-3 * s->prm.tol_newton));
    N_VScale(1.0, w->q1, w->q);
    const int code = KINSol(w->kin, w->q, KIN_LINESEARCH, w->uscale, w->fscale);
    count(w);
    bool good = code >= 0 || code == KIN_MAXITER_REACHED;
    newton_residual(w->q, w->residual, s);
    w->left = scaled_norm(w, w->residual);
    good = good && isfinite(w->left); /* largest values let NaN pass */
    if (!good)
        N_VScale(1.0, w->q1, w->q);
    N_VScale(1.0, w->q, w->q1); /* so that only the terms of the steady problem are left */
    newton_residual(w->q, w->residual, s);
    return good;
}

bool newton_stalls(struct newton *w, int64_t most)
{
    w->pseudo_steps++;
    if (w->best == 0.0 || w->norm < 0.9 * w->best) {
        w->best = w->norm;
        w->best_at = w->pseudo_steps;
    }
    return w->pseudo_steps - w->best_at >= most;
}

/* Of the pseudo step. Residual: left in the step's own equation, and gained in the steady one, each
 * over that before. A step that one Newton iteration solves may grow, whatever the flow does
 * meanwhile; one that it does not solve is too long. */
static double growth(double left, double gain)
{
    const double least = left < 0.25 ? 1.5 : left < 0.5 ? 1.1 : 0.5;
    return left > 0.8 ? 0.5 : fmin(fmax(gain, least), 10.0);
}

/* The next pseudo step. Where GMRES leaves the linear system unsolved and the residual falls much
 * less a vector than it did lately, the step was too long: beyond the time in which the flow
 * forgets its start little is gained by length, while the preconditioner, whose sweeps reach some
 * cells, is worth less and less. That bounds the steps to come. In flows that are hard to solve
 * all steps are slow, and unsolved ones still help. */
static void next_pseudo_step(struct newton *w, double factor, double gain, int64_t vectors)
{
    const double pace = log(fmax(gain, 1.0)) / (double)(vectors > 0 ? vectors : 1);
    const bool unsolved = vectors >= KRYLOV && pace < 0.25 * w->pace;
    w->pace = fmax(pace, 0.9 * w->pace);
    w->longest_step = unsolved ? 0.25 * w->dtau : 1.5 * w->longest_step;
    w->dtau = fmin(w->dtau * factor, w->longest_step);
}

/* One pseudo step and the size of the next. One that fails is cut to a quarter, and done again from
 * the state before. */
static void march(struct fv *s, struct diagnosis *d)
{
    struct newton *w = s->newton;
    const int64_t vectors = w->krylovs;
    bool good = false;
    w->of.t = 0.0; /* what is imposed stays as it begins */
    newton_pack(s, s->p, s->u, w->q1);
    for (int k = 0; k < PSEUDO_FAILURES && !good; k++) {
        newton_set_step(s, w->dtau, 0.0);
        good = try_pseudo_step(s);
        if (!good) {
            w->dtau *= 0.25;
            w->halvings++;
        }
    }
    const double before = w->norm;
    w->norm = scaled_norm(w, w->residual);
    if (!good)
        newton_describe(s, "a pseudo step that was cut to nothing", d);
    w->steady = w->norm <= s->prm.tol_newton;
    if (before > 0.0 && w->norm > 0.0)
        next_pseudo_step(w, growth(w->left / before, before / w->norm), before / w->norm,
                         w->krylovs - vectors);
}

double newton_pseudo_step(struct fv *s, double dtau, double t_stop, struct diagnosis *d)
{
    struct newton *w = s->newton;
    const double end = s->run->scene.time.end, left = t_stop - s->t;
    if (w->steady)
        return left;
    start(s, "newton");
    w->dtau = fmax(w->dtau, dtau);
    memcpy(s->p_before, s->p, (size_t)s->size * sizeof(double));
    march(s, d);
    stop(s, "newton");
    const double dt = w->steady ? left : fmin(left, end / PSEUDO_STEPS);
    const bool stalled = newton_stalls(w, STALL), late = s->t + dt >= (1.0 - 1e-9) * end;
    if (!d->bad && !w->steady && (stalled || late)) {
        char after[160];
        snprintf(after, sizeof after,
                 "%d pseudo steps (rms %.3g, the least %.3g at %d; the last step %.3g s)",
                 (int)w->pseudo_steps, w->norm, w->best, (int)w->best_at, w->dtau);
        newton_describe(s, after, d);
    }
    return dt;
}

/* newton_residual.c - residual of an implicit step and its derivative along a direction, term by
 * term with the same operators as the projected schemes:
 *   R_p = a (c0 p + c1 p1 + c2 p2) + D U,  a = 1/c^2 (0: incompressible)
 *   R_u = c0 u + c1 u1 + c2 u2 + D F + G p - nu L u
 *   U   = I(u) + d [avg(G p) - (p_R - p_L)/h]     momentum interpolation (Rhie & Chow 1983)
 *   F   = U q_f + transverse terms - eps |U| (q_RR - 3 q_R + 3 q_L - q_LL)
 * eps = 1/12 is the flux of the Godunov type with states of kappa = 1/3 to either side of the face
 * (van Leer 1979), and d its pressure part in an artificially compressible fluid of sound speed
 * h/(3 d). SPDX-License-Identifier: BSD-3-Clause */
#include "newton.h"

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"

/* ---- layout --------------------------------------------------------------------------------- */

/* Cells in the order of FLOW_ROWS, without ghosts; returns where the next field goes. */
static double *pack(const struct fv *s, const double *q, double *to)
{
    FLOW_ROWS (s, c, n) {
        memcpy(to, q + c, (size_t)n * sizeof(double));
        to += n;
    }
    return to;
}

static const double *unpack(const struct fv *s, const double *from, double *q)
{
    FLOW_ROWS (s, c, n) {
        memcpy(q + c, from, (size_t)n * sizeof(double));
        from += n;
    }
    return from;
}

/* p first, then the components. */
void newton_pack(const struct fv *s, const double *p, double *const u[3], N_Vector q)
{
    double *to = pack(s, p, N_VGetArrayPointer(q));
    for (int a = 0; a < s->dim; a++)
        to = pack(s, u[a], to);
}

void newton_unpack(const struct fv *s, N_Vector q, double *p, double *const u[3])
{
    const double *from = unpack(s, N_VGetArrayPointer(q), p);
    for (int a = 0; a < s->dim; a++)
        from = unpack(s, from, u[a]);
}

/* ---- residual ------------------------------------------------------------------------------- */

/* Two-step backward differences for steps that vary; dt_old 0: Euler, as the first step and pseudo
 * steps are. */
void newton_set_step(struct fv *s, double dt, double dt_old)
{
    struct newton_step *o = &s->newton->of;
    const double r = dt_old > 0.0 ? dt / dt_old : 0.0;
    o->c0 = (dt_old > 0.0 ? (1.0 + 2.0 * r) / (1.0 + r) : 1.0) / dt;
    o->c1 = (dt_old > 0.0 ? -(1.0 + r) : -1.0) / dt;
    o->c2 = (dt_old > 0.0 ? r * r / (1.0 + r) : 0.0) / dt;
    s->newton->cells_of->set_rates(s);
}

/* out = a (c0 p + ..) or c0 u + .., where forced cells have none. */
static void add_time(const struct fv *s, const double *q, const double *q1, const double *q2,
                     double w, int64_t n, double *restrict out)
{
    const struct newton_step *o = &s->newton->of;
    for (int64_t i = 0; i < n; i++)
        out[i] += w * (o->c0 * q[i] + o->c1 * q1[i] + o->c2 * q2[i]);
}

static double compressibility(const struct fv *s)
{
    return s->prm.c0 > 0.0 ? 1.0 / (s->prm.c0 * s->prm.c0) : 0.0;
}

double newton_dissipation(const struct fv *s)
{
    return s->prm.flux == FLUX_UPWIND ? 1.0 / 12.0 : 1.0 / 96.0;
}

void newton_clear(const struct fv *s, double *q)
{
    if (s->free) {
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                q[i] = s->free[i] > 0.0 ? q[i] : 0.0;
        return;
    }
    if (s->forcing)
        forcing_zero(s->forcing, q);
    if (s->surface)
        surface_zero(s, q);
}

/* Given cells hold no equation: their values are set, not solved for. Fields with ghosts are
 * scratch. */
static void clear_given(const struct fv *s, N_Vector r)
{
    if (!s->free && !s->forcing && !s->surface)
        return;
    newton_unpack(s, r, s->faces[0], s->rhs);
    newton_clear(s, s->faces[0]);
    for (int a = 0; a < s->dim; a++)
        newton_clear(s, s->rhs[a]);
    newton_pack(s, s->faces[0], s->rhs, r);
}

/* Leaves fields, fluxes and ghosts as those of qv; the preconditioner and what follows a step read
 * them. */
int newton_residual(N_Vector qv, N_Vector rv, void *user)
{
    struct fv *s = user;
    struct newton *w = s->newton;
    const int64_t n = w->cells;
    const double *q = N_VGetArrayPointer(qv), *q1 = N_VGetArrayPointer(w->q1),
                 *q2 = N_VGetArrayPointer(w->q2), a = compressibility(s);
    double *r = N_VGetArrayPointer(rv);
    newton_unpack(s, qv, s->p, s->u);
    w->cells_of->evaluate(s);
    newton_pack(s, s->faces[0], s->rhs, rv);
    add_time(s, q, q1, q2, a, n, r);
    for (int k = 1; k <= s->dim; k++)
        add_time(s, q + k * n, q1 + k * n, q2 + k * n, 1.0, n, r + k * n);
    clear_given(s, rv);
    return 0;
}

int newton_jacobian_times(N_Vector vv, N_Vector outv, N_Vector qv, booleantype *is_new, void *user)
{
    struct fv *s = user;
    struct newton *w = s->newton;
    const double *v = N_VGetArrayPointer(vv), a = compressibility(s);
    double *out = N_VGetArrayPointer(outv);
    if (*is_new) /* the line search may have left another state */
        newton_residual(qv, w->residual, s);
    *is_new = SUNFALSE;
    newton_unpack(s, vv, w->v.p, w->v.u);
    w->cells_of->evaluate_variation(s);
    newton_pack(s, s->faces[0], s->rhs, outv);
    for (int k = 0; k <= s->dim; k++) {
        const double c = k == 0 ? a * w->of.c0 : w->of.c0;
        for (int64_t i = k * w->cells; i < (k + 1) * w->cells; i++)
            out[i] += c * v[i];
    }
    clear_given(s, outv);
    return 0;
}

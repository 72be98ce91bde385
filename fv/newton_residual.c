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

#include <math.h>
#include <string.h>

#include "bc.h"
#include "forcing.h"

/* ---- layout --------------------------------------------------------------------------------- */

void newton_pack(const struct fv *s, const double *p, double *const u[3], N_Vector q)
{
    double *to = N_VGetArrayPointer(q);
    block_pack(&s->b, p, to);
    for (int a = 0; a < s->b.dim; a++)
        block_pack(&s->b, u[a], to + (a + 1) * s->newton->cells);
}

void newton_unpack(const struct fv *s, N_Vector q, double *p, double *const u[3])
{
    const double *from = N_VGetArrayPointer(q);
    block_unpack(&s->b, from, p);
    for (int a = 0; a < s->b.dim; a++)
        block_unpack(&s->b, from + (a + 1) * s->newton->cells, u[a]);
}

/* ---- faces ---------------------------------------------------------------------------------- */

/* Ghosts of a state at time t, or of a variation: the one place that knows what is imposed. */
static void fill_ghosts(struct fv *s, const struct flow *q, bool variation)
{
    double *fields[4] = {q->p, q->u[0], q->u[1], q->u[2]};
    if (s->forcing && variation) {
        for (int a = 0; a < s->b.dim; a++)
            forcing_zero(s->forcing, q->u[a]);
        forcing_zero(s->forcing, q->p);
    } else if (s->forcing)
        forcing_velocity(s, s->newton->of.t, q->u);
    bc_ghosts(s, variation ? BC_ZERO : BC_GIVEN, q->u);
    block_halo(&s->b, s->b.dim + 1, fields);
}

/* U += d [avg(G) - (p_R - p_L)/h] of a row, where both cells are free. */
static void add_pressure_flux(double *restrict U, const double *restrict p,
                              const double *restrict G, const double *restrict open, int64_t along,
                              double d, double per_h, int64_t n)
{
    for (int64_t i = 0; i < n; i++) {
        const double e = 0.5 * (G[i - along] + G[i]) - (p[i] - p[i - along]) * per_h;
        U[i] += d * (open && open[i] != 1.0 ? 0.0 : e);
    }
}

/* Ghosts, gradient of p, fluxes. */
static void complete(struct fv *s, const struct flow *q, bool variation)
{
    const struct block *b = &s->b;
    fill_ghosts(s, q, variation);
    for (int a = 0; a < b->dim; a++) {
        gradient(s, q->p, a, variation ? CONTINUE_VARIATION : CONTINUE_CUBIC, q->G[a]);
        if (s->forcing)
            forcing_zero(s->forcing, q->G[a]);
    }
    block_halo(b, b->dim, q->G);
    convection_face_velocities(s, q->u, q->U);
    for (int a = 0; a < b->dim; a++)
        BLOCK_ROWS (b, 1, c, n)
            add_pressure_flux(q->U[a] + c, q->p + c, q->G[a] + c,
                              s->forcing ? s->forcing->open[a] + c : NULL, b->stride[a],
                              s->newton->of.d, 1.0 / b->h[a], n);
    if (s->forcing && variation)
        forcing_fluxes_variation(s, q->U);
    else if (s->forcing)
        forcing_fluxes(s, s->newton->of.t, q->U);
    bc_fluxes(s, variation ? BC_ZERO : BC_GIVEN, q->U);
    for (int a = 0; a < b->dim; a++)
        convection_beside_walls(s, a, q->U[a]);
}

/* ---- fluxes --------------------------------------------------------------------------------- */

enum { TERMS = 3 };
static inline double face_value(const double *q, int64_t d)
{
    return (7.0 * (q[-d] + q[0]) - (q[-2 * d] + q[d])) * (1.0 / 12.0);
}
static inline double third_difference(const double *q, int64_t d)
{
    return (q[d] - q[-2 * d]) - 3.0 * (q[0] - q[-d]);
}

static void face_row(const double *restrict q, int64_t along, int64_t n, double *restrict f)
{
    for (int64_t i = 0; i < n; i++)
        f[i] = face_value(q + i, along);
}

/* Products of face averages along tangents, and the dissipation. least: |U| below it counts as it,
 * smoothly, for Newton needs a derivative. */
static void flux_row(const double *restrict U, const double *restrict f, const double *restrict q,
                     int64_t along, const int64_t *tangent, int nt, double eps, double least,
                     int64_t n, double *restrict F)
{
    for (int64_t i = 0; i < n; i++)
        F[i] = U[i] * f[i] + eps * sqrt(U[i] * U[i] + least) * third_difference(q + i, along);
    for (int t = 0; t < nt; t++) {
        const int64_t d = tangent[t];
        for (int64_t i = 0; i < n; i++)
            F[i] += (U[i + d] - U[i - d]) * (f[i + d] - f[i - d]) * (1.0 / 48.0);
    }
}

/* The same, varied: dU, df, dq. */
static void flux_variation_row(const double *restrict U, const double *restrict f,
                               const double *restrict q, const double *restrict dU,
                               const double *restrict df, const double *restrict dq, int64_t along,
                               const int64_t *tangent, int nt, double eps, double least, int64_t n,
                               double *restrict F)
{
    for (int64_t i = 0; i < n; i++) {
        const double size = sqrt(U[i] * U[i] + least);
        F[i] = U[i] * df[i] + dU[i] * f[i] +
               eps * (size * third_difference(dq + i, along) +
                      U[i] / size * dU[i] * third_difference(q + i, along));
    }
    for (int t = 0; t < nt; t++) {
        const int64_t d = tangent[t];
        for (int64_t i = 0; i < n; i++)
            F[i] += ((U[i + d] - U[i - d]) * (df[i + d] - df[i - d]) +
                     (dU[i + d] - dU[i - d]) * (f[i + d] - f[i - d])) *
                    (1.0 / 48.0);
    }
}

static void add_difference(const double *restrict F, int64_t along, double per_h, int64_t n,
                           double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] += (F[i + along] - F[i]) * per_h;
}

static int tangents(const struct block *b, int a, int64_t *t)
{
    int n = 0;
    for (int k = 0; k < b->dim; k++)
        if (k != a)
            t[n++] = b->stride[k];
    return n;
}

static double dissipation(const struct fv *s)
{
    return s->prm.flux == FLUX_UPWIND ? 1.0 / 12.0 : 1.0 / 96.0;
}

/* out += D F of component q along a; v: NULL, or the variation to take it along. */
static void add_convection(struct fv *s, int q, int a, const struct flow *v, double *out)
{
    const struct block *b = &s->b;
    struct newton *w = s->newton;
    const double eps = dissipation(s), least = 1e-2 * w->of.U * w->of.U;
    int64_t tangent[2];
    const int nt = tangents(b, a, tangent);
    const int64_t along = b->stride[a];
    BLOCK_ROWS (b, 1, c, n) {
        face_row(s->u[q] + c, along, n, w->face + c);
        if (v)
            face_row(v->u[q] + c, along, n, w->dface + c);
    }
    convection_beside_walls(s, a, w->face);
    if (v)
        convection_beside_walls(s, a, w->dface);
    for (int k = 0; k < b->n[2] + (a == 2); k++)
        for (int j = 0; j < b->n[1] + (a == 1); j++) {
            const int64_t c = block_at(b, 0, j, k), n = b->n[0] + (a == 0);
            if (v)
                flux_variation_row(s->U[a] + c, w->face + c, s->u[q] + c, v->U[a] + c, w->dface + c,
                                   v->u[q] + c, along, tangent, nt, eps, least, n, s->flux + c);
            else
                flux_row(s->U[a] + c, w->face + c, s->u[q] + c, along, tangent, nt, eps, least, n,
                         s->flux + c);
        }
    BLOCK_ROWS (b, 0, c, n)
        add_difference(s->flux + c, along, 1.0 / b->h[a], n, out + c);
}

/* ---- residual ------------------------------------------------------------------------------- */

/* s->rhs[q] = D F + G p - nu L u; s->face = D U. v: NULL, or along this variation. */
static void apply_space(struct fv *s, const struct flow *v)
{
    const struct block *b = &s->b;
    for (int q = 0; q < b->dim; q++) {
        const double *restrict G = v ? v->G[q] : s->newton->G[q];
        double *restrict out = s->rhs[q];
        const double drive = v ? 0.0 : s->drive[q];
        if (s->nu > 0.0)
            viscous_apply(s, v ? v->u[q] : s->u[q], out);
        else
            memset(out, 0, (size_t)b->size * sizeof(double));
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                out[i] = G[i] - out[i] - drive;
        for (int a = 0; a < b->dim; a++)
            add_convection(s, q, a, v, out);
    }
    memset(s->face, 0, (size_t)b->size * sizeof(double));
    for (int a = 0; a < b->dim; a++)
        BLOCK_ROWS (b, 0, c, n)
            add_difference((v ? v->U[a] : s->U[a]) + c, b->stride[a], 1.0 / b->h[a], n,
                           s->face + c);
    if (s->forcing) {
        forcing_zero(s->forcing, s->face);
        for (int q = 0; q < b->dim; q++)
            forcing_zero(s->forcing, s->rhs[q]);
    }
}

void newton_set_step(struct fv *s, double dt, double dt_old)
{
    struct newton_step *o = &s->newton->of;
    const double r = dt_old > 0.0 ? dt / dt_old : 0.0;
    o->c0 = (dt_old > 0.0 ? (1.0 + 2.0 * r) / (1.0 + r) : 1.0) / dt;
    o->c1 = (dt_old > 0.0 ? -(1.0 + r) : -1.0) / dt;
    o->c2 = (dt_old > 0.0 ? r * r / (1.0 + r) : 0.0) / dt;
    o->U = 1e-2 * s->scene_speed;
    for (int a = 0; a < s->b.dim; a++)
        o->U = fmax(o->U, fv_speed(s, a));
    o->rate = 0.0;
    for (int a = 0; a < s->b.dim; a++)
        o->rate += fv_speed(s, a) / s->b.h[a] + 2.0 * s->nu / (s->b.h[a] * s->b.h[a]);
    o->d = 1.0 / (o->c0 + o->rate);
    o->scale = s->prm.steady && o->rate > 0.0 ? 1.0 / o->rate : o->d;
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

/* Forced rows hold no equation: their values are set, not solved for. */
static void clear_forced(const struct fv *s, double *packed)
{
    const struct block *b = &s->b;
    if (!s->forcing)
        return;
    BLOCK_ROWS (b, 0, c, n) {
        for (int64_t i = c; i < c + n; i++)
            if (s->forcing->forced[i])
                packed[i - c] = 0.0;
        packed += n;
    }
}

int newton_residual(N_Vector qv, N_Vector rv, void *user)
{
    struct fv *s = user;
    struct newton *w = s->newton;
    const int64_t n = w->cells;
    const struct flow state = {s->p,
                               {s->u[0], s->u[1], s->u[2]},
                               {s->U[0], s->U[1], s->U[2]},
                               {w->G[0], w->G[1], w->G[2]}};
    const double *q = N_VGetArrayPointer(qv), *q1 = N_VGetArrayPointer(w->q1),
                 *q2 = N_VGetArrayPointer(w->q2), a = compressibility(s);
    double *r = N_VGetArrayPointer(rv);
    newton_unpack(s, qv, s->p, s->u);
    complete(s, &state, false);
    apply_space(s, NULL);
    newton_pack(s, s->face, s->rhs, rv);
    add_time(s, q, q1, q2, a, n, r);
    for (int k = 1; k <= s->b.dim; k++)
        add_time(s, q + k * n, q1 + k * n, q2 + k * n, 1.0, n, r + k * n);
    for (int k = 0; k <= s->b.dim; k++)
        clear_forced(s, r + k * n);
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
    complete(s, &w->v, true);
    apply_space(s, &w->v);
    newton_pack(s, s->face, s->rhs, outv);
    for (int k = 0; k <= s->b.dim; k++) {
        const double c = k == 0 ? a * w->of.c0 : w->of.c0;
        for (int64_t i = k * w->cells; i < (k + 1) * w->cells; i++)
            out[i] += c * v[i];
        clear_forced(s, out + k * w->cells);
    }
    return 0;
}

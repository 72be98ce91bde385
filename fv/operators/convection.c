/* convection.c - fluxes of momentum by fourth-order face averages (see METHODS.md):
 *   face value  q_f = (-q_-2 + 7 q_-1 + 7 q_0 - q_1)/12
 *   flux        F = U q_f + 1/48 (U_t+1 - U_t-1)(q_f,t+1 - q_f,t-1), once for each tangent t: the
 * product of two face averages is not the average of the product
 *   upwind bias q_f += sign(U) theta d/12, d = q_1 - 3 q_0 + 3 q_-1 - q_-2: theta = 1 is the
 * third-order upwind value. theta = min(1, C r^2), r = |d| over the sum of the differences it is
 * made of: 1 on an odd-even mode, O(h^2) where the flow is resolved, so that the bias is O(h^7)
 * there With layers of unequal height the face values along y have weights of their own (rows.h);
 * products and bias stay as they are: heights that vary smoothly change them by O(h^2) of a small
 * term. Beside a wall that slides the differences along t are one-sided: its ghosts over fluid at
 * rest are 4 V, and their product, V^2/3, is a flux of momentum that the cells cannot hold. So they
 * are under a surface beside any wall without slip: a third of the momentum of the cells beside it
 * would run ahead of a front that is thinner than the wall's layer, and into the air.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../boundary/fv_boundary.h"
#include "blocked_cells.h"
#include "operators.h"

/* Fourth order for averages of even cells; the compiler vectorises it. */
void convection_face_row(const double *restrict q, int64_t along, int64_t n, double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] = (7.0 * (q[i - along] + q[i]) - (q[i - 2 * along] + q[i + along])) * (1.0 / 12.0);
}

/* The same with weights of its own. w[0 .. 3] belong to q_-2, q_-1, q_0, q_1. */
static void weighted_row(const double *restrict q, const double *w, int64_t along, int64_t n,
                         double *restrict out)
{
    const double a = w[0], b = w[1], c = w[2], d = w[3];
    for (int64_t i = 0; i < n; i++)
        out[i] = (b * q[i - along] + c * q[i]) + (a * q[i - 2 * along] + d * q[i + along]);
}

/* q on the lower faces along axis a of all cells and one layer more. `more' = 1 layer of tangential
 * neighbours, since products need them. */
void convection_face_values(const struct fv *s, const double *q, int a, double *out)
{
    const struct block *b = &s->b;
    if (a == 1 && b->rows)
        BLOCK_WET_AT (s, 1, j, c, n)
            weighted_row(q + c, b->rows->face[j], b->stride[a], n, out + c);
    else
        BLOCK_WET (s, 1, c, n)
            convection_face_row(q + c, b->stride[a], n, out + c);
}

void convection_bias_row(const double *restrict q, const double *restrict U, int64_t along,
                         int64_t n, double C, double *restrict out)
{
    for (int64_t i = 0; i < n; i++) {
        const double a = q[i - along] - q[i - 2 * along], b = q[i] - q[i - along],
                     c = q[i + along] - q[i], d = a - 2.0 * b + c;
        const double r = fabs(d) / (fabs(a) + 2.0 * fabs(b) + fabs(c) + 1e-300);
        const double theta = C * r * r < 1.0 ? C * r * r : 1.0; /* fmin would be called */
        out[i] += copysign(theta * (1.0 / 12.0), U[i]) * d;
    }
}

/* Faces of this rank along `a': those of its cells and of one layer more on the upper side, and one
 * layer of tangential neighbours. Rows start one cell early; the last one is the upper face. */
void convection_face_velocities(struct fv *s, double *const u[3], double *const U[3])
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++)
        convection_face_values(s, u[a], a, U[a]);
    if (s->blocked)
        blocked_face_velocities(s, u, U, false);
}

/* Faces along `a' behind a wall that slides, under a surface behind all without slip:
 * (f_t+1 - f_t-1) beside the wall then knows no jump at it. */
void convection_beside_walls(const struct fv *s, int a, double *f)
{
    const struct block *b = &s->b;
    for (int side = 0; s->bc && side < 2 * b->dim; side++) {
        const int t = side / 2;
        int lo[3] = {0, 0, 0}, hi[3];
        if (t == a || s->bc->n[side] == 0 ||
            !(s->bc->slides[side] || (s->surface && s->bc->kind[side] == MESH_WALL)))
            continue;
        for (int q = 0; q < 3; q++)
            hi[q] = b->n[q] + (q == a);
        lo[t] = side % 2 ? b->n[t] - 1 : 0;
        hi[t] = lo[t] + 1;
        const int64_t in = side % 2 ? -b->stride[t] : b->stride[t];
        for (int k = lo[2]; k < hi[2]; k++)
            for (int j = lo[1]; j < hi[1]; j++)
                for (int i = lo[0]; i < hi[0]; i++) {
                    double *q = f + block_at(b, i, j, k);
                    q[-in] = bc_beside_wall(q, in, s->surface);
                }
    }
}

/* F = <U f> on a row of faces, with nt = dim - 1 tangents. */
static void flux_row(const double *restrict U, const double *restrict f, const int64_t *tangent,
                     int nt, int64_t n, double *restrict F)
{
    for (int64_t i = 0; i < n; i++)
        F[i] = U[i] * f[i];
    for (int t = 0; t < nt; t++) {
        const int64_t d = tangent[t];
        for (int64_t i = 0; i < n; i++)
            F[i] += (U[i + d] - U[i - d]) * (f[i + d] - f[i - d]) * (1.0 / 48.0);
    }
}

/* N (+)= (F_upper - F_lower)/h for a row of cells; the first axis sets, the others add. */
static void add_divergence(const double *restrict F, int64_t along, double per_h, int64_t n,
                           bool first, double *restrict N)
{
    if (first)
        for (int64_t i = 0; i < n; i++)
            N[i] = (F[i + along] - F[i]) * per_h;
    else
        for (int64_t i = 0; i < n; i++)
            N[i] += (F[i + along] - F[i]) * per_h;
}

/* For each component q and each axis a: face values, bias, corrections at boxes and walls, fluxes,
 * difference. Scratch: faces[0] and flux. Ghosts of u and U must be set; the loops skip air far
 * from water. */
void convection(struct fv *s, double *const N[3])
{
    const struct block *b = &s->b;
    bc_face_ghosts(s, s->U);
    for (int a = 0; a < b->dim; a++)
        convection_beside_walls(s, a, s->U[a]);
    for (int q = 0; q < b->dim; q++)
        for (int a = 0; a < b->dim; a++) {
            const int64_t along = b->stride[a];
            int64_t tangent[2];
            int nt = 0;
            for (int t = 0; t < b->dim; t++)
                if (t != a)
                    tangent[nt++] = b->stride[t];
            convection_face_values(s, s->u[q], a, s->faces[0]);
            if (s->prm.upwind > 0.0)
                BLOCK_WET (s, 1, c, n)
                    convection_bias_row(s->u[q] + c, s->U[a] + c, along, n, s->prm.upwind,
                                        s->faces[0] + c);
            if (s->blocked)
                blocked_faces(s, q, a, s->u[q], s->U[a], s->prm.upwind, s->faces[0]);
            convection_beside_walls(s, a, s->faces[0]);
            /* faces of the cells and the upper one */
            const int up[3] = {a == 0, a == 1, a == 2};
            PART_WET (&s->whole, no_layers, up, c, n)
                flux_row(s->U[a] + c, s->faces[0] + c, tangent, nt, n, s->flux + c);
            if (s->blocked)
                blocked_fluxes(s, q, a, s->U[a], s->faces[0], s->flux);
            BLOCK_WET_AT (s, 0, j, c, n)
                add_divergence(s->flux + c, along, 1.0 / block_size(b, a, j), n, a == 0, N[q] + c);
        }
}

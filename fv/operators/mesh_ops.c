/* mesh_ops.c - operators on curvilinear cells, in indices (h = 1), fourth order on smooth grids:
 *   face value      q_f = (-q_-2 + 7 q_-1 + 7 q_0 - q_1)/12
 *   of a product    <a b> = <a><b> + sum over tangents t of (a_t+1 - a_t-1)(b_t+1 - b_t-1)/48
 *   flux of volume  U = <u.S>;  of momentum <U q>;  of pressure <p S>
 *   viscous flux    nu <G_a. grad q>, G_ab = S_a.S_b/J: normal slope (15 d_1 - d_3)/12, tangential
 * ones from face values by (8 d_2 - d_4)/12
 *   volume average to average over indices: less sum over a of dq_a dV_a/48/V
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_ops.h"
#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "operators.h"

/* Layers for loops over lower faces along a: one more on the upper side, `t' layers of tangents. */
static void layers(int dim, int a, int t, int down[3], int up[3])
{
    for (int k = 0; k < 3; k++)
        down[k] = up[k] = k < dim && k != a ? t : 0;
    up[a] = 1;
}

/* Strides d and axes of the tangents of a; returns their number, dim - 1. */
static int tangents(const struct part *p, int dim, int a, int64_t d[2], int axis[2])
{
    int n = 0;
    for (int k = 0; k < dim; k++)
        if (k != a) {
            axis[n] = k;
            d[n++] = p->stride[k];
        }
    return n;
}

/* Face values of q on the lower faces along a of a part, with t layers of tangents. */
static void face_values(const struct part *p, int dim, int a, int t, const double *q, double *out)
{
    int down[3], up[3];
    layers(dim, a, t, down, up);
    PART_ROWS (p, down, up, c, n)
        convection_face_row(q + c, p->stride[a], n, out + c);
}

/* F += eps |U| times the third difference of q, |U| smooth where it is small beside U0 |S|.
 * Newton's convection on blocks alone: eps is fv.dissipation, and |U| is smoothed so that Newton's
 * iteration has a derivative at U = 0. */
static void add_dissipation(const double *restrict q, const double *restrict U,
                            const double *restrict G, const double *restrict V, int64_t s,
                            int64_t n, double eps, double U0, double *restrict F)
{
    for (int64_t i = 0; i < n; i++) {
        const double least = 1e-4 * U0 * U0 * G[i] * 0.5 * (V[i] + V[i - s]); /* G = S.S/V */
        F[i] +=
            eps * sqrt(U[i] * U[i] + least) * ((q[i + s] - q[i - 2 * s]) - 3.0 * (q[i] - q[i - s]));
    }
}

/* out (+)= <a b> on a row of faces. nt tangents; the form for one of them, 2D, is one pass. */
static void product_row(const double *restrict a, const double *restrict b, const int64_t *tangent,
                        int nt, int64_t n, bool first, double *restrict out)
{
    if (first && nt == 1) {
        const int64_t d = tangent[0];
        for (int64_t i = 0; i < n; i++)
            out[i] = a[i] * b[i] + (a[i + d] - a[i - d]) * (b[i + d] - b[i - d]) * (1.0 / 48.0);
        return;
    }
    if (first)
        for (int64_t i = 0; i < n; i++)
            out[i] = a[i] * b[i];
    else
        for (int64_t i = 0; i < n; i++)
            out[i] += a[i] * b[i];
    for (int t = 0; t < nt; t++) {
        const int64_t d = tangent[t];
        for (int64_t i = 0; i < n; i++)
            out[i] += (a[i + d] - a[i - d]) * (b[i + d] - b[i - d]) * (1.0 / 48.0);
    }
}

/* out (+)= F_upper - F_lower over the cells of a part. */
static void add_difference(const struct part *p, int a, const double *restrict F, bool first,
                           double *restrict out)
{
    const int64_t s = p->stride[a];
    PART_ROWS (p, no_layers, no_layers, c, n)
        if (first)
            for (int64_t i = c; i < c + n; i++)
                out[i] = F[i + s] - F[i];
        else
            for (int64_t i = c; i < c + n; i++)
                out[i] += F[i + s] - F[i];
}

/* out *= free/V: 0 in cells that are not computed. */
static void per_volume(const struct fv *s, const struct part *p, double *restrict out)
{
    const double *restrict V = s->m->V, *restrict f = s->free;
    PART_ROWS (p, no_layers, no_layers, c, n)
        for (int64_t i = c; i < c + n; i++)
            out[i] *= f[i] / V[i];
}

/* ---- on parts whose cells are all the same upright box: the sums above with what is 0 left out
 * ---- */

/* U = S u_face; S is the same for all. */
static void even_fluxes(const struct mesh *m, const struct part *p, int a, const double *u,
                        double *restrict U)
{
    const double S = m->S[a][a][part_at(p, 0, 0, 0)];
    int down[3], up[3];
    face_values(p, m->dim, a, 1, u, U);
    layers(m->dim, a, 1, down, up);
    PART_ROWS (p, down, up, c, n)
        for (int64_t i = c; i < c + n; i++)
            U[i] *= S;
}

/* Weights free S/(12 V) on differences of five averages. */
static void even_gradient(const struct fv *s, const struct part *p, const double *q,
                          double *const g[3])
{
    const struct mesh *m = s->m;
    const int64_t first = part_at(p, 0, 0, 0);
    for (int a = 0; a < m->dim; a++) {
        const int64_t d = p->stride[a];
        const double w = m->S[a][a][first] / (12.0 * m->V[first]);
        double *restrict out = g[a];
        PART_ROWS (p, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                out[i] =
                    s->free[i] * w * (8.0 * (q[i + d] - q[i - d]) - (q[i + 2 * d] - q[i - 2 * d]));
    }
}

/* viscous_row with nu G/(12 V); cells that are not computed get 0 where there are any. */
static void even_viscous(const struct fv *s, const struct part *p, const double *q,
                         double *restrict out)
{
    const struct mesh *m = s->m;
    const int64_t first = part_at(p, 0, 0, 0);
    const double *restrict is_free = s->free;
    double w[3];
    for (int a = 0; a < m->dim; a++)
        w[a] = s->nu * m->G[a][a][first] / (12.0 * m->V[first]);
    PART_ROWS (p, no_layers, no_layers, c, n) {
        viscous_row(q + c, p->stride, w, m->dim, n, out + c);
        if (m->computed < m->cells)
            for (int64_t i = c; i < c + n; i++)
                out[i] *= is_free[i];
    }
}

/* U -= tau G open (psi - psi_lower). */
static void even_subtract(const struct mesh *m, const struct part *p, int a, double tau,
                          const double *restrict psi, const double *restrict open,
                          double *restrict U)
{
    const int64_t d = p->stride[a];
    const double w = tau * m->G[a][a][part_at(p, 0, 0, 0)];
    int down[3], up[3];
    layers(m->dim, a, 1, down, up);
    PART_ROWS (p, down, up, c, n)
        for (int64_t i = c; i < c + n; i++)
            U[i] -= w * open[i] * (psi[i] - psi[i - d]);
}

/* Whether component k of the faces along a is 0 throughout. So it is on upright cells, whose face
 * vectors lie along the axes. */
static bool is_zero(const struct part *p, int a, int k)
{
    return p->kind == PART_UPRIGHT && k != a;
}

/* ---- on all ------------------------------------------------------------------------------------
 */

/* U_a = sum over k of <u_k S_ak>, on this rank's faces and one layer of tangents more. u with
 * ghosts and fringe. */
void mesh_face_velocities(struct fv *s, double *const u[3], double *const U[3])
{
    const struct mesh *m = s->m;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        for (int a = 0; a < m->dim; a++) {
            int64_t tangent[2];
            int axis[2], down[3], up[3];
            const int nt = tangents(p, m->dim, a, tangent, axis);
            if (p->kind == PART_EVEN) {
                even_fluxes(m, p, a, u[a], U[a]);
                continue;
            }
            layers(m->dim, a, 1, down, up);
            for (int k = 0, first = 1; k < m->dim; k++) {
                if (is_zero(p, a, k))
                    continue;
                face_values(p, m->dim, a, 2, u[k], s->faces[k]);
                PART_ROWS (p, down, up, c, n)
                    product_row(s->faces[k] + c, m->S[a][k] + c, tangent, nt, n, first, U[a] + c);
                first = 0;
            }
        }
    }
}

/* Fluxes through the faces of a part: of one that moves relative to it, into rhs. On parts that
 * move U less the flux of the grid itself; the caller's U[3] point to them. */
static void relative_fluxes(struct fv *s, const struct part *p, double *U[3])
{
    const struct mesh *m = s->m;
    for (int a = 0; a < m->dim; a++) {
        U[a] = s->U[a];
        if (!m->block[p->block].motion)
            continue;
        U[a] = s->rhs[a];
        for (int64_t c = p->base; c < p->base + p->size; c++)
            U[a][c] = s->U[a][c] - m->grid[a][c];
    }
}

/* N = div(U u)/V with relative fluxes, for each component and axis: face values, bias, walls,
 * products, dissipation, difference. Scratch: faces[0], flux, rhs. */
void mesh_convection(struct fv *s, double *const N[3])
{
    const struct mesh *m = s->m;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        double *U[3];
        relative_fluxes(s, p, U);
        for (int a = 0; a < m->dim; a++)
            mesh_bc_beside_walls(s, p, a, U[a]);
        for (int k = 0; k < m->dim; k++) {
            for (int a = 0; a < m->dim; a++) {
                int64_t tangent[2];
                int axis[2], down[3], up[3];
                const int nt = tangents(p, m->dim, a, tangent, axis);
                face_values(p, m->dim, a, 1, s->u[k], s->faces[0]);
                layers(m->dim, a, 1, down, up);
                if (s->prm.upwind > 0.0)
                    PART_ROWS (p, down, up, c, n)
                        convection_bias_row(s->u[k] + c, U[a] + c, p->stride[a], n, s->prm.upwind,
                                            s->faces[0] + c);
                mesh_bc_beside_walls(s, p, a, s->faces[0]);
                layers(m->dim, a, 0, down, up);
                PART_ROWS (p, down, up, c, n)
                    product_row(U[a] + c, s->faces[0] + c, tangent, nt, n, true, s->flux + c);
                if (s->prm.dissipation > 0.0)
                    PART_ROWS (p, down, up, c, n)
                        add_dissipation(s->u[k] + c, U[a] + c, m->G[a][a] + c, m->V + c,
                                        p->stride[a], n, s->prm.dissipation, s->speed.scene,
                                        s->flux + c);
                add_difference(p, a, s->flux, a == 0, N[k]);
            }
            per_volume(s, p, N[k]);
        }
    }
}

/* Gauss's theorem: g_k = (1/V) sum over faces of <q S_k>. On upright parts each component has one
 * axis. */
void mesh_gradient(struct fv *s, const double *q, double *const g[3])
{
    const struct mesh *m = s->m;
    for (int r = 0; r < m->nparts; r++) {
        const struct part *p = m->part + r;
        if (p->kind == PART_EVEN) {
            even_gradient(s, p, q, g);
            continue;
        }
        for (int a = 0; a < m->dim; a++) {
            int64_t tangent[2];
            int axis[2], down[3], up[3];
            const int nt = tangents(p, m->dim, a, tangent, axis);
            face_values(p, m->dim, a, 1, q, s->faces[0]);
            layers(m->dim, a, 0, down, up);
            for (int k = 0; k < m->dim; k++) {
                if (is_zero(p, a, k))
                    continue;
                PART_ROWS (p, down, up, c, n)
                    product_row(s->faces[0] + c, m->S[a][k] + c, tangent, nt, n, true, s->flux + c);
                add_difference(p, a, s->flux, a == 0 || p->kind == PART_UPRIGHT, g[k]);
            }
        }
        for (int k = 0; k < m->dim; k++)
            per_volume(s, p, g[k]);
    }
}

/* Slope across the faces of a row, fourth order. */
static void normal_slope(const double *restrict q, int64_t s, int64_t n, double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] = (15.0 * (q[i] - q[i - s]) - (q[i + s] - q[i - 2 * s])) * (1.0 / 12.0);
}

/* out += <G f_t> with the slope of the face values f along b; t: all tangents. b: stride of the
 * tangent along which the slope is; its own G varies, too. */
static void add_tangential(const double *restrict f, const double *restrict G, int64_t b,
                           const int64_t *tangent, int nt, int64_t n, double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] +=
            G[i] * (8.0 * (f[i + b] - f[i - b]) - (f[i + 2 * b] - f[i - 2 * b])) * (1.0 / 12.0);
    for (int t = 0; t < nt; t++) {
        const int64_t d = tangent[t];
        if (d == b)
            for (int64_t i = 0; i < n; i++)
                out[i] += (f[i + b] - 2.0 * f[i] + f[i - b]) * (G[i + b] - G[i - b]) * (1.0 / 24.0);
        else
            for (int64_t i = 0; i < n; i++)
                out[i] += (f[i + b + d] - f[i - b + d] - f[i + b - d] + f[i - b - d]) *
                          (G[i + d] - G[i - d]) * (1.0 / 96.0);
    }
}

/* (nu/V) sum over faces of <G_ab dq/dxi_b>; upright parts have no tangential slopes. */
void mesh_viscous(struct fv *s, const double *q, double *out)
{
    const struct mesh *m = s->m;
    for (int r = 0; r < m->nparts; r++) {
        const struct part *p = m->part + r;
        if (p->kind == PART_EVEN) {
            even_viscous(s, p, q, out);
            continue;
        }
        for (int a = 0; a < m->dim; a++) {
            int64_t tangent[2];
            int axis[2], down[3], up[3];
            const int nt = tangents(p, m->dim, a, tangent, axis);
            layers(m->dim, a, 1, down, up);
            PART_ROWS (p, down, up, c, n)
                normal_slope(q + c, p->stride[a], n, s->faces[0] + c);
            const bool skewed = p->kind == PART_CURVED;
            if (skewed)
                face_values(p, m->dim, a, 2, q, s->faces[1]);
            layers(m->dim, a, 0, down, up);
            PART_ROWS (p, down, up, c, n) {
                product_row(s->faces[0] + c, m->G[a][a] + c, tangent, nt, n, true, s->flux + c);
                for (int t = 0; skewed && t < nt; t++)
                    add_tangential(s->faces[1] + c, m->G[a][axis[t]] + c, tangent[t], tangent, nt,
                                   n, s->flux + c);
            }
            add_difference(p, a, s->flux, a == 0, out);
        }
        PART_ROWS (p, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                out[i] *= s->nu * s->free[i] / m->V[i];
    }
}

/* 0 in cells that are not computed. */
void mesh_divergence(const struct fv *s, double *const U[3], double *div)
{
    const struct mesh *m = s->m;
    for (int r = 0; r < m->nparts; r++) {
        const struct part *p = m->part + r;
        for (int a = 0; a < m->dim; a++)
            add_difference(p, a, U[a], a == 0, div);
        PART_ROWS (p, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                div[i] *= s->free[i];
    }
}

/* Second order: normal difference, and on curved parts the mean of four tangential ones; G at the
 * face. open: 0 on closed faces, with a surface its own coefficients. */
void mesh_subtract_psi(struct fv *s, double tau, const double *psi, double *const U[3])
{
    const struct mesh *m = s->m;
    for (int r = 0; r < m->nparts; r++) {
        const struct part *p = m->part + r;
        for (int a = 0; a < m->dim; a++) {
            int64_t tangent[2];
            int axis[2], down[3], up[3];
            const int nt = tangents(p, m->dim, a, tangent, axis);
            const int64_t d = p->stride[a];
            const double *open = s->surface ? s->surface->open[a] : m->open[a];
            if (p->kind == PART_EVEN) {
                even_subtract(m, p, a, tau, psi, open, U[a]);
                continue;
            }
            layers(m->dim, a, 1, down, up);
            PART_ROWS (p, down, up, c, n)
                for (int64_t i = c; i < c + n; i++) {
                    double F = m->G[a][a][i] * (psi[i] - psi[i - d]);
                    for (int t = 0; p->kind == PART_CURVED && t < nt; t++) {
                        const int64_t b = tangent[t];
                        F += 0.25 * m->G[a][axis[t]][i] *
                             (psi[i + b] - psi[i - b] + psi[i - d + b] - psi[i - d - b]);
                    }
                    U[a][i] -= tau * open[i] * F;
                }
        }
    }
}

/* q += sign times the sum over the axes of dq dV/48 V. Two passes, since q must not change while
 * neighbours read it. Nothing to do where all volumes are equal. */
static void shift_average(const struct fv *s, double sign, double *q, double *work)
{
    const struct mesh *m = s->m;
    if (!s->m->uneven)
        return;
    for (int r = 0; r < m->nparts; r++) {
        const struct part *p = m->part + r;
        if (p->kind == PART_EVEN)
            continue;
        for (int pass = 0; pass < 2; pass++)
            PART_ROWS (p, no_layers, no_layers, c, n)
                for (int64_t i = c; i < c + n; i++) {
                    double sum = 0.0;
                    if (pass == 1) {
                        q[i] += sign * work[i];
                        continue;
                    }
                    for (int a = 0; a < m->dim; a++) {
                        const int64_t d = p->stride[a];
                        sum += (q[i + d] - q[i - d]) * (m->V[i + d] - m->V[i - d]);
                    }
                    work[i] = s->free[i] * sum / (48.0 * m->V[i]);
                }
    }
}

void mesh_to_index(const struct fv *s, double *q, double *work) { shift_average(s, -1.0, q, work); }

/* q comes without ghosts: halo, fringe, imposed cells and sides are set here. Collective. */
void mesh_to_volume(struct fv *s, double *q, double *work)
{
    mesh_fill(s->m, 1, &q);
    if (s->forcing)
        forcing_extend(s, 1, q);
    mesh_bc_extend(s, q);
    shift_average(s, 1.0, q, work);
}

/* Third difference across the lower face, 0 where it leaves the cells. Holes and cells behind sides
 * end the fluid. */
static double third(const double *q, const unsigned char *status, int64_t i, int64_t d)
{
    const bool inside = status[i - 2 * d] < CELL_HOLE && status[i - d] < CELL_HOLE &&
                        status[i] < CELL_HOLE && status[i + d] < CELL_HOLE;
    return inside ? q[i + d] - q[i - 2 * d] - 3.0 * (q[i] - q[i - d]) : 0.0;
}

/* p -= 0.1 C^T C p/64 along each axis, C the third difference along an index: see smooth.c. */
void mesh_smooth_pressure(struct fv *s)
{
    const struct mesh *m = s->m;
    double *const sum = s->flux, *const p = s->p;
    for (int r = 0; r < m->nparts; r++) {
        const struct part *part = m->part + r;
        for (int a = 0; a < m->dim; a++) {
            const int64_t d = part->stride[a];
            int down[3] = {0, 0, 0}, up[3] = {0, 0, 0};
            down[a] = 1;
            up[a] = 2;
            PART_ROWS (part, down, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    s->faces[0][i] = third(p, m->status, i, d);
            PART_ROWS (part, no_layers, no_layers, c, n)
                for (int64_t i = c; i < c + n; i++)
                    sum[i] = (a ? sum[i] : 0.0) + s->faces[0][i - d] - s->faces[0][i + 2 * d] -
                             3.0 * (s->faces[0][i] - s->faces[0][i + d]);
        }
    }
    for (int r = 0; r < m->nparts; r++)
        PART_ROWS (m->part + r, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                p[i] -= s->free[i] * (0.1 / 64.0) * sum[i];
}

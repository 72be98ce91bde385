/* mesh_forces.c - forces on walls of blocks, and the work that comes in through sides.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_sides.h"

#include <math.h>
#include <string.h>

#include "../grid/mesh_motion.h"
#include "still.h"

/* Slopes across and along the face of a field with ghosts, at the place of the face. */
static void face_slopes(const struct mesh *m, const struct side *d, int64_t f, const double *u,
                        double *slope)
{
    const int64_t a = d->p->stride[d->a];
    slope[d->a] = (15.0 * (u[f] - u[f - a]) - (u[f + a] - u[f - 2 * a])) / 12.0;
    for (int n = 0; n < 2 && d->t[n] < m->dim; n++) {
        double v[5];
        const int64_t b = d->p->stride[d->t[n]];
        for (int l = -2; l <= 2; l++) {
            const double *q = u + f + l * b;
            v[l + 2] = (7.0 * (q[-a] + q[0]) - (q[-2 * a] + q[a])) / 12.0;
        }
        slope[d->t[n]] = (8.0 * (v[3] - v[1]) - (v[4] - v[0])) / 12.0;
    }
}

/* Place, pressure (Pa) and velocity gradient on one face. */
static void face_state(const struct fv *s, const struct side *d, int64_t c, int i, int j,
                       double x[3], double *pressure, double g[3][3])
{
    const struct mesh *m = s->m;
    const int64_t f = c + d->face, a = d->p->stride[d->a];
    double dx[3][3], xi[3] = {0.5, 0.5, 0.5}, slope[3][3] = {{0.0}};
    int at[3];
    at[d->a] = d->p->lo[d->a] + d->first;
    at[d->t[0]] = d->p->lo[d->t[0]] + i;
    at[d->t[1]] = d->p->lo[d->t[1]] + j;
    xi[d->a] = d->k % 2;
    mesh_map_point(m->block + d->p->block, m->dim, at, xi, x, dx);
    const double J = mesh_determinant(dx);
    for (int q = 0; q < m->dim; q++)
        face_slopes(m, d, f, s->u[q], slope[q]);
    for (int k = 0; k < m->dim; k++) /* grad xi_k = cofactors / J */
        for (int e = 0; e < m->dim; e++) {
            const int p = (k + 1) % 3, q = (k + 2) % 3, v = (e + 1) % 3, w = (e + 2) % 3;
            const double dxi = (dx[p][v] * dx[q][w] - dx[p][w] * dx[q][v]) / J;
            for (int r = 0; r < m->dim; r++)
                g[r][e] += slope[r][k] * dxi;
        }
    double p[4];
    for (int l = 0; l < 4; l++)
        p[l] = fv_pressure(s, f + (l - 2) * a);
    *pressure = (7.0 * (p[1] + p[2]) - (p[0] + p[3])) / 12.0;
}

/* Average of the pressure over the face at f, Pa. */
static double face_pressure(const struct fv *s, int64_t f, int64_t a)
{
    return (7.0 * (fv_pressure(s, f - a) + fv_pressure(s, f)) -
            (fv_pressure(s, f - 2 * a) + fv_pressure(s, f + a))) /
           12.0;
}

/* nu <G_ab dq/dxi_b> of the face at f, as mesh_viscous has it. */
static double viscous_flux(const struct fv *s, const struct side *d, int64_t f, const double *q)
{
    const struct mesh *m = s->m;
    const int a = d->a;
    double slope[3], up[3], down[3], F = 0.0;
    face_slopes(m, d, f, q, slope);
    for (int k = 0; k < m->dim; k++)
        F += m->G[a][k][f] * slope[k];
    for (int n = 0; n < 2 && d->t[n] < m->dim; n++) {
        const int64_t t = d->p->stride[d->t[n]];
        face_slopes(m, d, f + t, q, up);
        face_slopes(m, d, f - t, q, down);
        for (int k = 0; k < m->dim; k++)
            F += (up[k] - down[k]) * (m->G[a][k][f + t] - m->G[a][k][f - t]) / 48.0;
    }
    return s->nu * F;
}

/* Share of a face that is below the level set's 0, straight between its ends; xi: middle of that
 * share, in the face's cell. Along the second tangent at Gauss points. phi NULL: all of it. */
static double wet_share(const struct fv *s, const struct side *d, const double *phi, int64_t c,
                        double xi[3])
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    const int n = s->m->dim == 3 ? 2 : 1;
    double share = 0.0, at[2] = {0.0, 0.0}, slope[2] = {0.0, 0.0};
    if (!phi)
        return 1.0;
    const double middle = 0.5 * (phi[c] + phi[c - d->in]);
    for (int t = 0; t < n; t++) {
        const int64_t b = d->p->stride[d->t[t]];
        slope[t] = 0.25 * (phi[c + b] + phi[c + b - d->in] - phi[c - b] - phi[c - b - d->in]);
    }
    for (int k = 0; k < n; k++) {
        const double across = n == 2 ? gauss[k] : 0.5;
        const double q = middle + (across - 0.5) * slope[1], half = 0.5 * fabs(slope[0]);
        const double own = q <= -half ? 1.0 : q >= half ? 0.0 : 0.5 - q / (2.0 * half);
        share += own / n;
        at[0] += own / n * (slope[0] > 0.0 ? 0.5 * own : 1.0 - 0.5 * own);
        at[1] += own / n * across;
    }
    for (int t = 0; t < n && share > 0.0; t++)
        xi[d->t[t]] = at[t] / share;
    return share;
}

/* What its pressure lacks, Pa: that of water at rest, a partner's level, in the middle of the wet
 * share of a face. */
static double still_on_face(const struct fv *s, const struct side *d, int i, int j, double xi[3])
{
    double x[3], dx[3][3];
    int at[3];
    at[d->a] = d->p->lo[d->a] + d->first;
    at[d->t[0]] = d->p->lo[d->t[0]] + i;
    at[d->t[1]] = d->p->lo[d->t[1]] + j;
    xi[d->a] = d->k % 2;
    mesh_map_point(s->m->block + d->p->block, s->m->dim, at, xi, x, dx);
    return fv_still_pressure(s, x) + s->datum;
}

/* On a slip wall no friction. */
static void keep_normal(const struct fv *s, const struct side *d, int64_t f, double *force)
{
    double along = 0.0, S2 = 0.0;
    for (int q = 0; q < s->m->dim; q++) {
        along += force[q] * s->m->S[d->a][q][f];
        S2 += s->m->S[d->a][q][f] * s->m->S[d->a][q][f];
    }
    for (int q = 0; q < s->m->dim; q++)
        force[q] = along / S2 * s->m->S[d->a][q][f];
}

/* -p S + mu (grad u + grad u^T) S on one face, outwards of the fluid. p S and grad u S are the
 * fluxes of the momentum equation. Of grad u^T S the slopes across the wall are 0 by continuity;
 * those along it remain where it turns. Of a face that the surface crosses the wet share. */
static void face_force(const struct fv *s, const struct side *d, const double *phi, int64_t c,
                       int i, int j, double *force)
{
    const struct mesh *m = s->m;
    const double rho = s->run->scene.fluid.rho, out = d->k % 2 ? 1.0 : -1.0;
    const int64_t f = c + d->face, a = d->p->stride[d->a];
    double x[3], xi[3] = {0.5, 0.5, 0.5}, pf, g[3][3] = {{0.0}}, S2 = 0.0;
    const double share = wet_share(s, d, phi, c, xi);
    if (!(share > 0.0))
        return;
    face_state(s, d, c, i, j, x, &pf, g);
    pf += still_on_face(s, d, i, j, xi);
    for (int e = 0; e < m->dim; e++)
        S2 += m->S[d->a][e][f] * m->S[d->a][e][f];
    for (int q = 0; q < m->dim; q++) {
        force[q] = rho * viscous_flux(s, d, f, s->u[q]) - pf * m->S[d->a][q][f];
        for (int n = 0; n < 2 && d->t[n] < m->dim; n++) {
            const int64_t t = d->p->stride[d->t[n]];
            force[q] -= (face_pressure(s, f + t, a) - face_pressure(s, f - t, a)) *
                        (m->S[d->a][q][f + t] - m->S[d->a][q][f - t]) / 48.0;
        }
        for (int e = 0; e < m->dim; e++) {
            double across = 0.0;
            for (int r = 0; r < m->dim; r++)
                across += g[e][r] * m->S[d->a][r][f];
            force[q] += rho * s->nu * (g[e][q] - across * m->S[d->a][q][f] / S2) * m->S[d->a][e][f];
        }
        force[q] *= -out * share; /* on the wall */
    }
    if (d->kind == MESH_SLIP)
        keep_normal(s, d, f, force);
    x[2] = 0.0;
    double o[3];
    mesh_motion_now(m->block + d->p->block, m->block[d->p->block].prm->centre, o);
    force[3] = (x[0] - o[0]) * force[1] - (x[1] - o[1]) * force[0];
}

/* Energy and pressure that flow in through one face, and friction on it, over rho. */
static double face_power(const struct fv *s, const struct side *d, int64_t c, int i, int j)
{
    const struct mesh *m = s->m;
    const double out = d->k % 2 ? 1.0 : -1.0;
    const int64_t f = c + d->face, a = d->p->stride[d->a];
    double x[3], pf, g[3][3] = {{0.0}}, square = 0.0, friction = 0.0;
    face_state(s, d, c, i, j, x, &pf, g);
    for (int q = 0; q < m->dim; q++) {
        const double *u = s->u[q] + f;
        const double w = (7.0 * (u[-a] + u[0]) - (u[-2 * a] + u[a])) / 12.0;
        square += w * w;
        for (int e = 0; e < m->dim; e++)
            friction += s->nu * w * g[q][e] * m->S[d->a][e][f];
    }
    return out * (friction - s->U[d->a][f] * (0.5 * square + pf / s->run->scene.fluid.rho));
}

double mesh_bc_power(struct fv *s)
{
    double sum = 0.0;
    double *both[2] = {s->p, s->p_before};
    mesh_fill(s->m, 2, both);
    for (int k = 0; k < 2; k++)
        mesh_bc_pressure(s, both[k]);
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->kind == MESH_SLIP)
            continue;
        SIDE_PLACES (d, 0, i, j, at, c) {
            sum += s->free[c] > 0.0 ? face_power(s, d, c, i, j) : 0.0;
            (void)at;
        }
    }
    return sum;
}

void mesh_bc_force(struct fv *s, const double *phi, double (*body)[4], double all[4])
{
    double *both[2] = {s->p, s->p_before}, sums[MESH_BLOCKS_MAX + 1][4] = {{0.0}};
    const int n = s->m->nblocks;
    mesh_fill(s->m, 2, both);
    for (int k = 0; k < 2; k++)
        mesh_bc_pressure(s, both[k]);
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->kind != MESH_WALL && d->kind != MESH_SLIP)
            continue;
        SIDE_PLACES (d, 0, i, j, at, c) {
            double one[4] = {0.0, 0.0, 0.0, 0.0};
            if (phi ? s->m->status[c] == CELL_COMPUTED : s->free[c] > 0.0)
                face_force(s, d, phi, c, i, j, one);
            for (int q = 0; q < 4; q++)
                sums[d->body ? d->p->block : n][q] += one[q];
            (void)at;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 4 * (n + 1), MPI_DOUBLE, MPI_SUM, s->m->comm);
    memcpy(body, sums, (size_t)n * sizeof *body);
    for (int q = 0; all && q < 4; q++) {
        all[q] = 0.0;
        for (int k = 0; k <= n; k++)
            all[q] += sums[k][q];
    }
}

/* mesh_forces.c - force of the flow on a face of a wall of blocks, and the work that comes in
 * through one of a side. SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "face_share.h"
#include "mesh_ops.h"

/* Derivatives of u with respect to the indices at the face f of a side, from cells and ghosts,
 * fourth order: across it (15 (q_0 - q_-1) - (q_1 - q_-2))/12, along it from five face values. */
static void face_slopes(const struct mesh *m, const struct side_face *d, int64_t f, const double *u,
                        double *slope)
{
    const int64_t a = d->part->stride[d->a];
    slope[d->a] = (15.0 * (u[f] - u[f - a]) - (u[f + a] - u[f - 2 * a])) / 12.0;
    for (int t = 0; t < m->dim; t++) {
        if (t == d->a)
            continue;
        double v[5];
        const int64_t b = d->part->stride[t];
        for (int l = -2; l <= 2; l++) {
            const double *q = u + f + l * b;
            v[l + 2] = (7.0 * (q[-a] + q[0]) - (q[-2 * a] + q[a])) / 12.0;
        }
        slope[t] = (8.0 * (v[3] - v[1]) - (v[4] - v[0])) / 12.0;
    }
}

/* At xi of the tangents within the face: its place, and dx the mapping's slopes there. xi of the
 * side's own axis is 0 or 1. */
static void place_on(const struct fv *s, const struct side_face *d, double xi[3], double x[3],
                     double dx[3][3])
{
    int at[3];
    part_index(d->part, d->cell, at);
    for (int a = 0; a < 3; a++)
        at[a] += d->part->lo[a];
    xi[d->a] = d->side % 2;
    mesh_map_point(s->m->block + d->part->block, s->m->dim, at, xi, x, dx);
}

/* Average of the pressure over the face of the cell t further along the side, Pa. Beside a film the
 * cell's own: cells of air have none, and ghosts come of three cells. */
static double face_pressure(const struct fv *s, const struct side_face *d, int64_t t)
{
    const int64_t c = d->cell + t, in = d->in;
    if (face_is_dry(s, c + in) || face_is_dry(s, c + 2 * in))
        return fv_pressure(s, c);
    return (7.0 * (fv_pressure(s, c - in) + fv_pressure(s, c)) -
            (fv_pressure(s, c - 2 * in) + fv_pressure(s, c + in))) /
           12.0;
}

/* Position, pressure (Pa) and velocity gradient g[q][e] = du_q/dx_e in the middle of a face. grad
 * xi comes from the cofactors of the mapping's slopes. */
static void face_state(const struct fv *s, const struct side_face *d, double x[3], double *pressure,
                       double g[3][3])
{
    const struct mesh *m = s->m;
    const int64_t f = d->face;
    double dx[3][3], xi[3] = {0.5, 0.5, 0.5}, slope[3][3] = {{0.0}};
    place_on(s, d, xi, x, dx);
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
    *pressure = face_pressure(s, d, 0);
}

/* nu <G_ab dq/dxi_b> of the face, as mesh_viscous has it. Products of averages along the face are
 * corrected as in mesh_ops.c. */
static double viscous_flux(const struct fv *s, const struct side_face *d, const double *q)
{
    const struct mesh *m = s->m;
    const int a = d->a;
    const int64_t f = d->face;
    double slope[3], up[3], down[3], F = 0.0;
    face_slopes(m, d, f, q, slope);
    for (int k = 0; k < m->dim; k++)
        F += m->G[a][k][f] * slope[k];
    for (int n = 0; n < m->dim; n++) {
        const int64_t t = d->part->stride[n];
        if (n == a)
            continue;
        face_slopes(m, d, f + t, q, up);
        face_slopes(m, d, f - t, q, down);
        for (int k = 0; k < m->dim; k++)
            F += (up[k] - down[k]) * (m->G[a][k][f + t] - m->G[a][k][f - t]) / 48.0;
    }
    return s->nu * F;
}

/* Share of the face that is below the level set's 0 (face_wet_share). Without a surface all of it.
 * phi is taken linear on the face, from four cells around; its mean over the two cells beside the
 * face is that at the face. */
static double wet_share(const struct fv *s, const struct side_face *d, double xi[3], double edge[3])
{
    const double *phi = s->surface ? s->surface->phi : NULL;
    const int64_t c = d->cell;
    double slope[3] = {0.0};
    if (!phi)
        return 1.0;
    for (int t = 0; t < s->m->dim; t++) {
        const int64_t b = d->part->stride[t];
        slope[t] = 0.25 * (phi[c + b] + phi[c + b - d->in] - phi[c - b] - phi[c - b - d->in]);
    }
    return face_wet_share(s->m->dim, d->a, 0.5 * (phi[c] + phi[c - d->in]), slope, xi, edge);
}

/* Of water at rest, and a partner's level, Pa. */
static double still_at(const struct fv *s, const struct side_face *d, double xi[3])
{
    double x[3], dx[3][3];
    place_on(s, d, xi, x, dx);
    return fv_still_pressure(s, x) + s->partners.pressure;
}

/* Pressure on the wet share of a face, p that of the flow, Pa: that of water at rest in the middle
 * of the share comes to it. Where the cell is of air, which has no p, the water is as deep as it
 * stands below the surface on the face; a film over all of the face has no depth. */
static double whole_pressure(const struct fv *s, const struct side_face *d, double share, double p,
                             double xi[3], double edge[3])
{
    if (!face_is_dry(s, d->cell))
        return p + still_at(s, d, xi);
    return share < 1.0 ? still_at(s, d, xi) - still_at(s, d, edge) : 0.0;
}

/* What the turning of the wall along tangent t adds to p S, from the cells beside. */
static double pressure_slope(const struct fv *s, const struct side_face *d, int64_t t)
{
    return face_is_dry(s, d->cell) || face_is_dry(s, d->cell + t) || face_is_dry(s, d->cell - t)
               ? 0.0
               : face_pressure(s, d, t) - face_pressure(s, d, -t);
}

/* On a slip wall there is no viscous friction: keeps the component of the force along S. */
static void keep_normal(const struct fv *s, const struct side_face *d, double *force)
{
    double S[3];
    grid_face_vector(&s->grid, d->face, d->a, S);
    const double along = vec3_dot(force, S) / vec3_dot(S, S);
    for (int q = 0; q < s->m->dim; q++)
        force[q] = along * S[q];
}

/* -p S + mu (grad u + grad u^T) S on one face, outwards of the fluid. p S and grad u S are the
 * fluxes of the momentum equation. Of grad u^T S the slopes across the wall are 0 by continuity;
 * those along it remain where it turns. Of a face that the surface crosses the wet share. Cells
 * that are not computed exert no force; with a surface dry faces have share 0. The moment is about
 * the block's centre as it has moved. */
void mesh_face_force(const struct fv *s, const struct side_face *d, double sum[4])
{
    const struct mesh *m = s->m;
    const double rho = s->run->scene.fluid.rho, out = d->side % 2 ? 1.0 : -1.0;
    const int64_t f = d->face;
    double x[3], xi[3] = {0.5, 0.5, 0.5}, edge[3] = {0.5, 0.5, 0.5}, pf, g[3][3] = {{0.0}};
    double force[4] = {0.0};
    const double share = wet_share(s, d, xi, edge);
    if (!(s->surface ? m->status[d->cell] == CELL_COMPUTED : s->free[d->cell] > 0.0) ||
        !(share > 0.0))
        return;
    face_state(s, d, x, &pf, g);
    pf = whole_pressure(s, d, share, pf, xi, edge);
    const double S2 = mesh_area2(m, d->a, f);
    for (int q = 0; q < m->dim; q++) {
        force[q] = rho * viscous_flux(s, d, s->u[q]) - pf * m->S[d->a][q][f];
        for (int n = 0; n < m->dim; n++) {
            const int64_t t = d->part->stride[n];
            if (n == d->a)
                continue;
            force[q] -=
                pressure_slope(s, d, t) * (m->S[d->a][q][f + t] - m->S[d->a][q][f - t]) / 48.0;
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
        keep_normal(s, d, force);
    side_friction_force(s, d, share, force);
    x[2] = 0.0;
    double o[3];
    mesh_motion_now(m->block + d->part->block, m->block[d->part->block].prm->centre, o);
    force[3] = (x[0] - o[0]) * force[1] - (x[1] - o[1]) * force[0];
    for (int q = 0; q < 4; q++)
        sum[q] += force[q];
}

/* out (nu u.(grad u) S - U (u^2/2 + p/rho)), outwards S; slip walls do no work. */
double mesh_face_power(const struct fv *s, const struct side_face *d)
{
    const struct mesh *m = s->m;
    const double out = d->side % 2 ? 1.0 : -1.0;
    const int64_t f = d->face, a = d->part->stride[d->a];
    double x[3], pf, g[3][3] = {{0.0}}, square = 0.0, friction = 0.0;
    if (d->kind == MESH_SLIP || !(s->free[d->cell] > 0.0))
        return 0.0;
    face_state(s, d, x, &pf, g);
    for (int q = 0; q < m->dim; q++) {
        const double *u = s->u[q] + f;
        const double w = (7.0 * (u[-a] + u[0]) - (u[-2 * a] + u[a])) / 12.0;
        square += w * w;
        for (int e = 0; e < m->dim; e++)
            friction += s->nu * w * g[q][e] * m->S[d->a][e][f];
    }
    return out * (friction - s->U[d->a][f] * (0.5 * square + pf / s->run->scene.fluid.rho));
}

/* mesh_ghosts.c - physical sides of blocks: ghosts as in bc.c, along the indices across the side.
 * No-slip, inflow, exact: the cubic through the average w on the face and three cells; slip: the
 * normal component mirrored oddly; outflow: evenly, with p/rho = 0 on the face. mesh_bc_velocity is
 * called after halo and fringe were filled, for every operator; the others fill ghosts of
 * pressures, level sets and other scalars.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_sides.h"

#include "ghosts.h"

/* Ghosts behind a slip side: the component along S is antisymmetric about the wall's own flux wS,
 * the rest is mirrored. */
static void slip(const struct mesh *m, const struct side *d, int64_t c, double wS,
                 double *const u[3])
{
    const double S2 = mesh_area2(m, d->a, c + d->face);
    for (int l = 0; l < MESH_GHOSTS; l++) {
        double un = -wS;
        for (int q = 0; q < m->dim; q++)
            un += u[q][c + l * d->in] * m->S[d->a][q][c + d->face];
        for (int q = 0; q < m->dim; q++)
            u[q][c - (l + 1) * d->in] =
                u[q][c + l * d->in] - 2.0 * un * m->S[d->a][q][c + d->face] / S2;
    }
}

/* The value on a side for this kind of field. */
static double wanted(const struct side *d, int q, int64_t at, enum bc_value what)
{
    switch (what) {
    case BC_GIVEN:
        return d->w[q][at];
    case BC_AHEAD:
        return d->w[q][at] + d->slip[q][at];
    case BC_CHANGE:
        return d->w[q][at] + d->slip[q][at] - d->w_old[q][at];
    case BC_ZERO:
        break;
    }
    return 0.0;
}

/* What a place of such a wall gains across it while the projection acts, times the area: in rk3 in
 * a stage, with backward differences in dt/c0. Its cell inside: c. S is the face's vector, so that
 * the result is a flux, m^dim/s. */
static double gain(const struct fv *s, const struct side *d, int64_t at, int64_t c)
{
    const double r = s->step.dt > 0.0 ? s->step.dt_now / s->step.dt : 0.0,
                 share = s->prm.integrator == INTEGRATOR_RK3 ? 1.0 : (1.0 + r) / (1.0 + 2.0 * r);
    double sum = 0.0;
    for (int q = 0; q < s->m->dim; q++)
        sum += (d->w[q][at] - d->w_old[q][at]) * s->m->S[d->a][q][c + d->face];
    return share * sum + (d->turn ? d->turn[at] : 0.0);
}

/* psi gets the slope rise per cell that balances the wall's acceleration, in ghosts l = 1, 2, .. (2
 * l - 1) times. */
void mesh_bc_slope_ghosts(const struct fv *s, double tau, double *psi)
{
    const struct mesh *m = s->m;
    for (int k = 0; k < s->sides->n; k++) {
        struct side *d = s->sides->side + k;
        if (!side_accelerates(s, d))
            continue;
        if (!d->rise)
            d->rise = NEW_IN(s->sides, double, d->width *(d->n[1] + 2 * d->g[1]));
        SIDE_PLACES (d, 1, i, j, at, c) {
            /* a cell's way across the wall, by its volume */
            const double S2 = mesh_area2(m, d->a, c + d->face), step = m->V[c] / S2;
            d->rise[at] = gain(s, d, at, c) * step * (d->k % 2 ? -1.0 : 1.0) / tau;
            for (int l = 1; l <= MESH_GHOSTS; l++)
                psi[c - l * d->in] += (2 * l - 1) * d->rise[at];
        }
    }
}

/* A wall's acceleration stands in the pressure's slope there. */
void mesh_bc_slope_fluxes(const struct fv *s, double tau, int a, double *F)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->a != a || !side_accelerates(s, d))
            continue;
        SIDE_PLACES (d, 0, i, j, at, c) {
            F[c + d->face] = -gain(s, d, at, c) / tau;
        }
    }
}

/* Flux that a slip wall that moves makes, m^dim/s. */
static double flux_wanted(const struct mesh *m, const struct side *d, int64_t at, int64_t c,
                          enum bc_value what)
{
    double sum = 0.0;
    for (int q = 0; q < m->dim && what != BC_ZERO; q++)
        sum += (d->w[q][at] - (what == BC_CHANGE ? d->w_old[q][at] : 0.0)) *
               m->S[d->a][q][c + d->face];
    return sum;
}

/* late: what an accelerating wall's fluid gains only in the projection. */
void mesh_bc_velocity(const struct fv *s, enum bc_value what, double *const u[3])
{
    const struct mesh *m = s->m;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES (d, 1, i, j, at, c) {
            const double late = (what == BC_AHEAD || what == BC_CHANGE) && side_accelerates(s, d)
                                    ? gain(s, d, at, c)
                                    : 0.0;
            if (d->kind == MESH_SLIP)
                slip(m, d, c, (d->moves ? flux_wanted(m, d, at, c, what) : 0.0) - late, u);
            else
                for (int q = 0; q < m->dim; q++) {
                    if (d->kind == MESH_OUTFLOW)
                        ghosts_mirrored(u[q] + c, d->in, 1.0, 0.0);
                    else
                        ghosts_given(u[q] + c, d->in,
                                     wanted(d, q, at, what) -
                                         (late != 0.0 ? late / mesh_area2(m, d->a, c + d->face) *
                                                            m->S[d->a][q][c + d->face]
                                                      : 0.0));
                }
        }
    }
}

/* odd: antisymmetric at outflows, for psi. */
void mesh_bc_even(const struct fv *s, bool odd, double *q)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES (d, 1, i, j, at, c) {
            ghosts_mirrored(q + c, d->in, odd && d->kind == MESH_OUTFLOW ? -1.0 : 1.0, 0.0);
            (void)at;
        }
    }
}

/* As the last projection had psi, which is all of the pressure with a surface: by the quadratic of
 * three cells the force of an impact was 20 % larger than what the water lost. A start that is
 * projected leaves no pressure. */
void mesh_bc_whole_pressure(const struct fv *s, double *p)
{
    mesh_bc_even(s, true, p);
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (!d->rise || !(s->step.dt > 0.0))
            continue;
        SIDE_PLACES (d, 1, i, j, at, c)
            for (int l = 1; l <= MESH_GHOSTS; l++)
                p[c - l * d->in] += (2 * l - 1) * d->rise[at];
    }
}

/* Whether a level surface meets the face at a slant. 1e-8 of cos^2: 0.006 degrees from horizontal
 * or vertical. */
static bool is_slanting(const struct fv *s, const struct side *d, int64_t c)
{
    const double *g = s->gravity.hydrostatic;
    double S[3];
    grid_face_vector(&s->grid, c + d->face, d->a, S);
    const double gS = vec3_dot(g, S), cosine2 = gS * gS / (vec3_dot(S, S) * vec3_dot(g, g));
    return cosine2 > 1e-8 && cosine2 < 1.0 - 1e-8;
}

/* keep: with the slope of the last call, for fields that are reinitialised. */
void mesh_bc_level(const struct fv *s, bool keep, double *phi)
{
    for (int k = 0; k < s->sides->n; k++) {
        struct side *d = s->sides->side + k;
        if (!d->tilt)
            d->tilt = NEW_IN(s->sides, double, d->width *(d->n[1] + 2 * d->g[1]));
        SIDE_PLACES (d, 1, i, j, at, c) {
            double *q = phi + c;
            if (!keep)
                d->tilt[at] = is_slanting(s, d, c) ? q[0] - q[d->in] : 0.0;
            for (int m = 1; m <= MESH_GHOSTS; m++)
                q[-m * d->in] = q[(m - 1) * d->in] + (2 * m - 1) * d->tilt[at];
        }
    }
}

/* Ghosts by the quadratic through the last three cells, 3 (q_0 - q_1) + q_2. */
static void extended(double *q, int64_t in)
{
    for (int l = 1; l <= MESH_GHOSTS; l++)
        q[-l * in] = 3.0 * (q[(1 - l) * in] - q[(2 - l) * in]) + q[(3 - l) * in];
}

/* One ghost, by the polynomial of the cells inside. */
void mesh_bc_extend(const struct fv *s, double *q)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES (d, 1, i, j, at, c) {
            extended(q + c, d->in);
            (void)at;
        }
    }
}

/* Outflows have their pressure on the face, the rest is extrapolated. */
void mesh_bc_pressure(const struct fv *s, double *p)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES (d, 1, i, j, at, c) {
            if (d->kind == MESH_OUTFLOW)
                ghosts_given(p + c, d->in, d->pressure);
            else
                extended(p + c, d->in);
            (void)at;
        }
    }
}

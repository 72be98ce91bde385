/* block_ops.c - the operators of a stage on structured blocks of any shape that are joined or
 * overlap. Fills the table flow_ops for blocks: what the integrators of fv/time call in each stage,
 * in the order of the table. The arithmetic is in mesh_ops.c; here are the ghosts and neighbours
 * that each operator needs: halo and fringe (mesh_fill), sides (mesh_bc_*), imposed cells (given_*,
 * forcing_*) and the surface. In 2D and 3D alike; every function that fills ghosts is collective.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "flow_ops.h"
#include "helmholtz.h"
#include "mesh_ops.h"
#include "operators.h"

/* Needed with the upwind bias or with overlaps alone: elsewhere nothing excites the odd-even
 * mode. */
static bool smooth_pressure(struct fv *s)
{
    if (!(s->prm.upwind > 0.0) && !s->m->has_fringe)
        return false;
    mesh_smooth_pressure(s);
    return true;
}

/* Imposed cells continue p by a cubic. */
static void pressure_gradient(struct fv *s, double *p, double *const g[3])
{
    mesh_bc_pressure(s, p);
    mesh_gradient(s, p, g);
    if (s->forcing)
        given_gradient(s, CONTINUE_CUBIC, p, g);
}

/* The right side is 0 in cells that are not computed. Where volumes differ, averages over volumes
 * become averages over indices, whose neighbours must be known: hence halo, surface, imposed cells
 * and sides before mesh_to_index. */
static void to_index(struct fv *s)
{
    for (int a = 0; a < s->dim; a++)
        FLOW_ROWS (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                s->rhs[a][i] *= s->free[i];
    if (!s->m->uneven)
        return;
    mesh_fill(s->m, s->dim, s->rhs);
    for (int a = 0; a < s->dim; a++) {
        if (s->surface) /* its slope goes on beyond the surface */
            extension_scalar(s, s->rhs[a]);
        if (s->forcing)
            forcing_extend(s, 1, s->rhs[a]);
        mesh_bc_even(s, false, s->rhs[a]);
        mesh_to_index(s, s->rhs[a], s->flux);
    }
}

static void viscous(struct fv *s, int q, double *out) { mesh_viscous(s, s->u[q], out); }

/* The increment of the stage before, scaled, is the start. Imposed cells start with what they
 * change from s->u to time t. */
static bool solve_viscous(struct fv *s, double c, double t, double scale)
{
    const double share = viscous_keeps_increment(s) ? scale : 0.0;
    for (int a = 0; a < s->dim; a++)
        FLOW_ROWS (s, at, n)
            for (int64_t i = at; i < at + n; i++)
                s->delta[a][i] *= share;
    if (s->forcing) {
        forcing_velocity(s, t, s->delta);
        forcing_subtract(s->forcing, s->u, s->delta);
    }
    return mesh_viscous_solve(s, c, helmholtz_tolerance(s));
}

static double *divergence(struct fv *s, double tau)
{
    (void)tau; /* the solve has it */
    mesh_divergence(s, s->U, s->flux);
    return s->flux;
}

/* Ghosts of psi at sides have zero gradient; imposed cells mirror their computed neighbours. */
static void psi_ghosts(struct fv *s, double *psi)
{
    if (s->forcing)
        given_mirror(s, psi);
    else
        mesh_halo(s->m, 1, &psi);
    mesh_bc_even(s, true, psi);
}

/* First the fluxes, by the same differences as the pressure matrix, so that div U = 0 to the
 * solver's tolerance; then grad psi for the cells, in rhs, by the fourth-order gradient. */
static void correct_fluxes(struct fv *s, double tau, double *psi)
{
    mesh_subtract_psi(s, tau, psi, s->U);
    levels_ghosts(s, psi);
    if (s->surface)
        mesh_bc_slope_ghosts(s, tau, psi);
    mesh_gradient(s, psi, s->rhs);
    if (s->forcing)
        given_gradient(s, s->forcing->whole ? CONTINUE_CUBIC : CONTINUE_EVEN, psi, s->rhs);
    if (s->surface)
        surface_mesh_psi_gradient(s, tau, psi, false, s->rhs);
}

/* As the second half of correct_fluxes, for a change of psi; nothing is imposed at outflows. */
static void change_gradient(struct fv *s, double *phi, double *const g[3])
{
    mesh_gradient(s, phi, g);
    if (s->forcing)
        given_gradient(s, CONTINUE_EVEN, phi, g);
    if (s->surface)
        surface_mesh_psi_gradient(s, 1.0, phi, true, g);
}

/* layer[c] is 0 in water: both cells beside the face must be dry. Sides are set last. */
static void dry_fluxes(struct fv *s, bool stencils)
{
    (void)stencils;
    const unsigned char *layer = s->surface->layer;
    mesh_face_velocities(s, s->u, s->rhs);
    for (int a = 0; a < s->dim; a++)
        for (int q = 0; q < s->grid.nparts; q++) {
            const struct part *p = s->grid.part + q;
            int down[3], up[3];
            for (int t = 0; t < 3; t++)
                down[t] = up[t] = t < s->dim && t != a;
            up[a] = 1;
            PART_ROWS (p, down, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    if (layer[i] && layer[i - p->stride[a]])
                        s->U[a][i] = s->rhs[a][i];
        }
    mesh_bc_fluxes(s, s->U);
}

/* Into most: largest sum over the indices of the rates of crossing cells, 1/s; square of the
 * largest speed; what forces add to the rate in a second; largest speed times a cell's size. Of a
 * part whose cells are all alike and at rest. false: some value is not finite. most[0 .. 3] are
 * raised, so that all parts can share them. */
static bool measure_alike(const struct fv *s, const struct part *p, double push, double most[4])
{
    const struct mesh *m = s->m;
    const int64_t first = part_at(p, 0, 0, 0);
    const double V = m->V[first];
    double w[3] = {0.0, 0.0, 0.0}, rise = 0.0, least = INFINITY, rate = 0.0, u2 = 0.0;
    int64_t bad = 0;
    for (int a = 0; a < m->dim; a++) {
        const double S = fabs(m->S[a][a][first]);
        w[a] = S / V;
        rise +=
            w[a] * (fabs(s->gravity.periodic[a] + (s->surface ? s->gravity.hydrostatic[a] : 0.0)) +
                    fmax(push, 0.0));
        least = fmin(least, S);
    }
    const double third = m->dim == 3 ? 1.0 : 0.0;
    const double *restrict u = s->u[0], *restrict v = s->u[1],
                           *restrict z = s->u[m->dim == 3 ? 2 : 1], *restrict f = s->free;
    PART_ROWS (p, no_layers, no_layers, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const double sum = f[i] * (fabs(u[i]) * w[0] + fabs(v[i]) * w[1] + fabs(z[i]) * w[2]),
                         square = f[i] * (u[i] * u[i] + v[i] * v[i] + third * z[i] * z[i]);
            rate = sum > rate ? sum : rate;
            u2 = square > u2 ? square : u2;
            bad |= square < 1e300 ? 0 : 1;
        }
    most[0] = fmax(most[0], rate);
    most[1] = fmax(most[1], u2);
    most[2] = fmax(most[2], rise);
    most[3] = fmax(most[3], sqrt(u2) * V / least);
    return bad == 0;
}

/* The same of all parts. Then over sides and moving blocks, and over all ranks by one reduction. On
 * blocks only s->max.u[0] is set, the largest |u|. */
static void measure_blocks(struct fv *s, double push, double motion)
{
    const struct mesh *m = s->m;
    double most[4] = {0.0}, speed = 0.0, poison = 0.0;
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        const bool moves = m->block[p->block].motion != NULL;
        if (p->kind == PART_EVEN && !moves) {
            poison = measure_alike(s, p, push, most) ? poison : NAN;
            continue;
        }
        PART_ROWS (p, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++) {
                double u2 = 0.0, rate = 0.0, rise = 0.0, least = INFINITY;
                if (s->free[i] == 0.0)
                    continue;
                for (int a = 0; a < m->dim; a++) {
                    /* the cell moves, too: what crosses its faces is relative to their own flux */
                    double F = moves ? -0.5 * (m->grid[a][i] + m->grid[a][i + p->stride[a]]) : 0.0,
                           G = 0.0, S2 = 0.0;
                    for (int k = 0; k < m->dim; k++) {
                        const double S = 0.5 * (m->S[a][k][i] + m->S[a][k][i + p->stride[a]]);
                        F += s->u[k][i] * S;
                        G += (s->gravity.periodic[k] +
                              (s->surface ? s->gravity.hydrostatic[k] : 0.0)) *
                             S;
                        S2 += S * S;
                    }
                    rate += fabs(F);
                    rise += fabs(G) + (push > 0.0 ? push * sqrt(S2) : 0.0);
                    least = S2 < least ? S2 : least;
                    u2 += s->u[a][i] * s->u[a][i];
                    poison += 0.0 * s->u[a][i];
                }
                most[0] = rate > most[0] * m->V[i] ? rate / m->V[i] : most[0];
                most[1] = u2 > most[1] ? u2 : most[1];
                most[2] = rise > most[2] * m->V[i] ? rise / m->V[i] : most[2];
                if (u2 * m->V[i] * m->V[i] > most[3] * most[3] * least)
                    most[3] = sqrt(u2 / least) * m->V[i];
            }
    }
    most[1] = poison == 0.0 ? sqrt(most[1]) : INFINITY;
    most[0] = fmax(most[0], mesh_bc_rate(s, &speed));
    most[0] = fmax(most[0], motion);
    MPI_Allreduce(MPI_IN_PLACE, most, 4, MPI_DOUBLE, MPI_MAX, m->comm);
    s->max.rate = most[0];
    s->max.u[0] = most[1];
    s->max.rise = most[2];
    s->max.Re = most[3] / fmax(s->nu, 1e-300);
}

const struct flow_ops block_ops = {.smooth_pressure = smooth_pressure,
                                   .pressure_gradient = pressure_gradient,
                                   .set_slip = mesh_bc_set_slip,
                                   .convection = mesh_convection,
                                   .viscous = viscous,
                                   .to_index = to_index,
                                   .solve_viscous = solve_viscous,
                                   .face_velocities = mesh_face_velocities,
                                   .divergence = divergence,
                                   .psi_ghosts = psi_ghosts,
                                   .correct_fluxes = correct_fluxes,
                                   .change_gradient = change_gradient,
                                   .dry_fluxes = dry_fluxes,
                                   .measure = measure_blocks,
                                   .face_force = mesh_face_force,
                                   .face_power = mesh_face_power};

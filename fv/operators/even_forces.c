/* even_forces.c - force of the flow on a face of a wall or of a box that is cut out of uniform
 * cells or layers, and the work that comes in through one of a side.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/fv_boundary.h"
#include "face_share.h"
#include "operators.h"

/* Pressure on a wall beside the cells p[0] to p[2], as the gradient has it: its ghosts are mirrored
 * behind a slip wall, and under a surface (face_share.h), else those of the quadratic
 * (forcing_fixes.c). */
static double wall_pressure(const double p[3], bool mirrors)
{
    return mirrors ? (7.0 * p[0] - p[1]) / 6.0 : (11.0 * p[0] - 7.0 * p[1] + 2.0 * p[2]) / 6.0;
}

/* 12 h times the slope of component q along `in', i.e. inwards, in the cell beside a wall; ghosts
 * stand behind sides, those behind boxes are made here. Across a slip face it is not 0 where the
 * flow along it changes. */
static double slope_at(const struct fv *s, int q, const struct side_face *f)
{
    const double *u = s->u[q] + f->cell;
    double ghost[2] = {u[-f->in], u[-2 * f->in]};
    for (int k = 0; k < 2 && f->body; k++)
        ghost[k] = blocked_ghost(u, f->in, k + 1, blocked_rule(s, f->body - 1, q, f->a));
    return 15.0 * (u[0] - ghost[0]) - (u[f->in] - ghost[1]);
}

/* Change of phi over the cell along t; beside a side that is closed or a box, where ghosts mirror,
 * from the other neighbour. */
static double phi_slope(const struct fv *s, int64_t c, const int *at, int t)
{
    const struct block *b = &s->b;
    const double *phi = s->surface->phi + c;
    const int64_t d = b->stride[t];
    const int i = b->lo[t] + at[t];
    const bool below = (i > 0 || b->periodic[t]) && !is_blocked(s, c - d);
    const bool above = (i < b->cells[t] - 1 || b->periodic[t]) && !is_blocked(s, c + d);
    const double up = above ? phi[d] - phi[0] : 0.0, down = below ? phi[0] - phi[-d] : 0.0;
    return above && below ? 0.5 * (up + down) : up + down;
}

/* Share of the face that is wet, as on blocks (mesh_forces.c); phi at its centre is extrapolated
 * from the first two cells by half a cell. */
static double wet_share(const struct fv *s, const struct side_face *f, const int *at, double xi[3],
                        double edge[3])
{
    double slope[3] = {0.0};
    if (!s->surface)
        return 1.0;
    for (int t = 0; t < s->dim; t++)
        slope[t] = t == f->a ? 0.0 : phi_slope(s, f->cell, at, t);
    const double *phi = s->surface->phi + f->cell;
    return face_wet_share(s->dim, f->a, 0.5 * (3.0 * phi[0] - phi[f->in]), slope, xi, edge);
}

/* Hydrostatic pressure at xi of the face, Pa. */
static double still_at(const struct fv *s, const struct side_face *f, const int *at,
                       const double xi[3])
{
    double x[3];
    block_centre(&s->b, at[0], at[1], at[2], x);
    for (int t = 0; t < s->dim; t++)
        x[t] +=
            block_size(&s->b, t, at[t]) * (t == f->a ? (f->side % 2 ? 0.5 : -0.5) : xi[t] - 0.5);
    return fv_still_pressure(s, x);
}

/* The fluxes of the momentum equation, so that walls take what the flow loses. On a dry wall acts
 * nothing, nor on a box's face that lets air in; beside one that is wet the cell's own pressure
 * counts; of a face that the surface crosses the wet share, whose water is at rest where the cell's
 * centre is of air and has no pressure. With p the pressure on the wall, out the outward direction
 * and d/dn inwards, F_a += out A (p + rho g.(x - level) + p_partners),   F_q += A mu du_q/dn. */
void even_face_force(const struct fv *s, const struct side_face *f, double sum[4])
{
    const struct block *b = &s->b;
    const int64_t c = f->cell, in = f->in;
    const double out = f->side % 2 ? 1.0 : -1.0, mu = s->run->scene.fluid.rho * s->nu;
    const bool mirrors = f->kind == MESH_SLIP || face_mirrors_pressure(s);
    double p[3], xi[3] = {0.5, 0.5, 0.5}, edge[3] = {0.5, 0.5, 0.5};
    int at[3];
    bool deep = true;
    if (is_blocked(s, c) || (f->body && blocked_vents(s, f->a, c, f->side % 2)))
        return;
    part_index(f->part, c, at);
    const double share = wet_share(s, f, at, xi, edge), area = share * f->flow_area;
    if (face_is_dry(s, c) && share > 0.0 && share < 1.0)
        sum[f->a] += out * area * (still_at(s, f, at, xi) - still_at(s, f, at, edge));
    if (face_is_dry(s, c))
        return;
    for (int n = 1; n < 4; n++)
        deep = deep && !face_is_dry(s, c + n * in) && !(f->body && is_blocked(s, c + n * in));
    for (int n = 0; n < 3; n++)
        p[n] = fv_pressure(s, deep ? c + n * in : c);
    sum[f->a] +=
        out * area * (wall_pressure(p, mirrors) + still_at(s, f, at, xi) + s->partners.pressure);
    for (int q = 0; q < b->dim; q++)
        sum[q] += area * mu / (12.0 * block_size(b, f->a, at[f->a])) * slope_at(s, q, f);
    side_friction_force(s, f, share, sum);
}

/* The fluxes of energy, of pressure and of friction on the face: values there by the scheme's own
 * interpolation into the ghosts, pressure by the cubic. -out U (u^2/2 + p/rho) A - nu A sum u
 * du/dn, m^(dim+2)/s^3: positive where energy comes in. */
double even_face_power(const struct fv *s, const struct side_face *f)
{
    const double out = f->side % 2 ? 1.0 : -1.0, rho = s->run->scene.fluid.rho;
    const int64_t c = f->cell, in = f->in;
    double p[4], square = 0.0, friction = 0.0;
    for (int n = 0; n < 4; n++)
        p[n] = fv_pressure(s, c + n * in) / rho;
    for (int q = 0; q < s->dim; q++) {
        const double *u = s->u[q] + c;
        const double w = (7.0 * (u[0] + u[-in]) - (u[in] + u[-2 * in])) / 12.0;
        const double slope = slope_at(s, q, f) / (12.0 * grid_height(&s->grid, c, f->a));
        square += w * w;
        friction -= s->nu * w * slope;
    }
    const double pf = (25.0 * p[0] - 23.0 * p[1] + 13.0 * p[2] - 3.0 * p[3]) / 12.0;
    return f->flow_area * (friction - out * s->U[f->a][f->face] * (0.5 * square + pf));
}

/* fv_watches.c - what is looked at in the flow, on any grid: energy, odd-even waves, a surface or a
 * lid that went. Called at the end of every step (fv_watches_look); most figures are sums over all
 * cells and one reduction, hence every 10, 20 or 50 steps. watches.c judges them. The energy's
 * account is
 *   E(t) - E(0) = int (power of gravity + openings + walls + zones) dt - dissipation,
 * so that E less the work may only fall; powers are over rho, m^(dim+2)/s^3.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "watches.h"

#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"

/* Of openings under a surface, over the energy of the scene's velocity. Measured: an outlet that
 * drains half of its tank's depth at once 0.018, all else below 0.003; water that ran in through an
 * outflow, 22 m/s in a current of 0.4 m/s, 0.06. */
#define OPEN_GAIN 0.03

/* Whether no side and no surface does work: bits below MESH_WALL are overlaps, joins and
 * periods. */
static bool is_periodic(const struct fv *s, unsigned sides)
{
    return !s->surface && !s->blocked && sides < 1u << MESH_WALL;
}

/* Whether a wall moves along itself, on any rank. */
static bool walls_slide(const struct fv *s) { return ranks_any(s->comm, sides_slide(s)); }

/* Cells that a partner or the exact solution fills do work that no budget knows, as do walls that
 * move beside a surface; nor is there one in pseudo-time or with sound. Where blocks overlap the
 * edge of what counts goes from cell to cell, 1.4 % of the energy of vortices that cross it at 45
 * degrees: three times the level of warning. Where a surface crosses such blocks, or cells at a
 * slant, the work of gravity is known to a few per cent: ten times. */
struct watches *fv_watches_create(const struct fv *s)
{
    const unsigned sides = sides_kinds(s);
    const bool overlaps = grid_overlaps(&s->grid);
    const bool filled = s->run->coupled || s->prm.hole[1][0] > s->prm.hole[0][0],
               open = sides_open(s), slides = walls_slide(s), moves = grid_moves(&s->grid);
    struct watches *w = watches_create(s->run, &s->prm, is_periodic(s, sides), s->surface != NULL);
    if (s->surface && (overlaps || surface_any_inclined(s))) {
        w->energy.warn *= 10.0;
        w->least = 1e-6; /* work of rough velocities that hardly move is not known at all */
    } else if (overlaps) {
        w->energy.warn *= 3.0;
        w->least = 1e-6;
    }
    if (overlaps && s->surface)
        w->energy.likely = "the step or the cells are too large for this flow (fv.cfl at half its "
                           "value tells which), or a block ends where the surface runs along its "
                           "side: let it end some cells further up or down";
    if (moves) /* the first look may find a flow that turns round: a seventh of its walls' speed */
        w->least_square = 2e-2;
    if (open)
        watches_open(w);
    if (open && s->surface) { /* that open at once do more work than their flow will ever have */
        w->least = 1.0;
        w->energy.warn = fmax(w->energy.warn, OPEN_GAIN);
    }
    w->has_energy =
        !filled && !moves && !s->prm.steady && s->prm.c0 == 0.0 && !(s->surface && slides);
    w->has_growth = !s->run->coupled && !moves && !s->surface && !s->newton;
    if (s->sides) { /* faces are mapped anew; walls and openings of blocks count, too */
        w->energy_every = 20;
        w->speed = fmax(w->speed, s->speed.reference);
    }
    if (s->surface) /* whose steps are long beside the period of short waves' work, and expensive */
        w->energy_every = 1;
    return w;
}

/* --- energy --- */

/* Sums of a row of cells: velocity and its square, times the weights (NULL: 1). sums[0 .. 2]: u,
 * [3]: u^2/2, [4]: the weights themselves. */
static void add_row(const struct fv *s, int64_t c, int64_t n, const double *weight, double *sums)
{
    for (int a = 0; a < s->dim; a++) {
        const double *restrict u = s->u[a] + c;
        double first = 0.0, second = 0.0;
        for (int64_t i = 0; i < n; i++) {
            const double w = weight ? weight[i] : 1.0;
            first += w * u[i];
            second += w * u[i] * u[i];
        }
        sums[a] += first;
        sums[3] += 0.5 * second;
    }
    for (int64_t i = 0; i < n; i++)
        sums[4] += weight ? weight[i] : 1.0;
}

/* Share of water in a row of cells where phi is all that is known: as if the surface were parallel
 * to one of their faces, to tell mixed cells. share = 1/2 - phi/|step of phi across the cell|, cut
 * to [0, 1]. */
static void share_row(const struct fv *s, int64_t c, int64_t n, double *restrict wet)
{
    const struct block *b = &s->b;
    const double *restrict phi = s->surface->phi + c;
    const int64_t dy = b->stride[1], dz = b->dim == 3 ? b->stride[2] : 0;
    for (int64_t i = 0; i < n; i++) {
        const double across = fabs(phi[i + 1] - phi[i - 1]) + fabs(phi[i + dy] - phi[i - dy]) +
                              fabs(phi[i + dz] - phi[i - dz]) + 1e-300;
        const double share = 0.5 - 2.0 * phi[i] / across;
        wet[i] = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
    }
}

/* Fractions where they are carried; else by phi, and exactly in mixed cells. */
static void water_of_row(const struct fv *s, int64_t c, int64_t n, double *w)
{
    const struct fraction *f = s->surface->fraction;
    const bool carried = f && f->carries > 0.0;
    if (carried)
        memcpy(w, f->C + c, (size_t)n * sizeof(double));
    else
        share_row(s, c, n, w);
    for (int64_t i = 0; i < n && !carried; i++)
        if (s->blocked || (w[i] > 0.0 && w[i] < 1.0)) /* phi in a box says nothing */
            w[i] = surface_share(s, c + i);
}

/* What the cells of a row count beside block_volume, m^dim on blocks, each place once where they
 * overlap; NULL: 1. */
static double *weights_of_row(const struct fv *s, int64_t c, int64_t n, int j)
{
    double *w = s->flux + c; /* scratch */
    const bool *twice = s->m && !s->surface ? mesh_twice(s->run, s->m, true) : NULL;
    if (s->surface && !s->m)
        water_of_row(s, c, n, w);
    for (int64_t i = 0; i < n && s->m; i++)
        w[i] = s->surface ? surface_cell_volume(s, c + i, j) * surface_water(s, c + i)
                          : s->free[c + i] * grid_volume(&s->grid, c + i);
    for (int64_t i = 0; i < n && twice; i++)
        w[i] = twice[c + i] ? 0.0 : w[i];
    return s->surface || s->m ? w : NULL;
}

/* Weights on blocks have the volume already. */
static double volume_of_row(const struct fv *s, int j)
{
    return s->m ? 1.0 : block_volume(&s->b, j);
}

/* int u_a dV of a cell by the fluxes of its faces, sum of (x_f - x_c) U_f, over its volume: what
 * the surface follows; beside an edge averages miss it by tenths. On uniform cells that is the mean
 * of the two faces. */
static double by_faces(const struct fv *s, const struct part *p, int64_t c, int a)
{
    if (!s->m)
        return 0.5 * (s->U[a][c] + s->U[a][c + p->stride[a]]);
    const double *x = s->surface->mesh->x[a];
    double sum = 0.0;
    for (int b = 0; b < s->dim; b++) {
        const int64_t d = p->stride[b];
        sum += 0.5 * ((x[c] - x[c - d]) * s->U[b][c] + (x[c + d] - x[c]) * s->U[b][c + d]);
    }
    return sum / grid_volume(&s->grid, c);
}

/* Momentum of a row of cells, times the weights: that which gravity works on. */
static void momentum_of_row(const struct fv *s, const struct part *p, int64_t c, int64_t n,
                            const double *weight, double *sums)
{
    for (int a = 0; a < s->dim; a++) {
        sums[a] = 0.0;
        for (int64_t i = c; i < c + n; i++) {
            const bool flows = s->surface->layer[i] == 0 && (!s->free || s->free[i] > 0.0);
            if (weight[i - c] > 0.0)
                sums[a] += weight[i - c] * (flows ? by_faces(s, p, i, a) : s->u[a][i]);
        }
    }
}

/* m^2/s^2: kinetic energy and pressure of the water in a cell at an opening, times its share. */
static double head_of(const struct fv *s, int64_t c, int64_t in)
{
    const double held = carried_held(s, c, in),
                 share = surface_counted(s, c, held >= 0.0 ? held : surface_water(s, c));
    double square = 0.0, x[3];
    if (s->surface->layer[c] || share == 0.0)
        return 0.0;
    for (int a = 0; a < s->dim; a++)
        square += s->u[a][c] * s->u[a][c];
    grid_place(&s->grid, c, x);
    return share *
           (0.5 * square + (fv_pressure(s, c) + fv_still_pressure(s, x)) / s->run->scene.fluid.rho);
}

/* What water brings in through openings less what it takes along. This rank's. */
static double power_of_openings(const struct fv *s)
{
    double sums[2] = {0.0, 0.0};
    sides_passing(s, head_of, sums);
    return sums[0];
}

/* sums[0 .. 2] momentum, [3] kinetic energy, [4] volume, [5] power; this rank. */
static void sum_energy(struct fv *s, double sums[6])
{
    FLOW_NEAR_AT (s, part, j, c, n) {
        double row[6] = {0.0};
        const double *weight = weights_of_row(s, c, n, j);
        add_row(s, c, n, weight, row);
        if (s->surface)
            momentum_of_row(s, part, c, n, weight, row);
        if (s->watches->zone_power)
            row[5] = lanes_dot_any(weight, s->watches->zone_power + c, n);
        for (int m = 0; m < 6; m++)
            sums[m] += volume_of_row(s, j) * row[m];
    }
    if (s->surface)
        sums[5] += power_of_openings(s);
    else if (!s->watches->periodic)
        sums[5] = flow_power(s);
}

/* Gravity's power is g.(momentum); with a surface across closed sides as well. Collective. */
static struct flow_energy energy_of(struct fv *s)
{
    double sums[6] = {0.0};
    sum_energy(s, sums);
    for (int a = 0; a < s->dim; a++)
        sums[5] +=
            (s->gravity.periodic[a] + (s->surface ? s->gravity.hydrostatic[a] : 0.0)) * sums[a];
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    return (struct flow_energy){.kinetic = sums[3],
                                .momentum = {sums[0], sums[1], sums[2]},
                                .volume = sums[4],
                                .power = sums[5]};
}

/* --- waves of two cells: fourth differences over 16, 1 on them, 5e-4 on waves of eight. On blocks
 * cells count alike: far ones, much larger, would drown those that matter --- */

/* 1 where something flows, 0 behind closed sides, too. 1 or 0, with ghosts; s->flux is scratch. */
static const double *mask_of(struct fv *s)
{
    const unsigned char *air = s->surface ? s->surface->layer : NULL,
                        *forced = s->forcing ? s->forcing->forced : NULL;
    const struct part *p = &s->whole;
    if (s->m)
        return s->free;
    PART_ROWS_AT (p, p->g, p->g, j, k, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const int at[3] = {(int)(i - c) - p->g[0], j, k};
            bool in = !(air && air[i]) && !(forced && forced[i]);
            for (int a = 0; a < s->dim && in; a++)
                in = (at[a] >= 0 || !block_has_side(&s->b, 2 * a)) &&
                     (at[a] < p->n[a] || !block_has_side(&s->b, 2 * a + 1));
            s->flux[i] = in;
        }
    return s->flux;
}

/* Along axis a, of cells whose neighbours flow, too (on blocks: on this rank). */
static double squares(const struct fv *s, const double *q, int a, const double *flows)
{
    double sum = 0.0;
    FLOW_ROWS_AT (s, part, j, c, n) {
        const int64_t d = part->stride[a];
        double row = 0.0;
        for (int64_t i = c; i < c + n; i++) {
            const double v =
                (q[i - 2 * d] + q[i + 2 * d]) - 4.0 * (q[i - d] + q[i + d]) + 6.0 * q[i];
            const double in =
                flows[i - 2 * d] * flows[i - d] * flows[i] * flows[i + d] * flows[i + 2 * d];
            row += in > 0.0 ? v * v : 0.0;
        }
        sum += volume_of_row(s, j) * (row / 256.0);
    }
    return sum;
}

/* Sum of squares, and the sum, of what flows. */
static void moments(const struct fv *s, const double *q, const double *flows, double sums[3])
{
    sums[0] = sums[1] = sums[2] = 0.0;
    FLOW_ROWS_AT (s, part, j, c, n) {
        double row[3] = {0.0};
        for (int64_t i = c; i < c + n; i++) {
            const double v = flows[i] > 0.0 ? q[i] : 0.0;
            row[0] += flows[i];
            row[1] += v;
            row[2] += v * v;
        }
        for (int m = 0; m < 3; m++)
            sums[m] += volume_of_row(s, j) * row[m];
    }
}

/* The fourth difference over 16 passes a wave of two cells whole. sums[0, 1] velocity, [2]
 * pressure, [3 .. 5] volume, sum and squares of the pressure; this rank. */
static void sum_waves(struct fv *s, double sums[6])
{
    const double *flows = mask_of(s);
    double of[3];
    if (!s->m)
        block_halo(&s->b, 1, &s->p);
    for (int q = 0; q < s->dim; q++) {
        for (int a = 0; a < s->dim; a++)
            sums[0] += squares(s, s->u[q], a, flows);
        moments(s, s->u[q], flows, of);
        sums[1] += of[2];
    }
    for (int a = 0; a < s->dim; a++)
        sums[2] += squares(s, s->p, a, flows);
    moments(s, s->p, flows, sums + 3);
}

/* The pressure's own size is about its mean. Collective. */
static void look_at_waves(struct fv *s, int64_t step, struct diagnosis *d)
{
    double sums[6] = {0.0};
    sum_waves(s, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    const struct flow_waves v = {sums[0], sums[1], sums[2],
                                 sums[5] - sums[4] * sums[4] / fmax(sums[3], 1e-300)};
    watches_waves(s->watches, &v, sums[3], s->t, step, d);
}

/* Once more at the end, so that the summary has a last value. */
void fv_watches_end(struct fv *s)
{
    struct diagnosis d = {0};
    look_at_waves(s, s->run->step, &d);
    watches_summarise(s->watches, s->run->summary);
}

/* Once: with an outlet it flows on, as in a pipe, but the level that the case has is gone. cuts and
 * wet are of all ranks. */
static void look_for_surface(struct fv *s, int64_t step)
{
    struct watches *w = s->watches;
    if (w->filled || s->surface->cuts > 0 || s->surface->wet == 0 || s->surface->forced)
        return;
    w->filled = true;
    log_warn("t = %.4g s, step %lld: no free surface is left, the domain is full of water%s", s->t,
             (long long)step,
             sides_give_inflow(s)
                 ? ": the velocity of an inflow is given whatever the level, so more comes in the "
                   "higher it rises; a higher domain, or less inflow"
                 : "");
}

/* Once: what is left when it has run out through the openings. */
static void look_for_water(struct fv *s, int64_t step)
{
    struct watches *w = s->watches;
    if (w->dry || s->surface->wet > 0 || s->surface->forced)
        return;
    w->dry = true;
    const double left = surface_volume(s);
    log_say("t = %.4g s, step %lld: the water has left, but for %.3g m^%d finer than the cells",
            s->t, (long long)step, left, s->dim);
}

/* A closed side that water has reached. */
struct lid {
    const struct fv *s;
    int side; /* of the domain; -1: no water is there */
};

/* assumed: fv closed the side itself. */
static void look_at_lid(const struct side_face *f, void *with)
{
    struct lid *lid = with;
    if (f->wall && f->wall->assumed && lid->s->surface->layer[f->cell] == 0)
        lid->side = f->wall->side - SIDE_X_MIN;
}

/* Once: a side that fv has closed by itself is meant to have air below it. */
static void look_for_lid(struct fv *s, int64_t step)
{
    struct watches *w = s->watches;
    struct lid lid = {s, -1};
    bool any = false;
    for (int k = 0; k < s->run->scene.nwalls; k++)
        any = any || s->run->scene.walls[k].assumed;
    if (!any || w->lidded)
        return;
    sides_visit(s, look_at_lid, &lid);
    MPI_Allreduce(MPI_IN_PLACE, &lid.side, 1, MPI_INT, MPI_MAX, s->comm);
    w->lidded = lid.side >= 0;
    if (w->lidded)
        log_warn("t = %.4g s, step %lld: water reaches the side %s, which the case leaves open and "
                 "fv has closed: a higher domain, or a wall there",
                 s->t, (long long)step, scene_side_names[lid.side]);
}

/* step counts the one that is just done. */
void fv_watches_look(struct fv *s, struct diagnosis *d)
{
    struct watches *w = s->watches;
    const int64_t step = s->run->step + 1;
    timer_start(&s->run->timers, "watches");
    watches_growth(w, s->max.u[0] + s->max.u[1] + s->max.u[2], s->t, step, d);
    if (watches_want_energy(w, step)) {
        const struct flow_energy e = energy_of(s);
        watches_energy(w, &e, s->t, step, d);
    }
    if (s->surface && watches_want_waves(w, step))
        look_for_lid(s, step);
    if (watches_want_waves(w, step))
        look_at_waves(s, step, d);
    if (s->surface) {
        look_for_surface(s, step);
        look_for_water(s, step);
        watch_judge(&w->returned, fabs(s->surface->returned) / surface_volume_scale(s), s->t, step,
                    d);
    }
    timer_stop(&s->run->timers, "watches");
}

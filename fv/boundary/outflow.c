/* outflow.c - see outflow.h. The velocity on a side is the one that stood U dt inside it at the
 * step's start, by the quadratic through the face's average and those of two cells: third order,
 * and stable at any step. Under a surface the mean over the water goes on with U + sqrt(g H): waves
 * are nearly uniform from the surface to the bottom, and what is not is of the flow; carried as
 * fast as waves, differences between neighbours grow. In a step: outflow_begin fits the lines
 * inside, outflow_set gives w at each stage's time. On the face w goes on as w(t + dt) = q(U dt), q
 * the quadratic w + b x + c x^2 inwards in cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "outflow.h"

#include "../../common/scene/scene.h"
#include "bc.h"
#include "carried.h"
#include "forcing.h"
#include "fv_sides.h"
#include "mesh_bc.h"
#include "outflow_budget.h"

/* Depths that a wave travels while the mean velocity returns to what the level asks for: k h of
 * waves that feel it is below 1, where shallow water is right. */
#define RETURN 2.0

/* Sums what flows out through these faces of this rank, and with the other sides' given fluxes; the
 * side's own sum is kept for the balance of imposed cells. */
static double sum_up(struct fv *s)
{
    double sum = 0.0;
    if (s->m)
        s->outflows->given = mesh_bc_given_flux(s);
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            sum += o->own[i] ? carried_flux(o, s->dim, i) : 0.0;
    s->outflows->all = s->outflows->given + sum;
    if (s->bc)
        s->bc->outflux = s->outflows->all;
    return s->outflows->all;
}

/* Whether something else takes what comes in too much. */
static bool pressure_given(const struct fv *s)
{
    return s->outflows->level_free || sides_give_pressure(s);
}

/* Distributes the net flux of all sides uniformly over the convective ones, so that it is 0. Where
 * cells are imposed their fluxes are corrected instead, and a given pressure lets through what is
 * too much. Collective. */
static void balance(struct fv *s)
{
    double sums[3] = {sum_up(s), 0.0, 0.0}; /* flux, area, forced faces */
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            sums[1] += o->own[i] && o->kind == OUTFLOW_CONVECTS ? carried_area(o, i) : 0.0;
    for (int a = 0; s->forcing && a < s->dim; a++)
        sums[2] += (double)s->forcing->nface[a];
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, s->comm);
    if (pressure_given(s) || sums[2] > 0.0 || sums[1] == 0.0)
        return;
    const double excess = sums[0] / sums[1];
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++) {
            const double area = o->kind == OUTFLOW_CONVECTS ? carried_area(o, i) : 0.0;
            for (int q = 0; q < s->dim && area > 0.0; q++)
                o->w[q][o->place[i]] -= excess * (o->S[q][i] / area);
        }
    sum_up(s);
}

/* Copies w to the field `kept', for restart files. */
static void keep(struct fv *s)
{
    double *const *kept = s->outflows->kept;
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++) {
            for (int q = 0; q < s->dim; q++)
                kept[q][o->cell[i] - o->in] = o->w[q][o->place[i]];
            if (o->stood)
                kept[0][o->cell[i] - 2 * o->in] = o->full[i] > 0.0 ? o->full[i] : -1.0;
        }
}

/* m/s: of a given discharge, over all of a side's water; the air above it moves along. */
static double discharged(const struct fv *s, const struct outflow *o, int q, int64_t i)
{
    const double size = carried_area(o, i), all = s->outflows->area[o->side];
    return size > 0.0 && all > 0.0 ? o->discharge / all * o->S[q][i] / size : 0.0;
}

/* Sets w of an inflow on face i. What a held one brings in is less pure water the more stands
 * inside; where none stood at the start air comes in, and what water is there slides along it. */
static void set_inflow(const struct fv *s, struct outflow *o, int64_t i)
{
    const double area = carried_area(o, i),
                 share = o->stood && o->stood[i] > 0.0 ? o->stood[i] / o->full[i] : 1.0;
    const bool closed = o->stood && o->stood[i] == 0.0 && o->share[i] > 0.0 && area > 0.0;
    double out = 0.0;
    for (int q = 0; q < s->dim && closed; q++)
        out += s->u[q][o->cell[i]] * o->S[q][i] / area;
    for (int q = 0; q < s->dim; q++) {
        double *w = o->w[q] + o->place[i];
        if (closed)
            *w = s->u[q][o->cell[i]] - out * o->S[q][i] / area;
        else if (o->kind == OUTFLOW_GIVEN_IN)
            *w = share * discharged(s, o, q, i);
        else if (o->stood)
            *w = share * o->given[q][i];
    }
}

/* Some discharge that is given and is not 0 now. */
bool outflow_pushes(const struct fv *s)
{
    bool any = false;
    for (int side = SIDE_X_MIN; side < SIDE_X_MIN + 2 * s->dim; side++) {
        const struct scene_wall *w = scene_wall_of(&s->run->scene, side);
        any = any || (w && w->has_discharge && wall_discharge(w, s->t) != 0.0);
    }
    return any;
}

/* The velocity on the face by the three cells inside, to third order; then the balance of volumes,
 * and what a restart has. */
void outflow_start(struct fv *s)
{
    if (!s->outflows)
        return;
    outflow_set_discharges(s, s->t);
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++) {
            for (int q = 0; q < s->dim; q++) {
                const double *u = s->u[q] + o->cell[i];
                if (!carried_comes_in(o))
                    o->w[q][o->place[i]] =
                        o->kind == OUTFLOW_GIVEN_OUT
                            ? discharged(s, o, q, i)
                            : (11.0 * u[0] - 7.0 * u[o->in] + 2.0 * u[2 * o->in]) / 6.0;
                o->change[q][o->place[i]] = 0.0;
            }
            if (carried_comes_in(o))
                set_inflow(s, o, i);
        }
    balance(s);
    keep(s);
}

/* From the first ghosts, where they were kept. */
void outflow_restore(struct fv *s)
{
    if (!s->outflows)
        return;
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++) {
            for (int q = 0; q < s->dim; q++)
                o->w[q][o->place[i]] = s->outflows->kept[q][o->cell[i] - o->in];
            if (o->stood)
                o->full[i] = carried_held(s, o->cell[i], o->in);
        }
    sum_up(s);
}

/* Averages over the first two cells: w + b/2 + c/3 and w + 3 b/2 + 7 c/3. The three unknowns follow
 * from these and w on the face. */
static void take_lines(const struct fv *s, struct outflow *o)
{
    for (int q = 0; q < s->dim; q++)
        for (int64_t i = 0; i < o->n; i++) {
            const double w = o->w[q][o->place[i]], *u = s->u[q] + o->cell[i];
            double *line = o->line[q] + 3 * i;
            line[0] = w;
            line[2] = 0.75 * (u[o->in] - 3.0 * u[0] + 2.0 * w);
            line[1] = u[o->in] - u[0] - 2.0 * line[2];
            if (o->share[i] == 0.0) { /* in air it goes on as it is inside */
                line[0] = u[0];
                line[1] = line[2] = 0.0;
            }
        }
}

/* m/s: mean velocity outwards of the water on each side of the domain. Collective. */
static void mean_velocities(const struct fv *s, double mean[6])
{
    double sums[2][6] = {{0.0}};
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            if (o->own[i]) {
                sums[0][o->side] += o->wet[i] * carried_flux(o, s->dim, i);
                sums[1][o->side] += o->wet[i] * carried_area(o, i);
            }
    MPI_Allreduce(MPI_IN_PLACE, sums, 12, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < 6; k++)
        mean[k] = sums[0][k] / fmax(sums[1][k], 1e-300);
}

/* rest = u - 2 c, the invariant of shallow water that comes in from outside. */
void outflow_meet_level(struct fv *s)
{
    struct outflows *all = s->outflows;
    double mean[6];
    if (!all)
        return;
    mean_velocities(s, mean);
    for (int k = 0; k < 6; k++)
        all->rest[k] = mean[k] - 2.0 * all->waves[k];
}

/* What leaves as it is carried knows no level: all errors of the discharge would stay in the
 * domain. The wave that comes in from outside, u - 2 sqrt(g H) in shallow water, is that of the
 * start for good: the mean velocity returns to what this makes of the level, in the time that a
 * wave takes for RETURN depths. Where the flow is as fast as waves nothing comes in. pull: by how
 * much the mean velocity is off; hurry: how fast it returns, 1/s. */
static void find_pull(const struct fv *s, int k, double mean)
{
    struct outflows *all = s->outflows;
    const double c = all->waves[k], g = vec3_length(s->gravity.hydrostatic);
    all->pull[k] = all->hurry[k] = 0.0;
    if (!(c > 0.0))
        return;
    all->pull[k] = all->rest[k] + 2.0 * c - mean;
    all->hurry[k] = fmax(0.0, 1.0 - fabs(mean) / c) * g / (RETURN * c);
}

/* Only flow outwards carries: flow is at least 0. */
void outflow_begin(struct fv *s)
{
    double mean[6];
    if (!s->outflows)
        return;
    OUTFLOWS (s, o)
        take_lines(s, o);
    mean_velocities(s, mean);
    for (int k = 0; k < 6; k++) {
        s->outflows->flow[k] = fmax(mean[k], 0.0);
        find_pull(s, k, mean[k]);
    }
}

/* The velocity that stood x cells inside at the step's start, at most 1.5: the line ends at 2. */
static double along_line(const struct outflow *o, int q, int64_t i, double distance)
{
    const double x = fmin(distance / o->h[i], 1.5), *line = o->line[q] + 3 * i;
    return line[0] + x * (line[1] + x * line[2]);
}

/* m/s: what the mean velocity of each side's water gains on what stands on it when that goes on
 * with the flow alone: waves, whose velocity is nearly the same from the surface to the bottom, run
 * ahead of it, and the pull; or what a given discharge is more. Collective under a surface. */
static void find_waves(struct fv *s, double dt, double gain[6])
{
    struct outflows *all = s->outflows;
    double sums[2][6] = {{0.0}};
    memset(gain, 0, 6 * sizeof *gain);
    if (!s->surface)
        return;
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++) {
            const double flow = all->flow[o->side] * dt, wave = flow + all->waves[o->side] * dt;
            for (int q = 0; q < s->dim && o->own[i]; q++) {
                const double with = o->kind == OUTFLOW_GIVEN_OUT ? 0.0 : along_line(o, q, i, wave);
                sums[0][o->side] += o->wet[i] * o->S[q][i] * (with - along_line(o, q, i, flow));
            }
            sums[1][o->side] += o->own[i] ? o->wet[i] * carried_area(o, i) : 0.0;
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 12, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < 6; k++)
        gain[k] = (sums[0][k] + all->leaves[k]) / fmax(sums[1][k], 1e-300) +
                  (all->given_out[k] ? 0.0 : all->pull[k] * -expm1(-all->hurry[k] * dt));
}

/* change is the difference to the w before, for increments (BC_CHANGE). */
void outflow_set(struct fv *s, double dt)
{
    double gain[6];
    if (!s->outflows)
        return;
    outflow_set_discharges(s, s->t + dt);
    find_waves(s, dt, gain);
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++) {
            const double area = carried_area(o, i),
                         more = (o->share[i] > 0.0 || o->kind == OUTFLOW_GIVEN_OUT) && area > 0.0
                                    ? gain[o->side] / area
                                    : 0.0;
            for (int q = 0; q < s->dim; q++) {
                double *w = o->w[q] + o->place[i];
                o->change[q][o->place[i]] = -*w;
                if (!carried_comes_in(o))
                    *w = along_line(o, q, i, s->outflows->flow[o->side] * dt) + more * o->S[q][i];
            }
            if (carried_comes_in(o))
                set_inflow(s, o, i);
        }
    balance(s);
    OUTFLOWS (s, o)
        for (int q = 0; q < s->dim; q++)
            for (int64_t i = 0; i < o->n; i++)
                o->change[q][o->place[i]] += o->w[q][o->place[i]];
    keep(s);
}

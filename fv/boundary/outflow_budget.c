/* outflow_budget.c - a given discharge is what passes. The velocity on a side follows from the
 * water in the cells beside it, while what crosses its faces comes of the planes in those cells at
 * each substep: a per cent more or less, of a surface that falls towards an outlet up to five. What
 * has passed is counted, and what the discharge is more than that,
 *   D <- D + int Q dt - passed,
 * is added over the next SETTLE steps: Q' = Q + D/(SETTLE dt), at most by MOST of Q, so that no
 * water is asked for that is not there. Nor is more than A FASTEST sqrt(g H) asked of an outlet.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "outflow_budget.h"

#include "../../common/scene/scene.h"
#include "carried.h"

/* Steps: at once, each step would push the water by what the last one lacked. */
#define SETTLE 10.0
#define MOST 0.1
/* Of water that leaves, over the speed of its waves: none that is drawn away passes faster. */
#define FASTEST 1.4

/* What a held inflow brings in is what is given. */
static bool is_given(const struct outflow *o)
{
    return o->kind != OUTFLOW_CONVECTS && o->kind != OUTFLOW_STEADY && !o->stood;
}

/* m^dim/s: outwards, by the case; 0: none is given. */
static double discharge_of(const struct fv *s, int side, double t)
{
    const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + side);
    if (!w || !w->has_discharge)
        return 0.0;
    return (w->kind == WALL_INFLOW ? -1.0 : 1.0) * wall_discharge(w, t);
}

/* m^dim/s: what a side's discharge is to be more at time t, s, than is given. */
static double settling(const struct fv *s, int side, double t)
{
    const double dt = s->step.dt_now, most = MOST * fabs(discharge_of(s, side, t));
    return dt > 0.0 ? fmax(-most, fmin(most, s->outflows->lacks[side] / (SETTLE * dt))) : 0.0;
}

/* m^dim/s: that the water in an outlet lets through. A tank that is drained to below the critical
 * depth of its outlet ended by a velocity without bound. */
static double passing(const struct fv *s, int side, double out)
{
    const struct outflows *all = s->outflows;
    return s->surface ? fmin(out, FASTEST * all->waves[side] * all->area[side]) : out;
}

/* Once: less leaves than the case says. */
static void tell_shortage(struct fv *s, int side, double t)
{
    struct outflows *all = s->outflows;
    if (all->short_told[side] || !all->given_out[side] ||
        passing(s, side, discharge_of(s, side, t)) >= discharge_of(s, side, t))
        return;
    all->short_told[side] = true;
    const char *const size = s->dim == 2 ? "m" : "m^2";
    const char *const flow = s->dim == 2 ? "m^2/s" : "m^3/s";
    log_warn("t = %.4g s: the water in %s, %.3g %s, is too little for its discharge of %g %s: what "
             "runs there leaves; less discharge, or an outflow with a level",
             t, scene_side_names[side], all->area[side], size, discharge_of(s, side, t), flow);
}

/* By side of the domain: what is given, and what earlier steps lack of it. */
void outflow_set_discharges(struct fv *s, double t)
{
    struct outflows *all = s->outflows;
    double out[6];
    for (int k = 0; k < 6; k++) {
        const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + k);
        out[k] = discharge_of(s, k, t) + settling(s, k, t);
        all->given_out[k] = w && carried_kind(w) == OUTFLOW_GIVEN_OUT;
        out[k] = all->given_out[k] ? passing(s, k, out[k]) : out[k];
        all->leaves[k] = fmax(out[k], 0.0);
    }
    for (int k = 0; k < all->n; k++)
        if (all->of[k].side < 6)
            all->of[k].discharge = out[all->of[k].side];
}

/* Of a sweep: volume is what crossed a face along the block's axis. */
void outflow_count_volumes(struct fv *s, const int *axis, const double *volume)
{
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n && is_given(o); i++)
            if (o->own[i] && o->a == axis[grid_part(&s->grid, o->cell[i], NULL)->block])
                s->outflows->passed[o->side] +=
                    (o->in < 0 ? 1.0 : -1.0) * volume[o->cell[i] + o->face];
}

/* Without sweeps: the flux times the share of it that is water. */
void outflow_count_flows(struct fv *s, double dt,
                         double (*share)(const struct fv *s, int64_t c, int64_t in))
{
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n && is_given(o); i++) {
            const double size = s->m ? 1.0 : carried_area(o, i);
            if (o->own[i])
                s->outflows->passed[o->side] += (o->in < 0 ? dt : -dt) * size *
                                                share(s, o->cell[i], o->in) *
                                                s->U[o->a][o->cell[i] + o->face];
        }
}

/* What lacks is bounded, so that a side which was dry for long does not gush. */
void outflow_settle(struct fv *s, double dt)
{
    struct outflows *all = s->outflows;
    double passed[6];
    bool any = false;
    for (int k = 0; k < 6 && all; k++) {
        const struct scene_wall *w = scene_wall_of(&s->run->scene, SIDE_X_MIN + k);
        any = any || (w && w->has_discharge);
    }
    if (!any)
        return;
    MPI_Allreduce(all->passed, passed, 6, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < 6; k++) {
        const double given = 0.5 * (discharge_of(s, k, s->t - dt) + discharge_of(s, k, s->t));
        const double most = MOST * SETTLE * dt * fabs(given);
        const double lacks = all->lacks[k] + dt * given - passed[k];
        all->lacks[k] = all->held[k] ? 0.0 : fmax(-most, fmin(most, lacks));
    }
    for (int k = 0; k < 6; k++)
        tell_shortage(s, k, s->t);
    memset(all->passed, 0, sizeof all->passed);
}

/* With the state, for a step that is done again. */
void outflow_keep_budget(struct fv *s)
{
    if (!s->outflows)
        return;
    memcpy(s->outflows->lacks_before, s->outflows->lacks, sizeof s->outflows->lacks);
    memset(s->outflows->passed, 0, sizeof s->outflows->passed);
}

void outflow_budget_back(struct fv *s)
{
    if (!s->outflows)
        return;
    memcpy(s->outflows->lacks, s->outflows->lacks_before, sizeof s->outflows->lacks);
    memset(s->outflows->passed, 0, sizeof s->outflows->passed);
}

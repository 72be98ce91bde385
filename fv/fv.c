/* fv.c - main program of the finite-volume solver. SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include "../coupler/cpl_partner.h"
#include "boundary/fv_boundary.h"
#include "case/fv_case.h"
#include "coupling/fv_coupling.h"
#include "output/fv_output.h"
#include "surface/fv_surface.h"
#include "time/fv_time.h"
#include "watch/fv_watch.h"

static void describe_rows(const struct run *r)
{
    const struct fv_params *prm = fv_params_of(r);
    const struct scene_domain *d = &r->scene.domain;
    const int n = prm->cells[1], even = (int)prm->graded[1];
    double *h = NEW(double, n);
    const double ratio =
        rows_heights(n, even, prm->graded[0] - d->min[1], d->max[1] - d->min[1], h);
    log_say("layers: %d of %g m above y = %g m, %d below it that grow to %g m, by %.1f %% from one "
            "to the next at most",
            even, h[n - 1], prm->graded[0], n - even, h[0], 100.0 * (ratio - 1.0));
    mem_free(h);
}

/* Of a cell and step with a free surface in 2D and 3D, over those without: dam breaks, a breaking
 * wave, sloshing. */
static const double surface_cost[] = {2.0, 4.0};

/* Run time of rk3 and bdf2, with which the figures were measured: of a surface with the steps of
 * the fastest flow where water falls or runs. */
static void say_forecast(const struct run *r, const struct fv_params *prm, double cells,
                         double least, double dt)
{
    const int dim = r->scene.domain.dim;
    double rate = 1.0 / dt;
    if (prm->integrator == INTEGRATOR_NEWTON)
        return;
    if (prm->water && !scene_makes_waves(&r->scene))
        rate = fmax(rate, limits_reference(r) / (limits_cfl(prm) * least));
    forecast_say("fv", dim, prm->water ? cells * surface_cost[dim - 2] : cells,
                 ceil(r->scene.time.end * rate));
    forecast_warn_outputs(r->scene.output.every, r->scene.output.checkpoint, r->scene.time.end,
                          ceil(r->scene.time.end / dt));
}

/* Cells a wave needs along its length and over its height. */
static const double wave_points[2] = {12.0, 1.5};

/* Doubles kept of a cell, about. */
static int fields_of(const struct run *r)
{
    const int dim = r->scene.domain.dim;
    return 4 + 6 * dim + (r->scene.fluid.nu > 0.0 ? 2 * dim : 0) + 4;
}

static void check(const struct run *r, struct faults *f)
{
    fv_params_check(r, f);
    if (f->n > 0)
        return;
    const struct fv_params *prm = fv_params_of(r);
    const int nblocks = prm->blocks.n;
    double cells = 0.0;
    for (int b = 0; b < (nblocks > 0 ? nblocks : 1); b++) {
        const int *n = nblocks > 0 ? prm->blocks.of[b].cells : prm->cells;
        cells += (double)n[0] * n[1] * (r->scene.domain.dim > 2 ? n[2] : 1);
    }
    run_check_memory(r, f, nblocks > 0 ? "blocks" : "fv.cells", cells, "cells",
                     8.0 * cells * fields_of(r));
}

static void describe(const struct run *r)
{
    const struct fv_params *prm = fv_params_of(r);
    if (prm->blocks.n > 0) {
        mesh_describe(r, prm);
        fv_scene_describe(r);
        if (prm->water)
            openings_describe(&r->scene);
        scene_waves_describe(&r->scene);
        return;
    }
    const struct scene_domain *d = &r->scene.domain;
    const bool viscous = r->scene.fluid.nu > 0.0, water = prm->water,
               hole = prm->hole[1][0] > prm->hole[0][0] || r->coupled;
    double cells = 1.0, h[3] = {1.0, 1.0, 1.0}, least = INFINITY;
    const bool walls = r->scene.nwalls > 0;
    bool closed = false;
    for (int a = 0; a < d->dim; a++) {
        cells *= prm->cells[a];
        h[a] = a == 1 && prm->graded[1] > 0.0 ? (d->max[1] - prm->graded[0]) / prm->graded[1]
                                              : (d->max[a] - d->min[a]) / prm->cells[a];
        least = fmin(least, h[a]);
        for (int k = 0; k < 2 && !d->periodic[a]; k++)
            closed = closed || !scene_wall_of(&r->scene, (enum scene_side)(SIDE_X_MIN + 2 * a + k));
    }
    const struct step_limit step_most = limits_estimate(r, prm, h);
    const double dt = fmin(step_most.dt, r->scene.time.end);
    limits_warn(r, prm, fmax(h[0], fmax(h[1], d->dim > 2 ? h[2] : 0.0)));
    const struct log_use uses[] = {
        {viscous, "implicit viscosity", NULL}, {water, "free surface (level set)", NULL},
        {walls, "walls and openings", NULL},   {prm->nboxes > 0, "blocked boxes", NULL},
        {hole, "imposed cells", NULL},         {r->coupled, "coupling", NULL}};
    log_say("%dD, fourth-order averages, %s, %s", d->dim, report_method(prm),
            closed  ? "exact velocity on sides without a wall"
            : walls ? "walls"
                    : "periodic");
    log_uses(uses, (int)(sizeof uses / sizeof *uses));
    fv_scene_describe(r);
    blocked_describe(r);
    if (water) {
        fraction_describe(r, prm, NULL, least);
        openings_describe(&r->scene);
        scene_waves_describe(&r->scene);
        scene_waves_resolution(&r->scene, "cells", h, wave_points);
    }
    if (prm->graded[1] > 0.0)
        describe_rows(r);
    log_say("%.0f cells, h %g m; about %.0f MB", cells, least, 8e-6 * cells * fields_of(r) + 1.0);
    if (prm->steady)
        return; /* marches in pseudo-time */
    if (step_most.by == LIMIT_NONE)
        log_say("steps follow the flow, which is at rest at the start (CFL %g)%s", limits_cfl(prm),
                r->coupled ? ", and end with each exchange" : "");
    else
        log_say("dt about %.3g s at the start (%s, CFL %g), %.0f steps at that%s", dt,
                limit_name(step_most.by), limits_cfl(prm), ceil(r->scene.time.end / dt),
                r->coupled ? "; they end with each exchange, too" : "");
    if (step_most.by != LIMIT_NONE && !r->coupled) /* how many steps is known */
        say_forecast(r, prm, cells, least, dt);
}

static void draw(const struct run *r, struct picture *p) { fv_draw(r, fv_params_of(r), p); }

static void *create(struct run *r, struct h5 *f) { return fv_create(r, f); }

static void destroy(void *state)
{
    struct fv *s = state;
    fv_free(&s);
}

static double step(void *state, double t_stop, struct diagnosis *d)
{
    struct fv *s = state;
    if (s->link)
        coupling_judge(s, d);
    return d->bad ? 0.0 : integrate(s, t_stop, d);
}

static void row(void *state, struct figures *to)
{
    const struct fv *s = state;
    fv_row(state, to);
    if (s->link)
        FIGURE(to, coupling_unmapped(s), "unmapped cells [-]");
    if (!s->run->crossed)
        return;
    FIGURE(to, s->surface->forced->step, "step of the surface [m]");
    FIGURE(to, coupling_water_missing(s), "water missing [m^dim]");
}

static void finish(void *state)
{
    struct fv *s = state;
    fv_finish(s);
    if (s->link)
        coupling_summary(s, s->run->summary);
}

static void progress(void *state, char *line, int size)
{
    const struct fv *s = state;
    const double steps = fmax(1.0, (double)(s->run->step - s->output->begun));
    snprintf(line, (size_t)size, "dt %.3g s (%s)  CFL %.2f  pressure %.1f its  |u| %.3g m/s",
             s->step.dt, limit_name(s->step.limit), s->max.rate * s->step.dt,
             (double)s->totals.iterations / steps, fv_fastest(s));
}

/* Steps of a free surface are long, some tens a period of the water's. A row costs 2 % (a dam
 * break) to 6 % (calm water) of a step. */
static int steps_between_rows(const struct run *r)
{
    return fv_params_of(r)->water && !r->coupled ? 3 : 10;
}

static const char *const others[] = {"sph", "sph_*", "apr", "coupler", NULL};

static const struct program fv_program = {.name = "fv",
                                          .help =
                                              "implicit finite volumes, fourth order, 2D and 3D",
                                          .meaning = 9,
                                          .groups = fv_groups,
                                          .ngroups = FV_GROUPS,
                                          .other_groups = others,
                                          .meshes = scene_meshes_read,
                                          .mesh_owners = 1u << MESH_OF_BODY,
                                          .complete = fv_scene_complete,
                                          .check = check,
                                          .describe = describe,
                                          .draw = draw,
                                          .create = create,
                                          .destroy = destroy,
                                          .step = step,
                                          .longest_window = coupling_longest_window,
                                          .first = coupling_first,
                                          .window_begin = fv_coupling_window_begin,
                                          .window_end = fv_coupling_window_end,
                                          .tell = fv_tell,
                                          .row = row,
                                          .steps_between_rows = steps_between_rows,
                                          .progress = progress,
                                          .snapshot = fv_snapshot,
                                          .checkpoint = fv_checkpoint,
                                          .finish = finish};

int main(int argc, char **argv) { return run_main(argc, argv, &fv_program, &cpl_partner); }

/* fv_params.c - parameters of group fv. SPDX-License-Identifier: BSD-3-Clause */
#include "fv.h"

#include <math.h>

#include "../common/mem.h"
#include "levelset.h"
#include "mesh.h"
#include "rows.h"

static struct fv_params given;

#define P struct fv_params
/* clang-format off */
static const struct param rows[] = {
    PARAM(P, cells,        "-", "(0, 0, 0)", 1, 1e6, "cells in each direction; even, rich in factors of two; none with blocks"),
    PARAM(P, graded,       "-", "(0.0, 0.0)", -1e9, 1e9, "height in m, rows: above this y that many even rows of cells, below it the others grow downwards; (0, 0): all even"),
    PARAM(P, cfl,          "-", "1.0",  1e-6, 1e4, "largest |u_a| dt/h; at most 1.1 (rk3), 0.7 (bdf2)"),
    CHOICE(P, integrator, "rk3|bdf2|newton", "rk3", "three projected stages, two-step backward for slow flows, fully implicit"),
    PARAM(P, tol_pressure, "-", "1e-2", 1e-14, 1, "of the last projection of a step, relative to its divergence"),
    PARAM(P, tol_viscous,  "-", "0.0",  0, 1,     "of the viscous solver; 0: 1e-3, with forced cells 1e-5"),
    PARAM(P, tol_newton,   "-", "1e-6", 1e-14, 1, "of newton's residual, as a velocity relative to the largest"),
    CHOICE(P, flux, "central|upwind", "central", "newton's convection: with a small dissipation, or upwind (kappa = 1/3)"),
    PARAM(P, c0,           "m/s", "0.0", 0, 1e9,  "newton's sound speed; 0: incompressible"),
    PARAM(P, steady,       "-", "false", 0, 1,    "newton marches to a steady state in pseudo-time; time.end: when it must be there"),
    PARAM(P, hole,         "m", "((0.0, 0.0), (0.0, 0.0))", -1e9, 1e9, "box whose cells take the exact solution; none by default"),
    PARAM(P, upwind,       "-", "-1.0", -1, 1e6,   "rk3, bdf2: strength of the upwind bias where the flow is finer than the cells; 0: none, -1: 1 with walls, else none"),
    PARAM(P, extrema,      "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "known least u on the vertical, largest and least v on the horizontal centre line: for error.extrema"),
    CHOICE(P, surface, "no|yes|auto", "auto", "free surface; auto: with shapes or a wave, alone"),
    PARAM(P, force,        "-", "(0.0, 0.0, 0.0)", -1e9, 1e9, "known mean of the force x on the walls of blocks, amplitude of force y (N), its frequency (1/s), over the second half of the run: for error.force"),
    PARAM(P, forced_order, "-", "2",    1, 2,     "in time, of a partner's velocities within a window"),
};
/* clang-format on */
#undef P

const struct param_group fv_groups[FV_GROUPS] = {{"fv", "The finite-volume solver", rows,
                                                  (int)(sizeof rows / sizeof *rows), &given, NULL,
                                                  0, 0, NULL},
                                                 MESH_GROUP};

const struct fv_params *fv_params_of(const struct run *r)
{
    (void)r;
    return &given;
}

static void check_axis(const struct run *r, int a, struct faults *f)
{
    static const char axes[] = "xyz";
    const int n = given.cells[a];
    if (n < 4)
        params_fault(r->params, f, "fv.cells", "%d cells along %c: at least 4 are wanted", n,
                     axes[a]);
    if (r->scene.domain.periodic[a] && n % 2)
        params_fault(r->params, f, "fv.cells",
                     "%d cells along the periodic %c: an even number is wanted (the multigrid of "
                     "the pressure halves it)",
                     n, axes[a]);
}

/* What flows in must be able to flow out; what this solver does not know. */
static void check_openings(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    bool in = false, out = false;
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        in = in || w->kind == WALL_INFLOW;
        out = out || w->kind == WALL_OUTFLOW;
        if (w->carried && (w->kind != WALL_OUTFLOW || given.steady))
            params_fault(r->params, f, "walls", "wall %d: carried is for an outflow%s", k + 1,
                         given.steady ? " of a run in time" : "");
        if (w->side == SIDE_NONE || w->kind == WALL_ABSORBING)
            params_fault(r->params, f, "walls", "wall %d: %s is not for this solver", k + 1,
                         w->side == SIDE_NONE ? "a polyline" : "\"absorbing\"");
    }
    for (int k = 0; k < s->nprobes; k++)
        if (s->probes[k].kind == PROBE_LEVEL && !surface_wanted(r) && !r->coupled)
            params_fault(r->params, f, "probes", "probe %d: there is no free surface", k + 1);
    for (int a = 0; a < s->domain.dim; a++)
        for (int k = 0; k < 2; k++)
            out = out || (!s->domain.periodic[a] &&
                          !scene_wall_of(s, (enum scene_side)(SIDE_X_MIN + 2 * a + k)));
    if (in && !out)
        params_fault(r->params, f, "walls", "an inflow without an outflow");
}

/* Rows of unequal height: along y, even at the top. */
static void check_graded(const struct run *r, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const int n = given.cells[1];
    if (given.graded[1] == 0.0)
        return;
    double *h = NEW(double, n > 0 ? n : 1);
    const double ratio = rows_heights(n, (int)given.graded[1], given.graded[0] - d->min[1],
                                      d->max[1] - d->min[1], h);
    mem_free(h);
    if (given.integrator == INTEGRATOR_NEWTON || surface_wanted(r) ||
        given.hole[1][0] > given.hole[0][0] || given.extrema[0] != 0.0)
        params_fault(r->params, f, "fv.graded",
                     "not with newton, a level set, fv.hole or fv.extrema");
    for (int k = 0; k < r->scene.nwalls; k++)
        if (r->scene.walls[k].kind == WALL_INFLOW || r->scene.walls[k].kind == WALL_OUTFLOW)
            params_fault(r->params, f, "walls", "wall %d: no openings with fv.graded", k + 1);
    if (d->periodic[1])
        params_fault(r->params, f, "fv.graded", "y is periodic");
    else if (given.graded[1] != floor(given.graded[1]))
        params_fault(r->params, f, "fv.graded", "%g is no number of rows", given.graded[1]);
    else if (!(ratio > 0.0))
        params_fault(
            r->params, f, "fv.graded",
            "no heights of rows do that: of %d rows at least %d must be left below y = %g m, "
            "and be no lower there than above",
            n, ROWS_BOTTOM + ROWS_GROWING, given.graded[0]);
    else if (ratio > 1.3)
        params_fault(r->params, f, "fv.graded",
                     "rows grow by %.2f from one to the next: at most 1.3; more rows below y = %g "
                     "m, or fewer even ones",
                     ratio, given.graded[0]);
}

static void check_surface(const struct run *r, struct faults *f)
{
    const struct scene *s = &r->scene;
    const double *g = s->fluid.gravity;
    if (!surface_wanted(r))
        return;
    if (r->coupled)
        params_fault(r->params, f, "fv.surface", "a coupled run leaves the surface to sph");
    if (given.integrator != INTEGRATOR_RK3)
        params_fault(r->params, f, "fv.integrator", "with a free surface rk3 alone");
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].kind == WALL_INFLOW || s->walls[k].kind == WALL_OUTFLOW)
            params_fault(r->params, f, "walls", "wall %d: no openings with a free surface", k + 1);
    if (given.hole[1][0] > given.hole[0][0])
        params_fault(r->params, f, "fv.hole", "not with a free surface");
    if (s->fluid.central != 0.0)
        params_fault(r->params, f, "fluid.central", "not for this solver");
    if (s->nbodies > 0)
        params_fault(r->params, f, "bodies", "not for this solver");
    for (int a = 0; a < s->domain.dim; a++) {
        if (s->domain.periodic[a])
            continue;
        for (int k = 0; k < 2; k++)
            if (!scene_wall_of(s, (enum scene_side)(SIDE_X_MIN + 2 * a + k)))
                params_fault(r->params, f, "walls",
                             "a free surface needs all sides that are not "
                             "periodic: %c_%s has none",
                             "xyz"[a], k ? "max" : "min");
    }
    if (s->nshapes == 0 && scene_has_wave(s) && g[1] == 0.0)
        params_fault(r->params, f, "fluid.gravity", "a wave wants some along y");
}

void fv_params_check(const struct run *r, struct faults *f)
{
    const bool exact = exact_at_all_times(&r->scene);
    if (mesh_block_count() > 0) {
        mesh_check(r, f);
        return;
    }
    if (given.integrator == INTEGRATOR_BDF2 && given.cfl > 0.7)
        params_fault(r->params, f, "fv.cfl", "%g: bdf2 is stable up to 0.7", given.cfl);
    if (given.integrator == INTEGRATOR_RK3 && given.cfl > 1.1)
        params_fault(r->params, f, "fv.cfl", "%g: rk3 is stable up to 1.1", given.cfl);
    if (given.integrator != INTEGRATOR_NEWTON && given.steady)
        params_fault(r->params, f, "fv.steady", "wants fv.integrator = \"newton\"");
    if (given.integrator != INTEGRATOR_NEWTON && given.c0 > 0.0)
        params_fault(r->params, f, "fv.c0", "wants fv.integrator = \"newton\"");
    if (given.integrator != INTEGRATOR_NEWTON && given.flux != FLUX_CENTRAL)
        params_fault(r->params, f, "fv.flux",
                     "wants fv.integrator = \"newton\"; rk3 and bdf2 have fv.upwind");
    check_graded(r, f);
    check_surface(r, f);
    for (int a = 0; a < r->scene.domain.dim; a++) {
        check_axis(r, a, f);
        if (given.hole[1][a] > given.hole[0][a] && (r->coupled || !exact))
            params_fault(r->params, f, "fv.hole",
                         "only a lone run with an exact solution (initial.field) can fill a hole");
    }
    check_openings(r, f);
}

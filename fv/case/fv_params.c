/* fv_params.c - parameters of group fv. SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"
#include "../watch/fv_watch.h"
#include "body_boxes.h"
#include "fv_case.h"
#include "fv_facts.h"

static struct fv_params given;

#define P struct fv_params
/* clang-format off */
static const struct param rows[] = {
    PARAM(P, cells,        "-", "(0, 0, 0)", 1, 1e6, "cells in each direction; even, rich in factors of two; none with blocks",
          USED(NEED(UNIFORM, "each block has cells of its own"))),
    PARAM(P, graded,       "-", "(0.0, 0.0)", -1e9, 1e9, "(y in m, n): n layers of cells of equal height above y, below it the others grow downwards; (0, 0): all equal",
          USED(WHERE(fv_has_layers, "layers", "the number of equal layers is 0")), .numbers = 2),
    PARAM(P, cfl,          "-", "0.0",  0, 1e4, "largest sum over the axes of |u_a| dt/h_a in a cell; at most 1.2 (rk3), 0.7 (bdf2); 0: 1.1 (rk3), 0.5 (bdf2), 1 (newton)"),
    CHOICE(P, integrator, "rk3|bdf2|newton", "rk3", "three projected stages, two-step backward for slow flows, fully implicit"),
    PARAM(P, tol_pressure, "-", "1e-2", 1e-14, 1, "of the last projection of a step, relative to its divergence",
          USED(NEED(PROJECTED, "newton solves for all unknowns at once: see fv.tol_newton")), .comparison = true),
    PARAM(P, tol_viscous,  "-", "0.0",  0, 1,     "of the viscous solver; 0: (32/n)^2/1000, n cells a side, with imposed cells or closed sides 1e-5 at most",
          USED(NEED(PROJECTED, "newton solves for all unknowns at once: see fv.tol_newton"),
               NEED(VISCOUS, "fluid.nu = 0: there is no viscous solver")), .comparison = true),
    PARAM(P, tol_newton,   "-", "0.0",  0, 1,     "of newton's residual, as a velocity relative to the largest; 0: 1e-6, without a surface times (64 fv.cfl/n)^3 at most, n cells a side, down to 1e-9; of a steady state 32/n^5, 1e-11 to 1e-6",
          USED(ONLY(integrator, ONE(INTEGRATOR_NEWTON), "it needs fv.integrator = \"newton\"")), .comparison = true),
    CHOICE(P, flux, "central|upwind", "central", "newton's convection: with a small dissipation, or upwind (kappa = 1/3)",
          USED(ONLY(integrator, ONE(INTEGRATOR_NEWTON), "it needs fv.integrator = \"newton\"; rk3 and bdf2 have fv.upwind")), .comparison = true),
    PARAM(P, c0,           "m/s", "0.0", 0, 1e9,  "newton's sound speed; 0: incompressible",
          USED(ONLY(integrator, ONE(INTEGRATOR_NEWTON), "it needs fv.integrator = \"newton\""))),
    PARAM(P, steady,       "-", "false", 0, 1,    "newton marches to a steady state in pseudo time, which time.end limits",
          USED(ONLY(integrator, ONE(INTEGRATOR_NEWTON), "it needs fv.integrator = \"newton\""))),
    PARAM(P, dual_time,    "-", "false", 0, 1,    "newton's equations are solved by dual time stepping (Chiron): pseudo steps of an artificially compressible fluid within each step",
          USED(ONLY(integrator, ONE(INTEGRATOR_NEWTON), "it needs fv.integrator = \"newton\""),
               WITHOUT(steady, "fv.steady marches in pseudo time alone")), .comparison = true),
    PARAM(P, pseudo_cfl,   "-", "0.5", 1e-3, 10,  "of a pseudo step: over the time in which flow, friction or the artificial sound cross a cell, or a step lasts",
          USED(WITH(dual_time, "there are no pseudo steps without fv.dual_time")), .comparison = true),
    PARAM(P, pseudo_steps, "-", "5000", 1, 1e8,   "most pseudo steps within a step, which is halved where they do not reach fv.tol_newton",
          USED(WITH(dual_time, "there are no pseudo steps without fv.dual_time")), .comparison = true),
    PARAM(P, pseudo_memory, "-", "5",  0, 100,   "pseudo steps that Anderson's acceleration combines; 0: each alone",
          USED(WITH(dual_time, "there are no pseudo steps without fv.dual_time")), .comparison = true),
    PARAM(P, hole,         "m", "((0.0, 0.0), (0.0, 0.0))", -1e9, 1e9, "box of imposed cells, which take the exact solution; none by default",
          USED(WHERE(fv_has_hole, "cells that lie wholly in the box", "no cell lies wholly in the box")), .comparison = true),
    PARAM(P, upwind,       "-", "-1.0", -1, 1e6,   "rk3, bdf2: strength of the upwind bias where the flow is finer than the cells; 0: none, -1: 1 with walls and where U h/nu is above 200, else none",
          USED(NEED(PROJECTED, "newton has fv.flux")), .comparison = true),
    PARAM(P, extrema,      "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "known least u on the vertical, largest and least v on the horizontal centre line: for error.extrema",
          USED(WHERE(fv_has_extrema, "the first of them", "the first of them is 0")), .numbers = 3, .comparison = true),
    CHOICE(P, surface, "no|yes|auto", "auto", "free surface; auto: with shapes or a wave; in a coupled job where sph.box ends in the water at an upright side"),
    CHOICE(P, volume, "auto|shift|fraction", "auto", "how a free surface keeps its water: fraction: the share of water of each cell is carried by the fluxes, and phi follows it where the water is not calm; shift: phi is shifted as a whole; auto: fraction where blocks do not overlap and there is no partner, else shift",
          USED(NEED(SURFACE, "without a free surface no cell holds less water than another")), .comparison = true),
    PARAM(P, force,        "-", "(0.0, 0.0, 0.0)", -1e9, 1e9, "known mean of the force x on the walls of blocks, amplitude of force y (N), its frequency (1/s), over the second half of the run: for error.force",
          USED(NEED(FORCES, "no block has a side that is a \"wall\"")), .numbers = 3, .comparison = true),
};
/* clang-format on */
#undef P

const struct param_group fv_groups[FV_GROUPS] = {
    {"fv", "The finite-volume solver", rows, (int)(sizeof rows / sizeof *rows), &given, NULL, 0, 0,
     NULL},
    {"blocks",
     "Structured blocks instead of fv.cells, joined or overlapping; later ones cover earlier ones",
     mesh_rows_of, MESH_ROWS, mesh_given, NULL, sizeof mesh_given[0], MESH_BLOCKS_MAX,
     &mesh_given_count},
    {"blocked", "Boxes that are cut out of fv.cells, as bodies at rest that are boxes are",
     blocked_rows, BLOCKED_ROWS, blocked_given, NULL, sizeof blocked_given[0], BLOCKED_MAX,
     &blocked_given_count}};

/* Shapes of a coupled case may be the partner's: there r->crossed says it. */
bool surface_wanted(const struct run *r)
{
    const struct scene *c = &r->scene;
    if (given.surface != SURFACE_AUTO)
        return given.surface == SURFACE_YES;
    return r->crossed || (!r->coupled && (c->nshapes > 0 || scene_has_wave(c)));
}

/* Of the list blocked, then those that bodies are. */
static struct blocked_params boxes[BLOCKED_MAX];

int fv_params_nboxes(const struct run *r)
{
    memcpy(boxes, blocked_given, sizeof blocked_given);
    return body_boxes(r, boxes, blocked_given_count);
}

/* Filled in anew at each call, for what it follows from is read in several steps. */
const struct fv_params *fv_params_of(const struct run *r)
{
    given.water = surface_wanted(r);
    given.errors = fv_measures_errors(r);
    given.ring = mesh_ring(r);
    for (int k = 0; k < mesh_given_count; k++)
        mesh_given[k].number = k;
    given.blocks = (struct mesh_blocks){mesh_given_count, mesh_given};
    given.nboxes = fv_params_nboxes(r);
    given.boxes = boxes;
    return &given;
}

/* Fourth-order ghosts read four cells; a period must be halved by multigrid. */
static void check_axis(const struct run *r, int a, struct faults *f)
{
    static const char axes[] = "xyz";
    const int n = given.cells[a];
    if (n < 4)
        params_fault(r->params, f, "fv.cells", "%d cells along %c: at least 4 are needed", n,
                     axes[a]);
    if (r->scene.domain.periodic[a] && n % 2)
        params_fault(r->params, f, "fv.cells",
                     "%d cells along the periodic %c: an even number is needed (the multigrid of "
                     "the pressure halves it)",
                     n, axes[a]);
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
    if (surface_wanted(r) && still_upright(&r->scene) != 1)
        params_fault(r->params, f, "fv.graded",
                     "with a free surface gravity must act along y, across the layers");
    if (d->periodic[1])
        params_fault(r->params, f, "fv.graded", "y is periodic");
    else if (given.graded[1] != floor(given.graded[1]))
        params_fault(r->params, f, "fv.graded", "%g is not a number of layers", given.graded[1]);
    else if (!(ratio > 0.0))
        params_fault(r->params, f, "fv.graded",
                     "no heights of layers fit: of %d layers at least %d must be left below y = %g "
                     "m, and be no lower there than above",
                     n, ROWS_BOTTOM + ROWS_GROWING, given.graded[0]);
    else if (ratio > 1.3)
        params_fault(r->params, f, "fv.graded",
                     "layers grow by %.2f from one to the next: at most 1.3; more layers below y = "
                     "%g m, or fewer equal ones",
                     ratio, given.graded[0]);
}

/* Lines of which a quartic takes the extrema. */
static void check_extrema(const struct run *r, struct faults *f)
{
    const double *e = given.extrema;
    if (e[0] == 0.0)
        return;
    if (e[1] == 0.0 || e[2] == 0.0)
        params_fault(r->params, f, "fv.extrema",
                     "error.extrema is relative to each of them: none may be 0");
    for (int a = 0; a < 2 && mesh_given_count == 0; a++)
        if (given.cells[a] < 8)
            params_fault(r->params, f, "fv.extrema", "at least 8 cells along %c are needed",
                         "xy"[a]);
}

/* What no cells are needed for, then blocks with rules of their own, else the grid. */
void fv_params_check(const struct run *r, struct faults *f)
{
    const struct fv_params *prm = fv_params_of(r);
    const bool exact = exact_at_all_times(&r->scene);
    const int field = r->scene.initial.field;
    fv_unused_check(r, f);
    if (r->scene.initial.U == 0.0 &&
        (prm->errors || field == FIELD_TAYLOR_GREEN || field == FIELD_TWO_MODES ||
         field == FIELD_BELTRAMI || field == FIELD_COUETTE))
        params_fault(r->params, f, "initial.U",
                     "0: the field would be none, and errors are relative to it");
    check_extrema(r, f);
    blocked_check(r, f);
    if (mesh_given_count > 0) {
        mesh_check(r, f);
        return;
    }
    limits_check(r, prm, f);
    if (given.upwind < 0.0 && given.upwind != -1.0)
        params_fault(r->params, f, "fv.upwind", "%g: 0 or more, or -1 for what suits the scene",
                     given.upwind);
    if (given.cells[0] == 0 && given.cells[1] == 0) {
        params_fault(r->params, f, "fv.cells",
                     "none are given: how many along each axis, or blocks");
        return;
    }
    check_graded(r, f);
    int dims[3];
    if (f->n == 0 && !block_split(r->size, r->scene.domain.dim, given.cells, dims))
        params_fault(r->params, f, "fv.cells",
                     "%d ranks cannot share them so that each has %d along each axis that is cut: "
                     "fewer ranks, or more cells",
                     r->size, LEAST);
    for (int a = 0; a < r->scene.domain.dim; a++) {
        check_axis(r, a, f);
        if (given.hole[1][a] > given.hole[0][a] && (r->coupled || !exact))
            params_fault(
                r->params, f, "fv.hole",
                "only an uncoupled run with an exact solution (initial.field) can fill fv.hole");
    }
    fv_scene_check(r, f);
}

/* mesh_errors.c - what runs on blocks alone show: where they are, overlaps.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../grid/fv_grid.h"
#include "mesh_output.h"
#include "output.h"

#include "../../common/run/run.h"
#include "../../common/scene/scene.h"
#include "../surface/fv_surface.h"
#include "../watch/fv_watch.h"

/* Position of the centre of rotation and angles of each block with a motion of its own: blocks that
 * others carry along have none. */
void mesh_places_row(const struct fv *s, struct figures *to)
{
    static const char *const angles[2][3] = {{"", "", "angle"}, {"rx", "ry", "rz"}};
    for (int k = 0; k < s->m->nblocks; k++) {
        const struct mesh_motion *v = s->m->block[k].motion;
        const char *name = s->m->block[k].prm->name;
        if (!v || v->block != k)
            continue;
        for (int a = 0; a < s->dim; a++)
            FIGURE(to, v->centre[a] + v->now.x[a], "%s %c [m]", name, "xyz"[a]);
        for (int a = s->dim == 3 ? 0 : 2; a < 3; a++)
            FIGURE(to, v->now.r[a], "%s %s [rad]", name, angles[s->dim - 2][a]);
    }
}

/* At outflows the net flux is what the solve left. */
void mesh_summarise(struct fv *s)
{
    struct summary *to = s->run->summary;
    summary_int(to, "fringe_cells", s->m->fringe_cells);
    summary_int(to, "fringe_cells_linear", s->m->linear);
    if (mesh_bc_pressure_given(s))
        s->totals.defect = fabs(mesh_bc_net_flux(s));
    if (s->m->has_fringe && s->max.u[0] > 0.0) /* relative to the flow, if there is one */
        summary_real(to, "overlap.net_flux", s->totals.defect / s->max.u[0]);
    summary_int(to, "poisson_iterations_start", s->totals.start_iterations);
    summary_real(to, "poisson_retries", (double)s->totals.retries);
}

/* What the sides are, and what the run uses and leaves out. */
static void describe_scene(const struct run *r, const struct fv_params *prm, const struct mesh *m)
{
    static const char *const kinds[] = {"overlap", "joined", "periodic", "walls",
                                        "slip",    "inflow", "outflow",  "exact velocity"};
    const double *g = r->scene.fluid.gravity;
    bool moves = false;
    for (int k = 0; k < m->nblocks; k++)
        moves = moves || m->block[k].motion;
    char sides[160] = "";
    for (int kind = MESH_OVERLAP; kind <= MESH_EXACT; kind++) {
        bool any = false;
        for (int k = 0; k < m->nblocks; k++)
            for (int q = 0; q < 2 * m->dim; q++)
                any = any || (int)m->block[k].side[q] == kind;
        if (any)
            text_add(sides, sizeof sides, "%s%s", *sides ? ", " : "", kinds[kind]);
    }
    const struct log_use uses[] = {{r->scene.fluid.nu > 0.0, "implicit viscosity", NULL},
                                   {prm->water, "free surface (level set)", NULL},
                                   {mesh_bc_has_walls(m), "walls", NULL},
                                   {m->has_fringe, "interpolation where blocks overlap", NULL},
                                   {g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0, "gravity", NULL},
                                   {moves, "moving blocks", NULL},
                                   {m->has_given, "imposed cells", NULL},
                                   {r->coupled, "coupling", NULL}};
    log_say("%dD, fourth-order averages, %s; sides: %s", m->dim, report_method(prm), sides);
    log_uses(uses, (int)(sizeof uses / sizeof *uses));
    log_say("%s", prm->errors ? "errors against the exact solution"
                              : "no exact solution to measure errors by");
}

/* Of a cell and step, over that of the uniform grid: the cavity on 48 x 48 cells. */
#define BLOCK_COST 3.6

/* Speed of the scene and of the blocks' sides across the smallest cell. An estimate: the flattest
 * cell need not be where the flow is fastest. */
static void describe_step(const struct run *r, const struct fv_params *prm, const struct mesh *m)
{
    double speed = limits_reference(r);
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block_params *b = m->block[k].prm;
        speed = fmax(speed, hypot(hypot(b->velocity[0], b->velocity[1]), b->velocity[2]));
        if (m->block[k].motion)
            speed = fmax(speed, m->block[k].motion->speed);
        for (int side = 0; side < 2 && b->mapping == MAPPING_ANNULUS; side++)
            speed = fmax(speed, fabs(b->spin[side]) * b->radius[side]);
    }
    const double cfl = limits_cfl(prm), h = mesh_least_height(m, CELL_COMPUTED);
    limits_warn(r, prm, h);
    log_say("%lld cells computed, the flattest %.3g m high; about %.0f MB", (long long)m->computed,
            h, 8e-6 * (double)m->cells * 80.0 + 1.0);
    if (prm->steady)
        return; /* marches in pseudo-time */
    log_say("dt about %.3g s if the fastest flow crosses the flattest cell (%s, CFL %g)",
            cfl * h / speed, limit_name(LIMIT_FLOW), cfl);
    const double steps = ceil(r->scene.time.end * speed / (cfl * h));
    forecast_say("fv", m->dim, BLOCK_COST * (double)m->computed, steps);
    forecast_warn_outputs(r->scene.output.every, r->scene.output.checkpoint, r->scene.time.end,
                          steps);
}

/* The mesh is left for the run to take (mesh_leave). */
void mesh_describe(const struct run *r, const struct fv_params *prm)
{
    static const char *const shapes[] = {"box", "stretched box", "ring", "sheared box", "file"};
    struct faults f = {0};
    struct mesh *m = mesh_take(r, &prm->blocks, fv_hole(prm) != NULL, fv_hole(prm), &f);
    for (int k = 0; m && k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        int64_t count[4] = {0, 0, 0, 0};
        for (int64_t c = 0; c < mesh_count(b); c++)
            count[b->status[c]]++;
        log_say("block %d \"%s\": %s, %d x %d x %d cells: %lld computed, %lld interpolated, %lld "
                "imposed, %lld cut out",
                k + 1, b->prm->name, shapes[b->prm->mapping], b->n[0], b->n[1], b->n[2],
                (long long)count[CELL_COMPUTED], (long long)count[CELL_FRINGE],
                (long long)count[CELL_GIVEN], (long long)count[CELL_HOLE]);
    }
    if (m) {
        describe_scene(r, prm, m);
        if (prm->water) {
            fraction_describe(r, prm, m, mesh_least_height(m, CELL_COMPUTED));
            mesh_outside_describe(r, m);
        }
        describe_step(r, prm, m);
    }
    mesh_leave(&m);
}

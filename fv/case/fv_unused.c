/* fv_unused.c - what keys need that this run has, the tests of their conditions, and what no row
 * can say: bodies that are no boxes, names of blocks, words of a text.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "../output/fv_output.h"
#include "body_boxes.h"
#include "fv_case.h"
#include "fv_facts.h"

static bool has_blocks(void) { return mesh_given_count > 0; }

/* --- groups of the scene --- */

static bool is_set(const double *v) { return v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0; }

/* Along a period it is a force that the pressure cannot balance. */
static bool gravity_drives(const struct run *r)
{
    const struct scene *s = &r->scene;
    bool any = false;
    for (int a = 0; a < s->domain.dim; a++)
        any = any || (s->domain.periodic[a] && s->fluid.gravity[a] != 0.0);
    return any;
}

static bool some_block_has(enum mesh_side kind)
{
    bool any = false; /* of its own: walls of the scene are looked at apart */
    for (int k = 0; k < mesh_given_count; k++)
        any = any || mesh_block_has(mesh_given + k, kind);
    return any;
}

/* The exact field must hold on all sides, too: walls would disturb it. */
bool fv_measures_errors(const struct run *r)
{
    if (mesh_given_count == 0)
        return exact_at_all_times(&r->scene) && !surface_wanted(r) && fv_params_nboxes(r) == 0;
    if (mesh_ring(r))
        return true;
    return exact_at_all_times(&r->scene) && r->scene.nwalls == 0 && !some_block_has(MESH_WALL) &&
           !some_block_has(MESH_SLIP) && !some_block_has(MESH_INFLOW) &&
           !some_block_has(MESH_OUTFLOW);
}

/* Pressure is seen in forces on walls, at gauges and in snapshots. Snapshots that the command line
 * has switched off count: the case is still right. */
static bool pressure_unseen(const struct run *r)
{
    const struct scene *s = &r->scene;
    const bool pictures =
        s->output.snapshots || params_on_command_line(r->params, "output.snapshots");
    bool walls = some_block_has(MESH_WALL) || fv_params_nboxes(r) > 0;
    for (int k = 0; k < s->nwalls; k++)
        walls = walls || s->walls[k].kind == WALL_SLIP || s->walls[k].kind == WALL_NO_SLIP;
    return !walls && s->nprobes == 0 && !(pictures && scene_shows(s, "pressure"));
}

/* Height of p = 0: of water that fills closed sides, or the still surface of a wave. */
static bool level_unseen(const struct run *r)
{
    const struct scene *s = &r->scene;
    bool across = false;
    for (int a = 0; a < s->domain.dim; a++)
        across = across || (!s->domain.periodic[a] && s->fluid.gravity[a] != 0.0);
    return !scene_has_wave(s) && (!across || pressure_unseen(r));
}

/* Behind an outflow the water stands at the level. */
static bool surface_of_shapes(const struct run *r)
{
    bool out = some_block_has(MESH_OUTFLOW);
    for (int w = 0; w < r->scene.nwalls; w++)
        out = out || (r->scene.walls[w].kind == WALL_OUTFLOW && !r->scene.walls[w].carried);
    return surface_wanted(r) && r->scene.nshapes > 0 && !scene_has_wave(&r->scene) && !out;
}

/* An inflow of a block that gives no velocity has that of the start. */
static bool some_inflow_of_start(void)
{
    bool inflow = false;
    for (int b = 0; b < mesh_given_count; b++)
        inflow = inflow ||
                 (mesh_block_has(mesh_given + b, MESH_INFLOW) && !is_set(mesh_given[b].velocity));
    return inflow;
}

/* Walls whose force is summed. */
static bool has_forces(const struct run *r)
{
    bool any = some_block_has(MESH_WALL);
    for (int w = 0; w < r->scene.nwalls; w++)
        any = any || (has_blocks() && r->scene.walls[w].kind == WALL_NO_SLIP);
    return any;
}

/* What a partner has counts. */
static unsigned long long find_facts(const struct run *r)
{
    const bool seen = surface_wanted(r) || gravity_drives(r) || !pressure_unseen(r);
    unsigned long long has = scene_facts(&r->scene, r->params), lacks = 0, partner = 0;
    lacks |= surface_wanted(r) ? 0 : FACT(SURFACE);
    lacks |= fv_params_of(r)->integrator == INTEGRATOR_NEWTON ? FACT(PROJECTED) : 0;
    lacks |= has_blocks() && !some_block_has(MESH_PERIODIC) ? FACT(PERIODIC) : 0;
    lacks |= has_blocks() ? FACT(UNIFORM) : 0;
    lacks |= has_forces(r) ? 0 : FACT(FORCES);
    lacks |= seen ? 0 : FACT(WEIGHT);
    lacks |= surface_of_shapes(r) ? FACT(LEVEL) : 0;
    lacks |= level_unseen(r) ? FACT(STILL) : 0;
    lacks |= some_inflow_of_start() ? 0 : FACT(INFLOW);
    if (r->coupled)
        partner = FACT(SPH) | FACT(COUPLED) | FACT(ZONES) | FACT(WEIGHT) | FACT(LEVEL) |
                  FACT(STILL) | FACT(PICTURES);
    return (has & ~lacks) | partner;
}

/* --- groups of this solver --- */

bool fv_has_layers(const void *run, const void *p)
{
    return (void)run, ((const struct fv_params *)p)->graded[1] != 0.0;
}

bool fv_has_extrema(const void *run, const void *p)
{
    return (void)run, ((const struct fv_params *)p)->extrema[0] != 0.0;
}

/* Whether one of the rows of unequal height lies wholly in the hole. */
static bool some_row(const struct run *r)
{
    const struct fv_params *p = fv_params_of(r);
    const struct scene_domain *d = &r->scene.domain;
    double *h = NEW(double, p->cells[1]), y = d->min[1];
    bool any = !(rows_heights(p->cells[1], (int)p->graded[1], p->graded[0] - d->min[1],
                              d->max[1] - d->min[1], h) > 0.0); /* told elsewhere */
    for (int j = 0; j < p->cells[1] && !any; j++) {
        const double eps = 1e-9 * h[j];
        any = y >= p->hole[0][1] - eps && y + h[j] <= p->hole[1][1] + eps;
        y += h[j];
    }
    mem_free(h);
    return any;
}

/* Cells that lie wholly in the box are forced. */
bool fv_has_hole(const void *run, const void *of)
{
    const struct fv_params *p = of;
    const struct run *r = run;
    const struct scene_domain *d = &r->scene.domain;
    bool empty = false;
    for (int a = 0; a < d->dim && !has_blocks(); a++) { /* of blocks: mesh_params.c */
        if (a == 1 && p->graded[1] > 0.0) {
            empty = empty || !some_row(r);
            continue;
        }
        const double h = (d->max[a] - d->min[a]) / p->cells[a];
        const double first = fmax(ceil((p->hole[0][a] - d->min[a]) / h - 1e-9), 0.0),
                     last = fmin(floor((p->hole[1][a] - d->min[a]) / h + 1e-9), p->cells[a]);
        empty = empty || !(last > first);
    }
    return !empty;
}

/* --- blocks --- */

/* Files of HDF5 have one block. */
bool mesh_has_zones(const void *run, const void *block)
{
    const struct mesh_block_params *b = block;
    const size_t n = strlen(b->file);
    return (void)run, b->mapping == MAPPING_FILE && !(n > 3 && strcmp(b->file + n - 3, ".h5") == 0);
}

bool mesh_has_focus(const void *run, const void *block)
{
    const struct mesh_block_params *b = block;
    bool any = false;
    for (int a = 0; a < ((const struct run *)run)->scene.domain.dim; a++)
        any = any || b->stretch[a] > 0.0;
    return b->mapping == MAPPING_STRETCHED && any;
}

bool mesh_stretch_fits(const void *run, const void *block)
{
    const struct mesh_block_params *b = block;
    return (void)run,
           b->mapping != MAPPING_ANNULUS || (b->stretch[1] == 0.0 && b->stretch[2] == 0.0);
}

static bool moves_about(const struct scene_motions *all)
{
    bool any = false;
    for (int i = 0; i < all->n; i++)
        any = any || all->of[i].kind == MOTION_FILE || all->of[i].axis >= AXIS_RX;
    return any;
}

/* Whether anything is about the block's centre. */
bool mesh_turns(const void *run, const void *block)
{
    const struct mesh_block_params *b = block;
    const bool walls = mesh_block_has(b, MESH_WALL) || moves_about(&b->motion);
    return (void)run, walls || (b->mapping != MAPPING_FILE &&
                                (b->angle != 0.0 || b->mapping == MAPPING_ANNULUS));
}

bool mesh_has_moving_side(const void *run, const void *block)
{
    return (void)run, mesh_block_has(block, MESH_WALL) || mesh_block_has(block, MESH_INFLOW);
}

bool mesh_has_bed(const void *run, const void *block)
{
    return (void)run, mesh_block_has(block, MESH_SLIP);
}

/* The third number has no wall. */
bool mesh_spin_fits(const void *run, const void *block)
{
    const struct mesh_block_params *b = block;
    return (void)run, (b->spin[0] == 0.0 || b->i_min == MESH_WALL) &&
                          (b->spin[1] == 0.0 || b->i_max == MESH_WALL) && b->spin[2] == 0.0;
}

/* --- what no row can say --- */

/* Bodies of fv stand still but for blocks that move, on which a gauge may sit; in a coupled job it
 * is sph's. Whether the block moves its mesh knows (mesh_scene.c). */
static void check_probes(const struct run *r, struct faults *f)
{
    for (int k = 0; k < r->scene.nprobes && !r->coupled; k++) {
        bool known = false;
        for (int b = 0; b < mesh_given_count; b++)
            known = known || strcmp(mesh_given[b].name, r->scene.probes[k].body) == 0;
        params_unused(r->params, f, key_text("probes.[%d].body", k), known,
                      "no block of that name moves: bodies of fv stand still");
    }
}

/* Elements of lists of which nothing is used. */
static void check_elements(const struct run *r, struct faults *f)
{
    static const char *const of_others[] = {"centre", "force", "contact"};
    const struct scene *s = &r->scene;
    for (int k = 0; k < s->nbodies; k++) {
        struct blocked_params box;
        const char *why = body_box(r, k, &box);
        if (why)
            params_fault(r->params, f, key_text("bodies.[%d]", k), "is not used: %s", why);
        for (size_t i = 0; !why && i < sizeof of_others / sizeof of_others[0]; i++)
            params_unused(r->params, f, key_text("bodies.[%d].%s", k, of_others[i]), false,
                          "fv has the force on a box alone");
    }
    for (int k = 0; k < s->nshapes && !surface_wanted(r); k++)
        params_fault(r->params, f, key_text("shapes.[%d]", k),
                     "is not used: without a free surface (%s) the fluid is "
                     "everywhere",
                     "fv.surface");
}

/* Each word names a field that this solver can write; partners have others. */
static void check_fields(const struct run *r, struct faults *f)
{
    scene_check_shown(&r->scene, r->params, "fv", "velocity, pressure, vorticity, vorticity_exact",
                      f);
    if (!scene_shows(&r->scene, "vorticity_exact"))
        return;
    if (mesh_given_count > 0)
        params_fault(r->params, f, "output.fields", "vorticity_exact: not with blocks");
    else if (!exact_at_all_times(&r->scene))
        params_fault(r->params, f, "output.fields",
                     "vorticity_exact: no exact solution of this scene is known at all times");
}

void fv_unused_check(const struct run *r, struct faults *f)
{
    const unsigned long long facts = find_facts(r);
    scene_check_facts(&r->scene, r->params, facts, f);
    params_check_use(r->params, fv_groups, FV_GROUPS, NULL, r, f);
    params_check_use(r->params, fv_groups, FV_GROUPS, &facts, r, f);
    if (r->scene.domain.dim == 2)
        params_check_plane(r->params, fv_groups, FV_GROUPS, f);
    check_probes(r, f);
    if (!r->coupled) {
        check_elements(r, f);
        check_fields(r, f);
    }
}

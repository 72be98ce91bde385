/* mesh_params.c - parameters of the list blocks. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "../grid/fv_grid.h"

#include "../fv.h"
#include "../watch/fv_watch.h"
#include "fv_case.h"
#include "fv_facts.h"

#define SIDES "overlap|joined|periodic|wall|slip|inflow|outflow|exact"
#define P struct mesh_block_params
/* clang-format off */
const struct param mesh_rows_of[MESH_ROWS] = {
    PARAM(P, name,     "-", "block#", 0, 0, "its name in outputs and messages"),
    CHOICE(P, mapping, "box|stretched|annulus|sheared|file", "box", "shape: uniform box, box with finer cells at a place, ring (cells: outwards, around), sheared or waving box, vertices from a file"),
    PARAM(P, cells,    "-", "(1, 1, 1)", 1, 1e6, "cells in each direction; with a file the file's own",
          USED(ONLY(mapping, ~ONE(MAPPING_FILE), "the file has its own number of cells"))),
    PARAM(P, min,      "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "lower corner before the rotation; z of a ring",
          USED(NEED_OR_ONLY(SPACE, mapping, ~ONE(MAPPING_ANNULUS), "a ring of the plane has centre, radius and arc"),
               ONLY(mapping, ~ONE(MAPPING_FILE), "the file has the places of the vertices"))),
    PARAM(P, max,      "m", "(1.0, 1.0, 1.0)", -1e9, 1e9, "upper corner",
          USED(NEED_OR_ONLY(SPACE, mapping, ~ONE(MAPPING_ANNULUS), "a ring of the plane has centre, radius and arc"),
               ONLY(mapping, ~ONE(MAPPING_FILE), "the file has the places of the vertices"))),
    PARAM(P, centre,   "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "of the rotation, of a ring, of the spin of walls",
          USED(WHERE(mesh_turns, "an angle, a ring, or walls with a moment", "nothing is turned about it: no angle, no ring, no wall with a moment"))),
    PARAM(P, angle,    "degrees", "0.0", -360, 360, "rotation about the z axis through the centre",
          USED(ONLY(mapping, ~ONE(MAPPING_ANNULUS), "a ring is turned by its arc"),
               ONLY(mapping, ~ONE(MAPPING_FILE), "the file has the places of the vertices"))),
    PARAM(P, focus,    "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "stretched: place of the finest cells, before the rotation",
          USED(WHERE(mesh_has_focus, "mapping = stretched and a stretch > 0", "it needs mapping = \"stretched\" with a stretch > 0"))),
    PARAM(P, stretch,  "-", "(0.0, 0.0, 0.0)", -5, 20, "stretched: strength in each direction, ring: the first one outwards; 0: uniform; < 0: finer towards both ends (a tanh), whatever the focus",
          USED(ONLY(mapping, ONE(MAPPING_STRETCHED) | ONE(MAPPING_ANNULUS), "only the mappings \"stretched\" and \"annulus\" have it"),
               WHERE(mesh_stretch_fits, "of a ring one number", "a ring is stretched outwards alone, by the first number"))),
    PARAM(P, radius,   "m", "(0.5, 1.0)", 0, 1e9, "ring: inner, outer",
          USED(ONLY(mapping, ONE(MAPPING_ANNULUS), "it needs mapping = \"annulus\"")), .numbers = 2),
    PARAM(P, arc,      "degrees", "(0.0, 360.0)", -720, 720, "ring: first and last angle",
          USED(ONLY(mapping, ONE(MAPPING_ANNULUS), "it needs mapping = \"annulus\"")), .numbers = 2),
    PARAM(P, shear,    "-", "0.0", -10, 10, "sheared: dx/dy",
          USED(ONLY(mapping, ONE(MAPPING_SHEARED), "it needs mapping = \"sheared\"")), .comparison = true),
    PARAM(P, wave,     "-", "0.0", -0.15, 0.15, "sheared: displacement by sin sin, over the length of a side",
          USED(ONLY(mapping, ONE(MAPPING_SHEARED), "it needs mapping = \"sheared\"")), .comparison = true),
    PARAM(P, file,     "-", "", 0, 0, "file beside the case: .h5 (dataset x[k][j][i][dim] of vertices), else Plot3D",
          USED(ONLY(mapping, ONE(MAPPING_FILE), "it needs mapping = \"file\""))),
    PARAM(P, zone,     "-", "1", 1, 1e4, "block of a Plot3D file",
          USED(WHERE(mesh_has_zones, "mapping = file and a file of Plot3D", "it needs mapping = \"file\" and a file of Plot3D"))),
    CHOICE(P, i_min, SIDES, "overlap", "condition on the side of least i; overlap on a side of the domain: that side's entry of walls, if any"),
    CHOICE(P, i_max, SIDES, "overlap", "condition on the side of largest i"),
    CHOICE(P, j_min, SIDES, "overlap", "the same along j"),
    CHOICE(P, j_max, SIDES, "overlap", "the same along j"),
    CHOICE(P, k_min, SIDES, "overlap", "the same along k",
          USED(NEED(SPACE, "the case has two dimensions"))),
    CHOICE(P, k_max, SIDES, "overlap", "the same along k",
          USED(NEED(SPACE, "the case has two dimensions"))),
    PARAM(P, velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "of its walls along themselves, of its inflow",
          USED(WHERE(mesh_has_moving_side, "a side that is wall or inflow", "none of the block's sides is \"wall\" or \"inflow\""))),
    PARAM(P, friction, "-", "0.0", 0, 1, "coefficient c_f of quadratic bed friction on its slip sides, as walls.friction",
          USED(WHERE(mesh_has_bed, "a side that is slip", "none of the block's sides is \"slip\""),
               NEED(PROJECTED, "newton has no bed friction: fv.integrator = \"rk3\" or \"bdf2\""))),
    CHOICE(P, lid, "all|i_min|i_max|j_min|j_max|k_min|k_max", "all", "moving wall: the only one of its walls that has the velocity"),
    PARAM(P, spin,     "rad/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "(of its wall i_min, of its wall i_max) about the centre",
          USED(WHERE(mesh_spin_fits, "i_min or i_max = wall", "it is of the walls i_min and i_max, and that side is no \"wall\"")), .numbers = 3),
    LIST(P, motion, &scene_motion_list, "rigid motion of the block, of blocks joined to it and of its walls: the sum of its terms, rotation about its centre; a plain text: one file"),
};
/* clang-format on */
#undef P

struct mesh_block_params mesh_given[MESH_BLOCKS_MAX];
int mesh_given_count;

/* Flow between two cylinders that turn, Couette's, whose exact field is known on a whole ring. */
bool mesh_ring(const struct run *r)
{
    const struct mesh_block_params *b = mesh_given;
    return r->scene.initial.field == FIELD_COUETTE && mesh_given_count == 1 &&
           b->mapping == MAPPING_ANNULUS && b->i_min == MESH_WALL && b->i_max == MESH_WALL &&
           b->j_min == MESH_JOINED && b->j_max == MESH_JOINED;
}

/* A lid is a wall that moves. */
static void check_lid(const struct run *r, struct faults *f, int k)
{
    const struct mesh_block_params *b = mesh_given + k;
    const int kind[6] = {b->i_min, b->i_max, b->j_min, b->j_max, b->k_min, b->k_max};
    const int side = b->lid - 1, a = side / 2;
    if (b->lid == 0)
        return;
    if (a >= r->scene.domain.dim || kind[side] != MESH_WALL)
        mesh_fault(r, f, mesh_given + k, "lid", "this side is no wall");
    else if (b->velocity[0] == 0.0 && b->velocity[1] == 0.0 && b->velocity[2] == 0.0)
        mesh_fault(r, f, mesh_given + k, "velocity",
                   "the velocity of the moving wall (lid) is missing");
}

/* Kinds of sides that the dimension has. */
static void check_block(const struct run *r, struct faults *f, int k)
{
    struct mesh_block_params *b = mesh_given + k;
    const int dim = r->scene.domain.dim;
    for (int a = 0; a < dim && b->mapping != MAPPING_FILE; a++)
        if (b->cells[a] < 6)
            mesh_fault(r, f, mesh_given + k, "cells", "%d cells along %c: at least 6 are needed",
                       b->cells[a], "ijk"[a]);
    for (int a = 0; a < dim; a++)
        if (b->mapping != MAPPING_FILE && (b->mapping != MAPPING_ANNULUS || a == 2) &&
            !(b->max[a] > b->min[a]))
            mesh_fault(r, f, mesh_given + k, "max", "max of %c must lie above min", "xyz"[a]);
    if (b->mapping == MAPPING_ANNULUS && !(b->radius[1] > b->radius[0] && b->radius[0] > 0.0))
        mesh_fault(r, f, mesh_given + k, "radius", "expected 0 < inner < outer");
    if (b->mapping == MAPPING_ANNULUS && !(b->arc[1] > b->arc[0]))
        mesh_fault(r, f, mesh_given + k, "arc", "expected first < last");
    if (b->mapping == MAPPING_ANNULUS && fabs(b->arc[1] - b->arc[0] - 360.0) < 1e-9 &&
        (b->j_min == MESH_OVERLAP || b->j_max == MESH_OVERLAP || b->j_min == MESH_PERIODIC ||
         b->j_max == MESH_PERIODIC))
        mesh_fault(r, f, mesh_given + k, "j_min",
                   "the ends of a full ring lie on each other: j_min and j_max = \"joined\"");
    bool stretched = false;
    for (int a = 0; a < dim; a++)
        stretched = stretched || b->stretch[a] != 0.0;
    if (b->mapping == MAPPING_STRETCHED && !stretched)
        mesh_fault(r, f, mesh_given + k, "mapping", "\"stretched\" without a stretch is a \"box\"");
    if (b->mapping == MAPPING_SHEARED && b->shear == 0.0 && b->wave == 0.0)
        mesh_fault(r, f, mesh_given + k, "mapping",
                   "\"sheared\" without a shear or a wave is a \"box\"");
    if (b->mapping == MAPPING_FILE && !*b->file)
        mesh_fault(r, f, mesh_given + k, "file",
                   "the name of the file with the vertices is missing");
    check_lid(r, f, k);
}

/* Walls may be those of a partner's part alone. */
static bool has_partner(const struct run *r) { return r->coupled && r->scene.has_sph; }

static void check_wall(const struct run *r, struct faults *f, int k)
{
    if (r->scene.walls[k].side == SIDE_NONE && !has_partner(r))
        params_fault(r->params, f, key_text("walls.[%d]", k),
                     "walls within the domain are a block's sides here (blocks.i_min = \"wall\")");
    else
        fv_wall_check(r, f, k);
}

/* A wall of the scene that no block has is a mistake. */
static void check_taken(const struct run *r, struct faults *f, const struct mesh *m)
{
    for (int w = 0; w < r->scene.nwalls; w++) {
        bool taken = has_partner(r);
        for (int k = 0; k < m->nblocks; k++)
            for (int side = 0; side < 2 * m->dim; side++)
                taken = taken || m->block[k].wall[side] == r->scene.walls + w;
        if (!taken)
            params_fault(r->params, f, key_text("walls.[%d]", w),
                         "is not used: no side of a block that has no kind of its own lies wholly "
                         "on this side of the "
                         "domain");
    }
}

/* Imposed cells take the exact solution, which must be that of all times. */
static void check_hole(const struct run *r, struct faults *f)
{
    if (!fv_hole(fv_params_of(r)))
        return;
    if (!fv_measures_errors(r) || (mesh_ring(r) && !fv_params_of(r)->steady))
        params_fault(r->params, f, "fv.hole",
                     "only a run with an exact solution (initial.field) can fill fv.hole");
    if (mesh_blocks_move(&fv_params_of(r)->blocks))
        params_fault(r->params, f, "fv.hole", "not with blocks that move");
}

static void check_coupled(const struct run *r, struct faults *f)
{
    if (mesh_blocks_move(&fv_params_of(r)->blocks))
        params_fault(r->params, f, "blocks.motion", "blocks cannot move in a coupled job");
    if (fv_hole(fv_params_of(r)))
        params_fault(
            r->params, f, "fv.hole",
            "only an uncoupled run with an exact solution (initial.field) can fill fv.hole");
}

/* Keys first: the mesh is made of sound ones alone, then the scene is looked at on it. */
void mesh_check(const struct run *r, struct faults *f)
{
    const struct fv_params *prm = fv_params_of(r);
    const int before = f->n;
    if (r->coupled)
        check_coupled(r, f);
    limits_check(r, prm, f);
    surface_check(r, f);
    if (prm->graded[1] > 0.0)
        params_fault(r->params, f, "fv.graded", "not with blocks: they have mappings of their own");
    check_hole(r, f);
    if (mesh_blocks_move(&fv_params_of(r)->blocks) && prm->steady)
        params_fault(r->params, f, "fv.steady", "blocks that move have no steady state");
    for (int k = 0; k < mesh_given_count; k++)
        scene_check_motion(&mesh_given[k].motion, "blocks", k, r->params, f);
    for (int k = 0; k < r->scene.nwalls; k++)
        check_wall(r, f, k);
    probes_check_surface(r, f);
    for (int k = 0; k < mesh_given_count; k++)
        check_block(r, f, k);
    if (f->n > before)
        return;
    struct mesh *m = mesh_create(r, &prm->blocks, fv_hole(prm) != NULL, fv_hole(prm), f);
    if (m) {
        check_taken(r, f, m);
        if (m->has_given && m->given_cells == 0)
            params_fault(r->params, f, "fv.hole", "no cell of the blocks lies wholly in the box");
        mesh_scene_check(r, f, m);
        if (f->n == before && m->moves)
            mesh_motion_sweep(r, f, m);
    }
    mesh_leave(&m);
}

/* fv_unused.c - keys that a case gives and this solver has no use for: a table of what is not used,
 * when, and why. A key that changes nothing is a mistake of the case.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../common/base/mem.h"
#include "../boundary/blocked.h"
#include "../grid/mesh.h"
#include "../grid/rows.h"
#include "../output/output.h"
#include "../surface/levelset.h"
#include "body_boxes.h"
#include "fv_case.h"

/* Whether the run leaves the key out; k: element of a list. */
typedef bool (*left_out)(const struct run *r, int k);

struct rule {
    const char *key;     /* "group.key"; of a list: of each of its elements */
    left_out left_out;   /* when */
    const char *why;     /* and why: "is not used: ..." */
    bool of_the_partner; /* a coupled job may use it elsewhere: not looked at there */
};

/* --- what the run is --- */

static bool always(const struct run *r, int k) { return (void)r, (void)k, true; }
static bool blocks(const struct run *r, int k) { return (void)r, (void)k, mesh_given_count > 0; }
static bool alone(const struct run *r, int k) { return (void)k, !r->coupled; }
static bool planar(const struct run *r, int k) { return (void)k, r->scene.domain.dim < 3; }
static bool inviscid(const struct run *r, int k) { return (void)k, !(r->scene.fluid.nu > 0.0); }
static bool is_newton(const struct run *r, int k)
{
    return (void)k, fv_params_of(r)->integrator == INTEGRATOR_NEWTON;
}
static bool not_newton(const struct run *r, int k) { return !is_newton(r, k); }
static bool dry(const struct run *r, int k) { return (void)k, !surface_wanted(r); }

/* --- groups of the scene --- */

static bool is_set(const double *v) { return v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0; }

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
    return !walls && s->nprobes == 0 && !(pictures && fv_field_wanted(r, "pressure"));
}

static bool gravity_unseen(const struct run *r, int k)
{
    (void)k;
    return !surface_wanted(r) && !gravity_drives(r) && pressure_unseen(r);
}

/* Height of p = 0: of water that fills closed sides, or the still surface of a wave. */
static bool level_unseen(const struct run *r, int k)
{
    const struct scene *s = &r->scene;
    bool across = false;
    for (int a = 0; a < s->domain.dim; a++)
        across = across || (!s->domain.periodic[a] && s->fluid.gravity[a] != 0.0);
    return (void)k, !scene_has_wave(s) && (!across || pressure_unseen(r));
}
/* Behind an outflow the water stands at the level. */
static bool surface_of_shapes(const struct run *r, int k)
{
    bool out = some_block_has(MESH_OUTFLOW);
    for (int w = 0; w < r->scene.nwalls; w++)
        out = out || (r->scene.walls[w].kind == WALL_OUTFLOW && !r->scene.walls[w].carried);
    return (void)k, surface_wanted(r) && r->scene.nshapes > 0 && !scene_has_wave(&r->scene) && !out;
}

static bool no_wave(const struct run *r, int k) { return (void)k, !scene_has_wave(&r->scene); }
static bool no_crest(const struct run *r, int k)
{
    (void)k;
    return r->scene.initial.field != FIELD_REGULAR && r->scene.initial.field != FIELD_SOLITARY;
}

/* Of a channel it is the height: one that says so says what is. */
static bool no_length(const struct run *r, int k)
{
    const int f = r->scene.initial.field;
    const double H = r->scene.domain.max[1] - r->scene.domain.min[1];
    const bool channel = f == FIELD_POISEUILLE || f == FIELD_COUETTE;
    return (void)k, f == FIELD_REST || f == FIELD_UNIFORM ||
                        (channel && fabs(r->scene.initial.L - H) > 1e-9 * H);
}

/* An inflow of a block that gives no velocity has that of the start. */
static bool nothing_carried(const struct run *r, int k)
{
    const int f = r->scene.initial.field;
    bool inflow = false;
    for (int b = 0; b < mesh_given_count; b++)
        inflow = inflow ||
                 (mesh_block_has(mesh_given + b, MESH_INFLOW) && !is_set(mesh_given[b].velocity));
    return (void)k, !inflow && (f == FIELD_REST || (f >= FIELD_POISEUILLE && f != FIELD_BELTRAMI));
}

static bool no_periodic_side(const struct run *r, int k)
{
    return blocks(r, k) && !some_block_has(MESH_PERIODIC);
}

static bool let_out(const struct run *r, int k) { return r->scene.walls[k].kind == WALL_OUTFLOW; }

static bool no_pictures(const struct run *r, int k)
{
    return (void)k,
           !r->scene.output.snapshots && !params_on_command_line(r->params, "output.snapshots");
}

/* --- groups of this solver --- */

static bool no_rows(const struct run *r, int k) { return (void)k, fv_params_of(r)->graded[1] == 0; }
static bool graded_of_three(const struct run *r, int k)
{
    return (void)k, fv_params_of(r)->graded[2] != 0.0;
}
static bool no_extrema(const struct run *r, int k)
{
    return (void)k, fv_params_of(r)->extrema[0] == 0.0;
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
static bool no_hole(const struct run *r, int k)
{
    const struct fv_params *p = fv_params_of(r);
    const struct scene_domain *d = &r->scene.domain;
    bool empty = false;
    for (int a = 0; a < d->dim && !blocks(r, k); a++) { /* of blocks: mesh_params.c */
        if (a == 1 && p->graded[1] > 0.0) {
            empty = empty || !some_row(r);
            continue;
        }
        const double h = (d->max[a] - d->min[a]) / p->cells[a];
        const double first = fmax(ceil((p->hole[0][a] - d->min[a]) / h - 1e-9), 0.0),
                     last = fmin(floor((p->hole[1][a] - d->min[a]) / h + 1e-9), p->cells[a]);
        empty = empty || !(last > first);
    }
    return empty;
}
static bool no_forces(const struct run *r, int k)
{
    bool any = some_block_has(MESH_WALL);
    for (int w = 0; w < r->scene.nwalls; w++)
        any = any || (blocks(r, k) && r->scene.walls[w].kind == WALL_NO_SLIP);
    return !any;
}

static const struct mesh_block_params *block(int k) { return mesh_given + k; }
static bool plane_ring(const struct run *r, int k)
{
    return block(k)->mapping == MAPPING_ANNULUS && planar(r, k);
}
static bool no_ring(const struct run *r, int k)
{
    return (void)r, block(k)->mapping != MAPPING_ANNULUS;
}
static bool is_ring(const struct run *r, int k) { return !no_ring(r, k); }
static bool is_file(const struct run *r, int k)
{
    return (void)r, block(k)->mapping == MAPPING_FILE;
}
static bool no_file(const struct run *r, int k) { return !is_file(r, k); }
static bool no_zone(const struct run *r, int k)
{
    const size_t n = strlen(block(k)->file);
    return no_file(r, k) || (n > 3 && strcmp(block(k)->file + n - 3, ".h5") == 0);
}
static bool no_shear(const struct run *r, int k)
{
    return (void)r, block(k)->mapping != MAPPING_SHEARED;
}
static bool no_focus(const struct run *r, int k)
{
    const struct mesh_block_params *b = block(k);
    bool any = false;
    for (int a = 0; a < r->scene.domain.dim; a++)
        any = any || b->stretch[a] > 0.0;
    return b->mapping != MAPPING_STRETCHED || !any;
}
static bool even(const struct run *r, int k)
{
    return (void)r, block(k)->mapping != MAPPING_STRETCHED && block(k)->mapping != MAPPING_ANNULUS;
}
static bool no_block_moves(const struct run *r, int probe)
{
    bool any = r->coupled; /* then it is sph's */
    for (int k = 0; k < mesh_given_count; k++)
        any = any || (strcmp(mesh_given[k].name, r->scene.probes[probe].body) == 0 &&
                      mesh_given[k].motion.n > 0);
    return !any;
}
static bool around(const struct run *r, int k)
{
    return is_ring(r, k) && (block(k)->stretch[1] != 0.0 || block(k)->stretch[2] != 0.0);
}
static bool radius_of_three(const struct run *r, int k)
{
    return (void)r, block(k)->radius[2] != 0.0;
}
static bool arc_of_three(const struct run *r, int k) { return (void)r, block(k)->arc[2] != 0.0; }
static bool turned(int k)
{
    const struct scene_motions *all = &block(k)->motion;
    bool any = false;
    for (int i = 0; i < all->n; i++)
        any = any || all->of[i].kind == MOTION_FILE || all->of[i].axis >= AXIS_RX;
    return any;
}
static bool no_centre(const struct run *r, int k)
{
    const bool walls = mesh_block_has(mesh_given + k, MESH_WALL) || turned(k);
    return is_file(r, k) ? !walls : block(k)->angle == 0.0 && no_ring(r, k) && !walls;
}
static bool no_moving_side(const struct run *r, int k)
{
    return (void)r, !mesh_block_has(mesh_given + k, MESH_WALL) &&
                        !mesh_block_has(mesh_given + k, MESH_INFLOW);
}
static bool no_spin(const struct run *r, int k)
{
    const struct mesh_block_params *b = block(k);
    return (void)r, (b->spin[0] != 0.0 && b->i_min != MESH_WALL) ||
                        (b->spin[1] != 0.0 && b->i_max != MESH_WALL) || b->spin[2] != 0.0;
}

/* clang-format off */
static const struct rule rules[] = {
    {"fluid.gravity",     gravity_unseen,    "no direction along it is periodic, and nothing shows the pressure: no wall, no probe, no snapshot of it", true},
    {"fluid.central",     always,            "fv has no central force", false},
    {"domain.periodic",   no_periodic_side,  "no side of the blocks is \"periodic\"", false},
    {"initial.L",         no_length,         "the field has no length", true},
    {"initial.velocity",  nothing_carried,   "the field takes no mean velocity: initial.field = \"uniform\" for a uniform stream", true},
    {"initial.amplitude", no_wave,           "initial.field is no wave", false},
    {"initial.crest",     no_crest,          "only the fields regular and solitary have it", false},
    {"initial.level",     surface_of_shapes, "p = 0 on the free surface, wherever that is", true},
    {"initial.level",     level_unseen,      "no gravity acts across closed sides, or nothing shows the pressure", true},
    {"walls.friction",    always,            "fv has no bed friction, sph has: its slip walls slip, its no_slip walls have that of fluid.nu", true},
    {"walls.velocity",    let_out,           "at an outflow the velocity is part of the solution", true},
    {"walls.level",       dry,               "no water has a free surface", false},
    {"walls.level_file",       dry,               "no water has a free surface", false},
    {"walls.beach",        dry,               "no water has a free surface: there are no waves", false},
    {"walls.beach_period", dry,               "no water has a free surface: there are no waves", false},
    {"walls.level",       is_newton,         "newton has no openings of given level: give it as initial.level, which an outflow has, or rk3 or bdf2", false},
    {"walls.level_file",       is_newton,         "newton has no openings of given level: give it as initial.level, which an outflow has, or rk3 or bdf2", false},
    {"walls.discharge",   dry,               "without a free surface the area of an opening is known: give the velocity", false},
    {"walls.discharge_file",   dry,               "without a free surface the area of an opening is known: give the velocity", false},
    {"probes.body",       no_block_moves,    "no block of that name moves: bodies of fv stand still", false},
    {"probes.radius",     always,            "fv reads the pressure at the point, between its cells", true},
    {"coupling.steps",         alone, "this is no coupled job: it has no group sph", false},
    {"coupling.transition",    alone, "this is no coupled job: it has no group sph", false},
    {"coupling.buffer",        alone, "this is no coupled job: it has no group sph", false},
    {"coupling.overlap",       alone, "this is no coupled job: it has no group sph", false},
    {"coupling.memory",        alone, "this is no coupled job: it has no group sph", false},
    {"coupling.keep_mass",     alone, "this is no coupled job: it has no group sph", false},
    {"coupling.mapping",       alone, "this is no coupled job: it has no group sph", false},
    {"coupling.interpolation", alone, "this is no coupled job: it has no group sph", false},
    {"coupling.in_time",       alone, "this is no coupled job: it has no group sph", false},
    {"coupling.deadline",      alone, "this is no coupled job: it has no group sph", false},
    {"output.fields",     no_pictures,       "output.snapshots = false", true},
    {"fv.cells",          blocks,            "each block has cells of its own", false},
    {"fv.graded",         no_rows,           "the number of equal layers is 0", false},
    {"fv.graded", graded_of_three, "there are two numbers, a height and a number of layers: the third is too much", false},
    {"fv.tol_pressure",   is_newton,         "newton solves for all unknowns at once: see fv.tol_newton", false},
    {"fv.tol_viscous",    is_newton,         "newton solves for all unknowns at once: see fv.tol_newton", false},
    {"fv.tol_viscous",    inviscid,          "fluid.nu = 0: there is no viscous solver", false},
    {"fv.tol_newton",     not_newton,        "it needs fv.integrator = \"newton\"", false},
    {"fv.flux",           not_newton,        "it needs fv.integrator = \"newton\"; rk3 and bdf2 have fv.upwind", false},
    {"fv.c0",             not_newton,        "it needs fv.integrator = \"newton\"", false},
    {"fv.steady",         not_newton,        "it needs fv.integrator = \"newton\"", false},
    {"fv.hole",           no_hole,           "no cell lies wholly in the box", false},
    {"fv.volume",         dry,               "without a free surface no cell holds less water than another", false},
    {"fv.upwind",         is_newton,         "newton has fv.flux", false},
    {"fv.extrema",        no_extrema,        "the first of them is 0", false},
    {"fv.force",          no_forces,         "no block has a side that is a \"wall\"", false},
    {"fv.forced_order",   alone,             "this is no coupled job: no partner imposes velocities", false},
    {"blocks.cells",      is_file,           "the file has its own number of cells", false},
    {"blocks.min",        plane_ring,        "a ring of the plane has centre, radius and arc", false},
    {"blocks.max",        plane_ring,        "a ring of the plane has centre, radius and arc", false},
    {"blocks.min",        is_file,           "the file has the places of the vertices", false},
    {"blocks.max",        is_file,           "the file has the places of the vertices", false},
    {"blocks.centre",     no_centre,         "nothing is turned about it: no angle, no ring, no wall with a moment", false},
    {"blocks.angle",      is_ring,           "a ring is turned by its arc", false},
    {"blocks.angle",      is_file,           "the file has the places of the vertices", false},
    {"blocks.focus",      no_focus,          "it needs mapping = \"stretched\" with a stretch > 0", false},
    {"blocks.stretch",    even,              "only the mappings \"stretched\" and \"annulus\" have it", false},
    {"blocks.stretch",    around,            "a ring is stretched outwards alone, by the first number", false},
    {"blocks.radius",     no_ring,           "it needs mapping = \"annulus\"", false},
    {"blocks.radius",     radius_of_three,   "there are two, inner and outer: the third is too much", false},
    {"blocks.arc",        no_ring,           "it needs mapping = \"annulus\"", false},
    {"blocks.arc",        arc_of_three,      "there are two angles, first and last: the third is too much", false},
    {"blocks.shear",      no_shear,          "it needs mapping = \"sheared\"", false},
    {"blocks.wave",       no_shear,          "it needs mapping = \"sheared\"", false},
    {"blocks.file",       no_file,           "it needs mapping = \"file\"", false},
    {"blocks.zone",       no_zone,           "it needs mapping = \"file\" and a file of Plot3D", false},
    {"blocks.k_min",      planar,            "the case has two dimensions", false},
    {"blocks.k_max",      planar,            "the case has two dimensions", false},
    {"blocks.velocity",   no_moving_side,    "none of the block's sides is \"wall\" or \"inflow\"", false},
    {"blocks.spin",       no_spin,           "it is of the walls i_min and i_max, and that side is no \"wall\"", false},
};
/* clang-format on */

static int length_of(const struct run *r, const char *key)
{
    const struct scene *s = &r->scene;
    const struct {
        const char *name;
        int n;
    } lists[] = {{"walls.", s->nwalls},
                 {"shapes.", s->nshapes},
                 {"probes.", s->nprobes},
                 {"blocks.", mesh_given_count}};
    for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++)
        if (strncmp(key, lists[k].name, strlen(lists[k].name)) == 0)
            return lists[k].n;
    return -1;
}

static void apply(const struct run *r, const struct rule *rule, struct faults *f)
{
    const int n = length_of(r, rule->key);
    if (n < 0)
        params_unused(r->params, f, rule->key, !rule->left_out(r, 0), rule->why);
    for (int k = 0; k < n; k++) {
        char key[80];
        const char *dot = strchr(rule->key, '.');
        snprintf(key, sizeof key, "%.*s.[%d]%s", (int)(dot - rule->key), rule->key, k, dot);
        params_unused(r->params, f, key, !rule->left_out(r, k), rule->why);
    }
}

/* Elements of lists of which nothing is used. */
static void check_elements(const struct run *r, struct faults *f)
{
    static const char *const of_others[] = {"centre", "force", "contact"};
    const struct scene *s = &r->scene;
    char key[64];
    for (int k = 0; k < s->nbodies; k++) {
        struct blocked_params box;
        const char *why = body_box(r, k, &box);
        snprintf(key, sizeof key, "bodies.[%d]", k);
        if (why)
            params_fault(r->params, f, key, "is not used: %s", why);
        for (size_t i = 0; !why && i < sizeof of_others / sizeof of_others[0]; i++) {
            snprintf(key, sizeof key, "bodies.[%d].%s", k, of_others[i]);
            params_unused(r->params, f, key, false, "fv has the force on a box alone");
        }
    }
    for (int k = 0; k < s->nshapes && dry(r, 0); k++) {
        snprintf(key, sizeof key, "shapes.[%d]", k);
        params_fault(r->params, f, key,
                     "is not used: without a free surface (%s) the fluid is "
                     "everywhere",
                     "fv.surface");
    }
}

/* In two dimensions nothing reads a third component. */
static void check_component(const struct run *r, struct faults *f, const struct param_group *g,
                            const struct param *row, int k)
{
    const char *at = (const char *)g->target + g->stride * (size_t)(k < 0 ? 0 : k) + row->offset;
    char key[96];
    bool more = false;
    switch (row->type) {
    case PARAM_REALS:
        more = ((const double *)(const void *)at)[2] != 0.0;
        break;
    case PARAM_INTS:
        more = ((const int *)(const void *)at)[2] != 1;
        break;
    case PARAM_BOOLS:
        more = ((const bool *)(const void *)at)[2];
        break;
    case PARAM_BOX:
        more = ((const double *)(const void *)at)[2] != 0.0 ||
               ((const double *)(const void *)at)[5] != 0.0;
        break;
    default:
        break;
    }
    if (k < 0)
        snprintf(key, sizeof key, "%s.%s", g->name, row->key);
    else
        snprintf(key, sizeof key, "%s.[%d].%s", g->name, k, row->key);
    more = more && strcmp(row->key, "rotate") != 0; /* about z */
    params_unused(r->params, f, key, !more, "a third component in a case of two dimensions");
}

/* These are numbers, no vectors of space. */
static bool is_no_vector(const char *group, const char *key)
{
    static const char *const of[][2] = {{"fv", "graded"},  {"fv", "extrema"},
                                        {"fv", "force"},   {"blocks", "radius"},
                                        {"blocks", "arc"}, {"blocks", "spin"}};
    bool any = false;
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++)
        any = any || (strcmp(group, of[k][0]) == 0 && strcmp(key, of[k][1]) == 0);
    return any;
}

static void check_components(const struct run *r, struct faults *f)
{
    struct param_group g[SCENE_GROUPS + FV_GROUPS];
    struct scene copy = r->scene; /* the table's targets are not to be written */
    scene_groups(&copy, g);
    memcpy(g + SCENE_GROUPS, fv_groups, sizeof fv_groups);
    for (int k = 0; k < SCENE_GROUPS + FV_GROUPS && planar(r, 0); k++)
        for (int q = 0; q < g[k].nrows; q++) {
            if (is_no_vector(g[k].name, g[k].rows[q].key))
                continue;
            if (!g[k].stride)
                check_component(r, f, g + k, g[k].rows + q, -1);
            for (int e = 0; g[k].stride && e < *g[k].count; e++)
                check_component(r, f, g + k, g[k].rows + q, e);
        }
}

/* Each word names a field that this solver can write; partners have others. */
static void check_fields(const struct run *r, struct faults *f)
{
    static const char *const known[] = {"velocity", "pressure", "vorticity", "vorticity_exact"};
    const char *c = r->scene.output.fields;
    for (int n; *c; c += n) {
        bool is = false;
        n = (int)strcspn(c, " ,");
        for (int k = 0; k < 4; k++)
            is = is || (n == (int)strlen(known[k]) && strncmp(c, known[k], (size_t)n) == 0);
        if (n > 0 && !is)
            params_fault(
                r->params, f, "output.fields",
                "%.*s: the fields of fv are velocity, pressure, vorticity, vorticity_exact", n, c);
        n += c[n] != '\0';
    }
    if (!fv_field_wanted(r, "vorticity_exact"))
        return;
    if (mesh_given_count > 0)
        params_fault(r->params, f, "output.fields", "vorticity_exact: not with blocks");
    else if (!exact_at_all_times(&r->scene))
        params_fault(r->params, f, "output.fields",
                     "vorticity_exact: no exact solution of this scene is known at all times");
}

void fv_unused_check(const struct run *r, struct faults *f)
{
    for (size_t k = 0; k < sizeof rules / sizeof rules[0]; k++)
        if (!(r->coupled && rules[k].of_the_partner))
            apply(r, rules + k, f);
    check_components(r, f);
    if (!r->coupled) {
        check_elements(r, f);
        check_fields(r, f);
    }
}

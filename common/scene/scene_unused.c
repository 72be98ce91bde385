/* scene_unused.c - keys of the scene that its own choices leave without use, whatever the solver: a
 * table of key, the choices that use it, and why others do not.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scene_check.h"
#include "scene_mesh.h"
#include "scene_probe.h"
#include "scene_waves.h"

#include <stdio.h>
#include <string.h>

#define BIT(k) (1u << (k))

/* Blocks start, let in and step by these keys in ways of their own. */
static void check_initial(const struct scene *s, const struct params *p, struct faults *f)
{
    static const struct {
        const char *key;
        unsigned fields; /* that use it */
        const char *why;
    } rows[] = {
        {"initial.L",
         BIT(FIELD_TAYLOR_GREEN) | BIT(FIELD_TWO_MODES) | BIT(FIELD_STANDING_WAVE) |
             BIT(FIELD_PATCH) | BIT(FIELD_DROP) | BIT(FIELD_BELTRAMI) | BIT(FIELD_STOKES) |
             BIT(FIELD_REGULAR) | BIT(FIELD_POISEUILLE) | BIT(FIELD_COUETTE),
         "this initial.field has no length of its own"},
        {"initial.velocity",
         BIT(FIELD_UNIFORM) | BIT(FIELD_TAYLOR_GREEN) | BIT(FIELD_TWO_MODES) | BIT(FIELD_BELTRAMI),
         "only the fields uniform, taylor_green, two_modes and beltrami take a mean velocity; a "
         "uniform stream is initial.field = \"uniform\""},
        {"initial.amplitude",
         BIT(FIELD_STANDING_WAVE) | BIT(FIELD_STOKES) | BIT(FIELD_REGULAR) | BIT(FIELD_SOLITARY),
         "only the fields standing_wave, stokes, regular and solitary have a wave"},
        {"initial.crest", BIT(FIELD_REGULAR) | BIT(FIELD_SOLITARY),
         "only the fields regular and solitary have it"},
        {"initial.L_z", BIT(FIELD_STANDING_WAVE), "only the field standing_wave has it"},
    };
    params_unused(p, f, "initial.seed", scene_has_meshes(s),
                  "no mesh divides the domain: the shapes say where the fluid is");
    for (size_t k = 0; !params_has_group(p, "blocks") && k < sizeof rows / sizeof rows[0]; k++)
        params_unused(p, f, rows[k].key, rows[k].fields & BIT(s->initial.field), rows[k].why);
}

/* A row of a list of groups: used where `used' is true. */
static void check_key(const struct params *p, struct faults *f, const char *group, int k,
                      const char *name, bool used, const char *why)
{
    char key[128];
    snprintf(key, sizeof key, "%s.[%d].%s", group, k, name);
    params_unused(p, f, key, used, why);
}

/* Where a surface comes from, and what may be done to it on the way; used: it is a mesh's place. */
static void check_surface(const struct scene *s, const struct params *p, struct faults *f,
                          const char *group, int k, const struct scene_surface *is, bool used,
                          const char *why)
{
    static const char *const keys[] = {"scale", "rotate", "translate"};
    char key[64];
    snprintf(key, sizeof key, "%s.[%d].mesh", group, k);
    if (*is->mesh && s->domain.dim == 2)
        params_fault(p, f, key,
                     "a surface of triangles bounds a fluid of 3 dimensions: in the "
                     "plane give points");
    check_key(p, f, group, k, "mesh", used, why);
    snprintf(key, sizeof key, "%s.[%d].outline", group, k);
    if (*is->outline && s->domain.dim == 3)
        params_fault(p, f, key, "an outline bounds a fluid of 2 dimensions: in space give a mesh");
    for (int i = 0; i < 3; i++)
        check_key(p, f, group, k, keys[i], (used && *is->mesh) || *is->outline,
                  "no mesh and no outline is given");
    check_key(p, f, group, k, "weld", used && *is->mesh, "no mesh is given");
}

static void check_wall(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_wall *w = s->walls + k;
    const bool opening = w->kind >= WALL_INFLOW, out = w->kind == WALL_OUTFLOW;
    const bool mesh = *w->surface.mesh != '\0', in = w->kind == WALL_INFLOW,
               flows = w->has_level || w->has_discharge;
    check_key(p, f, "walls", k, "closed", w->side == SIDE_NONE && !mesh,
              mesh ? "a mesh is closed or not" : "a side of the domain has no ends");
    check_surface(s, p, f, "walls", k, &w->surface, true, "");
    check_key(p, f, "walls", k, "fluid_side", mesh, "it is of a mesh");
    check_key(p, f, "walls", k, "flip", mesh, "it turns the normals of a mesh: turn the points");
    check_key(p, f, "walls", k, "thin", mesh, "it is of a mesh");
    check_key(p, f, "walls", k, "friction", w->kind == WALL_SLIP,
              opening ? "an opening has none; a slip wall has"
                      : "no_slip is friction by viscosity: bed friction is a slip wall's");
    for (int i = 0; i < 2; i++)
        check_key(p, f, "walls", k, i ? "beach_period" : "beach",
                  !opening && w->side != SIDE_NONE && w->zone != ZONE_WAVE,
                  opening                ? "an opening lets waves out by itself"
                  : w->zone == ZONE_WAVE ? "its zone is waves.zone long, of their period"
                                         : "a beach stands before a side of the domain");
    check_key(p, f, "walls", k, "velocity",
              w->kind != WALL_SLIP && (!out || w->carried) && !(opening && flows),
              opening && flows ? "a level or a discharge is given, the velocity follows"
              : out            ? "at an outflow the pressure is given, the velocity follows"
                               : "a slip wall exerts no friction; no_slip does");
    check_key(p, f, "walls", k, "profile", in && !flows,
              in ? "a level or a discharge is given: uniform over the water"
                 : "only an inflow has a profile");
    check_key(p, f, "walls", k, "pressure", (out && !w->carried) || w->kind == WALL_ABSORBING,
              opening ? "the velocity is given here, the pressure follows"
                      : "a wall has none; outflow and absorbing have");
    check_key(p, f, "walls", k, "carried", out && !flows,
              out ? "a level or a discharge is given" : "only an outflow can be");
    for (int i = 0; i < 2; i++) {
        check_key(p, f, "walls", k, i ? "level_file" : "level",
                  (out || in) && !w->carried && !w->has_discharge,
                  w->has_discharge ? "a discharge is given, the level follows"
                  : w->carried     ? "a convective outflow (carried) keeps the level of the start"
                                   : "it is for an inflow or an outflow");
        check_key(p, f, "walls", k, i ? "discharge_file" : "discharge", (out || in) && !w->carried,
                  w->carried ? "of a convective outflow (carried) it is part of the solution"
                             : "it is for an inflow or an outflow");
    }
}

/* Terms of a motion. */
void scene_check_motion(const struct scene_motions *all, const char *list, int k,
                        const struct params *p, struct faults *f)
{
    char group[48];
    snprintf(group, sizeof group, "%s.[%d].motion", list, k);
    for (int i = 0; i < all->n; i++) {
        const int kind = all->of[i].kind;
        const bool file = kind == MOTION_FILE, sine = kind == MOTION_HARMONIC;
        const bool power = kind == MOTION_POLYNOMIAL;
        char key[80];
        snprintf(key, sizeof key, "%s.[%d].kind", group, i);
        if (kind == MOTION_WAVES && strcmp(list, "bodies") != 0)
            params_fault(p, f, key, "only the motion of a body makes waves");
        check_key(p, f, group, i, "file", file, "the kind of this term is not file");
        check_key(p, f, group, i, "axis", !file, "the columns of a file say what moves");
        check_key(p, f, group, i, "amplitude", sine, "only a harmonic term has it");
        check_key(p, f, group, i, "period", sine, "only a harmonic term has it");
        check_key(p, f, group, i, "phase", sine, "only a harmonic term has it");
        check_key(p, f, group, i, "coefficients", power, "only a polynomial has them");
        check_key(p, f, group, i, "from", power, "only a polynomial has it");
        check_key(p, f, group, i, "until", power, "only a polynomial has it");
        check_key(p, f, group, i, "absorb", kind == MOTION_WAVES || all->of[i].made,
                  "only what makes waves (kind = \"waves\") absorbs them");
    }
}

/* What forces need. */
static void check_free(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    static const char *const only[] = {"density", "mass",  "inertia", "lock",
                                       "release", "load",  "torque",  "force_rule",
                                       "lines",   "hinge", "slider",  "contact"};
    const struct scene_body *b = s->bodies + k;
    char group[48];
    for (size_t i = 0; i < sizeof only / sizeof only[0]; i++)
        check_key(p, f, "bodies", k, only[i], b->free,
                  "no force moves this body: it needs free = true");
    if (!b->free)
        return;
    check_key(p, f, "bodies", k, "inertia", b->density <= 0.0, "the density gives it");
    check_key(p, f, "bodies", k, "centre", b->density <= 0.0,
              "the density gives it: give mass, centre and inertia instead");
    check_key(p, f, "bodies", k, "lock", b->hinge.n == 0, "a hinge leaves one rotation alone");
    check_key(p, f, "bodies", k, "velocity", b->hinge.n == 0,
              "a hinge lets the body turn alone: give spin");
    snprintf(group, sizeof group, "bodies.[%d].lines", k);
    for (int i = 0; i < b->lines.n; i++)
        check_key(p, f, group, i, "length", b->lines.of[i].stiffness > 0.0,
                  "a line without stiffness has no length of its own");
    snprintf(group, sizeof group, "bodies.[%d].hinge.axis", k);
    params_unused(p, f, group, s->domain.dim == 3, "in 2 dimensions it is z");
    snprintf(group, sizeof group, "bodies.[%d].hinge.at_rest", k);
    params_unused(p, f, group, b->hinge.n > 0 && b->hinge.of[0].stiffness > 0.0,
                  "a hinge without stiffness has none");
}

static void check_body(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_body *b = s->bodies + k;
    bool file = false;
    for (int i = 0; i < b->motion.n; i++)
        file = file || b->motion.of[i].kind == MOTION_FILE;
    check_key(p, f, "bodies", k, "velocity", !file, "the file of motion says how the body moves");
    check_key(p, f, "bodies", k, "spin", !file, "the file of motion says how the body turns");
    check_surface(s, p, f, "bodies", k, &b->surface, true, "");
    check_key(p, f, "bodies", k, "thin", *b->surface.mesh, "it is of a mesh");
    check_key(p, f, "bodies", k, "force", k == 0,
              "error.force is that of the first body: put this one first");
    scene_check_motion(&b->motion, "bodies", k, p, f);
    check_free(s, p, f, k);
}

static void check_shape(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_shape *h = s->shapes + k;
    check_key(p, f, "shapes", k, "box", h->form == SHAPE_BOX, "the form is not box");
    check_key(p, f, "shapes", k, "outline", h->form == SHAPE_POLYGON, "the form is not polygon");
    check_key(p, f, "shapes", k, "points", h->form == SHAPE_POLYGON, "the form is not polygon");
    check_surface(s, p, f, "shapes", k, &h->surface, h->form == SHAPE_MESH, "the form is not mesh");
    check_key(p, f, "shapes", k, "centre", h->form == SHAPE_DISC, "the form is not disc");
    check_key(p, f, "shapes", k, "radius", h->form == SHAPE_DISC, "the form is not disc");
    check_key(p, f, "shapes", k, "level", h->form == SHAPE_BELOW, "the form is not below");
    check_key(p, f, "shapes", k, "velocity", !h->hole, "a hole has no fluid");
}

static void check_probe(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    check_key(p, f, "probes", k, "radius", s->probes[k].kind == PROBE_PRESSURE,
              "a level is that of a column of the particles' size");
    check_key(p, f, "probes", k, "to", s->probes[k].kind == PROBE_DISCHARGE,
              "only a discharge goes through a line");
    check_key(p, f, "probes", k, "body",
              probe_is_point(s->probes + k) || s->probes[k].kind == PROBE_LEVEL,
              "a discharge and a shore are read at rest");
}

/* A file has waves of its own. */
static void check_wave_file(const struct scene *s, const struct params *p, struct faults *f)
{
    static const char *const own[] = {"height", "length", "period", "peak",  "repeat",
                                      "seed",   "spread", "order",  "evolve"};
    char key[32];
    for (int k = 0; k < 9; k++) {
        snprintf(key, sizeof key, "waves.%s", own[k]);
        params_unused(p, f, key, s->waves.kind != WAVE_FILE, "waves.file tells it");
    }
    params_unused(p, f, "waves.file", s->waves.kind == WAVE_FILE,
                  "only waves of kind file are read from one");
}

static void check_waves(const struct scene *s, const struct params *p, struct faults *f)
{
    const bool sea = s->waves.kind == WAVE_SEA, sums = s->waves.kind != WAVE_REGULAR;
    check_wave_file(s, p, f);
    if (s->waves.kind == WAVE_FILE)
        return;
    params_unused(p, f, "waves.at", !sea, "the phases of a sea are random");
    params_unused(p, f, "waves.peak", sums, "regular waves have no spectrum");
    params_unused(p, f, "waves.repeat", sums, "regular waves repeat themselves every period");
    params_unused(p, f, "waves.order", sums && scene_makes_waves(s),
                  sums ? "a paddle makes the linear waves; a side of kind wave makes bound ones"
                       : "regular waves are of steady form, exact");
    params_unused(p, f, "waves.evolve", sums && scene_makes_waves(s),
                  sums ? "a paddle makes the linear waves; what a side of kind wave makes evolves"
                       : "regular waves keep their form");
    params_unused(p, f, "waves.order", s->waves.evolve == EVOLVE_NO,
                  "waves that evolve (waves.evolve) bind others of all orders by themselves");
    params_unused(p, f, "waves.order", !(s->waves.spread > 0.0) || s->waves.evolve != EVOLVE_NO,
                  "a sea of several directions (waves.spread) is a sum of linear waves");
    params_unused(p, f, "waves.spread", sea && s->domain.dim == 3 && scene_makes_waves(s),
                  !sea ? "only a sea has several directions"
                  : s->domain.dim == 2
                      ? "in 2D waves have one direction"
                      : "a paddle makes long crests: only sides of kind wave do not");
    params_unused(p, f, "waves.seed", sea, "only the phases of a sea are random");
}

void scene_check_unused(const struct scene *s, const struct params *p, struct faults *f)
{
    check_waves(s, p, f);
    check_initial(s, p, f);
    for (int k = 0; k < s->nwalls; k++)
        check_wall(s, p, f, k);
    for (int k = 0; k < s->nbodies; k++)
        check_body(s, p, f, k);
    for (int k = 0; k < s->nshapes; k++)
        check_shape(s, p, f, k);
    for (int k = 0; k < s->nprobes; k++)
        check_probe(s, p, f, k);
}

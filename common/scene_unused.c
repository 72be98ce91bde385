/* scene_unused.c - keys of the scene that its own choices leave without use, whatever the solver: a
 * table of key, the choices that use it, and why others do not.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scene_check.h"

#include <stdio.h>

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
             BIT(FIELD_POISEUILLE) | BIT(FIELD_COUETTE),
         "this initial.field has no length of its own"},
        {"initial.velocity",
         BIT(FIELD_UNIFORM) | BIT(FIELD_TAYLOR_GREEN) | BIT(FIELD_TWO_MODES) | BIT(FIELD_BELTRAMI),
         "only the fields uniform, taylor_green, two_modes and beltrami are carried; a stream "
         "everywhere is initial.field = \"uniform\""},
        {"initial.amplitude", BIT(FIELD_STANDING_WAVE) | BIT(FIELD_STOKES),
         "only the fields standing_wave and stokes have a wave"},
        {"initial.L_z", BIT(FIELD_STANDING_WAVE), "only the field standing_wave has it"},
    };
    for (size_t k = 0; !params_has_group(p, "blocks") && k < sizeof rows / sizeof rows[0]; k++)
        params_unused(p, f, rows[k].key, rows[k].fields & BIT(s->initial.field), rows[k].why);
}

/* A row of a list of groups: used where `used' is true. */
static void check_key(const struct params *p, struct faults *f, const char *group, int k,
                      const char *name, bool used, const char *why)
{
    char key[64];
    snprintf(key, sizeof key, "%s.[%d].%s", group, k, name);
    params_unused(p, f, key, used, why);
}

static void check_wall(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_wall *w = s->walls + k;
    const bool opening = w->kind >= WALL_INFLOW, out = w->kind == WALL_OUTFLOW;
    check_key(p, f, "walls", k, "closed", w->side == SIDE_NONE, "a side of the domain has no ends");
    check_key(p, f, "walls", k, "velocity", w->kind != WALL_SLIP && (!out || w->carried),
              out ? "at an outflow the pressure is given, the velocity is found"
                  : "the fluid slips: a slip wall drags nothing along; no_slip does");
    check_key(p, f, "walls", k, "profile", w->kind == WALL_INFLOW, "only an inflow has a profile");
    check_key(p, f, "walls", k, "pressure", (out && !w->carried) || w->kind == WALL_ABSORBING,
              opening ? "the velocity is given here, the pressure is found"
                      : "a wall has none; outflow and absorbing have");
    check_key(p, f, "walls", k, "carried", out, "only an outflow can be");
}

static void check_body(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const bool moved = s->bodies[k].motion[0] != '\0';
    check_key(p, f, "bodies", k, "velocity", !moved, "the file of motion says how the body moves");
    check_key(p, f, "bodies", k, "spin", !moved, "the file of motion says how the body turns");
    check_key(p, f, "bodies", k, "force", k == 0,
              "error.force is that of the first body: put this one first");
}

static void check_shape(const struct scene *s, const struct params *p, struct faults *f, int k)
{
    const struct scene_shape *h = s->shapes + k;
    check_key(p, f, "shapes", k, "box", h->form == SHAPE_BOX, "the form is not box");
    check_key(p, f, "shapes", k, "points", h->form == SHAPE_POLYGON, "the form is not polygon");
    check_key(p, f, "shapes", k, "centre", h->form == SHAPE_DISC, "the form is not disc");
    check_key(p, f, "shapes", k, "radius", h->form == SHAPE_DISC, "the form is not disc");
    check_key(p, f, "shapes", k, "level", h->form == SHAPE_BELOW, "the form is not below");
    check_key(p, f, "shapes", k, "velocity", !h->hole, "a hole has no fluid");
}

void scene_check_unused(const struct scene *s, const struct params *p, struct faults *f)
{
    check_initial(s, p, f);
    for (int k = 0; k < s->nwalls; k++)
        check_wall(s, p, f, k);
    for (int k = 0; k < s->nbodies; k++)
        check_body(s, p, f, k);
    for (int k = 0; k < s->nshapes; k++)
        check_shape(s, p, f, k);
}

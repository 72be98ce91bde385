/* scene_body.c - keys of bodies. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_body.h"

#include "../geometry/geometry.h"
#include "scene_facts.h"
#include "scene_forms.h"
#include "scene_mesh.h"

#define ROWS(r) (r), (int)(sizeof(r) / sizeof *(r))
#define AXES "x|y|z|rx|ry|rz"
#define BY_FORCE WITH(free, "no force moves this body: it needs free = true")

/* --- when keys are used: tests of conditions --- */

static bool no_motion_file(const void *scene, const void *element)
{
    const struct scene_body *b = element;
    bool file = false;
    for (int k = 0; k < b->motion.n; k++)
        file = file || b->motion.of[k].kind == MOTION_FILE;
    return (void)scene, !file;
}

static bool no_free_density(const void *scene, const void *element)
{
    const struct scene_body *b = element;
    return (void)scene, !b->free || b->density <= 0.0 || b->radius > 0.0;
}

static bool no_free_hinge(const void *scene, const void *element)
{
    const struct scene_body *b = element;
    return (void)scene, !b->free || b->hinge.n == 0;
}

static bool has_section(const void *scene, const void *element)
{
    const struct scene_body *b = element;
    return (void)scene, b->radius > 0.0 || b->points.n > 0 || b->section.n > 0;
}

static bool is_first(const void *scene, const void *element)
{
    return element == (const void *)((const struct scene *)scene)->bodies;
}

#define BY_PARTNER (ONE(MOTION_PARTNER) | ONE(MOTION_BENDING))

/* clang-format off */
#define P struct scene_motion
static const struct param motion_rows[] = {
    CHOICE(P, kind, "file|harmonic|polynomial|waves|partner|bending", "file", "kind of motion; waves: of a body as piston or flap, makes the waves of the group waves; partner: another program of the job moves the body; bending: it moves each point of its outline, in 2D (coupler/README.md)"),
    PARAM(P, file,      "-",   "", 0, 0, "rows t, x, y, angle; in 3D t, x, y, z, rx, ry, rz (rotation vector): displacement from the start",
          USED(ONLY(kind, ONE(MOTION_FILE), "the kind of this term is not file"))),
    CHOICE(P, axis, AXES, "y", "displacement along it, or rotation about it, through the centre",
          USED(ONLY(kind, ~ONE(MOTION_FILE), "the columns of a file say what moves"),
               ONLY(kind, ~BY_PARTNER, "a partner says what moves"))),
    PARAM(P, amplitude, "m or rad", "0.0", -1e9, 1e9, "of A sin(2 pi t/period + phase)",
          USED(ONLY(kind, ONE(MOTION_HARMONIC), "only a harmonic term has it"))),
    PARAM(P, period,    "s",   "0.0", 0, 1e9, "of that",
          USED(ONLY(kind, ONE(MOTION_HARMONIC), "only a harmonic term has it"))),
    PARAM(P, phase,     "rad", "0.0", -1e9, 1e9, "of that",
          USED(ONLY(kind, ONE(MOTION_HARMONIC), "only a harmonic term has it"))),
    PARAM(P, coefficients, "m/s^k or rad/s^k", "0.0", -1e12, 1e12, "c0 + c1 t + c2 t^2 + .. up to the fifth power, t from `from' on",
          USED(ONLY(kind, ONE(MOTION_POLYNOMIAL), "only a polynomial has them"))),
    PARAM(P, from,      "s",   "0.0", 0, 1e9, "start of the polynomial; before, and after `until', its value there holds",
          USED(ONLY(kind, ONE(MOTION_POLYNOMIAL), "only a polynomial has it"))),
    PARAM(P, until,     "s",   "1e9", 0, 1e9, "its end",
          USED(ONLY(kind, ONE(MOTION_POLYNOMIAL), "only a polynomial has it"))),
    PARAM(P, ramp,      "s",   "0.0", 0, 1e9, "the term grows from zero within this time, with continuous velocity and acceleration; a polynomial by its rate, from `from' on",
          USED(ONLY(kind, ~BY_PARTNER, "a partner says how its motion begins"))),
    PARAM(P, absorb,    "-",   "false", 0, 0, "of kind waves: the paddle takes up the waves that come back to it, by a gauge of the level 2 sph.dx before its face",
          USED(ONLY(kind, ONE(MOTION_WAVES), "only what makes waves (kind = \"waves\") absorbs them"))),
};
#undef P
#define P struct scene_line
static const struct param line_rows[] = {
    PARAM(P, from,      "m",     NULL, -1e9, 1e9, "point of the body at the start"),
    PARAM(P, to,        "m",     NULL, -1e9, 1e9, "anchor, or point of the other body at the start"),
    PARAM(P, body,      "-",     "", 0, 0, "name of the other body; by default the anchor is fixed in space"),
    PARAM(P, stiffness, "N/m",   "0.0", 0, 1e15, "force over elongation (in 2D per metre of width)"),
    PARAM(P, length,    "m",     "-1.0", 0, 1e9, "length at zero force; by default that at the start",
          USED(WITH(stiffness, "a line without stiffness has no length of its own"))),
    PARAM(P, damping,   "N s/m", "0.0", 0, 1e15, "force over the rate of its length (in 2D per metre of width)"),
    PARAM(P, pull_only, "-",     "false", 0, 0, "a mooring line: it cannot push"),
};
#undef P
#define P struct scene_hinge
static const struct param hinge_rows[] = {
    PARAM(P, at,        "m",      NULL, -1e9, 1e9, "a point of its axis, fixed in space"),
    PARAM(P, axis,      "-",      "(0.0, 0.0, 1.0)", -1e9, 1e9, "direction, in 3D",
          USED(NEED(SPACE, "in 2 dimensions it is z")), .numbers = 3),
    PARAM(P, stiffness, "N m",    "0.0", 0, 1e15, "moment over angle (in 2D per metre of width)"),
    PARAM(P, damping,   "N m s",  "0.0", 0, 1e15, "moment over angular velocity (in 2D per metre of width)"),
    PARAM(P, at_rest,   "rad",    "0.0", -1e3, 1e3, "angle from the start at which the spring is slack",
          USED(WITH(stiffness, "a hinge without stiffness has none"))),
};
#undef P
#define P struct scene_slider
static const struct param slider_rows[] = {
    PARAM(P, axis, "-", NULL, -1e9, 1e9, "direction in which alone the centre moves"),
};
#undef P
#define P struct scene_contact
static const struct param contact_rows[] = {
    PARAM(P, restitution, "-",  "0.3", 0.01, 1.0, "speed after over speed before"),
    PARAM(P, friction,    "-",  "0.3", 0, 100, "Coulomb's coefficient"),
    PARAM(P, gap,         "dx", "1.5", 0.1, 4.0, "distance at which contact begins, in sph.dx: a layer of particles stays between"),
};
#undef P

#define INNER(T, r, max, plain) {ROWS(r), sizeof(((T *)0)->of[0]), offsetof(T, of), max, plain}
const struct param_list scene_motion_list = INNER(struct scene_motions, motion_rows, MOTIONS_MAX, "file");
static const struct param_list lines = INNER(struct scene_lines, line_rows, LINES_MAX, NULL);
static const struct param_list hinges = INNER(struct scene_hinges, hinge_rows, 1, NULL);
static const struct param_list sliders = INNER(struct scene_sliders, slider_rows, 1, NULL);
static const struct param_list contacts = INNER(struct scene_contacts, contact_rows, 1, NULL);

#define P struct scene_body
const struct param scene_body_rows[] = {
    PARAM(P, name,     "-",   "body#", 0, 0, "its name in the outputs"),
    PARAM(P, points,   "m",   "()", -1e9, 1e9, "corners in order, clockwise (reversed, with a line in the log, if not); with all water inside, in a scene without walls, those of a tank"),
    PARAM(P, box,      "m",   "((0.0, 0.0), (0.0, 0.0))", -1e9, 1e9, "instead of points or a file: two opposite corners of a box along the axes"),
    PARAM(P, radius,   "m",   "0.0", 0, 1e9, "instead: of a disc, in 3D a sphere; its middle is centre, or translate, if only that is given"),
    PARAM(P, length,   "m",   "0.0", 0, 1e9, "in 3D: of a cylinder (radius) or prism (points), along z, half of it on either side of z = 0",
          USED(NEED(SPACE, "in 2 dimensions bodies have no length across the plane"),
               WHERE(has_section, "with radius or points", "it is of a cylinder (radius) or a prism (points)"))),
    SURFACE_ROWS(P, .uses = NULL, .uses = NULL, .uses = NULL),
    PARAM(P, thin,     "-",   "false", 0, 0, "in 3D: fluid on one side does not interact with that on the other",
          USED(NEED(SPACE, "it is of triangles: in 2 dimensions draw both faces, 0.7 of the support apart or more"))),
    CHOICE(P, kind, "slip|no_slip", "slip", "kind of boundary on its surface",
          USED(NEED_OR_ONLY(FRICTION, kind, ONE(WALL_SLIP), "without viscosity (fluid.nu) a body exerts no friction: give slip"))),
    PARAM(P, centre,   "m",   "(0.0, 0.0, 0.0)", -1e9, 1e9, "centre of rotation and of moments at the start; of a free body with mass: its mass centre",
          USED(WHERE(no_free_density, "without free and density, or with radius", "the density gives it: give mass, centre and inertia instead"))),
    PARAM(P, velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "of the centre; of a free body: at the start",
          USED(WHERE(no_motion_file, "no file of motion", "the file of motion says how the body moves"),
               WHERE(no_free_hinge, "no hinge", "a hinge lets the body turn alone: give spin"))),
    TURN(P, spin,      "rad/s", "0.0", -1e6, 1e6, "rate of rotation (3D: vector); of a free body: at the start",
          USED(WHERE(no_motion_file, "no file of motion", "the file of motion says how the body turns"))),
    LIST(P, motion, &scene_motion_list, "prescribed motion, the sum of its terms; a plain text: one file"),
    PARAM(P, force,    "N/m", "(0.0, 0.0, 0.0)", -1e12, 1e12, "known mean force of the fluid on the first body: for error.force",
          USED(WHERE(is_first, "the first body", "error.force is that of the first body: put this one first")), .comparison = true),
    PARAM(P, free,     "-",      "false", 0, 0, "moved by the forces on it"),
    PARAM(P, density,  "kg/m^3", "0.0", 0, 1e9, "of a free body, uniform: gives mass, centre and inertia",
          USED(BY_FORCE)),
    PARAM(P, mass,     "kg",     "0.0", 0, 1e15, "of a free body, instead of density (in 2D per metre of width)",
          USED(BY_FORCE)),
    PARAM(P, inertia,  "kg m^2", "0.0", -1e15, 1e15, "with mass: about the centre; 2D: one number (per metre), 3D: (xx, yy, zz) or (xx, yy, zz, xy, yz, zx), the latter as sums of - m x y",
          USED(BY_FORCE,
               WITHOUT(density, "the density gives it"))),
    PARAM(P, lock,     "-",      "", 0, 0, "of a free body: degrees of freedom that forces do not move, as in \"x rz\"; motion and velocity drive them",
          USED(BY_FORCE,
               WITHOUT(hinge, "a hinge leaves one rotation alone"))),
    PARAM(P, release,  "s",      "0.0", 0, 1e9, "a free body is held until then",
          USED(BY_FORCE)),
    CHOICE(P, force_rule, "conserving|average", "conserving", "force on a free body: momentum that the fluid loses, or kernel averages of pressure and friction",
          USED(BY_FORCE), .comparison = true),
    PARAM(P, load,     "N",      "(0.0, 0.0, 0.0)", -1e15, 1e15, "constant force on a free body beside its weight (in 2D per metre of width)",
          USED(BY_FORCE)),
    TURN(P, torque,    "N m",    "0.0", -1e15, 1e15, "constant moment on a free body (in 2D per metre of width)",
          USED(BY_FORCE)),
    LIST(P, lines, &lines, "springs, dampers and mooring lines of a free body",
          USED(BY_FORCE)),
    LIST(P, hinge, &hinges, "axis fixed in space about which alone a free body turns",
          USED(BY_FORCE)),
    LIST(P, slider, &sliders, "line along which alone a free body's centre moves",
          USED(BY_FORCE)),
    LIST(P, contact, &contacts, "of a free body with walls and other bodies",
          USED(BY_FORCE)),
};
#undef P
/* clang-format on */
const int scene_body_nrows = sizeof scene_body_rows / sizeof scene_body_rows[0];

/* Of the outline or the mesh; 0 where the body has neither. */
void scene_body_box(const struct scene_body *b, double lo[3], double hi[3])
{
    for (int a = 0; a < 3; a++) {
        lo[a] = b->mesh ? b->mesh->lo[a] : 0.0;
        hi[a] = b->mesh ? b->mesh->hi[a] : 0.0;
    }
    if (b->points.n > 0)
        outline_bounds(b->points.n, b->points.x, lo, hi);
}

/* Whether it ever moves: forces, a motion, or a constant velocity. */
int scene_motions_turn(const struct scene_motions *m)
{
    int axes = 0;
    for (int i = 0; i < m->n; i++)
        if (m->of[i].kind == MOTION_HARMONIC || m->of[i].kind == MOTION_POLYNOMIAL)
            axes |= m->of[i].axis >= AXIS_RX ? 1 << (m->of[i].axis - AXIS_RX) : 0;
    return axes;
}

bool scene_body_moves(const struct scene_body *b)
{
    bool any = b->free || b->motion.n > 0;
    for (int a = 0; a < 3; a++)
        any = any || b->velocity[a] != 0.0 || b->spin[a] != 0.0;
    return any;
}

static bool has_motion(const struct scene_body *b, unsigned kinds)
{
    bool any = false;
    for (int i = 0; i < b->motion.n; i++)
        any = any || kinds >> b->motion.of[i].kind & 1;
    return any;
}

bool scene_body_partnered(const struct scene_body *b) { return has_motion(b, BY_PARTNER); }

bool scene_body_bends(const struct scene_body *b) { return has_motion(b, ONE(MOTION_BENDING)); }

struct scene_contact scene_contact_of(const struct scene_body *b)
{
    return b->contact.n > 0 ? b->contact.of[0] : (struct scene_contact){0.3, 0.3, 1.5};
}

/* Bits 1 << enum body_axis; -1: a word that is none of the case's axes. */
int scene_body_locked(const char *lock, int dim)
{
    static const char *const words[BODY_AXES] = {"x", "y", "z", "rx", "ry", "rz"};
    int degrees = 0;
    for (const char *at = lock; *(at += strspn(at, " ,"));) {
        const size_t n = strcspn(at, " ,");
        int found = -1;
        for (int k = 0; k < BODY_AXES; k++)
            if (strlen(words[k]) == n && strncmp(at, words[k], n) == 0)
                found = k;
        if (found < 0 || (dim == 2 && found != AXIS_X && found != AXIS_Y && found != AXIS_RZ))
            return -1;
        degrees |= 1 << found;
        at += n;
    }
    return degrees;
}

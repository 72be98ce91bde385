/* scene_forms.c - see scene_forms.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_forms.h"

#include "../geometry/geometry.h"
#include "scene_geometry.h"
#include "scene_outlines.h"

/* Corners of a disc in the plane, most of a cylinder; levels of a sphere, 20 times 4^level facets.
 */
enum {
    CORNERS = 96,
    CORNERS_LEAST = 32,
    SIDES_LEAST = 16,
    LEVEL_LEAST = 1,
    LEVEL = 3,
    LEVEL_MOST = 5
};
static const double edge_of_level = 1.15; /* of a sphere of radius 1 and level 0, a mean */

/* Of zeroes: not given. */
static bool has_box(const struct scene_body *b)
{
    const double none[2][3] = {{0.0}};
    return memcmp(b->box, none, sizeof none) != 0;
}

enum body_form scene_form_of(const struct scene_body *b)
{
    if (has_box(b))
        return FORM_BOX;
    if (b->radius > 0.0)
        return b->length > 0.0 ? FORM_CYLINDER : FORM_ROUND;
    return b->length > 0.0 ? FORM_PRISM : FORM_NONE;
}

/* --- faults --- */

static bool has(int k, const char *what, const struct params *p)
{
    return params_given(p, key_text("bodies.[%d].%s", k, what));
}

/* The corners of a box may be any two that are opposite. */
static void order_corners(double box[2][3])
{
    for (int a = 0; a < 3; a++) {
        const double x = box[0][a];
        box[0][a] = fmin(x, box[1][a]);
        box[1][a] = fmax(x, box[1][a]);
    }
}

static void check_size(int dim, const double *lo, const double *hi, const char *key,
                       const struct params *p, struct faults *f)
{
    for (int a = 0; a < dim; a++)
        if (!(hi[a] > lo[a])) {
            params_fault(p, f, key, "it has no size along %c: both corners are at %g m", "xyz"[a],
                         lo[a]);
            return;
        }
}

static bool is_clear(const struct scene *s, int k, const struct params *p, struct faults *f)
{
    const struct scene_body *b = s->bodies + k;
    const struct scene_surface *is = &b->surface;
    const int from = f->n;
    const char *key = key_text("bodies.[%d].%s", k,
                               has_box(b)        ? "box"
                               : b->radius > 0.0 ? "radius"
                                                 : "length");
    if (scene_form_of(b) == FORM_PRISM && b->points.n < 3)
        params_fault(p, f, key, "a prism needs three points or more, of its section");
    else if (has_box(b) && b->length > 0.0)
        params_fault(p, f, key, "a length is given, too: a box has its corners alone");
    else if (has_box(b) && b->radius > 0.0)
        params_fault(p, f, key, "a radius is given, too: a body is a box or round");
    else if ((has_box(b) || b->radius > 0.0) && b->points.n > 0)
        params_fault(p, f, key, "points are given, too: leave one of them out");
    else if (b->radius > 0.0 && b->free && b->density > 0.0 && has(k, "centre", p) &&
             has(k, "translate", p))
        params_fault(p, f, key, "centre and translate say both where it is: leave one of them out");
    else if (*is->mesh || *is->outline)
        params_fault(p, f, key, "a %s is given, too: leave one of them out",
                     *is->mesh ? "mesh" : "outline");
    if (has_box(b) && f->n == from)
        check_size(s->domain.dim, b->box[0], b->box[1], key, p, f);
    return f->n == from;
}

/* --- in the plane: corners, clockwise --- */

static void rectangle(const struct scene_body *b, double (*x)[2])
{
    for (int i = 0; i < 4; i++) {
        x[i][0] = b->box[i > 1][0];
        x[i][1] = b->box[i == 1 || i == 2][1];
    }
}

/* A coordinate of a round form, which goes no further than its radius along the axes, so that it
 * stands on a floor. */
static double within(double x, double radius) { return fmax(-radius, fmin(x, radius)); }

/* A polygon of the circle's area. */
static void circle(double radius, int n, double (*x)[2])
{
    const double step = 2.0 * M_PI / n, r = radius * sqrt(step / sin(step));
    for (int i = 0; i < n; i++) {
        x[i][0] = within(r * cos(step * i), radius);
        x[i][1] = within(-r * sin(step * i), radius);
    }
}

/* Corners of a circle with edges of that length, m, 0: the most; a multiple of four, so that some
 * lie on the axes. With fewer than 32 the area is more than 1e-3 too small. */
static int sides_of(double radius, double edge, int least)
{
    const double wanted = edge > 0.0 ? 2.0 * M_PI * radius / edge : CORNERS;
    return 4 * (int)ceil(0.25 * fmin(fmax(wanted, least), CORNERS));
}

/* Clockwise, as bodies are: the fluid on their left is outside. */
static void make_points(struct scene_body *b, enum body_form form, double edge)
{
    double x[CORNERS][2];
    const int n = form == FORM_BOX ? 4 : sides_of(b->radius, edge, CORNERS_LEAST);
    if (form == FORM_BOX)
        rectangle(b, x);
    else
        circle(b->radius, n, x);
    scene_outline_place(&b->surface, n, (const double(*)[2])x, &b->points);
}

/* A round form turns about its middle, unless the case puts it elsewhere: the centre that is given
 * is its place, and its place the centre. */
static void centre_on(struct scene_body *b, int k, const struct params *p)
{
    double *place = b->surface.translate;
    if (!has(k, "translate", p))
        memcpy(place, b->centre, sizeof b->centre);
    else if (!has(k, "centre", p))
        memcpy(b->centre, place, sizeof b->centre);
}

void scene_forms_make(struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nshapes; k++)
        if (s->shapes[k].form == SHAPE_BOX) {
            double(*box)[3] = s->shapes[k].box;
            const char *key = key_text("shapes.[%d].box", k);
            order_corners(box);
            if (params_given(p, key))
                check_size(s->domain.dim, box[0], box[1], key, p, f);
            else
                params_fault(p, f, key,
                             "a box, the default form, without corners: give them, or the form "
                             "that fits: polygon has points, below a level, disc a radius");
        }
    for (int k = 0; k < s->nbodies; k++) {
        struct scene_body *b = s->bodies + k;
        const enum body_form form = scene_form_of(b);
        order_corners(b->box);
        if (form == FORM_NONE || !is_clear(s, k, p, f))
            continue;
        if (b->radius > 0.0)
            centre_on(b, k, p);
        if (s->domain.dim == 2 && form != FORM_PRISM) {
            make_points(b, form, 0.0);
        } else if (form == FORM_PRISM) {
            b->section = b->points;
            b->points.n = 0;
            const struct line l = line_of(&b->section, true);
            if (line_area(&l) < 0.0)
                points_reverse(&b->section);
        }
    }
}

void scene_forms_fit(struct scene *s, double edge)
{
    for (int k = 0; k < s->nbodies && s->domain.dim == 2; k++) {
        struct scene_body *b = s->bodies + k;
        if (scene_form_of(b) != FORM_ROUND || scene_body_bends(b) || b->cut)
            continue;
        make_points(b, FORM_ROUND, edge);
        if (b->turned)
            points_reverse(&b->points);
    }
}

/* --- in space --- */

/* The section runs counter-clockwise. */
static struct trimesh prism(const struct param_points *section, double length)
{
    return trimesh_prism(section->n, (const double(*)[2])section->x, -0.5 * length, 0.5 * length);
}

static struct trimesh cylinder(double radius, int sides, double length)
{
    struct param_points section = {.n = sides};
    circle(radius, sides, section.x);
    points_reverse(&section);
    return prism(&section, length);
}

/* Each level halves the edges; facet is the length, m, that they are to have, 0: the default. */
static int level_of(double radius, double facet)
{
    int level = facet > 0.0 ? LEVEL_LEAST : LEVEL;
    while (facet > 0.0 && level < LEVEL_MOST && edge_of_level * radius > 1.4 * facet * (1 << level))
        level++;
    return level;
}

/* Grown until its facets hold the sphere's volume, for buoyancy goes by that. */
static struct trimesh sphere(double radius, double facet)
{
    const double centre[3] = {0.0};
    struct trimesh m = trimesh_sphere(centre, radius, level_of(radius, facet));
    const double whole = 4.0 / 3.0 * M_PI * radius * radius * radius;
    const double grow = cbrt(whole / trimesh_solid(&m, -1).volume);
    for (int v = 0; v < m.nvertices; v++)
        for (int a = 0; a < 3; a++)
            m.x[v][a] = within(grow * m.x[v][a], radius);
    return m;
}

struct trimesh scene_form_mesh(const struct scene_body *b, double facet)
{
    switch (scene_form_of(b)) {
    case FORM_BOX:
        return trimesh_box(b->box[0], b->box[1], 1);
    case FORM_ROUND:
        return sphere(b->radius, facet);
    case FORM_CYLINDER:
        return cylinder(b->radius, sides_of(b->radius, facet, SIDES_LEAST), b->length);
    default:
        return prism(&b->section, b->length);
    }
}

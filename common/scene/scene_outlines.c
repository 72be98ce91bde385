/* scene_outlines.c - see scene_outlines.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_outlines.h"

#include "../geometry/geometry.h"
#include "scene_forms.h"
#include "scene_lines.h"

void scene_outline_place(const struct scene_surface *is, int n, const double (*x)[2],
                         struct param_points *to)
{
    const double angle = is->rotate[2] * M_PI / 180.0, c = cos(angle), s = sin(angle);
    to->n = n;
    for (int k = 0; k < n; k++) {
        const double u = is->scale * x[k][0], v = is->scale * x[k][1];
        to->x[k][0] = c * u - s * v + is->translate[0];
        to->x[k][1] = s * u + c * v + is->translate[1];
    }
}

/* Corners from a file, or those given, in their place. Whether the file's are closed. whole: its
 * corners on straight lines stay. */
static bool read_one(const char *dir, const char *group, int k, bool whole,
                     const struct scene_surface *is, struct param_points *to,
                     const struct params *p, struct faults *f)
{
    char text[1400];
    struct outline o;
    if (!*is->outline) {
        const struct param_points own = *to;
        scene_outline_place(is, own.n, own.x, to);
        return false;
    }
    const char *key = key_text("%s.[%d].outline", group, k);
    const char *file = case_path(dir, is->outline);
    if (to->n > 0)
        params_fault(p, f, key, "points are given, too: leave one of them out");
    else if (!outline_read(file, PARAM_POINTS_MAX, whole, &o, text, sizeof text))
        params_fault(p, f, key, "%s", text);
    else {
        const bool closed = o.closed;
        scene_outline_place(is, o.n, (const double(*)[2])o.x, to);
        mem_free(o.x);
        return closed;
    }
    return false;
}

void scene_outlines_read(struct scene *s, const char *dir, const struct params *p, struct faults *f)
{
    scene_forms_make(s, p, f);
    for (int k = 0; k < s->nwalls; k++)
        s->walls[k].closed =
            read_one(dir, "walls", k, false, &s->walls[k].surface, &s->walls[k].points, p, f) ||
            s->walls[k].closed;
    for (int k = 0; k < s->nbodies; k++)
        if (scene_form_of(s->bodies + k) == FORM_NONE)
            read_one(dir, "bodies", k, scene_body_bends(s->bodies + k), &s->bodies[k].surface,
                     &s->bodies[k].points, p, f);
    for (int k = 0; k < s->nshapes; k++)
        read_one(dir, "shapes", k, false, &s->shapes[k].surface, &s->shapes[k].points, p, f);
    for (int k = 0; k < s->nbodies; k++)
        s->bodies[k].tank = scene_body_is_tank(s, k);
}

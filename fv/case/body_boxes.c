/* body_boxes.c - see body_boxes.h. SPDX-License-Identifier: BSD-3-Clause */
#include "body_boxes.h"

#include "../../common/scene/scene.h"
#include "fv_case.h"

static const double same = 1e-9; /* of the size */

static bool moves(const struct scene_body *b)
{
    return b->free || b->motion.n > 0 || vec3_length(b->velocity) > 0.0 ||
           vec3_length(b->spin) > 0.0;
}

/* Four corners, each side along an axis. */
static bool is_rectangle(const struct param_points *points, struct blocked_params *box)
{
    if (points->n != 4)
        return false;
    for (int a = 0; a < 2; a++) {
        box->min[a] = INFINITY;
        box->max[a] = -INFINITY;
        for (int i = 0; i < 4; i++) {
            box->min[a] = fmin(box->min[a], points->x[i][a]);
            box->max[a] = fmax(box->max[a], points->x[i][a]);
        }
    }
    const double size = hypot(box->max[0] - box->min[0], box->max[1] - box->min[1]);
    double way = 0.0; /* of the sides along the axes: the perimeter of a rectangle */
    for (int i = 0; i < 4; i++) {
        const double *p = points->x[i], *q = points->x[(i + 1) % 4];
        const double dx = fabs(q[0] - p[0]), dy = fabs(q[1] - p[1]);
        if (fmin(dx, dy) > same * size)
            return false;
        way += dx + dy;
    }
    const double around = 2.0 * (box->max[0] - box->min[0] + box->max[1] - box->min[1]);
    return size > 0.0 && fabs(way - around) < same * size;
}

/* A closed surface that holds as much as the box around it. */
static bool is_cuboid(const struct scene_mesh *m, struct blocked_params *box)
{
    double whole = 1.0;
    for (int a = 0; a < 3; a++)
        whole *= m->hi[a] - m->lo[a];
    memcpy(box->min, m->lo, sizeof box->min);
    memcpy(box->max, m->hi, sizeof box->max);
    return m->mesh.closed && whole > 0.0 && fabs(fabs(m->volume) - whole) < 1e-6 * whole;
}

/* NULL: it is a box, which is filled in; else why it is none. */
const char *body_box(const struct run *r, int k, struct blocked_params *box)
{
    const struct scene *s = &r->scene;
    const struct scene_body *b = s->bodies + k;
    const struct scene_mesh *m = scene_mesh_of(s, MESH_OF_BODY, k);
    *box = (struct blocked_params){.kind = b->kind, .body = k + 1};
    memcpy(box->name, b->name, sizeof box->name);
    if (mesh_given_count > 0)
        return "fv has no bodies beside blocks: leave it out of them, and give their sides kinds";
    if (moves(b))
        return "fv has no bodies that move: a block with a motion does, or sph";
    if (s->domain.dim == 3 ? m && is_cuboid(m, box) : is_rectangle(&b->points, box))
        return NULL;
    return "of bodies fv has boxes along the axes alone, cut out of its cells; another shape is a "
           "block's side (blocks.i_min = \"wall\"), or for sph";
}

int body_boxes(const struct run *r, struct blocked_params *box, int n)
{
    for (int k = 0; k < r->scene.nbodies && !r->coupled && n < BLOCKED_MAX; k++)
        n += body_box(r, k, box + n) == NULL;
    return n;
}

/* body_wedge.c - wedges and slits between bodies and walls that stay where they are, two of a pair
 * of bodies once: a diamond that stands on its corner, a disc on the floor. No particle is in the
 * last two or three spacings of a wedge, and kernels of those before it do not reach all of it.
 * What is there is what a wet surface has of kernels, the fluid's part of the kernel's volume
 * around its points; what is missing of that is sealed. Found at the start; a scene without such
 * points has none to ask. SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "../../common/base/base.h"
#include "../pairs/sph_pairs.h"
#include "bodies.h"
#include "body_seal.h"
#include "body_touch.h"

/* One of them, of a body; walls own the list, as plain memory. */
struct wedge_point {
    struct average_node is;
    int body, other;
    double full; /* -: see seal_point */
    bool narrow; /* the surfaces face each other */
};

enum { SAMPLES = 8 }; /* in R, along an axis */

static const double around = 3.0, shut = 0.01, dense = 0.9; /* dx, dx, - */

static bool stays(const struct walls *w, int body) { return body < 0 || !w->bodies[body].moves; }

/* Whether x is in the fluid on the node's side of its surface. */
static bool is_fluid(const struct sph *s, const struct average_node *d, const double *x)
{
    double e[3] = {d->x[0] - x[0], d->x[1] - x[1], s->dim == 3 ? d->x[2] - x[2] : 0.0};
    int mesh;
    if (vec3_dot(e, d->n) <= 0.0)
        return false;
    return (s->dim == 2 ? walls_distance(s->walls, x, INFINITY)
                        : wall_meshes_nearest(s->walls, x, INFINITY, &mesh).distance) > 0.0;
}

/* The fluid's part of the volume of the kernel around a node. */
static double room_of(const struct sph *s, const struct average_node *d)
{
    const double step = s->R / SAMPLES;
    const int layers = s->dim == 3 ? SAMPLES : 1, all = 4 * SAMPLES * SAMPLES * 2 * layers;
    double sum = 0.0, full = 0.0;
    for (int k = 0; k < (s->dim == 3 ? all : all / 2); k++) {
        const int at[3] = {k % (2 * SAMPLES), k / (2 * SAMPLES) % (2 * SAMPLES),
                           k / (4 * SAMPLES * SAMPLES)};
        double e[3] = {0.0, 0.0, 0.0}, x[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < s->dim; a++) {
            e[a] = (at[a] + 0.5 - SAMPLES) * step;
            x[a] = d->x[a] + e[a];
        }
        const double r = vec3_length(e), W = r < s->R ? kernel_w(s->dim, r, s->R) : 0.0;
        full += W;
        sum += W > 0.0 && is_fluid(s, d, x) ? W : 0.0;
    }
    return sum / full;
}

/* The nearest of what a body shares wedges with, for the node; false: none is near. */
static bool find_other(const struct sph *s, int body, const struct average_node *d,
                       struct wedge_point *to)
{
    const struct walls *w = s->walls;
    double least = INFINITY, out[3];
    for (int k = -1; k < w->nbodies; k++) {
        if (!stays(w, k) || (k >= 0 && k <= body))
            continue;
        const double r = touch_distance(w, s->dim, k, d->x, around * s->dx, out);
        if (r >= least)
            continue;
        least = r;
        *to = (struct wedge_point){.is = *d, .body = body, .other = k};
        to->narrow = vec3_dot(out, d->n) > 0.1;
    }
    return isfinite(least) && least > shut * s->dx;
}

static int add_body(const struct sph *s, int body, struct wedge_point **of, int n)
{
    struct nodes nodes = body_nodes_lay(s, body);
    struct wedge_point *to = *of;
    int more = n;
    bool any = false;
    GROW(to, n, n + nodes.n);
    for (int k = 0; k < nodes.n; k++)
        if (find_other(s, body, nodes.node + k, to + more))
            any = to[more++].narrow || any;
    for (int k = n; k < more && any; k++)
        to[k].full = fmax(dense * room_of(s, &to[k].is), 1e-6);
    mem_free(nodes.node);
    *of = to;
    return any ? more : n;
}

void body_wedges_find(struct sph *s)
{
    struct walls *w = s->walls;
    for (int k = 0; k < w->nbodies && !s->coarser; k++)
        if (stays(w, k))
            w->nwedges = add_body(s, k, &w->wedge, w->nwedges);
}

/* Those of the body of the first; returns their number. */
static int add_wedges(struct sph *s, const struct wedge_point *of, int n)
{
    struct seal_point *point = NEW(struct seal_point, n);
    struct nodes nodes = {.node = NEW(struct average_node, n)};
    for (; nodes.n < n && of[nodes.n].body == of->body; nodes.n++)
        nodes.node[nodes.n] = of[nodes.n].is;
    body_nodes_ask(s, &nodes);
    for (int k = 0; k < nodes.n; k++) {
        point[k] = (struct seal_point){nodes.node + k, of[k].other, of[k].full, 0.0};
        point[k].sealed = of[k].narrow ? 1.0 - seal_wetness(point + k) : 0.0;
    }
    if (s->run->rank == 0)
        seal_points_press(s, of->body, point, nodes.n);
    mem_free(point);
    mem_free(nodes.node);
    return nodes.n;
}

void body_wedges_add(struct sph *s)
{
    const struct walls *w = s->walls;
    for (int k = 0; k < w->nwedges;)
        k += add_wedges(s, w->wedge + k, w->nwedges - k);
}

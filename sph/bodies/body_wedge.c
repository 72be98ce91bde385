/* body_wedge.c - wedges and slits between bodies and walls that stay where they are, two of a pair
 * of bodies once: a diamond that stands on its corner, a disc on the floor. Found at the start; a
 * scene without such places has none to ask. SPDX-License-Identifier: BSD-3-Clause */
#include "bodies.h"
#include "body_seal.h"
#include "body_touch.h"

static const double around = 3.0, shut = 0.01; /* dx */

/* Walls at rest, and bodies that never move. */
static bool stays(const struct walls *w, int body) { return body < 0 || !w->bodies[body].moves; }

/* Whether some node of the body faces the other closely. A face that lies on walls at rest has no
 * water to seep; where one lies on another body its end may be a corner of three owners, as below a
 * slab on two blocks, where what particles exchange is 6 % of p A off. */
static bool is_narrow(const struct sph *s, const struct nodes *nodes, int other)
{
    for (int k = 0; k < nodes->n; k++) {
        const struct average_node *d = nodes->node + k;
        double out[3];
        const double r = touch_distance(s->walls, s->dim, other, d->x, around * s->dx, out);
        if (isfinite(r) && (other >= 0 || r > shut * s->dx) && vec3_dot(out, d->n) > 0.1)
            return true;
    }
    return false;
}

static bool seal_body(const struct sph *s, int body)
{
    struct walls *w = s->walls;
    struct nodes nodes = body_nodes_lay(s, body);
    bool any = false;
    for (int k = body + 1; k <= BODIES_MAX; k++) {
        const int other = k == BODIES_MAX ? -1 : k;
        if (other >= w->nbodies || !stays(w, other) || !is_narrow(s, &nodes, other))
            continue;
        w->sealed[body][k] = w->sealed[k][body] = any = true;
    }
    mem_free(nodes.node);
    return any;
}

/* Pairs that have been in contact since the start are marked first: what they exchange is left to
 * the seals of free bodies. The coarsest level's marks serve all levels. Their points are laid when
 * they are asked for, with the finest spacing and the R of the level that flows at each, for there
 * is no finer level yet. */
void body_wedges_find(struct sph *s)
{
    struct walls *w = s->walls;
    for (int k = 0; k < w->nbodies && w->any_free && !s->coarser; k++)
        seals_mark(w, k);
    for (int k = 0; k < w->nbodies && !s->coarser; k++)
        w->wedged[k] = stays(w, k) && seal_body(s, k);
}

/* Anew when a region has come there, or has left. */
static void lay_points(const struct sph *s)
{
    struct walls *w = s->walls;
    if (w->laid && seal_points_hold(s, w->wedge, w->nwedges))
        return;
    struct seal_point *to = NULL;
    int n = 0;
    for (int k = 0; k < w->nbodies; k++)
        if (w->wedged[k])
            n = seal_points_add(s, k, &to, n);
    mem_free(w->wedge);
    w->nwedges = n;
    w->wedge = mem_own(w, to);
    w->laid = true;
}

/* Points of one body stand together, and each body's are pressed at once, for they find the water
 * around by each other. */
void body_wedges_add(struct sph *s)
{
    const struct walls *w = s->walls;
    lay_points(s);
    for (int k = 0, n; k < w->nwedges; k += n) {
        for (n = 1; k + n < w->nwedges && w->wedge[k + n].body == w->wedge[k].body;)
            n++;
        seal_points_press(s, w->wedge + k, n);
    }
}

/* body_wedge.c - wedges and slits between bodies and walls that stay where they are, two of a pair
 * of bodies once: a diamond that stands on its corner, a disc on the floor. Found at the start, for
 * body_seal.c; a scene without such places has none to ask. SPDX-License-Identifier: BSD-3-Clause
 */
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

/* Pairs that have been in contact since the start are marked first: what they exchange goes on only
 * until they part. The coarsest level's marks serve all levels. */
void body_wedges_find(struct sph *s)
{
    struct walls *w = s->walls;
    for (int k = 0; k < w->nbodies && w->any_free && !s->coarser; k++)
        seals_mark(w, k);
    for (int k = 0; k < w->nbodies && !s->coarser; k++)
        w->wedged[k] = stays(w, k) && seal_body(s, k);
}

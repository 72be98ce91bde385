/* body_seal.c - a free body that has rested on something since the start: no particle fits between,
 * yet real faces are rough and water seeps in. So what is dry there and stands closely before what
 * the body rests on gets the pressure of the wet surface around, as of water at rest, and what it
 * rests on the opposite. SPDX-License-Identifier: BSD-3-Clause */
#include "body_seal.h"

#include <math.h>

#include "../../common/base/base.h"
#include "../walls/sph_walls.h"
#include "bodies.h"
#include "body_touch.h"

static const double wet_plane = 0.2, close_by = 1.25, around = 3.0; /* -, dx, dx */

static bool rests_on(const struct walls *w, int body, int other)
{
    const bool first = other < 0 || !w->bodies[other].free || body < other;
    const int a = first ? body : other, b = first ? other : body;
    return isfinite(w->start_gap[a][b < 0 ? BODIES_MAX : b]);
}

double seal_wetness(const struct seal_point *p) { return fmin(p->is->said.W / p->full, 1.0); }

/* The point of a node; false: far from all that the body rests on. */
static bool classify(const struct sph *s, int body, const struct average_node *d,
                     struct seal_point *to)
{
    const struct walls *w = s->walls;
    double least = INFINITY, facing = 0.0;
    for (int k = -1; k < w->nbodies; k++) {
        double out[3];
        if (k == body || (k >= 0 && !w->bodies[k].free && !w->bodies[body].free) ||
            !rests_on(w, body, k))
            continue;
        const double r = touch_distance(w, s->dim, k, d->x, around * s->dx, out);
        if (r >= least)
            continue;
        least = r;
        to->other = k;
        facing = vec3_dot(out, d->n);
    }
    to->is = d;
    to->full = wet_plane;
    to->sealed = least < close_by * s->dx && facing > 0.1 ? 1.0 - seal_wetness(to) : 0.0;
    return isfinite(least);
}

/* Pressure of water at rest that has the pressures of the rim, those nearer with more weight; where
 * the rim stands in air there is none. */
static double seeping_pressure(const struct sph *s, const struct seal_point *of, int n,
                               const double *x)
{
    double sum = 0.0, weight = 0.0;
    for (int k = 0; k < n; k++) {
        const struct average_node *d = of[k].is;
        double e[3] = {x[0] - d->x[0], x[1] - d->x[1], 0.0};
        e[2] = s->dim == 3 ? x[2] - d->x[2] : 0.0;
        if (of[k].sealed > 0.0)
            continue;
        const double r = vec3_length(e) + 0.25 * s->dx, W = d->area / pow(r, 2.0 * s->dim - 2.0);
        const double p = d->said.P / fmax(d->said.W, of[k].full);
        sum += W * (p + seal_wetness(of + k) * s->rho0 * vec3_dot(s->gravity, e));
        weight += W;
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

void seal_points_press(struct sph *s, int body, const struct seal_point *of, int n)
{
    for (int k = 0; k < n; k++) {
        const struct average_node *d = of[k].is;
        double f[3], back[3];
        if (of[k].sealed == 0.0)
            continue;
        const double p = of[k].sealed * seeping_pressure(s, of, n, d->x);
        for (int a = 0; a < 3; a++) {
            f[a] = p * d->area * d->n[a];
            back[a] = -f[a];
        }
        forces_add(s, body, d->x, f);
        forces_add(s, of[k].other, d->x, back);
    }
}

static void add_seal(struct sph *s, int body)
{
    struct nodes nodes = body_nodes_lay(s, body);
    struct seal_point *of = NEW(struct seal_point, nodes.n);
    int n = 0;
    body_nodes_ask(s, &nodes);
    for (int k = 0; k < nodes.n; k++)
        n += classify(s, body, nodes.node + k, of + n);
    if (s->run->rank == 0)
        seal_points_press(s, body, of, n);
    mem_free(of);
    mem_free(nodes.node);
}

void body_seals_add(struct sph *s)
{
    const struct walls *w = s->walls;
    for (int k = 0; w && k < w->nbodies; k++) {
        bool any = false;
        for (int m = -1; m < w->nbodies && w->bodies[k].free; m++)
            any = any || (m != k && rests_on(w, k, m));
        if (any)
            add_seal(s, k);
    }
    if (w)
        body_wedges_add(s);
}

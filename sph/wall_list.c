/* wall_list.c - see wall_list.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wall_list.h"

#include <math.h>

#include "../common/mem.h"
#include "wall_moments.h"

enum { PRIM = 8, WALL_GROUP = 8 };

void wall_list_free(struct wall_list *l)
{
    mem_free(l->who);
    mem_free(l->first);
    mem_free(l->touch);
    mem_free(l->gamma);
    mem_free(l->boxes);
}

static void room(struct wall_list *l, int touches)
{
    if (l->n + 2 > l->capacity) {
        const int more = 2 * l->capacity + 256;
        GROW(l->who, l->capacity, more);
        GROW(l->first, l->capacity, more);
        GROW(l->gamma, l->capacity, more);
        l->capacity = more;
    }
    if (touches > l->touches_capacity) {
        const int more = 2 * touches + 256;
        GROW(l->touch, l->touches_capacity, more);
        l->touches_capacity = more;
    }
}

/* Neighbours along a polyline share a box, so that most particles are done with few of them. */
static int lay_boxes(const struct walls *w, struct wall_list *l, double reach)
{
    const int n = (w->nsegments + WALL_GROUP - 1) / WALL_GROUP;
    if (n > l->boxes_capacity) {
        GROW(l->boxes, l->boxes_capacity, n);
        l->boxes_capacity = n;
    }
    for (int k = 0; k < n; k++) {
        double *box = l->boxes[k];
        box[0] = box[1] = INFINITY;
        box[2] = box[3] = -INFINITY;
        for (int j = WALL_GROUP * k; j < WALL_GROUP * (k + 1) && j < w->nsegments; j++)
            for (int a = 0; a < 2; a++) {
                const struct segment *g = w->segments + j;
                box[a] = fmin(box[a], fmin(g->a[a], g->b[a]) - reach);
                box[2 + a] = fmax(box[2 + a], fmax(g->a[a], g->b[a]) + reach);
            }
    }
    return n;
}

static bool is_near(const struct segment *g, const double *x, double reach)
{
    const double d[2] = {x[0] - g->a[0], x[1] - g->a[1]};
    const double height = d[0] * g->n[0] + d[1] * g->n[1];
    double out = d[0] * g->t[0] + d[1] * g->t[1];
    out = out < 0.0 ? -out : out > g->length ? out - g->length : 0.0;
    return height * height + out * out < reach * reach;
}

/* The segments of one group near x, behind the first n; returns how many there are then. */
static int list_group(const struct walls *w, struct wall_list *l, int group, const double *x,
                      double reach, int n)
{
    const double *box = l->boxes[group];
    if (x[0] < box[0] || x[1] < box[1] || x[0] > box[2] || x[1] > box[3])
        return n;
    room(l, n + WALL_GROUP);
    for (int k = WALL_GROUP * group; k < WALL_GROUP * (group + 1) && k < w->nsegments; k++)
        if (is_near(w->segments + k, x, reach))
            l->touch[n++].segment = k;
    return n;
}

void wall_list_build(const struct sph *s, struct wall_list *l)
{
    const struct walls *w = s->walls;
    const double reach = s->R + s->skin + w->speed * s->dt_most;
    const int groups = lay_boxes(w, l, reach);
    int touches = 0;
    l->n = 0;
    l->measured = false;
    room(l, 0);
    for (int i = 0; i < s->p.n; i++) {
        const double *x = s->p.prim + (size_t)PRIM * i;
        const int before = touches;
        for (int k = 0; k < groups; k++)
            touches = list_group(w, l, k, x, reach, touches);
        if (touches > before) {
            room(l, touches);
            l->who[l->n] = i;
            l->first[l->n++] = before;
        }
    }
    l->first[l->n] = touches;
}

static void measure(const struct segment *g, const double *x, double R, double q,
                    struct wall_touch *t)
{
    const double d[2] = {g->a[0] - x[0], g->a[1] - x[1]};
    t->height = g->n[0] * d[0] + g->n[1] * d[1];
    t->from = g->t[0] * d[0] + g->t[1] * d[1];
    const struct wall_moments m =
        wall_moments(t->height / R, t->from / R, (t->from + g->length) / R);
    t->gamma = m.gamma;
    t->W = m.W / R;
    for (int a = 0; a < 2; a++)
        t->e[a] = m.along * R * g->t[a] + t->height * g->n[a];
    t->near = fmin(1.0, q * q / (t->e[0] * t->e[0] + t->e[1] * t->e[1]));
}

void wall_list_measure(const struct sph *s, struct wall_list *l)
{
    for (int k = 0; k < l->n; k++) {
        const double *x = s->p.prim + (size_t)PRIM * l->who[k];
        double gamma = 1.0;
        for (int j = l->first[k]; j < l->first[k + 1]; j++) {
            measure(s->walls->segments + l->touch[j].segment, x, s->R, 0.5 * s->dx, l->touch + j);
            gamma += l->touch[j].gamma;
        }
        l->gamma[k] = gamma > 1.0 + 1e-6 ? gamma - 1.0 : gamma; /* behind a wall one more */
    }
    l->measured = true;
}

int wall_list_behind(const struct sph *s, const struct wall_list *l, int *who)
{
    int n = 0;
    for (int k = 0; k < l->n; k++) {
        const double *x = s->p.y + (size_t)l->who[k] * s->p.nstate;
        struct wall_side side = wall_side_none(s->R);
        for (int j = l->first[k]; j < l->first[k + 1]; j++)
            wall_side_add(&side, s->walls->segments + l->touch[j].segment, x);
        if (side.distance < 0.0)
            who[n++] = l->who[k];
    }
    return n;
}

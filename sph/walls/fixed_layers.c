/* fixed_layers.c - see fixed_layers.h. A layer is the wall moved into the solid: segments keep
 * their direction, and where two meet the moved corner lies on their bisector. Ghosts stand dx
 * apart along it, each for as much of the layer: behind a convex wall of radius Rc layers are
 * shorter by 1 - d/Rc, and at the images, as far before it, longer by 1 + d/Rc, which is the ratio
 * of volumes (Rc - d)/(Rc + d) of curved walls [3.11]; the other way round behind a concave one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fixed_layers.h"

/* Two segments that turn by less go on in one layer; else one ends and the other begins. */
static const double smooth = 0.7; /* cosine */

/* The segment that goes on where g ends (way 1) or ends where it begins (0); -1: none. Ends meet
 * within 1e-6 of the segment's length: polylines share points to the last digits of their input. */
static int beside(const struct walls *w, int g, int way)
{
    const struct segment *of = w->segments + g;
    const double *at = way ? of->b : of->a;
    for (int k = 0; k < w->nsegments; k++) {
        const double *other = way ? w->segments[k].a : w->segments[k].b;
        if (k != g && hypot(other[0] - at[0], other[1] - at[1]) < 1e-6 * of->length)
            return k;
    }
    return -1;
}

/* Cosine of the angle between two segments' normals: 1 where the wall goes straight on. */
static double turn_of(const struct walls *w, int g, int o)
{
    const double *a = w->segments[g].n, *b = w->segments[o].n;
    return a[0] * b[0] + a[1] * b[1];
}

/* How a corner moves into the solid, a layer's depth being 1. */
static void mitre(const struct walls *w, int g, int way, double *m)
{
    const int o = beside(w, g, way);
    const double c = o >= 0 ? 1.0 + turn_of(w, g, o) : 0.0;
    for (int a = 0; a < 2; a++)
        m[a] = c > 0.02 ? (w->segments[g].n[a] + w->segments[o].n[a]) / c : w->segments[g].n[a];
}

/* One segment of a layer. */
struct layer_part {
    double a[2], t[2], length;
};

/* Both corners of the segment at `depth', m, behind the wall. At the inside of a sharp corner they
 * change their order: the length is 0 then, and no ghost stands there. */
static struct layer_part part_of(const struct walls *w, int g, double depth)
{
    const struct segment *of = w->segments + g;
    struct layer_part p = {.length = 0.0};
    double ma[2], mb[2];
    mitre(w, g, 0, ma);
    mitre(w, g, 1, mb);
    for (int a = 0; a < 2; a++) {
        p.a[a] = of->a[a] + depth * ma[a];
        p.t[a] = of->t[a];
        p.length += (of->b[a] + depth * mb[a] - p.a[a]) * of->t[a];
    }
    p.length = fmax(p.length, 0.0);
    return p;
}

/* Those nearer to another wall than their depth are left out: there copies of a thin or pointed
 * body overlap. */
static void add_node(const struct sph *s, struct fixed_layers *to, const double *x, double depth,
                     double w)
{
    struct fixed_node d = {.x = {x[0], x[1]}, .w = w};
    d.segment = walls_nearest(s->walls, d.x, d.foot);
    const double r = hypot(x[0] - d.foot[0], x[1] - d.foot[1]);
    if (r < 0.9 * depth || r > s->R + s->dx)
        return;
    GROW(to->of, to->n, to->n + 1);
    to->of[to->n++] = d;
}

/* A layer behind a smooth part of a wall, segments chain[n]. */
static void lay(const struct sph *s, struct fixed_layers *to, int n, const int *chain, double depth)
{
    double whole = 0.0, before = 0.0;
    for (int k = 0; k < n; k++)
        whole += part_of(s->walls, chain[k], depth).length;
    const int places = (int)fmax(1.0, round(whole / s->dx));
    const double apart = whole / places;
    int placed = 0;
    for (int k = 0; k < n && apart > 0.1 * s->dx; k++) {
        const struct layer_part p = part_of(s->walls, chain[k], depth);
        for (; placed < places && (placed + 0.5) * apart <= before + p.length; placed++) {
            const double along = (placed + 0.5) * apart - before;
            const double x[2] = {p.a[0] + along * p.t[0], p.a[1] + along * p.t[1]};
            add_node(s, to, x, depth, apart * s->dx);
        }
        before += p.length;
    }
}

/* Lists the smooth part of a wall from segment g on; returns the number of its segments. */
static int follow(const struct walls *w, int g, int *chain, bool *listed)
{
    int n = 0;
    while (g >= 0 && !listed[g]) {
        listed[g] = true;
        chain[n++] = g;
        const int o = beside(w, g, 1);
        g = o >= 0 && turn_of(w, g, o) > smooth ? o : -1;
    }
    return n;
}

void fixed_layers_lay(const struct sph *s, struct fixed_layers *to)
{
    const struct walls *w = s->walls;
    bool *listed = NEW(bool, w->nsegments + 1);
    int *chain = NEW(int, w->nsegments + 1);
    memset(listed, 0, (size_t)w->nsegments * sizeof *listed);
    for (int closed = 0; closed < 2; closed++) /* what is left is smooth all round */
        for (int g = 0; g < w->nsegments; g++) {
            const int o = beside(w, g, 0);
            if (listed[g] || (!closed && o >= 0 && turn_of(w, g, o) > smooth))
                continue;
            const int n = follow(w, g, chain, listed);
            for (double depth = 0.5 * s->dx; depth < s->R; depth += s->dx)
                lay(s, to, n, chain, depth);
        }
    FREE(listed, chain);
}

void fixed_carry(const struct walls *w, int segment, const double *from, double *to)
{
    const struct segment *a = w->start + segment, *b = w->segments + segment;
    const double d[2] = {from[0] - a->a[0], from[1] - a->a[1]};
    const double along = d[0] * a->t[0] + d[1] * a->t[1], out = d[0] * a->n[0] + d[1] * a->n[1];
    for (int k = 0; k < 2; k++)
        to[k] = b->a[k] + along * b->t[k] + out * b->n[k];
}

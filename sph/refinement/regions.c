/* regions.c - see regions.h. Each region of the case is a piece of its own level and, grown by the
 * margin from level to level, of those above; pieces of a level are united.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "regions.h"

#include <math.h>
#include <string.h>

#include "../../common/mem.h"
#include "../sph_params.h"
#include "apr_params.h"
#include "ball.h"
#include "box_union.h"

struct level {
    struct box_union boxes;
    int nballs;
    struct ball *balls;
};

struct regions {
    const struct apr_params *prm;
    int dim;
    double R, near;    /* m: of level 0; what counts as the same place */
    struct box domain; /* region of the particles */
    struct box room;   /* the same with faces where an edge ends: walls, free ends; else infinite */
    bool periodic[3];
    struct level level[APR_LEVELS_MAX + 1]; /* [1 .. levels] */
};

/* How far a region of level `from' is grown for level `to', m. */
static double growth(const struct regions *g, int from, int to)
{
    double sum = 0.0;
    for (int n = to; n < from; n++) /* edges of n and n + 1 */
        sum += g->prm->margin * ldexp(g->R, 1 - n);
    return sum;
}

/* Images of periodic axes: -1, 0, 1 along each; false: no such image. */
static bool image(const struct regions *g, int k, double *shift)
{
    bool any = true;
    for (int a = 0; a < 3; a++) {
        const int i = (a == 0 ? k % 3 : a == 1 ? k / 3 % 3 : k / 9) - 1;
        any = any && (i == 0 || g->periodic[a]);
        shift[a] = i ? i * (g->domain.hi[a] - g->domain.lo[a]) : 0.0;
    }
    return any;
}

/* Whether [lo, hi] comes as near to the domain as distances are asked for. */
static bool is_near(const struct regions *g, const double *lo, const double *hi)
{
    bool near = true;
    for (int a = 0; a < g->dim; a++)
        near = near && lo[a] < g->domain.hi[a] + 8.0 * g->R && hi[a] > g->domain.lo[a] - 8.0 * g->R;
    return near;
}

/* Faces on walls or beyond, and images' faces far from the domain, are none. */
static void open_faces(const struct regions *g, struct box *b)
{
    for (int a = 0; a < g->dim; a++) {
        const double far = g->periodic[a] ? 8.0 * g->R : INFINITY;
        if (b->lo[a] <= g->room.lo[a] + g->near || b->lo[a] < g->domain.lo[a] - far)
            b->lo[a] = -INFINITY;
        if (b->hi[a] >= g->room.hi[a] - g->near || b->hi[a] > g->domain.hi[a] + far)
            b->hi[a] = INFINITY;
    }
}

static int add_box(const struct regions *g, const struct apr_region *is, double grow,
                   struct box **all, int n)
{
    double shift[3];
    for (int k = 0; k < 27; k++) {
        if (!image(g, k, shift))
            continue;
        struct box b;
        for (int a = 0; a < 3; a++) {
            b.lo[a] = is->min[a] - grow + shift[a];
            b.hi[a] = is->max[a] + grow + shift[a];
        }
        if (!is_near(g, b.lo, b.hi))
            continue;
        open_faces(g, &b);
        GROW(*all, n, n + 1);
        (*all)[n++] = b;
    }
    return n;
}

static void add_ball(const struct regions *g, const struct apr_region *is, double grow,
                     struct level *l)
{
    double shift[3];
    for (int k = 0; k < 27; k++) {
        if (!image(g, k, shift))
            continue;
        struct ball b = {.radius = is->radius + grow};
        double lo[3], hi[3];
        for (int a = 0; a < 3; a++) {
            b.centre[a] = is->centre[a] + shift[a];
            lo[a] = b.centre[a] - b.radius;
            hi[a] = b.centre[a] + b.radius;
        }
        if (!is_near(g, lo, hi))
            continue;
        GROW(l->balls, l->nballs, l->nballs + 1);
        l->balls[l->nballs++] = b;
    }
}

static void make_level(struct regions *g, int n)
{
    struct level *l = g->level + n;
    struct box *boxes = NULL;
    int nboxes = 0;
    for (int k = 0; k < g->prm->regions.n; k++) {
        const struct apr_region *is = g->prm->regions.of + k;
        if (is->level < n)
            continue;
        if (is->shape == REGION_BOX)
            nboxes = add_box(g, is, growth(g, is->level, n), &boxes, nboxes);
        else
            add_ball(g, is, growth(g, is->level, n), l);
    }
    l->boxes = box_union_create(g->dim, nboxes, boxes, g->near);
    mem_free(boxes);
}

static void set_domain(struct regions *g, const struct run *r, const struct sph_params *prm)
{
    bool open[6];
    g->dim = r->scene.domain.dim;
    sph_params_region(&r->scene.domain, prm, g->domain.lo, g->domain.hi, g->periodic);
    sph_params_open(r, prm, open);
    for (int a = 0; a < 3; a++) {
        const bool no_end = g->periodic[a] || a >= g->dim;
        g->room.lo[a] = no_end || open[2 * a] ? -INFINITY : g->domain.lo[a];
        g->room.hi[a] = no_end || open[2 * a + 1] ? INFINITY : g->domain.hi[a];
    }
}

struct regions *regions_create(const struct run *r, const struct sph_params *prm)
{
    const struct apr_params *used = apr_params_of(r);
    if (!used)
        return NULL;
    struct regions *g = NEW(struct regions, 1);
    g->prm = used;
    g->R = prm->R_dx * prm->dx;
    g->near = 1e-6 * ldexp(prm->dx, -used->levels);
    set_domain(g, r, prm);
    for (int n = 1; n <= used->levels; n++)
        make_level(g, n);
    return g;
}

void regions_free(struct regions **g)
{
    if (!*g)
        return;
    for (int n = 1; n <= (*g)->prm->levels; n++) {
        box_union_free(&(*g)->level[n].boxes);
        mem_free((*g)->level[n].balls);
    }
    mem_free(*g);
    *g = NULL;
}

int regions_levels(const struct regions *g) { return g->prm->levels; }

double regions_distance(const struct regions *g, int level, const double *x)
{
    const struct level *l = g->level + level;
    double d = box_union_distance(&l->boxes, x);
    for (int k = 0; k < l->nballs; k++)
        d = fmax(d, ball_distance(l->balls + k, g->dim, &g->room, x));
    return d;
}

void regions_move(struct regions *g, double t)
{
    (void)g;
    (void)t;
}

void regions_save(const struct regions *g, struct h5 *f)
{
    (void)g;
    (void)f;
}

bool regions_load(struct regions *g, struct h5 *f)
{
    (void)g;
    (void)f;
    return true;
}

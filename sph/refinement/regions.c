/* regions.c - regions of the case as pieces of levels, and the distance to a level's edge. Each
 * region of the case is a piece of its own level and, grown by the margin from level to level, of
 * those above; pieces of a level are united. A level is a union of boxes, balls, layers around
 * surfaces and cells that criteria mark; its distance is the largest of theirs. Boxes are united
 * exactly (box_union.c), of different kinds the maximum is a lower bound inside and exact outside.
 * All ranks hold all of it; nothing is exchanged.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "regions.h"

#include "../open_boundaries/sph_open_boundaries.h"
#include "criteria.h"
#include "regions_parts.h"

/* How far region k is grown for level n, m; < 0: it has no part in this level. Regions around which
 * the case has one of the level below itself are not grown. */
static double growth(const struct regions *g, int k, int n)
{
    double sum = 0.0;
    const int from = g->prm->regions.of[k].level;
    if (n > from || (n < from && !g->alone[k]))
        return -1.0;
    for (int m = n; m < from; m++)
        sum += regions_margin(g, m);
    return sum;
}

/* Shifts to the images of periodic axes, the thing itself first. Up to 27, among them those along
 * several periodic axes. */
static void find_images(struct regions *g)
{
    static const int step[3] = {0, -1, 1};
    g->nimages = 0;
    for (int k = 0; k < 27; k++) {
        const int at[3] = {step[k % 3], step[k / 3 % 3], step[k / 9]};
        bool any = true;
        for (int a = 0; a < 3; a++)
            any = any && (at[a] == 0 || g->periodic[a]);
        for (int a = 0; a < 3 && any; a++)
            g->image[g->nimages][a] = at[a] ? at[a] * (g->domain.hi[a] - g->domain.lo[a]) : 0.0;
        g->nimages += any;
    }
}

/* Takes what moves around a period back to the domain. */
static void add_shift(const struct regions *g, const struct region_set *s, double *shift)
{
    for (int a = 0; a < g->dim; a++) {
        const double L = g->domain.hi[a] - g->domain.lo[a];
        const double turns =
            g->periodic[a] ? floor((s->centre[a] + s->shift[a] - g->domain.lo[a]) / L) : 0.0;
        shift[a] += s->shift[a] - L * turns;
    }
}

/* Distances are exact up to this from the domain, m. */
static double reach(const struct regions *g) { return 8.0 * g->R; }

/* Whether a piece can matter for a distance within the domain. */
static bool is_near(const struct regions *g, const double *lo, const double *hi)
{
    bool near = true;
    for (int a = 0; a < g->dim; a++)
        near = near && lo[a] < g->domain.hi[a] + reach(g) && hi[a] > g->domain.lo[a] - reach(g);
    return near;
}

/* --- faces on walls --- */

/* Whether closed walls leave fluid no place at x. */
static bool is_solid(const struct regions *g, const double *x)
{
    const struct scene *c = &g->run->scene;
    bool solid = false;
    for (int k = 0; k < c->nwalls && !solid; k++) {
        const struct scene_mesh *m = scene_mesh_of(c, MESH_OF_WALL, k);
        const struct line l = line_of(&c->walls[k].points, true);
        if (m)
            solid = m->mesh.closed && !scene_mesh_holds(m, x);
        else if (c->walls[k].closed && l.n > 0)
            solid = line_inside(&l, x) != (line_area(&l) > 0.0);
    }
    return solid;
}

/* Whether no part of a face of the box within the domain is before walls. */
static bool face_is_solid(const struct regions *g, const struct box *b, int axis, bool high)
{
    enum { SAMPLES = 16 };
    const int u = (axis + 1) % g->dim, v = (axis + 2) % g->dim;
    double x[3] = {0.0, 0.0, 0.0}, from[3], length[3];
    for (int a = 0; a < g->dim; a++) {
        from[a] = fmax(b->lo[a], g->domain.lo[a]);
        length[a] = fmin(b->hi[a], g->domain.hi[a]) - from[a];
        if (a != axis && length[a] <= 0.0)
            return true;
    }
    x[axis] = high ? b->hi[axis] + g->near : b->lo[axis] - g->near;
    for (int i = 0; i < SAMPLES; i++)
        for (int j = 0; j < (g->dim == 3 ? SAMPLES : 1); j++) {
            x[u] = from[u] + (i + 0.5) / SAMPLES * length[u];
            if (g->dim == 3)
                x[v] = from[v] + (j + 0.5) / SAMPLES * length[v];
            if (!is_solid(g, x))
                return false;
        }
    return true;
}

/* Whether any wall can have solid behind it, so that faces may lie in it. */
static bool has_closed_walls(const struct regions *g)
{
    const struct scene *c = &g->run->scene;
    bool any = false;
    for (int k = 0; k < c->nwalls; k++)
        any = any || c->walls[k].closed || scene_mesh_of(c, MESH_OF_WALL, k);
    return any;
}

/* Faces on sides of the domain or beyond, and images' faces far from it, are none; those in the
 * solid of closed walls go so deep into it that no guard is before them. R is that of the level
 * outside: guards lie up to R inside of the edge. */
static void open_faces(const struct regions *g, struct box *b, double R)
{
    const bool walls = has_closed_walls(g);
    for (int a = 0; a < g->dim; a++) {
        const double far = g->periodic[a] ? reach(g) : INFINITY;
        if (b->lo[a] <= g->room.lo[a] + g->near || b->lo[a] < g->domain.lo[a] - far)
            b->lo[a] = -INFINITY;
        else if (walls && face_is_solid(g, b, a, false))
            b->lo[a] -= 1.001 * R;
        if (b->hi[a] >= g->room.hi[a] - g->near || b->hi[a] > g->domain.hi[a] + far)
            b->hi[a] = INFINITY;
        else if (walls && face_is_solid(g, b, a, true))
            b->hi[a] += 1.001 * R;
    }
}

/* --- pieces of a level --- */

struct pieces {
    int n, level;
    struct box *box;
};

/* Adds the images of box k, moved as its set has moved and grown by `grow', to the pieces of a
 * level. */
static void add_box(const struct regions *g, int k, double grow, struct pieces *to)
{
    const struct apr_region *is = g->prm->regions.of + k;
    double shift[3];
    for (int i = 0; i < g->nimages; i++) {
        struct box b;
        memcpy(shift, g->image[i], sizeof shift);
        add_shift(g, g->sets + g->set_of[k], shift);
        for (int a = 0; a < 3; a++) {
            b.lo[a] = is->min[a] - grow + shift[a];
            b.hi[a] = is->max[a] + grow + shift[a];
        }
        if (!is_near(g, b.lo, b.hi))
            continue;
        open_faces(g, &b, regions_R(g, to->level - 1));
        GROW(to->box, to->n, to->n + 1);
        to->box[to->n++] = b;
    }
}

/* The same of a sphere. */
static void add_ball(struct regions *g, int k, double grow, struct level *l)
{
    const struct apr_region *is = g->prm->regions.of + k;
    double shift[3], lo[3], hi[3];
    for (int i = 0; i < g->nimages; i++) {
        struct ball b = {.radius = is->radius + grow};
        memcpy(shift, g->image[i], sizeof shift);
        add_shift(g, g->sets + g->set_of[k], shift);
        for (int a = 0; a < 3; a++) {
            b.centre[a] = is->centre[a] + shift[a];
            lo[a] = b.centre[a] - b.radius;
            hi[a] = b.centre[a] + b.radius;
        }
        if (!is_near(g, lo, hi))
            continue;
        GROW_IN(g, l->balls, l->nballs, l->nballs + 1);
        l->balls[l->nballs++] = b;
    }
}

/* Makes the pieces of level n anew from all regions that have a part in it. */
static void make_level(struct regions *g, int n)
{
    struct level *l = g->level + n;
    struct pieces boxes = {.level = n};
    DROP(l->boxes.of);
    l->nballs = l->nlayers = 0;
    for (int k = 0; k < g->prm->regions.n; k++) {
        const struct apr_region *is = g->prm->regions.of + k;
        const double grow = growth(g, k, n);
        if (grow < 0.0)
            continue;
        if (is->shape == REGION_BOX) {
            add_box(g, k, grow, &boxes);
        } else if (is->shape == REGION_SPHERE) {
            add_ball(g, k, grow, l);
        } else {
            GROW_IN(g, l->layers, l->nlayers, l->nlayers + 1);
            l->layers[l->nlayers++] = (struct layer){g->shell_of[k], is->offset + grow};
        }
    }
    l->boxes = box_union_create(g, g->dim, boxes.n, boxes.box, g->near);
    mem_free(boxes.box);
}

/* Makes boxes, balls and layers of all levels from the regions as they have moved. */
static void make_parts(struct regions *g)
{
    for (int n = 1; n <= g->prm->levels; n++)
        make_level(g, n);
}

/* --- distances --- */

/* Of a point from the surface, around periods, too. width minus the distance from the surface:
 * positive inside the layer. */
static double layer_distance(const struct regions *g, const struct layer *l, const double *x)
{
    double best = INFINITY;
    for (int i = 0; i < g->nimages; i++) {
        double at[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < g->dim; a++)
            at[a] = x[a] + g->image[i][a];
        const double d = shell_distance(g->shells + l->shell, at, l->width);
        best = d < best ? d : best;
    }
    return l->width - best;
}

/* O(pieces of the level) for each call; particles ask once a step for each level that concerns
 * them. */
double regions_fixed_distance(const struct regions *g, int level, const double *x)
{
    const struct level *l = g->level + level;
    double d = box_union_distance(&l->boxes, x);
    for (int k = 0; k < l->nballs; k++)
        d = fmax(d, ball_distance(l->balls + k, g->dim, &g->room, x));
    for (int k = 0; k < l->nlayers; k++)
        d = fmax(d, layer_distance(g, l->layers + k, x));
    return d;
}

double regions_distance(const struct regions *g, int level, const double *x)
{
    const struct marks *c = g->level[level].cells;
    const double d = regions_fixed_distance(g, level, x), e = c ? marks_distance(c, x) : d;
    return e > d ? e : d;
}

int regions_levels(const struct regions *g) { return g->prm->levels; }

/* --- life --- */

/* domain is the region of the particles; room is what has no edge at walls and ends of it, hence
 * infinite where it is periodic or open. */
static void set_domain(struct regions *g, const struct run *r, const struct sph_params *prm)
{
    double transition, buffer;
    g->dim = r->scene.domain.dim;
    zones_widths(r, prm, &transition, &buffer);
    g->zones = transition + buffer;
    sph_params_region(&r->scene.domain, prm, g->domain.lo, g->domain.hi, g->periodic);
    sph_params_open(r, prm, g->open);
    for (int a = 0; a < 3; a++) {
        const bool no_end = g->periodic[a] || a >= g->dim;
        g->room.lo[a] = no_end || g->open[2 * a] ? -INFINITY : g->domain.lo[a];
        g->room.hi[a] = no_end || g->open[2 * a + 1] ? INFINITY : g->domain.hi[a];
    }
}

/* Surfaces of bodies and walls with their search trees, one for each region of that shape. */
static void add_shells(struct regions *g)
{
    const struct scene *c = &g->run->scene;
    for (int k = 0; k < g->prm->regions.n; k++) {
        const struct apr_region *is = g->prm->regions.of + k;
        g->shell_of[k] = -1;
        if (is->shape < REGION_BODY)
            continue;
        const bool body = is->shape == REGION_BODY;
        const int n = g->shell_of[k] = g->nshells++;
        const int index = body ? region_body(c, is->body) : is->wall - 1;
        g->body_of[n] = body ? index : -1;
        g->shells[n] = shell_create(g, c, body ? MESH_OF_BODY : MESH_OF_WALL, index);
    }
}

/* A region within one of the level below that moves alike has an outer one given. */
static void find_alone(struct regions *g)
{
    for (int k = 0; k < g->prm->regions.n; k++)
        g->alone[k] = !regions_outer_given(g, k);
}

/* criteria_create comes last: it reads the fixed regions of all levels. */
struct regions *regions_create(const struct run *r, const struct sph_params *prm)
{
    const struct apr_params *used = apr_params_of(r);
    if (!used)
        return NULL;
    struct regions *g = NEW(struct regions, 1);
    g->run = r;
    g->prm = used;
    g->R = prm->R_dx * prm->dx;
    g->dx = prm->dx;
    g->near = 1e-6 * ldexp(prm->dx, -used->levels);
    set_domain(g, r, prm);
    g->start[0] = g->domain;
    g->start[1] = g->room;
    g->goes = box_motion_wanted(prm);
    g->speed = box_motion_speed(r, prm);
    find_images(g);
    for (int k = 0; k < BODIES_MAX; k++)
        for (int a = 0; a < 3; a++)
            g->bodies[k].Q[a][a] = 1.0;
    region_sets_create(g);
    add_shells(g);
    find_alone(g);
    region_sets_move(g, r->t);
    make_parts(g);
    g->criteria = criteria_create(g);
    return g;
}

/* Cells of criteria move with the box: their marks stay with the flow around the box. */
void regions_set_box(struct regions *g, const double way[3])
{
    struct box *const both[2] = {&g->domain, &g->room};
    for (int a = 0; a < g->dim; a++) {
        g->gone = g->gone || way[a] != g->way[a];
        g->way[a] = way[a];
        for (int k = 0; k < 2; k++) { /* room is infinite at open sides */
            both[k]->lo[a] = g->start[k].lo[a] + way[a];
            both[k]->hi[a] = g->start[k].hi[a] + way[a];
        }
        for (int n = 1; n <= g->prm->levels; n++)
            if (g->level[n].cells)
                g->level[n].cells->lo[a] = g->domain.lo[a];
    }
}

static void move_shells(struct regions *g)
{
    for (int n = 0; n < g->nshells; n++)
        if (g->body_of[n] >= 0)
            shell_move(g->shells + n, g->bodies + g->body_of[n]);
}

/* Pieces are made anew only if something has moved. */
void regions_move(struct regions *g, double t)
{
    move_shells(g);
    if (region_sets_move(g, t) || g->gone)
        make_parts(g);
    g->gone = false;
}

/* --- restart --- */

/* Numbers saved of a body: displacement and rotation matrix. */
enum { POSE = 12 };

/* Positions are kept as they are, not computed from t: what follows something has a history. Marks
 * of criteria come last, for they hold only in the region as it stands. */
bool regions_restart(struct regions *g, struct h5 *f)
{
    double shift[REGIONS_MAX][3], pose[BODIES_MAX][POSE], way[3];
    memcpy(way, g->way, sizeof way);
    for (int n = 0; n < g->nsets; n++)
        memcpy(shift[n], g->sets[n].shift, sizeof shift[n]);
    for (int k = 0; k < BODIES_MAX; k++) {
        memcpy(pose[k], g->bodies[k].x, sizeof g->bodies[k].x);
        memcpy(pose[k] + 3, g->bodies[k].Q, sizeof g->bodies[k].Q);
    }
    if (!h5_keep_rows(f, "apr_shift", "m", g->nsets, 3, shift[0]) ||
        !h5_keep_rows(f, "apr_bodies", "m", BODIES_MAX, POSE, pose[0]) ||
        (g->goes && !h5_keep_rows(f, "apr_box", "m", 1, 3, way)))
        return false;
    if (h5_writes(f))
        return criteria_restart(g, f);
    if (g->goes)
        regions_set_box(g, way);
    for (int n = 0; n < g->nsets; n++)
        memcpy(g->sets[n].shift, shift[n], sizeof shift[n]);
    for (int k = 0; k < BODIES_MAX; k++) {
        memcpy(g->bodies[k].x, pose[k], sizeof g->bodies[k].x);
        memcpy(g->bodies[k].Q, pose[k] + 3, sizeof g->bodies[k].Q);
    }
    move_shells(g);
    make_parts(g);
    return criteria_restart(g, f);
}

/* region_motion.c - regions that move as prescribed, with a body, or with the largest pressure.
 * What follows goes no farther in a step than half a spacing of its finest level, so that particles
 * just born have settled before they flow. SPDX-License-Identifier: BSD-3-Clause */
#include "regions.h"
#include "regions_parts.h"

int region_body(const struct scene *c, const char *name)
{
    for (int k = 0; k < c->nbodies; k++)
        if (strcmp(c->bodies[k].name, name) == 0)
            return k;
    return BODIES_MAX;
}

/* As bits; -1: a letter that is no axis. An empty text is all axes. */
int region_axes(const char *along, int dim)
{
    int axes = 0;
    for (; *along; along++) {
        if (*along == ' ' || *along == ',')
            continue;
        if (*along < 'x' || *along >= 'x' + dim)
            return -1;
        axes |= 1 << (*along - 'x');
    }
    return axes ? axes : (1 << dim) - 1;
}

/* Whether two regions of the case move alike, and so can share one set. */
static bool alike(const struct apr_region *a, const struct apr_region *b)
{
    bool same = a->motion.n == b->motion.n && a->pressure == b->pressure &&
                strcmp(a->follow, b->follow) == 0 && strcmp(a->along, b->along) == 0 &&
                memcmp(a->velocity, b->velocity, sizeof a->velocity) == 0;
    for (int k = 0; k < a->motion.n && same; k++)
        same = memcmp(a->motion.of + k, b->motion.of + k, sizeof a->motion.of[k]) == 0;
    return same;
}

/* The centre of a box or sphere as the case has it, m. */
static void centre_of(const struct apr_region *is, double *x)
{
    for (int a = 0; a < 3; a++)
        x[a] = is->shape == REGION_BOX ? 0.5 * (is->min[a] + is->max[a]) : is->centre[a];
}

/* Begins a set of regions that move like `is': with the box, the peak, a body, or by a motion of
 * their own, which is read as that of a body; speed is its largest, m/s. */
static void start_set(struct regions *g, struct region_set *s, const struct apr_region *is)
{
    const struct run *r = g->run;
    const int axes = region_axes(is->along, g->dim);
    *s = (struct region_set){.is = is, .body = -1};
    s->told.motion = is->motion;
    memcpy(s->told.velocity, is->velocity, sizeof is->velocity);
    body_drive_create(&s->drive, &s->told, g->dim, r->motions);
    s->speed = scene_body_moves(&s->told) ? body_drive_speed(&s->drive, 0.0, r->scene.time.end) : 0;
    s->peak = strcmp(is->follow, "peak") == 0;
    s->box = strcmp(is->follow, "sph.box") == 0;
    if (s->box)
        s->speed = g->speed;
    if (*is->follow && !s->peak && !s->box)
        s->body = region_body(&r->scene, is->follow);
    for (int a = 0; a < 3; a++)
        s->along[a] = axes >> a & 1;
}

/* Puts every box and sphere into a set of those that move alike; shells move with their bodies. The
 * centre of a set is that of its finest region. */
void region_sets_create(struct regions *g)
{
    for (int k = 0; k < g->prm->regions.n; k++) {
        const struct apr_region *is = g->prm->regions.of + k;
        g->set_of[k] = -1;
        if (is->shape >= REGION_BODY)
            continue;
        int n = 0;
        while (n < g->nsets && !alike(g->sets[n].is, is))
            n++;
        if (n == g->nsets)
            start_set(g, g->sets + g->nsets++, is);
        g->set_of[k] = n;
        if (is->level > g->sets[n].finest) {
            g->sets[n].finest = is->level;
            centre_of(is, g->sets[n].centre);
        }
    }
}

/* Goes towards a place, at most half a spacing of the finest level. One step of particles later it
 * goes on from there, so a fast target is followed with a lag. */
static void follow(const struct regions *g, struct region_set *s, const double *to)
{
    double way[3] = {0.0, 0.0, 0.0}, length = 0.0;
    for (int a = 0; a < g->dim; a++) {
        way[a] = s->along[a] ? to[a] - s->shift[a] : 0.0;
        length += way[a] * way[a];
    }
    length = sqrt(length);
    const double most = 0.5 * ldexp(g->dx, -s->finest);
    const double share = length > most ? most / length : 1.0;
    for (int a = 0; a < g->dim; a++)
        s->shift[a] += share * way[a];
}

/* Follows the point of the body that was at the set's centre at the start: centre + x + Q (c -
 * centre). */
static void follow_body(const struct regions *g, struct region_set *s)
{
    const struct scene_body *b = g->run->scene.bodies + s->body;
    const struct body_motion *now = g->bodies + s->body;
    double to[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < g->dim; a++) {
        to[a] = b->centre[a] + now->x[a] - s->centre[a];
        for (int k = 0; k < g->dim; k++)
            to[a] += now->Q[a][k] * (s->centre[k] - b->centre[k]);
    }
    follow(g, s, to);
}

/* The peak jumps between particles: it is followed where it is farther from the centre than R. The
 * way is the shortest one across periods. */
static void follow_peak(const struct regions *g, struct region_set *s)
{
    double way[3] = {0.0, 0.0, 0.0}, to[3], length = 0.0;
    const double leash = regions_R(g, s->finest);
    if (!g->peak_known || g->peak_pressure < s->is->pressure)
        return;
    for (int a = 0; a < g->dim; a++) {
        const double period = g->domain.hi[a] - g->domain.lo[a];
        way[a] = s->along[a] ? g->peak[a] - s->centre[a] - s->shift[a] : 0.0;
        way[a] -= g->periodic[a] ? period * round(way[a] / period) : 0.0;
        length += way[a] * way[a];
    }
    length = sqrt(length);
    for (int a = 0; a < 3; a++)
        to[a] = s->shift[a] + (length > leash ? (1.0 - leash / length) * way[a] : 0.0);
    follow(g, s, to);
}

/* All ranks have the same sets and call this with the same t. */
bool region_sets_move(struct regions *g, double t)
{
    bool moved = false;
    for (int n = 0; n < g->nsets; n++) {
        struct region_set *s = g->sets + n;
        double d[BODY_AXES], dd[BODY_AXES], ddd[BODY_AXES], before[3];
        memcpy(before, s->shift, sizeof before);
        if (s->peak) {
            follow_peak(g, s);
        } else if (s->box) {
            for (int a = 0; a < g->dim; a++)
                s->shift[a] = s->along[a] ? g->way[a] : 0.0;
        } else if (s->body >= 0) {
            follow_body(g, s);
        } else if (s->speed > 0.0) {
            body_drive_at(&s->drive, t, d, dd, ddd);
            memcpy(s->shift, d, sizeof s->shift);
        }
        moved = moved || memcmp(before, s->shift, sizeof before) != 0;
    }
    return moved;
}

void regions_set_body(struct regions *g, int body, const struct body_motion *now)
{
    g->bodies[body] = *now;
}

bool regions_want_peak(const struct regions *g)
{
    bool any = false;
    for (int n = 0; n < g->nsets; n++)
        any = any || g->sets[n].peak;
    return any;
}

void regions_set_peak(struct regions *g, const double *x, double p)
{
    memcpy(g->peak, x, (size_t)g->dim * sizeof *x);
    g->peak_pressure = p;
    g->peak_known = true;
}

/* A region moves by half a spacing of its finest level at most. */
double regions_dt(const struct regions *g)
{
    double dt = INFINITY;
    for (int n = 0; n < g->nsets; n++)
        if (g->sets[n].speed > 0.0)
            dt = fmin(dt, 0.5 * ldexp(g->dx, -g->sets[n].finest) / g->sets[n].speed);
    return dt;
}

/* The same of what moves around a level that steps on its own. */
double regions_dt_outside(const struct regions *g, int level)
{
    double dt = INFINITY;
    for (int n = 0; n < g->nsets; n++)
        if (g->sets[n].speed > 0.0 && g->sets[n].finest > level)
            dt = fmin(dt, 0.5 * ldexp(g->dx, -level - 1) / g->sets[n].speed);
    return dt;
}

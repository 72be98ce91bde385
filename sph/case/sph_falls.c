/* sph_falls.c - water that nothing catches: where parts of it at the start would fly by gravity and
 * their own velocity, until a wall, a body or a side of the domain stops them, or they are out; see
 * sph_sense.h. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/geometry/geometry.h"
#include "../../common/scene/scene.h"
#include "../particles/sph_particles.h"
#include "sph_sense.h"

enum { PLACES = 20000, FLIGHTS = 200, STRIDES = 4000 };

/* Less than this share falls out without a word: what a side takes of water beside it. */
static const double few = 0.05;

enum { NONE = -1 }; /* no side of the domain */

struct parcel {
    double x[3], u[3]; /* m, m/s */
};

/* The particles' region: the domain, or a box in it. Through open sides water goes into the flow
 * outside, which is known there, and is not lost. */
struct fall_region {
    double lo[3], hi[3]; /* m */
    bool periodic[3], open[6];
};

/* Whether the way d from x meets a line. */
static bool meets_line(const struct line *l, const double *x, const double *d)
{
    for (int k = 0; l->n > 1 && k < line_segments(l); k++) {
        const double *a = l->x[k], *b = l->x[(k + 1) % l->n];
        const double t[2] = {b[0] - a[0], b[1] - a[1]}, r[2] = {a[0] - x[0], a[1] - x[1]};
        const double across = d[0] * t[1] - d[1] * t[0];
        const double way = (r[0] * t[1] - r[1] * t[0]) / across;
        const double along = (r[0] * d[1] - r[1] * d[0]) / across;
        if (way >= 0.0 && way <= 1.0 && along >= 0.0 && along <= 1.0)
            return true;
    }
    return false;
}

bool sph_falls_stopped(const struct scene *c, const double *x, const double *d)
{
    const double to[3] = {x[0] + d[0], x[1] + d[1], x[2] + d[2]};
    bool met = false;
    for (int k = 0; k < c->nwalls && !met; k++) {
        const struct line l = line_of(&c->walls[k].points, c->walls[k].closed);
        met = meets_line(&l, x, d);
    }
    for (int k = 0; k < c->nbodies && !met; k++) {
        const struct line l = line_of(&c->bodies[k].points, true);
        met = meets_line(&l, x, d);
    }
    for (int k = 0; c->meshes && k < c->meshes->n && !met; k++) {
        const struct scene_mesh *m = c->meshes->of + k;
        met = m->owner != MESH_OF_SHAPE && tree_crosses(m->tree, x, to, NULL);
    }
    return met;
}

/* Whether the piece of lines nearest to x has its back to it: there is no water. At a corner it is
 * enough to be before one of its pieces. */
static bool is_behind(const struct scene *c, const double *x)
{
    double least = INFINITY, before = 0.0;
    for (int k = 0; k < c->nwalls; k++) {
        const struct line l = line_of(&c->walls[k].points, c->walls[k].closed);
        for (int i = 0; l.n > 1 && i < line_segments(&l); i++) {
            const double *a = l.x[i], *b = l.x[(i + 1) % l.n];
            const double ends[2][2] = {{a[0], a[1]}, {b[0], b[1]}};
            const struct line piece = {2, ends, false};
            const double away = line_distance(&piece, x);
            const double left = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
            if (away < least * (1.0 + 1e-9))
                before = away < least * (1.0 - 1e-9) ? left : fmax(before, left);
            least = fmin(least, away);
        }
    }
    return before < 0.0;
}

/* In 3D meshes say what is behind them, in 2D the lines. */
static bool is_water(const struct scene *c, const struct exact *e, const double *x)
{
    if (c->meshes && c->meshes->n > 0)
        return scene_matter(c, e, x) == MATTER_FLUID && scene_is_room(c, x);
    return scene_is_fluid(c, e, x, NULL) && scene_is_room(c, x) && !is_behind(c, x);
}

/* Side of the region that a parcel is lost by, with x where it is; NONE: it is stopped, or flies
 * when the run ends. Strides are as long as a spacing or so. */
static int leaves_by(const struct scene *c, const struct fall_region *in, struct parcel *p,
                     const double *g, double stride)
{
    const double size = vec3_length(g);
    double t = 0.0, d[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < STRIDES && t < c->time.end; k++) {
        const double speed = vec3_length(p->u);
        const double dt = fmin(sqrt(2.0 * stride / size), stride / speed);
        for (int a = 0; a < c->domain.dim; a++) {
            d[a] = dt * (p->u[a] + 0.5 * dt * g[a]);
            p->u[a] += dt * g[a];
        }
        if (sph_falls_stopped(c, p->x, d))
            return NONE;
        t += dt;
        for (int a = 0; a < c->domain.dim; a++) {
            const double lo = in->lo[a], hi = in->hi[a];
            p->x[a] += d[a];
            const int side = p->x[a] < lo ? 2 * a : p->x[a] > hi ? 2 * a + 1 : NONE;
            if (side != NONE && in->periodic[a])
                p->x[a] += side % 2 ? lo - hi : hi - lo;
            else if (side != NONE)
                return in->open[side] || scene_wall_of(c, SIDE_X_MIN + side) ? NONE : side;
        }
    }
    return NONE;
}

/* Places of a lattice of dx in the region, at most so many, evenly among all; whether there is
 * water at the k-th, and how it starts. */
struct fall_places {
    const struct fall_region *in;
    int64_t all[3], step, n;
};

/* Every step-th place of the lattice, so that PLACES are asked at most. */
static struct fall_places places_of(const struct scene *c, const struct fall_region *in, double dx)
{
    struct fall_places p = {.in = in, .all = {1, 1, 1}};
    for (int a = 0; a < c->domain.dim; a++)
        p.all[a] = (int64_t)fmax(1.0, ceil((in->hi[a] - in->lo[a]) / dx - 1e-6));
    const int64_t all = p.all[0] * p.all[1] * p.all[2];
    p.step = 1 + all / PLACES;
    p.n = (all + p.step - 1) / p.step;
    return p;
}

static bool start_at(const struct scene *c, const struct exact *e, const struct fall_places *of,
                     int64_t k, struct parcel *p)
{
    int64_t cell = k * of->step;
    double more[3] = {0.0, 0.0, 0.0}, pressure;
    *p = (struct parcel){{0.0}, {0.0}};
    for (int a = 0; a < c->domain.dim; a++) {
        const double h = (of->in->hi[a] - of->in->lo[a]) / (double)of->all[a];
        p->x[a] = of->in->lo[a] + ((double)(cell % of->all[a]) + 0.5) * h;
        cell /= of->all[a];
    }
    if (!is_water(c, e, p->x))
        return false;
    scene_is_fluid(c, e, p->x, more);
    exact_point(e, p->x, 0.0, p->u, &pressure, NULL);
    for (int a = 0; a < c->domain.dim; a++)
        p->u[a] += more[a];
    return true;
}

/* Upright sides that are open with water before them: it flows out there, unless the weight leans
 * away from them. */
static void warn_beside(const struct scene *c, const struct fall_region *in, const double *x,
                        const double *g, double dx, bool told[6])
{
    for (int side = 0; side < 2 * c->domain.dim; side++) {
        const int a = side / 2;
        const double sense = side % 2 ? 1.0 : -1.0, end = side % 2 ? in->hi[a] : in->lo[a];
        double d[3] = {0.0, 0.0, 0.0};
        d[a] = end + 1e-3 * sense * dx - x[a];
        const double lean = sense * g[a] / vec3_length(g);
        if (told[side] || fabs(d[a]) > dx || lean > 0.0 || lean < -0.1 || in->periodic[a] ||
            in->open[side] || scene_wall_of(c, SIDE_X_MIN + side) || sph_falls_stopped(c, x, d))
            continue;
        told[side] = true;
        log_warn("water stands against the side %s, which is open: it flows out there and is "
                 "lost. If that is not meant give this side a wall",
                 scene_side_names[side]);
    }
}

/* Two passes over the same places: how many hold water, then FLIGHTS of them, evenly. */
void sph_falls_warn(const struct run *r, const struct sph_params *used)
{
    const struct scene *c = &r->scene;
    const struct exact e = exact_create(c);
    struct fall_region in;
    sph_params_region(&c->domain, used, in.lo, in.hi, in.periodic);
    sph_params_open(r, used, in.open);
    const struct fall_places of = places_of(c, &in, used->dx);
    struct parcel p;
    double g[3];
    int64_t water = 0, flown = 0, out[6] = {0}, lost = 0;
    int most = 0;
    if (used->surface != SURFACE_YES || c->has_fv || scene_still_gravity(c, g) == 0.0)
        return;
    bool told[6] = {false};
    for (int64_t k = 0; k < of.n; k++)
        if (start_at(c, &e, &of, k, &p)) {
            water++;
            warn_beside(c, &in, p.x, g, used->dx, told);
        }
    const int64_t every = 1 + water / FLIGHTS;
    water = 0;
    for (int64_t k = 0; k < of.n; k++) {
        if (!start_at(c, &e, &of, k, &p) || water++ % every != 0)
            continue;
        const int side = leaves_by(c, &in, &p, g, used->dx);
        flown++;
        lost += side != NONE;
        if (side != NONE && ++out[side] >= out[most])
            most = side;
    }
    if ((double)lost > few * (double)flown)
        log_warn("nothing catches %.0f %% of the water: gravity (%g, %g, %g) m/s^2 and its own "
                 "velocity take it out of the domain, most by the side %s, which is open, and it "
                 "is lost. If that is not meant give this side a wall, or turn fluid.gravity%s",
                 100.0 * (double)lost / (double)flown, c->fluid.gravity[0], c->fluid.gravity[1],
                 c->fluid.gravity[2], scene_side_names[most],
                 c->nwalls == 0 && c->nbodies > 0
                     ? "; a body is a tank if all water of the shapes is inside it"
                     : "");
}

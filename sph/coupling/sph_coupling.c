/* sph_coupling.c - SPH's place in a coupled job: gives its particles, takes patches of the flow
 * outside. Order of a coupling step (Chiron 2017, 6.2): SPH runs first on the extrapolated patch,
 * hands its particles over, and takes the next patch when its partner has followed. Sets of sph in
 * the job: `particles' (velocity, pressure, and where a surface crosses `one', a field of ones
 * whose kernel sum tells fv how much of a cell is water); `budget' and `place', each a single point
 * that carries numbers. Called by run.c through struct program; everything is collective over the
 * program's ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_link.h"

#include "../../coupler/cpl_partner.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "body_water.h"
#include "overlap.h"
#include "windows.h"

/* Ids of the sets and fields, and scratch for what is sent. */
struct sph_link {
    struct cpl *c;
    int dim, particles, velocity, pressure, patch_velocity, patch_pressure;
    int budget, water;  /* one point, at the free zone's corner; wet_faces_water */
    int place, way;     /* of a box that moves: a point where it starts, how far it is from there */
    int one, patch_phi; /* where a surface crosses: how much of a kernel water fills; fv's */
    int filled; /* the set of `one': the particles, beside bodies these and points in them */
    struct body_water *in_bodies; /* owned by this; NULL: the case has none */
    double *x, *u, *p, *w, *ones;
    int64_t *id;
    int capacity;
    bool compared;                    /* the length of the coupling steps with what sph wished */
    struct scene_reference reference; /* what the particles' pressure leaves out */
};

/* "sph.velocity": of what this program gives. */
static const char *named(const struct run *r, const char *what)
{
    static char text[CPL_NAME];
    if (snprintf(text, sizeof text, "%s.%s", r->name, what) >= (int)sizeof text)
        fail_with(RUN_INPUT,
                  "%s: the name of this group is too long for a coupled job: take at "
                  "most 48 letters",
                  r->name);
    return text;
}

/* box, free, given and counted are boxes of the region; memory, moves, pace and speed are numbers
 * that travel as boxes, since zones are what can be asked for before the plan is made. */
void coupling_offer(struct run *r, const struct sph_params *prm)
{
    double lo[3], hi[3];
    zones_free_box(r, prm, lo, hi);
    cpl_zone(r->partner_ctx, named(r, "box"), prm->box[0], prm->box[1]);
    cpl_zone(r->partner_ctx, named(r, "free"), lo, hi);
    zones_given_box(r, prm, lo, hi);
    cpl_zone(r->partner_ctx, named(r, "given"), lo, hi);
    static const double start[3] = {0.0, 0.0, 0.0};
    zones_counted_box(r, prm, start, lo, hi);
    cpl_zone(r->partner_ctx, named(r, "counted"), lo, hi);
    /* a number that travels as a box: windows over which pressure is smoothed */
    const double memory[3] = {windows_choose(r, prm).memory, 0.0, 0.0};
    double moves[3];
    for (int a = 0; a < 3; a++)
        moves[a] = a < r->scene.domain.dim && box_motion_along(r, prm, a);
    cpl_zone(r->partner_ctx, named(r, "memory"), memory, memory);
    cpl_zone(r->partner_ctx, named(r, "moves"), moves, moves);
    const double pace[3] = {box_motion_speed(r, prm), 0.0, 0.0};
    cpl_zone(r->partner_ctx, named(r, "pace"), pace, pace);
    const double speed[3] = {prm->speed.speed, 0.0, 0.0};
    cpl_zone(r->partner_ctx, named(r, "speed"), speed, speed);
}

/* Values and gradients of the patch, one field after the other. gu[n dim 3], gp[n 3] or NULL; the
 * particles' pressure is what is beyond the linear reference, so that and its slope are taken off.
 */
static void eval_patch(void *ctx, double t, int n, const double *x, double *u, double *p,
                       double *gu, double *gp)
{
    const struct sph_link *k = ctx;
    cpl_patch_eval(k->c, k->patch_velocity, t, n, x, u, gu);
    cpl_patch_eval(k->c, k->patch_pressure, t, n, x, p, gp);
    for (int i = 0; i < n; i++)
        p[i] -= scene_reference_at(&k->reference, k->dim, x + 3 * i);
    for (int i = 0; i < (gp ? n : 0); i++)
        for (int a = 0; a < k->dim; a++)
            gp[3 * i + a] -= k->reference.slope[a];
}

/* fv's level set, m, negative in water. */
static void eval_surface(void *ctx, double t, int n, const double *x, double *phi, double *gphi)
{
    const struct sph_link *k = ctx;
    cpl_patch_eval(k->c, k->patch_phi, t, n, x, phi, gphi);
}

/* Beyond one end of a box from wall to wall fv knows what flows, and the pressure up to a level
 * that it takes from here; beyond the other, with an outlet, it knows the pressure. Each end takes
 * what is known there alone: rho c times the error of a mean velocity is more than the pressure
 * that drives a slow flow. */
static void choose_halves(struct sph *s)
{
    struct zones *z = s->zones;
    for (int a = 0; a < s->dim; a++) {
        const bool below = coupling_has_outlet(s->run, 2 * a),
                   above = coupling_has_outlet(s->run, 2 * a + 1);
        if (!coupling_cuts(s->run, &s->prm, a) || below == above)
            continue;
        z->own_p[2 * a] = z->own_u[2 * a + 1] = above;
        z->own_p[2 * a + 1] = z->own_u[2 * a] = below;
    }
}

/* Names of fields are those that fv gives and takes; CPL_OPTIONAL: nobody needs to take the
 * particles' pressure. */
void sph_coupling_create(struct sph *s)
{
    struct sph_link *k = NEW_IN(s->zones, struct sph_link, 1);
    k->reference = s->reference;
    const int how = s->run->scene.coupling.interpolation ? CPL_CUBIC : CPL_LINEAR;
    k->c = s->run->partner_ctx;
    k->dim = s->dim;
    partner_check(k->c, cpl_points(k->c, named(s->run, "particles"), s->dim, 0.0, &k->particles));
    partner_check(k->c, cpl_field(k->c, k->particles, named(s->run, "velocity"), "m/s", s->dim,
                                  CPL_PUT, 0, &k->velocity));
    partner_check(k->c, cpl_field(k->c, k->particles, named(s->run, "pressure"), "Pa", 1,
                                  CPL_PUT | CPL_OPTIONAL, 0, &k->pressure));
    partner_check(k->c, cpl_field(k->c, k->particles, "fv.velocity", "m/s", s->dim, CPL_GET, how,
                                  &k->patch_velocity));
    partner_check(k->c, cpl_field(k->c, k->particles, "fv.pressure", "Pa", 1, CPL_GET, how,
                                  &k->patch_pressure));
    if (s->run->crossed) {
        k->filled = k->particles;
        if (s->run->scene.nbodies > 0) {
            k->in_bodies = NEW_IN(k, struct body_water, 1);
            partner_check(k->c, cpl_points(k->c, named(s->run, "filled"), s->dim, 0.0, &k->filled));
        }
        partner_check(
            k->c, cpl_field(k->c, k->filled, named(s->run, "one"), "-", 1, CPL_PUT, 0, &k->one));
        partner_check(k->c, cpl_field(k->c, k->particles, "fv.phi", "m", 1, CPL_GET, CPL_LINEAR,
                                      &k->patch_phi));
        partner_check(k->c, cpl_points(k->c, named(s->run, "budget"), s->dim, 0.0, &k->budget));
        partner_check(k->c, cpl_field(k->c, k->budget, named(s->run, "water"), "m^dim", 2, CPL_PUT,
                                      0, &k->water));
        s->zones->surface = eval_surface;
    }
    if (box_motion_wanted(&s->prm)) {
        partner_check(k->c, cpl_points(k->c, named(s->run, "place"), s->dim, 0.0, &k->place));
        partner_check(k->c,
                      cpl_field(k->c, k->place, named(s->run, "way"), "m", 9, CPL_PUT, 0, &k->way));
    }
    choose_halves(s);
    s->zones->eval = eval_patch;
    s->zones->ctx = k;
    s->zones->watched = mem_own(s->zones, overlap_create(s));
}

/* m: how far around its part a rank may look in a window of T s: a support, and where the box goes.
 * 0 along axes that do not exist. fastest: the speed at which the box may follow something. */
static double looks_beyond(const struct sph *s, int a, double T)
{
    const struct zones *z = s->zones;
    const double most = fmax(z->fastest, 1.5 * fabs(z->speed[a]));
    const bool moves = z->fastest > 0.0 && box_motion_along(s->run, &s->prm, a);
    return a >= s->dim ? 0.0 : s->R + (moves ? most * T : 0.0);
}

/* All ranks know the surface around the whole region: faces and probes are everybody's. A second,
 * larger patch: faces are the same on all ranks, and so must be what they see. */
static void take_surface(struct sph *s, double T)
{
    const struct sph_link *k = s->zones->ctx;
    double lo[3], hi[3];
    for (int a = 0; a < 3; a++) {
        lo[a] = s->lo[a] - looks_beyond(s, a, T);
        hi[a] = s->hi[a] + looks_beyond(s, a, T);
    }
    partner_check(k->c, cpl_patch_get(k->c, k->patch_phi, lo, hi));
    s->lists.ready =
        false; /* the lattice behind the faces ends at the surface, which is another now */
    if (!s->zones->gap->started)
        level_gap_look(s, 0.0);
}

/* The patch that this rank's particles and faces may need until the end of the window. zones_gauge
 * then sets the level of pressure, and overlap_look compares, with the new patches. */
void sph_coupling_window_begin(void *state, double t0, double t1)
{
    struct sph *s = state;
    struct sph_link *k = s->zones->ctx;
    double lo[3], hi[3];
    if (!k->compared)
        windows_compare(s->run, &s->prm, t1 - t0);
    k->compared = true;
    zones_counted_box(s->run, &s->prm, s->zones->way, s->zones->counted[0], s->zones->counted[1]);
    domain_bounds(s->domain, lo, hi);
    for (int a = 0; a < 3; a++) {
        lo[a] -= looks_beyond(s, a, t1 - t0);
        hi[a] += looks_beyond(s, a, t1 - t0);
    }
    partner_check(k->c, cpl_patch_get(k->c, k->patch_velocity, lo, hi));
    partner_check(k->c, cpl_patch_get(k->c, k->patch_pressure, lo, hi));
    if (s->zones->surface)
        take_surface(s, t1 - t0);
    zones_gauge(s);
    overlap_look(s);
}

/* Room for n particles in the arrays that are sent; ones are filled once. */
static void room(struct sph_link *k, int n)
{
    if (n <= k->capacity)
        return;
    const int old = k->capacity;
    k->capacity = n + n / 4;
    GROW_IN(k, k->x, 3 * old, 3 * k->capacity);
    GROW_IN(k, k->u, k->dim * old, k->dim * k->capacity);
    GROW_IN(k, k->p, old, k->capacity);
    GROW_IN(k, k->w, old, k->capacity);
    GROW_IN(k, k->ones, old, k->capacity);
    for (int i = old; i < k->capacity; i++)
        k->ones[i] = 1.0;
    GROW_IN(k, k->id, old, k->capacity);
}

/* A point and a value that one rank has. Puts a value of rank 0 at time t on a set of one point at
 * the origin. */
static void give_one(struct sph *s, int set, int field, double t, const double *value)
{
    struct sph_link *k = s->zones->ctx;
    const double start[3] = {0.0, 0.0, 0.0};
    const int mine = s->run->rank == 0 ? 1 : 0;
    const int64_t id = 0;
    room(k, 1);
    partner_check(k->c, cpl_move(k->c, set, mine, start, &id, k->ones));
    partner_check(k->c, cpl_put(k->c, field, t, mine, value, NULL));
}

/* How far the box has moved, and what of it will be counted as SPH's water in the next window. */
static void give_way(struct sph *s, double t)
{
    const struct sph_link *k = s->zones->ctx;
    double v[9];
    memcpy(v, s->zones->way, 3 * sizeof *v);
    zones_counted_box(s->run, &s->prm, v, v + 3, v + 6);
    give_one(s, k->place, k->way, t, v);
}

/* Adds what of the bodies is below the level to the n particles that are given, in a set of its
 * own: bodies have no part in velocities and pressures. Returns the number of points. */
static int add_bodies(struct sph *s, int n)
{
    struct sph_link *k = s->zones->ctx;
    struct body_water *b = k->in_bodies;
    const struct scene_domain *d = &s->run->scene.domain;
    const double volume = pow(s->dx, s->dim);
    body_water_find(s, b);
    room(k, n + b->n);
    for (int i = 0; i < b->n; i++) {
        for (int a = 0; a < 3; a++)
            k->x[3 * (n + i) + a] =
                a < s->dim ? scene_image_from(d, a, d->min[a], b->x[3 * i + a]) : 0.0;
        k->w[n + i] = volume;
        k->id[n + i] = b->id[i];
    }
    partner_check(k->c, cpl_move(k->c, k->filled, n + b->n, k->x, k->id, k->w));
    return n + b->n;
}

/* Where the n particles are that are given: ones; and how much water the free zone holds. */
static void give_surface(struct sph *s, int n, double t)
{
    const struct sph_link *k = s->zones->ctx;
    const int filled = k->in_bodies ? add_bodies(s, n) : n;
    double water[2];
    wet_faces_water(s, water);
    partner_check(k->c, cpl_put(k->c, k->one, t, filled, k->ones, NULL));
    give_one(s, k->budget, k->water, t, water);
}

/* Particles of the free zone and the blended ones; never buffer particles, which would give the
 * partner its own values back. Positions are wrapped into the domain; ids make the partner's sums
 * independent of the partition. */
void sph_coupling_window_end(void *state, double t1)
{
    struct sph *s = state;
    struct sph_link *k = s->zones->ctx;
    const struct scene_domain *d =
        &s->run->scene.domain; /* whose periods the box may have passed */
    const int dim = s->dim;
    int n = 0;
    room(k, s->p.n);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        if (zones_depth(s, y) < s->zones->buffer)
            continue;
        for (int a = 0; a < 3; a++)
            k->x[3 * n + a] = a < dim ? scene_image_from(d, a, d->min[a], y[a]) : 0.0;
        for (int a = 0; a < dim; a++)
            k->u[dim * n + a] = y[dim + a] / y[at_mass(dim)];
        k->p[n] = scene_reference_at(&s->reference, dim, y) +
                  eos_p(y[at_mass(dim)] / y[at_volume(dim)], s->rho0, s->c0, s->gamma);
        k->w[n] = y[at_volume(dim)];
        k->id[n++] = s->p.id[i];
    }
    partner_check(k->c, cpl_move(k->c, k->particles, n, k->x, k->id, k->w));
    partner_check(k->c, cpl_put(k->c, k->velocity, t1, n, k->u, NULL));
    partner_check(k->c, cpl_put(k->c, k->pressure, t1, n, k->p, NULL));
    if (s->zones->surface)
        give_surface(s, n, t1);
    if (box_motion_wanted(&s->prm))
        give_way(s, t1);
}

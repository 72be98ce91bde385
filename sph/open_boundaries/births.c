/* births.c - see births.h. The accumulated mass M_f of a face, of area dx^(D-1), follows
 *   dM_f/dt = rho (u - u_box).n dx^(D-1),   n inwards   [6.13]
 * (Chiron 2017) with the outer solution at the middle of the step, times the wet share of the face.
 * A face with M_f >= rho dx^D that lets fluid in creates a particle dx/2 inside [6.14]; a particle
 * that leaves adds its mass to its face.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "births.h"

#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "openings.h"
#include "wet_faces.h"
#include "zones.h"

/* Particles beyond an open side give their mass to the nearest face. A particle out of two sides at
 * once belongs to that which it is farther out of. Places in the list are filled from its end, so i
 * stays where a row has gone. */
static void remove_leavers(struct sph *s)
{
    struct openings *o = s->zones->openings;
    struct particles *p = &s->p;
    for (int i = 0; i < p->n;) {
        const double *y = state_row(p, p->y, i);
        if (zones_depth(s, y) >= 0.0) {
            i++;
            continue;
        }
        int side = 0;
        double most = 0.0;
        for (int k = 0; k < 2 * o->dim; k++) {
            const double out = -zones_inside(o->lo, o->hi, k, y);
            if (o->open[k] && out > most) {
                most = out;
                side = k;
            }
        }
        const double m = y[at_mass(o->dim)];
        const int to = wet_faces_for(s, side, y);
        if (o->law->shares)
            openings_share(o, side, y, m);
        else if (to >= 0)
            o->change[to] += m;
        else {
            wet_faces_rain(s, y);
            o->through[side] -= m;
        }
        o->gone++;
        particles_copy(p, i, --p->n);
    }
}

/* rho u.n dx^(D-1) of the faces this rank owns [6.13], from the flow outside at the middle of the
 * step. drain is what leaves through every face for the voids' sake (openings.c): it is no inflow,
 * and the deficit falls by it. */
static void add_fluxes(struct sph *s, double dt)
{
    struct openings *o = s->zones->openings;
    struct zones *z = s->zones;
    const int n = openings_faces(o), dim = o->dim;
    const double area = s->dxD / s->dx;
    z->n = 0;
    zones_room(z, n);
    for (int f = 0; f < n; f++) {
        double x[3], in[3];
        const int side = openings_place(o, f, x);
        memcpy(in, x, sizeof x);
        in[side / 2] += 0.5 * o->dx * openings_inward(side);
        for (int a = 0; a < dim; a++) /* where the face was at that time */
            x[a] -= 0.5 * dt * z->speed[a];
        o->flux[f] = 0.0;
        if (domain_owner(s->domain, in) != s->run->rank)
            continue;
        memcpy(z->x + 3 * z->n, x, sizeof x);
        z->who[z->n++] = f;
    }
    zones_look(z, s->t - 0.5 * dt, false);
    for (int k = 0; k < z->n; k++) {
        const int f = z->who[k];
        int side = 0;
        while (f >= o->first[side + 1])
            side++;
        const double rho = eos_rho(z->p[k], s->rho0, s->c0, s->gamma);
        const double u = z->u[dim * k + side / 2] - z->speed[side / 2];
        o->flux[f] = rho * area * o->share[f] * openings_inward(side) * u;
        o->change[f] += dt * o->flux[f];
        o->through[side] += dt * (o->flux[f] + s->rho0 * area * z->drain);
    }
    o->deficit -= dt * openings_faces(o) * s->rho0 * area * s->zones->drain;
}

/* Particles near the open sides in a hash of cells of side dx, to keep births apart: chains by
 * head[] and next[]. */
struct birth_strip {
    int n, heads;
    double (*x)[3];
    int *next, *head;
};

/* The chain of the cell of side dx that x lies in, off by off[] cells. Different cells may share a
 * chain, so distances are compared in any case. */
static int strip_cell(const struct birth_strip *t, const struct openings *o, const double *x,
                      const int *off)
{
    uint32_t key = 0;
    for (int a = 0; a < o->dim; a++)
        key = key * 73856093u + (uint32_t)((int)floor((x[a] - o->lo[a]) / o->dx) + off[a]);
    return (int)(key % (uint32_t)t->heads);
}

static void strip_add(struct birth_strip *t, const struct openings *o, const double *y)
{
    static const int here[3] = {0, 0, 0};
    ROOM_IN(NULL, t->x, t->n + 1);
    ROOM_IN(NULL, t->next, t->n + 1);
    for (int a = 0; a < o->dim; a++)
        t->x[t->n][a] = y[a];
    const int c = strip_cell(t, o, y, here);
    t->next[t->n] = t->head[c];
    t->head[c] = t->n++;
}

/* Locals where they are now, ghosts where the last stage saw them. */
static struct birth_strip strip_create(const struct sph *s)
{
    const struct openings *o = s->zones->openings;
    const int room = 4 * openings_faces(o) + 64;
    struct birth_strip t = {.heads = room, .head = NEW(int, room)};
    for (int c = 0; c < t.heads; c++)
        t.head[c] = -1;
    for (int i = 0; i < s->p.n + o->first_ghost; i++) {
        const double *y =
            i < s->p.n ? state_row(&s->p, s->p.y, i) : prim_line(&s->p, s->list->n + i - s->p.n);
        if (zones_depth(s, y) < 2.0 * s->dx)
            strip_add(&t, o, y);
    }
    return t;
}

static void strip_free(struct birth_strip *t) { FREE(t->x, t->next, t->head); }

/* Whether anything stands within dx/2 of x; all within that distance are in the 3^dim cells around
 * it. */
static bool crowded(const struct birth_strip *t, const struct openings *o, const double *x)
{
    const double least2 = 0.25 * o->dx * o->dx;
    int off[3] = {0, 0, 0};
    for (off[2] = o->dim > 2 ? -1 : 0; off[2] <= (o->dim > 2 ? 1 : 0); off[2]++)
        for (off[1] = -1; off[1] <= 1; off[1]++)
            for (off[0] = -1; off[0] <= 1; off[0]++)
                for (int k = t->head[strip_cell(t, o, x, off)]; k >= 0; k = t->next[k]) {
                    const double r2 = vec_distance2(o->dim, x, t->x[k]);
                    if (r2 < least2)
                        return true;
                }
    return false;
}

/* The id follows from the face and the time in ticks alone, so that it is the same on any number of
 * ranks and no two are equal. */
static void born(struct sph *s, int f, const double *x, const double *u, double rho)
{
    struct openings *o = s->zones->openings;
    const int64_t id = o->first_id + f + llround(s->t / o->tick) * openings_faces(o);
    const int i = particles_add(&s->p, id, ZONE_BUFFER);
    particles_set(s, i, x, u, s->dxD, rho);
    o->change[f] -= rho * s->dxD;
    o->born++;
}

/* Mass goes to the face beside f that holds least. f itself where no face beside it is wet: then
 * nothing changes. */
static void pass_on(struct openings *o, int f, double mass)
{
    const int to = openings_beside(o, f, -1.0);
    o->change[f] -= mass;
    o->change[to] += mass;
}

/* What a new particle may be moved on, in dx: with a half, faces at an edge gave birth on it, and
 * rounding lost the particle. */
static const double most_over = 0.49;

/* Way along a side per way through it. Streamlines that are steeper still bring hardly any fluid.
 */
static double along(double u, double un)
{
    static const double steepest = 3.0;
    return un > 0.0 ? fmax(-steepest, fmin(u / un, steepest)) : 0.0;
}

/* No nearer to the ends of open sides than rounding sees: beyond them it would be lost. */
static void keep_within(const struct openings *o, double *x)
{
    const double off = 0.01 * o->dx;
    for (int a = 0; a < o->dim; a++)
        if (o->bounded[a])
            x[a] = fmax(o->lo[a] + off, fmin(x[a], o->hi[a] - off));
}

/* A face that holds a particle's mass and lets fluid in gives birth where the middle of that fluid
 * is: dx/2 and what the step overshot along the flow inside. Born straight before their faces those
 * of two sides met at the corner between them, and a streak of 1.2 times the density followed. */
static void give_birth(struct sph *s)
{
    struct openings *o = s->zones->openings;
    struct zones *z = s->zones;
    const int looked = z->n, dim = o->dim;
    struct birth_strip near = strip_create(s);
    s->p.nghost = 0; /* new particles take their place */
    for (int k = 0; k < looked; k++) {
        const int f = z->who[k];
        const double rho = eos_rho(z->p[k], s->rho0, s->c0, s->gamma), whole = rho * s->dxD;
        double held = o->mass[f] + o->change[f], *u = z->u + dim * k;
        if (held < o->law->threshold * whole || o->share[f] == 0.0 ||
            (o->flux[f] <= 0.0 && held < openings_max_deficit * whole))
            continue;
        if (o->room[f] < 0.5) { /* its middle lies behind a wall */
            pass_on(o, f, held);
            continue;
        }
        double x[3];
        const double *const of_box = z->speed;
        const int side = openings_place(o, f, x), a = side / 2;
        const double over = fmin(held / whole - o->law->threshold, most_over) * s->dx;
        const double un = fabs(u[a] - of_box[a]), deep = o->law->depth * s->dx + over;
        for (int b = 0; b < dim; b++)
            x[b] += b == a ? openings_inward(side) * deep : along(u[b] - of_box[b], un) * deep;
        if (s->zones->surface) /* beside a steep surface down is sideways, too */
            wet_faces_lower(s, 0.25 * s->dx, 1, x);
        keep_within(o, x);
        if (crowded(&near, o, x)) {
            o->refused++;
            if (held > openings_max_deficit * whole)
                pass_on(o, f, held - openings_max_deficit * whole);
            continue;
        }
        born(s, f, x, u, rho);
        strip_add(&near, o, x);
    }
    strip_free(&near);
}

/* Every rank holds the mass of all faces, and each changes those that its own particles and faces
 * touch. */
static void sum_changes(struct sph *s)
{
    struct openings *o = s->zones->openings;
    const int n = openings_faces(o);
    if (s->run->size > 1)
        MPI_Allreduce(MPI_IN_PLACE, o->change, n, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int f = 0; f < n; f++)
        o->mass[f] += o->change[f];
    memset(o->change, 0, (size_t)n * sizeof(double));
}

/* What faces of a full box owe beyond that is booked at the wrong ones: beside the corner of two
 * sides particles leave by the one and are awaited at the other, and all that are awaited are too
 * many inside (92 of 2700 within a time unit, vortices carried by (0.6, 0.25) U). */
static void pass_deficits(struct sph *s)
{
    struct openings *o = s->zones->openings;
    const double least = -openings_max_deficit * s->rho0 * s->dxD;
    for (int f = 0; f < openings_faces(o); f++) {
        const double deficit = least - o->mass[f];
        if (deficit <= 0.0)
            continue;
        const int to = openings_beside(o, f, 1.0);
        o->mass[f] += deficit;
        o->mass[to] -= deficit;
    }
}

/* At an outlet under a surface particles that leave bring less than flows out: they shift against
 * the flow, and pairs with the lattice behind the faces take the rest (at Froude number 0.8 1.6 %).
 * So what faces lack beyond that is none to wait for when the flow turns. */
static void drop_deficits(struct sph *s)
{
    struct openings *o = s->zones->openings;
    for (int f = 0; f < openings_faces(o); f++)
        o->mass[f] = fmax(o->mass[f], -openings_max_deficit * s->rho0 * s->dxD);
}

/* Twice summed: births must see what all ranks have booked, and what they take must be known to all
 * before the next step. Leavers first, so that the faces they pay into can give birth in the same
 * step; wet shares before both, for they say which face a particle belongs to. */
void births_step(struct sph *s, double dt)
{
    if (s->zones->surface)
        wet_faces_find(s, s->t - 0.5 * dt);
    remove_leavers(s);
    add_fluxes(s, dt);
    sum_changes(s);
    give_birth(s);
    sum_changes(s);
    if (!s->surface)
        pass_deficits(s);
    else if (s->zones->update)
        drop_deficits(s);
    openings_settle(s);
}

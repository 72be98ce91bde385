/* life.c - creation, removal and roles of the particles of all levels (Chiron 2017, 5.3). A
 * particle that enters the region of the next level gets 2^D children of half its spacing, of equal
 * mass, at +-1/4 of it, with its fields and their slopes [5.20-5.22]; it stays as a guard, and no
 * link is kept but that a child knows its corner. What leaves its region is removed, children where
 * their parent leaves. Roles follow from positions alone; creation and removal have a hysteresis of
 * half the coarser spacing, so that none is created to be removed.
 *
 * refinement_adapt runs at the end of a step, level by level from the coarsest: children of one
 * level are there when the next is looked at. Then refinement_restore_mass restores the mass of the
 * fluid, slowly, where levels take over from each other with unequal numbers.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "guards.h"
#include "refinement.h"

#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"

static const double hysteresis = 0.5;                      /* coarser dx */
static const double restored = 0.03, most_restored = 2e-4; /* a step: of the surplus; of the mass */
static const double returned = 0.01; /* a step: of the velocity that guards have given */
static const double steepest = 0.05; /* change of rho from parent to child, its share */

/* Distances of the particles of a level to the edges of its own region and of the next finer one;
 * NULL: there is none. Each is asked for once a step. */
struct depths {
    double *own, *next;
};

/* Distance of every particle from the edge of a level's region, m; both to be freed. */
static double *measure(const struct regions *g, const struct sph *s, int level)
{
    double *d = NEW(double, s->p.n);
    for (int i = 0; i < s->p.n; i++)
        d[i] = regions_distance(g, level, state_row(&s->p, s->p.y, i));
    return d;
}

/* held: what particles are with respect to the region of their own level stays. With held, own is
 * NULL. */
static struct depths depths_of(const struct regions *g, const struct sph *s, bool held)
{
    return (struct depths){s->coarser && !held ? measure(g, s, s->level) : NULL,
                           s->finer ? measure(g, s, s->level + 1) : NULL};
}

/* Bits of enum sph_role of particle i but ROLE_PARENT, with the source. Runs through the finer
 * levels until one does not flow at the particle; the last that does is the source. */
static int role_of(const struct regions *g, const struct sph *s, const struct depths *is, int i)
{
    int role = 0, source = s->level;
    /* With local steps births come up to a coarser step late. */
    const double edge = (s->guards->own_rates ? 1.25 : 1.0) * s->R;
    if (is->own && is->own[i] < 2.0 * s->R) /* guards of the finer level */
        return ROLE_GUARD | (is->own[i] < edge ? ROLE_EDGE : 0) | source << ROLE_SOURCE;
    for (int n = s->level + 1; n <= regions_levels(g); n++) {
        const double R = ldexp(s->R, s->level + 1 - n);
        const double d =
            n == s->level + 1 ? is->next[i] : regions_distance(g, n, state_row(&s->p, s->p.y, i));
        if (d < R)
            break;
        source = n;
        role |= ROLE_GUARD;
        /* Slopes of guards reach 2 R deep, with what moves; where guards go on by their own rates,
         * these must be whole for another R. */
        const double deep = s->guards->own_rates ? 4.25 : 3.25;
        if (n == s->level + 1 && d > deep * R)
            role |= ROLE_DEEP;
        else if (n == s->level + 1 && d > (deep - 1.0) * R && s->guards->own_rates)
            role |= ROLE_EDGE;
    }
    if (!role && ((is->own && is->own[i] < 3.0 * s->R) || (is->next && is->next[i] > 0.0)))
        role = ROLE_EDGE;
    return role | source << ROLE_SOURCE;
}

/* The regions of a scene, from any of its levels. */
static const struct regions *regions_of(const struct sph *s)
{
    while (s->coarser)
        s = s->coarser;
    return s->refinement->regions;
}

static bool flows_at(const struct sph *s, const double *x)
{
    const struct regions *g = regions_of(s);
    return !(s->coarser && regions_distance(g, s->level, x) < 2.0 * s->R) &&
           !(s->finer && regions_distance(g, s->level + 1, x) >= s->R);
}

/* Sum over particles that flow, s and finer levels, of member `at' of the state, or of its rate;
 * this rank. */
static double sum_of(const struct sph *s, int at, bool of_rates)
{
    double sum = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i))
                sum += state_row(&q->p, of_rates ? q->p.rate : q->p.y, i)[at];
    return sum;
}

/* Mass of what flows, kg; this rank. */
static double flowing(const struct sph *s) { return sum_of(s, at_mass(s->dim), false); }

/* Share of a particle's mass that counts: 1 where its level flows, 0 where another does. Ramps one
 * spacing of the coarser level wide make the sum continuous as a layer of particles crosses the
 * switch. own, next: distances to the edges of its own region and of the next finer one, m. */
static double share_of(const struct sph *s, double own, double next)
{
    return fmax(0.0, fmin(0.5 + (own - 2.0 * s->R) / (2.0 * s->dx), 1.0)) *
           fmax(0.0, fmin(0.5 - (next - s->R) / s->dx, 1.0));
}

static double share_at(const struct sph *s, const double *x)
{
    const struct regions *g = regions_of(s);
    return share_of(s, s->coarser ? regions_distance(g, s->level, x) : INFINITY,
                    s->finer ? regions_distance(g, s->level + 1, x) : -INFINITY);
}

const struct level_places refinement_places = {.flows = flows_at, .share = share_at};

/* Mass of a level's particles by these shares, kg; this rank. Adds their momentum to that of all
 * levels. */
static double mass_of_level(const struct sph *s, const struct depths *is, double momentum[3])
{
    double sum = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        const double share =
            share_of(s, is->own ? is->own[i] : INFINITY, is->next ? is->next[i] : -INFINITY);
        sum += share * y[at_mass(s->dim)];
        for (int a = 0; a < s->dim; a++)
            momentum[a] += share * y[s->dim + a];
    }
    return sum;
}

/* Called at the start and where something else has changed the mass on purpose. */
void refinement_remember(struct sph *s)
{
    struct refinement *r = s->refinement;
    s->step.mass = 0.0;
    for (struct sph *q = s; q; q = q->finer) {
        struct depths is = depths_of(r->regions, q, false);
        s->step.mass += mass_of_level(q, &is, r->momentum);
        FREE(is.own, is.next);
    }
    r->added = r->gone = s->watch.removed = 0.0;
    MPI_Allreduce(&s->step.mass, &r->mass0, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

/* kg, counted at the coarsest level for all; guards have no mass of their own. */
void refinement_removed(struct sph *s, int i)
{
    const double m = state_row(&s->p, s->p.y, i)[at_mass(s->dim)];
    const bool counts = !particles_is_guard(&s->p, i);
    while (s->coarser)
        s = s->coarser;
    if (counts && s->refinement)
        s->refinement->gone += isfinite(m) ? m : 0.0;
}

/* next_id goes up by the number of ranks, so that ids stay unique without communication. */
int refinement_child(const struct sph *s, struct sph *to, int i, const double *d)
{
    const int dim = s->dim;
    particles_reserve(&to->p, to->p.n + 1); /* which may be those of i */
    const int k = particles_add(&to->p, to->p.next_id, ZONE_FREE);
    const double *y = state_row(&s->p, s->p.y, i), *grad = slope_line(&s->p, i);
    const double m = y[at_mass(dim)], rho = m / y[at_volume(dim)];
    double more = 0.0, x[3] = {0.0}, u[3] = {0.0};
    for (int a = 0; a < dim; a++) {
        more += grad[a] * d[a];
        x[a] = y[a] + d[a];
        u[a] = y[dim + a] / m;
        for (int b = 0; b < dim; b++)
            u[a] += grad[dim + dim * a + b] * d[b];
    }
    const double rho_f = rho + fmax(-steepest * rho, fmin(more, steepest * rho));
    to->p.next_id += s->run->size;
    particles_set(to, k, x, u, ldexp(m, -dim) / rho_f, rho_f);
    memcpy(slope_line(&to->p, k), grad, (size_t)s->p.nslope * sizeof *grad);
    return k;
}

/* Changes the displacement d of a child, from a parent at x that has a wall at the distance h <
 * dx/2 along `way', such that parent and child are as far from that wall, each in its own spacings,
 * and so from the next wall in a corner: a layer that packing or the flow has put there becomes
 * two, with nobody behind walls, at any number of levels. A displacement that meets a wall yet ends
 * halfway before it. */
static void heed_walls(const struct sph *s, const double *x, double h, const double *way, double *d)
{
    const int dim = s->dim;
    double along = 0.0, aside[3];
    for (int a = 0; a < dim; a++)
        along += d[a] * way[a] / h;
    for (int a = 0; a < dim; a++)
        aside[a] = 2.0 * (d[a] - along * way[a] / h);
    const double free = 0.5 * walls_meet(s, x, aside), ahead = along > 0.0 ? 2.0 * h / s->dx : 1.0;
    for (int a = 0; a < dim; a++)
        d[a] = free * aside[a] + ahead * along * way[a] / h;
    const double share = walls_meet(s, x, d);
    for (int a = 0; a < dim && share < 1.0; a++)
        d[a] *= 0.5 * share;
}

/* Creates the 2^D children of particle i in the next level. */
static void give_birth(struct sph *s, int i)
{
    const double *x = state_row(&s->p, s->p.y, i);
    double way[3];
    const double reach = 0.5 * s->dx, h = s->walls ? walls_way(s, x, reach, way) : reach;
    for (int k = 0; k < 1 << s->dim; k++) {
        double d[3];
        for (int a = 0; a < 3; a++)
            d[a] = (k >> a & 1 ? 0.25 : -0.25) * s->dx;
        if (h > 0.0 && h < reach)
            heed_walls(s, x, h, way, d);
        const int child = refinement_child(s, s->finer, i, d);
        s->finer->p.role[child] = /* until it gets its role */
            (unsigned short)(ROLE_GUARD | (8 | k) << ROLE_CORNER);
    }
    s->p.role[i] |= ROLE_PARENT;
}

/* Particles of a level that have entered the region of the next one (next: their distances) get
 * children; those that have left it may get new ones later. */
static void enter(struct sph *s, const double *next)
{
    s->finer->p.nghost = 0;
    for (int i = 0; i < s->p.n; i++)
        if (!(s->p.role[i] & ROLE_PARENT) && next[i] >= 0.0)
            give_birth(s, i);
        else if (next[i] < -hysteresis * s->dx)
            s->p.role[i] &= (unsigned short)~ROLE_PARENT;
}

/* The depth, m, at which the parent of particle i stands if they have not parted since: children
 * leave together, and when their parent may get new ones. Each by its own depth, one that turns
 * back at an edge would lack some and have others twice. */
static double depth_of_parent(const struct regions *g, const struct sph *s, double depth, int i)
{
    const int corner = s->p.role[i] >> ROLE_CORNER;
    double x[3] = {0.0};
    if (!corner || depth > s->dx)
        return depth;
    for (int a = 0; a < s->dim; a++)
        x[a] = state_row(&s->p, s->p.y, i)[a] - (corner >> a & 1 ? 0.5 : -0.5) * s->dx;
    return regions_distance(g, s->level, x);
}

/* Whether it leaves its region, or is one guard too many, which does not come to flow now. */
static bool is_removed(const struct regions *g, const struct sph *s, double depth, int i)
{
    return depth_of_parent(g, s, depth, i) < -2.0 * hysteresis * s->dx ||
           ((s->p.role[i] & ROLE_SURPLUS) != 0 && depth < 2.0 * s->R);
}

/* Removes particles that have left their region and surplus guards; the last one fills the place,
 * distances with it. */
static void leave(const struct regions *g, struct sph *s, struct depths *is)
{
    for (int i = 0; i < s->p.n;)
        if (is_removed(g, s, is->own[i], i)) {
            particles_copy(&s->p, i, --s->p.n);
            is->own[i] = is->own[s->p.n];
            if (is->next)
                is->next[i] = is->next[s->p.n];
        } else {
            i++;
        }
}

/* Adds energy to the watch's account that the flow has gained without work, J: guards that begin to
 * flow bring theirs along. */
static void book_energy(struct sph *s, double gained)
{
    while (s->coarser)
        s = s->coarser;
    s->watch.removed -= isfinite(gained) ? gained : 0.0;
}

/* held: the guards of the level outside stay as they are, since its fields are those of the end of
 * its step. */
static void give_roles(const struct regions *g, struct sph *s, const struct depths *is, bool held)
{
    const int kept = ROLE_PARENT | ROLE_SURFACE | (held ? ROLE_SURPLUS : 0) | 15 << ROLE_CORNER;
    double woken = 0.0, kinetic;
    for (int i = 0; i < s->p.n; i++) {
        const int before = s->p.role[i];
        if (held && guards_is_outside(s, i))
            continue;
        s->p.role[i] = (unsigned short)((before & kept) | role_of(g, s, is, i));
        if ((before ^ s->p.role[i]) & ROLE_GUARD)
            woken += (before & ROLE_GUARD ? 1.0 : -1.0) *
                     sph_energy(s, state_row(&s->p, s->p.y, i), &kinetic);
    }
    book_energy(s, woken);
}

/* Creates the guards that counts.c has listed, moved on from the time when they were. */
static void add_created(struct sph *s)
{
    struct guards *g = s->guards;
    for (int k = 0; k < g->ncreated; k++) {
        const struct created *is = g->created + k;
        s->p.nghost = 0;
        particles_reserve(&s->p, s->p.n + 1);
        const int i = particles_add(&s->p, s->p.next_id, ZONE_FREE);
        s->p.next_id += s->run->size;
        double x[3];
        for (int a = 0; a < s->dim; a++)
            x[a] = is->x[a] + (s->t - is->t) * is->u[a];
        particles_set(s, i, x, is->u, is->volume, is->rho);
        memcpy(slope_line(&s->p, i), is->slope, (size_t)s->p.nslope * sizeof(double));
        s->p.role[i] = ROLE_GUARD;
    }
    g->ncreated = 0;
}

/* All changes of one level at the end of its step. Returns its share of the mass of the fluid, kg,
 * this rank. */
static double adapt_level(struct refinement *r, struct sph *s, bool held)
{
    const struct regions *g = r->regions;
    if (!held)
        add_created(s);
    struct depths is = depths_of(g, s, held);
    if (s->finer)
        enter(s, is.next);
    if (is.own)
        leave(g, s, &is);
    give_roles(g, s, &is, held);
    const double mass = mass_of_level(s, &is, r->momentum);
    s->lists.ready = false;
    FREE(is.own, is.next);
    return mass;
}

/* Warns once when a region that does not move with the box has come to the zones at an open
 * side. */
static void watch_zones(struct sph *s)
{
    enum { EVERY = 50 };
    struct refinement *r = s->refinement;
    double x[3];
    for (int side = 0; s->zones && s->run->step % EVERY == 0 && side < 2 * s->dim; side++) {
        if (r->met || !regions_meet_zones(r->regions, side, x))
            continue;
        r->met = true;
        log_warn("t = %.4g s: a region of refinement has come to the zones at an open side, at "
                 "(%g, %g, %g) m: the flow there is wrong; let it move with the box (follow = "
                 "\"sph.box\"), or make it smaller",
                 s->t, x[0], x[1], x[2]);
    }
}

/* added collects the mass by which changes of level alone change what flows. */
void refinement_adapt(struct sph *s)
{
    struct refinement *r = s->refinement;
    timer_start(&s->run->timers, "levels");
    const double before = flowing(s);
    regions_move(r->regions, s->t);
    s->step.mass = 0.0;
    memset(r->momentum, 0, sizeof r->momentum);
    for (struct sph *q = s; q; q = q->finer)
        s->step.mass += adapt_level(r, q, false);
    r->added += flowing(s) - before;
    refinement_watch_bodies(s);
    watch_zones(s);
    timer_stop(&s->run->timers, "levels");
}

/* A level whose regions hold water within R of their edges alone, round a body say, has guards and
 * nothing that flows: it refines nothing. */
static void warn_of_idle(const struct sph *q)
{
    int64_t count[2] = {0, 0};
    for (int i = 0; i < q->p.n; i++)
        count[particles_is_guard(&q->p, i)]++;
    MPI_Allreduce(MPI_IN_PLACE, count, 2, MPI_INT64_T, MPI_SUM, q->run->comm);
    if (count[0] == 0 && count[1] > 0)
        log_warn("level %d refines nothing at the start: all its %lld particles are guards, which "
                 "fill R = %.3g m from the edges of its regions; make them larger",
                 q->level, (long long)count[1], q->R);
}

/* Levels are made from the coarsest on; settle needs roles, hence give_roles before it. */
void refinement_begin(struct sph *s, void (*settle)(struct sph *level))
{
    const struct regions *g = s->refinement->regions;
    regions_move(s->refinement->regions, s->t);
    for (struct sph *q = s; q; q = q->finer) {
        if (q->coarser && settle) {
            struct depths is = depths_of(g, q, false);
            give_roles(g, q, &is, false);
            FREE(is.own, is.next);
            settle(q);
        }
        adapt_level(s->refinement, q, false);
        if (q->coarser)
            warn_of_idle(q);
    }
}

/* `outside' has just ended its step. Volumes count as well, for the closed room's account. */
void refinement_adapt_finer(struct sph *s, struct sph *outside)
{
    struct refinement *r = s->refinement;
    timer_start(&s->run->timers, "levels");
    const double before = flowing(outside), room = sum_of(outside, at_volume(s->dim), false);
    refinement_follow(s, outside);
    regions_move(r->regions, outside->t);
    for (struct sph *q = outside; q; q = q->finer)
        adapt_level(r, q, q == outside);
    r->added += flowing(outside) - before;
    r->grown += sum_of(outside, at_volume(s->dim), false) - room;
    timer_stop(&s->run->timers, "levels");
}

/* Only ALE has mass fluxes; with zones the room is open and its mass not conserved anyway. */
static bool keeps_mass(const struct sph *s)
{
    return s->prm.scheme == SCHEME_RIEMANN_ALE && !s->zones;
}

/* Takes `gained', kg on this rank, out of all that flows, or kg/s out of its rates. */
static void take_back(struct sph *s, double gained, bool of_rates)
{
    double sums[2] = {gained, flowing(s)};
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double share = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    for (struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i))
                particles_give_back(&q->p, of_rates ? q->p.rate : q->p.y, i, share);
}

void refinement_spread_mass(struct sph *s, double gained)
{
    if (keeps_mass(s))
        take_back(s, gained, false);
}

/* Each stage; one reduction. */
void refinement_keep_mass(struct sph *s)
{
    if (keeps_mass(s))
        take_back(s, sum_of(s, at_mass(s->dim), true), true);
}

/* A closed room restores 3 % of its surplus of mass in each step, at most 2e-4 of the mass, by one
 * factor on momentum, volume and mass of all that flows. Energy goes along and is entered in the
 * watch's account. */
void refinement_restore_mass(struct sph *s)
{
    struct refinement *r = s->refinement;
    double sums[2] = {s->step.mass, r->gone};
    if (s->zones)
        return;
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double mass_surplus = r->mass_surplus =
        sums[0] > 0.0 ? (sums[0] + sums[1] - r->mass0) / sums[0] : 0.0;
    const double steps = r->local_steps ? fmin(ldexp(1.0, regions_levels(r->regions)), 4.0) : 1.0;
    const double most = steps * most_restored,
                 part = fmax(-most, fmin(steps * restored * mass_surplus, most));
    if (fabs(mass_surplus) < 1e-12)
        return;
    double energy = 0.0, kinetic;
    s->step.mass *= 1.0 - part;
    for (struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            double *y = state_row(&q->p, q->p.y, i);
            if (particles_is_guard(&q->p, i))
                continue;
            energy += s->watch.budget_closed ? sph_energy(q, y, &kinetic) : 0.0;
            for (int k = q->dim; k < q->p.nstate; k++)
                y[k] *= 1.0 - part;
        }
    book_energy(s, -part * energy);
}

/* Whether walls may take up or give momentum along the periodic axis a: all but flat slip sides. */
static bool walls_push(const struct walls *w, int a)
{
    bool push = false;
    for (int k = 0; w && k < w->nsegments; k++) {
        const struct segment *is = w->segments + k;
        push = push || is->body >= 0 || is->no_slip || is->friction > 0.0 || fabs(is->n[a]) > 1e-9;
    }
    for (int k = 0; w && k < w->nplanes; k++)
        push = push || w->planes[k].no_slip;
    for (int k = 0; w && k < w->nmeshes; k++)
        push = push || w->meshes[k].of || w->meshes[k].body >= 0 || w->meshes[k].no_slip ||
               w->meshes[k].friction > 0.0;
    return push;
}

/* Guards take momentum and give none back. Where walls have no part in it, along periods, nothing
 * opposes that: a level stream through a region gained 3.4 % of its energy in 3 s. There 1 % of
 * what the mean velocity has beyond gravity's is taken back in each step, from all that flows:
 * slowly, for sums over vortices swing while a row crosses an edge. Friction would hold the stream
 * by itself, and better than its sum over levels is known. Not after particles have been removed,
 * which took theirs along. */
void refinement_restore_momentum(struct sph *s)
{
    const struct refinement *r = s->refinement;
    double sums[5] = {r->momentum[0], r->momentum[1], r->momentum[2], s->step.mass, r->gone};
    double gained = 0.0;
    if (s->zones || !(s->periodic[0] || s->periodic[1] || (s->dim == 3 && s->periodic[2])))
        return;
    MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int a = 0; a < s->dim && sums[4] == 0.0; a++) {
        if (!s->periodic[a] || walls_push(s->walls, a))
            continue;
        const double due = s->start.momentum[a] / r->mass0 + s->gravity[a] * s->t;
        const double by = returned * (sums[a] / sums[3] - due);
        for (struct sph *q = s; q; q = q->finer)
            for (int i = 0; i < q->p.n; i++) {
                double *y = state_row(&q->p, q->p.y, i);
                if (particles_is_guard(&q->p, i))
                    continue;
                gained -= by * y[q->dim + a];
                y[q->dim + a] -= by * y[at_mass(q->dim)];
            }
    }
    book_energy(s, gained);
}

const char *sph_level_name(const struct sph *s)
{
    static char text[32];
    snprintf(text, sizeof text, ", level %d", s->level);
    return s->guards ? text : "";
}

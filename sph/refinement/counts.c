/* counts.c - how many guards there should be, and where one is missing or too many. The gap at a
 * parent that flows is the kernel sum, at its position, of the children that all parents would have
 * if they were split now, less that of the children there are,
 *   gap(x) = sum over parents and their 2^D children c of W(x - x_c)/W(0)
 *            - sum over the finer level's particles j of W(x - x_j)/W(0),
 * with the support R of the finer level: 0 beside walls, surfaces and edges as well. It is averaged
 * over the parents that flow in its support, for the children of one parent are no lattice.
 *
 * Every EVERY steps, from integrate.c after the lists of guards are made: look_at_flowing adds
 * guards where parents lack children, look_at_children (rarer) marks guards that are too many. Of
 * all within R/2 or 2 dx of each other one wish is granted a round, so that one gap is not filled
 * twice.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "counts.h"

#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../walls/sph_walls.h"
#include "guards.h"
#include "refinement.h"
#include "regions.h"

/* What gaps, in children, ask for. Of parents that flow, averaged, in units of what one child
 * changes, one is created beyond `few'. At a single place, where means say little of sheets and
 * drops, a child is removed where there are more than `many' too many. Both give way to the deficit
 * or surplus of the fluid's mass, for they would not balance by themselves. Of all within R/2 (2
 * dx) of each other, which have the same gap, one is granted: the one with the largest wish,
 * whatever the order of the particles, the side or the rank. */
static const double few = 0.4, many = 1.2;
static const double most_off = 1e-3; /* of the mass: beyond this they give way no further */
static const double hole = 0.6;      /* spacings from the next one: room for one more */
enum {
    EVERY = 2,           /* steps: parents are looked at */
    CHILDREN_EVERY = 16, /* and children */
    ROUNDS = 4,          /* of requests, of those that nobody near has outbid */
    PLACES = 5           /* along each axis: where a hole is looked for, births' among them */
};
static const double nothing = 1e30; /* no gap is known */

/* Particles found near a place. */
struct found {
    int n;
    int *j;
};

/* One pass over two levels; gap: of the parents, then of their ghosts; hole: positions near
 * parents. */
struct population {
    struct sph *s, *fine;
    const struct regions *regions;
    double *gap, *ghost_gap, *depth, (*hole)[3];
    double off;         /* -1 .. 1: how much more mass flows than at the start */
    struct found found; /* a list to reuse */
};

/* Distance of two positions, m. */
static double distance(int dim, const double *x, const double *y)
{
    return sqrt(vec_distance2(dim, x, y));
}

/* W(r)/W(0): 1 for a particle at the same place. */
static double weight(double r, double R)
{
    const double q = r / R, t = q < 1.0 ? 1.0 - q : 0.0;
    return t * t * t * t * (1.0 + 4.0 * q);
}

/* Kernel sum at x over the children that a parent at y would have. */
static double family(const struct sph *s, const double *x, const double *y, double R)
{
    double sum = 0.0;
    if (distance(s->dim, x, y) >= R + s->dx)
        return 0.0;
    for (int c = 0; c < 1 << s->dim; c++) {
        double z[3];
        for (int a = 0; a < s->dim; a++)
            z[a] = y[a] + (c >> a & 1 ? 0.25 : -0.25) * s->dx;
        sum += weight(distance(s->dim, x, z), R);
    }
    return sum;
}

/* Particles of level `at' within reach of x, guards included, into `to'. */
static void look_around(struct sph *at, const double *x, double reach, struct found *to)
{
    neighbours_gather(at, x, x, reach, at->guards->ghost, 0);
    to->n = neighbours_pick(at, x, reach, 0, &to->j, NULL);
}

/* The gap at x in children; positive: some are missing. */
static double gap_at(struct population *c, const double *x)
{
    struct sph *s = c->s, *fine = c->fine;
    double gap = 0.0;
    look_around(s, x, fine->R + 0.5 * s->dx, &c->found);
    for (int k = 0; k < c->found.n; k++)
        if (guards_role(s, c->found.j[k]) & ROLE_PARENT)
            gap += family(s, x, prim_line(&s->p, c->found.j[k]), fine->R);
    look_around(fine, x, fine->R, &c->found);
    for (int k = 0; k < c->found.n; k++)
        gap -= weight(distance(s->dim, x, prim_line(&fine->p, c->found.j[k])), fine->R);
    return gap;
}

/* Gaps of the parents that flow, but those on the very edge. depth is the distance from the
 * region's edge, m. Ghosts of other ranks get the gaps of their owners. Collective. */
static void find_gaps(struct population *c)
{
    struct sph *s = c->s;
    c->gap = NEW(double, s->p.n);
    c->depth = NEW(double, s->p.n);
    c->ghost_gap = NEW(double, s->p.nghost);
    for (int k = 0; k < s->p.nghost; k++)
        c->ghost_gap[k] = nothing;
    for (int i = 0; i < s->p.n; i++) {
        const double *x = prim_line(&s->p, i);
        c->gap[i] = nothing;
        if ((s->p.role[i] & (ROLE_PARENT | ROLE_GUARD)) != ROLE_PARENT)
            continue;
        c->depth[i] = regions_distance(c->regions, s->level + 1, x);
        if (c->depth[i] >= 0.5 * s->dx)
            c->gap[i] = gap_at(c, x);
    }
    domain_share(s, c->gap, 1, c->ghost_gap);
}

/* Mean gap around parent i; one: what one child at its place changes of it. A kernel-weighted mean
 * over the parents whose gap is known; `one' is the same mean of the change that a child at parent
 * i makes to all these gaps. */
static double mean_gap(const struct population *c, int i, double *one)
{
    const struct sph *s = c->s;
    const struct neighbours *l = s->list;
    const double *x = prim_line(&s->p, i);
    double sum = c->gap[i], total = 1.0, own = 1.0;
    for (int64_t k = l->start[i]; k < l->start[i] + l->count[i]; k++) {
        const int j = l->j[k], ghost = j - s->p.n;
        const double gap = ghost < 0            ? c->gap[j]
                           : ghost < s->p.nhalo ? c->ghost_gap[ghost]
                                                : nothing;
        const double r = distance(s->dim, x, prim_line(&s->p, j)), W = weight(r, s->R);
        if (gap >= nothing)
            continue;
        sum += W * gap;
        own += W * weight(r, c->fine->R);
        total += W;
    }
    *one = own / total;
    return sum / total;
}

/* Distance from x to the next one of those found. INFINITY if none were found. */
static double room_at(const struct sph *at, const struct found *near, const double *x)
{
    double least = INFINITY;
    for (int k = 0; k < near->n; k++)
        least = fmin(least, distance(at->dim, x, prim_line(&at->p, near->j[k])));
    return least;
}

/* The widest hole among the particles of a level within half the width `wide' of x, in spacings.
 * Tries a grid of PLACES positions along each axis and sets hole_x to the best one. */
static double find_hole(const struct sph *at, const struct found *near, const double *x,
                        double wide, double *hole_x)
{
    double most = 0.0;
    for (int k = 0; k < (at->dim == 2 ? PLACES * PLACES : PLACES * PLACES * PLACES); k++) {
        double y[3] = {0.0, 0.0, 0.0};
        for (int a = 0, n = k; a < at->dim; a++, n /= PLACES)
            y[a] = x[a] + (n % PLACES / (PLACES - 1.0) - 0.5) * wide;
        const double room = room_at(at, near, y) / at->dx;
        if (room > most) {
            most = room;
            memcpy(hole_x, y, sizeof y);
        }
    }
    return most;
}

/* Adds to level `at' a guard to be created at x at the end of the step, with the fields of particle
 * i of `from' and its share of the volume. */
static void create_child(struct sph *at, const double *x, const struct sph *from, int i)
{
    struct guards *g = at->guards;
    const int dim = at->dim;
    const double *q = prim_line(&from->p, i);
    ROOM_IN(g, g->created, g->ncreated + 1);
    struct created *to = g->created + g->ncreated++;
    *to = (struct created){.t = from->t,
                           .rho = q[at_rho(dim)],
                           .volume = ldexp(q[at_volume(dim)], -dim * (at->level - from->level))};
    memcpy(to->x, x, (size_t)dim * sizeof *x);
    memcpy(to->u, q + dim, (size_t)dim * sizeof *q);
    memcpy(to->slope, slope_line(&from->p, i), (size_t)from->p.nslope * sizeof(double));
}

/* Whether there is a hole near parent i that flows, with no wall between; sets c->hole[i]. In 3D
 * the widest holes of a lattice are wider, by sqrt(3/2) = 1.22. */
static bool has_hole(struct population *c, int i)
{
    struct sph *s = c->s, *fine = c->fine;
    const double *x = prim_line(&s->p, i);
    double *y = c->hole[i], d[3] = {0.0, 0.0, 0.0};
    look_around(fine, x, s->dx + fine->dx, &c->found);
    if (find_hole(fine, &c->found, x, s->dx, y) < (s->dim == 2 ? hole : 1.22 * hole))
        return false;
    for (int a = 0; a < s->dim; a++)
        d[a] = y[a] - x[a];
    return !s->walls || walls_meet(s, x, d) >= 1.0;
}

/* Of two that ask for as much: the one that is first along x, then y, then z. */
static bool is_before(const struct sph *s, int i, int j)
{
    const double *x = prim_line(&s->p, i), *y = prim_line(&s->p, j);
    int a = 0;
    while (a < s->dim - 1 && fabs(x[a] - y[a]) < 1e-6 * s->dx)
        a++;
    return x[a] < y[a];
}

enum { GRANTED = -1 }; /* instead of a wish */

/* Whether nobody within R/2 of i requests more or has been granted what it requested. Ties go by
 * position, so that both particles of a pair, whichever rank looks, agree. */
static bool leads(const struct sph *s, int i, const double *wish, const double *ghost_wish)
{
    const double same = 1e-9 * wish[i];
    const struct neighbours *l = s->list;
    for (int64_t k = l->start[i]; k < l->start[i] + l->count[i]; k++) {
        const int j = l->j[k], ghost = j - s->p.n;
        const double its = ghost < 0 ? wish[j] : ghost < s->p.nhalo ? ghost_wish[ghost] : 0.0;
        if (its == 0.0 || (its > 0.0 && its < wish[i] - same) ||
            distance(s->dim, prim_line(&s->p, i), prim_line(&s->p, j)) >=
                fmax(0.5 * s->R, 2.0 * s->dx))
            continue;
        if (its < 0.0 || its > wish[i] + same || is_before(s, j, i))
            return false;
    }
    return true;
}

/* Does what is asked for, of one level, where it is asked for most; then where nobody near has been
 * granted anything, and so on. Collective. act(c, i) carries the wish out; wish[i] = GRANTED bars
 * the neighbours. */
static void grant(struct population *c, struct sph *s, double *wish,
                  void (*act)(struct population *c, int i))
{
    double *ghosts = NEW(double, s->p.nghost);
    bool *leading = NEW(bool, s->p.n);
    for (int round = 0; round < ROUNDS; round++) {
        domain_share(s, wish, 1, ghosts);
        for (int i = 0; i < s->p.n; i++)
            leading[i] = wish[i] > 0.0 && leads(s, i, wish, ghosts);
        for (int i = 0; i < s->p.n; i++)
            if (leading[i]) {
                act(c, i);
                wish[i] = GRANTED;
            }
    }
    FREE(leading, ghosts);
}

/* Creates the child in the hole found for parent i. */
static void give_child(struct population *c, int i) { create_child(c->fine, c->hole[i], c->s, i); }

/* Parents that flow, but those as deep as R - dx, where guards of the finer level end: each
 * requests a child as far as its mean gap goes beyond the bound. Collective. */
static void look_at_flowing(struct population *c)
{
    struct sph *s = c->s;
    double *wish = NEW(double, s->p.n);
    find_gaps(c);
    c->hole = mem_new((size_t)s->p.n, sizeof *c->hole);
    for (int i = 0; i < s->p.n; i++) {
        double one;
        wish[i] = 0.0;
        if (c->gap[i] >= nothing || c->depth[i] >= s->R - s->dx)
            continue;
        const double more = mean_gap(c, i, &one) - few * (1.0 + c->off) * one;
        if (more > 0.0 && has_hole(c, i))
            wish[i] = more / one;
    }
    grant(c, s, wish, give_child);
    mem_free(wish);
}

/* It is removed at the end of the step (life.c). */
static void mark_surplus(struct population *c, int i) { c->fine->p.role[i] |= ROLE_SURPLUS; }

/* Guards of the finer level outside of where it flows wish to be removed as far as their surplus
 * goes beyond the bound. Collective. */
static void look_at_children(struct population *c)
{
    struct sph *fine = c->fine;
    double *wish = NEW(double, fine->p.n);
    for (int i = 0; i < fine->p.n; i++) {
        const double *x = prim_line(&fine->p, i);
        wish[i] = 0.0;
        if (guards_is_outside(fine, i) &&
            regions_distance(c->regions, fine->level, x) >= 0.5 * c->s->dx)
            wish[i] = fmax(0.0, -gap_at(c, x) - many * (1.0 - 0.4 * c->off));
    }
    grant(c, fine, wish, mark_surplus);
    mem_free(wish);
}

/* Both looks at the pair of levels s and s->finer; off says how far the mass of all has drifted, as
 * a fraction of most_off. */
static void mark_level(struct sph *s, const struct refinement *r)
{
    struct population c = {.s = s, .fine = s->finer, .regions = r->regions};
    c.off = fmax(-1.0, fmin(r->mass_surplus / most_off, 1.0));
    look_at_flowing(&c);
    if (s->run->step % CHILDREN_EVERY == 0)
        look_at_children(&c);
    FREE(c.gap, c.hole, c.ghost_gap, c.depth, c.found.j);
}

/* s may be any level: with local steps the finer ones alone are at one time. */
void counts_mark(struct sph *s)
{
    const struct sph *coarsest = s;
    if (s->run->step % EVERY > 0 || s->packing)
        return;
    while (coarsest->coarser)
        coarsest = coarsest->coarser;
    for (; s->finer; s = s->finer)
        mark_level(s, coarsest->refinement);
}

/* rendezvous.c - fields on their way. Each coupler rank gets an equal share of the targets, tells
 * the giver's ranks around which places it needs values, and answers when all of them have put
 * theirs. Needs are announced only when they change; a resting set costs one put and one answer a
 * window. SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

#include <stdio.h>
#include <string.h>

#include "../common/log.h"
#include "../common/mem.h"
#include "../common/timer.h"

static struct link *link_of(struct coupler *c, const struct solver *s, const struct message *m)
{
    if (m->head.field < 0 || m->head.field >= s->nfields || s->field[m->head.field].link < 0)
        fail("%s rank %d speaks of a field (number %d) that is not in the plan", s->name, m->rank,
             m->head.field);
    return &c->link[s->field[m->head.field].link];
}

void rendezvous_open(struct coupler *c)
{
    for (int i = 0; i < c->nlinks; i++) {
        struct link *l = &c->link[i];
        const int takers = c->solver[l->taker].size, givers = c->solver[l->giver].size;
        l->asker = NEW(struct asker, takers);
        l->in[0].put = NEW(struct message *, givers);
        l->in[1].put = NEW(struct message *, givers);
        for (int r = 0; r < takers; r++)
            l->naskers += !l->from_grid || r % c->size == c->rank;
    }
}

static void drop(const struct coupler *c, struct link *l, struct arrival *a)
{
    for (int r = 0; r < c->solver[l->giver].size; r++)
        message_free(&a->put[r]);
    a->n = 0;
    a->tick = -1;
}

void rendezvous_close(struct coupler *c)
{
    for (int i = 0; i < c->nlinks; i++) {
        struct link *l = &c->link[i];
        if (!l->asker)
            continue; /* the plan was refused */
        for (int r = 0; r < c->solver[l->taker].size; r++)
            mem_free(l->asker[r].x);
        for (int k = 0; k < 2; k++) {
            drop(c, l, &l->in[k]);
            mem_free(l->in[k].put);
        }
        mem_free(l->asker);
        region_free(&l->region);
    }
}

/* --- what is wanted --- */

static long count_targets(const struct coupler *c, const struct link *l)
{
    long n = 0;
    for (int r = 0; r < c->solver[l->taker].size; r++)
        n += l->asker[r].ntarget;
    return n;
}

static double *all_targets(const struct coupler *c, const struct link *l, long n)
{
    double *x = NEW(double, n * l->dim);
    long at = 0;
    for (int r = 0; r < c->solver[l->taker].size; r++) {
        const struct asker *a = &l->asker[r];
        if (a->ntarget > 0)
            memcpy(x + at * l->dim, a->x, (size_t)(a->ntarget * l->dim) * sizeof *x);
        at += a->ntarget;
    }
    return x;
}

static struct region points_wanted(const struct coupler *c, const struct link *l, int slack)
{
    const struct scene_domain *d = &c->scene.domain;
    const long n = count_targets(c, l);
    double *x = all_targets(c, l, n), period[3];
    for (int a = 0; a < 3; a++)
        period[a] = d->periodic[a] ? d->max[a] - d->min[a] : 0.0;
    const struct region r = region_around(l->dim, l->support, period, n, x, slack);
    mem_free(x);
    return r;
}

static void box_of(const struct link *l, const struct asker *a, int lo[3], int hi[3])
{
    const struct cpl_grid *g = &l->grid;
    region_cells(l->dim, g->origin, g->spacing, g->cells, g->periodic, a->lo, a->hi, lo, hi);
}

static struct region boxes_wanted(const struct coupler *c, const struct link *l, int slack)
{
    struct region r = {.dim = l->dim};
    r.box = wire_alloc((size_t)c->solver[l->taker].size * sizeof *r.box);
    for (int i = 0; i < c->solver[l->taker].size; i++) {
        struct region_box b = {.asker = i};
        if (!l->asker[i].asked)
            continue;
        box_of(l, &l->asker[i], b.lo, b.hi);
        for (int a = 0; a < l->dim && b.lo[a] < b.hi[a]; a++) {
            const int n = l->grid.cells[a];
            b.lo[a] -= slack;
            b.hi[a] += slack;
            if (!l->grid.periodic[a]) {
                b.lo[a] = b.lo[a] < 0 ? 0 : b.lo[a];
                b.hi[a] = b.hi[a] > n ? n : b.hi[a];
            }
        }
        r.box[r.nboxes++] = b;
    }
    return r;
}

static struct region wanted(const struct coupler *c, const struct link *l, int slack)
{
    return l->from_grid ? boxes_wanted(c, l, slack) : points_wanted(c, l, slack);
}

/* Tells the giver what is wanted, if that is more than it knows. Sets that move get some slack, so
 * that it lasts. */
static void announce(struct coupler *c, struct link *l)
{
    const struct solver *g = &c->solver[l->giver];
    struct region exact = wanted(c, l, 0);
    struct pack p;
    if (region_holds(&l->region, &exact)) {
        region_free(&exact);
        return;
    }
    region_free(&l->region);
    l->region = exact;
    if (l->generation > 0) {
        region_free(&exact);
        l->region = wanted(c, l, l->from_grid ? 2 : 1);
    }
    l->generation++;
    drop(c, l, &l->in[0]);
    drop(c, l, &l->in[1]);
    pack_begin(&p, WIRE_NEED, l->gfield, l->asked_tick);
    pack_head(&p)->generation = l->generation;
    region_pack(&p, &l->region);
    wire_send_all(&c->wire, g->peer, &p);
}

/* --- answers --- */

static const void *column(struct coupler *c, struct message *m, size_t width)
{
    return take_view(&c->wire, m, (size_t)m->head.count * width);
}

/* All that the giver's ranks have put, and its periodic images where somebody looks. */
static struct map_cloud assemble(struct coupler *c, const struct link *l, const struct arrival *a)
{
    struct map_cloud s = {0};
    const size_t nd = (size_t)l->dim, nc = (size_t)l->ncomp;
    long room = 0;
    for (int r = 0; r < c->solver[l->giver].size; r++) {
        struct message *m = a->put[r];
        double image[27][3], place[3] = {0};
        m->at = 0;
        const double *x = column(c, m, nd * sizeof *x);
        const int64_t *gid = column(c, m, sizeof *gid);
        const double *volume = column(c, m, sizeof *volume), *v = column(c, m, nc * sizeof *v);
        for (size_t i = 0; i < (size_t)m->head.count; i++) {
            memcpy(place, x + i * nd, nd * sizeof *place);
            const int n = region_images(&l->region, place, image);
            if (s.n + n > room) {
                const long more = 2 * room + m->head.count + 27;
                GROW(s.x, room * l->dim, more * l->dim);
                GROW(s.gid, room, more);
                GROW(s.volume, room, more);
                GROW(s.v, room * l->ncomp, more * l->ncomp);
                room = more;
            }
            for (int k = 0; k < n; k++, s.n++) {
                memcpy(s.x + s.n * l->dim, image[k], nd * sizeof *s.x);
                memcpy(s.v + s.n * l->ncomp, v + i * nc, nc * sizeof *s.v);
                s.gid[s.n] = gid[i];
                s.volume[s.n] = volume[i];
            }
        }
    }
    return s;
}

/* Without any target the answer is empty and needs nothing put. */
static void answer_points(struct coupler *c, struct link *l, const struct arrival *a)
{
    const long n = count_targets(c, l);
    struct map_cloud cloud = n > 0 ? assemble(c, l, a) : (struct map_cloud){0};
    double *x = all_targets(c, l, n), *v = NEW(double, n * l->ncomp);
    unsigned char *mask = NEW(unsigned char, n);
    l->map(l->dim, l->support, l->ncomp, &cloud, n, x, v, mask);
    long at = 0;
    for (int r = 0; r < c->solver[l->taker].size; r++) {
        const long m = l->asker[r].ntarget;
        struct pack p;
        pack_begin(&p, WIRE_VALUES, l->tfield, l->asked_tick);
        pack_head(&p)->t = a->t;
        pack_head(&p)->count = m;
        pack_bytes(&p, v + at * l->ncomp, (size_t)(m * l->ncomp) * sizeof *v);
        pack_bytes(&p, mask + at, (size_t)m);
        wire_send(&c->wire, c->solver[l->taker].peer, r, &p);
        at += m;
    }
    map_cloud_free(&cloud);
    mem_free(x);
    mem_free(v);
    mem_free(mask);
}

/* A piece of a giver's block into the patch of its asker; returns the number of cells. */
static int64_t paste(double *to, const int lo[3], const int hi[3], const double *from,
                     const int64_t piece[7], size_t width)
{
    int first[3], last[3];
    int64_t n = 1;
    for (int a = 0; a < 3; a++) {
        first[a] = piece[1 + a] > lo[a] ? (int)piece[1 + a] : lo[a];
        last[a] = piece[4 + a] < hi[a] ? (int)piece[4 + a] : hi[a];
        if (first[a] >= last[a])
            return 0;
        n *= last[a] - first[a];
    }
    for (int k = first[2]; k < last[2]; k++)
        for (int j = first[1]; j < last[1]; j++) {
            const int64_t i0 =
                ((k - piece[3]) * (piece[5] - piece[2]) + (j - piece[2])) * (piece[4] - piece[1]) +
                (first[0] - piece[1]);
            const int64_t o0 =
                ((int64_t)(k - lo[2]) * (hi[1] - lo[1]) + (j - lo[1])) * (hi[0] - lo[0]) +
                (first[0] - lo[0]);
            memcpy(to + (size_t)o0 * width, from + (size_t)i0 * width,
                   (size_t)(last[0] - first[0]) * width * sizeof *to);
        }
    return n;
}

static void answer_patch(struct coupler *c, struct link *l, const struct arrival *a, int asker)
{
    int lo[3], hi[3];
    struct pack p;
    int64_t filled = 0;
    const size_t width = CPL_TERMS * (size_t)l->ncomp;
    box_of(l, &l->asker[asker], lo, hi);
    const int64_t cells = (int64_t)(hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
    pack_begin(&p, WIRE_VALUES, l->tfield, a->tick);
    pack_head(&p)->t = a->t;
    for (int d = 0; d < 3; d++) {
        pack_int(&p, lo[d]);
        pack_int(&p, hi[d]);
    }
    double *to = pack_room(&p, (size_t)cells * width * sizeof *to);
    for (int r = 0; r < c->solver[l->giver].size && cells > 0; r++) {
        struct message *m = a->put[r];
        m->at = 0;
        for (int64_t i = 0; i < m->head.count; i++) {
            int64_t piece[7];
            take_bytes(&c->wire, m, piece, sizeof piece);
            const int64_t n = (piece[4] - piece[1]) * (piece[5] - piece[2]) * (piece[6] - piece[3]);
            const double *from = take_view(&c->wire, m, (size_t)n * width * sizeof *from);
            if (piece[0] == asker)
                filled += paste(to, lo, hi, from, piece, width);
        }
    }
    if (filled != cells)
        fail("field %s: the blocks of %s hold %lld of the %lld cells that rank %d of %s asks for",
             c->solver[l->giver].field[l->gfield].name, c->solver[l->giver].name, (long long)filled,
             (long long)cells, asker, c->solver[l->taker].name);
    wire_send(&c->wire, c->solver[l->taker].peer, asker, &p);
}

/* Nobody looks anywhere: no values are on their way. */
static bool nothing_wanted(const struct coupler *c, const struct link *l)
{
    int lo[3], hi[3];
    if (!l->from_grid)
        return count_targets(c, l) == 0;
    for (int r = 0; r < c->solver[l->taker].size; r++) {
        if (!l->asker[r].asked)
            continue;
        box_of(l, &l->asker[r], lo, hi);
        if (lo[0] < hi[0])
            return false;
    }
    return true;
}

static void try_answer(struct coupler *c, struct link *l)
{
    const struct arrival *a = &l->in[l->asked_tick & 1];
    if (l->asked_tick < 0 || l->nasked < l->naskers)
        return;
    const bool nothing = nothing_wanted(c, l);
    if (!nothing && (a->tick != l->asked_tick || a->n < c->solver[l->giver].size))
        return;
    const double start = wall_time();
    c->solver[l->taker].waited_for[l->giver] += start - l->asked_at;
    for (int r = 0; r < c->solver[l->taker].size && l->from_grid; r++)
        if (l->asker[r].asked)
            answer_patch(c, l, a, r);
    if (!l->from_grid)
        answer_points(c, l, a);
    for (int r = 0; r < c->solver[l->taker].size; r++)
        l->asker[r].asked = false;
    l->nasked = 0;
    l->asked_tick = -1;
    l->mapped += wall_time() - start;
    l->served++;
}

void rendezvous_get(struct coupler *c, struct solver *s, struct message *m)
{
    struct link *l = link_of(c, s, m);
    struct asker *a = &l->asker[m->rank];
    if (a->asked || (l->asked_tick >= 0 && l->asked_tick != m->head.tick))
        fail("%s rank %d asks for %s at %lld while others wait for it at %lld", s->name, m->rank,
             s->field[m->head.field].name, (long long)m->head.tick, (long long)l->asked_tick);
    l->asked_tick = m->head.tick;
    a->asked = true;
    if (m->rank == 0)
        rendezvous_take_ticks(c, s, m);
    if (l->from_grid) {
        take_bytes(&c->wire, m, a->lo, sizeof a->lo);
        take_bytes(&c->wire, m, a->hi, sizeof a->hi);
        l->moved = true;
    } else if (m->head.count >= 0) {
        const size_t n = (size_t)m->head.count * (size_t)l->dim;
        mem_free(a->x);
        a->x = NEW(double, n);
        a->ntarget = (long)m->head.count;
        take_bytes(&c->wire, m, a->x, n * sizeof *a->x);
        l->moved = true;
    }
    if (++l->nasked < l->naskers)
        return;
    l->asked_at = wall_time();
    if (l->moved)
        announce(c, l);
    l->moved = false;
    try_answer(c, l);
}

void rendezvous_put(struct coupler *c, struct solver *s, struct message **m)
{
    struct link *l = link_of(c, s, *m);
    const int64_t tick = (*m)->head.tick;
    struct arrival *a = &l->in[tick & 1];
    if ((*m)->head.generation != l->generation)
        return; /* an answer to an older need: a new one is on its way */
    if (a->tick != tick)
        drop(c, l, a);
    a->tick = tick;
    a->t = (*m)->head.t;
    a->n += !a->put[(*m)->rank];
    message_free(&a->put[(*m)->rank]);
    a->put[(*m)->rank] = *m;
    *m = NULL;
    try_answer(c, l);
}

/* --- who waits for what --- */

void rendezvous_take_ticks(struct coupler *c, struct solver *s, struct message *m)
{
    const int64_t n = take_int(&c->wire, m);
    if (n != s->nfields)
        fail("%s speaks of %lld fields, the plan has %d", s->name, (long long)n, s->nfields);
    for (int i = 0; i < s->nfields; i++)
        s->field[i].last_tick = take_int(&c->wire, m);
}

/* The link on which a solver waits for values that have not been put; NULL: it does not wait. */
static const struct link *missing(const struct coupler *c, int solver)
{
    for (int i = 0; i < c->nlinks; i++) {
        const struct link *l = &c->link[i];
        if (l->taker == solver && l->asker[0].asked &&
            c->solver[l->giver].field[l->gfield].last_tick < l->asked_tick)
            return l;
    }
    return NULL;
}

static bool waits_in_a_circle(const struct coupler *c, int solver, char *text)
{
    const struct link *l = missing(c, solver);
    int steps = 0;
    while (l && l->giver != solver && steps++ < c->nsolvers)
        l = missing(c, l->giver);
    if (!l || l->giver != solver)
        return false;
    for (l = missing(c, solver);; l = missing(c, l->giver)) {
        problem(text, "%s waits in window %lld for %s of %s, which has not been given",
                c->solver[l->taker].name, (long long)c->window,
                c->solver[l->taker].field[l->tfield].name, c->solver[l->giver].name);
        if (l->giver == solver)
            return true;
    }
}

bool rendezvous_starved(const struct coupler *c, char *text)
{
    for (int i = 0; i < c->nsolvers; i++) {
        const struct link *l = missing(c, i);
        if (l && c->solver[l->giver].advanced == c->window) {
            problem(text, "%s waits for %s, but %s has ended window %lld without giving it",
                    c->solver[i].name, c->solver[i].field[l->tfield].name, c->solver[l->giver].name,
                    (long long)c->window);
            return true;
        }
        if (waits_in_a_circle(c, i, text))
            return true;
    }
    return false;
}

void rendezvous_waiting(const struct coupler *c, char *text)
{
    for (int i = 0; i < c->nlinks; i++) {
        const struct link *l = &c->link[i];
        if (l->nasked > 0)
            problem(text, "  %s waits for %s of %s", c->solver[l->taker].name,
                    c->solver[l->taker].field[l->tfield].name, c->solver[l->giver].name);
    }
}

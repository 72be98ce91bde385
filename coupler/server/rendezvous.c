/* rendezvous.c - fields on their way. Each coupler rank gets an equal share of the targets, tells
 * the source's ranks around which places it needs values, and answers when all of them have put
 * theirs. Needs are announced only when they change; a resting set costs one put and one answer a
 * window. SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

static _Noreturn void not_planned(const struct solver *s, const struct message *m)
{
    abort_run("%s rank %d names a field (number %d) that is not in the plan", s->name, m->rank,
              m->head.field);
}

/* Numbers come from another program: they are looked at before they are used. */
static struct partner_link *link_of_target(struct coupler *c, const struct solver *s,
                                           const struct message *m)
{
    if (m->head.field < 0 || m->head.field >= s->nfields || s->field[m->head.field].link < 0)
        not_planned(s, m);
    return &c->link[s->field[m->head.field].link];
}

static struct partner_link *link_of_source(struct coupler *c, const struct solver *s,
                                           const struct message *m)
{
    if (m->head.field < 0 || m->head.field >= s->nfields || m->head.target < 0 ||
        m->head.target >= s->field[m->head.field].ntargets)
        not_planned(s, m);
    return &c->link[s->field[m->head.field].target[m->head.target]];
}

/* Of points every rank of a target asks every rank of the coupler, of patches only one. */
void rendezvous_open(struct coupler *c)
{
    for (int i = 0; i < c->nlinks; i++) {
        struct partner_link *l = &c->link[i];
        const int targets = c->solver[l->target].size, sources = c->solver[l->source].size;
        l->asker = NEW(struct asker, targets);
        l->in[0].put = NEW(struct message *, sources);
        l->in[1].put = NEW(struct message *, sources);
        for (int r = 0; r < targets; r++)
            l->naskers += !l->from_grid || r % c->size == c->rank;
    }
}

/* Frees what was put for one tick. */
static void drop(const struct coupler *c, struct partner_link *l, struct arrival *a)
{
    for (int r = 0; r < c->solver[l->source].size; r++)
        message_free(&a->put[r]);
    a->n = 0;
    a->tick = -1;
}

static void forget_targets(struct asker *a)
{
    FREE(a->x, a->gid, a->volume);
    a->x = a->volume = NULL;
    a->gid = NULL;
    a->ntarget = 0;
}

void rendezvous_close(struct coupler *c)
{
    for (int i = 0; i < c->nlinks; i++) {
        struct partner_link *l = &c->link[i];
        if (!l->asker)
            continue; /* the plan was refused */
        for (int r = 0; r < c->solver[l->target].size; r++)
            forget_targets(&l->asker[r]);
        for (int k = 0; k < 2; k++) {
            drop(c, l, &l->in[k]);
            mem_free(l->in[k].put);
        }
        mem_free(l->asker);
        region_free(&l->region);
    }
}

/* --- what is wanted --- */

static long count_targets(const struct coupler *c, const struct partner_link *l)
{
    long n = 0;
    for (int r = 0; r < c->solver[l->target].size; r++)
        n += l->asker[r].ntarget;
    return n;
}

/* Of all targets, those that this rank maps: of a conservative mapping it knows the others, too. */
static void own_share(const struct coupler *c, const struct partner_link *l, long *first,
                      long *last)
{
    const int64_t n = count_targets(c, l);
    *first = l->map ? 0 : (long)(n * c->rank / c->size);
    *last = l->map ? (long)n : (long)(n * (c->rank + 1) / c->size);
}

/* x[n][dim], by rank of the target; owned by the caller. */
static double *all_targets(const struct coupler *c, const struct partner_link *l, long n)
{
    double *x = NEW(double, n * l->dim);
    long at = 0;
    for (int r = 0; r < c->solver[l->target].size; r++) {
        const struct asker *a = &l->asker[r];
        if (a->ntarget > 0)
            memcpy(x + at * l->dim, a->x, (size_t)(a->ntarget * l->dim) * sizeof *x);
        at += a->ntarget;
    }
    return x;
}

/* Without a map, that is of a conservative field, every source is wanted: how much of one falls to
 * a target depends on all targets near it. */
static struct region points_wanted(const struct coupler *c, const struct partner_link *l, int slack)
{
    long first, last;
    own_share(c, l, &first, &last);
    if (!l->map)
        return (struct region){.dim = l->dim, .all = last > first};
    double *x = all_targets(c, l, last);
    const struct region r = region_around(l->dim, l->support, l->period, last, x, slack);
    mem_free(x);
    return r;
}

static void box_of(const struct partner_link *l, const struct asker *a, int lo[3], int hi[3])
{
    const struct cpl_grid *g = &l->grid;
    region_cells(l->dim, g->origin, g->spacing, g->cells, g->periodic, a->lo, a->hi, lo, hi);
}

/* The box of each rank that asks, by its own number, with `slack' cells to each side. */
static struct region boxes_wanted(const struct coupler *c, const struct partner_link *l, int slack)
{
    struct region r = {.dim = l->dim};
    r.box = wire_alloc((size_t)c->solver[l->target].size * sizeof *r.box);
    for (int i = 0; i < c->solver[l->target].size; i++) {
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

static struct region wanted(const struct coupler *c, const struct partner_link *l, int slack)
{
    return l->from_grid ? boxes_wanted(c, l, slack) : points_wanted(c, l, slack);
}

/* Tells the source what is wanted, if that is more than it knows. Sets that move get some slack, so
 * that it lasts. A new generation: what was put for the old need is dropped, since it may lack what
 * is wanted now, and sources put it again (client_need). */
static void announce(struct coupler *c, struct partner_link *l)
{
    const struct solver *g = &c->solver[l->source];
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
    pack_head(&p)->target = l->number;
    region_pack(&p, &l->region);
    wire_send_all(&c->wire, g->peer, &p);
}

/* --- answers --- */

static const void *column(struct coupler *c, struct message *m, size_t width)
{
    return take_view(&c->wire, m, (size_t)m->head.count * width);
}

/* All that the source's ranks have put, and its periodic images where somebody looks. Rows in the
 * order of ranks; the mapping sorts them by gid. */
static struct map_cloud assemble(struct coupler *c, const struct partner_link *l,
                                 const struct arrival *a, long width)
{
    struct map_cloud s = {0};
    const size_t nd = (size_t)l->dim, nc = (size_t)width;
    for (int r = 0; r < c->solver[l->source].size; r++) {
        struct message *m = a->put[r];
        double image[27][3], place[3] = {0};
        m->at = 0;
        const double *x = column(c, m, nd * sizeof *x);
        const int64_t *gid = column(c, m, sizeof *gid);
        const double *volume = column(c, m, sizeof *volume), *v = column(c, m, nc * sizeof *v);
        for (size_t i = 0; i < (size_t)m->head.count; i++) {
            memcpy(place, x + i * nd, nd * sizeof *place);
            const int n = region_images(&l->region, place, image);
            map_cloud_room(&s, l->dim, width, s.n + n);
            for (int k = 0; k < n; k++, s.n++) {
                memcpy(s.x + s.n * l->dim, image[k], nd * sizeof *s.x);
                memcpy(s.v + s.n * width, v + i * nc, nc * sizeof *s.v);
                s.gid[s.n] = gid[i];
                s.volume[s.n] = volume[i];
            }
        }
    }
    return s;
}

/* Places, ids and volumes of all targets, without values; owned by the caller. */
static struct map_cloud target_cloud(const struct coupler *c, const struct partner_link *l, long n)
{
    struct map_cloud t = {.n = n, .x = all_targets(c, l, n)};
    long at = 0;
    t.gid = NEW(int64_t, n);
    t.volume = NEW(double, n);
    for (int r = 0; r < c->solver[l->target].size; r++) {
        const struct asker *a = &l->asker[r];
        if (a->ntarget > 0) {
            memcpy(t.gid + at, a->gid, (size_t)a->ntarget * sizeof *t.gid);
            memcpy(t.volume + at, a->volume, (size_t)a->ntarget * sizeof *t.volume);
        }
        at += a->ntarget;
    }
    return t;
}

/* v[last - first][width] and mask of the targets of this rank. */
static void map_values(struct coupler *c, const struct partner_link *l, const struct arrival *a,
                       long width, long first, long last, double *v, unsigned char *mask)
{
    struct map_cloud cloud = assemble(c, l, a, width);
    if (l->map) {
        double *x = all_targets(c, l, last);
        l->map(l->dim, l->support, (int)width, &cloud, last, x, v, mask);
        mem_free(x);
    } else {
        struct map_cloud targets = target_cloud(c, l, count_targets(c, l));
        map_deal(l->deal, l->dim, l->support, (int)width, l->period, &targets, &cloud, first, last,
                 v);
        memset(mask, 1, (size_t)(last - first));
        map_cloud_free(&targets);
    }
    map_cloud_free(&cloud);
}

/* All ranks of a source must speak alike. */
static int terms_of(const struct coupler *c, const struct partner_link *l, const struct arrival *a)
{
    const struct solver *g = &c->solver[l->source];
    for (int r = 1; r < g->size; r++)
        if (a->put[r]->head.terms != a->put[0]->head.terms)
            abort_run("field %s: rank 0 of %s puts %d terms in time, rank %d %d",
                      g->field[l->gfield].name, g->name, a->put[0]->head.terms, r,
                      a->put[r]->head.terms);
    return a->put[0]->head.terms;
}

/* Without any target the answer is empty and needs nothing put. This rank's targets first .. last -
 * 1 lie one after the other over the ranks of the target; each of these gets its piece, also an
 * empty one, for which it waits. */
static void answer_points(struct coupler *c, struct partner_link *l, const struct arrival *a)
{
    long first, last, at = 0;
    own_share(c, l, &first, &last);
    const int terms = last > first ? terms_of(c, l, a) : 1;
    const long width = (long)terms * l->ncomp;
    double *v = NEW(double, (last - first) * width);
    unsigned char *mask = NEW(unsigned char, last - first);
    if (last > first)
        map_values(c, l, a, width, first, last, v, mask);
    for (int r = 0; r < c->solver[l->target].size; at += l->asker[r].ntarget, r++) {
        const long i = at > first ? at : first, end = at + l->asker[r].ntarget;
        const long m = end < last ? end - i : last - i;
        struct pack p;
        pack_begin(&p, WIRE_VALUES, l->tfield, l->asked_tick);
        pack_head(&p)->t = a->t;
        pack_head(&p)->terms = terms;
        pack_head(&p)->count = m > 0 ? m : 0;
        if (m > 0) {
            pack_bytes(&p, v + (i - first) * width, (size_t)(m * width) * sizeof *v);
            pack_bytes(&p, mask + (i - first), (size_t)m);
        }
        wire_send(&c->wire, c->solver[l->target].peer, r, &p);
    }
    FREE(v, mask);
}

/* A piece of a source's block into the patch of its asker; returns the number of cells. The piece
 * is cut to the patch: with slack more was sent than asked. */
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

/* As many cells must come as the patch has: a gap between the source's blocks, or two blocks that
 * overlap, is an error of the source. */
static void answer_patch(struct coupler *c, struct partner_link *l, const struct arrival *a,
                         int asker)
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
    for (int r = 0; r < c->solver[l->source].size && cells > 0; r++) {
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
        abort_run(
            "field %s: the blocks of %s hold %lld of the %lld cells that rank %d of %s asks for",
            c->solver[l->source].field[l->gfield].name, c->solver[l->source].name,
            (long long)filled, (long long)cells, asker, c->solver[l->target].name);
    wire_send(&c->wire, c->solver[l->target].peer, asker, &p);
}

/* Nobody looks anywhere: no values are on their way. */
static bool nothing_wanted(const struct coupler *c, const struct partner_link *l)
{
    int lo[3], hi[3];
    long first, last;
    if (!l->from_grid) {
        own_share(c, l, &first, &last);
        return first == last;
    }
    for (int r = 0; r < c->solver[l->target].size; r++) {
        if (!l->asker[r].asked)
            continue;
        box_of(l, &l->asker[r], lo, hi);
        if (lo[0] < hi[0])
            return false;
    }
    return true;
}

/* Answers once all ranks of the target have asked and all of the source have put; called after each
 * get and each put, for either may be last. */
static void try_answer(struct coupler *c, struct partner_link *l)
{
    const struct arrival *a = &l->in[l->asked_tick & 1];
    if (l->asked_tick < 0 || l->nasked < l->naskers)
        return;
    const bool nothing = nothing_wanted(c, l);
    if (!nothing && (a->tick != l->asked_tick || a->n < c->solver[l->source].size))
        return;
    const double start = wall_time();
    c->solver[l->target].waited_for[l->source] += start - l->asked_at;
    for (int r = 0; r < c->solver[l->target].size && l->from_grid; r++)
        if (l->asker[r].asked)
            answer_patch(c, l, a, r);
    if (!l->from_grid)
        answer_points(c, l, a);
    for (int r = 0; r < c->solver[l->target].size; r++)
        l->asker[r].asked = false;
    l->nasked = 0;
    l->asked_tick = -1;
    l->mapped += wall_time() - start;
    l->served++;
}

/* Ids and volumes come along where all ranks deal out alike, of conservative mappings. */
static void take_targets(struct coupler *c, const struct partner_link *l, struct asker *a,
                         struct message *m)
{
    const size_t n = (size_t)m->head.count, nd = (size_t)l->dim;
    forget_targets(a);
    a->ntarget = (long)n;
    a->x = NEW(double, n *nd);
    take_bytes(&c->wire, m, a->x, n * nd * sizeof *a->x);
    if (l->map)
        return;
    a->gid = NEW(int64_t, n);
    a->volume = NEW(double, n);
    take_bytes(&c->wire, m, a->gid, n * sizeof *a->gid);
    take_bytes(&c->wire, m, a->volume, n * sizeof *a->volume);
}

/* Targets come along only if they have moved. With the last rank's question the region is compared
 * with what the source knows. */
void rendezvous_get(struct coupler *c, struct solver *s, struct message *m)
{
    struct partner_link *l = link_of_target(c, s, m);
    struct asker *a = &l->asker[m->rank];
    if (a->asked || (l->asked_tick >= 0 && l->asked_tick != m->head.tick))
        abort_run("%s rank %d asks for %s at %lld while others wait for it at %lld", s->name,
                  m->rank, s->field[m->head.field].name, (long long)m->head.tick,
                  (long long)l->asked_tick);
    l->asked_tick = m->head.tick;
    a->asked = true;
    if (m->rank == 0)
        rendezvous_take_ticks(c, s, m);
    if (l->from_grid) {
        take_bytes(&c->wire, m, a->lo, sizeof a->lo);
        take_bytes(&c->wire, m, a->hi, sizeof a->hi);
        l->moved = true;
    } else if (m->head.count >= 0) {
        take_targets(c, l, a, m);
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

/* Keeps the message itself as the value of that rank: nothing is copied until it is mapped. */
void rendezvous_put(struct coupler *c, struct solver *s, struct message **m)
{
    struct partner_link *l = link_of_source(c, s, *m);
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

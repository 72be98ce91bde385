/* domain.c - orthogonal recursive bisection over the ranks, migration, ghosts and their halo. The
 * tree needs no pointers: a node is a range of ranks [a, b), cut before rank m = a + (b - a)/2 by
 * cuts[m - 1]; ranks left of it are a .. m-1. Cost: owner O(log ranks); ghosts O(particles near the
 * sides of a part) plus a loop over peers; cutting anew log2(ranks) levels of PASSES reductions of
 * BINS numbers for each node. Every step: domain_ghosts after the sort, then a halo of prim and one
 * of slopes in every stage; domain_balance every 50 steps, followed by domain_migrate. All ranks
 * hold all cuts and boxes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "domain.h"

#include "../pairs/sph_pairs.h"

/* WORK: of a particle besides its pairs, as a number of them: sort, list, update, row overhead.
 * With levels in eighths of a pair, measured: PAIR; of rows that are deep, which are listed and
 * summed over once a step; what guards take from, at each stage, once a step. */
enum { BINS = 256, PASSES = 2, TAG_COUNT = 31, TAG_LINES = 32, WORK = 8 };
enum { PAIR = 8, DEEP_PAIR = 2, TAKEN = 6, DEEP_TAKEN = 2 };

struct domain_cut {
    int axis;
    double at;
};

/* What goes to and comes from one rank each exchange; this rank itself for periodic images. */
struct peer {
    int rank;
    int nsend, capacity;
    int *who;             /* local particle of each line sent */
    unsigned char *image; /* which periodic image of it, base 3 digits of shift + 1 */
    double *lines;        /* packed */
    int nrecv, first;     /* its ghosts: first .. first + nrecv - 1 */
};

struct domain {
    MPI_Comm comm; /* borrowed */
    int dim, rank, size;
    bool periodic[3];
    double lo[3], hi[3];
    struct domain_cut *cuts; /* [size - 1] */
    double (*box)[2][3];     /* [size] */
    int npeers;
    struct peer *peers;    /* ascending rank */
    MPI_Request *requests; /* [2 npeers] */
    int nrequests;
    double tau_sum; /* of mean over largest work of a rank, when it was looked at */
    int tau_n;
};

/* Part of the tree under construction: ranks, box, this rank's particles in it, of all levels. */
struct domain_node {
    int first, end;
    double lo[3], hi[3];
    int *who;
    const double (*x)[3]; /* of each local particle: place, work */
    const int *work;
    int n;
};

/* The axis along which the node's box is longest: cutting it keeps parts compact, with few
 * ghosts. */
static int longest_axis(const struct domain_node *t, int dim)
{
    int axis = 0;
    for (int a = 1; a < dim; a++)
        if (t->hi[a] - t->lo[a] > t->hi[axis] - t->lo[axis])
            axis = a;
    return axis;
}

int domain_owner(const struct domain *d, const double *x)
{
    int first = 0, end = d->size;
    while (end - first > 1) {
        const int m = first + (end - first) / 2;
        const struct domain_cut *c = d->cuts + m - 1;
        if (x[c->axis] < c->at)
            end = m;
        else
            first = m;
    }
    return first;
}

void domain_bounds(const struct domain *d, double lo[3], double hi[3])
{
    memcpy(lo, d->box[d->rank][0], 3 * sizeof(double));
    memcpy(hi, d->box[d->rank][1], 3 * sizeof(double));
}

/* Boxes of all ranks from the cuts. Follows the tree down to every rank; box[r][1] is cut where the
 * rank is left of the cut, box[r][0] where it is right of it. O(size log size). */
static void make_boxes(struct domain *d)
{
    for (int r = 0; r < d->size; r++) {
        int first = 0, end = d->size;
        memcpy(d->box[r][0], d->lo, sizeof d->lo);
        memcpy(d->box[r][1], d->hi, sizeof d->hi);
        while (end - first > 1) {
            const int m = first + (end - first) / 2;
            const struct domain_cut *c = d->cuts + m - 1;
            d->box[r][r < m][c->axis] = c->at;
            if (r < m)
                end = m;
            else
                first = m;
        }
    }
}

static int images(const struct domain *d) { return d->dim == 2 ? 9 : 27; }

/* Displacement of an image, whose number has digits k + 1 in base 3, one for each axis, k = -1, 0,
 * 1 periods. False if an axis that is not periodic would be shifted. */
static bool image_shift(const struct domain *d, int image, double shift[3])
{
    bool allowed = true;
    for (int a = 0; a < 3; a++, image /= 3) {
        const int k = a < d->dim ? image % 3 - 1 : 0;
        shift[a] = k == 0 ? 0.0 : k * (d->hi[a] - d->lo[a]);
        allowed = allowed && (k == 0 || d->periodic[a]);
    }
    return allowed;
}

static bool is_self(const struct domain *d, int image) { return image == images(d) / 2; }

/* Bounds of a rank along an axis for distances: open ends reach to infinity, for that is where
 * particles beyond them belong. */
static void reach_bounds(const struct domain *d, int rank, int a, double *lo, double *hi)
{
    const bool open = !d->periodic[a];
    *lo = open && d->box[rank][0][a] <= d->lo[a] ? -INFINITY : d->box[rank][0][a];
    *hi = open && d->box[rank][1][a] >= d->hi[a] ? INFINITY : d->box[rank][1][a];
}

/* Whether anything of `from', shifted, can lie within reach of the part of `to': compares the boxes
 * axis by axis, so corners count a little too often. */
static bool boxes_touch(const struct domain *d, int from, int to, const double *shift, double reach)
{
    for (int a = 0; a < d->dim; a++) {
        double lo[2], hi[2];
        reach_bounds(d, from, a, lo, hi);
        reach_bounds(d, to, a, lo + 1, hi + 1);
        if (lo[0] + shift[a] > hi[1] + reach || hi[0] + shift[a] < lo[1] - reach)
            return false;
    }
    return true;
}

/* Whether `from' may have ghosts for `to', directly or by an image; a rank's unshifted part is no
 * ghost of itself. */
static bool ranks_touch(const struct domain *d, int from, int to, double reach)
{
    double shift[3];
    for (int k = 0; k < images(d); k++)
        if (!(from == to && is_self(d, k)) && image_shift(d, k, shift) &&
            boxes_touch(d, from, to, shift, reach))
            return true;
    return false;
}

/* Both ranks of a pair must see each other as peers, so each looks with the eyes of both. Otherwise
 * rounding of lo + shift could make one wait for a message that the other does not send. */
static void find_peers(struct domain *d, double reach)
{
    mem_free(d->peers); /* with their buffers */
    d->npeers = 0;
    d->peers = NEW_IN(d, struct peer, d->size);
    for (int r = 0; r < d->size; r++)
        if (ranks_touch(d, d->rank, r, reach) || ranks_touch(d, r, d->rank, reach))
            d->peers[d->npeers++].rank = r;
    d->requests = NEW_IN(d->peers, MPI_Request, 2 * d->npeers);
}

/* Passes the cuts of s on to the finer levels, and makes boxes and peers of all anew. Lists of
 * pairs are void, since particles will migrate; reach is that of the largest skin, so peers hold
 * until the next cut. */
static void cuts_changed(struct sph *s)
{
    for (struct sph *q = s; q; q = q->finer) {
        if (q != s)
            memcpy(q->domain->cuts, s->domain->cuts,
                   (size_t)s->domain->size * sizeof(struct domain_cut));
        make_boxes(q->domain);
        find_peers(q->domain, 1.001 * (q->R + q->lists.skin_most));
        q->lists.ready = false;
    }
}

/* Work of the node's particles in each bin of [lo, hi) along an axis, over all ranks; the first
 * bin also counts what lies below, the last what lies above. */
static void count_bins(const struct sph *s, const struct domain_node *t, int axis, double lo,
                       double hi, int64_t *bins)
{
    memset(bins, 0, BINS * sizeof *bins);
    for (int k = 0; k < t->n; k++) {
        const double x = t->x[t->who[k]][axis];
        const double b = floor((x - lo) / (hi - lo) * BINS);
        bins[b < 0.0 ? 0 : b < BINS ? (int)b : BINS - 1] += t->work[t->who[k]];
    }
    MPI_Allreduce(MPI_IN_PLACE, bins, BINS, MPI_INT64_T, MPI_SUM, s->domain->comm);
}

/* Place with `share' of the node's work below it: bins refined around the quantile. */
static double quantile(const struct sph *s, const struct domain_node *t, int axis, double share)
{
    double lo = t->lo[axis], hi = t->hi[axis];
    int64_t bins[BINS], all = 0;
    for (int pass = 0; pass < PASSES; pass++) {
        count_bins(s, t, axis, lo, hi, bins);
        if (pass == 0)
            for (int k = 0; k < BINS; k++)
                all += bins[k];
        if (all == 0)
            return lo + share * (hi - lo);
        const double wanted = share * (double)all, width = (hi - lo) / BINS;
        int k = 0;
        int64_t below = 0;
        while (k < BINS - 1 && (double)(below + bins[k]) < wanted)
            below += bins[k++];
        if (pass == PASSES - 1)
            return lo + width * (wanted - (double)below > 0.5 * (double)bins[k] ? k + 1 : k);
        hi = lo + width * (k + 1); /* bins below k now fall in the first one of the next pass */
        lo = lo + width * k;
    }
    return lo;
}

/* Moves the particles below the cut to the front; returns their number. Order within does not
 * matter. */
static int split(const struct domain_node *t, const struct domain_cut *c)
{
    int n = 0;
    for (int k = 0; k < t->n; k++)
        if (t->x[t->who[k]][c->axis] < c->at) {
            const int i = t->who[k];
            t->who[k] = t->who[n];
            t->who[n++] = i;
        }
    return n;
}

/* Cuts the node where its ranks' share of the work lies below, or evenly: of the volume, on a
 * lattice face, as a uniform filling needs; then both halves. All ranks act alike: the cut comes
 * from reduced sums. */
static void cut(struct sph *s, const struct domain_node *t, bool evenly)
{
    struct domain *d = s->domain;
    if (t->end - t->first < 2)
        return;
    const int m = t->first + (t->end - t->first) / 2, a = longest_axis(t, d->dim);
    const double share = (double)(m - t->first) / (t->end - t->first);
    const double at = evenly ? t->lo[a] + share * (t->hi[a] - t->lo[a]) : quantile(s, t, a, share);
    d->cuts[m - 1] =
        (struct domain_cut){a, evenly ? d->lo[a] + s->dx * round((at - d->lo[a]) / s->dx) : at};
    struct domain_node left = *t, right = *t;
    left.end = right.first = m;
    left.hi[a] = right.lo[a] = d->cuts[m - 1].at;
    left.n = split(t, d->cuts + m - 1);
    right.who = t->who + left.n;
    right.n = t->n - left.n;
    cut(s, &left, evenly);
    cut(s, &right, evenly);
}

/* The node of all ranks and the whole region. */
static struct domain_node root(const struct domain *d)
{
    struct domain_node t = {.end = d->size};
    memcpy(t.lo, d->lo, sizeof t.lo);
    memcpy(t.hi, d->hi, sizeof t.hi);
    return t;
}

struct domain *domain_create(struct sph *s)
{
    struct domain *d = NEW_IN(s, struct domain, 1);
    d->comm = s->run->comm;
    d->rank = s->run->rank;
    d->size = s->run->size;
    d->dim = s->dim;
    for (int a = 0; a < 3; a++) {
        d->periodic[a] = s->periodic[a];
        d->lo[a] = s->lo[a];
        d->hi[a] = s->hi[a];
    }
    d->cuts = NEW_IN(d, struct domain_cut, d->size);
    d->box = mem_new_in(d, (size_t)d->size, sizeof *d->box);
    s->domain = d;
    const struct domain_node t = root(d);
    if (s->coarser)
        memcpy(d->cuts, s->coarser->domain->cuts, (size_t)d->size * sizeof *d->cuts);
    else
        cut(s, &t, true);
    cuts_changed(s);
    return d;
}

/* Work of a particle in a step, in pairs, or with levels in eighths of a pair; a level with steps
 * of its own does 2^level of them in a step of the coarsest. 1 where the list does not belong to
 * the present state. */
static int work_of(const struct sph *s, int i)
{
    const struct neighbours *l = s->list;
    const bool deep = (s->p.role[i] & ROLE_DEEP) != 0;
    if (!s->lists.ready)
        return 1;
    if (!l->taken)
        return l->count[i] + WORK;
    const int work = (deep ? DEEP_PAIR : PAIR) * l->count[i] + PAIR * WORK +
                     (deep ? DEEP_TAKEN : TAKEN) * l->taken[i];
    return s->local_steps ? work << s->level : work;
}

/* Positions x[] and work[] of this rank's particles, level after level; returns the sum of the
 * work. */
static int64_t find_work(const struct sph *s, double (*x)[3], int *work)
{
    int64_t sum = 0;
    int k = 0;
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++, k++) {
            memcpy(x[k], state_row(&q->p, q->p.y, i), (size_t)q->dim * sizeof(double));
            work[k] = work_of(q, i);
            sum += work[k];
        }
    return sum;
}

/* Builds the whole tree anew from the positions and the work of this rank's n particles.
 * Collective. */
static void cut_anew(struct sph *s, int n, const double (*x)[3], const int *work)
{
    struct domain_node t = root(s->domain);
    t.n = n;
    t.x = x;
    t.work = work;
    t.who = NEW(int, n);
    for (int i = 0; i < n; i++)
        t.who[i] = i;
    cut(s, &t, false);
    mem_free(t.who);
    cuts_changed(s);
}

void domain_follow(struct sph *s)
{
    for (struct sph *q = s; q; q = q->finer) {
        memcpy(q->domain->lo, q->lo, sizeof q->domain->lo);
        memcpy(q->domain->hi, q->hi, sizeof q->domain->hi);
        make_boxes(q->domain);
    }
}

bool domain_balance(struct sph *s, double tolerance)
{
    struct domain *d = s->domain;
    int n = 0;
    if (d->size == 1)
        return false;
    for (const struct sph *q = s; q; q = q->finer)
        n += q->p.n;
    int *work = NEW(int, n);
    double(*x)[3] = mem_new((size_t)n, sizeof *x);
    const int64_t mine = find_work(s, x, work);
    const int64_t sum = ranks_count(d->comm, mine);
    int64_t most;
    MPI_Allreduce(&mine, &most, 1, MPI_INT64_T, MPI_MAX, d->comm);
    const bool uneven = (double)most * d->size > (1.0 + tolerance) * (double)sum;
    if (s->lists.ready && most > 0) {
        d->tau_sum += (double)sum / ((double)most * d->size);
        d->tau_n++;
    }
    if (uneven)
        cut_anew(s, n, (const double(*)[3])x, work);
    FREE(x, work);
    return uneven;
}

double domain_tau(const struct domain *d) { return d->tau_n > 0 ? d->tau_sum / d->tau_n : 1.0; }

/* Sends rows to the ranks owner[i] >= 0; returns the received ones, by sending rank, then as they
 * were. */
static double *send_rows(const struct domain *d, const double *rows, const int *owner, int n,
                         int width, int *nrecv)
{
    /* four arrays in one: what goes to each rank and where it begins, what comes from each and
     * where */
    int *count = NEW(int, 4 * d->size), *at = count + d->size, *rcount = at + d->size;
    int *rat = rcount + d->size, total = 0;
    for (int i = 0; i < n; i++)
        if (owner[i] >= 0)
            count[owner[i]] += width;
    for (int r = 1; r < d->size; r++)
        at[r] = at[r - 1] + count[r - 1];
    double *packed = NEW(double, at[d->size - 1] + count[d->size - 1]);
    for (int i = 0; i < n; i++)
        if (owner[i] >= 0) {
            memcpy(packed + at[owner[i]], rows + (size_t)i * width, (size_t)width * sizeof(double));
            at[owner[i]] += width;
        }
    MPI_Alltoall(count, 1, MPI_INT, rcount, 1, MPI_INT, d->comm);
    for (int r = 0; r < d->size; r++) {
        at[r] -= count[r];
        rat[r] = total;
        total += rcount[r];
    }
    double *got = NEW(double, total);
    MPI_Alltoallv(packed, count, at, MPI_DOUBLE, got, rcount, rat, MPI_DOUBLE, d->comm);
    *nrecv = total / width;
    FREE(packed, count);
    return got;
}

/* Brings positions along periodic axes back into [lo, hi). One that is not finite becomes lo, so
 * that it has a cell, and marks the momentum, which the next look at the state finds. */
static void wrap(struct sph *s)
{
    for (int a = 0; a < s->dim; a++) {
        const double lo = s->lo[a], hi = s->hi[a];
        for (int i = 0; s->periodic[a] && i < s->p.n; i++) {
            double *x = state_row(&s->p, s->p.y, i) + a;
            if (*x >= lo && *x < hi)
                continue;
            if (!isfinite(*x))
                x[s->dim] = NAN;
            *x -= (hi - lo) * floor((*x - lo) / (hi - lo));
            if (!(*x >= lo && *x < hi)) /* rounding at the seam */
                *x = lo;
        }
    }
}

/* A row on its way: state, then the bits of id, then zone and role, then what the trace of grad u
 * errs by; with levels slopes. */
static void pack_row(const struct particles *p, int i, double *row, bool slopes)
{
    memcpy(row, state_row(p, p->y, i), (size_t)p->nstate * sizeof(double));
    memcpy(row + p->nstate, p->id + i, sizeof(double));
    row[p->nstate + 1] = p->zone[i] + 256.0 * p->role[i];
    row[p->nstate + 2] = p->false_divergence[i];
    if (slopes)
        memcpy(row + p->nstate + 3, slope_line(p, i), (size_t)p->nslope * sizeof *row);
}

/* Appends a particle from what pack_row wrote on another rank. */
static void unpack_row(struct particles *p, const double *row, bool slopes)
{
    int64_t id;
    memcpy(&id, row + p->nstate, sizeof id);
    const int kind = (int)row[p->nstate + 1], i = particles_add(p, id, (enum sph_zone)(kind % 256));
    p->role[i] = (unsigned short)(kind / 256);
    p->false_divergence[i] = row[p->nstate + 2];
    memcpy(state_row(p, p->y, i), row, (size_t)p->nstate * sizeof(double));
    if (slopes)
        memcpy(slope_line(p, i), row + p->nstate + 3, (size_t)p->nslope * sizeof *row);
}

/* Stayers close ranks in their order, then come the arrivals by sending rank. Order and cells are
 * stale afterwards: neighbours_sort follows. */
void domain_migrate(struct sph *s)
{
    const struct domain *d = s->domain;
    struct particles *p = &s->p;
    const bool slopes = s->guards != NULL;
    const int width = p->nstate + 3 + (slopes ? p->nslope : 0), before = p->n;
    int nleave = 0, got = 0;
    wrap(s);
    p->nghost = 0;
    if (d->size == 1)
        return;
    int *owner = NEW(int, before);
    double *rows = NULL;
    for (int i = 0; i < before; i++) {
        /* overwritten by the next one unless it leaves */
        owner[nleave] = domain_owner(d, state_row(p, p->y, i));
        nleave += owner[nleave] != d->rank;
    }
    rows = NEW(double, (size_t)nleave *width);
    nleave = p->n = 0;
    for (int i = 0; i < before; i++) {
        if (domain_owner(d, state_row(p, p->y, i)) == d->rank)
            particles_copy(p, p->n++, i);
        else
            pack_row(p, i, rows + (size_t)nleave++ * width, slopes);
    }
    double *in = send_rows(d, rows, owner, nleave, width, &got);
    for (int k = 0; k < got; k++)
        unpack_row(p, in + (size_t)k * width, slopes);
    FREE(in, rows, owner);
}

/* Locals that another rank or image can need: closer than reach to a bounded side of this part. The
 * rest cannot be a ghost of anyone, and most particles are of that kind: peers look at these
 * alone. */
static int near_sides(const struct sph *s, double reach, int *who)
{
    const struct domain *d = s->domain;
    double lo[3], hi[3];
    int n = 0;
    for (int a = 0; a < s->dim; a++)
        reach_bounds(d, d->rank, a, lo + a, hi + a);
    for (int i = 0; i < s->p.n; i++) {
        const double *x = prim_line(&s->p, i);
        bool deep = true;
        for (int a = 0; a < s->dim; a++)
            deep = deep && x[a] - lo[a] > reach && hi[a] - x[a] > reach;
        if (!deep)
            who[n++] = i;
    }
    return n;
}

/* Appends particle i, seen as `image', to what peer q is sent. lines has room for the wider of the
 * two records. */
static void add_line(const struct domain *d, struct peer *q, int i, int image, int width)
{
    if (q->nsend == q->capacity) {
        const int more = 2 * q->capacity + 256;
        GROW_IN(d->peers, q->who, q->capacity, more);
        GROW_IN(d->peers, q->image, q->capacity, more);
        GROW_IN(d->peers, q->lines, (size_t)q->capacity * width, (size_t)more * width);
        q->capacity = more;
    }
    q->who[q->nsend] = i;
    q->image[q->nsend++] = (unsigned char)image;
}

/* Lists the particles whose image lies within reach of the peer's part. */
static void list_image(const struct sph *s, struct peer *q, int image, const double *shift,
                       double reach, const int *near, int nnear)
{
    const struct domain *d = s->domain;
    double lo[3], hi[3];
    for (int a = 0; a < s->dim; a++) {
        reach_bounds(d, q->rank, a, lo + a, hi + a);
        lo[a] -= shift[a];
        hi[a] -= shift[a];
    }
    for (int k = 0; k < nnear; k++) {
        const double *x = prim_line(&s->p, near[k]);
        double r2 = 0.0;
        for (int a = 0; a < s->dim; a++) {
            const double out = x[a] < lo[a] ? lo[a] - x[a] : x[a] > hi[a] ? x[a] - hi[a] : 0.0;
            r2 += out * out;
        }
        if (r2 <= reach * reach)
            add_line(d, q, near[k], image, s->p.nslope);
    }
}

/* Lists anew what goes to peer q: all images of this rank's particles within reach of its part. */
static void list_peer(const struct sph *s, struct peer *q, double reach, const int *near, int nnear)
{
    const struct domain *d = s->domain;
    double shift[3];
    q->nsend = 0;
    for (int k = 0; k < images(d); k++)
        if (!(q->rank == d->rank && is_self(d, k)) && image_shift(d, k, shift) &&
            boxes_touch(d, d->rank, q->rank, shift, reach))
            list_image(s, q, k, shift, reach, near, nnear);
}

/* Sends every peer the number of records it will get, and receives theirs. */
static void exchange_counts(struct domain *d)
{
    int n = 0;
    for (int k = 0; k < d->npeers; k++) {
        struct peer *q = d->peers + k;
        if (q->rank == d->rank) {
            q->nrecv = q->nsend;
            continue;
        }
        MPI_Irecv(&q->nrecv, 1, MPI_INT, q->rank, TAG_COUNT, d->comm, d->requests + n++);
        MPI_Isend(&q->nsend, 1, MPI_INT, q->rank, TAG_COUNT, d->comm, d->requests + n++);
    }
    MPI_Waitall(n, d->requests, MPI_STATUSES_IGNORE);
}

void domain_ghosts(struct sph *s)
{
    struct domain *d = s->domain;
    const double reach = s->R + s->lists.skin;
    int *near = NEW(int, s->p.n), first = s->p.n;
    const int nnear = near_sides(s, reach, near);
    for (int k = 0; k < d->npeers; k++)
        list_peer(s, d->peers + k, reach, near, nnear);
    mem_free(near);
    exchange_counts(d);
    for (int k = 0; k < d->npeers; k++) {
        d->peers[k].first = first;
        first += d->peers[k].nrecv;
    }
    s->p.nghost = s->p.nhalo = first - s->p.n;
    particles_reserve(&s->p, first);
    domain_halo_start(s, false);
    domain_halo_finish(s, false);
}

/* Copies the records of q's list to `out'; positions of images are shifted, gradients and
 * velocities are the same. */
static void pack(const struct sph *s, const struct peer *q, bool slopes, double *out)
{
    const int width = slopes ? s->p.nslope : PRIM;
    const double *lines = slopes ? s->p.slope : s->p.prim;
    for (int k = 0; k < q->nsend; k++, out += width) {
        memcpy(out, lines + (size_t)q->who[k] * width, (size_t)width * sizeof(double));
        if (slopes || is_self(s->domain, q->image[k]))
            continue;
        double shift[3];
        image_shift(s->domain, q->image[k], shift);
        for (int a = 0; a < s->dim; a++)
            out[a] += shift[a];
    }
}

/* A peer's ghosts are one block of lines, so messages arrive in place. Those of this rank itself
 * are packed straight to where they belong. */
void domain_halo_start(struct sph *s, bool slopes)
{
    struct domain *d = s->domain;
    const int width = slopes ? s->p.nslope : PRIM;
    double *lines = slopes ? s->p.slope : s->p.prim;
    d->nrequests = 0;
    for (int k = 0; k < d->npeers; k++) {
        const struct peer *q = d->peers + k;
        if (q->rank != d->rank && q->nrecv > 0)
            MPI_Irecv(lines + (size_t)q->first * width, q->nrecv * width, MPI_DOUBLE, q->rank,
                      TAG_LINES, d->comm, d->requests + d->nrequests++);
    }
    for (int k = 0; k < d->npeers; k++) {
        const struct peer *q = d->peers + k;
        pack(s, q, slopes, q->rank == d->rank ? lines + (size_t)q->first * width : q->lines);
        if (q->rank != d->rank && q->nsend > 0)
            MPI_Isend(q->lines, q->nsend * width, MPI_DOUBLE, q->rank, TAG_LINES, d->comm,
                      d->requests + d->nrequests++);
    }
}

void domain_halo_finish(struct sph *s, bool slopes)
{
    (void)slopes;
    MPI_Waitall(s->domain->nrequests, s->domain->requests, MPI_STATUSES_IGNORE);
    s->domain->nrequests = 0;
}

/* Blocking, and with this rank's own images copied directly; records are sent as they are,
 * unshifted. */
void domain_share(struct sph *s, const double *rows, int width, double *ghosts)
{
    struct domain *d = s->domain;
    int n = 0;
    require(width <= s->p.nslope); /* room of a peer's lines */
    for (int k = 0; k < d->npeers; k++) {
        const struct peer *q = d->peers + k;
        const bool self = q->rank == d->rank;
        double *in = ghosts + (size_t)(q->first - s->p.n) * width, *out = self ? in : q->lines;
        if (!self && q->nrecv > 0)
            MPI_Irecv(in, q->nrecv * width, MPI_DOUBLE, q->rank, TAG_LINES, d->comm,
                      d->requests + n++);
        for (int m = 0; m < q->nsend; m++)
            memcpy(out + (size_t)m * width, rows + (size_t)q->who[m] * width,
                   (size_t)width * sizeof(double));
        if (!self && q->nsend > 0)
            MPI_Isend(out, q->nsend * width, MPI_DOUBLE, q->rank, TAG_LINES, d->comm,
                      d->requests + n++);
    }
    MPI_Waitall(n, d->requests, MPI_STATUSES_IGNORE);
}

void domain_save(const struct sph *s, struct h5 *f)
{
    const struct domain *d = s->domain;
    const int n = d->rank == 0 ? d->size : 0;
    double *rows = NEW(double, 2 * d->size); /* one spare row: never empty */
    for (int k = 0; k < d->size - 1; k++) {
        rows[2 * k] = d->cuts[k].axis;
        rows[2 * k + 1] = d->cuts[k].at;
    }
    h5_write_real(f, "cuts", "-", n, 2, rows, false);
    mem_free(rows);
}

/* Those of another number of ranks say nothing: cuts by the particles at hand. */
bool domain_load(struct sph *s, struct h5 *f)
{
    struct domain *d = s->domain;
    int64_t n;
    double *rows = h5_read_all_real(f, "cuts", 2, &n);
    if (rows && n == d->size) {
        for (int k = 0; k < d->size - 1; k++)
            d->cuts[k] = (struct domain_cut){(int)rows[2 * k], rows[2 * k + 1]};
        cuts_changed(s);
    } else if (rows) {
        s->lists.ready = false;
        domain_balance(s, -1.0);
    }
    mem_free(rows);
    return rows != NULL;
}

/* map_deal.c - the conservative direction: sources deal out what they have. Every rank of the
 * coupler goes through all sources in the order of their gid and keeps what falls to its own
 * targets: the same bits on any number of ranks. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/base/base.h"
#include "near.h"

struct deal {
    enum map_dealing how;
    int dim, ncomp;
    double R;
    struct map_cloud target; /* with periodic images; v: place in the caller's list */
    const struct map_cloud *source;
    long first, last;
    double *v;
    double *w; /* scratch */
};

/* Of all points of a cloud, m. */
static void box_of(const struct map_cloud *c, int dim, double lo[3], double hi[3])
{
    for (int d = 0; d < dim; d++) {
        lo[d] = INFINITY;
        hi[d] = -INFINITY;
        for (long i = 0; i < c->n; i++) {
            lo[d] = fmin(lo[d], c->x[i * dim + d]);
            hi[d] = fmax(hi[d], c->x[i * dim + d]);
        }
    }
}

/* Target i moved by whole periods, if that is within R of the box of the sources. */
static void add_image(struct map_cloud *to, const struct map_cloud *from, int dim, long i,
                      const double move[3], double R, const double lo[3], const double hi[3])
{
    double y[3] = {0};
    for (int d = 0; d < dim; d++) {
        y[d] = from->x[i * dim + d] + move[d];
        if (!(y[d] >= lo[d] - R && y[d] <= hi[d] + R))
            return;
    }
    map_cloud_room(to, dim, 1, to->n + 1);
    memcpy(to->x + to->n * dim, y, (size_t)dim * sizeof *y);
    to->gid[to->n] = from->gid[i];
    to->volume[to->n] = from->volume[i];
    to->v[to->n++] = (double)i;
}

/* box_of the sources bounds which images can matter. Sorted by gid: sums then run in an order of
 * their own. */
static struct map_cloud images(const struct map_cloud *from, const struct map_cloud *source,
                               int dim, double R, const double period[3])
{
    struct map_cloud to = {0};
    double lo[3], hi[3], move[3];
    int most[3], k[3];
    box_of(source, dim, lo, hi);
    for (int d = 0; d < 3; d++)
        most[d] = d < dim && period[d] > 0.0;
    for (long i = 0; i < from->n; i++)
        for (k[2] = -most[2]; k[2] <= most[2]; k[2]++)
            for (k[1] = -most[1]; k[1] <= most[1]; k[1]++)
                for (k[0] = -most[0]; k[0] <= most[0]; k[0]++) {
                    for (int d = 0; d < 3; d++)
                        move[d] = k[d] ? k[d] * period[d] : 0.0;
                    add_image(&to, from, dim, i, move, R, lo, hi);
                }
    near_sort(&to, dim, 1);
    return to;
}

static bool is_mine(const struct deal *a, int j)
{
    return a->target.v[j] >= (double)a->first && a->target.v[j] < (double)a->last;
}

/* False: nobody in reach, or all of them too far off to weigh anything. One source: weights of the
 * targets in reach, as if these were mapped to it, then its value shared out by them. far: nothing
 * was in R, the nearest takes all. */
static bool deal_one(struct deal *a, const struct reach *r, long source, bool far)
{
    const double *x = a->source->x + source * a->dim, *s = a->source->v + source * a->ncomp;
    bool mine = false;
    if (r->n == 0)
        return false;
    for (int k = 0; k < r->n; k++)
        mine = mine || is_mine(a, r->j[k]);
    ROOM_IN(NULL, a->w, r->n);
    if (far || a->how == MAP_DEAL_NEAREST) { /* one takes all */
        memset(a->w, 0, (size_t)r->n * sizeof *a->w);
        a->w[reach_nearest(a->dim, r, &a->target, x)] = 1.0;
    } else if (!map_weights(a->dim, a->R, a->how == MAP_DEAL_MLS, r, &a->target, x, a->w))
        return false;
    for (int k = 0; k < r->n && mine; k++)
        if (is_mine(a, r->j[k])) {
            double *v = a->v + ((long)a->target.v[r->j[k]] - a->first) * a->ncomp;
            for (int c = 0; c < a->ncomp; c++)
                v[c] += a->w[k] * s[c];
        }
    return true;
}

/* A source after the other; those that nobody took stay in `left' for a wider look. Cells are made
 * for the reach R of this round. */
static long deal_within(struct deal *a, const struct map_cloud *target, double R, bool far,
                        const double period[3], long n, long *left)
{
    long still = 0;
    a->target = images(target, a->source, a->dim, R, period);
    struct near *g = near_create(a->dim, R, &a->target, a->source->n, a->source->x);
    for (long i = 0; i < n; i++)
        if (!deal_one(a, near_gather(g, a->source->x + left[i] * a->dim), left[i], far))
            left[still++] = left[i];
    mem_free(g);
    map_cloud_free(&a->target);
    return still;
}

/* The search doubles its reach until every source has found a target: only a few are left after the
 * first round, since targets lie where sources do. */
void map_deal(enum map_dealing how, int dim, double R, int ncomp, const double period[3],
              const struct map_cloud *target, struct map_cloud *source, long first, long last,
              double *v)
{
    struct deal a = {.how = how, .dim = dim, .ncomp = ncomp, .R = R, .first = first, .last = last};
    a.v = v;
    memset(v, 0, (size_t)((last - first) * ncomp) * sizeof *v);
    if (target->n == 0 || source->n == 0)
        return;
    near_sort(source, dim, ncomp);
    a.source = source;
    long *left = NEW(long, source->n), n = source->n;
    for (long i = 0; i < n; i++)
        left[i] = i;
    n = deal_within(&a, target, R, false, period, n, left);
    for (double wide = 2.0 * R; n > 0 && isfinite(wide); wide *= 2.0)
        n = deal_within(&a, target, wide, true, period, n, left);
    FREE(left, a.w);
}

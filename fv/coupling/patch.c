/* patch.c - the uniform grid of cell averages that a partner gets. On fv.cells it is the grid
 * itself; where a partner may come to unequal layers, equal ones that are made of them by cubics
 * (blend); on blocks a box around the partners whose averages are interpolated (mesh_exchange with
 * weights). Each rank has some of its cells; cpl.h distributes them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "patch.h"

enum { MARGIN = 4 }; /* cells around the box: a cubic's and one for rounding */

/* Boxes of partners, as patch_create gets them. */
struct partners {
    int n;
    const double (*box)[2][3], (*inner)[2][3];
};

/* The four layers around the middle of a layer of the patch, and their weights; weights below 1e-9
 * are rounding. */
static struct blend blend_rows(const struct block *b, double from, double to)
{
    const double *edge = b->rows->edge, middle = 0.5 * (from + to);
    const int n = b->cells[1];
    struct blend x;
    int j = 0;
    while (j < n - 1 && middle >= edge[j + 1])
        j++;
    j -= middle < 0.5 * (edge[j] + edge[j + 1]) ? 2 : 1;
    j = j < 0 ? 0 : j > n - 4 ? n - 4 : j;
    rows_average(edge + j, from, to, x.w);
    for (int m = 0; m < 4; m++)
        x.w[m] = fabs(x.w[m]) < 1e-9 ? 0.0 : x.w[m];
    x.row = j - b->lo[1];
    return x;
}

/* Equal layers go on to the domain's bottom: this rank's are those with their middle in its own. */
static void blend_grid(void *owner, const struct block *b, struct patch *p)
{
    const struct rows *r = b->rows;
    const double h = b->h[1], bottom = r->edge[0], top = r->edge[r->even];
    const double least = r->edge[b->lo[1]], most = r->edge[b->lo[1] + b->n[1]];
    const int below = (int)ceil((top - bottom) / h - 1e-9), all = below + b->cells[1] - r->even;
    int first = 0, n = 0;
    p->origin[1] = top - below * h;
    p->cells[1] = all;
    p->first = p->below = 0;
    for (int j = 0; j < all; j++) {
        const double middle = p->origin[1] + (j + 0.5) * h;
        first += middle < least && b->lo[1] > 0;
        n += (middle >= least || b->lo[1] == 0) &&
             (middle < most || b->lo[1] + b->n[1] == b->cells[1]);
    }
    p->of.lo[1] = first;
    p->of.n[1] = n;
    p->blend = mem_new_in(owner, (size_t)n + 1, sizeof *p->blend);
    for (int j = 0; j < n; j++)
        p->blend[j] =
            blend_rows(b, p->origin[1] + (first + j) * h, p->origin[1] + (first + j + 1) * h);
}

/* Without unequal layers below it. */
static void of_grid(const struct fv *s, struct patch *p)
{
    const struct block *b = &s->b;
    p->of = layout_block(b);
    p->of.g[0] = p->of.g[1] = p->of.g[2] = 0;
    if (b->rows) {
        p->below = b->rows->even;
        p->first = p->below - b->lo[1];
        p->first = p->first < 0 ? 0 : p->first > b->n[1] ? b->n[1] : p->first;
        p->of.lo[1] += p->first;
        p->of.n[1] -= p->first;
    }
    for (int a = 0; a < 3; a++) {
        const int below = a == 1 && b->rows ? b->rows->even : 0;
        p->origin[a] = below > 0 ? b->rows->edge[below] : b->origin[a];
        p->h[a] = b->h[a];
        p->cells[a] = b->cells[a] - below;
        p->periodic[a] = b->periodic[a];
    }
}

/* Whether what the partner looks at from y = lo m on are even rows. A partner looks two cells
 * beyond its box. */
static bool in_even_rows(const struct fv *s, double lo)
{
    const struct rows *r = s->b.rows;
    return lo >= r->edge[r->even] + (2.0 - 1e-9) * s->b.h[1];
}

/* The block with the smallest cells at the middle of the box, and their size; -1: none. */
static int finest(const struct mesh *m, const struct overset *o, const double *x, double *h)
{
    double least = INFINITY;
    int best = -1;
    for (int k = 0; k < m->nblocks; k++) {
        int cell[3];
        double xi[3];
        if (!overset_locate(m, o, k, x, cell, xi))
            continue;
        const double v = m->block[k].volume[mesh_cell(m->block + k, cell)];
        if (v < least) {
            least = v;
            best = k;
        }
    }
    *h = best < 0 ? 0.0 : pow(least, 1.0 / m->dim);
    return best;
}

/* The same over the places of a raster within lo and hi. 9 positions along each axis. */
static int finest_within(const struct fv *s, const struct overset *o, const double *lo,
                         const double *hi, double *h)
{
    enum { PLACES = 9 }; /* along an axis */
    int best = -1;
    for (int i = 0; i < (s->dim == 3 ? PLACES : 1) * PLACES * PLACES; i++) {
        const int at[3] = {i % PLACES, i / PLACES % PLACES, i / PLACES / PLACES};
        double x[3] = {0.0, 0.0, 0.0}, here;
        for (int a = 0; a < s->dim; a++)
            x[a] = lo[a] + (at[a] + 0.5) / PLACES * (hi[a] - lo[a]);
        const int k = finest(s->m, o, x, &here);
        if (k >= 0 && (best < 0 || here < *h)) {
            best = k;
            *h = here;
        }
    }
    return best;
}

/* The same where the boxes stand, by their middles unless walls cut those off, or over all places
 * that they may come to. */
static int finest_at(const struct fv *s, const struct overset *o, const struct partners *by,
                     double *h)
{
    const struct scene_domain *d = &s->run->scene.domain;
    int best = -1;
    for (int q = 0; q < by->n; q++) {
        const double *lo = by->box[q][0], *hi = by->box[q][1];
        double from[3], to[3], here;
        for (int a = 0; a < 3; a++) {
            const bool moves = s->m->search && s->partners.moves[a];
            from[a] = moves ? d->min[a] : 0.5 * (lo[a] + hi[a]);
            to[a] = moves ? d->max[a] : 0.5 * (lo[a] + hi[a]);
        }
        int k = finest_within(s, o, from, to, &here);
        k = k >= 0 ? k : finest_within(s, o, lo, hi, &here);
        if (k >= 0 && (best < 0 || here < *h)) {
            best = k;
            *h = here;
        }
    }
    return best;
}

static bool is_plain(const struct mesh_block *b)
{
    return b->prm->mapping == MAPPING_BOX && b->prm->angle == 0.0;
}

/* Cells along axis a: those of a plain block go on beyond it; others as large as h about. The
 * domain's walls bound them, a period that the box spans is theirs. b NULL: no plain block. */
static void set_axis(const struct fv *s, const struct mesh_block *b, int a, double lo, double hi,
                     double h, struct patch *p)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double min = d->min[a], max = d->max[a], L = max - min, eps = 1e-9 * L;
    double from = b ? b->prm->min[a] : lo;
    p->h[a] = b ? (b->prm->max[a] - from) / b->n[a] : h;
    if (d->periodic[a] && hi - lo >= L - eps) {
        p->cells[a] = (int)llround(L / p->h[a]);
        p->h[a] = L / p->cells[a];
        p->origin[a] = min;
        p->periodic[a] = true;
        return;
    }
    from += p->h[a] * (floor((lo - from) / p->h[a] + 1e-9) - MARGIN);
    double to = from + p->h[a] * ceil((hi - from) / p->h[a] + MARGIN - 1e-9);
    if (!d->periodic[a] && (from < min - eps || to > max + eps)) {
        from = from < min - eps ? min : from;
        to = to > max + eps ? max : to;
        p->cells[a] = (int)fmax(1.0, round((to - from) / p->h[a]));
        p->h[a] = (to - from) / p->cells[a];
    } else
        p->cells[a] = (int)llround((to - from) / p->h[a]);
    p->origin[a] = from;
}

/* This rank's slab, along the last axis. Slabs of about equal height. */
static void share(const struct fv *s, struct patch *p)
{
    const int a = p->dim - 1, n = p->cells[a];
    for (int e = 0; e < 3; e++)
        p->of.n[e] = p->cells[e];
    p->of.lo[a] = (int)((int64_t)n * s->run->rank / s->run->size);
    p->of.n[a] = (int)((int64_t)n * (s->run->rank + 1) / s->run->size) - p->of.lo[a];
}

/* Whether the partner may look at a cell: it does not deep in its own part, which ends nowhere at
 * the domain's sides. inner: what the partner gives; two cells in it are still looked at. */
static bool is_wanted_by(const struct fv *s, const struct patch *p, const double *place,
                         const double (*box)[3], const double (*inner)[3])
{
    const double *lo = box[0], *hi = box[1];
    bool around = true, deep = true;
    for (int a = 0; a < p->dim; a++) {
        const struct scene_domain *d = &s->run->scene.domain;
        const double h = p->h[a], L = d->max[a] - d->min[a];
        const double x =
            p->periodic[a] ? place[a] + L * ceil((lo[a] - 2.0 * h - place[a]) / L) : place[a];
        around = around && x > lo[a] - 2.0 * h && x < hi[a] + 2.0 * h;
        deep = deep && (x > inner[0][a] + 2.0 * h || inner[0][a] < d->min[a] + 1e-6 * h) &&
               (x < inner[1][a] - 2.0 * h || inner[1][a] > d->max[a] - 1e-6 * h);
    }
    return around && !deep;
}

/* By any of the partners. */
static bool is_wanted(const struct fv *s, const struct patch *p, const double *place,
                      const struct partners *by)
{
    bool wanted = false;
    for (int q = 0; q < by->n && !wanted; q++)
        wanted = is_wanted_by(s, p, place, by->box[q], by->inner[q]);
    return wanted;
}

/* Donors of this rank's cells; false: one that is wanted has none, at `where'. Behind walls values
 * are extrapolated by a cell at most. */
static bool find_donors(const struct fv *s, struct overset *o, struct patch *p,
                        const struct partners *by, double *where)
{
    struct mesh_request *request = mem_new((size_t)p->n + 1, sizeof *request);
    struct block_walls *walls = block_walls_create(s->m);
    double *weight = NEW(double, 64 * p->n);
    int64_t n = 0;
    bool good = true;
    for (int64_t i = 0; i < p->n; i++) {
        double x[3];
        patch_centre(p, i, x);
        struct nearest_wall wall;
        double *const w = weight + 64 * n;
        bool known = overset_sample(s->m, o, x, p->h, request + n, w);
        const bool behind = !known && block_walls_nearest(walls, x, &wall) && wall.height < 0.0;
        if (behind)
            known = overset_sample_beyond(s->m, wall.block, wall.cell, x, request + n, w);
        else if (!known && good && is_wanted(s, p, x, by)) {
            good = false;
            memcpy(where, x, sizeof x);
        }
        if (known)
            request[n++].in = i;
    }
    mesh_exchange_create(s->link, s->m, &p->sample, 4, n, request);
    FREE(walls, request, weight);
    return good;
}

/* Cells as large as h about, or those of the plain block k: in the box, along axes on which it
 * moves in the whole domain. */
static void make_grid(const struct fv *s, int k, const double *lo, const double *hi, double h,
                      struct patch *p)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const struct mesh_block *b = is_plain(s->m->block + k) ? s->m->block + k : NULL;
    for (int a = 0; a < 3; a++) {
        p->cells[a] = 1;
        p->h[a] = 1.0;
        if (a < s->dim && s->partners.moves[a])
            set_axis(s, b, a, d->min[a], d->max[a], h, p);
        else if (a < s->dim)
            set_axis(s, b, a, lo[a], hi[a], h, p);
    }
    share(s, p);
    p->n = (int64_t)p->of.n[0] * p->of.n[1] * p->of.n[2];
}

/* The box around all of them. */
static void find_hull(const struct partners *by, double lo[3], double hi[3])
{
    for (int a = 0; a < 3; a++) {
        lo[a] = INFINITY;
        hi[a] = -INFINITY;
        for (int q = 0; q < by->n; q++) {
            lo[a] = fmin(lo[a], by->box[q][0][a]);
            hi[a] = fmax(hi[a], by->box[q][1][a]);
        }
    }
}

/* As find_donors, on all ranks alike: false, and the place, if it is on one of them. Collective. */
static bool all_find_donors(const struct fv *s, struct overset *o, struct patch *p,
                            const struct partners *by, double where[3])
{
    const bool found = find_donors(s, o, p, by, where);
    return !ranks_first(s->comm, !found, where, 3 * sizeof *where);
}

/* where starts as the middle of all boxes, in case no block has it. */
static bool create_on_blocks(const struct fv *s, const struct partners *by, struct patch *p,
                             double *where)
{
    struct overset *o = s->m->search ? s->m->search : overset_search(s->run, s->m);
    double h, lo[3], hi[3];
    find_hull(by, lo, hi);
    for (int a = 0; a < s->dim; a++)
        where[a] = 0.5 * (lo[a] + hi[a]);
    const int k = finest_at(s, o, by, &h);
    if (k >= 0)
        make_grid(s, k, lo, hi, h, p);
    const bool good = k >= 0 && all_find_donors(s, o, p, by, where);
    if (!s->m->search)
        FREE(o);
    return good;
}

/* Layers are blended only if a box can come to unequal ones. */
bool patch_create(const struct fv *s, int n, const double (*box)[2][3], const double (*inner)[2][3],
                  struct patch *p, double *where)
{
    const struct partners by = {n, box, inner};
    double lo[3], hi[3];
    *p = (struct patch){.dim = s->dim};
    if (s->m)
        return create_on_blocks(s, &by, p, where);
    of_grid(s, p);
    find_hull(&by, lo, hi);
    if (s->b.rows && box && (s->partners.moves[1] || !in_even_rows(s, lo[1])))
        blend_grid(s->link, &s->b, p);
    p->n = (int64_t)p->of.n[0] * p->of.n[1] * p->of.n[2];
    return true;
}

/* The grid stays, its donors are those of blocks cut anew. */
bool patch_renew(const struct fv *s, int n, const double (*box)[2][3], const double (*inner)[2][3],
                 struct patch *p, double *where)
{
    const struct partners by = {n, box, inner};
    mesh_exchange_free(&p->sample);
    return all_find_donors(s, s->m->search, p, &by, where);
}

/* x of cells beyond dim is 0. */
void patch_centre(const struct patch *p, int64_t i, double *x)
{
    const int at[3] = {(int)(i % p->of.n[0]), (int)(i / p->of.n[0] % p->of.n[1]),
                       (int)(i / p->of.n[0] / p->of.n[1])};
    for (int a = 0; a < 3; a++)
        x[a] = a < p->dim
                   ? p->origin[a] + (p->of.lo[a] - (a == 1 ? p->below : 0) + at[a] + 0.5) * p->h[a]
                   : 0.0;
}

/* Sums of four layers at most; those with weight 0 are not read, for they may not exist. */
static void look_at_rows(const struct fv *s, const struct patch *p, double *f, double *to)
{
    const struct block *b = &s->b;
    const int64_t up = b->stride[1];
    block_halo(b, 1, &f);
    for (int k = 0; k < p->of.n[2]; k++)
        for (int j = 0; j < p->of.n[1]; j++) {
            const struct blend *x = p->blend + j;
            const double *at = f + block_at(b, 0, x->row, k);
            for (int i = 0; i < p->of.n[0]; i++, at++) {
                double sum = 0.0;
                for (int m = 0; m < 4; m++)
                    sum += x->w[m] != 0.0 ? x->w[m] * at[m * up] : 0.0;
                *to++ = sum;
            }
        }
}

/* From cells of whatever kind to averages of the patch. */
void patch_look(const struct fv *s, struct patch *p, double *f, double *to)
{
    if (s->m)
        mesh_exchange_to(s->m, &p->sample, 1, &f, &to);
    else if (p->blend)
        look_at_rows(s, p, f, to);
    else
        block_pack_from(&s->b, p->first, f, to);
}

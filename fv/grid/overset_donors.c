/* overset_donors.c - donors of the fringe: computed cells only, of the block with the smallest cell
 * there: no chains. Cubic where all 4^dim cells are computed, else linear from 2^dim. At the start
 * every rank finds the donors of all fringe cells (find_donors, to report orphans); the exchange
 * then takes its own. After a move each rank finds those of its own cells only (overset_find).
 * Weights are averages over Gauss points of the receiving cell, so that averages become averages.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "mesh_motion.h"
#include "overset_inside.h"

/* Places of the centre and of Gauss points of a cell in the donor's indices. shift: what x lacks to
 * the donor block, periods included; places[3 g], g = 0 the centre. false: a point does not lie in
 * the map. */
static bool gauss_places(const struct mesh *m, const struct donor *d, const double *shift,
                         const double *xi, double *places)
{
    static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};
    for (int g = 0; g <= 1 << m->dim; g++) {
        double at[3] = {0.5, 0.5, 0.5}, x[3], dx[3][3], *to = places + 3 * g;
        for (int a = 0; a < m->dim && g > 0; a++)
            at[a] = gauss[(g - 1) >> a & 1];
        mesh_map_point(m->block + d->block, m->dim, d->cell, at, x, dx);
        for (int c = 0; c < 3; c++) {
            x[c] += shift[c];
            to[c] = xi[c];
        }
        mesh_motion_made(m->block + d->from_block, x, x);
        if (!overset_invert(m->block[d->from_block].made, m->dim, d->at, x, to))
            return false;
    }
    return true;
}

/* Between blocks at rest the weights of the last search hold, if the stencil is the same. Saves
 * Newton's iterations for the Gauss points; *d becomes the old donor. */
static bool is_last(const struct mesh *m, const struct overset *o, struct donor *d, const int *from,
                    int width)
{
    const struct mesh_block *b = m->block + d->block;
    if (width != 4 || !o->last[d->block] || b->motion || m->block[d->from_block].motion)
        return false;
    const int at = o->last[d->block][mesh_cell(b, d->cell)] - 1;
    if (at < 0 || at >= o->n_old)
        return false;
    const struct donor *e = o->old + at;
    for (int a = 0; a < m->dim; a++)
        if (e->at[a] != d->at[a] || e->from[a] != from[a])
            return false;
    if (e->from_block != d->from_block || e->width != width)
        return false;
    *d = *e;
    return true;
}

/* Replaces *d if block q has the cells and its cell is smaller than *volume. rows_only: linear
 * weights alone, for the matrix. */
static bool try_donor(const struct mesh *m, const struct overset *o, int q, int width,
                      const double *x, struct donor *d, double *volume)
{
    double xi[3], places[3 * 9], shift[3], y[3], dx[3][3];
    int cell[3], from[3];
    if (q == d->block || !overset_locate(m, o, q, x, cell, xi) ||
        !overset_stencil(m, q, cell, xi, width, OF_COMPUTED, from))
        return false;
    const double v = m->block[q].volume[mesh_cell(m->block + q, cell)];
    if (v >= *volume)
        return false;
    struct donor e = *d;
    memcpy(e.at, cell, sizeof e.at);
    e.from_block = q;
    if (is_last(m, o, &e, from, width)) {
        *volume = v;
        *d = e;
        return true;
    }
    mesh_map_point(m->block + q, m->dim, cell, xi, y, dx);
    for (int c = 0; c < 3; c++)
        shift[c] = y[c] - x[c];
    memcpy(places, xi, sizeof xi);
    if (!o->rows_only && !gauss_places(m, &e, shift, xi, places))
        return false;
    const int n = (1 << m->dim) + 1;
    if (!o->rows_only && !overset_weights(m, q, cell, places, n, width, e.from, e.weight))
        return false;
    if (!overset_weights(m, q, cell, places, 1, 2, e.linear_from, e.linear))
        return false;
    e.width = width;
    *volume = v;
    *d = e;
    return true;
}

/* Cubic donors of all blocks first, linear ones only if there are none; appends to o->donor. false:
 * an orphan. */
static bool find_donor(const struct mesh *m, struct overset *o, int k, int64_t c, int64_t *linear)
{
    const double *x = m->block[k].centre[c];
    struct donor d = {.block = k};
    double volume = INFINITY;
    mesh_index(m->block + k, c, d.cell);
    for (int q = 0; q < m->nblocks; q++)
        try_donor(m, o, q, 4, x, &d, &volume);
    if (volume == INFINITY) {
        for (int q = 0; q < m->nblocks; q++)
            try_donor(m, o, q, 2, x, &d, &volume);
        if (volume == INFINITY)
            return false;
        if (!o->rows_only)
            overset_widen(m, &d);
        (*linear)++;
    }
    if (o->n == o->room)
        GROW_IN(o, o->donor, o->n, o->room = 2 * o->room + 256);
    o->donor[o->n++] = d;
    return true;
}

/* Corners of the other blocks that are boxes: one without min and max is a unit cube. */
static void other_corners(const struct mesh *m, int k, char *text, size_t size)
{
    *text = '\0';
    for (int q = 0; q < m->nblocks; q++) {
        const struct mesh_block_params *b = m->block[q].prm;
        if (q != k && b->mapping != MAPPING_ANNULUS && b->mapping != MAPPING_FILE)
            text_add(text, size, "; %s has min (%g, %g) and max (%g, %g)", b->name, b->min[0],
                     b->min[1], b->max[0], b->max[1]);
    }
}

/* One fault for each block with orphans, naming the first. */
static bool find_donors(const struct run *r, struct faults *f, struct mesh *m, struct overset *o)
{
    bool all = true;
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        int64_t orphans = 0, first = 0;
        for (int64_t c = 0; c < mesh_count(b); c++) {
            if (b->status[c] != CELL_FRINGE)
                continue;
            if (!find_donor(m, o, k, c, &m->linear) && orphans++ == 0)
                first = c;
        }
        if (orphans == 0)
            continue;
        int i[3];
        char corners[400];
        mesh_index(b, first, i);
        other_corners(m, k, corners, sizeof corners);
        const double *x = b->centre[first];
        mesh_fault(
            r, f, b->prm, "name",
            "%lld orphan cells, the first (%d, %d, %d) at (%g, %g, %g) m: no other block has "
            "computed cells around it. Let the blocks overlap by at least 8 cells, or give "
            "its sides a kind%s",
            (long long)orphans, i[0], i[1], i[2], x[0], x[1], x[2], corners);
        all = false;
    }
    return all;
}

/* Imposed cells are marked before the cut, trimmed after it. Without overlaps the struct is
 * empty. */
struct overset *overset_create(const struct run *r, struct faults *f, struct mesh *m)
{
    bool overlap = false;
    for (int k = 0; k < m->nblocks; k++)
        for (int s = 0; s < 2 * m->dim; s++)
            overlap = overlap || m->block[k].side[s] == MESH_OVERLAP;
    m->has_fringe = overlap;
    mesh_given_mark(m);
    struct overset *o = overlap ? overset_search(r, m) : NEW(struct overset, 1);
    if (overlap)
        overset_cut(m, o);
    mesh_given_trim(m);
    overset_count(m);
    if (overlap && !find_donors(r, f, m, o))
        DROP(o);
    return o;
}

/* This rank's fringe cells ask the ranks that have their donors' stencils. Collective. */
static void make_exchange(struct mesh *m, const struct overset *o, struct mesh_exchange *x)
{
    struct mesh_request *request = NEW(struct mesh_request, o->n);
    int64_t n = 0;
    mesh_exchange_free(x);
    for (int64_t k = 0; k < o->n; k++) {
        const struct donor *d = o->donor + k;
        int rank;
        int64_t place;
        mesh_owner(m, d->block, d->cell, &rank, &place);
        if (rank != m->rank)
            continue;
        struct mesh_request *q = request + n++;
        *q = (struct mesh_request){.in = place, .block = d->from_block, .weight = d->weight};
        q->out = overset_place(m, d, &q->rank);
    }
    mesh_exchange_create(m, m, x, 4, n, request);
    mem_free(request);
}

/* Makes the fringe's rows of the pressure matrix: linear interpolation, see struct mesh_fringe. */
static void set_fringes(struct mesh *m, const struct overset *o)
{
    mem_free(m->fringes);
    m->fringes = NEW_IN(m, struct mesh_fringe, o->n);
    m->nfringe = 0;
    for (int64_t k = 0; k < o->n; k++) {
        const struct donor *d = o->donor + k;
        int rank;
        int64_t place;
        mesh_owner(m, d->block, d->cell, &rank, &place);
        if (rank != m->rank)
            continue;
        struct mesh_fringe *e = m->fringes + m->nfringe++;
        *e = (struct mesh_fringe){.place = place, .block = d->block, .donor = d->from_block};
        memcpy(e->cell, d->cell, sizeof e->cell);
        memcpy(e->from, d->linear_from, sizeof e->from);
        memcpy(e->weight, d->linear, sizeof e->weight);
    }
}

void overset_exchange(struct mesh *m, const struct overset *o)
{
    make_exchange(m, o, &m->fringe);
    set_fringes(m, o);
}

/* Whether this rank has the cell. */
static bool is_mine(const struct mesh *m, int k, const int *cell)
{
    const struct mesh_block *b = m->block + k;
    return cell[b->cut] >= b->first[m->rank] && cell[b->cut] < b->first[m->rank + 1];
}

/* The donors found become those of the last search. last[block][cell] is one more than the place in
 * old; the arrays swap roles. */
static void keep_last(struct mesh *m, struct overset *o)
{
    struct donor *const spare = o->old;
    const int64_t room = o->room_old;
    for (int64_t k = 0; k < o->n_old; k++)
        o->last[spare[k].block][mesh_cell(m->block + spare[k].block, spare[k].cell)] = 0;
    o->old = o->donor;
    o->room_old = o->room;
    o->n_old = o->n;
    o->donor = spare;
    o->room = room;
    o->n = 0;
    for (int k = 0; k < m->nblocks; k++)
        if (!o->last[k])
            o->last[k] = NEW_IN(o, int, mesh_count(m->block + k));
    for (int64_t k = 0; k < o->n_old; k++)
        o->last[o->old[k].block][mesh_cell(m->block + o->old[k].block, o->old[k].cell)] =
            (int)k + 1;
}

/* The first one of a search, in m->trouble: the step is refused by all ranks later. */
static void report_orphan(struct mesh *m, int k, int64_t c)
{
    const struct mesh_block *b = m->block + k;
    const double *x = b->centre[c];
    int i[3];
    mesh_index(b, c, i);
    snprintf(m->trouble, sizeof m->trouble,
             "cell (%d, %d, %d) of block \"%s\" at (%g, %g, %g) m has no donors any more: no other "
             "block has computed cells around it",
             i[0], i[1], i[2], b->prm->name, x[0], x[1], x[2]);
}

/* Donors of this rank's fringe cells, or of those that `wanted' marks. */
static void find_again(struct mesh *m, struct overset *o, unsigned char *const *wanted)
{
    m->linear = 0;
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        for (int64_t c = 0; c < mesh_count(b); c++) {
            int i[3];
            if (wanted ? !wanted[k][c] : b->status[c] != CELL_FRINGE)
                continue;
            mesh_index(b, c, i);
            if (is_mine(m, k, i) && !find_donor(m, o, k, c, &m->linear) && !*m->trouble)
                report_orphan(m, k, c);
        }
    }
}

/* Matrix rows stay those of the last overset_find_rows or renewal. */
void overset_find(struct mesh *m, struct overset *o)
{
    keep_last(m, o);
    find_again(m, o, NULL);
    make_exchange(m, o, &m->fringe);
}

void overset_renew(struct mesh *m, struct overset *o)
{
    keep_last(m, o);
    find_again(m, o, NULL);
    overset_exchange(m, o);
}

/* A search that shares the bins and finds donors of its own. */
static struct overset *beside(const struct overset *o)
{
    struct overset *fresh = NEW(struct overset, 1);
    *fresh = *o;
    fresh->donor = NULL;
    fresh->n = fresh->room = fresh->n_old = 0;
    return fresh;
}

/* A search of its own, so that the one of the stages stays. */
void overset_find_rows(struct mesh *m, const struct overset *o)
{
    struct overset *fresh = beside(o);
    fresh->rows_only = true;
    find_again(m, fresh, NULL);
    set_fringes(m, fresh);
    mem_free(fresh);
}

/* A search of its own beside the fringe's; nothing is kept. */
void overset_interpolate(struct mesh *m, struct overset *o, unsigned char *const *wanted, int nf,
                         double *const *f)
{
    struct mesh_exchange x = {0};
    struct overset *fresh = beside(o);
    find_again(m, fresh, wanted);
    make_exchange(m, fresh, &x);
    mesh_exchange(m, &x, nf, f);
    mesh_exchange_free(&x);
    mem_free(fresh);
}

/* Every rank looks at all cells, so all agree; o's donors are left as they were. */
bool overset_sound(const struct mesh *m, struct overset *o, struct overset_orphan *first)
{
    struct donor *const kept = o->donor;
    const int64_t n = o->n, room = o->room;
    int64_t linear = 0;
    bool sound = true;
    o->donor = NULL;
    o->n = o->room = 0;
    for (int k = 0; k < m->nblocks && sound; k++)
        for (int64_t c = 0; c < mesh_count(m->block + k) && sound; c++)
            if (m->block[k].status[c] == CELL_FRINGE && !find_donor(m, o, k, c, &linear)) {
                sound = false;
                first->block = k;
                mesh_index(m->block + k, c, first->cell);
                memcpy(first->x, m->block[k].centre[c], sizeof first->x);
            }
    mem_free(o->donor);
    o->donor = kept;
    o->n = n;
    o->room = room;
    return sound;
}

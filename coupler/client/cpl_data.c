/* cpl_data.c - behind cpl.h: places, and fields given. A put goes to those coupler ranks that have
 * said what they want; it is kept as long as somebody may still ask for more of it: two slots for
 * each field, by tick & 1, since nobody asks for what lies more than one coupling step back. Places
 * are shared by the puts made at them and counted (users).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cpl_client.h"

/* The last user frees them. */
static void places_release(struct client_places **p)
{
    if (*p && --(*p)->users == 0) {
        free((*p)->x);
        free((*p)->gid);
        free((*p)->volume);
        free(*p);
    }
    *p = NULL;
}

static void *copy(const void *from, size_t n)
{
    void *to = wire_alloc(n);
    if (n)
        memcpy(to, from, n);
    return to;
}

static bool in_window(const struct cpl *c) { return c->state == PLANNED || c->state == IN_WINDOW; }

/* What is common to giving and taking. d: CPL_PUT or CPL_GET. */
int client_check_field(struct cpl *c, int field, int d, const char *call)
{
    if (c->error)
        return c->error;
    if (field < 0 || field >= c->nfields || !(c->field[field].direction & d))
        return client_error(c, CPL_EORDER, "%s: number %d is not a field to %s", call, field,
                            d == CPL_PUT ? "put" : "get");
    if (!in_window(c))
        return client_error(c, CPL_EORDER, "%s of %s outside of a coupling step", call,
                            c->field[field].name);
    return CPL_OK;
}

/* First number that is not finite, n if all are. */
static size_t first_bad(const double *v, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(v[i]))
            return i;
    return n;
}

/* --- giving --- */

/* Collective over the program's ranks, for the numbers of the targets. */
int cpl_move(struct cpl *c, int set, long n, const double *x, const int64_t *gid,
             const double *volume)
{
    if (c->error)
        return c->error;
    if (set < 0 || set >= c->nsets || c->set[set].is_grid || n < 0 || (n > 0 && !gid && volume))
        return client_error(c, CPL_EORDER, "cpl_move: not a set of points, or no ids");
    struct client_set *s = &c->set[set];
    const size_t bad = first_bad(x, 3 * (size_t)n);
    if (bad < 3 * (size_t)n)
        return client_error(c, CPL_EINPUT, "%s: place of point %zu on rank %d is not finite",
                            s->name, bad / 3, c->rank);
    places_release(&s->places);
    struct client_places *p = s->places = wire_alloc(sizeof *p);
    *p = (struct client_places){.users = 1, .n = n, .x = copy(x, 3 * (size_t)n * sizeof *x)};
    if (gid)
        p->gid = copy(gid, (size_t)n * sizeof *gid);
    if (volume)
        p->volume = copy(volume, (size_t)n * sizeof *volume);
    /* targets: which share of all targets is mine decides who of the coupler maps them */
    int64_t mine = n;
    s->first = 0;
    MPI_Exscan(&mine, &s->first, 1, MPI_INT64_T, MPI_SUM, c->mine);
    if (c->rank == 0)
        s->first = 0;
    MPI_Allreduce(&mine, &s->total, 1, MPI_INT64_T, MPI_SUM, c->mine);
    s->moves++;
    return CPL_OK;
}

/* Only volumes above 0 are taken: a cell without one would weigh nothing. */
int cpl_move_cells(struct cpl *c, int set, long n, const int *nvertex, const double *x,
                   const int64_t *gid)
{
    if (c->error)
        return c->error;
    if (set < 0 || set >= c->nsets || c->set[set].is_grid || n < 0)
        return client_error(c, CPL_EORDER, "cpl_move_cells: not a set of points");
    double *centre = wire_alloc((size_t)n * 3 * sizeof *centre);
    double *volume = wire_alloc((size_t)n * sizeof *volume);
    const double *corner = x;
    int code = CPL_OK;
    for (long i = 0; i < n && code == CPL_OK; corner += 3 * nvertex[i], i++) {
        cpl_cell(c->set[set].dim, nvertex[i], corner, centre + 3 * i, volume + i);
        if (!(volume[i] > 0.0) || !isfinite(volume[i]))
            code =
                client_error(c, CPL_EINPUT, "%s: cell %ld on rank %d, of %d corners, has no volume",
                             c->set[set].name, i, c->rank, nvertex[i]);
    }
    if (code == CPL_OK)
        code = cpl_move(c, set, n, centre, gid, volume);
    free(centre);
    free(volume);
    return code;
}

/* Those of this rank's points of which any image lies in the region, column by column: x, gid,
 * volume, values. */
static void serve_points(const struct client_field *f, const struct slot *s, const struct need *d,
                         int dim, struct pack *p)
{
    const struct client_places *at = s->places;
    long *chosen = wire_alloc((size_t)at->n * sizeof *chosen), n = 0;
    for (long i = 0; i < at->n; i++)
        if (region_images(&d->region, at->x + 3 * i, NULL))
            chosen[n++] = i;
    const size_t nc = (size_t)f->ncomp, nd = (size_t)dim, m = (size_t)n, nt = (size_t)s->terms;
    const size_t row[4] = {nd * sizeof(double), sizeof(int64_t), sizeof(double),
                           nt * nc * sizeof(double)};
    unsigned char *x = pack_room(p, m * (row[0] + row[1] + row[2] + row[3]));
    unsigned char *gid = x + m * row[0], *volume = gid + m * row[1], *v = volume + m * row[2];
    for (size_t k = 0; k < m; k++) {
        const long i = chosen[k];
        memcpy(x + k * row[0], at->x + 3 * i, row[0]);
        memcpy(gid + k * row[1], at->gid + i, row[1]);
        memcpy(volume + k * row[2], at->volume + i, row[2]);
        for (size_t term = 0; term < nt; term++)
            memcpy(v + k * row[3] + term * nc * sizeof(double), s->v[term] + (size_t)i * nc,
                   nc * sizeof(double));
    }
    pack_head(p)->count = n;
    free(chosen);
}

/* The cells lo <= i < hi of an asker's box that this block holds when it is shifted by whole
 * periods. Periodic grids: a box is in the unwrapped index space and may reach over the side or go
 * round more than once. */
static bool overlap(const struct cpl_grid *g, const struct region_box *b, const int shift[3],
                    int lo[3], int hi[3])
{
    for (int a = 0; a < 3; a++) {
        const int by = shift[a] * g->cells[a];
        lo[a] = g->lo[a] + by > b->lo[a] ? g->lo[a] + by : b->lo[a];
        hi[a] = g->hi[a] + by < b->hi[a] ? g->hi[a] + by : b->hi[a];
        if (lo[a] >= hi[a])
            return false;
    }
    return true;
}

/* A piece: asker, box, then CPL_TERMS values for each cell and component; terms that were not put
 * are 0. */
static void pack_cells(const struct client_field *f, const struct slot *s, const struct cpl_grid *g,
                       int asker, const int lo[3], const int hi[3], const int shift[3],
                       struct pack *p)
{
    const size_t nc = (size_t)f->ncomp;
    const size_t n = (size_t)(hi[0] - lo[0]) * (size_t)(hi[1] - lo[1]) * (size_t)(hi[2] - lo[2]);
    int64_t begin[7] = {asker, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]};
    pack_bytes(p, begin, sizeof begin);
    double *to =
        pack_room(p, CPL_TERMS * n * nc * sizeof *to); /* all that was packed is a multiple of 8 */
    for (int k = lo[2]; k < hi[2]; k++)
        for (int j = lo[1]; j < hi[1]; j++) {
            const size_t kk = (size_t)(k - shift[2] * g->cells[2] - g->lo[2]);
            const size_t jj = (size_t)(j - shift[1] * g->cells[1] - g->lo[1]);
            const size_t ii = (size_t)(lo[0] - shift[0] * g->cells[0] - g->lo[0]);
            size_t from =
                nc *
                ((kk * (size_t)(g->hi[1] - g->lo[1]) + jj) * (size_t)(g->hi[0] - g->lo[0]) + ii);
            for (size_t m = nc * (size_t)(hi[0] - lo[0]); m > 0; m--, from++)
                for (int term = 0; term < CPL_TERMS; term++)
                    *to++ = s->v[term] ? s->v[term][from] : 0.0;
        }
}

static int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/* For every asker's box, every shift by whole periods that makes this rank's block meet it. */
static void serve_grid(const struct client_field *f, const struct slot *s, const struct need *d,
                       const struct cpl_grid *g, struct pack *p)
{
    int64_t pieces = 0;
    for (int i = 0; i < d->region.nboxes; i++) {
        const struct region_box *b = &d->region.box[i];
        int first[3], last[3], shift[3], lo[3], hi[3];
        for (int a = 0; a < 3; a++) {
            first[a] = g->periodic[a] ? floor_div(b->lo[a], g->cells[a]) : 0;
            last[a] = g->periodic[a] ? floor_div(b->hi[a] - 1, g->cells[a]) : 0;
        }
        for (shift[2] = first[2]; shift[2] <= last[2]; shift[2]++)
            for (shift[1] = first[1]; shift[1] <= last[1]; shift[1]++)
                for (shift[0] = first[0]; shift[0] <= last[0]; shift[0]++)
                    if (overlap(g, b, shift, lo, hi)) {
                        pack_cells(f, s, g, b->asker, lo, hi, shift, p);
                        pieces++;
                    }
    }
    pack_head(p)->count = pieces;
}

/* Sends what this need asks for of a slot, unless it has had it: served[] holds the generation of
 * the need that was served last. */
static void serve(struct cpl *c, int field, struct slot *s, int target, int rank)
{
    struct client_field *f = &c->field[field];
    const int which = target * c->ncoupler + rank;
    const struct need *d = &f->need[which];
    const struct client_set *set = &c->set[f->set];
    struct pack p;
    if (s->tick < 0 || s->served[which] >= d->generation)
        return;
    pack_begin(&p, WIRE_PUT, field, s->tick);
    pack_head(&p)->generation = d->generation;
    pack_head(&p)->target = target;
    pack_head(&p)->terms = s->terms;
    pack_head(&p)->t = s->t;
    if (set->is_grid)
        serve_grid(f, s, d, &set->grid, &p);
    else
        serve_points(f, s, d, set->dim, &p);
    wire_send(&c->wire, 0, rank, &p);
    s->served[which] = d->generation;
}

/* The older put first: the coupler sees by a later one that there is none of a tick. A new region
 * replaces the old one. */
void client_need(struct cpl *c, struct message *m)
{
    const int field = m->head.field, target = m->head.target;
    if (field < 0 || field >= c->nfields || target < 0 || target >= c->field[field].ntargets)
        c->wire.broken("the coupler asks for a field that this program does not have");
    struct client_field *f = &c->field[field];
    struct need *d = &f->need[target * c->ncoupler + m->rank];
    region_free(&d->region);
    d->region = region_take(&c->wire, m);
    d->generation = m->head.generation;
    const int first = f->slot[1].tick < f->slot[0].tick;
    for (int i = 0; i < 2; i++)
        if (f->slot[first ^ i].tick >= m->head.tick)
            serve(c, field, &f->slot[first ^ i], target, m->rank);
}

/* Windows before the time t: the start of this window, or its end. */
static int64_t tick_of(const struct cpl *c, double t)
{
    if (c->state == PLANNED)
        return c->window;
    return fabs(t - c->t0) < fabs(t - c->t1) ? c->window : c->window + 1;
}

/* An empty slot has the tick -1. */
static void clear_slot(struct slot *s)
{
    for (int k = 0; k < CPL_TERMS; k++)
        free(s->v[k]);
    free(s->served);
    places_release(&s->places);
    *s = (struct slot){.tick = -1};
}

int cpl_put(struct cpl *c, int field, double t, long n, const double *v, const double *dvdt)
{
    return cpl_put_course(c, field, t, n, dvdt ? 2 : 1, (const double *const[]){v, dvdt});
}

/* The values are copied, then sent to everybody whose need is known; who asks for more later is
 * served from the copy. All is checked before anything is changed. */
int cpl_put_course(struct cpl *c, int field, double t, long n, int nterms,
                   const double *const term[])
{
    const int code = client_check_field(c, field, CPL_PUT, "cpl_put");
    if (code != CPL_OK)
        return code;
    struct client_field *f = &c->field[field];
    struct client_set *set = &c->set[f->set];
    const struct cpl_grid *g = &set->grid;
    int64_t want = set->places ? set->places->n : -1;
    if (set->is_grid)
        want = (int64_t)(g->hi[0] - g->lo[0]) * (g->hi[1] - g->lo[1]) * (g->hi[2] - g->lo[2]);
    else if (want < 0)
        return client_error(c, CPL_EORDER, "%s: cpl_put before cpl_move has placed %s", f->name,
                            set->name);
    else if (want > 0 && (!set->places->volume || !set->places->gid))
        return client_error(c, CPL_EORDER, "%s: its points have no volumes or ids", f->name);
    if (nterms < 1 || nterms > CPL_TERMS)
        return client_error(c, CPL_EORDER, "%s: %d terms in time; 1 to %d are possible", f->name,
                            nterms, CPL_TERMS);
    if (n != want)
        return client_error(c, CPL_EINPUT, "%s: %ld values for %lld places of %s", f->name, n,
                            (long long)want, set->name);
    const size_t size = (size_t)n * (size_t)f->ncomp;
    size_t bad = size;
    for (int k = 0; k < nterms && bad == size; k++)
        bad = first_bad(term[k], size);
    if (bad < size)
        return client_error(c, CPL_EINPUT,
                            "%s: value %zu of %s on rank %d is not finite (t = %g s)", f->name,
                            bad / (size_t)f->ncomp, set->name, c->rank, t);
    const int64_t tick = tick_of(c, t);
    if (tick <= f->last_tick) /* else who reads sees the one or the other, as messages come */
        return client_error(c, CPL_EORDER,
                            "%s: a second put at t = %g s, or one before the last: the end of a "
                            "coupling step is the start of the next",
                            f->name, t);
    struct slot *s = &f->slot[tick & 1];
    clear_slot(s);
    *s = (struct slot){.tick = tick, .t = t, .terms = nterms};
    for (int k = 0; k < nterms; k++)
        s->v[k] = copy(term[k], size * sizeof *term[k]);
    s->places = set->places;
    if (s->places)
        s->places->users++;
    const size_t nserved = (size_t)f->ntargets * (size_t)c->ncoupler * sizeof *s->served;
    s->served = wire_alloc(nserved);
    memset(s->served, 0, nserved);
    f->last_tick = tick;
    for (int k = 0; k < f->ntargets; k++)
        for (int r = 0; r < c->ncoupler; r++)
            serve(c, field, s, k, r);
    return CPL_OK;
}

/* How far each field has been put, by which the coupler sees who waits for what. */
void client_pack_ticks(const struct cpl *c, struct pack *p)
{
    pack_int(p, c->nfields);
    for (int i = 0; i < c->nfields; i++)
        pack_int(p, c->field[i].last_tick);
}

void client_free_fields(struct cpl *c)
{
    for (int i = 0; i < c->nfields; i++) {
        struct client_field *f = &c->field[i];
        for (int r = 0; r < f->ntargets * c->ncoupler; r++)
            region_free(&f->need[r].region);
        free(f->need);
        clear_slot(&f->slot[0]);
        clear_slot(&f->slot[1]);
        patch_clear(&f->patch);
    }
    for (int i = 0; i < c->nsets; i++)
        places_release(&c->set[i].places);
}

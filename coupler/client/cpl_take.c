/* cpl_take.c - behind cpl.h: fields taken, mapped by the coupler or as patches. A get is a question
 * to the coupler's ranks and a wait for their answers; every rank of the program takes part. Values
 * come with their terms in time, so that the same answer serves all times of a coupling step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cpl_client.h"

/* Targets first <= i < last of this rank that coupler rank r maps: equal shares of all targets,
 * whatever their place; neighbours in number are mostly neighbours in space. */
static void share(const struct cpl *c, const struct client_set *s, int r, long *first, long *last)
{
    const int64_t n = s->places->n;
    const int64_t lo = s->total * r / c->ncoupler - s->first;
    const int64_t hi = s->total * (r + 1) / c->ncoupler - s->first;
    *first = (long)(lo < 0 ? 0 : lo > n ? n : lo);
    *last = (long)(hi < 0 ? 0 : hi > n ? n : hi);
}

/* Of a conservative mapping every rank of the coupler sees all targets: how much of a source falls
 * to one depends on all that are near it. */
static void pack_targets(const struct cpl *c, const struct client_field *f, long first, long last,
                         struct pack *p)
{
    const struct client_set *s = &c->set[f->set];
    const struct client_places *at = s->places;
    const bool all = f->how & CPL_CONSERVATIVE;
    pack_head(p)->count = all ? at->n : last - first;
    for (long i = all ? 0 : first; i < (all ? at->n : last); i++)
        pack_bytes(p, at->x + 3 * i, (size_t)s->dim * sizeof(double));
    for (long i = 0; i < at->n && all; i++)
        pack_int(p, at->gid[i]);
    for (long i = 0; i < at->n && all; i++)
        pack_real(p, at->volume ? at->volume[i] : 1.0);
}

/* To every rank of the coupler its share of the targets, unless it has them already (count -1: as
 * before). */
static void ask_points(struct cpl *c, int field, int64_t tick)
{
    struct client_field *f = &c->field[field];
    const struct client_set *s = &c->set[f->set];
    const bool moved = f->asked_moves != s->moves;
    for (int r = 0; r < c->ncoupler; r++) {
        long first, last;
        struct pack p;
        share(c, s, r, &first, &last);
        pack_begin(&p, WIRE_GET, field, tick);
        pack_head(&p)->generation = s->moves;
        pack_head(&p)->count = -1;
        if (c->rank == 0)
            client_pack_ticks(c, &p);
        if (moved)
            pack_targets(c, f, first, last, &p);
        wire_send(&c->wire, 0, r, &p);
    }
    f->asked_moves = s->moves;
}

/* v = sum of the terms at dt from their time; term after term in `from'. */
static void sum_terms(const unsigned char *from, int terms, size_t nc, double dt, double *v)
{
    double term[CPL_TERMS];
    for (size_t a = 0; a < nc; a++) {
        for (int k = 0; k < terms; k++)
            memcpy(term + k, from + ((size_t)k * nc + a) * sizeof *v, sizeof *v);
        v[a] = term[terms - 1];
        for (int k = terms - 2; k >= 0; k--)
            v[a] = term[k] + dt * v[a];
    }
}

/* Values of a tick at the time t (NAN: their own, which comes back). A rank without targets waits
 * as the others do: it may hold what the source waits for, and hands it over here. */
static int take_points(struct cpl *c, int field, int64_t tick, double *t, double *v,
                       unsigned char *mask)
{
    struct client_field *f = &c->field[field];
    const struct client_set *s = &c->set[f->set];
    const size_t nc = (size_t)f->ncomp;
    char what[160];
    snprintf(what, sizeof what, "%s of %s", f->name, f->partner);
    ask_points(c, field, tick);
    for (int r = 0; r < c->ncoupler; r++) {
        long first, last;
        share(c, s, r, &first, &last);
        struct message *m = client_await(c, WIRE_VALUES, field, tick, r, what);
        if (!m)
            return c->error;
        const size_t count = (size_t)(last - first);
        const int terms = m->head.terms;
        if (terms < 1 || terms > CPL_TERMS)
            c->wire.broken("values of a field with an unknown number of terms in time");
        const size_t row = (size_t)terms * nc * sizeof *v;
        const unsigned char *values = take_view(&c->wire, m, count * row);
        const unsigned char *there = take_view(&c->wire, m, count);
        if (count > 0 && isnan(*t))
            *t = m->head.t;
        for (size_t i = 0; i < count; i++)
            if (there[i])
                sum_terms(values + i * row, terms, nc, *t - m->head.t,
                          v + ((size_t)first + i) * nc);
        if (mask)
            memcpy(mask + first, there, count);
        message_free(&m);
    }
    return CPL_OK;
}

/* The straight line between the values of the window's start and of its end. Both ends must be
 * there (mask); the source must put at both. */
static int take_between(struct cpl *c, int field, double t, long n, double *v, unsigned char *mask)
{
    const size_t nc = (size_t)c->field[field].ncomp;
    double *old = wire_alloc((size_t)n * nc * sizeof *old), before = NAN, after = NAN;
    double *new = wire_alloc((size_t)n * nc * sizeof *new);
    unsigned char *there = wire_alloc(2 * (size_t)n);
    int code = take_points(c, field, c->window, &before, old, there);
    if (code == CPL_OK)
        code = take_points(c, field, c->window + 1, &after, new, there + n);
    const double s = (t - before) / (after - before);
    for (size_t i = 0; i < (size_t)n && code == CPL_OK; i++) {
        const bool both = there[i] && there[(size_t)n + i];
        for (size_t a = i * nc; a < (i + 1) * nc && both; a++)
            v[a] = (1.0 - s) * old[a] + s * new[a];
        if (mask)
            mask[i] = both;
    }
    free(old);
    free(new);
    free(there);
    return code;
}

/* What is common to all that takes: the field, its kind and way of mapping, that this call is in
 * its turn. */
static int check_read(struct cpl *c, int field, bool patch, enum cpl_when when, const char *call)
{
    const int code = client_check_field(c, field, CPL_GET, call);
    if (code != CPL_OK)
        return code;
    const struct client_field *f = &c->field[field];
    if (f->from_grid != patch || c->state != IN_WINDOW)
        return client_error(c, CPL_EORDER, "%s: %s comes from %s, or no coupling step is under way",
                            call, f->name, f->from_grid ? "a grid" : "points");
    if (when != CPL_START && when != CPL_END && when != CPL_BETWEEN)
        return client_error(c, CPL_EORDER, "%s: %s: %d is no enum cpl_when", call, f->name,
                            (int)when);
    return CPL_OK;
}

/* Times are judged with the slack of cpl_advance. */
int cpl_get_at(struct cpl *c, int field, enum cpl_when when, double t, long n, double *v,
               unsigned char *mask)
{
    const int code = check_read(c, field, false, when, "cpl_get");
    if (code != CPL_OK)
        return code;
    const struct client_field *f = &c->field[field];
    const struct client_set *s = &c->set[f->set];
    const double slack = 1e-9 * (fabs(c->t1) + (c->t1 - c->t0));
    if (!s->places || n != s->places->n)
        return client_error(c, CPL_EINPUT, "%s: %ld targets, but cpl_move placed %ld of %s",
                            f->name, n, s->places ? s->places->n : 0, s->name);
    if ((f->how & CPL_CONSERVATIVE) && n > 0 && !s->places->gid)
        return client_error(c, CPL_EORDER, "%s: the points of %s have no ids", f->name, s->name);
    if (!(t >= c->t0 - slack && t <= c->t1 + slack))
        return client_error(c, CPL_EINPUT,
                            "%s: t = %.17g s is not in the coupling step %.17g .. %.17g s", f->name,
                            t, c->t0, c->t1);
    if (when == CPL_BETWEEN)
        return take_between(c, field, t, n, v, mask);
    return take_points(c, field, when == CPL_START ? c->window : c->window + 1, &t, v, mask);
}

int cpl_get(struct cpl *c, int field, long n, double *v, unsigned char *mask)
{
    return cpl_get_at(c, field, CPL_END, c->t1, n, v, mask);
}

/* --- patches --- */

/* Ranks of the program are dealt out to the coupler's: rank r asks rank r mod n, which cuts its
 * patch from what the source's blocks send. Cells come back in the box's own index space. */
static int take_patch(struct cpl *c, int field, int64_t tick, const double lo[3],
                      const double hi[3], struct client_patch *q)
{
    struct client_field *f = &c->field[field];
    const int to = c->rank % c->ncoupler;
    struct pack p;
    pack_begin(&p, WIRE_GET, field, tick);
    if (c->rank == 0)
        client_pack_ticks(c, &p);
    pack_bytes(&p, lo, 3 * sizeof *lo);
    pack_bytes(&p, hi, 3 * sizeof *hi);
    wire_send(&c->wire, 0, to, &p);
    char what[160];
    snprintf(what, sizeof what, "%s of %s", f->name, f->partner);
    struct message *m = client_await(c, WIRE_VALUES, field, tick, to, what);
    if (!m)
        return c->error;
    *q = (struct client_patch){.dim = f->grid.dim, .ncomp = f->ncomp, .cubic = f->how == CPL_CUBIC};
    q->t = m->head.t;
    for (int a = 0; a < 3; a++) {
        q->lo[a] = (int)take_int(&c->wire, m);
        q->n[a] = (int)take_int(&c->wire, m) - q->lo[a];
        q->origin[a] = f->grid.origin[a];
        q->spacing[a] = f->grid.spacing[a];
        q->period[a] = f->grid.periodic[a] ? f->grid.cells[a] : 0;
    }
    const size_t bytes = CPL_TERMS * patch_size(q) * (size_t)q->ncomp * sizeof *q->v;
    q->v = wire_alloc(bytes);
    take_bytes(&c->wire, m, q->v, bytes);
    message_free(&m);
    return CPL_OK;
}

/* a's values at its time and b's at its own: a straight line. The same cells of both. */
static void join_patches(struct client_patch *a, const struct client_patch *b)
{
    const size_t n = CPL_TERMS * patch_size(a) * (size_t)a->ncomp;
    for (size_t i = 0; i < n; i += CPL_TERMS) {
        a->v[i + 1] = (b->v[i] - a->v[i]) / (b->t - a->t);
        for (int k = 2; k < CPL_TERMS; k++)
            a->v[i + (size_t)k] = 0.0;
    }
}

/* The old patch stays until the new one is complete. */
int cpl_patch_get_at(struct cpl *c, int field, enum cpl_when when, const double lo[3],
                     const double hi[3])
{
    int code = check_read(c, field, true, when, "cpl_patch_get");
    if (code != CPL_OK)
        return code;
    struct client_field *f = &c->field[field];
    const int64_t tick = when == CPL_END ? c->window + 1 : c->window;
    struct client_patch q = {0}, end = {0};
    code = take_patch(c, field, tick, lo, hi, &q);
    if (code == CPL_OK && when == CPL_BETWEEN)
        code = take_patch(c, field, tick + 1, lo, hi, &end);
    if (code == CPL_OK) {
        if (when == CPL_BETWEEN)
            join_patches(&q, &end);
        patch_prepare(&q);
        patch_clear(&f->patch);
        f->patch = q;
        f->got_tick = when == CPL_BETWEEN ? tick + 1 : tick;
    }
    patch_clear(&end);
    return code;
}

/* Once a window: the values at its start; again: those at its end. */
int cpl_patch_get(struct cpl *c, int field, const double lo[3], const double hi[3])
{
    const bool known = field >= 0 && field < c->nfields;
    const bool again = known && c->field[field].got_tick == c->window;
    return cpl_patch_get_at(c, field, again ? CPL_END : CPL_START, lo, hi);
}

void cpl_patch_eval(const struct cpl *c, int field, double t, long n, const double *x, double *v,
                    double *grad)
{
    patch_eval(&c->field[field].patch, t, n, x, v, grad);
}

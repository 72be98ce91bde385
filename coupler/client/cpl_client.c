/* cpl_client.c - behind cpl.h: the life of a solver in a job, from meeting the others to goodbye.
 * The states are those of enum in cpl_client.h, each call checks that it is its turn. Messages of
 * the coupler are taken only while this program waits for one (client_await): there are no threads
 * in the protocol. Declarations, the report and most of what is sent come from rank 0; the answers
 * go to all ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cpl_client.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double look_every = 0.05; /* s between looks at whether the others live */

/* An error of a partner stays: each later call returns it. */
int client_error(struct cpl *c, int code, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    vsnprintf(c->text, sizeof c->text, fmt, args);
    va_end(args);
    if (code == CPL_EPARTNER)
        c->error = code;
    return code;
}

int client_out_of_order(struct cpl *c, const char *call, const char *when)
{
    return client_error(c, CPL_EORDER, "%s belongs %s (see the order of calls in cpl.h)", call,
                        when);
}

/* Nothing is cut short. */
int client_check_name(struct cpl *c, const char *what, const char *name)
{
    if (!name || !name[0])
        return client_error(c, CPL_EINPUT, "%s without a name", what);
    if (strlen(name) >= CPL_NAME)
        return client_error(c, CPL_EINPUT, "%s `%s': a name of %zu bytes, %d are possible", what,
                            name, strlen(name), CPL_NAME - 1);
    return CPL_OK;
}

static _Noreturn void broken(const char *what) { failure_die(4, what); }

/* Whether a partner is dead, looked up at most every `look_every' s; leaves the reason as the error
 * text. */
static bool partner_lost(struct cpl *c, struct backoff *backoff)
{
    const double now = wire_time();
    char note[512];
    if (now - backoff->checked < look_every)
        return false;
    backoff->checked = now;
    if (!failure_seen())
        return false;
    if (!failure_read(note, sizeof note))
        snprintf(note, sizeof note, "a program of this job is gone");
    client_error(c, CPL_EPARTNER, "%s", note);
    return true;
}

/* The first message kept that is of this kind, and of that field and tick or rank where given (>=
 * 0); taken out of the list. Messages of one sender stay in order. */
static struct message *from_inbox(struct cpl *c, enum wire_kind kind, int field, int64_t tick,
                                  int rank)
{
    for (struct message **link = &c->inbox; *link; link = &(*link)->next) {
        struct message *m = *link;
        if (m->head.kind != kind ||
            (field >= 0 && (m->head.field != field || m->head.tick != tick)) ||
            (rank >= 0 && m->rank != rank))
            continue;
        *link = m->next;
        m->next = NULL;
        return m;
    }
    return NULL;
}

/* What is said of this rank if it is lost. */
static void at_work(const struct cpl *c)
{
    char doing[64];
    snprintf(doing, sizeof doing, "at work in coupling step %lld", (long long)c->window);
    failure_doing(doing);
}

/* Waits for one certain message. Whatever else comes meanwhile is kept, except needs, which are
 * served at once: a source that waits for another field must not keep its targets waiting, or two
 * programs that take from each other would wait for ever. */
struct message *client_await(struct cpl *c, enum wire_kind kind, int field, int64_t tick, int rank,
                             const char *what)
{
    struct message *found = NULL;
    struct backoff backoff;
    char doing[256];
    snprintf(doing, sizeof doing, "in coupling step %lld, waiting for %s", (long long)c->window,
             what);
    failure_doing(doing);
    backoff_begin(&backoff);
    for (;;) {
        if ((found = from_inbox(c, kind, field, tick, rank)))
            break;
        struct message *m = wire_poll(&c->wire, -1);
        if (!m) {
            if (partner_lost(c, &backoff))
                break;
            backoff_sleep(&backoff);
            continue;
        }
        c->heard = wire_time();
        if (m->head.kind == WIRE_NEED && c->state >= PLANNED) { /* else cpl_ready looks at it */
            client_need(c, m);
            message_free(&m);
        } else {
            struct message **end = &c->inbox;
            while (*end)
                end = &(*end)->next;
            *end = m;
        }
    }
    c->waited += wire_time() - backoff.since;
    at_work(c);
    return found;
}

/* --- meeting --- */

int cpl_version(void) { return CPL_VERSION; }

/* Collective over the world. A program that is alone gets no job (*out NULL) and goes on by
 * itself. */
int cpl_open_as(int version, MPI_Comm world, const char *name, double deadline_s, struct cpl **out,
                MPI_Comm *mine)
{
    struct handshake h;
    *out = NULL;
    const int code = handshake(world, name, deadline_s, version, &h);
    *mine = h.mine;
    if (code != 0) {
        int rank;
        MPI_Comm_rank(h.mine, &rank);
        if (rank == 0)
            fprintf(stderr, "%s: %s\n", name, h.text);
        return CPL_EINPUT;
    }
    if (h.nprograms == 1)
        return CPL_OK;
    struct cpl *c = wire_alloc(sizeof *c);
    memset(c, 0, sizeof *c);
    snprintf(c->name, sizeof c->name, "%s", name);
    c->world = world;
    c->mine = h.mine;
    MPI_Comm_rank(c->mine, &c->rank);
    MPI_Comm_size(c->mine, &c->size);
    c->ncoupler = h.program[h.coupler].size;
    c->wire.broken = broken;
    wire_add_peer(&c->wire, h.program[h.coupler].inter, c->ncoupler, "coupler");
    *out = c;
    return CPL_OK;
}

void cpl_patience(struct cpl *c, double s)
{
    (void)c; /* of the process, like its death note */
    alive_patience(s);
}

int cpl_zone(struct cpl *c, const char *zone, const double lo[3], const double hi[3])
{
    if (c->state != OPENED)
        return client_out_of_order(c, "cpl_zone", "before cpl_meet");
    if (c->nzones == LIMIT_ZONES)
        return client_error(c, CPL_EINPUT, "more than %d zones", LIMIT_ZONES);
    if (client_check_name(c, "zone", zone))
        return CPL_EINPUT;
    struct zone *z = &c->zone[c->nzones++];
    snprintf(z->name, sizeof z->name, "%s", zone);
    memcpy(z->lo, lo, sizeof z->lo);
    memcpy(z->hi, hi, sizeof z->hi);
    return CPL_OK;
}

/* The coupler's verdict: an empty text is consent. */
static int verdict(struct cpl *c, struct message *m)
{
    char text[CPL_TEXT];
    take_text(&c->wire, m, text, sizeof text);
    if (!text[0])
        return CPL_OK;
    failure_closed(); /* all programs leave in order */
    c->state = LEFT;
    return client_error(c, CPL_EINPUT, "%s", text);
}

/* The first exchange with the coupler: what this program starts from against what the others do.
 * Zones of all programs come back with the consent. */
int cpl_meet(struct cpl *c, uint64_t case_hash, int64_t restart_window, int faults, const char *dir)
{
    struct pack p;
    char path[1040], lines[CPL_TEXT];
    if (c->state != OPENED)
        return client_out_of_order(c, "cpl_meet", "once, after cpl_open");
    if (snprintf(path, sizeof path, "%s/.death", dir) >= (int)sizeof path)
        return client_error(c, CPL_EINPUT, "cpl_meet: a folder's name of %zu bytes", strlen(dir));
    failure_path(path);
    alive_begin(dir, c->name, c->rank);
    if (c->rank == 0) {
        pack_begin(&p, WIRE_MEET, 0, restart_window);
        pack_int(&p, (int64_t)case_hash);
        pack_int(&p, faults);
        pack_int(&p, c->nzones);
        pack_bytes(&p, c->zone, (size_t)c->nzones * sizeof *c->zone);
        snprintf(lines, sizeof lines, "%s", c->faults ? c->faults : "");
        pack_text(&p, lines);
        pack_text(&p, dir);
        wire_send(&c->wire, 0, 0, &p);
    }
    struct message *m = client_await(c, WIRE_MET, -1, 0, 0, "the other programs' cases");
    if (!m)
        return c->error;
    const int code = verdict(c, m);
    if (code == CPL_OK) {
        c->nzones = (int)take_int(&c->wire, m);
        if (c->nzones > LIMIT_ZONES)
            broken("more zones in the job than this version knows");
        take_bytes(&c->wire, m, c->zone, (size_t)c->nzones * sizeof *c->zone);
        c->window = restart_window > 0 ? restart_window : 0;
        c->state = MET;
        alive_sign(); /* the coupler has made the folder */
    }
    message_free(&m);
    return code;
}

int cpl_find_zone(struct cpl *c, const char *zone, double lo[3], double hi[3])
{
    if (c->state != MET)
        return client_out_of_order(c, "cpl_find_zone", "after cpl_meet, before cpl_ready");
    for (int i = 0; i < c->nzones; i++)
        if (strcmp(c->zone[i].name, zone) == 0) {
            memcpy(lo, c->zone[i].lo, sizeof c->zone[i].lo);
            memcpy(hi, c->zone[i].hi, sizeof c->zone[i].hi);
            return CPL_OK;
        }
    return client_error(c, CPL_EINPUT, "no program of this job has a zone `%s'", zone);
}

/* --- the plan --- */

/* Sets and fields as declared; of a grid, rank 0's own block is part of it, which the coupler does
 * not use. */
static void send_plan(struct cpl *c, double t, double dt_longest)
{
    struct pack p;
    pack_begin(&p, WIRE_READY, 0, c->window);
    pack_real(&p, t);
    pack_real(&p, dt_longest);
    pack_int(&p, c->nsets);
    for (int i = 0; i < c->nsets; i++) {
        const struct client_set *s = &c->set[i];
        pack_text(&p, s->name);
        pack_int(&p, s->is_grid);
        pack_int(&p, s->dim);
        pack_real(&p, s->support);
        pack_bytes(&p, s->period, sizeof s->period);
        pack_bytes(&p, &s->grid, sizeof s->grid);
    }
    pack_int(&p, c->nfields);
    for (int i = 0; i < c->nfields; i++) {
        const struct client_field *f = &c->field[i];
        pack_text(&p, f->name);
        pack_text(&p, f->unit);
        pack_int(&p, f->set);
        pack_int(&p, f->ncomp);
        pack_int(&p, f->direction);
        pack_int(&p, f->how);
    }
    wire_send(&c->wire, 0, 0, &p);
}

/* Needs of faster targets may come before the plan; they wait in the inbox until their fields are
 * known. */
int cpl_ready(struct cpl *c, double t, double dt_longest)
{
    if (c->state != MET)
        return client_out_of_order(c, "cpl_ready", "once, after cpl_meet");
    if (c->rank == 0)
        send_plan(c, t, dt_longest);
    struct message *m = client_await(c, WIRE_PLAN, -1, 0, 0, "the plan");
    if (!m)
        return c->error;
    const int code = verdict(c, m);
    if (code == CPL_OK) {
        c->window = m->head.tick;
        c->t0 = c->t1 = t;
        for (int i = 0; i < c->nfields; i++) {
            struct client_field *f = &c->field[i];
            take_text(&c->wire, m, f->partner, sizeof f->partner);
            f->from_grid = take_int(&c->wire, m) != 0;
            take_bytes(&c->wire, m, &f->grid, sizeof f->grid);
            f->ntargets = (int)take_int(&c->wire, m);
            const size_t n = (size_t)f->ntargets * (size_t)c->ncoupler * sizeof *f->need;
            f->need = wire_alloc(n);
            memset(f->need, 0, n);
        }
        c->state = PLANNED;
    }
    message_free(&m);
    while (code == CPL_OK && (m = from_inbox(c, WIRE_NEED, -1, 0, -1))) { /* targets were faster */
        client_need(c, m);
        message_free(&m);
    }
    return code;
}

/* --- windows --- */

/* Waits until all programs have ended the coupling step before. */
int cpl_window(struct cpl *c, double *t0, double *t1, int *action, int *code)
{
    if (c->error)
        return c->error;
    if (c->state != PLANNED && c->state != BETWEEN)
        return client_out_of_order(c, "cpl_window", "after cpl_ready or cpl_advance");
    struct message *m =
        client_await(c, WIRE_WINDOW, -1, 0, 0, "the other programs' coupling steps");
    if (!m)
        return c->error;
    *action = (int)take_int(&c->wire, m);
    *code = (int)take_int(&c->wire, m);
    *t0 = take_real(&c->wire, m);
    *t1 = take_real(&c->wire, m);
    if (*action & CPL_STOP) {
        c->state = ENDING;
    } else {
        c->window = m->head.tick;
        c->t0 = *t0;
        c->t1 = *t1;
        c->state = IN_WINDOW;
        at_work(c);
    }
    message_free(&m);
    return CPL_OK;
}

/* Kept until the next message that takes figures along. */
int cpl_tell(struct cpl *c, const char *key, double value)
{
    if (strlen(key) >= TOLD_KEY)
        return client_error(c, CPL_EINPUT, "cpl_tell: a key of %zu bytes, %d are possible",
                            strlen(key), TOLD_KEY - 1);
    if (c->rank != 0)
        return CPL_OK;
    pack_text(&c->told, key);
    pack_real(&c->told, value);
    c->ntold++;
    return CPL_OK;
}

static void pack_told(struct cpl *c, struct pack *p)
{
    pack_int(p, c->ntold);
    pack_bytes(p, c->told.bytes, c->told.n);
    c->told.n = 0;
    c->ntold = 0;
}

/* Does not wait: the next cpl_window does. t1 must be the end that was announced, to rounding, so
 * that a program with a clock of its own is found out. */
int cpl_advance(struct cpl *c, double t1, int stop)
{
    struct pack p;
    if (c->error)
        return c->error;
    if (c->state != IN_WINDOW)
        return client_out_of_order(c, "cpl_advance", "after cpl_window");
    if (!(fabs(t1 - c->t1) <= 1e-9 * (fabs(c->t1) + (c->t1 - c->t0))))
        return client_error(c, CPL_EINPUT, "coupling step %lld ends at %.17g s, not at %.17g s",
                            (long long)c->window, c->t1, t1);
    if (c->rank == 0) {
        pack_begin(&p, WIRE_ADVANCE, 0, c->window);
        pack_int(&p, stop);
        pack_real(&p, c->waited);
        client_pack_ticks(c, &p);
        pack_told(c, &p);
        wire_send(&c->wire, 0, 0, &p);
    }
    c->state = BETWEEN;
    return CPL_OK;
}

/* The name goes into a line of the manifest, so it is one word. */
int cpl_saved(struct cpl *c, const char *file)
{
    struct pack p;
    if (c->error)
        return c->error;
    if (strlen(file) >= SAVED_NAME)
        return client_error(c, CPL_EINPUT, "cpl_saved: a file's name of %zu bytes, %d are possible",
                            strlen(file), SAVED_NAME - 1);
    if (!file[0] || strcspn(file, " \t\n") != strlen(file)) /* a line of the manifest */
        return client_error(c, CPL_EINPUT, "cpl_saved: `%s': expected a file's name without spaces",
                            file);
    if (c->rank == 0) {
        pack_begin(&p, WIRE_SAVED, 0, c->window);
        pack_text(&p, file);
        wire_send(&c->wire, 0, 0, &p);
    }
    return CPL_OK;
}

int64_t cpl_window_number(const struct cpl *c) { return c->window; }
double cpl_waited(const struct cpl *c) { return c->waited; }
double cpl_heard(const struct cpl *c) { return wire_time() - c->heard; }
const char *cpl_strerror(const struct cpl *c) { return c->text; }
void cpl_obituary(int fd) { failure_obituary(fd); }

/* --- the end --- */

/* Does not return. */
void cpl_fail(struct cpl *c, int code, const char *reason)
{
    char text[512];
    if (c->error == CPL_EPARTNER)
        failure_die(code, c->text); /* somebody else's failure: said as it was heard */
    if (c->state >= PLANNED)
        snprintf(text, sizeof text, "in coupling step %lld: %s", (long long)c->window, reason);
    else
        snprintf(text, sizeof text, "before the first coupling step: %s", reason);
    failure_die(code, text);
}

/* Goodbye to each coupler rank, behind all that was sent to it before; the job's code comes back.
 */
static int goodbye(struct cpl *c, int code)
{
    struct timespec cpu;
    struct pack p;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    for (int r = 0; r < c->ncoupler; r++) {
        pack_begin(&p, WIRE_CLOSE, 0, c->window);
        pack_int(&p, code);
        pack_real(&p, c->waited);
        pack_real(&p, (double)cpu.tv_sec + 1e-9 * (double)cpu.tv_nsec);
        if (r == 0)
            pack_told(c, &p);
        else
            pack_int(&p, 0);
        wire_send(&c->wire, 0, r, &p);
    }
    struct message *m = client_await(c, WIRE_CLOSED, -1, 0, 0, "the other programs' end");
    if (!m)
        return c->error;
    const int job = (int)take_int(&c->wire, m);
    message_free(&m);
    while (!wire_flushed(&c->wire))
        nanosleep(&(struct timespec){.tv_nsec = 100000}, NULL);
    return job;
}

/* In order after the last coupling step; from any other state it is a failure, which ends the
 * job. */
int cpl_close(struct cpl **handle, int code)
{
    struct cpl *c = *handle;
    int job = code;
    if (!c)
        return code;
    if (c->error) {
        failure_die(4, c->text);
    } else if (c->state == ENDING) {
        job = goodbye(c, code);
        if (job < 0)
            failure_die(4, c->text);
    } else if (c->state != LEFT) {
        cpl_fail(c, code ? code : 4, c->text[0] ? c->text : "left before the end of the job");
    }
    failure_closed();
    client_free_fields(c);
    while (c->inbox) {
        struct message *m = c->inbox;
        c->inbox = m->next;
        message_free(&m);
    }
    free(c->told.bytes);
    free(c);
    *handle = NULL;
    return job;
}

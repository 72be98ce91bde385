/* wire.c - messages and waiting. Measured on Open MPI 4.1.4: a blocking receive burns its core and
 * starves an oversubscribed node; probing twice and then sleeping leaves it free. A wake-up costs
 * 10 (bare metal) to 35 us (virtual machine), so long waits need long sleeps: 1 ms takes 1.7 to
 * 4 % of a core, 10 ms 0.33 %. SPDX-License-Identifier: BSD-3-Clause */
#include "wire.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MAGIC = 0x4c504345, TAG = 77, TAG_REST = 76 };
enum { LARGEST_PIECE = 1 << 30 }; /* MPI counts in int */
enum { SPIN_US = 30, FIRST_SLEEP = 20, SHORT_SLEEP = 200, LONGEST_SLEEP = 10000 }; /* us */
#define LONG_WAIT 0.02 /* of the time waited */

struct pending {
    struct pending *next;
    MPI_Request request;
    unsigned char *bytes;
};

/* s, of a clock that nobody sets. */
double wire_time(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The library's own memory: without the suite's common folder. */
void *wire_grow(void *p, size_t n)
{
    void *q = realloc(p, n ? n : 1);
    if (!q) {
        fprintf(stderr, "libcpl: no memory for %zu bytes\n", n);
        abort();
    }
    return q;
}

void *wire_alloc(size_t n) { return wire_grow(NULL, n); }

/* --- building --- */

/* n bytes at the end; they move when more is packed. */
void *pack_room(struct pack *p, size_t n)
{
    if (p->n + n > p->capacity) {
        p->capacity = (p->n + n) + (p->n + n) / 2 + 256;
        p->bytes = wire_grow(p->bytes, p->capacity);
    }
    p->n += n;
    return p->bytes + p->n - n;
}

/* p: taken over; freed by the send. */
void pack_begin(struct pack *p, enum wire_kind kind, int field, int64_t tick)
{
    const struct wire_head head = {.magic = MAGIC,
                                   .version = WIRE_VERSION,
                                   .kind = (uint16_t)kind,
                                   .field = field,
                                   .tick = tick};
    *p = (struct pack){0};
    memcpy(pack_room(p, sizeof head), &head, sizeof head);
}

struct wire_head *pack_head(struct pack *p) { return (struct wire_head *)(void *)p->bytes; }

void pack_bytes(struct pack *p, const void *from, size_t n)
{
    if (n)
        memcpy(pack_room(p, n), from, n);
}

void pack_int(struct pack *p, int64_t i) { pack_bytes(p, &i, sizeof i); }

void pack_real(struct pack *p, double r) { pack_bytes(p, &r, sizeof r); }

void pack_text(struct pack *p, const char *text)
{
    const size_t n = strlen(text);
    pack_int(p, (int64_t)n);
    pack_bytes(p, text, n);
}

/* --- reading --- */

static void broken(const struct wire *w, const char *what)
{
    if (w->broken)
        w->broken(what);
    fprintf(stderr, "libcpl: %s\n", what);
    abort();
}

/* The next n bytes as they lie in the message, as long as that lives. */
const void *take_view(struct wire *w, struct message *m, size_t n)
{
    if (n > (size_t)m->head.bytes - m->at) {
        char text[160];
        snprintf(text, sizeof text, "message of kind %d from rank %d of %s is shorter than it says",
                 m->head.kind, m->rank, w->peer[m->peer].name);
        broken(w, text);
    }
    m->at += n;
    return m->body + m->at - n;
}

void take_bytes(struct wire *w, struct message *m, void *to, size_t n)
{
    if (n)
        memcpy(to, take_view(w, m, n), n);
}

int64_t take_int(struct wire *w, struct message *m)
{
    int64_t i;
    take_bytes(w, m, &i, sizeof i);
    return i;
}

double take_real(struct wire *w, struct message *m)
{
    double r;
    take_bytes(w, m, &r, sizeof r);
    return r;
}

/* Cut to size - 1 bytes. */
void take_text(struct wire *w, struct message *m, char *to, size_t size)
{
    const size_t n = (size_t)take_int(w, m);
    const void *text = take_view(w, m, n);
    const size_t kept = n < size ? n : size - 1;
    memcpy(to, text, kept);
    to[kept] = '\0';
}

void message_free(struct message **m)
{
    if (*m) {
        free((*m)->memory);
        free(*m);
    }
    *m = NULL;
}

/* --- sending and receiving --- */

int wire_add_peer(struct wire *w, MPI_Comm comm, int size, const char *name)
{
    if (w->npeers == WIRE_PEERS)
        broken(w, "too many programs in one job");
    w->peer[w->npeers] = (struct wire_peer){.comm = comm, .size = size, .name = name};
    return w->npeers++;
}

static size_t piece_of(const struct wire *w) { return w->piece ? w->piece : LARGEST_PIECE; }

/* Messages of one sender do not overtake each other, so the rest needs no numbers: the last piece
 * owns the memory. Returns at once; the memory is freed when the message has gone
 * (wire_flushed). */
void wire_send(struct wire *w, int peer, int rank, struct pack *p)
{
    const size_t most = piece_of(w);
    pack_head(p)->bytes = (int64_t)(p->n - sizeof(struct wire_head));
    for (size_t at = 0, n; at < p->n; at += n) {
        struct pending *s = wire_alloc(sizeof *s);
        n = p->n - at < most ? p->n - at : most;
        s->bytes = at + n == p->n ? p->bytes : NULL;
        MPI_Isend(p->bytes + at, (int)n, MPI_BYTE, rank, at == 0 ? TAG : TAG_REST,
                  w->peer[peer].comm, &s->request);
        s->next = w->pending;
        w->pending = s;
    }
    *p = (struct pack){0};
    (void)wire_flushed(w);
}

void wire_send_all(struct wire *w, int peer, struct pack *p)
{
    for (int rank = 0; rank < w->peer[peer].size; rank++) {
        struct pack copy = {0};
        pack_bytes(&copy, p->bytes, p->n);
        wire_send(w, peer, rank, &copy);
    }
    free(p->bytes);
    *p = (struct pack){0};
}

/* Pieces of a message lie together, the owner of the memory first: it goes when all have gone.
 * Called at each send and poll, which also lets MPI make progress. */
bool wire_flushed(struct wire *w)
{
    struct pending **link = &w->pending;
    while (*link) {
        struct pending *s = *link;
        int done = 0;
        MPI_Test(&s->request, &done, MPI_STATUS_IGNORE);
        if (done && !(s->bytes && s->next && !s->next->bytes)) {
            *link = s->next;
            free(s->bytes);
            free(s);
        } else {
            link = &s->next;
        }
    }
    return !w->pending;
}

/* A wait that leaves the core to others. */
static void finish(MPI_Request *request)
{
    struct backoff backoff;
    int done = 0;
    backoff_begin(&backoff);
    for (MPI_Test(request, &done, MPI_STATUS_IGNORE); !done;
         MPI_Test(request, &done, MPI_STATUS_IGNORE))
        backoff_sleep(&backoff);
}

/* The pieces behind the first `got' bytes of a long message. */
static void receive_rest(struct wire *w, int peer, int rank, struct message *m, size_t got,
                         size_t all)
{
    m->memory = wire_grow(m->memory, all);
    for (size_t n; got < all; got += n) {
        MPI_Request request;
        n = all - got < piece_of(w) ? all - got : piece_of(w);
        MPI_Irecv(m->memory + got, (int)n, MPI_BYTE, rank, TAG_REST, w->peer[peer].comm, &request);
        finish(&request);
    }
}

/* A message that is not of this version, or whose lengths do not fit together, ends the job:
 * nothing behind it could be understood. */
static struct message *receive(struct wire *w, int peer, MPI_Message *handle, MPI_Status *status)
{
    struct message *m = wire_alloc(sizeof *m);
    MPI_Request request;
    int n = 0;
    MPI_Get_count(status, MPI_BYTE, &n);
    if (n < (int)sizeof m->head)
        broken(w, "a message without a header");
    m->memory = wire_alloc((size_t)n);
    MPI_Imrecv(m->memory, n, MPI_BYTE, handle, &request);
    finish(&request);
    memcpy(&m->head, m->memory, sizeof m->head);
    const int64_t more = m->head.bytes + (int64_t)sizeof m->head - n;
    if (m->head.magic != MAGIC || m->head.version != WIRE_VERSION || m->head.kind == 0 ||
        m->head.kind >= WIRE_KINDS || more < 0 || (more > 0 && (size_t)n != piece_of(w)))
        broken(w, "a message of another version, or damaged");
    if (more > 0)
        receive_rest(w, peer, status->MPI_SOURCE, m, (size_t)n, (size_t)(n + more));
    m->body = m->memory + sizeof m->head;
    m->next = NULL;
    m->peer = peer;
    m->rank = status->MPI_SOURCE;
    m->at = 0;
    return m;
}

/* Twice, as the first probe often only lets MPI take in what has arrived. Matched probes
 * (MPI_Improbe), so that the message found is the one received. */
struct message *wire_poll(struct wire *w, int peer)
{
    const int first = peer < 0 ? 0 : peer, last = peer < 0 ? w->npeers - 1 : peer;
    if (w->pending)
        (void)wire_flushed(w);
    for (int twice = 0; twice < 2; twice++)
        for (int p = first; p <= last; p++) {
            MPI_Message handle;
            MPI_Status status;
            int there = 0;
            MPI_Improbe(MPI_ANY_SOURCE, TAG, w->peer[p].comm, &there, &handle, &status);
            if (there)
                return receive(w, p, &handle, &status);
        }
    return NULL;
}

void backoff_begin(struct backoff *n)
{
    n->since = n->checked = wire_time();
    n->us = FIRST_SLEEP;
}

/* Spins at first, then sleeps that grow by a quarter each, up to LONG_WAIT of the time waited so
 * far, but to SHORT_SLEEP at least: a wait is lengthened by 2 % or 0.2 ms at most. */
void backoff_sleep(struct backoff *n)
{
    const double waited = wire_time() - n->since;
    if (n->us == FIRST_SLEEP && waited < 1e-6 * SPIN_US)
        return;
    const struct timespec us = {.tv_nsec = 1000 * n->us};
    nanosleep(&us, NULL);
    const long share = (long)fmin(1e6 * waited * LONG_WAIT, LONGEST_SLEEP);
    const long cap = share > SHORT_SLEEP ? share : SHORT_SLEEP;
    n->us = n->us * 5 / 4 < cap ? n->us * 5 / 4 : cap;
}

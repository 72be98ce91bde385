/* wire.h - messages between the programs of a job: a fixed header and packed bytes, point to point
 * over intercommunicators, and a way of waiting that leaves the processor to those who have work.
 * Bytes are those of the sender: all hosts must have the same byte order. Messages of one sender to
 * one receiver keep their order. Part of libcpl.a: depends on MPI alone.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <mpi.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Version of the protocol, which all programs of a job must have; most programs one can reach. */
enum { WIRE_VERSION = 4, WIRE_PEERS = 40 };

/* The most that a program, or a job, can have; more is refused. */
enum {
    LIMIT_SETS = 32,
    LIMIT_FIELDS = 64,
    LIMIT_TARGETS = 32,
    LIMIT_LINKS = 256,
    LIMIT_ZONES = 64
};
enum { TOLD_KEYS = 192, TOLD_KEY = 96, SAVED_NAME = 256 }; /* bytes with the closing zero */

/* Kinds of messages, from solver to coupler, or from coupler to solver (>), in the order of a
 * job. */
enum wire_kind {
    WIRE_MEET = 1, /* hash, restart coupling step, faults, zones */
    WIRE_MET,      /* > accepted, or all problems; all zones */
    WIRE_READY,    /* sets and fields, time, longest coupling step */
    WIRE_PLAN,     /* > accepted, or all problems; where fields come from */
    WIRE_WINDOW,   /* > number, start, end, action */
    WIRE_GET,      /* wants a field at a tick: new places or box, if they changed */
    WIRE_NEED,     /* > from now on, values in this region are wanted */
    WIRE_PUT,      /* values in that region */
    WIRE_VALUES,   /* > the answer to WIRE_GET */
    WIRE_ADVANCE,  /* coupling step done, told numbers, stop wanted */
    WIRE_SAVED,    /* restart file complete */
    WIRE_CLOSE,    /* last message to each coupler rank */
    WIRE_CLOSED,   /* > exit code of the job */
    WIRE_KINDS
};

/* The header of every message. Its layout is part of the protocol: raise WIRE_VERSION with any
 * change. */
struct wire_head {
    uint32_t magic;         /* marks a message of this protocol */
    uint16_t version, kind; /* WIRE_VERSION, enum wire_kind */
    int32_t field;          /* the solver's own number of the field */
    int32_t generation; /* of the region that a put answers, of the places that values belong to */
    int32_t target;     /* needs and puts: which of the field's targets, from 0 */
    int32_t terms;      /* puts and values: coefficients in time of each component, from 1 */
    int64_t tick;       /* coupling steps before the time of the values, or of the step */
    int64_t count;      /* items */
    int64_t bytes;      /* of the body */
    double t;           /* s: of the values */
};

/* A message under construction; wire_send takes its memory. */
struct pack {
    unsigned char *bytes; /* header first; owned */
    size_t n, capacity;   /* bytes in use, bytes allocated */
};

/* A message received: next unread byte of the body at body[at]. Freed by message_free. */
struct message {
    struct message *next; /* in a list of its receiver */
    int peer, rank;       /* which communicator, rank in its remote group */
    struct wire_head head;
    unsigned char *memory, *body; /* the body lies behind the header */
    size_t at;
};

/* The connections of one program and its unfinished sends. */
struct wire {
    int npeers;
    struct wire_peer {
        MPI_Comm comm;    /* intercommunicator, borrowed */
        int size;         /* ranks on the other side */
        const char *name; /* borrowed */
    } peer[WIRE_PEERS];
    struct pending *pending;          /* sends that MPI has not finished */
    size_t piece;                     /* bytes; longer messages travel in pieces. 0: 1 GiB */
    void (*broken)(const char *what); /* a message that cannot be read: must not return */
};

/* The state of one wait: it polls for some 30 us, then sleeps longer and longer, up to 0.2 ms, then
 * 2 % of the time waited so far, at most 10 ms. */
struct backoff {
    double since;   /* s: when the waiting began */
    double checked; /* s: last look at whether all partners are alive */
    long us;        /* microseconds: of the next sleep */
};

/* Seconds of a monotonic clock, for differences alone. */
double wire_time(void);
/* malloc and realloc that abort the program when there is no memory; n = 0 is legal. Freed by
 * free(). */
void *wire_alloc(size_t n);
void *wire_grow(void *p, size_t n);

/* Starts a message with its header; the functions below append to its body. */
void pack_begin(struct pack *p, enum wire_kind kind, int field, int64_t tick);
/* The header of a message under construction; valid until the next pack_... */
struct wire_head *pack_head(struct pack *p);
/* Appends n bytes as they are. */
void pack_bytes(struct pack *p, const void *from, size_t n);
/* Appends n bytes to be filled by the caller at once. */
void *pack_room(struct pack *p, size_t n);
/* Appends a text with its length, and numbers of 8 bytes. */
void pack_text(struct pack *p, const char *text);
void pack_int(struct pack *p, int64_t i);
void pack_real(struct pack *p, double r);

/* The next n bytes of the body, which is read in the order in which it was packed. Reading past the
 * end, here and below, ends the program through wire.broken. */
void take_bytes(struct wire *w, struct message *m, void *to, size_t n);
/* The same without a copy: n bytes of any alignment within the message, borrowed from it. */
const void *take_view(struct wire *w, struct message *m, size_t n);
/* The next text, cut to size - 1 bytes, and the next numbers. */
void take_text(struct wire *w, struct message *m, char *to, size_t size);
int64_t take_int(struct wire *w, struct message *m);
double take_real(struct wire *w, struct message *m);

/* Adds a program; returns its index in peer. comm and name are borrowed. */
int wire_add_peer(struct wire *w, MPI_Comm comm, int size, const char *name);
/* Sends to one rank of a peer without waiting; takes over p's memory and leaves p empty. */
void wire_send(struct wire *w, int peer, int rank, struct pack *p);
/* The same to each rank of a peer. */
void wire_send_all(struct wire *w, int peer, struct pack *p);
/* Receives one message of this peer (-1: of any), owned by the caller (message_free); NULL if none
 * is there. Never blocks for longer than the transfer of one message. */
struct message *wire_poll(struct wire *w, int peer);
/* Advances the sends; true when all are done. */
bool wire_flushed(struct wire *w);
/* Frees the message and sets *m to NULL; *m may be NULL. */
void message_free(struct message **m);

/* Starts a wait; backoff_sleep sleeps once. */
void backoff_begin(struct backoff *n);
void backoff_sleep(struct backoff *n);

/* cpl_client.h - a solver's place in a job: what cpl_client.c (life of a job), cpl_declare.c,
 * cpl_data.c and cpl_take.c (fields) share. Private to libcpl. Every rank of the solver holds the
 * same declarations and its own points and values; rank 0 alone sends what concerns the whole
 * program.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>

#include "../cpl.h"
#include "../transport/transport.h"
#include "cpl_patch.h"

/* Bytes of the text of the last error. */
enum { CPL_TEXT = 4096 };

/* How far this solver is, in the order of a job: after cpl_open, cpl_meet and cpl_ready, within a
 * coupling step, after its cpl_advance, when the coupler has ended the job, after an error that
 * ended the handshake or after cpl_close. */
enum client_state { OPENED, MET, PLANNED, IN_WINDOW, BETWEEN, ENDING, LEFT };

/* Points of a set as of one cpl_move. They are shared by the set and by puts that have not been
 * replaced: `users' counts these, and the last one frees it. */
struct client_places {
    int users;
    long n;
    double *x;      /* [n][3], m */
    int64_t *gid;   /* [n], numbers that are unique over all ranks; NULL: none given */
    double *volume; /* [n], m^dim: weights as sources; NULL: none given */
};

/* A declared set: a grid, or points that move. */
struct client_set {
    char name[CPL_NAME];
    bool is_grid;
    int dim;
    double support, period[3];    /* m; period 0: not periodic */
    struct cpl_grid grid;         /* of a grid */
    struct client_places *places; /* of points, since the last cpl_move; NULL: none yet */
    int moves;                    /* number of cpl_move calls */
    int64_t first, total;         /* of this rank's points among all ranks' */
};

/* Values of one put, kept until the put after the next, since a target that wants them may not have
 * asked yet. */
struct slot {
    int64_t tick;                 /* coupling steps before the time of the values; -1: none */
    double t;                     /* s: that time */
    int terms;                    /* powers of time that were put, 1 to CPL_TERMS */
    double *v[CPL_TERMS];         /* [points or cells][ncomp] each; NULL: zero */
    struct client_places *places; /* where the points were when the values were put */
    int *served; /* [ntargets][ncoupler]: generation of the region that was answered with them */
};

/* A declared field, of which this solver is the source (CPL_PUT) or the target (CPL_GET). */
struct client_field {
    char name[CPL_NAME], unit[CPL_NAME];
    int set, ncomp, how, direction; /* as cpl_field was called */
    int ntargets;                   /* source: number of its targets */
    char partner[CPL_NAME];         /* name of the program at the other side, for messages */
    bool from_grid;                 /* the source's set is a grid */
    struct need {
        int generation;        /* 0: nothing wanted yet */
        struct region region;  /* what a coupler rank wants for a target */
    } * need;                  /* source: [ntargets][ncoupler] */
    struct slot slot[2];       /* source: by tick & 1 */
    int64_t last_tick;         /* source: of the last put, -1 */
    int64_t got_tick;          /* target: of the last patch, -1 */
    int asked_moves;           /* target: moves of the set that the coupler knows */
    struct client_patch patch; /* target */
    struct cpl_grid grid;      /* target: the source's grid */
};

/* The solver's whole state in the job. */
struct cpl {
    char name[CPL_NAME];
    MPI_Comm world, mine;     /* of the whole job; of this program's ranks */
    int rank, size, ncoupler; /* in `mine'; ranks of the coupler */
    enum client_state state;
    int error;             /* 0, or CPL_EPARTNER, which stays */
    char text[CPL_TEXT];   /* of the last error */
    const char *faults;    /* lines for the coupler to print, borrowed until cpl_meet; NULL: none */
    struct wire wire;      /* to the coupler, its only peer */
    struct message *inbox; /* received messages that no call has asked for yet; a list */
    int nzones;
    struct zone {
        char name[CPL_NAME];
        double lo[3], hi[3];
    } zone[LIMIT_ZONES];
    int nsets, nfields;
    struct client_set set[LIMIT_SETS];
    struct client_field field[LIMIT_FIELDS];
    int64_t window; /* number of the coupling step under way or last done; before: of the first */
    double t0, t1;  /* s: begin and end of that coupling step */
    double waited, heard; /* s: spent waiting; wire_time of the coupler's last message */
    /* Keys and values of cpl_tell, sent with the next advance; empty: not begun. */
    struct pack told;
    int64_t ntold;
};

/* Sets the text of cpl_strerror and returns code, for `return client_error(...)'. */
int client_error(struct cpl *c, int code, const char *fmt, ...)
    __attribute__((format(printf, 3, 4)));
/* The same for a call out of order (CPL_EORDER) and for a name that is empty or too long
 * (CPL_EINPUT; CPL_OK if it is sound). */
int client_out_of_order(struct cpl *c, const char *call, const char *when);
int client_check_name(struct cpl *c, const char *what, const char *name);
/* Waits for a message of this kind, field (-1: any), tick and coupler rank, answering the coupler's
 * needs meanwhile; `what' names it in error reports. The caller frees it (message_free). NULL: a
 * partner is gone, and c->error is set. */
struct message *client_await(struct cpl *c, enum wire_kind kind, int field, int64_t tick, int rank,
                             const char *what);
/* CPL_OK, or the error of a call of a field in direction d that does not fit its declaration. */
int client_check_field(struct cpl *c, int field, int d, const char *call);
/* In cpl_data.c: takes a need of the coupler and sends the values at hand that lie in its
 * region. */
void client_need(struct cpl *c, struct message *m);
/* Packs the tick of the last put of each field, from which the coupler finds targets that wait in
 * vain. */
void client_pack_ticks(const struct cpl *c, struct pack *p);
/* Frees what fields and sets hold. */
void client_free_fields(struct cpl *c);

/* cpl_client.h - a solver's place in a job: what cpl_client.c (life of a job),
 * cpl_declare.c, cpl_data.c and cpl_take.c (fields) share. Nothing here is public.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COUPLER_CPL_CLIENT_H
#define COUPLER_CPL_CLIENT_H

#include <stdbool.h>

#include "../cpl.h"
#include "../transport/region.h"
#include "../transport/wire.h"
#include "cpl_patch.h"

enum { CPL_TEXT = 4096 };

/* In the order of a job. */
enum client_state { OPENED, MET, PLANNED, IN_WINDOW, BETWEEN, ENDING, LEFT };

/* Points of a set, shared by the set and by puts that have not been replaced: counted. */
struct client_places {
    int users;
    long n;
    double *x; /* [n][3] */
    int64_t *gid;
    double *volume;
};

struct client_set {
    char name[CPL_NAME];
    bool is_grid;
    int dim;
    double support, period[3]; /* m; period 0: not periodic */
    struct cpl_grid grid;
    struct client_places *places;
    int moves;            /* number of cpl_move calls */
    int64_t first, total; /* of this rank's points among all ranks' */
};

/* Values of one put, kept until the put after the next: who wants them may still be unknown. */
struct slot {
    int64_t tick; /* -1: none */
    double t;
    int terms;
    double *v[CPL_TERMS]; /* terms in time; NULL: zero */
    struct client_places *places;
    int *served; /* [ntakers][ncoupler] generation of the region that was answered */
};

struct client_field {
    char name[CPL_NAME], unit[CPL_NAME];
    int set, ncomp, how, direction;
    int ntakers;            /* giver */
    char partner[CPL_NAME]; /* who gives it, for messages */
    bool from_grid;
    struct need {
        int generation; /* 0: nothing wanted yet */
        struct region region;
    } * need;                  /* giver: [ntakers][ncoupler] */
    struct slot slot[2];       /* giver: by tick & 1 */
    int64_t last_tick;         /* giver: of the last put, -1 */
    int64_t got_tick;          /* taker: of the last patch, -1 */
    int asked_moves;           /* taker: moves of the set that the coupler knows */
    struct client_patch patch; /* taker */
    struct cpl_grid grid;      /* taker: the giver's grid */
};

struct cpl {
    char name[CPL_NAME];
    MPI_Comm world, mine;
    int rank, size, ncoupler;
    enum client_state state;
    int error;           /* CPL_EPARTNER stays */
    char text[CPL_TEXT]; /* of the last error */
    const char *faults;  /* lines for the coupler to print, borrowed until cpl_meet; NULL: none */
    struct wire wire;
    struct message *inbox; /* received, not yet asked for */
    int nzones;
    struct zone {
        char name[CPL_NAME];
        double lo[3], hi[3];
    } zone[LIMIT_ZONES];
    int nsets, nfields;
    struct client_set set[LIMIT_SETS];
    struct client_field field[LIMIT_FIELDS];
    int64_t window; /* number of the coupling step under way or last done; before: of the first */
    double t0, t1, waited, heard;
    struct pack told; /* key, value; empty: not begun */
    int64_t ntold;
};

/* Sets the text; returns code. */
int client_error(struct cpl *c, int code, const char *fmt, ...)
    __attribute__((format(printf, 3, 4)));
int client_out_of_order(struct cpl *c, const char *call, const char *when);
int client_check_name(struct cpl *c, const char *what, const char *name);
/* Waits for a message; serves needs meanwhile. field -1: any. NULL: a partner is gone (c->error
 * set). */
struct message *client_await(struct cpl *c, enum wire_kind kind, int field, int64_t tick, int rank,
                             const char *what);
/* CPL_OK, or why this call of a field is wrong: d is its direction. */
int client_check_field(struct cpl *c, int field, int d, const char *call);
/* cpl_data.c */
void client_need(struct cpl *c, struct message *m);
/* What was put last: the coupler finds those who wait for nothing. */
void client_pack_ticks(const struct cpl *c, struct pack *p);
void client_free_fields(struct cpl *c);

#endif

/* handshake.c - programs are told apart by name, not by place. Nothing here blocks for longer than
 * the deadline: a missing partner in a collective call would be an endless wait without a word.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "handshake.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../cpl.h"
#include "alive.h"
#include "failure.h"
#include "wire.h"

enum { TAG = 76, MAGIC = 0x4f4c4c45, EXIT_INPUT = 2 };
static const char coupler[] = "coupler";

struct hello {
    uint32_t magic;
    uint16_t version, protocol; /* of cpl.h, of wire.h */
    int64_t pid;
    char name[HANDSHAKE_NAME];
    char host[48];
};
_Static_assert(sizeof(struct hello) == 128, "the record is part of the protocol");

/* The lowest rank of each program that was heard speaks for it. */
static bool speaks(const struct hello *all, const int *heard, int rank)
{
    for (int r = 0; r < rank; r++)
        if (heard[r] && strncmp(all[r].name, all[rank].name, HANDSHAKE_NAME) == 0)
            return false;
    return true;
}

/* Names who was not heard; of the ranks that know, one of each program speaks. */
static _Noreturn void too_late(MPI_Comm world, const struct hello *all, const int *heard, double s)
{
    char text[400] = "";
    int rank, size;
    MPI_Comm_rank(world, &rank);
    MPI_Comm_size(world, &size);
    int n = snprintf(text, sizeof text, "after %g s no message from world rank", s);
    for (int r = 0; r < size && n < 250; r++)
        if (!heard[r])
            n += snprintf(text + n, sizeof text - (size_t)n, " %d", r);
    n += snprintf(text + n, sizeof text - (size_t)n, "; heard");
    for (int r = 0; r < size && n < 340; r++)
        if (heard[r] && r != rank)
            n += snprintf(text + n, sizeof text - (size_t)n, " %.20s (%d)", all[r].name, r);
    if (speaks(all, heard, rank))
        failure_die(EXIT_INPUT, text);
    usleep(300000); /* the one who speaks ends the job */
    MPI_Abort(world, EXIT_INPUT);
    abort();
}

/* Of a longer name, its beginning and a number that stands for all of it (FNV-1a): hosts must not
 * be taken for one another, and the record cannot grow, for programs of other versions read it. */
static void name_host(char *to, size_t size)
{
    char name[300] = "";
    uint64_t hash = 14695981039346656037u;
    (void)gethostname(name, sizeof name - 1);
    for (const char *at = name; *at; at++)
        hash = (hash ^ (unsigned char)*at) * 1099511628211u;
    if (strlen(name) < size)
        memcpy(to, name, strlen(name) + 1);
    else
        snprintf(to, size, "%.30s~%016llx", name, (unsigned long long)hash);
}

/* Records of all ranks of the world. Every rank tells every other one who it is, point to point,
 * with a deadline: size^2 messages of 128 bytes, once. */
static struct hello *exchange(MPI_Comm world, const char *name, int version, int rank, int size,
                              double deadline)
{
    struct hello *all = wire_alloc((size_t)size * sizeof *all), *own = &all[rank];
    MPI_Request *request = wire_alloc(2 * (size_t)size * sizeof *request);
    int *heard = wire_alloc((size_t)size * sizeof *heard);
    memset(own, 0, sizeof *own);
    own->magic = MAGIC;
    own->version = (uint16_t)version;
    own->protocol = WIRE_VERSION;
    own->pid = (int64_t)getpid();
    snprintf(own->name, sizeof own->name, "%s", name);
    name_host(own->host, sizeof own->host);
    for (int r = 0; r < size; r++) {
        heard[r] = r == rank;
        request[r] = request[size + r] = MPI_REQUEST_NULL;
        if (r == rank)
            continue;
        MPI_Irecv(&all[r], (int)sizeof *all, MPI_BYTE, r, TAG, world, &request[r]);
        MPI_Isend(own, (int)sizeof *own, MPI_BYTE, r, TAG, world, &request[size + r]);
    }
    struct backoff backoff;
    backoff_begin(&backoff);
    for (int left = size - 1; left > 0;) {
        for (int r = 0; r < size; r++)
            if (!heard[r]) {
                MPI_Test(&request[r], &heard[r], MPI_STATUS_IGNORE);
                left -= heard[r];
            }
        if (left > 0 && wire_time() - backoff.since > deadline)
            too_late(world, all, heard, deadline);
        if (left > 0)
            backoff_sleep(&backoff);
    }
    /* All have spoken, so all have posted their receives. */
    MPI_Waitall(2 * size, request, MPI_STATUSES_IGNORE);
    free(request);
    free(heard);
    return all;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct handshake_program *)a)->name,
                  ((const struct handshake_program *)b)->name);
}

/* By name, in alphabetical order, so that all ranks number them alike; the leader is the lowest
 * rank of the world. */
static void list_programs(struct handshake *h, const struct hello *all, int size)
{
    for (int r = 0; r < size; r++) {
        int p = 0;
        while (p < h->nprograms && strcmp(h->program[p].name, all[r].name) != 0)
            p++;
        if (p == HANDSHAKE_PROGRAMS)
            failure_die(EXIT_INPUT,
                        "more programs in one job than this version knows: 31 beside the coupler");
        if (p == h->nprograms) {
            h->nprograms++;
            h->program[p] = (struct handshake_program){.leader = r, .inter = MPI_COMM_NULL};
            memcpy(h->program[p].name, all[r].name, HANDSHAKE_NAME);
        }
        h->program[p].size++;
    }
    qsort(h->program, (size_t)h->nprograms, sizeof h->program[0], by_name);
}

/* Who cannot read the others' messages cannot leave in order. */
static void check_versions(const struct hello *all, int rank, int size, int version)
{
    char text[400];
    if (version != CPL_VERSION) {
        snprintf(text, sizeof text,
                 "this program was compiled with cpl.h %d, but its libcpl is %d: compile it again, "
                 "or give it the library of its header (LD_LIBRARY_PATH, ldd)",
                 version, CPL_VERSION);
        failure_die(EXIT_INPUT, text);
    }
    for (int r = 0; r < size; r++) {
        const struct hello *o = &all[r], *own = &all[rank];
        if (o->magic == MAGIC && o->version == own->version && o->protocol == own->protocol)
            continue;
        snprintf(text, sizeof text,
                 "programs of different versions in one job: %.64s has cpl.h %d, protocol %d, "
                 "%.64s has cpl.h %d, protocol %d: build them with the same libcpl",
                 own->name, own->version, own->protocol, o->name, o->version, o->protocol);
        failure_die(EXIT_INPUT, text);
    }
}

/* A job has a coupler and somebody beside it. */
static void check_programs(struct handshake *h)
{
    if (h->nprograms == 1 && h->coupler < 0)
        return;
    if (h->coupler < 0) {
        int n = snprintf(h->text, sizeof h->text, "no program `coupler' in this job, only");
        for (int p = 0; p < h->nprograms; p++)
            n += snprintf(h->text + n, sizeof h->text - (size_t)n, " %s (%d ranks)",
                          h->program[p].name, h->program[p].size);
    } else if (h->nprograms == 1) {
        snprintf(h->text, sizeof h->text,
                 "the coupler is alone: start solvers beside it "
                 "(cases/run does)");
    }
}

/* An intercommunicator between the coupler and each solver. Solvers have none with each other: all
 * goes by way of the coupler. */
static void connect(MPI_Comm world, struct handshake *h)
{
    struct handshake_program *const cpl = &h->program[h->coupler];
    for (int p = 0; p < h->nprograms; p++) {
        struct handshake_program *const solver = &h->program[p];
        if (p == h->coupler || (h->me != p && h->me != h->coupler))
            continue;
        struct handshake_program *const other = h->me == p ? cpl : solver;
        MPI_Intercomm_create(h->mine, 0, world, other->leader, TAG + 1 + p, &other->inter);
    }
}

/* The first rank of this program on its host, which is another one than ours. */
static bool first_elsewhere(const struct hello *all, int rank, int r)
{
    if (strcmp(all[r].host, all[rank].host) == 0)
        return false;
    for (int q = 0; q < r; q++)
        if (strcmp(all[q].host, all[r].host) == 0 && strcmp(all[q].name, all[r].name) == 0)
            return false;
    return true;
}

/* Those on this host can be seen to die. */
static void watch(const struct handshake *h, const struct hello *all, int rank, int size)
{
    for (int p = 0; p < h->nprograms; p++)
        for (int r = 0, place = 0; r < size; r++)
            if (strcmp(all[r].name, h->program[p].name) == 0) {
                if (strcmp(all[r].host, all[rank].host) == 0)
                    failure_watch(h->program[p].name, place, (long)all[r].pid);
                if (first_elsewhere(all, rank, r))
                    failure_elsewhere(h->program[p].name, all[r].host);
                if (r != rank)
                    alive_add(h->program[p].name, place);
                place++;
            }
}

/* It is the name of files, and of groups of summary.json. */
static void check_name(const char *name)
{
    char text[200];
    if (name[0] && strlen(name) < HANDSHAKE_NAME && strcspn(name, "/. \t\n\"") == strlen(name))
        return;
    snprintf(text, sizeof text,
             "`%.80s' cannot be the name of a program: 1 to %d bytes without spaces, dots, slashes "
             "and quotes",
             name, HANDSHAKE_NAME - 1);
    failure_die(EXIT_INPUT, text);
}

/* Returns 0 or -2, on all ranks alike, with the reason in h->text. A program alone has passed as
 * well, and has no job. */
int handshake(MPI_Comm world, const char *name, double deadline_s, int version, struct handshake *h)
{
    int rank, size;
    MPI_Comm_rank(world, &rank);
    MPI_Comm_size(world, &size);
    *h = (struct handshake){.coupler = -1, .mine = MPI_COMM_NULL};
    failure_open(world, name, rank); /* its world rank: the place in the program is not known yet */
    check_name(name);
    struct hello *all = exchange(world, name, version, rank, size, deadline_s);
    check_versions(all, rank, size, version);
    list_programs(h, all, size);
    for (int p = 0; p < h->nprograms; p++) {
        if (strcmp(h->program[p].name, coupler) == 0)
            h->coupler = p;
        if (strcmp(h->program[p].name, all[rank].name) == 0)
            h->me = p;
    }
    check_programs(h);
    int place = 0;
    for (int r = 0; r < rank; r++)
        place += strcmp(all[r].name, all[rank].name) == 0;
    failure_open(world, name, place);
    watch(h, all, rank, size);
    MPI_Comm_split(world, h->program[h->me].leader, rank, &h->mine);
    if (!h->text[0] && h->coupler >= 0)
        connect(world, h);
    if (h->text[0] || h->nprograms == 1)
        failure_closed();
    free(all);
    return h->text[0] ? -2 : 0;
}

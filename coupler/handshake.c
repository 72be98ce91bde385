/* handshake.c - programs are told apart by name, not by place. Nothing here blocks for longer than
 * the deadline: a missing partner in a collective call would be an endless wait without a word.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "handshake.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "alive.h"
#include "failure.h"
#include "wire.h"

enum { TAG = 76, MAGIC = 0x4f4c4c45, EXIT_INPUT = 2 };
static const char coupler[] = "coupler";

struct hello {
    uint32_t magic, version;
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

static _Noreturn void too_late(MPI_Comm world, const struct hello *all, const int *heard, double s)
{
    char text[400] = "";
    int rank, size;
    MPI_Comm_rank(world, &rank);
    MPI_Comm_size(world, &size);
    int n = snprintf(text, sizeof text, "after %g s no word from world rank", s);
    for (int r = 0; r < size && n < 250; r++)
        if (!heard[r])
            n += snprintf(text + n, sizeof text - (size_t)n, " %d", r);
    n += snprintf(text + n, sizeof text - (size_t)n, "; heard");
    for (int r = 0; r < size && n < 340; r++)
        if (heard[r] && r != rank)
            n += snprintf(text + n, sizeof text - (size_t)n, " %.12s (%d)", all[r].name, r);
    if (speaks(all, heard, rank))
        failure_die(EXIT_INPUT, text);
    usleep(300000); /* the one who speaks ends the job */
    MPI_Abort(world, EXIT_INPUT);
    abort();
}

/* Records of all ranks of the world. */
static struct hello *exchange(MPI_Comm world, const char *name, int rank, int size, double deadline)
{
    struct hello *all = wire_alloc((size_t)size * sizeof *all), *own = &all[rank];
    MPI_Request *request = wire_alloc(2 * (size_t)size * sizeof *request);
    int *heard = wire_alloc((size_t)size * sizeof *heard);
    memset(own, 0, sizeof *own);
    own->magic = MAGIC;
    own->version = WIRE_VERSION;
    own->pid = (int64_t)getpid();
    snprintf(own->name, sizeof own->name, "%s", name);
    (void)gethostname(own->host, sizeof own->host - 1);
    for (int r = 0; r < size; r++) {
        heard[r] = r == rank;
        request[r] = request[size + r] = MPI_REQUEST_NULL;
        if (r == rank)
            continue;
        MPI_Irecv(&all[r], (int)sizeof *all, MPI_BYTE, r, TAG, world, &request[r]);
        MPI_Isend(own, (int)sizeof *own, MPI_BYTE, r, TAG, world, &request[size + r]);
    }
    struct nap nap;
    nap_begin(&nap);
    for (int left = size - 1; left > 0;) {
        for (int r = 0; r < size; r++)
            if (!heard[r]) {
                MPI_Test(&request[r], &heard[r], MPI_STATUS_IGNORE);
                left -= heard[r];
            }
        if (left > 0 && wire_time() - nap.since > deadline)
            too_late(world, all, heard, deadline);
        if (left > 0)
            nap_take(&nap);
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

static void list_programs(struct handshake *h, const struct hello *all, int size)
{
    for (int r = 0; r < size; r++) {
        int p = 0;
        while (p < h->nprograms && strcmp(h->program[p].name, all[r].name) != 0)
            p++;
        if (p == HANDSHAKE_PROGRAMS)
            failure_die(EXIT_INPUT, "more programs in one job than this version knows");
        if (p == h->nprograms) {
            h->nprograms++;
            h->program[p] = (struct handshake_program){.leader = r, .inter = MPI_COMM_NULL};
            memcpy(h->program[p].name, all[r].name, HANDSHAKE_NAME);
        }
        h->program[p].size++;
    }
    qsort(h->program, (size_t)h->nprograms, sizeof h->program[0], by_name);
}

static void check_records(struct handshake *h, const struct hello *all, int size)
{
    for (int r = 0; r < size; r++)
        if (all[r].magic != MAGIC || all[r].version != WIRE_VERSION)
            failure_die(EXIT_INPUT,
                        "programs of different versions in one job: build them together");
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

/* Those on this host can be seen to die. */
static void watch(const struct handshake *h, const struct hello *all, int rank, int size)
{
    for (int p = 0; p < h->nprograms; p++)
        for (int r = 0, place = 0; r < size; r++)
            if (strcmp(all[r].name, h->program[p].name) == 0) {
                if (strcmp(all[r].host, all[rank].host) == 0)
                    failure_watch(h->program[p].name, place, (long)all[r].pid);
                if (r != rank)
                    alive_add(h->program[p].name, place);
                place++;
            }
}

int handshake(MPI_Comm world, const char *name, double deadline_s, struct handshake *h)
{
    int rank, size;
    MPI_Comm_rank(world, &rank);
    MPI_Comm_size(world, &size);
    *h = (struct handshake){.coupler = -1, .mine = MPI_COMM_NULL};
    failure_open(world, name, rank); /* its world rank: the place in the program is not known yet */
    struct hello *all = exchange(world, name, rank, size, deadline_s);
    list_programs(h, all, size);
    for (int p = 0; p < h->nprograms; p++) {
        if (strcmp(h->program[p].name, coupler) == 0)
            h->coupler = p;
        if (strcmp(h->program[p].name, all[rank].name) == 0)
            h->me = p;
    }
    check_records(h, all, size);
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

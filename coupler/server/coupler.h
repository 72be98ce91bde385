/* coupler.h - the whole state of the coupler and what its modules offer each other. All ranks of
 * the coupler know the same plan; rank 0 alone decides coupling steps and writes files, and all of
 * them bring fields together, each for its share of the targets. A tick counts coupling steps: tick
 * k is the start of step k.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/run/run.h"
#include "../cpl.h"
#include "../mapping/map.h"
#include "../transport/transport.h"
#include "job.h"

/* Bytes of a list of problems that all programs print. */
enum { TEXT = 4096 };

/* What one program reported with cpl_tell: the last value of each key, in the order of their first
 * mention. */
struct told {
    int n;     /* keys in `of' */
    bool full; /* there were more keys than fit, which has been logged */
    struct told_number {
        char key[TOLD_KEY];
        double value;
    } of[TOLD_KEYS];
};

/* A program of the job other than the coupler: what it declared and how far it is. */
struct solver {
    const char *name;            /* borrowed from the handshake */
    int size, peer;              /* ranks; its place in wire */
    bool met, ready, has_closed; /* its WIRE_MEET, WIRE_READY and all its WIRE_CLOSE are here */
    int64_t restart_window;      /* coupling step that it restarts at, -1: at the start */
    uint64_t hash;               /* of its case; 0: it has read none */
    int faults, nzones;          /* faults of its input, boxes that it published */
    char fault_lines[TEXT], dir[1024]; /* what is wrong with its input; -o */
    struct named_box {
        char name[CPL_NAME];
        double lo[3], hi[3];
    } zone[LIMIT_ZONES];
    double t, dt_longest; /* s: where it starts, the longest coupling step it wants */
    int nsets, nfields;
    struct solver_set {
        char name[CPL_NAME];
        bool is_grid;
        int dim;
        double support, period[3]; /* m, of points */
        struct cpl_grid grid;      /* of a grid */
    } set[LIMIT_SETS];
    struct solver_field {
        char name[CPL_NAME], unit[CPL_NAME];
        int set, ncomp, direction, how;      /* as its cpl_field said */
        int link;                            /* target: its link, -1: none */
        int ntargets, target[LIMIT_TARGETS]; /* source: the links of its targets */
        int64_t last_tick; /* source: of its last put, as of its last advance or get */
    } field[LIMIT_FIELDS];
    int64_t advanced;                      /* last coupling step done, -1: none */
    int nclosed, code;                     /* ranks that have closed; the worst code among them */
    double waited, cpu;                    /* s; cpu summed over ranks, known at the end */
    double heard;                          /* wire_time of its last message */
    double advanced_at;                    /* wall time of its last advance */
    double waited_for[HANDSHAKE_PROGRAMS]; /* s, of `waited', for each solver; the rest: coupler */
    struct told told;                      /* its last report */
};

/* A field on its way from one solver, the source, to another, the target: rendezvous.c. */
struct partner_link {
    int source, gfield, target, tfield; /* solver and its field */
    bool from_grid;                     /* the target gets a patch, not mapped values */
    int ncomp, dim;
    int number;                /* among the targets of the source's field */
    map_points *map;           /* consistent mappings; NULL: conservative, `deal' says which */
    enum map_dealing deal;     /* conservative ones */
    struct cpl_grid grid;      /* of the source */
    double support, period[3]; /* m: radius of the mapping; period 0: not periodic */
    /* what this rank has announced that it wants */
    int generation; /* of the region, from 1; 0: none announced */
    bool moved;     /* targets have moved since */
    struct region region;
    /* what targets asked for; by rank of the target */
    int64_t asked_tick;  /* -1: nothing asked */
    int nasked, naskers; /* ranks that have asked, and how many will */
    double asked_at;     /* wall time at which the last of them has */
    struct asker {
        bool asked;
        long ntarget;        /* conservative mappings: all of this rank, not only our share */
        double *x;           /* [ntarget][dim], m */
        int64_t *gid;        /* conservative mappings: [ntarget] */
        double *volume;      /* the same, m^dim: weights of the targets */
        double lo[3], hi[3]; /* grids: the box wanted */
    } * asker;
    struct arrival {
        int64_t tick;         /* -1: nothing */
        int n;                /* puts of the present generation */
        double t;             /* s: of the values */
        struct message **put; /* [ranks of the source] */
    } in[2];                  /* by tick & 1 */
    double mapped;            /* s spent here */
    int64_t served;           /* requests that this rank has answered */
};

/* The coupler's state; one per process. */
struct coupler {
    MPI_Comm world, comm; /* of the whole job; of the coupler's ranks */
    int rank, size;       /* in comm */
    struct handshake who; /* the programs of the job */
    struct wire wire;     /* to the solvers, in their order, and among the coupler's ranks */
    int own_peer;         /* the place in wire of the coupler's own ranks */
    const struct command_line *command;
    struct job job;     /* group coupler of the case */
    struct scene scene; /* of a case that all programs share; else what a case leaves out */
    struct params *params;
    uint64_t hash;                  /* params_hash of the case */
    char dir[1024], case_dir[1024]; /* output folder; folder of the case file */
    int nsolvers;
    struct solver solver[HANDSHAKE_PROGRAMS];
    int nlinks;
    struct partner_link link[LIMIT_LINKS];
    /* time: equal coupling steps, of which the `base'-th begins at t_base, and the nwindows-th
     * would begin at t_end; 0 and t_start but where a restart has divided the rest anew */
    double t_start, t_base, t_end;
    int64_t base, nwindows, window, first_window; /* window: under way */
    int action;
    bool stopping, over;
    int code;
    double start, line_at, line_every, save_wall, stall_at, stall_every;
    double idle, bound;  /* s waited; simulated time of the next checkpoint */
    int64_t said;        /* coupling step that failure_doing knows */
    int64_t line_window; /* of the last progress line */
    double first_end;    /* s: when the first coupling step of this run, and its start, was over */
    /* A solver tells of its restart file after it has ended the coupling step, when the next may be
     * under way; never two later. By window & 1. */
    struct save {
        int64_t window;
        int n; /* solvers whose file is complete */
        char file[HANDSHAKE_PROGRAMS][SAVED_NAME];
    } save[2], last;          /* last: the restart point before */
    struct server_sums *sums; /* sums.c; NULL: nobody reports any */
};

/* Appends one line to text[TEXT], a list of problems that all programs print; cut when it is
 * full. */
void problem(char *text, const char *fmt, ...) __attribute__((format(printf, 2, 3)));

/* plan.c: the handshake and what the programs declare. Takes the first message of a solver: hash,
 * faults, restart step, zones. */
void plan_take_meet(struct coupler *c, struct solver *s, struct message *m);
/* Takes its sets and fields. */
void plan_take_ready(struct coupler *c, struct solver *s, struct message *m);
/* Prints what the solvers found wrong in their input, each line once, without those of `own', which
 * have been printed already (NULL: none). */
void plan_say_faults(const struct coupler *c, const char *own);
/* Adds to text[TEXT] where the programs contradict each other: hash, restart step, faults. */
void plan_check_meet(struct coupler *c, char *text);
/* Makes the links from the declared fields and adds the problems to text. The same on all ranks. */
void plan_make_links(struct coupler *c, char *text);
/* Sends the acceptance, or all problems in text, to all solvers. */
void plan_answer_meet(struct coupler *c, const char *text);
/* The same after plan_make_links, with the sources of each solver's fields. */
void plan_answer_ready(struct coupler *c, const char *text);
/* Logs the plan. */
void plan_describe(const struct coupler *c);

/* window.c: coupling steps in integers, so that all programs agree on times to the bit. Divides the
 * span into equal steps; problems are added to text. */
void window_divide(struct coupler *c, char *text);
/* s from the last output, or from the start, to t_base. */
double window_since(const struct coupler *c);
/* Time at which coupling step k starts, s. */
double window_start(const struct coupler *c, int64_t k);
/* Sends the next coupling step, or the end, to all solvers. */
void window_announce(struct coupler *c);
/* Takes the message that a solver has done a step. */
void window_advance(struct coupler *c, struct solver *s, struct message *m);

/* rendezvous.c: brings the values of sources to the points of targets. Prepares the links. */
void rendezvous_open(struct coupler *c);
/* Takes a target's request with its points or box. */
void rendezvous_get(struct coupler *c, struct solver *s, struct message *m);
/* Takes a source's values; may keep the message, and then sets *m to NULL. */
void rendezvous_put(struct coupler *c, struct solver *s, struct message **m);
/* Takes how far each field of a solver has been put. */
void rendezvous_take_ticks(struct coupler *c, struct solver *s, struct message *m);
/* true: a source has gone past what a target waits for, or programs wait for each other; text says
 * so. */
bool rendezvous_starved(const struct coupler *c, char *text);
/* true: on this rank a target asks for values of a time at which its source has put none. */
bool rendezvous_skipped(const struct coupler *c, char *text);
/* Writes to text who waits for what. */
void rendezvous_waiting(const struct coupler *c, char *text);
/* Frees the links. */
void rendezvous_close(struct coupler *c);

/* checkpoint.c: a restart point exists when its manifest does. At a restart takes the old point's
 * files from the manifest, so that they are removed when two newer points exist; rank 0. */
void checkpoint_resume(struct coupler *c);
/* Takes the message that a solver's restart file is complete; writes the manifest with the last of
 * them. */
void checkpoint_saved(struct coupler *c, struct solver *s, struct message *m);

/* sums.c, rank 0: sums over all programs, "sum.kinetic", at the end of a coupling step. */
void sums_window(struct coupler *c);
/* The same at the end of the job. */
void sums_summarise(const struct coupler *c, struct summary *to);

/* report.c: progress lines and the summary of the job. Takes the keys and values in a message. */
void report_told(struct wire *w, struct message *m, struct told *t);
void report_progress(struct coupler *c);
/* Writes summary.json, judges the case's criteria and returns the job's exit code. */
int report_summary(struct coupler *c, double coupler_cpu);

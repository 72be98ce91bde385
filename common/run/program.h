/* program.h - the life of a solver program: command line, case, output folder, time loop, signals,
 * snapshots, restart files, summary, exit code. A solver fills a struct program and its main calls
 * run_main; a coupled job is reached through a struct partner (coupler/cpl_partner.h), so that
 * nothing here knows the coupler. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../base/base.h"
#include "../files/files.h"
#include "../params/params.h"
#include "../scene/scene.h"

struct h5;
struct picture;
struct xdmf;

/* The run as every module of a program may see it; owned by run_main. All members are the same on
 * all ranks but rank and timers, and what is said to be rank 0's. */
struct run {
    MPI_Comm comm; /* this program's ranks */
    int rank, size;
    const char *name; /* "sph" */
    struct scene scene;
    const struct params *params;
    char dir[1024]; /* output folder */
    char case_name[256];
    char case_dir[1024];          /* folder of the case file */
    struct motion_files *motions; /* read so far; motion_files.h */
    bool restart;                 /* the state comes from a restart file */
    bool coupled;                 /* other programs take part in the job */
    /* Coupled, and the free surface crosses open sides of a box of particles: crossing.h. */
    bool crossed;
    bool gauge_elsewhere[PROBES_MAX]; /* a partner reads the gauge: crossing_deal */
    const struct partner *partner;    /* NULL when alone */
    void *partner_ctx;                /* its state (struct cpl *) */
    struct timers timers;
    bool mean_discharges; /* in rows of series.csv, over the time since the row before: create */
    struct summary *summary;
    double t, dt; /* s: current time, last step */
    int64_t step;
};

/* Why a run cannot go on, in the words of its error message. Filled on every rank alike, or on the
 * rank where it happened and then spread by run_diagnose. */
struct diagnosis {
    bool bad;         /* the run must end; the texts are set */
    char reason[256]; /* "|u| of particle 48213 is 114 m/s, limit 5 m/s" */
    char where[256];  /* "(0.25, 0.60) m, rank 0, in the buffer" */
    char likely[256]; /* cause and what to try */
};

/* What a solver provides to run_main: its names, its part of the parameter table and its functions.
 * `s' is the state that `create' returned; create, destroy, step and all that take s are collective
 * over r->comm. Order of the calls: meshes, complete, check, offer, describe, create,
 * longest_window, first, then steps with rows, snapshots and checkpoints between them, finish,
 * destroy. */
struct program {
    const char *name; /* "sph": name of its group, of its files */
    const char *help; /* one sentence */
    /* Version of the contents of its restart files. It is raised when a name, a unit, a column, a
     * bit or the meaning of a number changes, so that older files are refused. */
    int meaning;
    const struct param_group *groups; /* its own groups beside the scene's */
    int ngroups;
    const char *const *other_groups; /* groups that other programs check; NULL-terminated */
    /* Reads the meshes that the scene names (scene_meshes_read); NULL: the program knows none, and
     * a case that has some is refused. */
    void (*meshes)(struct scene *s, const char *case_dir, const struct params *p, MPI_Comm comm,
                   struct faults *f);
    unsigned
        mesh_owners; /* whose it knows, bits 1 << enum mesh_owner; in a coupled job all or none */
    /* Adds to the scene what the case may leave open to this program; before check. NULL:
     * nothing. */
    void (*complete)(struct run *r);
    /* Adds the faults that need more than one key; may be NULL. */
    void (*check)(const struct run *r, struct faults *f);
    /* Lines of --check and of the banner: what the scene uses and leaves out, sizes, memory, time
     * step, number of steps; through log_say. Runs on the parameters alone, before create. */
    void (*describe)(const struct run *r);
    /* Adds zones, blocks, ... to the picture of --check=picture; NULL: nothing. Called on rank
     * 0. */
    void (*draw)(const struct run *r, struct picture *p);
    /* Publishes what the partners must know before the plan (zones); NULL if nothing. */
    void (*offer)(struct run *r);
    /* Makes the state at t = 0, or from the restart file f; r->t and r->step are set before the
     * call. NULL: f does not fit, and the reason has been logged. */
    void *(*create)(struct run *r, struct h5 *f);
    void (*destroy)(void *s);
    /* Advances by one step of at most t_stop - r->t and returns its size, s. A step lands on t_stop
     * exactly when that is within reach: the last steps before it are made equal. Sets d->bad on
     * all ranks when the state cannot be trusted. */
    double (*step)(void *s, double t_stop, struct diagnosis *d);
    /* Coupled: the longest coupling step that suits this program, s; NULL: it has no wish. */
    double (*longest_window)(void *s);
    /* Coupled: sends the fields that partners need before the first coupling step; NULL:
     * nothing. */
    void (*first)(void *s);
    /* Coupled: before the first step of a coupling step and after its last; NULL when never
     * coupled. */
    void (*window_begin)(void *s, double t0, double t1);
    void (*window_end)(void *s, double t1);
    /* Coupled: adds to `report' sums over this program's part of the flow at the end of a coupling
     * step, as "sum.kinetic"; the coupler adds them up over the programs. NULL: none. */
    void (*tell)(void *s, struct summary *report);
    /* Adds the columns of series.csv beyond "t [s]" and "dt [s]", the same in each row; rank 0's
     * count. NULL: there are none. */
    void (*row)(void *s, struct figures *to);
    /* Steps between two rows where the case does not say; NULL: 10. */
    int (*steps_between_rows)(const struct run *r);
    /* Text of the progress line without t and %: "dt 0.75 ms (sound)  Ma 0.062 ...". Rank 0's
     * counts. */
    void (*progress)(void *s, char *line, int size);
    /* Writes the fields of a snapshot into f, and its entry into x (NULL except on rank 0); `file'
     * is the name of f without folder. */
    void (*snapshot)(void *s, struct h5 *f, struct xdmf *x, const char *file);
    /* Writes all that create needs to go on bit for bit; t and step are written by run itself. */
    void (*checkpoint)(void *s, struct h5 *f);
    /* Adds errors, drifts and counts to r->summary. If it sets the text "not_accepted", that says
     * why a run that reached its end must not be trusted: the exit code is RUN_NOT_ACCEPTED. */
    void (*finish)(void *s);
};

/* How a program takes part in a coupled job; coupler/cpl_partner.h provides the one that exists.
 * ctx is the state made by open. Every function but fail, waited and window_number is collective
 * over the program. A window is a coupling step. */
struct partner {
    /* Handshake with the world's programs under the name `name' within `deadline', s; afterwards a
     * partner without a sign of life for `patience', s, ends the job. Sets *comm to this program's
     * ranks and *ctx, which is NULL when no other program is there. Returns 0, or the exit code
     * (reason printed). */
    int (*open)(MPI_Comm world, const char *name, double deadline, double patience, MPI_Comm *comm,
                void **ctx);
    /* After the case was read and program.offer was called: all programs compare the case's hash,
     * the window of their restart file (-1: fresh start) and whether they found faults; the lines
     * of f are printed once for all programs. sound: no faults, and the folder dir exists. Returns
     * 0, or the exit code. */
    int (*meet)(void *ctx, const struct faults *f, bool sound, unsigned long long hash,
                int64_t window, const char *dir);
    /* After create, which declares sets and fields: the coupler checks the plan. t: time of the
     * start, s; dt_longest: longest coupling step, s. Returns 0, or the exit code. */
    int (*ready)(void *ctx, double t, double dt_longest);
    /* Gets the next coupling step [*t0, *t1], s, and whether an output or a restart file is due at
     * its end. false: the job ends, *code says how (RUN_DONE, RUN_STOPPED or RUN_DIVERGED). */
    bool (*window)(void *ctx, double *t0, double *t1, bool *output, bool *save, int *code);
    /* Reports that the coupling step up to t1 is done. The numbers of `report' go to the coupler's
     * progress line and summary; stop asks for an orderly end of the job. */
    void (*advance)(void *ctx, double t1, const struct summary *report, bool stop);
    /* Reports that a restart file of this coupling step is complete on disk. */
    void (*saved)(void *ctx, int64_t window, const char *file);
    int64_t (*window_number)(void *ctx); /* of the coupling step under way or last done */
    double (*waited)(void *ctx);         /* s spent waiting for partners */
    /* Reports to all partners why this program stops and ends the job with this exit code; does not
     * return. */
    void (*fail)(void *ctx, int code, const char *reason);
    /* Sends the final numbers to the coupler's summary and leaves the job; ctx is freed. */
    void (*close)(void *ctx, int code, const struct summary *final);
};

/* Runs a program from MPI_Init to MPI_Finalize and returns the exit code of main. partner may be
 * NULL: the program always runs alone. */
int run_main(int argc, char **argv, const struct program *p, const struct partner *partner);

/* The command line, for programs that do not use run_main's loop (the coupler) as well. Texts are
 * borrowed from argv or from static buffers. */
struct command_line {
    const char *case_file; /* path as given, or cases/NAME/case.cfg found from NAME */
    const char *dir;       /* -o, or out/CASE */
    const char *as; /* --as: name of one of several programs of a kind; NULL: the kind's own */
    int noverrides; /* number of -p GROUP.KEY=VALUE */
    const char *const *overrides;
    /* --check, --check=picture, --check=waves, --restart, --force, --groups. */
    bool check, picture, waves, restart, force, groups;
    double deadline; /* s to meet the other programs */
    double patience; /* s without a sign of life of a partner */
};
/* The folder of a case's file ("." if the path has none) and the case's name: that of the folder
 * for case.cfg, else of the file without .cfg. Cut to `size' bytes. */
void run_case_dir(const char *file, char *dir, size_t size);
void run_case_name(const char *file, char *name, size_t size);
/* Parses the command line. Returns -1 to go on, else the exit code (--help, --version, --params: 0;
 * faults: RUN_INPUT), everything having been printed by one rank. */
int run_command_line(struct command_line *c, int argc, char **argv, const char *name,
                     const char *help, const struct param_group *groups, int ngroups);
/* Makes the output folder and locks it for this process until it ends. Returns 0, or RUN_INPUT with
 * the reason printed: the folder holds a run of this program already and neither force nor restart
 * is set, restart is set and there is no folder, it cannot be made, or another process works in it.
 * With force and without restart the program's old files are removed. Collective over comm. */
int run_folder(MPI_Comm comm, const char *dir, const char *name, bool force, bool restart);
/* Adds a fault at `key' if n units (particles, cells) that need `bytes' bytes in all are more than
 * the program's ranks can count (1e9 each) or their hosts can hold; hosts are assumed to be alike.
 * Collective over r->comm. */
void run_check_memory(const struct run *r, struct faults *f, const char *key, double n,
                      const char *unit, double bytes);
/* Makes a folder and all above it; false: errno says why. Local to a rank. */
bool run_make_folder(const char *dir);
/* Removes from dir the restart files of program `name' that are older than `newest' (a file's
 * name), but for `older', the one before it. Newer ones, of a coupling step under way, stay. Rank
 * 0. */
void run_prune(const char *dir, const char *name, const char *newest, const char *older);

/* Installs the handlers. SIGINT, SIGTERM and SIGUSR1 set a flag (signals_stop); SIGSEGV, SIGFPE,
 * SIGBUS and SIGABRT write a failure report to the file of signals_note_path. A SIGTERM of the
 * launcher that is not followed by an orderly end within 0.8 s makes the handler print that report,
 * or what was last heard of the partners, and leave with RUN_PARTNER. */
void signals_install(const char *program, int rank);
/* Calls MPI_Init. A program that was launched with others waits at most 120 s, then exits with
 * RUN_INPUT: a member of the job that is no MPI program would keep it waiting in silence. A signal
 * before signals_install ends the program with one line of text. */
void signals_start_mpi(int *argc, char ***argv, const char *program);
/* Whether this rank was asked to stop. Ranks may differ: reduce it before branching. */
bool signals_stop(void);
/* An orderly stop is under way: from now on the handler sets no deadline. */
void signals_handled(void);
/* The time loop now looks at signals_stop. Before this call a signal ends a program that runs alone
 * at once. */
void signals_started(void);
/* Path of the failure report that the programs of a job share; the first to fail writes it.
 * Copied. */
void signals_note_path(const char *path);
/* What the handler prints when there is no failure report; copied. */
void signals_heard(const char *text);
/* What the handler adds at a SIGTERM of the launcher, once; "": nothing. Copied. */
void signals_hint(const char *text);

/* Copies the diagnosis of the lowest rank with d->bad to all ranks; false if there is none.
 * Collective over comm. */
bool run_diagnose(struct diagnosis *d, MPI_Comm comm);

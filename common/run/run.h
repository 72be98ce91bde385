/* run.h - the life of a solver program: command line, case, output folder, time loop, signals,
 * snapshots, restart files, summary, exit code. A solver fills a struct program and its main calls
 * run_main; a coupled job is reached through a struct partner (coupler/cpl_partner.h), so that
 * nothing here knows the coupler. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_RUN_H
#define COMMON_RUN_H

#include <mpi.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../base/exit.h"
#include "../base/timer.h"
#include "../files/series.h"
#include "../params/params.h"
#include "../scene/motion_files.h"
#include "../scene/scene.h"

struct h5;
struct picture;
struct xdmf;

/* What every module of a program may look at; owned by run_main. */
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
    bool restart;                 /* state comes from the restart file */
    bool coupled;
    bool crossed; /* coupled, and the free surface crosses open sides of sph.box: crossing.h */
    bool gauge_elsewhere[PROBES_MAX]; /* a partner reads the gauge: crossing_deal */
    const struct partner *partner;    /* NULL when alone */
    void *partner_ctx;                /* its state (struct cpl *) */
    struct timers timers;
    struct summary *summary;
    double t, dt; /* s: current time, last step */
    int64_t step;
};

/* A diagnosis: why a run cannot go on. Filled on every rank alike (or on the culprit, then reduced
 * by run_diverged). */
struct diagnosis {
    bool bad;
    char reason[256]; /* "|u| of particle 48213 is 114 m/s, limit 5 m/s" */
    char where[256];  /* "(0.25, 0.60) m, rank 0, in the buffer" */
    char likely[256]; /* cause and what to try */
};

/* What a solver provides. s is its state, made by create. */
struct program {
    const char *name; /* "sph": name of its group, of its files */
    const char *help; /* one sentence */
    /* Of what its restart files hold: raised when a name, a unit, a column, a bit or what a number
     * stands for changes, so that files of before are refused; 0 in files that do not say. */
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
    /* Adds to the scene what the case may leave open to this program, before check; NULL: nothing.
     */
    void (*complete)(struct run *r);
    /* Faults that need more than one key; may be NULL. */
    void (*check)(const struct run *r, struct faults *f);
    /* Lines of --check and of the banner: what the scene uses and leaves out, sizes, memory, time
     * step, number of steps; through log_say. Runs on the parameters alone, before create. */
    void (*describe)(const struct run *r);
    /* Adds zones, blocks, ... to the picture of --check=picture; NULL: nothing. Rank 0. */
    void (*draw)(const struct run *r, struct picture *p);
    /* Publishes what the partners must know before the plan (zones); NULL if nothing. */
    void (*offer)(struct run *r);
    /* State at t = 0, or from the restart file f (then sets r->t and r->step before). NULL: f does
     * not fit (reason logged). */
    void *(*create)(struct run *r, struct h5 *f);
    void (*destroy)(void *s);
    /* One step of at most t_stop - r->t, landing on t_stop exactly when it is within reach (the
     * last steps are shared out evenly); returns the dt done and sets d->bad (on all ranks) when
     * the state cannot be trusted. */
    double (*step)(void *s, double t_stop, struct diagnosis *d);
    /* Coupled: longest coupling step that suits it, s; NULL: no wish. */
    double (*window_wish)(void *s);
    /* Coupled: what a giver of fields hands over before the first coupling step; NULL if nothing.
     */
    void (*first)(void *s);
    /* Coupled: before the first step of a coupling step and after its last; NULL when never
     * coupled. */
    void (*window_begin)(void *s, double t0, double t1);
    void (*window_end)(void *s, double t1);
    /* Coupled: sums over its own part of the flow at the end of a coupling step, as "sum.kinetic";
     * the coupler adds them up. NULL: none. Collective. */
    void (*tell)(void *s, struct summary *report);
    /* Columns of series.csv beyond "t [s]", "dt [s]", and their values (on rank 0); collective. */
    const char *const *columns;
    int ncolumns;
    void (*row)(void *s, double *values);
    /* Steps between rows where the case does not say; NULL: 10. */
    int (*steps_between_rows)(const struct run *r);
    /* One progress line, without t and %: "dt 0.75 ms (sound)  Ma 0.062 ..."; rank 0's text counts.
     */
    void (*progress)(void *s, char *line, int size);
    /* Fields of a snapshot into f and its XDMF entry (x is NULL except on rank 0). */
    void (*snapshot)(void *s, struct h5 *f, struct xdmf *x, const char *file);
    /* All that create needs to go on bit for bit (t and step are written by run). */
    void (*checkpoint)(void *s, struct h5 *f);
    /* Errors, drifts, counts into r->summary; collective. The text "not_accepted", if it is set,
     * says why a run that went through is not to be trusted: it ends with RUN_NOT_ACCEPTED. */
    void (*finish)(void *s);
};

/* How a program takes part in a coupled job. Every function is collective over the program. */
struct partner {
    /* Meets the world's programs under `name' within deadline s; a partner without a sign of life
     * for patience s ends the job. *comm: this program's ranks, *ctx: NULL when no other program is
     * there. Non-zero: the code to exit with (reason printed). */
    int (*open)(MPI_Comm world, const char *name, double deadline, double patience, MPI_Comm *comm,
                void **ctx);
    /* After reading the case and program.offer: all compare the case's hash and their faults.
     * The lines of f are printed once for all programs. sound: none, and the folder is there.
     * Non-zero: the code to exit with. window: of the restart file, -1 for a fresh start. */
    int (*meet)(void *ctx, const struct faults *f, bool sound, unsigned long long hash,
                int64_t window, const char *dir);
    /* After create (which declares sets and fields): the plan is checked. dt_wish: longest window.
     */
    int (*ready)(void *ctx, double t, double dt_wish);
    /* Next window. false: the end, *code says which (RUN_DONE, RUN_STOPPED or RUN_DIVERGED). */
    bool (*window)(void *ctx, double *t0, double *t1, bool *output, bool *save, int *code);
    /* The coupling step is done; numbers of `report' go to the coupler's progress line and summary;
     * stop: asks for an orderly end. */
    void (*advance)(void *ctx, double t1, const struct summary *report, bool stop);
    /* A restart file of this coupling step is complete on disk. */
    void (*saved)(void *ctx, int64_t window, const char *file);
    int64_t (*window_number)(void *ctx); /* of the coupling step under way or last done */
    double (*waited)(void *ctx);         /* s spent waiting for partners */
    /* (In calls: (p->fail)(...), for fail() is a macro.) Tells all partners why this program stops
     * and ends the job with this code; does not return. */
    void (*fail)(void *ctx, int code, const char *reason);
    /* Final numbers to the coupler's summary, goodbye. */
    void (*close)(void *ctx, int code, const struct summary *final);
};

/* Everything from MPI_Init to MPI_Finalize; returns the exit code. partner may be NULL. */
int run_main(int argc, char **argv, const struct program *p, const struct partner *partner);

/* For programs that do not use run_main's loop (the coupler): the command line. */
struct command_line {
    const char *case_file; /* path as given, or cases/NAME/case.cfg found from NAME */
    const char *dir;       /* -o, or out/CASE */
    const char *as;        /* name of one of several programs of a kind; NULL: the kind's own */
    int noverrides;
    const char *const *overrides;
    bool check, picture, waves, restart, force, groups;
    double deadline; /* s to meet the other programs */
    double patience; /* s without a sign of life of a partner */
};
/* The folder of a case's file, and the case's name. */
void run_case_dir(const char *file, char *dir, size_t size);
void run_case_name(const char *file, char *name, size_t size);
/* Returns -1 to go on, else the exit code (--help, --version, --params: 0; faults: 2). Faults are
 * all printed, on world rank 0 of this program name. */
int run_command_line(struct command_line *c, int argc, char **argv, const char *name,
                     const char *help, const struct param_group *groups, int ngroups);
/* Makes the folder; 0, or RUN_INPUT if it holds a run of this program already and neither force nor
 * restart is set. On force the program's old files are removed. Collective. */
int run_folder(MPI_Comm comm, const char *dir, const char *name, bool force, bool restart);
/* Removes the restart files of a program in its folder that come before the newest, but for the one
 * before it. What is newer (of a coupling step under way) stays. */
/* A fault at `key' if n units (particles, cells), bytes in all, are more than this program's ranks
 * can count or their hosts can hold. Collective. */
void run_check_memory(const struct run *r, struct faults *f, const char *key, double n,
                      const char *unit, double bytes);
bool run_make_folder(const char *dir); /* with all above it; false: errno says why */
void run_prune(const char *dir, const char *name, const char *newest, const char *older);

/* SIGINT, SIGTERM, SIGUSR1 set a flag; SIGSEGV, SIGFPE, SIGBUS, SIGABRT leave a death note. When a
 * launcher's SIGTERM (there is a launcher only after signals_start_mpi) is not followed by an
 * orderly end within 0.8 s, the handler prints the death note, or what was last heard of the
 * partners, and leaves with RUN_PARTNER. */
void signals_install(const char *program, int rank);
/* MPI_Init; what is launched with others, within 120 s: a member of the job that is no MPI program
 * would leave it waiting in silence. A signal before signals_install leaves a word, too. */
void signals_start_mpi(int *argc, char ***argv, const char *program);
bool signals_stop(void);    /* this rank's flag */
void signals_handled(void); /* an orderly stop is under way: no deadline */
void signals_started(void); /* the time loop will look at signals_stop; before, a signal ends a
                               program that runs alone at once */
void signals_note_path(
    const char *path);                /* file of the death note (shared by the job's programs) */
void signals_heard(const char *text); /* what the handler prints when there is no note; copied */
void signals_hint(
    const char *text); /* what it adds at a SIGTERM of the launcher: "" nothing; copied */

/* The lowest rank with d->bad tells all ranks; false if there is none. Collective. */
bool run_diagnose(struct diagnosis *d, MPI_Comm comm);

#endif

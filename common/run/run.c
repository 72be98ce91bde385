/* run.c - the life of a solver: see run.h. Data flow one way: case -> state -> step -> output. In
 * order: the command line (run_main), the case with all its checks (read_case), the folder and the
 * restart file, in a coupled job the meeting with the others, the state (program->create), the
 * loop, alone or by coupling steps, and the end with summary and criteria. Functions act on all
 * ranks alike; a branch that not all would take is made common first.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "program.h"

#include <hdf5.h>
#include <unistd.h>

#include "../files/files.h"
#include "../scene/scene.h"
#include "accept.h"
#include "crossing.h"
#include "discharge_gauges.h"
#include "run_files.h"
#include "wave_gauges.h"

enum { GROUPS_MAX = SCENE_GROUPS + 8 };

/* A run with what only this file needs. */
struct life {
    struct run r;
    const struct program *p;
    struct command_line line;
    struct param_group groups[GROUPS_MAX];
    int ngroups;
    struct faults faults;
    struct params *params;
    struct run_files files;
    struct series *series;
    struct figures *row;
    void *s;
    int64_t window;      /* of the restart file */
    double began, wall0; /* s: wall time at the start of the program, of the time loop */
    double t0;           /* s: flow time there: 0, or that of the restart file */
    double said, every;  /* s: last progress line, and how often */
    double saved;        /* s: wall time of the last restart file */
    int64_t output;      /* number of the next output time */
    struct diagnosis d;
    const char *status;
};

bool run_diagnose(struct diagnosis *d, MPI_Comm comm)
{
    return ranks_first(comm, d->bad, d, sizeof *d);
}

/* --- start --- */

/* The scene's groups, then the program's own. */
static void collect_groups(struct life *l)
{
    scene_groups(&l->r.scene, l->groups);
    l->ngroups = SCENE_GROUPS;
    for (int k = 0; k < l->p->ngroups; k++)
        l->groups[l->ngroups++] = l->p->groups[k];
    /* one of several programs of a kind has a name and a group of its own */
    for (int k = 0; k < l->ngroups && l->line.as; k++)
        if (strcmp(l->groups[k].name, l->p->name) == 0)
            l->groups[k].name = l->line.as;
}

/* A case with both solvers is a coupled job; one without this program's group is not for it. */
static void check_place(struct life *l)
{
    struct run *r = &l->r;
    char names[PARAM_PROGRAMS_MAX][64];
    r->scene.has_sph = params_programs(l->params, "sph", names) > 0;
    r->scene.has_fv = params_has_group(l->params, "fv");
    if (!params_has_group(l->params, r->name))
        params_fault(l->params, &l->faults, r->name,
                     "the case has no group %s: it is not for this program", r->name);
    else if (r->scene.has_sph && r->scene.has_fv && !r->partner_ctx && !l->line.check)
        params_fault(l->params, &l->faults, r->name,
                     "this case is a coupled job (groups sph and fv): start it with cases/run, or "
                     "leave a group out");
}

/* In a coupled job walls and bodies of triangles lie where the particles are, and the other program
 * reads none; the water at the start is both programs' affair. */
static void read_meshes(struct life *l)
{
    struct run *r = &l->r;
    const bool partly = r->coupled && r->scene.has_sph;
    const bool reads = l->p->meshes && (!r->coupled || l->p->mesh_owners == MESH_OF_ALL);
    for (enum mesh_owner owner = MESH_OF_SHAPE; owner <= MESH_OF_WALL; owner++) {
        const bool known = reads && (l->p->mesh_owners >> owner & 1u);
        if (owner == MESH_OF_SHAPE ? !known || r->coupled : !known && !partly)
            scene_meshes_refuse(&r->scene, owner, l->params,
                                "surfaces of triangles are for sph in 3D, alone or, of walls and "
                                "bodies, where it has its particles in a coupled job; fv alone "
                                "takes bodies that are boxes",
                                &l->faults);
    }
    if (reads && l->faults.n == 0)
        l->p->meshes(&r->scene, r->case_dir, l->params, r->comm, &l->faults);
}

/* The case as it is read, before anything that follows from it is put into the scene. */
static void keep_text(struct life *l)
{
    struct run *r = &l->r;
    char *text = r->rank == 0 ? params_text(l->params) : NULL;
    int n = text ? (int)strlen(text) + 1 : 0;
    MPI_Bcast(&n, 1, MPI_INT, 0, r->comm);
    if (!text)
        text = NEW(char, n);
    MPI_Bcast(text, n, MPI_CHAR, 0, r->comm);
    l->files.case_text = mem_own(l, text);
}

/* Names of snapshots have six digits, and no disk wants more of them. */
static void check_outputs(struct life *l)
{
    const double every = l->r.scene.output.every, end = l->r.scene.time.end, most = 999999.0;
    if (every > 0.0 && end / every > most)
        params_fault(l->params, &l->faults, "output.every",
                     "%g s makes %.3g snapshots in %g s, more than have names: take %.2g s or more",
                     every, end / every, end, 1.1 * end / most);
}

/* Reads and checks everything; returns the number of faults, the same on all ranks. The order
 * matters: each part uses what those before it have put into the scene or found sound, and stops at
 * the first part with faults, for those behind would report consequences. All faults of one part
 * come together. */
static int read_case(struct life *l)
{
    struct run *r = &l->r;
    l->params = params_read(r->comm, l->line.case_file, l->line.noverrides, l->line.overrides,
                            l->groups, l->ngroups, l->p->other_groups, &l->faults);
    r->params = l->params;
    if (l->line.as)
        params_alias(l->params, l->p->name, l->line.as);
    if (l->faults.n == 0)
        keep_text(l);
    if (l->faults.n == 0)
        check_place(l);
    r->coupled = r->partner_ctx || (l->line.check && r->scene.has_sph && r->scene.has_fv);
    log_told_elsewhere(r->partner_ctx && r->scene.has_sph && r->scene.has_fv); /* by the coupler */
    if (l->faults.n == 0)
        scene_files_read(&r->scene, r->case_dir, r->motions, l->params, &l->faults);
    if (l->faults.n == 0)
        scene_check(&r->scene, l->params, &l->faults);
    log_told_elsewhere(false);
    if (l->faults.n == 0)
        wall_histories_check(&r->scene, l->params, &l->faults);
    if (l->faults.n == 0)
        scene_orient(&r->scene);
    if (l->faults.n == 0)
        read_meshes(l);
    if (l->faults.n == 0)
        wave_makers_resolve(&r->scene, r->motions);
    if (l->faults.n == 0)
        scene_currents_resolve(&r->scene, r->motions);
    if (l->faults.n == 0)
        r->crossed = crossing_find(r);
    if (l->faults.n == 0)
        crossing_deal(r, &l->faults);
    if (l->faults.n == 0)
        wave_gauges_check(&r->scene, r->gauge_elsewhere, l->params, &l->faults);
    if (l->faults.n == 0)
        accept_check(&r->scene, r->case_dir, l->params, &l->faults);
    if (l->faults.n == 0)
        check_outputs(l);
    if (l->faults.n == 0 && l->p->complete)
        l->p->complete(r);
    if (l->faults.n == 0 && l->p->check)
        l->p->check(r, &l->faults);
    if (l->faults.n == 0 && r->scene.output.series == 0)
        r->scene.output.series = l->p->steps_between_rows ? l->p->steps_between_rows(r) : 10;
    if (r->partner_ctx && !l->line.check) /* the coupler prints what several programs find */
        return l->faults.n;
    return params_report(&l->faults);
}

static void banner(const struct life *l)
{
    char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
    unsigned a, b, c;
    int n;
    MPI_Get_library_version(mpi, &n);
    mpi[strcspn(mpi, ",")] = '\0';
    H5get_libversion(&a, &b, &c);
    (l->r.coupled ? log_quiet : log_say)(
        "estran %s %s (%s, HDF5 %u.%u.%u), %d rank%s on a machine of %ld cores", l->r.name,
        run_version, mpi, a, b, c, l->r.size, l->r.size == 1 ? "" : "s",
        sysconf(_SC_NPROCESSORS_ONLN));
    (l->r.coupled ? log_quiet : log_say)("case %s -> %s", l->r.case_name, l->r.dir);
}

/* Partners compare notes: -1 to go on, else the exit code. A program that found faults takes part
 * as well: the partner's meet() collects everybody's, so that all are told in one go. */
static int meet(struct life *l, int faults)
{
    struct run *r = &l->r;
    if (!r->coupled || l->line.check)
        return faults ? RUN_INPUT : -1;
    if (!faults && l->p->offer)
        l->p->offer(r);
    const int code = r->partner->meet(r->partner_ctx, &l->faults, !faults, params_hash(l->params),
                                      l->window, r->dir);
    return code ? code : -1;
}

/* Folder and lock, and with --restart the open restart file. */
static int open_folder(struct life *l, struct h5 **restart)
{
    struct run *r = &l->r;
    int code = run_folder(r->comm, r->dir, r->name, l->line.force, l->line.restart);
    l->window = -1;
    *restart = NULL;
    if (code == 0 && l->line.restart) {
        *restart = files_open_restart(r, l->p, &l->window);
        code = *restart ? 0 : RUN_INPUT;
    }
    return code;
}

/* The case as it was run, with all defaults, and view.py; rank 0. */
static void start_files(struct life *l)
{
    struct run *r = &l->r;
    l->files.run = r;
    l->files.program = l->p;
    if (r->rank > 0)
        return;
    FILE *f = fopen(key_text("%s/%s-case.cfg", r->dir, r->name), "w");
    if (f) {
        fprintf(f, "# the case as %s ran it, with its defaults\n%s", r->name, l->files.case_text);
        fclose(f);
    }
    files_view(r);
}

/* Time and step first; the program's columns follow. */
static void fill_row(struct life *l)
{
    l->row->n = 0;
    FIGURE(l->row, l->r.t, "t [s]");
    FIGURE(l->row, l->r.dt, "dt [s]");
    if (l->p->row)
        l->p->row(l->s, l->row);
}

/* r->t is 0 or the restart file's time: rows and snapshots behind it are dropped, the snapshot at
 * it is kept (hence 1 + 1e-9 in xdmf_create, which leaves out entries at its time and later). */
static void start_series(struct life *l)
{
    struct run *r = &l->r;
    const char *path = files_path(r, "series.csv");
    l->series = mem_own(l, series_create(r->rank == 0 ? path : NULL, r->scene.domain.dim, l->row->n,
                                         l->row->title, r->restart, r->t));
    l->row->measures = true;
    path = key_text("%s/%s.xdmf", r->dir, r->name);
    if (r->rank == 0)
        l->files.xdmf = mem_own(l, xdmf_create(path, r->restart, r->t * (1.0 + 1e-9)));
}

/* --- while it runs --- */

static void write_row(struct life *l)
{
    timer_start(&l->r.timers, "output");
    fill_row(l);
    series_row(l->series, l->row->value);
    timer_stop(&l->r.timers, "output");
}

/* 1, 2, 5, 10, 30, 60 s apart as the run grows. The time left assumes that the rest of the flow
 * costs what the part since the start of this process did, per time of flow. */
static void say_progress(struct life *l)
{
    static const double every[] = {1, 2, 5, 10, 30, 60},
                        until[] = {5, 20, 120, 600, 3600, INFINITY};
    struct run *r = &l->r;
    const double now = wall_time(), gone = now - l->wall0, done = r->t / r->scene.time.end;
    char text[512] = "";
    if (r->rank != 0 || now - l->said < l->every)
        return;
    l->said = now;
    for (int k = 0; k < 6; k++)
        if (gone < until[k]) {
            l->every = every[k];
            break;
        }
    if (l->p->progress)
        l->p->progress(l->s, text, sizeof text);
    const double passed = r->t - l->t0;
    const double left = passed > 0.0 ? gone * (r->scene.time.end - r->t) / passed : 0.0;
    (r->coupled ? log_quiet : log_say)("t %9.4g of %g s %4.0f %%  left %2d:%02d:%02d  %s", r->t,
                                       r->scene.time.end, 100.0 * done, (int)left / 3600,
                                       (int)left / 60 % 60, (int)left % 60, text);
}

/* One step; false when the state cannot be trusted. Time is set to t_stop itself when the step ends
 * within 1e-9 dt of it, so that outputs and coupling steps are met exactly and r->t == out may be
 * asked. */
static bool step(struct life *l, double t_stop)
{
    struct run *r = &l->r;
    r->dt = l->p->step(l->s, t_stop, &l->d);
    const bool reached = !l->d.bad && t_stop - r->t - r->dt < 1e-9 * r->dt;
    r->t = reached ? t_stop : r->t + r->dt;
    r->step++;
    if (l->d.bad)
        return false;
    if (r->step % r->scene.output.series == 0)
        write_row(l);
    say_progress(l);
    return true;
}

/* A signal may have come to one rank alone. Collective. */
static bool stop_asked(const struct run *r)
{
    int stop = signals_stop();
    if (r->size > 1)
        MPI_Allreduce(MPI_IN_PLACE, &stop, 1, MPI_INT, MPI_MAX, r->comm);
    if (stop)
        signals_handled();
    return stop;
}

/* Largest over the ranks. Ranks may have met their timers in another order, or not at all: rank 0's
 * names count. */
static void summarise_timers(struct run *r)
{
    int n = r->timers.n;
    MPI_Bcast(&n, 1, MPI_INT, 0, r->comm);
    for (int k = 0; k < n; k++) {
        char name[64] = "";
        if (r->rank == 0)
            snprintf(name, sizeof name, "%s", r->timers.of[k].name);
        MPI_Bcast(name, sizeof name, MPI_CHAR, 0, r->comm);
        summary_real(r->summary, key_text("time_s.%s", name),
                     ranks_max(r->comm, timer_wall(&r->timers, name)));
    }
}

/* Ends with the program's own figures (finish), which are not asked for after a divergence. All
 * ranks: the timers and processor times are collected. */
static void summarise(struct life *l)
{
    struct run *r = &l->r;
    struct summary *s = r->summary;
    const double wall = wall_time() - l->began, cpu = ranks_sum(r->comm, cpu_time());
    summary_text(s, "status", l->status);
    summary_text(s, "case", r->case_name);
    summary_text(s, "program", r->name);
    summary_text(s, "version", run_version);
    summary_int(s, "ranks", r->size);
    summary_int(s, "dim", r->scene.domain.dim);
    summary_real(s, "wall_s", wall);
    summary_real(s, "cpu_s", cpu);
    summary_real(s, "start_s", l->wall0 - l->began); /* of wall_s: before the time loop */
    summary_int(s, "steps", r->step);
    summary_real(s, "t_end", r->t);
    if (!l->d.bad && l->p->finish)
        l->p->finish(l->s);
    summarise_timers(r);
}

static void write_summary(const struct life *l)
{
    if (l->r.rank == 0)
        summary_write(l->r.summary, files_path(&l->r, "summary.json"));
}

/* All ranks write the last state under the name _diverged, for a look at what went wrong. */
static int diverged(struct life *l)
{
    struct run *r = &l->r;
    log_say("diverged at t = %.6g s, step %lld: %s", r->t, (long long)r->step, l->d.reason);
    log_say("  where   %s", l->d.where);
    log_say("  likely  %s", l->d.likely);
    files_snapshot(&l->files, "diverged");
    if (r->scene.output.snapshots)
        log_say("  files   %s/%s_diverged.h5 (the state that failed), last entry of %s.xdmf",
                r->dir, r->name, r->name);
    l->status = "diverged";
    return RUN_DIVERGED;
}

static double next_output(const struct life *l)
{
    const double every = l->r.scene.output.every, end = l->r.scene.time.end;
    const double t = (double)l->output * every;
    return every > 0.0 && t < end * (1.0 - 1e-12) ? t : end;
}

/* By time of flow all ranks see the same; by wall time rank 0's clock decides. `next' is the first
 * multiple of the interval behind now, so a long step makes no backlog. */
static bool wants_checkpoint(struct life *l, double *next)
{
    const struct scene_output *o = &l->r.scene.output;
    int wanted = 0;
    if (o->checkpoint > 0.0 && l->r.t >= *next * (1.0 - 1e-12)) {
        *next = (floor(l->r.t / o->checkpoint + 1e-9) + 1.0) * o->checkpoint;
        wanted = 1;
    }
    if (o->checkpoint_wall > 0.0) {
        if (l->r.rank == 0 && wall_time() - l->saved > o->checkpoint_wall)
            wanted = 1;
        MPI_Bcast(&wanted, 1, MPI_INT, 0, l->r.comm);
    }
    if (wanted)
        l->saved = wall_time();
    return wanted;
}

/* Each step aims at the next output or restart file, whichever is first. A request to stop is taken
 * at the end of a step: a snapshot and a restart file, then the end. The snapshot comes first, for
 * the restart file holds the number of the next one. */
static int loop_alone(struct life *l)
{
    struct run *r = &l->r;
    const double every = r->scene.output.checkpoint;
    double save = every > 0.0 ? (floor(r->t / every + 1e-9) + 1.0) * every : INFINITY;
    char file[256];
    while (r->t < r->scene.time.end) {
        const double out = next_output(l), target = fmin(out, save);
        if (!step(l, target))
            return diverged(l);
        const bool stop = stop_asked(r);
        if (r->t == out) {
            l->output++;
            files_snapshot(&l->files, NULL);
        }
        const bool ends = stop && r->t < r->scene.time.end;
        if (ends && r->t != out) /* before the restart file, which counts it */
            files_snapshot(&l->files, NULL);
        if (wants_checkpoint(l, &save) || stop)
            files_checkpoint(&l->files, r->step, file);
        if (ends) {
            l->status = "stopped";
            log_say("stopped on request at t = %g s; --restart continues", r->t);
            return RUN_STOPPED;
        }
    }
    return RUN_DONE;
}

/* What the coupler shows while it runs. */
static void report_progress(const struct life *l, struct summary *s)
{
    summary_real(s, "t", l->r.t);
    summary_real(s, "dt", l->r.dt);
    summary_real(s, "steps", (double)l->r.step);
}

/* The coupler says from when to when each coupling step goes and whether an output or a restart
 * file follows; the program takes as many steps of its own as it needs, and gives its report. After
 * a divergence the summary is written first: abort_run() of the partner does not return. */
static int loop_coupled(struct life *l)
{
    struct run *r = &l->r;
    const struct partner *c = r->partner;
    double t0, t1;
    bool output, save;
    int code = RUN_DONE;
    char file[256];
    while (c->window(r->partner_ctx, &t0, &t1, &output, &save, &code)) {
        if (l->p->window_begin)
            l->p->window_begin(l->s, t0, t1);
        while (r->t < t1)
            if (!step(l, t1)) {
                diverged(l);
                summarise(l);
                write_summary(l);
                c->fail(r->partner_ctx, RUN_DIVERGED, l->d.reason);
            }
        if (l->p->window_end)
            l->p->window_end(l->s, t1);
        struct summary *s = summary_create();
        report_progress(l, s);
        if (l->p->tell)
            l->p->tell(l->s, s);
        c->advance(r->partner_ctx, t1, s, stop_asked(r));
        FREE(s);
        if (output)
            files_snapshot(&l->files, NULL);
        if (save) {
            files_checkpoint(&l->files, c->window_number(r->partner_ctx), file);
            c->saved(r->partner_ctx, c->window_number(r->partner_ctx), file);
        }
    }
    if (code == RUN_STOPPED)
        l->status = "stopped";
    return code;
}

/* --- end --- */

/* What the program itself found wrong with a run that went through. */
static bool sound(const struct life *l)
{
    const char *why = summary_find_text(l->r.summary, "not_accepted");
    if (why)
        log_warn("NOT ACCEPTED %s", why);
    return !why;
}

static void say_number(void *ctx, const char *key, double v)
{
    (void)ctx;
    if (strncmp(key, "error.", 6) == 0)
        log_say("error      %-22s %10.4g", key + 6, v);
}

/* On the screen; the same figures are in summary.json. */
static void say_end(const struct life *l)
{
    const struct run *r = &l->r;
    const double now = wall_time(), wall = now - l->began, loop = now - l->wall0;
    const char *quote = strpbrk(r->dir, " \t()&;$'*?<>|") ? "'" : "";
    double cpu = 0.0;
    summary_each(r->summary, say_number, NULL);
    summary_find(r->summary, "cpu_s", &cpu);
    log_say("cost       %.3g s wall (start %.2g s) on %d rank%s, %.3g s cpu, %lld steps", wall,
            wall - loop, r->size, r->size == 1 ? "" : "s", cpu, (long long)r->step);
    for (int k = 0; k < r->timers.n; k++)
        log_say("time       %-22s %10.3f s %5.1f %%", r->timers.of[k].name, r->timers.of[k].wall,
                100.0 * r->timers.of[k].wall / loop);
    if (r->scene.output.snapshots)
        log_say("look       paraview --script=%s%s/view.py%s", quote, r->dir, quote);
}

/* From the file, so that rows of before a restart count, too. */
static void judge_gauges(const struct life *l)
{
    const struct run *r = &l->r;
    if (r->rank != 0)
        return;
    wave_gauges_judge(&r->scene, files_path(r, "series.csv"), r->dir, r->summary);
    discharge_gauges_judge(&r->scene, r->mean_discharges, files_path(r, "series.csv"), r->summary);
}

/* From the end of the loop to the exit code. The last row comes even where the interval of rows
 * would skip it. Gauges and criteria read series.csv again: rows are on the disk as soon as they
 * are written. */
static int end(struct life *l, int code)
{
    struct run *r = &l->r;
    if (code == RUN_DONE && r->step % r->scene.output.series != 0)
        write_row(l); /* the end itself */
    summarise(l);
    if (code == RUN_DONE)
        judge_gauges(l);
    if (!r->coupled) {
        say_end(l);
        if (code == RUN_DONE && r->scene.naccept > 0) {
            int good = r->rank == 0 && accept_judge(&r->scene, r->case_dir, r->dir, r->summary);
            MPI_Bcast(&good, 1, MPI_INT, 0, r->comm);
            summary_bool(r->summary, "accepted", good);
            code = good ? RUN_DONE : RUN_NOT_ACCEPTED;
        }
    }
    if (code == RUN_DONE && !sound(l))
        code = RUN_NOT_ACCEPTED;
    write_summary(l);
    if (r->coupled)
        r->partner->close(r->partner_ctx, code, r->summary);
    return code;
}

/* The state first: it borrows from the scene. */
static void free_life(struct life *l)
{
    if (l->s)
        l->p->destroy(l->s);
    scene_meshes_free(&l->r.scene);
    params_free(&l->params);
    mem_free(l->faults.text);
    log_file(NULL);
    mem_free((void *)(uintptr_t)l->line.overrides);
}

/* From the state at the start to the exit code: files that need the state's columns, the partners'
 * agreement on the coupling step (ready), the first snapshot and row, the loop. */
static int run_state(struct life *l, struct h5 *restart)
{
    struct run *r = &l->r;
    if (restart && !files_read_clock(&l->files, restart))
        abort_run("the restart file has no time");
    r->restart = restart != NULL;
    l->s = l->p->create(r, restart);
    l->files.state = l->s;
    if (restart) /* of another case: why it does not fit, or what has changed on the way */
        files_tell_difference(&l->files, restart);
    h5_close(&restart);
    if (!l->s) {
        if (r->coupled)
            r->partner->fail(r->partner_ctx, RUN_INPUT,
                             r->restart ? "the restart file does not fit" : "nothing to compute");
        return RUN_INPUT;
    }
    l->row = mem_own(l, NEW(struct figures, 1));
    fill_row(l);
    if (!r->coupled)
        accept_check_columns(&r->scene, l->params, l->row->n - 2, l->row->title + 2, &l->faults);
    if (params_report(&l->faults))
        return RUN_INPUT;
    signals_started(); /* from the first file on a stop is orderly */
    start_series(l);
    if (r->coupled) {
        const double wish = l->p->longest_window ? l->p->longest_window(l->s) : INFINITY;
        const int code = r->partner->ready(r->partner_ctx, r->t, wish);
        if (code)
            return code;
        if (l->p->first)
            l->p->first(l->s);
    }
    const double every = r->scene.output.every;
    l->output = every > 0.0 ? (int64_t)floor(r->t / every + 1e-9) + 1 : 1;
    if (!r->restart) {
        files_snapshot(&l->files, NULL);
        write_row(l);
    }
    l->wall0 = l->said = l->saved = wall_time();
    l->t0 = r->t;
    l->every = 1.0;
    for (int k = 0; k < r->timers.n; k++)
        r->timers.of[k].wall = 0.0; /* the start is not part of the loop */
    return end(l, r->coupled ? loop_coupled(l) : loop_alone(l));
}

/* DIR/PROGRAM-WHAT.svg; its folder is made. */
static void picture_path(const struct life *l, const char *what, char path[1400])
{
    snprintf(path, 1400, "%s/%s-%s.svg", l->r.dir, l->r.name, what);
    if (!run_make_folder(l->r.dir))
        disk_failed(path);
}

/* The scene as the programs have understood it. */
static void draw(const struct life *l)
{
    char path[1400];
    picture_path(l, "scene", path);
    struct picture *p = picture_create(path, &l->r.scene);
    if (l->p->draw)
        l->p->draw(&l->r, p);
    picture_close(&p);
    log_say("picture: %s", path);
}

/* The waves of the scene alone. */
static int draw_waves(const struct life *l)
{
    char path[1400];
    if (!l->r.scene.has_waves) {
        if (l->r.rank == 0)
            log_warn("--check=waves: the case has no group waves: give waves: { height = ...; "
                     "length = ...; }, or period");
        return RUN_INPUT;
    }
    if (l->r.rank > 0)
        return RUN_DONE;
    picture_path(l, "waves", path);
    scene_waves_describe(&l->r.scene);
    wave_picture(path, &l->r.scene);
    return RUN_DONE;
}

/* From the case to the exit code. What may fail for reasons of the user comes before signals and
 * log file; a run that does not begin leaves no log. */
static int live(struct life *l)
{
    struct run *r = &l->r;
    struct h5 *restart = NULL;
    run_case_dir(l->line.case_file, r->case_dir, sizeof r->case_dir);
    r->motions = mem_own(l, motion_files_create(r->case_dir));
    collect_groups(l);
    int faults = read_case(l);
    run_case_name(l->line.case_file, r->case_name, sizeof r->case_name);
    snprintf(r->dir, sizeof r->dir, "%s", l->line.dir);
    if (!faults && l->line.waves)
        return draw_waves(l);
    if (!faults && l->line.check) {
        l->p->describe(r);
        if (l->line.picture && r->rank == 0)
            draw(l);
        return RUN_DONE;
    }
    if (!faults)
        faults = open_folder(l, &restart) != 0;
    const int code = meet(l, faults);
    if (code >= 0) {
        h5_close(&restart);
        return code;
    }
    signals_install(r->name, r->rank);
    const char *path = key_text("%s/.death", r->dir); /* so the coupler calls its notes, too */
    if (!r->coupled && r->rank == 0)
        unlink(path); /* of an earlier run */
    MPI_Barrier(r->comm);
    signals_note_path(path);
    log_file(r->coupled ? key_text("%s/%s.log", r->dir, r->name) : key_text("%s/log.txt", r->dir));
    banner(l);
    l->p->describe(r);
    r->summary = mem_own(l, summary_create());
    l->status = "done";
    start_files(l);
    return run_state(l, restart);
}

/* MPI is started before the command line is read, since Open MPI may change argv; printing --help
 * needs no partner. */
int run_main(int argc, char **argv, const struct program *p, const struct partner *partner)
{
    const double began = wall_time();
    struct life *l = NULL;
    signals_start_mpi(&argc, &argv, p->name);
    l = mem_new(1, sizeof *l);
    l->began = began;
    l->p = p;
    l->r.name = p->name;
    collect_groups(l);
    int code = run_command_line(&l->line, argc, argv, p->name, p->help, l->groups, l->ngroups);
    if (code < 0) {
        code = 0;
        l->r.comm = MPI_COMM_WORLD;
        l->r.name = l->line.as ? l->line.as : p->name;
        if (partner)
            code = partner->open(MPI_COMM_WORLD, l->r.name, l->line.deadline, l->line.patience,
                                 &l->r.comm, &l->r.partner_ctx);
        l->r.partner = l->r.partner_ctx ? partner : NULL;
        MPI_Comm_rank(l->r.comm, &l->r.rank);
        MPI_Comm_size(l->r.comm, &l->r.size);
        log_open(l->r.comm, l->r.name);
        if (code == 0)
            code = live(l);
    }
    free_life(l);
    mem_free(l);
    signals_handled(); /* all is said: a launcher that stops the job for a partner's exit code adds
                          nothing */
    MPI_Finalize();
    return code;
}

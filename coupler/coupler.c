/* coupler.c - main program of the coupler: meets the solvers, checks their plan, then answers
 * messages until all have said goodbye. Every rank holds the same plan and maps its own share of
 * the targets; rank 0 alone decides about coupling steps, writes files and speaks to the user. The
 * order is that of run(): find_partners (handshake), job_read, and in couple() the meeting, the
 * plan, the service. Only answers are sent: nothing here waits for one certain program while
 * another may speak, except where a message is due from each.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "server/coupler.h"

#include <unistd.h>

#include "../common/run/run.h"
#include "transport/transport.h"

/* how often a waiting process looks after its partners; after how long without an end of a coupling
 * step the user is told, twice as long each time */
static const double look_every = 0.05, stall_first = 60.0; /* s */
static const char help[] = "couples the solvers of a job: fields, coupling steps, restart points";

static _Noreturn void broken(const char *what) { abort_run("%s", what); }
static void leave_note(const char *reason) { (void)failure_note(reason); }

/* --- waiting --- */

/* Ends the job where a partner has left a death note or its process is gone; returns otherwise. */
static void look_after_partners(void)
{
    char note[512];
    if (!failure_seen())
        return;
    if (!failure_read(note, sizeof note))
        snprintf(note, sizeof note, "a program of this job is gone");
    log_quiet("%s", note);
    signals_handled(); /* this rank says it itself */
    failure_die(RUN_PARTNER, note);
}

/* Who keeps all others waiting, and since when nothing was heard of it. */
static void tell_stall(struct coupler *c)
{
    char text[TEXT] = "";
    if (c->nwindows > 0)
        problem(text, "coupling step %lld has been under way for %.0f s:", (long long)c->window,
                c->stall_every);
    for (int i = 0; i < c->nsolvers; i++)
        if (!c->solver[i].ready)
            problem(text, "%s is not ready yet", c->solver[i].name);
        else if (c->solver[i].advanced < c->window)
            problem(text, "  %s has not ended it; last heard %.1f s ago", c->solver[i].name,
                    wire_time() - c->solver[i].heard);
    rendezvous_waiting(c, text);
    log_say("%s", text);
    c->stall_every *= 2.0;
    c->stall_at = wall_time() + c->stall_every;
}

/* What rank 0 does beside answering. */
static void look_around(struct coupler *c)
{
    if (signals_stop() && !c->stopping) {
        look_after_partners(); /* the launcher ends a job with the same signal when a program dies
                                */
        c->stopping = true;
        signals_handled();
        log_say("stopping in order: one more coupling step, restart files, end");
    }
    if (wall_time() > c->stall_at)
        tell_stall(c);
    report_progress(c);
}

/* Next message of a peer (-1: any). Short sleeps between polls; every `look_every' seconds a look
 * at the partners. The time waited is counted as idle. */
static struct message *await(struct coupler *c, int peer)
{
    struct message *m;
    struct backoff backoff;
    backoff_begin(&backoff);
    while (!(m = wire_poll(&c->wire, peer))) {
        const double now = wire_time();
        if (now - backoff.checked > look_every) {
            backoff.checked = now;
            look_after_partners();
        }
        if (c->rank == 0)
            look_around(c);
        backoff_sleep(&backoff);
    }
    c->idle += wire_time() - backoff.since;
    if (m->peer < c->nsolvers)
        c->solver[m->peer].heard = wire_time();
    return m;
}

/* --- meeting, plan --- */

static void print_problems(const char *text) { log_say("%s\nnothing was started", text); }

/* False: the programs do not fit together; all have been told. Rank 0 hears rank 0 of every solver,
 * the other ranks of the coupler wait for its answer. Faults of this program's own input go into
 * the same list. */
static bool meet(struct coupler *c, const struct faults *f)
{
    char text[TEXT] = "", path[1100];
    const int faults = f->n;
    struct message *m;
    if (c->rank > 0) {
        m = await(c, c->own_peer);
        take_text(&c->wire, m, text, sizeof text);
        message_free(&m);
        return !text[0];
    }
    if (faults)
        problem(text, "coupler: %d fault%s in its input", faults, faults > 1 ? "s" : "");
    for (int n = 0; n < c->nsolvers; n++) {
        m = await(c, -1);
        if (m->head.kind != WIRE_MEET || m->peer >= c->nsolvers || c->solver[m->peer].met)
            abort_run("message %d during the handshake", m->head.kind);
        plan_take_meet(c, &c->solver[m->peer], m);
        message_free(&m);
    }
    plan_say_faults(c, f->text);
    if (!faults)
        plan_check_meet(c, text);
    if (text[0])
        print_problems(text);
    snprintf(path, sizeof path, "%s/.death", c->dir);
    (void)unlink(path); /* of an earlier run, before anybody can need it */
    plan_answer_meet(c, text);
    return !text[0];
}

/* Rank 0 hands on what the solvers say: every rank draws the same plan from it. */
static void forward(struct coupler *c, const struct message *m)
{
    for (int r = 1; r < c->size; r++) {
        struct pack p;
        pack_begin(&p, WIRE_READY, m->peer, m->head.tick);
        pack_bytes(&p, m->body, (size_t)m->head.bytes);
        wire_send(&c->wire, c->own_peer, r, &p);
    }
}

/* Each rank makes the links from the same messages, so that they have the same numbers everywhere;
 * rank 0 hands on what the solvers have said. */
static bool plan(struct coupler *c)
{
    char text[TEXT] = "";
    for (int n = 0; n < c->nsolvers; n++) {
        struct message *m = await(c, c->rank == 0 ? -1 : c->own_peer);
        const int who = c->rank == 0 ? m->peer : m->head.field;
        if (m->head.kind != WIRE_READY || who >= c->nsolvers || c->solver[who].ready)
            abort_run("message %d while the plan is made", m->head.kind);
        if (c->rank == 0)
            forward(c, m);
        c->solver[who].restart_window = m->head.tick;
        plan_take_ready(c, &c->solver[who], m);
        message_free(&m);
    }
    plan_make_links(c, text);
    window_divide(c, text);
    if (text[0])
        print_problems(text);
    else
        plan_describe(c);
    if (c->rank == 0)
        plan_answer_ready(c, text);
    return !text[0];
}

/* --- the job --- */

/* Every rank of a solver says goodbye to every rank of the coupler: behind it nothing of it is on
 * the way. The worst code counts. */
static void take_close(struct coupler *c, struct solver *s, struct message *m)
{
    if (c->rank == 0 && c->action != CPL_STOP)
        abort_run("%s left in coupling step %lld, before the end", s->name, (long long)c->window);
    const int code = (int)take_int(&c->wire, m);
    const double waited = take_real(&c->wire, m);
    s->code = code > s->code ? code : s->code;
    s->waited = m->rank == 0 ? waited : s->waited;
    s->cpu += take_real(&c->wire, m);
    report_told(&c->wire, m, &s->told);
    s->has_closed = ++s->nclosed == s->size;
    c->over = true;
    for (int i = 0; i < c->nsolvers; i++)
        c->over = c->over && c->solver[i].has_closed;
}

/* One message of a solver's rank. After each, a look whether the programs can go on at all: a
 * deadlock shows in the counts of what was put and asked, and is told instead of waited for. */
static void answer(struct coupler *c, struct message **m)
{
    struct solver *s = &c->solver[(*m)->peer];
    char text[TEXT] = "";
    if ((*m)->peer >= c->nsolvers)
        abort_run("message %d from the coupler to itself", (*m)->head.kind);
    switch ((*m)->head.kind) {
    case WIRE_GET:
        rendezvous_get(c, s, *m);
        break;
    case WIRE_PUT:
        rendezvous_put(c, s, m);
        break;
    case WIRE_ADVANCE:
        window_advance(c, s, *m);
        break;
    case WIRE_SAVED:
        checkpoint_saved(c, s, *m);
        break;
    case WIRE_CLOSE:
        take_close(c, s, *m);
        break;
    default:
        abort_run("%s rank %d sent message %d out of order", s->name, (*m)->rank, (*m)->head.kind);
    }
    if ((c->rank == 0 && rendezvous_starved(c, text)) || rendezvous_skipped(c, text)) {
        log_quiet("%s", text);
        signals_handled();
        failure_die(RUN_PARTNER, text);
    }
    message_free(m);
}

/* Once a coupling step: what this rank would be said to be doing if it were lost now. */
static void say_doing(struct coupler *c)
{
    char text[128];
    if (c->said == c->window)
        return;
    c->said = c->window;
    snprintf(text, sizeof text, "in coupling step %lld of %lld", (long long)c->window,
             (long long)c->nwindows);
    failure_doing(text);
    signals_heard(text);
}

/* From the first coupling step to the last goodbye; then the summary, whose code goes to
 * everybody. */
static int serve(struct coupler *c)
{
    rendezvous_open(c);
    if (c->rank == 0 && c->command->restart)
        checkpoint_resume(c);
    if (c->rank == 0)
        window_announce(c);
    while (!c->over) {
        struct message *m = await(c, -1);
        answer(c, &m);
        if (c->rank == 0)
            say_doing(c);
    }
    double cpu = cpu_time(), all = 0.0;
    MPI_Reduce(&cpu, &all, 1, MPI_DOUBLE, MPI_SUM, 0, c->comm);
    int code = c->rank == 0 ? report_summary(c, all) : 0;
    for (int i = 0; i < c->nsolvers && c->rank == 0; i++) {
        struct pack p;
        pack_begin(&p, WIRE_CLOSED, 0, 0);
        pack_int(&p, code);
        wire_send_all(&c->wire, c->solver[i].peer, &p);
    }
    MPI_Bcast(&code, 1, MPI_INT, 0, c->comm);
    return code;
}

/* Peers have the numbers of their solvers; the coupler's own ranks come last. */
static void list_solvers(struct coupler *c)
{
    for (int i = 0; i < c->who.nprograms; i++) {
        const struct handshake_program *p = &c->who.program[i];
        if (i == c->who.coupler)
            continue;
        struct solver *s = &c->solver[c->nsolvers++];
        s->name = p->name;
        s->size = p->size;
        s->heard = wire_time();
        s->peer = wire_add_peer(&c->wire, p->inter, p->size, p->name);
    }
    c->own_peer = wire_add_peer(&c->wire, c->comm, c->size, "coupler");
}

/* With the case read: all that happens in the company of the solvers. Messages under way are
 * flushed before anything is freed. */
static int couple(struct coupler *c, struct faults *faults)
{
    char path[1100];
    int code = RUN_INPUT;
    c->wire.broken = broken;
    list_solvers(c);
    fail_hook = leave_note;
    if (params_report(faults) == 0 &&
        run_folder(c->comm, c->dir, "coupler", c->command->force, c->command->restart) != 0)
        faults->n++;
    snprintf(path, sizeof path, "%s/.death", c->dir);
    failure_path(path);
    signals_note_path(path);
    alive_patience(c->command->patience);
    alive_begin(c->dir, "coupler", c->rank);
    if (meet(c, faults)) { /* solvers have looked into the folder: what is new now is not another
                                 run's */
        snprintf(path, sizeof path, "%s/log.txt", c->dir);
        log_file(path);
        code = plan(c) ? serve(c) : RUN_INPUT;
    }
    while (!wire_flushed(&c->wire))
        usleep(100);
    failure_closed();
    rendezvous_close(c);
    FREE(c->sums);
    log_file(NULL);
    return code;
}

/* What a third program may take of each body, and what it may give. */
static void describe_bodies(const struct coupler *c)
{
    for (int k = 0; k < c->scene.nbodies; k++) {
        const struct scene_body *b = c->scene.bodies + k;
        const bool bends = scene_body_bends(b);
        log_say("  sph.%s.force (N, N m), sph.%s.motion (m, rad, m/s, rad/s)", b->name, b->name);
        if (bends)
            log_say("  sph.%s.load (N), on the points of its outline", b->name);
        if (bends || scene_body_partnered(b))
            log_say("  and a partner gives %s.%s", b->name, bends ? "outline (m, m/s)" : "motion");
    }
}

/* How sph and fv meet, by the case that they share. */
static void describe_scene(const struct coupler *c)
{
    const struct scene_coupling *k = &c->scene.coupling;
    if (k->steps > 0)
        log_say("sph and fv exchange every %d steps of sph", k->steps);
    else
        log_say("sph and fv exchange as often as sph finds that the flow requires");
    log_say("  fv -> sph  velocity, pressure: %s, everywhere but the free zone",
            k->interpolation ? "cubic" : "linear");
    log_say("  sph -> fv  velocity: %s, at the imposed cells of fv",
            k->mapping ? "moving least squares" : "Shepard");
    log_say("  transition %g m, buffer %g m (0: 1.25 R)", k->transition, k->buffer);
    log_say("a third program may take, at the end of each coupling step:");
    log_say(
        "  sph.velocity (m/s), sph.pressure (Pa) of particles of the free zone and the transition");
    log_say("  fv.velocity (m/s), fv.pressure (Pa) of cells, everywhere but in sph's free zone");
    log_say("  where a free surface crosses sph.box: sph.one (-), fv.phi (m from it, < 0: water)");
    describe_bodies(c);
}

/* A case of one solver: a job with programs that run beside it. */
static void describe_one(const struct coupler *c)
{
    log_say("%s alone, unless other programs take part (cases/run --with)",
            c->scene.has_sph ? "sph" : "fv");
    if (c->scene.has_sph && c->scene.nbodies > 0)
        log_say("they may take, as means over or at the end of each coupling step:");
    if (c->scene.has_sph)
        describe_bodies(c);
}

static void describe(const struct coupler *c)
{
    log_say("%s: t = %g to %g s, outputs every %g s", c->command->case_file, c->job.start,
            c->scene.time.end, c->scene.output.every);
    if (c->job.programs[0])
        log_say("programs: %s; they declare their fields when they start", c->job.programs);
    else if (c->scene.has_sph && c->scene.has_fv)
        describe_scene(c);
    else if (c->job.shared)
        describe_one(c);
    else
        log_say("programs: any; they declare their fields when they start");
}

/* Who else is here; false: no job, the reason is printed. */
static bool find_partners(struct coupler *c)
{
    const int met = handshake(c->world, "coupler", c->command->deadline, CPL_VERSION, &c->who);
    c->comm = c->who.mine;
    MPI_Comm_rank(c->comm, &c->rank);
    MPI_Comm_size(c->comm, &c->size);
    log_open(c->comm, "coupler");
    signals_install("coupler", c->rank);
    signals_hint(failure_hint());
    if (met != 0)
        log_say("%s", c->who.text);
    return met == 0;
}

/* Without partners, --check only reads and describes. */
static int run(struct coupler *c)
{
    struct faults faults = {0};
    const struct command_line *l = c->command;
    int code = RUN_INPUT;
    c->comm = c->world;
    if (!l->check && !find_partners(c))
        return RUN_INPUT;
    c->params = job_read(&c->job, &c->scene, c->comm, l, l->check ? NULL : &c->who, &faults);
    accept_check(&c->scene, c->case_dir, c->params, &faults);
    c->hash = params_hash(c->params);
    if (!l->check)
        code = couple(c, &faults);
    else if (params_report(&faults) == 0) {
        code = RUN_DONE;
        describe(c);
    }
    params_free(&c->params);
    mem_free(faults.text);
    return code;
}

/* A program of the job that is no MPI program keeps all others in MPI_Init, without a word. */
int main(int argc, char **argv)
{
    static struct coupler c; /* large */
    struct command_line command;
    struct param_group groups[JOB_GROUPS];
    signals_start_mpi(&argc, &argv, "coupler");
    c.world = MPI_COMM_WORLD;
    c.command = &command;
    c.said = -1;
    c.start = wall_time();
    c.line_every = 1.0;
    c.line_at = c.start + c.line_every;
    c.stall_every = stall_first;
    c.stall_at = c.start + c.stall_every;
    job_groups(&c.job, &c.scene, groups);
    int code = run_command_line(&command, argc, argv, "coupler", help, groups, JOB_GROUPS);
    if (code < 0) {
        snprintf(c.dir, sizeof c.dir, "%s", command.dir);
        run_case_dir(command.case_file, c.case_dir, sizeof c.case_dir);
        code = run(&c);
    }
    mem_free((void *)(uintptr_t)command.overrides);
    signals_handled(); /* all is said: a launcher that stops the job for a partner's exit code adds
                          nothing */
    MPI_Finalize();
    return code;
}

/* window.c - integer time. All coupling steps of a job are equal and known by number: coupling step
 * k spans k/n to (k+1)/n of the job's time, and all programs get the same two doubles. A restart
 * goes on in the steps of the job where its time is the start of one, so that its results are the
 * same to the last bit; with another end, other outputs or other wishes of the programs what is
 * left is divided anew, and numbered on.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

#include "../../common/run/run.h"

static const double same_time = 1e-9; /* relative */

/* The end as the case has it, to the last bit. */
double window_start(const struct coupler *c, int64_t k)
{
    const double span = c->t_end - c->t_base;
    return k == c->nwindows
               ? c->t_end
               : c->t_base + span * (double)(k - c->base) / (double)(c->nwindows - c->base);
}

double window_since(const struct coupler *c)
{
    const double every = c->scene.output.every, t = c->t_base - c->t_start;
    return every > 0.0 ? fmax(t - every * floor(t / every * (1.0 + same_time)), 0.0) : 0.0;
}

/* From step k at t on the fewest coupling steps, none longer than dt, that serve the outputs and
 * the end. */
static void divide(struct coupler *c, double dt, int64_t k, double t, char *text)
{
    c->base = k;
    c->t_base = t;
    c->nwindows = k + 1;
    if (!(dt > 0.0)) {
        problem(text, "a program asks for coupling steps of %g s", dt);
        return;
    }
    const double span = c->t_end - t;
    const int64_t n = coupling_steps_number(span, window_since(c), c->scene.output.every, dt);
    if (n > 0)
        c->nwindows = k + n;
    else
        problem(text, "coupling steps of %g s are too short for a run of %g s", dt, span);
}

static bool at(const struct coupler *c, int64_t window, double t)
{
    const double dt = (c->t_end - c->t_base) / (double)(c->nwindows - c->base);
    return fabs(window_start(c, window) - t) <= 1e-6 * dt + same_time * fabs(c->t_end);
}

/* The step that begins at the time of a restart; a restart file is written at the end of its step
 * or counts the steps done: time tells which. None does where the case or a program asks for other
 * steps now. */
static int64_t resume(struct coupler *c, double dt, char *text)
{
    const struct solver *first = &c->solver[0];
    const int64_t start = first->restart_window > 0 ? first->restart_window : 0;
    if (first->restart_window < 0 || at(c, start, first->t))
        return start;
    if (at(c, start + 1, first->t))
        return start + 1;
    if (!(first->t > c->t_start && first->t < c->t_end))
        return start;
    divide(c, dt, start + 1, first->t, text);
    return start + 1;
}

/* The shortest wish counts, of the case and of all programs. On all ranks, from the same
 * numbers. */
void window_divide(struct coupler *c, char *text)
{
    const struct solver *first = &c->solver[0];
    double dt = c->job.window > 0.0 ? c->job.window : INFINITY;
    c->t_start = c->job.start;
    c->t_end = c->scene.time.end;
    for (int i = 0; i < c->nsolvers; i++)
        dt = fmin(dt, c->solver[i].dt_longest);
    divide(c, dt, 0, c->t_start, text);
    const int64_t start = resume(c, dt, text);
    for (int i = 0; i < c->nsolvers; i++)
        if (!at(c, start, c->solver[i].t))
            problem(text,
                    "%s starts at t = %.9g s, but coupling step %lld of %lld starts at %.9g s "
                    "(coupler.start: another start)",
                    c->solver[i].name, c->solver[i].t, (long long)start, (long long)c->nwindows,
                    window_start(c, start));
    c->first_window = c->window = start;
    for (int i = 0; i < c->nsolvers; i++)
        c->solver[i].advanced = start - 1;
    c->save_wall = wall_time();
    const double every = c->scene.output.checkpoint;
    c->bound = every > 0.0 ? every * (floor(first->t / every + same_time) + 1.0) : INFINITY;
}

/* For the coupling step that begins now. Wall time is looked at here alone, so that all programs
 * save at the same steps. */
static int next_action(struct coupler *c)
{
    const double t1 = window_start(c, c->window + 1), now = wall_time();
    int action = CPL_RUN;
    if (c->stopping ||
        coupling_steps_output(c->nwindows - c->base, c->window + 1 - c->base, c->t_end - c->t_base,
                              window_since(c), c->scene.output.every))
        action |= CPL_OUTPUT;
    if (c->stopping)
        action |= CPL_SAVE;
    if (t1 >= c->bound - same_time * fabs(c->t_end)) {
        action |= CPL_SAVE;
        c->bound += c->scene.output.checkpoint;
    }
    if (c->scene.output.checkpoint_wall > 0.0 &&
        now - c->save_wall > c->scene.output.checkpoint_wall)
        action |= CPL_SAVE;
    if (action & CPL_SAVE) {
        c->save_wall = now;
        c->save[c->window & 1] = (struct save){.window = c->window};
    }
    return action;
}

/* A stop comes one coupling step after its restart point was asked for: all programs must have
 * written it. */
void window_announce(struct coupler *c)
{
    const bool done = c->window >= c->nwindows;
    const bool stop = c->stopping && (c->action & CPL_SAVE) && c->window > c->first_window;
    struct pack p;
    if (done || stop) {
        c->code = done ? RUN_DONE : RUN_STOPPED;
        c->action = CPL_STOP;
    } else {
        c->action = next_action(c);
    }
    for (int i = 0; i < c->nsolvers; i++) {
        pack_begin(&p, WIRE_WINDOW, 0, c->window);
        pack_int(&p, c->action);
        pack_int(&p, c->code);
        pack_real(&p, window_start(c, c->window));
        pack_real(&p, done ? c->t_end : window_start(c, c->window + 1));
        wire_send_all(&c->wire, c->solver[i].peer, &p);
    }
    c->stall_at = wall_time() + c->stall_every;
}

/* With the last program's end of a step all others' waiting is put down to it. */
void window_advance(struct coupler *c, struct solver *s, struct message *m)
{
    if (m->head.tick != c->window || s->advanced == c->window)
        abort_run("%s ends coupling step %lld, but coupling step %lld is under way", s->name,
                  (long long)m->head.tick, (long long)c->window);
    s->advanced = m->head.tick;
    if (take_int(&c->wire, m) && !c->stopping) {
        log_say("%s asks for an orderly end", s->name);
        c->stopping = true;
    }
    s->waited = take_real(&c->wire, m);
    rendezvous_take_ticks(c, s, m);
    report_told(&c->wire, m, &s->told);
    s->advanced_at = wall_time();
    for (int i = 0; i < c->nsolvers; i++)
        if (c->solver[i].advanced != c->window)
            return;
    for (int i = 0; i < c->nsolvers; i++) /* all waited for the last one */
        c->solver[i].waited_for[s - c->solver] += s->advanced_at - c->solver[i].advanced_at;
    if (c->window++ == c->first_window)
        c->first_end = wall_time();
    sums_window(c);
    window_announce(c);
}

/* waiting.c - who waits for what: sources that have gone past what a target waits for, targets that
 * wait for each other, values of a time that nobody has put. SPDX-License-Identifier: BSD-3-Clause
 */
#include "coupler.h"

/* By rank 0's word for its program. */
void rendezvous_take_ticks(struct coupler *c, struct solver *s, struct message *m)
{
    const int64_t n = take_int(&c->wire, m);
    if (n != s->nfields)
        abort_run("%s names %lld fields, the plan has %d", s->name, (long long)n, s->nfields);
    for (int i = 0; i < s->nfields; i++)
        s->field[i].last_tick = take_int(&c->wire, m);
}

/* The link on which a solver waits for values that have not been put; NULL: it does not wait. Told
 * by ticks, that is by how far rank 0 of each program says that its fields have been put
 * (rendezvous_take_ticks), not by the puts themselves, which may still be on their way. */
static const struct partner_link *missing(const struct coupler *c, int solver)
{
    for (int i = 0; i < c->nlinks; i++) {
        const struct partner_link *l = &c->link[i];
        if (l->target == solver && l->asker[0].asked &&
            c->solver[l->source].field[l->gfield].last_tick < l->asked_tick)
            return l;
    }
    return NULL;
}

/* Follows who waits for whom from one solver on; at most one step for each solver. */
static bool waits_in_a_circle(const struct coupler *c, int solver, char *text)
{
    const struct partner_link *l = missing(c, solver);
    int steps = 0;
    while (l && l->source != solver && steps++ < c->nsolvers)
        l = missing(c, l->source);
    if (!l || l->source != solver)
        return false;
    for (l = missing(c, solver);; l = missing(c, l->source)) {
        problem(text, "%s waits in coupling step %lld for %s of %s, which has not been given",
                c->solver[l->target].name, (long long)c->window,
                c->solver[l->target].field[l->tfield].name, c->solver[l->source].name);
        if (l->source == solver)
            return true;
    }
}

/* A source that has ended the step gives nothing more in it; who waits for it, or in a circle,
 * waits for ever. */
bool rendezvous_starved(const struct coupler *c, char *text)
{
    for (int i = 0; i < c->nsolvers; i++) {
        const struct partner_link *l = missing(c, i);
        if (l && c->solver[l->source].advanced == c->window) {
            problem(text, "%s waits for %s, but %s has ended coupling step %lld without giving it",
                    c->solver[i].name, c->solver[i].field[l->tfield].name,
                    c->solver[l->source].name, (long long)c->window);
            return true;
        }
        if (waits_in_a_circle(c, i, text))
            return true;
    }
    return false;
}

/* A put of a later tick proves that none of the tick asked for will come, since those of one rank
 * come in order. */
bool rendezvous_skipped(const struct coupler *c, char *text)
{
    for (int i = 0; i < c->nlinks; i++) {
        const struct partner_link *l = &c->link[i];
        const struct solver *g = &c->solver[l->source];
        if (l->asked_tick < 0 || l->nasked < l->naskers)
            continue;
        const struct arrival *a = &l->in[l->asked_tick & 1], *b = &l->in[(l->asked_tick + 1) & 1];
        for (int r = 0; r < g->size; r++) {
            const bool there = a->tick == l->asked_tick && a->put[r];
            if (there || b->tick <= l->asked_tick || !b->put[r])
                continue;
            problem(text,
                    "%s needs %s of %s as it was at the start of coupling step %lld, but %s has "
                    "put none there: before the first one, values are put after cpl_ready",
                    c->solver[l->target].name, g->field[l->gfield].name, g->name,
                    (long long)l->asked_tick, g->name);
            return true;
        }
    }
    return false;
}

/* For the message about a step that takes long. */
void rendezvous_waiting(const struct coupler *c, char *text)
{
    for (int i = 0; i < c->nlinks; i++) {
        const struct partner_link *l = &c->link[i];
        if (l->nasked > 0)
            problem(text, "  %s waits for %s of %s", c->solver[l->target].name,
                    c->solver[l->target].field[l->tfield].name, c->solver[l->source].name);
    }
}

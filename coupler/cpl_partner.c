/* cpl_partner.c - a coupled job as common/run/run.h sees it: the functions of struct partner over
 * cpl.h, for sph and fv. Errors that leave no choice end the job here.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cpl_partner.h"

#include <stdio.h>

#include "../common/base/base.h"
#include "client/cpl_client.h"
#include "cpl.h"
#include "transport/transport.h"

/* Any error that is left for a run under way ends it. */
static void must(struct cpl *c, int code)
{
    if (code == CPL_OK)
        return;
    log_quiet("%s", cpl_strerror(c));
    signals_handled(); /* cpl_fail says it itself */
    cpl_fail(c, code == CPL_EINPUT ? RUN_INPUT : RUN_PARTNER, cpl_strerror(c));
}

/* A refused job: the coupler's list is the same for all, so all leave in order. */
static int refused(struct cpl *c, int code)
{
    if (code == CPL_OK)
        return RUN_DONE;
    if (code != CPL_EINPUT)
        must(c, code);
    log_quiet("%s", cpl_strerror(c)); /* the coupler prints it, once for all */
    return RUN_INPUT;
}

/* Patience and hint are of the process, so they hold without a job, too. */
static int partner_open(MPI_Comm world, const char *name, double deadline, double patience,
                        MPI_Comm *comm, void **ctx)
{
    struct cpl *c = NULL;
    const int code = cpl_open(world, name, deadline, &c, comm);
    *ctx = c;
    cpl_patience(c, patience);
    signals_hint(failure_hint());
    return code == CPL_OK ? RUN_DONE : RUN_INPUT;
}

/* A program with faults meets the others all the same: all faults are told at once. */
static int partner_meet(void *ctx, const struct faults *f, bool sound, unsigned long long hash,
                        int64_t window, const char *dir)
{
    struct cpl *c = ctx;
    c->faults = f->text;
    const int code = cpl_meet(c, hash, window, f->n > 0 ? f->n : !sound, dir);
    c->faults = NULL;
    return refused(c, code);
}

static int partner_ready(void *ctx, double t, double dt_longest)
{
    return refused(ctx, cpl_ready(ctx, t, dt_longest));
}

static bool partner_window(void *ctx, double *t0, double *t1, bool *output, bool *save, int *code)
{
    int action;
    char text[128];
    must(ctx, cpl_window(ctx, t0, t1, &action, code));
    *output = action & CPL_OUTPUT;
    *save = action & CPL_SAVE;
    snprintf(text, sizeof text, "coupler heard %.1f s before coupling step %lld", cpl_heard(ctx),
             (long long)cpl_window_number(ctx));
    signals_heard(text);
    return !(action & CPL_STOP);
}

static void tell(void *ctx, const char *key, double v) { (void)cpl_tell(ctx, key, v); }

/* All ranks tell; the library sends what rank 0 says. */
static void partner_advance(void *ctx, double t1, const struct summary *report, bool stop)
{
    if (report)
        summary_each(report, tell, ctx);
    must(ctx, cpl_advance(ctx, t1, stop));
}

static void partner_saved(void *ctx, int64_t window, const char *file)
{
    (void)window; /* the library knows it */
    must(ctx, cpl_saved(ctx, file));
}

static int64_t partner_window_number(void *ctx) { return cpl_window_number(ctx); }
static double partner_waited(void *ctx) { return cpl_waited(ctx); }

static void partner_fail(void *ctx, int code, const char *reason)
{
    signals_handled();
    cpl_fail(ctx, code, reason);
}

static void partner_close(void *ctx, int code, const struct summary *final)
{
    struct cpl *c = ctx;
    if (final)
        summary_each(final, tell, c);
    (void)cpl_close(&c, code);
}

const struct partner cpl_partner = {.open = partner_open,
                                    .meet = partner_meet,
                                    .ready = partner_ready,
                                    .window = partner_window,
                                    .advance = partner_advance,
                                    .saved = partner_saved,
                                    .window_number = partner_window_number,
                                    .waited = partner_waited,
                                    .fail = partner_fail,
                                    .close = partner_close};

/* plan.c - what the programs say about themselves, compared before anything runs. All problems are
 * found at once and printed by all programs. First the meeting (same case, same folder, same
 * restart point, no name twice), then the plan: each field that is taken becomes a link from its
 * one source.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

#include <stdarg.h>

#include "../../common/run/run.h"

/* A line more in a text of TEXT bytes; where it is full, it says so once. */
void problem(char *text, const char *fmt, ...)
{
    static const char more[] = "\n... and more";
    const size_t n = strlen(text), room = TEXT - n - sizeof more;
    char line[1024];
    va_list args;
    va_start(args, fmt);
    const int m = vsnprintf(line, sizeof line, fmt, args);
    va_end(args);
    if (n + sizeof more >= TEXT || strstr(text, more))
        return;
    if ((size_t)m + 2 > room || m >= (int)sizeof line)
        memcpy(text + n, more, sizeof more);
    else
        snprintf(text + n, room, "%s%s", n > 0 ? "\n" : "", line);
}

/* --- meeting --- */

/* In the order of cpl_meet. */
void plan_take_meet(struct coupler *c, struct solver *s, struct message *m)
{
    s->restart_window = m->head.tick;
    s->hash = (uint64_t)take_int(&c->wire, m);
    s->faults = (int)take_int(&c->wire, m);
    s->nzones = (int)take_int(&c->wire, m);
    require(s->nzones >= 0 && s->nzones <= (int)(sizeof s->zone / sizeof s->zone[0]));
    take_bytes(&c->wire, m, s->zone, (size_t)s->nzones * sizeof *s->zone);
    take_text(&c->wire, m, s->fault_lines, sizeof s->fault_lines);
    take_text(&c->wire, m, s->dir, sizeof s->dir);
    s->met = true;
}

static bool present(const struct coupler *c, const char *name)
{
    for (int i = 0; i < c->nsolvers; i++)
        if (strcmp(c->solver[i].name, name) == 0)
            return true;
    return false;
}

/* By the case's list, or by its groups. The names that must be here, and that none is here that
 * must not. */
static void check_programs(const struct coupler *c, char *text)
{
    char name[HANDSHAKE_NAME];
    const char *at = c->job.programs;
    while (job_next_program(&at, name))
        if (!present(c, name))
            problem(text, "coupler.programs names `%s', but it is not in this job", name);
    for (int i = 0; i < c->nsolvers && c->job.programs[0]; i++)
        if (!job_wants(&c->job, c->solver[i].name))
            problem(text, "program `%s' is in this job, but not in coupler.programs",
                    c->solver[i].name);
    if (c->job.programs[0])
        return;
    char names[PARAM_PROGRAMS_MAX][64];
    const int n = params_programs(c->params, "sph", names);
    for (int k = 0; k < n; k++)
        if (!present(c, names[k]))
            problem(text,
                    "the case has a group %s, but no program `%s' is in this job "
                    "(coupler.programs: others in its place)",
                    names[k], names[k]);
    if (c->scene.has_fv && !present(c, "fv"))
        problem(text, "the case has a group fv, but no program `fv' is in this job "
                      "(coupler.programs: others in its place)");
}

/* Whether one of the n lines is in the text. */
static bool holds_line(const char *text, const char *line, size_t n)
{
    for (const char *at = text; at && *at; at = strchr(at, '\n'), at += at != NULL)
        if (strncmp(at, line, n) == 0)
            return true;
    return false;
}

/* A line that several programs found in the same case is said once. */
void plan_say_faults(const struct coupler *c, const char *own)
{
    for (int i = 0; i < c->nsolvers; i++)
        for (const char *at = c->solver[i].fault_lines; *at;) {
            const size_t n = strcspn(at, "\n") + 1;
            bool said = own && holds_line(own, at, n);
            for (int j = 0; j < i; j++)
                said = said || holds_line(c->solver[j].fault_lines, at, n);
            if (!said)
                log_say("%.*s", (int)n - 1, at);
            at += strlen(at) < n ? strlen(at) : n;
        }
}

/* Another folder than the coupler's would split the output of one job. */
static void check_folder(const struct coupler *c, const struct solver *s, char *text)
{
    if (s->hash != 0 && s->faults == 0 && strcmp(s->dir, c->dir) != 0)
        problem(text, "%s writes into %s, coupler into %s: give all programs the same -o", s->name,
                s->dir, c->dir);
}

/* Rank 0 alone; the text is the verdict. */
void plan_check_meet(struct coupler *c, char *text)
{
    check_programs(c, text);
    for (int i = 0; i < c->nsolvers; i++) {
        const struct solver *s = &c->solver[i], *first = &c->solver[0];
        if (s->faults > 0)
            problem(text, "%s: %d fault%s in its input", s->name, s->faults,
                    s->faults > 1 ? "s" : "");
        else if (s->hash != 0 && s->hash != c->hash)
            problem(text,
                    "%s reads another case than coupler (hash %016llx, not %016llx): give all "
                    "programs the same file and the same -p",
                    s->name, (unsigned long long)s->hash, (unsigned long long)c->hash);
        check_folder(c, s, text);
        if (s->restart_window != first->restart_window && s->faults == 0 && first->faults == 0)
            problem(text,
                    "%s starts at coupling step %lld, %s at coupling step %lld: restart all from "
                    "one manifest",
                    s->name, (long long)s->restart_window, first->name,
                    (long long)first->restart_window);
        for (int j = 0; j < i; j++)
            for (int a = 0; a < s->nzones; a++)
                for (int b = 0; b < c->solver[j].nzones; b++)
                    if (strcmp(s->zone[a].name, c->solver[j].zone[b].name) == 0)
                        problem(text, "zone %s is published by %s and by %s", s->zone[a].name,
                                s->name, c->solver[j].name);
    }
}

/* The verdict and all zones, the same bytes to everybody. */
void plan_answer_meet(struct coupler *c, const char *text)
{
    struct pack p;
    int n = 0;
    pack_begin(&p, WIRE_MET, 0, 0);
    pack_text(&p, text);
    for (int i = 0; i < c->nsolvers; i++)
        n += c->solver[i].nzones;
    pack_int(&p, n);
    for (int i = 0; i < c->nsolvers; i++)
        pack_bytes(&p, c->solver[i].zone, (size_t)c->solver[i].nzones * sizeof *c->solver[i].zone);
    for (int i = 0; i < c->nsolvers; i++) {
        struct pack copy = {0};
        pack_bytes(&copy, p.bytes, p.n);
        wire_send_all(&c->wire, c->solver[i].peer, &copy);
    }
    for (int r = 1; r < c->size; r++) {
        struct pack copy = {0};
        pack_bytes(&copy, p.bytes, p.n);
        wire_send(&c->wire, c->own_peer, r, &copy);
    }
    free(p.bytes);
}

/* --- the plan --- */

/* Counts are checked before they are used as lengths: the message comes from another program. */
void plan_take_ready(struct coupler *c, struct solver *s, struct message *m)
{
    struct wire *const w = &c->wire;
    s->t = take_real(w, m);
    s->dt_longest = take_real(w, m);
    s->nsets = (int)take_int(w, m);
    require(s->nsets >= 0 && s->nsets <= LIMIT_SETS);
    for (int i = 0; i < s->nsets; i++) {
        struct solver_set *set = &s->set[i];
        take_text(w, m, set->name, sizeof set->name);
        set->is_grid = take_int(w, m) != 0;
        set->dim = (int)take_int(w, m);
        set->support = take_real(w, m);
        take_bytes(w, m, set->period, sizeof set->period);
        take_bytes(w, m, &set->grid, sizeof set->grid);
    }
    s->nfields = (int)take_int(w, m);
    require(s->nfields >= 0 && s->nfields <= LIMIT_FIELDS);
    for (int i = 0; i < s->nfields; i++) {
        struct solver_field *f = &s->field[i];
        take_text(w, m, f->name, sizeof f->name);
        take_text(w, m, f->unit, sizeof f->unit);
        f->set = (int)take_int(w, m);
        f->ncomp = (int)take_int(w, m);
        f->direction = (int)take_int(w, m);
        f->how = (int)take_int(w, m);
        f->link = -1;
        f->last_tick = -1;
        require(f->set >= 0 && f->set < s->nsets);
    }
    s->advanced = -1;
    s->ready = true;
}

/* Source and target must agree in unit, components, dimensions and periods, and the way of mapping
 * must suit what the source has, points or a grid. */
static void check_link(const struct partner_link *l, const struct solver *g, const struct solver *t,
                       char *text)
{
    const struct solver_field *give = &g->field[l->gfield], *take = &t->field[l->tfield];
    const struct solver_set *from = &g->set[give->set], *to = &t->set[take->set];
    if (strcmp(give->unit, take->unit) != 0)
        problem(text, "field %s: %s gives it in %s, %s takes it in %s", give->name, g->name,
                give->unit, t->name, take->unit);
    if (give->ncomp != take->ncomp)
        problem(text, "field %s: %s gives %d components, %s takes %d", give->name, g->name,
                give->ncomp, t->name, take->ncomp);
    if (from->dim != to->dim)
        problem(text, "field %s: %s of %s has %d dimensions, %s of %s has %d", give->name,
                from->name, g->name, from->dim, to->name, t->name, to->dim);
    if (to->is_grid)
        problem(text, "field %s: %s takes it on grid %s; a target needs points", give->name,
                t->name, to->name);
    if (!from->is_grid && !(to->support > 0.0 && isfinite(to->support)))
        problem(text, "field %s: %s of %s has no support radius in which points are gathered",
                give->name, to->name, t->name);
    if (from->is_grid && (take->how & CPL_CONSERVATIVE))
        problem(text,
                "field %s: %s takes it conservatively, but %s gives it on a grid: that is "
                "interpolated (CPL_LINEAR, CPL_CUBIC); cells are mapped as points (cpl_move_cells)",
                give->name, t->name, g->name);
    else if (from->is_grid ? take->how != CPL_LINEAR && take->how != CPL_CUBIC
                           : (take->how & ~CPL_CONSERVATIVE) > CPL_SUM || take->how < 0 ||
                                 take->how == (CPL_SUM | CPL_CONSERVATIVE))
        problem(text, "field %s: %s asks for an unknown way (%d) of mapping", give->name, t->name,
                take->how);
    for (int a = 0; a < 3; a++)
        if (from->period[a] > 0.0 && to->period[a] > 0.0 && from->period[a] != to->period[a])
            problem(text, "field %s: %s of %s has the period %g m, %s of %s %g m", give->name,
                    from->name, g->name, from->period[a], to->name, t->name, to->period[a]);
}

/* Of a set of the link, or of the case. */
static void find_period(const struct coupler *c, const struct solver_set *from,
                        const struct solver_set *to, double period[3])
{
    for (int a = 0; a < 3; a++)
        period[a] = to->period[a] > 0.0     ? to->period[a]
                    : from->period[a] > 0.0 ? from->period[a]
                                            : c->job.period[a];
}

static map_points *consistent(int how)
{
    static map_points *const of[] = {map_shepard, map_mls, map_nearest, map_sum};
    return how >= 0 && how <= CPL_SUM ? of[how] : NULL;
}

/* Of a field that is taken conservatively. */
static enum map_dealing dealing(int how)
{
    const int kind = how & ~CPL_CONSERVATIVE;
    return kind == CPL_MLS       ? MAP_DEAL_MLS
           : kind == CPL_NEAREST ? MAP_DEAL_NEAREST
                                 : MAP_DEAL_SHEPARD;
}

/* l->number counts the targets of one field, by which the source tells them apart. */
static void make_link(struct coupler *c, int g, int gf, int t, int tf, char *text)
{
    struct solver_field *give = &c->solver[g].field[gf], *take = &c->solver[t].field[tf];
    if (c->nlinks == LIMIT_LINKS || give->ntargets == LIMIT_TARGETS) {
        problem(text, "field %s: more than %d targets of one field, or %d in the job", give->name,
                LIMIT_TARGETS, LIMIT_LINKS);
        return;
    }
    struct partner_link *l = &c->link[c->nlinks];
    const struct solver_set *from = &c->solver[g].set[give->set],
                            *to = &c->solver[t].set[take->set];
    *l = (struct partner_link){.source = g,
                               .gfield = gf,
                               .target = t,
                               .tfield = tf,
                               .from_grid = from->is_grid,
                               .ncomp = give->ncomp,
                               .dim = from->dim,
                               .number = give->ntargets,
                               .map = consistent(take->how),
                               .deal = dealing(take->how),
                               .grid = from->grid,
                               .support = to->support,
                               .asked_tick = -1};
    l->in[0].tick = l->in[1].tick = -1;
    find_period(c, from, to, l->period);
    check_link(l, &c->solver[g], &c->solver[t], text);
    give->target[give->ntargets++] = take->link = c->nlinks++;
}

/* Who gives this field besides solver `except'; counts them. */
static int find_source(const struct coupler *c, const char *name, int *solver, int *field)
{
    int n = 0;
    for (int i = 0; i < c->nsolvers; i++)
        for (int j = 0; j < c->solver[i].nfields; j++)
            if ((c->solver[i].field[j].direction & CPL_PUT) &&
                strcmp(c->solver[i].field[j].name, name) == 0) {
                *solver = i;
                *field = j;
                n++;
            }
    return n;
}

/* Links in the order of targets and their fields, the same on all ranks. A field that is given and
 * not taken is a problem, too, unless it was declared optional: most often a name is misspelt. */
void plan_make_links(struct coupler *c, char *text)
{
    for (int t = 0; t < c->nsolvers; t++)
        for (int j = 0; j < c->solver[t].nfields; j++) {
            const struct solver_field *f = &c->solver[t].field[j];
            int g = 0, gf = 0;
            if (f->direction != CPL_GET)
                continue;
            const int n = find_source(c, f->name, &g, &gf);
            if (n == 0)
                problem(text, "field %s: %s takes it, but nobody gives it", f->name,
                        c->solver[t].name);
            else if (n > 1)
                problem(text, "field %s: it is given %d times", f->name, n);
            else if (g == t)
                problem(text, "field %s: %s gives it and takes it itself", f->name,
                        c->solver[t].name);
            else
                make_link(c, g, gf, t, j, text);
        }
    for (int g = 0; g < c->nsolvers; g++)
        for (int j = 0; j < c->solver[g].nfields; j++)
            if (c->solver[g].field[j].direction == CPL_PUT && c->solver[g].field[j].ntargets == 0)
                problem(text,
                        "field %s: %s gives it, but nobody takes it (CPL_OPTIONAL: nobody must)",
                        c->solver[g].field[j].name, c->solver[g].name);
}

/* To each solver, in the order in which it declared its fields: who gives them, on what grid, and
 * how many take them. */
void plan_answer_ready(struct coupler *c, const char *text)
{
    for (int i = 0; i < c->nsolvers; i++) {
        const struct solver *s = &c->solver[i];
        struct pack p;
        pack_begin(&p, WIRE_PLAN, 0, c->window);
        pack_text(&p, text);
        for (int j = 0; j < s->nfields; j++) {
            const int k = s->field[j].link;
            const struct partner_link *l = k >= 0 ? &c->link[k] : NULL;
            const struct cpl_grid none = {0};
            pack_text(&p, l ? c->solver[l->source].name : "");
            pack_int(&p, l && l->from_grid);
            pack_bytes(&p, l ? &l->grid : &none, sizeof none);
            pack_int(&p, s->field[j].ntargets);
        }
        wire_send_all(&c->wire, s->peer, &p);
    }
}

/* In words. */
static const char *way_of(const struct partner_link *l, int how)
{
    static const char *const grid[] = {"linear", "cubic"};
    static const char *const points[] = {"Shepard", "moving least squares", "nearest", "sum"};
    static const char *const dealt[] = {
        "conservative, Shepard", "conservative, moving least squares", "conservative, nearest"};
    const int kind = how & ~CPL_CONSERVATIVE;
    return l->from_grid ? grid[kind == CPL_CUBIC] : how != kind ? dealt[kind] : points[kind];
}

void plan_describe(const struct coupler *c)
{
    for (int i = 0; i < c->nlinks; i++) {
        const struct partner_link *l = &c->link[i];
        const struct solver_field *f = &c->solver[l->source].field[l->gfield];
        const int how = c->solver[l->target].field[l->tfield].how;
        log_say("  %-20s %s -> %s  %d x %s, %s", f->name, c->solver[l->source].name,
                c->solver[l->target].name, f->ncomp, f->unit, way_of(l, how));
    }
    const double span = c->t_end - c->t_base, every = c->scene.output.every;
    const int64_t n = c->nwindows - c->base;
    const double off = coupling_steps_off(n, span, window_since(c), every);
    log_say("  %lld coupling steps of %.6g s", (long long)n, span / (double)n);
    if (c->base > 0)
        log_say("  divided anew from t = %.6g s on: there is no end of a coupling step of the "
                "whole run there (another time.end, output.every or other wishes of the programs)",
                c->t_base);
    if (off > 0.0)
        log_say("  output.every = %g s is no whole number of them: each output comes at the end of "
                "the coupling step next to it, up to %.2g s off",
                every, off);
}

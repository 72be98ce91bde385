/* report.c - what the job tells its user: a line every few seconds, a table and summary.json at the
 * end. Numbers come from the solvers (cpl_tell); norms over parts of the flow add up here.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "coupler.h"

#include "../../common/run/run.h"

enum { LINE = 2048, NORMS = 16 };

/* Keys in the order of their first mention; a later value replaces the earlier one. */
void report_told(struct wire *w, struct message *m, struct told *t)
{
    const int64_t n = take_int(w, m);
    for (int64_t i = 0; i < n; i++) {
        char key[TOLD_KEY];
        int k = 0;
        take_text(w, m, key, sizeof key);
        const double value = take_real(w, m);
        while (k < t->n && strcmp(t->of[k].key, key) != 0)
            k++;
        if (k == TOLD_KEYS) {
            if (!t->full)
                log_warn(
                    "a program reports more than %d numbers: `%s' and what follows is left out",
                    TOLD_KEYS, key);
            t->full = true;
            continue;
        }
        t->n += k == t->n;
        memcpy(t->of[k].key, key, sizeof key);
        t->of[k].value = value;
    }
}

static bool is_norm(const char *key) { return strncmp(key, "norm.", 5) == 0; }
static bool is_sum(const char *key) { return strncmp(key, "sum.", 4) == 0; }

/* Cost and norms belong to the end of the run, not to its progress. */
static bool in_progress_line(const char *key)
{
    static const char *const not [] = {"wall_s", "cpu_s", "steps", "t", "t_end", "ranks", "dim"};
    for (size_t i = 0; i < sizeof not / sizeof *not ; i++)
        if (strcmp(key, not [i]) == 0)
            return false;
    return !is_norm(key) && !strchr(key, '.');
}

/* The share of the time so far that each solver has waited. */
static void waiting(const struct coupler *c, char *line, double elapsed)
{
    text_add(line, LINE, "  wait");
    for (int i = 0; i < c->nsolvers; i++)
        text_add(line, LINE, " %s %.0f%%", c->solver[i].name,
                 100.0 * c->solver[i].waited / elapsed);
}

/* The time left by the mean of the coupling steps since the first, which contains the solvers'
 * start. */
void report_progress(struct coupler *c)
{
    char line[LINE];
    const double now = wall_time(), elapsed = fmax(now - c->start, 1e-9);
    const int64_t done = c->window - c->first_window, left = c->nwindows - c->window;
    if (now < c->line_at || done < 2 || c->window == c->line_window)
        return;
    const long s = lrint((now - c->first_end) / (double)(done - 1) * (double)left);
    snprintf(line, LINE, "%9.4g/%g s  %3.0f %%  left %ld:%02ld", window_start(c, c->window),
             c->t_end, 100.0 * (double)c->window / (double)c->nwindows, s / 60, s % 60);
    for (int i = 0; i < c->nsolvers; i++) {
        const struct told *t = &c->solver[i].told;
        bool first = true;
        for (int k = 0; k < t->n; k++)
            if (in_progress_line(t->of[k].key)) {
                if (first)
                    text_add(line, LINE, "  %s:", c->solver[i].name);
                text_add(line, LINE, " %s %.3g", t->of[k].key, t->of[k].value);
                first = false;
            }
    }
    waiting(c, line, elapsed);
    log_say("%s", line);
    /* 1, 2, 5, 10, 30, 60 s apart as the run grows */
    c->line_every = elapsed < 10.0     ? 2.0
                    : elapsed < 60.0   ? 5.0
                    : elapsed < 600.0  ? 10.0
                    : elapsed < 3600.0 ? 30.0
                                       : 60.0;
    c->line_at = now + c->line_every;
    c->line_window = c->window;
}

/* --- the end --- */

struct report_norm {
    char name[TOLD_KEY];
    double vol, e1, e2, r2, emax;
    double unit; /* of _rms and _linf, as the solvers have it; else that of the field */
};

/* NULL: more kinds of errors than there is room for. */
static struct report_norm *norm_named(struct report_norm *all, int *n, const char *name,
                                      size_t length)
{
    for (int i = 0; i < *n; i++)
        if (strlen(all[i].name) == length && strncmp(all[i].name, name, length) == 0)
            return &all[i];
    if (*n == NORMS)
        return NULL;
    struct report_norm *new = &all[(*n)++];
    *new = (struct report_norm){.emax = -1.0, .unit = 1.0}; /* not told */
    memcpy(new->name, name, length);
    return new;
}

/* "norm.velocity.e2" of all solvers. vol, e1, e2, r2 are integrals over a program's part of the
 * flow (of 1, error, error^2, reference^2): they add up; emax is a maximum. */
static int add_norms(const struct coupler *c, struct report_norm *all)
{
    int n = 0;
    for (int i = 0; i < c->nsolvers; i++)
        for (int k = 0; k < c->solver[i].told.n; k++) {
            const struct told_number *t = &c->solver[i].told.of[k];
            const char *dot = strrchr(t->key, '.');
            if (!is_norm(t->key) || dot < t->key + 5)
                continue;
            struct report_norm *m = norm_named(all, &n, t->key + 5, (size_t)(dot - t->key - 5));
            if (!m)
                continue;
            m->vol += strcmp(dot, ".vol") == 0 ? t->value : 0.0;
            m->e1 += strcmp(dot, ".e1") == 0 ? t->value : 0.0;
            m->e2 += strcmp(dot, ".e2") == 0 ? t->value : 0.0;
            m->r2 += strcmp(dot, ".r2") == 0 ? t->value : 0.0;
            if (strcmp(dot, ".emax") == 0)
                m->emax = fmax(m->emax, t->value);
            if (strcmp(dot, ".unit") == 0 && t->value > 0.0)
                m->unit = t->value;
        }
    return n;
}

/* group.name and what, "error.velocity_l2". */
static void put_number(struct summary *s, const char *group, const char *name, const char *what,
                       double v)
{
    char key[2 * TOLD_KEY + 32];
    snprintf(key, sizeof key, "%.63s.%.95s%.16s", group, name, what);
    summary_real(s, key, v);
}

/* Pressure of an incompressible flow is known up to a constant: its mean error does not count. */
static void put_errors(const struct coupler *c, struct summary *s)
{
    struct report_norm all[NORMS];
    const int n = add_norms(c, all);
    for (int i = 0; i < n; i++) {
        const struct report_norm *m = &all[i];
        if (strcmp(m->name, "pressure") == 0) {
            const double mean = m->e1 / m->vol;
            const double rms = sqrt(fmax(m->e2 / m->vol - mean * mean, 0.0));
            put_number(s, "error", m->name, "_rms", rms / m->unit);
            if (m->r2 > 0.0)
                put_number(s, "error", m->name, "_l2", rms / sqrt(m->r2 / m->vol));
        } else {
            if (m->r2 > 0.0)
                put_number(s, "error", m->name, "_l2", sqrt(m->e2 / m->r2));
            if (m->emax >= 0.0)
                put_number(s, "error", m->name, "_linf", m->emax / m->unit);
        }
    }
}

/* All that is neither a part of a norm nor of a sum goes under its program's name. */
static void put_told(const struct coupler *c, struct summary *s)
{
    for (int i = 0; i < c->nsolvers; i++)
        for (int k = 0; k < c->solver[i].told.n; k++) {
            const struct told_number *t = &c->solver[i].told.of[k];
            if (strcmp(t->key, "mass_fluctuation") == 0)
                summary_real(s, t->key, t->value);
            else if (!is_norm(t->key) && !is_sum(t->key))
                put_number(s, c->solver[i].name, t->key, "", t->value);
        }
}

/* What a solver waited for solver j; j = nsolvers: for the coupler, mapping and messages. The
 * coupler's clock and the solver's own may differ by a sleep between polls. */
static double waited_for(const struct coupler *c, int i, int j)
{
    double all = 0.0;
    for (int k = 0; k < c->nsolvers; k++)
        all += k == i ? 0.0 : c->solver[i].waited_for[k];
    const double scale = all > c->solver[i].waited ? c->solver[i].waited / all : 1.0;
    return j < c->nsolvers ? scale * c->solver[i].waited_for[j] : c->solver[i].waited - scale * all;
}

/* "waited_for.fv.sph": s that fv waited for sph. */
static void put_waits(const struct coupler *c, struct summary *s)
{
    char name[2 * CPL_NAME + 8];
    for (int i = 0; i < c->nsolvers; i++)
        for (int j = 0; j <= c->nsolvers; j++) {
            if (j == i)
                continue;
            snprintf(name, sizeof name, "%s.%s", c->solver[i].name,
                     j < c->nsolvers ? c->solver[j].name : "coupler");
            put_number(s, "waited_for", name, "", waited_for(c, i, j));
        }
}

/* Returns the processor time of the whole job, s. */
static double put_cost(const struct coupler *c, struct summary *s, double coupler_cpu, double wall)
{
    double cpu = coupler_cpu;
    int ranks = c->size;
    for (int i = 0; i < c->nsolvers; i++) {
        cpu += c->solver[i].cpu;
        ranks += c->solver[i].size;
    }
    summary_int(s, "ranks", ranks);
    for (int i = 0; i < c->nsolvers; i++)
        put_number(s, "ranks_of", c->solver[i].name, "", c->solver[i].size);
    put_number(s, "ranks_of", "coupler", "", c->size);
    summary_int(s, "dim", c->scene.domain.dim);
    summary_real(s, "wall_s", wall);
    summary_real(s, "cpu_s", cpu);
    summary_real(s, "t_end", window_start(c, c->window));
    summary_int(s, "windows", c->window - c->first_window);
    for (int i = 0; i < c->nsolvers; i++)
        put_number(s, "cpu_of", c->solver[i].name, "", c->solver[i].cpu);
    put_number(s, "cpu_of", "coupler", "", coupler_cpu);
    for (int i = 0; i < c->nsolvers; i++)
        put_number(s, "wait_s", c->solver[i].name, "", c->solver[i].waited);
    put_number(s, "wait_s", "coupler", "", c->idle);
    put_waits(c, s);
    summary_real(s, "coupler_share", coupler_cpu / cpu);
    for (int i = 0; i < c->nlinks; i++)
        put_number(s, "mapping_s", c->solver[c->link[i].source].field[c->link[i].gfield].name, "",
                   c->link[i].mapped);
    return cpu;
}

static void say_number(void *ctx, const char *key, double v)
{
    (void)ctx;
    if (strncmp(key, "error.", 6) == 0)
        log_say("  %-24s %.4g", key, v);
}

static void say_share(char *line, double waited, double wall, double cpu, int ranks)
{
    text_add(line, LINE, " %9.3g %6.0f %% %9.3g %6d", fmax(wall - waited, 0.0),
             100.0 * waited / wall, cpu, ranks);
    log_say("%s", line);
}

/* Columns as wide as the names. */
static int width_of(const char *name, int least)
{
    const int n = (int)strlen(name);
    return n > least ? n : least;
}

/* Who waited for whom: a row per program. */
static void say_waits(const struct coupler *c, double coupler_cpu, double wall)
{
    char line[LINE];
    int first = 10;
    for (int i = 0; i < c->nsolvers; i++)
        first = width_of(c->solver[i].name, first);
    snprintf(line, LINE, "  %-*s", first, "waited (s)");
    for (int j = 0; j < c->nsolvers; j++)
        text_add(line, LINE, "  for %-*s", width_of(c->solver[j].name, 7), c->solver[j].name);
    text_add(line, LINE, "  for coupler   at work  waited       cpu  ranks");
    log_say("%s", line);
    for (int i = 0; i <= c->nsolvers; i++) {
        const struct solver *s = i < c->nsolvers ? &c->solver[i] : NULL;
        snprintf(line, LINE, "  %-*s", first, s ? s->name : "coupler");
        for (int j = 0; j <= c->nsolvers; j++) {
            const int width = j < c->nsolvers ? 4 + width_of(c->solver[j].name, 7) : 11;
            if (s && j != i)
                text_add(line, LINE, "  %*.3g", width, waited_for(c, i, j));
            else
                text_add(line, LINE, "  %*s", width, j == i ? "-" : "");
        }
        if (s)
            say_share(line, s->waited, wall, s->cpu, s->size);
        else
            say_share(line, c->idle, wall, coupler_cpu, c->size);
    }
}

static void say_end(const struct coupler *c, const struct summary *s, double cpu,
                    double coupler_cpu, double wall)
{
    char line[LINE];
    snprintf(line, LINE, "  cost  %.3g s wall, %.3g s cpu:", wall, cpu);
    summary_each(s, say_number, NULL);
    for (int i = 0; i < c->nsolvers; i++)
        text_add(line, LINE, " %s %.1f %%", c->solver[i].name, 100.0 * c->solver[i].cpu / cpu);
    text_add(line, LINE, " coupler %.1f %%", 100.0 * coupler_cpu / cpu);
    log_say("%s", line);
    say_waits(c, coupler_cpu, wall);
}

/* Rank 0, after all have said goodbye, so that every program's series and figures are there. A
 * program's failure counts where the coupler itself knows of none. */
int report_summary(struct coupler *c, double coupler_cpu)
{
    char path[1100];
    const double wall = fmax(wall_time() - c->start, 1e-9);
    struct summary *s = summary_create();
    int code = c->code;
    for (int i = 0; i < c->nsolvers; i++)
        if (code == RUN_DONE && c->solver[i].code > RUN_NOT_ACCEPTED)
            code = c->solver[i].code;
    summary_text(s, "status",
                 code == RUN_DIVERGED  ? "diverged"
                 : code == RUN_STOPPED ? "stopped"
                                       : "done");
    summary_text(s, "case", c->command->case_file);
    summary_text(s, "program", "coupler");
    summary_text(s, "version", run_version);
    const double cpu = put_cost(c, s, coupler_cpu, wall);
    put_errors(c, s);
    sums_summarise(c, s);
    put_told(c, s);
    say_end(c, s, cpu, coupler_cpu, wall);
    if (code == RUN_DONE && c->scene.naccept > 0) {
        const bool good = accept_judge(&c->scene, c->case_dir, c->dir, s);
        summary_bool(s, "accepted", good);
        code = good ? RUN_DONE : RUN_NOT_ACCEPTED;
    }
    for (int i = 0; i < c->nsolvers; i++)
        if (code == RUN_DONE && c->solver[i].code == RUN_NOT_ACCEPTED) {
            log_say("not accepted: %s ended with a figure that is not sound", c->solver[i].name);
            code = RUN_NOT_ACCEPTED;
        }
    snprintf(path, sizeof path, "%s/summary.json", c->dir);
    summary_write(s, path);
    FREE(s);
    return code;
}

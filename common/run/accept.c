/* accept.c - a case's own criteria; see accept.h. Called by run.c at three moments: accept_check
 * with the case, accept_check_columns before the first step, both so that a criterion that can
 * never be met is told at once, and accept_judge at the end, from the files that the run has
 * written. Measured and computed series have rows of their own; values between rows are linear
 * throughout.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "accept.h"

#include "../files/files.h"

static const char *const measures[] = {"rms", "peak", "impulse", "arrival"};

/* --- measures --- */

/* Linear between rows; t lies within the series. */
static double value_at(struct accept_series s, double t)
{
    const int lo = lookup_row(s.t, 1, s.n - 1, t), hi = s.n > 1 ? lo + 1 : 0;
    const double dt = s.t[hi] - s.t[lo], w = dt > 0.0 ? (t - s.t[lo]) / dt : 0.0;
    return (1.0 - w) * s.v[lo] + w * s.v[hi];
}

/* Of the samples in a span of time, ends included. */
static double largest(struct accept_series s, double from, double to)
{
    double most = -INFINITY;
    for (int k = 0; k < s.n; k++)
        if (s.t[k] >= from && s.t[k] <= to)
            most = fmax(most, s.v[k]);
    return most;
}

/* Trapezoids over the parts of the rows' intervals within [from, to]; exact for what is linear
 * between rows. */
static double integral(struct accept_series s, double from, double to)
{
    double sum = 0.0;
    for (int k = 1; k < s.n; k++) {
        const double a = fmax(s.t[k - 1], from), b = fmin(s.t[k], to);
        if (b > a)
            sum += 0.5 * (b - a) * (value_at(s, a) + value_at(s, b));
    }
    return sum;
}

static double passes(struct accept_series s, double from, double to, double level)
{
    for (int k = 0; k < s.n; k++)
        if (s.t[k] >= from && s.t[k] <= to && s.v[k] >= level)
            return s.t[k];
    return NAN;
}

/* sqrt(mean of (run - ref)^2) over the rows of the reference within [from, to], divided by the
 * largest less the smallest value of the reference there. NaN if the reference does not change. */
static double rms(struct accept_series run, struct accept_series ref, double from, double to)
{
    double sum = 0.0, least = INFINITY, most = -INFINITY;
    int n = 0;
    for (int k = 0; k < ref.n; k++)
        if (ref.t[k] >= from && ref.t[k] <= to) {
            const double d = value_at(run, ref.t[k]) - ref.v[k];
            sum += d * d;
            n++;
            least = fmin(least, ref.v[k]);
            most = fmax(most, ref.v[k]);
        }
    return n > 0 && most > least ? sqrt(sum / n) / (most - least) : NAN;
}

static double relative(double a, double b) { return b != 0.0 ? fabs(a / b - 1.0) : NAN; }

/* Both series are cut to the time that they share within [from, to] first, so that neither is
 * continued beyond its ends. */
double accept_distance(int measure, struct accept_series run, struct accept_series ref, double from,
                       double to)
{
    if (run.n < 2 || ref.n < 2)
        return NAN;
    from = fmax(from, fmax(run.t[0], ref.t[0]));
    to = fmin(to, fmin(run.t[run.n - 1], ref.t[ref.n - 1]));
    if (!(to > from))
        return NAN;
    const double half = 0.5 * largest(ref, from, to);
    switch (measure) {
    case ACCEPT_PEAK:
        return relative(largest(run, from, to), 2.0 * half);
    case ACCEPT_IMPULSE:
        return relative(integral(run, from, to), integral(ref, from, to));
    case ACCEPT_ARRIVAL:
        return relative(passes(run, from, to, half), passes(ref, from, to, half));
    default:
        return rms(run, ref, from, to);
    }
}

/* --- the case --- */

static const char *column_of(const struct scene_accept *a)
{
    return *a->column ? a->column : a->what;
}

/* Whether a key of the summary, after its group, begins with a name, spaces being underscores. */
static bool begins_with(const char *key, const char *name)
{
    const size_t n = strlen(name);
    for (size_t i = 0; i < n; i++)
        if (key[i] != (name[i] == ' ' ? '_' : name[i]))
            return false;
    return key[n] == '.';
}

/* Bodies, gauges or groups of gauges: their names stand `stride' bytes apart. */
struct named {
    const char *first;
    size_t stride;
    int n;
};
static bool any_begins(const struct named *of, const char *key)
{
    bool any = false;
    for (int k = 0; k < of->n; k++)
        any = any || begins_with(key, of->first + (size_t)k * of->stride);
    return any;
}

static bool names_section(const struct scene *s, const char *key)
{
    bool any = false;
    for (int k = 0; k < s->nprobes; k++)
        any = any || (s->probes[k].kind == PROBE_DISCHARGE && begins_with(key, s->probes[k].name));
    return any;
}

static bool is_probe(const struct scene *s, const char *what)
{
    bool any = false;
    for (int k = 0; k < s->nprobes; k++)
        any = any || strcmp(what, s->probes[k].name) == 0;
    return any;
}

static void has_none(const char *what, const char *of, const char *key, const struct params *p,
                     struct faults *f)
{
    params_fault(p, f, key, "summary.json will have no %s: no %s of the case has that name", what,
                 of);
}

/* The errors that sph, fv and the coupler report (tests/style.sh compares). */
static const char *const errors[] = {
    "error.amplitude",     "error.crest",           "error.damping",
    "error.enstrophy",     "error.extrema",         "error.force",
    "error.force_x",       "error.force_y",         "error.free",
    "error.frequency",     "error.left_behind",     "error.level",
    "error.period",        "error.phase",           "error.place",
    "error.pressure_l2",   "error.pressure_offset", "error.pressure_rms",
    "error.reflected",     "error.second",          "error.velocity_l2",
    "error.velocity_linf", "error.velocity_rms",    "error.velocity_wall",
    "error.vorticity_l2"};

/* Of a field of another program, as the coupler reports it. */
static bool has_norm(const char *what)
{
    static const char *const norms[] = {"_l2", "_rms", "_linf"};
    bool any = false;
    for (size_t k = 0; k < sizeof norms / sizeof *norms; k++) {
        const size_t n = strlen(norms[k]), all = strlen(what);
        any = any || (all > n && strcmp(what + all - n, norms[k]) == 0);
    }
    return any;
}

/* The word of list[n] that is nearest to what is none of them; NULL: none is near. *known: it is
 * one of them. */
static const char *nearest_of(const char *what, const char *const *list, size_t n, bool *known)
{
    struct hint_nearest near = hint_nearest_start(what);
    *known = false;
    for (size_t k = 0; k < n; k++) {
        *known = *known || strcmp(what, list[k]) == 0;
        hint_nearest_try(&near, list[k]);
    }
    return hint_nearest_word(&near);
}

/* An error that no program reports: told now, not when the run is done. */
static void check_error(const char *what, const char *key, const struct params *p, struct faults *f)
{
    bool known;
    const char *word = nearest_of(what, errors, sizeof errors / sizeof *errors, &known);
    if (!known && (word || !has_norm(what)))
        params_fault(p, f, key, "no program reports %s%s%s%s", what, word ? ": did you mean " : "",
                     word ? word
                          : "; error.velocity_l2, error.pressure_rms and others are in "
                            "summary.json of a run",
                     word ? "?" : "");
}

/* First words of the keys of summary.json that sph and fv write (tests/style.sh compares). */
/* clang-format off */
static const char *const words[] = {
    "accepted", "backflow", "balance", "body", "born", "case", "cell_steps_per_s", "cells",
    "compare", "cpu_s", "damping", "dim", "discharge", "divergence", "dp", "drift", "drops", "dt",
    "du", "enstrophy", "error", "extrema", "faces_hold", "force", "fringe_cells", "fringe_cells_linear",
    "gone", "halved_steps", "height", "krylov_per_newton", "largest_velocity", "level_volume",
    "levels", "mass_fluctuation", "mass_fluctuation_particles", "max_cfl", "max_mach",
    "max_mach_late", "max_speed_over_U", "mesh", "modules", "momentum", "newton_iterations",
    "newton_residual", "norm", "not_accepted", "overlap", "pairs_per_s", "particles",
    "particles_lost", "particles_returned", "period", "poisson_iterations",
    "poisson_iterations_start", "poisson_retries", "program", "ranks", "reflection",
    "reinitialisations", "sound", "spacing", "start_s", "status", "steps", "steps_repeated", "sum",
    "t", "t_end", "through", "time_s", "us_per_cell_step_outside_hypre", "v_cycles", "version",
    "viscous_iterations", "volume_gained", "volume_lost", "volume_moved", "volume_returned",
    "wall_s", "watch",
};
/* clang-format on */

/* A number that neither sph nor fv reports. */
static void check_word(const char *what, const char *key, const struct params *p, struct faults *f)
{
    char first[PARAM_TEXT_SIZE];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(what, "."), what);
    bool known;
    const char *word = nearest_of(first, words, sizeof words / sizeof *words, &known);
    if (!known)
        params_fault(p, f, key, "summary.json has no %s%s%s%s", first,
                     word ? ": did you mean " : "",
                     word ? word : "; a column of series.csv needs a reference to compare it with",
                     word ? "?" : "");
}

/* A number of the summary is made at the end, but whose it is stands in the case. That of a job
 * holds what other programs report, too. */
static void check_number(const struct scene *s, int k, const struct params *p, struct faults *f)
{
    const struct {
        const char *group, *of;
        struct named among;
    } groups[] = {
        {"body.", "body", {s->bodies->name, sizeof *s->bodies, s->nbodies}},
        {"height.", "gauge", {s->probes->name, sizeof *s->probes, s->nprobes}},
        {"reflection.", "group of gauges", {s->gauges->name, sizeof *s->gauges, s->ngauges}}};
    const char *what = s->accept[k].what;
    const char *key = key_text("accept.[%d].what", k);
    if (is_probe(s, what)) {
        params_fault(p, f, key,
                     "%s is a gauge, a column of series.csv: give a reference to compare it with, "
                     "or name a number of summary.json",
                     what);
        return;
    }
    const int skip = strncmp(what, "sph.", 4) == 0 ? 4 : strncmp(what, "fv.", 3) == 0 ? 3 : 0;
    what += skip;
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        const size_t n = strlen(groups[g].group);
        if (strncmp(what, groups[g].group, n) == 0 && !any_begins(&groups[g].among, what + n))
            has_none(what, groups[g].of, key, p, f);
    }
    if (strncmp(what, "discharge.", 10) == 0 && !names_section(s, what + 10))
        has_none(what, "gauge of kind discharge", key, p, f);
    if (strncmp(what, "error.", 6) == 0)
        check_error(what, key, p, f);
    else if (skip > 0 || !s->has_sph || !s->has_fv)
        check_word(what, key, p, f);
}

/* A column of a table as a series, times and values scaled, rows that are no numbers left out. */
static struct accept_series series_of(const struct table *t, int column, double *room, double start,
                                      const double *unit)
{
    struct accept_series s = {.t = room, .v = room + t->nrows};
    for (int k = 0; k < t->nrows; k++) {
        const double *row = t->v + k * t->ncolumns;
        if (!isfinite(row[0]) || !isfinite(row[column]))
            continue;
        room[s.n] = start + unit[0] * row[0];
        room[t->nrows + s.n++] = unit[1] * row[column];
    }
    return s;
}

static bool changes(struct accept_series s)
{
    bool any = false;
    for (int k = 1; k < s.n; k++)
        any = any || s.v[k] != s.v[0];
    return any;
}

/* A reference that the run never meets, or whose range, which is the unit of rms, is nothing. */
static void check_rows(const struct scene *s, int k, const struct table *t, const struct params *p,
                       struct faults *f)
{
    const struct scene_accept *a = s->accept + k;
    double *room = NEW(double, 2 * t->nrows);
    const struct accept_series ref =
        series_of(t, table_column(t, column_of(a)), room, a->start, a->unit);
    const double first = ref.n > 0 ? ref.t[0] : NAN, last = ref.n > 0 ? ref.t[ref.n - 1] : NAN;
    if (!(fmin(a->until, last) > fmax(a->from, 0.0)) || !(first < s->time.end))
        params_fault(
            p, f, key_text("accept.[%d].reference", k),
            "its rows are those of %g to %g s: the run, from 0 to %g s, meets none of them "
            "between accept.from and accept.until, %g to %g s",
            first, last, s->time.end, a->from, a->until);
    else if (a->measure == ACCEPT_RMS && !changes(ref))
        params_fault(p, f, key_text("accept.[%d].measure", k),
                     "rms is taken over the range of the reference, which is %g throughout: peak "
                     "and impulse compare with such a value",
                     ref.v[0]);
    FREE(room);
}

/* Before the run: a reference that cannot be read must not be found out after hours. */
void accept_check(const struct scene *s, const char *case_dir, const struct params *p,
                  struct faults *f)
{
    for (int k = 0; k < s->naccept; k++) {
        const struct scene_accept *a = s->accept + k;
        const char *path = case_path(case_dir, a->reference);
        const char *key = key_text("accept.[%d].reference", k);
        if (!*a->reference) {
            check_number(s, k, p, f);
            continue;
        }
        struct table *t = table_read(path);
        if (!t)
            params_fault(p, f, key, "%s cannot be read, or has no row of numbers", path);
        else if (table_column(t, "t") != 0)
            params_fault(p, f, key, "%s: its first column must be t", path);
        else if (table_column(t, column_of(a)) < 0)
            params_fault(p, f, key, "%s has no column %s", path, column_of(a));
        else
            check_rows(s, k, t, p, f);
        FREE(t);
    }
}

/* Whether a column "H1 [m]" of a series is of this name. */
static bool is_column(const char *column, const char *name)
{
    const size_t n = strlen(name);
    return strncmp(column, name, n) == 0 &&
           (column[n] == '\0' || strncmp(column + n, " [", 2) == 0);
}

/* A gauge whose column another has the name of: who reads series.csv finds the first of them. */
static void check_gauges(const struct scene *s, const struct params *p, int n,
                         const char *const *columns, struct faults *f)
{
    for (int k = 0; k < s->nprobes; k++) {
        int alike = 0;
        for (int i = 0; i < n; i++)
            alike += is_column(columns[i], s->probes[k].name);
        if (alike > 1)
            params_fault(p, f, key_text("probes.[%d].name", k),
                         "%s: series.csv has a column of this name already: give the "
                         "gauge another",
                         s->probes[k].name);
    }
}

/* Also finds the name of a column that is nearest to the one asked for, for the message.
 * hint_nearest keeps a pointer to the best word, and `name' is written anew for each column: the
 * word is copied when it leads, and only its distance is kept. */
void accept_check_columns(const struct scene *s, const struct params *p, int n,
                          const char *const *columns, struct faults *f)
{
    check_gauges(s, p, n, columns, f);
    for (int k = 0; k < s->naccept; k++) {
        const struct scene_accept *a = s->accept + k;
        struct hint_nearest near = hint_nearest_start(a->what);
        bool found = !*a->reference; /* a number of the summary, which is made at the end */
        char name[PARAM_TEXT_SIZE], word[PARAM_TEXT_SIZE] = "";
        for (int i = 0; i < n && !found; i++) {
            found = is_column(columns[i], a->what);
            const int length = (int)strcspn(columns[i], "[");
            snprintf(name, sizeof name, "%.*s", length > 1 ? length - 1 : 0, columns[i]);
            hint_nearest_try(&near, name);
            if (hint_nearest_word(&near) == name)
                memcpy(word, name, sizeof word);
            near.best = NULL; /* its distance counts on */
        }
        if (found)
            continue;
        params_fault(p, f, key_text("accept.[%d].what", k),
                     "series.csv of this run has no column %s%s%s%s", a->what,
                     *word ? ": did you mean " : "", word, *word ? "?" : "");
    }
}

/* The series that has the column: of a program alone, or of one of a job. */
static struct table *find_series(const char *dir, const char *what)
{
    static const char *const files[] = {"series.csv", "sph-series.csv", "fv-series.csv"};
    for (int k = 0; k < 3; k++) {
        struct table *t = table_read(key_text("%s/%s", dir, files[k]));
        if (t && table_column(t, what) >= 0)
            return t;
        FREE(t);
    }
    return NULL;
}

/* The distance of criterion a, NaN if a file or column is missing. The reference's rows are brought
 * to the run's units and start first: t = start + unit[0] t_ref, v = unit[1] v_ref. */
static double compare(const struct scene_accept *a, const char *case_dir, const char *dir)
{
    struct table *ref = table_read(case_path(case_dir, a->reference)),
                 *run = find_series(dir, a->what);
    double d = NAN;
    if (ref && run) {
        double *room[2] = {NEW(double, 2 * run->nrows), NEW(double, 2 * ref->nrows)};
        const struct accept_series of_run =
            series_of(run, table_column(run, a->what), room[0], 0.0, (const double[]){1.0, 1.0});
        const struct accept_series of_ref =
            series_of(ref, table_column(ref, column_of(a)), room[1], a->start, a->unit);
        d = accept_distance(a->measure, of_run, of_ref, a->from, a->until);
        FREE(room[0], room[1]);
    }
    FREE(ref, run);
    return d;
}

static void name_of(const struct scene_accept *a, char *name, size_t size)
{
    snprintf(name, size, "compare.%.80s %s", a->what, measures[a->measure]);
    for (char *c = name; *c; c++)
        *c = (char)(*c == ' ' ? '_' : *c);
}

bool accept_judge(const struct scene *s, const char *case_dir, const char *dir,
                  struct summary *summary)
{
    bool all = true;
    for (int k = 0; k < s->naccept; k++) {
        const struct scene_accept *a = s->accept + k;
        char name[PARAM_TEXT_SIZE];
        double v = NAN;
        snprintf(name, sizeof name, "%.*s", (int)sizeof name - 1, a->what);
        if (*a->reference) {
            v = compare(a, case_dir, dir);
            name_of(a, name, sizeof name);
            summary_real(summary, name, v);
        } else {
            (void)summary_find(summary, a->what, &v);
        }
        const bool good = fabs(v) <= a->tolerance; /* false for NaN */
        log_say("%-10s %s %.4g (<= %g)%s", good ? "accepted" : "NOT MET", name, v, a->tolerance,
                isnan(v) ? ": there is no such number" : "");
        all = all && good;
    }
    return all;
}

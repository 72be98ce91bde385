/* wave_gauges.c - see wave_gauges.h. The check runs with the case; the evaluation at the end of a
 * run, on rank 0, over a whole number of periods that end with the run: onward and returning waves
 * from the amplitudes at all gauges of a group (common/waves/reflection.h), heights by zero
 * crossings (wave_statistics.h), spectra by Welch's method.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_gauges.h"

#include <complex.h>

#include "../waves/waves.h"

/* Of the normal equations: below 0.15 errors of the places and the waves grow threefold, below
 * 0.01 tenfold. */
static const double well_placed = 0.15, useless = 0.01;

/* The probes of a group by name; -1: a name is none; their number. The list is cut at blanks and
 * commas. */
static int probes_of(const struct scene *s, const struct scene_gauges *g, int probe[GAUGE_PROBES],
                     char wrong[PARAM_TEXT_SIZE])
{
    char names[PARAM_TEXT_SIZE];
    int n = 0;
    snprintf(names, sizeof names, "%s", g->probes);
    for (char *rest = names, *name; (name = strtok_r(rest, " ,", &rest)) != NULL;) {
        int k = 0;
        while (k < s->nprobes &&
               (strcmp(s->probes[k].name, name) != 0 || s->probes[k].kind != PROBE_LEVEL))
            k++;
        if (k == s->nprobes || n == GAUGE_PROBES) {
            snprintf(wrong, PARAM_TEXT_SIZE, "%s", name);
            return -1;
        }
        probe[n++] = k;
    }
    return n;
}

/* The period of a steady wave is found, so that records of whole periods may seem shorter. */
static const double alike = 1.0 + 1e-6;

/* s: the group's own, else that of the waves that are made, a sea's at its peak; 0: no waves and
 * none given. */
static double period_of(const struct scene *s, const struct scene_gauges *g)
{
    return g->period > 0.0 ? g->period : s->waves.made.period;
}

/* 1/m: of linear waves of that frequency, rad/s, over the depth below the group's gauges. */
static double linear_number(const struct scene *s, const struct scene_gauges *g, double omega)
{
    return waves_number(omega, vec3_length(s->fluid.gravity),
                        g->depth > 0.0 ? g->depth : scene_waves_depth(s));
}

/* Wave number of the group's period: of the waves that are made, else, or over a depth of its own,
 * of linear ones. */
static double number_of(const struct scene *s, const struct scene_gauges *g, double period)
{
    const struct waves_made *made = &s->waves.made;
    if (s->waves.kind == WAVE_REGULAR && fabs(made->period / period - 1.0) < 1e-6 &&
        !(g->depth > 0.0))
        return 2.0 * M_PI / made->length;
    return linear_number(s, g, 2.0 * M_PI / period);
}

/* m: places of the probes along the waves. */
static void places_of(const struct scene *s, int n, const int *probe, double *x)
{
    double d[3];
    scene_waves_direction(s, d, NULL);
    for (int i = 0; i < n; i++)
        x[i] = vec3_dot(s->probes[probe[i]].at, d);
}

static bool any_moves(const struct scene *s, int n, const int *probe)
{
    bool any = false;
    for (int i = 0; i < n; i++)
        any = any || s->probes[probe[i]].body[0];
    return any;
}

/* The first gauge of a group that another program reads than the first one, or -1. */
static int apart(const bool *elsewhere, int n, const int *probe)
{
    for (int i = 1; i < n; i++)
        if (elsewhere[probe[i]] != elsewhere[probe[0]])
            return probe[i];
    return -1;
}

/* The first gauge of a group that stands in a zone, where waves of one direction grow or decay, or
 * -1; *of: the zone's side. */
static int zoned(const struct scene *s, int n, const int *probe, const struct scene_wall **of)
{
    for (int i = 0; i < n; i++)
        for (int k = 0; k < s->nwalls; k++) {
            double lo[3], hi[3];
            *of = s->walls + k;
            const int axis = scene_zone_box(s, *of, lo, hi);
            const double x = axis < 0 ? 0.0 : s->probes[probe[i]].at[axis];
            if (axis >= 0 && (lo[axis] > s->domain.min[axis] ? x > lo[axis] : x < hi[axis]))
                return probe[i];
        }
    return -1;
}

static void warn_of_places(const struct scene *s, const struct scene_gauges *g, int n,
                           const int *probe, double number)
{
    double x[GAUGE_PROBES];
    const double complex still[GAUGE_PROBES] = {0.0};
    const struct scene_wall *of;
    places_of(s, n, probe, x);
    const double condition = reflection_separate(n, x, still, number).condition;
    if (condition < well_placed)
        log_warn("gauges %s: these places tell waves of %.3g m apart badly (%.2g of 1): gauges at "
                 "0, 0.1 and 0.27 of that do",
                 g->name, 2.0 * M_PI / number, condition);
    const int in = zoned(s, n, probe, &of);
    if (in >= 0)
        log_warn("gauges %s: %s stands in the zone of %.4g m before %s, where waves are made or "
                 "taken: what runs onward and back is told beyond it",
                 g->name, s->probes[in].name, of->beach, scene_side_names[of->side - SIDE_X_MIN]);
}

/* A group whose gauges stand badly is only warned of: the amplitudes are not told apart, but
 * heights and spectra are good. */
void wave_gauges_check(const struct scene *s, const bool *elsewhere, const struct params *p,
                       struct faults *f)
{
    for (int k = 0; k < s->ngauges; k++) {
        const struct scene_gauges *g = s->gauges + k;
        char wrong[PARAM_TEXT_SIZE];
        int probe[GAUGE_PROBES];
        const int n = probes_of(s, g, probe, wrong);
        const double period = period_of(s, g);
        const char *key = key_text("gauges.[%d].probes", k);
        if (n < 0)
            params_fault(p, f, key, "%s is no level gauge of the list probes, or there are over %d",
                         wrong, GAUGE_PROBES);
        else if (n < 2)
            params_fault(p, f, key, "two gauges or more tell incident from reflected waves");
        else if (any_moves(s, n, probe))
            params_fault(p, f, key,
                         "gauges that move with a body (probes.body) do not tell waves apart: "
                         "take gauges that stand");
        else if (apart(elsewhere, n, probe) >= 0)
            params_fault(p, f, key,
                         "%s and %s are read by different programs, in sph.box by sph, outside by "
                         "fv, and waves are told apart from the series of one: take gauges of one "
                         "part",
                         s->probes[probe[0]].name, s->probes[apart(elsewhere, n, probe)].name);
        else if (!(scene_waves_depth(s) > 0.0) && !(g->depth > 0.0))
            params_fault(p, f, key,
                         "no shape tells how deep the water is (waves.depth, gauges.depth)");
        if (!(period > 0.0))
            params_fault(p, f, key_text("gauges.[%d].period", k),
                         "no group waves tells the period: give it, s");
        if (g->from > 0.0 && period > 0.0 && (s->time.end - g->from) * alike < 2.0 * period)
            params_fault(p, f, key_text("gauges.[%d].from", k),
                         "%g s: less than two periods (%.4g s) before time.end", g->from, period);
        if (f->n > 0)
            continue;
        warn_of_places(s, g, n, probe, number_of(s, g, period));
    }
}

/* --- at the end --- */

struct history {
    int n;
    double *t, *v[GAUGE_PROBES];
};

/* Rows from a time on in which all probes have a level; n < 0: a column is missing. */
static struct history read_history(const struct scene *s, const struct table *t, int n,
                                   const int *probe, double from)
{
    struct history h = {.t = NEW(double, t->nrows)};
    int column[GAUGE_PROBES];
    for (int i = 0; i < n; i++) {
        column[i] = table_column(t, s->probes[probe[i]].name);
        h.v[i] = NEW(double, t->nrows);
        h.n = column[i] < 0 ? -1 : h.n;
    }
    for (int row = 0; row < t->nrows && h.n >= 0; row++) {
        const double *v = t->v + (size_t)row * t->ncolumns;
        bool good = v[0] >= from;
        for (int i = 0; i < n; i++)
            good = good && isfinite(v[column[i]]);
        if (!good)
            continue;
        for (int i = 0; i < n; i++)
            h.v[i][h.n] = v[column[i]];
        h.t[h.n++] = v[0];
    }
    return h;
}

static void free_history(struct history *h, int n)
{
    mem_free(h->t);
    for (int i = 0; i < n; i++)
        mem_free(h->v[i]);
}

/* Whether the waves told apart are those of a sea or a group of the group waves. */
static bool is_sea(const struct scene *s, const struct scene_gauges *g)
{
    return s->has_waves && s->waves.kind != WAVE_REGULAR && !(g->period > 0.0);
}

/* s: what the record is cut to a whole number of: a period, or what a sea repeats itself after
 * where the record holds that, for then its lines are those of the spectrum and none leaks into
 * another. */
static double unit_of(const struct scene *s, const struct scene_gauges *g, double record)
{
    const double period = period_of(s, g), repeat = is_sea(s, g) && s->waves.kind != WAVE_FILE
                                                        ? scene_waves_spec(s).repeat
                                                        : INFINITY;
    return record * (1.0 + 1e-9) >= repeat ? repeat : period;
}

/* Whether a sea's record holds no whole repeat, so that its lines leak into each other. */
static bool leaks(const struct scene *s, const struct scene_gauges *g, double all)
{
    return is_sea(s, g) && s->waves.kind == WAVE_SEA && unit_of(s, g, all) == period_of(s, g);
}

/* m/s: at which the groups of the peak's waves run below the gauges. */
static double group_speed(const struct scene *s, const struct scene_gauges *g)
{
    const double omega = 2.0 * M_PI / period_of(s, g);
    return 0.02 * omega / (linear_number(s, g, 1.01 * omega) - linear_number(s, g, 0.99 * omega));
}

/* Such a record, `all' s long, without its mean and under Hann's window, of the same energy, which
 * passes the gauges as groups do: their ends alone made an R of a tenth over 16 periods, under one
 * window for all gauges 0.05, so 0.01. */
static struct history tapered(const struct history *h, int n, const double *x, double all,
                              double speed)
{
    struct history to = {.n = h->n, .t = NEW(double, h->n)};
    memcpy(to.t, h->t, (size_t)h->n * sizeof *to.t);
    for (int i = 0; i < n; i++) {
        double mean = 0.0;
        to.v[i] = NEW(double, h->n);
        for (int j = 0; j < h->n; j++)
            mean += h->v[i][j] / h->n;
        for (int j = 0; j < h->n; j++) {
            const double at = (h->t[j] - h->t[0] - (x[i] - x[0]) / speed) / all;
            const double w = at > 0.0 && at < 1.0 ? sin(M_PI * at) : 0.0;
            to.v[i][j] = sqrt(8.0 / 3.0) * w * w * (h->v[i][j] - mean);
        }
    }
    return to;
}

/* Waves of one frequency that run onward and back. */
static struct reflection separate(const struct history *h, int n, const double *x, double omega,
                                  double k)
{
    double complex A[GAUGE_PROBES];
    for (int i = 0; i < n; i++)
        A[i] = reflection_amplitude(h->n, h->t, h->v[i], omega);
    if (n >= 4)
        k = reflection_fit_number(n, x, A, k, 0.05);
    return reflection_separate(n, x, A, k);
}

/* Adds the squares of their heights where the gauges stand well enough for them. */
static void add_squares(const struct reflection *r, double enough, double sums[2])
{
    if (r->condition < enough)
        return;
    sums[0] += creal(r->onward * conj(r->onward));
    sums[1] += creal(r->back * conj(r->back));
}

/* What neither of both explains, of the amplitude: a wave number a quarter off leaves a tenth at
 * three gauges, and a false R of 0.2; the right one some thousandths. */
static void warn_of_rest(const struct scene_gauges *g, const struct reflection *r, double k)
{
    const double most = fmax(cabs(r->onward), cabs(r->back));
    if (r->condition >= useless && r->rest > 0.05 * most)
        log_warn("gauges %s: waves %.3g m long leave %.2g of their amplitude unexplained there, so "
                 "R is not to be trusted: is the water below them of another depth (gauges.depth), "
                 "or have waves not settled (gauges.from)?",
                 g->name, 2.0 * M_PI / k, r->rest / most);
}

/* In regular waves one frequency, that of the period. In a sea every line j/all of the record from
 * 0.6 to 2 times the frequency of the peak, where nearly all the energy is; a line for which the
 * gauges stand badly (condition) is left out, in both sums alike. Amplitudes are roots of the sums
 * of squares, nan where no line is left. What runs onward is incident, but where clearly more comes
 * back: waves then run against waves.direction. Before a wall that returns all both are alike, and
 * R is 1 but for the error of the gauges, on either side of it. */
static void tell_reflection(const struct scene *s, const struct scene_gauges *g,
                            const struct history *h, int n, const int *probe, double all,
                            struct summary *summary)
{
    const double period = period_of(s, g);
    const bool sea = is_sea(s, g);
    double x[GAUGE_PROBES], sums[2] = {0.0, 0.0};
    places_of(s, n, probe, x);
    if (!sea) {
        const double k = number_of(s, g, period);
        const struct reflection r = separate(h, n, x, 2.0 * M_PI / period, k);
        add_squares(&r, useless, sums);
        warn_of_rest(g, &r, k);
    }
    const int last = sea ? (int)(2.0 * all / period) : 0;
    const bool tapers = leaks(s, g, all);
    struct history soft = tapers ? tapered(h, n, x, all, group_speed(s, g)) : (struct history){0};
    for (int j = (int)ceil(0.6 * all / period); j <= last; j++) { /* lines of the spectrum */
        const double omega = 2.0 * M_PI * j / all;
        const struct reflection r =
            separate(tapers ? &soft : h, n, x, omega, linear_number(s, g, omega));
        add_squares(&r, well_placed, sums);
    }
    free_history(&soft, tapers ? n : 0);
    const bool onward = 1.5 * sums[0] >= sums[1];
    const bool told = sums[0] + sums[1] > 0.0;
    const double incident = told ? sqrt(sums[onward ? 0 : 1]) : NAN,
                 back = told ? sqrt(sums[onward ? 1 : 0]) : NAN;
    summary_real(summary, key_text("reflection.%s.incident", g->name), incident);
    summary_real(summary, key_text("reflection.%s.reflected", g->name), back);
    summary_real(summary, key_text("reflection.%s.R", g->name), back / incident);
    if (!told)
        log_warn("gauges %s: from where they stand what runs onward and back is not told apart",
                 g->name);
    else
        log_say("waves      gauges %s: amplitude %.4g m %s, %.4g m back: R %.3g %% (period %.4g s, "
                "over %.3g periods%s)",
                g->name, incident, onward ? "onward" : "against waves.direction", back,
                100.0 * back / incident, period, all / period,
                tapers ? "; the ends of a record that holds no whole waves.repeat count as a few "
                         "per cent of R"
                       : "");
}

static bool makes_sea(const struct scene *s) { return s->has_waves && s->waves.kind == WAVE_SEA; }

/* Statistics of each gauge alone; the error of the significant height only where the case asks for
 * a sea of a certain height. */
static void tell_heights(const struct scene *s, const struct history *h, int n, const int *probe,
                         struct summary *summary)
{
    for (int i = 0; i < n; i++) {
        const char *name = s->probes[probe[i]].name;
        const struct wave_heights w = wave_heights_of(h->n, h->t, h->v[i]);
        static const char *const what[] = {"mean",  "significant", "largest", "period",
                                           "waves", "spectral",    "error"};
        const double v[] = {w.mean,
                            w.significant,
                            w.largest,
                            w.period,
                            w.n,
                            w.spectral,
                            fabs(w.spectral / s->waves.height - 1.0)};
        for (int k = 0; k < (makes_sea(s) ? 7 : 6); k++)
            summary_real(summary, key_text("height.%s.%s", name, what[k]), v[k]);
    }
}

/* Segments of about 12 periods that overlap by half: `segments' of them cover the record. More of
 * them smooth the estimate, longer ones resolve its peak. Frequencies up to 8 times that of the
 * period are written. */
static void write_spectra(const struct scene *s, const struct scene_gauges *g,
                          const struct history *h, int n, const int *probe, double period,
                          const char *dir)
{
    double f[SPECTRUM_BINS], S[GAUGE_PROBES][SPECTRUM_BINS];
    const double all = h->t[h->n - 1] - h->t[0];
    const int segments = (int)fmax(1.0, floor(2.0 * all / (12.0 * period)) - 1.0); /* of 12 T */
    for (int i = 0; i < n; i++)
        wave_spectrum(h->n, h->t, h->v[i], segments, f, S[i]);
    const char *path = key_text("%s/spectrum_%s.csv", dir, g->name);
    FILE *file = fopen(path, "w");
    if (!file) {
        log_warn("%s cannot be written", path);
        return;
    }
    fprintf(file, "# Welch's method, %d segment%s\nf [Hz]", segments, segments > 1 ? "s" : "");
    for (int i = 0; i < n; i++)
        fprintf(file, ",%s [m^2/Hz]", s->probes[probe[i]].name);
    const bool sea = makes_sea(s);
    const struct wave_spec of = sea ? scene_waves_spec(s) : (struct wave_spec){.kind = 0};
    fputs(sea ? ",target [m^2/Hz]\n" : "\n", file);
    for (int j = 0; j < SPECTRUM_BINS && f[j] * period < 8.0; j++) {
        fprintf(file, "%.9g", f[j]);
        for (int i = 0; i < n; i++)
            fprintf(file, ",%.9g", S[i][j]);
        if (sea)
            fprintf(file, ",%.9g", sea_spectrum(&of, f[j]));
        fputc('\n', file);
    }
    fclose(file);
}

/* Without `from', the second half of the run is evaluated, cut to whole periods at its end. 16 rows
 * a period are needed for the crests; fewer get a warning with the interval of rows that would
 * do. */
void wave_gauges_judge(const struct scene *s, const char *path, const char *dir,
                       struct summary *summary)
{
    struct table *t = s->ngauges > 0 ? table_read(path) : NULL;
    for (int k = 0; t && k < s->ngauges; k++) {
        const struct scene_gauges *g = s->gauges + k;
        char wrong[PARAM_TEXT_SIZE];
        int probe[GAUGE_PROBES];
        const int n = probes_of(s, g, probe, wrong);
        const double period = period_of(s, g), end = t->v[(size_t)(t->nrows - 1) * t->ncolumns],
                     from = g->from > 0.0 ? g->from : 0.5 * end, unit = unit_of(s, g, end - from),
                     whole = floor((end - from) / unit * alike) * unit;
        struct history h = read_history(s, t, n, probe, end - whole);
        if (h.n >= 0 && (h.n < 16 || whole < period))
            log_warn("gauges %s: %d rows over %.3g periods are too few to tell waves apart",
                     g->name, h.n, whole / period);
        else if (h.n >= 0) {
            tell_reflection(s, g, &h, n, probe, whole, summary);
            tell_heights(s, &h, n, probe, summary);
            if (h.n * period < 16.0 * whole)
                log_warn(
                    "gauges %s: %.1f rows a period miss crests: heights are low; output.series "
                    "= %d or less",
                    g->name, h.n * period / whole,
                    (int)fmax(1.0, s->output.series * h.n * period / whole / 20.0));
            write_spectra(s, g, &h, n, probe, period, dir);
        }
        free_history(&h, n);
    }
    FREE(t);
}

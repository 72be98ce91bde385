/* wave_picture.c - see wave_picture.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_picture.h"

#include "../files/files.h"
#include "../waves/waves.h"
#include "scene_waves.h"

enum { WIDTH = 900, LEFT = 70, GAP = 60, UPPER = 220, LOWER = 260, POINTS = 800, TICKS = 5 };

/* A diagram: place on the page (px), what it shows. */
struct diagram {
    FILE *f;
    double x, y, width, height;
    double lo[2], hi[2];
};

static double px(const struct diagram *d, double x)
{
    return d->x + d->width * (x - d->lo[0]) / (d->hi[0] - d->lo[0]);
}

static double py(const struct diagram *d, double y)
{
    return d->y + d->height * (d->hi[1] - y) / (d->hi[1] - d->lo[1]);
}

/* 1, 2 or 5 times a power of ten, about a TICKS-th of the range. */
static double tick_of(double range)
{
    const double raw = range / TICKS, power = pow(10.0, floor(log10(raw))), m = raw / power;
    return power * (m < 1.5 ? 1.0 : m < 3.5 ? 2.0 : m < 7.5 ? 5.0 : 10.0);
}

static void text(FILE *f, double x, double y, const char *anchor, const char *what)
{
    fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", x, y, anchor, what);
}

static void axes(const struct diagram *d, const char *across, const char *up)
{
    char label[32];
    fprintf(d->f,
            "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"#999\"/>\n",
            d->x, d->y, d->width, d->height);
    for (int a = 0; a < 2; a++) {
        const double tick = tick_of(d->hi[a] - d->lo[a]);
        for (double k = ceil(d->lo[a] / tick - 1e-9); k * tick <= d->hi[a] + 1e-9 * tick; k++) {
            snprintf(label, sizeof label, "%.6g", k * tick + 0.0);
            if (a == 0)
                text(d->f, px(d, k * tick), d->y + d->height + 16, "middle", label);
            else
                text(d->f, d->x - 6, py(d, k * tick) + 4, "end", label);
        }
    }
    text(d->f, d->x + d->width, d->y + d->height + 34, "end", across);
    text(d->f, d->x, d->y - 8, "start", up);
}

static void curve(const struct diagram *d, int n, const double (*at)[2], const char *colour)
{
    fputs("<path d=\"", d->f);
    for (int k = 0; k < n; k++)
        fprintf(d->f, "%c%.2f %.2f ", k ? 'L' : 'M', px(d, at[k][0]), py(d, at[k][1]));
    fprintf(d->f, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", colour);
}

static void level_line(const struct diagram *d, double y)
{
    fprintf(d->f, "<path d=\"M%.1f %.1f h%.1f\" stroke=\"#bbb\" stroke-dasharray=\"4 4\"/>\n", d->x,
            py(d, y), d->width);
}

/* --- what is drawn --- */

/* s: how long there are waves. */
static double until(const struct waves *w)
{
    if (w->of.kind != WAVE_FILE)
        return INFINITY;
    const struct swd_header is = swd_header_of(w->field->file);
    return (is.nsteps - 3) * is.dt + w->of.at[1];
}

/* Level of the waves over place (regular, two lengths) or time; the highest of it in crest: x, t,
 * level. */
static void sample_level(struct waves *w, double (*at)[2], double crest[3])
{
    const bool regular = w->of.kind == WAVE_REGULAR;
    const double x0 = w->of.at[0], t0 = w->of.kind == WAVE_FOCUSED ? w->of.at[1] : 0.0,
                 from = w->of.kind == WAVE_FOCUSED ? -4.0 : 0.0,
                 range = regular                      ? 2.0 * w->length
                         : w->of.kind != WAVE_FOCUSED ? fmin(25.0 * w->period, until(w))
                                                      : 8.0 * w->period;
    crest[2] = -INFINITY;
    for (int k = 0; k < POINTS; k++) {
        const double s = range * k / (POINTS - 1), x = x0 + (regular ? s - 0.5 * range : 0.0),
                     t = regular ? w->of.at[1] : t0 + from * w->period + s;
        waves_at(w, t);
        at[k][0] = regular ? x : t;
        at[k][1] = waves_eta(w, x, 0.0);
        if (at[k][1] > crest[2]) {
            crest[0] = x;
            crest[1] = t;
            crest[2] = at[k][1];
        }
    }
}

/* What their linear components alone are at the places or times of a level. */
static void sample_linear(const struct waves *w, int n, const double (*level)[2], double (*at)[2])
{
    const bool file = w->of.kind == WAVE_FILE;
    const double x = file ? 0.0 : w->of.at[0], t0 = file ? w->of.at[1] : 0.0;
    for (int k = 0; k < n; k++) {
        at[k][0] = level[k][0];
        at[k][1] = 0.0;
        for (int c = 0; c < w->ncomponents; c++) {
            const struct wave_component *q = w->components + c;
            at[k][1] += q->a * cos(q->k * q->way[0] * x - q->w * (level[k][0] - t0) + q->phase);
        }
    }
}

static void draw_level(FILE *f, struct waves *w, double crest[3])
{
    const bool more = w->second || w->field;
    struct diagram d = {
        .f = f, .x = LEFT, .y = 2 * GAP, .width = WIDTH - LEFT - 30, .height = UPPER};
    double at[POINTS][2], first[POINTS][2];
    sample_level(w, at, crest);
    d.lo[0] = at[0][0];
    d.hi[0] = at[POINTS - 1][0];
    for (int k = 0; k < POINTS; k++) {
        d.lo[1] = fmin(d.lo[1], at[k][1]);
        d.hi[1] = fmax(d.hi[1], at[k][1]);
    }
    for (int i = 0; i < 2; i++)
        *(i ? d.hi + 1 : d.lo + 1) *= 1.15;
    axes(&d, w->of.kind == WAVE_REGULAR ? "x [m]" : "t [s]",
         more ? "level [m]; thin: its linear part" : "level [m]");
    level_line(&d, 0.0);
    if (more) {
        sample_linear(w, POINTS, (const double(*)[2])at, first);
        curve(&d, POINTS, (const double(*)[2])first, "#bbbbbb");
    }
    curve(&d, POINTS, (const double(*)[2])at, "#2171b5");
}

/* Horizontal velocities below the highest crest, from the floor or half a length down. */
static void draw_velocity(FILE *f, double x, struct waves *w, const double crest[3])
{
    const double below = fmin(w->of.depth, 0.7 * w->length);
    struct diagram d = {.f = f,
                        .x = x,
                        .y = 3 * GAP + UPPER,
                        .width = 0.5 * WIDTH - LEFT - 30,
                        .height = LOWER,
                        .lo = {0.0, -below},
                        .hi = {0.0, crest[2]}};
    double at[POINTS][2];
    waves_at(w, crest[1]);
    for (int k = 0; k < POINTS; k++) {
        double u[3];
        at[k][1] = -below + (crest[2] + below) * k / (POINTS - 1);
        waves_velocity(w, crest[0], 0.0, at[k][1], u);
        at[k][0] = u[0];
        d.lo[0] = fmin(d.lo[0], u[0]);
        d.hi[0] = fmax(d.hi[0], 1.1 * u[0]);
    }
    axes(&d, "velocity along the waves below the highest crest [m/s]", "height [m]");
    level_line(&d, 0.0);
    curve(&d, POINTS, (const double(*)[2])at, "#238b45");
}

enum { BINS = 40 };

/* Per Hz between the components of a line, which are in order; n of them. */
static int density_of_line(const struct waves *w, bool sea, double (*at)[2])
{
    const struct wave_component *c = w->components;
    const int n = w->ncomponents;
    for (int i = 0; i < n; i++) {
        const int lo = i > 0 ? i - 1 : 0, hi = i + 1 < n ? i + 1 : i;
        const double df = 0.5 / M_PI * (n > 1 ? (c[hi].w - c[lo].w) / (hi - lo) : c[0].w);
        at[i][0] = 0.5 / M_PI * c[i].w;
        at[i][1] = (sea ? 0.5 * c[i].a * c[i].a : c[i].a) / df;
    }
    return n;
}

/* Of a plane's in bands. */
static int density_of_plane(const struct waves *w, bool sea, double (*at)[2])
{
    const struct wave_component *c = w->components;
    const double low = 0.5 / M_PI * c[0].w,
                 df = (0.5 / M_PI * c[w->ncomponents - 1].w - low) / BINS;
    for (int k = 0; k < BINS; k++) {
        at[k][0] = low + (k + 0.5) * df;
        at[k][1] = 0.0;
    }
    for (int i = 0; i < w->ncomponents; i++) {
        const int k = (int)fmin((0.5 / M_PI * c[i].w - low) / df, BINS - 1.0);
        at[k][1] += (sea ? 0.5 * c[i].a * c[i].a : c[i].a) / df;
    }
    return BINS;
}

/* Of a sea the variance over frequency, of a group the amplitudes of its components. */
static void draw_spectrum(FILE *f, const struct waves *w)
{
    const bool sea = w->of.kind != WAVE_FOCUSED, plane = w->field && w->of.spread > 0.0;
    double(*at)[2] = (double(*)[2])NEW(double, w->ncomponents * 2 + BINS * 2);
    struct diagram d = {
        .f = f, .x = LEFT, .y = 3 * GAP + UPPER, .width = 0.5 * WIDTH - LEFT - 30, .height = LOWER};
    const int n = plane ? density_of_plane(w, sea, at) : density_of_line(w, sea, at);
    d.hi[0] = at[n - 1][0];
    for (int k = 0; k < n; k++)
        d.hi[1] = fmax(d.hi[1], 1.1 * at[k][1]);
    axes(&d, "frequency [Hz]",
         sea ? "spectrum [m\xc2\xb2/Hz]" : "amplitudes of the components [m/Hz]");
    curve(&d, n, (const double(*)[2])at, "#d94801");
    mem_free(at);
}

static void headline(FILE *f, const struct waves *w)
{
    static const char *const names[] = {"Regular waves", "Sea", "Focused group", "File of waves"};
    char line[240];
    snprintf(line, sizeof line, "%s: height %g m, %.4g m long, period %.4g s, celerity %.4g m/s",
             names[w->of.kind], w->of.height, w->length, w->period, w->celerity);
    text(f, LEFT, 30, "start", line);
    snprintf(line, sizeof line,
             "over %.4g m (kh %.3g); crest %.3g m, trough %.3g m, %.0f %% of the highest",
             w->of.depth, 2.0 * M_PI * w->of.depth / w->length, w->crest, w->trough,
             100.0 * w->of.height / w->limit);
    text(f, LEFT, 50, "start", line);
}

/* Means of a sea by the moments of its spectrum. */
static void say_moments(const struct waves *w)
{
    double m[3] = {0.0, 0.0, 0.0};
    for (int c = 0; c < w->ncomponents; c++)
        for (int k = 0; k < 3; k++)
            m[k] += 0.5 * pow(w->components[c].a, 2.0) * pow(0.5 / M_PI * w->components[c].w, k);
    log_say("spectrum: 4 sqrt(m0) %.4g m, mean period m0/m1 %.4g s, of crossings sqrt(m0/m2) "
            "%.4g s; it repeats itself after %g s",
            4.0 * sqrt(m[0]), m[0] / m[1], sqrt(m[0] / m[2]), w->of.repeat);
}

/* Without a zone, fully grown, at one place. */
static struct waves *alone(const struct scene *s)
{
    struct wave_spec of = scene_waves_spec(s);
    of.start = 0.0;
    of.window[0][0] = of.window[0][1] = of.at[0];
    of.window[1][0] = of.window[1][1] = 0.0;
    return waves_create(&of);
}

void wave_picture(const char *path, const struct scene *s)
{
    double crest[3];
    FILE *f = fopen(path, "w");
    if (!f)
        disk_failed(path);
    struct waves *w = alone(s);
    fprintf(f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
            "font-family=\"sans-serif\" font-size=\"12\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
            WIDTH, 4 * GAP + UPPER + LOWER);
    headline(f, w);
    draw_level(f, w, crest);
    if (w->of.kind != WAVE_REGULAR)
        draw_spectrum(f, w);
    if (w->of.kind == WAVE_SEA)
        say_moments(w);
    draw_velocity(f, w->of.kind == WAVE_REGULAR ? LEFT : LEFT + WIDTH / 2, w, crest);
    fputs("</svg>\n", f);
    if (ferror(f) || fclose(f))
        disk_failed(path);
    log_say("picture: %s", path);
    FREE(w);
}

/* waves.c - see waves.h. SPDX-License-Identifier: BSD-3-Clause */
#include "waves.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>

#include "../base/mem.h"
#include "sea.h"
#include "zone_gain.h"

enum { COLUMNS = 192 }; /* a length of a regular wave */

static const double steepest = 0.9; /* of the limit: steady.h */

double waves_limit(double depth, double length)
{
    const double q = length / depth;
    return depth * (q * (0.141063 + q * (0.0095721 + q * 0.0077829))) /
           (1.0 + q * (0.0788340 + q * (0.0317567 + q * 0.0093407)));
}

double waves_number(double w, double g, double h)
{
    double k = w * w * h / g > 1.0 ? w * w / g : w / sqrt(g * h);
    for (int n = 0; n < 12; n++) {
        const double t = tanh(fmin(k * h, 300.0)), r = g * k * t - w * w;
        k -= r / (g * t + g * k * h * (1.0 - t * t));
    }
    return k;
}

/* Eulerian current with which a steady wave has no net transport, c = flux/depth: the flux in its
 * frame is its mean speed times the strip's height. */
static double without_transport(const struct steady *w, double depth)
{
    return w->frame * sqrt(w->g / w->k) * w->y0 / (w->k * depth);
}

/* The wave of a length; its celerity c over the ground, 0: there is none. */
static double try_length(const struct wave_spec *of, double length, struct steady *w)
{
    if (!steady_create(w, false, of->depth, length, of->height, of->at[0], of->g, of->rho))
        return 0.0;
    return w->c + (of->closed ? without_transport(w, of->depth) : 0.0);
}

/* A given period: the length by secants, from that of linear theory. */
static bool find_steady(const struct wave_spec *of, struct steady *w)
{
    if (of->length > 0.0)
        return try_length(of, of->length, w) > 0.0;
    double length = 2.0 * M_PI / waves_number(2.0 * M_PI / of->period, of->g, of->depth);
    double before = 1.02 * length, off = NAN;
    for (int it = 0; it < 30; it++) {
        const double c = try_length(of, length, w), now = c * of->period - length;
        if (!(c > 0.0))
            return false;
        if (fabs(now) < 1e-12 * length)
            return true;
        const double slope = isnan(off) ? -0.5 : (now - off) / (length - before);
        before = length;
        off = now;
        length -= now / slope;
        if (!(length > 0.0))
            return false;
    }
    return true;
}

static double peak_length(const struct wave_spec *of)
{
    return of->length > 0.0 ? of->length
                            : 2.0 * M_PI / waves_number(2.0 * M_PI / of->period, of->g, of->depth);
}

double waves_period(const struct wave_spec *of)
{
    const double k = 2.0 * M_PI / peak_length(of);
    return of->period > 0.0 ? of->period
                            : 2.0 * M_PI / sqrt(of->g * k * tanh(fmin(k * of->depth, 300.0)));
}

bool waves_refuse(const struct wave_spec *of, const char **key, char *text, size_t size)
{
    struct steady w;
    *key = "waves.height";
    if (!(of->height > 0.0)) {
        snprintf(text, size, "the height from trough to crest must be given, m");
        return true;
    }
    if ((of->length > 0.0) == (of->period > 0.0)) {
        *key = of->length > 0.0 ? "waves.period" : "waves.length";
        snprintf(text, size, "give one of length (m) and period (s)");
        return true;
    }
    const double length = peak_length(of), limit = waves_limit(of->depth, length);
    /* a sea's highest waves are about twice its significant height */
    const double share = of->kind == WAVE_SEA ? 0.5 : steepest;
    if (of->height > share * limit) {
        snprintf(text, size,
                 "%g m: at a length of %.4g m over %.4g m of water the highest wave has %.3g m; %s "
                 "%.3g m",
                 of->height, length, of->depth, limit,
                 of->kind == WAVE_SEA ? "a sea of steeper ones breaks: at most"
                                      : "waves of up to 0.9 of it can be made: at most",
                 share * limit);
        return true;
    }
    if (of->kind != WAVE_REGULAR && of->repeat < 5.0 * waves_period(of)) {
        *key = "waves.repeat";
        snprintf(text, size, "%g s: less than 5 periods of %.4g s hold no spectrum", of->repeat,
                 waves_period(of));
        return true;
    }
    if (of->kind == WAVE_REGULAR && !find_steady(of, &w)) {
        snprintf(text, size,
                 "%g m: no steady wave was found at a length of %.4g m over %.4g m of water: it is "
                 "too long for its height (a solitary wave is initial.field = \"solitary\")",
                 of->height, length, of->depth);
        return true;
    }
    return false;
}

/* Deep water needs no nodes down to its bottom. */
static double reach_of(double depth, double length) { return fmin(depth, 1.2 * length); }

/* Factor of the velocities of one frequency. */
static double complex gain_at(const struct wave_spec *of, double omega, double k)
{
    if (!(of->zone > 0.0))
        return 1.0;
    const struct zone_response is =
        zone_response(omega, k, fabs(of->cosine), of->g, of->depth, of->zone, of->rate);
    return of->cosine > 0.0 ? is.make : is.pass;
}

static void make_regular(struct waves *w)
{
    const struct wave_spec *of = &w->of;
    find_steady(of, &w->steady);
    const struct steady *s = &w->steady;
    w->current = of->closed ? without_transport(s, of->depth) : 0.0;
    w->length = w->shortest = w->longest = 2.0 * M_PI / s->k;
    w->celerity = s->c + w->current;
    w->period = w->length / w->celerity;
    w->crest = s->crest;
    w->trough = s->trough;
    w->table = wave_table_create(COLUMNS, 0.0, w->length / COLUMNS, reach_of(of->depth, w->length));
    w->table.periodic = true;
    w->table.decay = w->table.reach < of->depth ? s->k : 0.0;
    for (int i = 0; i < COLUMNS; i++) {
        const double x = s->x + i * w->table.gap;
        w->table.eta[i] = steady_eta(s, x, 0.0);
        for (int j = 0; j < WAVE_NODES; j++)
            steady_point(s, x, wave_table_height(&w->table, i, j), 0.0,
                         w->table.u + 2 * ((size_t)i * WAVE_NODES + (size_t)j), NULL);
    }
    w->speed = fmax(fabs(w->table.u[0] + w->current), fabs(w->current));
    const double complex gain =
        gain_at(of, sqrt(of->g * s->k * tanh(fmin(s->k * of->depth, 300.0))), s->k);
    w->gain = cabs(gain);
    w->ahead = carg(gain) / s->k;
}

enum { GAINS = 16 };

/* Components make up for their zone: gains of some frequencies, linear between them. */
static void apply_gains(struct waves *w)
{
    const double low = w->components[0].w,
                 gap = (w->components[w->ncomponents - 1].w - low) / (GAINS - 1);
    double complex gain[GAINS];
    for (int i = 0; i < GAINS; i++)
        gain[i] = gain_at(&w->of, low + i * gap, waves_number(low + i * gap, w->of.g, w->of.depth));
    for (int c = 0; c < w->ncomponents; c++) {
        struct wave_component *q = w->components + c;
        const double at = (q->w - low) / gap;
        const int i = (int)fmin(fmax(floor(at), 0.0), GAINS - 2);
        const double complex G = gain[i] + (at - i) * (gain[i + 1] - gain[i]);
        q->a *= cabs(G);
        q->phase -= carg(G);
    }
}

static void make_sum(struct waves *w)
{
    const struct wave_spec *of = &w->of;
    w->length = peak_length(of);
    const double k = 2.0 * M_PI / w->length;
    w->period = of->period > 0.0 ? of->period
                                 : 2.0 * M_PI / sqrt(of->g * k * tanh(fmin(k * of->depth, 300.0)));
    w->celerity = w->length / w->period;
    w->components = sea_components(of, w->period, &w->ncomponents);
    if (of->zone > 0.0)
        apply_gains(w);
    const struct wave_component *low = w->components, *high = low + w->ncomponents - 1;
    w->longest = 2.0 * M_PI / low->k;
    w->shortest = 2.0 * M_PI / high->k;
    /* of 1000 waves the highest is 1.86 times the significant height (Rayleigh) */
    w->crest = of->kind == WAVE_SEA ? 0.93 * of->height : 0.5 * of->height;
    w->trough = -w->crest;
    const double omega = 2.0 * M_PI / w->period;
    w->speed = 1.3 * w->crest * omega / tanh(fmin(k * of->depth, 300.0));
    w->dt = 2.0 * M_PI / high->w / 20.0;
    const double gap = w->shortest / 8.0;
    const int n = (int)ceil((of->window[1] - of->window[0]) / gap) + 5;
    for (int f = 0; f <= WAVE_FRAMES; f++) {
        struct wave_table *t = f < WAVE_FRAMES ? w->frames + f : &w->table;
        *t = wave_table_create(n, of->window[0] - 2.0 * gap, gap, reach_of(of->depth, w->longest));
        t->decay = t->reach < of->depth ? low->k : 0.0;
        t->flat = true;
        if (f < WAVE_FRAMES)
            w->frame[f] = -1000000 - f;
    }
    w->profile = sea_profiles(w);
}

struct waves *waves_create(const struct wave_spec *of)
{
    struct waves *w = NEW(struct waves, 1);
    *w = (struct waves){.of = *of};
    if (of->kind == WAVE_REGULAR)
        make_regular(w);
    else
        make_sum(w);
    w->limit = waves_limit(of->depth, w->length);
    w->now = NAN;
    return w;
}

void waves_free(struct waves **w)
{
    if (!*w)
        return;
    wave_table_free(&(*w)->table);
    for (int f = 0; f < WAVE_FRAMES; f++)
        wave_table_free(&(*w)->frames[f]);
    mem_free((*w)->components);
    mem_free((*w)->profile);
    mem_free(*w);
    *w = NULL;
}

/* Cubic through the frames dt apart of which t lies between the middle two; each frame has its own
 * slot, so that it is computed once. */
static void blend_frames(struct waves *w, double t)
{
    const long m = (long)floor(t / w->dt);
    const double s = t / w->dt - (double)m;
    const double of[WAVE_FRAMES] = {
        -s * (s - 1.0) * (s - 2.0) / 6.0, (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
        -(s + 1.0) * s * (s - 2.0) / 2.0, (s + 1.0) * s * (s - 1.0) / 6.0};
    double weight[WAVE_FRAMES];
    for (int k = 0; k < WAVE_FRAMES; k++) {
        const long f = m + k - 1;
        const int slot = (int)(((f % WAVE_FRAMES) + WAVE_FRAMES) % WAVE_FRAMES);
        if (w->frame[slot] != f)
            sea_frame(w, (double)f * w->dt, w->frames + slot);
        w->frame[slot] = f;
        weight[slot] = of[k];
    }
    wave_table_blend(&w->table, WAVE_FRAMES, w->frames, weight);
}

void waves_at(struct waves *w, double t)
{
    if (t == w->now)
        return;
    w->now = t;
    if (w->of.kind != WAVE_REGULAR)
        blend_frames(w, t);
}

/* Share of the waves that are there: none before t = 0, all after `start' periods. */
static double grown(const struct waves *w)
{
    const double T = w->of.start * w->period;
    if (!(T > 0.0) || w->now >= T)
        return 1.0;
    return w->now <= 0.0 ? 0.0 : 0.5 * (1.0 - cos(M_PI * w->now / T));
}

/* x in the frame of a table that travels. */
static double place(const struct waves *w, double x)
{
    return w->of.kind == WAVE_REGULAR
               ? x - w->of.at[0] - w->celerity * (w->now - w->of.at[1]) - w->ahead
               : x;
}

double waves_eta(const struct waves *w, double x)
{
    return grown(w) * wave_table_eta(&w->table, place(w, x));
}

void waves_velocity(const struct waves *w, double x, double z, double u[2])
{
    const double r = grown(w) * (w->of.kind == WAVE_REGULAR ? w->gain : 1.0);
    wave_table_velocity(&w->table, place(w, x), z, u);
    u[0] = r * (u[0] + w->current);
    u[1] *= r;
}

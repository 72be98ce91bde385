/* sea_frames.c - tables of a sea or a group over time: see sea.h. A blend of four frames; each
 * component makes up for its zone. SPDX-License-Identifier: BSD-3-Clause */
#include "sea.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "../base/mem.h"
#include "second_order.h"
#include "zone_gain.h"

enum { GAINS = 16 };

/* Deep water needs no nodes down to its bottom. */
double sea_reach(double depth, double length) { return fmin(depth, 1.2 * length); }

double complex sea_gain(const struct wave_spec *of, double omega, double k)
{
    if (!(of->zone > 0.0))
        return 1.0;
    const struct zone_response is =
        zone_response(omega, k, fabs(of->cosine), of->g, of->depth, of->zone, of->rate);
    return of->cosine > 0.0 ? is.make : is.pass;
}

/* Components make up for their zone: gains of some frequencies, linear between them. */
static void apply_gains(struct waves *w)
{
    const double low = w->components[0].w,
                 gap = (w->components[w->ncomponents - 1].w - low) / (GAINS - 1);
    double complex gain[GAINS];
    for (int i = 0; i < GAINS; i++)
        gain[i] =
            sea_gain(&w->of, low + i * gap, waves_number(low + i * gap, w->of.g, w->of.depth));
    for (int c = 0; c < w->ncomponents; c++) {
        struct wave_component *q = w->components + c;
        const double at = (q->w - low) / gap;
        const int i = (int)fmin(fmax(floor(at), 0.0), GAINS - 2);
        const double complex G = gain[i] + (at - i) * (gain[i + 1] - gain[i]);
        q->a *= cabs(G);
        q->phase -= carg(G);
    }
}

static double *profiles_of(const struct waves *w)
{
    double *profile = NEW(double, (size_t)w->ncomponents *WAVE_NODES * 2);
    for (int c = 0; c < w->ncomponents; c++)
        for (int j = 0; j < WAVE_NODES; j++) {
            const double k = w->components[c].k, depth = w->of.depth,
                         z = wave_table_height(&w->table, 0, j), all = 1.0 - exp(-2.0 * k * depth);
            const double up = exp(k * z), down = exp(-k * (z + 2.0 * depth));
            double *q = profile + ((size_t)c * WAVE_NODES + (size_t)j) * 2;
            q[0] = (up + down) / all;
            q[1] = (up - down) / all;
        }
    return profile;
}

/* d/dz of the linear velocities at the still level, where profile holds cosh and sinh over sinh. */
static void add_slope(const struct wave_component *q, const double *profile, double co, double si,
                      double *slope)
{
    slope[0] += q->k * q->w * co * profile[1];
    slope[1] += q->k * q->w * si * profile[0];
}

static void make_frame(const struct waves *w, double t, struct wave_table *to)
{
    if (to->slope)
        memset(to->slope, 0, (size_t)to->n * 2 * sizeof *to->slope);
    memset(to->eta, 0, (size_t)to->n * sizeof *to->eta);
    memset(to->u, 0, (size_t)to->n * WAVE_NODES * 2 * sizeof *to->u);
    for (int i = 0; i < to->n; i++) {
        const double x = to->first + i * to->gap;
        double *u = to->u + (size_t)i * WAVE_NODES * 2;
        for (int c = 0; c < w->ncomponents; c++) {
            const struct wave_component *q = w->components + c;
            const double *profile = w->profile + (size_t)c * WAVE_NODES * 2;
            const double turn = q->k * x - q->w * t + q->phase, co = q->a * cos(turn),
                         si = q->a * sin(turn);
            to->eta[i] += co;
            for (int j = 0; j < WAVE_NODES; j++) {
                u[2 * j] += q->w * co * profile[2 * j];
                u[2 * j + 1] += q->w * si * profile[2 * j + 1];
            }
            if (to->slope)
                add_slope(q, profile, co, si, to->slope + 2 * i);
        }
        if (w->second)
            second_order_add(w->second, x, t, to->eta + i, u);
    }
}

/* m/s: takes out what the sea carries along. */
static double without_transport(const struct waves *w)
{
    double flux = 0.0;
    for (int c = 0; c < w->ncomponents; c++) {
        const struct wave_component *q = w->components + c;
        flux += 0.5 * w->of.g * q->a * q->a * q->k / q->w;
    }
    return -flux / w->of.depth;
}

static void make_tables(struct waves *w)
{
    const struct wave_spec *of = &w->of;
    const struct wave_component *low = w->components, *high = low + w->ncomponents - 1;
    w->longest = 2.0 * M_PI / low->k;
    w->shortest = 2.0 * M_PI / high->k;
    w->dt = 2.0 * M_PI / high->w / 20.0;
    const double gap = w->shortest / 8.0;
    const int n = (int)ceil((of->window[1] - of->window[0]) / gap) + 5;
    for (int f = 0; f <= WAVE_FRAMES; f++) {
        struct wave_table *t = f < WAVE_FRAMES ? w->frames + f : &w->table;
        *t = wave_table_create(n, of->window[0] - 2.0 * gap, gap, sea_reach(of->depth, w->longest),
                               of->order > 1);
        t->decay = t->reach < of->depth ? low->k : 0.0;
        t->flat = true;
        if (f < WAVE_FRAMES)
            w->frame[f] = -1000000 - f;
    }
    w->profile = profiles_of(w);
}

/* A group keeps the mean that it has below it: there is still water before and after it. */
static void make_second(struct waves *w)
{
    double nodes[WAVE_NODES];
    for (int j = 0; j < WAVE_NODES; j++)
        nodes[j] = wave_table_height(&w->table, 0, j);
    w->second = second_order_create(w->ncomponents, w->components, w->of.g, w->of.depth, nodes,
                                    w->of.kind == WAVE_FOCUSED);
    if (w->of.kind == WAVE_SEA && w->of.closed)
        w->current = without_transport(w);
}

/* Level of a group at its focus after t s. */
static double level_at_focus(struct waves *w, double t)
{
    double eta = 0.0, u[WAVE_NODES * 2] = {0.0};
    for (int c = 0; c < w->ncomponents; c++)
        eta += w->components[c].a * cos(w->components[c].w * t);
    if (w->second)
        second_order_add(w->second, w->of.at[0], w->of.at[1] + t, &eta, u);
    return eta;
}

/* Of 1000 waves the highest is 1.86 times the significant height (Rayleigh). */
static void expect_extremes(struct waves *w)
{
    enum { TIMES = 60 };
    const double k = 2.0 * M_PI / w->length, h = w->of.depth,
                 a = w->of.kind == WAVE_SEA ? 0.93 * w->of.height : 0.5 * w->of.height,
                 second = w->second ? bound_wave_stokes(a, k, h) : 0.0;
    w->crest = a * (1.0 + second);
    w->trough = -a * (1.0 - second);
    if (w->of.kind == WAVE_FOCUSED) {
        w->crest = w->trough = 0.0;
        for (int i = -TIMES; i <= TIMES; i++) {
            const double eta = level_at_focus(w, w->period * i / TIMES);
            w->crest = fmax(w->crest, eta);
            w->trough = fmin(w->trough, eta);
        }
    }
    w->speed = 1.3 * w->crest * 2.0 * M_PI / w->period / tanh(fmin(k * h, 300.0));
}

void sea_make(struct waves *w)
{
    const struct wave_spec *of = &w->of;
    w->length = waves_length(of);
    w->period = waves_period(of);
    w->celerity = w->length / w->period;
    w->components = sea_components(of, w->period, &w->ncomponents);
    make_tables(w);
    if (of->order > 1)
        make_second(w);
    expect_extremes(w);
    if (of->zone > 0.0)
        apply_gains(w);
}

double sea_seconds(const struct waves *w)
{
    const double column = 150.0 * WAVE_NODES + 3.0 * w->ncomponents * WAVE_NODES +
                          (w->second ? second_order_products(w->second) : 0.0);
    return 1e-9 * column * w->table.n * w->period / w->dt;
}

/* Cubic through the frames dt apart of which t lies between the middle two; each frame has its own
 * slot, so that it is computed once. */
void sea_at(struct waves *w, double t)
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
            make_frame(w, (double)f * w->dt, w->frames + slot);
        w->frame[slot] = f;
        weight[slot] = of[k];
    }
    wave_table_blend(&w->table, WAVE_FRAMES, w->frames, weight);
}

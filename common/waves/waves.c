/* waves.c - see waves.h. One face for all kinds: regular waves have a table of one length that
 * travels with them (make_regular), the others a table of the present time (sea_frames.c). waves_at
 * sets the time, waves_eta and waves_velocity sample.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "imposed_waves.h"

#include <complex.h>

#include "../base/base.h"
#include "sea.h"
#include "sea_gains.h"
#include "second_order.h"
#include "wave_field.h"

enum { COLUMNS = 192 }; /* a length of a regular wave */

static const double steepest = 0.9; /* of the limit: steady.h */
/* Second order over first above which troughs have a crest of their own, which no wave has. */
static const double bound = 0.25;
static const double hos_steepest = 0.3; /* hos.h */

/* Fenton's fit (1990) to the highest steady waves of Williams (1981), in the length over depth
 * q. */
double waves_limit(double depth, double length)
{
    const double q = length / depth;
    return depth * (q * (0.141063 + q * (0.0095721 + q * 0.0077829))) /
           (1.0 + q * (0.0788340 + q * (0.0317567 + q * 0.0093407)));
}

double waves_frequency(double k, double g, double depth)
{
    return sqrt(g * k * tanh(fmin(k * depth, 300.0)));
}

double waves_amplitude(const struct wave_spec *of)
{
    return of->kind == WAVE_SEA ? 0.93 * of->height : 0.5 * of->height;
}

/* Newton's method from deep or shallow water, whichever is nearer; 12 steps are more than enough
 * for 16 digits. */
double waves_number(double w, double g, double h)
{
    double k = w * w * h / g > 1.0 ? w * w / g : w / sqrt(g * h);
    for (int n = 0; n < 12; n++) {
        const double t = tanh(fmin(k * h, 300.0)), r = g * k * t - w * w;
        k -= r / (g * t + g * k * h * (1.0 - t * t));
    }
    return k;
}

double waves_group_velocity(double k, double g, double h)
{
    const double kh = fmin(k * h, 300.0);
    return 0.5 * waves_frequency(k, g, h) / k * (1.0 + 2.0 * kh / sinh(2.0 * kh));
}

/* The frequency at rest over k is concave, so Newton's steps from a smaller k never go too far. NAN
 * where no wave can have that frequency on the current, or its energy would not come forward. */
double waves_number_on(double w, double U, double g, double h)
{
    if (U == 0.0)
        return waves_number(w, g, h);
    const double longest = sqrt(g * h) + U;
    if (!(longest > 0.0))
        return NAN;
    double k = w / longest;
    for (int n = 0; n < 200; n++) {
        const double slope = waves_group_velocity(k, g, h) + U,
                     step = (w - k * U - waves_frequency(k, g, h)) / slope;
        if (!(slope > 0.0))
            return NAN;
        k += step;
        if (fabs(step) < 1e-14 * k)
            break;
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
    return w->c + of->current + (of->closed ? without_transport(w, of->depth) : 0.0);
}

/* A given period: the length by secants, from that of linear theory. Each try is a whole steady
 * wave. off = c T - L falls by about half of a change of L in deep water, the slope of the first
 * step. */
static bool find_steady(const struct wave_spec *of, struct steady *w)
{
    if (of->length > 0.0)
        return try_length(of, of->length, w) > 0.0;
    double length = waves_length(of);
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

double waves_length(const struct wave_spec *of)
{
    return of->length > 0.0
               ? of->length
               : 2.0 * M_PI /
                     waves_number_on(2.0 * M_PI / of->period, of->current, of->g, of->depth);
}

double waves_period(const struct wave_spec *of)
{
    const double k = 2.0 * M_PI / waves_length(of);
    return of->period > 0.0 ? of->period
                            : 2.0 * M_PI / (waves_frequency(k, of->g, of->depth) + k * of->current);
}

/* Whether the energy of waves of that length, NAN: none of that period, comes forward. */
static bool blocked(const struct wave_spec *of, double length, char *text, size_t size)
{
    const double U = of->current,
                 along = waves_group_velocity(2.0 * M_PI / length, of->g, of->depth);
    if (along + U > 0.0)
        return false;
    if (isnan(length))
        snprintf(text, size,
                 "%g m/s: no waves of %g s come forward against it: give a slower current, or a "
                 "longer period",
                 U, of->period);
    else
        snprintf(text, size,
                 "%g m/s: the energy of waves of %.4g m moves at %.3g m/s over the water, so the "
                 "current holds them: give a slower current, or longer waves",
                 U, length, along);
    return true;
}

/* Of a sea: what comes forward up to 1.5 times the peak's frequency is nearly all of it. */
static bool sea_blocked(const struct wave_spec *of, char *text, size_t size)
{
    struct wave_spec high = *of;
    high.length = 0.0;
    high.period = waves_period(of) / 1.5;
    return of->kind != WAVE_REGULAR && blocked(&high, waves_length(&high), text, size);
}

/* From what is given at all to what the theory holds for; the first that is wrong is told. Before
 * the run, on all ranks. */
bool waves_refuse(const struct wave_spec *of, const char **key, char *text, size_t size)
{
    struct steady w;
    if (of->kind == WAVE_FILE)
        return false; /* wave_file.h has looked at it */
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
    const double length = waves_length(of), limit = waves_limit(of->depth, length);
    *key = "waves.current";
    if (of->current != 0.0 && (blocked(of, length, text, size) || sea_blocked(of, text, size)))
        return true;
    *key = "waves.height";
    /* a sea's highest waves are about twice its significant height */
    const double share = of->kind == WAVE_SEA ? 0.5 : steepest;
    if (of->height > share * limit) {
        snprintf(text, size,
                 "%g m: at a length of %.4g m over %.4g m of water the highest wave has %.3g m; %s "
                 "%.3g m",
                 of->height, length, of->depth, limit,
                 of->kind == WAVE_SEA ? "a sea of steeper ones breaks: at most"
                                      : "waves of up to 0.9 of it can be made: at most",
                 digits_below(share * limit, 3));
        return true;
    }
    const double second = bound_wave_stokes(0.5 * of->height, 2.0 * M_PI / length, of->depth);
    if (of->kind != WAVE_REGULAR && of->order > 1 && second > bound) {
        snprintf(text, size,
                 "%g m: at a length of %.4g m over %.4g m of water the second order is %.2g of the "
                 "first, more than %g: at most %.3g m, or waves.order = 1",
                 of->height, length, of->depth, second, bound,
                 digits_below(of->height * bound / second, 3));
        return true;
    }
    const double steep = waves_amplitude(of);
    if (of->evolve == EVOLVE_HOS && 2.0 * M_PI / length * steep > hos_steepest) {
        snprintf(
            text, size,
            "%g m: at a length of %.4g m the highest waves have a steepness of %.2g, and orders "
            "in it (waves.evolve = \"hos\") reach %g: at most %.3g m, or waves.evolve = "
            "\"full\"",
            of->height, length, 2.0 * M_PI / length * steep, hos_steepest,
            digits_below(of->height * hos_steepest * length / (2.0 * M_PI * steep), 3));
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

/* ahead: the phase by which the zone's gain turns the wave, as a distance. */
static void make_regular(struct waves *w)
{
    const struct wave_spec *of = &w->of;
    find_steady(of, &w->steady);
    const struct steady *s = &w->steady;
    const double back = without_transport(s, of->depth);
    w->current = of->closed ? back : 0.0;
    w->transport = -back * of->depth;
    w->length = w->shortest = w->longest = 2.0 * M_PI / s->k;
    w->celerity = s->c + w->current + of->current;
    w->period = w->length / w->celerity;
    w->crest = s->crest;
    w->trough = s->trough;
    w->table = wave_table_create(w, COLUMNS, 1, w->length / COLUMNS,
                                 sea_reach(of->depth, w->length), false);
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
        sea_gain(of, waves_frequency(s->k, of->g, of->depth), s->k, of->normal[0]);
    w->gain = cabs(gain);
    w->ahead = carg(gain) / s->k;
}

/* now = NAN: no table is filled yet. */
struct waves *waves_create(const struct wave_spec *of)
{
    struct waves *w = NEW(struct waves, 1);
    *w = (struct waves){.of = *of};
    if (of->kind == WAVE_REGULAR)
        make_regular(w);
    else
        sea_make(w);
    w->speed += fabs(of->current);
    w->limit = waves_limit(of->depth, w->length);
    w->now = NAN;
    return w;
}

/* Both have the same modes; each has its own filter and tables. */
void waves_share(struct waves *w, const struct waves *owner)
{
    if (!w->field || w->shares)
        return;
    DROP(w->field);
    w->field = owner->field;
    w->shares = true;
}

/* Share of the waves that are there: none before t = 0, all after `start' periods. */
static double grown_at(const struct waves *w, double t)
{
    const double T = w->of.start * w->period;
    if (!(T > 0.0) || t >= T)
        return 1.0;
    return t <= 0.0 ? 0.0 : 0.5 * (1.0 - cos(M_PI * t / T));
}

void waves_at(struct waves *w, double t)
{
    if (t == w->now)
        return;
    w->now = t;
    w->grown = grown_at(w, t);
    if (w->of.kind != WAVE_REGULAR)
        sea_at(w, w->of.kind == WAVE_FILE ? t - w->of.at[1] : t);
}

/* x in the frame of a table that travels. */
static double place(const struct waves *w, double x)
{
    return w->of.kind == WAVE_REGULAR
               ? x - w->of.at[0] - w->celerity * (w->now - w->of.at[1]) - w->ahead
           : w->of.kind == WAVE_FILE ? x - w->of.at[0]
                                     : x;
}

double waves_eta(const struct waves *w, double x, double y)
{
    return w->grown * wave_table_eta(&w->table, place(w, x), y);
}

/* u of the table to that of the water: the current runs at all times, waves grow. */
static void scale(const struct waves *w, double u[3])
{
    const double r = w->grown * (w->of.kind == WAVE_REGULAR ? w->gain : 1.0);
    u[0] = r * (u[0] + w->current) + w->of.current;
    u[1] *= r;
    u[2] *= r;
}

void waves_velocity(const struct waves *w, double x, double y, double z, double u[3])
{
    wave_table_velocity(&w->table, place(w, x), y, z, u);
    scale(w, u);
}

void waves_velocities(const struct waves *w, double x, double y, int n, const double *z,
                      double (*u)[3])
{
    struct wave_column c;
    wave_table_column(&w->table, place(w, x), y, &c);
    for (int i = 0; i < n; i++) {
        wave_column_velocity(&c, z[i], u[i]);
        scale(w, u[i]);
    }
}

/* By Simpson's rule over heights. */
double waves_flux(const struct waves *w, double x)
{
    enum { PARTS = 32 };
    const double eta = waves_eta(w, x, 0.0), dz = (w->of.depth + eta) / PARTS;
    double sum = 0.0, u[3];
    for (int j = 0; j <= PARTS; j++) {
        waves_velocity(w, x, 0.0, j * dz - w->of.depth, u);
        sum += u[0] * (j == 0 || j == PARTS ? 1.0 : j % 2 ? 4.0 : 2.0);
    }
    return sum * dz / 3.0;
}

/* sea_frames.c - tables of a sea or a group over time: see sea.h. A blend of four frames; each
 * component makes up for its zone. A frame is a table of levels and velocities in the columns of
 * the window at the time frame dt; what a place and time ask for then comes from the table between
 * them (wave_table.c), which costs the same for one component or for hundreds. sea_make runs once
 * at the start, sea_at before each stage of a time step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sea.h"

#include <complex.h>

#include "../base/base.h"
#include "sea_gains.h"
#include "second_order.h"
#include "wave_field.h"
#include "wave_pressure.h"

/* Deep water needs no nodes down to its bottom. */
double sea_reach(double depth, double length) { return fmin(depth, 1.2 * length); }

/* --- frames --- */

/* To the amplitude |G|, to the phase -arg G: component by component. Gains depend on w and
 * direction alone and are interpolated (sea_gains.c). */
static void apply_gains(struct waves *w)
{
    struct sea_gains *is =
        sea_gains_create(&w->of, w->components[0].w, w->components[w->ncomponents - 1].w);
    for (int c = 0; c < w->ncomponents; c++) {
        struct wave_component *q = w->components + c;
        const double complex closed =
            sea_gains_at(is, q->w, q->way[0] * w->of.normal[0] + q->way[1] * w->of.normal[1]);
        const double complex G = sea_gain_open(&w->of, q->k, closed);
        q->a *= cabs(G);
        q->phase -= carg(G);
    }
    FREE(is);
}

/* [component][2][WAVE_NODES]: cosh and sinh over sinh at the still level. exp(-2 k (z + h)) instead
 * of cosh and sinh, which overflow in deep water. */
static double *profiles_of(const struct waves *w)
{
    double *profile = NEW(double, (size_t)w->ncomponents *WAVE_NODES * 2);
    for (int c = 0; c < w->ncomponents; c++)
        for (int j = 0; j < WAVE_NODES; j++) {
            const double k = w->components[c].k, depth = w->of.depth,
                         z = wave_table_height(&w->table, 0, j), all = 1.0 - exp(-2.0 * k * depth);
            const double up = exp(k * z), down = exp(-k * (z + 2.0 * depth));
            double *q = profile + (size_t)c * WAVE_NODES * 2 + j;
            q[0] = (up + down) / all;
            q[WAVE_NODES] = (up - down) / all;
        }
    return profile;
}

/* Velocities at a column's nodes: along, up, across. */
struct column_velocities {
    double u[3][WAVE_NODES];
};

/* profile: along, then up, at the nodes. Long crests have nothing across. */
static void add_component(struct column_velocities *to, const struct wave_component *q,
                          const double *profile, double co, double si)
{
    const double along = q->w * co * q->way[0], up = q->w * si;
    for (int j = 0; j < WAVE_NODES; j++) {
        to->u[0][j] += along * profile[j];
        to->u[1][j] += up * profile[WAVE_NODES + j];
    }
    if (q->way[1] == 0.0)
        return;
    const double across = q->w * co * q->way[1];
    for (int j = 0; j < WAVE_NODES; j++)
        to->u[2][j] += across * profile[j];
}

/* e: of each component a e^(i th) at the column. to->slope: derivatives of u and w along z at the
 * still level; order 2 continues the profiles by them above it (wave_table_velocity). */
static void make_column(const struct waves *w, const double complex *e, struct wave_table *to,
                        size_t at)
{
    double *u = to->u + at * WAVE_NODES * (size_t)to->parts;
    struct column_velocities is = {.u = {{0.0}}};
    for (int c = 0; c < w->ncomponents; c++) {
        const struct wave_component *q = w->components + c;
        const double *profile = w->profile + (size_t)c * WAVE_NODES * 2;
        const double co = creal(e[c]), si = cimag(e[c]);
        to->eta[at] += co;
        add_component(&is, q, profile, co, si);
        if (to->slope) { /* d/dz of cosh and sinh */
            to->slope[2 * at] += q->k * q->w * co * profile[WAVE_NODES];
            to->slope[2 * at + 1] += q->k * q->w * si * profile[0];
        }
    }
    for (int j = 0; j < WAVE_NODES; j++)
        for (int a = 0; a < to->parts; a++)
            u[to->parts * j + a] = is.u[a][j];
}

/* Phases turn from column to column of a row. e^(i k gap) turns a component from column to column:
 * one complex product instead of a cosine and a sine. */
static void make_row(struct waves *w, double t, struct wave_table *to, int row)
{
    const double y = to->first_row + row * to->gap,
                 first = to->first - w->of.current * t; /* in the water's frame */
    double complex *e = w->turning, *step = e + w->ncomponents;
    for (int c = 0; c < w->ncomponents; c++) {
        const struct wave_component *q = w->components + c;
        const double along = q->k * q->way[0];
        e[c] = q->a * cexp(I * (along * first + q->k * q->way[1] * y - q->w * t + q->phase));
        step[c] = cexp(I * (along * to->gap));
    }
    const size_t at = (size_t)row * (size_t)to->n;
    for (int i = 0; i < to->n; i++) {
        make_column(w, e, to, at + (size_t)i);
        for (int c = 0; c < w->ncomponents; c++)
            e[c] *= step[c];
    }
    if (w->second)
        second_order_add(w->second, t, first, to->gap, to->n, to->eta + at,
                         to->u + at * WAVE_NODES * 2);
}

/* Frames of a nonlinear field are read off its state; all others are summed from components. */
static void make_frame(struct waves *w, long frame, struct wave_table *to)
{
    const double t = (double)frame * w->dt;
    if (w->field && !wave_field_frame(w->field, frame, w->filter, to))
        fail_with(RUN_DIVERGED,
                  "waves: the evolving waves break before t = %.4g s, which potential flow cannot "
                  "follow: lower waves.height, or waves.evolve = \"no\"",
                  t);
    if (w->field)
        return;
    wave_table_blend(to, 0, NULL, NULL); /* all 0 */
    for (int row = 0; row < to->rows; row++)
        make_row(w, t, to, row);
}

/* m^2/s: what the sea carries along. */
static double transport_of(const struct waves *w)
{
    double flux = 0.0;
    for (int c = 0; c < w->ncomponents; c++) {
        const struct wave_component *q = w->components + c;
        flux += 0.5 * w->of.g * q->a * q->a * q->k / q->w * q->way[0];
    }
    return flux;
}

/* 20 frames of the shortest wave's period as seen from the ground, 8 columns of its length (4 where
 * it spreads, for those run aslant): cubics through four entries, whose phases differ by d, err by
 * 3/128 d^4: for the shortest component, which has next to no energy, 2e-4 in time, 1e-2 along x
 * and 0.14 where it spreads; it falls with the fourth power of the wave number. Two columns more at
 * each end serve the cubics there. */
static void make_tables(struct waves *w)
{
    const struct wave_spec *of = &w->of;
    const struct wave_component *low = w->components, *high = low + w->ncomponents - 1;
    w->longest = 2.0 * M_PI / low->k;
    w->shortest = 2.0 * M_PI / high->k;
    w->dt = 2.0 * M_PI / fmax(high->w, high->w + high->k * of->current) / 20.0;
    const double gap = w->shortest / (of->spread > 0.0 ? 4.0 : 8.0);
    const int n = (int)ceil((of->window[0][1] - of->window[0][0]) / gap) + 5,
              rows =
                  of->spread > 0.0 ? (int)ceil((of->window[1][1] - of->window[1][0]) / gap) + 5 : 1;
    for (int f = 0; f <= WAVE_FRAMES; f++) {
        struct wave_table *t = f < WAVE_FRAMES ? w->frames + f : &w->table;
        *t = wave_table_create(w, n, rows, gap, sea_reach(of->depth, w->longest), of->order > 1);
        t->first = of->window[0][0] - 2.0 * gap;
        t->first_row = of->window[1][0] - 2.0 * gap;
        t->decay = t->reach < of->depth ? low->k : 0.0;
        t->flat = true;
        if (f < WAVE_FRAMES)
            w->frame[f] = -1000000 - f;
    }
    w->profile = mem_own(w, profiles_of(w));
    w->turning = NEW_IN(w, double complex, (size_t)w->ncomponents * 2);
}

/* A group keeps the mean that it has below it: there is still water before and after it. */
static void make_second(struct waves *w)
{
    double nodes[WAVE_NODES];
    for (int j = 0; j < WAVE_NODES; j++)
        nodes[j] = wave_table_height(&w->table, 0, j);
    w->second = mem_own(w, second_order_create(w->ncomponents, w->components, w->of.g, w->of.depth,
                                               nodes, w->of.kind == WAVE_FOCUSED));
    w->transport = w->of.kind == WAVE_SEA ? transport_of(w) : 0.0;
    w->current = w->of.closed ? -w->transport / w->of.depth : 0.0;
}

/* Frames of what evolves are its steps. */
static void make_field(struct waves *w)
{
    struct wave_spec *of = &w->of;
    const bool read = of->kind == WAVE_FILE;
    for (int k = 0; k < 2 && read; k++)
        of->window[0][k] -= of->at[0];
    w->field = read ? wave_field_of_file(of, w->length, &w->components, &w->ncomponents)
                    : wave_field_create(of, w->period, w->length, &w->components, &w->ncomponents);
    mem_own(w, w->field);
    mem_own(w, w->components);
    w->longest = 2.0 * M_PI / w->components[0].k;
    w->shortest = 2.0 * M_PI / w->components[w->ncomponents - 1].k;
    w->dt = w->field->of->of.dt;
    w->filter = mem_own(w, wave_field_filter(w->field, of, w->components, w->ncomponents));
    w->table = wave_field_table(w, w->field, of, w->longest);
    for (int f = 0; f < WAVE_FRAMES; f++) {
        w->frames[f] = wave_field_table(w, w->field, of, w->longest);
        w->frame[f] = -1000000 - f;
    }
    w->transport = of->kind != WAVE_FOCUSED ? transport_of(w) : 0.0;
    w->current = of->closed ? -w->transport / of->depth : 0.0;
}

/* Level of a group at its focus after t s. */
static double level_at_focus(struct waves *w, double t)
{
    double eta = 0.0, u[WAVE_NODES * 2] = {0.0};
    for (int c = 0; c < w->ncomponents; c++)
        eta +=
            w->components[c].a * cos((w->components[c].w + w->components[c].k * w->of.current) * t);
    if (w->second)
        second_order_add(w->second, w->of.at[1] + t,
                         w->of.at[0] - w->of.current * (w->of.at[1] + t), 0.0, 1, &eta, u);
    return eta;
}

/* Of 1000 waves the highest is 1.86 times the significant height (Rayleigh). For the time step and
 * the size of the domain before a run, not for the waves themselves. A group is looked at around
 * its focus, at TIMES instants of a period before and after. speed: that of the water under the
 * crest, with 30 % to spare. */
static void expect_extremes(struct waves *w)
{
    enum { TIMES = 60 };
    const double k = 2.0 * M_PI / w->length, h = w->of.depth,
                 a = w->of.kind != WAVE_FOCUSED ? 0.93 * w->of.height : 0.5 * w->of.height,
                 second = w->second || w->field ? bound_wave_stokes(a, k, h) : 0.0;
    w->crest = a * (1.0 + second);
    w->trough = -a * (1.0 - second);
    if (w->of.kind == WAVE_FOCUSED) {
        w->crest = w->trough = 0.0;
        for (int i = -TIMES; i <= TIMES; i++) {
            const double eta = level_at_focus(w, w->period * i / TIMES);
            w->crest = fmax(w->crest, eta);
            w->trough = fmin(w->trough, eta);
        }
        w->crest *= w->field ? 1.0 + second : 1.0;
        w->trough *= w->field ? 1.0 - second : 1.0;
    }
    w->speed = 1.3 * w->crest * 2.0 * M_PI / w->period / tanh(fmin(k * h, 300.0));
}

/* Tables first, as second order wants their nodes; gains last, as they change components. */
void sea_make(struct waves *w)
{
    const struct wave_spec *of = &w->of;
    w->length = waves_length(of);
    w->period = waves_period(of);
    w->celerity = w->length / w->period;
    if (of->evolve != EVOLVE_NO || of->kind == WAVE_FILE)
        make_field(w);
    else {
        w->components = mem_own(w, sea_components(of, w->period, &w->ncomponents));
        make_tables(w);
        if (of->order > 1)
            make_second(w);
    }
    expect_extremes(w);
    if (of->zone > 0.0 && !w->field)
        apply_gains(w);
}

/* About 0.3 ns a product. */
double sea_seconds(const struct waves *w)
{
    if (w->field)
        return wave_field_seconds(w->field, w->period);
    const double column = (double)w->ncomponents * WAVE_NODES * w->table.parts +
                          (w->second ? second_order_products(w->second) : 0.0);
    return 0.3e-9 * column * w->table.n * w->table.rows * w->period / w->dt;
}

/* Cubic through the frames dt apart of which t lies between the middle two; each frame has its own
 * slot, so that it is computed once. */
void sea_at(struct waves *w, double t)
{
    const long m = (long)floor(t / w->dt);
    double of[WAVE_FRAMES], weight[WAVE_FRAMES];
    wave_table_cubic(t / w->dt - (double)m, of);
    for (int k = 0; k < WAVE_FRAMES; k++) {
        const long f = m + k - 1;
        const int slot = (int)(((f % WAVE_FRAMES) + WAVE_FRAMES) % WAVE_FRAMES);
        if (w->frame[slot] != f)
            make_frame(w, f, w->frames + slot);
        w->frame[slot] = f;
        weight[slot] = of[k];
    }
    wave_table_blend(&w->table, WAVE_FRAMES, w->frames, weight);
    wave_pressure_frame(w, t / w->dt - (double)m);
}

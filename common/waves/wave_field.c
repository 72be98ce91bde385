/* wave_field.c - see wave_field.h. Every rank evolves the whole field (evolution.h) and reads
 * frames off it for its own window: nothing is communicated. A frame in order: the state of its
 * step (go_to, or read_file for a file's), velocities at the layer's nodes to modes (fill_upper),
 * velocities below the layer from the potential at its lower end (fill_lower), both to a grid of
 * twice the points along a line (refine), the window's columns into the table (copy_window).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_field.h"

#include <complex.h>

#include "../base/base.h"
#include "sea.h"
#include "sea_gains.h"
#include "wave_field_start.h"
#include "wave_file.h"

enum {
    STEPS = 60, /* a period of the peak */
    LEAD = 8,   /* periods before t = 0 */
    NODES = 8,
    FILE_NODES = 13,  /* of a layer whose highest modes are another's */
    LINE_POINTS = 42, /* a length of the peak; a third of them are modes */
    PLANE_POINTS = 30,
    LINE_ORDER = 5,
    STEEP_ORDER = 7 /* from a steepness of 0.2 on */
};

static const double undamped = 0.6; /* of the highest mode: components are at most that */
static const double drift = 0.05;   /* of the energy, above which it is not that of waves */

/* As long as the peak's energy travels while a sea does not repeat itself. */
static struct wave_grid *make_grid(const struct wave_spec *of, double period, double length)
{
    const bool plane = of->spread > 0.0;
    const double gap = length / (plane ? PLANE_POINTS : LINE_POINTS), k = 2.0 * M_PI / length,
                 kh = 2.0 * fmin(k * of->depth, 150.0),
                 speed = 0.5 * length / period * (1.0 + kh / sinh(kh));
    const double along =
                     fmax(of->repeat * speed, of->window[0][1] - of->window[0][0] + 4.0 * length),
                 across = fmax(6.0 * length, of->window[1][1] - of->window[1][0] + 2.0 * length);
    const int n[2] = {fft_size((int)ceil(along / gap)),
                      plane ? fft_size((int)ceil(across / gap)) : 1};
    return wave_grid_create(n, (double[2]){n[0] * gap, n[1] * gap});
}

/* Values at even nodes from those at Chebyshev's, by barycentric interpolation. The weights of the
 * second kind of points: (-1)^j, halved at the ends. Where a node falls upon a point (hit) its
 * value is taken. */
static void make_raise(struct wave_field *f)
{
    const int n = f->of->layer->nodes;
    const double *sigma = f->of->layer->sigma;
    f->raise = NEW_IN(f, double, f->upper *n);
    for (int i = 0; i < f->upper; i++) {
        const double s = -(double)i / (f->upper - 1);
        double sum = 0.0, *row = f->raise + i * n;
        int hit = -1;
        for (int j = 0; j < n; j++) {
            const double w = (j % 2 ? -1.0 : 1.0) * (j == 0 || j == n - 1 ? 0.5 : 1.0);
            hit = fabs(s - sigma[j]) < 1e-14 ? j : hit;
            row[j] = w / (s - sigma[j]);
            sum += row[j];
        }
        for (int j = 0; j < n; j++)
            row[j] = hit >= 0 ? j == hit : row[j] / sum;
    }
}

/* cosh and sinh of k(z + h) over cosh k(h - a) at the nodes that stand still. Written with
 * exponentials below 1, as k h may be large. */
static void make_lower(struct wave_field *f, const struct wave_table *t)
{
    const struct wave_grid *g = f->of->grid;
    const int n = WAVE_NODES - f->upper;
    const double h = f->of->of.depth, a = f->of->of.height;
    for (int b = 0; b < 2; b++)
        f->lower[b] = NEW_IN(f, double, g->cells *n);
    for (int m = 0; m < g->cells; m++)
        for (int i = 0; i < n; i++) {
            const double k = g->size[m], z = wave_table_height(t, 0, f->upper + i),
                         up = exp(k * (z + a)), down = exp(-k * (z + 2.0 * h - a)),
                         all = 1.0 + exp(-2.0 * k * (h - a));
            f->lower[0][m * n + i] = (up + down) / all;
            f->lower[1][m * n + i] = (up - down) / all;
        }
}

/* Columns stand on the fine grid's points, so that a frame needs no interpolation; still = 0 where
 * the layer reaches as deep as the table: then all nodes move. */
struct wave_table wave_field_table(void *owner, const struct wave_field *f,
                                   const struct wave_spec *of, double longest)
{
    const double gap = f->fine->length[0] / f->fine->n[0], still = f->of->of.height;
    int first[2], n[2];
    for (int a = 0; a < 2; a++) {
        first[a] = (int)floor(of->window[a][0] / gap) - 2;
        n[a] = (int)ceil(of->window[a][1] / gap) + 3 - first[a];
    }
    struct wave_table t = wave_table_create(owner, n[0], f->fine->n[1] > 1 ? n[1] : 1, gap,
                                            fmax(sea_reach(of->depth, longest), still), false);
    t.still = still < t.reach ? still : 0.0;
    t.first = first[0] * gap;
    t.first_row = f->fine->n[1] > 1 ? first[1] * gap : 0.0;
    t.decay = t.reach < of->depth ? 2.0 * M_PI / longest : 0.0;
    return t;
}

/* The tables' grid, what lies below the layer, room to work in. */
static void finish(struct wave_field *f, const struct wave_spec *of,
                   struct wave_component *components, int n)
{
    const struct wave_grid *g = f->of->grid;
    const bool plane = g->n[1] > 1;
    const double longest = 2.0 * M_PI / components[0].k, still = f->of->of.height;
    f->components = components;
    f->n = n;
    f->fine =
        mem_own(f, wave_grid_create((int[2]){plane ? g->n[0] : 2 * g->n[0], g->n[1]}, g->length));
    f->start = NEW_IN(f, double, g->cells * 2);
    struct wave_table t =
        wave_table_create(NULL, 4, 1, 1.0, fmax(sea_reach(of->depth, longest), still), false);
    t.still = still < t.reach ? still : 0.0;
    f->upper = t.still > 0.0 ? WAVE_UPPER : WAVE_NODES;
    make_raise(f);
    make_lower(f, &t);
    FREE(t.eta, t.u);
    const size_t size = (size_t)f->fine->cells * 2 * (WAVE_NODES + 1);
    f->z = NEW_IN(f, double, (size_t)g->cells * 2 * (WAVE_NODES + 1));
    f->padded = NEW_IN(f, double, size);
    f->work = NEW_IN(f, double, size);
    for (int i = 0; i < WAVE_FIELD_KEPT; i++) {
        f->kept[i] = -1;
        f->states[i] = NEW_IN(f, double, g->cells * 2);
    }
}

/* The layer reaches to 1.5 times the amplitude of the waves (layer_height): the highest of a sea
 * are higher than its 0.93 H_s. STEEP_ORDER where the steepness k a asks for it. */
struct wave_field *wave_field_create(const struct wave_spec *of, double period, double length,
                                     struct wave_component **components, int *n)
{
    struct wave_field *f = NEW(struct wave_field, 1);
    struct wave_grid *g = make_grid(of, period, length);
    const double k = 2.0 * M_PI / length, a = waves_amplitude(of);
    const struct evolution_spec spec = {.g = of->g,
                                        .depth = of->depth,
                                        .dt = period / STEPS,
                                        .highest =
                                            k * (g->n[1] > 1 ? PLANE_POINTS : LINE_POINTS) / 3.0,
                                        .height = layer_height(k, 1.5 * a, of->depth),
                                        .nodes = NODES,
                                        .order = of->evolve != EVOLVE_HOS ? 0
                                                 : k * a > 0.2            ? STEEP_ORDER
                                                                          : LINE_ORDER};
    f->of = mem_own(f, evolution_create(&spec, g));
    f->t0 = -LEAD * period;
    *components = wave_field_components(of, period, g, undamped * spec.highest, n);
    finish(f, of, *components, *n);
    return f;
}

/* Three points for each of the file's modes, so that products of two are not folded back;
 * FILE_NODES, more than NODES, since its shortest modes are not filtered. */
struct wave_field *wave_field_of_file(const struct wave_spec *of, double length,
                                      struct wave_component **components, int *n)
{
    struct wave_field *f = NEW(struct wave_field, 1);
    char error[600];
    f->file = mem_own(f, swd_open(of->file, error, sizeof error));
    if (!f->file)
        abort_run("%s", error);
    const struct swd_header is = swd_header_of(f->file);
    const double k = 2.0 * M_PI / length, line[2] = {2.0 * M_PI / is.dk, 1.0};
    const struct evolution_spec spec = {.g = of->g,
                                        .depth = of->depth,
                                        .dt = is.dt,
                                        .highest = is.dk * (is.n + 0.5),
                                        .height = layer_height(k, 1.4 * of->height, of->depth),
                                        .nodes = FILE_NODES};
    f->of = mem_own(
        f, evolution_create(&spec, wave_grid_create((int[2]){fft_size(3 * is.n), 1}, line)));
    f->modes = NEW_IN(f, double, 4 * (is.n + 1));
    *components = wave_file_components(f->file, of->g, of->depth, n);
    finish(f, of, *components, *n);
    return f;
}

/* Below the components' frequencies what is bound to them needs nothing; above, as at the highest.
 * Linear gains by direction and frequency, for modes that may be bound ones: a bound wave of long
 * length is hardly affected by the zone and is left as it is. */
double complex *wave_field_filter(const struct wave_field *f, const struct wave_spec *of,
                                  const struct wave_component *components, int n)
{
    const struct wave_grid *g = f->of->grid;
    if (!(of->zone > 0.0))
        return NULL;
    const double low = components[0].w, high = fmax(components[n - 1].w, 1.01 * low);
    struct sea_gains *gains = sea_gains_create(of, low, high);
    double complex *filter = NEW(double complex, g->cells);
    for (int m = 0; m < g->cells; m++) {
        const double k = g->size[m], w = waves_frequency(k, of->g, of->depth),
                     kx = g->k[0][m % g->n[0]], ky = g->k[1][m / g->n[0]],
                     way = kx < 0.0 ? -1.0 : 1.0;
        const double cosine = way * (kx * of->normal[0] + ky * of->normal[1]) / fmax(k, 1e-300);
        const double complex is = w < low ? 1.0 : sea_gains_at(gains, fmin(w, high), cosine);
        filter[m] = way > 0.0 ? conj(is) : is; /* e^(i(kx - wt)) of k > 0, its conjugate of k < 0 */
    }
    FREE(gains);
    return filter;
}

/* --- steps --- */

static void keep(struct wave_field *f)
{
    const int slot = (int)(f->of->step % WAVE_FIELD_KEPT);
    f->kept[slot] = f->of->step;
    memcpy(f->states[slot], f->of->state, (size_t)f->of->grid->cells * 2 * sizeof(double));
}

/* The modes of the start are made once; each later start is from them. */
static void begin(struct wave_field *f)
{
    if (!f->begun)
        wave_field_modes(f->of->grid, f->components, f->n, &f->of->of, f->t0, f->start);
    f->begun = true;
    evolution_restore(f->of, 0, f->start);
}

/* From a restart: the field goes on from that step. */
void wave_field_set(struct wave_field *f, long step, const double *modes, double energy)
{
    if (!f->begun)
        begin(f);
    evolution_restore(f->of, step, modes);
    f->energy = energy;
    keep(f);
}

/* A time of a file; those before its first are as that. */
static bool read_file(struct wave_field *f, long step)
{
    const struct swd_header is = swd_header_of(f->file);
    double *h = f->modes, *c = h + 2 * (is.n + 1), *eta = f->z, *phi = eta + f->of->grid->cells;
    if (step >= is.nsteps)
        return false;
    swd_read(f->file, (int)step, h, c);
    swd_fields(f->file, h, c, f->of->grid->cells, eta, phi);
    evolution_start(f->of, eta, phi);
    return evolution_look(f->of);
}

/* To the state of a step, on from where it stands or from one before. A step behind the present one
 * is taken from the states that are kept, WAVE_FIELD_KEPT of them, or computed again from the
 * start: either way it has the same bits. `energy' is noted at t = 0; a rise by `drift' tells that
 * the waves are no longer resolved. */
static bool go_to(struct wave_field *f, long step)
{
    if (!f->begun)
        begin(f);
    if (f->of->step > step) {
        const int slot = (int)(step % WAVE_FIELD_KEPT);
        if (f->kept[slot] == step)
            evolution_restore(f->of, step, f->states[slot]);
        else
            begin(f);
    }
    while (f->of->step < step) {
        keep(f);
        if (!evolution_step(f->of))
            return false;
        if (f->of->step > LEAD * STEPS && f->energy == 0.0)
            f->energy = f->of->energy;
        if (f->energy > 0.0 && f->of->energy > (1.0 + drift) * f->energy)
            return false;
    }
    keep(f);
    return evolution_look(f->of);
}

/* --- frames --- */

/* Fields u + i w (part 0) or v (part 1) of the nodes that move, and eta in the last place. raise
 * takes values from Chebyshev's points to the even nodes of the table. */
static void fill_upper(struct wave_field *f, int part, int batch)
{
    const struct sigma_layer *l = f->of->layer;
    for (int i = 0; i < f->of->grid->cells; i++) {
        double u[3][64], *z = f->z + (size_t)i * 2 * (size_t)batch;
        layer_velocity(l, i, u[0], u[1], part ? u[2] : NULL);
        for (int j = 0; j < f->upper; j++) {
            double re = 0.0, im = 0.0;
            for (int k = 0; k < l->nodes; k++) {
                const double w = f->raise[j * l->nodes + k];
                re += w * u[part ? 2 : 0][k];
                im += part ? 0.0 : w * u[1][k];
            }
            z[j] = re;
            z[batch + j] = im;
        }
        z[batch - 1] = f->of->eta[i];
        z[2 * batch - 1] = 0.0;
    }
}

/* Modes of the nodes that stand still, from those of the potential at the layer's lower end. */
static void fill_lower(struct wave_field *f, int part, int batch)
{
    const struct sigma_layer *l = f->of->layer;
    const struct wave_grid *g = f->of->grid;
    const int n = WAVE_NODES - f->upper;
    double *phi = f->padded;
    for (int i = 0; i < g->cells; i++) {
        phi[2 * i] = l->phi[(size_t)i * (size_t)l->rows + (size_t)l->nodes - 1];
        phi[2 * i + 1] = 0.0;
    }
    wave_grid_to_modes(g, 1, phi, f->work);
    for (int m = 0; m < g->cells; m++) {
        double *z = f->z + (size_t)m * 2 * (size_t)batch + f->upper;
        const double k = part ? g->k[1][m / g->n[0]] : g->k[0][m % g->n[0]];
        const double re = phi[2 * m], im = phi[2 * m + 1], size = part ? 0.0 : g->size[m];
        for (int j = 0; j < n; j++) { /* i k phi cosh + i |k| phi sinh */
            const double q = k * f->lower[0][m * n + j] + size * f->lower[1][m * n + j];
            z[j] = -q * im;
            z[batch + j] = q * re;
        }
    }
}

/* Makes up for the zone, to the finer grid, to fields. Zeros are put between the modes of both
 * signs. The mode n/2, which has no sign, is left out. eta, in the last place of the batch, is not
 * filtered: the zone asks for velocities. */
static void refine(struct wave_field *f, int batch, const double complex *filter)
{
    const struct wave_grid *g = f->of->grid, *to = f->fine;
    const size_t block = 2 * (size_t)batch;
    memset(f->padded, 0, (size_t)to->cells * block * sizeof(double));
    for (int m = 0; m < g->cells; m++) {
        const int i = m % g->n[0], j = m / g->n[0];
        if (2 * i == g->n[0] || (g->n[1] > 1 && 2 * j == g->n[1]))
            continue;
        double *q = f->padded +
                    (size_t)(j * to->n[0] + (2 * i > g->n[0] ? i + to->n[0] - g->n[0] : i)) * block;
        const double *z = f->z + (size_t)m * block;
        const double re = filter ? creal(filter[m]) : 1.0, im = filter ? cimag(filter[m]) : 0.0;
        for (int b = 0; b < batch - 1; b++) {
            q[b] = re * z[b] - im * z[batch + b];
            q[batch + b] = re * z[batch + b] + im * z[b];
        }
        q[batch - 1] = z[batch - 1];
        q[2 * batch - 1] = z[2 * batch - 1];
    }
    wave_grid_to_fields(to, batch, f->padded, f->work);
}

static int wrapped(int i, int n) { return (i % n + n) % n; }

/* The grid is periodic, so indices of the window wrap round. */
static void copy_window(const struct wave_field *f, int part, int batch, struct wave_table *to)
{
    const struct wave_grid *g = f->fine;
    const int first = (int)lround(to->first / to->gap), row = (int)lround(to->first_row / to->gap);
    for (int at = 0; at < to->n * to->rows; at++) {
        const int i = wrapped(first + at % to->n, g->n[0]), j = wrapped(row + at / to->n, g->n[1]);
        const double *z = f->padded + (size_t)(j * g->n[0] + i) * 2 * (size_t)batch;
        double *u = to->u + (size_t)at * WAVE_NODES * (size_t)to->parts;
        to->eta[at] = z[batch - 1];
        for (int k = 0; k < WAVE_NODES; k++) {
            u[to->parts * k + (part ? 2 : 0)] = z[k];
            if (!part)
                u[to->parts * k + 1] = z[batch + k];
        }
    }
}

/* part 0: along and up as one complex field; part 1, of a plane alone: across. */
bool wave_field_frame(struct wave_field *f, long frame, const double complex *filter,
                      struct wave_table *to)
{
    const int batch = WAVE_NODES + 1;
    const long step = f->file ? frame : frame + LEAD * STEPS, from = step > 0 ? step : 0;
    if (!(f->file ? read_file(f, from) : go_to(f, from)))
        return false;
    for (int part = 0; part < to->parts - 1; part++) {
        fill_upper(f, part, batch);
        wave_grid_to_modes(f->of->grid, batch, f->z, f->work);
        fill_lower(f, part, batch);
        refine(f, batch, filter);
        copy_window(f, part, batch, to);
    }
    return true;
}

/* 6e-8 s for a value of the layer and product; 14 products' worth a step of hos, 40 with the
 * layer. */
double wave_field_seconds(const struct wave_field *f, double period)
{
    const double values = (double)f->of->grid->cells * f->of->layer->rows;
    const double products = f->of->hos ? 14.0 : 40.0; /* of a step */
    return f->file ? 6e-8 * period / f->of->of.dt * 15.0 * values
                   : 6e-8 * STEPS * products * values;
}

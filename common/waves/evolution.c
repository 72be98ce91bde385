/* evolution.c - see evolution.h. Between steps the state is the modes of eta + i phi_s. A step
 * turns them exactly by the linear waves' operator and takes Runge-Kutta stages for the rest: with
 * z = e^(Lt) y, y' = e^(-Lt) N(e^(Lt) y), so that dt is bounded by the nonlinear terms and not by
 * the fastest ripple. Products of fields are formed in points; modes beyond `highest' are dropped
 * after each step. It is two thirds of what the points can hold (wave_field.c), so that what
 * products of two fields fold back falls into the part that is dropped.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "evolution.h"

#include "../base/base.h"

enum { FIELDS = 4 }; /* eta + i phi_s, their x- and y-derivatives, linear W */

static const double tolerance = 1e-6; /* of the layer's residual */

/* linear[] is W of a small wave as the code computes it, with the layer's error of few nodes
 * (layer_flat_rise). It is taken off the rates where the exact operator is put in its place (turn),
 * so that small waves have the exact dispersion and the layer serves the differences. */
struct evolution *evolution_create(const struct evolution_spec *of, struct wave_grid *grid)
{
    struct evolution *e = NEW(struct evolution, 1);
    const size_t n = (size_t)grid->cells * 2;
    *e = (struct evolution){.of = *of, .grid = mem_own(e, grid)};
    e->layer = mem_own(e, layer_create(grid, of->depth, of->height, of->nodes));
    if (of->order > 0)
        e->hos = mem_own(e, hos_create(grid, of->depth, of->order, of->highest));
    e->state = NEW_IN(e, double, n);
    e->linear = NEW_IN(e, double, grid->cells);
    for (int i = 0; i < grid->cells; i++) {
        const double k = grid->size[i];
        e->linear[i] =
            k * tanh(fmin(k * of->depth, 300.0)) * (e->hos ? 1.0 : layer_flat_rise(e->layer, k));
    }
    e->eta = NEW_IN(e, double, n);
    e->phi = NEW_IN(e, double, n);
    e->fields = NEW_IN(e, double, n *FIELDS);
    for (int i = 0; i < 2; i++) {
        e->work[i] = NEW_IN(e, double, n *FIELDS);
        e->at[i] = NEW_IN(e, double, n);
    }
    for (int i = 0; i < EVOLUTION_STAGES; i++)
        e->rate[i] = NEW_IN(e, double, n);
    return e;
}

/* Fields to modes, of which those beyond `highest' go. */
static void to_state(struct evolution *e, double *z)
{
    wave_grid_to_modes(e->grid, 1, z, e->work[0]);
    for (int i = 0; i < e->grid->cells; i++)
        if (e->grid->size[i] > e->of.highest)
            z[2 * i] = z[2 * i + 1] = 0.0;
}

/* One complex field: both are real, and cost one transform. */
void evolution_start(struct evolution *e, const double *eta, const double *phi)
{
    for (int i = 0; i < e->grid->cells; i++) {
        e->state[2 * i] = eta[i];
        e->state[2 * i + 1] = phi[i];
    }
    to_state(e, e->state);
    e->step = 0;
    e->looked = false;
}

void evolution_restore(struct evolution *e, long step, const double *modes)
{
    memcpy(e->state, modes, (size_t)e->grid->cells * 2 * sizeof *modes);
    e->step = step;
    e->looked = false;
}

/* eta and phi_s, their slopes and what W is of linear waves: z [cells][2][FIELDS] of modes. A
 * mode's partner m (mirror, -k) tells the two real fields apart: of eta + i phi_s, eta's mode is (z
 * + conj m)/2 and phi_s' is (z - conj m)/(2i). */
static void expand(struct evolution *e, const double *modes)
{
    const struct wave_grid *g = e->grid;
    for (int i = 0; i < g->cells; i++) {
        const double *z = modes + 2 * i, *m = modes + 2 * g->mirror[i], kx = g->k[0][i % g->n[0]],
                     ky = g->k[1][i / g->n[0]], rise = e->linear[i];
        double *q = e->fields + (size_t)i * 2 * FIELDS;
        q[0] = z[0];
        q[FIELDS] = z[1];
        q[1] = -kx * z[1];
        q[FIELDS + 1] = kx * z[0];
        q[2] = -ky * z[1];
        q[FIELDS + 2] = ky * z[0];
        q[3] = 0.5 * rise * (z[1] + m[1]); /* of phi_s alone */
        q[FIELDS + 3] = 0.5 * rise * (m[0] - z[0]);
    }
    wave_grid_to_fields(g, FIELDS, e->fields, e->work[0]);
}

static double slope2_of(const double *q) { return q[1] * q[1] + q[2] * q[2]; }

/* (1 + |grad eta|^2) W and (1 + |grad eta|^2) W^2 of the fields into work[0], [2][cells]. solved:
 * the layer has their potential. hos gives both products consistently in order; the layer gives W,
 * and they are formed point by point. */
static bool find_rise(struct evolution *e, bool solved)
{
    const int n = e->grid->cells;
    double *eta = e->work[1], *phi = eta + n, *slope2 = phi + n, *rise = e->work[0],
           *square = rise + n;
    for (int i = 0; i < n; i++) {
        const double *q = e->fields + (size_t)i * 2 * FIELDS;
        eta[i] = q[0];
        phi[i] = q[FIELDS];
        slope2[i] = slope2_of(q);
    }
    if (e->hos) {
        hos_rise(e->hos, eta, phi, slope2, rise, square);
        return true;
    }
    if (!solved) {
        layer_shape(e->layer, eta);
        const int products = layer_solve(e->layer, phi, tolerance, true);
        if (products < 0)
            return false;
        e->products += products;
    }
    for (int i = 0; i < n; i++) {
        const double W = layer_rise(e->layer, i);
        rise[i] = (1.0 + slope2[i]) * W;
        square[i] = rise[i] * W;
    }
    return true;
}

/* Rates of the modes without their linear part; first: of the state that was looked at, with its
 * energy. With q the fields in points: eta_t less the linear W, and phi_t less -g eta, which turn()
 * has. energy is the mean of (phi_s eta_t + g eta^2)/2, kinetic and potential energy over rho. */
static bool find_rates(struct evolution *e, const double *modes, bool first, double *rate)
{
    const int n = e->grid->cells;
    double energy = 0.0;
    expand(e, modes);
    if (!find_rise(e, first))
        return false;
    for (int i = 0; i < n; i++) {
        const double *q = e->fields + (size_t)i * 2 * FIELDS, *p = q + FIELDS;
        const double eta_t = e->work[0][i] - q[1] * p[1] - q[2] * p[2];
        rate[2 * i] = eta_t - q[3];
        rate[2 * i + 1] = 0.5 * (e->work[0][n + i] - p[1] * p[1] - p[2] * p[2]);
        energy += p[0] * eta_t + e->of.g * q[0] * q[0];
    }
    if (first)
        e->energy = 0.5 * energy / n;
    to_state(e, rate);
    return isfinite(energy);
}

/* Linear waves after dt: eta' = c eta + s (k t/w) phi, phi' = c phi - s (g/w) eta, t = tanh kh.
 * Mode and mirror at once, as eta and phi_s are real fields. w = 0, the mean: s is dt, eta stays
 * and phi_s falls by g eta dt. */
static void turn(const struct evolution *e, double *modes, double dt)
{
    for (int i = 0; i < e->grid->cells; i++) {
        const int j = e->grid->mirror[i];
        const double k = e->grid->size[i], rise = k * tanh(fmin(k * e->of.depth, 300.0)),
                     w = sqrt(e->of.g * rise), c = cos(w * dt), s = w > 0.0 ? sin(w * dt) / w : dt;
        double *z = modes + 2 * i, *m = modes + 2 * j;
        if (j < i)
            continue;
        const double eta[2] = {0.5 * (z[0] + m[0]), 0.5 * (z[1] - m[1])},
                     phi[2] = {0.5 * (z[1] + m[1]), 0.5 * (m[0] - z[0])};
        double a[2], b[2];
        for (int p = 0; p < 2; p++) {
            a[p] = c * eta[p] + s * rise * phi[p];
            b[p] = c * phi[p] - s * e->of.g * eta[p];
        }
        z[0] = a[0] - b[1];
        z[1] = a[1] + b[0];
        m[0] = a[0] + b[1];
        m[1] = b[0] - a[1];
    }
}

static void add(const struct evolution *e, double *to, double a, const double *of)
{
    for (int i = 0; i < 2 * e->grid->cells; i++)
        to[i] += a * of[i];
}

/* Runge-Kutta stages of what is turned to the middle of the step. k1 at the start turned half a
 * step on, k2 and k3 in the middle, k4 at the end; all are added up in evolution_step where they
 * belong. */
static bool stages(struct evolution *e)
{
    const double dt = e->of.dt;
    const size_t bytes = (size_t)e->grid->cells * 2 * sizeof(double);
    double **k = e->rate, *half = e->at[0], *z = e->at[1];
    if (!find_rates(e, e->state, true, k[0]))
        return false;
    memcpy(half, e->state, bytes);
    turn(e, half, 0.5 * dt);
    turn(e, k[0], 0.5 * dt);
    memcpy(z, half, bytes);
    add(e, z, 0.5 * dt, k[0]);
    if (!find_rates(e, z, false, k[1]))
        return false;
    memcpy(z, half, bytes);
    add(e, z, 0.5 * dt, k[1]);
    if (!find_rates(e, z, false, k[2]))
        return false;
    memcpy(z, half, bytes);
    add(e, z, dt, k[2]);
    turn(e, z, 0.5 * dt);
    return find_rates(e, z, false, k[3]);
}

/* Cold start of the solver (warm false): the result must not depend on what was solved before, so
 * that a restart finds the same bits. */
bool evolution_look(struct evolution *e)
{
    const int n = e->grid->cells;
    if (e->looked)
        return true;
    memcpy(e->fields, e->state, (size_t)n * 2 * sizeof *e->state);
    wave_grid_to_fields(e->grid, 1, e->fields, e->work[0]);
    for (int i = 0; i < n; i++) {
        e->eta[i] = e->fields[2 * i];
        e->phi[i] = e->fields[2 * i + 1];
        if (!(e->eta[i] > -e->of.height))
            return false;
    }
    layer_shape(e->layer, e->eta);
    const int products = layer_solve(e->layer, e->phi, tolerance, false);
    e->products += products > 0 ? products : 0;
    e->looked = products > 0;
    return e->looked;
}

/* The factor exp(-(k/(0.9 highest))^30) leaves modes up to 0.6 of the highest as they are, to 1e-5
 * a step; and and those beyond 0.9 of it lose most within a few steps: energy that breaking would
 * take does not pile up there. */
bool evolution_step(struct evolution *e)
{
    const double dt = e->of.dt;
    if ((!e->hos && !evolution_look(e)) || !stages(e))
        return false;
    double *z = e->at[0]; /* the state and its first rates, half a step on */
    add(e, z, dt / 6.0, e->rate[0]);
    add(e, z, dt / 3.0, e->rate[1]);
    add(e, z, dt / 3.0, e->rate[2]);
    turn(e, z, 0.5 * dt);
    add(e, z, dt / 6.0, e->rate[3]);
    for (int i = 0; i < e->grid->cells; i++) {
        const double k = e->grid->size[i] / (0.9 * e->of.highest),
                     left = e->grid->size[i] > e->of.highest ? 0.0 : exp(-pow(k, 30.0));
        e->state[2 * i] = left * z[2 * i];
        e->state[2 * i + 1] = left * z[2 * i + 1];
    }
    e->step++;
    e->looked = false;
    return true;
}

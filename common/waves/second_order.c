/* second_order.c - see second_order.h. Components are shared out to at most FREQUENCIES
 * frequencies: E_p = sum over i of L_p(w_i) a_i e^(i th_i), L_p cubic; what pairs make is then
 * sum over p, q of kernel_pq Re(E_p E_q) and Re(E_p E_q*). SPDX-License-Identifier: BSD-3-Clause */
#include "second_order.h"

#include <complex.h>

#include "../base/base.h"
#include "imposed_waves.h"

enum {
    FREQUENCIES = 40,
    LEVELS = 16,
    COLUMNS =
        16 /* summed side by side: the kernels, larger than the nearest cache, are read once */
};

/* Of p <= q, halves and both orders counted: what the sum and the difference of their phases make
 * of the level and of the velocities along and up at the levels. In single precision, as is what
 * pairs are summed in: rounding is far below what the cubics err by. */
struct kernel {
    float eta[2], along[2][LEVELS], up[2][LEVELS];
};
struct share {
    int first; /* of four frequencies */
    double weight[4];
};

struct second_order {
    int n, ncomponents, npairs;
    struct wave_component *of; /* owned */
    struct share *shares;      /* [ncomponents] */
    double *w;                 /* [n]: the frequencies between which pairs are told */
    struct kernel *kernels;    /* [npairs] */
    struct share node[WAVE_NODES];
    double mean[1 + LEVELS];  /* level and velocities to be taken out */
    double complex *e, *step; /* [ncomponents]: a e^(i th) at a column; what leads to the next */
    float (*E)[2][COLUMNS];   /* [n]: real and imaginary parts */
};

/* The two conditions of the head, solved by Cramer's rule. */
struct bound_wave bound_wave_of(const double k1[2], const double k2[2], double w1, double w2, int s,
                                double g, double h)
{
    const double dot = k1[0] * k2[0] + k1[1] * k2[1], W = w1 + s * w2;
    const double K = hypot(k1[0] + s * k2[0], k1[1] + s * k2[1]);
    const double one = k1[0] * k1[0] + k1[1] * k1[1], two = k2[0] * k2[0] + k2[1] * k2[1];
    const double T = tanh(fmin(K * h, 300.0));
    const double P = 0.5 * g * (s * two / w2 + one / w1 + dot * (1.0 / w2 + s / w1));
    const double R = 0.5 * (w1 * w1 + w2 * w2 + s * w1 * w2 - g * g * dot / (w1 * w2));
    const double D = g * K * T - W * W, phi = (W * R - g * P) / D;
    return (struct bound_wave){
        .eta = (K * T * R - W * P) / D, .u = phi * K, .w = phi * K * T, .K = K, .W = W};
}

double bound_wave_stokes(double a, double k, double depth)
{
    const double t = tanh(fmin(k * depth, 300.0));
    return 0.25 * a * k * (3.0 - t * t) / (t * t * t);
}

/* --- kernels --- */

/* Along a line, u towards +x. A wave and itself, s = -1: the limit, of two that differ little. */
static struct bound_wave along_line(double w1, double w2, int s, double g, double h)
{
    const double off = s < 0 && fabs(w1 - w2) < 2e-4 * w1 ? 1e-4 : 0.0;
    w1 *= 1.0 + off;
    w2 *= 1.0 - off;
    const double k1[2] = {waves_number(w1, g, h), 0.0}, k2[2] = {waves_number(w2, g, h), 0.0};
    struct bound_wave b = bound_wave_of(k1, k2, w1, w2, s, g, h);
    if (k1[0] + s * k2[0] < 0.0)
        b.u = -b.u;
    return b;
}

/* cosh K(z+h)/cosh Kh and sinh K(z+h)/sinh Kh. */
static void decay(double K, double z, double h, double *c, double *s)
{
    const double up = exp(K * z), down = exp(-K * (z + 2.0 * h)), twice = exp(-2.0 * K * h);
    *c = (up + down) / (1.0 + twice);
    *s = K * h > 1e-9 ? (up - down) / (1.0 - twice) : 1.0 + z / h;
}

/* With p = q both orders of the pair are one, hence the half. Profiles on LEVELS heights, which are
 * close together near the surface. */
static void make_kernels(struct second_order *s, double g, double h, const double *level)
{
    int at = 0;
    for (int p = 0; p < s->n; p++)
        for (int q = p; q < s->n; q++, at++) {
            struct kernel *to = s->kernels + at;
            for (int k = 0; k < 2; k++) {
                const struct bound_wave b = along_line(s->w[p], s->w[q], k ? -1 : 1, g, h);
                const double count = p == q ? 0.5 : 1.0;
                to->eta[k] = (float)(count * b.eta);
                for (int j = 0; j < LEVELS; j++) {
                    double c, d;
                    decay(b.K, level[j], h, &c, &d);
                    to->along[k][j] = (float)(count * b.u * c);
                    to->up[k][j] = (float)(count * b.w * d);
                }
            }
        }
}

/* --- interpolation --- */

/* Four of n places 0, 1, .. about x. */
static struct share cubic_share(double x, int n)
{
    const double first = fmin(fmax(floor(x) - 1.0, 0.0), n - 4.0);
    struct share is = {.first = (int)first};
    wave_table_cubic(x - first - 1.0, is.weight);
    return is;
}

/* All components as they are where they are few; else FREQUENCIES equidistant ones, between which
 * kernels, being smooth, are interpolated by cubics. */
static void choose_frequencies(struct second_order *s)
{
    const struct wave_component *of = s->of;
    const bool all = s->ncomponents <= FREQUENCIES;
    const double gap = (of[s->ncomponents - 1].w - of[0].w) / (FREQUENCIES - 1);
    for (int p = 0; p < s->n; p++)
        s->w[p] = all ? of[p].w : of[0].w + p * gap;
    for (int i = 0; i < s->ncomponents; i++)
        if (all)
            s->shares[i] = (struct share){i, {1.0}};
        else
            s->shares[i] = cubic_share((of[i].w - of[0].w) / gap, s->n);
}

/* The mean of the differences: what each component makes with itself. Only pairs of a component
 * with itself: those of different ones oscillate, slowly, and are what makes groups set down the
 * level. own[] holds one component's shares, so the loop over pairs finds its few. */
static void find_mean(struct second_order *s)
{
    for (int i = 0; i < s->ncomponents; i++) {
        const struct share *is = s->shares + i;
        double own[FREQUENCIES] = {0.0};
        for (int k = 0; k < 4 && is->first + k < s->n; k++)
            own[is->first + k] = s->of[i].a * is->weight[k];
        for (int p = 0, at = 0; p < s->n; p++)
            for (int q = p; q < s->n; q++, at++) {
                if (own[p] == 0.0 || own[q] == 0.0)
                    continue;
                s->mean[0] += own[p] * own[q] * (double)s->kernels[at].eta[1];
                for (int j = 0; j < LEVELS; j++)
                    s->mean[1 + j] += own[p] * own[q] * (double)s->kernels[at].along[1][j];
            }
    }
}

/* Cost of a column: npairs (2 + 4 LEVELS) products, whatever the number of components. */
struct second_order *second_order_create(int n, const struct wave_component *of, double g,
                                         double depth, const double *nodes, bool mean)
{
    struct second_order *s = NEW(struct second_order, 1);
    double level[LEVELS];
    s->ncomponents = n;
    s->n = n < FREQUENCIES ? n : FREQUENCIES;
    s->npairs = s->n * (s->n + 1) / 2;
    s->of = NEW_IN(s, struct wave_component, n);
    memcpy(s->of, of, (size_t)n * sizeof *of);
    s->shares = NEW_IN(s, struct share, n);
    s->w = NEW_IN(s, double, s->n);
    s->kernels = NEW_IN(s, struct kernel, s->npairs);
    s->e = NEW_IN(s, double complex, n);
    s->step = NEW_IN(s, double complex, n);
    s->E = mem_new_in(s, (size_t)s->n, sizeof *s->E);
    for (int j = 0; j < LEVELS; j++) {
        const double at = (double)j / (LEVELS - 1); /* nodes close up towards the surface */
        level[j] = nodes[WAVE_NODES - 1] * at * at;
    }
    for (int j = 0; j < WAVE_NODES; j++)
        s->node[j] = cubic_share(sqrt(nodes[j] / nodes[WAVE_NODES - 1]) * (LEVELS - 1), LEVELS);
    choose_frequencies(s);
    make_kernels(s, g, depth, level);
    if (!mean)
        find_mean(s);
    return s;
}

int second_order_frequencies(const struct second_order *s) { return s->n; }

double second_order_products(const struct second_order *s)
{
    return 4.0 * s->npairs * (LEVELS + 1) + 20.0 * s->ncomponents;
}

/* --- columns --- */

/* e: the components at x; step: from one column to the next, which saves a cosine each. */
static void begin_row(struct second_order *s, double t, double x, double gap)
{
    for (int i = 0; i < s->ncomponents; i++) {
        const struct wave_component *c = s->of + i;
        s->e[i] = c->a * cexp(I * (c->k * x - c->w * t + c->phase));
        s->step[i] = cexp(I * (c->k * gap));
    }
}

/* E of the next columns: one complex product turns a component from each to the one after it. */
static void next_columns(struct second_order *s)
{
    memset(s->E, 0, (size_t)s->n * sizeof *s->E);
    for (int i = 0; i < s->ncomponents; i++) {
        const struct share *is = s->shares + i;
        float re[COLUMNS], im[COLUMNS];
        for (int c = 0; c < COLUMNS; c++, s->e[i] *= s->step[i]) {
            re[c] = (float)creal(s->e[i]);
            im[c] = (float)cimag(s->e[i]);
        }
        for (int k = 0; k < 4 && is->first + k < s->n; k++) {
            const float weight = (float)is->weight[k];
            for (int c = 0; c < COLUMNS; c++) {
                s->E[is->first + k][0][c] += weight * re[c];
                s->E[is->first + k][1][c] += weight * im[c];
            }
        }
    }
}

/* What pairs make in COLUMNS columns. */
struct bound_columns {
    float eta[COLUMNS], along[LEVELS][COLUMNS], up[LEVELS][COLUMNS];
};

/* Sums cos (of the level and the velocity along) and sin (of the velocity up) of one pair, by the
 * parts of E_p E_q and E_p E_q*. */
static void add_pair(const struct kernel *k, float (*p)[COLUMNS], float (*q)[COLUMNS],
                     struct bound_columns *restrict to)
{
    float sum[2][COLUMNS], less[2][COLUMNS];
    for (int c = 0; c < COLUMNS; c++) {
        sum[0][c] = p[0][c] * q[0][c] - p[1][c] * q[1][c];
        sum[1][c] = p[1][c] * q[0][c] + p[0][c] * q[1][c];
        less[0][c] = p[0][c] * q[0][c] + p[1][c] * q[1][c];
        less[1][c] = p[1][c] * q[0][c] - p[0][c] * q[1][c];
        to->eta[c] += k->eta[0] * sum[0][c] + k->eta[1] * less[0][c];
    }
    for (int j = 0; j < LEVELS; j++)
        for (int c = 0; c < COLUMNS; c++) {
            to->along[j][c] += k->along[0][j] * sum[0][c] + k->along[1][j] * less[0][c];
            to->up[j][c] += k->up[0][j] * sum[1][c] + k->up[1][j] * less[1][c];
        }
}

/* From LEVELS heights of column c by cubics to the nodes. */
static void add_column(const struct second_order *s, const struct bound_columns *is, int c,
                       double *eta, double *u)
{
    *eta += (double)is->eta[c] - s->mean[0];
    for (int i = 0; i < WAVE_NODES; i++)
        for (int k = 0; k < 4; k++) {
            const int j = s->node[i].first + k;
            u[2 * i] += s->node[i].weight[k] * ((double)is->along[j][c] - s->mean[1 + j]);
            u[2 * i + 1] += s->node[i].weight[k] * (double)is->up[j][c];
        }
}

/* Pairs in the order of the kernels, p <= q. */
void second_order_add(struct second_order *s, double t, double x, double gap, int n, double *eta,
                      double *u)
{
    begin_row(s, t, x, gap);
    for (int i = 0; i < n; i += COLUMNS) {
        struct bound_columns is = {.eta = {0.0F}};
        const struct kernel *k = s->kernels;
        next_columns(s);
        for (int p = 0; p < s->n; p++)
            for (int q = p; q < s->n; q++)
                add_pair(k++, s->E[p], s->E[q], &is);
        for (int c = 0; c < COLUMNS && i + c < n; c++)
            add_column(s, &is, c, eta + i + c, u + (ptrdiff_t)(i + c) * 2 * WAVE_NODES);
    }
}

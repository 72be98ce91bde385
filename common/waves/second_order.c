/* second_order.c - see second_order.h. Components are shared out to at most FREQUENCIES
 * frequencies: E_p = sum over i of L_p(w_i) a_i e^(i th_i), L_p cubic; what pairs make is then
 * sum over p, q of kernel_pq Re(E_p E_q) and Re(E_p E_q*). SPDX-License-Identifier: BSD-3-Clause */
#include "second_order.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "../base/base.h"
#include "imposed_waves.h"

enum { FREQUENCIES = 40, LEVELS = 16 };

/* Of p <= q, halves and both orders counted: what the sum and the difference of their phases make
 * of the level and of the velocities along and up at the levels. */
struct kernel {
    double eta[2], along[2][LEVELS], up[2][LEVELS];
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
    double mean[1 + LEVELS]; /* level and velocities to be taken out */
    double complex *E, *pairs;
};

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
                to->eta[k] = count * b.eta;
                for (int j = 0; j < LEVELS; j++) {
                    double c, d;
                    decay(b.K, level[j], h, &c, &d);
                    to->along[k][j] = count * b.u * c;
                    to->up[k][j] = count * b.w * d;
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
                s->mean[0] += own[p] * own[q] * s->kernels[at].eta[1];
                for (int j = 0; j < LEVELS; j++)
                    s->mean[1 + j] += own[p] * own[q] * s->kernels[at].along[1][j];
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
    s->of = NEW(struct wave_component, n);
    memcpy(s->of, of, (size_t)n * sizeof *of);
    s->shares = NEW(struct share, n);
    s->w = NEW(double, s->n);
    s->kernels = NEW(struct kernel, s->npairs);
    s->E = NEW(double complex, s->n);
    s->pairs = NEW(double complex, (size_t)s->npairs * 2);
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

void second_order_free(struct second_order **s)
{
    if (!*s)
        return;
    FREE((*s)->of, (*s)->shares, (*s)->w, (*s)->kernels, (*s)->E, (*s)->pairs, *s);
    *s = NULL;
}

int second_order_frequencies(const struct second_order *s) { return s->n; }

double second_order_products(const struct second_order *s)
{
    return 4.0 * s->npairs * (LEVELS + 1) + 200.0 * s->ncomponents;
}

/* --- a column --- */

/* E_p E_q and E_p E_q*. Pairs in the order of the kernels, p <= q. */
static void make_pairs(struct second_order *s, double x, double t)
{
    for (int p = 0; p < s->n; p++)
        s->E[p] = 0.0;
    for (int i = 0; i < s->ncomponents; i++) {
        const struct wave_component *c = s->of + i;
        const struct share *is = s->shares + i;
        const double complex e = c->a * cexp(I * (c->k * x - c->w * t + c->phase));
        for (int k = 0; k < 4 && is->first + k < s->n; k++)
            s->E[is->first + k] += is->weight[k] * e;
    }
    double complex *to = s->pairs;
    for (int p = 0; p < s->n; p++)
        for (int q = p; q < s->n; q++) {
            *to++ = s->E[p] * s->E[q];
            *to++ = s->E[p] * conj(s->E[q]);
        }
}

/* Sums cos (of the level and the velocity along) and sin (of the velocity up) of each pair, at
 * LEVELS heights, then cubics to the nodes. */
void second_order_add(struct second_order *s, double x, double t, double *eta, double *u)
{
    double along[LEVELS], up[LEVELS] = {0.0};
    make_pairs(s, x, t);
    *eta -= s->mean[0];
    for (int j = 0; j < LEVELS; j++)
        along[j] = -s->mean[1 + j];
    for (int at = 0; at < s->npairs; at++) {
        const struct kernel *k = s->kernels + at;
        const double complex sum = s->pairs[2 * at], less = s->pairs[2 * at + 1];
        const double c[2] = {creal(sum), creal(less)}, d[2] = {cimag(sum), cimag(less)};
        *eta += k->eta[0] * c[0] + k->eta[1] * c[1];
        for (int j = 0; j < LEVELS; j++) {
            along[j] += k->along[0][j] * c[0] + k->along[1][j] * c[1];
            up[j] += k->up[0][j] * d[0] + k->up[1][j] * d[1];
        }
    }
    for (int i = 0; i < WAVE_NODES; i++)
        for (int k = 0; k < 4; k++) {
            u[2 * i] += s->node[i].weight[k] * along[s->node[i].first + k];
            u[2 * i + 1] += s->node[i].weight[k] * up[s->node[i].first + k];
        }
}

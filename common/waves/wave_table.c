/* wave_table.c - see wave_table.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_table.h"

#include <math.h>
#include <string.h>

#include "../base/mem.h"

struct wave_table wave_table_create(int n, double first, double gap, double reach)
{
    return (struct wave_table){.n = n,
                               .first = first,
                               .gap = gap,
                               .reach = reach,
                               .eta = NEW(double, n),
                               .u = NEW(double, (size_t)n *WAVE_NODES * 2)};
}

void wave_table_free(struct wave_table *t)
{
    mem_free(t->eta);
    mem_free(t->u);
    *t = (struct wave_table){.n = 0};
}

/* From 0 on the surface to -1. */
static double sigma(int node) { return 0.5 * (cos(M_PI * node / (WAVE_NODES - 1)) - 1.0); }

double wave_table_height(const struct wave_table *t, int column, int node)
{
    const double top = t->flat ? 0.0 : t->eta[column];
    return top + sigma(node) * (top + t->reach);
}

void wave_table_blend(struct wave_table *to, int n, const struct wave_table *of,
                      const double *weight)
{
    const size_t values = (size_t)to->n * WAVE_NODES * 2;
    memset(to->eta, 0, (size_t)to->n * sizeof *to->eta);
    memset(to->u, 0, values * sizeof *to->u);
    for (int k = 0; k < n; k++) {
        for (int i = 0; i < to->n; i++)
            to->eta[i] += weight[k] * of[k].eta[i];
        for (size_t i = 0; i < values; i++)
            to->u[i] += weight[k] * of[k].u[i];
    }
}

/* The four columns about x and their weights. */
static void columns(const struct wave_table *t, double x, int column[4], double weight[4])
{
    const double at = (x - t->first) / t->gap;
    const double lowest = t->periodic ? floor(at) : fmin(fmax(floor(at), 1.0), t->n - 3.0);
    const double s = t->periodic ? at - lowest : fmin(fmax(at - lowest, -1.0), 2.0);
    const int shift = (int)fmod(lowest, t->n);
    for (int k = 0; k < 4; k++) {
        const int c = shift + k - 1;
        column[k] = t->periodic ? ((c % t->n) + t->n) % t->n : c;
    }
    weight[0] = -s * (s - 1.0) * (s - 2.0) / 6.0;
    weight[1] = (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0;
    weight[2] = -(s + 1.0) * s * (s - 2.0) / 2.0;
    weight[3] = (s + 1.0) * s * (s - 1.0) / 6.0;
}

double wave_table_eta(const struct wave_table *t, double x)
{
    int column[4];
    double weight[4], eta = 0.0;
    columns(t, x, column, weight);
    for (int k = 0; k < 4; k++)
        eta += weight[k] * t->eta[column[k]];
    return eta;
}

/* Weights of the nodes at sigma s, which sum to 1: barycentric formula of the second kind. */
static void nodes(double s, double weight[WAVE_NODES])
{
    double sum = 0.0;
    for (int i = 0; i < WAVE_NODES; i++) {
        const double d = s - sigma(i);
        if (fabs(d) < 1e-12) {
            memset(weight, 0, WAVE_NODES * sizeof *weight);
            weight[i] = 1.0;
            return;
        }
        weight[i] = (i % 2 ? -1.0 : 1.0) * (i == 0 || i == WAVE_NODES - 1 ? 0.5 : 1.0) / d;
        sum += weight[i];
    }
    for (int i = 0; i < WAVE_NODES; i++)
        weight[i] /= sum;
}

void wave_table_velocity(const struct wave_table *t, double x, double z, double u[2])
{
    int column[4];
    double across[4], along[WAVE_NODES], top = 0.0;
    columns(t, x, column, across);
    for (int k = 0; k < 4 && !t->flat; k++)
        top += across[k] * t->eta[column[k]];
    nodes(fmin(fmax((z - top) / (top + t->reach), -1.0), 0.0), along);
    u[0] = u[1] = 0.0;
    for (int k = 0; k < 4; k++) {
        const double *q = t->u + (size_t)column[k] * WAVE_NODES * 2;
        for (int i = 0; i < WAVE_NODES; i++) {
            u[0] += across[k] * along[i] * q[2 * i];
            u[1] += across[k] * along[i] * q[2 * i + 1];
        }
    }
    if (z < -t->reach && t->decay > 0.0) {
        const double left = exp(t->decay * (z + t->reach));
        u[0] *= left;
        u[1] *= left;
    }
}

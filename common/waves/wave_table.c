/* wave_table.c - see wave_table.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_table.h"

#include <math.h>
#include <string.h>

#include "../base/mem.h"

struct wave_table wave_table_create(int n, double first, double gap, double reach, bool slope)
{
    return (struct wave_table){.n = n,
                               .first = first,
                               .gap = gap,
                               .reach = reach,
                               .eta = NEW(double, n),
                               .u = NEW(double, (size_t)n *WAVE_NODES * 2),
                               .slope = slope ? NEW(double, (size_t)n * 2) : NULL};
}

void wave_table_free(struct wave_table *t)
{
    mem_free(t->eta);
    mem_free(t->u);
    mem_free(t->slope);
    *t = (struct wave_table){.n = 0};
}

/* From 0 on the surface to -1. */
static double sigma(const struct wave_table *t, int node)
{
    const double s = (double)node / (WAVE_NODES - 1);
    return t->flat ? -s * s : -s;
}

double wave_table_height(const struct wave_table *t, int column, int node)
{
    const double top = t->flat ? 0.0 : t->eta[column];
    return top + sigma(t, node) * (top + t->reach);
}

void wave_table_blend(struct wave_table *to, int n, const struct wave_table *of,
                      const double *weight)
{
    const size_t values = (size_t)to->n * WAVE_NODES * 2;
    memset(to->eta, 0, (size_t)to->n * sizeof *to->eta);
    memset(to->u, 0, values * sizeof *to->u);
    if (to->slope)
        memset(to->slope, 0, (size_t)to->n * 2 * sizeof *to->slope);
    for (int k = 0; k < n; k++) {
        for (int i = 0; i < to->n; i++)
            to->eta[i] += weight[k] * of[k].eta[i];
        for (size_t i = 0; i < values; i++)
            to->u[i] += weight[k] * of[k].u[i];
        for (int i = 0; i < 2 * to->n && to->slope; i++)
            to->slope[i] += weight[k] * of[k].slope[i];
    }
}

/* Weights of four places a step apart, of which the second and the third are about s = 0 .. 1. */
static void cubic(double s, double weight[4])
{
    weight[0] = -s * (s - 1.0) * (s - 2.0) / 6.0;
    weight[1] = (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0;
    weight[2] = -(s + 1.0) * s * (s - 2.0) / 2.0;
    weight[3] = (s + 1.0) * s * (s - 1.0) / 6.0;
}

/* The four columns about x and their weights. */
static void columns(const struct wave_table *t, double x, int column[4], double weight[4])
{
    const double at = (x - t->first) / t->gap;
    const double lowest = t->periodic ? floor(at) : fmin(fmax(floor(at), 1.0), t->n - 3.0);
    const double s = t->periodic ? at - lowest : fmin(fmax(at - lowest, -1.0), 2.0);
    int c = (int)(t->periodic ? lowest - t->n * floor(lowest / t->n) : lowest) - 1;
    for (int k = 0; k < 4; k++, c++)
        column[k] = !t->periodic ? c : c < 0 ? c + t->n : c >= t->n ? c - t->n : c;
    cubic(s, weight);
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

void wave_table_velocity(const struct wave_table *t, double x, double z, double u[2])
{
    int column[4];
    double across[4], along[4], eta = 0.0;
    columns(t, x, column, across);
    for (int k = 0; k < 4 && (!t->flat || t->slope); k++)
        eta += across[k] * t->eta[column[k]];
    const double top = t->flat ? 0.0 : eta, over = t->slope ? fmin(z, eta) : 0.0;
    const double share = fmin(fmax((top - (t->slope ? over : z)) / (top + t->reach), 0.0), 1.0),
                 down = (t->flat ? sqrt(share) : share) * (WAVE_NODES - 1);
    const int node = (int)fmin(fmax(floor(down), 1.0), WAVE_NODES - 3.0);
    cubic(down - node, along);
    u[0] = u[1] = 0.0;
    for (int k = 0; k < 4; k++) {
        const double *q = t->u + ((size_t)column[k] * WAVE_NODES + (size_t)(node - 1)) * 2;
        for (int i = 0; i < 4; i++) {
            const double w = across[k] * along[i];
            u[0] += w * q[2 * i];
            u[1] += w * q[2 * i + 1];
        }
    }
    for (int k = 0; k < 4 && over > 0.0; k++)
        for (int a = 0; a < 2; a++)
            u[a] += across[k] * over * t->slope[2 * column[k] + a];
    if (z < -t->reach && t->decay > 0.0) {
        const double left = exp(t->decay * (z + t->reach));
        u[0] *= left;
        u[1] *= left;
    }
}

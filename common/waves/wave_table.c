/* wave_table.c - see wave_table.h. Weights of four columns (of a plane sixteen) times weights of
 * four nodes: 16 or 64 values make a velocity, whatever made the waves. The same nodes are taken in
 * all columns about a place, as heights relative to the surface there.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_table.h"

#include "../base/base.h"

/* Several rows have a third component, across. */
struct wave_table wave_table_create(void *owner, int n, int rows, double gap, double reach,
                                    bool slope)
{
    const int parts = rows > 1 ? 3 : 2;
    const size_t columns = (size_t)n * (size_t)rows;
    return (struct wave_table){.n = n,
                               .rows = rows,
                               .parts = parts,
                               .gap = gap,
                               .reach = reach,
                               .eta = NEW_IN(owner, double, columns),
                               .u = NEW_IN(owner, double, columns *WAVE_NODES *(size_t)parts),
                               .slope = slope ? NEW_IN(owner, double, columns * 2) : NULL};
}

/* From 0 on the surface to -1. */
static double sigma(const struct wave_table *t, int node)
{
    const double s = (double)node / (WAVE_NODES - 1);
    return t->flat ? -s * s : -s;
}

/* Layered: WAVE_UPPER nodes equally spaced from the surface to `still', then the others below it,
 * closer near it (s^2). Else equally spaced, or of a flat table s^2 from the still level. */
double wave_table_height(const struct wave_table *t, int column, int node)
{
    if (t->still > 0.0 && node >= WAVE_UPPER) {
        const double s = (double)(node - WAVE_UPPER + 1) / (WAVE_NODES - WAVE_UPPER);
        return -t->still - (t->reach - t->still) * s * s;
    }
    if (t->still > 0.0)
        return t->eta[column] - (t->eta[column] + t->still) * node / (WAVE_UPPER - 1);
    const double top = t->flat ? 0.0 : t->eta[column];
    return top + sigma(t, node) * (top + t->reach);
}

/* All tables are of one shape. */
void wave_table_blend(struct wave_table *to, int n, const struct wave_table *of,
                      const double *weight)
{
    const size_t all = (size_t)to->n * (size_t)to->rows,
                 values = all * WAVE_NODES * (size_t)to->parts;
    memset(to->eta, 0, all * sizeof *to->eta);
    memset(to->u, 0, values * sizeof *to->u);
    if (to->slope)
        memset(to->slope, 0, all * 2 * sizeof *to->slope);
    for (int k = 0; k < n; k++) {
        for (size_t i = 0; i < all; i++)
            to->eta[i] += weight[k] * of[k].eta[i];
        for (size_t i = 0; i < values; i++)
            to->u[i] += weight[k] * of[k].u[i];
        for (size_t i = 0; i < 2 * all && to->slope; i++)
            to->slope[i] += weight[k] * of[k].slope[i];
    }
}

/* Lagrange on -1, 0, 1, 2 at s. */
void wave_table_cubic(double s, double weight[4])
{
    weight[0] = -s * (s - 1.0) * (s - 2.0) / 6.0;
    weight[1] = (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0;
    weight[2] = -(s + 1.0) * s * (s - 2.0) / 2.0;
    weight[3] = (s + 1.0) * s * (s - 1.0) / 6.0;
}

/* Columns about a place and their weights. */
struct about {
    int n; /* 4, of several rows 16 */
    int column[16];
    double weight[16];
};

/* The four columns of a row about x. Beyond the ends of a table that is not periodic s is held at
 * -1 or 2, that is at the end column itself. */
static void along_row(const struct wave_table *t, double x, int column[4], double weight[4])
{
    const double at = (x - t->first) / t->gap;
    const double lowest = t->periodic ? floor(at) : lesser(greater(floor(at), 1.0), t->n - 3.0);
    const double s = t->periodic ? at - lowest : lesser(greater(at - lowest, -1.0), 2.0);
    int c = (int)(t->periodic ? lowest - t->n * floor(lowest / t->n) : lowest) - 1;
    for (int k = 0; k < 4; k++, c++)
        column[k] = !t->periodic ? c : c < 0 ? c + t->n : c >= t->n ? c - t->n : c;
    wave_table_cubic(s, weight);
}

/* Along a line four columns, on a plane sixteen; beyond its edge the last ones. */
static void columns_about(const struct wave_table *t, double x, double y, struct about *a)
{
    a->n = 4;
    along_row(t, x, a->column, a->weight);
    if (t->rows == 1)
        return;
    const double at = (y - t->first_row) / t->gap,
                 lowest = lesser(greater(floor(at), 1.0), t->rows - 3);
    double across[4], along[4];
    int column[4];
    memcpy(along, a->weight, sizeof along);
    memcpy(column, a->column, sizeof column);
    wave_table_cubic(lesser(greater(at - lowest, -1.0), 2.0), across);
    a->n = 16;
    for (int k = 0; k < 16; k++) {
        a->column[k] = column[k % 4] + t->n * ((int)lowest - 1 + k / 4);
        a->weight[k] = along[k % 4] * across[k / 4];
    }
}

static double eta_of(const struct wave_table *t, const struct about *a)
{
    double eta = 0.0;
    for (int k = 0; k < a->n; k++)
        eta += a->weight[k] * t->eta[a->column[k]];
    return eta;
}

double wave_table_eta(const struct wave_table *t, double x, double y)
{
    struct about a;
    columns_about(t, x, y, &a);
    return eta_of(t, &a);
}

/* As nodes_about; four nodes are all above the level of a layered table or all below it. */
static int layered_nodes_about(const struct wave_table *t, double top, double z, double weight[4])
{
    const bool upper = z > -t->still;
    const double share = upper ? greater(top - z, 0.0) / (top + t->still)
                               : lesser((-t->still - z) / (t->reach - t->still), 1.0),
                 down = upper ? share * (WAVE_UPPER - 1)
                              : WAVE_UPPER - 1 + sqrt(share) * (WAVE_NODES - WAVE_UPPER);
    const double first = upper ? 1.0 : WAVE_UPPER, last = (upper ? WAVE_UPPER : WAVE_NODES) - 3.0;
    const int node = (int)lesser(greater(floor(down), first), last);
    wave_table_cubic(down - node, weight);
    return node - 1;
}

/* Nodes from the surface on to z; the four about it begin with `node'. The inverse of
 * wave_table_height. */
static int nodes_about(const struct wave_table *t, double top, double z, double weight[4])
{
    if (t->still > 0.0)
        return layered_nodes_about(t, top, z, weight);
    const double share = lesser(greater((top - z) / (top + t->reach), 0.0), 1.0),
                 down = (t->flat ? sqrt(share) : share) * (WAVE_NODES - 1);
    const int node = (int)lesser(greater(floor(down), 1.0), WAVE_NODES - 3.0);
    wave_table_cubic(down - node, weight);
    return node - 1;
}

/* parts is a constant of each caller. */
INLINE void sum_nodes(const struct wave_table *t, const struct about *at, int node,
                      const double along[4], const int parts, double *u)
{
    for (int k = 0; k < at->n; k++) {
        const double *q =
            t->u + ((size_t)at->column[k] * WAVE_NODES + (size_t)node) * (size_t)parts;
        double sum[3] = {0.0, 0.0, 0.0}; /* of the column: a third of the products */
        for (int i = 0; i < 4; i++)
            for (int a = 0; a < parts; a++)
                sum[a] += along[i] * q[parts * i + a];
        for (int a = 0; a < parts; a++)
            u[a] += at->weight[k] * sum[a];
    }
}

/* From the columns `at', where the level is `eta'. Of order 2 (slope): above the still level u(0) +
 * z du/dz up to the surface, as the expansion has it; deeper than `reach' velocities die away with
 * the longest wave's exponential. */
static void velocity_of(const struct wave_table *t, const struct about *at, double eta, double z,
                        double u[3])
{
    double along[4];
    const double top = t->flat ? 0.0 : eta, over = t->slope ? lesser(z, eta) : 0.0;
    const int node = nodes_about(t, top, t->slope ? over : z, along);
    u[0] = u[1] = u[2] = 0.0;
    if (t->parts == 2)
        sum_nodes(t, at, node, along, 2, u);
    else
        sum_nodes(t, at, node, along, 3, u);
    for (int k = 0; k < at->n && over > 0.0; k++)
        for (int a = 0; a < 2; a++)
            u[a] += at->weight[k] * over * t->slope[2 * at->column[k] + a];
    const double left = z < -t->reach && t->decay > 0.0 ? exp(t->decay * (z + t->reach)) : 1.0;
    for (int a = 0; a < 3; a++)
        u[a] *= left;
}

void wave_table_velocity(const struct wave_table *t, double x, double y, double z, double u[3])
{
    struct about at;
    columns_about(t, x, y, &at);
    velocity_of(t, &at, !t->flat || t->slope ? eta_of(t, &at) : 0.0, z, u);
}

void wave_table_column(const struct wave_table *t, double x, double y, struct wave_column *to)
{
    struct about at;
    const int values = WAVE_NODES * t->parts;
    columns_about(t, x, y, &at);
    to->is = *t;
    to->is.u = to->u;
    to->is.slope = t->slope ? to->slope : NULL;
    to->eta = eta_of(t, &at);
    memset(to->u, 0, sizeof to->u);
    memset(to->slope, 0, sizeof to->slope);
    for (int k = 0; k < at.n; k++) {
        const double *q = t->u + at.column[k] * values;
        for (int i = 0; i < values; i++)
            to->u[i] += at.weight[k] * q[i];
        for (int a = 0; a < 2 && t->slope; a++)
            to->slope[a] += at.weight[k] * t->slope[2 * at.column[k] + a];
    }
}

void wave_column_velocity(const struct wave_column *c, double z, double u[3])
{
    static const struct about itself = {.n = 1, .weight = {1.0}};
    velocity_of(&c->is, &itself, c->eta, z, u);
}

/* wall_share.c - see wall_share.h. SPDX-License-Identifier: BSD-3-Clause
 *
 * Pairs beside walls lack what the walls cut off: at a constant pressure their sum is 2 P w times
 * sum_b W_b n_b, each wall's part along its own normal. So where a body meets another wall the
 * force is taken apart into these directions. By the parts of gamma alone a block on the floor, wet
 * at its sides, got a tenth of the water's weight beside it as a lift. */
#include "wall_share.h"

#include <math.h>
#include <string.h>

#include "forces.h"

enum { GROUPS = 4 };

/* What belongs to one body (-1: walls at rest). */
struct group {
    int body;
    double S[3], gamma, factor;
};

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Later ones than GROUPS go with the first. */
static int find_groups(const struct wall_list *l, int k, int dim, struct group *g)
{
    int n = 0;
    for (const struct wall_touch *t = l->touch + l->first[k]; t < l->touch + l->first[k + 1]; t++) {
        int at = 0;
        if (t->is.W == 0.0)
            continue;
        while (at < n && g[at].body != t->body)
            at++;
        if (at == n && n < GROUPS)
            g[n++] = (struct group){.body = t->body};
        at = at < n ? at : 0;
        for (int a = 0; a < dim; a++)
            g[at].S[a] += t->is.W * t->n[a];
        g[at].gamma += fabs(t->is.gamma);
    }
    return n;
}

/* Gauss without pivots: the matrix is symmetric and definite. */
static void solve(double A[GROUPS][GROUPS], int n, double *b)
{
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++) {
            const double f = A[j][i] / A[i][i];
            for (int c = i; c < n; c++)
                A[j][c] -= f * A[i][c];
            b[j] -= f * b[i];
        }
    for (int i = n - 1; i >= 0; i--) {
        for (int c = i + 1; c < n; c++)
            b[i] -= A[i][c] * b[c];
        b[i] /= A[i][i];
    }
}

/* Factors of the S that make up V, drawn to one for all: so they are where walls are parallel, and
 * where one has just come into the support. */
static void find_factors(struct group *g, int n, const double *V)
{
    const double drawn = 0.1;
    double A[GROUPS][GROUPS], b[GROUPS], S[3] = {0.0, 0.0, 0.0}, largest = 0.0;
    for (int i = 0; i < n; i++) {
        largest = fmax(largest, dot(g[i].S, g[i].S));
        for (int a = 0; a < 3; a++)
            S[a] += g[i].S[a];
    }
    const double size = drawn * largest + 1e-300;
    const double one = dot(S, S) > 0.0 ? dot(S, V) / dot(S, S) : 0.0;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            A[i][j] = dot(g[i].S, g[j].S) + (i == j ? size : 0.0);
        b[i] = dot(g[i].S, V) + size * one;
    }
    solve(A, n, b);
    for (int i = 0; i < n; i++)
        g[i].factor = b[i];
}

void wall_share_out(const struct sph *s, const struct wall_list *l, int k, const double *x,
                    const double *lost)
{
    struct group g[GROUPS];
    double V[3] = {0.0, 0.0, 0.0}, rest[3], gammas = 0.0;
    const int n = find_groups(l, k, s->dim, g);
    memcpy(V, lost, (size_t)s->dim * sizeof *V);
    if (n == 1)
        forces_add(s, g[0].body, x, V);
    if (n < 2)
        return;
    find_factors(g, n, V);
    memcpy(rest, V, sizeof rest);
    for (int i = 0; i < n; i++) {
        gammas += g[i].gamma;
        for (int a = 0; a < 3; a++)
            rest[a] -= g[i].factor * g[i].S[a];
    }
    for (int i = 0; i < n; i++) {
        double force[3];
        for (int a = 0; a < 3; a++)
            force[a] =
                g[i].factor * g[i].S[a] + rest[a] * (gammas > 0.0 ? g[i].gamma / gammas : 1.0 / n);
        forces_add(s, g[i].body, x, force);
    }
}

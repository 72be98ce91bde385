/* even_value.c - value of a field at a place in uniform cells or layers: the polynomial that has
 * the averages of three or four cells along each axis, of fluid all of them, so that it is of
 * fourth order up to walls and boxes, and does not see what has been extrapolated into the air.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "even_value.h"

#include "../boundary/blocked.h"
#include "../boundary/still.h"
#include "../surface/levelset.h"

enum { MOST = 4, LEAST_CELLS = 3 };

bool even_is_solid(const struct fv *s, const int *at)
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++)
        if (!b->periodic[a] && (b->lo[a] + at[a] < 0 || b->lo[a] + at[a] >= b->cells[a]))
            return true;
    return is_blocked(s, block_at(b, at[0], at[1], at[2]));
}

/* Whether a local cell holds fluid and is within the reach of this rank's ghosts. */
static bool is_known(const struct fv *s, const int *at)
{
    const struct block *b = &s->b;
    for (int a = 0; a < b->dim; a++)
        if (at[a] < -b->g[a] || at[a] >= b->n[a] + b->g[a])
            return false;
    if (even_is_solid(s, at))
        return false;
    return !s->surface || s->surface->layer[block_at(b, at[0], at[1], at[2])] == 0;
}

/* Weights of the averages of n cells between the edges e for the value at x: derivative of the
 * polynomial that has their sums at the edges. */
static void weigh(const double *e, int n, double x, double *w)
{
    for (int k = 0; k < n; k++)
        w[k] = 0.0;
    for (int m = 1; m <= n; m++) {
        double slope = 0.0; /* of Lagrange's polynomial of edge m */
        for (int j = 0; j <= n; j++) {
            double part = j == m ? 0.0 : 1.0 / (e[m] - e[j]);
            for (int l = 0; l <= n; l++)
                part *= l == m || l == j ? 1.0 : (x - e[l]) / (e[m] - e[l]);
            slope += part;
        }
        for (int k = 0; k < m; k++)
            w[k] += (e[k + 1] - e[k]) * slope;
    }
}

/* The cells along one axis. */
struct line_of_cells {
    int first, n;
    double w[MOST];
};

/* Known cells along axis a around `at', which is one, those nearest to x first; x counts in cells
 * from the first one of this rank on. */
static void choose(const struct fv *s, const int *at, int a, double x, struct line_of_cells *l)
{
    int low[3] = {at[0], at[1], at[2]}, high[3] = {at[0], at[1], at[2]};
    bool open[2] = {true, true};
    l->first = at[a];
    l->n = 1;
    while (l->n < MOST && (open[0] || open[1])) {
        const bool up = !open[0] || (open[1] && x - l->first > l->first + l->n - x);
        int *to = up ? high : low;
        to[a] += up ? 1 : -1;
        open[up] = is_known(s, to);
        l->first -= open[up] && !up;
        l->n += open[up];
    }
}

/* Weights of the cells chosen; layers of unequal height by their edges. */
static void weigh_line(const struct fv *s, int a, double x, double y, struct line_of_cells *l)
{
    const struct block *b = &s->b;
    double e[MOST + 1];
    const bool uneven = a == 1 && b->rows;
    for (int k = 0; k <= l->n; k++)
        e[k] = uneven ? b->rows->edge[b->lo[a] + l->first + k] : l->first + k;
    weigh(e, l->n, uneven ? y : x, l->w);
}

bool even_value(const struct fv *s, const double *q, const double *x, const int *i, const double *w,
                double *value)
{
    struct line_of_cells l[3] = {{0, 1, {1.0}}, {0, 1, {1.0}}, {0, 1, {1.0}}};
    int at[3], host[3];
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        host[a] = i[a] + (w[a] > 0.5); /* no weight beyond dim */
    if (!is_known(s, host))
        return false;
    for (int a = 0; a < s->dim; a++) {
        const double place = i[a] + w[a] + 0.5;
        choose(s, host, a, place, l + a);
        if (l[a].n < LEAST_CELLS)
            return false;
        weigh_line(s, a, place, x[a], l + a);
    }
    for (int m = 0; m < l[0].n * l[1].n * l[2].n; m++) {
        const int of[3] = {m % l[0].n, m / l[0].n % l[1].n, m / l[0].n / l[1].n};
        double f = 1.0;
        for (int a = 0; a < 3; a++) {
            at[a] = l[a].first + of[a];
            f *= l[a].w[of[a]];
        }
        if (!is_known(s, at))
            return false;
        const int64_t c = block_at(&s->b, at[0], at[1], at[2]);
        sum += f * (q ? q[c] : fv_pressure(s, c));
    }
    *value = sum;
    return true;
}

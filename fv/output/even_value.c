/* even_value.c - value of a field at a place in uniform cells or layers: the polynomial that has
 * the averages of three or four cells along each axis, of fluid all of them, so that it is of
 * fourth order up to walls and boxes, and does not see what has been extrapolated into the air.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "even_value.h"

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"

enum { MOST = 4, LEAST_CELLS = 3 };

/* Beyond closed sides counts as solid, ghosts of other ranks do not. */
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

/* The cells that x lies in: of those about it, where it is on faces, number m of up to 2^dim;
 * false: there is no such one. */
static bool host_number(const struct fv *s, const int *i, const double *w, int m, int host[3])
{
    for (int a = 0; a < 3; a++) {
        const bool on_face = a < s->dim && fabs(w[a] - 0.5) < 1e-9, up = m >> a & 1;
        if (up && !on_face)
            return false;
        host[a] = i[a] + (on_face ? up : w[a] > 0.5); /* no weight beyond dim */
    }
    return true;
}

/* A cell that holds fluid goes before one that is merely no solid; else the first. */
void even_host(const struct fv *s, const int *i, const double *w, int host[3])
{
    for (int dry = 0; dry < 2; dry++)
        for (int m = 0; m < 1 << s->dim; m++)
            if (host_number(s, i, w, m, host) &&
                (dry ? !even_is_solid(s, host) : is_known(s, host)))
                return;
    host_number(s, i, w, 0, host);
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
 * from the first one of this rank on. Around a centre three cells have what four would, and are
 * alike on both sides. */
static void choose(const struct fv *s, const int *at, int a, double x, struct line_of_cells *l)
{
    int low[3] = {at[0], at[1], at[2]}, high[3] = {at[0], at[1], at[2]};
    bool open[2] = {true, true};
    l->first = at[a];
    l->n = 1;
    while (l->n < MOST && (open[0] || open[1])) {
        const double more = (x - l->first) - (l->first + l->n - x); /* room below */
        const bool up = !open[0] || (open[1] && more > 1e-9);
        if (l->n == LEAST_CELLS && open[0] && open[1] && fabs(more) < 1e-9 &&
            !(a == 1 && s->b.rows))
            break;
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

/* The value by the cells around one that holds fluid. */
static bool value_from(const struct fv *s, const double *q, const double *x, const double *place,
                       const int *host, double *value)
{
    struct line_of_cells l[3] = {{0, 1, {1.0}}, {0, 1, {1.0}}, {0, 1, {1.0}}};
    int at[3];
    *value = 0.0;
    for (int a = 0; a < s->dim; a++) {
        choose(s, host, a, place[a], l + a);
        if (l[a].n < LEAST_CELLS)
            return false;
        weigh_line(s, a, place[a], x[a], l + a);
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
        *value += f * (q ? q[c] : fv_pressure(s, c));
    }
    return true;
}

/* On faces the mean of what the cells on both sides say, so that mirrored scenes read the same. */
bool even_value(const struct fv *s, const double *q, const double *x, const int *i, const double *w,
                double *value)
{
    int host[3], n = 0;
    double place[3], sum = 0.0, one;
    for (int a = 0; a < 3; a++)
        place[a] = i[a] + w[a] + 0.5;
    for (int m = 0; m < 1 << s->dim; m++)
        if (host_number(s, i, w, m, host) && is_known(s, host) &&
            value_from(s, q, x, place, host, &one)) {
            sum += one;
            n++;
        }
    *value = sum / fmax(n, 1.0);
    return n > 0;
}

/* outflow.c - see outflow.h. The velocity on a side is the one that stood U dt inside it at the
 * step's start, by the quadratic through the face's average and those of two cells: third order,
 * and stable at any step. SPDX-License-Identifier: BSD-3-Clause */
#include "outflow.h"

#include <math.h>
#include <stdio.h>

#include "../../common/h5.h"
#include "bc.h"
#include "forcing.h"
#include "../grid/layout.h"

/* Visits the sides of this kind: k, o. */
#define OUTFLOWS(s, o)                                                                             \
    for (int k_ = 0; (s)->bc && (s)->bc->carries && k_ < 6; k_++)                                  \
        for (struct outflow *o = (s)->bc->out[k_]; o; o = NULL)

static bool none(const struct fv *s) { return !s->bc || !s->bc->carries; }

static int64_t inwards(const struct fv *s, const struct outflow *o)
{
    return (o->side % 2 ? -1 : 1) * s->b.stride[o->side / 2];
}

/* Net flux of all sides to nothing, evenly over these; where cells are forced their fluxes are what
 * is corrected, and a given pressure lets through what is too much. */
static void balance(struct fv *s)
{
    struct bc *bc = s->bc;
    double sums[3] = {0.0, 0.0, 0.0}; /* flux, area, forced faces */
    OUTFLOWS(s, o)
    {
        const double sign = o->side % 2 ? 1.0 : -1.0;
        o->sum = 0.0;
        for (int64_t i = 0; i < o->n; i++)
            if (o->own[i]) {
                o->sum += sign * o->area[i] * bc->w[o->side][o->side / 2][o->place[i]];
                sums[1] += o->area[i];
            }
        sums[0] += o->sum;
    }
    for (int a = 0; s->forcing && a < s->b.dim; a++)
        sums[2] += (double)s->forcing->nface[a];
    bc->outflux = bc->outflux_given + sums[0];
    sums[0] = bc->outflux;
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, s->b.cart);
    if (bc->pressure_given || sums[2] > 0.0 || sums[1] == 0.0)
        return;
    const double excess = sums[0] / sums[1];
    OUTFLOWS(s, o)
    {
        const double sign = o->side % 2 ? 1.0 : -1.0;
        for (int64_t i = 0; i < o->n; i++)
            bc->w[o->side][o->side / 2][o->place[i]] -= sign * excess;
        for (int64_t i = 0; i < o->n; i++)
            bc->outflux -= o->own[i] ? excess * o->area[i] : 0.0;
    }
}

void outflow_start(struct fv *s)
{
    if (none(s))
        return;
    OUTFLOWS(s, o)
    {
        const int64_t in = inwards(s, o);
        for (int q = 0; q < s->b.dim; q++)
            for (int64_t i = 0; i < o->n; i++) {
                const double *u = s->u[q] + o->cell[i];
                s->bc->w[o->side][q][o->place[i]] =
                    (11.0 * u[0] - 7.0 * u[in] + 2.0 * u[2 * in]) / 6.0;
                o->change[q][o->place[i]] = 0.0;
            }
    }
    balance(s);
}

/* Averages over the first two cells: w + b/2 + c/3 and w + 3 b/2 + 7 c/3. */
static void take_lines(const struct fv *s, struct outflow *o)
{
    const int64_t in = inwards(s, o);
    for (int q = 0; q < s->b.dim; q++)
        for (int64_t i = 0; i < o->n; i++) {
            const double w = s->bc->w[o->side][q][o->place[i]], *u = s->u[q] + o->cell[i];
            double *line = o->line[q] + 3 * i;
            line[0] = w;
            line[2] = 0.75 * (u[in] - 3.0 * u[0] + 2.0 * w);
            line[1] = u[in] - u[0] - 2.0 * line[2];
        }
}

void outflow_begin(struct fv *s)
{
    double sums[2][6] = {{0.0}};
    if (none(s))
        return;
    OUTFLOWS(s, o)
    {
        const double *w = s->bc->w[o->side][o->side / 2];
        for (int64_t i = 0; i < o->n; i++)
            if (o->own[i]) {
                sums[0][o->side] += (o->side % 2 ? o->area[i] : -o->area[i]) * w[o->place[i]];
                sums[1][o->side] += o->area[i];
            }
        take_lines(s, o);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 12, MPI_DOUBLE, MPI_SUM, s->b.cart);
    OUTFLOWS(s, o)
    {
        const int last = o->side % 2 ? s->b.n[1] - 1 : 0; /* a row, if it is a side along y */
        o->carried = fmax(sums[0][o->side] / fmax(sums[1][o->side], 1e-300), 0.0) /
                     block_size(&s->b, o->side / 2, last);
    }
}

void outflow_set(struct fv *s, double dt)
{
    if (none(s))
        return;
    OUTFLOWS(s, o)
    {
        const double x = fmin(o->carried * dt, 1.5); /* the line ends at 2 */
        for (int q = 0; q < s->b.dim; q++)
            for (int64_t i = 0; i < o->n; i++) {
                const double *line = o->line[q] + 3 * i;
                double *w = s->bc->w[o->side][q] + o->place[i];
                o->change[q][o->place[i]] = -*w;
                *w = line[0] + x * (line[1] + x * line[2]);
            }
    }
    balance(s);
    OUTFLOWS(s, o)
    for (int q = 0; q < s->b.dim; q++)
        for (int64_t i = 0; i < o->n; i++)
            o->change[q][o->place[i]] += s->bc->w[o->side][q][o->place[i]];
}

/* This rank's places of a side: a box one cell thick. */
static struct box box_of(const struct fv *s, int k)
{
    struct box x = layout_block(&s->b);
    x.grid = k;
    x.lo[k / 2] = x.g[k / 2] = 0;
    x.n[k / 2] = s->bc->n[k] > 0;
    return x;
}

/* Sides that this rank does not touch count as rows of length 0. l: of another number of ranks. */
static void each(const struct fv *s, struct h5 *f, bool save, const struct layout *l, bool *good)
{
    char name[32];
    for (int k = 0; !none(s) && k < 2 * s->b.dim; k++)
        for (int q = 0; q < s->b.dim && s->bc->kind[k] == BC_CARRIED; q++) {
            double nothing = 0.0, *w = s->bc->n[k] > 0 ? s->bc->w[k][q] : &nothing;
            const struct box mine = box_of(s, k);
            snprintf(name, sizeof name, "outflow%d_%d", k, q);
            if (save)
                h5_write_real(f, name, "m/s", s->bc->n[k], 1, w, false);
            else if (l)
                *good = layout_read(l, f, name, 1, &mine, s->b.periodic, w) && *good;
            else
                *good = h5_read_real(f, name, s->bc->n[k], 1, w) && *good;
        }
}

void outflow_save(const struct fv *s, struct h5 *f)
{
    struct box side[6];
    if (none(s))
        return;
    for (int k = 0; k < 2 * s->b.dim; k++)
        side[k] = box_of(s, k);
    layout_save(f, "sides", 2 * s->b.dim, side);
    each(s, f, true, NULL, NULL);
}

bool outflow_load(struct fv *s, struct h5 *f)
{
    const bool same = layout_same_ranks(f, s->run->size);
    struct layout *l = same || none(s) ? NULL : layout_load(f, "sides");
    bool good = same || none(s) || l;
    if (good)
        each(s, f, false, l, &good);
    layout_free(&l);
    if (!none(s)) {
        s->bc->outflux = s->bc->outflux_given;
        OUTFLOWS(s, o)
        {
            const double out = o->side % 2 ? 1.0 : -1.0;
            for (int64_t i = 0; i < o->n; i++)
                if (o->own[i])
                    s->bc->outflux +=
                        out * o->area[i] * s->bc->w[o->side][o->side / 2][o->place[i]];
        }
    }
    return good;
}

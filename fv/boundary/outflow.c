/* outflow.c - see outflow.h. The velocity on a side is the one that stood U dt inside it at the
 * step's start, by the quadratic through the face's average and those of two cells: third order,
 * and stable at any step. SPDX-License-Identifier: BSD-3-Clause */
#include "outflow.h"

#include <math.h>

#include "bc.h"
#include "carried.h"
#include "forcing.h"
#include "mesh_bc.h"

/* Visits the sides of this kind: o. */
#define OUTFLOWS(s, o)                                                                             \
    for (struct outflow *o = (s)->outflows ? (s)->outflows->of : NULL;                             \
         o && o < (s)->outflows->of + (s)->outflows->n; o++)

/* Flux through these faces of this rank, and with the other sides'. */
static double sum_up(struct fv *s)
{
    double sum = 0.0;
    if (s->m)
        s->outflows->given = mesh_bc_given_flux(s);
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            sum += o->own[i] ? carried_flux(o, s->dim, i) : 0.0;
    s->outflows->all = s->outflows->given + sum;
    if (s->bc)
        s->bc->outflux = s->outflows->all;
    return s->outflows->all;
}

static bool pressure_given(const struct fv *s)
{
    return s->outflows->level_free || (s->m ? mesh_bc_pressure_given(s) : s->bc->pressure_given);
}

/* Net flux of all sides to nothing, evenly over these; where cells are forced their fluxes are what
 * is corrected, and a given pressure lets through what is too much. */
static void balance(struct fv *s)
{
    double sums[3] = {sum_up(s), 0.0, 0.0}; /* flux, area, forced faces */
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++)
            sums[1] += o->own[i] ? carried_area(o, i) : 0.0;
    for (int a = 0; s->forcing && a < s->dim; a++)
        sums[2] += (double)s->forcing->nface[a];
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, s->comm);
    if (pressure_given(s) || sums[2] > 0.0 || sums[1] == 0.0)
        return;
    const double excess = sums[0] / sums[1];
    OUTFLOWS (s, o)
        for (int64_t i = 0; i < o->n; i++) {
            const double area = carried_area(o, i);
            for (int q = 0; q < s->dim && area > 0.0; q++)
                o->w[q][o->place[i]] -= excess * (o->S[q][i] / area);
        }
    sum_up(s);
}

static void keep(struct fv *s)
{
    OUTFLOWS (s, o)
        for (int q = 0; q < s->dim; q++)
            for (int64_t i = 0; i < o->n; i++)
                s->outflows->kept[q][o->cell[i] - o->in] = o->w[q][o->place[i]];
}

void outflow_start(struct fv *s)
{
    if (!s->outflows)
        return;
    OUTFLOWS (s, o)
        for (int q = 0; q < s->dim; q++)
            for (int64_t i = 0; i < o->n; i++) {
                const double *u = s->u[q] + o->cell[i];
                o->w[q][o->place[i]] = (11.0 * u[0] - 7.0 * u[o->in] + 2.0 * u[2 * o->in]) / 6.0;
                o->change[q][o->place[i]] = 0.0;
            }
    balance(s);
    keep(s);
}

void outflow_restore(struct fv *s)
{
    if (!s->outflows)
        return;
    OUTFLOWS (s, o)
        for (int q = 0; q < s->dim; q++)
            for (int64_t i = 0; i < o->n; i++)
                o->w[q][o->place[i]] = s->outflows->kept[q][o->cell[i] - o->in];
    sum_up(s);
}

/* Averages over the first two cells: w + b/2 + c/3 and w + 3 b/2 + 7 c/3. */
static void take_lines(const struct fv *s, struct outflow *o)
{
    for (int q = 0; q < s->dim; q++)
        for (int64_t i = 0; i < o->n; i++) {
            const double w = o->w[q][o->place[i]], *u = s->u[q] + o->cell[i];
            double *line = o->line[q] + 3 * i;
            line[0] = w;
            line[2] = 0.75 * (u[o->in] - 3.0 * u[0] + 2.0 * w);
            line[1] = u[o->in] - u[0] - 2.0 * line[2];
            if (o->share[i] == 0.0) { /* in air it goes on as it is inside */
                line[0] = u[0];
                line[1] = line[2] = 0.0;
            }
        }
}

void outflow_begin(struct fv *s)
{
    double sums[2][6] = {{0.0}};
    if (!s->outflows)
        return;
    OUTFLOWS (s, o) {
        for (int64_t i = 0; i < o->n; i++)
            if (o->own[i]) {
                sums[0][o->side] += o->share[i] * carried_flux(o, s->dim, i);
                sums[1][o->side] += o->share[i] * carried_area(o, i);
            }
        take_lines(s, o);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 12, MPI_DOUBLE, MPI_SUM, s->comm);
    for (int k = 0; k < 6; k++)
        s->outflows->speed[k] =
            fmax(sums[0][k] / fmax(sums[1][k], 1e-300), 0.0) + s->outflows->waves[k];
}

void outflow_set(struct fv *s, double dt)
{
    if (!s->outflows)
        return;
    OUTFLOWS (s, o)
        for (int q = 0; q < s->dim; q++)
            for (int64_t i = 0; i < o->n; i++) {
                const double *line = o->line[q] + 3 * i;
                const double x =
                    fmin(s->outflows->speed[o->side] / o->h[i] * dt, 1.5); /* it ends at 2 */
                double *w = o->w[q] + o->place[i];
                o->change[q][o->place[i]] = -*w;
                *w = line[0] + x * (line[1] + x * line[2]);
            }
    balance(s);
    OUTFLOWS (s, o)
        for (int q = 0; q < s->dim; q++)
            for (int64_t i = 0; i < o->n; i++)
                o->change[q][o->place[i]] += o->w[q][o->place[i]];
    keep(s);
}

/* sides.c - see sides.h. The flow inside is averaged in bins of width dx along each side, over a
 * band at the inner rim of the buffer; all ranks hold the same table.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sides.h"

#include <math.h>
#include <string.h>

#include "../../common/mem.h"
#include "../particles/eos.h"

enum { WEIGHT, PRESSURE, VELOCITY, BIN = VELOCITY + 3 };

struct side {
    const struct scene_wall *is; /* NULL: not open */
    int bins[2], tangent[2];     /* along each tangent axis */
    int first;                   /* of its bins in the table */
};

struct sides {
    const struct sph *s; /* borrowed */
    struct side of[6];
    int bins;
    double *table; /* [bins][BIN] sums, then means; velocity and pressure of the flow inside */
};

static int bin_of(const struct sides *d, int side, const double *x)
{
    const struct sph *s = d->s;
    const struct side *of = d->of + side;
    int bin = 0;
    for (int k = 1; k >= 0; k--) {
        const int a = of->tangent[k], n = of->bins[k];
        const int i = (int)floor((x[a] - s->lo[a]) / s->dx);
        bin = bin * n + (i < 0 ? 0 : i >= n ? n - 1 : i);
    }
    return of->first + bin;
}

static double depth(const struct sph *s, int side, const double *x)
{
    const int a = side / 2;
    return side % 2 ? s->hi[a] - x[a] : x[a] - s->lo[a];
}

/* Means of bins; each with its two neighbours, where they hold any fluid. Empty bins: at rest. */
static void smooth(struct sides *d, int side, double *means)
{
    const struct side *of = d->of + side;
    const int n0 = of->bins[0], n1 = of->bins[1];
    for (int j = 0; j < n1; j++)
        for (int i = 0; i < n0; i++) {
            double sum[BIN] = {0.0}, *to = means + (size_t)BIN * (of->first + i + n0 * j);
            for (int q = j > 0 ? j - 1 : 0; q <= j + 1 && q < n1; q++)
                for (int p = i > 0 ? i - 1 : 0; p <= i + 1 && p < n0; p++)
                    for (int k = 0; k < BIN; k++)
                        sum[k] += d->table[(size_t)BIN * (of->first + p + n0 * q) + k];
            for (int k = 0; k < BIN; k++)
                to[k] = k == WEIGHT ? sum[k] : sum[WEIGHT] > 0.0 ? sum[k] / sum[WEIGHT] : 0.0;
        }
}

static void look_inside(struct sph *s)
{
    struct sides *d = s->zones->ctx;
    const struct zones *z = s->zones;
    const int dim = s->dim;
    memset(d->table, 0, (size_t)BIN * d->bins * sizeof *d->table);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i), m = y[at_mass(dim)], w = y[at_volume(dim)];
        for (int side = 0; side < 2 * dim; side++) {
            const double in = depth(s, side, y);
            if (!d->of[side].is || in < z->buffer || in > z->buffer + 0.5 * s->R)
                continue;
            double *bin = d->table + (size_t)BIN * bin_of(d, side, y);
            bin[WEIGHT] += w;
            bin[PRESSURE] += w * eos_p(m / w, s->rho0, s->c0, s->gamma);
            for (int a = 0; a < dim; a++)
                bin[VELOCITY + a] += w * y[dim + a] / m;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, d->table, BIN * d->bins, MPI_DOUBLE, MPI_SUM, s->run->comm);
    double *means = NEW(double, (size_t)BIN * d->bins);
    for (int side = 0; side < 2 * dim; side++)
        if (d->of[side].is)
            smooth(d, side, means);
    mem_free(d->table);
    d->table = means;
}

/* 4 z (1 - z) along the bounded tangents. */
static double profile(const struct sph *s, const struct side *of, const double *x)
{
    double f = 1.0;
    for (int k = 0; k < s->dim - 1; k++) {
        const int a = of->tangent[k];
        const double z = (x[a] - s->lo[a]) / (s->hi[a] - s->lo[a]);
        if (of->is->profile == PROFILE_PARABOLIC && !s->periodic[a])
            f *= 4.0 * fmax(0.0, fmin(1.0, z)) * (1.0 - fmax(0.0, fmin(1.0, z)));
    }
    return f;
}

/* The wave that runs out keeps p + Z u.n of the flow inside, the one that runs in p - Z u.n of the
 * far state; n out of the domain. */
static void absorb(const struct sph *s, int side, const struct side *of, const double *bin,
                   double *u, double *p)
{
    const double Z = s->rho0 * s->c0, sign = side % 2 ? 1.0 : -1.0;
    const int a = side / 2;
    const double far = of->is->pressure - Z * sign * of->is->velocity[a];
    const double near = bin[PRESSURE] + Z * sign * bin[VELOCITY + a];
    *p = 0.5 * (near + far);
    for (int b = 0; b < s->dim; b++)
        u[b] = bin[VELOCITY + b];
    u[a] = sign * (near - far) / (2.0 * Z);
}

static void eval_side(const struct sides *d, int side, const double *x, double *u, double *p)
{
    const struct sph *s = d->s;
    const struct side *of = d->of + side;
    const double *bin = d->table + (size_t)BIN * bin_of(d, side, x);
    if (of->is->kind == WALL_ABSORBING) {
        absorb(s, side, of, bin, u, p);
        return;
    }
    const double f = profile(s, of, x);
    *p = of->is->kind == WALL_OUTFLOW ? of->is->pressure : bin[PRESSURE];
    for (int a = 0; a < s->dim; a++)
        u[a] = of->is->kind == WALL_OUTFLOW ? bin[VELOCITY + a] : f * of->is->velocity[a];
}

static void eval_sides(void *ctx, double t, int n, const double *x, double *u, double *p,
                       double *gu, double *gp)
{
    const struct sides *d = ctx;
    const int dim = d->s->dim;
    (void)t;
    for (int i = 0; i < n; i++) {
        int nearest = 0;
        double least = INFINITY;
        for (int side = 0; side < 2 * dim; side++)
            if (d->of[side].is && depth(d->s, side, x + 3 * i) < least) {
                least = depth(d->s, side, x + 3 * i);
                nearest = side;
            }
        eval_side(d, nearest, x + 3 * i, u + dim * i, p + i);
    }
    if (gu) {
        memset(gu, 0, 3 * (size_t)dim * n * sizeof *gu);
        memset(gp, 0, 3 * (size_t)n * sizeof *gp);
    }
}

void sides_create(struct sph *s, struct zones *z)
{
    struct sides *d = NEW(struct sides, 1);
    d->s = s;
    for (int side = 0; side < 2 * s->dim; side++) {
        struct side *of = d->of + side;
        int k = 0;
        if (!s->open[side])
            continue;
        of->is = scene_wall_of(&s->run->scene, SIDE_X_MIN + side);
        of->bins[0] = of->bins[1] = 1;
        for (int a = 0; a < s->dim; a++)
            if (a != side / 2) {
                of->tangent[k] = a;
                of->bins[k++] = (int)lround((s->hi[a] - s->lo[a]) / s->dx);
            }
        of->first = d->bins;
        d->bins += of->bins[0] * of->bins[1];
    }
    d->table = NEW(double, (size_t)BIN * d->bins);
    z->ctx = d;
    z->eval = eval_sides;
    z->update = look_inside;
}

void sides_free(struct zones *z)
{
    struct sides *d = z->ctx;
    mem_free(d->table);
    mem_free(d);
}

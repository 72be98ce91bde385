/* sides.c - see sides.h. The flow inside is averaged in bins of width dx along each side, over a
 * band at the inner rim of the buffer; all ranks hold the same table. Through the bins around each
 * one goes a plane, and another through what it misses of them: so means keep the flow's profile up
 * to its third derivative, at walls up to its second, while what alternates from bin to bin is
 * gone. (Plain means of three bins gave the row beside a no-slip wall twice its velocity, and in
 * the corners of a duct particles that came to rest upstream of the buffer were pressed through
 * walls.) SPDX-License-Identifier: BSD-3-Clause */
#include "sides.h"

#include "../../common/files/files.h"
#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"
#include "openings.h"
#include "side_levels.h"

/* What is averaged, and what a bin sums: weight, its place in the bin, each in units of dx. */
enum { PRESSURE, VELOCITY, FIELDS = VELOCITY + 3 };
enum { WEIGHT, PLACE, MEAN = PLACE + 2, BIN = MEAN + FIELDS };

/* Mean at the middle of a bin and slopes along both tangents, over dx. */
struct side_plane {
    double mean[FIELDS], slope[FIELDS][2];
};

struct opening_side {
    const struct scene_wall *is; /* NULL: not open */
    double pressure;             /* Pa: given, over the reference */
    int bins[2], tangent[2];     /* along each tangent axis */
    bool round[2];               /* periodic along it */
    double leaves;               /* -: share of what flows through it that flows out */
    int first;                   /* of its bins in the table */
    int ncuts;                   /* 2D, a parabolic profile: */
    double *cut;                 /* m: where walls meet the side, in order: the ends of openings */
};

struct sides {
    const struct sph *s; /* borrowed */
    struct opening_side of[6];
    int bins;
    double t;                   /* s: of the last look inside */
    double fall[6];             /* Pa/m: the pressure's slope into the domain */
    double mean[6];             /* Pa: slow mean of the pressure inside a given inflow */
    double surge[6];            /* Pa: what it exceeds that by now */
    double back[6];             /* s: share that runs back, over the second half of the run */
    double watched;             /* s: of it */
    double *table;              /* [bins][BIN] sums, then means */
    struct side_plane *planes;  /* [bins]: velocity and pressure of the flow inside */
    struct side_levels *levels; /* of the water outside; NULL: no free surface */
};

/* Bin at x, and where it is in that, from its middle in dx. */
static int bin_of(const struct sides *d, int side, const double *x, double place[2])
{
    const struct sph *s = d->s;
    const struct opening_side *of = d->of + side;
    int bin = 0;
    place[0] = place[1] = 0.0;
    for (int k = s->dim - 2; k >= 0; k--) {
        const int a = of->tangent[k], n = of->bins[k];
        const double at = (x[a] - s->lo[a]) / s->dx;
        const int i = (int)fmax(0.0, fmin(floor(at), n - 1));
        place[k] = fmax(-0.5, fmin(at - i - 0.5, 0.5));
        bin = bin * n + i;
    }
    return of->first + bin;
}

/* Bin beside I[2], off by o[2]; -1: none. A period of two bins or one has no bins beside: they
 * would count twice. */
static int beside(const struct opening_side *of, const int *I, const int *o)
{
    int at[2];
    for (int k = 0; k < 2; k++) {
        const int n = of->bins[k];
        at[k] = I[k] + o[k];
        if (of->round[k] && n > 2)
            at[k] = (at[k] + n) % n;
        if (at[k] < 0 || at[k] >= n)
            return -1;
    }
    return of->first + at[0] + of->bins[0] * at[1];
}

/* Weighted sums over a bin and those around it, of places from its middle and of the fields. */
struct side_surround {
    double W, x[2], xx[3], f[FIELDS], xf[FIELDS][2];
};

/* The 3 x 3 bins around one, nearer ones with more weight: sums for a straight line through their
 * means. */
static void look_around(const struct sides *d, const struct opening_side *of, const int *I,
                        struct side_surround *to)
{
    int o[2];
    memset(to, 0, sizeof *to);
    for (o[1] = -1; o[1] <= 1; o[1]++)
        for (o[0] = -1; o[0] <= 1; o[0]++) {
            const int bin = beside(of, I, o);
            const double *b = d->table + (size_t)BIN * (bin < 0 ? 0 : bin);
            const double W = bin < 0 ? 0.0 : b[WEIGHT] * (o[0] ? 1.0 : 2.0) * (o[1] ? 1.0 : 2.0);
            const double x[2] = {b[PLACE] + o[0], b[PLACE + 1] + o[1]};
            if (W == 0.0)
                continue;
            to->W += W;
            for (int k = 0; k < 2; k++) {
                to->x[k] += W * x[k];
                to->xx[k] += W * x[k] * x[k];
            }
            to->xx[2] += W * x[0] * x[1];
            for (int q = 0; q < FIELDS; q++) {
                to->f[q] += W * b[MEAN + q];
                to->xf[q][0] += W * x[0] * b[MEAN + q];
                to->xf[q][1] += W * x[1] * b[MEAN + q];
            }
        }
}

/* Adds the plane of least squares through the means around a bin; its slope is small where their
 * places are within a tenth of dx. Nothing around: nothing added. */
static void add_plane(const struct side_surround *r, struct side_plane *to)
{
    static const double spread = 0.01; /* dx^2 */
    if (r->W == 0.0)
        return;
    const double x[2] = {r->x[0] / r->W, r->x[1] / r->W};
    const double a = r->xx[0] / r->W - x[0] * x[0] + spread,
                 b = r->xx[1] / r->W - x[1] * x[1] + spread, c = r->xx[2] / r->W - x[0] * x[1];
    for (int q = 0; q < FIELDS; q++) {
        const double f = r->f[q] / r->W, A = r->xf[q][0] / r->W - x[0] * f,
                     B = r->xf[q][1] / r->W - x[1] * f;
        const double slope[2] = {(b * A - c * B) / (a * b - c * c),
                                 (a * B - c * A) / (a * b - c * c)};
        to->mean[q] += f - slope[0] * x[0] - slope[1] * x[1];
        for (int k = 0; k < 2; k++)
            to->slope[q][k] += slope[k];
    }
}

/* Bins with no fluid around add nothing. */
static void fit(struct sides *d, const struct opening_side *of)
{
    struct side_surround r;
    int I[2];
    for (I[1] = 0; I[1] < of->bins[1]; I[1]++)
        for (I[0] = 0; I[0] < of->bins[0]; I[0]++) {
            look_around(d, of, I, &r);
            add_plane(&r, d->planes + of->first + I[0] + of->bins[0] * I[1]);
        }
}

/* Value of a field at a place in a bin. */
static double value(const struct side_plane *f, int q, const double place[2])
{
    return f->mean[q] + f->slope[q][0] * place[0] + f->slope[q][1] * place[1];
}

/* Sums to means, and planes through them. Empty bins with nothing around: at rest. */
static void find_planes(struct sides *d)
{
    memset(d->planes, 0, (size_t)d->bins * sizeof *d->planes);
    for (int k = 0; k < d->bins; k++)
        for (int q = PLACE; q < BIN; q++) {
            double *b = d->table + (size_t)BIN * k;
            b[q] = b[WEIGHT] > 0.0 ? b[q] / b[WEIGHT] : 0.0;
        }
    for (int pass = 0; pass < 2; pass++) {
        for (int side = 0; side < 2 * d->s->dim; side++)
            if (d->of[side].is)
                fit(d, d->of + side);
        for (int k = 0; k < d->bins && pass == 0; k++) /* what they miss */
            for (int q = 0; q < FIELDS; q++) {
                double *b = d->table + (size_t)BIN * k;
                b[MEAN + q] -= value(d->planes + k, q, b + PLACE);
            }
    }
}

/* Sums over a line of least squares of p against the depth. */
enum { LINE_W, LINE_D, LINE_P, LINE_DD, LINE_DP, LINE };

/* Particles within a support of the zone's rim, in the free water: what is read there does not
 * follow from what the zone sets. */
static void add_to_lines(const struct sph *s, const struct sides *d, double lines[6][LINE])
{
    const double rim = s->zones->buffer + s->zones->transition;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i), w = y[at_volume(s->dim)];
        for (int side = 0; side < 2 * s->dim; side++) {
            const double in = zones_inside(s->lo, s->hi, side, y) - rim;
            if (!d->of[side].is || in < 0.0 || in > s->R)
                continue;
            const double p = eos_p(y[at_mass(s->dim)] / w, s->rho0, s->c0, s->gamma);
            const double terms[LINE] = {w, w * in, w * p, w * in * in, w * in * p};
            for (int k = 0; k < LINE; k++)
                lines[side][k] += terms[k];
        }
    }
}

/* s: of sound through the domain, across a side. */
static double transit(const struct sph *s, int side)
{
    return (s->hi[side / 2] - s->lo[side / 2]) / s->c0;
}

/* The pressure of an outlet is that at the domain's end; through buffer and transition it goes on
 * with the slope that it has in the free zone beside them. The slope follows over the time that
 * sound takes through the domain: at once it would answer its own change. Least squares over the
 * particles up to R into the free zone; a slope is taken only where they spread over more than
 * dx/10 in depth. */
static void follow_slope(struct sph *s, struct sides *d, double dt)
{
    double lines[6][LINE] = {{0.0}};
    if (dt <= 0.0)
        return;
    add_to_lines(s, d, lines);
    MPI_Allreduce(MPI_IN_PLACE, lines, 6 * LINE, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int side = 0; side < 2 * s->dim; side++) {
        const double *l = lines[side], W = fmax(l[LINE_W], 1e-300);
        const double spread = l[LINE_DD] - l[LINE_D] * l[LINE_D] / W;
        if (spread > 0.01 * W * s->dx * s->dx)
            d->fall[side] += (1.0 - exp(-dt / transit(s, side))) *
                             ((l[LINE_DP] - l[LINE_D] * l[LINE_P] / W) / spread - d->fall[side]);
    }
}

/* From sums over the bins: of all that flows through a side the share that leaves. */
static void find_shares(struct sides *d)
{
    for (int side = 0; side < 2 * d->s->dim; side++) {
        struct opening_side *of = d->of + side;
        const int n = of->is ? of->bins[0] * of->bins[1] : 0;
        double both[2] = {0.0, 0.0};
        for (int k = of->first; k < of->first + n; k++) {
            const double *b = d->table + (size_t)BIN * k + MEAN + VELOCITY;
            const double out = side % 2 ? b[side / 2] : -b[side / 2];
            both[out > 0.0] += fabs(out);
        }
        of->leaves = both[1] / fmax(both[0] + both[1], 1e-300);
    }
}

/* What runs back beside what leaves; where all runs in it is driven so. */
static void watch_backflow(struct sides *d, double dt)
{
    const struct sph *s = d->s;
    const double part = fmin(dt, s->t - 0.5 * s->run->scene.time.end);
    if (part <= 0.0)
        return;
    d->watched += part;
    for (int side = 0; side < 2 * s->dim; side++) {
        const struct opening_side *of = d->of + side;
        const bool outlet = of->is && of->is->kind != WALL_INFLOW && of->leaves > 0.5;
        d->back[side] += outlet ? part * (1.0 - of->leaves) : 0.0;
    }
}

/* From sums over the bins: a side whose velocity is given lets sound out, p' = -rho c u', while the
 * slow mean of the velocity stays as given. Held at every moment it is a wall for sound, an
 * outlet's pressure is one of the other kind, and the blow of a sudden start goes to and fro
 * between them for a hundred transits. The mean follows over two transits: over six what a start
 * keeps back comes in three times as late, over one a quarter of the wave of a duct and a
 * contraction goes on. */
static void find_surges(struct sides *d, double dt)
{
    static const double memory = 2.0; /* transits */
    const struct sph *s = d->s;
    for (int side = 0; side < 2 * s->dim; side++) {
        const struct opening_side *of = d->of + side;
        const int n = of->is && of->is->kind == WALL_INFLOW ? of->bins[0] * of->bins[1] : 0;
        double W = 0.0, now = 0.0;
        for (int k = of->first; k < of->first + n; k++) {
            W += d->table[(size_t)BIN * k + WEIGHT];
            now += d->table[(size_t)BIN * k + MEAN + PRESSURE];
        }
        if (W == 0.0)
            continue;
        now /= W;
        d->mean[side] = isnan(d->mean[side]) ? now : d->mean[side];
        d->mean[side] += -expm1(-dt / (memory * transit(s, side))) * (now - d->mean[side]);
        d->surge[side] = now - d->mean[side];
    }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Cuts nearer than `apart' are one. */
static void add_cut(struct opening_side *of, double x, double apart)
{
    bool known = false;
    for (int k = 0; k < of->ncuts; k++)
        known = known || fabs(of->cut[k] - x) < apart;
    if (!known)
        of->cut[of->ncuts++] = x;
}

/* 2D: where lines and bodies meet the side, and its ends; along a period the openings go on across
 * it. */
static void find_cuts(const struct sph *s, int side, struct opening_side *of)
{
    const int a = side / 2, t = of->tangent[0], n = s->walls ? s->walls->nsegments : 0;
    const double at = side % 2 ? s->hi[a] : s->lo[a], length = s->hi[t] - s->lo[t];
    const double near = 1e-6 * s->dx;
    of->cut = NEW_IN(s->zones->ctx, double, 2 * (size_t)n + 4);
    for (int k = 0; k < n; k++) {
        const struct segment *w = s->walls->segments + k;
        const double da = w->a[a] - at, db = w->b[a] - at;
        if (fmin(da, db) > near || fmax(da, db) < -near)
            continue;
        const bool along = fabs(da - db) <= near;
        const double f = along ? 0.0 : fmax(0.0, fmin(da / (da - db), 1.0));
        const double x[2] = {w->a[t] + f * (w->b[t] - w->a[t]), w->b[t]};
        for (int end = 0; end <= along; end++)
            if (x[end] > s->lo[t] + near && x[end] < s->hi[t] - near)
                add_cut(of, x[end], near);
    }
    if (!s->periodic[t]) {
        of->cut[of->ncuts++] = s->lo[t];
        of->cut[of->ncuts++] = s->hi[t];
    }
    qsort(of->cut, (size_t)of->ncuts, sizeof *of->cut, by_size);
    if (s->periodic[t] && of->ncuts > 0) {
        const double first = of->cut[0], last = of->cut[of->ncuts - 1];
        memmove(of->cut + 1, of->cut, (size_t)of->ncuts * sizeof *of->cut);
        of->cut[0] = last - length;
        of->ncuts++;
        of->cut[of->ncuts++] = first + length;
    }
}

/* At each stage's start. In this order: the table's sums, what goes by sums (shares, surges), then
 * planes, which turn sums to means. */
static void look_inside(struct sph *s)
{
    struct sides *d = s->zones->ctx;
    for (int side = 0; side < 2 * s->dim; side++) /* once: walls are made after the zones */
        if (s->dim == 2 && d->of[side].is && d->of[side].is->profile == PROFILE_PARABOLIC &&
            !d->of[side].cut)
            find_cuts(s, side, d->of + side);
    const double dt = s->t - d->t;
    d->t = s->t;
    if (d->levels)
        side_levels_update(s, d->levels);
    else
        follow_slope(s, d, dt);
    const struct zones *z = s->zones;
    const int dim = s->dim;
    memset(d->table, 0, (size_t)BIN * d->bins * sizeof *d->table);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i), m = y[at_mass(dim)], w = y[at_volume(dim)];
        for (int side = 0; side < 2 * dim; side++) {
            const double in = zones_inside(s->lo, s->hi, side, y);
            double place[2];
            if (!d->of[side].is || in < z->buffer || in > z->buffer + 0.5 * s->R)
                continue;
            double *bin = d->table + (size_t)BIN * bin_of(d, side, y, place);
            bin[WEIGHT] += w;
            bin[PLACE] += w * place[0];
            bin[PLACE + 1] += w * place[1];
            bin[MEAN + PRESSURE] += w * eos_p(m / w, s->rho0, s->c0, s->gamma);
            for (int a = 0; a < dim; a++)
                bin[MEAN + VELOCITY + a] += w * y[dim + a] / m;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, d->table, BIN * d->bins, MPI_DOUBLE, MPI_SUM, s->run->comm);
    find_shares(d);
    watch_backflow(d, dt);
    if (!d->levels)
        find_surges(d, fmax(dt, 0.0));
    find_planes(d);
}

/* 4 z (1 - z), z in [0, 1] from lo to hi. */
static double parabola(double x, double lo, double hi)
{
    const double z = fmax(0.0, fmin((x - lo) / (hi - lo), 1.0));
    return 4.0 * z * (1.0 - z);
}

/* Along the bounded tangents; in 2D over each opening that walls cut out of the side. */
static double profile(const struct sph *s, const struct opening_side *of, const double *x)
{
    double f = 1.0;
    if (of->is->profile != PROFILE_PARABOLIC)
        return 1.0;
    if (s->dim == 2 && of->ncuts > 1) {
        int k = 1;
        while (k < of->ncuts - 1 && of->cut[k] < x[of->tangent[0]])
            k++;
        return parabola(x[of->tangent[0]], of->cut[k - 1], of->cut[k]);
    }
    for (int k = 0; k < s->dim - 1; k++) {
        const int a = of->tangent[k];
        f *= s->periodic[a] ? 1.0 : parabola(x[a], s->lo[a], s->hi[a]);
    }
    return f;
}

/* The wave that runs out keeps p + Z u.n of the flow inside, the one that runs in p - Z u.n of the
 * far state; n out of the domain. in: pressure and velocity inside. rho c = Z; exact for plane
 * waves that hit the side at right angles. */
static void absorb(const struct sph *s, int side, const struct opening_side *of, const double *in,
                   double *u, double *p)
{
    const double Z = s->rho0 * s->c0, sign = side % 2 ? 1.0 : -1.0;
    const int a = side / 2;
    const double far = of->pressure - Z * sign * of->is->velocity[a];
    const double near = in[PRESSURE] + Z * sign * in[VELOCITY + a];
    *p = 0.5 * (near + far);
    for (int b = 0; b < s->dim; b++)
        u[b] = in[VELOCITY + b];
    u[a] = sign * (near - far) / (2.0 * Z);
}

/* What runs at a wall within R slows down with its distance, as a fluid must that passes none. The
 * means know that on average only, and what is left carries particles into the wall as long as they
 * are in the buffer: in a round pipe half of those beside it. */
static void turn_along_walls(const struct sph *s, const double *x, double *u)
{
    double way[3] = {0.0, 0.0, 0.0}, across = 0.0;
    const double h = s->walls ? walls_way(s, x, s->R, way) : s->R;
    if (!(h > 0.0 && h < s->R))
        return;
    for (int a = 0; a < s->dim; a++)
        across += u[a] * way[a] / h;
    for (int a = 0; a < s->dim && across > 0.0; a++)
        u[a] -= (1.0 - h / s->R) * across * way[a] / h;
}

/* Of an outlet. What runs back through it, beside what leaves, comes out of fluid at rest and
 * brings no more than the head there: else an eddy in the opening feeds itself. What runs in
 * through the whole side is driven by the pressure that is given there. */
static double outlet_pressure(const struct sides *d, int side, const double *x, const double *in)
{
    const struct opening_side *of = d->of + side;
    const double out = side % 2 ? in[VELOCITY + side / 2] : -in[VELOCITY + side / 2];
    const double back = fmin(out, 0.0);
    return of->pressure + d->fall[side] * zones_inside(d->s->lo, d->s->hi, side, x) -
           0.5 * d->s->rho0 * of->leaves * back * back;
}

/* gp[3]: gradient of p, NULL: not wanted. */
static void eval_side(const struct sides *d, int side, const double *x, double *u, double *p,
                      double *gp)
{
    const struct sph *s = d->s;
    const struct opening_side *of = d->of + side;
    double place[2], in[FIELDS];
    const struct side_plane *bin = d->planes + bin_of(d, side, x, place);
    for (int q = 0; q < FIELDS; q++)
        in[q] = value(bin, q, place);
    if (of->is->kind != WALL_INFLOW)
        turn_along_walls(s, x, in + VELOCITY);
    if (d->levels) {
        memcpy(u, in + VELOCITY, (size_t)s->dim * sizeof *u);
        side_levels_eval(s, d->levels, side, x, u, p, gp);
        return;
    }
    if (of->is->kind == WALL_ABSORBING) {
        absorb(s, side, of, in, u, p);
        return;
    }
    const double f = profile(s, of, x);
    *p = of->is->kind != WALL_OUTFLOW ? in[PRESSURE] : outlet_pressure(d, side, x, in);
    for (int a = 0; a < s->dim; a++)
        u[a] = of->is->kind == WALL_OUTFLOW ? in[VELOCITY + a] : f * of->is->velocity[a];
    u[side / 2] -= openings_inward(side) * f * d->surge[side] / (s->rho0 * s->c0);
}

/* t does not matter: the sides answer the flow inside as it was at the last update. Velocities have
 * no gradients. */
static void eval_sides(void *ctx, double t, int n, const double *x, double *u, double *p,
                       double *gu, double *gp)
{
    const struct sides *d = ctx;
    const int dim = d->s->dim;
    (void)t;
    if (gu) {
        memset(gu, 0, 3 * (size_t)dim * n * sizeof *gu);
        memset(gp, 0, 3 * (size_t)n * sizeof *gp);
    }
    for (int i = 0; i < n; i++) {
        double below;
        const int nearest = zones_nearest(d->s->zones, x + 3 * i, &below);
        eval_side(d, nearest, x + 3 * i, u + dim * i, p + i, gu ? gp + 3 * i : NULL);
    }
}

static void water_outside(void *ctx, double t, int n, const double *x, double *phi, double *gphi)
{
    const struct sides *d = ctx;
    (void)t;
    side_levels_surface(d->s, d->levels, n, x, phi, gphi);
}

/* own_u and own_p tell blending what a side takes from the flow inside: of an outlet or a given
 * level its velocity, of an inflow its pressure. */
void sides_create(struct sph *s, struct zones *z)
{
    struct sides *d = NEW_IN(z, struct sides, 1);
    d->s = s;
    d->t = s->t;
    d->levels = mem_own(d, side_levels_create(s));
    for (int side = 0; side < 2 * s->dim; side++) {
        struct opening_side *of = d->of + side;
        int k = 0;
        if (!s->open[side])
            continue;
        of->is = scene_wall_of(&s->run->scene, SIDE_X_MIN + side);
        d->mean[side] = NAN;
        of->pressure = scene_reference_left(&s->run->scene, &s->reference, of->is);
        z->own_u[side] =
            d->levels ? side_levels_given(d->levels, side) : of->is->kind == WALL_OUTFLOW;
        z->own_p[side] = d->levels ? !z->own_u[side] : of->is->kind == WALL_INFLOW;
        of->bins[0] = of->bins[1] = 1;
        for (int a = 0; a < s->dim; a++)
            if (a != side / 2) {
                of->tangent[k] = a;
                of->round[k] = s->periodic[a];
                of->bins[k++] = (int)lround((s->hi[a] - s->lo[a]) / s->dx);
            }
        of->first = d->bins;
        d->bins += of->bins[0] * of->bins[1];
    }
    d->table = NEW_IN(d, double, (size_t)BIN * d->bins);
    d->planes = NEW_IN(d, struct side_plane, d->bins);
    z->ctx = d;
    z->eval = eval_sides;
    z->surface = d->levels ? water_outside : NULL;
    z->update = look_inside;
}

double sides_level(const struct sph *s, int side)
{
    const struct sides *d = s->zones->ctx;
    return d->levels && d->of[side].is ? side_levels_level(d->levels, side) : NAN;
}

void sides_summarise(const struct sph *s)
{
    static const double much = 0.1;
    const struct sides *d = s->zones->ctx;
    for (int side = 0; side < 2 * s->dim && d->watched > 0.0; side++) {
        const char *const name = scene_side_names[side];
        const double back = d->back[side] / d->watched;
        if (!d->of[side].is || d->of[side].is->kind == WALL_INFLOW)
            continue;
        summary_real(s->run->summary, key_text("backflow.%s", name), back);
        if (back > much)
            log_warn("%.0f %% of what flows through the outlet %s runs back in, over the second "
                     "half of the run: it comes as water at rest outside would, which is no more "
                     "than a guess; put the outlet farther away from what stirs the flow",
                     100.0 * back, name);
    }
}

/* What is smoothed or summed in time; the rest follows from the particles. */
bool sides_restart(struct sph *s, struct h5 *f)
{
    struct sides *d = s->zones->ctx;
    d->t = h5_writes(f) ? d->t : s->t;
    return h5_keep_same(f, "sides_slope", "Pa/m", 6, d->fall) &&
           h5_keep_same(f, "sides_mean", "Pa", 6, d->mean) &&
           h5_keep_same(f, "sides_back", "s", 6, d->back) &&
           h5_keep_same(f, "sides_watched", "s", 1, &d->watched) &&
           (!d->levels || side_levels_restart(d->levels, f));
}

/* level_gauge.c - see level_gauge.h. The volume of the fluid in a column around the place over the
 * column's cross-section, drops included, on top of the floor: the first wall or body below the
 * place (the first above it that holds fluid, where the place is in a wall itself), else the bottom
 * of the domain. Where walls stand in the column it ends there; what water drowns above the place
 * counts as water. SPDX-License-Identifier: BSD-3-Clause */
#include "level_gauge.h"

#include <math.h>
#include <string.h>

#include "../../common/scene.h"
#include "../walls/walls.h"

enum { SAMPLES_2D = 16, SAMPLES_3D = 8 }; /* of a floor, along an axis */

struct column {
    double at[3];        /* the place, in the fluid */
    double lo[2], hi[2]; /* m from it: across */
    double half;         /* m: half width of the hat function that weights it */
    bool walled;         /* by more than sides of the domain */
    double section, floor;
    double roof, drowned; /* m: underside of a solid above the place, its mean height; NAN, 0 */
};

/* Lines, meshes or bodies: sides alone leave the floor even and columns upright. */
static bool has_walls_inside(const struct sph *s)
{
    const struct scene *c = &s->run->scene;
    bool any = s->walls && c->nbodies > 0;
    for (int k = 0; s->walls && k < c->nwalls; k++)
        any = any || (c->walls[k].side == SIDE_NONE && c->walls[k].kind <= WALL_NO_SLIP);
    return any;
}

/* How far it is free from x along an axis, at most `far' (signed), m. */
static double free_way(const struct sph *s, const double *x, int axis, double far)
{
    double d[3] = {0.0, 0.0, 0.0};
    d[axis] = far;
    return walls_meet(s, x, d) * far;
}

/* Out of the solid that the place is in or on, upwards. */
static void rise_from_solid(const struct sph *s, double *x)
{
    const int up = s->dim - 1;
    const double step = 0.01 * s->dx, top = s->hi[up];
    double way[3], y[3];
    memcpy(y, x, sizeof y);
    for (int k = 0; k < 8 && walls_way(s, y, 1e30, way) < step; k++) {
        y[up] -= 2.0 * step;
        y[up] += free_way(s, y, up, top - y[up]) + step;
        if (y[up] >= top)
            return;
    }
    memcpy(x, y, sizeof y);
}

static double hat(const struct column *c, double d) { return fmax(0.0, 1.0 - fabs(d) / c->half); }

/* Integral of the hat function from lo to hi, m. */
static double hat_integral(const struct column *c, double lo, double hi)
{
    return hi - 0.5 * hi * hi / c->half - lo - 0.5 * lo * lo / c->half;
}

/* Whether walls hide the place across from the one at x, or at its height what is `by' higher. */
static bool is_hidden(const struct sph *s, const struct column *c, const double *across, double by)
{
    const int up = s->dim - 1;
    double d[3] = {0.0, 0.0, 0.0}, x[3];
    memcpy(x, c->at, sizeof x);
    for (int a = 0; a < up; a++) {
        d[a] = across[a];
        x[a] += across[a];
    }
    return walls_meet(s, c->at, d) < 1.0 || (by < 0.0 && free_way(s, x, up, by) > by);
}

/* Floor and roof over one place of the section; sums: weight, floor, roof's weight, roof, height.
 */
static void sound(const struct sph *s, const struct column *c, const double *across, double weight,
                  double sums[5])
{
    const int up = s->dim - 1;
    double x[3];
    memcpy(x, c->at, sizeof x);
    if (is_hidden(s, c, across, 0.0))
        return;
    for (int a = 0; a < up; a++)
        x[a] += across[a];
    sums[0] += weight;
    sums[1] += weight * (x[up] + free_way(s, x, up, s->lo[up] - x[up]));
    const double room = s->hi[up] - x[up], roof = free_way(s, x, up, room);
    if (roof >= room)
        return;
    const double under = x[up] + roof, eps = 1e-6 * s->dx;
    x[up] = under + eps;
    const double rest = s->hi[up] - x[up], height = free_way(s, x, up, rest);
    if (!(rest > 0.0) || height >= rest) /* solid up to the top */
        return;
    sums[2] += weight;
    sums[3] += weight * under;
    sums[4] += weight * (height + eps);
}

static void sound_all(const struct sph *s, struct column *c)
{
    const int up = s->dim - 1, n = up == 1 ? SAMPLES_2D : SAMPLES_3D, m = up == 1 ? 1 : n;
    double sums[5] = {0.0}, all = 0.0;
    for (int k = 0; k < n * m; k++) {
        const int at[2] = {k % n, k / n};
        double across[2] = {0.0, 0.0}, weight = 1.0;
        for (int a = 0; a < up; a++) {
            across[a] = c->lo[a] + (at[a] + 0.5) / n * (c->hi[a] - c->lo[a]);
            weight *= hat(c, across[a]);
        }
        all += weight;
        sound(s, c, across, weight, sums);
    }
    if (!(sums[0] > 0.0))
        return;
    c->section *= sums[0] / all;
    c->floor = sums[1] / sums[0];
    c->roof = sums[3] / sums[2]; /* NAN: none */
    c->drowned = sums[4] / sums[0];
}

static struct column column_at(const struct sph *s, const double *at)
{
    const int up = s->dim - 1;
    struct column c = {.half = 2.0 * s->dx,
                       .section = 1.0,
                       .floor = s->lo[up],
                       .roof = NAN,
                       .walled = has_walls_inside(s)};
    memcpy(c.at, at, (size_t)s->dim * sizeof *at);
    if (c.walled)
        rise_from_solid(s, c.at);
    for (int a = 0; a < up; a++) {
        c.lo[a] = s->periodic[a] ? -c.half : fmax(-c.half, s->lo[a] - at[a]);
        c.hi[a] = s->periodic[a] ? c.half : fmin(c.half, s->hi[a] - at[a]);
        if (c.walled && c.lo[a] < 0.0 && c.hi[a] > 0.0) {
            c.lo[a] = free_way(s, c.at, a, c.lo[a]);
            c.hi[a] = free_way(s, c.at, a, c.hi[a]);
        }
        c.section *= hat_integral(&c, c.lo[a], c.hi[a]);
    }
    if (c.walled)
        sound_all(s, &c);
    return c;
}

/* Volume of what flows of one level, weighted by the hat function. */
static double volume_in(const struct sph *s, const struct column *c)
{
    const int up = s->dim - 1;
    double volume = 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i);
        double weight = particles_is_guard(&s->p, i) ? 0.0 : q[at_volume(s->dim)];
        double across[2] = {0.0, 0.0};
        for (int a = 0; a < up; a++) {
            const double L = s->hi[a] - s->lo[a];
            across[a] = q[a] - c->at[a];
            if (s->periodic[a])
                across[a] -= L * round(across[a] / L);
            weight *= across[a] < c->lo[a] || across[a] > c->hi[a] ? 0.0 : hat(c, across[a]);
        }
        if (weight > 0.0 && !(c->walled && is_hidden(s, c, across, q[up] - c->at[up])))
            volume += weight;
    }
    return volume;
}

double level_gauge(struct sph *s, const double *at)
{
    const struct column c = column_at(s, at);
    double volume = 0.0;
    for (const struct sph *q = s; q; q = q->finer)
        volume += volume_in(q, &c);
    MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double level = c.floor + volume / c.section;
    return level > c.roof + 0.5 * s->dx ? level + c.drowned : level; /* no roof: NAN */
}

/* box_tracking.c - see box_tracking.h. What is followed is a mean over the water above the still
 * level, weighted by volume, by the square of its height there and by how near the box's middle it
 * is: of a symmetric crest it is the crest, of one that breaks it moves forward with the front, and
 * spray does not count. The highest or steepest place would jump from one particle to another, and
 * from crest to crest. The box answers as a mass on a spring with critical damping that also knows
 * its speed of before, so that behind a crest of constant speed it does not lag: e = crest -
 * middle, dv/dt = e/tau^2, dx/dt = v + 2 e/tau, both no faster than box_tracking_speed. Without a
 * crest v decays. SPDX-License-Identifier: BSD-3-Clause */
#include "box_tracking.h"

#include "zones.h"

static const double share = 0.25; /* of the time in which the fastest box goes its length: tau */
static const double least = 5.0;  /* particles that make a crest, in each column across it */

/* Against the gravity that water at rest has: unit vector; its size, m/s^2. */
static double upwards(const struct run *r, double up[3])
{
    double g[3];
    const double size = scene_still_gravity(&r->scene, g);
    for (int a = 0; a < 3; a++)
        up[a] = size > 0.0 ? -g[a] / size : 0.0;
    return size;
}

/* Of long waves on water as deep as the domain is high: more than any crest in it. */
double box_tracking_speed(const struct run *r)
{
    const struct scene_domain *d = &r->scene.domain;
    double up[3], high = 0.0;
    const double g = upwards(r, up);
    for (int a = 0; a < d->dim; a++)
        high += fabs(up[a]) * (d->max[a] - d->min[a]);
    return sqrt(g * high);
}

/* 1 in the middle of the box, 0 at its ends. */
static double nearness(const struct sph *s, const bool along[3], const double *x)
{
    double f = 1.0;
    for (int a = 0; a < s->dim; a++) {
        const double half = 0.5 * (s->hi[a] - s->lo[a]);
        if (along[a])
            f *= fmax(0.0, 1.0 - fabs(x[a] - s->lo[a] - half) / half);
    }
    return f;
}

/* Sums over one level: weight, volume, weight times place. */
static void add_level(const struct sph *s, const struct sph *q, const bool along[3],
                      const double up[3], double sums[5])
{
    const double level = s->run->scene.initial.level + s->dx;
    for (int i = 0; i < q->p.n; i++) {
        const double *y = state_row(&q->p, q->p.y, i);
        double above = -level;
        if (particles_is_guard(&q->p, i))
            continue;
        for (int a = 0; a < s->dim && a < 3; a++)
            above += up[a] * y[a];
        if (above <= 0.0)
            continue;
        const double f = nearness(s, along, y), w = y[at_volume(s->dim)];
        sums[0] += w * f * above * above;
        sums[1] += w * f;
        for (int a = 0; a < s->dim; a++)
            sums[2 + a] += w * f * above * above * y[a];
    }
}

/* false: no water stands above the level. */
static bool find_crest(struct sph *s, const bool along[3], double at[3])
{
    double up[3], sums[5] = {0.0}, columns = 1.0;
    upwards(s->run, up);
    for (const struct sph *q = s; q; q = q->finer)
        add_level(s, q, along, up, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int a = 0; a < s->dim; a++) {
        if (!along[a] && up[a] == 0.0)
            columns *= (s->hi[a] - s->lo[a]) / s->dx;
        at[a] = sums[0] > 0.0 ? sums[2 + a] / sums[0] : 0.0;
    }
    return sums[1] > least * columns * pow(s->dx, s->dim);
}

/* Where the box would come within a support of a side of the domain it stays; true. */
static bool hold_back(const struct sph *s, int a, double *way)
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double margin = s->R + s->dx;
    const double low = d->min[a] + margin - s->prm.box[0][a],
                 high = d->max[a] - margin - s->prm.box[1][a];
    const double to = fmin(fmax(*way, fmin(low, 0.0)), fmax(high, 0.0));
    const bool held = !d->periodic[a] && to != *way;
    *way = held ? to : *way;
    return held;
}

void box_tracking_step(struct sph *s, double dt, const bool along[3], double way[3])
{
    const double most = box_tracking_speed(s->run);
    double at[3], *v = s->zones->tracked;
    if (!(dt > 0.0))
        return;
    const bool seen = find_crest(s, along, at);
    for (int a = 0; a < s->dim; a++) {
        if (!along[a])
            continue;
        const double tau = share * (s->hi[a] - s->lo[a]) / most;
        const double e = seen ? at[a] - 0.5 * (s->lo[a] + s->hi[a]) : 0.0;
        v[a] += dt * (seen ? e / (tau * tau) : -v[a] / tau);
        v[a] = fmin(fmax(v[a], -most), most);
        way[a] += dt * fmin(fmax(v[a] + 2.0 * e / tau, -most), most);
        if (hold_back(s, a, way + a))
            v[a] = 0.0;
    }
}

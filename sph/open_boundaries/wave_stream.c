/* wave_stream.c - see wave_stream.h. The pressure is that of the waves' own velocities
 * (common/waves/wave_pressure.h), on the current, too.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "wave_stream.h"

#include "../../common/scene/scene.h"
#include "level_gap.h"

static const double step = 1e-3; /* of differences, over the depth */

struct wave_stream {
    const struct sph *s; /* borrowed */
    int up;
    double sign, g, level; /* height is sign times x[up]; m/s^2; m: the still level */
    double along[3], across[3];
    double mean; /* m/s: along, of what goes through the sides */
    bool calm[6];
    struct waves *waves; /* owned */
};

bool wave_stream_wanted(const struct run *r, const struct sph_params *prm)
{
    return prm->outer == OUTER_SIDES && scene_currents_flow(&r->scene);
}

/* Where x is along the waves, across them and over the still level, m. */
static void place_of(const struct wave_stream *w, const double *x, double at[3])
{
    at[0] = vec3_dot(x, w->along);
    at[1] = vec3_dot(x, w->across);
    at[2] = w->sign * x[w->up] - w->level;
}

/* From along, up, across to the axes of the case. */
static void to_axes(const struct wave_stream *w, const double v[3], double u[3])
{
    for (int a = 0; a < 3; a++)
        u[a] = v[0] * w->along[a] + v[2] * w->across[a];
    u[w->up] += w->sign * v[1];
}

/* calm: behind a beach the water is at rest, but for its weight. */
static void stream_at(const struct wave_stream *w, const double *x, bool calm, double u[3],
                      double *p)
{
    double at[3], v[3] = {w->mean, 0.0, 0.0};
    place_of(w, x, at);
    *p = -w->g * at[2];
    if (!calm) {
        waves_velocity(w->waves, at[0], at[1], at[2], v);
        *p = waves_pressure(w->waves, at[0], at[1], at[2], v);
    }
    to_axes(w, v, u);
    *p *= w->s->rho0;
}

/* By central differences. */
static void slopes_at(const struct wave_stream *w, const double *x, bool calm, double *gu,
                      double *gp)
{
    const int dim = w->s->dim;
    const double h = step * w->waves->of.depth;
    memset(gu, 0, 3 * (size_t)dim * sizeof *gu);
    memset(gp, 0, 3 * sizeof *gp);
    for (int b = 0; b < dim; b++) {
        double y[3] = {x[0], x[1], x[2]}, u[2][3], p[2];
        y[b] = x[b] - h;
        stream_at(w, y, calm, u[0], p);
        y[b] = x[b] + h;
        stream_at(w, y, calm, u[1], p + 1);
        gp[b] = 0.5 * (p[1] - p[0]) / h;
        for (int a = 0; a < dim; a++)
            gu[3 * a + b] = 0.5 * (u[1][a] - u[0][a]) / h;
    }
}

/* Slopes only if they are asked for: they cost several more looks. */
void wave_stream_eval(void *ctx, double t, int n, const double *x, double *u, double *p, double *gu,
                      double *gp)
{
    const struct wave_stream *w = ctx;
    const int dim = w->s->dim;
    double below, v[3];
    waves_at(w->waves, t);
    for (int i = 0; i < n; i++) {
        const double *at = x + 3 * i;
        const bool calm = w->calm[zones_nearest(w->s->zones, at, &below)];
        stream_at(w, at, calm, v, p + i);
        memcpy(u + dim * i, v, (size_t)dim * sizeof *u);
        if (gu)
            slopes_at(w, at, calm, gu + 3 * dim * i, gp + 3 * i);
    }
}

/* Distance to the tangent of the surface over x. */
static void stream_surface(void *ctx, double t, int n, const double *x, double *phi, double *gphi)
{
    const struct wave_stream *w = ctx;
    const double h = step * w->waves->of.depth;
    double below, at[3];
    waves_at(w->waves, t);
    for (int i = 0; i < n; i++) {
        place_of(w, x + 3 * i, at);
        double eta = 0.0, slope = 0.0;
        if (!w->calm[zones_nearest(w->s->zones, x + 3 * i, &below)]) {
            const double low = waves_eta(w->waves, at[0] - h, at[1]),
                         high = waves_eta(w->waves, at[0] + h, at[1]);
            eta = 0.5 * (low + high);
            slope = 0.5 * (high - low) / h;
        }
        const double per = 1.0 / hypot(1.0, slope), of[3] = {-per * slope, per, 0.0};
        phi[i] = per * (at[2] - eta);
        if (gphi)
            to_axes(w, of, gphi + 3 * i);
    }
}

void wave_stream_create(struct sph *s, struct zones *z)
{
    const struct scene *c = &s->run->scene;
    const struct wave_spec of = scene_waves_spec(c);
    struct wave_stream *w = NEW_IN(z, struct wave_stream, 1);
    w->s = s;
    w->up = scene_still_axis(c);
    w->sign = s->gravity[w->up] < 0.0 ? 1.0 : -1.0;
    w->g = fabs(s->gravity[w->up]);
    w->level = scene_waves_level(c);
    scene_waves_direction(c, w->along, w->across);
    w->waves = mem_own(w, waves_create(&of));
    waves_need_pressure(w->waves);
    w->mean = scene_currents_mean(c, w->waves);
    for (int side = 0; side < 2 * s->dim; side++) {
        const struct scene_wall *is = scene_wall_of(c, SIDE_X_MIN + side);
        w->calm[side] = is && is->zone == ZONE_BEACH;
    }
    z->ctx = w;
    z->eval = wave_stream_eval;
    z->surface = stream_surface;
    z->gap = mem_own(z, level_gap_create(s, true));
}

/* At 0 along the other axes: along crests all are alike. */
double wave_stream_level(const struct sph *s, int side)
{
    const struct wave_stream *w = s->zones->ctx;
    const int a = side / 2;
    double x[3] = {0.0, 0.0, 0.0}, at[3];
    x[a] = side % 2 ? s->hi[a] : s->lo[a];
    place_of(w, x, at);
    waves_at(w->waves, s->t);
    return w->level + (w->calm[side] ? 0.0 : waves_eta(w->waves, at[0], at[1]));
}

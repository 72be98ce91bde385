/* wave_zones.c - see wave_zones.h. SPDX-License-Identifier: BSD-3-Clause */
#include "wave_zones.h"

#include "../waves/waves.h"
#include "scene_currents.h"
#include "scene_fluid.h"
#include "scene_waves.h"

/* As many heights at a place pay for the blending of its columns. */
enum { WAVE_COLUMN_LEAST = 6 };

struct wave_zones {
    int n, up;
    struct {
        int axis;
        double edge, length; /* m: of the side (towards +: length > 0) */
        double per;          /* 1/m: over its length */
        double rate;         /* 1/s: at the side */
        struct waves *waves; /* NULL: a beach; owned */
    } zone[6];
    double current;                          /* m/s: along, of what goes through the sides */
    double along[3], across[3], level, sign; /* of waves; height is sign times x[up] */
};

/* A side that lets the waves pass takes nothing off them. Sums of waves are computed for the places
 * of their zone alone; what evolves, or is read, is one field for all zones. */
static struct waves *waves_of(const struct scene *s, const struct wave_zones *z,
                              const struct scene_wall *wall, bool pass)
{
    const int k = z->n;
    struct wave_spec of = scene_waves_spec(s);
    if (of.evolve == EVOLVE_NO && of.kind != WAVE_FILE)
        scene_waves_window(s, wall, of.window);
    of.zone = pass ? 0.0 : fabs(z->zone[k].length);
    of.rate = scene_currents_rate(&of, z->zone[k].rate);
    of.open = scene_currents_flow(s);
    const double inward = z->zone[k].length > 0.0 ? 1.0 : -1.0;
    of.normal[0] = inward * z->along[z->zone[k].axis];
    of.normal[1] = inward * z->across[z->zone[k].axis];
    struct waves *w = waves_create(&of);
    for (int first = 0; first < k; first++)
        if (z->zone[first].waves && !z->zone[first].waves->shares)
            waves_share(w, z->zone[first].waves);
    return w;
}

/* The mean velocity of what the waves and their current bring. */
static double mean_of(const struct scene *s)
{
    const struct wave_spec of = scene_waves_spec(s);
    struct waves *made = waves_create(&of);
    const double mean = scene_currents_mean(s, made);
    FREE(made);
    return mean;
}

struct wave_zones *wave_zones_create(const struct scene *s, bool pass)
{
    struct wave_zones *z = NEW(struct wave_zones, 1);
    *z = (struct wave_zones){.up = scene_still_axis(s)};
    if (scene_makes_waves(s)) {
        z->sign = s->fluid.gravity[z->up] < 0.0 ? 1.0 : -1.0;
        z->level = scene_waves_level(s);
        scene_waves_direction(s, z->along, z->across);
        z->current = scene_currents_flow(s) ? mean_of(s) : 0.0;
    }
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        double lo[3], hi[3];
        bool low;
        const int axis = scene_zone_box(s, w, lo, hi);
        if (axis < 0)
            continue;
        scene_zone_axis(w, &low);
        z->zone[z->n].axis = axis;
        z->zone[z->n].edge = low ? lo[axis] : hi[axis];
        z->zone[z->n].length = (low ? hi[axis] : lo[axis]) - z->zone[z->n].edge;
        z->zone[z->n].per = 1.0 / z->zone[z->n].length;
        z->zone[z->n].rate = 4.0 * M_PI / w->beach_period;
        if (w->zone == ZONE_WAVE)
            z->zone[z->n].waves = mem_own(z, waves_of(s, z, w, pass));
        z->n++;
    }
    if (z->n > 0)
        return z;
    mem_free(z);
    return NULL;
}

void wave_zones_at(struct wave_zones *z, double t)
{
    for (int k = 0; k < z->n; k++)
        if (z->zone[k].waves)
            waves_at(z->zone[k].waves, t);
}

/* The field that all zones share; NULL: no waves evolve. */
static struct wave_field *field_of(const struct wave_zones *z)
{
    struct wave_field *field = NULL;
    for (int k = 0; k < z->n && !field; k++)
        field = z->zone[k].waves ? z->zone[k].waves->field : NULL;
    return field;
}

void wave_zones_restart(struct wave_zones *z, struct h5 *f)
{
    struct wave_field *field = field_of(z);
    if (field && h5_writes(f))
        wave_field_save(field, f);
    else if (field)
        wave_field_load(field, f);
}

bool wave_zones_drive(const struct wave_zones *z)
{
    bool any = false;
    for (int k = 0; k < z->n; k++)
        any = any || z->zone[k].waves;
    return any;
}

/* Adds rate times v (along, up, across) to u. */
static void add_turned(const struct wave_zones *z, double rate, const double *v, double *u)
{
    for (int a = 0; a < 3; a++)
        u[a] += rate * (v[0] * z->along[a] + v[2] * z->across[a]);
    u[z->up] += rate * z->sign * v[1];
}

/* Adds rate times the velocity of a zone's waves at x. */
static void add_velocity(const struct wave_zones *z, int k, double rate, const double *x, double *u)
{
    double v[3];
    waves_velocity(z->zone[k].waves, vec3_dot(x, z->along), vec3_dot(x, z->across),
                   z->sign * x[z->up] - z->level, v);
    add_turned(z, rate, v, u);
}

/* The same; a beach brings the water to the mean flow. */
static void add_target(const struct wave_zones *z, int k, double rate, const double *x, double *u)
{
    if (z->zone[k].waves)
        add_velocity(z, k, rate, x, u);
    for (int a = 0; a < 3 && !z->zone[k].waves; a++)
        u[a] += rate * z->current * z->along[a];
}

/* 1/s: of one zone at x; 0 beyond its inner edge. */
static double rate_of(const struct wave_zones *z, int k, const double *x)
{
    const double chi = 1.0 - (x[z->zone[k].axis] - z->zone[k].edge) * z->zone[k].per;
    return chi > 0.0 ? z->zone[k].rate * lesser(chi * chi, 1.0) : 0.0;
}

/* Where zones meet, u_w is their mean by their rates. */
static double rate_of_several(const struct wave_zones *z, const double *x, double *u_w)
{
    double rate = 0.0;
    for (int k = 0; k < z->n; k++) {
        const double r = rate_of(z, k, x);
        rate += r;
        if (r > 0.0)
            add_target(z, k, r, x, u_w);
    }
    for (int a = 0; a < 3; a++)
        u_w[a] /= rate;
    return rate;
}

/* The zone that x is in; -1: in none, -2: in several. *rate: in one, 1/s. */
static int zone_at(const struct wave_zones *z, const double *x, double *rate)
{
    int one = -1;
    *rate = 0.0;
    for (int k = 0; k < z->n; k++) {
        const double r = rate_of(z, k, x);
        if (r == 0.0)
            continue;
        one = one == -1 ? k : -2;
        *rate = r;
    }
    return one;
}

/* Most points are in no zone, most others in one. */
double wave_zones_rate(const struct wave_zones *z, const double *x, double *u_w)
{
    double rate;
    const int one = zone_at(z, x, &rate);
    u_w[0] = u_w[1] = u_w[2] = 0.0;
    if (one == -2)
        return rate_of_several(z, x, u_w);
    if (one >= 0)
        add_target(z, one, 1.0, x, u_w);
    return rate;
}

bool wave_zones_hold(const struct wave_zones *z, const double *x)
{
    double rate;
    return zone_at(z, x, &rate) != -1;
}

/* Zones stand before upright sides: all places have one rate. */
double wave_zones_column(const struct wave_zones *z, int n, double (*x)[3], double (*u_w)[3])
{
    double rate, height[WAVE_COLUMN], v[WAVE_COLUMN][3];
    const int one = zone_at(z, x[0], &rate);
    const bool beach = one >= 0 && !z->zone[one].waves;
    if (beach || one < 0 || n < WAVE_COLUMN_LEAST) {
        for (int i = 0; i < n; i++)
            if (beach && i > 0)
                memcpy(u_w[i], u_w[0], sizeof u_w[i]);
            else
                rate = wave_zones_rate(z, x[i], u_w[i]);
        return rate;
    }
    for (int i = 0; i < n; i++)
        height[i] = z->sign * x[i][z->up] - z->level;
    waves_velocities(z->zone[one].waves, vec3_dot(x[0], z->along), vec3_dot(x[0], z->across), n,
                     height, v);
    for (int i = 0; i < n; i++) {
        u_w[i][0] = u_w[i][1] = u_w[i][2] = 0.0;
        add_turned(z, 1.0, v[i], u_w[i]);
    }
    return rate;
}

/* paddles.c - see paddles.h. Once a step (paddles_steer) each paddle's correction, displacement x
 * and velocity v, gets a new acceleration from e, the level at its gauge less that of the wave that
 * it is to make and less a slow mean: a = (-gain e - v - rate x)/lag - rate v at the still level.
 * It then moves on with that until the next step, on every level of refinement alike.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "paddles.h"

#include "../../common/files/files.h"
#include "../../common/scene/scene.h"
#include "../surface/sph_surface.h"
#include "../walls/sph_walls.h"

struct paddle {
    struct wave_absorber *absorber; /* owned */
    struct body_steer steer;        /* what it adds to the body's motion; m at the still level
                                     * times absorber->per */
    double mean;                    /* m: slow mean of what the level has too much */
};

static const double gauge_dx = 2.0; /* the gauge's column is 2 dx to both sides */

/* The term of a body that absorbs; NULL: none does. */
static const struct scene_motion *term_of(const struct scene_body *b)
{
    for (int i = 0; i < b->motion.n; i++)
        if (b->motion.of[i].made && b->motion.of[i].absorb)
            return b->motion.of + i;
    return NULL;
}

/* NULL: the body does not absorb. Owned by the caller. */
static struct wave_absorber *absorber_of(const struct scene *c, int k, double dx)
{
    const struct scene_motion *m = term_of(c->bodies + k);
    return m ? wave_absorber_create(c, c->bodies + k, m, gauge_dx * dx) : NULL;
}

/* Whether water stands at the start where the gauge is. */
static bool is_wet(const struct scene *c, const struct wave_absorber *a)
{
    const struct exact e = exact_create(c);
    const int up = scene_still_axis(c);
    double x[3] = {a->at[0], a->at[1], a->at[2]};
    x[up] += 0.1 * a->depth * (c->fluid.gravity[up] < 0.0 ? -1.0 : 1.0);
    for (int i = 0; i < c->domain.dim; i++)
        if (!(x[i] > c->domain.min[i] && x[i] < c->domain.max[i]))
            return false;
    return scene_is_fluid(c, &e, x, NULL);
}

void paddles_check(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    for (int k = 0; k < r->scene.nbodies; k++) {
        struct wave_absorber *a = absorber_of(&r->scene, k, prm->dx);
        char key[64];
        if (!a)
            continue;
        snprintf(key, sizeof key, "bodies.[%d].motion", k);
        if (r->coupled && r->scene.has_fv)
            params_fault(r->params, f, key,
                         "in a coupled job fv does not know where a paddle goes that absorbs "
                         "(absorb): leave that out");
        else if (a->k * a->distance > 1.0)
            params_fault(r->params, f, key,
                         "the gauge of a paddle that absorbs stands %g m (2 sph.dx) before its "
                         "face, %.2g of a wave length: sph.dx = %.3g m or less",
                         a->distance, 0.5 / M_PI * a->k * a->distance,
                         digits_below(1.0 / (gauge_dx * a->k), 3));
        else if (!is_wet(&r->scene, a))
            params_fault(r->params, f, key,
                         "a paddle that absorbs reads the level %g m before its face, and no water "
                         "stands there, at (%g, %g, %g) m: move the paddle",
                         a->distance, a->at[0], a->at[1], a->at[2]);
        FREE(a);
    }
}

void paddles_describe(const struct run *r, const struct sph_params *prm)
{
    for (int k = 0; k < r->scene.nbodies; k++) {
        struct wave_absorber *a = absorber_of(&r->scene, k, prm->dx);
        if (!a)
            continue;
        log_say("%s absorbs by a gauge %g m before its face: of waves of 0.7, 1, 1.4 and 2 times "
                "the frequency %.2g, %.2g, %.2g and %.2g %% of the height come back",
                r->scene.bodies[k].name, a->distance,
                100.0 * wave_absorber_returns(a, 0.7 * a->omega),
                100.0 * wave_absorber_returns(a, a->omega),
                100.0 * wave_absorber_returns(a, 1.4 * a->omega),
                100.0 * wave_absorber_returns(a, 2.0 * a->omega));
        FREE(a);
    }
}

void paddles_create(struct sph *s)
{
    for (int k = 0; k < s->walls->nbodies; k++) {
        struct body *b = s->walls->bodies + k;
        if (!term_of(b->is))
            continue;
        if (s->coarser) {
            b->paddle = s->coarser->walls->bodies[k].paddle;
        } else {
            b->paddle = NEW_IN(s->walls, struct paddle, 1);
            b->paddle->absorber = mem_own(b->paddle, absorber_of(&s->run->scene, k, s->dx));
            b->paddle->steer.axis = b->paddle->absorber->axis;
        }
        b->drive.steer = &b->paddle->steer;
    }
}

/* m: at the still level, of all of the body's motion. */
static double displacement_of(const struct body *b, const struct wave_absorber *a)
{
    return (a->axis < AXIS_RX ? b->now.x[a->axis] : b->now.r[a->axis - AXIS_RX]) / a->per;
}

/* Its place and velocity at t, with another acceleration from there on. */
static void turn_to(struct body_steer *s, double t, double acceleration)
{
    const double later = t - s->at;
    s->d += later * (s->v + 0.5 * later * s->a);
    s->v += later * s->a;
    s->a = acceleration;
    s->at = t;
}

static void steer_one(struct sph *s, const struct body *b, double dt)
{
    struct paddle *p = b->paddle;
    struct wave_absorber *a = p->absorber;
    double at[3];
    turn_to(&p->steer, s->t, 0.0);
    const double X = displacement_of(b, a), x = p->steer.d / a->per, v = p->steer.v / a->per;
    memcpy(at, a->at, sizeof at);
    vec3_add(at, X, a->along);
    const double over = level_gauge(s, at) - a->still - wave_absorber_wanted(a, s->t, X, X - x),
                 e = over - p->mean;
    p->mean += dt * a->mean_rate * e;
    p->steer.a = a->per * ((-a->gain * e - v - a->rate * x) / a->lag - a->rate * v);
}

void paddles_steer(struct sph *s, double dt)
{
    for (int k = 0; s->walls && k < s->walls->nbodies; k++)
        if (s->walls->bodies[k].paddle)
            steer_one(s, s->walls->bodies + k, dt);
}

/* --- restart --- */

enum { PADDLE_ROW = 6 }; /* body, time, place, velocity, acceleration, mean */

bool paddles_restart(struct sph *s, struct h5 *f)
{
    double rows[BODIES_MAX][PADDLE_ROW];
    int n = 0;
    for (int k = 0; s->walls && k < s->walls->nbodies; k++) {
        const struct paddle *p = s->walls->bodies[k].paddle;
        if (!p)
            continue;
        const double row[PADDLE_ROW] = {k,          p->steer.at, p->steer.d,
                                        p->steer.v, p->steer.a,  p->mean};
        memcpy(rows[n++], row, sizeof row);
    }
    bool fits = n == 0 ||
                h5_keep_rows(f, "paddles", "state of paddles that absorb", n, PADDLE_ROW, rows[0]);
    if (n == 0 || h5_writes(f))
        return fits;
    for (int i = 0; fits && i < n; i++) {
        const double *row = rows[i];
        struct paddle *p = s->walls->bodies[(int)row[0]].paddle;
        fits = p != NULL;
        if (!p)
            continue;
        p->steer.at = row[1];
        p->steer.d = row[2];
        p->steer.v = row[3];
        p->steer.a = row[4];
        p->mean = row[5];
    }
    for (struct sph *q = s; q; q = q->finer)
        q->walls->t = -INFINITY; /* they stand where they stood without it */
    return fits;
}

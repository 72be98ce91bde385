/* rest_forces.c - where the water around a body is at rest the force that the fluid loses to it and
 * the kernel average of the pressure on its surface are two estimates of one figure. Their
 * difference is told over the pressure times the area of the side that bears most. Means of samples
 * in a row, for sound passes through both.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sph_watch.h"

#include "../bodies/sph_bodies.h"
#include "../sph.h"
#include "../walls/sph_walls.h"

enum { SAMPLES = 6 };

static const double at_rest = 0.02; /* rho U^2 over the mean pressure on the body */

bool sph_watch_has_forces(const struct run *r, const struct sph_params *prm)
{
    return r->scene.nbodies > 0 && prm->walls == WALLS_NFM;
}

/* Adds a sample of body k, or forgets those before where it is not at rest in water at rest. */
static void add_sample(struct sph *s, int k, double U)
{
    struct rest_forces *r = s->watch.still + k;
    struct force lost;
    double pushed;
    if (!forces_of(s, k, &lost))
        return;
    const struct force average = body_average_pushed(s, k, &pushed, &r->pressure);
    if (!(s->rho0 * U * U < at_rest * r->pressure)) {
        *r = (struct rest_forces){.pressure = r->pressure};
        return;
    }
    for (int a = 0; a < s->dim; a++)
        r->off[a] += lost.F[a] - average.F[a];
    r->pushed += pushed;
    r->n++;
}

/* Of a body that has its samples: how far the two are apart, if that is more than `worst'; begins
 * anew. */
static void judge_body(struct sph *s, int k, struct rest_forces *worst)
{
    struct rest_forces *r = s->watch.still + k, mean = *r;
    double off = 0.0;
    if (r->n < SAMPLES)
        return;
    for (int a = 0; a < s->dim; a++)
        off = fmax(off, fabs(r->off[a]) / r->pushed);
    *r = (struct rest_forces){.pressure = r->pressure};
    if (off > worst->share) {
        *worst = mean;
        worst->share = off;
        worst->body = k;
    }
}

/* Writes the place and the remedy: body, mean difference over the samples, N, and dx. */
static void say(struct sph *s, const struct rest_forces *w)
{
    char text[3][32];
    for (int a = 0; a < 3; a++)
        snprintf(text[a], sizeof text[a], "%s%.3g", a > 0 ? ", " : "", w->off[a] / w->n);
    snprintf(s->watch.still_place, sizeof s->watch.still_place,
             "body %s: force less average (%s%s%s) N; few particles stand between it and a wall, "
             "or along it: refine sph.dx = %.4g m",
             s->run->scene.bodies[w->body].name, text[0], text[1], s->dim == 3 ? text[2] : "",
             s->dx);
}

/* A body counts while rho U^2, with U the largest speed of fluid and walls, is below 2 % of the
 * mean pressure on it: then the flow's own pressure is too small to explain a difference. SAMPLES
 * of these in a row are averaged before a verdict. */
void sph_watch_rest_forces(struct sph *s, double t, struct diagnosis *d)
{
    struct sph_watch *w = &s->watch;
    struct rest_forces worst = {.share = 0.0};
    const double U = fmax(s->step.max_speed, s->walls ? s->walls->speed : 0.0);
    bool any = false;
    for (int k = 0; s->walls && k < s->walls->nbodies; k++) {
        struct rest_forces *r = w->still + k;
        if (r->pressure > 0.0 && !(s->rho0 * U * U < at_rest * r->pressure)) {
            *r = (struct rest_forces){.pressure = r->pressure};
            continue; /* not asked for what moves */
        }
        add_sample(s, k, U);
        any = any || r->n >= SAMPLES;
        judge_body(s, k, &worst);
    }
    if (!any)
        return;
    if (worst.share > w->of[SPH_WATCH_FORCES].warn)
        say(s, &worst);
    watch_judge(w->of + SPH_WATCH_FORCES, worst.share, t, s->run->step, d);
}

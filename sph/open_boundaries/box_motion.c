/* box_motion.c - see box_motion.h. The displacement z->way is known beforehand (a velocity, a
 * driven body: box_motion_foretold), or only as the run goes on (a free body, a crest).
 * box_motion_step is called after the positions of a step, before zones_openings, so that faces,
 * zones and partition stand where the particles are looked at.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "box_motion.h"

#include "../../common/scene/scene.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../rigid/sph_rigid.h"
#include "../walls/sph_walls.h"
#include "box_tracking.h"
#include "openings.h"
#include "zones.h"

const char *box_motion_key(const struct sph_params *prm)
{
    return prm->box_follows[0] ? "sph.box_follows" : "sph.box_velocity";
}

bool box_motion_wanted(const struct sph_params *prm)
{
    const double *v = prm->box_velocity;
    return v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0 || prm->box_follows[0];
}

/* Whether the box follows a crest, which nobody knows beforehand. */
static bool chases(const struct sph_params *prm)
{
    return strcmp(prm->box_follows, BOX_TRACKING) == 0;
}

bool box_motion_along(const struct run *r, const struct sph_params *prm, int a)
{
    bool open[6];
    double still[3];
    sph_params_open(r, prm, open);
    scene_still_gravity(&r->scene, still);
    if (chases(prm) && still[a] != 0.0)
        return false;
    return box_motion_wanted(prm) && open[2 * a] && open[2 * a + 1] &&
           (prm->box_follows[0] || prm->box_velocity[a] != 0.0);
}

/* The body that the box follows; -1: none of that name. */
static int body_of(const struct run *r, const struct sph_params *prm)
{
    for (int k = 0; k < r->scene.nbodies; k++)
        if (strcmp(r->scene.bodies[k].name, prm->box_follows) == 0)
            return k;
    return -1;
}

/* m: how far the body's centre is from where the case has it. */
static void way_of_body(const struct body *b, double way[3])
{
    double to[3] = {0.0, 0.0, 0.0};
    body_place(b, b->centre, to);
    for (int a = 0; a < b->dim; a++)
        way[a] = to[a] - b->centre[a];
}

/* Only along axes on which it moves. */
static void mask(const struct run *r, const struct sph_params *prm, double way[3])
{
    for (int a = 0; a < 3; a++)
        if (a >= r->scene.domain.dim || !box_motion_along(r, prm, a))
            way[a] = 0.0;
}

/* false: nobody knows, way is 0. A body of its own is made and moved, since the run's may not exist
 * yet. */
bool box_motion_foretold(const struct run *r, const struct sph_params *prm, double t, double way[3])
{
    bool known = true;
    for (int a = 0; a < 3; a++)
        way[a] = prm->box_velocity[a] * t;
    if (!box_motion_wanted(prm))
        return true;
    if (chases(prm))
        return false;
    const int k = body_of(r, prm);
    if (prm->box_follows[0] && k >= 0) {
        struct body b;
        body_create(&b, r->scene.bodies + k, scene_body_mesh(&r->scene, k), r->scene.domain.dim,
                    r->motions);
        known = !b.free;
        if (known) {
            body_move(&b, t);
            way_of_body(&b, way);
        }
        body_destroy(&b);
    }
    mask(r, prm, way);
    return known;
}

/* Of a driven body that of its centre along the axes on which the box moves. */
double box_motion_speed(const struct run *r, const struct sph_params *prm)
{
    double way[3];
    if (!box_motion_wanted(prm))
        return 0.0;
    if (chases(prm))
        return box_tracking_speed(r);
    const int k = prm->box_follows[0] ? body_of(r, prm) : -1;
    if (k < 0) { /* the same bits whenever the run ends */
        box_motion_foretold(r, prm, 1.0, way);
        return vec3_length(way);
    }
    struct body b;
    body_create(&b, r->scene.bodies + k, scene_body_mesh(&r->scene, k), r->scene.domain.dim,
                r->motions);
    const struct body_speeds of = body_drive_speeds(&b.drive, 0.0, r->scene.time.end);
    const bool known = !b.free;
    memcpy(way, of.along, sizeof way);
    body_destroy(&b);
    mask(r, prm, way);
    return known ? fmin(vec3_length(way), of.any) : prm->speed.speed;
}

/* Region, zones, faces and partition of all levels stand where z->way says. */
static void place(struct sph *s)
{
    struct zones *z = s->zones;
    for (struct sph *q = s; q; q = q->finer)
        for (int a = 0; a < s->dim; a++) {
            q->lo[a] = s->prm.box[0][a] + z->way[a];
            q->hi[a] = s->prm.box[1][a] + z->way[a];
        }
    memcpy(z->lo, s->lo, sizeof z->lo);
    memcpy(z->hi, s->hi, sizeof z->hi);
    memcpy(z->openings->lo, s->lo, sizeof z->openings->lo);
    memcpy(z->openings->hi, s->hi, sizeof z->openings->hi);
    openings_find_room(s, z->openings);
    domain_follow(s);
}

/* Of a box that has come within a support of a side that it does not share. */
static void judge(const struct sph *s, struct diagnosis *d)
{
    const struct scene_domain *c = &s->run->scene.domain;
    for (int a = 0; a < s->dim; a++) {
        if (c->periodic[a] || s->zones->speed[a] == 0.0 ||
            (s->lo[a] > c->min[a] + s->R && s->hi[a] < c->max[a] - s->R))
            continue;
        d->bad = true;
        snprintf(d->reason, sizeof d->reason, "sph.box has come to a side of the domain across %c",
                 "xyz"[a]);
        snprintf(d->where, sizeof d->where, "%c from %g to %g m, t = %.4g s", "xyz"[a], s -> lo[a],
                 s -> hi[a], s -> t);
        snprintf(d->likely, sizeof d->likely,
                 "a shorter time.end, a larger domain, or another sph.box_velocity or box_follows");
    }
}

/* dt 0 at the start: the place alone, no speed. */
void box_motion_step(struct sph *s, double dt, struct diagnosis *d)
{
    struct zones *z = s->zones;
    double now[3] = {0.0, 0.0, 0.0};
    if (!box_motion_wanted(&s->prm))
        return;
    if (chases(&s->prm)) {
        memcpy(now, z->way, sizeof now);
        box_tracking_step(s, dt, z->along, now);
    } else if (s->prm.box_follows[0])
        way_of_body(s->walls->bodies + body_of(s->run, &s->prm), now);
    else
        for (int a = 0; a < s->dim; a++)
            now[a] = s->prm.box_velocity[a] * s->t;
    mask(s->run, &s->prm, now);
    for (int a = 0; a < 3; a++) {
        z->speed[a] = dt > 0.0 ? (now[a] - z->way[a]) / dt : 0.0;
        z->way[a] = now[a];
    }
    place(s);
    judge(s, d);
}

/* At a restart: the place, m from that of the case; its speed follows from the next step. */
void box_motion_set(struct sph *s, const double way[3])
{
    if (!box_motion_wanted(&s->prm))
        return;
    memcpy(s->zones->way, way, sizeof s->zones->way);
    place(s);
}

/* All that the box may reach until the end, for what is made once for the whole run; of unknown
 * motion the whole domain, and a period more where it is periodic. */
void box_motion_range(const struct sph *s, double lo[3], double hi[3])
{
    const struct scene_domain *d = &s->run->scene.domain;
    const double end = s->run->scene.time.end;
    double way[3];
    memcpy(lo, s->lo, sizeof s->lo);
    memcpy(hi, s->hi, sizeof s->hi);
    if (!box_motion_wanted(&s->prm))
        return;
    const bool known = box_motion_foretold(s->run, &s->prm, end, way) && !s->prm.box_follows[0];
    for (int a = 0; a < s->dim; a++) {
        if (!box_motion_along(s->run, &s->prm, a))
            continue;
        const double L = d->periodic[a] ? d->max[a] - d->min[a] : 0.0;
        lo[a] = known ? fmin(lo[a], lo[a] + way[a]) : d->min[a] - L;
        hi[a] = known ? fmax(hi[a], hi[a] + way[a]) : d->max[a] + L;
    }
}

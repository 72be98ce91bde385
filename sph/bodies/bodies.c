/* bodies.c - see bodies.h. In a stage (bodies_stage): the fluid's forces are summed by rank 0 and
 * sent to all, so that every rank has the same bits; to them come seals, lines, contacts, weight
 * and the loads of the case, then the rates (body_free.c). bodies_advance carries on with the
 * weights of the fluid's stages.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bodies.h"

#include "../open_boundaries/sph_open_boundaries.h"
#include "../particles/sph_particles.h"
#include "../rigid/sph_rigid.h"
#include "body_courses.h"
#include "paddles.h"

/* --- the start --- */

/* Called for each level, the coarsest first: its bodies are those of all levels, and lambda goes by
 * the finest dx. */
void bodies_create(struct sph *s)
{
    struct walls *w = s->walls;
    const double dt = sph_params_dt(&s->prm, s->nu, s->c0, NULL);
    if (!w)
        return;
    paddles_create(s);
    body_courses_create(s);
    for (int k = 0; k < w->nbodies; k++)
        w->forces.reference[k] = body_reference(s, k);
    for (int k = 0; k < w->nbodies; k++)
        if (w->bodies[k].free) {
            double *lambda = &w->bodies[k].free->lambda;
            *lambda = fmax(*lambda,
                           impedance_stopping_rate(w->bodies + k, s->rho0 * s->c0, s->rho0 * s->nu,
                                                   s->dx)); /* of the finest level */
            if (!s->coarser)
                body_lines_slack(w->bodies + k);
        }
    w->dt_contact = fmin(dt, bodies_dt(s));
    body_contacts_start(s);
    body_wedges_find(s);
}

/* An explicit step bears lambda dt up to 2. */
double bodies_dt(const struct sph *s)
{
    double dt = INFINITY;
    for (int k = 0; s->walls && k < s->walls->nbodies; k++)
        if (s->walls->bodies[k].free)
            dt = fmin(dt, 2.0 / s->walls->bodies[k].free->lambda);
    return dt;
}

/* --- a step --- */

/* Reference forces depend on where a body is; they are taken once a step. */
void bodies_begin(struct sph *s)
{
    for (int k = 0; s->walls && k < s->walls->nbodies; k++) {
        struct body *b = s->walls->bodies + k;
        if (b->moves)
            s->walls->forces.reference[k] = body_reference(s, k);
        if (!b->free)
            continue;
        body_hold(b, s->t);
        memcpy(b->free->y0, b->free->y, sizeof b->free->y0);
        memset(b->free->sum, 0, sizeof b->free->sum);
    }
}

/* What the fluid gives to each body in this stage: [N], [N m]. */
static void fluid_loads(struct sph *s, double weight, double (*loads)[6])
{
    struct walls *w = s->walls;
    struct force given[BODIES_MAX];
    const int n = BODIES_MAX * (int)(sizeof *given / sizeof(double));
    const bool root = s->run->rank == 0;
    memcpy(given, w->forces.stage, sizeof given);
    /* the same bits on all ranks, whatever a reduction to all would do */
    MPI_Reduce(root ? MPI_IN_PLACE : (void *)given, given, n, MPI_DOUBLE, MPI_SUM, 0, s->run->comm);
    MPI_Bcast(given, n, MPI_DOUBLE, 0, s->run->comm);
    for (int k = 0; k < w->nbodies; k++) {
        struct body *b = w->bodies + k;
        if (!b->free)
            continue;
        vec3_add(given[k].F, 1.0, w->forces.reference[k].F);
        vec3_add(given[k].M, 1.0, w->forces.reference[k].M);
        memcpy(loads[k], given[k].F, sizeof given[k].F);
        memcpy(loads[k] + 3, given[k].M, sizeof given[k].M);
        if (b->is->force_rule == FORCE_AVERAGE) {
            const struct force by = body_average(s, k);
            memcpy(loads[k], by.F, sizeof by.F);
            memcpy(loads[k] + 3, by.M, sizeof by.M);
        }
        forces_add_turning(s, k, loads[k] + 3);
        vec3_add(b->free->impulse[0], weight, given[k].F);
        vec3_add(b->free->impulse[1], weight, loads[k]);
        b->free->size += weight * vec3_length(given[k].F);
        memcpy(b->free->force, loads[k], sizeof b->free->force);
    }
}

/* Lines and contacts add to the loads of two bodies, so all of them come before the rates of any.
 * weight, s: of the stage in the step. */
void bodies_stage(struct sph *s, double weight)
{
    struct walls *w = s->walls;
    double loads[BODIES_MAX][6];
    if (!w || !w->any_free)
        return;
    memset(loads, 0, sizeof loads);
    fluid_loads(s, weight, loads);
    for (int k = 0; k < w->nbodies; k++)
        if (w->bodies[k].free) {
            memset(w->bodies[k].free->contact, 0, sizeof w->bodies[k].free->contact);
            body_lines_add(&s->run->scene, w->bodies, k, loads);
        }
    body_contacts_add(s, loads);
    for (int k = 0; k < w->nbodies; k++) {
        struct body *b = w->bodies + k;
        if (!b->free)
            continue;
        vec3_add(loads[k], b->free->mass, s->run->scene.fluid.gravity);
        vec3_add(loads[k], 1.0, b->is->load);
        vec3_add(loads[k] + 3, 1.0, b->is->torque);
        body_rates(b, loads[k], loads[k] + 3);
    }
}

/* ahead, s: from the step's start to where the next stage stands; the last stage takes the weighted
 * sum of all rates. */
void bodies_advance(struct sph *s, double ahead, double weight, bool last)
{
    for (int k = 0; s->walls && k < s->walls->nbodies; k++) {
        struct body_free *f = s->walls->bodies[k].free;
        for (int i = 0; f && i < BODY_STATE; i++) {
            f->sum[i] += weight * f->rate[i];
            f->y[i] = f->y0[i] + (last ? f->sum[i] : ahead * f->rate[i]);
        }
    }
}

/* --- after it --- */

/* Particles that were put back from behind a body have left their impulse. */
static void take_hits(struct sph *s)
{
    struct walls *w = s->walls;
    for (int k = 0; k < w->nbodies; k++) {
        const struct force *hit = w->forces.hit + k;
        if (w->bodies[k].free && w->bodies[k].is->force_rule == FORCE_CONSERVING)
            body_hit(w->bodies + k, hit->F, hit->M);
    }
}

/* Where a body may be: beyond open sides the flow is somebody else's, who has no bodies; m. A box
 * that follows something has moved by s->lo - prm->box since the case gave it. */
static void room_of(const struct sph *s, double lo[3], double hi[3])
{
    const struct sph_params *prm = &s->prm;
    if (s->zones && prm->outer == OUTER_PARTNER)
        zones_given_box(s->run, prm, lo, hi);
    else if (s->zones)
        zones_free_box(s->run, prm, lo, hi);
    for (int a = 0; a < 3; a++) {
        lo[a] = s->zones ? lo[a] + s->lo[a] - prm->box[0][a] : s->lo[a];
        hi[a] = s->zones ? hi[a] + s->hi[a] - prm->box[1][a] : s->hi[a];
    }
}

static void say_out(const struct sph *s, const struct body *b, const double *x, int axis,
                    struct diagnosis *d)
{
    const bool inside = x[axis] >= s->lo[axis] && x[axis] <= s->hi[axis],
               coupled = s->prm.outer == OUTER_PARTNER;
    d->bad = true;
    snprintf(d->reason, sizeof d->reason, "body %s leaves %s", b->is->name,
             !inside   ? "the region of the particles"
             : coupled ? "what fv, which has no bodies, takes from the particles"
                       : "the free zone of the particles");
    snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, across %c", x[0], x[1],
             s->dim == 3 ? x[2] : 0.0, "xyz"[axis]);
    snprintf(d->likely, sizeof d->likely, "%s",
             s->periodic[axis] ? "a body may come up to a periodic side, not through it: walls "
                                 "there, or a larger domain"
             : !inside         ? "a larger domain, or walls that hold it"
             : coupled         ? "a larger sph.box, one that follows the body (sph.box_follows), "
                                 "or an earlier time.end"
                               : "openings farther away, or an earlier time.end");
}

/* A body that leaves its room, or is no longer a number. Contact with a side is a spring: what is
 * pressed on it goes some thousandths of dx beyond, with others on its back some more. */
static void judge(const struct sph *s, const struct body *b, struct diagnosis *d)
{
    const int n = body_corners(b);
    const double small = (b->free ? 0.1 : 1e-6) * s->dx;
    double lo[3], hi[3];
    room_of(s, lo, hi);
    for (int k = 0; k < n && !d->bad; k++) {
        double x[3] = {0.0, 0.0, 0.0};
        body_corner(b, k, x);
        for (int a = 0; a < s->dim && !d->bad; a++)
            if (!(x[a] >= lo[a] - small && x[a] <= hi[a] + small))
                say_out(s, b, x, a, d);
    }
}

/* Impulses of particles that were put back come before the contacts' memory and the check of
 * places; hits are taken once. */
void bodies_finish(struct sph *s, struct diagnosis *d)
{
    const bool any_free = s->walls && s->walls->any_free;
    const bool roams =
        s->zones && box_motion_wanted(&s->prm); /* the box may leave a body at rest */
    if (any_free) {
        take_hits(s);
        body_contacts_finish(s);
        memset(s->walls->forces.hit, 0, sizeof s->walls->forces.hit);
    }
    for (int k = 0; s->walls && k < s->walls->nbodies; k++) {
        struct body *b = s->walls->bodies + k;
        if (b->free)
            body_finish(b);
        if (b->free || b->paddle || b->course || roams)
            judge(s, b, d);
    }
}

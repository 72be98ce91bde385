/* look.c - what regions follow: positions of bodies, the largest pressure, the criteria's
 * indicators. Called at the end of a step's stages, from integrate.c, with the packed records and
 * slopes of the last stage, or from life.c with local steps. Regions move by what is set here
 * (regions_move). Sums and maxima are over all ranks, so every rank moves its copy of the regions
 * alike.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../open_boundaries/sph_open_boundaries.h"
#include "../pairs/sph_pairs.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../surface/sph_surface.h"
#include "../walls/sph_walls.h"
#include "criteria.h"
#include "refinement.h"

/* Pressure of particle i with the linear part that the particles leave out, Pa. */
static double pressure_of_particle(const struct sph *s, int i)
{
    const double *q = prim_line(&s->p, i);
    return scene_reference_at(&s->reference, s->dim, q) +
           eos_p(q[at_rho(s->dim)], s->rho0, s->c0, s->gamma);
}

/* Sets the position of the largest pressure among all flowing particles from s on; of equal ones
 * the lowest rank's. Collective. */
static void find_peak(struct regions *g, const struct sph *s)
{
    double most = -INFINITY, x[3] = {0.0, 0.0, 0.0};
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++)
            if (!particles_is_guard(&q->p, i) && pressure_of_particle(q, i) > most) {
                most = pressure_of_particle(q, i);
                memcpy(x, prim_line(&q->p, i), (size_t)q->dim * sizeof *x);
            }
    most = ranks_most(s->run->comm, most, x, sizeof x);
    if (isfinite(most))
        regions_set_peak(g, x, most);
}

/* Largest jump of p between i and its neighbours when both are continued to the middle with their
 * slopes, Pa. c^2 drho stands for dp. Padding is not read, for the loop ends at count. */
static double largest_jump(const struct sph *s, int i, double c)
{
    const struct neighbours *l = s->list;
    const double *x = prim_line(&s->p, i), *g = slope_line(&s->p, i);
    double most = 0.0;
    for (int64_t k = l->start[i]; k < l->start[i] + l->count[i]; k++) {
        const double *y = prim_line(&s->p, l->j[k]), *h = slope_line(&s->p, l->j[k]);
        double r2 = 0.0, drho = y[at_rho(s->dim)] - x[at_rho(s->dim)];
        for (int a = 0; a < s->dim; a++) {
            const double d = y[a] - x[a];
            r2 += d * d;
            drho -= 0.5 * (g[a] + h[a]) * d;
        }
        if (r2 < s->R * s->R)
            most = fmax(most, fabs(drho));
    }
    return most * c * c;
}

/* The indicators of particle i: |u|, |curl u|, |grad p| = c^2 |grad rho|, the jump if `jumps', and
 * whether it is on the surface. */
static struct flow_sample sample(const struct sph *s, int i, bool jumps)
{
    const double *q = prim_line(&s->p, i), *slope = slope_line(&s->p, i);
    struct flow_sample to = {.volume = q[at_volume(s->dim)], .rho = q[at_rho(s->dim)]};
    const double c = eos_c(to.rho, s->rho0, s->c0, s->gamma);
    double w[3];
    sph_vorticity(s, i, w);
    for (int a = 0; a < 3; a++)
        to.curl += w[a] * w[a];
    for (int a = 0; a < s->dim; a++) {
        to.speed += q[s->dim + a] * q[s->dim + a];
        to.slope += slope[a] * slope[a];
    }
    to.curl = sqrt(to.curl);
    to.speed = sqrt(to.speed);
    to.slope = c * c * sqrt(to.slope);
    to.jump = jumps ? largest_jump(s, i, c) : 0.0;
    to.on_surface = s->surface && s->surface->is[i] == SURFACE_ON;
    return to;
}

/* Enters the indicators of all flowing particles of all levels and has the criteria evaluated.
 * Collective. */
static void ask_criteria(struct sph *s)
{
    struct regions *g = s->refinement->regions;
    const double *f = s->gravity;
    const bool jumps = criteria_want_jumps(g);
    for (struct sph *q = s; q && jumps; q = q->finer) { /* at the start ghosts have no slopes yet */
        domain_halo_start(q, true);
        domain_halo_finish(q, true);
    }
    criteria_begin(g, s->step.max_speed, vec3_length(f));
    for (const struct sph *q = s; q; q = q->finer)
        for (int i = 0; i < q->p.n; i++) {
            if (particles_is_guard(&q->p, i))
                continue;
            const struct flow_sample is = sample(q, i, jumps);
            criteria_add(g, prim_line(&q->p, i), &is);
        }
    criteria_end(g, s->t, s->c0);
}

/* Whether what flows is near the free surface, for the guards that take from it. */
static void mark_surface(struct sph *s)
{
    for (int i = 0; i < s->p.n && s->surface; i++) {
        const bool near = !particles_is_guard(&s->p, i) && s->surface->is[i] != SURFACE_INNER;
        s->p.role[i] = (unsigned short)((s->p.role[i] & ~ROLE_SURFACE) | (near ? ROLE_SURFACE : 0));
    }
}

/* Reports where body k is. Regions refer to the centre that the case has, while a free body moves
 * about its centre of mass, so the displacement is that of the former. */
static void tell_place(struct regions *g, const struct body *b, int k)
{
    struct body_motion now = b->now;
    double x[3] = {0.0, 0.0, 0.0};
    body_place(b, b->is->centre, x);
    for (int a = 0; a < b->dim; a++)
        now.x[a] = x[a] - b->is->centre[a];
    regions_set_body(g, k, &now);
}

/* `outside' is the coarsest level whose regions may move now; it and the finer ones are at one
 * time. */
void refinement_follow(struct sph *s, struct sph *outside)
{
    struct regions *g = s->refinement->regions;
    for (struct sph *q = outside; q; q = q->finer)
        mark_surface(q);
    for (int k = 0; s->walls && k < s->walls->nbodies; k++)
        tell_place(g, outside->walls->bodies + k, k);
    if (s->zones)
        regions_set_box(g, s->zones->way);
    if (regions_want_peak(g))
        find_peak(g, outside);
}

/* Criteria are evaluated when they are due, which is less often than once a step. */
void refinement_look(struct sph *s)
{
    struct regions *g = s->refinement->regions;
    timer_start(&s->run->timers, "levels");
    refinement_follow(s, s);
    if (criteria_due(g, s->t))
        ask_criteria(s);
    timer_stop(&s->run->timers, "levels");
}

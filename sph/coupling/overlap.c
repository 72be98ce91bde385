/* overlap.c - whether both programs still describe one flow. Once a coupling step, at its start:
 * over the particles of the overlap, where both programs are free, the rms differences
 *   du = (sum w |u - u_fv|^2 / sum w)^(1/2) / U
 *   dp = (sum w (p - p_fv - mean)^2 / sum w)^(1/2) / (rho max(U^2, weight)),
 * weight = g H under a surface, averaged over about ten coupling steps, and the share of the open
 * faces with a free surface before them where fv has none. Beyond a warning level it is reported,
 * beyond another the run ends.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "overlap.h"

#include "../open_boundaries/sph_open_boundaries.h"
#include "../particles/sph_particles.h"
#include "../surface/sph_surface.h"
#include "windows.h"

/* Windows over which differences are averaged: sound of an impact or of a sudden start, up to rho
 * c0 U, passes through SPH alone and is no fault. */
static const double several = 10.0;

/* Share of c0 that velocities beside a surface are measured in at least, unless the case gives U:
 * what particles have there of noise says nothing about a slow stream. */
static const double noise = 0.03;

/* Counts this rank's particles on a surface in transition and buffer; called in a stage, when the
 * surface has just been detected, once a coupling step. */
static void find_surface(struct sph *s)
{
    struct overlap *o = s->zones->watched;
    if (!o->asks || !s->surface || s->zones->surface)
        return;
    o->asks = false;
    o->found = 0.0;
    for (int i = 0; i < s->p.n; i++)
        if (s->surface->is[i] == SURFACE_ON && s->p.zone[i] != ZONE_FREE) {
            o->found += 1.0;
            memcpy(o->where, state_row(&s->p, s->p.y, i), (size_t)s->dim * sizeof *o->where);
        }
}

/* Scales are those of windows.c. Without weight rho U^2 is small against acoustic noise, whose
 * scale is rho c0 U: hence bounds in c0/U. */
struct overlap *overlap_create(struct sph *s)
{
    s->zones->look_inside = find_surface;
    struct overlap *o = NEW(struct overlap, 1);
    const struct windows w = windows_choose(s->run, &s->prm);
    const struct scene_coupling *c = &s->run->scene.coupling;
    const char *mend =
        c->steps || c->memory
            ? "the programs drift apart: set coupling.steps and coupling.memory to 0, widen "
              "coupling.overlap, or move sph.box so that its open sides lie in calmer flow"
            : "the programs drift apart: start the flow by initial.field, where an inlet would "
              "start it at once, widen coupling.overlap, or move sph.box so that its open sides "
              "lie in calmer flow";
    const bool given = s->run->params && params_given(s->run->params, "initial.U");
    o->U = s->run->crossed && !given ? fmax(w.U, noise * s->c0) : w.U;
    o->p = s->rho0 * fmax(w.U * w.U, w.weight);
    o->velocity = (struct watch){
        .key = "overlap_velocity",
        .what = "velocities of sph and fv where both are free, difference over the flow's scale",
        .likely = mend,
        .warn = 0.15,
        .stop = 0.4};
    o->pressure = (struct watch){
        .key = "overlap_pressure",
        .what = "pressures of sph and fv where both are free, difference over the flow's scale",
        .likely = mend,
        .warn = w.weight > 0.0 ? 0.25 : 0.1 * s->c0 / w.U,
        .stop = w.weight > 0.0 ? 0.5 : 0.3 * s->c0 / w.U}; /* rho U^2 is little beside the noise */
    o->dry = (struct watch){
        .key = "surface_in_zones",
        .what = "share of the open sides in front of which a free surface lies in the transition",
        .likely = "fv has no surface there: move the open sides of sph.box deeper into the water, "
                  "or make coupling.transition and coupling.buffer thinner",
        .warn = 0.02,
        .stop = 0.1};
    return o;
}

/* Whether a particle is in the border of the free zone where the partner is free, too; all ranks of
 * SPH have the partner's patch there. */
static bool in_rim(const struct sph *s, const double *y)
{
    const struct zones *z = s->zones;
    const double depth = zones_depth(s, y), edge = z->transition + z->buffer;
    return depth >= edge && depth < edge + z->overlap;
}

/* Sums over the rim: w, w |du|^2, w dp, w dp^2. With a surface in fv's field positions above it, or
 * within dx of it, are left out. */
static void compare(struct sph *s, double sums[4])
{
    struct zones *z = s->zones;
    const int dim = s->dim;
    z->n = 0;
    for (int i = 0; i < s->p.n; i++)
        if (in_rim(s, state_row(&s->p, s->p.y, i)))
            zones_list(s, i);
    zones_look(z, s->t, false);
    for (int k = 0; k < z->n; k++) {
        const double *y = state_row(&s->p, s->p.y, z->who[k]), w = y[at_volume(dim)];
        const double m = y[at_mass(dim)];
        if (z->surface && z->phi[k] > -s->dx)
            continue;
        const double dp = eos_p(m / w, s->rho0, s->c0, s->gamma) - z->p[k];
        for (int a = 0; a < dim; a++) {
            const double du = y[dim + a] / m - z->u[dim * k + a];
            sums[1] += w * du * du;
        }
        sums[0] += w;
        sums[2] += w * dp;
        sums[3] += w * dp * dp;
    }
}

/* du, dp and on are the same on all ranks afterwards. */
void overlap_look(struct sph *s)
{
    struct overlap *o = s->zones->watched;
    double sums[5] = {0.0, 0.0, 0.0, 0.0, o->found};
    compare(s, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, s->run->comm);
    if (sums[4] > 0.0)
        (void)ranks_most(s->run->comm, o->found, o->where, sizeof o->where);
    const double n = sums[0] > 0.0 ? sums[0] : 1.0, mean = sums[2] / n;
    o->du = sqrt(sums[1] / n) / o->U;
    o->dp = sqrt(fmax(sums[3] / n - mean * mean, 0.0)) / o->p;
    o->on = sums[4] / openings_faces(s->zones->openings);
    o->looks += 1.0; /* the mean of all there have been, and judged, from the first one on */
    o->du_mean += (o->du - o->du_mean) / fmin(o->looks, several);
    o->dp_mean += (o->dp - o->dp_mean) / fmin(o->looks, several);
    o->fresh = o->asks = true;
}

/* After the first step of a coupling step; the place is that of a particle on the surface, or the
 * border as a whole. */
void overlap_judge(struct sph *s, struct diagnosis *d)
{
    struct overlap *o = s->zones->watched;
    if (!o->fresh)
        return;
    o->fresh = false;
    if (watch_judge(&o->dry, o->on, s->t, s->run->step, d))
        snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, t = %.4g s", o->where[0], o->where[1],
                 o->where[2], s->t);
    if (s->zones->gap)
        level_gap_judge(s, d);
    const bool was_bad = d->bad;
    watch_judge(&o->velocity, o->du_mean, s->t, s->run->step, d);
    watch_judge(&o->pressure, o->dp_mean, s->t, s->run->step, d);
    if (d->bad && !was_bad)
        snprintf(d->where, sizeof d->where,
                 "the border of the free zone, %g m wide, t = %.4g s, step %lld", s->zones->overlap,
                 s->t, (long long)s->run->step);
}

enum { KEPT = 2, MEANS = 3 }; /* numbers of each watch; of the means that are judged */

/* Both ways: written, or read. */
void overlap_restart(struct overlap *o, struct h5 *f)
{
    struct watch *of[3] = {&o->velocity, &o->pressure, &o->dry};
    double v[3 * KEPT + MEANS] = {[3 * KEPT] = o->looks, o->du_mean, o->dp_mean};
    for (int k = 0; k < 3; k++) {
        v[KEPT * k] = of[k]->worst;
        v[KEPT * k + 1] = of[k]->warned;
    }
    if (!h5_keep_same(f, "overlap", "-", 3 * KEPT + MEANS, v) || h5_writes(f))
        return;
    o->looks = v[3 * KEPT];
    o->du_mean = v[3 * KEPT + 1];
    o->dp_mean = v[3 * KEPT + 2];
    for (int k = 0; k < 3; k++) {
        of[k]->worst = v[KEPT * k];
        of[k]->warned = v[KEPT * k + 1] != 0.0;
    }
}

void overlap_row(const struct overlap *o, struct figures *to)
{
    FIGURE(to, o->du, "overlap velocity [-]");
    FIGURE(to, o->dp, "overlap pressure [-]");
    FIGURE(to, o->on, "surface in the zones [-]");
}

void overlap_summary(const struct overlap *o, struct summary *to)
{
    watch_summary(&o->velocity, to);
    watch_summary(&o->pressure, to);
    watch_summary(&o->dry, to);
}

/* Nothing is reported while both are below half of their warning levels. */
void overlap_tell(const struct overlap *o, struct summary *to)
{
    if (o->du > 0.5 * o->velocity.warn)
        summary_real(to, "du", o->du);
    if (o->dp > 0.5 * o->pressure.warn)
        summary_real(to, "dp", o->dp);
}

/* zone_steps.c - what the flow outside imposes: buffer at every stage, transition after every step.
 * Equations [6.x] of Chiron 2017. Where pairs exchange mass (ALE) the volume w stays a particle's
 * own and follows the packing; its mass is reset to rho w. Else its mass stays and w is reset:
 * nothing else would hold w to the packing for as long as the particle is in the zone.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "zone_steps.h"

#include "../particles/sph_particles.h"
#include "births.h"
#include "box_motion.h"
#include "level_gap.h"
#include "openings.h"
#include "outer_lattice.h"
#include "sides.h"
#include "wave_outside.h"
#include "wave_stream.h"
#include "wet_faces.h"

/* The exact solution as the flow outside; the gradient of p by central differences. */
static void eval_exact(void *ctx, double t, int n, const double *x, double *u, double *p,
                       double *gu, double *gp)
{
    const struct exact *e = ctx;
    const int dim = e->dim;
    const double h = 1e-5 * (e->L > 0.0 ? e->L : 1.0);
    for (int i = 0; i < n; i++) {
        double v[3], g[3][3], q[3] = {0.0, 0.0, 0.0}, lo, hi;
        exact_point(e, x + 3 * i, t, v, p + i, NULL);
        for (int a = 0; a < dim; a++)
            u[dim * i + a] = v[a];
        if (!gu)
            continue;
        exact_gradient(e, x + 3 * i, t, g);
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < 3; b++)
                gu[3 * (dim * i + a) + b] = g[a][b];
        for (int b = 0; b < dim; b++) {
            double y[3] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
            y[b] += h;
            exact_point(e, y, t, NULL, &hi, NULL);
            y[b] -= 2.0 * h;
            exact_point(e, y, t, NULL, &lo, NULL);
            q[b] = (hi - lo) / (2.0 * h);
        }
        for (int b = 0; b < 3; b++)
            gp[3 * i + b] = q[b];
    }
}

/* A wave outside has a surface, whose level is watched. */
static void use_exact(struct sph *s, struct zones *z)
{
    struct exact *e = NEW_IN(z, struct exact, 1);
    *e = exact_create(&s->run->scene);
    z->ctx = e;
    z->eval = eval_exact;
    if (!wave_outside_wanted(s->run, &s->prm))
        return;
    z->eval = wave_outside_eval;
    z->surface = wave_outside_surface;
    z->gap = mem_own(z, level_gap_create(s, false));
}

/* Whether the flow outside has the pressure that particles have at rest near the surface. Without,
 * they push out where they meet it: a channel 8 rows deep lost 1.5 % of its level, and a box in 0.5
 * m of still water 2 to 3 mm within 4 s by a jet of the topmost row. Not where masses do not follow
 * the packing, unless a partner holds the level: alone it wanders off with them. */
static bool has_excess(const struct sph *s, const struct zones *z)
{
    return s->run->crossed || (z->surface && s->prm.scheme == SCHEME_RIEMANN_ALE);
}

/* Widths, faces and the flow outside by sph.outer: exact, of the domain's sides, or none yet (a
 * partner's, set by sph/coupling). */
struct zones *zones_create(struct sph *s)
{
    bool open = false;
    double overlap[3];
    for (int side = 0; side < 6; side++)
        open = open || s->open[side];
    if (!open)
        return NULL;
    struct zones *z = NEW(struct zones, 1);
    z->dim = s->dim;
    z->dx = s->dx;
    memcpy(z->lo, s->lo, sizeof z->lo);
    memcpy(z->hi, s->hi, sizeof z->hi);
    memcpy(z->open, s->open, sizeof z->open);
    z->level = NAN;
    zones_widths(s->run, &s->prm, &z->transition, &z->buffer);
    z->fastest = box_motion_speed(s->run, &s->prm);
    for (int a = 0; a < s->dim; a++)
        z->along[a] = box_motion_along(s->run, &s->prm, a);
    zones_overlap(s->run, &s->prm, overlap);
    z->overlap = fmin(overlap[0], fmin(overlap[1], s->dim == 3 ? overlap[2] : INFINITY));
    z->openings = mem_own(z, openings_create(s));
    z->eos = (struct sph_eos){s->rho0, s->c0, s->gamma};
    z->gap = s->run->crossed ? mem_own(z, level_gap_create(s, false)) : NULL;
    zones_counted_box(s->run, &s->prm, z->way, z->counted[0], z->counted[1]);
    if (s->prm.outer == OUTER_EXACT)
        use_exact(s, z);
    if (s->prm.outer == OUTER_SIDES)
        (wave_stream_wanted(s->run, &s->prm) ? wave_stream_create : sides_create)(s, z);
    z->R = s->R;
    z->weight = has_excess(s, z) ? s->rho0 * vec3_length(s->gravity) * s->R : 0.0;
    return z;
}

/* Lists the local particles of a zone with their places. */
static void gather(struct sph *s, enum sph_zone zone)
{
    struct zones *z = s->zones;
    const struct particles *p = &s->p;
    z->n = 0;
    for (int i = 0; i < p->n; i++)
        if (p->zone[i] == zone)
            zones_list(s, i);
}

/* Imposes u and rho: at fixed w where pairs exchange mass, else at fixed m. */
static void impose(struct sph *s, int i, const double *u, double rho)
{
    double *y = state_row(&s->p, s->p.y, i);
    const int dim = s->dim;
    if (s->prm.scheme == SCHEME_RIEMANN_ALE)
        y[at_mass(dim)] = rho * y[at_volume(dim)];
    else
        y[at_volume(dim)] = y[at_mass(dim)] / rho;
    for (int a = 0; a < dim; a++)
        y[dim + a] = y[at_mass(dim)] * u[a];
}

/* Row `from' of the list becomes row `to'. */
static void move_row(struct zones *z, int dim, int to, int from)
{
    z->who[to] = z->who[from];
    z->p[to] = z->p[from];
    z->phi[to] = z->phi[from];
    memmove(z->x + 3 * to, z->x + 3 * from, 3 * sizeof *z->x);
    memmove(z->u + dim * to, z->u + dim * from, (size_t)dim * sizeof *z->u);
    memmove(z->gp + 3 * to, z->gp + 3 * from, 3 * sizeof *z->gp);
    memmove(z->gu + 3 * dim * to, z->gu + 3 * dim * from, 3 * (size_t)dim * sizeof *z->gu);
}

/* Buffer particles in the air outside leave the list, those between are imposed in part. wet is 1
 * in the water outside, 0 from 3 dx above it. */
static void mix_with_own(struct sph *s)
{
    struct zones *z = s->zones;
    const int dim = s->dim;
    int n = 0;
    for (int k = 0; k < z->n; k++) {
        const double *y = state_row(&s->p, s->p.y, z->who[k]), m = y[at_mass(dim)];
        const double wet = zones_wet(z, z->phi[k]);
        const double own = eos_p(m / y[at_volume(dim)], s->rho0, s->c0, s->gamma);
        if (wet == 0.0)
            continue;
        move_row(z, dim, n, k);
        z->p[n] = wet * z->p[n] + (1.0 - wet) * own;
        for (int a = 0; a < dim; a++)
            z->u[dim * n + a] = wet * z->u[dim * n + a] + (1.0 - wet) * y[dim + a] / m;
        n++;
    }
    z->n = n;
}

/* In this order: what looks at the flow inside, the lattice behind the faces, the buffer. So all of
 * a stage sees the same outside. */
void zones_stage(struct sph *s)
{
    struct zones *z = s->zones;
    if (z->update)
        z->update(s);
    outer_lattice_move(s);
    gather(s, ZONE_BUFFER);
    zones_look(z, s->t, true);
    if (z->surface)
        mix_with_own(s);
    for (int k = 0; k < z->n; k++) {
        const int i = z->who[k];
        double *y = state_row(&s->p, s->p.y, i);
        /* Births and removals change the packing by jumps that div u0 does not know: volumes that
         * followed it there would wander. They wait until the particle is a support away from the
         * side. */
        if (zones_depth(s, y) < s->R)
            y[at_volume(s->dim)] = state_row(&s->p, s->p.y0, i)[at_volume(s->dim)];
        impose(s, i, z->u + s->dim * k, eos_rho(z->p[k], s->rho0, s->c0, s->gamma));
    }
}

/* Slopes of rho from those of p by the speed of sound. The list is still that of zones_stage. */
void zones_slopes(struct sph *s)
{
    const struct zones *z = s->zones;
    const int dim = s->dim;
    if (z->look_inside)
        z->look_inside(s);
    for (int k = 0; k < z->n; k++) {
        const int i = z->who[k];
        const double *x = prim_line(&s->p, i);
        double *g = slope_line(&s->p, i);
        const double c = eos_c(x[at_rho(dim)], s->rho0, s->c0, s->gamma);
        for (int b = 0; b < dim; b++) {
            g[b] = z->gp[3 * k + b] / (c * c);
            for (int a = 0; a < dim; a++)
                g[dim + dim * a + b] = z->gu[3 * (dim * k + a) + b];
        }
    }
}

/* Mean of P less P_out at the rim of the free zone, R/2 deep: what a partner of constant density
 * cannot know. Under waves it is no constant: their momentum changes the mean pressure. */
static double level_inside(struct sph *s)
{
    struct zones *z = s->zones;
    const double rim = z->buffer + z->transition;
    double sums[2] = {0.0, 0.0};
    z->n = 0;
    for (int i = 0; i < s->p.n; i++) {
        const double d = zones_depth(s, state_row(&s->p, s->p.y, i));
        if (d >= rim && d < rim + 0.5 * s->R)
            zones_list(s, i);
    }
    zones_look(z, s->t, false);
    for (int k = 0; k < z->n; k++) {
        const double *y = state_row(&s->p, s->p.y, z->who[k]), w = y[at_volume(s->dim)];
        sums[0] += w * (eos_p(y[at_mass(s->dim)] / w, s->rho0, s->c0, s->gamma) - z->p[k]);
        sums[1] += w;
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
}

/* kg: of all ranks. With levels the step has counted it, each place once. Collective. */
double zones_mass(const struct sph *s)
{
    double sum = 0.0;
    for (int i = 0; i < s->p.n && !s->refinement; i++)
        sum += s->p.y[(size_t)i * s->p.nstate + 2 * s->dim + 1];
    if (s->refinement)
        sum = s->step.mass;
    return ranks_sum(s->run->comm, sum);
}

/* kg: what the region and its faces hold beyond the start. Collective. */
static double gained(const struct sph *s)
{
    return zones_mass(s) + openings_held(s) - s->start.mass;
}

/* Windows over which the level is smoothed: one that followed at once would be a wall to the sound
 * of impacts. */
static const double level_memory = 10.0;

/* Whether some side takes that from the flow inside. */
static bool any_side(const bool *has, int dim)
{
    bool any = false;
    for (int side = 0; side < 2 * dim; side++)
        any = any || has[side];
    return any;
}

/* A full box holds what it held at the start: volumes in the zones do not know it, and what they
 * gained goes out by the faces, unless a side takes its pressure from outside alone: mass
 * follows that. Under a free surface mass goes in and out with the waves, and a
 * partner of constant density knows its pressure up to a level: SPH's own is taken. Alone that
 * would let the column drain: what the region holds beyond its start and what has flown in adds ten
 * times the weight of the missing layer. */
void zones_gauge(struct sph *s)
{
    struct zones *z = s->zones;
    const double *G = s->gravity, g = vec3_length(G);
    struct openings *o = z->openings;
    double inflow = 0.0;
    z->gauge = 0.0;
    if (z->surface) /* one pressure, 0 on the surface of both */
        return;
    if (!s->surface && s->run->scene.coupling.keep_mass && !any_side(z->own_u, s->dim))
        openings_let_out(o, gained(s));
    if (!s->surface || g == 0.0)
        return;
    for (int side = 0; side < 2 * s->dim; side++)
        inflow += o->through[side];
    inflow = ranks_sum(s->run->comm, inflow);
    const double layer = (gained(s) - inflow) * s->dx / (openings_faces(o) * s->dxD);
    const double level = level_inside(s);
    z->level = isnan(z->level) ? level : z->level + (level - z->level) / level_memory;
    z->gauge = z->level - 10.0 * g * layer;
}

/* Draws the state of particle k of the list to the flow outside by alpha; p in Pa, u in m/s. */
static void draw(const struct sph *s, int k, int side, double alpha, double *p, double u[3])
{
    const struct zones *z = s->zones;
    const int dim = s->dim, n = side / 2;
    const double Z = (side % 2 ? 1.0 : -1.0) * s->rho0 * s->c0;
    const double dp = z->own_p[side] ? 0.0 : z->p[k] - *p, part = z->own_u[side] ? 0.0 : 1.0;
    const double entering = dp - Z * part * (z->u[dim * k + n] - u[n]);
    for (int a = 0; a < dim; a++)
        u[a] += a == n ? -0.5 * alpha * entering / Z : part * alpha * (z->u[dim * k + a] - u[a]);
    *p += 0.5 * alpha * entering;
}

/* The same without regard to where waves run: p and u are both means of within and outside. */
static void draw_all(const struct sph *s, int k, int side, double alpha, double *p, double u[3])
{
    const struct zones *z = s->zones;
    *p += z->own_p[side] ? 0.0 : alpha * (z->p[k] - *p);
    for (int a = 0; a < s->dim && !z->own_u[side]; a++)
        u[a] += alpha * (z->u[s->dim * k + a] - u[a]);
}

/* Of u along the sides u <- a u_out + (1-a) u [6.8], a = depth into the transition over its width;
 * across them and of P only what enters, P - rho c u.n, n outwards: P + rho c u.n leaves as SPH
 * made it. What sides take from the flow inside is left as it is: rho c times the error of a mean
 * velocity is more than the pressure that drives a slow flow. To blend all of both [6.7-6.8], as
 * coupling.blend = "all" does for comparison, lets the coupled programs feed vorticity, or damp
 * (coupler/METHODS.md). */
void zones_blend(struct sph *s)
{
    struct zones *z = s->zones;
    const int dim = s->dim;
    const bool all = s->run->scene.coupling.blend == BLEND_ALL;
    gather(s, ZONE_TRANSITION);
    zones_look(z, s->t, false);
    for (int k = 0; k < z->n; k++) {
        const int i = z->who[k];
        double *y = state_row(&s->p, s->p.y, i), u[3];
        double below;
        const int side = zones_nearest(z, y, &below);
        const double in = (below - z->buffer) / z->transition;
        const double wet = zones_wet(z, z->surface ? z->phi[k] : 0.0), m = y[at_mass(dim)];
        const double alpha = wet * fmin(fmax(1.0 - in, 0.0), 1.0);
        double p = eos_p(m / y[at_volume(dim)], s->rho0, s->c0, s->gamma);
        for (int a = 0; a < dim; a++)
            u[a] = y[dim + a] / m;
        (all ? draw_all : draw)(s, k, side, alpha, &p, u);
        impose(s, i, u, eos_rho(p, s->rho0, s->c0, s->gamma));
    }
}

/* After a step: the gap is measured with the new particles in. */
void zones_openings(struct sph *s, double dt)
{
    births_step(s, dt);
    if (s->zones->gap)
        level_gap_look(s, dt);
}

/* Counts of all ranks; on another number of ranks the first gets them. */
static bool keep_counts(struct sph *s, struct h5 *f, int64_t counted[3])
{
    int64_t n;
    if (h5_writes(f))
        return h5_write_int(f, "zones_counted", 3, counted), true;
    int64_t *all = h5_read_all_int(f, "zones_counted", &n);
    const bool same = n == 3 * s->run->size, fits = all && n % 3 == 0;
    const int64_t first = same ? 3 * s->run->rank : 0, end = same ? first + 3 : n;
    for (int k = 0; k < 3; k++)
        counted[k] = 0;
    for (int64_t k = first; fits && k < end && (same || s->run->rank == 0); k++)
        counted[k % 3] += all[k];
    mem_free(all);
    return fits;
}

/* Masses of faces once, as all ranks have the same; fluxes and counts are sums over the ranks, and
 * each rank writes its part. */
bool zones_restart(struct sph *s, struct h5 *f)
{
    struct zones *z = s->zones;
    struct openings *o = z->openings;
    const int faces = openings_faces(o);
    double way[3] = {z->way[0], z->way[1], z->way[2]};
    int64_t counted[3] = {o->born, o->gone, o->refused};
    if (!h5_keep_rows(f, "faces_mass", "kg", faces, 1, o->mass) ||
        !h5_keep_parts(f, "faces_flux", "kg/s", faces, o->flux) ||
        !h5_keep_parts(f, "zones_through", "kg", 6, o->through) ||
        !h5_keep_same(f, "zones_level", "Pa", 1, &z->level) ||
        !h5_keep_same(f, "zones_owed", "kg", 1, &o->deficit) || !keep_counts(s, f, counted) ||
        !h5_keep_same(f, "zones_way", "m", 3, way) ||
        (s->prm.box_follows[0] && !h5_keep_same(f, "zones_chase", "m/s", 3, z->tracked)) ||
        (z->update && !sides_restart(s, f)) || (z->gap && !level_gap_restart(s, f)) ||
        (z->surface && !wet_faces_restart(o, f)))
        return false;
    if (h5_writes(f))
        return true;
    o->born = counted[0];
    o->gone = counted[1];
    o->refused = counted[2];
    box_motion_set(s, way);
    openings_settle(s);
    return true;
}

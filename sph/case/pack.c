/* pack.c - rearranges the first particles so that they fill the room evenly, between oblique walls
 * or from a lattice with noise (after Colagrossi, Bouscasse, Antuono & Marrone, Comput. Phys.
 * Commun. 183, 2012): steps along the concentration gradient with its wall terms, no flow; then
 * volumes such that the kernel sum is that of a wall's neighbours, one, or without walls a
 * lattice's. In 3D only those near meshes of files move, as long as it helps: ten steps do most of
 * the work, later ones melt the lattice. SPDX-License-Identifier: BSD-3-Clause */
#include "pack.h"

#include "../../common/scene/scene.h"
#include "../pairs/sph_pairs.h"
#include "../sph.h"
#include "../surface/sph_surface.h"
#include "../time/sph_time.h"
#include "../walls/sph_walls.h"
#include "first_lattice.h"
#include "rooms.h"

/* A lattice that meshes disturb stays as it is away from them. */
static bool by_meshes(const struct sph *s) { return rooms_parted(s) && !(s->prm.noise > 0.0); }

/* What a step of packing changes: all, or what is that near to a mesh. */
static bool is_packed(const struct sph *s, int i, double reach)
{
    return !(particles_is_guard(&s->p, i) && (s->p.role[i] & ROLE_EDGE)) &&
           (!by_meshes(s) || rooms_are_near(s, prim_line(&s->p, i), reach));
}

/* Square of the shifting velocity: the transport velocity less that of the fluid, m^2/s^2. */
static double shift2(const struct sph *s, int i)
{
    const int dim = s->dim;
    const double *u = prim_line(&s->p, i) + dim;
    const double *u0 = slope_line(&s->p, i) + dim + dim * dim;
    return vec_distance2(dim, u0, u);
}

/* Meshes leave particles that are even already where they are: a step of noise would melt the
 * lattice. */
static void move(struct sph *s, double dt)
{
    const int dim = s->dim;
    const double least2 = by_meshes(s) ? 1e-8 * s->step.shift_speed * s->step.shift_speed : 0.0;
    for (int i = 0; i < s->p.n; i++) {
        const double *u = prim_line(&s->p, i) + dim;
        const double *u0 = slope_line(&s->p, i) + dim + dim * dim;
        if (shift2(s, i) < least2 || !is_packed(s, i, 2.0 * s->R))
            continue;
        for (int a = 0; a < dim; a++)
            s->p.y[(size_t)i * s->p.nstate + a] += dt * (u0[a] - u[a]);
    }
    s->lists.ready = false;
}

/* Root of the mean square of R times the crowding vector of those within R of meshes: the shift is
 * 2 U R of it, at most U/4. Collective. */
static double crowding(const struct sph *s)
{
    double sum[2] = {0.0, 0.0};
    for (int i = 0; i < s->p.n; i++)
        if (is_packed(s, i, s->R)) {
            sum[0] += shift2(s, i);
            sum[1] += 1.0;
        }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    return sum[1] > 0.0 ? sqrt(sum[0] / sum[1]) / (2.0 * s->step.shift_speed) : 0.0;
}

/* Even enough, or hardly better than five steps ago. */
static bool is_settled(const struct sph *s, int step, double past[5])
{
    if (!by_meshes(s))
        return false;
    const double now = crowding(s), before = past[step % 5];
    past[step % 5] = now;
    return now < 0.04 || (step >= 5 && now > 0.9 * before);
}

/* Away from a free surface volumes become such that sum w W is that of a lattice, beside walls that
 * of one that they cut (see volume_feedback.c); the mass follows. With volumes dx^D after
 * noise the kernel sums are not even, and as transport evens them out later, volumes follow and the
 * pressure's level goes (by -0.9 rho U^2 in Taylor-Green flow from noise of 0.3 dx). Beside a
 * lattice that stays as it is, its sum counts. */
static void set_volumes(struct sph *s)
{
    const double whole = kernel_lattice_sum(s);
    double *factor = walls_rooms(s);
    for (int i = 0; i < s->p.n; i++)
        factor[i] *= whole / kernel_sum(s, i);
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        if ((s->surface && s->surface->is[i] != SURFACE_INNER) || !is_packed(s, i, 2.0 * s->R))
            continue;
        for (int k = s->dim; k < s->p.nstate; k++) /* momentum, volume, mass */
            y[k] *= factor[i];
    }
    mem_free(factor);
}

/* The volume that meshes and sides enclose, where the fluid fills it; 0: not known. */
static double enclosed(const struct sph *s)
{
    const struct scene *c = &s->run->scene;
    double whole = 1.0, holds = 0.0, taken = 0.0;
    int inside = 0;
    bool known = !s->surface && c->initial.seed.n == 0 && !s->zones;
    for (int a = 0; a < 3; a++)
        whole *= s->hi[a] - s->lo[a];
    for (int k = 0; k < s->walls->nmeshes; k++) {
        const struct scene_mesh *m = s->walls->meshes[k].of;
        if (!m || s->walls->meshes[k].image)
            continue;
        known = known && m->mesh.closed;
        inside += m->fluid_side == FLUID_INSIDE;
        *(m->fluid_side == FLUID_INSIDE ? &holds : &taken) += m->volume;
    }
    return known && inside < 2 ? (inside ? holds : whole) - taken : 0.0;
}

/* What the volumes of those near meshes miss of it together they get in proportion: a body is held
 * up by the water that it displaces, and 0.1 % of a tank were 4 % of a sphere's. Collective. */
static void fill_enclosed(struct sph *s)
{
    const double V = enclosed(s);
    double sum[2] = {0.0, 0.0};
    for (int i = 0; i < s->p.n && V > 0.0; i++) {
        const double w = state_row(&s->p, s->p.y, i)[at_volume(3)];
        sum[0] += w;
        sum[1] += is_packed(s, i, 2.0 * s->R) ? w : 0.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->run->comm);
    const double factor = sum[1] > 0.0 ? 1.0 + (V - sum[0]) / sum[1] : 1.0;
    if (fabs(factor - 1.0) > 0.25) /* not what it seems */
        return;
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i);
        for (int k = 3; k < s->p.nstate && is_packed(s, i, 2.0 * s->R); k++)
            y[k] *= factor;
    }
}

/* Lists and slopes; finer levels are packed one by one, without guards yet. */
static void find_crowding(struct sph *s)
{
    if (!s->coarser) {
        integrate_gradients(s);
        return;
    }
    if (!s->lists.ready)
        level_prepare(s);
    level_gradients(s, false);
}

/* One step moves by 0.1 R^2 times the crowding vector, at most R/80. */
void pack_start(struct sph *s, int steps)
{
    const int transport = s->prm.transport;
    const double U = 0.1 * s->c0, dt = 0.05 * s->R / U; /* whatever U is, it cancels */
    if (steps <= 0)
        return;
    s->prm.transport = TRANSPORT_TVS;
    s->packing = true;
    s->step.shift_speed = U;
    s->lists.skin = 0.05 * s->R;
    s->lists.ready = false;
    double past[5] = {0.0};
    int k = 0;
    for (; k < steps; k++) {
        find_crowding(s);
        if (is_settled(s, k, past))
            break;
        move(s, dt);
        if (s->walls && (k == steps / 2 || k == steps - 1))
            first_clear_seams(s);
    }
    find_crowding(s);
    if (by_meshes(s))
        log_say("packing: %d steps, R times the concentration gradient %.3g on average near meshes",
                k, crowding(s));
    set_volumes(s);
    if (by_meshes(s))
        fill_enclosed(s);
    s->packing = false;
    s->step.shift_speed = 0.0;
    s->prm.transport = transport;
    s->lists.ready = false;
}

/* Children of packed parents stand evenly but beside walls, where what is a tenth of the spacing
 * for one level is a fifth for the next. */
void pack_finer(struct sph *level) { pack_start(level, (level->prm.packing + 3) / 4); }

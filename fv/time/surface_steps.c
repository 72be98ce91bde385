/* surface_steps.c - the surface at the start and around a step of the velocity.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../surface/levelset.h"

#include <math.h>
#include <string.h>

#include "../boundary/bc.h"
#include "../operators/blocked_cells.h"
#include "../boundary/forcing.h"
#include "../poisson/pressure.h"
#include "../surface/surface_forced.h"
#include "../operators/operators.h"

enum { REINIT_STEPS = 10 }; /* of 0.45 h each: more than what the surface has travelled */

static void rebuild(struct fv *s)
{
    surface_rebuild(s);
    if (s->pressure)
        pressure_rebuild(s);
}

/* Velocities that shapes add to the field's. */
static void add_velocities(struct fv *s)
{
    const struct block *b = &s->b;
    bool any = false;
    double x[3];
    for (int k = -b->g[2]; k < b->n[2] + b->g[2]; k++)
        for (int j = -b->g[1]; j < b->n[1] + b->g[1]; j++)
            for (int i = -b->g[0]; i < b->n[0] + b->g[0]; i++) {
                const int64_t c = block_at(b, i, j, k);
                block_centre(b, i, j, k, x);
                const struct scene_shape *h = surface_shape(s, x);
                for (int a = 0; h && a < b->dim; a++) {
                    s->u[a][c] += h->velocity[a];
                    any = any || h->velocity[a] != 0.0;
                }
            }
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_C_BOOL, MPI_LOR, b->cart);
    if (!any)
        return;
    extension_apply(s, s->u, EXTEND_FREE, LAYERS);
    bc_ghosts(s, BC_GIVEN, s->u);
    block_halo(b, b->dim, s->u);
    convection_face_velocities(s, s->u, s->U);
}

/* Velocity beyond the surface where it stands now, with ghosts, and the fluxes there. */
static void carry_on(struct fv *s, int layers)
{
    extension_apply(s, s->u, EXTEND_SHEAR, layers);
    surface_set_pressure(s);
    bc_ghosts(s, BC_GIVEN, s->u);
    block_halo(&s->b, s->b.dim, s->u);
    surface_dry_fluxes(s);
    if (s->blocked)
        blocked_face_velocities(s, s->u, s->U, true);
    bc_fluxes(s, BC_GIVEN, s->U);
}

/* p = 0 at the highest water, if the case does not say where. */
static void set_level(struct fv *s)
{
    const struct surface *f = s->surface;
    double top = -INFINITY;
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t i = 0; i < f->ncut[a]; i++)
            top = fmax(top, f->cut[a][i].height);
    MPI_Allreduce(MPI_IN_PLACE, &top, 1, MPI_DOUBLE, MPI_MAX, s->b.cart);
    if (s->run->scene.initial.level < LEVEL_TOP || !isfinite(top) || f->g == 0.0)
        return;
    s->level += top / f->g;
    rebuild(s);
}

/* A partner's near cells take part as water or air; nothing is known in all others that are forced.
 */
static void close_cells(struct fv *s)
{
    const struct forcing *g = s->forcing;
    for (int64_t c = 0; g && c < s->b.size; c++)
        s->surface->closed[c] = g->forced[c] && !(s->surface->forced && g->known[c]);
}

void surface_start(struct fv *s)
{
    struct surface *f = s->surface;
    close_cells(s);
    f->volume0 = surface_volume(s, NULL);
    rebuild(s);
    set_level(s);
    add_velocities(s);
    carry_on(s, LAYERS);
}

/* What the band has not seen yet must be told before the surface comes there. */
static void refresh(struct fv *s)
{
    if (s->surface->travelled > 2.0)
        surface_reinit(s, REINIT_STEPS);
}

/* The normal stress of the last stage is part of the surface's pressure: clean while nu dt/(theta
 * h^2) is at most 5 (measured), here 3.3, as limits.c keeps nu dt/h^2 below 1. */
static double least_theta(const struct fv *s, double dt)
{
    double h = INFINITY;
    for (int a = 0; a < s->b.dim; a++)
        h = fmin(h, s->b.h[a]);
    return fmin(0.3 * s->nu * dt / (h * h), 0.3);
}

static void impose(struct fv *s, double t)
{
    if (s->surface->forced)
        surface_forced_impose(s, t);
}

void surface_first_half(struct fv *s, double dt)
{
    s->surface->theta_least = least_theta(s, dt);
    surface_advance(s, 0.5 * dt);
    impose(s, s->t + 0.5 * dt);
    refresh(s);
    rebuild(s);
    carry_on(s, STENCILS);
}

/* The same through the outline of a partner's cells. */
static void add_outline(const struct fv *s, double sums[2])
{
    const struct forcing *g = s->forcing;
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t i = 0; i < g->nface[a]; i++) {
            const int64_t c = g->face[a][i], d = s->b.stride[a];
            if (!g->counts[a][i] || (g->forced[c] != 1 && g->forced[c - d] != 1))
                continue;
            const int row = block_row(&s->b, c);
            const double area = block_volume(&s->b, row) / block_size(&s->b, a, row);
            const double in = -g->sign[a][i] * area * s->U[a][c] * surface_face_share(s, c, a);
            sums[0] += in;
            sums[1] += fabs(in);
        }
}

/* m^dim/s: water that comes in through openings less what leaves, their sum, and the former without
 * a partner's outline, over all ranks. */
static void flows(const struct fv *s, double sums[3])
{
    const struct block *b = &s->b;
    sums[0] = sums[1] = 0.0;
    for (int k = 0; s->bc && k < 2 * b->dim; k++) {
        const int a = k / 2, t0 = a == 0 ? 1 : 0, t1 = a == 2 ? 1 : 2;
        int at[3];
        at[a] = k % 2 ? b->n[a] - 1 : 0;
        if (s->bc->n[k] == 0 || (s->bc->kind[k] != BC_INFLOW && s->bc->kind[k] != BC_OUTFLOW))
            continue;
        for (at[t1] = 0; at[t1] < b->n[t1]; at[t1]++)
            for (at[t0] = 0; at[t0] < b->n[t0]; at[t0]++) {
                const int64_t c = block_at(b, at[0], at[1], at[2]);
                const double area = block_size(b, t0, at[t0]) * block_size(b, t1, at[t1]);
                const double out = s->U[a][k % 2 ? c + b->stride[a] : c];
                const double in = (k % 2 ? -area : area) * out * surface_share(s, c);
                sums[0] += in;
                sums[1] += fabs(in);
            }
    }
    sums[2] = sums[0];
    if (s->surface->forced)
        add_outline(s, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, b->cart);
}

void surface_second_half(struct fv *s, double dt)
{
    double through[3];
    flows(s, through);
    s->surface->volume0 += dt * through[0];
    s->surface->passed += dt * through[1];
    s->surface->entered += dt * through[2];
    surface_advance(s, 0.5 * dt);
    impose(s, s->t);
    refresh(s);
    surface_keep_volume(s);
    surface_sample(s);
}

/* Lists the fields of the state; returns their number. */
static int state(struct fv *s, double **f)
{
    int n = 0;
    f[n++] = s->surface->phi;
    f[n++] = s->p;
    f[n++] = s->p_before;
    for (int a = 0; a < 3; a++) {
        f[n++] = s->psi[a];
        if (a < s->b.dim) {
            f[n++] = s->u[a];
            f[n++] = s->U[a];
        }
    }
    return n;
}

void surface_keep_state(struct fv *s)
{
    double *f[12];
    const int n = state(s, f);
    for (int k = 0; k < n; k++) {
        if (!s->surface->before[k])
            s->surface->before[k] = block_field(&s->b);
        memcpy(s->surface->before[k], f[k], (size_t)s->b.size * sizeof(double));
    }
    s->surface->travelled_before = s->surface->travelled;
}

void surface_back(struct fv *s)
{
    double *f[12];
    const int n = state(s, f);
    for (int k = 0; k < n; k++)
        memcpy(f[k], s->surface->before[k], (size_t)s->b.size * sizeof(double));
    s->surface->travelled = s->surface->travelled_before;
    s->surface->repeats++;
}

const char *surface_trouble(const struct fv *s)
{
    bool fills = false;
    for (int k = 0; s->bc && k < 6; k++)
        fills = fills || s->bc->kind[k] == BC_INFLOW;
    if (s->surface->cuts == 0 && fills && !s->bc->pressure_given)
        return "the domain is full of water, and more flows in";
    return s->surface->wet > 0 ? NULL : "no cell holds water any more";
}

/* level_blocks.c - the level set on blocks (level_ops.h): WENO5 in the indices of the cells, and
 * the steps of blocks that move. SPDX-License-Identifier: BSD-3-Clause */
#include "level_ops.h"

#include "../boundary/fv_boundary.h"
#include "levelset.h"
#include "mesh_view.h"
#include "reinit_band.h"
#include "weno.h"

/* --- ghosts --- */

/* Sides last: they mirror what joins and overlaps have brought. */
static void ghosts(const struct fv *s, double *phi)
{
    surface_mesh_fill(s, phi);
    mesh_bc_level(s, s->surface && s->surface->keeps, phi);
}

static void mirror(const struct fv *s, double *q)
{
    mesh_fill(s->m, 1, &q);
    mesh_bc_level(s, false, q);
}

static void stage_ghosts(const struct fv *s, bool first, double *phi)
{
    if (!first)
        ghosts(s, phi);
}

/* --- advection --- */

/* In indices: velocities along them are those of surface_mesh_speeds. near: where the band is. */
static void rate_on_blocks(const struct fv *s, const double *near, const double *phi, double *rate)
{
    const struct surface_mesh *w = s->surface->mesh;
    FLOW_NEAR_AT (s, part, j, c, n) {
        const double *size = w->size[part - s->grid.part];
        const double band = BAND * surface_mesh_spacing(s, part);
        memset(rate + c, 0, (size_t)n * sizeof(double));
        for (int64_t from = c, m = 0; level_next_run(near, band, c + n, &from, &m);)
            for (int a = 0; a < s->dim; a++)
                weno_advect(phi + from, w->speed[a] + from, part->stride[a], 1.0 / size[a], m,
                            rate + from);
    }
}

/* Blocks that move: phi less the height z of places, eta = phi - z, has
 *   eta_t + (u - w).grad eta + u_z = 0
 * in cells of velocity w, whatever the motion: level water that is at rest stays so exactly. */
static void rate_on_moving_blocks(const struct fv *s, const double *near, const double *eta,
                                  double *rate)
{
    const double *g = s->gravity.hydrostatic;
    rate_on_blocks(s, near, eta, rate);
    FLOW_NEAR_AT (s, part, j, c, n) {
        const double band = BAND * surface_mesh_spacing(s, part);
        for (int64_t from = c, m = 0; level_next_run(near, band, c + n, &from, &m);)
            for (int a = 0; a < s->dim; a++)
                for (int64_t i = from; i < from + m; i++)
                    rate[i] += g[a] / s->surface->g * s->u[a][i];
    }
}

static void rate_of(const struct fv *s, const double *phi, double *rate)
{
    rate_on_blocks(s, phi, phi, rate);
}

static double speed(const struct fv *s) { return surface_mesh_speeds(s, BAND); }

/* The same with eta of rate_on_moving_blocks in place of phi, which says where the band is. */
static void advance_height(struct fv *s, double dt, double *near)
{
    static const double w[3] = {0.0, 0.75, 1.0 / 3.0};
    struct surface *f = s->surface;
    memcpy(near, f->phi, (size_t)s->size * sizeof(double));
    surface_mesh_change_height(s, 1.0, near);
    memcpy(f->phi_new, f->phi, (size_t)s->size * sizeof(double));
    for (int k = 0; k < 3; k++) {
        rate_on_moving_blocks(s, near, f->phi_new, f->rate);
        level_blend(s, w[k], f->phi, dt, f->rate, f->phi_new);
        mesh_fill(s->m, 1, &f->phi_new);
        mesh_bc_level(s, false, f->phi_new);
    }
    memcpy(f->phi, f->phi_new, (size_t)s->size * sizeof(double));
}

/* Blocks go to their places at t while phi less the height is carried: in these terms water at rest
 * does not change when a block moves. */
int surface_advance_to(struct fv *s, double t, double dt)
{
    struct surface *f = s->surface;
    const double cfl = surface_mesh_speeds(s, BAND) * dt;
    const int n = level_parts(cfl);
    f->travelled += cfl;
    surface_mesh_change_height(s, -1.0, f->phi);
    surface_mesh_place(s, t);
    for (int k = 0; k < n; k++)
        advance_height(s, dt / n, f->kept);
    surface_mesh_change_height(s, 1.0, f->phi);
    surface_ghosts(s, f->phi);
    return n;
}

/* --- cells --- */

static double spacing(const struct fv *s, const struct part *p, int j)
{
    (void)j;
    return surface_mesh_spacing(s, p);
}

/* Of a plane in the cell's indices. */
static void slopes(const struct fv *s, const struct part *p, int64_t c, double *n)
{
    const double *phi = s->surface->phi;
    for (int a = 0; a < s->dim; a++)
        n[a] = 0.5 *
               (blocked_beside(s, phi, c, p->stride[a]) - blocked_beside(s, phi, c, -p->stride[a]));
}

static void gradient(const struct fv *s, const struct part *p, int64_t c, int j, const double *phi,
                     double g[3])
{
    (void)j;
    surface_mesh_gradient(s, p, c, phi, g);
}

static double volume(const struct fv *s, int64_t c, int j)
{
    (void)j;
    return s->surface->mesh->count[c];
}

static double counted(const struct fv *s, int64_t c, double share)
{
    return share * s->surface->mesh->count[c] / s->m->V[c];
}

/* Cells that blocks share count by their pieces: what they have beyond their shares. */
static void add_shared(const struct fv *s, double sums[2])
{
    const struct surface_mesh *w = s->surface->mesh;
    for (int64_t k = 0; k < w->nshared; k++) {
        const struct shared_cell *x = w->shared + k;
        const struct part *p = grid_part(&s->grid, x->cell, NULL);
        const double h = surface_mesh_spacing(s, p), e = 1e-4 * h, volume = w->count[x->cell];
        if (fabs(s->surface->phi[x->cell]) > 3.0 * h)
            continue;
        level_add_water(s, p, x->cell, -volume, e, sums);
        sums[0] += surface_mesh_shared_water(s, x, 0.0);
        sums[1] +=
            (surface_mesh_shared_water(s, x, e) - surface_mesh_shared_water(s, x, -e)) / (2.0 * e);
    }
}

static double spacing_along(const struct fv *s, const struct part *p, int a)
{
    return s->surface->mesh->size[p - s->grid.part][a];
}

/* Where cells are, and how much of them counts, before phi's ghosts. */
static void close_cells(struct fv *s)
{
    surface_mesh_update(s);
    surface_mesh_count(s);
    surface_ghosts(s, s->surface->phi);
}

/* Dry cells take no part in the flow. */
static void find_faces(struct fv *s)
{
    for (int64_t i = 0; i < s->size; i++)
        s->free[i] = s->m->status[i] == CELL_COMPUTED && s->surface->layer[i] == 0;
    surface_mesh_find_faces(s);
}

static double face_slope(const struct fv *s, int a, int64_t face, double change)
{
    return s->m->G[a][a][face] * change;
}

static double cut_slope(const struct fv *s, int a, const struct cut *x, double slope)
{
    return slope * (s->m->G[a][a][x->face] * x->step);
}

/* --- start --- */

/* Ghosts and cells of others get the scene's distance as well, so that the first stencils are
 * whole. */
static void start(const struct fv *s, struct surface *f)
{
    const struct surface_mesh *w = f->mesh = mem_own(f, surface_mesh_create(s, f));
    f->none = w->out;
    f->reinit = w->boxes ? &box_reinit : &block_reinit;
    for (int64_t c = 0; c < s->size; c++)
        f->phi[c] = surface_distance(s, (double[]){w->x[0][c], w->x[1][c], w->x[2][c]});
}

const struct level_ops block_level = {.start = start,
                                      .ghosts = ghosts,
                                      .mirror = mirror,
                                      .stage_ghosts = stage_ghosts,
                                      .rate = rate_of,
                                      .speed = speed,
                                      .spacing = spacing,
                                      .slopes = slopes,
                                      .gradient = gradient,
                                      .volume = volume,
                                      .counted = counted,
                                      .add_shared = add_shared,
                                      .spacing_along = spacing_along,
                                      .close_cells = close_cells,
                                      .find_faces = find_faces,
                                      .fluxes = surface_mesh_fluxes,
                                      .face_slope = face_slope,
                                      .cut_slope = cut_slope};

/* levelset.c - phi_t + u.grad phi = 0: WENO5 (weno.c) in a
 * band around the surface, SSP-RK3 (Shu & Osher 1988); volume by planes in the cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include <math.h>
#include <string.h>

#include "../../common/base/mem.h"
#include "../boundary/bc.h"
#include "../boundary/blocked.h"
#include "../boundary/forcing.h"
#include "../boundary/mesh_bc.h"
#include "../boundary/still.h"
#include "mesh_view.h"
#include "plane.h"
#include "weno.h"

enum { BAND = 5 }; /* cells on either side of the surface that are advected */
/* -: most of the sum over the axes of |u_a| dt/h_a in a part of a step. Shares of water stay within
 * their bounds up to a half (fraction.c), beyond in all but the fastest cells; a step of CFL 1.1
 * is two halves of one part each. */
static const double PART_MOST = 0.6;

static bool side_here(const struct block *b, int a, bool upper)
{
    return !b->periodic[a] && (upper ? b->hi[a] == b->cells[a] : b->lo[a] == 0);
}

static void ghosts_on_blocks(const struct fv *s, double *phi)
{
    surface_mesh_fill(s, phi);
    mesh_bc_level(s, s->surface && s->surface->mesh->keeps, phi);
}

/* How phi goes on behind a side. */
enum beyond { MIRRORED, LINEAR };

static enum beyond beyond_side(const struct fv *s, int side, enum beyond wanted)
{
    const bool wall = s->bc && (s->bc->kind[side] == MESH_WALL || s->bc->kind[side] == MESH_SLIP);
    return wall ? wanted : MIRRORED;
}

static void ghosts(const struct fv *s, enum beyond walls, double *phi)
{
    const struct block *b = &s->b;
    block_halo(b, 1, &phi);
    for (int a = 0; a < b->dim; a++)
        for (int upper = 0; upper < 2; upper++) {
            if (!side_here(b, a, upper))
                continue;
            const bool linear = beyond_side(s, 2 * a + upper, walls) == LINEAR;
            const int64_t out = upper ? b->stride[a] : -b->stride[a];
            int lo[3], hi[3];
            for (int t = 0; t < 3; t++) {
                lo[t] = t == a ? (upper ? b->n[a] - 1 : 0) : -b->g[t];
                hi[t] = t == a ? lo[t] + 1 : b->n[t] + b->g[t];
            }
            for (int k = lo[2]; k < hi[2]; k++)
                for (int j = lo[1]; j < hi[1]; j++)
                    for (int i = lo[0]; i < hi[0]; i++) {
                        double *q = phi + block_at(b, i, j, k);
                        for (int m = 1; m <= GHOSTS; m++)
                            q[m * out] = linear ? q[0] + m * (q[0] - q[-out]) : q[(1 - m) * out];
                    }
        }
}

void surface_ghosts(const struct fv *s, double *phi)
{
    if (s->m)
        ghosts_on_blocks(s, phi);
    else
        ghosts(s, MIRRORED, phi);
}

void surface_mirror(const struct fv *s, double *q)
{
    if (s->m) {
        mesh_fill(s->m, 1, &q);
        mesh_bc_level(s, false, q);
    } else {
        ghosts(s, MIRRORED, q);
    }
}

/* Of the cells of local row j. */
static double largest_spacing(const struct block *b, int j)
{
    double h = 0.0;
    for (int a = 0; a < b->dim; a++)
        h = fmax(h, block_size(b, a, j));
    return h;
}

/* The next run of cells in a row, behind the n from *from on, that are less than the band off the
 * surface; false: there is none. */
static bool next_run(const double *phi, double band, int64_t end, int64_t *from, int64_t *n)
{
    int64_t i = *from + *n;
    while (i < end && !(fabs(phi[i]) < band))
        i++;
    *from = i;
    while (i < end && fabs(phi[i]) < band)
        i++;
    *n = i - *from;
    return *n > 0;
}

/* In place of what a stencil that ends at a box gave: phi goes on linearly there. Boxes have even
 * rows. */
static void rate_beside_boxes(const struct fv *s, const double *phi, double *rate)
{
    static const enum blocked_ghost linear[2] = {GHOST_LINEAR, GHOST_LINEAR};
    const double band = BAND * largest_spacing(&s->b, 0);
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t k = 0; k < s->blocked->nnear[a]; k++) {
            const struct near_box *x = s->blocked->near[a] + k;
            const int64_t c = x->cell, d = s->b.stride[a];
            double v[7], was = 0.0, is = 0.0;
            if (!x->own || !(fabs(phi[c]) < band))
                continue;
            blocked_line(x, phi, d, 3, linear, v + 3);
            weno_advect(phi + c, s->u[a] + c, d, 1.0 / s->b.h[a], 1, &was);
            weno_advect(v + 3, s->u[a] + c, 1, 1.0 / s->b.h[a], 1, &is);
            rate[c] += is - was;
        }
}

/* In indices: velocities along them are those of surface_mesh_speeds. near: where the band is. */
static void rate_on_blocks(const struct fv *s, const double *near, const double *phi, double *rate)
{
    const struct surface_mesh *w = s->surface->mesh;
    FLOW_NEAR_AT (s, part, j, c, n) {
        const double *size = w->size[part - s->grid.part];
        const double band = BAND * surface_mesh_spacing(s, part);
        memset(rate + c, 0, (size_t)n * sizeof(double));
        for (int64_t from = c, m = 0; next_run(near, band, c + n, &from, &m);)
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
        for (int64_t from = c, m = 0; next_run(near, band, c + n, &from, &m);)
            for (int a = 0; a < s->dim; a++)
                for (int64_t i = from; i < from + m; i++)
                    rate[i] += g[a] / s->surface->g * s->u[a][i];
    }
}

static void rate_of(const struct fv *s, const double *phi, double *rate)
{
    const struct block *b = &s->b;
    if (s->m) {
        rate_on_blocks(s, phi, phi, rate);
        return;
    }
    BLOCK_NEAR_AT (s, 0, j, c, n) {
        const double band = BAND * largest_spacing(b, j);
        memset(rate + c, 0, (size_t)n * sizeof(double));
        for (int64_t from = c, m = 0; next_run(phi, band, c + n, &from, &m);)
            for (int a = 0; a < b->dim; a++)
                weno_advect(phi + from, s->u[a] + from, b->stride[a], 1.0 / block_scale(b, a, j), m,
                            rate + from);
    }
    if (s->blocked)
        rate_beside_boxes(s, phi, rate);
}

/* q = w p + (1 - w)(q + dt rate) */
static void blend(const struct fv *s, double w, const double *p, double dt, const double *rate,
                  double *q)
{
    FLOW_NEAR (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            q[i] = w * p[i] + (1.0 - w) * (q[i] + dt * rate[i]);
}

/* Ghosts while phi goes on: that it is mirrored by walls is a kink, which WENO5 takes for the
 * surface's own where it is near. */
static void ghosts_of_stage(const struct fv *s, double *phi)
{
    if (s->m)
        ghosts_on_blocks(s, phi);
    else
        ghosts(s, LINEAR, phi);
}

/* One step of SSP-RK3. */
static void advance(struct fv *s, double dt)
{
    static const double w[3] = {0.0, 0.75, 1.0 / 3.0};
    struct surface *f = s->surface;
    memcpy(f->phi_new, f->phi, (size_t)s->size * sizeof(double));
    for (int k = 0; k < 3; k++) {
        if (k > 0 || !s->m)
            ghosts_of_stage(s, f->phi_new);
        rate_of(s, f->phi_new, f->rate);
        blend(s, w[k], f->phi, dt, f->rate, f->phi_new);
    }
    surface_ghosts(s, f->phi_new);
    double *t = f->phi;
    f->phi = f->phi_new;
    f->phi_new = t;
}

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
        blend(s, w[k], f->phi, dt, f->rate, f->phi_new);
        mesh_fill(s->m, 1, &f->phi_new);
        mesh_bc_level(s, false, f->phi_new);
    }
    memcpy(f->phi, f->phi_new, (size_t)s->size * sizeof(double));
}

static int parts_of(double cfl) { return cfl > PART_MOST ? (int)ceil(cfl / PART_MOST) : 1; }

void surface_advance_to(struct fv *s, double t, double dt)
{
    struct surface *f = s->surface;
    const double cfl = surface_mesh_speeds(s, BAND) * dt;
    const int n = parts_of(cfl);
    f->travelled += cfl;
    surface_mesh_change_height(s, -1.0, f->phi);
    surface_mesh_place(s, t);
    for (int k = 0; k < n; k++)
        advance_height(s, dt / n, f->kept);
    surface_mesh_change_height(s, 1.0, f->phi);
    surface_ghosts(s, f->phi);
}

int surface_advance(struct fv *s, double dt)
{
    const double cfl = (s->m ? surface_mesh_speeds(s, BAND) : s->max.rate) * dt;
    const int n = parts_of(cfl);
    s->surface->travelled += cfl;
    for (int k = 0; k < n; k++)
        advance(s, dt / n);
    return n;
}

/* Difference of phi over two cells along the step d, one-sided beside closed sides and boxes. */
static double difference(const struct fv *s, int64_t c, int64_t d)
{
    const double *q = s->surface->phi + c;
    if (s->m)
        return blocked_beside(s, s->surface->phi, c, d) - blocked_beside(s, s->surface->phi, c, -d);
    const bool low = surface_holds_none(s, c - d), high = surface_holds_none(s, c + d);
    return (high ? low ? 0.0 : q[0] - q[-d] : q[d] - q[0]) +
           (low ? high ? 0.0 : q[d] - q[0] : q[0] - q[-d]);
}

/* Height of a cell over the mean distance to those above and below. */
static double across_row(const struct block *b, int64_t c)
{
    const int j = block_row(b, c);
    return 2.0 * b->rows->h[j] / (b->rows->step[j] + b->rows->step[j + 1]);
}

/* On blocks of a plane in the cell's indices. */
void surface_slopes(const struct fv *s, const struct part *p, int64_t c, double *n)
{
    for (int a = 0; a < s->dim; a++) {
        n[a] = 0.5 * difference(s, c, p->stride[a]);
        if (a == 1 && s->b.rows)
            n[a] *= across_row(&s->b, c);
    }
}

static double share_at(const struct fv *s, const struct part *p, int64_t c, double shift)
{
    double n[3] = {0.0, 0.0, 0.0};
    surface_slopes(s, p, c, n);
    return plane_share(s->dim, n, -(s->surface->phi[c] + shift));
}

/* m: of the cells of local row j of a part, of blocks of the whole part. */
static double spacing_of(const struct fv *s, const struct part *p, int j)
{
    return s->m ? surface_mesh_spacing(s, p) : largest_spacing(&s->b, j);
}

/* m: beyond this a cell is all water or all air, whatever the slopes of phi, which has steps where
 * its band ends. */
static double reach_at(const struct fv *s, const struct part *p, int64_t c)
{
    return 3.0 * spacing_of(s, p, s->b.rows ? block_row(&s->b, c) : 0);
}

double surface_share(const struct fv *s, int64_t c)
{
    const struct part *p = grid_part(&s->grid, c, NULL);
    const double phi = s->surface->phi[c];
    return fabs(phi) > reach_at(s, p, c) ? phi < 0.0 : share_at(s, p, c, 0.0);
}

double surface_cell_volume(const struct fv *s, int64_t c, int j)
{
    return s->m ? s->surface->mesh->count[c] : block_volume(&s->b, j);
}

double surface_counted(const struct fv *s, int64_t c, double share)
{
    return s->m ? share * s->surface->mesh->count[c] / s->m->V[c] : share;
}

double surface_face_share(const struct fv *s, int64_t c, int a)
{
    const struct part *p = grid_part(&s->grid, c, NULL);
    const double *q = s->surface->phi + c;
    const int64_t d = p->stride[a];
    double n[3] = {0.0, 0.0, 0.0};
    int m = 0;
    for (int t = 0; t < s->dim; t++)
        if (t != a) {
            const int64_t e = p->stride[t];
            n[m++] = 0.25 * (q[e] - q[-e] + q[e - d] - q[-e - d]);
        }
    return plane_share(m, n, -0.5 * (q[0] + q[-d]));
}

/* Cells whose water counts. */
static bool is_own(const struct fv *s, int64_t c)
{
    return !(s->surface->forced && s->forcing->forced[c]);
}

/* Cells that blocks share count by their pieces: what they have beyond their shares. */
static void correct_shared(const struct fv *s, double sums[2])
{
    const struct surface_mesh *w = s->surface->mesh;
    for (int64_t k = 0; k < w->nshared; k++) {
        const struct shared_cell *x = w->shared + k;
        const struct part *p = grid_part(&s->grid, x->cell, NULL);
        const double h = surface_mesh_spacing(s, p), e = 1e-4 * h, volume = w->count[x->cell];
        if (fabs(s->surface->phi[x->cell]) > 3.0 * h)
            continue;
        sums[0] += surface_mesh_shared_water(s, x, 0.0) - volume * share_at(s, p, x->cell, 0.0);
        sums[1] += (surface_mesh_shared_water(s, x, e) - surface_mesh_shared_water(s, x, -e) -
                    volume * (share_at(s, p, x->cell, e) - share_at(s, p, x->cell, -e))) /
                   (2.0 * e);
    }
}

double surface_level_volume(const struct fv *s, double *area)
{
    double sums[2] = {0.0, 0.0};
    FLOW_NEAR_AT (s, part, j, c, n) {
        const double h = spacing_of(s, part, j);
        const double e = 1e-4 * h;
        for (int64_t i = c; i < c + n; i++) {
            if (!is_own(s, i))
                continue;
            const double volume = surface_cell_volume(s, i, j);
            if (fabs(s->surface->phi[i]) > 3.0 * h) {
                sums[0] += s->surface->phi[i] < 0.0 ? volume : 0.0;
                continue;
            }
            sums[0] += volume * share_at(s, part, i, 0.0);
            sums[1] += volume * (share_at(s, part, i, e) - share_at(s, part, i, -e)) / (2.0 * e);
        }
    }
    if (s->m)
        correct_shared(s, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    if (area)
        *area = sums[1];
    return sums[0];
}

double surface_volume_scale(const struct fv *s)
{
    const struct scene_domain *d = &s->run->scene.domain;
    double least = 0.01;
    for (int a = 0; a < d->dim; a++)
        least *= d->max[a] - d->min[a];
    return fmax(s->surface->volume0 + s->surface->passed, least);
}

void surface_note_returned(struct fv *s, double volume)
{
    s->surface->returned += volume;
    s->surface->lost += fmax(0.0, volume);
    s->surface->gained += fmax(0.0, -volume);
}

/* Newton's iteration; once is enough for what a smooth step loses. */
void surface_keep_volume(struct fv *s)
{
    struct surface *f = s->surface;
    const double h = f->largest, most = (f->forced ? 0.02 : 0.1) * h;
    double area, d = INFINITY;
    for (int it = 0; it < 5 && fabs(d) > 1e-4 * f->least; it++) {
        const double volume = surface_level_volume(s, &area);
        if (!(area < 0.0))
            return;
        d = fmax(-most, fmin(most, (f->volume0 - volume) / area));
        FLOW_NEAR (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                f->phi[i] += is_own(s, i) ? d : 0.0;
        surface_ghosts(s, f->phi);
        surface_note_returned(s, d * area);
    }
}

static void fill_even(const struct fv *s, double *phi)
{
    const struct block *b = &s->b;
    double x[3];
    for (int k = -b->g[2]; k < b->n[2] + b->g[2]; k++)
        for (int j = -b->g[1]; j < b->n[1] + b->g[1]; j++)
            for (int i = -b->g[0]; i < b->n[0] + b->g[0]; i++) {
                const int64_t c = block_at(b, i, j, k);
                block_centre(b, i, j, k, x);
                phi[c] = is_blocked(s, c) ? surface_far(s) : surface_distance(s, x);
            }
}

static void fill_blocks(const struct fv *s, const struct surface_mesh *w, double *phi)
{
    for (int64_t c = 0; c < s->size; c++)
        phi[c] = surface_distance(s, (double[]){w->x[0][c], w->x[1][c], w->x[2][c]});
}

static void set_sizes(const struct block *b, const double *g, struct surface *f)
{
    f->least = f->across = INFINITY;
    f->leans = still_leans(g);
    for (int a = 0; a < b->dim; a++) {
        const double along = fabs(g[a]);
        if (along < 0.7 * f->g)
            f->across = fmin(f->across, b->h[a]);
        f->least = fmin(f->least, b->h[a]);
        f->largest = fmax(f->largest, b->h[a]);
    }
}

struct surface *levelset_create(const struct fv *s)
{
    if (!s->prm.water)
        return NULL;
    struct surface *f = NEW(struct surface, 1);
    double **const fields[] = {&f->phi, &f->phi_new, &f->rate, &f->kept, &f->stress};
    const double *g = s->gravity.hydrostatic;
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++)
        *fields[k] = NEW(double, s->size);
    for (int a = 0; a < s->dim; a++)
        f->open[a] = NEW(double, s->size);
    f->layer = NEW(unsigned char, s->size);
    f->deep = NEW(int64_t, s->size);
    f->closed = NEW(bool, s->size);
    f->none = (const unsigned char *)f->closed;
    if (s->prm.integrator != INTEGRATOR_RK3)
        f->half = NEW(double, s->size);
    f->g = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    if (s->m) {
        f->mesh = surface_mesh_create(s, f);
        f->none = f->mesh->out;
        fill_blocks(s, f->mesh, f->phi);
    } else {
        set_sizes(&s->b, g, f);
        fill_even(s, f->phi);
    }
    surface_ghosts(s, f->phi);
    return f;
}

void levelset_free(struct surface **fp)
{
    struct surface *f = *fp;
    if (!f)
        return;
    fit_free(&f->swing);
    mem_free(f->closed);
    mem_free(f->phi);
    mem_free(f->phi_new);
    mem_free(f->rate);
    mem_free(f->kept);
    mem_free(f->half);
    mem_free(f->stress);
    mem_free(f->layer);
    mem_free(f->deep);
    mem_free(f->at);
    mem_free(f->weight);
    mem_free(f->grad);
    for (int a = 0; a < 3; a++) {
        mem_free(f->open[a]);
        mem_free(f->cut[a]);
    }
    surface_mesh_free(&f->mesh);
    for (int k = 0; k < 26; k++)
        mem_free(f->before[k]);
    for (int l = 0; l <= LAYERS; l++)
        mem_free(f->carry[l]);
    mem_free(f);
    *fp = NULL;
}

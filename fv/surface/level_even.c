/* level_even.c - the level set on uniform cells and on layers of unequal height (level_ops.h):
 * WENO5 along the axes, boxes that are cut out. SPDX-License-Identifier: BSD-3-Clause */
#include "level_ops.h"

#include "../boundary/fv_boundary.h"
#include "levelset.h"
#include "weno.h"

/* --- ghosts --- */

/* How phi goes on behind a side. */
enum beyond { MIRRORED, LINEAR };

static enum beyond beyond_side(const struct fv *s, int side, enum beyond wanted)
{
    const bool wall = s->bc && side_is_wall(s->bc->kind[side]);
    return wall ? wanted : MIRRORED;
}

/* Of all three ghost layers; sides in the order of axes, so that corners are filled by the later
 * one. */
static void ghosts(const struct fv *s, enum beyond walls, double *phi)
{
    const struct block *b = &s->b;
    block_halo(b, 1, &phi);
    for (int a = 0; a < b->dim; a++)
        for (int upper = 0; upper < 2; upper++) {
            if (!block_has_side(b, 2 * a + upper))
                continue;
            const bool linear = beyond_side(s, 2 * a + upper, walls) == LINEAR;
            const int64_t out = upper ? b->stride[a] : -b->stride[a];
            int lo[3], hi[3];
            for (int t = 0; t < 3; t++) {
                lo[t] = t == a ? (upper ? b->n[a] - 1 : 0) : -b->g[t];
                hi[t] = t == a ? lo[t] + 1 : b->n[t] + b->g[t];
            }
            for (int k = lo[2]; k < hi[2]; k++)
                for (int j = lo[1]; j < hi[1]; j++) {
                    int ends[2] = {lo[0], hi[0]};
                    part_clip(&s->whole, j, k, ends);
                    for (int i = ends[0]; i < ends[1]; i++) {
                        double *q = phi + block_at(b, i, j, k);
                        for (int m = 1; m <= GHOSTS; m++)
                            q[m * out] = linear ? q[0] + m * (q[0] - q[-out]) : q[(1 - m) * out];
                    }
                }
        }
}

static void mirrored(const struct fv *s, double *phi) { ghosts(s, MIRRORED, phi); }

/* That phi is mirrored by walls is a kink, which WENO5 takes for the surface's own where it is
 * near.
 */
static void stage_ghosts(const struct fv *s, bool first, double *phi)
{
    (void)first;
    ghosts(s, LINEAR, phi);
}

/* --- advection --- */

/* Of the cells of local row j. */
static double largest_spacing(const struct block *b, int j)
{
    double h = 0.0;
    for (int a = 0; a < b->dim; a++)
        h = fmax(h, block_size(b, a, j));
    return h;
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

static void rate_of(const struct fv *s, const double *phi, double *rate)
{
    const struct block *b = &s->b;
    BLOCK_NEAR_AT (s, 0, j, c, n) {
        const double band = BAND * largest_spacing(b, j);
        memset(rate + c, 0, (size_t)n * sizeof(double));
        for (int64_t from = c, m = 0; level_next_run(phi, band, c + n, &from, &m);)
            for (int a = 0; a < b->dim; a++)
                weno_advect(phi + from, s->u[a] + from, b->stride[a], 1.0 / block_scale(b, a, j), m,
                            rate + from);
    }
    if (s->blocked)
        rate_beside_boxes(s, phi, rate);
}

static double speed(const struct fv *s) { return s->max.rate; }

/* --- cells --- */

static double spacing(const struct fv *s, const struct part *p, int j)
{
    (void)p;
    return largest_spacing(&s->b, j);
}

/* Difference of phi over two cells along the step d, one-sided beside closed sides and boxes. */
static double difference(const struct fv *s, int64_t c, int64_t d)
{
    const double *q = s->surface->phi + c;
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

static void slopes(const struct fv *s, const struct part *p, int64_t c, double *n)
{
    for (int a = 0; a < s->dim; a++) {
        n[a] = 0.5 * difference(s, c, p->stride[a]);
        if (a == 1 && s->b.rows)
            n[a] *= across_row(&s->b, c);
    }
}

/* Central differences over two cells, mirrored at boxes. */
static void gradient(const struct fv *s, const struct part *p, int64_t c, int j, const double *phi,
                     double g[3])
{
    const struct block *b = &s->b;
    (void)p;
    for (int a = 0; a < b->dim; a++)
        g[a] =
            (blocked_beside(s, phi, c, b->stride[a]) - blocked_beside(s, phi, c, -b->stride[a])) /
            (block_step(b, a, j) + block_step(b, a, j + 1));
}

static double volume(const struct fv *s, int64_t c, int j)
{
    (void)c;
    return block_volume(&s->b, j);
}

static double counted(const struct fv *s, int64_t c, double share)
{
    (void)s;
    (void)c;
    return share;
}

static double spacing_along(const struct fv *s, const struct part *p, int a)
{
    (void)p;
    return s->b.h[a];
}

/* A partner's near cells take part as water or air; nothing is known in all others that are forced.
 */
static void close_cells(struct fv *s)
{
    const struct forcing *g = s->forcing;
    for (int64_t c = 0; g && c < s->b.size; c++)
        s->surface->closed[c] = g->forced[c] && !(s->surface->forced && g->known[c]);
}

static double face_slope(const struct fv *s, int a, int64_t face, double change)
{
    return change / block_step(&s->b, a, block_row(&s->b, face));
}

static double cut_slope(const struct fv *s, int a, const struct cut *x, double slope)
{
    (void)s;
    (void)a;
    (void)x;
    return slope;
}

/* --- start --- */

static void fill_even(const struct fv *s, double *phi)
{
    double x[3];
    int i[3];
    PART_ALL (&s->whole, i, c) {
        block_centre(&s->b, i[0], i[1], i[2], x);
        phi[c] = is_blocked(s, c) ? surface_far(s) : surface_distance(s, x);
    }
}

/* across: the least spacing along axes that lie across gravity, by which waves along the surface
 * are counted. */
static void set_sizes(const struct block *b, const double *g, struct surface *f)
{
    f->least = f->across = INFINITY;
    f->inclined[0] = f->any_inclined = still_is_inclined(g);
    for (int a = 0; a < b->dim; a++) {
        const double along = fabs(g[a]);
        if (along < 0.7 * f->g)
            f->across = fmin(f->across, b->h[a]);
        f->least = fmin(f->least, b->h[a]);
        f->largest = fmax(f->largest, b->h[a]);
    }
}

static void start(const struct fv *s, struct surface *f)
{
    set_sizes(&s->b, s->gravity.hydrostatic, f);
    fill_even(s, f->phi);
}

const struct level_ops even_level = {.start = start,
                                     .ghosts = mirrored,
                                     .mirror = mirrored,
                                     .stage_ghosts = stage_ghosts,
                                     .rate = rate_of,
                                     .speed = speed,
                                     .spacing = spacing,
                                     .slopes = slopes,
                                     .gradient = gradient,
                                     .volume = volume,
                                     .counted = counted,
                                     .spacing_along = spacing_along,
                                     .close_cells = close_cells,
                                     .find_faces = level_find_cuts,
                                     .fluxes = level_cut_fluxes,
                                     .face_slope = face_slope,
                                     .cut_slope = cut_slope};

/* reinit.c - phi_tau + S(phi_0)(|grad phi| - 1) = 0 to the steady state in a band (Godunov's
 * Hamiltonian, RK2). On even cells and rows the distances that closest.c knows are held, two cells
 * on either side of a smooth surface. Elsewhere beside the surface, differences towards it end at
 * its place on the axis, by the quadratic through phi_0, which pins it (Russo & Smereka, J. Comput.
 * Phys. 163, 2000; Min & Gibou, J. Comput. Phys. 225, 2007); where the slope there is good already,
 * phi is left alone, which pins it better still. WENO5 elsewhere.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include <math.h>
#include <string.h>

#include "../../common/base/mem.h"
#include "../boundary/blocked.h"
#include "mesh_view.h"
#include "surface_forced.h"
#include "weno.h"

enum {
    NARROW = 6 /* the same each half step: those that are advected, and one */
};
static const double good = 0.1; /* | |grad phi| - 1 | of cells beside the surface that stay as is */

/* A run of cells of the band along x. */
struct strip {
    const struct part *part;
    int64_t cell, n;
    int row;     /* local */
    double dtau; /* m: pseudo step of those that are no spots; on blocks each cell has its own */
};

/* A cell of the band between which and a neighbour the surface passes, or whose distance from it
 * closest.c knows. */
struct spot {
    const struct part *part;
    int64_t cell;
    double sign, dtau;  /* -, m; 0: phi is held */
    double reach[3][2]; /* m, on blocks cells: way to the surface along each axis, down and up; 0:
                           none */
};

struct band {
    int64_t nstrips, nspots;
    struct strip *strips;
    struct spot *spots;
};

static double minmod(double a, double b) { return a * b <= 0.0 ? 0.0 : fabs(a) < fabs(b) ? a : b; }

/* Second difference of q at the cell (not divided). */
static double bend(const double *q, int64_t d) { return q[d] - 2.0 * q[0] + q[-d]; }

/* Share of the step d after which the quadratic through q is 0; q[0] and q[d] differ in sign. */
static double crossing(const double *q, int64_t d)
{
    const double c = minmod(bend(q, d), bend(q + d, d)), fall = q[0] - q[d];
    if (fabs(c) < 1e-12 * fabs(fall))
        return q[0] / fall;
    const double e = 0.5 * c - q[0] - q[d], root = sqrt(fmax(0.0, e * e - 4.0 * q[0] * q[d]));
    const double t = 0.5 + (fall - copysign(root, fall)) / c;
    return t > 0.0 && t < 1.0 ? t : q[0] / fall;
}

static double slope_of(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                       int j)
{
    const struct block *b = &s->b;
    double sum = 0.0, g[3];
    if (s->m) {
        surface_mesh_gradient(s, p, c, phi, g);
        return sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    }
    for (int a = 0; a < b->dim; a++) {
        const double d =
            (blocked_beside(s, phi, c, b->stride[a]) - blocked_beside(s, phi, c, -b->stride[a])) /
            (block_step(b, a, j) + block_step(b, a, j + 1));
        sum += d * d;
    }
    return sqrt(sum);
}

static double pseudo_cfl(const struct fv *s) { return s->dim == 3 ? 0.3 : 0.45; }

/* Height of cell c, in local row j, along axis a. */
static double height(const struct fv *s, const struct part *p, int64_t c, int a, int j)
{
    const struct surface_mesh *w = s->surface->mesh;
    return s->m ? w->size[p - s->grid.part][a] / sqrt(w->K[a][a][c]) : block_size(&s->b, a, j);
}

static struct spot look(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                        int j)
{
    struct spot x = {.part = p, .cell = c, .sign = phi[c] < 0.0 ? -1.0 : 1.0, .dtau = INFINITY};
    for (int a = 0; a < s->dim; a++) {
        const double h = height(s, p, c, a, j);
        double v[5];
        x.dtau = fmin(x.dtau, h);
        blocked_even_line(s, phi, c, p->stride[a], v + 2);
        for (int up = 0; up < 2; up++) {
            const int d = up ? 1 : -1;
            if ((v[2] < 0.0) == (v[2 + d] < 0.0))
                continue;
            const double part = fmax(1e-6, crossing(v + 2, d));
            x.reach[a][up] = s->m ? part : part * block_step(&s->b, a, j + up);
            x.dtau = fmin(x.dtau, s->m ? part * h : x.reach[a][up]);
        }
    }
    x.dtau *= pseudo_cfl(s);
    if (fabs(slope_of(s, p, phi, c, j) - 1.0) < good)
        x.dtau = 0.0;
    return x;
}

/* Second derivative along axis a at a cell in row j, whose neighbours stand d away in q, 1/m. */
static double bend_at(const struct block *b, const double *q, int64_t d, int a, int j)
{
    if (a != 1 || !b->rows)
        return bend(q, d) / (b->h[a] * b->h[a]);
    const double low = b->rows->step[j], up = b->rows->step[j + 1];
    return 2.0 * ((q[d] - q[0]) / up - (q[0] - q[-d]) / low) / (up + low);
}

/* One-sided derivatives beside the surface: second-order ENO, or to the surface itself. */
static void slopes_beside(const struct fv *s, const double *phi, const struct spot *x, int a,
                          double d[2])
{
    const struct block *b = &s->b;
    const int j = block_row(b, x->cell);
    double v[5], *const q = v + 2;
    blocked_even_line(s, phi, x->cell, b->stride[a], q);
    for (int up = 0; up < 2; up++) {
        const int step = up ? 1 : -1;
        const double c = minmod(bend_at(b, q, 1, a, j), bend_at(b, q + step, 1, a, j + step));
        const double reach = x->reach[a][up] > 0.0 ? x->reach[a][up] : block_step(b, a, j + up);
        const double far = x->reach[a][up] > 0.0 ? 0.0 : q[step];
        d[up] = (up ? 1.0 : -1.0) * ((far - q[0]) / reach - 0.5 * reach * c);
    }
}

/* |grad phi| in a cell from slopes on either side of it along the indices, K their metric: along
 * each index the one that distance comes in by, Godunov's choice; where it leaves both ways the one
 * at which it stands still. */
static double size_in_indices(int dim, double K[3][3], const double below[3], const double above[3],
                              double sign)
{
    double slope[3], sum = 0.0;
    for (int a = 0; a < dim; a++) {
        double others = 0.0;
        for (int b = 0; b < dim; b++)
            others += b == a ? 0.0 : 0.5 * K[a][b] * (below[b] + above[b]);
        const double in = fmax(0.0, sign * (K[a][a] * below[a] + others)),
                     out = fmax(0.0, -sign * (K[a][a] * above[a] + others));
        slope[a] = in == 0.0 && out == 0.0 ? -others / K[a][a] : in >= out ? below[a] : above[a];
    }
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++)
            sum += K[a][b] * slope[a] * slope[b];
    return sqrt(fmax(0.0, sum));
}

/* The same beside the surface, where slopes end on it. */
static double size_beside_on_blocks(const struct fv *s, const double *phi, const struct spot *x)
{
    const double *size = s->surface->mesh->size[x->part - s->grid.part];
    double K[3][3], d[2][3];
    surface_mesh_metric(s, x->cell, K);
    for (int a = 0; a < s->dim; a++)
        for (int up = 0; up < 2; up++) {
            const int64_t step = up ? x->part->stride[a] : -x->part->stride[a];
            const double *q = phi + x->cell, reach = x->reach[a][up] > 0.0 ? x->reach[a][up] : 1.0;
            const double c = minmod(bend(q, step), bend(q + step, step)),
                         far = x->reach[a][up] > 0.0 ? 0.0 : q[step];
            d[up][a] = (up ? 1.0 : -1.0) * ((far - q[0]) / reach - 0.5 * reach * c) / size[a];
        }
    return size_in_indices(s->dim, K, d[0], d[1], x->sign);
}

static void rates_of_strip(const struct fv *s, const double *phi, const double *old,
                           const struct strip *x, double *rate)
{
    const struct surface_mesh *w = s->surface->mesh;
    const double *size = w->size[x->part - s->grid.part];
    for (int a = 0; a < s->dim; a++)
        weno_slopes(phi + x->cell, x->part->stride[a], 1.0 / size[a], x->n, w->slopes[a][0],
                    w->slopes[a][1]);
    for (int64_t i = 0; i < x->n; i++) {
        double K[3][3], d[2][3], least = INFINITY;
        surface_mesh_metric(s, x->cell + i, K);
        for (int a = 0; a < s->dim; a++) {
            d[0][a] = w->slopes[a][0][i];
            d[1][a] = w->slopes[a][1][i];
            least = fmin(least, size[a] / sqrt(K[a][a]));
        }
        const double sign = old[x->cell + i] < 0.0 ? -1.0 : 1.0;
        rate[x->cell + i] =
            pseudo_cfl(s) * least * sign * (1.0 - size_in_indices(s->dim, K, d[0], d[1], sign));
    }
}

static double size_beside(const struct fv *s, const double *phi, const struct spot *x)
{
    double sum = 0.0, d[2];
    if (s->m)
        return size_beside_on_blocks(s, phi, x);
    for (int a = 0; a < s->b.dim; a++) {
        slopes_beside(s, phi, x, a, d);
        const double in = fmax(0.0, x->sign * d[0]), out = fmin(0.0, x->sign * d[1]);
        sum += fmax(in * in, out * out);
    }
    return sqrt(sum);
}

/* In place of the squares of slopes whose stencils end at a box: phi is even there. */
static void squares_beside_boxes(const struct fv *s, const double *phi, const double *old,
                                 double *sum)
{
    static const enum blocked_ghost even[2] = {GHOST_EVEN, GHOST_EVEN};
    for (int a = 0; a < s->b.dim; a++)
        for (int64_t k = 0; k < s->blocked->nnear[a]; k++) {
            const struct near_box *x = s->blocked->near[a] + k;
            const int64_t c = x->cell, d = s->b.stride[a];
            double v[7], was = 0.0, is = 0.0;
            if (!x->own)
                continue;
            blocked_line(x, phi, d, 3, even, v + 3);
            weno_add_square(phi + c, old + c, d, 1.0 / s->b.h[a], 1, &was);
            weno_add_square(v + 3, old + c, 1, 1.0 / s->b.h[a], 1, &is);
            sum[c] = fmax(0.0, sum[c] + is - was);
        }
}

/* rate = change of phi over a pseudo step; old: phi at its start, which has the sign of all. */
static void rates(const struct fv *s, const double *phi, const double *old, const struct band *w,
                  double *rate)
{
    const struct block *b = &s->b;
    for (int64_t k = 0; k < w->nstrips && s->m; k++)
        rates_of_strip(s, phi, old, w->strips + k, rate);
    for (int64_t k = 0; k < w->nstrips && !s->m; k++) {
        const int64_t c = w->strips[k].cell, n = w->strips[k].n;
        memset(rate + c, 0, (size_t)n * sizeof(double));
        for (int a = 0; a < b->dim; a++)
            weno_add_square(phi + c, old + c, b->stride[a],
                            1.0 / block_scale(b, a, w->strips[k].row), n, rate + c);
    }
    if (s->blocked)
        squares_beside_boxes(s, phi, old, rate);
    for (int64_t k = 0; k < w->nstrips && !s->m; k++) {
        const int64_t c = w->strips[k].cell, n = w->strips[k].n;
        const double dtau = w->strips[k].dtau;
        for (int64_t i = c; i < c + n; i++)
            rate[i] = (old[i] < 0.0 ? -dtau : dtau) * (1.0 - sqrt(rate[i]));
    }
    for (int64_t k = 0; k < w->nspots; k++) {
        const struct spot *x = w->spots + k;
        rate[x->cell] = x->dtau > 0.0 ? x->dtau * x->sign * (1.0 - size_beside(s, phi, x)) : 0.0;
    }
}

static bool beside_surface(const struct fv *s, const struct part *p, const double *phi, int64_t c)
{
    for (int a = 0; a < s->dim; a++)
        for (int way = -1; way <= 1; way += 2)
            if ((phi[c] < 0.0) != (blocked_beside(s, phi, c, way * p->stride[a]) < 0.0))
                return !is_blocked(s, c);
    return false;
}

/* Cells that no reinitialisation changes: boxes, and on blocks those that others interpolate. */
static bool is_left_out(const struct fv *s, int64_t c)
{
    const struct surface_forced *p = s->surface->forced;
    if (!s->m)
        return is_blocked(s, c);
    return s->m->status[c] != CELL_COMPUTED && !(p && p->holds[c]);
}

/* mark = 1 in cells of a row between which and a neighbour along the step d the surface passes;
 * first: instead of what is there. */
static void mark_row(const double *restrict phi, int64_t d, bool first, int64_t n,
                     double *restrict mark)
{
    for (int64_t i = 0; i < n; i++) {
        const bool in = phi[i] < 0.0, low = phi[i - d] < 0.0, up = phi[i + d] < 0.0;
        const double is = (in != low) | (in != up) ? 1.0 : 0.0;
        mark[i] = first || is > mark[i] ? is : mark[i];
    }
}

/* The same of all cells beside the surface. */
static void mark_surface(const struct fv *s, double *mark)
{
    const double *phi = s->surface->phi;
    const bool plain = !s->m && !s->blocked;
    FLOW_NEAR_AT (s, part, j, c, len) {
        for (int a = 0; a < s->dim && plain; a++)
            mark_row(phi + c, part->stride[a], a == 0, len, mark + c);
        for (int64_t i = c; i < c + len && !plain; i++)
            mark[i] = !is_left_out(s, i) && beside_surface(s, part, phi, i);
    }
}

/* next = the largest of mark within m cells along the step d. */
static void widen_row(const double *restrict mark, int64_t d, int m, int64_t n,
                      double *restrict next)
{
    for (int64_t i = 0; i < n; i++)
        next[i] = mark[i];
    for (int k = 1; k <= m; k++)
        for (int64_t i = 0; i < n; i++) {
            const double low = mark[i - k * d], up = mark[i + k * d], most = low > up ? low : up;
            next[i] = most > next[i] ? most : next[i];
        }
}

/* mark = 1 within `width' cells of the surface, whatever phi says there: it may be old. As far at
 * once as ghosts reach. */
static void mark_band(const struct fv *s, int width, double *mark)
{
    double *const next = s->surface->kept;
    memset(mark, 0, (size_t)s->size * sizeof(double));
    mark_surface(s, mark);
    for (int done = 1, m; done < width; done += m) {
        m = width - done < GHOSTS ? width - done : GHOSTS;
        for (int a = 0; a < s->dim; a++) {
            grid_halo(&s->grid, 1, &mark);
            FLOW_NEAR_AT (s, part, j, c, len)
                widen_row(mark + c, part->stride[a], m, len, next + c);
            FLOW_NEAR (s, c, len)
                memcpy(mark + c, next + c, (size_t)len * sizeof(double));
        }
    }
}

static double least_size(const struct block *b, int j)
{
    double least = INFINITY;
    for (int a = 0; a < b->dim; a++)
        least = fmin(least, block_size(b, a, j));
    return least;
}

/* Whether differences around c end at a closed side or a box. */
static bool near_side(const struct fv *s, int64_t c)
{
    for (int a = 0; a < s->dim; a++)
        for (int m = 1; m <= GHOSTS; m++)
            if (surface_holds_none(s, c + m * s->b.stride[a]) ||
                surface_holds_none(s, c - m * s->b.stride[a]))
                return true;
    return false;
}

/* The band's cells; all others are at least as far off as it is wide. */
static void list_band(struct fv *s, int width, struct band *w)
{
    double *phi = s->surface->phi, *mark = s->surface->phi_new, *exact = s->surface->rate;
    const double far = s->surface->least * (width - 1);
    int64_t cells = 0;
    mark_band(s, width, mark);
    FLOW_NEAR (s, c, len)
        for (int64_t i = c; i < c + len; i++) {
            cells += mark[i] > 0.0;
            if ((mark[i] == 0.0 || is_blocked(s, i)) && fabs(phi[i]) < far)
                phi[i] = copysign(far, phi[i]);
        }
    w->strips = NEW(struct strip, cells);
    w->spots = NEW(struct spot, cells);
    surface_ghosts(s, phi);
    FLOW_NEAR_AT (s, part, j, c, len)
        for (int64_t i = c; i < c + len; i++) {
            if (!(mark[i] > 0.0) || is_left_out(s, i))
                continue;
            if (i == c || !(mark[i - 1] > 0.0) || is_left_out(s, i - 1))
                w->strips[w->nstrips++] =
                    (struct strip){.part = part,
                                   .cell = i,
                                   .row = j,
                                   .dtau = s->m ? 0.0 : pseudo_cfl(s) * least_size(&s->b, j)};
            w->strips[w->nstrips - 1].n++;
            exact[i] = phi[i];
            if (!s->m &&
                (surface_closest(s, phi, i, exact + i) || (width == NARROW && near_side(s, i))))
                w->spots[w->nspots++] = (struct spot){.part = part, .cell = i};
            else if (beside_surface(s, part, phi, i))
                w->spots[w->nspots++] = look(s, part, phi, i, j);
        }
}

static void keep_slopes(const struct fv *s, bool keep)
{
    if (s->m)
        s->surface->mesh->keeps = keep;
}

/* Distances that are known take their places. */
static void set_exact(struct fv *s, const struct band *w)
{
    double *phi = s->surface->phi;
    const double *exact = s->surface->rate;
    if (s->m)
        return;
    for (int64_t k = 0; k < w->nspots; k++)
        if (w->spots[k].sign == 0.0)
            phi[w->spots[k].cell] = exact[w->spots[k].cell];
    surface_ghosts(s, phi);
}

/* RK2; where rates are 0 phi is held. */
static void pseudo_step(struct fv *s, const struct band *w)
{
    double *restrict phi = s->surface->phi, *restrict old = s->surface->kept;
    double *restrict rate = s->surface->rate;
    memcpy(old, phi, (size_t)s->size * sizeof(double));
    rates(s, phi, old, w, rate);
    for (int64_t k = 0; k < w->nstrips; k++)
        for (int64_t i = w->strips[k].cell; i < w->strips[k].cell + w->strips[k].n; i++)
            phi[i] += rate[i];
    surface_ghosts(s, phi);
    rates(s, phi, old, w, rate);
    for (int64_t k = 0; k < w->nstrips; k++)
        for (int64_t i = w->strips[k].cell; i < w->strips[k].cell + w->strips[k].n; i++) {
            const double q = 0.5 * (old[i] + phi[i] + rate[i]);
            phi[i] = (q < 0.0) == (old[i] < 0.0) ? q : old[i]; /* the surface stays */
        }
    surface_ghosts(s, phi);
}

static void redistance(struct fv *s, int width, int steps)
{
    struct band w = {0};
    list_band(s, width, &w);
    set_exact(s, &w);
    keep_slopes(s, true);
    for (int k = 0; k < steps; k++)
        pseudo_step(s, &w);
    keep_slopes(s, false);
    mem_free(w.strips);
    mem_free(w.spots);
}

void surface_reinit(struct fv *s, int steps)
{
    redistance(s, BAND_WIDTH, steps);
    s->surface->travelled = 0.0;
    s->surface->reinits++;
}

void surface_redistance(struct fv *s) { redistance(s, NARROW, 1); }

double surface_distortion(const struct fv *s)
{
    const double *phi = s->surface->phi, h = s->surface->largest;
    double most = 0.0;
    FLOW_NEAR_AT (s, part, j, c, len)
        for (int64_t i = c; i < c + len; i++)
            if (fabs(phi[i]) < 2.0 * h && !is_left_out(s, i))
                most = fmax(most, fabs(slope_of(s, part, phi, i, j) - 1.0));
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, s->comm);
    return most;
}

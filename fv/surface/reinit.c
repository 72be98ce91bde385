/* reinit.c - phi_tau + S(phi_0)(|grad phi| - 1) = 0 to the steady state in a band (Godunov's
 * Hamiltonian, RK2, or Euler's steps where they are many and distances beside the surface held). On
 * even cells and rows the distances that closest.c knows are held, two cells on either side of a
 * smooth surface. Elsewhere beside the surface, differences towards it end at its place on the
 * axis, by the quadratic through phi_0, which pins it (Russo & Smereka, J. Comput. Phys. 163, 2000;
 * Min & Gibou, J. Comput. Phys. 225, 2007); where the slope there is good already, phi is left
 * alone, which pins it better still. WENO5 elsewhere. SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "../boundary/fv_boundary.h"
#include "level_ops.h"
#include "reinit_band.h"
#include "surface_forced.h"

enum {
    NARROW = 6 /* the same each half step: those that are advected, and one */
};
static const double good = 0.1; /* | |grad phi| - 1 | of cells beside the surface that stay as is */

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

/* |grad phi| by the grid's central differences. */
static double slope_of(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                       int j)
{
    double g[3] = {0.0, 0.0, 0.0};
    s->surface->ops->gradient(s, p, c, j, phi, g);
    return vec3_length(g);
}

static struct spot look(const struct fv *s, const struct part *p, const double *phi, int64_t c,
                        int j)
{
    struct spot x = {.part = p, .cell = c, .sign = phi[c] < 0.0 ? -1.0 : 1.0, .dtau = INFINITY};
    const struct reinit_ops *ops = s->surface->reinit;
    for (int a = 0; a < s->dim; a++) {
        const double h = ops->height(s, p, c, a, j);
        double v[5];
        x.dtau = fmin(x.dtau, h);
        blocked_even_line(s, phi, c, p->stride[a], v + 2);
        for (int up = 0; up < 2; up++) {
            const int d = up ? 1 : -1;
            if ((v[2] < 0.0) == (v[2 + d] < 0.0))
                continue;
            double length;
            const double part = fmax(1e-6, crossing(v + 2, d)),
                         step = ops->step(s, a, j + up, h, &length);
            x.reach[a][up] = part * step;
            x.dtau = fmin(x.dtau, part * length);
        }
    }
    x.dtau *= reinit_cfl(s);
    if (fabs(slope_of(s, p, phi, c, j) - 1.0) < good)
        x.dtau = 0.0;
    return x;
}

/* rate = change of phi over a pseudo step; old: phi at its start, which has the sign of all. */
static void rates(const struct fv *s, const double *phi, const double *old, const struct band *w,
                  double *rate)
{
    const struct reinit_ops *ops = s->surface->reinit;
    ops->rates(s, phi, old, w, rate);
    for (int64_t k = 0; k < w->nspots; k++) {
        const struct spot *x = w->spots + k;
        rate[x->cell] =
            x->dtau > 0.0 ? x->dtau * x->sign * (1.0 - ops->size_beside(s, phi, x)) : 0.0;
    }
}

/* Whether phi changes its sign between the cell and a neighbour along an axis. */
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
    return is_blocked(s, c) || (!grid_is_computed(&s->grid, c) && !(p && p->holds[c]));
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
    const bool plain = !s->blocked && grid_all_computed(&s->grid);
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

/* Whether phi bends little and is a distance at cell i of local row j. Sides mirror it, which says
 * nothing: cells beside them pass. */
static bool is_smooth(const struct fv *s, const struct part *p, const double *phi, int64_t i, int j)
{
    for (int a = 0; a < s->dim; a++) {
        const int64_t d = p->stride[a];
        if (surface_holds_none(s, i - d) || surface_holds_none(s, i + d))
            return true;
        if (fabs(bend(phi + i, d)) > 0.3 * s->surface->reinit->height(s, p, i, a, j))
            return false;
    }
    const double slope = slope_of(s, p, phi, i, j);
    return slope > 0.77 && slope < 1.27;
}

/* Whether the surface passes within a cell, counted across itself. */
static bool is_near(const struct fv *s, const struct part *p, const double *phi, int64_t i, int j)
{
    double n[3], across = 0.0;
    if (is_left_out(s, i) || fabs(phi[i]) > 1.5 * s->surface->largest * sqrt(s->dim))
        return false;
    surface_slopes(s, p, i, n);
    for (int a = 0; a < s->dim; a++)
        across += fabs(n[a]);
    across /= fmax(1.0, slope_of(s, p, phi, i, j));
    return fabs(phi[i]) <= fmax(across, s->surface->least);
}

/* Collective. */
static bool is_calm(const struct fv *s, const double *phi)
{
    bool calm = true;
    FLOW_ROWS_AT (s, part, j, c, len)
        for (int64_t i = c; i < c + len && calm; i++)
            calm = !is_near(s, part, phi, i, j) || is_smooth(s, part, phi, i, j);
    return ranks_all(s->comm, calm);
}

/* Only where blocks overlap. Steps since the water became calm; what is so at the start has long
 * been. */
void surface_note_calm(struct fv *s, bool start)
{
    struct surface *f = s->surface;
    if (!f->reinit->is_known || !grid_overlaps(&s->grid))
        return;
    f->calm = is_calm(s, f->phi) ? fmin(start ? SURFACE_CALM : f->calm + 1.0, SURFACE_CALM) : 0.0;
}

/* Whether distances that closest.c knows are held. Where blocks overlap films lose twice as much by
 * them, and no share of water keeps it: there in calm water alone. */
static bool holds_exact(const struct fv *s)
{
    const struct surface *f = s->surface;
    return f->reinit->is_known && (!grid_overlaps(&s->grid) || f->calm == SURFACE_CALM);
}

/* The band's cells; all others are at least as far off as it is wide. */
static void list_band(struct fv *s, int width, struct band *w)
{
    double *phi = s->surface->phi, *mark = s->surface->phi_new, *exact = s->surface->rate;
    const double far = s->surface->least * (width - 1);
    bool (*const is_known)(const struct fv *, const struct part *, const double *, int64_t, bool,
                           double *) = w->exact ? s->surface->reinit->is_known : NULL;
    int64_t cells = 0;
    mark_band(s, width, mark);
    FLOW_NEAR (s, c, len)
        for (int64_t i = c; i < c + len; i++) {
            cells += mark[i] > 0.0;
            if ((mark[i] == 0.0 || is_blocked(s, i)) && fabs(phi[i]) < far)
                phi[i] = copysign(far, phi[i]);
        }
    ROOM_IN(w, w->strips, cells);
    ROOM_IN(w, w->spots, cells);
    w->nstrips = w->nspots = 0;
    surface_ghosts(s, phi);
    surface_note_bends(s, phi);
    FLOW_NEAR_AT (s, part, j, c, len) {
        struct strip *strip = NULL;
        for (int64_t i = c; i < c + len; i++) {
            if (!(mark[i] > 0.0) || is_left_out(s, i)) {
                strip = NULL;
                continue;
            }
            exact[i] = phi[i];
            if (is_known && is_known(s, part, phi, i, width == NARROW, exact + i)) {
                w->spots[w->nspots++] = (struct spot){.part = part, .cell = i};
                strip = NULL;
                continue;
            }
            if (!strip) {
                strip = w->strips + w->nstrips++;
                *strip = (struct strip){.part = part,
                                        .cell = i,
                                        .row = j,
                                        .dtau = s->surface->reinit->strip_step(s, j)};
            }
            strip->n++;
            if (beside_surface(s, part, phi, i))
                w->spots[w->nspots++] = look(s, part, phi, i, j);
        }
    }
}

/* Distances that are known take their places. */
static void set_exact(struct fv *s, const struct band *w)
{
    double *phi = s->surface->phi;
    const double *exact = s->surface->rate;
    if (!w->exact)
        return;
    for (int64_t k = 0; k < w->nspots; k++)
        if (w->spots[k].sign == 0.0)
            phi[w->spots[k].cell] = exact[w->spots[k].cell];
    surface_ghosts(s, phi);
}

/* One evaluation, which carries distances outwards from the cells where they are held. */
static void carry_step(struct fv *s, const struct band *w)
{
    double *phi = s->surface->phi, *rate = s->surface->rate;
    rates(s, phi, phi, w, rate);
    for (int64_t k = 0; k < w->nstrips; k++)
        for (int64_t i = w->strips[k].cell; i < w->strips[k].cell + w->strips[k].n; i++) {
            const double q = phi[i] + rate[i];
            phi[i] = (q < 0.0) == (phi[i] < 0.0) ? q : phi[i]; /* the surface stays */
        }
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

/* `keeps': while phi is made a distance its slopes behind walls that lean stay as they are. */
static void redistance(struct fv *s, int width, int steps)
{
    struct surface *f = s->surface;
    if (!f->band)
        f->band = mem_own(f, NEW(struct band, 1));
    f->band->exact = holds_exact(s);
    list_band(s, width, f->band);
    set_exact(s, f->band);
    s->surface->keeps = true;
    for (int k = 0; k < steps; k++)
        (steps > 1 && f->band->exact ? carry_step : pseudo_step)(s, f->band);
    s->surface->keeps = false;
}

void surface_reinit(struct fv *s, int steps)
{
    redistance(s, BAND_WIDTH, steps);
    s->surface->travelled = 0.0;
    s->surface->reinits++;
}

void surface_redistance(struct fv *s)
{
    if (holds_exact(s))
        redistance(s, NARROW, 1);
}

/* surface_rows.c - see surface_rows.h. SPDX-License-Identifier: BSD-3-Clause
 *
 * A lattice meets an inclined surface in steps, and each step that lands on a wall is a hammer of
 * its own: at 10 degrees a front of six spacings at once. One along the lattice, but between two
 * of its rows, gains or loses up to half a row: 27 rows for 27.5, 2 % of the water. Here each row
 * of cells that ends at a free surface is stretched or shortened, by half a spacing at most, so
 * that its last particle lies half of its spacing inside: over the last ROWS particles, along the
 * axis on which the surface is inclined by 45 degrees at most. Where one row has a particle more
 * than the next, the two lie a whole spacing apart at the surface, which is the lattice again, and
 * in between staggered. Volumes go with the spacings along the row, so that all of the shape is
 * filled. A surface on faces of the lattice keeps its rows. */
#include "surface_rows.h"

#include "../open_boundaries/sph_open_boundaries.h"
#include "../parallel/domain.h"
#include "../refinement/sph_refinement.h"
#include "first_lattice.h"
#include "rooms.h"

enum { ROWS = 8 };
static const double even = 1e-3; /* of dx: a surface that near to faces of the lattice is on them */

/* What shapes and walls have at a place. */
struct rows_water {
    const struct sph *s;
    const struct exact *e;
};

static bool has_fluid(const struct rows_water *w, const double *x)
{
    return scene_is_fluid(&w->s->run->scene, w->e, x, NULL);
}

static bool has_walls(const struct rows_water *w, const double *x)
{
    return !first_in_walls(w->s, x);
}

static bool is_wet(const struct rows_water *w, const double *x)
{
    return has_fluid(w, x) && !has_walls(w, x);
}

typedef bool is_water(const struct rows_water *w, const double *x);

/* Whether the cell around x has a particle: its centre does, and is not on a face, where rounding
 * would say yes in one row and no in the next. */
static bool is_cell(const struct rows_water *w, is_water *has, const double *x)
{
    for (int k = 0; k < 2 * w->s->dim; k++) {
        double y[3] = {x[0], x[1], x[2]};
        y[k / 2] += (k % 2 ? 1e-6 : -1e-6) * w->s->dx;
        if (!has(w, y))
            return false;
    }
    return true;
}

/* Along an axis between x, which is wet, and x + reach, which is not: how far the fluid goes, m. */
static double find_end(const struct rows_water *w, const double *x, int axis, double reach)
{
    double lo = 0.0, hi = reach;
    for (int k = 0; k < 48; k++) {
        double y[3] = {x[0], x[1], x[2]};
        y[axis] += 0.5 * (lo + hi);
        *(is_wet(w, y) ? &lo : &hi) = 0.5 * (lo + hi);
    }
    return lo;
}

/* Whether the fluid ends at x + way in air, a quarter of a spacing wide or more: between a disc of
 * water and the polygon of its drum are slivers, and rows that were moved there and not beside were
 * renewed in part (a seventh of the finer level's particles missing). */
static bool is_free(const struct rows_water *w, const double *x, int axis, double way)
{
    double y[3] = {x[0], x[1], x[2]}, farther[3] = {x[0], x[1], x[2]};
    y[axis] += way + copysign(1e-6 * w->s->dx, way);
    farther[axis] += way + copysign(0.25 * w->s->dx, way);
    return !has_walls(w, y) && !has_walls(w, farther);
}

/* Where the surface is one row aside, from x, m; NAN: none within 2 dx. The bottom of a body there
 * is none: the column beside a box of a shallow draught took it for a slope and kept the lattice's
 * rows, so that water at rest pushed the box to that side. */
static double end_aside(const struct rows_water *w, const double *x, int axis, double sign)
{
    const double far = 2.0 * sign * w->s->dx;
    double from[3] = {x[0], x[1], x[2]}, to[3] = {x[0], x[1], x[2]};
    from[axis] -= far;
    to[axis] += far;
    if (!is_wet(w, from) || is_wet(w, to))
        return NAN;
    const double way = find_end(w, from, axis, 2.0 * far);
    return is_free(w, from, axis, way) ? way - far : NAN;
}

/* Whether rows along this axis are fitted to the surface that is b from the last centre x: it lies
 * off the faces of the lattice or is inclined to them, by no more than to the other axes. */
static bool is_fitted(const struct rows_water *w, const double *x, int axis, double b)
{
    const double dx = w->s->dx, sign = b > 0.0 ? 1.0 : -1.0, same = 1e-6;
    bool fitted = fabs(fabs(b) - 0.5 * dx) > even * dx;
    for (int a = 0; a < w->s->dim; a++) {
        double slope = 0.0;
        int n = 0;
        for (int side = -1; side <= 1 && a != axis; side += 2) {
            double y[3] = {x[0], x[1], x[2]};
            y[a] += 0.5 * side * dx;
            const double more = (end_aside(w, y, axis, sign) - b) / (0.5 * dx);
            if (isnan(more)) /* the surface ends here */
                continue;
            fitted = fitted || fabs(more) > same;
            slope += side * more;
            n++;
        }
        slope = n > 0 ? fabs(slope) / n : 0.0;
        if ((a != axis && n == 0) || slope > 1.0 + same || (slope > 1.0 - same && a < axis))
            return false;
    }
    return fitted;
}

/* Cells with water beyond the one at x on this way, `most' at most. */
static int count_beyond(const struct rows_water *w, is_water *has, const double *x, int axis,
                        double step, int most)
{
    int n = 0;
    for (double y[3] = {x[0], x[1], x[2]}; n < most; n++) {
        y[axis] += step;
        if (!is_cell(w, has, y))
            break;
    }
    return n;
}

/* Whether the shapes go on that far both ways: rows there end at walls, if at all. Walls are asked
 * for last: their lines may have thousands of points. */
static bool is_deep(const struct rows_water *w, const double *x, int axis)
{
    const double dx = w->s->dx;
    return count_beyond(w, has_fluid, x, axis, dx, ROWS) == ROWS &&
           count_beyond(w, has_fluid, x, axis, -dx, ROWS) == ROWS;
}

/* Whether a mesh stands between x and the end of its row, b from the last centre. */
static bool is_behind_mesh(const struct sph *s, const double *x, const double *last, int axis,
                           double b)
{
    double end[3] = {last[0], last[1], last[2]};
    end[axis] += b;
    return rooms_parted(s) && rooms_crossed(s, x, end);
}

/* How far the last face of a row, n cells beyond the one at x, has to move to be the surface. */
static double shift_of_end(const struct rows_water *w, const double *x, int axis, double step,
                           int n)
{
    double last[3] = {x[0], x[1], x[2]};
    last[axis] += n * step;
    const double b = find_end(w, last, axis, step);
    return is_free(w, last, axis, b) && is_fitted(w, last, axis, b) &&
                   !is_behind_mesh(w->s, x, last, axis, b)
               ? b - 0.5 * step
               : 0.0;
}

/* Whether a face of a shape at x across axis a, inside the domain, lies between two rows. */
static bool is_between(const struct sph *s, int a, double x)
{
    const double begin = first_lattice_begin(&s->run->scene, a, s->lo[a], s->hi[a], s->dx);
    const double n = (x - begin) / s->dx;
    return x > s->lo[a] && x < s->hi[a] && fabs(n - round(n)) > even;
}

/* Whether a level lies between two rows, or is oblique to the lattice. */
static bool is_level_off(const struct sph *s, double level)
{
    const struct scene *c = &s->run->scene;
    const double origin[3] = {0.0, 0.0, 0.0}, zero = scene_height(c, origin);
    for (int a = 0; a < s->dim; a++) {
        double unit[3] = {0.0, 0.0, 0.0};
        unit[a] = 1.0;
        const double rise = scene_height(c, unit) - zero; /* of the height along the axis */
        if (fabs(rise) > 1.0 - 1e-9)
            return is_between(s, a, (level - zero) / rise);
    }
    return true;
}

/* Boxes stand along the lattice, but may end between two rows. */
static bool is_off(const struct sph *s, const struct scene_shape *h)
{
    bool off = h->form == SHAPE_POLYGON || h->form == SHAPE_DISC;
    for (int a = 0; a < s->dim && h->form == SHAPE_BOX; a++)
        off = off || is_between(s, a, h->box[0][a]) || is_between(s, a, h->box[1][a]);
    return off || (h->form == SHAPE_BELOW && is_level_off(s, h->level));
}

/* Water between open sides behind wave zones stays on the lattice: see NOTES, waves on a current.
 */
bool surface_rows_wanted(const struct sph *s)
{
    const struct scene *c = &s->run->scene;
    bool off = c->nshapes == 0 && c->initial.field == FIELD_DROP;
    for (int k = 0; k < c->nshapes; k++)
        off = off || is_off(s, c->shapes + k);
    return off && s->surface && s->prm.noise == 0.0 && !scene_has_wave(c) &&
           !wave_stream_wanted(s->run, &s->prm);
}

double surface_rows_shift(const struct sph *s, const struct exact *e, const double *x, int axis,
                          int sign)
{
    const struct rows_water w = {s, e};
    double beyond[3] = {x[0], x[1], x[2]};
    beyond[axis] += sign * s->dx;
    return is_cell(&w, is_wet, x) && !is_cell(&w, is_wet, beyond)
               ? shift_of_end(&w, x, axis, sign * s->dx, 0)
               : 0.0;
}

double surface_rows_place(const struct sph *s, const struct exact *e, double *x)
{
    const struct rows_water w = {s, e};
    const double centre[3] = {x[0], x[1], x[2]};
    double volume = 1.0;
    if (!is_cell(&w, has_fluid, centre))
        return 0.0;
    if (!is_cell(&w, is_wet, centre))
        return volume;
    for (int a = 0; a < s->dim; a++) {
        if (is_deep(&w, centre, a))
            continue;
        const int n[2] = {count_beyond(&w, is_wet, centre, a, -s->dx, ROWS),
                          count_beyond(&w, is_wet, centre, a, s->dx, ROWS)};
        const double length = fmin(ROWS, n[0] + n[1] + 1);
        double factor = 1.0;
        for (int k = 0; k < 2; k++) {
            if (n[k] >= length)
                continue;
            const double step = k ? s->dx : -s->dx;
            const double shift = shift_of_end(&w, centre, a, step, n[k]);
            x[a] += shift * (1.0 - (n[k] + 0.5) / length);
            factor += shift / (step * length);
        }
        volume *= factor;
    }
    return volume;
}

/* --- finer levels --- */

/* Whether rows of the next coarser level are moved here. */
static bool is_near(const struct rows_water *coarser, const double *x)
{
    const double dx = coarser->s->dx;
    if (!is_cell(coarser, is_wet, x))
        return true;
    for (int a = 0; a < coarser->s->dim; a++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double last[3] = {x[0], x[1], x[2]};
            const int n = count_beyond(coarser, is_wet, x, a, sign * dx, ROWS + 1);
            last[a] += n * sign * dx;
            if (n <= ROWS && is_free(coarser, last, a, find_end(coarser, last, a, sign * dx)))
                return true;
        }
    return false;
}

/* The last particle takes the place of one that goes, so i stays. */
static void remove_near(struct sph *s, const struct rows_water *coarser)
{
    for (int i = 0; i < s->p.n;) {
        double x[3] = {0.0, 0.0, 0.0};
        memcpy(x, state_row(&s->p, s->p.y, i), (size_t)s->dim * sizeof *x);
        if (is_near(coarser, x))
            particles_copy(&s->p, i, --s->p.n);
        else
            i++;
    }
}

static void add_at(struct sph *s, const struct rows_water *w, const double *centre)
{
    double x[3] = {centre[0], centre[1], centre[2]};
    const double volume = surface_rows_place(s, w->e, x);
    if (volume == 0.0 || !first_has_room(s, x))
        return;
    const int i = first_add(s, w->e, s->p.next_id, x, volume);
    s->p.next_id += s->run->size;
    memset(slope_line(&s->p, i), 0, (size_t)s->p.nslope * sizeof(double));
    s->p.role[i] = ROLE_GUARD; /* until it gets its role */
}

struct renewal {
    struct sph *s;
    const struct regions *regions;
    struct rows_water own, coarser;
    double lo[3], hi[3]; /* m: of this rank's part */
};

/* Cells of the level within one of a coarser level, of spacing dx around x. */
static void add_within(const struct renewal *r, const double *x, int level, double dx)
{
    struct sph *s = r->s;
    const double d = regions_distance(r->regions, s->level, x);
    if (level < s->level) {
        for (int k = 0; k < 1 << s->dim && d > -dx; k++) {
            double y[3] = {x[0], x[1], x[2]};
            for (int a = 0; a < s->dim; a++)
                y[a] += (k >> a & 1 ? 0.25 : -0.25) * dx;
            add_within(r, y, level + 1, 0.5 * dx);
        }
        return;
    }
    for (int a = 0; a < s->dim; a++)
        if (x[a] < r->lo[a] || x[a] >= r->hi[a])
            return;
    if (d >= 0.0 && is_cell(&r->own, is_wet, x) && is_near(&r->coarser, x))
        add_at(s, &r->own, x);
}

static void add_in_cell(const double *centre, double dx, void *ctx)
{
    add_within(ctx, centre, 0, dx);
}

void surface_rows_renew(struct sph *s)
{
    struct sph *coarsest = s;
    while (coarsest->coarser)
        coarsest = coarsest->coarser;
    if (!surface_rows_wanted(coarsest) || rooms_parted(coarsest))
        return;
    const struct exact e = exact_create(&s->run->scene);
    struct renewal r = {.s = s,
                        .regions = coarsest->refinement->regions,
                        .own = {s, &e},
                        .coarser = {s->coarser, &e}};
    domain_bounds(s->domain, r.lo, r.hi);
    s->p.nghost = 0;
    remove_near(s, &r.coarser);
    first_lattice_each_near(coarsest, s->domain, add_in_cell, &r);
    s->lists.ready = false;
}

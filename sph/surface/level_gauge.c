/* level_gauge.c - see level_gauge.h. The volume of the fluid in a column around the place over the
 * column's cross-section, drops included, on top of the floor: the first wall or body below the
 * place (the first above it that holds fluid, where the place is in a wall itself), else the end of
 * the domain to which gravity draws. Where walls stand in the column it ends there, and where the
 * floor falls off as a cliff, below which there may be air; what of solids above the place lies
 * below the level counts as water, where no air is left below them. Heights are against gravity,
 * along the axis with most of it, from the origin.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "level_gauge.h"

#include "../../common/scene/scene.h"
#include "../particles/sph_particles.h"
#include "../walls/sph_walls.h"
#include "level_window.h"
#include "surface.h"

enum { SAMPLES_2D = 16, SAMPLES_3D = 8, SAMPLES_CUT = 32 }; /* of a floor, along an axis */
enum { HALVINGS = 50 };                                     /* of what a level is searched in */

/* A solid above one place of the section: its underside and how high it is, m; share: of the
 * section. */
struct above {
    double share, under, height;
};

struct column {
    int up;              /* axis of gravity, else the last one */
    double sign;         /* of its direction upwards */
    double bottom, top;  /* m: heights of the domain's ends */
    double at[3];        /* the place, in the fluid */
    double lo[3], hi[3]; /* m from it: across */
    double half;         /* m: half width of the hat function that weights it */
    bool walled;         /* by more than sides of the domain */
    bool cut;            /* walls or cliffs hide a part of the section */
    bool covered;        /* all of the section lies below a solid */
    double section, floor;
    double cliff;         /* m: a floor below this is another one than that below the place */
    double ground, crest; /* m: highest place of the floor, of solids above the place */
    double roof;          /* m: mean underside of solids above the place; NAN: none */
    struct above over;    /* the place; height 0: none */
    int nabove;
    struct above *above; /* SAMPLES_CUT^2 of them, of the caller */
};

/* Lines, meshes or bodies: sides alone leave the floor even and columns upright. */
static bool has_walls_inside(const struct sph *s)
{
    const struct scene *c = &s->run->scene;
    bool any = s->walls && c->nbodies > 0;
    for (int k = 0; s->walls && k < c->nwalls; k++)
        any = any || (c->walls[k].side == SIDE_NONE && c->walls[k].kind <= WALL_NO_SLIP);
    return any;
}

/* How far it is free of walls from x along an axis, m, signed as `far', which it never exceeds in
 * size. */
static double free_way(const struct sph *s, const double *x, int axis, double far)
{
    double d[3] = {0.0, 0.0, 0.0};
    d[axis] = far;
    return walls_meet(s, x, d) * far;
}

/* Height of x against gravity, m. */
static double height_of(const struct column *c, const double *x) { return c->sign * x[c->up]; }

/* Moves x up by `by', m. */
static void lift(const struct column *c, double *x, double by) { x[c->up] += c->sign * by; }

/* How far it is free from x upwards or, if `far' is below 0, downwards, m. */
static double free_height(const struct sph *s, const struct column *c, const double *x, double far)
{
    return c->sign * free_way(s, x, c->up, c->sign * far);
}

/* Out of the solid that the place is in or on, upwards. Tries a few times, since solids may touch
 * each other; if it ends above the domain the place stays as it is. */
static void rise_from_solid(const struct sph *s, struct column *c)
{
    const double step = 0.01 * s->dx;
    double way[3], y[3];
    memcpy(y, c->at, sizeof y);
    for (int k = 0; k < 8; k++) {
        const bool inside = walls_in_body(s, y);
        if (!inside && walls_way(s, y, 1e30, way) >= step)
            break;
        lift(c, y, inside ? 0.0 : -2.0 * step); /* it may be on a face */
        lift(c, y, free_height(s, c, y, c->top - height_of(c, y)) + step);
        if (height_of(c, y) >= c->top)
            return;
    }
    memcpy(c->at, y, sizeof y);
}

/* Integral of the hat function from minus infinity to x, m. The hat is 1 at 0 and falls to 0 at
 * +-half; the integral over all is `half'. */
static double hat_until(const struct column *c, double x)
{
    const double t = fmax(-1.0, fmin(1.0, x / c->half)), rest = 1.0 - fabs(t);
    return t < 0.0 ? 0.5 * c->half * rest * rest : c->half * (1.0 - 0.5 * rest * rest);
}

/* Whether walls hide the place across from the one at x, or at its height what is `by' higher; or
 * there is a cliff between them. */
static bool is_hidden(const struct sph *s, const struct column *c, const double *across, double by)
{
    double d[3] = {0.0, 0.0, 0.0}, x[3];
    memcpy(x, c->at, sizeof x);
    for (int a = 0; a < s->dim; a++) {
        d[a] = a == c->up ? 0.0 : across[a];
        x[a] += d[a];
    }
    if (walls_meet(s, c->at, d) < 1.0 || (by < 0.0 && free_height(s, c, x, by) > by))
        return true;
    const double h = height_of(c, x), floor = h + free_height(s, c, x, c->bottom - h);
    return floor < c->cliff;
}

/* Floor and roof over one place of the section; sums: weight, floor, roof's weight, roof. Where the
 * solid above ends at the top of the domain it is a ceiling, not something that water can drown. */
static void sound(const struct sph *s, const struct column *c, const double *across, double weight,
                  double sums[4], struct column *to)
{
    double x[3];
    memcpy(x, c->at, sizeof x);
    if (is_hidden(s, c, across, 0.0))
        return;
    for (int a = 0; a < s->dim; a++)
        x[a] += a == c->up ? 0.0 : across[a];
    const double h = height_of(c, x);
    sums[0] += weight;
    const double floor = h + free_height(s, c, x, c->bottom - h);
    sums[1] += weight * floor;
    to->ground = fmax(to->ground, floor);
    const double room = c->top - h, roof = free_height(s, c, x, room);
    if (roof >= room)
        return;
    const double under = h + roof, eps = 1e-6 * s->dx;
    lift(c, x, roof + eps);
    const double rest = c->top - height_of(c, x), height = free_height(s, c, x, rest);
    if (!(rest > 0.0) || height >= rest) /* solid up to the top */
        return;
    sums[2] += weight;
    sums[3] += weight * under;
    to->above[to->nabove++] = (struct above){weight, under, height + eps};
    to->crest = fmax(to->crest, under + height);
}

/* Samples floor and roof over the section at n places along each axis, weighted by the hat
 * function, and takes means for floor and roof, extremes for ground and crest. The section shrinks
 * by the share of places that walls hide. */
static void sound_by(const struct sph *s, struct column *c, int n)
{
    const int m = s->dim == 2 ? 1 : n;
    double sums[4] = {0.0}, unused[4] = {0.0}, all = 0.0;
    struct above one;
    struct column highest = {.ground = -INFINITY, .crest = -INFINITY, .above = c->above},
                  just = {.above = &one};
    const double at = height_of(c, c->at);
    c->cliff = at + free_height(s, c, c->at, c->bottom - at) - c->half;
    sound(s, c, (double[3]){0.0}, 1.0, unused, &just);
    for (int k = 0; k < n * m; k++) {
        int cell = k;
        double across[3] = {0.0, 0.0, 0.0}, weight = 1.0;
        for (int a = 0; a < s->dim; a++) {
            if (a == c->up)
                continue;
            across[a] = c->lo[a] + (cell % n + 0.5) / n * (c->hi[a] - c->lo[a]);
            weight *= fmax(0.0, 1.0 - fabs(across[a]) / c->half);
            cell /= n;
        }
        all += weight;
        sound(s, c, across, weight, sums, &highest);
    }
    if (!(sums[0] > 0.0))
        return;
    c->cut = sums[0] < all;
    c->covered = sums[2] == sums[0];
    c->section *= sums[0] / all;
    c->floor = sums[1] / sums[0];
    c->ground = highest.ground;
    c->crest = highest.crest;
    c->roof = sums[3] / sums[2]; /* NAN: none */
    c->over = just.nabove > 0 ? one : c->over;
    c->nabove = highest.nabove;
    for (int k = 0; k < c->nabove; k++)
        c->above[k].share /= sums[0];
}

/* 16 places in 2D and 8 x 8 in 3D, more where an edge runs through the section: beside the corner
 * of a block that was found to half a spacing, and the level was 1.1 dx too high (1.5 ms a gauge
 * and row of the series). */
static void sound_all(const struct sph *s, struct column *c)
{
    const double section = c->section;
    sound_by(s, c, s->dim == 2 ? SAMPLES_2D : SAMPLES_3D);
    const bool steps = c->ground > c->floor + 0.5 * s->dx || (c->nabove > 0 && !c->covered);
    if (s->dim == 3 && (c->cut || steps)) {
        c->section = section;
        sound_by(s, c, SAMPLES_CUT);
    }
}

/* Sets which axis points upwards, with its sign, and the heights of the domain's two ends along
 * it. */
static void set_axis(const struct sph *s, struct column *c)
{
    const struct scene *is = &s->run->scene;
    const int axis = scene_still_axis(is);
    c->up = axis < 0 ? s->dim - 1 : axis;
    c->sign = axis >= 0 && is->fluid.gravity[axis] > 0.0 ? -1.0 : 1.0;
    c->bottom = c->sign > 0.0 ? s->lo[c->up] : -s->hi[c->up];
    c->top = c->sign > 0.0 ? s->hi[c->up] : -s->lo[c->up];
}

/* The column of the gauge at `at': a hat function of half width 2 dx across, cut off at walls and
 * at ends of the domain, 3 dx inside open sides (in the rows behind an inflow 0.1 m were read where
 * 0.4 m stood). Without walls inside, floor and section follow from the domain alone. */
static struct column column_at(const struct sph *s, const double *at, struct above *above)
{
    struct column c = {.half = 2.0 * s->dx,
                       .section = 1.0,
                       .roof = NAN,
                       .walled = has_walls_inside(s),
                       .above = above};
    set_axis(s, &c);
    c.floor = c.ground = c.bottom;
    for (int a = 0; a < s->dim; a++)
        c.at[a] = a == c.up ? at[a] : region_clear(s, a, at[a], region_side_opens);
    if (c.walled)
        rise_from_solid(s, &c);
    for (int a = 0; a < s->dim; a++) {
        if (a == c.up)
            continue;
        c.lo[a] = s->periodic[a] ? -c.half : fmax(-c.half, s->lo[a] - c.at[a]);
        c.hi[a] = s->periodic[a] ? c.half : fmin(c.half, s->hi[a] - c.at[a]);
        if (c.walled && c.lo[a] < 0.0 && c.hi[a] > 0.0) {
            c.lo[a] = free_way(s, c.at, a, c.lo[a]);
            c.hi[a] = free_way(s, c.at, a, c.hi[a]);
        }
        c.section *= hat_until(&c, c.hi[a]) - hat_until(&c, c.lo[a]);
    }
    if (c.walled)
        sound_all(s, &c);
    return c;
}

/* Share of a particle d away along an axis across: it is as wide as dx, so that a lattice fills the
 * column exactly, beside walls, too. The difference of the hat's integral over +-dx/2 is exact for
 * particles that are boxes of width dx. */
static double share_across(const struct sph *s, const struct column *c, int a, double d)
{
    const double r = 0.5 * s->dx;
    if (c->walled &&
        ((d < c->lo[a] && c->lo[a] > -c->half) || (d > c->hi[a] && c->hi[a] < c->half)))
        return 0.0; /* beyond a wall */
    return (hat_until(c, d + r) - hat_until(c, d - r)) / s->dx;
}

/* What a column holds, m^dim: all; of it what is below a solid above the place, in the window, and
 * above; particles of a surface in the window, and those in the zones before open sides. */
enum {
    COLUMN_ALL,
    COLUMN_UNDER,
    COLUMN_WINDOW,
    COLUMN_ABOVE,
    COLUMN_SURFACE,
    COLUMN_ZONED,
    COLUMN
};

/* Adds the volumes of what flows of one level, weighted by the hat function. Where levels meet each
 * counts by its share: by their roles rows of the coarser one were in or out as a whole, and the
 * level jumped by half a spacing with each row that crossed an edge. Local to the rank. Positions
 * across are taken to the nearest periodic image. */
static void add_level(const struct sph *s, const struct column *c, const struct level_window *w,
                      double sums[COLUMN])
{
    for (int i = 0; i < s->p.n; i++) {
        const double *q = prim_line(&s->p, i), z = height_of(c, q);
        double weight = q[at_volume(s->dim)];
        double across[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < s->dim && weight > 0.0; a++) {
            if (a == c->up)
                continue;
            across[a] = q[a] - c->at[a];
            if (s->periodic[a])
                across[a] = remainder(across[a], s->hi[a] - s->lo[a]);
            weight *= share_across(s, c, a, across[a]);
        }
        weight *= weight > 0.0 ? particles_share(s, q) : 1.0;
        if (!(weight > 0.0) ||
            (c->walled && is_hidden(s, c, across, c->sign * (q[c->up] - c->at[c->up]))))
            continue;
        const double above = level_window_above(w, z), inside = level_window_inside(w, z, above);
        sums[COLUMN_ALL] += weight;
        sums[COLUMN_UNDER] += z < c->roof ? weight : 0.0;
        sums[COLUMN_ABOVE] += weight * above;
        sums[COLUMN_WINDOW] += weight * inside;
        sums[COLUMN_ZONED] += s->p.zone[i] != ZONE_FREE;
        sums[COLUMN_SURFACE] += inside > 0.0 && s->surface && s->surface->is[i] == SURFACE_ON;
    }
}

/* Adds what all levels and ranks hold in the column. Collective. */
static void sum_column(const struct sph *s, const struct column *c, const struct level_window *w,
                       double sums[COLUMN])
{
    for (const struct sph *q = s; q; q = q->finer)
        add_level(q, c, w, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums, COLUMN, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

/* Height of the water's column below a level, without what solids take of it, m. */
static double water_below(const struct column *c, double level)
{
    double water = level - c->floor;
    for (int k = 0; k < c->nabove; k++) {
        const struct above *a = c->above + k;
        water -= a->share * fmax(0.0, fmin(level - a->under, a->height));
    }
    return water;
}

/* Level as if the water filled the column's section; what of solids lies below it counts as water,
 * but what stands on one with air below it is another water. Below a hull that pierces the surface
 * it is its underside. Under a roof over all of the section half a spacing more is noise. */
static double level_of(const struct sph *s, const struct column *c, const double *sums)
{
    const double water = sums[COLUMN_ALL] / c->section, level = c->floor + water;
    const double under = c->floor + sums[COLUMN_UNDER] / c->section;
    double low = level, high = level;
    if (c->covered && under < c->roof - s->dx)
        return under;
    if (c->nabove == 0 || (c->covered && level <= c->roof + 0.5 * s->dx))
        return level;
    for (int k = 0; k < c->nabove; k++)
        high += c->above[k].share * c->above[k].height;
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (low + high);
        if (water_below(c, middle) < water)
            low = middle;
        else
            high = middle;
    }
    const double top = c->over.under + c->over.height;
    return high > c->over.under && high < top ? c->over.under : high;
}

/* Whether the water of the column can stand closer, or wider, than its volumes say: beside walls,
 * over a floor that is not even, under a roof, where levels of refinement meet and in the zones
 * before open sides, where particles are given their volumes. */
static bool is_disturbed(const struct sph *s, const struct column *c, double zoned)
{
    bool cut = c->cut || zoned > 0.0 || s->finer || c->ground > c->floor + 1e-6 * s->dx ||
               isfinite(c->roof);
    for (int a = 0; a < s->dim; a++)
        cut = cut || (a != c->up && c->hi[a] - c->lo[a] < (4.0 - 1e-6) * s->dx);
    return cut;
}

/* Away from walls the volumes over the section are the level: their sum over a closed tank is that
 * of its water (to 3e-5 in waves). Elsewhere the section that water really fills is that of its
 * inside, from above the ground to below the level: there volumes do not add up to the column's,
 * but the topmost row holds less than a row's, by which the level would be 0.03 dx low. Water with
 * air in it, or less than 5.5 dx deep, fills the section. Hence a second sum: the first is for the
 * level, from which the window follows. */
double level_gauge(struct sph *s, const double *at)
{
    struct above above[SAMPLES_CUT * SAMPLES_CUT];
    const struct column c = column_at(s, at, above);
    const struct level_window none = level_window(INFINITY, INFINITY, s->dx);
    double all[COLUMN] = {0.0}, sums[COLUMN] = {0.0};
    sum_column(s, &c, &none, all);
    const double level = level_of(s, &c, all);
    const struct level_window w = level_window(isfinite(c.roof) ? c.crest : c.ground, level, s->dx);
    if (!is_disturbed(s, &c, all[COLUMN_ZONED]) || !level_window_fits(&w))
        return level;
    sum_column(s, &c, &w, sums);
    const double section = sums[COLUMN_WINDOW] / (w.high - w.low);
    const bool is_water = sums[COLUMN_SURFACE] == 0.0 && level_window_is_water(section / c.section);
    return is_water ? w.high + sums[COLUMN_ABOVE] / section : level;
}

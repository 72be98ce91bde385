/* side_levels.c - see side_levels.h. Under a free surface an open side does not know how high the
 * water outside stands. Here it is measured in a band of the free zone beside the transition (as
 * long as that), in the sense of level gauges (level_window.h), and smoothed over `memory'; or it
 * is given, and then waves that leave raise it; that of the start where more comes in than waves
 * could run against. Pressure outside is hydrostatic below that level.
 * Updated at each stage's start, the same on all ranks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "side_levels.h"

#include "../surface/sph_surface.h"
#include "openings.h"

/* Transits of the domain, there and back, over which the mean velocity forgets; and how long the
 * measured level does, in R/c0, which is some steps. */
static const double transits = 2.0, memory = 5.0;

/* What runs back beside what leaves meets so many times its head. With once, as out of water at
 * rest, an eddy feeds itself no longer, but in the wake of a sill it grew in the opening for 20 s
 * and took a tenth of it. Of ducts it is once: in the mouth of a sharp bend more drives particles
 * through the walls. */
static const double held_back = 6.0;

enum { KEPT = 6 };

/* What is known of one side. Heights are against gravity, in m. */
struct side_water {
    const struct scene_wall *is; /* NULL: not open */
    union {
        struct {
            double given;      /* m: level, of a torrent that of the start; NAN: that inside */
            double level;      /* m: of the water outside */
            double rate;       /* m/s: at which it rises */
            double inside;     /* m: level of the water inside */
            double mean, past; /* m/s: velocity outwards, and that of the last two transits */
        };
        double kept[KEPT]; /* the same, as restart files hold it */
    };
    double bed, depth, area; /* m, m, m^(dim-1): of the water in the opening */
    double width;            /* m^(dim-2): of the opening, 1 in 2D */
    double tide, surge;      /* s: half a transit; m: what its level changes by in it; 0: no file */
    double *room;            /* m^(dim-1): of each row of faces that no wall cuts off */
};

struct side_levels {
    int up;
    double sign, g; /* +1: gravity points down this axis; m/s^2 */
    int rows;       /* of faces, upwards */
    double bottom;  /* m: height of the lowest one's lower edge */
    struct side_water of[6];
    bool sounded; /* room and bed are known */
    bool started; /* levels are known */
    double t;     /* s: of the last update */
};

/* An outlet without a discharge keeps the level that it starts with. */
static bool has_level(const struct scene_wall *w)
{
    return w->has_level || (w->kind == WALL_OUTFLOW && !w->has_discharge);
}

bool side_levels_given(const struct side_levels *l, int side) { return has_level(l->of[side].is); }

struct side_levels *side_levels_create(const struct sph *s)
{
    const int up = scene_still_axis(&s->run->scene);
    if (s->prm.surface != SURFACE_YES || up < 0)
        return NULL;
    struct side_levels *l = NEW(struct side_levels, 1);
    l->up = up;
    l->sign = s->gravity[up] < 0.0 ? 1.0 : -1.0;
    l->g = fabs(s->gravity[up]);
    l->rows = (int)lround((s->hi[up] - s->lo[up]) / s->dx);
    l->bottom = l->sign > 0.0 ? s->lo[up] : -s->hi[up];
    l->t = s->t;
    for (int side = 0; side < 2 * s->dim; side++) {
        struct side_water *of = l->of + side;
        if (!s->open[side])
            continue;
        of->is = scene_wall_of(&s->run->scene, SIDE_X_MIN + side);
        of->given = of->is->has_level ? wall_level(of->is, s->t) : NAN;
        of->room = NEW_IN(l, double, l->rows);
        of->width = 1.0;
        for (int a = 0; a < s->dim; a++)
            if (a != side / 2 && a != up)
                of->width *= s->hi[a] - s->lo[a];
    }
    return l;
}

/* Of a level that follows a file, by the depth at its beginning. */
static void start_tide(const struct sph *s, const struct side_levels *l, struct side_water *of,
                       int side)
{
    const double depth = of->is->has_level ? wall_level(of->is, -INFINITY) - of->bed : 0.0;
    if (!of->is->levels || !(depth > 0.0))
        return;
    of->tide = 0.5 * (s->hi[side / 2] - s->lo[side / 2]) / sqrt(l->g * depth);
    of->surge = wall_level_change(of->is, of->tide);
}

/* What walls leave of each row of faces. The bed is the lower edge of the lowest row that walls
 * leave open, in part for a row that they cut. */
static void find_room(const struct sph *s, struct side_levels *l)
{
    const struct openings *o = s->zones->openings;
    double x[3];
    for (int side = 0; side < 2 * s->dim; side++)
        if (l->of[side].is) {
            struct side_water *of = l->of + side;
            memset(of->room, 0, (size_t)l->rows * sizeof *of->room);
            for (int f = o->first[side]; f < o->first[side + 1]; f++) {
                (void)openings_place(o, f, x);
                const int row = (int)floor((l->sign * x[l->up] - l->bottom) / s->dx);
                of->room[row] += o->room[f] * s->dxD / s->dx;
            }
            int first = 0;
            while (first < l->rows - 1 && of->room[first] == 0.0)
                first++;
            of->bed = l->bottom +
                      s->dx * (first + 1.0 - fmin(of->room[first] / (s->dx * of->width), 1.0));
            of->depth = l->started ? of->level - of->bed : 0.0; /* of a restart file's level */
            start_tide(s, l, of, side);
        }
    l->sounded = true;
}

/* Section of the water in an opening up to a level, and the level of a section. */
static double section_below(const struct sph *s, const struct side_levels *l,
                            const struct side_water *of, double level)
{
    double sum = 0.0;
    for (int row = 0; row < l->rows; row++)
        sum += of->room[row] * fmax(0.0, fmin((level - l->bottom) / s->dx - row, 1.0));
    return sum;
}

/* The inverse of section_below, row by row from the bottom. */
static double level_of(const struct sph *s, const struct side_levels *l,
                       const struct side_water *of, double section)
{
    double left = section;
    int row = 0;
    while (row < l->rows - 1 && left > of->room[row])
        left -= of->room[row++];
    const double room = of->room[row];
    if (left <= 0.0 || room <= 0.0)
        return of->bed;
    return room < s->dx * of->width && left <= room && section == left
               ? l->bottom + s->dx * (row + 1.0) - (room - left) / of->width
               : l->bottom + s->dx * (row + fmin(left / room, 1.0));
}

/* What the band of the free zone beside the transition holds, as long as that: within the zones
 * what comes in would measure itself, and the level wanders off. */
enum { BAND_ALL, BAND_WINDOW, BAND_ABOVE, BAND_FLUX, BAND_BASIN, BAND };

/* Part of the lattice cell of a particle `in' deep that lies in the band. */
static double part_in_band(const struct sph *s, double in)
{
    const struct zones *z = s->zones;
    const double from = z->buffer + z->transition, to = from + z->transition, half = 0.5 * s->dx;
    return fmax(0.0, (fmin(in + half, to) - fmax(in - half, from)) / s->dx);
}

/* For each open side: volume in the band, in the window around the level and above it, and the
 * volume's momentum outwards over density; of one with a tide the volume beyond the middle of
 * the band in the middle half of its depth, which over that is the plan area of the basin that the
 * flow in the band fills. */
static void sum_band(const struct sph *s, const struct side_levels *l, double bands[6][BAND])
{
    const int dim = s->dim;
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i), w = y[at_volume(dim)];
        const double height = l->sign * y[l->up];
        for (int side = 0; side < 2 * dim; side++) {
            const struct side_water *of = l->of + side;
            const int a = side / 2;
            const double in = zones_inside(s->lo, s->hi, side, y);
            if (of->tide > 0.0 && in > s->zones->buffer + 1.5 * s->zones->transition &&
                fabs(height - 0.5 * (of->bed + of->inside)) < 0.25 * (of->inside - of->bed))
                bands[side][BAND_BASIN] += w;
            const double part = of->is ? w * part_in_band(s, in) : 0.0;
            if (part == 0.0)
                continue;
            const struct level_window window = level_window(of->bed, of->inside, s->dx);
            const double above = level_window_above(&window, height);
            bands[side][BAND_ALL] += part;
            bands[side][BAND_ABOVE] += part * above;
            bands[side][BAND_WINDOW] += part * level_window_inside(&window, height, above);
            bands[side][BAND_FLUX] +=
                part * (side % 2 ? y[dim + a] : -y[dim + a]) / y[at_mass(dim)];
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, bands, 6 * BAND, MPI_DOUBLE, MPI_SUM, s->run->comm);
}

/* The level inside. As of level gauges, the section that the water fills is that of its inside:
 * where particles have come in their volumes do not quite add up to it. Where the window does not
 * fit (shallow water, the first update, a jump of more than dx) the section is that of the
 * volume. */
static double measured(const struct sph *s, const struct side_levels *l,
                       const struct side_water *of, const double *band)
{
    const double length = s->zones->transition;
    const double plain = level_of(s, l, of, band[BAND_ALL] / length);
    const struct level_window window = level_window(of->bed, of->inside, s->dx);
    if (!l->started || !level_window_fits(&window) || fabs(plain - of->inside) > s->dx)
        return plain;
    const double below = section_below(s, l, of, window.high),
                 room = below - section_below(s, l, of, window.low);
    const double filled = band[BAND_WINDOW] / length / fmax(room, 1e-300);
    return level_window_is_water(filled)
               ? level_of(s, l, of, below + band[BAND_ABOVE] / (length * filled))
               : plain;
}

/* m/s: change in dt of the velocity outwards that a tide fills the basin with, -(A/a) dL/dt, A the
 * basin's plan area, a that of all openings of given level. Without it `past' is two transits
 * behind, and the basin swings by a quarter of a tide of eleven transits too far
 * (fv/boundary/levels.c). */
static double filling(const struct sph *s, const struct side_levels *l, const struct side_water *of,
                      double basin, double dt)
{
    double openings = 0.0;
    for (int side = 0; side < 2 * s->dim; side++)
        if (l->of[side].is && has_level(l->of[side].is))
            openings += l->of[side].area;
    const double middle = 0.5 * (of->inside - of->bed);
    if (!(of->tide > 0.0 && openings > 0.0 && middle > 0.0))
        return 0.0;
    return -basin / (middle * openings) *
           (wall_level_rise(of->is, of->tide, of->surge, s->t) -
            wall_level_rise(of->is, of->tide, of->surge, s->t - dt));
}

/* Where a level is given: the wave that leaves raises it. */
static void let_waves_out(const struct sph *s, const struct side_levels *l, struct side_water *of,
                          int side, double basin, double dt)
{
    const double depth = fmax(of->depth, s->dx), c = sqrt(l->g * depth),
                 Fr = fmin(fabs(of->mean) / c, 0.9);
    const double T = transits * (s->hi[side / 2] - s->lo[side / 2]) / (c * (1.0 - Fr * Fr));
    of->past += (of->mean - of->past) * -expm1(-dt / T) + filling(s, l, of, basin, dt);
    of->level = of->given + c / l->g * (of->mean - of->past);
    of->level -= openings_fall(l->g, of->level - of->bed, of->given - of->bed, of->inside - of->bed,
                               of->mean);
}

/* m/s: into the domain, of an opening whose velocity or discharge is given, through an area. */
static double velocity_in(const struct sph *s, const struct side_water *of, int side, double area)
{
    if (of->is->has_discharge)
        return (of->is->kind == WALL_INFLOW ? 1.0 : -1.0) * wall_discharge(of->is, s->t) /
               fmax(area, 0.5 * s->dx * of->width);
    return openings_inward(side) * of->is->velocity[side / 2];
}

/* Whether water that stands there comes in faster than waves could run against it: then nothing of
 * the level inside is known there, and an inlet that follows it all the same lets it sink, and a
 * jump run into it. */
static bool is_torrent(const struct sph *s, const struct side_levels *l,
                       const struct side_water *of, int side)
{
    const double area = section_below(s, l, of, of->inside), depth = of->inside - of->bed,
                 u = of->is->kind == WALL_INFLOW ? velocity_in(s, of, side, area) : 0.0;
    if (!(depth > s->dx && u > sqrt(l->g * depth)))
        return false;
    log_say("%s: %.3g m/s, faster than its waves: the level in it stays that of the start, %.4g m",
            scene_side_names[side], u, of->inside);
    return true;
}

/* rate is what a level that is free to move does; with a given level it does not enter. It follows
 * over the time of a wave as long as the depth: what the band holds trembles by a thousandth of
 * dx as particles enter and leave, which over T would be a velocity like that of sound, upwards
 * as in the lowest mode of a column, and fed it (a box in 0.3 m/s, 0.5 m deep, c0 31 m/s: +-200 Pa
 * for as long as it ran). */
static void update_side(const struct sph *s, const struct side_levels *l, struct side_water *of,
                        int side, const double *band, double dt)
{
    const double now = measured(s, l, of, band), T = memory * s->R / s->c0;
    const double share = l->started ? -expm1(-dt / T) : 1.0;
    of->rate += ((now - of->inside) / T - of->rate) *
                -expm1(-dt / fmax(T, sqrt(fmax(of->depth, 0.0) / l->g)));
    of->inside += (now - of->inside) * share;
    of->mean += (band[BAND_FLUX] / fmax(band[BAND_ALL], 1e-300) - of->mean) * share;
    if (!l->started)
        of->past = of->mean;
    if (has_level(of->is)) {
        if (of->is->has_level)
            of->given = wall_level(of->is, s->t);
        else if (isnan(of->given))
            of->given = of->inside;
        let_waves_out(s, l, of, side, band[BAND_BASIN], dt);
    } else {
        if (!l->started && is_torrent(s, l, of, side))
            of->given = of->inside;
        of->rate = isnan(of->given) ? of->rate : 0.0;
        of->level = isnan(of->given) ? of->inside : of->given;
    }
    of->depth = of->level - of->bed;
    of->area = section_below(s, l, of, of->level);
}

/* Collective. The bed is found first: it needs faces and walls, which are made after the zones. */
void side_levels_update(const struct sph *s, struct side_levels *l)
{
    double bands[6][BAND] = {{0.0}};
    const double dt = fmax(s->t - l->t, 0.0);
    if (!l->sounded)
        find_room(s, l);
    sum_band(s, l, bands);
    for (int side = 0; side < 2 * s->dim; side++)
        if (l->of[side].is)
            update_side(s, l, l->of + side, side, bands[side], dt);
    l->t = s->t;
    l->started = true;
}

/* Level outside a side, as far as its zone goes. */
void side_levels_surface(const struct sph *s, const struct side_levels *l, int n, const double *x,
                         double *phi, double *gphi)
{
    double below;
    for (int i = 0; i < n; i++)
        phi[i] =
            l->sign * x[3 * i + l->up] - l->of[zones_nearest(s->zones, x + 3 * i, &below)].level;
    for (int i = 0; gphi && i < 3 * n; i++)
        gphi[i] = i % 3 == l->up ? l->sign : 0.0;
}

/* Outside a given level stands water at rest, out of which nothing comes faster than its head
 * allows: that keeps water which runs back from gaining; beside what leaves still less. The level
 * of an inflow is in the opening. As the level rises the water between x and the place whose
 * velocity is known takes its share of what flows: that is at the side itself where a discharge is
 * given, else in the bins of sides.c.
 */
void side_levels_eval(const struct sph *s, const struct side_levels *l, int side, const double *x,
                      double *u, double *p, double *gp)
{
    const struct side_water *of = l->of + side;
    const int n = side / 2;
    const double height = l->sign * x[l->up], out = side % 2 ? u[n] : -u[n],
                 sense = openings_inward(side), stretch = of->rate / fmax(of->depth, s->dx),
                 known = has_level(of->is) ? s->zones->buffer + 0.25 * s->R : 0.0,
                 deeper = zones_inside(s->lo, s->hi, side, x) - known;
    *p = s->rho0 * l->g * (of->level - height);
    for (int a = 0; gp && a < 3; a++)
        gp[a] = a == l->up ? -s->rho0 * l->g * l->sign : 0.0;
    if (has_level(of->is)) {
        const double in = fmin(out, 0.0), all = fmin(of->mean, 0.0),
                     held = of->mean > 0.0 ? held_back : 1.0;
        *p += 0.5 * s->rho0 * ((of->is->kind == WALL_INFLOW ? all * all : 0.0) - held * in * in);
    } else {
        for (int a = 0; a < s->dim; a++)
            u[a] = of->is->has_discharge ? 0.0 : of->is->velocity[a];
        u[n] = sense * velocity_in(s, of, side, of->area);
        u[l->up] += l->sign * stretch * fmax(0.0, fmin(height - of->bed, of->depth));
    }
    u[n] -= sense * stretch * deeper;
}

double side_levels_level(const struct side_levels *l, int side) { return l->of[side].level; }

/* Room and bed are not kept: they follow from the case. */
bool side_levels_restart(struct side_levels *l, struct h5 *f)
{
    double all[6][KEPT];
    for (int side = 0; side < 6; side++)
        memcpy(all[side], l->of[side].kept, sizeof all[side]);
    if (!h5_keep_same(f, "sides_levels", "m", 6 * KEPT, all[0]) ||
        !h5_keep_same(f, "sides_time", "s", 1, &l->t))
        return false;
    for (int side = 0; side < 6; side++)
        memcpy(l->of[side].kept, all[side], sizeof all[side]);
    l->started = l->started || !h5_writes(f);
    return true;
}

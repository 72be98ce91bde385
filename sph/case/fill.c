/* fill.c - the first particles: a lattice at cell centres, each rank its own part, where the shapes
 * of the case have fluid and walls leave room for it; at rest under gravity with its pressure.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fill.h"

#include "../bodies/sph_bodies.h"
#include "../parallel/domain.h"
#include "../particles/sph_particles.h"
#include "../refinement/sph_refinement.h"
#include "../walls/sph_walls.h"
#include "amount.h"
#include "basins.h"
#include "basins_shut.h"
#include "first_lattice.h"
#include "pack.h"
#include "rims.h"
#include "rooms.h"
#include "surface_rows.h"
#include "wall_gaps.h"

/* In [-1, 1), a function of the particle alone, so the same on any number of ranks
 * (splitmix64: Steele, Lea & Flood, OOPSLA 2014). */
static double random_of(int64_t id, int axis)
{
    uint64_t z = ((uint64_t)id * 3 + (uint64_t)axis + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return (double)(z >> 11) * 0x1p-52 - 1.0;
}

/* Where particles start under a wave: columns of equal volumes, each from the floor to the surface,
 * in rows of equal heights, so that all particles have one volume and lie as a wave moves them. A
 * staircase of whole rows had a wave of 1.3 dx a tenth too low; upright columns whose volumes
 * differ are evened out by shifting, which fed a wave of k a = 0.13 tenfold in two periods. */
struct fill_columns {
    int n;
    double *x, *height; /* m: middle; of a row over dx. NULL: the plain lattice */
    double volume;      /* of a particle, dx^D */
};

enum { FINE = 16 }; /* depths to a column */

/* Depth in strip k of n between the sides, m. */
static double depth_at(const struct sph *s, const struct exact *e, int k, int n, double *x)
{
    *x = s->lo[0] + (k + 0.5) * (s->hi[0] - s->lo[0]) / n;
    return exact_surface(e, *x) - s->lo[1];
}

/* Waves far higher than dx keep their staircase: rows would be too flat or too high. */
static double mean_depth(const struct sph *s, const struct exact *e, int strips)
{
    double x, sum = 0.0, least = INFINITY, most = 0.0;
    for (int k = 0; k < strips && scene_has_wave(&s->run->scene); k++) {
        const double depth = depth_at(s, e, k, strips, &x);
        sum += depth / strips;
        least = fmin(least, depth);
        most = fmax(most, depth);
    }
    const bool drawn = most < s->hi[1] - s->lo[1] && least > 0.85 * sum && most < 1.15 * sum;
    return drawn && sum > 2.0 * s->dx ? sum : 0.0;
}

/* Strips are summed from x_min on; where the sum passes i + 1/2 columns the middle of column i
 * lies, within the strip in proportion. */
static struct fill_columns columns_create(const struct sph *s, const struct exact *e)
{
    struct fill_columns c = {.n = (int)first_lattice_cells(s->lo[0], s->hi[0], s->dx),
                             .volume = 1.0};
    const int strips = FINE * c.n;
    const double mean = mean_depth(s, e, strips), rows = round(mean / s->dx);
    double x, sum = 0.0;
    if (mean == 0.0)
        return c;
    c.x = NEW(double, c.n);
    c.height = NEW(double, c.n);
    c.volume = mean / (rows * s->dx);
    for (int k = 0, i = 0; k < strips && i < c.n; k++) {
        const double depth = depth_at(s, e, k, strips, &x), next = sum + depth / mean / FINE;
        for (; i < c.n && i + 0.5 <= next; i++) { /* half of its volume lies in this strip's part */
            const double part = (i + 0.5 - sum) / (next - sum) - 0.5;
            c.x[i] = x + part * (s->hi[0] - s->lo[0]) / strips;
            c.height[i] = (exact_surface(e, c.x[i]) - s->lo[1]) / (rows * s->dx);
        }
        sum = next;
    }
    return c;
}

static void columns_free(struct fill_columns *c) { FREE(c->x, c->height); }

/* What the cells are looked through with. */
struct look {
    struct exact exact;
    struct fill_columns columns;
    bool rows;  /* that end at the surface; surface_rows.h */
    bool drawn; /* some shape has an extent of its own */
    /* cells with fluid by the shapes that have an extent of their own, without such by all; of
     * these behind walls or in bodies */
    int64_t wet, taken;
};

/* Where the particle of a cell starts; its volume, dx^D; 0: it has none. */
static double displace(const struct sph *s, const struct look *look, int64_t cell,
                       const double *centre, double *x)
{
    const struct fill_columns *c = &look->columns;
    const int i = (int)floor((centre[0] - s->lo[0]) / s->dx);
    memcpy(x, centre, 3 * sizeof *x);
    if (look->rows)
        return surface_rows_place(s, &look->exact, x);
    if (c->x && i >= 0 && i < c->n) {
        x[0] = c->x[i];
        x[1] = s->lo[1] + c->height[i] * (centre[1] - s->lo[1]);
    }
    for (int a = 0; a < s->dim && s->prm.noise > 0.0; a++)
        x[a] += s->prm.noise * s->dx * random_of(cell, a);
    return c->volume;
}

/* Each rank asks for its own cells, then all know all cuts. */
static void cut_links(const struct sph *s, struct lattice *l)
{
    double lo[3], hi[3];
    int first[3], last[3];
    first_lattice_own(s->domain, l, s->dim, lo, hi, first, last);
    rooms_cut_links(s, l, first, last);
    for (int a = 0; a < 3; a++)
        lattice_share(l, l->cut[a], s->run->comm);
}

/* Whether x is in a shape that somebody drew; "below" only names a level, and walls and bodies take
 * what they like of it. x: NULL: is there any? */
static bool is_drawn(const struct scene *c, const double *x)
{
    bool any = false;
    for (int k = 0; k < c->nshapes; k++)
        any = any || (c->shapes[k].form != SHAPE_BELOW && !c->shapes[k].hole &&
                      (!x || scene_in_shape(c, c->shapes + k, x)));
    return any;
}

/* The bits of cells with a particle, and how many the walls took of those that shapes meant. */
static void mark(struct sph *s, const struct lattice *l, int64_t cell, const double *centre,
                 void *ctx)
{
    struct look *k = ctx;
    double x[3];
    if (displace(s, k, cell, centre, x) == 0.0 ||
        !scene_is_fluid(&s->run->scene, &k->exact, x, NULL))
        return;
    if (!rooms_parted(s) && !scene_in_tanks(&s->run->scene, x))
        return; /* a shape may reach beyond its tank */
    const bool room = first_has_room(s, x), meant = !k->drawn || is_drawn(&s->run->scene, x);
    k->wet += meant;
    k->taken += meant && !room;
    if (room)
        lattice_set(l->bits, cell);
}

/* The second pass over the lattice, when pockets and dry rooms are cleared. */
static void add(struct sph *s, const struct lattice *l, int64_t cell, const double *centre,
                void *ctx)
{
    const struct look *k = ctx;
    double x[3];
    if (!lattice_has(l, cell))
        return;
    const double volume = displace(s, k, cell, centre, x);
    first_add(s, &k->exact, cell, x, volume);
}

/* Velocity and pressure of the first field where packing has moved a particle to. */
static void refresh(struct sph *s, const struct exact *e)
{
    for (int i = 0; i < s->p.n; i++) {
        const double *y = state_row(&s->p, s->p.y, i), w = y[at_volume(s->dim)];
        double x[3] = {0.0, 0.0, 0.0}, u[3], p, more[3];
        memcpy(x, y, (size_t)s->dim * sizeof *x);
        if (!scene_is_fluid(&s->run->scene, e, x, more)) /* beyond its shape: stays as it was */
            continue;
        exact_point(e, x, 0.0, u, &p, NULL);
        for (int a = 0; a < s->dim; a++)
            u[a] += more[a];
        particles_set(s, i, x, u, w, eos_rho(p, s->rho0, s->c0, s->gamma));
    }
}

/* Density of a fluid at rest at depth d: the exact column of the equation of state. */
static double density_at_rest(const struct sph *s, double g, double d)
{
    const double r = g * d / (s->c0 * s->c0);
    if (s->gamma == 1.0)
        return s->rho0 * exp(r);
    return s->rho0 * pow(fmax(1.0 + 6.0 * r, 0.1), 1.0 / 6.0);
}

/* Whether a partner has the water above. */
static bool has_open_top(const struct sph *s, const double *still)
{
    for (int a = 0; a < s->dim; a++)
        if (still[a] != 0.0 && s->open[still[a] < 0.0 ? 2 * a + 1 : 2 * a])
            return true;
    return false;
}

/* Under which level the water of a cell stands, m; NAN: it falls. */
static double level_of(const struct sph *s, const struct basins *b, int64_t cell)
{
    const double given = s->run->scene.initial.level, level = basins_level(b, cell);
    return isnan(level) || !(given < LEVEL_TOP) ? level : given;
}

/* Gravity against which pressure rises, m/s^2, unless the reference of the pressure has that. */
static double weight_of(const struct sph *s, double still[3])
{
    const double g = scene_still_gravity(&s->run->scene, still);
    for (int a = 0; a < s->dim; a++)
        if (s->reference.slope[a] != 0.0)
            return 0.0;
    return g;
}

/* Masses under gravity: p = 0 at the given height, or on top of each water. A wave and a channel
 * have their own pressure; gravity along a periodic axis drives. */
static void weigh(struct sph *s, const struct basins *b)
{
    const struct scene *c = &s->run->scene;
    const struct scene_initial *f = &c->initial;
    double still[3], off = 0.0;
    const double g = weight_of(s, still);
    if (g == 0.0 || scene_has_wave(c) || f->field == FIELD_POISEUILLE)
        return;
    for (int i = 0; i < s->p.n; i++) {
        double *y = state_row(&s->p, s->p.y, i), x[3] = {0.0, 0.0, 0.0};
        const double level = level_of(s, b, s->p.id[i]);
        if (isnan(level)) /* falls */
            continue;
        off = fmax(off, fabs(level - basins_level(b, s->p.id[i])));
        memcpy(x, y, (size_t)s->dim * sizeof *x);
        const double m = y[at_mass(s->dim)];
        const double more =
            y[at_volume(s->dim)] * density_at_rest(s, g, level - scene_height(c, x)) / m;
        for (int a = 0; a < s->dim; a++)
            y[s->dim + a] *= more;
        y[at_mass(s->dim)] *= more;
    }
    MPI_Allreduce(MPI_IN_PLACE, &off, 1, MPI_DOUBLE, MPI_MAX, s->run->comm);
    if (s->surface && off > s->dx && !(s->run->crossed && has_open_top(s, still)))
        log_warn("initial.level = %g m is %g m off the level of a free surface, which starts with "
                 "%.3g Pa: leave it out",
                 f->level, off, s->rho0 * g * off);
}

static void say_rooms(const struct basins *b)
{
    int wet, dry;
    basins_rooms(b, &wet, &dry);
    if (dry > 0)
        log_say("meshes divide the water of the shapes into %d regions: %d hold(s) fluid",
                wet + dry, wet);
    if (wet == 0 && dry > 0)
        log_warn("no region on the fluid's side of the meshes holds any water: see "
                 "walls.fluid_side, walls.flip and initial.seed");
}

static void say_pockets(const struct basins *b)
{
    int64_t cells;
    double x[3];
    const int n = basins_pockets(b, &cells, x);
    if (n > 0)
        log_say("%d pocket(s) that walls cut off, of %lld particle(s) together, hold no water: too "
                "small to flow; one at (%g, %g) m",
                n, (long long)cells, x[0], x[1]);
}

/* Under a free surface the fluid bears no tension: a siphon breaks where air would hold it up. */
static void warn_of_suction(const struct sph *s, const struct basins *b)
{
    double x[3], still[3];
    const double over = basins_suction(b, x);
    if (s->surface && !(s->run->scene.initial.level < LEVEL_TOP) && over > 2.0 * s->dx)
        log_warn(
            "the water below the roof at (%g, %g, %g) m stands %.3g m above the level of what it "
            "is connected with, at %.3g Pa: it hangs by suction, as in a siphon, which air "
            "would hold up to 10 m; a free surface here bears none, the water breaks off and "
            "falls. Draw it no higher than that level, or fill all to it",
            x[0], x[1], x[2], over, -s->rho0 * weight_of(s, still) * over);
}

static void warn_of_drift(const struct sph *s, int64_t n, const double *x)
{
    log_warn("%lld particle(s) of water are shut in by walls and bodies, at (%g, %g, %g) m: with "
             "levels of refinement or open sides their pressure may drift by %.2g Pa, and so may "
             "the forces around. Let the water outside reach them through a gap of some sph.dx, or "
             "leave that room dry",
             (long long)n, x[0], x[1], x[2], 0.004 * s->rho0 * s->c0 * s->c0);
}

/* Nothing but its own volume holds the pressure of water that is shut in, and volumes follow the
 * packing within 0.4 %. */
static void find_shut_in(struct sph *s, struct basins *b)
{
    double x[3];
    int64_t n;
    unsigned beside;
    s->start.shut = s->surface && !s->zones && basins_all_shut(b);
    if (!s->surface || s->start.shut)
        return;
    for (int k = 0; (n = basins_shut_in(b, k, &beside, x)) > 0; k++) {
        struct shut_water *to = s->finer || s->mixed ? NULL : shut_water_add(s, n, beside);
        if (to)
            basins_cells_shut_in(b, k, to->id);
        else
            warn_of_drift(s, n, x);
        if (to)
            log_say("%lld particle(s) of water are shut in by walls and bodies, at (%g, %g, %g) "
                    "m: they keep the mean pressure of the start, of water %s",
                    (long long)n, x[0], x[1], x[2],
                    shut_water_seeps(beside) ? "that seeps in from outside"
                                             : "that stands up to their roof");
    }
}

/* A tank whose lines run the wrong way, or a body around the fluid, leave hardly any. */
static void warn_of_taken(const struct sph *s, const struct look *k)
{
    long long n[2] = {k->wet, k->taken};
    MPI_Allreduce(MPI_IN_PLACE, n, 2, MPI_LONG_LONG, MPI_SUM, s->run->comm);
    if (k->drawn ? 2 * n[1] > n[0] : n[1] > 0 && n[1] == n[0])
        log_warn(
            "walls and bodies take %lld of %lld particles that the shapes give: lines have "
            "fluid on their left; a body is a tank if all water is inside and there are no walls",
            n[1], n[0]);
}

struct fill {
    struct lattice lattice;
    struct basins *basins;
};

/* Order matters: the bits of all ranks, what meshes part, the waters, then particles, packing, and
 * the weight last, which needs the places that packing leaves. Ids are cells, so that they do not
 * depend on ranks; those born later go on in steps of as many as there are ranks. */
struct fill *fill_lattice(struct sph *s)
{
    struct look look = {.exact = exact_create(&s->run->scene),
                        .drawn = is_drawn(&s->run->scene, NULL)};
    look.columns = columns_create(s, &look.exact);
    look.rows = surface_rows_wanted(s);
    struct fill *f = NEW(struct fill, 1);
    struct lattice *l = &f->lattice;
    *l = first_lattice_create(s);
    mem_own(f, l->bits);
    const int64_t all = lattice_cells(l), ranks = s->run->size;
    first_lattice_each_own(s, l, mark, &look);
    lattice_share(l, l->bits, s->run->comm);
    const bool parted = rooms_parted(s);
    if (parted)
        cut_links(s, l);
    else
        warn_of_taken(s, &look);
    struct basins *b = f->basins = mem_own(f, basins_create(s, l));
    if (parted)
        say_rooms(b);
    say_pockets(b);
    warn_of_suction(s, b);
    find_shut_in(s, b);
    basins_clear(b, l);
    if (parted)
        rims_check(s, l);
    first_lattice_each_own(s, l, add, &look);
    pack_start(s, s->prm.packing);
    if (s->prm.packing > 0)
        refresh(s, &look.exact);
    weigh(s, b);
    columns_free(&look.columns);
    s->p.next_id = (all + ranks - 1) / ranks * ranks + s->run->rank;
    return f;
}

/* Whether the masses of the first particles are those of a fluid at rest; still: weight_of. */
static bool is_weighed(const struct sph *s, double still[3])
{
    const struct scene *c = &s->run->scene;
    return weight_of(s, still) != 0.0 && !scene_has_wave(c) && c->initial.field != FIELD_POISEUILLE;
}

/* Slopes that children are born with: those of water at rest where its weight counts (still: that
 * gravity, m/s^2, else NULL). */
static void set_slopes(struct sph *s, const struct exact *e, const double *still)
{
    const int dim = s->dim;
    if (s->p.n > 0)
        memset(s->p.slope, 0, (size_t)s->p.n * s->p.nslope * sizeof(double));
    for (int i = 0; i < s->p.n && still; i++) {
        const double *y = state_row(&s->p, s->p.y, i);
        const double rho = y[at_mass(dim)] / y[at_volume(dim)];
        const double c = eos_c(rho, s->rho0, s->c0, s->gamma);
        double x[3] = {0.0, 0.0, 0.0}, u[3], p;
        memcpy(x, y, (size_t)dim * sizeof *x);
        exact_point(e, x, 0.0, u, &p, NULL);
        const bool falls = rho == eos_rho(p, s->rho0, s->c0, s->gamma);
        for (int a = 0; a < dim && !falls; a++)
            slope_line(&s->p, i)[a] = rho * still[a] / (c * c);
    }
}

/* The density of water at rest at x: that of the nearest cell which holds some; NAN: none, or it
 * falls. */
static double density_near(const struct sph *q, const struct fill *f, const double *x)
{
    const struct lattice *l = &f->lattice;
    double still[3], level = NAN, least = INFINITY;
    for (int k = 0; k < (q->dim == 3 ? 27 : 9); k++) {
        const int way[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - (q->dim == 3)};
        double y[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < q->dim; a++)
            y[a] = x[a] + way[a] * l->dx;
        const int64_t cell = lattice_find(l, q->dim, y);
        if (cell < 0 || !lattice_has(l, cell))
            continue;
        lattice_place(l, cell, q->dim, y);
        const double d2 = vec_distance2(q->dim, x, y);
        if (d2 < least)
            level = level_of(q, f->basins, cell);
        least = fmin(least, d2);
    }
    const double g = scene_still_gravity(&q->run->scene, still);
    return isnan(level) ? NAN : density_at_rest(q, g, level - scene_height(&q->run->scene, x));
}

/* Fields of the case where particles stand; those that are weighed keep their densities, or are
 * given those of the water that they are in. */
static void set_fields(struct sph *q, const struct exact *e, bool keep_volumes, bool weighed,
                       const struct fill *f, double volume)
{
    for (int i = 0; i < q->p.n; i++) {
        const double *y = state_row(&q->p, q->p.y, i);
        const double w = keep_volumes ? y[at_volume(q->dim)] : volume * q->dxD;
        double x[3] = {0.0, 0.0, 0.0}, u[3], p, more[3];
        memcpy(x, y, (size_t)q->dim * sizeof *x);
        if (!scene_is_fluid(&q->run->scene, e, x, more)) /* beyond its shape */
            continue;
        const double given = weighed && f ? density_near(q, f, x) : NAN;
        const double rho = isnan(given) ? y[at_mass(q->dim)] / y[at_volume(q->dim)] : given;
        exact_point(e, x, 0.0, u, &p, NULL);
        for (int a = 0; a < q->dim; a++)
            u[a] += more[a];
        particles_set(q, i, x, u, w, weighed ? rho : eos_rho(p, q->rho0, q->c0, q->gamma));
    }
}

/* Of one finer level, when it has its children: rows at the surface, gaps at walls, then packing.
 */
static void settle(struct sph *level)
{
    surface_rows_renew(level);
    if (level->prm.packing == 0)
        return;
    wall_gaps_fill(level);
    pack_finer(level);
}

void fill_check(struct sph *s, const struct fill *f)
{
    if (f)
        amount_check(s, &f->lattice);
}

void fill_finer(struct sph *s, const struct fill *f)
{
    const struct exact e = exact_create(&s->run->scene);
    double still[3];
    const bool weighed = is_weighed(s, still);
    set_slopes(s, &e, weighed ? still : NULL);
    if (!s->finer) {
        mixed_start(s);
        set_fields(s, &e, true, weighed, NULL, 1.0);
        return;
    }
    /* Gaps are at walls, or between the children of displaced parents, twice as wide for each
     * level. */
    const bool gaps = s->walls || (s->prm.noise > 0.0 && s->finer->finer);
    struct fill_columns c = columns_create(s, &e);
    const bool rows = surface_rows_wanted(s), packed = s->prm.packing > 0;
    refinement_begin(s, rows || (packed && gaps) ? settle : NULL);
    for (struct sph *q = s->finer; q; q = q->finer)
        set_fields(q, &e, packed || rows, weighed, rows ? f : NULL, c.volume);
    columns_free(&c);
    refinement_remember(s);
}

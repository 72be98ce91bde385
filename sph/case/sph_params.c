/* sph_params.c - parameter table of group sph. SPDX-License-Identifier: BSD-3-Clause */
#include "sph_params.h"

#include "../../common/scene/scene.h"
#include "../bodies/sph_bodies.h"
#include "../open_boundaries/sph_open_boundaries.h"
#include "../refinement/sph_refinement.h"
#include "../sph_facts.h"
#include "../time/sph_time.h"
#include "../walls/sph_walls.h"
#include "sph_sense.h"
#include "sph_unused.h"
#include "standard_check.h"

static struct sph_params given; /* as the case has it: the target of the table */
static bool present;

#define P struct sph_params
/* clang-format off */
static const struct param rows[] = {
    PARAM(P, dx, "m", NULL, 1e-9, 1e6, "initial particle spacing"),
    PARAM(P, R_dx, "-", "4.0", 1.5, 8.0, "radius of the kernel's support over dx"),
    PARAM(P, c0, "m/s", "0.0", 0.0, 1e6, "speed of sound; 0: ten times the largest speed expected in the scene, and density within 1 % at rest and in slow viscous flow"),
    PARAM(P, gamma, "-", "7.0", 1.0, 7.0, "exponent of the equation of state, 7 or 1", .comparison = true),
    CHOICE(P, scheme, "riemann_ale|riemann|delta|standard|auto", "auto", "pair interaction: Riemann ALE (Vila), without mass flux (Leduc); delta-SPH (Antuono); artificial viscosity; auto: riemann with a free surface, but riemann_ale beside inlets and outlets and, without levels of refinement, where waves go on in fv; else riemann_ale"),
    CHOICE(P, riemann, "linear|exact", "linear", "Riemann problem of each pair of the Riemann schemes: linearised; for comparison solved exactly, by Newton's iteration, in twice the time",
          USED(NEED(ONE_SIZE, "only the Riemann schemes solve Riemann problems, and sets of several sizes (apr.method) the linear ones alone")), .comparison = true),
    CHOICE(P, limiter, "koren|minmod|none", "koren", "limiter of the reconstruction between particles",
          USED(NEED(RIEMANN, "schemes delta and standard reconstruct nothing between particles")), .comparison = true),
    CHOICE(P, transport, "tvs|tvo|none|eulerian|xsph", "tvs", "law of particle shifting: whole support, 2 dx (Oger), none; eulerian: particles at rest; xsph: smoothed velocity", .comparison = true),
    CHOICE(P, surface_shift, "along|beta", "along", "how shifting ends at a free surface: along it alone near it, nothing on it; for comparison it fades within 2 dx as the support is cut (Chiron)",
          USED(NEED(SHIFT_ENDS, "no law of shifting (sph.transport) meets a free surface, or sets of several sizes (apr.method) have their own")), .comparison = true),
    CHOICE(P, viscosity, "morris|monaghan|auto", "auto", "form of the viscous term; auto: monaghan with a free surface, where it leaves no stress, else morris",
          USED(NEED(VISCOUS, "fluid.nu is 0: nothing viscous is computed")), .comparison = true),
    PARAM(P, low_dissipation, "-", "true", 0, 1, "bounded dissipation of the Riemann solver (Zhang, Hu & Adams)",
          USED(NEED(RIEMANN, "schemes delta and standard solve no Riemann problem")), .comparison = true),
    PARAM(P, dissipation, "-", "-1.0", -1.0, 1.0, "least share of the Riemann dissipation that low_dissipation leaves; -1: 0.1 with a free surface and where walls support the weight of a fluid that fills its room, else 0; under a surface less what friction of pairs does, 2 (dim + 2) nu/(c0 dx)",
          USED(NEED(BOUNDED, "it is the floor of low_dissipation, which is off or has no Riemann scheme")), .comparison = true),
    CHOICE(P, dissipation_order, "first|third", "first", "of the jump that this share acts on: first: that between bounded states, which keeps particles in order best; third: between states of third order: gentle waves lose less, water at rest in 3D stirs a third more",
           USED(NEED(FLOORED, "nothing is left at least: see sph.dissipation and low_dissipation")), .comparison = true),
    PARAM(P, damper, "-", "0.2", 0.0, 1.0, "acoustic damper: p - damper rho c0 R div u in the pair pressure",
          USED(NEED(RIEMANN, "schemes delta and standard have no pair pressure that it could damp")), .comparison = true),
    PARAM(P, alpha, "-", "-1.0", -1.0, 1.0, "artificial viscosity of schemes delta and standard; -1: 0.01, in a viscous fluid 0",
          USED(NEED(ARTIFICIAL, "the Riemann schemes have no artificial viscosity: see sph.dissipation")), .comparison = true),
    PARAM(P, delta, "-", "0.05", 0.0, 0.2, "diffusion of density of scheme delta: delta c0 R",
          USED(NEED(DIFFUSIVE, "only scheme delta diffuses density")), .comparison = true),
    PARAM(P, background, "-", "false", 0, 1, "background pressure that lifts the least pressure to 0; not with a free surface",
          USED(NEED(NO_SURFACE, "the pressure of a free surface is 0")), .comparison = true),
    CHOICE(P, integrator, "rk4|j3|auto", "auto", "scheme in time: classical Runge-Kutta; three stages for the spectrum of the pair interaction, order 2; auto: j3", .comparison = true),
    PARAM(P, cfl, "-", "0.0", 0.0, 2.0, "dt over R/(c + |u - u0|); 0: j3 0.5, in 3D 0.45; rk4 0.375"),
    PARAM(P, cfl_viscous, "-", "0.0", 0.0, 2.0, "dt over R^2/nu; 0: 0.09 (morris), 0.035 (monaghan), with no-slip walls 0.05 to 0.012; j3 of the Riemann schemes 1.18 times that",
          USED(NEED(VISCOUS, "fluid.nu is 0: nothing viscous limits dt")), .comparison = true),
    PARAM(P, box, "m", "((0, 0, 0), (0, 0, 0))", -1e6, 1e6, "region of the particles inside the domain; all 0: the domain"),
    PARAM(P, free, "m", "((0, 0, 0), (0, 0, 0))", -1e6, 1e6, "instead of box: its free zone, without transition and buffer"),
    PARAM(P, box_velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "velocity of the box: it moves through the fluid, particles are created ahead of it and removed behind it"),
    PARAM(P, box_follows, "-", "", 0, 0, "name of a body with which the box moves, along the axes whose both sides are open; \"breaker\": it moves with the crest in it, above initial.level"),
    CHOICE(P, outer, "none|exact|partner|sides", "none", "the flow around the box; none with a box: partner when coupled, else exact; sides: as inlets and outlets in walls have it",
          USED(NEED(OUTER, "no side of the particles' region is open, or inlets and boxes say what is outside; sides needs an inlet or an outlet among the walls"))),
    CHOICE(P, births, "faces|vertices", "faces", "where particles enter at open sides: at the faces of a lattice, half a spacing inside; for comparison at their vertices, on the side (Kassiotis)",
          USED(NEED(ZONES, "no side of the particles' region is open")), .comparison = true),
    PARAM(P, density_limit, "-", "0.0", 0.0, 10.0, "|rho/rho0 - 1| that ends the run; 0: 0.1, compression at rest and twice the largest Mach number so far, at most 0.5", .comparison = true),
    CHOICE(P, walls, "nfm|ghosts|fixed|auto", "auto", "normal flux (any polyline or mesh; scheme standard in viscous channels alone), mirrored ghosts (plane sides), for comparison fixed ghosts (Marrone; any polyline, 2D); auto: nfm, but ghosts where schemes delta and standard have no polyline or mesh",
          USED(NEED(WALLS, "the particles have no wall and no body"))),
    CHOICE(P, wall_integrals, "closed|clipped|centroids|numerical", "closed", "integrals over walls: in closed form; for comparison by squares that are clipped (3D), by a point a triangle or 15 points along R of a line, and so the Shepard factor, too (numerical, 2D)",
          USED(NEED(FLUXES, "the particles have no normal flux walls (sph.walls)")), .comparison = true),
    CHOICE(P, surface, "no|yes|auto", "auto", "free surface; auto: when the fluid does not fill the domain"),
    PARAM(P, packing, "-", "-1", -1, 100000, "steps of rearrangement at the start; -1: 200 with polylines or bodies, with meshes up to 40 as long as they help, 40 with noise, else none",
          USED(NEED(PACKED, "without walls, bodies and noise the lattice is uniform already")), .comparison = true),
    PARAM(P, noise, "-", "-1.0", -1.0, 0.5, "random displacement of the first lattice, in dx; -1: 0.3 where vortices fill a periodic domain, for a lattice that they shear breaks up in rows, else 0", .comparison = true),
    PARAM(P, extrema, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "known least u on the vertical, largest and least v on the horizontal centre line: for error.extrema; 2D",
          USED(NEED(PLANE, "centre lines are read in two dimensions only")), .numbers = 3, .comparison = true),
};
/* clang-format on */

const struct param_group sph_groups[SPH_GROUPS] = {{.name = "sph",
                                                    .help = "smoothed particle hydrodynamics",
                                                    .rows = rows,
                                                    .nrows = sizeof rows / sizeof rows[0],
                                                    .target = &given,
                                                    .present = &present},
                                                   {.name = "apr",
                                                    .help = "adaptive particle refinement",
                                                    .rows = apr_rows,
                                                    .nrows = APR_ROWS,
                                                    .target = &apr_given}};

static bool is_given(double box[2][3])
{
    for (int a = 0; a < 3; a++)
        if (box[0][a] != 0.0 || box[1][a] != 0.0)
            return true;
    return false;
}

static bool has_box(void) { return is_given(given.box) || is_given(given.free); }

/* The outer box along an axis: as given, around the free zone with whole particles, or the domain.
 * A free zone that reaches a side of the domain ends there. */
static void find_box(const struct run *r, struct sph_params *used, int a)
{
    const struct scene_domain *d = &r->scene.domain;
    const bool around = is_given(given.free);
    const double lo = around ? given.free[0][a] : given.box[0][a];
    const double hi = around ? given.free[1][a] : given.box[1][a];
    double from = lo, to = hi;
    if (around)
        zones_around(r, used, a, given.free, &from, &to);
    bool plain = !has_box() || a >= d->dim;
    if (!plain && d->periodic[a] && hi - lo < d->max[a] - d->min[a] - 1e-6 * given.dx) {
        used->box[0][a] = from; /* it may go on beyond the periodic side */
        used->box[1][a] = to;
        return;
    }
    used->box[0][a] = plain || lo <= d->min[a] ? d->min[a] : from;
    used->box[1][a] = plain || hi >= d->max[a] ? d->max[a] : to;
}

/* Sound of a motion runs to and fro between the sides of the domain, which a box does not have. */
static struct scene_speed speed_of(const struct run *r)
{
    const struct body_pace pace = bodies_pace(&r->scene, r->motions, given.dx);
    struct scene_speed v = scene_speed_of(&r->scene, pace.speed, given.dx);
    v.pushed = pace.pressure;
    v.rate = pace.rate;
    v.across = has_box() ? 0.0 : v.across;
    return v;
}

/* Ten times the largest speed to expect, so that the density varies by about a percent [2.33-2.35];
 * by no more where the fluid is at rest, creeps or is accelerated, p/(rho c0^2) <= 0.01. And three
 * times what makes the fluid ring at the rate of a motion: the added mass of a disc that swings in
 * a full box is right within 1 % then, 7 % too large with two thirds of that speed, and with a
 * third -63 %, and late. */
static double default_c0(const struct scene_speed *v)
{
    const double pressure = fmax(v->pushed, fmax(v->pressure, v->viscous));
    return fmax(10.0 * fmax(v->speed, sqrt(pressure)), 6.0 * v->across * v->rate);
}

/* Lines of points, in 2D; in 3D they are refused. */
static bool has_points(const struct scene *c)
{
    bool any = false;
    for (int k = 0; k < c->nbodies; k++)
        any = any || c->bodies[k].points.n > 0;
    for (int k = 0; k < c->nwalls; k++)
        any = any || c->walls[k].points.n > 0;
    return any;
}

/* A fluid whose weight walls carry: what keeps it at rest is the balance of p and g at each
 * particle, whose errors stir it unless pairs dissipate (2e-3 c0 -> 4e-4 c0 in cases/star). Weight
 * along a periodic axis drives a flow instead. */
static bool hangs(const struct scene *c, const struct sph_params *prm)
{
    bool weight = false;
    for (int a = 0; a < c->domain.dim; a++)
        weight = weight || (c->fluid.gravity[a] != 0.0 && !c->domain.periodic[a]);
    return weight && sph_params_walls(c, prm) && !scene_has_openings(c) && !has_box();
}

/* On what particles meet. */
static bool has_no_slip(const struct scene *c, const struct sph_params *prm)
{
    return scene_has_no_slip(c) && sph_params_walls(c, prm);
}

static bool is_coupled(const struct run *r) { return r->scene.has_sph && r->scene.has_fv; }

/* The first wall that has it; -1: none. */
static int bed_with_friction(const struct run *r)
{
    for (int k = 0; k < r->scene.nwalls; k++)
        if (r->scene.walls[k].friction > 0.0)
            return k;
    return -1;
}

/* No-slip walls that meet: both exert friction on a particle in the corner. */
static bool has_no_slip_corner(const struct scene *c, const struct sph_params *prm)
{
    bool any = false, axis[3] = {false, false, false};
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *w = c->walls + k;
        if (w->kind == WALL_NO_SLIP && w->side == SIDE_NONE)
            any = true;
        else if (w->kind == WALL_NO_SLIP &&
                 sph_params_reaches(&c->domain, prm, w->side - SIDE_X_MIN))
            axis[(w->side - SIDE_X_MIN) / 2] = true;
    }
    for (int k = 0; k < c->nbodies; k++)
        any = any || c->bodies[k].kind == WALL_NO_SLIP;
    return any || axis[0] + axis[1] + axis[2] > 1;
}

static bool has_nfm(const struct scene *c, const struct sph_params *prm)
{
    return prm->walls == WALLS_NFM && sph_params_walls(c, prm);
}

/* Length of the stable part of the negative axis, over that of RK4. */
static double viscous_axis(const struct sph_params *prm)
{
    const struct rk_stages *rk4 = stages_of(INTEGRATOR_RK4, prm->scheme);
    return stages_of(prm->integrator, prm->scheme)->real_axis / rk4->real_axis;
}

/* See sph_params_cfl_bound. */
static double default_cfl(const struct sph_params *prm, int dim)
{
    const double free = prm->integrator == INTEGRATOR_RK4 ? 0.375 : dim == 2 ? 0.5 : 0.45;
    return sph_params_damped_share(prm) * free;
}

/* Whether the Riemann schemes correct Morris's term by gradients, see scheme_rates.c. */
static bool sharpens_friction(const struct scene *c, const struct sph_params *prm)
{
    return sph_params_is_riemann(prm->scheme) && prm->surface != SURFACE_YES &&
           !sph_params_walls(c, prm);
}

/* nu/R^2: the largest rate at which normal flux walls slow down a particle. */
static double friction_of_walls(const struct scene *c, const struct sph_params *prm)
{
    const bool corner = has_no_slip_corner(c, prm);
    return c->domain.dim == 2 ? 40.0 * (corner ? 3 : 1) : 79.0 * (corner ? 2 : 1);
}

/* Delta and standard have the whole wave to walls, and a shorter axis: beside no-slip normal flux
 * walls waves and friction share it. Poiseuille flow runs with dt nu/R^2 = 0.028 and c dt/R = 0.28,
 * not with 0.032 and 0.32; with 0.02 and 0.45, not with 0.023 and 0.5. */
static double central_share(const struct sph_params *prm)
{
    return sph_params_is_riemann(prm->scheme) ? 1.0 : 0.55;
}

/* Bounds of plane waves on a lattice, with margin; of Monaghan's term beside normal flux walls,
 * where water that runs up a corner crowds: measured. With normal flux the first row has friction
 * at its wall with 40 nu/R^2 beside what the lattice has (nu/R^2 times 2.75 over its bound, on the
 * negative axis of RK4, which ends at 2.785; other schemes in time in proportion), in a corner
 * three times that: 0.055 and 0.028 hold, with noise. Edges and corners in 3D were not measured
 * anew. */
static double default_cfl_viscous(const struct scene *c, const struct sph_params *prm)
{
    const bool monaghan = prm->viscosity != VISCOSITY_MORRIS;
    const double lattice = monaghan ? 0.035 : sharpens_friction(c, prm) ? 0.068 : 0.09;
    const double axis = viscous_axis(prm);
    if (!has_no_slip(c, prm))
        return axis * (monaghan && has_nfm(c, prm) ? 0.026 : lattice);
    if (prm->walls == WALLS_NFM)
        return axis * central_share(prm) * 2.75 / (friction_of_walls(c, prm) + 2.75 / lattice);
    return axis * fmin(lattice, 0.05);
}

/* Vortices alone, from a given instant on: a lattice breaks up within a tenth of a turn, in rows
 * along the axes of strain, and what that does to velocities stays (Re 1000, L/dx = 64: 0.93
 * instead of 0.42 %; with 0.02 dx instead of 0.3 0.48 %). Walls want rows along them. */
static bool shears_lattice(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    const int f = c->initial.field;
    bool periodic = true;
    for (int a = 0; a < c->domain.dim; a++)
        periodic = periodic && c->domain.periodic[a];
    return periodic && !sph_params_walls(c, prm) && prm->surface == SURFACE_NO &&
           (prm->transport == TRANSPORT_TVS || prm->transport == TRANSPORT_TVO) &&
           (f == FIELD_TAYLOR_GREEN || f == FIELD_TWO_MODES || f == FIELD_BELTRAMI);
}

static struct sph_params used; /* given, with all that follows from it and from the scene */
static bool resolved;

/* Whether upright sides of the box in which the surface goes on in fv are crossed by waves: those
 * of the case or, in 2D, any. Water comes and goes there where volumes cannot follow kernel sums:
 * without mass flux particles crowd or come loose, and the pressure at the floor was 4 % low after
 * eight periods of waves (0.05 % with), 3 % after six swings of a tank (0.4 %), and a solitary wave
 * 0.061 instead of 0.007 H behind. In 3D a cube in still water has 5 % too much lift with it (0.9
 * without), and a box below the surface has no level to lose. Where levels of refinement meet mass
 * flux stirs the water more and more (warn_of_levels), so not with them. */
static bool is_in_waves(const struct run *r, const struct sph_params *prm)
{
    const struct scene *c = &r->scene;
    if (!is_coupled(r) || !r->crossed || apr_params_of(r))
        return false;
    const int up = scene_still_axis(c);
    const double top = c->fluid.gravity[up] < 0.0 ? prm->box[1][up] - c->domain.min[up]
                                                  : c->domain.max[up] - prm->box[0][up];
    return c->has_waves || (c->domain.dim == 2 && top > crossing_depth(c, up));
}

/* Reads the motion files of bodies, so it is done once. */
static void resolve(const struct run *r)
{
    used = given;
    for (int a = 0; a < 3; a++)
        find_box(r, &used, a);
    used.speed = speed_of(r);
    const double c0 = default_c0(&used.speed);
    if (used.c0 <= 0.0)
        used.c0 = c0;
    used.expected = 0.1 * (c0 > 0.0 ? c0 : used.c0);
    if (used.surface == SURFACE_AUTO)
        used.surface = scene_has_surface(&r->scene) ? SURFACE_YES : SURFACE_NO;
    if (used.viscosity == VISCOSITY_AUTO)
        used.viscosity = used.surface ? VISCOSITY_MONAGHAN : VISCOSITY_MORRIS;
    if (used.scheme == SCHEME_AUTO)
        used.scheme =
            used.surface == SURFACE_YES && !scene_has_openings(&r->scene) && !is_in_waves(r, &used)
                ? SCHEME_RIEMANN
                : SCHEME_RIEMANN_ALE;
    const struct apr_params *apr = apr_params_of(r);
    if (used.walls == WALLS_AUTO && apr && apr->method != APR_GUARDS)
        used.walls = WALLS_GHOSTS;
    if (used.walls == WALLS_AUTO) /* delta without polylines: as it is known */
        used.walls = sph_params_is_riemann(used.scheme) || scene_has_lines(&r->scene) ||
                             bed_with_friction(r) >= 0
                         ? WALLS_NFM
                         : WALLS_GHOSTS;
    if (used.integrator == INTEGRATOR_AUTO)
        used.integrator = INTEGRATOR_J3;
    if (used.cfl <= 0.0)
        used.cfl = default_cfl(&used, r->scene.domain.dim);
    if (used.cfl_viscous <= 0.0)
        used.cfl_viscous = default_cfl_viscous(&r->scene, &used);
    if (used.dissipation < 0.0)
        used.dissipation = used.surface == SURFACE_YES || hangs(&r->scene, &used) ? 0.1 : 0.0;
    if (used.alpha < 0.0)
        used.alpha = r->scene.fluid.nu > 0.0 ? 0.0 : 0.01;
    if (has_box() && used.outer == OUTER_NONE)
        used.outer = is_coupled(r) ? OUTER_PARTNER : OUTER_EXACT;
    if (!has_box() && used.outer == OUTER_NONE && scene_has_openings(&r->scene))
        used.outer = OUTER_SIDES;
    if (used.noise < 0.0 && apr && apr->method == APR_GRADED)
        used.noise = 0.0;
    if (used.noise < 0.0)
        used.noise = shears_lattice(r, &used) ? 0.3 : 0.0;
    if (used.packing < 0)
        used.packing = scene_has_lines(&r->scene) && used.walls != WALLS_GHOSTS
                           ? (r->scene.domain.dim == 3 ? 40 : 200)
                       : used.noise > 0.0 ? 40
                                          : 0;
    resolved = true;
}

const struct sph_params *sph_params_of(const struct run *r)
{
    if (!resolved)
        resolve(r);
    return &used;
}

/* Whether length is a whole number of dx, but for the last digits of a typed decimal. */
static bool whole(double length, double dx)
{
    const double n = length / dx;
    return fabs(n - round(n)) < 1e-6;
}

/* Whether the rows of particles must end on both sides of the region: where it repeats itself,
 * opens or has a wall on both. Else the lattice ends where the fluid does. */
static bool wants_rows(const struct run *r, int a)
{
    const struct scene *c = &r->scene;
    return c->domain.periodic[a] || sph_params_zones(r, sph_params_of(r)) ||
           (scene_wall_of(c, SIDE_X_MIN + 2 * a) && scene_wall_of(c, SIDE_X_MIN + 2 * a + 1));
}

/* Of one axis in the order of what a user can mend: the period, the corners, the domain, the walls,
 * the rows of a box. */
static void check_axis(const struct run *r, int a, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const double near = 1e-6 * given.dx, R = given.R_dx * given.dx;
    static const char axes[] = "xyz";
    double lo[3], hi[3];
    bool periodic[3];
    sph_params_region(d, sph_params_of(r), lo, hi, periodic);
    const double length = hi[a] - lo[a];
    const double L = d->max[a] - d->min[a], beyond = d->periodic[a] ? L : near;
    const char *key = params_given(r->params, "sph.free") ? "sph.free" : "sph.box";
    if (d->periodic[a] && length > L + near) {
        params_fault(r->params, f, key,
                     "%c from %g to %g m with transition and buffer is longer than the period, %g "
                     "m: make it smaller, or let it span the period",
                     axes[a], lo[a], hi[a], L);
        return;
    }
    if (length <= 0.0 && has_box()) {
        params_fault(r->params, f, key,
                     "along %c its first corner, at %g m, is not below its second, at %g m, or it "
                     "lies beyond the domain, %g to %g m",
                     axes[a], lo[a], hi[a], d->min[a], d->max[a]);
        return;
    }
    if (length <= 0.0 || lo[a] < d->min[a] - beyond || hi[a] > d->max[a] + beyond) {
        params_fault(r->params, f, key,
                     "%c from %g to %g m, with transition and buffer, is not inside the domain, %g "
                     "to %g m: let it end on the domain's sides, make it smaller or sph.dx finer",
                     axes[a], lo[a], hi[a], d->min[a], d->max[a]);
        return;
    }
    const struct scene_wall *w[2] = {scene_wall_of(&r->scene, SIDE_X_MIN + 2 * a),
                                     scene_wall_of(&r->scene, SIDE_X_MIN + 2 * a + 1)};
    if (w[0] && w[1] && sph_params_is_wall(w[0]) && sph_params_is_wall(w[1]) &&
        length < 1.5 * given.dx)
        params_fault(r->params, f, "sph.dx",
                     "%g m: one particle has no room between the walls along %c, %g m apart; take "
                     "%.3g m or less",
                     given.dx, axes[a], length, 0.25 * length);
    if (has_box() && (!whole(lo[a] - d->min[a], given.dx) ||
                      (hi[a] < d->max[a] - near && !whole(hi[a] - d->min[a], given.dx))))
        params_fault(
            r->params, f, "sph.box",
            "%c from %g to %g m: both must lie a whole number of dx = %g m from domain.min, as %g "
            "and %g m do",
            axes[a], lo[a], hi[a], given.dx,
            d->min[a] + given.dx * round((lo[a] - d->min[a]) / given.dx),
            d->min[a] + given.dx * floor((hi[a] - d->min[a]) / given.dx + 1e-6));
    if (periodic[a] && length <= 2.0 * 1.15 * R)
        params_fault(
            r->params, f, "sph.dx",
            "the periodic length %g m along %c must exceed twice the reach of a particle, %g m",
            length, axes[a], 2.0 * 1.15 * R);
}

/* The number n of dx = length/n along the first of the lengths nearest to what is given, and not
 * finer (step -1) or not coarser (1), of which all lengths are whole numbers; 0 if none within a
 * factor of two. */
static int fitting(int nlengths, const double *lengths, int step)
{
    const double given_n = lengths[0] / given.dx;
    for (int n = (int)(step > 0 ? ceil(given_n) : floor(given_n));
         n > 0 && n <= 2.0 * given_n && n >= 0.5 * given_n; n += step) {
        bool all = true;
        for (int k = 1; k < nlengths; k++)
            all = all && whole(lengths[k], lengths[0] / n);
        if (all)
            return n;
    }
    return 0;
}

/* One spacing must fit along all axes: a remedy for one alone would be refused for the next. A box
 * that ends on the domain's upper side cannot end elsewhere: the domain is what must fit. */
static void check_rows(const struct run *r, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    double lo[3], hi[3], lengths[3];
    bool periodic[3];
    char remedy[200] = "";
    int n = 0, bad = -1;
    sph_params_region(d, sph_params_of(r), lo, hi, periodic);
    for (int a = 0; a < d->dim; a++) {
        if (has_box() && hi[a] < d->max[a] - 1e-6 * given.dx)
            continue;
        lo[a] = has_box() ? d->min[a] : lo[a];
        if (wants_rows(r, a) && hi[a] > lo[a]) {
            lengths[n++] = hi[a] - lo[a];
            if (bad < 0 && !whole(hi[a] - lo[a], given.dx))
                bad = a;
        }
    }
    if (bad < 0)
        return;
    for (int step = 1; step >= -1; step -= 2) {
        const int cells = fitting(n, lengths, step);
        if (cells) /* as an expression: it is exact */
            text_add(remedy, sizeof remedy, "%s dx = \"%.10g/%d\" (%.4g m)",
                     *remedy ? " or" : "take", lengths[0], cells, lengths[0] / cells);
    }
    params_fault(r->params, f, "sph.dx",
                 "%g m: %c from %g to %g m is no whole number of dx, which a period, two walls or "
                 "open sides need: %s",
                 given.dx, "xyz"[bad], lo[bad], hi[bad],
                 *remedy ? remedy : "none near it fits all axes: round the corners of the domain");
}

/* What check_axis says of a spacing in other units would be a fault an axis or two. */
static void check_spacing(const struct run *r, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    for (int a = 0; a < d->dim; a++)
        if (given.dx > d->max[a] - d->min[a] && d->max[a] > d->min[a]) {
            params_fault(r->params, f, "sph.dx", "%g m: the domain is %g m along %c: all is in m",
                         given.dx, d->max[a] - d->min[a], "xyz"[a]);
            return;
        }
    for (int a = 0; a < d->dim; a++)
        check_axis(r, a, f);
    check_rows(r, f);
}

/* Where the zones of two open sides meet, each sets what the other reads: a channel of 16 dx
 * between two outlets had 1.6 times its discharge, one of 10 dx diverges. */
static void check_zones(const struct run *r, struct faults *f)
{
    const struct sph_params *prm = sph_params_of(r);
    double lo[3], hi[3];
    zones_free_box(r, prm, lo, hi);
    for (int a = 0; a < r->scene.domain.dim; a++) {
        const double length = prm->box[1][a] - prm->box[0][a], free = hi[a] - lo[a];
        if (free > (has_box() ? 0.0 : -1e-6 * given.dx))
            continue;
        params_fault(r->params, f, has_box() ? "sph.box" : "sph.dx",
                     "coupling.transition + coupling.buffer on open sides, %g m, leave nothing of "
                     "%g m along %c; make the %s larger, or sph.dx finer than %.3g m",
                     length - free, length, "xyz"[a], has_box() ? "box" : "domain",
                     given.dx * length / (length - free));
        return;
    }
}

/* At the end of a side a vertex collects the flow of a whole face instead of half [6.11]: five feed
 * as five faces where there are four. */
static void check_vertices(const struct run *r, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const struct sph_params *prm = sph_params_of(r);
    int ends = 0;
    for (int a = 0; a < d->dim; a++)
        ends += !d->periodic[a] || prm->box[0][a] > d->min[a] || prm->box[1][a] < d->max[a];
    if (given.births == BIRTHS_VERTICES && sph_params_zones(r, prm) &&
        (ends > 1 || prm->surface == SURFACE_YES))
        params_fault(r->params, f, "sph.births",
                     "vertices need open sides without ends (all other axes periodic) and no free "
                     "surface: take faces");
}

/* Whether a box that moves has a way that is foretold, and room for it. */
static void check_way(const struct run *r, const struct sph_params *prm, struct faults *f)
{
    enum { TIMES = 200 };
    const struct scene_domain *d = &r->scene.domain;
    const char *key = box_motion_key(prm);
    const double R = prm->R_dx * prm->dx;
    double way[3];
    for (int k = 0; k <= TIMES; k++) {
        const double t = body_drive_instant(k, TIMES, r->scene.time.end);
        if (!box_motion_foretold(r, prm, t, way))
            return; /* the run watches it */
        for (int a = 0; a < d->dim; a++) {
            const double lo = prm->box[0][a] + way[a], hi = prm->box[1][a] + way[a];
            if (d->periodic[a] || way[a] == 0.0 || (lo > d->min[a] + R && hi < d->max[a] - R))
                continue;
            params_fault(r->params, f, key,
                         "the box comes to a side of the domain across %c at t = %.4g s, %g to %g "
                         "m: shorten time.end, or enlarge the domain",
                         "xyz"[a], t, lo, hi);
            return;
        }
    }
}

/* Of a box that moves: through what is the partner's on both sides. */
static void check_motion(const struct run *r, struct faults *f)
{
    const struct sph_params *prm = sph_params_of(r);
    const char *key = box_motion_key(prm);
    bool named = !prm->box_follows[0], any = false;
    if (!box_motion_wanted(prm))
        return;
    for (int k = 0; k < r->scene.nbodies; k++)
        named = named || strcmp(r->scene.bodies[k].name, prm->box_follows) == 0;
    for (int a = 0; a < 3; a++)
        any = any || (a < r->scene.domain.dim && box_motion_along(r, prm, a));
    if (!has_box() || (!any && prm->box_follows[0])) {
        params_fault(
            r->params, f, key,
            "no box has both sides open along an axis on which it would move: give sph.box "
            "(or sph.free) inside the domain");
        return;
    }
    const bool crest = strcmp(prm->box_follows, BOX_TRACKING) == 0;
    if (!named && !crest)
        params_fault(r->params, f, key,
                     "no body is named `%s'; \"breaker\" is the crest of the water",
                     prm->box_follows);
    if (crest &&
        (box_tracking_speed(r) == 0.0 || !r->crossed || !(r->scene.initial.level < LEVEL_TOP)))
        params_fault(r->params, f, key,
                     "a crest is followed where the surface crosses the sides of the box: give "
                     "gravity, a free surface in both programs, and initial.level, above which "
                     "crests stand");
    for (int a = 0; a < 3; a++) {
        if (prm->box_velocity[a] != 0.0 && prm->box_follows[0])
            params_fault(r->params, f, key, "give either box_velocity or box_follows, not both");
        else if (prm->box_velocity[a] != 0.0 && !box_motion_along(r, prm, a))
            params_fault(r->params, f, key,
                         "the box cannot move along %c: there it ends on the domain's own sides",
                         "xyz"[a]);
    }
    if (f->n == 0)
        check_way(r, prm, f);
}

/* Largest stable dt nu/R^2 of the scheme. */
static double viscous_bound(const struct run *r, const struct sph_params *prm)
{
    const bool nfm = has_nfm(&r->scene, prm);
    const double axis = viscous_axis(prm);
    if (prm->viscosity != VISCOSITY_MORRIS)
        return axis * (nfm ? 0.03 : 0.04);
    return axis * (nfm && has_no_slip(&r->scene, prm)  ? 0.048 * central_share(prm)
                   : sharpens_friction(&r->scene, prm) ? 0.075
                                                       : 0.1);
}

/* A step beyond the bounds of the scheme ends in noise or in nothing. */
static void check_steps(const struct run *r, struct faults *f)
{
    const struct sph_params *prm = sph_params_of(r);
    const double R = prm->R_dx * prm->dx, nu = r->scene.fluid.nu;
    const double bound = sph_params_cfl_bound(prm, r->scene.domain.dim);
    const double viscous = viscous_bound(r, prm);
    if (prm->cfl > bound)
        params_fault(r->params, f, "sph.cfl", "%g is unstable with this scheme: at most %g",
                     prm->cfl, bound);
    if (sph_params_dt(prm, nu, prm->c0, NULL) * nu > 1.001 * viscous * R * R)
        params_fault(r->params, f, "sph.cfl_viscous",
                     "%g is unstable with this viscous term and these walls: at most %g",
                     prm->cfl_viscous, viscous);
}

/* Beyond 0.7 R the kernel is as good as nothing: a wall of 3 dx (R = 4 dx) between two levels is
 * tight, one of 2 dx lets particles through. */
static void check_thin(const struct run *r, struct faults *f)
{
    const double dx = given.dx, needed = 0.7 * given.R_dx * dx;
    struct wall_thin t;
    if (wall_thin_solid(&r->scene, needed, &t))
        params_fault(r->params, f, "sph.dx",
                     "%s are %.3g m apart at (%g, %g) with fluid on either side: particles "
                     "see each other through less than 0.7 sph.R_dx sph.dx = %.3g m and leak. Take "
                     "sph.dx = %.2g or less, or make it thicker",
                     t.what, t.width, t.at[0], t.at[1], needed,
                     digits_below(dx * t.width / needed, 2));
    if (wall_thin_gap(&r->scene, dx, &t))
        params_fault(r->params, f, "sph.dx",
                     "%s are %.3g m apart at (%g, %g): a gap narrower than sph.dx holds "
                     "no particle, and nothing presses there. Close it, or take sph.dx = %.2g or "
                     "less",
                     t.what, t.width, t.at[0], t.at[1], 0.5 * t.width);
}

/* A line has fluid on one side alone. */
static void check_ends(const struct run *r, struct faults *f)
{
    struct wall_end e;
    if (!wall_ends_open(&r->scene, given.dx, &e))
        return;
    params_fault(r->params, f, key_text("walls.[%d].points", e.wall),
                 "the line %s ends inside the domain at (%g, %g), so that fluid comes to its back, "
                 "where a line is no wall: extend it to a wall or to a side of the domain, or "
                 "draw both of its faces, %.3g m (0.7 sph.R_dx sph.dx) apart or more",
                 e.stands ? "stands on another wall and" : "has water at its end: it", e.at[0],
                 e.at[1], 0.7 * given.R_dx * given.dx);
}

/* A body moved by the fluid, a paddle that absorbs and a partner of a coupled job take one step
 * with all levels. */
static void check_local_steps(const struct run *r, struct faults *f)
{
    bool any_free = false, any_absorbs = false;
    for (int k = 0; k < r->scene.nbodies; k++) {
        const struct scene_motions *m = &r->scene.bodies[k].motion;
        any_free = any_free || r->scene.bodies[k].free;
        for (int i = 0; i < m->n; i++)
            any_absorbs = any_absorbs || m->of[i].absorb;
    }
    if (is_coupled(r) || any_free || any_absorbs)
        params_fault(r->params, f, "apr.local_steps", "%s: leave it out",
                     any_free      ? "bodies that the fluid moves need one step for all levels"
                     : any_absorbs ? "a paddle that absorbs needs one step for all levels"
                                   : "levels of a coupled job step together");
}

/* What levels of refinement do not go together with. Sets of several sizes (apr.method) have rules
 * of their own, in mixed_check. */
static void check_levels(const struct run *r, struct faults *f)
{
    const struct sph_params *prm = sph_params_of(r);
    const struct apr_params *apr = apr_params_of(r);
    if (apr->method != APR_GUARDS) {
        mixed_check(r, prm, apr, f);
        return;
    }
    if (apr->local_steps)
        check_local_steps(r, f);
    if (prm->background)
        params_fault(r->params, f, "sph.background",
                     "levels of refinement would each lift their own least pressure: leave it out");
}

/* Fixed ghosts are there for comparison, and simple. */
static void check_fixed_ghosts(const struct run *r, struct faults *f)
{
    const bool crossed = has_box() || scene_has_openings(&r->scene) || is_coupled(r);
    const char *why = r->scene.domain.dim != 2    ? "are for 2D"
                      : r->size > 1               ? "run on one rank"
                      : crossed                   ? "have no open sides"
                      : apr_params_of(r)          ? "have no levels of refinement"
                      : bed_with_friction(r) >= 0 ? "have no bed friction"
                                                  : NULL;
    if (given.walls == WALLS_FIXED && why)
        params_fault(r->params, f, "sph.walls", "fixed ghosts %s: take nfm", why);
}

/* Whether the walls' form and the model of walls fit. */
static void check_wall_model(const struct run *r, struct faults *f)
{
    const int bed = bed_with_friction(r);
    if (has_points(&r->scene) && r->scene.domain.dim == 3)
        params_fault(r->params, f, "walls",
                     "walls and bodies of points need 2 dimensions: in space give a mesh, of "
                     "bodies also a box, a radius or, with the points of a section, a length");
    else if (scene_has_lines(&r->scene) && given.walls == WALLS_GHOSTS)
        params_fault(r->params, f, "sph.walls",
                     "mirrored ghosts need plane sides: take nfm for polylines, bodies and meshes");
    if (r->scene.domain.dim == 2 && given.wall_integrals == INTEGRALS_CLIPPED)
        params_fault(
            r->params, f, "sph.wall_integrals",
            "clipped squares are of triangles, in 3D: take closed, centroids or numerical");
    if (r->scene.domain.dim == 3 && given.wall_integrals == INTEGRALS_NUMERICAL)
        params_fault(r->params, f, "sph.wall_integrals",
                     "the Shepard factor of triangles is closed: take centroids, or clipped");
    if (bed >= 0 && sph_params_of(r)->walls == WALLS_GHOSTS)
        params_fault(r->params, f, key_text("walls.[%d].friction", bed),
                     "mirrored ghosts have no bed friction: take sph.walls = \"nfm\"");
}

/* Each group of rules needs what those before have accepted: values, spacing, boxes, then the
 * scene's solids by it. */
void sph_params_check(const struct run *r, struct faults *f)
{
    resolved = false;
    if (f->n > 0) /* values that were refused are not there to be compared */
        return;
    const bool in_3d = r->scene.domain.dim == 3;
    if (given.gamma != 7.0 && given.gamma != 1.0)
        params_fault(r->params, f, "sph.gamma", "%g, must be 7 or 1", given.gamma);
    if (sph_params_of(r)->scheme != SCHEME_RIEMANN_ALE && given.transport == TRANSPORT_EULERIAN)
        params_fault(
            r->params, f, "sph.transport",
            "eulerian needs scheme \"riemann_ale\": without mass flux there is no Eulerian form");
    if (sph_params_walls(&r->scene, sph_params_of(r)))
        standard_check(r, sph_params_of(r), f);
    for (int k = 0; k < r->scene.nwalls; k++)
        if (is_coupled(r) && !r->crossed && r->scene.walls[k].carried)
            params_fault(
                r->params, f, "walls",
                "wall %d: without a surface that crosses sph.box nothing but an outflow sets the "
                "pressure of a coupled job: give it one, leave out carried (convective outflow)",
                k + 1);
    if (sph_params_of(r)->c0 <= 0.0)
        params_fault(r->params, f, "sph.c0", "must be given: the scene has no scale of velocity");
    check_steps(r, f);
    check_wall_model(r, f);
    check_fixed_ghosts(r, f);
    check_vertices(r, f);
    if (given.outer == OUTER_PARTNER && !is_coupled(r))
        params_fault(r->params, f, "sph.outer", "partner, but the case has no group fv");
    if (is_coupled(r) && (given.outer == OUTER_EXACT || given.outer == OUTER_SIDES))
        params_fault(r->params, f, "sph.outer",
                     "%s, but around the particles of a coupled job is fv's flow: leave it out, or "
                     "the group fv",
                     given.outer == OUTER_EXACT ? "exact" : "sides");
    check_spacing(r, f);
    if (is_given(given.box) && is_given(given.free))
        params_fault(r->params, f, "sph.free", "give either sph.box or sph.free, not both");
    if (f->n == 0 && sph_params_zones(r, sph_params_of(r)))
        check_zones(r, f);
    if (f->n == 0)
        check_motion(r, f);
    sph_unused_check(r, sph_groups, &given, sph_params_of(r), f);
    if (f->n > 0)
        return;
    sph_sense_check(r, &given, sph_params_of(r), f);
    if (f->n == 0 || !in_3d)
        sph_bodies_check(r, sph_params_of(r), f);
    if (f->n == 0 && !in_3d)
        check_ends(r, f);
    if (f->n == 0 && !in_3d)
        check_thin(r, f);
    else if (f->n == 0)
        sph_meshes_check(r, sph_params_of(r), f);
    if (f->n == 0)
        regions_check(r, sph_params_of(r), f);
    if (f->n == 0 && apr_params_of(r))
        check_levels(r, f);
}

void sph_meshes_read(struct scene *s, const char *case_dir, const struct params *p, MPI_Comm comm,
                     struct faults *f)
{
    s->facet = given.dx;
    if (!s->has_fv && !params_has_group(p, "apr"))
        scene_forms_fit(s, 0.8 * given.dx);
    scene_meshes_read(s, case_dir, p, comm, f);
}

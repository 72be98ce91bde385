/* scene.c - the table of the groups that every program reads. SPDX-License-Identifier: BSD-3-Clause
 */
#include "scene_groups.h"

#include "exact.h"
#include "scene_check.h"
#include "scene_facts.h"
#include "scene_fluid.h"
#include "scene_mesh.h"
#include "scene_waves.h"

#define ROWS(r) (r), (int)(sizeof(r) / sizeof *(r))

/* --- when keys are used: tests of conditions, element being the group's struct --- */

/* Tests have one form, params_test: some do not look at the scene, some not at the element. */
static bool any_mesh(const void *scene, const void *element)
{
    return (void)element, scene_has_meshes(scene);
}

static bool any_maker(const void *scene, const void *element)
{
    return (void)element, scene_makes_waves(scene);
}

static bool makes_none(const void *scene, const void *element)
{
    return (void)scene, ((const struct scene_wall *)element)->zone != ZONE_WAVE;
}

static bool no_discharge(const void *scene, const void *element)
{
    return (void)scene, !((const struct scene_wall *)element)->has_discharge;
}

/* Of an opening whose velocity does not follow from a level or a discharge. */
static bool no_flow(const void *scene, const void *element)
{
    const struct scene_wall *w = element;
    return (void)scene, w->kind < WALL_INFLOW || !(w->has_level || w->has_discharge);
}

/* Fields of the start, and kinds of sides. */
#define ARE_WAVES                                                                                  \
    (ONE(FIELD_STANDING_WAVE) | ONE(FIELD_STOKES) | ONE(FIELD_REGULAR) | ONE(FIELD_SOLITARY))
#define TAKE_MEAN                                                                                  \
    (ONE(FIELD_UNIFORM) | ONE(FIELD_TAYLOR_GREEN) | ONE(FIELD_TWO_MODES) | ONE(FIELD_BELTRAMI))
#define HAVE_LENGTH (~(ONE(FIELD_REST) | ONE(FIELD_UNIFORM) | ONE(FIELD_SOLITARY)))
#define CLOSED (ONE(WALL_SLIP) | ONE(WALL_NO_SLIP))
#define NO_PARTNER "the case has one program, sph or fv: this is no coupled job"

/* clang-format off */
#define P struct scene_time
static const struct param time_rows[] = {
    PARAM(P, end, "s", NULL, 1e-12, 1e9, "time at which the run ends"),
};
#undef P
#define P struct scene_fluid
static const struct param fluid_rows[] = {
    PARAM(P, rho,     "kg/m^3", "1000.0",  1e-15, 1e15,  "density"),
    PARAM(P, nu,      "m^2/s",  "0.0",     0,    1e6,  "kinematic viscosity; 0: inviscid, nothing viscous is computed"),
    PARAM(P, gravity, "m/s^2",  "(0.0, 0.0, 0.0)", -1e6, 1e6, "acceleration of gravity",
          USED(NEED(WEIGHT, "no direction along it is periodic, and nothing shows the pressure: no wall, no probe, no snapshot of it"))),
    PARAM(P, central, "1/s",    "0.0",     0,    1e6,  "W of the acceleration -W^2 x towards the origin",
          USED(NEED(SPH_ALONE, "fv has no central force"))),
};
#undef P
#define P struct scene_domain
static const struct param domain_rows[] = {
    PARAM(P, dim,      "-", "2", 2, 3, "dimensions"),
    PARAM(P, min,      "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "lower corner"),
    PARAM(P, max,      "m", NULL, -1e9, 1e9, "upper corner"),
    PARAM(P, periodic, "-", "(false, false, false)", 0, 0, "directions in which the domain is periodic",
          USED(NEED(PERIODIC, "no side of the blocks is \"periodic\""))),
};
#undef P
#define P struct scene_initial
static const struct param initial_rows[] = {
    CHOICE(P, field, "rest|uniform|taylor_green|two_modes|poiseuille|couette|standing_wave|patch|drop|beltrami|stokes|regular|solitary", "rest", "field at the start, and the exact solution after it"),
    PARAM(P, U,        "m/s", "1.0", 0, 1e6, "scale of velocity: amplitude of the field, unit of errors"),
    PARAM(P, L,        "m",   "1.0", 1e-9, 1e9, "length of the field: of a wave, side of the patch, radius of the drop, height of a channel",
          USED(ONLY(field, HAVE_LENGTH,
                    "this initial.field has no length of its own"))),
    PARAM(P, velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "uniform velocity, or the mean velocity that is added to the field",
          USED(NEED_OR_ONLY(INFLOW, field, TAKE_MEAN,
                            "only the fields uniform, taylor_green, two_modes and beltrami take a mean velocity; a uniform stream is initial.field = \"uniform\""))),
    PARAM(P, amplitude, "m",  "0.0", -1e6, 1e6, "amplitude of a wave; regular: half its height from trough to crest; solitary: its height",
          USED(ONLY(field, ARE_WAVES, "only the fields standing_wave, stokes, regular and solitary have a wave"))),
    PARAM(P, L_z,      "m",   "0.0", 0, 1e6, "length of a standing wave along z; 0: the same for all z",
          USED(ONLY(field, ONE(FIELD_STANDING_WAVE), "only the field standing_wave has it"))),
    PARAM(P, crest,    "m",   "0.0", -1e9, 1e9, "x of the crest of a regular or solitary wave, which run to +x",
          USED(ONLY(field, ONE(FIELD_REGULAR) | ONE(FIELD_SOLITARY), "only the fields regular and solitary have it"))),
    PARAM(P, level,    "m",   "1e30", -1e9, 1e9, "height against gravity where p = 0; by default the top of each water",
          USED(NEED(LEVEL, "p = 0 on the free surface, wherever that is"),
               NEED(STILL, "nothing has a level: no weight across closed sides, a field with a pressure of its own, or nothing that shows the pressure"))),
    PARAM(P, seed,     "m",   "()", -1e9, 1e9, "points in the fluid, needed where meshes do not say which of the regions that they separate hold fluid; sph in 3D",
          USED(WHERE(any_mesh, "a mesh", "no mesh divides the domain: the shapes say where the fluid is"))),
};
#undef P
/* Of a beach; of a level and a discharge, each with its file. */
#define USED_BEACH \
    USED(ONLY(kind, CLOSED, "an opening lets waves out by itself"), \
         WHERE(makes_none, "not kind = wave", "its zone is waves.zone long, of their period"), \
         ONLY(side, ~ONE(SIDE_NONE), "a beach stands before a side of the domain"), \
         NEED(SURFACE, "there is no free surface, so no waves"))
#define USED_LEVEL \
    USED(ONLY(kind, ONE(WALL_INFLOW) | ONE(WALL_OUTFLOW), "it is for an inflow or an outflow"), \
         WITHOUT(carried, "a convective outflow (carried) keeps the level of the start"), \
         WHERE(no_discharge, "no discharge", "a discharge is given, the level follows"), \
         NEED(SURFACE, "no water has a free surface"), \
         NEED(PROJECTED, "newton has no openings of given level: give it as initial.level, which an outflow has, or rk3 or bdf2"))
#define USED_DISCHARGE \
    USED(ONLY(kind, ONE(WALL_INFLOW) | ONE(WALL_OUTFLOW), "it is for an inflow or an outflow"), \
         WITHOUT(carried, "of a convective outflow (carried) it is part of the solution"), \
         NEED(SURFACE, "without a free surface the area of an opening is known: give the velocity"))
#define P struct scene_wall
static const struct param wall_rows[] = {
    CHOICE(P, side, "none|x_min|x_max|y_min|y_max|z_min|z_max", "none", "side of the domain; none: points"),
    PARAM(P, points,   "m",   "()", -1e9, 1e9, "polyline with the fluid on its left (reversed, with a line in the log, where it clearly is on the other side)"),
    PARAM(P, closed,   "-",   "false", 0, 0, "join the last point with the first",
          USED(WITHOUT(mesh, "a mesh is closed or not"),
               ONLY(side, ONE(SIDE_NONE), "a side of the domain has no ends"))),
    SURFACE_ROWS(P, .uses = NULL, .uses = NULL, USED(ONLY(side, ONE(SIDE_NONE), "a side of the domain has its place"))),
    CHOICE(P, fluid_side, "auto|inside|outside|sheet", "auto", "of a mesh: where the fluid is; sheet: on the side that its normals point away from; auto: where the shapes have it",
          USED(WITH(mesh, "it is of a mesh"))),
    PARAM(P, flip,     "-",   "false", 0, 0, "reverse the normals of an open mesh, which must point out of the fluid",
          USED(WITH(mesh, "it turns the normals of a mesh: turn the points"))),
    PARAM(P, thin,     "-",   "false", 0, 0, "of a mesh: fluid on one side does not interact with that on the other; for walls thinner than the support",
          USED(WITH(mesh, "it is of a mesh"))),
    CHOICE(P, kind, "slip|no_slip|inflow|outflow|absorbing|wave|beach", "slip", "kind of boundary; wave: an upright slip wall with a zone before it that makes the waves of the group waves, and lets pass what comes back; beach: with one that absorbs them",
          USED(NEED_OR_ONLY(FRICTION, kind, ~ONE(WALL_NO_SLIP), "without viscosity (fluid.nu) a wall exerts no friction: give slip"),
               NEED_OR_ONLY(OPENINGS, kind, CLOSED | ONE(WALL_FALLS), "the flow around the particles (sph.outer) is known otherwise"))),
    PARAM(P, friction, "-",   "0.0", 0, 1, "of a slip wall: coefficient c_f of quadratic bed friction, whose shear stress is rho c_f |u| u of the velocity along the wall next to it",
          USED(NEED(PROJECTED, "newton has no bed friction: fv.integrator = \"rk3\" or \"bdf2\""),
               ONLY(kind, CLOSED, "an opening has none; a slip wall has"),
               ONLY(kind, ONE(WALL_SLIP), "no_slip is friction by viscosity: bed friction is a slip wall's"))),
    PARAM(P, beach,    "m",   "0.0", 0, 1e9, "of an upright side: water is brought to rest over this length before it, and waves that run there are absorbed; one wave length, 1.5 for a sea; 0 with kind = beach: waves.zone",
          USED_BEACH),
    PARAM(P, beach_period, "s", "0.0", 0, 1e9, "of a beach: period of these waves; its rate at the side is 4 pi over it; 0 with kind = beach: that of the group waves",
          USED_BEACH),
    PARAM(P, velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "of the wall along itself, of the inflow, or of the far field beyond an absorbing side",
          USED(ONLY(kind, ~ONE(WALL_OUTFLOW), "at an outflow the velocity is part of the solution"),
               ONLY(kind, ~ONE(WALL_SLIP), "a slip wall exerts no friction; no_slip does"),
               WHERE(no_flow, "no level and no discharge", "a level or a discharge is given, the velocity follows"))),
    CHOICE(P, profile, "uniform|parabolic", "uniform", "of an inflow; parabolic: over each opening (blocks that touch are one), velocity is the largest one",
          USED(ONLY(kind, ONE(WALL_INFLOW), "only an inflow has a profile"),
               WHERE(no_flow, "no level and no discharge", "a level or a discharge is given: uniform over the water"),
               NEED(FULL, "under a free surface an inflow is uniform over its water"))),
    PARAM(P, pressure, "Pa",  "0.0", -1e12, 1e12, "at an outflow; with weight at the height initial.level, by default the top of the domain (sph: between outflows at different heights at the middle of each)",
          USED(ONLY(kind, ~ONE(WALL_SLIP) & ~ONE(WALL_NO_SLIP), "a wall has none; outflow and absorbing have"),
               ONLY(kind, ONE(WALL_OUTFLOW) | ONE(WALL_ABSORBING), "the velocity is given here, the pressure follows: an opening of given pressure is an outflow"),
               WITHOUT(carried, "of a convective outflow (carried) it is part of the solution"),
               NEED(FULL, "under a free surface the level says it (walls.level)"))),
    PARAM(P, carried,  "-",   "false", 0, 1, "at an outflow (fv): convective outflow, dw/dt + U dw/dn = 0, the pressure is not given",
          USED(ONLY(kind, ONE(WALL_OUTFLOW), "only an outflow can be"),
               NEED(FV, "sph has no convective outflow"))),
    PARAM(P, level,    "m",   "1e30", -1e9, 1e9, "at an opening under a free surface: height of its water, against gravity; an inflow has it in the opening, an outflow far outside; by default of an outflow alone, as at the start",
          USED_LEVEL),
    PARAM(P, discharge, "m^3/s", "0.0", 0, 1e12, "of an opening under a free surface, whatever the level: in through an inflow, out through an outflow, uniform over its water; in 2D m^2/s",
          USED_DISCHARGE),
    PARAM(P, level_file, "-", "\"\"", 0, 0, "level over time (a tide): file beside the case, rows of t (s) and level (m), linear between them",
          USED_LEVEL),
    PARAM(P, discharge_file, "-", "\"\"", 0, 0, "discharge over time (a hydrograph): file beside the case, rows of t (s) and discharge, linear between them",
          USED_DISCHARGE),
};
#undef P
#define P struct scene_shape
static const struct param shape_rows[] = {
    CHOICE(P, form, "box|polygon|disc|below|mesh", "box", "kind of region; mesh: inside of a closed one, 3D"),
    PARAM(P, box,      "m",   "((0.0, 0.0), (0.0, 0.0))", -1e9, 1e9, "corners of a box",
          USED(ONLY(form, ONE(SHAPE_BOX), "the form is not box"))),
    PARAM(P, points,   "m",   "()", -1e9, 1e9, "corners of a polygon",
          USED(ONLY(form, ONE(SHAPE_POLYGON), "the form is not polygon"))),
    SURFACE_ROWS(P, USED(ONLY(form, ONE(SHAPE_MESH), "the form is not mesh")),
                 USED(ONLY(form, ONE(SHAPE_POLYGON), "the form is not polygon")),
                 USED(ONLY(form, ONE(SHAPE_POLYGON) | ONE(SHAPE_MESH), "the form is not polygon or mesh"))),
    PARAM(P, centre,   "m",   "(0.0, 0.0, 0.0)", -1e9, 1e9, "of a disc",
          USED(ONLY(form, ONE(SHAPE_DISC), "the form is not disc"))),
    PARAM(P, radius,   "m",   "0.0", 0, 1e9, "of a disc",
          USED(ONLY(form, ONE(SHAPE_DISC), "the form is not disc"))),
    PARAM(P, level,    "m",   "0.0", -1e9, 1e9, "below: height against gravity",
          USED(ONLY(form, ONE(SHAPE_BELOW), "the form is not below"))),
    PARAM(P, hole,     "-",   "false", 0, 0, "remove the region from earlier shapes"),
    PARAM(P, velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "added to that of initial.field",
          USED(WITHOUT(hole, "a hole has no fluid"))),
};
#undef P
#define P struct scene_probe
static const struct param probe_rows[] = {
    PARAM(P, name, "-", "probe#", 0, 0, "its name in series.csv"),
    CHOICE(P, kind, "pressure|level|shore|discharge|velocity", "pressure", "what it reads: pressure at a point; height against gravity of the surface in the column over it (where gravity leans: along the axis with most of it, from the origin), which stands on the floor or body next below it (sph); height of the water's edge on a beach, to both sides of a place in the water (sph in 2D); discharge through the line from at to `to`, to its right-hand side, in 3D through the rectangle between these corners, along the axis across it (sph: an oblique line goes on 2 dx beyond the floor; a section closer than 3 dx to an open side is read that far from it), and the volume at the end: what overtops a wall goes through a line over its crest; velocity at a point, nan where no water is"),
    PARAM(P, at,   "m", NULL, -1e9, 1e9, "place"),
    PARAM(P, to,   "m",   "(0.0, 0.0, 0.0)", -1e9, 1e9, "of a discharge: the other end of its line, the other corner of its rectangle",
          USED(ONLY(kind, ONE(PROBE_DISCHARGE), "only a discharge goes through a line"))),
    PARAM(P, radius, "m", "0.0", 0, 1e9, "of a pressure gauge (sph): it reads the mean over a disc (3D: sphere) of this radius, whatever the particle size; where less than a quarter (3D: an eighth) of it is wet the reading falls in proportion; 0, or less than R of the particles: R",
          USED(ONLY(kind, ONE(PROBE_PRESSURE), "a level is that of a column of the particles' size"),
               NEED(SPH, "fv reads the pressure at the point, between its cells"))),
    PARAM(P, body, "-", "", 0, 0, "name of the moving body (fv: block) that it is fixed to: pressure, velocity, or the level over its place, `at` at the start",
          USED(ONLY(kind, ~ONE(PROBE_DISCHARGE) & ~ONE(PROBE_SHORE), "a discharge and a shore are read at rest"))),
};
#undef P
#define OWN_WAVES ONLY(kind, ~ONE(WAVE_FILE), "waves.file tells it")
#define P struct scene_waves
static const struct param waves_rows[] = {
    CHOICE(P, kind, "regular|sea|focused|file", "regular", "of steady form; with JONSWAP's spectrum and random phases; a group of that spectrum whose crests meet; those of waves.file"),
    PARAM(P, height,    "m", "0.0", 0, 1e6, "from trough to crest; sea: significant height; focused: twice the linear crest",
          USED(OWN_WAVES)),
    PARAM(P, length,    "m", "0.0", 0, 1e6, "of a wave, of a sea's peak; this or period",
          USED(OWN_WAVES)),
    PARAM(P, period,    "s", "0.0", 0, 1e6, "of a wave, of a sea's peak; this or length",
          USED(OWN_WAVES)),
    PARAM(P, depth,     "m", "0.0", 0, 1e6, "of the still water where the waves are made; 0: from the shapes' level to the floor of the domain"),
    PARAM(P, direction, "-", "1e30", -360, 360, "degrees about the vertical in which they run; 0: along the first horizontal axis, +x; 90: along the second; 180: -x; by default into the domain from the first side of kind wave"),
    PARAM(P, at,        "-", "(0.0, 0.0)", -1e9, 1e9, "(m, s): place along the direction and time of a crest of a regular wave, of the focus of a group, of the beginning of a file",
          USED(ONLY(kind, ~ONE(WAVE_SEA), "the phases of a sea are random")), .numbers = 2),
    PARAM(P, start,     "-", "2.0", 0, 100, "periods over which the waves grow from water at rest; 0: at once"),
    PARAM(P, current,   "m/s", "0.0", -1e3, 1e3, "uniform current along the direction on which waves run (against them: negative): periods are those at rest; the sides behind the zones are open then, and initial.velocity is the current"),
    PARAM(P, closed,    "-", "true", 0, 0, "they carry no water of their own, as between closed walls: the mean velocity below the troughs is less than the current by that; false: it is the current"),
    PARAM(P, zone,      "m", "0.0", 0, 1e9, "length of the zone before each side of kind wave or beach; 0: one wave length, 1.5 where the water is deep (kh > 2), for a sea 1.5 times its peak's"),
    PARAM(P, peak,      "-", "3.3", 1, 10, "JONSWAP's gamma: how sharp the peak of the spectrum is",
          USED(OWN_WAVES,
               ONLY(kind, ~ONE(WAVE_REGULAR), "regular waves have no spectrum"))),
    PARAM(P, repeat,    "s", "0.0", 0, 1e9, "after which a sea repeats itself; 0: 25, 50, 100, .. periods, what the run and 10 periods need: give it if the run may go on to a later end",
          USED(OWN_WAVES,
               ONLY(kind, ~ONE(WAVE_REGULAR), "regular waves repeat themselves every period"))),
    PARAM(P, spread,    "-", "0.0", 0, 200, "3D: of a sea's directions b about the mean, as cos^2s(b/2), one of each component, at most 75 degrees: 5 to 10 for wind seas, 25 to 75 for swell; 0: all of one direction",
          USED(OWN_WAVES,
               ONLY(kind, ONE(WAVE_SEA), "only a sea has several directions"),
               NEED(SPACE, "in 2D waves have one direction"),
               WHERE(any_maker, "a side of kind wave", "a paddle makes long crests: only sides of kind wave do not"))),
    PARAM(P, order,     "-", "2", 1, 2, "of a sea or a group that zones make: 2 with the waves that each pair of components binds (higher crests, flatter troughs, long waves under groups); 1: a sum of linear waves",
          USED(OWN_WAVES,
               ONLY(kind, ~ONE(WAVE_REGULAR), "regular waves are of steady form, exact"),
               WHERE(any_maker, "a side of kind wave", "a paddle makes the linear waves; a side of kind wave makes bound ones"),
               ONLY(evolve, ONE(EVOLVE_NO), "waves that evolve (waves.evolve) bind others of all orders by themselves"),
               WITHOUT(spread, "a sea of several directions (waves.spread) is a sum of linear waves")), .comparison = true),
    PARAM(P, file,      "-", "\"\"", 0, 0, "of kind file: waves of another program in the format Spectral Wave Data (.swd, shapes 1 and 2), beside the case; they have their height, length and depth",
          USED(ONLY(kind, ONE(WAVE_FILE), "only waves of kind file are read from one"))),
    CHOICE(P, evolve, "no|full|hos", "no", "a sea or a group that zones make evolves nonlinearly from eight periods before the run, over a periodic line (spread: plane) in potential flow; full: for all waves that do not break; hos: by orders in steepness, several times cheaper, up to a steepness of 0.3",
          USED(OWN_WAVES,
               ONLY(kind, ~ONE(WAVE_REGULAR), "regular waves keep their form"),
               WHERE(any_maker, "a side of kind wave", "a paddle makes the linear waves; what a side of kind wave makes evolves"))),
    PARAM(P, seed,      "-", "1", 0, 2000000000, "of the random phases of a sea",
          USED(OWN_WAVES,
               ONLY(kind, ONE(WAVE_SEA), "only the phases of a sea are random"))),
};
#undef P
#define P struct scene_gauges
static const struct param gauges_rows[] = {
    PARAM(P, name,   "-", "gauges#", 0, 0, "its name in summary.json"),
    PARAM(P, probes, "-", NULL, 0, 0, "names of 2 to 8 level gauges along the waves, as \"w1 w2 w3\"; good places are 0, 0.1 and 0.27 wave lengths from the first, never half a length apart"),
    PARAM(P, from,   "s", "0.0", 0, 1e9, "from when waves are judged, over whole periods to the end; 0: the second half of the run"),
    PARAM(P, period, "s", "0.0", 0, 1e6, "of the waves; 0: that of the group waves"),
    PARAM(P, depth,  "m", "0.0", 0, 1e6, "of the still water below the gauges, for the length of the waves there, as on a shelf; 0: that of the group waves"),
};
#undef P
#define P struct scene_coupling
static const struct param coupling_rows[] = {
    PARAM(P, steps,      "-", "0",   0, 100000, "SPH steps in a coupling step, from one exchange to the next; 0: as many as the flow allows",
          USED(NEED(COUPLED, NO_PARTNER))),
    PARAM(P, transition, "m", "0.0", 0, 1e6, "width of the zone where SPH is blended with FV; 0: 1.25 R",
          USED(NEED(SPH, "this is no coupled job: it has no group sph"),
               NEED(ZONES, "no side of the particles' region is open")), .comparison = true),
    PARAM(P, buffer,     "m", "0.0", 0, 1e6, "width of the zone where SPH takes FV's fields; 0: 1.25 R",
          USED(NEED(SPH, "this is no coupled job: it has no group sph"),
               NEED(ZONES, "no side of the particles' region is open")), .comparison = true),
    PARAM(P, overlap,    "m", "0.0", 0, 1e6, "width of the border of SPH's free zone where FV is free, too; 0: 1.25 R, and as wide as leaves FV four cells across of what SPH gives where all sides of the box are open and there is no surface, body or wall in it",
          USED(NEED(COUPLED, NO_PARTNER))),
    PARAM(P, memory,     "-", "0",   0, 1000, "coupling steps over which FV's pressure is smoothed (level and trend); 1: none; 0: as many as the gain of the coupling loop requires",
          USED(NEED(COUPLED, NO_PARTNER)), .comparison = true),
    PARAM(P, keep_mass,  "-", "true", 0, 0, "SPH's part without a surface: the mass gained in a coupling step leaves through the open sides in the next",
          USED(NEED(COUPLED, NO_PARTNER)), .comparison = true),
    CHOICE(P, mapping, "shepard|mls", "mls", "from particles to imposed cells",
          USED(NEED(COUPLED, NO_PARTNER)), .comparison = true),
    CHOICE(P, interpolation, "linear|cubic", "cubic", "from cells to particles",
          USED(NEED(COUPLED, NO_PARTNER)), .comparison = true),
    CHOICE(P, in_time, "trial|linear", "trial", "FV's fields within a coupling step: between now and a trial of FV; for comparison extrapolated on straight lines from the steps before (Chiron)",
          USED(NEED(COUPLED, NO_PARTNER)), .comparison = true),
    CHOICE(P, blend, "entering|all", "entering", "what SPH's transition takes from the flow outside: across a side only the wave that enters; for comparison all of velocity and pressure (Chiron)",
          USED(NEED(SPH, "this is no coupled job: it has no group sph"),
               NEED(ZONES, "no side of the particles' region is open")), .comparison = true),
    PARAM(P, deadline,   "s", "30.0", 0.1, 1e6, "to find the other programs of the job",
          USED(NEED(COUPLED, NO_PARTNER))),
};
#undef P
#define P struct scene_output
static const struct param output_rows[] = {
    PARAM(P, every,     "s", "0.0", 0, 1e9, "between snapshots; 0: the first and the last only"),
    PARAM(P, snapshots, "-", "true", 0, 0, "write HDF5 snapshots and their XDMF files"),
    PARAM(P, fields,    "-", "velocity pressure vorticity", 0, 0, "fields of a snapshot; vorticity_exact (fv): of the exact solution, too",
          USED(NEED(PICTURES, "output.snapshots = false"))),
    PARAM(P, series,    "-", "0", 0, 1e9, "steps between rows of series.csv; 0: 3 with a free surface in fv alone, else 10"),
    PARAM(P, checkpoint,      "s", "0.0", 0, 1e9, "of simulated time between restart files; 0: only at a stop"),
    PARAM(P, checkpoint_wall, "s", "0.0", 0, 1e9, "of wall time between restart files; 0: none"),
};
#undef P
#define P struct scene_accept
static const struct param accept_rows[] = {
    PARAM(P, what,      "-", NULL, 0, 0, "key of summary.json, as error.velocity_l2; with a reference: column of series.csv without its unit"),
    PARAM(P, reference, "-", "", 0, 0, "CSV file beside the case to compare the column with: t first, comments behind #"),
    PARAM(P, column,    "-", "", 0, 0, "column of the reference; by default named like what",
          USED(WITH(reference, "no reference is given to compare with"))),
    CHOICE(P, measure, "rms|peak|impulse|arrival", "rms", "difference over the reference's range; of the largest values, the integrals, the times of half the peak, relative",
          USED(WITH(reference, "no reference is given to compare with"))),
    PARAM(P, from,      "s", "0.0", -1e9, 1e9, "start of the comparison",
          USED(WITH(reference, "no reference is given to compare with"))),
    PARAM(P, until,     "s", "1e30", -1e9, 1e9, "its end; by default the end of the run or of the reference",
          USED(WITH(reference, "no reference is given to compare with"))),
    PARAM(P, start,     "s", "0.0", -1e9, 1e9, "time of the run at which the reference's t is 0",
          USED(WITH(reference, "no reference is given to compare with"))),
    PARAM(P, unit,      "-", "(1.0, 1.0)", -1e12, 1e12, "units of the reference: its t times the first is s, its value times the second is the column's",
          USED(WITH(reference, "no reference is given to compare with")), .numbers = 2),
    PARAM(P, tolerance, "-", NULL, -1e300, 1e300, "largest value that is accepted"),
};
#undef P
/* clang-format on */

void scene_groups(struct scene *s, struct param_group *groups)
{
    const struct param_group all[SCENE_GROUPS] = {
        {"time", "How long", ROWS(time_rows), &s->time, NULL, 0, 0, NULL},
        {"fluid", "What flows", ROWS(fluid_rows), &s->fluid, NULL, 0, 0, NULL},
        {"domain", "Where it flows", ROWS(domain_rows), &s->domain, NULL, 0, 0, NULL},
        {"initial", "How it starts", ROWS(initial_rows), &s->initial, NULL, 0, 0, NULL},
        {"walls", "List of walls, inlets and outlets", ROWS(wall_rows), s->walls, NULL,
         sizeof s->walls[0], WALLS_MAX, &s->nwalls},
        {"bodies", "List of bodies: fixed, driven or free", scene_body_rows, scene_body_nrows,
         s->bodies, NULL, sizeof s->bodies[0], BODIES_MAX, &s->nbodies},
        {"shapes", "List of regions that hold fluid at the start; none: everywhere",
         ROWS(shape_rows), s->shapes, NULL, sizeof s->shapes[0], SHAPES_MAX, &s->nshapes},
        {"probes", "List of gauges in series.csv", ROWS(probe_rows), s->probes, NULL,
         sizeof s->probes[0], PROBES_MAX, &s->nprobes},
        {"gauges", "List of groups of level gauges that tell incident from reflected waves",
         ROWS(gauges_rows), s->gauges, NULL, sizeof s->gauges[0], GAUGES_MAX, &s->ngauges},
        {"waves", "Waves that sides of kind wave make", ROWS(waves_rows), &s->waves, &s->has_waves,
         0, 0, NULL},
        {"coupling", "How sph and fv are coupled", ROWS(coupling_rows), &s->coupling,
         &s->has_coupling, 0, 0, NULL},
        {"output", "What is written", ROWS(output_rows), &s->output, &s->has_output, 0, 0, NULL},
        {"accept", "List of criteria that the result must meet for exit code 0", ROWS(accept_rows),
         s->accept, NULL, sizeof s->accept[0], ACCEPT_MAX, &s->naccept},
    };
    memcpy(groups, all, sizeof all);
}

const char *const scene_side_names[6] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

const struct scene_wall *scene_wall_of(const struct scene *s, enum scene_side side)
{
    for (int k = 0; k < s->nwalls; k++)
        if (s->walls[k].side == (int)side)
            return s->walls + k;
    return NULL;
}

bool scene_side_is_wall(const struct scene *s, enum scene_side side)
{
    const struct scene_wall *w = scene_wall_of(s, side);
    return w && w->kind < WALL_INFLOW;
}

bool scene_shapes_flow(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nshapes; k++)
        any = any || vec3_length(s->shapes[k].velocity) > 0.0;
    return any;
}

bool scene_has_wave(const struct scene *s)
{
    return s->initial.field == FIELD_STANDING_WAVE || s->initial.field == FIELD_STOKES ||
           scene_has_steady_wave(s);
}

bool scene_has_steady_wave(const struct scene *s)
{
    return s->initial.field == FIELD_REGULAR || s->initial.field == FIELD_SOLITARY;
}

/* A solitary wave's is 2 pi/k of sech^2(k x), k^2 = 3 a/(4 H^3). */
double scene_wave_length(const struct scene *s)
{
    const double H = s->initial.level - s->domain.min[1];
    return s->initial.field == FIELD_SOLITARY
               ? 2.0 * M_PI * sqrt(4.0 * H * H * H / (3.0 * s->initial.amplitude))
               : s->initial.L;
}

/* Whether a box, or water below a level, leaves no air between sides that are all closed. */
static bool is_filled(const struct scene *s)
{
    const struct scene_domain *d = &s->domain;
    double low, high;
    bool shut = !s->has_waves, filled = false;
    for (int a = 0; a < d->dim; a++)
        for (int end = 0; end < 2; end++)
            shut = shut && (d->periodic[a] || scene_side_is_wall(s, SIDE_X_MIN + 2 * a + end));
    if (!shut) /* heights ask for a surface where a channel is open */
        return false;
    scene_heights(s, &low, &high);
    for (int k = 0; k < s->nshapes; k++) {
        const struct scene_shape *h = s->shapes + k;
        bool all = h->form == SHAPE_BOX;
        for (int a = 0; a < d->dim && all; a++) {
            const double near = 1e-9 * (d->max[a] - d->min[a]);
            all = fmin(h->box[0][a], h->box[1][a]) <= d->min[a] + near &&
                  fmax(h->box[0][a], h->box[1][a]) >= d->max[a] - near;
        }
        all = all || (h->form == SHAPE_BELOW && h->level >= high - 1e-9 * (high - low));
        filled = !h->hole && (filled || all);
    }
    return filled;
}

bool scene_has_surface(const struct scene *s)
{
    const int f = s->initial.field;
    return (s->nshapes > 0 && !is_filled(s)) || scene_has_wave(s) || f == FIELD_PATCH ||
           f == FIELD_DROP;
}

bool scene_has_openings(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nwalls; k++)
        any = any || scene_wall_opens(s->walls + k);
    return any;
}

bool scene_has_no_slip(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->nwalls; k++)
        any = any || s->walls[k].kind == WALL_NO_SLIP;
    for (int k = 0; k < s->nbodies; k++)
        any = any || s->bodies[k].kind == WALL_NO_SLIP;
    return any;
}

/* Whether anything but sides of the domain stands in the flow. */
bool scene_has_lines(const struct scene *s)
{
    bool any = s->nbodies > 0;
    for (int k = 0; k < s->nwalls; k++)
        any = any || s->walls[k].side == SIDE_NONE;
    return any;
}

/* Of the k-th wall, which is a side of the domain. */
static void check_side(const struct scene *s, const struct params *p, int k, struct faults *f)
{
    const int side = s->walls[k].side - SIDE_X_MIN, a = side / 2;
    const struct scene_wall *first = scene_wall_of(s, (enum scene_side)s->walls[k].side);
    const char *key = key_text("walls.[%d].side", k), *name = scene_side_names[side];
    if (a >= s->domain.dim)
        params_fault(p, f, key,
                     "%s in a case of 2 dimensions: the plane is x, y; or domain.dim = 3", name);
    else if (s->domain.periodic[a])
        params_fault(p, f, key, "%s is periodic: leave the wall out, or domain.periodic along %c",
                     name, "xyz"[a]);
    if (first != s->walls + k)
        params_fault(p, f, key, "%s is wall %d already: leave one out", name,
                     (int)(first - s->walls) + 1);
}

static void check_walls(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nwalls; k++) {
        const struct scene_wall *w = s->walls + k;
        const char *key = key_text("walls.[%d]", k);
        const bool mesh = *w->surface.mesh != '\0';
        if (w->side == SIDE_NONE && w->points.n < 2 && !mesh)
            params_fault(p, f, key, "wall %d: give a side, a mesh or at least two points", k + 1);
        else if ((w->side != SIDE_NONE) + (w->points.n > 0) + mesh > 1)
            params_fault(p, f, key, "wall %d: give one of side, points and mesh", k + 1);
        if (w->side != SIDE_NONE)
            check_side(s, p, k, f);
        if (w->kind >= WALL_INFLOW && w->side == SIDE_NONE)
            params_fault(p, f, key, "wall %d: inlets and outlets lie on sides of the domain",
                         k + 1);
    }
}

static void check_shapes(const struct scene *s, const struct params *p, struct faults *f)
{
    for (int k = 0; k < s->nbodies; k++)
        if (s->bodies[k].points.n > 0 && *s->bodies[k].surface.mesh)
            params_fault(p, f, "bodies", "body %d: give points or a mesh, not both", k + 1);
        else if (s->bodies[k].points.n + s->bodies[k].section.n < 3 &&
                 !scene_has_triangles(s, MESH_OF_BODY, k))
            params_fault(p, f, "bodies",
                         "body %d: expected three points or more, a box, a radius%s", k + 1,
                         s->domain.dim == 3 ? " or a mesh" : " or an outline");
    for (int k = 0; k < s->nshapes; k++) {
        const struct scene_shape *h = s->shapes + k;
        if (h->form == SHAPE_POLYGON && h->points.n < 3)
            params_fault(p, f, "shapes", "shape %d: expected three points or more", k + 1);
        if (h->form == SHAPE_DISC && h->radius <= 0.0)
            params_fault(p, f, "shapes", "shape %d: the radius must be given", k + 1);
        if (h->form == SHAPE_MESH && !*h->surface.mesh)
            params_fault(p, f, "shapes", "shape %d: its mesh must be given", k + 1);
    }
}

/* Components beyond the dimensions would be dropped silently: most likely the case is one of 3D. */
static void check_domain(const struct scene *s, const struct params *p, struct faults *f)
{
    static const char axes[] = "xyz";
    const struct scene_domain *d = &s->domain;
    for (int a = 0; a < d->dim && a < 3; a++)
        if (!(d->max[a] > d->min[a]))
            params_fault(p, f, "domain.max", "%c: %g m is not above domain.min, %g m", axes[a],
                         d->max[a], d->min[a]);
    for (int a = d->dim; a < 3; a++)
        if (s->fluid.gravity[a] != 0.0 || s->initial.velocity[a] != 0.0)
            params_fault(p, f, s->fluid.gravity[a] != 0.0 ? "fluid.gravity" : "initial.velocity",
                         "%c component in a case of %d dimensions%s", axes[a], d->dim,
                         d->dim == 2 ? ": the plane is x, y, as in (0, -9.81); or domain.dim = 3"
                                     : "");
}

/* Fields of waves run along x over a depth along y; what sides make runs along any axis. */
static bool check_upright(const struct scene *s, const struct params *p, struct faults *f)
{
    const double *g = s->fluid.gravity;
    const bool upright = g[0] == 0.0 && g[1] < 0.0 && g[2] == 0.0;
    if (scene_has_wave(s) && !upright)
        params_fault(p, f, "fluid.gravity",
                     "the waves of initial.field have gravity along -y alone: turn the scene, or "
                     "let a side make them (walls.kind = \"wave\"), under gravity along any axis");
    return upright;
}

/* A wave field repeats itself only over whole wave lengths. */
static void check_field(const struct scene *s, const struct params *p, struct faults *f)
{
    const int field = s->initial.field;
    if (field == FIELD_BELTRAMI && s->domain.dim < 3)
        params_fault(p, f, "initial.field", "beltrami: a field of three dimensions");
    const bool upright = check_upright(s, p, f);
    if (s->nshapes > 0 && (scene_has_wave(s) || field == FIELD_PATCH || field == FIELD_DROP))
        params_fault(p, f, "shapes",
                     "initial.field has water of its own, which shapes would replace, with their "
                     "surface under its velocities: leave shapes out");
    if (scene_has_steady_wave(s) && !(s->initial.level < LEVEL_TOP))
        params_fault(p, f, "initial.level", "a wave needs the level of the water at rest");
    else if (scene_has_steady_wave(s) && upright) {
        const struct exact e = exact_create(s);
        if (!(e.steady.c > 0.0))
            params_fault(
                p, f, "initial.amplitude",
                "%g m: a wave of permanent form is higher than 0, and lower than about 0.13 "
                "of its length from trough to crest, a solitary one than 0.75 of the depth",
                s->initial.amplitude);
    }
    if (s->initial.L_z > 0.0 && (field != FIELD_STANDING_WAVE || s->domain.dim < 3))
        params_fault(p, f, "initial.L_z", "needs a standing wave in three dimensions");
    const double H = s->domain.max[1] - s->domain.min[1];
    if ((field == FIELD_POISEUILLE || field == FIELD_COUETTE) && params_given(p, "initial.L") &&
        fabs(s->initial.L - H) > 1e-9 * H)
        params_fault(p, f, "initial.L", "%g m: of a channel it is the height, %g m; leave it out",
                     s->initial.L, H);
    if (field != FIELD_TAYLOR_GREEN && field != FIELD_TWO_MODES && field != FIELD_BELTRAMI &&
        field != FIELD_STOKES && field != FIELD_REGULAR)
        return;
    for (int a = 0; a < (field == FIELD_BELTRAMI ? 3 : 2); a++) {
        const double n = (s->domain.max[a] - s->domain.min[a]) / s->initial.L;
        if (s->domain.periodic[a] && fabs(n - round(n)) > 1e-9)
            params_fault(
                p, f, "initial.L",
                "%g m: the periodic domain holds %g wave lengths, it must be a whole number",
                s->initial.L, n);
    }
}

/* In stages, each only if the one before found no fault: what is judged later would read nonsense.
 */
void scene_check(struct scene *s, const struct params *p, struct faults *f)
{
    static const char *const needed[][2] = {{"time", "end = 10.0"},
                                            {"domain", "min = (0, 0); max = (2, 1)"}};
    struct param_group groups[SCENE_GROUPS];
    for (int k = 0; k < 2; k++)
        if (!params_has_group(p, needed[k][0]))
            params_fault(p, f, needed[k][0], "the case must have this group, as %s: { %s; };",
                         needed[k][0], needed[k][1]);
    if (f->n)
        return; /* what follows needs sound values */
    scene_waves_mark(s);
    check_domain(s, p, f);
    check_field(s, p, f);
    check_walls(s, p, f);
    check_shapes(s, p, f);
    if (f->n)
        return;
    scene_groups(s, groups);
    params_check_use(p, groups, SCENE_GROUPS, NULL, s, f);
    scene_waves_check(s, p, f);
    const int before = f->n;
    if (s->domain.dim == 2)
        params_check_plane(p, groups, SCENE_GROUPS, f);
    if (f->n == before) /* what follows needs vectors of the plane */
        scene_check_sense(s, p, f);
}

static bool has_word(const char *list, const char *word, size_t n)
{
    for (const char *at = list; *(at += strspn(at, " ,")); at += strcspn(at, " ,"))
        if (strcspn(at, " ,") == n && strncmp(at, word, n) == 0)
            return true;
    return false;
}

bool scene_shows(const struct scene *s, const char *field)
{
    return has_word(s->output.fields, field, strlen(field));
}

/* By each program, for each has fields of its own; words are apart by blanks or commas. */
void scene_check_shown(const struct scene *s, const struct params *p, const char *program,
                       const char *known, struct faults *f)
{
    size_t n = 0;
    for (const char *at = s->output.fields; *(at += strspn(at, " ,")); at += n) {
        n = strcspn(at, " ,");
        if (!has_word(known, at, n))
            params_fault(p, f, "output.fields", "%.*s: the fields of %s are %s", (int)n, at,
                         program, known);
    }
}

void scene_check_facts(const struct scene *s, const struct params *p, unsigned long long facts,
                       struct faults *f)
{
    static struct scene copy; /* the table's targets are not to be written */
    struct param_group groups[SCENE_GROUPS];
    copy = *s;
    scene_groups(&copy, groups);
    params_check_use(p, groups, SCENE_GROUPS, &facts, s, f);
}

/* Facts that hold; those which a program alone can tell are left as holding, it takes them away. */
unsigned long long scene_facts(const struct scene *s, const struct params *p)
{
    const bool pictures = s->output.snapshots || params_on_command_line(p, "output.snapshots");
    unsigned long long lacks = 0;
    lacks |= s->has_sph ? 0 : FACT(SPH) | FACT(ZONES);
    lacks |= s->has_fv ? FACT(SPH_ALONE) : FACT(FV);
    lacks |= s->has_sph && s->has_fv ? 0 : FACT(COUPLED);
    lacks |= s->fluid.nu > 0.0 ? 0 : FACT(VISCOUS);
    lacks |= s->has_fv || s->fluid.nu > 0.0 ? 0 : FACT(FRICTION);
    lacks |= pictures ? 0 : FACT(PICTURES);
    lacks |= s->domain.dim == 3 ? 0 : FACT(SPACE);
    return ~lacks;
}

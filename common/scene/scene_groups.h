/* scene_groups.h - the groups of a case that every program reads: what is computed, not how. A
 * plain struct that params_read fills through the table of scene.c; "resolved" members are filled
 * afterwards by the functions named. Sizes are in SI units, arrays of three hold zeros where 2D has
 * no third component.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <math.h>
#include <stdbool.h>

#include "../params/params.h"
#include "scene_body.h"
#include "scene_surface.h"

/* Velocity at t = 0 (initial.field); exact.h says what each is. */
enum initial_field {
    FIELD_REST,
    FIELD_UNIFORM,
    FIELD_TAYLOR_GREEN,
    FIELD_TWO_MODES,
    FIELD_POISEUILLE,
    FIELD_COUETTE,
    FIELD_STANDING_WAVE,
    FIELD_PATCH,
    FIELD_DROP,
    FIELD_BELTRAMI,
    FIELD_STOKES,
    FIELD_REGULAR,
    FIELD_SOLITARY
};
/* Sides of the domain (walls.side); SIDE_NONE: the wall is a polyline or a mesh. */
enum scene_side {
    SIDE_NONE,
    SIDE_X_MIN,
    SIDE_X_MAX,
    SIDE_Y_MIN,
    SIDE_Y_MAX,
    SIDE_Z_MIN,
    SIDE_Z_MAX
};
/* Kinds of sides and walls. Wave and beach are slip walls with a zone before them
 * (scene_waves_mark). Falls is no word of a case: sph gives it to an outflow
 * that openings_resolve found to have nothing outside (falls), where the region simply ends and
 * water that leaves is meant to fall out. */
enum wall_kind {
    WALL_SLIP,
    WALL_NO_SLIP,
    WALL_INFLOW,
    WALL_OUTFLOW,
    WALL_ABSORBING,
    WALL_WAVE,
    WALL_BEACH,
    WALL_FALLS
};
/* The zone before a side: none, one that absorbs waves, one that makes them. */
enum wall_zone { ZONE_NONE, ZONE_BEACH, ZONE_WAVE };
/* Velocity over an inflow: the same everywhere, or a parabola between its ends whose mean it is. */
enum wall_profile { PROFILE_UNIFORM, PROFILE_PARABOLIC };
/* How sph takes fv's fields within a coupling step: between those at its beginning and those of a
 * trial step of fv at its end, or extrapolated on straight lines from earlier coupling steps. */
enum coupling_in_time { IN_TIME_TRIAL, IN_TIME_LINEAR };
/* What of fv's fields sph takes in its transition zone: the characteristic that enters, or all. */
enum coupling_blend { BLEND_ENTERING, BLEND_ALL };
/* Forms of a shape of fluid; SHAPE_BELOW is all of the domain below a level. */
enum shape_form { SHAPE_BOX, SHAPE_POLYGON, SHAPE_DISC, SHAPE_BELOW, SHAPE_MESH };
/* On which side of a mesh the fluid is: to be found out from the shapes, inside, outside, or, of a
 * sheet, on the side that its normals point away from. */
enum fluid_side { FLUID_AUTO, FLUID_INSIDE, FLUID_OUTSIDE, FLUID_SHEET };
/* How a series is compared with its reference (accept.measure); accept_distance has the
 * definitions. */
enum accept_measure { ACCEPT_RMS, ACCEPT_PEAK, ACCEPT_IMPULSE, ACCEPT_ARRIVAL };
/* What a gauge reads: pressure, Pa; height of the surface, m; height of the water's edge on a
 * beach, m; volume through a line or a rectangle, m^dim/s; velocity, m/s. */
enum probe_kind { PROBE_PRESSURE, PROBE_LEVEL, PROBE_SHORE, PROBE_DISCHARGE, PROBE_VELOCITY };
/* Most elements of each list of the case; GAUGE_PROBES is that of the level gauges in one group,
 * SCENE_GROUPS the number of groups that scene_groups fills in. */
enum {
    ACCEPT_MAX = 16,
    WALLS_MAX = 16,
    BODIES_MAX = 8,
    SHAPES_MAX = 16,
    PROBES_MAX = 24,
    GAUGES_MAX = 8,
    GAUGE_PROBES = 8,
    SCENE_GROUPS = 13
};

/* The scene. All members are the same on all ranks; it is owned by struct run and read-only after
 * the start. */
struct scene {
    struct scene_time {
        double end; /* s */
    } time;
    struct scene_fluid {
        double rho;        /* kg/m^3 */
        double nu;         /* m^2/s; 0: inviscid, nothing viscous is computed */
        double gravity[3]; /* m/s^2 */
        double central;    /* 1/s: W of the acceleration -W^2 x towards the origin; 0: none */
    } fluid;
    struct scene_domain {
        int dim;               /* 2 or 3 */
        double min[3], max[3]; /* m */
        bool periodic[3];
    } domain;
    struct scene_initial {
        int field;          /* enum initial_field */
        double U, L;        /* m/s, m: scales of the field; errors are relative to them */
        double velocity[3]; /* m/s: uniform velocity, or the one that carries two_modes */
        double amplitude;   /* m: of a wave */
        double L_z;         /* m: its length along z; 0: the same for all z */
        double crest;       /* m: x of the crest of a travelling wave */
        double level;       /* m: height against gravity where p = 0; LEVEL_TOP: the fluid's top */
        struct param_places seed; /* m: points that are known to be fluid */
    } initial;
    /* Sides of the domain, polylines with the fluid on their left, and meshes. A side without a
     * wall that is not periodic is open in sph, and has the exact solution outside in fv. */
    struct scene_wall {
        int side; /* enum scene_side; SIDE_NONE: points or a mesh */
        struct param_points points;
        struct scene_surface surface; /* 3D: triangles of a file */
        int fluid_side;               /* enum fluid_side: of that */
        bool flip, thin; /* normals of an open mesh reversed; no interaction of fluid across it */
        bool closed;     /* the last point is joined with the first */
        bool turned;     /* by scene_orient */
        int kind;        /* enum wall_kind */
        double friction; /* -: c_f of a slip wall's quadratic bed friction */
        double velocity[3]; /* m/s: of the wall along itself, or of the inflow */
        int profile;        /* enum wall_profile, of an inflow */
        double pressure;    /* Pa: at an outflow */
        double beach,
            beach_period; /* m, s: length of its zone and period of the waves it absorbs; 0: none */
        int zone;         /* enum wall_zone, by scene_waves_mark */
        bool carried; /* fv: convective outflow, which advects the velocity instead of imposing p */
        double level; /* m: of the water in an opening, if has_level */
        double discharge; /* m^dim/s: in through an inflow, out through an outflow; 0: not given */
        char level_file[PARAM_TEXT_SIZE], discharge_file[PARAM_TEXT_SIZE]; /* both over time */
        bool has_level, has_discharge;                 /* by wall_histories_read, as the next */
        const struct motion_file *levels, *discharges; /* of these files; NULL: constant */
        bool assumed; /* the case has no such wall: fv closes the air */
        /* Resolved by openings_resolve for an outflow under a free surface that is given neither
         * level nor discharge: the level of the water that stands in it at the start, m, NAN: not
         * known. */
        double stands;
        bool falls, lower; /* no water stands in it, so that water falls out; openings_are_lower */
    } walls[WALLS_MAX];
    int nwalls;
    struct scene_body bodies[BODIES_MAX]; /* scene_body.h */
    int nbodies;
    /* Where the fluid is at the start: a later shape overrides earlier ones. No shapes: everywhere,
     * or where the field says. */
    struct scene_shape {
        int form; /* enum shape_form */
        double box[2][3];
        struct param_points points;
        struct scene_surface surface;
        double centre[3], radius; /* m: of a disc, in 3D a ball */
        double level;             /* m: below it, against gravity */
        bool hole;                /* takes fluid of earlier shapes away */
        double velocity[3];       /* m/s: added to the field's */
    } shapes[SHAPES_MAX];
    int nshapes;
    /* A gauge: a column of series.csv. */
    struct scene_probe {
        char name[PARAM_TEXT_SIZE];
        int kind;      /* enum probe_kind */
        double at[3];  /* m */
        double to[3];  /* m: other end of the line of a discharge, 3D: corner of its rectangle */
        double radius; /* m: a pressure is the mean over this radius; 0: R of the particles */
        char body[PARAM_TEXT_SIZE]; /* name of the body with which it moves; "": none */
    } probes[PROBES_MAX];
    int nprobes;
    /* A group of level gauges that together separate incident from reflected waves:
     * wave_gauges.h. */
    struct scene_gauges {
        char name[PARAM_TEXT_SIZE], probes[PARAM_TEXT_SIZE];
        double from, period; /* s: start of the evaluation; period of the waves */
        double depth;        /* m: below the gauges; 0: that of the waves */
    } gauges[GAUGES_MAX];
    int ngauges;
    /* Waves that sides of kind wave, or bodies with a motion of kind waves, make; scene_waves.h. */
    struct scene_waves {
        int kind;              /* enum wave_kind */
        double height;         /* m */
        double length, period; /* m, s */
        double depth;          /* m; 0: from the level to the domain's floor */
        double direction;      /* degrees about the vertical; WAVES_INWARD: not given */
        double at[3];          /* m, s: of a crest; the third is not used */
        double start;          /* periods of the soft start */
        double current;        /* m/s: of the water under the waves, along them */
        bool closed;           /* the waves add no net transport to it */
        double zone;           /* m: length of the zone; 0: follows from the waves */
        double peak, repeat; /* - peak factor of the spectrum; s after which a sea repeats itself */
        double spread;       /* -: s of cos^2s(b/2); 0: long crests */
        int order, seed;
        int evolve;                 /* enum wave_evolve */
        char file[PARAM_TEXT_SIZE]; /* of kind file, beside the case */
        char path[512];             /* to it, by scene_wave_file_read */
        struct waves_made {
            double crest, speed;   /* m, m/s: the highest, of the fastest water */
            double length, period; /* m, s: of a wave, of a sea's peak */
            double height;         /* m: from trough to crest, of a sea significant */
        } made;                    /* resolved by scene_waves_check */
    } waves;
    struct scene_coupling {
        int steps;         /* SPH steps in a coupling step; 0: automatic */
        double transition; /* m; 0: 1.25 R of the particles */
        double buffer;     /* m; 0: 1.25 R */
        double overlap;    /* m; 0: 1.25 R: of the free zone, outside the forced cells */
        int memory;        /* coupling steps over which FV's pressure is smoothed; 0: automatic */
        bool keep_mass; /* what SPH's part gained leaves through the openings; without a surface */
        int mapping;    /* 0 shepard, 1 mls: particles to forced cells */
        int interpolation; /* 0 linear, 1 cubic: patch to particles */
        int in_time;       /* enum coupling_in_time: how SPH takes FV's fields in time */
        int blend;         /* enum coupling_blend: what the transition takes from outside */
        double deadline;   /* s to meet the other programs */
    } coupling;
    struct scene_output {
        double every;                 /* s between snapshots; 0: first and last only */
        bool snapshots;               /* whether HDF5 snapshots are written at all */
        char fields[PARAM_TEXT_SIZE]; /* "velocity pressure ..." */
        int series; /* steps between rows of series.csv; run_main makes 0 the program's wish */
        double checkpoint;      /* s of simulated time between restart files; 0: only at a stop */
        double checkpoint_wall; /* s of wall time between restart files; 0: none */
    } output;
    int naccept;
    /* A criterion of the case; accept.h judges it. */
    struct scene_accept {
        char what[PARAM_TEXT_SIZE]; /* key of summary.json: "error.velocity_l2"; of series.csv */
        char reference[PARAM_TEXT_SIZE]; /* CSV file beside the case; "": none */
        char column[PARAM_TEXT_SIZE];    /* of the reference; "": named like what */
        int measure;                     /* enum accept_measure */
        double from, until;              /* s: of the comparison */
        double start;                    /* s: time of the run at which the reference's t is 0 */
        double unit[3];   /* of the reference's times (s) and values (as in series.csv) */
        double tolerance; /* accepted while the value is at most this */
    } accept[ACCEPT_MAX];
    bool has_coupling, has_output, has_waves;
    bool has_sph, has_fv; /* the groups of the solvers are there: both make a coupled job */
    double facet; /* m: edge wanted of the facets of round bodies in 3D; 0: fixed numbers of them */
    struct scene_meshes *meshes; /* what the files of surfaces hold; scene_mesh.h; NULL: none */
};

/* Values of initial.level and walls.level, and of waves.direction, that stand for "not given". */
#define LEVEL_TOP 1e30
#define WAVES_INWARD 1e30

/* "x_min", ... for SIDE_X_MIN + k. */
extern const char *const scene_side_names[6];
/* The wall on a side of the domain; NULL: the case has none there. Borrowed from the scene. */
const struct scene_wall *scene_wall_of(const struct scene *s, enum scene_side side);
/* Whether a side of the domain is a wall, with friction or without. */
bool scene_side_is_wall(const struct scene *s, enum scene_side side);

/* The image of x along axis a, m, that lies in the period from lo on; without a period x. */
static inline double scene_image_from(const struct scene_domain *d, int a, double lo, double x)
{
    const double L = d->max[a] - d->min[a];
    return d->periodic[a] ? x - L * floor((x - lo) / L) : x;
}

/* Whether from..to along axis a, m, has something in common with lo..hi, each no longer than a
 * period, in whatever period. */
static inline bool scene_ranges_meet(const struct scene_domain *d, int a, double lo, double hi,
                                     double from, double to)
{
    const double x = scene_image_from(d, a, lo, from), next = lo + d->max[a] - d->min[a];
    return (x < hi && x + to - from > lo) || (d->periodic[a] && x + to - from > next);
}

/* Whether a wall is an opening with fluid outside, i.e. inflow, outflow, absorbing, wave or beach,
 * but not falls. Wave and beach are marked as slip walls before anyone asks. */
static inline bool scene_wall_opens(const struct scene_wall *w)
{
    return w->kind >= WALL_INFLOW && w->kind != WALL_FALLS;
}

/* Whether a shape of the start has a velocity. */
bool scene_shapes_flow(const struct scene *s);
/* Whether the initial field is a wave with a free surface of its own. */
bool scene_has_wave(const struct scene *s);
/* Whether that wave is of permanent form: steady.h. */
bool scene_has_steady_wave(const struct scene *s);
/* Length of that wave, m; of a solitary one 2 pi/K of its profile sech^2 Kx, the length of a
 * periodic wave that is as steep. */
double scene_wave_length(const struct scene *s);
/* Whether there is a free surface: the water ends somewhere without a wall. */
bool scene_has_surface(const struct scene *s);
/* Whether some side opens; some wall or body has no slip; walls are lines or meshes, or bodies are
 * there: more than sides of the domain. */
bool scene_has_openings(const struct scene *s);
bool scene_has_no_slip(const struct scene *s);
bool scene_has_lines(const struct scene *s);

/* Fills groups[SCENE_GROUPS] with the parameter table of the groups above, s being the target; s
 * must live as long as the groups. */
void scene_groups(struct scene *s, struct param_group *groups);
/* Adds the faults between keys (max > min, L > 0, ...), then fills in what follows from several
 * keys. Call on all ranks alike. */
void scene_check(struct scene *s, const struct params *p, struct faults *f);

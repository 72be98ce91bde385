/* scene.h - the groups of a case that every program reads: what is computed, not how.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_SCENE_H
#define COMMON_SCENE_H

#include <stdbool.h>

#include "../params/params.h"
#include "scene_body.h"
#include "scene_surface.h"

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
enum scene_side {
    SIDE_NONE,
    SIDE_X_MIN,
    SIDE_X_MAX,
    SIDE_Y_MIN,
    SIDE_Y_MAX,
    SIDE_Z_MIN,
    SIDE_Z_MAX
};
/* Wave and beach are slip walls behind zones: scene_waves_resolve makes them so. Falls is none that
 * a case names: an outflow beyond which nothing stands (openings_resolve), so that the region just
 * ends there, and what leaves is meant to. */
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
enum wall_zone { ZONE_NONE, ZONE_BEACH, ZONE_WAVE };
enum wall_profile { PROFILE_UNIFORM, PROFILE_PARABOLIC };
enum coupling_in_time { IN_TIME_TRIAL, IN_TIME_LINEAR };
enum shape_form { SHAPE_BOX, SHAPE_POLYGON, SHAPE_DISC, SHAPE_BELOW, SHAPE_MESH };
enum fluid_side { FLUID_AUTO, FLUID_INSIDE, FLUID_OUTSIDE, FLUID_SHEET };
enum accept_measure { ACCEPT_RMS, ACCEPT_PEAK, ACCEPT_IMPULSE, ACCEPT_ARRIVAL };
enum probe_kind { PROBE_PRESSURE, PROBE_LEVEL, PROBE_SHORE, PROBE_DISCHARGE, PROBE_VELOCITY };
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

struct scene {
    struct scene_time {
        double end; /* s */
    } time;
    struct scene_fluid {
        double rho;        /* kg/m^3 */
        double nu;         /* m^2/s; 0: inviscid, nothing viscous is computed */
        double gravity[3]; /* m/s^2 */
        double central;    /* 1/s: W of the acceleration -W^2 x towards the origin */
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
    /* Sides of the domain, polylines with the fluid on their left, and meshes. Sides without a wall
     * that are not periodic: open (sph), or the exact solution (fv). */
    struct scene_wall {
        int side; /* enum scene_side; SIDE_NONE: points or a mesh */
        struct param_points points;
        struct scene_surface surface; /* 3D: triangles of a file */
        int fluid_side;               /* enum fluid_side: of that */
        bool flip, thin;
        bool closed;                /* the last point is joined with the first */
        bool turned;                /* by scene_orient */
        int kind;                   /* enum wall_kind */
        double friction;            /* -: c_f of a slip wall's quadratic bed friction */
        double velocity[3];         /* m/s: of the wall along itself, or of the inflow */
        int profile;                /* of an inflow */
        double pressure;            /* Pa: at an outflow */
        double beach, beach_period; /* m, s: length and period of its zone; 0: none */
        int zone;                   /* enum wall_zone, by scene_waves_resolve */
        bool carried;               /* fv: velocity of a convective outflow, instead of p given */
        double level;               /* m: of the water in an opening, if has_level */
        double discharge;           /* m^dim/s: in through an inflow, out through an outflow */
        char level_file[PARAM_TEXT_SIZE], discharge_file[PARAM_TEXT_SIZE]; /* both over time */
        bool has_level, has_discharge;                 /* by wall_histories_read, as the next */
        const struct motion_file *levels, *discharges; /* of these files; NULL: constant */
        bool assumed; /* the case has no such wall: fv closes the air */
        /* By openings_resolve, of an outflow under a free surface that has neither: m: of the water
         * that stands in it at the start, NAN: not known; falls: none does, so water falls out. */
        double stands;
        bool falls, lower; /* lower: openings_are_lower */
    } walls[WALLS_MAX];
    int nwalls;
    struct scene_body bodies[BODIES_MAX]; /* scene_body.h */
    int nbodies;
    /* Where the fluid is at the start; none: everywhere. */
    struct scene_shape {
        int form; /* enum shape_form */
        double box[2][3];
        struct param_points points;
        struct scene_surface surface;
        double centre[3], radius; /* m */
        double level;             /* m: below it, against gravity */
        bool hole;                /* takes fluid of earlier shapes away */
        double velocity[3];       /* m/s: added to the field's */
    } shapes[SHAPES_MAX];
    int nshapes;
    struct scene_probe {
        char name[PARAM_TEXT_SIZE];
        int kind;      /* enum probe_kind */
        double at[3];  /* m */
        double to[3];  /* m: other end of the line of a discharge, 3D: corner of its rectangle */
        double radius; /* m: pressure: of what it reads the mean of; 0: R of the particles */
        char body[PARAM_TEXT_SIZE]; /* with which it moves; "": none */
    } probes[PROBES_MAX];
    int nprobes;
    struct scene_gauges { /* level gauges that together tell waves apart */
        char name[PARAM_TEXT_SIZE], probes[PARAM_TEXT_SIZE];
        double from, period; /* s */
    } gauges[GAUGES_MAX];
    int ngauges;
    /* Waves that sides of kind wave make; scene_waves.h. */
    struct scene_waves {
        int kind;              /* enum wave_kind */
        double height;         /* m */
        double length, period; /* m, s */
        double depth;          /* m; 0: from the level to the domain's floor */
        double direction;      /* degrees about the vertical */
        double at[3];          /* m, s: of a crest; the third is not used */
        double start;          /* periods of the soft start */
        double zone;           /* m; 0: by the waves */
        double peak, repeat;   /* -, s */
        double spread;         /* -: s of cos^2s(b/2); 0: long crests */
        int order, seed;
        int evolve;                 /* enum wave_evolve */
        char file[PARAM_TEXT_SIZE]; /* of kind file, beside the case */
        char path[512];             /* to it, by scene_wave_file_read */
        double made[2]; /* m, m/s: highest crest, fastest water, by scene_waves_resolve */
    } waves;
    struct scene_coupling {
        int steps;         /* SPH steps in a coupling step; 0: automatic */
        double transition; /* m; 0: 1.25 R */
        double buffer;     /* m; 0: 1.25 R */
        double overlap;    /* m; 0: 1.25 R: of the free zone, outside the forced cells */
        int memory;        /* coupling steps over which FV's pressure is smoothed; 0: automatic */
        bool keep_mass;    /* what SPH's part gained goes out by the openings; without a surface */
        int mapping;       /* 0 shepard, 1 mls: particles to forced cells */
        int interpolation; /* 0 linear, 1 cubic: patch to particles */
        int in_time;       /* enum coupling_in_time */
        double deadline;   /* s to meet the other programs */
    } coupling;
    struct scene_output {
        double every;                 /* s between snapshots; 0: first and last only */
        bool snapshots;               /* write HDF5 at all */
        char fields[PARAM_TEXT_SIZE]; /* "velocity pressure ..." */
        int series; /* steps between rows of series.csv; run_main makes 0 the program's wish */
        double checkpoint;      /* s of simulated time between restart files; 0: only at a stop */
        double checkpoint_wall; /* s of wall time between restart files; 0: none */
    } output;
    int naccept;
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
    bool has_sph, has_fv;        /* groups of the solvers: both make a coupled job */
    struct scene_meshes *meshes; /* what the files of surfaces hold; scene_mesh.h; NULL: none */
};

#define LEVEL_TOP 1e30

/* Of the sides from SIDE_X_MIN on, as the case names them. */
extern const char *const scene_side_names[6];
/* The wall on a side of the domain; NULL: none. */
const struct scene_wall *scene_wall_of(const struct scene *s, enum scene_side side);

/* Whether a wall is an opening, with something outside. */
static inline bool scene_wall_opens(const struct scene_wall *w)
{
    return w->kind >= WALL_INFLOW && w->kind != WALL_FALLS;
}

/* Whether the field is a wave under a surface of its own. */
bool scene_has_wave(const struct scene *s);
/* One of permanent form: steady.h. */
bool scene_has_steady_wave(const struct scene *s);
/* m: of a solitary wave that of the one as steep, 2 pi/K of its profile sech^2 Kx. */
double scene_wave_length(const struct scene *s);
/* Whether the water ends somewhere without a wall. */
bool scene_has_surface(const struct scene *s);

/* The table of the groups above, with s as target: fills groups[SCENE_GROUPS]. */
void scene_groups(struct scene *s, struct param_group *groups);
/* Faults between keys (max > min, L > 0, ...); then fills in what follows from several keys. */
void scene_check(struct scene *s, const struct params *p, struct faults *f);

#endif

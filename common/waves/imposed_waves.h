/* imposed_waves.h - the waves that zones of a tank make: the velocity and the surface at any place
 * and time, with the same bits whoever asks and in whatever order. Regular waves: steady.h, with no
 * net transport (closed tank) or with water that is on average at rest below the troughs. Sea and
 * focused group: sums of linear waves; with order 2 also the waves bound to their pairs
 * (second_order.h). Above the still level velocities are those at it to first order, and are
 * continued by their slope there to second order. Or both evolve nonlinearly (wave_field.h). On a
 * uniform current they are those of still water in its frame: at rest omega = sqrt(g k tanh kh)
 * + k current. x is along the direction of travel, y across it, z up from the still level.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_IMPOSED_WAVES_H
#define COMMON_IMPOSED_WAVES_H

#include <stdbool.h>
#include <stddef.h>

#include "steady.h"
#include "wave_table.h"

/* What waves are imposed: regular ones of permanent form, a sea of a spectrum, a group that focuses
 * at a place and time, or those of a file (swd.h). */
enum wave_kind { WAVE_REGULAR, WAVE_SEA, WAVE_FOCUSED, WAVE_FILE };
/* Whether a sea or a group evolves nonlinearly: not at all (a sum of waves), by the potential in
 * the whole layer of water (layer.h), or by orders in steepness (hos.h). */
enum wave_evolve { EVOLVE_NO, EVOLVE_FULL, EVOLVE_HOS };
/* Tables in time between which velocities are blended by a cubic. */
enum { WAVE_FRAMES = 4 };

/* What the case asks for. */
struct wave_spec {
    int kind;              /* enum wave_kind */
    double height;         /* m: crest to trough; sea: significant; focused: of the linear crest */
    double length, period; /* m, s: one of them, the other 0; sea, focused: of the peak */
    double depth, g, rho;  /* m, m/s^2, kg/m^3 */
    double at[2];          /* m, s: of a crest (regular), of the focus, of a file's beginning */
    char file[512];        /* path of a file of waves */
    double start;          /* periods over which the waves grow from nothing; 0: none */
    double current;        /* m/s: of the water under them, along their direction */
    bool closed;           /* they add no net transport to it; else it is the mean below troughs */
    double peak;           /* -: JONSWAP's gamma */
    int seed;              /* of the phases of a sea */
    double repeat;         /* s: after which a sea repeats itself */
    int order;             /* 2: sea, focused: with bound waves */
    int evolve;            /* enum wave_evolve: sea, focused */
    double spread;         /* -: s of a sea's directions, cos^2s(b/2); 0: all one */
    double window[2][2];   /* m: smallest and largest x, y that will be asked for */
    /* The zone that the velocities are for and whose reflection they correct (zone_gain.h): its
     * length, m, the rate at its side, 1/s, and the side's inner normal along and across the
     * direction of travel. Length 0: no zone, velocities are those of the waves. */
    double zone, rate, normal[2];
    bool open; /* the flux of the waves goes through that side, uniform over the water */
};

/* A linear wave: eta = a cos(k (x cos b + y sin b) - w t + phase). */
struct wave_component {
    double a, w, k, phase; /* m, 1/s, 1/m, - */
    double way[2];         /* cosine, sine of its direction b, from that of the waves */
};

/* Waves made from a spec, and the table of the time that waves_at set. */
struct waves {
    struct wave_spec of;             /* a copy of what waves_create was given */
    double length, period, celerity; /* m, s, m/s: of the peak */
    double crest, trough, speed;     /* m, m, m/s: highest, lowest, fastest; of seas expected */
    double limit;                    /* m: height of the highest wave of that length and depth */
    double shortest, longest;        /* m: lengths of what carries energy */
    struct steady steady;            /* regular: the wave */
    /* m/s: uniform current so that there is no net transport; regular: of the frame. */
    double current;
    double transport;   /* m^2/s: that of the waves on water that is still in the mean */
    double gain, ahead; /* factor of a regular wave's velocities, m by which they are ahead */
    struct wave_component *components;
    int ncomponents;
    struct second_order *second; /* NULL: first order, or evolving */
    struct wave_field *field;    /* NULL: a sum */
    bool shares;                 /* the field is another's */
    double _Complex *filter;     /* of the field's velocities: what makes up for the zone */
    double *profile;          /* [ncomponents][2][WAVE_NODES]: velocities over a w, along and up */
    double _Complex *turning; /* [2][ncomponents]: a e^(i phase) at a column, turn to the next */
    /* Regular: one table that travels. Else a blend of four frames dt apart. */
    struct wave_table table, frames[WAVE_FRAMES];
    long frame[WAVE_FRAMES]; /* number of the frame that each holds */
    struct wave_table rise;  /* of sums: integral of dw/dt from each node up (wave_pressure.h); n =
                              * 0:  nobody asks for the pressure */
    double dt, now;          /* s */
    double grown;            /* -: share of the waves that are there now */
};

/* true if there is no such wave: *key (static) is the key at fault and text[size] the rest of the
 * message "waves.KEY: TEXT". */
bool waves_refuse(const struct wave_spec *of, const char **key, char *text, size_t size);
/* Period of the peak, s, as an observer at rest sees it; by linear theory from the length where
 * the case gives that. */
double waves_period(const struct wave_spec *of);
/* Length of the peak, m, or of a regular wave, by linear theory. */
double waves_length(const struct wave_spec *of);
/* Waves of a spec that waves_refuse accepts; owned by the caller (FREE). Local to a rank. */
struct waves *waves_create(const struct wave_spec *of);
/* Lets w use the evolving field of `owner', which makes the same waves for another zone and
 * outlives w. */
void waves_share(struct waves *w, const struct waves *owner);
/* Prepares w for the time t, s; before waves_eta and waves_velocity. */
void waves_at(struct waves *w, double t);
/* Level over the still one at x, y, m. */
double waves_eta(const struct waves *w, double x, double y);
/* Flux of volume along the waves through the water at x, m^2/s, as a sum over heights. */
double waves_flux(const struct waves *w, double x);
/* Velocity at (x, y), z: along, up, across, m/s. */
void waves_velocity(const struct waves *w, double x, double y, double z, double u[3]);
/* The same, to rounding, at n heights z above or below one place; several times as fast for tens of
 * them. */
void waves_velocities(const struct waves *w, double x, double y, int n, const double *z,
                      double (*u)[3]);
/* Before waves_at, for waves_pressure of sums along one direction: its table. */
void waves_need_pressure(struct waves *w);
/* Pressure over the density, m^2/s^2, at (x, y), z, where waves_velocity gives u; 0 on the surface.
 * While the waves grow from rest, to first order in their height. */
double waves_pressure(const struct waves *w, double x, double y, double z, const double u[3]);
/* Height from trough to crest of the highest wave of that length over that depth, m (Fenton
 * 1990). */
double waves_limit(double depth, double length);
/* Wave number, 1/m, of linear waves of the angular frequency omega, rad/s. */
double waves_number(double omega, double g, double depth);
/* Wave number, 1/m, of linear waves whose angular frequency at rest is omega, rad/s, on water that
 * moves along with them at `current' m/s (against them: < 0). NAN: the current holds them, since
 * their energy moves slower over the water than the water comes. */
double waves_number_on(double omega, double current, double g, double depth);
/* Velocity of the energy of linear waves over the water, m/s. */
double waves_group_velocity(double k, double g, double depth);
/* Angular frequency, rad/s, of linear waves of the wave number k, 1/m, in the water's frame. */
double waves_frequency(double k, double g, double depth);
/* Amplitude of a regular wave or of a group's focus, m; of a sea that of its highest waves. */
double waves_amplitude(const struct wave_spec *of);

#endif

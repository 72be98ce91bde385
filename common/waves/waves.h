/* waves.h - waves that zones of a tank make: the velocities and the surface that they are to have
 * at any place and time, the same bits whoever asks when. Regular: steady.h, with no net transport
 * (closed tank) or none of its own below the troughs. Sea and focused group: sums of linear waves
 * with, of second order, what their pairs bind (second_order.h); velocities go on above the still
 * level by their slope there, of first order they are as on it. Or both evolve nonlinearly
 * (wave_field.h). x along the direction of travel, y
 * across it, z up from the still level. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_WAVES_H
#define COMMON_WAVES_H

#include <complex.h>
#include <stdbool.h>
#include <stddef.h>

#include "steady.h"
#include "wave_table.h"

enum wave_kind { WAVE_REGULAR, WAVE_SEA, WAVE_FOCUSED, WAVE_FILE };
/* By the layer, or by orders in steepness. */
enum wave_evolve { EVOLVE_NO, EVOLVE_FULL, EVOLVE_HOS };
enum { WAVE_FRAMES = 4 };

struct wave_spec {
    int kind;              /* enum wave_kind */
    double height;         /* m: crest to trough; sea: significant; focused: of the linear crest */
    double length, period; /* m, s: one of them, the other 0; sea, focused: of the peak */
    double depth, g, rho;  /* m, m/s^2, kg/m^3 */
    double at[2];          /* m, s: of a crest (regular), of the focus, of a file's beginning */
    char file[512];        /* of its path */
    double start;          /* periods over which the waves grow from nothing; 0: none */
    bool closed;           /* no net transport */
    double peak;           /* -: JONSWAP's gamma */
    int seed;              /* of the phases of a sea */
    double repeat;         /* s: after which a sea repeats itself */
    int order;             /* 2: sea, focused: with bound waves */
    int evolve;            /* enum wave_evolve: sea, focused */
    double spread;         /* -: s of a sea's directions, cos^2s(b/2); 0: all one */
    double window[2][2];   /* m: least and largest x, y that will be asked for */
    /* Of the zone that velocities are for, whose shares they make up for (zone_gain.h): m, 1/s at
     * its side, the side's inner normal along and across the direction. 0 m: none, velocities are
     * those of the waves. */
    double zone, rate, normal[2];
};

struct wave_component {
    double a, w, k, phase; /* m, 1/s, 1/m, - */
    double way[2];         /* cosine, sine of its direction b, from that of the waves:
                            * eta = a cos(k (x cos b + y sin b) - w t + phase) */
};

struct waves {
    struct wave_spec of;
    double length, period, celerity; /* m, s, m/s: of the peak */
    double crest, trough, speed;     /* m, m, m/s: highest, lowest, fastest; of seas expected */
    double limit;                    /* m: height of the highest wave of that length and depth */
    double shortest, longest;        /* m: lengths of what carries energy */
    struct steady steady;
    double current;     /* m/s: so that there is no net transport; regular: of the frame */
    double gain, ahead; /* factor of a regular wave's velocities, m by which they are ahead */
    struct wave_component *components;
    int ncomponents;
    struct second_order *second; /* NULL: first order, or evolving */
    struct wave_field *field;    /* NULL: a sum */
    bool shares;                 /* the field is another's */
    double complex *filter;      /* of the field's velocities: what makes up for the zone */
    double *profile;         /* [ncomponents][2][WAVE_NODES]: velocities over a w, along and up */
    double complex *turning; /* [2][ncomponents] */
    /* Regular: one table that travels. Else a blend of four frames dt apart. */
    struct wave_table table, frames[WAVE_FRAMES];
    long frame[WAVE_FRAMES]; /* which each holds */
    double dt, now;          /* s */
};

/* Why there is no such wave, as text for a message "waves.KEY: TEXT"; false: there is one. key: the
 * key at fault. */
bool waves_refuse(const struct wave_spec *of, const char **key, char *text, size_t size);
/* s: of the peak, by linear theory where the length is given. */
double waves_period(const struct wave_spec *of);
/* m: of the peak, or of a regular wave by linear theory. */
double waves_length(const struct wave_spec *of);
/* Of a wave that is not refused; owned by the caller. */
struct waves *waves_create(const struct wave_spec *of);
void waves_free(struct waves **w);
/* Evolves them with `owner', the same waves of another zone, which outlives them. */
void waves_share(struct waves *w, const struct waves *owner);
/* Makes ready for the time t, s, before the functions below. */
void waves_at(struct waves *w, double t);
/* m at x, y. */
double waves_eta(const struct waves *w, double x, double y);
/* m/s at (x, y), z: along, up, across. */
void waves_velocity(const struct waves *w, double x, double y, double z, double u[3]);
/* m: height from trough to crest of the highest wave of that length (Fenton 1990). */
double waves_limit(double depth, double length);
/* 1/m: of linear waves of the angular frequency omega. */
double waves_number(double omega, double g, double depth);
/* 1/s: the angular frequency of linear waves of the number k. */
double waves_frequency(double k, double g, double depth);
/* m: amplitude of a regular wave, of a group's focus; of a sea that of its highest waves. */
double waves_amplitude(const struct wave_spec *of);

#endif

/* body_drive.h - evaluates the prescribed motion of a rigid body: rows of files, harmonic terms and
 * polynomials, which add up. Velocities are the exact derivatives of the displacements. Local to a
 * rank.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "motion_files.h"
#include "scene_body.h"

/* Displacement and velocity of a body relative to its start, in the axes of space. */
struct body_motion {
    double x[3], u[3], du[3];   /* m, m/s, m/s^2: displacement of the centre */
    double r[3];                /* rad: rotation vector */
    double Q[3][3];             /* rotation matrix of r */
    double omega[3], domega[3]; /* rad/s, rad/s^2 */
    double angle, spin, dspin;  /* rad, rad/s, rad/s^2 about z, as 2D needs them */
};

/* A term ready for evaluation; `is' and rows are borrowed. */
struct body_term {
    const struct scene_motion *is; /* the term as the case has it */
    int n;              /* rows of its file; -1: no such file, 0: no file or faulty rows */
    const double *rows; /* [n][columns]: t and displacements; the file's */
    double step;        /* s: a step that resolves the file, if it has two rows or more */
};

/* What a controller (wave_absorber.h) adds to one degree of freedom: d + v (t - at) + a (t -
 * at)^2/2. */
struct body_steer {
    int axis;       /* enum body_axis */
    double at;      /* s: of d and v */
    double d, v, a; /* m or rad, and its rates */
};

/* What another program says of the coupling step under way: of degree of freedom a, the sum over k
 * of c[a][k] (t - at)^k. They are those of enum body_axis, or, of a body that bends, the
 * displacements along x and y of each point of its outline. */
struct body_course {
    double at;     /* s */
    int n;         /* of degrees of freedom */
    double c[][4]; /* m/s^k or rad/s^k */
};

/* Adds its value at t, s, and the first and second derivatives. */
static inline void body_course_add(const struct body_course *c, int a, double t, double *d,
                                   double *dd, double *ddd)
{
    const double *p = c->c[a], later = t - c->at;
    *d += p[0] + later * (p[1] + later * (p[2] + later * p[3]));
    *dd += p[1] + later * (2.0 * p[2] + later * 3.0 * p[3]);
    *ddd += 2.0 * p[2] + later * 6.0 * p[3];
}

/* Largest speeds, m/s, of a prescribed motion: of a point of the body, and of its centre along each
 * axis. */
struct body_speeds {
    double any, along[3];
};

/* All terms of a body. Plain data, nothing to free. */
struct body_drive {
    int dim, nterms, columns; /* columns of files: 4 in 2D, 7 in 3D */
    struct body_term term[MOTIONS_MAX];
    double constant[BODY_AXES]; /* m/s, rad/s: constant velocity of the driven degrees of freedom */
    const struct body_steer *steer;   /* borrowed; NULL: none */
    const struct body_course *course; /* the same */
};

/* Sets *v from the terms alone; terms and files are borrowed for as long as *v is used. */
void body_drive_terms(struct body_drive *v, const struct scene_motions *is, int dim,
                      struct motion_files *files);
/* Sets *v from a body: its terms, and its constant velocity along the degrees of freedom that
 * forces do not move (all of a body that is not free). */
void body_drive_create(struct body_drive *v, const struct scene_body *is, int dim,
                       struct motion_files *files);
/* Whether a term is at fault (no file, an axis that 2D lacks, missing numbers): text[size] says
 * what. */
bool body_term_fault(const struct body_drive *v, int term, struct motion_files *files, char *text,
                     size_t size);
/* Displacements d along x, y, z, m, and components of the rotation vector, rad, with their first
 * and second derivatives dd and ddd, at time t, s. */
void body_drive_at(const struct body_drive *v, double t, double d[BODY_AXES], double dd[BODY_AXES],
                   double ddd[BODY_AXES]);
/* The same as a motion with rotation matrix and angular velocity. In 3D domega is by central
 * differences, exact enough for averaged forces, the only ones that ask for it. */
void body_drive_motion(const struct body_drive *v, double t, struct body_motion *m);
/* Longest step from t that resolves the motion, s: a fraction of each period, of the duration of a
 * polynomial or of a ramp that is under way, and 0.1 rad of turn. INFINITY: nothing moves, or moves
 * uniformly without turning. */
double body_drive_step(const struct body_drive *v, double t);
/* The next time after t, s, at which a term starts, ends or reaches its full size; INFINITY:
 * none. */
double body_drive_event(const struct body_drive *v, double t);
/* The i-th of n + 1 times, s, from 0, the only one if n is 0, to `end' at which a motion is looked
 * at: in order, but not even, for an even row shows a motion whose period is a part of it in one
 * phase alone. */
double body_drive_instant(int i, int n, double end);
/* Largest speeds until the time `end', s, of points at the distance `reach', m, from the centre;
 * found by sampling. */
struct body_speeds body_drive_speeds(const struct body_drive *v, double reach, double end);
/* The first of them. */
double body_drive_speed(const struct body_drive *v, double reach, double end);
/* Largest acceleration, m/s^2, of such a point by harmonic terms and files that oscillate. A jump
 * of the velocity, as polynomials and files may have, makes sound, rho c u, whatever c is. */
double body_drive_acceleration(const struct body_drive *v, double reach);
/* 1/s: frequency of the quickest of these; 0: none. */
double body_drive_rate(const struct body_drive *v);

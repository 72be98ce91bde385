/* body_drive.h - prescribed motion of rigid bodies: files, harmonic terms, polynomials; they add
 * up. SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_BODY_DRIVE_H
#define COMMON_BODY_DRIVE_H

#include <stdbool.h>
#include <stddef.h>

#include "motion_files.h"
#include "scene_body.h"

/* Place and velocity of a body, relative to its start, in space axes. */
struct body_motion {
    double x[3], u[3], du[3];   /* m, m/s, m/s^2: displacement of the centre */
    double r[3];                /* rad: rotation vector */
    double Q[3][3];             /* of its rotation */
    double omega[3], domega[3]; /* rad/s, rad/s^2 */
    double angle, spin, dspin;  /* about z, as 2D has it */
};

struct body_term {
    const struct scene_motion *is;
    int n;              /* rows of its file */
    const double *rows; /* [n][columns]: t and displacements; the file's */
    double step;        /* s: that resolves them; of two rows or more */
};

/* What a controller adds to one degree: d + v (t - at) + a (t - at)^2/2. */
struct body_steer {
    int axis;       /* enum body_axis */
    double at;      /* s: of d and v */
    double d, v, a; /* m or rad, and its rates */
};

struct body_drive {
    int dim, nterms, columns; /* of files: 4 or 7 */
    struct body_term term[MOTIONS_MAX];
    double constant[BODY_AXES];     /* m/s, rad/s */
    const struct body_steer *steer; /* borrowed; NULL: none */
};

/* Of the terms alone; they are borrowed, and so are the rows of their files. */
void body_drive_terms(struct body_drive *v, const struct scene_motions *is, int dim,
                      struct motion_files *files);
/* Of a body; degrees that forces move are left out. */
void body_drive_create(struct body_drive *v, const struct scene_body *is, int dim,
                       struct motion_files *files);
/* What is wrong with a term: its file, its axis, numbers that are missing, into text; false:
 * nothing is. */
bool body_term_fault(const struct body_drive *v, int term, const struct motion_files *files,
                     char *text, size_t size);
/* Displacements x, y, z and components of the rotation vector, their rates and second rates. */
void body_drive_at(const struct body_drive *v, double t, double d[BODY_AXES], double dd[BODY_AXES],
                   double ddd[BODY_AXES]);
void body_drive_motion(const struct body_drive *v, double t, struct body_motion *m);
/* Longest step from t that resolves the motion, s: a share of each period, of a polynomial's time
 * and of the ramp while they last, of a turn. INFINITY: nothing moves, or evenly without turning.
 */
double body_drive_step(const struct body_drive *v, double t);
/* Next time after t at which a term starts, ends or has its full size, s; INFINITY: none. */
double body_drive_event(const struct body_drive *v, double t);
/* Largest speed until `end' of a point as far from the centre as `reach', m/s. */
double body_drive_speed(const struct body_drive *v, double reach, double end);

#endif

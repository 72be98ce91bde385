/* fv_course.h - what a partner is told of FV's fields: velocity and pressure of the cells, and how
 * they go on in time. FV tries the next coupling step with imposed cells that it extrapolates,
 * samples it, and restores its state; a partner then interpolates where it would extrapolate. Where
 * the loop of the two has too much gain, the pressure of past coupling steps is smoothed and
 * extrapolated instead. Without trials, for comparison, all fields are extrapolated on straight
 * lines. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_COURSE_H
#define FV_COURSE_H

#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../time/fv_time.h"
#include "patch.h"

enum {
    COURSE_LEVELS = 3, /* ends of coupling steps that are remembered */
    COURSE_TERMS = 4   /* of velocity in time */
};

struct course {
    struct patch *patch;      /* where it is told; borrowed */
    int64_t n;                /* local cells of that */
    int dim, memory;          /* coupling steps over which the pressure is smoothed; 1: none */
    int width;                /* values of a cell */
    double *q[COURSE_LEVELS]; /* [n][width] velocity, pressure, phi with a surface; newest first */
    double *tried;            /* the same at the end of the next coupling step */
    double t[COURSE_LEVELS];  /* s: their times */
    double t_tried;           /* s; before t[0]: not known */
    int levels;               /* of them known */
    double *rate;             /* [n] Pa/s: trend of the smoothed pressure; NULL: not smoothed */
    double *scatter;          /* [n] Pa: about its trend; NULL: no surface, no impacts */
    double *term[COURSE_TERMS]; /* [n][dim] of velocity; then of what was filled in last */
    bool linear;                /* no trial: extrapolated by the slope at the newest [6.9-6.10] */
    bool failed;                /* a trial has */
    struct kept *kept;
};

struct course *course_create(const struct fv *s, struct patch *p, int memory);
/* At the start: the state now, and two levels before it of an exact solution, `before' s apart. */
void course_start(struct fv *s, struct course *c, double before);
/* The state now, as a new level. */
void course_take(struct fv *s, struct course *c);
/* Tries to reach t1 with the forcing as it stands; the state is as before afterwards. */
void course_try(struct fv *s, struct course *c, double t1);
/* Fills c->term with what a partner shall get; returns the number of terms. */
int course_velocity(struct course *c);
int course_pressure(struct course *c);
int course_surface(struct course *c); /* phi */
/* Restart files, both ways. Collective. false: the file has no course of this patch. */
bool course_restart(const struct fv *s, struct course *c, struct h5 *f);

#endif

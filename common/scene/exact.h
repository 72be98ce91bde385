/* exact.h - exact solutions that start a run and measure its error.
 * All are sums of plane waves with one decay rate, carried by a uniform velocity V:
 *   psi = sum A_m cos(k_m.(x - V t) + s_m) exp(-nu K^2 t),  u = V + (dpsi/dy, -dpsi/dx),
 *   p/rho = -(|u - V|^2 + K^2 psi^2)/2 less its mean,  |k_m| = K for every m,
 * an exact solution of Navier-Stokes since all modes have the same |k|. Taylor-Green (Chiron 2017,
 * eqs. 6.15-6.18) is the sum of k = 2 pi/L (1,-1) and (1,1); two_modes is (1,2) and (-2,1).
 * In 3D the field is the same for all z. beltrami: the flow of Arnold, Beltrami and Childress (A =
 * B = C = U). Others: Poiseuille and Couette flow from rest between the y sides, the standing wave
 * of wave.h, and three that are exact at t = 0 only: the rotating square patch, the disc under a
 * central force (Monaghan & Rafiee 2013) and the steep wave of stokes.h. Regular and solitary waves
 * (steady.h) are exact without friction.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_EXACT_H
#define COMMON_EXACT_H

#include "../files/series.h"
#include "../waves/steady.h"
#include "../waves/stokes.h"
#include "../waves/wave.h"
#include "scene.h"

struct exact {
    int dim;
    int n;                      /* modes; 0: rest or uniform flow */
    double k[2][2], A[2], s[2]; /* wave vectors 1/m, amplitudes m^2/s, phases */
    double K2;                  /* 1/m^2 */
    double V[3];                /* m/s */
    double nu, rho;
    double U; /* m/s: scale of velocity */
    int field;
    double L, W;           /* m, 1/s: of initial.L, fluid.central */
    double bottom, height; /* m: of a channel along x; of the still layer of a wave */
    double force;          /* m/s^2: along the channel */
    struct wave wave;
    struct stokes stokes;
    struct steady steady;
    bool crossed;    /* the wave varies along z, too: cos cos, k = |(k_x, k_z)| */
    double along[2]; /* k_x/k, k_z/k */
};

/* Whether the scene's field solves the equations at all times, not only at the start. */
bool exact_at_all_times(const struct scene *s);

/* Whether it holds before t = 0, too: not where the flow is started from rest. */
bool exact_has_past(const struct exact *e);

struct exact exact_create(const struct scene *s);
/* Period (s) and rate of decay (1/s, < 0) of a standing wave or of the drop (rate 0: inviscid);
 * false for other fields. */
bool exact_oscillation(const struct exact *e, double *period, double *rate);
/* Height of the surface over x at t = 0, m; of waves of permanent form at any t. */
double exact_surface(const struct exact *e, double x);
double exact_surface_at(const struct exact *e, double x, double t);
/* Enstrophy of the standing wave over the bottom of the box lo..hi (m); m^dim/s^2. */
double exact_enstrophy(const struct exact *e, const double *lo, const double *hi, double t);
/* What swings, per mass: the velocity u at x as part of the wave's inviscid mode, or the drop's
 * second moment; 0 for other fields. */
double exact_signal(const struct exact *e, const double *x, const double *u);
/* u[3], p (mean 0), vorticity dv/dx - du/dy at x[3], t; pointers may be NULL. */
void exact_point(const struct exact *e, const double *x, double t, double *u, double *p, double *w);
/* The same averaged over the cell of centre x and sides h (z matters to beltrami alone). */
void exact_average(const struct exact *e, const double *x, const double *h, double t, double *u,
                   double *p, double *w);
/* u averaged over the face of centre x, normal along axis `a' (0, 1, 2), sides h. */
void exact_face(const struct exact *e, const double *x, const double *h, int a, double t,
                double *u);
/* du/dx: g[a][b] = d u_a / d x_b at a point. */
void exact_gradient(const struct exact *e, const double *x, double t, double g[3][3]);

/* Sums that make a norm: add on each rank, then reduce; parts of a coupled job add up too. */
struct norm {
    double vol;  /* sum w */
    double e1;   /* sum w e */
    double e2;   /* sum w e^2 */
    double r2;   /* sum w ref^2 */
    double emax; /* max |e| */
};
void norm_add(struct norm *n, double w, double e, double ref);
void norm_reduce(struct norm *n, int count, MPI_Comm comm); /* over the ranks of comm */
double norm_relative_l2(const struct norm *n);              /* sqrt(e2/r2) */
double norm_rms(const struct norm *n);                      /* sqrt(e2/vol) */
double norm_mean(const struct norm *n);                     /* e1/vol */
double norm_rms_mean_free(const struct norm *n);            /* sqrt(e2/vol - (e1/vol)^2) */

/* The sums as "norm.NAME.vol", .e1, .e2, .r2, .emax: a coupler adds them up over programs; as .unit
 * what errors are told in, in the field's own unit, unless it is 0. */
void norm_tell(struct summary *to, const char *name, const struct norm *n, double unit);

#endif

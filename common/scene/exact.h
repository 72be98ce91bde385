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
#pragma once

#include "../base/base.h"
#include "../files/files.h"
#include "../waves/waves.h"
#include "scene_groups.h"

/* A solution, made by exact_create. Members that the field does not use are 0. */
struct exact {
    int dim;                    /* 2 or 3 */
    int n;                      /* number of modes; 0: rest, uniform flow or another field */
    double k[2][2], A[2], s[2]; /* wave vectors 1/m, amplitudes m^2/s, phases rad */
    double K2;                  /* 1/m^2: |k|^2, the same of all modes */
    double V[3];                /* m/s: uniform velocity that carries the modes */
    double nu, rho;             /* m^2/s, kg/m^3 */
    double U;                   /* m/s: scale of velocity */
    int field;                  /* enum initial_field */
    double L, W;                /* m, 1/s: of initial.L, fluid.central */
    double bottom, height;      /* m: of a channel along x; of the still layer of a wave */
    double force;               /* m/s^2: body force along the channel */
    struct wave wave;           /* of FIELD_STANDING_WAVE */
    struct stokes stokes;       /* of FIELD_STOKES */
    struct steady steady;       /* of FIELD_REGULAR and FIELD_SOLITARY */
    bool crossed;               /* the wave varies along z, too: cos cos, k = |(k_x, k_z)| */
    double along[2];            /* k_x/k, k_z/k */
};

/* Whether the scene's field solves the equations at all times, not only at the start. */
bool exact_at_all_times(const struct scene *s);
/* Whether that solution is still the scene's at its end: nothing stands in the flow, and a wave of
 * permanent form meets no line, mesh or closed end on its way. Errors are reported where it is. */
bool exact_until_end(const struct scene *s);

/* Whether the solution holds before t = 0, too, which it does not where the flow starts from
 * rest. */
bool exact_has_past(const struct exact *e);

/* The solution of the scene's field. Plain data with nothing to free; of steep waves it solves for
 * their shape, so keep it. */
struct exact exact_create(const struct scene *s);
/* Sets the period, s, and the rate of decay, 1/s, <= 0, of a standing wave or of the drop
 * (inviscid: rate 0); false for other fields. */
bool exact_oscillation(const struct exact *e, double *period, double *rate);
/* Writes "period" and "damping" of its signal's samples, as far as they can be fitted, and as
 * "error.period" and "error.damping" how far they are off these; an undamped field has rate 0, and
 * the error of the damping is then what a period loses. */
void exact_summarise_oscillation(const struct fit *samples, double period, double rate,
                                 struct summary *to);
/* Height of the surface over x, m: at t = 0, and for waves of permanent form at any t. */
double exact_surface(const struct exact *e, double x);
double exact_surface_at(const struct exact *e, double x, double t);
/* Enstrophy, the integral of vorticity^2/2, of the standing wave in the water over the bottom of
 * the box lo..hi, m; m^dim/s^2. */
double exact_enstrophy(const struct exact *e, const double *lo, const double *hi, double t);
/* A signal per unit mass that oscillates with the flow, to be summed over the fluid: the projection
 * of the velocity u at x on the inviscid mode of the wave, or the second moment of the drop; 0 for
 * others. */
double exact_signal(const struct exact *e, const double *x, const double *u);
/* u[3], m/s, p with mean 0, Pa, and vorticity w = dv/dx - du/dy, 1/s, at the point x[3] and time t.
 * Pointers may be NULL. */
void exact_point(const struct exact *e, const double *x, double t, double *u, double *p, double *w);
/* The same averaged over the cell of centre x and sides h (z matters to beltrami alone), which is
 * what finite volumes hold. */
void exact_average(const struct exact *e, const double *x, const double *h, double t, double *u,
                   double *p, double *w);
/* u averaged over the face of centre x, normal to axis `a' (0, 1, 2), with sides h. */
void exact_face(const struct exact *e, const double *x, const double *h, int a, double t,
                double *u);
/* Velocity gradient g[a][b] = d u_a / d x_b at a point, 1/s. */
void exact_gradient(const struct exact *e, const double *x, double t, double g[3][3]);

/* Sums that make an error norm: norm_add on each rank, norm_reduce over the ranks; the parts of a
 * coupled job add up as well. w is a weight (volume), e the error, ref the reference. Zeroed memory
 * is a valid start. */
struct norm {
    double vol;  /* sum w */
    double e1;   /* sum w e */
    double e2;   /* sum w e^2 */
    double r2;   /* sum w ref^2 */
    double emax; /* max |e| */
};
/* Adds one cell or particle of weight w, error e and reference value ref. */
void norm_add(struct norm *n, double w, double e, double ref);
/* Sums `count' norms over comm, emax by maximum; the result is on all ranks. Collective. */
void norm_reduce(struct norm *n, int count, MPI_Comm comm);
/* Error norms of the sums: relative to the reference, the others in the unit of e. 0 without
 * weights. */
double norm_relative_l2(const struct norm *n);   /* sqrt(e2/r2) */
double norm_rms(const struct norm *n);           /* sqrt(e2/vol) */
double norm_mean(const struct norm *n);          /* e1/vol */
double norm_rms_mean_free(const struct norm *n); /* sqrt(e2/vol - (e1/vol)^2) */

/* Writes the sums as "norm.NAME.vol", .e1, .e2, .r2, .emax, which a coupler adds up over programs,
 * and as .unit the unit in which errors are given, in the field's own unit, unless it is 0. */
void norm_tell(struct summary *to, const char *name, const struct norm *n, double unit);

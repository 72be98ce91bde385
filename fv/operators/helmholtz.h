/* helmholtz.h - solves (1 - c L) x = r, L = nu Lap, on any cells: what a kind of cells provides of
 * its operator, and the iterations, over all components at once. Collective over s->comm where sums
 * are formed.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_HELMHOLTZ_H
#define FV_HELMHOLTZ_H

#include "../fv.h"

/* The state of Chebyshev's iteration for eigenvalues between 1 and `most': a step is y = x + beta
 * (x - y) + alpha (r - x + c L x); it reduces the residual by rho, which changes from step to
 * step. */
struct helmholtz_course {
    double c, most, sigma, rho, alpha, beta;
};

/* One problem: the operator and work arrays; borrowed. */
struct helmholtz {
    struct fv *s;
    double c;
    double largest; /* 1/s: a bound of the eigenvalues of -L; 0: unknown */
    /* out = (1 - c L) x, on blocks divided by its diagonal, in cells that are solved for, 0 in
     * others; x is a difference, whose ghosts this sets. */
    void (*apply)(struct fv *s, double c, double *const x[3], double *const out[3]);
    /* Sets x = 0 in cells that are not solved for; NULL: it is 0 there already. */
    void (*zero)(const struct fv *s, double *x);
    /* One step of Chebyshev's iteration; returns the sum over this rank's cells of the squares of
     * the factor of alpha. */
    double (*step)(struct fv *s, const struct helmholtz_course *k, double *const x[3],
                   double *const r[3], double *const y[3]);
    double *const *work[4]; /* scratch of three fields each: CG uses the first and the last,
                               Chebyshev's iteration the first two, BiCGStab all */
};

/* fv.tol_viscous, or its default: 1e-3 (blocks 1e-4, closed sides and partners 1e-5), less on
 * finer cells. What a solve leaves is in the shortest waves: h^2 of the
 * increment at the first two levels keeps velocity and vorticity at the order of the cells
 * (Taylor-Green to 512^2). */
double helmholtz_tolerance(const struct fv *s);
/* The same where neither sides nor imposed cells make a change of their own. */
double helmholtz_plain_tolerance(const struct fv *s);

/* Sum of x y over this rank's cells. */
double helmholtz_dot(const struct fv *s, const double *x, const double *y);
void helmholtz_add(const struct fv *s, double a, const double *x, double *y); /* y += a x */

/* The solvers: delta += A^-1 r until the sum of the squares of the residual is `goal', starting
 * from rr, that of r. r is overwritten. false: not in 200 iterations, or the bounds of the
 * eigenvalues do not hold. */
bool helmholtz_cg(const struct helmholtz *h, double *const delta[3], double *const r[3], double rr,
                  double goal);
bool helmholtz_bicgstab(const struct helmholtz *h, double *const delta[3], double *const r[3],
                        double rr, double goal);
/* Whether r + c L r solves the problem to this tolerance: its error is (c L)^2 r. Twice the largest
 * eigenvalue counts, since the velocity in the air beside a surface is less smooth than that in the
 * water. */
static inline bool helmholtz_is_weak(const struct helmholtz *h, double tol)
{
    const double weak = 2.0 * h->c * h->largest;
    return weak * weak <= tol;
}
/* Whether r alone does: its error is c L r. */
static inline bool helmholtz_is_nothing(const struct helmholtz *h, double tol)
{
    return 2.0 * h->c * h->largest <= tol;
}
/* Does so: delta += r + c L r. */
void helmholtz_once(const struct helmholtz *h, double *const delta[3], double *const r[3]);
/* As helmholtz_cg by Chebyshev's iteration, which needs no sums in between; r is kept. at_once, if
 * not NULL, does n steps from the start r/theta and returns the last one's sum. */
bool helmholtz_chebyshev(const struct helmholtz *h, double *const delta[3], double *const r[3],
                         double rr, double goal,
                         double (*at_once)(struct fv *s, struct helmholtz_course *k, int n,
                                           double *x[3], double *const r[3], double *y[3]));
/* Number of steps that helmholtz_chebyshev will take. */
int helmholtz_steps(const struct helmholtz *h, double rr, double goal);
/* Sets the coefficients of the next step. */
void helmholtz_next(struct helmholtz_course *k);

enum { AT_ONCE = 24 }; /* steps, whose slabs a cache can hold */

#endif

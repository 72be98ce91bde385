/* helmholtz.h - (1 - c L) x = r on any cells: what a kind of cells says of its operator, and the
 * iterations for it, over all components at once. SPDX-License-Identifier: BSD-3-Clause */
#ifndef FV_HELMHOLTZ_H
#define FV_HELMHOLTZ_H

#include "../fv.h"

/* A step of Chebyshev's iteration between 1 and `most': y = x + beta (x - y) + alpha (r - x + c L
 * x); it takes rho off what is left, and rho goes from step to step. */
struct helmholtz_course {
    double c, most, sigma, rho, alpha, beta;
};

struct helmholtz {
    struct fv *s;
    double c;
    double largest; /* 1/s: a bound of the eigenvalues of -L; 0: unknown */
    /* out = (1 - c L) x, on blocks over its diagonal, in cells that are solved for, 0 in others; x
     * is a difference whose ghosts this sets. */
    void (*apply)(struct fv *s, double c, double *const x[3], double *const out[3]);
    /* x = 0 in cells that are not solved for; NULL: they hold it. */
    void (*zero)(const struct fv *s, double *x);
    /* A step; sum over this rank's cells of the squares of what alpha has. */
    double (*step)(struct fv *s, const struct helmholtz_course *k, double *const x[3],
                   double *const r[3], double *const y[3]);
    double *const *work[4]; /* scratch of three fields each: CG uses the first and the last,
                               Chebyshev's iteration the first two, BiCGStab all */
};

/* Default of fv.tol_viscous, or what the case gives. What a solve leaves is in the shortest waves:
 * h^2 of the increment at the first two levels keeps velocity and vorticity at the order of the
 * cells (Taylor-Green to 512^2). */
double helmholtz_tolerance(const struct fv *s);

/* Sums over this rank's cells. */
double helmholtz_dot(const struct fv *s, const double *x, const double *y);
void helmholtz_add(const struct fv *s, double a, const double *x, double *y); /* y += a x */

/* All: delta += A^-1 r until the sum of the squares of what is left is `goal', from rr, that of r.
 * false: not in 200 iterations, or not as the bounds say. */
bool helmholtz_cg(const struct helmholtz *h, double *const delta[3], double *const r[3], double rr,
                  double goal);
bool helmholtz_bicgstab(const struct helmholtz *h, double *const delta[3], double *const r[3],
                        double rr, double goal);
/* Whether r + c L r is the solution to this tolerance: what it leaves is (c L)^2 r. Twice the
 * largest eigenvalue, as the air beside a surface bends more than water does. */
static inline bool helmholtz_is_weak(const struct helmholtz *h, double tol)
{
    const double weak = 2.0 * h->c * h->largest;
    return weak * weak <= tol;
}
void helmholtz_once(const struct helmholtz *h, double *const delta[3], double *const r[3]);
/* r stays. at_once: does n steps from the start r/theta and gives the last one's sum; NULL: none.
 */
bool helmholtz_chebyshev(const struct helmholtz *h, double *const delta[3], double *const r[3],
                         double rr, double goal,
                         double (*at_once)(struct fv *s, struct helmholtz_course *k, int n,
                                           double *x[3], double *const r[3], double *y[3]));
/* How many steps it will take. */
int helmholtz_steps(const struct helmholtz *h, double rr, double goal);
/* The coefficients of the next step. */
void helmholtz_next(struct helmholtz_course *k);

enum { AT_ONCE = 24 }; /* steps, whose slabs a cache can hold */

#endif

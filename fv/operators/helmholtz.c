/* helmholtz.c - see helmholtz.h. Conjugate gradients where the operator is symmetric; Chebyshev's
 * iteration (Saad, Iterative Methods for Sparse Linear Systems, 2003, alg. 12.1), no sums and one
 * pass over the fields a step, where the spectrum is known; else BiCGStab (van der Vorst 1992). The
 * equation (1 - c nu Lap) x = r comes from implicit viscosity, c about dt times a stage's
 * coefficient: its spectrum begins at 1 and ends at 1 + c largest, so that few iterations are
 * needed. All components are solved together. s->totals counts the iterations.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "helmholtz.h"

#include "viscous_solver.h"

/* fv.tol_viscous if given; else `most', falling as 1/n^2 beyond 32 cells a side. */
static double tolerance(const struct fv *s, double most)
{
    const double side = 32.0 / s->viscous->cells_a_side;
    return s->prm.tol_viscous > 0.0 ? s->prm.tol_viscous : fmin(most, 1e-3 * side * side);
}

double helmholtz_tolerance(const struct fv *s)
{
    return tolerance(s, s->forcing ? 1e-5 : s->m ? 1e-4 : 1e-3);
}

double helmholtz_plain_tolerance(const struct fv *s) { return tolerance(s, 1e-3); }

double helmholtz_dot(const struct fv *s, const double *x, const double *y)
{
    double sum = 0.0;
    FLOW_WET (s, c, n)
        sum += lanes_dot_any(x + c, y + c, n);
    return sum;
}

void helmholtz_add(const struct fv *s, double a, const double *restrict x, double *restrict y)
{
    FLOW_WET (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            y[i] += a * x[i];
}

/* y = x + beta y */
static void direct(const struct fv *s, const double *restrict x, double beta, double *restrict y)
{
    FLOW_WET (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            y[i] = x[i] + beta * y[i];
}

/* x.y and x.z over all ranks; z NULL: none. */
static void dots(const struct fv *s, double *const x[3], double *const y[3], double *const *z,
                 double sums[2])
{
    sums[0] = sums[1] = 0.0;
    for (int a = 0; a < s->dim; a++) {
        sums[0] += helmholtz_dot(s, x[a], y[a]);
        sums[1] += z ? helmholtz_dot(s, x[a], z[a]) : 0.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, z ? 2 : 1, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* One product and two reductions an iteration. NaN ends it with false. */
bool helmholtz_cg(const struct helmholtz *h, double *const delta[3], double *const r[3], double rr,
                  double goal)
{
    struct fv *s = h->s;
    double *const *p = h->work[0], *const *Ap = h->work[3], sums[2];
    for (int a = 0; a < s->dim; a++)
        memcpy(p[a], r[a], (size_t)s->size * sizeof(double));
    for (int it = 0; it < 200; it++) {
        if (!(rr > goal) || rr == 0.0)
            return rr == rr;
        h->apply(s, h->c, p, Ap);
        dots(s, p, Ap, NULL, sums);
        const double alpha = rr / sums[0];
        for (int a = 0; a < s->dim; a++) {
            helmholtz_add(s, alpha, p[a], delta[a]);
            helmholtz_add(s, -alpha, Ap[a], r[a]);
        }
        dots(s, r, r, NULL, sums);
        for (int a = 0; a < s->dim; a++)
            direct(s, r[a], sums[0] / rr, p[a]);
        rr = sums[0];
        s->totals.viscous_iterations++;
    }
    return false;
}

/* p, r0, v, t: the paper's. Two products and three reductions an iteration; h->zero keeps what
 * products leave outside of the solved cells from the residual. */
bool helmholtz_bicgstab(const struct helmholtz *h, double *const delta[3], double *const r[3],
                        double rr, double goal)
{
    struct fv *s = h->s;
    double *const *p = h->work[0], *const *r0 = h->work[1], *const *v = h->work[2],
                  *const *t = h->work[3];
    double sums[2], rho = rr;
    for (int a = 0; a < s->dim; a++) {
        memcpy(p[a], r[a], (size_t)s->size * sizeof(double));
        memcpy(r0[a], r[a], (size_t)s->size * sizeof(double));
    }
    for (int it = 0; it < 200; it++) {
        if (!(rr > goal) || rr == 0.0)
            return rr == rr;
        h->apply(s, h->c, p, v);
        dots(s, v, r0, NULL, sums);
        const double alpha = rho / sums[0];
        for (int a = 0; a < s->dim; a++)
            helmholtz_add(s, -alpha, v[a], r[a]);
        h->apply(s, h->c, r, t);
        dots(s, t, r, t, sums);
        const double omega = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
        for (int a = 0; a < s->dim; a++) {
            helmholtz_add(s, alpha, p[a], delta[a]);
            helmholtz_add(s, omega, r[a], delta[a]);
            helmholtz_add(s, -omega, t[a], r[a]);
            if (h->zero)
                h->zero(s, r[a]);
        }
        dots(s, r, r, r0, sums);
        const double beta = sums[1] / rho * alpha / omega;
        for (int a = 0; a < s->dim; a++) {
            helmholtz_add(s, -omega, v[a], p[a]);
            direct(s, r[a], beta, p[a]);
        }
        rr = sums[0];
        rho = sums[1];
        s->totals.viscous_iterations++;
    }
    return false;
}

/* delta += r + c L r = 2 r - A r, one term of Neumann's series more than r itself; see
 * helmholtz_is_weak. */
void helmholtz_once(const struct helmholtz *h, double *const delta[3], double *const r[3])
{
    double *const *Ar = h->work[0];
    for (int a = 0; a < h->s->dim; a++)
        helmholtz_add(h->s, 2.0, r[a], delta[a]); /* before the product fills the air of r */
    h->apply(h->s, h->c, r, Ar);
    for (int a = 0; a < h->s->dim; a++)
        helmholtz_add(h->s, -1.0, Ar[a], delta[a]);
    h->s->totals.viscous_iterations++;
}

/* Chebyshev's iteration for the interval [1, most]: sigma = (most + 1)/(most - 1). */
static struct helmholtz_course course_of(const struct helmholtz *h)
{
    const double most = 1.0 + h->c * h->largest, sigma = (most + 1.0) / (most - 1.0);
    return (struct helmholtz_course){.c = h->c, .most = most, .sigma = sigma, .rho = 1.0 / sigma};
}

void helmholtz_next(struct helmholtz_course *k)
{
    const double next = 1.0 / (2.0 * k->sigma - k->rho);
    k->alpha = 4.0 * next / (k->most - 1.0);
    k->beta = next * k->rho;
    k->rho = next;
}

/* From cosh(n arcosh sigma) >= sqrt(rr/goal). */
int helmholtz_steps(const struct helmholtz *h, double rr, double goal)
{
    return rr > goal ? (int)ceil(acosh(sqrt(rr / goal)) / acosh(course_of(h).sigma)) : 0;
}

/* Exchanges the roles of two sets of fields. */
static void swap(double *a[3], double *b[3])
{
    for (int k = 0; k < 3; k++) {
        double *const t = a[k];
        a[k] = b[k];
        b[k] = t;
    }
}

/* x = f r, y = 0 */
static void start(const struct fv *s, double f, double *const x[3], double *const r[3],
                  double *const y[3])
{
    for (int a = 0; a < s->dim; a++) {
        double *restrict to = x[a];
        const double *restrict from = r[a];
        memset(to, 0, (size_t)s->size * sizeof(double));
        memset(y[a], 0, (size_t)s->size * sizeof(double));
        FLOW_WET (s, c, n)
            for (int64_t i = c; i < c + n; i++)
                to[i] = f * from[i];
    }
}

/* A sum is of the x before its step, which takes rho off what is left. The residual is only summed
 * near the expected end; twice the expected steps without success mean that the bounds do not hold,
 * and the caller takes another method, from the same delta. */
bool helmholtz_chebyshev(const struct helmholtz *h, double *const delta[3], double *const r[3],
                         double rr, double goal,
                         double (*at_once)(struct fv *s, struct helmholtz_course *k, int n,
                                           double *x[3], double *const r[3], double *y[3]))
{
    struct fv *s = h->s;
    struct helmholtz_course k = course_of(h);
    const int wanted = helmholtz_steps(h, rr, goal), most = 2 * wanted + 4;
    double *x[3] = {h->work[0][0], h->work[0][1], h->work[0][2]},
           *y[3] = {h->work[1][0], h->work[1][1], h->work[1][2]}, left = rr, sum = 0.0;
    int done = !at_once ? 0 : wanted - 1 < AT_ONCE ? wanted - 1 : AT_ONCE;
    if (!(rr > 0.0))
        return rr == 0.0;
    if (done > 0) {
        sum = at_once(s, &k, done, x, r, y);
        if (done % 2)
            swap(x, y);
        s->totals.viscous_iterations += done;
    } else
        start(s, 2.0 / (k.most + 1.0), x, r, y);
    for (;;) {
        if (done > 0 && done >= wanted - 1) {
            MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->comm);
            left = sum * k.rho * k.rho;
        }
        if (left <= goal || done >= most)
            break;
        helmholtz_next(&k);
        sum = h->step(s, &k, x, r, y);
        swap(x, y);
        s->totals.viscous_iterations++;
        done++;
    }
    for (int a = 0; a < s->dim && left <= goal; a++)
        helmholtz_add(s, 1.0, x[a], delta[a]);
    return left <= goal;
}

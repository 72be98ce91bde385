/* gcr.c - see gcr.h (Eisenstat, Elman & Schultz, SIAM J. Numer. Anal. 20, 1983, GCR; truncated as
 * ORTHOMIN). A cycle and a product with the matrix an iteration and none beside them, which counts
 * where a solve takes two: GMRES spends a cycle more to make its solution. Directions need no fixed
 * preconditioner. SPDX-License-Identifier: BSD-3-Clause */
#include "gcr.h"

#include "../../common/base/base.h"

void gcr_create(void *owner, struct gcr *g, MPI_Comm comm, int n, void *of,
                void (*apply)(void *of, double *x, double *Ax),
                void (*cycle)(void *of, double *r, double *z))
{
    *g = (struct gcr){.comm = comm, .n = n, .of = of, .apply = apply, .cycle = cycle};
    g->r = NEW_IN(owner, double, n);
}

static void add(int n, double a, const double *restrict x, double *restrict y)
{
    for (int i = 0; i < n; i++)
        y[i] += a * x[i];
}

double gcr_norm(const struct gcr *g, const double *x)
{
    double sum = lanes_dot_any(x, x, g->n);
    return sqrt(ranks_sum(g->comm, sum));
}

/* What images are made orthogonal to: A z of direction j (least residual), or with a symmetric
 * matrix z itself (conjugate gradients' A-orthogonality, `galerkin'). */
static double *test(struct gcr *g, int j) { return g->galerkin ? g->z[j] : g->Az[j]; }

/* Takes what the image of direction k has of the m others' out of it; those from first on in their
 * order, as they are not orthogonal both ways. */
static void make_conjugate(struct gcr *g, int k, int m, int first)
{
    for (int i = 0; i < m; i++) {
        const int j = (first + i) % GCR_KEPT;
        if (j == k || !(g->kept[j] > 0.0))
            continue;
        const double sum = ranks_sum(g->comm, lanes_dot_any(g->Az[k], test(g, j), g->n));
        add(g->n, -sum / g->kept[j], g->z[j], g->z[k]);
        add(g->n, -sum / g->kept[j], g->Az[j], g->Az[k]);
    }
}

/* x along direction k. Returns the norm of the residual; < 0: there is no such direction. */
static double advance(struct gcr *g, int k, double *x)
{
    double sums[2] = {lanes_dot_any(g->Az[k], test(g, k), g->n),
                      lanes_dot_any(test(g, k), g->r, g->n)};
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, g->comm);
    g->kept[k] = sums[0];
    if (!(sums[0] > 0.0))
        return -1.0;
    add(g->n, sums[1] / sums[0], g->z[k], x);
    add(g->n, -sums[1] / sums[0], g->Az[k], g->r);
    return gcr_norm(g, g->r);
}

int gcr_solve(struct gcr *g, const double *b, double *x, double goal, int most, double *left)
{
    g->apply(g->of, x, g->r);
    for (int i = 0; i < g->n; i++)
        g->r[i] = b[i] - g->r[i];
    *left = gcr_norm(g, g->r);
    for (int it = 0; it < most; it++) {
        const int k = it % GCR_KEPT;
        if (!(*left > goal) && (it > 0 || !(*left > 0.0)))
            return it;
        if (!g->z[k]) {
            g->z[k] = NEW_IN(g->r, double, g->n);
            g->Az[k] = NEW_IN(g->r, double, g->n);
        }
        g->cycle(g->of, g->r, g->z[k]);
        g->apply(g->of, g->z[k], g->Az[k]);
        make_conjugate(g, k, it < GCR_KEPT ? it : GCR_KEPT, it < GCR_KEPT ? 0 : k);
        const double now = advance(g, k, x);
        if (now < 0.0)
            return it + 1;
        *left = now;
    }
    return most;
}

/* bench_pairs.c - throughput of the SPH pair passes against the arithmetic limit of the core. Run
 * by make bench, on an idle machine; processor time, best of some repeats.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include "../common/timer.h"
#include "../sph/domain.h"
#include "../sph/neighbours.h"
#include "../sph/scheme.h"
#include "../sph/vec.h"
#include "sph_case.h"

/* Operations of the default scheme (Morris, gamma 7), counted by hand, in 2D and 3D: of an ordered
 * pair in the first pass, of a pair in the second; a root, a division, a minimum count one. */
static const double flops[2][2] = {{49, 193}, {74, 254}};
/* Bytes between cache and core for a pair: the partner's lines, its index, its sums to and fro. */
static const double bytes[2][2] = {{68, 196}, {68, 324}};

/* FMA peak of this core, GFLOP/s: ten independent chains of vectors. */
static double fma_peak(void)
{
    vec a[10];
    const vec b = vec_all(0.999999), c = vec_all(1e-6);
    const long n = 20000000;
    for (int k = 0; k < 10; k++)
        a[k] = vec_all(k);
    const double t = cpu_time();
    for (long i = 0; i < n; i++)
        for (int k = 0; k < 10; k++)
            a[k] = a[k] * b + c;
    const double s = cpu_time() - t;
    double sum = 0.0;
    for (int k = 0; k < 10; k++)
        sum += vec_sum(a[k]);
    return sum > 0.0 ? 1e-9 * (double)n * 10 * LANES * 2 / s : 0.0;
}

static double best_of(int repeats, void (*pass)(struct sph *s), struct sph *s)
{
    double best = INFINITY;
    for (int k = 0; k < repeats; k++) {
        const double t = cpu_time();
        pass(s);
        best = fmin(best, cpu_time() - t);
    }
    return best;
}

static void list(struct sph *s)
{
    s->ready = false;
    integrate_prepare(s);
}

static void bench(int dim, double R_dx, int cells, bool thesis, double peak)
{
    struct sph_case c;
    sph_case_set(&c, dim, cells);
    c.prm.R_dx = R_dx;
    c.prm.noise = 0.2;
    if (thesis) {
        c.prm.scheme = SCHEME_RIEMANN;
        c.prm.limiter = LIMITER_MINMOD;
        c.prm.transport = TRANSPORT_TVO;
        c.prm.low_dissipation = false;
        c.prm.damper = 0.0;
    }
    struct sph *s = sph_case_start(&c, NULL);
    s->skin = 0.05 * s->R;
    list(s);
    integrate_rates(s);
    const double pairs = (double)neighbours_pairs(s), n = s->p.n;
    double listed = 0.0;
    for (int i = 0; i < s->p.n; i++)
        listed += s->list->count[i];
    const double t_list = best_of(7, list, s);
    const double t1 = best_of(7, s->scheme->gradients, s), t2 = best_of(7, s->scheme->rates, s);
    const double stage = best_of(7, integrate_rates, s) + 0.25 * t_list;
    printf("%dD %-7s %4.1f %7.0f %6.1f   %6.1f %6.1f %6.1f   %5.2f %7.0f %5.0f   %6.2f", dim,
           thesis ? "thesis" : "default", R_dx, n, pairs / n, 1e-6 * pairs / t1, 1e-6 * pairs / t2,
           1e-6 * pairs / stage, pairs / listed, 1e9 * t_list / n, 4.0 * listed / n,
           1e-6 * n / stage);
    const double *f = flops[dim - 2], *b = bytes[dim - 2];
    if (!thesis)
        printf("   %3.0f %3.0f   %3.0f %3.0f  %4.1f %4.1f", b[0], b[1], f[0], f[1],
               1e-7 * f[0] * pairs / t1 / peak, 1e-7 * 0.5 * f[1] * pairs / t2 / peak);
    printf("\n");
    sph_free(&c.s);
}

int main(int argc, char **argv)
{
    MPI_Init(&argc, &argv);
    const double peak = fma_peak();
    printf("FMA peak of this core, measured: %.1f GFLOP/s (double, %d lanes)\n", peak, LANES);
    printf("M ordered pairs/s: gradients, rates, whole stage with halo, update and a quarter of "
           "list and sort;\n"
           "bytes, operations, %% of the peak: gradients for an ordered pair, rates for a pair\n");
    printf("   scheme  R/dx particles pairs    grad  rates  stage     hit list ns     B  M "
           "stages/s  bytes   "
           "operations  %% of peak\n");
    for (int thesis = 0; thesis <= 1; thesis++) {
        bench(2, 4.0, 100, thesis, peak);
        bench(2, 4.0, 316, thesis, peak);
        bench(3, 2.5, 22, thesis, peak);
        bench(3, 2.5, 58, thesis, peak);
        bench(3, 4.0, 40, thesis, peak);
    }
    MPI_Finalize();
    return 0;
}

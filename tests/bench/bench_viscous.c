/* bench_viscous.c - the implicit viscosity between walls beside two limits: what its passes must
 * compute at the peak of fused multiply-adds, and what a solve must move between memory and core at
 * the speed of a triad over fields of the same size. Run by make bench on an idle machine;
 * processor time, best of some repeats. SPDX-License-Identifier: BSD-3-Clause */
#include "../unit/fv/fv_case.h"
#include "bench.h"

#include "../../fv/operators/operators.h"

enum { REPEATS = 5 };

/* A cell and component: what a step of Chebyshev's iteration computes; doubles that a solve moves
 * at least: the start and its right side, what is left written; the steps, all at once: r in, two
 * fields in and out; the increment, in and out, and the result. */
static const double flops = 20.0, doubles = 3.0 + 5.0 + 3.0;

/* The stage of a cavity at Re 1000 that reaches furthest: c = 37/160 dt, CFL 1.1. */
static void report(int n, double peak)
{
    struct fv_case c;
    char cells[64];
    snprintf(cells, sizeof cells, "fv.cells=(%d,%d)", n, n);
    fv_case_set(&c, MPI_COMM_WORLD,
                (const char *const[]){"initial.field=\"rest\"", "fluid.nu=1e-3",
                                      "domain.periodic=(false,false)", cells, NULL});
    for (int side = SIDE_X_MIN; side <= SIDE_Y_MAX; side++)
        c.run.scene.walls[c.run.scene.nwalls++] =
            (struct scene_wall){.side = (enum scene_side)side, .kind = WALL_NO_SLIP};
    struct fv *s = fv_case_start(&c, NULL);
    const double per = 1e9 / ((double)n * n * 2.0), speed = bench_triad(s);
    double best = INFINITY;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (int a = 0; a < 2; a++)
            FLOW_ROWS (s, at, len)
                for (int64_t i = at; i < at + len; i++) {
                    s->rhs[a][i] = 1e-3 * (double)(i * 2654435761u >> 7 & 1023);
                    s->delta[a][i] = 0.0;
                }
        s->totals.viscous_iterations = 0;
        const double t = cpu_time();
        viscous_solve(s, 37.0 / 160.0 * 1.1 / n, s->delta, s->rhs, 1e-5);
        best = fmin(best, cpu_time() - t);
    }
    const double passes = (double)s->totals.viscous_iterations, ns = best * per,
                 limit = fmax(doubles / speed, passes * flops / peak);
    printf(
        "%4d x %4d: %2.0f passes, %5.1f ns a cell and component (%.2f a pass); %.0f doubles %.1f "
        "ns, %.0f flops %.1f ns: %2.0f %% of the limit\n",
        n, n, passes, ns, ns / passes, doubles, doubles / speed, passes * flops,
        passes * flops / peak, 100.0 * limit / ns);
    fv_free(&c.s);
}

int main(int argc, char **argv)
{
    MPI_Init(&argc, &argv);
    const double peak = bench_peak();
    printf("viscous solve between walls to 1e-5, peak %.1f GFLOP/s\n", peak);
    for (int n = 128; n <= 1024; n *= 2)
        report(n, peak);
    MPI_Finalize();
    return 0;
}

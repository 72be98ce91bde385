/* bench_blocks.c - kernels of the finite volumes on blocks beside two limits: what they must move
 * between memory and core, at the speed of a triad over fields of the same size, and what they must
 * compute, at the peak of fused multiply-adds. Run by make bench on an idle machine; processor
 * time, best of some repeats. SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include "../../fv/operators/mesh_ops.h"
#include "../../fv/time/stages.h"
#include "../unit/fv/mesh_case.h"
#include "bench.h"

enum { N = 256, REPEATS = 8 };

/* By hand, a cell in 2D, by kind of cells (even, upright, askew): doubles that must come from or go
 * to memory once, operations. Fields that a pass makes and reads again at once do not count. */
static const struct kernel {
    const char *name;
    double doubles[3], flops[3];
} kernels[] = {
    {"viscous, a component", {2, 5, 7}, {16, 34, 92}},
    {"convection, all components", {6, 7, 7}, {116, 116, 116}},
    {"gradient", {3, 6, 8}, {14, 34, 62}},
    {"face velocities", {4, 6, 8}, {16, 28, 56}},
};

static void call(struct fv *s, int kernel)
{
    switch (kernel) {
    case 0:
        mesh_viscous(s, s->u[0], s->viscous->work[1][0]);
        break;
    case 1:
        mesh_convection(s, s->stages.N);
        break;
    case 2:
        mesh_gradient(s, s->p, s->stages.step_p);
        break;
    default:
        mesh_face_velocities(s, s->u, s->viscous->work[2]);
    }
}

static double best_time(struct fv *s, int kernel)
{
    double best = INFINITY;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double t = cpu_time();
        for (int n = 0; n < 4; n++)
            call(s, kernel);
        best = fmin(best, (cpu_time() - t) / 4.0);
    }
    return best;
}

/* One solve for the pressure of a rough velocity: what a cell and cycle take. */
static void pressure(struct fv *s)
{
    const int64_t before = s->totals.iterations;
    for (int64_t i = 0; i < s->size; i++)
        s->U[0][i] += 1e-6 * ((double)(i * 2654435761u >> 7 & 1023) - 511.5);
    const double t = cpu_time();
    stage_solve_pressure(s, 2, 1.0, 1e-6);
    printf("  pressure: %.1f ns a cell and cycle, %d cycles to 1e-6 of the step's\n",
           1e9 * (cpu_time() - t) / (double)(s->totals.iterations - before) / (N * N),
           (int)(s->totals.iterations - before));
}

static void report(const char *what, int kind, const char *shape, double peak)
{
    struct mesh_case c;
    char text[512];
    snprintf(text, sizeof text, "{ name = \"a\"; %s cells = (%d, %d); %s }", shape, N, N,
             kind == 1
                 ? "i_min = \"exact\"; i_max = \"exact\"; j_min = \"exact\"; j_max = \"exact\";"
                 : PERIODIC);
    struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, text, NULL);
    const double speed = bench_triad(s), cells = (double)N * N;
    printf("%s cells, %d x %d: triad %.2f Gdouble/s, peak %.1f GFLOP/s\n", what, N, N, speed, peak);
    for (int k = 0; k < (int)(sizeof kernels / sizeof kernels[0]); k++) {
        const struct kernel *e = kernels + k;
        const double ns = 1e9 * best_time(s, k) / cells, memory = e->doubles[kind] / speed,
                     flops = e->flops[kind] / peak, limit = fmax(memory, flops);
        printf("  %-28s %6.2f ns a cell, %2.0f doubles %.2f ns, %3.0f flops %.2f ns: %2.0f %% of "
               "the limit\n",
               e->name, ns, e->doubles[kind], memory, e->flops[kind], flops, 100.0 * limit / ns);
    }
    pressure(s);
    mesh_case_end(&c, &s);
}

int main(int argc, char **argv)
{
    MPI_Init(&argc, &argv);
    const double peak = bench_peak();
    report("even", 0, "", peak);
    report("upright", 1, "mapping = \"stretched\"; stretch = (1.5, 1.5); focus = (0.5, 0.5);",
           peak);
    report("askew", 2, "mapping = \"sheared\"; wave = 0.05;", peak);
    MPI_Finalize();
    return 0;
}

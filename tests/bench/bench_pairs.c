/* bench_pairs.c - throughput of the SPH pair passes against the arithmetic limit of the core, cost
 * of a step by size, memory. Run by make bench, on an idle machine; processor time, best of some
 * repeats. SPDX-License-Identifier: BSD-3-Clause */
#include <malloc.h>
#include <stdio.h>

#include "../../common/base/timer.h"
#include "../../sph/output/sph_output.h"
#include "../../sph/pairs/neighbours.h"
#include "../../sph/pairs/vec.h"
#include "../../sph/time/integrate.h"
#include "../../sph/time/runge_kutta.h"
#include "../unit/sph/sph_case.h"

enum { LEAN, DELTA, DELTA_PLUS, DEFAULT, THESIS, KINDS };

/* Operations counted by hand in 2D and 3D: of an ordered pair in the first pass, of a pair in the
 * second; a root, a division, a minimum count one. Bytes between cache and core: the partner's
 * lines, its index, its sums to and fro. 0: not counted. */
static const struct kind {
    const char *name, *is;
    double flops[2][2], bytes[2][2];
} kinds[KINDS] = {
    {"lean", "standard, no transport, inviscid", {{0, 49}, {0, 57}}, {{0, 132}, {0, 132}}},
    {"delta", "delta, no transport, inviscid", {{26, 57}, {38, 68}}, {{68, 196}, {68, 196}}},
    {"delta+", "delta, tvs, Morris", {{49, 62}, {74, 75}}, {{68, 196}, {68, 196}}},
    {"default", "riemann_ale, koren, tvs, Morris", {{49, 193}, {74, 254}}, {{68, 196}, {68, 324}}},
    {"thesis", "riemann, minmod, tvo, Morris", {{0, 0}, {0, 0}}, {{68, 196}, {68, 324}}},
};

/* FMA peak of this core, GFLOP/s: ten independent chains of vectors. */
static double fma_peak(void)
{
    vec a[10];
    const vec b = vec_all(0.999999), c = vec_all(1e-6);
    const long n = 5000000;
    double best = INFINITY, sum = 0.0;
    for (int k = 0; k < 10; k++)
        a[k] = vec_all(k);
    for (int repeat = 0; repeat < 4; repeat++) {
        const double t = cpu_time();
        for (long i = 0; i < n; i++)
            for (int k = 0; k < 10; k++)
                a[k] = a[k] * b + c;
        best = fmin(best, cpu_time() - t);
    }
    for (int k = 0; k < 10; k++)
        sum += vec_sum(a[k]);
    return sum > 0.0 ? 1e-9 * (double)n * 10 * LANES * 2 / best : 0.0;
}

static double best_of(int repeats, void (*pass)(struct sph *s), struct sph *s)
{
    double best = INFINITY;
    for (int k = 0; k < repeats && pass; k++) {
        const double t = cpu_time();
        pass(s);
        best = fmin(best, cpu_time() - t);
    }
    return pass ? best : 0.0;
}

static void list(struct sph *s)
{
    s->lists.ready = false;
    integrate_prepare(s);
}

static void choose(struct sph_case *c, int kind)
{
    struct sph_params *p = &c->prm;
    p->noise = 0.2;
    p->alpha = 0.01;
    p->delta = 0.05;
    if (kind == LEAN || kind == DELTA) {
        p->transport = TRANSPORT_NONE;
        c->run.scene.fluid.nu = 0.0;
    }
    if (kind == LEAN)
        p->scheme = SCHEME_STANDARD;
    if (kind == DELTA || kind == DELTA_PLUS)
        p->scheme = SCHEME_DELTA;
    if (kind == THESIS) {
        p->scheme = SCHEME_RIEMANN;
        p->limiter = LIMITER_MINMOD;
        p->transport = TRANSPORT_TVO;
        p->low_dissipation = false;
        p->damper = 0.0;
    }
}

static struct sph *start(struct sph_case *c, int dim, double R_dx, int cells, int kind)
{
    sph_case_set(c, dim, cells);
    c->prm.R_dx = R_dx;
    choose(c, kind);
    struct sph *s = sph_case_start(c, NULL);
    s->lists.skin = 0.05 * s->R;
    list(s);
    integrate_rates(s);
    return s;
}

static double entries(const struct sph *s)
{
    double listed = 0.0;
    for (int i = 0; i < s->p.n; i++)
        listed += s->list->count[i];
    return listed;
}

static void share_of_peak(double flops, double pairs, double t)
{
    if (flops > 0.0 && t > 0.0)
        printf(" %5.1f", 1e-7 * flops * pairs / t / fma_peak());
    else
        printf("     -");
}

static void bench(int dim, double R_dx, int cells, int kind)
{
    struct sph_case c;
    struct sph *s = start(&c, dim, R_dx, cells, kind);
    const struct kind *k = kinds + kind;
    const double pairs = (double)neighbours_pairs(s), n = s->p.n;
    const double t_list = best_of(7, list, s);
    const double t1 = best_of(7, s->scheme->gradients, s), t2 = best_of(7, s->scheme->rates, s);
    const double stage = best_of(7, integrate_rates, s) + t_list / s->stages->n;
    printf("%dD %3.1f %-8s%8.0f %6.1f %5.2f %8.0f", dim, R_dx, k->name, n, pairs / n,
           pairs / entries(s), 1e9 * t_list / n);
    printf(" %7.1f %7.1f %7.1f %7.2f", t1 > 0.0 ? 1e-6 * pairs / t1 : 0.0, 1e-6 * pairs / t2,
           1e-6 * pairs / stage, 1e-6 * n / (s->stages->n * stage));
    for (int pass = 0; pass < 2; pass++)
        printf(" %4.0f %4.0f", k->bytes[dim - 2][pass], k->flops[dim - 2][pass]);
    share_of_peak(k->flops[dim - 2][0], pairs, t1);
    share_of_peak(k->flops[dim - 2][1], 0.5 * pairs, t2);
    printf("\n");
    DROP(c.s);
}

/* A step of everything, s a particle. */
static double step_of(int dim, double R_dx, int cells, int kind, int repeats)
{
    struct sph_case c;
    struct sph *s = start(&c, dim, R_dx, cells, kind);
    double best = INFINITY;
    for (int k = 0; k < repeats; k++) {
        const double t = cpu_time();
        sph_case_run(&c, 1, 100.0);
        best = fmin(best, cpu_time() - t);
    }
    best /= s->p.n;
    DROP(c.s);
    return best;
}

static void sizes(int dim, double R_dx, int few, int many, int kind)
{
    const double a = step_of(dim, R_dx, few, kind, 30), b = step_of(dim, R_dx, many, kind, 3);
    printf("%dD %3.1f %-8s %8.3g us a step and particle at %.0f, %.3g at %.0f: %+.0f %%\n", dim,
           R_dx, kinds[kind].name, 1e6 * a, pow(few, dim), 1e6 * b, pow(many, dim),
           100.0 * (b / a - 1.0));
}

/* What a particle takes of all that is held. */
static void memory(int dim, double R_dx, int cells)
{
    struct sph_case c;
    const size_t before = mallinfo2().uordblks;
    const struct sph *s = start(&c, dim, R_dx, cells, DEFAULT);
    const double n = s->p.n, list = 4.0 * (double)s->list->capacity / n;
    printf("%dD %3.1f %8.0f particles: %.0f bytes each, ghosts and room to grow included, and %.0f "
           "of list, of which %.0f used\n",
           dim, R_dx, n, (double)(mallinfo2().uordblks - before) / n - list, list,
           4.0 * entries(s) / n);
    DROP(c.s);
}

/* A column that collapses between three walls, rows of a series every second step: what is left of
 * the throughput in a whole run, with surface, walls, watches, list and output. */
static void whole_run(int cells, int steps)
{
    struct sph_case c;
    struct figures *row = NEW(struct figures, 1);
    struct scene *e = sph_case_tank(&c, cells, 9.81, 3);
    e->fluid.rho = 1000.0;
    e->nshapes = 1;
    e->shapes[0] = (struct scene_shape){.form = SHAPE_BOX, .box = {{0.0, 0.0}, {0.5, 0.5}}};
    c.prm.scheme = SCHEME_RIEMANN;
    c.prm.surface = SURFACE_YES;
    c.prm.dissipation = 0.1;
    c.prm.c0 = 45.0;
    struct sph *s = sph_case_start(&c, NULL);
    const double t = cpu_time();
    row->measures = true;
    for (int k = 0; k < steps; k += 2) {
        sph_case_run(&c, 2, 1e9);
        row->n = 0;
        sph_row(s, row);
    }
    printf("whole run of a falling column, %d particles, %d steps: %.1f M pairs/s\n", s->p.n, steps,
           1e-6 * (double)s->total.pairs / (cpu_time() - t));
    FREE(row);
    DROP(c.s);
}

int main(int argc, char **argv)
{
    MPI_Init(&argc, &argv);
    printf("FMA peak of this core, measured: %.1f GFLOP/s (double, %d lanes)\n", fma_peak(), LANES);
    for (int k = 0; k < KINDS; k++)
        printf("  %-8s %s\n", kinds[k].name, kinds[k].is);
    printf("M ordered pairs/s of first pass, second pass, whole stage (halo, update, list and "
           "sort over its stages); M particle-steps/s;\n"
           "bytes, operations of an ordered pair in the first pass, of a pair in the second; %% of "
           "the peak, measured anew\n"
           "R/dx            particles  pairs   hit  list ns   first  second   stage   steps   B  "
           "flop    B flop first second\n");
    for (int k = 0; k < KINDS; k++) {
        bench(2, 4.0, 316, k);
        bench(3, 2.5, 58, k);
        bench(3, 4.0, 40, k);
    }
    memory(2, 4.0, 316);
    memory(3, 2.5, 58);
    memory(3, 4.0, 40);
    whole_run(120, 600);
    sizes(2, 4.0, 100, 1000, LEAN);
    sizes(2, 4.0, 100, 1000, DEFAULT);
    sizes(3, 2.5, 22, 100, DEFAULT);
    MPI_Finalize();
    return 0;
}

/* test_patch.c - a patch of a grid is exact on what it must be exact on, and its error falls with
 * the right order. Cells hold averages; functions are integrated exactly.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include <time.h>

#include "../../../coupler/client/cpl_patch.h"
#include "../../../coupler/transport/region.h"

typedef double function(const double *x);

/* Averages over the cells by Gauss-Legendre with 3 points a direction: exact to degree 5. `point':
 * values at cell centres instead. */
static void fill(struct client_patch *p, function *f, function *dfdt, bool point)
{
    static const double node[3] = {-0.3872983346207417, 0.0, 0.3872983346207417};
    static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    p->v = calloc(CPL_TERMS * patch_size(p), sizeof *p->v);
    double *v = p->v;
    for (int k = 0; k < p->n[2]; k++)
        for (int j = 0; j < p->n[1]; j++)
            for (int i = 0; i < p->n[0]; i++, v += CPL_TERMS) {
                const int c[3] = {i, j, k};
                v[0] = v[1] = 0.0;
                for (int m = 0; m < 27; m++) {
                    const int q[3] = {m % 3, m / 3 % 3, m / 9};
                    double x[3] = {0}, w = 1.0;
                    for (int a = 0; a < 3; a++) {
                        w *= weight[q[a]];
                        if (a < p->dim)
                            x[a] = p->origin[a] +
                                   (p->lo[a] + c[a] + 0.5 + (point ? 0.0 : node[q[a]])) *
                                       p->spacing[a];
                    }
                    v[0] += w * f(x);
                    v[1] += w * (dfdt ? dfdt(x) : 0.0);
                }
            }
}

static struct client_patch make(int dim, int n, double h, bool cubic)
{
    return (struct client_patch){.dim = dim,
                                 .ncomp = 1,
                                 .cubic = cubic,
                                 .lo = {3, -2, dim == 3 ? 1 : 0},
                                 .n = {n, n + 1, dim == 3 ? n - 1 : 1},
                                 .origin = {0.3, -0.2, 0.1},
                                 .spacing = {h, 1.1 * h, 0.9 * h},
                                 .t = 2.0};
}

/* Anywhere in the patch but for `inset' cells at its edges. */
static void place(const struct client_patch *p, double inset, double *x)
{
    for (int a = 0; a < 3; a++)
        x[a] = a < p->dim ? p->origin[a] +
                                (p->lo[a] + inset + random_in(0.0, 1.0) * (p->n[a] - 2.0 * inset)) *
                                    p->spacing[a]
                          : 0.0;
}

static double bilinear(const double *x)
{
    return 1.0 - 2.0 * x[0] + 0.7 * x[1] + 3.0 * x[0] * x[1];
}
static double trilinear(const double *x) { return bilinear(x) * (1.0 + 0.4 * x[2]); }
static double cubic(const double *x)
{
    const double a = x[0], b = x[1];
    return 1.0 + a + 2.0 * a * a - a * a * a * (1.0 - b * b * b) + 0.5 * b * b * a + b * b * b;
}
static double cubic3(const double *x)
{
    return cubic(x) * (2.0 - x[2] * x[2] * (1.0 + 0.5 * x[2]));
}
static double wave(const double *x) { return sin(2.0 * M_PI * x[0]) * cos(2.0 * M_PI * x[1]); }

/* Largest error over random places, of the value and of the slopes by central differences of f. */
static void errors(const struct client_patch *p, double inset, function *f, function *dfdt,
                   double tau, double *value, double *slope)
{
    *value = *slope = 0.0;
    for (int m = 0; m < 2000; m++) {
        double x[3], v, grad[3];
        place(p, inset, x);
        patch_eval(p, p->t + tau, 1, x, &v, grad);
        *value = fmax(*value, fabs(v - f(x) - tau * (dfdt ? dfdt(x) : 0.0)));
        for (int a = 0; a < p->dim && tau == 0.0; a++) {
            double l[3] = {x[0], x[1], x[2]}, r[3] = {x[0], x[1], x[2]};
            const double e = 1e-5;
            l[a] -= e;
            r[a] += e;
            *slope = fmax(*slope, fabs(grad[a] - (f(r) - f(l)) / (2.0 * e)));
        }
    }
}

static void check_exact(int dim, bool is_cubic, function *f)
{
    struct client_patch p = make(dim, 7, 0.1, is_cubic);
    double value, slope;
    fill(&p, f, f, false);
    patch_prepare(&p);
    errors(&p, 0.0, f, f, 0.0, &value, &slope);
    assert_true(value < 1e-12);
    assert_true(slope < 1e-7); /* of the central difference */
    errors(&p, 0.0, f, f, 0.3, &value, &slope);
    assert_true(value < 2e-12);
    patch_clear(&p);
}

TEST(linear_is_exact_on_products_of_linear)
{
    check_exact(2, false, bilinear);
    check_exact(3, false, trilinear);
}

TEST(cubic_is_exact_on_cubics_given_their_averages)
{
    check_exact(2, true, cubic);
    check_exact(3, true, cubic3);
}

/* Errors inside, where SPH evaluates, on grids of n cells; returns the order. */
static double order(bool is_cubic, bool of_slope)
{
    double e[3] = {0};
    for (int m = 0; m < 3; m++) {
        const int n = 16 << m;
        double slope, value;
        struct client_patch p = make(2, n, 1.0 / n, is_cubic);
        fill(&p, wave, NULL, !is_cubic);
        patch_prepare(&p);
        errors(&p, 2.0, wave, NULL, 0.0, &value, &slope);
        e[m] = of_slope ? slope : value;
        patch_clear(&p);
    }
    const double o = log2(e[1] / e[2]);
    printf("%s, %s: errors %.2e %.2e %.2e, order %.2f\n", is_cubic ? "cubic" : "linear",
           of_slope ? "slope" : "value", e[0], e[1], e[2], o);
    return o;
}

TEST(orders_are_two_and_four_and_one_less_for_slopes)
{
    assert_true(order(false, false) > 1.9);
    assert_true(order(false, true) > 0.9);
    assert_true(order(true, false) > 3.7);
    assert_true(order(true, true) > 2.7);
}

/* check/bilinear.py of the methods: [6.6] in its printed form, on the dual cell. */
TEST(linear_is_the_printed_formula)
{
    struct client_patch p = make(2, 2, 0.25, false);
    p.n[1] = 2;
    fill(&p, wave, NULL, true);
    patch_prepare(&p);
    for (int m = 0; m < 100; m++) {
        const double f11 = p.v[0], f21 = p.v[CPL_TERMS], f12 = p.v[2 * CPL_TERMS],
                     f22 = p.v[3 * CPL_TERMS];
        const double x1 = p.origin[0] + (p.lo[0] + 0.5) * p.spacing[0], x2 = x1 + p.spacing[0];
        const double y1 = p.origin[1] + (p.lo[1] + 0.5) * p.spacing[1], y2 = y1 + p.spacing[1];
        const double x[3] = {x1 + random_in(0.0, 1.0) * (x2 - x1),
                             y1 + random_in(0.0, 1.0) * (y2 - y1), 0.0};
        const double left = f11 * (y2 - x[1]) + f12 * (x[1] - y1);
        const double right = f21 * (y2 - x[1]) + f22 * (x[1] - y1);
        const double want = ((x2 - x[0]) * left + (x[0] - x1) * right) / ((x2 - x1) * (y2 - y1));
        double v;
        patch_eval(&p, p.t, 1, x, &v, NULL);
        assert_true(fabs(v - want) < 1e-13);
    }
    patch_clear(&p);
}

TEST(outside_is_as_at_the_nearest_place)
{
    struct client_patch p = make(2, 8, 0.1, true);
    fill(&p, cubic, NULL, false);
    patch_prepare(&p);
    const double right = p.origin[0] + (p.lo[0] + p.n[0]) * p.spacing[0];
    const double far[3] = {right + 5.0, 0.1, 0.0}, edge[3] = {right, 0.1, 0.0};
    double a, b;
    patch_eval(&p, p.t, 1, far, &a, NULL);
    patch_eval(&p, p.t, 1, edge, &b, NULL);
    assert_true(fabs(a - b) < 1e-12);
    const double bad[3] = {NAN, 0.1, 1e300};
    patch_eval(&p, p.t, 1, bad, &a, NULL);
    assert_true(isfinite(a));
    patch_clear(&p);
}

TEST(periodic_patches_find_every_image)
{
    const int n = 20;
    const double lo[3] = {-0.2, 0.4, 0.0}, hi[3] = {0.3, 1.4, 0.0};
    struct client_patch p = {
        .dim = 2, .ncomp = 1, .cubic = true, .spacing = {1.0 / n, 1.0 / n, 1.0}};
    const int cells[3] = {n, n, 1}, periodic[3] = {1, 1, 0};
    int last[3];
    region_cells(2, p.origin, p.spacing, cells, periodic, lo, hi, p.lo, last);
    for (int a = 0; a < 3; a++) {
        p.n[a] = last[a] - p.lo[a];
        p.period[a] = periodic[a] * cells[a];
    }
    fill(&p, wave, NULL, false);
    patch_prepare(&p);
    for (int m = 0; m < 500; m++) {
        const double x[3] = {lo[0] + 0.5 * random_in(0.0, 1.0), lo[1] + random_in(0.0, 1.0), 0.0};
        const double y[3] = {x[0] + floor(3.0 * random_in(0.0, 1.0)) - 1.0,
                             x[1] - floor(3.0 * random_in(0.0, 1.0)), 0.0};
        double a, b;
        patch_eval(&p, 0.0, 1, x, &a, NULL);
        patch_eval(&p, 0.0, 1, y, &b, NULL);
        assert_true(fabs(a - wave(x)) < 2e-3);
        assert_true(fabs(a - b) < 1e-12);
    }
    patch_clear(&p);
}

/* Two patches of one grid agree to the last bit where both are far from their edges. */
TEST(bits_do_not_depend_on_the_patch)
{
    const double x[3] = {1.5123, 0.4567, 0.0};
    double v[2];
    for (int m = 0; m < 2; m++) {
        struct client_patch p = make(2, 20, 0.1, true);
        p.lo[0] -= 3 * m;
        p.lo[1] -= m;
        fill(&p, wave, NULL, false);
        patch_prepare(&p);
        patch_eval(&p, p.t, 1, x, &v[m], NULL);
        patch_clear(&p);
    }
    assert_memory_equal(&v[0], &v[1], sizeof v[0]);
}

TEST(thin_patches_and_many_components_work)
{
    for (int n = 1; n <= 4; n++) {
        struct client_patch p = {
            .dim = 2, .ncomp = 5, .cubic = true, .n = {n, 5 - n, 1}, .spacing = {1, 1, 1}};
        p.v = calloc(CPL_TERMS * 5 * patch_size(&p), sizeof *p.v);
        for (size_t i = 0; i < patch_size(&p); i++)
            for (size_t a = 0; a < 5; a++)
                p.v[CPL_TERMS * (5 * i + a)] = 3.0 + (double)a;
        patch_prepare(&p);
        const double x[3] = {0.7, 0.6, 0.0};
        double v[5], grad[15];
        patch_eval(&p, 1.0, 1, x, v, grad);
        for (int a = 0; a < 5; a++)
            assert_true(fabs(v[a] - 3.0 - a) < 1e-14 && fabs(grad[3 * a]) < 1e-13);
        patch_clear(&p);
    }
    const struct client_patch none = {.dim = 2, .ncomp = 1};
    double v = 1.0;
    patch_eval(&none, 0.0, 1, (double[3]){0}, &v, NULL);
    assert_true(v == 0.0);
}

/* All points of a stage share one time; another time, another course. */
TEST(values_follow_a_cubic_in_time)
{
    struct client_patch p = make(2, 6, 0.1, true);
    fill(&p, cubic, cubic, false);
    for (size_t i = 0; i < patch_size(&p); i++) {
        p.v[CPL_TERMS * i + 2] = -2.0 * p.v[CPL_TERMS * i];
        p.v[CPL_TERMS * i + 3] = 5.0 * p.v[CPL_TERMS * i];
    }
    patch_prepare(&p);
    for (int m = 0; m < 50; m++) {
        const double tau = random_in(0.0, 1.0) - 0.5,
                     course = 1.0 + tau * (1.0 + tau * (-2.0 + 5.0 * tau));
        double x[3], v[2];
        place(&p, 0.0, x);
        patch_eval(&p, p.t + tau, 1, x, v, NULL);
        patch_eval(&p, p.t + tau, 1, x, v + 1, NULL);
        assert_true(fabs(v[0] - course * cubic(x)) < 1e-11);
        assert_true(v[0] == v[1]);
    }
    patch_clear(&p);
}

TEST(report_speed)
{
    enum { N = 4000, TIMES = 20 };
    static double x[3 * N], v[4 * N], grad[12 * N];
    for (int dim = 2; dim <= 3; dim++)
        for (int ncomp = 1; ncomp <= dim; ncomp += dim - 1)
            for (int slopes = 0; slopes < 2; slopes++) {
                struct client_patch p = make(dim, 40, 0.025, true);
                struct timespec a, b;
                p.ncomp = ncomp;
                p.v = calloc(CPL_TERMS * (size_t)ncomp * patch_size(&p), sizeof *p.v);
                for (int i = 0; i < N; i++)
                    place(&p, 0.0, x + 3 * i);
                patch_prepare(&p);
                clock_gettime(CLOCK_MONOTONIC, &a);
                for (int m = 0; m < TIMES; m++)
                    patch_eval(&p, 0.1 * m, N, x, v, slopes ? grad : NULL);
                clock_gettime(CLOCK_MONOTONIC, &b);
                const double s =
                    (double)(b.tv_sec - a.tv_sec) + 1e-9 * (double)(b.tv_nsec - a.tv_nsec);
                printf("cubic %dD, %d components%s: %.3f us a point\n", dim, ncomp,
                       slopes ? " and slopes" : "", 1e6 * s / (N * TIMES));
                patch_clear(&p);
            }
}

/* test_moments3.c - what a triangle has of a particle's kernel: closed form against the table of
 * Shepard factors, adaptive quadrature, whole planes and sums of parts; feet on edges and corners.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/walls/facet.h"
#include "../../../sph/walls/vec_math.h"

static struct wall_integrals integrals(const struct facet *f, int n, const double *x)
{
    struct facet_batch b = {.n = 0};
    struct wall_integrals sum = {0};
    for (int k = 0; k < n; k++)
        facet_ask(&b, f + k, x, 1.0, &sum);
    facet_finish(&b);
    return sum;
}

/* --- functions --- */

TEST(arc_tangents_and_logarithms_are_those_of_the_library)
{
    double worst[2] = {0.0};
    srand(3);
    for (int k = 0; k < 20000; k++) {
        const double size = pow(10.0, random_in(-14.0, 2.0));
        const double y = random_in(-1.0, 1.0), x = random_in(-1.0, 1.0) * size;
        const double angle = vec_atan2(vec_all(y), vec_all(x))[LANES - 1];
        const double z = pow(10.0, random_in(-30.0, 30.0)), w = 1.0 + random_in(-1e-3, 1e-3);
        worst[0] = fmax(worst[0], fabs(angle - atan2(y, x)));
        worst[1] = fmax(worst[1], fabs(vec_log(vec_all(z))[0] - log(z)) / fabs(log(z)));
        worst[1] = fmax(worst[1], fabs(vec_log(vec_all(w))[0] / log(w) - 1.0));
    }
    assert_close(worst[0], 0.0, 1e-15);
    assert_close(worst[1], 0.0, 1e-15);
    assert_close(vec_atan2(vec_all(0.0), vec_all(-1.0))[0], M_PI, 1e-15);
    assert_close(vec_atan2(vec_all(-1.0), vec_all(0.0))[0], -0.5 * M_PI, 1e-15);
}

/* --- walls of the table --- */

/* Two triangles a rectangle with corners a, b, c, d. */
static int rectangle(struct facet *f, const double *a, const double *b, const double *c,
                     const double *d)
{
    f[0] = facet_of(a, b, c);
    f[1] = facet_of(a, c, d);
    return 2;
}

/* [0, L]^3; normals out of the box, or into it. */
static int box(struct facet *f, double L, bool outward)
{
    int n = 0;
    for (int a = 0; a < 3; a++)
        for (int high = 0; high < 2; high++) {
            double v[4][3];
            for (int k = 0; k < 4; k++) {
                v[k][a] = high ? L : 0.0;
                v[k][(a + 1) % 3] = k == 1 || k == 2 ? L : 0.0;
                v[k][(a + 2) % 3] = k >= 2 ? L : 0.0;
            }
            const bool as_is = (high == 1) == outward;
            n += as_is ? rectangle(f + n, v[0], v[1], v[2], v[3])
                       : rectangle(f + n, v[3], v[2], v[1], v[0]);
        }
    return n;
}

/* z = 0 with the fluid above. */
static int plane(struct facet *f)
{
    const double v[4][3] = {{-5, -5, 0}, {-5, 5, 0}, {5, 5, 0}, {5, -5, 0}};
    return rectangle(f, v[0], v[1], v[2], v[3]);
}

TEST(gamma_agrees_with_the_table)
{
    char line[256], what[128];
    double x[3], wanted, worst = 0.0, corner = 0.0;
    int n = 0;
    FILE *f = fopen("tests/data/gamma3d.csv", "r");
    assert_non_null(f);
    while (fgets(line, sizeof line, f)) {
        struct facet walls[12];
        if (sscanf(line, "%127[^,],%lf,%lf,%lf,%lf", what, x, x + 1, x + 2, &wanted) != 5)
            continue;
        const int m = strstr(what, "flat") ? plane(walls) : box(walls, 3.0, strstr(what, "inside"));
        const double error = fabs(1.0 + integrals(walls, m, x).gamma - wanted);
        const bool foot_on_corner = (x[0] == 0.0) + (x[1] == 0.0) + (x[2] == 0.0) == 2;
        double *to = foot_on_corner && !strstr(what, "flat") ? &corner : &worst;
        *to = fmax(*to, error);
        n++;
    }
    fclose(f);
    assert_true(n == 19);
    assert_close(worst, 0.0, 1e-12);
    assert_close(corner, 0.0, 1e-7); /* there the particle is moved by 2e-8 R */
}

/* [4.65], [4.92]; wherever the foot is on the triangles, on their seam and ends too. */
TEST(a_plane_has_half_the_kernel)
{
    struct facet walls[2];
    const int n = plane(walls);
    for (double d = 0.013; d < 1.0; d += 0.047)
        for (int k = 0; k < 8; k++) {
            const double x[3] = {k < 4 ? 0.0 : random_in(-3, 3), k < 2 ? 0.0 : random_in(-3, 3), d};
            const struct wall_integrals m = integrals(walls, n, x);
            const double t = 1.0 - d, t2 = t * t, t5 = t2 * t2 * t;
            assert_close(m.gamma, -0.5 * t5 * t * (1.0 + 3.0 * d + 3.0 * d * d), 1e-13);
            assert_close(m.W, 0.75 * t5 * (2.0 + 10.0 * d + 16.0 * d * d), 1e-12);
            assert_close(m.e[0], 0.0, 1e-12);
            assert_close(m.e[1], 0.0, 1e-12);
            assert_close(m.e[2], -d * m.W, 1e-12);
        }
}

/* --- quadrature --- */

/* Radon's rule of degree 5, one triangle. */
static struct wall_integrals radon(const struct facet *f, const double *x)
{
    const double s = sqrt(15.0), at[2] = {(6.0 - s) / 21.0, (6.0 + s) / 21.0};
    const double weight[2] = {(155.0 - s) / 1200.0, (155.0 + s) / 1200.0};
    struct wall_integrals sum = {0};
    for (int i = 0; i < 7; i++) {
        double y[3], r2 = 0.0, D = 0.0;
        const double c = i == 6 ? 1.0 / 3.0 : at[i / 3], w = i == 6 ? 0.225 : weight[i / 3];
        for (int a = 0; a < 3; a++) {
            y[a] = -x[a];
            for (int k = 0; k < 3; k++)
                y[a] += (k == i % 3 ? 1.0 - 2.0 * c : c) * f->v[k][a];
            r2 += y[a] * y[a];
            D += f->n[a] * y[a];
        }
        const double r = sqrt(r2), W = w * f->area * (r < 1.0 ? kernel_w(3, r, 1.0) : 0.0);
        if (r >= 1.0)
            continue;
        sum.gamma += w * f->area * D * 21.0 / (2.0 * M_PI) *
                     (-1.0 / (42.0 * r * r * r) + 1.0 / 3.0 - 2.0 * r2 + 10.0 / 3.0 * r * r2 -
                      15.0 / 7.0 * r2 * r2 + 0.5 * r * r2 * r2);
        sum.W += W;
        for (int a = 0; a < 3; a++)
            sum.e[a] += W * y[a];
    }
    return sum;
}

static void sum_up(struct wall_integrals *to, const struct wall_integrals *m)
{
    to->gamma += m->gamma;
    to->W += m->W;
    for (int a = 0; a < 3; a++)
        to->e[a] += m->e[a];
}

/* Cut into four until the rule agrees with its parts. */
static void adaptive(const struct facet *f, const double *x, int depth, double tolerance,
                     struct wall_integrals *to)
{
    double mid[3][3], away2 = 0.0;
    for (int s = 0; s < 3; s++)
        for (int a = 0; a < 3; a++)
            mid[s][a] = 0.5 * (f->v[s][a] + f->v[(s + 1) % 3][a]);
    for (int a = 0; a < 3; a++)
        away2 += (f->centre[a] - x[a]) * (f->centre[a] - x[a]);
    if (sqrt(away2) > 1.0 + f->radius)
        return;
    const struct facet parts[4] = {
        facet_of(f->v[0], mid[0], mid[2]), facet_of(mid[0], f->v[1], mid[1]),
        facet_of(mid[2], mid[1], f->v[2]), facet_of(mid[0], mid[1], mid[2])};
    const struct wall_integrals one = radon(f, x);
    struct wall_integrals four = {0};
    for (int k = 0; k < 4; k++) {
        const struct wall_integrals m = radon(parts + k, x);
        sum_up(&four, &m);
    }
    const bool agrees = fabs(one.gamma - four.gamma) < tolerance &&
                        fabs(one.W - four.W) < tolerance && f->longest < 0.3;
    if (agrees || depth > 16) {
        sum_up(to, &four);
        return;
    }
    for (int k = 0; k < 4; k++)
        adaptive(parts + k, x, depth + 1, 0.5 * tolerance, to);
}

static struct facet random_triangle(double size)
{
    double v[3][3];
    for (int k = 0; k < 9; k++)
        v[k / 3][k % 3] = random_in(-size, size);
    return facet_of(v[0], v[1], v[2]);
}

static double difference(const struct wall_integrals *a, const struct wall_integrals *b)
{
    double most = fmax(fabs(a->gamma - b->gamma), fabs(a->W - b->W));
    for (int k = 0; k < 3; k++)
        most = fmax(most, fabs(a->e[k] - b->e[k]));
    return most;
}

TEST(moments_are_integrals)
{
    const double x[3] = {0.0, 0.0, 0.0};
    double worst = 0.0;
    srand(11);
    for (int k = 0; k < 60; k++) {
        const struct facet f = random_triangle(pow(10.0, random_in(-0.3, 0.5)));
        const struct wall_integrals m = integrals(&f, 1, x);
        struct wall_integrals wanted = {0};
        adaptive(&f, x, 0, 1e-10, &wanted);
        worst = fmax(worst, difference(&m, &wanted));
    }
    assert_close(worst, 0.0, 1e-9);
}

/* Parts of a triangle, as long as none goes by points. */
TEST(parts_make_the_whole)
{
    double worst = 0.0;
    srand(5);
    for (int k = 0; k < 300; k++) {
        const struct facet f = random_triangle(3.0);
        const double x[3] = {random_in(-1, 1), random_in(-1, 1), random_in(-1, 1)};
        const double w[2] = {random_in(0.2, 0.4), random_in(0.2, 0.4)};
        double at[3];
        for (int a = 0; a < 3; a++)
            at[a] = f.v[0][a] + w[0] * (f.v[1][a] - f.v[0][a]) + w[1] * (f.v[2][a] - f.v[0][a]);
        const struct facet parts[3] = {facet_of(f.v[0], f.v[1], at), facet_of(f.v[1], f.v[2], at),
                                       facet_of(f.v[2], f.v[0], at)};
        const struct wall_integrals whole = integrals(&f, 1, x), sum = integrals(parts, 3, x);
        worst = fmax(worst, difference(&whole, &sum));
    }
    assert_close(worst, 0.0, 1e-10);
}

/* All integrals are continuous where the foot passes corners and edges. */
TEST(feet_on_edges_and_corners_are_no_exception)
{
    double worst = 0.0;
    srand(9);
    for (int k = 0; k < 200; k++) {
        const struct facet f = random_triangle(1.5);
        const double d = random_in(0.02, 0.9), z = k % 2 ? 0.0 : random_in(0.0, 1.0);
        double x[3], beside[3];
        for (int a = 0; a < 3; a++) {
            x[a] = f.v[0][a] + z * (f.v[1][a] - f.v[0][a]) - d * f.n[a];
            beside[a] = x[a] + 1e-6 * (f.centre[a] - f.v[2][a]);
        }
        const struct wall_integrals m = integrals(&f, 1, x), n = integrals(&f, 1, beside);
        worst = fmax(worst, difference(&m, &n));
    }
    assert_true(worst < 2e-5);
}

/* Small triangles far away go by points: a finely cut box has what a coarse one has. */
TEST(small_triangles_go_by_points)
{
    enum { CUTS = 24 };
    static struct facet fine[12 * CUTS * CUTS];
    struct facet coarse[12];
    double worst[2] = {0.0};
    int n = 0;
    box(coarse, 2.4, true);
    for (int k = 0; k < 12; k++)
        for (int i = 0; i < CUTS; i++)
            for (int j = 0; j < CUTS - i; j++) {
                double v[4][3];
                for (int a = 0; a < 3; a++) {
                    const double e = (coarse[k].v[1][a] - coarse[k].v[0][a]) / CUTS;
                    const double g = (coarse[k].v[2][a] - coarse[k].v[0][a]) / CUTS;
                    v[0][a] = coarse[k].v[0][a] + i * e + j * g;
                    v[1][a] = v[0][a] + e;
                    v[2][a] = v[0][a] + g;
                    v[3][a] = v[0][a] + e + g;
                }
                fine[n++] = facet_of(v[0], v[1], v[2]);
                if (i + j < CUTS - 1)
                    fine[n++] = facet_of(v[1], v[3], v[2]);
            }
    srand(2);
    for (int k = 0; k < 40; k++) {
        const double x[3] = {random_in(0.02, 2.38), random_in(0.02, 1.0), random_in(0.02, 1.0)};
        const struct wall_integrals m = integrals(coarse, 12, x), p = integrals(fine, n, x);
        worst[0] = fmax(worst[0], fabs(m.gamma - p.gamma));
        worst[1] = fmax(worst[1], fabs(m.W - p.W));
    }
    assert_close(worst[0], 0.0, 1e-5);
    assert_close(worst[1], 0.0, 1e-4);
}

/* The thesis's quadrature, of second order in the side of its squares. */
TEST(clipped_squares_agree)
{
    double worst[2] = {0.0};
    srand(4);
    for (int k = 0; k < 200; k++) {
        const struct facet f = random_triangle(1.2);
        const double x[3] = {0.0, 0.0, 0.0};
        const struct wall_integrals m = integrals(&f, 1, x);
        for (int fine = 0; fine < 2; fine++) {
            struct wall_integrals q = {.gamma = m.gamma};
            facet_clip(&f, x, 1.0, fine ? 60 : 6, &q);
            worst[fine] = fmax(worst[fine], difference(&m, &q) / 1.5);
        }
    }
    print_message("clipped squares: %.1e (6), %.1e (60) of a plane's weight\n", worst[0], worst[1]);
    assert_true(worst[1] < worst[0] / 50.0);
    assert_close(worst[1], 0.0, 1e-3);
}

TEST(the_nearest_point_is_nearest)
{
    srand(8);
    for (int k = 0; k < 300; k++) {
        const struct facet f = random_triangle(1.0);
        const double x[3] = {random_in(-2, 2), random_in(-2, 2), random_in(-2, 2)};
        double foot[3], least = INFINITY, at[3];
        const double r = facet_nearest(&f, x, foot);
        for (int i = 0; i <= 60; i++)
            for (int j = 0; j <= 60 - i; j++) {
                double r2 = 0.0;
                for (int a = 0; a < 3; a++) {
                    at[a] = f.v[0][a] +
                            (i * (f.v[1][a] - f.v[0][a]) + j * (f.v[2][a] - f.v[0][a])) / 60.0;
                    r2 += (at[a] - x[a]) * (at[a] - x[a]);
                }
                least = fmin(least, sqrt(r2));
            }
        assert_true(r <= least + 1e-12 && least - r < 0.04);
        double r2 = 0.0;
        for (int a = 0; a < 3; a++)
            r2 += (foot[a] - x[a]) * (foot[a] - x[a]);
        assert_close(sqrt(r2), r, 1e-12);
    }
}

/* int_0^r -W' s^2 ds and int_0^r W s^2 ds, R = 1. */
static double pull_within(double r)
{
    return 21.0 / (2.0 * M_PI) * 20.0 *
           (pow(r, 4) / 4.0 - 3.0 * pow(r, 5) / 5.0 + pow(r, 6) / 2.0 - pow(r, 7) / 7.0);
}

static double mass_within(double r)
{
    return 21.0 / (2.0 * M_PI) *
           (r * r * r / 3.0 - 2.0 * pow(r, 5) + 10.0 / 3.0 * pow(r, 6) - 15.0 / 7.0 * pow(r, 7) +
            0.5 * pow(r, 8));
}

/* How far x sees along e before the triangle, at most 1. */
static double sight(const struct facet *f, const double *x, const double *e)
{
    double along = 0.0, height = 0.0;
    for (int a = 0; a < 3; a++) {
        along += f->n[a] * e[a];
        height += f->n[a] * (f->v[0][a] - x[a]);
    }
    const double r = height / along;
    if (!(r > 0.0 && r < 1.0))
        return 1.0;
    for (int s = 0; s < 3; s++) {
        double p = 0.0;
        for (int a = 0; a < 3; a++)
            p += f->m[s][a] * (f->v[s][a] - x[a] - r * e[a]);
        if (p < 0.0)
            return 1.0;
    }
    return r;
}

/* Of a lone triangle that hides what lies behind it: gamma is what x sees of its kernel, and the
 * planes through x and the edges close the sums. By rays. */
TEST(a_lone_triangle_casts_a_shadow)
{
    enum { RAYS = 400000 };
    const double x[3] = {0.0, 0.0, 0.0};
    srand(21);
    for (int k = 0; k < 5; k++) {
        struct facet f = random_triangle(1.0);
        double seen = 0.0, sum[3] = {0.0};
        if (f.n[0] * f.v[0][0] + f.n[1] * f.v[0][1] + f.n[2] * f.v[0][2] < 0.0)
            f = facet_of(f.v[0], f.v[2], f.v[1]); /* faces x */
        for (int i = 0; i < RAYS; i++) {
            const double z = 1.0 - (2.0 * i + 1.0) / RAYS, w = sqrt(1.0 - z * z);
            const double turn = i * M_PI * (3.0 - sqrt(5.0));
            const double e[3] = {w * cos(turn), w * sin(turn), z}, r = sight(&f, x, e);
            seen += mass_within(r) * 4.0 * M_PI / RAYS;
            for (int a = 0; a < 3; a++)
                sum[a] += pull_within(r) * e[a] * 4.0 * M_PI / RAYS;
        }
        const struct wall_integrals m = integrals(&f, 1, x);
        assert_close(1.0 + m.gamma, seen, 1e-4);
        for (int s = 0; s < 3; s++) {
            double N[3], size = 0.0, out = 0.0;
            for (int a = 0; a < 3; a++) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                N[a] = f.v[s][b] * f.t[s][c] - f.v[s][c] * f.t[s][b];
                size += N[a] * N[a];
                out += N[a] * f.centre[a];
            }
            for (int a = 0; a < 3; a++)
                sum[a] += facet_rim(&f, s, x, 1.0) * N[a] / sqrt(size) * (out > 0.0 ? 1.0 : -1.0);
        }
        for (int a = 0; a < 3; a++)
            assert_close((sum[a] + m.W * f.n[a]) / 1.5, 0.0, 1e-3);
    }
}

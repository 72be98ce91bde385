/* test_tree.c - the tree of a mesh finds what looking at every triangle finds; sides, windings and
 * solids are those of geometry.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../common/base/vec3.h"
#include "../../../common/geometry/tree.h"
#include "mesh_files.h"

static void random_point(double lo, double hi, double x[3])
{
    for (int a = 0; a < 3; a++)
        x[a] = random_in(lo, hi);
}

/* A cloud of n single triangles of all sizes. */
static struct trimesh cloud(int n)
{
    struct trimesh m = {.nvertices = 3 * n, .ntriangles = n};
    m.x = (double(*)[3])mem_new(3 * (size_t)n, sizeof *m.x);
    m.vertex = (int(*)[3])mem_new((size_t)n, sizeof *m.vertex);
    for (int t = 0; t < n; t++) {
        double c[3];
        const double size = pow(10.0, random_in(-3.0, -0.5));
        random_point(100.0, 101.0, c);
        for (int k = 0; k < 3; k++) {
            for (int a = 0; a < 3; a++)
                m.x[3 * t + k][a] = c[a] + random_in(-size, size);
            m.vertex[t][k] = 3 * t + k;
        }
    }
    trimesh_connect(&m);
    return m;
}

static bool meets(const struct trimesh *m, int t, const double *lo, const double *hi)
{
    for (int a = 0; a < 3; a++) {
        const double p = m->x[m->vertex[t][0]][a], q = m->x[m->vertex[t][1]][a],
                     r = m->x[m->vertex[t][2]][a];
        if (fmin(p, fmin(q, r)) > hi[a] || fmax(p, fmax(q, r)) < lo[a])
            return false;
    }
    return true;
}

TEST(boxes_find_what_all_triangles_find)
{
    enum { N = 300 };
    struct trimesh m = cloud(N);
    struct tree *tree = tree_create(&m);
    int who[N], wrong = 0;
    for (int k = 0; k < 10000; k++) {
        double lo[3], hi[3];
        random_point(99.8, 101.2, lo);
        for (int a = 0; a < 3; a++)
            hi[a] = lo[a] + (k % 7 == 0 ? 0.0 : random_in(0.0, 0.5));
        const int n = tree_box(tree, lo, hi, N, who);
        int count = 0;
        for (int t = 0; t < N; t++)
            if (meets(&m, t, lo, hi))
                wrong += count >= n || who[count++] != t; /* ascending */
        wrong += count != n || tree_box(tree, lo, hi, 2, who) != n;
    }
    assert_int_equal(wrong, 0);
    FREE(tree);
    trimesh_free(&m);
}

/* Distance of x to a triangle by looking along its face and its edges. */
static double to_triangle(const struct trimesh *m, int t, const double *x)
{
    const int *v = m->vertex[t];
    double n[3], d[3], least = INFINITY;
    bool above = true;
    trimesh_normal(m, t, n);
    vec3_from(m->x[v[0]], x, d);
    const double height = vec3_dot(d, n);
    for (int k = 0; k < 3; k++) {
        const double *a = m->x[v[k]], *b = m->x[v[(k + 1) % 3]];
        double e[3], out[3], f[3];
        vec3_from(a, b, e);
        vec3_from(a, x, d);
        vec3_cross(e, n, out);
        above = above && vec3_dot(d, out) <= 0.0;
        const double along = fmax(0.0, fmin(1.0, vec3_dot(d, e) / vec3_dot(e, e)));
        for (int i = 0; i < 3; i++)
            f[i] = d[i] - along * e[i];
        least = fmin(least, vec3_length(f));
    }
    return above ? fabs(height) : least;
}

TEST(nearest_is_the_nearest)
{
    enum { N = 300 };
    struct trimesh m = cloud(N);
    struct tree *tree = tree_create(&m);
    double worst = 0.0;
    int missed = 0;
    for (int k = 0; k < 10000; k++) {
        double x[3], least = INFINITY, d[3];
        const double reach = k % 2 ? INFINITY : 0.1;
        random_point(99.5, 101.5, x);
        for (int t = 0; t < N; t++)
            least = fmin(least, to_triangle(&m, t, x));
        const struct tree_foot f = tree_nearest(tree, x, reach);
        missed += (f.triangle < 0) != (least > reach);
        if (f.triangle < 0)
            continue;
        vec3_from(x, f.foot, d);
        worst = fmax(worst, fmax(fabs(fabs(f.distance) - least), fabs(vec3_length(d) - least)));
        missed += to_triangle(&m, f.triangle, x) > least + 1e-12;
    }
    assert_int_equal(missed, 0);
    assert_close(worst, 0.0, 1e-12);
    FREE(tree);
    trimesh_free(&m);
}

static struct trimesh from_lists(int nv, const double (*x)[3], int nt, const int (*v)[3])
{
    struct trimesh m = {.nvertices = nv, .ntriangles = nt};
    m.x = (double(*)[3])mem_new((size_t)nv, sizeof *m.x);
    m.vertex = (int(*)[3])mem_new((size_t)nt, sizeof *m.vertex);
    memcpy(m.x, x, (size_t)nv * sizeof *m.x);
    memcpy(m.vertex, v, (size_t)nt * sizeof *m.vertex);
    trimesh_connect(&m);
    return m;
}

/* A spike with a sharp re-entrant base: the normal of the nearest face alone goes wrong in one
 * point of five. */
TEST(pseudonormal_knows_the_side_of_a_spike)
{
    const double x[5][3] = {{0, 0, 0}, {1, 0, 0}, {.5, .9, 0}, {.5, .3, 3}, {.52, .32, .25}};
    const int v[6][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 0}};
    struct trimesh m = from_lists(5, x, 6, v);
    struct tree *tree = tree_create(&m);
    int wrong = 0, wrong_face = 0;
    assert_true(m.closed && trimesh_solid(&m, -1).volume > 0.0);
    for (int k = 0; k < 10000; k++) {
        double n[3], d[3];
        const double p[3] = {random_in(-.5, 1.5), random_in(-.5, 1.4), random_in(-.5, 3.5)};
        const bool inside = trimesh_winding(&m, p) > 0.5;
        const struct tree_foot f = tree_nearest(tree, p, INFINITY);
        trimesh_normal(&m, f.triangle, n);
        vec3_from(p, f.foot, d);
        wrong += (f.distance > 0.0) != inside;
        wrong_face += (vec3_dot(d, n) > 0.0) != inside;
    }
    assert_int_equal(wrong, 0);
    assert_true(wrong_face > 100);
    FREE(tree);
    trimesh_free(&m);
}

TEST(winding_is_one_inside_and_nought_outside)
{
    const double lo[3] = {0, 0, 0}, hi[3] = {2, 1, 1};
    struct trimesh m = trimesh_box(lo, hi, 3);
    double worst = 0.0;
    for (int k = 0; k < 1000; k++) {
        double p[3];
        random_point(-1.0, 3.0, p);
        const bool in = p[0] > 0 && p[0] < 2 && p[1] > 0 && p[1] < 1 && p[2] > 0 && p[2] < 1;
        worst = fmax(worst, fabs(trimesh_winding(&m, p) - in));
    }
    assert_close(worst, 0.0, 1e-12);
    trimesh_free(&m);
}

/* Without its lid a tank's winding number is 1/2 on the lid's plane, more below, less above. */
TEST(open_tank_has_one_half_on_its_lid)
{
    const double lo[3] = {0, 0, 0}, hi[3] = {2, 1, 1};
    struct trimesh m = open_box(lo, hi);
    assert_false(m.closed);
    assert_int_equal(m.rims, 8);
    for (int k = 0; k < 100; k++) {
        const double x = random_in(0.01, 1.99), y = random_in(0.01, 0.99);
        const double on[3] = {x, y, 1.0}, under[3] = {x, y, 0.98}, over[3] = {x, y, 1.02};
        assert_close(trimesh_winding(&m, on), 0.5, 1e-12);
        assert_true(trimesh_winding(&m, under) > 0.5 && trimesh_winding(&m, over) < 0.5);
    }
    struct tree *tree = tree_create(&m);
    const double above[3] = {-0.3, 0.5, 1.2}, beside[3] = {-0.3, 0.5, 0.4};
    assert_true(tree_nearest(tree, above, INFINITY).rim);
    const struct tree_foot f = tree_nearest(tree, beside, INFINITY);
    assert_false(f.rim);
    assert_close(f.distance, -0.3, 1e-12);
    assert_close(f.n[0], -1.0, 1e-12);
    FREE(tree);
    trimesh_free(&m);
}

/* Segments meet a closed surface as often as they change sides; none slips through an edge. */
TEST(segments_do_not_slip_through)
{
    const double c[3] = {0.1, -0.2, 0.3};
    struct trimesh m = trimesh_sphere(c, 1.0, 3);
    struct tree *tree = tree_create(&m);
    int wrong = 0;
    for (int k = 0; k < 5000; k++) {
        double b[3], at = -1.0;
        random_point(-2.0, 2.0, b);
        const bool out = trimesh_winding(&m, b) < 0.5;
        wrong += tree_crosses(tree, c, b, &at) != out;
        wrong += tree_crosses(tree, b, c, NULL) != out;
        double r[3];
        vec3_from(c, b, r);
        wrong += out && fabs(at * vec3_length(r) - 1.0) > 0.01;
    }
    for (int v = 0; v < m.nvertices; v++) { /* straight at the vertices and the edges */
        double b[3];
        for (int a = 0; a < 3; a++)
            b[a] = c[a] + 2.0 * (m.x[v][a] - c[a]);
        wrong += !tree_crosses(tree, c, b, NULL);
    }
    for (int t = 0; t < m.ntriangles; t++) {
        double b[3];
        for (int a = 0; a < 3; a++)
            b[a] = m.x[m.vertex[t][0]][a] + m.x[m.vertex[t][1]][a] - c[a];
        wrong += !tree_crosses(tree, c, b, NULL);
    }
    assert_int_equal(wrong, 0);
    FREE(tree);
    trimesh_free(&m);
}

/* A turned, shifted box: its volume, centre and inertia are known. */
TEST(solids_are_those_of_a_box)
{
    const double lo[3] = {-0.5, -1.0, -1.5}, hi[3] = {0.5, 1.0, 1.5}, shift[3] = {500, -300, 20};
    const double q = 0.6, c = cos(q), s = sin(q);
    const double Q[3][3] = {{c, -s, 0}, {s * c, c * c, -s}, {s * s, s * c, c}};
    const double D[3] = {6.0 / 12.0 * (4 + 9), 6.0 / 12.0 * (1 + 9), 6.0 / 12.0 * (1 + 4)};
    struct trimesh m = trimesh_box(lo, hi, 2);
    for (int v = 0; v < m.nvertices; v++) {
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = vec3_dot(Q[a], m.x[v]) + shift[a];
        memcpy(m.x[v], x, sizeof x);
    }
    const struct trimesh_solid b = trimesh_solid(&m, -1);
    assert_close(trimesh_area(&m), 22.0, 1e-10);
    assert_close(b.volume, 6.0, 1e-10);
    for (int i = 0; i < 3; i++) {
        assert_close(b.centre[i], shift[i], 1e-10);
        for (int k = 0; k < 3; k++) {
            double want = 0.0;
            for (int e = 0; e < 3; e++)
                want += Q[i][e] * D[e] * Q[k][e];
            assert_close(b.inertia[i][k], want, 1e-10);
        }
    }
    trimesh_turn(&m, -1);
    assert_close(trimesh_solid(&m, -1).volume, -6.0, 1e-10);
    trimesh_free(&m);
}

/* Inscribed spheres fall short at second order; a prism has the volume of its base. */
TEST(builders_close_their_solids)
{
    const double o[3] = {1, 2, 3}, lo[3] = {0, 0, 0}, hi[3] = {1, 2, 3};
    const double L[6][2] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
    double before = 0.0;
    for (int k = 0; k < 5; k++) {
        struct trimesh m = trimesh_sphere(o, 2.0, k);
        const double error = 1.0 - trimesh_solid(&m, -1).volume / (32.0 / 3.0 * M_PI);
        assert_true(m.closed && m.nparts == 1 && m.clashes == 0);
        assert_int_equal(m.ntriangles, 20 * (1 << 2 * k));
        assert_int_equal(m.nvertices, 2 + m.ntriangles / 2); /* Euler */
        assert_true(error > 0.0);
        if (k > 1)
            assert_close(before / error, 4.0, 0.3);
        before = error;
        trimesh_free(&m);
    }
    for (int n = 1; n < 6; n++) {
        struct trimesh m = trimesh_box(lo, hi, n);
        assert_true(m.closed && m.clashes == 0);
        assert_int_equal(m.ntriangles, 12 * n * n);
        assert_close(trimesh_solid(&m, -1).volume, 6.0, 1e-12);
        trimesh_free(&m);
    }
    struct trimesh m = trimesh_prism(6, L, -1.0, 1.5);
    assert_true(m.closed && m.clashes == 0);
    assert_close(trimesh_solid(&m, -1).volume, 15.0, 1e-12);
    trimesh_free(&m);
}

/* Two boxes, one of them open: parts, rims, and two that share an edge: a junction. */
TEST(parts_rims_and_junctions_are_counted)
{
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1}, far_lo[3] = {3, 0, 0}, far_hi[3] = {4, 1, 1};
    struct trimesh m = trimesh_box(lo, hi, 1), more = trimesh_box(far_lo, far_hi, 2);
    more.ntriangles--;
    trimesh_append(&m, &more);
    trimesh_connect(&m);
    assert_int_equal(m.nparts, 2);
    assert_int_equal(m.rims, 3);
    assert_false(m.closed);
    assert_close(trimesh_solid(&m, 0).volume, 1.0, 1e-12);
    trimesh_free(&more);
    trimesh_free(&m);
    const double x[5][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
    const int v[3][3] = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    m = from_lists(5, x, 3, v);
    assert_int_equal(m.junctions, 1);
    trimesh_free(&m);
    m = from_lists(5, x, 2, v);
    assert_int_equal(m.clashes, 1);
    trimesh_free(&m);
}

/* test_wall_shadow.c - what triangles hide of others and of the planes beyond edges.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/walls/wall_shadow.h"

static const double R = 0.3;
static const double origin[3] = {0.0, 0.0, 0.0};

/* The k-th of twelve triangles of the box lo, hi. */
static void triangle_of_box(int k, const double *lo, const double *hi, double (*v)[3])
{
    const int a = k / 4, b = (a + 1) % 3, c = (a + 2) % 3;
    for (int i = 0; i < 3; i++) {
        const int corner = i == 0 ? 0 : i + k % 2; /* 0 1 2, 0 2 3 */
        v[i][a] = k / 2 % 2 ? hi[a] : lo[a];
        v[i][b] = corner == 1 || corner == 2 ? hi[b] : lo[b];
        v[i][c] = corner >= 2 ? hi[c] : lo[c];
    }
}

/* What a box around the point hides of a polygon; lid: all of its triangles but those of one side.
 */
static struct wall_integrals hidden_by_box(const double *lo, const double *hi, bool lid, int n,
                                           double (*y)[3])
{
    struct wall_integrals sum = {0};
    for (int k = lid ? 2 : 0; k < 12; k++) {
        struct shadow_caster c;
        double v[3][3];
        triangle_of_box(k, lo, hi, v);
        assert_true(shadow_caster_of(v, &c));
        shadow_add(&c, n, y, R, &sum);
    }
    return sum;
}

static struct wall_integrals of_triangle(double (*v)[3])
{
    struct facet_batch b = {.n = 0};
    struct wall_integrals sum = {0};
    const struct facet f = facet_of(v[0], v[1], v[2]);
    facet_ask(&b, &f, origin, R, &sum);
    facet_finish(&b);
    return sum;
}

static void assert_alike(const struct wall_integrals *a, const struct wall_integrals *b)
{
    assert_close(a->gamma, b->gamma, 2e-5); /* by points, where triangles are small */
    assert_close(a->W * R, b->W * R, 2e-5);
    for (int k = 0; k < 3; k++)
        assert_close(a->e[k], b->e[k], 2e-5);
}

/* A triangle far enough on all sides that the box, whose corners are nearer, is before it. */
static void any_triangle_beyond(double least, double (*v)[3])
{
    const int axis = rand() % 3;
    const double way = rand() % 2 ? 1.0 : -1.0;
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++)
            v[k][a] = a == axis ? way * random_in(least, R) : random_in(-R, R);
}

TEST(a_box_hides_all_beyond_it)
{
    for (int k = 0; k < 200; k++) {
        double lo[3], hi[3], v[3][3];
        for (int a = 0; a < 3; a++) {
            lo[a] = random_in(-0.2, -0.05) * R;
            hi[a] = random_in(0.05, 0.2) * R;
        }
        any_triangle_beyond(0.21 * R, v);
        const struct wall_integrals is = of_triangle(v), sum = hidden_by_box(lo, hi, false, 3, v);
        assert_alike(&is, &sum);
    }
}

TEST(what_is_before_is_not_hidden)
{
    for (int k = 0; k < 200; k++) {
        const double lo[3] = {-R, -R, -R}, hi[3] = {R, R, R};
        double v[3][3];
        for (int i = 0; i < 9; i++)
            v[i / 3][i % 3] = random_in(-0.9, 0.9) * R;
        const struct wall_integrals sum = hidden_by_box(lo, hi, false, 3, v);
        assert_true(sum.W == 0.0 && sum.gamma == 0.0);
    }
}

/* A box without one side hides what an open box does: from a plane beyond the open side, all but
 * the cone through the opening, which the side itself would hide. */
TEST(parts_add_up)
{
    for (int k = 0; k < 100; k++) {
        double lo[3], hi[3], v[3][3], door[3][3];
        struct wall_integrals parts, whole;
        for (int a = 0; a < 3; a++) {
            lo[a] = random_in(-0.3, -0.1) * R;
            hi[a] = random_in(0.1, 0.3) * R;
        }
        for (int i = 0; i < 3; i++) {
            v[i][0] = random_in(-1.0, -0.31) * R;
            v[i][1] = random_in(-R, R);
            v[i][2] = random_in(-R, R);
        }
        whole = of_triangle(v);
        parts = hidden_by_box(lo, hi, true, 3, v);
        assert_true(fabs(parts.W) <= whole.W * (1.0 + 1e-9) + 1e-6 / R);
        for (int i = 0; i < 2; i++) {
            struct shadow_caster c;
            triangle_of_box(i, lo, hi, door);
            assert_true(shadow_caster_of(door, &c));
            shadow_add(&c, 3, v, R, &parts);
        }
        assert_alike(&parts, &whole);
    }
}

TEST(the_plane_beyond_an_edge_is_hidden_with_it)
{
    for (int k = 0; k < 200; k++) {
        const double lo[3] = {-0.1 * R, -0.1 * R, -0.1 * R}, hi[3] = {0.1 * R, 0.1 * R, 0.1 * R};
        double v[3][3], y[4][3];
        any_triangle_beyond(0.11 * R, v);
        const struct facet f = facet_of(v[0], v[1], v[2]);
        shadow_beyond(v[0], v[1], R, y);
        const struct wall_integrals sum = hidden_by_box(lo, hi, false, 4, y);
        assert_close(sum.W * R, facet_rim(&f, 0, origin, R) * R, 2e-5);
    }
}

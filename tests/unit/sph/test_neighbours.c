/* test_neighbours.c - the list against a search over all pairs.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/vec.h"
#include "sph_toy.h"

static double distance2(const struct sph *s, int i, int j)
{
    double r2 = 0.0;
    for (int a = 0; a < s->dim; a++) {
        const double d = s->p.prim[PRIM * i + a] - s->p.prim[PRIM * j + a];
        r2 += d * d;
    }
    return r2;
}

/* Row i holds every other particle within reach once: locals ascending, then ghosts, then dummies.
 */
static void check_row(const struct sph *s, int i)
{
    const struct neighbours *l = s->list;
    const double reach = s->R + s->lists.skin;
    const int *j = l->j + l->start[i], total = s->p.n + s->p.nghost;
    int wanted = 0, before = 0;
    for (int k = 0; k < total; k++) {
        const bool near = k != i && distance2(s, i, k) < reach * reach;
        wanted += near;
        before += near && k < i;
    }
    assert_int_equal(l->count[i], wanted);
    assert_int_equal(l->tail[i], before);
    for (int k = 0; k < wanted; k++) {
        assert_true(j[k] >= 0 && j[k] < total && j[k] != i);
        assert_true(distance2(s, i, j[k]) < reach * reach);
        for (int m = k + 1; m < wanted; m++)
            assert_true(j[m] != j[k]);
        if (k > 0 && j[k] < s->p.n)
            assert_true(j[k] > j[k - 1]);
        assert_true(k == 0 || j[k - 1] < s->p.n || j[k] >= s->p.n);
    }
    for (int k = 0; k < LANES - 1; k++)
        assert_int_equal(j[wanted + k], s->p.capacity);
    assert_true(l->start[i + 1] >= l->start[i] + wanted + LANES - 1);
}

static void check_list(const struct sph *s)
{
    int64_t pairs = 0;
    assert_int_equal(s->list->n, s->p.n);
    for (int i = 0; i < s->p.n; i++) {
        check_row(s, i);
        for (int j = 0; j < s->p.n + s->p.nghost; j++)
            pairs += j != i && distance2(s, i, j) < s->R * s->R;
    }
    assert_true(neighbours_pairs(s) == pairs);
}

TEST(rows_hold_all_pairs)
{
    for (int dim = 2; dim <= 3; dim++)
        for (double R_dx = 2.0; R_dx < 5.0; R_dx += 1.3) {
            struct toy t;
            toy_create(&t, dim, dim == 2 ? 23 : 9, R_dx, 0.4);
            toy_prepare(&t);
            check_list(&t.s);
            toy_free(&t);
        }
}

TEST(ghosts_are_in_the_tail)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t, all;
        toy_create(&all, dim, dim == 2 ? 20 : 9, 2.6, 0.3);
        toy_prepare(&all);
        toy_create(&t, dim, dim == 2 ? 20 : 9, 2.6, 0.3);
        toy_split(&t, &all, 0.6);
        assert_true(t.s.p.nghost > 0 && t.s.p.n > 0);
        check_list(&t.s);
        toy_free(&t);
        toy_free(&all);
    }
}

TEST(sorting_keeps_every_particle)
{
    struct toy t;
    toy_create(&t, 2, 30, 3.0, 0.5);
    const int n = t.s.p.n;
    double before[2] = {0.0, 0.0}, after[2] = {0.0, 0.0};
    for (int i = 0; i < n; i++) /* the id follows its row */
        before[i % 2] += (double)t.s.p.id[i] * t.s.p.y[6 * i] * (i % 2 ? 1.0 : t.s.p.y[6 * i + 5]);
    for (int i = 0; i < n; i++)
        t.s.p.zone[i] = (unsigned char)(t.s.p.id[i] % 2);
    neighbours_sort(&t.s);
    for (int i = 0; i < n; i++) {
        const int k = (int)(t.s.p.id[i] % 2);
        assert_int_equal(t.s.p.zone[i], k);
        after[k] += (double)t.s.p.id[i] * t.s.p.y[6 * i] * (k ? 1.0 : t.s.p.y[6 * i + 5]);
    }
    assert_close(before[0], after[0], 1e-6 * fabs(before[0]));
    assert_close(before[1], after[1], 1e-9 * fabs(before[1]));
    toy_free(&t);
}

/* A second sort of sorted particles changes nothing: the order is a function of the cells. */
TEST(sorting_is_stable)
{
    struct toy t;
    toy_create(&t, 3, 8, 2.5, 0.3);
    neighbours_sort(&t.s);
    int64_t *id = NEW(int64_t, t.s.p.n);
    memcpy(id, t.s.p.id, (size_t)t.s.p.n * sizeof *id);
    neighbours_sort(&t.s);
    assert_memory_equal(id, t.s.p.id, (size_t)t.s.p.n * sizeof *id);
    mem_free(id);
    toy_free(&t);
}

TEST(few_or_far_particles_are_no_trouble)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct toy t;
        toy_create(&t, dim, 7, 2.5, 0.3);
        t.s.p.y[0] = 1e9; /* flown away: must not cost memory */
        toy_prepare(&t);
        check_list(&t.s);
        t.s.p.y[1] = NAN;
        toy_prepare(&t);
        t.s.p.n = 1;
        toy_prepare(&t);
        t.s.p.n = 0;
        toy_prepare(&t);
        assert_true(neighbours_pairs(&t.s) == 0);
        toy_free(&t);
    }
}

/* test_domain.c - every particle has one owner, ghosts are what a search over all images finds.
 * ranks: 1 2 4. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/neighbours.h"
#include "../../../sph/parallel/domain.h"
#include "sph_case.h"

/* Deterministic number in [0, 1). */
static double noise(int64_t k)
{
    const double v = sin((double)k * 12.9898 + 4.1) * 43758.5453;
    return v - floor(v);
}

/* Particles far from their lattice, each labelled by its volume. */
static void scatter(struct sph *s, double distance)
{
    const int dim = s->dim;
    for (int i = 0; i < s->p.n; i++) {
        double *y = s->p.y + (size_t)i * s->p.nstate;
        for (int a = 0; a < dim; a++) {
            y[a] += distance * (2.0 * noise(3 * s->p.id[i] + a) - 1.0);
            y[dim + a] = 0.0;
        }
        y[2 * dim] = 1.0 + (double)s->p.id[i];
        y[2 * dim + 1] = y[2 * dim] * s->rho0;
    }
}

static void start(struct sph_case *c, int dim, int cells, bool open_y)
{
    sph_case_set(c, dim, cells);
    c->run.scene.domain.periodic[1] = !open_y;
    sph_case_start(c, NULL);
    scatter(c->s, 0.2);
    domain_migrate(c->s);
}

static long misplaced(const struct sph *s)
{
    double lo[3], hi[3];
    long bad = 0;
    domain_bounds(s->domain, lo, hi);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        bad += domain_owner(s->domain, y) != s->run->rank;
        bad += y[2 * s->dim] != 1.0 + (double)s->p.id[i];
        for (int a = 0; a < s->dim; a++)
            bad += s->periodic[a] && !(y[a] >= lo[a] && y[a] < hi[a]);
    }
    return bad;
}

TEST(particles_reach_their_owners)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct sph_case c;
        start(&c, dim, dim == 2 ? 40 : 12, dim == 3);
        const int64_t all = dim == 2 ? 1600 : 1728;
        int64_t sum[2] = {c.s->p.n, 0};
        for (int i = 0; i < c.s->p.n; i++)
            sum[1] += c.s->p.id[i];
        MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
        assert_int_equal(sum[0], all);
        assert_int_equal(sum[1], all * (all - 1) / 2);
        assert_true(none_anywhere(misplaced(c.s)));
        DROP(c.s);
    }
}

/* x, y, z, label of all particles on all ranks. */
static double *gather_places(const struct sph *s, int *n)
{
    int size = s->run->size, mine = 4 * s->p.n, *count = NEW(int, 2 * size);
    MPI_Allgather(&mine, 1, MPI_INT, count, 1, MPI_INT, MPI_COMM_WORLD);
    int total = 0;
    for (int r = 0; r < size; r++) {
        count[size + r] = total;
        total += count[r];
    }
    double *own = NEW(double, mine), *all = NEW(double, total);
    for (int i = 0; i < s->p.n; i++) {
        const double *y = s->p.y + (size_t)i * s->p.nstate;
        memcpy(own + 4 * i, y, (size_t)s->dim * sizeof(double));
        own[4 * i + 3] = y[2 * s->dim];
    }
    MPI_Allgatherv(own, mine, MPI_DOUBLE, all, count, count + size, MPI_DOUBLE, MPI_COMM_WORLD);
    FREE(own, count);
    *n = total / 4;
    return all;
}

static int ascending(const void *a, const void *b)
{
    const double *p = a, *q = b;
    const int order[4] = {3, 0, 1, 2};
    for (int k = 0; k < 4; k++)
        if (p[order[k]] != q[order[k]])
            return p[order[k]] < q[order[k]] ? -1 : 1;
    return 0;
}

/* All images within reach of this rank's part, but its own particles themselves. */
static double *expected_ghosts(const struct sph *s, int *n)
{
    int all, found = 0;
    double *x = gather_places(s, &all), *out = NEW(double, 4 * 27 * all), lo[3], hi[3];
    domain_bounds(s->domain, lo, hi);
    for (int i = 0; i < all; i++)
        for (int k = 0; k < 27; k++) {
            const int shift[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
            double y[4] = {0.0, 0.0, 0.0, x[4 * i + 3]}, r2 = 0.0;
            bool legal = true;
            for (int a = 0; a < 3; a++) {
                const bool open = a >= s->dim || !s->periodic[a];
                legal = legal && (shift[a] == 0 || !open);
                y[a] = x[4 * i + a] + shift[a];
                double out_by = fmax(fmax(lo[a] - y[a], y[a] - hi[a]), 0.0);
                if (open && ((y[a] < s->lo[a] && lo[a] <= s->lo[a]) ||
                             (y[a] > s->hi[a] && hi[a] >= s->hi[a])))
                    out_by = 0.0;
                r2 += out_by * out_by;
            }
            const bool own = k == 13 && domain_owner(s->domain, x + 4 * i) == s->run->rank;
            if (legal && !own && r2 <= (s->R + s->lists.skin) * (s->R + s->lists.skin))
                memcpy(out + 4 * found++, y, sizeof y);
        }
    mem_free(x);
    qsort(out, (size_t)found, 4 * sizeof(double), ascending);
    *n = found;
    return out;
}

static double *actual_ghosts(const struct sph *s)
{
    double *out = NEW(double, 4 * (s->p.nghost + 1));
    for (int k = 0; k < s->p.nghost; k++) {
        const double *q = s->p.prim + (size_t)PRIM * (s->p.n + k);
        memcpy(out + 4 * k, q, (size_t)s->dim * sizeof(double));
        out[4 * k + 3] = q[2 * s->dim];
    }
    qsort(out, (size_t)s->p.nghost, 4 * sizeof(double), ascending);
    return out;
}

TEST(ghosts_are_all_images_within_reach)
{
    for (int k = 0; k < 4; k++) {
        struct sph_case c;
        start(&c, k < 2 ? 2 : 3, k < 2 ? 40 : 12, k % 2 == 1);
        int n;
        particles_lines(c.s);
        domain_ghosts(c.s);
        double *want = expected_ghosts(c.s, &n), *have = actual_ghosts(c.s);
        long bad = n != c.s->p.nghost;
        for (int i = 0; !bad && i < 4 * n; i++)
            bad += fabs(want[i] - have[i]) > 1e-15;
        assert_true(none_anywhere(bad));
        FREE(want, have);
        DROP(c.s);
    }
}

TEST(halo_brings_the_owners_values)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct sph_case c;
        start(&c, dim, dim == 2 ? 40 : 12, false);
        struct particles *p = &c.s->p;
        long bad = 0;
        particles_lines(c.s);
        domain_ghosts(c.s);
        for (int i = 0; i < p->n; i++) {
            const double label = p->prim[PRIM * i + 2 * dim];
            p->prim[PRIM * i + 2 * dim + 1] = 3.0 * label;
            for (int k = 0; k < p->nslope; k++)
                p->slope[p->nslope * i + k] = label + 0.5 * k;
        }
        domain_halo_start(c.s, false);
        domain_halo_finish(c.s, false);
        domain_halo_start(c.s, true);
        domain_halo_finish(c.s, true);
        for (int i = p->n; i < p->n + p->nghost; i++) {
            const double label = p->prim[PRIM * i + 2 * dim];
            bad += p->prim[PRIM * i + 2 * dim + 1] != 3.0 * label;
            for (int k = 0; k < p->nslope; k++)
                bad += p->slope[p->nslope * i + k] != label + 0.5 * k;
        }
        assert_true(none_anywhere(bad));
        DROP(c.s);
    }
}

TEST(balance_evens_out_a_crowd)
{
    struct sph_case c;
    start(&c, 2, 40, true);
    for (int i = 0; i < c.s->p.n; i++)
        c.s->p.y[i * c.s->p.nstate] *= 0.25 * c.s->p.y[i * c.s->p.nstate];
    domain_migrate(c.s);
    const bool cut = domain_balance(c.s, 0.1);
    assert_int_equal(cut, c.run.size > 1);
    domain_migrate(c.s);
    assert_true(none_anywhere(misplaced(c.s)));
    assert_true(max_anywhere(c.s->p.n) <= 1.1 * 1600 / c.run.size);
    assert_false(domain_balance(c.s, 0.1));
    DROP(c.s);
}

/* Three times as dense at one end as at the other: the list, not the number, tells the work. */
TEST(balance_evens_out_the_pairs)
{
    struct sph_case c;
    start(&c, 2, 60, true);
    for (int i = 0; i < c.s->p.n; i++) {
        double *x = c.s->p.y + i * c.s->p.nstate;
        *x = 0.5 * *x * (1.0 + *x);
    }
    integrate_prepare(c.s);
    const bool cut = domain_balance(c.s, 0.03);
    assert_int_equal(cut, c.run.size > 1);
    integrate_prepare(c.s);
    double listed = 0.0;
    for (int i = 0; i < c.s->p.n; i++)
        listed += c.s->list->count[i];
    const double most = max_anywhere(listed);
    MPI_Allreduce(MPI_IN_PLACE, &listed, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    assert_true(most <= 1.06 * listed / c.run.size);
    DROP(c.s);
}

/* A position that is no number along a period must not become a sound one. */
TEST(what_is_not_finite_keeps_its_mark)
{
    const double broken[2] = {NAN, INFINITY};
    for (int k = 0; k < 2; k++) {
        struct sph_case c;
        start(&c, 2, 20, true);
        int marked = 0;
        for (int i = 0; i < c.s->p.n; i++)
            if (c.s->p.id[i] == 7)
                state_row(&c.s->p, c.s->p.y, i)[0] = broken[k];
        domain_migrate(c.s);
        for (int i = 0; i < c.s->p.n; i++) {
            const double *y = state_row(&c.s->p, c.s->p.y, i);
            assert_true(isfinite(y[0]));
            marked += c.s->p.id[i] == 7 && isnan(y[c.s->dim]);
        }
        MPI_Allreduce(MPI_IN_PLACE, &marked, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        assert_int_equal(marked, 1);
        DROP(c.s);
    }
}

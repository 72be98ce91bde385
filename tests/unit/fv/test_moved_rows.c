/* test_moved_rows.c - what passes between FV's rows of unequal height and a partner: the even rows
 * that it is given below them, the points where it is asked for the values of tall cells. ranks:
 * 1 2. SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/coupling/forced_points.h"
#include "../../../fv/coupling/patch.h"
#include "fv_case.h"

static const double box[2][3] = {{0.25, 0.1, 0.0}, {0.75, 0.6, 0.0}};

static struct fv *start(struct fv_case *c)
{
    fv_case_set(c, MPI_COMM_WORLD,
                (const char *const[]){"domain.periodic=(true,false)", "fv.cells=(16,28)",
                                      "fv.graded=(0.5,16)", NULL});
    struct fv *s = fv_case_start(c, NULL);
    s->forcing = mem_own(s, forcing_create(s, 1, &box, true));
    return s;
}

/* Average of y^3 from a to b. */
static double cube(double a, double b) { return (b * b * b * b - a * a * a * a) / (4.0 * (b - a)); }

TEST(even_rows_go_on_below)
{
    struct fv_case c;
    struct fv *s = start(&c);
    const struct block *b = &s->b;
    struct patch p;
    double x[3], h[3];
    int64_t n = 0, all = 0;
    assert_true(patch_create(s, 1, &box, &box, &p, x));
    assert_non_null(p.blend);
    double *f = block_field(b), *to = NEW(double, p.n);
    for (int j = 0; j < b->n[1]; j++)
        for (int i = 0; i < b->n[0]; i++) {
            block_cell(b, i, j, 0, x, h);
            f[block_at(b, i, j, 0)] = cube(x[1] - 0.5 * h[1], x[1] + 0.5 * h[1]);
        }
    patch_look(s, &p, f, to);
    for (int64_t i = 0; i < p.n; i++) {
        patch_centre(&p, i, x);
        assert_true(fabs(to[i] - cube(x[1] - 0.5 * p.h[1], x[1] + 0.5 * p.h[1])) < 1e-12);
    }
    n = p.n;
    MPI_Allreduce(&n, &all, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_int_equal(all, 16 * 32);
    FREE(f, to, p.blend);
    const double high[2][3] = {{0.25, 0.6, 0.0}, {box[1][0], box[1][1], box[1][2]}};
    patch_create(s, 1, &high, &box, &p, x);
    assert_null(p.blend); /* even rows alone are looked at */
    FREE(p.blend);
    fv_free(&c.s);
}

/* The mean over the points, each the average over a cell of h, of y^2 is that over the cell. */
TEST(tall_cells_are_asked_at_several_places)
{
    struct fv_case c;
    struct fv *s = start(&c);
    const struct forcing *f = s->forcing;
    const double k = s->b.h[1];
    struct forced_points p = forced_points_create(s, NULL, k);
    double *v = NEW(double, p.n), *to = NEW(double, p.ncells), h[3], x[3];
    unsigned char *mask = NEW(unsigned char, p.n), *has = NEW(unsigned char, p.ncells);
    int64_t divided = 0;
    for (int64_t i = 0; i < p.n; i++) {
        v[i] = p.x[3 * i + 1] * p.x[3 * i + 1] + k * k / 12.0;
        mask[i] = 1;
    }
    forced_points_mean(&p, 1, v, mask, to, has);
    for (int64_t i = 0; i < p.ncells; i++) {
        int at[3];
        block_place(&s->b, f->partner[i], at);
        block_cell(&s->b, at[0], at[1], at[2], x, h);
        const int64_t n = p.first[i + 1] - p.first[i];
        divided += n > 1;
        assert_int_equal(n, (int)fmax(1.0, ceil(h[1] / k - 1e-6)));
        if (n > 1)
            assert_true(fabs(to[i] - x[1] * x[1] - h[1] * h[1] / 12.0) < 1e-13);
        assert_true(has[i]);
    }
    MPI_Allreduce(MPI_IN_PLACE, &divided, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_true(divided > 0);
    for (int64_t i = 0; i < p.n; i++)
        mask[i] = i > p.first[p.ncells / 2]; /* what is not seen does not count */
    forced_points_mean(&p, 1, v, mask, to, has);
    assert_true(p.ncells == 0 || !has[0]);
    FREE(v, to, mask, has, p.first, p.x, p.id);
    fv_free(&c.s);
}

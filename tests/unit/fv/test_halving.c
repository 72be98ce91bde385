/* test_halving.c - the cycle for the pressure under a surface: a symmetric map, as good on fine
 * grids as on coarse ones, the same on all ranks. ranks: 1 2 4.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../fv/poisson/halving.h"

/* A problem: -Lap with 0 on the surface of some water, no flux through closed sides. */
struct water {
    struct block b;
    struct halving *h;
    double *own, *through[3];
};

/* A number between 0 and 1 that hangs on a cell alone. */
static double noise(const struct block *b, const int *i, int seed)
{
    const unsigned n = (unsigned)(i[0] + b->lo[0]) * 7919u + (unsigned)(i[1] + b->lo[1]) * 104729u +
                       (unsigned)(i[2] + b->lo[2]) * 1299709u + (unsigned)seed * 15485863u;
    return (double)((n * 2654435761u) >> 8) / (double)(1u << 24);
}

/* Whether a cell lies beyond a side along axis a. */
static bool is_closed(const struct block *b, const int *i, int a)
{
    const int at = i[a] + b->lo[a];
    return at < 0 || at >= b->cells[a];
}

/* A wave beside a drop; nothing beyond closed sides. */
static bool is_wet(const struct block *b, const int *i)
{
    double x[3];
    block_centre(b, i[0], i[1], i[2], x);
    for (int a = 0; a < b->dim; a++)
        if (is_closed(b, i, a))
            return false;
    x[1] /= b->length[1];
    const double r = hypot(x[0] - 0.7, x[1] - 0.85);
    return x[1] < 0.4 + 0.2 * sin(6.283185307179586 * (x[0] + x[2])) || r < 0.08;
}

/* What a wet cell has through its faces, and on the surface, at 0.01 to 1 of a cell. */
static void add_cell(struct water *w, const int *i, int64_t c)
{
    const struct block *b = &w->b;
    for (int a = 0; a < b->dim; a++)
        for (int up = 0; up < 2; up++) {
            int beside[3] = {i[0], i[1], i[2]};
            beside[a] += up ? 1 : -1;
            const double g = 1.0 / (b->h[a] * b->h[a]);
            if (is_wet(b, beside))
                w->through[a][c + up * b->stride[a]] = g;
            else if (!is_closed(b, beside, a))
                w->own[c] += g / (0.01 + 0.99 * noise(b, i, 2 * a + up));
        }
}

static void make(struct water *w, MPI_Comm comm, int dim, int n, double flat)
{
    const int cells[3] = {n, n + 6, dim == 3 ? n - 4 : 1};
    const double origin[3] = {0.0, 0.0, 0.0}, length[3] = {1.0, flat, dim == 3 ? 1.0 : 0.0};
    static const bool periods[3] = {false, false, false};
    block_create(&w->b, comm, dim, cells, origin, length, periods);
    w->h = halving_create(&w->b);
    halving_begin(w->h);
    w->own = halving_own(w->h);
    for (int a = 0; a < dim; a++)
        w->through[a] = halving_through(w->h, a);
    BLOCK_CELLS (&w->b, i, j, k, c) {
        const int at[3] = {i, j, k};
        int *run = halving_run(w->h, j, k);
        run[0] = 0;
        run[1] = w->b.n[0];
        if (is_wet(&w->b, at))
            add_cell(w, at, c);
    }
    halving_set_matrix(w->h);
}

static void end(struct water *w)
{
    DROP(w->h);
    block_free(&w->b);
}

static double dot(const struct water *w, const double *x, const double *y)
{
    double sum = 0.0;
    BLOCK_CELLS (&w->b, i, j, k, c)
        sum += x[c] * y[c];
    return ranks_sum(w->b.cart, sum);
}

/* Noise in wet cells. */
static double *field(const struct water *w, int seed)
{
    double *q = block_field(&w->b);
    BLOCK_CELLS (&w->b, i, j, k, c) {
        const int at[3] = {i, j, k};
        q[c] = is_wet(&w->b, at) && seed ? noise(&w->b, at, seed) - 0.5 : 0.0;
    }
    return q;
}

static void apply(const struct water *w, double *x, double *y)
{
    const struct block *b = &w->b;
    block_halo(b, 1, &x);
    BLOCK_CELLS (b, i, j, k, c) {
        y[c] = w->own[c] * x[c];
        for (int a = 0; a < b->dim; a++) {
            const int64_t d = b->stride[a];
            y[c] += w->through[a][c] * (x[c] - x[c - d]) + w->through[a][c + d] * (x[c] - x[c + d]);
        }
    }
}

/* Steps of conjugate gradients until a residual of noise is 1e-8 of itself. */
static int steps(struct water *w)
{
    double *r = field(w, 11), *z = field(w, 0), *p = field(w, 0), *q = field(w, 0), last = 0.0;
    const double start = dot(w, r, r);
    int n = 0;
    for (; n < 100 && dot(w, r, r) > 1e-16 * start; n++) {
        halving_cycle(w->h, r, z);
        const double rz = dot(w, r, z), beta = n > 0 ? rz / last : 0.0;
        BLOCK_CELLS (&w->b, i, j, k, c)
            p[c] = z[c] + beta * p[c];
        apply(w, p, q);
        const double alpha = rz / dot(w, p, q);
        BLOCK_CELLS (&w->b, i, j, k, c)
            r[c] -= alpha * q[c];
        last = rz;
    }
    FREE(r, z, p, q);
    return n;
}

TEST(the_cycle_is_symmetric)
{
    for (int k = 0; k < 4; k++) {
        struct water w = {0};
        make(&w, MPI_COMM_WORLD, 2 + k % 2, 25 - k, 1.0);
        double *r = field(&w, 3), *s = field(&w, 5), *x = field(&w, 0), *y = field(&w, 0);
        halving_cycle(w.h, r, x);
        halving_cycle(w.h, s, y);
        assert_close(dot(&w, s, x), dot(&w, r, y), 1e-12);
        assert_true(dot(&w, r, x) > 0.0);
        FREE(r, s, x, y);
        end(&w);
    }
}

/* Multigrid: cells of a quarter the size take no more cycles, but for a tenth. */
TEST(fine_grids_take_no_more_cycles)
{
    static const double flat[3] = {1.0, 0.02, 30.0};
    for (int k = 0; k < 3; k++) {
        int n[2];
        for (int fine = 0; fine < 2; fine++) {
            struct water w = {0};
            make(&w, MPI_COMM_WORLD, 2, fine ? 128 : 32, flat[k]);
            n[fine] = steps(&w);
            end(&w);
        }
        print_message("domain 1 by %g: %d and %d cycles\n", flat[k], n[0], n[1]);
        assert_true(n[1] <= 1.1 * n[0] + 1.0);
        assert_true(n[0] <= 20);
    }
}

TEST(ranks_make_no_difference)
{
    for (int dim = 2; dim <= 3; dim++) {
        double sum[2];
        for (int k = 0; k < 2; k++) {
            struct water w = {0};
            make(&w, k ? MPI_COMM_WORLD : MPI_COMM_SELF, dim, 23, 1.0);
            double *r = field(&w, 3), *x = field(&w, 0);
            halving_cycle(w.h, r, x);
            sum[k] = dot(&w, x, x);
            FREE(r, x);
            end(&w);
        }
        assert_close(sum[1], sum[0], 1e-12);
    }
}

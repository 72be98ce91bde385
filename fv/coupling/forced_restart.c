/* forced_restart.c - a partner's velocities at three times in a restart file. v (start of the
 * coupling step), v_next (its end) and v_old (before), for the imposed cells and those beside them,
 * together with the cells' numbers. The same number of ranks reads its own records, another looks
 * the numbers up.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "forced_restart.h"

#include "../../common/files/files.h"
#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"

static const char *const forced_names[3][3] = {
    {"v_x", "v_y", "v_z"}, {"w_x", "w_y", "w_z"}, {"o_x", "o_y", "o_z"}};

/* Array m (0: v, 1: v_next, 2: v_old) of component a. */
static double *forced_at(const struct forcing *f, int m, int a)
{
    return m == 0 ? f->v[a] : m == 1 ? f->v_next[a] : f->v_old[a];
}

static void save_numbers(const struct fv *s, struct h5 *f)
{
    const struct forcing *c = s->forcing;
    const int64_t n = c->npartner + c->nrim;
    int64_t *number = NEW(int64_t, n);
    for (int64_t i = 0; i < n; i++)
        number[i] = grid_number(&s->grid, c->partner[i]);
    h5_write_int(f, "forced_cells", n, number);
    mem_free(number);
}

struct numbered {
    int64_t number, row;
};

static int by_number(const void *a, const void *b)
{
    const int64_t x = ((const struct numbered *)a)->number,
                  y = ((const struct numbered *)b)->number;
    return (x > y) - (x < y);
}

/* Finds the record of each imposed cell in a file of another number of ranks: row[i] of partner[i];
 * false on all ranks if one is not there. O(n log n). */
static bool find_rows(const struct fv *s, struct h5 *f, int64_t *row)
{
    const struct forcing *c = s->forcing;
    int64_t n;
    int64_t *number = h5_read_all_int(f, "forced_cells", &n);
    struct numbered *all = mem_new((size_t)(number ? n : 0), sizeof *all);
    bool good = number != NULL;
    for (int64_t k = 0; number && k < n; k++)
        all[k] = (struct numbered){number[k], k};
    if (number)
        qsort(all, (size_t)n, sizeof *all, by_number);
    for (int64_t i = 0; good && i < c->npartner + c->nrim; i++) {
        const struct numbered key = {grid_number(&s->grid, c->partner[i]), 0};
        const struct numbered *at = bsearch(&key, all, (size_t)n, sizeof *all, by_number);
        good = at != NULL;
        row[i] = at ? at->row : 0;
    }
    FREE(all, number);
    return ranks_all(s->comm, good);
}

/* Every rank reads all records of a component at a time. */
static bool gather_forced(const struct fv *s, struct h5 *f)
{
    const struct forcing *c = s->forcing;
    int64_t *row = NEW(int64_t, c->npartner + c->nrim), n;
    bool good = find_rows(s, f, row);
    for (int k = 0; good && k < 3 * s->dim; k++) {
        double *to = forced_at(c, k / s->dim, k % s->dim);
        double *all = h5_read_all_real(f, forced_names[k / s->dim][k % s->dim], 1, &n);
        good = all != NULL;
        for (int64_t i = 0; good && i < c->npartner + c->nrim; i++)
            to[i] = all[row[i]];
        mem_free(all);
    }
    mem_free(row);
    return good;
}

/* On the same ranks the lists are the same, so rows are in order. */
static bool keep_forced(const struct fv *s, struct h5 *f)
{
    const struct forcing *c = s->forcing;
    const int64_t n = c->npartner + c->nrim;
    bool good = true;
    if (!h5_writes(f) && !layout_same_ranks(f, s->run->size))
        return gather_forced(s, f);
    for (int m = 0; m < 3; m++)
        for (int a = 0; a < s->dim; a++)
            if (h5_writes(f))
                h5_write_real(f, forced_names[m][a], "m/s", n, 1, forced_at(c, m, a), false);
            else
                good = good && h5_read_real(f, forced_names[m][a], n, 1, forced_at(c, m, a));
    return good;
}

/* The clock, t0, t1, t_old and the number of known levels, is the same on all ranks; it goes with
 * the levels, which without it would be of other times. */
bool forced_restart(const struct fv *s, struct h5 *f)
{
    struct forcing *c = s->forcing;
    double clock[4] = {c->t0, c->t1, c->t_old, c->levels};
    if (h5_writes(f))
        save_numbers(s, f);
    const bool good = h5_keep_same(f, "forced_levels", "-", 4, clock) && keep_forced(s, f);
    c->t0 = clock[0];
    c->t1 = clock[1];
    c->t_old = clock[2];
    c->levels = (int)clock[3];
    return good;
}

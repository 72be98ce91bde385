/* fv_coupling.c - FV's place in a coupled job: its free zone's partner fills a hole, and takes
 * patches of velocity and pressure with their course in time. In window_begin FV tells what it
 * expects of the window (fv_course.h), then waits for the forced velocities at its end.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../common/h5.h"
#include "../../common/log.h"
#include "../../common/mem.h"
#include "../../common/watch.h"
#include "../../coupler/cpl.h"
#include "../boundary/forcing.h"
#include "fv_course.h"
#include "../grid/layout.h"
#include "../boundary/still.h"
#include "fv_link.h"
#include "water_budget.h"
#include "../surface/levelset.h"
#include "../surface/surface_forced.h"

struct link {
    struct cpl *c;
    int grid, forced, velocity, pressure, imposed, seen;
    int budget, water; /* one point; the partner's water */
    struct water_budget of_water;
    int phi, places, filled; /* where the surface crosses into the partner's part */
    double *share;           /* of a kernel that the partner's water fills, at the places */
    struct course *course;
    double *got; /* scratch */
    double *p;   /* Pa: the partner's at the end of the window, where mask is 1 */
    unsigned char *mask;
    double datum; /* Pa: the partner's pressure over ours, mean over the rim of the free cells */
    struct watch unmapped; /* share of the cells that fluxes look at which the partner left out */
    double missing;        /* now */
    double where[3];       /* m: one of them */
};

static void check(const struct link *k, int code)
{
    if (code == CPL_EPARTNER || code == CPL_EINPUT) {
        signals_handled(); /* cpl_fail says it */
        cpl_fail(k->c, RUN_PARTNER, cpl_strerror(k->c));
    }
    if (code)
        fail("coupling: %s", cpl_strerror(k->c));
}

/* Width of the kernel whose mean has the second moment of a cell average: sqrt(6/5) h in 2D,
 * sqrt(5/4) h in 3D. A sum over particles then gives the cell's average up to fourth order. */
static double support(const struct block *b)
{
    double h = 0.0;
    for (int a = 0; a < b->dim; a++)
        h = fmax(h, b->h[a]);
    return h * sqrt(b->dim == 2 ? 1.2 : 1.25);
}

static void declare(struct fv *s, struct link *k)
{
    const struct block *b = &s->b;
    const int how = s->run->scene.coupling.mapping ? CPL_MLS : CPL_SHEPARD;
    struct cpl_grid g = {.dim = b->dim};
    for (int a = 0; a < 3; a++) {
        const int first = a == 1 && b->rows ? b->rows->even : 0;
        g.origin[a] = first > 0 ? b->rows->edge[first] : b->origin[a];
        g.spacing[a] = b->h[a];
        g.cells[a] = b->cells[a] - first;
        g.periodic[a] = b->periodic[a];
        g.lo[a] = b->lo[a] > first ? b->lo[a] - first : 0;
        g.hi[a] = b->hi[a] > first ? b->hi[a] - first : 0;
    }
    check(k, cpl_grid(k->c, "fv.cells", &g, &k->grid));
    check(k, cpl_field(k->c, k->grid, "fv.velocity", "m/s", b->dim, CPL_PUT, 0, &k->velocity));
    check(k, cpl_field(k->c, k->grid, "fv.pressure", "Pa", 1, CPL_PUT, 0, &k->pressure));
    check(k, cpl_points(k->c, "fv.forced", b->dim, support(b), &k->forced));
    check(k, cpl_field(k->c, k->forced, "sph.velocity", "m/s", b->dim, CPL_GET, how, &k->imposed));
    check(k, cpl_field(k->c, k->forced, "sph.pressure", "Pa", 1, CPL_GET, how, &k->seen));
    if (!s->surface)
        return;
    check(k, cpl_field(k->c, k->grid, "fv.phi", "m", 1, CPL_PUT, 0, &k->phi));
    check(k, cpl_points(k->c, "fv.surface", b->dim, s->surface->forced->R, &k->places));
    check(k, cpl_field(k->c, k->places, "sph.one", "-", 1, CPL_GET, CPL_SUM, &k->filled));
    check(k, cpl_points(k->c, "fv.budget", b->dim, b->h[0], &k->budget));
    check(k, cpl_field(k->c, k->budget, "sph.water", "m^dim", 1, CPL_GET, CPL_NEAREST, &k->water));
    k->of_water = water_budget_create();
}

/* All that the partner takes must lie in even rows. */
static void check_rows(const struct fv *s, const struct link *k)
{
    const struct rows *r = s->b.rows;
    const double margin = 2.0 * s->b.h[1];
    double lo[3], hi[3];
    char reason[200];
    check(k, cpl_find_zone(k->c, "sph.box", lo, hi));
    if (lo[1] >= r->edge[r->even] + margin - 1e-9 * s->b.h[1])
        return;
    snprintf(reason, sizeof reason,
             "fv.graded: even rows begin at y = %g m, sph.box at %g m: lower the first to %g m or "
             "less, two rows below the box",
             r->edge[r->even], lo[1], lo[1] - margin);
    signals_handled(); /* cpl_fail says it */
    cpl_fail(k->c, RUN_INPUT, reason);
}

void coupling_create(struct fv *s)
{
    struct link *k = s->link = NEW(struct link, 1);
    const struct block *b = &s->b;
    double lo[3], hi[3];
    k->c = s->run->partner_ctx;
    check(k, cpl_find_zone(k->c, "sph.given", lo, hi));
    check(k, cpl_find_zone(k->c, "sph.free", s->partner[0], s->partner[1]));
    s->forcing = forcing_create(s, lo, hi, true);
    if (!s->forcing) {
        signals_handled(); /* cpl_fail says it */
        cpl_fail(k->c, RUN_INPUT,
                 "no cell of fv lies wholly in the box that sph gives: refine fv.cells, enlarge "
                 "sph.box or lower coupling.overlap");
    }
    int first = 0; /* row */
    double memory[3];
    if (b->rows) {
        check_rows(s, k);
        first = b->rows->even - b->lo[1];
        first = first < 0 ? 0 : first > b->n[1] ? b->n[1] : first;
    }
    if (s->surface) {
        s->surface->forced = surface_forced_create(s);
        k->share = NEW(double, s->surface->forced->nplaces);
    }
    declare(s, k);
    check(k, cpl_find_zone(k->c, "sph.memory", memory, memory));
    k->course = course_create(s, first, (int)memory[0]);
    const int64_t most = s->forcing ? s->forcing->npartner + s->forcing->nrim : 0;
    k->got = NEW(double, most * b->dim);
    k->p = NEW(double, most);
    k->unmapped = (struct watch){
        .key = "unmapped_cells",
        .what = "share of the cells at sph's edge that hold no particle of sph",
        .likely = "its surface or a void has come to where fv looks: set the open sides of sph.box "
                  "deeper into the water, or lower coupling.overlap; cells of fv finer than sph.dx "
                  "want coarser fv.cells",
        .warn = 0.05,
        .stop = 0.25};
    k->mask = NEW(unsigned char, most);
}

void coupling_free(struct fv *s)
{
    struct link *k = s->link;
    course_free(&k->course);
    mem_free(k->got);
    mem_free(k->p);
    mem_free(k->mask);
    mem_free(k->share);
    mem_free(k);
    s->link = NULL;
}

double coupling_datum(const struct fv *s) { return s->link ? s->link->datum : 0.0; }

/* A flow of constant density knows its pressure up to a constant: the partner has it. */
static void find_datum(struct fv *s)
{
    struct link *k = s->link;
    const struct forcing *f = s->forcing;
    double sum[2] = {0.0, 0.0}, x[3];
    for (int64_t i = f->npartner; i < f->npartner + f->nrim; i++) {
        int at[3];
        if (!k->mask[i])
            continue;
        block_place(&s->b, f->partner[i], at);
        block_centre(&s->b, at[0], at[1], at[2], x);
        sum[0] += k->p[i] - fv_pressure(s, f->partner[i]) - fv_still_pressure(s, x);
        sum[1] += 1.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->b.cart);
    k->datum = sum[1] > 0.0 ? sum[0] / sum[1] : k->datum;
}

static void put(struct fv *s)
{
    struct link *k = s->link;
    struct course *c = k->course;
    const double *const *term = (const double *const *)c->term;
    int n = course_velocity(c);
    check(k, cpl_put_course(k->c, k->velocity, s->t, c->n, n, term));
    n = course_pressure(c);
    check(k, cpl_put_course(k->c, k->pressure, s->t, c->n, n, term));
    if (!s->surface)
        return;
    n = course_surface(c);
    check(k, cpl_put_course(k->c, k->phi, s->t, c->n, n, term));
}

/* Forced values of the start, and before it where an exact solution knows them. */
static void start_forced(struct fv *s, double before)
{
    const struct block *b = &s->b;
    struct forcing *f = s->forcing;
    double x[3], u[3];
    f->t1 = s->t;
    f->t0 = s->t - before;
    f->t_old = s->t - 2.0 * before;
    const bool past = exact_has_past(&s->exact) && s->has_exact;
    f->levels = past ? 3 : 1;
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        int at[3];
        block_place(b, f->partner[i], at);
        block_centre(b, at[0], at[1], at[2], x);
        for (int m = 0; m < 3; m++) {
            double *const *v = m == 0 ? f->v_next : m == 1 ? f->v : f->v_old;
            if (m > 0 && past)
                exact_average(&s->exact, x, b->h, s->t - m * before, u, NULL, NULL);
            for (int a = 0; a < b->dim; a++)
                v[a][i] = m > 0 && past ? u[a] : s->u[a][f->partner[i]];
        }
    }
}

/* Number in the whole grid of a cell with this local index. */
static int64_t number_of(const struct block *b, int64_t c)
{
    int at[3];
    block_place(b, c, at);
    return (b->lo[0] + at[0]) +
           (int64_t)b->cells[0] * ((b->lo[1] + at[1]) + (int64_t)b->cells[1] * (b->lo[2] + at[2]));
}

/* Which cells take the partner's values, once; then the first patch. */
void coupling_first(void *state)
{
    struct fv *s = state;
    struct link *k = s->link;
    const struct block *b = &s->b;
    const struct forcing *f = s->forcing;
    const int64_t n = f ? f->npartner + f->nrim : 0;
    double *x = NEW(double, 3 * n);
    int64_t *id = NEW(int64_t, n);
    for (int64_t m = 0; m < n; m++) {
        const int64_t c = f->partner[m];
        int at[3];
        block_place(b, c, at);
        block_centre(b, at[0], at[1], at[2], x + 3 * m);
        id[m] = number_of(b, c);
    }
    check(k, cpl_move(k->c, k->forced, n, x, id, NULL));
    if (s->surface) {
        const struct surface_forced *w = s->surface->forced;
        const double at[3] = {s->partner[0][0], s->partner[0][1], s->partner[0][2]};
        check(k, cpl_move(k->c, k->places, w->nplaces, w->x, NULL, NULL));
        check(k, cpl_move(k->c, k->budget, 1, at, NULL, NULL));
    }
    mem_free(x);
    mem_free(id);
    if (!s->run->restart) {
        const double before = s->exact.U > 0.0 ? 1e-3 * s->exact.L / s->exact.U : 1e-3;
        if (f)
            start_forced(s, before);
        course_start(s, k->course, before);
    }
}

/* Cells without a particle near them keep their values. Two layers of the hole and the rim make the
 * fluxes of its outline: there it matters. */
static void count_missing(struct fv *s)
{
    struct link *k = s->link;
    const struct forcing *f = s->forcing;
    struct {
        double n;
        int rank;
    } most = {0.0, s->run->rank};
    double sum[2] = {0.0, 0.0};
    for (int64_t i = 0; i < f->npartner + f->nrim; i++) {
        const int64_t c = f->partner[i];
        if (f->layer[c] > 2 || (s->surface && s->surface->forced->phi[1][c] > -0.5 * s->b.h[0]))
            continue;
        sum[1] += 1.0;
        if (!k->mask[i]) {
            int at[3];
            block_place(&s->b, c, at);
            block_centre(&s->b, at[0], at[1], at[2], k->where);
            sum[0] += 1.0;
        }
    }
    most.n = sum[0];
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->b.cart);
    if (sum[0] > 0.0) {
        MPI_Comm_rank(s->b.cart, &most.rank);
        MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE_INT, MPI_MAXLOC, s->b.cart);
        MPI_Bcast(k->where, 3, MPI_DOUBLE, most.rank, s->b.cart);
    }
    k->missing = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
}

void coupling_judge(struct fv *s, struct diagnosis *d)
{
    struct link *k = s->link;
    if (s->surface && !isnan(k->of_water.start))
        water_budget_judge(s, &k->of_water, d);
    if (watch_judge(&k->unmapped, k->missing, s->t, s->run->step, d))
        snprintf(d->where, sizeof d->where, "(%g, %g, %g) m, t = %.4g s", k->where[0], k->where[1],
                 k->where[2], s->t);
}

double coupling_water_missing(const struct fv *s) { return s->link->of_water.missing; }

double coupling_unmapped(const struct fv *s) { return s->link->missing; }

void coupling_summary(const struct fv *s, struct summary *to)
{
    watch_summary(&s->link->unmapped, to);
    if (s->surface)
        watch_summary(&s->link->of_water.watched, to);
}

/* The partner's velocities at t1; cells that it does not reach keep theirs. */
void coupling_window_begin(void *state, double t0, double t1)
{
    struct fv *s = state;
    struct link *k = s->link;
    struct forcing *f = s->forcing;
    const int dim = s->b.dim;
    const int64_t n = f ? f->npartner + f->nrim : 0;
    if (f)
        forcing_shift(f, t0, t1);
    if (s->surface)
        surface_forced_shift(s, t0, t1);
    course_try(s, k->course, t1);
    put(s);
    check(k, cpl_get(k->c, k->imposed, n, k->got, k->mask));
    check(k, cpl_get(k->c, k->seen, n, k->p, NULL));
    if (s->surface) {
        check(k, cpl_get(k->c, k->filled, s->surface->forced->nplaces, k->share, NULL));
        surface_forced_take(s, k->share);
        check(k, cpl_get(k->c, k->water, 1, &k->of_water.partners, NULL));
    }
    if (f)
        count_missing(s);
    for (int a = 0; f && a < dim; a++)
        for (int64_t i = 0; i < n; i++)
            f->v_next[a][i] = k->mask[i] ? k->got[dim * i + a] : f->v[a][i];
    if (s->surface)
        forcing_fill(s, k->mask);
}

void coupling_window_end(void *state, double t1)
{
    struct fv *s = state;
    course_take(s, s->link->course);
    if (s->surface)
        water_budget_close(s, &s->link->of_water, t1 - s->forcing->t0);
    if (s->forcing && !s->surface)
        find_datum(s);
}

static const char *const forced_names[3][3] = {
    {"v_x", "v_y", "v_z"}, {"w_x", "w_y", "w_z"}, {"o_x", "o_y", "o_z"}};

static double *forced_at(const struct forcing *f, int m, int a)
{
    return m == 0 ? f->v[a] : m == 1 ? f->v_next[a] : f->v_old[a];
}

void coupling_save(const struct fv *s, struct h5 *f)
{
    const struct forcing *c = s->forcing;
    course_save(s, s->link->course, f);
    h5_attribute_real(f, "datum", s->link->datum);
    if (s->surface) {
        water_budget_save(&s->link->of_water, f);
        h5_attribute_real(f, "inflow", c->inflow);
    }
    if (!c)
        return;
    const double clock[4] = {c->t0, c->t1, c->t_old, c->levels};
    const int64_t n = c->npartner + c->nrim;
    int64_t *number = NEW(int64_t, n);
    for (int64_t i = 0; i < n; i++)
        number[i] = number_of(&s->b, c->partner[i]);
    h5_write_int(f, "forced_cells", n, number);
    mem_free(number);
    h5_write_real(f, "forced_levels", "-", 4, 1, clock, false);
    for (int m = 0; m < 3; m++)
        for (int a = 0; a < s->b.dim; a++)
            h5_write_real(f, forced_names[m][a], "m/s", n, 1, forced_at(c, m, a), false);
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

/* Rows of the forced cells in a file of another number of ranks: row[i] of partner[i]; false if one
 * is not there. */
static bool find_rows(const struct fv *s, struct h5 *f, int64_t *row)
{
    const struct forcing *c = s->forcing;
    int64_t n;
    int64_t *number = h5_read_all_int(f, "forced_cells", &n);
    struct numbered *all = mem_new((size_t)(number ? n : 0), sizeof *all);
    int good = number != NULL;
    for (int64_t k = 0; number && k < n; k++)
        all[k] = (struct numbered){number[k], k};
    if (number)
        qsort(all, (size_t)n, sizeof *all, by_number);
    for (int64_t i = 0; good && i < c->npartner + c->nrim; i++) {
        const struct numbered key = {number_of(&s->b, c->partner[i]), 0};
        const struct numbered *at = bsearch(&key, all, (size_t)n, sizeof *all, by_number);
        good = at != NULL;
        row[i] = at ? at->row : 0;
    }
    mem_free(all);
    mem_free(number);
    MPI_Allreduce(MPI_IN_PLACE, &good, 1, MPI_INT, MPI_MIN, s->b.cart);
    return good;
}

static bool gather_forced(const struct fv *s, struct h5 *f)
{
    const struct forcing *c = s->forcing;
    int64_t *row = NEW(int64_t, c->npartner + c->nrim), n;
    bool good = find_rows(s, f, row);
    for (int k = 0; good && k < 3 * s->b.dim; k++) {
        double *to = forced_at(c, k / s->b.dim, k % s->b.dim);
        double *all = h5_read_all_real(f, forced_names[k / s->b.dim][k % s->b.dim], 1, &n);
        good = all != NULL;
        for (int64_t i = 0; good && i < c->npartner + c->nrim; i++)
            to[i] = all[row[i]];
        mem_free(all);
    }
    mem_free(row);
    return good;
}

static bool load_forced(const struct fv *s, struct h5 *f)
{
    const struct forcing *c = s->forcing;
    bool good = true;
    if (!layout_same_ranks(f, s->run->size))
        return gather_forced(s, f);
    for (int m = 0; m < 3; m++)
        for (int a = 0; a < s->b.dim; a++)
            good = good && h5_read_real(f, forced_names[m][a], c->npartner + c->nrim, 1,
                                        forced_at(c, m, a));
    return good;
}

bool coupling_load(struct fv *s, struct h5 *f)
{
    struct forcing *c = s->forcing;
    double clock[4];
    bool good =
        course_load(s, s->link->course, f) && h5_read_attribute_real(f, "datum", &s->link->datum);
    if (!c || !good)
        return good;
    good = h5_read_same(f, "forced_levels", 4, clock) && load_forced(s, f);
    c->t0 = clock[0];
    c->t1 = clock[1];
    c->t_old = clock[2];
    c->levels = (int)clock[3];
    if (s->surface)
        good = good && water_budget_load(&s->link->of_water, f) &&
               h5_read_attribute_real(f, "inflow", &c->inflow);
    return good;
}

/* fv_coupling.c - FV's place in a coupled job: its free zone's partner fills a hole, and takes
 * patches of velocity and pressure with their time derivatives. FV follows its partner:
 * window_begin waits for the forced velocities at the end of the window.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../common/fit.h"
#include "../common/h5.h"
#include "../common/log.h"
#include "../common/mem.h"
#include "../coupler/cpl.h"
#include "forcing.h"

enum { LEVELS = 3 };

struct link {
    struct cpl *c;
    int grid, forced, velocity, pressure, imposed;
    int first;         /* local row: below it nothing is given, rows are of unequal height */
    int64_t n;         /* local cells from there on */
    double *q[LEVELS]; /* [n][dim + 1] velocity and smoothed pressure at the ends of the last
                          windows, newest first */
    double t[LEVELS];  /* s: their times */
    int levels;        /* of them known */
    double level;      /* Pa: taken out of the pressure last */
    double *rate;      /* [n] Pa/s: trend of the pressure */
    double *scatter;   /* [n] Pa: of the pressure about its trend; NULL: no surface, no impacts */
    double *v, *dv, *ddv, *got; /* scratch */
    unsigned char *mask;
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
    if (!s->forcing)
        log_warn("no cell lies wholly in the box that sph gives, (%g, %g) to (%g, %g) m: fv is not "
                 "forced, the "
                 "coupling goes one way; refine fv.cells or lower coupling.overlap",
                 lo[0], lo[1], hi[0], hi[1]);
    if (b->rows) {
        check_rows(s, k);
        k->first = b->rows->even - b->lo[1];
        k->first = k->first < 0 ? 0 : k->first > b->n[1] ? b->n[1] : k->first;
    }
    declare(s, k);
    k->n = (int64_t)b->n[0] * (b->n[1] - k->first) * b->n[2];
    for (int m = 0; m < LEVELS; m++)
        k->q[m] = NEW(double, k->n *(b->dim + 1));
    k->rate = NEW(double, k->n);
    k->scatter = scene_has_surface(&s->run->scene) ? NEW(double, k->n) : NULL;
    k->v = NEW(double, k->n * b->dim);
    k->dv = NEW(double, k->n * b->dim);
    k->ddv = NEW(double, k->n * b->dim);
    const int64_t most = s->forcing ? s->forcing->npartner + s->forcing->nrim : 0;
    k->got = NEW(double, most * b->dim);
    k->mask = NEW(unsigned char, most);
}

void coupling_free(struct fv *s)
{
    struct link *k = s->link;
    for (int m = 0; m < LEVELS; m++)
        mem_free(k->q[m]);
    mem_free(k->rate);
    mem_free(k->scatter);
    mem_free(k->v);
    mem_free(k->dv);
    mem_free(k->ddv);
    mem_free(k->got);
    mem_free(k->mask);
    mem_free(k);
    s->link = NULL;
}

/* Under a surface the partner knows the level of the pressure: what is smoothed and sent is what
 * stands over its mean at the rim of the free cells. It would follow every swing of the level late.
 */
static void take_out_level(struct fv *s, double *q)
{
    struct link *k = s->link;
    const struct block *b = &s->b;
    const struct forcing *f = s->forcing;
    const double *g = s->run->scene.fluid.gravity;
    double sum[2] = {0.0, 0.0}, x[3];
    k->level = 0.0;
    if (!f || !scene_has_surface(&s->run->scene) || (g[0] == 0.0 && g[1] == 0.0 && g[2] == 0.0))
        return;
    for (int64_t m = f->npartner; m < f->npartner + f->nrim; m++) {
        int at[3];
        block_place(b, f->partner[m], at);
        block_centre(b, at[0], at[1], at[2], x);
        const int64_t i =
            at[0] + (int64_t)b->n[0] * (at[1] - k->first + (int64_t)(b->n[1] - k->first) * at[2]);
        sum[0] += q[i * (b->dim + 1) + b->dim] - fv_still_pressure(s, x);
        sum[1] += 1.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, b->cart);
    k->level = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
    for (int64_t i = 0; i < k->n; i++)
        q[i * (b->dim + 1) + b->dim] -= k->level;
}

double coupling_level(const struct fv *s) { return s->link ? s->link->level : 0.0; }

/* Velocity and whole pressure now, as a new level; forced cells get a pressure continued from the
 * free side. */
static void take_level(struct fv *s)
{
    struct link *k = s->link;
    const struct block *b = &s->b;
    double *oldest = k->q[LEVELS - 1], *one = NEW(double, k->n), *p = block_field(b);
    memmove(k->q + 1, k->q, (LEVELS - 1) * sizeof *k->q);
    memmove(k->t + 1, k->t, (LEVELS - 1) * sizeof *k->t);
    k->q[0] = oldest;
    k->t[0] = s->t;
    k->levels = k->levels < LEVELS ? k->levels + 1 : LEVELS;
    for (int64_t c = 0; c < b->size; c++)
        p[c] = fv_pressure(s, c);
    if (s->forcing)
        forcing_extend(s, p);
    fv_add_still_pressure(s, p);
    for (int m = 0; m <= b->dim; m++) {
        block_pack_from(b, k->first, m < b->dim ? s->u[m] : p, one);
        for (int64_t i = 0; i < k->n; i++)
            k->q[0][i * (b->dim + 1) + m] = one[i];
    }
    mem_free(p);
    mem_free(one);
    take_out_level(s, k->q[0]);
}

/* Derivative and half the second one at the newest level: of the parabola through three levels, of
 * the line through two, or none. */
static double derivative(const struct link *k, int64_t at, double *bend)
{
    *bend = 0.0;
    if (k->levels < 2)
        return 0.0;
    const double h = k->t[0] - k->t[1], d0 = (k->q[0][at] - k->q[1][at]) / h;
    if (k->levels < 3)
        return d0;
    const double g = k->t[1] - k->t[2], d1 = (k->q[1][at] - k->q[2][at]) / g;
    *bend = (d0 - d1) / (h + g);
    return d0 + h * *bend;
}

/* Pressure answers at once to every change of the forced velocities, by the change over the window,
 * and the partner to the pressure a window later: as it stands, noise would come back larger.
 * Smoothing takes it away; it must keep level and trend, for a lag would feed waves. */
static void smooth_pressure(struct fv *s)
{
    struct link *k = s->link;
    const int dim = s->b.dim;
    const double memory = s->run->scene.coupling.memory, h = k->t[0] - k->t[1];
    for (int64_t i = 0; i < k->n; i++) {
        const int64_t at = i * (dim + 1) + dim;
        double level = k->q[1][at];
        fit_smooth(k->q[0][at], h, memory, &level, k->rate + i, k->scatter ? k->scatter + i : NULL);
        k->q[0][at] = level;
    }
}

static void put(struct fv *s)
{
    struct link *k = s->link;
    const int dim = s->b.dim;
    for (int64_t i = 0; i < k->n; i++)
        for (int a = 0; a < dim; a++) {
            k->v[i * dim + a] = k->q[0][i * (dim + 1) + a];
            k->dv[i * dim + a] = derivative(k, i * (dim + 1) + a, k->ddv + i * dim + a);
        }
    check(k, cpl_put_course(k->c, k->velocity, s->t, k->n, 3,
                            (const double *const[]){k->v, k->dv, k->ddv}));
    for (int64_t i = 0; i < k->n; i++)
        k->v[i] = k->q[0][i * (dim + 1) + dim];
    check(k, cpl_put(k->c, k->pressure, s->t, k->n, k->v, k->rate));
}

/* A level of the exact solution before the start, so that the first windows know a derivative. */
static void exact_level(struct fv *s, double t, int m)
{
    struct link *k = s->link;
    const struct block *b = &s->b;
    double x[3], u[3], p;
    int64_t at = 0;
    for (int kk = 0; kk < b->n[2]; kk++)
        for (int j = k->first; j < b->n[1]; j++)
            for (int i = 0; i < b->n[0]; i++) {
                block_centre(b, i, j, kk, x);
                exact_average(&s->exact, x, b->h, t, u, &p, NULL);
                for (int a = 0; a < b->dim; a++)
                    k->q[m][at++] = u[a];
                k->q[m][at++] = p;
            }
    k->t[m] = t;
    take_out_level(s, k->q[m]);
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
        id[m] =
            (b->lo[0] + at[0]) +
            (int64_t)b->cells[0] * ((b->lo[1] + at[1]) + (int64_t)b->cells[1] * (b->lo[2] + at[2]));
    }
    check(k, cpl_move(k->c, k->forced, n, x, id, NULL));
    mem_free(x);
    mem_free(id);
    if (!s->run->restart) {
        const double before = s->exact.U > 0.0 ? 1e-3 * s->exact.L / s->exact.U : 1e-3;
        double bend;
        for (int m = 0; f && m < b->dim; m++)
            for (int64_t i = 0; i < n; i++)
                f->v_next[m][i] = s->u[m][f->partner[i]];
        if (s->has_exact) {
            exact_level(s, s->t - 2.0 * before, 1);
            exact_level(s, s->t - before, 0);
            k->levels = 2;
        }
        take_level(s);
        if (s->has_exact)
            exact_level(s, s->t, 0); /* the start's pressure, in forced cells too */
        for (int64_t i = 0; i < k->n; i++)
            k->rate[i] = derivative(k, i * (b->dim + 1) + b->dim, &bend);
        if (f)
            s->forcing->t1 = s->t;
    }
    put(s);
}

/* The partner's velocities at t1; cells that it does not reach keep theirs. */
void coupling_window_begin(void *state, double t0, double t1)
{
    struct fv *s = state;
    struct link *k = s->link;
    struct forcing *f = s->forcing;
    const int dim = s->b.dim;
    const int64_t n = f ? f->npartner + f->nrim : 0;
    check(k, cpl_get(k->c, k->imposed, n, k->got, k->mask));
    if (!f)
        return;
    for (int a = 0; a < dim; a++) {
        double *oldest = f->v_old[a];
        f->v_old[a] = f->v[a];
        f->v[a] = f->v_next[a];
        f->v_next[a] = oldest;
        for (int64_t i = 0; i < n; i++)
            f->v_next[a][i] = k->mask[i] ? k->got[dim * i + a] : f->v[a][i];
    }
    f->has_old = f->t1 > f->t0;
    f->t_old = f->t0;
    f->t0 = t0;
    f->t1 = t1;
}

void coupling_window_end(void *state, double t1)
{
    (void)t1;
    take_level(state);
    smooth_pressure(state);
    put(state);
}

void coupling_save(const struct fv *s, struct h5 *f)
{
    static const char *const names[] = {"level0", "level1", "level2"};
    static const char *const v[] = {"v_x", "v_y", "v_z"}, *const w[] = {"w_x", "w_y", "w_z"};
    const struct link *k = s->link;
    const struct forcing *c = s->forcing;
    const double clock[7] = {k->t[0],       k->t[1],       k->t[2],         k->levels,
                             c ? c->t0 : 0, c ? c->t1 : 0, c ? c->t_old : 0};
    for (int m = 0; m < LEVELS; m++)
        h5_write_real(f, names[m], "-", k->n, s->b.dim + 1, k->q[m], false);
    h5_write_real(f, "levels", "-", 7, 1, clock, false);
    h5_write_real(f, "rate", "Pa/s", k->n, 1, k->rate, false);
    if (k->scatter)
        h5_write_real(f, "scatter", "Pa", k->n, 1, k->scatter, false);
    for (int a = 0; c && a < s->b.dim; a++) {
        h5_write_real(f, v[a], "m/s", c->npartner + c->nrim, 1, c->v[a], false);
        h5_write_real(f, w[a], "m/s", c->npartner + c->nrim, 1, c->v_next[a], false);
    }
}

bool coupling_load(struct fv *s, struct h5 *f)
{
    static const char *const names[] = {"level0", "level1", "level2"};
    static const char *const v[] = {"v_x", "v_y", "v_z"}, *const w[] = {"w_x", "w_y", "w_z"};
    struct link *k = s->link;
    struct forcing *c = s->forcing;
    double clock[7];
    bool good = h5_read_real(f, "levels", 7, 1, clock) &&
                h5_read_real(f, "rate", k->n, 1, k->rate) &&
                (!k->scatter || h5_read_real(f, "scatter", k->n, 1, k->scatter));
    for (int m = 0; good && m < LEVELS; m++) {
        good = h5_read_real(f, names[m], k->n, s->b.dim + 1, k->q[m]);
        k->t[m] = clock[m];
    }
    for (int a = 0; good && c && a < s->b.dim; a++)
        good = h5_read_real(f, v[a], c->npartner + c->nrim, 1, c->v[a]) &&
               h5_read_real(f, w[a], c->npartner + c->nrim, 1, c->v_next[a]);
    if (!good)
        return false;
    k->levels = (int)clock[3];
    if (c) {
        c->t0 = clock[4];
        c->t1 = clock[5];
        c->t_old = clock[6];
    }
    return true;
}

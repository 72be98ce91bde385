/* mock_any.c - a partner whose plan and window stand on its command line: each word is a step.
 *   mock_any NAME DIR WORD ...
 * points=SET:DIM:N:R[:PERIOD]   N points of a quasi-random sequence, cut among the ranks
 * grid=SET:NX:NY, cells=SET:N   a uniform grid; N x N distorted quadrilaterals (rows to the ranks)
 * put=FIELD:SET:NCOMP:TERMS:AT  AT start or end; a leading '?' of FIELD: optional
 * get=FIELD:SET:NCOMP:HOW:WHEN:S  WHEN 0 to 2, S: part of the window; from a grid: patch=..., the
 * same first=FIELD                   put before the first window, too dt=, t0=, shift= (added to x
 * of later points), say=WINDOW (memory), version= Fields are f_a = (1 + a)(1 + x + 2 y +
 * 3 z)(1 + t + t^2) + a: linear in space, quadratic in time. DIR/NAME.RANK has what was got in
 * hexadecimal; DIR/NAME.sums lines "FIELD put|got WINDOW SUM" over all ranks, first component, and
 * "FIELD off E" the largest difference from f at the end. SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../coupler/cpl.h"

enum { MOST = 24 };

struct set {
    char name[200];
    int id, dim;
    long n;
    double *x, *volume;
    int64_t *gid;
    bool grid;
};
struct act {
    char name[200];
    int set, id, ncomp, a, b; /* put: terms, at the end; get: how, when */
    double part, off;
    bool put, patch, first, optional;
    double *v[CPL_TERMS + 1]; /* one more than is possible */
    unsigned char *mask;
};
static struct {
    struct cpl *c;
    MPI_Comm mine;
    int rank, size, nsets, nacts;
    struct set set[MOST];
    struct act act[MOST];
    double dt, t, shift;
    int64_t say;
    FILE *out, *sums;
} m;

static void must(int code)
{
    if (code == CPL_OK)
        return;
    fprintf(stderr, "%s\n", cpl_strerror(m.c));
    cpl_close(&m.c, -code);
    MPI_Finalize();
    exit(-code);
}

/* The k-th part of "a:b:c" after the '=', "" if there is none. */
static const char *part(const char *word, int k)
{
    static char text[8][200];
    const char *at = strchr(word, '=') + 1;
    for (; k > 0 && at; k--)
        at = strchr(at, ':') ? strchr(at, ':') + 1 : NULL;
    static int next;
    char *to = text[next++ % 8];
    snprintf(to, sizeof text[0], "%.*s", at ? (int)strcspn(at, ":") : 0, at ? at : "");
    return to;
}

static double number(const char *word, int k) { return atof(part(word, k)); }
static bool is(const char *word, const char *key)
{
    return strncmp(word, key, strlen(key)) == 0 && word[strlen(key)] == '=';
}

static struct set *new_set(const char *word, long n)
{
    struct set *s = &m.set[m.nsets++];
    strcpy(s->name, part(word, 0));
    s->n = n;
    s->dim = 2;
    s->x = calloc(12 * (size_t)n + 1, 8);
    s->volume = calloc((size_t)n + 1, 8);
    s->gid = calloc((size_t)n + 1, 8);
    return s;
}

static double value(int a, const double *x, double t, int derivative)
{
    const double time = derivative == 0   ? 1.0 + t + t * t
                        : derivative == 1 ? 1.0 + 2.0 * t
                        : derivative == 2 ? 1.0
                                          : 0.0;
    return (1.0 + a) * (1.0 + x[0] + 2.0 * x[1] + 3.0 * x[2]) * time + (derivative ? 0.0 : a);
}

static void make_points(const char *word)
{
    const int dim = (int)number(word, 1);
    const long all = (long)number(word, 2), first = all * m.rank / m.size;
    struct set *s = new_set(word, all * (m.rank + 1) / m.size - first);
    s->dim = dim;
    for (long i = 0; i < s->n; i++) {
        static const double step[3] = {0.7548776662466927, 0.5698402909980532, 0.3819660112501051};
        for (int d = 0; d < dim; d++)
            s->x[3 * i + d] = fmod(0.5 + step[d] * (double)(first + i + 1), 1.0);
        s->x[3 * i] += m.shift;
        s->volume[i] = 1.0 / (double)all * (1.0 + 0.5 * fmod(0.37 * (double)(first + i), 1.0));
        s->gid[i] = 7 * (first + i) + 3;
    }
    const double R = number(word, 3), p = number(word, 4), period[3] = {p, p, p};
    must(cpl_points(m.c, s->name, dim, R, &s->id));
    if (p > 0.0)
        must(cpl_period(m.c, s->id, period));
}

static void make_grid(const char *word)
{
    struct cpl_grid g = {.dim = 2};
    for (int d = 0; d < 2; d++) {
        g.cells[d] = g.hi[d] = (int)number(word, 1 + d);
        g.spacing[d] = 1.0 / g.cells[d];
    }
    g.lo[1] = g.cells[1] * m.rank / m.size;
    g.hi[1] = g.cells[1] * (m.rank + 1) / m.size;
    struct set *s = new_set(word, (long)g.cells[0] * (g.hi[1] - g.lo[1]));
    s->grid = true;
    for (long i = 0; i < s->n; i++) {
        s->x[3 * i] = ((double)(i % g.cells[0]) + 0.5) * g.spacing[0];
        s->x[3 * i + 1] = (g.lo[1] + (double)(i / g.cells[0]) + 0.5) * g.spacing[1];
    }
    must(cpl_grid(m.c, s->name, &g, &s->id));
}

/* Corners of a lattice whose inner ones are moved: volumes still fill the square. */
static void corner(int n, int i, int j, double *x)
{
    const bool inner = i > 0 && j > 0 && i < n && j < n;
    x[0] = (i + (inner ? 0.3 * sin(5.0 * i + 3.0 * j) : 0.0)) / n;
    x[1] = (j + (inner ? 0.3 * cos(2.0 * i + 7.0 * j) : 0.0)) / n;
}

static void make_cells(const char *word)
{
    const int n = (int)number(word, 1), j0 = n * m.rank / m.size, j1 = n * (m.rank + 1) / m.size;
    struct set *s = new_set(word, (long)n * (j1 - j0));
    double *corners = calloc(12 * (size_t)s->n + 1, 8);
    int *four = calloc((size_t)s->n + 1, sizeof *four);
    for (int k = 0; k < s->n; k++) {
        const int i = k % n, j = j0 + k / n;
        corner(n, i, j, corners + 12 * k);
        corner(n, i + 1, j, corners + 12 * k + 3);
        corner(n, i + 1, j + 1, corners + 12 * k + 6);
        corner(n, i, j + 1, corners + 12 * k + 9);
        four[k] = 4;
        s->gid[k] = (int64_t)j * n + i;
        cpl_cell(2, 4, corners + 12 * k, s->x + 3 * k, s->volume + k);
    }
    must(cpl_points(m.c, s->name, 2, number(word, 2), &s->id));
    must(cpl_move_cells(m.c, s->id, s->n, four, corners, s->gid));
    free(corners);
    free(four);
    s->grid = true; /* is placed */
}

static int set_named(const char *name)
{
    for (int i = 0; i < m.nsets; i++)
        if (strcmp(m.set[i].name, name) == 0)
            return i;
    return 0;
}

static void make_field(const char *word)
{
    struct act *f = &m.act[m.nacts++];
    const char *name = part(word, 0);
    f->put = is(word, "put");
    f->patch = is(word, "patch");
    f->optional = name[0] == '?';
    strcpy(f->name, name + f->optional);
    f->set = set_named(part(word, 1));
    f->ncomp = (int)number(word, 2);
    f->a = (int)number(word, 3);
    f->b = f->put ? strcmp(part(word, 4), "end") == 0 : (int)number(word, 4);
    f->part = number(word, 5);
    const size_t n = (size_t)m.set[f->set].n;
    for (int k = 0; k <= CPL_TERMS; k++)
        f->v[k] = calloc(n * (size_t)f->ncomp + 1, 8);
    f->mask = calloc(n + 1, 1);
    must(cpl_field(m.c, m.set[f->set].id, f->name, "K", f->ncomp,
                   f->put ? CPL_PUT | (f->optional ? CPL_OPTIONAL : 0) : CPL_GET, f->put ? 0 : f->a,
                   &f->id));
}

static void add_sum(const struct act *f, const char *what, const double *v)
{
    double mine = 0.0, all = 0.0;
    for (long i = 0; i < m.set[f->set].n; i++)
        mine += v[i * f->ncomp];
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, m.mine);
    if (m.rank == 0)
        fprintf(m.sums, "%s %s %lld %.17g\n", f->name, what, (long long)cpl_window_number(m.c),
                all);
}

static void put(const struct act *f, double t)
{
    const struct set *s = &m.set[f->set];
    for (long i = 0; i < s->n; i++)
        for (int k = 0; k < f->a; k++)
            for (int a = 0; a < f->ncomp; a++)
                f->v[k][i * f->ncomp + a] = value(a, s->x + 3 * i, t, k);
    must(cpl_put_course(m.c, f->id, t, s->n, f->a, (const double *const *)f->v));
    add_sum(f, "put", f->v[0]);
}

static void get(struct act *f, double t0, double t1)
{
    const struct set *s = &m.set[f->set];
    const double t = t0 + f->part * (t1 - t0), lo[3] = {0}, hi[3] = {1, 1, 1};
    double *v = f->v[0];
    memset(v, 0, (size_t)(s->n * f->ncomp) * 8);
    if (f->patch) {
        must(cpl_patch_get_at(m.c, f->id, (enum cpl_when)f->b, lo, hi));
        cpl_patch_eval(m.c, f->id, t, s->n, s->x, v, NULL);
        memset(f->mask, 1, (size_t)s->n);
    } else {
        must(cpl_get_at(m.c, f->id, (enum cpl_when)f->b, t, s->n, v, f->mask));
    }
    for (long i = 0; i < s->n; i++)
        for (int a = 0; a < f->ncomp; a++) {
            fprintf(m.out, "%lld %s %lld %d %d %a\n", (long long)cpl_window_number(m.c), f->name,
                    (long long)s->gid[i], a, f->mask[i], v[i * f->ncomp + a]);
            if (f->mask[i])
                f->off = fmax(f->off, fabs(v[i * f->ncomp + a] - value(a, s->x + 3 * i, t, 0)));
        }
    add_sum(f, "got", v);
}

/* Resident kilobytes of this process. */
static long memory(void)
{
    long pages = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (f && fscanf(f, "%*s %ld", &pages) != 1)
        pages = 0;
    if (f)
        fclose(f);
    return 4 * pages;
}

static int run(void)
{
    double t0, t1;
    int action, code = 0;
    for (;;) {
        must(cpl_window(m.c, &t0, &t1, &action, &code));
        if (m.say && (cpl_window_number(m.c) == m.say || action & CPL_STOP) && m.rank == 0)
            fprintf(m.sums, "memory %ld\n", memory());
        if (action & CPL_STOP)
            return code;
        for (int i = 0; i < m.nacts; i++)
            if (m.act[i].put)
                put(&m.act[i], m.act[i].b ? t1 : t0);
            else
                get(&m.act[i], t0, t1);
        must(action & CPL_SAVE ? cpl_saved(m.c, "state.bin") : CPL_OK);
        must(cpl_advance(m.c, t1, 0));
    }
}

static void report(void)
{
    for (int i = 0; i < m.nacts; i++) {
        double all = 0.0;
        MPI_Allreduce(&m.act[i].off, &all, 1, MPI_DOUBLE, MPI_MAX, m.mine);
        if (m.rank == 0 && !m.act[i].put)
            fprintf(m.sums, "%s off %.3g\n", m.act[i].name, all);
    }
}

static void read_plan(char **words)
{
    for (char **w = words; *w; w++) {
        if (is(*w, "points"))
            make_points(*w);
        else if (is(*w, "grid"))
            make_grid(*w);
        else if (is(*w, "cells"))
            make_cells(*w);
        else if (is(*w, "put") || is(*w, "get") || is(*w, "patch"))
            make_field(*w);
        else if (is(*w, "dt"))
            m.dt = number(*w, 0);
        else if (is(*w, "t0"))
            m.t = number(*w, 0);
        else if (is(*w, "shift"))
            m.shift = number(*w, 0);
        else if (is(*w, "say"))
            m.say = (int64_t)number(*w, 0);
    }
    for (char **w = words; *w; w++)
        for (int i = 0; i < m.nacts && is(*w, "first"); i++)
            m.act[i].first = m.act[i].first || strcmp(m.act[i].name, part(*w, 0)) == 0;
}

/* A file of DIR to write to; what it cannot open is said, and ends the job. */
static FILE *created(const char *dir, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", dir, name);
    FILE *f = fopen(path, "w");
    if (f)
        return f;
    perror(path);
    cpl_close(&m.c, 2);
    MPI_Finalize();
    exit(2);
}

int main(int argc, char **argv)
{
    char name[256];
    int version = CPL_VERSION;
    MPI_Init(&argc, &argv);
    m.dt = INFINITY;
    for (int i = 3; i < argc; i++)
        version = is(argv[i], "version") ? (int)number(argv[i], 0) : version;
    if (cpl_open_as(version, MPI_COMM_WORLD, argv[1], 10.0, &m.c, &m.mine) || !m.c)
        return MPI_Finalize(), 2;
    MPI_Comm_rank(m.mine, &m.rank);
    MPI_Comm_size(m.mine, &m.size);
    int restart = -1, faults = 0;
    for (int i = 3; i < argc; i++) {
        const double box[3] = {0.0, 0.0, 0.0};
        restart = is(argv[i], "restart") ? (int)number(argv[i], 0) : restart;
        faults = is(argv[i], "faults") ? (int)number(argv[i], 0) : faults;
        if (is(argv[i], "zone"))
            must(cpl_zone(m.c, part(argv[i], 0), box, box));
    }
    must(cpl_meet(m.c, 0, restart, faults, argv[2]));
    snprintf(name, sizeof name, "%s.%d", argv[1], m.rank);
    m.out = created(argv[2], name);
    snprintf(name, sizeof name, "%s.sums", argv[1]);
    m.sums = m.rank == 0 ? created(argv[2], name) : NULL;
    read_plan(argv + 3);
    must(cpl_ready(m.c, m.t, m.dt));
    for (int i = 0; i < m.nsets; i++)
        if (!m.set[i].grid)
            must(cpl_move(m.c, m.set[i].id, m.set[i].n, m.set[i].x, m.set[i].gid, m.set[i].volume));
    for (int i = 0; i < m.nacts; i++)
        if (m.act[i].first)
            put(&m.act[i], m.t);
    const int code = run();
    report();
    fclose(m.out);
    if (m.sums)
        fclose(m.sums);
    const int job = cpl_close(&m.c, code);
    MPI_Finalize();
    return job;
}

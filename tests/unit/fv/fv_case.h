/* fv_case.h - a small run of the finite-volume solver for the tests of its modules: Taylor-Green of
 * Re 200 in the periodic unit square, 32 x 32 cells, with a case's overrides ("fv.cells=(64,64)").
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <unistd.h>

#include "../../../fv/case/fv_case.h"
#include "../../../fv/fv.h"
#include "../../../fv/output/output.h"
#include "../../../fv/time/steps.h"

#define CLOSED "domain.periodic=(false,false,false)"

struct fv_case {
    struct run run;
    struct fv *s;
};

enum { FV_CASE_ROW = 24, FV_CASE_OVERRIDES = 12 };

static inline void fv_case_path(const char *suffix, char *path, size_t size)
{
    const char *dir = getenv("TEST_SCRATCH");
    snprintf(path, size, "%s/fv_%d%s", dir ? dir : P_tmpdir, (int)getpid(), suffix);
}

/* Reads the text of a case, with overrides (NULL-terminated; may be NULL), through the file at path
 * into r. Faults are added to f; returns the parameters, for params_free. */
static inline struct params *fv_case_read(struct run *r, MPI_Comm comm, const char *path,
                                          const char *text, const char *const *overrides,
                                          struct faults *f)
{
    static struct param_group groups[SCENE_GROUPS + FV_GROUPS];
    int n = 0;
    FILE *file = fopen(path, "w");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0)
        abort();
    while (overrides && overrides[n])
        n++;
    *r = (struct run){.comm = comm, .name = "fv"};
    MPI_Comm_rank(comm, &r->rank);
    MPI_Comm_size(comm, &r->size);
    scene_groups(&r->scene, groups);
    memcpy(groups + SCENE_GROUPS, fv_groups, sizeof fv_groups);
    struct params *p = params_read(comm, path, n, overrides, groups, SCENE_GROUPS + FV_GROUPS,
                                   (const char *const[]){NULL}, f);
    r->params = p;
    return p;
}

/* The case of the head, with overrides (NULL-terminated; may be NULL). */
static inline void fv_case_set(struct fv_case *c, MPI_Comm comm, const char *const *overrides)
{
    static const char text[] =
        "format = 1;\n"
        "time: { end = 1.0; };\n"
        "fluid: { rho = 1.0; nu = 5.0e-3; };\n"
        "domain: { dim = 2; min = (0, 0, 0); max = (1, 1, 1); periodic = (true, true, true); };\n"
        "initial: { field = \"taylor_green\"; U = 1.0; L = 1.0; };\n"
        "fv: { cells = (32, 32, 32); };\n";
    struct faults faults = {0};
    char path[1024];
    c->s = NULL;
    fv_case_path(".cfg", path, sizeof path);
    struct params *p = fv_case_read(&c->run, comm, path, text, overrides, &faults);
    params_report(&faults);
    if (faults.n > 0)
        abort();
    params_free(&p);
    c->run.params = NULL;
    remove(path);
}

/* Makes walls of this kind of all sides that are not periodic. */
static inline void fv_case_close(struct fv_case *c, enum wall_kind kind)
{
    struct scene *scene = &c->run.scene;
    for (int side = SIDE_X_MIN; side < SIDE_X_MIN + 2 * scene->domain.dim; side++)
        if (!scene->domain.periodic[(side - SIDE_X_MIN) / 2])
            scene->walls[scene->nwalls++] = (struct scene_wall){.side = side, .kind = kind};
}

static inline struct scene_wall *wall_add(struct fv_case *c, enum scene_side side,
                                          enum wall_kind kind, double u)
{
    struct scene_wall *w = c->run.scene.walls + c->run.scene.nwalls++;
    *w = (struct scene_wall){.side = side, .kind = kind, .velocity = {u, 0.0, 0.0}};
    return w;
}

static inline struct fv *fv_case_start(struct fv_case *c, struct h5 *f)
{
    c->s = fv_create(&c->run, f);
    return c->s;
}

/* As run_main does it: at most `steps' steps, up to t_stop. */
static inline bool fv_case_run(struct fv_case *c, int steps, double t_stop)
{
    struct diagnosis d = {0};
    for (int k = 0; k < steps && !d.bad && c->s->t < t_stop; k++) {
        c->run.dt = integrate(c->s, t_stop, &d);
        c->run.t = c->s->t;
        c->run.step++;
    }
    if (d.bad)
        printf("%s %s\n", d.reason, d.where);
    return !d.bad;
}

/* Relative error of velocity at t_stop, NaN if the run failed. */
static inline double fv_case_error(const char *const *overrides, double t_stop)
{
    struct fv_case c;
    double row[FV_CASE_ROW];
    fv_case_set(&c, MPI_COMM_WORLD, overrides);
    fv_case_start(&c, NULL);
    const bool good = fv_case_run(&c, 100000, t_stop);
    VALUES_OF(fv_row, c.s, row);
    fv_free(&c.s);
    return good ? row[3] : NAN;
}

/* The same with n cells a side and up to two more overrides behind the common ones. */
static inline double fv_case_error_at(int n, const char *const *common, const char *more,
                                      double t_stop)
{
    const char *all[FV_CASE_OVERRIDES + 3];
    char cells[64];
    int m = 0;
    snprintf(cells, sizeof cells, "fv.cells=(%d,%d,%d)", n, n, n);
    while (common && common[m] && m < FV_CASE_OVERRIDES) {
        all[m] = common[m];
        m++;
    }
    all[m++] = cells;
    if (more)
        all[m++] = more;
    all[m] = NULL;
    return fv_case_error(all, t_stop);
}

/* Sum of the velocity along x over all cells of all ranks, with weights that differ from cell to
 * cell. */
static inline double fv_case_weighted(const struct fv *s)
{
    double sum = 0.0, x[3];
    BLOCK_CELLS (&s->b, i, j, k, c) {
        block_centre(&s->b, i, j, k, x);
        sum += sin(7.0 * x[0] + 5.0 * x[1] + 3.0 * x[2]) * s->u[0][c] + x[0] * s->u[1][c];
    }
    return ranks_sum(s->run->comm, sum);
}

static inline double fv_case_order(double coarse, double fine) { return log2(coarse / fine); }

/* mesh_case.h - a small flow on blocks for the tests: a case with a text of its blocks.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include <unistd.h>

#include "../../../fv/case/fv_case.h"
#include "../../../fv/grid/mesh.h"
#include "../../../fv/output/mesh_output.h"
#include "../../../fv/output/output.h"
#include "../../../fv/surface/levelset.h"
#include "../../../fv/time/steps.h"

#define PERIODIC                                                                                   \
    "i_min = \"periodic\"; i_max = \"periodic\"; j_min = \"periodic\"; j_max = \"periodic\"; "

struct mesh_case {
    struct run run;
    struct faults faults;
    struct params *params;
    char path[1024];
};

/* blocks: text of the list; overrides: NULL-terminated, may be NULL. Keeps the faults. */
static inline void mesh_case_read(struct mesh_case *c, MPI_Comm comm, const char *blocks,
                                  const char *const *overrides)
{
    static const char text[] = "format = 1;\n"
                               "time: { end = 1.0; };\n"
                               "fluid: { rho = 1.0; nu = 5.0e-3; };\n"
                               "domain: { dim = %d; %s };\n"
                               "initial: { field = \"two_modes\"; U = 1.0; L = 1.0; %s };\n"
                               "fv: { %s };\n";
    struct param_group groups[SCENE_GROUPS + FV_GROUPS];
    const char *dir = getenv("TEST_SCRATCH");
    /* the unit square or cube if a side is periodic, else one that holds all blocks of the tests */
    static const char *const domains[2][2] = {
        {"min = (-2, -2); max = (2, 2);", "min = (-2, -2, -2); max = (2, 2, 2);"},
        {"min = (0, 0); max = (1, 1); periodic = (true, true);",
         "min = (0, 0, 0); max = (1, 1, 1); periodic = (true, true, true);"}};
    int n = 0, dim = 2;
    bool carried = true, newton = false;
    *c = (struct mesh_case){.run = {.comm = comm, .name = "fv"}};
    MPI_Comm_rank(comm, &c->run.rank);
    MPI_Comm_size(comm, &c->run.size);
    snprintf(c->path, sizeof c->path, "%s/mesh_%d.cfg", dir ? dir : P_tmpdir, (int)getpid());
    snprintf(c->run.case_dir, sizeof c->run.case_dir, "%s", dir ? dir : P_tmpdir);
    c->run.motions = motion_files_create(c->run.case_dir);
    for (; overrides && overrides[n]; n++) {
        dim = strcmp(overrides[n], "domain.dim=3") == 0 ? 3 : dim;
        newton = newton || strstr(overrides[n], "newton\"");
        carried = carried && strcmp(overrides[n], "initial.field=\"rest\"") != 0 &&
                  strcmp(overrides[n], "initial.field=\"couette\"") != 0 &&
                  strcmp(overrides[n], "initial.field=\"standing_wave\"") != 0;
    }
    const char *domain = domains[strstr(blocks, "periodic") != NULL][dim == 3];
    FILE *file = fopen(c->path, "w");
    if (!file ||
        fprintf(file, text, dim, domain, carried ? "velocity = (0.5, 0.25);" : "",
                newton ? "" : "tol_pressure = 1e-3;") < 0 ||
        fprintf(file, "blocks: ( %s );\n", blocks) < 0 || fclose(file) != 0)
        abort();
    scene_groups(&c->run.scene, groups);
    for (int k = 0; k < FV_GROUPS; k++)
        groups[SCENE_GROUPS + k] = fv_groups[k];
    c->params = params_read(comm, c->path, n, overrides, groups, SCENE_GROUPS + FV_GROUPS,
                            (const char *const[]){NULL}, &c->faults);
    c->run.params = c->params;
    remove(c->path);
}

/* Checks the case as the program does, and starts it. */
static inline struct fv *mesh_case_create(struct mesh_case *c, struct h5 *f)
{
    fv_params_check(&c->run, &c->faults);
    if (params_report(&c->faults) > 0)
        abort();
    return fv_create(&c->run, f);
}

/* Whether a case is refused in this word; ends it. */
static inline bool mesh_case_refused(struct mesh_case *c, const char *word)
{
    if (c->faults.n == 0)
        fv_params_check(&c->run, &c->faults);
    const bool told = c->faults.n > 0 && (c->run.rank > 0 || strstr(c->faults.text, word));
    if (!told)
        printf("'%s' is not in: %s\n", word, c->faults.text);
    mem_free(c->faults.text);
    params_free(&c->params);
    return told;
}

static inline struct fv *mesh_case_start(struct mesh_case *c, MPI_Comm comm, const char *blocks,
                                         const char *const *overrides)
{
    mesh_case_read(c, comm, blocks, overrides);
    return mesh_case_create(c, NULL);
}

static inline void mesh_case_end(struct mesh_case *c, struct fv **s)
{
    fv_free(s);
    params_free(&c->params);
    FREE(c->run.motions);
}

static inline bool mesh_case_run(struct fv *s, int steps, double t_stop)
{
    struct diagnosis d = {0};
    for (int k = 0; k < steps && !d.bad && s->t < t_stop; k++) {
        s->run->dt = integrate(s, t_stop, &d);
        s->run->t = s->t;
        s->run->step++;
    }
    if (d.bad)
        printf("%s %s\n", d.reason, d.where);
    return !d.bad;
}

/* Errors of velocity, pressure, vorticity at t_stop, NaN if the run failed. */
static inline void mesh_case_errors(const char *blocks, const char *const *overrides, double t_stop,
                                    double error[3])
{
    static const char *const keys[] = {"error.velocity_l2", "error.pressure_l2",
                                       "error.vorticity_l2"};
    struct mesh_case c;
    struct fv *s = mesh_case_start(&c, MPI_COMM_WORLD, blocks, overrides);
    const bool good = mesh_case_run(s, 100000, t_stop);
    c.run.summary = summary_create();
    fv_finish(s);
    for (int k = 0; k < 3; k++)
        if (!good || !summary_find(c.run.summary, keys[k], error + k))
            error[k] = NAN;
    DROP(c.run.summary);
    mesh_case_end(&c, &s);
}

/* Energy after four steps on one rank less that on all ranks, J; NaN if a run failed. Collective.
 */
static inline double mesh_case_ranks_apart(const char *blocks, const char *const *overrides)
{
    double e[2], row[16];
    for (int k = 0; k < 2; k++) {
        struct mesh_case c;
        struct fv *s = mesh_case_start(&c, k ? MPI_COMM_WORLD : MPI_COMM_SELF, blocks, overrides);
        const bool good = mesh_case_run(s, 4, 100.0);
        VALUES_OF(fv_row, s, row);
        mesh_case_end(&c, &s);
        e[k] = good ? row[0] + row[1] : NAN;
    }
    return ranks_max(MPI_COMM_WORLD, fabs(e[0] - e[1]));
}

/* s, of case one, takes so many steps, its restart file starts case two, which was read but not
 * started, and both take as many more: cells whose phi, u or p differ; -1: a run stopped. Ends
 * both. Collective. */
static inline int64_t mesh_case_restart(struct mesh_case *one, struct fv *s, struct mesh_case *two,
                                        int steps)
{
    char path[1100];
    int64_t differ = 0;
    snprintf(path, sizeof path, "%s.h5", one->path);
    MPI_Bcast(path, sizeof path, MPI_CHAR, 0, MPI_COMM_WORLD);
    bool good = mesh_case_run(s, steps, 100.0);
    struct h5 *f = h5_create_restart(MPI_COMM_WORLD, path);
    fv_checkpoint(s, f);
    h5_close(&f);
    two->run.t = s->t;
    two->run.step = s->run->step;
    f = h5_open(MPI_COMM_WORLD, path);
    struct fv *z = fv_create(&two->run, f);
    h5_close(&f);
    good = z && mesh_case_run(s, steps, 100.0) && mesh_case_run(z, steps, 100.0) && good;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n && good; i++)
            differ += (s->surface && s->surface->phi[i] != z->surface->phi[i]) ||
                      s->u[0][i] != z->u[0][i] || s->u[1][i] != z->u[1][i] || s->p[i] != z->p[i];
    MPI_Allreduce(MPI_IN_PLACE, &differ, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    mesh_case_end(one, &s);
    mesh_case_end(two, &z);
    MPI_Barrier(MPI_COMM_WORLD);
    remove(path);
    return good ? differ : -1;
}

/* Kinetic energy in a row of the series over that of the uniform flow of the start in 1 m^dim. */
static inline double mesh_case_energy_share(struct fv *s)
{
    const double *u = s->run->scene.initial.velocity;
    double row[64];
    VALUES_OF(fv_row, s, row);
    return row[0] / (0.5 * s->run->scene.fluid.rho * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]));
}

/* mock.c - the smallest complete solver, and the documentation of coupler/cpl.h. It knows the answer to
 * everything: velocity and pressure are functions of place and time.
 *   mock NAME points|grid DIR [key=value ...]
 * points: particles that give "velocity" and take "pressure" as a patch; grid: the reverse. What it got goes
 * to DIR/NAME.RANK in hexadecimal. Keys: n (a side), mls, cubic, unit, hash, dt, still, end (the window in which
 * it asks for an orderly end), late (s), deadline, fault and at (mock_fault.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mock_fault.h"

static void last_words(int signal)
{
    cpl_obituary(STDERR_FILENO); /* why the launcher ends this job */
    _exit(128 + signal);
}

static void must(struct cpl *c, int code)
{
    if (code == CPL_OK)
        return;
    fprintf(stderr, "%s\n", cpl_strerror(c));
    cpl_close(&c, -code); /* a refused plan: leaves in order; else: ends the job */
    MPI_Finalize();
    exit(-code);
}

int main(int argc, char **argv)
{
    struct cpl *c;
    MPI_Comm mine;
    int rank, size, set, give, take, action, code = 0;
    double t0, t1;
    keys = argv + 4;
    const int n = atoi(option("n", "40")), points = !strcmp(argv[2], "points");
    MPI_Init(&argc, &argv);
    signal(SIGTERM, last_words);
    sleep((unsigned)atoi(option("late", "0")));

    /* who is here; the case's hash would tell whether all read the same one */
    if (cpl_open(MPI_COMM_WORLD, argv[1], atof(option("deadline", "10")), &c, &mine) || !c)
        return MPI_Finalize(), 2;
    MPI_Comm_rank(mine, &rank);
    MPI_Comm_size(mine, &size);
    must(c, cpl_meet(c, strtoull(option("hash", "0"), NULL, 0), -1, 0, argv[3]));

    /* rows of a lattice over the unit square */
    const int j0 = n * rank / size, j1 = n * (rank + 1) / size;
    const long m = (long)n * (j1 - j0);
    const double h = 1.0 / n, lo[3] = {0, j0 * h, 0}, hi[3] = {1, j1 * h, 0};
    double *x = calloc(3 * (size_t)m + 1, 8), *w = calloc((size_t)m + 1, 8);
    double *velocity = calloc(2 * (size_t)m + 1, 8), *pressure = calloc((size_t)m + 1, 8);
    int64_t *id = calloc((size_t)m + 1, 8);
    for (long i = 0; i < m; i++) {
        x[3 * i] = ((double)(i % n) + 0.5) * h;
        x[3 * i + 1] = ((double)(j0 + i / n) + 0.5) * h;
        w[i] = h * h;
        id[i] = j0 * n + i;
        pressure[i] = sin(6.2831853 * x[3 * i]) * x[3 * i + 1];
    }

    /* the plan: a set, a field given, a field taken */
    const struct cpl_grid grid = {.dim = 2, .spacing = {h, h}, .cells = {n, n}, .periodic = {1, 1},
                                  .lo = {0, j0}, .hi = {n, j1}};
    if (points) {
        must(c, cpl_points(c, "particles", 2, 0.0, &set));
        must(c, cpl_field(c, set, "velocity", option("unit", "m/s"), 2, CPL_PUT, 0, &give));
        must(c, cpl_field(c, set, "pressure", "Pa", 1, CPL_GET, atoi(option("cubic", "0")), &take));
    } else {
        must(c, cpl_grid(c, "cells", &grid, &set));
        must(c, cpl_field(c, set, "pressure", option("unit", "Pa"), 1, CPL_PUT, 0, &give));
        must(c, cpl_points(c, "targets", 2, 2.2 * h, &set));
        must(c, cpl_field(c, set, "velocity", "m/s", 2, CPL_GET, atoi(option("mls", "0")), &take));
    }
    must(c, cpl_ready(c, 0.0, atof(option("dt", "0.1"))));
    if (!points) /* what particles need in the first window */
        must(c, cpl_put(c, give, 0.0, m, pressure, pressure));

    char name[1024];
    snprintf(name, sizeof name, "%s/%s.%d", argv[3], argv[1], rank);
    FILE *out = fopen(name, "w");
    must(c, cpl_window(c, &t0, &t1, &action, &code));
    for (; !(action & CPL_STOP); must(c, cpl_window(c, &t0, &t1, &action, &code))) {
        const bool forget = fault(c, points ? velocity : pressure, m);
        const long long number = (long long)cpl_window_number(c);
        if (number == 0 || !atoi(option("still", "0")))
            must(c, cpl_move(c, set, m, x, id, w));
        if (points) {
            must(c, cpl_patch_get(c, take, lo, hi));
            cpl_patch_eval(c, take, t1, m, x, pressure, NULL);
            for (long i = 0; i < m; i++) {
                fprintf(out, "%lld %d %a\n", number, (int)id[i], pressure[i]);
                velocity[2 * i] = sin(x[3 * i] + t1) + 0.0 * velocity[2 * i];
                velocity[2 * i + 1] = cos(x[3 * i + 1] - t1);
                x[3 * i] += 0.01 * velocity[2 * i] * h;
            }
            must(c, forget ? CPL_OK : cpl_put(c, give, t1, m, velocity, NULL));
        } else {
            must(c, cpl_get(c, take, m, velocity, NULL));
            for (long i = 0; i < m; i++)
                fprintf(out, "%lld %d %a %a\n", number, (int)id[i], velocity[2 * i], velocity[2 * i + 1]);
            must(c, forget ? CPL_OK : cpl_put(c, give, t1, m, pressure, pressure));
        }
        must(c, cpl_tell(c, "norm.velocity.e2", 1e-6));
        must(c, cpl_tell(c, "norm.velocity.r2", 1.0));
        must(c, action & CPL_SAVE ? cpl_saved(c, "mock.h5") : CPL_OK);
        must(c, cpl_advance(c, t1, number == atoi(option("end", "-1"))));
    }
    fclose(out);
    free(x), free(w), free(velocity), free(pressure), free(id);
    code = cpl_close(&c, code); /* the job's code: 1 when its results are not accepted */
    MPI_Finalize();
    return code;
}

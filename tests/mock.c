/* mock.c - the smallest complete solver, and the documentation of coupler/cpl.h. It knows the answer to
 * everything: velocity and pressure are functions of place and time.
 *   mock NAME points|grid DIR [key=value ...]
 * points gives "velocity" on particles and takes "pressure" as a patch; grid does the reverse. What it
 * got is written to DIR/NAME.RANK in hexadecimal. Keys: n (points or cells a side), mls, cubic, unit, hash,
 * dt, end (asks for it in this window), and for tests fault=kill|segv|exit|sleep|nan|abort, at=WINDOW.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../coupler/cpl.h"

static char **keys;
static const char *option(const char *key, const char *otherwise)
{
    for (char **k = keys; *k; k++)
        if (strncmp(*k, key, strlen(key)) == 0 && (*k)[strlen(key)] == '=')
            return *k + strlen(key) + 1;
    return otherwise;
}

static void must(struct cpl *c, int code)
{
    if (code == CPL_EINPUT && cpl_window_number(c) == 0)
        fprintf(stderr, "%s\n", cpl_strerror(c));
    if (code != CPL_OK)
        cpl_close(&c, -code), MPI_Finalize(), exit(-code);
}

static void fault(struct cpl *c, double *v)
{
    const char *what = option("fault", "");
    if (cpl_window_number(c) != atoi(option("at", "2")))
        return;
    *v = !strcmp(what, "nan") ? NAN : *v;
    (void)(!strcmp(what, "kill") ? raise(SIGKILL) : !strcmp(what, "segv") ? raise(SIGSEGV) : 0);
    if (!strcmp(what, "abort"))
        cpl_fail(c, 3, "the mock has had enough");
    if (!strcmp(what, "exit"))
        exit(0);
    sleep(!strcmp(what, "sleep") ? 3 : 0);
}

static void last_words(int signal) { cpl_obituary(STDERR_FILENO), _exit(128 + signal); }

int main(int argc, char **argv)
{
    struct cpl *c;
    MPI_Comm mine;
    int rank, size, set, give, take, action, code = 0;
    double t0, t1;
    if (argc < 4)
        return 2;
    keys = argv + 4;
    const int n = atoi(option("n", "40")), points = !strcmp(argv[2], "points");
    MPI_Init(&argc, &argv);
    signal(SIGTERM, last_words);
    sleep(atoi(option("late", "0")));
    if (cpl_open(MPI_COMM_WORLD, argv[1], atof(option("deadline", "5")), &c, &mine) || !c)
        return MPI_Finalize(), 2;
    MPI_Comm_rank(mine, &rank);
    MPI_Comm_size(mine, &size);
    must(c, cpl_meet(c, strtoull(option("hash", "0"), NULL, 0), -1, 0, argv[3]));

    const int j0 = n * rank / size, j1 = n * (rank + 1) / size, rows = j1 - j0, m = n * rows;
    const double h = 1.0 / n;
    const struct cpl_grid g = {.dim = 2, .spacing = {h, h}, .cells = {n, n}, .periodic = {1, 1},
                               .lo = {0, j0}, .hi = {n, j1}};
    double *x = calloc(3 * m + 3, 8), *v = calloc(2 * m + 2, 8), *d = calloc(m + 1, 8), *w = calloc(m + 1, 8);
    int64_t *id = calloc(m + 1, 8);
    must(c, points ? cpl_points(c, "particles", 2, 0.0, &set) : cpl_grid(c, "cells", &g, &set));
    must(c, cpl_field(c, set, points ? "velocity" : "pressure", points ? option("unit", "m/s") : "Pa",
                      points ? 2 : 1, CPL_PUT, 0, &give));
    must(c, points ? CPL_OK : cpl_points(c, "targets", 2, 2.2 * h, &set));
    must(c, cpl_field(c, set, points ? "pressure" : "velocity", points ? "Pa" : "m/s", points ? 1 : 2,
                      CPL_GET, atoi(option(points ? "cubic" : "mls", "0")), &take));
    must(c, cpl_ready(c, 0.0, atof(option("dt", "0.1"))));
    for (int i = 0; i < m; i++) {
        x[3 * i] = (i % n + 0.5) * h, x[3 * i + 1] = (j0 + i / n + 0.5) * h;
        w[i] = h * h, id[i] = j0 * n + i;
        v[i] = sin(6.2831853 * x[3 * i]) * x[3 * i + 1], d[i] = v[i];
    }
    if (!points)
        must(c, cpl_put(c, give, 0.0, m, v, d)); /* what particles need in the first window */
    char name[1024];
    snprintf(name, sizeof name, "%s/%s.%d", argv[3], argv[1], rank);
    FILE *out = fopen(name, "w");
    for (; cpl_window(c, &t0, &t1, &action, &code) == CPL_OK && !(action & CPL_STOP);) {
        fault(c, v);
        must(c, cpl_move(c, set, m, x, id, w));
        if (points) {
            must(c, cpl_patch_get(c, take, (double[]){0, j0 * h, 0}, (double[]){1, j1 * h, 0}));
            cpl_patch_eval(c, take, t1, m, x, d, NULL);
            for (int i = 0; i < m; i++) {
                v[2 * i] = sin(x[3 * i] + t1) + 0 * v[2 * i], v[2 * i + 1] = cos(x[3 * i + 1] - t1);
                fprintf(out, "%lld %d %a\n", (long long)cpl_window_number(c), (int)id[i], d[i]);
                x[3 * i] += 0.01 * v[2 * i] * h;
            }
            must(c, cpl_put(c, give, t1, m, v, NULL));
        } else {
            must(c, cpl_get(c, take, m, v, NULL));
            for (int i = 0; i < m; i++)
                fprintf(out, "%lld %d %a %a\n", (long long)cpl_window_number(c), (int)id[i], v[2 * i],
                        v[2 * i + 1]);
            must(c, cpl_put(c, give, t1, m, v, d));
        }
        must(c, cpl_tell(c, "norm.velocity.e2", 1e-6 * m) | cpl_tell(c, "norm.velocity.r2", 1.0 * m));
        must(c, action & CPL_SAVE ? cpl_saved(c, "mock.h5") : CPL_OK);
        must(c, cpl_advance(c, t1, cpl_window_number(c) == atoi(option("end", "-1"))));
    }
    fclose(out);
    free(x), free(v), free(d), free(w), free(id);
    code = cpl_close(&c, code);
    MPI_Finalize();
    return code;
}

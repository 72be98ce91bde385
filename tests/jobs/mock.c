/* mock.c - the smallest complete solver, and the documentation of coupler/cpl.h.
 *   mock NAME points|grid DIR [key=value ...]
 * points: particles that give "velocity" and take "pressure" as a patch; grid: the reverse. What it
 * got goes to DIR/NAME.RANK in hexadecimal. Keys: mock_fault.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mock_fault.h"

struct mock {
    struct cpl *c;
    bool points;
    int n, rank, j0, j1; /* rows j0 <= j < j1 of an n x n lattice over the unit square */
    long m;
    double h, *x, *w, *velocity, *pressure;
    int64_t *id;
    int set, give, take;
};

static void make_lattice(struct mock *s)
{
    s->h = 1.0 / s->n;
    s->m = (long)s->n * (s->j1 - s->j0);
    s->id = calloc((size_t)s->m + 1, 8);
    s->x = calloc(7 * (size_t)s->m + 1, 8);
    s->w = s->x + 3 * s->m;
    s->velocity = s->w + s->m;
    s->pressure = s->velocity + 2 * s->m;
    for (long i = 0; i < s->m; i++) {
        s->x[3 * i] = ((double)(i % s->n) + 0.5) * s->h;
        s->x[3 * i + 1] = ((double)(s->j0 + i / s->n) + 0.5) * s->h;
        s->w[i] = s->h * s->h;
        s->id[i] = (int64_t)s->j0 * s->n + i;
        s->pressure[i] = sin(6.2831853 * s->x[3 * i]) * s->x[3 * i + 1];
    }
}

/* A set of places and its field to give, another field to take. */
static void make_plan(struct mock *s)
{
    struct cpl *c = s->c;
    struct cpl_grid g = {.dim = 2, .spacing = {s->h, s->h}, .cells = {s->n, s->n}};
    g.lo[1] = s->j0, g.hi[0] = s->n, g.hi[1] = s->j1, g.periodic[0] = g.periodic[1] = 1;
    const char *unit = option("unit", s->points ? "m/s" : "Pa");
    if (s->points) {
        must(c, cpl_points(c, "particles", number("dim", 2), 0.0, &s->set));
        must(c, cpl_field(c, s->set, "velocity", unit, 2, CPL_PUT, 0, &s->give));
        must(c, cpl_field(c, s->set, "pressure", "Pa", 1, CPL_GET, number("cubic", 0), &s->take));
    } else {
        must(c, cpl_grid(c, "cells", &g, &s->set));
        must(c, cpl_field(c, s->set, "pressure", unit, 1, number("back", CPL_PUT), 0, &s->give));
        must(c, cpl_points(c, "targets", 2, 2.2 * s->h, &s->set));
        must(c, cpl_field(c, s->set, "velocity", "m/s", 2, CPL_GET, number("mls", 0), &s->take));
    }
    must(c, cpl_ready(c, 0.0, atof(option("dt", "0.1"))));
    if (!s->points) /* what particles need in the first window */
        must(c, cpl_put(c, s->give, 0.0, s->m, s->pressure, s->pressure));
}

static void do_window(struct mock *s, double t1, FILE *out)
{
    struct cpl *c = s->c;
    const long long k = (long long)cpl_window_number(c);
    const double lo[3] = {0, s->j0 * s->h, 0}, hi[3] = {1, s->j1 * s->h, 0};
    double *const give = s->points ? s->velocity : s->pressure;
    const bool forget = s->rank == 0 && fault(c, give, s->m);
    if (k == 0 || !number("still", 0))
        must(c, cpl_move(c, s->set, s->m, s->x, s->id, s->w));
    if (s->points) {
        must(c, cpl_patch_get(c, s->take, lo, hi));
        cpl_patch_eval(c, s->take, t1, s->m, s->x, s->pressure, NULL);
    } else {
        must(c, cpl_get(c, s->take, s->m, s->velocity, NULL));
    }
    for (long i = 0; i < s->m; i++) {
        double *v = s->velocity + 2 * i, *x = s->x + 3 * i;
        fprintf(out, "%lld %d %a %a\n", k, (int)s->id[i], s->points ? s->pressure[i] : v[0], v[1]);
        if (!s->points)
            continue;
        v[0] = sin(x[0] + t1) + 0.0 * v[0]; /* keeps a NaN */
        v[1] = cos(x[1] - t1);
        x[0] += 0.01 * v[0] * s->h;
    }
    must(c, forget ? 0 : cpl_put(c, s->give, t1, s->m, give, s->points ? NULL : give));
}

int main(int argc, char **argv)
{
    struct mock s = {.points = !strcmp(argv[2], "points")};
    MPI_Comm mine;
    int size, action, code = 0;
    double t0, t1;
    char name[1024];
    MPI_Init(&argc, &argv);
    read_options(argv + 4);
    signal(SIGTERM, last_words);
    if (cpl_open(MPI_COMM_WORLD, argv[1], number("deadline", 10), &s.c, &mine) || !s.c)
        return MPI_Finalize(), 2;
    cpl_patience(s.c, number("patience", 120));
    MPI_Comm_rank(mine, &s.rank);
    MPI_Comm_size(mine, &size);
    s.n = number("n", 40), s.j0 = s.n * s.rank / size, s.j1 = s.n * (s.rank + 1) / size;
    must(s.c, cpl_meet(s.c, (uint64_t)number("hash", 0), -1, 0, argv[3]));
    make_lattice(&s);
    make_plan(&s);
    snprintf(name, sizeof name, "%s/%s.%d", argv[3], argv[1], s.rank);
    FILE *out = fopen(name, "w");
    for (;;) {
        must(s.c, cpl_window(s.c, &t0, &t1, &action, &code));
        if (action & CPL_STOP)
            break;
        do_window(&s, t1, out);
        must(s.c, cpl_tell(s.c, "norm.velocity.e2", 1e-6));
        must(s.c, cpl_tell(s.c, "norm.velocity.r2", 1.0));
        must(s.c, action & CPL_SAVE ? cpl_saved(s.c, "mock.h5") : CPL_OK);
        must(s.c, cpl_advance(s.c, t1, cpl_window_number(s.c) == number("end", -1)));
    }
    fclose(out);
    free(s.x), free(s.id);
    code = cpl_close(&s.c, code); /* the job's code: 1 when its results are not accepted */
    MPI_Finalize();
    return code;
}

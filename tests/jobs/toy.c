/* toy.c - the smallest solver that run_main can run: oscillators x'' = -x, shared out over the
 * ranks. tests/jobs/run.py runs it through outputs, restart, divergence, signals and refusals.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "../../common/base/log.h"
#include "../../common/base/mem.h"
#include "../../common/files/h5.h"
#include "../../common/files/xdmf.h"
#include "../../common/run/program.h"

static struct toy_params {
    double dt;   /* s */
    int n;       /* oscillators of all ranks */
    int bad;     /* step that fails; 0: none */
    int fault;   /* step that ends in a segmentation fault; 0: none */
    double slow; /* s to sleep in each step */
    int columns; /* of the series */
} params;

struct toy {
    struct run *run;
    int64_t n;
    double *x, *v; /* m, m/s */
};

/* clang-format off */
#define P struct toy_params
static const struct param rows[] = {
    PARAM(P, dt,    "s", "0.01", 1e-6, 1,   "time step"),
    PARAM(P, n,     "-", "10",   1,    1e6, "oscillators"),
    PARAM(P, bad,   "-", "0",    0,    1e9, "step that fails"),
    PARAM(P, fault, "-", "0",    0,    1e9, "step that ends in a segmentation fault"),
    PARAM(P, slow,  "s", "0.0",  0,    10,  "to sleep in each step"),
    PARAM(P, columns, "-", "1",  1,    1e4, "of the series, which tell the energy"),
};
#undef P
/* clang-format on */
static const struct param_group groups[] = {
    {"toy", "Oscillators", rows, sizeof rows / sizeof rows[0], &params, NULL, 0, 0, NULL}};
static const char *const others[] = {"sph", "apr", "fv", NULL};

static void describe(const struct run *r)
{
    log_say("toy: %d oscillators on %d ranks", params.n, r->size);
}

static void *create(struct run *r, struct h5 *f)
{
    const int64_t mine = params.n / r->size + (r->rank < params.n % r->size);
    const int64_t n = f ? h5_share(f, "x") : mine;
    int64_t all = n;
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT64_T, MPI_SUM, r->comm);
    if (all != params.n) {
        log_say("toy: the restart file has %lld oscillators", (long long)all);
        return NULL;
    }
    struct toy *s = NEW(struct toy, 1);
    *s = (struct toy){.run = r, .n = n, .x = NEW(double, n), .v = NEW(double, n)};
    for (int64_t i = 0; i < n; i++)
        s->x[i] = 1.0;
    if (f)
        require(h5_read_real(f, "x", n, 1, s->x) && h5_read_real(f, "v", n, 1, s->v));
    return s;
}

static void destroy(void *state)
{
    struct toy *s = state;
    FREE(s->x, s->v, s);
}

static double step(void *state, double t_stop, struct diagnosis *d)
{
    struct toy *s = state;
    const double left = t_stop - s->run->t, dt = left / ceil(left / params.dt - 1e-9);
    timer_start(&s->run->timers, "oscillators");
    for (int64_t i = 0; i < s->n; i++) { /* exact, so that the error is rounding */
        const double x = s->x[i], v = s->v[i];
        s->x[i] = x * cos(dt) + v * sin(dt);
        s->v[i] = v * cos(dt) - x * sin(dt);
    }
    timer_stop(&s->run->timers, "oscillators");
    if (s->run->step + 1 == params.fault)
        raise(SIGSEGV);
    if (s->run->step + 1 == params.bad && s->run->rank == s->run->size - 1) {
        *d = (struct diagnosis){.bad = true, .likely = "it was asked to fail"};
        snprintf(d->reason, sizeof d->reason, "oscillator %d is tired", params.n - 1);
        snprintf(d->where, sizeof d->where, "rank %d", s->run->rank);
    }
    run_diagnose(d, s->run->comm);
    usleep((useconds_t)(1e6 * params.slow));
    return dt;
}

static void row(void *state, struct figures *to)
{
    const struct toy *s = state;
    double e = 0.0;
    for (int64_t i = 0; i < s->n; i++)
        e += 0.5 * (s->x[i] * s->x[i] + s->v[i] * s->v[i]);
    MPI_Allreduce(MPI_IN_PLACE, &e, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    FIGURE(to, e, "energy [J]");
    for (int k = 1; k < params.columns; k++)
        FIGURE(to, e, "energy %d [J]", k + 1);
}

static void progress(void *state, char *line, int size)
{
    (void)state;
    snprintf(line, (size_t)size, "swings");
}

static void snapshot(void *state, struct h5 *f, struct xdmf *x, const char *file)
{
    struct toy *s = state;
    double *at = NEW(double, 2 * s->n);
    int64_t all = s->n;
    for (int64_t i = 0; i < s->n; i++)
        at[2 * i] = s->x[i];
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT64_T, MPI_SUM, s->run->comm);
    h5_write_real(f, "position", "m", s->n, 2, at, true);
    h5_write_real(f, "speed", "m/s", s->n, 1, s->v, true);
    if (x)
        xdmf_points(x, s->run->t, file, all, 2, 1, &(struct xdmf_field){"speed", 1});
    mem_free(at);
}

static void checkpoint(void *state, struct h5 *f)
{
    const struct toy *s = state;
    h5_write_real(f, "x", "m", s->n, 1, s->x, false);
    h5_write_real(f, "v", "m/s", s->n, 1, s->v, false);
}

static void finish(void *state)
{
    const struct toy *s = state;
    double e = 0.0;
    for (int64_t i = 0; i < s->n; i++)
        e = fmax(e, fabs(s->x[i] - cos(s->run->t)));
    MPI_Allreduce(MPI_IN_PLACE, &e, 1, MPI_DOUBLE, MPI_MAX, s->run->comm);
    summary_real(s->run->summary, "error.x_linf", e);
}

int main(int argc, char **argv)
{
    const struct program toy = {.name = "toy",
                                .help = "oscillators for the tests of run.c",
                                .groups = groups,
                                .ngroups = 1,
                                .other_groups = others,
                                .describe = describe,
                                .create = create,
                                .destroy = destroy,
                                .step = step,
                                .row = row,
                                .progress = progress,
                                .snapshot = snapshot,
                                .checkpoint = checkpoint,
                                .finish = finish};
    return run_main(argc, argv, &toy, NULL);
}

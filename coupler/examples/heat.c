/* heat.c - a plain solver that is coupled through cpl.h: heat in a wall of two layers, a program
 * each. dT/dt = D T_xx on 0 < x < 1 m, T = 0 outside, starts as sin(pi x); explicit Euler, half a
 * wall each, the neighbour's first cell comes by the coupler.
 *   mpirun -np 1 heat left DIR 40 : -np 1 coupler heat.cfg -o DIR : -np 1 heat right DIR 40
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl.h>

static struct cpl *c;

/* The library has told all programs of the job already, or the reason is ours alone: say it, leave.
 */
static void must(int code)
{
    if (code == CPL_OK)
        return;
    fprintf(stderr, "heat: %s\n", cpl_strerror(c));
    cpl_close(&c, -code); /* ends the job, if it has begun */
    MPI_Finalize();
    exit(-code);
}

int main(int argc, char **argv)
{
    const int left = argc > 1 && strcmp(argv[1], "left") == 0, n = argc > 3 ? atoi(argv[3]) : 0;
    const double D = 1.0, pi = acos(-1.0), h = n > 0 ? 0.5 / n : 1.0, x0 = left ? 0.0 : 0.5;
    double t0, t1, T[1002] = {0}, old[1002], ghost, sum = 0.0,
                   x[3] = {left ? 0.5 + 0.5 * h : 0.5 - 0.5 * h, 0.5, 0};
    int mine, theirs, put, get, action, code = 0, ranks = 0;
    MPI_Comm comm;
    MPI_Init(&argc, &argv);
    if (n < 1 || n > 1000 || cpl_open(MPI_COMM_WORLD, argv[1], 10.0, &c, &comm) || !c ||
        MPI_Comm_size(comm, &ranks) || ranks > 1) {
        fprintf(stderr, "usage, one rank each beside the coupler: heat left|right DIR CELLS\n");
        return MPI_Finalize(), 2;
    }
    must(cpl_meet(c, 0, -1, 0, argv[2])); /* 1: who is here, and where the job writes */
    const struct cpl_grid g = {2, {x0}, {h, 1}, {n, 1}, {0}, {0}, {n, 1}};
    must(cpl_grid(c, "cells", &g, &mine)); /* 2: what we hold, and where we look */
    must(cpl_points(c, "ghost", 2, 0.0, &theirs));
    must(cpl_field(c, mine, left ? "left.T" : "right.T", "K", 1, CPL_PUT, 0, &put));
    must(cpl_field(c, theirs, left ? "right.T" : "left.T", "K", 1, CPL_GET, CPL_LINEAR, &get));
    must(cpl_ready(c, 0.0, 0.25 * h * h / D)); /* 3: fits all that, or all programs say why not */
    for (int i = 0; i < n; i++)
        T[i + 1] = sin(pi * (x0 + (i + 0.5) * h));
    must(cpl_put(c, put, 0.0, n, T + 1, NULL)); /* 4: what the first window starts from */
    for (;;) {
        must(cpl_window(c, &t0, &t1, &action, &code)); /* 5: from where to where */
        if (action & CPL_STOP)
            break;
        must(cpl_patch_get_at(c, get, CPL_START, x, x)); /* 6: the neighbour's cell */
        cpl_patch_eval(c, get, t0, 1, x, &ghost, NULL);
        T[0] = left ? -T[1] : ghost;
        T[n + 1] = left ? ghost : -T[n];
        memcpy(old, T, sizeof T);
        for (int i = 1; i <= n; i++) /* our own work */
            T[i] += D * (t1 - t0) / (h * h) * (old[i - 1] - 2.0 * old[i] + old[i + 1]);
        must(cpl_put(c, put, t1, n, T + 1, NULL)); /* 7: what came of it */
        must(cpl_advance(c, t1, 0));               /* 8: done */
    }
    for (int i = 0; i < n; i++)
        sum += h * pow(T[i + 1] - exp(-pi * pi * D * t0) * sin(pi * (x0 + (i + 0.5) * h)), 2);
    printf("%s: T at t = %g s is off by %.3g K\n", argv[1], t0, sqrt(2.0 * sum));
    code = cpl_close(&c, code); /* 9: goodbye; the job's exit code */
    MPI_Finalize();
    return code;
}

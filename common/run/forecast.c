/* forecast.c - run time ahead of a run, see forecast.h: seconds per unit and step, times units,
 * times steps. Said by the programs' describe, that is also by --check, where it costs nothing to
 * be told that a case takes a week.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "forecast.h"

#include <unistd.h>

#include "../base/base.h"

/* bench.txt in the folder of this program; NULL: there is none. */
static FILE *open_figures(void)
{
    char path[1100];
    const ssize_t n = readlink("/proc/self/exe", path, sizeof path - 16);
    if (n <= 0)
        return NULL;
    path[n] = '\0';
    char *slash = strrchr(path, '/');
    snprintf(slash ? slash + 1 : path, 16, "bench.txt");
    return fopen(path, "r");
}

/* Steps end at outputs, so two steps or more between two of them cost at most half a step each. */
static void warn_every(const char *key, double every, double end, double steps)
{
    if (every > 0.0 && every < 0.5 * end / steps)
        log_warn("%s = %g s is far below a step of %.2g s: each output ends a step, so that %.3g "
                 "steps take the place of %.3g, each with a file; take %.2g s or more",
                 key, every, end / steps, ceil(end / every), steps, end / steps);
}

void forecast_warn_outputs(double every, double checkpoint, double end, double steps)
{
    warn_every("output.every", every, end, steps);
    warn_every("output.checkpoint", checkpoint, end, steps);
}

/* The last row of this program and dimension counts: `make bench' appends. */
void forecast_say(const char *program, int dim, double units, double steps)
{
    char name[64];
    double seconds = NAN, s;
    /* of several rows that fit the last one counts */
    const char *how = "about";
    int d;
    FILE *f = open_figures();
    while (f && fscanf(f, "%63s %d %lf", name, &d, &s) == 3)
        if (strcmp(name, program) == 0 && d == dim)
            seconds = s;
    if (f)
        fclose(f);
    if (!isfinite(seconds)) { /* of a core of 2020, in double precision */
        const bool particles = strcmp(program, "sph") == 0;
        seconds = particles ? (dim == 2 ? 2e-8 : 3e-8) : (dim == 2 ? 5e-7 : 1e-6);
        how = "within a factor of three (`make bench' measures this machine)";
    }
    const double cost = seconds * units * steps;
    if (cost < 120.0)
        log_say("run time: %s %.2g s of processor time", how, cost);
    else if (cost < 7200.0)
        log_say("run time: %s %.2g min of processor time", how, cost / 60.0);
    else
        log_say("run time: %s %.3g h of processor time", how, cost / 3600.0);
}

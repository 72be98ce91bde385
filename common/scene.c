/* scene.c - the table of the groups that every program reads. SPDX-License-Identifier: BSD-3-Clause
 */
#include "scene.h"

#include <math.h>
#include <string.h>

#define ROWS(r) (r), (int)(sizeof(r) / sizeof *(r))

/* clang-format off */
#define P struct scene_time
static const struct param time_rows[] = {
    PARAM(P, end, "s", NULL, 1e-12, 1e9, "time at which the run ends"),
};
#undef P
#define P struct scene_fluid
static const struct param fluid_rows[] = {
    PARAM(P, rho,     "kg/m^3", "1000.0",  1e-3, 1e5,  "density"),
    PARAM(P, nu,      "m^2/s",  "0.0",     0,    1e6,  "kinematic viscosity; 0: inviscid, nothing viscous is computed"),
    PARAM(P, gravity, "m/s^2",  "(0.0, 0.0, 0.0)", -1e6, 1e6, "acceleration of gravity"),
};
#undef P
#define P struct scene_domain
static const struct param domain_rows[] = {
    PARAM(P, dim,      "-", "2", 2, 3, "dimensions"),
    PARAM(P, min,      "m", "(0.0, 0.0, 0.0)", -1e9, 1e9, "lower corner"),
    PARAM(P, max,      "m", NULL, -1e9, 1e9, "upper corner"),
    PARAM(P, periodic, "-", "(false, false, false)", 0, 0, "directions in which the domain repeats itself"),
};
#undef P
#define P struct scene_initial
static const struct param initial_rows[] = {
    CHOICE(P, field, "rest|uniform|taylor_green|two_modes", "rest", "field at the start, and the exact solution after it"),
    PARAM(P, U,        "m/s", "1.0", 0, 1e6, "scale of velocity: amplitude of the field, unit of errors"),
    PARAM(P, L,        "m",   "1.0", 1e-9, 1e9, "wave length of the field"),
    PARAM(P, velocity, "m/s", "(0.0, 0.0, 0.0)", -1e6, 1e6, "uniform velocity, or the one that carries the field"),
};
#undef P
#define P struct scene_coupling
static const struct param coupling_rows[] = {
    PARAM(P, steps,      "-", "32",  1, 100000, "SPH steps in a window between two exchanges"),
    PARAM(P, transition, "m", "0.0", 0, 1e6, "width of the zone where SPH is blended with FV; 0: 1.25 R"),
    PARAM(P, buffer,     "m", "0.0", 0, 1e6, "width of the zone where SPH takes FV's fields; 0: 1.25 R"),
    PARAM(P, overlap,    "m", "0.0", 0, 1e6, "width of the rim of SPH's free zone where FV is free, too; 0: 1.25 R"),
    PARAM(P, memory,     "-", "10",  1, 1000, "windows over which the rate of change of FV's pressure is averaged"),
    CHOICE(P, mapping, "shepard|mls", "mls", "from particles to forced cells"),
    CHOICE(P, interpolation, "linear|cubic", "cubic", "from cells to particles"),
    PARAM(P, deadline,   "s", "30.0", 0.1, 1e6, "to meet the other programs of the job"),
};
#undef P
#define P struct scene_output
static const struct param output_rows[] = {
    PARAM(P, every,     "s", "0.0", 0, 1e9, "between snapshots; 0: the first and the last only"),
    PARAM(P, snapshots, "-", "true", 0, 0, "write HDF5 snapshots and their XDMF files"),
    PARAM(P, fields,    "-", "velocity pressure vorticity", 0, 0, "fields of a snapshot"),
    PARAM(P, series,    "-", "10", 1, 1e9, "steps between rows of series.csv"),
    PARAM(P, checkpoint,      "s", "0.0", 0, 1e9, "of simulated time between restart files; 0: only at a stop"),
    PARAM(P, checkpoint_wall, "s", "0.0", 0, 1e9, "of wall time between restart files; 0: none"),
};
#undef P
#define P struct scene_accept
static const struct param accept_rows[] = {
    PARAM(P, what,      "-", NULL, 0, 0, "key of summary.json, as error.velocity_l2"),
    PARAM(P, tolerance, "-", NULL, -1e300, 1e300, "largest value that is accepted"),
};
#undef P
/* clang-format on */

void scene_groups(struct scene *s, struct param_group *groups)
{
    const struct param_group all[SCENE_GROUPS] = {
        {"time", "How long", ROWS(time_rows), &s->time, NULL, 0, 0, NULL},
        {"fluid", "What flows", ROWS(fluid_rows), &s->fluid, NULL, 0, 0, NULL},
        {"domain", "Where it flows", ROWS(domain_rows), &s->domain, NULL, 0, 0, NULL},
        {"initial", "How it starts", ROWS(initial_rows), &s->initial, NULL, 0, 0, NULL},
        {"coupling", "How the programs of a coupled job meet", ROWS(coupling_rows), &s->coupling,
         &s->has_coupling, 0, 0, NULL},
        {"output", "What is written", ROWS(output_rows), &s->output, &s->has_output, 0, 0, NULL},
        {"accept", "List of what the result must keep for exit code 0", ROWS(accept_rows),
         s->accept, NULL, sizeof s->accept[0], ACCEPT_MAX, &s->naccept},
    };
    memcpy(groups, all, sizeof all);
}

static void check_domain(const struct scene *s, const struct params *p, struct faults *f)
{
    static const char axes[] = "xyz";
    const struct scene_domain *d = &s->domain;
    for (int a = 0; a < d->dim && a < 3; a++)
        if (!(d->max[a] > d->min[a]))
            params_fault(p, f, "domain.max", "%c: %g m is not above domain.min, %g m", axes[a],
                         d->max[a], d->min[a]);
    for (int a = d->dim; a < 3; a++)
        if (s->fluid.gravity[a] != 0.0 || s->initial.velocity[a] != 0.0)
            params_fault(p, f, s->fluid.gravity[a] != 0.0 ? "fluid.gravity" : "initial.velocity",
                         "%c component in a case of %d dimensions", axes[a], d->dim);
}

/* A wave field repeats itself only over whole wave lengths. */
static void check_field(const struct scene *s, const struct params *p, struct faults *f)
{
    if (s->initial.field != FIELD_TAYLOR_GREEN && s->initial.field != FIELD_TWO_MODES)
        return;
    for (int a = 0; a < 2; a++) {
        const double n = (s->domain.max[a] - s->domain.min[a]) / s->initial.L;
        if (s->domain.periodic[a] && fabs(n - round(n)) > 1e-9)
            params_fault(
                p, f, "initial.L",
                "%g m: the periodic domain holds %g wave lengths, a whole number is wanted",
                s->initial.L, n);
    }
}

void scene_check(const struct scene *s, const struct params *p, struct faults *f)
{
    static const char *const needed[] = {"time", "domain"};
    for (int k = 0; k < 2; k++)
        if (!params_has_group(p, needed[k]))
            params_fault(p, f, needed[k], "the case must have this group");
    if (f->n)
        return; /* what follows needs sound values */
    check_domain(s, p, f);
    check_field(s, p, f);
}

/* fv_keep.c - a copy of all that a step starts from, so that steps can be taken back: what a
 * restart file holds, in memory. SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../../common/base/base.h"
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../operators/fv_operators.h"
#include "../surface/fv_surface.h"
#include "newton.h"
#include "steps.h"

/* All fields that a step starts from, ghosts and all: bit for bit on the same ranks. */
int fv_restart_fields(const struct fv *s, double **f, const char **names)
{
    static const char *const vector[][3] = {{"u0", "u1", "u2"},          {"U0", "U1", "U2"},
                                            {"N0", "N1", "N2"},          {"old0", "old1", "old2"},
                                            {"step0", "step1", "step2"}, {"out0", "out1", "out2"}};
    static const char *const starts[][3] = {{"psi0", "psi1", "psi2"}, {"z0", "z1", "z2"}};
    static const char *const pasts[][3] = {{"past0", "past1", "past2"},
                                           {"older0", "older1", "older2"}};
    int n = 0;
    f[n] = s->p;
    names[n++] = "p";
    f[n] = s->p_before;
    names[n++] = "p_before";
    if (s->fringe.z) {
        f[n] = s->fringe.z;
        names[n++] = "zw";
    }
    if (s->surface) {
        f[n] = s->surface->phi;
        names[n++] = "phi";
        if (s->surface->fraction) {
            f[n] = s->surface->fraction->C;
            names[n++] = "C";
            f[n] = s->surface->fraction->layer;
            names[n++] = "layer";
        }
        for (int k = 0; k < 2 && s->surface->forced; k++) {
            f[n] = s->surface->forced->phi[k];
            names[n++] = k ? "phi_end" : "phi_start";
        }
    }
    for (int a = 0; a < 3; a++) {
        double *const all[] = {s->u[a],
                               s->U[a],
                               s->stages.N[a],
                               s->stages.u_old[a],
                               viscous_keeps_increment(s) ? s->delta[a] : NULL,
                               s->outflows ? s->outflows->kept[a] : NULL};
        for (int k = 0; k < 6; k++)
            if (all[k]) {
                f[n] = all[k];
                names[n++] = vector[k][a];
            }
        double *const of_solves[] = {s->stages.psi[a], s->stages.start[a]};
        for (int k = 0; k < 2; k++)
            if (of_solves[k]) {
                f[n] = of_solves[k];
                names[n++] = starts[k][a];
            }
        for (int k = 0; k < 2; k++)
            if (s->partners.past[k][a]) {
                f[n] = s->partners.past[k][a];
                names[n++] = pasts[k][a];
            }
    }
    return n;
}

struct kept {
    double *fields[FV_RESTART_FIELDS];
    double t;
    struct fv_step step;
    struct flow_maxima max;
    struct fv_speeds speed;
    struct fv_totals totals;
    double volume0, returned, lost, gained, passed, entered, travelled; /* of a free surface */
    double carries, calm, first;                                        /* of its shares */
    double dtau, norm;                                                  /* of newton */
    double lacks[6];                                                    /* of given discharges */
    int64_t newtons, krylovs, cycles, halvings;
};

struct kept *kept_create(const struct fv *s)
{
    struct kept *k = NEW(struct kept, 1);
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, fields, names);
    for (int i = 0; i < n; i++)
        k->fields[i] = NEW(double, s->size);
    return k;
}

void kept_free(struct kept **kp)
{
    struct kept *k = *kp;
    if (!k)
        return;
    for (int i = 0; i < FV_RESTART_FIELDS; i++)
        mem_free(k->fields[i]);
    mem_free(k);
    *kp = NULL;
}

static void copy(void *kept, void *now, size_t bytes, bool back)
{
    if (bytes > 0)
        memcpy(back ? now : kept, back ? kept : now, bytes);
}

/* Both ways: into the copy, or `back'. */
static void carry(struct fv *s, struct kept *k, bool back)
{
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, fields, names);
#define CARRY(kept, now) copy(&(kept), &(now), sizeof(now), back)
    for (int i = 0; i < n; i++)
        copy(k->fields[i], fields[i], (size_t)s->size * sizeof(double), back);
    CARRY(k->t, s->t);
    CARRY(k->step, s->step);
    CARRY(k->max, s->max);
    CARRY(k->speed, s->speed);
    CARRY(k->totals, s->totals);
    if (s->surface) {
        CARRY(k->volume0, s->surface->volume0);
        CARRY(k->returned, s->surface->returned);
        CARRY(k->lost, s->surface->lost);
        CARRY(k->gained, s->surface->gained);
        CARRY(k->passed, s->surface->passed);
        CARRY(k->entered, s->surface->entered);
        CARRY(k->travelled, s->surface->travelled);
    }
    if (s->surface && s->surface->fraction) {
        CARRY(k->carries, s->surface->fraction->carries);
        CARRY(k->calm, s->surface->fraction->calm);
        CARRY(k->first, s->surface->fraction->first);
    }
    if (s->outflows)
        CARRY(k->lacks, s->outflows->lacks);
    if (s->newton) {
        CARRY(k->dtau, s->newton->dtau);
        CARRY(k->norm, s->newton->norm);
        CARRY(k->newtons, s->newton->newtons);
        CARRY(k->krylovs, s->newton->krylovs);
        CARRY(k->cycles, s->newton->cycles);
        CARRY(k->halvings, s->newton->halvings);
    }
#undef CARRY
}

void kept_take(struct kept *k, struct fv *s) { carry(s, k, false); }
void kept_put_back(struct kept *k, struct fv *s)
{
    carry(s, k, true);
    fraction_forget_flows(s);
    outflow_restore(s);
}

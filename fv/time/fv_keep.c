/* fv_keep.c - a copy of all that a step starts from, so that steps can be taken back: what a
 * restart file holds, in memory. SPDX-License-Identifier: BSD-3-Clause */

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
            for (int a = 0; a < s->dim && s->surface->fraction->passed[a]; a++) {
                static const char *const passed[] = {"passed0", "passed1", "passed2"};
                f[n] = s->surface->fraction->passed[a];
                names[n++] = passed[a];
            }
        }
        for (int k = 0; k < 2 && s->surface->forced; k++) {
            f[n] = s->surface->forced->phi[k];
            names[n++] = k ? "phi_end" : "phi_start";
        }
    }
    for (int a = 0; a < 3; a++) {
        double *const all[] = {s->u[a],
                               s->U[a],
                               s->prm.integrator == INTEGRATOR_BDF2 ? s->stages.N[a] : NULL,
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

/* A list of numbers under construction. */
struct kept_numbers {
    int n;
    struct kept_number *is;
};

/* `of' names what they belong to, in the message about a restart file that lacks one. */
static void add(struct kept_numbers *to, const char *of, const struct kept_number *list, int n)
{
    for (int k = 0; k < n; k++) {
        to->is[to->n] = list[k];
        to->is[to->n++].of = of;
    }
}

#define ADD(to, of, list) add(to, of, list, (int)(sizeof(list) / sizeof *(list)))

/* Volumes, fractions and a partner's surface as far as this run has them. */
static void add_surface(struct kept_numbers *to, struct surface *f)
{
    const struct kept_number volumes[] = {{"volume0", .real = &f->volume0},
                                          {"returned", .real = &f->returned},
                                          {"lost", .real = &f->lost},
                                          {"gained", .real = &f->gained},
                                          {"travelled", .real = &f->travelled},
                                          {"passed", .real = &f->passed},
                                          {"calm_steps", .real = &f->calm},
                                          {"reinitialisations", .count = &f->reinits},
                                          {"steps_repeated", .count = &f->repeats}};
    ADD(to, "surface", volumes);
    if (f->fraction) {
        struct fraction *q = f->fraction;
        const struct kept_number shares[] = {
            {"carries", .real = &q->carries},         {"calm", .real = &q->calm},
            {"first_axis", .real = &q->first},        {"moved", .real = &q->moved},
            {"passed_time", .real = &q->passed_time}, {"was_read", .real = &q->was_read}};
        ADD(to, "shares of water", shares);
    }
    if (f->forced) {
        const struct kept_number forced[] = {{"phi_start_t", .real = f->forced->t},
                                             {"phi_end_t", .real = f->forced->t + 1},
                                             {"entered", .real = &f->entered}};
        ADD(to, "surface of a partner", forced);
    }
}

int fv_surface_numbers(struct surface *f, struct kept_number *of)
{
    struct kept_numbers all = {.is = of};
    add_surface(&all, f);
    return all.n;
}

static void add_openings(struct kept_numbers *to, struct levels *l)
{
    static const char *const names[LEVEL_GROUPS] = {
        "outflow_x_min", "outflow_x_max", "outflow_y_min", "outflow_y_max",
        "outflow_z_min", "outflow_z_max", "outflow_others"};
    for (int k = 0; k < LEVEL_GROUPS; k++) {
        const struct kept_number mean[] = {{names[k], .real = l->past + k}};
        ADD(to, "mean velocity of the openings", mean);
    }
}

static void add_discharges(struct kept_numbers *to, struct outflows *o)
{
    static const char *const names[6] = {"lacks_x_min", "lacks_x_max", "lacks_y_min",
                                         "lacks_y_max", "lacks_z_min", "lacks_z_max"};
    for (int k = 0; k < 6; k++) {
        const struct kept_number lacks[] = {{names[k], .real = o->lacks + k}};
        ADD(to, "volume that given discharges lack", lacks);
    }
}

static void add_newton(struct kept_numbers *to, struct newton *w)
{
    const struct kept_number newton[] = {
        {"dtau", .real = &w->dtau},        {"longest_step", .real = &w->longest_step},
        {"pace", .real = &w->pace},        {"residual", .real = &w->norm},
        {"steady", .flag = &w->steady},    {"best", .real = &w->best},
        {"best_at", .count = &w->best_at}, {"pseudo_steps", .count = &w->pseudo_steps},
        {"newtons", .count = &w->newtons}, {"krylovs", .count = &w->krylovs}};
    ADD(to, "state of Newton's method", newton);
}

int fv_restart_numbers(struct fv *s, struct kept_number *of)
{
    struct kept_numbers all = {.is = of};
    const struct kept_number steps[] = {{"dt", .real = &s->step.dt},
                                        {"dt_old", .real = &s->step.dt_old}};
    const struct kept_number most[] = {{"max_cfl", .real = &s->totals.max_cfl},
                                       {"fastest", .real = &s->totals.fastest},
                                       {"reference", .real = &s->speed.reference}};
    ADD(&all, "time step", steps);
    ADD(&all, "maxima of the run", most);
    if (s->newton)
        add_newton(&all, s->newton);
    if (s->surface)
        add_surface(&all, s->surface);
    if (levels_set_any(s))
        add_openings(&all, s->levels);
    if (s->surface && s->outflows)
        add_discharges(&all, s->outflows);
    return all.n;
}

/* All kinds as double, which is what files have. */
double kept_number_get(const struct kept_number *x)
{
    return x->real ? *x->real : x->count ? (double)*x->count : (double)*x->flag;
}

void kept_number_set(const struct kept_number *x, double value)
{
    if (x->real)
        *x->real = value;
    else if (x->count)
        *x->count = llround(value);
    else
        *x->flag = value != 0.0;
}

struct kept {
    double *fields[FV_RESTART_FIELDS];
    double t;
    struct fv_step step;
    struct flow_maxima max;
    struct fv_speeds speed;
    struct fv_totals totals;
    double numbers[FV_RESTART_NUMBERS];
    double entered;           /* of a free surface */
    int64_t cycles, halvings; /* of newton: what restart files leave out */
};

/* The list is that of restart files, so that what one knows the other knows, too. */
struct kept *kept_create(const struct fv *s)
{
    struct kept *k = NEW(struct kept, 1);
    double *fields[FV_RESTART_FIELDS];
    const char *names[FV_RESTART_FIELDS];
    const int n = fv_restart_fields(s, fields, names);
    for (int i = 0; i < n; i++)
        k->fields[i] = NEW_IN(k, double, s->size);
    return k;
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
    struct kept_number numbers[FV_RESTART_NUMBERS];
    const int nnumbers = fv_restart_numbers(s, numbers);
    for (int i = 0; i < nnumbers; i++)
        if (back)
            kept_number_set(numbers + i, k->numbers[i]);
        else
            k->numbers[i] = kept_number_get(numbers + i);
    CARRY(k->t, s->t);
    CARRY(k->step, s->step);
    CARRY(k->max, s->max);
    CARRY(k->speed, s->speed);
    CARRY(k->totals, s->totals);
    if (s->surface)
        CARRY(k->entered, s->surface->entered);
    if (s->newton) {
        CARRY(k->cycles, s->newton->cycles);
        CARRY(k->halvings, s->newton->halvings);
    }
#undef CARRY
}

void kept_take(struct kept *k, struct fv *s) { carry(s, k, false); }
/* Flows of shares and of openings are not kept: the next step finds them anew from the fields. */
void kept_put_back(struct kept *k, struct fv *s)
{
    carry(s, k, true);
    fraction_forget_flows(s);
    outflow_restore(s);
}

/* forces.c - see forces.h. Sums by owner: each body, all walls at rest (REST). A stage's forces
 * (stage) enter those of the step with its weight times dt (step), which at the end of the step are
 * summed over the ranks, added to the impulse since the start and, over dt, are the force that
 * series and gauges show (now). hit holds impulses of particles that were put back. Moments are
 * about each body's centre, of walls about the origin.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "forces.h"

#include "../particles/sph_particles.h"

enum { REST = BODIES_MAX, SIDES = BODIES_MAX + 1, PARTS = sizeof(struct force) / sizeof(double) };

/* Of all bodies that bend: zeroes a load; adds a load of the walls `from', of another level or the
 * same, to one. */
static void clear_bends(struct walls *w, enum bend_load which)
{
    for (int k = 0; k < w->nbodies; k++)
        if (w->bodies[k].bend)
            body_bend_clear(w->bodies[k].bend, which);
}

static void add_bends(struct walls *w, enum bend_load to, double factor, const struct walls *from,
                      enum bend_load of)
{
    for (int k = 0; k < w->nbodies; k++)
        if (w->bodies[k].bend)
            body_bend_add(w->bodies[k].bend, to, factor, from->bodies[k].bend, of);
}

/* Called by a model that reports forces, before it reports those of a stage: the flag `credited'
 * tells the others from it. */
void forces_clear(struct walls *w)
{
    memset(w->forces.stage, 0, sizeof w->forces.stage);
    clear_bends(w, BEND_STAGE);
    w->forces.credited = true;
}

/* x, which may lie beside a body's image across a period, where it is nearest to the middle of the
 * body itself. */
static double beside_body(const struct sph *s, int body, const double *x, int axis)
{
    const double middle = s->walls->middle[body][axis], L = s->hi[axis] - s->lo[axis];
    return x[axis] - (s->periodic[axis] ? L * round((x[axis] - middle) / L) : 0.0);
}

/* A disc, a ball or a cylinder that slips (FORM_NONE: none of these). What scene_cut.h leaves of
 * one at sides and beds has another box, so that its middle is not known. */
static enum body_form round_and_slips(const struct sph *s, const struct body *b)
{
    const enum body_form form = scene_form_of(b->is);
    const bool slips = b->is->kind == WALL_SLIP || s->nu == 0.0;
    if (!slips || b->is->cut || b->bend)
        return FORM_NONE;
    return form == FORM_ROUND || form == FORM_CYLINDER ? form : FORM_NONE;
}

/* The axis of a cylinder, which is drawn along z, or of a disc. */
static void axis_of(const struct body *b, double *axis)
{
    const double z[3] = {0.0, 0.0, 1.0};
    double r[3] = {0.0}, Q[3][3];
    vec3_add(r, M_PI / 180.0, b->is->surface.rotate);
    rotation_of_vector(r, Q);
    turn3(Q, z, axis);
    turn3((double(*)[3])b->now.Q, axis, axis);
}

/* Pressure turns no round body: none goes past the middle of a ball, or past the axis of a disc or
 * a cylinder. But what particles give to one acts where they are, and the weight of those beside it
 * is as much on either side only in the mean: a disc of five particles half in still water gathered
 * 0.7 rad/s in 4 s. Takes from M, the moment of F at d from the centre, what so turns the body. */
static void keep_unturned(const struct sph *s, int body, const double *d, const double *F,
                          double *M)
{
    const struct body *b = s->walls->bodies + body;
    const enum body_form round = round_and_slips(s, b);
    const bool ball = s->dim == 3 && round == FORM_ROUND;
    double arm[3] = {0.0}, axis[3] = {0.0, 0.0, 1.0}, turn[3];
    if (round == FORM_NONE)
        return;
    for (int a = 0; a < s->dim; a++)
        arm[a] = d[a] + body_centre(b, a) - s->walls->middle[body][a];
    vec3_cross(arm, F, turn);
    if (s->dim == 3 && !ball)
        axis_of(b, axis);
    const double about = vec3_dot(axis, turn);
    for (int a = 0; a < 3; a++)
        M[a] -= ball ? turn[a] : about * axis[a];
}

/* Adds F and its moment x cross F. In 2D the components beyond the plane are 0, so M has its part
 * about z alone. */
static void add(const struct sph *s, struct force to[SIDES], int body, const double *x,
                const double *f)
{
    const struct body *b = body < 0 ? NULL : s->walls->bodies + body;
    struct force *sum = to + (body < 0 ? REST : body);
    double d[3] = {0.0, 0.0, 0.0}, F[3] = {0.0, 0.0, 0.0}, M[3];
    for (int a = 0; a < s->dim; a++) {
        F[a] = f[a];
        d[a] = b ? beside_body(s, body, x, a) - body_centre(b, a) : x[a];
    }
    vec3_cross(d, F, M);
    if (b)
        keep_unturned(s, body, d, F, M);
    vec3_add(sum->F, 1.0, F);
    vec3_add(sum->M, 1.0, M);
}

/* The bend of a body, NULL: it is rigid, or at rest; *at: x beside it. */
static struct body_bend *bend_of(const struct sph *s, int body, const double *x, double at[2])
{
    struct body_bend *bend = body < 0 ? NULL : s->walls->bodies[body].bend;
    for (int a = 0; bend && a < 2; a++)
        at[a] = beside_body(s, body, x, a);
    return bend;
}

/* x, m, is where the force acts, as particles see it: it may lie beside an image of the body. f in
 * N, per metre along z in 2D. */
void forces_add(const struct sph *s, int body, const double *x, const double *f)
{
    double at[2];
    const struct body_bend *bend = bend_of(s, body, x, at);
    add(s, s->walls->forces.stage, body, x, f);
    if (bend)
        body_bend_load(bend, at, f, BEND_STAGE);
}

void forces_add_at_rest(const struct sph *s, const double force[3], const double moment[3])
{
    struct force *sum = s->walls->forces.stage + REST;
    for (int a = 0; a < 3; a++) {
        sum->F[a] += force[a];
        sum->M[a] += moment[a];
    }
}

/* An impulse, N s, goes into the step at once, for it is not part of a stage's rate; `hit' keeps it
 * apart, too, for free bodies, which get it after their own stages. */
void forces_hit(const struct sph *s, int body, const double *x, const double *impulse)
{
    double at[2];
    const struct body_bend *bend = bend_of(s, body, x, at);
    add(s, s->walls->forces.step, body, x, impulse);
    add(s, s->walls->forces.hit, body, x, impulse);
    if (bend)
        body_bend_load(bend, at, impulse, BEND_STEP);
}

static void add_times(struct force *to, double factor, const struct force *f)
{
    for (int a = 0; a < 3; a++) {
        to->F[a] += factor * f->F[a];
        to->M[a] += factor * f->M[a];
    }
}

/* The finer levels' walls are copies of the coarsest level's, and what pushes each is one body: so
 * the loads of all levels are added to the coarsest level's before bodies move. */
void forces_join_stage(struct walls *to, const struct walls *from)
{
    for (int b = 0; b < SIDES; b++)
        add_times(to->forces.stage + b, 1.0, from->forces.stage + b);
    add_bends(to, BEND_STAGE, 1.0, from, BEND_STAGE);
}

void forces_join_step(struct walls *to, struct walls *from)
{
    struct wall_forces *f = &from->forces;
    for (int b = 0; b < SIDES; b++) {
        add_times(to->forces.step + b, 1.0, f->step + b);
        add_times(to->forces.hit + b, 1.0, f->hit + b);
    }
    memset(f->step, 0, sizeof f->step);
    memset(f->hit, 0, sizeof f->hit);
    add_bends(to, BEND_STEP, 1.0, from, BEND_STEP);
    clear_bends(from, BEND_STEP);
}

/* Morris's term is nu Lap u, whose traction on a wall is mu du/dn. The stress on a wall that turns
 * at w is mu (du/dn - w x n), for there the other half of the gradient is not 0; over a closed
 * surface the difference is no force but the moment -2 mu V w, +2 mu V w round a tank's water: of
 * Couette flow between two cylinders, r1/r2 = 1/2, three eighths of the torque. Monaghan's pairs
 * push along the line of centres, and their moment is whole. What the fluid loses is the first: it
 * is what the watch of the energy knows. */
void forces_add_turning(const struct sph *s, int k, double moment[3])
{
    const struct body *b = s->walls->bodies + k;
    if (b->is->kind != WALL_NO_SLIP || s->prm.viscosity != VISCOSITY_MORRIS)
        return;
    const double V = b->is->tank ? -b->volume : b->volume;
    for (int a = 0; a < 3; a++)
        moment[a] -= 2.0 * s->rho0 * s->nu * V * b->now.omega[a];
}

/* What is the same on all ranks and levels (reference pressure, friction of turning) is added by
 * one rank of the coarsest level, since steps are summed over both. */
void forces_stage(struct sph *s, double dt)
{
    struct wall_forces *f = &s->walls->forces;
    for (int b = 0; b < SIDES; b++)
        add_times(f->step + b, dt, f->stage + b);
    add_bends(s->walls, BEND_STEP, dt, s->walls, BEND_STAGE);
    if (s->run->rank == 0 && s->level == 0)
        add_bends(s->walls, BEND_STEP, dt, s->walls, BEND_REFERENCE);
    for (int k = 0; k < s->walls->nbodies && s->run->rank == 0 && s->level == 0; k++) {
        struct force besides = f->reference[k];
        forces_add_turning(s, k, besides.M);
        add_times(f->step + k, dt, &besides);
    }
}

/* The first body over the second half of the run. */
static void sample(struct sph *s, double dt)
{
    const double *now = s->walls->forces.now[0].F;
    const double part = fmin(dt, s->t - 0.5 * s->run->scene.time.end);
    if (part <= 0.0)
        return;
    s->total.mean_force.time += part;
    for (int a = 0; a < s->dim; a++) {
        s->total.mean_force.sum[a] += part * now[a];
        s->total.mean_force.sum2 += part * now[a] * now[a];
    }
}

/* Collective. After it `now' and `impulse' are equal on all ranks, and `step' is empty for the next
 * step. */
void forces_step(struct sph *s, double dt)
{
    struct wall_forces *f = &s->walls->forces;
    if (!f->credited)
        return;
    MPI_Allreduce(MPI_IN_PLACE, f->step, PARTS * SIDES, MPI_DOUBLE, MPI_SUM, s->run->comm);
    if (s->walls->any_free) { /* the same bits on all ranks, whatever a reduction to all would do */
        const bool root = s->run->rank == 0;
        MPI_Reduce(root ? MPI_IN_PLACE : (void *)f->hit, f->hit, PARTS * SIDES, MPI_DOUBLE, MPI_SUM,
                   0, s->run->comm);
        MPI_Bcast(f->hit, PARTS * SIDES, MPI_DOUBLE, 0, s->run->comm);
    }
    memset(f->now, 0, sizeof f->now);
    for (int b = 0; b < SIDES; b++) {
        add_times(f->impulse + b, 1.0, f->step + b);
        add_times(f->now + b, 1.0 / dt, f->step + b);
    }
    memset(f->step, 0, sizeof f->step);
    for (int k = 0; k < s->walls->nbodies; k++) {
        const struct body_bend *bend = s->walls->bodies[k].bend;
        if (bend)
            MPI_Allreduce(MPI_IN_PLACE, bend->load[BEND_STEP], 2 * bend->n, MPI_DOUBLE, MPI_SUM,
                          s->run->comm);
    }
    add_bends(s->walls, BEND_WINDOW, 1.0, s->walls, BEND_STEP);
    clear_bends(s->walls, BEND_STEP);
    f->known = true;
    if (s->walls->nbodies > 0)
        sample(s, dt);
}

bool forces_of(const struct sph *s, int k, struct force *f)
{
    if (s->walls->forces.known)
        *f = s->walls->forces.now[k];
    return s->walls->forces.known;
}

enum { SAVED = 2 * PARTS * SIDES };

void forces_save(const struct sph *s, struct h5 *f)
{
    const struct wall_forces *w = &s->walls->forces;
    double row[SAVED];
    memcpy(row, w->now, sizeof w->now);
    memcpy(row + PARTS * SIDES, w->impulse, sizeof w->impulse);
    h5_write_real(f, "forces", "N, N s", w->known ? 1 : 0, SAVED, row, false);
}

bool forces_load(struct sph *s, struct h5 *f)
{
    struct wall_forces *w = &s->walls->forces;
    int64_t n;
    double *rows = h5_read_all_real(f, "forces", SAVED, &n);
    w->known = rows && n > 0;
    if (w->known) { /* all ranks hold the same */
        memcpy(w->now, rows, sizeof w->now);
        memcpy(w->impulse, rows + PARTS * SIDES, sizeof w->impulse);
    }
    mem_free(rows);
    return rows != NULL;
}

/* The mean over T of the first body's force by one of the two rules, and, if it is the one that
 * counts, how far it is from the wanted one. Returns the square of its size. error.force is
 * relative to the scene's own `force' of the first body; it is left out where that is 0. */
static double summarise_mean(const struct sph *s, const char *rule, const double *sum, double T,
                             bool counts)
{
    const double *wanted = s->run->scene.bodies[0].force, size = vec3_length(wanted);
    double mean[3] = {0.0, 0.0, 0.0};
    vec3_add(mean, 1.0 / T, sum);
    for (int a = 0; a < s->dim; a++)
        summary_real(s->run->summary, key_text("force.%s%c", rule, "xyz"[a]), mean[a]);
    if (counts && size > 0.0)
        summary_real(s->run->summary, "error.force", vec3_distance(mean, wanted) / size);
    return vec3_dot(mean, mean);
}

/* Of models that credit nothing there is the average alone. */
static void summarise_body(const struct sph *s)
{
    const struct mean_force *m = &s->total.mean_force;
    const bool known = s->walls->forces.known;
    if (known && m->time > 0.0) {
        const double mean2 = summarise_mean(s, "", m->sum, m->time, true);
        summary_real(s->run->summary, "force.rms", sqrt(fmax(0.0, m->sum2 / m->time - mean2)));
    }
    if (m->average_time > 0.0)
        summarise_mean(s, "average_", m->average_sum, m->average_time, !known);
}

/* Momentum now less that of the start, less gravity's impulse, plus what bodies and walls got, over
 * the largest of these or the momentum at the scale of velocity. Where openings or a central
 * acceleration add to it, or particles that left took it along, nobody has booked that. With levels
 * it also holds what guards take and do not give back. */
static void summarise_balance(const struct sph *s)
{
    const struct wall_forces *f = &s->walls->forces;
    double sums[SUM_COUNT], defect2 = 0.0, scale = s->start.mass * s->run->scene.initial.U;
    double lost = 0.0;
    for (const struct sph *q = s; q; q = q->finer) {
        lost += q->total.lost;
        for (int side = 0; side < 6; side++)
            lost += q->total.fallen[side];
    }
    MPI_Allreduce(MPI_IN_PLACE, &lost, 1, MPI_DOUBLE, MPI_SUM, s->run->comm);
    if (s->zones || s->central > 0.0 || lost > 0.0)
        return;
    sph_sums(s, sums);
    for (int a = 0; a < s->dim; a++) {
        const double gravity = s->start.mass * s->gravity[a] * s->t;
        double left = sums[SUM_MOMENTUM + a] - s->start.momentum[a] - gravity;
        for (int b = 0; b < SIDES; b++) {
            left += f->impulse[b].F[a];
            scale = fmax(scale, fabs(f->impulse[b].F[a]));
        }
        defect2 += left * left;
        scale = fmax(scale, fabs(gravity));
    }
    summary_real(s->run->summary, "momentum.defect", sqrt(defect2) / scale);
}

void forces_summarise(const struct sph *s)
{
    if (s->walls->nbodies > 0)
        summarise_body(s);
    if (s->walls->forces.known)
        summarise_balance(s);
}

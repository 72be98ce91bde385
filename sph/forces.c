/* forces.c - see forces.h. SPDX-License-Identifier: BSD-3-Clause */
#include "forces.h"

#include <math.h>
#include <string.h>

#include "../common/h5.h"
#include "../common/mem.h"

enum { REST = BODIES_MAX, SIDES = BODIES_MAX + 1 };

void forces_clear(struct walls *w)
{
    memset(w->forces.stage, 0, sizeof w->forces.stage);
    w->forces.credited = true;
}

static void add(const struct walls *w, double to[SIDES][3], int body, const double *x,
                const double *f)
{
    double *sum = to[body < 0 ? REST : body], d[2] = {x[0], x[1]};
    for (int a = 0; a < 2 && body >= 0; a++)
        d[a] -= w->bodies[body].is->centre[a] + w->bodies[body].now.x[a];
    sum[0] += f[0];
    sum[1] += f[1];
    sum[2] += d[0] * f[1] - d[1] * f[0];
}

void forces_add(struct walls *w, int body, const double *x, const double f[2])
{
    add(w, w->forces.stage, body, x, f);
}

void forces_hit(struct walls *w, int body, const double *x, const double impulse[2])
{
    add(w, w->forces.step, body, x, impulse);
}

void forces_stage(struct sph *s, int k, double dt)
{
    static const double weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    struct wall_forces *f = &s->walls->forces;
    for (int b = 0; b < SIDES; b++)
        for (int a = 0; a < 3; a++)
            f->step[b][a] += weight[k] * dt * f->stage[b][a];
}

/* The first body over the second half of the run. */
static void sample(struct sph *s, double dt)
{
    const double *now = s->walls->forces.now[0];
    const double part = fmin(dt, s->t - 0.5 * s->run->scene.time.end);
    if (part <= 0.0)
        return;
    s->force_time += part;
    for (int a = 0; a < 2; a++) {
        s->force_sum[a] += part * now[a];
        s->force_sum2 += part * now[a] * now[a];
    }
}

void forces_step(struct sph *s, double dt)
{
    struct wall_forces *f = &s->walls->forces;
    if (!f->credited)
        return;
    MPI_Allreduce(MPI_IN_PLACE, f->step, 3 * SIDES, MPI_DOUBLE, MPI_SUM, s->run->comm);
    for (int b = 0; b < SIDES; b++)
        for (int a = 0; a < 3; a++) {
            f->impulse[b][a] += f->step[b][a];
            f->now[b][a] = f->step[b][a] / dt;
        }
    memset(f->step, 0, sizeof f->step);
    f->known = true;
    if (s->walls->nbodies > 0)
        sample(s, dt);
}

bool forces_of(const struct sph *s, int k, double force[3])
{
    if (s->walls->forces.known)
        memcpy(force, s->walls->forces.now[k], 3 * sizeof *force);
    return s->walls->forces.known;
}

enum { SAVED = 6 * SIDES };

void forces_save(const struct sph *s, struct h5 *f)
{
    const struct wall_forces *w = &s->walls->forces;
    double row[SAVED];
    memcpy(row, w->now, sizeof w->now);
    memcpy(row + 3 * SIDES, w->impulse, sizeof w->impulse);
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
        memcpy(w->impulse, rows + 3 * SIDES, sizeof w->impulse);
    }
    mem_free(rows);
    return rows != NULL;
}

/* Mean of the first body's force, its fluctuation, its error. */
static void summarise_body(const struct sph *s)
{
    struct summary *to = s->run->summary;
    const double *wanted = s->run->scene.bodies[0].force, T = s->force_time;
    const double mean[2] = {s->force_sum[0] / T, s->force_sum[1] / T};
    const double var = s->force_sum2 / T - mean[0] * mean[0] - mean[1] * mean[1];
    const double size = hypot(wanted[0], wanted[1]);
    summary_real(to, "force.x", mean[0]);
    summary_real(to, "force.y", mean[1]);
    summary_real(to, "force.rms", sqrt(fmax(0.0, var)));
    if (size > 0.0)
        summary_real(to, "error.force", hypot(mean[0] - wanted[0], mean[1] - wanted[1]) / size);
    if (s->average_time > 0.0) {
        summary_real(to, "force.average_x", s->average_sum[0] / s->average_time);
        summary_real(to, "force.average_y", s->average_sum[1] / s->average_time);
    }
}

/* Momentum now less that of the start, less gravity's impulse, plus what bodies and walls got, over
 * the largest of these or the momentum at the scale of velocity. Where openings or a central
 * acceleration add to it, nobody has booked that. */
static void summarise_balance(const struct sph *s)
{
    const struct wall_forces *f = &s->walls->forces;
    double sums[SUM_COUNT], defect2 = 0.0, scale = s->mass0 * s->run->scene.initial.U;
    if (s->zones || s->central > 0.0)
        return;
    sph_sums(s, sums);
    for (int a = 0; a < 2; a++) {
        const double gravity = s->mass0 * s->gravity[a] * s->t;
        double left = sums[SUM_MOMENTUM + a] - s->momentum0[a] - gravity;
        for (int b = 0; b < SIDES; b++) {
            left += f->impulse[b][a];
            scale = fmax(scale, fabs(f->impulse[b][a]));
        }
        defect2 += left * left;
        scale = fmax(scale, fabs(gravity));
    }
    summary_real(s->run->summary, "momentum.defect", sqrt(defect2) / scale);
}

void forces_summarise(const struct sph *s)
{
    if (!s->walls->forces.known)
        return;
    if (s->walls->nbodies > 0 && s->force_time > 0.0)
        summarise_body(s);
    summarise_balance(s);
}

/* body_bend.c - a body in the plane each point of whose outline another program moves: an elastic
 * plate. Between two points the outline is straight and its velocity linear, so that the work of
 * the loads on the points is that of the forces on the pieces. Points are those of the case, in its
 * order. SPDX-License-Identifier: BSD-3-Clause */
#include "body.h"

/* Velocities, accelerations and loads begin at 0. */
struct body_bend *body_bend_create(const struct scene_body *is)
{
    struct body_bend *b = NEW(struct body_bend, 1);
    const int n = b->n = is->points.n;
    double(**const all[])[2] = {&b->x, &b->u, &b->du};
    for (int k = 0; k < 3; k++)
        *all[k] = mem_new_in(b, (size_t)n, sizeof **all[k]);
    for (int k = 0; k < BEND_LOADS; k++)
        b->load[k] = mem_new_in(b, (size_t)n, sizeof *b->load[k]);
    for (int i = 0; i < n; i++)
        for (int a = 0; a < 2; a++)
            b->x[i][a] = is->points.x[i][a];
    return b;
}

void body_bend_clear(const struct body_bend *bend, enum bend_load which)
{
    memset(bend->load[which], 0, (size_t)bend->n * sizeof *bend->load[which]);
}

void body_bend_add(const struct body_bend *bend, enum bend_load to, double factor,
                   const struct body_bend *from, enum bend_load of)
{
    for (int i = 0; i < bend->n; i++)
        for (int a = 0; a < 2; a++)
            bend->load[to][i][a] += factor * from->load[of][i][a];
}

/* Without a course yet, before the partner's first coupling step, the outline stays as the case has
 * it. */
void body_bend_move(struct body *b, double t)
{
    struct body_bend *to = b->bend;
    for (int i = 0; b->course && i < to->n; i++)
        for (int a = 0; a < 2; a++) {
            to->x[i][a] = b->is->points.x[i][a];
            to->u[i][a] = to->du[i][a] = 0.0;
            body_course_add(b->course, 2 * i + a, t, to->x[i] + a, to->u[i] + a, to->du[i] + a);
        }
}

void body_bend_velocity(const struct body_bend *bend, int k, double share, double *u, double *du)
{
    const int next = (k + 1) % bend->n;
    const double part = fmin(fmax(share, 0.0), 1.0);
    for (int a = 0; a < 2; a++) {
        u[a] = (1.0 - part) * bend->u[k][a] + part * bend->u[next][a];
        if (du)
            du[a] = (1.0 - part) * bend->du[k][a] + part * bend->du[next][a];
    }
}

void body_bend_load(const struct body_bend *bend, const double *x, const double *f,
                    enum bend_load which)
{
    const struct line l = {bend->n, (const double(*)[2])bend->x, true};
    const struct line_foot at = line_foot(&l, x);
    double(*const to)[2] = bend->load[which];
    for (int a = 0; a < 2; a++) {
        to[at.segment][a] += (1.0 - at.part) * f[a];
        to[(at.segment + 1) % bend->n][a] += at.part * f[a];
    }
}

double body_bend_power(const struct body_bend *bend)
{
    double sum = 0.0;
    for (int i = 0; i < bend->n; i++)
        sum += bend->load[BEND_STAGE][i][0] * bend->u[i][0] +
               bend->load[BEND_STAGE][i][1] * bend->u[i][1];
    return sum;
}

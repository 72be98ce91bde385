/* body_courses.c - see body_courses.h. In a coupling step from t0 to t1 each degree of freedom
 * follows the cubic with place and velocity of both ends. Those of its start are where the body has
 * come to, not what the partner says of it now: what the partner has corrected meanwhile is made up
 * for within the step, to third order of it. SPDX-License-Identifier: BSD-3-Clause */
#include "body_courses.h"

#include "../../common/files/files.h"
#include "../walls/sph_walls.h"

void body_courses_create(struct sph *s)
{
    for (int k = 0; k < s->walls->nbodies; k++) {
        struct body *b = s->walls->bodies + k;
        if (!scene_body_partnered(b->is))
            continue;
        const int n = b->bend ? 2 * b->bend->n : BODY_AXES;
        if (s->coarser) {
            b->course = s->coarser->walls->bodies[k].course;
        } else {
            b->course =
                mem_new_in(s->walls, 1, sizeof *b->course + (size_t)n * sizeof b->course->c[0]);
            b->course->n = n;
        }
        b->drive.course = b->bend ? NULL : b->course;
    }
}

/* Hermite's cubic in t - t0: place and velocity at both ends. to: n places, then n velocities at
 * t1. */
void body_course_set(struct body_course *c, double t0, double t1, const double *to)
{
    const double h = t1 - t0;
    for (int a = 0; a < c->n; a++) {
        double x0 = 0.0, v0 = 0.0, unused = 0.0;
        const double v1 = to[c->n + a];
        body_course_add(c, a, t0, &x0, &v0, &unused);
        const double mean = (to[a] - x0) / h;
        c->c[a][0] = x0;
        c->c[a][1] = v0;
        c->c[a][2] = (3.0 * mean - 2.0 * v0 - v1) / h;
        c->c[a][3] = (v0 + v1 - 2.0 * mean) / (h * h);
    }
    c->at = t0;
}

/* --- restart --- */

enum { COURSE_ROW = 3 + 4 }; /* body, degree of freedom, time, coefficients */

/* The degrees of freedom of all bodies that partners move. */
static int degrees(const struct sph *s)
{
    int n = 0;
    for (int k = 0; s->walls && k < s->walls->nbodies; k++)
        n += s->walls->bodies[k].course ? s->walls->bodies[k].course->n : 0;
    return n;
}

bool body_courses_restart(struct sph *s, struct h5 *f)
{
    const int n = degrees(s);
    if (n == 0)
        return true;
    double(*const rows)[COURSE_ROW] = mem_new((size_t)n, sizeof *rows), (*row)[COURSE_ROW] = rows;
    for (int k = 0; k < s->walls->nbodies; k++) {
        const struct body_course *c = s->walls->bodies[k].course;
        for (int a = 0; c && a < c->n; a++, row++) {
            (*row)[0] = k;
            (*row)[1] = a;
            (*row)[2] = c->at;
            memcpy(*row + 3, c->c[a], sizeof c->c[a]);
        }
    }
    bool fits =
        h5_keep_rows(f, "courses", "motion of bodies that partners move", n, COURSE_ROW, rows[0]);
    for (int i = 0; !h5_writes(f) && fits && i < n; i++) {
        struct body_course *c = s->walls->bodies[(int)rows[i][0]].course;
        fits = c && rows[i][1] < c->n;
        if (!fits)
            continue;
        c->at = rows[i][2];
        memcpy(c->c[(int)rows[i][1]], rows[i] + 3, sizeof c->c[0]);
    }
    mem_free(rows);
    for (struct sph *q = s; q && !h5_writes(f); q = q->finer)
        q->walls->t = -INFINITY; /* they stand where they stood without it */
    return fits;
}

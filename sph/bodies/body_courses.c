/* body_courses.c - see body_courses.h. In a coupling step from t0 to t1 each degree of freedom
 * follows the cubic with place and velocity of both ends. Those of its start are where the body has
 * come to, not what the partner says of it now: what the partner has corrected meanwhile is made up
 * for within the step, to third order of it. SPDX-License-Identifier: BSD-3-Clause */
#include "body_courses.h"

#include <math.h>
#include <string.h>

#include "../../common/base/base.h"
#include "../../common/files/files.h"
#include "../walls/sph_walls.h"

void body_courses_create(struct sph *s)
{
    for (int k = 0; k < s->walls->nbodies; k++) {
        struct body *b = s->walls->bodies + k;
        if (!scene_body_partnered(b->is))
            continue;
        b->course = s->coarser ? s->coarser->walls->bodies[k].course : NEW(struct body_course, 1);
        b->drive.course = b->course;
    }
}

void body_courses_free(struct sph *s)
{
    for (int k = 0; s->walls && !s->coarser && k < s->walls->nbodies; k++)
        mem_free(s->walls->bodies[k].course);
}

void body_course_at(const struct sph *s, int k, double t, double at[12])
{
    const struct body_course *c = s->walls->bodies[k].course;
    for (int a = 0; a < BODY_AXES; a++) {
        const double *p = c->c[a], later = t - c->at;
        at[a] = p[0] + later * (p[1] + later * (p[2] + later * p[3]));
        at[BODY_AXES + a] = p[1] + later * (2.0 * p[2] + later * 3.0 * p[3]);
    }
}

void body_course_set(struct sph *s, int k, double t0, double t1, const double to[12])
{
    struct body_course *c = s->walls->bodies[k].course;
    const double h = t1 - t0;
    double from[2 * BODY_AXES];
    body_course_at(s, k, t0, from);
    c->at = t0;
    for (int a = 0; a < BODY_AXES; a++) {
        const double mean = (to[a] - from[a]) / h, v0 = from[BODY_AXES + a], v1 = to[BODY_AXES + a];
        c->c[a][0] = from[a];
        c->c[a][1] = v0;
        c->c[a][2] = (3.0 * mean - 2.0 * v0 - v1) / h;
        c->c[a][3] = (v0 + v1 - 2.0 * mean) / (h * h);
    }
}

/* --- restart --- */

enum { COURSE_ROW = 2 + 4 * BODY_AXES }; /* body, time, coefficients */

void body_courses_save(const struct sph *s, struct h5 *f)
{
    double rows[BODIES_MAX][COURSE_ROW];
    int n = 0;
    for (int k = 0; s->walls && k < s->walls->nbodies; k++) {
        const struct body_course *c = s->walls->bodies[k].course;
        if (!c)
            continue;
        rows[n][0] = k;
        rows[n][1] = c->at;
        memcpy(rows[n++] + 2, c->c, sizeof c->c);
    }
    if (n > 0)
        h5_write_real(f, "courses", "motion of bodies that partners move",
                      s->run->rank == 0 ? n : 0, COURSE_ROW, rows[0], false);
}

bool body_courses_load(struct sph *s, struct h5 *f)
{
    int64_t n = 0;
    int wanted = 0, found = 0;
    for (int k = 0; s->walls && k < s->walls->nbodies; k++)
        wanted += s->walls->bodies[k].course != NULL;
    if (wanted == 0)
        return true;
    double *rows = h5_read_all_real(f, "courses", COURSE_ROW, &n);
    for (int i = 0; rows && n == wanted && i < n; i++) {
        const double *row = rows + (ptrdiff_t)COURSE_ROW * i;
        struct body_course *c = s->walls->bodies[(int)row[0]].course;
        if (!c)
            continue;
        c->at = row[1];
        memcpy(c->c, row + 2, sizeof c->c);
        found++;
    }
    mem_free(rows);
    for (struct sph *q = s; q; q = q->finer)
        q->walls->t = -INFINITY; /* they stand where they stood without it */
    return found == wanted;
}

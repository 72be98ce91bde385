/* scene_files.c - see scene_files.h. SPDX-License-Identifier: BSD-3-Clause */
#include "scene_files.h"

#include "../base/base.h"
#include "body_drive.h"
#include "scene_fluid.h"
#include "scene_openings.h"
#include "scene_outlines.h"
#include "scene_wave_file.h"

/* Lines and gauges that go with body k. */
static void move_attached(struct scene *s, int k, const double d[3])
{
    const char *name = s->bodies[k].name;
    for (int a = 0; a < 2; a++) {
        for (int j = 0; j < s->nbodies; j++)
            for (int i = 0; i < s->bodies[j].lines.n; i++) {
                struct scene_line *l = s->bodies[j].lines.of + i;
                l->from[a] += j == k ? d[a] : 0.0;
                l->to[a] += strcmp(l->body, name) == 0 ? d[a] : 0.0;
            }
        for (int i = 0; i < s->nprobes; i++)
            s->probes[i].at[a] += strcmp(s->probes[i].body, name) == 0 ? d[a] : 0.0;
    }
}

/* The water in a tank. */
static void move_shapes(struct scene *s, const double d[3])
{
    const double still[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < s->nshapes; k++) {
        struct scene_shape *h = s->shapes + k;
        for (int a = 0; a < 2; a++) {
            h->box[0][a] += d[a];
            h->box[1][a] += d[a];
            h->centre[a] += d[a];
            for (int i = 0; i < h->points.n; i++)
                h->points.x[i][a] += d[a];
        }
        h->level += scene_height(s, d) - scene_height(s, still);
    }
}

/* In the plane: puts the outline of a body where its prescribed motion begins, and takes that off
 * the motion, so that fluid, gauges and checks of the start meet it there; a tank with its
 * water. Free bodies are only shifted, for they turn about a centre of mass that is not known yet,
 * and so are tanks, for water does not turn. */
static void begin_in_place(struct scene *s, int k, struct motion_files *files)
{
    struct scene_body *b = s->bodies + k;
    struct body_drive drive = {0};
    double d[BODY_AXES], dd[BODY_AXES], ddd[BODY_AXES];
    body_drive_terms(&drive, &b->motion, s->domain.dim, files);
    body_drive_at(&drive, 0.0, d, dd, ddd);
    const int axes[3] = {AXIS_X, AXIS_Y, AXIS_RZ};
    const int locked = b->free ? scene_body_locked(b->lock, s->domain.dim) : ~0;
    const double turn = d[AXIS_RZ], size = fabs(d[AXIS_X]) + fabs(d[AXIS_Y]) + fabs(turn);
    if (!(size > 0.0 && size < INFINITY) || b->motion.n + 3 > MOTIONS_MAX ||
        ((b->free || b->tank) && turn != 0.0))
        return;
    for (int i = 0; i < 3; i++)
        if (d[axes[i]] != 0.0 && !(locked >> axes[i] & 1))
            return; /* refused later: forces move it */
    for (int i = 0; i < b->points.n; i++) {
        double *x = b->points.x[i];
        const double u = x[0] - b->centre[0], v = x[1] - b->centre[1];
        x[0] = b->centre[0] + d[AXIS_X] + cos(turn) * u - sin(turn) * v;
        x[1] = b->centre[1] + d[AXIS_Y] + sin(turn) * u + cos(turn) * v;
    }
    for (int a = 0; a < 2; a++)
        b->centre[a] += d[a];
    move_attached(s, k, d);
    if (b->tank)
        move_shapes(s, d);
    for (int i = 0; i < 3; i++)
        if (d[axes[i]] != 0.0)
            b->motion.of[b->motion.n++] = (struct scene_motion){.kind = MOTION_POLYNOMIAL,
                                                                .axis = axes[i],
                                                                .coefficients = {1, {-d[axes[i]]}},
                                                                .until = 1e9};
    log_say(
        "body %d (%s): its motion begins (%g, %g, %g) m and %g rad from the place that the case "
        "gives it",
        k + 1, b->name, d[0], d[1], d[2], turn);
}

/* Histories and outlines first: where a motion begins is asked of outlines that are in their place.
 */
void scene_files_read(struct scene *s, const char *dir, struct motion_files *files,
                      const struct params *p, struct faults *f)
{
    wall_histories_read(s, files);
    scene_outlines_read(s, dir, p, f);
    for (int k = 0; k < s->nbodies && files && f->n == 0 && s->domain.dim == 2; k++)
        if (s->bodies[k].motion.n > 0)
            begin_in_place(s, k, files);
    if (f->n == 0)
        scene_wave_file_read(s, dir, p, f);
}

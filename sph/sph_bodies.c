/* sph_bodies.c - bodies and walls of a scene as particles meet them: gaps that none can enter,
 * bodies that overlap, pierce walls or leave the domain, now or later, files of motion that a run
 * cannot follow. SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../common/mem.h"
#include "../common/scene_fluid.h"
#include "../common/scene_geometry.h"
#include "sph_sense.h"
#include "walls.h"
#include "zones.h"

enum { LEAST_TIMES = 20, MOST_TIMES = 2000 };

/* A line of the scene that particles meet. */
struct bound {
    struct line line;
    char name[64];
    int body;       /* -1: a wall */
    double x[2][2]; /* of a side */
};

enum { BOUNDS_MAX = WALLS_MAX + BODIES_MAX };

static void side_ends(const struct scene_domain *d, int side, double x[2][2])
{
    const int a = side / 2, b = 1 - a;
    x[0][a] = x[1][a] = side % 2 ? d->max[a] : d->min[a];
    x[0][b] = d->min[b];
    x[1][b] = d->max[b];
}

static int find_bounds(const struct scene *c, const struct sph_params *used, struct bound *all)
{
    int n = 0;
    for (int k = 0; k < c->nbodies; k++, n++) {
        all[n].line = line_of(&c->bodies[k].points, true);
        all[n].body = k;
        snprintf(all[n].name, sizeof all[n].name, "body %d (%.40s)", k + 1, c->bodies[k].name);
    }
    for (int k = 0; k < c->nwalls; k++) {
        const struct scene_wall *w = c->walls + k;
        const int side = w->side - SIDE_X_MIN;
        if (w->kind >= WALL_INFLOW || (side >= 0 && !sph_params_reaches(&c->domain, used, side)))
            continue;
        all[n].body = -1;
        snprintf(all[n].name, sizeof all[n].name, "wall %d", k + 1);
        if (side >= 0)
            side_ends(&c->domain, side, all[n].x);
        all[n].line = side >= 0 ? (struct line){2, (const double(*)[2])all[n].x, false}
                                : line_of(&w->points, w->closed);
        n++;
    }
    return n;
}

/* --- gaps --- */

/* Nearest point of a line to x; side: > 0 if x is on its left, 0 beyond an end. */
static void foot_of(const struct line *l, const double *x, double foot[2], double *side)
{
    double least = INFINITY;
    for (int k = 0; k < line_segments(l); k++) {
        const double *a = l->x[k], *b = l->x[(k + 1) % l->n];
        const double d[2] = {b[0] - a[0], b[1] - a[1]}, e[2] = {x[0] - a[0], x[1] - a[1]};
        const double along = (d[0] * e[0] + d[1] * e[1]) / (d[0] * d[0] + d[1] * d[1]);
        const double z = fmax(0.0, fmin(1.0, along));
        const double p[2] = {a[0] + z * d[0], a[1] + z * d[1]};
        const double r = hypot(x[0] - p[0], x[1] - p[1]);
        if (r < least) {
            const bool end = !l->closed && ((k == 0 && along <= 0.0) ||
                                            (k == line_segments(l) - 1 && along >= 1.0));
            least = r;
            memcpy(foot, p, sizeof p);
            *side = end ? 0.0 : d[0] * e[1] - d[1] * e[0];
        }
    }
}

/* Whether the middle of the gap at x lies where fluid could be: behind no wall. */
static bool is_wet(const struct scene *c, const struct bound *A, const struct bound *B,
                   const double *x)
{
    double p[2], q[2], left[2];
    foot_of(&A->line, x, p, left);
    foot_of(&B->line, x, q, left + 1);
    const double mid[3] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.0};
    foot_of(&A->line, mid, p, left);
    foot_of(&B->line, mid, q, left + 1);
    bool in = scene_is_room(c, mid);
    for (int a = 0; a < 2; a++)
        in = in && mid[a] > c->domain.min[a] && mid[a] < c->domain.max[a];
    const bool side_a = A->line.x == (const double(*)[2])A->x;
    const bool side_b = B->line.x == (const double(*)[2])B->x;
    return in && (side_a || left[0] >= 0.0) && (side_b || left[1] >= 0.0);
}

static void fault_at(const struct run *r, struct faults *f, const struct bound *b, const char *what,
                     const double *at, const char *other)
{
    char key[64];
    snprintf(key, sizeof key, "bodies.[%d]", b->body);
    params_fault(r->params, f, b->body < 0 ? "walls" : key, "%s %s %s at (%g, %g) m", b->name, what,
                 other, at[0], at[1]);
}

static void check_gaps(const struct run *r, const struct sph_params *used, struct faults *f)
{
    struct bound all[BOUNDS_MAX];
    const int n = find_bounds(&r->scene, used, all);
    for (int k = 0; k < n; k++)
        for (int m = 0; m < k; m++) {
            double at[2] = {0.0, 0.0};
            const double gap = line_gap(&all[k].line, &all[m].line, at);
            if (gap > 1e-3 * used->dx && gap < (1.0 - 1e-6) * used->dx &&
                is_wet(&r->scene, all + k, all + m, at))
                params_fault(r->params, f, all[k].body < 0 && all[m].body < 0 ? "walls" : "bodies",
                             "a gap of %g m between %s and %s at (%g, %g) m, where no particle of "
                             "%g m fits: close it, or refine sph.dx",
                             gap, all[m].name, all[k].name, at[0], at[1], used->dx);
        }
}

/* --- motion --- */

/* Rows of a motion file: numbers, from the start to the end of the run, without jumps. */
static void check_rows(const struct run *r, const struct sph_params *used, int k,
                       const double *rows, int n, struct faults *f)
{
    const double end = r->scene.time.end, *last = rows + 4 * (n - 1);
    char key[64];
    snprintf(key, sizeof key, "bodies.[%d].motion", k);
    for (int i = 0; i < 4 * n; i++)
        if (!isfinite(rows[i])) {
            params_fault(r->params, f, key, "row %d of the file is not a number", i / 4 + 1);
            return;
        }
    if (rows[0] > 0.0 || last[0] < end * (1.0 - 1e-9))
        params_fault(r->params, f, key,
                     "the file has t = %g to %g s, the run goes from 0 to %g s: the body would %s",
                     rows[0], last[0], end,
                     rows[0] > 0.0 ? "start with a jerk" : "stop with a jerk");
    const struct line l = line_of(&r->scene.bodies[k].points, true);
    double reach = 0.0; /* of turning, m */
    for (int i = 0; i < l.n; i++)
        reach = fmax(reach, hypot(l.x[i][0] - r->scene.bodies[k].centre[0],
                                  l.x[i][1] - r->scene.bodies[k].centre[1]));
    for (int i = 1; i < n; i++) {
        const double *a = rows + 4 * (i - 1), *b = a + 4;
        const double speed =
            (hypot(b[1] - a[1], b[2] - a[2]) + reach * fabs(b[3] - a[3])) / (b[0] - a[0]);
        if (a[0] < end && speed > 0.5 * used->c0) {
            params_fault(r->params, f, key,
                         "jumps at t = %g s, row %d: %g m/s, above half the speed of sound, %g m/s",
                         a[0], i + 1, speed, 0.5 * used->c0);
            return;
        }
    }
}

/* Motion as the run has it; false: the file is of no use. */
static bool read_motion(const struct run *r, const struct sph_params *used, int k, struct body *b,
                        struct faults *f)
{
    char path[1024 + PARAM_TEXT_SIZE], key[64];
    const int before = f->n;
    *b = (struct body){.is = r->scene.bodies + k};
    if (!*b->is->motion)
        return true;
    snprintf(key, sizeof key, "bodies.[%d].motion", k);
    snprintf(path, sizeof path, "%s/%s", r->case_dir, b->is->motion);
    b->nrows = walls_read_motion(path, &b->rows);
    if (b->nrows <= 0)
        params_fault(r->params, f, key, "body %d: motion %s: %s", k + 1, path,
                     b->nrows < 0 ? "no such file"
                                  : "rows of t, x, y, angle with rising times are wanted");
    else
        check_rows(r, used, k, b->rows, b->nrows, f);
    return f->n == before;
}

/* Largest speed of a body's corners that is to be expected, m/s. */
static double speed_of(const struct body *b, double end)
{
    double most = 0.0;
    for (int i = 0; i <= LEAST_TIMES * 20; i++) {
        const struct body_motion m = walls_motion(b, end * i / (LEAST_TIMES * 20));
        for (int k = 0; k < b->is->points.n; k++)
            most = fmax(most, hypot(m.u[0], m.u[1]) +
                                  fabs(m.spin) * hypot(b->is->points.x[k][0] - b->is->centre[0],
                                                       b->is->points.x[k][1] - b->is->centre[1]));
    }
    return most;
}

static void place_bodies(const struct scene *c, struct body *bodies, double t,
                         struct param_points *now)
{
    for (int k = 0; k < c->nbodies; k++) {
        bodies[k].now = walls_motion(bodies + k, t);
        now[k].n = c->bodies[k].points.n;
        for (int i = 0; i < now[k].n; i++)
            walls_place(bodies + k, c->bodies[k].points.x[i], now[k].x[i]);
    }
}

/* A corner outside the room that a body may have: the free zone of the particles. */
static bool check_room(const struct run *r, const struct sph_params *used, const struct bound *b,
                       const char *when, struct faults *f)
{
    const struct scene_domain *d = &r->scene.domain;
    const struct line *l = &b->line;
    const double small = 1e-6 * line_size(l);
    double lo[3], hi[3];
    zones_free_box(r, used, lo, hi);
    for (int i = 0; i < l->n; i++)
        for (int a = 0; a < 2; a++) {
            const double x = l->x[i][a];
            const bool leaves = x < d->min[a] - small || x > d->max[a] + small;
            char key[64];
            if (x >= lo[a] - small && x <= hi[a] + small)
                continue;
            snprintf(key, sizeof key, "bodies.[%d]", b->body);
            params_fault(r->params, f, key, "%s %s %c at (%g, %g) m, %s: %s", b->name,
                         !leaves          ? "leaves the free zone of the particles across"
                         : d->periodic[a] ? "crosses the periodic side"
                                          : "leaves the domain across",
                         "xy"[a], l -> x[i][0], l -> x[i][1], when,
                         !leaves ? "only there it is known; make sph.box larger"
                         : d->periodic[a]
                             ? "a body has no image there; shift the domain, or make it larger"
                             : "make the domain larger, or the motion smaller");
            return false;
        }
    return true;
}

/* What is wrong at one time; true: something. */
static bool check_places(const struct run *r, const struct sph_params *used,
                         const struct bound *all, int n, double t, struct faults *f)
{
    char when[64];
    double at[2];
    const int before = f->n;
    snprintf(when, sizeof when, t > 0.0 ? "at t = %g s" : "at the start", t);
    for (int k = 0; k < r->scene.nbodies; k++) {
        if (!check_room(r, used, all + k, when, f))
            return true;
        for (int m = 0; m < n; m++) {
            char words[96];
            if (m == k || (all[m].body >= 0 && m > k))
                continue;
            snprintf(words, sizeof words, "%s %s", all[m].body < 0 ? "cuts" : "overlaps with",
                     all[m].name);
            if (all[m].body >= 0 ? line_overlaps(&all[k].line, &all[m].line, at)
                                 : line_pierces(&all[k].line, &all[m].line, at))
                fault_at(r, f, all + k, words, at, when);
        }
    }
    return f->n > before;
}

void sph_bodies_check(const struct run *r, const struct sph_params *used, struct faults *f)
{
    const struct scene *c = &r->scene;
    struct body bodies[BODIES_MAX];
    struct param_points *now = NEW(struct param_points, BODIES_MAX);
    struct bound all[BOUNDS_MAX];
    double speed = 0.0;
    bool sound = true;
    for (int k = 0; k < c->nbodies; k++)
        sound = read_motion(r, used, k, bodies + k, f) && sound;
    const int n = find_bounds(c, used, all);
    for (int k = 0; k < c->nbodies; k++) {
        all[k].line = line_of(&c->bodies[k].points, true);
        all[k].line.x = (const double(*)[2])now[k].x;
        speed = fmax(speed, sound ? speed_of(bodies + k, c->time.end) : 0.0);
    }
    if (speed > 0.5 * used->c0)
        params_fault(r->params, f, "bodies",
                     "a body moves at %g m/s, above half the speed of sound, %g m/s: raise sph.c0",
                     speed, 0.5 * used->c0);
    const double wanted = fmin(2.0 * speed * c->time.end / used->dx, MOST_TIMES);
    const int times = speed > 0.0 ? (int)fmax(wanted, LEAST_TIMES) : 0;
    for (int i = 0; sound && i <= times; i++) {
        const double t = times ? c->time.end * i / times : 0.0;
        place_bodies(c, bodies, t, now);
        if (check_places(r, used, all, n, t, f))
            break;
    }
    for (int k = 0; k < c->nbodies; k++)
        mem_free(bodies[k].rows);
    mem_free(now);
    if (c->domain.dim == 2)
        check_gaps(r, used, f);
}

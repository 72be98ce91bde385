/* fv_course.c - how FV's fields go on in time, for a partner. A time polynomial about the newest
 * level q[0] at t[0]: velocity through up to three other levels (the trial's end, then earlier ends
 * of coupling steps), pressure and phi linear, towards the trial or along the smoothed trend. Order
 * in a coupling step: course_try, course_velocity, course_pressure, course_surface (sent by
 * fv_coupling.c), then the true step, course_take.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fv_course.h"

#include "../../common/files/files.h"
#include "../grid/fv_grid.h"
#include "../surface/fv_surface.h"
#include "moved_box.h"

/* width: velocity, pressure, and phi with a surface. */
struct course *course_create(const struct fv *s, struct patch *p, int memory)
{
    struct course *c = NEW(struct course, 1);
    c->patch = p;
    c->dim = s->dim;
    c->width = s->dim + (s->surface ? 2 : 1);
    c->memory = memory;
    c->linear = s->run->scene.coupling.in_time == IN_TIME_LINEAR;
    c->n = p->n;
    for (int m = 0; m < COURSE_LEVELS; m++)
        c->q[m] = NEW_IN(c, double, c->n * c->width);
    for (int m = 0; m < COURSE_TERMS; m++)
        c->term[m] = NEW_IN(c, double, c->n * c->dim);
    c->tried = NEW_IN(c, double, c->n * c->width);
    c->kept = mem_own(c, kept_create(s));
    if (c->memory > 1) {
        c->rate = NEW_IN(c, double, c->n);
        c->scatter = scene_has_surface(&s->run->scene) ? NEW_IN(c, double, c->n) : NULL;
    }
    return c;
}

/* Under a surface the partner knows the level of the pressure itself, so that it is sent what
 * stands over the mean in the free cells beside the interface, which would follow every oscillation
 * of the level late. q: of the patch; p: Pa, by cells, or NULL: the exact one at t. Collective. */
static void take_out_level(const struct fv *s, const struct course *c, const double *p, double t,
                           double *q)
{
    const struct forcing *f = s->forcing;
    const double *g = s->run->scene.fluid.gravity;
    double sum[2] = {0.0, 0.0}, x[3], u[3];
    if (!f || s->surface || !scene_has_surface(&s->run->scene) ||
        (g[0] == 0.0 && g[1] == 0.0 && g[2] == 0.0))
        return;
    for (int64_t m = f->npartner; m < f->npartner + f->nrim; m++) {
        double one = p ? p[f->partner[m]] : 0.0;
        if (!p)
            forcing_average(s, f->partner[m], t, u, &one);
        grid_place(&s->grid, f->partner[m], x);
        sum[0] += one - (p ? 0.0 : fv_still_pressure(s, x));
        sum[1] += 1.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm);
    const double level = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
    for (int64_t i = 0; i < c->n; i++)
        q[i * c->width + c->dim] -= level;
}

/* Writes phi, cut off at four cells, as far as linear interpolation may want it. */
static void look_at_surface(const struct fv *s, const struct course *c, double *q)
{
    double *one = NEW(double, c->n), most = 4.0 * (s->m ? s->surface->largest : 0.0);
    for (int a = 0; a < s->dim && !s->m; a++)
        most = fmax(most, 4.0 * s->b.h[a]);
    patch_look(s, c->patch, s->surface->phi, one);
    for (int64_t i = 0; i < c->n; i++)
        q[i * c->width + c->dim + 1] = fmax(-most, fmin(most, one[i]));
    mem_free(one);
}

/* Writes velocity and full pressure now to q; imposed cells get a pressure extrapolated from the
 * free side. Collective. */
static void look(struct fv *s, const struct course *c, double *q)
{
    double *one = NEW(double, c->n), *p = NEW(double, s->size), x[3];
    for (int64_t i = 0; i < s->size; i++)
        p[i] = fv_pressure(s, i);
    grid_fill(&s->grid, 1, &p);
    if (s->surface)
        extension_beyond(s, p);
    if (s->forcing)
        forcing_extend(s, s->forcing->near, p);
    grid_fill(&s->grid, s->dim, s->u);
    if (s->surface)
        look_at_surface(s, c, q);
    for (int m = 0; m <= c->dim; m++) {
        patch_look(s, c->patch, m < c->dim ? s->u[m] : p, one);
        for (int64_t i = 0; i < c->n; i++) {
            if (m == c->dim)
                patch_centre(c->patch, i, x);
            q[i * c->width + m] = one[i] + (m == c->dim ? fv_still_pressure(s, x) : 0.0);
        }
    }
    take_out_level(s, c, p, s->t, q);
    FREE(p, one);
}

/* Levels move one back; the oldest array is reused for the new one. */
static void shift(struct course *c, double t)
{
    double *oldest = c->q[COURSE_LEVELS - 1];
    memmove(c->q + 1, c->q, (COURSE_LEVELS - 1) * sizeof *c->q);
    memmove(c->t + 1, c->t, (COURSE_LEVELS - 1) * sizeof *c->t);
    c->q[0] = oldest;
    c->t[0] = t;
    c->levels = c->levels < COURSE_LEVELS ? c->levels + 1 : COURSE_LEVELS;
}

/* Pressure answers at once to every change of the imposed velocities, by the change over the
 * coupling step, and a partner to that a step later: where what comes back is larger than what
 * went, smoothing must take it away; it must keep level and trend, for a lag would feed waves. */
static void smooth_pressure(struct course *c)
{
    const double h = c->t[0] - c->t[1];
    for (int64_t i = 0; i < c->n; i++) {
        const int64_t at = i * c->width + c->dim;
        double level = c->q[1][at];
        fit_smooth(c->q[0][at], h, c->memory, &level, c->rate + i,
                   c->scatter ? c->scatter + i : NULL);
        c->q[0][at] = level;
    }
}

/* After a coupling step; the trial counts no longer. */
void course_take(struct fv *s, struct course *c)
{
    shift(c, s->t);
    look(s, c, c->q[0]);
    c->t_tried = -INFINITY;
    if (c->rate)
        smooth_pressure(c);
}

/* As `look', from the exact solution at t. */
static void exact_level(struct fv *s, struct course *c, double t, double *q)
{
    double x[3], u[3], p;
    int64_t at = 0;
    for (int64_t i = 0; i < c->n; i++) {
        patch_centre(c->patch, i, x);
        exact_average(&s->exact, x, c->patch->h, t, u, &p, NULL);
        for (int a = 0; a < c->dim; a++)
            q[at++] = u[a];
        q[at++] = p;
        at += c->width - c->dim - 1;
    }
    if (s->surface)
        look_at_surface(s, c, q);
    take_out_level(s, c, NULL, t, q);
}

/* rate starts as the trend of the exact levels. */
void course_start(struct fv *s, struct course *c, double before)
{
    c->t_tried = -INFINITY;
    const bool past = exact_has_past(&s->exact) && s->prm.errors;
    for (int m = past ? COURSE_LEVELS - 1 : 0; m >= 0; m--) {
        shift(c, s->t - m * before);
        if (s->prm.errors) /* in forced cells, too */
            exact_level(s, c, c->t[0], c->q[0]);
        else
            look(s, c, c->q[0]);
    }
    for (int64_t i = 0; i < c->n && c->rate && c->levels > 1; i++) {
        const int64_t at = i * c->width + c->dim;
        c->rate[i] = (c->q[0][at] - c->q[1][at]) / before;
    }
}

/* Whether FV tries the first coupling step of a flow from rest as if it were alone: the imposed
 * cells have no past then that tells how they go on, but FV has in them all that the partner starts
 * with. Blocks are cut there, and a surface is the partner's. */
static bool is_alone(const struct fv *s, const struct course *c)
{
    return c->levels == 1 && s->forcing && !s->m && !s->surface &&
           !scene_shapes_move(&s->run->scene);
}

/* A trial that fails says nothing of the true window: then the past must do. The state, the sides
 * and the clock are put back afterwards; totals and watches do not count in it (step.predicts). */
void course_try(struct fv *s, struct course *c, double t1)
{
    struct diagnosis d = {0};
    struct forcing *const imposed = s->forcing;
    const bool alone = is_alone(s, c);
    if (c->linear)
        return;
    kept_take(c->kept, s);
    if (alone) {
        static const double no_box[2][3] = {{0.0}};
        s->forcing = forcing_create(s, 1, &no_box, false); /* of closed sides */
        moved_box_renew(s);
    }
    s->step.predicts = true;
    while (s->t < t1 && !d.bad)
        integrate(s, t1, &d);
    c->t_tried = d.bad ? -INFINITY : t1;
    if (!d.bad)
        look(s, c, c->tried);
    else if (!c->failed)
        log_warn("t = %.4g s: fv cannot run its trial of the coupling step to %.4g s (%s): sph "
                 "gets values extrapolated from the steps before; lower coupling.steps",
                 c->t[0], t1, d.reason);
    c->failed = c->failed || d.bad;
    s->step.predicts = false;
    if (alone) {
        FREE(s->forcing);
        s->forcing = imposed;
        moved_box_renew(s);
    }
    kept_put_back(c->kept, s);
    sides_time(s, s->t); /* those of the start again */
}

/* The polynomial through the newest level and up to three others, value f[j] at x[j] s after it: f0
 * + x r(x), r through (f[j] - f0)/x[j] in Newton's form. term[k] multiplies (t - t[0])^k. */
static void expand(double f0, int n, const double *x, const double *f, double *term)
{
    double r[3] = {0.0, 0.0, 0.0};
    for (int j = 0; j < n; j++)
        r[j] = (f[j] - f0) / x[j];
    const double d12 = n > 1 ? (r[1] - r[0]) / (x[1] - x[0]) : 0.0;
    const double d23 = n > 2 ? (r[2] - r[1]) / (x[2] - x[1]) : 0.0;
    const double d = n > 2 ? (d23 - d12) / (x[2] - x[0]) : 0.0;
    term[0] = f0;
    term[1] = r[0] - (n > 1 ? d12 * x[0] : 0.0) + (n > 2 ? d * x[0] * x[1] : 0.0);
    term[2] = d12 - (n > 2 ? d * (x[0] + x[1]) : 0.0);
    term[3] = d;
}

/* Lists the levels beside the newest: the trial's, then earlier ones; returns their number. */
static int others(const struct course *c, const double **q, double *x)
{
    int n = 0;
    if (c->t_tried > c->t[0]) {
        x[n] = c->t_tried - c->t[0];
        q[n++] = c->tried;
    }
    for (int m = 1; m < c->levels; m++) {
        x[n] = c->t[m] - c->t[0];
        q[n++] = c->q[m];
    }
    return n;
}

/* As many terms as levels; with `linear' two. */
int course_velocity(struct course *c)
{
    const double *q[COURSE_LEVELS];
    double x[COURSE_LEVELS], f[COURSE_LEVELS], term[COURSE_TERMS];
    const int n = others(c, q, x);
    for (int64_t i = 0; i < c->n; i++)
        for (int a = 0; a < c->dim; a++) {
            const int64_t at = i * c->width + a;
            for (int j = 0; j < n; j++)
                f[j] = q[j][at];
            expand(c->q[0][at], n, x, f, term);
            for (int m = 0; m < COURSE_TERMS; m++)
                c->term[m][i * c->dim + a] = term[m];
        }
    return c->linear && n > 1 ? 2 : n + 1; /* a straight line of the parabola's slope now */
}

/* Slope of a value in time now: towards what the trial found, or from the level before; without
 * trials that of the parabola through three levels, as BDF2 has it. */
static double slope_of(const struct course *c, int64_t at, int n, const double **q, const double *x)
{
    double f[COURSE_LEVELS], term[COURSE_TERMS];
    if (!c->linear)
        return n > 0 ? (q[0][at] - c->q[0][at]) / x[0] : 0.0;
    for (int j = 0; j < n; j++)
        f[j] = q[j][at];
    expand(c->q[0][at], n, x, f, term);
    return term[1];
}

/* A surface moves with the water, so two terms serve it. */
int course_surface(struct course *c)
{
    const double *q[COURSE_LEVELS];
    double x[COURSE_LEVELS];
    const int n = others(c, q, x);
    for (int64_t i = 0; i < c->n; i++) {
        const int64_t at = i * c->width + c->dim + 1;
        c->term[0][i] = c->q[0][at];
        c->term[1][i] = slope_of(c, at, n, q, x);
    }
    return 2;
}

/* If it is smoothed, along its trend. */
int course_pressure(struct course *c)
{
    const double *q[COURSE_LEVELS];
    double x[COURSE_LEVELS];
    const int n = others(c, q, x);
    for (int64_t i = 0; i < c->n; i++) {
        const int64_t at = i * c->width + c->dim;
        c->term[0][i] = c->q[0][at];
        c->term[1][i] = c->rate ? c->rate[i] : slope_of(c, at, n, q, x);
    }
    return 2;
}

static const char *const names[] = {"level0", "level1", "level2"};

/* l: of another number of ranks. */
static bool keep(const struct course *c, struct h5 *f, const struct layout *l, const char *name,
                 const char *unit, int ncomp, double *v)
{
    if (h5_writes(f))
        h5_write_real(f, name, unit, c->n, ncomp, v, false);
    return h5_writes(f) || (l ? layout_read(l, f, name, ncomp, &c->patch->of, c->patch->periodic, v)
                              : h5_read_real(f, name, c->n, ncomp, v));
}

/* Trends of a run that smooths; those of one that did not, for its coupling steps were others, are
 * the last change of the pressure. */
static bool keep_trends(struct course *c, struct h5 *f, const struct layout *l)
{
    const bool smoothed = h5_writes(f) || h5_share(f, "rate") >= 0;
    for (int64_t i = 0; i < c->n && !smoothed && c->levels > 1; i++) {
        const int64_t at = i * c->width + c->dim;
        c->rate[i] = (c->q[0][at] - c->q[1][at]) / (c->t[0] - c->t[1]);
    }
    return !smoothed || (keep(c, f, l, "rate", "Pa/s", 1, c->rate) &&
                         (!c->scatter || keep(c, f, l, "scatter", "Pa", 1, c->scatter)));
}

/* Levels, clock and trends; the patch's box tells other ranks which cells they are. A trial is
 * never saved: the next coupling step begins with one. */
bool course_restart(const struct fv *s, struct course *c, struct h5 *f)
{
    const bool same = h5_writes(f) || layout_same_ranks(f, s->run->size);
    struct layout *l = same ? NULL : layout_load(f, "course");
    double clock[COURSE_LEVELS + 1] = {c->t[0], c->t[1], c->t[2], c->levels};
    bool good = same || l;
    if (h5_writes(f))
        layout_save(f, "course", 1, &c->patch->of);
    for (int m = 0; good && m < COURSE_LEVELS; m++)
        good = keep(c, f, l, names[m], "-", c->width, c->q[m]);
    good = good && h5_keep_same(f, "levels", "-", COURSE_LEVELS + 1, clock);
    if (good && !h5_writes(f)) {
        memcpy(c->t, clock, sizeof c->t);
        c->levels = (int)clock[COURSE_LEVELS];
        c->t_tried = -INFINITY;
    }
    good = good && (!c->rate || keep_trends(c, f, l));
    FREE(l);
    return good;
}

/* seal_openings.c - through which openings water seeps into the slits and wedges between solids. An
 * opening is a set of points of the rim that lie side by side. On its way in along the faces the
 * water meets the resistance of slits, length over width cubed: so a point takes the water of its
 * own side of where solids touch, not of the air beyond it, and in a slit of one width between two
 * openings the pressure falls from one to the other. SPDX-License-Identifier: BSD-3-Clause */
#include "seal_openings.h"

#include "bins.h"
#include "body_touch.h"

static const double side_by_side = 1.6;                     /* spacings of nodes */
static const double shut = 1e-3, narrow = 0.02, wide = 2.0; /* dx */
static const double free_way = 1.0;                         /* 1/dx^2: what does not matter */

/* The points [n] of all faces that may lie in one slit. */
struct slit_faces {
    struct seal_point *of;
    int n;
    double dx, *width; /* m; dx: between each and the solid before it */
    struct body_bins bins;
    double *from; /* 1/dx^2: resistance from one opening to each */
    int *queue;
    bool *queued;
};

static double width_at(const struct sph *s, const struct seal_point *p, double dx)
{
    const struct walls *w = s->walls;
    double least = wide * dx, out[3];
    for (int k = -1; k < w->nbodies && !p->dry; k++)
        if (k != p->body)
            least = fmin(least, touch_distance(w, s->dim, k, p->is.x, least, out));
    return p->dry ? shut : fmax(least / dx, narrow);
}

/* Length, dx, of the way along faces from one point to the next; INFINITY: they are not side by
 * side, or on both sides of a sheet. */
static double way_between(const struct slit_faces *on, int k, int m)
{
    const struct seal_point *p = on->of + k, *q = on->of + m;
    double e[3];
    vec3_from(p->is.x, q->is.x, e);
    const double r = vec3_length(e) / on->dx;
    const bool sheet = p->body == q->body && vec3_dot(p->is.n, q->is.n) < -0.5;
    return r < 0.5 * side_by_side && !sheet && m != k ? r : INFINITY;
}

static double resistance(const struct slit_faces *on, int k, int m)
{
    const double a = on->width[k], b = on->width[m];
    return 0.5 * way_between(on, k, m) * (1.0 / (a * a * a) + 1.0 / (b * b * b));
}

/* Lets what is queued, `end' points from the first on, reach what is beside it, and so on: points
 * of the rim get the number of the opening, or, without one (-1), all that is not reached as
 * easily yet its resistance. */
static void spread(struct slit_faces *on, int end, int opening)
{
    struct bins_run run[BINS_RUNS];
    for (int first = 0; first != end; first = (first + 1) % (on->n + 1)) {
        const int k = on->queue[first];
        on->queued[k] = false;
        const int runs = bins_near(&on->bins, on->of[k].is.x, run);
        for (int j = 0; j < runs; j++)
            for (int q = run[j].first; q < run[j].end; q++) {
                const int m = on->bins.who[q];
                const double from = on->from[k] + resistance(on, k, m);
                const bool next = opening < 0 ? from < on->from[m]
                                              : on->of[m].rim && on->of[m].opening < 0 &&
                                                    isfinite(way_between(on, k, m));
                if (!next)
                    continue;
                on->from[m] = opening < 0 ? from : on->from[m];
                on->of[m].opening = opening < 0 ? on->of[m].opening : opening;
                if (!on->queued[m]) {
                    on->queued[m] = true;
                    on->queue[end] = m;
                    end = (end + 1) % (on->n + 1);
                }
            }
    }
}

/* Numbers the openings; the last takes all beyond SEAL_OPENINGS. Returns how many there are. */
static int number_openings(struct slit_faces *on)
{
    int n = 0;
    for (int k = 0; k < on->n; k++)
        on->of[k].opening = -1;
    for (int k = 0; k < on->n; k++)
        if (on->of[k].rim && on->of[k].opening < 0) {
            on->of[k].opening = n < SEAL_OPENINGS ? n++ : n - 1;
            on->queue[0] = k;
            spread(on, 1, on->of[k].opening);
        }
    return n;
}

static void spread_from(struct slit_faces *on, int opening)
{
    int end = 0;
    for (int k = 0; k < on->n; k++) {
        const bool starts = on->of[k].opening == opening;
        on->from[k] = starts ? free_way : INFINITY;
        on->queued[k] = starts;
        if (starts)
            on->queue[end++] = k;
    }
    spread(on, end, -1);
    for (int k = 0; k < on->n; k++)
        on->of[k].from[opening] = on->from[k];
}

/* Of the easiest way each has its share; what no way leads to takes of all alike. */
static void share_openings(struct seal_point *p, int n)
{
    double least = INFINITY;
    for (int k = 0; k < n; k++)
        least = fmin(least, p->from[k]);
    for (int k = 0; k < n; k++) {
        const double of_it = isfinite(least) ? least / p->from[k] : 1.0;
        p->from[k] = of_it * of_it;
    }
}

void seal_openings_find(const struct sph *s, struct seal_point *of, int n)
{
    const struct sph *finest = s;
    while (finest->finer)
        finest = finest->finer;
    if (n == 0)
        return;
    struct slit_faces on = {.of = of,
                            .n = n,
                            .dx = finest->dx,
                            .width = NEW(double, n),
                            .bins = bins_create(s->dim, n, of->is.x, sizeof *of / sizeof(double),
                                                0.5 * side_by_side * finest->dx),
                            .from = NEW(double, n),
                            .queue = NEW(int, n + 1),
                            .queued = NEW(bool, n)};
    for (int k = 0; k < n; k++)
        on.width[k] = width_at(s, of + k, on.dx);
    const int openings = number_openings(&on);
    for (int k = 0; k < openings; k++)
        spread_from(&on, k);
    for (int k = 0; k < n; k++)
        share_openings(of + k, openings);
    bins_free(&on.bins);
    FREE(on.width, on.from, on.queue, on.queued);
}

/* relax.c - see relax.h. Called at the end of a step, at the new time: u <- u + change towards the
 * waves' velocity, at the rate of the zone there, and the same for the velocity of the step before
 * that bdf2 keeps, so that its difference in time does not see the zone. Cells deep in the air are
 * left out. Which cells stand in zones is found once, column by column: to ask all cells in each
 * step, and the waves for each of them, took three times as long.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "relax.h"

#include "../../common/scene/scene.h"
#include "../surface/fv_surface.h"
#include "../watch/fv_watch.h"
#include "stages.h"

/* A cell in a zone, its place, and the same with its height last, m. */
struct zone_cell {
    int64_t at;
    double x[3], order[3];
};

/* Those of this rank, sorted: cells above each other are neighbours. */
struct zone_cells {
    bool known;
    int64_t n;
    struct zone_cell *of; /* owned */
};

static int by_columns(const void *a, const void *b)
{
    const double *x = ((const struct zone_cell *)a)->order,
                 *y = ((const struct zone_cell *)b)->order;
    int k = 0;
    while (k < 2 && x[k] == y[k])
        k++;
    return x[k] < y[k] ? -1 : x[k] > y[k];
}

/* Without gravity along an axis nothing stands above anything else. */
static void find_cells(const struct fv *s, struct zone_cells *z)
{
    const int up = scene_still_axis(&s->run->scene), first = up == 0 ? 1 : 0,
              second = 3 - up - first;
    z->known = true;
    z->n = 0;
    FLOW_ROWS (s, at, n)
        for (int64_t i = at; i < at + n; i++) {
            struct zone_cell is = {.at = i, .order = {(double)i}};
            grid_place(&s->grid, i, is.x);
            if (!wave_zones_hold(s->wave_zones, is.x))
                continue;
            if (up >= 0)
                memcpy(is.order, (const double[]){is.x[second], is.x[first], is.x[up]},
                       sizeof is.order);
            ROOM_IN(z, z->of, z->n + 1);
            z->of[z->n++] = is;
        }
    if (z->n > 0)
        qsort(z->of, (size_t)z->n, sizeof *z->of, by_columns);
}

/* Cells from `first' on that stand above each other and are not deep in the air, WAVE_COLUMN at
 * most: their number to *n, their places to x. Returns the first cell behind them. */
static int64_t find_column(const struct fv *s, const struct zone_cells *z, int64_t first, int *n,
                           int64_t *cell, double (*x)[3])
{
    const struct zone_cell *const of = z->of;
    double *const power = s->watches->zone_power;
    int64_t k = first;
    *n = 0;
    for (; k < z->n && *n < WAVE_COLUMN && of[k].order[0] == of[first].order[0] &&
           of[k].order[1] == of[first].order[1];
         k++) {
        if (power)
            power[of[k].at] = 0.0;
        if (s->surface && s->surface->layer[of[k].at] == DEEP)
            continue;
        cell[*n] = of[k].at;
        memcpy(x[(*n)++], of[k].x, sizeof of[k].x);
    }
    return k;
}

/* Brings the velocity of cell i nearer to u_w, m/s, by the share `gone'; what that does at that
 * rate, 1/s: m^2/s^3. */
static double relax_cell(struct fv *s, int64_t i, double rate, double gone, const double *u_w)
{
    double power = 0.0;
    for (int a = 0; a < s->dim; a++) {
        const double change = gone * (u_w[a] - s->u[a][i]);
        s->u[a][i] += change;
        if (s->stages.u_old[a])
            s->stages.u_old[a][i] += change;
        power += rate * (u_w[a] - s->u[a][i]) * s->u[a][i];
    }
    return power;
}

static void relax_cells(struct fv *s, const struct zone_cells *z, double dt)
{
    double x[WAVE_COLUMN][3], u_w[WAVE_COLUMN][3], *const power = s->watches->zone_power;
    int64_t cell[WAVE_COLUMN];
    int n;
    for (int64_t k = 0; k < z->n;) {
        k = find_column(s, z, k, &n, cell, x);
        if (n == 0)
            continue;
        const double rate = wave_zones_column(s->wave_zones, n, x, u_w),
                     gone = 1.0 - exp(-rate * dt);
        for (int i = 0; i < n; i++) {
            const double done = relax_cell(s, cell[i], rate, gone, u_w[i]);
            if (power)
                power[cell[i]] = done;
        }
    }
}

bool relax_zones(struct fv *s, double dt)
{
    struct watches *w = s->watches;
    if (!s->wave_zones)
        return false;
    if (s->surface && !w->zone_power && wave_zones_drive(s->wave_zones))
        w->zone_power = NEW_IN(w, double, s->size);
    timer_start(&s->run->timers, "waves");
    if (!s->zone_cells)
        s->zone_cells = mem_own(s, NEW(struct zone_cells, 1));
    if (!s->zone_cells->known || grid_moves(&s->grid))
        find_cells(s, s->zone_cells);
    if (w->zone_power && grid_moves(&s->grid))
        memset(w->zone_power, 0, (size_t)s->size * sizeof *w->zone_power);
    wave_zones_at(s->wave_zones, s->t);
    relax_cells(s, s->zone_cells, dt);
    sides_velocity(s, BC_GIVEN, s->u);
    timer_stop(&s->run->timers, "waves");
    return true;
}

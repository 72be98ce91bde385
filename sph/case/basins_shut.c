/* basins_shut.c - waters of the start that nothing but walls and bodies bounds: no air, no opening.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "basins_shut.h"

#include "../../common/scene/scene.h"
#include "../bodies/sph_bodies.h"
#include "basin_runs.h"

/* The cell beside another, over a period, too; false: the lattice ends there. */
static bool cell_beside(const struct basins *b, const int *ic, int axis, int way, int *jc)
{
    const int n = b->l->n[axis];
    memcpy(jc, ic, 3 * sizeof *jc);
    jc[axis] += way;
    if (b->s->periodic[axis] && n > 1)
        jc[axis] = (jc[axis] + n) % n;
    return jc[axis] >= 0 && jc[axis] < n;
}

/* What a cell has on one side: air or an opening opens its water; a wall counts with the bodies
 * that it belongs to. Water that the shapes have there and walls took is no air. */
static void look_around(const struct basins *b, const int *ic, int axis, int way,
                        struct basin_run *water)
{
    int jc[3];
    double x[3];
    const bool in = cell_beside(b, ic, axis, way, jc);
    const int64_t cell = lattice_cell(b->l, ic), next = in ? lattice_cell(b->l, jc) : -1;
    if (in && lattice_has(b->l, next) && !lattice_is_cut(b->l, way > 0 ? cell : next, axis))
        return;
    lattice_centre(b->l, jc, b->s->dim, x);
    const bool taken = in && scene_is_fluid(&b->s->run->scene, &b->exact, x, NULL);
    if (basin_look(b, ic, axis, way) != BEYOND_WALL && !taken)
        water->shut = false;
    lattice_centre(b->l, ic, b->s->dim, x);
    if (water->shut)
        water->beside |= shut_water_beside(b->s, x);
}

/* A part is shut until one of its cells says otherwise. middle: the mean place of its cells. */
static void find_shut(struct basins *b)
{
    for (int r = 0; r < b->nruns; r++)
        b->runs[r].shut = b->s->walls != NULL;
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++) {
            struct basin_run *water = b->runs + basin_part(b, r);
            for (int k = b->runs[r].first; k <= b->runs[r].last; k++) {
                int ic[3];
                double x[3];
                basin_cell(b, c, k, ic);
                lattice_centre(b->l, ic, b->s->dim, x);
                vec3_add(water->middle, 1.0, x);
                water->cells++;
                for (int side = 0; side < 2 * b->s->dim && water->shut; side++)
                    look_around(b, ic, side / 2, side % 2 ? 1 : -1, water);
            }
        }
    for (int r = 0; r < b->nruns; r++) {
        struct basin_run *water = b->runs + r;
        water->shut = water->shut && water->part == r && !water->dropped && !isnan(water->level);
        for (int a = 0; a < 3 && water->part == r; a++)
            water->middle[a] /= (double)water->cells;
    }
}

/* The level of the water in the open that is nearest to x; -INFINITY: there is none. */
static double level_outside(struct basins *b, const double *x)
{
    double level = -INFINITY, least = INFINITY;
    for (int c = 0; c < b->columns; c++)
        for (int r = b->start[c]; r < b->start[c + 1]; r++) {
            const struct basin_run *run = b->runs + r;
            int ic[3];
            double y[3], e[3];
            if (b->runs[basin_part(b, r)].shut || run->dropped || isnan(run->level))
                continue;
            basin_cell(b, c, basin_top(b, run), ic);
            lattice_centre(b->l, ic, b->s->dim, y);
            y[b->up] = x[b->up];
            vec3_from(x, y, e);
            if (vec3_dot(e, e) < least) {
                least = vec3_dot(e, e);
                level = run->level;
            }
        }
    return level;
}

/* Between a body and what it stands on water seeps (body_seal.c): what they shut in stands under
 * the level outside, unless that is below its roof. */
static void find_seeping(struct basins *b)
{
    for (int r = 0; r < b->nruns; r++) {
        const struct basin_run *water = b->runs + r;
        if (!water->shut || !shut_water_seeps(water->beside))
            continue;
        const double level = level_outside(b, water->middle);
        for (int q = 0; q < b->nruns; q++)
            if (basin_part(b, q) == r)
                b->runs[q].level = fmax(b->runs[q].level, level);
    }
}

void basins_find_shut(struct basins *b)
{
    find_shut(b);
    if (b->g > 0.0)
        find_seeping(b);
}

/* One water alone, and shut in: then the volume of the whole run is its own. */
bool basins_all_shut(struct basins *b)
{
    int waters = 0, shut = 0;
    for (int r = 0; r < b->nruns; r++) {
        waters += b->runs[r].part == r && !b->runs[r].dropped;
        shut += b->runs[r].shut;
    }
    return waters == 1 && shut == 1;
}

int64_t basins_shut_in(struct basins *b, int k, unsigned *beside, double *where)
{
    for (int r = 0; r < b->nruns; r++)
        if (b->runs[r].shut && k-- == 0) {
            *beside = b->runs[r].beside;
            memcpy(where, b->runs[r].middle, sizeof b->runs[r].middle);
            return b->runs[r].cells;
        }
    return 0;
}

void basins_cells_shut_in(struct basins *b, int k, int64_t *cell)
{
    int water = 0, of = -1;
    for (int r = 0; r < b->nruns; r++)
        of = b->runs[r].shut && water++ == k ? r : of;
    for (int64_t i = 0; i < lattice_cells(b->l); i++)
        if (lattice_has(b->l, i) && basin_part(b, (int)(basin_run_at(b, i) - b->runs)) == of)
            *cell++ = i;
}

/* basin_runs.c - see basin_runs.h. SPDX-License-Identifier: BSD-3-Clause */
#include "basin_runs.h"

#include "../walls/sph_walls.h"
#include "rooms.h"
#include "sph_params.h"

int basin_column(const struct basins *b, const int *ic)
{
    return ic[b->across[0]] + b->l->n[b->across[0]] * ic[b->across[1]];
}

void basin_cell(const struct basins *b, int column, int along, int *ic)
{
    const int n = b->l->n[b->across[0]];
    ic[b->across[0]] = column % n;
    ic[b->across[1]] = column / n;
    ic[b->up] = along;
}

/* The representative of a run's part, with path halving, so that long chains stay short. */
int basin_part(struct basins *b, int r)
{
    while (b->runs[r].part != r) {
        b->runs[r].part = b->runs[b->runs[r].part].part;
        r = b->runs[r].part;
    }
    return r;
}

/* Whether walls or bodies fill the place x, or part it from `from'. */
static bool blocked(const struct basins *b, const double *from, const double *x)
{
    if (b->l->cut[0])
        return rooms_blocked(b->s, from, x);
    return !scene_is_room(&b->s->run->scene, x) ||
           (b->s->walls && walls_distance(b->s->walls, x, INFINITY) <= 1e-3 * b->s->dx);
}

enum beyond basin_look(const struct basins *b, const int *ic, int axis, int way)
{
    const struct sph *s = b->s;
    int jc[3] = {ic[0], ic[1], ic[2]};
    double x[3], from[3];
    jc[axis] += way;
    lattice_centre(b->l, ic, s->dim, from);
    lattice_centre(b->l, jc, s->dim, x);
    if (x[axis] < s->lo[axis] || x[axis] > s->hi[axis]) {
        const int side = 2 * axis + (way > 0);
        const bool wall = scene_side_is_wall(&s->run->scene, SIDE_X_MIN + side) &&
                          sph_params_reaches(&s->run->scene.domain, &s->prm, side);
        if (s->open[side])
            return BEYOND_OPEN;
        return wall || blocked(b, from, x) ? BEYOND_WALL : BEYOND_AIR; /* a line, a mesh on it */
    }
    return blocked(b, from, x) ? BEYOND_WALL : BEYOND_AIR;
}

int basin_top(const struct basins *b, const struct basin_run *r)
{
    return b->sign > 0 ? r->last : r->first;
}

/* Runs of a column are in order, so by bisection; the cell must be filled. */
const struct basin_run *basin_run_at(const struct basins *b, int64_t cell)
{
    int ic[3];
    lattice_indices(b->l, cell, ic);
    const int c = basin_column(b, ic), k = ic[b->up];
    int lo = b->start[c], hi = b->start[c + 1];
    while (hi - lo > 1) {
        const int mid = (lo + hi) / 2;
        *(b->runs[mid].first <= k ? &lo : &hi) = mid;
    }
    return b->runs + lo;
}

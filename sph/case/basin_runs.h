/* basin_runs.h - what the sources of basins share: runs of cells, the waters that they make up, and
 * what is beside a cell. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/scene/scene.h"
#include "lattice.h"

struct basin_run {
    int first, last; /* cells along the axis of the runs */
    int part;        /* representative: a run of the same water */
    bool covered, dropped;
    double level;
    /* At the representative: nothing but walls and bodies bounds this water; which; its middle. */
    bool shut;
    unsigned beside;
    double middle[3];
    int64_t cells;
};

struct basin_link {
    int run[2];
    double width; /* cells through which they touch */
};

struct basins {
    const struct sph *s;
    const struct lattice *l;
    struct exact exact;
    int up, sign, across[2]; /* axis of the runs, where up is on it, the others */
    bool oblique, rows;      /* rows end at the surface; surface_rows.h */
    double g;
    int columns, nruns, *start; /* runs of column c: start[c] .. start[c + 1] - 1 */
    struct basin_run *runs;
    int nlinks;
    struct basin_link *links;
    int pockets, wet, dry;
    int64_t lost;
    double where[3];
};

/* Column of a cell. Indices of the cell of a column at a place along its axis; of the top cell of a
 * run. */
int basin_column(const struct basins *b, const int *ic);
void basin_cell(const struct basins *b, int column, int along, int *ic);
int basin_top(const struct basins *b, const struct basin_run *r);
/* Representative of the water of run r; the run that holds a cell. */
int basin_part(struct basins *b, int r);
const struct basin_run *basin_run_at(const struct basins *b, int64_t cell);
/* What is next to cell ic on an axis, which has no water. */
enum beyond { BEYOND_AIR, BEYOND_WALL, BEYOND_OPEN };
enum beyond basin_look(const struct basins *b, const int *ic, int axis, int way);

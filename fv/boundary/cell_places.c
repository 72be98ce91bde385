/* cell_places.c - see cell_places.h. SPDX-License-Identifier: BSD-3-Clause */
#include "cell_places.h"

#include <string.h>

#include "../grid/mesh.h"

void cell_centre(const struct fv *s, int64_t c, double *x)
{
    int at[3];
    const struct part *p = part_of_place(s, c, at);
    if (!s->m) {
        block_centre(&s->b, at[0], at[1], at[2], x);
        return;
    }
    const struct mesh_block *b = s->m->block + p->block;
    const int cell[3] = {p->lo[0] + at[0], p->lo[1] + at[1], p->lo[2] + at[2]};
    memcpy(x, b->centre[mesh_cell(b, cell)], 3 * sizeof *x);
}

int64_t cell_number(const struct fv *s, int64_t c)
{
    int at[3], cell[3];
    int64_t first = 0;
    const struct part *p = part_of_place(s, c, at);
    for (int a = 0; a < 3; a++)
        cell[a] = p->lo[a] + at[a];
    for (int k = 0; s->m && k < p->block; k++) {
        const int *n = s->m->block[k].n;
        first += (int64_t)n[0] * n[1] * n[2];
    }
    const int *n = s->m ? s->m->block[p->block].n : s->b.cells;
    return first + cell[0] + (int64_t)n[0] * (cell[1] + (int64_t)n[1] * cell[2]);
}

/* mesh_given.c - the cells of blocks that boxes hold: their velocity is given from outside of the
 * mesh. Marked before blocks are cut, for they can give values as computed ones can; cells of the
 * fringe that find no computed donors beside them join them.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "mesh.h"

/* Whether all corners of a cell lie in the box, which stands some periods away: the box's image
 * nearest above the centre counts. eps: 1e-9 of the cell's size. */
static bool is_in(const struct mesh *m, const struct mesh_block *b, int64_t c,
                  const double (*box)[3])
{
    const double *period = m->given.period;
    double move[3] = {0.0, 0.0, 0.0};
    int i[3];
    mesh_index(b, c, i);
    const double eps = 1e-9 * pow(b->volume[c], 1.0 / m->dim);
    for (int a = 0; a < m->dim; a++)
        if (period[a] > 0.0)
            move[a] = period[a] * floor((b->centre[c][a] - box[0][a]) / period[a]);
    for (int k = 0; k < 1 << m->dim; k++) {
        const double *x =
            b->x[mesh_vertex(b, i[0] + (k & 1), i[1] + (k >> 1 & 1), i[2] + (k >> 2 & 1))];
        for (int a = 0; a < m->dim; a++)
            if (x[a] - move[a] < box[0][a] - eps || x[a] - move[a] > box[1][a] + eps)
                return false;
    }
    return true;
}

bool mesh_given_holds(const struct mesh *m, const struct mesh_block *b, int64_t c)
{
    bool inside = false;
    for (int k = 0; k < m->given.n && !inside; k++)
        inside = is_in(m, b, c, (const double(*)[3])m->given.box[k]);
    return inside;
}

/* Whole cells alone. */
void mesh_given_mark(struct mesh *m)
{
    for (int k = 0; k < m->nblocks && m->has_given; k++) {
        struct mesh_block *b = m->block + k;
        for (int64_t c = 0; c < mesh_count(b); c++)
            if (mesh_given_holds(m, b, c))
                b->status[c] = CELL_GIVEN;
    }
}

/* Whether a computed cell is within given.layers of cell c along all indices. */
static bool is_near(const struct mesh *m, int k, int64_t c)
{
    const struct mesh_block *b = m->block + k;
    int i[3], d[3];
    mesh_index(b, c, i);
    const int layers = m->given.layers, reach = m->dim == 3 ? layers : 0;
    for (d[2] = -reach; d[2] <= reach; d[2]++)
        for (d[1] = -layers; d[1] <= layers; d[1]++)
            for (d[0] = -layers; d[0] <= layers; d[0]++) {
                int at[3] = {i[0] + d[0], i[1] + d[1], i[2] + d[2]}, to = k;
                double move[3] = {0.0, 0.0, 0.0};
                if (mesh_resolve(m, &to, at, move) &&
                    m->block[to].status[mesh_cell(m->block + to, at)] == CELL_COMPUTED)
                    return true;
            }
    return false;
}

/* Imposed cells that no stencil reads hold nothing: they become holes. */
void mesh_given_trim(struct mesh *m)
{
    m->given_cells = 0;
    for (int k = 0; k < m->nblocks && m->has_given; k++) {
        struct mesh_block *b = m->block + k;
        for (int64_t c = 0; c < mesh_count(b); c++) {
            if (b->status[c] != CELL_GIVEN)
                continue;
            if (!is_near(m, k, c))
                b->status[c] = CELL_HOLE;
            else
                m->given_cells++;
        }
    }
}

/* psi does not pass faces of imposed cells, whose flux is imposed. */
void mesh_given_close(struct mesh *m)
{
    for (int q = 0; q < m->nparts && m->has_given; q++) {
        const struct part *p = m->part + q;
        for (int a = 0; a < m->dim; a++)
            for (int64_t c = p->base + p->stride[a]; c < p->base + p->size; c++)
                if (m->status[c] == CELL_GIVEN || m->status[c - p->stride[a]] == CELL_GIVEN)
                    m->open[a][c] = 0.0;
    }
}

/* Computed neighbours of cell c at so many steps: 1 over a face, 2 over an edge, 3 over a corner.
 */
static int neighbours(const struct mesh *m, const struct part *p, int64_t c, int steps,
                      int (*offset)[3])
{
    const int deep = m->dim == 3 ? 1 : 0;
    int n = 0, d[3];
    for (d[2] = -deep; d[2] <= deep; d[2]++)
        for (d[1] = -1; d[1] <= 1; d[1]++)
            for (d[0] = -1; d[0] <= 1; d[0]++) {
                const int64_t at = c + d[0] + d[1] * p->stride[1] + d[2] * p->stride[2];
                if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] != steps ||
                    m->status[at] != CELL_COMPUTED)
                    continue;
                for (int a = 0; a < 3; a++)
                    offset[n][a] = d[a];
                n++;
            }
    return n;
}

/* Over faces if any neighbour there is computed, else over edges, else over corners. */
int mesh_given_sources(const struct mesh *m, const struct part *p, int64_t c, int (*offset)[3])
{
    int n = 0;
    for (int steps = 1; steps <= m->dim && n == 0; steps++)
        n = neighbours(m, p, c, steps, offset);
    return n;
}

/* overset_cut.c - what cells of blocks that overlap are. Later blocks cover earlier ones. A cell
 * must be computed if no later block can give it a value, or if the fringe of a later block needs
 * it; two layers around the computed cells are the fringe, the rest is a hole. Cells behind walls
 * of later blocks are holes from the start: found from the ghosts behind the walls, and all that is
 * connected with them and not covered. A side "overlap" starts with two layers of fringe. Given
 * cells (mesh_given.c) give values as computed ones do, but not to the fringe: what would want them
 * joins them. Order of overset_cut, from the last block to the first: cover (which cells lie within
 * later blocks), find_solid (which behind walls), protect (what later fringes need), status; then
 * make_fringe for all, and with imposed cells hand_over until nothing changes. Every rank does all
 * cells of all blocks.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "mesh_motion.h"
#include "overset_inside.h"

/* Flags of all blocks' cells, one byte each. */
enum { WANTED = 1, SOLID = 2, COVERED = 4 };

/* The two outer layers of a side "overlap" are always fringe or hole. */
static bool in_overlap_layers(const struct mesh *m, const struct mesh_block *b, const int *i)
{
    for (int a = 0; a < m->dim; a++)
        if ((b->side[2 * a] == MESH_OVERLAP && i[a] < 2) ||
            (b->side[2 * a + 1] == MESH_OVERLAP && i[a] >= b->n[a] - 2))
            return true;
    return false;
}

/* Whether the stencil may move by a cell: a cut holds for a step. One cell more on each side, where
 * cells go on. */
static bool keeps_giving(const struct mesh *m, int block, const int *from, int width)
{
    int lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    const struct mesh_block *b = m->block + block;
    for (int a = 0; a < m->dim; a++) {
        lo[a] = from[a] - 1;
        hi[a] = from[a] + width + 1;
        lo[a] = lo[a] < 0 && !overset_leads_on(b, 2 * a) ? 0 : lo[a];
        hi[a] = hi[a] > b->n[a] && !overset_leads_on(b, 2 * a + 1) ? b->n[a] : hi[a];
    }
    return overset_all(m, block, lo, hi, OF_KNOWN);
}

/* Whether a block from `first' on, other than `but', can give a value at x by `width' cells an
 * index; latest blocks first. On blocks that move the donor must do so for another step. */
static bool can_give(const struct mesh *m, const struct overset *o, int first, int but,
                     const double *x, int width)
{
    for (int q = m->nblocks - 1; q >= first; q--) {
        int cell[3], from[3];
        double xi[3];
        if (q != but && overset_locate(m, o, q, x, cell, xi) &&
            overset_stencil(m, q, cell, xi, width, OF_KNOWN, from) &&
            (!m->moves || keeps_giving(m, q, from, width)))
            return true;
    }
    return false;
}

/* Cells of block k that hold points behind walls of later blocks, and what hangs on to them. A
 * flood fill over faces of cells: O(cells). */
static void find_solid(const struct mesh *m, const struct overset *o, int k, unsigned char *flag)
{
    const struct mesh_block *b = m->block + k;
    int64_t *stack = NEW(int64_t, mesh_count(b) + 1), n = 0;
    for (int q = k + 1; q < m->nblocks; q++)
        for (int s = 0; s < 2 * m->dim; s++) {
            const struct mesh_block *w = m->block + q;
            if (!side_is_wall(w->side[s]))
                continue;
            for (int64_t c = 0; c < mesh_count(w); c++) {
                int i[3], cell[3];
                mesh_index(w, c, i);
                if (i[s / 2] != (s % 2 ? w->n[s / 2] - 1 : 0))
                    continue;
                for (int layer = 0; layer < MESH_GHOSTS; layer++) {
                    double x[3], dx[3][3], xi[3];
                    i[s / 2] += s % 2 ? 1 : -1;
                    mesh_map_point(w, m->dim, i, (double[3]){0.5, 0.5, 0.5}, x, dx);
                    if (!overset_locate(m, o, k, x, cell, xi))
                        continue;
                    const int64_t to = mesh_cell(b, cell);
                    if (!(flag[to] & (SOLID | COVERED))) {
                        flag[to] |= SOLID;
                        stack[n++] = to;
                    }
                }
            }
        }
    while (n > 0) {
        int i[3];
        mesh_index(b, stack[--n], i);
        for (int a = 0; a < m->dim; a++)
            for (int up = -1; up < 2; up += 2) {
                int at[3] = {i[0], i[1], i[2]};
                at[a] += up;
                if (at[a] < 0 || at[a] >= b->n[a])
                    continue;
                const int64_t to = mesh_cell(b, at);
                if (!(flag[to] & (SOLID | COVERED))) {
                    flag[to] |= SOLID;
                    stack[n++] = to;
                }
            }
    }
    mem_free(stack);
}

/* Within a later block: covered; in a hole of the latest one there: behind a wall. Only the latest
 * block at x counts, for it is on top. */
static unsigned char cover(const struct mesh *m, const struct overset *o, int k, const double *x)
{
    int cell[3];
    double xi[3];
    for (int q = m->nblocks - 1; q > k; q--)
        if (overset_locate(m, o, q, x, cell, xi)) {
            const struct mesh_block *b = m->block + q;
            const bool hole = b->status[mesh_cell(b, cell)] == CELL_HOLE;
            return hole && !in_overlap_layers(m, b, cell) ? SOLID : COVERED;
        }
    return 0;
}

/* The fringe of later blocks wants the cells around it. Two layers around, three where blocks move:
 * stencils of the later block's fringe after a step. */
static void protect(const struct mesh *m, const struct overset *o, int k, unsigned char *flag)
{
    const struct mesh_block *b = m->block + k;
    for (int q = k + 1; q < m->nblocks; q++) {
        const struct mesh_block *w = m->block + q;
        for (int64_t c = 0; c < mesh_count(w); c++) {
            int i[3], cell[3];
            double xi[3];
            mesh_index(w, c, i);
            if (!in_overlap_layers(m, w, i) || can_give(m, o, k + 1, q, w->centre[c], 4) ||
                !overset_locate(m, o, k, w->centre[c], cell, xi))
                continue;
            const int near = m->moves ? 3 : 2; /* a cut holds for a step */
            const int deep = m->dim == 3 ? near : 0;
            for (int e = -deep; e <= deep; e++)
                for (int d = -near; d <= near; d++)
                    for (int p = -near; p <= near; p++) {
                        int at[3] = {cell[0] + p, cell[1] + d, cell[2] + e}, to = k;
                        double move[3] = {0.0, 0.0, 0.0};
                        if (mesh_resolve(m, &to, at, move) && to == k)
                            flag[mesh_cell(b, at)] |= WANTED;
                    }
        }
    }
}

/* Computed if wanted, not covered, or covered but without a donor; never behind walls or in the
 * outer layers. */
static void cut(struct mesh *m, const struct overset *o, int k, unsigned char *flag)
{
    struct mesh_block *b = m->block + k;
    const int64_t n = mesh_count(b);
    if (k < m->nblocks - 1) {
        for (int64_t c = 0; c < n; c++)
            flag[c] |= cover(m, o, k, b->centre[c]);
        find_solid(m, o, k, flag);
        protect(m, o, k, flag);
    }
    for (int64_t c = 0; c < n; c++) {
        int i[3];
        mesh_index(b, c, i);
        const bool wanted = (flag[c] & WANTED) || !(flag[c] & COVERED) ||
                            !can_give(m, o, k + 1, k, b->centre[c], 4);
        if (b->status[c] == CELL_GIVEN)
            continue;
        b->status[c] =
            wanted && !(flag[c] & SOLID) && !in_overlap_layers(m, b, i) ? CELL_COMPUTED : CELL_HOLE;
    }
}

/* Two layers around computed cells become the fringe. The layers reach across joins. */
static void make_fringe(struct mesh *m, int k)
{
    const struct mesh_block *b = m->block + k;
    const int reach = m->dim == 3 ? 2 : 0;
    for (int64_t c = 0; c < mesh_count(b); c++) {
        int i[3];
        mesh_index(b, c, i);
        if (b->status[c] != CELL_COMPUTED)
            continue;
        bool inside = true;
        for (int a = 0; a < m->dim; a++)
            inside = inside && i[a] >= 2 && i[a] < b->n[a] - 2;
        for (int e = -reach; e <= reach; e++)
            for (int d = -2; d <= 2; d++)
                for (int p = -2; p <= 2; p++) {
                    int at[3] = {i[0] + p, i[1] + d, i[2] + e}, to = k;
                    double move[3] = {0.0, 0.0, 0.0};
                    if (!inside && !mesh_resolve(m, &to, at, move))
                        continue;
                    unsigned char *s = m->block[to].status + mesh_cell(m->block + to, at);
                    if (*s == CELL_HOLE)
                        *s = CELL_FRINGE;
                }
    }
}

/* Whether given cells are why no other block has four computed cells a side around x. Then the
 * fringe cell would take values through the box. */
static bool is_beside_given(const struct mesh *m, const struct overset *o, int k, const double *x)
{
    for (int q = 0; q < m->nblocks && m->has_given; q++) {
        int cell[3], from[3];
        double xi[3];
        if (q == k || !overset_locate(m, o, q, x, cell, xi))
            continue;
        if (overset_stencil(m, q, cell, xi, 4, OF_COMPUTED, from))
            return false;
        if (overset_stencil(m, q, cell, xi, 4, OF_KNOWN, from))
            return true;
    }
    return false;
}

/* Steps from cell i of block k along axis a to a given cell, over free ones; 0: none within `most'.
 * *joined: it is none of the box itself. Also 0 where a hole comes first. */
static int steps_to_given(const struct mesh *m, int k, const int *i, int a, int way, int most,
                          bool *joined)
{
    for (int n = 1; n <= most; n++) {
        int at[3] = {i[0], i[1], i[2]}, to = k;
        double move[3] = {0.0, 0.0, 0.0};
        at[a] += n * way;
        if (!mesh_resolve(m, &to, at, move))
            return 0;
        const int64_t c = mesh_cell(m->block + to, at);
        const unsigned char s = m->block[to].status[c];
        if (s == CELL_GIVEN)
            *joined = *joined || !mesh_given_holds(m, m->block + to, c);
        if (s == CELL_GIVEN || s == CELL_HOLE)
            return s == CELL_GIVEN ? n : 0;
    }
    return 0;
}

/* Whether a free cell stands with fewer than four in line between the box and cells that have
 * joined it: too few for its gradient. Along each axis in turn. */
static bool is_in_gap(const struct mesh *m, int k, const int *i)
{
    enum { LEAST = 4 };
    for (int a = 0; a < m->dim; a++) {
        bool joined = false;
        const int down = steps_to_given(m, k, i, a, -1, LEAST - 1, &joined);
        const int up = down ? steps_to_given(m, k, i, a, 1, LEAST - down, &joined) : 0;
        if (up && joined)
            return true;
    }
    return false;
}

/* Cells of the fringe for whom the box is nearer than other donors join its cells; false: there are
 * none. gaps: of all free cells those between them and the box do. own[] collects first, so that
 * the order of cells does not matter. */
static bool hand_over(struct mesh *m, const struct overset *o, bool gaps)
{
    unsigned char *own[MESH_BLOCKS_MAX];
    bool any = false;
    for (int k = 0; k < m->nblocks; k++) {
        const struct mesh_block *b = m->block + k;
        own[k] = NEW(unsigned char, mesh_count(b));
        for (int64_t c = 0; c < mesh_count(b); c++) {
            int i[3];
            mesh_index(b, c, i);
            own[k][c] = gaps
                            ? b->status[c] <= CELL_FRINGE && is_in_gap(m, k, i)
                            : b->status[c] == CELL_FRINGE && is_beside_given(m, o, k, b->centre[c]);
            any = any || own[k][c];
        }
    }
    for (int k = 0; k < m->nblocks; k++) {
        for (int64_t c = 0; c < mesh_count(m->block + k); c++)
            if (own[k][c])
                m->block[k].status[c] = CELL_GIVEN;
        mem_free(own[k]);
    }
    return any;
}

void overset_count(struct mesh *m)
{
    m->computed = m->fringe_cells = 0;
    for (int k = 0; k < m->nblocks; k++)
        for (int64_t c = 0; c < mesh_count(m->block + k); c++) {
            m->computed += m->block[k].status[c] == CELL_COMPUTED;
            m->fringe_cells += m->block[k].status[c] == CELL_FRINGE;
        }
}

/* From the last block down: a block's status decides whether earlier ones find donors in it. */
void overset_cut(struct mesh *m, const struct overset *o)
{
    for (int k = m->nblocks - 1; k >= 0; k--) {
        unsigned char *flag = NEW(unsigned char, mesh_count(m->block + k));
        cut(m, o, k, flag);
        mem_free(flag);
    }
    for (int k = 0; k < m->nblocks; k++)
        make_fringe(m, k);
    for (bool more = m->has_given; more;)
        more = hand_over(m, o, false) && hand_over(m, o, true);
    overset_count(m);
}

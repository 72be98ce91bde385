/* mesh_recut.c - blocks cut anew around boxes that have moved: what their cells are, donors of the
 * fringe, faces that psi passes. Where sph.box moves, fv's imposed cells move with it:
 * mesh_recut_wanted is asked once a coupling step, and only if the set of cells in the boxes has
 * changed is everything cut anew. The caller then renews what depends on it (matrix, forcing).
 * SPDX-License-Identifier: BSD-3-Clause */

#include "overset_inside.h"

/* O(cells of all blocks), on every rank. */
bool mesh_recut_wanted(const struct mesh *m, const double (*box)[2][3])
{
    struct mesh moved = *m; /* but for the boxes */
    memcpy(moved.given.box, box, (size_t)m->given.n * sizeof *box);
    for (int k = 0; k < m->nblocks; k++)
        for (int64_t c = 0; c < mesh_count(m->block + k); c++)
            if (mesh_given_holds(m, m->block + k, c) != mesh_given_holds(&moved, m->block + k, c))
                return true;
    return false;
}

/* The order is that of mesh_create. */
void mesh_recut(struct mesh *m, const double (*box)[2][3])
{
    memcpy(m->given.box, box, (size_t)m->given.n * sizeof *box);
    for (int k = 0; k < m->nblocks; k++)
        memset(m->block[k].status, CELL_COMPUTED, (size_t)mesh_count(m->block + k));
    *m->trouble = '\0';
    mesh_given_mark(m);
    if (m->has_fringe)
        overset_cut(m, m->search);
    mesh_given_trim(m);
    overset_count(m);
    if (m->has_fringe)
        overset_renew(m, m->search);
    mesh_set_status(m);
    mesh_open_faces(m);
    mesh_given_close(m);
}

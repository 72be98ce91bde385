/* mesh_recut.c - blocks cut anew around a box that has moved: what their cells are, donors of the
 * fringe, faces that psi passes. SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "overset_inside.h"

bool mesh_recut_wanted(const struct mesh *m, const double (*box)[3])
{
    struct mesh moved = *m; /* but for the box */
    memcpy(moved.given.lo, box[0], sizeof moved.given.lo);
    memcpy(moved.given.hi, box[1], sizeof moved.given.hi);
    for (int k = 0; k < m->nblocks; k++)
        for (int64_t c = 0; c < mesh_count(m->block + k); c++)
            if (mesh_given_holds(m, m->block + k, c) != mesh_given_holds(&moved, m->block + k, c))
                return true;
    return false;
}

void mesh_recut(struct mesh *m, const double (*box)[3])
{
    memcpy(m->given.lo, box[0], sizeof m->given.lo);
    memcpy(m->given.hi, box[1], sizeof m->given.hi);
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

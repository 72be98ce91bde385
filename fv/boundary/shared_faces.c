/* shared_faces.c - faces of walls that count once where blocks overlap along a wall: of each face
 * the share that no later block has as a face of a wall, from points on it. A later block whose
 * cells reach over a wall that is not its own leaves all of it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_sides.h"

#include "../grid/fv_grid.h"

enum { POINTS = 64, POINTS_3D = 8, DEPTHS = 3 };

/* Whether the cell of a block lies on one of its walls. */
static bool on_wall(const struct mesh_block *b, int dim, const int *cell)
{
    bool on = false;
    for (int k = 0; k < 2 * dim; k++)
        on = on || (side_is_wall(b->side[k]) && cell[k / 2] == (k % 2 ? b->n[k / 2] - 1 : 0));
    return on;
}

/* Whether a later block has a wall at xi of a face's cell; the walls of two blocks that turn are
 * polygons, which part by some hundredths of a cell. */
static bool has_another(const struct fv *s, const struct overset *o, const struct side *d,
                        const int *at, double xi[3])
{
    static const double depth[DEPTHS] = {1e-3, 0.05, 0.25};
    for (int k = 0; k < DEPTHS; k++) {
        double x[3], dx[3][3];
        int block, cell[3];
        xi[d->a] = d->k % 2 ? 1.0 - depth[k] : depth[k];
        mesh_map_point(s->m->block + d->p->block, s->m->dim, at, xi, x, dx);
        if (overset_computed(s->m, o, d->p->block, x, &block, cell) &&
            on_wall(s->m->block + block, s->m->dim, cell))
            return true;
    }
    return false;
}

/* Share of side^(dim-1) points of a face that no later block has, from one edge of it to the
 * other. */
static double share_of_points(const struct fv *s, const struct overset *o, const struct side *d,
                              const int *at, int side, double edge)
{
    const int all = s->m->dim == 3 ? side * side : side;
    int own = 0;
    for (int n = 0; n < all; n++) {
        double xi[3] = {0.5, 0.5, 0.5};
        xi[d->t[0]] = edge + (1.0 - 2.0 * edge) * (n % side) / (side - 1);
        if (d->t[1] < s->m->dim)
            xi[d->t[1]] = edge + (1.0 - 2.0 * edge) * (n / side) / (side - 1);
        own += !has_another(s, o, d, at, xi);
    }
    return (double)own / all;
}

/* Three points each way tell whether there is anything to share. */
static double share_of_face(const struct fv *s, const struct overset *o, const struct side *d,
                            int i, int j)
{
    const int side = s->m->dim == 3 ? POINTS_3D : POINTS;
    int at[3];
    at[d->a] = d->p->lo[d->a] + d->first;
    at[d->t[0]] = d->p->lo[d->t[0]] + i;
    at[d->t[1]] = d->p->lo[d->t[1]] + j;
    const double first = share_of_points(s, o, d, at, 3, 0.01);
    return first == 0.0 || first == 1.0 ? first : share_of_points(s, o, d, at, side, 0.5 / side);
}

/* Whether blocks after that of a side have walls. */
static bool walls_follow(const struct mesh *m, const struct side *d)
{
    bool any = false;
    for (int b = d->p->block + 1; b < m->nblocks; b++)
        for (int k = 0; k < 2 * m->dim; k++)
            any = any || side_is_wall(m->block[b].side[k]);
    return any;
}

/* Once, or once a time where blocks move. */
void mesh_bc_share_faces(const struct fv *s)
{
    const struct mesh *m = s->m;
    struct mesh_bc *bc = s->sides;
    if (!m->has_fringe || (bc->shared && !(m->moves && bc->shared_at != s->t)))
        return;
    struct overset *o = m->search ? m->search : overset_search(s->run, m);
    for (int k = 0; k < bc->n; k++) {
        struct side *d = bc->side + k;
        if (!side_is_wall(d->kind) || !walls_follow(m, d))
            continue;
        if (!d->once)
            d->once = NEW_IN(s->sides, double, d->width *(d->n[1] + 2 * d->g[1]));
        SIDE_PLACES (d, 0, i, j, at, c)
            d->once[at] = m->status[c] == CELL_COMPUTED ? share_of_face(s, o, d, i, j) : 1.0;
    }
    if (o != m->search)
        FREE(o);
    bc->shared = true;
    bc->shared_at = s->t;
}

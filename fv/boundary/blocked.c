/* blocked.c - boxes of cells that are cut out, and which free cells have them in their stencils.
 * Made once: boxes do not move. box[] marks their cells, ghosts included; near[a] lists the free
 * cells with a box within three cells along a, beside[a][t] the faces along a that have a box along
 * t. blocked_cells.c then corrects only these.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "blocked.h"

/* Number of the box in which a cell of the whole grid lies, from 1; 0: none. Behind closed sides as
 * before them. */
static unsigned char box_of(const struct block *b, const int (*cells)[2][3], int n,
                            const int *global)
{
    int i[3];
    for (int a = 0; a < 3; a++) {
        const int m = b->cells[a];
        i[a] = b->periodic[a]   ? (global[a] % m + m) % m
               : global[a] < 0  ? 0
               : global[a] >= m ? m - 1
                                : global[a];
    }
    for (int k = n - 1; k >= 0; k--) {
        bool in = true;
        for (int a = 0; a < b->dim; a++)
            in = in && i[a] >= cells[k][0][a] && i[a] < cells[k][1][a];
        if (in)
            return (unsigned char)(k + 1);
    }
    return 0;
}

/* Number of the box of every cell and ghost of this rank. */
static void mark(const struct fv *s, struct blocked *w)
{
    const struct block *b = &s->b;
    int cells[BLOCKED_MAX][2][3];
    const int n = s->prm.nboxes;
    for (int k = 0; k < n; k++)
        blocked_cells(&s->run->scene.domain, &s->prm, k, cells[k][0], cells[k][1]);
    w->box = NEW_IN(w, unsigned char, b->size);
    w->vent = NEW_IN(w, unsigned char, b->size);
    for (int64_t c = 0; c < b->size; c++) {
        int at[3];
        block_place(b, c, at);
        for (int a = 0; a < 3; a++)
            at[a] += b->lo[a];
        w->box[c] = box_of(b, (const int(*)[2][3])cells, n, at);
    }
}

/* Free cells from c on along the step d, at most 3 of the `most' that are there; *box: what ends
 * them. 3 means three or more. */
static int count_free(const struct blocked *w, int64_t c, int64_t d, int most, int *box)
{
    int n = 0;
    while (n < 3 && n < most && !w->box[c + (n + 1) * d])
        n++;
    *box = n < 3 && n < most ? w->box[c + (n + 1) * d] - 1 : -1;
    return n < most ? n : 3;
}

/* Cells of this rank, one layer around, and the first beyond the upper end along a. So that faces
 * and products of all own cells find theirs. */
static void list_near(const struct block *b, struct blocked *w, int a)
{
    w->near[a] = NEW_IN(w, struct near_box, b->size);
    for (int k = b->g[2] ? -1 : 0; k < b->n[2] + (b->g[2] ? 1 : 0); k++)
        for (int j = -1; j < b->n[1] + 1; j++)
            for (int i = -1; i < b->n[0] + 1; i++) {
                const int at[3] = {i, j, k};
                struct near_box x = {.cell = block_at(b, i, j, k), .own = true};
                if (w->box[x.cell])
                    continue;
                for (int t = 0; t < 3; t++)
                    x.own = x.own && at[t] >= 0 && at[t] < b->n[t];
                for (int up = 0; up < 2; up++)
                    x.free[up] =
                        count_free(w, x.cell, up ? b->stride[a] : -b->stride[a],
                                   up ? b->n[a] + GHOSTS - 1 - at[a] : at[a] + GHOSTS, x.box + up);
                if (x.free[0] < 3 || x.free[1] < 3)
                    w->near[a][w->nnear[a]++] = x;
            }
    w->slip[a] = mem_new_in(w, (size_t)w->nnear[a] + 1, sizeof *w->slip[a]);
}

/* in points away from the box, or from the upper one of two. */
static void list_beside(const struct block *b, struct blocked *w, int a, int t)
{
    const int64_t d = b->stride[a], e = b->stride[t];
    w->beside[a][t] = NEW_IN(w, struct beside_box, b->size);
    for (int k = 0; k < b->n[2] + (a == 2); k++)
        for (int j = 0; j < b->n[1] + (a == 1); j++)
            for (int i = 0; i < b->n[0] + (a == 0); i++) {
                const int64_t c = block_at(b, i, j, k);
                if (w->box[c] || w->box[c - d])
                    continue;
                const bool up = w->box[c + e] && w->box[c + e - d],
                           down = w->box[c - e] && w->box[c - e - d];
                if (up || down)
                    w->beside[a][t][w->nbeside[a][t]++] =
                        (struct beside_box){.face = c,
                                            .in = up ? -e : e,
                                            .box = w->box[up ? c + e : c - e] - 1,
                                            .both = up && down};
            }
}

/* Faces are moved to the nearest faces of cells. */
void blocked_cells(const struct scene_domain *d, const struct fv_params *p, int k, int lo[3],
                   int hi[3])
{
    for (int a = 0; a < 3; a++) {
        const int n = p->cells[a];
        lo[a] = 0;
        hi[a] = 1;
        if (a >= d->dim)
            continue;
        const double h = (d->max[a] - d->min[a]) / n;
        lo[a] = (int)lround(fmin(fmax((p->boxes[k].min[a] - d->min[a]) / h, 0.0), n));
        hi[a] = (int)lround(fmin(fmax((p->boxes[k].max[a] - d->min[a]) / h, 0.0), n));
    }
}

/* Faces of boxes, then what lies beside them along each other axis. */
struct blocked *blocked_create(const struct fv *s)
{
    const struct block *b = &s->b;
    if (s->prm.nboxes == 0)
        return NULL;
    struct blocked *w = NEW(struct blocked, 1);
    mark(s, w);
    for (int a = 0; a < b->dim; a++) {
        list_near(b, w, a);
        for (int t = 0; t < b->dim; t++)
            if (t != a)
                list_beside(b, w, a, t);
    }
    return w;
}

/* Three layers of ghosts follow the last own cell. */
struct near_box blocked_near(const struct fv *s, int64_t c, int a)
{
    struct near_box x = {.cell = c, .own = true};
    for (int up = 0; up < 2; up++)
        x.free[up] =
            count_free(s->blocked, c, up ? s->b.stride[a] : -s->b.stride[a], GHOSTS, x.box + up);
    return x;
}

/* Scalars (q < 0) have zero gradient. */
enum blocked_ghost blocked_rule(const struct fv *s, int box, int q, int a)
{
    if (box < 0 || q < 0)
        return GHOST_EVEN;
    if (s->prm.boxes[box].kind == WALL_NO_SLIP)
        return GHOST_NO_SLIP;
    return q == a ? GHOST_ODD : GHOST_EVEN;
}

/* No-slip: averages of the cubic that is 0 on the face and has the first three cells' averages,
 * -(13 q_0 - 5 q_1 + q_2)/3 and -(70 q_0 - 32 q_1 + 7 q_2)/3. */
double blocked_ghost(const double *q, int64_t in, int depth, enum blocked_ghost rule)
{
    if (rule == GHOST_LINEAR)
        return q[0] + depth * (q[0] - q[in]);
    if (rule != GHOST_NO_SLIP)
        return (rule == GHOST_ODD ? -1.0 : 1.0) * q[(depth - 1) * in];
    return depth == 1 ? -(13.0 * q[0] - 5.0 * q[in] + q[2 * in]) / 3.0
                      : -(70.0 * q[0] - 32.0 * q[in] + 7.0 * q[2 * in]) / 3.0;
}

/* Behind a box's face ghosts are made from the cells before it, at most `reach' of them. */
void blocked_line(const struct near_box *x, const double *q, int64_t d, int reach,
                  const enum blocked_ghost rule[2], double *v)
{
    const double *at = q + x->cell;
    for (int up = 0; up < 2; up++) {
        const int64_t out = up ? d : -d;
        for (int m = 1; m <= reach; m++)
            v[up ? m : -m] =
                m <= x->free[up] || x->box[up] < 0
                    ? at[m * out]
                    : blocked_ghost(at + x->free[up] * out, -out, m - x->free[up], rule[up]);
    }
    v[0] = at[0];
}

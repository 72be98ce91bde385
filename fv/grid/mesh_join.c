/* mesh_join.c - faces of blocks that meet vertex by vertex, directly or over a period of the
 * domain; the indices behind them are the neighbour's. Works with doubled indices X (vertex i: 2 i,
 * cell i: 2 i + 1), so that one map serves cells and vertices. Every rank does it for all blocks:
 * 27 shifts by periods, 8 orientations and all pairs of sides are tried.
 * SPDX-License-Identifier: BSD-3-Clause */

#include "mesh.h"

/* Tangents of a side's axis that the dimension has. Returns their number. */
static int tangents(int dim, int axis, int *t)
{
    int n = 0;
    for (int a = 0; a < dim; a++)
        if (a != axis)
            t[n++] = a;
    return n;
}

/* The map from indices behind side sa of block ka to those of block kb before its side sb. flips:
 * bit t turns the t-th tangent round, bit 2 swaps the tangents. block is -1 where the numbers of
 * cells differ. */
static struct mesh_join join_of(const struct mesh *m, int ka, int sa, int kb, int sb, int flips)
{
    const struct mesh_block *A = m->block + ka, *B = m->block + kb;
    const int na = sa / 2, nb = sb / 2, swap = flips >> 2 & 1;
    struct mesh_join j = {.block = kb, .axis = {0, 1, 2}, .sign = {1, 1, 1}};
    int ta[2], tb[2];
    const int nt = tangents(m->dim, na, ta);
    tangents(m->dim, nb, tb);
    const int face_a = sa % 2 ? 2 * A->n[na] : 0, face_b = sb % 2 ? 2 * B->n[nb] : 0;
    j.axis[na] = nb;
    j.sign[na] = sa % 2 != sb % 2 ? 1 : -1;
    j.shift[na] = face_b - j.sign[na] * face_a;
    for (int t = 0; t < nt; t++) {
        const int to = tb[swap ? 1 - t : t];
        j.axis[ta[t]] = to;
        j.sign[ta[t]] = flips >> t & 1 ? -1 : 1;
        j.shift[ta[t]] = flips >> t & 1 ? 2 * A->n[ta[t]] : 0;
        if (A->n[ta[t]] != B->n[to])
            j.block = -1;
    }
    return j;
}

/* Y = the neighbour's indices of X; X and Y may be one array. */
static void apply(const struct mesh_join *j, const int *X, int *Y)
{
    int from[3] = {X[0], X[1], X[2]};
    for (int a = 0; a < 3; a++)
        Y[j->axis[a]] = j->sign[a] * from[a] + j->shift[a];
}

/* Whether all vertices of the face lie on the neighbour's. Vertices may be apart by 1e-4 of the
 * edge beside them. */
static bool meets(const struct mesh *m, int ka, int sa, const struct mesh_join *j)
{
    const struct mesh_block *A = m->block + ka, *B = m->block + j->block;
    const int axis = sa / 2;
    int t[2] = {2, 2}, i[3] = {0, 0, 0};
    const int nt = tangents(m->dim, axis, t);
    i[axis] = sa % 2 ? A->n[axis] : 0;
    for (int q = 0; q <= (nt > 1 ? A->n[t[1]] : 0); q++)
        for (int p = 0; p <= A->n[t[0]]; p++) {
            int Y[3];
            i[t[0]] = p;
            if (nt > 1)
                i[t[1]] = q;
            apply(j, (int[3]){2 * i[0], 2 * i[1], 2 * i[2]}, Y);
            const int to[3] = {i[0] + (t[0] == 0 ? (p ? -1 : 1) : 0),
                               i[1] + (t[0] == 1 ? (p ? -1 : 1) : 0), i[2]};
            const double *x = A->x[mesh_vertex(A, i[0], i[1], i[2])],
                         *y = B->x[mesh_vertex(B, Y[0] / 2, Y[1] / 2, Y[2] / 2)],
                         *z = A->x[mesh_vertex(A, to[0], to[1], to[2])];
            double apart = 0.0, edge = 0.0;
            for (int c = 0; c < m->dim; c++) {
                apart += pow(x[c] - y[c] - j->move[c], 2);
                edge += pow(x[c] - z[c], 2);
            }
            if (!(apart <= 1e-8 * edge))
                return false;
        }
    return true;
}

/* Looks for the side that this one meets; a side may meet another of its own block, but only over a
 * period if it is called periodic. */
static bool find_join(const struct run *r, struct mesh *m, int ka, int sa)
{
    const struct scene_domain *d = &r->scene.domain;
    const enum mesh_side kind = m->block[ka].side[sa];
    for (int kb = 0; kb < m->nblocks; kb++)
        for (int sb = 0; sb < 2 * m->dim; sb++) {
            if (m->block[kb].side[sb] != kind || (ka == kb && sa == sb))
                continue;
            for (int flips = 0; flips < (m->dim == 3 ? 8 : 2); flips++)
                for (int s = 0; s < 27; s++) {
                    struct mesh_join j = join_of(m, ka, sa, kb, sb, flips);
                    const int over[3] = {s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1};
                    bool fits = j.block >= 0 && (kind == MESH_PERIODIC) == (s != 13);
                    for (int c = 0; c < 3; c++) {
                        fits = fits && (over[c] == 0 || (c < m->dim && d->periodic[c]));
                        j.move[c] = over[c] * (d->max[c] - d->min[c]);
                    }
                    if (fits && meets(m, ka, sa, &j)) {
                        m->block[ka].join[sa] = j;
                        return true;
                    }
                }
        }
    return false;
}

static bool is_joined(const struct mesh_block *b, int side)
{
    return b->side[side] == MESH_JOINED || b->side[side] == MESH_PERIODIC;
}

/* Goes through joined sides as far as they lead; X: doubled indices. Returns whether it ended among
 * the block's own cells and vertices. At most eight hops: a corner index passes three sides at
 * most. */
static bool follow(const struct mesh *m, int *block, int *X, double *move)
{
    for (int hop = 0; hop < 8; hop++) {
        const struct mesh_block *b = m->block + *block;
        int side = -1;
        bool inside = true;
        for (int a = 0; a < m->dim; a++) {
            const int k = X[a] < 0 ? 2 * a : X[a] > 2 * b->n[a] ? 2 * a + 1 : -1;
            inside = inside && k < 0;
            if (k >= 0 && side < 0 && is_joined(b, k))
                side = k;
        }
        if (side < 0)
            return inside;
        const struct mesh_join *j = b->join + side;
        apply(j, X, X);
        *block = j->block;
        for (int c = 0; c < 3; c++)
            move[c] += j->move[c];
    }
    return false;
}

/* Indices in the real block; (X - 1) >> 1 also rounds negative ones down. */
bool mesh_resolve(const struct mesh *m, int *block, int *cell, double *move)
{
    int X[3] = {2 * cell[0] + 1, 2 * cell[1] + 1, 2 * cell[2] + 1};
    const bool inside = follow(m, block, X, move);
    for (int a = 0; a < 3; a++)
        cell[a] = (X[a] - 1) >> 1;
    return inside;
}

/* Vertices behind joined sides: the neighbour's; behind other sides of the neighbour its own. So
 * that metrics are smooth across joins. */
static void set_vertices(struct mesh *m, int k)
{
    struct mesh_block *b = m->block + k;
    int i[3];
    for (i[2] = b->v0[2]; i[2] < b->v0[2] + b->nv[2]; i[2]++)
        for (i[1] = b->v0[1]; i[1] < b->v0[1] + b->nv[1]; i[1]++)
            for (i[0] = b->v0[0]; i[0] < b->v0[0] + b->nv[0]; i[0]++) {
                int X[3] = {2 * i[0], 2 * i[1], 2 * i[2]}, to = k;
                double move[3] = {0.0, 0.0, 0.0};
                follow(m, &to, X, move);
                const struct mesh_block *o = m->block + to;
                bool there = true, here = to == k;
                for (int a = 0; a < 3; a++) {
                    there = there && X[a] >= 2 * o->v0[a] && X[a] < 2 * (o->v0[a] + o->nv[a]);
                    here = here && X[a] == 2 * i[a];
                }
                if (here || !there)
                    continue;
                const double *from = o->x[mesh_vertex(o, X[0] / 2, X[1] / 2, X[2] / 2)];
                for (int c = 0; c < m->dim; c++)
                    b->x[mesh_vertex(b, i[0], i[1], i[2])][c] = from[c] + move[c];
            }
}

/* All faults are told; vertices are shared only if there are none. */
bool mesh_join_blocks(const struct run *r, struct faults *f, struct mesh *m)
{
    static const char *const sides[] = {"i_min", "i_max", "j_min", "j_max", "k_min", "k_max"};
    bool all = true;
    for (int k = 0; k < m->nblocks; k++)
        for (int s = 0; s < 2 * m->dim; s++) {
            m->block[k].join[s].block = -1;
            if (!is_joined(m->block + k, s) || find_join(r, m, k, s))
                continue;
            all = false;
            mesh_fault(r, f, m->block[k].prm, sides[s],
                       m->block[k].side[s] == MESH_JOINED
                           ? "no other joined side meets this one vertex by vertex: make the "
                             "corners and numbers of cells equal, or let it overlap"
                           : "no other periodic side meets this one a period of the domain away: "
                             "see domain.periodic, min and max");
        }
    for (int k = 0; all && k < m->nblocks; k++)
        set_vertices(m, k);
    return all;
}

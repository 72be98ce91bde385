/* block_walls.c - closed sides of blocks as faces, and images of points behind them. Every rank
 * lists all faces of all closed sides (O(surface)), so that any of them can ask for walls near any
 * position: particles of a partner near fv's walls, level sets, gauges. A side's box is looked at
 * first, then its faces one by one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "block_walls.h"

struct face {
    double x[3], n[3]; /* m: centre; into the fluid, of length 1 */
    int cell[3];
    double radius; /* m: of its farthest vertex */
};

/* A closed side of a block. */
struct closed_side {
    int block;
    int64_t first, n; /* of its faces */
    double min[3], max[3];
};

struct block_walls {
    int dim, nsides;
    struct closed_side side[6 * MESH_BLOCKS_MAX];
    struct face *face;
};

/* Face of the cell `at' on the side along a, and the box around it. The normal is the cross product
 * of the sums of opposite edges, turned towards the cell's centre; radius bounds the face for
 * find_face. */
static void add_face(const struct mesh_block *b, int dim, int a, bool upper, const int *at,
                     struct face *f, struct closed_side *s)
{
    const int t0 = (a + 1) % dim, t1 = dim == 3 ? (a + 2) % 3 : 2, corners = dim == 3 ? 4 : 2;
    double v[4][3], e[2][3], in[3];
    *f = (struct face){.cell = {at[0], at[1], at[2]}};
    for (int k = 0; k < corners; k++) {
        int i[3] = {at[0], at[1], at[2]};
        i[a] += upper;
        i[t0] += k & 1;
        i[t1] += k >> 1;
        memcpy(v[k], b->x[mesh_vertex(b, i[0], i[1], i[2])], sizeof v[k]);
        for (int q = 0; q < dim; q++) {
            f->x[q] += v[k][q] / corners;
            s->min[q] = fmin(s->min[q], v[k][q]);
            s->max[q] = fmax(s->max[q], v[k][q]);
        }
    }
    for (int q = 0; q < 3; q++) {
        e[0][q] = v[1][q] - v[0][q] + (dim == 3 ? v[3][q] - v[2][q] : 0.0);
        e[1][q] = dim == 3 ? v[2][q] + v[3][q] - v[0][q] - v[1][q] : q == 2;
        in[q] = q < dim ? b->centre[mesh_cell(b, at)][q] - f->x[q] : 0.0;
    }
    vec3_cross(e[0], e[1], f->n);
    const double size = copysign(vec3_length(f->n), vec3_dot(f->n, in));
    for (int q = 0; q < 3; q++)
        f->n[q] /= size;
    for (int k = 0; k < corners; k++)
        f->radius = fmax(f->radius, dim == 3 ? vec3_distance(v[k], f->x)
                                             : hypot(v[k][0] - f->x[0], v[k][1] - f->x[1]));
}

/* Faces run over the first tangent fastest. */
static void add_side(struct block_walls *w, const struct mesh *m, int block, int k)
{
    const struct mesh_block *b = m->block + block;
    const int a = k / 2, t0 = a == 0 ? 1 : 0, t1 = a == 2 ? 1 : 2;
    struct closed_side *s = w->side + w->nsides;
    *s = (struct closed_side){.block = block,
                              .first = w->nsides ? s[-1].first + s[-1].n : 0,
                              .n = (int64_t)b->n[t0] * (w->dim == 3 ? b->n[t1] : 1),
                              .min = {INFINITY, INFINITY, INFINITY},
                              .max = {-INFINITY, -INFINITY, -INFINITY}};
    ROOM_IN(w, w->face, s->first + s->n);
    for (int64_t i = 0; i < s->n; i++) {
        int at[3] = {0, 0, 0};
        at[a] = k % 2 ? b->n[a] - 1 : 0;
        at[t0] = (int)(i % b->n[t0]);
        if (w->dim == 3)
            at[t1] = (int)(i / b->n[t0]);
        add_face(b, w->dim, a, k % 2, at, w->face + s->first + i, s);
    }
    w->nsides++;
}

/* All sides behind which nothing is computed, openings included. */
struct block_walls *block_walls_create(const struct mesh *m)
{
    struct block_walls *w = NEW(struct block_walls, 1);
    w->dim = m->dim;
    for (int q = 0; q < m->nblocks; q++)
        for (int k = 0; k < 2 * m->dim; k++)
            if (side_is_end(m->block[q].side[k]))
                add_side(w, m, q, k);
    return w;
}

/* m: from x to the box around a side. */
static double beyond(const struct block_walls *w, const struct closed_side *s, const double *x)
{
    double d2 = 0.0;
    for (int a = 0; a < w->dim; a++) {
        const double d = fmax(fmax(s->min[a] - x[a], x[a] - s->max[a]), 0.0);
        d2 += d * d;
    }
    return sqrt(d2);
}

/* The face of a side with its middle nearest to x, less than R m away; NULL: none. *d2: its
 * distance, squared. */
static const struct face *nearest(const struct block_walls *w, const struct closed_side *s,
                                  double R, const double *x, double *d2)
{
    const struct face *best = NULL;
    *d2 = INFINITY;
    if (!(beyond(w, s, x) < R))
        return NULL;
    for (int64_t i = 0; i < s->n; i++) {
        const struct face *f = w->face + s->first + i;
        double d[3];
        vec3_from(f->x, x, d);
        const double d2_here = vec3_dot(d, d);
        if (d2_here < *d2) {
            *d2 = d2_here;
            best = f;
        }
    }
    return best;
}

/* m: of x over a face, < 0: behind it. */
static double height(const struct face *f, const double *x)
{
    double d[3];
    vec3_from(f->x, x, d);
    return vec3_dot(d, f->n);
}

/* The face of a side that x stands over, less than R from it; NULL: none. *off: how far the foot
 * lies from its middle, of its radius. 1.5 radii: beyond the edge of a side there is no wall over
 * which x stands. */
static const struct face *find_face(const struct block_walls *w, const struct closed_side *s,
                                    double R, const double *x, double *off)
{
    double d2;
    const struct face *best = nearest(w, s, R, x, &d2);
    if (!best)
        return NULL;
    const double high = height(best, x);
    *off = sqrt(fmax(0.0, d2 - high * high)) / best->radius;
    return fabs(high) < R && *off < 1.5 ? best : NULL;
}

/* By the distance of the faces' middles. */
bool block_walls_nearest(const struct block_walls *w, const double *x, struct nearest_wall *to)
{
    double least = INFINITY, d2;
    for (int k = 0; k < w->nsides; k++) {
        const struct face *f = nearest(w, w->side + k, sqrt(least), x, &d2);
        if (!f || d2 >= least)
            continue;
        least = d2;
        *to = (struct nearest_wall){.block = w->side[k].block,
                                    .cell = {f->cell[0], f->cell[1], f->cell[2]},
                                    .height = height(f, x),
                                    .radius = f->radius};
    }
    return least < INFINITY;
}

/* i counts through all sides in turn. */
bool block_walls_face(const struct block_walls *w, int64_t i, struct wall_face *to)
{
    int k = 0;
    while (k < w->nsides && i >= w->side[k].first + w->side[k].n)
        k++;
    if (k == w->nsides)
        return false;
    const struct face *f = w->face + i;
    *to = (struct wall_face){.block = w->side[k].block, .radius = f->radius};
    memcpy(to->cell, f->cell, sizeof to->cell);
    memcpy(to->x, f->x, sizeof to->x);
    return true;
}

/* Walls of two blocks that go on into each other are one: the nearer face is its own. Faces whose
 * normals are less than 60 degrees apart (cosine above 0.5) count as one wall. Returns the new
 * number. */
static int add_wall(const struct face *f, double off, int n, const struct face **wall, double *offs)
{
    for (int k = 0; k < n; k++)
        if (vec3_dot(f->n, wall[k]->n) > 0.5) {
            if (off < offs[k]) {
                wall[k] = f;
                offs[k] = off;
            }
            return n;
        }
    if (n == WALLS_MOST)
        return n;
    wall[n] = f;
    offs[n] = off;
    return n + 1;
}

/* Images are mirrored in one wall after the other, so that n walls in a corner give 2^n points. */
int block_walls_images(const struct block_walls *w, double R, double (*x)[3])
{
    const struct face *wall[WALLS_MOST];
    double offs[WALLS_MOST], off;
    int nwalls = 0, n = 1;
    for (int k = 0; k < w->nsides; k++) {
        const struct face *f = find_face(w, w->side + k, R, x[0], &off);
        if (f)
            nwalls = add_wall(f, off, nwalls, wall, offs);
    }
    for (int q = 0; q < nwalls; q++)
        for (int k = 0, before = n; k < before; k++, n++) {
            memcpy(x[n], x[k], sizeof x[n]);
            vec3_add(x[n], -2.0 * height(wall[q], x[k]), wall[q]->n);
        }
    return n;
}

/* block_flow.c - what crosses the section of a discharge gauge on blocks that stay where they are
 * and do not overlap, by the faces of cells: as on uniform cells (even_probes.c) a section has the
 * discharge of what flows into and out of the scene. The section is parted where it goes from cell
 * to cell; within one the flow along each index changes linearly from face to face, so that the
 * velocity is the sum of F_a dx/dxi_a over the map's Jacobian.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_output.h"

#include <math.h>
#include <stdlib.h>

#include "../../common/base/base.h"
#include "../../common/scene/scene.h"
#include "../surface/fv_surface.h"
#include "output.h"
#include "probe_flow.h"

enum { LOOKS = 400, HALVINGS = 40 };

/* A place in the blocks; block -1: in none. */
struct section_place {
    int block, cell[3];
    double xi[3];
};

static struct section_place locate(const struct fv *s, const double *x)
{
    struct section_place p = {.block = -1};
    for (int k = 0; k < s->m->nblocks && p.block < 0; k++)
        if (overset_locate(s->m, s->output->search, k, x, p.cell, p.xi))
            p.block = k;
    return p;
}

/* The straight way along a tangent of a section, through the middle of the other one. */
struct section_way {
    double from[3], along[3], length;
};

static struct section_place place_on(const struct fv *s, const struct section_way *l, double at)
{
    double x[3];
    for (int a = 0; a < 3; a++)
        x[a] = l->from[a] + at * l->along[a];
    return locate(s, x);
}

static void add_end(struct flow_ends *e, double at)
{
    ROOM_IN(NULL, e->end, e->n + 2);
    e->end[++e->n] = at;
}

/* Where the way leaves the block, or what is none, that it is in at `in' and not at `out'. */
static double edge_of(const struct fv *s, const struct section_way *l, int block, double in,
                      double out)
{
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (in + out);
        *(place_on(s, l, middle).block == block ? &in : &out) = middle;
    }
    return 0.5 * (in + out);
}

/* Faces between two places of a block, between which its indices change linearly. */
static void add_faces(struct flow_ends *e, int dim, const struct section_place *p,
                      const struct section_place *q, double at, double step)
{
    for (int a = 0; a < dim; a++) {
        const double x = p->cell[a] + p->xi[a], way = q->cell[a] + q->xi[a] - x;
        if (fabs(way) < 1e-6) /* along faces */
            continue;
        for (double face = ceil(fmin(x, x + way)); face <= fmax(x, x + way); face++)
            add_end(e, at + step * (face - x) / way);
    }
}

/* Where the section goes from cell to cell along tangent k. */
static struct flow_ends ends_of(const struct fv *s, const struct scene_probe *g,
                                const struct probe_section *c, int k)
{
    const double step = c->length[k] / LOOKS;
    struct flow_ends e = {0, NEW(double, 1)};
    struct section_way l = {.length = c->length[k]};
    for (int a = 0; a < s->dim; a++) {
        l.along[a] = c->along[k][a];
        l.from[a] = g->at[a] + (c->n > 1 ? 0.5 * c->length[1 - k] * c->along[1 - k][a] : 0.0);
    }
    struct section_place p = place_on(s, &l, 0.0);
    for (int i = 1; i <= LOOKS; i++) {
        const struct section_place q = place_on(s, &l, i * step);
        if (p.block == q.block && p.block >= 0)
            add_faces(&e, s->dim, &p, &q, (i - 1) * step, step);
        if (p.block != q.block) {
            add_end(&e, edge_of(s, &l, p.block, (i - 1) * step, i * step));
            add_end(&e, edge_of(s, &l, q.block, i * step, (i - 1) * step));
        }
        p = q;
    }
    add_end(&e, c->length[k]);
    qsort(e.end, (size_t)e.n + 1, sizeof *e.end, lookup_ascending);
    return e;
}

/* Adds the part of the section at p, if its cell is this rank's: weights of its faces. */
static void add_part(const struct fv *s, struct face_weights *w, const struct section_place *p,
                     const double *across, double area)
{
    int rank;
    int64_t cell;
    double x[3], dx[3][3];
    mesh_owner(s->m, p->block, p->cell, &rank, &cell);
    if (rank != s->m->rank)
        return;
    mesh_map_point(s->m->block + p->block, s->dim, p->cell, p->xi, x, dx);
    ROOM_IN(s->output, w->of, w->n + 1);
    struct face_weight *to = w->of + w->n++;
    to->cell = cell;
    for (int a = 0; a < s->dim; a++) {
        const double all = area * vec3_dot(across, dx[a]) / mesh_determinant(dx);
        to->weight[a][0] = (1.0 - p->xi[a]) * all;
        to->weight[a][1] = p->xi[a] * all;
    }
}

/* Those of a gauge, made once. */
static const struct face_weights *weights_of(const struct fv *s, int gauge,
                                             const struct scene_probe *g)
{
    struct face_weights *w = s->output->faces + gauge;
    if (w->is_made)
        return w;
    const struct probe_section c = probe_section_of(g, s->dim);
    struct flow_ends of[2] = {{0, NULL}, {0, NULL}};
    for (int k = 0; k < c.n; k++)
        of[k] = ends_of(s, g, &c, k);
    struct flow_samples f = flow_samples_between(s->dim, g, &c, of);
    FREE(of[0].end, of[1].end);
    for (int k = 0; k < f.n; k++) {
        const struct section_place p = locate(s, f.x[k]);
        if (p.block >= 0)
            add_part(s, w, &p, f.across, f.area[k]);
    }
    flow_samples_free(&f);
    w->is_made = true;
    return w;
}

double block_flow(const struct fv *s, int gauge, const struct scene_probe *g, double *const flow[3])
{
    const struct face_weights *w = weights_of(s, gauge, g);
    double sum = 0.0;
    for (int k = 0; k < w->n; k++) {
        const struct face_weight *x = w->of + k;
        const struct part *p = grid_part(&s->grid, x->cell, NULL);
        for (int a = 0; a < s->dim; a++)
            sum += x->weight[a][0] * flow[a][x->cell] +
                   x->weight[a][1] * flow[a][x->cell + p->stride[a]];
    }
    return sum;
}

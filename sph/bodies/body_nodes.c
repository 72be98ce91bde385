/* body_nodes.c - the points of a body's surface at which it is asked what is around it: the middles
 * of pieces of its segments or triangles. In 3D those of one small cube that look the same way are
 * one, for facets may be slivers, thousands of points where some tens will do.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "body_nodes.h"

/* Pointers to earlier nodes do not outlive it. */
static struct average_node *add_node(struct nodes *to)
{
    ROOM_IN(NULL, to->node, to->n + 1);
    struct average_node *d = to->node + to->n++;
    memset(d, 0, sizeof *d);
    return d;
}

/* Half a spacing of the finest level, m. */
static double distance_of_nodes(const struct sph *s)
{
    while (s->finer)
        s = s->finer;
    return 0.5 * s->dx;
}

static void lay_segment(const struct sph *s, const struct segment *g, struct nodes *to)
{
    const int pieces = (int)ceil(g->length / distance_of_nodes(s));
    for (int i = 0; i < pieces; i++) {
        struct average_node *d = add_node(to);
        for (int a = 0; a < 2; a++) {
            d->x[a] = g->a[a] + (i + 0.5) / pieces * g->length * g->t[a];
            d->n[a] = g->n[a];
        }
        d->area = g->length / pieces;
        d->no_slip = g->no_slip;
        walls_velocity(s->walls, g, d->x, d->u, d->du);
    }
}

/* Halved across its longest edge until that is short enough; a node in the middle of each part, in
 * the axes of the mesh. */
static void lay_part(const double *const v[3], const double *n, double most, struct nodes *to)
{
    double e[3][3], length[3];
    for (int i = 0; i < 3; i++) {
        vec3_from(v[i], v[(i + 1) % 3], e[i]);
        length[i] = vec3_length(e[i]);
    }
    const int first = length[0] >= length[1] ? 0 : 1, a = length[first] >= length[2] ? first : 2;
    if (length[a] > most) {
        const double *const before = v[(a + 1) % 3], *const apex = v[(a + 2) % 3];
        double mid[3];
        for (int c = 0; c < 3; c++)
            mid[c] = v[a][c] + 0.5 * e[a][c];
        lay_part((const double *const[3]){v[a], mid, apex}, n, most, to);
        lay_part((const double *const[3]){mid, before, apex}, n, most, to);
        return;
    }
    struct average_node *d = add_node(to);
    double twice[3];
    for (int c = 0; c < 3; c++)
        d->x[c] = (v[0][c] + v[1][c] + v[2][c]) / 3.0;
    memcpy(d->n, n, sizeof d->n);
    vec3_cross(e[0], e[1], twice);
    d->area = 0.5 * vec3_length(twice);
}

/* --- points that are one --- */

struct sorted {
    uint64_t key;
    int node;
};

/* Of equal keys by number, so that sums have one order on all machines. */
static int by_key(const void *a, const void *b)
{
    const struct sorted *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key) : x->node - y->node;
}

/* Cube of this width, m, that a point is in, and which way it looks: each component of the normal
 * in quarters. */
static uint64_t key_of(const struct average_node *d, double width)
{
    uint64_t key = 0;
    for (int a = 0; a < 3; a++)
        key = (key << 17) | ((uint64_t)(int64_t)floor(d->x[a] / width + 0.37) & 0x1ffff);
    for (int a = 0; a < 3; a++)
        key = (key << 4) | (uint64_t)floor(4.0 * (d->n[a] + 1.0) + 0.5);
    return key;
}

/* Adds a point to one that stands for several: sums weighted by area. */
static void add_to(struct average_node *sum, const struct average_node *d)
{
    for (int a = 0; a < 3; a++) {
        sum->x[a] += d->area * d->x[a];
        sum->n[a] += d->area * d->n[a];
    }
    sum->area += d->area;
}

/* Points of one cube that look the same way become one, in their middle. Area times normal keeps
 * its vector sum, so that a closed surface stays closed. */
static void merge(struct nodes *of, double width)
{
    struct sorted *sorted = NEW(struct sorted, of->n);
    struct average_node *to = NEW(struct average_node, of->n);
    int n = 0;
    for (int k = 0; k < of->n; k++)
        sorted[k] = (struct sorted){key_of(of->node + k, width), k};
    qsort(sorted, (size_t)of->n, sizeof *sorted, by_key);
    for (int k = 0; k < of->n; k++) {
        n += k == 0 || sorted[k].key != sorted[k - 1].key;
        add_to(to + n - 1, of->node + sorted[k].node);
    }
    for (int k = 0; k < n; k++) {
        for (int a = 0; a < 3; a++)
            to[k].x[a] /= to[k].area;
        to[k].area = vec3_unit(to[k].n);
    }
    FREE(sorted, of->node);
    *of = (struct nodes){.n = n, .node = to};
}

/* The points of a mesh where it is now. */
static void lay_mesh(const struct sph *s, const struct wall_mesh *m, struct nodes *to)
{
    const double most = distance_of_nodes(s);
    struct nodes own = {.n = 0};
    for (int t = 0; t < m->mesh.ntriangles; t++) {
        const int *v = m->mesh.vertex[t];
        double n[3];
        if (trimesh_normal(&m->mesh, t, n) > 0.0)
            lay_part((const double *const[3]){m->mesh.x[v[0]], m->mesh.x[v[1]], m->mesh.x[v[2]]}, n,
                     most, &own);
    }
    merge(&own, most);
    for (int k = 0; k < own.n; k++) {
        struct average_node *d = add_node(to);
        wall_mesh_to_world(m, own.node[k].x, d->x);
        wall_mesh_turn_to_world(m, own.node[k].n, d->n);
        d->area = own.node[k].area;
        d->no_slip = m->no_slip;
        wall_mesh_velocity(s->walls, m, d->x, d->u, d->du);
    }
    mem_free(own.node);
}

/* Images across periods are left out: their particles are asked for as images. */
struct nodes body_nodes_lay(const struct sph *s, int body)
{
    const struct walls *w = s->walls;
    const struct body *b = w->bodies + body;
    struct nodes to = {.n = 0};
    for (int k = b->first; s->dim == 2 && k < b->first + b->n; k++)
        lay_segment(s, w->segments + k, &to);
    for (int k = 0; k < w->nmeshes; k++)
        if (w->meshes[k].body == body && !w->meshes[k].image)
            lay_mesh(s, w->meshes + k, &to);
    return to;
}

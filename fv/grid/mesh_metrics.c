/* mesh_metrics.c - face vectors, volumes and the metric tensor on the faces of the local parts.
 * Face vectors telescope: in 2D they are differences of vertices, in 3D sums over edges of 1/2 int
 * x cross dx, each edge the cubic through its line of vertices. So the six of a cell sum to zero
 * and a uniform flow stays. All are averages over faces or cells by Gauss points of the smooth map
 * (mesh_map_point), fourth order. Of blocks that move they are made where the case puts the block,
 * and turned afterwards (mesh_motion.c).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>

#include "mesh.h"

static const double gauss2[2] = {0.2113248654051871, 0.7886751345948129};
static const double gauss3[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
static const double weight3[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/* Position of vertex i. */
static const double *vertex(const struct mesh_block *b, const int *i)
{
    return b->x[mesh_vertex(b, i[0], i[1], i[2])];
}

/* Places and slopes on the edge from vertex i on along axis a at three Gauss points, o the origin.
 * Four vertices along the line; at the outermost ones the last is repeated. */
static void edge_points(const struct mesh_block *b, const int *i, int a, const double *o,
                        double x[3][3], double dx[3][3])
{
    int at[3] = {i[0], i[1], i[2]};
    const double *v[4];
    for (int m = 0; m < 4; m++) {
        const int most = b->v0[a] + b->nv[a] - 1;
        at[a] = i[a] - 1 + m;
        at[a] = at[a] < b->v0[a] ? b->v0[a] : at[a] > most ? most : at[a];
        v[m] = vertex(b, at);
    }
    for (int g = 0; g < 3; g++) {
        const double s = gauss3[g];
        const double w[4] = {-s * (s - 1.0) * (s - 2.0) / 6.0,
                             (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
                             -(s + 1.0) * s * (s - 2.0) / 2.0, (s + 1.0) * s * (s - 1.0) / 6.0};
        const double d[4] = {-(3.0 * s * s - 6.0 * s + 2.0) / 6.0,
                             (3.0 * s * s - 4.0 * s - 1.0) / 2.0,
                             -(3.0 * s * s - 2.0 * s - 2.0) / 2.0, (3.0 * s * s - 1.0) / 6.0};
        for (int c = 0; c < 3; c++) {
            x[g][c] = dx[g][c] = 0.0;
            for (int m = 0; m < 4; m++) {
                x[g][c] += w[m] * (v[m][c] - o[c]);
                dx[g][c] += d[m] * v[m][c];
            }
        }
    }
}

/* 1/2 int (x - o) cross dx along the edge from vertex i on along axis a. The origin is the block's
 * first vertex, which keeps rounding small. */
static void edge(const struct mesh_block *b, const int *i, int a, double *e)
{
    double x[3][3], dx[3][3];
    edge_points(b, i, a, vertex(b, (int[3]){0, 0, 0}), x, dx);
    e[0] = e[1] = e[2] = 0.0;
    for (int g = 0; g < 3; g++)
        for (int c = 0; c < 3; c++) {
            const int p = (c + 1) % 3, q = (c + 2) % 3;
            e[c] += 0.5 * weight3[g] * (x[g][p] * dx[g][q] - x[g][q] * dx[g][p]);
        }
}

/* e += sign times 1/2 int |x - o|^2 dx along an edge. */
static void add_edge_moment(const struct mesh_block *b, const int *i, int a, const double *o,
                            double sign, double *e)
{
    double x[3][3], dx[3][3];
    edge_points(b, i, a, o, x, dx);
    for (int g = 0; g < 3; g++) {
        const double r2 = x[g][0] * x[g][0] + x[g][1] * x[g][1] + x[g][2] * x[g][2];
        for (int c = 0; c < 3; c++)
            e[c] += sign * 0.5 * weight3[g] * r2 * dx[g][c];
    }
}

/* |x - o|^2/2 in the plane. */
static double half_square(const double *x, const double *o)
{
    return 0.5 * ((x[0] - o[0]) * (x[0] - o[0]) + (x[1] - o[1]) * (x[1] - o[1]));
}

/* Integral of r cross dS over the lower face along a, r = x - o: by Stokes' theorem it is - int 1/2
 * |r|^2 dx around the face, a sum over edges that telescopes as the face vectors do. In 2D only the
 * third component, from both ends. */
void mesh_face_moment(const struct mesh_block *b, int dim, const int *i, int a, const double *o,
                      double *R)
{
    int up[3] = {i[0], i[1], i[2]};
    R[0] = R[1] = R[2] = 0.0;
    if (dim == 2) {
        up[1 - a]++;
        R[2] = half_square(vertex(b, i), o) - half_square(vertex(b, up), o);
        R[2] = a == 0 ? R[2] : -R[2];
        return;
    }
    const int p = (a + 1) % 3, q = (a + 2) % 3;
    add_edge_moment(b, i, p, o, -1.0, R);
    add_edge_moment(b, i, q, o, 1.0, R);
    up[p]++;
    add_edge_moment(b, up, q, o, -1.0, R);
    up[p]--;
    up[q]++;
    add_edge_moment(b, up, p, o, 1.0, R);
}

/* Vector of the lower face along a of cell i. By vertices in 2D; in 3D the edges around the face in
 * the sense that makes S point along a. */
static void face_vector(const struct mesh_block *b, int dim, const int *i, int a, double *S)
{
    int up[3] = {i[0], i[1], i[2]};
    S[0] = S[1] = S[2] = 0.0;
    if (dim == 2) {
        up[1 - a]++;
        const double *x = vertex(b, i), *y = vertex(b, up);
        S[0] = a == 0 ? y[1] - x[1] : x[1] - y[1];
        S[1] = a == 0 ? x[0] - y[0] : y[0] - x[0];
        return;
    }
    const int p = (a + 1) % 3, q = (a + 2) % 3;
    double e[4][3];
    edge(b, i, p, e[0]);
    edge(b, i, q, e[3]);
    up[p]++;
    edge(b, up, q, e[1]);
    up[p]--;
    up[q]++;
    edge(b, up, p, e[2]);
    for (int c = 0; c < 3; c++)
        S[c] = e[0][c] + e[1][c] - e[2][c] - e[3][c];
}

/* S_a.S_b/J averaged over the lower face along a: slopes from the maps of both sides. Two Gauss
 * points a tangent. Entries below 1e-12 of the largest are rounding and become 0, so that upright
 * cells are recognised. */
static void face_tensor(const struct mesh_block *b, int dim, const int *i, int a, double *G)
{
    int below[3] = {i[0], i[1], i[2]}, t[2] = {2, 2}, nt = 0;
    below[a]--;
    for (int k = 0; k < dim; k++)
        if (k != a)
            t[nt++] = k;
    G[0] = G[1] = G[2] = 0.0;
    for (int g = 0; g < (nt == 2 ? 4 : 2); g++) {
        double xi[3] = {0.0, 0.0, 0.0}, x[3], d[3][3], e[3][3], S[3][3];
        xi[t[0]] = gauss2[g & 1];
        if (nt == 2)
            xi[t[1]] = gauss2[g >> 1];
        mesh_map_point(b, dim, i, xi, x, d);
        xi[a] = 1.0;
        mesh_map_point(b, dim, below, xi, x, e);
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++)
                d[k][c] = 0.5 * (d[k][c] + e[k][c]);
        vec3_cofactors(d, S); /* vectors of the faces of a unit of index, S_a . dx_b = J delta_ab */
        const double w = 1.0 / ((nt == 2 ? 4.0 : 2.0) * mesh_determinant(d));
        for (int k = 0; k < dim; k++)
            for (int c = 0; c < dim; c++)
                G[k] += w * S[a][c] * S[k][c];
    }
    double most = 0.0;
    for (int k = 0; k < dim; k++)
        most = fmax(most, fabs(G[k]));
    for (int k = 0; k < dim; k++)
        if (fabs(G[k]) < 1e-12 * most)
            G[k] = 0.0;
}

/* Three Gauss points an index: integral of the determinant. */
static double volume(const struct mesh_block *b, int dim, const int *i)
{
    double v = 0.0;
    for (int g = 0; g < (dim == 3 ? 27 : 9); g++) {
        const int q[3] = {g % 3, g / 3 % 3, g / 9};
        double x[3], d[3][3];
        mesh_map_point(b, dim, i, (double[3]){gauss3[q[0]], gauss3[q[1]], gauss3[q[2]]}, x, d);
        v += weight3[q[0]] * weight3[q[1]] * (dim == 3 ? weight3[q[2]] : 1.0) * mesh_determinant(d);
    }
    return v;
}

/* --- cells of a line that are alike --- */

enum { BELOW = 2 }; /* vertices that V and G of a cell take below its own, and above */

/* Whether all edges from vertex m to the next along the first index that cells (., j, k) take are
 * e. */
static bool edges_are(const struct mesh_block *b, int dim, int m, int j, int k, const double *e,
                      double rounding)
{
    const int deep = dim == 3 ? BELOW : 0;
    double off = 0.0;
    for (int q = k - deep; q <= k + deep; q++)
        for (int r = j - BELOW; r <= j + BELOW; r++) {
            const double *x = b->x[mesh_vertex(b, m, r, q)], *y = b->x[mesh_vertex(b, m + 1, r, q)];
            for (int c = 0; c < dim; c++)
                off = fmax(off, fabs(y[c] - x[c] - e[c]));
        }
    return off <= rounding;
}

/* Of cells least to most of the line (., j, k) of a block the first of those in a row whose V and G
 * are the same: all edges along the line that they take are equal. On any number of ranks. */
static void find_alike(const struct mesh_block *b, int dim, int j, int k, double rounding,
                       int least, int most, int *first)
{
    int from = most + BELOW; /* edge from which on all are e */
    double e[3];
    for (int m = least - BELOW; m < most + BELOW; m++) {
        if (from > m || !edges_are(b, dim, m, j, k, e, rounding)) {
            const double *x = b->x[mesh_vertex(b, m, j, k)], *y = b->x[mesh_vertex(b, m + 1, j, k)];
            for (int c = 0; c < dim; c++)
                e[c] = y[c] - x[c];
            from = edges_are(b, dim, m, j, k, e, rounding) ? m : most + BELOW;
        }
        const int i = m + 1 - BELOW; /* the cell whose last edge this is */
        if (i >= least)
            first[i - least] = from + BELOW <= i ? from + BELOW : i;
    }
}

/* m: what rounding makes of a difference of vertices. */
static double rounding_of(const struct mesh_block *b)
{
    const int64_t n = (int64_t)b->nv[0] * b->nv[1] * b->nv[2];
    double most = 0.0;
    for (int64_t v = 0; v < n; v++)
        for (int c = 0; c < 3; c++)
            most = fmax(most, fabs(b->x[v][c]));
    return 8.0 * DBL_EPSILON * most;
}

/* V and G of a cell. */
struct cell_metrics {
    double V, G[3][3];
};

static struct cell_metrics metrics_of(const struct mesh_block *b, int dim, const int *at)
{
    struct cell_metrics x = {.V = volume(b, dim, at)};
    for (int a = 0; a < dim; a++)
        face_tensor(b, dim, at, a, x.G[a]);
    return x;
}

/* Those of a line of a part: S for all ghosts; G and V for all but the outermost layer at the low
 * end, which has G = 0 and V = 1. */
static void line_metrics(struct mesh *m, const struct part *p, int j, int k, double rounding,
                         int *first)
{
    const struct mesh_block *b = m->block[p->block].made;
    const int G = MESH_GHOSTS, least = 1 - G, most = b->n[0] + G - 1;
    int at[3] = {0, p->lo[1] + j, p->lo[2] + k}, made = most + 1;
    struct cell_metrics x = {.V = 1.0};
    bool near = true;
    for (int a = 1; a < m->dim; a++)
        near = near && at[a] >= 1 - G && at[a] <= b->n[a] + G - 1;
    if (near)
        find_alike(b, m->dim, at[1], at[2], rounding, least, most, first);
    for (int i = -p->g[0]; i < p->n[0] + p->g[0]; i++) {
        const int64_t c = part_at(p, i, j, k);
        at[0] = p->lo[0] + i;
        const int like = near && at[0] >= least && at[0] <= most ? first[at[0] - least] : most + 1;
        if (like > most)
            x = (struct cell_metrics){.V = 1.0};
        else if (like != made)
            x = metrics_of(b, m->dim, (const int[]){like, at[1], at[2]});
        made = like;
        m->V[c] = x.V;
        for (int a = 0; a < m->dim; a++) {
            double S[3];
            face_vector(b, m->dim, at, a, S);
            for (int q = 0; q < m->dim; q++) {
                m->S[a][q][c] = S[q];
                m->G[a][q][c] = x.G[a][q];
            }
        }
    }
}

static void part_metrics(struct mesh *m, const struct part *p)
{
    const struct mesh_block *b = m->block[p->block].made;
    const double rounding = rounding_of(b);
    int *first = NEW(int, b->n[0] + 2 * MESH_GHOSTS);
    for (int k = -p->g[2]; k < p->n[2] + p->g[2]; k++)
        for (int j = -p->g[1]; j < p->n[1] + p->g[1]; j++)
            line_metrics(m, p, j, k, rounding, first);
    mem_free(first);
}

/* 1 or 0 for each lower face; imposed cells close theirs afterwards (mesh_given_close). */
void mesh_open_faces(struct mesh *m)
{
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        const struct mesh_block *b = m->block + p->block;
        for (int64_t c = p->base; c < p->base + p->size; c++) {
            int at[3];
            part_index(p, c, at);
            for (int a = 0; a < m->dim; a++) {
                const int i = p->lo[a] + at[a];
                m->open[a][c] = (i == 0 && side_gives_flux(b->side[2 * a])) ||
                                        (i == b->n[a] && side_gives_flux(b->side[2 * a + 1]))
                                    ? 0.0
                                    : 1.0;
            }
        }
    }
}

/* What the metrics of a cell and its lower faces make it: the first cell's box, another upright
 * one, neither. 1e-10 of the size is beyond rounding and far below any real difference. */
static enum part_kind kind_of_cell(const struct mesh *m, int64_t first, int64_t c)
{
    bool like = fabs(m->V[c] - m->V[first]) < 1e-10 * m->V[first], upright = true;
    for (int a = 0; a < m->dim; a++)
        for (int k = 0; k < m->dim; k++) {
            const double S = m->S[a][a][first], G = m->G[a][a][first];
            upright = upright && m->S[a][a][c] > 0.0 &&
                      (k == a || (fabs(m->S[a][k][c]) < 1e-10 * m->S[a][a][c] &&
                                  fabs(m->G[a][k][c]) < 1e-10 * m->G[a][a][c]));
            like = like && (k != a || (fabs(m->S[a][a][c] - S) < 1e-10 * S &&
                                       fabs(m->G[a][a][c] - G) < 1e-10 * G));
        }
    return !upright ? PART_CURVED : like ? PART_EVEN : PART_UPRIGHT;
}

/* By the metrics, not by the mapping: joined to other cells the places between vertices bend.
 * Ghosts as far as stencils read them count, too. */
static enum part_kind kind_of(const struct mesh *m, const struct part *p)
{
    enum part_kind kind = PART_EVEN;
    int down[3], up[3];
    for (int a = 0; a < 3; a++) {
        down[a] = a < m->dim;
        up[a] = 2 * (a < m->dim);
    }
    PART_ROWS (p, down, up, c, n)
        for (int64_t i = c; i < c + n; i++) {
            const enum part_kind one = kind_of_cell(m, part_at(p, 0, 0, 0), i);
            kind = one < kind ? one : kind;
        }
    return kind;
}

/* Allocates and fills open, S, G and V, and sets the kind of each part. */
void mesh_metrics(struct mesh *m)
{
    for (int a = 0; a < m->dim; a++) {
        m->open[a] = mem_own(m, mesh_field(m));
        for (int k = 0; k < m->dim; k++) {
            m->S[a][k] = mem_own(m, mesh_field(m));
            m->G[a][k] = mem_own(m, mesh_field(m));
        }
    }
    m->V = mem_own(m, mesh_field(m));
    for (int k = 0; k < m->nparts; k++) {
        part_metrics(m, m->part + k);
        m->part[k].kind = kind_of(m, m->part + k);
    }
    mesh_open_faces(m);
}

double mesh_least_height(const struct mesh *m, enum mesh_status status)
{
    double least = INFINITY;
    for (int q = 0; q < m->nparts; q++)
        PART_ROWS (m->part + q, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                for (int a = 0; a < m->dim && m->status[i] == status; a++)
                    least = fmin(least, m->V[i] / sqrt(mesh_area2(m, a, i)));
    return ranks_min(m->comm, least);
}

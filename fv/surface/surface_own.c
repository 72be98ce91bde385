/* surface_own.c - volumes that count once where blocks overlap: of each computed cell what no later
 * block computes. In 2D exactly, by clipping cells with straight edges, and with them the water in
 * the cells that are shared: as blocks move, their sum changes by no more than rounding. In 3D from
 * points within the cell. SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"
#include "mesh_view.h"

#include "../grid/fv_grid.h"

/* --- polygons: convex, counter-clockwise --- */

static double area_of(const struct polygon *p)
{
    double sum = 0.0;
    for (int k = 1; k + 1 < p->n; k++)
        sum += (p->x[k][0] - p->x[0][0]) * (p->x[k + 1][1] - p->x[0][1]) -
               (p->x[k + 1][0] - p->x[0][0]) * (p->x[k][1] - p->x[0][1]);
    return 0.5 * sum;
}

/* Keeps what has n.x < d (Sutherland & Hodgman, Comm. ACM 17, 1974). */
static void clip(struct polygon *p, double n0, double n1, double d)
{
    struct polygon to = {0};
    for (int k = 0; k < p->n; k++) {
        const double *x = p->x[k], *y = p->x[(k + 1) % p->n];
        const double a = n0 * x[0] + n1 * x[1] - d, b = n0 * y[0] + n1 * y[1] - d;
        if (a < 0.0)
            memcpy(to.x[to.n++], x, sizeof to.x[0]);
        if ((a < 0.0) != (b < 0.0) && to.n < POLYGON_MOST) {
            const double t = a / (a - b);
            to.x[to.n][0] = x[0] + t * (y[0] - x[0]);
            to.x[to.n++][1] = x[1] + t * (y[1] - x[1]);
        }
        if (to.n >= POLYGON_MOST - 1)
            break;
    }
    *p = to;
}

/* p becomes what it has in common with q, both convex and counter-clockwise. */
static void clip_by(struct polygon *p, const struct polygon *q)
{
    for (int k = 0; k < q->n && p->n > 0; k++) {
        const double *x = q->x[k], *y = q->x[(k + 1) % q->n];
        const double n0 = y[1] - x[1], n1 = x[0] - y[0];
        clip(p, n0, n1, n0 * x[0] + n1 * x[1]);
    }
}

static struct polygon cell_polygon(const struct mesh_block *b, const int *i)
{
    static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    struct polygon p = {.n = 4};
    for (int k = 0; k < 4; k++)
        memcpy(p.x[k], b->x[mesh_vertex(b, i[0] + corner[k][0], i[1] + corner[k][1], 0)],
               sizeof p.x[0]);
    return p;
}

/* Moves q by periods of the domain to where p is. */
static void move_to(const struct scene_domain *d, const struct polygon *p, struct polygon *q)
{
    for (int a = 0; a < 2; a++) {
        const double L = d->max[a] - d->min[a],
                     n = d->periodic[a] ? round((p->x[0][a] - q->x[0][a]) / L) : 0.0;
        for (int k = 0; k < q->n && n != 0.0; k++)
            q->x[k][a] += n * L;
    }
}

/* --- what later blocks compute --- */

/* Point n of side^dim in a cell. */
static void point_of(const struct mesh *m, const struct part *p, const int *i, int side, int n,
                     double *x)
{
    const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
    const double xi[3] = {(n % side + 0.5) / side, (n / side % side + 0.5) / side,
                          m->dim == 3 ? (n / side / side + 0.5) / side : 0.5};
    double dx[3][3];
    mesh_map_point(m->block + p->block, m->dim, at, xi, x, dx);
}

static double share_of_points(const struct mesh *m, const struct overset *o, const struct part *p,
                              const int *i)
{
    const int side = m->dim == 3 ? 4 : 8, most = m->dim == 3 ? 64 : 64;
    int own = 0;
    for (int n = 0; n < most; n++) {
        double x[3];
        int block, cell[3];
        point_of(m, p, i, side, n, x);
        own += !overset_computed(m, o, p->block, x, &block, cell);
    }
    return (double)own / most;
}

/* Cells of later blocks that a cell meets, found from one to the next. */
struct meeting {
    int n;
    int (*cell)[4]; /* block, indices */
};

static void meet(struct meeting *w, int block, const int *i)
{
    for (int k = 0; k < w->n; k++)
        if (w->cell[k][0] == block && w->cell[k][1] == i[0] && w->cell[k][2] == i[1])
            return;
    ROOM_IN(NULL, w->cell, w->n + 1);
    memcpy(w->cell[w->n++], (const int[]){block, i[0], i[1], i[2]}, sizeof w->cell[0]);
}

static void add_piece(struct surface_mesh *w, const struct polygon *p)
{
    ROOM_IN(w, w->piece, w->npieces + 1);
    w->piece[w->npieces++] = *p;
}

/* Pieces of a cell that later blocks compute, into the list; false: such blocks overlap in it. */
static bool find_pieces(const struct fv *s, const struct overset *o, const struct part *p,
                        const int *i, const struct polygon *own, struct meeting *met)
{
    enum { SEEDS = 7 }; /* a side, a quarter of a cell apart, beyond the cell, too */
    const struct mesh *m = s->m;
    const double whole = area_of(own);
    double sum = 0.0;
    met->n = 0;
    for (int n = 0; n < SEEDS * SEEDS; n++) {
        const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], 0};
        const double xi[3] = {0.25 * (n % SEEDS - 1), 0.25 * (n / SEEDS - 1), 0.5};
        double x[3], dx[3][3];
        int block, cell[3];
        mesh_map_point(m->block + p->block, m->dim, at, xi, x, dx);
        if (overset_computed(m, o, p->block, x, &block, cell))
            meet(met, block, cell);
    }
    for (int k = 0; k < met->n; k++) {
        const struct mesh_block *b = m->block + met->cell[k][0];
        const int *at = met->cell[k] + 1;
        struct polygon q = cell_polygon(b, at), piece = *own;
        move_to(&s->run->scene.domain, own, &q);
        clip_by(&piece, &q);
        const double area = area_of(&piece);
        if (!(area > 1e-15 * whole))
            continue;
        if (b->status[mesh_cell(b, at)] == CELL_COMPUTED) {
            add_piece(s->surface->mesh, &piece);
            sum += area;
        }
        for (int side = 0; side < 4; side++) {
            int to = met->cell[k][0], next[3] = {at[0], at[1], at[2]};
            double move[3];
            next[side / 2] += side % 2 ? 1 : -1;
            if (mesh_resolve(m, &to, next, move) && to > p->block)
                meet(met, to, next);
            at = met->cell[k] + 1; /* the list may have moved */
        }
    }
    return sum <= (1.0 + 1e-6) * whole;
}

/* Whether later blocks have the centres of some of a cell and its neighbours, and not of others. */
static bool is_mixed(const struct part *p, int dim, int64_t c, const double *covered)
{
    const int deep = dim == 3 ? 1 : 0;
    for (int k = -deep; k <= deep; k++)
        for (int j = -1; j <= 1; j++)
            for (int i = -1; i <= 1; i++)
                if (covered[c + i + j * p->stride[1] + k * p->stride[2]] != covered[c])
                    return true;
    return false;
}

/* With one layer of ghosts, for is_mixed looks around. */
static void cover_centres(const struct fv *s, const struct overset *o, const struct part *p,
                          double *covered)
{
    const struct surface_mesh *w = s->surface->mesh;
    const int one[3] = {1, 1, s->dim == 3};
    PART_ROWS (p, one, one, c, n)
        for (int64_t at = c; at < c + n; at++) {
            int block, cell[3];
            covered[at] = overset_computed(s->m, o, p->block,
                                           (const double[]){w->x[0][at], w->x[1][at], w->x[2][at]},
                                           &block, cell);
        }
}

static void count_shared(struct fv *s, const struct overset *o, const struct part *p, const int *i,
                         int64_t c, struct meeting *met)
{
    struct surface_mesh *w = s->surface->mesh;
    struct shared_cell x = {.cell = c, .first = w->npieces};
    double sum = 0.0;
    if (s->dim == 3) {
        w->count[c] = s->m->V[c] * share_of_points(s->m, o, p, i);
        return;
    }
    x.own = cell_polygon(s->m->block + p->block,
                         (const int[]){p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]});
    if (!find_pieces(s, o, p, i, &x.own, met)) {
        w->npieces = x.first;
        w->count[c] = s->m->V[c] * share_of_points(s->m, o, p, i);
        return;
    }
    x.n = w->npieces - x.first;
    for (int64_t k = x.first; k < w->npieces; k++)
        sum += area_of(w->piece + k);
    w->count[c] = fmax(0.0, area_of(&x.own) - sum);
    if (x.n == 0)
        return;
    ROOM_IN(w, w->shared, w->nshared + 1);
    w->shared[w->nshared++] = x;
}

/* Where blocks overlap in 2D that between straight edges, or what they cut from each other would be
 * less than what they have. */
static double volume_of(const struct mesh *m, const struct part *p, const int *i, int64_t c)
{
    const int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]};
    if (m->dim == 3 || !m->has_fringe)
        return m->V[c];
    const struct polygon own = cell_polygon(m->block + p->block, at);
    return area_of(&own);
}

/* Cells in the box of a part that no later block's box meets are a block's own. */
static bool meets_later(const struct mesh *m, const struct part *p)
{
    return m->has_fringe && p->block < m->nblocks - 1;
}

void surface_mesh_count(struct fv *s)
{
    const struct mesh *m = s->m;
    struct surface_mesh *w = s->surface->mesh;
    struct overset *o = !m->has_fringe ? NULL : m->search ? m->search : overset_search(s->run, m);
    struct meeting met = {0};
    double *covered = s->surface->rate;
    w->nshared = w->npieces = 0;
    for (int q = 0; q < s->grid.nparts; q++) {
        const struct part *p = s->grid.part + q;
        const bool later = meets_later(m, p);
        int i[3];
        PART_CELLS (p, i, c)
            w->count[c] = m->status[c] == CELL_COMPUTED ? volume_of(m, p, i, c) : 0.0;
        if (!later)
            continue;
        cover_centres(s, o, p, covered);
        PART_CELLS (p, i, c) {
            if (m->status[c] != CELL_COMPUTED)
                continue;
            if (is_mixed(p, s->dim, c, covered))
                count_shared(s, o, p, i, c, &met);
            else
                w->count[c] *= covered[c] > 0.0 ? 0.0 : 1.0;
        }
    }
    mem_free(met.cell);
    if (o != m->search)
        FREE(o);
}

/* --- water --- */

double surface_mesh_shared_water(const struct fv *s, const struct shared_cell *x, double shift)
{
    const struct surface_mesh *w = s->surface->mesh;
    const double *phi = s->surface->phi;
    double g[3], sum;
    surface_mesh_gradient(s, grid_part(&s->grid, x->cell, NULL), x->cell, phi, g);
    const double d = g[0] * w->x[0][x->cell] + g[1] * w->x[1][x->cell] - phi[x->cell] - shift;
    struct polygon p = x->own;
    clip(&p, g[0], g[1], d);
    sum = area_of(&p);
    for (int64_t k = x->first; k < x->first + x->n; k++) {
        p = w->piece[k];
        clip(&p, g[0], g[1], d);
        sum -= area_of(&p);
    }
    return sum;
}

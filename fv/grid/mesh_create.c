/* mesh_create.c - a mesh from the case's blocks: checks, sharing among ranks. Each block is cut
 * into slabs along its longest axis; the rows of all blocks are dealt out one after the other, so
 * that each rank gets about the same number of cells. A rank may have none. Order of mesh_create:
 * vertices (mesh_map.c), walls of the domain's sides (mesh_walls.c), joins (mesh_join.c), cells and
 * their orientation, motions, overlaps and imposed cells (overset_*.c, mesh_given.c), all of which
 * every rank does for all blocks; then slabs, and for this rank's parts status, metrics, halo and
 * fringe.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh.h"

#include "mesh_motion.h"
#include "overset.h"

/* Smallest determinant at the corners of a cell, by its edges; an inside-out cell has one <= 0. At
 * each corner the three edges that leave it, turned so that they would be right-handed. */
static double least_corner(const struct mesh_block *b, int dim, const int *i)
{
    double least = INFINITY;
    for (int corner = 0; corner < 1 << dim; corner++) {
        const int v[3] = {i[0] + (corner & 1), i[1] + (corner >> 1 & 1), i[2] + (corner >> 2 & 1)};
        double d[3][3] = {{0.0}};
        d[2][2] = 1.0;
        for (int a = 0; a < dim; a++) {
            int w[3] = {v[0], v[1], v[2]};
            const int up = corner >> a & 1;
            w[a] += up ? -1 : 1;
            for (int c = 0; c < dim; c++)
                d[a][c] = (up ? -1.0 : 1.0) * (b->x[mesh_vertex(b, w[0], w[1], w[2])][c] -
                                               b->x[mesh_vertex(b, v[0], v[1], v[2])][c]);
        }
        least = fmin(least, mesh_determinant(d));
    }
    return least;
}

/* Centres, volumes and orientation of a block's cells; a fault if some are inside out (determinant
 * <= 0 in the middle or at a corner). */
static bool set_cells(const struct run *r, struct faults *f, struct mesh *m, int k)
{
    struct mesh_block *b = m->block + k;
    const int64_t n = mesh_count(b);
    int64_t bad = 0;
    int i[3], first[3] = {0, 0, 0};
    double worst = 0.0;
    b->centre = (double(*)[3])NEW_IN(m, double, 3 * n);
    b->volume = NEW_IN(m, double, n);
    b->status = NEW_IN(m, unsigned char, n);
    for (i[2] = 0; i[2] < b->n[2]; i[2]++)
        for (i[1] = 0; i[1] < b->n[1]; i[1]++)
            for (i[0] = 0; i[0] < b->n[0]; i[0]++) {
                double d[3][3];
                const int64_t c = mesh_cell(b, i);
                mesh_map_point(b, m->dim, i, (double[3]){0.5, 0.5, 0.5}, b->centre[c], d);
                b->volume[c] = mesh_determinant(d);
                const double least = fmin(b->volume[c], least_corner(b, m->dim, i));
                if (least > 0.0)
                    continue;
                if (bad++ == 0)
                    memcpy(first, i, sizeof first);
                worst = fmin(worst, least);
            }
    m->cells += n;
    if (bad == 0)
        return true;
    const double *x = b->centre[mesh_cell(b, first)];
    mesh_fault(r, f, b->prm, b->prm->mapping == MAPPING_FILE ? "file" : "mapping",
               "%lld of its %lld cells are inside out, the first (%d, %d, %d) at (%g, %g, %g) m, "
               "least determinant %g: i, j, k must make a right-handed system, cells must not fold",
               (long long)bad, (long long)n, first[0], first[1], first[2], x[0], x[1], x[2], worst);
    return false;
}

/* before counts the cells of all earlier rows; row i goes to the rank in whose share its middle
 * lies. first[q] is the first layer of rank q along the block's cut. */
static void deal_out(struct mesh *m)
{
    int64_t before = 0;
    for (int k = 0; k < m->nblocks; k++) {
        struct mesh_block *b = m->block + k;
        for (int a = 1; a < m->dim; a++)
            if (b->n[a] > b->n[b->cut])
                b->cut = a;
        const int64_t row = mesh_count(b) / b->n[b->cut];
        b->first = NEW_IN(m, int, m->size + 1);
        int last = 0;
        for (int i = 0; i < b->n[b->cut]; i++, before += row) {
            const int to = (int)((before + row / 2) * m->size / m->cells);
            while (last < to)
                b->first[++last] = i;
        }
        while (last < m->size)
            b->first[++last] = b->n[b->cut];
    }
}

/* The part of a block that a rank has, without its place. Size 0 for a rank without cells of this
 * block. */
static struct part part_of(const struct mesh *m, int k, int rank)
{
    const struct mesh_block *b = m->block + k;
    struct part p = {.block = k, .n = {b->n[0], b->n[1], b->n[2]}};
    p.lo[b->cut] = b->first[rank];
    p.n[b->cut] = b->first[rank + 1] - b->first[rank];
    p.stride[0] = p.size = 1;
    for (int a = 0; a < 3; a++) {
        p.g[a] = a < m->dim ? MESH_GHOSTS : 0;
        if (a > 0)
            p.stride[a] = p.stride[a - 1] * (p.n[a - 1] + 2 * p.g[a - 1]);
    }
    p.size = p.n[b->cut] > 0 ? p.stride[2] * (p.n[2] + 2 * p.g[2]) : 0;
    return p;
}

/* Ghosts behind a side along `cut' belong to the rank beside it. O(blocks). */
void mesh_owner(const struct mesh *m, int block, const int *cell, int *rank, int64_t *place)
{
    const struct mesh_block *b = m->block + block;
    int row = cell[b->cut];
    row = row < 0 ? 0 : row >= b->n[b->cut] ? b->n[b->cut] - 1 : row;
    *rank = 0;
    while (b->first[*rank + 1] <= row)
        (*rank)++;
    struct part p = part_of(m, block, *rank);
    for (int k = 0; k < block; k++)
        p.base += part_of(m, k, *rank).size;
    *place = part_at(&p, cell[0] - p.lo[0], cell[1] - p.lo[1], cell[2] - p.lo[2]);
}

/* Number of cells of block k that a rank has. */
static int64_t cells_of(const struct mesh *m, int k, int rank)
{
    const struct mesh_block *b = m->block + k;
    return mesh_count(b) / b->n[b->cut] * (b->first[rank + 1] - b->first[rank]);
}

/* Rows are numbered rank by rank, part by part, x fastest. */
void mesh_rows(const struct mesh *m, int rank, int64_t *first, int64_t *n)
{
    *first = *n = 0;
    for (int k = 0; k < m->nblocks; k++) {
        for (int q = 0; q < rank; q++)
            *first += cells_of(m, k, q);
        *n += cells_of(m, k, rank);
    }
}

/* By rank, then block, then cell: rows of a rank lie together. */
int64_t mesh_row(const struct mesh *m, int block, const int *cell)
{
    const struct mesh_block *b = m->block + block;
    int64_t first, n;
    int rank = 0;
    while (b->first[rank + 1] <= cell[b->cut])
        rank++;
    mesh_rows(m, rank, &first, &n);
    for (int k = 0; k < block; k++)
        first += cells_of(m, k, rank);
    const struct part p = part_of(m, block, rank);
    return first + (cell[0] - p.lo[0]) +
           (int64_t)p.n[0] * ((cell[1] - p.lo[1]) + (int64_t)p.n[1] * (cell[2] - p.lo[2]));
}

/* Parts lie in fields one behind the other, ghosts included. */
static void make_parts(struct mesh *m)
{
    for (int k = 0; k < m->nblocks; k++) {
        struct part p = part_of(m, k, m->rank);
        p.base = m->size_local;
        m->size_local += p.size;
        if (p.size > 0)
            m->part[m->nparts++] = p;
    }
}

/* What the local cells are, ghosts too: those behind joined sides as there, others no cells. After
 * every cut; local. */
void mesh_set_status(struct mesh *m)
{
    memset(m->status, CELL_HOLE, (size_t)m->size_local);
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_ALL (p, i, c) {
            int at[3] = {p->lo[0] + i[0], p->lo[1] + i[1], p->lo[2] + i[2]}, k = p->block;
            double move[3] = {0.0, 0.0, 0.0};
            if (mesh_resolve(m, &k, at, move))
                m->status[c] = m->block[k].status[mesh_cell(m->block + k, at)];
        }
    }
}

/* period is 0 along axes that are not periodic. */
static void set_boxes(const struct run *r, struct mesh *m, int n, const double (*box)[2][3])
{
    const struct scene_domain *d = &r->scene.domain;
    m->has_given = n > 0;
    m->given.n = n;
    m->given.layers = MESH_GIVEN_LAYERS;
    if (n > 0)
        memcpy(m->given.box, box, (size_t)n * sizeof *box);
    for (int a = 0; a < 3; a++)
        m->given.period[a] = d->periodic[a] ? d->max[a] - d->min[a] : 0.0;
}

/* On a fault everything made so far is freed. m->search is kept where blocks move: they search anew
 * at every step. */
struct mesh *mesh_create(const struct run *r, const struct mesh_blocks *of, int n,
                         const double (*box)[2][3], struct faults *f)
{
    struct mesh *m = NEW(struct mesh, 1);
    const struct mesh_block_params *prm = of->of;
    bool good = true;
    m->comm = r->comm;
    m->prm_of = r->params;
    m->dim = r->scene.domain.dim;
    m->turn = INFINITY;
    m->nblocks = of->n;
    set_boxes(r, m, n, box);
    MPI_Comm_rank(m->comm, &m->rank);
    MPI_Comm_size(m->comm, &m->size);
    for (int k = 0; k < m->nblocks; k++) {
        struct mesh_block *b = m->block + k;
        const int sides[6] = {prm[k].i_min, prm[k].i_max, prm[k].j_min,
                              prm[k].j_max, prm[k].k_min, prm[k].k_max};
        b->prm = prm + k;
        for (int s = 0; s < 6; s++)
            b->side[s] = (enum mesh_side)sides[s];
        good = mesh_map_vertices(r, f, b) && good;
        mem_own(m, b->x);
    }
    if (good)
        mesh_take_walls(r, m);
    good = good && mesh_join_blocks(r, f, m);
    for (int k = 0; k < m->nblocks && good; k++)
        good = set_cells(r, f, m, k) && good;
    good = good && mesh_motion_create(r, f, m, r->t);
    struct overset *o = NULL;
    good = good && (o = overset_create(r, f, m)) != NULL;
    if (!good) {
        FREE(m);
        return NULL;
    }
    deal_out(m);
    make_parts(m);
    m->status = NEW_IN(m, unsigned char, m->size_local);
    mesh_set_status(m);
    mesh_metrics(m);
    mesh_given_close(m);
    mesh_motion_metrics(m);
    mesh_halo_create(m);
    overset_exchange(m, o);
    if (m->moves)
        m->search = mem_own(m, o);
    else
        FREE(o);
    return m;
}

/* The mesh that was checked last: the description and the state are made of it, not of another. */
static struct mesh *checked;

/* Bit by bit: boxes that moved are others. */
static bool same_boxes(const struct mesh *m, int n, const double (*box)[2][3])
{
    return m->given.n == n && (n == 0 || memcmp(m->given.box, box, (size_t)n * sizeof *box) == 0);
}

/* A mesh whose blocks move cannot be taken over, for it stands at another time. */
struct mesh *mesh_take(const struct run *r, const struct mesh_blocks *of, int n,
                       const double (*box)[2][3], struct faults *f)
{
    struct mesh *m = checked;
    checked = NULL;
    if (m && m->comm == r->comm && m->prm_of == r->params && !m->moves && same_boxes(m, n, box))
        return m;
    FREE(m);
    return mesh_create(r, of, n, box, f);
}

void mesh_leave(struct mesh **m)
{
    FREE(checked);
    checked = *m;
    *m = NULL;
}

double *mesh_field(const struct mesh *m) { return NEW(double, m->size_local); }

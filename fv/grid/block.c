/* block.c - a Cartesian grid of equal cells, or of layers, shared among ranks. Ranks form a
 * Cartesian communicator; each has the cells lo .. hi - 1 along every axis with GHOSTS layers
 * around them. Fields are arrays of `size' doubles, x fastest. block_halo fills the ghosts, one
 * axis after the other, so that corners come along with the second and third.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "block.h"

#include "../../common/base/base.h"

/* Whether every rank gets at least LEAST cells along an axis that is cut. */
static bool is_wide(const int *cells, const int *dims)
{
    bool wide = true;
    for (int a = 0; a < 3; a++)
        wide = wide && (dims[a] == 1 || cells[a] / dims[a] >= LEAST);
    return wide;
}

/* Ranks along each axis: as MPI shares them out, rows whole as long as there are other directions
 * to cut (x is the fastest index); where that leaves a rank fewer cells than stencils reach, the
 * split with the least surface that does not. The surface of a split is proportional to sum
 * dims/cells. false: no split leaves ranks wide enough. */
bool block_split(int size, int dim, const int *cells, int dims[3])
{
    const int n[3] = {cells[0], dim > 1 ? cells[1] : 1, dim > 2 ? cells[2] : 1};
    double least = INFINITY;
    dims[0] = size <= cells[dim - 1] / GHOSTS || dim == 1 ? 1 : 0;
    dims[1] = dim > 1 ? 0 : 1;
    dims[2] = dim > 2 ? 0 : 1;
    MPI_Dims_create(size, 3, dims);
    if (is_wide(n, dims))
        return true;
    for (int i = 1; i <= size; i++)
        for (int j = 1; size % i == 0 && j <= size / i; j++) {
            const int d[3] = {i, j, size / i / j};
            const double cut = (double)i / n[0] + (double)j / n[1] + (double)d[2] / n[2];
            if (size / i % j != 0 || (dim < 3 && d[2] > 1) || !is_wide(n, d) || cut >= least)
                continue;
            least = cut;
            memcpy(dims, d, sizeof d);
        }
    return isfinite(least);
}

/* The number of cells along an axis differs by one at most between ranks. send and recv have room
 * for four fields, which block_halo sends at once. */
void block_create(struct block *b, MPI_Comm comm, int dim, const int *cells, const double *origin,
                  const double *length, const bool *periodic)
{
    int size, rank, dims[3], wrap[3] = {0, 0, 0}, at[3] = {0, 0, 0};
    *b = (struct block){.dim = dim};
    MPI_Comm_size(comm, &size);
    (void)block_split(size, dim, cells, dims);
    for (int a = 0; a < dim; a++)
        wrap[a] = periodic[a];
    MPI_Cart_create(comm, 3, dims, wrap, 0, &b->cart);
    MPI_Comm_rank(b->cart, &rank);
    MPI_Cart_coords(b->cart, rank, 3, at);
    b->size = 1;
    for (int a = 0; a < 3; a++) {
        b->cells[a] = a < dim ? cells[a] : 1;
        b->origin[a] = a < dim ? origin[a] : 0.0;
        b->length[a] = a < dim ? length[a] : 1.0;
        b->h[a] = b->length[a] / b->cells[a];
        b->periodic[a] = wrap[a];
        b->lo[a] = (int)((int64_t)b->cells[a] * at[a] / dims[a]);
        b->hi[a] = (int)((int64_t)b->cells[a] * (at[a] + 1) / dims[a]);
        b->n[a] = b->hi[a] - b->lo[a];
        b->g[a] = a < dim ? GHOSTS : 0;
        b->stride[a] = b->size;
        b->size *= b->n[a] + 2 * b->g[a];
        MPI_Cart_shift(b->cart, a, 1, b->below + a, b->above + a);
    }
    int64_t slab = 0;
    for (int a = 0; a < dim; a++) {
        const int64_t s = b->size / (b->n[a] + 2 * b->g[a]) * GHOSTS;
        slab = s > slab ? s : slab;
    }
    b->send = NEW(double, 4 * slab);
    b->recv = NEW(double, 4 * slab);
}

/* Layers of unequal height h[cells[1]] along y; h[1] of the block becomes that of the top ones. */
void block_set_rows(struct block *b, int even, const double *h)
{
    b->rows = rows_create(b->cells[1], even, b->origin[1], h, b->lo[1], b->n[1]);
    b->h[1] = h[b->cells[1] - 1];
}

void block_free(struct block *b)
{
    FREE(b->send, b->recv);
    rows_free(&b->rows);
    MPI_Comm_free(&b->cart);
}

/* The whole block as one part, for loops that serve both kinds of grids; layers are no equal
 * cells. */
struct part block_part(const struct block *b)
{
    struct part p = {.kind = b->rows ? PART_CURVED : PART_EVEN, .size = b->size};
    for (int a = 0; a < 3; a++) {
        p.lo[a] = b->lo[a];
        p.n[a] = b->n[a];
        p.g[a] = b->g[a];
        p.stride[a] = b->stride[a];
    }
    return p;
}

double *block_field(const struct block *b) { return NEW(double, b->size); }

/* Layers beyond the ends go on as high as the last one. */
void block_centre(const struct block *b, int i, int j, int k, double *x)
{
    const int at[3] = {i, j, k};
    for (int a = 0; a < 3; a++)
        x[a] = a < b->dim ? b->origin[a] + (b->lo[a] + at[a] + 0.5) * b->h[a] : 0.0;
    if (b->rows)
        x[1] = b->rows->y[j];
}

void block_cell(const struct block *b, int i, int j, int k, double *x, double *h)
{
    block_centre(b, i, j, k, x);
    for (int a = 0; a < 3; a++)
        h[a] = block_size(b, a, a == 1 ? j : 0);
}

/* Copies GHOSTS layers along axis a, from local index `first' on, to or from packed storage, of
 * values of `item' bytes. Tangential ghosts are copied along. Returns the number of bytes. */
static size_t layers(const struct block *b, char *f, size_t item, int a, int first, char *packed,
                     bool pack)
{
    int lo[3], hi[3];
    size_t m = 0;
    for (int d = 0; d < 3; d++) {
        lo[d] = d == a ? first : -b->g[d];
        hi[d] = d == a ? first + GHOSTS : b->n[d] + b->g[d];
    }
    const size_t bytes = (size_t)(hi[0] - lo[0]) * item;
    for (int k = lo[2]; k < hi[2]; k++)
        for (int j = lo[1]; j < hi[1]; j++, m += bytes) {
            char *row = f + (size_t)block_at(b, lo[0], j, k) * item;
            if (pack)
                memcpy(packed + m, row, bytes);
            else
                memcpy(row, packed + m, bytes);
        }
    return m;
}

/* One direction, one way: what leaves at `from' arrives in the ghosts at `to' of the other side.
 * Four fields a message. Where the neighbour is this rank itself (periodic, one rank) the packed
 * values are unpacked at once. */
static void shift(const struct block *b, int nf, void *const *f, size_t item, int a, int from,
                  int to, int dest, int source)
{
    char *const send = (char *)b->send, *got = send;
    int rank;
    MPI_Comm_rank(b->cart, &rank);
    for (int q = 0; q < nf; q += 4) {
        const int m = nf - q < 4 ? nf - q : 4;
        size_t count = 0;
        for (int k = 0; k < m && dest != MPI_PROC_NULL; k++)
            count += layers(b, f[q + k], item, a, from, send + count, true);
        if (dest != rank || source != rank) {
            const size_t slab = (size_t)(b->size / (b->n[a] + 2 * b->g[a]) * GHOSTS * m) * item;
            got = (char *)b->recv;
            MPI_Sendrecv(send, (int)count, MPI_BYTE, dest, 7, got, (int)slab, MPI_BYTE, source, 7,
                         b->cart, MPI_STATUS_IGNORE);
        }
        count = 0;
        for (int k = 0; k < m && source != MPI_PROC_NULL; k++)
            count += layers(b, f[q + k], item, a, to, got + count, false);
    }
}

/* Blocking; axis after axis in a fixed order, see the head of this file. */
static void halo(const struct block *b, int nf, void *const *f, size_t item)
{
    for (int a = 0; a < b->dim; a++) {
        shift(b, nf, f, item, a, 0, b->n[a], b->below[a], b->above[a]);
        shift(b, nf, f, item, a, b->n[a] - GHOSTS, -GHOSTS, b->above[a], b->below[a]);
    }
}

void block_halo(const struct block *b, int nf, double *const *f)
{
    halo(b, nf, (void *const *)f, sizeof **f);
}

void block_halo_single(const struct block *b, int nf, float *const *f)
{
    halo(b, nf, (void *const *)f, sizeof **f);
}

void block_pack_from(const struct block *b, int first, const double *f, double *packed)
{
    for (int k = 0; k < b->n[2]; k++)
        for (int j = first; j < b->n[1]; j++, packed += b->n[0])
            memcpy(packed, f + block_at(b, 0, j, k), (size_t)b->n[0] * sizeof(double));
}

/* mesh.h - structured blocks of any shape that are joined face to face or overlap: places, metrics,
 * what each cell is, and the exchange of values between them.
 * Every rank knows the vertices of all blocks and what each cell is; fields are local: a rank's
 * parts of blocks, each with ghosts, one behind the other in one array.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

#include "../../common/run/run.h"
#include "mesh_blocks.h"
#include "part.h"
#include "side_kinds.h"

enum {
    MESH_BOXES_MAX = 8,   /* of imposed cells */
    MESH_GHOSTS = 3,      /* layers of cells */
    MESH_VERTICES = 5,    /* layers of vertices behind the sides */
    MESH_GIVEN_LAYERS = 4 /* of imposed cells that get values */
};
/* What a cell is: solved for; interpolated from another block; without values; imposed, with the
 * values of a partner or of the exact solution. */
enum mesh_status { CELL_COMPUTED, CELL_FRINGE, CELL_HOLE, CELL_GIVEN };

/* The boxes (lower, upper corner, m) of imposed cells: cells of all blocks that lie wholly in one
 * of them are imposed ("given"). */
struct mesh_boxes {
    int n;
    double box[MESH_BOXES_MAX][2][3]; /* as they stand now */
    double period[3];                 /* m: of the domain, 0: none */
    int layers;                       /* of imposed cells that get values */
};

/* What lies behind a joined side. Doubled indices X (vertex i: 2 i, cell i: 2 i + 1) behind it are
 * the neighbour's X'[axis[a]] = sign[a] X[a] + shift[a]; the neighbour's coordinates become this
 * block's by adding `move', m. */
struct mesh_join {
    int block; /* -1: none */
    int axis[3], sign[3], shift[3];
    double move[3];
};

struct mesh_motion;
/* A block as every rank knows it; arrays are owned. */
struct mesh_block {
    const struct mesh_block_params *prm;
    struct mesh_motion *motion;    /* NULL: at rest; of joined blocks the same */
    const struct mesh_block *made; /* where the case puts it: itself if at rest */
    int n[3];                      /* cells */
    int v0[3], nv[3];              /* vertices: first index, number with ghosts */
    double (*x)[3];                /* m: vertices with ghosts */
    enum mesh_side side[6];
    /* Of the scene, on whose side of the domain this one lies; NULL: none. */
    const struct scene_wall *wall[6];
    int on[6];               /* side of the domain that a side lies wholly on; 6: none */
    double opening[6][2][3]; /* m: box of the opening on that side of the domain that a side is part
                                of: sides of blocks that touch are one */
    struct mesh_join join[6];
    double (*centre)[3]; /* m: of the real cells */
    double *volume;      /* m^dim: of the real cells */
    double *faces;       /* of a moving block's part here: S and integrals of r cross dS as made */
    unsigned char *status; /* of the real cells */
    int cut;               /* axis along which ranks share it */
    int *first;            /* [size + 1] first layer along `cut' of each rank, and the end */
};

/* A list of values that go from cells of one rank to cells of another: copies, or with weights sums
 * over a stencil. */
struct mesh_exchange {
    int npeers, *peer;
    int64_t *first_in, *first_out; /* of each peer, and one more */
    int64_t *in;                   /* places that receive */
    int64_t *out;              /* places that are sent; with weights the first of each stencil */
    int width;                 /* of a stencil: width^dim values; 1: copies */
    double *weight;            /* width^dim a value */
    int *part;                 /* that each stencil lies in, on the rank that sends */
    const unsigned char *keep; /* of all places, 1: vectors there stay as they are; NULL: none */
    double *send, *recv;       /* room for `room' fields */
    int room;
};

/* A cell of the fringe on this rank and the linear interpolation that is its row of the matrix. */
struct mesh_fringe {
    int64_t place;
    int block, cell[3];
    int donor, from[3]; /* lowest of the 2^dim cells, perhaps behind a joined side */
    double weight[8];
};

/* All blocks, and this rank's parts of them with their metrics; arrays are owned. Fields have
 * size_local entries. */
struct mesh {
    MPI_Comm comm;
    const struct params *prm_of; /* the case it was made of; borrowed, for comparison alone */
    int rank, size, dim;
    int nblocks;
    struct mesh_block block[MESH_BLOCKS_MAX];
    int nparts;
    struct part part[MESH_BLOCKS_MAX];
    int64_t size_local;   /* of a field */
    int64_t cells;        /* of all blocks */
    int64_t computed;     /* of all blocks */
    int64_t fringe_cells; /* of all blocks */
    int64_t linear;       /* of these, by linear interpolation alone */
    int64_t given_cells;  /* of all blocks, near computed ones */
    struct mesh_boxes given;
    bool has_fringe, has_given, moves;
    bool uneven; /* volumes differ: volume averages are not averages in index space */
    int64_t nfringe;
    struct mesh_fringe *fringes;
    double *S[3][3];       /* m^(dim-1): area vector of the lower face along a, component */
    double *G[3][3];       /* S_a.S_b/J, averages over the lower face along a */
    double *V;             /* m^dim */
    double *open[3];       /* 1: psi passes the lower face; 0: it does not */
    unsigned char *status; /* with ghosts: CELL_HOLE behind sides that are no cells */
    struct mesh_exchange halo, fringe;
    double *grid[3];        /* m^dim/s: flux of the moving cells' own velocity, see mesh_motion.h */
    struct overset *search; /* of blocks, or a box of imposed cells, that move; else NULL */
    bool *twice;            /* marks of mesh_twice; NULL: not looked for */
    double turn;            /* s: at this time motions have the velocity of just before */
    char trouble[600];      /* a cell without donors on this rank, after a move; "" : none */
};

/* m^(2 dim - 2): |S|^2 of the lower face of cell c along index a. */
static inline double mesh_area2(const struct mesh *m, int a, int64_t c)
{
    double sum = 0.0;
    for (int q = 0; q < m->dim; q++)
        sum += m->S[a][q][c] * m->S[a][q][c];
    return sum;
}

/* Number of the real cell of indices i[3] in the lists of a block, x fastest. */
static inline int64_t mesh_cell(const struct mesh_block *b, const int *i)
{
    return i[0] + (int64_t)b->n[0] * (i[1] + (int64_t)b->n[1] * i[2]);
}

/* Sets i[3] to the indices of cell number c, the inverse of mesh_cell. */
static inline void mesh_index(const struct mesh_block *b, int64_t c, int *i)
{
    i[0] = (int)(c % b->n[0]);
    i[1] = (int)(c / b->n[0] % b->n[1]);
    i[2] = (int)(c / b->n[0] / b->n[1]);
}
/* Number of real cells of a block. */
static inline int64_t mesh_count(const struct mesh_block *b)
{
    return (int64_t)b->n[0] * b->n[1] * b->n[2];
}

/* mesh_walls.c: velocity w[3] that a wall or an inflow of a block has at x, m/s. */
void mesh_side_velocity(const struct run *r, const struct mesh_block *b, int side, const double *x,
                        double *w);
/* mesh_given.c: sets the status of the cells in the boxes m->given to CELL_GIVEN; does nothing
 * without boxes, as the next two. Before blocks are cut where they overlap. */
void mesh_given_mark(struct mesh *m);
/* Whether all corners of a cell lie in one of the boxes, some periods away. */
bool mesh_given_holds(const struct mesh *m, const struct mesh_block *b, int64_t c);
/* After blocks are cut: makes holes of imposed cells further than m->given.layers from all computed
 * ones, which no stencil reads, and counts the others in m->given_cells. */
void mesh_given_trim(struct mesh *m);
/* Sets m->open to 0 on the faces of imposed cells, whose flux is imposed. */
void mesh_given_close(struct mesh *m);
/* mesh_metrics.c: sets m->open to 0 on the faces of sides that psi does not pass, to 1 elsewhere.
 */
void mesh_open_faces(struct mesh *m);
/* mesh_recut.c: whether the cells in these boxes, as many boxes as before, are others than those in
 * m->given. */
bool mesh_recut_wanted(const struct mesh *m, const double (*box)[2][3]);
/* Cuts the blocks anew around these boxes, which become m->given. Where blocks overlap m->search
 * must exist; m->trouble as in overset.h. Collective. */
void mesh_recut(struct mesh *m, const double (*box)[2][3]);
/* Room for the offsets of mesh_given_sources. */
enum { MESH_SOURCES = 12 };
/* The computed neighbours whose mean is psi of the imposed cell c of this rank, as offsets along
 * the indices; returns their number, 0: none is near. */
int mesh_given_sources(const struct mesh *m, const struct part *p, int64_t c, int (*offset)[3]);

/* mesh_create.c: the mesh of these blocks, which must outlive it; cells in the n boxes (lo, hi) are
 * imposed. NULL if there are faults. Owned by the caller (FREE). Collective over r->comm. */
struct mesh *mesh_create(const struct run *r, const struct mesh_blocks *of, int n,
                         const double (*box)[2][3], struct faults *f);
/* The mesh that mesh_leave left, if it is of the same case and boxes and its blocks do not move,
 * else a new one: so that checks and the run make it once. */
struct mesh *mesh_take(const struct run *r, const struct mesh_blocks *of, int n,
                       const double (*box)[2][3], struct faults *f);
/* Keeps a mesh for mesh_take, in place of one that was left before, and sets *m to NULL. */
void mesh_leave(struct mesh **m);
/* A field of m->size_local zeros; owned by the caller (mem_free). */
double *mesh_field(const struct mesh *m);
/* Sets the status of local cells, ghosts included, from that of the blocks. */
void mesh_set_status(struct mesh *m);
/* Rank and index there of a real cell, or of a ghost behind one side of the block. */
void mesh_owner(const struct mesh *m, int block, const int *cell, int *rank, int64_t *place);
/* Number of a real cell's matrix row; rows are ordered by ranks. */
int64_t mesh_row(const struct mesh *m, int block, const int *cell);
/* The first matrix row of a rank and the number of its rows. */
void mesh_rows(const struct mesh *m, int rank, int64_t *first, int64_t *n);

/* mesh_map.c: makes the vertices of a block with all layers behind its sides; false: a fault was
 * added. */
bool mesh_map_vertices(const struct run *r, struct faults *f, struct mesh_block *b);
/* Position x and derivatives dx[a][c] = d x_c / d xi_a at xi (0 to 1) of a cell, also behind sides.
 * The map is smooth across cells. */
void mesh_map_point(const struct mesh_block *b, int dim, const int *cell, const double *xi,
                    double *x, double dx[3][3]);
/* The determinant of a map's derivatives, m^dim per cell: its Jacobian. */
double mesh_determinant(double dx[3][3]);
/* Place of vertex (i, j, k) of a block in its x; cell (i, j, k) has it as its lower corner. */
static inline int64_t mesh_vertex(const struct mesh_block *b, int i, int j, int k)
{
    return (i - b->v0[0]) +
           (int64_t)b->nv[0] * ((j - b->v0[1]) + (int64_t)b->nv[1] * (k - b->v0[2]));
}

/* mesh_walls.c: gives sides that have no kind of their own and lie on a side of the domain the kind
 * of its wall. */
void mesh_take_walls(const struct run *r, struct mesh *m);

/* mesh_join.c: finds the faces of blocks that meet, and sets the vertices behind them; false:
 * faults were added. */
bool mesh_join_blocks(const struct run *r, struct faults *f, struct mesh *m);
/* Replaces block and cell, whose indices may lie behind joined sides, by the real cell; move is
 * added to its coordinates. false: it lies behind another kind of side. */
bool mesh_resolve(const struct mesh *m, int *block, int *cell, double *move);

/* mesh_metrics.c: computes S, G and V of the local parts, of the blocks as they are made. */
void mesh_metrics(struct mesh *m);
/* Least height of a cell of this status over one of its lower faces, m, of all ranks; INFINITY:
 * there is none. Collective. */
double mesh_least_height(const struct mesh *m, enum mesh_status status);
/* Integral of (x - o) cross dS over the lower face along a of cell i: as for the area vectors, the
 * sum over a cell's six faces is zero. */
void mesh_face_moment(const struct mesh_block *b, int dim, const int *i, int a, const double *o,
                      double *R);

/* A place of this rank that wants a value of another one. */
struct mesh_request {
    int rank;             /* that has it */
    int block;            /* there; of stencils alone */
    int64_t in, out;      /* place here; place there, of a stencil its first cell */
    const double *weight; /* [width^dim] of a stencil; borrowed during mesh_exchange_create */
};
/* mesh_halo.c: makes an exchange for n values that this rank wants. Collective. */
void mesh_exchange_create(void *owner, struct mesh *m, struct mesh_exchange *x, int width,
                          int64_t n, const struct mesh_request *request);
/* Frees the lists and leaves an exchange of nothing. */
void mesh_exchange_free(struct mesh_exchange *x);
/* Exchanges nf fields. Collective. */
void mesh_exchange(const struct mesh *m, struct mesh_exchange *x, int nf, double *const *f);
/* The same, writing into other arrays than those that are sent. */
void mesh_exchange_to(const struct mesh *m, struct mesh_exchange *x, int nf, double *const *f,
                      double *const *to);
/* Makes m->halo of all ghosts that are copies of cells. Collective. */
void mesh_halo_create(struct mesh *m);
/* Fills the ghosts of nf fields behind joined sides and between ranks. Collective. */
void mesh_halo(struct mesh *m, int nf, double *const *f);
/* The same and the fringe of overlaps, whose ghosts follow it. Collective. */
void mesh_fill(struct mesh *m, int nf, double *const *f);

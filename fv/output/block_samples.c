/* block_samples.c - values at places on blocks: cells and weights of a place, by the block with the
 * smallest cell there. A gauge's are kept while blocks, and what a partner computes, stay where
 * they are. SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_output.h"

#include "../../common/base/base.h"
#include "../../common/scene/scene.h"
#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "output.h"
#include "probe_flow.h"

enum { MOST = 64 }; /* cells of a place */

/* Places between straight walls at rest of a block and the centres beside them, in cells: as far
 * beyond these as linear weights must reach for the pressure to level off there. */
static void level_off(const struct mesh_block *b, int dim, const int *cell, double *xi)
{
    for (int a = 0; a < dim; a++) {
        const bool up = xi[a] > 0.5;
        const double from = up ? 1.0 - xi[a] : xi[a], to = 0.5 + probe_weight_at_wall(from);
        if (cell[a] == (up ? b->n[a] - 1 : 0) && side_is_wall(b->side[2 * a + up]) && !b->motion &&
            (b->prm->mapping == MAPPING_BOX || b->prm->mapping == MAPPING_STRETCHED))
            xi[a] = up ? 1.0 - to : to;
    }
}

/* This rank's cells and weights of the value at x; wanted: width of the stencil, 0: 4 cells, or 2
 * where these are not computed; levels: before walls as level_off says. Returns their number, 0 if
 * no block has x. */
static int stencil_at(const struct fv *s, const struct overset *o, const double *x, int wanted,
                      bool levels, int64_t *cells, double *weights)
{
    const struct mesh *m = s->m;
    double finest = INFINITY;
    int n = 0;
    for (int k = 0; k < m->nblocks; k++) {
        int cell[3], from[3], width = wanted > 0 ? wanted : 4;
        double xi[3], w[MOST];
        if (!overset_locate(m, o, k, x, cell, xi))
            continue;
        if (levels)
            level_off(m->block + k, m->dim, cell, xi);
        const double v = m->block[k].volume[mesh_cell(m->block + k, cell)];
        bool good = v < finest && overset_weights(m, k, cell, xi, 1, width, from, w);
        if (!good && wanted == 0) {
            width = 2;
            good = v < finest && overset_weights(m, k, cell, xi, 1, width, from, w);
        }
        if (!good)
            continue;
        finest = v;
        n = 0;
        for (int q = 0; q < (m->dim == 3 ? width : 1) * width * width; q++) {
            int at[3] = {from[0] + q % width, from[1] + q / width % width,
                         from[2] + q / width / width};
            int block = k, rank;
            double move[3] = {0.0, 0.0, 0.0};
            int64_t place;
            if (!mesh_resolve(m, &block, at, move))
                continue;
            mesh_owner(m, block, at, &rank, &place);
            if (rank != m->rank)
                continue;
            cells[n] = place;
            weights[n++] = w[q];
        }
    }
    return n;
}

/* Sum of a field's values, NULL: of the pressure. */
static double sum_of(const struct fv *s, int n, const int64_t *cells, const double *weights,
                     const double *q)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += weights[k] * (q ? q[cells[k]] : fv_pressure(s, cells[k]));
    return sum;
}

/* Of phi: what it is more than the height of the cells, to which that of x is added: exact for a
 * level surface, whatever the cells. */
static double phi_of(const struct fv *s, int n, const int64_t *cells, const double *weights,
                     const double *x)
{
    const double *phi = s->surface->phi, *heights = s->surface->mesh->height;
    if (!(s->surface->g > 0.0))
        return sum_of(s, n, cells, weights, phi);
    const double height = scene_height(&s->run->scene, x);
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += weights[k] * (phi[cells[k]] - heights[cells[k]] + height);
    return sum;
}

/* This rank's share: the caller adds them up. */
double mesh_value_at(const struct fv *s, const struct overset *o, const double *x, int wanted,
                     const double *q)
{
    int64_t cells[MOST];
    double weights[MOST];
    const int n = stencil_at(s, o, x, wanted, s->surface && !q, cells, weights);
    return sum_of(s, n, cells, weights, q);
}

/* Two cells along each axis: cubics would swing where the surface bends. */
double mesh_phi_at(const struct fv *s, const struct overset *o, const double *x)
{
    int64_t cells[MOST];
    double weights[MOST];
    const int n = stencil_at(s, o, x, 2, false, cells, weights);
    return phi_of(s, n, cells, weights, x);
}

bool mesh_stays(const struct fv *s) { return !s->m->moves && !s->partners.past[0][0]; }

/* All ranks look for all places, for a stencil's cells may be anybody's; each keeps its own. */
const struct block_samples *block_samples_of(struct fv *s, int gauge, int n, double (*x)[3])
{
    struct block_samples *of = s->output->samples + gauge;
    if (of->n == n && mesh_stays(s))
        return of;
    int used = 0;
    of->n = n;
    ROOM_IN(s->output, of->first, n + 1);
    for (int k = 0; k < n; k++) {
        ROOM_IN(s->output, of->cell, used + MOST);
        ROOM_IN(s->output, of->weight, used + MOST);
        of->first[k] = used;
        used += stencil_at(s, s->output->search, x[k], s->surface ? 2 : 0, false, of->cell + used,
                           of->weight + used);
    }
    of->first[n] = used;
    return of;
}

double block_sample(const struct fv *s, const struct block_samples *of, int k, const double *q)
{
    const int at = of->first[k];
    return sum_of(s, of->first[k + 1] - at, of->cell + at, of->weight + at, q);
}

double block_sample_phi(const struct fv *s, const struct block_samples *of, int k, const double *x)
{
    const int at = of->first[k];
    return phi_of(s, of->first[k + 1] - at, of->cell + at, of->weight + at, x);
}

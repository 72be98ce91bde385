/* overset_stencil.c - interpolation: tensor products of cubics through four averages in the
 * giving cells' indices, or linear ones, averaged over Gauss points of the receiving cell: averages
 * to averages, fourth order. SPDX-License-Identifier: BSD-3-Clause */

#include "mesh_motion.h"
#include "overset_inside.h"

/* Weights of four (or two) averages for the value at s, in cells from the first one's lower side. /
 * With the integral I_k of the averages up to side k, the value is I'(s) of the quartic through I_0
 * .. I_4; w_j sums the slopes of all sides above average j. */
static void weights(int width, double s, double *w)
{
    if (width == 2) {
        w[0] = 1.5 - s;
        w[1] = s - 0.5;
        return;
    }
    double slope[5]; /* of Lagrange's quartics through the sides, which the sums of averages fit */
    for (int k = 0; k < 5; k++) {
        slope[k] = 0.0;
        for (int l = 0; l < 5; l++) {
            double product = 1.0;
            if (l == k)
                continue;
            for (int q = 0; q < 5; q++)
                if (q != k)
                    product *= (q == l ? 1.0 : s - q) / (k - q);
            slope[k] += product;
        }
    }
    for (int j = 3; j >= 0; j--)
        w[j] = slope[j + 1] + (j < 3 ? w[j + 1] : 0.0);
}

/* Cells lo to hi - 1, which may lie behind joined sides, are all of this set. lo and hi may lie
 * behind sides, from where mesh_resolve leads on. */
bool overset_all(const struct mesh *m, int block, const int *lo, const int *hi, int set)
{
    const struct mesh_block *b = m->block + block;
    bool inside = true;
    int i[3];
    for (int a = 0; a < m->dim; a++)
        inside = inside && lo[a] >= 0 && hi[a] <= b->n[a];
    for (i[2] = lo[2]; i[2] < hi[2]; i[2]++)
        for (i[1] = lo[1]; i[1] < hi[1]; i[1]++)
            for (i[0] = lo[0]; i[0] < hi[0]; i[0]++) {
                int at[3] = {i[0], i[1], i[2]}, k = block;
                double move[3] = {0.0, 0.0, 0.0};
                if (!inside && !mesh_resolve(m, &k, at, move))
                    return false;
                if (!(set >> m->block[k].status[mesh_cell(m->block + k, at)] & 1))
                    return false;
            }
    return true;
}

/* A cube of `width' cells from `from' on. */
static bool all_of(const struct mesh *m, int block, const int *from, int width, int set)
{
    const int to[3] = {from[0] + width, from[1] + width, m->dim == 3 ? from[2] + width : 1};
    return overset_all(m, block, from, to, set);
}

/* First cell of the stencil around a place; it stays among the cells. width/2 cells on either side
 * of xi. */
bool overset_stencil(const struct mesh *m, int block, const int *cell, const double *xi, int width,
                     int set, int *from)
{
    const struct mesh_block *b = m->block + block;
    from[2] = 0;
    for (int a = 0; a < m->dim; a++) {
        from[a] = cell[a] - width / 2 + (xi[a] >= 0.5);
        if (from[a] < 0 && !overset_leads_on(b, 2 * a))
            from[a] = 0;
        if (from[a] > b->n[a] - width && !overset_leads_on(b, 2 * a + 1))
            from[a] = b->n[a] - width;
    }
    return all_of(m, block, from, width, set);
}

/* xi: npoints places relative to `cell', of which the mean is taken; the first gives the stencil. /
 * With several points the first is the centre and only chooses the stencil. */
static bool weigh(const struct mesh *m, int block, const int *cell, const double *xi, int npoints,
                  int width, int set, int *from, double *weight)
{
    const int n = m->dim == 3 ? width * width * width : width * width;
    if (!overset_stencil(m, block, cell, xi, width, set, from))
        return false;
    memset(weight, 0, (size_t)n * sizeof(double));
    const int start = npoints > 1 ? 1 : 0;
    for (int g = start; g < npoints; g++) {
        double w[3][4] = {{0.0}, {0.0}, {1.0, 0.0, 0.0, 0.0}};
        for (int a = 0; a < m->dim; a++)
            weights(width, xi[3 * g + a] + cell[a] - from[a], w[a]);
        for (int k = 0; k < n; k++)
            weight[k] += w[0][k % width] * w[1][k / width % width] * w[2][k / width / width] /
                         (npoints - start);
    }
    return true;
}

bool overset_weights(const struct mesh *m, int block, const int *cell, const double *xi,
                     int npoints, int width, int *from, double *weight)
{
    return weigh(m, block, cell, xi, npoints, width, OF_COMPUTED, from, weight);
}

/* A linear stencil in the store of a cubic one: the same window, zeros around. from may move down
 * by one so that four cells fit around the donor cell. */
void overset_widen(const struct mesh *m, struct donor *d)
{
    double w[64] = {0.0};
    int from[3] = {0, 0, 0};
    for (int a = 0; a < m->dim; a++)
        from[a] = d->from[a] < d->at[a] ? d->from[a] : d->at[a] - 1;
    for (int k = 0; k < 1 << m->dim; k++) {
        int64_t to = 0;
        for (int a = m->dim - 1; a >= 0; a--)
            to = 4 * to + (k >> a & 1) + d->from[a] - from[a];
        w[to] = d->weight[k];
    }
    memcpy(d->weight, w, sizeof w);
    memcpy(d->from, from, sizeof from);
}

/* Place, on its owner, of a stencil's first cell: seen from the donor cell. Stencil cells may be
 * ghosts of the owner's part. */
int64_t overset_place(const struct mesh *m, const struct donor *d, int *rank)
{
    const struct mesh_block *b = m->block + d->from_block;
    int64_t place, stride = 1;
    mesh_owner(m, d->from_block, d->at, rank, &place);
    for (int a = 0; a < m->dim; a++) {
        const int n = a == b->cut ? b->first[*rank + 1] - b->first[*rank] : b->n[a];
        place += stride * (d->from[a] - d->at[a]);
        stride *= n + 2 * MESH_GHOSTS;
    }
    return place;
}

/* Places of the centre, xi, and of Gauss points of a box of size h around it in the indices of the
 * cell d->at; false: too far from it. places[0] is xi itself. */
static bool box_places(const struct mesh *m, const struct donor *d, const double *h,
                       const double *xi, double *places)
{
    static const double gauss[2] = {-0.2886751345948129, 0.2886751345948129};
    double y[3], dx[3][3];
    mesh_map_point(m->block + d->from_block, m->dim, d->at, xi, y, dx);
    for (int g = 0; g <= 1 << m->dim; g++) {
        double *to = places + 3 * g;
        for (int a = 0; a < 3; a++)
            to[a] = xi[a];
        if (g == 0)
            continue;
        double z[3] = {y[0], y[1], y[2]};
        for (int a = 0; a < m->dim; a++)
            z[a] += h[a] * gauss[(g - 1) >> a & 1];
        if (!overset_invert(m->block + d->from_block, m->dim, d->at, z, to))
            return false;
    }
    return true;
}

/* As try_donor of overset_donors.c, but from cells with any values (OF_ANY). */
static bool sample_from(const struct mesh *m, const struct overset *o, int q, int width,
                        const double *x, const double *h, struct donor *d, double *volume)
{
    double xi[3], places[3 * 9];
    int cell[3];
    struct donor e = {.from_block = q, .width = width};
    if (!overset_locate(m, o, q, x, cell, xi))
        return false;
    const double v = m->block[q].volume[mesh_cell(m->block + q, cell)];
    memcpy(e.at, cell, sizeof e.at);
    if (v >= *volume || !box_places(m, &e, h, xi, places) ||
        !weigh(m, q, cell, places, (1 << m->dim) + 1, width, OF_ANY, e.from, e.weight))
        return false;
    *volume = v;
    *d = e;
    return true;
}

/* The weights are copied to the caller's array, which the request points to. */
static void to_request(const struct mesh *m, const struct donor *d, struct mesh_request *r,
                       double *weight)
{
    *r = (struct mesh_request){.block = d->from_block, .weight = weight};
    r->out = overset_place(m, d, &r->rank);
    memcpy(weight, d->weight, sizeof d->weight);
}

/* xi is cut at one cell beyond the side, so that extrapolation stays tame. */
bool overset_sample_beyond(const struct mesh *m, int block, const int *cell, const double *x,
                           struct mesh_request *r, double *weight)
{
    struct donor d = {.from_block = block, .width = 2};
    double xi[3] = {0.5, 0.5, 0.5};
    memcpy(d.at, cell, sizeof d.at);
    if (!overset_invert(m->block + block, m->dim, cell, x, xi))
        return false;
    for (int a = 0; a < m->dim; a++)
        xi[a] = fmax(-1.0, fmin(2.0, xi[a]));
    if (!weigh(m, block, cell, xi, 1, 2, OF_ANY, d.from, d.weight))
        return false;
    overset_widen(m, &d);
    to_request(m, &d, r, weight);
    return true;
}

/* Cubic where some block has the cells, else linear. */
bool overset_sample(const struct mesh *m, const struct overset *o, const double *x, const double *h,
                    struct mesh_request *r, double *weight)
{
    struct donor d = {0};
    double volume = INFINITY;
    for (int width = 4; width >= 2 && volume == INFINITY; width -= 2)
        for (int q = 0; q < m->nblocks; q++)
            sample_from(m, o, q, width, x, h, &d, &volume);
    if (volume == INFINITY)
        return false;
    if (d.width == 2)
        overset_widen(m, &d);
    to_request(m, &d, r, weight);
    return true;
}

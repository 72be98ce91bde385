/* flow_measures.c - vorticity, divergence and averages for outputs, on any cells. Derivatives are
 * those of the scheme: on uniform cells and layers fourth order from averages, on blocks by Gauss's
 * theorem with the fourth-order face values of mesh_gradient, where a single cell's curl suffices
 * by those of second order. Called by fv/output and the watches.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "flow_measures.h"

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "blocked_cells.h"
#include "mesh_ops.h"

/* d_a u_q in the cell c of row j, average over it; boxes that are cut out have ghosts of their own.
 */
static double derivative(const struct fv *s, int q, int a, int64_t c, int j)
{
    return s->blocked ? blocked_derivative(s, q, a, c) : block_derivative(&s->b, s->u[q] + c, a, j);
}

/* w = dv/dx - du/dy, averages over cells. */
static void vorticity_of_even(const struct fv *s, double *w)
{
    BLOCK_ROWS_AT (&s->b, 0, j, c, n)
        for (int64_t i = c; i < c + n; i++)
            w[i] = derivative(s, 1, 0, i, j) - derivative(s, 0, 1, i, j);
}

/* Two gradients, of which one component each is kept; then averages over indices, which errors and
 * pictures are made of, need ghosts of w. Collective. */
static void vorticity_of_blocks(struct fv *s, double *w)
{
    const struct mesh *m = s->m;
    mesh_gradient(s, s->u[0], s->rhs);
    for (int r = 0; r < m->nparts; r++)
        PART_ROWS (m->part + r, no_layers, no_layers, c, n)
            memcpy(w + c, s->rhs[1] + c, (size_t)n * sizeof(double));
    mesh_gradient(s, s->u[1], s->rhs);
    for (int r = 0; r < m->nparts; r++)
        PART_ROWS (m->part + r, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                w[i] = s->rhs[0][i] - w[i];
    mesh_fill(s->m, 1, &w);
    if (s->forcing)
        forcing_extend(s, 1, w);
    mesh_bc_even(s, false, w);
    mesh_to_index(s, w, s->flux);
}

void flow_vorticity(struct fv *s, double *w)
{
    if (s->m)
        vorticity_of_blocks(s, w);
    else
        vorticity_of_even(s, w);
}

/* Component a of the curl is d_p u_q - d_q u_p with (a, p, q) cyclic. */
static double curl_in_even(const struct fv *s, int64_t c)
{
    const struct block *b = &s->b;
    const int j = block_row(b, c);
    double sum = 0.0;
    for (int a = b->dim == 3 ? 0 : 2; a < 3; a++) { /* d_p u_q - d_q u_p */
        double w = 0.0;
        for (int k = 0; k < 2; k++) {
            const int along = (a + 1 + k) % 3, of = (a + 2 - k) % 3;
            w += (k ? -1.0 : 1.0) * derivative(s, of, along, c, j);
        }
        sum += w * w;
    }
    return sum;
}

static double curl_in_blocks(const struct fv *s, const struct part *p, int64_t c)
{
    const struct mesh *m = s->m;
    double g[3][3] = {{0.0}}, sum = 0.0;
    for (int q = 0; q < m->dim; q++) /* by face values: second order */
        for (int a = 0; a < m->dim; a++)
            for (int k = 0; k < m->dim; k++) {
                const int64_t d = p->stride[a];
                g[q][k] += 0.5 *
                           (m->S[a][k][c + d] * (s->u[q][c] + s->u[q][c + d]) -
                            m->S[a][k][c] * (s->u[q][c] + s->u[q][c - d])) /
                           m->V[c];
            }
    for (int a = m->dim == 3 ? 0 : 2; a < 3; a++) {
        const double w = g[(a + 2) % 3][(a + 1) % 3] - g[(a + 1) % 3][(a + 2) % 3];
        sum += w * w;
    }
    return sum;
}

double flow_curl_squared(const struct fv *s, const struct part *p, int64_t c)
{
    return s->m ? curl_in_blocks(s, p, c) : curl_in_even(s, c);
}

/* Largest |div U| of this rank's computed cells, 1/s; imposed and dry ones are left out. */
static double divergence_of_even(const struct fv *s)
{
    const struct block *b = &s->b;
    double most = 0.0;
    BLOCK_ROWS_AT (b, 0, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            double div = 0.0;
            if ((s->forcing && s->forcing->forced[i]) || (s->surface && s->surface->layer[i]))
                continue;
            for (int a = 0; a < b->dim; a++)
                div += (s->U[a][i + b->stride[a]] - s->U[a][i]) / block_size(b, a, j);
            most = fmax(most, fabs(div));
        }
    return most;
}

/* The same on blocks; holes and fringe count as 0. */
static double divergence_of_blocks(struct fv *s)
{
    double most = 0.0;
    mesh_divergence(s, s->U, s->flux);
    for (int q = 0; q < s->m->nparts; q++)
        PART_ROWS (s->m->part + q, no_layers, no_layers, c, n)
            for (int64_t i = c; i < c + n; i++)
                most = fmax(most, fabs(s->flux[i]) / s->m->V[i]);
    return most;
}

double flow_largest_divergence(struct fv *s)
{
    double most = s->m ? divergence_of_blocks(s) : divergence_of_even(s);
    return ranks_max(s->comm, most);
}

void flow_to_volume(struct fv *s, double *q)
{
    if (s->m)
        mesh_to_volume(s, q, s->flux);
}

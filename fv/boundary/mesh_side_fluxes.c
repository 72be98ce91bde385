/* mesh_side_fluxes.c - what flows through the physical sides of blocks. U in m^dim/s, all sums over
 * this rank's faces; those that are collective say so in mesh_bc.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "mesh_sides.h"

/* Of walls the flux of the moving grid, or 0; other sides keep what was interpolated from
 * ghosts. */
void mesh_bc_fluxes(const struct fv *s, double *const U[3])
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (!side_is_wall(d->kind))
            continue;
        SIDE_PLACES (d, 1, i, j, at, c) {
            U[d->a][c + d->face] = d->moves ? s->m->grid[d->a][c + d->face] : 0.0;
            (void)at;
        }
    }
}

/* As convection_beside_walls. */
void mesh_bc_beside_walls(const struct fv *s, const struct part *p, int a, double *f)
{
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->p != p || d->a == a || !(d->slides || (s->surface && d->kind == MESH_WALL)))
            continue;
        for (int j = 0; j < d->n[1] + (d->t[1] == a); j++)
            for (int i = 0; i < d->n[0] + (d->t[0] == a); i++) {
                double *q = f + side_cell(d, i, j);
                q[-d->in] = bc_beside_wall(q, d->in, s->surface);
            }
    }
}

bool mesh_bc_slides(const struct fv *s)
{
    bool any = false;
    for (int k = 0; k < s->sides->n; k++)
        any = any || s->sides->side[k].slides;
    return any;
}

/* Largest rate at which given velocities cross the cells beside sides, 1/s, relative to the moving
 * grid; *speed is raised to the largest of them. */
double mesh_bc_rate(const struct fv *s, double *speed)
{
    const struct mesh *m = s->m;
    double rate = 0.0;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES (d, 0, i, j, at, c) {
            double w2 = 0.0, sum = 0.0;
            for (int a = 0; a < m->dim; a++) {
                const int64_t f = c + (a == d->a ? d->face : 0);
                double wS = d->moves ? -m->grid[a][f] : 0.0;
                for (int q = 0; q < m->dim; q++)
                    wS += d->w[q][at] * m->S[a][q][f];
                sum += fabs(wS);
                w2 += d->w[a][at] * d->w[a][at];
            }
            rate = fmax(rate, sum / m->V[c]);
            *speed = fmax(*speed, sqrt(w2));
        }
    }
    return rate;
}

/* Faces that two blocks have count once in all: share first. */
void mesh_bc_visit(const struct fv *s, void (*visit)(const struct side_face *f, void *with),
                   void *with)
{
    mesh_bc_share_faces(s);
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        const struct mesh_block *block = s->m->block + d->p->block;
        struct side_face f = {.kind = d->kind,
                              .part = d->p,
                              .body = d->body ? 1 + d->p->block : 0,
                              .side = d->k,
                              .a = d->a,
                              .in = d->in,
                              .flow_area = 1.0,
                              .wall = block->wall[d->k]};
        f.friction = f.wall ? f.wall->friction : block->prm->friction;
        SIDE_PLACES (d, 0, i, j, at, c) {
            f.cell = c;
            f.face = c + d->face;
            f.once = d->once ? d->once[at] : 1.0;
            visit(&f, with);
        }
    }
}

/* <w.S> of one face, outwards. Products along the tangents as in mesh_ops.c. */
static double given_flux(const struct mesh *m, const struct side *d, int64_t at, int64_t c)
{
    double sum = 0.0;
    for (int q = 0; q < m->dim; q++) {
        const double *w = d->w[q] + at, *S = m->S[d->a][q] + c + d->face;
        sum += w[0] * S[0];
        for (int n = 0; n < 2 && d->t[n] < m->dim; n++) {
            const int64_t t = d->p->stride[d->t[n]], e = n == 0 ? 1 : d->width;
            sum += (w[e] - w[-e]) * (S[t] - S[-t]) / 48.0;
        }
    }
    return d->k % 2 ? sum : -sum;
}

/* Inflows and exact sides, outwards. */
double mesh_bc_given_flux(const struct fv *s)
{
    double sum = 0.0;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        if (d->kind != MESH_INFLOW && d->kind != MESH_EXACT)
            continue;
        SIDE_PLACES (d, 0, i, j, at, c) {
            sum += s->m->status[c] == CELL_COMPUTED ? given_flux(s->m, d, at, c) : 0.0;
        }
    }
    return sum;
}

/* Of computed cells only. Collective. */
double mesh_bc_net_flux(const struct fv *s)
{
    double sum = 0.0;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES (d, 0, i, j, at, c) {
            sum += s->free[c] * (d->k % 2 ? 1.0 : -1.0) * s->U[d->a][c + d->face];
            (void)at;
        }
    }
    return ranks_sum(s->m->comm, sum);
}

/* Sum of the outward vectors of sides beside computed cells. Collective. */
void mesh_bc_vectors(const struct fv *s, double sum[3])
{
    sum[0] = sum[1] = sum[2] = 0.0;
    for (int k = 0; k < s->sides->n; k++) {
        const struct side *d = s->sides->side + k;
        SIDE_PLACES (d, 0, i, j, at, c) {
            for (int e = 0; e < s->dim; e++)
                sum[e] += s->free[c] * (d->k % 2 ? 1.0 : -1.0) * s->m->S[d->a][e][c + d->face];
            (void)at;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, s->comm);
}

/* viscous_solver.c - scratch and spectrum of the implicit viscous solve. Made once; renewed when
 * cells change from computed to imposed or back, since these decide which rows count for the
 * largest eigenvalue.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "viscous_solver.h"

#include "../boundary/fv_boundary.h"
#include "../grid/fv_grid.h"
#include "mesh_ops.h"

/* dim-th root of the number of all cells, for helmholtz_tolerance. Collective. */
static double cells_a_side(const struct fv *s)
{
    int64_t n = 0;
    for (int k = 0; k < s->grid.nparts; k++)
        n += (int64_t)s->grid.part[k].n[0] * s->grid.part[k].n[1] * s->grid.part[k].n[2];
    return pow((double)ranks_count(s->comm, n), 1.0 / s->dim);
}

/* 1.25 nu (G_lower + G_upper)/V per axis: the diagonal of the fourth-order operator, 30/12 = 2.5
 * per axis on even cells. */
static double *diagonal_of(const struct fv *s)
{
    const struct mesh *m = s->m;
    double *scale = NEW(double, s->size);
    for (int q = 0; q < m->nparts; q++) {
        const struct part *p = m->part + q;
        int i[3];
        PART_CELLS (p, i, c) {
            double diagonal = 0.0;
            for (int a = 0; a < m->dim; a++)
                diagonal += m->G[a][a][c] + m->G[a][a][c + p->stride[a]];
            scale[c] = 1.25 * s->nu * diagonal / m->V[c];
        }
    }
    return scale;
}

/* Only where there are walls is Chebyshev's iteration tried on blocks. */
static double stiffest_of(const struct fv *s)
{
    return s->m && mesh_bc_has_walls(s->m) ? mesh_viscous_largest(s) : 0.0;
}

static void make_work(const struct fv *s, struct viscous_solver *v)
{
    const bool walls = s->bc || s->surface || s->blocked || s->b.rows;
    const int sets = s->m ? 4 : walls ? 3 : 0;
    for (int k = 0; sets == 0 && k < 3; k++)
        for (int a = 0; a < s->dim; a++)
            v->single[k][a] = NEW_IN(v, float, s->size);
    for (int k = 0; k < sets; k++)
        for (int a = 0; a < s->dim; a++)
            v->work[k][a] = NEW_IN(v, double, s->size);
    if (s->m || !walls)
        return;
    v->work[3][0] = s->faces[0];
    v->work[3][1] = s->flux;
    if (s->dim == 3)
        v->work[3][2] = NEW_IN(v, double, s->size);
}

struct viscous_solver *viscous_solver_create(const struct fv *s)
{
    if (s->nu == 0.0)
        return NULL;
    struct viscous_solver *v = NEW(struct viscous_solver, 1);
    v->cells_a_side = cells_a_side(s);
    make_work(s, v);
    if (s->m) {
        v->scale = mem_own(v, diagonal_of(s));
        v->symmetric = mesh_viscous_symmetric(s);
    }
    v->stiffest = stiffest_of(s);
    return v;
}

void viscous_solver_renew(struct fv *s)
{
    if (s->viscous)
        s->viscous->stiffest = stiffest_of(s);
}

double viscous_stiffest(const struct fv *s) { return s->viscous ? s->viscous->stiffest : 0.0; }

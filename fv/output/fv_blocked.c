/* fv_blocked.c - forces of the flow on boxes that are cut out of the grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/blocked.h"
#include "../boundary/still.h"
#include "../surface/levelset.h"
#include "output.h"

#include <stdio.h>
#include <string.h>

int fv_blocked_columns(const struct run *r, const struct fv_params *prm, const char **columns)
{
    static char names[BLOCKED_MAX][3][PARAM_TEXT_SIZE + 16];
    int n = 0;
    for (int k = 0; k < prm->nboxes; k++)
        for (int a = 0; a < r->scene.domain.dim; a++) {
            snprintf(names[k][a], sizeof names[k][a], "%s force %c [N]", prm->boxes[k].name,
                     "xyz"[a]);
            columns[n++] = names[k][a];
        }
    return n;
}

static bool is_wet(const struct fv *s, int64_t c)
{
    return !s->surface || s->surface->layer[c] == 0;
}

/* Of the face between the free cell x and the box behind its upper or lower end along a: as on the
 * walls of the domain (fv_forces.c). */
static void add_face(const struct fv *s, const struct near_box *x, int a, int up, double *force)
{
    const struct block *b = &s->b;
    const int64_t c = x->cell, in = up ? -b->stride[a] : b->stride[a];
    const double out = up ? 1.0 : -1.0, h = b->h[a], area = block_volume(b, 0) / h;
    int at[3];
    double p[3], place[3];
    bool deep = x->free[!up] == 3;
    if (!is_wet(s, c) || (s->surface && 3.0 * s->surface->phi[c] > s->surface->phi[c + in]))
        return;
    for (int n = 1; n < 4; n++)
        deep = deep && is_wet(s, c + n * in);
    for (int n = 0; n < 3; n++)
        p[n] = fv_pressure(s, deep ? c + n * in : c);
    block_place(b, c, at);
    block_centre(b, at[0], at[1], at[2], place);
    place[a] += 0.5 * out * h;
    force[a] += out * area *
                (fv_wall_pressure(p, s->prm.boxes[x->box[up]].kind == WALL_SLIP) +
                 fv_still_pressure(s, place));
    for (int q = 0; q < b->dim && s->prm.boxes[x->box[up]].kind == WALL_NO_SLIP; q++) {
        const double *u = s->u[q] + c;
        force[q] += area * s->run->scene.fluid.rho * s->nu / (12.0 * h) *
                    (15.0 * (u[0] - blocked_ghost(u, in, 1, GHOST_NO_SLIP)) -
                     (u[in] - blocked_ghost(u, in, 2, GHOST_NO_SLIP)));
    }
}

void fv_blocked_forces(const struct fv *s, double *values)
{
    const struct blocked *w = s->blocked;
    const int dim = s->b.dim;
    double force[BLOCKED_MAX][3];
    if (!w)
        return;
    memset(force, 0, sizeof force);
    block_halo(&s->b, 2, (double *const[]){s->p, s->p_before});
    for (int a = 0; a < dim; a++)
        for (int64_t k = 0; k < w->nnear[a]; k++)
            for (int up = 0; up < 2; up++)
                if (w->near[a][k].own && w->near[a][k].free[up] == 0)
                    add_face(s, w->near[a] + k, a, up, force[w->near[a][k].box[up]]);
    MPI_Allreduce(MPI_IN_PLACE, force, 3 * BLOCKED_MAX, MPI_DOUBLE, MPI_SUM, s->b.cart);
    for (int k = 0; k < s->prm.nboxes; k++)
        memcpy(values + k * dim, force[k], (size_t)dim * sizeof(double));
}

void fv_summarise_blocked(const struct fv *s)
{
    double values[3 * BLOCKED_MAX];
    char key[PARAM_TEXT_SIZE + 16];
    if (!s->blocked)
        return;
    fv_blocked_forces(s, values);
    for (int k = 0; k < s->prm.nboxes; k++)
        for (int a = 0; a < s->b.dim; a++) {
            snprintf(key, sizeof key, "force.%s.%c", s->prm.boxes[k].name, "xyz"[a]);
            summary_real(s->run->summary, key, values[k * s->b.dim + a]);
        }
}

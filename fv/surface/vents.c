/* vents.c - faces of boxes that let air in. Where a jet leaves the edge of a box air follows along
 * the box, but within the first cell behind the edge no cell is dry: the water there hung on the
 * box's face with a pressure far below the air's, the jet bent a cell late, and under a gate of
 * four cells 16 % too much passed. Water beside air bears no tension. So the face is one of the
 * surface, with p = 0 half a cell off, from when the wet cell beside the surface has a pressure
 * below the air's by more than the weight of half a cell makes, for as long as the water moves away
 * from it. Its flux is that of the cell, whose own velocity it carries; shares of water find
 * nothing there. Only where there are shares, and in cells that were wet in the last step, of which
 * U and p are: a restart has them, too.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"

#include "../boundary/fv_boundary.h"
#include "fraction.h"
#include "level_ops.h"

/* -: tension, of what the weight of a cell makes. Water at rest has none in cells that are wet. */
#define TENSION 0.5

/* Whether a cell around c is dry, over an edge, too: behind a thin box the jet goes on, and air
 * comes round its corner. */
static bool touches_air(const struct fv *s, int64_t c)
{
    const int deep = s->dim == 3;
    for (int k = -deep; k <= deep; k++)
        for (int j = -1; j <= 1; j++)
            for (int i = -1; i <= 1; i++) {
                const int64_t at = c + i + j * s->b.stride[1] + k * s->b.stride[2];
                if (s->surface->layer[at] && forcing_is_free(s, at))
                    return true;
            }
    return false;
}

/* Whether the box's face along a beside the wet cell c is one; out: 1 above the cell, -1 below. */
static bool lets_in(const struct fv *s, int a, int64_t c, int64_t face, double out)
{
    const double away = -out * s->U[a][face], least = TENSION * s->surface->g * s->b.h[a];
    double x[3];
    if (!(s->step.dt > 0.0) || s->surface->layer[c] || s->surface->fraction->layer[c] != 0.0 ||
        away < 0.0 || !touches_air(s, c))
        return false;
    grid_place(&s->grid, c, x);
    return away > 0.0 || s->p[c] < -fv_still_pressure(s, x) / s->run->scene.fluid.rho - least;
}

/* Visits the box's faces along a beside cells of this rank and one layer around: x is the entry of
 * the list, up whether the face is above its cell. */
#define BOX_FACES(w, a, x, up)                                                                     \
    for (const struct near_box *x = (w)->near[a]; x < (w)->near[a] + (w)->nnear[a]; x++)           \
        for (int up = 0; up < 2; up++)                                                             \
            if (x->free[up] == 0)

/* Ranks tell each other what those beside their cells are. */
static void share(struct fv *s)
{
    double *const field = s->surface->kept;
    if (s->run->size == 1)
        return;
    for (int64_t c = 0; c < s->size; c++)
        field[c] = s->blocked->vent[c];
    block_halo(&s->b, 1, &field);
    for (int64_t c = 0; c < s->size; c++)
        s->blocked->vent[c] = (unsigned char)field[c];
}

/* Collective. */
void vents_find(struct fv *s)
{
    struct blocked *w = s->blocked;
    for (int a = 0; a < s->dim; a++)
        BOX_FACES(w, a, x, up)
        {
            const unsigned char bit = (unsigned char)(1 << (2 * a + up));
            const int64_t face = x->cell + up * s->b.stride[a];
            w->vent[x->cell] &= (unsigned char)~bit;
            if (x->own && lets_in(s, a, x->cell, face, up ? 1.0 : -1.0))
                w->vent[x->cell] |= bit;
        }
    share(s);
}

void vents_add_cuts(struct fv *s, int a)
{
    BOX_FACES(s->blocked, a, x, up)
    {
        const int64_t d = s->b.stride[a];
        struct cut q = {.face = x->cell + up * d,
                        .wet = x->cell,
                        .dry = x->cell + (up ? d : -d),
                        .up = up ? 1.0 : -1.0,
                        .theta = 0.5,
                        .step = s->b.h[a],
                        .size = s->b.h[a]};
        double at[3], e[3] = {0.0, 0.0, 0.0};
        if (!blocked_vents(s, a, x->cell, up))
            continue;
        grid_place(&s->grid, x->cell, at);
        at[a] += 0.5 * q.up * q.step;
        e[a] = q.up;
        level_add_cut(s, a, q, at, e);
    }
}

/* fraction_flow.c - volumes that cross faces. Those in the air come of extrapolated velocities:
 * there a potential takes their divergence away, so that cells that fill are neither too full nor
 * less than empty. It is 0 beyond some layers of air; faces of wet cells stay as they are.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fraction.h"

#include <string.h>

#include "../../common/base/mem.h"
#include "levelset.h"
#include "mesh_view.h"

/* Layers of air where there is no divergence; sweeps over all of their cells, and their relaxation.
 */
enum { AIR = 3, SWEEPS = 12 };
#define RELAXATION 1.5

static const int none[3] = {0, 0, 0};

static bool is_air(const struct fv *s, int64_t c)
{
    const double layer = s->surface->fraction->layer[c];
    return layer >= 1.0 && layer <= AIR && !surface_holds_none(s, c);
}

/* Whether the potential changes the volume through the lower face of c: no face of a wet cell, nor
 * one of a cell that holds nothing. */
static bool is_free(const struct fv *s, int64_t c, int64_t d)
{
    const double *layer = s->surface->fraction->layer;
    return layer[c] >= 1.0 && layer[c - d] >= 1.0 && !surface_holds_none(s, c) &&
           !surface_holds_none(s, c - d);
}

/* m^(dim-2): area of the lower face over the distance of the centres. */
static double conductance(const struct fv *s, int64_t c, int64_t d, int a)
{
    const double h = grid_height(&s->grid, c, a);
    return s->surface->fraction->volume[c] / h / (0.5 * (h + grid_height(&s->grid, c - d, a)));
}

/* A cell of air as the sweeps see it. */
static struct air_cell look(const struct fv *s, const struct part *p, int64_t c)
{
    const struct fraction *f = s->surface->fraction;
    struct air_cell x = {.cell = c};
    double sum = 0.0;
    for (int a = 0; a < s->dim; a++) {
        const int64_t d = p->stride[a];
        x.step[a] = d;
        x.out += f->flow[a][c + d] - f->flow[a][c];
        for (int up = 0; up < 2; up++) {
            const int64_t face = c + up * d;
            if (is_free(s, face, d))
                x.g[a][up] = conductance(s, face, d, a);
            sum += x.g[a][up];
        }
    }
    x.per = sum > 0.0 ? -RELAXATION / sum : 0.0;
    return x;
}

/* The cells of air, those of one colour behind those of the other. */
static void list_air(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    int at[3];
    f->nair = 0;
    for (int colour = 0; colour < 2; colour++) {
        f->first_air[colour] = f->nair;
        FLOW_NEAR_AT (s, p, j, c, n) {
            part_index(p, c, at);
            const int odd = (at[0] + p->lo[0]) ^ (at[1] + p->lo[1]) ^ (at[2] + p->lo[2]);
            for (int64_t i = c + ((odd ^ colour) & 1); i < c + n; i += 2) {
                if (!is_air(s, i))
                    continue;
                if (f->nair == f->air_room) {
                    const int64_t more = 2 * f->air_room + 256;
                    GROW(f->air, f->nair, more);
                    f->air_room = more;
                }
                f->air[f->nair++] = look(s, p, i);
            }
        }
    }
    f->first_air[2] = f->nair;
}

/* Gauss and Seidel's step of the cells of one colour: nothing is to be left of their divergence. */
static void relax(struct fv *s, int colour)
{
    struct fraction *f = s->surface->fraction;
    double *const work = f->work;
    for (const struct air_cell *x = f->air + f->first_air[colour];
         x < f->air + f->first_air[colour + 1]; x++) {
        double *const q = work + x->cell, own = *q, out = x->out;
        for (int a = 0; a < s->dim; a++)
            out -= x->g[a][0] * (q[-x->step[a]] - own) + x->g[a][1] * (q[x->step[a]] - own);
        *q = own + x->per * out;
    }
}

static void take_divergence_away(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    list_air(s);
    memset(f->work, 0, (size_t)s->size * sizeof(double));
    for (int k = 0; k < 2 * SWEEPS; k++) {
        relax(s, k % 2);
        grid_fill(&s->grid, 1, &f->work);
    }
    for (int a = 0; a < s->dim; a++) {
        int up[3] = {0, 0, 0};
        up[a] = 1;
        for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++) {
            const int64_t d = p->stride[a];
            PART_NEAR (p, none, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    if (f->work[i] != f->work[i - d] && is_free(s, i, d))
                        f->flow[a][i] -= conductance(s, i, d, a) * (f->work[i] - f->work[i - d]);
        }
    }
}

void fraction_set_flows(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    for (int a = 0; a < s->dim; a++) {
        int up[3] = {0, 0, 0};
        up[a] = 1;
        for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
            PART_NEAR (p, none, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    f->flow[a][i] =
                        s->m ? s->U[a][i] : s->U[a][i] * f->volume[i] / grid_height(&s->grid, i, a);
    }
    take_divergence_away(s);
}

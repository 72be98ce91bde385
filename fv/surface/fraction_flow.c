/* fraction_flow.c - volumes that cross faces. Those in the air come of extrapolated velocities:
 * there a potential takes their divergence away, so that cells that fill are neither too full nor
 * less than empty. It is 0 beyond some layers of air; faces of wet cells stay as they are.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fraction.h"

#include <string.h>

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
    const double h = fraction_size(s, c, a);
    return s->surface->fraction->volume[c] / h / (0.5 * (h + fraction_size(s, c - d, a)));
}

/* What a cell's potential q is to change by so that nothing is left of its divergence. */
static double change_of(const struct fv *s, const struct part *p, int64_t c, const double *q)
{
    const struct fraction *f = s->surface->fraction;
    double sum = 0.0, out = 0.0;
    for (int a = 0; a < s->dim; a++) {
        const int64_t d = p->stride[a];
        out += f->flow[a][c + d] - f->flow[a][c];
        for (int up = 0; up < 2; up++) {
            const int64_t face = c + up * d;
            if (!is_free(s, face, d))
                continue;
            const double g = conductance(s, face, d, a);
            sum += g;
            out -= g * (q[up ? c + d : c - d] - q[c]);
        }
    }
    return sum > 0.0 ? -out / sum : 0.0;
}

/* Gauss and Seidel's step of the cells of one colour. */
static void relax(struct fv *s, int colour)
{
    struct fraction *f = s->surface->fraction;
    const struct part *p = s->part;
    int at[3];
    for (int64_t k = 0; k < f->nair; k++) {
        const int64_t c = f->air[k];
        while (c >= p->base + p->size)
            p++;
        part_index(p, c, at);
        if (((at[0] + p->lo[0]) ^ (at[1] + p->lo[1]) ^ (at[2] + p->lo[2])) % 2 == colour)
            f->work[c] += RELAXATION * change_of(s, p, c, f->work);
    }
}

static void take_divergence_away(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    f->nair = 0;
    FLOW_ROWS (s, c, n)
        for (int64_t i = c; i < c + n; i++)
            if (is_air(s, i))
                f->air[f->nair++] = i;
    memset(f->work, 0, (size_t)s->size * sizeof(double));
    for (int k = 0; k < 2 * SWEEPS; k++) {
        relax(s, k % 2);
        surface_fill(s, 1, &f->work);
    }
    for (int a = 0; a < s->dim; a++) {
        int up[3] = {0, 0, 0};
        up[a] = 1;
        for (const struct part *p = s->part; p < s->part + s->nparts; p++) {
            const int64_t d = p->stride[a];
            PART_ROWS (p, none, up, c, n)
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
        for (const struct part *p = s->part; p < s->part + s->nparts; p++)
            PART_ROWS (p, none, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    f->flow[a][i] =
                        s->m ? s->U[a][i] : s->U[a][i] * f->volume[i] / fraction_size(s, i, a);
    }
    take_divergence_away(s);
}

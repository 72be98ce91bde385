/* fraction_flow.c - volumes that cross faces. Those in the air come of extrapolated velocities:
 * there a potential takes their divergence away, so that cells that fill are neither too full nor
 * less than empty. It is 0 beyond some layers of air; faces of wet cells stay as they are.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fraction.h"

#include "levelset.h"
#include "mesh_view.h"

/* Layers of air where there is no divergence; sweeps over their cells. */
enum { AIR = 3, SWEEPS = 14 };
/* Square of the largest eigenvalue of a sweep without relaxation that is counted with: three layers
 * under air at 0 on an even surface have 0.89. */
#define SPECTRAL 0.89

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
    const double h = fraction_height(s, c, a);
    return s->surface->fraction->volume[c] / h / (0.5 * (h + fraction_height(s, c - d, a)));
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
            x.share[a][up] = is_free(s, face, d) ? conductance(s, face, d, a) : 0.0;
        }
        sum += x.share[a][0] + x.share[a][1];
    }
    const double per = sum > 0.0 ? 1.0 / sum : 0.0;
    x.out *= per;
    for (int a = 0; a < s->dim; a++)
        for (int up = 0; up < 2; up++)
            x.share[a][up] *= per;
    return x;
}

/* Cells of the sweeps, gathered once: SWEEPS passes go through the list instead of the grid. */
static void list_air(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    f->nair = 0;
    FLOW_NEAR_AT (s, p, j, c, n)
        for (int64_t i = c; i < c + n; i++) {
            if (!is_air(s, i))
                continue;
            ROOM_IN(f, f->air, f->nair + 1);
            f->air[f->nair++] = look(s, p, i);
        }
}

/* Chebyshev's step of all cells at once, so that none comes first and mirrored scenes stay
 * mirrored: before is the potential of the step before now, and becomes the next one. */
INLINE void relax_body(const struct fraction *f, const int dim, const double *now, double *before,
                       double weight)
{
    for (const struct air_cell *x = f->air; x < f->air + f->nair; x++) {
        const double *const q = now + x->cell;
        double *const next = before + x->cell, mean = -x->out;
        for (int a = 0; a < dim; a++)
            mean += x->share[a][0] * q[-x->step[a]] + x->share[a][1] * q[x->step[a]];
        *next += weight * (mean - *next);
    }
}

static void relax(const struct fv *s, const double *now, double *before, double weight)
{
    if (s->dim == 2)
        relax_body(s->surface->fraction, 2, now, before, weight);
    else
        relax_body(s->surface->fraction, 3, now, before, weight);
}

/* The potential into work. */
static void find_potential(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    double weight = 1.0;
    grid_clear_near(&s->grid, f->work);
    grid_clear_near(&s->grid, f->next);
    for (int k = 0; k < SWEEPS; k++) {
        double *const now = f->work;
        weight = k == 1 ? 1.0 / (1.0 - 0.5 * SPECTRAL) : 1.0 / (1.0 - 0.25 * SPECTRAL * weight);
        relax(s, now, f->next, k == 0 ? 1.0 : weight);
        f->work = f->next;
        f->next = now;
        grid_fill(&s->grid, 1, &f->work);
    }
}

/* flow -= conductance times the difference of the potential, on faces between air cells. */
static void take_divergence_away(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    list_air(s);
    find_potential(s);
    for (int a = 0; a < s->dim; a++) {
        int up[3] = {0, 0, 0};
        up[a] = 1;
        for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++) {
            const int64_t d = p->stride[a];
            PART_NEAR (p, no_layers, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    if (f->work[i] != f->work[i - d] && is_free(s, i, d))
                        f->flow[a][i] -= conductance(s, i, d, a) * (f->work[i] - f->work[i - d]);
        }
    }
}

/* m^dim/s through the lower faces, along increasing indices, relative to faces that move. Once a
 * step: has_flows says that they are there. */
void fraction_set_flows(struct fv *s)
{
    struct fraction *f = s->surface->fraction;
    if (f->has_flows)
        return;
    for (int a = 0; a < s->dim; a++) {
        const double *restrict U = s->U[a], *restrict area = f->area[a],
                               *restrict grid = s->m ? s->m->grid[a] : NULL;
        double *restrict flow = f->flow[a];
        int up[3] = {0, 0, 0};
        up[a] = 1;
        for (const struct part *p = s->grid.part; p < s->grid.part + s->grid.nparts; p++)
            PART_NEAR (p, no_layers, up, c, n)
                for (int64_t i = c; i < c + n; i++)
                    flow[i] = area ? U[i] * area[i] : grid ? U[i] - grid[i] : U[i];
    }
    take_divergence_away(s);
    f->has_flows = true;
}

/* probe_flow.c - samples of a section through which a gauge measures the discharge, in the middle
 * of its parts: 400 equal ones in 2D, 100 x 100 in 3D, or what lies in each cell. The sum of u.n
 * counts each by how much of it is water, by the level set over the samples' distance: a share
 * between 0 and 1 next to the surface.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "probe_flow.h"

#include <stdlib.h>

#include "../../common/scene/scene.h"
#include "../grid/fv_grid.h"

enum { ALONG_LINE = 400, ALONG_SIDE = 100 };

/* A sample for each pair of parts along the section's tangents; across is its unit normal. */
struct flow_samples flow_samples_between(int dim, const struct scene_probe *g,
                                         const struct probe_section *c,
                                         const struct flow_ends of[2])
{
    const int second = c->n > 1 ? of[1].n : 1;
    struct flow_samples f = {.n = of[0].n * second};
    f.x = (double(*)[3])NEW(double, f.n * 3);
    f.value = (double(*)[FLOW_VALUES])NEW(double, f.n *FLOW_VALUES);
    f.area = NEW(double, f.n);
    for (int a = 0; a < dim; a++)
        f.across[a] = c->across[a];
    for (int i = 0; i < f.n; i++) {
        const int at[2] = {i % of[0].n, i / of[0].n};
        f.area[i] = 1.0;
        memcpy(f.x[i], g->at, (size_t)dim * sizeof(double));
        for (int k = 0; k < c->n; k++) {
            const double *e = of[k].end + at[k], width = e[1] - e[0];
            f.area[i] *= width;
            f.step = fmax(f.step, width);
            for (int a = 0; a < dim; a++)
                f.x[i][a] += c->along[k][a] * 0.5 * (e[0] + e[1]);
        }
    }
    return f;
}

struct flow_samples flow_samples_create(const struct fv *s, const struct scene_probe *g)
{
    const struct probe_section c = probe_section_of(g, s->dim);
    double end[2][ALONG_LINE + 1];
    struct flow_ends of[2];
    for (int k = 0; k < c.n; k++) {
        of[k] = (struct flow_ends){s->dim == 2 ? ALONG_LINE : ALONG_SIDE, end[k]};
        for (int i = 0; i <= of[k].n; i++)
            end[k][i] = c.length[k] * i / of[k].n;
    }
    return flow_samples_between(s->dim, g, &c, of);
}

/* Faces along axis a of cells from one coordinate to another; their numbers, of layers from 0. */
static void faces_between(const struct block *b, int a, double low, double high, int at[2])
{
    at[0] = 0;
    at[1] = b->cells[a];
    if (a == 1 && b->rows)
        return;
    const double first = ceil((low - b->origin[a]) / b->h[a]),
                 last = floor((high - b->origin[a]) / b->h[a]);
    at[0] = (int)(b->periodic[a] ? first : fmax(first, 0.0));
    at[1] = (int)(b->periodic[a] ? last : fmin(last, b->cells[a]));
}

/* Along tangent k: where the section goes from cell to cell. */
static struct flow_ends ends_in_cells(const struct block *b, const struct scene_probe *g,
                                      const struct probe_section *c, int k)
{
    const double length = c->length[k];
    struct flow_ends e = {1, NEW(double, 2)};
    e.end[1] = length;
    for (int a = 0; a < b->dim; a++) {
        const double along = c->along[k][a], to = g->at[a] + along * length;
        int at[2];
        if (along == 0.0)
            continue;
        faces_between(b, a, fmin(g->at[a], to), fmax(g->at[a], to), at);
        e.end = mem_room(NULL, e.end, (size_t)(e.n + 2 + at[1] - at[0]), sizeof *e.end);
        for (int i = at[0]; i <= at[1]; i++) {
            const double face = a == 1 && b->rows ? b->rows->edge[i] : b->origin[a] + i * b->h[a],
                         place = (face - g->at[a]) / along;
            if (place > 1e-12 * length && place < (1.0 - 1e-12) * length)
                e.end[++e.n] = place;
        }
    }
    qsort(e.end, (size_t)e.n + 1, sizeof *e.end, lookup_ascending);
    return e;
}

struct flow_samples flow_samples_of_cells(const struct fv *s, const struct scene_probe *g)
{
    const struct probe_section c = probe_section_of(g, s->dim);
    struct flow_ends of[2] = {{0, NULL}, {0, NULL}};
    for (int k = 0; k < c.n; k++)
        of[k] = ends_in_cells(&s->b, g, &c, k);
    const struct flow_samples f = flow_samples_between(s->dim, g, &c, of);
    FREE(of[0].end, of[1].end);
    return f;
}

void flow_samples_free(struct flow_samples *f) { FREE(f->x, f->value, f->area); }

/* m^dim/s */
double flow_samples_sum(const struct flow_samples *f, int dim)
{
    double sum = 0.0;
    for (int i = 0; i < f->n; i++) {
        const double *v = f->value[i];
        const double wet = fmin(fmax(0.5 - v[3] / f->step, 0.0), 1.0);
        for (int a = 0; a < dim; a++)
            sum += f->area[i] * wet * f->across[a] * v[a];
    }
    return sum;
}

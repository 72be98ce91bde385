/* smooth.c - removes an odd-even mode from a pressure; see smooth_odd_even in operators.h. With C
 * the third difference across a face, 0 where the stencil leaves the fluid, p -= 0.1/64 sum over
 * axes of C^T C p. On (-1)^i, where |C p| = 8, this takes off a tenth along each axis; smooth
 * fields change by O(h^6). Once a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../boundary/fv_boundary.h"
#include "../fv.h"
#include "../surface/fv_surface.h"
#include "operators.h"

/* Whether a cell's lower face and the two beside it along the axis are passed by the flow: four
 * cells of water. open: 1 on faces that it can pass; layer: 0 in wet cells, NULL without a surface.
 */
static inline bool is_inside(const double *open, const unsigned char *layer, int64_t i,
                             int64_t along)
{
    return open[i - along] == 1.0 && open[i] == 1.0 && open[i + along] == 1.0 &&
           (!layer || (layer[i - 2 * along] | layer[i - along] | layer[i] | layer[i + along]) == 0);
}

/* d = third difference of p over the lower face of each cell, 0 where it leaves the fluid. */
static inline void third_difference(const double *restrict p, const double *restrict open,
                                    const unsigned char *layer, int64_t along, int64_t n,
                                    double *restrict d)
{
    for (int64_t i = 0; i < n; i++)
        d[i] = is_inside(open, layer, i, along)
                   ? p[i + along] - p[i - 2 * along] - 3.0 * (p[i] - p[i - along])
                   : 0.0;
}

/* d on one face more below and two above than there are cells, as C^T reads them; sum collects the
 * axes before p changes. */
void smooth_odd_even(const struct fv *s, double *p, double *d, double *sum)
{
    const struct block *b = &s->b;
    const double w = 0.1 / 64.0;
    for (int a = 0; a < b->dim; a++) {
        const int64_t along = b->stride[a];
        for (int k = a == 2 ? -1 : 0; k < b->n[2] + (a == 2 ? 2 : 0); k++)
            for (int j = a == 1 ? -1 : 0; j < b->n[1] + (a == 1 ? 2 : 0); j++) {
                const int64_t c = block_at(b, a == 0 ? -1 : 0, j, k);
                third_difference(p + c, s->forcing->open[a] + c, NULL, along,
                                 b->n[0] + (a == 0 ? 3 : 0), d + c);
            }
        BLOCK_ROWS (b, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                sum[i] = (a ? sum[i] : 0.0) + d[i - along] - d[i + 2 * along] -
                         3.0 * (d[i] - d[i + along]);
    }
    BLOCK_ROWS (b, 0, c, n)
        for (int64_t i = c; i < c + n; i++)
            p[i] -= w * sum[i];
}

/* By one axis after the other, so that modes along several of them go, too. */
void smooth_wet(struct fv *s, double share, double *p, double *d)
{
    for (int a = 0; a < s->dim; a++) {
        const int64_t along = s->b.stride[a];
        const int down[3] = {a == 0, a == 1, a == 2},
                  up[3] = {2 * (a == 0), 2 * (a == 1), 2 * (a == 2)};
        grid_fill(&s->grid, 1, &p);
        PART_NEAR (&s->whole, down, up, c, n)
            third_difference(p + c, s->forcing->open[a] + c, s->surface->layer + c, along, n,
                             d + c);
        BLOCK_WET (s, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                p[i] -=
                    share / 64.0 * (d[i - along] - d[i + 2 * along] - 3.0 * (d[i] - d[i + along]));
    }
}

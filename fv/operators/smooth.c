/* smooth.c - removes an odd-even mode from a pressure; see smooth_odd_even in operators.h. With C
 * the third difference across a face, 0 where the stencil leaves the fluid, p -= share/64 C^T C p
 * along each axis. On (-1)^i, where |C p| = 8, this takes off that share; smooth fields change by
 * O(h^6). SPDX-License-Identifier: BSD-3-Clause */
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

/* By one axis after the other, so that modes along several of them go, too. d on one face more
 * below and two above than there are cells, as C^T reads them. */
void smooth_odd_even(struct fv *s, double share, double *p, double *d)
{
    for (int a = 0; a < s->dim; a++) {
        const int64_t along = s->b.stride[a];
        const int down[3] = {a == 0, a == 1, a == 2},
                  up[3] = {2 * (a == 0), 2 * (a == 1), 2 * (a == 2)};
        grid_fill(&s->grid, 1, &p);
        PART_NEAR (&s->whole, down, up, c, n)
            third_difference(p + c, s->forcing->open[a] + c,
                             s->surface ? s->surface->layer + c : NULL, along, n, d + c);
        BLOCK_WET (s, 0, c, n)
            for (int64_t i = c; i < c + n; i++)
                p[i] -=
                    share / 64.0 * (d[i - along] - d[i + 2 * along] - 3.0 * (d[i] - d[i + along]));
    }
}

/* gradient.c - fourth-order cell gradient of a pressure. g = (8 (q_1 - q_-1) - (q_2 - q_-2))/(12 h)
 * from averages; in layers weights of their own. Beside imposed cells forcing_gradient replaces the
 * stencil, continued as `how' says.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../fv.h"

#include "../boundary/fv_boundary.h"
#include "../surface/fv_surface.h"
#include "operators.h"

/* A row of n cells, c = 1/(12 h). */
static void row(const double *restrict q, int64_t along, double c, int64_t n, double *restrict out)
{
    for (int64_t i = 0; i < n; i++)
        out[i] = c * (8.0 * (q[i + along] - q[i - along]) - (q[i + 2 * along] - q[i - 2 * along]));
}

void gradient(const struct fv *s, const double *q, int a, enum continuation how, double *out)
{
    const struct block *b = &s->b;
    if (a == 1 && b->rows)
        BLOCK_WET_AT (s, 0, j, c, n)
            for (int64_t i = c; i < c + n; i++)
                out[i] = block_derivative(b, q + i, a, j);
    else
        BLOCK_WET (s, 0, c, n)
            row(q + c, b->stride[a], 1.0 / (12.0 * b->h[a]), n, out + c);
    if (s->forcing)
        forcing_gradient(s, a, how, s->surface ? s->surface->layer : NULL, q, out);
}

/* shape_velocity.c - velocities that shapes add to the field at the start, in a flow without a
 * surface of its own; with one, surface_steps.c does it. SPDX-License-Identifier: BSD-3-Clause */
#include "../../common/scene/scene.h"
#include "fv_case.h"

enum { POINTS = 4 }; /* along each edge of a cell: where a shape cuts it, u is that to a 16th */

void fv_shape_velocity(const struct fv *s, const double *x, const double *h, double *u)
{
    const struct scene *c = &s->run->scene;
    const double none[3] = {0.0, 0.0, 0.0}, *edge = h ? h : none;
    double sum[3] = {0.0, 0.0, 0.0};
    int n[3];
    if (surface_wanted(s->run) || !scene_shapes_move(c))
        return;
    for (int a = 0; a < 3; a++)
        n[a] = a < s->dim && edge[a] > 0.0 ? POINTS : 1;
    for (int k = 0; k < n[0] * n[1] * n[2]; k++) {
        const int at[3] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        double y[3], v[3];
        for (int a = 0; a < 3; a++)
            y[a] = x[a] + (n[a] > 1 ? ((at[a] + 0.5) / n[a] - 0.5) * edge[a] : 0.0);
        scene_is_fluid(c, &s->exact, y, v);
        for (int a = 0; a < s->dim; a++)
            sum[a] += v[a];
    }
    for (int a = 0; a < s->dim; a++)
        u[a] += sum[a] / (n[0] * n[1] * n[2]);
}

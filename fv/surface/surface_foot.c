/* surface_foot.c - on blocks that lean or overlap: phi of a cell goes on with the velocity at its
 * foot on the surface, by the quadratic about the cell,
 *   u(x - r) = u - r.grad u + r.(r.grad grad u)/2,  r = phi grad phi/|grad phi|^2,
 * so that it stays a distance. With the velocity of the cell itself a vortex below a surface at
 * rest bends phi on both sides of it without end; where index lines slant, the cuts then see a
 * surface that is not level, and water at rest grows. On the surface both are the same. Where
 * blocks move it is the cell's own: there the height goes on, by the cell's vertical velocity.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "levelset.h"
#include "mesh_view.h"

/* Cells along an index line: from the first on the step to the foot is less than whole, from the
 * second on none. */
static const double WHOLE = 1.5, NONE = 3.0;
/* Cells that the water passes in a step: up to here this is done, from twice that on it is not.
 * Slopes of jets are rough, and phi that travels becomes a distance again by itself (reinit.c). */
static const double SLOW = 0.1;

/* The step to the foot, in cells along each index; false: the cell is too far off. */
static bool step_to_foot(const struct fv *s, const struct part *p, int64_t c, const double g[3][3],
                         double step[3], double *share)
{
    const double phi = s->surface->phi[c];
    double n[3], n2 = 0.0, most = 0.0, passed = 0.0;
    if (fabs(phi) > NONE * surface_mesh_spacing(s, p) || s->m->status[c] == CELL_HOLE)
        return false;
    surface_mesh_gradient(s, p, c, s->surface->phi, n);
    for (int k = 0; k < s->dim; k++)
        n2 += n[k] * n[k];
    for (int a = 0; a < s->dim; a++) {
        double along = 0.0, rate = 0.0;
        for (int k = 0; k < s->dim; k++) {
            along += g[a][k] * n[k];
            rate += g[a][k] * s->u[k][c];
        }
        passed += fabs(rate) * s->step.dt;
        step[a] = -phi * along / fmax(n2, 0.25);
        most = fmax(most, fabs(step[a]));
    }
    *share = fmin(1.0, (NONE - most) / (NONE - WHOLE)) * fmax(0.0, fmin(1.0, 2.0 - passed / SLOW));
    return *share > 0.0;
}

void surface_foot_velocity(const struct fv *s, const struct part *p, int64_t c,
                           const double g[3][3], double u[3])
{
    double step[3], share;
    for (int k = 0; k < s->dim; k++)
        u[k] = s->u[k][c];
    if (s->moving || !s->surface->mesh->slants[p - s->grid.part] ||
        !step_to_foot(s, p, c, g, step, &share))
        return;
    for (int k = 0; k < s->dim; k++) {
        const double *v = s->u[k] + c;
        double change = 0.0;
        for (int a = 0; a < s->dim; a++) {
            const int64_t d = p->stride[a];
            change += 0.5 * step[a] * (v[d] - v[-d] + step[a] * (v[d] - 2.0 * v[0] + v[-d]));
            for (int b = 0; b < a; b++) {
                const int64_t e = p->stride[b];
                change += 0.25 * step[a] * step[b] * (v[d + e] - v[d - e] - v[e - d] + v[-d - e]);
            }
        }
        u[k] += share * change;
    }
}
